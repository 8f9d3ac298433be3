/* Bodies are tried at another place, exactly: they stay there if no pair of them comes into conflict that was in none,
 * or stands worse than at the start, and nothing jumps; otherwise all is as before. */
#ifndef SUNDER_I_TRIAL_H
#define SUNDER_I_TRIAL_H

#include "displacement/solve/clusters/solver.h"

/* Bodies that are to have one move, or one coordinate of it, and where they stood. */
typedef struct sunder_i_trial {
    sunder_i_solver *solver;
    uint32_t *body;
    double *stood; /* [2 n] */
    size_t n, body_capacity, stood_capacity;
    unsigned along; /* which coordinates: bit 0 is x, bit 1 is y */
    double *goal;   /* [2 n] to each its own, in place of one for all; or NULL */
    bool *taken;    /* [bodies] if many are tried; else NULL */
    size_t *budget; /* bodies that may yet be moved in vain, for pairs of this cluster */
    const sunder_i_id_pair
        *parted;               /* bodies that may have no pair in conflict, except infeasible ones; or NULL */
    sunder_i_list near, about; /* scratch; their neighbours in the old layout */
    bool well;                 /* so far */
} sunder_i_trial;

/* One more body, which stands where it does. False if memory is out. */
bool sunder_i_trial_take(sunder_i_trial *trial, uint32_t body);
/* The bodies of a cluster that are to go elsewhere, each with its own goal. */
bool sunder_i_trial_take_moved(sunder_i_trial *trial, const sunder_i_cluster *cluster, const double *move);
/* Tries one place for them all: they stay there if all is well, else go back. */
sunder_status sunder_i_trial_place(sunder_i_trial *trial, const double to[2], sunder_error *err);
void sunder_i_trial_free(sunder_i_trial *trial);

#endif
