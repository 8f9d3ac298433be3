/* Neighbours that block a nearer place without being in conflict.
 *
 * Bodies near a cluster that are not part of it stay in place while better sides are sought. So a body may have been
 * sent far because a neighbour, which could have moved a little, stood in the nearer place. Therefore the nearest place
 * of each body is found once as if these neighbours were absent; a neighbour that clashes with it there joins the
 * cluster. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>

/* Adds to cluster->guest the ignored bodies that clash with body i at this place. */
static void add_blocking(sunder_i_search *s, sunder_i_cluster *cluster, uint32_t i, const double place[2])
{
    for (uint32_t j = (uint32_t)cluster->n; j < s->n && !s->failed; j++) {
        if (!s->away[j]) continue;
        const double u[2] = {s->t[2 * j] - place[0], s->t[2 * j + 1] - place[1]};
        bool yields;
        if (!(sunder_i_search_pair(s, i, j, u, &yields) > s->tolerance)) continue;
        if (!sunder_i_reserve(&cluster->guest, &cluster->guest_capacity, cluster->guests + 1, sizeof *cluster->guest))
            s->failed = true;
        else
            cluster->guest[cluster->guests++] = (sunder_i_id_pair){s->body[i], s->body[j]};
    }
}

static void find_blocking(sunder_i_search *s, sunder_i_cluster *cluster)
{
    for (size_t k = s->own; k < s->n; k++) s->away[k] = sunder_i_may_move(&s->model->body[s->body[k]]);
    const double cost = sunder_i_search_cost(s, s->t);
    for (uint32_t i = 0; i < cluster->n && !s->failed; i++) {
        const double square = sunder_i_search_stray_square(s, i, s->t);
        double place[2];
        if (!(s->mass[i] > 0) || !(square > COSTLY * cost * 2 * s->mass[i])) continue;
        if (sunder_i_search_free_body(s, i, NEARER * sqrt(square), place)) add_blocking(s, cluster, i, place);
    }
}

bool sunder_i_cluster_find_blocking(const sunder_i_model *model, sunder_i_cluster *cluster, const double *move)
{
    sunder_i_search s;
    const bool begun = sunder_i_search_init_about(&s, model, cluster, move);
    if (begun) find_blocking(&s, cluster);
    const bool ok = begun && !s.failed;
    sunder_i_search_free(&s);
    return ok;
}
