/* displacement/prove/areas: masses compared with integrals computed in another way; the bound that prices prove
 * compared with the cost of random moves. */
#include "displacement/prove/areas/areas.h"
#include "failing.h"
#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_CORNERS = 48, MOST_NODES = 96, COPIES = 8192 };

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

typedef struct body {
    double xy[4 * MOST_CORNERS];
    size_t ring_end[2];
    sunder_i_outline outline;
} body;

/* Corners around a point, turning left or right; there are enough of them that the point is inside the ring. */
static void draw_ring(rng *g, sunder_i_outline *o, const double at[2], double least, double most, bool left)
{
    const size_t from = o->rings ? o->ring_end[o->rings - 1] : 0, n = (size_t)rng_int(g, 5, MOST_CORNERS);
    for (size_t k = 0; k < n; k++) {
        const double angle = 6.283185307179586 * ((double)k + 0.9 * rng_unit(g)) / (double)n * (left ? 1 : -1);
        const double r = least + (most - least) * rng_unit(g);
        o->xy[2 * (from + k)] = at[0] + r * cos(angle);
        o->xy[2 * (from + k) + 1] = at[1] + r * sin(angle);
    }
    o->ring_end[o->rings++] = from + n;
}

/* An L whose corners are at multiples of `step`. */
static void draw_corner(rng *g, sunder_i_outline *o, const double at[2], double size, double step)
{
    const int64_t most = (int64_t)(size / step) + 3;
    const double a = (double)rng_int(g, 2, most), b = (double)rng_int(g, 2, most);
    const double c = (double)rng_int(g, 1, (int64_t)a - 1), d = (double)rng_int(g, 1, (int64_t)b - 1);
    const double corner[] = {0, 0, a, 0, a, d, c, d, c, b, 0, b};
    for (size_t k = 0; k < 12; k++) o->xy[k] = step * (round(at[k & 1] / step) + corner[k]);
    o->ring_end[o->rings++] = 6;
}

/* A shape of this size, at this distance from the origin, sometimes with a hole. step > 0: all coordinates are
 * multiples of it. */
static void draw_body(rng *g, double size, double far, double step, body *b)
{
    const double at[2] = {far * (2 * rng_unit(g) - 1), far * (2 * rng_unit(g) - 1)};
    sunder_i_outline *o = &b->outline;
    *o = (sunder_i_outline){.xy = b->xy, .ring_end = b->ring_end};
    if (step > 0)
        draw_corner(g, o, at, size, step);
    else
        draw_ring(g, o, at, 0.3 * size, size, true);
    if (step == 0 && rng_once_in(g, 3)) draw_ring(g, o, at, 0.01 * size, 0.1 * size, false);
    o->box[0] = o->box[1] = INFINITY;
    o->box[2] = o->box[3] = -INFINITY;
    for (size_t k = 0; k < 2 * o->ring_end[o->rings - 1]; k++) {
        o->box[k & 1] = fmin(o->box[k & 1], o->xy[k]);
        o->box[2 + (k & 1)] = fmax(o->box[2 + (k & 1)], o->xy[k]);
    }
}

/* ---- Integrals of hat functions, computed in another way: under each edge, by pieces within one square ----------- */

typedef struct table {
    int64_t x, y; /* the node of at[0], in the grid of the whole plane */
    size_t columns, rows;
    long double *at;
} table;

static void give(const table *t, int64_t i, int64_t j, const long double one[4], long double sign)
{
    long double *at = t->at + (size_t)(j - t->y) * t->columns + (size_t)(i - t->x);
    at[0] += sign * (one[0] - one[1] - one[2] + one[3]);
    at[1] += sign * (one[1] - one[3]);
    at[t->columns] += sign * (one[2] - one[3]);
    at[t->columns + 1] += sign * one[3];
}

/* Adds the area between the segment pq and the lower edge of the table. */
static void give_under(const table *t, const long double p[2], const long double q[2])
{
    const long double dx = q[0] - p[0];
    const int64_t i = (int64_t)floorl((p[0] + q[0]) / 2), j = (int64_t)floorl((p[1] + q[1]) / 2);
    const long double a = p[0] - (long double)i, b = q[0] - (long double)i;
    const long double c = p[1] - (long double)j, d = q[1] - (long double)j;
    const long double whole[4] = {dx, dx * (a + b) / 2, dx / 2, dx * (a + b) / 4};
    for (int64_t row = t->y; row < j; row++) give(t, i, row, whole, 1);
    const long double part[4] = {dx * (c + d) / 2, dx * (a * (2 * c + d) + b * (c + 2 * d)) / 6,
                                 dx * (c * c + c * d + d * d) / 6,
                                 dx * (a * (3 * c * c + 2 * c * d + d * d) + b * (c * c + 2 * c * d + 3 * d * d)) / 24};
    give(t, i, j, part, 1);
}

static int by_size(const void *a, const void *b)
{
    const long double x = *(const long double *)a, y = *(const long double *)b;
    return (x > y) - (x < y);
}

/* Adds the area under an edge; an edge from right to left bounds it from above. */
static void give_edge(const table *t, const long double p[2], const long double q[2])
{
    static long double share[4 * 8192];
    size_t n = 0;
    share[n++] = 0;
    share[n++] = 1;
    for (int c = 0; c < 2; c++)
        for (long double at = ceill(fminl(p[c], q[c])); at < fmaxl(p[c], q[c]) && p[c] != q[c]; at++)
            share[n++] = (at - p[c]) / (q[c] - p[c]);
    qsort(share, n, sizeof *share, by_size);
    for (size_t k = 0; k + 1 < n; k++) {
        long double a[2], b[2];
        for (int c = 0; c < 2; c++) {
            a[c] = p[c] + share[k] * (q[c] - p[c]);
            b[c] = p[c] + share[k + 1] * (q[c] - p[c]);
        }
        if (share[k] < share[k + 1]) give_under(t, b, a);
    }
}

/* The integrals for the body moved by (dx, dy) squares. The caller frees at[]. */
static table integrate(const sunder_i_outline *o, double side, long double dx, long double dy)
{
    const long double move[2] = {dx, dy};
    table t = {.x = (int64_t)floorl(o->box[0] / side + dx) - 1, .y = (int64_t)floorl(o->box[1] / side + dy) - 1};
    t.columns = (size_t)((int64_t)ceill(o->box[2] / side + dx) + 3 - t.x);
    t.rows = (size_t)((int64_t)ceill(o->box[3] / side + dy) + 3 - t.y);
    t.at = calloc(t.columns * t.rows, sizeof *t.at);
    assert_non_null(t.at);
    for (size_t r = 0, from = 0; r < o->rings; from = o->ring_end[r++])
        for (size_t k = from; k < o->ring_end[r]; k++) {
            const size_t next = k + 1 < o->ring_end[r] ? k + 1 : from;
            long double p[2], q[2];
            for (int c = 0; c < 2; c++) {
                p[c] = (long double)o->xy[2 * k + (size_t)c] / side + move[c];
                q[c] = (long double)o->xy[2 * next + (size_t)c] / side + move[c];
            }
            give_edge(&t, p, q);
        }
    return t;
}

/* ---- Masses ------------------------------------------------------------------------------------------------------ */

static void check_masses(const body *b, const sunder_i_grid *grid)
{
    sunder_i_masses m;
    assert_true(sunder_i_masses_make(&b->outline, grid, &m));
    const table t = integrate(&b->outline, grid->side, 0, 0);
    int64_t total = 0;
    for (size_t j = 0; j < t.rows; j++)
        for (size_t i = 0; i < t.columns; i++) {
            const long double own = t.at[j * t.columns + i] * (long double)SUNDER_I_MASS_OF_SQUARE;
            const int64_t x = t.x + (int64_t)i - grid->x - m.x, y = t.y + (int64_t)j - grid->y - m.y;
            if (x < 0 || y < 0 || x >= (int64_t)m.columns || y >= (int64_t)m.rows) {
                assert_true(fabsl(own) < 1e-3L);
                continue;
            }
            const int32_t at = m.at[(size_t)y * m.columns + (size_t)x];
            total += at;
            if (at == 0) assert_true(own > -1e-3L);
            if (at > 0) assert_true((long double)at <= own);
            assert_true((long double)(at + m.slack) >= own);
        }
    assert_int_equal(total, m.total);
    free(t.at);
    sunder_i_masses_free(&m);
}

static void test_masses(void **state)
{
    for (size_t k = 0; k < test_count(200); k++) {
        rng g = rng_start(test_seed(), k);
        body b;
        const double side = ldexp(1, (int)rng_int(&g, -12, 12));
        const double size = side * pow(10, 4.5 * rng_unit(&g) - 2.5), far = side * pow(10, 9 * rng_unit(&g) - 2);
        draw_body(&g, size, far, rng_once_in(&g, 3) ? side / 4 : 0, &b);
        check_masses(&b, &(sunder_i_grid){.side = side, .x = rng_int(&g, -99, 99), .y = 7, .columns = 9, .rows = 9});
    }
}

/* ---- Bounds by prices -------------------------------------------------------------------------------------------- */

typedef struct market {
    body body;
    sunder_i_prices prices;
    sunder_i_payer payer;
    uint32_t price[MOST_NODES * MOST_NODES];
} market;

/* Prices: a plateau or a hill, reduced by noise, by holes of one node each, or by valleys along one axis; 0 in the two
 * outermost rows and columns. */
static void draw_prices(rng *g, sunder_i_prices *p, double height)
{
    const int kind = (int)rng_int(g, 0, 4);
    const sunder_i_grid *l = &p->grid;
    const double depth = rng_once_in(g, 4) ? 1 : 0.3 * rng_unit(g);
    for (size_t j = 0; j < l->rows; j++)
        for (size_t i = 0; i < l->columns; i++) {
            const double u = 2.0 * (double)i / (double)l->columns - 1, v = 2.0 * (double)j / (double)l->rows - 1;
            const double own = kind == 0   ? rng_unit(g)
                               : kind == 1 ? rng_once_in(g, 6)
                               : kind == 2 ? fmin(1, u * u + v * v)
                                           : (kind == 3 ? i : j) % 4 == 0;
            const bool inner = i >= 2 && j >= 2 && i + 2 < l->columns && j + 2 < l->rows;
            p->price[j * l->columns + i] = inner ? (uint32_t)(height * (1 - depth * own)) : 0;
        }
}

/* Draws a body and prices. A body may be smaller than a square, so that kinks of the prices affect its whole mass. */
static void draw_market(rng *g, market *m)
{
    const double side = ldexp(1, (int)rng_int(g, -3, 3)), far = rng_once_in(g, 2) ? 0 : 1e6;
    const double size = rng_once_in(g, 3) ? 4 * rng_unit(g) : 0.15 + 0.3 * rng_unit(g),
                 height = pow(2, 7 + 9 * rng_unit(g));
    sunder_i_grid *l = &m->prices.grid;
    draw_body(g, side * size, far, rng_once_in(g, 3) ? side / 8 : 0, &m->body);
    const double *box = m->body.outline.box;
    l->side = side;
    l->columns = (size_t)rng_int(g, 9, 24);
    l->rows = (size_t)rng_int(g, 9, 24);
    l->x = (int64_t)floor((box[0] + box[2]) / (2 * side)) - (int64_t)l->columns / 2;
    l->y = (int64_t)floor((box[1] + box[3]) / (2 * side)) - (int64_t)l->rows / 2;
    m->prices.price = m->price;
    m->prices.unit = ldexp(1, (int)rng_int(g, -14, 4));
    draw_prices(g, &m->prices, height);
    assert_true(sunder_i_masses_make(&m->body.outline, l, &m->payer.masses));
    /* The weight is such that the price of staying equals the cost of moving some squares. */
    const double stays = height * m->prices.unit * (double)m->payer.masses.total / (double)SUNDER_I_MASS_OF_SQUARE;
    m->payer.weight = fmax(stays / pow(1 + 7 * rng_unit(g), 2), m->prices.unit * 0x1p-18);
    m->payer.limit = rng_once_in(g, 3) ? side * 5 * rng_unit(g) : INFINITY;
}

static double worth_of(const sunder_i_prices *p)
{
    double sum = 0;
    for (size_t k = 0; k < sunder_i_grid_nodes(&p->grid); k++) sum += p->price[k];
    return sum * p->unit * p->grid.side * p->grid.side;
}

/* The price that one payer pays after a move by t, in squares. */
static long double paid_at(const market *m, const double t[2])
{
    const sunder_i_prices *p = &m->prices;
    const sunder_i_grid *l = &p->grid;
    const table own = integrate(&m->body.outline, l->side, t[0], t[1]);
    long double sum = 0;
    for (size_t j = 0; j < own.rows; j++)
        for (size_t i = 0; i < own.columns; i++) {
            const int64_t x = own.x + (int64_t)i - l->x, y = own.y + (int64_t)j - l->y;
            if (x < 0 || y < 0 || x >= (int64_t)l->columns || y >= (int64_t)l->rows) continue;
            sum += own.at[j * own.columns + i] * p->price[(size_t)y * l->columns + (size_t)x];
        }
    free(own.at);
    return (sum * p->unit + (long double)m->payer.weight * (t[0] * t[0] + t[1] * t[1])) * l->side * l->side;
}

/* A move within the limit, in squares: any move, one onto a node, or one of full length. */
static void draw_move(rng *g, const market *m, double limit, double at[2])
{
    const double *box = m->body.outline.box, reach = fmin(limit, 8);
    const int kind = (int)rng_int(g, 0, 4);
    for (int c = 0; c < 2; c++) {
        const double middle = (box[c] + box[c + 2]) / (2 * m->prices.grid.side);
        at[c] = kind == 0 ? 0 : reach * (2 * rng_unit(g) - 1);
        if (kind > 2) at[c] = round(middle + at[c]) - middle;
    }
    const double far = hypot(at[0], at[1]), most = limit * (1 - 1e-9);
    if (far > most || (kind == 1 && isfinite(limit)))
        for (int c = 0; c < 2; c++) at[c] *= far > 0 ? most / far : 0;
}

/* Descends from a random place by ever shorter steps, and demands that no place is cheaper than the proved bound. */
static void seek_cheaper(rng *g, const market *m, long double least)
{
    const double limit = m->payer.limit / m->prices.grid.side;
    double at[2];
    draw_move(g, m, limit, at);
    long double paid = paid_at(m, at);
    for (double step = 1; step > 0.01; step *= 0.7) {
        const double to[2] = {at[0] + step * (2 * rng_unit(g) - 1), at[1] + step * (2 * rng_unit(g) - 1)};
        if (hypot(to[0], to[1]) > limit) continue;
        const long double there = paid_at(m, to);
        if (there < paid) {
            paid = there;
            memcpy(at, to, sizeof at);
        }
    }
    if (paid < least)
        fail_msg("after a move by (%g, %g) squares the cost is %.17Lg, less than the bound %.17Lg", at[0], at[1], paid,
                 least);
}

/* As many equal payers as make the value of the whole area small beside their payments. */
static double prove_copies(const market *m)
{
    static sunder_i_payer payer[COPIES];
    double bound;
    for (size_t k = 0; k < COPIES; k++) payer[k] = m->payer;
    assert_true(sunder_i_prices_prove(&m->prices, payer, COPIES, 1, &bound));
    return bound;
}

static void test_prices(void **state)
{
    static market m;
    size_t proved = 0;
    const size_t cases = test_count(50);
    for (size_t k = 0; k < cases; k++) {
        rng g = rng_start(test_seed(), 1000 + k);
        draw_market(&g, &m);
        const double bound = prove_copies(&m);
        proved += bound > 0;
        if (bound > 0) {
            const long double least = ((long double)bound + worth_of(&m.prices)) / COPIES;
            for (int n = 0; n < 30; n++) seek_cheaper(&g, &m, least * (1 - 1e-12L));
        }
        sunder_i_masses_free(&m.payer.masses);
    }
    assert_true(4 * proved > cases);
}

/* A fixed body pays for the area that it occupies, up to the curvature of the prices and rounding. Prices at the border
 * prove nothing, and neither do weights that are too small or too large for the unit. */
static void test_limits(void **state)
{
    static market m;
    rng g = rng_start(test_seed(), 5000);
    draw_body(&g, 4, 0, 0, &m.body);
    m.prices = (sunder_i_prices){{.side = 1, .x = -20, .y = -20, .columns = 41, .rows = 41}, 1, m.price};
    for (size_t k = 0; k < 41 * 41; k++) {
        const double u = (double)(k % 41) - 20, v = (double)(k / 41) - 20;
        m.price[k] = fabs(u) > 18 || fabs(v) > 18 ? 0 : (uint32_t)(2 * (800 - u * u - v * v));
    }
    assert_true(sunder_i_masses_make(&m.body.outline, &m.prices.grid, &m.payer.masses));
    m.payer.weight = 1;
    m.payer.limit = 0;
    const double stays = prove_copies(&m), here[2] = {0, 0};
    const long double least = ((long double)stays + worth_of(&m.prices)) / COPIES, paid = paid_at(&m, here);
    assert_true(least <= paid && least > 0.9L * paid);
    double before = stays;
    for (m.payer.limit = 1; m.payer.limit < 20; m.payer.limit *= 2) {
        const double bound = prove_copies(&m);
        assert_true(bound > 0 && bound <= before);
        before = bound;
    }
    m.payer.limit = 4 * (1 - 0x1p-40); /* squares at the very limit, just out of reach */
    before = prove_copies(&m);
    m.payer.limit = 4;
    assert_true(prove_copies(&m) < before);
    m.payer.weight = 0x1p-30;
    assert_true(prove_copies(&m) == 0);
    m.payer.weight = 0x1p40;
    assert_true(prove_copies(&m) == 0);
    m.payer.weight = 1;
    m.payer.limit = 8;
    for (size_t k = 0; k < 4; k++) {
        uint32_t *const border[] = {m.price + 20, m.price + 41 * 20 + 1, m.price + 41 * 20 + 39, m.price + 41 * 39 + 9};
        *border[k] = 1;
        assert_true(prove_copies(&m) == 0);
        *border[k] = 0;
    }
    assert_true(prove_copies(&m) > 0);
    sunder_i_masses_free(&m.payer.masses);
}

/* ---- Ascent ------------------------------------------------------------------------------------------------------ */

/* Prices are refined from a coarser grid, which extends to the border; after that they are 0 within two rows and
 * columns of it. */
static void test_border(void **state)
{
    static market m;
    static float price[41 * 41];
    for (size_t k = 0; k < 12; k++) {
        rng g = rng_start(test_seed(), 6000 + k);
        draw_body(&g, 4, 0, 0, &m.body);
        const sunder_i_grid grid = {.side = 1, .x = -20, .y = -20, .columns = 41, .rows = 41};
        assert_true(sunder_i_masses_make(&m.body.outline, &grid, &m.payer.masses));
        sunder_i_payer payer[6];
        for (size_t i = 0; i < 6; i++) payer[i] = (sunder_i_payer){1, INFINITY, m.payer.masses};
        for (size_t i = 0; i < 41 * 41; i++) price[i] = (float)(40 * rng_unit(&g));
        assert_true(sunder_i_prices_ascend(&grid, payer, 6, 1, (unsigned)k, 1, price));
        for (size_t i = 0; i < 41 * 41; i++) {
            const size_t x = i % 41, y = i / 41;
            if (x < 2 || y < 2 || x > 38 || y > 38) assert_true(price[i] == 0);
        }
        sunder_i_masses_free(&m.payer.masses);
    }
}

/* The cost of one payer for a move by whole squares, with prices as floats. */
static double paid_by(const sunder_i_grid *l, const sunder_i_payer *payer, const float *price, int64_t dx, int64_t dy)
{
    const sunder_i_masses *m = &payer->masses;
    double sum = 0;
    for (size_t k = 0; k < m->columns * m->rows; k++) {
        const int64_t x = m->x + dx + (int64_t)(k % m->columns), y = m->y + dy + (int64_t)(k / m->columns);
        if (x < 0 || y < 0 || x >= (int64_t)l->columns || y >= (int64_t)l->rows) continue;
        sum += (double)m->at[k] * (double)price[(size_t)y * l->columns + (size_t)x];
    }
    return sum / (double)SUNDER_I_MASS_OF_SQUARE + payer->weight * (double)(dx * dx + dy * dy);
}

/* The weighted mean of all moves within the limit: a move that costs `heat` more has a weight e times smaller. */
static void find_mean(const sunder_i_grid *l, const sunder_i_payer *payer, const float *price, double heat,
                      double mean[2])
{
    double least = INFINITY, sum[3] = {0, 0, 0};
    for (int pass = 0; pass < 2; pass++)
        for (int64_t dy = -40; dy <= 40; dy++)
            for (int64_t dx = -40; dx <= 40; dx++) {
                if (l->side * sqrt((double)(dx * dx + dy * dy)) > payer->limit) continue;
                const double paid = paid_by(l, payer, price, dx, dy), share = pass ? exp((least - paid) / heat) : 0;
                if (paid < least) least = paid;
                sum[0] += share;
                sum[1] += share * (double)dx;
                sum[2] += share * (double)dy;
            }
    for (int c = 0; c < 2; c++) mean[c] = l->side * sum[1 + c] / sum[0];
}

/* Places that are too expensive to matter are left out: the mean is still that of all places. */
static void test_places(void **state)
{
    (void)state;
    static market m;
    static float price[41 * 41];
    size_t moved = 0;
    for (size_t k = 0; k < test_count(60); k++) {
        rng g = rng_start(test_seed(), 8000 + k);
        const sunder_i_grid grid = {.side = 2, .x = -20, .y = -20, .columns = 41, .rows = 41};
        draw_body(&g, 4, 0, 0, &m.body);
        assert_true(sunder_i_masses_make(&m.body.outline, &grid, &m.payer.masses));
        const double area = (double)m.payer.masses.total / (double)SUNDER_I_MASS_OF_SQUARE;
        const double x = 6 * (2 * rng_unit(&g) - 1), y = 6 * (2 * rng_unit(&g) - 1), steep = 1 + 3 * rng_unit(&g);
        for (size_t i = 0; i < 41 * 41; i++) {
            const double u = (double)(i % 41) - 20 - x, v = (double)(i / 41) - 20 - y;
            price[i] = (float)fmax(0, steep * (100 - u * u - v * v));
        }
        m.payer.weight = area * (1 + 4 * rng_unit(&g));
        m.payer.limit = rng_once_in(&g, 3) ? 20 * rng_unit(&g) : INFINITY;
        const double patience = 0.05 + 3 * rng_unit(&g);
        double mean[2], move[2];
        find_mean(&grid, &m.payer, price, patience * m.payer.weight, mean);
        assert_true(sunder_i_prices_places(&grid, &m.payer, 1, patience, 1, price, move));
        assert_true(hypot(move[0] - mean[0], move[1] - mean[1]) <= 1e-3 * grid.side);
        assert_true(hypot(move[0], move[1]) <= m.payer.limit);
        moved += hypot(move[0], move[1]) > grid.side;
        sunder_i_masses_free(&m.payer.masses);
    }
    assert_true(moved > test_count(60) / 4);
}

/* With more payers than are processed at a time, prices, places and the bound have the same bits for every number of
 * threads. */
static void test_threads(void **state)
{
    (void)state;
    enum { PAYERS = 1300, SIDE = 61 };
    static market m;
    static sunder_i_payer payer[PAYERS];
    static float price[2][SIDE * SIDE];
    static uint32_t rounded[SIDE * SIDE];
    static double move[2][2 * PAYERS];
    double bound[2];
    rng g = rng_start(test_seed(), 9000);
    draw_body(&g, 3, 0, 0, &m.body);
    const sunder_i_grid grid = {.side = 1, .x = -30, .y = -30, .columns = SIDE, .rows = SIDE};
    assert_true(sunder_i_masses_make(&m.body.outline, &grid, &m.payer.masses));
    for (size_t k = 0; k < PAYERS; k++) payer[k] = (sunder_i_payer){1 + 3 * rng_unit(&g), INFINITY, m.payer.masses};
    for (int run = 0; run < 2; run++) {
        const unsigned threads = run ? 3 : 1;
        memset(price[run], 0, sizeof price[run]);
        assert_true(sunder_i_prices_ascend(&grid, payer, PAYERS, 1, 4, threads, price[run]));
        assert_true(sunder_i_prices_places(&grid, payer, PAYERS, 1, threads, price[run], move[run]));
        for (size_t k = 0; k < SIDE * SIDE; k++) rounded[k] = (uint32_t)price[run][k];
        const sunder_i_prices prices = {grid, 1, rounded};
        assert_true(sunder_i_prices_prove(&prices, payer, PAYERS, threads, &bound[run]));
    }
    assert_memory_equal(price[0], price[1], sizeof price[0]);
    assert_memory_equal(move[0], move[1], sizeof move[0]);
    assert_true(bound[0] > 0 && bound[0] == bound[1]);
    sunder_i_masses_free(&m.payer.masses);
}

/* ---- Memory ------------------------------------------------------------------------------------------------------ */

static bool attempt(void *context)
{
    market *m = context;
    float price[21 * 21] = {0};
    double bound;
    sunder_i_payer payer[5];
    const bool made = sunder_i_masses_make(&m->body.outline, &m->prices.grid, &m->payer.masses);
    for (size_t k = 0; k < 5; k++) payer[k] = (sunder_i_payer){1, INFINITY, m->payer.masses};
    const bool ok = made && sunder_i_prices_ascend(&m->prices.grid, payer, 5, 1, 3, 1, price) &&
                    sunder_i_prices_prove(&m->prices, payer, 5, 1, &bound);
    sunder_i_masses_free(&m->payer.masses);
    return ok;
}

static void test_memory(void **state)
{
    static market m;
    rng g = rng_start(test_seed(), 7000);
    draw_body(&g, 2, 0, 0, &m.body);
    m.prices = (sunder_i_prices){{.side = 1, .x = -10, .y = -10, .columns = 21, .rows = 21}, 1, m.price};
    m.price[10 * 21 + 10] = 30;
    assert_true(failing_loop(attempt, &m, false));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_masses), cmocka_unit_test(test_prices),
                                       cmocka_unit_test(test_limits), cmocka_unit_test(test_border),
                                       cmocka_unit_test(test_places), cmocka_unit_test(test_threads),
                                       cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
