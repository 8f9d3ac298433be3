/* Proposes, in doubles, a point with much room around it in the intersection of two features. Squares are examined in
 * the order of the greatest possible distance of a point in them from the sides of both features, and quartered while
 * they may contain a point with more room. The caller verifies the proposal; if there is none, nothing follows. */
#include "displacement/layer/relate.h"

#include "base/extremes.h"
#include "base/heap.h"
#include "base/watch.h"
#include "shape/shape.h"

#include <math.h>

/* The greatest number of squares that are examined. Most overlaps are simple, and the first few squares suffice. */
enum { MOST_SQUARES = 96 };

typedef struct square {
    double middle[2], half, room; /* room: the distance of the middle from the nearest side; negative if the middle is
                                   * not inside both features */
} square;

/* A side of feature `which` (0 or 1), from a to b, with the interior on its left. */
typedef struct overlap_side {
    double a[2], b[2];
    int which;
} overlap_side;

typedef struct overlap_sides {
    overlap_side *side;
    size_t n;
    double box[4]; /* the intersection of the boxes of the two features */
} overlap_sides;

static bool has_more(const void *a, const void *b)
{
    const square *s = a, *t = b;
    return s->room + s->half * M_SQRT2 > t->room + t->half * M_SQRT2;
}

static double distance_to(const overlap_side *s, const double at[2])
{
    const double e[2] = {s->b[0] - s->a[0], s->b[1] - s->a[1]}, d[2] = {at[0] - s->a[0], at[1] - s->a[1]};
    const double length2 = e[0] * e[0] + e[1] * e[1];
    const double k = length2 > 0 ? sunder_i_min(1, sunder_i_max(0, (e[0] * d[0] + e[1] * d[1]) / length2)) : 0;
    return hypot(d[0] - k * e[0], d[1] - k * e[1]);
}

/* Returns the room at a point. Whether a feature contains the point is found from its winding number, as members may
 * overlap: the sides are counted that a ray to the right crosses. */
static double room_at(const overlap_sides *sides, const double at[2])
{
    int winding[2] = {0, 0};
    double nearest = INFINITY;
    for (size_t k = 0; k < sides->n; k++) {
        const overlap_side *s = &sides->side[k];
        nearest = sunder_i_min(nearest, distance_to(s, at));
        const bool up = s->b[1] > at[1];
        if ((s->a[1] > at[1]) == up) continue;
        const double x = s->a[0] + (at[1] - s->a[1]) / (s->b[1] - s->a[1]) * (s->b[0] - s->a[0]);
        if (x > at[0]) winding[s->which] += up ? 1 : -1;
    }
    return winding[0] > 0 && winding[1] > 0 ? nearest : -nearest;
}

/* Collects the sides of both features that may be nearest to a square in the common box, or may be crossed by a ray
 * from it. Returns false if memory is out. */
static bool collect_sides(const sunder_i_translate *const of[2], overlap_sides *out)
{
    double box[2][4];
    for (int i = 0; i < 2; i++) {
        sunder_shape_box(of[i]->shape, box[i]);
        for (int k = 0; k < 4; k++) box[i][k] += of[i]->t[k & 1];
    }
    for (int k = 0; k < 2; k++) {
        out->box[k] = sunder_i_max(box[0][k], box[1][k]);
        out->box[k + 2] = sunder_i_min(box[0][k + 2], box[1][k + 2]);
    }
    out->n = 0;
    out->side = sunder_i_alloc((size_t)of[0]->shape->vertices + of[1]->shape->vertices, sizeof *out->side);
    for (int i = 0; i < 2 && out->side; i++) {
        const sunder_shape *shape = of[i]->shape;
        for (uint32_t v = 0; v < shape->vertices; v++) {
            overlap_side s = {.which = i};
            for (int c = 0; c < 2; c++) {
                s.a[c] = shape->xy[2 * (size_t)v + (size_t)c] + of[i]->t[c];
                s.b[c] = shape->xy[2 * (size_t)shape->form->cleaned.next[v] + (size_t)c] + of[i]->t[c];
            }
            if (sunder_i_max(s.a[0], s.b[0]) >= out->box[0] && sunder_i_max(s.a[1], s.b[1]) >= out->box[1] &&
                sunder_i_min(s.a[1], s.b[1]) <= out->box[3])
                out->side[out->n++] = s;
        }
    }
    return out->side != NULL;
}

/* Pushes a square onto the heap if it may contain a point with the room `radius`. Returns true if its middle has that
 * room. */
static bool examine_square(const overlap_sides *sides, square *heap, size_t *n, square s, double radius)
{
    s.room = room_at(sides, s.middle);
    if (s.room + s.half * M_SQRT2 >= radius) sunder_i_heap_push(heap, n, sizeof s, &s, has_more);
    return s.room >= radius;
}

static bool search_squares(const overlap_sides *sides, double radius, double place[2])
{
    square heap[MOST_SQUARES + 4];
    size_t n = 0, looked = 0;
    const double *box = sides->box, size[2] = {box[2] - box[0], box[3] - box[1]};
    if (!(sunder_i_min(size[0], size[1]) >= 2 * radius) || !isfinite(size[0] + size[1])) return false;
    /* The first squares form a row along the box, as wide as its shorter side; for a very long box they are larger. */
    const double half = sunder_i_max(sunder_i_min(size[0], size[1]), sunder_i_max(size[0], size[1]) / 16) / 2;
    const int along = size[0] < size[1], row = (int)ceil(size[along] / (2 * half));
    for (int i = 0; i < row; i++) {
        square s = {.half = half};
        s.middle[along] = box[along] + (2 * i + 1) * half;
        s.middle[1 - along] = box[1 - along] + size[1 - along] / 2;
        if (looked++, examine_square(sides, heap, &n, s, radius)) {
            for (int c = 0; c < 2; c++) place[c] = s.middle[c];
            return true;
        }
    }
    while (n > 0 && looked + 4 <= MOST_SQUARES) {
        square s;
        sunder_i_heap_pop(heap, &n, sizeof s, &s, has_more);
        for (int i = 0; i < 4; i++) {
            square part = {.half = s.half / 2};
            part.middle[0] = s.middle[0] + (i & 1 ? part.half : -part.half);
            part.middle[1] = s.middle[1] + (i & 2 ? part.half : -part.half);
            if (looked++, examine_square(sides, heap, &n, part, radius)) {
                for (int c = 0; c < 2; c++) place[c] = part.middle[c];
                return true;
            }
        }
    }
    return false;
}

sunder_status sunder_i_roomy_place(const sunder_i_translate *a, const sunder_i_translate *b, double radius, bool *found,
                                   double place[2], sunder_error *err)
{
    const sunder_i_translate *const of[2] = {a, b};
    overlap_sides sides;
    *found = false;
    if (!collect_sides(of, &sides) || !sunder_i_steps(sides.n)) {
        sunder_i_free(sides.side);
        return sunder_i_failure_cause(err);
    }
    *found = search_squares(&sides, radius, place);
    sunder_i_free(sides.side);
    return SUNDER_OK;
}
