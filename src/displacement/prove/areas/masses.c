/* How a body's area is distributed to the nodes of a grid.
 *
 * Rings are clipped to each row of squares, and the result to each square [SH74]: by Green's formula the edges that
 * clipping adds along the border cancel in integrals, whatever the ring. A square gives its four nodes the integrals of
 * (1 - u) (1 - v), u (1 - v), (1 - u) v and u v, (u, v) the place in it.
 *
 * Rounding. Coordinates are divided by a power of two, and subtraction leaves fewer digits: exact. A corner that
 * clipping makes is off by some units in the last place of numbers below 2^12, the most squares that a body may span; a
 * corner of the outline by one unit of the layer's numbers. Either changes the area by a bounded amount for each
 * corner; masses are reduced by more than that. */
#include "displacement/prove/areas/areas.h"
#include "displacement/prove/areas/tuning.h"

#include "base/extremes.h"

#include <math.h>

typedef struct ring {
    double *xy;
    size_t n, capacity;
} ring;

static bool push(ring *r, double x, double y)
{
    if (2 * r->n + 2 > r->capacity && !sunder_i_reserve(&r->xy, &r->capacity, 2 * r->n + 2, sizeof *r->xy))
        return false;
    r->xy[2 * r->n] = x;
    r->xy[2 * r->n++ + 1] = y;
    return true;
}

/* What of the ring has sign * coordinate c <= sign * at. */
static bool clip(const ring *in, int c, double at, double sign, ring *out)
{
    out->n = 0;
    for (size_t k = 0; k < in->n; k++) {
        const double *a = in->xy + 2 * k, *b = in->xy + 2 * (k + 1 < in->n ? k + 1 : 0);
        const double da = sign * (a[c] - at), db = sign * (b[c] - at);
        if (da <= 0 && !push(out, a[0], a[1])) return false;
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
            double p[2];
            p[c] = at;
            p[!c] = a[!c] + (b[!c] - a[!c]) * (da / (da - db));
            if (!push(out, p[0], p[1])) return false;
        }
    }
    return true;
}

/* What of the ring has from <= coordinate c <= from + 1. */
static bool slice(const ring *in, int c, double from, ring *half, ring *out)
{
    return clip(in, c, from, -1, half) && clip(half, c, from + 1, 1, out);
}

/* The integrals of 1, u, v and u v over what the ring encloses, (u, v) relative to (x, y). */
static void integrate(const ring *r, double x, double y, double out[4])
{
    for (int k = 0; k < 4; k++) out[k] = 0;
    for (size_t k = 0; k < r->n; k++) {
        const double *p = r->xy + 2 * k, *q = r->xy + 2 * (k + 1 < r->n ? k + 1 : 0);
        const double ax = p[0] - x, ay = p[1] - y, bx = q[0] - x, by = q[1] - y, cross = ax * by - bx * ay;
        out[0] += cross / 2;
        out[1] += (ax + bx) * cross / 6;
        out[2] += (ay + by) * cross / 6;
        out[3] += cross * (ax * (2 * ay + by) + bx * (ay + 2 * by)) / 24;
    }
}

typedef struct spreading {
    ring whole, row, square, half;
    double *mass;  /* [columns * rows] of nodes, in squares */
    double *doubt; /* likewise: how many corners had a part in it */
    size_t columns, rows;
} spreading;

static void give(spreading *s, size_t i, size_t j)
{
    double m[4];
    integrate(&s->square, (double)i, (double)j, m);
    const double share[4] = {m[0] - m[1] - m[2] + m[3], m[1] - m[3], m[2] - m[3], m[3]};
    for (size_t k = 0; k < 4; k++) {
        const size_t at = (j + (k >> 1)) * s->columns + i + (k & 1);
        s->mass[at] += share[k];
        s->doubt[at] += (double)s->square.n;
    }
}

/* The squares that a part of a ring meets, along one axis. */
static void span_of(const ring *r, int c, size_t most, size_t *from, size_t *to)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < r->n; k++) {
        low = sunder_i_min(low, r->xy[2 * k + (size_t)c]);
        high = sunder_i_max(high, r->xy[2 * k + (size_t)c]);
    }
    *from = r->n ? (size_t)sunder_i_max(low, 0) : 0;
    *to = r->n ? (size_t)sunder_i_min(ceil(high), (double)most) : 0;
}

static bool spread(spreading *s)
{
    size_t from, to;
    span_of(&s->whole, 1, s->rows - 1, &from, &to);
    for (size_t j = from; j < to; j++) {
        size_t left, right;
        if (!slice(&s->whole, 1, (double)j, &s->half, &s->row)) return false;
        span_of(&s->row, 0, s->columns - 1, &left, &right);
        for (size_t i = left; i < right; i++) {
            if (!slice(&s->row, 0, (double)i, &s->half, &s->square)) return false;
            give(s, i, j);
        }
    }
    return true;
}

/* Whole numbers, less than what was found by more than it may be off. */
static void settle(const spreading *s, double doubt_each, sunder_i_masses *masses)
{
    double most = 0;
    masses->total = 0;
    for (size_t k = 0; k < s->columns * s->rows; k++) {
        const double doubt = 2 + s->doubt[k] * doubt_each;
        const double m = s->mass[k] * (double)SUNDER_I_MASS_OF_SQUARE - doubt;
        masses->at[k] = m > 0 ? (int32_t)m : 0;
        masses->total += masses->at[k];
        most = sunder_i_max(most, doubt);
    }
    masses->slack = (int64_t)(2 * most) + 1;
}

bool sunder_i_masses_make(const sunder_i_outline *outline, const sunder_i_grid *grid, sunder_i_masses *masses)
{
    const double side = grid->side;
    const double x = floor(outline->box[0] / side), y = floor(outline->box[1] / side);
    spreading s = {.columns = (size_t)(ceil(outline->box[2] / side) - x) + 1,
                   .rows = (size_t)(ceil(outline->box[3] / side) - y) + 1};
    const size_t nodes = s.columns * s.rows;
    *masses = (sunder_i_masses){.at = sunder_i_calloc(nodes, sizeof *masses->at),
                                .x = (int64_t)x - grid->x,
                                .y = (int64_t)y - grid->y,
                                .columns = s.columns,
                                .rows = s.rows};
    s.mass = sunder_i_calloc(nodes, sizeof *s.mass);
    s.doubt = sunder_i_calloc(nodes, sizeof *s.doubt);
    bool ok = masses->at && s.mass && s.doubt;
    for (size_t r = 0, from = 0; ok && r < outline->rings; from = outline->ring_end[r++]) {
        s.whole.n = 0;
        for (size_t k = from; ok && k < outline->ring_end[r]; k++)
            ok = push(&s.whole, outline->xy[2 * k] / side - x, outline->xy[2 * k + 1] / side - y);
        ok = ok && spread(&s);
    }
    double far = 0;
    for (int k = 0; k < 4; k++) far = sunder_i_max(far, fabs(outline->box[k]) / side);
    if (ok) settle(&s, CORNER_DOUBT + far * 0x1p-30, masses);
    sunder_i_free(s.whole.xy);
    sunder_i_free(s.row.xy);
    sunder_i_free(s.square.xy);
    sunder_i_free(s.half.xy);
    sunder_i_free(s.mass);
    sunder_i_free(s.doubt);
    return ok;
}

void sunder_i_masses_free(sunder_i_masses *masses)
{
    sunder_i_free(masses->at);
    *masses = (sunder_i_masses){0};
}
