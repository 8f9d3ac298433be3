/* Clusters without a solution: limits, fixed bodies, or no room between them.
 *
 * What remains must be as small as can be, worst first. The pairs that clash at the best position known are the
 * suspects. All of them are granted the same shortfall, and the least at which the program has a solution is found by
 * halving; then each in turn is asked for its full gap again, and keeps only the shortfall that it cannot do without.
 * Every other pair keeps its full gap throughout, so an insoluble pair leaves the rest of its cluster solved. A
 * position where the shortfalls hold is always at hand (the present one), so each step starts from a feasible program.
 */
#include "displacement/search.h"

#include <math.h>
#include <string.h>

#define HALVINGS 12
/* Constraints looked at before the rest is left as it is: a second or so. */
#define EFFORT 30000000u

static bool has_time(const sunder_i_search *s) { return s->steps + s->program.work < s->effort && !s->failed; }

void sunder_i_search_clip(sunder_i_search *s)
{
    for (size_t k = 0; k < s->n; k++) {
        const double limit = s->town->body[s->body[k]].limit, length = hypot(s->t[2 * k], s->t[2 * k + 1]);
        if (!(s->mass[k] > 0) || !(length > limit)) continue;
        s->t[2 * k] *= limit / length;
        s->t[2 * k + 1] *= limit / length;
    }
}

double sunder_i_search_allowed(const sunder_i_search *s, uint32_t i, uint32_t j)
{
    for (size_t k = 0; k < s->allowed_n; k++)
        if (s->allowed[k].i == i && s->allowed[k].j == j) return s->allowed[k].violation;
    return 0;
}

/* The least shortfall of suspects first .. end, by halving between 0 and `high`, at which there is a position. */
static void halve(sunder_i_search *s, size_t first, size_t end, double high)
{
    double low = 0;
    for (int k = 0; k < HALVINGS && high - low > s->tolerance && has_time(s); k++) {
        const double middle = (low + high) / 2;
        for (size_t p = first; p < end; p++) s->allowed[p].violation = middle;
        if (sunder_i_search_round(s))
            high = middle;
        else
            low = middle;
    }
    for (size_t p = first; p < end; p++) s->allowed[p].violation = high;
}

/* Where to start from: the compromise that the search ended with, within the limits, or where everything came from if
 * less is missed there (a house in a yard too narrow for its gap had better stay in it than be caught half-way through
 * the wall). Returns the worst violation. */
static double choose_start(sunder_i_search *s)
{
    sunder_i_search_clip(s);
    double worst = sunder_i_search_look(s, s->t);
    double *compromise = sunder_i_alloc(2 * s->n, sizeof *compromise);
    if (!compromise) {
        s->failed = true;
        return worst;
    }
    memcpy(compromise, s->t, 2 * s->n * sizeof *compromise);
    for (size_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0) s->t[2 * k] = s->t[2 * k + 1] = 0;
    const double at_home = sunder_i_search_look(s, s->t);
    if (at_home <= worst)
        worst = at_home;
    else {
        memcpy(s->t, compromise, 2 * s->n * sizeof *compromise);
        worst = sunder_i_search_look(s, s->t);
    }
    sunder_i_free(compromise);
    return worst;
}

void sunder_i_search_relax(sunder_i_search *s)
{
    const double worst = choose_start(s);
    if (s->clashes == 0 || s->failed) return;
    s->allowed = sunder_i_alloc(s->clashes, sizeof *s->allowed);
    if (!s->allowed) {
        s->failed = true;
        return;
    }
    memcpy(s->allowed, s->clash, s->clashes * sizeof *s->allowed);
    s->allowed_n = s->clashes;
    s->program.n = 0;
    s->effort = s->steps + s->program.work + EFFORT;
    halve(s, 0, s->allowed_n, worst + s->tolerance);
    for (size_t p = 0; p < s->allowed_n && has_time(s); p++) {
        const double shared = s->allowed[p].violation;
        s->allowed[p].violation = 0;
        if (sunder_i_search_round(s)) continue;
        halve(s, p, p + 1, shared);
    }
    for (int k = 0; k < 6 && has_time(s); k++)
        if (!sunder_i_search_round(s)) break;
}
