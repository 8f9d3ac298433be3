/* A layer that is read to disk in batches equals a layer that is read as a whole, feature by feature and to the last
 * bit: shapes, requirements, FIDs, ids, statuses, and the properties of the layer. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/message.h"
#include "layer/output.h"
#include "random.h"
#include "scratch.h"
#include "shards/run/layer_spooling.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Layers ------------------------------------------------------------------------------------------------------ */

enum { FEATURES = 20000 }; /* several batches, the last one not full */

static OGRGeometryH draw_polygon(rng *random, double x, double y)
{
    char text[600];
    const double a = 1 + 8 * rng_unit(random), b = 1 + 8 * rng_unit(random);
    OGRGeometryH geometry = NULL;
    if (rng_once_in(random, 40)) /* a ring that crosses itself */
        snprintf(text, sizeof text, "POLYGON((%.17g %.17g,%.17g %.17g,%.17g %.17g,%.17g %.17g,%.17g %.17g))", x, y,
                 x + a, y + b, x + a, y, x, y + b, x, y);
    else if (rng_once_in(random, 10))
        snprintf(text, sizeof text,
                 "MULTIPOLYGON(((%.17g %.17g,%.17g %.17g,%.17g %.17g,%.17g %.17g)),((%.17g %.17g,%.17g %.17g,%.17g "
                 "%.17g,%.17g %.17g)))",
                 x, y, x + a, y, x, y + b, x, y, x + 9, y, x + 9 + a, y, x + 9, y + b, x + 9, y);
    else
        snprintf(text, sizeof text, "POLYGON((%.17g %.17g,%.17g %.17g,%.17g %.17g,%.17g %.17g,%.17g %.17g))", x, y,
                 x + a, y, x + a, y + b, x, y + b, x, y);
    char *at = text;
    assert_int_equal(OGR_G_CreateFromWkt(&at, NULL, &geometry), OGRERR_NONE);
    return geometry;
}

static OGRGeometryH draw_geometry(rng *random, bool points)
{
    const double x = (double)rng_int(random, 0, 3000) + rng_unit(random), y = (double)rng_int(random, 0, 2000);
    if (rng_once_in(random, 50)) return NULL;
    if (!points) return draw_polygon(random, x, y);
    OGRGeometryH point = OGR_G_CreateGeometry(wkbPoint);
    OGR_G_SetPoint_2D(point, 0, x, y);
    return point;
}

static void add_field(OGRLayerH layer, const char *name, OGRFieldType type)
{
    OGRFieldDefnH field = OGR_Fld_Create(name, type);
    assert_int_equal(OGR_L_CreateField(layer, field, TRUE), OGRERR_NONE);
    OGR_Fld_Destroy(field);
}

static void make_layer(const char *file, bool points)
{
    GDALDatasetH dataset = GDALCreate(GDALGetDriverByName("GPKG"), scratch_path(file), 0, 0, 0, GDT_Unknown, NULL);
    OGRLayerH layer = GDALDatasetCreateLayer(dataset, "made", NULL, points ? wkbPoint : wkbUnknown, NULL);
    rng random = rng_start(test_seed(), points);
    add_field(layer, "kind", OFTInteger);
    add_field(layer, "street", OFTString);
    add_field(layer, "factor", OFTReal);
    add_field(layer, "limit", OFTReal);
    add_field(layer, "symbol", OFTString);
    GDALDatasetStartTransaction(dataset, FALSE);
    for (int i = 0; i < FEATURES; i++) {
        OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
        OGR_F_SetFID(feature, 3 * i + 7);
        OGR_F_SetFieldInteger(feature, 0, (int)rng_int(&random, 0, 9));
        if (!rng_once_in(&random, 3))
            OGR_F_SetFieldString(feature, 1, CPLSPrintf("s%d", (int)rng_int(&random, 0, 5000)));
        if (!rng_once_in(&random, 3)) OGR_F_SetFieldDouble(feature, 2, 0.1 + rng_unit(&random));
        if (!rng_once_in(&random, 3)) OGR_F_SetFieldDouble(feature, 3, rng_once_in(&random, 9) ? 0 : rng_unit(&random));
        if (rng_once_in(&random, 9)) OGR_F_SetFieldString(feature, 4, "rectangle:3x2");
        OGRGeometryH geometry = draw_geometry(&random, points);
        if (geometry) OGR_F_SetGeometryDirectly(feature, geometry);
        assert_int_equal(OGR_L_CreateFeature(layer, feature), OGRERR_NONE);
        OGR_F_Destroy(feature);
    }
    GDALDatasetCommitTransaction(dataset);
    GDALClose(dataset);
}

/* The layer twice, with the FIDs that features have. */
static void make_union(const char *file)
{
    FILE *out = fopen(scratch_path(file), "w");
    fprintf(out, "<OGRVRTDataSource><OGRVRTUnionLayer name=\"made\"><PreserveSrcFID>ON</PreserveSrcFID>");
    for (int k = 0; k < 2; k++)
        fprintf(out,
                "<OGRVRTLayer name=\"made%d\"><SrcDataSource>%s</SrcDataSource><SrcLayer>made</SrcLayer></OGRVRTLayer>",
                k, scratch_path("polygons.gpkg"));
    fprintf(out, "</OGRVRTUnionLayer></OGRVRTDataSource>");
    fclose(out);
}

/* ---- Comparison with a layer that is read as a whole ------------------------------------------------------------- */

typedef struct comparing {
    const gis_layer_input *whole;
    bool *found;
    size_t n;
} comparing;

static void same_shape(const sunder_shape *a, const sunder_shape *b)
{
    const double *xy[2];
    const size_t *ring_end[2], *poly_end[2];
    const size_t polygons = sunder_shape_given(a, &xy[0], &ring_end[0], &poly_end[0]);
    assert_int_equal(polygons, sunder_shape_given(b, &xy[1], &ring_end[1], &poly_end[1]));
    const size_t rings = poly_end[0][polygons - 1];
    assert_memory_equal(ring_end[0], ring_end[1], rings * sizeof *ring_end[0]);
    assert_memory_equal(xy[0], xy[1], 2 * ring_end[0][rings - 1] * sizeof *xy[0]);
}

static bool compare(void *user, const gis_spool_feature *feature, gis_error *error)
{
    comparing *c = user;
    const gis_layer_input *whole = c->whole;
    const size_t i = feature->index;
    const sunder_feature *demands = &whole->feature[i];
    (void)error;
    assert_true(i < whole->n && !c->found[i] && !demands->ignored);
    c->found[i] = true;
    c->n++;
    same_shape(whole->shape[i], feature->demands.shape);
    assert_int_equal(gis_source_fid(whole->source, i), feature->fid);
    assert_true(demands->weight == feature->demands.weight);
    assert_true(demands->max_shift == feature->demands.max_shift);
    assert_int_equal(demands->block, feature->demands.block);
    assert_int_equal(demands->fixed, feature->demands.fixed);
    double start[2] = {NAN, NAN};
    if (whole->points) assert_true(gis_arrow_start(whole, i, start, error));
    assert_memory_equal(start, feature->start, sizeof start);
    gis_value id;
    char *copy = NULL;
    assert_true(gis_id_value(whole, i, &copy, &id, error));
    assert_int_equal(id.kind == GIS_NULL, feature->id == NULL);
    if (id.kind == GIS_INTEGER) assert_int_equal(id.as.integer, strtoll(feature->id, NULL, 10));
    if (id.kind == GIS_REAL) assert_true(id.as.real == strtod(feature->id, NULL));
    if (id.kind == GIS_TEXT) assert_string_equal(id.as.text, feature->id);
    free(copy);
    sunder_shape_free((sunder_shape *)feature->demands.shape);
    return true;
}

static void compare_statuses(const gis_layer_input *whole)
{
    FILE *file = fopen(scratch_path("status"), "r");
    assert_non_null(file);
    for (size_t i = 0; i < whole->n; i++) {
        const sunder_feature *d = &whole->feature[i];
        assert_int_equal(fgetc(file), d->ignored                      ? SUNDER_FEATURE_SKIPPED
                                      : d->fixed || d->max_shift == 0 ? SUNDER_FEATURE_FIXED
                                                                      : SUNDER_FEATURE_UNMOVED);
    }
    assert_int_equal(fgetc(file), EOF);
    fclose(file);
}

static void compare_facts(const gis_layer_input *whole, const gis_layer_facts *facts)
{
    double box[4];
    gis_layer_box(whole, box);
    size_t vertices = 0;
    for (size_t i = 0; i < whole->n; i++) vertices += whole->shape[i] ? sunder_shape_vertices(whole->shape[i]) : 0;
    assert_memory_equal(box, facts->box, sizeof box);
    assert_int_equal(vertices, facts->vertices);
    assert_int_equal(whole->n, facts->source.features);
    assert_int_equal(gis_source_fids_unique(whole->source), facts->source.fids_unique);
    assert_int_equal(gis_source_has_multipolygons(whole->source), facts->source.multipolygons);
    for (int c = 0; c < GIS_CONTENTS; c++)
        assert_int_equal(gis_source_content_count(whole->source, (gis_content)c), facts->source.content[c]);
    assert_int_equal(whole->invalid, facts->invalid);
    assert_int_equal(whole->null, facts->null);
    assert_int_equal(whole->other, facts->other);
    assert_true(whole->gap == facts->gap && whole->tolerance == facts->tolerance);
    assert_true(whole->max_shift == facts->max_shift);
    assert_string_equal(gis_source_name(whole->source), facts->name);
    assert_int_equal(gis_id_type(whole), facts->id_type);
}

static void compare_spool(const gis_layer_input_request *request)
{
    gis_error error = {0};
    gis_layer_input whole;
    gis_layer_facts facts;
    gis_spool *spool;
    assert_true(gis_layer_input_read(request, &whole, &error));
    assert_true(gis_layer_spool(request, 3, scratch_directory(), &facts, &error));
    compare_facts(&whole, &facts);
    compare_statuses(&whole);
    assert_true(gis_spool_open(scratch_directory(), &spool, &error));
    comparing c = {.whole = &whole, .found = calloc(whole.n + 1, sizeof *c.found)};
    for (size_t k = 0; k < gis_spool_cells(spool); k++) assert_true(gis_spool_read(spool, k, compare, &c, &error));
    assert_int_equal(c.n + facts.skipped, whole.n);
    free(c.found);
    gis_spool_close(spool);
    gis_layer_facts_clear(&facts);
    gis_layer_input_clear(&whole);
}

static gis_layer_input_request request_for(const char *file)
{
    gis_layer_input_request request = {.source = {.path = scratch_path(file)}, .moves = true};
    request.rules.gap = (gis_optional_length){"0.5", {0.5, GIS_LAYER_UNIT}};
    request.rules.max_shift = (gis_optional_length){"7", {7, GIS_LAYER_UNIT}};
    return request;
}

static void test_plain(void **state)
{
    gis_layer_input_request request = request_for("polygons.gpkg");
    compare_spool(&request);
    request.source.where = "kind < 4";
    request.source.bbox = (double[]){100, 200, 1700, 1500};
    request.id_field = "street";
    compare_spool(&request);
    request.source.where = "kind > 11"; /* selects no features */
    compare_spool(&request);
}

static void test_rules(void **state)
{
    gis_layer_input_request request = request_for("polygons.gpkg");
    request.rules.fixed_where = "kind = 3";
    request.rules.ignore_where = "fid % 4 = 1 OR kind = 5";
    request.rules.block_field = "street";
    request.rules.weight_field = "factor";
    request.rules.max_shift_field = "limit";
    request.id_field = "factor";
    for (int by = GIS_WEIGHTING_EVEN; by <= GIS_WEIGHTING_SQRT_AREA; by++) {
        request.rules.weighting = (gis_weighting)by;
        compare_spool(&request);
    }
    request.source.where = "kind <> 7";
    request.invalid = GIS_INVALID_SKIP;
    request.id_field = "kind";
    compare_spool(&request);
}

/* FIDs of an SQL result need not ascend; those of a plain layer may be repeated. */
static void test_fids(void **state)
{
    gis_layer_input_request request = request_for("polygons.gpkg");
    request.rules.fixed_where = "kind = 3";
    request.source.sql = "SELECT * FROM made ORDER BY factor, fid";
    compare_spool(&request);
    request = request_for("twice.vrt");
    request.rules.fixed_where = "kind = 3";
    request.rules.ignore_where = "street = 's12' OR FID < 20000";
    compare_spool(&request);
}

static void test_points(void **state)
{
    gis_layer_input_request request = request_for("points.gpkg");
    request.symbol = "disc:2:8";
    request.symbol_field = "symbol";
    request.symbol_size_field = "factor";
    request.rules.weighting = GIS_WEIGHTING_AREA;
    compare_spool(&request);
}

static void expect_failure(const gis_layer_input_request *request, const char *said)
{
    gis_error error = {0};
    gis_layer_facts facts;
    assert_false(gis_layer_spool(request, 1, scratch_directory(), &facts, &error));
    gis_layer_facts_clear(&facts);
    assert_non_null(strstr(error.message, said));
    assert_int_not_equal(access(scratch_path("status.part"), F_OK), 0);
    assert_int_not_equal(access(scratch_path("features.runs"), F_OK), 0);
}

static void test_failures(void **state)
{
    gis_layer_input_request request = request_for("polygons.gpkg");
    request.rules.fixed_where = "nothing = 3";
    expect_failure(&request, "--fixed-where \"nothing = 3\"");
    request = request_for("polygons.gpkg");
    request.rules.weight_field = "kind"; /* the field is 0 for some features, an invalid weight */
    expect_failure(&request, "the weight in kind is 0");
    request.rules.weight_field = NULL;
    request.rules.block_field = "streets";
    expect_failure(&request, "--block-field");
}

/* ---- Batches ----------------------------------------------------------------------------------------------------- */

static void test_batches(void **state)
{
    gis_error error = {0};
    gis_source *whole, *source;
    gis_source_facts facts;
    gis_source_request request = {.path = scratch_path("polygons.gpkg"), .takes = GIS_TAKES_POLYGONS, .packed = true};
    assert_true(gis_source_open(&request, &whole, &error));
    for (size_t batch = 1; batch < 2 * FEATURES; batch = 7 * batch + 1) {
        request.batch = batch;
        request.facts = NULL;
        for (int again = 0; again < 2; again++) {
            assert_true(gis_source_open(&request, &source, &error));
            size_t seen = 0;
            for (bool any = true; any;) {
                assert_int_equal(gis_source_first(source), seen);
                assert_true(gis_source_count(source) <= batch);
                for (size_t i = 0; i < gis_source_count(source); i++, seen++) {
                    assert_int_equal(gis_source_fid(source, i), gis_source_fid(whole, seen));
                    assert_int_equal(gis_source_content(source, i), gis_source_content(whole, seen));
                }
                assert_true(gis_source_next(source, &any, &error));
            }
            assert_int_equal(seen, FEATURES);
            bool any = false;
            if (again) {
                assert_true(gis_source_again(source, &any, &error));
                assert_true(any && gis_source_first(source) == 0);
                assert_int_equal(gis_source_fid(source, 0), gis_source_fid(whole, 0));
                while (any) assert_true(gis_source_next(source, &any, &error));
            }
            assert_true(gis_source_find_facts(source, &facts, &error));
            assert_true(facts.fids_unique && facts.multipolygons && facts.features == FEATURES);
            gis_source_close(source);
            request.facts = &facts;
        }
    }
    /* Wrong facts about the layer are detected. */
    facts.features++;
    assert_true(gis_source_open(&request, &source, &error));
    bool any = true, done = true;
    while (any && done) done = gis_source_next(source, &any, &error);
    assert_false(done);
    assert_non_null(strstr(error.message, "and had 20001"));
    gis_source_close(source);
    gis_source_close(whole);
}

static int make_layers(void **state)
{
    if (scratch_set_up(state) != 0) return -1;
    make_layer("polygons.gpkg", false);
    make_layer("points.gpkg", true);
    make_union("twice.vrt");
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plain),  cmocka_unit_test(test_rules),    cmocka_unit_test(test_fids),
        cmocka_unit_test(test_points), cmocka_unit_test(test_failures), cmocka_unit_test(test_batches),
    };
    GDALAllRegister();
    gis_messages_begin(&(gis_messages_request){.quiet = true}, NULL);
    return cmocka_run_group_tests(tests, make_layers, scratch_tear_down);
}
