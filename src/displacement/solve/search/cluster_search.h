/* The state of the search for the moves of one cluster, which its stages share. All numbers are doubles; see
 * ../../README.md. */
#ifndef SUNDER_I_CLUSTER_SEARCH_H
#define SUNDER_I_CLUSTER_SEARCH_H

#include "displacement/geometry/free_places.h"
#include "displacement/geometry/grown_cache.h"
#include "displacement/geometry/obstacle_cache.h"
#include "displacement/geometry/obstacle_shadow.h"
#include "displacement/layer/inclusion.h"
#include "displacement/layer/prices.h"
#include "displacement/quadratic/quadratic.h"
#include "displacement/solve/search/cluster.h"
#include "displacement/solve/search/measures.h"

/* Two bodies, by their indices in the search, that are nearer to each other than they may be. */
typedef struct sunder_i_clash {
    uint32_t i, j;
    double violation; /* the shortfall of their distance */
} sunder_i_clash;

/* What a pair that is left in conflict still lacks (missing.c): body i from the others, which are one body, or the
 * parts of one barrier. */
typedef struct sunder_i_shortfall {
    uint32_t i, other, others; /* indices in the search: i may move, and search->creditor[other ...] */
    sunder_i_price price;
    double at[2], from[2];    /* if `known`: the moves of i and of the others for which the rest was computed */
    double place[2], missing; /* the move of i at the end of the way that it lacks; INFINITY: none was found */
    bool known;
} sunder_i_shortfall;

/* A member of a barrier or of a body, and a member of a body that may move, and what they lack. */
typedef struct sunder_i_member_pair {
    uint32_t a, b;              /* features; a barrier counts as a whole */
    double owed, missing, n[2]; /* n: the direction in which b lacks that */
    bool overlaps;
} sunder_i_member_pair;

/* Two bodies that keep their distance, or a body and the parts of one barrier, and their full distance, to first order:
 * n.(t_j - t_i) >= d. */
typedef struct sunder_i_short_pair {
    uint32_t i, j, whole; /* indices in the search: i may move; whole: the thing that stands for j or its barrier */
    double missing;       /* of the full distance; negative: this is to spare */
    double n[2], d;
} sunder_i_short_pair;

typedef struct sunder_i_search {
    const sunder_i_model *model;
    const uint32_t *body;       /* [n] the bodies; the first `own` may move, unless fixed */
    size_t n, own;              /* bodies ascend below index `own`, and again from there on */
    uint32_t *listed;           /* the array of `body`, if the search owns it */
    double gap;                 /* the gap plus the margin */
    double tolerance;           /* a smaller violation counts as none: a quarter of the margin, unless set otherwise */
    bool roughly;               /* larger violations are tolerated for now, and are repaired later */
    double *mass;               /* [n] 1 / (2 weight); 0: the body does not move */
    double *place;              /* [2 n] origins of the bodies of a large crowd; otherwise NULL */
    bool *away;                 /* [n] ignored while room is looked for */
    double *preferred;          /* [2 n] the moves that cost nothing; 0 for bodies that do not move */
    double *t;                  /* [2 n] the present moves */
    double *box;                /* [4 n] boxes at the present moves, relative to the first body's origin */
    uint32_t *order;            /* [n] for sweeps over boxes */
    sunder_i_quadratic program; /* its constraints are kept sorted by key */
    double *next;               /* [2 n] solution of the program */
    bool ended;                 /* the solution violates nothing that the program does not know; then: */
    double seen;                /* the greatest violation at the solution ... */
    uint64_t seen_steps;        /* ... and the steps that it took to find it */
    uint32_t tangents;          /* tangents of limits added so far; the number identifies a tangent */
    sunder_i_constraint *old;   /* [old_n] constraints of the previous round, whose forces new ones start from */
    size_t old_n, old_capacity;
    sunder_i_clash *clash; /* [clashes] found by the last call of sunder_i_search_find_clashes() */
    size_t clashes, clash_capacity;
    sunder_i_relaxations relaxations; /* of pairs that this search gave up; they precede those of the model */
    sunder_i_restored *restored;      /* [restored_n] relaxations of the model that do not count here; sorted */
    size_t restored_n, restored_capacity;
    sunder_i_shortfall *shortfall; /* [shortfalls] of the pairs that are eased; none unless sunder_i_search_ease() */
    size_t shortfalls, shortfall_capacity;
    sunder_i_list creditor;       /* the other bodies of these pairs */
    bool to_solved;               /* they lack the way to the nearest place at which they are solved */
    sunder_i_member_pair *member; /* [members] scratch: the members of one such pair */
    size_t members, member_capacity;
    sunder_i_short_pair *tight; /* [tights] pairs that stand nearer than their full distance, as they were found last */
    size_t tights, tight_capacity;
    bool fully;                                   /* what pairs lack is measured by their full distances */
    bool prices_tight;                            /* such pairs have a price (tight_pairs.c) */
    double cap;                                   /* an upper bound of all moves, besides limits; INFINITY: none */
    struct sunder_i_neighbourhood *neighbourhood; /* changes are tried with these bodies alone; NULL: with all; lent */
    sunder_i_rtree visited;   /* boxes of the paths from home, of a large cluster (visited_boxes.c) */
    double *visited_at;       /* [2 n] the moves at which `visited` was computed; NULL: it was not yet */
    double least_passing;     /* a body that passed another has moved farther than this plus the gap (shadows.c) */
    bool least_passing_known; /* it was computed */
    sunder_i_list about;      /* indices found by sunder_i_search_find_about() */
    sunder_i_scratch scratch;
    sunder_i_obstacles obstacles;    /* obstacles of the body for which room is looked for */
    sunder_i_grown_cache grown;      /* grown obstacles of pairs of pieces */
    sunder_i_obstacle_cache cache;   /* obstacles of pairs of pieces */
    sunder_i_measures measures;      /* violations of pairs of bodies */
    sunder_i_obstacle_edge *shifted; /* scratch: edges of an obstacle that no cache keeps */
    size_t shifted_capacity;
    double extent;           /* the mean size of the bodies that may move */
    double settled;          /* a round that gains a smaller share of the cost is the last one */
    uint64_t steps, effort;  /* constraints examined so far; the work at which the search for better sides ends */
    uint64_t patience;       /* a descent gives up when the work reaches this ... */
    const double *back;      /* ... or when a program ends at these moves, [2 n]; NULL: no such test ... */
    double hope;             /* ... or when its expected final cost exceeds this; INFINITY: no such test */
    const double *lead;      /* [2 n] moves at which the sides of free pairs are chosen; NULL: at the present moves */
    sunder_i_trace_log *log; /* what its stages did; NULL: the layer is not traced; lent */
    bool failed;             /* memory is out */
} sunder_i_search;

/* Begins a search for n bodies at the given moves, [2 n], which are copied. On failure the caller frees it, too. */
bool sunder_i_search_init(sunder_i_search *search, const sunder_i_model *model, const uint32_t *body, size_t n,
                          double margin, const double *move);
void sunder_i_search_free(sunder_i_search *search);
/* The checker, for builds that assert: bodies ascend, moves are numbers, restored pairs are sorted. Returns NULL, or
 * what does not hold. */
const char *sunder_i_search_check(const sunder_i_search *search);
/* The work done so far, in constraints examined. */
static inline uint64_t sunder_i_search_work(const sunder_i_search *s) { return s->steps + s->program.work; }
/* The limit of body i's move. */
double sunder_i_search_limit(const sunder_i_search *search, uint32_t i);
/* The distance between the present move of body k and the move that it prefers. */
double sunder_i_search_stray(const sunder_i_search *search, size_t k);
/* The square of the distance between the move of body k in t and the move that it prefers. */
double sunder_i_search_stray_square(const sunder_i_search *search, size_t k, const double *t);
/* By how much body i exceeds its limit at t; 0 if it exceeds it by at most the slack that limits.c defines. */
double sunder_i_search_excess(const sunder_i_search *search, uint32_t i, const double *t);
/* The number of movable bodies. */
size_t sunder_i_search_movers(const sunder_i_search *search);
/* The index in the search of a body of the model, or SUNDER_I_NOBODY. */
uint32_t sunder_i_search_place_of(const sunder_i_search *search, uint32_t body);
/* The box of body k's straight path from home to t, relative to the first body's origin, so that the layer's position
 * does not matter. */
void sunder_i_search_path_box(const sunder_i_search *search, const double *t, uint32_t k, double box[4]);
/* Returns a copy of the present moves; NULL if memory is out (search->failed), or was before. */
double *sunder_i_search_copy_moves(sunder_i_search *search);
/* Frees the copy (or NULL); back: the present moves become those of the copy again. */
void sunder_i_search_end_copy(sunder_i_search *search, double *copy, bool back);

/* A body of the search and a neighbour in a row, one of which may move. j: SUNDER_I_GROUND, if the neighbour is not in
 * the search and keeps its present move. */
typedef struct sunder_i_row_link {
    uint32_t i, j;
    const double *still;           /* that move */
    const sunder_i_row_side *side; /* from i to j */
} sunder_i_row_link;

/* An iteration over these, each once; zeroed at first. Returns false at the end. */
typedef struct sunder_i_row_walk {
    uint32_t i, k;
} sunder_i_row_walk;

bool sunder_i_search_next_row(const sunder_i_search *search, sunder_i_row_walk *walk, sunder_i_row_link *link);

/* ---- surroundings.c ---------------------------------------------------------------------------------------------- */

/* Begins a search for the bodies of a cluster at the given moves, and the bodies around it, which do not move. On
 * failure the caller frees it, too. */
bool sunder_i_search_init_about(sunder_i_search *search, const sunder_i_model *model, const sunder_i_cluster *cluster,
                                const double *move);

/* ---- near.c: neighbours ------------------------------------------------------------------------------------------ */

/* Receives a pair of bodies i < j, at least one of which is movable. sunder_i_search_visit_near() calls it for the
 * pairs whose boxes at the moves t are within `reach` of each other. */
typedef void (*sunder_i_visit_pair)(sunder_i_search *search, uint32_t i, uint32_t j, void *context);

void sunder_i_search_visit_near(sunder_i_search *search, const double *t, double reach, sunder_i_visit_pair visit,
                                void *context);
/* As sunder_i_search_visit_near(), at the present moves, with the box of a movable body's whole path from its original
 * place instead of its box. */
void sunder_i_search_visit_near_or_home(sunder_i_search *search, double reach, sunder_i_visit_pair visit,
                                        void *context);

/* ---- shortfall.c: what pairs left in conflict lack --------------------------------------------------------------- */

/* From now on pairs that are left in conflict are eased: the cost includes the price of what they lack, and programs
 * have a constraint for each. False if memory is out. */
bool sunder_i_search_ease(sunder_i_search *search);
/* Does what sunder_i_search_ease() does, for the pairs that the search itself relaxed in place of those that the model
 * relaxes. */
bool sunder_i_search_ease_own(sunder_i_search *search);
/* Does the cost of a layout include prices? */
static inline bool sunder_i_search_has_prices(const sunder_i_search *search)
{
    return search->shortfalls > 0 || search->prices_tight;
}
/* The price of what pairs lack at the moves t; 0 if no pairs are eased. */
double sunder_i_search_shortfall_price(sunder_i_search *search, const double *t);
/* Adds a priced constraint to the program for each pair that lacks something at the present moves. */
void sunder_i_search_constrain_shortfalls(sunder_i_search *search);

/* ---- layout_cost.c ----------------------------------------------------------------------------------------------- */

/* The cost of the moves t: the sum of weight times squared distance from the preferred move, of the springs of rows,
 * and of the prices of pairs that are eased or tight. */
double sunder_i_search_cost(sunder_i_search *search, const double *t);

/* ---- visited_boxes.c: where bodies have been --------------------------------------------------------------------- */

/* Stores in search->about, ascending, the indices of all bodies that body i could meet or pass anywhere within `reach`
 * of its original place; and perhaps of others. False if memory is out. */
bool sunder_i_search_find_about(sunder_i_search *search, uint32_t i, double reach);

/* ---- piece_pairs.c: what two bodies owe each other, piece by piece ----------------------------------------------- */

/* The distance that two pieces without a relaxation have to keep: the gap, or the one from a barrier, plus the
 * margin. */
double sunder_i_search_owed(const sunder_i_search *search, const sunder_i_body_piece *a, const sunder_i_body_piece *b);
/* Is there a relaxation between bodies `body` and `other` of the model? *reach is an upper bound of its shifts; 0 if
 * there is none. */
bool sunder_i_search_is_relaxed(const sunder_i_search *search, uint32_t body, uint32_t other, double *reach);

/* Two convex pieces, one each of bodies i and j; or a wall of one body and a piece of the other body, which the wall
 * keeps inside. */
typedef struct sunder_i_piece_pair {
    const sunder_i_body_piece *a, *b;   /* of i, of j */
    double offset[2];                   /* the origin of j minus that of i */
    uint64_t key;                       /* identifies the pair */
    sunder_i_inclusion_state inclusion; /* of a wall; SUNDER_I_LAPSED: the two are pieces, which keep their distance */
    bool relaxed;                       /* relaxations between the two bodies count */
    bool shadow;                        /* one of the two is an anchor, which may not pass the other; or: */
    const sunder_i_row_side *row;       /* the rule of rows, a shadow that is a half-plane; a and b are NULL then */
    const sunder_i_relaxation *relaxation; /* the relaxation of the two pieces; or NULL */
} sunder_i_piece_pair;

/* The support line of the pair's obstacle, or shadow, given by its n edges: the one whose signed distance from u is
 * greatest. */
static inline sunder_i_support sunder_i_search_support(const sunder_i_piece_pair *pair,
                                                       const sunder_i_obstacle_edge *edge, size_t n, const double u[2])
{
    return pair->shadow ? sunder_i_shadow_support_at(edge, n, u) : sunder_i_support_at(edge, n, u);
}

typedef void (*sunder_i_visit_piece_pair)(sunder_i_search *search, const sunder_i_piece_pair *pair, void *context);

/* Visits all pairs of pieces of bodies i and j whose boxes are within `reach` of each other at relative position u, the
 * walls that keep one of the bodies inside the other, and shadows. Shadows are looked for within a shorter distance,
 * since they are seldom in the way. yields: relaxations count. */
void sunder_i_search_piece_pairs(sunder_i_search *search, uint32_t i, uint32_t j, const double u[2], double reach,
                                 bool yields, sunder_i_visit_piece_pair visit, void *context);
/* Visits the walls of body `holder` with the pieces of body `other` that they keep inside and whose boxes are within
 * `reach`. v: position of `other` relative to `holder`. The caller sets pair->offset and pair->relaxed. swapped:
 * `holder` is body j of the pair. */
void sunder_i_search_walls(sunder_i_search *search, const sunder_i_body *holder, const sunder_i_body *other,
                           const double v[2], double reach, sunder_i_piece_pair *pair, bool swapped,
                           sunder_i_visit_piece_pair visit, void *context);
/* The relaxation of pieces a and b; NULL: there is none, and they keep the full distance. */
const sunder_i_relaxation *sunder_i_search_relaxation(const sunder_i_search *search, const sunder_i_body_piece *a,
                                                      const sunder_i_body_piece *b);
/* Shifts the n corners of an obstacle by the relaxation of its two pieces; of_j is the feature of the second piece.
 * Returns the distance that the relaxation demands. */
double sunder_i_search_shift(const sunder_i_relaxation *relaxation, uint32_t of_j, double *corner, size_t n);
/* Computes the pair's obstacle A + (-B), shifted by its relaxation, in search->scratch. Returns the number of its
 * corners (0: memory is out); *gap is the distance demanded. */
size_t sunder_i_search_obstacle(sunder_i_search *search, const sunder_i_piece_pair *pair, double *gap);
/* Returns whether the pair has a relaxation that it exceeds by more than `distance` at the relative position u, as far
 * as the boxes of its two pieces tell. Most pieces of two large blocks do, and the obstacles of relaxed pairs, which no
 * cache keeps, took a third of the time of a town beside its roads. If so, the steps of sunder_i_search_edges() are
 * counted, so that whether this is asked changes no budget. */
bool sunder_i_search_is_clear(sunder_i_search *search, const sunder_i_piece_pair *pair, const double u[2],
                              double distance);
/* The obstacle of the pair as *n edges, which are valid until the next call; for a shadow as in obstacle_shadow.h. *gap
 * is the distance demanded. NULL if memory is out (search->failed), or if there is no shadow. */
const sunder_i_obstacle_edge *sunder_i_search_edges(sunder_i_search *search, const sunder_i_piece_pair *pair, size_t *n,
                                                    double *gap);

/* The violation of pair (i, j) at relative position u. If the full distance is violated and the pair is relaxed,
 * *yields is set and the result is the violation of the relaxation. */
double sunder_i_search_pair(sunder_i_search *search, uint32_t i, uint32_t j, const double u[2], bool *yields);

/* ---- tight_pairs.c: pairs between the distance that they have to keep and the full one --------------------------- */

/* The price of what such pairs lack of their full distance at the moves t; 0 unless search->prices_tight. */
double sunder_i_search_tight_price(sunder_i_search *search, const double *t);
/* Adds a priced constraint to the program for each pair that is within `reach` of its full distance at the present
 * moves, unless it is left in conflict. */
void sunder_i_search_constrain_tight(sunder_i_search *search, double reach);
/* Is it the key of such a constraint? If so, sets *i and *j to the indices of its bodies. */
bool sunder_i_search_is_tight_key(uint64_t key, uint32_t *i, uint32_t *j);
/* The full gap, if search->fully; else the gap. With the margin. */
static inline double sunder_i_search_full_gap(const sunder_i_search *search)
{
    return search->fully ? search->gap + (search->model->rules.full_gap - search->model->rules.gap) : search->gap;
}

/* ---- missing.c: what a pair lacks -------------------------------------------------------------------------------- */

/* Sets `missing` of the pair (i, j) to what j, with the move u relative to i, lacks of its full distance, or of the
 * rule of rows with the full gap; negative: it stands farther. Then n.u >= d says that it lacks nothing. `missing` is
 * -reach, and n and d are not set, if the two stand farther than that. */
void sunder_i_search_measure_pair(sunder_i_search *search, const double u[2], double reach, sunder_i_short_pair *pair);
/* Sets the other members of a shortfall, whose pair is given, for the moves t, unless it was measured at these. */
void sunder_i_search_measure_shortfall(sunder_i_search *search, sunder_i_shortfall *shortfall, const double *t);

/* ---- shadows.c: which bodies may not pass which ------------------------------------------------------------------ */

/* Visits all shadows of two bodies of the model that may lie within reach of relative position u. The inline function
 * answers for most pairs: they move by less than the room about their anchors. */
void sunder_i_search_visit_shadows(sunder_i_search *search, const sunder_i_body *p, const sunder_i_body *q,
                                   const double u[2], double reach, sunder_i_visit_piece_pair visit, void *context);
static inline void sunder_i_search_body_shadows(sunder_i_search *search, const sunder_i_body *p, const sunder_i_body *q,
                                                const double u[2], double reach, sunder_i_visit_piece_pair visit,
                                                void *context)
{
    const double far = (u[0] < 0 ? -u[0] : u[0]) + (u[1] < 0 ? -u[1] : u[1]) + reach;
    if (p->clear > far && q->clear > far && p->has->sides + q->has->sides == 0) return;
    sunder_i_search_visit_shadows(search, p, q, u, reach, visit, context);
}
/* Visits the half-plane that the rule of rows forbids to bodies p and q of the model, if there is one. relaxed: the
 * pair remains in conflict. */
void sunder_i_search_visit_row(sunder_i_search *search, const sunder_i_body *p, const sunder_i_body *q, bool relaxed,
                               sunder_i_visit_piece_pair visit, void *context);
/* Visits each pair of bodies, one of them movable, that is farther apart than `reach` at the moves t, but may have
 * passed each other on the way from home to t, or be within `reach` of a shadow. */
void sunder_i_search_visit_passing(sunder_i_search *search, const double *t, double reach, sunder_i_visit_pair visit,
                                   void *context);
/* May bodies i and j have passed each other on the way from home to t, or be within `reach` of a shadow of one
 * another? */
bool sunder_i_search_may_pass(const sunder_i_search *search, const double *t, uint32_t i, uint32_t j, double reach);

/* ---- clashes.c: clashes, and by how much ------------------------------------------------------------------------- */

/* Stores in search->clash the pairs that violate their distance or relaxation at t. Returns the greatest violation,
 * including violated limits. */
double sunder_i_search_find_clashes(sunder_i_search *search, const double *t);
/* Body i has moved since the clashes at t were found: replaces its clashes by the present ones. */
void sunder_i_search_update_clashes(sunder_i_search *search, const double *t, uint32_t i);
/* Appends pair (i, j) to search->clash if it clashes at t. */
void sunder_i_search_add_clash(sunder_i_search *search, const double *t, uint32_t i, uint32_t j);

#endif
