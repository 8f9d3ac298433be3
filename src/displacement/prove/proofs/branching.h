/* The state of a branch and bound over a few bodies (feasibility.c), and its parts: one node's program, what its
 * candidate violates, the branches, the record of the proof. */
#ifndef SUNDER_I_BRANCHING_H
#define SUNDER_I_BRANCHING_H

#include "displacement/prove/proofs/feasibility.h"
#include "displacement/prove/proofs/half_planes.h"
#include "displacement/quadratic/nearest.h"
#include "sunder_proof.h"

#include <math.h>

/* No deeper than this. */
#define SUNDER_I_LEVELS 192

/* Violations of a candidate that are weighed against each other. */
#define SUNDER_I_CHOICES 8

/* A set of levels. */
typedef struct sunder_i_levels {
    uint64_t bit[SUNDER_I_LEVELS / 64];
} sunder_i_levels;

static inline void sunder_i_levels_add(sunder_i_levels *s, unsigned level)
{
    s->bit[level / 64] |= UINT64_C(1) << level % 64;
}

static inline void sunder_i_levels_drop(sunder_i_levels *s, unsigned level)
{
    s->bit[level / 64] &= ~(UINT64_C(1) << level % 64);
}

static inline bool sunder_i_levels_has(const sunder_i_levels *s, unsigned level)
{
    return s->bit[level / 64] >> level % 64 & 1;
}

static inline void sunder_i_levels_join(sunder_i_levels *s, const sunder_i_levels *more)
{
    for (size_t k = 0; k < sizeof s->bit / sizeof *s->bit; k++) s->bit[k] |= more->bit[k];
}

/* A feature that is held to an overlap with a barrier: what stands for the translation that parts them takes part like
 * a body, whose limit is how long that may be. */
typedef struct sunder_i_slack {
    const sunder_i_requirement *required;
    uint32_t place;
} sunder_i_slack;

/* What a branch of the tree says: that a pair is beyond a line, or behind it. */
typedef struct sunder_i_claim {
    uint32_t i, j;  /* places in sunder_i_branching.body, or SUNDER_I_GROUND: what does not move */
    double n[2], d; /* n.(t_j - t_i) >= d */
    double force;   /* in the last program */
    size_t node, way;
    bool behind;
    unsigned level; /* the branch that makes the claim */
} sunder_i_claim;

/* A chord across the corner that two sides share, in the shadows of both (corner_chord.c). */
typedef struct sunder_i_chord {
    double at[4]; /* its ends, beyond side[0] and side[1] */
    const sunder_i_side *side[2];
} sunder_i_chord;

/* A node of the tree, as of sunder_proof_node; its parts are pieces of the model. */
typedef struct sunder_i_node {
    uint32_t a, b; /* features */
    const sunder_i_body_piece *part_a, *part_b;
    double clearance;
    bool shadow; /* one part is an anchor, which may not pass the other */
    bool slack;  /* the ways are those of the second part when it is moved by the pair's slack */
    bool held;   /* the clearance is what the pair stood apart, exactly */
    size_t way, ways, force, forces;
    bool still; /* a leaf: between the lines of two ways a body stays where it is */
    size_t line_node[2], line_way[2];
    size_t chord; /* which stands for the second part, which is its first side; SIZE_MAX: none */
} sunder_i_node;

/* A listed pair of a movable and a fixed thing, and a line that it may not cross, exactly: n.u >= 0, n of doubles and
 * about 1 long. */
typedef struct sunder_i_corridor_wall {
    const sunder_i_body_piece *a, *b; /* a: the piece of the movable one */
    double clearance, n[2];
    /* NULL; or the pair is held to this overlap, and n.(u + v) >= d, with v its slack: since d exceeds what v can
     * contribute, n.u >= 0 follows. */
    const sunder_i_requirement *slack;
    double d;
} sunder_i_corridor_wall;

typedef struct sunder_i_branching {
    const sunder_i_subproblem *subproblem;
    const sunder_i_model *model;
    /* Those that may move and take part so far, in the order in which they came in. */
    uint32_t *body;                           /* SUNDER_I_NOBODY: a slack */
    double *limit, *t, *shift, *net, *weight; /* t: the candidate; shift: from the last one, the program's */
    size_t bodies;
    sunder_i_slack *slack;
    size_t slacks, slack_capacity;
    size_t body_capacity, limit_capacity, t_capacity, shift_capacity, net_capacity, weight_capacity;
    double longest;        /* limit */
    double hair;           /* a length far below the limits, and far above rounding */
    uint64_t looked;       /* work done besides the programs' */
    sunder_i_claim *claim; /* what the branches down to the node at hand say */
    size_t claims, claim_capacity;
    sunder_i_quadratic program;
    sunder_i_nearest nearest;
    /* The record. */
    sunder_i_node *node;
    size_t nodes, node_capacity;
    sunder_i_half_plane *way;
    size_t ways, way_capacity;
    sunder_proof_force *force;
    size_t forces, force_capacity;
    sunder_i_chord *chord;
    size_t chords, chord_capacity;
    sunder_i_half_plane *scratch;
    size_t scratch_capacity;
    struct sunder_i_half_planes_kept *kept; /* NULL, or ways computed before (half_planes_kept.c) */
    sunder_i_list near;
    bool closely; /* lines are made for the candidate (half_planes.h) */
    /* Two walls, opposite to each other, or none: the first branches. The body between them, and whether it is. */
    sunder_i_corridor_wall wall[2];
    size_t walls;
    uint32_t between;
    bool still;
    bool failed; /* memory is out */
} sunder_i_branching;

/* Work so far, and whether the work, or the number of participants, exceeds its limit. */
static inline uint64_t sunder_i_branching_work(const sunder_i_branching *c) { return c->looked + c->program.work; }

static inline bool sunder_i_branching_is_over(const sunder_i_branching *c)
{
    return sunder_i_branching_work(c) > c->subproblem->effort || c->bodies > c->subproblem->most;
}

/* How far a body may go. */
static inline double sunder_i_branching_limit(const sunder_i_branching *c, const sunder_i_body *body)
{
    const double limit = sunder_i_limit_of(body);
    return limit == INFINITY && c->subproblem->instead > 0 ? c->subproblem->instead : limit;
}

/* ---- participants.c ---------------------------------------------------------------------------------------------- */

/* The place of a body among those that take part; SUNDER_I_GROUND: it is none of them, or cannot move. */
uint32_t sunder_i_branching_place(const sunder_i_branching *branching, uint32_t body);
/* The same, and it is taken in if it was not there; SUNDER_I_GROUND: it cannot move. */
uint32_t sunder_i_branching_join(sunder_i_branching *branching, uint32_t body);
/* The place of a slack; SUNDER_I_GROUND: it does not take part. And it is taken in if it was not there. */
uint32_t sunder_i_branching_slack(const sunder_i_branching *branching, const sunder_i_requirement *required);
uint32_t sunder_i_branching_join_slack(sunder_i_branching *branching, const sunder_i_requirement *required);
/* Those that take part from the first-th place on stand where they begin: at home, slacks at what parted their pairs.
 */
void sunder_i_branching_begin(sunder_i_branching *branching, size_t first);
/* Takes in those of the reserve that could meet one that takes part; false if there are none. */
bool sunder_i_branching_widen(sunder_i_branching *branching);
/* What is asked of two things that are not held to less, rounded down. */
double sunder_i_branching_owed(const sunder_i_subproblem *subproblem, uint32_t f, uint32_t g);
/* Do features f and g of two bodies owe each other a distance? Then *clearance is set to it. */
bool sunder_i_branching_owe(const sunder_i_branching *branching, uint32_t f, uint32_t g, double *clearance);
/* Is f heeded, or are its ways? */
bool sunder_i_branching_is_way_heeded(const sunder_i_branching *branching, uint32_t f);
/* May f, of another body, not jump over g, or if g is part of a barrier cross its sides? */
bool sunder_i_branching_shades(const sunder_i_branching *branching, uint32_t f, uint32_t g);

/* ---- program.c --------------------------------------------------------------------------------------------------- */

typedef enum sunder_i_node_outcome {
    SUNDER_I_NODE_INFEASIBLE, /* what the claims say contradicts the limits, proved by their forces */
    SUNDER_I_NODE_CANDIDATE,  /* t is as the claims say, up to a hair */
    SUNDER_I_NODE_UNDECIDED   /* too near to call */
} sunder_i_node_outcome;

sunder_status sunder_i_branching_solve(sunder_i_branching *branching, sunder_i_node_outcome *outcome,
                                       sunder_error *err);
/* Is the last claim, alone or with another of the same pair, more than the limits allow? Then the forces are set to say
 * so. */
bool sunder_i_branching_is_dead_end(sunder_i_branching *branching);

/* Do the claims contradict the limits, by the forces that they have? Proved, with all rounding. */
bool sunder_i_branching_is_contradiction(sunder_i_branching *branching);

/* Do these claims of one pair, at most three, contradict the limits? Then the forces are set to say so. */
bool sunder_i_branching_contradict(sunder_i_branching *branching, const uint32_t *claim, size_t n);

/* ---- violations.c ------------------------------------------------------------------------------------------------ */

/* Two convex pieces that the candidate has nearer than they owe; or an anchor, and a piece that it passed. */
typedef struct sunder_i_violation {
    uint32_t p, q; /* bodies; p takes part, q may not yet */
    const sunder_i_body_piece *a, *b;
    double clearance, depth;
    const sunder_i_requirement *slack; /* NULL, or the pair: a belongs to the feature and b to the barrier */
    bool shadow;                       /* a or b is an anchor, and in the shadow of the other */
    bool known;                        /* it adds no participant: both take part already, or one of them never moves */
    bool closely;                      /* as of sunder_i_branching */
    bool held;                         /* it is a wall */
    const sunder_i_chord *chord;       /* NULL, or the piece that replaces b */
} sunder_i_violation;

/* The deepest of the candidate's, one of each pair of bodies: known ones first, the deepest first. Returns how many. */
size_t sunder_i_branching_violations(sunder_i_branching *branching, sunder_i_violation deepest[SUNDER_I_CHOICES]);
/* The ways between two pieces of bodies p and q: into branching->scratch. at: NULL, or as in half_planes.h. Returns how
 * many.
 */
size_t sunder_i_branching_fill_ways(sunder_i_branching *branching, const sunder_i_body *p, const sunder_i_body_piece *a,
                                    const sunder_i_body *q, const sunder_i_body_piece *b, double clearance, bool shadow,
                                    const double *at);
/* The same without a place, cached for repeated use: *n of them, valid until the next call. */
const sunder_i_half_plane *sunder_i_branching_keep_ways(sunder_i_branching *branching, const sunder_i_body *p,
                                                        const sunder_i_body_piece *a, const sunder_i_body *q,
                                                        const sunder_i_body_piece *b, double clearance, bool shadow,
                                                        size_t *n);
void sunder_i_branching_forget_ways(sunder_i_branching *branching);
/* How far a relative move is from the first of the ways in branching->scratch; -INFINITY: there are none. */
double sunder_i_branching_depth(const sunder_i_branching *branching, size_t ways, const double u[2]);
/* The ways out of one, nearest to the candidate first: into branching->scratch. Returns how many. */
size_t sunder_i_branching_ways(sunder_i_branching *branching, const sunder_i_violation *violation);

/* ---- branches.c -------------------------------------------------------------------------------------------------- */

/* Goes through the branches below the claims as they are. levels: of those that the proof needs; *root: its node. */
sunder_status sunder_i_branching_search(sunder_i_branching *branching, unsigned level, sunder_i_verdict *verdict,
                                        sunder_i_levels *levels, size_t *root, sunder_error *err);

/* A node for the contradiction that the claims' forces prove, whose levels are told; one for a violation, with the ways
 * out of it that are in branching->scratch; and the claim of one of its cases. False if memory is out. */
bool sunder_i_branching_add_leaf(sunder_i_branching *branching, sunder_i_levels *levels, size_t *root);
bool sunder_i_branching_add_branch(sunder_i_branching *branching, const sunder_i_violation *violation, size_t ways,
                                   size_t *root);
bool sunder_i_branching_push(sunder_i_branching *branching, uint32_t i, uint32_t j, size_t node, size_t way,
                             bool behind, unsigned level);

/* ---- corner_chord.c ---------------------------------------------------------------------------------------------- */

/* The side that has that piece. */
const sunder_i_side *sunder_i_branching_side_of(const sunder_i_model *model, const sunder_i_body_piece *piece);
/* A chord for the sides from b to p and from b to q, as the anchor a sees them; false: there is none. */
bool sunder_i_branching_make_chord(const double a[2], const double b[2], const double p[2], const double q[2],
                                   double chord[4]);
/* The ways past a chord whose first side is of body q: into branching->scratch. Returns how many. */
size_t sunder_i_branching_chord_ways(sunder_i_branching *branching, const sunder_i_body *p,
                                     const sunder_i_body_piece *anchor, const sunder_i_body *q, const double chord[4]);

/* ---- corridor.c -------------------------------------------------------------------------------------------------- */

/* Are there two walls that leave this body, which takes part, no place but its own? Then they are branching->wall. */
sunder_status sunder_i_branching_find_corridor(sunder_i_branching *branching, uint32_t body, sunder_error *err);
/* The ways out of one, that beyond its line first: into branching->scratch. Returns how many; 0: none are found. */
size_t sunder_i_branching_wall_ways(sunder_i_branching *branching, const sunder_i_corridor_wall *wall);

/* ---- plane.c ----------------------------------------------------------------------------------------------------- */

/* What the plane of one relative move tells of a subproblem. */
typedef struct sunder_i_plane_answer {
    sunder_i_verdict verdict; /* feasible only if all other things asked about are irrelevant */
    double u[2];              /* then: the move of q less that of p */
    uint32_t p, q;            /* bodies; q may be SUNDER_I_GROUND */
    bool free;                /* a place was met where nothing is forbidden */
    size_t root;
} sunder_i_plane_answer;

/* The question of the one body of a subproblem that may move, among what stands, or of its two. */
sunder_status sunder_i_branching_plane(sunder_i_branching *branching, sunder_i_plane_answer *answer, sunder_error *err);
/* The same of some places alone: feasible if nothing is in the way at one of them, else unknown. */
sunder_status sunder_i_branching_plane_try(sunder_i_branching *branching, const double (*at)[2], size_t n,
                                           sunder_i_plane_answer *answer, sunder_error *err);
/* The bodies that the plane is about; false: it is about none. */
bool sunder_i_branching_plane_bodies(const sunder_i_branching *branching, uint32_t *p, uint32_t *q);

/* ---- precedents.c ------------------------------------------------------------------------------------------------ */

/* What is known of those bodies. */
sunder_i_precedent *sunder_i_precedents_take(sunder_i_precedents *precedents, uint32_t p, uint32_t q);
void sunder_i_precedent_note_place(sunder_i_precedent *precedent, const double u[2]);
/* False if memory is out. */
bool sunder_i_precedent_note_proof(sunder_i_precedent *precedent, const sunder_i_model *model,
                                   const sunder_proof *proof, bool fine);
/* The things that may suffice for a proof, among those asked about; 0: no fewer than all. */
size_t sunder_i_precedent_things(const sunder_i_precedent *precedent, const sunder_i_subproblem *asked,
                                 uint32_t set[SUNDER_I_PRECEDENT_THINGS + 2]);

/* ---- proof_record.c ---------------------------------------------------------------------------------------------- */

/* The part of the record below a node, by itself. NULL if memory is out. */
sunder_proof *sunder_i_proof_of(const sunder_i_branching *branching, size_t root);

#endif
