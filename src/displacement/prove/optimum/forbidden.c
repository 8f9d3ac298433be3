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
 * further pieces, without exceptions; so is the half-plane of the rule of rows.
 *
 * Rounding errors, with e = 2^-53: a corner less its origin has an error of e of itself (2^-52 of the coordinates if
 * the shape is rational, as its corners are rounded to doubles), and a - b - offset takes two more roundings. So 8 e S
 * = 2^-50 S suffices for a corner, where S is the sum over both coordinates of the greatest |a| + |b| + |offset|. So
 * every corner of K is that near to the difference of a corner of A and one of B, in whatever order edges were merged:
 * K lies in the true polygon grown by that. By the cancellation law for convex sets, a point that lies in K at least
 * that deep, or whose distance from K is less than the radius by at least that much, is in the true piece. */
#include "displacement/prove/optimum/forbidden.h"
#include "displacement/geometry/obstacle_shadow.h"
#include "displacement/layer/resolution.h"
#include "displacement/layer/sides.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "shape/shape.h"

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

typedef struct listing {
    sunder_i_forbidden *out;
    const sunder_i_model *model;
    const sunder_i_waived *waived;
    const sunder_i_body *p, *q;
    const sunder_i_body_pieces *of_p, *of_q;
    double offset[2], reach;
    double window[4]; /* the relative moves u that matter */
    size_t most;      /* the greatest number of pieces */
    bool diagonal_covers, no_paths;
    bool priced; /* priced pieces are listed, instead of others */
    sunder_i_scratch scratch;
    double *drawn, *hull; /* scratch for shadows */
    size_t drawn_capacity, hull_capacity;
} listing;

const sunder_i_waiver *sunder_i_waiver_of(const sunder_i_model *model, const sunder_i_waived *waived, uint32_t a,
                                          uint32_t b)
{
    const uint32_t f = sunder_i_whole_of(model, a), g = sunder_i_whole_of(model, b);
    const sunder_i_waiver key = {.a = f < g ? f : g, .b = f < g ? g : f};
    return waived->n ? bsearch(&key, waived->pair, waived->n, sizeof key, sunder_i_by_id_pair) : NULL;
}

/* Do the things f and g have to keep a distance from each other? *waiver is set to the pair's waiver, or NULL. */
static bool owe_distance(const listing *l, uint32_t f, uint32_t g, const sunder_i_waiver **waiver)
{
    *waiver = sunder_i_waiver_of(l->model, l->waived, f, g);
    if (*waiver && sunder_i_waiver_clearance(*waiver) == -INFINITY) return false;
    if (sunder_i_is_barrier(l->model, f) || sunder_i_is_barrier(l->model, g)) return true;
    return !sunder_i_may_get_inside(&l->model->rules, sunder_i_home_box(l->model, f), sunder_i_home_box(l->model, g),
                                    nextafter(l->reach, INFINITY));
}

/* Returns the share of one piece in S: the size of its coordinates; for rational shapes and far corners also that of
 * the coordinates before the origin was subtracted. */
static double size_of(const listing *l, const sunder_i_body *body, const sunder_i_body_piece *piece)
{
    const sunder_shape *shape = sunder_i_thing_shape(l->model, piece->feature);
    const bool vague = body->far || (shape && shape->rational);
    double size = 0;
    for (size_t c = 0; c < 2; c++) {
        size += sunder_i_max(fabs(piece->box[c]), fabs(piece->box[c + 2]));
        if (vague) size += 4 * (fabs(body->origin[c]) + fabs(piece->box[c]) + fabs(piece->box[c + 2]));
    }
    return size;
}

/* Computes K = a + (-B): its corners in l->scratch, *n of them, and its edges after those of the list, which they join
 * if the piece is kept. Returns false if memory is out. */
static bool begin_piece(listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
                        sunder_i_forbidden_piece *piece, size_t *n)
{
    sunder_i_forbidden *f = l->out;
    const size_t most = (size_t)a->corners + b->corners;
    if (!sunder_i_reserve(&f->piece, &f->piece_capacity, f->pieces + 1, sizeof *f->piece) ||
        !sunder_i_reserve(&f->edge, &f->edge_capacity, f->edges + most, sizeof *f->edge) || !sunder_i_steps(1))
        return false;
    *n = sunder_i_obstacle_corners(a->corner, a->corners, b->corner, b->corners, l->offset, &l->scratch);
    if (*n == 0) return false;
    *piece = (sunder_i_forbidden_piece){.edge = (uint32_t)f->edges, .a = a, .b = b, .clearance = NAN};
    piece->edges = (uint32_t)sunder_i_obstacle_edges(l->scratch.xy, *n, f->edge + f->edges);
    piece->vague = 0x1p-50 * (size_of(l, l->p, a) + size_of(l, l->q, b) + fabs(l->offset[0]) + fabs(l->offset[1]));
    return true;
}

/* Finds a disc around the middle of the piece's box that lies in the grown piece. For round symbols it is almost the
 * whole piece. */
static void find_disc_within(const sunder_i_forbidden *f, sunder_i_forbidden_piece *piece)
{
    for (size_t c = 0; c < 2; c++) piece->middle[c] = piece->box[c] / 2 + piece->box[c + 2] / 2;
    double nearest = INFINITY;
    for (uint32_t k = 0; k < piece->edges; k++) {
        const sunder_i_obstacle_edge *e = &f->edge[piece->edge + k];
        const double far = e->n[0] * (e->from[0] - piece->middle[0]) + e->n[1] * (e->from[1] - piece->middle[1]);
        nearest = far < nearest ? far : nearest;
    }
    piece->within = nearest >= 0 ? (nearest + piece->radius) * (1 - WITHIN_HAIR) : 0;
}

static void keep_piece(sunder_i_forbidden *f, sunder_i_forbidden_piece *piece, const double *xy, size_t n)
{
    sunder_i_box_clear(piece->box);
    for (size_t k = 0; k < n; k++) sunder_i_box_include(piece->box, xy + 2 * k);
    sunder_i_box_grow(piece->box, piece->radius, piece->box);
    const uint32_t least = piece->radius > 0 ? 2 : 3; /* with fewer edges the piece has no interior */
    if (piece->edges < least) return;
    find_disc_within(f, piece);
    f->edges += piece->edges;
    f->piece[f->pieces++] = *piece;
}

/* Replaces the edges of the piece by those of the polygon xy. Returns false if memory is out. */
static bool set_edges(sunder_i_forbidden *f, sunder_i_forbidden_piece *piece, const double *xy, size_t n)
{
    if (!sunder_i_reserve(&f->edge, &f->edge_capacity, f->edges + n, sizeof *f->edge)) return false;
    piece->edges = (uint32_t)sunder_i_obstacle_edges(xy, n, f->edge + f->edges);
    return true;
}

/* Clips the convex polygon *in of n corners to the points that are at least `depth` inside of each edge. Returns the
 * number of corners. The result is in *in, since the two buffers are swapped after each edge. */
static size_t move_inwards(const sunder_i_obstacle_edge *edge, size_t edges, double depth, double **in, double **out,
                           size_t n)
{
    for (size_t e = 0; e < edges; e++) {
        const double *p = *in, *from = edge[e].from, *normal = edge[e].n;
        size_t kept = 0;
        for (size_t k = 0; k < n; k++) {
            const double *a = p + 2 * k, *b = p + 2 * (k + 1 < n ? k + 1 : 0);
            const double s = normal[0] * (a[0] - from[0]) + normal[1] * (a[1] - from[1]) + depth,
                         t = normal[0] * (b[0] - from[0]) + normal[1] * (b[1] - from[1]) + depth;
            if (s <= 0) memcpy(*out + 2 * kept++, a, 2 * sizeof *a);
            if ((s <= 0) == (t <= 0)) continue;
            const double share = s / (s - t);
            for (size_t c = 0; c < 2; c++) (*out)[2 * kept + c] = a[c] + share * (b[c] - a[c]);
            kept++;
        }
        double *swap = *in;
        *in = *out;
        *out = swap;
        n = kept;
    }
    return n;
}

/* Adds the set of all u such that the disc of radius `depth` around u lies in the piece with the corners xy: K moved
 * inwards by the radius and by the error of its corners. For each corner of the result it is tested, allowing for
 * rounding, that the disc around it is in K; by the cancellation law the corresponding disc is then in the true piece,
 * and the result has no error. Returns false if memory is out. */
static bool add_eroded(listing *l, sunder_i_forbidden_piece *piece, const double *xy, size_t n, double depth)
{
    sunder_i_forbidden *f = l->out;
    const sunder_i_obstacle_edge *edge = f->edge + piece->edge;
    double size = depth;
    for (size_t k = 0; k < 2 * n; k++) size = sunder_i_max(size, fabs(xy[k]));
    const double least = depth * (1 + 0x1p-50) + piece->vague + 0x1p-48 * size;
    if (!sunder_i_reserve(&l->drawn, &l->drawn_capacity, 4 * n, sizeof *l->drawn) ||
        !sunder_i_reserve(&l->hull, &l->hull_capacity, 4 * n, sizeof *l->hull))
        return false;
    memcpy(l->drawn, xy, 2 * n * sizeof *xy);
    double *corner = l->drawn, *scratch = l->hull;
    const size_t corners = move_inwards(edge, piece->edges, least + 0x1p-48 * size, &corner, &scratch, n);
    for (size_t k = 0; k < corners; k++)
        for (uint32_t e = 0; e < piece->edges; e++)
            if (edge[e].n[0] * (corner[2 * k] - edge[e].from[0]) +
                    edge[e].n[1] * (corner[2 * k + 1] - edge[e].from[1]) >
                -least)
                return true;
    if (corners < 3) return true;
    if (!set_edges(f, piece, corner, corners)) return false;
    piece->vague = 0;
    keep_piece(f, piece, corner, corners);
    return true;
}

static bool add_piece(listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
                      const sunder_i_waiver *waiver)
{
    sunder_i_forbidden_piece piece;
    size_t n;
    if (!begin_piece(l, a, b, &piece, &n)) return false;
    piece.radius = l->priced ? sunder_i_full_below(l->model, a->feature, b->feature)
                             : sunder_i_owed_below(l->model, a->feature, b->feature);
    piece.priced = l->priced;
    if (waiver && !l->priced) {
        piece.radius = sunder_i_min(piece.radius, sunder_i_max(0, sunder_i_waiver_clearance(waiver)));
        piece.clearance = sunder_i_min(piece.radius, sunder_i_waiver_clearance(waiver));
    }
    if (piece.clearance < 0) return add_eroded(l, &piece, l->scratch.xy, n, -piece.clearance);
    keep_piece(l->out, &piece, l->scratch.xy, n);
    return true;
}

/* Has the pair of pieces a price? With a least gap every pair may have one. Two pieces without area have none: they are
 * not deep in each other where they cross. */
static bool has_price(const listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
                      const sunder_i_waiver *waiver)
{
    const uint32_t f = a->feature, g = b->feature;
    return (waiver || sunder_i_has_slack(l->model)) && (a->corners > 2 || b->corners > 2) &&
           (sunder_i_is_barrier(l->model, f) || sunder_i_is_barrier(l->model, g) ||
            !sunder_i_is_included(l->model, f < g ? f : g, f < g ? g : f));
}

static bool is_full(const listing *l) { return l->out->pieces > l->most; }

static bool add_pieces(listing *l)
{
    const double gap = l->priced ? l->model->rules.full_gap : l->model->rules.gap, *w = l->window;
    for (uint32_t k = 0; k < l->p->pieces && !is_full(l); k++) {
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
            if (!add_piece(l, a, b, waiver)) return false;
        }
    }
    return true;
}

/* Can a piece of `other` lie on a diagonal between pieces of `of`? It can if it is a barrier without area that is owed
 * no distance. */
static bool hides_in_diagonals(const listing *l, const sunder_i_body *of, const sunder_i_body *other)
{
    const uint32_t part = l->model->member[other->member];
    return of->has->diagonal_covers && sunder_i_is_barrier(l->model, part) &&
           sunder_i_owed_below(l->model, part, part) == 0;
}

/* Adds the pieces made of the covers of diagonals of `of` and pieces of `other` without area. swapped: `of` is the
 * second body of the pair. Returns false if memory is out. */
static bool add_covers(listing *l, const sunder_i_body *of, const sunder_i_body *other, bool swapped)
{
    const sunder_i_model *model = l->model;
    const sunder_i_body_pieces *pieces = swapped ? l->of_p : l->of_q;
    const double sign = swapped ? 1 : -1;
    if (!hides_in_diagonals(l, of, other)) return true;
    for (uint32_t k = of->has->diagonal_cover; k < of->has->diagonal_cover + of->has->diagonal_covers && !is_full(l);
         k++) {
        const sunder_i_body_piece *diagonal_cover = &model->diagonal_cover[k];
        double box[4];
        for (uint32_t c = 0; c < 4; c++)
            box[c] = diagonal_cover->box[c] + sign * l->offset[c & 1] + (c < 2 ? -l->reach : l->reach);
        for (uint32_t m = 0; m < other->pieces; m++) {
            const sunder_i_body_piece *flat = &pieces->piece[m];
            const sunder_i_waiver *waiver;
            if (flat->corners > 2 || !sunder_i_box_meet(box, flat->box)) continue;
            if (!owe_distance(l, diagonal_cover->feature, flat->feature, &waiver)) continue;
            if (!add_piece(l, swapped ? flat : diagonal_cover, swapped ? diagonal_cover : flat, waiver)) return false;
        }
    }
    return true;
}

/* Adds the priced pieces made of the covers of diagonals of `of` and all pieces of `other`: pieces of a feature that
 * only touch leave a gap without width. swapped: `of` is the second body of the pair. Returns false if memory is out.
 */
static bool add_priced_covers(listing *l, const sunder_i_body *of, const sunder_i_body *other, bool swapped)
{
    const sunder_i_body_pieces *pieces = swapped ? l->of_p : l->of_q;
    const uint32_t end = of->has->diagonal_cover + of->has->diagonal_covers;
    for (uint32_t k = of->has->diagonal_cover; k < end && !is_full(l); k++) {
        const sunder_i_body_piece *cover = &l->model->diagonal_cover[k];
        for (uint32_t m = 0; m < other->pieces; m++) {
            const sunder_i_body_piece *piece = &pieces->piece[m];
            const sunder_i_waiver *waiver;
            if (!owe_distance(l, cover->feature, piece->feature, &waiver) || !has_price(l, cover, piece, waiver))
                continue;
            if (!add_piece(l, swapped ? piece : cover, swapped ? cover : piece, waiver)) return false;
        }
    }
    return true;
}

/* Adds the shadow of K = a + (-B) from u = 0, as far as it is within reach; one of a and b is an anchor. It is the
 * convex hull of K and of K scaled so that it is beyond reach. The hull lies in the shadow, which is convex; the errors
 * of its corners are scaled likewise. If rounding errors could bring K to 0 no shadow is added. Returns false if memory
 * is out. */
static bool add_shadow(listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b)
{
    sunder_i_forbidden *f = l->out;
    const double home[2] = {0, 0};
    sunder_i_forbidden_piece piece;
    size_t n;
    if (!begin_piece(l, a, b, &piece, &n)) return false;
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
    if (!set_edges(f, &piece, l->hull, corners)) return false;
    piece.vague = 2 * far * off;
    piece.shadow = true;
    keep_piece(f, &piece, l->hull, corners);
    return true;
}

/* May the piece cast a shadow from the anchor that is within reach? Decided by their boxes. swapped: the anchor is of
 * the second body. */
static bool may_cast(const listing *l, const sunder_i_body_piece *anchor, const sunder_i_body_piece *piece,
                     bool swapped)
{
    const double *w = l->window,
                 path[4] = {sunder_i_min(0, w[0]), sunder_i_min(0, w[1]), sunder_i_max(0, w[2]), sunder_i_max(0, w[3])};
    return swapped ? sunder_i_shadow_may_reach(piece->box, anchor->box, l->offset, path)
                   : sunder_i_shadow_may_reach(anchor->box, piece->box, l->offset, path);
}

/* Adds the shadow of one piece from the anchor, unless the piece's feature contains the anchor. */
static bool add_shadow_of(listing *l, const sunder_i_body_piece *anchor, const sunder_i_body_piece *piece, bool swapped)
{
    if (!may_cast(l, anchor, piece, swapped) || sunder_i_is_held(l->model, anchor->feature, piece->feature))
        return true;
    return add_shadow(l, swapped ? piece : anchor, swapped ? anchor : piece);
}

/* Adds the shadows of the covers of diagonals and of shared walls of `other` from the anchor. */
static bool add_diagonal_covers(listing *l, const sunder_i_body_piece *anchor, const sunder_i_body *other, bool swapped)
{
    const sunder_i_model *model = l->model;
    for (uint32_t k = other->has->diagonal_cover; k < other->has->diagonal_cover + other->has->diagonal_covers; k++)
        if (!add_shadow_of(l, anchor, &model->diagonal_cover[k], swapped)) return false;
    for (uint32_t k = other->has->wall_cover; k < other->has->wall_cover + other->has->wall_covers; k++)
        if (!sunder_i_is_held(model, anchor->feature, model->wall_cover[k].other) &&
            !add_shadow_of(l, anchor, &model->wall_cover[k].piece, swapped))
            return false;
    return true;
}

/* Adds the shadows of the pieces of `other` from the anchors of `p`. swapped: `p` is the second body of the pair. */
static bool add_shadows_from(listing *l, const sunder_i_body *p, const sunder_i_body *other, bool swapped)
{
    const sunder_i_model *model = l->model;
    const sunder_i_body_pieces *from = swapped ? l->of_q : l->of_p, *of = swapped ? l->of_p : l->of_q;
    const bool counts = l->diagonal_covers || (l->waived->covered && l->waived->covered[other - model->body]);
    if (sunder_i_is_barrier_body(model, other)) return true;
    for (uint32_t m = 0; m < p->members && !is_full(l); m++) {
        const sunder_i_body_piece *anchor = &from->anchor[m];
        if (!anchor->corners) continue;
        for (uint32_t k = 0; k < other->pieces; k++)
            if (!add_shadow_of(l, anchor, &of->piece[k], swapped)) return false;
        if (counts && !add_diagonal_covers(l, anchor, other, swapped)) return false;
    }
    return true;
}

/* Adds the shadows of the sides of `part` from the side anchors of `p`. swapped: `p` is the second body of the pair. */
static bool add_sides(listing *l, const sunder_i_body *p, const sunder_i_body *part, bool swapped)
{
    const sunder_i_model *model = l->model;
    for (uint32_t m = 0; m < p->members && part->has->sides && !is_full(l); m++) {
        const uint32_t f = model->member[p->member + m];
        const sunder_i_body_piece *anchor = &model->side_anchor[f];
        if (!anchor->corners) continue;
        for (uint32_t k = part->has->side; k < part->has->side + part->has->sides; k++) {
            const sunder_i_side *side = &model->side[k];
            if (may_cast(l, anchor, &side->piece, swapped) && sunder_i_side_faces(model, side, f) &&
                !add_shadow(l, swapped ? &side->piece : anchor, swapped ? anchor : &side->piece))
                return false;
        }
    }
    return true;
}

/* Does the report list a pair of members of the two bodies as remaining in conflict? */
static bool is_any_waived(const listing *l)
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
static bool add_row(listing *l)
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
        !set_edges(f, &piece, corner, n))
        return false;
    keep_piece(f, &piece, corner, n);
    return true;
}

static bool add_all(listing *l)
{
    if (!add_row(l)) return false;
    if (l->no_paths) return add_pieces(l);
    if (!add_pieces(l) || !add_covers(l, l->p, l->q, false) || !add_covers(l, l->q, l->p, true)) return false;
    if (!add_sides(l, l->p, l->q, false) || !add_sides(l, l->q, l->p, true)) return false;
    return l->model->rules.jumps || (add_shadows_from(l, l->p, l->q, false) && add_shadows_from(l, l->q, l->p, true));
}

static bool add_all_priced(listing *l)
{
    return add_row(l) && add_pieces(l) && add_priced_covers(l, l->p, l->q, false) &&
           add_priced_covers(l, l->q, l->p, true);
}

static void set_bodies(listing *l, uint32_t p, uint32_t q)
{
    l->p = &l->model->body[p];
    l->q = &l->model->body[q];
    for (size_t c = 0; c < 2; c++) l->offset[c] = l->q->origin[c] - l->p->origin[c];
}

/* Sets up the listing for two bodies. Returns false if memory is out. */
static bool begin_pair(listing *l, uint32_t p, uint32_t q)
{
    set_bodies(l, p, q);
    for (size_t c = 0; c < 4; c++) l->window[c] = c < 2 ? -l->reach : l->reach;
    l->of_p = sunder_i_pieces_of(l->model, l->p);
    l->of_q = sunder_i_pieces_of(l->model, l->q);
    return l->of_p && l->of_q;
}

static bool begin_listing(listing *l, uint32_t p, uint32_t q)
{
    *l->out = (sunder_i_forbidden){0};
    return begin_pair(l, p, q);
}

static void end_listing(listing *l, double reach)
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
static bool list_within(listing *l, uint32_t p, uint32_t q)
{
    const double reach = l->reach;
    bool ok = begin_listing(l, p, q) && add_all(l);
    while (ok && is_full(l) && l->reach > l->model->rules.gap) {
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
    listing l = {.out = forbidden, .model = model, .waived = waived, .reach = reach, .most = MOST_PIECES};
    return list_within(&l, p, q);
}

bool sunder_i_forbidden_priced(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                               const sunder_i_waived *waived, uint32_t p, const uint32_t *q, size_t n, double reach,
                               bool prices)
{
    listing l = {.out = forbidden, .model = model, .waived = waived, .reach = reach, .most = MOST_PIECES};
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
        !set_edges(forbidden, &piece, joined->corner, joined->corners))
        return false;
    keep_piece(forbidden, &piece, joined->corner, joined->corners);
    return true;
}

bool sunder_i_forbidden_without_paths(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                                      const sunder_i_waived *waived, uint32_t p, uint32_t q, double reach)
{
    listing l = {
        .out = forbidden, .model = model, .waived = waived, .reach = reach, .most = MOST_PIECES, .no_paths = true};
    return list_within(&l, p, q);
}

bool sunder_i_forbidden_init_near(sunder_i_forbidden *forbidden, const sunder_i_model *model,
                                  const sunder_i_waived *waived, uint32_t p, uint32_t q, const double u[2], double hair)
{
    listing l = {.out = forbidden, .model = model, .waived = waived, .most = SIZE_MAX};
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
    listing l = {
        .out = forbidden, .model = model, .waived = &none, .reach = reach, .most = most, .diagonal_covers = true};
    const bool ok = begin_listing(&l, p, q) && add_all(&l);
    end_listing(&l, reach);
    return ok;
}

bool sunder_i_forbidden_add_shadow(sunder_i_forbidden *forbidden, const sunder_i_model *model, uint32_t p, uint32_t q,
                                   double reach, const sunder_i_body_piece *a, const sunder_i_body_piece *b)
{
    listing l = {.out = forbidden, .model = model, .reach = reach};
    set_bodies(&l, p, q);
    const bool ok = add_shadow(&l, a, b);
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
