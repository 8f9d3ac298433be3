/* What is forbidden in the plane of one relative move: pieces that are nearer than they owe, and what anchors may not
 * pass. Which could be is a matter of the model alone, and is listed once for all questions about the two bodies; what
 * they owe each other is the question's. The ways of each are made once, as in violations.c. */
#include "displacement/layer/reads.h"
#include "displacement/proofs/plane.h"

#include "displacement/layer/barriers.h"
#include "displacement/layer/sides.h"
#include "displacement/obstacles/shadow.h"

#include "base/list.h"

#include <string.h>

enum { PIECES, JUMPS, SIDES }; /* of sunder_i_plane_kept.looked */

typedef struct finding {
    const sunder_i_model *model;
    uint32_t p;
    double reach;
    struct sunder_i_plane_kept *kept;
} finding;

/* ---- What there is ----------------------------------------------------------------------------------------------- */

static bool append(const finding *w, const sunder_i_plane_pieces *pieces)
{
    struct sunder_i_plane_kept *kept = w->kept;
    if (!sunder_i_reserve(&kept->pieces, &kept->capacity, kept->n + 1, sizeof *kept->pieces)) return false;
    kept->pieces[kept->n++] = *pieces;
    return true;
}

static bool find_pieces(const finding *w, uint32_t other)
{
    const sunder_i_model *model = w->model;
    const sunder_i_body *p = &model->body[w->p], *q = &model->body[other];
    uint64_t *looked = &w->kept->looked[PIECES];
    const double far = w->reach + model->rules.gap;
    double box[4], shift[4];
    for (uint32_t x = 0; x < 4; x++) {
        shift[x] = p->origin[x & 1] - q->origin[x & 1] + (x < 2 ? -far : far);
        box[x] = p->box[x] + shift[x];
    }
    ++*looked;
    if (p->pieces == 0 || q->pieces == 0 || !sunder_i_box_meet(box, q->box)) return true;
    for (uint32_t k = p->piece; k < p->piece + p->pieces; k++) {
        const sunder_i_body_piece *a = &model->piece[k];
        for (uint32_t x = 0; x < 4; x++) box[x] = a->box[x] + shift[x];
        ++*looked;
        if (!sunder_i_box_meet(box, q->box)) continue;
        *looked += q->pieces / 4;
        for (uint32_t l = q->piece; l < q->piece + q->pieces; l++) {
            const sunder_i_body_piece *b = &model->piece[l];
            if (sunder_i_box_meet(box, b->box) &&
                !append(w, &(sunder_i_plane_pieces){.a = a, .b = b, .q = other, .f = a->feature, .g = b->feature}))
                return false;
        }
    }
    return true;
}

/* Of what an anchor may not pass, if it reaches so far; swapped: the anchor is of q. */
static bool find_shadow(const finding *w, uint32_t q, const sunder_i_body_piece *anchor,
                        const sunder_i_body_piece *piece, bool swapped, uint32_t f, bool side)
{
    const sunder_i_body_piece *a = swapped ? piece : anchor, *b = swapped ? anchor : piece;
    const sunder_i_body *body = w->model->body;
    const double offset[2] = {body[q].origin[0] - body[w->p].origin[0], body[q].origin[1] - body[w->p].origin[1]},
                 way[4] = {-w->reach, -w->reach, w->reach, w->reach};
    const sunder_i_plane_pieces pieces = {
        .a = a, .b = b, .q = q, .f = f, .g = piece->feature, .shadow = true, .side = side};
    return !sunder_i_shadow_may_reach(a->box, b->box, offset, way) || append(w, &pieces);
}

/* Over which pieces of one could anchors of the other jump? swapped: the anchors are those of q. */
static bool find_jumps(const finding *w, uint32_t q, bool swapped)
{
    const sunder_i_model *model = w->model;
    const sunder_i_body *of = &model->body[swapped ? q : w->p], *other = &model->body[swapped ? w->p : q];
    for (uint32_t m = 0; m < of->members; m++) {
        const uint32_t f = model->member[of->member + m];
        const sunder_i_body_piece *anchor = &model->anchor[f];
        w->kept->looked[JUMPS] += 1 + (other->pieces + other->seams) / 4;
        for (uint32_t l = 0; l < other->pieces + other->seams && anchor->corners; l++) {
            const sunder_i_body_piece *piece =
                l < other->pieces ? &model->piece[other->piece + l] : &model->seam[other->seam + l - other->pieces];
            if (!find_shadow(w, q, anchor, piece, swapped, f, false)) return false;
        }
    }
    return true;
}

/* Sides of a part of a barrier. */
static bool find_sides(const finding *w, uint32_t part)
{
    const sunder_i_model *model = w->model;
    const sunder_i_body *of = &model->body[w->p], *q = &model->body[part];
    for (uint32_t m = 0; m < of->members && q->sides; m++) {
        const uint32_t f = model->member[of->member + m];
        const sunder_i_body_piece *anchor = &model->side_anchor[f];
        w->kept->looked[SIDES] += 1 + q->sides / 4;
        for (uint32_t l = q->side; l < q->side + q->sides && anchor->corners; l++) {
            const sunder_i_side *side = &model->side[l];
            if (sunder_i_side_faces(model, side, f) && !find_shadow(w, part, anchor, &side->piece, false, f, true))
                return false;
        }
    }
    return true;
}

static bool find_beside(const finding *w, uint32_t q)
{
    const sunder_i_model *model = w->model;
    if (!find_pieces(w, q)) return false;
    if (sunder_i_is_barrier_body(model, &model->body[q])) return find_sides(w, q);
    return model->rules.jumps || (find_jumps(w, q, false) && find_jumps(w, q, true));
}

static bool find_on_ground(const finding *w)
{
    const sunder_i_model *model = w->model;
    const sunder_i_body *p = &model->body[w->p];
    sunder_i_list near = {0};
    bool ok = true;
    for (uint32_t m = 0; m < p->members && ok; m++) {
        const uint32_t f = model->member[p->member + m];
        double box[4];
        if (!model->present[f]) continue;
        sunder_i_box_grow(model->box + 4 * (size_t)f, w->reach + model->rules.gap, box);
        w->kept->looked[PIECES] += LOOK_WORK;
        ok = sunder_i_look_about(model, &model->tree, box, &near);
    }
    for (size_t k = 0; k < near.n; k++) near.item[k] = model->body_of[near.item[k]];
    near.n = sunder_i_set_make(near.item, near.n);
    for (size_t k = 0; k < near.n && ok; k++) {
        const uint32_t q = near.item[k];
        if (q != w->p && !(sunder_i_limit_of(&model->body[q]) > 0)) ok = find_beside(w, q);
    }
    sunder_i_free(near.item);
    return ok;
}

bool sunder_i_plane_find(const sunder_i_plane *g, struct sunder_i_plane_kept *kept)
{
    const finding w = {g->c->model, g->p, g->reach, kept};
    return g->q == SUNDER_I_GROUND ? find_on_ground(&w) : find_beside(&w, g->q);
}

/* ---- What is forbidden ------------------------------------------------------------------------------------------- */

/* What limits leave of what is behind the ways in c->scratch: its box. False: nothing. */
static bool is_within_reach(const sunder_i_plane *g, size_t ways, double box[4])
{
    const sunder_i_branching *c = g->c;
    const double beyond = g->disc.xy[0] * (1 + 0x1p-20); /* a line so far off has all of the disc on one side */
    for (size_t k = 0; k < ways; k++)
        if (c->scratch[k].d < -beyond) return false;
    sunder_i_plane_region r = g->disc;
    uint32_t by[2];
    for (size_t k = 0; k < ways; k++) {
        const double back[2] = {-c->scratch[k].n[0], -c->scratch[k].n[1]};
        if (c->scratch[k].d > beyond) continue;
        if (!sunder_i_plane_clip(&r, back, -c->scratch[k].d, SUNDER_I_NO_CLAIM, by)) return false;
    }
    sunder_i_box_clear(box);
    for (uint32_t k = 0; k < r.n; k++) sunder_i_box_include(box, r.xy + 2 * k);
    return ways > 0;
}

/* Makes the ways of two pieces. False if memory is out. */
static bool make_ways(sunder_i_plane *g, sunder_i_plane_pieces *o, double clearance)
{
    struct sunder_i_plane_kept *kept = g->kept;
    const sunder_i_model *model = g->c->model;
    const size_t ways = sunder_i_branching_fill_ways(g->c, &model->body[g->p], o->a, &model->body[o->q], o->b,
                                                     clearance, o->shadow, NULL);
    if (g->c->failed) return false;
    o->made = true;
    o->clearance = clearance;
    o->none = !is_within_reach(g, ways, o->box);
    if (o->none) return true;
    if (ways > o->room) {
        if (!sunder_i_reserve(&kept->way, &kept->way_capacity, kept->ways + ways, sizeof *kept->way)) return false;
        o->way = kept->ways;
        o->room = ways;
        kept->ways += ways;
    }
    memcpy(kept->way + o->way, g->c->scratch, ways * sizeof *kept->way);
    o->ways = ways;
    return true;
}

static bool add(sunder_i_plane *g, sunder_i_plane_pieces *o, double clearance)
{
    if (o->made && o->clearance == clearance)
        g->c->looked += o->a->corners + o->b->corners; /* it costs who asks as much as the first */
    else if (!make_ways(g, o, clearance))
        return false;
    if (o->none) return true;
    if (!sunder_i_reserve(&g->obstacle, &g->obstacle_capacity, g->obstacles + 1, sizeof *g->obstacle)) return false;
    sunder_i_plane_obstacle *to = &g->obstacle[g->obstacles++];
    *to = (sunder_i_plane_obstacle){
        .a = o->a, .b = o->b, .q = o->q, .clearance = clearance, .shadow = o->shadow, .way = o->way, .ways = o->ways};
    memcpy(to->box, o->box, sizeof to->box);
    return true;
}

bool sunder_i_plane_add_obstacles(sunder_i_plane *g)
{
    sunder_i_branching *c = g->c;
    const sunder_i_subproblem *asked = c->subproblem;
    const bool sides = !asked->any_way, jumps = sides && !asked->any_jump;
    const sunder_i_plane_pieces *last = NULL;
    double clearance = 0;
    bool forbids = false, ok = true;
    c->looked += g->kept->looked[PIECES] + (jumps ? g->kept->looked[JUMPS] : 0) + (sides ? g->kept->looked[SIDES] : 0);
    for (size_t k = 0; k < g->kept->n && ok; k++) {
        sunder_i_plane_pieces *o = &g->kept->pieces[k];
        if (o->shadow && !(o->side ? sides : jumps)) continue;
        /* Most stand behind another of the same two things. */
        if (!last || last->f != o->f || last->g != o->g || last->shadow != o->shadow) {
            clearance = 0;
            forbids = o->shadow ? sunder_i_branching_shades(c, o->f, o->g)
                                : sunder_i_branching_owe(c, o->f, o->g, &clearance);
        }
        last = o;
        if (forbids) ok = add(g, o, clearance);
    }
    g->way = g->kept->way;
    return ok;
}
