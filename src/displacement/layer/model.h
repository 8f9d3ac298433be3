/* The layer as bodies that move: blocks, their convex pieces, inclusions, pairs left in conflict, and the present
 * position of each body. Data in doubles is for the search, whose results are always verified exactly. */
#ifndef SUNDER_I_MODEL_H
#define SUNDER_I_MODEL_H

#include "displacement/layer/barrier_parts.h"
#include "displacement/layer/inclusion.h"
#include "displacement/layer/interior_cover.h"
#include "displacement/layer/relaxation.h"
#include "spatial/rtree.h"

#include "base/extremes.h"

#include <stdatomic.h>
#include <stdlib.h>

/* Data that only few bodies have (extras.c). */
typedef struct sunder_i_extras {
    uint32_t wall, walls; /* the edges of its members that hold other features inside, in sunder_i_model.wall */
    uint32_t diagonal_cover,
        diagonal_covers; /* pieces that cover the diagonals between its convex pieces, in the arrays diagonal_cover_...
                          * of sunder_i_model */
    uint32_t wall_cover, wall_covers; /* pieces that cover the walls that its members share, in the array wall_cover of
                                       * sunder_i_model */
    uint32_t side, sides;             /* if the body is a part of a barrier: the lines of it that may not be crossed, in
                             * sunder_i_model.side */
    uint32_t row_side, row_sides;     /* its neighbours in rows, in sunder_i_model.row_side */
    double anchors[4];                /* if it has many members: the box of their anchors (sunder_i_anchors()) */
} sunder_i_extras;

/* A body is a block, or a feature in no block, or a part of a barrier; its members move together. Bodies are numbered
 * in the order of their first members. */
typedef struct sunder_i_body {
    uint32_t member, members;   /* its features: `members` entries of sunder_i_model.member, from index `member` on */
    uint32_t piece, pieces;     /* its convex pieces have the numbers from `piece` on, among the pieces of all bodies */
    double weight;              /* the sum of its members' weights */
    double limit;               /* the least of its members' limits */
    const sunder_i_extras *has; /* data that only few bodies have; never NULL */
    bool fixed;                 /* it never moves; so too if its limit is 0 */
    bool held;                  /* it does not move for now, as its exact moves are coarser than those of a neighbour
                                 * (solve/clusters/coarse_bodies.c) */
    bool has_diagonal_covers;   /* the covers of its diagonals have been made */
    bool pinned;                /* it stays at its original position, as rounding its move would make a pair worse than
                                 * at the start (uphold.c) */
    bool far;                   /* it has far corners, out of proportion to the rest of it (far_corners.c) */
    double reach;               /* the search moves corners farther from the origin than this, along either axis, to
                                 * this distance */
    double origin[2];           /* the point that its corners are stored relative to */
    double box[4];              /* the box of its pieces, relative to the origin */
    double clear; /* the least of its members' entries in sunder_i_model.clear; INFINITY if jumps are allowed */
} sunder_i_body;

/* One convex piece of a body, counter-clockwise. A wall is a piece of two corners, without area; an anchor is one of
 * one corner. */
typedef struct sunder_i_body_piece {
    const double *corner; /* [2 * corners] relative to the body's origin, as the box is; an anchor's points to its
                           * box */
    uint32_t corners, feature;
    double box[4];
} sunder_i_body_piece;

/* The number of consecutive pieces that share a box, in addition to their own boxes. A query among hundreds of pieces
 * of a body skips whole runs whose boxes are out of reach. */
#define SUNDER_I_RUN 8u

/* The pieces of one body for the search, made at their first use (body_pieces.c); in a large layer most bodies never
 * need them.
 *
 *     piece    [pieces] convex; those of one feature are in the order of its shape's pieces
 *     anchor   [members] each as a piece of one corner, or of none if there is no anchor; NULL: jumps are allowed
 *     run      [4 * runs] the boxes of those runs of SUNDER_I_RUN pieces that lie entirely in this body. Runs begin at
 *              numbers that are multiples of SUNDER_I_RUN; first_run is the first such number, divided by SUNDER_I_RUN
 *     outline  [members] the convex hulls of the members; NULL until they are needed */
typedef struct sunder_i_body_pieces {
    const sunder_i_body_piece *piece, *anchor;
    const double *run;
    uint32_t first_run;
    _Atomic(sunder_i_body_piece *) outline;
} sunder_i_body_pieces;

/* A convex piece, within two members of a block, that covers a wall that they share. */
typedef struct sunder_i_wall_cover {
    sunder_i_body_piece piece; /* its feature is one of the two members */
    uint32_t other;
    double at[8], corner[8]; /* its four corners in coordinates of the layer, and relative to the body's origin */
} sunder_i_wall_cover;

/* A line of a barrier that features may not cross. */
typedef struct sunder_i_side {
    sunder_i_body_piece piece; /* a piece of two corners; its feature is the part of the barrier */
    const double *from, *to;   /* its ends; those of an area with rational corners are rounded to doubles */
    double corner[4];          /* the ends relative to the body's origin */
    const sunder_shape
        *area; /* if the line bounds an area: this area, which lies on the left of the edge from corner `vertex`; else
                * NULL */
    uint32_t vertex;
} sunder_i_side;

/* The rule of rows between a body and a neighbour in a row: `along` points towards the neighbour, and the neighbour's
 * move minus the body's is at least `least` long in that direction; only `least_listed`, if the pair remains in
 * conflict. Neither is more than 0, except `least` if the pair is in conflict at the start. */
typedef struct sunder_i_row_side {
    uint32_t other;                       /* the neighbour */
    double along[2], least, least_listed; /* no rule: -INFINITY */
    double full;                          /* what is missing of this has the price of the pair; none: -INFINITY */
    double weight;                        /* of the springs: the lesser weight of the two bodies */
    double rest[2];                       /* the relative move at which the springs are at rest (preferred.c) */
} sunder_i_row_side;

/* The springs of a row between a body and its neighbour, with u the neighbour's move minus the body's, less the move at
 * which they are at rest: each costs stiff * (u.n)^2. There are up to two: across the row and along it. */
typedef struct sunder_i_spring {
    double n[2], stiff;
} sunder_i_spring;

/* Returns coordinate v on axis c relative to the body's origin, clamped to the body's reach. Only the search clamps;
 * proofs use the corners as given. */
static inline double sunder_i_from_origin(const sunder_i_body *body, double v, size_t c)
{
    return sunder_i_max(-body->reach, sunder_i_min(v - body->origin[c], body->reach));
}

/* May the body move at all? */
static inline bool sunder_i_may_move(const sunder_i_body *body) { return !body->fixed && !body->pinned; }

/* Returns the longest move that the body may make; 0 if it is fixed. */
static inline double sunder_i_limit_of(const sunder_i_body *body) { return body->fixed ? 0 : body->limit; }

/* Sets box to the box of the body's members at their original positions; box[0] > box[2] if none is present. */
void sunder_i_body_home_box(const sunder_i_model *model, const sunder_i_body *body, double box[4]);

/* Sets box to the box of the body at its original position plus t, grown by `reach`. Its own box has to be known. */
static inline void sunder_i_body_box(const sunder_i_body *body, const double t[2], double reach, double box[4])
{
    for (size_t c = 0; c < 4; c++) box[c] = body->box[c] + body->origin[c & 1] + t[c & 1] + (c < 2 ? -reach : reach);
}

/* What was read on behalf of a body: `place` bounds the boxes that were queried, and `seen` bounds the whole bodies
 * found there, at their original positions. */
typedef struct sunder_i_read {
    double place[4], seen[4];
} sunder_i_read;

/* All that the search works with, in doubles. Results of the search are always verified exactly. */
struct sunder_i_model {
    const sunder_layer *layer;
    sunder_i_rules rules;
    sunder_shape *disc; /* the polygon rules.disc, owned */
    const sunder_i_barriers *barriers;
    const sunder_i_class_gaps *gaps;      /* the layer's; NULL: all pairs have the gap of the rules */
    const double *class_gap, *class_full; /* with gaps: the gap and the full gap of each two classes */
    bool class_slack;                     /* there are classes whose full gap is greater than the gap */
    size_t bodies;
    size_t features, things; /* the numbers of both; features come first, then the parts of barriers, which are fixed
                              * bodies */
    size_t vertices;         /* the number of vertices of all features */
    uint32_t *body_of;       /* [things] the body of each thing */
    uint32_t *member;        /* [things] the things, sorted by body */
    sunder_i_body *body;
    sunder_i_arena extras;                 /* holds the extras of bodies */
    _Atomic(sunder_i_body_pieces *) *made; /* [bodies] the pieces of each, or NULL until they are made; see
                                            * sunder_i_pieces_of() */
    struct sunder_i_pieces_store *store;   /* the memory of the pieces */
    /* anchor_at, clear and held are set only if jumps are not allowed, and covers (the members diagonal_cover... and
     * wall_cover...) also if a barrier requires no distance; otherwise they are NULL. */
    double *anchor_at; /* [2 * features] the anchors in coordinates of the layer */
    double *clear;     /* [features] a lower bound of the distance from each anchor to the nearest feature of
                                * another body that does not contain it */
    sunder_i_body_piece *
        diagonal_cover; /* convex pieces of features that cover the diagonals between their pieces; diagonal_covers.c */
    double *diagonal_cover_corner; /* [8 * diagonal covers] the four corners of each, relative to the body's origin */
    uint32_t
        *diagonal_cover_vertices; /* [4 * diagonal covers] the vertices from which sunder_i_diagonal_cover_corners()
                                  * recomputes the corners as given */
    size_t diagonal_covers;
    bool has_diagonal_covers; /* the covers of diagonals have been made for all bodies */
    sunder_i_wall_cover
        *wall_cover; /* covers of walls that members share, for the bodies they were requested for; wall_covers.c */
    size_t wall_covers;
    bool *may_jump;         /* [features] the feature may jump over others, and they over it; NULL: none may */
    sunder_i_id_pair *held; /* pairs of a feature and a feature of another body that contains its anchor; sorted */
    size_t held_n;
    /* The next five are set only if barriers have sides: */
    sunder_i_side *side;
    size_t sides;
    sunder_i_body_piece *side_anchor; /* [features] each side anchor as a piece of one corner */
    double *side_at;                  /* [2 * features] the side anchors in coordinates of the layer */
    double *side_anchors;             /* [4 * bodies] the box of each body's side anchors, relative to the body's
                                       * origin */
    sunder_i_row_side *row_side;      /* the neighbours in rows of all bodies, those of a body one after the other */
    size_t row_sides;                 /* 0: there is no rule of rows */
    sunder_shape **whole; /* [bodies] the union of a block's members, if it was made; NULL if not, and for single
                                  * features */
    uint32_t most_pieces; /* the largest number of pieces of one body */
    bool *present;        /* [things] the thing is neither ignored nor empty */
    sunder_i_interior_cover
        *interior_cover; /* [features] their interior covers, if there are barriers without area; else NULL */
    sunder_i_rtree tree; /* over the boxes of things at their original positions, grown by
                                  * sunder_i_reach_beyond() */
    sunder_i_read *read; /* [bodies] what was read for each (layer/reads.h); NULL: reads are not recorded */
    double *went;        /* [4 * bodies] the box of all moves that each body ever had; NULL: reads are not
                                  * recorded */
    const sunder_i_rtree *standing; /* borrowed: the placement's tree over the present positions */
    sunder_i_body_piece *wall;      /* edges of features that hold others inside; see inclusion.c */
    double *wall_corner;            /* [4 * walls] the two ends of each */
    size_t walls;
    sunder_i_inclusion *inclusion; /* pairs that may overlap, because one feature lies in the other; sorted */
    size_t inclusions;
    sunder_i_inclusion *nested; /* pairs in conflict in which one feature lay in the other at the start; sorted */
    size_t nested_n;
    sunder_i_id_pair *crossed; /* (feature, first part of a barrier) for each barrier whose line crosses the feature at
                                * home, if such pairs are kept (crossed_features.c); sorted */
    size_t crossed_n;
    sunder_i_relaxations relaxations;
    sunder_i_id_pair *given_up; /* pairs of bodies for which no solution was found that resolves this pair as well as
                                 * the others; sorted */
    size_t given_up_n;
    sunder_i_id_pair *shut_in; /* pairs of features a < b for which it is proved that only a jump would separate them;
                                * sorted */
    size_t shut_in_n;
    sunder_i_id_pair *confined; /* pairs of bodies i < j for which that is proved for all of their members, whichever
                                 * are in conflict; sorted */
    size_t confined_n;
    double *move;      /* [2 * bodies] the present position of each, relative to the start */
    double *preferred; /* [2 * bodies] the move of each that costs nothing; NULL: 0 for all (preferred.c) */
    double *lifted; /* [2 * bodies] the position of each when it was solved without limits; NULL: there was no such run,
                     * or it is not over */
    bool *inexact;  /* [things] the feature's translate is not exact, so it is written rounded */
    /* For the trace: the present stage, in the words of the tables of stages (solve_layer.c); NULL: before the first */
    const char *pass, *stage;
    int round; /* the round of the stage, from 1 on */
};

/* ---- Things ------------------------------------------------------------------------------------------------------ */

/* Is the thing a part of a barrier? Such a thing has no anchor and no outline. */
static inline bool sunder_i_is_barrier(const sunder_i_model *model, uint32_t thing) { return thing >= model->features; }

/* Is the body a part of a barrier? */
static inline bool sunder_i_is_barrier_body(const sunder_i_model *model, const sunder_i_body *body)
{
    return sunder_i_is_barrier(model, model->member[body->member]);
}

/* Returns the number of the barrier that `part` belongs to. */
static inline uint32_t sunder_i_barrier_of(const sunder_i_model *model, uint32_t part)
{
    return model->barriers->barrier[part - model->features];
}

/* Returns the shape of a thing at its original position; of a feature at its present level. */
static inline const sunder_shape *sunder_i_thing_shape(const sunder_i_model *model, size_t thing)
{
    const sunder_layer *layer = model->layer;
    if (thing >= layer->n) return layer->part[thing - layer->n].shape;
    return (layer->lowered ? layer->given->at_level : layer->given->shape)[layer->number[thing]];
}

/* The demands on a feature, without its shape. */
static inline const sunder_feature *sunder_i_demands_on(const sunder_i_model *model, uint32_t feature)
{
    return sunder_i_demands(model->layer->given, model->layer->number[feature]);
}

/* May one of the two features jump over the other, wherever they are? */
static inline bool sunder_i_may_jump(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    return model->may_jump && (model->may_jump[f] || model->may_jump[g]);
}

/* Returns the shape of a feature as it was given, from which its anchors are computed. */
static inline const sunder_shape *sunder_i_given_shape(const sunder_i_model *model, size_t feature)
{
    return model->layer->given->shape[model->layer->number[feature]];
}

/* Returns a box that contains the thing at its original position, and a feature's shape as given too; zeros if the
 * thing is not present. */
static inline const double *sunder_i_home_box(const sunder_i_model *model, uint32_t thing)
{
    return sunder_i_rtree_box(&model->tree, thing);
}

/* Are some relative moves forbidden regardless of where they end (jumps, crossed sides)? */
static inline bool sunder_i_forbids_paths(const sunder_i_model *model) { return !model->rules.jumps || model->sides; }

/* Returns the box of the side anchors of one of the model's bodies. There must be barriers with sides. */
static inline const double *sunder_i_side_anchors(const sunder_i_model *model, const sunder_i_body *body)
{
    return model->side_anchors + 4 * (size_t)(body - model->body);
}

/* Returns the thing that represents a whole barrier in place of one of its parts: the first part. Returns a feature
 * unchanged. */
static inline uint32_t sunder_i_whole_of(const sunder_i_model *model, uint32_t thing)
{
    if (!sunder_i_is_barrier(model, thing)) return thing;
    return (uint32_t)model->features + sunder_i_first_part(model->barriers, thing - (uint32_t)model->features);
}

/* The class of a feature for gaps; 0 if the layer has one gap. */
static inline uint32_t sunder_i_class_of(const sunder_i_model *model, uint32_t feature)
{
    return model->gaps ? model->gaps->of[model->layer->number[feature]] : 0;
}

/* The gap of two things by their classes, without the drawn width and the own gap of a barrier. */
static inline double sunder_i_gap_of(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const uint32_t *number = model->layer->number;
    if (!model->gaps) return model->rules.gap;
    return sunder_i_class_gap(model->gaps, model->class_gap, model->rules.gap, number[f], number[g]);
}

static inline double sunder_i_full_gap_of(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const uint32_t *number = model->layer->number;
    if (!model->gaps) return model->rules.full_gap;
    return sunder_i_class_gap(model->gaps, model->class_full, model->rules.full_gap, number[f], number[g]);
}

/* The distance that a feature, the lesser of two things, has to keep from a part of a barrier, the other of them. */
static inline const double *sunder_i_required_of(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const uint32_t feature = f < g ? f : g, part = f < g ? g : f;
    return sunder_i_required(model->barriers, sunder_i_barrier_of(model, part), sunder_i_class_of(model, feature));
}

static inline const double *sunder_i_full_required_of(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const uint32_t feature = f < g ? f : g, part = f < g ? g : f;
    return sunder_i_full_required(model->barriers, sunder_i_barrier_of(model, part), sunder_i_class_of(model, feature));
}

/* The distance that two things have to keep from each other, rounded down, and rounded up; for two features it is their
 * gap. */
static inline double sunder_i_owed_below(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    if (!sunder_i_is_barrier(model, f > g ? f : g)) return sunder_i_gap_of(model, f, g);
    return sunder_i_rounded_down(sunder_i_required_of(model, f, g));
}

static inline double sunder_i_owed_above(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    if (!sunder_i_is_barrier(model, f > g ? f : g)) return sunder_i_gap_of(model, f, g);
    return sunder_i_rounded_up(sunder_i_required_of(model, f, g));
}

/* The distance that two things keep from each other if it pays, which is not less than what they have to keep: rounded
 * down, and rounded up. */
static inline double sunder_i_full_below(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    if (!sunder_i_is_barrier(model, f > g ? f : g)) return sunder_i_full_gap_of(model, f, g);
    return sunder_i_rounded_down(sunder_i_full_required_of(model, f, g));
}

static inline double sunder_i_full_above(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    if (!sunder_i_is_barrier(model, f > g ? f : g)) return sunder_i_full_gap_of(model, f, g);
    return sunder_i_rounded_up(sunder_i_full_required_of(model, f, g));
}

/* The greatest distance that any feature has to keep from the thing, rounded up: the gap, if it is a feature. */
static inline double sunder_i_owed_most(const sunder_i_model *model, uint32_t thing)
{
    if (!sunder_i_is_barrier(model, thing)) return model->rules.gap;
    return sunder_i_required_most(model->barriers, sunder_i_barrier_of(model, thing));
}

/* Is there a pair that may stand nearer than its full distance? */
static inline bool sunder_i_has_slack(const sunder_i_model *model)
{
    return model->rules.full_gap > model->rules.gap || model->class_slack || model->barriers->slack;
}

/* Do two things have to keep the layer's gap from each other? A barrier may have a gap of its own. */
static inline bool sunder_i_owe_gap(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const uint32_t part = f > g ? f : g;
    return !sunder_i_is_barrier(model, part) || model->layer->barrier[sunder_i_barrier_of(model, part)].gap < 0;
}

/* Returns by how much the distance that features keep from the thing exceeds the gap, or the full distance the full
 * gap, if that is more. The boxes of barriers, and of their bodies and pieces, are grown by it, so that a query with
 * the gap finds everything that a distance has to be kept from. */
static inline double sunder_i_reach_beyond(const sunder_i_model *model, uint32_t thing)
{
    if (!sunder_i_is_barrier(model, thing)) return 0;
    const uint32_t barrier = sunder_i_barrier_of(model, thing);
    const double beyond = sunder_i_max(0, sunder_i_required_most(model->barriers, barrier) - model->rules.gap);
    if (!sunder_i_has_slack(model)) return beyond;
    return sunder_i_max(beyond, sunder_i_full_required_most(model->barriers, barrier) - model->rules.full_gap);
}

/* Is it proved that only a jump would separate the features f < g? */
static inline bool sunder_i_are_shut_in(const sunder_i_model *model, uint32_t f, uint32_t g)
{
    const sunder_i_id_pair pair = {f, g};
    return model->shut_in_n && bsearch(&pair, model->shut_in, model->shut_in_n, sizeof pair, sunder_i_by_id_pair);
}

/* Is it proved that only a jump would separate the bodies i and j? */
static inline bool sunder_i_are_confined(const sunder_i_model *model, uint32_t i, uint32_t j)
{
    const sunder_i_id_pair pair = {i < j ? i : j, i < j ? j : i};
    return model->confined_n && bsearch(&pair, model->confined, model->confined_n, sizeof pair, sunder_i_by_id_pair);
}

/* ---- preferred.c ------------------------------------------------------------------------------------------------- */

/* Returns the move of the body that costs nothing: its preferred place, relative to its original one. */
static inline const double *sunder_i_preferred(const sunder_i_model *model, uint32_t body)
{
    static const double none[2] = {0, 0};
    return model->preferred ? model->preferred + 2 * (size_t)body : none;
}

/* The distance of a move from the one that the body prefers. Its square times the body's weight is what it costs. */
double sunder_i_stray(const sunder_i_model *model, uint32_t body, const double t[2]);
static inline double sunder_i_stray_square(const sunder_i_model *model, uint32_t body, const double t[2])
{
    const double *a = sunder_i_preferred(model, body), x = t[0] - a[0], y = t[1] - a[1];
    return x * x + y * y;
}

/* Does the body stand at another place than the one it prefers? */
static inline bool sunder_i_is_astray(const sunder_i_model *model, uint32_t body, const double t[2])
{
    const double *a = sunder_i_preferred(model, body);
    return t[0] != a[0] || t[1] != a[1];
}

/* Finds the preferred places of all bodies, if the layer has any. Returns false if memory is out. */
bool sunder_i_model_prefer(sunder_i_model *model);
/* Finds the relative moves at which the springs of rows are at rest. */
void sunder_i_model_rest_springs(sunder_i_model *model);

/* ---- full_gap.c -------------------------------------------------------------------------------------------------- */

/* Returns a copy of the model in which every pair has to keep its full distance. It borrows everything from the model,
 * and uses *barriers. */
sunder_i_model sunder_i_with_full_gap(const sunder_i_model *model, sunder_i_barriers *barriers);

/* ---- model.c ----------------------------------------------------------------------------------------------------- */

/* Sets up the model of a layer, behind whose features are the parts of its barriers (layer.h), with the tree over the
 * original boxes. After a failure, too, the caller frees it by sunder_i_model_free(). */
sunder_status sunder_i_model_init(const sunder_layer *layer, const sunder_i_barriers *barriers,
                                  const sunder_i_rules *rules, sunder_i_model *model, sunder_error *err);
/* Returns a feature at its original position. */
static inline sunder_i_translate sunder_i_at_home(const sunder_i_model *model, uint32_t feature)
{
    return (sunder_i_translate){.shape = sunder_i_thing_shape(model, feature),
                                .interior_cover = model->interior_cover ? model->interior_cover[feature].shape : NULL};
}
/* Makes the bodies: joins the features that the rules join. */
sunder_status sunder_i_model_join(sunder_i_model *model, const sunder_i_relations *relations, sunder_error *err);
void sunder_i_model_free(sunder_i_model *model);

/* ---- crossed_features.c ------------------------------------------------------------------------------------------ */

/* Notes the pairs of a feature and a barrier that crosses it, if the layer keeps them. start: the relations at home. */
sunder_status sunder_i_model_note_crossed(sunder_i_model *model, const sunder_i_relations *start, sunder_error *err);
/* Is one of the two things crossed by a line of the other, and kept? */
bool sunder_i_is_crossed(const sunder_i_model *model, uint32_t f, uint32_t g);

/* ---- bodies.c ---------------------------------------------------------------------------------------------------- */

/* Numbers the convex pieces of all bodies, and computes the bodies' boxes. */
sunder_status sunder_i_model_cut(sunder_i_model *model, sunder_error *err);
/* Returns the body that has the piece with this number. */
uint32_t sunder_i_body_of_piece(const sunder_i_model *model, uint32_t piece);
/* Returns a length such that any relative move of bodies p and q that is longer leaves them more than the gap apart. */
double sunder_i_farthest_near(const sunder_i_model *model, uint32_t p, uint32_t q);
/* Returns twice a length such that any longer move of the body leaves it farther from the whole barrier, of which
 * `part` is one part, than it has to keep. */
double sunder_i_far_from_barrier(const sunder_i_model *model, uint32_t body, uint32_t part);

/* ---- barriers_about.c -------------------------------------------------------------------------------------------- */

/* Sets `whole` to the barriers that come within `reach` of the box of the body at its original position, each by its
 * first part, ascending. Sets *far to a length such that the body, moved by more, is apart from all of these barriers;
 * 0 if there is none. Returns false if memory is out. */
bool sunder_i_barriers_about(const sunder_i_model *model, uint32_t body, double reach, sunder_i_list *whole,
                             double *far);
/* Makes the unions of the members of these n bodies, if they are blocks and have none yet. */
sunder_status sunder_i_model_unite(sunder_i_model *model, const uint32_t *body, size_t n, sunder_error *err);
/* Returns the shape of a body: that of its only member, or the union of all members. Returns NULL if the union was not
 * made or the member is not present. */
const sunder_shape *sunder_i_model_shape(const sunder_i_model *model, uint32_t body);
/* Returns a lower bound of the weight of a body. */
double sunder_i_weight_below(const sunder_i_model *model, const sunder_i_body *body);

/* ---- extras.c ---------------------------------------------------------------------------------------------------- */

/* The extras of a body that has none. */
extern const sunder_i_extras sunder_i_no_extras;
/* Returns the extras of a body, to be written to; allocates them if it has none. Returns NULL if memory is out. */
sunder_i_extras *sunder_i_own_extras(sunder_i_model *model, sunder_i_body *body);
/* Sets box to the box of the anchors of a body's members, relative to its origin. Only if jumps are not allowed. */
void sunder_i_anchors(const sunder_i_model *model, const sunder_i_body *body, double box[4]);
/* Stores the box for sunder_i_anchors() if the body has many members. To be called once the anchors are known. Returns
 * false if memory is out. */
bool sunder_i_keep_anchors(sunder_i_model *model, sunder_i_body *body);

/* ---- body_pieces.c ----------------------------------------------------------------------------------------------- */

/* Makes the pieces that sunder_i_pieces_of() returns. */
const sunder_i_body_pieces *sunder_i_pieces_make(const sunder_i_model *model, const sunder_i_body *body);
/* Returns the pieces of a body; they remain until sunder_i_pieces_forget(). Pieces must have been numbered and anchors
 * found before. Returns NULL if memory is out. Any number of threads may call it at the same time. */
static inline const sunder_i_body_pieces *sunder_i_pieces_of(const sunder_i_model *model, const sunder_i_body *body)
{
    const sunder_i_body_pieces *made = atomic_load_explicit(&model->made[body - model->body], memory_order_acquire);
    return made ? made : sunder_i_pieces_make(model, body);
}
/* Returns the convex hulls of a body's members, one for each, for use where the pieces are too many. The conditions are
 * those of sunder_i_pieces_of(). */
const sunder_i_body_piece *sunder_i_outlines_of(const sunder_i_model *model, const sunder_i_body *body);
/* Writes the convex hull of a present thing, relative to its body's origin, to `out` and returns the number of corners.
 * `point` is scratch for sunder_i_outline_room() points; `out` has room for one more. */
size_t sunder_i_outline_of(const sunder_i_model *model, uint32_t thing, double *point, double *out);
size_t sunder_i_outline_room(const sunder_i_model *model, uint32_t thing);
/* Sets up the store of pieces, without any. Returns false if memory is out; sunder_i_pieces_end() frees it, also
 * then. */
bool sunder_i_pieces_begin(sunder_i_model *model);
void sunder_i_pieces_end(sunder_i_model *model);
/* Frees all pieces if they take more than `most` bytes; they are made again when needed. Must be called only when no
 * code refers to pieces: between two stages or two questions. */
void sunder_i_pieces_forget(sunder_i_model *model, size_t most);
/* The number of bytes below which freeing pieces does not pay. */
#define SUNDER_I_PIECES_HELD ((size_t)4 << 20)
/* Returns the number of corners that a piece, an anchor or a side has as given. The search may use more or fewer, if
 * some are far (far_corners.h). */
size_t sunder_i_corners_as_given(const sunder_i_model *model, const sunder_i_body_piece *piece);
/* Writes the corners of a piece in coordinates of the layer to `out`, which has room for all of them; corners of
 * repaired shapes are rounded to doubles. */
void sunder_i_piece_as_given(const sunder_i_model *model, const sunder_i_body_piece *piece, double *out);
/* Writes the convex hull of n points, counter-clockwise, to `out`, which has room for n + 1, and returns the number of
 * corners. It is computed in doubles. Sorts `point`. */
size_t sunder_i_convex_hull(double *point, size_t n, double *out);

/* ---- anchors.c --------------------------------------------------------------------------------------------------- */

/* Finds the anchors, if jumps are not allowed, and the side anchors (sides.h). Pieces must have been numbered
 * before. */
sunder_status sunder_i_model_anchor(sunder_i_model *model, sunder_error *err);
/* May the anchor of feature f pass over thing g, of another body? It may if g contained it at the start, so that f may
 * leave g, or if one of the two may jump. */
bool sunder_i_may_pass(const sunder_i_model *model, uint32_t f, uint32_t g);

/* ---- diagonal_covers.c ------------------------------------------------------------------------------------------- */

/* Does the layer have barriers without area (segments, points), and a barrier that requires no distance? A feature
 * could meet such a segment along a diagonal without meeting a piece. The two need not be the same barrier; covers are
 * then made without need. */
bool sunder_i_has_bare_barriers(const sunder_i_model *model);
/* Makes the covers of diagonals that are still missing, for all bodies or for the n bodies in `body`. Pieces must have
 * been numbered before. Proofs need these covers, the search does not. Pointers to covers become invalid. */
sunder_status sunder_i_model_cover_diagonals(sunder_i_model *model, sunder_error *err);
sunder_status sunder_i_model_cover_diagonals_of(sunder_i_model *model, const uint32_t *body, size_t n,
                                                sunder_error *err);

/* ---- wall_covers.c ----------------------------------------------------------------------------------------------- */

/* Makes the covers of the walls that members of these n bodies share; `body` ascends. To be called once for a body.
 * Pointers to such covers become invalid. */
sunder_status sunder_i_model_cover_walls(sunder_i_model *model, const uint32_t *body, size_t n, sunder_error *err);

/* ---- row_sides.c ------------------------------------------------------------------------------------------------- */

/* Returns the neighbour `other` of the body in a row; NULL if it is none. */
const sunder_i_row_side *sunder_i_row_side_of(const sunder_i_model *model, const sunder_i_body *body, uint32_t other);
/* The greatest distance that two features keep if it pays, by which rows are measured. */
double sunder_i_row_full_gap(const sunder_i_model *model);
/* Returns the least gap of a member of one body to a member of the other, at most `most`; `table` is the model's
 * class_gap or class_full. */
double sunder_i_row_gap(const sunder_i_model *model, const double *table, double most, uint32_t i, uint32_t j);
/* Adds the neighbours of the body in rows to a list of bodies, which is ascending. Returns false if memory is out. */
bool sunder_i_add_row_neighbours(const sunder_i_model *model, uint32_t body, sunder_i_list *list);
/* Sets `spring` to the springs between the two, with their weight. Returns their number. */
size_t sunder_i_springs_of(const sunder_i_model *model, const sunder_i_row_side *side, sunder_i_spring spring[2]);
/* Returns the cost of the springs between a body with the move t and its neighbour in a row with the move s. The first
 * function uses the stiffness of the model's rules, the second one the given stiffness across and along the row. */
double sunder_i_spring_cost(const sunder_i_model *model, const sunder_i_row_side *side, const double t[2],
                            const double s[2]);
double sunder_i_spring_cost_with(const double stiffness[2], const sunder_i_row_side *side, const double t[2],
                                 const double s[2]);
/* Returns the cost of the springs between n bodies, which ascend, with these moves. The second function returns that of
 * the springs between one of them and a body that is not listed, at its present move. */
double sunder_i_springs_within(const sunder_i_model *model, const uint32_t *body, size_t n, const double *move);
double sunder_i_springs_beyond(const sunder_i_model *model, const uint32_t *body, size_t n, const double *move);
/* Is (s - t) . side->along >= least, for the moves t of the body and s of the neighbour? Exact, unless a product is so
 * small that its rounding error underflows (below 2^-960). */
bool sunder_i_keeps_row(const sunder_i_row_side *side, const double t[2], const double s[2], double least);

/* ---- within_limit.c ---------------------------------------------------------------------------------------------- */

/* Is |t| <= limit? Exact. limit may be infinite. */
bool sunder_i_is_within_limit(const double t[2], double limit);

#endif
