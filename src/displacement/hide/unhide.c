/* Hidden features that would be in no conflict at their places in the layout, with the move of their block. A choice
 * that is proved to be the best hides none. A tentative clause may have hidden one in vain. */
#include "displacement/hide/hiding.h"

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
        if (h->hidden[number[f]])
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

/* Moves the candidates that fit to the front of the list, each beside those before it, and sets *fitting to their
 * number. */
static sunder_status choose_fitting(const sunder_i_model *model, const sunder_i_placement *placement, candidate *list,
                                    size_t n, size_t *fitting, sunder_error *err)
{
    const double reach = nextafter(sunder_i_max(model->rules.full_gap, model->rules.tolerance), INFINITY);
    sunder_status status = SUNDER_OK;
    *fitting = 0;
    for (size_t k = 0; k < n && !status; k++) {
        candidate *c = &list[k];
        const double *t = model->move + 2 * (size_t)model->body_of[c->feature];
        const sunder_i_translate place = sunder_i_at_home(model, c->feature);
        bool fits;
        status = sunder_i_placement_fits(model, placement, c->feature, t, &fits, err);
        if (status || !fits) continue;
        sunder_shape_box(place.shape, c->box);
        for (int i = 0; i < 4; i++) c->box[i] += t[i & 1];
        sunder_i_box_grow(c->box, reach, c->box);
        if (!is_taken(model, list, *fitting, c)) list[(*fitting)++] = *c;
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
    if (!list) return sunder_i_failure_cause(err);
    const size_t n = hiding->layer->hiding ? list_candidates(hiding, model, number, list) : 0;
    const sunder_status status = choose_fitting(model, placement, list, n, &fitting, err);
    for (size_t k = 0; k < fitting && !status; k++) hiding->level[list[k].number] = 0;
    *any = !status && fitting > 0;
    sunder_i_free(list);
    return status;
}
