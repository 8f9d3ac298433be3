/* Clusters without a solution: limits, fixed bodies, or no room between them.
 *
 * What remains must be as small as can be, worst first. The pairs that clash, which the search gave up, are the
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

void sunder_i_search_relax(sunder_i_search *s)
{
    const double worst = sunder_i_search_look(s, s->t);
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
