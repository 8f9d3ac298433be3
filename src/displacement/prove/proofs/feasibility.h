/* Subproblems: a few bodies with limits; is there a proof that they have no solution, or a solution? See
 * feasibility.c. */
#ifndef SUNDER_I_FEASIBILITY_H
#define SUNDER_I_FEASIBILITY_H

#include "displacement/layer/requirement.h"
#include "sunder_proof.h"

typedef enum sunder_i_verdict {
    SUNDER_I_UNKNOWN,    /* neither was shown: the work exceeded its limit, a body has no limit, rounding prevented an
                          * answer, or the question was not examined */
    SUNDER_I_INFEASIBLE, /* proved: no moves within the limits give every pair the distance that it has to keep */
    SUNDER_I_FEASIBLE    /* the solution gives it, up to a hair; things that it did not meet were not examined */
} sunder_i_verdict;

/* Cached planes of relative moves, the most recently used first, for consecutive questions on one thread about one
 * model, which does not change (plane_kept.c). Zeroed: none. */
#define SUNDER_I_PLANES_KEPT 4
struct sunder_i_plane_kept;
struct sunder_i_half_planes_kept;
typedef struct sunder_i_planes {
    struct sunder_i_plane_kept *plane[SUNDER_I_PLANES_KEPT];
    struct sunder_i_half_planes_kept *half_planes; /* those between pieces (half_planes_kept.c) */
} sunder_i_planes;

void sunder_i_planes_clear(sunder_i_planes *planes);

/* Results of earlier questions about the same bodies, the most recently used first: the things that sufficed for a
 * proof, and free places. All are about one model, which does not change (precedents.c). Zeroed: none. */
#define SUNDER_I_PRECEDENTS 16
#define SUNDER_I_PRECEDENT_THINGS 48
#define SUNDER_I_PRECEDENT_PLACES 4
typedef struct sunder_i_precedent {
    uint32_t p, q; /* bodies, as in the plane of their relative move; equal: the entry is empty */
    bool fine;     /* coarse half-planes were not sufficient for the proof */
    uint32_t thing[SUNDER_I_PRECEDENT_THINGS];
    size_t things, places;
    double place[SUNDER_I_PRECEDENT_PLACES][2];
} sunder_i_precedent;

typedef struct sunder_i_precedents {
    sunder_i_precedent of[SUNDER_I_PRECEDENTS];
} sunder_i_precedents;

typedef struct sunder_i_subproblem {
    const sunder_i_model *model;
    const uint32_t *body; /* the bodies to begin with; bodies that they meet take part, too */
    size_t bodies;
    const uint32_t *reserve; /* ascending: bodies that join, if they are in reach of participants, when nothing else is
                              * met */
    size_t reserves;
    double farthest; /* the longest finite limit of the reserve */
    uint32_t a, b;   /* two things (a barrier by its first part) that have to keep the full distance from each other,
                      * whatever is listed; or SUNDER_I_NOBODY */
    const sunder_i_requirement *required; /* the reduced requirements; sorted */
    size_t required_n;
    double less;             /* the gap is reduced by this: the answer is for a smaller gap */
    double margin;           /* extra distance beyond what is required; 0 if a proof is sought */
    double held_margin;      /* the same beyond what `required` says */
    const uint32_t *feature; /* NULL, or the only things that count, a barrier by its first part; ascending */
    size_t features;
    /* Half-planes may demand less by this share of the two bodies' limits. Then proofs are smaller, but a solution need
     * not be one. With 0 a feasible answer holds up to a hair. */
    double coarse;
    /* A feature that may keep an overlap with a barrier has one translation that separates it from all parts, not one
     * for each two parts: proofs are larger, and some are found only like this. */
    bool slack;
    const double *near;      /* NULL, or [2 * bodies of the model]: solutions near this layout are looked for first */
    bool still;              /* only if a body between two lines has no place there except its own: corridor.c */
    bool every_side;         /* sides of barriers count even if the barriers are not in `feature` */
    bool any_jump;           /* features may jump over each other */
    bool ignore_paths;       /* features may cross sides, too: no relative move is forbidden */
    bool heed_paths;         /* the rules on paths of all members of `body` count, even if `feature` lacks them */
    bool rows;               /* the rule of rows counts */
    bool row_listed;         /* for the two in question it is that of a listed pair */
    double instead;          /* > 0: a limit for bodies that have none; else the question is not examined */
    bool no_plane;           /* the plane of one relative move was examined before, without an answer */
    bool exact;              /* lines without a rounding error, and the border of what is closed, are told apart */
    bool fine_plane;         /* coarse half-planes give no answer there: they are skipped */
    sunder_i_planes *planes; /* NULL, or a cache for questions about the same bodies */
    /* NULL, or earlier results, which are tried first: then any solution, and any proof, may be returned. */
    sunder_i_precedents *precedents;
    uint64_t effort; /* the limit of the work, in constraints examined; 0: only the plane of one relative move is
                      * examined */
    size_t most;     /* the search ends when more bodies than these take part */
} sunder_i_subproblem;

typedef struct sunder_i_solution {
    uint32_t *body; /* ascending: the movable bodies asked about, and the bodies that they met */
    double *move;   /* [2 * bodies] the move of each */
    size_t bodies;
} sunder_i_solution;

typedef struct sunder_i_decision {
    sunder_i_verdict verdict;
    sunder_i_solution solution; /* if SUNDER_I_FEASIBLE */
    sunder_proof *proof;        /* if SUNDER_I_INFEASIBLE */
    uint64_t work;
    bool straight;             /* the proof is one chain, whose links are nearly on one line */
    bool no_plane, fine_plane; /* as in the subproblem, for later questions about these things or fewer */
} sunder_i_decision;

/* The links of a cluster, cached for all questions about its conflicts; for one thread and one model, which does not
 * change (chain.c). */
typedef struct sunder_i_chains sunder_i_chains;

/* Makes the cache for the cluster whose bodies are cluster->reserve, with the requirements in force. all: for finding
 * the smallest set that cannot be solved together, where every pair has to keep its full distance. Returns NULL if
 * memory is out. */
sunder_i_chains *sunder_i_chains_new(const sunder_i_subproblem *cluster, bool all);
void sunder_i_chains_free(sunder_i_chains *chains);
/* Looks for a proof that the things a and b of the subproblem push others to their limits, one after the other. The
 * verdict is infeasible or unknown. *links: the length of the longest chain. The caller clears the decision, also after
 * a failure. */
sunder_status sunder_i_chains_decide(sunder_i_chains *chains, const sunder_i_subproblem *subproblem,
                                     sunder_i_decision *decision, size_t *links, sunder_error *err);

/* May any required pair keep an overlap with a barrier? */
bool sunder_i_may_have_slack(const sunder_i_subproblem *subproblem);
/* Decides the subproblem. The caller clears the decision, also after a failure. */
sunder_status sunder_i_decide(const sunder_i_subproblem *subproblem, sunder_i_decision *decision, sunder_error *err);
void sunder_i_decision_clear(sunder_i_decision *decision);
void sunder_i_proof_free(sunder_proof *proof);
/* Writes the features that a proof uses, and its barriers by their first parts, ascending, to `set`, which has room for
 * three per node. Returns their number. */
size_t sunder_i_proof_things(const sunder_i_model *model, const sunder_proof *proof, uint32_t *set);
/* Sets *gap roughly to the least gap, at most the one that the proof is for, for which it still proves that there is no
 * solution (least_gap.c). */
sunder_status sunder_i_proof_least_gap(const sunder_i_subproblem *subproblem, const sunder_proof *proof, double *gap,
                                       sunder_error *err);
/* Strips the proof to its feature list: the two things of each inner node, once. It can no longer be checked. */
void sunder_i_proof_strip(sunder_proof *proof);

#endif
