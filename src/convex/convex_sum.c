/* convex_sum.c: the sum of two pieces whose corners may be Steiner points, (x / w, y / w): directions are lattice
 * vectors all the same, so that only corners need long numbers, and each corner is computed once. */
#include "convex/convex_sum.h"

#include "convex/merge.h"
#include "predicate/predicate.h"

static bool make_room(sunder_i_arena *arena, uint32_t most, sunder_i_convex_sum *s)
{
    s->corners = 0;
    s->at = sunder_i_arena_alloc(arena, most, sizeof *s->at);
    s->along = sunder_i_arena_alloc(arena, most, sizeof *s->along);
    s->of_p = sunder_i_arena_alloc(arena, most, sizeof *s->of_p);
    s->of_q = sunder_i_arena_alloc(arena, most, sizeof *s->of_q);
    s->side_p = sunder_i_arena_alloc(arena, most, sizeof *s->side_p);
    s->side_q = sunder_i_arena_alloc(arena, most, sizeof *s->side_q);
    return !arena->failed;
}

bool sunder_i_convex_sum_of(sunder_i_lattice *lattice, const sunder_i_decomposition *p, uint32_t i,
                            const sunder_i_decomposition *q, uint32_t j, sunder_i_arena *arena,
                            sunder_i_convex_sum *out)
{
    const uint32_t pf = sunder_i_piece_first(p, i), pe = p->piece_end[i];
    const uint32_t qf = sunder_i_piece_first(q, j), qe = q->piece_end[j];
    sunder_i_convex_sum s;
    if (!make_room(arena, pe - pf + qe - qf, &s)) return false;
    sunder_i_merge m = sunder_i_merge_of(pe - pf, qe - qf);
    while (SUNDER_I_MERGE_NEXT(&m, sunder_i_angle_cmp(lattice, p->along[pf + m.next_a], q->along[qf + m.next_b]))) {
        const uint32_t k = s.corners++;
        s.of_p[k] = p->piece_corner[pf + m.a];
        s.of_q[k] = q->piece_corner[qf + m.b];
        s.at[k] = sunder_i_rational_add(arena, p->corner[s.of_p[k]].at, q->corner[s.of_q[k]].at);
        s.side_p[k] = m.of_a;
        s.side_q[k] = m.of_b;
        s.along[k] = m.of_a ? p->along[pf + m.a] : q->along[qf + m.b];
    }
    if (arena->failed || lattice->arena.failed) return false;
    *out = s;
    return true;
}
