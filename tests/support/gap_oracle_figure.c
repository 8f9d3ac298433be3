/* Brute force for gaps: the figures, and the gap in rationals. */
#include "gap_oracle_inner.h"

#include "slabs.h"

#include <math.h>
#include <stdlib.h>

/* ---- Sides and corners ---- */

static size_t sides_of(const polyset *s, side *out)
{
    size_t n = 0;
    for (size_t r = 0, v = 0; r < s->rings; r++) {
        const size_t first = v, end = s->ring_end[r];
        for (; v < end; v++) {
            const size_t w = v + 1 < end ? v + 1 : first;
            out[n++] = (side){s->xy[2 * v], s->xy[2 * v + 1], s->xy[2 * w], s->xy[2 * w + 1]};
        }
    }
    return n;
}

void figure_open(figure *f, const polyset *p, const polyset *q, double gap)
{
    *f = (figure){p, q, test_alloc(p->vertices, sizeof *f->a), test_alloc(q->vertices, sizeof *f->b), 0, 0, gap};
    f->n = sides_of(p, f->a);
    f->m = sides_of(q, f->b);
}

void figure_close(figure *f)
{
    free(f->a);
    free(f->b);
}

bool interiors_apart(const figure *f, double tx, double ty)
{
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = 0; j < f->m; j++) {
            const side u = f->a[i], v = {f->b[j].ax + tx, f->b[j].ay + ty, f->b[j].bx + tx, f->b[j].by + ty};
            const double ux = u.bx - u.ax, uy = u.by - u.ay, vx = v.bx - v.ax, vy = v.by - v.ay;
            const double c1 = ux * (v.ay - u.ay) - uy * (v.ax - u.ax), c2 = ux * (v.by - u.ay) - uy * (v.bx - u.ax);
            const double c3 = vx * (u.ay - v.ay) - vy * (u.ax - v.ax), c4 = vx * (u.by - v.ay) - vy * (u.bx - v.ax);
            if ((c1 < 0) != (c2 < 0) && (c3 < 0) != (c4 < 0)) return false;
        }
    for (size_t r = 0, v = 0; r < f->q->rings; v = f->q->ring_end[r++])
        if (polyset_holds(f->p, f->q->xy[2 * v] + tx, f->q->xy[2 * v + 1] + ty)) return false;
    for (size_t r = 0, v = 0; r < f->p->rings; v = f->p->ring_end[r++])
        if (polyset_holds(f->q, f->p->xy[2 * v] - tx, f->p->xy[2 * v + 1] - ty)) return false;
    return true;
}

/* ---- The gap, in rationals ---- */

static void cross_and_dot(mpq_t cross, mpq_t dot, const mpq_t ux, const mpq_t uy, const mpq_t vx, const mpq_t vy)
{
    mpq_t t;
    mpq_init(t);
    mpq_mul(cross, ux, vy);
    mpq_mul(t, uy, vx);
    mpq_sub(cross, cross, t);
    mpq_mul(dot, ux, vx);
    mpq_mul(t, uy, vy);
    mpq_add(dot, dot, t);
    mpq_clear(t);
}

static void difference(mpq_t out, double a, double b)
{
    mpq_t t;
    mpq_init(t);
    mpq_set_d(out, a);
    mpq_set_d(t, b);
    mpq_sub(out, out, t);
    mpq_clear(t);
}

/* Is corner (cx, cy) + sign (x, y) at least the gap from the side? */
static bool far_enough(const side *s, double cx, double cy, const mpq_t x, const mpq_t y, int sign, double gap)
{
    mpq_t dx, dy, vx, vy, cross, dot, none, square, limit;
    mpq_inits(dx, dy, vx, vy, cross, dot, none, square, limit, NULL);
    difference(dx, s->bx, s->ax);
    difference(dy, s->by, s->ay);
    difference(vx, cx, s->ax);
    difference(vy, cy, s->ay);
    (sign > 0 ? mpq_add : mpq_sub)(vx, vx, x);
    (sign > 0 ? mpq_add : mpq_sub)(vy, vy, y);
    cross_and_dot(cross, dot, dx, dy, vx, vy);
    cross_and_dot(none, square, dx, dy, dx, dy);
    mpq_set_d(limit, gap);
    mpq_mul(limit, limit, limit);
    if (mpq_sgn(dot) > 0 && mpq_cmp(dot, square) < 0) { /* the foot is on the side: cross^2 >= gap^2 |d|^2 */
        mpq_mul(cross, cross, cross);
        mpq_mul(limit, limit, square);
    } else { /* |v|^2, measured from the nearer end */
        if (mpq_sgn(dot) > 0) {
            mpq_sub(vx, vx, dx);
            mpq_sub(vy, vy, dy);
        }
        cross_and_dot(none, cross, vx, vy, vx, vy);
    }
    const bool far = mpq_cmp(cross, limit) >= 0;
    mpq_clears(dx, dy, vx, vy, cross, dot, none, square, limit, NULL);
    return far;
}

bool gap_oracle_keeps(const polyset *p, const polyset *q, double gap, const mpq_t x, const mpq_t y)
{
    figure f;
    figure_open(&f, p, q, gap);
    bool keeps = true;
    for (size_t i = 0; i < f.n && keeps; i++)
        for (size_t j = 0; j < f.m && keeps; j++)
            keeps = far_enough(&f.a[i], f.b[j].ax, f.b[j].ay, x, y, 1, gap) &&
                    far_enough(&f.b[j], f.a[i].ax, f.a[i].ay, x, y, -1, gap);
    figure_close(&f);
    mpq_t at[2];
    mpq_inits(at[0], at[1], NULL);
    mpq_set(at[0], x);
    mpq_set(at[1], y);
    keeps = keeps && !interiors_meet(p, q, (const mpq_t *)&at[0], (const mpq_t *)&at[1]);
    mpq_clears(at[0], at[1], NULL);
    return keeps;
}
