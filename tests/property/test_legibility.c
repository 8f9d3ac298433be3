/* Necks, inner gaps, areas and shortest edges of random shapes, compared with an oracle in rationals that tries all
 * pairs of vertices and edges by the definition in sunder_legible.h. The limits are the nearest doubles around each
 * value. */
#include "generate.h"
#include "rational_plane.h"
#include "sunder_legible.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

/* ---- A part in rationals ----------------------------------------------------------------------------------------- */

typedef struct part {
    vec *v;              /* [n] */
    size_t *next, *prev; /* [n] */
    size_t n;
} part;

static part part_of(const sunder_shape *shape, size_t polygon)
{
    part p = {0};
    for (size_t r = 0; r < sunder_shape_rings(shape, polygon); r++) {
        size_t n;
        sunder_shape_ring(shape, polygon, r, &n);
        p.n += n;
    }
    p.v = malloc(p.n * sizeof *p.v);
    p.next = malloc(p.n * sizeof *p.next);
    p.prev = malloc(p.n * sizeof *p.prev);
    for (size_t r = 0, at = 0, n; r < sunder_shape_rings(shape, polygon); r++, at += n) {
        const double *xy = sunder_shape_ring(shape, polygon, r, &n);
        for (size_t k = 0; k < n; k++) {
            vec_init(&p.v[at + k]);
            vec_set_d(&p.v[at + k], xy + 2 * k);
            p.next[at + k] = at + (k + 1) % n;
            p.prev[at + k] = at + (k + n - 1) % n;
        }
    }
    return p;
}

static void part_free(part *p)
{
    for (size_t k = 0; k < p->n; k++) vec_clear(&p->v[k]);
    free(p->v);
    free(p->next);
    free(p->prev);
}

/* The sign of (b - a) . (c - a). */
static int dot_sign(const vec *a, const vec *b, const vec *c)
{
    vec u, v;
    mpq_t dot;
    vec_init(&u);
    vec_init(&v);
    mpq_init(dot);
    vec_sub(&u, b, a);
    vec_sub(&v, c, a);
    vec_dot(dot, &u, &v);
    const int sign = mpq_sgn(dot);
    mpq_clear(dot);
    vec_clear(&u);
    vec_clear(&v);
    return sign;
}

static void square_of(mpq_t square, const vec *a, const vec *b)
{
    vec u;
    vec_init(&u);
    vec_sub(&u, b, a);
    vec_dot(square, &u, &u);
    vec_clear(&u);
}

/* The place of p along the line from a to b: 0 at a, 1 at b. */
static void place_of(mpq_t t, const vec *a, const vec *b, const vec *p)
{
    vec u, v;
    mpq_t square;
    vec_init(&u);
    vec_init(&v);
    mpq_init(square);
    vec_sub(&u, b, a);
    vec_sub(&v, p, a);
    vec_dot(t, &u, &v);
    vec_dot(square, &u, &u);
    mpq_div(t, t, square);
    mpq_clear(square);
    vec_clear(&u);
    vec_clear(&v);
}

static void point_at(vec *out, const vec *a, const vec *b, const mpq_t t)
{
    vec u;
    vec_init(&u);
    vec_sub(&u, b, a);
    mpq_mul(u.x, u.x, t);
    mpq_mul(u.y, u.y, t);
    mpq_add(out->x, a->x, u.x);
    mpq_add(out->y, a->y, u.y);
    vec_clear(&u);
}

/* Is a point that is not on the boundary inside? The ray to the right of it crosses an odd number of edges. */
static bool is_inside(const part *p, const vec *at)
{
    bool inside = false;
    for (size_t k = 0; k < p->n; k++) {
        const vec *a = &p->v[k], *b = &p->v[p->next[k]];
        const bool up = mpq_cmp(a->y, at->y) <= 0, down = mpq_cmp(b->y, at->y) <= 0;
        if (up == down) continue;
        inside ^= vec_side(a, b, at) == (up ? 1 : -1);
    }
    return inside;
}

/* Is an inner point of the segment from a to b on the edge from c to d? */
static bool is_crossed(const vec *a, const vec *b, const vec *c, const vec *d)
{
    const int sc = vec_side(a, b, c), sd = vec_side(a, b, d);
    if (sc * sd > 0) return false;
    mpq_t t, u, one;
    mpq_inits(t, u, one, NULL);
    mpq_set_ui(one, 1, 1);
    place_of(t, a, b, c);
    place_of(u, a, b, d);
    bool crossed;
    if (sc == 0 && sd == 0) {
        if (mpq_cmp(t, u) > 0) mpq_swap(t, u);
        crossed = mpq_sgn(u) > 0 && mpq_cmp(t, one) < 0;
    } else { /* the line meets the edge in one point: the heights of c and d over it weigh their places */
        vec e, f, g;
        mpq_t hc, hd;
        vec_init(&e);
        vec_init(&f);
        vec_init(&g);
        mpq_inits(hc, hd, NULL);
        vec_sub(&e, b, a);
        vec_sub(&f, c, a);
        vec_sub(&g, d, a);
        vec_cross(hc, &e, &f);
        vec_cross(hd, &e, &g);
        mpq_mul(t, t, hd);
        mpq_mul(u, u, hc);
        mpq_sub(t, t, u);
        mpq_sub(hd, hd, hc);
        mpq_div(t, t, hd);
        crossed = mpq_sgn(t) > 0 && mpq_cmp(t, one) < 0;
        mpq_clears(hc, hd, NULL);
        vec_clear(&e);
        vec_clear(&f);
        vec_clear(&g);
    }
    mpq_clears(t, u, one, NULL);
    return crossed;
}

/* ---- Links by their definition ----------------------------------------------------------------------------------- */

typedef struct least {
    mpq_t square[2]; /* of the shortest inner gap and neck */
    bool any[2];
} least;

/* Takes the segment from a to b as a link if no edge is in its way. */
static void take_link(const part *p, const vec *a, const vec *b, least *out)
{
    mpq_t square, half;
    vec middle;
    mpq_inits(square, half, NULL);
    vec_init(&middle);
    square_of(square, a, b);
    bool clear = mpq_sgn(square) > 0;
    for (size_t k = 0; k < p->n && clear; k++) clear = !is_crossed(a, b, &p->v[k], &p->v[p->next[k]]);
    if (clear) {
        mpq_set_ui(half, 1, 2);
        point_at(&middle, a, b, half);
        const bool inside = is_inside(p, &middle);
        if (!out->any[inside] || mpq_cmp(square, out->square[inside]) < 0) mpq_set(out->square[inside], square);
        out->any[inside] = true;
    }
    vec_clear(&middle);
    mpq_clears(square, half, NULL);
}

/* Does the segment from vertex v to a point make no acute angle with the edges at v? */
static bool leaves(const part *p, size_t v, const vec *to)
{
    return dot_sign(&p->v[v], to, &p->v[p->next[v]]) <= 0 && dot_sign(&p->v[v], to, &p->v[p->prev[v]]) <= 0;
}

static int by_value(const void *a, const void *b) { return mpq_cmp(*(const mpq_t *)a, *(const mpq_t *)b); }

/* Parallel edges: a link over the middle between any two places at which a vertex stands. */
static void take_parallel(const part *p, size_t e, size_t f, least *out)
{
    const vec *a = &p->v[e], *b = &p->v[p->next[e]], *c = &p->v[f], *d = &p->v[p->next[f]];
    vec ab, cd, from, to;
    mpq_t cross, t, u, *place = malloc((p->n + 2) * sizeof *place);
    vec_init(&ab);
    vec_init(&cd);
    vec_init(&from);
    vec_init(&to);
    mpq_inits(cross, t, u, NULL);
    vec_sub(&ab, b, a);
    vec_sub(&cd, d, c);
    vec_cross(cross, &ab, &cd);
    if (mpq_sgn(cross) == 0 && vec_side(a, b, c) != 0) {
        for (size_t k = 0; k < p->n; k++) {
            mpq_init(place[k]);
            place_of(place[k], a, b, &p->v[k]);
        }
        qsort(place, p->n, sizeof *place, by_value);
        for (size_t k = 0; k + 1 < p->n; k++) {
            mpq_set_ui(u, 1, 2);
            mpq_add(t, place[k], place[k + 1]);
            mpq_mul(t, t, u);
            mpq_set_ui(u, 1, 1);
            if (mpq_equal(place[k], place[k + 1]) || mpq_sgn(t) <= 0 || mpq_cmp(t, u) >= 0) continue;
            point_at(&from, a, b, t);
            place_of(t, c, d, &from);
            if (mpq_sgn(t) <= 0 || mpq_cmp(t, u) >= 0) continue;
            point_at(&to, c, d, t);
            take_link(p, &from, &to, out);
        }
        for (size_t k = 0; k < p->n; k++) mpq_clear(place[k]);
    }
    mpq_clears(cross, t, u, NULL);
    vec_clear(&ab);
    vec_clear(&cd);
    vec_clear(&from);
    vec_clear(&to);
    free(place);
}

/* Vertex v and edge f: where they touch all lengths are 0. */
static void take_vertex(const part *p, size_t v, size_t f, least *out)
{
    const vec *at = &p->v[v], *a = &p->v[f], *b = &p->v[p->next[f]];
    if (v == f || v == p->next[f]) return;
    mpq_t t, one;
    vec foot;
    mpq_inits(t, one, NULL);
    vec_init(&foot);
    mpq_set_ui(one, 1, 1);
    place_of(t, a, b, at);
    if (vec_side(a, b, at) == 0 && mpq_sgn(t) >= 0 && mpq_cmp(t, one) <= 0)
        for (int k = 0; k < 2; k++) {
            mpq_set_ui(out->square[k], 0, 1);
            out->any[k] = true;
        }
    else if (mpq_sgn(t) > 0 && mpq_cmp(t, one) < 0) {
        point_at(&foot, a, b, t);
        if (leaves(p, v, &foot)) take_link(p, at, &foot, out);
    }
    mpq_clears(t, one, NULL);
    vec_clear(&foot);
}

static void find_links(const part *p, least *out)
{
    for (size_t v = 0; v < p->n; v++)
        for (size_t w = 0; w < p->n; w++) {
            take_vertex(p, v, w, out);
            if (w <= v) continue;
            if (leaves(p, v, &p->v[w]) && leaves(p, w, &p->v[v])) take_link(p, &p->v[v], &p->v[w], out);
            take_parallel(p, v, w, out);
        }
}

/* ---- Areas and edges --------------------------------------------------------------------------------------------- */

static void find_area(const part *p, mpq_t area)
{
    mpq_t cross;
    mpq_init(cross);
    for (size_t k = 0; k < p->n; k++) {
        vec_cross(cross, &p->v[k], &p->v[p->next[k]]);
        mpq_add(area, area, cross);
    }
    mpq_set_ui(cross, 1, 2);
    mpq_mul(area, area, cross);
    mpq_clear(cross);
}

static void find_edge(const part *p, mpq_t square)
{
    mpq_t one;
    mpq_init(one);
    for (size_t k = 0; k < p->n; k++) {
        square_of(one, &p->v[k], &p->v[p->next[k]]);
        if (k == 0 || mpq_cmp(one, square) < 0) mpq_set(square, one);
    }
    mpq_clear(one);
}

/* ---- Comparison -------------------------------------------------------------------------------------------------- */

static bool reports(const sunder_shape *shape, size_t polygon, sunder_illegible_kind kind, double limit, double *has)
{
    sunder_legible_limits limits = {0};
    double *const place[] = {&limits.width, &limits.area, &limits.neck, &limits.inner_gap, &limits.edge};
    *place[kind] = limit;
    sunder_illegible *found;
    size_t n;
    bool any = false;
    assert_int_equal(sunder_shape_illegible(shape, &limits, &found, &n, NULL), SUNDER_OK);
    for (size_t k = 0; k < n; k++)
        if (found[k].polygon == polygon) {
            any = true;
            *has = found[k].has;
        }
    sunder_free(found);
    return any;
}

/* The root of q, or q itself, as a double near it. */
static double near_double(const mpq_t q, bool root)
{
    mpf_t f;
    mpf_init2(f, 4096);
    mpf_set_q(f, q);
    if (root) mpf_sqrt(f, f);
    const double d = mpf_get_d(f);
    mpf_clear(f);
    return d;
}

/* Is d (or its square) more than q? */
static bool exceeds(double d, const mpq_t q, bool root)
{
    mpq_t v;
    mpq_init(v);
    mpq_set_d(v, d);
    if (root) mpq_mul(v, v, v);
    const bool more = mpq_cmp(v, q) > 0;
    mpq_clear(v);
    return more;
}

/* The part is reported exactly for the limits that exceed its value, of the doubles around it and of one far beyond. */
static bool agrees(const sunder_shape *shape, size_t polygon, sunder_illegible_kind kind, const mpq_t q, bool any)
{
    const bool root = kind != SUNDER_ILLEGIBLE_SMALL;
    const double about = any ? near_double(q, root) : 0;
    double limit = nextafter(about, 0), has = -1;
    for (int k = 0; k < 5; k++) {
        if (k == 4) limit = about > 1e100 ? 2 * about : 1e150;
        if (limit > 0 && limit < 1e308) {
            const bool found = reports(shape, polygon, kind, limit, &has);
            if (found != (any && exceeds(limit, q, root))) {
                printf("%s: limit %.17g, about %.17g: %d\n", sunder_illegible_kind_string(kind), limit, about, found);
                return false;
            }
            if (found && fabs(has - about) > 4e-16 * about + 0x1p-1074) {
                printf("%s: %.17g is reported, not %.17g\n", sunder_illegible_kind_string(kind), has, about);
                return false;
            }
        }
        limit = nextafter(limit, INFINITY);
    }
    return true;
}

static bool part_agrees(const sunder_shape *shape, size_t polygon, size_t *links)
{
    part p = part_of(shape, polygon);
    least l = {.any = {false, false}};
    mpq_t area, edge;
    mpq_inits(area, edge, l.square[0], l.square[1], NULL);
    find_links(&p, &l);
    find_area(&p, area);
    find_edge(&p, edge);
    *links += (size_t)l.any[0] + l.any[1];
    const bool ok = agrees(shape, polygon, SUNDER_ILLEGIBLE_NECK, l.square[1], l.any[1]) &&
                    agrees(shape, polygon, SUNDER_ILLEGIBLE_INNER_GAP, l.square[0], l.any[0]) &&
                    agrees(shape, polygon, SUNDER_ILLEGIBLE_SMALL, area, true) &&
                    agrees(shape, polygon, SUNDER_ILLEGIBLE_SHORT_EDGE, edge, true);
    mpq_clears(area, edge, l.square[0], l.square[1], NULL);
    part_free(&p);
    return ok;
}

static void random_shape(polyset *set, rng *r, uint64_t i)
{
    cells c;
    switch (i % 8) {
    case 0: random_simple(set, r, (int)rng_int(r, 3, 8), 12); break;
    case 1: random_star(set, r, (int)rng_int(r, 4, 12), 20); break;
    case 2: random_comb(set, r, (int)rng_int(r, 2, 5), 12, true); break;
    case 3: random_building(set, r); break;
    default:
        random_cells(&c, r, (int)rng_int(r, 2, 5), (int)rng_int(r, 2, 5), (spacing)(i / 8 % 5), rng_once_in(r, 2),
                     (int)rng_int(r, 40, 90));
        cells_outline(set, &c, rng_once_in(r, 2), rng_once_in(r, 2));
    }
}

static void test_links(void **state)
{
    (void)state;
    size_t links = 0, parts = 0;
    for (uint64_t i = 0; i < test_count(500); i++) {
        rng r = rng_start(test_seed() + 4100, i);
        polyset set;
        polyset_init(&set);
        random_shape(&set, &r, i);
        sunder_shape *shape = polyset_shape(&set);
        for (size_t k = 0; k < sunder_shape_polygons(shape); k++, parts++)
            if (!part_agrees(shape, k, &links)) {
                char *wkt = polyset_wkt(&set);
                fail_msg("case %d, part %zu of %s", (int)i, k, wkt);
            }
        sunder_shape_free(shape);
        polyset_free(&set);
    }
    printf("%zu parts, %zu of them with links of a kind\n", parts, links);
    assert_true(parts >= 100 && links >= parts / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_links)};
    printf("seed %llu\n", (unsigned long long)test_seed());
    return cmocka_run_group_tests(tests, NULL, NULL);
}
