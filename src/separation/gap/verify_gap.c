/* verify_gap.c: the exact verification of a result with a gap. It tests the sides of the pieces against vertices of the
 * other operand and shares only the arithmetic with the search. Doubles select the sides and vertices that are near
 * (errors as in gap_search.h). */
#include "separation/gap/gap.h"

#include "predicate/rational_point.h"

#include <float.h>
#include <math.h>

typedef struct checking {
    const sunder_i_gap_problem *p;
    sunder_i_operands *g;
    sunder_i_rational_point t; /* the translation */
    double at[2], gap, doubt;
} checking;

/* A side of a piece in relation to vertices of the other operand: q + t - p = t - (p + (-q)), since Q is reflected in
 * the operands. For a side of Q everything is reflected in t / 2. */
typedef struct side {
    sunder_i_point a, d;
    double x, y, dx, dy, length; /* t - a, d and |d|; the length is NaN if it is too short for doubles: then every
                                  * comparison is false */
} side;

static side side_of(const checking *c, const sunder_i_operand_piece *p, uint32_t k)
{
    const sunder_i_lattice *l = &c->g->placed.lattice;
    const sunder_i_point *at = c->g->at[p->side];
    const double *a = c->g->xy[p->side] + 2 * p->corner[k];
    side s = {.a = at[p->corner[k]], .x = c->at[0] - a[0], .y = c->at[1] - a[1]};
    s.d = sunder_i_operands_diff(c->g, at[sunder_i_piece_next(p, k)], s.a);
    s.dx = sunder_i_approx(l, s.d.x);
    s.dy = sunder_i_approx(l, s.d.y);
    s.length = sqrt(s.dx * s.dx + s.dy * s.dy);
    if (!(s.length > SUNDER_I_SHORTEST)) s.length = NAN;
    return s;
}

/* Returns the signed distance of t - c, where c is vertex m of q, from the line of side s, positive on the outer
 * (right) side. */
static double height_over(const checking *c, const side *s, const sunder_i_operand_piece *q, uint32_t m)
{
    const double *b = c->g->xy[q->side] + 2 * q->corner[m];
    return (s->dy * (s->x - b[0]) - s->dx * (s->y - b[1])) / s->length;
}

/* Returns whether the distance of the vertex from the side certainly exceeds the gap. */
static bool certainly_off(const checking *c, const side *s, const sunder_i_operand_piece *q, uint32_t m)
{
    const double h = height_over(c, s, q, m), reach = c->gap + c->doubt;
    if (fabs(h) > reach) return true;
    const double *b = c->g->xy[q->side] + 2 * q->corner[m], x = s->x - b[0], y = s->y - b[1];
    const double along = (s->dx * x + s->dy * y) / s->length, past = along < 0 ? -along : along - s->length;
    return past > 0 && h * h + past * past > reach * reach;
}

typedef struct exact {
    sunder_i_big turn, along, norm, square; /* cross and dot product of the side with the vector from its first end to
                                             * the vertex, and the squared length of that vector, each times w; the
                                             * squared length of the side */
    sunder_i_big over;                      /* the factor by which all these are scaled from lattice units */
} exact;

static exact exact_of(const checking *c, const side *s, const sunder_i_operand_piece *q, uint32_t m)
{
    sunder_i_lattice *l = &c->g->placed.lattice;
    sunder_i_arena *a = &l->arena;
    const sunder_i_point sum = sunder_i_operands_add(c->g, s->a, c->g->at[q->side][q->corner[m]]);
    const sunder_i_rational_point at = sunder_i_rational_get(a, l, sum), d = sunder_i_rational_get(a, l, s->d);
    const sunder_i_big over = sunder_i_times(a, at.w, d.w);
    const sunder_i_big x =
        sunder_i_big_sub(a, sunder_i_times(a, c->t.x, over), sunder_i_times(a, sunder_i_big_mul(a, at.x, c->t.w), d.w));
    const sunder_i_big y =
        sunder_i_big_sub(a, sunder_i_times(a, c->t.y, over), sunder_i_times(a, sunder_i_big_mul(a, at.y, c->t.w), d.w));
    const sunder_i_big dx = sunder_i_times(a, d.x, at.w), dy = sunder_i_times(a, d.y, at.w);
    return (exact){sunder_i_big_sub(a, sunder_i_big_mul(a, dx, y), sunder_i_big_mul(a, dy, x)),
                   sunder_i_big_add(a, sunder_i_big_mul(a, dx, x), sunder_i_big_mul(a, dy, y)),
                   sunder_i_big_norm(a, x, y), sunder_i_big_norm(a, dx, dy), over};
}

/* Returns whether the distance of the vertex from the side, without its second end (the first end of the next side), is
 * not less than the gap. */
static bool keeps_off(const checking *c, const side *s, const sunder_i_operand_piece *q, uint32_t m)
{
    if (certainly_off(c, s, q, m)) return true;
    sunder_i_arena *a = &c->g->placed.lattice.arena;
    const sunder_i_mark mark = sunder_i_arena_mark(a);
    const exact e = exact_of(c, s, q, m);
    const sunder_i_big gw = sunder_i_times(a, sunder_i_big_mul(a, c->p->gap, c->t.w), e.over);
    const sunder_i_big limit = sunder_i_big_mul(a, gw, gw);
    bool off = true;
    if (sunder_i_big_sign(e.along) <= 0)
        off = sunder_i_big_cmp(sunder_i_big_shl(a, e.norm, 2 * c->p->gap_bits), limit) >= 0;
    else if (sunder_i_big_cmp(e.along, sunder_i_big_mul(a, e.square, c->t.w)) < 0)
        off = sunder_i_big_cmp(sunder_i_big_shl(a, sunder_i_big_mul(a, e.turn, e.turn), 2 * c->p->gap_bits),
                               sunder_i_big_mul(a, limit, e.square)) >= 0;
    sunder_i_arena_release(a, mark);
    return off;
}

/* Returns whether the vertex is on the right of the side's line, or on it. */
static bool is_outside(const checking *c, const side *s, const sunder_i_operand_piece *q, uint32_t m)
{
    const double h = height_over(c, s, q, m);
    if (h > c->doubt) return true;
    if (h < -c->doubt) return false;
    sunder_i_arena *a = &c->g->placed.lattice.arena;
    const sunder_i_mark mark = sunder_i_arena_mark(a);
    const bool outside = sunder_i_big_sign(exact_of(c, s, q, m).turn) <= 0;
    sunder_i_arena_release(a, mark);
    return outside;
}

typedef enum parting { PARTED_NOT, PARTED, PARTED_FAR } parting;

/* Returns whether a side of p has all of q on its right or on its line; *by becomes such a side. PARTED_FAR: all of q
 * is certainly farther than the gap from one side's line, which settles the pair. */
static parting side_parts(const checking *c, const sunder_i_operand_piece *p, const sunder_i_operand_piece *q, side *by)
{
    bool parts = false;
    if (p->n < 2) return PARTED_NOT; /* a point has no sides */
    for (uint32_t k = 0; k < p->n; k++) {
        const side s = side_of(c, p, k);
        uint32_t m = 0;
        while (m < q->n && height_over(c, &s, q, m) > c->gap + c->doubt) m++;
        if (m == q->n) return PARTED_FAR;
        while (!parts && m < q->n && is_outside(c, &s, q, m)) m++;
        if (parts || m < q->n) continue;
        parts = true;
        *by = s;
    }
    return parts ? PARTED : PARTED_NOT;
}

/* The vertices of p and of q that may be within the gap of the other piece. All of q is on the right of side `by` of p,
 * so that a vertex farther than the gap from its line is farther than that from the other piece. */
typedef struct close_by {
    uint32_t *p, *q, pn, qn;
} close_by;

static close_by find_close(const checking *c, const sunder_i_operand_piece *p, const sunder_i_operand_piece *q,
                           const side *by)
{
    close_by b = {sunder_i_arena_alloc(&c->g->placed.lattice.arena, (size_t)p->n + q->n, sizeof *b.p), NULL, 0, 0};
    if (!b.p) return b;
    b.q = b.p + p->n;
    const double most = c->gap + c->doubt;
    for (uint32_t m = 0; m < q->n; m++)
        if (!(height_over(c, by, q, m) > most)) b.q[b.qn++] = m;
    for (uint32_t m = 0; m < p->n; m++) {
        const double *at = c->g->xy[p->side] + 2 * p->corner[m];
        /* the vector from the vertex to the first end of the side */
        const double x = c->at[0] - at[0] - by->x, y = c->at[1] - at[1] - by->y;
        if (!((by->dy * x - by->dx * y) / by->length > most)) b.p[b.pn++] = m;
    }
    return b;
}

static bool corners_keep_off(const checking *c, const sunder_i_operand_piece *p, const sunder_i_operand_piece *q,
                             const uint32_t *corner, uint32_t n)
{
    for (uint32_t k = 0; k < p->n; k++) {
        const side s = side_of(c, p, k);
        for (uint32_t m = 0; m < n; m++)
            if (!keeps_off(c, &s, q, corner[m])) return false;
    }
    return true;
}

static bool pieces_apart(const checking *c, const sunder_i_operand_piece *p, const sunder_i_operand_piece *q)
{
    side by;
    parting how = side_parts(c, p, q, &by);
    if (how == PARTED_NOT) {
        const sunder_i_operand_piece *other = p;
        p = q;
        q = other;
        how = side_parts(c, p, q, &by);
    }
    if (how != PARTED) return how == PARTED_FAR;
    sunder_i_arena *arena = &c->g->placed.lattice.arena;
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    const close_by b = find_close(c, p, q, &by);
    const bool off = b.p && corners_keep_off(c, p, q, b.q, b.qn) && corners_keep_off(c, q, p, b.p, b.pn);
    if (!arena->failed) sunder_i_arena_release(arena, mark);
    return off;
}

bool sunder_i_gap_verify(const sunder_i_gap_problem *problem, const sunder_i_surd_point *t)
{
    sunder_i_operands *g = problem->operands;
    sunder_i_lattice *l = &g->placed.lattice;
    checking c = {.p = problem, .g = g, .t = sunder_i_surd_point_of(t)};
    c.gap = problem->gap_units;
    sunder_i_rational_doubles(&l->arena, c.t, -l->approx_shift, &c.at[0], &c.at[1]);
    c.doubt = 256 * DBL_EPSILON * (g->magnitude + c.gap);
    const double reach = problem->gap_units * (1 + 0x1p-50) + 4 * g->error;
    for (uint32_t i = 0; i < g->shape[0]->pieces; i++) {
        const sunder_i_operand_piece u = sunder_i_operands_piece(g, 0, i);
        for (uint32_t j = 0; j < g->shape[1]->pieces; j++) {
            const double *a = g->piece_box[0] + 4 * (size_t)i, *b = g->piece_box[1] + 4 * (size_t)j;
            if (!sunder_i_box_sum_near_point(a, b, c.at[0], c.at[1], reach)) continue;
            const sunder_i_operand_piece v = sunder_i_operands_piece(g, 1, j);
            if (!pieces_apart(&c, &u, &v)) return false;
        }
    }
    return true;
}
