/* Layers of a few features with convex parts, beside barriers, that are degenerate in every way: on a coarse grid, so
 * that they touch, share edges, contain each other and lie in each other's courtyards. Also the same layers as problems
 * of optimum.h. */
#ifndef SUNDER_TESTS_HAMLET_H
#define SUNDER_TESTS_HAMLET_H

#include "optimum.h"
#include "random.h"

#include "sunder.h"

#include <stdint.h>

enum {
    HAMLET_HOUSES = 5,
    HAMLET_BARRIERS = 2,
    HAMLET_CLASSES = 3,
    HOUSE_PARTS = 4,
    HOUSE_CORNERS = 16,
    BARRIER_POINTS = 4
};

typedef struct house_part {
    double xy[8]; /* counter-clockwise */
    size_t corners;
} house_part;

typedef struct house {
    house_part part[HOUSE_PARTS];
    size_t parts;
    double xy[2 * HOUSE_CORNERS]; /* the outline, and that of a courtyard */
    size_t ring_end[2], rings;
    double weight, limit, preferred[2];
    int64_t block;
    uint32_t of; /* its class for gaps */
    bool fixed, may_jump;
} house;

/* A box, or a line, or a point. */
typedef struct hamlet_barrier {
    double xy[2 * BARRIER_POINTS];
    size_t points;
    bool area, side;
    double width, gap; /* a negative gap means that of the layer */
    uint32_t of;       /* its class for gaps */
} hamlet_barrier;

typedef struct hamlet {
    house house[HAMLET_HOUSES];
    size_t n;
    hamlet_barrier barrier[HAMLET_BARRIERS];
    size_t barriers;
    double gap;
    double class_gap[HAMLET_CLASSES * HAMLET_CLASSES]; /* symmetric; none is greater than the gap */
    bool classes;                                      /* do these gaps count? */
    bool jumps;                                        /* are jumps allowed? */
    bool preferred;                                    /* do features prefer other places than their own? */
} hamlet;

typedef enum hamlet_kind {
    HAMLET_PLAIN,
    HAMLET_BARRIERS_TOO = 1, /* barriers that may be crossed */
    HAMLET_NO_JUMPS = 2,
    HAMLET_SIDES = 4,     /* also barriers that may not be crossed; these meet no feature */
    HAMLET_PREFERRED = 8, /* features may prefer other places than their own */
    HAMLET_CLASSED = 16,  /* gaps depend on the classes of the two */
    HAMLET_SYMBOLS = 32   /* some features may jump, and be jumped over, though others may not */
} hamlet_kind;

/* Makes n features. kinds: the allowed kinds of features. */
void hamlet_found(rng *r, hamlet *t, size_t n, int kinds);
/* Separates with the given blocks only, tolerance 0, and no feature allowed within another. */
sunder_report *hamlet_separate(const hamlet *t, double effort);

/* The rules that a problem contains. */
typedef enum hamlet_rules {
    HAMLET_APART = 1,
    HAMLET_KEEP_SIDES = 2,
    HAMLET_KEEP_FROM_JUMPS = 4,
    HAMLET_ALL = 7
} hamlet_rules;

/* Makes a problem of the whole layer, with relaxed requirements on listed pairs (except on their paths). A listed pair
 * that did not overlap has to keep its former distance. For a listed pair that overlapped, if `besides` is NULL: if it
 * is listed as too close, it has to be disjoint; if it still overlaps, it may not get deeper, unless one was inside the
 * other, in which case it may. If `besides` is given, that pair has to keep its full distance, and listed pairs that
 * overlapped have no requirement. */
void hamlet_pose(const hamlet *t, const sunder_conflict *listed, size_t n, const sunder_conflict *besides,
                 optimum_problem *m);
/* Makes a problem of one pair by itself; depending on `rules` also with the sides of all barriers for both features and
 * their blocks, and with the rule that these do not jump over each other. */
void hamlet_pose_pair(const hamlet *t, const sunder_conflict *pair, int rules, optimum_problem *m);

#endif
