/* Rows that are inserted in batches equal the given ones, also if the caller reuses their memory, on the caller's
 * thread and on another. A row that breaks a constraint is reported with its key at any place in a batch, and the rows
 * before it are inserted. Numbers with attached data are sorted; equal ones keep their order. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/keyed_sort.h"
#include "gpkg/sqlite_insert.h"
#include "gpkg/sqlite_rows.h"
#include "gpkg/sqlite_select.h"

#include <gdal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 13000 }; /* more than the buffer holds */

static GDALDatasetH dataset;
static unsigned threads; /* on which rows are inserted */

static void *database(void) { return GDALGetInternalHandle(dataset, "SQLITE_HANDLE"); }

static int set_up(void **state)
{
    (void)state;
    GDALAllRegister();
    dataset = GDALCreate(GDALGetDriverByName("GPKG"), "/vsimem/rows.gpkg", 0, 0, 0, GDT_Unknown, NULL);
    return dataset ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    GDALClose(dataset);
    return 0;
}

static void begin(gis_sqlite_inserts *rows)
{
    assert_true(gis_sqlite_run(database(), "DROP TABLE IF EXISTS t"));
    assert_true(gis_sqlite_run(database(), "CREATE TABLE t (k INTEGER PRIMARY KEY AUTOINCREMENT, b BLOB, x REAL, "
                                           "s TEXT NOT NULL, n INTEGER UNIQUE)"));
    assert_true(gis_sqlite_inserts_begin(rows, database(), "INSERT INTO t (k, b, x, s, n) VALUES ", 5, threads));
}

/* Adds row number n with that key. The caller's bytes and text are overwritten afterwards. */
static bool add(gis_sqlite_inserts *rows, int64_t key, int64_t n, int64_t *failed, const char **reason)
{
    unsigned char bytes[64];
    char text[32];
    const size_t size = (size_t)(key % 60);
    memset(bytes, (int)(key & 255), sizeof bytes);
    snprintf(text, sizeof text, "row %lld", (long long)key);
    const gis_value values[] = {{GIS_REAL, {.real = (double)key / 8}},
                                {GIS_TEXT, {.text = key % 7 ? text : ""}},
                                {GIS_INTEGER, {.integer = n}}};
    *failed = key;
    const bool done = gis_sqlite_inserts_add(rows, failed, bytes, size, values, reason);
    memset(bytes, 0, sizeof bytes);
    memset(text, '?', sizeof text);
    return done;
}

static size_t count_right(void)
{
    void *statement = gis_sqlite_select_begin(database(), "SELECT k, b, x, s, n FROM t ORDER BY k");
    size_t right = 0;
    assert_non_null(statement);
    while (gis_sqlite_select_next(statement) == GIS_SQLITE_HAS_ROW) {
        gis_value key, x, s, n;
        size_t size;
        bool null;
        char text[32];
        assert_true(gis_sqlite_select_value(statement, 0, &key) && gis_sqlite_select_value(statement, 2, &x) &&
                    gis_sqlite_select_value(statement, 3, &s) && gis_sqlite_select_value(statement, 4, &n));
        const unsigned char *bytes = gis_sqlite_select_bytes(statement, 1, &size, &null);
        snprintf(text, sizeof text, "row %lld", (long long)key.as.integer);
        assert_false(null);
        assert_int_equal(size, key.as.integer % 60);
        for (size_t k = 0; k < size; k++) assert_int_equal(bytes[k], key.as.integer & 255);
        assert_true(x.as.real == (double)key.as.integer / 8 && n.as.integer == key.as.integer);
        assert_string_equal(s.as.text, key.as.integer % 7 ? text : "");
        right++;
    }
    gis_sqlite_select_end(statement);
    return right;
}

static void test_rows(void **state)
{
    (void)state;
    for (threads = 1; threads <= 2; threads++) {
        gis_sqlite_inserts rows;
        int64_t failed;
        const char *reason;
        begin(&rows);
        assert_true(threads == 1 || rows.beside);
        for (int64_t k = 1; k <= ROWS; k++) {
            assert_true(add(&rows, k, k, &failed, &reason));
            if (k % 1111 == 0)
                assert_true(gis_sqlite_inserts_flush(&rows, &failed, &reason) && count_right() == (size_t)k);
        }
        assert_true(rows.at_once > 1);
        assert_true(gis_sqlite_inserts_flush(&rows, &failed, &reason));
        assert_int_equal(count_right(), ROWS);
        gis_sqlite_inserts_end(&rows);
    }
}

/* The last column is unique, so the number of an earlier row is refused. */
static void refuse(int64_t bad)
{
    gis_sqlite_inserts rows;
    int64_t failed = 0;
    const char *reason = NULL;
    bool done = true;
    begin(&rows);
    for (int64_t k = 1; k <= ROWS && done; k++) done = add(&rows, k, k == bad ? 1 : k, &failed, &reason);
    assert_false(done && gis_sqlite_inserts_flush(&rows, &failed, &reason));
    assert_int_equal(failed, bad);
    assert_non_null(strstr(reason, "UNIQUE"));
    assert_int_equal(count_right(), bad - 1);
    gis_sqlite_inserts_end(&rows);
}

static void test_refused(void **state)
{
    (void)state;
    for (threads = 1; threads <= 2; threads++) {
        for (int64_t bad = 2; bad < 140; bad += 23) refuse(bad);
        for (int64_t bad = 460; bad < ROWS; bad += 1100) refuse(bad);
        refuse(ROWS);
    }
}

/* After inserts are abandoned, only the batch that has begun is written. */
static void test_given_up(void **state)
{
    (void)state;
    gis_sqlite_inserts rows;
    int64_t failed;
    const char *reason;
    threads = 2;
    begin(&rows);
    for (int64_t k = 1; k <= ROWS; k++) assert_true(add(&rows, k, k, &failed, &reason));
    gis_sqlite_inserts_end(&rows);
    const size_t in = count_right();
    assert_true(in > 0 && in < ROWS && in % 64 == 0);
}

/* Demands that the rows, given in two calls, are stored; for keys that are consecutive, have gaps, are negative, reach
 * the maximum, or descend. */
static void demand_pairs(int64_t first, int64_t step, size_t gap_at)
{
    enum { PAIRS = 1234, CUT = 333 };
    static int64_t row[PAIRS][2];
    gis_sqlite_rows rows;
    gis_error error;
    for (size_t k = 0; k < PAIRS; k++) {
        row[k][0] = first + step * (int64_t)k + (gap_at && k >= gap_at ? 5 * step : 0);
        row[k][1] = (int64_t)(k * 7919 % 1000);
    }
    assert_true(gis_sqlite_run(database(), "DROP TABLE IF EXISTS pairs"));
    assert_true(gis_sqlite_run(database(), "CREATE TABLE pairs (k INTEGER PRIMARY KEY, v)"));
    assert_true(gis_sqlite_rows_begin(&rows, database(), "pairs", "v", "the test", &error));
    assert_true(gis_sqlite_rows_add(&rows, (const int64_t(*)[2])row, CUT, &error) &&
                gis_sqlite_rows_add(&rows, (const int64_t(*)[2])row + CUT, PAIRS - CUT, &error));
    gis_sqlite_rows_end(&rows);
    void *statement = gis_sqlite_select_begin(database(), step > 0 ? "SELECT k, v FROM pairs ORDER BY k"
                                                                   : "SELECT k, v FROM pairs ORDER BY k DESC");
    for (size_t k = 0; k < PAIRS; k++) {
        gis_value key, value;
        assert_int_equal(gis_sqlite_select_next(statement), GIS_SQLITE_HAS_ROW);
        assert_true(gis_sqlite_select_value(statement, 0, &key) && gis_sqlite_select_value(statement, 1, &value));
        assert_true(key.as.integer == row[k][0] && value.as.integer == row[k][1]);
    }
    assert_int_equal(gis_sqlite_select_next(statement), GIS_SQLITE_AT_END);
    gis_sqlite_select_end(statement);
}

static void test_pairs(void **state)
{
    (void)state;
    demand_pairs(1, 1, 0);
    demand_pairs(17, 1, 0);
    demand_pairs(-600, 1, 0);
    demand_pairs(INT64_MAX - 1233, 1, 0);
    demand_pairs(1, 3, 0);
    demand_pairs(2000, -1, 0);
    for (size_t gap_at = 1; gap_at < 1200; gap_at += 66) demand_pairs(1, 1, gap_at);
}

static void test_keyed(void **state)
{
    (void)state;
    for (size_t n = 0; n < 5000; n = 3 * n + 1) {
        gis_keyed *list = calloc(n + 1, sizeof *list);
        assert_non_null(list);
        for (size_t k = 0; k < n; k++) list[k] = (gis_keyed){(k * UINT64_C(0x9e3779b97f4a7c15) >> (n % 3 ? 3 : 50)), k};
        assert_true(gis_keyed_sort(list, n));
        for (size_t k = 1; k < n; k++)
            assert_true(list[k - 1].key < list[k].key ||
                        (list[k - 1].key == list[k].key && list[k - 1].with < list[k].with));
        free(list);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_rows), cmocka_unit_test(test_refused),
                                       cmocka_unit_test(test_given_up), cmocka_unit_test(test_pairs),
                                       cmocka_unit_test(test_keyed)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
