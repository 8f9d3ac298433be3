/* sink_internal.h: what the files of the sink share.
 *
 *  sink.c             requests, opening and freeing a sink
 *  sink_checks.c      what is refused before the work
 *  sink_dataset.c     datasets: made, opened for update, closed
 *  sink_database.c    databases: locks and transactions
 *  sink_schema.c      layers: made with the properties of the source
 *  sink_type.c        ... their geometry type
 *  sink_fields.c      ... their fields
 *  sink_write.c       features: through SQLite, through GDAL, or again with more digits
 *  sink_features.c    ... by GDAL, one by one
 *  sink_rows.c        ... as rows through SQLite, where everything is plain
 *  sink_rewrite.c     a layer written again with more digits
 *  digits.c           ... which coordinates need them
 *  sink_sent.c        features kept as they were sent
 *  sent_digests.c     ... or as two hashes each
 *  digest_list.c      the list of these hashes
 *  sink_paths.c       names of files and layers
 *  sink_messages.c    messages about features that do not read back
 *  sink_whole.c       feature count and extent of a layer
 *  sink_registered.c  is the layer listed in its database, so that a reader finds it?
 *
 * and of write/readback/
 *
 *  sink_finish.c      closes, compares, puts in place
 *  digests.c          compares hashes, in formats that keep every value
 *  digest_rows.c      ... read from a GeoPackage through SQLite, where everything is plain
 *  compare_features.c compares features whose coordinates or rings may change
 *  compare_values.c   ... and their values
 *  losses.c           what the format dropped */
#ifndef GIS_SINK_INTERNAL_H
#define GIS_SINK_INTERNAL_H

#include "base/interrupt.h"
#include "disk/stage.h"
#include "gpkg/gpkg_rtree.h"
#include "gpkg/sqlite_insert.h"
#include "write/sink/digest_list.h"
#include "write/sink/format.h"
#include "write/sink/sink.h"

/* One feature as it was sent, kept for comparison: a source feature and its move, or a geometry. */
typedef struct gis_sent {
    OGRFeatureH feature; /* borrowed from the source; NULL: not a feature of the source */
    OGRGeometryH made;   /* owned; NULL: a null geometry, unless `moved` */
    bool moved;          /* the geometry that was sent is that of `feature`, translated by (dx, dy) */
    double dx, dy;
} gis_sent;

/* How the values of one field (of the source, or added by the program) changed in the written layer. */
typedef struct gis_field_change {
    int index;     /* of the field in the written layer; -1: missing */
    size_t count;  /* number of values that read back differently */
    GIntBig first; /* FID of the first feature with such a value */
    size_t nulls;  /* in added fields: number of nulls that read back as values, not included in `count` */
} gis_field_change;

/* A field whose values must read back as they were sent: of a plain type, without a default. */
typedef struct gis_plain_field {
    char *name;
    int sent, read; /* its number in the layer that is written, and in the layer that is read back */
    OGRFieldType type;
    int width; /* maximal width of a text; 0: unlimited */
} gis_plain_field;

/* The hashes of a layer's features (digests.c). A zeroed struct is empty and, until `wanted` is set, stays so. */
typedef struct gis_digests {
    bool wanted, with_fid, values_comparable;
    gis_plain_field *fields;
    size_t n_fields;
    gis_digest_list sent;
    size_t with_z; /* number of features with Z values */
    double *xy;    /* buffer for the points of one ring */
    size_t room;
} gis_digests;

/* Rows written through SQLite (sink_rows.c). In a zeroed struct it is not yet decided whether this is possible. */
typedef struct gis_sink_rows {
    bool closed;  /* no rows, or no more rows, are written through SQLite */
    bool offered; /* the last row could be composed, whether SQLite or GDAL writes it */
    void *database;
    gis_sqlite_inserts inserts;
    unsigned char head[8]; /* the first bytes of a geometry blob, as GDAL writes them */
    unsigned char *blob;
    size_t size, room;
    gis_value *value;   /* the values of a row, by field of the layer */
    size_t n;           /* number of rows written through SQLite */
    OGREnvelope around; /* their extent; after gis_sink_rows_end() that of the whole layer */
} gis_sink_rows;

/* What became of a row: written, left for GDAL to write, or an error. */
typedef enum gis_row { GIS_ROW_DONE, GIS_ROW_GDAL, GIS_ROW_FAILED } gis_row;

struct gis_sink_layer {
    gis_sink *sink;
    const gis_source *source;       /* of the main layer that it is, or belongs to; NULL: there is none */
    gis_sink_layer_request request; /* its list of fields is copied */
    char *name;                     /* name of the layer */
    char *file;                     /* base name of the layer's file, if it has one of its own; else NULL */
    GDALDatasetH dataset;           /* NULL when closed */
    OGRLayerH layer;                /* NULL when closed */
    OGRwkbGeometryType type;        /* as requested */
    bool has_encoding;              /* a Shapefile that should have a file with its encoding (.cpg) */
    bool promote;                   /* geometries are converted to multi types (gis_sink_promote()) */
    bool wind;                      /* rings are oriented as Shapefiles require before they are written */
    int *field_map;                 /* number of a source field -> number of the layer's field; -1: not written */
    int *own;                       /* number of an added field -> number of the layer's field */
    bool lists;                     /* some lists of the source are written as JSON text */
    int fid_field;                  /* number of the field sunder_fid, or -1 */
    char **created;                 /* names of the layer's fields, by field of the source; "": not written */
    char **own_created;             /* names of the layer's fields, by added field; sunder_fid's is the last */
    bool can_measure, can_curve;
    size_t written;
    gis_sink_rows rows;
    gis_rtree tree; /* the spatial index of a GeoPackage */
    bool promised;  /* `verified` covers the features of this layer */
    gis_digests digests;
    bool keep_sent;
    gis_sent *sent;
    size_t n_sent, capacity;
    bool can_rewrite;              /* numbers are printed in decimal, and the user left the number of digits to the
                                    * program */
    bool more_digits;              /* the layer is written for the second time, with more digits than a double needs */
    gis_value *sent_values;        /* with keep_sent: n_fields values for each feature sent; texts are owned */
    size_t values_room;            /* the number of features that sent_values has room for */
    gis_field_change *changes;     /* changes by field of the source; NULL: not compared */
    gis_field_change *own_changes; /* changes by added field */
    gis_field_change fid_change;   /* changes of FIDs, stored as FIDs or in sunder_fid */
};

typedef enum gis_sink_place {
    GIS_PLACE_FILE,    /* staged beside the output, then renamed */
    GIS_PLACE_MEMORY,  /* staged in memory, then copied: /vsistdout/ and other virtual files */
    GIS_PLACE_DATABASE /* written in one transaction */
} gis_sink_place;

struct gis_sink {
    gis_sink_request request;
    const gis_source *source; /* of the first main layer, or NULL */
    gis_format format;
    gis_sink_place place;
    bool to_stdout;
    bool updating;        /* the output exists, and layers are added to it */
    bool fids_kept;       /* written features have the FIDs of the source; if false, sunder_fid holds these */
    gis_stage *stage;     /* for GIS_PLACE_FILE */
    char *memory;         /* directory in memory, for GIS_PLACE_MEMORY and write-only formats */
    char *main_file;      /* base name of the main file in the stage */
    GDALDatasetH dataset; /* the dataset of all layers, unless each layer has its own */
    GDALDatasetH reader;  /* a second connection to a SQLite file, whose open result keeps every process from
                           * committing */
    OGRLayerH reading;
    gis_leftover *journal; /* the SQLite file's -journal, which may be removed until the commit */
    bool in_transaction, published, set_date, set_rewind;
    gis_sink_layer **layers;
    size_t n_layers;
    gis_sentences losses, warnings;
};

/* Is this the main layer, with the fields of the source? Losses of these are reported for this layer only. */
static inline bool gis_sink_tells(const gis_sink_layer *layer)
{
    return layer->request.like_source && !layer->request.suffix[0];
}

/* Path of `file` in the stage or in memory, or the connection of a database; CPLFree(). */
char *gis_sink_inside(const gis_sink *sink, const char *file);
/* The sources of all main layers, by their numbers. */
static inline const gis_source *gis_sink_source(const gis_sink *sink, size_t main)
{
    return main ? sink->request.more[main - 1].source : sink->source;
}
/* Does the file belong to one of the sources? */
bool gis_sink_is_input(const gis_sink *sink, const char *path);
/* Name of the layer with this suffix, and of its file in a one-layer format; CPLFree(). */
char *gis_sink_name_for(const gis_sink *sink, const char *suffix);
/* Name of a layer; what is like a source begins with the name of its main layer. CPLFree(). */
char *gis_sink_name_of(const gis_sink *sink, const gis_sink_layer_request *request);
char *gis_sink_file_for(const gis_sink *sink, const char *suffix);

/* Does a file or directory with this path exist? The path may be any that GDAL knows. */
bool gis_sink_exists(const char *path);
bool gis_sink_is_directory(const char *path);

/* Fails if the output exists and may not be replaced, is an input, or is in use. Sets sink->updating, and place =
 * GIS_PLACE_DATABASE for a SQLite file that is updated. */
bool gis_sink_check_existing(gis_sink *sink, gis_error *error);
/* Fails if the format cannot hold the geometry types that will be written. */
bool gis_sink_check_type(const gis_sink *sink, gis_error *error);
/* Fails if the format would drop features without geometry and the source has some. */
bool gis_sink_check_geometries(const gis_sink *sink, gis_error *error);
/* Fails if the format holds only WGS 84 and the source has another CRS; also, without --allow-inexact-output, if the
 * format would reproject the coordinates to WGS 84 or can be written but not read. */
bool gis_sink_check_reprojection(const gis_sink *sink, gis_error *error);

bool gis_sink_dataset_for(gis_sink *sink, gis_sink_layer *layer, gis_error *error);
bool gis_sink_open_for_update(gis_sink *sink, gis_error *error);
bool gis_sink_begin_transaction(gis_sink *sink, gis_error *error);
/* Opens a SQLite file for update and begins the transaction, with its write lock. */
bool gis_sink_open_sqlite(gis_sink *sink, gis_error *error);
/* Fails if SQLite has ended the transaction that was begun. */
bool gis_sink_unbroken(gis_sink *sink, gis_error *error);
/* Removes the layer with this name if overwrite_layer was given; fails if the layer exists otherwise. */
bool gis_sink_make_room(gis_sink *sink, const char *name, gis_error *error);
/* Has GDAL send rows of the last layer that it may have deferred, and fails if an error is reported. */
bool gis_sink_flush(gis_sink *sink, gis_error *error);
/* Commits the transaction of the common dataset, if one is open. */
bool gis_sink_end_transaction(gis_sink *sink, gis_error *error);
/* Rolls the transaction back, if one is open, and keeps GDAL from writing more. */
void gis_sink_roll_back(gis_sink *sink);
/* Closes the dataset of a layer that has its own; with layer == NULL, the common dataset. Errors while closing are
 * failures. */
bool gis_sink_close(gis_sink *sink, gis_sink_layer *layer, gis_error *error);
void gis_sink_drop(gis_sink *sink); /* closes everything, ignores errors, rolls back */

bool gis_sink_create_layer(gis_sink_layer *layer, gis_error *error);
/* Sets layer->type and layer->promote. */
void gis_sink_choose_type(gis_sink_layer *layer);
/* Converts the geometry of a feature to a multi type, as the layer's type requires. */
void gis_sink_promote(const gis_sink_layer *layer, OGRFeatureH to);
/* Makes the layer's fields; sets field_map, created, own and fid_field. */
void gis_sink_create_fields(gis_sink_layer *layer);
/* The definition of the source's fields, if the layer has them; else NULL. */
OGRFeatureDefnH gis_sink_source_fields(const gis_sink_layer *layer);
/* Does the layer have a field of this name that does not come from the source? */
bool gis_sink_makes_field(const gis_sink_layer *layer, const char *name);
/* Compares the fields, type and CRS of the written layer with the requested ones. Adds losses, one sentence for each
 * field, which also says how its values changed. */
void gis_sink_find_losses(gis_sink_layer *layer, OGRLayerH as_written);

/* May this geometry of the source be written? A geometry with a coordinate that is not finite, which --invalid skip
 * lets through, is left out: drivers refuse it, or write it as something that is not a number. */
static inline bool gis_sink_holds(const gis_sink_layer *layer, OGRGeometryH geometry)
{
    return gis_source_content_count(layer->source, GIS_BROKEN) == 0 || gis_geometry_is_finite(geometry);
}

/* The CRS that the written layer should have. */
static inline OGRSpatialReferenceH gis_sink_crs(const gis_sink_layer *layer)
{
    return layer->source ? gis_source_crs(layer->source) : layer->request.crs;
}

/* Fails if the CRS (.prj) or the encoding (.cpg) of a Shapefile is missing. They are in small files of their own, and
 * GDAL does not notice if they cannot be written. */
bool gis_sink_check_companions(const gis_sink_layer *layer, OGRLayerH as_written, gis_error *error);

/* Fails with a message that says that read_back features were read of layer->written. */
bool gis_sink_fail_count(const gis_sink_layer *layer, size_t read_back, gis_error *error);
/* Fails with a message that gives the driver's report and the number `after` of features read before it. */
bool gis_sink_fail_reading(const gis_sink_layer *layer, size_t after, const char *reason, gis_error *error);

/* Starts collecting hashes; called when the layer and its fields have been made. */
void gis_digests_begin(gis_sink_layer *layer);
/* Adds the hashes of a feature that was written. `fid` is the FID that it should get, since GDAL drops a FID of 0. */
bool gis_digests_add(gis_digests *all, OGRFeatureH feature, GIntBig fid, gis_error *error);
/* Adds the hashes of a feature given as well-known binary (two-dimensional Polygon, MultiPolygon or LineString) and
 * values by field of the layer. */
bool gis_digests_add_plain(gis_digests *all, GIntBig fid, const unsigned char *geometry, const gis_value *values,
                           gis_error *error);
/* Reads every feature of the written layer, and fails unless all are as they were sent. `dataset` is the dataset that
 * holds the layer, opened for reading; NULL: the layer is read in the transaction in which it was written. */
bool gis_digests_agree(gis_sink_layer *layer, GDALDatasetH dataset, OGRLayerH as_written, gis_error *error);
void gis_digests_clear(gis_digests *all);

/* Writes feature i of the source, translated by (dx, dy), as a row through SQLite if that is possible (else
 * GIS_ROW_GDAL). */
gis_row gis_sink_row(gis_sink_layer *layer, size_t i, double dx, double dy, const gis_value *values, gis_error *error);
/* Writes a line through SQLite, as gis_sink_row() does a feature (gis_sink_write_line()). */
gis_row gis_sink_line(gis_sink_layer *layer, const double from[2], const double to[2], const gis_value *values,
                      gis_error *error);
/* To be called after GDAL wrote a row: the first such row shows whether later ones can be written through SQLite. `fid`
 * is its FID. */
void gis_sink_row_by_gdal(gis_sink_layer *layer, GIntBig fid);
/* Writes the rows that wait, before GDAL writes one. */
bool gis_sink_rows_flush(gis_sink_layer *layer, gis_error *error);
/* Ends writing through SQLite; to be called when all rows are written, before GDAL stores the feature count. */
bool gis_sink_rows_end(gis_sink_layer *layer, gis_error *error);
void gis_sink_rows_clear(gis_sink_layer *layer);

void gis_sink_widen(OGREnvelope *around, const OGREnvelope *box);
/* For a layer with rows written through SQLite: makes the feature count and the extent that GDAL stores those of all
 * rows (layer->rows.around is widened by GDAL's rows), whenever GDAL stores them. */
bool gis_sink_note_whole(gis_sink_layer *layer, void *database, gis_error *error);
/* For a layer with rows written through SQLite: fails if the file's feature count is not the number of rows written, or
 * if its extent does not contain the boxes of all of them. */
bool gis_sink_check_whole(const gis_sink_layer *layer, OGRLayerH as_written, gis_error *error);

/* ---- sink_registered.c ------------------------------------------------------------------------------------------- */

/* Fails if a layer that was added to a database, with all its rows written, is not listed in the database as readers
 * expect. */
bool gis_sink_check_registered(const gis_sink_layer *layer, gis_error *error);

/* Keeps a feature as it was sent; takes its geometry over, also on failure. */
bool gis_sink_remember(gis_sink_layer *layer, gis_sent sent, gis_error *error);
void gis_sink_forget_sent(gis_sink_layer *layer);
/* Keeps the values of the feature that was remembered last; NULL: it has no values of added fields. */
bool gis_sink_remember_values(gis_sink_layer *layer, const gis_value *values, gis_error *error);
void gis_sink_forget_values(gis_sink_layer *layer);
/* The values that were sent with feature i; NULL: none are kept. */
const gis_value *gis_sink_sent_values(const gis_sink_layer *layer, size_t i);
/* Could writing the layer with more digits keep what changed? */
bool gis_sink_may_rewrite(const gis_sink_layer *layer, const gis_sink_result *seen);
/* Would a coordinate of `geometry`, printed with 17 digits by GDAL, read back as another double (digits.c)? */
bool gis_sink_loses_digits(OGRGeometryH geometry);
/* Writes and remembers one feature like gis_sink_write() and gis_sink_write_moved(), but does not rewrite the layer;
 * instead *more is set if the layer must be written again with more digits. With more == NULL that is not checked. */
bool gis_sink_put(gis_sink_layer *layer, OGRFeatureH feature, OGRGeometryH geometry, const gis_value *values,
                  bool *more, gis_error *error);
bool gis_sink_put_moved(gis_sink_layer *layer, OGRFeatureH feature, double dx, double dy, const gis_value *values,
                        bool *more, gis_error *error);
/* Writes feature i of the source with GDAL, into a layer that does not remember what is sent (see
 * gis_sink_write_source()). */
bool gis_sink_put_source(gis_sink_layer *layer, size_t i, double dx, double dy, const gis_value *values,
                         gis_error *error);
/* Makes the closed layer again, with more digits, and sends all remembered features again. */
bool gis_sink_send_again(gis_sink_layer *layer, gis_error *error);
/* Writes the closed layer again, with more digits, and closes it. */
bool gis_sink_rewrite(gis_sink_layer *layer, gis_error *error);
/* The index of the field called `name`, or else of one whose name differs in case only; -1: there is none, or the name
 * is empty. */
int gis_sink_field_index(OGRFeatureDefnH definition, const char *name);
/* Prepares the comparison of values: allocates changes and own_changes, and finds the fields in the layer that is
 * read. */
bool gis_sink_begin_values(gis_sink_layer *layer, OGRLayerH as_written, gis_error *error);
/* Compares the values of `kept` with those sent with feature i, if gis_sink_begin_values() was called. */
bool gis_sink_compare_values(gis_sink_layer *layer, size_t i, OGRFeatureH kept, gis_error *error);
/* Compares the features of a written layer with those sent: clears result->exact, raises result->deviation, fills
 * `changes`. */
bool gis_sink_compare(gis_sink_layer *layer, OGRLayerH as_written, gis_sink_result *result, gis_error *error);

#endif
