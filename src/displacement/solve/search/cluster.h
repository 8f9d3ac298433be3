/* The moves of one cluster of bodies: the interface of the search for solve/clusters/. */
#ifndef SUNDER_I_CLUSTER_H
#define SUNDER_I_CLUSTER_H

#include "displacement/layer/trace.h"
#include "sunder_proof.h"

/* What the present stage did to a cluster. */
typedef enum sunder_i_outcome {
    SUNDER_I_UNTOUCHED,
    SUNDER_I_WORKED_ON,      /* its new moves are to be used */
    SUNDER_I_FOUND_CHEAPEST, /* likewise, and no other layout of the cluster is cheaper, wherever other bodies stand */
    SUNDER_I_FOUND_NONE      /* no solution was found, and `brief` is set */
} sunder_i_outcome;

typedef struct sunder_i_cluster {
    uint32_t *body; /* [n] members, ascending, including fixed ones */
    size_t n;
    double about;           /* a lower bound of how far each body looks around itself, times a factor
                             * (surroundings.c) */
    double margin;          /* the distance demanded beyond the gap, to cover rounding */
    bool touching;          /* a lone pair may do without the margin, since no exact check has failed so far */
    bool starts_from_areas; /* a crowd that starts from positions computed from prices of area */
    bool limited;           /* limits, fixed bodies or the rule against jumps may leave no solution */
    bool brief;             /* if no solution is found, no pair is given up, and no body moves */
    sunder_i_outcome outcome;
    sunder_bound_pair measured;       /* two features and their least separation, if it was computed; least 0: it was
                                       * not */
    sunder_i_relaxations relaxations; /* of pairs that were given up; they replace older ones; owned */
    sunder_i_restored *restored;      /* [restored_n] relaxations of the model that no longer hold; owned */
    size_t restored_n;
    sunder_i_trace_log log;  /* steps of its stages, if the layer is traced; owned */
    sunder_i_id_pair *guest; /* [guests] one of its bodies, and a body outside that blocks it and might join; owned */
    size_t guests, guest_capacity;
} sunder_i_cluster;

/* A request to end the relaxations between the members of two bodies of a cluster. */
typedef struct sunder_i_retry {
    uint32_t root; /* root of the cluster */
    sunder_i_id_pair body;
    const uint32_t *relaxation; /* [relaxations] indices into the model's relaxations */
    size_t relaxations;
    size_t single;  /* 0: all relaxations between the two bodies, together; k > 0: the k-th of them alone */
    bool overlap;   /* members of the two bodies overlap */
    bool resolve;   /* the full distance may be demanded: not all relaxations are infeasible */
    bool disjoint;  /* at least the end of the overlap may be demanded: limits allow it */
    double missing; /* the move that is needed, roughly */
} sunder_i_retry;

/* ---- solve_cluster.c --------------------------------------------------------------------------------------------- */

/* Computes the least moves of a cluster's bodies from their present places, rounded, ignoring all other bodies. If no
 * solution is found, pairs are given up and the rest is solved. */
sunder_status sunder_i_cluster_solve(const sunder_i_model *model, sunder_i_cluster *cluster, double *move,
                                     sunder_error *err);

/* ---- free_positions.c -------------------------------------------------------------------------------------------- */

/* May a search need the united shape of the body, in whatever cluster it is? The members of other bodies need not be
 * united. */
bool sunder_i_cluster_may_want_shape(const sunder_i_model *model, uint32_t body);
/* Finds the free places of one body among all others, where these stand now, nearest to the place that it prefers
 * first: at most `most`, within `limit` of it. No margin is kept, so a place may be exactly as wide as the body. False
 * if memory is out, or the run was stopped. */
bool sunder_i_cluster_free_places(const sunder_i_model *model, uint32_t body, double limit, size_t most,
                                  double (*places)[2], size_t *n);

/* ---- retry_cluster.c --------------------------------------------------------------------------------------------- */

/* Demands the full distance of given-up pairs again, in the order of `retry`; a pair for which there is a solution
 * keeps it from then on. All other relaxations hold, and bodies outside the cluster keep their places. */
sunder_status sunder_i_cluster_retry(const sunder_i_model *model, sunder_i_cluster *cluster,
                                     const sunder_i_retry *retry, size_t retries, double *move, sunder_error *err);
/* Does the relaxation leave an overlap that might end without the full distance being kept? That needs a full distance
 * greater than 0, and limits of the two bodies that together reach the depth of the overlap. */
bool sunder_i_can_be_disjoint(const sunder_i_model *model, const sunder_i_relaxation *relaxation);

/* ---- resume.c ---------------------------------------------------------------------------------------------------- */

/* Descends from moves that are presumably a solution without the n sorted relaxations `restored`. *done if that ends
 * without clashes; otherwise the moves do not change. */
sunder_status sunder_i_cluster_resume(const sunder_i_model *model, sunder_i_cluster *cluster,
                                      const sunder_i_restored *restored, size_t n, double *move, bool *done,
                                      sunder_error *err);

/* ---- improve.c --------------------------------------------------------------------------------------------------- */

/* Searches for better sides, starting from a layout without clashes. The result is never more expensive. Bodies outside
 * the cluster keep their places. */
sunder_status sunder_i_cluster_improve(const sunder_i_model *model, sunder_i_cluster *cluster, double *move,
                                       sunder_error *err);

/* Descends from moves that may clash, while bodies outside the cluster keep their places. *found if that ends in a
 * layout without clashes that costs less than `cost`; the moves are rounded then. */
sunder_status sunder_i_cluster_descend(const sunder_i_model *model, const sunder_i_cluster *cluster, double cost,
                                       double *move, bool *found, sunder_error *err);

/* ---- ease_cluster.c ---------------------------------------------------------------------------------------------- */

/* Eases the pairs of the cluster that are left in conflict, from a layout without clashes. Bodies outside the cluster
 * keep their places; those that are in the way are added to cluster->guest. *done if that costs less; the moves are
 * rounded then. *cost is what the moves, old or new, cost. */
sunder_status sunder_i_cluster_ease(const sunder_i_model *model, sunder_i_cluster *cluster, double *move, double *cost,
                                    bool *done, sunder_error *err);
/* The same from other moves of the cluster, start[2 * n], which may clash a little. *done if that costs less than
 * *cost. */
sunder_status sunder_i_cluster_ease_from(const sunder_i_model *model, const sunder_i_cluster *cluster,
                                         const double *start, double *move, double *cost, bool *done,
                                         sunder_error *err);

/* ---- pair_margin.c ----------------------------------------------------------------------------------------------- */

/* For a pair of things a and b that is left in conflict and that rounding has made slightly worse than at the start:
 * demands the margin for it in addition, and moves it and bodies around it. Other pairs keep their demands. others: the
 * margin is also demanded of other pairs left in conflict that have moved; otherwise only of those of them that keep it
 * now. *done if there is a solution; its moves are rounded. */
sunder_status sunder_i_cluster_demand_margin(const sunder_i_model *model, const sunder_i_cluster *cluster, uint32_t a,
                                             uint32_t b, bool others, double *move, bool *done, sunder_error *err);

/* ---- fit_given_up.c ---------------------------------------------------------------------------------------------- */

/* For bodies a and b, between which pairs were given up: looks for places of these and the bodies around them at which
 * every distance is missed by at most 5/4 of `room`, the distances between a and b included. *found if there are such;
 * the moves are not rounded. from_home: all bodies start from their original places instead, if the cluster is small;
 * otherwise nothing is found. */
sunder_status sunder_i_cluster_fit(const sunder_i_model *model, const sunder_i_cluster *cluster, uint32_t a, uint32_t b,
                                   double room, bool from_home, double *move, bool *found, sunder_error *err);

/* ---- blocking_neighbours.c --------------------------------------------------------------------------------------- */

/* Finds bodies with a large share of the cluster's cost that would have a nearer free place if no movable body outside
 * the cluster were there. For each outside body that clashes with such a body at that place, the pair of the two bodies
 * is added to cluster->guest. Returns false if memory is out. */
bool sunder_i_cluster_find_blocking(const sunder_i_model *model, sunder_i_cluster *cluster, const double *move);

#endif
