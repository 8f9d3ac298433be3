/* Erosions and closings compared with brute force.
 *
 * The oracle (support/oracle.h, which shares no code with src/) decides whether a point lies in int X + int Y. Let D be
 * a closed regular set. B + x lies within D exactly if x is not in the sum of -B and the complement of D (cut off by a
 * frame). Erosions and closings are tested at all places where they could be wrong: their corners, midpoints of two
 * corners, all differences of corners of D and B (which include ends of degenerate parts), midpoints of two of those,
 * and random places. Everything is scaled so that all of these are integers. */
#include "morphology_case.h"
#include "oracle.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct integer_set {
    polyset polygons;
    double *segments, *points;
    sunder_sum_size size;
} integer_set;

static bool contains(const integer_set *s, const double *at)
{
    if (morphology_in_polygons(&s->polygons, at)) return true;
    for (size_t i = 0; i < s->size.degenerate_segments; i++)
        if (morphology_on_segment(s->segments + 4 * i, s->segments + 4 * i + 2, at)) return true;
    for (size_t i = 0; i < s->size.degenerate_points; i++)
        if (s->points[2 * i] == at[0] && s->points[2 * i + 1] == at[1]) return true;
    return false;
}

/* ---- Comparison with the oracle ---- */

typedef struct probing {
    const integer_set *set;
    const oracle *outside;         /* the oracle for the complement and -B */
    double *at;                    /* places to test */
    size_t n, wrong, inside, slim; /* slim: inside, but not in the polygons, so in a degenerate part */
} probing;

static void ask(probing *p, double x, double y)
{
    const double at[2] = {x, y};
    char tx[32], ty[32];
    snprintf(tx, sizeof tx, "%.0f", x);
    snprintf(ty, sizeof ty, "%.0f", y);
    const bool ours = contains(p->set, at), theirs = !oracle_covers(p->outside, tx, ty);
    p->inside += theirs;
    p->slim += ours && !morphology_in_polygons(&p->set->polygons, at);
    if (ours == theirs) return;
    p->wrong++;
    if (p->wrong < 4) print_message("at (%s %s): the library says %d, the oracle %d\n", tx, ty, ours, theirs);
}

/* All corners, all differences of corners, then midpoints of pairs, and others. All corners are even, so that midpoints
 * are integers. */
static void ask_all(probing *p, const polyset *d, const polyset *b, rng *r, double reach)
{
    const integer_set *s = p->set;
    const size_t own = s->polygons.vertices + 2 * s->size.degenerate_segments + s->size.degenerate_points;
    p->at = test_alloc(2 * (own + d->vertices * b->vertices), sizeof *p->at);
    if (s->polygons.vertices) memcpy(p->at, s->polygons.xy, 2 * s->polygons.vertices * sizeof *p->at);
    p->n = s->polygons.vertices;
    memcpy(p->at + 2 * p->n, s->segments, 4 * s->size.degenerate_segments * sizeof *p->at);
    p->n += 2 * s->size.degenerate_segments;
    memcpy(p->at + 2 * p->n, s->points, 2 * s->size.degenerate_points * sizeof *p->at);
    p->n += s->size.degenerate_points;
    for (size_t i = 0; i < d->vertices; i++)
        for (size_t j = 0; j < b->vertices; j++, p->n++)
            for (int k = 0; k < 2; k++)
                p->at[2 * p->n + (size_t)k] = d->xy[2 * i + (size_t)k] - b->xy[2 * j + (size_t)k];
    for (size_t i = 0; i < p->n; i++) ask(p, p->at[2 * i], p->at[2 * i + 1]);
    for (size_t i = 0; i < 200 && p->n; i++) {
        const double *a = p->at + 2 * (size_t)rng_int(r, 0, (int64_t)p->n - 1);
        const double *c = i < own ? p->at + 2 * i : p->at + 2 * (size_t)rng_int(r, 0, (int64_t)p->n - 1);
        ask(p, (a[0] + c[0]) / 2, (a[1] + c[1]) / 2);
    }
    for (int i = 0; i < 50; i++)
        ask(p, (double)rng_int(r, (int64_t)-reach, (int64_t)reach),
            (double)rng_int(r, (int64_t)-reach, (int64_t)reach));
    free(p->at);
}

/* Is `sum`, computed from the given integer operands, the erosion of the regular set d by b? */
static bool is_erosion(const sunder_sum *sum, const polyset *d, const polyset *b, rng *r, size_t *slim)
{
    const long k = morphology_scale(sum);
    if (!k) return true; /* the caller counts it */
    integer_set s;
    polyset big_d, big_b, outside;
    sunder_sum_get_size(sum, &s.size);
    morphology_scaled(sum, 2 * k, &s.polygons, &s.segments, &s.points);
    polyset_copy(&big_d, d);
    polyset_copy(&big_b, b);
    polyset_scale(&big_d, 2.0 * (double)k, 2.0 * (double)k);
    polyset_scale(&big_b, 2.0 * (double)k, 2.0 * (double)k);
    double reach = 0;
    for (size_t i = 0; i < 2 * big_d.vertices; i++) reach = reach < big_d.xy[i] ? big_d.xy[i] : reach;
    morphology_complement(&outside, &big_d, 4 * reach + 200 * (double)k * MORPHOLOGY_FRAME);
    polyset_negate(&big_b);
    oracle *o = oracle_new(&outside, &big_b);
    polyset_negate(&big_b);
    probing p = {.set = &s, .outside = o};
    ask_all(&p, &big_d, &big_b, r, reach);
    *slim += p.slim > 0;
    oracle_free(o);
    polyset_free(&big_d);
    polyset_free(&big_b);
    polyset_free(&outside);
    polyset_free(&s.polygons);
    free(s.segments);
    free(s.points);
    return p.wrong == 0;
}

static void test_erosions(void **state)
{
    const size_t n = test_count(300);
    size_t bad = 0, slim = 0, too_fine = 0;
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() + 77, i);
        polyset p, b;
        morphology_case(&p, &b, &r);
        sunder_sum *e = morphology_answer(&p, &b, SUNDER_OPERATION_ERODE);
        assert_non_null(e);
        too_fine += !morphology_scale(e);
        if (!is_erosion(e, &p, &b, &r, &slim) && bad++ < 3) morphology_show("erode", i, &p, &b);
        sunder_sum_free(e);
        polyset_free(&p);
        polyset_free(&b);
    }
    print_message("%zu erosions, %zu with parts without area, %zu too fine to ask\n", n, slim, too_fine);
    assert_int_equal(bad, 0);
    assert_true(slim > n / 20);
    assert_true(too_fine < n / 4);
}

static void test_closings(void **state)
{
    const size_t n = test_count(150);
    size_t bad = 0, slim = 0, asked = 0;
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() + 78, i);
        polyset p, b, d;
        morphology_case(&p, &b, &r);
        sunder_sum *dilated = morphology_answer(&p, &b, SUNDER_OPERATION_DILATE);
        assert_non_null(dilated);
        const long k = morphology_scale(dilated);
        if (k && k <= 1000) {
            morphology_scaled(dilated, k, &d, NULL, NULL);
            polyset_scale(&p, (double)k, (double)k);
            polyset_scale(&b, (double)k, (double)k);
            sunder_sum *closed = morphology_answer(&p, &b, SUNDER_OPERATION_CLOSE);
            assert_non_null(closed);
            asked += morphology_scale(closed) != 0;
            if (!is_erosion(closed, &d, &b, &r, &slim) && bad++ < 3) morphology_show("close", i, &p, &b);
            sunder_sum_free(closed);
            polyset_free(&d);
        }
        sunder_sum_free(dilated);
        polyset_free(&p);
        polyset_free(&b);
    }
    print_message("%zu closings, %zu asked, %zu with parts without area\n", n, asked, slim);
    assert_int_equal(bad, 0);
    assert_true(asked > n / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_erosions),
        cmocka_unit_test(test_closings),
    };
    return cmocka_run_group_tests_name("growing and shrinking beside the oracle", tests, NULL, NULL);
}
