/* Better layouts of a contact group by iterated local search [LMS03].
 *
 * A descent ends where nothing can be bettered in small: which body passes which on what side was settled early, when
 * most of them still stood in each other's way. In a dense group that may cost a third more than need be. So, again and
 * again: one body and those nearest to it are let go, back towards where they came from and a little beside it, and
 * from there all go down again; what is cheaper stays. Whoever is let go is drawn at random, from the user's seed and
 * in the order of the group's list, so that a group's result does not depend on others.
 *
 * It proves nothing; a tree that starts from a cheaper layout proves more of it (tree.c). */
#include "displacement/optimum/optimum.h"
#include "displacement/optimum/tuning.h"

#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct near_body {
    double square; /* of the distance from the one in the middle */
    uint32_t at;   /* in the group's list */
} near_body;

static int by_nearness(const void *a, const void *b)
{
    const near_body *p = a, *q = b;
    return p->square != q->square ? (p->square < q->square ? -1 : 1) : p->at < q->at ? -1 : p->at > q->at;
}

/* In [0, 1). */
static double draw_unit(uint64_t *random) { return (double)(sunder_i_draw(random) >> 11) * 0x1p-53; }

/* The group's bodies that may move, from the one in the middle outwards. */
static size_t list_near(const sunder_i_model *model, const sunder_i_group *g, uint32_t middle, near_body *near)
{
    double centre[4];
    size_t n = 0;
    sunder_i_body_box(&model->body[g->body[middle]], g->move + 2 * (size_t)middle, 0, centre);
    for (uint32_t k = 0; k < g->n; k++) {
        double box[4], square = 0;
        if (model->body[g->body[k]].fixed) continue;
        sunder_i_body_box(&model->body[g->body[k]], g->move + 2 * (size_t)k, 0, box);
        for (size_t c = 0; c < 2; c++) {
            const double d = (box[c] + box[c + 2] - centre[c] - centre[c + 2]) / 2;
            square += d * d;
        }
        near[n++] = (near_body){square, k};
    }
    qsort(near, n, sizeof *near, by_nearness);
    return n;
}

/* Where all begin: at home, or halfway, and up to half their size beside that, who is let go; the others where they
 * stand. */
static void let_go(const sunder_i_model *model, const sunder_i_group *g, const near_body *near, size_t n,
                   uint64_t *random, double *at)
{
    const double part = sunder_i_draw(random) & 1 ? 0.5 : 0;
    memcpy(at, g->move, 2 * g->n * sizeof *at);
    for (size_t k = 0; k < n; k++) {
        const sunder_i_body *body = &model->body[g->body[near[k].at]];
        const double size = (body->box[2] - body->box[0] + body->box[3] - body->box[1]) / 2;
        for (size_t c = 0; c < 2; c++) {
            double *t = &at[2 * (size_t)near[k].at + c];
            *t = part * *t + (draw_unit(random) - 0.5) * size;
        }
    }
}

/* What one descent of the group takes, in steps, as measured: less than that where it ends soon. */
static uint64_t steps_of(const sunder_i_model *model, const sunder_i_group *g)
{
    uint64_t pieces = 0;
    for (size_t k = 0; k < g->n; k++) pieces += 1 + model->body[g->body[k]].pieces;
    return SHAKE_STEPS * pieces;
}

sunder_status sunder_i_group_shake(const sunder_i_model *model, const sunder_i_waived *waived, sunder_i_group *g,
                                   uint64_t steps, sunder_error *err)
{
    if (g->held || g->n < 2) return SUNDER_OK;
    uint64_t random = model->rules.seed, spent = 0;
    const size_t n = g->n;
    near_body *near = sunder_i_alloc(n, sizeof *near);
    double *at = sunder_i_alloc(2 * n, sizeof *at);
    sunder_status status = near && at ? SUNDER_OK : sunder_i_no_memory(err);
    for (size_t shakes = 0; !status && spent < steps && shakes <= n * n / PAIRS_A_SHAKE; shakes++) {
        const size_t movers = list_near(model, g, (uint32_t)(sunder_i_draw(&random) % n), near);
        const size_t most = movers < SHAKEN ? movers : SHAKEN;
        let_go(model, g, near, most < 2 ? most : 2 + sunder_i_draw(&random) % (most - 1), &random, at);
        status = sunder_i_group_descend(model, waived, g, at, err);
        spent += steps_of(model, g);
    }
    sunder_i_free(near);
    sunder_i_free(at);
    return status;
}
