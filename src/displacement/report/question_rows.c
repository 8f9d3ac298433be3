/* Rows in a question about a remaining conflict. Rows are not looked for in the small layer, which has only a part of
 * them: it gets the rule of the whole layer for each two neighbours of which it has both, as seen from where the fixed
 * one stands in the result. A solution is then tested against the rule of the whole layer, which has all neighbours.
 *
 * With a smaller gap less is demanded. A pair that would not be in conflict with it may be demanded to come no nearer
 * along the row, which is no less than the rule. */
#include "displacement/layer/reads.h"
#include "displacement/report/question.h"

#include "base/extremes.h"

#include <math.h>

/* Returns what the rule demands of a body and a neighbour that do not remain in conflict, with this gap, or their own
 * gap if that is less. */
static double least_with(const sunder_i_model *whole, uint32_t body, const sunder_i_row_side *side, double gap)
{
    const double own = sunder_i_row_gap(whole, whole->class_gap, whole->rules.gap, body, side->other);
    if (side->least == 0 || gap >= own) return side->least;
    if (side->least < 0 && (whole->rules.full_gap > whole->rules.gap || whole->class_slack))
        return side->least; /* it keeps the full gap */
    const double least = nextafter(side->least - (own - gap), INFINITY);
    return side->least > 0 ? sunder_i_max(least, 0) : least;
}

/* Returns the place in the small layer of the first feature of a body, apart from `gone`; SIZE_MAX if there is none. */
static size_t place_of_body(const sunder_i_surroundings *a, const sunder_i_model *whole, uint32_t body, uint32_t gone)
{
    for (size_t k = 0; k < a->feature.n; k++)
        if (whole->body_of[a->feature.item[k]] == body && a->feature.item[k] != gone) return k;
    return SIZE_MAX;
}

/* Records that the question depends on which neighbours the body has in rows, and on where they stand. */
static void note_neighbours(const sunder_i_solver *solver, uint32_t body)
{
    const sunder_i_model *model = &solver->model;
    const sunder_i_extras *has = model->body[body].has;
    sunder_i_reading *to = sunder_i_reads;
    if (!to || to->model != model || !solver->rows.reach) return;
    sunder_i_box_join(to->box.seen, solver->rows.reach[body]);
    for (uint32_t e = has->row_side; e < has->row_side + has->row_sides; e++) {
        const uint32_t other = model->row_side[e].other;
        double box[4];
        sunder_i_body_box(&model->body[other], model->move + 2 * (size_t)other, 0, box);
        sunder_i_box_join(to->box.place, box);
    }
}

sunder_status sunder_i_question_rows(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                                     const sunder_i_supposition *what, sunder_i_row_demand **list, size_t *n,
                                     sunder_error *err)
{
    const sunder_i_surroundings *a = surroundings;
    const sunder_i_model *whole = &questions->solver->model;
    size_t capacity = 0;
    *list = NULL;
    *n = 0;
    for (size_t k = 0; k < a->moving && whole->row_sides; k++) {
        const uint32_t body = whole->body_of[a->feature.item[k]];
        const sunder_i_extras *has = whole->body[body].has;
        if (place_of_body(a, whole, body, what->gone) != k) continue;
        note_neighbours(questions->solver, body);
        for (uint32_t e = has->row_side; e < has->row_side + has->row_sides; e++) {
            const sunder_i_row_side *side = &whole->row_side[e];
            const size_t other = place_of_body(a, whole, side->other, what->gone);
            if (side->least == -INFINITY || other == SIZE_MAX || (other < a->moving && other < k)) continue;
            if (!sunder_i_reserve(list, &capacity, *n + 1, sizeof **list)) return sunder_i_failure_cause(err);
            sunder_i_row_demand *d = &(*list)[(*n)++];
            *d = (sunder_i_row_demand){.a = (uint32_t)k,
                                       .b = (uint32_t)other,
                                       .along = {side->along[0], side->along[1]},
                                       .least = least_with(whole, body, side, what->gap),
                                       .least_listed = side->least_listed};
            if (other < a->moving) continue;
            const double *s = whole->move + 2 * (size_t)side->other, stands = s[0] * d->along[0] + s[1] * d->along[1];
            d->least -= stands;
            d->least_listed -= stands;
        }
    }
    return SUNDER_OK;
}

/* Does the small layer leave a pair of these two bodies of the whole layer in conflict? */
static bool is_left(const sunder_i_surroundings *a, const sunder_i_model *whole, const sunder_i_solver *x,
                    uint32_t gone, uint32_t body, uint32_t other)
{
    for (size_t k = 0; k < x->now.n; k++) {
        const sunder_i_relation *r = &x->now.pair[k];
        if (!sunder_i_is_conflict_of_bodies(&x->model, r)) continue;
        const uint32_t i = whole->body_of[sunder_i_surroundings_number(a, whole, x, r->a, gone)],
                       j = whole->body_of[sunder_i_surroundings_number(a, whole, x, r->b, gone)];
        if ((i == body && j == other) || (i == other && j == body)) return true;
    }
    return false;
}

/* Sets *t to the move of a body in the small layer, if it moves there, otherwise in the result. */
static void find_move(const sunder_i_surroundings *a, const sunder_i_model *whole, const sunder_i_solver *x,
                      uint32_t body, double t[2])
{
    const double *from = whole->move + 2 * (size_t)body;
    for (size_t k = 0; k < x->model.features; k++) {
        const size_t at = x->layer.number[k];
        if (at < a->moving && whole->body_of[a->feature.item[at]] == body)
            from = x->model.move + 2 * (size_t)x->model.body_of[k];
    }
    t[0] = from[0];
    t[1] = from[1];
}

bool sunder_i_question_leaves_row(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                                  const sunder_i_solver *small, const sunder_i_supposition *what)
{
    const sunder_i_surroundings *a = surroundings;
    const sunder_i_model *whole = &questions->solver->model;
    for (size_t k = 0; k < a->moving && whole->row_sides; k++) {
        const uint32_t body = whole->body_of[a->feature.item[k]];
        const sunder_i_extras *has = whole->body[body].has;
        if (place_of_body(a, whole, body, what->gone) != k) continue;
        double t[2], s[2];
        find_move(a, whole, small, body, t);
        for (uint32_t e = has->row_side; e < has->row_side + has->row_sides; e++) {
            const sunder_i_row_side *side = &whole->row_side[e];
            const sunder_i_body *other = &whole->body[side->other];
            if (other->members == 1 && whole->member[other->member] == what->gone) continue;
            find_move(a, whole, small, side->other, s);
            if (t[0] == s[0] && t[1] == s[1]) continue;
            const bool left = is_left(a, whole, small, what->gone, body, side->other);
            if (!sunder_i_keeps_row(side, t, s, left ? side->least_listed : least_with(whole, body, side, what->gap)))
                return true;
        }
    }
    return false;
}
