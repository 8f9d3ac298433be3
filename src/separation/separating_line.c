/* separating_line.c: tests whether the distance of two sets certainly exceeds a length. It looks for a line that
 * separates them by more than all rounding errors: for disjoint convex sets there is one parallel to an edge of either,
 * or nearly so. This decides most pairs with neighbouring boxes at a tenth of the cost of an exact answer; for all
 * others the result is "unknown". */
#include "separation/separation.h"

#include "shape/shape.h"

#include "base/extremes.h"

#include <math.h>

/* Sets with more vertices are better tested piece by piece. */
#define MOST_CORNERS 24
/* The squares of shorter edges are below the range of doubles. */
#define SHORTEST 0x1p-450

/* Vertices relative to the lower left corner of P's box, in doubles. Each results from a difference and a sum of
 * numbers whose absolute sum is at most `size`, hence its error is less than 2^-51 of `size`. */
typedef struct corners {
    double xy[2 * MOST_CORNERS];
    uint32_t n;
} corners;

static double place_corners(const sunder_shape *s, const double t[2], const double origin[2], corners *out)
{
    double size = 0;
    out->n = s->vertices;
    for (uint32_t v = 0; v < 2 * s->vertices; v++) {
        const double x = s->xy[v] - origin[v & 1];
        out->xy[v] = x + t[v & 1];
        const double sum = fabs(x) + fabs(t[v & 1]);
        if (sum > size) size = sum;
    }
    return size;
}

/* Returns how far Q lies beyond P in direction n, of any length: the least product of n with Q's vertices, less the
 * largest with P's. */
static double distance_beyond(const corners *p, const corners *q, const double n[2])
{
    double most = -INFINITY, least = INFINITY;
    for (uint32_t v = 0; v < p->n; v++) {
        const double s = n[0] * p->xy[2 * v] + n[1] * p->xy[2 * v + 1];
        if (s > most) most = s;
    }
    for (uint32_t v = 0; v < q->n; v++) {
        const double s = n[0] * q->xy[2 * v] + n[1] * q->xy[2 * v + 1];
        if (s < least) least = s;
    }
    return least - most;
}

/* Tests the edges of shape s as normals of separating lines; `way`, the difference of the centres, determines their
 * direction. Let E be `size` times the sum of the absolute coordinates of n. A product of n with a vertex has an error
 * of 2^-51 E from the vertex and 2^-51 E from rounding; the difference of two products has twice that, 2^-49 E, plus
 * its own rounding, which is less: below 2^-48 E in all. The length of n and the required distance have relative errors
 * of 2^-50. */
static bool parts_along(const sunder_shape *s, const corners *at, const corners *p, const corners *q,
                        const double way[2], double far, double size)
{
    for (uint32_t v = 0; v < s->vertices; v++) {
        const double *a = at->xy + 2 * v, *b = at->xy + 2 * s->form->cleaned.next[v];
        double n[2] = {b[1] - a[1], a[0] - b[0]};
        if (n[0] * way[0] + n[1] * way[1] < 0) {
            n[0] = -n[0];
            n[1] = -n[1];
        }
        const double length = fabs(n[0]) + fabs(n[1]), doubt = length * size * 0x1p-48;
        if (!(length > SHORTEST)) continue;
        if (distance_beyond(p, q, n) > far * sqrt(n[0] * n[0] + n[1] * n[1]) * (1 + 0x1p-48) + doubt) return true;
    }
    return false;
}

bool sunder_i_surely_apart(const sunder_shape *p, const double tp[2], const sunder_shape *q, const double tq[2],
                           double far)
{
    const double none[2] = {0, 0}, *origin = p->box, *s = tp ? tp : none, *t = tq ? tq : none;
    if (p->rational || q->rational || p->vertices > MOST_CORNERS || q->vertices > MOST_CORNERS) return false;
    corners at_p, at_q;
    const double of_p = place_corners(p, s, origin, &at_p), of_q = place_corners(q, t, origin, &at_q),
                 size = sunder_i_max(of_p, of_q);
    /* no product comes near the greatest double; underflow is negligible compared with the doubt */
    if (!(size < 0x1p400 && size > 0x1p-400 && far < 0x1p400)) return false;
    const double way[2] = {(q->box[0] - p->box[0]) + (q->box[2] - p->box[2]) + 2 * (t[0] - s[0]),
                           (q->box[1] - p->box[1]) + (q->box[3] - p->box[3]) + 2 * (t[1] - s[1])};
    return parts_along(p, &at_p, &at_p, &at_q, way, far, size) || parts_along(q, &at_q, &at_p, &at_q, way, far, size);
}
