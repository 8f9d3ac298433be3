/* The sparse factorisation, compared with elimination on the full matrix. */
#include "displacement/quadratic/sparse.h"
#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define MOST 40

/* Solves a x = b by Gaussian elimination with pivots; n unknowns. */
static void eliminate(double *a, double *b, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        for (size_t r = k + 1; r < n; r++)
            if (fabs(a[r * n + k]) > fabs(a[pivot * n + k])) pivot = r;
        for (size_t c = 0; c < n; c++) {
            const double swap = a[k * n + c];
            a[k * n + c] = a[pivot * n + c];
            a[pivot * n + c] = swap;
        }
        const double swap = b[k];
        b[k] = b[pivot];
        b[pivot] = swap;
        for (size_t r = k + 1; r < n; r++) {
            const double f = a[r * n + k] / a[k * n + k];
            for (size_t c = k; c < n; c++) a[r * n + c] -= f * a[k * n + c];
            b[r] -= f * b[k];
        }
    }
    for (size_t k = n; k-- > 0;) {
        for (size_t c = k + 1; c < n; c++) b[k] -= a[k * n + c] * b[c];
        b[k] /= a[k * n + k];
    }
}

/* A random graph on n nodes; sometimes a star, like an outline with its houses. */
static size_t draw_graph(rng *g, size_t n, sunder_i_id_pair *pair)
{
    size_t m = 0;
    const bool star = rng_once_in(g, 3);
    for (uint32_t a = 0; a < n; a++)
        for (uint32_t b = a + 1; b < n; b++)
            if (rng_once_in(g, 6) || (star && a == 3))
                pair[m++] = rng_once_in(g, 2) ? (sunder_i_id_pair){b, a} : (sunder_i_id_pair){a, b};
    /* A pair may occur twice. */
    if (m) pair[m] = pair[0];
    return m ? m + 1 : 0;
}

/* Adds v n n', the term of a contact of a and b, to both matrices. */
static void add_contact(sunder_i_sparse *matrix, double *full, size_t n, uint32_t a, uint32_t b, rng *g)
{
    const double angle = 6.3 * rng_unit(g), v = pow(10, 6 * rng_unit(g) - 3), u[2] = {cos(angle), sin(angle)};
    bool transposed;
    double *block = sunder_i_sparse_block(matrix, a, b, &transposed);
    double *da = sunder_i_sparse_diagonal(matrix, a), *db = sunder_i_sparse_diagonal(matrix, b);
    for (size_t r = 0; r < 2; r++)
        for (size_t c = 0; c < 2; c++) {
            const double w = v * u[r] * u[c];
            da[2 * r + c] += w;
            db[2 * r + c] += w;
            block[2 * r + c] -= w;
            full[(2 * a + r) * 2 * n + 2 * a + c] += w;
            full[(2 * b + r) * 2 * n + 2 * b + c] += w;
            full[(2 * a + r) * 2 * n + 2 * b + c] -= w;
            full[(2 * b + r) * 2 * n + 2 * a + c] -= w;
        }
}

static void check_random(void **state)
{
    (void)state;
    static sunder_i_id_pair pair[MOST * MOST];
    static double full[4 * MOST * MOST], x[2 * MOST], y[2 * MOST];
    for (size_t i = 0; i < test_count(300); i++) {
        rng g = rng_start(test_seed(), i);
        const size_t n = (size_t)rng_int(&g, 1, MOST), m = draw_graph(&g, n, pair);
        sunder_i_sparse matrix;
        assert_true(sunder_i_sparse_init(&matrix, n, pair, m, NULL));
        sunder_i_sparse_clear(&matrix);
        memset(full, 0, sizeof full);
        for (size_t k = 0; k < 2 * n; k++) {
            const double h = 1 + rng_unit(&g);
            sunder_i_sparse_diagonal(&matrix, (uint32_t)(k / 2))[k & 1 ? 3 : 0] += h;
            full[k * 2 * n + k] += h;
            x[k] = y[k] = rng_unit(&g) - 0.5;
        }
        for (size_t k = 0; k < m; k++) add_contact(&matrix, full, n, pair[k].a, pair[k].b, &g);
        assert_true(sunder_i_sparse_factor(&matrix));
        sunder_i_sparse_solve(&matrix, x);
        eliminate(full, y, 2 * n);
        for (size_t k = 0; k < 2 * n; k++) assert_true(fabs(x[k] - y[k]) <= 1e-9);
        sunder_i_sparse_free(&matrix);
    }
}

/* A star is factored without fill-in when its middle comes last. */
static void check_star(void **state)
{
    (void)state;
    enum { RAYS = 1000 };
    static sunder_i_id_pair pair[RAYS];
    for (uint32_t k = 0; k < RAYS; k++) pair[k] = (sunder_i_id_pair){0, k + 1};
    sunder_i_sparse matrix;
    assert_true(sunder_i_sparse_init(&matrix, RAYS + 1, pair, RAYS, NULL));
    assert_int_equal(matrix.column[RAYS + 1], RAYS);
    assert_true(matrix.rank[0] >= RAYS - 1);
    sunder_i_sparse_clear(&matrix);
    assert_false(sunder_i_sparse_factor(&matrix)); /* zero is not positive definite */
    sunder_i_sparse_free(&matrix);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_random), cmocka_unit_test(check_star)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
