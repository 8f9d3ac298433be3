/* Convex regions, clipped in doubles, with a bound on their error.
 *
 * Invariant: the true region T, of all u that satisfy the cuts exactly, lies in P + B(blur), where P is the convex hull
 * of the stored corners. A clip by n.u >= d preserves it: u in T is p + e with p in P, |e| <= blur, so n.p >= d - blur.
 * The signs of n.p - d + blur + 2 grain at the corners are right up to grain (which is more than the rounding error of
 * a product, region.h), so a corner that is dropped has n.p < d - blur. Where an edge crosses the line, the computed
 * place is one of the edge whose product is right up to grain, rounded by less than grain. So the part that P loses is
 * beyond the line, or within a grain of the rest, and blur grows by that. If the line is nearly parallel to an edge the
 * computed place may be far from the true crossing, but then everything between the two is within a grain of the line.
 *
 * A polygon that would have too many corners is left as it was, and corners within a grain of each other are merged:
 * then the region, or blur, is larger. */
#include "displacement/prove/optimum/region.h"

#include <math.h>
#include <string.h>

void sunder_i_region_init(sunder_i_region *region, const double centre[2], double reach)
{
    const double square[8] = {centre[0] - reach, centre[1] - reach, centre[0] + reach, centre[1] - reach,
                              centre[0] + reach, centre[1] + reach, centre[0] - reach, centre[1] + reach};
    region->n = 4;
    memcpy(region->xy, square, sizeof square);
    for (int k = 0; k < 4; k++) region->cut[k] = SUNDER_I_NO_CUT;
    region->blur = 0x1p-50 * (fabs(centre[0]) + fabs(centre[1]) + reach);
}

typedef struct clipping {
    uint32_t n;
    double xy[2 * SUNDER_I_REGION_CORNERS];
    uint32_t cut[SUNDER_I_REGION_CORNERS];
    double grain;
    bool full, merged;
} clipping;

static void add_corner(clipping *c, double x, double y, uint32_t cut)
{
    if (c->n) {
        const double *last = c->xy + 2 * (c->n - 1);
        if (fabs(last[0] - x) + fabs(last[1] - y) <= c->grain) {
            c->cut[c->n - 1] = cut;
            c->merged = true;
            return;
        }
    }
    if (c->n == SUNDER_I_REGION_CORNERS) {
        c->full = true;
        return;
    }
    c->xy[2 * c->n] = x;
    c->xy[2 * c->n + 1] = y;
    c->cut[c->n++] = cut;
}

void sunder_i_region_clip(sunder_i_region *region, const double n[2], double d, uint32_t cut, double grain)
{
    double s[SUNDER_I_REGION_CORNERS];
    bool any = false;
    for (uint32_t k = 0; k < region->n; k++) {
        s[k] = n[0] * region->xy[2 * k] + n[1] * region->xy[2 * k + 1] - d + region->blur + 2 * grain;
        any = any || s[k] < 0;
    }
    if (!any) return;
    clipping c;
    c.n = 0;
    c.grain = grain;
    c.full = c.merged = false;
    for (uint32_t k = 0; k < region->n; k++) {
        const uint32_t l = k + 1 < region->n ? k + 1 : 0;
        const double *p = region->xy + 2 * k, *q = region->xy + 2 * l;
        if (s[k] >= 0) add_corner(&c, p[0], p[1], region->cut[k]);
        if ((s[k] >= 0) == (s[l] >= 0)) continue;
        const double share = s[k] / (s[k] - s[l]);
        /* Where the boundary leaves the half-plane, the side along the line begins; where it comes back, the side that
         * it crosses continues. */
        add_corner(&c, p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1]), s[k] >= 0 ? cut : region->cut[k]);
    }
    if (c.full) return;
    region->n = c.n;
    memcpy(region->xy, c.xy, 2 * c.n * sizeof *c.xy);
    memcpy(region->cut, c.cut, c.n * sizeof *c.cut);
    region->blur += (c.merged ? 2 : 1) * grain;
}

double sunder_i_region_beyond(const sunder_i_region *region, const double u[2], uint32_t *cut)
{
    double most = 0;
    for (uint32_t k = 0; k < region->n; k++) {
        if (region->cut[k] == SUNDER_I_NO_CUT) continue;
        const double *p = region->xy + 2 * k, *q = region->xy + 2 * (k + 1 < region->n ? k + 1 : 0);
        const double ex = q[0] - p[0], ey = q[1] - p[1], product = (u[0] - p[0]) * ey - (u[1] - p[1]) * ex;
        if (!(product > 0)) continue;
        const double length = sqrt(ex * ex + ey * ey), beyond = length > 0 ? product / length : 0;
        if (beyond <= most) continue;
        most = beyond;
        *cut = region->cut[k];
    }
    return most;
}
