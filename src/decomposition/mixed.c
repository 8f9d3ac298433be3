/* mixed.c: decomposes both operands together, for a common objective: which decomposition of P is good depends on Q,
 * the result of [AFH02]. The objective is derived here.
 *
 * The cost of the union of the subsums P_i + Q_j grows with the total length of their boundaries, since the sides of k
 * subsums cross about as often as random lines in the same region. The perimeter of a sum of convex polygons is the sum
 * of their perimeters. So with k_P pieces, d_P the length of the diagonals, and b_P the length of the boundary (the
 * pieces of P have the total perimeter b_P + 2 d_P), the objective to minimise is
 *
 *     c = k_Q (b_P + 2 d_P) + k_P (b_Q + 2 d_Q).
 *
 * Neither few pieces nor short diagonals alone are optimal: the length of a diagonal of P counts k_Q times, one more
 * piece of P costs the total perimeter of Q. With Q fixed, c is a constant plus, for each diagonal of P, its length
 * times 2 k_Q plus b_Q + 2 d_Q: these are the weights of the dynamic programming in optimal.c, which finds the best P
 * for this Q (or nearly: see there). The two are solved alternately, beginning with the fewest pieces, until c does not
 * decrease: a local minimum of c, never worse than the optimal decompositions (if both can be computed). For polygons
 * with holes, or with too many vertices, the diagonals of the triangulation are removed once, the longest first.
 *
 * Lengths are doubles: they only select among exact decompositions. */
#include "decomposition/maker.h"

#include <math.h>
#include <string.h>

#define ROUNDS 8 /* the largest number of iterations; two or three usually suffice */

/* One operand, with its maker. */
typedef struct side {
    sunder_i_maker *m;
    sunder_i_program **program; /* [polygons] NULL if there is none */
    sunder_i_mesh *mesh;        /* [polygons] the meshes of reflex polygons without a program */
    uint32_t *diagonals;        /* [polygons] the number of diagonals of the last solution */
    double *lengths;
    double boundary;
    double pieces, perimeters; /* sums over all pieces: k, and b + 2 d */
} side;

static double boundary_of(const sunder_i_rings *r)
{
    double sum = 0;
    for (uint32_t v = 0; v < r->vertices; v++) {
        const double *a = r->xy + 2 * (size_t)v, *b = r->xy + 2 * (size_t)r->next[v];
        sum += hypot(a[0] - b[0], a[1] - b[1]);
    }
    return sum;
}

static void total_side(side *s)
{
    s->pieces = 0;
    s->perimeters = s->boundary;
    for (uint32_t i = 0; i < s->m->rings.polygons; i++) {
        const sunder_i_member member = sunder_i_maker_member(s->m, i);
        s->pieces += 2 + s->diagonals[i] - (double)(member.ring_hi - member.ring_lo);
        s->perimeters += 2 * s->lengths[i];
    }
}

static bool prepare_side(side *s, sunder_i_maker *m)
{
    const uint32_t polygons = m->rings.polygons;
    s->m = m;
    s->program = sunder_i_arena_alloc(&m->scratch, polygons, sizeof *s->program);
    s->mesh = sunder_i_arena_alloc(&m->scratch, polygons, sizeof *s->mesh);
    s->diagonals = sunder_i_arena_alloc(&m->scratch, polygons, sizeof *s->diagonals);
    s->lengths = sunder_i_arena_alloc(&m->scratch, polygons, sizeof *s->lengths);
    if (m->scratch.failed) return false;
    s->boundary = boundary_of(&m->rings);
    for (uint32_t i = 0; i < polygons; i++) {
        s->program[i] = NULL;
        s->diagonals[i] = 0;
        s->lengths[i] = 0;
    }
    for (uint32_t i = 0; i < polygons && !sunder_i_maker_failed(m); i++) {
        const sunder_i_member member = sunder_i_maker_member(m, i);
        if (!member.reflex) continue;
        if (sunder_i_has_program(&member)) {
            s->program[i] = sunder_i_program_new(m, &member);
        } else {
            m->fallbacks++;
            sunder_i_mesh_short(m, &member, &s->mesh[i], &s->diagonals[i], &s->lengths[i]);
        }
    }
    return !sunder_i_maker_failed(m);
}

static bool solve_side(side *s, double each, double by_length)
{
    for (uint32_t i = 0; i < s->m->rings.polygons; i++)
        if (s->program[i] && !sunder_i_program_solve(s->program[i], each, by_length, &s->diagonals[i], &s->lengths[i]))
            return false;
    total_side(s);
    return true;
}

static double objective_of(const side *p, const side *q)
{
    return q->pieces * p->perimeters + p->pieces * q->perimeters;
}

static bool solve_both(side *p, side *q)
{
    double weight[2][2] = {{1, 0}, {1, 0}}; /* the weights of the diagonals of p and of q: `each`, and by length */
    if (!solve_side(p, 1, 0) || !solve_side(q, 1, 0)) return false;
    double least = objective_of(p, q);
    for (int i = 0; i < ROUNDS; i++) {
        const double for_p[2] = {q->perimeters, 2 * q->pieces};
        if (!solve_side(p, for_p[0], for_p[1])) return false;
        const double for_q[2] = {p->perimeters, 2 * p->pieces};
        if (!solve_side(q, for_q[0], for_q[1])) return false;
        const double now = objective_of(p, q);
        /* The best solution is computed again, with its weights. */
        if (now > least) return solve_side(p, weight[0][0], weight[0][1]) && solve_side(q, weight[1][0], weight[1][1]);
        if (now == least) break;
        least = now;
        memcpy(weight[0], for_p, sizeof for_p);
        memcpy(weight[1], for_q, sizeof for_q);
    }
    return true;
}

static void emit_pieces(side *s)
{
    sunder_i_maker *m = s->m;
    for (; m->polygon < m->rings.polygons; m->polygon++) {
        const sunder_i_member member = sunder_i_maker_member(m, m->polygon);
        if (sunder_i_maker_failed(m))
            return; /* without exact numbers a convex polygon may seem reflex, for which there
                                               * is no mesh */
        if (s->program[m->polygon])
            sunder_i_program_emit(s->program[m->polygon], m);
        else if (member.reflex)
            sunder_i_maker_add_faces(m, &s->mesh[m->polygon]);
        else
            sunder_i_maker_add_whole(m, &member);
    }
}

static void release_side(side *s)
{
    for (uint32_t i = 0; s->program && i < s->m->rings.polygons; i++) sunder_i_program_free(s->program[i]);
}

void sunder_i_make_mixed(sunder_i_maker *p, sunder_i_maker *q)
{
    side a = {0}, b = {0};
    if (prepare_side(&a, p) && prepare_side(&b, q) && p->rings.polygons && q->rings.polygons) {
        if (solve_both(&a, &b)) {
            emit_pieces(&a);
            emit_pieces(&b);
        }
        /* one operand is empty: the other is decomposed alone */
    } else if (!sunder_i_maker_failed(p) && !sunder_i_maker_failed(q)) {
        if (solve_side(&a, 1, 0) && solve_side(&b, 1, 0)) {
            emit_pieces(&a);
            emit_pieces(&b);
        }
    }
    release_side(&a);
    release_side(&b);
}
