/* polygons_wkb.c: see polygons_wkb.h. */
#include "geometry/polygons_wkb.h"

#include <stdint.h>
#include <string.h>

/* Sizes in bytes: byte order and type; a count; a point. */
enum { HEAD = 1 + sizeof(uint32_t), COUNT = sizeof(uint32_t), POINT = 2 * sizeof(double) };
/* Codes of types. */
enum { POLYGON = 3, MULTIPOLYGON = 6 };

static unsigned char *put_bytes(unsigned char *to, const void *from, size_t n)
{
    memcpy(to, from, n);
    return to + n;
}

static unsigned char *put_number(unsigned char *to, uint32_t number) { return put_bytes(to, &number, sizeof number); }

static unsigned char *put_head(unsigned char *to, uint32_t type)
{
    *to++ = (unsigned char)GIS_WKB_NATIVE;
    return put_number(to, type);
}

/* Is the ring's last vertex a copy of its first, as well-known binary requires? */
static bool is_closed(const double *xy, size_t n) { return n > 1 && memcmp(xy, xy + 2 * (n - 1), POINT) == 0; }

/* The number of vertices written, with closing vertices. */
static size_t count_vertices(const double *xy, const size_t *ring_end, size_t rings)
{
    size_t vertices = rings ? ring_end[rings - 1] : 0;
    for (size_t r = 0, first = 0; r < rings; first = ring_end[r++])
        vertices += ring_end[r] > first && !is_closed(xy + 2 * first, ring_end[r] - first);
    return vertices;
}

size_t gis_polygons_wkb_bytes(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                              bool multi)
{
    const size_t rings = polygons ? poly_end[polygons - 1] : 0;
    return (multi ? HEAD + COUNT : 0) + polygons * (HEAD + COUNT) + rings * COUNT +
           count_vertices(xy, ring_end, rings) * POINT;
}

void gis_polygons_wkb_write(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                            bool multi, unsigned char *to)
{
    size_t ring = 0, vertex = 0;
    if (multi) to = put_number(put_head(to, MULTIPOLYGON), (uint32_t)polygons);
    for (size_t p = 0; p < polygons; p++) {
        to = put_number(put_head(to, POLYGON), (uint32_t)(poly_end[p] - ring));
        for (; ring < poly_end[p]; vertex = ring_end[ring++]) {
            const size_t n = ring_end[ring] - vertex;
            const double *first = xy + 2 * vertex;
            const bool open = n && !is_closed(first, n);
            to = put_bytes(put_number(to, (uint32_t)(n + open)), first, n * POINT);
            if (open) to = put_bytes(to, first, POINT);
        }
    }
}
