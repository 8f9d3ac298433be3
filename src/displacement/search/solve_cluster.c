/* A cluster from start to rounded moves: descend, and where sides contradict each other jump, descend again; pairs that
 * find no solution are given up; then round. */
#include "displacement/layer/rounding.h"
#include "displacement/search/stages.h"
#include "displacement/search/tuning.h"

#include "base/invariant.h"

#include <string.h>

void sunder_i_search_round(const sunder_i_search *s, double *move)
{
    SUNDER_I_CHECK(sunder_i_search_check(s), s->n);
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) sunder_i_round_move(s->model, s->body[k], s->t + 2 * k, move + 2 * k, NULL);
}

void sunder_i_search_hand_over(sunder_i_search *s, sunder_i_cluster *cluster)
{
    cluster->relaxations = s->relaxations;
    cluster->restored = s->restored;
    cluster->restored_n = s->restored_n;
    memset(&s->relaxations, 0, sizeof s->relaxations);
    s->restored = NULL;
    s->restored_n = s->restored_capacity = 0;
}

sunder_status sunder_i_cluster_solve(const sunder_i_model *model, sunder_i_cluster *cluster, double *move,
                                     sunder_error *err)
{
    sunder_i_search s;
    if (!sunder_i_search_init(&s, model, cluster->body, cluster->n, cluster->margin, move)) s.failed = true;
    bool done = !s.failed && sunder_i_search_descend(&s);
    for (int k = 0; k < MOST_JUMPS && !done && !s.failed; k++) {
        if (!sunder_i_search_jump(&s) && cluster->limited) break;
        done = sunder_i_search_descend(&s);
    }
    if (!done && !s.failed) done = sunder_i_search_spread(&s);
    if (!done && !s.failed && cluster->limited) {
        sunder_i_search_give_up(&s);
        sunder_i_search_hand_over(&s, cluster);
    }
    const bool failed = s.failed;
    if (!failed) sunder_i_search_round(&s, move);
    sunder_i_search_free(&s);
    return failed ? sunder_i_no_memory(err) : SUNDER_OK;
}
