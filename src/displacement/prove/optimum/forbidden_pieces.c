/* The pieces of a forbidden set: what one piece of each of two bodies forbids.
 *
 * Rounding errors, with e = 2^-53: a corner less its origin has an error of e of itself (2^-52 of the coordinates if
 * the shape is rational, as its corners are rounded to doubles), and a - b - offset takes two more roundings. So 8 e S
 * = 2^-50 S suffices for a corner, where S is the sum over both coordinates of the greatest |a| + |b| + |offset|. So
 * every corner of K is that near to the difference of a corner of A and one of B, in whatever order edges were merged:
 * K lies in the true polygon grown by that. By the cancellation law for convex sets, a point that lies in K at least
 * that deep, or whose distance from K is less than the radius by at least that much, is in the true piece. */
#include "displacement/prove/optimum/forbidden_listing.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "shape/shape.h"

#include <math.h>
#include <string.h>

/* Returns the share of one piece in S: the size of its coordinates; for rational shapes and far corners also that of
 * the coordinates before the origin was subtracted. */
static double size_of(const sunder_i_listing *l, const sunder_i_body *body, const sunder_i_body_piece *piece)
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

bool sunder_i_listing_begin_piece(sunder_i_listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
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

void sunder_i_listing_keep(sunder_i_forbidden *f, sunder_i_forbidden_piece *piece, const double *xy, size_t n)
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

bool sunder_i_listing_set_edges(sunder_i_forbidden *f, sunder_i_forbidden_piece *piece, const double *xy, size_t n)
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
static bool add_eroded(sunder_i_listing *l, sunder_i_forbidden_piece *piece, const double *xy, size_t n, double depth)
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
    if (!sunder_i_listing_set_edges(f, piece, corner, corners)) return false;
    piece->vague = 0;
    sunder_i_listing_keep(f, piece, corner, corners);
    return true;
}

bool sunder_i_listing_add_piece(sunder_i_listing *l, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
                                const sunder_i_waiver *waiver)
{
    sunder_i_forbidden_piece piece;
    size_t n;
    if (!sunder_i_listing_begin_piece(l, a, b, &piece, &n)) return false;
    piece.radius = l->priced ? sunder_i_full_below(l->model, a->feature, b->feature)
                             : sunder_i_owed_below(l->model, a->feature, b->feature);
    piece.priced = l->priced;
    if (waiver && !l->priced) {
        piece.radius = sunder_i_min(piece.radius, sunder_i_max(0, sunder_i_waiver_clearance(waiver)));
        piece.clearance = sunder_i_min(piece.radius, sunder_i_waiver_clearance(waiver));
    }
    if (piece.clearance < 0) return add_eroded(l, &piece, l->scratch.xy, n, -piece.clearance);
    sunder_i_listing_keep(l->out, &piece, l->scratch.xy, n);
    return true;
}
