/* What is forbidden in the plane of one relative move: pieces that are nearer than they owe, and what anchors may not
 * pass. The ways of each are made once, as in violations.c. */
#include "displacement/proofs/plane.h"

#include "displacement/layer/barriers.h"
#include "displacement/layer/sides.h"
#include "displacement/obstacles/shadow.h"

#include "base/list.h"

#include <string.h>

/* Keeps the ways in c->scratch as an obstacle, if they leave it anything within reach. */
static bool add_obstacle(sunder_i_plane *g, const sunder_i_plane_obstacle *o, size_t ways)
{
    const sunder_i_branching *c = g->c;
    if (ways == 0) return true;
    const double beyond = g->disc.xy[0] * (1 + 0x1p-20); /* a line so far off has all of the disc on one side */
    for (size_t k = 0; k < ways; k++)
        if (c->scratch[k].d < -beyond) return true;
    sunder_i_plane_region r = g->disc;
    uint32_t by[2];
    for (size_t k = 0; k < ways; k++) {
        const double back[2] = {-c->scratch[k].n[0], -c->scratch[k].n[1]};
        if (c->scratch[k].d > beyond) continue;
        if (!sunder_i_plane_clip(&r, back, -c->scratch[k].d, SUNDER_I_NO_CLAIM, by)) return true;
    }
    if (!sunder_i_reserve(&g->obstacle, &g->obstacle_capacity, g->obstacles + 1, sizeof *g->obstacle) ||
        !sunder_i_reserve(&g->way, &g->way_capacity, g->ways + ways, sizeof *g->way))
        return false;
    sunder_i_plane_obstacle *to = &g->obstacle[g->obstacles++];
    *to = *o;
    to->way = g->ways;
    to->ways = ways;
    sunder_i_box_clear(to->box);
    for (uint32_t k = 0; k < r.n; k++) sunder_i_box_include(to->box, r.xy + 2 * k);
    memcpy(g->way + g->ways, c->scratch, ways * sizeof *g->way);
    g->ways += ways;
    return true;
}

/* Of these two pieces; a is of g->p. */
static bool add(sunder_i_plane *g, uint32_t q, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
                double clearance, bool shadow)
{
    const sunder_i_model *model = g->c->model;
    const sunder_i_plane_obstacle o = {.a = a, .b = b, .q = q, .clearance = clearance, .shadow = shadow};
    const size_t ways =
        sunder_i_branching_fill_ways(g->c, &model->body[g->p], a, &model->body[q], b, clearance, shadow, NULL);
    return !g->c->failed && add_obstacle(g, &o, ways);
}

static bool add_pieces(sunder_i_plane *g, uint32_t other)
{
    const sunder_i_model *model = g->c->model;
    const sunder_i_body *p = &model->body[g->p], *q = &model->body[other];
    const double far = g->reach + model->rules.gap;
    double box[4], shift[4], clearance;
    for (uint32_t x = 0; x < 4; x++) {
        shift[x] = p->origin[x & 1] - q->origin[x & 1] + (x < 2 ? -far : far);
        box[x] = p->box[x] + shift[x];
    }
    g->c->looked++;
    if (p->pieces == 0 || q->pieces == 0 || !sunder_i_box_meet(box, q->box)) return true;
    for (uint32_t k = p->piece; k < p->piece + p->pieces; k++) {
        const sunder_i_body_piece *a = &model->piece[k];
        for (uint32_t x = 0; x < 4; x++) box[x] = a->box[x] + shift[x];
        g->c->looked++;
        if (!sunder_i_box_meet(box, q->box)) continue;
        g->c->looked += q->pieces / 4;
        for (uint32_t l = q->piece; l < q->piece + q->pieces; l++) {
            const sunder_i_body_piece *b = &model->piece[l];
            if (sunder_i_box_meet(box, b->box) && sunder_i_branching_owe(g->c, a->feature, b->feature, &clearance) &&
                !add(g, other, a, b, clearance, false))
                return false;
        }
    }
    return true;
}

/* Of what an anchor may not pass; swapped: the anchor is of q. */
static bool add_shadow(sunder_i_plane *g, uint32_t q, const sunder_i_body_piece *anchor,
                       const sunder_i_body_piece *piece, bool swapped)
{
    const sunder_i_body_piece *a = swapped ? piece : anchor, *b = swapped ? anchor : piece;
    const sunder_i_body *body = g->c->model->body;
    const double offset[2] = {body[q].origin[0] - body[g->p].origin[0], body[q].origin[1] - body[g->p].origin[1]},
                 way[4] = {-g->reach, -g->reach, g->reach, g->reach};
    return !sunder_i_shadow_may_reach(a->box, b->box, offset, way) || add(g, q, a, b, 0, true);
}

/* Over which pieces of one may anchors of the other not jump? swapped: the anchors are those of q. */
static bool add_jumps(sunder_i_plane *g, uint32_t q, bool swapped)
{
    const sunder_i_model *model = g->c->model;
    const sunder_i_body *of = &model->body[swapped ? q : g->p], *other = &model->body[swapped ? g->p : q];
    for (uint32_t m = 0; m < of->members; m++) {
        const uint32_t f = model->member[of->member + m];
        const sunder_i_body_piece *anchor = &model->anchor[f];
        g->c->looked += 1 + (other->pieces + other->seams) / 4;
        for (uint32_t l = 0; l < other->pieces + other->seams && anchor->corners; l++) {
            const sunder_i_body_piece *piece =
                l < other->pieces ? &model->piece[other->piece + l] : &model->seam[other->seam + l - other->pieces];
            if (sunder_i_branching_shades(g->c, f, piece->feature) && !add_shadow(g, q, anchor, piece, swapped))
                return false;
        }
    }
    return true;
}

/* Sides of a part of a barrier. */
static bool add_sides(sunder_i_plane *g, uint32_t part)
{
    const sunder_i_model *model = g->c->model;
    const sunder_i_body *of = &model->body[g->p], *q = &model->body[part];
    for (uint32_t m = 0; m < of->members && q->sides; m++) {
        const uint32_t f = model->member[of->member + m];
        const sunder_i_body_piece *anchor = &model->side_anchor[f];
        g->c->looked += 1 + q->sides / 4;
        for (uint32_t l = q->side; l < q->side + q->sides && anchor->corners; l++) {
            const sunder_i_side *side = &model->side[l];
            if (sunder_i_branching_shades(g->c, f, side->piece.feature) && sunder_i_side_faces(model, side, f) &&
                !add_shadow(g, part, anchor, &side->piece, false))
                return false;
        }
    }
    return true;
}

bool sunder_i_plane_add_body(sunder_i_plane *g, uint32_t q)
{
    const sunder_i_subproblem *asked = g->c->subproblem;
    const sunder_i_model *model = g->c->model;
    if (!add_pieces(g, q)) return false;
    if (asked->any_way) return true;
    if (sunder_i_is_barrier_body(model, &model->body[q])) return add_sides(g, q);
    return model->rules.jumps || asked->any_jump || (add_jumps(g, q, false) && add_jumps(g, q, true));
}

bool sunder_i_plane_add_ground(sunder_i_plane *g)
{
    sunder_i_branching *c = g->c;
    const sunder_i_model *model = c->model;
    const sunder_i_body *p = &model->body[g->p];
    c->near.n = 0;
    for (uint32_t m = 0; m < p->members; m++) {
        const uint32_t f = model->member[p->member + m];
        double box[4];
        if (!model->present[f]) continue;
        sunder_i_box_grow(model->box + 4 * (size_t)f, g->reach + model->rules.gap, box);
        c->looked += LOOK_WORK;
        if (!sunder_i_rtree_query(&model->tree, box, &c->near)) return false;
    }
    for (size_t k = 0; k < c->near.n; k++) c->near.item[k] = model->body_of[c->near.item[k]];
    c->near.n = sunder_i_set_make(c->near.item, c->near.n);
    for (size_t k = 0; k < c->near.n; k++) {
        const uint32_t q = c->near.item[k];
        if (q != g->p && !(sunder_i_limit_of(&model->body[q]) > 0) && !sunder_i_plane_add_body(g, q)) return false;
    }
    return true;
}
