/* What the files of the reduced convolution share: operands, segments, and where these cross. Internal to
 * reduced_convolution*.c. */
#ifndef SUNDER_I_REDUCED_CONVOLUTION_INNER_H
#define SUNDER_I_REDUCED_CONVOLUTION_INNER_H

#include "base/sort.h"
#include "minkowski/reduced_convolution.h"
#include "predicate/narrow.h"

#define SUNDER_I_NO_SEGMENT UINT32_MAX
/* Steps along an axis are below 2^20. */
#define SUNDER_I_STEP_BITS 20

/* A simple polygon, counter-clockwise. Side i leaves vertex i. */
typedef struct sunder_i_chain_operand {
    const sunder_shape *shape;
    uint32_t n;
    sunder_i_point *at;    /* [n] */
    sunder_i_point *along; /* [n] sides */
    uint32_t *rank;        /* [n] of sides, by direction (directions.h) */
    uint32_t *by_rank;     /* [n] sides in the order of their ranks */
    uint32_t *position;    /* [n] where in that order each side is */
    uint32_t *below;       /* [2 * classes] how many sides have a lower rank */
    uint32_t *first; /* [n] the first segment that each vertex carries, as they are made; or NO_SEGMENT: it is reflex */
} sunder_i_chain_operand;

/* A side of one operand moved by a convex vertex of the other. */
typedef struct sunder_i_reduced_segment {
    sunder_i_point from, along;
    uint32_t next; /* the segment that starts where it ends, by its making; or NO_SEGMENT */
} sunder_i_reduced_segment;

/* The approximate extent of a segment along one axis, which tells whether two may meet: in steps from the least
 * coordinate of all, rounded alike. */
typedef struct sunder_i_steps_along {
    uint32_t low, high;
} sunder_i_steps_along;

/* Seen from one of its segments, a crossing is a stop. Stops are numbered segment by segment, and along each. */
typedef struct sunder_i_reduced_crossing {
    uint32_t segment[2];
    double at[2];     /* about where along each, between 0 and 1 */
    bool first_rises; /* the first segment goes to the left of the second, which then goes to the right of it */
} sunder_i_reduced_crossing;

typedef struct sunder_i_reduced {
    sunder_i_lattice *lattice;
    sunder_i_arena small, memory; /* for the operands; for segments and all later stages */
    void *room;                   /* where that one begins, or NULL */
    sunder_i_chain_operand operand[2];
    uint32_t classes;
    sunder_i_reduced_segment *segment; /* [segments] from left to right, nearly: by x->low */
    uint32_t segments;
    uint32_t *order;             /* [segments] the number of each, by when it was made */
    sunder_i_steps_along *x, *y; /* [segments] */
    bool brief;                  /* differences of coordinates are (narrow.h) */
    sunder_i_reduced_crossing *crossing;
    size_t crossings, crossings_capacity;
    sunder_i_valued *stop; /* [2 * crossings] about where along the segment; as item the end of a crossing, which is 2 *
                              its number, and one more for the second segment */
    uint32_t *stop_end;    /* [segments] past the last stop on each */
    uint32_t *place;       /* [2 * crossings] by the end of a crossing: its stop */
} sunder_i_reduced;

/* The segment that vertex j of the other operand makes of side i of operand a; or NO_SEGMENT. */
uint32_t sunder_i_reduced_segment_of(const sunder_i_reduced *r, int a, uint32_t i, uint32_t j);
/* The segment that starts at the sum of a vertex of each operand; there is at most one (reduced_convolution.c). */
static inline uint32_t sunder_i_reduced_starting_at(const sunder_i_reduced *r, uint32_t i, uint32_t j)
{
    const uint32_t of_first = sunder_i_reduced_segment_of(r, 0, i, j);
    return of_first != SUNDER_I_NO_SEGMENT ? of_first : sunder_i_reduced_segment_of(r, 1, j, i);
}

/* Lists all segments; *fits is false where the operands are of no kind that this is for. */
bool sunder_i_reduced_build(sunder_i_reduced *r, const sunder_i_point *at[2], bool *fits);
/* Finds all stops; *fits is false where segments meet in any other way than by crossing in their insides, where doubles
 * do not tell the order of stops, or where there are too many. */
bool sunder_i_reduced_cross(sunder_i_reduced *r, bool *fits);

/* Sides of one operand with directions between those of two sides of the other, of ranks `from` and `to`, which none of
 * them shares: places in by_rank from first[k] on, up to end[k]. */
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

/* Is the turn at vertex i a left one? It is never straight. */
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

/* State for the tests of places on segments, in doubles. */
typedef struct sunder_i_place_query {
    const sunder_i_reduced *reduced;
    double error;     /* of places and coordinates, with room for what differences and products of them add */
    double *xy[2];    /* [2 * n] of each operand: the vertices' x, then their y */
    double *value;    /* [n of the second] scratch */
    uint32_t *order;  /* [n of the first] its sides, the longest first */
    uint32_t last[2]; /* the two sides that crossed last */
    size_t left;      /* budget: sides and vertices that may still be looked at */
} sunder_i_place_query;

typedef enum sunder_i_place_in_sum { SUNDER_I_INSIDE, SUNDER_I_NOT_INSIDE, SUNDER_I_UNCERTAIN } sunder_i_place_in_sum;

bool sunder_i_place_query_init(sunder_i_place_query *inside, sunder_i_reduced *r);
/* Does the place at `at` along a segment lie in the interior of the sum, int P + int Q? */
sunder_i_place_in_sum sunder_i_place_query_ask(sunder_i_place_query *inside, uint32_t segment, double at);

#endif
