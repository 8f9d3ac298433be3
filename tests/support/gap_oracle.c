#include "gap_oracle.h"

#include <math.h>
#include <stdlib.h>

/* ---- Sides and corners ---- */

typedef struct side {
    double ax, ay, bx, by;
} side;

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

typedef struct figure {
    const polyset *p, *q;
    side *a, *b;
    size_t n, m;
    double gap;
} figure;

static void figure_open(figure *f, const polyset *p, const polyset *q, double gap)
{
    *f = (figure){p, q, test_alloc(p->vertices, sizeof *f->a), test_alloc(q->vertices, sizeof *f->b), 0, 0, gap};
    f->n = sides_of(p, f->a);
    f->m = sides_of(q, f->b);
}

static void figure_close(figure *f)
{
    free(f->a);
    free(f->b);
}

static bool inside(const polyset *s, double x, double y)
{
    for (size_t p = 0, r = 0, v = 0; p < s->polygons; p++) {
        bool in = false;
        for (; r < s->poly_end[p]; r++) {
            const size_t first = v, end = s->ring_end[r];
            for (; v < end; v++) {
                const size_t w = v + 1 < end ? v + 1 : first;
                const double ay = s->xy[2 * v + 1], by = s->xy[2 * w + 1];
                if ((ay > y) == (by > y)) continue;
                if (x < s->xy[2 * v] + (y - ay) / (by - ay) * (s->xy[2 * w] - s->xy[2 * v])) in = !in;
            }
        }
        if (in) return true;
    }
    return false;
}

/* For sets of which each corner is at least the gap from all sides of the other: then no sign here is in doubt. */
static bool interiors_apart(const figure *f, double tx, double ty)
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
        if (inside(f->p, f->q->xy[2 * v] + tx, f->q->xy[2 * v + 1] + ty)) return false;
    for (size_t r = 0, v = 0; r < f->p->rings; v = f->p->ring_end[r++])
        if (inside(f->q, f->p->xy[2 * v] - tx, f->p->xy[2 * v + 1] - ty)) return false;
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
    if (mpq_sgn(dot) > 0 && mpq_cmp(dot, square) < 0) { /* over the side: cross^2 >= gap^2 |d|^2 */
        mpq_mul(cross, cross, cross);
        mpq_mul(limit, limit, square);
    } else { /* |v|^2, from the other end if that is nearer */
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
    keeps = keeps && interiors_apart(&f, mpq_get_d(x), mpq_get_d(y));
    figure_close(&f);
    return keeps;
}

/* ---- Places, in long binary fractions ---- */

enum { SHORT, LONG };
static const mp_bitcnt_t PRECISION[] = {512, 4096}, ZERO_BITS[] = {300, 2700};

/* A line n . x = c with |n| = 1, or (n = 0) a circle about (x, y). */
typedef struct track {
    bool circle;
    double x, y, nx, ny, c;
    double corner[4], direction[4]; /* exactly: ([0] - [2], [1] - [3]); of the side its direction */
    double gap;
    bool ready[2];
    mpf_t hx[2], hy[2], hnx[2], hny[2], hc[2];
} track;

static void minus(mpf_t out, double a, double b)
{
    mpf_t t;
    mpf_init2(t, 64);
    mpf_set_d(out, a);
    mpf_set_d(t, b);
    mpf_sub(out, out, t);
    mpf_clear(t);
}

static void prepare(track *t, int level)
{
    if (t->ready[level]) return;
    t->ready[level] = true;
    const mp_bitcnt_t bits = PRECISION[level];
    mpf_t length, u;
    mpf_init2(length, bits);
    mpf_init2(u, bits);
    mpf_t *made[] = {&t->hx[level], &t->hy[level], &t->hnx[level], &t->hny[level], &t->hc[level]};
    for (size_t i = 0; i < 5; i++) mpf_init2(*made[i], bits);
    minus(t->hx[level], t->corner[0], t->corner[2]);
    minus(t->hy[level], t->corner[1], t->corner[3]);
    if (!t->circle) {
        minus(t->hny[level], t->direction[2], t->direction[0]);
        minus(t->hnx[level], t->direction[1], t->direction[3]);
        mpf_mul(length, t->hnx[level], t->hnx[level]);
        mpf_mul(u, t->hny[level], t->hny[level]);
        mpf_add(length, length, u);
        mpf_sqrt(length, length);
        mpf_div(t->hnx[level], t->hnx[level], length);
        mpf_div(t->hny[level], t->hny[level], length);
        mpf_mul(t->hc[level], t->hnx[level], t->hx[level]);
        mpf_mul(u, t->hny[level], t->hy[level]);
        mpf_add(t->hc[level], t->hc[level], u);
        mpf_set_d(u, t->gap);
        mpf_add(t->hc[level], t->hc[level], u);
    }
    mpf_clear(length);
    mpf_clear(u);
}

static void release(track *t)
{
    for (int k = 0; k < 2; k++)
        if (t->ready[k]) mpf_clears(t->hx[k], t->hy[k], t->hnx[k], t->hny[k], t->hc[k], NULL);
}

/* A foot has u NULL; root: which of two crossings. */
typedef struct place {
    track *t, *u;
    int root;
    double x, y;
} place;

typedef struct numbers {
    mpf_t v[8];
} numbers;

static void numbers_open(numbers *n, int level)
{
    for (int i = 0; i < 8; i++) mpf_init2(n->v[i], PRECISION[level]);
}

static void numbers_close(numbers *n)
{
    for (int i = 0; i < 8; i++) mpf_clear(n->v[i]);
}

/* out = a b + c d */
static void pair_sum(mpf_t out, const mpf_t a, const mpf_t b, const mpf_t c, const mpf_t d, mpf_t work, bool subtract)
{
    mpf_mul(work, c, d);
    mpf_mul(out, a, b);
    (subtract ? mpf_sub : mpf_add)(out, out, work);
}

static bool foot(mpf_t x, mpf_t y, track *t, int level, numbers *w)
{
    if (!t->circle) {
        mpf_mul(x, t->hnx[level], t->hc[level]);
        mpf_mul(y, t->hny[level], t->hc[level]);
        return true;
    }
    pair_sum(w->v[0], t->hx[level], t->hx[level], t->hy[level], t->hy[level], w->v[1], false);
    mpf_set_d(w->v[2], t->gap);
    if (mpf_sgn(w->v[0]) == 0) {
        mpf_neg(x, w->v[2]);
        mpf_set_ui(y, 0);
        return true;
    }
    mpf_sqrt(w->v[0], w->v[0]);
    mpf_div(w->v[2], w->v[2], w->v[0]);
    mpf_ui_sub(w->v[2], 1, w->v[2]);
    mpf_mul(x, t->hx[level], w->v[2]);
    mpf_mul(y, t->hy[level], w->v[2]);
    return true;
}

static bool negligible(const mpf_t v, int level)
{
    long exponent;
    mpf_get_d_2exp(&exponent, v);
    return mpf_sgn(v) == 0 || exponent < -(long)ZERO_BITS[level];
}

static bool line_line(mpf_t x, mpf_t y, const track *t, const track *u, int k, numbers *w)
{
    pair_sum(w->v[0], t->hnx[k], u->hny[k], t->hny[k], u->hnx[k], w->v[1], true);
    if (negligible(w->v[0], k)) return false;
    pair_sum(x, t->hc[k], u->hny[k], u->hc[k], t->hny[k], w->v[1], true);
    pair_sum(y, t->hnx[k], u->hc[k], u->hnx[k], t->hc[k], w->v[1], true);
    mpf_div(x, x, w->v[0]);
    mpf_div(y, y, w->v[0]);
    return true;
}

/* From the point (x, y), half a chord of sqrt(gap^2 - off^2) along (dx, dy), |d| = 1. */
static bool along_chord(mpf_t x, mpf_t y, mpf_t dx, mpf_t dy, mpf_t off, double gap, int root, int k, mpf_t work)
{
    mpf_mul(off, off, off);
    mpf_set_d(work, gap);
    mpf_mul(work, work, work);
    mpf_sub(off, work, off);
    if (negligible(off, k)) mpf_set_ui(off, 0);
    if (mpf_sgn(off) < 0) return false;
    mpf_sqrt(off, off);
    if (root < 0) mpf_neg(off, off);
    mpf_mul(work, dx, off);
    mpf_add(x, x, work);
    mpf_mul(work, dy, off);
    mpf_add(y, y, work);
    return true;
}

static bool line_circle(mpf_t x, mpf_t y, const track *t, const track *u, int root, int k, numbers *w)
{
    pair_sum(w->v[0], t->hnx[k], u->hx[k], t->hny[k], u->hy[k], w->v[1], false);
    mpf_sub(w->v[0], t->hc[k], w->v[0]); /* the line is so far from the center */
    mpf_mul(x, t->hnx[k], w->v[0]);
    mpf_add(x, x, u->hx[k]);
    mpf_mul(y, t->hny[k], w->v[0]);
    mpf_add(y, y, u->hy[k]);
    mpf_neg(w->v[2], t->hny[k]);
    mpf_set(w->v[3], t->hnx[k]);
    return along_chord(x, y, w->v[2], w->v[3], w->v[0], t->gap, root, k, w->v[4]);
}

static bool circle_circle(mpf_t x, mpf_t y, const track *t, const track *u, int root, int k, numbers *w)
{
    mpf_sub(w->v[2], t->hy[k], u->hy[k]);
    mpf_sub(w->v[3], u->hx[k], t->hx[k]);
    pair_sum(w->v[0], w->v[2], w->v[2], w->v[3], w->v[3], w->v[1], false);
    if (mpf_sgn(w->v[0]) == 0) return false;
    mpf_sqrt(w->v[0], w->v[0]);
    mpf_div(w->v[2], w->v[2], w->v[0]);
    mpf_div(w->v[3], w->v[3], w->v[0]);
    mpf_div_ui(w->v[0], w->v[0], 2);
    mpf_add(x, t->hx[k], u->hx[k]);
    mpf_add(y, t->hy[k], u->hy[k]);
    mpf_div_ui(x, x, 2);
    mpf_div_ui(y, y, 2);
    return along_chord(x, y, w->v[2], w->v[3], w->v[0], t->gap, root, k, w->v[4]);
}

/* The place to so many bits; false if there is none. */
static bool locate(mpf_t x, mpf_t y, const place *p, int level, numbers *w)
{
    prepare(p->t, level);
    if (!p->u) return foot(x, y, p->t, level, w);
    prepare(p->u, level);
    if (p->t->circle && p->u->circle) return circle_circle(x, y, p->t, p->u, p->root, level, w);
    if (p->t->circle) return line_circle(x, y, p->u, p->t, p->root, level, w);
    return p->u->circle ? line_circle(x, y, p->t, p->u, p->root, level, w) : line_line(x, y, p->t, p->u, level, w);
}

/* Squared distance of corner (cx, cy) + sign (x, y) from the side, less that of the gap. */
static void excess(mpf_t out, const side *s, double cx, double cy, const mpf_t x, const mpf_t y, int sign, double gap,
                   numbers *w)
{
    mpf_t *v = w->v;
    minus(v[0], s->bx, s->ax);
    minus(v[1], s->by, s->ay);
    minus(v[2], cx, s->ax);
    minus(v[3], cy, s->ay);
    (sign > 0 ? mpf_add : mpf_sub)(v[2], v[2], x);
    (sign > 0 ? mpf_add : mpf_sub)(v[3], v[3], y);
    pair_sum(v[4], v[0], v[2], v[1], v[3], v[6], false);
    pair_sum(v[5], v[0], v[0], v[1], v[1], v[6], false);
    if (mpf_sgn(v[4]) > 0 && mpf_cmp(v[4], v[5]) < 0) {
        pair_sum(v[4], v[0], v[3], v[1], v[2], v[6], true);
        mpf_mul(v[4], v[4], v[4]);
        mpf_div(out, v[4], v[5]);
    } else {
        if (mpf_sgn(v[4]) > 0) {
            mpf_sub(v[2], v[2], v[0]);
            mpf_sub(v[3], v[3], v[1]);
        }
        pair_sum(out, v[2], v[2], v[3], v[3], v[6], false);
    }
    mpf_set_d(v[4], gap);
    mpf_mul(v[4], v[4], v[4]);
    mpf_sub(out, out, v[4]);
}

static double side_distance(const side *s, double x, double y)
{
    const double dx = s->bx - s->ax, dy = s->by - s->ay;
    double t = ((x - s->ax) * dx + (y - s->ay) * dy) / (dx * dx + dy * dy);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(x - s->ax - t * dx, y - s->ay - t * dy);
}

/* 1 keeps the gap, 0 does not, -1 more bits are needed. With many bits what is next to nothing is nothing. What doubles
 * see farther than the gap by `spare` is not asked. */
static int keeps(const figure *f, const mpf_t x, const mpf_t y, double spare, int level, numbers *w)
{
    const double dx = mpf_get_d(x), dy = mpf_get_d(y), far = f->gap + spare;
    int answer = 1;
    mpf_t e;
    mpf_init2(e, PRECISION[level]);
    for (size_t i = 0; i < f->n && answer; i++)
        for (size_t j = 0; j < f->m && answer; j++)
            for (int k = 0; k < 2 && answer; k++) {
                if ((k ? side_distance(&f->b[j], f->a[i].ax - dx, f->a[i].ay - dy)
                       : side_distance(&f->a[i], f->b[j].ax + dx, f->b[j].ay + dy)) > far)
                    continue;
                if (k)
                    excess(e, &f->b[j], f->a[i].ax, f->a[i].ay, x, y, -1, f->gap, w);
                else
                    excess(e, &f->a[i], f->b[j].ax, f->b[j].ay, x, y, 1, f->gap, w);
                if (negligible(e, level))
                    answer = level == LONG ? answer : -1;
                else if (mpf_sgn(e) < 0)
                    answer = 0;
            }
    mpf_clear(e);
    return answer;
}

/* ---- All of them ---- */

static void add_tracks(const figure *f, track *t, size_t *n)
{
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = 0; j < f->m; j++) {
            const side *a = &f->a[i], *b = &f->b[j];
            const track corner = {.circle = true, .x = a->ax - b->ax, .y = a->ay - b->ay, .gap = f->gap,
                                  .corner = {a->ax, a->ay, b->ax, b->ay}};
            t[(*n)++] = corner;
            for (int k = 0; k < 4; k++) {
                const side *s = k & 1 ? b : a;
                track v = corner;
                v.circle = false;
                v.gap = k & 2 ? -f->gap : f->gap;
                v.direction[0] = s->bx;
                v.direction[1] = s->by;
                v.direction[2] = s->ax;
                v.direction[3] = s->ay;
                const double dx = s->bx - s->ax, dy = s->by - s->ay, length = hypot(dx, dy);
                v.nx = dy / length;
                v.ny = -dx / length;
                v.c = v.nx * v.x + v.ny * v.y + v.gap;
                t[(*n)++] = v;
            }
        }
}

/* Without those that are farther than the limit all along; returns how many are left. */
static size_t drop_far_tracks(track *t, size_t n, double limit)
{
    size_t left = 0;
    for (size_t i = 0; i < n; i++) {
        const double off = t[i].circle ? fabs(hypot(t[i].x, t[i].y) - t[i].gap) : fabs(t[i].c);
        if (off <= limit) t[left++] = t[i];
    }
    return left;
}

/* Two sides along the same axis. */
static bool plainly_parallel(const track *t, const track *u)
{
    return (t->nx == 0 && u->nx == 0) || (t->ny == 0 && u->ny == 0);
}

/* In doubles: false if the place is known to be farther than the limit. *sure: x and y are good to 1e-9 of the figure. */
static bool rough_place(place *p, double size, double limit, bool *sure)
{
    const track *t = p->t, *u = p->u;
    *sure = true;
    if (!u) {
        const double length = hypot(t->x, t->y), k = t->circle ? length > 0 ? 1 - t->gap / length : 0 : t->c;
        *sure = !t->circle || length > 1e-6 * size;
        p->x = (t->circle ? t->x : t->nx) * k;
        p->y = (t->circle ? t->y : t->ny) * k;
    } else if (!t->circle && !u->circle) {
        if (plainly_parallel(t, u)) return false;
        const double cross = t->nx * u->ny - t->ny * u->nx;
        if (!(fabs(cross) > 1e-5)) {
            *sure = false;
            return true;
        }
        p->x = (t->c * u->ny - u->c * t->ny) / cross;
        p->y = (t->nx * u->c - u->nx * t->c) / cross;
    } else {
        const track *c = t->circle ? t : u, *l = t->circle ? u : t;
        double nx = l->nx, ny = l->ny, off = l->c - (nx * c->x + ny * c->y);
        if (l->circle) {
            const double vx = l->x - c->x, vy = l->y - c->y, length = hypot(vx, vy);
            if (!(length > 1e-5 * size)) {
                *sure = false;
                return true;
            }
            off = length / 2;
            nx = vx / length;
            ny = vy / length;
        }
        const double gap = fabs(c->gap), h = gap * gap - off * off, doubt = 1e-12 * size * gap;
        if (h < -doubt || hypot(c->x, c->y) > limit + gap * (1 + 1e-9)) return false;
        if (!(h > 1e-5 * gap * gap + doubt)) {
            *sure = false;
            return true;
        }
        const double half = sqrt(h);
        p->x = c->x + nx * off - ny * p->root * half;
        p->y = c->y + ny * off + nx * p->root * half;
    }
    return true;
}

/* In doubles: does a place fail to keep the gap, by far more than they are off? */
static bool plainly_near(const figure *f, double x, double y, double spare)
{
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = 0; j < f->m; j++)
            if (side_distance(&f->a[i], f->b[j].ax + x, f->b[j].ay + y) < f->gap - spare ||
                side_distance(&f->b[j], f->a[i].ax - x, f->a[i].ay - y) < f->gap - spare)
                return true;
    return false;
}

typedef struct judging {
    figure f;
    double size, limit; /* of the figure; places farther than this do not matter */
    mpf_t answer, bound; /* squares: of the answer less 1e-9 of it, and of the bound */
    numbers work[2];
    mpf_t x[2], y[2], square;
    gap_verdict verdict;
    double length;
} judging;

static void try_place(judging *g, place *p)
{
    bool sure;
    if (!rough_place(p, g->size, g->limit, &sure)) return;
    const double spare = 1e-7 * g->size;
    if (sure && (hypot(p->x, p->y) > g->limit + spare || plainly_near(&g->f, p->x, p->y, spare))) return;
    if (!locate(g->x[SHORT], g->y[SHORT], p, SHORT, &g->work[SHORT])) return;
    const double x = mpf_get_d(g->x[SHORT]), y = mpf_get_d(g->y[SHORT]);
    if (hypot(x, y) > g->limit) return;
    /* Once one is found that is as near, only those matter that would say otherwise. */
    pair_sum(g->square, g->x[SHORT], g->x[SHORT], g->y[SHORT], g->y[SHORT], g->work[SHORT].v[0], false);
    if (g->length < INFINITY && mpf_cmp(g->square, g->answer) >= 0 && mpf_cmp(g->square, g->bound) >= 0) return;
    if (plainly_near(&g->f, x, y, spare)) return;
    int free = keeps(&g->f, g->x[SHORT], g->y[SHORT], spare, SHORT, &g->work[SHORT]);
    if (free == 0) return;
    if (!locate(g->x[LONG], g->y[LONG], p, LONG, &g->work[LONG])) return;
    pair_sum(g->square, g->x[LONG], g->x[LONG], g->y[LONG], g->y[LONG], g->work[LONG].v[0], false);
    const bool shorter = mpf_cmp(g->square, g->answer) < 0, below = mpf_cmp(g->square, g->bound) < 0;
    if (free < 0) free = keeps(&g->f, g->x[LONG], g->y[LONG], spare, LONG, &g->work[LONG]);
    if (free <= 0 || !interiors_apart(&g->f, x, y)) return;
    if (below)
        g->verdict = GAP_BOUND_HIGH;
    else if (shorter && g->verdict == GAP_FINE)
        g->verdict = GAP_TOO_LONG;
    g->length = fmin(g->length, sqrt(mpf_get_d(g->square)));
}

static void judging_open(judging *g, const mpq_t square, double bound)
{
    for (size_t i = 0; i < g->f.n; i++) g->size = fmax(g->size, fmax(fabs(g->f.a[i].ax), fabs(g->f.a[i].ay)));
    for (size_t i = 0; i < g->f.m; i++) g->size = fmax(g->size, fmax(fabs(g->f.b[i].ax), fabs(g->f.b[i].ay)));
    g->size += g->f.gap;
    g->limit = sqrt(mpq_get_d(square)) * (1 + 1e-6);
    for (int k = 0; k < 2; k++) {
        numbers_open(&g->work[k], k);
        mpf_init2(g->x[k], PRECISION[k]);
        mpf_init2(g->y[k], PRECISION[k]);
    }
    mpf_init2(g->square, PRECISION[LONG]);
    mpf_init2(g->answer, PRECISION[LONG]);
    mpf_init2(g->bound, PRECISION[LONG]);
    mpf_set_q(g->answer, square);
    mpf_set_d(g->bound, 1 + 1e-9);
    mpf_div(g->answer, g->answer, g->bound);
    mpf_div(g->answer, g->answer, g->bound);
    mpf_set_d(g->bound, bound);
    mpf_mul(g->bound, g->bound, g->bound);
    g->verdict = GAP_FINE;
    g->length = INFINITY;
}

static void judging_close(judging *g)
{
    for (int k = 0; k < 2; k++) {
        numbers_close(&g->work[k]);
        mpf_clears(g->x[k], g->y[k], NULL);
    }
    mpf_clears(g->square, g->answer, g->bound, NULL);
    figure_close(&g->f);
}

gap_verdict gap_oracle_judge(const polyset *p, const polyset *q, double gap, const mpq_t square, double bound,
                             double *length)
{
    judging g = {.size = 0};
    figure_open(&g.f, p, q, gap);
    judging_open(&g, square, bound);
    track *t = test_alloc(5 * g.f.n * g.f.m, sizeof *t);
    size_t n = 0;
    add_tracks(&g.f, t, &n);
    n = drop_far_tracks(t, n, g.limit + 1e-9 * g.size);
    for (size_t i = 0; i < n; i++) {
        place at = {.t = &t[i]};
        try_place(&g, &at);
        for (size_t j = 0; j < i; j++)
            for (int root = -1; root <= 1; root += 2) {
                if (root > 0 && !t[i].circle && !t[j].circle) continue;
                at = (place){&t[i], &t[j], root, 0, 0};
                try_place(&g, &at);
            }
    }
    for (size_t i = 0; i < n; i++) release(&t[i]);
    free(t);
    *length = g.length;
    const gap_verdict verdict = g.verdict;
    judging_close(&g);
    return verdict;
}
