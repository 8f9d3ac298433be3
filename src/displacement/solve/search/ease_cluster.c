/* Eases the pairs of a cluster that are left in conflict: descends, from a layout without clashes, to where the sum of
 * moves, springs and prices is least. Every layout on the way satisfies the constraints of the search: all other pairs
 * keep their distance, and pairs left in conflict are no worse than at the start. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

/* Adds to cluster->guest the bodies outside the cluster that may move and that its bodies press against. False if
 * memory is out. */
static bool find_guests(const sunder_i_search *s, sunder_i_cluster *cluster)
{
    const sunder_i_model *model = s->model;
    for (size_t k = 0; k < s->program.n; k++) {
        const sunder_i_constraint *c = &s->program.constraint[k];
        if (!(c->force > 0) || c->key >> 60) continue; /* not of two pieces */
        const uint32_t a = sunder_i_body_of_piece(model, (uint32_t)(c->key >> 32)),
                       b = sunder_i_body_of_piece(model, (uint32_t)c->key);
        const bool has_a = sunder_i_set_has(cluster->body, cluster->n, a),
                   has_b = sunder_i_set_has(cluster->body, cluster->n, b);
        if (has_a == has_b || !sunder_i_may_move(&model->body[has_a ? b : a])) continue;
        if (!sunder_i_reserve(&cluster->guest, &cluster->guest_capacity, cluster->guests + 1, sizeof *cluster->guest))
            return false;
        cluster->guest[cluster->guests++] = has_a ? (sunder_i_id_pair){a, b} : (sunder_i_id_pair){b, a};
    }
    return true;
}

sunder_status sunder_i_cluster_ease(const sunder_i_model *model, sunder_i_cluster *cluster, double *move, bool *done,
                                    sunder_error *err)
{
    sunder_i_search s;
    *done = false;
    const bool ok = sunder_i_search_init_about(&s, model, cluster, move) && sunder_i_search_ease(&s);
    s.failed = s.failed || !ok;
    if (!s.failed && s.shortfalls) {
        const double before = sunder_i_search_cost(&s, s.t);
        s.settled = EASED;
        const bool kept = before > 0 && sunder_i_search_keep_margins(&s);
        if (kept) {
            s.program.n = 0;
            *done = sunder_i_search_descend(&s) && sunder_i_search_cost(&s, s.t) < before * (1 - CHEAPER);
        }
        s.n = cluster->n;
        if (*done && !s.failed) sunder_i_search_round(&s, move);
    }
    if (!s.failed && s.shortfalls && !find_guests(&s, cluster)) s.failed = true;
    const bool failed = s.failed;
    sunder_i_search_free(&s);
    return failed ? sunder_i_failure_cause(err) : SUNDER_OK;
}
