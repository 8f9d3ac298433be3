#include "rational_plane.h"

#include <stdlib.h>

void vec_init(vec *v) { mpq_inits(v->x, v->y, NULL); }
void vec_clear(vec *v) { mpq_clears(v->x, v->y, NULL); }

void vec_set_d(vec *v, const double *xy)
{
    mpq_set_d(v->x, xy[0]);
    mpq_set_d(v->y, xy[1]);
}

void vec_sub(vec *r, const vec *p, const vec *q)
{
    mpq_sub(r->x, p->x, q->x);
    mpq_sub(r->y, p->y, q->y);
}

void vec_dot(mpq_t r, const vec *p, const vec *q)
{
    mpq_t other;
    mpq_init(other);
    mpq_mul(other, p->y, q->y);
    mpq_mul(r, p->x, q->x);
    mpq_add(r, r, other);
    mpq_clear(other);
}

void vec_cross(mpq_t r, const vec *p, const vec *q)
{
    mpq_t other;
    mpq_init(other);
    mpq_mul(other, p->y, q->x);
    mpq_mul(r, p->x, q->y);
    mpq_sub(r, r, other);
    mpq_clear(other);
}

int vec_side(const vec *p, const vec *q, const vec *r)
{
    vec a, b;
    mpq_t c;
    vec_init(&a), vec_init(&b), mpq_init(c);
    vec_sub(&a, q, p);
    vec_sub(&b, r, p);
    vec_cross(c, &a, &b);
    const int sign = mpq_sgn(c);
    vec_clear(&a), vec_clear(&b), mpq_clear(c);
    return sign;
}

/* ---- Convex polygons ---- */

static hull hull_new(size_t n)
{
    hull h = {malloc(n * sizeof *h.v), n, n};
    for (size_t k = 0; k < n; k++) vec_init(&h.v[k]);
    return h;
}

void hull_free(hull *h)
{
    for (size_t k = 0; k < h->room; k++) vec_clear(&h->v[k]);
    free(h->v);
}

static int by_place(const void *a, const void *b)
{
    const vec *p = a, *q = b;
    const int c = mpq_cmp(p->x, q->x);
    return c ? c : mpq_cmp(p->y, q->y);
}

/* Andrew's monotone chain. */
hull hull_difference(const double *a, size_t na, const double *b, size_t nb)
{
    hull all = hull_new(na * nb), out = hull_new(2 * na * nb + 2);
    vec p, q;
    vec_init(&p), vec_init(&q);
    for (size_t i = 0; i < na; i++)
        for (size_t j = 0; j < nb; j++) {
            vec_set_d(&p, a + 2 * i);
            vec_set_d(&q, b + 2 * j);
            vec_sub(&all.v[i * nb + j], &p, &q);
        }
    vec_clear(&p), vec_clear(&q);
    qsort(all.v, all.n, sizeof *all.v, by_place);
    size_t m = 0;
    for (int pass = 0; pass < 2; pass++) {
        const size_t bottom = m;
        for (size_t k = 0; k < all.n; k++) {
            const vec *c = &all.v[pass ? all.n - 1 - k : k];
            while (m >= bottom + 2 && vec_side(&out.v[m - 2], &out.v[m - 1], c) <= 0) m--;
            mpq_set(out.v[m].x, c->x);
            mpq_set(out.v[m++].y, c->y);
        }
        m--;
    }
    hull_free(&all);
    out.n = m ? m : 1; /* all corners coincide */
    return out;
}

void hull_square_from(mpq_t best, const hull *h, const vec *p)
{
    bool inside = h->n > 2;
    for (size_t k = 0; k < h->n && inside; k++) inside = vec_side(&h->v[k], &h->v[(k + 1) % h->n], p) >= 0;
    mpq_set_si(best, inside ? 0 : -1, 1);
    vec e, w;
    mpq_t along, whole, d;
    vec_init(&e), vec_init(&w), mpq_inits(along, whole, d, NULL);
    for (size_t k = 0; k < h->n && !inside; k++) {
        vec_sub(&e, &h->v[(k + 1) % h->n], &h->v[k]);
        vec_sub(&w, p, &h->v[k]);
        vec_dot(along, &e, &w);
        vec_dot(whole, &e, &e);
        if (mpq_sgn(along) > 0 && mpq_cmp(along, whole) < 0) {
            vec_cross(d, &e, &w);
            mpq_mul(d, d, d);
            mpq_div(d, d, whole);
        } else {
            if (mpq_sgn(along) > 0) vec_sub(&w, p, &h->v[(k + 1) % h->n]);
            vec_dot(d, &w, &w);
        }
        if (mpq_sgn(best) < 0 || mpq_cmp(d, best) < 0) mpq_set(best, d);
    }
    vec_clear(&e), vec_clear(&w), mpq_clears(along, whole, d, NULL);
}

bool hull_holds_disc(const hull *h, const vec *p, const mpq_t square)
{
    bool holds = true;
    vec e, w;
    mpq_t room, whole;
    vec_init(&e), vec_init(&w), mpq_inits(room, whole, NULL);
    for (size_t k = 0; k < h->n && holds; k++) {
        vec_sub(&e, &h->v[(k + 1) % h->n], &h->v[k]);
        vec_sub(&w, p, &h->v[k]);
        vec_cross(room, &e, &w);
        vec_dot(whole, &e, &e);
        mpq_mul(whole, whole, square);
        holds = mpq_sgn(room) >= 0;
        mpq_mul(room, room, room);
        holds = holds && mpq_cmp(room, whole) >= 0;
    }
    vec_clear(&e), vec_clear(&w), mpq_clears(room, whole, NULL);
    return holds;
}
