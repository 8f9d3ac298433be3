/* A few bodies with limits: a proof that there is no solution, or one; see feasibility.c. */
#ifndef SUNDER_I_FEASIBILITY_H
#define SUNDER_I_FEASIBILITY_H

#include "displacement/layer/requirement.h"
#include "sunder_proof.h"

typedef enum sunder_i_verdict {
    SUNDER_I_UNKNOWN,    /* the effort ran out, or a limit is infinite */
    SUNDER_I_INFEASIBLE, /* proved: no moves within the limits give every pair what it is owed */
    SUNDER_I_FEASIBLE    /* the solution does, up to a hair; what it did not meet is not heeded */
} sunder_i_verdict;

/* Planes of relative moves that questions after each other have in common, the last first; all of one model, which does
 * not change, and of one thread (plane_kept.c). All zero: none. */
#define SUNDER_I_PLANES_KEPT 4
struct sunder_i_plane_kept;
typedef struct sunder_i_planes {
    struct sunder_i_plane_kept *plane[SUNDER_I_PLANES_KEPT];
} sunder_i_planes;

void sunder_i_planes_clear(sunder_i_planes *planes);

/* What earlier questions about the same bodies told: the things that were enough for a proof, and places where nothing
 * was in the way, the last first; of one model, which does not change (precedents.c). All zero: none. */
#define SUNDER_I_PRECEDENTS 16
#define SUNDER_I_PRECEDENT_THINGS 48
#define SUNDER_I_PRECEDENT_PLACES 4
typedef struct sunder_i_precedent {
    uint32_t p, q; /* bodies, as in the plane of their relative move; equal: nothing is known */
    bool fine;     /* coarse lines were no proof */
    uint32_t thing[SUNDER_I_PRECEDENT_THINGS];
    size_t things, places;
    double place[SUNDER_I_PRECEDENT_PLACES][2];
} sunder_i_precedent;

typedef struct sunder_i_precedents {
    sunder_i_precedent of[SUNDER_I_PRECEDENTS];
} sunder_i_precedents;

typedef struct sunder_i_subproblem {
    const sunder_i_model *model;
    const uint32_t *body; /* the bodies to begin with; those that they run into are asked about as well */
    size_t bodies;
    const uint32_t *reserve; /* ascending: bodies that join those in reach of them when nothing else is met */
    size_t reserves;
    double farthest; /* their longest limit that is finite */
    uint32_t a, b;   /* things likewise that owe each other all, whatever is listed; or SUNDER_I_NOBODY */
    const sunder_i_requirement *required; /* sorted */
    size_t required_n;
    double less;             /* of the layer's gap so much is not asked for: what is told then is of a smaller gap */
    double margin;           /* extra distance to be kept beyond what is owed; it is 0 when a proof is sought */
    const uint32_t *feature; /* NULL, or the only things to be heeded, likewise, ascending */
    size_t features;
    /* Lines between pairs may be short by this share of how far the two may go: then proofs are smaller, and a
     * solution is none; 0: what is feasible is so up to a hair. */
    double coarse;
    /* What is held to an overlap with a barrier has one translation that parts them all, not one for each two parts:
     * proofs are larger, and some are found only so. */
    bool slack;
    bool still;              /* only of a body between two lines, which has no place there but its own: corridor.c */
    bool every_side;         /* the sides of barriers that are not among them are heeded, too */
    bool any_jump;           /* features may jump over each other */
    bool any_way;            /* and cross sides: no relative move is forbidden */
    bool every_way;          /* the forbidden moves of all members of `body` count, even if other things do not */
    double instead;          /* > 0: a limit for those that have none; else they are not asked about */
    bool no_plane;           /* the plane of one relative move has been asked about, and had no answer */
    bool fine_plane;         /* and coarse lines give no answer: they are skipped */
    sunder_i_planes *planes; /* NULL, or a cache for questions about the same bodies */
    /* NULL, or earlier answers, which are tried first: then any solution, and any proof, may be returned. */
    sunder_i_precedents *precedents;
    uint64_t effort; /* in constraints looked at; 0: only the plane of one relative move is examined */
    size_t most;     /* it ends where more bodies than these take part */
} sunder_i_subproblem;

typedef struct sunder_i_solution {
    uint32_t *body; /* ascending: the movable bodies asked about, and the things they met */
    double *move;   /* [2 * bodies] */
    size_t bodies;
} sunder_i_solution;

typedef struct sunder_i_decision {
    sunder_i_verdict verdict;
    sunder_i_solution solution; /* if SUNDER_I_FEASIBLE */
    sunder_proof *proof;        /* if SUNDER_I_INFEASIBLE */
    uint64_t work;
    bool straight;             /* the proof is one chain, from end to end along nearly the same line */
    bool no_plane, fine_plane; /* as above, for later questions about these things or fewer */
} sunder_i_decision;

/* The links of a cluster, cached for all questions about its conflicts; for one thread, and for one model, which does
 * not change (chain.c). */
typedef struct sunder_i_chains sunder_i_chains;

/* For the cluster whose bodies are the reserve, with the requirements in force; all: for the smallest set that cannot
 * be solved together, where every pair owes its full distance. NULL if memory is out. */
sunder_i_chains *sunder_i_chains_new(const sunder_i_subproblem *cluster, bool all);
void sunder_i_chains_free(sunder_i_chains *chains);
/* Is there a proof that the things a and b of the subproblem push others to their limits, one after the other?
 * Infeasible, or unknown. *links: of the longest chain. The answer is to be cleared, also on failure. */
sunder_status sunder_i_chains_decide(sunder_i_chains *chains, const sunder_i_subproblem *subproblem,
                                     sunder_i_decision *decision, size_t *links, sunder_error *err);

/* Is anything held to an overlap with a barrier? */
bool sunder_i_may_have_slack(const sunder_i_subproblem *subproblem);
/* The caller clears the answer, also after a failure. */
sunder_status sunder_i_decide(const sunder_i_subproblem *subproblem, sunder_i_decision *decision, sunder_error *err);
void sunder_i_decision_clear(sunder_i_decision *decision);
void sunder_i_proof_free(sunder_proof *proof);
/* The features that a proof names, and its barriers by their first parts, ascending: into set, which has room for three
 * a node. */
size_t sunder_i_proof_things(const sunder_i_model *model, const sunder_proof *proof, uint32_t *set);
/* *gap: roughly the least gap, no more than the one that it is of, for which it still proves that there is no solution
 * (least_gap.c). */
sunder_status sunder_i_proof_least_gap(const sunder_i_subproblem *subproblem, const sunder_proof *proof, double *gap,
                                       sunder_error *err);
/* Strips the proof to its feature list: the two things of each inner node, once. It can no longer be checked. */
void sunder_i_proof_strip(sunder_proof *proof);

#endif
