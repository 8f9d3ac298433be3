/* Without jumps and without limits: all bodies move straight away from a common centre, as far as necessary.
 *
 * If each body moves by a common multiple of the vector from the centre to its anchor, any two move straight away from
 * each other's anchors. A feature that is entirely visible from its own anchor, as convex features are, then passes no
 * other. So however crowded a cluster is, without limits there is such a solution for all its features of that kind;
 * from it they descend as near as their sides let them. It is the last resort, before pairs are given up: moving one
 * body at a time out of clashes may leave no way between neighbours. If it fails too (something stands in a yard), the
 * layout with the fewest clashes is taken, and the clashing pairs are given up. */
#include "displacement/solve/search/search_stages.h"
#include "displacement/solve/search/tuning.h"

#include <math.h>
#include <string.h>

/* The mean of the anchors of the body's members, relative to the origin of the first body. For a body with far corners
 * its origin stands for it: the anchor may be outside of the window (../../layer/far_corners.c), and bodies that spread
 * from there pass the end of the window. */
static void anchor_of(sunder_i_search *s, uint32_t k, double out[2])
{
    const sunder_i_model *model = s->model;
    const sunder_i_body *b = &model->body[s->body[k]], *first = &model->body[s->body[0]];
    const sunder_i_body_pieces *pieces = sunder_i_pieces_of(model, b);
    uint32_t n = 0;
    out[0] = out[1] = 0;
    if (!pieces) s->failed = true;
    for (uint32_t m = 0; m < b->members && pieces && !b->far; m++) {
        const sunder_i_body_piece *anchor = &pieces->anchor[m];
        if (!anchor->corners) continue;
        for (int c = 0; c < 2; c++) out[c] += anchor->box[c];
        n++;
    }
    for (int c = 0; c < 2; c++) out[c] = b->origin[c] - first->origin[c] + (n ? out[c] / n : 0);
}

/* The centre is the first fixed body, if there is one, otherwise the mean of the movable bodies; each stands for the
 * mean of its anchors. False if a movable body has a limit, or none is movable. */
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

/* Moves each body by `share` times its vector from the centre. If there are still clashes and the share is large,
 * clashing bodies jump. Returns whether a descent from there succeeds. */
static bool try_share(sunder_i_search *s, const double centre[2], double share)
{
    double at[2];
    for (uint32_t k = 0; k < s->n; k++) {
        if (!(s->mass[k] > 0)) continue;
        anchor_of(s, k, at);
        for (uint32_t c = 0; c < 2; c++) s->t[2 * k + c] = share * (at[c] - centre[c]);
    }
    s->program.n = 0; /* its forces belong to the former places */
    const bool clear = sunder_i_search_find_clashes(s, s->t) <= s->tolerance;
    return (clear || (share >= ENOUGH_SPREAD && sunder_i_search_jump(s))) && sunder_i_search_descend(s);
}

bool sunder_i_search_spread(sunder_i_search *search)
{
    double centre[2];
    if (search->model->rules.jumps || !find_centre(search, centre)) return false;
    const size_t size = 2 * search->n * sizeof *search->t;
    double *best = sunder_i_search_copy_moves(search);
    if (search->failed) return false;
    sunder_i_search_find_clashes(search, search->t);
    size_t least = search->clashes;
    bool done = false;
    for (double share = LEAST_SPREAD; share <= MOST_SPREAD && !done && !search->failed; share *= 2) {
        done = try_share(search, centre, share);
        if (!done) sunder_i_search_find_clashes(search, search->t);
        if (done || search->clashes < least) memcpy(best, search->t, size);
        if (search->clashes < least) least = search->clashes;
    }
    sunder_i_search_end_copy(search, best, true);
    return done;
}
