/* near_barriers.c: see near_barriers.h. The rules are those of gis/layer/barriers/barrier_reach.c: a barrier is near if
 * its box, and for lines that of one of its segments, is within the reach, plus what is owed, of the box of a feature;
 * that box is enlarged if barriers farther away may decide on which side of them the feature stands. The boxes are in a
 * tree that halves them by the middles of the longer side, each node with the box around its boxes. */
#include "python/near_barriers.h"

#include "geometry/gis_box.h"

#include <stdlib.h>
#include <string.h>

enum { LEAF = 8 };

struct gis_py_targets {
    double (*box)[4];  /* [n] in the order of the tree */
    double (*node)[4]; /* [nodes] the root is 0, the children of k are 2 k + 1 and 2 k + 2 */
    size_t n;
    double reach;
};

static int by_x(const void *a, const void *b)
{
    const double *p = a, *q = b, x = p[0] + p[2], y = q[0] + q[2];
    return (x > y) - (x < y);
}

static int by_y(const void *a, const void *b)
{
    const double *p = a, *q = b, x = p[1] + p[3], y = q[1] + q[3];
    return (x > y) - (x < y);
}

/* Orders the boxes first ... last - 1 for the node, and sets its box. */
static void build(gis_py_targets *targets, size_t node, size_t first, size_t last)
{
    double *around = targets->node[node];
    gis_box_clear(around);
    for (size_t i = first; i < last; i++) gis_box_join(around, targets->box[i]);
    if (last - first <= LEAF) return;
    qsort(targets->box + first, last - first, sizeof *targets->box,
          around[2] - around[0] > around[3] - around[1] ? by_x : by_y);
    const size_t middle = first + (last - first) / 2;
    build(targets, 2 * node + 1, first, middle);
    build(targets, 2 * node + 2, middle, last);
}

static size_t count_nodes(size_t n)
{
    size_t nodes = 1;
    for (; n > LEAF; n = (n + 1) / 2) nodes = 2 * nodes + 1;
    return nodes;
}

/* The box of feature i, with its point, enlarged by what its side needs. False: barriers do not concern it. */
static bool target_box(const sunder_feature *feature, const double *anchor, size_t i, double reach, double box[4])
{
    if (feature[i].ignored) return false;
    sunder_shape_box(feature[i].shape, box);
    if (anchor) gis_box_join(box, (double[4]){anchor[2 * i], anchor[2 * i + 1], anchor[2 * i], anchor[2 * i + 1]});
    const double by = (anchor ? 0 : sunder_side_reach(box)) - reach;
    for (int k = 0; by > 0 && k < 4; k++) box[k] += k < 2 ? -by : by;
    return true;
}

gis_py_targets *gis_py_targets_new(const sunder_feature *feature, const double *anchor, size_t n, double reach,
                                   bool *no_memory)
{
    gis_py_targets *out = calloc(1, sizeof *out);
    *no_memory = !out;
    if (!out) return NULL;
    out->reach = reach;
    out->box = calloc(n + 1, sizeof *out->box);
    for (size_t i = 0; out->box && i < n; i++) out->n += target_box(feature, anchor, i, reach, out->box[out->n]);
    if (out->box) out->node = calloc(count_nodes(out->n), sizeof *out->node);
    if (out->node && out->n) {
        build(out, 0, 0, out->n);
        return out;
    }
    *no_memory = !out->node;
    gis_py_targets_free(out);
    return NULL;
}

void gis_py_targets_free(gis_py_targets *targets)
{
    if (!targets) return;
    free(targets->box);
    free(targets->node);
    free(targets);
}

static bool any_meets(const gis_py_targets *targets, size_t node, size_t first, size_t last, const double box[4])
{
    if (!gis_box_meets(targets->node[node], box)) return false;
    const size_t middle = first + (last - first) / 2;
    if (last - first > LEAF)
        return any_meets(targets, 2 * node + 1, first, middle, box) ||
               any_meets(targets, 2 * node + 2, middle, last, box);
    for (size_t i = first; i < last; i++)
        if (gis_box_meets(targets->box[i], box)) return true;
    return false;
}

static bool box_is_near(const gis_py_targets *targets, const double box[4], double distance)
{
    double grown[4];
    if (!isfinite(targets->reach + distance)) return true;
    gis_box_grow(box, targets->reach + distance, grown);
    return any_meets(targets, 0, 0, targets->n, grown);
}

/* Joins a point to the box; false: it is not finite, and the core will refuse it. */
static bool join_point(double box[4], const double xy[2])
{
    if (!isfinite(xy[0]) || !isfinite(xy[1])) return false;
    gis_box_join(box, (double[4]){xy[0], xy[1], xy[0], xy[1]});
    return true;
}

/* The box of the whole geometry, rings as they were given. False: a coordinate is not finite. */
static bool box_of(const sunder_obstacle *o, double box[4])
{
    const double *xy;
    const size_t *ring_end, *poly_end,
        polygons = o->shape ? sunder_shape_given(o->shape, &xy, &ring_end, &poly_end) : 0;
    const size_t vertices = polygons ? ring_end[poly_end[polygons - 1] - 1] : 0,
                 points = o->lines ? o->line_end[o->lines - 1] : 0;
    gis_box_clear(box);
    for (size_t k = 0; k < vertices; k++)
        if (!join_point(box, xy + 2 * k)) return false;
    for (size_t k = 0; k < points; k++)
        if (!join_point(box, o->xy + 2 * k)) return false;
    return true;
}

bool gis_py_is_near(const gis_py_targets *targets, const sunder_barrier *barrier, double distance)
{
    const sunder_obstacle *o = &barrier->geometry;
    double whole[4];
    if (!targets || (!o->shape && o->lines == 0)) return false;
    const double owed = barrier->width / 2 + distance;
    if (!box_of(o, whole)) return true;
    if (!box_is_near(targets, whole, owed)) return false;
    if (o->shape) return true;
    for (size_t i = 0, k = 0; i < o->lines; k = o->line_end[i++])
        for (size_t first = k; k < o->line_end[i]; k++) {
            const double *p = o->xy + 2 * k, *q = k > first ? p - 2 : p;
            const double box[4] = {fmin(p[0], q[0]), fmin(p[1], q[1]), fmax(p[0], q[0]), fmax(p[1], q[1])};
            if (box_is_near(targets, box, owed)) return true;
        }
    return false;
}
