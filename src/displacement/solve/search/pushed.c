/* Which bodies are pushed when a pair is separated? Shifts whole rows, without a program.
 *
 * Where limits leave little room, a pair in the middle of a grid has a solution only if its whole row gives way, from
 * the pair to either end of the grid, together with the bodies beside the row that it would run into. That may be
 * thousands. A few bodies around the pair do not suffice, and a program of all of them for each pair takes too long.
 *
 * So one end of the pair gives way along the line between the two, and the other end the opposite way. Two bodies that
 * satisfy n.(t_b - t_a) >= d with `spare` to spare let a move along v by x while b stands, if n.v x <= spare; beyond
 * that b is pushed. If all pushed bodies move along v, their distances satisfy difference constraints,
 *
 *     x_b >= x_a - spare / n.v      (n.v > 0; otherwise a moves away from b, or beside it),
 *
 * and the distance until b is pushed is a shortest path [Dij59]. How far the end can give way in all is the least, over
 * all pushed bodies, of the distance to reach them plus what their limits leave them along v. If both ends together do
 * not give what the pair misses it cannot be separated like this: that is known as soon as it holds for the bodies
 * examined so far, those farthest on first. So in a row without slack the search ends at the row's ends.
 *
 * The lines are support lines of obstacles (../../README.md), which are valid wherever the bodies stand: lines taken
 * elsewhere are still true, they only demand more than necessary, and are recomputed after long moves. Bodies give way
 * along v only, though a small step aside might suffice: that is left to programs (neighbourhood.c). */
#include "displacement/solve/search/pushed.h"
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include "base/extremes.h"
#include "base/heap.h"

#include <math.h>
#include <string.h>

static double component_along(const double n[2], const double *u) { return n[0] * u[0] + n[1] * u[1]; }

/* ---- Memory ------------------------------------------------------------------------------------------------------ */

bool sunder_i_pushed_init(sunder_i_pushed *pushed, sunder_i_search *all, double reach)
{
    memset(pushed, 0, sizeof *pushed);
    pushed->reach = reach;
    bool ok = sunder_i_neighbourhood_init(&pushed->about, all);
    pushed->of = sunder_i_calloc(all->n, sizeof *pushed->of);
    pushed->to = sunder_i_alloc(2 * all->n, sizeof *pushed->to);
    for (size_t e = 0; e < 2; e++) {
        sunder_i_push_front *f = &pushed->front[e];
        f->spare = sunder_i_alloc(all->n, sizeof *f->spare);
        f->reached = sunder_i_alloc(all->n, sizeof *f->reached);
        ok = ok && f->spare && f->reached;
        for (size_t k = 0; k < all->n && ok; k++) f->spare[k] = INFINITY;
    }
    return ok && pushed->of && pushed->to;
}

void sunder_i_pushed_free(sunder_i_pushed *pushed)
{
    for (size_t k = 0; pushed->of && pushed->about.all && k < pushed->about.all->n; k++)
        sunder_i_free(pushed->of[k].line);
    for (size_t e = 0; e < 2; e++) {
        sunder_i_free_all(pushed->front[e].spare, pushed->front[e].reached, pushed->front[e].heap);
    }
    for (size_t w = 0; w < PUSHED_DIRECTIONS; w++) sunder_i_free(pushed->survey[w].next);
    sunder_i_free_all(pushed->of, pushed->to);
    sunder_i_neighbourhood_free(&pushed->about);
    memset(pushed, 0, sizeof *pushed);
}

/* ---- Fronts ------------------------------------------------------------------------------------------------------ */

static bool comes_before(const void *a, const void *b)
{
    const sunder_i_push *p = a, *q = b;
    if (p->spare != q->spare) return p->spare < q->spare;
    return p->progress != q->progress ? p->progress > q->progress : p->body < q->body;
}

static void reach_body(const sunder_i_pushed *p, sunder_i_push_front *f, uint32_t k, double spare)
{
    sunder_i_search *s = p->about.all;
    const sunder_i_body *b = &s->model->body[s->body[k]], *first = &s->model->body[s->body[0]];
    if (spare >= f->most || spare >= f->spare[k]) return;
    if (!sunder_i_reserve(&f->heap, &f->capacity, f->waiting + 1, sizeof *f->heap)) {
        s->failed = true;
        return;
    }
    if (f->spare[k] == INFINITY) f->reached[f->n++] = k;
    f->spare[k] = spare;
    const double place[2] = {b->origin[0] - first->origin[0], b->origin[1] - first->origin[1]};
    sunder_i_heap_push(f->heap, &f->waiting, sizeof *f->heap,
                       &(sunder_i_push){spare, component_along(f->along, place), k}, comes_before);
}

static void begin_front(const sunder_i_pushed *p, sunder_i_push_front *f, uint32_t k, const double along[2],
                        double most)
{
    for (size_t m = 0; m < f->n; m++) f->spare[f->reached[m]] = INFINITY;
    f->n = f->waiting = 0;
    f->along[0] = along[0];
    f->along[1] = along[1];
    f->most = most;
    reach_body(p, f, k, 0);
}

/* Examines the next body in the queue of a front. `end` is its end of the pair, `but` the other end, which it does not
 * push. False if the queue is empty. */
static bool advance_front(sunder_i_pushed *p, sunder_i_push_front *f, uint32_t end, uint32_t but)
{
    sunder_i_search *s = p->about.all;
    sunder_i_push e;
    do {
        if (f->waiting == 0) return false;
        sunder_i_heap_pop(f->heap, &f->waiting, sizeof e, &e, comes_before);
    } while (e.spare > f->spare[e.body] || e.spare >= f->most);
    f->most = sunder_i_min(f->most, e.spare + sunder_i_pushed_room(p, e.body, f->along));
    const sunder_i_push_lines *of = sunder_i_pushed_lines(p, e.body);
    s->steps += 1 + of->n;
    for (size_t k = 0; k < of->n && !s->failed; k++) {
        const sunder_i_push_line *l = &of->line[k];
        const double on = component_along(l->n, f->along);
        if (!(on > PUSHED_BESIDE) || (e.body == end && l->other == but)) continue;
        const double *t = s->t + 2 * (size_t)l->other, *own = s->t + 2 * (size_t)e.body;
        const double spare = l->n[0] * (t[0] - own[0]) + l->n[1] * (t[1] - own[1]) - l->d;
        reach_body(p, f, l->other, e.spare + (spare > s->tolerance ? spare / on : 0));
    }
    return true;
}

bool sunder_i_pushed_reaches(sunder_i_pushed *pushed, uint32_t i, uint32_t j, const double n[2], double missing)
{
    const double back[2] = {-n[0], -n[1]};
    sunder_i_push_front *f = pushed->front;
    if (sunder_i_pushed_is_in_vain(pushed, i, j, n, missing)) return false;
    begin_front(pushed, &f[0], j, n, missing);
    begin_front(pushed, &f[1], i, back, missing);
    bool any = true;
    while (any && f[0].most + f[1].most >= missing && !pushed->about.all->failed) {
        any = advance_front(pushed, &f[0], j, i);
        any = advance_front(pushed, &f[1], i, j) || any;
    }
    if (f[0].most + f[1].most >= missing && !pushed->about.all->failed) return true;
    sunder_i_pushed_note_in_vain(pushed);
    return false;
}

/* ---- Giving way -------------------------------------------------------------------------------------------------- */

/* The number of bodies that are pushed if this end moves as far as it can. */
static double count_pushed(const sunder_i_push_front *f)
{
    size_t n = 0;
    for (size_t k = 0; k < f->n; k++) n += f->spare[f->reached[k]] < f->most;
    return (double)n;
}

/* Divides the move between the two ends. The end that pushes fewer bodies moves farther, in inverse proportion, which
 * minimises the sum of the squared moves. */
static void divide_between_fronts(const sunder_i_push_front f[2], double missing, double share[2])
{
    const double right = count_pushed(&f[0]), left = count_pushed(&f[1]);
    share[0] = right + left > 0 ? missing * left / (right + left) : missing / 2;
    share[0] = sunder_i_max(missing - f[1].most, sunder_i_min(f[0].most, share[0]));
    share[1] = missing - share[0];
}

/* The lines of the moved bodies, and of the bodies around them, have to be checked again. */
static void note_gone(sunder_i_pushed *p)
{
    for (size_t k = 0; k < p->about.n; k++) {
        sunder_i_push_lines *of = &p->of[p->about.place[k]];
        of->fresh = false;
        for (size_t m = 0; m < of->n; m++) p->of[of->line[m].other].fresh = false;
    }
}

bool sunder_i_pushed_part(sunder_i_pushed *pushed, double missing)
{
    sunder_i_search *s = pushed->about.all;
    double share[2];
    divide_between_fronts(pushed->front, missing, share);
    pushed->about.n = 0;
    for (size_t e = 0; e < 2; e++) {
        const sunder_i_push_front *f = &pushed->front[e];
        for (size_t k = 0; k < f->n; k++) {
            const uint32_t b = f->reached[k];
            const double by = share[e] - f->spare[b];
            if (!(by > 0)) continue;
            if (e == 1 && pushed->front[0].spare[b] < share[0]) return false; /* a body cannot be pushed by both ends */
            double *to = pushed->to + 2 * pushed->about.n;
            pushed->about.place[pushed->about.n++] = b;
            for (int x = 0; x < 2; x++) to[x] = s->t[2 * (size_t)b + (size_t)x] + by * f->along[x];
        }
    }
    if (!sunder_i_neighbourhood_put(&pushed->about, pushed->to)) return false;
    note_gone(pushed);
    return true;
}
