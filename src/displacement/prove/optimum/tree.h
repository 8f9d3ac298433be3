/* Branch and bound for the least cost of a few bodies; see tree.c. */
#ifndef SUNDER_I_TREE_H
#define SUNDER_I_TREE_H

#include "displacement/prove/optimum/dual_program.h"
#include "displacement/prove/optimum/optimum.h"
#include "displacement/prove/optimum/region.h"
#include "sunder_proof.h"

/* min sum w_i |t_i - a_i|^2 over the moves of n bodies by which no pair of them does what it is forbidden. */
typedef struct sunder_i_task {
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    const uint32_t *group_of; /* NULL, or [bodies] of the model: the group of each, SUNDER_I_NOBODY: it stands alone */
    uint32_t group;           /* this one */
    const uint32_t *body;     /* [n] */
    size_t n;
    const double *weight; /* [n] NULL: the bodies' own; else no more than that */
    const double *anchor; /* [2 n] a; 0 for what does not move; NULL: 0 for all */
    double goal;          /* to be proved: no layout costs less */
    bool no_paths;        /* jumps and sides are ignored: less is forbidden */
    bool keep;            /* what a reader of the proof needs besides is kept: see tree_record.c */
} sunder_i_task;

typedef enum sunder_i_cut_kind {
    SUNDER_I_CUT_LIMIT, /* a tangent of a body's limit */
    SUNDER_I_CUT_CONE,  /* of a branch */
    SUNDER_I_CUT_HULL,  /* what it takes away is forbidden */
    SUNDER_I_CUT_DISC   /* what it takes away costs the goal, by the forces of the node above */
} sunder_i_cut_kind;

typedef struct sunder_i_cut_note {
    sunder_i_cut_kind kind;
    uint32_t pair;         /* in sunder_i_tree.pair */
    uint32_t named, names; /* for a hull, if recorded: the pieces that prove it, in sunder_i_tree.named */
} sunder_i_cut_note;

typedef enum sunder_i_node_state {
    SUNDER_I_OPEN,
    SUNDER_I_CLOSED,  /* its forces prove the goal of its time */
    SUNDER_I_EMPTY,   /* the last pair cut has no room left: its region is forbidden */
    SUNDER_I_LEAF,    /* no better is to be had: its least has no conflicts, or it could not be divided */
    SUNDER_I_REFINED, /* one child, with more cuts */
    SUNDER_I_DIVIDED  /* three children */
} sunder_i_node_state;

typedef struct sunder_i_tree_node {
    uint32_t parent; /* SUNDER_I_NO_NODE: the root */
    uint32_t cut, cuts, force, forces;
    double value; /* proved: no layout below it costs less, or the goal */
    sunder_i_node_state state;
    bool stuck;    /* the conflict that divided its parent was at the same place */
    uint32_t pair; /* which it was divided by, or has no room left */
    /* Where it is kept: the forces that its discs stand on, of cuts above it, and the pieces that leave no room. */
    uint32_t by, bys, named, names;
    char *regions; /* NULL, or the regions of its pairs, while it is open: tree_regions.c */
    size_t regions_size;
} sunder_i_tree_node;

#define SUNDER_I_NO_NODE UINT32_MAX

typedef struct sunder_i_tree_pair {
    uint32_t i, j; /* places in the task's list */
    sunder_i_forbidden forbidden;
    sunder_i_reflex reflex;
    sunder_i_free_sides sides; /* of a region that it had */
    bool has_reflex, touched;
    double reach; /* half side of the root */
    double centre[2];
    sunder_i_region region; /* at the node at hand */
    double slackness;       /* 1 / w_i + 1 / w_j, rounded upwards */
} sunder_i_tree_pair;

typedef struct sunder_i_open {
    double value;
    uint32_t node;
} sunder_i_open;

/* Which open node is looked at first: the one that proves least. */
static inline bool sunder_i_opens_first(const void *a, const void *b)
{
    const sunder_i_open *p = a, *q = b;
    return p->value != q->value ? p->value < q->value : p->node < q->node;
}

/* A pair in conflict at the least of a node. */
typedef struct sunder_i_tree_conflict {
    uint32_t pair;
    double depth, u[2];
} sunder_i_tree_conflict;

/* Directions all around, in which ways out are looked for; of every other one there is a tangent of a disc. */
#define SUNDER_I_TREE_RAYS 32

typedef struct sunder_i_tree {
    sunder_i_task task; /* its lists are the tree's own, and may grow by guests */
    uint32_t *body;
    double *weight, *anchor, *mass, *limit; /* [capacity], of weight INFINITY: it does not move */
    size_t capacity;
    uint32_t *pair_at; /* [capacity^2] */
    sunder_i_tree_pair *pair;
    size_t pairs, pair_capacity;
    sunder_i_move_cut *cut;
    sunder_i_cut_note *note;
    size_t cuts, cut_capacity, note_capacity;
    sunder_i_cut_force *force;
    size_t forces, force_capacity;
    sunder_i_tree_node *node;
    size_t nodes, node_capacity;
    sunder_i_list named; /* pieces of pairs, where the proof is kept */
    bool *used;          /* of the pieces of one pair; scratch */
    size_t used_capacity;
    sunder_i_open *open; /* a heap */
    size_t opens, open_capacity;
    sunder_i_list path, touched, near;
    sunder_i_list joins; /* bodies of other groups, in the way of a layout that would be cheaper */
    sunder_i_tree_conflict *conflict;
    size_t conflicts, conflict_capacity;
    sunder_i_free_sides tried; /* for a region that a trial examines */
    sunder_i_dual_program program;
    sunder_i_cut_force *kept; /* the program's state, while something else is tried */
    double *kept_factor;
    size_t kept_n, kept_capacity, kept_factor_capacity;
    size_t kept_bytes; /* of regions, of all open nodes */
    double ray[SUNDER_I_TREE_RAYS][2];
    double leaf;                /* the least value of a leaf */
    uint64_t steps, pair_steps; /* pair_steps: the part spent on making pairs */
    bool failed;                /* memory is out */
} sunder_i_tree;

typedef enum sunder_i_tree_outcome {
    SUNDER_I_TREE_PROVED, /* nothing costs less than the goal, or the least leaf */
    SUNDER_I_TREE_FOUND,  /* program.t has no conflicts: what it leads to may be cheaper */
    SUNDER_I_TREE_JOINED, /* the same, without those in joins */
    SUNDER_I_TREE_SPENT   /* the effort is */
} sunder_i_tree_outcome;

/* ---- tree_bodies.c ----------------------------------------------------------------------------------------------- */

/* Makes `body` the k-th body of the tree, with a weight. */
void sunder_i_tree_set_body(sunder_i_tree *tree, size_t k, uint32_t body, double weight);
/* Lends the arrays of the tree's bodies to its task and its program. */
void sunder_i_tree_lend_bodies(sunder_i_tree *tree);
/* One more body takes part, with its own weight, unless there are MOST_GUESTS already. */
void sunder_i_tree_invite(sunder_i_tree *tree, uint32_t body);

/* ---- tree.c ------------------------------------------------------------------------------------------------------ */

bool sunder_i_tree_init(sunder_i_tree *tree, const sunder_i_task *task);
void sunder_i_tree_free(sunder_i_tree *tree);
/* Continues until `steps` steps are done in all. */
sunder_i_tree_outcome sunder_i_tree_run(sunder_i_tree *tree, uint64_t steps);
/* The bound proved so far. */
double sunder_i_tree_bound(const sunder_i_tree *tree);
/* A cheaper layout is known: the goal falls. */
void sunder_i_tree_lower_goal(sunder_i_tree *tree, double goal);

/* ---- tree_pairs.c ------------------------------------------------------------------------------------------------ */

/* The pair of bodies i and j, made at its first use; NULL if memory is out. */
sunder_i_tree_pair *sunder_i_tree_pair_of(sunder_i_tree *tree, uint32_t i, uint32_t j);
/* The pairs in conflict at program.t, to tree->conflict. */
void sunder_i_tree_find_conflicts(sunder_i_tree *tree);
/* The same with bodies that stand outside. Those that stand alone where they came from become guests, and take part
 * from now on; those of other groups go to tree->joins. */
void sunder_i_tree_meet(sunder_i_tree *tree);

/* ---- tree_node.c ------------------------------------------------------------------------------------------------- */

/* The program's forces, added to the record. */
void sunder_i_tree_note_forces(sunder_i_tree *tree, uint32_t *first, uint32_t *count);
/* Adds a cut to the last node, and to the pair's region. Its number. */
uint32_t sunder_i_tree_cut(sunder_i_tree *tree, sunder_i_cut_kind kind, uint32_t pair, const double n[2], double d);
/* A node with the program's forces; the cuts that follow are its. */
uint32_t sunder_i_tree_add_node(sunder_i_tree *tree, uint32_t parent, double value);
void sunder_i_tree_keep_forces(sunder_i_tree *tree, uint32_t node);
/* Regions and program as they are at the node. */
void sunder_i_tree_load(sunder_i_tree *tree, uint32_t node);
/* Solves the program over all regions; what it proves. Infinite where all is closed. */
double sunder_i_tree_solve(sunder_i_tree *tree);
/* Sets the program aside, and takes it back. */
void sunder_i_tree_keep_program(sunder_i_tree *tree);
void sunder_i_tree_restore_program(sunder_i_tree *tree);

/* ---- tree_regions.c ---------------------------------------------------------------------------------------------- */

/* Keeps the regions at hand for a node that is opened, if there is room. */
void sunder_i_tree_keep_regions(sunder_i_tree *tree, uint32_t node);
/* Regions of pairs that the node's path touches become what was kept; it is kept no longer. */
void sunder_i_tree_take_regions(sunder_i_tree *tree, uint32_t node);
void sunder_i_tree_drop_regions(sunder_i_tree *tree, uint32_t node);

/* ---- tree_cuts.c ------------------------------------------------------------------------------------------------- */

/* Cuts of the conflicts at the node: discs, hulls. *empty: a pair is left no room; the cuts made. */
size_t sunder_i_tree_refine(sunder_i_tree *tree, double value, bool *empty);
/* A cut proposed for u in a region, but not proved: n.v >= d for all v that are free. False: nothing is, or u is in
 * the hull. *none: nothing is free. */
bool sunder_i_tree_propose(sunder_i_tree *tree, uint32_t pair, const sunder_i_region *region, const double u[2],
                           double n[2], double *d, bool *none);
/* The same, proved, and made. *empty: the pair is left no room at the last node, which is proved, and noted there. */
bool sunder_i_tree_cut_hull(sunder_i_tree *tree, uint32_t pair, const double u[2], bool *empty);

/* ---- tree_branch.c ----------------------------------------------------------------------------------------------- */

/* Divides the node by one of its conflicts; children that are not closed are opened. Without one that tells more it is
 * a leaf. */
void sunder_i_tree_divide(sunder_i_tree *tree, uint32_t node);

/* ---- tree_record.c ----------------------------------------------------------------------------------------------- */

/* What the tree proves, and by what: `out`, to be freed by sunder_i_bound_tree_free(). False if memory is out. */
bool sunder_i_tree_record(const sunder_i_tree *tree, sunder_bound_tree *out);
/* The same becomes the last of the trees. False if memory is out. */
bool sunder_i_tree_keep(const sunder_i_tree *tree, sunder_i_bound_trees *trees);

#endif
