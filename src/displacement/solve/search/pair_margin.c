/* A pair that is left in conflict, and that rounding left slightly worse than at the start, gets a further margin.
 *
 * A relaxation is kept up to the tolerance of the search, and moves are rounded. If nothing else holds the pair in its
 * place, there is room for a margin as well. It is demanded with only the pair moving, then with more and more bodies
 * around it (neighbourhood.c), so that the rest of the solution stays as it is. Other pairs left in conflict that have
 * moved relative to each other move along, and rounding would make these slightly worse, too. So the margin is demanded
 * of all of these, or, at a second attempt, only of those that keep it already. */
#include "displacement/solve/search/neighbourhood.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const size_t stage[] = RETRY_STAGES;

/* Has the position of body j relative to body i changed by more than the margin, and so by more than rounding? */
static bool have_moved(const sunder_i_search *s, uint32_t i, uint32_t j)
{
    const double margin = s->gap - s->model->rules.gap;
    return fabs(s->t[2 * i] - s->t[2 * j]) > margin || fabs(s->t[2 * i + 1] - s->t[2 * j + 1]) > margin;
}

/* Adds the margin to the relaxations of the pair (a, b), and of all pairs that have moved; a: SUNDER_I_NOBODY for all
 * pairs. False if memory is out. */
static bool ask_margins(sunder_i_search *s, uint32_t a, uint32_t b)
{
    const sunder_i_model *model = s->model;
    const bool all = a == SUNDER_I_NOBODY;
    bool ok = true;
    for (size_t k = 0; k < model->relaxations.n && ok; k++) {
        sunder_i_relaxation t = model->relaxations.item[k];
        const uint32_t i = sunder_i_search_place_of(s, model->body_of[t.a]),
                       j = sunder_i_search_place_of(s, model->body_of[t.b]);
        const bool is_asked = all || (t.a == a && sunder_i_whole_of(model, t.b) == sunder_i_whole_of(model, b));
        if (i == SUNDER_I_NOBODY || j == SUNDER_I_NOBODY || (!is_asked && !have_moved(s, i, j))) continue;
        t.gap += s->gap - model->rules.gap;
        ok = sunder_i_relaxations_add(&s->relaxations, &t);
    }
    return ok && sunder_i_relaxations_index(&s->relaxations, model);
}

static sunder_i_id_pair in_order(uint32_t p, uint32_t q)
{
    return p < q ? (sunder_i_id_pair){p, q} : (sunder_i_id_pair){q, p};
}

/* Removes the margin from pairs other than (i, j) that do not keep it at present. */
static void spare_others(sunder_i_search *s, uint32_t i, uint32_t j)
{
    sunder_i_search_find_clashes(s, s->t);
    sunder_i_id_pair *clash = sunder_i_alloc(s->clashes, sizeof *clash);
    size_t n = 0, kept = 0;
    s->failed = s->failed || !clash;
    if (s->failed) {
        sunder_i_free(clash);
        return;
    }
    for (size_t c = 0; c < s->clashes; c++) {
        const uint32_t p = s->clash[c].i, q = s->clash[c].j;
        if ((p != i || q != j) && (p != j || q != i)) clash[n++] = in_order(s->body[p], s->body[q]);
    }
    if (n) qsort(clash, n, sizeof *clash, sunder_i_by_id_pair);
    for (size_t k = 0; k < s->relaxations.n; k++) {
        const sunder_i_relaxation *t = &s->relaxations.item[k];
        const sunder_i_id_pair key = in_order(s->model->body_of[t->a], s->model->body_of[t->b]);
        if (n && bsearch(&key, clash, n, sizeof key, sunder_i_by_id_pair)) continue;
        memmove(&s->relaxations.item[kept++], t, sizeof *t);
    }
    s->relaxations.n = kept;
    if (!sunder_i_relaxations_index(&s->relaxations, s->model)) s->failed = true;
    sunder_i_free(clash);
}

bool sunder_i_search_ask_margins(sunder_i_search *search)
{
    return ask_margins(search, SUNDER_I_NOBODY, SUNDER_I_NOBODY);
}

bool sunder_i_search_keep_margins(sunder_i_search *search)
{
    double *stood = sunder_i_search_copy_moves(search);
    bool done = stood && sunder_i_search_repair(search);
    if (stood && !done && !search->failed) {
        memcpy(search->t, stood, 2 * search->n * sizeof *stood);
        search->program.n = 0;
        spare_others(search, SUNDER_I_NOBODY, SUNDER_I_NOBODY);
        done = !search->failed && sunder_i_search_repair(search);
    }
    sunder_i_search_end_copy(search, stood, !done);
    return done;
}

static bool make_good(sunder_i_search *s, uint32_t i, uint32_t j)
{
    sunder_i_neighbourhood about;
    bool done = false, wider = true;
    if (!sunder_i_neighbourhood_init(&about, s)) s->failed = true;
    for (size_t k = 0; k < sizeof stage / sizeof *stage && wider && !done && !s->failed; k++) {
        done = sunder_i_neighbourhood_repair(&about, i, j, stage[k], s->gap);
        wider = about.wider;
    }
    sunder_i_neighbourhood_free(&about);
    return done;
}

sunder_status sunder_i_cluster_demand_margin(const sunder_i_model *model, const sunder_i_cluster *cluster, uint32_t a,
                                             uint32_t b, bool others, double *move, bool *done, sunder_error *err)
{
    sunder_i_search s;
    bool ok = sunder_i_search_init_about(&s, model, cluster, move) && ask_margins(&s, a, b);
    *done = false;
    if (ok && s.relaxations.n) {
        const uint32_t i = sunder_i_search_place_of(&s, model->body_of[a]),
                       j = sunder_i_search_place_of(&s, model->body_of[b]);
        const uint32_t p = i == SUNDER_I_NOBODY ? j : i, q = j == SUNDER_I_NOBODY ? i : j;
        if (!others) spare_others(&s, p, q);
        *done = p != SUNDER_I_NOBODY && !s.failed && make_good(&s, p, q);
        s.n = cluster->n;
        if (*done && !s.failed) sunder_i_search_round(&s, move);
    }
    ok = ok && !s.failed;
    sunder_i_search_free(&s);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
