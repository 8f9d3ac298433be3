/* source_mark.c: which features satisfy an expression (--fixed-where, --ignore-where). It is asked of those who know
 * the SQL: a plain layer answers for itself, as it did for --where, and its FIDs tell who is meant; where FIDs mean
 * nothing a layer of memory answers in its place. */
#define _GNU_SOURCE /* strcasestr() */
#include "read/source.h"

#include "base/interrupt.h"
#include "read/where.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <stdlib.h>
#include <string.h>

typedef struct fid_index {
    GIntBig fid;
    size_t index;
} fid_index;

static int compare_fid_index(const void *a, const void *b)
{
    const fid_index *p = a, *q = b;
    return (p->fid > q->fid) - (p->fid < q->fid);
}

/* Marks by asking the layer again with both filters; FIDs tell which features came. */
static bool mark_by_filter(const gis_source *source, const char *where, bool *marks, gis_error *error)
{
    OGRLayerH layer = gis_source_layer(source);
    const char *selected = gis_source_where(source);
    size_t n = gis_source_count(source);
    fid_index *table = malloc((n + 1) * sizeof *table);
    if (!table) return gis_no_memory(error);
    for (size_t i = 0; i < n; i++) table[i] = (fid_index){gis_source_fid(source, i), i};
    qsort(table, n, sizeof *table, compare_fid_index);
    char *both = CPLStrdup(selected ? CPLSPrintf("(%s) AND (%s)", selected, where) : where);
    bool done = OGR_L_SetAttributeFilter(layer, both) == OGRERR_NONE;
    CPLFree(both);
    if (done) {
        OGR_L_ResetReading(layer);
        for (OGRFeatureH feature; done && (feature = OGR_L_GetNextFeature(layer)); OGR_F_Destroy(feature)) {
            fid_index key = {OGR_F_GetFID(feature), 0};
            fid_index *found = bsearch(&key, table, n, sizeof *table, compare_fid_index);
            if (found) marks[found->index] = true;
            done = gis_go_on(error);
        }
    }
    OGR_L_SetAttributeFilter(layer, selected);
    free(table);
    return done;
}

static GDALDriverH memory_driver(void)
{
    GDALDriverH driver = GDALGetDriverByName("MEM"); /* for vectors since 3.11, else raster only */
    if (!driver || !GDALGetMetadataItem(driver, GDAL_DCAP_VECTOR, NULL)) driver = GDALGetDriverByName("Memory");
    return driver;
}

/* The features of a result set may share FIDs, and a filter would renumber them: so the attributes are laid out in a
 * layer of memory whose FIDs are our own numbers, and that is asked, in OGR's SQL. */
static bool mark_in_memory(const gis_source *source, const char *where, bool *marks, gis_error *error)
{
    GDALDriverH driver = memory_driver();
    GDALDatasetH memory = driver ? GDALCreate(driver, "", 0, 0, 0, GDT_Unknown, NULL) : NULL;
    /* Geometries come along where the condition is about them. */
    OGRwkbGeometryType type = strcasestr(where, "OGR_GEOM") ? wkbUnknown : wkbNone;
    OGRLayerH layer = memory ? GDALDatasetCreateLayer(memory, gis_source_name(source), NULL, type, NULL) : NULL;
    bool done = layer != NULL;
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(gis_source_layer(source));
    for (int f = 0; done && f < OGR_FD_GetFieldCount(definition); f++)
        done = OGR_L_CreateField(layer, OGR_FD_GetFieldDefn(definition, f), TRUE) == OGRERR_NONE;
    for (size_t i = 0; done && i < gis_source_count(source) && (done = gis_go_on(error)); i++) {
        OGRFeatureH copy = OGR_F_Create(OGR_L_GetLayerDefn(layer));
        OGR_F_SetFrom(copy, gis_source_feature(source, i), TRUE);
        OGR_F_SetFID(copy, (GIntBig)i);
        done = OGR_L_CreateFeature(layer, copy) == OGRERR_NONE;
        OGR_F_Destroy(copy);
    }
    done = done && OGR_L_SetAttributeFilter(layer, where) == OGRERR_NONE;
    if (done) {
        OGR_L_ResetReading(layer);
        for (OGRFeatureH feature; (feature = OGR_L_GetNextFeature(layer)) != NULL; OGR_F_Destroy(feature))
            marks[OGR_F_GetFID(feature)] = true;
    }
    if (memory) GDALClose(memory);
    return done || gis_fail(error, "not understood");
}

bool gis_source_mark(const gis_source *source, const char *option, const char *where, bool *marks, gis_error *error)
{
    for (size_t i = 0; i < gis_source_count(source); i++) marks[i] = false;
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    bool in_place = !gis_source_is_result(source) && gis_source_fids_unique(source);
    bool done = in_place ? mark_by_filter(source, where, marks, error) : mark_in_memory(source, where, marks, error);
    gis_listen_end();
    if (!done || listener.failures || gis_interrupted())
        done = gis_fail_where(in_place ? gis_source_dataset(source) : NULL, gis_source_layer(source), option, where,
                              gis_listener_reason(&listener, "not understood"), error);
    gis_listener_clear(&listener);
    return done;
}
