/* Hidden features that would be in no conflict at their places in the layout, with the move of their block. A choice
 * that is proved to be the best hides none. A tentative clause may have hidden one in vain. */
#include "displacement/hide/hiding.h"

#include "base/union_find.h"
#include "spatial/box.h"

#include <math.h>
#include <stdlib.h>

/* A hidden feature of the model, its number in the layer, and the box of its place, grown by what others owe it. */
typedef struct candidate {
    const sunder_hiding_cost *cost;
    uint32_t feature, number;
    double box[4];
} candidate;

/* The most important class comes first, then the greatest weight, then the first number. */
static int most_important_first(const void *a, const void *b)
{
    const candidate *p = a, *q = b;
    if (p->cost->hierarchy != q->cost->hierarchy) return p->cost->hierarchy < q->cost->hierarchy ? -1 : 1;
    if (p->cost->weight != q->cost->weight) return p->cost->weight > q->cost->weight ? -1 : 1;
    return p->number < q->number ? -1 : p->number > q->number;
}

static size_t list_candidates(const sunder_i_hiding *h, const sunder_i_model *model, const uint32_t *number,
                              candidate *list)
{
    size_t n = 0;
    for (uint32_t f = 0; f < model->features; f++)
        if (h->hidden[number[f]] && !h->stays[number[f]])
            list[n++] = (candidate){.cost = &h->layer->hiding[number[f]], .feature = f, .number = number[f]};
    if (n) qsort(list, n, sizeof *list, most_important_first);
    return n;
}

/* Is the place of a candidate too near to that of an earlier one of another block, going by their boxes? */
static bool is_taken(const sunder_i_model *model, const candidate *list, size_t fitting, const candidate *c)
{
    for (size_t k = 0; k < fitting; k++)
        if (model->body_of[list[k].feature] != model->body_of[c->feature] && sunder_i_box_meet(list[k].box, c->box))
            return true;
    return false;
}

/* Notes where a candidate would stand, and how far the decision looked for it: as far as the grown boxes of two
 * candidates meet. Sets its grown box. */
static void place_candidate(sunder_i_hiding *h, const sunder_i_model *model, const double t[2], candidate *c)
{
    const double reach = nextafter(sunder_i_max(model->rules.full_gap, model->rules.tolerance), INFINITY);
    double own[4], about[4];
    sunder_shape_box(sunder_i_at_home(model, c->feature).shape, own);
    for (int i = 0; i < 4; i++) own[i] += t[i & 1];
    sunder_i_box_grow(own, reach, c->box);
    sunder_i_box_grow(c->box, reach, about);
    if (h->influence.root) sunder_i_influence_place(&h->influence, model, c->feature, own, about);
}

/* Moves the candidates that fit to the front of the list, each beside those before it, and sets *fitting to their
 * number. */
static sunder_status choose_fitting(sunder_i_hiding *h, const sunder_i_model *model,
                                    const sunder_i_placement *placement, candidate *list, size_t n, size_t *fitting,
                                    sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    *fitting = 0;
    for (size_t k = 0; k < n && !status; k++) {
        candidate *c = &list[k];
        const double *t = model->move + 2 * (size_t)model->body_of[c->feature];
        bool fits;
        place_candidate(h, model, t, c);
        status = sunder_i_placement_fits(model, placement, c->feature, t, &fits, err);
        if (!status && fits && !is_taken(model, list, *fitting, c)) list[(*fitting)++] = *c;
    }
    return status;
}

sunder_status sunder_i_hiding_unhide(sunder_i_hiding *hiding, const sunder_i_model *model,
                                     const sunder_i_placement *placement, const uint32_t *number, bool *any,
                                     sunder_error *err)
{
    candidate *list = sunder_i_alloc(model->features, sizeof *list);
    size_t fitting = 0;
    *any = false;
    hiding->shown.n = 0;
    if (!list) return sunder_i_failure_cause(err);
    const size_t n = hiding->layer->hiding ? list_candidates(hiding, model, number, list) : 0;
    sunder_status status = choose_fitting(hiding, model, placement, list, n, &fitting, err);
    for (size_t k = 0; k < fitting && !status; k++) {
        hiding->level[list[k].number] = 0;
        if (!sunder_i_list_push(&hiding->shown, list[k].feature)) status = sunder_i_failure_cause(err);
    }
    *any = !status && fitting > 0;
    sunder_i_free(list);
    return status;
}

/* ---- What was shown in vain -------------------------------------------------------------------------------------- */

/* Returns the body that a conflict is counted at. */
static uint32_t body_of_conflict(const sunder_i_model *model, const sunder_conflict *c)
{
    const uint32_t a = model->body_of[c->a];
    return model->body[a].fixed && !sunder_i_is_barrier(model, (uint32_t)c->b) ? model->body_of[c->b] : a;
}

/* Lists a body of each conflict. Returns false if memory is out. */
static bool list_conflicts(const sunder_i_model *model, const sunder_report *report, sunder_i_list *body)
{
    bool ok = true;
    body->n = 0;
    for (size_t k = 0; k < report->conflicts && ok; k++)
        if (sunder_i_hiding_counts(&report->conflict[k]))
            ok = sunder_i_list_push(body, body_of_conflict(model, &report->conflict[k]));
    return ok;
}

sunder_status sunder_i_hiding_note_conflicts(sunder_i_hiding *hiding, const sunder_i_model *model,
                                             const sunder_report *report, sunder_error *err)
{
    return list_conflicts(model, report, &hiding->conflict) ? SUNDER_OK : sunder_i_failure_cause(err);
}

sunder_status sunder_i_hiding_hide_again(sunder_i_hiding *hiding, const sunder_i_model *model, const uint32_t *number,
                                         const sunder_report *report, bool *any, sunder_error *err)
{
    uint32_t *world = sunder_i_alloc(model->bodies, sizeof *world);
    int64_t *more = sunder_i_calloc(model->bodies, sizeof *more); /* conflicts of each world, now less before */
    sunder_i_list now = {0};
    sunder_status status =
        world && more && list_conflicts(model, report, &now) ? SUNDER_OK : sunder_i_failure_cause(err);
    *any = false;
    if (!status) status = sunder_i_influence_gather(&hiding->influence, world, err);
    for (size_t k = 0; k < now.n && !status; k++) more[sunder_i_union_find(world, now.item[k])]++;
    for (size_t k = 0; k < hiding->conflict.n && !status; k++)
        more[sunder_i_union_find(world, hiding->conflict.item[k])]--;
    for (size_t k = 0; k < hiding->shown.n && !status; k++) {
        const uint32_t f = hiding->shown.item[k], i = number[f];
        if (more[sunder_i_union_find(world, model->body_of[f])] <= 0) continue;
        hiding->level[i] = sunder_i_last_level(hiding->layer, i);
        hiding->stays[i] = *any = true;
    }
    sunder_i_free_all(world, more, now.item);
    return status;
}
