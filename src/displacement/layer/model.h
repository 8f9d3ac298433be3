/* The layer as bodies that move: blocks, their convex pieces, pairs of one in another, pairs left in conflict, and
 * where each body stands. What is in doubles here is for the search, which decides nothing: what it finds is checked
 * exactly. */
#ifndef SUNDER_I_MODEL_H
#define SUNDER_I_MODEL_H

#include "displacement/layer/barrier_parts.h"
#include "displacement/layer/inclusion.h"
#include "displacement/layer/relaxation.h"
#include "displacement/layer/seamless.h"
#include "spatial/rtree.h"

#include "base/extremes.h"

#include <stdatomic.h>
#include <stdlib.h>

/* What few bodies have (extras.c). */
typedef struct sunder_i_extras {
    uint32_t wall, walls;   /* the edges of its members that keep others inside, in sunder_i_model.wall */
    uint32_t seam, seams;   /* pieces that cover what is between its pieces, in sunder_i_model.seam */
    uint32_t joint, joints; /* what covers the walls that its members share, in sunder_i_model.joint */
    uint32_t side, sides;   /* of a part of a barrier: its lines that may not be crossed, in sunder_i_model.side */
    double anchors[4];      /* the box of its members' anchors, where these are many (sunder_i_anchors()) */
} sunder_i_extras;

/* A body is what moves as one: a block, or a feature that stands alone. Bodies are numbered by their first members. */
typedef struct sunder_i_body {
    uint32_t member, members;   /* its features: members of them in sunder_i_model.member from there */
    uint32_t piece, pieces;     /* its convex pieces: how they are numbered among all, from that one on */
    double weight;              /* the sum of its members' */
    double limit;               /* the strictest of its members' */
    const sunder_i_extras *has; /* besides; never NULL */
    bool fixed;                 /* limit 0 counts too */
    bool held;                  /* fixed for now: its possible moves are coarse beside a neighbour's
                       * (solve/clusters/coarse_bodies.c) */
    bool has_seams;             /* they were looked for */
    bool pinned;                /* stays where it came from: rounding would make a pair of it stand worse (uphold.c) */
    bool far;                   /* it has corners out of all proportion (far_corners.c) */
    double reach;               /* for the search no corner is farther from the origin, along either axis */
    double origin[2];           /* its corners are stored relative to this */
    double box[4];              /* of its pieces, relative to the origin */
    double clear; /* the least of its members', in sunder_i_model.clear; INFINITY where jumps are allowed */
} sunder_i_body;

/* One convex piece of a body, counter-clockwise; a wall is one without area, of two corners. */
typedef struct sunder_i_body_piece {
    const double *corner; /* [2 * corners] relative to the body's origin, as is the box; of an anchor that is it */
    uint32_t corners, feature;
    double box[4];
} sunder_i_body_piece;

/* Pieces that share a box, besides their own boxes: a query among a body's hundreds of pieces skips the others by whole
 * runs. */
#define SUNDER_I_RUN 8u

/* The search's view of one body, made at its first use (body_pieces.c). In a large layer most bodies never need it.
 *
 *     piece    [pieces] convex; those of a feature in the order of its shape's
 *     anchor   [members] each as a piece of one corner, of none where there is none; NULL: jumps are allowed
 *     run      [4 * runs] boxes of those runs of SUNDER_I_RUN that belong to this body entirely: they begin at
 *              multiples of that, from first_run of it on
 *     outline  [members] their convex hulls, where they were needed */
typedef struct sunder_i_body_pieces {
    const sunder_i_body_piece *piece, *anchor;
    const double *run;
    uint32_t first_run;
    _Atomic(sunder_i_body_piece *) outline;
} sunder_i_body_pieces;

/* What covers a wall that two members of a block share, within the two. */
typedef struct sunder_i_joint {
    sunder_i_body_piece piece; /* its feature is the one, `other` the other */
    uint32_t other;
    double at[8], corner[8]; /* its four corners as they are, and from the body's origin */
} sunder_i_joint;

/* A line of a barrier that features may not cross. */
typedef struct sunder_i_side {
    sunder_i_body_piece piece; /* of two corners; its feature is the part of the barrier */
    const double *from, *to;   /* its ends; of a rational area the nearest doubles */
    double corner[4];          /* the same from the body's origin */
    const sunder_shape
        *area; /* which has it as the edge from that vertex, and lies on its left; NULL: it bounds none */
    uint32_t vertex;
} sunder_i_side;

/* A coordinate from the body's origin, along axis c. One that is farther than `reach` is drawn in. Proofs see corners
 * as given. */
static inline double sunder_i_from_origin(const sunder_i_body *body, double v, size_t c)
{
    return sunder_i_max(-body->reach, sunder_i_min(v - body->origin[c], body->reach));
}

/* May it move at all? */
static inline bool sunder_i_may_move(const sunder_i_body *body) { return !body->fixed && !body->pinned; }

/* How far the body may go. */
static inline double sunder_i_limit_of(const sunder_i_body *body) { return body->fixed ? 0 : body->limit; }

/* The box of the body, moved by t and grown by reach. */
static inline void sunder_i_body_box(const sunder_i_body *body, const double t[2], double reach, double box[4])
{
    for (size_t c = 0; c < 4; c++) box[c] = body->box[c] + body->origin[c & 1] + t[c & 1] + (c < 2 ? -reach : reach);
}

/* What a search on behalf of a body has read: `place` bounds the boxes that it queried, and `seen` bounds the whole
 * bodies found there, at their original places. */
typedef struct sunder_i_read {
    double place[4], seen[4];
} sunder_i_read;

/* Everything that the search looks at, in doubles. It decides nothing: what it finds is checked exactly afterwards. */
struct sunder_i_model {
    const sunder_layer *layer;
    sunder_i_rules rules;
    sunder_shape *disc; /* rules.disc */
    const sunder_i_barriers *barriers;
    size_t bodies;
    size_t features, things; /* features come first, then parts of barriers, which are fixed bodies each */
    size_t vertices;         /* of the features */
    uint32_t *body_of;       /* [things] */
    uint32_t *member;        /* [things] things by body */
    sunder_i_body *body;
    sunder_i_arena extras;                 /* what bodies have besides */
    _Atomic(sunder_i_body_pieces *) *made; /* [bodies] see sunder_i_pieces_of() */
    struct sunder_i_pieces_store *store;   /* where these are */
    /* Where jumps are not allowed; else NULL: */
    double *anchor_at;         /* [2 * features] the anchors as they are */
    double *clear;             /* [features] nothing of another body that does not hold the anchor is nearer to it */
    sunder_i_body_piece *seam; /* convex pieces of features about the diagonals between their pieces; seams.c */
    double *seam_corner;       /* [8 * seams] their four corners, from the bodies' origins */
    uint32_t *seam_diagonal;   /* [4 * seams] by which the corners as they are are found (sunder_i_seam_again()) */
    size_t seams;
    bool has_seams;        /* of all bodies */
    sunder_i_joint *joint; /* of the bodies that were asked for; joints.c */
    size_t joints;
    sunder_i_id_pair *held; /* a feature, and one of another body that holds its anchor; sorted */
    size_t held_n;
    /* Where barriers have sides; else NULL: */
    sunder_i_side *side;
    size_t sides;
    sunder_i_body_piece *side_anchor; /* [features] each side anchor as a piece of one corner */
    double *side_at;                  /* [2 * features] the side anchors as they are */
    double *side_anchors;             /* [4 * bodies] the box of its members' side anchors, relative to its origin */
    sunder_shape **whole;        /* [bodies] the union of a block's members, where wanted; NULL for what stands alone */
    uint32_t most_pieces;        /* that a body has */
    bool *present;               /* [things] */
    sunder_i_seamless *seamless; /* [features] where there are barriers without area; else NULL */
    sunder_i_rtree tree;         /* the boxes as they stood at the start; see sunder_i_reach_beyond() */
    sunder_i_read *read;         /* [bodies] (layer/reads.h); NULL: reads are not recorded */
    double *went;                /* [4 * bodies] the box of all moves that each ever had, likewise */
    const sunder_i_rtree *standing; /* positions as they are now: the placement's; lent */
    sunder_i_body_piece *wall;      /* edges of features that hold others; see inclusion.c */
    double *wall_corner;            /* [4 * walls] */
    size_t walls;
    sunder_i_inclusion *inclusion; /* pairs that may overlap, because one lies in the other; sorted */
    size_t inclusions;
    sunder_i_inclusion *nested; /* pairs in conflict where one lay in the other at the start; sorted */
    size_t nested_n;
    sunder_i_relaxations relaxations;
    sunder_i_id_pair *given_up; /* bodies given up: no solution was found that resolves this pair, too; sorted */
    size_t given_up_n;
    sunder_i_id_pair *shut_in; /* features, a < b, that nothing but a jump takes clear of each other: proved; sorted */
    size_t shut_in_n;
    sunder_i_id_pair *confined; /* bodies i < j for which that is proved, whichever of their members are in conflict;
                                 * sorted */
    size_t confined_n;
    double *move;   /* [2 * bodies] where each stands now, relative to the start */
    double *lifted; /* [2 * bodies] where each stood when limits were lifted; NULL: they were not, or still are */
    bool *inexact;  /* [things] the translate was rounded */
    /* For the trace: where the work is, in words of the tables of stages (solve_layer.c); NULL: before them. */
    const char *pass, *stage;
    int round; /* of the stage, from 1 on */
};

/* ---- Things ------------------------------------------------------------------------------------------------------ */

/* Is the thing a part of a barrier, which has no anchor and no outline? Is the body one? Of which barrier? */
static inline bool sunder_i_is_barrier(const sunder_i_model *model, uint32_t thing) { return thing >= model->features; }

static inline bool sunder_i_is_barrier_body(const sunder_i_model *model, const sunder_i_body *body)
{
    return sunder_i_is_barrier(model, model->member[body->member]);
}

static inline uint32_t sunder_i_barrier_of(const sunder_i_model *model, uint32_t part)
{
    return model->barriers->barrier[part - model->features];
}

/* The shape of a thing, as it is given. */
static inline const sunder_shape *sunder_i_thing_shape(const sunder_i_model *model, size_t thing)
{
    const sunder_layer *layer = model->layer;
    return thing < layer->n ? layer->given->shape[layer->number[thing]] : layer->part[thing - layer->n].shape;
}

/* The box of a thing as it stood at the start; of one that was not there no more than zeros. */
static inline const double *sunder_i_home_box(const sunder_i_model *model, uint32_t thing)
{
    return sunder_i_rtree_box(&model->tree, thing);
}

/* May some relative moves not be made, wherever that leads? */
static inline bool sunder_i_forbids_ways(const sunder_i_model *model) { return !model->rules.jumps || model->sides; }

/* The box of the side anchors of one of the model's bodies, where barriers have sides. */
static inline const double *sunder_i_side_anchors(const sunder_i_model *model, const sunder_i_body *body)
{
    return model->side_anchors + 4 * (size_t)(body - model->body);
}

/* A thing by which all parts of a barrier are known: their first; else the thing itself. */
static inline uint32_t sunder_i_whole_of(const sunder_i_model *model, uint32_t thing)
{
    if (!sunder_i_is_barrier(model, thing)) return thing;
    return (uint32_t)model->features + sunder_i_first_part(model->barriers, thing - (uint32_t)model->features);
}

/* What the two owe each other, rounded down and up; of two features both are the gap. */
static inline double sunder_i_owed_below(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const uint32_t part = f > g ? f : g;
    if (!sunder_i_is_barrier(model, part)) return model->rules.gap;
    return sunder_i_required_below(model->barriers, sunder_i_barrier_of(model, part));
}

static inline double sunder_i_owed_above(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const uint32_t part = f > g ? f : g;
    if (!sunder_i_is_barrier(model, part)) return model->rules.gap;
    return sunder_i_required_above(model->barriers, sunder_i_barrier_of(model, part));
}

/* Do they owe each other the layer's gap? A barrier may have one of its own. */
static inline bool sunder_i_owe_gap(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const uint32_t part = f > g ? f : g;
    return !sunder_i_is_barrier(model, part) || model->layer->barrier[sunder_i_barrier_of(model, part)].gap < 0;
}

/* The distance owed to a thing beyond the gap. All boxes of barriers, of bodies and pieces too, are grown by it: so a
 * query with the gap finds everything to which a distance is owed. */
static inline double sunder_i_reach_beyond(const sunder_i_model *model, uint32_t thing)
{
    return sunder_i_max(0, sunder_i_owed_above(model, thing, thing) - model->rules.gap);
}

/* Are these two features, f < g, known to be shut in? */
static inline bool sunder_i_are_shut_in(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const sunder_i_id_pair pair = {f, g};
    return model->shut_in_n && bsearch(&pair, model->shut_in, model->shut_in_n, sizeof pair, sunder_i_by_id_pair);
}

/* The same for two bodies. */
static inline bool sunder_i_are_confined(const sunder_i_model *model, uint32_t i, uint32_t j)
{
    const sunder_i_id_pair pair = {i < j ? i : j, i < j ? j : i};
    return model->confined_n && bsearch(&pair, model->confined, model->confined_n, sizeof pair, sunder_i_by_id_pair);
}

/* ---- model.c ----------------------------------------------------------------------------------------------------- */

/* The boxes of the layer's features, behind which stand parts of barriers (layer.h), and the tree over them as they
 * were. On failure the model can be given to sunder_i_model_free() all the same. */
sunder_status sunder_i_model_init(const sunder_layer *layer, const sunder_i_barriers *barriers,
                                  const sunder_i_rules *rules, sunder_i_model *model, sunder_error *err);
/* A feature at its original place. */
sunder_i_translate sunder_i_at_home(const sunder_i_model *model, uint32_t feature);
/* Joins what the rules join. */
sunder_status sunder_i_model_join(sunder_i_model *model, const sunder_i_relations *relations, sunder_error *err);
void sunder_i_model_free(sunder_i_model *model);

/* ---- bodies.c ---------------------------------------------------------------------------------------------------- */

/* The numbers of the convex pieces, and the bodies' boxes. */
sunder_status sunder_i_model_cut(sunder_i_model *model, sunder_error *err);
/* The body that has the piece with this number. */
uint32_t sunder_i_body_of_piece(const sunder_i_model *model, uint32_t piece);
/* A relative move of two bodies that is longer leaves them apart by more than the gap. */
double sunder_i_farthest_near(const sunder_i_model *model, uint32_t p, uint32_t q);
/* Unites the members of these bodies, those that are blocks and have not been. */
sunder_status sunder_i_model_unite(sunder_i_model *model, const uint32_t *body, size_t n, sunder_error *err);
/* Returns the shape of a body: that of its only member, or the union of all. NULL if they were not united or are
 * empty. */
const sunder_shape *sunder_i_model_shape(const sunder_i_model *model, uint32_t body);
/* A lower bound of the weight of a body. */
double sunder_i_weight_below(const sunder_i_model *model, const sunder_i_body *body);

/* ---- extras.c ---------------------------------------------------------------------------------------------------- */

/* What a body without any of it has. */
extern const sunder_i_extras sunder_i_no_extras;
/* A body's own, to be written to; NULL if memory is out. */
sunder_i_extras *sunder_i_own_extras(sunder_i_model *model, sunder_i_body *body);
/* The box of the anchors of a body's members, from its origin; where jumps are not allowed. */
void sunder_i_anchors(const sunder_i_model *model, const sunder_i_body *body, double box[4]);
/* Sees to it that sunder_i_anchors() has little to do for this body, once the anchors are known. False if memory is
 * out. */
bool sunder_i_keep_anchors(sunder_i_model *model, sunder_i_body *body);

/* ---- body_pieces.c ----------------------------------------------------------------------------------------------- */

/* Makes them for sunder_i_pieces_of(). */
const sunder_i_body_pieces *sunder_i_pieces_make(const sunder_i_model *model, const sunder_i_body *body);
/* The pieces of a body, after all are cut and anchored; they stay until they are forgotten. NULL if memory is out. Any
 * number of threads may ask at a time. */
static inline const sunder_i_body_pieces *sunder_i_pieces_of(const sunder_i_model *model, const sunder_i_body *body)
{
    const sunder_i_body_pieces *made = atomic_load_explicit(&model->made[body - model->body], memory_order_acquire);
    return made ? made : sunder_i_pieces_make(model, body);
}
/* The same of the outlines of its members, one of each, for where their pieces are too many: convex hulls. */
const sunder_i_body_piece *sunder_i_outlines_of(const sunder_i_model *model, const sunder_i_body *body);
/* The outline of a thing that is there from its body's origin, how many corners; out: room for one more than its shape
 * has, point: scratch for all of these. */
size_t sunder_i_outline_of(const sunder_i_model *model, uint32_t thing, double *point, double *out);
/* None are made yet, of bodies that are known. False if memory is out: sunder_i_pieces_end() frees what is there. */
bool sunder_i_pieces_begin(sunder_i_model *model);
void sunder_i_pieces_end(sunder_i_model *model);
/* Frees all pieces if they take more than `most` bytes; they are made again when needed. It is called when no code
 * refers to pieces: between two stages or two questions. */
void sunder_i_pieces_forget(sunder_i_model *model, size_t most);
/* Less is not worth forgetting. */
#define SUNDER_I_PIECES_HELD ((size_t)4 << 20)
/* How many corners a piece, an anchor or a side had as given; the search may look at one more or at fewer, where some
 * are far (far_corners.h). */
size_t sunder_i_corners_as_given(const sunder_i_model *model, const sunder_i_body_piece *piece);
/* Where they stood in the layer; of repaired shapes the nearest doubles. out: room for all of them. */
void sunder_i_piece_as_given(const sunder_i_model *model, const sunder_i_body_piece *piece, double *out);
/* The convex hull of n points, counter-clockwise, in out (room for n + 1), in doubles. The points are sorted. */
size_t sunder_i_convex_hull(double *point, size_t n, double *out);

/* ---- anchors.c --------------------------------------------------------------------------------------------------- */

/* The anchors, where they matter, and the side anchors (sides.h); after the pieces are cut. */
sunder_status sunder_i_model_anchor(sunder_i_model *model, sunder_error *err);
/* Does g, of another body, hold the anchor of f? Then f may leave it. */
bool sunder_i_is_held(const sunder_i_model *model, uint32_t f, uint32_t g);

/* ---- seams.c ----------------------------------------------------------------------------------------------------- */

/* Is there a barrier without area that owes nothing, so that it could hide on a diagonal? */
bool sunder_i_has_bare_barriers(const sunder_i_model *model);
/* Makes all missing seams, of all bodies or of the n bodies in `body`. The pieces must have been cut. Proofs need
 * seams, the search does not. Pointers to seams become invalid. */
sunder_status sunder_i_model_find_seams(sunder_i_model *model, sunder_error *err);
sunder_status sunder_i_model_find_seams_of(sunder_i_model *model, const uint32_t *body, size_t n, sunder_error *err);

/* ---- joints.c ---------------------------------------------------------------------------------------------------- */

/* The joints of these bodies, ascending; once. Pointers to joints are void then. */
sunder_status sunder_i_model_find_joints(sunder_i_model *model, const uint32_t *body, size_t n, sunder_error *err);

/* ---- within_limit.c ---------------------------------------------------------------------------------------------- */

/* |t| <= limit? Exact. limit may be infinite. */
bool sunder_i_is_within_limit(const double t[2], double limit);

#endif
