/* Which bodies of a cluster clash, and by how much. */
#include "displacement/solve/search/cluster_search.h"

#include "base/extremes.h"

typedef struct look {
    const double *t;
    double worst;
} look;

static void look_at(sunder_i_search *s, uint32_t i, uint32_t j, void *context)
{
    look *l = context;
    const double u[2] = {l->t[2 * j] - l->t[2 * i], l->t[2 * j + 1] - l->t[2 * i + 1]};
    bool yields;
    const double v = sunder_i_search_pair(s, i, j, u, &yields);
    if (v > l->worst) l->worst = v;
    if (v <= s->tolerance || s->failed) return;
    if (!sunder_i_reserve(&s->clash, &s->clash_capacity, s->clashes + 1, sizeof *s->clash)) {
        s->failed = true;
        return;
    }
    s->clash[s->clashes++] = (sunder_i_clash){i, j, v};
}

void sunder_i_search_add_clash(sunder_i_search *search, const double *t, uint32_t i, uint32_t j)
{
    look l = {t, 0};
    look_at(search, i, j, &l);
}

double sunder_i_search_find_clashes(sunder_i_search *search, const double *t)
{
    look l = {t, 0};
    search->clashes = 0;
    sunder_i_search_visit_near(search, t, search->gap, look_at, &l);
    sunder_i_search_visit_passing(search, t, search->gap, look_at, &l);
    for (uint32_t k = 0; k < search->n; k++) l.worst = sunder_i_max(l.worst, sunder_i_search_excess(search, k, t));
    return l.worst;
}

void sunder_i_search_update_clashes(sunder_i_search *search, const double *t, uint32_t i)
{
    size_t out = 0;
    for (size_t k = 0; k < search->clashes; k++)
        if (search->clash[k].i != i && search->clash[k].j != i) search->clash[out++] = search->clash[k];
    search->clashes = out;
    look l = {t, 0};
    const sunder_i_body *p = &search->model->body[search->body[i]];
    if (p->pieces == 0) return;
    for (uint32_t j = 0; j < search->n && !search->failed; j++) {
        const sunder_i_body *q = &search->model->body[search->body[j]];
        if (j == i || q->pieces == 0) continue;
        double box[4];
        for (size_t c = 0; c < 4; c++)
            box[c] = p->box[c] + p->origin[c & 1] + t[2 * i + (c & 1)] - q->origin[c & 1] - t[2 * j + (c & 1)] +
                     (c < 2 ? -search->gap : search->gap);
        if (sunder_i_box_meet(box, q->box) || sunder_i_search_may_pass(search, t, i, j, search->gap))
            look_at(search, i < j ? i : j, i < j ? j : i, &l);
    }
}
