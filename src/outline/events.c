/* events.c: see events.h. Events are sorted by the doubles of their fractions, and exactly within each sequence of them
 * whose order doubles leave open: so exact comparisons are made of neighbours only, and those of two events at one
 * position once or twice. */
#include "outline/events.h"

#include "base/sort.h"
#include "predicate/narrow.h"

#include <math.h>
#include <string.h>

#define FEW 8 /* up to this number of events at one position need no memory */

typedef struct context {
    const sunder_i_events *events;
    sunder_i_lattice *lattice;
} context;

static int compare_events(void *user, uint32_t a, uint32_t b)
{
    const context *c = user;
    return sunder_i_fraction_cmp(c->lattice, &c->events->event[a].at, &c->events->event[b].at);
}

/* Sorts n keys whose order doubles leave open, and marks the first one at each position. Returns false if out of
 * memory. */
static bool settle_order(context *c, sunder_i_valued *k, size_t n)
{
    if (n == 2) {
        const int order = compare_events(c, k[0].item, k[1].item);
        if (order > 0) {
            const sunder_i_valued swap = k[0];
            k[0] = k[1];
            k[1] = swap;
        }
        k[0].mark = true;
        k[1].mark = order != 0;
        return true;
    }
    uint32_t few[FEW], *index = n <= FEW ? few : sunder_i_alloc(n, sizeof *index);
    if (!index) return false;
    for (size_t i = 0; i < n; i++) index[i] = k[i].item;
    const bool ok = sunder_i_sort_indices(index, n, compare_events, c);
    for (size_t i = 0; ok && i < n; i++)
        k[i] = (sunder_i_valued){c->events->event[index[i]].at.value, index[i],
                                 i == 0 || compare_events(c, index[i - 1], index[i]) != 0};
    if (index != few) sunder_i_free(index);
    return ok;
}

/* Returns whether b, which is not less than a as a double, may be less or equal exactly. If not, no key after b is less
 * than one before a: their distance exceeds the possible errors. Ratios may exceed the range of doubles: infinite ones
 * are open, too. */
static bool is_open(double a, double b) { return !(b - a > SUNDER_I_FRACTION_ERROR * (1 + fabs(a) + fabs(b))); }

bool sunder_i_events_sort(sunder_i_events *events, sunder_i_lattice *lattice)
{
    const size_t n = events->n;
    if (!sunder_i_reserve(&events->order, &events->order_capacity, 2 * n, sizeof *events->order)) return false;
    sunder_i_valued *k = events->order;
    for (size_t i = 0; i < n; i++) k[i] = (sunder_i_valued){events->event[i].at.value, (uint32_t)i, true};
    if (!sunder_i_sort_valued(k, n)) return false;
    context c = {events, lattice};
    for (size_t i = 0, j; i < n; i = j) {
        for (j = i + 1; j < n && is_open(k[j - 1].value, k[j].value);) j++;
        if (j - i > 1 && !settle_order(&c, k + i, j - i)) return false;
    }
    lattice->counts.comparisons += n;
    return true;
}

void sunder_i_events_free(sunder_i_events *events)
{
    sunder_i_free_all(events->event, events->order);
    memset(events, 0, sizeof *events);
}
