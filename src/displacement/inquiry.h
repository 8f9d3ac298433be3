/* The state of an inquiry into a few bodies (certify.c), and its parts: one node's program, its candidate, the
 * branches. */
#ifndef SUNDER_I_INQUIRY_H
#define SUNDER_I_INQUIRY_H

#include "displacement/region.h"

/* Overlaps of a candidate that are weighed against each other. */
#define SUNDER_I_CHOICES 8
/* Overlaps and oversteps of no more than this share of the longest limit are left to the search; programs ask for as
 * much beyond the regions, so that their softness does not show in a candidate. */
#define SUNDER_I_INQUIRY_TOLERANCE 1e-5

/* Two bodies that came into each other's way. */
typedef struct sunder_i_duo {
    uint32_t i, j; /* places in sunder_i_inquiry.body */
    sunder_i_obstruction obstruction;
    sunder_i_region region;
} sunder_i_duo;

/* A line that an obstacle may be passed by. */
typedef struct sunder_i_passage {
    double n[2], h; /* places beyond it have n.u >= h */
    double at;      /* n.u - h of the candidate */
} sunder_i_passage;

/* One choice: by which line a pair passes an obstacle. */
typedef struct sunder_i_branch {
    size_t pair;
    sunder_i_region whole; /* the pair's region before */
    sunder_i_region rest;  /* ... less what earlier lines let pass */
    size_t edge, edges, next;
} sunder_i_branch;

typedef struct sunder_i_inquiry {
    const sunder_i_town *town;
    uint32_t *body; /* ascending */
    size_t bodies;
    double *limit, *mass, *net; /* [bodies], [bodies], [2 * bodies] */
    double longest;             /* limit */
    sunder_i_duo *pair;
    size_t pairs, pair_capacity;
    sunder_i_branch *stack;
    size_t depth, stack_capacity;
    sunder_i_passage *edge; /* of all branches on the stack */
    size_t edges, edge_capacity;
    sunder_i_quadratic program;
    sunder_i_scratch scratch;
} sunder_i_inquiry;

/* ---- certificate.c ---- */

/* Solves the program of this node. *shown: it is void; else the program's solution is a candidate. */
sunder_status sunder_i_inquiry_solve(sunder_i_inquiry *inquiry, uint64_t most_work, bool *shown, sunder_error *err);

/* ---- candidate.c ---- */

/* Two convex pieces that the candidate has in each other. */
typedef struct sunder_i_meeting {
    uint32_t i, j;
    double depth;
    const sunder_i_piece *a, *b;
} sunder_i_meeting;

/* Could members of the two get to where they have leave to overlap? */
bool sunder_i_inquiry_may_overlap(const sunder_i_inquiry *inquiry, uint32_t i, uint32_t j);
/* The deepest overlaps of the candidate, one of each pair, deepest first; returns how many. */
size_t sunder_i_inquiry_meetings(sunder_i_inquiry *inquiry, sunder_i_meeting deepest[SUNDER_I_CHOICES]);
/* The lines that the two pieces' difference can be passed by, the one nearest to the candidate first: into
 * inquiry->edge, from inquiry->edges on. Returns how many, 0 if memory is out. */
size_t sunder_i_inquiry_passages(sunder_i_inquiry *inquiry, const sunder_i_meeting *meeting);

/* ---- branches.c ---- */

sunder_status sunder_i_inquiry_add_pair(sunder_i_inquiry *inquiry, uint32_t i, uint32_t j, sunder_error *err);
/* Opens a choice between the ways out of one of the n meetings: the one that has the fewest. */
sunder_status sunder_i_inquiry_open(sunder_i_inquiry *inquiry, const sunder_i_meeting *deepest, size_t n,
                                    sunder_error *err);
/* Goes on to the next way that is open; false where all are done. */
bool sunder_i_inquiry_next(sunder_i_inquiry *inquiry);

#endif
