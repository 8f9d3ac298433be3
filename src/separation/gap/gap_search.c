/* gap_search.c: the search with a gap.
 *
 * As in the search without a gap, parts of the boundary are processed in the order of their distance from the origin
 * and shortened by what covers them. The difference is that points are irrational. Numbers with a known error
 * (gap_search.h) show that most of them are covered: a point, if its distance from a subsum is less than the gap by
 * more than all rounding errors; a segment, from one such point to another. Everything else is decided exactly, with
 * points that are fractions of integers and square roots (boundary_points.c), so that no wrong point is accepted or
 * discarded. Hence the first free point is the nearest one, and its length is the bound; ties are also broken exactly.
 *
 * If the nearest point is irrational, a rational one near it is returned (step_to_rational.c). */
#include "separation/gap/gap_search.h"

#include "base/invariant.h"

#include <float.h>
#include <math.h>

/* Returns a lower bound in doubles of the distance of an offset side from the origin. */
static double side_key(const sunder_i_gap_state *s, size_t segment)
{
    const sunder_i_candidate *c = s->p->segment + segment;
    const double *xy = s->g->xy[c->side], *q = s->g->xy[!c->side] + 2 * c->vertex;
    const double *a = xy + 2 * c->edge, *b = xy + 2 * s->g->shape[c->side]->form->cleaned.next[c->edge];
    const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy, f = s->p->gap_units / sqrt(square);
    const double x = a[0] + q[0] + f * dy, y = a[1] + q[1] - f * dx;
    double t = -(x * dx + y * dy) / square;
    t = t > 0 ? t < 1 ? t : 1 : 0;
    /* if the direction is inaccurate, or below the range of doubles, the distance of the side without offset, less the
     * gap, is used */
    if (s->g->coarse > 0 || !(square > SUNDER_I_SHORTEST * SUNDER_I_SHORTEST))
        return sqrt(c->square) - s->p->gap_units - 8 * s->g->error;
    return hypot(x + t * dx, y + t * dy) - 8 * s->g->error;
}

static void fill_heap(sunder_i_gap_state *s)
{
    const double far = s->best;
    for (size_t i = 0; i < s->p->segments && !s->failed; i++) {
        const double key = side_key(s, i);
        s->failed = s->failed || !sunder_i_step();
        if (!(key > far)) sunder_i_gap_push_item(s, (sunder_i_gap_item){key, SUNDER_I_GAP_SEGMENT, i});
    }
    for (size_t i = 0; i < s->p->centers && !s->failed; i++) {
        const sunder_i_lattice *l = &s->g->placed.lattice;
        const double x = sunder_i_approx(l, s->p->center[i].x), y = sunder_i_approx(l, s->p->center[i].y);
        const double key = fabs(hypot(x, y) - s->p->gap_units) - 8 * s->g->error;
        s->failed = s->failed || !sunder_i_step();
        sunder_i_gap_push_item(s, (sunder_i_gap_item){key, SUNDER_I_GAP_ARC, i});
    }
}

static bool set_up(sunder_i_gap_state *s)
{
    sunder_i_lattice *l = &s->g->placed.lattice;
    s->gap = sunder_i_gap_big(s->p->gap, -(long)s->p->gap_bits - l->approx_shift);
    s->error = 64 * DBL_EPSILON * (s->g->magnitude + s->gap); /* DBL_EPSILON = 2 u */
    s->margin = 2 * s->error;
    s->best = s->p->limit;
    s->pieces = sunder_i_arena_alloc(&l->arena, s->g->subsums + 1, sizeof *s->pieces);
    s->arcs = sunder_i_arena_alloc(&l->arena, s->p->centers + 1, sizeof *s->arcs);
    if (!s->pieces || !s->arcs) return false;
    for (size_t k = 0; k < s->g->subsums; k++) s->pieces[k].n = 0;
    return true;
}

static sunder_contact kind_of(const sunder_i_gap_free_point *f, sunder_i_gap_room room)
{
    bool flat = true, any_flat = false;
    for (size_t i = 0; i < f->contacts; i++) {
        flat = flat && f->contact[i].flat;
        any_flat = any_flat || f->contact[i].flat;
    }
    switch (room) {
    case SUNDER_I_ROOM_HALF: return any_flat ? SUNDER_CONTACT_EDGE : SUNDER_CONTACT_ARC;
    case SUNDER_I_ROOM_NONE: return SUNDER_CONTACT_DEGENERATE_POINT;
    case SUNDER_I_ROOM_LINE: return flat ? SUNDER_CONTACT_DEGENERATE_SEGMENT : SUNDER_CONTACT_VERTEX;
    default: return SUNDER_CONTACT_VERTEX;
    }
}

/* Converts the found point to the answer, and its length to the bound. */
static sunder_status conclude_search(sunder_i_gap_state *s, sunder_i_gap_answer *out, sunder_error *err)
{
    const sunder_i_gap_free_point *f = &s->found;
    *out = (sunder_i_gap_answer){.found = f->any};
    if (!f->any) return SUNDER_OK;
    const sunder_i_gap_way way = sunder_i_gap_way_off(s, f);
    out->contact = kind_of(f, way.room);
    out->about[0] = f->x;
    out->about[1] = f->y;
    sunder_i_big xy[2];
    const unsigned long bits = sunder_i_surd_point_digits(s->g, &f->exact, sunder_i_gap_length(f->x, f->y), xy);
    out->bound = sunder_i_surd_point_length_down(s->g, xy, bits);
    if (s->p->bound_only) return SUNDER_OK;
    if (sunder_i_surd_point_is_rational(&f->exact))
        out->at = f->exact;
    else if (!sunder_i_gap_rational_beside(s, f, &way, xy, bits, &out->at))
        return s->failed ? sunder_i_failure_cause(err)
                         : sunder_i_fail(err, SUNDER_EFAULT, "internal fault: no way off a free point");
    SUNDER_I_ASSERT(s->failed || out->at.roots.n == 0);
    return SUNDER_OK;
}

sunder_status sunder_i_gap_search(const sunder_i_gap_problem *problem, sunder_i_gap_answer *out, sunder_error *err)
{
    sunder_i_lattice *l = &problem->operands->placed.lattice;
    sunder_i_gap_state s = {.p = problem, .g = problem->operands};
    if (!set_up(&s)) return sunder_i_failure_cause(err);
    fill_heap(&s);
    while (s.heap_n && s.heap[0].key <= s.best && !s.failed && !l->arena.failed) {
        const sunder_i_gap_item i = sunder_i_gap_pop_item(&s);
        if (i.kind == SUNDER_I_GAP_SEGMENT)
            sunder_i_gap_take_segment(&s, i.index);
        else if (i.kind == SUNDER_I_GAP_ARC)
            sunder_i_gap_take_arc(&s, i.index);
        else
            sunder_i_gap_take_point(&s, i.index);
    }
    const sunder_status status = s.failed || l->arena.failed ? SUNDER_OK : conclude_search(&s, out, err);
    return s.failed || l->arena.failed ? sunder_i_failure_cause(err) : status;
}
