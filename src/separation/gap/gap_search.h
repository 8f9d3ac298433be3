/* gap_search.h: declarations shared by the files of the search with a gap (gap_search.c describes it).
 *
 * Errors. S = M + g is a bound of the numbers: M is the magnitude of the operands' coordinates (operands.h; at least
 * g), so that sums of two are below 2 M, sides are shorter than 3 M, and |v| < 6 S for a vector v from a vertex of a
 * subsum to a point within 2 g of its box. u is the unit roundoff. Only terms of first order are listed; the rest is
 * far less than what the bounds allow.
 *
 *   corner   an integer is rounded once, three limbs of a wide lattice 5 times: 8 u M. Sides are computed from exact
 *            differences and have an error of 4 u of their length; lengths have one of 6 u, the gap one of 4 u.
 *   point    a + gap n / |d| + t d, 0 <= t <= 1: vertex 8 u M, normal 4 + 4 + 6 + 2 = 16 u g, t d 5 u * 3 M, sums
 *            2 u * 4 S: below 32 u S in each coordinate, 48 u S in all. Feet, ends and the points of circles nearest to
 *            the origin need no more operations. A point computed by a division that loses digits has its own error.
 *   height   of a point over a side, cross(side, v) / length: v has an error of 8 u M + 6 u S in each coordinate, which
 *            causes 20 u S; each product adds (4 + 1) u |side| |v|, their difference one u more: 36 u S; length and
 *            division add 7 u of at most 6 S: 42 u S. Below 100 u S in all.
 *   distance from a side: as its height; from a vertex: 20 u S + 2 u * 6 S. Whether the vertex or the side is nearer is
 *            decided by a product with the error of a height; if it is decided wrongly, the two distances differ by at
 *            most that: below 200 u S.
 *
 * `error` = 128 u S bounds the error of a point, and `margin` = 2 error that of a distance from a computed point (48 +
 * 200 u S). Sides shorter than SUNDER_I_SHORTEST are excluded from all this. */
#ifndef SUNDER_I_GAP_SEARCH_H
#define SUNDER_I_GAP_SEARCH_H

#include "separation/gap/gap.h"

/* A subsum in doubles, in the form that the search uses. */
typedef struct sunder_i_gap_subsum {
    uint32_t n; /* the number of sides; 0: not loaded yet */
    bool vague; /* a side is below the range of doubles, so that doubles decide nothing about this subsum */
    const double *cx, *cy, *sx, *sy;
    double *length, *inverse; /* 1 / length */
} sunder_i_gap_subsum;

typedef struct sunder_i_gap_item {
    double key;
    enum { SUNDER_I_GAP_SEGMENT, SUNDER_I_GAP_ARC, SUNDER_I_GAP_POINT } kind;
    size_t index;
} sunder_i_gap_item;

/* A contact of a subsum with a point: a vertex of the subsum, or an inner point of a side. (nx, ny) is the unit vector
 * from there to the point. */
typedef struct sunder_i_gap_contact {
    double nx, ny;
    bool flat;
    uint32_t at; /* the number of the side (flat) or vertex */
    size_t of;   /* the number of the subsum */
} sunder_i_gap_contact;

/* A point that may be free: the foot of the perpendicular on a curve, or the crossing of two curves. */
typedef struct sunder_i_gap_point {
    double x, y, error;
    sunder_i_gap_curve c, d; /* a foot uses c only */
    bool crossing;
    int sign;                 /* selects one of two crossings (find_crossing() in boundary_points.c) */
    bool forwards, backwards; /* if the point is covered: continue along the segment in this direction */
    size_t segment;
    long cover;                       /* c is expected to leave this grown subsum here; -1: not */
    const sunder_i_surd_point *exact; /* the exact point; NULL: not computed yet */
} sunder_i_gap_point;

/* A free point, with all its contacts. */
typedef struct sunder_i_gap_free_point {
    bool any;
    sunder_i_surd_point exact;
    double x, y, error;
    sunder_i_gap_contact *contact;
    size_t contacts;
    sunder_contact kind;
} sunder_i_gap_free_point;

typedef struct sunder_i_gap_state {
    const sunder_i_gap_problem *p;
    sunder_i_operands *g;
    double gap, error, margin;
    double best; /* points farther than this are discarded: the limit, or the length of the best answer plus its
                  * error */
    sunder_i_gap_subsum *pieces;
    sunder_i_gap_item *heap;
    size_t heap_n, heap_capacity;
    sunder_i_gap_point *points;
    size_t points_n, points_capacity;
    size_t hint;  /* the subsum that covered the previous point */
    size_t *arcs; /* [arcs_n] the circles taken from the heap so far */
    size_t arcs_n;
    sunder_i_gap_free_point found; /* the nearest free point so far */
    bool failed;                   /* out of memory */
} sunder_i_gap_state;

/* ---- Doubles, and what covers a point (covered_point.c) ---- */

/* Returns v * 2^exponent with a relative error of at most 4 u. */
double sunder_i_gap_big(sunder_i_big v, long exponent);
double sunder_i_gap_length(double x, double y);
/* Converts the point to doubles in units, with an error below s->error. */
void sunder_i_gap_doubles(sunder_i_gap_state *s, const sunder_i_surd_point *exact, double *x, double *y);

/* Returns the numbers of the *n subsums to be tested for a point (gap.h); NULL: all, beginning with s->hint. */
const uint32_t *sunder_i_gap_near(const sunder_i_gap_state *s, double x, double y, size_t *n);

/* Returns the i-th subsum of the list `near` that sunder_i_gap_near() returned; of all subsums if `near` is NULL. */
static inline size_t sunder_i_gap_nth(const sunder_i_gap_state *s, const uint32_t *near, size_t i)
{
    if (near) return near[i];
    const size_t k = s->hint + i;
    return k < s->g->subsums ? k : k - s->g->subsums;
}

/* Returns subsum k in doubles, computing it on the first call; NULL if out of memory. */
const sunder_i_gap_subsum *sunder_i_gap_load(sunder_i_gap_state *s, size_t k);
/* Returns whether the point may be within `reach` of subsum k, by its box. */
bool sunder_i_gap_near_box(const sunder_i_gap_state *s, size_t k, double x, double y, double reach);
/* Returns the distance of the point from a piece, 0 inside, with an error of at most 200 u S. */
double sunder_i_gap_distance(const sunder_i_gap_state *s, const sunder_i_gap_subsum *piece, double x, double y);
/* Returns whether the grown subsum k certainly covers all points within `slack` of the computed point. */
bool sunder_i_gap_covers(sunder_i_gap_state *s, size_t k, double x, double y, double slack);
/* Returns the number of a grown subsum for which sunder_i_gap_covers() is true; -1 if there is none. */
long sunder_i_gap_cover(sunder_i_gap_state *s, double x, double y, double slack);
/* Does the same as sunder_i_gap_cover() with slack 0, for all subsums except number `but` (-1: for all). */
long sunder_i_gap_other_cover(sunder_i_gap_state *s, double x, double y, long but);
/* Returns whether the point is certainly inside a subsum without the gap; then its whole circle is covered. */
bool sunder_i_gap_deep_inside(sunder_i_gap_state *s, double x, double y);

/* ---- Exact points (boundary_points.c) ---- */

/* Returns the exact point; NULL if its curves do not meet, or if out of memory (s->failed). */
const sunder_i_surd_point *sunder_i_gap_solve(sunder_i_gap_state *s, sunder_i_gap_point *p);

/* ---- Offset sides and arcs (segments.c, circle_points.c) ---- */

void sunder_i_gap_take_segment(sunder_i_gap_state *s, size_t segment);
/* Continues from a point of a segment's line that the grown subsum k covers, exactly or certainly, to the point where
 * the line leaves that subsum; pushes that point. */
void sunder_i_gap_pass(sunder_i_gap_state *s, const sunder_i_gap_point *from, size_t k, bool forwards);
void sunder_i_gap_take_arc(sunder_i_gap_state *s, size_t arc);

/* ---- Points (points.c) ---- */

void sunder_i_gap_take_point(sunder_i_gap_state *s, size_t index);
/* Returns whether the point keeps the gap from all subsums. Exact. */
bool sunder_i_gap_is_free(sunder_i_gap_state *s, const sunder_i_surd_point *at);

/* ---- Directions from a free point (step_to_rational.c) ---- */

typedef enum sunder_i_gap_room {
    SUNDER_I_ROOM_NONE, /* every direction is blocked */
    SUNDER_I_ROOM_LINE, /* only one direction, or two opposite ones, are free */
    SUNDER_I_ROOM_OPEN,
    SUNDER_I_ROOM_HALF /* all contacts have the same normal, so that a half-plane is free */
} sunder_i_gap_room;

/* The free directions at a point: the directions u with u . n >= 0 for the normals n of all contacts. They lie between
 * the normal of contact `left` turned left and the normal of contact `right` turned right; -1: there is no such
 * contact. */
typedef struct sunder_i_gap_way {
    sunder_i_gap_room room;
    long left, right;
} sunder_i_gap_way;

sunder_i_gap_way sunder_i_gap_way_off(sunder_i_gap_state *s, const sunder_i_gap_free_point *at);
/* *out becomes a rational free point whose length is at most 1 + SUNDER_I_GAP_LONGER times that of the irrational point
 * `found`; xy / 2^bits is that point to 72 bits. Returns false if none is found. */
bool sunder_i_gap_rational_beside(sunder_i_gap_state *s, const sunder_i_gap_free_point *found,
                                  const sunder_i_gap_way *way, const sunder_i_big xy[2], unsigned long bits,
                                  sunder_i_surd_point *out);

/* ---- The priority queue (gap_heap.c) ---- */

/* Push an item, or a point with its key, unless it is farther than the best answer. s->failed is set if out of
 * memory. */
void sunder_i_gap_push_item(sunder_i_gap_state *s, sunder_i_gap_item item);
void sunder_i_gap_push(sunder_i_gap_state *s, double key, const sunder_i_gap_point *p);
/* Removes and returns the item with the least key. */
sunder_i_gap_item sunder_i_gap_pop_item(sunder_i_gap_state *s);

#endif
