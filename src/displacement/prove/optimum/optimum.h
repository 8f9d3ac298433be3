/* How little could the moves of a contact group cost? Branch and bound: a proved bound, and better moves. */
#ifndef SUNDER_I_OPTIMUM_H
#define SUNDER_I_OPTIMUM_H

#include "displacement/layer/trace.h"
#include "displacement/prove/optimum/forbidden.h"
#include "sunder_proof.h"

/* Trees that are kept, in the numbers of the work. Zeroed: none. */
typedef struct sunder_i_bound_trees {
    sunder_bound_tree *tree;
    size_t n, capacity;
} sunder_i_bound_trees;

struct sunder_i_group;

/* Better layouts of a group are found by the search, which stands above the proofs: it is handed to them. */
typedef struct sunder_i_layout_search {
    /* From moves of n bodies that need not be free down to such as are, which keep the margin beyond the gap: *found,
     * if they cost less than `cost`; rounded. */
    sunder_status (*descend)(const sunder_i_model *model, uint32_t *body, size_t n, double margin, double cost,
                             double *move, bool *found, sunder_error *err);
    /* Looks for better moves of the group at random, in `steps` steps at most. */
    sunder_status (*shake)(const sunder_i_model *model, const sunder_i_waived *waived, struct sunder_i_group *group,
                           uint64_t steps, sunder_error *err);
} sunder_i_layout_search;

/* How far the proof of a group is. A stage of the proof that finds a cheaper layout takes it to one of the last two
 * states; solve/clusters/optimise.c takes the layout over (then the group is proved), or not (then it is to be proved
 * again). */
typedef enum sunder_i_group_state {
    SUNDER_I_TO_BE_PROVED,
    SUNDER_I_IS_PROVED,        /* as far as its steps allow; its moves are those of the layout */
    SUNDER_I_IS_CHEAPER,       /* likewise, but its moves cost less than those of the layout */
    SUNDER_I_IS_CHEAPER_TIGHT, /* likewise, and they leave no room for rounding */
} sunder_i_group_state;

/* Bodies that are in contact in a layout, and what is proved of them. No movable body is in two groups, so the bounds
 * of all groups add up. */
typedef struct sunder_i_group {
    uint32_t *body; /* [n] ascending; fixed ones that are touched too; owned */
    size_t n;
    uint32_t number;
    const sunder_i_layout_search *search;
    double margin;        /* what is demanded of a layout beyond the gap, to cover rounding */
    double *move;         /* [2 * n] as they stand; better ones, rounded, where such are found; owned */
    double cost, bound;   /* of the moves, rounded upwards; a proved lower bound, rounded downwards */
    double asked;         /* its cost when the groups whose bounds it has were fully examined */
    double shaken_at;     /* what it cost when it, or those it is made of, were shaken with all the steps */
    bool held;            /* its moves are to stay */
    bool with_slack;      /* layouts without room for rounding are not looked for: one failed the exact check */
    sunder_i_group_state state;
    sunder_i_list guests; /* bodies that stand alone and take part in the proof; owned */
    sunder_i_list joins;  /* bodies of other groups, in the way of what would be cheaper; owned */
    bool shaken, tired;   /* with patience: in this round; in one before, but for what costs little */
    uint64_t steps;
    sunder_i_trace_log log;     /* what its stages did, where the layer is traced; owned */
    sunder_i_bound_trees trees; /* what the bound stands on, where that is kept; owned */
} sunder_i_group;

static inline bool sunder_i_group_is_cheaper(const sunder_i_group *group)
{
    return group->state >= SUNDER_I_IS_CHEAPER;
}

void sunder_i_group_free(sunder_i_group *group);
/* tree_record.c */
void sunder_i_bound_tree_free(sunder_bound_tree *tree);
void sunder_i_bound_trees_free(sunder_i_bound_trees *trees);
/* Trees of `from` go over to `to`. False if memory is out. */
bool sunder_i_bound_trees_take(sunder_i_bound_trees *to, sunder_i_bound_trees *from);
/* tight_place.c: bodies' moves, good up to rounding, become such as keep what lies in steps to the last bit, and a
 * margin elsewhere; *found: doubles can hold them. False if memory is out. */
bool sunder_i_tight_place(const sunder_i_model *model, const sunder_i_waived *waived, const uint32_t *body, size_t n,
                          double margin, double *move, bool *found);
/* *may: their coordinates have a common step, so that there may be such places. False if memory is out. */
bool sunder_i_may_be_tight(const sunder_i_model *model, const uint32_t *body, size_t n, bool *may);
/* crowded.c: are enough pairs of its bodies left in conflict that neither perturbation nor a tree is of any use? */
bool sunder_i_group_is_crowded(const sunder_i_model *model, const sunder_i_waived *waived, const sunder_i_group *group);
/* Pairs of its bodies that are left in conflict. */
size_t sunder_i_group_listed(const sunder_i_model *model, const sunder_i_waived *waived, const sunder_i_group *group);
/* free_crowd.c: is the group large, without limits, and do all its pairs owe each other the gap, so that the report
 * will use prices of area? If so, the bound that these prove for the group alone: *bound. */
bool sunder_i_group_is_free_crowd(const sunder_i_model *model, const sunder_i_waived *waived,
                                  const sunder_i_group *group);
sunder_status sunder_i_group_ask_prices(const sunder_i_model *model, const sunder_i_group *group, double *bound,
                                        sunder_error *err);
/* Is its cost proved to be the least, up to what the program prints of it? */
bool sunder_i_group_is_optimal(const sunder_i_group *group);
/* Goes down from where the group's bodies are put; takes what is cheaper. */
sunder_status sunder_i_group_descend(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *group,
                                     const double *t, sunder_error *err);
/* Looks for better moves of the group, and for a proof that there are none, in so many steps at most. What is known of
 * it (bound, guests, trees) stays, if no more is proved. group_of: of all bodies, the number of their group, or
 * SUNDER_I_NOBODY. */
sunder_status sunder_i_group_prove(const sunder_i_model *model, const sunder_i_waived *waived, const uint32_t *group_of,
                                   sunder_i_group *group, uint64_t steps, sunder_error *err);

#endif
