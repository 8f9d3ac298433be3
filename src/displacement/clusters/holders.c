/* What lies in two features that have to part, with leave to overlap both, is kept in one of them; which one, is for
 * layer/inclusion.c. */
#include "displacement/clusters/stages.h"
#include "displacement/layer/resolution.h"

/* Was either in a cluster for which better sides were looked for? It has a place that it keeps, and its holder. */
static bool is_settled(const sunder_i_solver *s, const sunder_i_relation *r)
{
    return s->improved[s->model.body_of[r->a]] || s->improved[s->model.body_of[r->b]];
}

sunder_status sunder_i_solver_choose_holders(sunder_i_solver *s, sunder_error *err)
{
    if (s->model.inclusions == 0) return SUNDER_OK;
    bool *conflict = sunder_i_calloc(s->start.n, sizeof *conflict);
    if (!conflict) return sunder_i_no_memory(err);
    for (size_t k = 0; k < s->start.n; k++)
        conflict[k] = !is_settled(s, &s->start.pair[k]) && sunder_i_is_open_conflict(&s->model, &s->start.pair[k]);
    const sunder_status status = sunder_i_inclusions_choose(&s->model, &s->start, conflict, err);
    sunder_i_free(conflict);
    return status;
}
