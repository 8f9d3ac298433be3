/* The constraints of a program as a list. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>
#include <stdlib.h>

const sunder_i_constraint *sunder_i_search_look_up(const sunder_i_constraint *c, size_t n, uint64_t key)
{
    const sunder_i_constraint wanted = {.key = key};
    return n ? bsearch(&wanted, c, n, sizeof *c, sunder_i_by_constraint) : NULL;
}

double sunder_i_search_force_before(const sunder_i_search *search, uint64_t key)
{
    const sunder_i_constraint *before = sunder_i_search_look_up(search->old, search->old_n, key);
    return before ? before->force : 0;
}

/* Pieces along one wall give almost equal constraints, of which the program needs only the strongest. The forces of the
 * others are added to it. */
void sunder_i_search_add_constraint(sunder_i_search *search, size_t first, const sunder_i_constraint *constraint)
{
    sunder_i_quadratic *p = &search->program;
    for (size_t k = first; k < p->n; k++) {
        sunder_i_constraint *other = &p->constraint[k];
        if (fabs(other->n[0] - constraint->n[0]) > SAME_NORMAL || fabs(other->n[1] - constraint->n[1]) > SAME_NORMAL)
            continue;
        if (other->d < constraint->d) {
            const double force = other->force + constraint->force;
            *other = *constraint;
            other->force = force;
        }
        return;
    }
    if (!sunder_i_reserve(&p->constraint, &p->capacity, p->n + 1, sizeof *p->constraint)) {
        search->failed = true;
        return;
    }
    p->constraint[p->n++] = *constraint;
}
