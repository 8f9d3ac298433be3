/* Convex polygons of relative moves, in doubles: they decide nothing, and show which claims to test. */
#include "displacement/prove/proofs/plane.h"

#include "base/extremes.h"

#include <math.h>
#include <string.h>

#define TURN 6.28318530717958647692

void sunder_i_plane_disc(sunder_i_plane_region *region, double radius)
{
    const double far = radius / cos(TURN / (2 * PLANE_SIDES));
    region->n = PLANE_SIDES;
    for (int k = 0; k < PLANE_SIDES; k++) {
        region->xy[2 * k] = far * cos(TURN * k / PLANE_SIDES);
        region->xy[2 * k + 1] = far * sin(TURN * k / PLANE_SIDES);
        region->claim[k] = SUNDER_I_NO_CLAIM;
    }
}

bool sunder_i_plane_clip(sunder_i_plane_region *region, const double n[2], double d, uint32_t claim, uint32_t by[2])
{
    double at[PLANE_CORNERS], greatest = -INFINITY;
    uint32_t nearest = 0;
    bool cut = false;
    for (uint32_t k = 0; k < region->n; k++) {
        at[k] = sunder_i_plane_at(n, region->xy + 2 * k);
        cut = cut || !(at[k] - d >= 0);
        if (!(at[k] > greatest)) continue;
        greatest = at[k];
        nearest = k;
    }
    if (!cut) return true;
    sunder_i_plane_region out;
    out.n = 0;
    for (uint32_t k = 0; k < region->n; k++) {
        const double *u = region->xy + 2 * k, *v = region->xy + 2 * (k + 1 < region->n ? k + 1 : 0);
        const double s = at[k] - d, t = at[k + 1 < region->n ? k + 1 : 0] - d;
        if (out.n + 2 > PLANE_CORNERS) return true; /* too many corners: the region is not cut */
        if (s >= 0) {
            memcpy(out.xy + 2 * out.n, u, 2 * sizeof *u);
            out.claim[out.n++] = s == 0 && t < 0 ? claim : region->claim[k];
        }
        if ((s > 0 && t < 0) || (s < 0 && t > 0)) {
            const double share = s / (s - t);
            for (size_t x = 0; x < 2; x++) out.xy[2 * out.n + x] = u[x] + share * (v[x] - u[x]);
            out.claim[out.n++] = s > 0 ? claim : region->claim[k];
        }
    }
    by[0] = region->claim[nearest ? nearest - 1 : region->n - 1];
    by[1] = region->claim[nearest];
    if (out.n < 3) return false;
    region->n = out.n;
    memcpy(region->xy, out.xy, 2 * out.n * sizeof *region->xy);
    memcpy(region->claim, out.claim, out.n * sizeof *region->claim);
    return true;
}

bool sunder_i_plane_clip_behind(sunder_i_plane_polygon *polygon, const sunder_i_half_plane *half_plane)
{
    double off[PLANE_CORNERS + 1], out[2 * PLANE_CORNERS]; /* off: the distances of the corners behind the line */
    uint32_t n = 0;
    bool cut = false;
    for (uint32_t k = 0; k < polygon->n; k++) {
        off[k] = half_plane->d - sunder_i_plane_at(half_plane->n, polygon->xy + 2 * k);
        cut = cut || !(off[k] >= 0);
    }
    if (!cut) return true;
    off[polygon->n] = off[0];
    for (uint32_t k = 0; k < polygon->n; k++) {
        const double *u = polygon->xy + 2 * k, *v = polygon->xy + 2 * (k + 1 < polygon->n ? k + 1 : 0), s = off[k],
                     t = off[k + 1];
        if (n + 2 > PLANE_CORNERS) return true; /* too many corners: the polygon is not cut */
        if (s >= 0) {
            out[2 * n] = u[0];
            out[2 * n++ + 1] = u[1];
        }
        if (!((s > 0 && t < 0) || (s < 0 && t > 0))) continue;
        const double share = s / (s - t);
        out[2 * n] = u[0] + share * (v[0] - u[0]);
        out[2 * n++ + 1] = u[1] + share * (v[1] - u[1]);
    }
    if (n < 3) return false;
    polygon->n = n;
    memcpy(polygon->xy, out, 2 * n * sizeof *out);
    return true;
}

static double area_of(const double *xy, uint32_t n)
{
    double sum = 0;
    for (uint32_t k = 0; k < n; k++) {
        const double *u = xy + 2 * k, *v = xy + 2 * (k + 1 < n ? k + 1 : 0);
        sum += u[0] * v[1] - u[1] * v[0];
    }
    return sum / 2;
}

double sunder_i_plane_area_of(const sunder_i_plane_polygon *polygon) { return area_of(polygon->xy, polygon->n); }

double sunder_i_plane_distance(const sunder_i_plane_region *region, double place[2], uint32_t by[2])
{
    double least = INFINITY;
    bool inside = true;
    for (uint32_t k = 0; k < region->n; k++) {
        const uint32_t before = k ? k - 1 : region->n - 1;
        const double *u = region->xy + 2 * k, *v = region->xy + 2 * (k + 1 < region->n ? k + 1 : 0);
        const double e[2] = {v[0] - u[0], v[1] - u[1]}, square = sunder_i_plane_at(e, e),
                     along = -sunder_i_plane_at(e, u);
        if (e[0] * u[1] - e[1] * u[0] > 0) inside = false; /* the origin is to the right of this side */
        const double share = square > 0 ? sunder_i_min(sunder_i_max(along / square, 0), 1) : 0;
        const double w[2] = {u[0] + share * e[0], u[1] + share * e[1]}, off = hypot(w[0], w[1]);
        if (!(off < least)) continue;
        least = off;
        memcpy(place, w, sizeof w);
        by[0] = share > 0 ? region->claim[k] : region->claim[before];
        by[1] = share < 1 ? region->claim[k] : region->claim[k + 1 < region->n ? k + 1 : 0];
    }
    if (inside) place[0] = place[1] = least = 0;
    return least;
}

double sunder_i_plane_area(const sunder_i_plane_region *region) { return area_of(region->xy, region->n); }

void sunder_i_plane_middle(const sunder_i_plane_region *region, const double nearest[2], double reach, double out[2])
{
    out[0] = out[1] = 0;
    for (uint32_t k = 0; k < region->n; k++)
        for (size_t x = 0; x < 2; x++) out[x] += region->xy[2 * k + x] / region->n;
    for (int k = 0; k < 30 && hypot(out[0], out[1]) > reach; k++)
        for (size_t x = 0; x < 2; x++) out[x] = (out[x] + nearest[x]) / 2;
}
