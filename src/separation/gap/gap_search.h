/* The parts of the search with a gap among themselves (gap_search.c says how it goes).
 *
 * Errors. S = M + g bounds what is computed with: M the magnitude of the operands' coordinates (operands.h; at least
 * g), so that sums of two are below 2 M, sides below 3 M in length, and |v| below 6 S for v from a corner of a subsum
 * to a point within 2 g of its box. u is the unit roundoff; first-order terms only, the rest is far less than what is
 * to spare.
 *
 *   corner   an integer is rounded once, three limbs of a wide lattice 5 times: 8 u M. Sides come from exact
 *            differences, so are off by 4 u of themselves; their lengths by 6 u, the gap by 4 u.
 *   point    a + gap n / |d| + t d, 0 <= t <= 1: corner 8 u M, the normal 4 + 4 + 6 + 2 = 16 u g, t d 5 u * 3 M, sums
 *            2 u * 4 S: below 32 u S a coordinate, 48 u S in all. Feet, ends and the points of circles nearest to the
 *            origin have no more steps. What is found by a division that loses digits carries an error of its own.
 *   height   of a point over a side, cross(side, v) / length: v is off by 8 u M + 6 u S a coordinate, that makes 20 u
 *            S; each product by (4 + 1) u |side| |v|, their difference by one u more: 36 u S; length and division 7 u
 *            of at most 6 S: 42 u S. Below 100 u S in all.
 *   distance from a side as its height; from a corner 20 u S + 2 u * 6 S. Whether the corner or the side is nearer is
 *            judged by a product that is off as the height is, and where it is judged wrongly the two distances differ
 *            by no more than that: below 200 u S.
 *
 * `error` = 128 u S bounds that of a point, and `margin` = 2 error that of a distance from a point so computed (48 +
 * 200 u S). Sides shorter than SUNDER_I_SHORTEST take no part in any of this. */
#ifndef SUNDER_I_GAP_SEARCH_H
#define SUNDER_I_GAP_SEARCH_H

#include "separation/gap/gap.h"

/* A subsum as the search wants it. */
typedef struct sunder_i_gap_subsum {
    uint32_t n; /* 0: not loaded */
    bool vague; /* a side is lost below the range of doubles: nothing is concluded */
    const double *cx, *cy, *sx, *sy;
    double *length, *inverse; /* 1 / length */
} sunder_i_gap_subsum;

typedef struct sunder_i_gap_item {
    double key;
    enum { SUNDER_I_GAP_SEGMENT, SUNDER_I_GAP_ARC, SUNDER_I_GAP_POINT } kind;
    size_t index;
} sunder_i_gap_item;

/* What touches at a point: a corner of a subsum, or the inside of a side. (nx, ny): the unit vector from there. */
typedef struct sunder_i_gap_contact {
    double nx, ny;
    bool flat;
    uint32_t at; /* the number of the side or corner */
    size_t of;   /* the subsum */
} sunder_i_gap_contact;

/* A point that may be free: the foot of a curve, or where two cross. */
typedef struct sunder_i_gap_point {
    double x, y, error;
    sunder_i_gap_curve c, d; /* a foot has c only */
    bool crossing;
    int sign;                 /* which of two crossings */
    bool forwards, backwards; /* if it is covered: go on along the segment */
    size_t segment;
    long cover;                       /* it is to be where c leaves this grown subsum; -1: it is not */
    const sunder_i_surd_point *exact; /* exactly; NULL if not asked for yet */
} sunder_i_gap_point;

/* A free point, with all that touches there. */
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
    double best; /* nothing farther counts: the limit, or the length of the best answer and its error */
    sunder_i_gap_subsum *pieces;
    sunder_i_gap_item *heap;
    size_t heap_n, heap_capacity;
    sunder_i_gap_point *points;
    size_t points_n, points_capacity;
    size_t hint;  /* the subsum that covered the last point */
    size_t *arcs; /* circles taken off the heap so far */
    size_t arcs_n;
    sunder_i_gap_free_point found; /* the nearest */
    bool failed;                   /* memory is out */
} sunder_i_gap_state;

/* ---- Numbers, and what covers a point (covered_point.c) ---- */

/* v * 2^exponent, within 4 u of itself. */
double sunder_i_gap_big(sunder_i_big v, long exponent);
double sunder_i_gap_length(double x, double y);
/* The point's coordinates in units, off by less than an `error`. */
void sunder_i_gap_doubles(sunder_i_gap_state *s, const sunder_i_surd_point *exact, double *x, double *y);

/* The numbers of the *n subsums to be asked about a point (gap.h); NULL: all, the last that was of use first. */
const uint32_t *sunder_i_gap_near(const sunder_i_gap_state *s, double x, double y, size_t *n);

/* The i-th of these. */
static inline size_t sunder_i_gap_nth(const sunder_i_gap_state *s, const uint32_t *near, size_t i)
{
    if (near) return near[i];
    const size_t k = s->hint + i;
    return k < s->g->subsums ? k : k - s->g->subsums;
}

/* NULL if memory is out. */
const sunder_i_gap_subsum *sunder_i_gap_load(sunder_i_gap_state *s, size_t k);
/* May the point be within `reach` of subsum k at all? */
bool sunder_i_gap_near_box(const sunder_i_gap_state *s, size_t k, double x, double y, double reach);
/* Distance from a piece, 0 inside, within 200 u S. */
double sunder_i_gap_distance(const sunder_i_gap_state *s, const sunder_i_gap_subsum *piece, double x, double y);
/* Does grown subsum k cover all that is within `slack` of the computed point, for certain? */
bool sunder_i_gap_covers(sunder_i_gap_state *s, size_t k, double x, double y, double slack);
/* A grown subsum that covers the point for certain; -1 if none is known to. */
long sunder_i_gap_cover(sunder_i_gap_state *s, double x, double y, double slack);
/* The same other than `but` (-1: any). */
long sunder_i_gap_other_cover(sunder_i_gap_state *s, double x, double y, long but);
/* Is the point inside a subsum itself, for certain? Then its whole circle is covered. */
bool sunder_i_gap_deep_inside(sunder_i_gap_state *s, double x, double y);

/* ---- Exact places (boundary_points.c) ---- */

/* The exact place of a point; NULL if its curves do not meet, or memory is out. */
const sunder_i_surd_point *sunder_i_gap_solve(sunder_i_gap_state *s, sunder_i_gap_point *p);

/* ---- Along moved sides and round arcs (segments.c, circle_points.c) ---- */

void sunder_i_gap_take_segment(sunder_i_gap_state *s, size_t segment);
/* From a point of a segment's line that grown subsum k covers, exactly or for certain, to where the line leaves it. */
void sunder_i_gap_pass(sunder_i_gap_state *s, const sunder_i_gap_point *from, size_t k, bool forwards);
void sunder_i_gap_take_arc(sunder_i_gap_state *s, size_t arc);

/* ---- Points (points.c) ---- */

void sunder_i_gap_take_point(sunder_i_gap_state *s, size_t index);
/* Does the point keep the gap from all subsums? Exact. */
bool sunder_i_gap_is_free(sunder_i_gap_state *s, const sunder_i_surd_point *at);

/* ---- The way off (step_to_rational.c) ---- */

typedef enum sunder_i_gap_room {
    SUNDER_I_ROOM_NONE, /* held on all sides */
    SUNDER_I_ROOM_LINE, /* only along a line, or one half of it */
    SUNDER_I_ROOM_OPEN,
    SUNDER_I_ROOM_HALF /* all contacts are on one side, opposite the same direction */
} sunder_i_gap_room;

/* Where one can go from a free point: the directions u with u . n >= 0 for all contacts' normals n. They lie between
 * the normal of contact `left` turned left and that of contact `right` turned right; -1: that is no way to go. */
typedef struct sunder_i_gap_way {
    sunder_i_gap_room room;
    long left, right;
} sunder_i_gap_way;

sunder_i_gap_way sunder_i_gap_way_off(sunder_i_gap_state *s, const sunder_i_gap_free_point *at);
/* A rational free point no farther than 1 + SUNDER_I_GAP_LONGER times as far as the irrational one found, which stands
 * at xy / 2^bits to 72 digits. */
bool sunder_i_gap_rational_beside(sunder_i_gap_state *s, const sunder_i_gap_free_point *found,
                                  const sunder_i_gap_way *way, const sunder_i_big xy[2], unsigned long bits,
                                  sunder_i_surd_point *out);

/* ---- The heap (gap_heap.c) ---- */

/* Adds an item, or a point with its key, that is not beyond the best answer. s->failed if memory is out. */
void sunder_i_gap_push_item(sunder_i_gap_state *s, sunder_i_gap_item item);
void sunder_i_gap_push(sunder_i_gap_state *s, double key, const sunder_i_gap_point *p);
/* Takes the item with the least key off. */
sunder_i_gap_item sunder_i_gap_pop_item(sunder_i_gap_state *s);

#endif
