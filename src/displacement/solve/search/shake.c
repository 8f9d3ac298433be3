/* Better layouts of a contact group by iterated local search [LMS03].
 *
 * A descent ends in a local optimum: which body passes which on what side was settled early, when most of them were
 * still in each other's way. In a dense group that may cost a third more than necessary. So, repeatedly: one body and
 * those nearest to it are released, towards their original places and a little beside them, and from there all descend
 * again; a cheaper result is kept. A descent that will not be cheaper is given up on the way (descend.c), and so is one
 * that takes long. The released body is drawn at random, from the user's seed and in the order of the group's list, so
 * that a group's result does not depend on others.
 *
 * Blocks of hundreds of pieces that lay on each other have to move far, and their neighbours with them. If patience
 * ended every descent, it grows until some end by themselves. Then the body with the greatest cost is released most
 * often, or all moves around it are rotated, so that bodies go to another side, and every body looks as far as any has
 * moved. In the heaps of Paris this reduces the cost by a quarter.
 *
 * Most of the group stays in place when some bodies are released. So programs begin with the contacts of the best
 * layout and their forces, which halves the work.
 *
 * Letting only the released bodies and their neighbours descend, while all others stand, was tried: eight times as many
 * descents found less, since in a dense group all have to make room for what one gains by another side.
 *
 * It proves nothing; a tree that starts from a cheaper layout proves more of it (prove/optimum/tree.c). */
#include "displacement/solve/search/shake.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct near_body {
    double square; /* squared distance from the released body */
    uint32_t at;   /* index in the group's list */
} near_body;

typedef struct shaking {
    sunder_i_search search;     /* bodies of the group, and fixed ones around them; at `best` between tries */
    size_t n;                   /* number of the group's bodies */
    double *best;               /* [2 * search.n] the best layout without clashes */
    double cost;                /* its cost */
    near_body *near;            /* [n] scratch */
    sunder_i_constraint *force; /* [forces] contacts of `best` with their forces, from which programs start */
    size_t forces, capacity;
    bool far; /* with patience: bodies may go anywhere, and programs start without forces */
    uint64_t random, patience;
    size_t times, ended; /* the greatest number of tries without patience; number of descents that ended by
                          * themselves */
} shaking;

static int by_nearness(const void *a, const void *b)
{
    const near_body *p = a, *q = b;
    return p->square != q->square ? (p->square < q->square ? -1 : 1) : p->at < q->at ? -1 : p->at > q->at;
}

/* Draws a number in [0, 1). */
static double draw_unit(uint64_t *random) { return (double)(sunder_i_draw(random) >> 11) * 0x1p-53; }

/* Lists the movable bodies of the group in k->near, by their distance from the body `middle`. Returns their number. */
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

/* Rotates the moves of the n nearest bodies from their preferred ones by one random angle, so that a body that was
 * pushed to one side goes to another. */
static void turn_moves(shaking *k, size_t n)
{
    const double angle = 6.283185307179586 * draw_unit(&k->random), c = cos(angle), s = sin(angle);
    for (size_t m = 0; m < n; m++) {
        double *t = k->search.t + 2 * (size_t)k->near[m].at;
        const double *a = k->search.preferred + 2 * (size_t)k->near[m].at, x = t[0] - a[0], y = t[1] - a[1];
        t[0] = a[0] + (c * x - s * y);
        t[1] = a[1] + (s * x + c * y);
    }
}

/* Moves the n nearest bodies to their preferred places, or halfway, and up to half their size beside that. */
static void release_bodies(shaking *k, size_t n)
{
    sunder_i_search *s = &k->search;
    const double share = sunder_i_draw(&k->random) & 1 ? 0.5 : 0;
    for (size_t m = 0; m < n; m++) {
        const uint32_t at = k->near[m].at;
        const sunder_i_body *body = &s->model->body[s->body[at]];
        const double size = (body->box[2] - body->box[0] + body->box[3] - body->box[1]) / 2;
        for (size_t c = 0; c < 2; c++) {
            double *t = &s->t[2 * (size_t)at + c];
            const double a = s->preferred[2 * (size_t)at + c];
            *t = a + (share * (*t - a) + (draw_unit(&k->random) - 0.5) * size);
        }
    }
}

/* Takes the group's layout as `best`, after a descent if it clashes. False if that descent fails, or memory is out. */
static bool begins_free(shaking *k)
{
    sunder_i_search *s = &k->search;
    if (sunder_i_search_find_clashes(s, s->t) > s->tolerance && (s->failed || !sunder_i_search_descend(s)))
        return false;
    memcpy(k->best, s->t, 2 * s->n * sizeof *k->best);
    k->cost = sunder_i_search_cost(s, s->t);
    return true;
}

/* Draws one of the group's bodies, with a probability in proportion to its cost. */
static uint32_t draw_payer(shaking *k)
{
    const sunder_i_search *s = &k->search;
    const double at = draw_unit(&k->random) * k->cost;
    double sum = 0;
    uint32_t last = 0;
    for (uint32_t i = 0; i < k->n && sum <= at; i++) {
        if (!(s->mass[i] > 0)) continue;
        sum += sunder_i_search_stray_square(s, i, s->t) / (2 * s->mass[i]);
        last = i;
    }
    return last;
}

/* Keeps the contacts of the program that the search ended with, and their forces. False if memory is out. */
static bool keep_forces(shaking *k)
{
    const sunder_i_quadratic *p = &k->search.program;
    if (!sunder_i_reserve(&k->force, &k->capacity, p->n, sizeof *k->force)) return false;
    if (p->n) memcpy(k->force, p->constraint, p->n * sizeof *k->force);
    k->forces = p->n;
    return true;
}

/* Starts the program with the contacts that were kept, since most of the group keeps its place. False if memory is
 * out. */
static bool take_forces(shaking *k)
{
    sunder_i_quadratic *p = &k->search.program;
    if (!sunder_i_reserve(&p->constraint, &p->capacity, k->forces, sizeof *p->constraint)) return false;
    if (k->forces) memcpy(p->constraint, k->force, k->forces * sizeof *p->constraint);
    p->n = k->forces;
    return true;
}

/* Perturbs the bodies around `middle` and descends. Returns whether the descent ended by itself. */
static bool shake_about(shaking *k, uint32_t middle, bool turned)
{
    sunder_i_search *s = &k->search;
    const size_t movers = list_near(k, middle);
    const size_t most = movers < SHAKEN ? movers : SHAKEN;
    const size_t n = most < 2 ? most : 2 + sunder_i_draw(&k->random) % (most - 1);
    if (turned)
        turn_moves(k, n);
    else
        release_bodies(k, n);
    if (!take_forces(k)) s->failed = true;
    s->patience = sunder_i_search_work(s) + k->patience;
    if (sunder_i_search_attempt(s, k->best, &k->cost) && !k->far && !keep_forces(k)) s->failed = true;
    const bool ended = sunder_i_search_work(s) < s->patience;
    k->ended += ended;
    return ended;
}

static uint64_t work_of(uint64_t steps, uint64_t each) { return steps < UINT64_MAX / each ? each * steps : UINT64_MAX; }

/* Perturbs until `work` is done, or the share SHAKE_VAIN of it without a gain; SHAKE_AGAIN times as long if no descent
 * has ended by then. */
static void shake_within(shaking *k, uint64_t work)
{
    sunder_i_search *s = &k->search;
    double cost = k->cost;
    uint64_t gained = sunder_i_search_work(s);
    const uint64_t vain = (uint64_t)(SHAKE_VAIN * (double)work);
    for (size_t n = 0; n < k->times && !s->failed; n++) {
        const uint64_t now = sunder_i_search_work(s);
        if (now >= (k->ended ? work : work_of(work, SHAKE_AGAIN)) || (k->ended && now - gained >= vain)) break;
        shake_about(k, (uint32_t)(sunder_i_draw(&k->random) % k->n), false);
        if (k->cost > cost * (1 - SHAKE_GAIN)) continue;
        cost = k->cost;
        gained = sunder_i_search_work(s);
    }
}

/* Perturbs with patience, until SHAKEN_IN_VAIN descents in a row ended by themselves and gained little, or `work` is
 * done. */
static void shake_patiently(shaking *k, uint64_t work)
{
    sunder_i_search *s = &k->search;
    for (size_t vain = 0, hasty = 0; vain < SHAKEN_IN_VAIN && sunder_i_search_work(s) < work && !s->failed;) {
        const double before = k->cost;
        const bool turned = sunder_i_draw(&k->random) % ONE_TURN == 0, ended = shake_about(k, draw_payer(k), turned);
        vain = k->cost < before * (1 - SHAKEN_LITTLE) ? 0 : vain + ended;
        hasty = ended ? 0 : hasty + 1;
        if (hasty < HASTY) continue;
        k->patience *= MORE_PATIENCE;
        hasty = 0;
    }
}

/* Perturbs the group's present layout; about: a lower bound of how far each body looks around itself. A cheaper layout
 * goes to the group. */
static sunder_status shake_group(shaking *k, const sunder_i_model *model, const sunder_i_waived *waived,
                                 sunder_i_group *g, double about, uint64_t steps, sunder_error *err)
{
    const sunder_i_cluster cluster = {.body = g->body, .n = g->n, .margin = g->margin, .about = about};
    sunder_i_search *s = &k->search;
    bool ok = sunder_i_search_init_about(s, model, &cluster, g->move), better = false;
    k->best = sunder_i_alloc(2 * s->n, sizeof *k->best);
    if (ok && k->best && begins_free(k)) {
        const double cost = k->cost;
        s->settled = SHAKE_SETTLED;
        k->far = about > 0;
        k->patience = SHAKE_PATIENCE + SHAKE_PATIENCE_EACH * (uint64_t)s->n;
        if (k->far)
            shake_patiently(k, work_of(steps, SHAKE_WORK_MOST));
        else
            shake_within(k, work_of(steps, SHAKE_WORK));
        better = k->cost < cost;
    }
    ok = ok && k->best && !s->failed;
    sunder_i_search_free(s);
    sunder_i_free(k->force);
    k->force = NULL;
    k->forces = k->capacity = 0;
    sunder_status status = ok ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status && better) status = sunder_i_group_descend(model, waived, g, k->best, err);
    sunder_i_free(k->best);
    return status;
}

sunder_status sunder_i_group_shake(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *group,
                                   uint64_t steps, sunder_error *err)
{
    if (group->held || group->n < 2) return SUNDER_OK;
    shaking k = {.n = group->n, .random = model->rules.seed, .times = 1 + group->n * group->n / PAIRS_A_SHAKE};
    double farthest = 0;
    for (size_t m = 0; m < 2 * group->n; m++) farthest = sunder_i_max(farthest, fabs(group->move[m]));
    k.near = sunder_i_alloc(k.n, sizeof *k.near);
    sunder_status status = k.near ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status) status = shake_group(&k, model, waived, group, 0, steps, err);
    if (!status && k.ended == 0 && !group->tired && group->n > HEAP) {
        status = shake_group(&k, model, waived, group, farthest / 2, steps, err);
        group->shaken = true;
    }
    sunder_i_free(k.near);
    return status;
}

static sunder_status descend_group(const sunder_i_model *model, uint32_t *body, size_t n, double margin, double cost,
                                   double *move, bool *found, sunder_error *err)
{
    const sunder_i_cluster cluster = {.body = body, .n = n, .margin = margin};
    return sunder_i_cluster_descend(model, &cluster, cost, move, found, err);
}

const sunder_i_layout_search sunder_i_group_search = {descend_group, sunder_i_group_shake};
