/* Two bodies are shut in (shut_in_pairs.c): which of their conflicts have no solution, if the others stay?
 *
 * A conflict that has no solution by itself is left for good. Most of the others have none either, since the rest of
 * the two blocks is in the way. That is proved in the plane of their relative move (prove/proofs/plane.c), with all
 * other conflicts between these bodies held no worse than at the start. Later stages demand at least that of them,
 * since only pairs in conflict at the start are ever left in conflict. So a conflict without a solution here has none
 * at all, and is not asked for again, in clusters of dozens of bodies. An overlap may still be separated by less than
 * the gap: the stage that asks for that (../search/retry_cluster.c) asks in any case. */
#include "displacement/prove/proofs/feasibility.h"
#include "displacement/solve/clusters/cluster_stages.h"
#include "displacement/solve/clusters/tuning.h"

#include <stdlib.h>
#include <string.h>

/* The members of both bodies, ascending; NULL if memory is out. */
static uint32_t *members_of(const sunder_i_model *model, const sunder_i_id_pair *bodies, size_t *n)
{
    const sunder_i_body *p = &model->body[bodies->a], *q = &model->body[bodies->b];
    uint32_t *set = sunder_i_alloc((size_t)p->members + q->members, sizeof *set);
    if (!set) return NULL;
    memcpy(set, model->member + p->member, p->members * sizeof *set);
    memcpy(set + p->members, model->member + q->member, q->members * sizeof *set);
    *n = sunder_i_set_make(set, (size_t)p->members + q->members);
    return set;
}

/* Lists the requirements of all conflicts between the two bodies: the n conflicts of `relaxation`, and those of the
 * model, which are infeasible within limits. NULL if memory is out. */
static sunder_i_requirement *list_required(const sunder_i_model *model, const sunder_i_id_pair *bodies,
                                           const sunder_i_relaxation *relaxation, size_t n, size_t *required)
{
    const sunder_i_relaxations *all = &model->relaxations;
    sunder_i_requirement *list = sunder_i_alloc(n + all->n, sizeof *list);
    *required = 0;
    for (size_t k = 0; k < n && list; k++) list[(*required)++] = sunder_i_requirement_below(model, &relaxation[k]);
    for (size_t k = 0; k < all->n && list; k++) {
        const uint32_t i = model->body_of[all->item[k].a], j = model->body_of[all->item[k].b];
        if ((i == bodies->a && j == bodies->b) || (i == bodies->b && j == bodies->a))
            list[(*required)++] = sunder_i_requirement_below(model, &all->item[k]);
    }
    if (*required) qsort(list, *required, sizeof *list, sunder_i_by_id_pair);
    return list;
}

sunder_status sunder_i_find_unsolvable(const sunder_i_model *model, const sunder_i_id_pair *bodies,
                                       sunder_i_relaxation *relaxation, size_t n, sunder_error *err)
{
    const uint32_t body[2] = {bodies->a, bodies->b};
    uint64_t in_vain = 0;
    if ((uint64_t)model->body[body[0]].pieces * model->body[body[1]].pieces > MOST_IN_PLANE) return SUNDER_OK;
    sunder_i_planes planes = {0};
    sunder_i_precedents precedents = {0};
    sunder_i_subproblem two = {.model = model,
                               .body = body,
                               .bodies = 2,
                               .instead = 2 * sunder_i_farthest_near(model, bodies->a, bodies->b),
                               .coarse = COARSE_IN_PLANE,
                               .planes = &planes,
                               .precedents = &precedents,
                               .effort = 0, /* only the plane is used */
                               .most = 2};
    uint32_t *members = members_of(model, bodies, &two.features);
    sunder_i_requirement *required = list_required(model, bodies, relaxation, n, &two.required_n);
    sunder_status status = members && required ? SUNDER_OK : sunder_i_failure_cause(err);
    two.feature = members;
    two.required = required;
    for (size_t k = 0; k < n && !status && in_vain < EFFORT_IN_VAIN; k++) {
        if (relaxation[k].infeasible) continue;
        sunder_i_decision decision;
        two.a = relaxation[k].a;
        two.b = relaxation[k].b;
        status = sunder_i_decide(&two, &decision, err);
        relaxation[k].infeasible = decision.verdict == SUNDER_I_INFEASIBLE;
        if (!relaxation[k].infeasible) in_vain += decision.work;
        sunder_i_decision_clear(&decision);
    }
    sunder_i_planes_clear(&planes);
    sunder_i_free_all(members, required);
    return status;
}
