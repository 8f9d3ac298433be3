/* The report: the move and status of each feature, what remains in conflict, and what is proved of it. */
#ifndef SUNDER_I_REPORT_H
#define SUNDER_I_REPORT_H

#include "displacement/layer/prices.h"
#include "displacement/prove/areas/areas.h"
#include "displacement/rows/rows.h"
#include "displacement/solve/clusters/solver.h"
#include "sunder_parts.h"
#include "sunder_proof.h"

/* ---- report.c ---------------------------------------------------------------------------------------------------- */

/* What the figures of rows depend on: the kink that counts, and the stiffness of springs. */
typedef struct sunder_i_row_figures {
    double kink, stiffness[2];
} sunder_i_row_figures;

/* The prices of the pairs of a body; of two bodies that may both move one has the pair. */
typedef struct sunder_i_paying {
    size_t pairs;
    double missing;     /* what they lack, in sum */
    double pays, alone; /* at the present place; at least, whatever place each pair has */
} sunder_i_paying;

/* What a pair of bodies lacks. The first may move; a barrier has the body of its first part. */
typedef struct sunder_i_lacking {
    uint32_t i, j;
    double missing, home; /* at the present place; at home, rounded down */
    double alone;         /* the least price, whatever place the two have */
} sunder_i_lacking;

/* What is kept of the layer as given, before features are hidden or become smaller. */
typedef enum sunder_i_home_fact {
    SUNDER_I_HOME_MET,      /* two things are in conflict, or one lies in the other and may do so */
    SUNDER_I_HOME_THIN,     /* they overlap by no more than the rules' `thin` */
    SUNDER_I_HOME_CONFLICT, /* a conflict that is counted, parts of a barrier combined */
} sunder_i_home_fact;
typedef struct sunder_i_home_pair {
    uint32_t a, b;
    sunder_i_home_fact fact;
    sunder_conflict_kind kind; /* of a conflict, and the next */
    bool inside;               /* it is inside a block */
} sunder_i_home_pair;

struct sunder_report {
    size_t n;
    double *move;                  /* [2 * n] the moves, x and y alternating */
    sunder_feature_status *status; /* [n] the status of each feature */
    int64_t *block;                /* [n] the block of each feature, as the number of its first member; -1 if it has
                                    * none */
    sunder_conflict *conflict;
    size_t conflicts;
    sunder_conflict *tight; /* [summary.tight] pairs that are tight, until they become part of the list of conflicts */
    size_t *blocker;        /* the array into which blocked_by of all conflicts points */
    sunder_proof **proof;   /* [conflicts] NULL where there is no proof; the array is NULL in a check */
    bool stripped;          /* proofs contain only the features that they name */
    sunder_bound_pair *bound_pair;
    size_t bound_pairs;
    sunder_bound_tree *bound_tree;
    size_t bound_trees;
    sunder_push *push;
    size_t pushes;
    sunder_row_pair *row_pair; /* [row_pairs], and after these [hidden_row_pairs] with a hidden end */
    size_t row_pairs, hidden_row_pairs;
    sunder_i_row_figures row_figures;
    sunder_row_list row_list;
    sunder_hiding_summary hiding;
    sunder_clause *clause; /* [hiding.clauses] their members and things are in clause_number */
    size_t *clause_number;
    sunder_hiding_class *hiding_class, *component_class; /* of all; and those of each component */
    size_t hiding_classes, component_classes;
    sunder_hiding_component *component; /* [hiding.components] */
    sunder_hiding_trees hiding_trees;
    uint32_t *clause_level; /* the levels of the clauses' members */
    uint32_t *level;        /* [n] in the caller's numbers of features; NULL: none can become smaller */
    /* The following are NULL unless the worlds (the parts of the layer that did not influence each other) are
     * wanted. */
    sunder_world *world;
    size_t worlds, world_room;
    size_t *world_of; /* [n] in the caller's numbers of features, like the next three arrays */
    size_t *inside;   /* [n] conflicts at the start inside a block without a world, counted at the first feature */
    bool *inexact;    /* [n] whether the moved coordinates were rounded */
    bool *stands;     /* [n] whether the feature's block is fixed */
    double (*row_reach)[4]; /* [n] for sunder_report_row_reach(); NULL if no rows are wanted */
    sunder_footprint *footprint;
    size_t footprints;
    sunder_world_bound *world_bound;
    size_t world_bounds;
    bool *thin; /* [relations at the start] whether the pair overlaps by no more than the rules'
                                * `thin`, until they become part of: */
    sunder_i_home_pair *home_pair;
    size_t home_pairs;
    double *proved, *by_pairs; /* [bodies] what is proved of each part, at the part's root, in all and by pairs;
                                * by_pairs is NULL if all is by pairs */
    sunder_i_lacking *lacking; /* [eased] the eased pairs, sorted by i, then by j */
    size_t eased;
    sunder_i_paying *paying; /* [bodies] if pairs are eased; else NULL */
    sunder_layer_summary summary;
};

/* Makes an empty report. */
sunder_status sunder_i_report_new(const sunder_i_model *model, sunder_report **out, sunder_error *err);
/* Allocates the arrays of the report that have an entry for each feature, and fills in blocks and the statuses of
 * features that have not moved. To be called once. */
sunder_status sunder_i_report_features(sunder_report *report, const sunder_i_model *model, sunder_error *err);
/* Fills in moves, statuses, and the sums of them. The sums are exact until they are rounded once, so they do not depend
 * on the number of threads or on the order of the features. */
void sunder_i_report_moves(sunder_report *report, const sunder_i_model *model);
/* Removes the list of conflicts, with their proofs. */
void sunder_i_report_forget_conflicts(sunder_report *report);
/* Adds one to the count of the conflict's kind. */
void sunder_i_count(sunder_conflict_counts *counts, const sunder_conflict *conflict);

/* ---- renumber.c -------------------------------------------------------------------------------------------------- */

/* Converts the report from the internal order of features to the caller's: number[k] is the caller's number of feature
 * k. */
sunder_status sunder_i_report_renumber(sunder_report *report, const uint32_t *number, sunder_error *err);
/* The same for a proof. */
void sunder_i_proof_number(sunder_proof *proof, const uint32_t *number);

/* ---- remaining_conflicts.c --------------------------------------------------------------------------------------- */

/* Fills the report's conflicts from the relations of the features at the positions of `placement`. reasons: also
 * determine why pairs of different bodies remain in conflict, as far as the pair alone shows it. */
sunder_status sunder_i_report_conflicts(sunder_report *report, const sunder_i_model *model,
                                        const sunder_i_placement *placement, const sunder_i_relations *relations,
                                        bool reasons, sunder_error *err);
/* Combines relation *k and those of the same feature to other parts of the same barrier, and advances *k to the next
 * relation. Sets *a to the feature and *b to the other feature or the barrier. Returns whether they are in conflict;
 * *conflict then has the members that sunder_i_count() needs. */
bool sunder_i_next_conflict(const sunder_i_model *model, const sunder_i_relations *relations, size_t *k, uint32_t *a,
                            uint32_t *b, sunder_conflict *conflict);
/* Counts the conflicts among the relations by their kinds, without listing them. */
void sunder_i_count_relations(const sunder_i_model *model, const sunder_i_relations *relations,
                              sunder_conflict_counts *counts);

/* Measures n pairs at the positions of `placement`: how far apart they are, or how deep they overlap, and the link.
 * overlap: [n] whether each overlaps; NULL: none does. reasons: also measure how far apart they were at the start. */
sunder_status sunder_i_report_measure(const sunder_i_model *model, const sunder_i_placement *placement,
                                      sunder_conflict *conflict, size_t n, const bool *overlap, bool reasons,
                                      sunder_error *err);

/* ---- tight_list.c ------------------------------------------------------------------------------------------------ */

/* Lists the tight pairs in report->tight, once the conflicts are known. reasons: as in sunder_i_report_conflicts(). */
sunder_status sunder_i_report_tight(sunder_report *report, const sunder_i_model *model,
                                    const sunder_i_placement *placement, bool reasons, sunder_error *err);
/* Adds the tight pairs to the list of conflicts. From then on all entries are measured by their full distances. */
sunder_status sunder_i_report_add_tight(sunder_report *report, const sunder_i_model *model, sunder_error *err);

/* ---- eased_pairs.c ----------------------------------------------------------------------------------------------- */

/* If pairs are eased: computes what the conflicts lack, the prices of that, and the least prices. */
sunder_status sunder_i_report_eased(sunder_report *report, const sunder_i_model *model, sunder_error *err);
/* Sorts n pairs by bodies, and merges those of two bodies. Returns the number of pairs that remain. */
size_t sunder_i_merge_lacking(sunder_i_lacking *list, size_t n);

/* ---- eased_groups.c ---------------------------------------------------------------------------------------------- */

/* Raises the bounds of the groups with eased pairs by trees. The costs of the groups and the waivers are known. */
sunder_status sunder_i_report_eased_groups(const sunder_report *report, sunder_i_solver *solver, sunder_error *err);

/* ---- cover_diagonals.c ------------------------------------------------------------------------------------------- */

/* Makes the covers of the diagonals of all bodies that questions about remaining or given-up conflicts may reach. To be
 * called before any such question. */
sunder_status sunder_i_report_cover_diagonals(sunder_i_solver *solver, sunder_error *err);

/* ---- pair_reasons.c ---------------------------------------------------------------------------------------------- */

/* Determines why conflicts between features of different bodies remain, as far as each pair alone shows it: the reason
 * is `fixed`, `max_shift`, `side` or `jump` if that is proved, otherwise `unresolved`. For `side` and `jump` the proof
 * is kept; a pair that is shut in gets `jump` even if no proof is found. For `max_shift` a proof is kept if trees are
 * kept and one is found. */
sunder_status sunder_i_report_reasons(sunder_report *report, const sunder_i_model *model, sunder_error *err);

/* ---- thin_overlaps.c --------------------------------------------------------------------------------------------- */

/* Sets summary.thin of the report to the number of pairs of features of different bodies that overlap by no more than
 * the rules' `thin`. Barriers, and pairs of which one feature contains the other, are not counted. The count is 0 if
 * `thin` is 0. */
sunder_status sunder_i_count_thin_overlaps(const sunder_i_model *model, const sunder_i_placement *placement,
                                           const sunder_i_relations *relations, sunder_report *report,
                                           sunder_error *err);

/* ---- bound.c, bound_pairs.c -------------------------------------------------------------------------------------- */

/* Computes multipliers for the n pairs and the lower bound *bound that they prove. Pairs with least = 0 get the
 * multiplier 0. If worlds are kept and n > 0, *proved becomes an array [bodies] of what is proved of each part, at its
 * root, which the caller frees; otherwise NULL. */
sunder_status sunder_i_bound(const sunder_i_model *model, sunder_bound_pair *pairs, size_t n, double *bound,
                             double **proved, sunder_error *err);
/* Adds to value[] ([bodies], all 0) what the pairs prove of each part of the layer, at its root in the union-find
 * root[]. Fixed bodies belong to no part. Returns false if memory is out. */
bool sunder_i_bound_parts(const sunder_i_model *model, const sunder_bound_pair *pairs, size_t n, uint32_t *root,
                          double *value);
/* Fills the report's pairs for the lower bound, and the bound itself. */
sunder_status sunder_i_report_bound(sunder_report *report, const sunder_i_solver *solver, sunder_error *err);

/* ---- independent_parts.c ----------------------------------------------------------------------------------------- */

/* The independent parts of the layer. Bodies belong to the same part if they are connected by pairs that contribute to
 * the bound, or by a contact group of which something is proved; fixed bodies connect nothing. In each part it is
 * decided separately whether its pairs or its groups prove more. */
typedef struct sunder_i_independent_parts {
    uint32_t *root;    /* [bodies] union-find; all bodies of a part have the same root */
    double *by_pairs;  /* [bodies] what the pairs prove of the part; at its root, like the following */
    double *by_trees;  /* [bodies] at first equal to by_pairs; then what the trees of these pairs prove, or 0 if no
                        * trees are made */
    double *by_groups; /* [bodies] the sum of what the contact groups prove */
    double *by_areas;  /* [bodies] the bound by prices of area where it is greater than by_groups, otherwise 0; -1 if
                        * the bound of another part includes it */
    struct sunder_i_area_bound *area; /* [areas] the bounds by area */
    size_t areas;
} sunder_i_independent_parts;

/* A lower bound on the cost of joint parts, proved because the n bodies listed here may not overlap. */
typedef struct sunder_i_area_bound {
    uint32_t root;
    double bound;
    uint32_t *body; /* [n]; owned */
    size_t n;
    sunder_i_prices prices; /* owned */
} sunder_i_area_bound;

/* The caller calls sunder_i_independent_parts_free() even if this fails. */
sunder_status sunder_i_independent_parts_find(sunder_i_independent_parts *parts, const sunder_report *report,
                                              const sunder_i_solver *solver, sunder_error *err);
void sunder_i_independent_parts_free(sunder_i_independent_parts *parts);
/* Returns whether trees should be made for the pairs of the part of `body`: it has no bound by prices of area, and its
 * pairs prove more than its contact groups, even after subtracting what trees lose against pairs. */
bool sunder_i_independent_part_wants_pair_trees(const sunder_i_independent_parts *parts, uint32_t body);
/* Return whether trees of pairs, or contact groups, prove the most of the part of `body`; if they prove the same, the
 * second function returns true. Both return false if the part has a bound by prices of area. */
bool sunder_i_independent_part_is_by_pairs(const sunder_i_independent_parts *parts, uint32_t body);
bool sunder_i_independent_part_is_by_groups(const sunder_i_independent_parts *parts, uint32_t body);
/* Returns the best bound of the part whose root is `body`, and 0 if `body` is no root. */
double sunder_i_independent_part_bound(const sunder_i_independent_parts *parts, uint32_t body);

/* ---- area_bounds.c ----------------------------------------------------------------------------------------------- */

/* Computes bounds by area for the parts of which less than nearly the whole cost is proved. Members of blocks are
 * united for that. */
sunder_status sunder_i_report_area_bounds(sunder_i_solver *solver, sunder_i_independent_parts *parts,
                                          sunder_error *err);
/* Adds a tree to the report for each bound by area. */
sunder_status sunder_i_report_area_trees(sunder_report *report, const sunder_i_solver *solver,
                                         sunder_i_independent_parts *parts, sunder_error *err);

/* ---- optimality.c ------------------------------------------------------------------------------------------------ */

/* Computes the number of contact groups, the number of those that are optimal, and the lower bound of the layer: for
 * each part the largest of what trees of its pairs, its groups, or prices of area prove. Keeps the trees if they are
 * wanted. */
sunder_status sunder_i_report_optimality(sunder_report *report, sunder_i_solver *solver, sunder_error *err);

/* ---- pair_trees.c ------------------------------------------------------------------------------------------------ */

/* Sets parts->by_trees to what trees prove of the pairs, for parts where that may exceed what the groups prove, and to
 * 0 for all others. If trees are kept, they are added to `trees` with the root of their part as the group; the caller
 * frees them with sunder_i_bound_trees_free(). */
sunder_status sunder_i_report_pair_trees(const sunder_report *report, sunder_i_solver *solver,
                                         sunder_i_independent_parts *parts, sunder_i_bound_trees *trees,
                                         sunder_error *err);

/* ---- row_kinks.c ------------------------------------------------------------------------------------------------- */

/* Fills in the pairs of neighbours in rows, with their moves. */
sunder_status sunder_i_report_row_pairs(sunder_report *report, const sunder_i_model *model, const sunder_i_rows *rows,
                                        sunder_error *err);
/* Converts the pairs to the caller's numbers, number[k] for feature k, and joins them to rows. Adds the cost of their
 * springs to that of the moves. The report has its blocks in the caller's numbers. */
sunder_status sunder_i_report_number_rows(sunder_report *report, const uint32_t *number, sunder_error *err);

/* ---- contact_pushes.c -------------------------------------------------------------------------------------------- */

/* Computes the forces of pairs in contact, if the rules ask for them. */
sunder_status sunder_i_report_pushes(sunder_report *report, sunder_i_solver *solver, sunder_error *err);

/* ---- no_room.c --------------------------------------------------------------------------------------------------- */

/* The type of sunder_i_decide() (prove/proofs/feasibility.h), which answers a question about a few bodies. */
struct sunder_i_subproblem;
struct sunder_i_decision;
typedef sunder_status (*sunder_i_decide_subproblem)(const struct sunder_i_subproblem *subproblem,
                                                    struct sunder_i_decision *decision, sunder_error *err);
/* Finds, among the report's conflicts with the reason "unresolved", those that provably have no solution, and sets
 * their reason to "no_room". Marks those as `crowded` for which it is proved only that a few features around the pair
 * have too little room (no_room.c). Keeps a proof of each. one_each: for each cluster the work ends with the first
 * proof that does not rest on the coordinates that corners can have. */
sunder_status sunder_i_report_proofs(sunder_report *report, const sunder_i_solver *solver,
                                     sunder_i_decide_subproblem decide, bool one_each, sunder_error *err);

/* ---- cluster_needs.c --------------------------------------------------------------------------------------------- */

/* For each cluster with a conflict whose need_shift is still NAN: tries known layouts of the whole cluster, and lowers
 * need_shift of all conflicts that a layout solves to the longest move in it. large: only clusters with more than
 * NEED_PATIENCE conflicts are examined; otherwise only the others. All bodies have their moves of the result before and
 * after the call. */
sunder_status sunder_i_report_cluster_needs(sunder_report *report, sunder_i_solver *solver, bool large,
                                            sunder_error *err);

/* ---- needs.c ----------------------------------------------------------------------------------------------------- */

/* Whether the solver first attempts to prove that there is no solution (..._WANTED), does not (..._UNASKED), or leaves
 * the layer unsolved and only prepares it for such proofs (..._LATER); and the outcome of the attempt. */
typedef enum sunder_i_proof_found {
    SUNDER_I_PROOF_UNASKED,
    SUNDER_I_PROOF_WANTED,
    SUNDER_I_PROOF_LATER,
    SUNDER_I_PROOF_IN_VAIN,
    SUNDER_I_PROOF_FOUND
} sunder_i_proof_found;

struct sunder_i_spared;
/* Solves a small layer up to the point where its report would begin. The spared pairs may remain in conflict. *proof
 * says whether a proof is wanted, and becomes the outcome if one was attempted. The caller frees the solver even if
 * this fails. */
typedef sunder_status (*sunder_i_solve_layer)(const sunder_layer *layer, const sunder_layer_options *options,
                                              const struct sunder_i_spared *spared, sunder_i_proof_found *proof,
                                              sunder_i_solver *solver, sunder_error *err);
/* Fills the conflicts' need_shift, need_gap and need_gone. To be called after sunder_i_report_blockers() and the
 * examination of dense clusters. */
sunder_status sunder_i_report_needs(sunder_report *report, const sunder_i_solver *solver,
                                    const sunder_layer_options *options, sunder_i_solve_layer solve, sunder_error *err);

/* ---- spread_out.c ------------------------------------------------------------------------------------------------ */

/* Computes moves that separate the boxes which are in conflict at the start, for the bodies of `body` in ascending
 * order. Bodies that stand where these move to are added to `body`. The moves are written to goal[], which has two
 * entries for each body of the model. Sets *found to whether there are such moves. */
sunder_status sunder_i_spread_out(const sunder_i_solver *solver, sunder_i_list *body, double *goal, bool *found,
                                  sunder_error *err);

/* ---- worlds.c ---------------------------------------------------------------------------------------------------- */

/* Keeps what is needed of the relations of the layer as given, if the rules ask for worlds. */
sunder_status sunder_i_report_keep_home(sunder_report *report, const sunder_i_model *model,
                                        const sunder_i_relations *start, sunder_error *err);
typedef struct sunder_i_influence sunder_i_influence;
/* Determines which parts of the layer did not influence each other, if the rules ask for it. influence: that of earlier
 * layouts, and the last one is added. To be called last. */
sunder_status sunder_i_report_worlds(sunder_report *report, const sunder_i_solver *solver,
                                     sunder_i_influence *influence, sunder_error *err);

/* ---- blockers.c -------------------------------------------------------------------------------------------------- */

/* Fills the conflicts' blocked_by. */
sunder_status sunder_i_report_blockers(sunder_report *report, const sunder_i_solver *solver, sunder_error *err);

#endif
