/* The report: what was done, feature by feature, what remains, and what is proved of it. */
#ifndef SUNDER_I_REPORT_H
#define SUNDER_I_REPORT_H

#include "displacement/prove/areas/areas.h"
#include "displacement/solve/clusters/solver.h"
#include "sunder_parts.h"
#include "sunder_proof.h"

/* ---- report.c ---------------------------------------------------------------------------------------------------- */

struct sunder_report {
    size_t n;
    double *move;                  /* [2 * n] */
    sunder_feature_status *status; /* [n] */
    int64_t *block;                /* [n] */
    sunder_conflict *conflict;
    size_t conflicts;
    size_t *blocker;      /* what all blocked_by point into */
    sunder_proof **proof; /* [conflicts] NULL: there is none; the array too, in a check */
    bool stripped;        /* proofs are stripped to the features they name */
    sunder_bound_pair *bound_pair;
    size_t bound_pairs;
    sunder_bound_tree *bound_tree;
    size_t bound_trees;
    sunder_push *push;
    size_t pushes;
    /* Where worlds are kept; else NULL: */
    sunder_world *world;
    size_t worlds, world_room;
    size_t *world_of; /* [n] as the caller numbers features, like the two that follow */
    size_t *inside;   /* [n] */
    bool *inexact;    /* [n] */
    bool *stands;     /* [n] its block may not move */
    sunder_footprint *footprint;
    size_t footprints;
    sunder_world_bound *world_bound;
    size_t world_bounds;
    bool *thin;                /* [relations at the start] */
    double *proved, *by_pairs; /* [bodies] what is proved of a part, at its root; by_pairs NULL: all by pairs */
    sunder_layer_summary summary;
};

/* A report of nothing as yet. */
sunder_status sunder_i_report_new(const sunder_i_model *model, sunder_report **out, sunder_error *err);
/* Allocates, once, the parts of the report that have an entry for each feature: blocks, and statuses of those that have
 * not moved. */
sunder_status sunder_i_report_features(sunder_report *report, const sunder_i_model *model, sunder_error *err);
/* Moves, statuses and their sums, which are exact until they are rounded once: so they are the same however the work
 * was shared out and however features were listed. */
void sunder_i_report_moves(sunder_report *report, const sunder_i_model *model);
/* Adds one to the count of the conflict's kind. */
void sunder_i_count(sunder_conflict_counts *counts, const sunder_conflict *conflict);

/* ---- renumber.c -------------------------------------------------------------------------------------------------- */

/* The report on a layer in the order of work, as one on the layer as it was given: number[k] is what feature k was. */
sunder_status sunder_i_report_renumber(sunder_report *report, const uint32_t *number, sunder_error *err);

/* ---- remaining_conflicts.c --------------------------------------------------------------------------------------- */

/* Fills the report's conflicts from the relations as the features stand. start: the relations and placement before
 * anything moved (equal to the others in a check). reasons: fill the reason of what remains between blocks, as far
 * as it shows in the pair by itself. */
sunder_status sunder_i_report_conflicts(sunder_report *report, const sunder_i_model *model,
                                        const sunder_i_placement *placement, const sunder_i_relations *relations,
                                        bool reasons, sunder_error *err);
/* The conflict that relation *k is, of a feature and a thing, and which relation comes next; false: it is none. Of the
 * conflict only what is needed to count it. */
bool sunder_i_next_conflict(const sunder_i_model *model, const sunder_i_relations *relations, size_t *k, uint32_t *a,
                            uint32_t *b, sunder_conflict *conflict);
/* Counts what the relations amount to, without listing it. */
void sunder_i_count_relations(const sunder_i_model *model, const sunder_i_relations *relations,
                              sunder_conflict_counts *counts);

/* ---- cover_diagonals.c ------------------------------------------------------------------------------------------- */

/* Makes the seams of all bodies that questions about remaining or given-up conflicts may reach; before any is asked. */
sunder_status sunder_i_report_cover_diagonals(sunder_i_solver *solver, sunder_error *err);

/* ---- pair_reasons.c ---------------------------------------------------------------------------------------------- */

/* Why conflicts between blocks remain, as far as each pair itself tells: `fixed`, `max_shift`, `side`, `jump`,
 * decided exactly; else `unresolved`. Of a side or a jump the proof that it was decided by; of a limit one, if trees
 * are kept and it is found. */
sunder_status sunder_i_report_reasons(sunder_report *report, const sunder_i_model *model, sunder_error *err);

/* ---- thin_overlaps.c --------------------------------------------------------------------------------------------- */

/* Counts, in the summary, the pairs between blocks that overlap by no more than the rules' `thin`; 0 where that is
 * 0. */
sunder_status sunder_i_count_thin_overlaps(const sunder_i_model *model, const sunder_i_placement *placement,
                                           const sunder_i_relations *relations, sunder_report *report,
                                           sunder_error *err);

/* ---- bound.c, bound_pairs.c -------------------------------------------------------------------------------------- */

/* Multipliers for the pairs (blocks by number in body_of), and the bound proved by them. Pairs with least = 0 get
 * none. *proved: where worlds are kept, [bodies] what is proved of each part, at its root; the caller's; else NULL. */
sunder_status sunder_i_bound(const sunder_i_model *model, sunder_bound_pair *pairs, size_t n, double *bound,
                             double **proved, sunder_error *err);
/* What they prove of each part of the layer: value[], [bodies] and 0, at its root in the union-find root[]. What is
 * fixed is of no part. False if memory is out. */
bool sunder_i_bound_parts(const sunder_i_model *model, const sunder_bound_pair *pairs, size_t n, uint32_t *root,
                          double *value);
/* Fills the report's pairs for the lower bound, and the bound. */
sunder_status sunder_i_report_bound(sunder_report *report, const sunder_i_solver *solver, sunder_error *err);

/* ---- parts.c ----------------------------------------------------------------------------------------------------- */

/* Divides the layer into independent parts: bodies connected by pairs that contribute to a bound, or by a contact group
 * of which something is proved. So which of the two proves more is decided in each part by itself. Fixed bodies connect
 * nothing. */
typedef struct sunder_i_parts {
    uint32_t *root;    /* [bodies] union-find */
    double *by_pairs;  /* [bodies] what the pairs prove of the part; at its root */
    double *by_trees;  /* [bodies] at first the same; then what trees of these pairs prove, 0 where none are made */
    double *by_groups; /* [bodies] what its groups prove, added up */
    double *by_areas;  /* [bodies] what prices of area prove of it, where that is more; -1: of another part with it */
    struct sunder_i_area_bound *area; /* of those parts, by their roots */
    size_t areas;
} sunder_i_parts;

/* What a part costs because its bodies, these, share no area. */
typedef struct sunder_i_area_bound {
    uint32_t root;
    double bound;
    uint32_t *body; /* [n]; owned */
    size_t n;
    sunder_i_prices prices; /* owned */
} sunder_i_area_bound;

/* Failure leaves what sunder_i_parts_free() takes. */
sunder_status sunder_i_parts_find(sunder_i_parts *parts, const sunder_report *report, const sunder_i_solver *solver,
                                  sunder_error *err);
void sunder_i_parts_free(sunder_i_parts *parts);
/* Do its pairs prove more than its groups by more than trees are short of pairs? Then trees of them are worth it. */
bool sunder_i_part_wants_pair_trees(const sunder_i_parts *parts, uint32_t body);
/* By what is most proved of its part: by trees of pairs? By its groups? */
bool sunder_i_part_is_by_pairs(const sunder_i_parts *parts, uint32_t body);
bool sunder_i_part_is_by_groups(const sunder_i_parts *parts, uint32_t body);
/* The better bound of the part whose root the body is; of any other body 0. */
double sunder_i_part_bound(const sunder_i_parts *parts, uint32_t body);

/* ---- area_bounds.c ----------------------------------------------------------------------------------------------- */

/* Computes bounds by area for parts where less than nearly all of the cost is proved. Blocks are united for that. */
sunder_status sunder_i_report_area_bounds(sunder_i_solver *solver, sunder_i_parts *parts, sunder_error *err);
/* Adds the tree of each such part. */
sunder_status sunder_i_report_area_trees(sunder_report *report, const sunder_i_solver *solver, sunder_i_parts *parts,
                                         sunder_error *err);

/* ---- optimality.c ------------------------------------------------------------------------------------------------ */

/* Contact groups, those of them that are optimal, and the bound: of each part of the layer what trees of its pairs, its
 * groups, or prices of area prove, whichever is most; with the trees, where these are kept. */
sunder_status sunder_i_report_optimality(sunder_report *report, sunder_i_solver *solver, sunder_error *err);

/* ---- pair_trees.c ------------------------------------------------------------------------------------------------ */

/* What trees prove of the pairs of those parts where that may be more than groups do: parts->by_trees. The trees, to be
 * freed by sunder_i_bound_trees_free(), have the roots of their parts for groups, and are kept where proofs are. */
sunder_status sunder_i_report_pair_trees(const sunder_report *report, sunder_i_solver *solver, sunder_i_parts *parts,
                                         sunder_i_bound_trees *trees, sunder_error *err);

/* ---- contact_pushes.c -------------------------------------------------------------------------------------------- */

/* How hard pairs in contact are pressed, where that is wanted. */
sunder_status sunder_i_report_pushes(sunder_report *report, sunder_i_solver *solver, sunder_error *err);

/* ---- no_room.c --------------------------------------------------------------------------------------------------- */

/* Answers a question about a few bodies: sunder_i_decide() (prove/proofs/feasibility.h). */
struct sunder_i_subproblem;
struct sunder_i_decision;
typedef sunder_status (*sunder_i_decide_subproblem)(const struct sunder_i_subproblem *subproblem,
                                                    struct sunder_i_decision *decision, sunder_error *err);
/* Tells what cannot be resolved from what was not: of the report's conflicts, those with a proof have "no_room". */
sunder_status sunder_i_report_proofs(sunder_report *report, const sunder_i_solver *solver,
                                     sunder_i_decide_subproblem decide, sunder_error *err);

/* ---- crowd_needs.c ----------------------------------------------------------------------------------------------- */

/* The need_shift of all conflicts of a cluster, from a layout that solves them, if one is known and not all is solved:
 * for clusters of many conflicts (crowds), or for the others. All bodies stand as in the result before and after. */
sunder_status sunder_i_report_crowd_needs(sunder_report *report, sunder_i_solver *solver, bool crowds,
                                          sunder_error *err);

/* ---- needs.c ----------------------------------------------------------------------------------------------------- */

/* Is it asked first whether a proof tells that there is no solution, and does one? Or is the layer to be left as it
 * was given, prepared for such questions? */
typedef enum sunder_i_proof_found {
    SUNDER_I_PROOF_UNASKED,
    SUNDER_I_PROOF_WANTED,
    SUNDER_I_PROOF_LATER,
    SUNDER_I_PROOF_IN_VAIN,
    SUNDER_I_PROOF_FOUND
} sunder_i_proof_found;

/* Solves a layer without much ado, to where its report would begin: all but those pairs of its features and barriers,
 * sorted, which may stand as they do. *proof: wanted or not, and then what came of it, if it came to that. The solver
 * is to be freed, also on failure. */
typedef sunder_status (*sunder_i_solve_layer)(const sunder_layer *layer, const sunder_layer_options *options,
                                              const sunder_i_id_pair *spared, size_t n, sunder_i_proof_found *proof,
                                              sunder_i_solver *solver, sunder_error *err);
/* Fills the conflicts' need_shift, need_gap and need_gone; after what blocks them is known, and what crowds need. */
sunder_status sunder_i_report_needs(sunder_report *report, const sunder_i_solver *solver,
                                    const sunder_layer_options *options, sunder_i_solve_layer solve, sunder_error *err);

/* ---- spread_out.c ------------------------------------------------------------------------------------------------ */

/* Moves that separate boxes which are in conflict at the start, for bodies in ascending order, and for the bodies that
 * stand where they move to: into goal, which has an entry for each body. *found: there are such moves. */
sunder_status sunder_i_spread_out(const sunder_i_solver *solver, sunder_i_list *body, double *goal, bool *found,
                                  sunder_error *err);

/* ---- worlds.c ---------------------------------------------------------------------------------------------------- */

/* Which parts of the layer had nothing to do with each other, where that is wanted; last of all. */
sunder_status sunder_i_report_worlds(sunder_report *report, const sunder_i_solver *solver, sunder_error *err);

/* ---- blockers.c -------------------------------------------------------------------------------------------------- */

/* Fills the conflicts' blocked_by. */
sunder_status sunder_i_report_blockers(sunder_report *report, const sunder_i_solver *solver, sunder_error *err);

#endif
