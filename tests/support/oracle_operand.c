/* Operands of the oracle: doubles on an integer grid, and a triangulation found by trying all candidates. */
#include "oracle_inner.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

void zpoint_init(zpoint *p)
{
    mpz_inits(p->x, p->y, NULL);
    p->sx = p->sy = 0;
}

void zpoint_clear(zpoint *p) { mpz_clears(p->x, p->y, NULL); }

void zpoint_set_small(const oracle *o, zpoint *p)
{
    if (!o->small) return;
    p->sx = mpz_get_si(p->x);
    p->sy = mpz_get_si(p->y);
}

int zpoint_cmp(const zpoint *a, const zpoint *b)
{
    const int c = mpz_cmp(a->x, b->x);
    return c ? c : mpz_cmp(a->y, b->y);
}

int oracle_orient(const oracle *o, const zpoint *a, const zpoint *b, const zpoint *c)
{
    if (o->small) {
        const oracle_i128 d =
            (oracle_i128)(b->sx - a->sx) * (c->sy - a->sy) - (oracle_i128)(b->sy - a->sy) * (c->sx - a->sx);
        return (d > 0) - (d < 0);
    }
    mpz_t u, v, s, t;
    mpz_inits(u, v, s, t, NULL);
    mpz_sub(u, b->x, a->x);
    mpz_sub(v, c->y, a->y);
    mpz_mul(s, u, v);
    mpz_sub(u, b->y, a->y);
    mpz_sub(v, c->x, a->x);
    mpz_mul(t, u, v);
    const int sign = mpz_cmp(s, t);
    mpz_clears(u, v, s, t, NULL);
    return (sign > 0) - (sign < 0);
}

/* The double v times 2^shift, an integer. */
static void grid(mpz_t z, double v, long shift)
{
    int e;
    const double m = frexp(v, &e);
    mpz_set_d(z, ldexp(m, 53));
    const long up = e - 53 + shift;
    if (up >= 0)
        mpz_mul_2exp(z, z, (mp_bitcnt_t)up);
    else
        mpz_tdiv_q_2exp(z, z, (mp_bitcnt_t)-up); /* exact: v is a multiple of 2^-shift */
}

static int ring_sign(const polyset *set, size_t first, size_t end, long shift)
{
    mpz_t sum, t, a, b;
    mpz_inits(sum, t, a, b, NULL);
    for (size_t i = first; i < end; i++) {
        const size_t j = i + 1 < end ? i + 1 : first;
        grid(a, set->xy[2 * i], shift);
        grid(b, set->xy[2 * j + 1], shift);
        mpz_addmul(sum, a, b);
        grid(a, set->xy[2 * i + 1], shift);
        grid(b, set->xy[2 * j], shift);
        mpz_submul(sum, a, b);
    }
    const int sign = mpz_sgn(sum);
    mpz_clears(sum, t, a, b, NULL);
    return sign;
}

static void open_zset(zset *z, size_t vertices, size_t members)
{
    z->v = test_alloc(vertices, sizeof *z->v);
    z->next = test_alloc(vertices, sizeof *z->next);
    z->prev = test_alloc(vertices, sizeof *z->prev);
    z->member = test_alloc(vertices, sizeof *z->member);
    z->n = 0;
    z->members = members;
    z->triangles = 0;
    z->triangle = NULL;
}

void oracle_load(oracle *o, zset *z, const polyset *set)
{
    open_zset(z, set->vertices, set->polygons);
    size_t first = 0, r = 0;
    for (size_t p = 0; p < set->polygons; p++)
        for (size_t r0 = r; r < set->poly_end[p]; r++) {
            const size_t end = set->ring_end[r], start = z->n;
            const bool turn = (ring_sign(set, first, end, o->shift) > 0) != (r == r0);
            for (size_t i = first; i < end; i++) {
                const size_t k = turn ? first + end - 1 - i : i;
                zpoint *v = &z->v[z->n];
                zpoint_init(v);
                grid(v->x, set->xy[2 * k], o->shift);
                grid(v->y, set->xy[2 * k + 1], o->shift);
                if (z->n > start && zpoint_cmp(v, v - 1) == 0) {
                    zpoint_clear(v);
                    continue;
                }
                zpoint_set_small(o, v);
                z->member[z->n++] = p;
            }
            while (z->n > start + 1 && zpoint_cmp(&z->v[start], &z->v[z->n - 1]) == 0) zpoint_clear(&z->v[--z->n]);
            for (size_t i = start; i < z->n; i++) {
                z->next[i] = i + 1 < z->n ? i + 1 : start;
                z->prev[i] = i > start ? i - 1 : z->n - 1;
            }
            first = end;
        }
}

/* Sets z to the numerator of v over that denominator. */
static void over(mpz_t z, const mpq_t v, const mpz_t factor)
{
    mpz_divexact(z, factor, mpq_denref(v));
    mpz_mul(z, z, mpq_numref(v));
}

void oracle_load_even_odd(oracle *o, zset *z, const even_odd *set, const mpz_t factor)
{
    open_zset(z, set->n, set->members);
    for (; z->n < set->n; z->n++) {
        const even_odd_corner *c = &set->corner[z->n];
        zpoint *v = &z->v[z->n];
        zpoint_init(v);
        over(v->x, c->x, factor);
        over(v->y, c->y, factor);
        zpoint_set_small(o, v);
        z->next[z->n] = c->next;
        z->prev[z->n] = c->prev;
        z->member[z->n] = c->member;
    }
}

void oracle_unload(zset *z)
{
    for (size_t i = 0; i < z->n; i++) zpoint_clear(&z->v[i]);
    free(z->v);
    free(z->next);
    free(z->prev);
    free(z->member);
    free(z->triangle);
}

/* Is c on the open segment ab? */
static bool inside_segment(const oracle *o, const zpoint *a, const zpoint *b, const zpoint *c)
{
    if (oracle_orient(o, a, b, c) != 0) return false;
    const int s = zpoint_cmp(a, c), t = zpoint_cmp(c, b);
    return (s < 0 && t < 0) || (s > 0 && t > 0);
}

/* Do the open segments ab and cd cross in a point that is not an end of either? */
static bool cross(const oracle *o, const zpoint *a, const zpoint *b, const zpoint *c, const zpoint *d)
{
    return oracle_orient(o, a, b, c) * oracle_orient(o, a, b, d) < 0 &&
           oracle_orient(o, c, d, a) * oracle_orient(o, c, d, b) < 0;
}

/* Is the point (x, y) / k inside member m? It is not on an edge. By the even-odd rule along the ray to the right. */
static bool inside_member(const zset *z, size_t m, const mpz_t x, const mpz_t y, unsigned long k)
{
    bool in = false;
    mpz_t ay, by, d, t;
    mpz_inits(ay, by, d, t, NULL);
    for (size_t i = 0; i < z->n; i++) {
        if (z->member[i] != m) continue;
        const zpoint *a = &z->v[i], *b = &z->v[z->next[i]];
        mpz_mul_ui(ay, a->y, k);
        mpz_mul_ui(by, b->y, k);
        const bool up = mpz_cmp(ay, y) <= 0, vp = mpz_cmp(by, y) <= 0;
        if (up == vp) continue;
        /* The side on which the point is of the edge directed upwards: if it is left, the ray to the right meets the
         * edge. */
        mpz_sub(d, b->x, a->x);
        mpz_sub(t, y, ay);
        mpz_mul(d, d, t);
        mpz_mul_ui(t, a->x, k);
        mpz_sub(t, x, t);
        mpz_sub(ay, b->y, a->y);
        mpz_mul(t, t, ay);
        const int side = mpz_cmp(d, t); /* sign of cross(b - a, point - a) */
        if (up ? side > 0 : side < 0) in = !in;
    }
    mpz_clears(ay, by, d, t, NULL);
    return in;
}

typedef struct diagram {
    const oracle *o;
    const zset *z;
    size_t *at; /* one vertex for each place of the member */
    size_t n;
    bool *joined; /* [n * n] there is a segment */
} diagram;

/* Is the segment between places i and j unobstructed, with its midpoint inside? */
static bool admissible(const diagram *g, size_t m, size_t i, size_t j)
{
    const zpoint *a = &g->z->v[g->at[i]], *b = &g->z->v[g->at[j]];
    for (size_t k = 0; k < g->n; k++)
        if (k != i && k != j && inside_segment(g->o, a, b, &g->z->v[g->at[k]])) return false;
    for (size_t k = 0; k < g->n; k++)
        for (size_t l = k + 1; l < g->n; l++)
            if (g->joined[k * g->n + l] && cross(g->o, a, b, &g->z->v[g->at[k]], &g->z->v[g->at[l]])) return false;
    mpz_t x, y;
    mpz_inits(x, y, NULL);
    mpz_add(x, a->x, b->x);
    mpz_add(y, a->y, b->y);
    const bool in = inside_member(g->z, m, x, y, 2);
    mpz_clears(x, y, NULL);
    return in;
}

/* Are three joined places that turn left an empty triangle of the member? */
static bool is_face(const diagram *g, size_t m, const size_t t[3])
{
    const zpoint *a = &g->z->v[g->at[t[0]]], *b = &g->z->v[g->at[t[1]]], *c = &g->z->v[g->at[t[2]]];
    for (size_t k = 0; k < g->n; k++) {
        const zpoint *p = &g->z->v[g->at[k]];
        if (oracle_orient(g->o, a, b, p) > 0 && oracle_orient(g->o, b, c, p) > 0 && oracle_orient(g->o, c, a, p) > 0)
            return false;
    }
    mpz_t x, y;
    mpz_inits(x, y, NULL);
    mpz_add(x, a->x, b->x);
    mpz_add(x, x, c->x);
    mpz_add(y, a->y, b->y);
    mpz_add(y, y, c->y);
    const bool in = inside_member(g->z, m, x, y, 3);
    mpz_clears(x, y, NULL);
    return in;
}

/* Boundary edges cut at the places on them, then every diagonal that crosses no segment so far: a maximal set, so its
 * bounded faces inside the member are triangles. */
static void triangulate_member(const oracle *o, zset *z, size_t m)
{
    diagram g = {o, z, test_alloc(z->n, sizeof(size_t)), 0, NULL};
    size_t *place = test_alloc(z->n, sizeof *place);
    for (size_t i = 0; i < z->n; i++) {
        if (z->member[i] != m) continue;
        size_t k = 0;
        while (k < g.n && zpoint_cmp(&z->v[g.at[k]], &z->v[i])) k++;
        if (k == g.n) g.at[g.n++] = i;
        place[i] = k;
    }
    g.joined = test_alloc(g.n * g.n, sizeof *g.joined);
    for (size_t i = 0; i < g.n * g.n; i++) g.joined[i] = false;
#define JOIN(i, j) (g.joined[(i)*g.n + (j)] = g.joined[(j)*g.n + (i)] = true)
    for (size_t i = 0; i < z->n; i++) {
        if (z->member[i] != m) continue;
        const zpoint *a = &z->v[i], *b = &z->v[z->next[i]];
        /* Consecutive places on the edge, that is, without a third place between them. */
        for (size_t k = 0; k < g.n; k++)
            for (size_t l = k + 1; l < g.n; l++) {
                const zpoint *s = &z->v[g.at[k]], *t = &z->v[g.at[l]];
                const bool on_s = k == place[i] || k == place[z->next[i]] || inside_segment(o, a, b, s);
                const bool on_t = l == place[i] || l == place[z->next[i]] || inside_segment(o, a, b, t);
                if (!on_s || !on_t) continue;
                bool clear = true;
                for (size_t j = 0; j < g.n && clear; j++) clear = !inside_segment(o, s, t, &z->v[g.at[j]]);
                if (clear) JOIN(k, l);
            }
    }
    for (size_t i = 0; i < g.n; i++)
        for (size_t j = i + 1; j < g.n; j++)
            if (!g.joined[i * g.n + j] && admissible(&g, m, i, j)) JOIN(i, j);
#undef JOIN
    for (size_t i = 0; i < g.n; i++)
        for (size_t j = i + 1; j < g.n; j++)
            for (size_t k = i + 1; g.joined[i * g.n + j] && k < g.n; k++) {
                const size_t t[3] = {i, j, k};
                if (!g.joined[i * g.n + k] || !g.joined[j * g.n + k]) continue;
                if (oracle_orient(o, &z->v[g.at[i]], &z->v[g.at[j]], &z->v[g.at[k]]) <= 0 || !is_face(&g, m, t))
                    continue;
                z->triangle = test_resize(z->triangle, 3 * (z->triangles + 1), sizeof *z->triangle);
                for (int c = 0; c < 3; c++) z->triangle[3 * z->triangles + (size_t)c] = g.at[t[c]];
                z->triangles++;
            }
    free(g.at);
    free(g.joined);
    free(place);
}

void oracle_triangulate(const oracle *o, zset *z)
{
    for (size_t m = 0; m < z->members; m++) triangulate_member(o, z, m);
}
