/* Neighbours in rows: the rule that they keep their order along the row, which is one half-plane of their relative
 * move, whatever their shapes; and springs, which make it dear to leave the line. */
#include "displacement/layer/model.h"

#include "sunder_parts.h"

#include <math.h>
#include <stdlib.h>

const sunder_i_row_side *sunder_i_row_side_of(const sunder_i_model *model, const sunder_i_body *body, uint32_t other)
{
    for (uint32_t k = body->has->row_side; k < body->has->row_side + body->has->row_sides; k++)
        if (model->row_side[k].other == other) return &model->row_side[k];
    return NULL;
}

double sunder_i_row_full_gap(const sunder_i_model *model)
{
    const sunder_i_rules *rules = &model->rules;
    return model->gaps ? sunder_i_min(rules->full_gap, model->gaps->among[rules->has_full]) : rules->full_gap;
}

double sunder_i_row_gap(const sunder_i_model *model, const double *table, double most, uint32_t i, uint32_t j)
{
    const sunder_i_body *p = &model->body[i], *q = &model->body[j];
    const uint32_t *number = model->layer->number;
    double gap = most;
    for (uint32_t k = 0; k < p->members && model->gaps; k++)
        for (uint32_t l = 0; l < q->members; l++)
            gap = sunder_i_class_gap(model->gaps, table, gap, number[model->member[p->member + k]],
                                     number[model->member[q->member + l]]);
    return gap;
}

bool sunder_i_add_row_neighbours(const sunder_i_model *model, uint32_t body, sunder_i_list *list)
{
    const sunder_i_extras *has = model->body[body].has;
    for (uint32_t k = has->row_side; k < has->row_side + has->row_sides; k++)
        if (!sunder_i_list_push(list, model->row_side[k].other)) return false;
    if (has->row_sides) list->n = sunder_i_set_make(list->item, list->n);
    return true;
}

static size_t springs_with(const double stiffness[2], const sunder_i_row_side *side, sunder_i_spring spring[2])
{
    const double *a = side->along;
    size_t n = 0;
    if (stiffness[0] > 0) spring[n++] = (sunder_i_spring){{-a[1], a[0]}, side->weight * stiffness[0]};
    if (stiffness[1] > 0) spring[n++] = (sunder_i_spring){{a[0], a[1]}, side->weight * stiffness[1]};
    return n;
}

size_t sunder_i_springs_of(const sunder_i_model *model, const sunder_i_row_side *side, sunder_i_spring spring[2])
{
    return springs_with(model->rules.row_stiffness, side, spring);
}

double sunder_i_spring_cost_with(const double stiffness[2], const sunder_i_row_side *side, const double t[2],
                                 const double s[2])
{
    sunder_i_spring spring[2];
    const size_t n = springs_with(stiffness, side, spring);
    double cost = 0;
    for (size_t k = 0; k < n; k++) {
        const double u =
            (s[0] - t[0] - side->rest[0]) * spring[k].n[0] + (s[1] - t[1] - side->rest[1]) * spring[k].n[1];
        cost += spring[k].stiff * u * u;
    }
    return cost;
}

double sunder_i_spring_cost(const sunder_i_model *model, const sunder_i_row_side *side, const double t[2],
                            const double s[2])
{
    return sunder_i_spring_cost_with(model->rules.row_stiffness, side, t, s);
}

/* Returns the cost of the springs of n bodies to others that are listed, each once, or (beyond) that are not. */
static double add_springs(const sunder_i_model *model, const uint32_t *body, size_t n, const double *move, bool beyond)
{
    double cost = 0;
    for (size_t k = 0; k < n && model->row_sides; k++) {
        const sunder_i_extras *has = model->body[body[k]].has;
        for (uint32_t e = has->row_side; e < has->row_side + has->row_sides; e++) {
            const sunder_i_row_side *side = &model->row_side[e];
            const uint32_t *at = bsearch(&side->other, body, n, sizeof *body, sunder_i_by_number);
            if (beyond ? at != NULL : !at || *at < body[k]) continue;
            const double *s = at ? move + 2 * (at - body) : model->move + 2 * (size_t)side->other;
            cost += sunder_i_spring_cost(model, side, move + 2 * k, s);
        }
    }
    return cost;
}

double sunder_i_springs_within(const sunder_i_model *model, const uint32_t *body, size_t n, const double *move)
{
    return add_springs(model, body, n, move, false);
}

double sunder_i_springs_beyond(const sunder_i_model *model, const uint32_t *body, size_t n, const double *move)
{
    return add_springs(model, body, n, move, true);
}

/* Adds a product of two doubles to the sum, without rounding. */
static void add_product(sunder_total *sum, double a, double b)
{
    const double product = a * b;
    sunder_total_add(sum, product);
    sunder_total_add(sum, fma(a, b, -product));
}

bool sunder_i_keeps_row(const sunder_i_row_side *side, const double t[2], const double s[2], double least)
{
    if (least == -INFINITY) return true;
    /* In doubles the value has an error of a few units of its terms. */
    const double value = (s[0] - t[0]) * side->along[0] + (s[1] - t[1]) * side->along[1] - least,
                 size = fabs(s[0]) + fabs(t[0]) + fabs(s[1]) + fabs(t[1]) + fabs(least);
    if (fabs(value) > 0x1p-50 * size) return value > 0;
    sunder_total sum = {0};
    for (int c = 0; c < 2; c++) {
        add_product(&sum, s[c], side->along[c]);
        add_product(&sum, -t[c], side->along[c]);
    }
    sunder_total_add(&sum, -least);
    return sunder_total_nearest(&sum) >= 0;
}
