/* The stages of the work on one layer, in about the order in which ../../separate_layer.c calls them. */
#ifndef SUNDER_I_SOLVER_STAGES_H
#define SUNDER_I_SOLVER_STAGES_H

#include "displacement/prove/proofs/feasibility.h"
#include "displacement/solve/clusters/solver.h"

/* Pairs that a question leaves as they are, sorted. */
typedef struct sunder_i_spared {
    const sunder_i_id_pair *pair; /* between the numbers of features and barriers in the two orders */
    size_t n;
} sunder_i_spared;

/* ---- infeasible_pairs.c ------------------------------------------------------------------------------------------ */

/* Finds, exactly, the pairs that cannot be resolved within their limits, and relaxes them; and those that cannot be
 * separated, but may go inside, which are kept there from then on. Before the model is cut. spared: pairs that the
 * question leaves as they are, which need no test; NULL: none. */
sunder_status sunder_i_solver_find_infeasible(sunder_i_solver *solver, const sunder_i_spared *spared,
                                              sunder_error *err);

/* ---- shut_in_pairs.c --------------------------------------------------------------------------------------------- */

/* Finds two bodies, in conflict, that nothing but a jump takes clear of each other, and leaves what is between them. */
sunder_status sunder_i_solver_find_shut_in(sunder_i_solver *solver, sunder_error *err);

/* ---- shut_in_conflicts.c ----------------------------------------------------------------------------------------- */

/* Of n conflicts between two bodies those that are proved to have no solution, all others being held no worse than they
 * stood, are called infeasible. */
sunder_status sunder_i_find_unsolvable(const sunder_i_model *model, const sunder_i_id_pair *bodies,
                                       sunder_i_relaxation *relaxation, size_t n, sunder_error *err);

/* ---- lifted_limits.c --------------------------------------------------------------------------------------------- */

/* Lets bodies go as far as they like, but for those that are set aside. *lifted: there were limits. */
sunder_status sunder_i_solver_lift_limits(sunder_i_solver *solver, bool *lifted, sunder_error *err);
/* As long as they are lifted: clusters that run into others from where they cannot stay go home, and are set aside. */
sunder_status sunder_i_solver_set_far_aside(sunder_i_solver *solver, sunder_error *err);
/* Bodies that went too far go back to their original places, to be solved within their limits: these are in force from
 * then on. */
sunder_status sunder_i_solver_restore_limits(sunder_i_solver *solver, sunder_error *err);

/* Marked bodies go back, their joins and relaxations are dropped; clusters are gathered anew. */
sunder_status sunder_i_solver_begin_again(sunder_i_solver *solver, const bool *back, sunder_error *err);

/* ---- coarse_bodies.c --------------------------------------------------------------------------------------------- */

/* Of two bodies in conflict at the start the one whose moves are coarse beside the other is fixed from now on. */
sunder_status sunder_i_solver_begin_holding(sunder_i_solver *solver, sunder_error *err);
/* The same as things stand, if it can be. */
void sunder_i_solver_hold_coarse(sunder_i_solver *solver);
/* Is a body held? */
bool sunder_i_solver_any_held(const sunder_i_solver *solver);
/* Bodies that are held and still in conflict, or that might be of use, may move from now on: *any, and then what hangs
 * together with them, which is what is wanted from now on, has begun again. */
sunder_status sunder_i_solver_let_go(sunder_i_solver *solver, bool *any, sunder_error *err);
/* What was held is fixed no longer, for the report; nothing is proved of it but by pairs. */
void sunder_i_solver_end_holding(sunder_i_solver *solver);

/* ---- held_or_free.c ---------------------------------------------------------------------------------------------- */

/* A layout that has held bodies, and the state it depends on. All zero: no layout. */
typedef struct sunder_i_held_layout {
    double *move;               /* [2 * bodies] */
    bool *held, *improved;      /* [bodies] */
    unsigned char *widened;     /* [bodies] */
    sunder_i_id_pair *edge;     /* [edges] bodies */
    sunder_i_id_pair *conflict; /* [conflicts] bodies, of each two features in conflict */
    sunder_i_id_pair *given_up;
    size_t edges, conflicts, given_up_n;
    sunder_i_inclusion_state *state; /* [inclusions] */
    sunder_i_relaxations relaxations;
} sunder_i_held_layout;

/* The layout as it stands. Failure leaves what sunder_i_held_layout_free() takes. */
sunder_status sunder_i_solver_keep_held(const sunder_i_solver *solver, sunder_i_held_layout *layout, sunder_error *err);
/* Takes it back where it is better than what was found since, cluster by cluster. */
sunder_status sunder_i_solver_take_better(sunder_i_solver *solver, const sunder_i_held_layout *layout,
                                          sunder_error *err);
void sunder_i_held_layout_free(sunder_i_held_layout *layout);

/* ---- move_inside.c ----------------------------------------------------------------------------------------------- */

/* Sends those there that cannot be parted, but go inside. */
sunder_status sunder_i_solver_move_inside(sunder_i_solver *solver, sunder_error *err);

/* ---- holders.c --------------------------------------------------------------------------------------------------- */

/* What lies in two that are in conflict is kept in one of them. */
sunder_status sunder_i_solver_choose_holders(sunder_i_solver *solver, sunder_error *err);

/* ---- grow_crowds.c ----------------------------------------------------------------------------------------------- */

/* Crowds that are to be solved absorb the bodies that they will run into. After clusters were gathered, and blocks
 * united. */
sunder_status sunder_i_solver_grow_crowds(sunder_i_solver *solver, sunder_error *err);

/* ---- settle.c ---------------------------------------------------------------------------------------------------- */

/* Solves clusters until nothing is in conflict but what was given up. Progress goes from `from` to `to`. */
sunder_status sunder_i_solver_settle(sunder_i_solver *solver, double from, double to, sunder_error *err);

/* ---- given_up.c -------------------------------------------------------------------------------------------------- */

/* Sorted, each once. */
void sunder_i_sort_given_up(sunder_i_model *model);
/* Takes over the relaxations that clusters made, and those that they ended. */
sunder_status sunder_i_solver_take_relaxations(sunder_i_solver *solver, sunder_error *err);

/* ---- reconsider.c ------------------------------------------------------------------------------------------------ */

/* Examines given-up pairs again. A pair that has a solution after all is put there, which is to be settled:
 * *changed. */
sunder_status sunder_i_solver_reconsider(sunder_i_solver *solver, bool *changed, sunder_error *err);

/* ---- one_by_one.c ------------------------------------------------------------------------------------------------ */

/* The same of single pairs, the others staying in conflict. */
sunder_status sunder_i_solver_ask_one_by_one(sunder_i_solver *solver, bool *changed, sunder_error *err);

/* ---- exact_fits.c ------------------------------------------------------------------------------------------------ */

/* And of such as fit exactly, where coordinates lie on a lattice. */
sunder_status sunder_i_solver_fit_exactly(sunder_i_solver *solver, sunder_error *err);

/* ---- retry_list.c ------------------------------------------------------------------------------------------------ */

/* Once nothing joins clusters any more: asks for given-up pairs once more, a cluster at a time. */
sunder_status sunder_i_solver_retry(sunder_i_solver *solver, sunder_error *err);

/* ---- better_sides.c ---------------------------------------------------------------------------------------------- */

/* Were better sides looked for since any cluster that is wanted was last solved? */
sunder_status sunder_i_solver_is_improved(const sunder_i_solver *solver, bool *improved, sunder_error *err);
/* Better sides, for each of those clusters that was solved since they were last looked for. */
sunder_status sunder_i_solver_improve(sunder_i_solver *solver, sunder_error *err);

/* ---- in_contact.c ------------------------------------------------------------------------------------------------ */

/* Contact groups that are wanted take places without a margin, where doubles hold them. After they were gathered. */
sunder_status sunder_i_solver_put_in_contact(sunder_i_solver *solver, sunder_error *err);

/* ---- contact_groups.c -------------------------------------------------------------------------------------------- */

/* The contact groups as they stand. One that is as it was keeps its proof. */
sunder_status sunder_i_solver_gather_groups(sunder_i_solver *solver, sunder_error *err);
void sunder_i_groups_free(sunder_i_groups *groups);

/* ---- optimise.c -------------------------------------------------------------------------------------------------- */

/* The listed pairs in the present layout, and the demands on them: s->groups.waived. */
sunder_status sunder_i_solver_list_waivers(sunder_i_solver *solver, sunder_error *err);
/* Proves of each contact group how little it could cost; what is found to be cheaper is taken. */
sunder_status sunder_i_solver_optimise(sunder_i_solver *solver, sunder_error *err);

/* ---- spared_pairs.c ---------------------------------------------------------------------------------------------- */

/* Is it one of those? */
bool sunder_i_solver_is_spared(const sunder_i_solver *solver, const sunder_i_spared *spared, uint32_t a, uint32_t b);
/* Is there a pair that was found to have no solution, and that is not spared? */
bool sunder_i_solver_is_beyond_limits(const sunder_i_solver *solver, const sunder_i_spared *spared);
/* What is asked of proofs. */
typedef struct sunder_i_proving {
    const sunder_i_spared *spared;   /* they are relaxed */
    const sunder_i_list *heeded;     /* NULL, or nothing else is: things, of a barrier the first part, ascending */
    sunder_i_planes *planes;         /* of this solver */
    sunder_i_precedents *precedents; /* NULL, or likewise */
    bool in_plane;                   /* of relative moves of two bodies alone, which tells less, sooner */
    double *move;                    /* NULL, or [2 * bodies] where solutions are put */
} sunder_i_proving;

/* What little effort tells of those that are not spared: it is proved that they cannot all be solved, or each has a
 * solution by itself, up to a hair. *gap: the one that is asked about, no more than the model's; where it is proved,
 * then roughly the least with which the same proof proves it. */
sunder_status sunder_i_solver_prove(const sunder_i_solver *solver, const sunder_i_proving *how,
                                    sunder_i_verdict *verdict, double *gap, sunder_error *err);
/* Puts all movable bodies at their places in a layout, [2 * bodies] rounded, and relates them. *well: no limit is
 * exceeded, and nothing jumps. */
sunder_status sunder_i_solver_place_all(sunder_i_solver *solver, const double *move, bool *well, sunder_error *err);
/* Relaxes those that are. Before the model is cut, so that nothing more is asked about them. */
sunder_status sunder_i_solver_spare(sunder_i_solver *solver, const sunder_i_spared *spared, sunder_error *err);

/* ---- worsened_pairs.c, uphold.c ---------------------------------------------------------------------------------- */

/* Is r a conflict that is listed whatever the options? Two members of one block count only if they overlap and do
 * not just touch. */
bool sunder_i_solver_is_always_listed(const sunder_i_solver *solver, const sunder_i_relation *r);
/* Is it one, and does it stand worse than it stood? */
sunder_status sunder_i_solver_breaks_rule(sunder_i_solver *solver, const sunder_i_relation *r, bool *breaks,
                                          sunder_error *err);
/* Does the pair, which is in conflict, stand worse than it stood? Exact. */
sunder_status sunder_i_solver_is_worse(sunder_i_solver *solver, const sunder_i_relation *r, bool *worse,
                                       sunder_error *err);
/* For sunder_i_solver_mend(): each cluster has its own, so that what is done for one takes nothing from another. The
 * caller's; NULL: memory is out. */
size_t *sunder_i_solver_patience(const sunder_i_solver *solver);
/* Moves one of the two, or a row, slightly, so that the pair stands no worse, and nothing else does: *well, if there is
 * such a place. budget: [bodies] by roots of clusters, how many may still be moved without success. */
sunder_status sunder_i_solver_mend(sunder_i_solver *solver, const sunder_i_relation *r, size_t *budget, bool *well,
                                   sunder_error *err);
/* Takes back what rounding made worse, pair by pair. */
sunder_status sunder_i_solver_uphold(sunder_i_solver *solver, sunder_error *err);
/* Does no pair in conflict stand worse than it stood? */
sunder_status sunder_i_solver_is_upheld(sunder_i_solver *solver, bool *upheld, sunder_error *err);

#endif
