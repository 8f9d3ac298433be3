/* All edges of a member are cut at their intersections. Of coincident pieces an even number is dropped, and one remains
 * of an odd number. Each remaining piece has the set on one side: the side on which a ray meets an odd number of the
 * other pieces. */
#include "even_odd.h"

#include <stdlib.h>

typedef struct spot {
    mpq_t x, y;
} spot;

/* From a to b, with a < b lexicographically; reversed later if the set has to be on the left. */
typedef struct piece {
    spot a, b;
    size_t next;
    bool gone, traced;
} piece;

typedef struct cutter {
    spot (*edge)[2];
    size_t edges;
    piece *piece;
    size_t pieces;
} cutter;

static void spot_init(spot *s) { mpq_inits(s->x, s->y, NULL); }
static void spot_clear(spot *s) { mpq_clears(s->x, s->y, NULL); }

static void spot_set(spot *to, const spot *from)
{
    mpq_set(to->x, from->x);
    mpq_set(to->y, from->y);
}

static int spot_cmp(const spot *a, const spot *b)
{
    const int c = mpq_cmp(a->x, b->x);
    return c ? c : mpq_cmp(a->y, b->y);
}

static int compare_spots(const void *a, const void *b) { return spot_cmp(a, b); }

/* (b - a) x (d - c) */
static void cross(mpq_t out, const spot *a, const spot *b, const spot *c, const spot *d)
{
    mpq_t u, v;
    mpq_inits(u, v, NULL);
    mpq_sub(u, b->x, a->x);
    mpq_sub(v, d->y, c->y);
    mpq_mul(out, u, v);
    mpq_sub(u, b->y, a->y);
    mpq_sub(v, d->x, c->x);
    mpq_mul(u, u, v);
    mpq_sub(out, out, u);
    mpq_clears(u, v, NULL);
}

static int turn(const spot *a, const spot *b, const spot *c, const spot *d)
{
    mpq_t t;
    mpq_init(t);
    cross(t, a, b, c, d);
    const int sign = mpq_sgn(t);
    mpq_clear(t);
    return sign;
}

/* ---- Pieces ---- */

static bool between(const spot *p, const spot *a, const spot *b) { return spot_cmp(a, p) < 0 && spot_cmp(p, b) < 0; }

/* Lists the points inside edge e at which edge f meets it; both edges run lexicographically upwards. */
static size_t add_meeting(spot *list, size_t n, spot *const e, spot *const f)
{
    const int fa = turn(&e[0], &e[1], &e[0], &f[0]), fb = turn(&e[0], &e[1], &e[0], &f[1]);
    for (int k = 0; k < 2; k++)
        if ((k ? fb : fa) == 0 && between(&f[k], &e[0], &e[1])) {
            spot_init(&list[n]);
            spot_set(&list[n++], &f[k]);
        }
    if (fa * fb >= 0 || turn(&f[0], &f[1], &f[0], &e[0]) * turn(&f[0], &f[1], &f[0], &e[1]) >= 0) return n;
    mpq_t t, d; /* the point e[0] + t (e[1] - e[0]) */
    mpq_inits(t, d, NULL);
    cross(t, &e[0], &f[0], &f[0], &f[1]);
    cross(d, &e[0], &e[1], &f[0], &f[1]);
    mpq_div(t, t, d);
    spot_init(&list[n]);
    mpq_sub(d, e[1].x, e[0].x);
    mpq_mul(d, d, t);
    mpq_add(list[n].x, e[0].x, d);
    mpq_sub(d, e[1].y, e[0].y);
    mpq_mul(d, d, t);
    mpq_add(list[n].y, e[0].y, d);
    mpq_clears(t, d, NULL);
    return n + 1;
}

static void cut_edge(cutter *c, size_t k)
{
    spot *list = test_alloc(3 * c->edges + 2, sizeof *list);
    size_t n = 2;
    for (int i = 0; i < 2; i++) {
        spot_init(&list[i]);
        spot_set(&list[i], &c->edge[k][i]);
    }
    for (size_t j = 0; j < c->edges; j++)
        if (j != k) n = add_meeting(list, n, c->edge[k], c->edge[j]);
    qsort(list, n, sizeof *list, compare_spots);
    for (size_t i = 1; i < n; i++) {
        if (spot_cmp(&list[i - 1], &list[i]) == 0) continue;
        c->piece = test_resize(c->piece, c->pieces + 1, sizeof *c->piece);
        piece *p = &c->piece[c->pieces++];
        *p = (piece){.next = SIZE_MAX};
        spot_init(&p->a);
        spot_init(&p->b);
        spot_set(&p->a, &list[i - 1]);
        spot_set(&p->b, &list[i]);
    }
    for (size_t i = 0; i < n; i++) spot_clear(&list[i]);
    free(list);
}

static void load_edges(cutter *c, const polyset *set, size_t member)
{
    for (size_t r = member ? set->poly_end[member - 1] : 0; r < set->poly_end[member]; r++) {
        const size_t first = r ? set->ring_end[r - 1] : 0, end = set->ring_end[r];
        for (size_t v = first; v < end; v++) {
            const double *a = set->xy + 2 * v, *b = set->xy + 2 * (v + 1 < end ? v + 1 : first);
            if (a[0] == b[0] && a[1] == b[1]) continue;
            const bool up = a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
            c->edge = test_resize(c->edge, c->edges + 1, sizeof *c->edge);
            for (int k = 0; k < 2; k++) {
                spot *s = &c->edge[c->edges][k];
                spot_init(s);
                mpq_set_d(s->x, ((k == 0) == up ? a : b)[0]);
                mpq_set_d(s->y, ((k == 0) == up ? a : b)[1]);
            }
            c->edges++;
        }
    }
}

static void drop_even_pieces(cutter *c)
{
    for (size_t i = 0; i < c->pieces; i++)
        for (size_t j = i + 1; j < c->pieces && !c->piece[i].gone; j++) {
            piece *p = &c->piece[i], *q = &c->piece[j];
            if (q->gone || spot_cmp(&p->a, &q->a) || spot_cmp(&p->b, &q->b)) continue;
            p->gone = q->gone = true;
        }
}

/* Is the set above the piece (to the left, if it is vertical)? Decided by a ray from its midpoint. */
static bool set_is_left(const cutter *c, const piece *p)
{
    spot m;
    bool in = false;
    spot_init(&m);
    mpq_add(m.x, p->a.x, p->b.x);
    mpq_add(m.y, p->a.y, p->b.y);
    mpq_div_2exp(m.x, m.x, 1);
    mpq_div_2exp(m.y, m.y, 1);
    const bool upright = mpq_equal(p->a.x, p->b.x);
    for (size_t i = 0; i < c->pieces; i++) {
        const piece *q = &c->piece[i];
        if (q->gone || q == p) continue;
        if (upright) {
            const bool a = mpq_cmp(q->a.y, m.y) <= 0, b = mpq_cmp(q->b.y, m.y) <= 0;
            /* The piece is directed upwards, so the ray to the left meets it if the midpoint is on its right. */
            if (a != b && turn(&q->a, &q->b, &q->a, &m) * (a ? 1 : -1) < 0) in = !in;
        } else if (mpq_cmp(q->a.x, m.x) <= 0 && mpq_cmp(m.x, q->b.x) < 0 && turn(&q->a, &q->b, &q->a, &m) < 0) {
            in = !in;
        }
    }
    spot_clear(&m);
    return in;
}

/* ---- Rings ---- */

/* Turning clockwise from the direction of `from`, does one meet u before v? All are directions from `at`; u and v
 * differ from the direction of `from`. */
static bool sooner(const spot *at, const spot *from, const spot *u, const spot *v)
{
    /* Half-turns: 0 for directions right of `from`, 1 for straight on, 2 for directions left of it. */
    const int half_u = 1 + turn(at, from, at, u), half_v = 1 + turn(at, from, at, v);
    if (half_u != half_v) return half_u < half_v;
    return turn(at, u, at, v) < 0;
}

/* Joins pieces at their ends: the next piece is the first one clockwise from the way back, so that the set is in
 * between. */
static void link_pieces(cutter *c)
{
    for (size_t i = 0; i < c->pieces; i++) {
        piece *p = &c->piece[i];
        if (p->gone) continue;
        for (size_t j = 0; j < c->pieces; j++) {
            const piece *q = &c->piece[j];
            if (q->gone || j == i || spot_cmp(&q->a, &p->b)) continue;
            if (p->next == SIZE_MAX || sooner(&p->b, &p->a, &q->b, &c->piece[p->next].b)) p->next = j;
        }
        if (p->next == SIZE_MAX) abort();
    }
}

static void add_ring(even_odd *e, cutter *c, size_t start, size_t member)
{
    const size_t first = e->n;
    size_t i = start;
    do {
        piece *p = &c->piece[i];
        const piece *q = &c->piece[p->next];
        p->traced = true;
        if (turn(&p->a, &p->b, &q->a, &q->b)) {
            e->corner = test_resize(e->corner, e->n + 1, sizeof *e->corner);
            even_odd_corner *k = &e->corner[e->n++];
            mpq_inits(k->x, k->y, NULL);
            mpq_set(k->x, p->b.x);
            mpq_set(k->y, p->b.y);
            k->member = member;
        }
        i = p->next;
    } while (i != start);
    for (size_t k = first; k < e->n; k++) {
        e->corner[k].next = k + 1 < e->n ? k + 1 : first;
        e->corner[k].prev = k > first ? k - 1 : e->n - 1;
    }
}

static void add_member(even_odd *e, const polyset *set, size_t member)
{
    cutter c = {NULL, 0, NULL, 0};
    load_edges(&c, set, member);
    for (size_t k = 0; k < c.edges; k++) cut_edge(&c, k);
    drop_even_pieces(&c);
    bool *left = test_alloc(c.pieces, sizeof *left);
    for (size_t i = 0; i < c.pieces; i++) left[i] = c.piece[i].gone || set_is_left(&c, &c.piece[i]);
    for (size_t i = 0; i < c.pieces; i++)
        if (!left[i]) {
            const spot t = c.piece[i].a;
            c.piece[i].a = c.piece[i].b;
            c.piece[i].b = t;
        }
    link_pieces(&c);
    const size_t before = e->n;
    for (size_t i = 0; i < c.pieces; i++)
        if (!c.piece[i].gone && !c.piece[i].traced) add_ring(e, &c, i, e->members);
    e->members += e->n > before;
    for (size_t i = 0; i < c.pieces; i++) {
        spot_clear(&c.piece[i].a);
        spot_clear(&c.piece[i].b);
    }
    for (size_t i = 0; i < c.edges; i++) {
        spot_clear(&c.edge[i][0]);
        spot_clear(&c.edge[i][1]);
    }
    free(left);
    free(c.edge);
    free(c.piece);
}

void even_odd_open(even_odd *e, const polyset *set)
{
    *e = (even_odd){NULL, 0, 0};
    for (size_t m = 0; m < set->polygons; m++) add_member(e, set, m);
}

void even_odd_close(even_odd *e)
{
    for (size_t i = 0; i < e->n; i++) mpq_clears(e->corner[i].x, e->corner[i].y, NULL);
    free(e->corner);
}

void even_odd_denominator(const even_odd *e, mpz_t factor)
{
    for (size_t i = 0; i < e->n; i++) {
        mpz_lcm(factor, factor, mpq_denref(e->corner[i].x));
        mpz_lcm(factor, factor, mpq_denref(e->corner[i].y));
    }
}

/* Sets *out to v times factor; false if that is not a double. */
static bool as_double(double *out, const mpq_t v, const mpz_t factor)
{
    mpq_t t, back;
    mpq_inits(t, back, NULL);
    mpq_set_z(t, factor);
    mpq_mul(t, t, v);
    *out = mpq_get_d(t);
    mpq_set_d(back, *out);
    const bool exact = mpq_equal(t, back);
    mpq_clears(t, back, NULL);
    return exact;
}

bool even_odd_times(const even_odd *e, const mpz_t factor, polyset *out)
{
    bool exact = true;
    polyset_init(out);
    for (size_t i = 0; i < e->n && exact; i++) {
        double x, y;
        exact = as_double(&x, e->corner[i].x, factor) && as_double(&y, e->corner[i].y, factor);
        if (!exact) break;
        polyset_vertex(out, x, y);
        if (e->corner[i].next > i) continue;
        polyset_end_ring(out);
        if (i + 1 == e->n || e->corner[i + 1].member != e->corner[i].member) polyset_end_polygon(out);
    }
    if (!exact) polyset_free(out);
    return exact;
}
