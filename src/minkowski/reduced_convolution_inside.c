/* Is a place x on a segment inside the sum? In doubles with one-sided bounds, so the answer may be "not certain".
 *
 * It is inside where some side of P crosses some side of x - Q, in the relative interiors of both, and if x is inside
 * such a crossing usually exists: since x is on a segment, the boundaries of x - Q and P are in contact, so neither
 * contains the other in its interior. If none is found, the winding number of the whole convolution [GRS83] is computed
 * just beside the segment: it is the number of components of the intersection of P and x - Q, both being simply
 * connected. */
#include "minkowski/reduced_convolution_inner.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "number/trust.h"

#include <math.h>

/* Coordinates of operands and sums are within `most`, below 2^60 units, and u is 2^-53. A place worked out as from +
 * at * along is off by u * most for `from`, 6u * most for the product of up to 2 * most, and u * most for their sum.
 * Differences of it and of two coordinates, up to 4 * most, by 10u * most beside: together by less than 2^-48 * most. A
 * cross product with a vector d is off by as much times |dx| + |dy|, and by 4u of products up to 4 * most * |d|, less
 * than 2^-48 * most * (|dx| + |dy|) again. Twice the whole is used. */
#define ERROR SUNDER_I_DOUBT(0x1p-46)

/* The budget of sides and vertices looked at, for each vertex of the operands: random polygons of a hundred vertices
 * take some five hundred. Where a sum of large operands has many holes the general road is faster. */
#define PATIENCE 4096

/* The sides of P, the longest first: of those some cross a side of x - Q the soonest. */
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

/* ---- Sides that cross ---- */

/* On which side of the line of P's side i is x - q[j]? Positive: to its left. */
static double side_of_p(const sunder_i_place_query *in, uint32_t i, uint32_t j, place x)
{
    const sunder_i_chain_operand *p = &in->reduced->operand[0], *q = &in->reduced->operand[1];
    const double dx = (double)p->along[i].x, dy = (double)p->along[i].y;
    return dx * (x.y - (double)q->at[j].y - (double)p->at[i].y) - dy * (x.x - (double)q->at[j].x - (double)p->at[i].x);
}

/* On which side of the line of (x - Q)'s side j is p[i]? */
static double side_of_q(const sunder_i_place_query *in, uint32_t i, uint32_t j, place x)
{
    const sunder_i_chain_operand *p = &in->reduced->operand[0], *q = &in->reduced->operand[1];
    const double dx = (double)q->along[j].x, dy = (double)q->along[j].y;
    return dx * (x.y - (double)q->at[j].y - (double)p->at[i].y) - dy * (x.x - (double)q->at[j].x - (double)p->at[i].x);
}

static double doubt(const sunder_i_place_query *in, sunder_i_point along)
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
                         doubt(in, p->along[i])) &&
           on_both_sides(side_of_q(in, i, j, x), side_of_q(in, sunder_i_vertex_after(p, i), j, x),
                         doubt(in, q->along[j]));
}

/* On which side of the line of P's side i are the corners of x - Q? Into value. */
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

/* Those that crossed last are tried first: places follow each other. */
static bool some_sides_cross(sunder_i_place_query *in, place x)
{
    const sunder_i_chain_operand *p = &in->reduced->operand[0], *q = &in->reduced->operand[1];
    if (sides_cross(in, in->last[0], in->last[1], x)) return true;
    for (uint32_t at = 0; at < p->n && in->left >= q->n; at++) {
        const uint32_t i = in->order[at];
        in->left -= q->n;
        const double error = doubt(in, p->along[i]);
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

/* Contribution of one stretch of the curve to the winding number at x, counted along the ray to the left: 1 where the
 * stretch crosses the ray downwards, -1 upwards. */
static int passes(const sunder_i_place_query *in, place x, sunder_i_point from, sunder_i_point along, bool *certain)
{
    const double low = (double)from.y - x.y, high = (double)(from.y + along.y) - x.y;
    *certain &= fabs(low) > in->error && fabs(high) > in->error;
    if ((low > 0) == (high > 0)) return 0;
    const double side = (double)along.x * (x.y - (double)from.y) - (double)along.y * (x.x - (double)from.x);
    *certain &= fabs(side) > doubt(in, along);
    return high > 0 ? (side < 0 ? -1 : 0) : (side > 0 ? 1 : 0);
}

/* What the sides of operand a do that are moved by the vertices of the other, but for one segment: at a reflex vertex
 * those between its sides are run backwards. */
static int wind(const sunder_i_place_query *in, int a, place x, const sunder_i_reduced_segment *without, bool *certain)
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
                const int by = passes(in, x, from, along, certain);
                winding += convex ? by : -by;
            }
    }
    return winding;
}

/* On the right hand of the segment, where it does not run along the ray that is counted on. */
static sunder_i_place_in_sum winding_says(const sunder_i_place_query *in, place x, const sunder_i_reduced_segment *s)
{
    const double low = (double)s->from.y - x.y, high = (double)(s->from.y + s->along.y) - x.y;
    bool certain = fabs(low) > in->error && fabs(high) > in->error && (low > 0) != (high > 0);
    int winding = high > 0 ? -1 : 0; /* a segment that goes up is on the left of its right hand */
    for (int a = 0; a < 2 && certain; a++) winding += wind(in, a, x, s, &certain);
    return !certain ? SUNDER_I_UNCERTAIN : winding == 0 ? SUNDER_I_NOT_INSIDE : SUNDER_I_INSIDE;
}

sunder_i_place_in_sum sunder_i_place_query_ask(sunder_i_place_query *inside, uint32_t segment, double at)
{
    const sunder_i_reduced_segment *s = &inside->reduced->segment[segment];
    const place x = {(double)s->from.x + at * (double)s->along.x, (double)s->from.y + at * (double)s->along.y};
    if (some_sides_cross(inside, x)) return SUNDER_I_INSIDE;
    const size_t all = 4 * (size_t)inside->reduced->segments; /* approximate size of the whole convolution */
    if (inside->left < all || !sunder_i_steps(all)) return SUNDER_I_UNCERTAIN;
    inside->left -= all;
    return winding_says(inside, x, s);
}
