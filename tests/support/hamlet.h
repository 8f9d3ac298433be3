/* Layers of a few features of convex parts, beside barriers, that are degenerate in every way: on a coarse grid, so
 * that they touch, share edges, lie in each other and in each other's yards; the same as problems of optimum.h. */
#ifndef SUNDER_TESTS_HAMLET_H
#define SUNDER_TESTS_HAMLET_H

#include "optimum.h"
#include "random.h"

#include "sunder.h"

#include <stdint.h>

enum { HAMLET_HOUSES = 5, HAMLET_BARRIERS = 2, HOUSE_PARTS = 4, HOUSE_CORNERS = 16, BARRIER_POINTS = 4 };

typedef struct house_part {
    double xy[8]; /* counter-clockwise */
    size_t corners;
} house_part;

typedef struct house {
    house_part part[HOUSE_PARTS];
    size_t parts;
    double xy[2 * HOUSE_CORNERS]; /* the outline, and that of a yard */
    size_t ring_end[2], rings;
    double weight, limit;
    int64_t block;
    bool fixed;
} house;

/* A box, or a line, or a point. */
typedef struct hamlet_barrier {
    double xy[2 * BARRIER_POINTS];
    size_t points;
    bool area, side;
    double width, gap; /* the gap is negative: the layer's */
} hamlet_barrier;

typedef struct hamlet {
    house house[HAMLET_HOUSES];
    size_t n;
    hamlet_barrier barrier[HAMLET_BARRIERS];
    size_t barriers;
    double gap;
    bool jumps; /* are allowed */
} hamlet;

typedef enum hamlet_kind {
    HAMLET_PLAIN,
    HAMLET_BARRIERS_TOO = 1, /* barriers that may be crossed */
    HAMLET_NO_JUMPS = 2,
    HAMLET_SIDES = 4 /* some barriers may not be crossed: such as meet no feature */
} hamlet_kind;

/* Makes n features. kinds: the allowed kinds of features. */
void hamlet_found(rng *r, hamlet *t, size_t n, int kinds);
/* Separates with the given blocks only, tolerance 0, and no feature allowed within another. */
sunder_report *hamlet_separate(const hamlet *t, double effort);

/* Which rules a problem holds to. */
typedef enum hamlet_rules {
    HAMLET_APART = 1,
    HAMLET_KEEP_SIDES = 2,
    HAMLET_KEEP_FROM_JUMPS = 4,
    HAMLET_ALL = 7
} hamlet_rules;

/* Poses the whole layer, with relaxed demands on listed pairs (their ways excepted). A listed pair that did not overlap
 * has to keep its former distance. For one that overlapped, with `besides` NULL: if it is listed as too close, it has
 * to be disjoint; if it still overlaps, it may be no deeper, unless one could go deeper because it lay in the other.
 * With `besides` that pair owes its full distance, and pairs that overlapped owe nothing. */
void hamlet_pose(const hamlet *t, const sunder_conflict *listed, size_t n, const sunder_conflict *besides,
                 optimum_problem *m);
/* Poses one pair by itself; depending on `rules` with the sides of both and their blocks towards all barriers, and with
 * the paths of these past each other. */
void hamlet_pose_pair(const hamlet *t, const sunder_conflict *pair, int rules, optimum_problem *m);

#endif
