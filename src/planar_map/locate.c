/* locate.c: point location. */
#include "planar_map/map.h"

sunder_status sunder_i_planar_map_locate(sunder_i_planar_map *map, sunder_i_rational_point at, sunder_i_location *out,
                                         sunder_error *err)
{
    const sunder_i_mark mark = sunder_i_arena_mark(&map->scratch);
    const sunder_i_site site = sunder_i_site_of(map, at);
    if (sunder_i_map_broken(map)) return sunder_i_failure_cause(err);
    const uint32_t t = sunder_i_history_find(map, &site);
    const sunder_i_trapezoid *z = &map->trapezoid[t];
    sunder_i_location l = {SUNDER_I_IN_FACE, NOWHERE, z->bottom == NOWHERE ? NOWHERE : 2 * z->bottom, z->covered,
                           map->faces_valid ? map->face_of_trapezoid[t] : NOWHERE};
    if (z->left != NOWHERE && sunder_i_site_cmp(map, &map->vertex[z->left].site, &site) == 0) {
        const uint32_t bottom = map->trapezoid[sunder_i_map_below_vertex(map, z->left)].bottom;
        l = (sunder_i_location){SUNDER_I_AT_VERTEX, z->left, bottom == NOWHERE ? NOWHERE : 2 * bottom,
                                sunder_i_planar_map_vertex_covered(map, z->left), NOWHERE};
    } else if (z->bottom != NOWHERE && sunder_i_site_side(map, &map->line[map->edge[z->bottom].line], &site) == 0)
        l = (sunder_i_location){SUNDER_I_ON_EDGE, z->bottom, 2 * z->bottom,
                                sunder_i_planar_map_edge_covered(map, z->bottom), NOWHERE};
    sunder_i_arena_release(&map->scratch, mark);
    if (sunder_i_map_broken(map)) return sunder_i_failure_cause(err);
    *out = l;
    return SUNDER_OK;
}
