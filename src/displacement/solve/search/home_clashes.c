/* The pairs of a cluster that clash in the original places. */
#include "displacement/solve/search/search_stages.h"

#include <stdlib.h>
#include <string.h>

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
