/* Trials: some bodies are moved, and an exact check decides. They stay there if no pair comes into a new conflict, no
 * old conflict becomes an overlap or stands worse than at the start, and no feature jumps over another. Otherwise all
 * return. With `from_start` conflicts and overlaps of the start may come back. */
#ifndef SUNDER_I_TRIAL_H
#define SUNDER_I_TRIAL_H

#include "displacement/solve/clusters/solver.h"

/* The bodies of a trial, their moves before it, and how the goal is to be understood. */
typedef struct sunder_i_trial {
    sunder_i_solver *solver;
    uint32_t *body;
    double *stood; /* [2 n] moves before the trial */
    size_t n, body_capacity, stood_capacity;
    unsigned along; /* coordinates that change: bit 0 is x, bit 1 is y */
    double *goal;   /* [2 n] a goal for each body; NULL: one for all */
    bool *taken;    /* [bodies] is the body in the trial? scratch for trials of many bodies; else NULL */
    size_t *budget; /* number of bodies that may still be moved without success, for pairs of this cluster */
    const sunder_i_id_pair *parted; /* two bodies of which no pair may be in conflict then, except infeasible ones; or
                                * NULL */
    bool from_start;
    bool whole_rows;           /* a pair that comes to keep its distance has to keep the whole rule of rows, too */
    sunder_i_list near, about; /* scratch; neighbours of the bodies before the trial */
    sunder_i_id_pair broken;   /* if a pair of things made the trial fail: this pair; at first two equal numbers */
    bool well;                 /* the trial has succeeded, as far as it was checked */
} sunder_i_trial;

/* Adds a body at its present move. False if memory is out. */
bool sunder_i_trial_take(sunder_i_trial *trial, uint32_t body);
/* Adds the movable bodies of a cluster whose new move, move[2 * cluster->n], differs from the present one; that becomes
 * the goal of each. False if memory is out. */
bool sunder_i_trial_take_moved(sunder_i_trial *trial, const sunder_i_cluster *cluster, const double *move);
/* Moves all bodies to the goal (`to`, or trial->goal) and checks: trial->well if they stay there. */
sunder_status sunder_i_trial_place(sunder_i_trial *trial, const double to[2], sunder_error *err);
void sunder_i_trial_free(sunder_i_trial *trial);

#endif
