/* The forbidden set of a pair, as a union of convex pieces.
 *
 * If convex pieces A and B of two bodies have to keep the distance g from each other, the relative move u may not be in
 * the open set (A + (-B)) grown by the disc of radius g. So the forbidden set of two bodies is a union of such pieces,
 * with arcs at the corners. A listed pair (left in conflict) must be no nearer than at the start. If it still overlaps,
 * as at the start, some translation no longer than the one that separated it at the start must make it disjoint: u may
 * not be a point such that the disc of that radius around it lies in the union of the pair's open pieces, in particular
 * in one of them. Pairs in which one lies in the other, or could get there, and may overlap it are omitted, which makes
 * the set smaller and a bound at most weaker. Courtyards need no care: the pieces of a feature cover the feature and
 * nothing else. Shadows of features that anchors may not pass, and of lines that side anchors may not cross, are
 * further pieces, without exceptions; so is the half-plane of the rule of rows. */
#include "displacement/prove/optimum/forbidden.h"
#include "displacement/geometry/obstacle_shadow.h"
#include "displacement/layer/resolution.h"
#include "displacement/prove/optimum/forbidden_listing.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void sunder_i_forbidden_free(sunder_i_forbidden *forbidden)
{
    sunder_i_free_all(forbidden->piece, forbidden->edge, forbidden->tree.box);
    for (sunder_i_chord_piece *chord = forbidden->chord, *next; chord; chord = next) {
        next = chord->next;
        sunder_i_free(chord);
    }
    *forbidden = (sunder_i_forbidden){0};
}

const sunder_i_waiver *sunder_i_waiver_of(const sunder_i_model *model, const sunder_i_waived *waived, uint32_t a,
                                          uint32_t b)
{
    const uint32_t f = sunder_i_whole_of(model, a), g = sunder_i_whole_of(model, b);
    const sunder_i_waiver key = {.a = f < g ? f : g, .b = f < g ? g : f};
    return waived->n ? bsearch(&key, waived->pair, waived->n, sizeof key, sunder_i_by_id_pair) : NULL;
}

/* Do the things f and g have to keep a distance from each other? *waiver is set to the pair's waiver, or NULL. */
static bool owe_distance(const sunder_i_listing *l, uint32_t f, uint32_t g, const sunder_i_waiver **waiver)
{
    *waiver = sunder_i_waiver_of(l->model, l->waived, f, g);
    if (*waiver && sunder_i_waiver_clearance(*waiver) == -INFINITY) return false;
    if (sunder_i_is_barrier(l->model, f) || sunder_i_is_barrier(l->model, g)) return true;
    return !sunder_i_may_get_inside(&l->model->rules, sunder_i_home_box(l->model, f), sunder_i_home_box(l->model, g),
                                    nextafter(l->reach, INFINITY));
}

/* Has the pair of pieces a price? With a least gap every pair may have one. Two pieces without area have none: they are
 * not deep in each other where they cross. */
static bool has_price(const sunder_i_listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
                      const sunder_i_waiver *waiver)
{
    const uint32_t f = a->feature, g = b->feature;
    return (waiver || sunder_i_has_slack(l->model)) && (a->corners > 2 || b->corners > 2) &&
           !sunder_i_is_crossed(l->model, f, g) &&
           (sunder_i_is_barrier(l->model, f) || sunder_i_is_barrier(l->model, g) ||
            !sunder_i_is_included(l->model, f < g ? f : g, f < g ? g : f));
}

static bool add_pieces(sunder_i_listing *l)
{
    const double gap = l->priced ? l->model->rules.full_gap : l->model->rules.gap, *w = l->window;
    for (uint32_t k = 0; k < l->p->pieces && !sunder_i_listing_is_full(l); k++) {
        const sunder_i_body_piece *a = &l->of_p->piece[k];
        const double box[4] = {a->box[0] - l->offset[0] - w[2] - gap, a->box[1] - l->offset[1] - w[3] - gap,
                               a->box[2] - l->offset[0] - w[0] + gap, a->box[3] - l->offset[1] - w[1] + gap};
        if (!sunder_i_steps(1 + l->q->pieces / 8)) return false;
        if (!sunder_i_box_meet(box, l->q->box)) continue;
        for (uint32_t m = 0; m < l->q->pieces; m++) {
            const sunder_i_body_piece *b = &l->of_q->piece[m];
            const sunder_i_waiver *waiver;
            if (!sunder_i_box_meet(box, b->box) || !owe_distance(l, a->feature, b->feature, &waiver)) continue;
            if (l->priced && !has_price(l, a, b, waiver)) continue;
            if (!sunder_i_listing_add_piece(l, a, b, waiver)) return false;
        }
    }
    return true;
}

/* Can a piece of `other` lie on a diagonal between pieces of `of`? It can if it is a barrier without area that is owed
 * no distance. */
static bool hides_in_diagonals(const sunder_i_listing *l, const sunder_i_body *of, const sunder_i_body *other)
{
    const uint32_t part = l->model->member[other->member];
    return of->has->diagonal_covers && sunder_i_is_barrier(l->model, part) &&
           sunder_i_required_least(l->model->barriers, sunder_i_barrier_of(l->model, part)) == 0;
}

/* Adds the pieces made of the covers of diagonals of `of` and pieces of `other` without area. swapped: `of` is the
 * second body of the pair. Returns false if memory is out. */
static bool add_covers(sunder_i_listing *l, const sunder_i_body *of, const sunder_i_body *other, bool swapped)
{
    const sunder_i_model *model = l->model;
    const sunder_i_body_pieces *pieces = swapped ? l->of_p : l->of_q;
    const double sign = swapped ? 1 : -1;
    if (!hides_in_diagonals(l, of, other)) return true;
    for (uint32_t k = of->has->diagonal_cover;
         k < of->has->diagonal_cover + of->has->diagonal_covers && !sunder_i_listing_is_full(l); k++) {
        const sunder_i_body_piece *diagonal_cover = &model->diagonal_cover[k];
        double box[4];
        for (uint32_t c = 0; c < 4; c++)
            box[c] = diagonal_cover->box[c] + sign * l->offset[c & 1] + (c < 2 ? -l->reach : l->reach);
        for (uint32_t m = 0; m < other->pieces; m++) {
            const sunder_i_body_piece *flat = &pieces->piece[m];
            const sunder_i_waiver *waiver;
            if (flat->corners > 2 || !sunder_i_box_meet(box, flat->box)) continue;
            if (!owe_distance(l, diagonal_cover->feature, flat->feature, &waiver)) continue;
            if (!sunder_i_listing_add_piece(l, swapped ? flat : diagonal_cover, swapped ? diagonal_cover : flat,
                                            waiver))
                return false;
        }
    }
    return true;
}

/* Adds the priced pieces made of the covers of diagonals of `of` and all pieces of `other`: pieces of a feature that
 * only touch leave a gap without width. swapped: `of` is the second body of the pair. Returns false if memory is out.
 */
static bool add_priced_covers(sunder_i_listing *l, const sunder_i_body *of, const sunder_i_body *other, bool swapped)
{
    const sunder_i_body_pieces *pieces = swapped ? l->of_p : l->of_q;
    const uint32_t end = of->has->diagonal_cover + of->has->diagonal_covers;
    for (uint32_t k = of->has->diagonal_cover; k < end && !sunder_i_listing_is_full(l); k++) {
        const sunder_i_body_piece *cover = &l->model->diagonal_cover[k];
        for (uint32_t m = 0; m < other->pieces; m++) {
            const sunder_i_body_piece *piece = &pieces->piece[m];
            const sunder_i_waiver *waiver;
            if (!owe_distance(l, cover->feature, piece->feature, &waiver) || !has_price(l, cover, piece, waiver))
                continue;
            if (!sunder_i_listing_add_piece(l, swapped ? piece : cover, swapped ? cover : piece, waiver)) return false;
        }
    }
    return true;
}

/* Does the report list a pair of members of the two bodies as remaining in conflict? */
static bool is_any_waived(const sunder_i_listing *l)
{
    const uint32_t *member = l->model->member;
    for (uint32_t k = l->p->member; k < l->p->member + l->p->members && l->waived->n; k++)
        for (uint32_t m = l->q->member; m < l->q->member + l->q->members; m++)
            if (sunder_i_waiver_of(l->model, l->waived, member[k], member[m])) return true;
    return false;
}

/* Adds the half-plane that the rule of rows forbids to neighbours in a row, or with a least gap the one where they lack
 * some of it (l->priced), as far as it is within reach. It is exact but for the rounding of its corners. Returns false
 * if memory is out. */
static bool add_row(sunder_i_listing *l)
{
    sunder_i_forbidden *f = l->out;
    const sunder_i_row_side *side =
        l->p->has->row_sides ? sunder_i_row_side_of(l->model, l->p, (uint32_t)(l->q - l->model->body)) : NULL;
    if (!side || side->least == -INFINITY || (l->priced && !sunder_i_has_slack(l->model))) return true;
    const double least = l->priced ? side->full : is_any_waived(l) ? side->least_listed : side->least;
    if (least == -INFINITY) return true;
    const sunder_i_obstacle_edge edge = {
        {least * side->along[0], least * side->along[1]}, {side->along[0], side->along[1]}, INFINITY};
    double corner[8];
    const size_t n = sunder_i_half_plane_corners(&edge, 2 * l->reach, corner);
    sunder_i_forbidden_piece piece = {.edge = (uint32_t)f->edges,
                                      .a = l->of_p->piece,
                                      .b = l->of_q->piece,
                                      .shadow = true,
                                      .row = true,
                                      .priced = l->priced,
                                      .clearance = NAN,
                                      .vague = 0x1p-48 * (4 * l->reach + fabs(least))};
    if (!sunder_i_reserve(&f->piece, &f->piece_capacity, f->pieces + 1, sizeof *f->piece) ||
        !sunder_i_listing_set_edges(f, &piece, corner, n))
        return false;
    sunder_i_listing_keep(f, &piece, corner, n);
    return true;
}

static bool add_all(sunder_i_listing *l)
{
    if (!add_row(l)) return false;
    if (l->no_paths) return add_pieces(l);
    if (!add_pieces(l) || !add_covers(l, l->p, l->q, false) || !add_covers(l, l->q, l->p, true)) return false;
    if (!sunder_i_listing_add_sides(l, l->p, l->q, false) || !sunder_i_listing_add_sides(l, l->q, l->p, true))
        return false;
    return l->model->rules.jumps ||
           (sunder_i_listing_add_shadows(l, l->p, l->q, false) && sunder_i_listing_add_shadows(l, l->q, l->p, true));
}

static bool add_all_priced(sunder_i_listing *l)
{
    return add_row(l) && add_pieces(l) && add_priced_covers(l, l->p, l->q, false) &&
           add_priced_covers(l, l->q, l->p, true);
}

static void set_bodies(sunder_i_listing *l, uint32_t p, uint32_t q)
{
    l->p = &l->model->body[p];
    l->q = &l->model->body[q];
    for (size_t c = 0; c < 2; c++) l->offset[c] = l->q->origin[c] - l->p->origin[c];
}

/* Sets up the listing for two bodies. Returns false if memory is out. */
static bool begin_pair(sunder_i_listing *l, uint32_t p, uint32_t q)
{
    set_bodies(l, p, q);
    for (size_t c = 0; c < 4; c++) l->window[c] = c < 2 ? -l->reach : l->reach;
    l->of_p = sunder_i_pieces_of(l->model, l->p);
    l->of_q = sunder_i_pieces_of(l->model, l->q);
    return l->of_p && l->of_q;
}

static bool begin_listing(sunder_i_listing *l, uint32_t p, uint32_t q)
{
    *l->out = (sunder_i_forbidden){0};
    return begin_pair(l, p, q);
}

static void end_listing(sunder_i_listing *l, double reach)
{
    sunder_i_forbidden *f = l->out;
    sunder_i_free_all(l->scratch.xy, l->drawn, l->hull);
    f->size = sunder_i_max(f->size, 2 * reach);
    for (size_t k = 0; k < f->pieces; k++)
        for (size_t c = 0; c < 4; c++) f->size = sunder_i_max(f->size, fabs(f->piece[k].box[c]));
    f->grain = 0x1p-46 * f->size;
}

/* Lists all pieces within reach. If there are too many, the reach is halved until there are not, or until it is at most
 * the gap. */
static bool list_within(sunder_i_listing *l, uint32_t p, uint32_t q)
{
    const double reach = l->reach;
    bool ok = begin_listing(l, p, q) && add_all(l);
    while (ok && sunder_i_listing_is_full(l) && l->reach > l->model->rules.gap) {
        l->out->pieces = l->out->edges = 0;
        l->reach /= 2;
        for (size_t c = 0; c < 4; c++) l->window[c] /= 2;
        ok = add_all(l);
    }
    end_listing(l, reach);
    return ok;
}

bool sunder_i_forbidden_init(sunder_i_forbidden *forbidden, const sunder_i_model *model, const sunder_i_waived *waived,
                             uint32_t p, uint32_t q, double reach)
{
    sunder_i_listing l = {.out = forbidden, .model = model, .waived = waived, .reach = reach, .most = MOST_PIECES};
    return list_within(&l, p, q);
}

bool sunder_i_forbidden_priced(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                               const sunder_i_waived *waived, uint32_t p, const uint32_t *q, size_t n, double reach,
                               bool prices)
{
    sunder_i_listing l = {.out = forbidden, .model = model, .waived = waived, .reach = reach, .most = MOST_PIECES};
    bool ok = true;
    *forbidden = (sunder_i_forbidden){0};
    for (int priced = prices; priced >= 0; priced--)
        for (size_t k = 0; k < n && ok; k++) {
            l.priced = priced;
            ok = begin_pair(&l, p, q[k]) && (priced ? add_all_priced(&l) : add_all(&l));
        }
    end_listing(&l, reach);
    return ok;
}

bool sunder_i_forbidden_add_joined(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                                   const sunder_i_joined *joined)
{
    sunder_i_forbidden_piece piece = {.edge = (uint32_t)forbidden->edges, .priced = true, .joined = true};
    for (size_t k = 0; k < forbidden->pieces && !piece.a; k++) {
        const sunder_i_forbidden_piece *p = &forbidden->piece[k];
        if (!p->priced || p->row || sunder_i_whole_of(model, p->a->feature) != joined->f ||
            sunder_i_whole_of(model, p->b->feature) != joined->g)
            continue;
        piece.a = p->a;
        piece.b = p->b;
        piece.radius = p->radius;
    }
    piece.clearance = NAN;
    piece.vague = joined->blur + forbidden->grain;
    if (!piece.a) return true;
    if (!sunder_i_reserve(&forbidden->piece, &forbidden->piece_capacity, forbidden->pieces + 1, sizeof piece) ||
        !sunder_i_listing_set_edges(forbidden, &piece, joined->corner, joined->corners))
        return false;
    sunder_i_listing_keep(forbidden, &piece, joined->corner, joined->corners);
    return true;
}

bool sunder_i_forbidden_without_paths(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                                      const sunder_i_waived *waived, uint32_t p, uint32_t q, double reach)
{
    sunder_i_listing l = {
        .out = forbidden, .model = model, .waived = waived, .reach = reach, .most = MOST_PIECES, .no_paths = true};
    return list_within(&l, p, q);
}

bool sunder_i_forbidden_init_near(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                                  const sunder_i_waived *waived, uint32_t p, uint32_t q, const double u[2], double hair)
{
    sunder_i_listing l = {.out = forbidden, .model = model, .waived = waived, .most = SIZE_MAX};
    l.reach = fabs(u[0]) + fabs(u[1]) + hair;
    const bool begun = begin_listing(&l, p, q);
    for (size_t c = 0; c < 4; c++) l.window[c] = u[c & 1] + (c < 2 ? -hair : hair);
    const bool ok = begun && add_all(&l);
    end_listing(&l, l.reach);
    return ok;
}

bool sunder_i_forbidden_with_covers(sunder_i_forbidden *forbidden, const sunder_i_model *model, uint32_t p, uint32_t q,
                                    double reach, size_t most)
{
    const sunder_i_waived none = {0};
    sunder_i_listing l = {
        .out = forbidden, .model = model, .waived = &none, .reach = reach, .most = most, .diagonal_covers = true};
    const bool ok = begin_listing(&l, p, q) && add_all(&l);
    end_listing(&l, reach);
    return ok;
}

bool sunder_i_forbidden_add_shadow(sunder_i_forbidden *forbidden, const sunder_i_model *model, uint32_t p, uint32_t q,
                                   double reach, const sunder_i_body_piece *a, const sunder_i_body_piece *b)
{
    sunder_i_listing l = {.out = forbidden, .model = model, .reach = reach};
    set_bodies(&l, p, q);
    const bool ok = sunder_i_listing_add_shadow(&l, a, b);
    end_listing(&l, reach);
    return ok;
}

bool sunder_i_forbidden_add_chord(sunder_i_forbidden *forbidden, const sunder_i_model *model, uint32_t mover,
                                  uint32_t part, bool swapped, double reach, const sunder_i_body_piece *anchor,
                                  const double at[4], const uint32_t side[2])
{
    const sunder_i_body *body = &model->body[part];
    const size_t before = forbidden->pieces;
    sunder_i_chord_piece *made = sunder_i_calloc(1, sizeof *made);
    if (!made) return false;
    made->piece = (sunder_i_body_piece){.corner = made->corner, .corners = 2, .feature = model->member[body->member]};
    for (size_t k = 0; k < 4; k++) made->corner[k] = at[k] - body->origin[k & 1];
    sunder_i_box_of_segment(made->corner, made->corner + 2, made->piece.box);
    made->next = forbidden->chord;
    forbidden->chord = made;
    const bool ok = swapped ? sunder_i_forbidden_add_shadow(forbidden, model, part, mover, reach, &made->piece, anchor)
                            : sunder_i_forbidden_add_shadow(forbidden, model, mover, part, reach, anchor, &made->piece);
    if (ok && forbidden->pieces > before) memcpy(forbidden->piece[before].side, side, 2 * sizeof *side);
    return ok;
}
