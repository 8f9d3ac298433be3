/* source_features.h: what source.c and source_features.c share: the members of a source, and the reading of its
 * features. */
#ifndef GIS_SOURCE_FEATURES_H
#define GIS_SOURCE_FEATURES_H

#include "base/message.h"
#include "geometry/packed.h"
#include "read/source_mark.h"

struct gis_source {
    GDALDatasetH dataset;
    OGRLayerH layer;
    bool is_result; /* the layer is the result of --sql */
    OGRSpatialReferenceH crs;
    char *path, *name, *where;
    const char *where_option; /* name of the option for messages; borrowed from the request */
    const void **held;        /* [n] GDAL features or records */
    unsigned char *contents;  /* [n] content of each, with RECORD if held[i] is a record */
    size_t n, capacity, contents_capacity;
    gis_packed *packed; /* the memory of records */
    gis_source_facts facts;
    bool fids_missing, fids_rising; /* for all features read: some FID is not set; each FID is greater than the one
                                     * before */
    GIntBig last_fid;
    size_t batch, first, bytes; /* bytes: size of the batch's geometries; the others as in gis_source_request */
    bool may_pack, ended;       /* ended: the last feature of the layer was read */
    bool within;                /* GDAL compares features with a box that the caller does not depend on */
    bool (*wants)(void *user, OGRSpatialReferenceH crs, OGRFeatureH feature); /* from the request */
    void *user;
    bool facts_given, fids_mean_nothing;
    gis_not_finite not_finite;
    double extent[4];
    bool extent_known;
    gis_source_marks marks;
    gis_sentences warnings;
};

/* Adds the warnings that GDAL gave to those of the source. */
void gis_source_keep_warnings(gis_source *source, const gis_listener *listener);
/* Reads the first batch of the features of source->layer, or all, and finds facts about them as far as the request
 * wants. */
bool gis_source_begin_reading(gis_source *source, const gis_source_request *request, gis_error *error);
/* Frees the features that are held. */
void gis_source_drop_features(gis_source *source);

#endif
