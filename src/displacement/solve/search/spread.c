/* Where nobody may jump: all go straight away from one another, as far as need be.
 *
 * If each body goes by so many times its way from one centre to its anchor, any two go straight away from each other's
 * anchors; and whatever is seen whole from its own anchor, as convex features are, then passes nobody. So however
 * crowded a cluster is, without limits there is such a solution for all its features of that kind; from it they come
 * back down as near as their sides let them. It is the last resort, before pairs are given up: by jumps out of clashes,
 * one body at a time, no way may be left between neighbours. Where it fails too (something stands in a yard), the place
 * with the fewest clashes is left, and those are given up. */
#include "displacement/solve/search/stages.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>
#include <string.h>

/* The mean of its members' anchors, from the origin of the first body. */
static void anchor_of(sunder_i_search *s, uint32_t k, double out[2])
{
    const sunder_i_model *model = s->model;
    const sunder_i_body *b = &model->body[s->body[k]], *first = &model->body[s->body[0]];
    const sunder_i_body_pieces *pieces = sunder_i_pieces_of(model, b);
    uint32_t n = 0;
    out[0] = out[1] = 0;
    if (!pieces) s->failed = true;
    for (uint32_t m = 0; m < b->members && pieces; m++) {
        const sunder_i_body_piece *anchor = &pieces->anchor[m];
        if (!anchor->corners) continue;
        for (int c = 0; c < 2; c++) out[c] += anchor->box[c];
        n++;
    }
    for (int c = 0; c < 2; c++) out[c] = b->origin[c] - first->origin[c] + (n ? out[c] / n : 0);
}

/* Who does not move is the centre, if there is such a body; else it is in the middle of those that do. False where a
 * limit would hold some back. */
static bool find_centre(sunder_i_search *s, double centre[2])
{
    double sum[2] = {0, 0}, at[2];
    size_t n = 0;
    bool still = false;
    for (uint32_t k = 0; k < s->n; k++) {
        anchor_of(s, k, at);
        if (!(s->mass[k] > 0)) {
            if (!still) memcpy(centre, at, sizeof at);
            still = true;
            continue;
        }
        if (sunder_i_search_limit(s, k) < INFINITY) return false;
        for (int c = 0; c < 2; c++) sum[c] += at[c];
        n++;
    }
    for (int c = 0; c < 2 && !still && n; c++) centre[c] = sum[c] / (double)n;
    return n > 0;
}

/* All by so large a share of their ways from the centre; those that clash look for places if there is room for that.
 * Returns whether it is a solution. */
static bool try_share(sunder_i_search *s, const double centre[2], double share)
{
    double at[2];
    for (uint32_t k = 0; k < s->n; k++) {
        if (!(s->mass[k] > 0)) continue;
        anchor_of(s, k, at);
        for (uint32_t c = 0; c < 2; c++) s->t[2 * k + c] = share * (at[c] - centre[c]);
    }
    s->program.n = 0; /* the forces belong to places that are left */
    const bool clear = sunder_i_search_look(s, s->t) <= s->tolerance;
    return (clear || (share >= ENOUGH_SPREAD && sunder_i_search_jump(s))) && sunder_i_search_descend(s);
}

bool sunder_i_search_spread(sunder_i_search *s)
{
    double centre[2];
    if (s->model->rules.jumps || !find_centre(s, centre)) return false;
    const size_t size = 2 * s->n * sizeof *s->t;
    double *best = sunder_i_alloc(2 * s->n, sizeof *best);
    if (!best) s->failed = true;
    if (s->failed) return false;
    memcpy(best, s->t, size);
    sunder_i_search_look(s, s->t);
    size_t least = s->clashes;
    bool done = false;
    for (double share = LEAST_SPREAD; share <= MOST_SPREAD && !done && !s->failed; share *= 2) {
        done = try_share(s, centre, share);
        if (!done) sunder_i_search_look(s, s->t);
        if (done || s->clashes < least) memcpy(best, s->t, size);
        if (s->clashes < least) least = s->clashes;
    }
    memcpy(s->t, best, size);
    sunder_i_free(best);
    return done;
}
