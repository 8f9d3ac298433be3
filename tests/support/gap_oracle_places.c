/* Brute force for gaps: lines and circles, and their crossings. */
#include "gap_oracle_inner.h"

#include <math.h>

static const mp_bitcnt_t PRECISION[] = {512, 4096}, ZERO_BITS[] = {300, 2700};

mp_bitcnt_t precision(int level) { return PRECISION[level]; }

void minus(mpf_t out, double a, double b)
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

void release(track *t)
{
    for (int k = 0; k < 2; k++)
        if (t->ready[k]) mpf_clears(t->hx[k], t->hy[k], t->hnx[k], t->hny[k], t->hc[k], NULL);
}

void numbers_open(numbers *n, int level)
{
    for (int i = 0; i < 8; i++) mpf_init2(n->v[i], PRECISION[level]);
}

void numbers_close(numbers *n)
{
    for (int i = 0; i < 8; i++) mpf_clear(n->v[i]);
}

void pair_sum(mpf_t out, const mpf_t a, const mpf_t b, const mpf_t c, const mpf_t d, mpf_t work, bool subtract)
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

bool negligible(const mpf_t v, int level)
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

/* Adds to the point (x, y) half a chord, of length sqrt(gap^2 - off^2), in the direction (dx, dy), |d| = 1. */
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
    mpf_sub(w->v[0], t->hc[k], w->v[0]); /* the distance of the line from the centre */
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

bool locate(mpf_t x, mpf_t y, const place *p, int level, numbers *w)
{
    prepare(p->t, level);
    if (!p->u) return foot(x, y, p->t, level, w);
    prepare(p->u, level);
    if (p->t->circle && p->u->circle) return circle_circle(x, y, p->t, p->u, p->root, level, w);
    if (p->t->circle) return line_circle(x, y, p->u, p->t, p->root, level, w);
    return p->u->circle ? line_circle(x, y, p->t, p->u, p->root, level, w) : line_line(x, y, p->t, p->u, level, w);
}

/* ---- All candidates ---- */

size_t add_tracks(const figure *f, track *t)
{
    size_t n = 0;
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = 0; j < f->m; j++) {
            const side *a = &f->a[i], *b = &f->b[j];
            const track corner = {.circle = true,
                                  .x = a->ax - b->ax,
                                  .y = a->ay - b->ay,
                                  .gap = f->gap,
                                  .corner = {a->ax, a->ay, b->ax, b->ay}};
            t[n++] = corner;
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
                t[n++] = v;
            }
        }
    return n;
}

size_t drop_far_tracks(track *t, size_t n, double limit)
{
    size_t left = 0;
    for (size_t i = 0; i < n; i++) {
        const double off = t[i].circle ? fabs(hypot(t[i].x, t[i].y) - t[i].gap) : fabs(t[i].c);
        if (off <= limit) t[left++] = t[i];
    }
    return left;
}

/* Are both parallel to the same axis? */
static bool plainly_parallel(const track *t, const track *u)
{
    return (t->nx == 0 && u->nx == 0) || (t->ny == 0 && u->ny == 0);
}

bool rough_place(place *p, double size, double limit, bool *sure)
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
