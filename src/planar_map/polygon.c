/* polygon.c: a convex polygon as two chains from its smallest corner to its greatest: the lower one counterclockwise,
 * the upper one clockwise. The polygon is above the edges of the lower chain and below those of the upper one; of the
 * vertices of its boundary, it is directly below those inside the upper chain only. */
#include "planar_map/map.h"

typedef struct boundary {
    size_t n, least, most;
    sunder_i_site *site;     /* with numbers of the caller, later of the map */
    sunder_i_map_line *line; /* line[i] is the line of side i, from corner i to the next; its numbers are in the scratch
                              * arena. Sides of length 0 have none */
    bool *empty;
    bool unite;
} boundary;

/* Returns the corner after i along a chain; *side becomes the side between the two. */
static size_t next_corner(const boundary *b, bool upper, size_t i, size_t *side)
{
    const size_t j = upper ? (i + b->n - 1) % b->n : (i + 1) % b->n;
    *side = upper ? j : i;
    return j;
}

static bool prepare_boundary(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                             const sunder_i_point *along, boundary *b)
{
    b->site = sunder_i_arena_alloc(&map->scratch, b->n, sizeof *b->site);
    b->line = sunder_i_arena_alloc(&map->scratch, b->n, sizeof *b->line);
    b->empty = sunder_i_arena_alloc(&map->scratch, b->n, sizeof *b->empty);
    if (!b->site || !b->line || !b->empty) return false;
    b->least = b->most = 0;
    for (size_t i = 0; i < b->n; i++) b->site[i] = sunder_i_site_of(map, corner[i]);
    for (size_t i = 1; i < b->n; i++) {
        if (sunder_i_site_cmp(map, &b->site[i], &b->site[b->least]) < 0) b->least = i;
        if (sunder_i_site_cmp(map, &b->site[i], &b->site[b->most]) > 0) b->most = i;
    }
    for (size_t i = 0; i < b->n; i++) {
        const sunder_i_site *p = &b->site[i], *q = &b->site[(i + 1) % b->n];
        const int c = sunder_i_site_cmp(map, p, q);
        b->empty[i] = c == 0;
        if (c != 0)
            b->line[i] = c < 0 ? sunder_i_line_through(map, p, q, along ? &along[i] : NULL, &map->scratch)
                               : sunder_i_line_through(map, q, p, along ? &along[i] : NULL, &map->scratch);
    }
    return !sunder_i_map_broken(map);
}

/* ---- A polygon inside a covered face ---- */

static bool glide_chain(sunder_i_planar_map *map, const boundary *b, bool upper, uint32_t t, sunder_i_list *list)
{
    list->n = 0;
    for (size_t i = b->least, side; i != b->most;) {
        const size_t j = next_corner(b, upper, i, &side);
        if (!b->empty[side] && !sunder_i_map_glide(map, &t, &b->site[j], &b->line[side], list)) return false;
        i = j;
    }
    return true;
}

/* Returns true if the polygon certainly changes nothing: its smallest corner, in trapezoid t, is strictly inside a
 * covered face, and both chains pass through the same trapezoids without meeting a vertex or an edge, so that these
 * contain the polygon. (It may change nothing in other cases, too; the cleaning finds these.) */
static bool is_redundant(sunder_i_planar_map *map, const boundary *b, uint32_t t)
{
    const sunder_i_trapezoid *z = &map->trapezoid[t];
    const sunder_i_site *first = &b->site[b->least];
    if (z->covered == 0 || (z->left != NOWHERE && sunder_i_site_cmp(map, &map->vertex[z->left].site, first) == 0) ||
        (z->bottom != NOWHERE && sunder_i_site_side(map, &map->line[map->edge[z->bottom].line], first) == 0))
        return false;
    return glide_chain(map, b, false, t, &map->above) && glide_chain(map, b, true, t, &map->beneath) &&
           map->above.n == map->beneath.n &&
           (map->above.n == 0 ||
            memcmp(map->above.item, map->beneath.item, map->above.n * sizeof *map->above.item) == 0);
}

/* ---- Drawing the polygon ---- */

static bool walk_chain(sunder_i_planar_map *map, const boundary *b, bool upper, uint32_t v)
{
    for (size_t i = b->least, side; i != b->most;) {
        const size_t j = next_corner(b, upper, i, &side);
        if (!b->empty[side]) {
            const sunder_i_map_line kept = sunder_i_line_copy(&b->line[side], &map->arena);
            if (sunder_i_map_broken(map)) return false;
            const uint32_t line = sunder_i_map_new_line(map, &kept);
            if (line == NOWHERE) return false;
            v = sunder_i_map_walk(map, v, &b->site[j], line, !upper, upper, b->unite);
            if (v == NOWHERE) return false;
            if (upper && sunder_i_site_cmp(map, &b->site[j], &b->site[b->most]) != 0) map->vertex[v].below++;
        }
        i = j;
    }
    return true;
}

static bool draw_polygon(sunder_i_planar_map *map, boundary *b, uint32_t t)
{
    for (size_t i = 0; i < b->n; i++) b->site[i] = sunder_i_site_copy(&b->site[i], &map->arena);
    if (sunder_i_map_broken(map)) return false;
    const uint32_t v = sunder_i_map_vertex_in(map, t, &b->site[b->least]);
    return v != NOWHERE && walk_chain(map, b, false, v) && walk_chain(map, b, true, v);
}

sunder_status sunder_i_map_polygon(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                                   const sunder_i_point *along, size_t n, bool unite, sunder_error *err)
{
    sunder_i_map_drop_faces(map);
    map->ring.n = 0;
    const sunder_i_mark mark = sunder_i_arena_mark(&map->scratch);
    boundary b = {.n = n, .unite = unite};
    if (prepare_boundary(map, corner, along, &b)) {
        const uint32_t t = sunder_i_history_find(map, &b.site[b.least]);
        if (!unite || !is_redundant(map, &b, t)) {
            map->marked = false;
            if (!sunder_i_map_broken(map) && !draw_polygon(map, &b, t)) map->failed = true;
        }
    } else
        map->failed = true;
    if (sunder_i_map_broken(map)) return sunder_i_failure_cause(err);
    sunder_i_arena_release(&map->scratch, mark);
    return SUNDER_OK;
}

sunder_status sunder_i_planar_map_insert_polygon(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                                                 const sunder_i_point *along, size_t n, sunder_error *err)
{
    return sunder_i_map_polygon(map, corner, along, n, false, err);
}
