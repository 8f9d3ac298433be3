/* follow.h: a layer that goes along with what was moved, such as address points, entrances, fences or labels.
 *
 * Each feature that separate moved, a *target* here, has a move; the features of one block have the same one, and are
 * one *group*, which is named by its first feature. A feature of the layer that belongs to a group gets its move. The
 * targets are read from a result (moved.c), or taken from a run that writes one (result_targets.c). */
#ifndef GIS_FOLLOW_H
#define GIS_FOLLOW_H

#include "base/progress.h"
#include "layer/layer_input.h"
#include "layer/rows.h"
#include "read/read_shape.h"
#include "write/sink/sink.h"

/* How the group of a feature is found. */
typedef enum gis_follow_by {
    GIS_FOLLOW_INSIDE,  /* all its vertices were in the shapes of the group */
    GIS_FOLLOW_NEAREST, /* the group was the nearest one within a distance */
    GIS_FOLLOW_FIELD    /* a field names a target */
} gis_follow_by;

/* Strings are borrowed from the options. */
typedef struct gis_follow_request {
    gis_source_request moved, input; /* moved: not of a layer that goes along in the same run */
    const char *name;                /* of the layer in the output; NULL: that of the source */
    const char *of;                  /* the layer whose features are the targets, if several move; NULL: all of them */
    gis_invalid_policy invalid;
    gis_follow_by by;
    gis_optional_length within; /* of GIS_FOLLOW_NEAREST */
    const char *field;          /* of GIS_FOLLOW_FIELD: the field of the layer */
    const char *id_field;       /* the field of the targets that it names; NULL: the FID */
    double scale;
} gis_follow_request;

/* What became of a feature of the layer. */
typedef enum gis_follow_status {
    GIS_FOLLOW_MOVED,
    GIS_FOLLOW_UNMOVED, /* its group did not move */
    GIS_FOLLOW_FREE,    /* it belongs to no group */
    GIS_FOLLOW_SEVERAL, /* its vertices were in several groups, so it was left where it was */
    GIS_FOLLOW_HIDDEN,  /* what it belongs to is hidden, so it was left where it was */
    GIS_FOLLOW_OUTSIDE, /* moved, but some vertex that was inside has no double near its place that is */
    GIS_FOLLOW_EMPTY,   /* no geometry */
    GIS_FOLLOW_STATUSES
} gis_follow_status;

/* "moved", "unmoved", "free", "several", "hidden", "outside", "empty". */
const char *gis_follow_status_string(gis_follow_status status);

/* A feature that separate moved, as it is added to the targets, which take over `point` and `block`, on failure,
 * too. */
typedef struct gis_moved_feature {
    const gis_polygons *now; /* its polygons after the move */
    double *point;           /* [2 * points] its vertices before the move, if it has no polygons; CPLFree() */
    size_t points;
    double move[2];
    char *block; /* a text that the features of its block have in common; NULL: it is in no block */
    bool hidden;
    GIntBig fid;                       /* OGRNullFID: none */
    const char *layer;                 /* borrowed: its layer, if several move together; else NULL */
    const struct gis_subject *subject; /* what messages call it */
} gis_moved_feature;

typedef struct gis_follow_target {
    sunder_shape *home, *now; /* before and after the move; NULL: it has no polygons */
    double *point;            /* as of gis_moved_feature, with what follows */
    size_t points;
    double move[2];
    size_t group; /* the first feature of its block */
    char *block;
    bool hidden;
    GIntBig fid;
    const char *layer;
} gis_follow_target;

typedef struct gis_follow_targets {
    gis_follow_target *target; /* [n] */
    size_t n, capacity;
    void *tree;  /* a CPLQuadTree of the boxes at home; NULL: empty */
    double *box; /* [4 * n] */
} gis_follow_targets;

/* The feature's group; no target if it has none. */
typedef struct gis_follow_place {
    gis_follow_status status;
    size_t target; /* the target that it belongs to, the first of its group if several hold it; n: none */
} gis_follow_place;

typedef struct gis_follow {
    const gis_follow_request *request;
    const gis_follow_targets *targets;
    gis_source *moved; /* NULL: the targets are of the same run */
    gis_source *input;
    bool layers;   /* several layers move together, so the layer of a target is written, too */
    double within; /* in units of the layer */
    char **key;    /* [keys] owned: what a field may call each target; NULL: nothing */
    size_t keys, key_capacity;
    gis_follow_place *place; /* [features of the layer] */
    size_t count[GIS_FOLLOW_STATUSES];
    size_t torn; /* vertices that features of the layer shared and that are at several places now */
} gis_follow;

/* Opens the layer; its lengths are of this scale. */
bool gis_follow_open(const gis_follow_request *request, gis_follow *out, gis_error *error);
void gis_follow_clear(gis_follow *follow);
/* What the layer is called in the output. */
const char *gis_follow_name(const gis_follow *follow);

/* moved.c: opens MOVED, the layer that has the fields sunder_dx and sunder_dy, and reads its features as targets. */
bool gis_follow_read_moved(gis_follow *follow, gis_follow_targets *out, gis_error *error);

/* result_targets.c: adds feature i of a layer that moves, or of its current batch, with its result. */
bool gis_follow_take(gis_follow_targets *targets, const gis_layer_input *own, bool layers, size_t i,
                     const gis_feature_row *row, gis_error *error);

/* targets.c: adds a target; completes them, once all are added. */
bool gis_follow_add(gis_follow_targets *targets, gis_moved_feature *feature, gis_error *error);
bool gis_follow_complete(gis_follow_targets *targets, gis_error *error);
void gis_follow_targets_clear(gis_follow_targets *targets);
/* Calls look(user, target) for the targets whose boxes at home, grown by `reach`, meet the box, in ascending order;
 * stops when it returns false. */
bool gis_follow_near(const gis_follow_targets *targets, const double box[4], double reach,
                     bool (*look)(void *user, size_t target), void *user, gis_error *error);

/* Was a place a vertex of a target: does the rounded move take it to a vertex of `now`? Home is the exact inverse of
 * the move, while the rounded move made `now`, so the vertices at home may differ from it in the last place. */
bool gis_follow_was_vertex(const gis_follow_target *target, const sunder_point *at);
/* Where a place was with respect to a target at home, as sunder_shape_locate(): 0 for a vertex, as above; -1 if the
 * target has no polygons. */
int gis_follow_side(const gis_follow_target *target, const sunder_point *at);

/* names.c: adds what a field may call the next target, whose key is the value of `field` of `feature`, or its FID if
 * field is -1; nothing, if targets are not found by a field. */
bool gis_follow_add_key(gis_follow *follow, OGRFeatureH feature, int field, GIntBig fid, gis_error *error);
/* attach.c: finds the group of each feature of the layer. progress: NULL, or is told how far it is. */
bool gis_follow_attach(gis_follow *follow, gis_progress *progress, gis_error *error);
/* carry.c: the new place *to of a vertex of a feature that belongs to the group of `target`: the nearest doubles that
 * are inside the group if the vertex was (then, if none are found, *kept becomes false); that of a vertex of the group,
 * if it was this vertex; a function of the vertex and
 * the group alone, so that vertices that are shared stay shared. */
bool gis_follow_carry(const gis_follow_targets *targets, size_t target, const double from[2], double to[2], bool *kept,
                      gis_error *error);
/* follow_layers.c: writes the layer, as main layer number `main`, and counts. */
bool gis_follow_write(gis_sink *sink, size_t main, gis_follow *follow, gis_error *error);

#endif
