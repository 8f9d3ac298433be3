/* The least cost of separating a few bodies, by an independent branch and bound: for tests of the library's statements
 * about its own results. Shares no code with src/.
 *
 * A body moves by t, no farther than its limit; its cost is weight * |t - p|^2, with the move p that it prefers. A
 * piece forbids a set of relative moves u = t_b - t_a of two bodies. */
#ifndef SUNDER_TESTS_OPTIMUM_H
#define SUNDER_TESTS_OPTIMUM_H

#include <stdbool.h>
#include <stddef.h>

enum { OPTIMUM_BODIES = 6, OPTIMUM_CORNERS = 12 };

typedef struct optimum_body {
    double weight, limit; /* limit 0: fixed; INFINITY: none */
} optimum_body;

/* An open convex set: all places nearer than the radius to the polygon's interior; with a negative radius all places
 * inside the polygon that are farther than |radius| from its outside; or a shadow, which is unbounded, with its sides
 * moved outward by the radius. */
typedef struct optimum_piece {
    size_t a, b; /* bodies */
    double radius;
    size_t corners;
    double xy[2 * OPTIMUM_CORNERS]; /* counter-clockwise; of a shadow the near side, whose ends continue away from the
                              * origin */
    bool shadow;
} optimum_piece;

typedef struct optimum_problem {
    optimum_body body[OPTIMUM_BODIES];
    size_t bodies;
    double preferred[2 * OPTIMUM_BODIES]; /* the move of each body that costs nothing; 0 for fixed ones */
    optimum_piece *piece;
    size_t pieces, room;
} optimum_problem;

/* Forbids that body b with the convex part q comes nearer than the radius to body a with the convex part p, at least
 * one of which has an area; with radius 0, that their interiors meet; with a negative radius, that they overlap so
 * deeply that no translation of that length separates them. Corners are counter-clockwise, and multiples of 2^-10 below
 * 2^23, so that differences and orientations of three are exact. */
void optimum_keep_apart(optimum_problem *m, size_t a, size_t b, const double *p, size_t np, const double *q, size_t nq,
                        double radius);
/* The path of an anchor of body b, relative to body a, may not meet the convex part q of a. The anchor is outside. */
void optimum_keep_off(optimum_problem *m, size_t a, size_t b, const double *q, size_t nq, const double anchor[2]);
void optimum_free(optimum_problem *m);

typedef struct optimum_answer {
    double low, high; /* the optimum lies between the two; both INFINITY: it is at least `below` */
    bool open;        /* there were too many nodes, or a certificate was not valid: `low` is what was proved by then */
    size_t nodes;
} optimum_answer;

/* The optimum, if it is less than `below`, which is finite. `low` is proved: each node's bound is a value of the dual
 * minus its own rounding error. `high` is the cost of a place that violates its requirements by at most 1e-9. Unless
 * `open` is set, the two differ by at most the share `relative`, and 1e-10. */
optimum_answer optimum_find(const optimum_problem *m, double below, double relative, size_t most_nodes);

#endif
