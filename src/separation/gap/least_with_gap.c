/* least_with_gap.c: computes the least translation that leaves a gap g between two sets.
 *
 * The problem is placed on the lattice, with the gap as a separate fraction, so that a gap with many digits does not
 * make the lattice finer. The origin is tested first. Then the candidates for the boundary are listed, either all of
 * them or those that the search by squares finds, and the search begins (gap_search.c). Its result, and the doubles
 * nearest to it, are verified against every pair of pieces (verify_gap.c). */
#include "separation/gap/gap_search.h"

#include "base/sort.h"
#include "separation/squares/squares.h"

#include <math.h>

/* Finds the centres of arcs: sums of two convex vertices. Other vertices never lie on the boundary of the obstacle. */
static bool find_centers(sunder_i_gap_problem *p)
{
    sunder_i_operands *g = p->operands;
    sunder_i_arena *arena = &g->placed.lattice.arena;
    uint64_t *key = sunder_i_arena_alloc(arena, 2 * p->segments + 1, sizeof *key);
    if (!key) return false;
    size_t n = 0;
    for (size_t i = 0; i < p->segments; i++) {
        const sunder_i_candidate *c = p->segment + i;
        const uint32_t end[2] = {c->edge, g->shape[c->side]->form->cleaned.next[c->edge]};
        for (int k = 0; k < 2; k++) {
            const uint32_t u = c->side ? c->vertex : end[k], v = c->side ? end[k] : c->vertex;
            key[n++] = (uint64_t)u << 32 | v;
        }
    }
    if (!sunder_i_sort_keys(key, n)) return false;
    sunder_i_point *center = sunder_i_arena_alloc(arena, n + 1, sizeof *center);
    if (!center) return false;
    for (size_t i = 0; i < n; i++) {
        if (i && key[i] == key[i - 1]) continue;
        center[p->centers++] = sunder_i_operands_add(g, g->at[0][key[i] >> 32], g->at[1][key[i] & UINT32_MAX]);
    }
    p->center = center;
    return true;
}

/* Returns the length of a translation along an axis that certainly leaves the gap. */
static double way_out(const sunder_i_operands *g, double gap)
{
    return (sunder_i_operands_way_out(g) + gap) * SUNDER_I_GAP_MORE + 64 * g->error;
}

/* Returns whether every subsum keeps the gap from the origin. *memory becomes false if out of memory. */
static bool origin_free(const sunder_i_gap_problem *p, bool *memory)
{
    sunder_i_operands *g = p->operands;
    sunder_i_arena *a = &g->placed.lattice.arena;
    const sunder_i_rational_point zero = {{NULL, 0}, {NULL, 0}, sunder_i_big_i64(a, 1)};
    const sunder_i_surd_point origin = sunder_i_surd_point_rational(g, zero);
    for (size_t k = 0; k < g->subsums; k++) {
        sunder_i_subsum *s = g->subsum + k;
        const double r = p->gap_units + 2 * g->error;
        if (s->box[0] > r || s->box[2] < -r || s->box[1] > r || s->box[3] < -r) continue;
        if (!s->sides && !sunder_i_subsum_make(g, s)) {
            *memory = false;
            return false;
        }
        uint32_t side;
        bool flat;
        /* doubles first: the origin is inside, closer to a side than the gap, or beyond the line of a side by more than
         * the gap */
        bool far = false, inside = true, near = false;
        for (uint32_t i = 0; i < s->sides && !far; i++) {
            const double turn = s->sy[i] * s->cx[i] - s->sx[i] * s->cy[i];
            const double length = sqrt(s->sx[i] * s->sx[i] + s->sy[i] * s->sy[i]);
            far = length > SUNDER_I_SHORTEST && turn < -s->bound[i] - r * SUNDER_I_GAP_MORE * length;
            inside = inside && turn > s->bound[i];
            const double square =
                sunder_i_segment_square(s->cx[i], s->cy[i], s->sx[i], s->sy[i], 1 / (length * length));
            near = near || sqrt(square) + 16 * g->error < p->gap_units * (1 - 0x1p-50);
        }
        if (inside || near || (!far && sunder_i_gap_cmp(p, s, &origin, &side, &flat) < 0)) return false;
    }
    return true;
}

static sunder_status run_search(sunder_i_gap_problem *p, sunder_i_gap_answer *answer, sunder_error *err)
{
    sunder_i_candidates heap;
    if (!p->quadtree) {
        if (!sunder_i_candidates_find(p->operands, p->limit + p->gap_units, &heap)) return sunder_i_failure_cause(err);
        p->segment = heap.item;
        p->segments = heap.n;
    }
    return find_centers(p) ? sunder_i_gap_search(p, answer, err) : sunder_i_failure_cause(err);
}

/* Returns whether the translation (dx, dy) of doubles keeps the gap, too. Exact. */
static bool doubles_free(const sunder_i_gap_problem *p, double dx, double dy)
{
    sunder_i_operands *g = p->operands;
    if (!isfinite(dx) || !isfinite(dy)) return false;
    const sunder_i_surd_point at = sunder_i_surd_point_doubles(g, dx, dy);
    return !g->placed.lattice.arena.failed && sunder_i_gap_verify(p, &at);
}

static sunder_status fill_answer(sunder_i_gap_problem *p, const sunder_i_gap_answer *a, bool texts,
                                 sunder_separation *out, sunder_error *err)
{
    sunder_i_operands *g = p->operands;
    if (p->bound_only) {
        out->overlap = true;
        out->lower_bound = a->bound * g->unit * (1 - 0x1p-50);
        out->dx = a->about[0] * g->unit;
        out->dy = a->about[1] * g->unit;
        return SUNDER_OK;
    }
    const sunder_i_exact_translation v = {.big = sunder_i_surd_point_of(&a->at)};
    sunder_i_answer_numbers(g, &v, out);
    const double bound = a->bound * g->unit * (1 - 0x1p-50);
    if (bound < out->lower_bound) out->lower_bound = bound;
    out->overlap = out->attained = true;
    out->contact = a->contact;
    out->rounded_is_free = sunder_i_answer_exact(g, &v, out->dx, out->dy) || doubles_free(p, out->dx, out->dy);
    if (g->placed.lattice.arena.failed) return sunder_i_failure_cause(err);
    if (!sunder_i_gap_verify(p, &a->at) && !g->placed.lattice.arena.failed)
        return sunder_i_fail(err, SUNDER_EFAULT, "internal fault: a translation failed its exact check");
    if (g->placed.lattice.arena.failed) return sunder_i_failure_cause(err);
    return texts ? sunder_i_answer_texts(g, &v, out, err) : SUNDER_OK;
}

/* Operands with at least this number of pairs of pieces, after pieces with many vertices are cut, are searched by
 * squares. The number is smaller than without a gap, since here a point is tested against all listed subsums, and
 * all arcs are intersected with each other. */
#define SQUARES_FROM 4096

/* Searches by squares, with pieces of few vertices. If the method does not suit the operands they are restored. Returns
 * false if out of memory. */
static bool take_squares(sunder_i_gap_problem *p, sunder_i_gap_quadtree *quadtree)
{
    sunder_i_operands *g = p->operands;
    const sunder_i_operands whole = *g;
    bool done;
    if (!sunder_i_operands_cut(g) || !sunder_i_gap_by_squares(p, quadtree, &done)) return false;
    if (!done) sunder_i_operands_uncut(g, &whole);
    return true;
}

static bool are_many(const sunder_i_gap_problem *p, const sunder_i_least_options *o)
{
    const sunder_i_operands *g = p->operands;
    /* boxes exist on a narrow lattice only */
    if (!g->placed.lattice.narrow || !(p->gap_units < g->magnitude)) return false;
    return o->force_squares || sunder_i_squares_worth(g, SQUARES_FROM);
}

static sunder_status solve_problem(sunder_i_gap_problem *p, const sunder_i_least_options *o,
                                   sunder_i_gap_quadtree *quadtree, sunder_separation *out, bool *beyond,
                                   sunder_error *err)
{
    sunder_i_operands *g = p->operands;
    const double upper = o->upper / g->unit;
    /* near the ends of the range of doubles the bound is computed from the exact answer */
    p->bound_only = o->bound_only && g->unit > 0x1p-400 && g->unit < 0x1p400;
    p->limit = way_out(g, p->gap_units);
    if (upper < p->limit) p->limit = upper * SUNDER_I_GAP_MORE + 8 * g->error;
    if (are_many(p, o) && !take_squares(p, quadtree)) return sunder_i_failure_cause(err);
    if (!p->quadtree && !sunder_i_operands_reach(g, p->limit + p->gap_units)) return sunder_i_failure_cause(err);
    bool memory = true;
    if (origin_free(p, &memory)) return memory ? sunder_i_stay(o->texts, out, err) : sunder_i_failure_cause(err);
    if (!memory || g->placed.lattice.arena.failed) return sunder_i_failure_cause(err);
    sunder_i_gap_answer answer;
    const sunder_status status = run_search(p, &answer, err);
    if (status) return status;
    if (answer.found && !(answer.bound * g->unit > o->upper)) return fill_answer(p, &answer, o->texts, out, err);
    if (!(o->upper < INFINITY)) /* there is always a translation that separates two sets */
        return sunder_i_fail(err, SUNDER_EFAULT, "internal fault: no free translation was found");
    sunder_i_too_far(o->upper, out, beyond);
    return SUNDER_OK;
}

/* Places the operands and the gap. A gap that is far larger than the operands becomes part of the lattice, too, whose
 * unit then suits it. */
static sunder_status set_up(sunder_i_operands *g, sunder_i_gap_problem *problem, const sunder_shape *p,
                            const sunder_shape *q, const sunder_i_least_options *o, bool gap_on_lattice,
                            sunder_error *err)
{
    const sunder_i_operands_options options = {.tp = o->tp,
                                               .tq = o->tq,
                                               .reflect_q = true,
                                               .force_wide = o->force_wide,
                                               .extra = &o->gap,
                                               .extra_n = gap_on_lattice};
    const sunder_status status = sunder_i_operands_init(g, p, q, &options, err);
    if (status) return status;
    sunder_i_lattice *l = &g->placed.lattice;
    *problem = (sunder_i_gap_problem){.operands = g, .over = sunder_i_big_i64(&l->arena, 1)};
    const sunder_i_rational_point gap = sunder_i_doubles_point(g, o->gap, 0);
    problem->gap = gap.x;
    problem->gap_bits = sunder_i_big_bits(gap.w) - (l->arena.failed ? 0 : 1);
    problem->gap_units = sunder_i_big_ratio(&l->arena, gap.x, gap.w, -l->approx_shift);
    return SUNDER_OK;
}

sunder_status sunder_i_least_with_gap(const sunder_shape *p, const sunder_shape *q,
                                      const sunder_i_least_options *options, sunder_separation *out, bool *beyond,
                                      sunder_error *err)
{
    sunder_i_operands g;
    sunder_i_gap_problem problem;
    sunder_status status = set_up(&g, &problem, p, q, options, false, err);
    if (status) return status;
    if (!(problem.gap_units <= 0x1p400) && !g.placed.lattice.arena.failed) {
        sunder_i_operands_free(&g);
        status = set_up(&g, &problem, p, q, options, true, err);
        if (status) return status;
    }
    sunder_i_operands_admit(&g, problem.gap_units);
    sunder_i_gap_quadtree quadtree = {.node = NULL};
    status = g.placed.lattice.arena.failed ? sunder_i_failure_cause(err)
                                           : solve_problem(&problem, options, &quadtree, out, beyond, err);
    sunder_i_gap_quadtree_free(&quadtree);
    out->counts = g.placed.lattice.counts;
    sunder_i_operands_free(&g);
    return status;
}
