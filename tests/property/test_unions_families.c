/* All algorithms, with every decomposition and every order, for sums of known inputs: the golden cases; the cases and
 * families kept beside the repository in ../shared, if they are there; families made by sunder-families. Operands of up
 * to 30 vertices use one combination in SHARE; larger ones use one algorithm with the angle bisector. The name of the
 * input draws these. With SUNDER_TEST_SCALE above 1 all of them use nearly all combinations. */
#include "generated.h"
#include "random.h"
#include "roads.h"
#include "sum_text.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SMALL 34  /* vertices of an operand; about 30 */
#define LARGE 140 /* larger ones are left to benchmarks */
#define SHARE 5   /* no divisor of a number of algorithms, decompositions or orders */

typedef struct tally {
    size_t inputs, sums, bad;
} tally;

/* The name of an input determines the seed and the combinations. */
static uint64_t number_of(const char *name)
{
    uint64_t h = test_seed();
    for (; *name; name++) h = (h ^ (unsigned char)*name) * 0x100000001b3u;
    return h >> 8;
}

/* The arrangement of two forks of 100 vertices, triangulated, has 7 million vertices and takes 4 GB. */
static bool too_many(const sunder_sum_options *how)
{
    return how->algorithm == SUNDER_ALGORITHM_ARRANGEMENT &&
           (how->decomposition == SUNDER_DECOMPOSITION_TRIANGULATION ||
            how->decomposition == SUNDER_DECOMPOSITION_HERTEL_MEHLHORN);
}

static void compare(tally *t, const char *name, const polyset *p, const polyset *q)
{
    const size_t size = p->vertices > q->vertices ? p->vertices : q->vertices;
    if (size > LARGE) return;
    char *want = library_sum_text(p, q);
    if (!want) fail_msg("%s: no sum", name);
    const uint64_t number = number_of(name);
    const bool all = size <= SMALL || test_count(1) > 1;
    const size_t step = test_count(1) > 1 ? 1 : all ? SHARE : ROAD_ALGORITHMS;
    for (size_t i = number % step; i < (all ? ROADS : ROAD_ALGORITHMS); i += step) {
        sunder_sum_options how = road_options(i, number + i);
        if (!all) how.order = (sunder_order)(number / (i + 1) % ROAD_ORDERS);
        if (size > SMALL && too_many(&how)) continue;
        t->sums++;
        if (road_agrees(p, q, &how, false, want, t->bad < 3)) continue;
        print_message("%s\n", name);
        t->bad++;
    }
    t->inputs++;
    free(want);
}

static void compare_text(tally *t, const char *name, const char *text)
{
    polyset p, q;
    const char *end;
    if (!polyset_read_wkt(&p, text, &end) || !polyset_read_wkt(&q, end, NULL)) fail_msg("%s: no two operands", name);
    compare(t, name, &p, &q);
    polyset_free(&p);
    polyset_free(&q);
}

static void compare_folder(tally *t, const char *folder, const char *suffix)
{
    const char *source = getenv("SUNDER_SOURCE");
    char *path = test_format("%s/%s", source ? source : SUNDER_SOURCE, folder);
    DIR *dir = opendir(path);
    if (!dir) print_message("no %s: skipped\n", path);
    for (struct dirent *e; dir && (e = readdir(dir));) {
        const size_t n = strlen(e->d_name), k = strlen(suffix);
        if (n <= k || strcmp(e->d_name + n - k, suffix) != 0) continue;
        /* The names of larger families contain their sizes, so these files are not even read. */
        if (strstr(e->d_name, "00.txt") && !strstr(e->d_name, "_100.txt")) continue;
        char *file = test_format("%s/%s", path, e->d_name), *text = test_read_file(file);
        if (text) compare_text(t, e->d_name, text);
        free(file);
        free(text);
    }
    if (dir) closedir(dir);
    free(path);
}

static void report(const tally *t)
{
    print_message("%zu inputs, %zu of %zu sums agree\n", t->inputs, t->sums - t->bad, t->sums);
    assert_int_equal(t->bad, 0);
}

static void test_golden(void **state)
{
    tally t = {0, 0, 0};
    compare_folder(&t, "tests/golden", ".wkt");
    assert_true(t.inputs > 40);
    report(&t);
}

static void test_cases(void **state)
{
    tally t = {0, 0, 0};
    compare_folder(&t, "../shared/cases", ".wkt");
    report(&t);
    if (!t.inputs) skip();
}

static void test_shared_families(void **state)
{
    tally t = {0, 0, 0};
    compare_folder(&t, "../shared/families", ".txt");
    report(&t);
    if (!t.inputs) skip();
}

static void test_generated(void **state)
{
    static const char *const family[] = {"convex", "comb",  "fork",     "slanted-fork", "covered-fork", "star",
                                         "random", "robot", "fat-grid", "fat-cover",    "tight"};
    static const unsigned size[] = {8, 20, 30, 100};
    tally t = {0, 0, 0};
    if (!generated_available()) skip();
    for (size_t f = 0; f < sizeof family / sizeof *family; f++)
        for (size_t s = 0; s < sizeof size / sizeof *size; s++)
            for (int map = 0; map < (size[s] > SMALL ? 1 : 2); map++) {
                char *arguments = test_format("%s --size %u --seed %u%s", family[f], size[s], 7 + size[s],
                                              map ? " --coordinates map" : "");
                polyset p, q;
                generated_pair(&p, &q, arguments);
                compare(&t, arguments, &p, &q);
                polyset_free(&p);
                polyset_free(&q);
                free(arguments);
            }
    report(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_golden), cmocka_unit_test(test_cases),
                                       cmocka_unit_test(test_shared_families), cmocka_unit_test(test_generated)};
    return cmocka_run_group_tests_name("every road on known inputs", tests, NULL, NULL);
}
