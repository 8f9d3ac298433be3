/* Rounds: clusters are solved, and checked exactly; see settle.c. */
#ifndef SUNDER_I_SETTLE_H
#define SUNDER_I_SETTLE_H

#include "displacement/clusters/solver.h"

/* Unites the blocks that clusters are made of. A fixed one may be a member of several clusters: each body once, so that
 * no two threads do the same. */
sunder_status sunder_i_solver_unite_blocks(sunder_i_solver *solver, sunder_error *err);
/* Loads the moves that a cluster starts from, and lends them. */
double *sunder_i_solver_load_moves(const sunder_i_solver *solver, const sunder_i_cluster *cluster);
/* Moves body b, unless it is fixed, by a move that was rounded; marks what changed. */
void sunder_i_solver_place(sunder_i_solver *solver, uint32_t b, const double *move);
/* Takes over the clusters' moves: bodies, features that changed, and whether their coordinates stayed exact. */
void sunder_i_solver_commit(sunder_i_solver *solver);
/* Exact relations of what changed. */
sunder_status sunder_i_solver_relate(sunder_i_solver *solver, sunder_error *err);
/* Solves clusters until nothing is in conflict but what was given up. Progress goes from `from` to `to`. */
sunder_status sunder_i_solver_settle(sunder_i_solver *solver, double from, double to, sunder_error *err);
/* Were better sides looked for since any cluster was last solved? */
bool sunder_i_solver_is_improved(const sunder_i_solver *solver);
/* Better sides, for every cluster that was solved since they were last looked for. */
sunder_status sunder_i_solver_improve(sunder_i_solver *solver, sunder_error *err);

#endif
