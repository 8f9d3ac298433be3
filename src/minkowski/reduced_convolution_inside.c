/* reduced_convolution_inside.c: tests whether a point x of a segment is inside the sum, in doubles with one-sided error
 * bounds, so that the result may be "uncertain".
 *
 * The point is inside if a side of P crosses a side of x - Q in the relative interiors of both, and for points inside
 * such a crossing usually exists: since x is on a segment, the boundaries of x - Q and P are in contact, so that
 * neither contains the other in its interior. If none is found, the winding number of the whole convolution [GRS83] is
 * computed directly beside the segment: it is the number of components of the intersection of P and x - Q, since both
 * are simply connected. */
#include "minkowski/reduced_convolution_inner.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "number/trust.h"

#include <math.h>

/* The error of coordinates. Coordinates of operands and sums are at most `most` in magnitude, below 2^60 units, and u
 * is 2^-53. A point computed as from + at * along has an error of u * most for `from`, of 6u * most for the product of
 * up to 2 * most, and of u * most for their sum. Differences of it and of two coordinates, up to 4 * most, add 10u *
 * most: the total is less than 2^-48 * most. A cross product with a vector d has an error of this times |dx| + |dy|,
 * plus 4u of products up to 4 * most * |d|, again less than 2^-48 * most * (|dx| + |dy|). Twice the total is used. */
#define ERROR SUNDER_I_DOUBT(0x1p-46)

/* The number of sides and vertices that may be tested, for each vertex of the operands: random polygons of a hundred
 * vertices need about five hundred. If a sum of large operands has many holes, the general method is faster. */
#define PATIENCE 4096

/* Sorts the sides of P, the longest first: these are most likely to cross a side of x - Q. Returns false if out of
 * memory. */
static bool order_sides(sunder_i_place_query *in, sunder_i_arena *m)
{
    const sunder_i_chain_operand *p = &in->reduced->operand[0];
    sunder_i_valued *length = sunder_i_arena_alloc(m, 2 * (size_t)p->n, sizeof *length);
    in->order = sunder_i_arena_alloc(m, p->n, sizeof *in->order);
    if (m->failed) return false;
    for (uint32_t i = 0; i < p->n; i++)
        length[i] = (sunder_i_valued){-(fabs((double)p->along[i].x) + fabs((double)p->along[i].y)), i, 0};
    if (!sunder_i_sort_valued(length, p->n)) return false;
    for (uint32_t i = 0; i < p->n; i++) in->order[i] = length[i].item;
    return true;
}

bool sunder_i_place_query_init(sunder_i_place_query *inside, sunder_i_reduced *r)
{
    double most[2] = {0, 0};
    *inside = (sunder_i_place_query){.reduced = r,
                                     .value = sunder_i_arena_alloc(&r->memory, r->operand[1].n, sizeof *inside->value)};
    for (int k = 0; k < 2; k++) {
        const sunder_i_chain_operand *o = &r->operand[k];
        double *xy = inside->xy[k] = sunder_i_arena_alloc(&r->memory, 2 * (size_t)o->n, sizeof *xy);
        for (uint32_t i = 0; xy && i < o->n; i++) {
            xy[i] = (double)o->at[i].x;
            xy[o->n + i] = (double)o->at[i].y;
            most[k] = sunder_i_max(most[k], sunder_i_max(fabs(xy[i]), fabs(xy[o->n + i])));
        }
    }
    inside->error = ERROR * (most[0] + most[1]);
    inside->left = PATIENCE * ((size_t)r->operand[0].n + r->operand[1].n);
    return order_sides(inside, &r->memory);
}

typedef struct place {
    double x, y;
} place;

/* ---- Crossing sides ---- */

/* Returns a value whose sign is the side of x - q[j] with respect to the line of P's side i; positive: left. */
static double side_of_p(const sunder_i_place_query *in, uint32_t i, uint32_t j, place x)
{
    const sunder_i_chain_operand *p = &in->reduced->operand[0], *q = &in->reduced->operand[1];
    const double dx = (double)p->along[i].x, dy = (double)p->along[i].y;
    return dx * (x.y - (double)q->at[j].y - (double)p->at[i].y) - dy * (x.x - (double)q->at[j].x - (double)p->at[i].x);
}

/* Returns a value whose sign is the side of p[i] with respect to the line of side j of x - Q. */
static double side_of_q(const sunder_i_place_query *in, uint32_t i, uint32_t j, place x)
{
    const sunder_i_chain_operand *p = &in->reduced->operand[0], *q = &in->reduced->operand[1];
    const double dx = (double)q->along[j].x, dy = (double)q->along[j].y;
    return dx * (x.y - (double)q->at[j].y - (double)p->at[i].y) - dy * (x.x - (double)q->at[j].x - (double)p->at[i].x);
}

static double doubt_of_side(const sunder_i_place_query *in, sunder_i_point along)
{
    return in->error * (fabs((double)along.x) + fabs((double)along.y));
}

static bool on_both_sides(double a, double b, double error)
{
    return ((a > error) & (b < -error)) | ((a < -error) & (b > error));
}

static bool sides_cross(const sunder_i_place_query *in, uint32_t i, uint32_t j, place x)
{
    const sunder_i_chain_operand *p = &in->reduced->operand[0], *q = &in->reduced->operand[1];
    return on_both_sides(side_of_p(in, i, j, x), side_of_p(in, i, sunder_i_vertex_after(q, j), x),
                         doubt_of_side(in, p->along[i])) &&
           on_both_sides(side_of_q(in, i, j, x), side_of_q(in, sunder_i_vertex_after(p, i), j, x),
                         doubt_of_side(in, q->along[j]));
}

/* Stores in in->value the values of side_of_p() for side i of P and all vertices of x - Q. */
static void sides_of_p(const sunder_i_place_query *in, uint32_t i, place x)
{
    const sunder_i_chain_operand *p = &in->reduced->operand[0];
    const uint32_t n = in->reduced->operand[1].n;
    const double *restrict qx = in->xy[1], *restrict qy = qx + n;
    double *restrict value = in->value;
    const double dx = (double)p->along[i].x, dy = (double)p->along[i].y;
    const double px = x.x - in->xy[0][i], py = x.y - in->xy[0][p->n + i];
    for (uint32_t j = 0; j < n; j++) value[j] = dx * (py - qy[j]) - dy * (px - qx[j]);
}

/* Returns true if a side of P crosses a side of x - Q. The pair that crossed last is tested first, since consecutive
 * points are near each other. */
static bool some_sides_cross(sunder_i_place_query *in, place x)
{
    const sunder_i_chain_operand *p = &in->reduced->operand[0], *q = &in->reduced->operand[1];
    if (sides_cross(in, in->last[0], in->last[1], x)) return true;
    for (uint32_t at = 0; at < p->n && in->left >= q->n; at++) {
        const uint32_t i = in->order[at];
        in->left -= q->n;
        const double error = doubt_of_side(in, p->along[i]);
        sides_of_p(in, i, x);
        for (uint32_t j = 0, k = q->n - 1; j < q->n; k = j++) {
            if (!on_both_sides(in->value[k], in->value[j], error) || !sides_cross(in, i, k, x)) continue;
            in->last[0] = i;
            in->last[1] = k;
            return true;
        }
    }
    return false;
}

/* ---- Winding numbers ---- */

/* Returns the contribution of one segment of the curve to the winding number at x, counted along the ray to the left: 1
 * if the segment crosses the ray downwards, -1 if upwards, else 0. *certain becomes false if doubles do not decide
 * it. */
static int winding_by_segment(const sunder_i_place_query *in, place x, sunder_i_point from, sunder_i_point along,
                              bool *certain)
{
    const double low = (double)from.y - x.y, high = (double)(from.y + along.y) - x.y;
    *certain &= fabs(low) > in->error && fabs(high) > in->error;
    if ((low > 0) == (high > 0)) return 0;
    const double side = (double)along.x * (x.y - (double)from.y) - (double)along.y * (x.x - (double)from.x);
    *certain &= fabs(side) > doubt_of_side(in, along);
    return high > 0 ? (side < 0 ? -1 : 0) : (side > 0 ? 1 : 0);
}

/* Returns the contribution of the sides of operand a, translated by the vertices of the other operand, except for the
 * segment `without`: at a reflex vertex the sides between its own two are traversed in the opposite direction. */
static int winding_by_operand(const sunder_i_place_query *in, int a, place x, const sunder_i_reduced_segment *without,
                              bool *certain)
{
    const sunder_i_reduced *r = in->reduced;
    const sunder_i_chain_operand *o = &r->operand[a], *b = &r->operand[!a];
    int winding = 0;
    for (uint32_t j = 0; j < b->n && *certain; j++) {
        const bool convex = sunder_i_is_convex(b, j, r->classes);
        const uint32_t in_rank = b->rank[sunder_i_vertex_before(b, j)], out_rank = b->rank[j];
        const sunder_i_rank_range range =
            convex ? sunder_i_sides_between(o, in_rank, out_rank) : sunder_i_sides_between(o, out_rank, in_rank);
        for (int k = 0; k < 2; k++)
            for (uint32_t at = range.first[k]; at < range.end[k]; at++) {
                const uint32_t i = o->by_rank[at];
                const sunder_i_point from = {o->at[i].x + b->at[j].x, o->at[i].y + b->at[j].y}, along = o->along[i];
                if (convex && from.x == without->from.x && from.y == without->from.y && along.x == without->along.x &&
                    along.y == without->along.y)
                    continue;
                const int by = winding_by_segment(in, x, from, along, certain);
                winding += convex ? by : -by;
            }
    }
    return winding;
}

/* Decides by the winding number directly to the right of segment s. The result is uncertain if the segment is along the
 * ray on which crossings are counted. */
static sunder_i_place_in_sum winding_says(const sunder_i_place_query *in, place x, const sunder_i_reduced_segment *s)
{
    const double low = (double)s->from.y - x.y, high = (double)(s->from.y + s->along.y) - x.y;
    bool certain = fabs(low) > in->error && fabs(high) > in->error && (low > 0) != (high > 0);
    int winding = high > 0 ? -1 : 0; /* a segment that goes up is to the left of the points on its right side */
    for (int a = 0; a < 2 && certain; a++) winding += winding_by_operand(in, a, x, s, &certain);
    return !certain ? SUNDER_I_UNCERTAIN : winding == 0 ? SUNDER_I_NOT_INSIDE : SUNDER_I_INSIDE;
}

sunder_i_place_in_sum sunder_i_place_query_ask(sunder_i_place_query *inside, uint32_t segment, double at)
{
    const sunder_i_reduced_segment *s = &inside->reduced->segment[segment];
    const place x = {(double)s->from.x + at * (double)s->along.x, (double)s->from.y + at * (double)s->along.y};
    if (some_sides_cross(inside, x)) return SUNDER_I_INSIDE;
    const size_t all = 4 * (size_t)inside->reduced->segments; /* the approximate size of the whole convolution */
    if (inside->left < all || !sunder_i_steps(all)) return SUNDER_I_UNCERTAIN;
    inside->left -= all;
    return winding_says(inside, x, s);
}
