/* edges.c: half-edges around their vertices, and changes of edges together with the trapezoids along them.
 *
 * Around a vertex half-edges are sorted counterclockwise from straight down: first those to the right, from the lowest
 * slope to the highest, then those to the left, from the highest to the lowest other end. `out` is the first. Where a
 * segment begins or ends, its position in this order follows from the trapezoid there: the edges that bound the
 * trapezoid at the vertex are the segment's neighbours. */
#include "planar_map/map.h"

static uint32_t *ccw_of(sunder_i_planar_map *map, uint32_t h) { return &map->edge[h >> 1].ccw[h & 1]; }
static uint32_t *cw_of(sunder_i_planar_map *map, uint32_t h) { return &map->edge[h >> 1].cw[h & 1]; }

/* Inserts h into the ring of half-edges directly after `before`; NOWHERE: h becomes a ring of its own. */
static void ring_add(sunder_i_planar_map *map, uint32_t h, uint32_t before)
{
    if (before == NOWHERE) before = *ccw_of(map, h) = h;
    const uint32_t after = *ccw_of(map, before);
    *ccw_of(map, before) = h;
    *cw_of(map, h) = before;
    *ccw_of(map, h) = after;
    *cw_of(map, after) = h;
}

static void ring_remove(sunder_i_planar_map *map, uint32_t h, uint32_t v)
{
    const uint32_t before = *cw_of(map, h), after = *ccw_of(map, h);
    if (map->vertex[v].out == h) map->vertex[v].out = after == h ? NOWHERE : after;
    *ccw_of(map, before) = after;
    *cw_of(map, after) = before;
}

/* Replaces h by g in the ring of half-edges around v. */
static void ring_replace(sunder_i_planar_map *map, uint32_t h, uint32_t g, uint32_t v)
{
    const uint32_t before = *cw_of(map, h), after = *ccw_of(map, h);
    if (map->vertex[v].out == h) map->vertex[v].out = g;
    if (before == h) {
        *cw_of(map, g) = *ccw_of(map, g) = g;
        return;
    }
    *cw_of(map, g) = before;
    *ccw_of(map, before) = g;
    *ccw_of(map, g) = after;
    *cw_of(map, after) = g;
}

uint32_t sunder_i_edge_wedge(sunder_i_planar_map *map, uint32_t v, uint32_t line, uint32_t *lower, uint32_t *same)
{
    *lower = *same = NOWHERE;
    const uint32_t first = map->vertex[v].out;
    uint32_t h = first;
    while (h != NOWHERE && !(h & 1)) {
        const uint32_t own = map->edge[h >> 1].line;
        const int turn = sunder_i_line_turn(map, &map->line[own], &map->line[line]);
        if (turn == 0) {
            *same = h;
            return NOWHERE;
        }
        if (turn < 0) return *lower == NOWHERE ? map->edge[h >> 1].down : map->edge[*lower >> 1].up;
        *lower = h;
        h = *ccw_of(map, h);
        if (h == first) break;
    }
    return *lower == NOWHERE ? map->vertex[v].right : map->edge[*lower >> 1].up;
}

uint32_t sunder_i_edge_isolated(sunder_i_planar_map *map, uint32_t t, const sunder_i_site *site)
{
    if (!sunder_i_map_room(map, 1, 0, 1, 2)) return NOWHERE;
    const uint32_t v = sunder_i_map_new_vertex(map, site);
    sunder_i_trapezoid_split(map, t, v, SUNDER_I_WALL_INSIDE);
    return v;
}

/* Returns the trapezoid above (else below) edge e whose walls have v between them. */
static uint32_t trapezoid_beside(sunder_i_planar_map *map, uint32_t e, uint32_t v, bool above)
{
    uint32_t t = above ? map->edge[e].up : map->edge[e].down;
    const uint32_t end = map->edge[e].end[1];
    while (map->trapezoid[t].right != end &&
           sunder_i_site_cmp(map, &map->vertex[map->trapezoid[t].right].site, &map->vertex[v].site) < 0)
        t = above ? map->trapezoid[t].rl : map->trapezoid[t].ru;
    return t;
}

/* Sets the edge of the trapezoids along e, from t to the one that ends at vertex `end`, to g. */
static void relabel_row(sunder_i_planar_map *map, uint32_t t, uint32_t g, uint32_t end, bool above)
{
    for (;;) {
        sunder_i_trapezoid *z = &map->trapezoid[t];
        *(above ? &z->bottom : &z->top) = g;
        if (z->right == end) return;
        t = above ? z->rl : z->ru;
    }
}

uint32_t sunder_i_edge_split(sunder_i_planar_map *map, uint32_t e, const sunder_i_site *site, uint32_t hint)
{
    if (!sunder_i_map_room(map, 1, 1, 2, 4)) return NOWHERE;
    const uint32_t v = sunder_i_map_new_vertex(map, site), g = sunder_i_map_new_edge(map);
    const uint32_t end = map->edge[e].end[1];
    const uint32_t t = hint != NOWHERE && map->trapezoid[hint].bottom == e ? hint : trapezoid_beside(map, e, v, true);
    const uint32_t upper = sunder_i_trapezoid_split(map, t, v, SUNDER_I_WALL_ON_BOTTOM);
    const uint32_t b = hint != NOWHERE && map->trapezoid[hint].top == e ? hint : trapezoid_beside(map, e, v, false);
    const uint32_t lower = sunder_i_trapezoid_split(map, b, v, SUNDER_I_WALL_ON_TOP);
    sunder_i_map_edge *old = &map->edge[e], *part = &map->edge[g];
    *part = *old;
    part->end[0] = old->end[1] = v;
    part->up = upper;
    part->down = lower;
    relabel_row(map, upper, g, end, true);
    relabel_row(map, lower, g, end, false);
    ring_replace(map, 2 * e + 1, 2 * g + 1, end);
    map->vertex[v].out = 2 * g;
    ring_add(map, 2 * g, NOWHERE);
    ring_add(map, 2 * e + 1, 2 * g);
    map->vertex[v].below = old->sides[1];
    return v;
}

uint32_t sunder_i_edge_make(sunder_i_planar_map *map, uint32_t v, uint32_t w, uint32_t lower, uint32_t line,
                            uint32_t up, uint32_t down)
{
    if (!sunder_i_map_room(map, 0, 1, 1, map->crossed.n + 1)) return NOWHERE;
    const uint32_t e = sunder_i_map_new_edge(map);
    sunder_i_map_edge *edge = &map->edge[e];
    edge->end[0] = v;
    edge->end[1] = w;
    edge->line = line;
    edge->sides[0] = up;
    edge->sides[1] = down;
    const uint32_t first = map->vertex[v].out;
    if (lower != NOWHERE)
        ring_add(map, 2 * e, lower);
    else {
        ring_add(map, 2 * e, first == NOWHERE ? NOWHERE : *cw_of(map, first));
        map->vertex[v].out = 2 * e;
    }
    const sunder_i_trapezoid *last = &map->trapezoid[map->crossed.item[map->crossed.n - 1]];
    const uint32_t at_w = map->vertex[w].out;
    if (last->top != NOWHERE && map->edge[last->top].end[1] == w)
        ring_add(map, 2 * e + 1, 2 * last->top + 1);
    else if (last->bottom != NOWHERE && map->edge[last->bottom].end[1] == w) {
        const uint32_t next = 2 * last->bottom + 1;
        ring_add(map, 2 * e + 1, *cw_of(map, next));
        if (at_w == next) map->vertex[w].out = 2 * e + 1;
    } else { /* it is the only half-edge to the left, so that it is the last one */
        ring_add(map, 2 * e + 1, at_w == NOWHERE ? NOWHERE : *cw_of(map, at_w));
        if (at_w == NOWHERE) map->vertex[w].out = 2 * e + 1;
    }
    sunder_i_trapezoid_draw(map, e);
    return e;
}

bool sunder_i_edge_remove(sunder_i_planar_map *map, uint32_t e)
{
    if (!sunder_i_trapezoid_erase(map, e)) return false;
    ring_remove(map, 2 * e, map->edge[e].end[0]);
    ring_remove(map, 2 * e + 1, map->edge[e].end[1]);
    sunder_i_map_free_edge(map, e);
    return true;
}

void sunder_i_edge_drop_vertex(sunder_i_planar_map *map, uint32_t v)
{
    sunder_i_trapezoid_join(map, map->vertex[v].left, map->vertex[v].right);
    map->vertex[v].alive = false;
    map->dead_vertices++;
}

void sunder_i_edge_merge(sunder_i_planar_map *map, uint32_t v)
{
    const uint32_t g = map->vertex[v].out >> 1, e = *ccw_of(map, 2 * g) >> 1, end = map->edge[g].end[1];
    const uint32_t upper = map->trapezoid[map->edge[g].up].lu, lower = map->trapezoid[map->edge[g].down].ll;
    relabel_row(map, map->edge[g].up, e, end, true);
    relabel_row(map, map->edge[g].down, e, end, false);
    sunder_i_trapezoid_join(map, upper, map->edge[g].up);
    sunder_i_trapezoid_join(map, lower, map->edge[g].down);
    map->edge[e].end[1] = end;
    ring_replace(map, 2 * g + 1, 2 * e + 1, end);
    sunder_i_map_free_edge(map, g);
    map->vertex[v].alive = false;
    map->vertex[v].out = NOWHERE;
    map->dead_vertices++;
}
