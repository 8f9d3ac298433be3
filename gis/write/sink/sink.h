/* sink.h: writes layers so that all of them appear together, or none.
 *
 *  gis_sink_open      checks what can be checked before the work: format, permission, existing files
 *  gis_sink_add       adds a layer; the first is the main one. Write it whole before adding the next:
 *  gis_sink_write     writes one feature
 *  gis_sink_finish    closes all, and reads everything back
 *  gis_sink_publish   puts all in place
 *  gis_sink_free      releases a published sink; undoes everything else
 *
 * Files are made in a new directory beside the output and renamed into place, the main file last; an update of files
 * works on a copy. A database, SQLite files included, gets one transaction. /vsistdout/ gets only the main layer, when
 * it is complete. */
#ifndef GIS_SINK_H
#define GIS_SINK_H

#include "base/value.h"
#include "gpkg/layer_styles.h"
#include "read/source.h"

/* A main layer beside the first: its source, which must live until gis_sink_free(), and its name. */
typedef struct gis_sink_main {
    const gis_source *source;
    const char *name;
} gis_sink_main;

/* Where and how to write; zeroed members mean "not given". Strings and lists are borrowed until gis_sink_free(). */
typedef struct gis_sink_request {
    const char *path;
    const char *format;                 /* --of; NULL: the name of the output determines it */
    const char *const *layer_options;   /* --lco */
    const char *const *dataset_options; /* --co, -dsco */
    const char *main_layer;             /* name of the main layer: --output-layer, by default gis_source_name() ("sum"
                                         * without a source) */
    const gis_sink_main *more;          /* [n_more] the main layers besides it */
    size_t n_more;
    const char *prefix;          /* what the names of all other layers begin with; NULL: the main layer's name */
    const char *const *suffixes; /* suffixes of the layers that will be added besides the main one, so that
                                         * existing ones are noticed at once */
    bool overwrite, update, overwrite_layer;
    bool strict;        /* any loss is an error */
    bool allow_inexact; /* --allow-inexact-output */
    bool no_styles;
    bool promote;        /* -nlt PROMOTE_TO_MULTI: geometries of the main layer become multipolygons or multipoints */
    bool features;       /* the main layer holds the features of the source */
    bool polygons;       /* the main layer holds polygons, or may */
    const char *scratch; /* a directory for the hashes and boxes noted of each feature; NULL: in memory */
    unsigned threads;    /* 0: the number of processors */
    bool new_fids; /* features of the source are written more than once: FIDs are not kept, and the field sunder_fid
                    * holds them */
} gis_sink_request;

typedef struct gis_sink gis_sink;
typedef struct gis_sink_layer gis_sink_layer;

/* Opens a sink. `source` is the input dataset, or NULL if there is none; it must live until gis_sink_free().
 *
 * Fails with one sentence, before anything is changed: the format is unknown or cannot be written; the output exists
 * and neither overwrite nor update is given; overwrite is given with update; input and output are the same (but an
 * update with new layer names is allowed); a directory is missing or not writable; the format reprojects, and
 * allow_inexact is not given. */
bool gis_sink_open(const gis_sink_request *request, const gis_source *source, gis_sink **out, gis_error *error);

/* May layers besides the main one be added? False for /vsistdout/. */
bool gis_sink_takes_more(const gis_sink *sink);
/* Must features that are given to gis_sink_write() and gis_sink_write_moved() live until gis_sink_finish(), which
 * compares them? */
bool gis_sink_remembers(const gis_sink *sink);

typedef struct gis_field {
    const char *name;  /* at most 10 characters */
    OGRFieldType type; /* OFTInteger64, OFTReal, OFTString */
    int width;         /* for texts; 0: the format's default */
} gis_field;

typedef struct gis_sink_layer_request {
    const char *suffix;       /* "" for a main layer; "displacement" for the layer MAIN_displacement, which a
                               * one-layer format writes to OUT_displacement.shp */
    size_t main;              /* if like_source: 0 for the main layer, or 1 + the index in `more` */
    bool like_source;         /* the layer begins with all fields of the source's layer and their constraints, and FIDs
                               * are kept */
    bool as_source;           /* the layer also has the geometry type, column names, identifier and description of the
                               * source's: the main layer */
    OGRwkbGeometryType type;  /* the geometry type, if not as_source */
    OGRSpatialReferenceH crs; /* the CRS if the sink has no source (else the source's is used); NULL: none */
    const gis_field *fields;  /* the fields that the program adds; a field of the source with the same name is replaced,
                               * with a warning */
    size_t n_fields;
    OGRFieldDefnH copied; /* NULL, or one field of the source that follows `fields`, if not like_source */
    gis_style style;
} gis_sink_layer_request;

/* Adds a layer, which the sink owns. Fails if the layer exists already (without overwrite_layer), or GDAL cannot make
 * it. */
bool gis_sink_add(gis_sink *sink, const gis_sink_layer_request *request, gis_sink_layer **out, gis_error *error);

/* Adds `sentence` to the losses (gis_sink_losses()). */
void gis_sink_tell_loss(gis_sink_layer *layer, const char *sentence);

/* Does the format distinguish null from 0 and from an empty text? */
bool gis_sink_has_null(const gis_sink_layer *layer);

/* Writes one feature.
 *
 * feature   a feature of the source: like_source layers get its FID and attributes, layers with a
 *           copied field get its value of that field; else NULL
 * geometry  taken over, also on failure; NULL: a null geometry
 * values    n_fields values, in the order of the request */
bool gis_sink_write(gis_sink_layer *layer, OGRFeatureH feature, OGRGeometryH geometry, const gis_value *values,
                    gis_error *error);

/* Writes a feature whose geometry is the line from `from` to `to`, into a layer that is not like_source. */
bool gis_sink_write_line(gis_sink_layer *layer, const double from[2], const double to[2], const gis_value *values,
                         gis_error *error);

/* Writes `feature` with its own geometry translated by (dx, dy); a null geometry stays null. Uses the memory of one
 * copy. */
bool gis_sink_write_moved(gis_sink_layer *layer, OGRFeatureH feature, double dx, double dy, const gis_value *values,
                          gis_error *error);
/* Writes feature i of the layer's source, translated by (dx, dy), into a like_source layer. */
bool gis_sink_write_source(gis_sink_layer *layer, size_t i, double dx, double dy, const gis_value *values,
                           gis_error *error);
/* Writes feature i of the layer's source with another geometry, which the layer then owns, into a like_source layer. */
bool gis_sink_write_shaped(gis_sink_layer *layer, size_t i, OGRGeometryH geometry, const gis_value *values,
                           gis_error *error);

typedef struct gis_sink_result {
    bool exact;       /* the doubles that read back are the doubles that were written, so that `verified` may be
                       * claimed */
    double deviation; /* if not exact: the largest distance between a vertex as sent and as read; INFINITY: shapes
                       * changed, or geometries are missing */
    bool unread;      /* GDAL cannot read the format, so nothing was compared */
} gis_sink_result;

/* Closes everything (errors of closing count; a transaction stays open), reads every feature back and compares it with
 * what was sent, and applies `strict`. After it only gis_sink_publish() can fail. Call it once. */
bool gis_sink_finish(gis_sink *sink, gis_sink_result *result, gis_error *error);
/* Renames the files into place, or commits the transaction. On failure what was there before is there again. */
bool gis_sink_publish(gis_sink *sink, gis_error *error);
void gis_sink_free(gis_sink *sink);

/* What the format could not hold, one sentence each (a field is named once); complete after gis_sink_finish(). */
const gis_sentences *gis_sink_losses(const gis_sink *sink);
/* Other warnings: replaced fields, and what GDAL reported. */
const gis_sentences *gis_sink_warnings(const gis_sink *sink);

#endif
