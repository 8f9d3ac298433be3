/* Laws of Minkowski sums, exactly: P + Q = Q + P; translation; scaling by powers of two; the hull of the sum is the sum
 * of the hulls. The area is that of the polygons; operands written in another way give the same bytes; reflection. */
#include "expect.h"
#include "generate.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct law_case {
    polyset p, q;
    char *sum; /* canonical text of P + Q */
    rng r;
    pair_kind kind;
    uint64_t seed;
    size_t number;
} law_case;

typedef bool (*law)(law_case *c);

/* Frees `got`. */
static bool same(char *got, const char *want)
{
    const bool equal = got && strcmp(got, want) == 0;
    if (!equal) print_message("  got  %s\n  want %s\n", got ? got : "nothing", want);
    free(got);
    return equal;
}

static bool commutes(law_case *c) { return same(library_sum_text(&c->q, &c->p), c->sum); }

/* Both operands are translated by eighths, which is exact if their coordinates have unused bits. */
static bool translates(law_case *c)
{
    double by[4], total[2];
    if (c->kind == PAIR_RAGGED || c->kind == PAIR_BUILDINGS || c->kind == PAIR_MAP || c->kind == PAIR_SELF ||
        c->kind == PAIR_HUGE)
        return true;
    for (int i = 0; i < 4; i++) by[i] = (double)rng_int(&c->r, -8000000, 8000000) / 8;
    total[0] = by[0] + by[2];
    total[1] = by[1] + by[3];
    polyset_move(&c->p, by[0], by[1]);
    polyset_move(&c->q, by[2], by[3]);
    char *want = sum_text_moved(c->sum, 0, total[0], total[1]);
    const bool ok = same(library_sum_text(&c->p, &c->q), want);
    free(want);
    return ok;
}

/* P far away with integer coordinates, Q fine and near the origin: no double represents the sum of two places. Only for
 * operands with small integer coordinates. */
static bool translates_far(law_case *c)
{
    const double dx = 0x1p51 + (double)rng_int(&c->r, -999, 999), dy = (double)rng_int(&c->r, -9, 9) - 0x1p50;
    if (c->kind >= PAIR_MAP) return true;
    polyset_scale(&c->q, 0x1p-12, 0x1p-12);
    char *near = library_sum_text(&c->p, &c->q), *want = near ? sum_text_moved(near, 0, dx, dy) : NULL;
    polyset_move(&c->p, dx, dy);
    const bool ok = want && same(library_sum_text(&c->p, &c->q), want);
    free(near);
    free(want);
    return ok;
}

static bool scales(law_case *c)
{
    const long k = c->kind == PAIR_HUGE ? 3 : rng_int(&c->r, -300, 300);
    double s = 1;
    for (long i = 0; i < labs(k); i++) s *= k > 0 ? 2 : 0.5;
    polyset_scale(&c->p, s, s);
    polyset_scale(&c->q, s, s);
    char *want = sum_text_moved(c->sum, k, 0, 0);
    const bool ok = same(library_sum_text(&c->p, &c->q), want);
    free(want);
    return ok;
}

static bool adds_hulls(law_case *c)
{
    polyset a, b;
    polyset_hull(&a, &c->p);
    polyset_hull(&b, &c->q);
    char *sum = library_sum_text(&a, &b), *want = sum_text_hull(c->sum);
    const bool ok = sum && same(sum_text_only_ring(sum), want);
    free(sum);
    free(want);
    polyset_free(&a);
    polyset_free(&b);
    return ok;
}

static bool measures_area(law_case *c)
{
    sunder_shape *a = polyset_shape(&c->p), *b = polyset_shape(&c->q);
    sunder_sum *sum = NULL;
    char *area = NULL;
    json *text = json_read(c->sum);
    char *want = expect_area(text);
    bool ok = a && b && sunder_minkowski_sum(a, b, NULL, &sum, NULL) == SUNDER_OK &&
              sunder_sum_area_text(sum, &area, NULL) == SUNDER_OK && strcmp(area, want) == 0;
    if (!ok) print_message("  area %s, the polygons have %s\n", area ? area : "none", want);
    json_free(text);
    free(want);
    sunder_free(area);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return ok;
}

static bool ignores_dress(law_case *c)
{
    random_dress(&c->p, &c->r);
    random_dress(&c->q, &c->r);
    return same(library_sum_text(&c->p, &c->q), c->sum);
}

/* (-P) + (-Q) = -(P + Q), through sunder_shape_reflect(); after reflecting twice the text is that of the original. */
static bool reflects(law_case *c)
{
    sunder_shape *a = polyset_shape(&c->p), *b = polyset_shape(&c->q), *ra = NULL, *rb = NULL;
    sunder_sum *sum = NULL;
    polyset np, nq;
    polyset_copy(&np, &c->p);
    polyset_copy(&nq, &c->q);
    polyset_negate(&np);
    polyset_negate(&nq);
    char *want = library_sum_text(&np, &nq), *got = NULL;
    if (a && b && sunder_shape_reflect(a, &ra, NULL) == SUNDER_OK && sunder_shape_reflect(b, &rb, NULL) == SUNDER_OK &&
        sunder_minkowski_sum(ra, rb, NULL, &sum, NULL) == SUNDER_OK)
        got = sum_text(sum);
    const bool ok = want && same(got, want);
    free(want);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    sunder_shape_free(ra);
    sunder_shape_free(rb);
    polyset_free(&np);
    polyset_free(&nq);
    return ok;
}

static bool holds(law check, pair_kind kind, uint64_t seed, size_t i)
{
    law_case c = {.r = rng_start(seed * 31 + (uint64_t)kind, i), .kind = kind, .seed = seed, .number = i};
    random_pair(&c.p, &c.q, &c.r, kind);
    char *p = polyset_wkt(&c.p), *q = polyset_wkt(&c.q);
    c.sum = library_sum_text(&c.p, &c.q);
    const bool ok = c.sum && check(&c);
    if (!ok)
        print_message("kind %s, SUNDER_SEED=%llu, case %zu\n%s\n%s\n", pair_kind_string(kind), (unsigned long long)seed,
                      i, p, q);
    free(p);
    free(q);
    free(c.sum);
    polyset_free(&c.p);
    polyset_free(&c.q);
    return ok;
}

static void test_law(void **state)
{
    const law check = *(const law *)*state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(60);
    size_t bad = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (int kind = 0; kind < PAIR_KINDS; kind++)
        for (size_t i = 0; i < n && bad < 5; i++)
            if (!holds(check, (pair_kind)kind, seed, i)) bad++;
    assert_int_equal(bad, 0);
}

int main(void)
{
    static law laws[] = {commutes,   translates,    translates_far, scales,
                         adds_hulls, measures_area, ignores_dress,  reflects};
    static const char *const names[] = {"P + Q = Q + P",
                                        "translation",
                                        "translation far out",
                                        "scaling by powers of two",
                                        "hulls add",
                                        "area",
                                        "the same set written in another way",
                                        "reflection"};
    struct CMUnitTest tests[8];
    for (int i = 0; i < 8; i++) tests[i] = (struct CMUnitTest){names[i], test_law, NULL, NULL, &laws[i]};
    return cmocka_run_group_tests_name("laws of sums", tests, NULL, NULL);
}
