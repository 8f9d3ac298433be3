/* The largest disc in a shape, or in several together, in doubles.
 *
 * The distance f(x) from a point inside of the shape to its boundary, negative outside of it, changes by no more than
 * the point moves. So in a square of half diagonal r around x it is at most f(x) + r. Squares are divided into four,
 * all of a size at a time, and those that cannot hold a better point are dropped, until a square holds hardly more than
 * its centre does. */
#include "displacement/levels/inscribed.h"

#include "displacement/levels/edges.h"

#include <math.h>

/* Squares are divided this many times at most, which is enough for SUNDER_I_DISC_PRECISION. */
enum { DIVISIONS = 10 };
#define MOST_SQUARES 65536u

typedef struct square {
    double at[2], distance;
} square;

/* The squares of one size. */
typedef struct squares {
    square *item;
    size_t n, room;
} squares;

static double distance_to_nearest(const double p[2], const double *edge, size_t n)
{
    double least = INFINITY; /* its square */
    for (size_t k = 0; k < n; k++) {
        double off[2];
        sunder_i_off_edge(edge + 4 * k, p, off);
        least = sunder_i_min(least, off[0] * off[0] + off[1] * off[1]);
    }
    return sqrt(least);
}

static bool is_within(const double p[2], const double *edge, size_t n)
{
    bool inside = false;
    for (size_t k = 0; k < n; k++) inside ^= sunder_i_ray_crosses(p, edge + 4 * k);
    return inside;
}

/* Is p inside of a member, or in a crack between two? */
static bool is_in_room(const sunder_i_disc_room *room, const double p[2])
{
    size_t near = 0;
    for (size_t m = 0, first = 0; m < room->members; first = room->end[m++])
        if (is_within(p, room->edge + 4 * first, room->end[m] - first)) return true;
    for (size_t m = 0, first = 0; m < room->members && room->members > 1 && near < 2; first = room->end[m++])
        near += distance_to_nearest(p, room->edge + 4 * first, room->end[m] - first) <= room->crack;
    return near > 1;
}

/* The distance from p to the walls, negative outside of the room. */
static double distance_inside(const sunder_i_disc_room *room, const double p[2])
{
    const double distance = distance_to_nearest(p, room->wall, room->walls);
    return is_in_room(room, p) ? distance : -distance;
}

static bool add_square(squares *list, const sunder_i_disc_room *room, double x, double y)
{
    if (!sunder_i_reserve(&list->item, &list->room, list->n + 1, sizeof *list->item)) return false;
    square *s = &list->item[list->n++];
    *s = (square){.at = {x, y}};
    s->distance = distance_inside(room, s->at);
    return true;
}

static void take_best(const squares *list, square *best)
{
    for (size_t k = 0; k < list->n; k++)
        if (list->item[k].distance > best->distance) *best = list->item[k];
}

/* Divides those squares of half side h that may hold a point better than `best` by more than `enough`. */
static bool divide_squares(const squares *from, const sunder_i_disc_room *room, double h, const square *best,
                           double enough, squares *to)
{
    bool ok = true;
    to->n = 0;
    for (size_t k = 0; k < from->n && ok; k++) {
        const square *s = &from->item[k];
        if (s->distance + h * sqrt(2) <= best->distance + enough) continue;
        for (int q = 0; q < 4 && ok; q++)
            ok = add_square(to, room, s->at[0] + (q & 1 ? h / 2 : -h / 2), s->at[1] + (q & 2 ? h / 2 : -h / 2));
    }
    return ok;
}

/* The box around all edges. */
static void box_of(const sunder_i_disc_room *room, double box[4])
{
    sunder_i_box_clear(box);
    for (size_t k = 0; k < 2 * room->end[room->members - 1]; k++) sunder_i_box_include(box, room->edge + 2 * k);
}

bool sunder_i_largest_disc(const sunder_i_disc_room *room, double centre[2], double *radius)
{
    squares list[2] = {{0}, {0}};
    double box[4];
    box_of(room, box);
    const double w = box[2] - box[0], d = box[3] - box[1], size = sunder_i_min(w, d);
    const size_t nx = (size_t)ceil(sunder_i_min(w / size, 256)), ny = (size_t)ceil(sunder_i_min(d / size, 256));
    double h = sunder_i_max(w / (double)nx, d / (double)ny) / 2;
    square best = {.distance = -INFINITY};
    bool ok = true;
    for (size_t k = 0; k < nx * ny && ok; k++)
        ok = add_square(&list[0], room, box[0] + h * (double)(2 * (k % nx) + 1),
                        box[1] + h * (double)(2 * (k / nx) + 1));
    for (int k = 0; ok && list[k & 1].n && k < DIVISIONS && list[k & 1].n < MOST_SQUARES; k++, h /= 2) {
        take_best(&list[k & 1], &best);
        ok = divide_squares(&list[k & 1], room, h, &best, size * SUNDER_I_DISC_PRECISION, &list[!(k & 1)]);
    }
    for (int k = 0; k < 2 && ok; k++) take_best(&list[k], &best);
    for (int c = 0; c < 2 && ok; c++) centre[c] = best.at[c];
    if (ok) *radius = sunder_i_max(0, best.distance);
    sunder_i_free_all(list[0].item, list[1].item);
    return ok;
}

/* Small steps stop at this part of the first one. */
#define LAST_STEP 0x1p-20

void sunder_i_disc_climb(const sunder_i_disc_room *room, double step, double centre[2], double *radius)
{
    for (const double last = step * LAST_STEP; step > last;) {
        double best[2] = {centre[0], centre[1]};
        for (int k = 0; k < 9; k++) {
            const double at[2] = {centre[0] + (k % 3 - 1) * step, centre[1] + (k / 3 - 1) * step};
            const double distance = distance_inside(room, at);
            if (distance <= *radius) continue;
            *radius = distance;
            memcpy(best, at, sizeof best);
        }
        if (best[0] == centre[0] && best[1] == centre[1]) step /= 2;
        memcpy(centre, best, sizeof best);
    }
}

sunder_status sunder_shape_largest_disc(const sunder_shape *shape, double centre[2], double *radius, sunder_error *err)
{
    centre[0] = centre[1] = *radius = 0;
    if (!shape || sunder_shape_is_empty(shape)) return SUNDER_OK;
    const size_t edges = shape->vertices;
    double *edge = sunder_i_alloc(4 * edges, sizeof *edge);
    if (!edge) return sunder_i_failure_cause(err);
    for (uint32_t v = 0; v < shape->vertices; v++) sunder_i_edge_of(shape, v, edge + 4 * (size_t)v);
    const sunder_i_disc_room room = {.wall = edge, .edge = edge, .end = &edges, .walls = edges, .members = 1};
    const bool ok = sunder_i_largest_disc(&room, centre, radius);
    sunder_i_free(edge);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
