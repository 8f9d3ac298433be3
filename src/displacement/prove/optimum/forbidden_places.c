/* Tests whether a place or a ray is in a forbidden set, in doubles.
 *
 * For a set of many pieces, a tree of boxes, in the order of a space-filling curve, finds those near the place; for a
 * few pieces each is tested. The results are the same, except for which of several pieces is found first. */
#include "displacement/prove/optimum/forbidden.h"
#include "displacement/prove/optimum/tuning.h"

#include "spatial/curve.h"

#include "base/extremes.h"

#include <math.h>
#include <stddef.h>

/* ---- The pieces near a place ------------------------------------------------------------------------------------- */

static void add_box(const void *of, size_t k, double box[4])
{
    const sunder_i_forbidden *f = of;
    sunder_i_box_join(box, f->piece[k].box);
}

bool sunder_i_forbidden_index(sunder_i_forbidden *forbidden)
{
    if (forbidden->pieces <= MANY_PIECES) return true;
    if (!sunder_i_curve_sort_records(forbidden->piece, forbidden->pieces, sizeof *forbidden->piece,
                                     offsetof(sunder_i_forbidden_piece, box)))
        return false;
    forbidden->tree = sunder_i_box_tree_of(forbidden->pieces, PIECES_IN_LEAF);
    forbidden->tree.box = sunder_i_alloc(2 * forbidden->tree.leaves, sizeof *forbidden->tree.box);
    if (forbidden->tree.box) sunder_i_box_tree_fill(&forbidden->tree, add_box, forbidden);
    return forbidden->tree.box;
}

void sunder_i_forbidden_start(sunder_i_forbidden_walk *walk, const sunder_i_forbidden *forbidden)
{
    walk->looks = 0;
    walk->at = sunder_i_forbidden_is_many(forbidden) ? forbidden->tree.n : 0;
    walk->end = forbidden->pieces;
    if (sunder_i_forbidden_is_many(forbidden))
        sunder_i_box_walk_start(&walk->waiting, &forbidden->tree);
    else
        walk->waiting.n = 0;
}

const sunder_i_forbidden_piece *sunder_i_forbidden_next(sunder_i_forbidden_walk *walk,
                                                        const sunder_i_forbidden *forbidden, const double box[4])
{
    for (;;) {
        while (walk->at < walk->end) {
            const sunder_i_forbidden_piece *piece = &forbidden->piece[walk->at++];
            walk->looks++;
            if (sunder_i_box_meet(piece->box, box)) return piece;
        }
        size_t node;
        if (!sunder_i_box_walk_next(&walk->waiting, &node)) return NULL;
        walk->looks++;
        if (!sunder_i_box_meet(forbidden->tree.box[node], box)) continue;
        if (node < forbidden->tree.leaves) {
            sunder_i_box_walk_open(&walk->waiting, 2 * node, 2 * node + 1);
            continue;
        }
        walk->at = sunder_i_box_tree_first(&forbidden->tree, node);
        walk->end = sunder_i_box_tree_end(&forbidden->tree, node);
    }
}

/* ---- One piece --------------------------------------------------------------------------------------------------- */

double sunder_i_forbidden_distance(const sunder_i_forbidden *forbidden, const sunder_i_forbidden_piece *piece,
                                   const double u[2])
{
    const sunder_i_obstacle_edge *edge = forbidden->edge + piece->edge;
    double inside = -INFINITY, nearest = INFINITY; /* `nearest` is a squared distance */
    for (uint32_t k = 0; k < piece->edges; k++) {
        const sunder_i_obstacle_edge *e = &edge[k];
        const double wx = u[0] - e->from[0], wy = u[1] - e->from[1], s = e->n[0] * wx + e->n[1] * wy;
        if (s > inside) inside = s;
        if (s <= 0) continue;
        const double along = wy * e->n[0] - wx * e->n[1];
        double far = s * s;
        if (along < 0) {
            far = wx * wx + wy * wy;
        } else if (along > e->length) {
            const double past = along - e->length;
            far += past * past;
        }
        if (far < nearest) nearest = far;
    }
    return inside <= 0 ? inside : sqrt(nearest);
}

double sunder_i_forbidden_normal(const sunder_i_forbidden *forbidden, const sunder_i_forbidden_piece *piece,
                                 const double u[2], double n[2])
{
    const sunder_i_obstacle_edge *edge = forbidden->edge + piece->edge;
    const double distance = sunder_i_forbidden_distance(forbidden, piece, u);
    double best = INFINITY;
    for (uint32_t k = 0; k < piece->edges; k++) {
        const sunder_i_obstacle_edge *e = &edge[k];
        const double wx = u[0] - e->from[0], wy = u[1] - e->from[1], s = e->n[0] * wx + e->n[1] * wy;
        const double along = wy * e->n[0] - wx * e->n[1],
                     past = sunder_i_min(0, along) + sunder_i_max(0, along - e->length);
        const double far = distance > 0 && s > 0 ? hypot(s, past) : fabs(s);
        if ((distance > 0 && s <= 0) || fabs(far - fabs(distance)) >= best) continue;
        best = fabs(far - fabs(distance));
        /* The gradient points away from the nearest point of the edge; inside the piece it is the normal of the
         * edge. */
        const double out = distance > 0 ? past : 0, length = hypot(s, out);
        n[0] = length > 0 ? (s * e->n[0] - out * e->n[1]) / length : e->n[0];
        n[1] = length > 0 ? (s * e->n[1] + out * e->n[0]) / length : e->n[1];
        if (distance <= 0) {
            n[0] = e->n[0];
            n[1] = e->n[1];
        }
    }
    return distance;
}

static void widen_span(double span[2], double from, double to)
{
    if (from < span[0]) span[0] = from;
    if (to > span[1]) span[1] = to;
}

/* Intersections may lie this many grains beyond an edge's ends; each length in the test has an error of less than one
 * grain. */
#define CLEAR_GRAINS 8
/* The number of consecutive edges that are skipped together if the line is near none of them. */
#define EDGES_AT_ONCE 8

typedef struct crossing {
    const double *from, *dir;
    double radius, grain, clear;
} crossing;

/* Sets off[0 .. n] to the distances of the beginnings of n edges, and of the end of the last, from the line, positive
 * on its right. Returns false if all are on one side and clear of it. */
static bool look_across(const crossing *c, const sunder_i_obstacle_edge *edge, const sunder_i_obstacle_edge *after,
                        size_t n, double *off)
{
    const double x = c->from[0], y = c->from[1], dx = c->dir[0], dy = c->dir[1];
    double least = off[n] = (after->from[0] - x) * dy - (after->from[1] - y) * dx, most = least;
    for (size_t k = 0; k < n; k++) {
        const double o = off[k] = (edge[k].from[0] - x) * dy - (edge[k].from[1] - y) * dx;
        least = o < least ? o : least;
        most = o > most ? o : most;
    }
    return least <= c->clear && most >= -c->clear;
}

/* Extends `span` by the line's intersections with the disc around the edge's beginning and with the edge moved out by
 * the radius. off: the distance of the beginning from the line. */
static void cross_edge(const crossing *c, const sunder_i_obstacle_edge *e, double off, double span[2])
{
    const double wx = e->from[0] - c->from[0], wy = e->from[1] - c->from[1], under = c->radius * c->radius - off * off;
    if (under >= 0 && c->radius > 0) {
        const double mid = wx * c->dir[0] + wy * c->dir[1], half = sqrt(under);
        widen_span(span, mid - half, mid + half);
    }
    /* The position along the moved edge is out / across; the signs are changed so that the divisor `speed` is
     * positive. */
    const double across = e->n[0] * c->dir[0] + e->n[1] * c->dir[1],
                 out = off + c->radius * (e->n[0] * c->dir[1] - e->n[1] * c->dir[0]), along = across < 0 ? -out : out,
                 speed = fabs(across);
    if (speed < 1e-14 || along < -c->grain * speed || along > (e->length + c->grain) * speed) return;
    const double s = (e->n[0] * wx + e->n[1] * wy + c->radius) / across;
    widen_span(span, s, s);
}

/* The line meets the grown piece in a segment, if at all. Its ends are on edges moved out, or on discs around corners,
 * and all such intersections are in the piece. Most edges lie on one side of the line, with both corners and the discs
 * around them, and need no further test. */
bool sunder_i_forbidden_span(const sunder_i_forbidden *forbidden, const sunder_i_forbidden_piece *piece,
                             const double from[2], const double dir[2], double span[2])
{
    const sunder_i_obstacle_edge *edge = forbidden->edge + piece->edge;
    const crossing c = {from, dir, piece->radius, forbidden->grain, piece->radius + CLEAR_GRAINS * forbidden->grain};
    span[0] = INFINITY;
    span[1] = -INFINITY;
    for (size_t at = 0; at < piece->edges; at += EDGES_AT_ONCE) {
        const size_t left = piece->edges - at, n = left < EDGES_AT_ONCE ? left : EDGES_AT_ONCE;
        double off[EDGES_AT_ONCE + 1];
        if (!look_across(&c, edge + at, n < left ? edge + at + n : edge, n, off)) continue;
        for (size_t k = 0; k < n; k++) {
            if ((off[k] > c.clear && off[k + 1] > c.clear) || (off[k] < -c.clear && off[k + 1] < -c.clear)) continue;
            cross_edge(&c, edge + at + k, off[k], span);
        }
    }
    return span[0] < span[1];
}

/* ---- The whole union --------------------------------------------------------------------------------------------- */

double sunder_i_forbidden_depth(const sunder_i_forbidden *forbidden, const double u[2])
{
    const double at[4] = {u[0], u[1], u[0], u[1]};
    double depth = 0;
    sunder_i_forbidden_walk walk;
    sunder_i_forbidden_start(&walk, forbidden);
    for (const sunder_i_forbidden_piece *p; (p = sunder_i_forbidden_next(&walk, forbidden, at));) {
        const double d = p->radius - sunder_i_forbidden_distance(forbidden, p, u);
        if (d > depth) depth = d;
    }
    return depth;
}

/* Is u deeper than `hair` in piece p? If u is in the disc inside the grown piece, well off its rim, it is, whatever the
 * edges are. */
static bool piece_is_deeper(const sunder_i_forbidden *f, const sunder_i_forbidden_piece *p, const double u[2],
                            double hair)
{
    const double x = u[0] - p->middle[0], y = u[1] - p->middle[1], safe = p->within - 2 * hair;
    return (safe > 0 && x * x + y * y < safe * safe) || p->radius - sunder_i_forbidden_distance(f, p, u) > hair;
}

bool sunder_i_forbidden_is_deeper(const sunder_i_forbidden *forbidden, const double u[2], double hair, size_t *guess)
{
    const double at[4] = {u[0], u[1], u[0], u[1]};
    if (*guess < forbidden->pieces && piece_is_deeper(forbidden, &forbidden->piece[*guess], u, hair)) return true;
    sunder_i_forbidden_walk walk;
    sunder_i_forbidden_start(&walk, forbidden);
    for (const sunder_i_forbidden_piece *p; (p = sunder_i_forbidden_next(&walk, forbidden, at));) {
        if (!piece_is_deeper(forbidden, p, u, hair)) continue;
        *guess = (size_t)(p - forbidden->piece);
        return true;
    }
    return false;
}

bool sunder_i_forbidden_is_near(const sunder_i_forbidden *forbidden, const double u[2], double hair)
{
    for (size_t k = 0; k < forbidden->pieces; k++)
        if (sunder_i_box_near_point(forbidden->piece[k].box, u[0], u[1], hair) &&
            sunder_i_forbidden_distance(forbidden, &forbidden->piece[k], u) < forbidden->piece[k].radius + hair)
            return true;
    return false;
}

/* Are u and v, and so everything between them, in the disc of one piece? */
static bool is_within(const sunder_i_forbidden *f, const double u[2], const double v[2])
{
    for (size_t k = 0; k < f->pieces && !sunder_i_forbidden_is_many(f); k++) {
        const sunder_i_forbidden_piece *p = &f->piece[k];
        const double ux = u[0] - p->middle[0], uy = u[1] - p->middle[1], vx = v[0] - p->middle[0],
                     vy = v[1] - p->middle[1], square = p->within * p->within;
        if (p->within > 0 && ux * ux + uy * uy <= square && vx * vx + vy * vy <= square) return true;
    }
    return false;
}

double sunder_i_forbidden_exit(const sunder_i_forbidden *forbidden, const double u[2], const double dir[2], double most)
{
    const double to[2] = {u[0] + most * dir[0], u[1] + most * dir[1]};
    if (most < INFINITY && is_within(forbidden, u, to)) return most;
    double s = 0;
    const sunder_i_forbidden_piece *left = NULL; /* the piece that was left last; it is convex, so it is not entered
                                                  * again */
    for (bool again = true; again && s < most;) {
        again = false;
        const double x = u[0] + s * dir[0], y = u[1] + s * dir[1], at[4] = {x, y, x, y};
        sunder_i_forbidden_walk walk;
        sunder_i_forbidden_start(&walk, forbidden);
        for (const sunder_i_forbidden_piece *p; (p = sunder_i_forbidden_next(&walk, forbidden, at));) {
            double span[2];
            if (p == left || !sunder_i_forbidden_span(forbidden, p, u, dir, span) || span[0] > s + forbidden->grain ||
                span[1] <= s)
                continue;
            if (span[1] > s + forbidden->grain) again = true;
            s = span[1];
            left = p;
        }
    }
    return s;
}

double sunder_i_forbidden_entry(const sunder_i_forbidden *forbidden, const double u[2], const double dir[2],
                                double most, uint64_t *steps)
{
    const double to[2] = {u[0] + most * dir[0], u[1] + most * dir[1]};
    double box[4], first = most;
    sunder_i_box_of_segment(u, to, box);
    sunder_i_forbidden_walk walk;
    sunder_i_forbidden_start(&walk, forbidden);
    for (const sunder_i_forbidden_piece *p; (p = sunder_i_forbidden_next(&walk, forbidden, box));) {
        double span[2];
        *steps += p->edges;
        if (!sunder_i_forbidden_span(forbidden, p, u, dir, span) || !(span[1] > forbidden->grain)) continue;
        first = sunder_i_min(first, sunder_i_max(0, span[0]));
    }
    *steps += walk.looks;
    return first;
}
