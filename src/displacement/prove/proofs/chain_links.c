/* Links of chains (chain.c): two pieces to which the limits of their bodies leave only one way past each other. */
#include "displacement/layer/reads.h"
#include "displacement/prove/proofs/chain.h"
#include "displacement/prove/proofs/tuning.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TURN 6.28318530717958647692

static double dot_product(const double n[2], const double *u) { return n[0] * u[0] + n[1] * u[1]; }

/* ---- Half-planes that are left ----------------------------------------------------------------------------------- */

bool sunder_i_chain_is_open(const sunder_i_half_plane *half_plane, double reach)
{
    return half_plane->d <= reach + CHAIN_HAIR * (reach + fabs(half_plane->d));
}

/* Computes the greatest component along half_plane->n of a relative move within reach that is behind the other line. */
bool sunder_i_chain_is_open_behind(const sunder_i_half_plane *half_plane, const sunder_i_half_plane *behind,
                                   double reach)
{
    if (!sunder_i_chain_is_open(half_plane, reach)) return false;
    const double cosine = half_plane->n[0] * behind->n[0] + half_plane->n[1] * behind->n[1];
    if (behind->d < -reach) return false;
    if (reach * cosine <= behind->d) return true;
    const double sine = sqrt(sunder_i_max(0, 1 - cosine * cosine)),
                 across = sqrt(sunder_i_max(0, reach * reach - behind->d * behind->d));
    return half_plane->d <= behind->d * cosine + across * sine + CHAIN_HAIR * (reach + fabs(half_plane->d));
}

bool sunder_i_chain_only_half_plane(sunder_i_half_plane *half_plane, size_t n, double reach)
{
    for (size_t k = 0; k < n; k++) {
        if (!sunder_i_chain_is_open(&half_plane[k], reach)) continue;
        bool only = true;
        for (size_t l = 0; l < n && only; l++)
            only = l == k || !sunder_i_chain_is_open_behind(&half_plane[l], &half_plane[k], reach);
        if (!only) continue;
        const sunder_i_half_plane first = half_plane[k];
        memmove(half_plane + 1, half_plane, k * sizeof *half_plane);
        half_plane[0] = first;
        return true;
    }
    return false;
}

/* Computes the line that all open half-planes imply together, up to the arcs on the circle of reachable moves. Returns
 * false if there is none, or if it implies too little.
 *
 *         , - ~ - ,
 *      ,'     w1   \',     The reachable moves beyond a line are the hull of an arc. So the moves beyond any of
 *     /          \  | \    several lines are in the hull of all their arcs, which is bounded by one line, the chord.
 *    |     o      \ |  |   It is moved outward slightly, so that each half-plane, with no move beyond the chord,
 *     \         w2/\| /    contradicts the limits.
 *      ',       /  ,|'
 *         ' - ~ - ' */
static bool make_chord(const sunder_i_half_plane *half_plane, size_t n, double reach, sunder_i_half_plane *out)
{
    double middle = 0, low = 0, high = 0;
    bool any = false;
    for (size_t k = 0; k < n; k++) {
        if (!sunder_i_chain_is_open(&half_plane[k], reach)) continue;
        if (half_plane[k].d <= -reach) return false;
        const double direction = atan2(half_plane[k].n[1], half_plane[k].n[0]),
                     half = acos(sunder_i_min(1, half_plane[k].d / reach));
        if (!any) middle = direction;
        const double turn = any ? remainder(direction - middle, TURN) : 0;
        low = any ? sunder_i_min(low, turn - half) : -half;
        high = any ? sunder_i_max(high, turn + half) : half;
        any = true;
    }
    const double half = (high - low) / 2, along = middle + (low + high) / 2;
    if (!any || half > CHAIN_WIDEST) return false;
    const double c = cos(along), s = sin(along), length = sqrt(c * c + s * s);
    *out = (sunder_i_half_plane){.n = {c / length, s / length}, .d = reach * (cos(half) - CHAIN_CHORD)};
    return true;
}

size_t sunder_i_chain_half_planes(sunder_i_branching *branching, size_t n, double reach)
{
    sunder_i_half_plane chord;
    if (sunder_i_chain_only_half_plane(branching->scratch, n, reach)) return n;
    if (!make_chord(branching->scratch, n, reach, &chord)) return 0;
    if (!sunder_i_reserve(&branching->scratch, &branching->scratch_capacity, n + 1, sizeof *branching->scratch)) {
        branching->failed = true;
        return 0;
    }
    memmove(branching->scratch + 1, branching->scratch, n * sizeof *branching->scratch);
    branching->scratch[0] = chord;
    return n + 1;
}

/* ---- Links ------------------------------------------------------------------------------------------------------- */

static uint32_t *find_links(const sunder_i_chains *g, uint32_t body)
{
    return g->of.reserves ? bsearch(&body, g->of.reserve, g->of.reserves, sizeof body, sunder_i_by_number) : NULL;
}

void sunder_i_chains_stand(const sunder_i_chains *chains, uint32_t body, double t[2])
{
    const bool moves = !chains->all && find_links(chains, body) && !chains->of.model->body[body].fixed;
    t[0] = moves ? chains->of.model->move[2 * (size_t)body] : 0;
    t[1] = moves ? chains->of.model->move[2 * (size_t)body + 1] : 0;
}

/* Sets g->branching.near to the bodies, ascending, that the body may meet: fixed ones, and those of the cluster. */
static bool find_near(sunder_i_chains *g, uint32_t of)
{
    const sunder_i_model *model = g->of.model;
    const sunder_i_body *p = &model->body[of];
    const double none[2] = {0, 0};
    sunder_i_list *near = &g->branching.near;
    double box[4];
    size_t out = 0;
    near->n = 0;
    sunder_i_body_box(p, none, p->limit + g->of.farthest + model->rules.gap, box);
    if (!sunder_i_look_about(model, &model->tree, box, near)) return false;
    g->work += near->n + CHAIN_LOOK;
    for (size_t k = 0; k < near->n; k++) {
        const uint32_t b = model->body_of[near->item[k]];
        const double limit = sunder_i_limit_of(&model->body[b]);
        if (b != of && (limit == 0 || (isfinite(limit) && find_links(g, b)))) near->item[out++] = b;
    }
    near->n = sunder_i_set_make(near->item, out);
    return true;
}

/* Adds the link of two pieces, if there is one. Returns false if memory is out. */
static bool link_pieces(sunder_i_chains *g, uint32_t i, const sunder_i_body_piece *a, uint32_t j,
                        const sunder_i_body_piece *b)
{
    const sunder_i_body *p = &g->of.model->body[i], *q = &g->of.model->body[j];
    const double reach = sunder_i_limit_of(p) + sunder_i_limit_of(q);
    sunder_i_branching *c = &g->branching;
    double clearance, s[2], t[2];
    if (!sunder_i_branching_owe(c, a->feature, b->feature, &clearance)) return true;
    const size_t n = sunder_i_branching_fill_half_planes(c, p, a, q, b, clearance, false, NULL);
    const size_t half_planes = c->failed ? 0 : sunder_i_chain_half_planes(c, n, reach);
    g->work += n;
    if (c->failed) return false;
    if (half_planes == 0) return true;
    if (!sunder_i_reserve(&g->link, &g->link_capacity, g->links + 1, sizeof *g->link) ||
        !sunder_i_reserve(&g->step, &g->step_capacity, g->links + 1, sizeof *g->step))
        return false;
    const sunder_i_half_plane *w = c->scratch;
    sunder_i_chains_stand(g, i, s);
    sunder_i_chains_stand(g, j, t);
    const double spare = dot_product(w->n, t) - dot_product(w->n, s) - w->d;
    g->step[g->links].search = 0;
    g->link[g->links++] = (sunder_i_chain_link){.i = i,
                                                .j = j,
                                                .a = a,
                                                .b = b,
                                                .clearance = clearance,
                                                .n = {w->n[0], w->n[1]},
                                                .d = w->d,
                                                .spare = g->all ? spare : sunder_i_max(0, spare)};
    return true;
}

static bool link_bodies(sunder_i_chains *g, uint32_t i, uint32_t j)
{
    const sunder_i_model *model = g->of.model;
    const sunder_i_body *p = &model->body[i], *q = &model->body[j];
    const double reach = sunder_i_limit_of(p) + sunder_i_limit_of(q) + model->rules.gap;
    const sunder_i_body_pieces *of_p = sunder_i_pieces_of(model, p), *of_q = sunder_i_pieces_of(model, q);
    if (!of_p || !of_q) return false;
    for (uint32_t k = 0; k < p->pieces; k++) {
        const sunder_i_body_piece *a = &of_p->piece[k];
        double box[4];
        for (uint32_t x = 0; x < 4; x++)
            box[x] = a->box[x] + (p->origin[x & 1] - q->origin[x & 1]) + (x < 2 ? -reach : reach);
        g->work++;
        if (!sunder_i_box_meet(box, q->box)) continue;
        g->work += q->pieces / 4;
        for (uint32_t l = 0; l < q->pieces; l++)
            if (sunder_i_box_meet(box, of_q->piece[l].box) && !link_pieces(g, i, a, j, &of_q->piece[l])) return false;
    }
    return true;
}

const sunder_i_chain_links *sunder_i_chains_find(sunder_i_chains *chains, uint32_t body)
{
    static const sunder_i_chain_links none = {.known = true};
    const uint32_t *place = find_links(chains, body);
    if (!place) return &none;
    sunder_i_chain_links *of = &chains->body[place - chains->of.reserve];
    if (of->known) return of;
    of->first = chains->links;
    if (!find_near(chains, body)) return NULL;
    for (size_t k = 0; k < chains->branching.near.n; k++)
        if (!link_bodies(chains, body, chains->branching.near.item[k])) return NULL;
    of->n = chains->links - of->first;
    of->known = true;
    return of;
}
