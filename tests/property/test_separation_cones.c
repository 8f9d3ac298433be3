/* Which vertices an edge may be in contact with, and whether a subsum with many sides contains a point: the answers by
 * sectors of directions and by a fan of triangles, compared with tests of every vertex in rationals, and of every
 * side. */
#include "generate.h"
#include "separation/obstacle/carrier.h"
#include "separation/obstacle/cones.h"

#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* The sign of cross(b - a, d - c). */
static int turn(const double *a, const double *b, const double *c, const double *d)
{
    const double *end[4] = {b, a, d, c};
    mpq_t v[4][2], s, t;
    mpq_inits(s, t, NULL);
    for (int k = 0; k < 4; k++)
        for (int e = 0; e < 2; e++) {
            mpq_init(v[k][e]);
            mpq_set_d(v[k][e], end[k][e]);
        }
    for (int k = 0; k < 4; k += 2)
        for (int e = 0; e < 2; e++) mpq_sub(v[k][e], v[k][e], v[k + 1][e]);
    mpq_mul(s, v[0][0], v[2][1]);
    mpq_mul(t, v[0][1], v[2][0]);
    const int sign = mpq_cmp(s, t);
    for (int k = 0; k < 4; k++) mpq_clears(v[k][0], v[k][1], NULL);
    mpq_clears(s, t, NULL);
    return sign;
}

/* Round or ragged outlines, or ones with spikes of many kinds, at coordinates for narrow lattices and for wide ones. */
static void random_outline(polyset *s, rng *r, int vertices)
{
    polyset_init(s);
    const int way = (int)rng_int(r, 0, 2);
    const double size = rng_once_in(r, 2) ? 1e4 : 1e9;
    if (way == 0) random_convex(s, r, vertices, size);
    if (way == 1) random_star(s, r, vertices, size);
    if (way == 2) random_comb(s, r, vertices / 4, size, rng_once_in(r, 2));
    if (rng_once_in(r, 2)) polyset_scale(s, 0.1, rng_once_in(r, 2) ? 0.3 : 1e-5);
    if (rng_once_in(r, 3)) polyset_move(s, 451234.567, 5411234.321);
}

static void open_operands(sunder_i_operands *g, const sunder_shape *p, const sunder_shape *q, bool wide)
{
    const sunder_i_operands_options options = {.force_wide = wide};
    assert_int_equal(sunder_i_operands_init(g, p, q, &options, NULL), SUNDER_OK);
}

/* For each edge of one operand every vertex of the other whose edges enclose its direction is found, and few others. */
static void check_cones(sunder_i_operands *g, size_t *asked, size_t *all)
{
    for (int side = 0; side < 2; side++) {
        const sunder_shape *own = g->shape[side], *other = g->shape[!side];
        sunder_i_cones c;
        assert_true(sunder_i_cones_find(g, !side, &c));
        uint32_t *met = malloc((c.n + 1) * sizeof *met), looked_at;
        bool *seen = malloc(other->vertices * sizeof *seen);
        for (uint32_t e = 0; e < own->vertices; e += 1 + own->vertices / 40) {
            const double *a = own->xy + 2 * (size_t)e, *b = own->xy + 2 * (size_t)own->form->cleaned.next[e];
            const double *x = g->xy[side] + 2 * (size_t)e, *y = g->xy[side] + 2 * (size_t)own->form->cleaned.next[e];
            const uint32_t n =
                sunder_i_cones_met(&c, sunder_i_direction_of(g, y[0] - x[0], y[1] - x[1]), met, &looked_at);
            memset(seen, 0, other->vertices * sizeof *seen);
            for (uint32_t k = 0; k < n; k++) {
                assert_true(k == 0 || met[k] > met[k - 1]);
                seen[c.vertex[met[k]]] = true;
            }
            for (uint32_t v = 0; v < other->vertices; v++) {
                const double *at = other->xy + 2 * (size_t)v,
                             *from = other->xy + 2 * (size_t)other->form->cleaned.prev[v],
                             *to = other->xy + 2 * (size_t)other->form->cleaned.next[v];
                if (turn(from, at, at, to) > 0 && turn(from, at, a, b) >= 0 && turn(a, b, at, to) >= 0)
                    assert_true(seen[v]);
            }
            *asked += looked_at;
            *all += c.n;
        }
        free(met);
        free(seen);
    }
}

static void check_meeting(void **state)
{
    (void)state;
    size_t asked = 0, all = 0;
    const size_t trials = test_count(40);
    for (size_t k = 0; k < trials; k++) {
        rng r = rng_start(test_seed(), k);
        polyset p, q;
        random_outline(&p, &r, (int)rng_int(&r, 20, 400));
        random_outline(&q, &r, (int)rng_int(&r, 20, 400));
        sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
        if (a && b) { /* some of these are not valid outlines after scaling */
            sunder_i_operands g;
            open_operands(&g, a, b, rng_once_in(&r, 3));
            check_cones(&g, &asked, &all);
            sunder_i_operands_free(&g);
        }
        sunder_shape_free(a);
        sunder_shape_free(b);
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("%zu vertices asked of %zu\n", asked, all);
    assert_true(asked * 4 < all * 3);
}

/* Is the start of the line in the interior of a subsum? Every side is tested exactly. */
static bool is_held(sunder_i_operands *g, const sunder_i_carrier *line, const sunder_i_fraction *zero)
{
    for (size_t k = 0; k < g->subsums; k++) {
        sunder_i_subsum *s = &g->subsum[k];
        if (!s->sides) assert_true(sunder_i_subsum_make(g, s));
        bool held = true;
        for (uint32_t m = 0; m < s->sides && held; m++) held = sunder_i_carrier_side(g, line, zero, s, m) > 0;
        if (held) return true;
    }
    return false;
}

/* Ends of lines on corners, on sides, slightly off them and anywhere are tested for the subsums of two round outlines,
 * mostly a single one. */
static void check_holding(void **state)
{
    (void)state;
    size_t in = 0, out = 0;
    const size_t trials = test_count(60);
    for (size_t k = 0; k < trials; k++) {
        rng r = rng_start(test_seed(), k);
        polyset p, q;
        polyset_init(&p);
        polyset_init(&q);
        random_convex(&p, &r, (int)rng_int(&r, 20, 90), 1e5);
        random_convex(&q, &r, (int)rng_int(&r, 3, 30), rng_once_in(&r, 2) ? 1e5 : 4);
        sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
        sunder_i_operands g;
        assert_true(a && b);
        open_operands(&g, a, b, rng_once_in(&r, 3));
        assert_true(sunder_i_operands_reach(&g, 4 * g.magnitude));
        sunder_i_subsum *s = &g.subsum[0];
        assert_true(sunder_i_subsum_make(&g, s));
        const sunder_i_fraction zero = sunder_i_fraction_int(&g.placed.lattice, 0);
        for (int t = 0; t < 60; t++) {
            const uint32_t i = (uint32_t)rng_int(&r, 0, (int)s->sides - 1);
            const uint32_t j = (uint32_t)rng_int(&r, 0, (int)s->sides - 1);
            /* A corner, the sum of a corner and an edge's end, or one of these moved by a unit. */
            sunder_i_point at = s->corner[i];
            if (rng_once_in(&r, 2)) at = sunder_i_operands_add(&g, at, s->side[j]);
            if (rng_once_in(&r, 2))
                at = sunder_i_operands_add(&g, at, (sunder_i_point){rng_int(&r, -1, 1), rng_int(&r, -1, 1)});
            const sunder_i_carrier line = sunder_i_carrier_make(&g, at, s->side[j]);
            const bool inside = is_held(&g, &line, &zero);
            double x, y;
            sunder_i_carrier_at(&line, &zero, &x, &y);
            const long cover = sunder_i_carrier_cover(&g, &line, &zero, x, y, NULL);
            assert_int_equal(cover >= 0, inside);
            in += inside;
            out += !inside;
        }
        sunder_i_operands_free(&g);
        sunder_shape_free(a);
        sunder_shape_free(b);
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("%zu inside, %zu not\n", in, out);
    assert_true(in > trials && out > trials);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_meeting), cmocka_unit_test(check_holding)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
