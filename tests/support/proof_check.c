#include "proof_check.h"

#include <gmp.h>
#include <stdlib.h>
#include <string.h>

typedef struct vec {
    mpq_t x, y;
} vec;

typedef struct hull {
    vec *v; /* counter-clockwise, strictly convex */
    size_t n;
} hull;

typedef struct checking {
    const proof_feature *feature;
    size_t n, conflict;
    double gap;
    const sunder_report *report;
    const sunder_conflict *listed;
    size_t listed_n;
    const sunder_proof *proof;
    size_t *path_node, *path_way; /* on the way from the root */
    bool *seen;
} checking;

/* ---- Vectors -------------------------------------------------------------------------------------------------------
 */

static void vec_init(vec *v) { mpq_inits(v->x, v->y, NULL); }
static void vec_clear(vec *v) { mpq_clears(v->x, v->y, NULL); }

static void vec_set_d(vec *v, const double *xy)
{
    mpq_set_d(v->x, xy[0]);
    mpq_set_d(v->y, xy[1]);
}

static void vec_sub(vec *r, const vec *p, const vec *q)
{
    mpq_sub(r->x, p->x, q->x);
    mpq_sub(r->y, p->y, q->y);
}

static void dot(mpq_t r, const vec *p, const vec *q)
{
    mpq_t other;
    mpq_init(other);
    mpq_mul(other, p->y, q->y);
    mpq_mul(r, p->x, q->x);
    mpq_add(r, r, other);
    mpq_clear(other);
}

static void cross(mpq_t r, const vec *p, const vec *q)
{
    mpq_t other;
    mpq_init(other);
    mpq_mul(other, p->y, q->x);
    mpq_mul(r, p->x, q->y);
    mpq_sub(r, r, other);
    mpq_clear(other);
}

static int side(const vec *p, const vec *q, const vec *r)
{
    vec a, b;
    mpq_t c;
    vec_init(&a), vec_init(&b), mpq_init(c);
    vec_sub(&a, q, p);
    vec_sub(&b, r, p);
    cross(c, &a, &b);
    const int sign = mpq_sgn(c);
    vec_clear(&a), vec_clear(&b), mpq_clear(c);
    return sign;
}

/* ---- Convex polygons -----------------------------------------------------------------------------------------------
 */

static hull hull_new(size_t n)
{
    hull h = {malloc(n * sizeof *h.v), n};
    for (size_t k = 0; k < n; k++) vec_init(&h.v[k]);
    return h;
}

static void hull_free(hull *h, size_t n)
{
    for (size_t k = 0; k < n; k++) vec_clear(&h->v[k]);
    free(h->v);
}

static int by_place(const void *a, const void *b)
{
    const vec *p = a, *q = b;
    const int c = mpq_cmp(p->x, q->x);
    return c ? c : mpq_cmp(p->y, q->y);
}

/* All differences of a corner of a and one of b, and their convex hull: Andrew's monotone chain. *room: how many
 * vectors there are to clear. */
static hull difference(const double *a, size_t na, const double *b, size_t nb, size_t *room)
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
    *room = out.n;
    size_t m = 0;
    for (int pass = 0; pass < 2; pass++) {
        const size_t bottom = m;
        for (size_t k = 0; k < all.n; k++) {
            const vec *c = &all.v[pass ? all.n - 1 - k : k];
            while (m >= bottom + 2 && side(&out.v[m - 2], &out.v[m - 1], c) <= 0) m--;
            mpq_set(out.v[m].x, c->x);
            mpq_set(out.v[m++].y, c->y);
        }
        m--;
    }
    hull_free(&all, na * nb);
    out.n = m;
    return out;
}

/* The squared distance of p from the closed polygon; the polygon may be a segment or a point. */
static void square_from(mpq_t best, const hull *h, const vec *p)
{
    bool inside = h->n > 2;
    for (size_t k = 0; k < h->n && inside; k++) inside = side(&h->v[k], &h->v[(k + 1) % h->n], p) >= 0;
    mpq_set_si(best, inside ? 0 : -1, 1);
    vec e, w;
    mpq_t along, whole, d;
    vec_init(&e), vec_init(&w), mpq_inits(along, whole, d, NULL);
    for (size_t k = 0; k < h->n && !inside; k++) {
        vec_sub(&e, &h->v[(k + 1) % h->n], &h->v[k]);
        vec_sub(&w, p, &h->v[k]);
        dot(along, &e, &w);
        dot(whole, &e, &e);
        if (mpq_sgn(along) > 0 && mpq_cmp(along, whole) < 0) {
            cross(d, &e, &w);
            mpq_mul(d, d, d);
            mpq_div(d, d, whole);
        } else {
            if (mpq_sgn(along) > 0) vec_sub(&w, p, &h->v[(k + 1) % h->n]);
            dot(d, &w, &w);
        }
        if (mpq_sgn(best) < 0 || mpq_cmp(d, best) < 0) mpq_set(best, d);
    }
    vec_clear(&e), vec_clear(&w), mpq_clears(along, whole, d, NULL);
}

/* Does the disc of radius s round p lie in the polygon? */
static bool holds_disc(const hull *h, const vec *p, double s)
{
    bool holds = true;
    vec e, w;
    mpq_t room, whole, square;
    vec_init(&e), vec_init(&w), mpq_inits(room, whole, square, NULL);
    for (size_t k = 0; k < h->n && holds; k++) {
        vec_sub(&e, &h->v[(k + 1) % h->n], &h->v[k]);
        vec_sub(&w, p, &h->v[k]);
        cross(room, &e, &w);
        dot(whole, &e, &e);
        mpq_set_d(square, s);
        mpq_mul(square, square, square);
        mpq_mul(whole, whole, square);
        holds = mpq_sgn(room) >= 0;
        mpq_mul(room, room, room);
        holds = holds && mpq_cmp(room, whole) >= 0;
    }
    vec_clear(&e), vec_clear(&w), mpq_clears(room, whole, square, NULL);
    return holds;
}

/* ---- Parts ---------------------------------------------------------------------------------------------------------
 */

static bool is_convex(const double *xy, size_t n)
{
    vec p[3];
    bool convex = n > 2;
    for (int k = 0; k < 3; k++) vec_init(&p[k]);
    /* Every other corner is on the left of every side: once round, not twice. */
    for (size_t k = 0; k < n && convex; k++)
        for (size_t m = 0; m < n && convex; m++) {
            const size_t next = (k + 1) % n;
            if (m == k || m == next) continue;
            vec_set_d(&p[0], xy + 2 * k);
            vec_set_d(&p[1], xy + 2 * next);
            vec_set_d(&p[2], xy + 2 * m);
            convex = side(&p[0], &p[1], &p[2]) > 0;
        }
    for (int k = 0; k < 3; k++) vec_clear(&p[k]);
    return convex;
}

/* Does the segment run through the interior of the convex polygon? By its part on the left of all sides. */
static bool enters(const double *p, const double *q, const double *xy, size_t n)
{
    mpq_t low, high, sp, sq, cut;
    vec a, b, e, w;
    mpq_inits(low, high, sp, sq, cut, NULL);
    vec_init(&a), vec_init(&b), vec_init(&e), vec_init(&w);
    mpq_set_ui(high, 1, 1);
    bool in = true;
    for (size_t k = 0; k < n && in; k++) {
        vec_set_d(&a, xy + 2 * k);
        vec_set_d(&b, xy + 2 * ((k + 1) % n));
        vec_sub(&e, &b, &a);
        vec_set_d(&b, p);
        vec_sub(&w, &b, &a);
        cross(sp, &e, &w);
        vec_set_d(&b, q);
        vec_sub(&w, &b, &a);
        cross(sq, &e, &w);
        if (mpq_sgn(sp) <= 0 && mpq_sgn(sq) <= 0) in = false;
        if (!in || mpq_equal(sp, sq)) continue;
        mpq_sub(cut, sp, sq);
        mpq_div(cut, sp, cut); /* where it passes the side's line */
        if (mpq_cmp(sp, sq) < 0 ? mpq_cmp(cut, low) > 0 : mpq_cmp(cut, high) < 0)
            mpq_set(mpq_cmp(sp, sq) < 0 ? low : high, cut);
    }
    in = in && mpq_cmp(low, high) < 0;
    mpq_clears(low, high, sp, sq, cut, NULL);
    vec_clear(&a), vec_clear(&b), vec_clear(&e), vec_clear(&w);
    return in;
}

/* Is the middle of the part's first three corners in the polygon? By a ray to the right. */
static bool holds_middle(const proof_feature *f, const double *part)
{
    vec m, p, q;
    bool in = false;
    mpq_t third;
    vec_init(&m), vec_init(&p), vec_init(&q), mpq_init(third);
    for (int k = 0; k < 3; k++) {
        vec_set_d(&p, part + 2 * k);
        mpq_add(m.x, m.x, p.x);
        mpq_add(m.y, m.y, p.y);
    }
    mpq_set_ui(third, 1, 3);
    mpq_mul(m.x, m.x, third);
    mpq_mul(m.y, m.y, third);
    for (size_t k = 0; k < f->corners; k++) {
        vec_set_d(&p, f->xy + 2 * k);
        vec_set_d(&q, f->xy + 2 * ((k + 1) % f->corners));
        const bool up = mpq_cmp(p.y, m.y) > 0, uq = mpq_cmp(q.y, m.y) > 0;
        if (up != uq && side(&p, &q, &m) * (uq ? 1 : -1) > 0) in = !in;
    }
    vec_clear(&m), vec_clear(&p), vec_clear(&q), mpq_clear(third);
    return in;
}

static bool lies_in(const double *part, size_t n, const proof_feature *f)
{
    for (size_t k = 0; k < f->corners; k++)
        if (enters(f->xy + 2 * k, f->xy + 2 * ((k + 1) % f->corners), part, n)) return false;
    return holds_middle(f, part);
}

/* ---- Ways ----------------------------------------------------------------------------------------------------------
 */

/* Is there a direction in which none of the ways is ever reached? If so, one along a way's line. */
static bool is_open(const sunder_proof_way *way, size_t n)
{
    vec w, m;
    mpq_t d;
    bool open = false;
    vec_init(&w), vec_init(&m), mpq_init(d);
    for (size_t k = 0; k < n && !open; k++)
        for (int turn = -1; turn < 2 && !open; turn += 2) {
            const double along[2] = {-turn * way[k].n[1], turn * way[k].n[0]};
            vec_set_d(&w, along);
            open = true;
            for (size_t m_at = 0; m_at < n && open; m_at++) {
                vec_set_d(&m, way[m_at].n);
                dot(d, &m, &w);
                open = mpq_sgn(d) <= 0;
            }
        }
    vec_clear(&w), vec_clear(&m), mpq_clear(d);
    return open;
}

/* Where two ways' lines cross; false if nowhere. */
static bool crossing(const sunder_proof_way *a, const sunder_proof_way *b, vec *v)
{
    vec m, n;
    mpq_t det, d, e, f;
    vec_init(&m), vec_init(&n), mpq_inits(det, d, e, f, NULL);
    vec_set_d(&m, a->n);
    vec_set_d(&n, b->n);
    cross(det, &m, &n);
    const bool any = mpq_sgn(det) != 0;
    if (any) {
        mpq_set_d(d, a->d);
        mpq_set_d(e, b->d);
        mpq_mul(v->x, d, n.y);
        mpq_mul(f, e, m.y);
        mpq_sub(v->x, v->x, f);
        mpq_div(v->x, v->x, det);
        mpq_mul(v->y, e, m.x);
        mpq_mul(f, d, n.x);
        mpq_sub(v->y, v->y, f);
        mpq_div(v->y, v->y, det);
    }
    vec_clear(&m), vec_clear(&n), mpq_clears(det, d, e, f, NULL);
    return any;
}

static bool is_behind_all(const sunder_proof_way *way, size_t n, const vec *v)
{
    vec m;
    mpq_t s, d;
    bool behind = true;
    vec_init(&m), mpq_inits(s, d, NULL);
    for (size_t k = 0; k < n && behind; k++) {
        vec_set_d(&m, way[k].n);
        mpq_set_d(d, way[k].d);
        dot(s, &m, v);
        behind = mpq_cmp(s, d) <= 0;
    }
    vec_clear(&m), mpq_clears(s, d, NULL);
    return behind;
}

/* What lies behind all the ways, an open convex polygon, must be in conflict: its corners within the clearance of the
 * parts' difference or, for a negative one, deeper in it than that. */
static const char *check_ways(const checking *c, const sunder_proof_node *node)
{
    const sunder_proof *p = c->proof;
    const sunder_proof_way *way = p->way + node->way;
    if (is_open(way, node->ways)) return "the ways leave a direction out";
    size_t room;
    const double *a = p->corner + 2 * node->part_a, *b = p->corner + 2 * node->part_b;
    hull k = difference(a, node->corners_a, b, node->corners_b, &room);
    const char *wrong = NULL;
    vec v;
    mpq_t d, most;
    vec_init(&v), mpq_inits(d, most, NULL);
    mpq_set_d(most, node->clearance);
    mpq_mul(most, most, most);
    for (size_t i = 0; i < node->ways && !wrong; i++)
        for (size_t j = i + 1; j < node->ways && !wrong; j++) {
            if (!crossing(&way[i], &way[j], &v) || !is_behind_all(way, node->ways, &v)) continue;
            if (node->clearance < 0) {
                if (!holds_disc(&k, &v, node->clearance)) wrong = "a move that is no worse has no way";
                continue;
            }
            square_from(d, &k, &v);
            if (mpq_cmp(d, most) > 0) wrong = "a move that keeps the clearance has no way";
        }
    vec_clear(&v), mpq_clears(d, most, NULL);
    hull_free(&k, room);
    return wrong;
}

/* ---- What is owed --------------------------------------------------------------------------------------------------
 */

static const sunder_conflict *find_listed(const checking *c, size_t a, size_t b)
{
    for (size_t k = 0; k < c->listed_n; k++)
        if ((c->listed[k].a == a && c->listed[k].b == b) || (c->listed[k].a == b && c->listed[k].b == a))
            return &c->listed[k];
    return NULL;
}

/* Two convex features: may they be held to the clearance, as they stood? */
static bool stood_so(const proof_feature *a, const proof_feature *b, double clearance)
{
    size_t room;
    hull k = difference(a->xy, a->corners, b->xy, b->corners, &room);
    vec origin;
    mpq_t d, square, s, whole;
    vec e, w;
    vec_init(&origin), vec_init(&e), vec_init(&w), mpq_inits(d, square, s, whole, NULL);
    mpq_set_d(square, clearance);
    mpq_mul(square, square, square);
    square_from(d, &k, &origin);
    /* Disjoint, or touching: the distance. Else the least way out, which must not be longer. */
    bool so = mpq_sgn(d) > 0 ? clearance <= 0 || mpq_cmp(square, d) <= 0 : false;
    for (size_t i = 0; i < k.n && mpq_sgn(d) == 0 && !so && clearance <= 0; i++) {
        vec_sub(&e, &k.v[(i + 1) % k.n], &k.v[i]);
        vec_sub(&w, &origin, &k.v[i]);
        cross(s, &e, &w);
        mpq_mul(s, s, s);
        dot(whole, &e, &e);
        mpq_mul(whole, whole, square);
        so = mpq_cmp(s, whole) <= 0;
    }
    vec_clear(&origin), vec_clear(&e), vec_clear(&w), mpq_clears(d, square, s, whole, NULL);
    hull_free(&k, room);
    return so;
}

static const char *check_clearance(const checking *c, const sunder_proof_node *node)
{
    const sunder_conflict *own = &c->listed[c->conflict], *listed = find_listed(c, node->a, node->b);
    if (!listed || listed == own) return node->clearance <= c->gap ? NULL : "more than the gap is asked for";
    const proof_feature *a = &c->feature[node->a], *b = &c->feature[node->b];
    const bool convex_a = is_convex(a->xy, a->corners), convex_b = is_convex(b->xy, b->corners);
    if ((convex_a && lies_in(a->xy, a->corners, b)) || (convex_b && lies_in(b->xy, b->corners, a)))
        return "what is contained may stay so";
    if (!convex_a || !convex_b) return NULL; /* the least way out is then for others to tell */
    return stood_so(a, b, node->clearance) ? NULL : "a listed pair is held to more than it had";
}

/* ---- Leaves --------------------------------------------------------------------------------------------------------
 */

static bool same_block(const checking *c, size_t a, size_t b)
{
    return a == b || (sunder_report_block(c->report, a) >= 0 &&
                      sunder_report_block(c->report, a) == sunder_report_block(c->report, b));
}

static double limit_of(const checking *c, size_t f)
{
    double limit = 1e308;
    for (size_t g = 0; g < c->n; g++) {
        if (!same_block(c, f, g)) continue;
        const double own = c->feature[g].fixed ? 0 : c->feature[g].max_shift;
        if (own < limit) limit = own;
    }
    return limit;
}

/* r = at least the square root of s >= 0, by a share of 2^-200 at most and 2^-600. */
static void root_above(mpq_t r, const mpq_t s)
{
    mpz_t n;
    mpz_init(n);
    mpz_mul_2exp(n, mpq_numref(s), 1200);
    mpz_cdiv_q(n, n, mpq_denref(s));
    mpz_sqrt(n, n);
    mpz_add_ui(n, n, 1);
    mpq_set_z(r, n);
    mpq_div_2exp(r, r, 600);
    mpz_clear(n);
}

/* What the limits lose of a leaf: the sum over blocks, each by its first member. */
static void sum_lost(const checking *c, const sunder_proof_node *leaf, mpq_t lost)
{
    vec net, n;
    mpq_t f, limit;
    vec_init(&net), vec_init(&n), mpq_inits(f, limit, NULL);
    mpq_set_ui(lost, 0, 1);
    for (size_t b = 0; b < c->n; b++) {
        bool first = true;
        for (size_t g = 0; g < b && first; g++) first = !same_block(c, b, g);
        if (!first) continue;
        mpq_set_ui(net.x, 0, 1);
        mpq_set_ui(net.y, 0, 1);
        for (size_t k = 0; k < leaf->forces; k++) {
            const sunder_proof_force *force = &c->proof->force[leaf->force + k];
            const sunder_proof_node *node = &c->proof->node[force->node];
            const int sign = (same_block(c, b, node->b) - same_block(c, b, node->a)) * (force->behind ? -1 : 1);
            if (sign == 0) continue;
            vec_set_d(&n, c->proof->way[force->way].n);
            mpq_set_d(f, sign * force->force);
            mpq_mul(n.x, n.x, f);
            mpq_mul(n.y, n.y, f);
            mpq_add(net.x, net.x, n.x);
            mpq_add(net.y, net.y, n.y);
        }
        dot(f, &net, &net);
        if (mpq_sgn(f) == 0) continue;
        root_above(f, f);
        mpq_set_d(limit, limit_of(c, b));
        mpq_mul(f, f, limit);
        mpq_add(lost, lost, f);
    }
    vec_clear(&net), vec_clear(&n), mpq_clears(f, limit, NULL);
}

static const char *check_leaf(const checking *c, const sunder_proof_node *leaf, size_t depth)
{
    mpq_t won, lost, f, d;
    mpq_inits(won, lost, f, d, NULL);
    const char *wrong = NULL;
    for (size_t k = 0; k < leaf->forces && !wrong; k++) {
        const sunder_proof_force *force = &c->proof->force[leaf->force + k];
        size_t level = 0;
        while (level < depth && c->path_node[level] != force->node) level++;
        if (level == depth || !(force->force > 0)) {
            wrong = "a force is not on the way, or none";
            break;
        }
        const size_t taken = c->path_way[level], first = c->proof->node[force->node].way;
        if (force->behind ? force->way < first || force->way >= taken : force->way != taken)
            wrong = "a force is on another case";
        mpq_set_d(f, force->force);
        mpq_set_d(d, force->behind ? -c->proof->way[force->way].d : c->proof->way[force->way].d);
        mpq_mul(f, f, d);
        mpq_add(won, won, f);
    }
    sum_lost(c, leaf, lost);
    if (!wrong && mpq_cmp(won, lost) <= 0) wrong = "a leaf is no contradiction";
    mpq_clears(won, lost, f, d, NULL);
    return wrong;
}

/* ---- The tree ------------------------------------------------------------------------------------------------------
 */

static const char *check_node(checking *c, size_t at, size_t depth)
{
    const sunder_proof *p = c->proof;
    if (at >= p->nodes || c->seen[at]) return "a node is missing, or has two parents";
    c->seen[at] = true;
    const sunder_proof_node *node = &p->node[at];
    if (node->ways == 0) return check_leaf(c, node, depth);
    const double *a = p->corner + 2 * node->part_a, *b = p->corner + 2 * node->part_b;
    if (same_block(c, node->a, node->b)) return "a node is about one block";
    if (!is_convex(a, node->corners_a) || !is_convex(b, node->corners_b)) return "a part is not convex";
    if (!lies_in(a, node->corners_a, &c->feature[node->a]) || !lies_in(b, node->corners_b, &c->feature[node->b]))
        return "a part is not of its feature";
    const char *wrong = check_clearance(c, node);
    if (!wrong) wrong = check_ways(c, node);
    for (size_t k = 0; k < node->ways && !wrong; k++) {
        c->path_node[depth] = at;
        c->path_way[depth] = node->way + k;
        wrong = check_node(c, p->way[node->way + k].next, depth + 1);
    }
    return wrong;
}

static const char *check_blockers(const checking *c)
{
    const sunder_conflict *own = &c->listed[c->conflict];
    bool *used = calloc(c->n, sizeof *used);
    for (size_t k = 0; k < c->proof->nodes; k++)
        if (c->proof->node[k].ways) used[c->proof->node[k].a] = used[c->proof->node[k].b] = true;
    used[own->a] = used[own->b] = false;
    size_t n = 0;
    bool same = true;
    for (size_t f = 0; f < c->n; f++)
        if (used[f]) {
            same = same && n < own->n_blocked_by && own->blocked_by[n] == f;
            n++;
        }
    free(used);
    return same && n == own->n_blocked_by ? NULL : "blocked_by is not what the proof is about";
}

const char *proof_check(const proof_feature *feature, size_t n, double gap, const sunder_report *report, size_t k)
{
    checking c = {.feature = feature, .n = n, .conflict = k, .gap = gap, .report = report};
    c.listed = sunder_report_conflicts(report, &c.listed_n);
    c.proof = sunder_report_proof(report, k);
    if (!c.proof || c.proof->nodes == 0) return "there is no proof";
    c.path_node = calloc(c.proof->nodes, sizeof *c.path_node);
    c.path_way = calloc(c.proof->nodes, sizeof *c.path_way);
    c.seen = calloc(c.proof->nodes, sizeof *c.seen);
    const char *wrong = check_node(&c, 0, 0);
    if (!wrong) wrong = check_blockers(&c);
    free(c.path_node);
    free(c.path_way);
    free(c.seen);
    return wrong;
}
