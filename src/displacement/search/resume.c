/* A cluster from where branch and bound has put some of its bodies: is that a solution for the search as well, and the
 * least moves about it? */
#include "displacement/search/stages.h"
#include "displacement/search/tuning.h"

#include <string.h>

/* From now on these do not count. */
static bool restore(sunder_i_search *s, const sunder_i_restored *restored, size_t n)
{
    if (!sunder_i_reserve(&s->restored, &s->restored_capacity, n, sizeof *s->restored)) return false;
    if (n) memcpy(s->restored, restored, n * sizeof *s->restored);
    s->restored_n = n;
    return true;
}

sunder_status sunder_i_cluster_resume(const sunder_i_model *model, sunder_i_cluster *cluster,
                                      const sunder_i_restored *restored, size_t n, double *move, bool *done,
                                      sunder_error *err)
{
    sunder_i_search s;
    bool ok = sunder_i_search_init_about(&s, model, cluster, move) && restore(&s, restored, n);
    s.patience = sunder_i_search_work(&s) + PATIENCE + PATIENCE_EACH * (uint64_t)s.n;
    *done = ok && sunder_i_search_descend(&s);
    ok = ok && !s.failed;
    if (ok && *done) {
        s.n = cluster->n;
        sunder_i_search_round(&s, move);
        sunder_i_search_hand_over(&s, cluster);
    }
    sunder_i_search_free(&s);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}
