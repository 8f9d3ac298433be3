/* Pairs given up between two bodies are asked once more for the full distance, up to a small shortfall.
 *
 * An exact fit has no solution with a margin, and hardly one without it where limits are used up. So the search accepts
 * places at which every distance is missed by a little. ../clusters/exact_fits.c, which knows the coordinates, decides
 * whether there is a place next to it at which no distance is missed. */
#include "displacement/solve/search/neighbourhood.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <stdlib.h>
#include <string.h>

static const size_t stage[] = FIT_STAGES;

/* Ends the relaxations between bodies a and b in the search, except infeasible ones. The model may list a pair twice,
 * with equal values, and the search each once. False if memory is out. */
static bool restore_between(sunder_i_search *s, uint32_t a, uint32_t b)
{
    const sunder_i_model *model = s->model;
    const sunder_i_id_pair pair = a < b ? (sunder_i_id_pair){a, b} : (sunder_i_id_pair){b, a};
    for (size_t k = 0; k < model->relaxations.n; k++) {
        const sunder_i_relaxation *t = &model->relaxations.item[k];
        const sunder_i_restored r = sunder_i_restored_of(model, t);
        if (t->infeasible || sunder_i_by_id_pair(&r.body, &pair) != 0) continue;
        if (k && sunder_i_by_id_pair(t - 1, t) == 0 && !t[-1].infeasible) continue;
        if (!sunder_i_reserve(&s->restored, &s->restored_capacity, s->restored_n + 1, sizeof *s->restored))
            return false;
        s->restored[s->restored_n++] = r;
    }
    if (s->restored_n) qsort(s->restored, s->restored_n, sizeof *s->restored, sunder_i_by_restored);
    return true;
}

/* Tries bodies i and j with more and more bodies around them (FIT_STAGES), from the present layout. Returns whether a
 * layout was found. */
static bool fit_about(sunder_i_search *s, uint32_t i, uint32_t j)
{
    sunder_i_neighbourhood about;
    bool found = false, wider = true;
    if (!sunder_i_neighbourhood_init(&about, s)) s->failed = true;
    for (size_t k = 0; k < sizeof stage / sizeof *stage && wider && !found && !s->failed; k++) {
        found = sunder_i_neighbourhood_settle(&about, i, j, stage[k], s->model->rules.gap + s->extent);
        wider = about.wider;
    }
    sunder_i_neighbourhood_free(&about);
    return found;
}

/* Tries all bodies from their original places, if they are few: earlier moves for other pairs do not matter there. */
static bool fit_from_home(sunder_i_search *s)
{
    if (sunder_i_search_movers(s) > stage[sizeof stage / sizeof *stage - 1]) return false;
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) s->t[2 * k] = s->t[2 * k + 1] = 0;
    s->patience = PATIENCE + PATIENCE_EACH * (uint64_t)s->n;
    return sunder_i_search_descend(s);
}

sunder_status sunder_i_cluster_fit(const sunder_i_model *model, const sunder_i_cluster *cluster, uint32_t a, uint32_t b,
                                   double room, bool from_home, double *move, bool *found, sunder_error *err)
{
    sunder_i_search s;
    *found = false;
    bool ok = sunder_i_search_init_about(&s, model, cluster, move) && restore_between(&s, a, b);
    const uint32_t i = ok ? sunder_i_search_place_of(&s, a) : SUNDER_I_NOBODY,
                   j = ok ? sunder_i_search_place_of(&s, b) : SUNDER_I_NOBODY;
    if (ok && i != SUNDER_I_NOBODY && j != SUNDER_I_NOBODY) {
        s.gap = model->rules.gap - room;
        s.tolerance = room / 4;
        *found = from_home ? fit_from_home(&s) : fit_about(&s, i, j);
        if (*found) memcpy(move, s.t, 2 * cluster->n * sizeof *move);
    }
    ok = ok && !s.failed;
    sunder_i_search_free(&s);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
