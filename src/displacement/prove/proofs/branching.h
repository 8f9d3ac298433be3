/* The state of a branch and bound over a few bodies (feasibility.c), and its parts: the program of one node, the
 * violations of its candidate, the branches, the record of the proof. */
#ifndef SUNDER_I_BRANCHING_H
#define SUNDER_I_BRANCHING_H

#include "displacement/prove/proofs/feasibility.h"
#include "displacement/prove/proofs/half_planes.h"
#include "displacement/quadratic/nearest.h"
#include "sunder_proof.h"

#include <math.h>

/* The greatest depth of the tree. */
#define SUNDER_I_LEVELS 192

/* The number of violations of a candidate that are compared. */
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

/* The slack of a feature that may keep an overlap with a barrier: the translation that has to separate the two. It
 * takes part like a body, whose limit is the greatest length of the translation. */
typedef struct sunder_i_slack {
    const sunder_i_requirement *required;
    uint32_t place;
} sunder_i_slack;

/* The claim of a branch: a pair is beyond a line, or behind it. */
typedef struct sunder_i_claim {
    uint32_t i, j;  /* places in sunder_i_branching.body, or SUNDER_I_GROUND for what does not move */
    double n[2], d; /* the claim is n.(t_j - t_i) >= d */
    double force;   /* its multiplier in the last program */
    size_t node, half_plane;
    bool behind;
    bool strict;    /* n.(t_j - t_i) > d holds, too */
    unsigned level; /* the level of the branch that makes the claim */
} sunder_i_claim;

/* A segment across the corner that two sides share, which lies in the shadows of both (corner_chord.c). */
typedef struct sunder_i_chord {
    double at[4]; /* its ends, beyond side[0] and side[1] */
    const sunder_i_side *side[2];
} sunder_i_chord;

/* A node of the tree, as sunder_proof_node; its parts are pieces of the model. */
typedef struct sunder_i_node {
    uint32_t a, b; /* the two features */
    const sunder_i_body_piece *part_a, *part_b;
    double clearance;
    bool shadow; /* one part is an anchor, which may not pass the other */
    bool slack;  /* the half-planes are for the second part moved by the pair's slack */
    bool held;   /* the clearance is exactly the distance of the pair at the start */
    bool row;    /* it is about the rule of rows; the parts are any of the two bodies */
    size_t half_plane, half_planes, force, forces;
    bool still; /* a leaf in which a body between the lines of two half-planes stays where it is */
    size_t line_node[2], line_way[2];
    size_t chord; /* the chord that replaces the second part, which is its first side; SIZE_MAX: none */
} sunder_i_node;

/* A listed pair of a movable and a fixed thing, and a line that it may not cross, exactly: n.u >= 0, where n is a
 * vector of doubles, about 1 long. */
typedef struct sunder_i_corridor_wall {
    const sunder_i_body_piece *a, *b; /* a: the piece of the movable thing; b: that of the fixed one */
    double clearance, n[2];
    /* NULL, or: the pair may keep this overlap, and n.(u + v) >= d with v its slack. Since d exceeds the greatest n.v,
     * n.u >= 0 follows. */
    const sunder_i_requirement *slack;
    double d;
} sunder_i_corridor_wall;

typedef struct sunder_i_branching {
    const sunder_i_subproblem *subproblem;
    const sunder_i_model *model;
    /* The movable bodies and slacks that take part, in the order in which they joined. */
    uint32_t *body;                           /* SUNDER_I_NOBODY for a slack */
    double *limit, *t, *shift, *net, *weight; /* limit: the longest moves; t: the candidate; shift: the program's
                                               * solution, relative to the last candidate; net, weight: scratch, the
                                               * sums of the forces on each and of their magnitudes */
    size_t bodies;
    sunder_i_slack *slack;
    size_t slacks, slack_capacity;
    size_t body_capacity, limit_capacity, t_capacity, shift_capacity, net_capacity, weight_capacity;
    double longest;        /* the longest limit */
    double hair;           /* a length far below the limits, and far above rounding errors */
    uint64_t looked;       /* the work done, except for the programs */
    sunder_i_claim *claim; /* the claims of the branches down to the present node */
    size_t claims, claim_capacity;
    sunder_i_quadratic program;
    sunder_i_nearest nearest;
    /* The record of the tree. */
    sunder_i_node *node;
    size_t nodes, node_capacity;
    sunder_i_half_plane *half_plane;
    size_t half_planes, half_plane_capacity;
    sunder_proof_force *force;
    size_t forces, force_capacity;
    sunder_i_chord *chord, across; /* across: the chord of a violation that is no node yet */
    size_t chords, chord_capacity;
    sunder_i_half_plane *scratch;
    size_t scratch_capacity;
    struct sunder_i_half_planes_kept *kept; /* NULL, or a cache of half-planes (half_planes_kept.c) */
    sunder_i_list near;
    bool closely; /* half-planes are made for the candidate (half_planes.h) */
    /* Two opposite walls, or none: they are the first branches. The body between them, and whether it is between them
     * now. */
    sunder_i_corridor_wall wall[2];
    size_t walls;
    uint32_t between;
    bool still;
    bool failed; /* memory is out */
} sunder_i_branching;

/* Returns the work done; the next function returns whether the work, or the number of participants, exceeds its
 * limit. */
static inline uint64_t sunder_i_branching_work(const sunder_i_branching *c) { return c->looked + c->program.work; }

static inline bool sunder_i_branching_is_over(const sunder_i_branching *c)
{
    return sunder_i_branching_work(c) > c->subproblem->effort || c->bodies > c->subproblem->most;
}

/* Returns the longest move of a body; a substitute if it has no limit and the subproblem sets one. */
static inline double sunder_i_branching_limit(const sunder_i_branching *c, const sunder_i_body *body)
{
    const double limit = sunder_i_limit_of(body);
    return limit == INFINITY && c->subproblem->instead > 0 ? c->subproblem->instead : limit;
}

/* ---- participants.c ---------------------------------------------------------------------------------------------- */

/* Returns the place of a body among the participants; SUNDER_I_GROUND if it does not take part or cannot move. */
uint32_t sunder_i_branching_place(const sunder_i_branching *branching, uint32_t body);
/* Returns the place of a body, and adds it if necessary; SUNDER_I_GROUND if it cannot move. */
uint32_t sunder_i_branching_join(sunder_i_branching *branching, uint32_t body);
/* Returns the place of a slack; SUNDER_I_GROUND if it does not take part. The second function adds it if necessary. */
uint32_t sunder_i_branching_slack(const sunder_i_branching *branching, const sunder_i_requirement *required);
uint32_t sunder_i_branching_join_slack(sunder_i_branching *branching, const sunder_i_requirement *required);
/* Sets the candidate of the participants from place `first` on to its initial value: bodies at their original
 * positions, slacks at the translation that separated their pairs. */
void sunder_i_branching_begin(sunder_i_branching *branching, size_t first);
/* Adds the bodies of the reserve that could meet a participant. Returns false if there are none. */
bool sunder_i_branching_widen(sunder_i_branching *branching);
/* Returns the distance that the things f and g have to keep if they have no reduced requirement, with the gap reduced
 * by subproblem->less, rounded down. */
double sunder_i_branching_owed(const sunder_i_subproblem *subproblem, uint32_t f, uint32_t g);
/* Do the features f and g of two bodies have to keep a distance from each other? If so, sets *clearance to it. */
bool sunder_i_branching_owe(const sunder_i_branching *branching, uint32_t f, uint32_t g, double *clearance);
/* Do the rules on paths (jumps, sides) of feature f count in this subproblem? */
bool sunder_i_branching_is_path_heeded(const sunder_i_branching *branching, uint32_t f);
/* If the rules forbid jumps: is it forbidden in this subproblem that feature f jumps over g, a feature of another body?
 * Or: is it forbidden that f crosses the sides of g, a part of a barrier? */
bool sunder_i_branching_shades(const sunder_i_branching *branching, uint32_t f, uint32_t g);

/* ---- program.c --------------------------------------------------------------------------------------------------- */

typedef enum sunder_i_node_outcome {
    SUNDER_I_NODE_INFEASIBLE, /* the claims contradict the limits, proved by their forces */
    SUNDER_I_NODE_CANDIDATE,  /* t satisfies the claims, up to a hair */
    SUNDER_I_NODE_UNDECIDED   /* neither could be shown */
} sunder_i_node_outcome;

sunder_status sunder_i_branching_solve(sunder_i_branching *branching, sunder_i_node_outcome *outcome,
                                       sunder_error *err);
/* Does the last claim, alone or with another of the same pair, contradict the limits? If so, the forces prove it. */
bool sunder_i_branching_is_dead_end(sunder_i_branching *branching);

/* Is it proved, with all rounding, that the claims contradict the limits, by their present forces? */
bool sunder_i_branching_is_contradiction(sunder_i_branching *branching);

/* Do these n claims of one pair, at most three, contradict the limits? If so, the forces prove it. */
bool sunder_i_branching_contradict(sunder_i_branching *branching, const uint32_t *claim, size_t n);
/* Does claim p contradict, exactly, a claim of its pair with the opposite direction, or two others of its pair? If so,
 * the forces prove it. */
bool sunder_i_branching_is_shut(sunder_i_branching *branching, uint32_t p);

/* ---- violations.c ------------------------------------------------------------------------------------------------ */

/* Two convex pieces that are nearer in the candidate than they may be; or an anchor, and a piece that it passed. */
typedef struct sunder_i_violation {
    uint32_t p, q; /* bodies; p takes part, q may not yet */
    const sunder_i_body_piece *a, *b;
    double clearance, depth;
    const sunder_i_requirement *slack; /* NULL, or the pair's requirement: then a belongs to the feature and b to the
                                        * barrier */
    bool shadow;                       /* a or b is an anchor in the shadow of the other */
    bool known;                        /* it adds no participant: both take part already, or one of them never moves */
    bool closely;                      /* as in sunder_i_branching */
    bool held;                         /* it is a wall */
    bool row;                          /* it breaks the rule of rows; a and b are any pieces of the two */
    const sunder_i_chord *chord;       /* NULL, or the chord that replaces b */
} sunder_i_violation;

/* Finds the deepest violations of the candidate: at most one for each pair of bodies, and one for each feature that may
 * keep an overlap with a barrier. Those that add no participant come first, then deeper ones. Returns their number. */
size_t sunder_i_branching_violations(sunder_i_branching *branching, sunder_i_violation deepest[SUNDER_I_CHOICES]);
/* Frees a cache of half-planes, and sets *kept to NULL. */
void sunder_i_half_planes_forget(struct sunder_i_half_planes_kept **kept);
/* Computes the half-planes in which two pieces of bodies p and q are separated, in branching->scratch. at: NULL, or a
 * relative move for which they are made (half_planes.h). Returns their number. */
size_t sunder_i_branching_fill_half_planes(sunder_i_branching *branching, const sunder_i_body *p,
                                           const sunder_i_body_piece *a, const sunder_i_body *q,
                                           const sunder_i_body_piece *b, double clearance, bool shadow,
                                           const double *at);
/* Returns the half-planes in which two pieces of bodies p and q are separated, made for no particular relative move,
 * from a cache: *n of them, valid until the next call. Returns NULL if memory is out (branching->failed). */
const sunder_i_half_plane *sunder_i_branching_kept_half_planes(sunder_i_branching *branching, const sunder_i_body *p,
                                                               const sunder_i_body_piece *a, const sunder_i_body *q,
                                                               const sunder_i_body_piece *b, double clearance,
                                                               bool shadow, size_t *n);
/* Copies them into branching->scratch, and returns their number. */
size_t sunder_i_branching_take_half_planes(sunder_i_branching *branching, const sunder_i_body *p,
                                           const sunder_i_body_piece *a, const sunder_i_body *q,
                                           const sunder_i_body_piece *b, double clearance, bool shadow);
/* Returns the depth of relative move u behind all half-planes in branching->scratch, of which there are `half_planes`,
 * and sets `at` of each; -INFINITY if there are none. */
double sunder_i_branching_depth(const sunder_i_branching *branching, size_t half_planes, const double u[2]);
/* Computes the half-planes of a violation, nearest to the candidate first, or to subproblem->near if that is given, in
 * branching->scratch. Returns their number. */
size_t sunder_i_branching_half_planes(sunder_i_branching *branching, const sunder_i_violation *violation);

/* ---- branches.c -------------------------------------------------------------------------------------------------- */

/* Searches the branches below the present claims. *levels: the levels whose claims the proof needs; *root: its node. */
sunder_status sunder_i_branching_search(sunder_i_branching *branching, unsigned level, sunder_i_verdict *verdict,
                                        sunder_i_levels *levels, size_t *root, sunder_error *err);

/* The first function adds a leaf for the contradiction that the claims' forces prove, and sets *levels to the levels of
 * these claims. The second adds a node for a violation, with the half-planes in branching->scratch. The third appends
 * the claim of one of its cases. All return false if memory is out. */
bool sunder_i_branching_add_leaf(sunder_i_branching *branching, sunder_i_levels *levels, size_t *root);
bool sunder_i_branching_add_branch(sunder_i_branching *branching, const sunder_i_violation *violation,
                                   size_t half_planes, size_t *root);
bool sunder_i_branching_push(sunder_i_branching *branching, uint32_t i, uint32_t j, size_t node, size_t half_plane,
                             bool behind, unsigned level);

/* ---- row_half_planes.c ------------------------------------------------------------------------------------------- */

/* Does the relative move u of bodies p and q break the rule of rows, as far as the subproblem heeds it, by more than
 * twice a hair? If so, sets *violation. */
bool sunder_i_branching_misses_row(sunder_i_branching *branching, uint32_t p, uint32_t q, const double u[2],
                                   sunder_i_violation *violation);
/* Sets branching->scratch to the half-plane that the rule demands of these two. Returns 1; 0 if memory is out. */
size_t sunder_i_branching_row_half_plane(sunder_i_branching *branching, uint32_t p, uint32_t q);

/* ---- corner_chord.c ---------------------------------------------------------------------------------------------- */

/* Computes the half-planes past a chord whose first side belongs to body q, in branching->scratch. Returns their
 * number. */
size_t sunder_i_branching_chord_half_planes(sunder_i_branching *branching, const sunder_i_body *p,
                                            const sunder_i_body_piece *anchor, const sunder_i_body *q,
                                            const double chord[4]);
/* Looks for a chord across a corner that excludes the candidate's move of a body, which the half-planes of no side
 * exclude, and sets *violation to it. Returns false if there is none. */
bool sunder_i_branching_find_chord(sunder_i_branching *branching, sunder_i_violation *violation);

/* ---- corridor.c -------------------------------------------------------------------------------------------------- */

/* Looks for two opposite walls between which the doubles have no other place for the body than its original one. If
 * there are any, sets branching->wall, `walls` and `between`. */
sunder_status sunder_i_branching_find_corridor(sunder_i_branching *branching, uint32_t body, sunder_error *err);
/* Computes the half-planes of a wall in branching->scratch, the one beyond the wall's line first. Returns their number;
 * 0 unless exactly one of them has that line. */
size_t sunder_i_branching_wall_half_planes(sunder_i_branching *branching, const sunder_i_corridor_wall *wall);

/* ---- plane.c ----------------------------------------------------------------------------------------------------- */

/* The answer to a subproblem that concerns only one relative move. */
typedef struct sunder_i_plane_answer {
    sunder_i_verdict verdict; /* feasible only if no other thing that is asked about matters */
    double u[2];              /* if feasible or free: the move of q less that of p */
    uint32_t p, q;            /* bodies; q may be SUNDER_I_GROUND */
    bool free;                /* a place was found where nothing is forbidden */
    bool seam;                /* two lines left a line or a point, or the free place is on the border of something
                               * closed: lines without a rounding error may tell more */
    size_t root;
} sunder_i_plane_answer;

/* Decides a subproblem with one movable body among fixed things, or about the relative move of its two movable
 * bodies. */
sunder_status sunder_i_branching_plane(sunder_i_branching *branching, sunder_i_plane_answer *answer, sunder_error *err);
/* Tests only the n relative moves at[] in the same way. answer->free is set if one of them is forbidden by nothing, and
 * on the border of nothing closed; the verdict is then feasible if nothing else matters; otherwise it is unknown. */
sunder_status sunder_i_branching_plane_try(sunder_i_branching *branching, const double (*at)[2], size_t n,
                                           sunder_i_plane_answer *answer, sunder_error *err);
/* Sets *p and *q to the bodies whose relative move the subproblem concerns. Returns false if it concerns more. */
bool sunder_i_branching_plane_bodies(const sunder_i_branching *branching, uint32_t *p, uint32_t *q);

/* ---- precedents.c ------------------------------------------------------------------------------------------------ */

/* Returns the entry of bodies p and q, empty if there was none. The next function records u, a relative move that
 * nothing forbids, in an entry. */
sunder_i_precedent *sunder_i_precedents_take(sunder_i_precedents *precedents, uint32_t p, uint32_t q);
void sunder_i_precedent_note_place(sunder_i_precedent *precedent, const double u[2]);
/* Records the things that a proof uses, in place of those of an earlier proof; none if they are more than
 * SUNDER_I_PRECEDENT_THINGS. fine: coarse half-planes were not sufficient for it. Returns false if memory is out. */
bool sunder_i_precedent_note_proof(sunder_i_precedent *precedent, const sunder_i_model *model,
                                   const sunder_proof *proof, bool fine);
/* Sets `set` to the recorded things and the two in question, as far as the question `asked` includes them, and returns
 * their number: they may suffice for a proof. Returns 0 if none are recorded, or if the question includes no others. */
size_t sunder_i_precedent_things(const sunder_i_precedent *precedent, const sunder_i_subproblem *asked,
                                 uint32_t set[SUNDER_I_PRECEDENT_THINGS + 2]);

/* ---- proof_record.c ---------------------------------------------------------------------------------------------- */

/* Returns the part of the record below a node as a proof. Returns NULL if memory is out. */
sunder_proof *sunder_i_proof_of(const sunder_i_branching *branching, size_t root);

#endif
