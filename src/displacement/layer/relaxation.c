/* Relaxations: pairs that are left in conflict, and the weaker demand on them in place of the gap, to be no worse than
 * at the start.
 *
 * The search knows one kind of demand, a distance from a convex obstacle, and a relaxation is expressed in it:
 *
 *   disjoint at the start   the pair keeps its distance, which is less than the gap
 *   overlapping             let v be the least translation of b that separates them: b + v must not meet a. Then v, or
 *                           a shorter one, still separates them, so they overlap no deeper than before
 *   one inside the other    where that is allowed: it stays inside
 *
 * At the start every relaxation holds, so leaving everything in place is always feasible. (The second demands more than
 * necessary: another translation of the same length might separate the two. The exact check, uphold.c, demands only
 * what is necessary. A solution found under the exact rule may separate the pair in another direction. Then the pair
 * keeps that direction, and bodies that are sent back to their original positions get new relaxations from these.) */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/model.h"
#include "displacement/layer/resolution.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "base/mix.h"
#include "separation/separation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* With fewer relaxed pairs of bodies than MARKED_FROM no filter is used, as a search in the list is as fast. The filter
 * has BITS_EACH bits for each pair. */
#define MARKED_FROM 16
#define BITS_EACH 16

/* A new separating translation is made shorter than the one that it replaces by this relative amount, far above
 * rounding errors. */
#define HAIR 0x1p-40

void sunder_i_relaxations_free(sunder_i_relaxations *relaxations)
{
    sunder_i_free_all(relaxations->item, relaxations->relaxed, relaxations->mark);
    memset(relaxations, 0, sizeof *relaxations);
}

const sunder_i_relaxation *sunder_i_relaxations_find(const sunder_i_relaxations *relaxations, uint32_t f, uint32_t g)
{
    const sunder_i_relaxation key = {.a = f < g ? f : g, .b = f < g ? g : f};
    return relaxations->n ? bsearch(&key, relaxations->item, relaxations->n, sizeof key, sunder_i_by_id_pair) : NULL;
}

/* ---- A filter: most pairs that are looked up are not in the list ------------------------------------------------- */

/* Returns the word of the filter for bodies i < j, and sets *bit to the bit in it. */
static uint64_t *mark_of(const sunder_i_relaxations *relaxations, uint32_t i, uint32_t j, uint64_t *bit)
{
    const uint64_t mixed = ((uint64_t)i << 32 | j) * SUNDER_I_MIXER;
    *bit = (uint64_t)1 << (mixed >> 58);
    return &relaxations->mark[mixed >> 26 & (relaxations->marks - 1)];
}

static void set_mark(sunder_i_relaxations *relaxations, const sunder_i_relaxed_bodies *relaxed)
{
    uint64_t bit;
    if (relaxations->marks) *mark_of(relaxations, relaxed->i, relaxed->j, &bit) |= bit;
}

/* Builds the filter from the list of relaxed pairs of bodies. Returns false if memory is out. */
static bool mark_all(sunder_i_relaxations *relaxations)
{
    size_t words = 1;
    sunder_i_free(relaxations->mark);
    relaxations->mark = NULL;
    relaxations->marks = 0;
    if (relaxations->relaxed_n < MARKED_FROM) return true;
    while (64 * words < BITS_EACH * relaxations->relaxed_n) words *= 2;
    relaxations->mark = sunder_i_calloc(words, sizeof *relaxations->mark);
    if (!relaxations->mark) return false;
    relaxations->marks = words;
    for (size_t k = 0; k < relaxations->relaxed_n; k++) set_mark(relaxations, &relaxations->relaxed[k]);
    return true;
}

static bool is_marked(const sunder_i_relaxations *relaxations, uint32_t i, uint32_t j)
{
    uint64_t bit;
    return !relaxations->marks || *mark_of(relaxations, i, j, &bit) & bit;
}

/* ---- The list ---------------------------------------------------------------------------------------------------- */

const sunder_i_relaxed_bodies *sunder_i_relaxations_between(const sunder_i_relaxations *relaxations, uint32_t body,
                                                            uint32_t other)
{
    const sunder_i_relaxed_bodies key = {.i = body < other ? body : other, .j = body < other ? other : body};
    return relaxations->relaxed_n && is_marked(relaxations, key.i, key.j)
               ? bsearch(&key, relaxations->relaxed, relaxations->relaxed_n, sizeof key, sunder_i_by_id_pair)
               : NULL;
}

bool sunder_i_relaxations_add(sunder_i_relaxations *relaxations, const sunder_i_relaxation *relaxation)
{
    if (!sunder_i_reserve(&relaxations->item, &relaxations->capacity, relaxations->n + 1, sizeof *relaxations->item))
        return false;
    relaxations->item[relaxations->n++] = *relaxation;
    return true;
}

static sunder_i_relaxed_bodies relaxed_bodies_of(const sunder_i_model *model, const sunder_i_relaxation *t)
{
    const uint32_t i = model->body_of[t->a], j = model->body_of[t->b];
    return (sunder_i_relaxed_bodies){i < j ? i : j, i < j ? j : i, t->inside ? 0 : hypot(t->shift[0], t->shift[1]), 1};
}

/* Adds one relaxation to the entry of its two bodies. */
static void join_relaxed(sunder_i_relaxed_bodies *between, const sunder_i_relaxed_bodies *more)
{
    between->reach = sunder_i_max(between->reach, more->reach);
    between->n++;
}

#ifndef NDEBUG
/* Checks that each pair has its lesser number first, that pairs are sorted, and that each is counted in the entry of
 * its two bodies; these are sorted, too. (A pair may occur twice, with equal values, if it was relaxed once by itself
 * and once with others.) */
static const char *check_relaxations(const sunder_i_relaxations *list, const sunder_i_model *model)
{
    size_t n = 0;
    for (size_t k = 0; k < list->relaxed_n; n += list->relaxed[k++].n)
        if (k && sunder_i_by_id_pair(&list->relaxed[k - 1], &list->relaxed[k]) >= 0)
            return "relaxed bodies are not sorted, or listed twice";
    for (size_t k = 0; k < list->n; k++) {
        const sunder_i_relaxation *r = &list->item[k];
        if (r->a >= r->b || !(r->gap >= 0) || !isfinite(r->shift[0] + r->shift[1])) return "no relaxation of a pair";
        if (k && sunder_i_by_id_pair(r - 1, r) > 0) return "relaxations are not sorted";
        if (!sunder_i_relaxations_between(list, model->body_of[r->a], model->body_of[r->b]))
            return "the bodies of a relaxation are not listed";
    }
    return n == list->n ? NULL : "relaxations are not all counted between their bodies";
}
#endif

bool sunder_i_relaxations_index(sunder_i_relaxations *relaxations, const sunder_i_model *model)
{
    relaxations->relaxed_n = 0;
    if (relaxations->n == 0) return mark_all(relaxations);
    if (!sunder_i_reserve(&relaxations->relaxed, &relaxations->relaxed_capacity, relaxations->n,
                          sizeof *relaxations->relaxed))
        return false;
    qsort(relaxations->item, relaxations->n, sizeof *relaxations->item, sunder_i_by_id_pair);
    for (size_t k = 0; k < relaxations->n; k++)
        relaxations->relaxed[k] = relaxed_bodies_of(model, &relaxations->item[k]);
    qsort(relaxations->relaxed, relaxations->n, sizeof *relaxations->relaxed, sunder_i_by_id_pair);
    for (size_t k = 0; k < relaxations->n; k++) {
        sunder_i_relaxed_bodies *last =
            relaxations->relaxed_n ? &relaxations->relaxed[relaxations->relaxed_n - 1] : NULL;
        if (last && sunder_i_by_id_pair(last, &relaxations->relaxed[k]) == 0)
            join_relaxed(last, &relaxations->relaxed[k]);
        else
            relaxations->relaxed[relaxations->relaxed_n++] = relaxations->relaxed[k];
    }
    if (!mark_all(relaxations)) return false;
    SUNDER_I_CHECK(check_relaxations(relaxations, model), relaxations->n);
    return true;
}

bool sunder_i_relaxations_insert(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                 const sunder_i_relaxation *relaxation)
{
    if (!sunder_i_reserve(&relaxations->item, &relaxations->capacity, relaxations->n + 1, sizeof *relaxations->item) ||
        !sunder_i_reserve(&relaxations->relaxed, &relaxations->relaxed_capacity, relaxations->relaxed_n + 1,
                          sizeof *relaxations->relaxed))
        return false;
    const sunder_i_relaxed_bodies relaxed = relaxed_bodies_of(model, relaxation);
    const size_t at =
        sunder_i_lower_bound(relaxation, relaxations->item, relaxations->n, sizeof *relaxation, sunder_i_by_id_pair);
    memmove(relaxations->item + at + 1, relaxations->item + at, (relaxations->n++ - at) * sizeof *relaxation);
    relaxations->item[at] = *relaxation;
    const size_t of = sunder_i_lower_bound(&relaxed, relaxations->relaxed, relaxations->relaxed_n, sizeof relaxed,
                                           sunder_i_by_id_pair);
    if (of < relaxations->relaxed_n && sunder_i_by_id_pair(&relaxations->relaxed[of], &relaxed) == 0) {
        join_relaxed(&relaxations->relaxed[of], &relaxed);
        return true;
    }
    memmove(relaxations->relaxed + of + 1, relaxations->relaxed + of, (relaxations->relaxed_n++ - of) * sizeof relaxed);
    relaxations->relaxed[of] = relaxed;
    set_mark(relaxations, &relaxed);
    SUNDER_I_CHECK(check_relaxations(relaxations, model), relaxations->n);
    return true;
}

void sunder_i_relaxations_remove(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                 const sunder_i_relaxation *relaxation)
{
    const sunder_i_relaxed_bodies relaxed = relaxed_bodies_of(model, relaxation);
    const size_t at =
        sunder_i_lower_bound(relaxation, relaxations->item, relaxations->n, sizeof *relaxation, sunder_i_by_id_pair);
    const size_t of = sunder_i_lower_bound(&relaxed, relaxations->relaxed, relaxations->relaxed_n, sizeof relaxed,
                                           sunder_i_by_id_pair);
    memmove(relaxations->item + at, relaxations->item + at + 1, (--relaxations->n - at) * sizeof *relaxation);
    /* The shifts that remain may be shorter than `reach`, which is an upper bound. */
    if (--relaxations->relaxed[of].n == 0)
        memmove(relaxations->relaxed + of, relaxations->relaxed + of + 1,
                (--relaxations->relaxed_n - of) * sizeof relaxed);
    SUNDER_I_CHECK(check_relaxations(relaxations, model), relaxations->n);
}

/* ---- Restored pairs: their relaxation has ended ------------------------------------------------------------------ */

int sunder_i_by_restored(const void *a, const void *b)
{
    const sunder_i_restored *p = a, *q = b;
    const int order = sunder_i_by_id_pair(&p->body, &q->body);
    return order ? order : sunder_i_by_id_pair(&p->feature, &q->feature);
}

sunder_i_restored sunder_i_restored_of(const sunder_i_model *model, const sunder_i_relaxation *relaxation)
{
    const sunder_i_relaxed_bodies relaxed = relaxed_bodies_of(model, relaxation);
    return (sunder_i_restored){{relaxed.i, relaxed.j}, {relaxation->a, relaxation->b}};
}

size_t sunder_i_restored_at(const sunder_i_restored *list, size_t n, const sunder_i_restored *wanted)
{
    return sunder_i_lower_bound(wanted, list, n, sizeof *list, sunder_i_by_restored);
}

void sunder_i_relaxations_restore(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                  const sunder_i_restored *restored, size_t n)
{
    size_t out = 0;
    for (size_t k = 0; k < relaxations->n; k++) {
        const sunder_i_restored key = sunder_i_restored_of(model, &relaxations->item[k]);
        if (!bsearch(&key, restored, n, sizeof key, sunder_i_by_restored))
            relaxations->item[out++] = relaxations->item[k];
    }
    relaxations->n = out;
}

bool sunder_i_is_conflict_of_bodies(const sunder_i_model *model, const sunder_i_relation *r)
{
    return sunder_i_is_conflict(r) && model->body_of[r->a] != model->body_of[r->b];
}

bool sunder_i_is_open_conflict(const sunder_i_model *model, const sunder_i_relation *r)
{
    return sunder_i_is_conflict_of_bodies(model, r) && !sunder_i_relaxations_find(&model->relaxations, r->a, r->b);
}

/* ---- The demand -------------------------------------------------------------------------------------------------- */

/* Makes the relaxation of a feature and a part of a barrier. It is about the whole barrier, since the rule that nothing
 * gets worse is. */
static sunder_status relaxation_of_barrier(const sunder_i_model *model, sunder_i_relaxation *out, sunder_error *err)
{
    const sunder_i_translate home = sunder_i_at_home(model, out->a);
    sunder_i_barrier_stance stance;
    const sunder_status status = sunder_i_barrier_stand(model, &home, out->b, &stance, err);
    if (status) return status;
    out->gap = stance.overlap ? 0 : stance.distance;
    if (!stance.overlap) return SUNDER_OK;
    out->shift[0] = -stance.least.dx;
    out->shift[1] = -stance.least.dy;
    return SUNDER_OK;
}

sunder_status sunder_i_relaxation_of(const sunder_i_model *model, uint32_t f, uint32_t g, sunder_i_relaxation *out,
                                     sunder_error *err)
{
    const double none[2] = {0, 0};
    *out = (sunder_i_relaxation){.a = f < g ? f : g, .b = f < g ? g : f};
    if (sunder_i_is_barrier(model, out->b)) return relaxation_of_barrier(model, out, err);
    const sunder_shape *a = sunder_i_thing_shape(model, out->a), *b = sunder_i_thing_shape(model, out->b);
    const sunder_i_inclusion *inclusion = sunder_i_inclusion_find(model, f, g);
    out->inside = inclusion && !inclusion->enters;
    if (out->inside) return SUNDER_OK;
    out->inside = sunder_i_is_inner(model, f, g) || sunder_i_is_inner(model, g, f);
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

/* Sets `shift` to the least translation of t->b that separates it from t->a, where the two are moved by tb and ta (a
 * barrier stays in place), if it is no longer than `upper`; otherwise sets *beyond. */
static sunder_status find_separating_shift(const sunder_i_model *model, const sunder_i_relaxation *t,
                                           const double ta[2], const double tb[2], double upper, double shift[2],
                                           bool *beyond, sunder_error *err)
{
    const bool barrier = sunder_i_is_barrier(model, t->b);
    sunder_i_translate moved = sunder_i_at_home(model, t->a);
    sunder_separation least;
    memcpy(moved.t, ta, sizeof moved.t);
    const sunder_status status =
        barrier ? sunder_i_barrier_least(model, &moved, t->b, 0, upper, &least, beyond, err)
                : sunder_i_separate(sunder_i_thing_shape(model, t->a), ta, sunder_i_thing_shape(model, t->b), tb, 0,
                                    upper, &least, beyond, err);
    if (status) return status;
    shift[0] = barrier ? -least.dx : least.dx;
    shift[1] = barrier ? -least.dy : least.dy;
    sunder_separation_clear(&least);
    return SUNDER_OK;
}

/* The new shift gets the length of the old one less a tiny share, since the pair may be as deep as before. */
sunder_status sunder_i_relaxation_turn(const sunder_i_model *model, const double ta[2], const double tb[2],
                                       sunder_i_relaxation *relaxation, bool *fits, sunder_error *err)
{
    const double depth = hypot(relaxation->shift[0], relaxation->shift[1]);
    double shift[2] = {0, 0};
    bool beyond;
    const sunder_status status = find_separating_shift(model, relaxation, ta, tb, depth, shift, &beyond, err);
    const double length = hypot(shift[0], shift[1]), share = length > 0 ? (1 - HAIR) * depth / length : 1;
    *fits = !status && !beyond && share >= 1;
    for (int c = 0; c < 2 && *fits; c++) relaxation->shift[c] = share * shift[c];
    return status;
}

bool sunder_i_relaxations_spread(sunder_i_relaxations *relaxations, const sunder_i_model *model,
                                 const sunder_i_relaxation *relaxation, double reach)
{
    sunder_i_relaxation of_part = *relaxation;
    if (!sunder_i_is_barrier(model, of_part.b)) return sunder_i_relaxations_add(relaxations, &of_part);
    const uint32_t whole = sunder_i_whole_of(model, of_part.b),
                   end = (uint32_t)model->features + model->barriers->part_end[sunder_i_barrier_of(model, of_part.b)];
    const double limit = sunder_i_limit_of(&model->body[model->body_of[of_part.a]]);
    double box[4];
    sunder_i_list near = {0};
    sunder_i_box_grow(sunder_i_home_box(model, of_part.a), isfinite(limit) ? reach + limit : reach, box);
    bool ok = sunder_i_rtree_query(&model->tree, box, &near);
    for (size_t k = 0; k < near.n && ok; k++) {
        if (near.item[k] < whole || near.item[k] >= end) continue;
        of_part.b = near.item[k];
        ok = sunder_i_relaxations_add(relaxations, &of_part);
    }
    sunder_i_free(near.item);
    return ok;
}

bool sunder_i_relaxations_make(const sunder_i_model *model, uint32_t body, uint32_t other, double reach,
                               sunder_i_relaxations *out)
{
    const sunder_i_body *p = &model->body[body], *q = &model->body[other];
    bool ok = true;
    for (uint32_t k = 0; k < p->members && ok; k++) {
        const uint32_t f = model->member[p->member + k];
        double box[4];
        if (!model->present[f]) continue;
        sunder_i_box_grow(sunder_i_home_box(model, f), reach, box);
        for (uint32_t l = 0; l < q->members && ok; l++) {
            const uint32_t g = model->member[q->member + l];
            sunder_i_relaxation relaxation;
            if (!model->present[g] || !sunder_i_box_meet(box, sunder_i_home_box(model, g))) continue;
            if (sunder_i_is_included(model, f, g)) continue;
            ok = !sunder_i_relaxation_of(model, f, g, &relaxation, NULL);
            if (ok && relaxation.gap < reach + (sunder_i_owed_above(model, f, g) - model->rules.gap))
                ok = sunder_i_relaxations_spread(out, model, &relaxation, reach);
        }
    }
    return ok;
}

double sunder_i_relaxation_shift(const sunder_i_relaxation *relaxation, uint32_t of_j, double shift[2])
{
    const double sign = of_j == relaxation->b ? 1 : -1;
    shift[0] = sign * relaxation->shift[0];
    shift[1] = sign * relaxation->shift[1];
    return relaxation->gap;
}
