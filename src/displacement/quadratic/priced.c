/* Programs with priced constraints, whose violation v costs price v + v^2 / (2 give).
 *
 * The force of such a constraint is at most its price as long as the constraint holds, and a violated one is like a
 * constraint n.u >= d + give * price that gives and has no price: its cost differs by a constant only. So each priced
 * constraint is in one of two states: it gives, from d + give * price on, or it is firm. All give at first. A
 * constraint that gives with less force than its price holds with room to spare, and becomes firm; one that is firm
 * with more force than its price gives again. The states are those of the solution once none changes. The present
 * solution satisfies a constraint that becomes firm, so no state makes the program infeasible. */
#include "displacement/quadratic/methods.h"
#include "displacement/quadratic/tuning.h"

#include "base/memory.h"

#include <math.h>

typedef struct priced {
    size_t k; /* the constraint's index */
    double d, give;
    bool firm;
} priced;

/* Changes the states that contradict the forces. Returns whether there were any. */
static bool change_states(sunder_i_quadratic *p, priced *list, size_t n)
{
    bool any = false;
    for (size_t k = 0; k < n; k++) {
        sunder_i_constraint *c = &p->constraint[list[k].k];
        const bool firm = c->force < c->price * (list[k].firm ? 1 + PRICE_HAIR : 1 - PRICE_HAIR);
        any = any || firm != list[k].firm;
        list[k].firm = firm;
        c->give = firm ? 0 : list[k].give;
        c->d = list[k].d + c->give * c->price;
    }
    return any;
}

double sunder_i_quadratic_solve_priced(sunder_i_quadratic *program, double softness, double tolerance, double scale)
{
    size_t n = 0;
    for (size_t k = 0; k < program->n; k++) n += program->constraint[k].price > 0;
    if (n == 0) return sunder_i_quadratic_solve_once(program, softness, tolerance, scale);
    priced *list = sunder_i_alloc(n, sizeof *list);
    if (!list) return -1;
    n = 0;
    for (size_t k = 0; k < program->n; k++) {
        sunder_i_constraint *c = &program->constraint[k];
        if (!(c->price > 0)) continue;
        list[n++] = (priced){k, c->d, c->give, false};
        c->d += c->give * c->price;
    }
    program->priced = true;
    double missed = sunder_i_quadratic_solve_once(program, softness, tolerance, scale);
    for (int round = 0; round < MOST_STATES && missed >= 0 && missed < INFINITY && change_states(program, list, n);
         round++)
        missed = sunder_i_quadratic_solve_once(program, softness, tolerance, scale);
    for (size_t k = 0; k < n; k++) {
        program->constraint[list[k].k].d = list[k].d;
        program->constraint[list[k].k].give = list[k].give;
    }
    sunder_i_free(list);
    return missed;
}
