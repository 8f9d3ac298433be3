/* mark.c: marking: computes how many regions contain each trapezoid, from the unbounded ones inwards. At a wall the
 * count does not change; at an edge it changes by the number of regions bounded by it. An edge is crossed at its
 * smaller end only: the trapezoids along one side of it are neighbours at walls. */
#include "planar_map/map.h"

#include "base/watch.h"

size_t sunder_i_map_around(const sunder_i_planar_map *map, uint32_t t, uint32_t stop, uint32_t to[6], int64_t step[6])
{
    const sunder_i_trapezoid *z = &map->trapezoid[t];
    const uint32_t across[4] = {z->lu, z->ll, z->ru, z->rl};
    size_t n = 0;
    for (int i = 0; i < 4; i++)
        if (across[i] != NOWHERE) {
            to[n] = across[i];
            step[n++] = 0;
        }
    for (int i = 0; i < 2; i++) {
        const uint32_t e = i ? z->top : z->bottom;
        if (e == NOWHERE) continue;
        const sunder_i_map_edge *edge = &map->edge[e];
        if ((i ? edge->down : edge->up) != t || (stop && edge->stamp == stop)) continue;
        to[n] = i ? edge->up : edge->down;
        step[n++] = i ? (int64_t)edge->sides[0] - edge->sides[1] : (int64_t)edge->sides[1] - edge->sides[0];
    }
    return n;
}

sunder_status sunder_i_planar_map_mark(sunder_i_planar_map *map, sunder_error *err)
{
    sunder_i_map_drop_faces(map);
    const uint32_t stamp = ++map->stamp;
    uint32_t outermost = 0;
    while (map->trapezoid[outermost].node == NOWHERE || map->trapezoid[outermost].top != NOWHERE) outermost++;
    map->stack.n = 0;
    map->trapezoid[outermost].stamp = stamp;
    map->trapezoid[outermost].covered = 0;
    if (!sunder_i_map_push(map, &map->stack, outermost)) return sunder_i_failure_cause(err);
    while (map->stack.n) {
        const uint32_t t = map->stack.item[--map->stack.n];
        if (!sunder_i_step()) return sunder_i_failure_cause(err);
        uint32_t to[6];
        int64_t step[6];
        const size_t n = sunder_i_map_around(map, t, 0, to, step);
        for (size_t i = 0; i < n; i++) {
            sunder_i_trapezoid *z = &map->trapezoid[to[i]];
            if (z->stamp == stamp) continue;
            z->stamp = stamp;
            z->covered = (uint32_t)(map->trapezoid[t].covered + step[i]);
            if (!sunder_i_map_push(map, &map->stack, to[i])) return sunder_i_failure_cause(err);
        }
    }
    map->marked = true;
    return sunder_i_map_status(map, err);
}
