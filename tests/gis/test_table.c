/* A GeoPackage table that is read without GDAL gives the same features as GDAL, one by one; and if a row is not plain,
 * GDAL reads the whole table. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/message.h"
#include "gpkg/table.h"
#include "read/source.h"
#include "scratch.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Layers ------------------------------------------------------------------------------------------------------ */

static const char *const wkt[] = {
    "POLYGON((0.1 0,7 0,7 7.3,0 7,0.1 0))",
    "POLYGON((10 0,19 0,19 9,10 9,10 0),(12 2,12 3,13 3,12 2))",
    "POLYGON((20 0,29 0,29 9))", /* the ring is not closed */
    "MULTIPOLYGON(((30 0,34 0,34 4,30 0)),((36 0,39 0,39 3,36 0),(37 0.1,38 0.1,38 0.2,37 0.1)))",
    "POLYGON((40 0,49 0,49 9,40 9,40 0))",
};
enum { FEATURES = sizeof wkt / sizeof *wkt };

/* The layer, after an SQL statement that changes it; NULL: no statement. */
static void make_layer(const char *name, const char *statement)
{
    static const struct {
        const char *name;
        OGRFieldType type;
    } fields[] = {{"say \"so\"", OFTString}, {"small", OFTInteger}, {"large", OFTInteger64}, {"real", OFTReal}};
    GDALDatasetH dataset = GDALCreate(GDALGetDriverByName("GPKG"), scratch_path(name), 0, 0, 0, GDT_Unknown, NULL);
    OGRLayerH layer = GDALDatasetCreateLayer(dataset, "a \"layer\"", NULL, wkbUnknown, NULL);
    assert_non_null(layer);
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        OGRFieldDefnH field = OGR_Fld_Create(fields[i].name, fields[i].type);
        assert_int_equal(OGR_L_CreateField(layer, field, TRUE), OGRERR_NONE);
        OGR_Fld_Destroy(field);
    }
    for (int i = 0; i < FEATURES; i++) {
        OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
        char text[200], *at = strcpy(text, wkt[i]);
        OGRGeometryH geometry = NULL;
        assert_int_equal(OGR_G_CreateFromWkt(&at, NULL, &geometry), OGRERR_NONE);
        OGR_F_SetGeometryDirectly(feature, geometry);
        OGR_F_SetFID(feature, 7 * (FEATURES - i)); /* written in another order than they are read in */
        if (i != 1) OGR_F_SetFieldString(feature, 0, i == 2 ? "" : "gr\xc3\xbc\xc3\x9f");
        if (i != 2) OGR_F_SetFieldInteger(feature, 1, -i);
        if (i != 3) OGR_F_SetFieldInteger64(feature, 2, (GIntBig)1 << 40);
        if (i != 4) OGR_F_SetFieldDouble(feature, 3, 0.1 * i);
        assert_int_equal(OGR_L_CreateFeature(layer, feature), OGRERR_NONE);
        OGR_F_Destroy(feature);
    }
    GDALClose(dataset);
    if (!statement) return;
    char *const drivers[] = {"GPKG", NULL};
    dataset = GDALOpenEx(scratch_path(name), GDAL_OF_VECTOR | GDAL_OF_UPDATE, (const char *const *)drivers, NULL, NULL);
    assert_non_null(dataset);
    OGRLayerH result = GDALDatasetExecuteSQL(dataset, statement, NULL, NULL);
    if (result) GDALDatasetReleaseResultSet(dataset, result);
    GDALClose(dataset);
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static bool count(void *user, const unsigned char *record, gis_error *error)
{
    (void)record;
    (void)error;
    ++*(size_t *)user;
    return true;
}

/* For a number of threads, the number of chunks. */
static bool is_read(const char *name, unsigned threads, size_t *chunks)
{
    gis_error error = {0};
    GDALDatasetH dataset = GDALOpenEx(scratch_path(name), GDAL_OF_VECTOR, NULL, NULL, NULL);
    OGRLayerH layer = GDALDatasetGetLayer(dataset, 0);
    gis_packed packed = {0};
    size_t n = 0;
    bool all;
    assert_true(gis_packed_begin(&packed, layer, &error));
    assert_true(gis_table_read(dataset, layer, threads, &packed, count, &n, &all, &error));
    if (all) assert_int_equal(n, OGR_L_GetFeatureCount(layer, TRUE));
    *chunks = packed.chunks;
    gis_packed_clear(&packed);
    GDALClose(dataset);
    return all;
}

static bool is_read_past_gdal(const char *name)
{
    size_t chunks;
    const bool read = is_read(name, 1, &chunks);
    assert_int_equal(is_read(name, 2, &chunks), read);
    return read;
}

/* Each half of the table has its own chunks; the first are the smallest. */
static bool is_read_in_halves(const char *name)
{
    size_t whole, halves;
    return is_read(name, 1, &whole) && is_read(name, 2, &halves) && halves > whole;
}

static bool open_source(const char *name, bool packed, gis_source **source, gis_error *error)
{
    const gis_source_request request = {.path = scratch_path(name), .takes = GIS_TAKES_POLYGONS, .packed = packed};
    return gis_source_open(&request, source, error);
}

static bool same_bytes(OGRGeometryH a, OGRGeometryH b)
{
    if (!a || !b) return !a && !b;
    const int n = OGR_G_WkbSize(a);
    if (n != OGR_G_WkbSize(b)) return false;
    unsigned char *p = malloc((size_t)n + 1), *q = malloc((size_t)n + 1);
    OGR_G_ExportToIsoWkb(a, wkbNDR, p);
    OGR_G_ExportToIsoWkb(b, wkbNDR, q);
    const bool same = memcmp(p, q, (size_t)n) == 0;
    free(p);
    free(q);
    return same;
}

static void assert_same_features(gis_source *a, gis_source *b)
{
    assert_int_equal(gis_source_count(a), gis_source_count(b));
    assert_int_equal(gis_source_fids_unique(a), gis_source_fids_unique(b));
    assert_int_equal(gis_source_has_multipolygons(a), gis_source_has_multipolygons(b));
    for (size_t i = 0; i < gis_source_count(a); i++) {
        OGRFeatureH p = gis_source_feature(a, i), q = gis_source_feature(b, i);
        assert_int_equal(OGR_F_GetFID(p), OGR_F_GetFID(q));
        assert_int_equal(gis_source_content(a, i), gis_source_content(b, i));
        assert_true(same_bytes(OGR_F_GetGeometryRef(p), OGR_F_GetGeometryRef(q)));
        for (int f = 0; f < OGR_F_GetFieldCount(p); f++) {
            assert_int_equal(OGR_F_IsFieldSet(p, f), OGR_F_IsFieldSet(q, f));
            assert_int_equal(OGR_F_IsFieldNull(p, f), OGR_F_IsFieldNull(q, f));
            assert_string_equal(OGR_F_GetFieldAsString(p, f), OGR_F_GetFieldAsString(q, f));
        }
    }
    for (int c = 0; c < GIS_CONTENTS; c++)
        assert_int_equal(gis_source_content_count(a, (gis_content)c), gis_source_content_count(b, (gis_content)c));
}

static void assert_read_alike(const char *name)
{
    gis_source *a = NULL, *b = NULL;
    gis_error why_a = {0}, why_b = {0};
    const bool read = open_source(name, true, &a, &why_a);
    assert_int_equal(open_source(name, false, &b, &why_b), read);
    if (read)
        assert_same_features(a, b);
    else
        assert_string_equal(why_a.message, why_b.message);
    gis_source_close(a);
    gis_source_close(b);
}

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

static void test_plain(void **state)
{
    (void)state;
    make_layer("plain.gpkg", NULL);
    assert_true(is_read_past_gdal("plain.gpkg"));
    assert_read_alike("plain.gpkg");
}

/* The shape of feature i, with the positions of its vertices in the input. */
static sunder_shape *shape_of(const gis_source *source, size_t i)
{
    gis_polygonal_part part = {0};
    gis_error error = {0};
    sunder_error why;
    sunder_shape *shape = NULL;
    assert_true(gis_source_polygons(source, i, &part, &error));
    assert_int_equal(gis_polygons_shape(&part.set, SUNDER_VALIDITY_EVEN_ODD, &shape, &why), SUNDER_OK);
    gis_polygonal_part_clear(&part);
    return shape;
}

/* Demands that the geometry of feature i, after a move, is the one in the row written without GDAL. */
static void assert_written_moved(const gis_source *source, size_t i, OGRGeometryH geometry)
{
    const int map[] = {0, 1, 2, 3};
    const unsigned char *wkb;
    size_t bytes;
    gis_value values[4];
    gis_error error = {0};
    OGRGeometryH moved = OGR_G_Clone(geometry), written = NULL;
    assert_true(gis_geometry_translate(moved, 0.3, -7, &error));
    assert_true(gis_source_plain(source, i, 0.3, -7, map, values, &wkb, &bytes));
    assert_int_equal(OGR_G_CreateFromWkb(wkb, NULL, &written, (int)bytes), OGRERR_NONE);
    assert_true(same_bytes(moved, written));
    OGR_G_DestroyGeometry(moved);
    OGR_G_DestroyGeometry(written);
}

/* A record that refers to the vertices of shapes equals the original, also if there is no shape, or that of another
 * feature. */
static void test_borrowing(void **state)
{
    enum { WITHOUT = 1, OTHER = 3 };
    gis_source *a = NULL, *b = NULL;
    gis_error error = {0};
    sunder_shape *shape[FEATURES];
    (void)state;
    make_layer("borrowing.gpkg", NULL);
    assert_true(open_source("borrowing.gpkg", true, &a, &error) && open_source("borrowing.gpkg", false, &b, &error));
    for (size_t i = 0; i < FEATURES; i++)
        shape[i] = i == WITHOUT ? NULL : shape_of(a, i == OTHER ? (size_t)WITHOUT : i);
    assert_true(gis_source_borrow(a, shape, 2, &error));
    assert_same_features(a, b);
    for (size_t i = 0; i < FEATURES; i++) {
        assert_written_moved(a, i, OGR_F_GetGeometryRef(gis_source_feature(b, i)));
        sunder_shape *again = shape_of(a, i), *was = shape_of(b, i);
        assert_true(sunder_shape_area(again) == sunder_shape_area(was));
        sunder_shape_free(again);
        sunder_shape_free(was);
    }
    assert_true(gis_source_unpack(a, &error));
    for (size_t i = 0; i < FEATURES; i++) sunder_shape_free(shape[i]);
    assert_same_features(a, b);
    gis_source_close(a);
    gis_source_close(b);
}

/* The last row that is read. */
#define LAST " WHERE fid = 35"
#define UPDATE "UPDATE \"a \"\"layer\"\"\" SET "

static void test_not_plain(void **state)
{
    static const char *const statement[] = {
        UPDATE "geom = NULL" LAST,
        UPDATE "geom = 'text'" LAST,
        UPDATE "geom = substr(geom, 1, length(geom) - 8)" LAST,                     /* cut short */
        UPDATE "geom = CAST(geom || x'00' AS BLOB)" LAST,                           /* a byte too long */
        UPDATE "geom = CAST(x'475000010000000001060000000000000000' AS BLOB)" LAST, /* no members */
        /* a ring without points */
        UPDATE "geom = CAST(x'4750000100000000010300000001000000' || x'00000000' AS BLOB)" LAST,
        UPDATE "geom = CAST(x'47500001000000000000000003000000010000000400000000000000000000000000000000000000003ff"
               "000000000000000000000000000003ff00000000000003ff000000000000000000000000000000000000000000000' AS "
               "BLOB)" LAST, /* the other byte order */
        UPDATE "geom = CAST(x'4750000100000000010100000000000000000000000000000000000000' AS BLOB)" LAST, /* a point */
        UPDATE "geom = CAST(x'475000010000000001030000000100000003000000000000000000f07f000000000000000000000000000000"
               "000000000000000000000000000000000000000000000000000000' AS BLOB)" LAST, /* not finite, and too short */
        UPDATE "small = 'many'" LAST,
        UPDATE "small = 1.5" LAST,
        UPDATE "small = 5000000000" LAST,
        UPDATE "large = 'many'" LAST,
        UPDATE "large = x'00'" LAST,
        UPDATE "real = 'many'" LAST,
        UPDATE "\"say \"\"so\"\"\" = x'41'" LAST,
        UPDATE "\"say \"\"so\"\"\" = CAST(x'41ff' AS TEXT)" LAST,
        UPDATE "\"say \"\"so\"\"\" = CAST(x'410041' AS TEXT)" LAST,
    };
    (void)state;
    for (size_t k = 0; k < sizeof statement / sizeof *statement; k++) {
        char name[32];
        snprintf(name, sizeof name, "odd%zu.gpkg", k);
        make_layer(name, statement[k]);
        if (is_read_past_gdal(name)) fail_msg("read without GDAL after %s", statement[k]);
        assert_read_alike(name);
    }
}

/* A field of a type that records do not have. */
static void test_other_fields(void **state)
{
    (void)state;
    make_layer("date.gpkg", "ALTER TABLE \"a \"\"layer\"\"\" ADD COLUMN day DATE");
    assert_false(is_read_past_gdal("date.gpkg"));
    assert_read_alike("date.gpkg");
}

/* ---- Reading in halves ------------------------------------------------------------------------------------------- */

#define LAYER "\"a \"\"layer\"\"\""
/* Inserts 6000 more rows, copies of existing ones, whose keys are given by an SQL expression in i, which is 1 to
 * 6000. */
#define MORE(key)                                                                                                      \
    "INSERT INTO " LAYER " (fid, geom, \"say \"\"so\"\"\", small, large, real) "                                       \
    "WITH RECURSIVE k(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM k WHERE i < 6000) "                                  \
    "SELECT " key ", geom, \"say \"\"so\"\"\", i, large, real FROM k JOIN " LAYER " ON fid = 7 * (1 + i % 5)"

/* The layer after several SQL statements; NULL ends the list. */
static void make_by(const char *name, const char *const *statement)
{
    make_layer(name, NULL);
    GDALDatasetH dataset = GDALOpenEx(scratch_path(name), GDAL_OF_VECTOR | GDAL_OF_UPDATE, NULL, NULL, NULL);
    assert_non_null(dataset);
    for (; *statement; statement++) {
        CPLErrorReset();
        OGRLayerH result = GDALDatasetExecuteSQL(dataset, *statement, NULL, NULL);
        if (result) GDALDatasetReleaseResultSet(dataset, result);
        if (CPLGetLastErrorType() != CE_None) fail_msg("%s: %s", *statement, CPLGetLastErrorMsg());
    }
    GDALClose(dataset);
}

/* Keys with gaps, negative, at both ends of the range of integers, and tables whose rows are all in one half. */
static void test_halves(void **state)
{
    static const struct {
        const char *statement;
        bool halves;
    } cases[] = {
        {MORE("i + 100"), true},
        {MORE("3 * i * i + 100"), true},
        {MORE("-i"), true},
        {MORE("(i - 3000) * 3074457345618258 - 1"), true},
        {MORE("9223372036854775807 - i + 1"), true},
        {UPDATE "fid = 9000 WHERE fid = 7", true},
        {UPDATE "fid = -9223372036854775807 - 1 WHERE fid = 7", true},
        {"DELETE FROM " LAYER, false},
        {"DELETE FROM " LAYER " WHERE fid > 7", false},
        {MORE("i + 100") " WHERE i < 4000", false},
    };
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const char *const statements[] = {cases[k].statement, NULL};
        char name[32];
        snprintf(name, sizeof name, "halves%zu.gpkg", k);
        make_by(name, statements);
        assert_true(is_read_past_gdal(name));
        if (is_read_in_halves(name) != cases[k].halves)
            fail_msg("the features read differ after %s", cases[k].statement);
        assert_read_alike(name);
    }
}

/* If a row in either half is not plain, GDAL reads all rows, and the message is that of GDAL about the first such
 * feature. */
static void test_not_plain_in_halves(void **state)
{
    /* A coordinate that is not finite. */
    static const char *const first =
        UPDATE "geom = CAST(substr(geom, 1, 53) || x'000000000000f07f' || substr(geom, 62) "
               "AS BLOB) WHERE fid = 107 AND length(geom) > 62";
    static const char *const second =
        UPDATE "geom = CAST(substr(geom, 1, 53) || x'000000000000f07f' || substr(geom, 62)"
               " AS BLOB) WHERE fid = 6087 AND length(geom) > 62";
    static const char *const null = UPDATE "geom = NULL WHERE fid = 6000";
    static const char *const cases[][4] = {{MORE("i + 100"), first, NULL},
                                           {MORE("i + 100"), second, NULL},
                                           {MORE("i + 100"), second, first, NULL},
                                           {MORE("i + 100"), null, first, NULL},
                                           {MORE("i + 100"), null, NULL}};
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char name[32];
        snprintf(name, sizeof name, "odd-halves%zu.gpkg", k);
        make_by(name, cases[k]);
        assert_false(is_read_past_gdal(name));
        assert_read_alike(name);
    }
}

/* If rows are not stored in the order of their keys, or two connections may see different rows, the table is read by
 * one connection. */
static void test_as_one(void **state)
{
    static const char *const index[] = {
        MORE("i + 100"), "CREATE INDEX covering ON " LAYER " (real, small, large, \"say \"\"so\"\"\", geom)", "ANALYZE",
        /* statistics that claim short index entries, so that SQLite reads the rows by the index */
        "UPDATE sqlite_stat1 SET stat = stat || ' sz=1' WHERE idx = 'covering'", NULL};
    static const char *const part[] = {MORE("i + 100"), "CREATE INDEX by_small ON " LAYER " (small)", NULL};
    static const char *const log[] = {MORE("i + 100"), "PRAGMA journal_mode = wal", NULL};
    (void)state;
    make_by("index.gpkg", index);
    assert_false(is_read_in_halves("index.gpkg"));
    assert_read_alike("index.gpkg");
    make_by("part.gpkg", part);
    assert_true(is_read_in_halves("part.gpkg"));
    assert_read_alike("part.gpkg");
    make_by("log.gpkg", log);
    assert_false(is_read_in_halves("log.gpkg"));
    assert_read_alike("log.gpkg");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plain),     cmocka_unit_test(test_borrowing),
        cmocka_unit_test(test_not_plain), cmocka_unit_test(test_other_fields),
        cmocka_unit_test(test_halves),    cmocka_unit_test(test_not_plain_in_halves),
        cmocka_unit_test(test_as_one),
    };
    GDALAllRegister();
    gis_messages_begin(&(gis_messages_request){.quiet = true}, NULL);
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
