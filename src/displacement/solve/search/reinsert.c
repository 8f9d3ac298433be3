/* Other orders of putting bodies back.
 *
 * The sides of a solution mostly depend on the order in which bodies were placed. So a few bodies around one with
 * uncertain sides are taken out and put back one by one, each at the free place nearest to its origin, in another
 * order. All bodies descend from there, and a cheaper result is kept. Sides are uncertain for bodies that overlapped
 * another deeply, for which another side is hardly farther, and for bodies that moved much farther than any pair was in
 * conflict. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A body with a key for sorting. */
typedef struct ranked {
    double by;
    uint32_t index;
} ranked;

static int by_rank(const void *a, const void *b)
{
    const ranked *p = a, *q = b;
    if (p->by != q->by) return p->by < q->by ? -1 : 1;
    return p->index < q->index ? -1 : p->index > q->index;
}

typedef struct reordering {
    sunder_i_search *search;
    ranked *doubtful, *near; /* [doubtfuls] bodies with uncertain sides, the most expensive first; [moving] scratch */
    size_t doubtfuls, moving;
    uint32_t *out;             /* [moving] bodies that are taken out, in the order in which they are put back */
    double tried[MOST_ORDERS]; /* costs of earlier starts: an equal cost means the same start, and the same result */
    size_t tries;
    double *best, cost;
} reordering;

/* ---- Whose sides are in doubt ------------------------------------------------------------------------------------ */

static double body_extent(const sunder_i_search *s, uint32_t i)
{
    const double *box = s->model->body[s->body[i]].box;
    return sunder_i_min(box[2] - box[0], box[3] - box[1]);
}

static bool find_doubtful(reordering *r)
{
    sunder_i_search *s = r->search;
    double *home = sunder_i_alloc(2 * s->n, sizeof *home), worst = 0;
    bool *deep = sunder_i_calloc(s->n, sizeof *deep);
    if (home && deep) {
        for (size_t k = 0; k < 2 * s->n; k++) home[k] = s->mass[k / 2] > 0 ? 0 : s->t[k];
        sunder_i_search_find_clashes(s, home);
        for (size_t k = 0; k < s->clashes; k++) {
            const sunder_i_clash *c = &s->clash[k];
            worst = sunder_i_max(worst, c->violation);
            if (c->violation - s->gap > DEEP * sunder_i_min(body_extent(s, c->i), body_extent(s, c->j)))
                deep[c->i] = deep[c->j] = true;
        }
        for (uint32_t k = 0; k < s->n; k++) {
            if (s->mass[k] > 0 && (deep[k] || sunder_i_search_stray(s, k) > LONG * worst))
                r->doubtful[r->doubtfuls++] = (ranked){-sunder_i_search_stray_square(s, k, s->t) / s->mass[k], k};
        }
        if (r->doubtfuls) qsort(r->doubtful, r->doubtfuls, sizeof *r->doubtful, by_rank);
    }
    const bool ok = home && deep;
    sunder_i_free_all(home, deep);
    return ok;
}

/* ---- Out, and in again ------------------------------------------------------------------------------------------- */

/* The distance of the boxes of two bodies, at their original places (share 0) or at their present ones (1). */
static double boxes_apart(const sunder_i_search *s, uint32_t i, uint32_t j, double share)
{
    const sunder_i_body *p = &s->model->body[s->body[i]], *q = &s->model->body[s->body[j]];
    double d[2];
    for (uint32_t c = 0; c < 2; c++) {
        const double offset = q->origin[c] - p->origin[c] + share * (s->t[2 * j + c] - s->t[2 * i + c]);
        d[c] = sunder_i_max(0, sunder_i_max(q->box[c] + offset - p->box[c + 2], p->box[c] - q->box[c + 2] - offset));
    }
    return hypot(d[0], d[1]);
}

/* Stores in r->out the body `first` and the n - 1 movable bodies that are nearest to it now or were at the start. */
static void choose_bodies(reordering *r, uint32_t first, size_t n)
{
    const sunder_i_search *s = r->search;
    size_t m = 0;
    for (uint32_t k = 0; k < s->n; k++)
        if (s->mass[k] > 0)
            r->near[m++] =
                (ranked){k == first ? -1 : sunder_i_min(boxes_apart(s, first, k, 0), boxes_apart(s, first, k, 1)), k};
    qsort(r->near, m, sizeof *r->near, by_rank);
    for (size_t k = 0; k < n; k++) r->out[k] = r->near[k].index;
}

/* Shuffles n numbers by a fixed pseudo-random sequence (xorshift). */
static void shuffle_bodies(uint32_t *order, size_t n, uint64_t *state)
{
    for (size_t k = n; k-- > 1;) {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        sunder_i_shuffle_step(order, k + 1, sizeof *order, *state);
    }
}

static bool is_known(const reordering *r, double cost)
{
    for (size_t k = 0; k < r->tries; k++)
        if (fabs(r->tried[k] - cost) <= SAME_COST * cost) return true;
    return false;
}

/* Is a descent from s->t, which costs `start`, useless? A start that was tried before ends in the same layout; others
 * are noted as tried. A start that clashes, yet costs less than the present layout, is more expensive once nothing
 * clashes: of 630 such starts in a town of 100,000 three led to a gain, and a tiny one. With proofs these starts are
 * tried, too. */
static bool is_in_vain(reordering *r, double start)
{
    sunder_i_search *s = r->search;
    if (is_known(r, start)) return true;
    r->tried[r->tries++] = start;
    return !(s->model->rules.effort > 0) && start < r->cost && sunder_i_search_find_clashes(s, s->t) > s->tolerance;
}

/* Takes out the n bodies of r->out, puts them back in this order, and descends. A body without a free place returns to
 * its origin, and all make room for it. Returns 0 if the result is cheaper, which is kept; otherwise the number of
 * useless orders that this try counts for. */
static size_t put_back(reordering *r, size_t n)
{
    sunder_i_search *s = r->search;
    for (size_t k = 0; k < n; k++) {
        s->away[r->out[k]] = true;
        memcpy(s->t + 2 * r->out[k], s->preferred + 2 * r->out[k], 2 * sizeof *s->t);
    }
    for (size_t k = 0; k < n; k++) {
        const uint32_t i = r->out[k];
        const double farthest =
            sunder_i_min(BEYOND_LIMIT * sunder_i_search_limit(s, i), BEYOND_COST * sqrt(2 * s->mass[i] * r->cost));
        double place[2];
        if (sunder_i_search_free_body(s, i, farthest, place)) memcpy(s->t + 2 * i, place, sizeof place);
        s->away[i] = false;
    }
    const double start = sunder_i_search_cost(s, s->t), before = r->cost;
    const bool in_vain = is_in_vain(r, start);
    s->program.n = 0; /* its forces belong to the former places */
    if (!in_vain) sunder_i_search_attempt(s, r->best, &r->cost);
    memcpy(s->t, r->best, 2 * s->n * sizeof *r->best);
    return in_vain ? ORDER_IN_VAIN : !(r->cost < before);
}

/* Estimates the number of pairs of pieces to examine in the search of a place for each movable body. */
static uint64_t search_work(const sunder_i_search *s)
{
    uint64_t own = 0, all = 0;
    for (size_t k = 0; k < s->n; k++) {
        const uint64_t pieces = s->model->body[s->body[k]].pieces;
        all += pieces;
        if (s->mass[k] > 0) own += pieces;
    }
    return 4 * own * all;
}

/* Tries a number of orders, around one uncertain body after the other. n: how many bodies are taken out; 0: from 2 to
 * MOST_OUT. */
static void try_orders(reordering *r, size_t n, size_t most_useless, uint64_t most_work)
{
    sunder_i_search *s = r->search;
    uint64_t state = UINT64_C(0x9e3779b97f4a7c15), last = search_work(s);
    size_t useless = 0;
    for (size_t k = 0; k < MOST_ORDERS && useless < most_useless && !s->failed; k++) {
        const uint64_t before = sunder_i_search_work(s);
        const size_t out = n ? n : 2 + k / r->doubtfuls % (MOST_OUT - 1);
        if (before + last >= most_work) break;
        const size_t taken = out < r->moving ? out : r->moving;
        choose_bodies(r, r->doubtful[k % r->doubtfuls].index, taken);
        shuffle_bodies(r->out, taken, &state);
        const size_t in_vain = put_back(r, taken);
        useless = in_vain ? useless + in_vain : 0;
        last = sunder_i_search_work(s) - before;
    }
}

void sunder_i_search_reorder(sunder_i_search *search, double *best, double *cost)
{
    reordering r = {.search = search, .best = best, .cost = *cost, .moving = sunder_i_search_movers(search)};
    const uint64_t work = sunder_i_search_work(search);
    if (r.moving < 3 || r.moving > MOST_MOVING) return; /* all sides of two bodies were tried before */
    r.doubtful = sunder_i_alloc(r.moving, sizeof *r.doubtful);
    r.near = sunder_i_alloc(r.moving, sizeof *r.near);
    r.out = sunder_i_alloc(r.moving, sizeof *r.out);
    if (!r.doubtful || !r.near || !r.out || !find_doubtful(&r)) search->failed = true;
    if (r.doubtfuls) {
        try_orders(&r, 0, MOST_USELESS, (1 + MOST_TIMES) * work);
    } else if (!search->failed && r.moving <= SURE_MOVING) {
        for (uint32_t k = 0; k < search->n; k++)
            if (search->mass[k] > 0) r.doubtful[r.doubtfuls++] = (ranked){0, k};
        try_orders(&r, r.moving, SURE_USELESS, work + work / SURE_SHARE);
    }
    *cost = r.cost;
    sunder_i_free_all(r.doubtful, r.near, r.out);
}
