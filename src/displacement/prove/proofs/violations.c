/* The violations of a candidate: pairs of convex pieces that are nearer than they may be, anchors that jumped over a
 * piece or crossed a side; and the half-planes of each. */
#include "displacement/geometry/anchor_reach.h"
#include "displacement/layer/reads.h"
#include "displacement/layer/sides.h"
#include "displacement/prove/proofs/branching.h"
#include "displacement/prove/proofs/tuning.h"

#include "base/extremes.h"
#include "base/list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns the pieces of a body; if memory is out, returns NULL and sets c->failed. */
static const sunder_i_body_pieces *pieces_of(sunder_i_branching *c, const sunder_i_body *body)
{
    const sunder_i_body_pieces *pieces = sunder_i_pieces_of(c->model, body);
    if (!pieces) c->failed = true;
    return pieces;
}

/* Returns how deep the pieces of two bodies are in each other at the relative move u, or how deep an anchor is in a
 * shadow. */
static double find_depth(sunder_i_branching *c, const sunder_i_body *p, const sunder_i_body_piece *a,
                         const sunder_i_body *q, const sunder_i_body_piece *b, double clearance, bool shadow,
                         const double u[2])
{
    size_t n;
    const sunder_i_half_plane *half_plane = sunder_i_branching_kept_half_planes(c, p, a, q, b, clearance, shadow, &n);
    double at = -INFINITY;
    for (size_t k = 0; k < n; k++)
        at = sunder_i_max(at, half_plane[k].n[0] * u[0] + half_plane[k].n[1] * u[1] - half_plane[k].d);
    return n ? -at : -INFINITY;
}

/* Returns how deep the pieces of two bodies are in each other at the relative move u, by half-planes that are made for
 * u. These differ from others only at corners that are nearer than the clearance; so pieces that are apart by more than
 * others lose there are apart by these, too. */
static double find_depth_closely(sunder_i_branching *c, const sunder_i_body *p, const sunder_i_body_piece *a,
                                 const sunder_i_body *q, const sunder_i_body_piece *b, double clearance,
                                 const double u[2])
{
    const uint64_t looked = c->looked;
    const double depth = find_depth(c, p, a, q, b, clearance, false, u);
    if (depth < -SUNDER_I_CORNER_LOSS * sunder_i_max(0, clearance)) return depth;
    c->looked = looked;
    return sunder_i_branching_depth(c, sunder_i_branching_fill_half_planes(c, p, a, q, b, clearance, false, u), u);
}

/* A body and its position. */
typedef struct standing {
    uint32_t number;
    const sunder_i_body *body;
    double t[2];
} standing;

static standing standing_of(const sunder_i_branching *c, uint32_t body)
{
    standing s = {.number = body, .body = &c->model->body[body]};
    const uint32_t at = sunder_i_branching_place(c, body);
    if (at != SUNDER_I_GROUND) memcpy(s.t, c->t + 2 * (size_t)at, sizeof s.t);
    return s;
}

/* Is this clearance to be kept by a slack instead of by each pair of parts? */
static bool has_slack(const sunder_i_branching *c, const sunder_i_body *p, const sunder_i_body *q, double clearance)
{
    return c->subproblem->slack && clearance < 0 &&
           (sunder_i_is_barrier_body(c->model, p) || sunder_i_is_barrier_body(c->model, q));
}

static void look_at(sunder_i_branching *c, const standing *s, const standing *r, sunder_i_violation *worst)
{
    const sunder_i_body *p = s->body, *q = r->body;
    const double u[2] = {r->t[0] - s->t[0], r->t[1] - s->t[1]};
    double box[4], shift[4], clearance = 0;
    for (uint32_t x = 0; x < 4; x++) {
        shift[x] =
            p->origin[x & 1] - q->origin[x & 1] - u[x & 1] + (x < 2 ? -c->model->rules.gap : c->model->rules.gap);
        box[x] = p->box[x] + shift[x];
    }
    c->looked++;
    if (p->pieces == 0 || q->pieces == 0 || !sunder_i_box_meet(box, q->box)) return;
    const sunder_i_body_pieces *of_p = pieces_of(c, p), *of_q = pieces_of(c, q);
    if (!of_p || !of_q) return;
    for (uint32_t k = 0; k < p->pieces; k++) {
        const sunder_i_body_piece *a = &of_p->piece[k];
        for (uint32_t x = 0; x < 4; x++) box[x] = a->box[x] + shift[x];
        c->looked++;
        if (!sunder_i_box_meet(box, q->box)) continue;
        c->looked += q->pieces / 4;
        for (uint32_t l = 0; l < q->pieces; l++) {
            const sunder_i_body_piece *b = &of_q->piece[l];
            if (!sunder_i_box_meet(box, b->box)) continue;
            if (!sunder_i_branching_owe(c, a->feature, b->feature, &clearance)) continue;
            if (has_slack(c, p, q, clearance)) continue;
            const double depth = c->closely ? find_depth_closely(c, p, a, q, b, clearance, u)
                                            : find_depth(c, p, a, q, b, clearance, false, u);
            if (depth > worst->depth)
                *worst = (sunder_i_violation){s->number, r->number, a,          b,     clearance, depth, NULL,
                                              false,     false,     c->closely, false, false,     NULL};
        }
    }
}

/* Tests whether an anchor passed a piece. swapped: the anchor is of r. A deeper violation replaces *worst. */
static void look_at_shadow(sunder_i_branching *c, const standing *s, const standing *r, const double u[2],
                           const sunder_i_body_piece *anchor, const sunder_i_body_piece *piece, bool swapped,
                           sunder_i_violation *worst)
{
    const sunder_i_body_piece *a = swapped ? piece : anchor, *b = swapped ? anchor : piece;
    const double depth = find_depth(c, s->body, a, r->body, b, 0, true, u);
    if (depth > worst->depth)
        *worst =
            (sunder_i_violation){s->number, r->number, a, b, 0, depth, NULL, true, false, false, false, false, NULL};
}

/* Sets u to the move of the barrier, relative to the feature's body, that has to separate the two. */
static void move_of_slack(const sunder_i_branching *c, const sunder_i_requirement *required, const double *t,
                          double u[2])
{
    const uint32_t place = sunder_i_branching_slack(c, required);
    const double *v = place == SUNDER_I_GROUND ? required->shift : c->t + 2 * (size_t)place;
    for (size_t x = 0; x < 2; x++) u[x] = v[x] - t[x];
}

/* Tests whether the slack separates the pieces of feature f from this part of the barrier. */
static void look_at_part(sunder_i_branching *c, const standing *s, uint32_t f, uint32_t part, const double u[2],
                         const sunder_i_requirement *required, sunder_i_violation *worst)
{
    const sunder_i_model *model = c->model;
    const sunder_i_body *p = s->body, *q = &model->body[model->body_of[part]];
    const sunder_i_body_pieces *of_p = pieces_of(c, p), *of_q = pieces_of(c, q);
    if (!of_p || !of_q) return;
    for (uint32_t k = 0; k < p->pieces; k++) {
        const sunder_i_body_piece *a = &of_p->piece[k];
        double box[4];
        for (uint32_t x = 0; x < 4; x++) box[x] = a->box[x] + p->origin[x & 1] - q->origin[x & 1] - u[x & 1];
        c->looked++;
        if (a->feature != f || !sunder_i_box_meet(box, q->box)) continue;
        c->looked += q->pieces / 4;
        for (uint32_t l = 0; l < q->pieces; l++) {
            const sunder_i_body_piece *b = &of_q->piece[l];
            if (!sunder_i_box_meet(box, b->box)) continue;
            const double depth = find_depth(c, p, a, q, b, 0, false, u);
            if (depth > worst->depth)
                *worst = (sunder_i_violation){.p = s->number,
                                              .q = model->body_of[part],
                                              .a = a,
                                              .b = b,
                                              .clearance = required->clearance,
                                              .depth = depth,
                                              .slack = required,
                                              .known = true};
        }
    }
}

/* Tests a feature and a barrier with which it may keep an overlap. */
static void look_at_slack(sunder_i_branching *c, const standing *s, const sunder_i_requirement *required,
                          sunder_i_violation *worst)
{
    const sunder_i_model *model = c->model;
    const uint32_t f = required->a,
                   end = (uint32_t)model->features + model->barriers->part_end[sunder_i_barrier_of(model, required->b)];
    double u[2], box[4], clearance;
    if (!model->present[f] || !sunder_i_branching_owe(c, f, required->b, &clearance) || !(clearance < 0)) return;
    move_of_slack(c, required, s->t, u);
    for (uint32_t x = 0; x < 4; x++) box[x] = sunder_i_home_box(model, f)[x] - u[x & 1];
    c->looked += LOOK_WORK;
    c->near.n = 0;
    if (!sunder_i_look_about(model, &model->tree, box, &c->near)) c->failed = true;
    for (size_t k = 0; k < c->near.n && !c->failed; k++)
        if (c->near.item[k] >= required->b && c->near.item[k] < end)
            look_at_part(c, s, f, c->near.item[k], u, required, worst);
}

/* Tests whether anchors of one body jumped over pieces of the other. swapped: the anchors are those of r. */
static void look_past(sunder_i_branching *c, const standing *s, const standing *r, bool swapped,
                      sunder_i_violation *worst)
{
    const sunder_i_model *model = c->model;
    const sunder_i_body *p = s->body, *q = r->body, *of = swapped ? q : p, *other = swapped ? p : q;
    const double u[2] = {r->t[0] - s->t[0], r->t[1] - s->t[1]},
                 offset[2] = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]};
    double half_plane[4];
    sunder_i_shadow_path_box(u, 0, half_plane);
    c->looked++;
    if (!sunder_i_anchors_may_reach(model, p, q, swapped, offset, half_plane)) return;
    const sunder_i_body_pieces *from = pieces_of(c, of), *pieces = pieces_of(c, other);
    if (!from || !pieces) return;
    for (uint32_t m = 0; m < of->members; m++) {
        const uint32_t f = model->member[of->member + m];
        const sunder_i_body_piece *anchor = &from->anchor[m];
        c->looked += 1 + (other->pieces + other->has->diagonal_covers) / 4;
        for (uint32_t l = 0; l < other->pieces + other->has->diagonal_covers && anchor->corners; l++) {
            const sunder_i_body_piece *piece =
                l < other->pieces ? &pieces->piece[l]
                                  : &model->diagonal_cover[other->has->diagonal_cover + l - other->pieces];
            if (sunder_i_shadow_may_reach((swapped ? piece : anchor)->box, (swapped ? anchor : piece)->box, offset,
                                          half_plane) &&
                sunder_i_branching_shades(c, f, piece->feature))
                look_at_shadow(c, s, r, u, anchor, piece, swapped, worst);
        }
    }
}

/* Tests whether side anchors of one body crossed sides of the other, a part of a barrier. swapped: the part is s. */
static void look_across(sunder_i_branching *c, const standing *s, const standing *r, bool swapped,
                        sunder_i_violation *worst)
{
    const sunder_i_model *model = c->model;
    const sunder_i_body *p = s->body, *q = r->body, *of = swapped ? q : p, *part = swapped ? p : q;
    const double u[2] = {r->t[0] - s->t[0], r->t[1] - s->t[1]},
                 offset[2] = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]};
    double half_plane[4];
    sunder_i_shadow_path_box(u, 0, half_plane);
    c->looked++;
    if (!sunder_i_shadow_may_reach(swapped ? p->box : sunder_i_side_anchors(model, p),
                                   swapped ? sunder_i_side_anchors(model, q) : q->box, offset, half_plane))
        return;
    for (uint32_t m = 0; m < of->members; m++) {
        const uint32_t f = model->member[of->member + m];
        const sunder_i_body_piece *anchor = &model->side_anchor[f];
        c->looked += 1 + part->has->sides / 4;
        for (uint32_t l = part->has->side; l < part->has->side + part->has->sides && anchor->corners; l++) {
            const sunder_i_side *side = &model->side[l];
            if (sunder_i_shadow_may_reach((swapped ? &side->piece : anchor)->box,
                                          (swapped ? anchor : &side->piece)->box, offset, half_plane) &&
                sunder_i_branching_shades(c, f, side->piece.feature) && sunder_i_side_faces(model, side, f))
                look_at_shadow(c, s, r, u, anchor, &side->piece, swapped, worst);
        }
    }
}

static void look_at_all(sunder_i_branching *c, const standing *s, const standing *r, sunder_i_violation *worst)
{
    look_at(c, s, r, worst);
    if (c->subproblem->ignore_paths) return;
    if (s->body->has->sides || r->body->has->sides) look_across(c, s, r, s->body->has->sides > 0, worst);
    if (c->model->rules.jumps || c->subproblem->any_jump || sunder_i_is_barrier_body(c->model, s->body) ||
        sunder_i_is_barrier_body(c->model, r->body))
        return;
    look_past(c, s, r, false, worst);
    look_past(c, s, r, true, worst);
}

/* Sets c->near to the bodies, ascending, that a member of this one may meet. */
static bool find_near(sunder_i_branching *c, const standing *s)
{
    const sunder_i_model *model = c->model;
    c->near.n = 0;
    for (uint32_t m = 0; m < s->body->members; m++) {
        const uint32_t f = model->member[s->body->member + m];
        double box[4], grown[4];
        if (!model->present[f]) continue;
        for (uint32_t x = 0; x < 4; x++) box[x] = sunder_i_home_box(model, f)[x] + s->t[x & 1];
        if (sunder_i_forbids_paths(model))
            sunder_i_box_join(box, sunder_i_home_box(model, f)); /* what it passed on its path counts, too */
        sunder_i_box_grow(box, model->rules.gap, grown);
        c->looked += LOOK_WORK;
        if (!sunder_i_look_about(model, &model->tree, grown, &c->near)) return false;
    }
    sunder_i_things_to_bodies(model, &c->near);
    return true;
}

/* Violations that add no participant come first, so that small sets are settled before they grow; then the deeper
 * one. */
static bool comes_before(const sunder_i_violation *o, const sunder_i_violation *than)
{
    return o->known != than->known ? o->known : o->depth > than->depth;
}

static size_t insert_violation(sunder_i_violation deepest[SUNDER_I_CHOICES], size_t n, const sunder_i_violation *o)
{
    if (!o->a || (n == SUNDER_I_CHOICES && !comes_before(o, &deepest[n - 1]))) return n;
    size_t k = n < SUNDER_I_CHOICES ? n++ : n - 1;
    for (; k > 0 && comes_before(o, &deepest[k - 1]); k--) deepest[k] = deepest[k - 1];
    deepest[k] = *o;
    return n;
}

/* Tests the slacks of a body's members, and returns the new number of violations. */
static size_t look_at_slacks(sunder_i_branching *c, const standing *s, sunder_i_violation deepest[SUNDER_I_CHOICES],
                             size_t n)
{
    const sunder_i_subproblem *q = c->subproblem;
    for (uint32_t m = 0; m < s->body->members && q->slack; m++) {
        const uint32_t f = c->model->member[s->body->member + m];
        const sunder_i_requirement key = {.a = f, .b = (uint32_t)c->model->features};
        for (size_t k = sunder_i_lower_bound(&key, q->required, q->required_n, sizeof key, sunder_i_by_id_pair);
             k < q->required_n && q->required[k].a == f && !c->failed; k++) {
            sunder_i_violation o = {.depth = 2 * c->hair};
            if (q->required[k].clearance < 0 && q->required[k].clearance > -INFINITY)
                look_at_slack(c, s, &q->required[k], &o);
            n = insert_violation(deepest, n, &o);
        }
    }
    return n;
}

/* Tests the rule of rows of a body and its neighbours, for two participants once, and returns the new number of
 * violations. */
static size_t look_along_row(sunder_i_branching *c, const standing *s, uint32_t place,
                             sunder_i_violation deepest[SUNDER_I_CHOICES], size_t n)
{
    const sunder_i_extras *has = s->body->has;
    for (uint32_t k = has->row_side; k < has->row_side + has->row_sides && c->subproblem->rows; k++) {
        const uint32_t other = c->model->row_side[k].other, at = sunder_i_branching_place(c, other);
        if (at != SUNDER_I_GROUND && at < place) continue;
        const standing r = standing_of(c, other);
        const double u[2] = {r.t[0] - s->t[0], r.t[1] - s->t[1]};
        sunder_i_violation o;
        c->looked++;
        if (!sunder_i_branching_misses_row(c, s->number, other, u, &o)) continue;
        o.known = at != SUNDER_I_GROUND || !(sunder_i_limit_of(r.body) > 0);
        n = insert_violation(deepest, n, &o);
    }
    return n;
}

size_t sunder_i_branching_violations(sunder_i_branching *branching, sunder_i_violation deepest[SUNDER_I_CHOICES])
{
    size_t n = 0;
    for (uint32_t i = 0; i < branching->bodies; i++) {
        if (branching->body[i] == SUNDER_I_NOBODY) continue;
        const standing s = standing_of(branching, branching->body[i]);
        n = look_at_slacks(branching, &s, deepest, n);
        n = look_along_row(branching, &s, i, deepest, n);
        for (uint32_t j = i + 1; j < branching->bodies; j++) {
            if (branching->body[j] == SUNDER_I_NOBODY) continue;
            sunder_i_violation o = {.depth = 2 * branching->hair};
            const standing r = standing_of(branching, branching->body[j]);
            look_at_all(branching, &s, &r, &o);
            o.known = true;
            n = insert_violation(deepest, n, &o);
        }
        /* All other bodies are at their original positions. */
        if (!find_near(branching, &s)) branching->failed = true;
        for (size_t k = 0; k < branching->near.n && !branching->failed; k++) {
            sunder_i_violation o = {.depth = 2 * branching->hair};
            if (sunder_i_branching_place(branching, branching->near.item[k]) != SUNDER_I_GROUND) continue;
            const standing r = standing_of(branching, branching->near.item[k]);
            look_at_all(branching, &s, &r, &o);
            o.known = !(sunder_i_limit_of(r.body) > 0);
            n = insert_violation(deepest, n, &o);
        }
    }
    return n;
}

static int by_nearness(const void *a, const void *b)
{
    const sunder_i_half_plane *p = a, *q = b;
    if (p->at != q->at) return p->at < q->at ? 1 : -1;
    return p->n[0] != q->n[0] ? (p->n[0] < q->n[0] ? 1 : -1) : (p->n[1] < q->n[1]) - (p->n[1] > q->n[1]);
}

size_t sunder_i_branching_half_planes(sunder_i_branching *branching, const sunder_i_violation *violation)
{
    const standing s = standing_of(branching, violation->p), r = standing_of(branching, violation->q);
    double u[2] = {r.t[0] - s.t[0], r.t[1] - s.t[1]};
    if (violation->slack) move_of_slack(branching, violation->slack, s.t, u);
    const double clearance = violation->slack ? 0 : violation->clearance;
    size_t n;
    if (violation->row)
        n = sunder_i_branching_row_half_plane(branching, violation->p, violation->q);
    else if (violation->chord)
        n = sunder_i_branching_chord_half_planes(branching, s.body, violation->a, r.body, violation->chord->at);
    else if (violation->closely)
        n = sunder_i_branching_fill_half_planes(branching, s.body, violation->a, r.body, violation->b, clearance,
                                                violation->shadow, u);
    else
        n = sunder_i_branching_take_half_planes(branching, s.body, violation->a, r.body, violation->b, clearance,
                                                violation->shadow);
    if (branching->subproblem->near && !violation->slack)
        for (size_t x = 0; x < 2; x++)
            u[x] = branching->subproblem->near[2 * (size_t)violation->q + x] -
                   branching->subproblem->near[2 * (size_t)violation->p + x];
    sunder_i_branching_depth(branching, n, u);
    if (n) qsort(branching->scratch, n, sizeof *branching->scratch, by_nearness);
    return n;
}
