/* How little could the moves of a contact group cost? Branch and bound proves a lower bound, and may find better
 * moves. */
#ifndef SUNDER_I_OPTIMUM_H
#define SUNDER_I_OPTIMUM_H

#include "displacement/layer/trace.h"
#include "displacement/prove/optimum/forbidden.h"
#include "sunder_proof.h"

/* Recorded trees, with things in processing order. Zeroed: none. */
typedef struct sunder_i_bound_trees {
    sunder_bound_tree *tree;
    size_t n, capacity;
} sunder_i_bound_trees;

struct sunder_i_group;

/* Functions of the search, which is a room above the proofs, that find better layouts of a group. */
typedef struct sunder_i_layout_search {
    /* Descends from the moves of n bodies, which need not be free, to moves that are free with `margin` beyond the gap.
     * Sets *found if they cost less than `cost`; they are rounded. */
    sunder_status (*descend)(const sunder_i_model *model, uint32_t *body, size_t n, double margin, double cost,
                             double *move, bool *found, sunder_error *err);
    /* Looks for better moves of the group by random perturbations, in at most `steps` steps. */
    sunder_status (*shake)(const sunder_i_model *model, const sunder_i_waived *waived, struct sunder_i_group *group,
                           uint64_t steps, sunder_error *err);
} sunder_i_layout_search;

/* How far the proof of a group is. A stage of the proof that finds a cheaper layout takes it to one of the last two
 * states; solve/clusters/optimise.c takes the layout over (then the group is proved), or not (then it is to be proved
 * again). */
typedef enum sunder_i_group_state {
    SUNDER_I_TO_BE_PROVED,
    SUNDER_I_IS_PROVED,        /* proved as far as its steps allow; its moves are those of the layout */
    SUNDER_I_IS_CHEAPER,       /* proved, but its moves cost less than those of the layout */
    SUNDER_I_IS_CHEAPER_TIGHT, /* proved, but its moves cost less, and leave no room for rounding */
} sunder_i_group_state;

/* Bodies that are in contact in a layout, and what is proved about them. No movable body is in two groups, so the
 * bounds of all groups add up. */
typedef struct sunder_i_group {
    uint32_t *body; /* [n] ascending, including fixed bodies in contact; owned */
    size_t n;
    uint32_t number;
    const sunder_i_layout_search *search;
    double margin;      /* the distance beyond the gap that a layout has to keep, to allow for rounding */
    double *move;       /* [2 * n] the present moves; replaced by better ones, rounded, if such are found; owned */
    double cost, bound; /* the cost of the moves, rounded upwards; a proved lower bound, rounded downwards */
    double asked;       /* the group's cost when it, or the groups it was made of, were last examined fully */
    double shaken_at;   /* its cost when it, or the groups it was made of, were last perturbed with all steps */
    bool held;          /* its moves must not change */
    bool with_slack;    /* layouts without room for rounding are not looked for: one failed the exact check */
    sunder_i_group_state state;
    sunder_i_list guests; /* bodies of no group that take part in the proof; owned */
    sunder_i_list joins;  /* bodies of other groups that block a cheaper layout; owned */
    bool shaken, tired;   /* it was perturbed with limited patience: in this round; in an earlier one */
    uint64_t steps;
    sunder_i_trace_log log;     /* what its stages did, if the layer is traced; owned */
    sunder_i_bound_trees trees; /* the trees that prove the bound, if they are kept; owned */
} sunder_i_group;

static inline bool sunder_i_group_is_cheaper(const sunder_i_group *group)
{
    return group->state >= SUNDER_I_IS_CHEAPER;
}

void sunder_i_group_free(sunder_i_group *group);
/* tree_record.c */
void sunder_i_bound_tree_free(sunder_bound_tree *tree);
void sunder_i_bound_trees_free(sunder_i_bound_trees *trees);
/* Moves the trees of `from` to the end of `to`. Returns false if memory is out. */
bool sunder_i_bound_trees_take(sunder_i_bound_trees *to, sunder_i_bound_trees *from);
/* tight_place.c: changes the moves of n bodies, good up to rounding, to moves that keep distances without any margin to
 * the last bit where coordinates have a common step, and a margin elsewhere. Sets *found if doubles hold them. Returns
 * false if memory is out. */
bool sunder_i_tight_place(const sunder_i_model *model, const sunder_i_waived *waived, const uint32_t *body, size_t n,
                          double margin, double *move, bool *found);
/* Sets *may if the coordinates of n bodies have a common step, so that such places are possible. Returns false if
 * memory is out. */
bool sunder_i_may_be_tight(const sunder_i_model *model, const uint32_t *body, size_t n, bool *may);
/* conflicted_group.c: returns whether the group has more than BRANCHED movable bodies and at least one listed pair
 * (sunder_i_group_listed()) for every CROWDED of them, so that neither perturbation nor a tree helps. */
bool sunder_i_group_has_many_conflicts(const sunder_i_model *model, const sunder_i_waived *waived,
                                       const sunder_i_group *group);
/* Returns the number of pairs of features, left in conflict, that belong to two different movable bodies of the
 * group. */
size_t sunder_i_group_listed(const sunder_i_model *model, const sunder_i_waived *waived, const sunder_i_group *group);
/* unlimited_group.c: does the group have more than BRANCHED bodies, all of which can move without a limit and along any
 * path, and do all its pairs have to keep the gap? Then the report will use prices of area. The second function sets
 * *bound to the bound that prices prove for the group alone. */
bool sunder_i_group_is_unlimited(const sunder_i_model *model, const sunder_i_waived *waived,
                                 const sunder_i_group *group);
sunder_status sunder_i_group_ask_prices(const sunder_i_model *model, const sunder_i_group *group, double *bound,
                                        sunder_error *err);
/* Is the group's cost proved to be the least, up to the digits that the program prints? */
bool sunder_i_group_is_optimal(const sunder_i_group *group);
/* Descends from the moves t of the group's bodies, and replaces the group's moves and cost by those of the layout found
 * if it is cheaper; does nothing if group->held is set. */
sunder_status sunder_i_group_descend(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *group,
                                     const double *t, sunder_error *err);
/* Looks for better moves of the group, and for a proof that there are none, in at most `steps` steps. The bound, guests
 * and trees that it has are kept unless more is proved. group_of: for each body the number of its group, or
 * SUNDER_I_NOBODY. */
sunder_status sunder_i_group_prove(const sunder_i_model *model, const sunder_i_waived *waived, const uint32_t *group_of,
                                   sunder_i_group *group, uint64_t steps, sunder_error *err);

#endif
