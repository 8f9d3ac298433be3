/* buffer.h: the command sunder buffer groups the features of a layer into sets, dilates or erodes each set exactly, and
 * rounds the results to doubles. */
#ifndef GIS_BUFFER_H
#define GIS_BUFFER_H

#include "geometry/round/round.h"
#include "layer/layer_input.h"
#include "write/sink/sink.h"

/* The request of a buffer. Its strings are borrowed until the buffer is cleared. */
typedef struct gis_buffer_request {
    gis_layer_input_request layer;
    gis_shape_request shape;
    sunder_operation operation;
    bool dissolve;              /* unite features: all of them, or those with equal values of dissolve_field */
    const char *dissolve_field; /* NULL: all features are one set */
    bool explode;               /* each polygon of a result becomes a feature */
    bool align;                 /* the shape is turned to the main direction of each set or block */
    bool degenerate;            /* also write layers of degenerate segments and points */
    unsigned threads;           /* 0: one for each processor */
} gis_buffer_request;

/* A set of features, a single feature unless they are dissolved, and its result. */
typedef struct gis_buffer_set {
    const size_t *member; /* the numbers of the features, ascending; borrowed */
    size_t members;
    bool none; /* no member has polygons: nothing is computed, and a null geometry is written */
    gis_rounded result;
    double *segment; /* [4 * segments] coordinates of the end points of degenerate segments; NULL unless requested */
    double *point;   /* [2 * points] coordinates of degenerate points; NULL unless requested */
    size_t segments, points;
    double area;
} gis_buffer_set;

typedef struct gis_buffer {
    const gis_buffer_request *request;
    gis_layer_input input;
    sunder_shape *shape;
    gis_source *shape_source; /* NULL: the shape was given as text */
    int field;                /* the index of dissolve_field; -1: there is none */
    gis_buffer_set *set;
    size_t sets;
    size_t *member; /* the features of all sets, one set after the other */
    size_t empty, vertices, rounded_again;
    double area, deviation;
} gis_buffer;

/* Reads the layer and the shape, and groups the features into sets (gis_buffer_gather). The caller clears the buffer on
 * failure, too. */
bool gis_buffer_read(const gis_buffer_request *request, gis_buffer *out, gis_error *error);
/* Groups the features into sets: all in one set, or one set for each value of the field, in the order in which the
 * values occur first. Each feature whose value is null is a set by itself. */
bool gis_buffer_gather(gis_buffer *buffer, gis_error *error);
/* Computes all sets, on as many threads as the request says, and adds up their figures. */
bool gis_buffer_make(gis_buffer *buffer, gis_progress *progress, gis_error *error);
/* Computes one set by a single morphological operation (make_set.c). */
bool gis_buffer_make_set(const gis_buffer *buffer, gis_buffer_set *set, const sunder_sum_options *how,
                         gis_error *error);
/* *out becomes one shape of all members of the set. *deviation is raised to the largest distance by which rounding
 * moved a vertex of a repaired member. */
bool gis_buffer_join(const gis_buffer *buffer, const gis_buffer_set *set, sunder_shape **out, double *deviation,
                     gis_error *error);
void gis_buffer_set_clear(gis_buffer_set *set);
/* --align (turned_shape.c): *out becomes the shape, turned to the main direction of the set. */
bool gis_buffer_turned(const gis_buffer *buffer, const gis_buffer_set *set, sunder_shape **out, gis_error *error);
/* --align with --dissolve (align.c): computes a set block by block, with the shape turned for each block. */
bool gis_buffer_make_blocks(const gis_buffer *buffer, gis_buffer_set *set, const sunder_sum_options *how,
                            gis_error *error);
void gis_buffer_clear(gis_buffer *buffer);

/* Writes the layer LAYER and, if requested, LAYER_degenerate_segments and LAYER_degenerate_points. */
bool gis_write_buffer(gis_sink *sink, const gis_buffer *buffer, gis_error *error);

#endif
