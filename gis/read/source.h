/* source.h: reads a layer, with the same selections as ogr2ogr.
 *
 * All selected features are read and kept with their attributes, so that they can be written without loss: as OGR
 * features, or packed (packed.h). A layer that is too large for memory is read in batches; then feature i is the i-th
 * of the current batch. The dataset stays open until gis_source_close(). */
#ifndef GIS_SOURCE_H
#define GIS_SOURCE_H

#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include "base/gis_error.h"
#include "base/value.h"
#include "geometry/geometry.h"

/* Kinds of layers that a command accepts; combine with |. A layer of unknown type, or of collections, is accepted by
 * all. */
enum { GIS_TAKES_POLYGONS = 1, GIS_TAKES_POINTS = 2, GIS_TAKES_LINES = 4 };

/* How a feature with a coordinate that is not finite is treated. */
typedef enum gis_not_finite {
    GIS_NOT_FINITE_REFUSED, /* reading fails, and names the feature */
    GIS_NOT_FINITE_KEPT,    /* the feature is kept, its content is GIS_BROKEN, and the caller warns */
    GIS_NOT_FINITE_LEFT_OUT /* the feature is dropped with a warning */
} gis_not_finite;

/* Facts about a layer that are known only after reading all of it. */
typedef struct gis_source_facts {
    size_t features, content[GIS_CONTENTS]; /* content: number of features with each content */
    bool fids_unique;                       /* all FIDs are set and different */
    bool fids_negative;                     /* at least one FID is less than 0 */
    bool multipolygons;                     /* there is a MultiPolygon */
} gis_source_facts;

/* What to read from the source at `path`; zeroed members mean "not given". Strings are borrowed for the call. Lists end
 * with NULL. */
typedef struct gis_source_request {
    const char *path;
    const char *const *drivers;      /* --if */
    const char *const *open_options; /* --oo */
    const char *layer;               /* --input-layer; not together with sql */
    const char *sql, *dialect;       /* --sql, --dialect */
    const char *where;               /* --where */
    const double *bbox;              /* --bbox: xmin, ymin, xmax, ymax */
    const char *input_crs;           /* --input-crs: replaces the layer's CRS */
    unsigned takes;                  /* GIS_TAKES_...; set by the command, not by an option */
    const char *layer_option;        /* names of the options that choose the layer and the features, for messages; NULL:
                                      * those above */
    const char *where_option;
    const char *layer_like; /* name of the layer to prefer if none is given */
    /* NULL, or a function that is called when the layer and its CRS are known, and sets the box that features must
     * meet; false: no filter. It may read the layer. Not together with bbox or sql. */
    bool (*within)(void *user, OGRLayerH layer, OGRSpatialReferenceH crs, double box[4]);
    /* NULL, or a function that decides for each feature whether it is kept; others may have coordinates that are not
     * finite. */
    bool (*wants)(void *user, OGRSpatialReferenceH crs, OGRFeatureH feature);
    void *user;       /* passed to these two functions; wants is called as long as the source is read */
    bool packed;      /* pack features if possible; then gis_source_feature() may be used by one thread only, for one
                       * feature at a time */
    unsigned threads; /* number of threads for reading; 0: the number of processors */
    size_t batch;     /* largest number of features read at once (fewer if they are large); 0: all */
    const gis_source_facts *facts; /* NULL, or the facts of an earlier reading of the same source */
    gis_not_finite not_finite;
    bool fids_mean_nothing; /* FIDs are known not to be unique, so gis_source_mark() does not use them */
} gis_source_request;

typedef struct gis_source gis_source;

/* Opens a source, chooses the layer and reads it. GDALAllRegister() must have been called.
 *
 * Fails with one sentence: no such file, not readable by GDAL, no such layer (the layers are listed), several suitable
 * layers and none named (they are listed), a layer of another kind, no geometry column, an invalid --where, --sql or
 * CRS, a coordinate that is not finite (with layer and FID) unless the request allows it, or a read error. A layer
 * without features, or a filter that selects none, is not an error. */
bool gis_source_open(const gis_source_request *request, gis_source **out, gis_error *error);
void gis_source_close(gis_source *source);

/* Replaces the current batch by the next one. *any = false: there is no further batch, and the current one is empty. */
bool gis_source_next(gis_source *source, bool *any, gis_error *error);
/* Begins again with the first batch of a source that is read in batches. */
bool gis_source_again(gis_source *source, bool *any, gis_error *error);
/* The number of the batch's first feature in the whole layer, from 0. */
size_t gis_source_first(const gis_source *source);
/* The extent that the format has stored, which may be out of date: xmin, ymin, xmax, ymax; NULL: not known. Only for a
 * source that is read in batches. */
const double *gis_source_extent(const gis_source *source);
/* Gets the facts about the whole layer. For a source that is read in batches: after the last batch, and no batch can be
 * read afterwards. */
bool gis_source_find_facts(gis_source *source, gis_source_facts *facts, gis_error *error);

/* The number of features, or of those in the current batch. */
size_t gis_source_count(const gis_source *source);
/* Feature i in reading order, with geometry and attributes; borrowed, must not be changed. In a packed source it is
 * valid until the next call. */
OGRFeatureH gis_source_feature(const gis_source *source, size_t i);
/* The same, for a caller that needs its attributes and its FID alone: it may be without its geometry. */
OGRFeatureH gis_source_attributes(const gis_source *source, size_t i);
/* The geometry of feature i; NULL if it has none. */
OGRGeometryH gis_source_geometry(const gis_source *source, size_t i);
/* Is feature i packed? Then gis_source_polygons() may be called by several threads at once, until
 * gis_source_borrow(). */
bool gis_source_is_packed(const gis_source *source, size_t i);
/* Gets the polygons of feature i, as gis_geometry_polygonal_part() does. */
bool gis_source_polygons(const gis_source *source, size_t i, gis_polygonal_part *part, gis_error *error);
/* Gets the translated geometry of a packed feature as well-known binary, valid until the next call (*geometry = NULL if
 * memory is out), and sets values[map[k]] to the value of its field k, unless map[k] is -1. False if it is not
 * packed. */
bool gis_source_plain(const gis_source *source, size_t i, double dx, double dy, const int *map, gis_value *values,
                      const unsigned char **geometry, size_t *bytes);
/* Copies feature i into a feature of another layer: its geometry, translated, and the value of each field k into field
 * map[k], unless that is -1. */
bool gis_source_put(const gis_source *source, size_t i, const int *map, double dx, double dy, OGRFeatureH to,
                    gis_error *error);
/* Lets packed records take their vertices from the shapes made of them; shape[i] may be NULL. The shapes must live as
 * long as features are read. Not for a source that is read in batches. */
bool gis_source_borrow(gis_source *source, sunder_shape *const *shape, unsigned threads, gis_error *error);
/* Converts all packed records to GDAL features, which live as long as the source. */
bool gis_source_unpack(gis_source *source, gis_error *error);
/* The FID of feature i; OGRNullFID if it has none. */
GIntBig gis_source_fid(const gis_source *source, size_t i);
/* Are all FIDs set and different? May be false with --sql. For a source that is read in batches, this and the next two
 * are known only from an earlier reading (`facts`). */
bool gis_source_fids_unique(const gis_source *source);
/* Is a FID negative? */
bool gis_source_fids_negative(const gis_source *source);
gis_content gis_source_content(const gis_source *source, size_t i);
/* The number of features with this content. */
size_t gis_source_content_count(const gis_source *source, gis_content content);
/* Is a geometry a MultiPolygon? */
bool gis_source_has_multipolygons(const gis_source *source);

/* The name for messages and for the output layer: the layer's name or, with --sql, the stem of the file's name. */
const char *gis_source_name(const gis_source *source);
const char *gis_source_path(const gis_source *source);
GDALDatasetH gis_source_dataset(const gis_source *source);
OGRLayerH gis_source_layer(const gis_source *source);
/* Is the layer the result of --sql? And the condition of --where; NULL: none. */
bool gis_source_is_result(const gis_source *source);
const char *gis_source_where(const gis_source *source);
/* The declared geometry type of the layer. */
OGRwkbGeometryType gis_source_type(const gis_source *source);
/* The CRS; NULL if there is none. */
OGRSpatialReferenceH gis_source_crs(const gis_source *source);

/* The index of a field (ignoring case, as OGR does), or -1. */
int gis_source_field(const gis_source *source, const char *name);

/* Sets marks[i] to whether feature i satisfies the condition `where` of --fixed-where or --ignore-where (`option`);
 * marks has gis_source_count() elements. A plain layer evaluates it in the SQL of its --where; for a result of --sql,
 * whose FIDs have no meaning, OGR's SQL is used. An invalid condition is wrong usage. A source that is read in batches
 * queries a plain layer once for all batches, if FIDs are unique as far as is known. */
bool gis_source_mark(gis_source *source, const char *option, const char *where, bool *marks, gis_error *error);

/* Warnings of GDAL from opening and reading. */
const gis_sentences *gis_source_warnings(const gis_source *source);

#endif
