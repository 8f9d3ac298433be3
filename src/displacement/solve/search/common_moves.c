/* Bodies that moved together get exactly the same move.
 *
 * A row that was pushed as a whole has one move, but programs give each of its bodies a slightly different one, and
 * rounding may turn that into one unit in the last place. By that unit a pair in the row that is left in conflict, and
 * may stand no worse, stands worse. So neighbours whose moves differ by less than the tolerance take the move of one of
 * them. In a row of hundreds these differences add up: the violation at its ends is then repaired by pushing the row.
 * If anything is in the way after that, all bodies keep their moves. */
#include "displacement/solve/search/pushed.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/union_find.h"

#include <math.h>
#include <string.h>

static void join_alike(sunder_i_search *s, uint32_t i, uint32_t j, void *context)
{
    const double *p = s->t + 2 * (size_t)i, *q = s->t + 2 * (size_t)j;
    if (s->mass[i] > 0 && s->mass[j] > 0 && fabs(p[0] - q[0]) <= s->tolerance && fabs(p[1] - q[1]) <= s->tolerance)
        sunder_i_union_join(context, i, j);
}

/* Separates clashing pairs by pushing, each once. Returns whether no clash is left. */
static bool push_apart(sunder_i_search *s)
{
    if (sunder_i_search_find_clashes(s, s->t) <= s->tolerance) return true;
    sunder_i_pushed pushed;
    const size_t n = s->clashes;
    sunder_i_clash *list = sunder_i_alloc(n, sizeof *list);
    if (!sunder_i_pushed_init(&pushed, s, sunder_i_max(s->gap, s->extent / SMALL_PART)) || !list) s->failed = true;
    if (list && n) memcpy(list, s->clash, n * sizeof *list);
    for (size_t k = 0; k < n && !s->failed; k++) {
        double along[2];
        const double missing = sunder_i_pushed_missing(&pushed, list[k].i, list[k].j, along);
        if (missing > 0 && sunder_i_pushed_reaches(&pushed, list[k].i, list[k].j, along, missing))
            sunder_i_pushed_part(&pushed, missing);
    }
    sunder_i_pushed_free(&pushed);
    sunder_i_free(list);
    return !s->failed && sunder_i_search_find_clashes(s, s->t) <= s->tolerance;
}

void sunder_i_search_equalise_moves(sunder_i_search *search)
{
    uint32_t *root = sunder_i_alloc(search->n, sizeof *root);
    double *stood = sunder_i_search_copy_moves(search);
    search->failed = search->failed || !root;
    if (!search->failed) {
        sunder_i_union_init(root, search->n);
        sunder_i_search_visit_near(search, search->t, 2 * search->gap, join_alike, root);
        for (uint32_t k = 0; k < search->n; k++)
            memcpy(search->t + 2 * (size_t)k, stood + 2 * (size_t)sunder_i_union_find(root, k), 2 * sizeof *search->t);
    }
    sunder_i_search_end_copy(search, stood, !search->failed && !push_apart(search));
    sunder_i_free(root);
}
