/* rings.c: memory for the rings of a shape under construction, and access to the rings of a shape, cleaned and as
 * given. */
#include "shape/build.h"

#include <string.h>

bool sunder_i_rings_grow(sunder_i_rings *r, sunder_i_arena *arena, size_t vertices, size_t rings, size_t polygons)
{
    const size_t have[3] = {r->vertices, r->rings, r->polygons}, more[3] = {vertices, rings, polygons};
    bool enough = true;
    for (int k = 0; k < 3; k++) enough &= have[k] + more[k] <= r->room[k];
    if (enough) return true;
    size_t room[3];
    for (int k = 0; k < 3; k++) room[k] = have[k] + more[k] + r->room[k];
    sunder_i_rings grown = *r;
    grown.at = sunder_i_arena_alloc(arena, room[0], sizeof *r->at);
    grown.xy = sunder_i_arena_alloc(arena, 2 * room[0], sizeof *r->xy);
    grown.source = sunder_i_arena_alloc(arena, 3 * room[0] + room[1] + room[2], sizeof *r->source);
    if (arena->failed) return false;
    grown.next = grown.source + room[0];
    grown.prev = grown.next + room[0];
    grown.ring_end = grown.prev + room[0];
    grown.poly_end = grown.ring_end + room[1];
    memcpy(grown.room, room, sizeof room);
    if (r->vertices) {
        memcpy(grown.at, r->at, r->vertices * sizeof *r->at);
        memcpy(grown.xy, r->xy, 2 * (size_t)r->vertices * sizeof *r->xy);
        memcpy(grown.source, r->source, r->vertices * sizeof *r->source);
        memcpy(grown.next, r->next, r->vertices * sizeof *r->next);
        memcpy(grown.prev, r->prev, r->vertices * sizeof *r->prev);
    }
    if (r->rings) memcpy(grown.ring_end, r->ring_end, r->rings * sizeof *r->ring_end);
    if (r->polygons) memcpy(grown.poly_end, r->poly_end, r->polygons * sizeof *r->poly_end);
    *r = grown;
    return true;
}

size_t sunder_shape_rings(const sunder_shape *shape, size_t polygon)
{
    return shape->form->cleaned.poly_end[polygon] - (polygon ? shape->form->cleaned.poly_end[polygon - 1] : 0);
}

const double *sunder_shape_ring(const sunder_shape *shape, size_t polygon, size_t ring, size_t *n)
{
    const size_t r = (polygon ? shape->form->cleaned.poly_end[polygon - 1] : 0) + ring;
    const size_t begin = r ? shape->form->cleaned.ring_end[r - 1] : 0;
    *n = shape->form->cleaned.ring_end[r] - begin;
    return shape->xy + 2 * begin;
}

size_t sunder_shape_given(const sunder_shape *shape, const double **xy, const size_t **ring_end,
                          const size_t **poly_end)
{
    *xy = shape->raw_xy;
    *ring_end = shape->form->given.ring_end;
    *poly_end = shape->form->given.poly_end;
    return shape->form->given.polygons;
}
