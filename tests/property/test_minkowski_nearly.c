/* Sums and unions of operands whose members nearly coincide: all algorithms, with all kinds of numbers and with the
 * operands exchanged, give the same sum, byte for byte; for small operands it equals the oracle's. The area of the
 * union is compared with that computed by slabs. */
#include "generate_nearly.h"
#include "oracle.h"
#include "roads.h"
#include "slabs.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SHOWN 3 /* at most this many disagreements are printed; the rest are counted */

typedef struct nearly_case {
    polyset p, q;
    nearly_kind kind;
    uint64_t seed;
    size_t i;
} nearly_case;

static void open_case(nearly_case *c, nearly_kind kind, uint64_t seed, size_t i, int members)
{
    rng r = rng_start(seed + 7 + (uint64_t)kind * 1000003, i);
    *c = (nearly_case){.kind = kind, .seed = seed, .i = i};
    random_nearly(&c->p, &c->q, &r, kind, members);
}

static void close_case(nearly_case *c)
{
    polyset_free(&c->p);
    polyset_free(&c->q);
}

static void show(const nearly_case *c, const char *what)
{
    char *a = polyset_wkt(&c->p), *b = polyset_wkt(&c->q);
    print_message("kind %s, SUNDER_SEED=%llu, case %zu: %s\n%s\n%s\n", nearly_kind_string(c->kind),
                  (unsigned long long)c->seed, c->i, what, a, b);
    free(a);
    free(b);
}

/* Frees `got`. */
static bool same(char *got, const char *want)
{
    const bool equal = got && strcmp(got, want) == 0;
    free(got);
    return equal;
}

/* Returns NULL, or the name of the algorithm that disagrees. */
static const char *roads_differ(const nearly_case *c, const char *sum, bool all, bool shown)
{
    if (!same(library_sum_text(&c->q, &c->p), sum)) return "Q + P is not P + Q";
    if (!same(library_sum_text_wide(&c->p, &c->q), sum)) return "the sum on big integers differs";
    for (size_t a = 0; a < (all ? ROAD_ALGORITHMS : 1); a++) {
        const size_t road = all ? c->i * ROAD_ALGORITHMS + a : c->i * ROAD_ALGORITHMS + 1 + c->i % 2;
        const sunder_sum_options how = road_options(road, c->seed + c->i);
        if (!road_agrees(&c->p, &c->q, &how, c->i % 7 == 0, sum, shown)) return "the sum depends on the algorithm";
    }
    return NULL;
}

/* The union of a set's members, and its area by slabs. */
static bool union_has_area(const polyset *set)
{
    sunder_shape *shape = polyset_shape(set);
    sunder_sum *sum = NULL;
    char *text = NULL;
    mpq_t ours, want;
    mpq_inits(ours, want, NULL);
    area_by_slabs(want, set);
    const bool equal = shape && sunder_shape_union(shape, NULL, &sum, NULL) == SUNDER_OK &&
                       sunder_sum_area_text(sum, &text, NULL) == SUNDER_OK && mpq_set_str(ours, text, 10) == 0 &&
                       mpq_equal(ours, want);
    mpq_clears(ours, want, NULL);
    sunder_free(text);
    sunder_sum_free(sum);
    sunder_shape_free(shape);
    return equal;
}

static bool agree(nearly_kind kind, uint64_t seed, size_t i, bool with_oracle, bool shown)
{
    nearly_case c;
    open_case(&c, kind, seed, i, with_oracle ? 4 : 10);
    const char *what = NULL;
    char *sum = library_sum_text(&c.p, &c.q);
    if (!sum) what = "no sum";
    if (!what && with_oracle && !same(oracle_sum_text(&c.p, &c.q, false), sum))
        what = "the sum differs from the oracle's";
    if (!what) what = roads_differ(&c, sum, with_oracle, shown);
    if (!what && with_oracle && !union_has_area(&c.p)) what = "the area of the union differs";
    if (what && shown) show(&c, what);
    free(sum);
    close_case(&c);
    return !what;
}

static void test_kind(void **state)
{
    const nearly_kind kind = *(const nearly_kind *)*state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(120);
    size_t bad = 0;
    for (size_t i = 0; i < n; i++)
        if (!agree(kind, seed, i, i % 2 == 0, bad < SHOWN)) bad++;
    print_message("%-10s SUNDER_SEED=%llu: %zu of %zu agree\n", nearly_kind_string(kind), (unsigned long long)seed,
                  n - bad, n);
    assert_int_equal(bad, 0);
}

int main(void)
{
    nearly_kind kinds[NEARLY_KINDS];
    struct CMUnitTest tests[NEARLY_KINDS];
    for (int k = 0; k < NEARLY_KINDS; k++) {
        kinds[k] = (nearly_kind)k;
        tests[k] = (struct CMUnitTest){nearly_kind_string(kinds[k]), test_kind, NULL, NULL, &kinds[k]};
    }
    return cmocka_run_group_tests_name("sums of what nearly coincides", tests, NULL, NULL);
}
