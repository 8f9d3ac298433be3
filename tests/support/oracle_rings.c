/* Canonical rings, segments and points of the oracle, as text.
 *
 * Components first. Boundary pieces are followed so that the next one bounds the same covered sector. This gives the
 * closed walks that bound each connected component C of the interior of the sum; one of them is positive (the outer),
 * the others are negative. Each negative one belongs to the smallest positive one that winds around it. Then rings:
 * among the pieces of one C the next piece is the first of C counter-clockwise from the direction of arrival, so that a
 * ring goes round one component of the plane minus cl C. */
#include "oracle_inner.h"

#include <stdlib.h>
#include <string.h>

typedef struct ring {
    uint32_t *v;
    size_t n;
    int sign;
} ring;

typedef struct canon {
    const oracle *o;
    const oracle_map *m;
    size_t *first; /* [points + 1] out-going boundary pieces of each point, in out[] */
    size_t *out;
    size_t *walk;      /* [boundaries] number of the walk */
    size_t *component; /* [walks] */
    mpq_t *area;       /* [walks] */
    size_t walks;
} canon;

/* ---- Directions ---- */

static int cross_vectors(const zpoint *a, const zpoint *b)
{
    mpz_t s;
    mpz_init(s);
    mpz_mul(s, a->x, b->y);
    mpz_submul(s, a->y, b->x);
    const int sign = mpz_sgn(s);
    mpz_clear(s);
    return sign;
}

static int dot_vectors(const zpoint *a, const zpoint *b)
{
    mpz_t s;
    mpz_init(s);
    mpz_mul(s, a->x, b->x);
    mpz_addmul(s, a->y, b->y);
    const int sign = mpz_sgn(s);
    mpz_clear(s);
    return sign;
}

/* The quadrant of the angle from r to a: 0 in (0, pi), 1 at pi, 2 in (pi, 2 pi), 3 at 2 pi. */
static int turn_class(const zpoint *r, const zpoint *a, int sense)
{
    const int c = sense * cross_vectors(r, a);
    if (c) return c > 0 ? 0 : 2;
    return dot_vectors(r, a) < 0 ? 1 : 3;
}

/* Is a met before b when turning from r in the given sense (+1 counter-clockwise)? */
static bool sooner(const zpoint *r, const zpoint *a, const zpoint *b, int sense)
{
    const int ca = turn_class(r, a, sense), cb = turn_class(r, b, sense);
    if (ca != cb) return ca < cb;
    return sense * cross_vectors(a, b) > 0;
}

/* The piece that follows e: the first outgoing one at its end, turning from the way back in the given sense; only
 * pieces of component c unless c is SIZE_MAX. */
static size_t follow(const canon *k, size_t e, int sense, size_t c)
{
    const uint32_t v = k->m->boundary[e].to;
    const zpoint *d = &k->m->boundary[e].along;
    zpoint back;
    zpoint_init(&back);
    mpz_neg(back.x, d->x);
    mpz_neg(back.y, d->y);
    size_t best = SIZE_MAX;
    for (size_t i = k->first[v]; i < k->first[v + 1]; i++) {
        const size_t f = k->out[i];
        if (c != SIZE_MAX && k->component[k->walk[f]] != c) continue;
        if (best == SIZE_MAX || sooner(&back, &k->m->boundary[f].along, &k->m->boundary[best].along, sense)) best = f;
    }
    zpoint_clear(&back);
    if (best == SIZE_MAX) abort();
    return best;
}

/* ---- Walks and components ---- */

static void coordinate(mpq_t r, const mpz_t num, const mpz_t den)
{
    mpz_set(mpq_numref(r), num);
    mpz_set(mpq_denref(r), den);
    mpq_canonicalize(r);
}

static void add_cross(mpq_t sum, const hpoint *a, const hpoint *b)
{
    mpq_t t;
    mpz_t n, d;
    mpq_init(t);
    mpz_inits(n, d, NULL);
    mpz_mul(n, a->x, b->y);
    mpz_submul(n, a->y, b->x);
    mpz_mul(d, a->w, b->w);
    coordinate(t, n, d);
    mpq_add(sum, sum, t);
    mpq_clear(t);
    mpz_clears(n, d, NULL);
}

static void index_pieces(canon *k)
{
    const oracle_map *m = k->m;
    k->first = test_alloc(m->points + 2, sizeof *k->first);
    k->out = test_alloc(m->boundaries, sizeof *k->out);
    memset(k->first, 0, (m->points + 2) * sizeof *k->first);
    for (size_t e = 0; e < m->boundaries; e++) k->first[m->boundary[e].from + 2]++;
    for (size_t v = 2; v < m->points + 2; v++) k->first[v] += k->first[v - 1];
    for (size_t e = 0; e < m->boundaries; e++) k->out[k->first[m->boundary[e].from + 1]++] = e;
}

static void trace_walks(canon *k)
{
    const oracle_map *m = k->m;
    k->walk = test_alloc(m->boundaries, sizeof *k->walk);
    k->area = NULL;
    k->walks = 0;
    for (size_t e = 0; e < m->boundaries; e++) k->walk[e] = SIZE_MAX;
    for (size_t e = 0; e < m->boundaries; e++) {
        if (k->walk[e] != SIZE_MAX) continue;
        k->area = test_resize(k->area, k->walks + 1, sizeof *k->area);
        mpq_init(k->area[k->walks]);
        size_t f = e;
        do {
            k->walk[f] = k->walks;
            add_cross(k->area[k->walks], &m->point[m->boundary[f].from], &m->point[m->boundary[f].to]);
            f = follow(k, f, -1, SIZE_MAX);
        } while (f != e);
        k->walks++;
    }
}

/* Does walk w wind around the midpoint of piece e, which belongs to another walk? Counts signed crossings of the ray to
 * the right. */
static bool winds_around(const canon *k, size_t w, size_t e)
{
    const oracle_map *m = k->m;
    mpq_t x, y, ax, ay, bx, by;
    long winding = 0;
    mpq_inits(x, y, ax, ay, bx, by, NULL);
    const hpoint *s = &m->point[m->boundary[e].from], *t = &m->point[m->boundary[e].to];
    coordinate(ax, s->x, s->w);
    coordinate(bx, t->x, t->w);
    mpq_add(x, ax, bx);
    mpq_div_2exp(x, x, 1);
    coordinate(ay, s->y, s->w);
    coordinate(by, t->y, t->w);
    mpq_add(y, ay, by);
    mpq_div_2exp(y, y, 1);
    for (size_t f = 0; f < m->boundaries; f++) {
        if (k->walk[f] != w) continue;
        const hpoint *a = &m->point[m->boundary[f].from], *b = &m->point[m->boundary[f].to];
        coordinate(ay, a->y, a->w);
        coordinate(by, b->y, b->w);
        const bool up = mpq_cmp(ay, y) <= 0, vp = mpq_cmp(by, y) <= 0;
        if (up == vp) continue;
        coordinate(ax, a->x, a->w);
        coordinate(bx, b->x, b->w);
        mpq_sub(bx, bx, ax);
        mpq_sub(by, by, ay);
        mpq_sub(ax, x, ax);
        mpq_sub(ay, y, ay);
        mpq_mul(bx, bx, ay);
        mpq_mul(by, by, ax);
        const int side = mpq_cmp(bx, by);
        if (up && side > 0) winding++;
        if (!up && side < 0) winding--;
    }
    mpq_clears(x, y, ax, ay, bx, by, NULL);
    return winding != 0;
}

static void find_components(canon *k)
{
    k->component = test_alloc(k->walks, sizeof *k->component);
    for (size_t w = 0; w < k->walks; w++) {
        k->component[w] = w;
        if (mpq_sgn(k->area[w]) > 0) continue;
        size_t e = 0, best = SIZE_MAX;
        while (k->walk[e] != w) e++;
        for (size_t u = 0; u < k->walks; u++) {
            if (mpq_sgn(k->area[u]) <= 0 || (best != SIZE_MAX && mpq_cmp(k->area[u], k->area[best]) >= 0)) continue;
            if (winds_around(k, u, e)) best = u;
        }
        if (best == SIZE_MAX) abort();
        k->component[w] = best;
    }
}

/* ---- Rings ---- */

static int ring_cmp(const oracle_map *m, const ring *a, const ring *b)
{
    for (size_t i = 0; i < a->n && i < b->n; i++) {
        const int c = hpoint_cmp(&m->point[a->v[i]], &m->point[b->v[i]]);
        if (c) return c;
    }
    return (a->n > b->n) - (a->n < b->n);
}

/* The ring through piece e, whose pieces are marked as done: only the corners, from the smallest on. */
static ring trace_ring(const canon *k, size_t e, bool *done)
{
    const oracle_map *m = k->m;
    ring r = {NULL, 0, 0};
    mpq_t area;
    mpq_init(area);
    size_t f = e;
    do {
        done[f] = true;
        const size_t g = follow(k, f, 1, k->component[k->walk[f]]);
        add_cross(area, &m->point[m->boundary[f].from], &m->point[m->boundary[f].to]);
        if (cross_vectors(&m->boundary[f].along, &m->boundary[g].along) != 0) {
            r.v = test_resize(r.v, r.n + 1, sizeof *r.v);
            r.v[r.n++] = m->boundary[f].to;
        }
        f = g;
    } while (f != e);
    r.sign = mpq_sgn(area);
    mpq_clear(area);
    size_t low = 0;
    for (size_t i = 1; i < r.n; i++)
        if (hpoint_cmp(&m->point[r.v[i]], &m->point[r.v[low]]) < 0) low = i;
    uint32_t *v = test_alloc(r.n, sizeof *v);
    for (size_t i = 0; i < r.n; i++) v[i] = r.v[(low + i) % r.n];
    free(r.v);
    r.v = v;
    return r;
}

/* Insertion sort, since there are few. */
static void insert_ring(const oracle_map *m, ring **rings, size_t *n, ring r)
{
    *rings = test_resize(*rings, *n + 1, sizeof **rings);
    size_t i = (*n)++;
    for (; i > 0 && ring_cmp(m, &r, &(*rings)[i - 1]) < 0; i--) (*rings)[i] = (*rings)[i - 1];
    (*rings)[i] = r;
}

/* ---- Text ---- */

static void put_number(const oracle *o, FILE *f, const mpz_t num, const mpz_t den)
{
    mpq_t r;
    mpq_init(r);
    coordinate(r, num, den);
    mpq_mul(r, r, o->unit);
    char *text = mpq_get_str(NULL, 10, r);
    fprintf(f, "\"%s\"", text);
    free(text);
    mpq_clear(r);
}

static void put_point(const canon *k, FILE *f, uint32_t v)
{
    const hpoint *p = &k->m->point[v];
    fputc('[', f);
    put_number(k->o, f, p->x, p->w);
    fputs(", ", f);
    put_number(k->o, f, p->y, p->w);
    fputc(']', f);
}

static void put_ring(const canon *k, FILE *f, const ring *r)
{
    fputc('[', f);
    for (size_t i = 0; i < r->n; i++) {
        if (i) fputs(", ", f);
        put_point(k, f, r->v[i]);
    }
    fputc(']', f);
}

typedef struct polygon {
    ring outer;
    ring *hole;
    size_t holes;
} polygon;

static polygon take_polygon(const canon *k, size_t component, bool *done)
{
    polygon p = {{NULL, 0, 0}, NULL, 0};
    for (size_t e = 0; e < k->m->boundaries; e++) {
        if (done[e] || k->component[k->walk[e]] != component) continue;
        const ring r = trace_ring(k, e, done);
        if (r.sign > 0) {
            if (p.outer.v) abort(); /* a component has one outer ring */
            p.outer = r;
        } else {
            insert_ring(k->m, &p.hole, &p.holes, r);
        }
    }
    return p;
}

static void put_polygons(const canon *k, FILE *f)
{
    polygon *all = NULL;
    size_t n = 0;
    bool *done = test_alloc(k->m->boundaries, sizeof *done);
    memset(done, 0, k->m->boundaries * sizeof *done);
    for (size_t w = 0; w < k->walks; w++) {
        if (k->component[w] != w) continue;
        const polygon p = take_polygon(k, w, done);
        all = test_resize(all, n + 1, sizeof *all);
        size_t i = n++;
        for (; i > 0 && ring_cmp(k->m, &p.outer, &all[i - 1].outer) < 0; i--) all[i] = all[i - 1];
        all[i] = p;
    }
    for (size_t i = 0; i < n; i++) {
        fputs(i ? ", {\"outer\": " : "{\"outer\": ", f);
        put_ring(k, f, &all[i].outer);
        fputs(", \"holes\": [", f);
        for (size_t h = 0; h < all[i].holes; h++) {
            if (h) fputs(", ", f);
            put_ring(k, f, &all[i].hole[h]);
            free(all[i].hole[h].v);
        }
        fputs("]}", f);
        free(all[i].outer.v);
        free(all[i].hole);
    }
    free(all);
    free(done);
}

/* Collinear pieces of degenerate segments are joined until nothing changes. */
static void put_segments(const canon *k, FILE *f)
{
    const oracle_map *m = k->m;
    ring *s = NULL;
    size_t n = 0;
    bool *gone = test_alloc(m->thins, sizeof *gone);
    memset(gone, 0, m->thins * sizeof *gone);
    for (size_t i = 0; i < m->thins; i++) {
        if (gone[i]) continue;
        uint32_t end[2] = {m->thin[i].from, m->thin[i].to};
        gone[i] = true;
        for (size_t j = 0; j < m->thins;) {
            const oracle_edge *t = &m->thin[j];
            const bool after = t->from == end[1], before = t->to == end[0];
            if (gone[j] || !(after || before) || cross_vectors(&t->along, &m->thin[i].along)) {
                j++;
                continue;
            }
            if (after) end[1] = t->to;
            if (before) end[0] = t->from;
            gone[j] = true;
            j = 0;
        }
        ring r = {test_alloc(2, sizeof *r.v), 2, 0};
        memcpy(r.v, end, sizeof end);
        insert_ring(m, &s, &n, r);
    }
    for (size_t i = 0; i < n; i++) {
        if (i) fputs(", ", f);
        put_ring(k, f, &s[i]);
        free(s[i].v);
    }
    free(s);
    free(gone);
}

static void put_lone_points(const canon *k, FILE *f)
{
    ring *s = NULL;
    size_t n = 0;
    for (size_t i = 0; i < k->m->lones; i++) {
        ring r = {test_alloc(1, sizeof *r.v), 1, 0};
        r.v[0] = k->m->lone[i];
        insert_ring(k->m, &s, &n, r);
    }
    for (size_t i = 0; i < n; i++) {
        if (i) fputs(", ", f);
        put_point(k, f, s[i].v[0]);
        free(s[i].v);
    }
    free(s);
}

char *oracle_map_text(const oracle *o, const oracle_map *map)
{
    canon k = {.o = o, .m = map};
    char *text = NULL;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    if (!f) abort();
    index_pieces(&k);
    trace_walks(&k);
    find_components(&k);
    fputs("{\"polygons\": [", f);
    put_polygons(&k, f);
    fputs("], \"degenerate_segments\": [", f);
    put_segments(&k, f);
    fputs("], \"degenerate_points\": [", f);
    put_lone_points(&k, f);
    fputs("]}", f);
    fclose(f);
    for (size_t w = 0; w < k.walks; w++) mpq_clear(k.area[w]);
    free(k.area);
    free(k.component);
    free(k.walk);
    free(k.first);
    free(k.out);
    return text;
}
