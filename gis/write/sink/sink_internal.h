/* sink_internal.h: what the files of the sink share.
 *
 *   sink.c             requests, the life of a sink
 *   sink_checks.c      what is refused before the work
 *   sink_dataset.c     datasets made, opened for update, closed
 *   sink_database.c    the same of databases: locks and transactions
 *   sink_schema.c      layers made
 *   sink_type.c        ... of which kind of geometry
 *   sink_fields.c      ... with which fields
 *   sink_write.c       features: past GDAL, by it, or again with more digits
 *   sink_features.c    ... by GDAL, one by one
 *   sink_rewrite.c     a layer written again, with more digits
 *   digits.c           ... which coordinates need them
 *   sink_sent.c        features kept as they were sent
 *   sent_digests.c     ... or as two numbers each
 *   digest_list.c      the list of these
 *   sink_paths.c       names of files and layers
 *   sink_messages.c    what is said where features do not read back
 *   sink_rows.c        the same past GDAL, where all is plain
 *   sink_whole.c       what is kept of a layer besides these
 *   sink_registered.c  is it listed in a database, so that a reader finds it?
 *
 * and of write/readback/
 *
 *   sink_finish.c      closing, comparing, putting in place
 *   digests.c          what reads back beside what was sent, in formats that keep every value
 *   digest_rows.c      ... of a GeoPackage past GDAL, where all is plain
 *   compare_features.c the same where coordinates or rings may change
 *   compare_values.c   ... and values
 *   losses.c           what the format dropped */
#ifndef GIS_SINK_INTERNAL_H
#define GIS_SINK_INTERNAL_H

#include "base/interrupt.h"
#include "disk/stage.h"
#include "gpkg/gpkg_rtree.h"
#include "gpkg/sqlite_insert.h"
#include "write/sink/digest_list.h"
#include "write/sink/format.h"
#include "write/sink/sink.h"

/* One feature as it was sent, so that it can be compared: a source feature and its move, or a geometry of its own. */
typedef struct gis_sent {
    OGRFeatureH feature; /* borrowed from the source; NULL if it came from none */
    OGRGeometryH made;   /* owned; NULL: a null geometry, unless `moved` */
    bool moved;          /* it is the feature's own geometry, moved by (dx, dy) */
    double dx, dy;
} gis_sent;

/* What became of the values of one field, of the source or the program's own. */
typedef struct gis_field_change {
    int index;     /* of the field as written; -1: not there */
    size_t count;  /* values that read back as others */
    GIntBig first; /* the first feature with one */
    size_t nulls;  /* of the program's own: nulls that read back as values, not among the above */
} gis_field_change;

/* A field whose values are to read back as they were sent: of a plain type, without a default of its own. */
typedef struct gis_plain_field {
    char *name;
    int sent, read; /* where it is in the layer that is written, and in the one that is read */
    OGRFieldType type;
    int width; /* of a text; 0: any */
} gis_plain_field;

/* The features of a layer as numbers (digests.c). A zeroed struct is empty, and notes nothing. */
typedef struct gis_digests {
    bool wanted, with_fid, values_comparable;
    gis_plain_field *fields;
    size_t n_fields;
    gis_digest_list sent;
    size_t with_z; /* features with a third coordinate */
    double *xy;    /* room for the points of one ring */
    size_t room;
} gis_digests;

/* Rows past GDAL (sink_rows.c). A zeroed struct has not looked whether there can be any. */
typedef struct gis_sink_rows {
    bool closed;  /* there are none, or no more */
    bool offered; /* the last row is put together, whoever writes it */
    void *database;
    gis_sqlite_inserts inserts;
    unsigned char head[8]; /* of a geometry's blob */
    unsigned char *blob;
    size_t size, room;
    gis_value *value;   /* by field of the layer */
    size_t n;           /* rows so written */
    OGREnvelope around; /* ... and where they lie; in the end the whole layer */
} gis_sink_rows;

/* Was the row written, is it to be written by GDAL, or was there an error? */
typedef enum gis_row { GIS_ROW_DONE, GIS_ROW_GDAL, GIS_ROW_FAILED } gis_row;

struct gis_sink_layer {
    gis_sink *sink;
    gis_sink_layer_request request; /* its field list is copied */
    char *name;                     /* of the layer */
    char *file;                     /* base name of its file, where it has one of its own; else NULL */
    GDALDatasetH dataset;           /* NULL when closed */
    OGRLayerH layer;                /* NULL when closed */
    OGRwkbGeometryType type;        /* as asked for */
    bool has_encoding;              /* a Shapefile's file that tells it is asked for */
    bool promote;                   /* geometries become ones of several (gis_sink_promote()) */
    bool wind;                      /* rings are turned as Shapefiles want them before they are written */
    int *field_map;                 /* field of the source -> field of the layer, -1: not written */
    int *own;                       /* the program's own fields -> field of the layer */
    bool lists;                     /* some lists of the source become JSON texts */
    int fid_field;                  /* where sunder_fid is, or -1 */
    char **created;                 /* names of the layer's fields, by field of the source; "" where not written */
    char **own_created;             /* the same of the program's own, and of sunder_fid behind these */
    bool can_measure, can_curve;
    size_t written;
    gis_sink_rows rows;
    gis_rtree tree; /* the spatial index of a GeoPackage */
    bool promised;  /* `verified` speaks of its features */
    gis_digests digests;
    bool keep_sent;
    gis_sent *sent;
    size_t n_sent, capacity;
    bool can_rewrite;              /* numbers are decimals, and how many digits they get is ours to choose */
    bool more_digits;              /* than tell a double: the layer is written for the second time */
    gis_value *sent_values;        /* with keep_sent: n_fields for each that was sent, texts owned */
    size_t values_room;            /* for so many features */
    gis_field_change *changes;     /* by field of the source; NULL: not looked for */
    gis_field_change *own_changes; /* the same of the program's own fields, by field of the request */
    gis_field_change fid_change;   /* the same of FIDs, wherever they were written */
};

typedef enum gis_sink_place {
    GIS_PLACE_FILE,    /* staged beside the output, renamed */
    GIS_PLACE_MEMORY,  /* staged in memory, copied out: /vsistdout/ and other virtual files */
    GIS_PLACE_DATABASE /* one transaction */
} gis_sink_place;

struct gis_sink {
    gis_sink_request request;
    const gis_source *source;
    gis_format format;
    gis_sink_place place;
    bool to_stdout;
    bool updating;        /* the output exists and gets more layers */
    bool fids_kept;       /* FIDs of the source are set; else sunder_fid holds them */
    gis_stage *stage;     /* of GIS_PLACE_FILE */
    char *memory;         /* directory of GIS_PLACE_MEMORY, and of what is only written */
    char *main_file;      /* base name of the main file in the stage */
    GDALDatasetH dataset; /* the one that holds all layers, unless each has its own */
    GDALDatasetH reader;  /* of a SQLite file in a transaction: holds everyone's commit back by its open result */
    OGRLayerH reading;
    gis_leftover *journal; /* of the same: until the commit the file is not written, and nothing waits for it */
    bool in_transaction, published, set_date, set_rewind;
    gis_sink_layer **layers;
    size_t n_layers;
    gis_sentences losses, warnings;
};

/* Is it the main layer, with the fields of the source? Then losses of these are reported, once. */
static inline bool gis_sink_tells(const gis_sink_layer *layer)
{
    return layer->request.like_source && !layer->request.suffix[0];
}

/* Path of a file in the stage or in memory, or the connection of a database; CPLFree(). */
char *gis_sink_inside(const gis_sink *sink, const char *file);
/* Name of the layer with this suffix, and its file in a one-layer format; CPLFree(). */
char *gis_sink_name_for(const gis_sink *sink, const char *suffix);
char *gis_sink_file_for(const gis_sink *sink, const char *suffix);

/* For any path that GDAL knows. */
bool gis_sink_exists(const char *path);
bool gis_sink_is_directory(const char *path);

/* Is something in the way of the output, or the output in the way of something? Sets sink->updating, and finds that a
 * SQLite file to be updated is a database. */
bool gis_sink_check_existing(gis_sink *sink, gis_error *error);
/* Has it geometries of the kind that will be written? */
bool gis_sink_check_type(const gis_sink *sink, gis_error *error);
/* Would it drop features that have no geometry? */
bool gis_sink_check_geometries(const gis_sink *sink, gis_error *error);
/* Would the format turn the coordinates to WGS 84, unasked? */
bool gis_sink_check_reprojection(const gis_sink *sink, gis_error *error);

bool gis_sink_dataset_for(gis_sink *sink, gis_sink_layer *layer, gis_error *error);
bool gis_sink_open_for_update(gis_sink *sink, gis_error *error);
bool gis_sink_begin_transaction(gis_sink *sink, gis_error *error);
/* Both of these for a SQLite file, with its write lock. */
bool gis_sink_open_sqlite(gis_sink *sink, gis_error *error);
/* Is the transaction of a SQLite file still the one that was begun? */
bool gis_sink_unbroken(gis_sink *sink, gis_error *error);
/* Takes a layer of this name away, if that was asked for; else it fails where there is one. */
bool gis_sink_make_room(gis_sink *sink, const char *name, gis_error *error);
/* A database may have put off rows of the last layer written: sends them, and hears what it thinks of them. */
bool gis_sink_flush(gis_sink *sink, gis_error *error);
/* Commits the transaction of the common dataset, if one is open. */
bool gis_sink_end_transaction(gis_sink *sink, gis_error *error);
/* Takes back what the transaction wrote, if one is open; GDAL writes nothing more. */
void gis_sink_roll_back(gis_sink *sink);
/* Closes the dataset of a layer that has its own, or with NULL the common one; errors of closing fail. */
bool gis_sink_close(gis_sink *sink, gis_sink_layer *layer, gis_error *error);
void gis_sink_drop(gis_sink *sink); /* closes without asking, rolls back */

bool gis_sink_create_layer(gis_sink_layer *layer, gis_error *error);
/* Sets layer->type and layer->promote. */
void gis_sink_choose_type(gis_sink_layer *layer);
/* Makes the geometry of a feature one of several, as the layer is declared. */
void gis_sink_promote(const gis_sink_layer *layer, OGRFeatureH to);
/* Makes the fields; sets field_map, created, own and fid_field. */
void gis_sink_create_fields(gis_sink_layer *layer);
/* The fields of the source, if the layer has them; else NULL. */
OGRFeatureDefnH gis_sink_source_fields(const gis_sink_layer *layer);
/* Has the layer a field of this name that is not the source's? */
bool gis_sink_makes_field(const gis_sink_layer *layer, const char *name);
/* Compares the fields, type and CRS of the layer in the dataset with the requested ones; adds losses, one sentence for
 * each field, which also tells how its values changed. */
void gis_sink_find_losses(gis_sink_layer *layer, OGRLayerH as_written);

/* Is the source's geometry written? One with a coordinate that is no finite number, which --invalid skip lets through,
 * is left out: drivers refuse it, or write it so that it is no number any more. */
static inline bool gis_sink_holds(const gis_sink_layer *layer, OGRGeometryH geometry)
{
    return gis_source_content_count(layer->sink->source, GIS_BROKEN) == 0 || gis_geometry_is_finite(geometry);
}

/* The CRS that the layer was given. */
static inline OGRSpatialReferenceH gis_sink_crs(const gis_sink_layer *layer)
{
    return layer->sink->source ? gis_source_crs(layer->sink->source) : layer->request.crs;
}

/* Shapefiles keep the CRS and the encoding in small files of their own, and GDAL does not hear whether those are
 * written. Fails if one is not there. */
bool gis_sink_check_companions(const gis_sink_layer *layer, OGRLayerH as_written, gis_error *error);

/* Fails with the sentence that says how many features came back of those written. */
bool gis_sink_fail_count(const gis_sink_layer *layer, size_t read_back, gis_error *error);
/* Fails with a sentence that gives the driver's report after `after` features. */
bool gis_sink_fail_reading(const gis_sink_layer *layer, size_t after, const char *reason, gis_error *error);

/* The layer and its fields are made: its features will be noted. */
void gis_digests_begin(gis_sink_layer *layer);
/* Notes a feature that was written, with the FID that it was to get: GDAL forgets a FID of 0. */
bool gis_digests_add(gis_digests *all, OGRFeatureH feature, GIntBig fid, gis_error *error);
/* The same of a Polygon or MultiPolygon in the plane, as well-known binary, and of values by field of the layer. */
bool gis_digests_add_plain(gis_digests *all, GIntBig fid, const unsigned char *geometry, const gis_value *values,
                           gis_error *error);
/* Reads every feature of the written layer, and fails unless all are as they were sent. dataset: the one that it is in,
 * opened to be read; NULL: it is the one that was written, in its transaction. */
bool gis_digests_agree(gis_sink_layer *layer, GDALDatasetH dataset, OGRLayerH as_written, gis_error *error);
void gis_digests_clear(gis_digests *all);

/* Writes feature i of the source, moved, if that can be done past GDAL. */
gis_row gis_sink_row(gis_sink_layer *layer, size_t i, double dx, double dy, const gis_value *values, gis_error *error);
/* The same of a line (gis_sink_write_line()). */
gis_row gis_sink_line(gis_sink_layer *layer, const double from[2], const double to[2], const gis_value *values,
                      gis_error *error);
/* GDAL wrote the last one. */
void gis_sink_row_by_gdal(gis_sink_layer *layer, GIntBig fid);
/* All are written; to be called before GDAL notes how many. */
bool gis_sink_rows_end(gis_sink_layer *layer, gis_error *error);
void gis_sink_rows_clear(gis_sink_layer *layer);

void gis_sink_widen(OGREnvelope *around, const OGREnvelope *box);
/* For a layer with rows written past GDAL: its count and its extent (layer->rows.around, and what GDAL wrote) are set
 * to those of all rows, whenever GDAL writes them. */
bool gis_sink_note_whole(gis_sink_layer *layer, void *database, gis_error *error);
/* Does the file tell of that many, and of no less an extent? */
bool gis_sink_check_whole(const gis_sink_layer *layer, OGRLayerH as_written, gis_error *error);

/* ---- sink_registered.c ------------------------------------------------------------------------------------------- */

/* For a layer that was added to a database, once all of its rows are written: is it listed as a reader expects? */
bool gis_sink_check_registered(const gis_sink_layer *layer, gis_error *error);

/* Keeps a feature as it was sent; takes its geometry over, also on failure. */
bool gis_sink_remember(gis_sink_layer *layer, gis_sent sent, gis_error *error);
void gis_sink_forget_sent(gis_sink_layer *layer);
/* Keeps the values of the feature that was remembered last; NULL: it has none of the program's own. */
bool gis_sink_remember_values(gis_sink_layer *layer, const gis_value *values, gis_error *error);
void gis_sink_forget_values(gis_sink_layer *layer);
/* The values that were sent for feature i; NULL: none are kept. */
const gis_value *gis_sink_sent_values(const gis_sink_layer *layer, size_t i);
/* Would more digits keep what was seen to change? */
bool gis_sink_may_rewrite(const gis_sink_layer *layer, const gis_sink_result *seen);
/* Would some coordinate, written with the digits that a layer is begun with, read back as another (digits.c)? */
bool gis_sink_loses_digits(OGRGeometryH geometry);
/* One feature, given to GDAL and remembered: as gis_sink_write() and gis_sink_write_moved(), but that the layer is not
 * begun again; *more: it should be, with more digits. NULL: that is not asked. */
bool gis_sink_put(gis_sink_layer *layer, OGRFeatureH feature, OGRGeometryH geometry, const gis_value *values,
                  bool *more, gis_error *error);
bool gis_sink_put_moved(gis_sink_layer *layer, OGRFeatureH feature, double dx, double dy, const gis_value *values,
                        bool *more, gis_error *error);
/* As gis_sink_write_source(), by GDAL, of a layer that keeps nothing of what is sent. */
bool gis_sink_put_source(gis_sink_layer *layer, size_t i, double dx, double dy, const gis_value *values,
                         gis_error *error);
/* Begins the layer, which is closed, with more digits, and sends again what was sent. */
bool gis_sink_send_again(gis_sink_layer *layer, gis_error *error);
/* Writes the layer, which is closed, again with more digits, and closes it. */
bool gis_sink_rewrite(gis_sink_layer *layer, gis_error *error);
/* The field of exactly this name, else of one that differs in case only; -1: there is none, or the name is empty. */
int gis_sink_field_index(OGRFeatureDefnH definition, const char *name);
/* Values of the layer as it reads are to be compared with those sent: fills changes, own_changes, fid_change. */
bool gis_sink_begin_values(gis_sink_layer *layer, OGRLayerH as_written, gis_error *error);
/* Compares those of feature i of what was sent, if that was begun. */
bool gis_sink_compare_values(gis_sink_layer *layer, size_t i, OGRFeatureH kept, gis_error *error);
/* Compares the features of a written layer with what was sent; lowers result->exact, raises ->deviation, fills
 * changes. */
bool gis_sink_compare(gis_sink_layer *layer, OGRLayerH as_written, gis_sink_result *result, gis_error *error);

#endif
