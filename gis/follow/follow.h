/* follow.h: a layer that goes along with what was moved, such as address points, entrances, fences or labels.
 *
 * MOVED is a result of separate. Each of its features has a move; the features of one block have the same one, and are
 * one *group* here, which is named by its first feature. A feature of INPUT that belongs to a group gets its move. */
#ifndef GIS_FOLLOW_H
#define GIS_FOLLOW_H

#include "base/progress.h"
#include "read/read_shape.h"
#include "write/sink/sink.h"

/* How the group of a feature is found. */
typedef enum gis_follow_by {
    GIS_FOLLOW_INSIDE,  /* all its vertices were in the shapes of the group */
    GIS_FOLLOW_NEAREST, /* the group was the nearest one within a distance */
    GIS_FOLLOW_FIELD    /* a field names a feature of MOVED */
} gis_follow_by;

/* Strings are borrowed from the options. */
typedef struct gis_follow_request {
    gis_source_request moved, input;
    gis_invalid_policy invalid;
    gis_follow_by by;
    gis_optional_length within; /* of GIS_FOLLOW_NEAREST */
    const char *field;          /* of GIS_FOLLOW_FIELD: the field of INPUT */
    const char *id_field;       /* the field of MOVED that it names; NULL: the FID */
    double scale;
} gis_follow_request;

/* What became of a feature of INPUT. */
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

/* A feature of MOVED. */
typedef struct gis_follow_target {
    sunder_shape *home, *now; /* before and after the move; NULL: it has no polygons */
    double *point;            /* [2 * points] the vertices before the move of one that has no polygons; CPLFree() */
    size_t points;
    double move[2];
    size_t group; /* the first feature of its block */
    bool hidden;
} gis_follow_target;

typedef struct gis_follow_targets {
    gis_source *source;
    gis_follow_target *target; /* [n] */
    size_t n;
    void *tree;  /* a CPLQuadTree of the boxes at home; NULL: empty */
    double *box; /* [4 * n] */
} gis_follow_targets;

/* The feature's group; no feature of MOVED if it has none. */
typedef struct gis_follow_place {
    gis_follow_status status;
    size_t target; /* the feature of MOVED that it belongs to, the first of its group if several hold it; n: none */
} gis_follow_place;

typedef struct gis_follow {
    const gis_follow_request *request;
    gis_follow_targets targets;
    gis_source *input;
    double within;           /* in units of the layer */
    gis_follow_place *place; /* [features of INPUT] */
    size_t count[GIS_FOLLOW_STATUSES];
    size_t torn; /* vertices that features of INPUT shared and that are at several places now */
} gis_follow;

/* moved.c: reads MOVED: the layer that has the fields sunder_dx and sunder_dy. */
bool gis_follow_read_moved(const gis_follow_request *request, gis_follow_targets *out, gis_error *error);
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

/* attach.c: finds the group of each feature of INPUT. */
bool gis_follow_attach(gis_follow *follow, gis_progress *progress, gis_error *error);
/* carry.c: the new place *to of a vertex of a feature that belongs to the group of `target`: the nearest doubles that
 * are inside the group if the vertex was (then, if none are found, *kept becomes false); that of a vertex of the group,
 * if it was this vertex; a function of the vertex and
 * the group alone, so that vertices that are shared stay shared. */
bool gis_follow_carry(const gis_follow_targets *targets, size_t target, const double from[2], double to[2], bool *kept,
                      gis_error *error);
/* follow_layers.c: writes the layer, and counts. */
bool gis_follow_write(gis_sink *sink, gis_follow *follow, gis_error *error);

#endif
