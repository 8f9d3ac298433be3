/* Counts the pairs that a small tolerance would turn into neighbours. Layers that were drawn without snapping have tiny
 * overlaps along common walls. A user who leaves the tolerance at 0 gets them as conflicts; the report then gives this
 * count as a hint. */
#include "displacement/report/report.h"

#include "base/parallel.h"

typedef struct thin_search {
    const sunder_i_model *model;
    const sunder_i_placement *placement;
    const sunder_i_relations *relations;
    const sunder_shape *disc;
    bool *thin; /* [relations] whether the overlap is thin */
} thin_search;

static sunder_status look_at(void *context, size_t begin, size_t end, sunder_error *err)
{
    const thin_search *s = context;
    for (size_t k = begin; k < end; k++) {
        const sunder_i_relation *r = &s->relations->pair[k];
        if (!r->overlap || r->contained || sunder_i_is_barrier(s->model, r->b) ||
            s->model->body_of[r->a] == s->model->body_of[r->b])
            continue;
        const sunder_i_translate a = sunder_i_standing(s->model, s->placement, r->a),
                                 b = sunder_i_standing(s->model, s->placement, r->b);
        const sunder_status status = sunder_i_overlap_is_thin(&a, &b, s->model->rules.thin, s->disc, &s->thin[k], err);
        if (status) return status;
    }
    return SUNDER_OK;
}

sunder_status sunder_i_count_thin_overlaps(const sunder_i_model *model, const sunder_i_placement *placement,
                                           const sunder_i_relations *relations, sunder_report *report,
                                           sunder_error *err)
{
    size_t *n = &report->summary.thin;
    *n = 0;
    if (!(model->rules.thin > 0)) return SUNDER_OK;
    sunder_shape *disc;
    sunder_status status = sunder_i_thin_disc(model->rules.thin, &disc, err);
    thin_search s = {model, placement, relations, disc, sunder_i_calloc(relations->n, sizeof *s.thin)};
    if (!status && !s.thin) status = sunder_i_failure_cause(err);
    if (!status) status = sunder_i_parallel(model->rules.threads, relations->n, SUNDER_I_GRAIN_PAIRS, look_at, &s, err);
    for (size_t k = 0; k < relations->n && !status; k++) *n += s.thin[k];
    if (model->rules.keep_worlds)
        report->thin = s.thin;
    else
        sunder_i_free(s.thin);
    sunder_shape_free(disc);
    return status;
}
