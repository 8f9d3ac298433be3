/* sink.h: writing layers so that they appear together, or not at all.
 *
 *   gis_sink_open      checks what can be checked before the work: format, permission, what exists
 *   gis_sink_add       adds a layer; the first is the main one. Write it whole before adding the next:
 *   gis_sink_write     one feature
 *   gis_sink_finish    closes, and reads everything back
 *   gis_sink_publish   puts all in place
 *   gis_sink_free      when published: releases; else: undoes everything
 *
 * Files are made in a new directory beside the output and renamed into place, the main file last; an update of files
 * works on a copy. A database, SQLite files included, gets one transaction. /vsistdout/ gets the main layer only, when
 * it is complete. */
#ifndef GIS_SINK_H
#define GIS_SINK_H

#include "base/value.h"
#include "gpkg/layer_styles.h"
#include "read/source.h"

/* Where and how; zeroed members mean "not given". Strings and lists are borrowed until gis_sink_free(). */
typedef struct gis_sink_request {
    const char *path;
    const char *format;                 /* --of; NULL: from the name */
    const char *const *layer_options;   /* --lco */
    const char *const *dataset_options; /* --co, -dsco */
    const char *main_layer;             /* name of the main layer: --output-layer, else gis_source_name() ("sum") */
    const char *const *suffixes;        /* of the layers that will be added besides the main one: checked at once */
    bool overwrite, update, overwrite_layer;
    bool strict;        /* any loss is an error */
    bool allow_inexact; /* --allow-inexact-output */
    bool no_styles;
    bool promote;  /* -nlt PROMOTE_TO_MULTI: geometries of the main layer become ones of several */
    bool features; /* the main layer holds the features of the source */
    bool polygons; /* it holds polygons, or may */
    const char *scratch; /* a directory, on whose disk what is noted of each feature lies; NULL: in memory */
    unsigned threads;    /* 0: as many as there are processors */
    bool new_fids; /* features of the source are written more than once: FIDs are not kept, sunder_fid holds them */
} gis_sink_request;

typedef struct gis_sink gis_sink;
typedef struct gis_sink_layer gis_sink_layer;

/* source  the input, or NULL if there is none that is a dataset; must live until gis_sink_free().
 * Fails with one sentence, nothing touched: unknown format or one that cannot be written; output exists and neither
 * overwrite nor update is given; overwrite with update; input and output the same (save update with new names); a
 * directory missing or not writable; a format that reprojects, unless allow_inexact. */
bool gis_sink_open(const gis_sink_request *request, const gis_source *source, gis_sink **out, gis_error *error);

/* False for /vsistdout/: only the main layer is wanted. */
bool gis_sink_takes_more(const gis_sink *sink);
/* Are features that are given to gis_sink_write() and gis_sink_write_moved() needed until the end, to be compared? */
bool gis_sink_remembers(const gis_sink *sink);

typedef struct gis_field {
    const char *name;  /* at most 10 characters */
    OGRFieldType type; /* OFTInteger64, OFTReal, OFTString */
    int width;         /* for texts; 0: as the format likes */
} gis_field;

typedef struct gis_sink_layer_request {
    const char *suffix;       /* "" for the main layer; "displacement": the layer is MAIN_displacement, the file of a
                                one-layer format OUT_displacement.shp */
    bool like_source;         /* all fields of the source's layer come first, with their constraints; FIDs are kept */
    bool as_source;           /* and its geometry type and column names, identifier, description: the main layer */
    OGRwkbGeometryType type;  /* if not as_source */
    OGRSpatialReferenceH crs; /* where the sink has no source, whose CRS it is else; NULL: none */
    const gis_field *fields;  /* the program's own; one of the same name in the source is replaced, with a warning */
    size_t n_fields;
    OGRFieldDefnH copied; /* NULL, or one field of the source, which comes after those, if not like_source */
    gis_style style;
} gis_sink_layer_request;

/* The layer is owned by the sink. Fails if it exists already (without overwrite_layer), or GDAL cannot make it. */
bool gis_sink_add(gis_sink *sink, const gis_sink_layer_request *request, gis_sink_layer **out, gis_error *error);

/* Adds a sentence to the losses. */
void gis_sink_tell_loss(gis_sink_layer *layer, const char *sentence);

/* Does the format tell a null from 0 and from an empty text? */
bool gis_sink_has_null(const gis_sink_layer *layer);

/* Writes one feature.
 *
 * feature   of the source: its FID and attributes are written, for like_source layers; the value of the field that
 *           is copied, for those; else NULL
 * geometry  taken over, also on failure; NULL: a null geometry
 * values    n_fields of them, in the order of the request */
bool gis_sink_write(gis_sink_layer *layer, OGRFeatureH feature, OGRGeometryH geometry, const gis_value *values,
                    gis_error *error);

/* The same of a line from one place to another, into a layer that is not like the source. */
bool gis_sink_write_line(gis_sink_layer *layer, const double from[2], const double to[2], const gis_value *values,
                         gis_error *error);

/* A source feature moved by (dx, dy): the translate of its own geometry (null stays null). The memory of a copy. */
bool gis_sink_write_moved(gis_sink_layer *layer, OGRFeatureH feature, double dx, double dy, const gis_value *values,
                          gis_error *error);
/* The same of feature i of the sink's source, into a layer like it. */
bool gis_sink_write_source(gis_sink_layer *layer, size_t i, double dx, double dy, const gis_value *values,
                           gis_error *error);

typedef struct gis_sink_result {
    bool exact;       /* what reads back are the very doubles that were written: `verified` may stand */
    double deviation; /* else: the largest distance of a vertex from where it was sent; INFINITY: shapes changed,
                         or the geometries are not there */
    bool unread;      /* nothing can read them back */
} gis_sink_result;

/* Closes everything (errors of closing count; a transaction stays open), reads every feature back and compares it with
 * what was sent, applies strict: all that can fail, but for the last step. Once only. */
bool gis_sink_finish(gis_sink *sink, gis_sink_result *result, gis_error *error);
/* The last step: renames, or ends the transaction. On failure what was there before is there again. */
bool gis_sink_publish(gis_sink *sink, gis_error *error);
void gis_sink_free(gis_sink *sink);

/* What the format could not hold, a sentence each (a field is named once); complete when finished. */
const gis_sentences *gis_sink_losses(const gis_sink *sink);
/* Other things worth a warning (fields replaced, what GDAL said). */
const gis_sentences *gis_sink_warnings(const gis_sink *sink);

#endif
