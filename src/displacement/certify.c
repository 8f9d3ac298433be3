/* A few bodies, their limits, and those about them: is there no solution, or does this one do?
 *
 * For each pair the region (region.h) holds every relative move u that any solution could have. Regions are convex, so
 * "every pair in its region, every move t within its limit" is a convex program, and forces f on the regions' edges
 * n.(t_j - t_i) >= h, of any size, prove that it has no solution if
 *
 *     sum of f h  >  sum over the bodies of L |sum of f n, signed by the side of the pair|,
 *
 * for any solution would make the left side at most the sum of f n.(t_j - t_i), which is at most the right
 * [Farkas; Boyd and Vandenberghe, Convex Optimization, section 5.8]. The program's own forces are tried.
 *
 * If they prove nothing, the program's solution is a candidate. Where two bodies overlap in it, in two convex pieces,
 * each solution has u outside one of the edges of the pieces' difference: the pair's region is cut by one edge after
 * another, and each branch shown to be void in its turn, depth first. A candidate in which nothing overlaps ends the
 * search. Pairs are looked at when a candidate makes them overlap.
 *
 * The gap has round corners, for which an inscribed polygon stands; a solution may miss the difference. Pairs that may
 * overlap, for one lies in the other or could get there (peace.h), are left out altogether, which makes the proof
 * harder and no less true: what moves inside something is for the search to care.
 * The sums are in doubles, and what is asked of a proof beyond equality is far more than their rounding can be. */
#include "displacement/certify.h"

#include "displacement/inquiry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Effort: constraints that the programs looked at, bodies, pairs. */
#define MOST_WORK 40000000
#define MOST_BODIES 250
#define MOST_PAIRS 150

static sunder_status search(sunder_i_inquiry *c, sunder_i_verdict *verdict, sunder_error *err)
{
    for (;;) {
        bool shown;
        sunder_status status = sunder_i_inquiry_solve(c, MOST_WORK, &shown, err);
        if (status || c->program.work > MOST_WORK || c->pairs > MOST_PAIRS) return status;
        if (!shown) {
            sunder_i_meeting deepest[SUNDER_I_CHOICES];
            const size_t n = sunder_i_inquiry_meetings(c, deepest);
            if (c->scratch.failed) return sunder_i_no_memory(err);
            if (n == 0) {
                *verdict = SUNDER_I_SOLVED;
                return SUNDER_OK;
            }
            status = sunder_i_inquiry_open(c, deepest, n, err);
            if (status) return status;
        }
        if (!sunder_i_inquiry_next(c)) {
            *verdict = SUNDER_I_INSOLUBLE;
            return SUNDER_OK;
        }
    }
}

/* ---- Who takes part -------------------------------------------------------------------------------------------------
 */

/* The bodies and all that could get in their way, ascending; the bodies alone if those are too many. */
static sunder_status gather(sunder_i_inquiry *c, const uint32_t *body, size_t n, sunder_error *err)
{
    const sunder_i_town *town = c->town;
    sunder_i_list near = {0};
    for (size_t k = 0; k < n; k++)
        c->longest = fmax(c->longest, town->body[body[k]].fixed ? 0 : town->body[body[k]].limit);
    bool ok = true;
    for (size_t k = 0; k < n && ok && isfinite(c->longest); k++) {
        const sunder_i_body *b = &town->body[body[k]];
        for (uint32_t m = 0; m < b->members && ok; m++) {
            double box[4];
            sunder_i_box_grow(town->box + 4 * (size_t)town->member[b->member + m], 2 * c->longest, box);
            if (b->pieces) ok = sunder_i_index_query(&town->tree, box, &near);
        }
    }
    for (size_t k = 0; k < near.n; k++) near.item[k] = town->body_of[near.item[k]];
    near.n = sunder_i_set_make(near.item, near.n);
    if (near.n > MOST_BODIES) near.n = 0;
    c->body = sunder_i_alloc(near.n + n, sizeof *c->body);
    ok = ok && c->body;
    if (ok) {
        memcpy(c->body, body, n * sizeof *c->body);
        if (near.n) memcpy(c->body + n, near.item, near.n * sizeof *c->body);
        c->bodies = sunder_i_set_make(c->body, n + near.n);
    }
    sunder_i_free(near.item);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}

static sunder_status prepare(sunder_i_inquiry *c, double *t, sunder_error *err)
{
    c->limit = sunder_i_alloc(c->bodies, sizeof *c->limit);
    c->mass = sunder_i_alloc(c->bodies, sizeof *c->mass);
    c->net = sunder_i_alloc(2 * c->bodies, sizeof *c->net);
    if (!c->limit || !c->mass || !c->net) return sunder_i_no_memory(err);
    c->program = (sunder_i_quadratic){.bodies = c->bodies, .mass = c->mass, .t = t};
    for (uint32_t b = 0; b < c->bodies; b++) {
        const sunder_i_body *body = &c->town->body[c->body[b]];
        c->limit[b] = body->fixed ? 0 : body->limit;
        c->mass[b] = c->limit[b] > 0 ? 1 : 0;
        c->longest = fmax(c->longest, c->limit[b]);
    }
    return SUNDER_OK;
}

static void clear(sunder_i_inquiry *c)
{
    for (size_t k = 0; k < c->pairs; k++) sunder_i_obstruction_free(&c->pair[k].obstruction);
    sunder_i_free(c->limit);
    sunder_i_free(c->mass);
    sunder_i_free(c->net);
    sunder_i_free(c->pair);
    sunder_i_free(c->stack);
    sunder_i_free(c->edge);
    sunder_i_free(c->program.constraint);
    sunder_i_free(c->scratch.xy);
}

/* The pairs that are known to be in each other's way, before any candidate says so. */
static sunder_status add_pairs(sunder_i_inquiry *c, const sunder_i_couple *pair, size_t pairs,
                               sunder_i_verdict *verdict, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < pairs && !status && *verdict == SUNDER_I_UNKNOWN; k++) {
        const uint32_t *a = bsearch(&pair[k].a, c->body, c->bodies, sizeof *a, sunder_i_by_number);
        const uint32_t *b = bsearch(&pair[k].b, c->body, c->bodies, sizeof *b, sunder_i_by_number);
        const uint32_t i = (uint32_t)(a - c->body), j = (uint32_t)(b - c->body);
        if (sunder_i_inquiry_may_overlap(c, i, j)) continue;
        status = sunder_i_inquiry_add_pair(c, i, j, err);
        if (!status && c->pair[c->pairs - 1].region.n == 0) *verdict = SUNDER_I_INSOLUBLE;
    }
    return status;
}

sunder_status sunder_i_certify(const sunder_i_town *town, const uint32_t *body, size_t bodies,
                               const sunder_i_couple *pair, size_t pairs, sunder_i_verdict *verdict,
                               sunder_i_solution *solution, sunder_error *err)
{
    *verdict = SUNDER_I_UNKNOWN;
    memset(solution, 0, sizeof *solution);
    if (pairs > MOST_PAIRS) return SUNDER_OK;
    sunder_i_inquiry c = {.town = town};
    sunder_status status = gather(&c, body, bodies, err);
    double *t = status ? NULL : sunder_i_calloc(2 * c.bodies, sizeof *t);
    if (!status && !t) status = sunder_i_no_memory(err);
    if (!status) status = prepare(&c, t, err);
    if (!status && isfinite(c.longest)) {
        status = add_pairs(&c, pair, pairs, verdict, err);
        if (!status && *verdict == SUNDER_I_UNKNOWN) status = search(&c, verdict, err);
    }
    clear(&c);
    *solution = (sunder_i_solution){c.body, t, c.bodies};
    if (status || *verdict != SUNDER_I_SOLVED) sunder_i_solution_clear(solution);
    return status;
}

void sunder_i_solution_clear(sunder_i_solution *solution)
{
    sunder_i_free(solution->body);
    sunder_i_free(solution->move);
    memset(solution, 0, sizeof *solution);
}
