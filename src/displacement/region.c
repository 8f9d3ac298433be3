/* The free places of a pair are what the interior of P + (-Q) leaves of a disc; within a convex polygon they have a
 * convex hull, and the region becomes a polygon around that. A linear function is least on the free places at a point
 * of the obstruction's boundary (or of a degenerate hole) within the region, or at a corner of the region that is free.
 * All is in doubles, and every cut is moved out by more than rounding could have moved it in. */
#include "displacement/region.h"

#include <math.h>
#include <string.h>

/* Sides of the polygon around the disc; directions in which a region is tightened. */
#define DISC_SIDES 32
#define DIRECTIONS 16
/* Cuts are moved out by this share of the radius: what rounding could be, and more. */
#define SLACK 1e-7

#define TURN 6.28318530717958647692

static void direction(int k, int of, double n[2])
{
    n[0] = cos(TURN * k / of);
    n[1] = sin(TURN * k / of);
}

void sunder_i_region_disc(double r, sunder_i_region *region)
{
    region->n = DISC_SIDES;
    for (int k = 0; k < DISC_SIDES; k++) {
        direction(k, DISC_SIDES, region->xy + 2 * k);
        region->xy[2 * k] *= r / cos(TURN / (2 * DISC_SIDES));
        region->xy[2 * k + 1] *= r / cos(TURN / (2 * DISC_SIDES));
    }
}

void sunder_i_region_cut(sunder_i_region *region, const double n[2], double h)
{
    sunder_i_region out = {.n = 0};
    for (size_t k = 0; k < region->n; k++) {
        const double *p = region->xy + 2 * k, *q = region->xy + 2 * (k + 1 < region->n ? k + 1 : 0);
        const double sp = n[0] * p[0] + n[1] * p[1] - h, sq = n[0] * q[0] + n[1] * q[1] - h;
        if (out.n + 2 > SUNDER_I_REGION_CORNERS) return;
        if (sp >= 0) memcpy(out.xy + 2 * out.n++, p, 2 * sizeof *p);
        if ((sp > 0 && sq < 0) || (sp < 0 && sq > 0)) {
            const double s = sp / (sp - sq);
            out.xy[2 * out.n] = p[0] + s * (q[0] - p[0]);
            out.xy[2 * out.n++ + 1] = p[1] + s * (q[1] - p[1]);
        }
    }
    *region = out;
}

/* The least n.u met so far, by directions. */
typedef struct extremes {
    double least[DIRECTIONS];
} extremes;

static void take_in(extremes *hull, const double u[2])
{
    for (int k = 0; k < DIRECTIONS; k++) {
        double n[2];
        direction(k, DIRECTIONS, n);
        hull->least[k] = fmin(hull->least[k], n[0] * u[0] + n[1] * u[1]);
    }
}

/* Takes in the part of a segment within the region, grown by the slack. */
static void take_in_segment(extremes *hull, const double *s, const sunder_i_region *region, double slack)
{
    const double e[2] = {s[2] - s[0], s[3] - s[1]};
    double from = 0, to = 1;
    for (size_t k = 0; k < region->n && from <= to; k++) {
        const double *p = region->xy + 2 * k, *q = region->xy + 2 * (k + 1 < region->n ? k + 1 : 0);
        const double d[2] = {q[0] - p[0], q[1] - p[1]}, length = hypot(d[0], d[1]);
        const double at = d[0] * (s[1] - p[1]) - d[1] * (s[0] - p[0]) + slack * length, v = d[0] * e[1] - d[1] * e[0];
        if (v > 0)
            from = fmax(from, -at / v);
        else if (v < 0)
            to = fmin(to, -at / v);
        else if (at < 0)
            return;
    }
    if (from > to) return;
    take_in(hull, (double[2]){s[0] + from * e[0], s[1] + from * e[1]});
    take_in(hull, (double[2]){s[0] + to * e[0], s[1] + to * e[1]});
}

/* Is u in the interior? By the walls that a ray upward crosses. */
static bool is_obstructed(const sunder_i_obstruction *o, const double u[2])
{
    bool inside = false;
    for (size_t k = 0; k < o->walls; k++) {
        const double *s = o->segment + 4 * k;
        if ((s[0] <= u[0]) != (s[2] <= u[0]) && s[1] + (u[0] - s[0]) / (s[2] - s[0]) * (s[3] - s[1]) > u[1])
            inside = !inside;
    }
    return inside;
}

void sunder_i_region_tighten(sunder_i_region *region, const sunder_i_obstruction *o)
{
    const double slack = SLACK * o->r;
    extremes hull;
    for (int k = 0; k < DIRECTIONS; k++) hull.least[k] = INFINITY;
    for (size_t k = 0; k < region->n; k++)
        if (!is_obstructed(o, region->xy + 2 * k)) take_in(&hull, region->xy + 2 * k);
    /* A region of one or two corners has no inside to clip to: rounding could lose what is free of it. */
    if (region->n > 2)
        for (size_t k = 0; k < o->segments; k++) take_in_segment(&hull, o->segment + 4 * k, region, slack);
    else
        for (size_t k = 0; k < region->n; k++) take_in(&hull, region->xy + 2 * k);
    if (hull.least[0] == INFINITY) region->n = 0;
    for (int k = 0; k < DIRECTIONS && region->n; k++) {
        double n[2];
        direction(k, DIRECTIONS, n);
        sunder_i_region_cut(region, n, hull.least[k] - slack);
    }
}

/* ---- The obstruction ------------------------------------------------------------------------------------------------
 */

static void append(sunder_i_obstruction *o, const sunder_sum *sum, uint32_t from, uint32_t to)
{
    double *s = o->segment + 4 * o->segments++;
    sunder_sum_vertex(sum, from, s);
    sunder_sum_vertex(sum, to, s + 2);
}

static sunder_status read_sum(const sunder_sum *sum, sunder_i_obstruction *out, sunder_error *err)
{
    sunder_sum_counts counts;
    sunder_sum_count(sum, &counts);
    size_t n = counts.degenerate_segments + counts.degenerate_points, m;
    for (size_t p = 0; p < counts.polygons; p++)
        for (size_t k = 0; k < sunder_sum_rings(sum, p); k++) {
            sunder_sum_ring(sum, p, k, &m);
            n += m;
        }
    out->segment = sunder_i_alloc(4 * n, sizeof *out->segment);
    if (!out->segment) return sunder_i_no_memory(err);
    for (size_t p = 0; p < counts.polygons; p++)
        for (size_t k = 0; k < sunder_sum_rings(sum, p); k++) {
            const uint32_t *ring = sunder_sum_ring(sum, p, k, &m);
            for (size_t v = 0; v < m; v++) append(out, sum, ring[v], ring[v + 1 < m ? v + 1 : 0]);
        }
    out->walls = out->segments;
    for (size_t k = 0; k < counts.degenerate_segments; k++) {
        uint32_t ends[2];
        sunder_sum_segment(sum, k, ends);
        append(out, sum, ends[0], ends[1]);
    }
    for (size_t k = 0; k < counts.degenerate_points; k++) {
        const uint32_t at = sunder_sum_point(sum, k);
        append(out, sum, at, at);
    }
    return SUNDER_OK;
}

sunder_status sunder_i_obstruction_of(const sunder_shape *p, const sunder_shape *q, double r, sunder_i_obstruction *out,
                                      sunder_error *err)
{
    memset(out, 0, sizeof *out);
    out->r = r;
    sunder_shape *back = NULL;
    sunder_sum *sum = NULL;
    sunder_status status = sunder_shape_reflect(q, &back, err);
    if (!status) status = sunder_minkowski_sum(p, back, NULL, &sum, err);
    if (!status) status = read_sum(sum, out, err);
    sunder_sum_free(sum);
    sunder_shape_free(back);
    return status;
}

void sunder_i_obstruction_free(sunder_i_obstruction *obstruction)
{
    sunder_i_free(obstruction->segment);
    memset(obstruction, 0, sizeof *obstruction);
}
