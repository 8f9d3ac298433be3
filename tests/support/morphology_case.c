#include "morphology_case.h"

#include "expect.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gmp.h>

/* ---- The library's answer as integers ---- */

sunder_sum *morphology_answer(const polyset *p, const polyset *b, sunder_operation operation)
{
    static const sunder_sum_options how = {.size = sizeof how, .threads = 2};
    sunder_shape *sp = polyset_shape(p), *sb = polyset_shape(b);
    sunder_sum *sum = NULL;
    sunder_error err = {0};
    if (!sp || !sb || sunder_morphology(sp, sb, operation, &how, &sum, &err) != SUNDER_OK)
        print_message("%s: %s\n", sunder_operation_string(operation), err.message);
    sunder_shape_free(sp);
    sunder_shape_free(sb);
    return sum;
}

static void vertex_of(const sunder_sum *sum, uint32_t v, mpq_t xy[2])
{
    char *x, *y;
    assert_int_equal(sunder_sum_vertex_text(sum, v, &x, &y, NULL), SUNDER_OK);
    mpq_set_str(xy[0], x, 10);
    mpq_set_str(xy[1], y, 10);
    sunder_free(x);
    sunder_free(y);
}

/* All vertices in the sum: of rings, segments, points. */
static uint32_t *named(const sunder_sum *sum, size_t *n)
{
    sunder_sum_size c;
    sunder_sum_get_size(sum, &c);
    uint32_t *all = test_alloc(c.vertices + 2 * c.degenerate_segments + c.degenerate_points + 1, sizeof *all);
    *n = 0;
    for (size_t p = 0; p < c.polygons; p++)
        for (size_t r = 0; r < sunder_sum_rings(sum, p); r++) {
            size_t m;
            const uint32_t *ring = sunder_sum_ring(sum, p, r, &m);
            memcpy(all + *n, ring, m * sizeof *ring);
            *n += m;
        }
    for (size_t i = 0; i < c.degenerate_segments; i++, *n += 2) sunder_sum_segment(sum, i, all + *n);
    for (size_t i = 0; i < c.degenerate_points; i++) all[(*n)++] = sunder_sum_point(sum, i);
    return all;
}

/* The least k for which all coordinates times k are integers; 0 if it is too large. */
long morphology_scale(const sunder_sum *sum)
{
    size_t n;
    uint32_t *all = named(sum, &n);
    mpz_t k;
    mpq_t xy[2];
    mpz_init_set_ui(k, 1);
    mpq_inits(xy[0], xy[1], NULL);
    for (size_t i = 0; i < n; i++) {
        vertex_of(sum, all[i], xy);
        mpz_lcm(k, k, mpq_denref(xy[0]));
        mpz_lcm(k, k, mpq_denref(xy[1]));
    }
    const long scale = mpz_cmp_ui(k, MORPHOLOGY_FINEST) <= 0 ? mpz_get_si(k) : 0;
    mpz_clear(k);
    mpq_clears(xy[0], xy[1], NULL);
    free(all);
    return scale;
}

static void scaled(const sunder_sum *sum, uint32_t v, long k, double xy[2])
{
    mpq_t q[2], factor;
    mpq_inits(q[0], q[1], factor, NULL);
    mpq_set_si(factor, k, 1);
    vertex_of(sum, v, q);
    for (int i = 0; i < 2; i++) {
        mpq_mul(q[i], q[i], factor);
        assert_int_equal(mpz_cmp_ui(mpq_denref(q[i]), 1), 0);
        xy[i] = mpq_get_d(q[i]);
    }
    mpq_clears(q[0], q[1], factor, NULL);
}

/* The polygons times k, and (may be NULL) segments and points as arrays of coordinates. */
void morphology_scaled(const sunder_sum *sum, long k, polyset *set, double **segments, double **points)
{
    sunder_sum_size c;
    sunder_sum_get_size(sum, &c);
    polyset_init(set);
    for (size_t p = 0; p < c.polygons; p++) {
        for (size_t r = 0; r < sunder_sum_rings(sum, p); r++) {
            size_t n;
            const uint32_t *ring = sunder_sum_ring(sum, p, r, &n);
            for (size_t i = 0; i < n; i++) {
                double xy[2];
                scaled(sum, ring[i], k, xy);
                polyset_vertex(set, xy[0], xy[1]);
            }
            polyset_end_ring(set);
        }
        polyset_end_polygon(set);
    }
    if (!segments) return;
    *segments = test_alloc(4 * c.degenerate_segments + 1, sizeof **segments);
    *points = test_alloc(2 * c.degenerate_points + 1, sizeof **points);
    for (size_t i = 0; i < c.degenerate_segments; i++) {
        uint32_t ends[2];
        sunder_sum_segment(sum, i, ends);
        scaled(sum, ends[0], k, *segments + 4 * i);
        scaled(sum, ends[1], k, *segments + 4 * i + 2);
    }
    for (size_t i = 0; i < c.degenerate_points; i++) scaled(sum, sunder_sum_point(sum, i), k, *points + 2 * i);
}

/* ---- Is a point in a closed set of integers? Products of integers below 2^26 are exact in doubles. ---- */

static double side(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool between(double a, double b, double c) { return (a <= c && c <= b) || (b <= c && c <= a); }

bool morphology_on_segment(const double *a, const double *b, const double *c)
{
    return side(a, b, c) == 0 && between(a[0], b[0], c[0]) && between(a[1], b[1], c[1]);
}

/* Members of a sum are disjoint, so the even-odd rule suffices. */
bool morphology_in_polygons(const polyset *set, const double *at)
{
    bool in = false;
    for (size_t r = 0; r < set->rings; r++) {
        const size_t first = r ? set->ring_end[r - 1] : 0, end = set->ring_end[r];
        for (size_t i = first; i < end; i++) {
            const double *a = set->xy + 2 * i, *b = set->xy + 2 * (i + 1 < end ? i + 1 : first);
            if (morphology_on_segment(a, b, at)) return true;
            if ((a[1] > at[1]) != (b[1] > at[1]) && (side(a, b, at) > 0) == (b[1] > a[1])) in = !in;
        }
    }
    return in;
}

/* ---- Complements ---- */

/* Is the ring o of a set within its ring h, which it may touch at points only? */
static bool ring_within(const polyset *set, size_t o, size_t h)
{
    polyset ring;
    polyset_init(&ring);
    const size_t from = h ? set->ring_end[h - 1] : 0;
    polyset_ring(&ring, set->xy + 2 * from, set->ring_end[h] - from);
    bool found = false, in = false;
    const size_t first = o ? set->ring_end[o - 1] : 0, end = set->ring_end[o];
    for (size_t i = first; i < end && !found; i++) {
        const double *a = set->xy + 2 * i, *b = set->xy + 2 * (i + 1 < end ? i + 1 : first);
        const double middle[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
        bool on = false;
        for (size_t k = 0; k < ring.vertices && !on; k++)
            on = morphology_on_segment(ring.xy + 2 * k, ring.xy + 2 * ((k + 1) % ring.vertices), middle);
        found = !on;
        in = found && morphology_in_polygons(&ring, middle);
    }
    polyset_free(&ring);
    return in;
}

static double ring_area(const polyset *set, size_t r)
{
    const size_t first = r ? set->ring_end[r - 1] : 0, end = set->ring_end[r];
    double area = 0;
    for (size_t i = first + 1; i + 1 < end; i++)
        area += side(set->xy + 2 * first, set->xy + 2 * i, set->xy + 2 * (i + 1));
    return area < 0 ? -area : area;
}

/* The index of the smallest hole that contains the member; SIZE_MAX: none. */
static size_t hole_around(const polyset *set, const bool *hole, size_t outer)
{
    size_t host = SIZE_MAX;
    for (size_t h = 0; h < set->rings; h++)
        if (hole[h] && ring_within(set, outer, h) && (host == SIZE_MAX || ring_area(set, h) < ring_area(set, host)))
            host = h;
    return host;
}

static void add_ring(polyset *out, const polyset *d, size_t r)
{
    const size_t from = r ? d->ring_end[r - 1] : 0;
    polyset_ring(out, d->xy + 2 * from, d->ring_end[r] - from);
}

/* The complement of a regular set without overlaps, within a frame: the frame and the holes become members, and the
 * outer rings become holes of the members around them. */
void morphology_complement(polyset *out, const polyset *d, double frame)
{
    polyset_init(out);
    bool *hole = test_alloc(d->rings + 1, sizeof *hole);
    size_t *host = test_alloc(d->rings + 1, sizeof *host);
    for (size_t p = 0, r = 0; p < d->polygons; p++)
        for (const size_t outer = r; r < d->poly_end[p]; r++) hole[r] = r != outer;
    for (size_t r = 0; r < d->rings; r++) host[r] = hole[r] ? r : hole_around(d, hole, r);
    const double corners[8] = {-frame, -frame, frame, -frame, frame, frame, -frame, frame};
    polyset_ring(out, corners, 4);
    for (size_t r = 0; r < d->rings; r++)
        if (!hole[r] && host[r] == SIZE_MAX) add_ring(out, d, r);
    polyset_end_polygon(out);
    for (size_t h = 0; h < d->rings; h++) {
        if (!hole[h]) continue;
        add_ring(out, d, h);
        for (size_t r = 0; r < d->rings; r++)
            if (!hole[r] && host[r] == h) add_ring(out, d, r);
        polyset_end_polygon(out);
    }
    free(hole);
    free(host);
}

/* ---- Cases ---- */

/* P: two simple polygons, or a board whose parts are disjoint members. B, the shape of the operation: a smaller board,
 * a simple or a convex polygon, or one with coordinates of the board's grid, so that exact fits occur. */
void morphology_case(polyset *p, polyset *b, rng *r)
{
    cells board, small;
    polyset_init(p);
    polyset_init(b);
    const spacing kind = rng_once_in(r, 2) ? SPACING_UNIT : SPACING_SMALL;
    if (rng_once_in(r, 4)) {
        random_simple(p, r, (int)rng_int(r, 4, 8), 9);
        random_simple(b, r, (int)rng_int(r, 3, 4), 3);
    }
    while (!p->polygons) {
        random_cells(&board, r, (int)rng_int(r, 3, 7), (int)rng_int(r, 3, 7), kind, rng_once_in(r, 3),
                     (int)rng_int(r, 60, 95));
        cells_outline(p, &board, rng_once_in(r, 2), true);
    }
    while (!b->polygons) switch (rng_int(r, 0, 3)) {
        case 0: {
            const double w = (double)rng_int(r, 1, 3), h = (double)rng_int(r, 1, 3);
            polyset_rectangle(b, 0, 0, w, h);
            break;
        }
        case 1: random_simple(b, r, (int)rng_int(r, 3, 5), 3); break;
        default:
            random_cells(&small, r, (int)rng_int(r, 1, 3), (int)rng_int(r, 1, 3), kind, rng_once_in(r, 4), 70);
            cells_outline(b, &small, true, true);
        }
    polyset_move(b, (double)rng_int(r, -2, 2), (double)rng_int(r, -2, 2));
}

void morphology_show(const char *what, size_t i, const polyset *p, const polyset *b)
{
    char *tp = polyset_wkt(p), *tb = polyset_wkt(b);
    print_message("%s, SUNDER_SEED=%llu, case %zu\n%s\n%s\n", what, (unsigned long long)test_seed(), i, tp, tb);
    free(tp);
    free(tb);
}
