/* The layer as bodies that move: blocks, their convex pieces, pairs of one in another, pairs left in conflict, and
 * where each body stands. What is in doubles here is for the search, which decides nothing: what it finds is checked
 * exactly. */
#ifndef SUNDER_I_MODEL_H
#define SUNDER_I_MODEL_H

#include "displacement/layer/inclusion.h"
#include "displacement/layer/relaxation.h"
#include "spatial/rtree.h"

/* A body is what moves as one: a block, or a feature that stands alone. Bodies are numbered by their first members. */
typedef struct sunder_i_body {
    uint32_t member, members; /* its features: members of them in sunder_i_model.member from there */
    uint32_t piece, pieces;   /* its convex pieces in sunder_i_model.piece */
    uint32_t wall, walls;     /* the edges of its members that keep others inside, in sunder_i_model.wall */
    double weight;            /* the sum of its members' */
    double limit;             /* the strictest of its members' */
    bool fixed;               /* limit 0 counts too */
    bool pinned;              /* stays where it came from: rounding would make a pair of it stand worse (uphold.c) */
    double origin[2];         /* its corners are stored relative to this */
    double box[4];            /* of its pieces, relative to the origin */
    double anchors[4];        /* of its members' anchors, likewise */
} sunder_i_body;

/* One convex piece of a body, counter-clockwise; a wall is one without area, of two corners. */
typedef struct sunder_i_body_piece {
    uint32_t corner, corners; /* in sunder_i_model.corner */
    uint32_t feature;
    double box[4]; /* relative to the body's origin */
} sunder_i_body_piece;

/* May it move at all? */
static inline bool sunder_i_may_move(const sunder_i_body *body) { return !body->fixed && !body->pinned; }

/* How far the body may go. */
static inline double sunder_i_limit_of(const sunder_i_body *body) { return body->fixed ? 0 : body->limit; }

/* The box of the body, moved by t and grown by reach. */
static inline void sunder_i_body_box(const sunder_i_body *body, const double t[2], double reach, double box[4])
{
    for (size_t c = 0; c < 4; c++) box[c] = body->box[c] + body->origin[c & 1] + t[c & 1] + (c < 2 ? -reach : reach);
}

/* Everything that the search looks at, in doubles. It decides nothing: what it finds is checked exactly afterwards. */
struct sunder_i_model {
    const sunder_layer *layer;
    sunder_i_rules rules;
    size_t bodies, features, pieces;
    uint32_t *body_of; /* [features] */
    uint32_t *member;  /* [features] features by body */
    sunder_i_body *body;
    sunder_i_body_piece *piece;
    sunder_i_body_piece *outline; /* [features] the convex hull of each, for where its pieces are too many */
    double *corner;               /* [2 * corners] relative to the body's origin */
    size_t corners;
    /* Where jumps are not allowed; else NULL: */
    sunder_i_body_piece *anchor; /* [features] each anchor as a piece of one corner */
    double *anchor_at;           /* [2 * features] the anchors as they are */
    sunder_i_id_pair *held;      /* a feature, and one of another body that holds its anchor; sorted */
    size_t held_n;
    sunder_shape **whole; /* [bodies] the union of a block's members, where wanted; NULL for what stands alone */
    double *box;          /* [4 * features] as they stood at the start */
    bool *present;        /* [features] */
    sunder_i_rtree tree;  /* as they stood at the start */
    const sunder_i_rtree *standing; /* as they stand now: the placement's; lent */
    sunder_i_body_piece *wall;      /* edges of features that hold others; see inclusion.c */
    size_t walls;
    sunder_i_inclusion *inclusion; /* pairs that may overlap, because one lies in the other; sorted */
    size_t inclusions;
    sunder_i_inclusion *nested; /* pairs in conflict of which the one lies in the other at the start; sorted */
    size_t nested_n;
    sunder_i_relaxations relaxations;
    sunder_i_id_pair *given_up; /* bodies given up: no solution was found that resolves this pair, too; sorted */
    size_t given_up_n;
    double *move;  /* [2 * bodies] where each stands now, relative to the start */
    bool *inexact; /* [features] the translate was rounded */
};

/* ---- model.c ----------------------------------------------------------------------------------------------------- */

/* The features' boxes and the tree over them as they were. On failure the model can be given to
 * sunder_i_model_free() all the same. */
sunder_status sunder_i_model_init(const sunder_layer *layer, const sunder_i_rules *rules, sunder_i_model *model,
                                  sunder_error *err);
/* Joins what the rules join. */
sunder_status sunder_i_model_join(sunder_i_model *model, const sunder_i_relations *relations, sunder_error *err);
void sunder_i_model_free(sunder_i_model *model);

/* ---- bodies.c ---------------------------------------------------------------------------------------------------- */

/* The convex pieces, for the search. */
sunder_status sunder_i_model_cut(sunder_i_model *model, sunder_error *err);
/* Unites the members of these bodies, those that are blocks and have not been. */
sunder_status sunder_i_model_unite(sunder_i_model *model, const uint32_t *body, size_t n, sunder_error *err);
/* The shape of a body: its only member's, or the union. NULL if it was not united or is empty. */
const sunder_shape *sunder_i_model_shape(const sunder_i_model *model, uint32_t body);

/* ---- anchors.c --------------------------------------------------------------------------------------------------- */

/* The anchors, where they matter; after the pieces are cut. */
sunder_status sunder_i_model_anchor(sunder_i_model *model, sunder_error *err);
/* Does g, of another body, hold the anchor of f? Then f may leave it. */
bool sunder_i_is_held(const sunder_i_model *model, uint32_t f, uint32_t g);

/* ---- within_limit.c ---------------------------------------------------------------------------------------------- */

/* |t| <= limit? Exact. limit may be infinite. */
bool sunder_i_is_within_limit(const double t[2], double limit);

#endif
