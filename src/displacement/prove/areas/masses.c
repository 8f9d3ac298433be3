/* Distributes a body's area over the nodes of a grid.
 *
 * Each ring is clipped to a row of squares, and the result to each square of the row [SH74]. For rings that are not
 * convex the clipping adds edges along the border of the square; by Green's formula their contributions to the
 * integrals cancel. A square gives its four nodes the integrals of (1 - u) (1 - v), u (1 - v), (1 - u) v and u v, where
 * (u, v) is the position in the square.
 *
 * Rounding: Coordinates are divided by a power of two, and the subtraction leaves fewer digits, so both are exact. A
 * corner that clipping makes has an error of a few units in the last place of numbers below 2^12, which is the largest
 * number of squares that a body may span. A corner of the outline has an error of one unit of the layer's grid of
 * coordinates. Each corner can thus change the area by a bounded amount only, and the masses are reduced by more than
 * these amounts. */
#include "displacement/prove/areas/areas.h"
#include "displacement/prove/areas/tuning.h"

#include "base/extremes.h"

#include <math.h>

typedef struct ring {
    double *xy;
    size_t n, capacity;
} ring;

static bool push_corner(ring *r, double x, double y)
{
    if (2 * r->n + 2 > r->capacity && !sunder_i_reserve(&r->xy, &r->capacity, 2 * r->n + 2, sizeof *r->xy))
        return false;
    r->xy[2 * r->n] = x;
    r->xy[2 * r->n++ + 1] = y;
    return true;
}

/* Writes to *out the part of the ring in which sign * (coordinate c) <= sign * at. Returns false if memory is out. */
static bool clip_ring(const ring *in, int c, double at, double sign, ring *out)
{
    out->n = 0;
    for (size_t k = 0; k < in->n; k++) {
        const double *a = in->xy + 2 * k, *b = in->xy + 2 * (k + 1 < in->n ? k + 1 : 0);
        const double da = sign * (a[c] - at), db = sign * (b[c] - at);
        if (da <= 0 && !push_corner(out, a[0], a[1])) return false;
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
            double p[2];
            p[c] = at;
            p[!c] = a[!c] + (b[!c] - a[!c]) * (da / (da - db));
            if (!push_corner(out, p[0], p[1])) return false;
        }
    }
    return true;
}

/* Writes to *out the part of the ring in which from <= coordinate c <= from + 1; `half` is scratch space. Returns false
 * if memory is out. */
static bool slice_ring(const ring *in, int c, double from, ring *half, ring *out)
{
    return clip_ring(in, c, from, -1, half) && clip_ring(half, c, from + 1, 1, out);
}

/* Computes the integrals of 1, u, v and u v over the area that the ring encloses, where (u, v) is the position relative
 * to (x, y). */
static void integrate_moments(const ring *r, double x, double y, double out[4])
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
    double *mass;  /* [columns * rows] the mass of each node, in squares */
    double *doubt; /* [columns * rows] for each node the number of corners that entered its mass */
    size_t columns, rows;
} spreading;

static void give_square(spreading *s, size_t i, size_t j)
{
    double m[4];
    integrate_moments(&s->square, (double)i, (double)j, m);
    const double share[4] = {m[0] - m[1] - m[2] + m[3], m[1] - m[3], m[2] - m[3], m[3]};
    for (size_t k = 0; k < 4; k++) {
        const size_t at = (j + (k >> 1)) * s->columns + i + (k & 1);
        s->mass[at] += share[k];
        s->doubt[at] += (double)s->square.n;
    }
}

/* Sets *from and *to to the range of squares that the ring meets along axis c, cut to 0 .. most. */
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

static bool spread_ring(spreading *s)
{
    size_t from, to;
    span_of(&s->whole, 1, s->rows - 1, &from, &to);
    for (size_t j = from; j < to; j++) {
        size_t left, right;
        if (!slice_ring(&s->whole, 1, (double)j, &s->half, &s->row)) return false;
        span_of(&s->row, 0, s->columns - 1, &left, &right);
        for (size_t i = left; i < right; i++) {
            if (!slice_ring(&s->row, 0, (double)i, &s->half, &s->square)) return false;
            give_square(s, i, j);
        }
    }
    return true;
}

/* Rounds the masses down to whole numbers, each reduced by more than its possible error. `doubt_each` is the possible
 * error per corner, in the unit of the whole numbers. */
static void round_masses(const spreading *s, double doubt_each, sunder_i_masses *masses)
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
            ok = push_corner(&s.whole, outline->xy[2 * k] / side - x, outline->xy[2 * k + 1] / side - y);
        ok = ok && spread_ring(&s);
    }
    double far = 0;
    for (int k = 0; k < 4; k++) far = sunder_i_max(far, fabs(outline->box[k]) / side);
    if (ok) round_masses(&s, CORNER_DOUBT + far * 0x1p-30, masses);
    sunder_i_free_all(s.whole.xy, s.row.xy, s.square.xy, s.half.xy, s.mass, s.doubt);
    return ok;
}

void sunder_i_masses_free(sunder_i_masses *masses)
{
    sunder_i_free(masses->at);
    *masses = (sunder_i_masses){0};
}
