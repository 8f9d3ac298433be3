/* Better layouts of a contact group by iterated local search [LMS03].
 *
 * A descent ends where nothing can be bettered in small: which body passes which on what side was settled early, when
 * most of them still stood in each other's way. In a dense group that may cost a third more than need be. So, again and
 * again: one body and those nearest to it are let go, back towards where they came from and a little beside it, and
 * from there all go down again; what is cheaper stays. A descent that is not going to be cheaper is given up on the way
 * (search/descend.c), and so is one that takes long. Whoever is let go is drawn at random, from the user's seed and in
 * the order of the group's list, so that a group's result does not depend on others.
 *
 * That only those let go and their neighbours go down, while all others stand, was tried: eight times as many descents
 * found less, since in a dense group what one gains by another side all have to make room for.
 *
 * It proves nothing; a tree that starts from a cheaper layout proves more of it (tree.c). */
#include "displacement/optimum/optimum.h"
#include "displacement/optimum/tuning.h"
#include "displacement/search/stages.h"

#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct near_body {
    double square; /* of the distance from the one in the middle */
    uint32_t at;   /* in the group's list */
} near_body;

typedef struct shaking {
    sunder_i_search search; /* the group's bodies, and those about them, which stand; at `best` between tries */
    size_t n;               /* the group's */
    double *best;           /* [2 * search.n] a solution ... */
    double cost;            /* ... and its cost */
    near_body *near;        /* [n] scratch */
    uint64_t random;
} shaking;

static int by_nearness(const void *a, const void *b)
{
    const near_body *p = a, *q = b;
    return p->square != q->square ? (p->square < q->square ? -1 : 1) : p->at < q->at ? -1 : p->at > q->at;
}

/* In [0, 1). */
static double draw_unit(uint64_t *random) { return (double)(sunder_i_draw(random) >> 11) * 0x1p-53; }

/* The group's bodies that may move, from the one in the middle outwards: into k->near. */
static size_t list_near(const shaking *k, uint32_t middle)
{
    const sunder_i_search *s = &k->search;
    double centre[4];
    size_t n = 0;
    sunder_i_body_box(&s->model->body[s->body[middle]], s->t + 2 * (size_t)middle, 0, centre);
    for (uint32_t i = 0; i < k->n; i++) {
        double box[4], square = 0;
        if (!(s->mass[i] > 0)) continue;
        sunder_i_body_box(&s->model->body[s->body[i]], s->t + 2 * (size_t)i, 0, box);
        for (size_t c = 0; c < 2; c++) {
            const double d = (box[c] + box[c + 2] - centre[c] - centre[c + 2]) / 2;
            square += d * d;
        }
        k->near[n++] = (near_body){square, i};
    }
    qsort(k->near, n, sizeof *k->near, by_nearness);
    return n;
}

/* The n nearest are let go: to where they came from, or halfway, and up to half their size beside that. */
static void let_go(shaking *k, size_t n)
{
    sunder_i_search *s = &k->search;
    const double part = sunder_i_draw(&k->random) & 1 ? 0.5 : 0;
    for (size_t m = 0; m < n; m++) {
        const uint32_t at = k->near[m].at;
        const sunder_i_body *body = &s->model->body[s->body[at]];
        const double size = (body->box[2] - body->box[0] + body->box[3] - body->box[1]) / 2;
        for (size_t c = 0; c < 2; c++) {
            double *t = &s->t[2 * (size_t)at + c];
            *t = part * *t + (draw_unit(&k->random) - 0.5) * size;
        }
    }
}

/* Is it a solution where the group stands, but for what rounding took? */
static bool begins_free(shaking *k)
{
    sunder_i_search *s = &k->search;
    if (sunder_i_search_look(s, s->t) > s->tolerance && (s->failed || !sunder_i_search_descend(s))) return false;
    memcpy(k->best, s->t, 2 * s->n * sizeof *k->best);
    k->cost = sunder_i_search_cost(s, s->t);
    return true;
}

/* So many times at most, or until so much work is done. */
static void shake(shaking *k, size_t times, uint64_t work)
{
    sunder_i_search *s = &k->search;
    for (size_t n = 0; n < times && sunder_i_search_work(s) < work && !s->failed; n++) {
        const size_t movers = list_near(k, (uint32_t)(sunder_i_draw(&k->random) % k->n));
        const size_t most = movers < SHAKEN ? movers : SHAKEN;
        let_go(k, most < 2 ? most : 2 + sunder_i_draw(&k->random) % (most - 1));
        s->program.n = 0;
        s->patience = sunder_i_search_work(s) + SHAKE_PATIENCE + SHAKE_PATIENCE_EACH * (uint64_t)s->n;
        sunder_i_search_attempt(s, k->best, &k->cost);
    }
}

sunder_status sunder_i_group_shake(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *g,
                                   uint64_t steps, sunder_error *err)
{
    if (g->held || g->n < 2) return SUNDER_OK;
    const sunder_i_cluster cluster = {.body = g->body, .n = g->n, .margin = g->margin};
    shaking k = {.n = g->n, .random = model->rules.seed};
    sunder_i_search *s = &k.search;
    bool ok = sunder_i_search_init_about(s, model, &cluster, g->move), better = false;
    k.best = sunder_i_alloc(2 * s->n, sizeof *k.best);
    k.near = sunder_i_alloc(k.n, sizeof *k.near);
    if (ok && k.best && k.near && begins_free(&k)) {
        const double cost = k.cost;
        s->settled = SHAKE_SETTLED;
        shake(&k, 1 + k.n * k.n / PAIRS_A_SHAKE, SHAKE_WORK * steps);
        better = k.cost < cost;
    }
    ok = ok && k.best && k.near && !s->failed;
    sunder_i_search_free(s);
    sunder_status status = ok ? SUNDER_OK : sunder_i_no_memory(err);
    if (!status && better) status = sunder_i_group_descend(model, waived, g, k.best, err);
    sunder_i_free(k.best);
    sunder_i_free(k.near);
    return status;
}
