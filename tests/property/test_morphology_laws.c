/* Laws of dilation, erosion, opening and closing: an opening is a subset, a closing a superset; both are idempotent and
 * invariant under shifts of the shape; dilation and erosion are adjoint; overlapping members count as their union. An
 * opening is compared with the closing of the complement, which is its complement up to exact fits. */
#include "morphology_case.h"
#include "oracle.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Canonical text of the union of two sets of polygons with integer coordinates. */
static char *union_text(const polyset *a, const polyset *b)
{
    polyset both;
    polyset_copy(&both, a);
    polyset_append(&both, b);
    sunder_shape *shape = polyset_shape(&both);
    sunder_sum *sum = NULL;
    assert_non_null(shape);
    assert_int_equal(sunder_shape_union(shape, NULL, &sum, NULL), SUNDER_OK);
    char *text = sum_text(sum);
    sunder_sum_free(sum);
    sunder_shape_free(shape);
    polyset_free(&both);
    return text;
}

/* Is a regular set a subset of another? */
static bool within(const polyset *a, const polyset *b)
{
    polyset none;
    polyset_init(&none);
    char *both = union_text(b, a), *alone = union_text(b, &none);
    const bool same = strcmp(both, alone) == 0;
    free(both);
    free(alone);
    return same;
}

/* Adds B at the segments and points of an erosion to a set, as members. */
static void add_slim_parts(polyset *out, const polyset *b, const double *segments, size_t n, const double *points,
                           size_t m)
{
    size_t triangles;
    double *t = oracle_triangles(b, &triangles);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < triangles; k++) {
            polyset two, hull;
            polyset_init(&two);
            for (size_t v = 0; v < 6; v++) {
                const double *end = segments + 4 * i + 2 * (v / 3), *c = t + 6 * k + 2 * (v % 3);
                polyset_vertex(&two, end[0] + c[0], end[1] + c[1]);
            }
            polyset_end_ring(&two);
            polyset_end_polygon(&two);
            polyset_hull(&hull, &two);
            polyset_append(out, &hull);
            polyset_free(&two);
            polyset_free(&hull);
        }
    for (size_t i = 0; i < m; i++) {
        polyset here;
        polyset_copy(&here, b);
        polyset_move(&here, points[2 * i], points[2 * i + 1]);
        polyset_append(out, &here);
        polyset_free(&here);
    }
    free(t);
}

/* The closing of the complement by -B is removed from the frame. What remains is the sum of B and the interior of the
 * erosion. Together with the sum of B and the erosion's parts without area (exact fits), this is the opening. */
static bool opening_is_what_closing_leaves(const polyset *p, const polyset *b, const sunder_sum *opened)
{
    polyset c, turned;
    morphology_complement(&c, p, MORPHOLOGY_FRAME);
    polyset_copy(&turned, b);
    polyset_negate(&turned);
    sunder_sum *closed = morphology_answer(&c, &turned, SUNDER_OPERATION_CLOSE),
               *eroded = morphology_answer(p, b, SUNDER_OPERATION_ERODE);
    const long ko = morphology_scale(opened), kc = morphology_scale(closed), ke = morphology_scale(eroded),
               k = ko * kc * ke;
    bool ok = true;
    if (k && k <= MORPHOLOGY_FINEST) {
        polyset left, closed_set, large, none, opened_set;
        double *segments, *points;
        sunder_sum_size size;
        morphology_scaled(eroded, k, &large, &segments, &points);
        polyset_free(&large);
        sunder_sum_get_size(eroded, &size);
        morphology_scaled(closed, k, &closed_set, NULL, NULL);
        morphology_scaled(opened, k, &opened_set, NULL, NULL);
        morphology_complement(&left, &closed_set, 2.0 * MORPHOLOGY_FRAME * (double)k);
        polyset_copy(&large, b);
        polyset_scale(&large, (double)k, (double)k);
        add_slim_parts(&left, &large, segments, size.degenerate_segments, points, size.degenerate_points);
        /* The boundary of the frame was a part of the closed set; it belongs to the other side. */
        polyset ring;
        polyset_init(&ring);
        const double f = MORPHOLOGY_FRAME * (double)k, corners[8] = {-f, -f, f, -f, f, f, -f, f};
        const double outer[8] = {-2 * f, -2 * f, 2 * f, -2 * f, 2 * f, 2 * f, -2 * f, 2 * f};
        polyset_ring(&ring, outer, 4);
        polyset_ring(&ring, corners, 4);
        polyset_end_polygon(&ring);
        polyset_append(&opened_set, &ring);
        polyset_init(&none);
        char *x = union_text(&left, &none), *y = union_text(&opened_set, &none);
        ok = strcmp(x, y) == 0;
        free(x);
        free(y);
        free(segments);
        free(points);
        polyset_free(&left);
        polyset_free(&ring);
        polyset_free(&large);
        polyset_free(&closed_set);
        polyset_free(&opened_set);
    }
    sunder_sum_free(closed);
    sunder_sum_free(eroded);
    polyset_free(&c);
    polyset_free(&turned);
    return ok;
}

static char *text_of(const polyset *p, const polyset *b, sunder_operation operation)
{
    sunder_sum *sum = morphology_answer(p, b, operation);
    char *text = sum ? sum_text(sum) : NULL;
    sunder_sum_free(sum);
    return text;
}

/* A second application changes nothing (except that parts without area disappear). */
static bool is_idempotent(const sunder_sum *once, const polyset *b, sunder_operation operation)
{
    const long k = morphology_scale(once);
    if (!k) return true;
    polyset set, large, none;
    morphology_scaled(once, k, &set, NULL, NULL);
    polyset_copy(&large, b);
    polyset_scale(&large, (double)k, (double)k);
    sunder_sum *twice = morphology_answer(&set, &large, operation);
    polyset again;
    const long m = morphology_scale(twice);
    bool ok = m == 1 || m == 0;
    if (ok && m) {
        morphology_scaled(twice, 1, &again, NULL, NULL);
        polyset_init(&none);
        char *x = union_text(&set, &none), *y = union_text(&again, &none);
        ok = strcmp(x, y) == 0;
        free(x);
        free(y);
        polyset_free(&again);
    }
    sunder_sum_free(twice);
    polyset_free(&set);
    polyset_free(&large);
    return ok;
}

static bool is_blind_to_shifts(const polyset *p, const polyset *b, sunder_operation operation)
{
    polyset moved;
    polyset_copy(&moved, b);
    polyset_move(&moved, 17, -5);
    char *here = text_of(p, b, operation), *there = text_of(p, &moved, operation);
    if (operation == SUNDER_OPERATION_ERODE) {
        char *back = sum_text_moved(there, 0, 17, -5);
        free(there);
        there = back;
    }
    const bool same = here && there && strcmp(here, there) == 0;
    free(here);
    free(there);
    polyset_free(&moved);
    return same;
}

/* dilate(X) lies in Y exactly if X lies in erode(Y). */
static bool is_adjoint(const polyset *y, const polyset *b, rng *r, size_t *fits)
{
    polyset x;
    polyset_init(&x);
    const double at[2] = {(double)rng_int(r, 0, 5), (double)rng_int(r, 0, 5)};
    polyset_rectangle(&x, at[0], at[1], at[0] + (double)rng_int(r, 1, 2), at[1] + (double)rng_int(r, 1, 2));
    sunder_sum *dilated = morphology_answer(&x, b, SUNDER_OPERATION_DILATE),
               *eroded = morphology_answer(y, b, SUNDER_OPERATION_ERODE);
    const long k = morphology_scale(dilated), m = morphology_scale(eroded);
    bool ok = true;
    if (k && m) {
        polyset sd, se, sx, sy;
        morphology_scaled(dilated, k, &sd, NULL, NULL);
        morphology_scaled(eroded, m, &se, NULL, NULL);
        polyset_copy(&sx, &x);
        polyset_copy(&sy, y);
        polyset_scale(&sx, (double)m, (double)m);
        polyset_scale(&sy, (double)k, (double)k);
        const bool one = within(&sd, &sy), other = within(&sx, &se);
        ok = one == other;
        *fits += one;
        polyset_free(&sd);
        polyset_free(&se);
        polyset_free(&sx);
        polyset_free(&sy);
    }
    sunder_sum_free(dilated);
    sunder_sum_free(eroded);
    polyset_free(&x);
    return ok;
}

static void test_laws(void **state)
{
    const size_t n = test_count(150);
    size_t bad = 0, fits = 0;
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() + 79, i);
        polyset p, b;
        morphology_case(&p, &b, &r);
        sunder_sum *opened = morphology_answer(&p, &b, SUNDER_OPERATION_OPEN),
                   *closed = morphology_answer(&p, &b, SUNDER_OPERATION_CLOSE);
        assert_non_null(opened);
        assert_non_null(closed);
        const long k = morphology_scale(opened), m = morphology_scale(closed);
        const char *broken = NULL;
        if (!opening_is_what_closing_leaves(&p, &b, opened)) broken = "an opening and the closing of the complement";
        if (!is_idempotent(opened, &b, SUNDER_OPERATION_OPEN)) broken = "open twice";
        if (!is_idempotent(closed, &b, SUNDER_OPERATION_CLOSE)) broken = "close twice";
        if (!is_blind_to_shifts(&p, &b, SUNDER_OPERATION_OPEN)) broken = "open by a shape moved";
        if (!is_blind_to_shifts(&p, &b, SUNDER_OPERATION_CLOSE)) broken = "close by a shape moved";
        if (!is_blind_to_shifts(&p, &b, SUNDER_OPERATION_ERODE)) broken = "erode by a shape moved";
        if (!is_adjoint(&p, &b, &r, &fits)) broken = "dilate and erode";
        if (k && m) {
            polyset so, sc, sp;
            morphology_scaled(opened, k, &so, NULL, NULL);
            morphology_scaled(closed, m, &sc, NULL, NULL);
            polyset_copy(&sp, &p);
            polyset_scale(&sp, (double)k, (double)k);
            if (!within(&so, &sp)) broken = "an opening that sticks out";
            polyset_free(&sp);
            polyset_copy(&sp, &p);
            polyset_scale(&sp, (double)m, (double)m);
            if (!within(&sp, &sc)) broken = "a closing that leaves something out";
            polyset_free(&so);
            polyset_free(&sc);
            polyset_free(&sp);
        }
        if (broken && bad++ < 3) morphology_show(broken, i, &p, &b);
        sunder_sum_free(opened);
        sunder_sum_free(closed);
        polyset_free(&p);
        polyset_free(&b);
    }
    print_message("%zu cases; X + B in Y in %zu of them\n", n, fits);
    assert_int_equal(bad, 0);
    assert_true(fits > n / 20 && fits < n);
}

/* Overlapping members count as their union. */
static void test_overlaps(void **state)
{
    const size_t n = test_count(80);
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() + 80, i);
        polyset p, b, other, whole;
        morphology_case(&p, &b, &r);
        morphology_case(&other, &whole, &r);
        polyset_free(&whole);
        polyset_move(&other, (double)rng_int(&r, 0, 3), (double)rng_int(&r, 0, 3));
        polyset_append(&p, &other);
        sunder_shape *shape = polyset_shape(&p);
        sunder_sum *sum;
        assert_int_equal(sunder_shape_union(shape, NULL, &sum, NULL), SUNDER_OK);
        const long k = morphology_scale(sum);
        if (k) {
            morphology_scaled(sum, k, &whole, NULL, NULL);
            polyset_scale(&p, (double)k, (double)k);
            polyset_scale(&b, (double)k, (double)k);
            for (int op = SUNDER_OPERATION_DILATE; op <= SUNDER_OPERATION_CLOSE; op++) {
                char *one = text_of(&p, &b, (sunder_operation)op), *two = text_of(&whole, &b, (sunder_operation)op);
                if (strcmp(one, two) != 0) morphology_show(sunder_operation_string((sunder_operation)op), i, &p, &b);
                assert_string_equal(one, two);
                free(one);
                free(two);
            }
            polyset_free(&whole);
        }
        sunder_sum_free(sum);
        sunder_shape_free(shape);
        polyset_free(&p);
        polyset_free(&b);
        polyset_free(&other);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_laws),
        cmocka_unit_test(test_overlaps),
    };
    return cmocka_run_group_tests_name("laws of growing and shrinking", tests, NULL, NULL);
}
