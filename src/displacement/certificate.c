/* The convex program of one node of an inquiry, and the proof that it has no solution.
 *
 * Its constraints are gathered as candidates miss them, and those that act serve the next node too: in any direction n,
 * a pair's u has n.u no less than its region has. The proof holds for whatever forces the program ends with; see
 * certify.c. */
#include "displacement/inquiry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The key of a constraint that is a tangent of a limit; any other's is its pair. */
#define TANGENT UINT64_MAX

static double least_of(const sunder_i_region *region, const double n[2])
{
    double least = INFINITY;
    for (size_t k = 0; k < region->n; k++) least = fmin(least, n[0] * region->xy[2 * k] + n[1] * region->xy[2 * k + 1]);
    return least;
}

/* Drops what does not act, and asks of the rest what the regions ask now. */
static void refresh(sunder_i_inquiry *c)
{
    sunder_i_quadratic *p = &c->program;
    size_t out = 0;
    for (size_t k = 0; k < p->n; k++) {
        sunder_i_constraint *e = &p->constraint[k];
        if (!(e->force > 0)) continue;
        if (e->key != TANGENT) e->d = least_of(&c->pair[e->key].region, e->n) + SUNDER_I_INQUIRY_TOLERANCE * c->longest;
        p->constraint[out++] = *e;
    }
    p->n = out;
}

/* Adds n.(t_j - t_i) >= d unless it is there. */
static bool add(sunder_i_inquiry *c, uint32_t i, uint32_t j, uint64_t key, const double n[2], double d, size_t *added)
{
    sunder_i_quadratic *p = &c->program;
    for (size_t k = 0; k < p->n; k++) {
        const sunder_i_constraint *e = &p->constraint[k];
        if (e->key == key && e->j == j && n[0] * e->n[0] + n[1] * e->n[1] > 1 - 1e-12) return true;
    }
    if (!sunder_i_reserve(&p->constraint, &p->capacity, p->n + 1, sizeof *p->constraint)) return false;
    p->constraint[p->n++] = (sunder_i_constraint){.i = i, .j = j, .n = {n[0], n[1]}, .d = d, .key = key};
    ++*added;
    return true;
}

/* Adds what the program's solution misses: of each pair the edge of its region that it misses most, and the tangents of
 * limits that it oversteps. Returns how many. */
static size_t add_missed(sunder_i_inquiry *c, bool *ok)
{
    const double *t = c->program.t, margin = SUNDER_I_INQUIRY_TOLERANCE * c->longest;
    size_t added = 0;
    for (size_t k = 0; k < c->pairs && *ok; k++) {
        const sunder_i_duo *d = &c->pair[k];
        const double u[2] = {t[2 * d->j] - t[2 * d->i], t[2 * d->j + 1] - t[2 * d->i + 1]};
        double worst = 0, n[2] = {0, 0};
        for (size_t e = 0; e < d->region.n; e++) {
            const double *a = d->region.xy + 2 * e, *b = d->region.xy + 2 * (e + 1 < d->region.n ? e + 1 : 0);
            const double x = b[0] - a[0], y = b[1] - a[1], length = hypot(x, y);
            if (!(length > 1e-9 * d->obstruction.r)) continue;
            const double missed = (y * (u[0] - a[0]) - x * (u[1] - a[1])) / length;
            if (missed <= worst) continue;
            worst = missed;
            n[0] = -y / length;
            n[1] = x / length;
        }
        if (worst > 0) *ok = add(c, d->i, d->j, k, n, least_of(&d->region, n) + margin, &added);
    }
    for (uint32_t b = 0; b < c->bodies && *ok; b++) {
        const double length = hypot(t[2 * b], t[2 * b + 1]);
        if (!(c->limit[b] > 0) || length <= c->limit[b] + margin) continue;
        const double n[2] = {-t[2 * b] / length, -t[2 * b + 1] / length};
        *ok = add(c, SUNDER_I_NOBODY, b, TANGENT, n, -c->limit[b], &added);
    }
    return added;
}

/* Do the forces prove that there is no solution? */
static bool is_proved(const sunder_i_inquiry *c)
{
    const sunder_i_quadratic *p = &c->program;
    double won = 0, lost = 0, all = 0;
    memset(c->net, 0, 2 * c->bodies * sizeof *c->net);
    for (size_t k = 0; k < p->n; k++) {
        const sunder_i_constraint *e = &p->constraint[k];
        if (e->key == TANGENT) continue;
        const double h = e->d - SUNDER_I_INQUIRY_TOLERANCE * c->longest;
        won += e->force * h;
        all += e->force * fabs(h);
        for (size_t x = 0; x < 2; x++) {
            c->net[2 * e->j + x] += e->force * e->n[x];
            c->net[2 * e->i + x] -= e->force * e->n[x];
        }
    }
    for (size_t b = 0; b < c->bodies; b++)
        if (c->limit[b] > 0) lost += c->limit[b] * hypot(c->net[2 * b], c->net[2 * b + 1]);
    return won > lost + 1e-9 * (all + lost);
}

sunder_status sunder_i_inquiry_solve(sunder_i_inquiry *c, uint64_t most_work, bool *shown, sunder_error *err)
{
    bool ok = true;
    refresh(c);
    do {
        *shown = false;
        if (c->program.work > most_work) return SUNDER_OK;
        /* Hard enough that the masses hardly count. */
        if (sunder_i_quadratic_solve(&c->program, 1e-6, 1e-6 * c->longest, c->longest) < 0)
            return sunder_i_no_memory(err);
        if (sunder_i_is_stopped(&c->town->rules)) return sunder_i_broken_off(&c->town->rules, err);
        *shown = is_proved(c);
    } while (!*shown && add_missed(c, &ok));
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}
