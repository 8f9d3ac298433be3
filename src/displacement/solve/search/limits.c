/* Limits of moves, as constraints of the programs. A limit is a disc; the program has tangents of it, each of which is
 * valid wherever the body is, and gets further ones where its solution exceeds one. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/list.h"

#include <math.h>
#include <string.h>

/* A move that exceeds its limit by at most this counts as within it: half the tolerance, or, if that is greater, a
 * share of the limit (LIMIT_SLACK) that covers the error of programs and the room of an exact fit. Rounding to the
 * limit repairs it later. */
static double slack_of_limit(const sunder_i_search *s, double limit)
{
    return sunder_i_max(s->tolerance / 2, limit * LIMIT_SLACK);
}

double sunder_i_search_excess(const sunder_i_search *search, uint32_t i, const double *t)
{
    const double limit = sunder_i_search_limit(search, i);
    if (!(search->mass[i] > 0) || limit == INFINITY) return 0;
    const double over = hypot(t[2 * i], t[2 * i + 1]) - limit;
    return over > slack_of_limit(search, limit) ? over : 0;
}

bool sunder_i_search_is_beyond(const sunder_i_search *search, const double *t)
{
    for (uint32_t k = 0; k < search->n; k++)
        if (sunder_i_search_excess(search, k, t) > 0) return true;
    return false;
}

/* The number of tangents of body k among the first n constraints, which are sorted; *first: the index of the first. */
static size_t tangents_of(const sunder_i_search *s, size_t n, uint32_t k, size_t *first)
{
    const sunder_i_constraint *c = s->program.constraint, key = {.key = UINT64_C(1) << 63 | (uint64_t)k << 32};
    *first = sunder_i_lower_bound(&key, c, n, sizeof key, sunder_i_by_constraint);
    size_t end = *first;
    while (end < n && sunder_i_is_tangent(&c[end]) && c[end].j == k) end++;
    return end - *first;
}

/* Adds the tangent in this direction, unless an almost equal one is among the first `before` constraints. If that one
 * did not help, the limit contradicts other constraints. */
static void add_tangent(sunder_i_search *s, size_t before, uint32_t k, const double direction[2])
{
    const double length = hypot(direction[0], direction[1]);
    const double n[2] = {-direction[0] / length, -direction[1] / length};
    size_t first;
    if (!(length > 0) || !isfinite(n[0]) || !isfinite(n[1])) return;
    const size_t known = tangents_of(s, before, k, &first);
    for (size_t c = first; c < first + known; c++) {
        const double *other = s->program.constraint[c].n;
        if (n[0] * other[0] + n[1] * other[1] > SAME_TANGENT) return;
    }
    sunder_i_search_add_constraint(
        s, s->program.n,
        &(sunder_i_constraint){.i = SUNDER_I_GROUND,
                               .j = k,
                               .n = {n[0], n[1]},
                               .d = -sunder_i_search_limit(s, k),
                               .key = UINT64_C(1) << 63 | (uint64_t)k << 32 | s->tangents++});
}

/* Stores in push[2] the move that the forces of all constraints but its limit would give body k, if no other body
 * moved. `before`: as in add_tangent(). Returns whether the limit is active. */
static bool push_on(const sunder_i_search *s, size_t before, uint32_t k, double push[2])
{
    size_t first;
    const size_t n = tangents_of(s, before, k, &first);
    bool acts = false;
    memcpy(push, s->next + 2 * k, 2 * sizeof *push);
    for (size_t c = first; c < first + n; c++) {
        const sunder_i_constraint *tangent = &s->program.constraint[c];
        acts = acts || tangent->force > 0;
        for (int x = 0; x < 2; x++) push[x] -= s->mass[k] * tangent->force * tangent->n[x];
    }
    return acts;
}

/* Adds tangents of the limit circle for bodies whose move s->next exceeds their limit. One is in the direction of the
 * move, which converges fast if neighbours determine the move. If a tangent of the body is active already, another one
 * is in the direction in which the other constraints push the body, which converges fast if nothing else holds it. With
 * only one of the two, each tangent would halve the error in the other case. Returns whether any was added. */
bool sunder_i_search_constrain_limits(sunder_i_search *search)
{
    const size_t before = search->program.n;
    for (uint32_t k = 0; k < search->n; k++) {
        double push[2];
        if (!(sunder_i_search_excess(search, k, search->next) > 0)) continue;
        const bool acts = push_on(search, before, k, push);
        add_tangent(search, before, k, search->next + 2 * k);
        if (acts) add_tangent(search, before, k, push);
    }
    return search->program.n > before;
}
