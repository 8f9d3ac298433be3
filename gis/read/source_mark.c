/* source_mark.c: finds the features that satisfy a condition (--fixed-where, --ignore-where). The layer evaluates it if
 * possible, as it does for --where, and its FIDs identify the features; if FIDs have no meaning, a layer in memory
 * evaluates it. */
#define _GNU_SOURCE /* strcasestr() */
#include "read/source_mark.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "base/path.h"
#include "read/where.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <stdlib.h>
#include <string.h>

/* ---- Evaluated by the layer -------------------------------------------------------------------------------------- */

/* Gets the FID of a feature that satisfies the condition. */
typedef bool take_fid(void *user, GIntBig fid);

/* Reads the features of the layer that satisfy both --where and the condition. */
static bool ask_layer(const gis_source *source, const char *where, take_fid *take, void *user, gis_error *error)
{
    OGRLayerH layer = gis_source_layer(source);
    const char *selected = gis_source_where(source);
    char *both = selected ? gis_printed("(%s) AND (%s)", selected, where) : CPLStrdup(where);
    bool done = OGR_L_SetAttributeFilter(layer, both) == OGRERR_NONE;
    CPLFree(both);
    if (done) {
        OGR_L_ResetReading(layer);
        for (OGRFeatureH feature; done && (feature = OGR_L_GetNextFeature(layer)); OGR_F_Destroy(feature))
            done = (take(user, OGR_F_GetFID(feature)) || gis_no_memory(error)) && gis_go_on(error);
    }
    OGR_L_SetAttributeFilter(layer, selected);
    return done;
}

typedef struct fid_index {
    GIntBig fid;
    size_t index;
} fid_index;

static int compare_fid_index(const void *a, const void *b)
{
    const fid_index *p = a, *q = b;
    return (p->fid > q->fid) - (p->fid < q->fid);
}

typedef struct marking {
    fid_index *table;
    size_t n;
    bool *marks;
} marking;

static bool take_mark(void *user, GIntBig fid)
{
    const marking *m = user;
    const fid_index key = {fid, 0}, *found = bsearch(&key, m->table, m->n, sizeof *m->table, compare_fid_index);
    if (found) m->marks[found->index] = true;
    return true;
}

/* Marks features by the FIDs that the query returns. */
static bool mark_by_filter(const gis_source *source, const char *where, bool *marks, gis_error *error)
{
    marking m = {.n = gis_source_count(source), .marks = marks};
    m.table = malloc((m.n + 1) * sizeof *m.table);
    if (!m.table) return gis_no_memory(error);
    for (size_t i = 0; i < m.n; i++) m.table[i] = (fid_index){gis_source_fid(source, i), i};
    qsort(m.table, m.n, sizeof *m.table, compare_fid_index);
    const bool done = ask_layer(source, where, take_mark, &m, error);
    free(m.table);
    return done;
}

/* ---- For batches ------------------------------------------------------------------------------------------------- */

static bool take_range(void *user, GIntBig fid)
{
    gis_marked *marked = user;
    if (marked->n > 0 && marked->range[marked->n - 1][1] == fid - 1) {
        marked->range[marked->n - 1][1] = fid;
        return true;
    }
    if (!gis_array_reserve(&marked->range, &marked->capacity, marked->n + 1, sizeof *marked->range)) return false;
    marked->range[marked->n][0] = marked->range[marked->n][1] = fid;
    marked->n++;
    return true;
}

static int compare_ranges(const void *a, const void *b)
{
    const GIntBig *p = a, *q = b;
    return (p[0] > q[0]) - (p[0] < q[0]);
}

/* Returns the result of the condition; the layer is queried at the first use. NULL: failed, *error has the reason. */
static const gis_marked *find_marked(gis_source *source, const char *where, gis_error *error)
{
    gis_source_marks *all = gis_source_marks_of(source);
    for (size_t k = 0; k < all->n; k++)
        if (strcmp(all->marked[k].where, where) == 0) return &all->marked[k];
    if (!gis_array_reserve(&all->marked, &all->capacity, all->n + 1, sizeof *all->marked)) {
        gis_no_memory(error);
        return NULL;
    }
    gis_marked *marked = &all->marked[all->n++];
    *marked = (gis_marked){.where = CPLStrdup(where)};
    const bool done = ask_layer(source, where, take_range, marked, error);
    if (!gis_source_resume(source, error) || !done) return NULL;
    if (marked->n > 0) qsort(marked->range, marked->n, sizeof *marked->range, compare_ranges);
    return marked;
}

/* Returns whether the FID is before the range, in it, or behind it: -1, 0 or 1. */
static int compare_with_range(const void *fid, const void *range)
{
    const GIntBig key = *(const GIntBig *)fid, *r = range;
    return key < r[0] ? -1 : key > r[1];
}

static bool mark_batch(gis_source *source, const char *where, bool *marks, gis_error *error)
{
    const gis_marked *marked = find_marked(source, where, error);
    for (size_t i = 0; marked && marked->n > 0 && i < gis_source_count(source); i++) {
        const GIntBig fid = gis_source_fid(source, i);
        marks[i] = bsearch(&fid, marked->range, marked->n, sizeof *marked->range, compare_with_range) != NULL;
    }
    return marked != NULL;
}

/* ---- Evaluated in memory ----------------------------------------------------------------------------------------- */

static GDALDriverH memory_driver(void)
{
    GDALDriverH driver = GDALGetDriverByName("MEM"); /* supports vectors since GDAL 3.11, only rasters before */
    if (!driver || !GDALGetMetadataItem(driver, GDAL_DCAP_VECTOR, NULL)) driver = GDALGetDriverByName("Memory");
    return driver;
}

/* Copies the attributes to a layer in memory, whose FIDs are the features' numbers, and evaluates the condition there
 * in OGR's SQL: features of a result set may share FIDs, and a filter would renumber them. */
static bool mark_in_memory(const gis_source *source, const char *where, bool *marks, gis_error *error)
{
    const size_t first = gis_source_first(source);
    GDALDriverH driver = memory_driver();
    GDALDatasetH memory = driver ? GDALCreate(driver, "", 0, 0, 0, GDT_Unknown, NULL) : NULL;
    /* Geometries are copied only if the condition is about them. */
    OGRwkbGeometryType type = strcasestr(where, "OGR_GEOM") ? wkbUnknown : wkbNone;
    OGRLayerH layer = memory ? GDALDatasetCreateLayer(memory, gis_source_name(source), NULL, type, NULL) : NULL;
    bool done = layer != NULL;
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(gis_source_layer(source));
    for (int f = 0; done && f < OGR_FD_GetFieldCount(definition); f++)
        done = OGR_L_CreateField(layer, OGR_FD_GetFieldDefn(definition, f), TRUE) == OGRERR_NONE;
    for (size_t i = 0; done && i < gis_source_count(source) && (done = gis_go_on(error)); i++) {
        OGRFeatureH copy = OGR_F_Create(OGR_L_GetLayerDefn(layer));
        OGR_F_SetFrom(copy, gis_source_feature(source, i), TRUE);
        OGR_F_SetFID(copy, (GIntBig)(first + i));
        done = OGR_L_CreateFeature(layer, copy) == OGRERR_NONE;
        OGR_F_Destroy(copy);
    }
    done = done && OGR_L_SetAttributeFilter(layer, where) == OGRERR_NONE;
    if (done) {
        OGR_L_ResetReading(layer);
        for (OGRFeatureH feature; (feature = OGR_L_GetNextFeature(layer)) != NULL; OGR_F_Destroy(feature))
            marks[(size_t)OGR_F_GetFID(feature) - first] = true;
    }
    if (memory) GDALClose(memory);
    return done || gis_fail(error, "not understood");
}

bool gis_source_mark(gis_source *source, const char *option, const char *where, bool *marks, gis_error *error)
{
    for (size_t i = 0; i < gis_source_count(source); i++) marks[i] = false;
    gis_listener listener = {0};
    gis_listen_begin(&listener);
    const bool in_place = gis_source_goes_by_fids(source);
    bool done = !in_place                     ? mark_in_memory(source, where, marks, error)
                : gis_source_marks_of(source) ? mark_batch(source, where, marks, error)
                                              : mark_by_filter(source, where, marks, error);
    gis_listen_end();
    if (!done || listener.failures || gis_interrupted())
        done = gis_fail_where(in_place ? gis_source_dataset(source) : NULL, gis_source_layer(source), option, where,
                              gis_listener_reason(&listener, "not understood"), error);
    gis_listener_clear(&listener);
    return done;
}
