/* The stages of the search for the moves of one cluster. */
#ifndef SUNDER_I_SEARCH_STAGES_H
#define SUNDER_I_SEARCH_STAGES_H

#include "displacement/solve/search/cluster_search.h"

/* ---- free_positions.c: where there is room ----------------------------------------------------------------------- */

/* Free relative positions of j to i, nearest to target first. */
size_t sunder_i_search_free_pair(sunder_i_search *search, uint32_t i, uint32_t j, const double target[2], double spread,
                                 size_t most, double (*places)[2]);
/* The free place of body i nearest to where it came from, all others as they stand, no longer than limit. */
bool sunder_i_search_free_body(sunder_i_search *search, uint32_t i, double limit, double place[2]);
/* The same without a limit of distance, also where jumps are forbidden. */
bool sunder_i_search_free_body_anywhere(sunder_i_search *s, uint32_t i, double place[2]);

/* ---- confined.c: pairs that are shut in -------------------------------------------------------------------------- */

/* Are the two known to be shut in? Then no relative move of j that is farther from u is free. */
bool sunder_i_search_is_confined(const sunder_i_search *search, uint32_t i, uint32_t j, const double u[2],
                                 double *farthest);

/* ---- limits.c: how far bodies may go ----------------------------------------------------------------------------- */

/* Is it a tangent of a limit? By its key. */
static inline bool sunder_i_is_tangent(const sunder_i_constraint *c) { return c->key >> 63; }

/* Does any body overstep its limit at t? */
bool sunder_i_search_is_beyond(const sunder_i_search *search, const double *t);
/* Adds tangents for the limits that search->next oversteps. Returns whether there were any. */
bool sunder_i_search_constrain_limits(sunder_i_search *search);

/* ---- constrain.c: what a program demands ------------------------------------------------------------------------- */

/* Constraints by their keys. */
static inline int sunder_i_by_constraint(const void *a, const void *b)
{
    const sunder_i_constraint *c = a, *d = b;
    return c->key < d->key ? -1 : c->key > d->key;
}
/* Adds a constraint to the program, unless one of those from `first` on implies it; a weaker one is replaced. */
void sunder_i_search_add_constraint(sunder_i_search *search, size_t first, const sunder_i_constraint *constraint);
/* The program of all constraints around t; clashing pairs are separated at their present place (they miss a hair), or
 * each by its least translation. Returns whether a pair clashes there, or a limit is exceeded. */
bool sunder_i_search_constrain(sunder_i_search *search, double reach, bool as_it_stands);
/* Adds the limits and the pieces that search->next runs into. Returns whether there were any. */
bool sunder_i_search_constrain_further(sunder_i_search *search);

/* ---- descend.c: down from a position ----------------------------------------------------------------------------- */

/* From t, the sequence of quadratic programs. True if it ends with no clash; then t is a local optimum. Else t is a
 * compromise. */
bool sunder_i_search_descend(sunder_i_search *search);
/* Descends from a position without clashes, or stays there. */
void sunder_i_search_descend_or_stay(sunder_i_search *search);
/* Descends from search->t; keeps the result if it is free and cheaper than *cost, else returns to best. */
bool sunder_i_search_attempt(sunder_i_search *search, double *best, double *cost);
/* From t, with violations of at most a hair: finds the nearest layout that violates nothing on the sides taken there,
 * ignoring cheaper ones. True if there is one; it is t then. */
bool sunder_i_search_repair(sunder_i_search *search);
/* A compromise misses a little everywhere, where there is a contradiction and where there is none. Of the sets of
 * bodies that have nothing to do with each other those go where the program in full sends them, if that solves it for
 * them. */
void sunder_i_search_settle_components(sunder_i_search *search);

/* ---- jump.c: out of clashes -------------------------------------------------------------------------------------- */

/* Shortens moves to their limits. */
void sunder_i_search_clip(sunder_i_search *search);
/* Takes bodies that clash out and puts them where there is room, as far as the patience goes. True if no clash is
 * left. */
bool sunder_i_search_jump(sunder_i_search *search);
/* The same, with a patience of its own, which does not last for all surroundings. */
bool sunder_i_search_jump_soon(sunder_i_search *search);

/* ---- spread.c: away from one another ----------------------------------------------------------------------------- */

/* Without jumps and limits: all move away from one centre until none clashes, and descend from there. */
bool sunder_i_search_spread(sunder_i_search *search);

/* ---- give_up.c: pairs that no solution was found for ------------------------------------------------------------- */

/* From where the search ended, with clashes, to where the pairs that clashed at the start are relaxed and nothing
 * clashes; then down from there. The new relaxations are in search->relaxations. */
void sunder_i_search_give_up(sunder_i_search *search, const double *start);
/* The same of a crowd that begins at home and has next to no room, before any other search. False: it is no such crowd,
 * as far as is seen; then all is as it was. */
bool sunder_i_search_give_up_at_home(sunder_i_search *search, const double *start);
/* Relaxes pairs that, in the original places, miss no more than the margin demanded beyond the distance owed. Returns
 * whether there were any. */
bool sunder_i_search_waive_margins(sunder_i_search *search);
/* Pair (i, j) is given up, if it is not yet. Returns whether it was so now; relaxations are to be indexed then. */
bool sunder_i_search_relax(sunder_i_search *search, uint32_t i, uint32_t j);
/* The pairs that would clash with all at home; *n of them, sorted, the caller's. NULL if memory is out. */
sunder_i_clash *sunder_i_search_at_home(sunder_i_search *search, size_t *n);

/* ---- yield.c ----------------------------------------------------------------------------------------------------- */

/* What clashes by more than a hair is relaxed, if it is one of the n that clash at home, or goes home, until nothing
 * does. */
void sunder_i_search_yield(sunder_i_search *search, const sunder_i_clash *at_home, size_t n, double hair);
/* Returns whether it was elsewhere, and may move. */
bool sunder_i_search_send_home(sunder_i_search *search, uint32_t i);

/* ---- take_back.c: and asked for again ---------------------------------------------------------------------------- */

/* From a position without clashes: what this search has given up, one pair after the other, and where it can be had it
 * goes there. */
void sunder_i_search_take_back(sunder_i_search *search);
/* The same by pushing alone, of a search that stands without clashes. */
void sunder_i_search_push_back(sunder_i_search *search);

/* ---- common_moves.c ---------------------------------------------------------------------------------------------- */

/* Those that stand near each other and went the same way but for a hair go the same way. */
void sunder_i_search_equalise_moves(sunder_i_search *search);

/* ---- mend_few.c -------------------------------------------------------------------------------------------------- */

/* A large crowd in which a body was sent back, with few clashes: these are settled with the bodies around them, or
 * yield where the crowd is very large; then nothing clashes. False: it is no such crowd, or settling failed; then all
 * is as before. */
bool sunder_i_search_mend_few(sunder_i_search *search);

/* ---- push_from_home.c -------------------------------------------------------------------------------------------- */

/* A crowd in its original places, n pairs clashing there: gives up all of these, and takes back by pushing what it can.
 * False: that leaves at most this share, so there may be more room than pushing shows, or it is no such crowd; then all
 * is as before. */
bool sunder_i_search_push_from_home(sunder_i_search *search, const double *start, const sunder_i_clash *at_home,
                                    size_t n, double share);

/* ---- lone_pair.c ------------------------------------------------------------------------------------------------- */

/* If the cluster is two features that are independent of all others: separates them at the least cost, and sets *done;
 * else all is as before. The measurements made for it are in cluster->measured in any case. */
sunder_status sunder_i_search_separate_lone_pair(sunder_i_search *search, sunder_i_cluster *cluster, bool *done,
                                                 sunder_error *err);

/* ---- solve_cluster.c: how a search ends -------------------------------------------------------------------------- */

/* Rounds the moves of its bodies. */
void sunder_i_search_round(const sunder_i_search *search, double *move);
/* What became of pairs in conflict goes to the cluster. */
void sunder_i_search_hand_over(sunder_i_search *search, sunder_i_cluster *cluster);

/* ---- cheapest.c: are there any better sides? --------------------------------------------------------------------- */

/* Are solutions taken down to the last of it here? Not where proofs follow: these go down by themselves, and begin from
 * where the search ends without this. */
static inline bool sunder_i_search_runs_without_proofs(const sunder_i_search *s)
{
    return !(s->model->rules.effort > 0);
}
/* Is none cheaper than s->t, a solution, with the program that it solves, whatever the sides, but for rounding? It is
 * taken down to the last of it then; else all is as it was. That it is not the cheapest is never said. */
bool sunder_i_search_is_cheapest(sunder_i_search *search);

/* ---- improve.c, reinsert.c: better sides ------------------------------------------------------------------------- */

/* Tries other orders of putting bodies back, from best, which is free and costs *cost; both become what was found. */
void sunder_i_search_reorder(sunder_i_search *search, double *best, double *cost);

#endif
