/* A convex polygon as two chains from its smallest corner to its greatest: the lower one counter-clockwise, the upper
 * one clockwise. The polygon is above the edges of the lower chain and below those of the upper one, and right below
 * the vertices that lie inside the upper chain and no others of its boundary. */
#include "planar_map/map.h"

typedef struct chain {
    const sunder_i_site *site; /* the corners' */
    const sunder_i_point *along;
    size_t n;
    bool upper, record;
} chain;

static bool walk_chain(sunder_i_planar_map *map, const chain *c, uint32_t v, size_t from, size_t to)
{
    for (size_t i = from; i != to;) {
        const size_t j = c->upper ? (i + c->n - 1) % c->n : (i + 1) % c->n;
        const bool empty = sunder_i_site_cmp(map, &c->site[i], &c->site[j]) == 0;
        if (!empty) {
            const sunder_i_point *along = c->along ? &c->along[c->upper ? j : i] : NULL;
            const sunder_i_map_line through = sunder_i_line_through(map, &c->site[i], &c->site[j], along);
            if (sunder_i_map_broken(map)) return false;
            const uint32_t line = sunder_i_map_new_line(map, &through);
            if (line == NOWHERE) return false;
            v = sunder_i_map_walk(map, v, &c->site[j], line, !c->upper, c->upper, c->record);
            if (v == NOWHERE) return false;
            if (c->upper && sunder_i_site_cmp(map, &c->site[j], &c->site[to]) != 0) map->vertex[v].below++;
        }
        i = j;
    }
    return true;
}

sunder_status sunder_i_map_polygon(sunder_i_planar_map *map, const sunder_i_xyw *corner, const sunder_i_point *along,
                                   size_t n, bool record, sunder_error *err)
{
    sunder_i_map_drop_faces(map);
    map->marked = false;
    map->ring.n = 0;
    sunder_i_site *site = sunder_i_alloc(n, sizeof *site);
    if (!site) {
        map->failed = true;
        return sunder_i_no_memory(err);
    }
    size_t least = 0, most = 0;
    for (size_t i = 0; i < n; i++) site[i] = sunder_i_site_of(map, corner[i], &map->arena);
    for (size_t i = 1; i < n && !sunder_i_map_broken(map); i++) {
        if (sunder_i_site_cmp(map, &site[i], &site[least]) < 0) least = i;
        if (sunder_i_site_cmp(map, &site[i], &site[most]) > 0) most = i;
    }
    chain c = {site, along, n, false, record};
    const uint32_t v = sunder_i_map_vertex_at(map, &site[least]);
    if (v != NOWHERE && walk_chain(map, &c, v, least, most)) {
        c.upper = true;
        walk_chain(map, &c, v, least, most);
    }
    sunder_i_free(site);
    return sunder_i_map_status(map, err);
}

sunder_status sunder_i_planar_map_insert_polygon(sunder_i_planar_map *map, const sunder_i_xyw *corner,
                                                 const sunder_i_point *along, size_t n, sunder_error *err)
{
    return sunder_i_map_polygon(map, corner, along, n, false, err);
}
