/* The arrangement of the oracle: all segments, all crossings, and the uncovered parts.
 *
 * Which segments are needed? If x is a boundary point of O, P and x - Q touch without their interiors meeting. Let x
 * lie in the relative interior of edge e of P + vertex v of Q. Suppose that the corner of Q at v, reflected and placed
 * on e, extends strictly to the outer side of the line through e (it is reflex, or has a leg on the outer side). Then
 * the two interiors meet near that contact, and so they do at every point of the relative interior: all points of the
 * segment are covered. The other segments suffice. With all_segments the omitted ones are arranged, too, as a check. */
#include "oracle_inner.h"

#include <math.h>
#include <stdlib.h>

typedef struct zsegment {
    zpoint a, b; /* a < b lexicographically */
    double box[4];
    uint32_t *on;
    size_t on_n;
} zsegment;

typedef struct builder {
    const oracle *o;
    zsegment *segment;
    size_t segments;
    oracle_map *map;
    uint32_t *bucket; /* hash table over map->point, with open addressing */
    size_t buckets;
} builder;

/* ---- Segments ---- */

static int cross_sign(const zpoint *a, const zpoint *b, const zpoint *c, const zpoint *d)
{
    mpz_t u, v, s;
    mpz_inits(u, v, s, NULL);
    mpz_sub(u, b->x, a->x);
    mpz_sub(v, d->y, c->y);
    mpz_mul(s, u, v);
    mpz_sub(u, b->y, a->y);
    mpz_sub(v, d->x, c->x);
    mpz_submul(s, u, v);
    const int sign = mpz_sgn(s);
    mpz_clears(u, v, s, NULL);
    return sign;
}

/* Can edge i of e, added to vertex k of z, contain an uncovered point? The interior of both is on the left. */
static bool extreme(const oracle *o, const zset *e, size_t i, const zset *z, size_t k)
{
    const zpoint *a = &e->v[i], *b = &e->v[e->next[i]];
    const zpoint *v = &z->v[k], *u = &z->v[z->prev[k]], *w = &z->v[z->next[k]];
    if (oracle_orient(o, u, v, w) < 0) return false;
    return cross_sign(a, b, v, w) >= 0 && cross_sign(a, b, v, u) >= 0;
}

static void add_segment(builder *w, const zpoint *a, const zpoint *b, const zpoint *v)
{
    if ((w->segments & (w->segments - 1)) == 0)
        w->segment = test_resize(w->segment, w->segments ? 2 * w->segments : 1, sizeof *w->segment);
    zsegment *s = &w->segment[w->segments++];
    zpoint *end[2] = {&s->a, &s->b};
    const zpoint *from[2] = {a, b};
    if (zpoint_cmp(a, b) > 0) from[0] = b, from[1] = a;
    for (int i = 0; i < 2; i++) {
        zpoint_init(end[i]);
        mpz_add(end[i]->x, from[i]->x, v->x);
        mpz_add(end[i]->y, from[i]->y, v->y);
        zpoint_set_small(w->o, end[i]);
    }
    s->on = NULL;
    s->on_n = 0;
}

static void clear_segment(zsegment *s)
{
    zpoint_clear(&s->a);
    zpoint_clear(&s->b);
    free(s->on);
}

static void add_all(builder *w, const zset *e, const zset *z, bool all)
{
    for (size_t i = 0; i < e->n; i++)
        for (size_t k = 0; k < z->n; k++)
            if (all || extreme(w->o, e, i, z, k)) add_segment(w, &e->v[i], &e->v[e->next[i]], &z->v[k]);
}

static int segment_order(const void *l, const void *r)
{
    const zsegment *a = l, *b = r;
    const int c = zpoint_cmp(&a->a, &b->a);
    return c ? c : zpoint_cmp(&a->b, &b->b);
}

static void drop_equal_segments(builder *w)
{
    if (!w->segments) return;
    qsort(w->segment, w->segments, sizeof *w->segment, segment_order);
    size_t n = 1;
    for (size_t i = 1; i < w->segments; i++) {
        if (segment_order(&w->segment[n - 1], &w->segment[i]) == 0)
            clear_segment(&w->segment[i]);
        else
            w->segment[n++] = w->segment[i];
    }
    w->segments = n;
}

/* ---- Points ---- */

static size_t hash(const hpoint *p)
{
    uint64_t h = 1469598103934665603u;
    const mpz_srcptr part[3] = {p->x, p->y, p->w};
    for (int i = 0; i < 3; i++) {
        h = (h ^ (uint64_t)(mpz_sgn(part[i]) + 1)) * 1099511628211u;
        for (size_t k = 0; k < mpz_size(part[i]); k++) h = (h ^ mpz_getlimbn(part[i], (mp_size_t)k)) * 1099511628211u;
        h ^= h >> 29;
    }
    return (size_t)(h ^ h >> 32);
}

static bool same(const hpoint *a, const hpoint *b)
{
    return mpz_cmp(a->w, b->w) == 0 && mpz_cmp(a->x, b->x) == 0 && mpz_cmp(a->y, b->y) == 0;
}

static void rehash(builder *w)
{
    free(w->bucket);
    w->buckets = w->buckets ? 2 * w->buckets : 64;
    w->bucket = test_alloc(w->buckets, sizeof *w->bucket);
    for (size_t i = 0; i < w->buckets; i++) w->bucket[i] = UINT32_MAX;
    for (size_t i = 0; i < w->map->points; i++) {
        size_t k = hash(&w->map->point[i]) & (w->buckets - 1);
        while (w->bucket[k] != UINT32_MAX) k = (k + 1) & (w->buckets - 1);
        w->bucket[k] = (uint32_t)i;
    }
}

/* Returns the number of the point; takes ownership of p. */
static uint32_t point_number(builder *w, hpoint *p)
{
    hpoint_finish(w->o, p);
    if (2 * w->map->points >= w->buckets) rehash(w);
    size_t k = hash(p) & (w->buckets - 1);
    for (; w->bucket[k] != UINT32_MAX; k = (k + 1) & (w->buckets - 1))
        if (same(&w->map->point[w->bucket[k]], p)) {
            hpoint_clear(p);
            return w->bucket[k];
        }
    oracle_map *m = w->map;
    if ((m->points & (m->points - 1)) == 0)
        m->point = test_resize(m->point, m->points ? 2 * m->points : 1, sizeof *m->point);
    m->point[m->points] = *p;
    w->bucket[k] = (uint32_t)m->points;
    return (uint32_t)m->points++;
}

static uint32_t grid_point(builder *w, const zpoint *a)
{
    hpoint p;
    hpoint_init(&p);
    mpz_set(p.x, a->x);
    mpz_set(p.y, a->y);
    mpz_set_ui(p.w, 1);
    return point_number(w, &p);
}

static void put_on(zsegment *s, uint32_t point)
{
    if ((s->on_n & (s->on_n - 1)) == 0) s->on = test_resize(s->on, s->on_n ? 2 * s->on_n : 1, sizeof *s->on);
    s->on[s->on_n++] = point;
}

/* ---- Crossings ---- */

static uint32_t crossing(builder *w, const zsegment *s, const zsegment *t)
{
    /* a + (b - a) * n / d with d = (b - a) x (d' - c'), n = (c' - a) x (d' - c'). */
    mpz_t n, d, u, v;
    hpoint p;
    mpz_inits(n, d, u, v, NULL);
    hpoint_init(&p);
    mpz_sub(u, t->b.x, t->a.x);
    mpz_sub(v, t->b.y, t->a.y);
    mpz_sub(n, t->a.x, s->a.x);
    mpz_mul(p.x, n, v);
    mpz_sub(n, t->a.y, s->a.y);
    mpz_mul(p.y, n, u);
    mpz_sub(n, p.x, p.y);
    mpz_sub(p.x, s->b.x, s->a.x);
    mpz_sub(p.y, s->b.y, s->a.y);
    mpz_mul(d, p.x, v);
    mpz_submul(d, p.y, u);
    mpz_mul(p.x, p.x, n);
    mpz_addmul(p.x, s->a.x, d);
    mpz_mul(p.y, p.y, n);
    mpz_addmul(p.y, s->a.y, d);
    mpz_set(p.w, d);
    mpz_clears(n, d, u, v, NULL);
    return point_number(w, &p);
}

static bool between(const zpoint *p, const zsegment *s) { return zpoint_cmp(&s->a, p) < 0 && zpoint_cmp(p, &s->b) < 0; }

/* Adds to both s and t the points that they have in common: a crossing, ends of one inside the other. Common ends need
 * not be added. */
static void meet(builder *w, zsegment *s, zsegment *t)
{
    const oracle *o = w->o;
    const int sa = oracle_orient(o, &s->a, &s->b, &t->a), sb = oracle_orient(o, &s->a, &s->b, &t->b);
    if (sa * sb > 0) return;
    const int ta = oracle_orient(o, &t->a, &t->b, &s->a), tb = oracle_orient(o, &t->a, &t->b, &s->b);
    if (ta * tb > 0) return;
    if (sa * sb < 0 && ta * tb < 0) {
        const uint32_t p = crossing(w, s, t);
        put_on(s, p);
        put_on(t, p);
        return;
    }
    if (sa == 0 && between(&t->a, s)) put_on(s, t->on[0]);
    if (sb == 0 && between(&t->b, s)) put_on(s, t->on[1]);
    if (ta == 0 && between(&s->a, t)) put_on(t, s->on[0]);
    if (tb == 0 && between(&s->b, t)) put_on(t, s->on[1]);
}

static void box_of(zsegment *s, const oracle_map *m)
{
    const hpoint *a = &m->point[s->on[0]], *b = &m->point[s->on[1]];
    s->box[0] = fmin(a->ax, b->ax);
    s->box[1] = fmin(a->ay, b->ay);
    s->box[2] = fmax(a->ax, b->ax);
    s->box[3] = fmax(a->ay, b->ay);
    for (int i = 0; i < 4; i++) s->box[i] += (i < 2 ? -1 : 1) * (1e-13 * fabs(s->box[i]) + 1e-300);
}

static void all_crossings(builder *w)
{
    for (size_t i = 0; i < w->segments; i++) {
        put_on(&w->segment[i], grid_point(w, &w->segment[i].a));
        put_on(&w->segment[i], grid_point(w, &w->segment[i].b));
        box_of(&w->segment[i], w->map);
    }
    for (size_t i = 0; i < w->segments; i++)
        for (size_t j = i + 1; j < w->segments; j++) {
            const double *s = w->segment[i].box, *t = w->segment[j].box;
            if (s[0] <= t[2] && t[0] <= s[2] && s[1] <= t[3] && t[1] <= s[3]) meet(w, &w->segment[i], &w->segment[j]);
        }
}

/* ---- Pieces ---- */

typedef struct piece {
    uint32_t from, to; /* from < to lexicographically */
    uint32_t segment;
} piece;

static int piece_order(const void *l, const void *r)
{
    const piece *a = l, *b = r;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    return (a->to > b->to) - (a->to < b->to);
}

/* Sorts the points of one segment along it. Shell sort, since qsort() cannot pass the map to the comparison. */
static void sort_along(const oracle_map *m, uint32_t *on, size_t n)
{
    for (size_t gap = n / 2; gap; gap /= 2)
        for (size_t i = gap; i < n; i++) {
            const uint32_t p = on[i];
            size_t k = i;
            for (; k >= gap && hpoint_cmp(&m->point[p], &m->point[on[k - gap]]) < 0; k -= gap) on[k] = on[k - gap];
            on[k] = p;
        }
}

static piece *all_pieces(builder *w, size_t *count)
{
    size_t n = 0, room = 0;
    for (size_t i = 0; i < w->segments; i++) room += w->segment[i].on_n;
    piece *pieces = test_alloc(room, sizeof *pieces);
    for (size_t i = 0; i < w->segments; i++) {
        zsegment *s = &w->segment[i];
        sort_along(w->map, s->on, s->on_n);
        for (size_t k = 1; k < s->on_n; k++)
            if (s->on[k] != s->on[k - 1]) pieces[n++] = (piece){s->on[k - 1], s->on[k], (uint32_t)i};
    }
    if (n) qsort(pieces, n, sizeof *pieces, piece_order);
    size_t kept = 0;
    for (size_t i = 0; i < n; i++)
        if (kept == 0 || piece_order(&pieces[kept - 1], &pieces[i])) pieces[kept++] = pieces[i];
    *count = kept;
    return pieces;
}

static void middle(const oracle *o, hpoint *m, const hpoint *a, const hpoint *b)
{
    hpoint_init(m);
    mpz_mul(m->x, a->x, b->w);
    mpz_addmul(m->x, b->x, a->w);
    mpz_mul(m->y, a->y, b->w);
    mpz_addmul(m->y, b->y, a->w);
    mpz_mul(m->w, a->w, b->w);
    mpz_mul_2exp(m->w, m->w, 1);
    hpoint_finish(o, m);
}

static void add_edge(oracle_edge **edges, size_t *n, uint32_t from, uint32_t to, const zpoint *a, const zpoint *b)
{
    if ((*n & (*n - 1)) == 0) *edges = test_resize(*edges, *n ? 2 * *n : 1, sizeof **edges);
    oracle_edge *e = &(*edges)[(*n)++];
    e->from = from;
    e->to = to;
    zpoint_init(&e->along);
    mpz_sub(e->along.x, b->x, a->x);
    mpz_sub(e->along.y, b->y, a->y);
}

static void classify(builder *w, const piece *c, bool *free_end)
{
    oracle_map *m = w->map;
    const zsegment *s = &w->segment[c->segment];
    hpoint mid;
    middle(w->o, &mid, &m->point[c->from], &m->point[c->to]);
    if (!oracle_covered(w->o, &mid, NULL)) {
        zpoint left, right;
        zpoint_init(&left);
        zpoint_init(&right);
        mpz_sub(left.x, s->a.y, s->b.y);
        mpz_sub(left.y, s->b.x, s->a.x);
        mpz_neg(right.x, left.x);
        mpz_neg(right.y, left.y);
        const bool l = oracle_covered(w->o, &mid, &left), r = oracle_covered(w->o, &mid, &right);
        zpoint_clear(&left);
        zpoint_clear(&right);
        if (l && r)
            add_edge(&m->thin, &m->thins, c->from, c->to, &s->a, &s->b);
        else if (l)
            add_edge(&m->boundary, &m->boundaries, c->from, c->to, &s->a, &s->b);
        else if (r)
            add_edge(&m->boundary, &m->boundaries, c->to, c->from, &s->b, &s->a);
        free_end[c->from] = free_end[c->to] = true;
    }
    hpoint_clear(&mid);
}

void oracle_map_build(const oracle *o, bool all_segments, oracle_map *map)
{
    *map = (oracle_map){0};
    builder w = {o, NULL, 0, map, NULL, 0};
    add_all(&w, &o->p, &o->q, all_segments);
    add_all(&w, &o->q, &o->p, all_segments);
    drop_equal_segments(&w);
    all_crossings(&w);
    size_t pieces;
    piece *c = all_pieces(&w, &pieces);
    bool *free_end = test_alloc(map->points, sizeof *free_end);
    for (size_t i = 0; i < map->points; i++) free_end[i] = false;
    for (size_t i = 0; i < pieces; i++) classify(&w, &c[i], free_end);
    /* If all pieces at a point are covered, so are all of its sides. */
    map->lone = test_alloc(map->points, sizeof *map->lone);
    for (size_t i = 0; i < map->points; i++)
        if (!free_end[i] && !oracle_covered(o, &map->point[i], NULL)) map->lone[map->lones++] = (uint32_t)i;
    free(free_end);
    free(c);
    for (size_t i = 0; i < w.segments; i++) clear_segment(&w.segment[i]);
    free(w.segment);
    free(w.bucket);
}

void oracle_map_free(oracle_map *map)
{
    for (size_t i = 0; i < map->points; i++) hpoint_clear(&map->point[i]);
    for (size_t i = 0; i < map->boundaries; i++) zpoint_clear(&map->boundary[i].along);
    for (size_t i = 0; i < map->thins; i++) zpoint_clear(&map->thin[i].along);
    free(map->point);
    free(map->boundary);
    free(map->thin);
    free(map->lone);
}
