/* reduced_convolution_inner.h: operands, segments and their crossings, shared by reduced_convolution*.c only. */
#ifndef SUNDER_I_REDUCED_CONVOLUTION_INNER_H
#define SUNDER_I_REDUCED_CONVOLUTION_INNER_H

#include "base/sort.h"
#include "minkowski/reduced_convolution.h"
#include "predicate/narrow.h"

#define SUNDER_I_NO_SEGMENT UINT32_MAX
/* Steps along an axis are below 2 to this power. */
#define SUNDER_I_STEP_BITS 20

/* A simple polygon, counterclockwise. Side i leaves vertex i. */
typedef struct sunder_i_chain_operand {
    const sunder_shape *shape;
    uint32_t n;
    sunder_i_point *at;    /* [n] the vertices */
    sunder_i_point *along; /* [n] the vectors of the sides */
    uint32_t *rank;        /* [n] the ranks of the sides' directions (directions.h) */
    uint32_t *by_rank;     /* [n] the sides in the order of their ranks */
    uint32_t *position;    /* [n] the position of each side in that order */
    uint32_t *below;       /* [2 * classes] the number of sides with a lower rank */
    uint32_t *first; /* [n] the number, in the order of construction, of the first segment that each vertex carries;
                      * SUNDER_I_NO_SEGMENT: the vertex is reflex */
} sunder_i_chain_operand;

/* A side of one operand translated by a convex vertex of the other. */
typedef struct sunder_i_reduced_segment {
    sunder_i_point from, along;
    uint32_t next; /* the segment that continues this one, by construction, or SUNDER_I_NO_SEGMENT */
} sunder_i_reduced_segment;

/* The approximate extent of a segment along one axis, for a quick test whether two may meet: in steps from the least
 * coordinate of all segments, all rounded down. */
typedef struct sunder_i_steps_along {
    uint32_t low, high;
} sunder_i_steps_along;

/* A crossing of two segments. As a position on one of its segments it is called a stop. Stops are numbered segment by
 * segment, and in order along each. */
typedef struct sunder_i_reduced_crossing {
    uint32_t segment[2];
    double at[2];     /* the approximate parameter along each segment, between 0 and 1 */
    bool first_rises; /* the first segment crosses to the left side of the second, which then crosses to the right side
                       * of the first */
} sunder_i_reduced_crossing;

typedef struct sunder_i_reduced {
    sunder_i_lattice *lattice;
    sunder_i_arena small, memory; /* memory for the operands; for segments and all later stages */
    void *room;                   /* the first block of `memory`, or NULL */
    sunder_i_chain_operand operand[2];
    uint32_t classes;
    sunder_i_reduced_segment *segment; /* [segments] sorted by x->low, that is, almost from left to right */
    uint32_t segments;
    uint32_t *order;             /* [segments] the number of each, by its number in the order of construction */
    sunder_i_steps_along *x, *y; /* [segments] */
    bool brief;                  /* whether differences of coordinates are brief (narrow.h) */
    sunder_i_reduced_crossing *crossing;
    size_t crossings, crossings_capacity;
    sunder_i_valued *stop; /* [2 * crossings] value: the approximate parameter along the segment; item: the end of a
                            * crossing, which is 2 * its number, plus 1 for its second segment */
    uint32_t *stop_end;    /* [segments] the index after the last stop of each */
    uint32_t *place;       /* [2 * crossings] the stop of each end of a crossing */
} sunder_i_reduced;

/* Returns the segment that is side i of operand a translated by vertex j of the other operand, or
 * SUNDER_I_NO_SEGMENT. */
uint32_t sunder_i_reduced_segment_of(const sunder_i_reduced *r, int a, uint32_t i, uint32_t j);
/* Returns the segment that starts at the sum of vertex i of the first operand and vertex j of the second, or
 * SUNDER_I_NO_SEGMENT; there is at most one (reduced_convolution.c). */
static inline uint32_t sunder_i_reduced_starting_at(const sunder_i_reduced *r, uint32_t i, uint32_t j)
{
    const uint32_t of_first = sunder_i_reduced_segment_of(r, 0, i, j);
    return of_first != SUNDER_I_NO_SEGMENT ? of_first : sunder_i_reduced_segment_of(r, 1, j, i);
}

/* Makes all segments; *fits becomes false if the operands are not of the required kind. Returns false if out of
 * memory. */
bool sunder_i_reduced_build(sunder_i_reduced *r, const sunder_i_point *at[2], bool *fits);
/* Finds all stops; *fits becomes false if segments meet in any way other than by crossing in their interiors, if
 * doubles do not decide the order of stops, or if there are too many. Returns false if out of memory. */
bool sunder_i_reduced_cross(sunder_i_reduced *r, bool *fits);

/* The sides of one operand whose directions are between two ranks `from` and `to` of sides of the other operand, which
 * no side of the first has: those at the positions [first[k], end[k]) of by_rank, k = 0, 1. */
typedef struct sunder_i_rank_range {
    uint32_t first[2], end[2];
} sunder_i_rank_range;

static inline sunder_i_rank_range sunder_i_sides_between(const sunder_i_chain_operand *o, uint32_t from, uint32_t to)
{
    if (from <= to) return (sunder_i_rank_range){{o->below[from], 0}, {o->below[to], 0}};
    return (sunder_i_rank_range){{o->below[from], 0}, {o->n, o->below[to]}};
}

static inline uint32_t sunder_i_vertex_before(const sunder_i_chain_operand *o, uint32_t i)
{
    return i ? i - 1 : o->n - 1;
}
static inline uint32_t sunder_i_vertex_after(const sunder_i_chain_operand *o, uint32_t i)
{
    return i + 1 < o->n ? i + 1 : 0;
}

/* Returns true if the turn at vertex i is a left turn. It is never straight. */
static inline bool sunder_i_is_convex(const sunder_i_chain_operand *o, uint32_t i, uint32_t classes)
{
    const uint32_t in = o->rank[sunder_i_vertex_before(o, i)], out = o->rank[i];
    return (out >= in ? out - in : out + 2 * classes - in) < classes;
}

static inline uint32_t sunder_i_reduced_stop_begin(const sunder_i_reduced *r, uint32_t segment)
{
    return segment ? r->stop_end[segment - 1] : 0;
}

/* ---- reduced_convolution_inside.c ---- */

/* The state for the tests whether points of segments are in the sum, in doubles. */
typedef struct sunder_i_place_query {
    const sunder_i_reduced *reduced;
    double error;     /* the error bound of points and coordinates, including the errors of differences and products of
                       * them */
    double *xy[2];    /* [2 * n] for each operand the x coordinates of the vertices, then their y coordinates */
    double *value;    /* [n of the second operand] temporary values */
    uint32_t *order;  /* [n of the first operand] its sides, the longest first */
    uint32_t last[2]; /* the two sides that crossed in the last test that found such sides */
    size_t left;      /* the number of sides and vertices that may still be tested */
} sunder_i_place_query;

typedef enum sunder_i_place_in_sum { SUNDER_I_INSIDE, SUNDER_I_NOT_INSIDE, SUNDER_I_UNCERTAIN } sunder_i_place_in_sum;

bool sunder_i_place_query_init(sunder_i_place_query *inside, sunder_i_reduced *r);
/* Returns whether the point at parameter `at` along a segment is in the interior of the sum, int P + int Q;
 * SUNDER_I_UNCERTAIN if rounding hides the answer, or if inside->left is too small. */
sunder_i_place_in_sum sunder_i_place_query_ask(sunder_i_place_query *inside, uint32_t segment, double at);

#endif
