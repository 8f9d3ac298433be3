/* obstacles.c: see obstacles.h. */
#include "python/obstacles.h"

#include <stdlib.h>
#include <string.h>

void gis_py_obstacles_clear(gis_py_obstacles *obstacles)
{
    free(obstacles->obstacle);
    free(obstacles->end);
    free(obstacles->xy);
    *obstacles = (gis_py_obstacles){0};
}

/* Counts of what the obstacles need. */
typedef struct needs {
    size_t lines, vertices;
} needs;

static needs count_needs(const gis_py_shapes *from, bool boundary)
{
    needs sum = {from->features.lines.rings, from->features.lines.vertices};
    for (size_t i = 0; boundary && i < from->n; i++) {
        const double *xy;
        const size_t *ring_end, *poly_end,
            polygons = from->shape[i] ? sunder_shape_given(from->shape[i], &xy, &ring_end, &poly_end) : 0;
        const size_t rings = polygons ? poly_end[polygons - 1] : 0;
        sum.lines += rings;
        sum.vertices += rings ? ring_end[rings - 1] + rings : 0;
    }
    return sum;
}

/* Copies the rings of a shape as closed lines to the end of the lines in xy and end; returns how many there are. */
static size_t copy_rings(const sunder_shape *shape, double *xy, size_t *end, size_t *vertices)
{
    const double *from;
    const size_t *ring_end, *poly_end, polygons = sunder_shape_given(shape, &from, &ring_end, &poly_end);
    const size_t rings = polygons ? poly_end[polygons - 1] : 0;
    for (size_t r = 0, first = 0; r < rings; first = ring_end[r++]) {
        const size_t n = ring_end[r] - first;
        memcpy(xy + 2 * *vertices, from + 2 * first, 2 * n * sizeof *xy);
        *vertices += n;
        if (n && memcmp(from + 2 * first, from + 2 * (ring_end[r] - 1), 2 * sizeof *xy) != 0) {
            memcpy(xy + 2 * *vertices, from + 2 * first, 2 * sizeof *xy);
            ++*vertices;
        }
        end[r] = *vertices;
    }
    return rings;
}

/* The lines of geometry i, and with `boundary` its rings, one after the other in xy from *vertices on. */
static void fill_lines(const gis_py_shapes *from, size_t i, bool boundary, gis_py_obstacles *out, size_t *lines,
                       size_t *vertices)
{
    const gis_polygons *set = &from->features.lines;
    sunder_obstacle *o = &out->obstacle[i];
    double *xy = out->xy + 2 * *vertices;
    size_t *end = out->end + *lines, n = 0, used = 0;
    const size_t known = from->features.n == from->n;
    for (size_t k = known && i ? from->features.line_end[i - 1] : 0; known && k < from->features.line_end[i]; k++) {
        const size_t first = k ? set->ring_end[k - 1] : 0, points = set->ring_end[k] - first;
        memcpy(xy + 2 * used, set->xy + 2 * first, 2 * points * sizeof *xy);
        used += points;
        end[n++] = used;
    }
    if (boundary && from->shape[i]) n += copy_rings(from->shape[i], xy, end + n, &used);
    *o = (sunder_obstacle){.shape = boundary ? NULL : from->shape[i], .xy = xy, .line_end = end, .lines = n};
    *lines += n;
    *vertices += used;
}

bool gis_py_obstacles_make(const gis_py_shapes *from, bool boundary, gis_py_obstacles *out)
{
    const needs sum = count_needs(from, boundary);
    *out = (gis_py_obstacles){.n = from->n};
    out->obstacle = calloc(from->n + 1, sizeof *out->obstacle);
    out->end = calloc(sum.lines + 1, sizeof *out->end);
    out->xy = calloc(sum.vertices + 1, 2 * sizeof *out->xy);
    if (!out->obstacle || !out->end || !out->xy) {
        gis_py_obstacles_clear(out);
        PyErr_NoMemory();
        return false;
    }
    for (size_t i = 0, lines = 0, vertices = 0; i < from->n; i++) fill_lines(from, i, boundary, out, &lines, &vertices);
    return true;
}
