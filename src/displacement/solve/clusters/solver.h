/* The work on one layer, from its relations to its moves: what the stages share. (How one cluster is solved is a
 * question to the search: solve/search/cluster.h.) */
#ifndef SUNDER_I_SOLVER_H
#define SUNDER_I_SOLVER_H

#include "displacement/layer/jumps.h"
#include "displacement/layer/placement.h"
#include "displacement/layer/reads.h"
#include "displacement/prove/optimum/optimum.h"
#include "displacement/solve/clusters/body_state.h"
#include "displacement/solve/search/cluster.h"

#include "base/parallel.h"
#include "separation/separation.h"
#include "sunder_proof.h"

typedef struct sunder_i_cluster_member {
    uint32_t root, body;
} sunder_i_cluster_member;

/* Features a and b, one of which is to get inside the other: a move of b that brings them there. */
typedef struct sunder_i_entry {
    uint32_t a, b;
    bool a_inside;
    double place[2];
} sunder_i_entry;

/* The contact groups of the layout. */
typedef struct sunder_i_groups {
    sunder_i_group *group;
    size_t n;
    uint32_t *of;            /* [bodies] the number of the group; SUNDER_I_NOBODY: it stands alone, or is fixed */
    sunder_i_waiver *waived; /* pairs that are listed; sorted */
    size_t waived_n;
    sunder_i_id_pair *joined; /* bodies that proofs take together */
    size_t joins, capacity;
    double *spent;       /* [bodies] steps of proofs */
    bool with_diagonals; /* a body is SUNDER_I_WITH_DIAGONALS */
} sunder_i_groups;

/* Members of clusters are to be listed, whatever edges there are. */
#define SUNDER_I_NONE_LISTED SIZE_MAX

typedef struct sunder_i_solver {
    sunder_i_barriers barriers;
    sunder_layer layer; /* in the order of work, with parts of barriers behind the features */
    sunder_i_model model;
    sunder_i_placement placement;
    sunder_i_relations start, now;
    sunder_i_depth *depth; /* [depths] of those pairs of start that were asked about, which are few ... */
    size_t depths, depth_capacity;
    uint32_t *depth_at;    /* [start.n] ... index of that of each, plus one; 0: not computed. NULL: none */
    sunder_i_jumps jumps;  /* as the features stand */
    sunder_i_entry *entry; /* pairs that cannot be parted, but go inside */
    size_t entries, entry_capacity;
    sunder_i_id_pair *edge;
    size_t edges, edge_capacity;
    uint32_t *conflict_root;     /* see sunder_i_solver_conflict_roots() */
    uint32_t *parent;            /* [bodies] union-find over edges */
    sunder_i_body_states states; /* [bodies] */
    unsigned char *widened;      /* [bodies] how often the margin grew */
    sunder_i_changes changes;    /* what moved in this round */
    sunder_i_id_pair *alone;     /* things of pairs that were asked about by themselves (one_by_one.c); sorted */
    size_t alone_n, alone_capacity;
    uint64_t *alone_work;        /* [bodies] what those questions took in vain, by one body of each pair */
    uint32_t *crowd;             /* [bodies] in how large a crowd it began where prices of area put it; 0: in none */
    sunder_bound_pair *measured; /* features that were asked how far they have to go apart; some more than once */
    size_t measured_n, measured_capacity;
    double *limit;                   /* [bodies] the limits, while they are lifted; NULL: they never were */
    double *went;                    /* [2 * bodies] where those stood that were set aside because they went too far */
    sunder_i_relaxations waiting;    /* of what was set aside */
    uint32_t *carrier;               /* [bodies] whose place to start from instead of its own, or SUNDER_I_NOBODY */
    sunder_i_cluster_member *member; /* cluster after cluster, bodies ascending */
    size_t members;
    uint32_t *body; /* the bodies of member[] */
    double *move;   /* [2 * members] */
    sunder_i_cluster *cluster;
    size_t clusters;
    size_t room, listed;                      /* edges that there is room for here; and that member[] is of */
    bool brief;                               /* the first cluster without a solution ends it: nothing is given up */
    bool hopeless;                            /* there was one */
    double refuted;                           /* then: larger gaps have none, either, roughly */
    bool had_limits;                          /* limits were lifted at first */
    bool may_hold;                            /* bodies may be held (coarse_bodies.c) */
    bool any_let_go;                          /* bodies that were held were let go */
    struct sunder_i_held_layout *held_layout; /* before that (cluster_stages.h); lent */
    sunder_i_groups groups;                   /* contact groups, and what is proved of them; with effort 0 nothing */
} sunder_i_solver;

/* ---- body_state.c: the states of bodies -------------------------------------------------------------------------- */

/* NULL, or what is wrong with the states of bodies between two stages. In builds that assert. */
const char *sunder_i_solver_check_states(const sunder_i_solver *solver);

/* Is this so of the body? */
typedef bool (*sunder_i_body_test)(const sunder_i_solver *solver, uint32_t body);

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

/* From solver->model, which has its bodies. Failure leaves what sunder_i_solver_free() takes. */
sunder_status sunder_i_solver_init(sunder_i_solver *solver, sunder_error *err);
void sunder_i_solver_free(sunder_i_solver *solver);

/* ---- clusters.c: edges and clusters ------------------------------------------------------------------------------ */

/* [bodies] The components of the conflicts at the start, by their roots, lent; a fixed body joins none. NULL if memory
 * is out. Not for several threads at a time: they are found when somebody first asks. */
const uint32_t *sunder_i_solver_conflict_roots(sunder_i_solver *solver);
/* Adds the edge (i, j). False if memory is out. */
bool sunder_i_solver_add_edge(sunder_i_solver *solver, uint32_t i, uint32_t j);
/* Was the body a member of the cluster of that root when they were last gathered? */
bool sunder_i_solver_has_member(const sunder_i_solver *solver, uint32_t root, uint32_t body);
/* The members of the cluster of that root, ascending; NULL and none if it is no cluster's. */
const uint32_t *sunder_i_solver_members(const sunder_i_solver *solver, uint32_t root, size_t *n);
/* The cluster of that root, or that the body is of, as they were last gathered; NULL: none. */
sunder_i_cluster *sunder_i_solver_cluster_with(const sunder_i_solver *solver, uint32_t root);
sunder_i_cluster *sunder_i_solver_cluster_of(const sunder_i_solver *solver, uint32_t body);
/* Does any of the n bodies that may move pass the test? */
bool sunder_i_solver_any_of(const sunder_i_solver *solver, const uint32_t *body, size_t n, sunder_i_body_test test);
/* Returns an array [bodies]: is the body connected, by the present edges, with a movable body that passes the test?
 * It is false for fixed bodies. The caller frees the array. NULL if memory is out. */
bool *sunder_i_solver_connected_with(const sunder_i_solver *solver, sunder_i_body_test test);
/* What is asked of these bodies beyond the gap. */
double sunder_i_solver_margin(const sunder_i_solver *solver, const uint32_t *b, size_t n);
/* The body for which the cluster's reads are recorded: one that is in no other cluster. */
static inline uint32_t sunder_i_reader_for(const sunder_i_solver *solver, const sunder_i_cluster *cluster)
{
    return solver->member[cluster->body - solver->body].root;
}
/* Frees the state of clusters except for their lists of members, until they are gathered again. */
void sunder_i_solver_forget_clusters(sunder_i_solver *solver);
/* Work on all clusters as they were last gathered, by their numbers. */
sunder_status sunder_i_solver_for_clusters(const sunder_i_solver *solver, sunder_i_work work, void *context,
                                           sunder_error *err);
/* Emits the log of each cluster, in the order of the clusters, if the layer is traced. */
sunder_status sunder_i_solver_trace_clusters(sunder_i_solver *solver, sunder_error *err);
/* Clusters from the edges, afresh. */
sunder_status sunder_i_solver_gather(sunder_i_solver *solver, sunder_error *err);
/* Unites those blocks of clusters whose union the search may need. A fixed one may be a member of several clusters:
 * each body is handled once, so that no two threads do the same. */
sunder_status sunder_i_solver_unite_blocks(sunder_i_solver *solver, sunder_error *err);

/* ---- body_moves.c: between the layer and its clusters ------------------------------------------------------------ */

/* Loads the moves that a cluster starts from, and lends them. */
double *sunder_i_solver_load_moves(const sunder_i_solver *solver, const sunder_i_cluster *cluster);
/* Moves body b, unless it is fixed, by a move that was rounded; marks what changed. */
void sunder_i_solver_place(sunder_i_solver *solver, uint32_t b, const double *move);
/* Takes over the moves of clusters that were worked on: bodies, features that changed, and whether their coordinates
 * stayed exact. */
sunder_status sunder_i_solver_commit(sunder_i_solver *solver, sunder_error *err);
/* Exact relations of what changed; of what is few, with all things that were near one of them, then or now. */
sunder_status sunder_i_solver_relate(sunder_i_solver *solver, sunder_error *err);
sunder_status sunder_i_solver_relate_near(sunder_i_solver *solver, const sunder_i_list *things, sunder_error *err);

#endif
