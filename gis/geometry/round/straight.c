/* straight.c: removes vertices in straight walls that come from a turned shape.
 *
 * The sides of a turned shape (sunder buffer --align) are parallel to the walls only up to rounding. So where a wall
 * should be straight it has a vertex with an angle of about 1e-16; a rectangular house would get eight vertices. Such a
 * vertex is within a few ulps of the line between its neighbours, and is removed. The move counts in the deviation, and
 * the polygons are validated again as after rounding. */
#include "geometry/round/constants.h"
#include "geometry/round/steps.h"

#include <math.h>

/* Is vertex v within reach of the inside of ab? Raises *moved to its distance. */
static bool is_straight(const double *a, const double *b, const double *v, double *moved)
{
    double unit[2], off;
    for (int k = 0; k < 2; k++) unit[k] = GIS_STRAIGHT_ULPS * gis_ulp(fmax(fabs(a[k]), fabs(b[k])));
    double t = gis_place_along(a, b, v, unit, &off);
    if (!(t > 0 && t < 1 && off <= 1)) return false;
    *moved = fmax(*moved, hypot(v[0] - (a[0] + t * (b[0] - a[0])), v[1] - (a[1] + t * (b[1] - a[1]))));
    return true;
}

/* Appends a ring without its straight vertices; if nothing would remain but a line, the whole ring. The first vertex is
 * kept: it is the lexicographically smallest, and so a true corner. */
static bool append_ring(const double *xy, size_t n, gis_polygons *to, double *moved, gis_error *error)
{
    size_t start = to->vertices, kept = 0;
    double farthest = *moved;
    if (!gis_polygons_vertex(to, xy[0], xy[1], error)) return false;
    for (size_t i = 1; i < n; i++) {
        const double *a = xy + 2 * kept, *b = xy + 2 * (i + 1 < n ? i + 1 : 0);
        bool straight = i - kept <= GIS_STRAIGHT_ROW;
        double here = farthest;
        for (size_t v = kept + 1; straight && v <= i; v++) straight = is_straight(a, b, xy + 2 * v, &here);
        if (straight) {
            farthest = here;
            continue;
        }
        kept = i;
        if (!gis_polygons_vertex(to, xy[2 * i], xy[2 * i + 1], error)) return false;
    }
    bool area;
    if (!gis_end_ring_with_area(to, start, &area, error)) return false;
    if (area) {
        *moved = farthest;
        return true;
    }
    for (size_t i = 0; i < n; i++)
        if (!gis_polygons_vertex(to, xy[2 * i], xy[2 * i + 1], error)) return false;
    return gis_polygons_end_ring(to, error);
}

bool gis_straighten(gis_rounded *rounded, gis_error *error)
{
    const gis_polygons *from = &rounded->set;
    gis_rounded to = {.repaired = rounded->repaired};
    gis_suspects none = {0};
    double moved = 0, mended = 0;
    bool ok = true;
    for (size_t p = 0, r = 0; ok && p < from->polygons; p++) {
        size_t first = to.set.rings;
        for (; ok && r < from->poly_end[p]; r++) {
            size_t begin = r ? from->ring_end[r - 1] : 0;
            ok = append_ring(from->xy + 2 * begin, from->ring_end[r] - begin, &to.set, &moved, error);
        }
        ok = ok && gis_end_valid_polygon(&to.set, first, &mended, &to.repaired, error);
    }
    to.deviation = rounded->deviation + moved + mended;
    ok = ok && gis_mend_multipolygon(&to, &none, error);
    gis_suspects_clear(&none);
    if (ok) {
        gis_rounded_clear(rounded);
        *rounded = to;
    } else {
        gis_rounded_clear(&to);
    }
    return ok;
}
