/* Lines and points beside polygons, in rationals: the questions that proof_check.c has about barriers without area. */
#include "proof_checking.h"

#include <stdlib.h>

static void corner_of(vec *v, const proof_feature *f, size_t k) { vec_set_d(v, f->xy + 2 * (k % f->corners)); }

static size_t segments_of(const proof_feature *line) { return line->corners > 1 ? line->corners - 1 : 1; }

/* The square of the distance of two segments; the second, or both, may be points. */
static void square_between(mpq_t square, const double *p, size_t np, const double *q, size_t nq)
{
    vec zero;
    vec_init(&zero);
    hull k = hull_difference(p, np, q, nq);
    hull_square_from(square, &k, &zero);
    hull_free(&k);
    vec_clear(&zero);
}

bool is_part_of_line(const double *part, size_t n, const proof_feature *line)
{
    bool in = false;
    mpq_t square;
    if (n < 1 || n > 2) return false;
    mpq_init(square);
    for (size_t k = 0; k < segments_of(line) && !in; k++) {
        in = true;
        for (size_t m = 0; m < n && in; m++) {
            square_between(square, line->xy + 2 * k, line->corners > 1 ? 2 : 1, part + 2 * m, 1);
            in = mpq_sgn(square) == 0;
        }
    }
    mpq_clear(square);
    return in;
}

void proof_line_square(mpq_t square, const proof_feature *line, const proof_feature *polygon)
{
    mpq_t own;
    mpq_init(own);
    for (size_t k = 0; k < segments_of(line); k++)
        for (size_t m = 0; m < polygon->corners; m++) {
            const size_t next = (m + 1) % polygon->corners;
            const double edge[4] = {polygon->xy[2 * m], polygon->xy[2 * m + 1], polygon->xy[2 * next],
                                    polygon->xy[2 * next + 1]};
            square_between(own, line->xy + 2 * k, line->corners > 1 ? 2 : 1, edge, 2);
            if ((k == 0 && m == 0) || mpq_cmp(own, square) < 0) mpq_set(square, own);
        }
    mpq_clear(own);
}

/* Is the place inside the polygon, and not on an edge? By a ray to the right. */
static bool is_inside(const proof_feature *polygon, const vec *at)
{
    vec p, q, v, w;
    mpq_t d;
    bool in = false, on = false;
    vec_init(&p), vec_init(&q), vec_init(&v), vec_init(&w), mpq_init(d);
    for (size_t k = 0; k < polygon->corners && !on; k++) {
        corner_of(&p, polygon, k);
        corner_of(&q, polygon, k + 1);
        vec_sub(&v, at, &p);
        vec_sub(&w, at, &q);
        vec_dot(d, &v, &w);
        const int side = vec_side(&p, &q, at);
        on = side == 0 && mpq_sgn(d) <= 0;
        const bool up = mpq_cmp(p.y, at->y) > 0, uq = mpq_cmp(q.y, at->y) > 0;
        if (up != uq && side * (uq ? 1 : -1) > 0) in = !in;
    }
    vec_clear(&p), vec_clear(&q), vec_clear(&v), vec_clear(&w), mpq_clear(d);
    return in && !on;
}

static int by_value(const void *a, const void *b) { return mpq_cmp(*(const mpq_t *)a, *(const mpq_t *)b); }

/* Sorted parameters of the segment p q at which it meets the lines of the polygon's edges, including 0 and 1: between
 * two consecutive ones the segment is entirely inside, outside, or on an edge. */
static size_t find_cuts(const proof_feature *polygon, const vec *p, const vec *q, mpq_t *cut)
{
    size_t n = 2;
    vec a, b, e, u, w;
    mpq_t slope;
    vec_init(&a), vec_init(&b), vec_init(&e), vec_init(&u), vec_init(&w), mpq_init(slope);
    mpq_set_ui(cut[0], 0, 1);
    mpq_set_ui(cut[1], 1, 1);
    vec_sub(&u, q, p);
    for (size_t k = 0; k < polygon->corners; k++) {
        corner_of(&a, polygon, k);
        corner_of(&b, polygon, k + 1);
        vec_sub(&e, &b, &a);
        vec_sub(&w, &a, p);
        vec_cross(slope, &e, &u);
        if (mpq_sgn(slope) == 0) continue;
        vec_cross(cut[n], &e, &w);
        mpq_div(cut[n], cut[n], slope);
        if (mpq_sgn(cut[n]) > 0 && mpq_cmp(cut[n], cut[1]) < 0) n++;
    }
    qsort(cut, n, sizeof *cut, by_value);
    vec_clear(&a), vec_clear(&b), vec_clear(&e), vec_clear(&u), vec_clear(&w), mpq_clear(slope);
    return n;
}

static bool segment_meets(const proof_feature *polygon, const double *from, const double *to)
{
    const size_t most = polygon->corners + 3;
    vec p, q, u, at;
    mpq_t *cut = malloc(most * sizeof *cut), half;
    bool meets = false;
    vec_init(&p), vec_init(&q), vec_init(&u), vec_init(&at), mpq_init(half);
    for (size_t k = 0; k < most; k++) mpq_init(cut[k]);
    vec_set_d(&p, from);
    vec_set_d(&q, to);
    vec_sub(&u, &q, &p);
    const size_t n = find_cuts(polygon, &p, &q, cut);
    for (size_t k = 1; k < n && !meets; k++) {
        mpq_add(half, cut[k - 1], cut[k]);
        mpq_div_2exp(half, half, 1);
        mpq_mul(at.x, u.x, half);
        mpq_mul(at.y, u.y, half);
        mpq_add(at.x, at.x, p.x);
        mpq_add(at.y, at.y, p.y);
        meets = is_inside(polygon, &at);
    }
    for (size_t k = 0; k < most; k++) mpq_clear(cut[k]);
    free(cut);
    vec_clear(&p), vec_clear(&q), vec_clear(&u), vec_clear(&at), mpq_clear(half);
    return meets;
}

bool proof_line_meets(const proof_feature *line, const proof_feature *polygon)
{
    bool meets = false;
    for (size_t k = 0; k < segments_of(line) && !meets; k++)
        meets = segment_meets(polygon, line->xy + 2 * k, line->xy + (line->corners > 1 ? 2 * k + 2 : 2 * k));
    return meets;
}

bool proof_line_least(mpq_t square, const proof_feature *line, const proof_feature *polygon)
{
    if (line->corners > 2 || !is_convex_part(polygon->xy, polygon->corners)) return false;
    hull k = hull_difference(polygon->xy, polygon->corners, line->xy, line->corners);
    vec e, w, zero;
    mpq_t room, whole;
    vec_init(&e), vec_init(&w), vec_init(&zero), mpq_inits(room, whole, NULL);
    for (size_t m = 0; m < k.n; m++) {
        vec_sub(&e, &k.v[(m + 1) % k.n], &k.v[m]);
        vec_sub(&w, &zero, &k.v[m]);
        vec_cross(room, &e, &w);
        vec_dot(whole, &e, &e);
        mpq_mul(room, room, room);
        mpq_div(room, room, whole);
        if (m == 0 || mpq_cmp(room, square) < 0) mpq_set(square, room);
    }
    vec_clear(&e), vec_clear(&w), vec_clear(&zero), mpq_clears(room, whole, NULL);
    hull_free(&k);
    return true;
}
