/* What clusters gave up, and what they found a solution for after all: their relaxations become the model's. */
#include "displacement/solve/clusters/cluster_stages.h"

#include <stdlib.h>

/* Drops the relaxations that clusters ended, and the given-up pairs between whose bodies no relaxation is left. False
 * if memory is out. */
static bool restore_pairs(sunder_i_model *model, const sunder_i_cluster *cluster, size_t clusters)
{
    size_t n = 0, out = 0;
    for (size_t k = 0; k < clusters; k++) n += cluster[k].restored_n;
    if (n == 0) return true;
    sunder_i_restored *restored = sunder_i_alloc(n, sizeof *restored);
    if (!restored) return false;
    n = 0;
    for (size_t k = 0; k < clusters; k++)
        for (size_t e = 0; e < cluster[k].restored_n; e++) restored[n++] = cluster[k].restored[e];
    qsort(restored, n, sizeof *restored, sunder_i_by_restored);
    for (size_t k = 0; k < n && sunder_i_is_traced(model); k++)
        sunder_i_trace_pair(model, "restore", "asked again, and solved", restored[k].feature.a, restored[k].feature.b);
    sunder_i_relaxations_restore(&model->relaxations, model, restored, n);
    sunder_i_free(restored);
    if (!sunder_i_relaxations_index(&model->relaxations, model)) return false;
    for (size_t k = 0; k < model->given_up_n; k++)
        if (sunder_i_relaxations_between(&model->relaxations, model->given_up[k].a, model->given_up[k].b))
            model->given_up[out++] = model->given_up[k];
    model->given_up_n = out;
    return true;
}

void sunder_i_sort_given_up(sunder_i_model *model)
{
    sunder_i_id_pair *list = model->given_up;
    size_t out = 0;
    if (model->given_up_n) qsort(list, model->given_up_n, sizeof *list, sunder_i_by_id_pair);
    for (size_t k = 0; k < model->given_up_n; k++)
        if (k == 0 || sunder_i_by_id_pair(&list[out - 1], &list[k])) list[out++] = list[k];
    model->given_up_n = out;
}

/* Merges the clusters' relaxations into those of the model, where they replace those of the same features. Pairs that
 * were not proved infeasible are listed as given up. False if memory is out. */
static bool merge_relaxations(sunder_i_solver *s)
{
    sunder_i_model *model = &s->model;
    const sunder_i_cluster *cluster = s->cluster;
    const size_t clusters = s->clusters;
    sunder_i_relaxations *all = &model->relaxations;
    const size_t before = all->n;
    size_t n = 0;
    for (size_t k = 0; k < clusters; k++) n += cluster[k].relaxations.n;
    if (n == 0) return true;
    sunder_i_id_pair *given_up = sunder_i_realloc(model->given_up, model->given_up_n + n, sizeof *given_up);
    if (!given_up) return false;
    model->given_up = given_up;
    for (size_t k = 0; k < clusters; k++)
        for (size_t t = 0; t < cluster[k].relaxations.n; t++) {
            sunder_i_relaxation relaxation = cluster[k].relaxations.item[t];
            const sunder_i_relaxations known = {.item = all->item, .n = before};
            const sunder_i_relaxation *old = sunder_i_relaxations_find(&known, relaxation.a, relaxation.b);
            const uint32_t i = model->body_of[relaxation.a], j = model->body_of[relaxation.b];
            if (!relaxation.infeasible)
                given_up[model->given_up_n++] = (sunder_i_id_pair){i < j ? i : j, i < j ? j : i};
            relaxation.infeasible = old ? old->infeasible : relaxation.infeasible;
            if (old) {
                all->item[old - all->item] = relaxation;
                continue;
            }
            sunder_i_body_event(&s->states, i, SUNDER_I_GIVES_UP);
            sunder_i_body_event(&s->states, j, SUNDER_I_GIVES_UP);
            sunder_i_trace_pair(model, "give up", "no solution found: left as near as it stood", relaxation.a,
                                relaxation.b);
            if (!sunder_i_relaxations_add(all, &relaxation)) return false;
        }
    sunder_i_sort_given_up(model);
    return sunder_i_relaxations_index(all, model);
}

sunder_status sunder_i_solver_take_relaxations(sunder_i_solver *solver, sunder_error *err)
{
    const bool ok = restore_pairs(&solver->model, solver->cluster, solver->clusters) && merge_relaxations(solver);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
