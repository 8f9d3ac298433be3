/* The rule of rows: with `apart` the separation of two neighbours along the row at the start, v their relative move and
 * a the direction of the row, v . a is at least
 *
 *     gap - apart           if the pair is in conflict at the start: it is to be resolved along the row
 *     min(0, gap - apart)   otherwise, and for a pair that remains in conflict: the two may come nearer along the row
 *                           only as long as the gap is kept there
 *
 * For a given pair this is one half-plane, which is convex: no search has to choose a side of it.
 *
 * With a full gap (layer/full_gap.c) that is the gap here, and a pair that lacks s of it may also lack s of
 * full gap - apart, but not of min(0, full gap - apart). s is at most full gap - gap, unless the pair remains in
 * conflict. So the rule that has to be kept is the greater of gap - apart and min(0, full gap - apart). */
#include "displacement/rows/rows.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>

/* Lists the pairs of bodies that are nearer than the full gap, sorted. Returns NULL if memory is out. */
static sunder_i_id_pair *list_near(const sunder_i_model *model, const sunder_i_relations *start, size_t *n)
{
    sunder_i_id_pair *pair = sunder_i_alloc(start->n, sizeof *pair);
    *n = 0;
    for (size_t k = 0; k < start->n && pair; k++) {
        const sunder_i_relation *r = &start->pair[k];
        const uint32_t i = model->body_of[r->a], j = model->body_of[r->b];
        if (sunder_i_is_conflict_of_bodies(model, r)) pair[(*n)++] = (sunder_i_id_pair){i < j ? i : j, i < j ? j : i};
    }
    if (pair && *n) qsort(pair, *n, sizeof *pair, sunder_i_by_id_pair);
    return pair;
}

/* The rule of a pair as seen from one of its bodies. */
typedef struct half {
    uint32_t body;
    sunder_i_row_side side;
} half;

static int by_body(const void *x, const void *y)
{
    const half *p = x, *q = y;
    if (p->body != q->body) return p->body < q->body ? -1 : 1;
    return p->side.other < q->side.other ? -1 : p->side.other > q->side.other;
}

/* Appends the rule of body i, and the same as seen from the other body. */
static void add_halves(uint32_t i, const sunder_i_row_side *there, half *out, size_t *n)
{
    sunder_i_row_side back = *there;
    back.other = i;
    for (int c = 0; c < 2; c++) back.along[c] = -there->along[c];
    out[(*n)++] = (half){i, *there};
    out[(*n)++] = (half){there->other, back};
}

/* Appends the rule of an edge, from both of its bodies. near: they are nearer than the full gap. */
static void add_edge(const sunder_i_model *model, const sunder_i_row_edge *e, bool near, half *out, size_t *n)
{
    const bool ruled = e->apart > 0;
    const double full_gap = sunder_i_row_gap(model, model->class_full, model->rules.full_gap, e->i, e->j),
                 gap = sunder_i_row_gap(model, model->class_gap, model->rules.gap, e->i, e->j);
    const double full = ruled ? full_gap - e->apart : -INFINITY, listed = sunder_i_min(0, full),
                 least = ruled ? sunder_i_max(gap - e->apart, listed) : -INFINITY;
    const sunder_i_row_side there = {e->j,
                                     {e->along[0], e->along[1]},
                                     near ? least : listed,
                                     listed,
                                     near ? full : -INFINITY,
                                     sunder_i_min(sunder_i_weight_below(model, &model->body[e->i]),
                                                  sunder_i_weight_below(model, &model->body[e->j])),
                                     {0, 0}};
    add_halves(e->i, &there, out, n);
}

/* Sorts n halves by their bodies, and stores them in the model. Returns false if memory is out. */
static bool keep_rule(sunder_i_model *model, half *all, size_t n)
{
    if (n == 0) return true;
    qsort(all, n, sizeof *all, by_body);
    model->row_side = sunder_i_alloc(n, sizeof *model->row_side);
    if (!model->row_side) return false;
    for (size_t k = 0, end; k < n; k = end) {
        sunder_i_extras *extras = sunder_i_own_extras(model, &model->body[all[k].body]);
        if (!extras) return false;
        extras->row_side = (uint32_t)k;
        for (end = k; end < n && all[end].body == all[k].body; end++) model->row_side[end] = all[end].side;
        extras->row_sides = (uint32_t)(end - k);
    }
    model->row_sides = n;
    return true;
}

static sunder_status make_rule(const sunder_i_rows *rows, const sunder_i_relations *start, sunder_i_model *model,
                               sunder_error *err)
{
    size_t nears, n = 0;
    half *all = sunder_i_alloc(2 * rows->edges, sizeof *all);
    sunder_i_id_pair *near = list_near(model, start, &nears);
    bool ok = all && near;
    for (size_t k = 0; k < rows->edges && ok; k++) {
        const sunder_i_row_edge *e = &rows->edge[k];
        const sunder_i_id_pair pair = {e->i, e->j};
        const size_t at = sunder_i_lower_bound(&pair, near, nears, sizeof pair, sunder_i_by_id_pair);
        const bool is_near = at < nears && sunder_i_by_id_pair(&near[at], &pair) == 0;
        if (!(model->body[e->i].fixed && model->body[e->j].fixed)) add_edge(model, e, is_near, all, &n);
    }
    ok = ok && keep_rule(model, all, n);
    sunder_i_free_all(all, near);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

sunder_status sunder_i_rows_make_rule(const sunder_i_rows *rows, const sunder_i_placement *home,
                                      const sunder_i_relations *start, sunder_i_model *model, sunder_error *err)
{
    if (rows->edges == 0) return SUNDER_OK;
    if (!sunder_i_has_slack(model)) return make_rule(rows, start, model, err);
    sunder_i_relations full = {0};
    sunder_status status = sunder_i_placement_relate_fully(model, home, &full, err);
    if (!status) status = make_rule(rows, &full, model, err);
    sunder_i_free(full.pair);
    return status;
}

sunder_status sunder_i_rows_take_rule(const sunder_i_row_demand *demand, size_t n, const uint32_t *number,
                                      sunder_i_model *model, sunder_error *err)
{
    size_t halves = 0;
    if (n == 0) return SUNDER_OK;
    half *all = sunder_i_alloc(2 * n, sizeof *all);
    uint32_t *body = sunder_i_alloc(model->features, sizeof *body);
    bool ok = all && body;
    for (size_t k = 0; k < model->features && ok; k++) body[number[k]] = model->body_of[k];
    for (size_t k = 0; k < n && ok; k++) {
        const sunder_i_row_demand *d = &demand[k];
        const sunder_i_row_side there = {
            body[d->b], {d->along[0], d->along[1]}, d->least, d->least_listed, -INFINITY, 0, {0, 0}};
        if (body[d->a] != body[d->b]) add_halves(body[d->a], &there, all, &halves);
    }
    ok = ok && keep_rule(model, all, halves);
    sunder_i_free_all(all, body);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
