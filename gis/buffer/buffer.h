/* buffer.h: the command sunder buffer deals a layer's features to sets and grows or shrinks each set, in doubles. */
#ifndef GIS_BUFFER_H
#define GIS_BUFFER_H

#include "geometry/round/round.h"
#include "layer/layer_input.h"
#include "write/sink/sink.h"

/* The request. Strings are borrowed until the buffer is cleared. */
typedef struct gis_buffer_request {
    gis_layer_input_request layer;
    gis_shape_request shape;
    sunder_operation operation;
    bool dissolve;              /* into one set, or by the field */
    const char *dissolve_field; /* NULL: none */
    bool explode;               /* each polygon of a result is a feature */
    bool align;                 /* the shape is turned to the main direction of a set or block */
    bool degenerate;            /* layers of degenerate segments and points, too */
    unsigned threads;           /* 0: as many as there are processors */
} gis_buffer_request;

/* One set of features (a single one, unless they are dissolved) and what became of it. */
typedef struct gis_buffer_set {
    const size_t *member; /* features, in their order; borrowed */
    size_t members;
    bool none; /* none of them has a polygon: nothing is made, and a null geometry written */
    gis_rounded result;
    double *segment; /* [4 * segments] ends, if degenerate ones are wanted */
    double *point;   /* [2 * points] */
    size_t segments, points;
    double area;
} gis_buffer_set;

typedef struct gis_buffer {
    const gis_buffer_request *request;
    gis_layer_input input;
    sunder_shape *shape;
    gis_source *shape_source; /* NULL: it is a text */
    int field;                /* of dissolve_field; -1: none */
    gis_buffer_set *set;
    size_t sets;
    size_t *member; /* features, set by set */
    size_t empty, vertices, rounded_again;
    double area, deviation;
} gis_buffer;

/* Reads the layer and the shape, and groups the features into sets (gis_buffer_gather). On failure the caller clears
 * the buffer as well. */
bool gis_buffer_read(const gis_buffer_request *request, gis_buffer *out, gis_error *error);
/* Deals the features to sets: by value of the field, in the order in which values come first (each null by itself), or
 * all into one. */
bool gis_buffer_gather(gis_buffer *buffer, gis_error *error);
/* Makes the sets, on as many threads as are asked for, and adds up the figures. */
bool gis_buffer_make(gis_buffer *buffer, gis_progress *progress, gis_error *error);
/* Makes one set, as it stands (make_set.c). */
bool gis_buffer_make_set(const gis_buffer *buffer, gis_buffer_set *set, const sunder_sum_options *how,
                         gis_error *error);
/* All members of a set as one shape; *deviation is raised to what that moved. */
bool gis_buffer_join(const gis_buffer *buffer, const gis_buffer_set *set, sunder_shape **out, double *deviation,
                     gis_error *error);
void gis_buffer_set_clear(gis_buffer_set *set);
/* --align (turned_shape.c): the shape, turned to the main direction of a set. */
bool gis_buffer_turned(const gis_buffer *buffer, const gis_buffer_set *set, sunder_shape **out, gis_error *error);
/* --align with --dissolve (align.c): makes a set block by block, the shape turned for each. */
bool gis_buffer_make_blocks(const gis_buffer *buffer, gis_buffer_set *set, const sunder_sum_options *how,
                            gis_error *error);
void gis_buffer_clear(gis_buffer *buffer);

/* LAYER, and, if wanted, LAYER_degenerate_segments and LAYER_degenerate_points. */
bool gis_write_buffer(gis_sink *sink, const gis_buffer *buffer, gis_error *error);

#endif
