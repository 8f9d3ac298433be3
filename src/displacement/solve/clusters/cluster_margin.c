/* The margin of a cluster: what its bodies are asked to keep beyond the gap, so that rounding takes nothing of it. */
#include "displacement/solve/clusters/cluster_stages.h"

#include "base/extremes.h"

#include <math.h>

/* The margin covers the rounding of moves, and of the search itself. It is a power of two: four units in the last place
 * of the largest coordinate plus the greatest distance demanded. It grows fourfold with each failed check. So if a
 * shift of the layer keeps coordinates in their binades, the search, which computes relative to the bodies' own
 * origins, does the same. */
double sunder_i_solver_margin(const sunder_i_solver *solver, const uint32_t *b, size_t n)
{
    double largest = 0;
    unsigned widened = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *body = &solver->model.body[b[k]];
        if (body->pieces == 0 || (body->held && !body->far)) continue;
        for (int c = 0; c < 4; c++) {
            const double far = fabs(body->origin[c & 1]) + fabs(body->box[c]);
            if (far > largest) largest = far;
        }
        if (solver->widened[b[k]] > widened) widened = solver->widened[b[k]];
    }
    int exponent;
    frexp(largest + sunder_i_max(solver->model.rules.full_gap, solver->barriers.farthest), &exponent);
    return ldexp(1, exponent - 51 + 2 * (int)widened);
}

void sunder_i_solver_narrow_margin(sunder_i_solver *solver, sunder_i_cluster *cluster)
{
    unsigned widened = 0;
    for (size_t k = 0; k < cluster->n; k++) {
        const uint32_t b = cluster->body[k];
        if (solver->widened[b] > widened) widened = solver->widened[b];
        /* A fixed body may be a member of another cluster as well. */
        if (!solver->model.body[b].fixed) solver->widened[b] = 0;
    }
    cluster->margin = ldexp(cluster->margin, -2 * (int)widened);
}
