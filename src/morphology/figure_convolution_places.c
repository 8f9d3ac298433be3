/* figure_convolution_places.c: positions that several corners of the curve share. After a dilation they are common: if
 * another body divides the arc about a vertex v of the dilated set, both halves shrink to v.
 *
 * Around such a position the arriving and leaving links are sorted by direction. From one sector to the next,
 * counterclockwise, the winding number increases by one at a leaving link, and decreases by one at an arriving link. */
#include "morphology/figure_convolution.h"

#include "base/sort.h"
#include "base/union_find.h"
#include "base/watch.h"

#include <string.h>

/* Divides the directions into half-circles from the west on; west is in the first one. */
static bool is_upper(sunder_i_point u) { return u.y > 0 || (u.y == 0 && u.x > 0); }

/* Compares directions counterclockwise from the west. */
static int compare_rays(void *context, uint32_t a, uint32_t b)
{
    const sunder_i_curve_ray *ray = context;
    const sunder_i_point u = ray[a].along, v = ray[b].along;
    if (is_upper(u) != is_upper(v)) return is_upper(u) ? 1 : -1;
    const sunder_i_i128 turn = sunder_i_plain_cross(u, v);
    return (turn < 0) - (turn > 0);
}

/* Sorts the rays of one place and sets the winding number of each one's sector relative to the west. Returns false if
 * out of memory; *fits becomes false if two directions are equal. */
static bool sort_rays(sunder_i_figure_convolution *c, sunder_i_curve_ray *ray, uint32_t n, bool *fits)
{
    const sunder_i_mark mark = sunder_i_arena_mark(&c->scratch);
    uint32_t *order = sunder_i_arena_alloc(&c->scratch, n, sizeof *order);
    sunder_i_curve_ray *sorted = sunder_i_arena_alloc(&c->scratch, n, sizeof *sorted);
    for (uint32_t i = 0; order && i < n; i++) order[i] = i;
    if (!order || !sorted || !sunder_i_sort_indices(order, n, compare_rays, ray)) return false;
    int32_t number = 0;
    for (uint32_t i = 0; i < n; i++) {
        sorted[i] = ray[order[i]];
        number += sorted[i].leaves ? 1 : -1;
        sorted[i].number = number;
        *fits &= i == 0 || compare_rays(sorted, i - 1, i) != 0;
    }
    memcpy(ray, sorted, n * sizeof *ray);
    sunder_i_arena_release(&c->scratch, mark);
    return true;
}

/* Numbers the places: each link whose corner was touched has one. Returns false if out of memory. */
static bool number_places(sunder_i_figure_convolution *c, uint32_t *parent)
{
    uint32_t *size = sunder_i_arena_alloc(&c->memory, c->links, sizeof *size);
    if (!size) return false;
    for (size_t i = 0; i < c->touches; i++) sunder_i_union_join(parent, c->touch[i].corner[0], c->touch[i].corner[1]);
    memset(size, 0, c->links * sizeof *size);
    for (uint32_t i = 0; i < c->links; i++) size[sunder_i_union_find(parent, i)]++;
    for (uint32_t i = 0; i < c->links; i++)
        if (parent[i] == i && size[i] > 1) c->link[i].place = (uint32_t)++c->places;
    for (uint32_t i = 0; i < c->links; i++) c->link[i].place = c->link[sunder_i_union_find(parent, i)].place;
    c->place_end = sunder_i_arena_alloc(&c->memory, c->places, sizeof *c->place_end);
    if (!c->place_end) return false;
    memset(c->place_end, 0, c->places * sizeof *c->place_end);
    for (uint32_t i = 0; i < c->links; i++)
        if (c->link[i].place) c->place_end[c->link[i].place - 1] += 2;
    return sunder_i_steps(c->links);
}

/* Lists the rays: at a place, the link before each of its corners arrives, and the link that begins there leaves.
 * Returns false if out of memory. */
static bool list_rays(sunder_i_figure_convolution *c)
{
    uint32_t before = 0;
    for (size_t p = 0; p < c->places; p++) {
        const uint32_t own = c->place_end[p];
        c->place_end[p] = before; /* the position of the next one; finally the end */
        before += own;
    }
    c->ray = sunder_i_arena_alloc(&c->memory, before, sizeof *c->ray);
    if (!c->ray) return false;
    for (uint32_t i = 0; i < c->links; i++) {
        const sunder_i_curve_link *in = &c->link[i], *out = &c->link[in->next];
        if (!out->place) continue;
        uint32_t *end = &c->place_end[out->place - 1];
        c->ray[(*end)++] = (sunder_i_curve_ray){{-in->along.x, -in->along.y}, i, in->next, 0, false};
        c->ray[(*end)++] = (sunder_i_curve_ray){out->along, in->next, in->next, 0, true};
    }
    return sunder_i_steps(c->links);
}

sunder_status sunder_i_figure_convolution_places(sunder_i_figure_convolution *curve, bool *fits, sunder_error *err)
{
    *fits = true;
    if (curve->touches == 0) return SUNDER_OK;
    uint32_t *parent = sunder_i_arena_alloc(&curve->memory, curve->links, sizeof *parent);
    if (!parent) return sunder_i_failure_cause(err);
    sunder_i_union_init(parent, curve->links);
    bool ok = number_places(curve, parent) && list_rays(curve);
    for (uint32_t p = 0; ok && p < curve->places; p++) {
        const uint32_t first = sunder_i_place_first(curve, p);
        ok = sort_rays(curve, curve->ray + first, curve->place_end[p] - first, fits);
    }
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}
