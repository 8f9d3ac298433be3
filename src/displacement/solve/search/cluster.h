/* The moves of one cluster of bodies: what the rounds of solve/clusters/ ask of the search. */
#ifndef SUNDER_I_CLUSTER_H
#define SUNDER_I_CLUSTER_H

#include "displacement/layer/trace.h"
#include "sunder_proof.h"

/* What the present stage did to a cluster. */
typedef enum sunder_i_outcome {
    SUNDER_I_UNTOUCHED,
    SUNDER_I_WORKED_ON,      /* its moves are to be taken over */
    SUNDER_I_FOUND_CHEAPEST, /* likewise, and no solution is cheaper, whatever stands around the cluster */
    SUNDER_I_FOUND_NONE      /* it is brief, and no solution was found */
} sunder_i_outcome;

typedef struct sunder_i_cluster {
    uint32_t *body; /* members, ascending; fixed ones too */
    size_t n;
    double about;           /* each body looks at least this far, times a factor (surroundings.c) */
    double margin;          /* what is demanded beyond the gap, to cover rounding */
    bool touching;          /* two alone may stand without the margin: no exact check has failed yet */
    bool starts_from_areas; /* it begins from where prices of area put it */
    bool limited;           /* by limits, fixed bodies, the rule against jumps: it may have no solution */
    bool brief;             /* if no solution is found nothing is given up, and nothing moves */
    sunder_i_outcome outcome;
    sunder_bound_pair measured;       /* two features that were asked how far they have to go apart; least 0: none */
    sunder_i_relaxations relaxations; /* of pairs that its solution gave up, or in place of older ones; owned */
    sunder_i_restored *restored;      /* [restored_n] relaxations of the model that have ended; owned */
    size_t restored_n;
    sunder_i_trace_log log;  /* what its stages did, where the layer is traced; owned */
    sunder_i_id_pair *guest; /* [guests] one of its bodies, and one that is in its way and might join it; owned */
    size_t guests, guest_capacity;
} sunder_i_cluster;

/* Two bodies of a cluster with relaxations between their members, and the request to be made for these relaxations. */
typedef struct sunder_i_retry {
    uint32_t root; /* of the cluster */
    sunder_i_id_pair body;
    const uint32_t *relaxation; /* [relaxations] between members of theirs: places in the model's */
    size_t relaxations;
    size_t single;  /* 0: all of theirs, which are asked together; else which of them, by itself, from 1 on */
    bool overlap;   /* do members overlap? */
    bool resolve;   /* ask for all that is owed, of those that are not infeasible */
    bool disjoint;  /* ask, at least, that they do not overlap, those that can be parted so far */
    double missing; /* what it would take */
} sunder_i_retry;

/* ---- solve_cluster.c --------------------------------------------------------------------------------------------- */

/* Computes the least moves of a cluster's bodies from their present places, rounded; it ignores all other bodies.
 * Where limits leave no solution, it gives pairs up and solves the rest. */
sunder_status sunder_i_cluster_solve(const sunder_i_model *model, sunder_i_cluster *cluster, double *move,
                                     sunder_error *err);

/* ---- free_positions.c -------------------------------------------------------------------------------------------- */

/* May a search need the shape of a body, whatever else is in its cluster? Only the members of such bodies are
 * united. */
bool sunder_i_cluster_may_want_shape(const sunder_i_model *model, uint32_t body);

/* ---- retry_cluster.c --------------------------------------------------------------------------------------------- */

/* Pairs given up are asked once more for all that they owe, and held to it where there is a solution, the first ones
 * first. All others keep theirs, and neighbours outside the cluster stay where they are. */
sunder_status sunder_i_cluster_retry(const sunder_i_model *model, sunder_i_cluster *cluster,
                                     const sunder_i_retry *retry, size_t retries, double *move, sunder_error *err);
/* Do the two features overlap now, and could limits let them be parted, if not to the gap? */
bool sunder_i_can_be_disjoint(const sunder_i_model *model, const sunder_i_relaxation *relaxation);

/* ---- resume.c ---------------------------------------------------------------------------------------------------- */

/* The same from moves that are thought to be a solution without those relaxations, n of them, sorted: *done if it is
 * one; else moves are as they were. */
sunder_status sunder_i_cluster_resume(const sunder_i_model *model, sunder_i_cluster *cluster,
                                      const sunder_i_restored *restored, size_t n, double *move, bool *done,
                                      sunder_error *err);

/* ---- improve.c --------------------------------------------------------------------------------------------------- */

/* Better sides: the same from a free start, never dearer; neighbours outside the cluster stay where they are. */
sunder_status sunder_i_cluster_improve(const sunder_i_model *model, const sunder_i_cluster *cluster, double *move,
                                       sunder_error *err);

/* From moves that need not be free down to such as are, neighbours outside the cluster staying where they are: *found,
 * if they cost less than `cost`; rounded. */
sunder_status sunder_i_cluster_descend(const sunder_i_model *model, const sunder_i_cluster *cluster, double cost,
                                       double *move, bool *found, sunder_error *err);

/* ---- pair_margin.c ----------------------------------------------------------------------------------------------- */

/* A pair of things that is left in conflict, and that rounding made slightly worse: *done, if it and the bodies around
 * it have places where it stands better by the margin; rounded. All others keep what they owe or are held to; others:
 * moved pairs that are left in conflict get the margin, too, otherwise only those that have it. */
sunder_status sunder_i_cluster_demand_margin(const sunder_i_model *model, const sunder_i_cluster *cluster, uint32_t a,
                                             uint32_t b, bool others, double *move, bool *done, sunder_error *err);

/* ---- fit_given_up.c ---------------------------------------------------------------------------------------------- */

/* Two bodies that were given up: are there places for them and those about them that miss no more than `room` of what
 * they owe? *found, and the moves, not rounded. Others keep what they owe, or are held to, as nearly. from_home: all of
 * a small cluster begin there. */
sunder_status sunder_i_cluster_fit(const sunder_i_model *model, const sunder_i_cluster *cluster, uint32_t a, uint32_t b,
                                   double room, bool from_home, double *move, bool *found, sunder_error *err);

/* ---- blocking_neighbours.c --------------------------------------------------------------------------------------- */

/* Finds bodies of the cluster that would have a nearer place but for others that might move: pairs of the two go to
 * cluster->guest. False if memory is out. */
bool sunder_i_cluster_find_blocking(const sunder_i_model *model, sunder_i_cluster *cluster, const double *move);

#endif
