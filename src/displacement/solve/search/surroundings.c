/* Neighbours of a cluster that stay where they stand, for searches that must not run into them. */
#include "displacement/layer/reads.h"
#include "displacement/solve/search/cluster_search.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

static double larger_coordinate(const double t[2]) { return sunder_i_max(fabs(t[0]), fabs(t[1])); }

/* The mean over the movable bodies of the larger coordinate of their moves. */
static double mean_move(const sunder_i_model *model, const sunder_i_cluster *cluster, const double *own)
{
    double sum = 0;
    size_t n = 0;
    for (size_t k = 0; k < cluster->n; k++) {
        if (model->body[cluster->body[k]].fixed) continue;
        sum += larger_coordinate(own + 2 * k);
        n++;
    }
    return n ? sum / (double)n : 0;
}

/* Lists the bodies near the cluster that are not in it, ascending. Each member looks as far as its own move or the mean
 * move suggests, so that one body that went far does not make all others look that far. False if memory is out. */
static bool find_surroundings(const sunder_i_model *model, const sunder_i_cluster *cluster, const double *own,
                              sunder_i_list *hits)
{
    const double mean = mean_move(model, cluster, own), none[2] = {0, 0};
    for (size_t k = 0; k < cluster->n; k++) {
        const sunder_i_body *b = &model->body[cluster->body[k]];
        if (b->fixed || b->pieces == 0) continue;
        const double reach =
            model->rules.full_gap + cluster->margin +
            MOVES_ABOUT * sunder_i_max(sunder_i_max(larger_coordinate(own + 2 * k), mean), cluster->about);
        double box[4];
        sunder_i_body_box(b, none, reach, box);
        if (!sunder_i_look_about(model, model->standing, box, hits)) return false;
    }
    sunder_i_things_to_bodies(model, hits);
    size_t out = 0;
    for (size_t k = 0; k < hits->n; k++)
        if (!sunder_i_set_has(cluster->body, cluster->n, hits->item[k])) hits->item[out++] = hits->item[k];
    hits->n = out;
    return true;
}

bool sunder_i_search_init_about(sunder_i_search *search, const sunder_i_model *model, const sunder_i_cluster *cluster,
                                const double *move)
{
    sunder_i_list hits = {0};
    memset(search, 0, sizeof *search);
    bool ok = find_surroundings(model, cluster, move, &hits);
    const size_t own = cluster->n, n = own + hits.n;
    uint32_t *body = sunder_i_alloc(n, sizeof *body);
    double *stand = sunder_i_alloc(2 * n, sizeof *stand);
    ok = ok && body && stand;
    if (ok) {
        memcpy(body, cluster->body, own * sizeof *body);
        memcpy(stand, move, 2 * own * sizeof *stand);
        for (size_t k = own; k < n; k++) {
            body[k] = hits.item[k - own];
            memcpy(stand + 2 * k, model->move + 2 * (size_t)body[k], 2 * sizeof *stand);
        }
        ok = sunder_i_search_init(search, model, body, n, cluster->margin, stand);
    }
    search->listed = body;
    search->own = own;
    for (size_t k = own; ok && k < n; k++) search->mass[k] = 0;
    sunder_i_free_all(stand, hits.item);
    return ok;
}
