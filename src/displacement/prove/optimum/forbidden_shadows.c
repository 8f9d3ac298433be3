/* The pieces of a forbidden set that forbid jumps: shadows of pieces from anchors, and of sides of barriers from side
 * anchors. */
#include "displacement/geometry/obstacle_shadow.h"
#include "displacement/layer/sides.h"
#include "displacement/prove/optimum/forbidden_listing.h"

#include "base/extremes.h"

bool sunder_i_listing_add_shadow(sunder_i_listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b)
{
    sunder_i_forbidden *f = l->out;
    const double home[2] = {0, 0};
    sunder_i_forbidden_piece piece;
    size_t n;
    if (!sunder_i_listing_begin_piece(l, a, b, &piece, &n)) return false;
    const double off = piece.vague;
    const double distance = piece.edges > 1 ? sunder_i_forbidden_distance(f, &piece, home) : 0;
    if (!(distance > 4 * off) || distance > l->reach) return true;
    const double far = 1 + 2 * l->reach / distance;
    if (!sunder_i_reserve(&l->drawn, &l->drawn_capacity, 4 * n + 2, sizeof *l->drawn)) return false;
    double *xy = l->drawn;
    for (size_t k = 0; k < 2 * n; k++) {
        xy[k] = l->scratch.xy[k];
        xy[2 * n + k] = far * l->scratch.xy[k];
    }
    if (!sunder_i_reserve(&l->hull, &l->hull_capacity, 4 * n + 2, sizeof *l->hull)) return false;
    const size_t corners = sunder_i_convex_hull(xy, 2 * n, l->hull);
    if (!sunder_i_listing_set_edges(f, &piece, l->hull, corners)) return false;
    piece.vague = 2 * far * off;
    piece.shadow = true;
    sunder_i_listing_keep(f, &piece, l->hull, corners);
    return true;
}

/* May the piece cast a shadow from the anchor that is within reach? Decided by their boxes. swapped: the anchor is of
 * the second body. */
static bool may_cast(const sunder_i_listing *l, const sunder_i_body_piece *anchor, const sunder_i_body_piece *piece,
                     bool swapped)
{
    const double *w = l->window,
                 path[4] = {sunder_i_min(0, w[0]), sunder_i_min(0, w[1]), sunder_i_max(0, w[2]), sunder_i_max(0, w[3])};
    return swapped ? sunder_i_shadow_may_reach(piece->box, anchor->box, l->offset, path)
                   : sunder_i_shadow_may_reach(anchor->box, piece->box, l->offset, path);
}

/* Adds the shadow of one piece from the anchor, unless the piece's feature contains the anchor. */
static bool add_shadow_of(sunder_i_listing *l, const sunder_i_body_piece *anchor, const sunder_i_body_piece *piece,
                          bool swapped)
{
    if (!may_cast(l, anchor, piece, swapped) || sunder_i_may_pass(l->model, anchor->feature, piece->feature))
        return true;
    return sunder_i_listing_add_shadow(l, swapped ? piece : anchor, swapped ? anchor : piece);
}

/* Adds the shadows of the covers of diagonals and of shared walls of `other` from the anchor. */
static bool add_diagonal_covers(sunder_i_listing *l, const sunder_i_body_piece *anchor, const sunder_i_body *other,
                                bool swapped)
{
    const sunder_i_model *model = l->model;
    for (uint32_t k = other->has->diagonal_cover; k < other->has->diagonal_cover + other->has->diagonal_covers; k++)
        if (!add_shadow_of(l, anchor, &model->diagonal_cover[k], swapped)) return false;
    for (uint32_t k = other->has->wall_cover; k < other->has->wall_cover + other->has->wall_covers; k++)
        if (!sunder_i_may_pass(model, anchor->feature, model->wall_cover[k].other) &&
            !add_shadow_of(l, anchor, &model->wall_cover[k].piece, swapped))
            return false;
    return true;
}

bool sunder_i_listing_add_shadows(sunder_i_listing *l, const sunder_i_body *p, const sunder_i_body *other, bool swapped)
{
    const sunder_i_model *model = l->model;
    const sunder_i_body_pieces *from = swapped ? l->of_q : l->of_p, *of = swapped ? l->of_p : l->of_q;
    const bool counts = l->diagonal_covers || (l->waived->covered && l->waived->covered[other - model->body]);
    if (sunder_i_is_barrier_body(model, other)) return true;
    for (uint32_t m = 0; m < p->members && !sunder_i_listing_is_full(l); m++) {
        const sunder_i_body_piece *anchor = &from->anchor[m];
        if (!anchor->corners) continue;
        for (uint32_t k = 0; k < other->pieces; k++)
            if (!add_shadow_of(l, anchor, &of->piece[k], swapped)) return false;
        if (counts && !add_diagonal_covers(l, anchor, other, swapped)) return false;
    }
    return true;
}

bool sunder_i_listing_add_sides(sunder_i_listing *l, const sunder_i_body *p, const sunder_i_body *part, bool swapped)
{
    const sunder_i_model *model = l->model;
    for (uint32_t m = 0; m < p->members && part->has->sides && !sunder_i_listing_is_full(l); m++) {
        const uint32_t f = model->member[p->member + m];
        const sunder_i_body_piece *anchor = &model->side_anchor[f];
        if (!anchor->corners) continue;
        for (uint32_t k = part->has->side; k < part->has->side + part->has->sides; k++) {
            const sunder_i_side *side = &model->side[k];
            if (may_cast(l, anchor, &side->piece, swapped) && sunder_i_side_faces(model, side, f) &&
                !sunder_i_listing_add_shadow(l, swapped ? &side->piece : anchor, swapped ? anchor : &side->piece))
                return false;
        }
    }
    return true;
}
