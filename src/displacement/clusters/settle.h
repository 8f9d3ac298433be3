/* Rounds: clusters are solved, and checked exactly; see settle.c. */
#ifndef SUNDER_I_SETTLE_H
#define SUNDER_I_SETTLE_H

#include "displacement/clusters/solver.h"

/* Do the two stand in conflict, in different bodies? */
bool sunder_i_job_is_conflict(const sunder_i_town *town, const sunder_i_relation *r);
/* ... and is it one that the search is to resolve, with no truce? */
bool sunder_i_job_is_between(const sunder_i_town *town, const sunder_i_relation *r);
/* Is one of the cluster's bodies dirty? */
bool sunder_i_job_is_dirty(const sunder_i_job *w, const sunder_i_cluster *c);
/* Unites the blocks that clusters are made of. A fixed one may be a member of several clusters: each body once, so that
 * no two threads do the same. */
sunder_status sunder_i_job_unite_blocks(sunder_i_job *w, sunder_error *err);
/* The moves that a cluster starts from. */
void sunder_i_job_load_moves(const sunder_i_job *w, const sunder_i_cluster *c, double *move);
/* Moves body b, unless it is fixed, by a move that was rounded; marks what changed. */
void sunder_i_job_place(sunder_i_job *w, uint32_t b, const double *move);
/* Takes over the clusters' moves: bodies, features that changed, and whether their coordinates stayed exact. */
void sunder_i_job_commit(sunder_i_job *w);
/* Exact relations of what changed. */
sunder_status sunder_i_job_check(sunder_i_job *w, sunder_error *err);
/* Solves clusters until nothing is in conflict but what was given up. Progress goes from `from` to `to`. */
sunder_status sunder_i_job_settle(sunder_i_job *w, double from, double to, sunder_error *err);
/* Were better sides looked for since any cluster was last solved? */
bool sunder_i_job_is_improved(const sunder_i_job *w);
/* Better sides, for every cluster that was solved since they were last looked for. */
sunder_status sunder_i_job_improve(sunder_i_job *w, sunder_error *err);

#endif
