/* The stages of the work on one layer; ../../solve_layer.c calls most of them. */
#ifndef SUNDER_I_SOLVER_STAGES_H
#define SUNDER_I_SOLVER_STAGES_H

#include "displacement/prove/proofs/feasibility.h"
#include "displacement/solve/clusters/solver.h"

/* Pairs that a question leaves in conflict, sorted. */
typedef struct sunder_i_spared {
    const sunder_i_id_pair *pair; /* [n] numbers of features and barriers in the layer of the caller */
    size_t n;
    /* NULL, or a memo of relaxations beside barriers that other layers share. Features and barriers have names there
     * that are the same in all of these layers: name[number]; SUNDER_I_NOBODY: the feature has none, and its relaxation
     * is not kept. */
    struct sunder_i_relaxation_memo *memo;
    const uint32_t *name;
    /* NULL, or [n] the clearances that proofs hold the pairs to, as in sunder_i_requirement; NAN: as in this layer. */
    const double *held;
    const sunder_i_row_demand *row; /* [rows] what the rule of rows demands, by numbers of the caller */
    size_t rows;
} sunder_i_spared;

/* Relaxations of features beside barriers, found by the names of the feature and the barrier (sunder_i_spared). The
 * same pair is spared in each of a dozen small layers about the conflicts of one cluster, and a least translation out
 * of a barrier takes long to compute. The caller frees the list. All zero: empty. */
typedef struct sunder_i_relaxation_memo {
    sunder_i_relaxation *item; /* sorted by a and b, which are names */
    size_t n, capacity;
} sunder_i_relaxation_memo;

/* ---- infeasible_pairs.c ------------------------------------------------------------------------------------------ */

/* Before the model is cut into pieces: finds, exactly, the pairs that cannot be resolved within their limits, and
 * relaxes them; and the pairs that can only be resolved by moving one feature inside the other (solver->entry). spared:
 * pairs that need no test; NULL: none. */
sunder_status sunder_i_solver_find_infeasible(sunder_i_solver *solver, const sunder_i_spared *spared,
                                              sunder_error *err);

/* ---- shut_in_pairs.c --------------------------------------------------------------------------------------------- */

/* Finds pairs of bodies in conflict that only a jump could separate, and relaxes the conflicts between them. */
sunder_status sunder_i_solver_find_shut_in(sunder_i_solver *solver, sunder_error *err);

/* ---- shut_in_conflicts.c ----------------------------------------------------------------------------------------- */

/* Marks as infeasible those of n conflicts between two bodies that are proved to have no solution while the other
 * conflicts are no worse than at the start. */
sunder_status sunder_i_find_unsolvable(const sunder_i_model *model, const sunder_i_id_pair *bodies,
                                       sunder_i_relaxation *relaxation, size_t n, sunder_error *err);

/* ---- lifted_limits.c --------------------------------------------------------------------------------------------- */

/* Lifts all limits, except if there are barriers, and sets aside the bodies connected with pairs that no moves within
 * their limits can separate. solver->had_limits: there were limits, and they are lifted now. */
sunder_status sunder_i_solver_lift_limits(sunder_i_solver *solver, sunder_error *err);
/* While limits are lifted: clusters that cost more than their limits allow, and would become part of a crowd of more
 * than MOST_LIFTED bodies by running into others, return home and are set aside. */
sunder_status sunder_i_solver_set_far_aside(sunder_i_solver *solver, sunder_error *err);
/* Puts limits in force again. Bodies that exceed theirs, bodies that were set aside, bodies that met one of these, and
 * all bodies of their clusters return to their original places, to be solved within their limits. */
sunder_status sunder_i_solver_restore_limits(sunder_i_solver *solver, sunder_error *err);

/* The bodies marked in back[bodies] return to their original places; their edges, relaxations and given-up pairs are
 * dropped, and clusters are gathered again. */
sunder_status sunder_i_solver_begin_again(sunder_i_solver *solver, const bool *back, sunder_error *err);

/* ---- coarse_bodies.c --------------------------------------------------------------------------------------------- */

/* For each two bodies in conflict at the start: holds one as fixed if its moves are coarse for the other
 * (coarse_bodies.c). */
sunder_status sunder_i_solver_begin_holding(sunder_i_solver *solver, sunder_error *err);
/* Holds bodies as fixed in the same way for each two bodies in conflict in the present layout, if the layer has bodies
 * that may be held at all. */
void sunder_i_solver_hold_coarse(sunder_i_solver *solver);
/* Is any body held? */
bool sunder_i_solver_any_held(const sunder_i_solver *solver);
/* Releases held bodies that are still in conflict, or whose moves may be of use. solver->any_let_go: there are
 * such; then all bodies connected with them have begun again, and are what the present pass works on. */
sunder_status sunder_i_solver_let_go(sunder_i_solver *solver, sunder_error *err);
/* For the report: held bodies are no longer fixed, and the bounds of their contact groups are dropped, since they were
 * proved for fixed bodies. */
void sunder_i_solver_end_holding(sunder_i_solver *solver);

/* ---- held_or_free.c ---------------------------------------------------------------------------------------------- */

/* The layout with held bodies, and the state that belongs to it. A zeroed struct has no layout. */
typedef struct sunder_i_held_layout {
    double *move;               /* [2 * bodies] */
    bool *held, *improved;      /* [bodies] */
    unsigned char *widened;     /* [bodies] */
    sunder_i_id_pair *edge;     /* [edges] pairs of bodies */
    sunder_i_id_pair *conflict; /* [conflicts] pairs of bodies, one for each pair of features in conflict */
    sunder_i_id_pair *given_up;
    size_t edges, conflicts, given_up_n;
    sunder_i_inclusion_state *state; /* [inclusions] */
    sunder_i_relaxations relaxations;
} sunder_i_held_layout;

/* Stores the present layout in solver->held_layout. */
sunder_status sunder_i_solver_keep_held(sunder_i_solver *solver, sunder_error *err);
/* Returns to the stored layout, cluster by cluster, where it is better than the present one. */
sunder_status sunder_i_solver_take_better(sunder_i_solver *solver, sunder_error *err);
void sunder_i_held_layout_free(sunder_i_held_layout *layout);

/* ---- move_inside.c ----------------------------------------------------------------------------------------------- */

/* For each pair of solver->entry: moves one feature's body inside the other, as far as both limits allow. */
sunder_status sunder_i_solver_move_inside(sunder_i_solver *solver, sunder_error *err);

/* ---- holders.c --------------------------------------------------------------------------------------------------- */

/* A body that lies in two bodies in conflict is kept in one of them from now on: chooses which. */
sunder_status sunder_i_solver_choose_holders(sunder_i_solver *solver, sunder_error *err);

/* ---- grow_crowds.c ----------------------------------------------------------------------------------------------- */

/* After clusters were gathered and blocks united: large crowds that are due absorb the bodies that they will run
 * into. */
sunder_status sunder_i_solver_grow_crowds(sunder_i_solver *solver, sunder_error *err);

/* ---- settle.c ---------------------------------------------------------------------------------------------------- */

/* Solves clusters, round by round, until the only conflicts are pairs that were given up. Progress goes from `from` to
 * `to`. */
sunder_status sunder_i_solver_settle(sunder_i_solver *solver, double from, double to, sunder_error *err);

/* ---- given_up.c -------------------------------------------------------------------------------------------------- */

/* Sorts model->given_up and removes duplicates. */
void sunder_i_sort_given_up(sunder_i_model *model);
/* Moves the relaxations that the clusters made to the model, and drops those of the model that the clusters ended. */
sunder_status sunder_i_solver_take_relaxations(sunder_i_solver *solver, sunder_error *err);

/* ---- reconsider.c ------------------------------------------------------------------------------------------------ */

/* Asks, for each component of conflicts with a given-up pair, whether all its pairs have a joint solution. If one is
 * found the bodies move there: *changed, and clusters have to be settled. */
sunder_status sunder_i_solver_reconsider(sunder_i_solver *solver, bool *changed, sunder_error *err);

/* ---- one_by_one.c ------------------------------------------------------------------------------------------------ */

/* Asks, for single given-up pairs, whether each has a solution while the other conflicts remain as they are. If one is
 * found the bodies move there: *changed, and clusters have to be settled. */
sunder_status sunder_i_solver_ask_one_by_one(sunder_i_solver *solver, bool *changed, sunder_error *err);

/* ---- exact_fits.c ------------------------------------------------------------------------------------------------ */

/* Looks for exact places for the given-up pairs that may fit exactly, since their coordinates are multiples of a common
 * step. A pair for which there are such places is no longer given up. */
sunder_status sunder_i_solver_fit_exactly(sunder_i_solver *solver, sunder_error *err);

/* ---- retry_list.c ------------------------------------------------------------------------------------------------ */

/* Tries given-up pairs once more, in each cluster with a body that is SUNDER_I_TO_RETRY. */
sunder_status sunder_i_solver_retry(sunder_i_solver *solver, sunder_error *err);

/* ---- better_sides.c ---------------------------------------------------------------------------------------------- */

/* Is there a wanted cluster in which better sides have not been looked for since it was last solved? Sets
 * solver->failed if memory is out. */
bool sunder_i_solver_is_to_improve(sunder_i_solver *solver);
/* Looks for better sides in the wanted clusters that were solved since the last time. */
sunder_status sunder_i_solver_improve(sunder_i_solver *solver, sunder_error *err);

/* ---- lone_bodies.c ----------------------------------------------------------------------------------------------- */

/* After moves that made a conflict worse were undone: moves each body without a limit that is in conflict with barriers
 * alone, until none of its conflicts has a solution that keeps the others no worse. */
sunder_status sunder_i_solver_place_lone_bodies(sunder_i_solver *solver, sunder_error *err);

/* ---- ease.c ------------------------------------------------------------------------------------------------------ */

/* If the rules have a price for what pairs left in conflict lack: moves bodies to where that costs least, and leaves no
 * conflict worse. */
sunder_status sunder_i_solver_ease(sunder_i_solver *solver, sunder_error *err);

/* ---- eased_starts.c ---------------------------------------------------------------------------------------------- */

/* What the trees of clusters have to know. */
typedef struct sunder_i_eased_starts {
    sunder_i_id_pair *pair; /* [pairs] sorted: the pairs of bodies in conflict, of which the first may move; owned */
    size_t pairs;
    uint32_t *group_of;      /* [bodies] the root of its cluster; SUNDER_I_NOBODY: it does not move; owned */
    sunder_i_waiver *waived; /* [waived_n] owned */
    size_t waived_n;
} sunder_i_eased_starts;

/* On failure the caller frees *starts, too. */
sunder_status sunder_i_eased_starts_init(sunder_i_solver *solver, sunder_i_eased_starts *starts, sunder_error *err);
void sunder_i_eased_starts_free(sunder_i_eased_starts *starts);
/* Eases a small cluster from other starts; a sunder_i_cluster_work whose context is a sunder_i_eased_starts. */
sunder_status sunder_i_eased_starts_try(const sunder_i_solver *solver, sunder_i_cluster *cluster, double *move,
                                        void *context, sunder_error *err);

/* ---- in_contact.c ------------------------------------------------------------------------------------------------ */

/* After contact groups were gathered: moves wanted groups that have moved to places in contact without a margin, if
 * doubles can represent these, they cost less, and they pass the exact check. */
sunder_status sunder_i_solver_put_in_contact(sunder_i_solver *solver, sunder_error *err);
/* After clusters were gathered: sends home the bodies whose moves are as short as margins, if they pass the exact check
 * there. */
sunder_status sunder_i_solver_return_home(sunder_i_solver *solver, sunder_error *err);

/* ---- contact_groups.c -------------------------------------------------------------------------------------------- */

/* Finds the contact groups of the present layout. A group that has not changed keeps its proof. */
sunder_status sunder_i_solver_gather_groups(sunder_i_solver *solver, sunder_error *err);
void sunder_i_groups_free(sunder_i_groups *groups);
/* From now on the two bodies are in one group. Returns false if memory is out. (optimise.c) */
bool sunder_i_groups_join(sunder_i_groups *groups, uint32_t one, uint32_t other);

/* ---- optimise.c -------------------------------------------------------------------------------------------------- */

/* Lists the conflicts of the present layout, and the demands on them. *list is the caller's, also on failure. */
sunder_status sunder_i_solver_find_waivers(const sunder_i_solver *solver, sunder_i_waiver **list, size_t *n,
                                           sunder_error *err);
/* Does so for the groups: in solver->groups.waived. */
sunder_status sunder_i_solver_list_waivers(sunder_i_solver *solver, sunder_error *err);
/* Proves a lower bound of the cost of each contact group; cheaper layouts found on the way are used. */
sunder_status sunder_i_solver_optimise(sunder_i_solver *solver, sunder_error *err);

/* ---- spared_pairs.c ---------------------------------------------------------------------------------------------- */

/* Is (a, b) one of the spared pairs? */
bool sunder_i_solver_is_spared(const sunder_i_solver *solver, const sunder_i_spared *spared, uint32_t a, uint32_t b);
/* Is there a relaxed pair, with a movable body, that is not spared? */
bool sunder_i_solver_is_beyond_limits(const sunder_i_solver *solver, const sunder_i_spared *spared);
/* Input and output of sunder_i_solver_prove(). */
typedef struct sunder_i_proving {
    const sunder_i_spared *spared;   /* pairs that stay in conflict */
    const sunder_i_spared *relaxed;  /* the pairs that the model has relaxed; those of them that are not spared have
                                      * to be solved all the same; or NULL */
    const sunder_i_list *heeded;     /* ascending; conflicts of other things are ignored; the first part stands for a
                                      * barrier. NULL: none is ignored */
    sunder_i_planes *planes;         /* planes of this solver, kept between calls */
    sunder_i_precedents *precedents; /* earlier proofs of this solver; or NULL */
    bool in_plane;                   /* use the plane of relative moves of two bodies alone, which is quicker and
                                      * proves less */
    bool seeks;                      /* a layout in doubles is sought: more is demanded, subproblem.slack; the verdict
                                      * feasible is then about all conflicts together, and infeasible is no proof */
    double held_margin;              /* if seeks: spared pairs that move apart in `near` stand better by this length */
    const double *near;              /* [2 * bodies] solutions near this layout are looked for first; or NULL */
    uint64_t effort;                 /* for all conflicts together, in constraints examined; 0: EFFORT_BRIEFLY */
    double *move;                    /* [2 * bodies] receives the solutions found; or NULL */
} sunder_i_proving;

/* Asks with little effort about the conflicts that are not spared: infeasible if it is proved that they cannot all be
 * solved, feasible if each has a solution by itself, up to rounding. *gap: on entry the gap that is asked about, at
 * most the model's; if there is a proof, about the least gap for which the same proof holds. */
sunder_status sunder_i_solver_prove(const sunder_i_solver *solver, const sunder_i_proving *how,
                                    sunder_i_verdict *verdict, double *gap, sunder_error *err);
/* Moves all movable bodies to the layout move[2 * bodies], rounded, and relates them. *well if no limit is exceeded and
 * no feature jumps over another. */
sunder_status sunder_i_solver_place_all(sunder_i_solver *solver, const double *move, bool *well, sunder_error *err);
/* Before the model is cut into pieces: relaxes the spared pairs, so that nothing more is demanded of them. */
sunder_status sunder_i_solver_spare(sunder_i_solver *solver, const sunder_i_spared *spared, sunder_error *err);

/* ---- worsened_pairs.c, uphold.c ---------------------------------------------------------------------------------- */

/* Is r a conflict that is always listed, whatever the options? Members of one block count only if they overlap and do
 * not merely touch. */
bool sunder_i_solver_is_always_listed(const sunder_i_solver *solver, const sunder_i_relation *r);
/* *breaks if r is a conflict that is always listed (sunder_i_solver_is_always_listed()), and is worse than at the
 * start. */
sunder_status sunder_i_solver_breaks_rule(sunder_i_solver *solver, const sunder_i_relation *r, bool *breaks,
                                          sunder_error *err);
/* *worse if the conflict r is worse than at the start, or was none there. The answer is exact. */
sunder_status sunder_i_solver_is_worse(sunder_i_solver *solver, const sunder_i_relation *r, bool *worse,
                                       sunder_error *err);
/* The budgets for sunder_i_solver_mend(), owned by the caller. Each cluster has its own, so that the result for one
 * does not depend on others. NULL if memory is out. */
size_t *sunder_i_solver_patience(const sunder_i_solver *solver);
/* Moves one of the pair's bodies, or a row of bodies, slightly, so that the pair is no worse than at the start and no
 * other pair breaks a rule. *well if there is such a place. budget: [bodies] by roots of clusters: how many bodies may
 * still be moved without success. */
sunder_status sunder_i_solver_mend(sunder_i_solver *solver, const sunder_i_relation *r, size_t *budget, bool *well,
                                   sunder_error *err);
/* Repairs or undoes, pair by pair, what rounding made worse than at the start. */
sunder_status sunder_i_solver_uphold(sunder_i_solver *solver, sunder_error *err);
/* *upheld if no conflict is worse than at the start, and no feature has jumped over another. */
sunder_status sunder_i_solver_is_upheld(sunder_i_solver *solver, bool *upheld, sunder_error *err);

#endif
