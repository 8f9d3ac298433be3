/* source.h: reading one layer, as ogr2ogr would select it.
 *
 * All selected features are read and kept, attributes and all, so that they can be written back with nothing lost: as
 * OGR features, or packed (packed.h). Or they are read a batch at a time, for layers that memory does not hold: then
 * feature i is the i-th of the batch. The dataset stays open until gis_source_close(). */
#ifndef GIS_SOURCE_H
#define GIS_SOURCE_H

#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include "base/gis_error.h"
#include "base/value.h"
#include "geometry/geometry.h"

/* Kinds of layer that a command takes; combine with |. A layer of unknown type, or of collections, counts as all. */
enum { GIS_TAKES_POLYGONS = 1, GIS_TAKES_POINTS = 2, GIS_TAKES_LINES = 4 };

/* What becomes of a feature that has a coordinate which is no finite number. */
typedef enum gis_not_finite {
    GIS_NOT_FINITE_REFUSED, /* reading fails and names it */
    GIS_NOT_FINITE_KEPT,    /* it is kept as it is, its content is GIS_BROKEN, and the caller warns of it */
    GIS_NOT_FINITE_LEFT_OUT /* it is warned of, and not kept */
} gis_not_finite;

/* What is known of a layer only when all of it was read. */
typedef struct gis_source_facts {
    size_t features, content[GIS_CONTENTS]; /* how many are of each content */
    bool fids_unique;                       /* all FIDs are set and different */
    bool fids_negative;                     /* at least one FID is less than 0 */
    bool multipolygons;                     /* there is a MultiPolygon */
} gis_source_facts;

/* What to read: features of a layer of the source at `path`; zeroed members mean "not given". Strings are borrowed for
 * the call. Lists end with NULL. */
typedef struct gis_source_request {
    const char *path;
    const char *const *drivers;      /* --if */
    const char *const *open_options; /* --oo */
    const char *layer;               /* --input-layer; not together with sql */
    const char *sql, *dialect;       /* --sql, --dialect */
    const char *where;               /* --where */
    const double *bbox;              /* --bbox: xmin, ymin, xmax, ymax */
    const char *input_crs;           /* --input-crs: replaces the layer's */
    unsigned takes;                  /* GIS_TAKES_...: not from an option; the command sets it */
    const char *layer_option;        /* how messages call what chooses the layer, and the features; NULL: as above */
    const char *where_option;
    const char *layer_like; /* where no layer is named: one of this name, if there is one */
    /* NULL, or tells, once the layer and its CRS are known, which box features have to meet; false: any will do. It may
     * read the layer. Not together with bbox or sql. */
    bool (*within)(void *user, OGRLayerH layer, OGRSpatialReferenceH crs, double box[4]);
    /* NULL, or tells of each feature as it is read whether it is wanted. One that is not is not looked at, even if a
     * coordinate is not finite. */
    bool (*wants)(void *user, OGRSpatialReferenceH crs, OGRFeatureH feature);
    void *user;       /* of these two; wants is called as long as the source is read */
    bool packed;      /* features are packed where they can be: one at a time is asked for, and by one thread */
    unsigned threads; /* to read on; 0: as many as there are processors */
    size_t batch; /* at most this many features are read at a time, fewer if they are large; 0: all */
    const gis_source_facts *facts; /* NULL, or the result of an earlier reading of the same source */
    gis_not_finite not_finite;
    bool fids_mean_nothing; /* FIDs are known not to be unique: gis_source_mark() does not go by them */
} gis_source_request;

typedef struct gis_source gis_source;

/* Opens, chooses the layer and reads it. GDALAllRegister() must have been called.
 *
 * Fails with one sentence: no such file, not readable by GDAL, no such layer (the layers there are listed), several
 * layers of a fitting kind and none named (they are listed), a layer of another kind, no geometry column, a bad --where
 * or --sql or CRS, a coordinate that is not finite (naming layer and FID) unless the request says otherwise, a read
 * error midway. A layer without
 * features, or a filter that selects none, is no error: n = 0. */
bool gis_source_open(const gis_source_request *request, gis_source **out, gis_error *error);
void gis_source_close(gis_source *source);

/* Replaces the current batch by the next one. *any = false: there is none, and the batch is empty. */
bool gis_source_next(gis_source *source, bool *any, gis_error *error);
/* Begins anew, with the first batch, of a source that is read by batches. */
bool gis_source_again(gis_source *source, bool *any, gis_error *error);
/* The place of the batch's first feature among all, from 0. */
size_t gis_source_first(const gis_source *source);
/* Where features lie, as far as the format has that written down, which may be out of date: xmin, ymin, xmax, ymax;
 * NULL: it does not say. Of a source that is read by batches. */
const double *gis_source_extent(const gis_source *source);
/* What is known of the whole layer. Of a source that is read by batches: once they were all read, and no other can be
 * read after this. */
bool gis_source_find_facts(gis_source *source, gis_source_facts *facts, gis_error *error);

/* How many features there are, or in the batch. */
size_t gis_source_count(const gis_source *source);
/* Feature i, in the order read; its geometry and attributes are the source's own. Borrowed, do not change; of a source
 * that is packed until another one is asked for. */
OGRFeatureH gis_source_feature(const gis_source *source, size_t i);
/* Its geometry; NULL if it has none. */
OGRGeometryH gis_source_geometry(const gis_source *source, size_t i);
/* Is it packed? Then polygons can be read from several threads at once, until records borrow vertices. */
bool gis_source_is_packed(const gis_source *source, size_t i);
/* gis_geometry_polygonal_part() of it. */
bool gis_source_polygons(const gis_source *source, size_t i, gis_polygonal_part *part, gis_error *error);
/* Its geometry, moved, as well-known binary that lives until another is asked for (*geometry = NULL if memory is out),
 * and the value of its field i in values[map[i]], unless that is -1. False if it is not packed. */
bool gis_source_plain(const gis_source *source, size_t i, double dx, double dy, const int *map, gis_value *values,
                      const unsigned char **geometry, size_t *bytes);
/* Puts it into a feature of another layer: its geometry, moved, and the value of its field i into field map[i], unless
 * that is -1. */
bool gis_source_put(const gis_source *source, size_t i, const int *map, double dx, double dy, OGRFeatureH to,
                    gis_error *error);
/* Lets packed records take their vertices from the shapes made of them, by feature number; NULL: none. The shapes must
 * live as long as features are read. Not for a source that is read by batches. */
bool gis_source_borrow(gis_source *source, sunder_shape *const *shape, unsigned threads, gis_error *error);
/* Makes GDAL features of all that is packed; they live as long as the source. */
bool gis_source_unpack(gis_source *source, gis_error *error);
/* Its FID as read; OGRNullFID if it has none. */
GIntBig gis_source_fid(const gis_source *source, size_t i);
/* Are all FIDs set and different? False may happen with --sql. Of a source that is read by batches it has to be known
 * from before (facts), as the next two. */
bool gis_source_fids_unique(const gis_source *source);
/* Is there a FID less than 0? */
bool gis_source_fids_negative(const gis_source *source);
gis_content gis_source_content(const gis_source *source, size_t i);
/* How many features are of this content. */
size_t gis_source_content_count(const gis_source *source, gis_content content);
/* Is there a MultiPolygon? */
bool gis_source_has_multipolygons(const gis_source *source);

/* Returns the name for messages and for the output layer. It is the layer's name or, with --sql, the stem of the
 * source's file. */
const char *gis_source_name(const gis_source *source);
const char *gis_source_path(const gis_source *source);
GDALDatasetH gis_source_dataset(const gis_source *source);
OGRLayerH gis_source_layer(const gis_source *source);
/* Is the layer what a statement (--sql) gave? And the expression of --where; NULL: none. */
bool gis_source_is_result(const gis_source *source);
const char *gis_source_where(const gis_source *source);
/* The declared geometry type. */
OGRwkbGeometryType gis_source_type(const gis_source *source);
/* NULL if there is none. */
OGRSpatialReferenceH gis_source_crs(const gis_source *source);

/* Index of a field (case-insensitive, as OGR), or -1. Values through OGR_F_GetFieldAs... of the feature. */
int gis_source_field(const gis_source *source, const char *name);

/* For --fixed-where and --ignore-where, as `option` calls them: marks[i] says whether feature i satisfies `where`. A
 * plain layer answers in the SQL that its --where speaks; the result of --sql, whose FIDs mean nothing, in
 * OGR's. marks has gis_source_count() entries. A bad expression is GIS_USAGE. Of a source that is read by batches a
 * plain layer is asked once, and by FIDs that are unique as far as is known then. */
bool gis_source_mark(gis_source *source, const char *option, const char *where, bool *marks, gis_error *error);

/* What GDAL warned of while opening and reading. */
const gis_sentences *gis_source_warnings(const gis_source *source);

#endif
