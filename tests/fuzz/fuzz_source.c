/* Hostile files of layers, read by GDAL from memory. Each file is read twice, as features of GDAL and as packed
 * records: both readings fail, or both give the same features. GDAL itself is not tested; the installed version is
 * used. */
#include "base/gis_error.h"
#include "geometry/line_arrays.h"
#include "read/fields.h"
#include "read/source.h"
#include "read/validity.h"

#include "bytes.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The first byte of an input, '0' to '3', chooses one of these formats, with layers of all kinds. */
typedef struct fuzz_format {
    const char *driver, *path;
} fuzz_format;
static const fuzz_format formats[] = {{"GeoJSON", "/vsimem/layer.geojson"},
                                      {"GeoJSONSeq", "/vsimem/layer.geojsons"},
                                      {"CSV", "/vsimem/layer.csv"},
                                      {"FlatGeobuf", "/vsimem/layer.fgb"}};
enum { FORMATS = sizeof formats / sizeof *formats };

enum { MOST_OF_A_SHAPE = 24 };

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc, (void)argv;
    GDALAllRegister();
    CPLSetErrorHandler(CPLQuietErrorHandler);
    CPLSetConfigOption("GDAL_HTTP_PROXY", "127.0.0.1:1"); /* a CRS may be a URL, which must not be fetched */
    CPLSetConfigOption("PROJ_NETWORK", "OFF");
    return 0;
}

static gis_source *open_source(const fuzz_format *format, unsigned takes, bool packed)
{
    const char *const drivers[] = {format->driver, NULL};
    const char *const columns[] = {"X_POSSIBLE_NAMES=x", "Y_POSSIBLE_NAMES=y", NULL};
    const gis_source_request request = {.path = format->path,
                                        .drivers = drivers,
                                        .open_options = strcmp(format->driver, "CSV") == 0 ? columns : NULL,
                                        .takes = takes,
                                        .packed = packed,
                                        .threads = 1};
    gis_source *source = NULL;
    gis_error error = {0};
    if (gis_source_open(&request, &source, &error)) {
        FUZZ_DEMAND(source != NULL);
    } else {
        FUZZ_DEMAND(source == NULL && error.message[0] != 0);
    }
    return source;
}

static bool same_polygons(const gis_polygons *p, const gis_polygons *q)
{
    return p->vertices == q->vertices && p->rings == q->rings && p->polygons == q->polygons &&
           (p->vertices == 0 || memcmp(p->xy, q->xy, 2 * p->vertices * sizeof *p->xy) == 0) &&
           (p->rings == 0 || memcmp(p->ring_end, q->ring_end, p->rings * sizeof *p->ring_end) == 0) &&
           (p->polygons == 0 || memcmp(p->poly_end, q->poly_end, p->polygons * sizeof *p->poly_end) == 0);
}

/* Polygons become a shape, or are refused with a reason. Polygons of many corners are skipped, since they take longest;
 * other targets test them. */
static void ask_shape(const gis_polygons *set)
{
    sunder_shape *shape = NULL;
    gis_error reason = {0}, error = {0};
    bool invalid = false;
    for (size_t i = 0; i < 2 * set->vertices; i++) FUZZ_DEMAND(isfinite(set->xy[i]));
    if (set->vertices > MOST_OF_A_SHAPE) return;
    if (gis_shape_of_polygons(set, GIS_INVALID_REPAIR, "P", &shape, &invalid, &reason, &error)) {
        FUZZ_DEMAND(shape != NULL && (!invalid || reason.message[0] != 0));
    } else {
        FUZZ_DEMAND(shape == NULL && error.message[0] != 0);
    }
    sunder_shape_free(shape);
}

/* The lines and points of features that have other geometries, and the values of fields. */
static void ask_feature(OGRFeatureH feature, OGRGeometryH geometry)
{
    gis_lines lines = {0};
    gis_error error = {0};
    bool arcs = false;
    if (gis_lines_append(geometry, &lines, &arcs, &error) && gis_lines_append_rings(geometry, &lines, &arcs, &error)) {
        FUZZ_DEMAND(lines.lines == 0 || lines.end[lines.lines - 1] == lines.points);
    } else {
        FUZZ_DEMAND(error.message[0] != 0);
    }
    gis_lines_clear(&lines);
    double *xy = NULL;
    size_t n = 0;
    if (geometry && gis_geometry_points(geometry, &xy, &n, &error)) CPLFree(xy);
    for (int i = 0; i < OGR_F_GetFieldCount(feature); i++) {
        char text[GIS_FIELD_TEXT_SIZE];
        gis_field_text(feature, i, text);
        FUZZ_DEMAND(strlen(text) < sizeof text);
        (void)gis_field_number(feature, i);
        (void)gis_field_is_blank(feature, i);
    }
}

/* The values of all fields, which must be equal for all ways of reading. */
static void compare_fields(OGRFeatureH p, OGRFeatureH q)
{
    FUZZ_DEMAND(OGR_F_GetFieldCount(p) == OGR_F_GetFieldCount(q));
    for (int i = 0; i < OGR_F_GetFieldCount(p); i++) {
        FUZZ_DEMAND(!OGR_F_IsFieldSet(p, i) == !OGR_F_IsFieldSet(q, i));
        FUZZ_DEMAND(!OGR_F_IsFieldNull(p, i) == !OGR_F_IsFieldNull(q, i));
        if (OGR_F_IsFieldSetAndNotNull(p, i)) {
            char *text = CPLStrdup(OGR_F_GetFieldAsString(p, i));
            FUZZ_DEMAND(strcmp(text, OGR_F_GetFieldAsString(q, i)) == 0);
            CPLFree(text);
        }
    }
}

static void compare(const gis_source *plain, const gis_source *packed)
{
    FUZZ_DEMAND(gis_source_count(plain) == gis_source_count(packed));
    FUZZ_DEMAND(gis_source_fids_unique(plain) == gis_source_fids_unique(packed));
    gis_polygonal_part p = {0}, q = {0};
    for (size_t i = 0; i < gis_source_count(plain); i++) {
        gis_error error = {0};
        FUZZ_DEMAND(gis_source_fid(plain, i) == gis_source_fid(packed, i));
        FUZZ_DEMAND(gis_source_content(plain, i) == gis_source_content(packed, i));
        const bool read = gis_source_polygons(plain, i, &p, &error);
        FUZZ_DEMAND(read == gis_source_polygons(packed, i, &q, &error));
        FUZZ_DEMAND(read || error.message[0] != 0);
        FUZZ_DEMAND(!read || (same_polygons(&p.set, &q.set) && p.linearised == q.linearised));
        if (read) ask_shape(&p.set);
        ask_feature(gis_source_feature(plain, i), gis_source_geometry(plain, i));
        compare_fields(gis_source_feature(plain, i), gis_source_feature(packed, i));
    }
    gis_polygonal_part_clear(&p);
    gis_polygonal_part_clear(&q);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0) return 0;
    const fuzz_format *format = &formats[data[0] % FORMATS];
    const unsigned all = GIS_TAKES_POLYGONS | GIS_TAKES_POINTS | GIS_TAKES_LINES;
    const unsigned some = (data[0] / FORMATS + 3u) & all, takes = some ? some : all;
    VSILFILE *file = VSIFileFromMemBuffer(format->path, (GByte *)data + 1, size - 1, FALSE);
    if (!file) return 0;
    VSIFCloseL(file);
    gis_source *plain = open_source(format, takes, false), *packed = open_source(format, takes, true);
    FUZZ_DEMAND(!plain == !packed);
    if (plain) compare(plain, packed);
    gis_source_close(plain);
    gis_source_close(packed);
    VSIUnlink(format->path);
    return 0;
}
