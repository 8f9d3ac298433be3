/* The state that the stages of the work on one layer share. (solve/search/cluster.h is the interface of the search for
 * the moves of one cluster.) */
#ifndef SUNDER_I_SOLVER_H
#define SUNDER_I_SOLVER_H

#include "displacement/layer/jumps.h"
#include "displacement/layer/placement.h"
#include "displacement/layer/reads.h"
#include "displacement/prove/optimum/optimum.h"
#include "displacement/rows/rows.h"
#include "displacement/solve/clusters/body_state.h"
#include "displacement/solve/search/cluster.h"

#include "base/parallel.h"
#include "separation/separation.h"
#include "sunder_proof.h"

typedef struct sunder_i_cluster_member {
    uint32_t root, body;
} sunder_i_cluster_member;

/* Two features that limits keep from being separated: one of them is moved inside the other. */
typedef struct sunder_i_entry {
    uint32_t a, b;
    bool a_inside;   /* a goes inside b; otherwise b inside a */
    double place[2]; /* the least move of b relative to a that brings this about */
} sunder_i_entry;

/* The contact groups of the layout. */
typedef struct sunder_i_groups {
    sunder_i_group *group;
    size_t n;
    uint32_t *of;            /* [bodies] number of the body's group; SUNDER_I_NOBODY: fixed, or in no group */
    sunder_i_waiver *waived; /* [waived_n] pairs left in conflict, and the demands on them; sorted */
    size_t waived_n;
    sunder_i_id_pair *joined; /* [joins] pairs of bodies that a proof has to treat in one group */
    size_t joins, capacity;
    double *spent;       /* [bodies] steps that proofs of the body's groups have taken */
    bool with_diagonals; /* a body is SUNDER_I_WITH_DIAGONALS */
    bool unproved;       /* some have to be proved in another round (optimise.c) */
} sunder_i_groups;

/* Value of edges_listed: the members of clusters have to be listed again. */
#define SUNDER_I_NONE_LISTED SIZE_MAX

typedef struct sunder_i_solver {
    sunder_i_barriers barriers;
    sunder_layer layer; /* in the order of work; the parts of barriers follow the features */
    sunder_i_model model;
    sunder_i_placement placement;
    sunder_i_relations start, now; /* exact relations of near pairs: in the input, and in the present layout */
    sunder_i_depth *depth;         /* [depths] how deep pairs of `start` overlapped, of those for which it was needed */
    size_t depths, depth_capacity;
    uint32_t *depth_at;    /* [start.n] index into depth[], plus one; 0: not computed. NULL: no depth was computed */
    sunder_i_rows rows;    /* the rows of the layer as given, if they are wanted */
    sunder_i_jumps jumps;  /* pairs of features of which one jumped over the other, in the present layout */
    sunder_i_entry *entry; /* [entries] */
    size_t entries, entry_capacity;
    sunder_i_id_pair *edge; /* [edges] pairs of bodies that are solved together */
    size_t edges, edge_capacity;
    uint32_t *conflict_root;     /* see sunder_i_solver_conflict_roots() */
    uint32_t *parent;            /* [bodies] union-find over the edges between movable bodies */
    sunder_i_body_states states; /* [bodies] */
    bool *to_ease;               /* [bodies] the body's cluster is to be eased (ease.c); NULL: not begun */
    unsigned char *widened;      /* [bodies] how often the margin of the body's cluster grew, fourfold each time */
    sunder_i_changes changes;    /* features that have moved since pairs were last related */
    sunder_i_id_pair *asked;     /* [asked_n] pairs of things that one_by_one.c has asked about; sorted */
    size_t asked_n, asked_capacity;
    uint64_t *asked_work; /* [bodies] effort of the questions that found no solution, noted at one body of the pair */
    uint32_t *crowd_size; /* [bodies] bodies of the crowd in which it last started from prices of area; 0: in none */
    sunder_bound_pair *measured; /* [measured_n] pairs of features with a known least separation; some repeat */
    size_t measured_n, measured_capacity;
    double *limit;                   /* [bodies] the limits, while they are lifted; NULL: limits were never lifted */
    double *went;                    /* [2 * bodies] where bodies stood that were set aside since they went too far */
    sunder_i_relaxations waiting;    /* relaxations to be restored together with the limits */
    uint32_t *carrier;               /* [bodies] the body whose move it starts from, or SUNDER_I_NOBODY: its own */
    sunder_i_cluster_member *member; /* [members] cluster after cluster, bodies ascending */
    size_t members;
    uint32_t *body; /* [members] the bodies of member[] */
    double *move;   /* [2 * members] moves of these in the search */
    sunder_i_cluster *cluster;
    size_t clusters;
    size_t edge_room;    /* member[], body[], move[] and cluster[] have room for the clusters of this many edges */
    size_t edges_listed; /* member[] lists the ends of this many edges */
    bool brief;          /* a question about one conflict: the first cluster without a solution ends the work */
    bool hopeless;       /* then: there is no solution, or none was found */
    double refuted;      /* then: about the least gap for which the proof found shows that there is no solution */
    bool changed;        /* by the present stage: clusters have to be settled, and it may have another round */
    bool unsettled;      /* clusters have to be solved in another round (settle.c) */
    bool failed;         /* memory is out */
    bool had_limits;     /* limits were lifted at first */
    bool may_hold;       /* bodies may be held (coarse_bodies.c) */
    bool any_let_go;     /* held bodies were let go */
    bool eased;          /* pairs were eased: contact is contact at the full distance */
    struct sunder_i_held_layout *held_layout; /* the layout before that (cluster_stages.h); lent */
    sunder_i_groups groups;
} sunder_i_solver;

/* ---- body_state.c: the states of bodies -------------------------------------------------------------------------- */

/* NULL, or what is wrong with the states of bodies between two stages. In builds that assert. */
const char *sunder_i_solver_check_states(const sunder_i_solver *solver);

/* The cost of a body's move t. */
static inline double sunder_i_move_cost(const sunder_i_model *model, uint32_t body, const double t[2])
{
    return model->body[body].weight * sunder_i_stray_square(model, body, t);
}

/* A property of a body. */
typedef bool (*sunder_i_body_test)(const sunder_i_solver *solver, uint32_t body);

/* Is body b in this state of the aspect? The functions below ask for one state, or a few, by name. */
static inline bool sunder_i_is_in(const sunder_i_solver *s, sunder_i_aspect aspect, uint32_t b, unsigned char state)
{
    return s->states.of[aspect][b] == state;
}
static inline bool sunder_i_is_due(const sunder_i_solver *s, uint32_t b)
{
    return sunder_i_is_in(s, SUNDER_I_SEARCH, b, SUNDER_I_DUE);
}
static inline bool sunder_i_is_improved(const sunder_i_solver *s, uint32_t b)
{
    return sunder_i_is_in(s, SUNDER_I_SEARCH, b, SUNDER_I_IMPROVED) ||
           sunder_i_is_in(s, SUNDER_I_SEARCH, b, SUNDER_I_IMPROVED_CHEAPEST);
}
static inline bool sunder_i_is_cheapest(const sunder_i_solver *s, uint32_t b)
{
    return sunder_i_is_in(s, SUNDER_I_SEARCH, b, SUNDER_I_CHEAPEST) ||
           sunder_i_is_in(s, SUNDER_I_SEARCH, b, SUNDER_I_IMPROVED_CHEAPEST);
}
static inline bool sunder_i_is_wanted(const sunder_i_solver *s, uint32_t b)
{
    return sunder_i_is_in(s, SUNDER_I_SCOPE, b, SUNDER_I_WANTED);
}
static inline bool sunder_i_is_doubtful(const sunder_i_solver *s, uint32_t b)
{
    return s->states.of[SUNDER_I_QUESTION][b] <= SUNDER_I_DOUBTFUL_ASKED;
}
static inline bool sunder_i_is_to_retry(const sunder_i_solver *s, uint32_t b)
{
    return sunder_i_is_in(s, SUNDER_I_RETRY, b, SUNDER_I_TO_RETRY);
}
static inline bool sunder_i_is_aside(const sunder_i_solver *s, uint32_t b)
{
    return sunder_i_is_in(s, SUNDER_I_LIMITS, b, SUNDER_I_ASIDE);
}

/* solver->model has to have its bodies. On failure the caller calls sunder_i_solver_free(), too. */
sunder_status sunder_i_solver_init(sunder_i_solver *solver, sunder_error *err);
void sunder_i_solver_free(sunder_i_solver *solver);

/* ---- clusters.c: edges and clusters ------------------------------------------------------------------------------ */

/* [bodies] The root of each body's component of conflicts at the start; lent. A fixed body joins no components. NULL if
 * memory is out. The first call computes it, so only one thread at a time may call. */
const uint32_t *sunder_i_solver_conflict_roots(sunder_i_solver *solver);
/* Adds the edge (i, j). False if memory is out. */
bool sunder_i_solver_add_edge(sunder_i_solver *solver, uint32_t i, uint32_t j);
/* Was the body a member of the cluster with this root when clusters were last gathered? */
bool sunder_i_solver_has_member(const sunder_i_solver *solver, uint32_t root, uint32_t body);
/* The members of the cluster with this root, ascending; NULL and *n = 0 if there is no such cluster. */
const uint32_t *sunder_i_solver_members(const sunder_i_solver *solver, uint32_t root, size_t *n);
/* The cluster with this root, or the cluster of this body, when clusters were last gathered; NULL: there is none. */
sunder_i_cluster *sunder_i_solver_cluster_at_root(const sunder_i_solver *solver, uint32_t root);
sunder_i_cluster *sunder_i_solver_cluster_of(const sunder_i_solver *solver, uint32_t body);
/* Does any of the n bodies that may move pass the test? */
bool sunder_i_solver_any_of(const sunder_i_solver *solver, const uint32_t *body, size_t n, sunder_i_body_test test);
/* Returns an array [bodies]: is the body connected, by the present edges, with a movable body that passes the test?
 * It is false for fixed bodies. The caller frees the array. NULL if memory is out. */
bool *sunder_i_solver_connected_with(const sunder_i_solver *solver, sunder_i_body_test test);
/* The margin of a cluster of these n bodies: the distance demanded beyond the gap. */
double sunder_i_solver_margin(const sunder_i_solver *solver, const uint32_t *b, size_t n);
/* Gives a cluster the margin that it had before checks failed, and its movable bodies as well. */
void sunder_i_solver_narrow_margin(sunder_i_solver *solver, sunder_i_cluster *cluster);
/* The root of the cluster: the areas that the search reads are recorded for this body, which is in no other cluster. */
static inline uint32_t sunder_i_reader_for(const sunder_i_solver *solver, const sunder_i_cluster *cluster)
{
    return solver->member[cluster->body - solver->body].root;
}
/* Frees the clusters, except for their lists of members, until they are gathered again. */
void sunder_i_solver_forget_clusters(sunder_i_solver *solver);
/* A property of a cluster, and work on one: `move` has the moves that it starts from, and receives new ones. */
typedef bool (*sunder_i_cluster_test)(const sunder_i_solver *solver, const sunder_i_cluster *cluster);
typedef sunder_status (*sunder_i_cluster_work)(const sunder_i_solver *solver, sunder_i_cluster *cluster, double *move,
                                               void *context, sunder_error *err);
/* Does the work for the clusters that pass the test (NULL: for all), on all threads, the largest first. What is read
 * meanwhile is recorded for the cluster. */
sunder_status sunder_i_solver_for_clusters(const sunder_i_solver *solver, sunder_i_cluster_test test,
                                           sunder_i_cluster_work work, void *context, sunder_error *err);
/* Emits the log of each cluster, in the order of the clusters, if the layer is traced. */
sunder_status sunder_i_solver_trace_clusters(sunder_i_solver *solver, sunder_error *err);
/* Makes the clusters anew from the edges. */
sunder_status sunder_i_solver_gather(sunder_i_solver *solver, sunder_error *err);
/* Unites the members of each block whose united shape the search may need. A fixed body may be in several clusters;
 * each body is handled once, so that no two threads do the same work. */
sunder_status sunder_i_solver_unite_blocks(sunder_i_solver *solver, sunder_error *err);

/* ---- body_moves.c: between the layer and its clusters ------------------------------------------------------------ */

/* Loads the moves that the cluster starts from into its part of solver->move, and lends that. */
double *sunder_i_solver_load_moves(const sunder_i_solver *solver, const sunder_i_cluster *cluster);
/* Moves body b, unless it is fixed, to a rounded move, and notes the change. */
void sunder_i_solver_place(sunder_i_solver *solver, uint32_t b, const double *move);
/* The first pass: moves all bodies to the places that they prefer, as near as their limits let them, and relates them.
 * sunder_i_solver_start_of() sets `start` to the move of one body. */
sunder_status sunder_i_solver_start_preferred(sunder_i_solver *solver, sunder_error *err);
void sunder_i_solver_start_of(const sunder_i_solver *solver, uint32_t b, double start[2]);
/* Uses the new moves of the clusters that were worked on: moves their bodies, and notes which features changed and
 * whether their coordinates are exact. */
sunder_status sunder_i_solver_commit(sunder_i_solver *solver, sunder_error *err);
/* Relates the features that have moved, exactly. things: NULL, or the only things that were near one of them before or
 * are near one now. */
sunder_status sunder_i_solver_relate(sunder_i_solver *solver, sunder_error *err);
sunder_status sunder_i_solver_relate_near(sunder_i_solver *solver, const sunder_i_list *things, sunder_error *err);

#endif
