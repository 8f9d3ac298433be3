/* Clusters without a solution: because of limits, fixed bodies, or lack of room. The order of the stages is a table.
 *
 * Pairs that clash in the original places are given up, as few as the search can find (elastic.c). Such a pair is
 * relaxed (relaxation.c): it stands no worse than at the start, and no body is moved to ease it. At worst all bodies
 * are in their original places, where every relaxation holds. (retry_cluster.c asks for the relaxed pairs again.) */
#include "displacement/layer/stage_table.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The state that the stages share. */
typedef struct giving_up {
    sunder_i_stage_run run;
    sunder_i_search *s;
    sunder_i_clash *at_home; /* [n] pairs that clash in the original places */
    size_t n;
    bool done; /* nothing clashes */
} giving_up;

sunder_i_clash *sunder_i_search_at_home(sunder_i_search *search, size_t *n)
{
    double *stand = sunder_i_search_copy_moves(search);
    if (!stand) return NULL;
    for (uint32_t k = 0; k < search->n; k++) sunder_i_search_send_home(search, k);
    sunder_i_search_find_clashes(search, search->t);
    sunder_i_search_end_copy(search, stand, true);
    *n = search->clashes;
    sunder_i_clash *at_home = sunder_i_alloc(*n, sizeof *at_home);
    if (at_home && *n) memcpy(at_home, search->clash, *n * sizeof *at_home);
    if (at_home && *n) qsort(at_home, *n, sizeof *at_home, sunder_i_by_id_pair);
    return at_home;
}

bool sunder_i_search_waive_margins(sunder_i_search *search)
{
    size_t n = 0;
    sunder_i_clash *at_home = sunder_i_search_at_home(search, &n);
    const size_t before = search->relaxations.n;
    const double margin = search->gap - search->model->rules.gap;
    if (!at_home) search->failed = true;
    for (size_t k = 0; k < n && !search->failed; k++)
        if (at_home[k].violation <= margin + search->tolerance)
            sunder_i_search_relax(search, at_home[k].i, at_home[k].j);
    sunder_i_free(at_home);
    if (search->relaxations.n > before && !sunder_i_relaxations_index(&search->relaxations, search->model))
        search->failed = true;
    return !search->failed && search->relaxations.n > before;
}

/* Bodies that are almost at their original places return there, if nothing clashes then. Only unobstructed bodies are
 * that near. */
static void return_home(void *state)
{
    sunder_i_search *s = ((giving_up *)state)->s;
    double *stand = sunder_i_search_copy_moves(s);
    if (s->failed) return;
    for (uint32_t k = 0; k < s->n; k++)
        if (hypot(s->t[2 * k], s->t[2 * k + 1]) <= NEARLY_HOME * s->extent) sunder_i_search_send_home(s, k);
    sunder_i_search_end_copy(s, stand, sunder_i_search_find_clashes(s, s->t) > s->tolerance);
}

/* ---- The order --------------------------------------------------------------------------------------------------- */

static void fall_short(void *state)
{
    giving_up *x = state;
    x->done = sunder_i_search_fall_short(x->s, x->at_home, x->n);
}

static void descend_last(void *state) { sunder_i_search_descend_or_stay(((giving_up *)state)->s); }

static const sunder_i_stage stages[] = {
    {"fall short", NULL, fall_short, 0},
    {"descend again", NULL, descend_last, 0},
    {"return home", NULL, return_home, 0},
};

static const char *look(const void *state, const double before[2], double now[2])
{
    const giving_up *x = state;
    (void)before;
    now[0] = sunder_i_search_cost(x->s, x->s->t);
    now[1] = x->done;
    return x->done ? "solved but for pairs given up" : "not solved";
}

static const sunder_i_stage_table table = {"give up", stages, sizeof stages / sizeof *stages, look};

void sunder_i_search_give_up(sunder_i_search *search)
{
    giving_up x = {.run = {.log = search->log, .failed = &search->failed}, .s = search};
    x.at_home = sunder_i_search_at_home(search, &x.n);
    if (!x.at_home || sunder_i_stages_run(&table, &x)) search->failed = true; /* memory is out */
    sunder_i_free(x.at_home);
}
