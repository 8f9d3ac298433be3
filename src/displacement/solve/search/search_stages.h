/* The stages of the search for the moves of one cluster. */
#ifndef SUNDER_I_SEARCH_STAGES_H
#define SUNDER_I_SEARCH_STAGES_H

#include "displacement/solve/search/cluster_search.h"

/* ---- free_positions.c: where there is room ----------------------------------------------------------------------- */

/* Finds positions of body j relative to body i that are free, at most `most` of them, the nearest to `target` first,
 * and each farther than `spread` from those before. Returns their number. */
size_t sunder_i_search_free_pair(sunder_i_search *search, uint32_t i, uint32_t j, const double target[2], double spread,
                                 size_t most, double (*places)[2]);
/* Finds the free position of body i that is nearest to the one it prefers, at most `limit` from it, while all other
 * bodies keep their positions. Where jumps are forbidden it looks only a few sizes of the body beyond its present move
 * (FARTHEST_LEAP). False if none was found. */
bool sunder_i_search_free_body(sunder_i_search *search, uint32_t i, double limit, double place[2]);
/* As sunder_i_search_free_body(), and far away even where jumps are forbidden; at most `most` positions, the nearest
 * first. Each is tested for clashes. Returns their number. */
size_t sunder_i_search_free_body_anywhere(sunder_i_search *s, uint32_t i, double limit, size_t most,
                                          double (*places)[2]);

/* ---- confined.c: pairs that are shut in -------------------------------------------------------------------------- */

/* Is the pair known to be shut in (shut_in_pairs.c)? Then no relative position of j that is farther than *farthest from
 * u is free. */
bool sunder_i_search_is_confined(const sunder_i_search *search, uint32_t i, uint32_t j, const double u[2],
                                 double *farthest);

/* ---- enclosed.c: bodies enclosed by sides of barriers ------------------------------------------------------------ */

/* Do sides that are no farther than `reach` enclose body i? Then no position farther away is free. */
bool sunder_i_search_is_enclosed(sunder_i_search *search, uint32_t i, double reach);

/* ---- limits.c: how far bodies may go ----------------------------------------------------------------------------- */

/* Is the constraint a tangent of a limit? Its key tells. */
static inline bool sunder_i_is_tangent(const sunder_i_constraint *c) { return c->key >> 63; }

/* Does any body exceed its limit at t? */
bool sunder_i_search_is_beyond(const sunder_i_search *search, const double *t);
/* Adds tangents for the limits that search->next exceeds. Returns whether any was added; none is if the program has an
 * almost equal one. */
bool sunder_i_search_constrain_limits(sunder_i_search *search);

/* ---- constrain.c: what a program demands ------------------------------------------------------------------------- */

/* Compares two constraints by their keys, for sorting. */
static inline int sunder_i_by_constraint(const void *a, const void *b)
{
    const sunder_i_constraint *c = a, *d = b;
    return c->key < d->key ? -1 : c->key > d->key;
}
/* Returns the one of n constraints, sorted by their keys, that has this key; NULL if there is none. */
const sunder_i_constraint *sunder_i_search_look_up(const sunder_i_constraint *c, size_t n, uint64_t key);
/* The force that the constraint with this key had in the last program; 0 if it had none. */
double sunder_i_search_force_before(const sunder_i_search *search, uint64_t key);
/* Adds a constraint to the program, unless one of the constraints from index `first` on implies it. A weaker one is
 * replaced. */
void sunder_i_search_add_constraint(sunder_i_search *search, size_t first, const sunder_i_constraint *constraint);
/* Makes the program of all constraints within `reach` of the present moves. The lines of a clashing pair are chosen
 * where the pair stands after its least translation out of the clash; as_it_stands: where it stands now, since it
 * misses the distance by a hair only. Returns whether a pair clashes at the present moves, or a limit is exceeded. */
bool sunder_i_search_constrain(sunder_i_search *search, double reach, bool as_it_stands);
/* Adds constraints for the limits that search->next exceeds and for the pieces that clash there and did not clash at
 * search->t. Returns whether any was added. */
bool sunder_i_search_constrain_further(sunder_i_search *search);

/* ---- descend.c: down from a position ----------------------------------------------------------------------------- */

/* Solves a sequence of quadratic programs from search->t on. True if search->t is without clashes then: a local
 * optimum, unless the patience ended, or search->hope was out of reach. Otherwise search->t is a compromise between
 * contradicting sides. */
bool sunder_i_search_descend(sunder_i_search *search);
/* Descends from search->t; keeps the result if it is free and cheaper than *cost, else returns to best. */
bool sunder_i_search_attempt(sunder_i_search *search, double *best, double *cost);
/* For a layout search->t with tiny violations: finds the nearest layout without violations that keeps the sides of all
 * pairs; cheaper layouts are not looked for. True if there is one, which search->t is then. */
bool sunder_i_search_repair(sunder_i_search *search);

/* ---- jump.c: out of clashes -------------------------------------------------------------------------------------- */

/* Moves clashing bodies one by one to free positions, until the patience ends. True if no clash is left. */
bool sunder_i_search_jump(sunder_i_search *search);
/* The same with a small patience of its own, which may end before all bodies were tried. */
bool sunder_i_search_jump_soon(sunder_i_search *search);

/* ---- spread.c: away from one another ----------------------------------------------------------------------------- */

/* If jumps are forbidden and no movable body has a limit: moves all bodies away from a common centre, farther each
 * time, and descends from there, until a descent ends without clashes; that is returned as true. Otherwise false, and
 * search->t is the layout with the fewest clashes. */
bool sunder_i_search_spread(sunder_i_search *search);

/* ---- elastic.c: pairs that no solution was found for ------------------------------------------------------------- */

/* For a search that ended with clashes: solves the cluster from the original places but for pairs that clash there, as
 * few as it can, and relaxes these. The new relaxations are in search->relaxations. */
void sunder_i_search_give_up(sunder_i_search *search);

/* ---- home_clashes.c: pairs that clash in the original places ----------------------------------------------------- */

/* Relaxes the pairs whose shortfall in the original places is at most the margin. Returns whether there were any. */
bool sunder_i_search_waive_margins(sunder_i_search *search);
/* Relaxes pair (i, j), unless it is relaxed already. Returns whether it was relaxed now; if so, the caller has to index
 * the relaxations. */
bool sunder_i_search_relax(sunder_i_search *search, uint32_t i, uint32_t j);
/* The pairs that clash if all bodies are in their original places: *n of them, sorted, owned by the caller. NULL if
 * memory is out. */
sunder_i_clash *sunder_i_search_at_home(sunder_i_search *search, size_t *n);

/* ---- yield.c ----------------------------------------------------------------------------------------------------- */

/* Until nothing clashes by more than `hair`: relaxes a clashing pair that is one of the n pairs at_home and not relaxed
 * yet; the bodies of any other clashing pair return to their original places. */
void sunder_i_search_yield(sunder_i_search *search, const sunder_i_clash *at_home, size_t n, double hair);
/* Moves body i to its original place. Returns whether it stood elsewhere and may move. */
bool sunder_i_search_send_home(sunder_i_search *search, uint32_t i);

/* ---- mend_few.c -------------------------------------------------------------------------------------------------- */

/* For a large crowd with few clashes, one of whose bodies was sent home to stay there (`pinned` in the model): settles
 * each clash together with the bodies around it. A very large crowd yields where that fails. True if nothing clashes
 * then. False, with nothing changed, if it is no such crowd or settling failed. */
bool sunder_i_search_mend_few(sunder_i_search *search);

/* ---- pair_margin.c ----------------------------------------------------------------------------------------------- */

/* Demands the margin of all pairs left in conflict as well. False if memory is out. */
bool sunder_i_search_ask_margins(sunder_i_search *search);
/* Moves to a place nearby without clashes, at which all pairs left in conflict keep their margins or, if there is none,
 * those that keep it already. True if search->t is such a place then; otherwise it has not changed. */
bool sunder_i_search_keep_margins(sunder_i_search *search);

/* ---- lone_pair.c ------------------------------------------------------------------------------------------------- */

/* If the cluster is two features that no other feature affects: separates them at the least cost, and sets *done.
 * Otherwise nothing changes. In either case cluster->measured has the least separation that was computed. */
sunder_status sunder_i_search_separate_lone_pair(sunder_i_search *search, sunder_i_cluster *cluster, bool *done,
                                                 sunder_error *err);

/* ---- solve_cluster.c: how a search ends -------------------------------------------------------------------------- */

/* Rounds the moves of the search's bodies into move[2 * n]. */
void sunder_i_search_round(const sunder_i_search *search, double *move);
/* Hands the search's relaxations and restored pairs over to the cluster. */
void sunder_i_search_hand_over(sunder_i_search *search, sunder_i_cluster *cluster);

/* ---- cheapest.c: are there any better sides? --------------------------------------------------------------------- */

/* Is the layer solved without proofs? Then the search itself asks whether its solution is the cheapest; otherwise the
 * search for better sides does, after which proofs go on. */
static inline bool sunder_i_search_runs_without_proofs(const sunder_i_search *s)
{
    return !(s->model->rules.effort > 0);
}
/* Is it known that no layout is cheaper than the solution s->t, whatever the sides of pairs, up to rounding? s->program
 * has to be the program that s->t solves. If it is known, s->t is computed to the last digits; otherwise nothing
 * changes. False does not mean that there is a cheaper layout. */
bool sunder_i_search_is_cheapest(sunder_i_search *search);

/* ---- improve.c, reinsert.c: better sides ------------------------------------------------------------------------- */

/* Takes some bodies out and puts them back in other orders, starting from the free layout `best`, which costs *cost.
 * Both are replaced by a cheaper layout, if one is found. */
void sunder_i_search_reorder(sunder_i_search *search, double *best, double *cost);

#endif
