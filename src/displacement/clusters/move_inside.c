/* Pairs that limits cannot part, of which the one may go inside the other: it is sent there, and kept there from
 * then on like what lay in it at the start (keep.c). Where that fails it is let go, and the pair becomes one like
 * any other. */
#include "displacement/clusters/settle.h"
#include "displacement/clusters/stages.h"
#include "displacement/layer/rounding.h"

#include <math.h>
#include <string.h>

/* The inner one goes as far as it may, and the holder comes to meet it. */
static void send(sunder_i_job *w, const sunder_i_entry *e)
{
    const sunder_i_town *town = &w->town;
    const uint32_t inner = town->body_of[e->a_inside ? e->a : e->b], holder = town->body_of[e->a_inside ? e->b : e->a];
    const double sign = e->a_inside ? -1 : 1, length = hypot(e->place[0], e->place[1]);
    const double own = sunder_i_limit_of(&town->body[inner]), share = length > own ? own / length : 1;
    for (int k = 0; k < 2; k++) {
        const uint32_t b = k ? holder : inner;
        const double *move = town->move + 2 * (size_t)b, part = k ? -(1 - share) : share;
        if (town->body[b].fixed || part == 0 || move[0] != 0 || move[1] != 0) continue;
        double to[2];
        for (int c = 0; c < 2; c++) to[c] = sign * part * e->place[c];
        sunder_i_round_move(town, b, to, to, NULL);
        sunder_i_job_place(w, b, to);
    }
}

sunder_status sunder_i_job_enter(sunder_i_job *w, sunder_error *err)
{
    if (w->entries == 0) return SUNDER_OK;
    memset(w->changed, 0, w->town.features * sizeof *w->changed);
    for (size_t k = 0; k < w->entries; k++) {
        const uint32_t i = w->town.body_of[w->entry[k].a], j = w->town.body_of[w->entry[k].b];
        send(w, &w->entry[k]);
        if (!sunder_i_job_add_edge(w, i, j)) return sunder_i_no_memory(err);
    }
    return sunder_i_job_check(w, err);
}
