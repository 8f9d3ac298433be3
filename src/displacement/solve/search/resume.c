/* A cluster from where branch and bound has put some of its bodies: is that a solution for the search as well, and the
 * least moves about it? */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <stdlib.h>
#include <string.h>

/* Makes these the restored pairs of the search. False if memory is out. */
static bool restore_relaxed(sunder_i_search *s, const sunder_i_restored *restored, size_t n)
{
    if (!sunder_i_reserve(&s->restored, &s->restored_capacity, n, sizeof *s->restored)) return false;
    if (n) memcpy(s->restored, restored, n * sizeof *s->restored);
    s->restored_n = n;
    return true;
}

/* ---- The way out of an overlap that stays ------------------------------------------------------------------------ */

/* Is it a relaxation of an overlap between these two bodies, which counts in the search? */
static bool is_overlap_of(const sunder_i_search *s, const sunder_i_relaxation *t, uint32_t body, uint32_t other)
{
    const uint32_t i = s->model->body_of[t->a], j = s->model->body_of[t->b];
    if (!((i == body && j == other) || (i == other && j == body)) || t->inside) return false;
    if (t->shift[0] == 0 && t->shift[1] == 0) return false;
    const sunder_i_restored key = sunder_i_restored_of(s->model, t);
    return !s->restored_n || !bsearch(&key, s->restored, s->restored_n, sizeof key, sunder_i_by_restored);
}

/* A relaxed overlap is held to one direction of separation, while a solution may have any direction of the same length.
 * For the bodies i and j, which clash there, each overlap is relaxed along the least translation of the present
 * layout. */
static sunder_status turn_overlaps(sunder_i_search *s, uint32_t i, uint32_t j, sunder_error *err)
{
    const sunder_i_model *model = s->model;
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < model->relaxations.n && !status; k++) {
        sunder_i_relaxation t = model->relaxations.item[k];
        if (!is_overlap_of(s, &t, s->body[i], s->body[j])) continue;
        const bool swapped = model->body_of[t.a] == s->body[j];
        const double *ta = s->t + 2 * (swapped ? j : i), *tb = s->t + 2 * (swapped ? i : j);
        bool fits;
        status = sunder_i_relaxation_turn(model, ta, tb, &t, &fits, err);
        if (!status && fits && !sunder_i_relaxations_add(&s->relaxations, &t)) status = sunder_i_failure_cause(err);
    }
    return status;
}

static sunder_status turn_all(sunder_i_search *s, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    sunder_i_search_find_clashes(s, s->t);
    for (size_t k = 0; k < s->clashes && !status; k++) status = turn_overlaps(s, s->clash[k].i, s->clash[k].j, err);
    if (!status && !sunder_i_relaxations_index(&s->relaxations, s->model)) status = sunder_i_failure_cause(err);
    return status;
}

/* ---- Going on ---------------------------------------------------------------------------------------------------- */

sunder_status sunder_i_cluster_resume(const sunder_i_model *model, sunder_i_cluster *cluster,
                                      const sunder_i_restored *restored, size_t n, double *move, bool *done,
                                      sunder_error *err)
{
    sunder_i_search s;
    bool ok = sunder_i_search_init_about(&s, model, cluster, move) && restore_relaxed(&s, restored, n);
    sunder_status status = ok ? turn_all(&s, err) : SUNDER_OK;
    s.patience = sunder_i_search_work(&s) + PATIENCE + PATIENCE_EACH * (uint64_t)s.n;
    *done = ok && !status && sunder_i_search_descend(&s);
    ok = ok && !s.failed;
    if (ok && *done) {
        s.n = cluster->n;
        sunder_i_search_round(&s, move);
        sunder_i_search_hand_over(&s, cluster);
    }
    sunder_i_search_free(&s);
    if (status) return status;
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
