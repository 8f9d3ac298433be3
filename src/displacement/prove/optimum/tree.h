/* Branch and bound for the least cost of a few bodies; see tree.c. */
#ifndef SUNDER_I_TREE_H
#define SUNDER_I_TREE_H

#include "displacement/prove/optimum/dual_program.h"
#include "displacement/prove/optimum/optimum.h"
#include "displacement/prove/optimum/region.h"
#include "sunder_proof.h"

#include <math.h>

/* A pair of bodies that is left in conflict and eased, by their places in a task's list, i < j, the price of what it
 * lacks, and the most that it may lack, which is more than at the start. Pieces that are no farther than `deep` from
 * where the pair may come show how deep it overlaps. A barrier is represented by one of its parts. */
typedef struct sunder_i_task_price {
    uint32_t i, j;
    sunder_i_price price;
    double most, deep;
} sunder_i_task_price;

/* The task: minimise sum w_i |t_i - a_i|^2, and the cost of springs between the bodies, and the prices of what pairs
 * lack, over the moves of n bodies for which no pair of them is in its forbidden set. */
typedef struct sunder_i_task {
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    const uint32_t *group_of; /* NULL, or for each body of the model the number of its group; SUNDER_I_NOBODY: it is in
                               * none */
    uint32_t group;           /* the number of this group */
    const uint32_t *body;     /* [n] */
    size_t n;
    const double *weight;            /* [n] at most the bodies' own weights; NULL: exactly these */
    const double *anchor;            /* [2 n] the points a; 0 for bodies that do not move; NULL: the preferred moves */
    double goal;                     /* the bound to be proved */
    bool all_springs;                /* all springs between these bodies count; or: */
    const sunder_i_move_cut *spring; /* [springs] those that count */
    size_t springs;
    const sunder_i_task_price *price; /* [prices] */
    size_t prices;
    const sunder_i_joined *joined; /* [joins] further pieces of the eased pairs */
    size_t joins;
    bool no_paths; /* jumps and sides are ignored, so less is forbidden */
    bool keep;     /* record what a checker of the proof needs: see tree_record.c */
} sunder_i_task;

typedef enum sunder_i_cut_kind {
    SUNDER_I_CUT_SPRING, /* one sign of a spring between neighbours in a row; it gives, and belongs to the root */
    SUNDER_I_CUT_LACK,   /* what a pair lacks is at least 0, or at most `most`; it belongs to the root */
    SUNDER_I_CUT_LIMIT,  /* a tangent of a body's limit */
    SUNDER_I_CUT_CONE,   /* a side of a branch's cone */
    SUNDER_I_CUT_HULL,   /* the part that it removes is forbidden */
    SUNDER_I_CUT_PRICE,  /* in the part that it removes the pair lacks more */
    SUNDER_I_CUT_DISC    /* the part that it removes costs at least the goal, by the forces of the parent node */
} sunder_i_cut_kind;

typedef struct sunder_i_cut_note {
    sunder_i_cut_kind kind;
    uint32_t pair;         /* the pair, in sunder_i_tree.pair; for a cut by prices the eased pair, in .eased */
    uint32_t named, names; /* for a hull or a cut by prices, if recorded: the pieces that prove it, in
                            * sunder_i_tree.named */
} sunder_i_cut_note;

typedef enum sunder_i_node_state {
    SUNDER_I_OPEN,
    SUNDER_I_CLOSED,  /* its forces prove the goal as it was then */
    SUNDER_I_EMPTY,   /* a pair has no room left: its region is forbidden */
    SUNDER_I_LEAF,    /* no better bound is possible: its minimiser has no conflicts, or it could not be divided */
    SUNDER_I_REFINED, /* it has one child, with more cuts */
    SUNDER_I_DIVIDED  /* it has three children */
} sunder_i_node_state;

typedef struct sunder_i_tree_node {
    uint32_t parent;                   /* SUNDER_I_NO_NODE for the root */
    uint32_t cut, cuts, force, forces; /* its own cuts, and the forces of its program: the index of the first in
                                        * sunder_i_tree.cut and .force, and their number */
    double value;                      /* proved: no layout below it costs less than this, or than the goal */
    sunder_i_node_state state;
    bool stuck;    /* no hull was cut off in it, and the conflict that divided its parent is still at the same place */
    uint32_t pair; /* the pair by which it was divided, or which has no room left */
    /* If recorded: the forces on which its discs depend, of cuts above it, and the pieces that leave no room. */
    uint32_t by, bys, named, names;
    char *regions; /* NULL, or the regions of its pairs, saved while it is open: tree_regions.c */
    size_t regions_size;
} sunder_i_tree_node;

#define SUNDER_I_NO_NODE UINT32_MAX

typedef struct sunder_i_tree_pair {
    uint32_t i, j; /* places in the task's list */
    sunder_i_forbidden forbidden;
    sunder_i_reflex reflex;
    sunder_i_free_sides sides; /* the free parts of the sides of its last region */
    bool has_reflex, touched;
    double reach; /* half the side of the root's region */
    double centre[2];
    uint32_t shares;        /* the pair that has the region: this one, or an earlier one with the same relative move */
    sunder_i_region region; /* at the present node */
    double slackness;       /* 1 / w_i + 1 / w_j, rounded upwards */
} sunder_i_tree_pair;

/* Returns how far from u = 0 the pieces of a pair are listed. */
static inline double sunder_i_tree_pair_reach(const sunder_i_tree_pair *p)
{
    return fabs(p->centre[0]) + fabs(p->centre[1]) + 2 * p->reach;
}

/* An eased pair. A move u and what the pair lacks there are a point (u, s) of space. */
typedef struct sunder_i_tree_eased {
    uint32_t pair;             /* whose region is that of the eased pair */
    sunder_i_forbidden pieces; /* all, of all parts of a barrier */
    sunder_i_forbidden hard;   /* those that forbid */
    sunder_i_reflex reflex[2]; /* of both */
    sunder_i_free_sides sides[2];
    bool has_reflex;
    double (*place)[3]; /* further known points */
    size_t places, capacity;
} sunder_i_tree_eased;

typedef struct sunder_i_open {
    double value;
    uint32_t node;
} sunder_i_open;

/* Which open node is processed first: the one with the least value. */
static inline bool sunder_i_opens_first(const void *a, const void *b)
{
    const sunder_i_open *p = a, *q = b;
    return p->value != q->value ? p->value < q->value : p->node < q->node;
}

/* A pair in conflict at the minimiser of a node. */
typedef struct sunder_i_tree_conflict {
    uint32_t pair;
    uint32_t eased; /* SUNDER_I_NOBODY, or the number of the eased pair that lacks more than the program says */
    double depth, u[2];
} sunder_i_tree_conflict;

/* The number of directions, evenly spaced, in which exits are looked for; every second one is a normal of the tangents
 * of a disc. */
#define SUNDER_I_TREE_RAYS 32

typedef struct sunder_i_tree {
    sunder_i_task task; /* its lists are the tree's own, and may grow by guests */
    uint32_t *body;
    double *weight, *anchor, *mass, *limit; /* [capacity] each; a weight of INFINITY: the body does not move */
    size_t capacity;
    uint32_t *pair_at; /* [capacity^2] the number of each pair, or UINT32_MAX */
    sunder_i_tree_pair *pair;
    size_t pairs, pair_capacity;
    sunder_i_move_cut *cut;
    sunder_i_cut_note *note;
    size_t cuts, cut_capacity, note_capacity;
    size_t springs; /* the first cuts are springs; after them each price has two, for the least and for the most that a
                     * pair lacks */
    sunder_i_tree_eased *eased; /* [task.prices] */
    sunder_i_price *price;      /* [task.prices] */
    sunder_i_list priced;       /* the cuts by prices at the present node */
    sunder_i_cut_force *force;
    size_t forces, force_capacity;
    sunder_i_tree_node *node;
    size_t nodes, node_capacity;
    sunder_i_list named; /* pieces of pairs that proofs use, if they are recorded */
    bool *used;          /* scratch: which pieces of one pair are used */
    size_t used_capacity;
    sunder_i_open *open; /* a heap of the open nodes */
    size_t opens, open_capacity;
    sunder_i_list path, touched, near;
    sunder_i_list joins; /* bodies of other groups that block a cheaper layout */
    sunder_i_tree_conflict *conflict;
    size_t conflicts, conflict_capacity;
    sunder_i_free_sides tried; /* the free parts of the sides of a region that a trial examines */
    sunder_i_dual_program program;
    sunder_i_cut_force *kept; /* the saved state of the program during a trial */
    double *kept_factor;
    size_t kept_n, kept_capacity, kept_factor_capacity;
    size_t kept_bytes; /* the size of the saved regions of all open nodes */
    double ray[SUNDER_I_TREE_RAYS][2];
    double leaf;                /* the least value of a leaf */
    uint64_t steps, pair_steps; /* pair_steps: the part of `steps` spent on making pairs */
    bool failed;                /* memory is out, or stopped on request */
} sunder_i_tree;

typedef enum sunder_i_tree_outcome {
    SUNDER_I_TREE_PROVED, /* no layout costs less than the goal or the least leaf */
    SUNDER_I_TREE_FOUND,  /* program.t has no conflicts: a descent from it may find a cheaper layout */
    SUNDER_I_TREE_JOINED, /* as SUNDER_I_TREE_FOUND, if the bodies in `joins` are ignored */
    SUNDER_I_TREE_SPENT   /* the steps are used up */
} sunder_i_tree_outcome;

/* ---- tree_bodies.c ----------------------------------------------------------------------------------------------- */

/* Makes `body` the k-th body of the tree, with a weight. */
void sunder_i_tree_set_body(sunder_i_tree *tree, size_t k, uint32_t body, double weight);
/* Lends the arrays of the tree's bodies to its task and its program. */
void sunder_i_tree_lend_bodies(sunder_i_tree *tree);
/* One more body takes part, with its own weight, unless there are MOST_GUESTS already. */
void sunder_i_tree_add_guest(sunder_i_tree *tree, uint32_t body);
/* Adds the springs between the bodies of the task. To be called before there are other cuts. */
void sunder_i_tree_add_springs(sunder_i_tree *tree);

/* ---- tree.c ------------------------------------------------------------------------------------------------------ */

bool sunder_i_tree_init(sunder_i_tree *tree, const sunder_i_task *task);
void sunder_i_tree_free(sunder_i_tree *tree);
/* Continues until the proof is complete, a leaf is found, or the total of steps exceeds `steps`. tree->failed is set if
 * memory is out or stopped on request. */
sunder_i_tree_outcome sunder_i_tree_run(sunder_i_tree *tree, uint64_t steps);
/* Returns the bound proved up to now. */
double sunder_i_tree_bound(const sunder_i_tree *tree);
/* Lowers the goal, after a cheaper layout was found. */
void sunder_i_tree_lower_goal(sunder_i_tree *tree, double goal);

/* ---- tree_pairs.c ------------------------------------------------------------------------------------------------ */

/* Returns the pair of bodies i < j, made at its first use; NULL if memory is out. */
sunder_i_tree_pair *sunder_i_tree_find_pair(sunder_i_tree *tree, uint32_t i, uint32_t j);
/* Sets tree->conflict to the pairs in conflict at program.t. */
void sunder_i_tree_find_conflicts(sunder_i_tree *tree);
/* Looks for conflicts with bodies that do not take part. A body that is in no group becomes a guest, and takes part
 * from now on, as long as there is room for guests; all others are appended to tree->joins. Without task.group_of it
 * does nothing. */
void sunder_i_tree_find_outside_conflicts(sunder_i_tree *tree);

/* ---- tree_chords.c ----------------------------------------------------------------------------------------------- */

/* Adds chords to pairs of a body and a barrier: those across ends of two sides that a side anchor passes on its way to
 * its place at program.t. Returns true if any was added. */
bool sunder_i_tree_add_chords(sunder_i_tree *tree);

/* The region of a pair. */
static inline sunder_i_region *sunder_i_tree_region(sunder_i_tree *tree, uint32_t pair)
{
    return &tree->pair[tree->pair[pair].shares].region;
}

/* ---- priced_tree.c ----------------------------------------------------------------------------------------------- */

/* How far a tree with prices runs, and what hears of it. */
typedef struct sunder_i_priced_run {
    uint64_t steps; /* of each tree; it is begun again if it needs further polygons */
    /* NULL, or called for each layout that a tree finds, at program.t; it may lower the goal. Further polygons may show
     * that the layout lacks more. Returns false if memory is out. */
    bool (*found)(sunder_i_tree *tree, void *context);
    bool (*ended)(sunder_i_tree *tree, void *context); /* the same for the tree that needed no further polygons */
    void *context;
} sunder_i_priced_run;

/* Runs a tree whose task has prices; task->joined is not used. Returns false if memory is out. */
bool sunder_i_tree_run_priced(const sunder_i_task *task, const sunder_i_priced_run *run);
/* Appends body j to a list; if it is a part of a barrier also the parts of that barrier that body i may come near.
 * Returns false if memory is out. */
bool sunder_i_tree_list_parts(const sunder_i_model *model, uint32_t i, uint32_t j, sunder_i_list *body);

/* ---- tree_eased.c ------------------------------------------------------------------------------------------------ */

/* Makes the eased pairs of the task, and the cuts that they lack at least 0. */
void sunder_i_tree_add_eased(sunder_i_tree *tree);
void sunder_i_tree_free_eased(sunder_i_tree *tree);
/* Adds to tree->conflict the eased pairs that lack more at program.t than the program says. */
void sunder_i_tree_find_lacking(sunder_i_tree *tree);
/* Proposes a cut by prices for a region of the pair's moves, not proved: all points that are not forbidden lack at
 * least the slope. Returns false if there is none that u, lacking what the program says, does not satisfy. */
bool sunder_i_tree_propose_price(sunder_i_tree *tree, uint32_t eased, const sunder_i_region *region, const double u[2],
                                 sunder_i_slope *slope);
/* Makes a polygon (joined_piece.c) for each eased pair that is deeper than its pieces show, at program.t or, with
 * `now`, at its present place, and appends it to the list of *n. Returns false if memory is out. */
bool sunder_i_tree_join_pieces(sunder_i_tree *tree, bool now, sunder_i_joined **list, size_t *n, size_t *capacity);
/* Adds such a cut for the pair's region, if it is proved. */
bool sunder_i_tree_cut_price(sunder_i_tree *tree, uint32_t eased, const double u[2]);

/* ---- tree_node.c ------------------------------------------------------------------------------------------------- */

/* Appends the program's forces to the record of forces. */
void sunder_i_tree_note_forces(sunder_i_tree *tree, uint32_t *first, uint32_t *count);
/* Adds a cut to the last node, and clips the pair's region by it. Returns the cut's number. */
uint32_t sunder_i_tree_cut(sunder_i_tree *tree, sunder_i_cut_kind kind, uint32_t pair, const double n[2], double d);
/* Adds a cut by prices to the last node. */
uint32_t sunder_i_tree_add_price_cut(sunder_i_tree *tree, uint32_t eased, const sunder_i_slope *slope);
/* Adds a node, and returns its number; cuts added after it belong to it. The second function records the program's
 * forces as those of `node`. */
uint32_t sunder_i_tree_add_node(sunder_i_tree *tree, uint32_t parent, double value);
void sunder_i_tree_keep_forces(sunder_i_tree *tree, uint32_t node);
/* Sets the regions and the program to their state at the node. */
void sunder_i_tree_load(sunder_i_tree *tree, uint32_t node);
/* Solves the program under all regions and limits, and returns the bound that it proves. */
double sunder_i_tree_solve(sunder_i_tree *tree);
/* Saves the program's state, and restores it. */
void sunder_i_tree_keep_program(sunder_i_tree *tree);
void sunder_i_tree_restore_program(sunder_i_tree *tree);

/* ---- tree_regions.c ---------------------------------------------------------------------------------------------- */

/* Saves the present regions for a node that is opened, if there is room. */
void sunder_i_tree_keep_regions(sunder_i_tree *tree, uint32_t node);
/* Restores the saved regions of the pairs that the node's path touches, and frees them. */
void sunder_i_tree_take_regions(sunder_i_tree *tree, uint32_t node);

/* ---- tree_cuts.c ------------------------------------------------------------------------------------------------- */

/* Adds cuts for the conflicts at the node: discs and hulls. Returns the number of hulls made. *empty is set if a pair
 * has no room left. value: the bound that the forces prove. */
size_t sunder_i_tree_refine(sunder_i_tree *tree, double value, bool *empty);
/* Proposes a cut, not proved, that separates u from the free part of a region: n.v >= d for all free v. Returns false
 * if nothing is free, or if u is in the hull of the free part. *none is set if nothing is free. */
bool sunder_i_tree_propose(sunder_i_tree *tree, uint32_t pair, const sunder_i_region *region, const double u[2],
                           double n[2], double *d, bool *none);
/* Proposes a cut that separates u from the free part of the pair's region, proves it, and adds it. Returns false if
 * none was added. *empty is set if it is proved that the pair has no room left at the last node; this is recorded
 * there. */
bool sunder_i_tree_cut_hull(sunder_i_tree *tree, uint32_t pair, const double u[2], bool *empty);

/* ---- tree_branch.c ----------------------------------------------------------------------------------------------- */

/* Divides the node by one of its conflicts, and opens the children that are not closed. The node becomes a leaf if all
 * its conflicts are stuck, that is if dividing by them moved nothing before, and no body outside is in conflict. */
void sunder_i_tree_divide(sunder_i_tree *tree, uint32_t node);

/* ---- tree_record.c ----------------------------------------------------------------------------------------------- */

/* Records what the tree proves, and how, in `out`, which is freed by sunder_i_bound_tree_free(). Returns false if
 * memory is out. */
bool sunder_i_tree_record(const sunder_i_tree *tree, sunder_bound_tree *out);
/* Records the tree at the end of `trees`. Returns false if memory is out. */
bool sunder_i_tree_keep(const sunder_i_tree *tree, sunder_i_bound_trees *trees);

#endif
