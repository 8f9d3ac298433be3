/* contents.h: the data that a page is drawn from: a layer in memory (held.c), or one on disk (spooled.c). Facts about
 * each feature and each barrier are filled in once; shapes, geometries and names are fetched one by one. */
#ifndef GIS_REPORT_CONTENTS_H
#define GIS_REPORT_CONTENTS_H

#include "base/text.h"
#include "shards/run/run.h"

/* A box is xmin, ymin, xmax, ymax. */
typedef struct gis_page_feature {
    double box[4]; /* where it stood */
    double move[2];
    uint64_t place;    /* where the contents have it */
    uint32_t vertices; /* 0: there is nothing to draw */
    uint8_t status;    /* a sunder_feature_status */
    bool involved;     /* is in a conflict that remains, or in the way of one */
} gis_page_feature;

typedef struct gis_page_barrier {
    double box[4]; /* as it is drawn, with its width */
    double width;
    uint64_t place;  /* where the contents have it: another in parts than of a whole layer */
    size_t order;    /* among all barriers, as they were read; set by the page's model */
    size_t vertices; /* of lines and of the shape */
    bool area;       /* it has a shape */
} gis_page_barrier;

typedef struct gis_page_contents {
    void *of;
    size_t features, barriers;
    /* feature: [features] zeroed. */
    bool (*fill)(void *of, gis_page_feature *feature, gis_error *error);
    /* barrier: [barriers] */
    bool (*fill_barriers)(void *of, gis_page_barrier *barrier, gis_error *error);
    /* The conflicts that remain, in any order; they live as long as `of`. */
    bool (*conflicts)(void *of, const sunder_conflict **conflict, size_t *n, gis_error *error);
    /* For an item that has something to draw. Lent data is valid until the next item is fetched. */
    bool (*shape)(void *of, size_t feature, uint64_t place, const sunder_shape **shape, gis_error *error);
    bool (*geometry)(void *of, uint64_t place, sunder_obstacle *geometry, gis_error *error);
    /* FIDs (OGRNullFID: none) and texts: the user's own id, NULL: none; of a barrier the name of its layer. */
    bool (*name)(void *of, size_t feature, uint64_t place, GIntBig *fid, const char **id, gis_error *error);
    bool (*barrier_name)(void *of, size_t barrier, GIntBig *fid, const char **layer, gis_error *error);
} gis_page_contents;

/* What there is to know of a barrier but for its place. */
gis_page_barrier gis_page_barrier_of(const sunder_obstacle *geometry, double width);

/* ---- held.c ------------------------------------------------------------------------------------------------------ */

typedef struct gis_page_held {
    const gis_layer_input *input;
    const sunder_report *report;
} gis_page_held;

gis_page_contents gis_page_contents_of(gis_page_held *held);

/* ---- spooled.c --------------------------------------------------------------------------------------------------- */

typedef struct gis_page_spooled gis_page_spooled;

/* Of a layer that was separated in parts, and written. parts is borrowed. */
bool gis_page_spooled_open(gis_shard_run *parts, gis_page_spooled **out, gis_error *error);
gis_page_contents gis_page_contents_of_spool(gis_page_spooled *spooled);
void gis_page_spooled_close(gis_page_spooled *spooled);

#endif
