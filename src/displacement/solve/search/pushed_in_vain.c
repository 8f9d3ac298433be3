/* Is pushing useless? Decided for many pairs at once.
 *
 * In a crowd that has almost no room hardly any question of pushed.c succeeds, and each looks at hundreds of bodies
 * before it fails. How far a body can give way in a direction is the same for all questions,
 *
 *     most(k) = min(what its limit leaves it, spare(k, m) + most(m) of all m that it pushes),
 *
 * so shortest paths from all limits at once [Dij59] give it for all bodies, with the path: the body that each pushes
 * first, until one is stopped by its own limit. That is done for a few directions, where the failed questions have cost
 * as much as it takes. A pair follows the path from either end: the sum along it, in the present layout and in the
 * pair's own direction, bounds how far that end can give way, since any path gives a bound, whichever direction it was
 * shortest in and however the layout has changed. So a push that would succeed is never declared useless. */
#include "displacement/solve/search/pushed.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/heap.h"

#include <math.h>

#define FULL_TURN 6.28318530717958647692

static size_t direction_of(const double along[2])
{
    const double turns = atan2(along[1], along[0]) / FULL_TURN + 1;
    return (size_t)(turns * PUSHED_DIRECTIONS + 0.5) % PUSHED_DIRECTIONS;
}

static double dot_product(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }

/* How far body k moves until it pushes the other body of the line; on: the component of the line's normal along the
 * direction. If it is negative, the other body pushes k. */
static double spare_of(const sunder_i_search *s, const sunder_i_push_line *l, uint32_t k, double on)
{
    const double *own = s->t + 2 * (size_t)k, *t = s->t + 2 * (size_t)l->other;
    const double spare = l->n[0] * (t[0] - own[0]) + l->n[1] * (t[1] - own[1]) - l->d;
    return spare > s->tolerance ? spare / fabs(on) : 0;
}

/* ---- All of one direction ---------------------------------------------------------------------------------------- */

/* A body in the queue, and an upper bound of how far it can move. */
typedef struct giving {
    double most;
    uint32_t body;
} giving;

static bool gives_less(const void *a, const void *b)
{
    const giving *p = a, *q = b;
    return p->most != q->most ? p->most < q->most : p->body < q->body;
}

typedef struct survey {
    sunder_i_pushed *pushed;
    double along[2];
    double *most; /* [n] upper bounds of how far bodies can move */
    uint32_t *next;
    giving *heap;
    size_t waiting, capacity;
} survey;

static void lower_room(survey *v, uint32_t k, double most, uint32_t next)
{
    if (!(most < v->most[k])) return;
    if (!sunder_i_reserve(&v->heap, &v->capacity, v->waiting + 1, sizeof *v->heap)) {
        v->pushed->about.all->failed = true;
        return;
    }
    v->most[k] = most;
    v->next[k] = next;
    sunder_i_heap_push(v->heap, &v->waiting, sizeof *v->heap, &(giving){most, k}, gives_less);
}

/* Lowers the bounds of the bodies that push body k. The lines between two bodies are almost the same for both, so those
 * of k are used. */
static void lower_pushers(survey *v, uint32_t k)
{
    sunder_i_search *s = v->pushed->about.all;
    const sunder_i_push_lines *of = sunder_i_pushed_lines(v->pushed, k);
    s->steps += 1 + of->n;
    for (size_t m = 0; m < of->n && !s->failed; m++) {
        const sunder_i_push_line *l = &of->line[m];
        const double on = dot_product(l->n, v->along);
        if (on < -PUSHED_BESIDE) lower_room(v, l->other, v->most[k] + spare_of(s, l, k, on), k);
    }
}

static void survey_direction(sunder_i_pushed *p, size_t direction)
{
    sunder_i_search *s = p->about.all;
    sunder_i_push_survey *w = &p->survey[direction];
    const double angle = FULL_TURN * (double)direction / PUSHED_DIRECTIONS;
    survey v = {.pushed = p, .along = {cos(angle), sin(angle)}};
    if (!w->next) w->next = sunder_i_alloc(s->n, sizeof *w->next);
    v.next = w->next;
    v.most = sunder_i_alloc(s->n, sizeof *v.most);
    s->failed = s->failed || !v.next || !v.most;
    for (size_t k = 0; k < s->n && !s->failed; k++) v.most[k] = INFINITY;
    for (uint32_t k = 0; k < s->n && !s->failed; k++) {
        v.next[k] = SUNDER_I_NOBODY;
        lower_room(&v, k, sunder_i_pushed_room(p, k, v.along), SUNDER_I_NOBODY);
    }
    while (v.waiting && !s->failed) {
        giving g;
        sunder_i_heap_pop(v.heap, &v.waiting, sizeof g, &g, gives_less);
        if (g.most <= v.most[g.body]) lower_pushers(&v, g.body);
    }
    w->in_vain = 0;
    sunder_i_free_all(v.most, v.heap);
}

/* ---- One pair ---------------------------------------------------------------------------------------------------- */

static double spare_between(sunder_i_pushed *p, uint32_t k, uint32_t other, const double along[2])
{
    const sunder_i_push_lines *of = sunder_i_pushed_lines(p, k);
    double least = INFINITY;
    for (size_t m = 0; m < of->n; m++) {
        const double on = dot_product(of->line[m].n, along);
        if (of->line[m].other == other && on > PUSHED_BESIDE)
            least = sunder_i_min(least, spare_of(p->about.all, &of->line[m], k, on));
    }
    return least;
}

/* An upper bound of how far `end` can move, not computed more closely than to `enough`. It does not push `but`, the
 * other end. */
static double most_along(sunder_i_pushed *p, uint32_t end, uint32_t but, const double along[2], double enough)
{
    sunder_i_search *s = p->about.all;
    const uint32_t *next = p->survey[direction_of(along)].next;
    double most = enough, spare = 0;
    size_t hops = 0; /* paths may have become cycles, since bodies have moved */
    for (uint32_t k = end; next && hops < s->n && spare < most && !s->failed; k = next[k], hops++) {
        most = sunder_i_min(most, spare + sunder_i_pushed_room(p, k, along));
        if (next[k] == SUNDER_I_NOBODY || (k == end && next[k] == but)) break;
        spare += spare_between(p, k, next[k], along);
    }
    s->steps += hops;
    return most;
}

bool sunder_i_pushed_is_in_vain(sunder_i_pushed *pushed, uint32_t i, uint32_t j, const double n[2], double missing)
{
    const double back[2] = {-n[0], -n[1]}, most = most_along(pushed, j, i, n, missing);
    return !(most + most_along(pushed, i, j, back, missing) >= missing);
}

void sunder_i_pushed_note_in_vain(sunder_i_pushed *pushed)
{
    for (size_t e = 0; e < 2; e++) {
        const size_t direction = direction_of(pushed->front[e].along);
        pushed->survey[direction].in_vain += pushed->front[e].n;
        if (pushed->survey[direction].in_vain > PUSHED_SURVEY * pushed->about.all->n && !pushed->about.all->failed)
            survey_direction(pushed, direction);
    }
}
