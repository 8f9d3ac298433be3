/* A point is inside if it is on an edge, or if a vertical ray upwards meets an odd number of a member's edges. A path
 * meets an edge if a point of it, at a parameter from 0 to 1, is on the edge. The crossing of both lines is computed;
 * if they coincide, both segments are ordered along the line. */
#include "passage_oracle.h"

#include <stdlib.h>

static oracle_edge *add(oracle_boundary *b, size_t member)
{
    b->edge = test_resize(b->edge, b->n + 1, sizeof *b->edge);
    oracle_edge *e = &b->edge[b->n++];
    mpq_inits(e->a[0], e->a[1], e->b[0], e->b[1], NULL);
    e->member = member;
    return e;
}

static void add_doubles(oracle_boundary *b, const double *p, const double *q, size_t member)
{
    oracle_edge *e = add(b, member);
    for (int k = 0; k < 2; k++) {
        mpq_set_d(e->a[k], p[k]);
        mpq_set_d(e->b[k], q[k]);
    }
}

void oracle_boundary_open(oracle_boundary *b, const polyset *set)
{
    *b = (oracle_boundary){.members = set->polygons};
    for (size_t p = 0, r = 0, v = 0; p < set->polygons; p++)
        for (; r < set->poly_end[p]; r++) {
            const size_t first = v;
            for (; v < set->ring_end[r]; v++)
                add_doubles(b, set->xy + 2 * v, set->xy + 2 * (v + 1 < set->ring_end[r] ? v + 1 : first), p);
        }
}

void oracle_boundary_of_even_odd(oracle_boundary *b, const even_odd *set)
{
    *b = (oracle_boundary){.members = set->members};
    for (size_t k = 0; k < set->n; k++) {
        const even_odd_corner *p = &set->corner[k], *q = &set->corner[p->next];
        oracle_edge *e = add(b, p->member);
        mpq_set(e->a[0], p->x);
        mpq_set(e->a[1], p->y);
        mpq_set(e->b[0], q->x);
        mpq_set(e->b[1], q->y);
    }
}

void oracle_boundary_of_line(oracle_boundary *b, const double *xy, size_t n)
{
    *b = (oracle_boundary){0};
    for (size_t k = 0; k + 1 < n; k++) add_doubles(b, xy + 2 * k, xy + 2 * k + 2, 0);
    if (n == 1) add_doubles(b, xy, xy, 0);
}

void oracle_boundary_close(oracle_boundary *b)
{
    for (size_t k = 0; k < b->n; k++) {
        oracle_edge *e = &b->edge[k];
        mpq_clears(e->a[0], e->a[1], e->b[0], e->b[1], NULL);
    }
    free(b->edge);
}

/* (p - o) x (q - o) */
static int turn(const mpq_t o[2], const mpq_t p[2], const mpq_t q[2])
{
    mpq_t u, v, w;
    mpq_inits(u, v, w, NULL);
    mpq_sub(u, p[0], o[0]);
    mpq_sub(v, q[1], o[1]);
    mpq_mul(w, u, v);
    mpq_sub(u, p[1], o[1]);
    mpq_sub(v, q[0], o[0]);
    mpq_mul(u, u, v);
    const int sign = mpq_cmp(w, u);
    mpq_clears(u, v, w, NULL);
    return sign;
}

/* Is p, which is on the line of the edge, between its ends? */
static bool is_between(const oracle_edge *e, const mpq_t p[2])
{
    for (int k = 0; k < 2; k++)
        if (mpq_cmp(p[k], e->a[k]) * mpq_cmp(p[k], e->b[k]) > 0) return false;
    return true;
}

bool oracle_holds(const oracle_boundary *b, const double point[2])
{
    mpq_t p[2];
    mpq_inits(p[0], p[1], NULL);
    mpq_set_d(p[0], point[0]);
    mpq_set_d(p[1], point[1]);
    bool *odd = test_alloc(b->members + 1, sizeof *odd), held = false;
    for (size_t k = 0; k <= b->members; k++) odd[k] = false;
    for (size_t k = 0; k < b->n && !held; k++) {
        const oracle_edge *e = &b->edge[k];
        const int side = turn(e->a, e->b, (const mpq_t *)p);
        held = (side == 0 && is_between(e, (const mpq_t *)p));
        const bool a_left = mpq_cmp(e->a[0], p[0]) <= 0, b_left = mpq_cmp(e->b[0], p[0]) <= 0;
        if (a_left != b_left && (a_left ? side < 0 : side > 0)) odd[e->member] = !odd[e->member];
    }
    for (size_t k = 0; k < b->members; k++) held = held || odd[k];
    free(odd);
    mpq_clears(p[0], p[1], NULL);
    return held;
}

/* The path from p by u, and the edge: a + x (b - a) = p + y u with 0 <= x, y <= 1, by Cramer's rule. */
static bool crosses(const oracle_edge *e, const mpq_t p[2], const mpq_t u[2])
{
    mpq_t d[2], w[2], det, x, y, h;
    mpq_inits(d[0], d[1], w[0], w[1], det, x, y, h, NULL);
    for (int k = 0; k < 2; k++) {
        mpq_sub(d[k], e->b[k], e->a[k]);
        mpq_sub(w[k], p[k], e->a[k]);
    }
    mpq_mul(det, d[0], u[1]);
    mpq_mul(h, d[1], u[0]);
    mpq_sub(det, det, h);
    bool meets = false;
    if (mpq_sgn(det)) {
        mpq_mul(x, w[0], u[1]);
        mpq_mul(h, w[1], u[0]);
        mpq_sub(x, x, h);
        mpq_div(x, x, det);
        mpq_mul(y, w[0], d[1]);
        mpq_mul(h, w[1], d[0]);
        mpq_sub(y, y, h);
        mpq_div(y, y, det);
        meets = mpq_sgn(x) >= 0 && mpq_cmp_ui(x, 1, 1) <= 0 && mpq_sgn(y) >= 0 && mpq_cmp_ui(y, 1, 1) <= 0;
    }
    mpq_clears(d[0], d[1], w[0], w[1], det, x, y, h, NULL);
    return meets;
}

/* Is an end of either on the other? Two collinear segments that meet always have such an end. */
static bool ends_meet(const oracle_edge *e, const mpq_t p[2], const mpq_t q[2])
{
    oracle_edge way;
    mpq_inits(way.a[0], way.a[1], way.b[0], way.b[1], NULL);
    for (int k = 0; k < 2; k++) {
        mpq_set(way.a[k], p[k]);
        mpq_set(way.b[k], q[k]);
    }
    const bool meets =
        (turn(e->a, e->b, p) == 0 && is_between(e, p)) || (turn(e->a, e->b, q) == 0 && is_between(e, q)) ||
        (turn(p, q, e->a) == 0 && is_between(&way, e->a)) || (turn(p, q, e->b) == 0 && is_between(&way, e->b));
    mpq_clears(way.a[0], way.a[1], way.b[0], way.b[1], NULL);
    return meets;
}

bool oracle_way_meets(const oracle_boundary *b, const double a[2], const double t[2], const double s[2])
{
    mpq_t p[2], q[2], u[2], h;
    mpq_inits(p[0], p[1], q[0], q[1], u[0], u[1], h, NULL);
    for (int k = 0; k < 2; k++) {
        mpq_set_d(p[k], a[k]);
        mpq_set_d(u[k], t[k]);
        mpq_set_d(h, s[k]);
        mpq_sub(u[k], u[k], h);
        mpq_add(q[k], p[k], u[k]);
    }
    const mpq_t *from = (const mpq_t *)p, *to = (const mpq_t *)q, *along = (const mpq_t *)u;
    bool meets = false;
    for (size_t k = 0; k < b->n && !meets; k++)
        meets = crosses(&b->edge[k], from, along) || ends_meet(&b->edge[k], from, to);
    mpq_clears(p[0], p[1], q[0], q[1], u[0], u[1], h, NULL);
    return meets;
}
