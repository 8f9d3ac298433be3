/* The work on one layer, from its relations to its report: what the stages of separate.c share. */
#ifndef SUNDER_I_JOB_H
#define SUNDER_I_JOB_H

#include "base/union_find.h"
#include "displacement/displacement.h"

typedef struct sunder_i_member {
    uint32_t root, body;
} sunder_i_member;

/* What is known of a component of the layer's conflicts. */
typedef enum sunder_i_standing {
    SUNDER_I_UNASKED,
    SUNDER_I_LEFT /* asked about, and no solution was found */
} sunder_i_standing;

/* Features a and b, of which the one is to get inside the other: a move of b that brings them there. */
typedef struct sunder_i_entry {
    uint32_t a, b;
    bool a_inside;
    double place[2];
} sunder_i_entry;

typedef struct sunder_i_job {
    sunder_layer layer; /* in the order of work; its own copy of the features */
    size_t *number;     /* [features] what they were; NULL: nothing was put in order */
    sunder_i_town town;
    sunder_i_scene scene;
    sunder_i_relations start, now;
    sunder_i_entry *entry; /* pairs that cannot be parted, but go inside */
    size_t entries, entry_capacity;
    sunder_i_couple *edge;
    size_t edges, edge_capacity;
    uint32_t *parent;        /* [bodies] union-find over edges */
    bool *dirty;             /* [bodies] to be solved (again) */
    unsigned char *widened;  /* [bodies] how often the margin grew */
    bool *changed;           /* [features] moved in this round */
    unsigned char *standing; /* [bodies] a sunder_i_standing, by the least of a component of conflicts */
    bool *improved;          /* [bodies] better sides were looked for since the body's cluster was solved */
    double *limit;           /* [bodies] the limits, while they are lifted */
    bool *aside;             /* [bodies] left as they are while limits are lifted; NULL: they never were */
    sunder_i_truces waiting; /* of what was set aside */
    uint32_t *carrier;       /* [bodies] whose place to start from instead of its own, or SUNDER_I_NOBODY */
    sunder_i_member *member; /* cluster after cluster, bodies ascending */
    size_t members;
    uint32_t *body; /* the bodies of member[] */
    double *move;   /* [2 * members] */
    sunder_i_cluster *cluster;
    size_t clusters;
    sunder_report *report;
} sunder_i_job;

/* From w->town, which has its bodies. Failure leaves what sunder_i_job_free() takes. */
sunder_status sunder_i_job_init(sunder_i_job *w, sunder_error *err);
void sunder_i_job_free(sunder_i_job *w);

/* ---- clusters.c ---- */

/* The least member of x's set; halves the paths on its way. */
/* An edge between bodies, which makes them dirty. False if memory is out. */
bool sunder_i_job_add_edge(sunder_i_job *w, uint32_t i, uint32_t j);
/* Was the body a member of the cluster of that root when they were last gathered? */
bool sunder_i_job_has_member(const sunder_i_job *w, uint32_t root, uint32_t body);
/* The members of the cluster of that root, ascending; none if it is no cluster's. */
const uint32_t *sunder_i_job_members(const sunder_i_job *w, uint32_t root, size_t *n);
/* Clusters from the edges, afresh. */
sunder_status sunder_i_job_gather(sunder_i_job *w, sunder_error *err);

/* ---- settle.c ---- */

/* Do the two stand in conflict, in different bodies? */
bool sunder_i_job_is_conflict(const sunder_i_town *town, const sunder_i_relation *r);
/* ... and is it one that the search is to resolve, with no truce? */
bool sunder_i_job_is_between(const sunder_i_town *town, const sunder_i_relation *r);
/* Is one of the cluster's bodies dirty? */
bool sunder_i_job_is_dirty(const sunder_i_job *w, const sunder_i_cluster *c);
/* Unites the blocks that clusters are made of. A fixed one may be a member of several clusters: each body once, so that
 * no two threads do the same. */
sunder_status sunder_i_job_unite_blocks(sunder_i_job *w, sunder_error *err);
/* The moves that a cluster starts from. */
void sunder_i_job_load_moves(const sunder_i_job *w, const sunder_i_cluster *c, double *move);
/* Moves body b, unless it is fixed, by a move that was rounded; marks what changed. */
void sunder_i_job_place(sunder_i_job *w, uint32_t b, const double *move);
/* Takes over the clusters' moves: bodies, features that changed, and whether their coordinates stayed exact. */
void sunder_i_job_commit(sunder_i_job *w);
/* Exact relations of what changed. */
sunder_status sunder_i_job_check(sunder_i_job *w, sunder_error *err);
/* Solves clusters until nothing is in conflict but what was given up. Progress goes from `from` to `to`. */
sunder_status sunder_i_job_settle(sunder_i_job *w, double from, double to, sunder_error *err);
/* Were better sides looked for since any cluster was last solved? */
bool sunder_i_job_is_improved(const sunder_i_job *w);
/* Better sides, for every cluster that was solved since they were last looked for. */
sunder_status sunder_i_job_improve(sunder_i_job *w, sunder_error *err);

/* ---- insoluble.c ---- */

/* What lies in two that are in conflict is kept in one of them. */
sunder_status sunder_i_job_choose_holders(sunder_i_job *w, sunder_error *err);
/* Finds, exactly, the pairs that cannot be brought to peace within their limits, and puts them under a truce; and those
 * that cannot be parted, but may go inside, which are kept there from then on. Before the town is cut. */
sunder_status sunder_i_job_judge(sunder_i_job *w, sunder_error *err);
/* Takes over the truces that clusters made, and ended. */
sunder_status sunder_i_job_note_truces(sunder_i_job *w, sunder_error *err);
/* Once nothing joins clusters any more: asks what was given up once more, a cluster at a time. */
sunder_status sunder_i_job_retry(sunder_i_job *w, sunder_error *err);

/* ---- enter.c ---- */

/* Sends those there that cannot be parted, but go inside. */
sunder_status sunder_i_job_enter(sunder_i_job *w, sunder_error *err);

/* ---- limits.c ---- */

/* Lets bodies go as far as they like, but for those that are set aside. *lifted: there were limits. */
sunder_status sunder_i_job_lift_limits(sunder_i_job *w, bool *lifted, sunder_error *err);
/* What went too far goes back where it came from, to be solved within its limits: *any, if there is such. */
sunder_status sunder_i_job_restore_limits(sunder_i_job *w, bool *any, sunder_error *err);

/* ---- uphold.c ---- */

/* Does the pair, which is in conflict, stand worse than it stood? Exact. */
sunder_status sunder_i_job_is_worse(const sunder_i_job *w, const sunder_i_relation *r, bool *worse, sunder_error *err);
/* Takes back what rounding made worse, pair by pair. */
sunder_status sunder_i_job_uphold(sunder_i_job *w, sunder_error *err);
/* Does no pair in conflict stand worse than it stood? */
sunder_status sunder_i_job_is_upheld(const sunder_i_job *w, bool *upheld, sunder_error *err);

/* ---- bound_pairs.c ---- */

/* Fills the report's pairs for the lower bound, and the bound. */
sunder_status sunder_i_job_bound(sunder_i_job *w, sunder_error *err);

/* ---- infeasible.c ---- */

/* Looks again at what was given up. What has a solution after all is put there, which is to be settled: *changed. */
sunder_status sunder_i_job_reconsider(sunder_i_job *w, bool *changed, sunder_error *err);

/* ---- verdicts.c ---- */

/* Tells what cannot be resolved from what was not: of the report's conflicts, those with a proof have "no_room". */
sunder_status sunder_i_job_prove(sunder_i_job *w, sunder_error *err);

/* ---- blockers.c ---- */

/* Fills the conflicts' blocked_by. */
sunder_status sunder_i_job_name_blockers(sunder_i_job *w, sunder_error *err);

#endif
