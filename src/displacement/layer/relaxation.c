/* Pairs that are left in conflict, and what is demanded of them instead of peace: to stand no worse than they stood.
 *
 * The search knows one kind of demand, to keep a distance from a convex obstacle, and a truce is made of the same:
 *
 *   disjoint at the start   the pair keeps the distance that it had, which is less than the gap
 *   in each other           with v the least translation of b that parted them: b + v stays off a. Then v, or less,
 *                           still parts them, so they are no deeper in each other than they were.
 *   one inside the other    where that is peace: it stays inside
 *
 * At the start every truce holds, so to leave everything where it was is always a way. (The second demands more than
 * need be: another translation of the same length might part them. The exact check, uphold.c, demands just what is
 * needed.) */
#include "displacement/layer/inclusion.h"

#include "separation/separation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void sunder_i_truces_free(sunder_i_truces *truces)
{
    sunder_i_free(truces->item);
    sunder_i_free(truces->torn);
    memset(truces, 0, sizeof *truces);
}

static int by_features(const void *x, const void *y)
{
    const sunder_i_truce *p = x, *q = y;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

static int by_bodies(const void *x, const void *y)
{
    const sunder_i_torn *p = x, *q = y;
    if (p->i != q->i) return p->i < q->i ? -1 : 1;
    return p->j < q->j ? -1 : p->j > q->j;
}

const sunder_i_truce *sunder_i_truces_find(const sunder_i_truces *truces, uint32_t f, uint32_t g)
{
    const sunder_i_truce key = {.a = f < g ? f : g, .b = f < g ? g : f};
    return truces->n ? bsearch(&key, truces->item, truces->n, sizeof key, by_features) : NULL;
}

const sunder_i_torn *sunder_i_truces_between(const sunder_i_truces *truces, uint32_t body, uint32_t other)
{
    const sunder_i_torn key = {.i = body < other ? body : other, .j = body < other ? other : body};
    return truces->torn_n ? bsearch(&key, truces->torn, truces->torn_n, sizeof key, by_bodies) : NULL;
}

bool sunder_i_truces_add(sunder_i_truces *truces, const sunder_i_truce *truce)
{
    if (!sunder_i_reserve(&truces->item, &truces->capacity, truces->n + 1, sizeof *truces->item)) return false;
    truces->item[truces->n++] = *truce;
    return true;
}

static sunder_i_torn torn_of(const sunder_i_town *town, const sunder_i_truce *t)
{
    const uint32_t i = town->body_of[t->a], j = town->body_of[t->b];
    return (sunder_i_torn){i < j ? i : j, i < j ? j : i, t->inside ? 0 : hypot(t->shift[0], t->shift[1]), 1};
}

/* One more between its bodies. */
static void join_torn(sunder_i_torn *between, const sunder_i_torn *more)
{
    between->reach = fmax(between->reach, more->reach);
    between->n++;
}

bool sunder_i_truces_index(sunder_i_truces *truces, const sunder_i_town *town)
{
    truces->torn_n = 0;
    if (truces->n == 0) return true;
    if (!sunder_i_reserve(&truces->torn, &truces->torn_capacity, truces->n, sizeof *truces->torn)) return false;
    qsort(truces->item, truces->n, sizeof *truces->item, by_features);
    for (size_t k = 0; k < truces->n; k++) truces->torn[k] = torn_of(town, &truces->item[k]);
    qsort(truces->torn, truces->n, sizeof *truces->torn, by_bodies);
    for (size_t k = 0; k < truces->n; k++) {
        sunder_i_torn *last = truces->torn_n ? &truces->torn[truces->torn_n - 1] : NULL;
        if (last && by_bodies(last, &truces->torn[k]) == 0)
            join_torn(last, &truces->torn[k]);
        else
            truces->torn[truces->torn_n++] = truces->torn[k];
    }
    return true;
}

/* Where the n items of one size have, or would have, the key. */
static size_t place_of(const void *key, const void *item, size_t n, size_t size,
                       int (*order)(const void *, const void *))
{
    size_t low = 0, high = n;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (order((const char *)item + middle * size, key) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

bool sunder_i_truces_insert(sunder_i_truces *truces, const sunder_i_town *town, const sunder_i_truce *truce)
{
    if (!sunder_i_reserve(&truces->item, &truces->capacity, truces->n + 1, sizeof *truces->item) ||
        !sunder_i_reserve(&truces->torn, &truces->torn_capacity, truces->torn_n + 1, sizeof *truces->torn))
        return false;
    const sunder_i_torn torn = torn_of(town, truce);
    const size_t at = place_of(truce, truces->item, truces->n, sizeof *truce, by_features);
    memmove(truces->item + at + 1, truces->item + at, (truces->n++ - at) * sizeof *truce);
    truces->item[at] = *truce;
    const size_t of = place_of(&torn, truces->torn, truces->torn_n, sizeof torn, by_bodies);
    if (of < truces->torn_n && by_bodies(&truces->torn[of], &torn) == 0) {
        join_torn(&truces->torn[of], &torn);
        return true;
    }
    memmove(truces->torn + of + 1, truces->torn + of, (truces->torn_n++ - of) * sizeof torn);
    truces->torn[of] = torn;
    return true;
}

void sunder_i_truces_remove(sunder_i_truces *truces, const sunder_i_town *town, const sunder_i_truce *truce)
{
    const sunder_i_torn torn = torn_of(town, truce);
    const size_t at = place_of(truce, truces->item, truces->n, sizeof *truce, by_features);
    const size_t of = place_of(&torn, truces->torn, truces->torn_n, sizeof torn, by_bodies);
    memmove(truces->item + at, truces->item + at + 1, (--truces->n - at) * sizeof *truce);
    /* What remains between the bodies may reach less far than is said then. */
    if (--truces->torn[of].n == 0)
        memmove(truces->torn + of, truces->torn + of + 1, (--truces->torn_n - of) * sizeof torn);
}

/* ---- Those that were ended --------------------------------------------------------------------------------------- */

int sunder_i_by_ended(const void *x, const void *y)
{
    const sunder_i_ended *p = x, *q = y;
    const int order = sunder_i_by_couple(&p->body, &q->body);
    return order ? order : sunder_i_by_couple(&p->feature, &q->feature);
}

sunder_i_ended sunder_i_ended_of(const sunder_i_town *town, const sunder_i_truce *truce)
{
    const sunder_i_torn torn = torn_of(town, truce);
    return (sunder_i_ended){{torn.i, torn.j}, {truce->a, truce->b}};
}

size_t sunder_i_ended_at(const sunder_i_ended *list, size_t n, const sunder_i_ended *wanted)
{
    return place_of(wanted, list, n, sizeof *list, sunder_i_by_ended);
}

void sunder_i_truces_end(sunder_i_truces *truces, const sunder_i_town *town, const sunder_i_ended *ended, size_t n)
{
    size_t out = 0;
    for (size_t k = 0; k < truces->n; k++) {
        const sunder_i_ended key = sunder_i_ended_of(town, &truces->item[k]);
        if (!bsearch(&key, ended, n, sizeof key, sunder_i_by_ended)) truces->item[out++] = truces->item[k];
    }
    truces->n = out;
}

/* ---- What is demanded -------------------------------------------------------------------------------------------- */

sunder_status sunder_i_truce_of(const sunder_i_town *town, uint32_t f, uint32_t g, sunder_i_truce *out,
                                sunder_error *err)
{
    const double none[2] = {0, 0};
    *out = (sunder_i_truce){.a = f < g ? f : g, .b = f < g ? g : f};
    const sunder_shape *a = town->layer->feature[out->a].shape, *b = town->layer->feature[out->b].shape;
    const size_t kept = sunder_i_kept_at(town, f, g);
    out->inside = kept < town->kept_n && !town->enters[kept];
    if (out->inside) return SUNDER_OK;
    out->inside = sunder_i_is_inner(town, f, g) || sunder_i_is_inner(town, g, f);
    bool overlap;
    sunder_status status = sunder_i_overlap(a, none, b, none, &overlap, err);
    if (status) return status;
    if (!overlap) {
        double on_a[2], on_b[2];
        return sunder_pair_distance(a, b, &out->gap, on_a, on_b, err);
    }
    sunder_separation least;
    bool beyond;
    status = sunder_i_separate(a, none, b, none, 0, INFINITY, &least, &beyond, err);
    if (status) return status;
    out->shift[0] = least.dx;
    out->shift[1] = least.dy;
    sunder_separation_clear(&least);
    return SUNDER_OK;
}

sunder_status sunder_i_truces_make(const sunder_i_town *town, uint32_t i, uint32_t j, double reach,
                                   sunder_i_truces *out, sunder_error *err)
{
    const sunder_i_body *p = &town->body[i], *q = &town->body[j];
    sunder_status status = SUNDER_OK;
    for (uint32_t k = 0; k < p->members && !status; k++) {
        const uint32_t f = town->member[p->member + k];
        double box[4];
        if (!town->present[f]) continue;
        sunder_i_box_grow(town->box + 4 * (size_t)f, reach, box);
        for (uint32_t l = 0; l < q->members && !status; l++) {
            const uint32_t g = town->member[q->member + l];
            sunder_i_truce truce;
            if (!town->present[g] || !sunder_i_box_meet(box, town->box + 4 * (size_t)g)) continue;
            if (sunder_i_is_kept(town, f, g)) continue;
            status = sunder_i_truce_of(town, f, g, &truce, err);
            if (!status && truce.gap < reach && !sunder_i_truces_add(out, &truce)) status = sunder_i_no_memory(err);
        }
    }
    return status;
}

double sunder_i_truce_shift(const sunder_i_truce *truce, uint32_t of_j, double shift[2])
{
    const double sign = of_j == truce->b ? 1 : -1;
    shift[0] = sign * truce->shift[0];
    shift[1] = sign * truce->shift[1];
    return truce->gap;
}
