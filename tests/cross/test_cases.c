/* Exact hard cases in ../shared/cases, beside the repository (its README describes them and their origin): sums by the
 * library and by the oracle, and the least translation, compared with the known results. */
#include "expect.h"
#include "oracle.h"
#include "sum_text.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gmp.h>

typedef struct known {
    char *name;
    polyset p, q;
    json *record;
} known;

typedef struct known_list {
    known *at;
    size_t n;
} known_list;

static known_list cases;

static int name_order(const void *a, const void *b)
{
    return strcmp(((const known *)a)->name, ((const known *)b)->name);
}

static bool read_case(const char *folder, const char *file, known *out)
{
    const size_t stem = strlen(file) - 4;
    char *path = test_format("%s/%s", folder, file), *text = test_read_file(path);
    char *record_path = test_format("%s/%.*s.expect.json", folder, (int)stem, file),
         *record = test_read_file(record_path);
    const char *end;
    bool ok = text && record && polyset_read_wkt(&out->p, text, &end);
    ok = ok && polyset_read_wkt(&out->q, end, NULL) && (out->record = json_read(record)) != NULL;
    out->name = test_format("%.*s", (int)stem, file);
    free(path);
    free(text);
    free(record_path);
    free(record);
    return ok;
}

static int read_cases(void **state)
{
    (void)state;
    const char *source = getenv("SUNDER_SOURCE");
    char *folder = test_format("%s/../shared/cases", source ? source : SUNDER_SOURCE);
    DIR *dir = opendir(folder);
    int bad = 0;
    if (!dir) print_message("no %s: the exact cases are skipped\n", folder);
    for (struct dirent *e; dir && (e = readdir(dir));) {
        const size_t n = strlen(e->d_name);
        if (n < 5 || strcmp(e->d_name + n - 4, ".wkt")) continue;
        cases.at = test_resize(cases.at, cases.n + 1, sizeof *cases.at);
        if (!read_case(folder, e->d_name, &cases.at[cases.n++])) {
            print_message("cannot read %s\n", e->d_name);
            bad = -1;
        }
    }
    if (dir) closedir(dir);
    if (cases.n) qsort(cases.at, cases.n, sizeof *cases.at, name_order);
    free(folder);
    return bad;
}

static int free_cases(void **state)
{
    (void)state;
    for (size_t i = 0; i < cases.n; i++) {
        free(cases.at[i].name);
        polyset_free(&cases.at[i].p);
        polyset_free(&cases.at[i].q);
        json_free(cases.at[i].record);
    }
    free(cases.at);
    return 0;
}

static void compare_all(char *(*sum)(const polyset *p, const polyset *q))
{
    size_t bad = 0;
    if (!cases.n) skip();
    for (size_t i = 0; i < cases.n; i++) {
        char *text = sum(&cases.at[i].p, &cases.at[i].q);
        char *complaint = text ? expect_compare(text, cases.at[i].record) : test_format("no sum");
        if (complaint) print_message("%s: %s\n", cases.at[i].name, complaint), bad++;
        free(complaint);
        free(text);
    }
    print_message("%zu of %zu cases agree\n", cases.n - bad, cases.n);
    assert_int_equal(bad, 0);
}

static void test_library(void **state)
{
    (void)state;
    compare_all(library_sum_text);
}

static char *oracle_sum(const polyset *p, const polyset *q) { return oracle_sum_text(p, q, false); }

static void test_oracle(void **state)
{
    (void)state;
    compare_all(oracle_sum);
}

static bool same_rational(const char *a, const char *b)
{
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    const bool read = !mpq_set_str(x, a, 10) && !mpq_set_str(y, b, 10);
    mpq_canonicalize(x);
    mpq_canonicalize(y);
    const bool same = read && mpq_equal(x, y);
    mpq_clears(x, y, NULL);
    return same;
}

/* pair P, B with B = -Q: the least translation of B off P is the shortest vector that is not inside P + Q. */
static char *compare_pair(const known *k)
{
    polyset b;
    sunder_separation s;
    sunder_error err;
    polyset_copy(&b, &k->q);
    polyset_negate(&b);
    sunder_shape *p = polyset_shape(&k->p), *q = polyset_shape(&b);
    polyset_free(&b);
    char *complaint = NULL;
    if (!p || !q || sunder_pair_separate(p, q, 0, &s, &err) != SUNDER_OK) {
        complaint = test_format("no answer");
    } else {
        const json *mtv = json_get(k->record, "mtv");
        const char *known2 = json_text(json_get(k->record, "mtv2"));
        const bool one = atoi(json_text(json_get(k->record, "mtv_ties"))) == 1;
        if (!same_rational(s.distance_squared_text, known2))
            complaint = test_format("squared length %s, not %s", s.distance_squared_text, known2);
        else if (one && json_count(mtv) == 2 &&
                 !(same_rational(s.dx_text, json_text(&mtv->item[0])) &&
                   same_rational(s.dy_text, json_text(&mtv->item[1]))))
            complaint = test_format("vector %s %s, not %s %s", s.dx_text, s.dy_text, json_text(&mtv->item[0]),
                                    json_text(&mtv->item[1]));
        sunder_separation_clear(&s);
    }
    sunder_shape_free(p);
    sunder_shape_free(q);
    return complaint;
}

static void test_pairs(void **state)
{
    (void)state;
    size_t bad = 0;
    if (!cases.n) skip();
    for (size_t i = 0; i < cases.n; i++) {
        char *complaint = compare_pair(&cases.at[i]);
        if (complaint) print_message("%s: %s\n", cases.at[i].name, complaint), bad++;
        free(complaint);
    }
    print_message("%zu of %zu cases agree\n", cases.n - bad, cases.n);
    assert_int_equal(bad, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_oracle), cmocka_unit_test(test_library),
                                       cmocka_unit_test(test_pairs)};
    const int failed = cmocka_run_group_tests_name("exact cases", tests, read_cases, free_cases);
    return failed || cases.n ? failed : 77; /* the status of a test that was skipped */
}
