/* insert_segment.c: inserts a segment into the map.
 *
 * A segment is inserted from its smaller end to its greater one. At a vertex the segment either runs along an existing
 * edge (an overlap: the edge's counts increase, and it is split if the segment ends inside it) or enters a trapezoid.
 * It then passes from wall to wall to the first of
 *   its end, inside a trapezoid, on an edge or at a vertex;
 *   a vertex through which it passes;
 *   an edge that it crosses, which is split there;
 * the piece up to there becomes an edge, and the insertion continues from that vertex. So every crossing is a vertex
 * before the next piece begins, and the trapezoids through which a piece passes contain nothing of the map except their
 * walls.
 *
 * Degenerate positions: vertical segments: the sheared order treats them as steep ones. Many segments through one
 * point: each finds the vertex there (side 0). Overlaps: a segment that is parallel to an edge at a common vertex runs
 * along it. Ends on edges: the edge is split. Ends at vertices: equal sites. No decision depends on a distance. */
#include "planar_map/map.h"

uint32_t sunder_i_map_vertex_in(sunder_i_planar_map *map, uint32_t t, const sunder_i_site *site)
{
    const sunder_i_trapezoid *z = &map->trapezoid[t];
    if (z->left != NOWHERE && sunder_i_site_cmp(map, &map->vertex[z->left].site, site) == 0) return z->left;
    if (z->bottom != NOWHERE && sunder_i_site_side(map, &map->line[map->edge[z->bottom].line], site) == 0)
        return sunder_i_edge_split(map, z->bottom, site, t);
    return sunder_i_edge_isolated(map, t, site);
}

uint32_t sunder_i_map_vertex_at(sunder_i_planar_map *map, const sunder_i_site *site)
{
    if (sunder_i_map_broken(map)) return NOWHERE;
    return sunder_i_map_vertex_in(map, sunder_i_history_find(map, site), site);
}

/* The end of a piece. */
typedef struct stop {
    enum { AT_VERTEX, ON_EDGE, INSIDE } kind;
    uint32_t id; /* the number of the vertex or edge */
    sunder_i_site
        site;  /* for a stop on an edge or inside a trapezoid: the target, or a crossing with numbers in the scratch
                * arena */
    bool done; /* whether the stop is the target */
} stop;

/* A cache: results about an edge and the segment in one trapezoid may be needed in the next trapezoid along the same
 * edge: the side of the edge's greater end, and the crossing of the two. */
typedef struct crossing_cache {
    uint32_t edge, sided; /* the edges for which `site` and `side` are valid; NOWHERE: none */
    int side;
    sunder_i_site site;
} crossing_cache;

static const sunder_i_map_line *line_of(sunder_i_planar_map *map, uint32_t e) { return &map->line[map->edge[e].line]; }

static const sunder_i_site *crossing_of_edge(sunder_i_planar_map *map, uint32_t e, const sunder_i_map_line *line,
                                             crossing_cache *cache)
{
    if (cache->edge != e) {
        cache->edge = e;
        cache->site = sunder_i_line_crossing(map, line_of(map, e), line, &map->scratch);
    }
    return &cache->site;
}

/* The segment passes the right wall of t, whose vertex is above the segment (above = true) or below it. Returns true if
 * the segment leaves t through the edge e on the other side (the bottom, or the top) before the wall. */
static bool leaves_by_edge(sunder_i_planar_map *map, uint32_t t, uint32_t e, const sunder_i_map_line *line, bool above,
                           crossing_cache *cache)
{
    if (e == NOWHERE) return false;
    const uint32_t end = map->edge[e].end[1], wall = map->trapezoid[t].right;
    /* The edge ends at the wall's vertex, on the segment's other side, so it crosses the segment before the wall. */
    if (end == wall) return true;
    if (cache->sided != e) {
        cache->sided = e;
        cache->side = sunder_i_site_side(map, line, &map->vertex[end].site);
    }
    if (cache->side != (above ? 1 : -1)) return false;
    return sunder_i_site_cmp(map, crossing_of_edge(map, e, line, cache), &map->vertex[wall].site) < 0;
}

static void stop_crossing(sunder_i_planar_map *map, uint32_t e, const sunder_i_map_line *line, crossing_cache *cache,
                          stop *s)
{
    s->kind = ON_EDGE;
    s->id = e;
    s->site = *crossing_of_edge(map, e, line, cache);
    s->done = false;
}

/* The target is left of the right wall of t: *s becomes the segment's next stop, which is in t or on its boundary. */
static void stop_before_wall(sunder_i_planar_map *map, uint32_t t, const sunder_i_site *target,
                             const sunder_i_map_line *line, crossing_cache *cache, stop *s)
{
    const uint32_t bottom = map->trapezoid[t].bottom, top = map->trapezoid[t].top;
    *s = (stop){.kind = INSIDE, .id = NOWHERE, .site = *target, .done = true};
    const int over = bottom == NOWHERE ? 1 : sunder_i_site_side(map, line_of(map, bottom), target);
    if (over < 0) {
        stop_crossing(map, bottom, line, cache, s);
    } else if (over == 0) {
        s->kind = ON_EDGE;
        s->id = bottom;
    } else {
        const int under = top == NOWHERE ? -1 : sunder_i_site_side(map, line_of(map, top), target);
        if (under > 0) {
            stop_crossing(map, top, line, cache, s);
        } else if (under == 0) {
            s->kind = ON_EDGE;
            s->id = top;
        }
    }
}

/* Follows the segment from trapezoid t, in which it begins at the left wall's vertex, to its next stop *s; map->crossed
 * becomes the list of the trapezoids through which it passes. Returns false if out of memory. */
static bool follow_segment(sunder_i_planar_map *map, uint32_t t, const sunder_i_site *target,
                           const sunder_i_map_line *line, stop *s)
{
    crossing_cache low = {.edge = NOWHERE, .sided = NOWHERE}, high = low;
    map->crossed.n = 0;
    for (;;) {
        if (!sunder_i_map_push(map, &map->crossed, t) || sunder_i_map_broken(map)) return false;
        const sunder_i_trapezoid *z = &map->trapezoid[t];
        const int c = z->right == NOWHERE ? -1 : sunder_i_site_cmp(map, target, &map->vertex[z->right].site);
        if (c < 0) {
            /* At most one of the two edges is crossed before the target, so that one cache suffices for both. */
            crossing_cache *cache = z->bottom == low.edge ? &low : &high;
            stop_before_wall(map, t, target, line, cache, s);
            return true;
        }
        const int side = c == 0 ? 0 : sunder_i_site_side(map, line, &map->vertex[z->right].site);
        if (side == 0) {
            *s = (stop){.kind = AT_VERTEX, .id = z->right, .done = c == 0};
            return true;
        }
        const uint32_t edge = side > 0 ? z->bottom : z->top;
        crossing_cache *cache = side > 0 ? &low : &high;
        if (leaves_by_edge(map, t, edge, line, side > 0, cache)) {
            stop_crossing(map, edge, line, cache, s);
            return true;
        }
        t = side > 0 ? z->rl : z->ru;
    }
}

bool sunder_i_map_glide(sunder_i_planar_map *map, uint32_t *t, const sunder_i_site *target,
                        const sunder_i_map_line *line, sunder_i_list *list)
{
    crossing_cache low = {.edge = NOWHERE, .sided = NOWHERE}, high = low;
    for (;;) {
        const sunder_i_trapezoid *z = &map->trapezoid[*t];
        const int c = z->right == NOWHERE ? -1 : sunder_i_site_cmp(map, target, &map->vertex[z->right].site);
        if (c < 0)
            return (z->bottom == NOWHERE || sunder_i_site_side(map, line_of(map, z->bottom), target) > 0) &&
                   (z->top == NOWHERE || sunder_i_site_side(map, line_of(map, z->top), target) < 0);
        const int side = c == 0 ? 0 : sunder_i_site_side(map, line, &map->vertex[z->right].site);
        if (side == 0) return false;
        if (leaves_by_edge(map, *t, side > 0 ? z->bottom : z->top, line, side > 0, side > 0 ? &low : &high))
            return false;
        *t = side > 0 ? z->rl : z->ru;
        if (!sunder_i_map_push(map, list, *t << 1 | (side > 0))) return false;
    }
}

/* Returns the vertex at a stop, which is made if it does not exist; NOWHERE if out of memory. */
static uint32_t vertex_at_stop(sunder_i_planar_map *map, stop *s)
{
    if (s->kind == AT_VERTEX) return s->id;
    if (!s->done) /* a crossing; the numbers of the target are permanent already */
        s->site = sunder_i_site_copy(&s->site, &map->arena);
    if (sunder_i_map_broken(map)) return NOWHERE;
    const uint32_t last = map->crossed.item[map->crossed.n - 1];
    return s->kind == ON_EDGE ? sunder_i_edge_split(map, s->id, &s->site, last)
                              : sunder_i_edge_isolated(map, last, &s->site);
}

/* Follows half-edge h = 2 e, which is on the segment's line, to its end, or to the target if that is inside it. Returns
 * the vertex there. *done: whether it is the target. */
static uint32_t run_along(sunder_i_planar_map *map, uint32_t h, const sunder_i_site *target, bool *done)
{
    const uint32_t e = h >> 1, end = map->edge[e].end[1];
    const int c = sunder_i_site_cmp(map, target, &map->vertex[end].site);
    *done = c <= 0;
    if (c >= 0) return end;
    return sunder_i_edge_split(map, e, target, NOWHERE);
}

uint32_t sunder_i_map_walk(sunder_i_planar_map *map, uint32_t v, const sunder_i_site *target, uint32_t line,
                           uint32_t up, uint32_t down, bool record)
{
    for (bool done = false; !done;) {
        if (sunder_i_map_broken(map)) return NOWHERE;
        const sunder_i_mark mark = sunder_i_arena_mark(&map->scratch);
        uint32_t lower, same, e, w;
        const uint32_t t = sunder_i_edge_wedge(map, v, line, &lower, &same);
        if (same != NOWHERE) {
            w = run_along(map, same, target, &done);
            e = same >> 1;
            if (w == NOWHERE) return NOWHERE;
            map->edge[e].sides[0] += up;
            map->edge[e].sides[1] += down;
        } else {
            stop s;
            if (!follow_segment(map, t, target, &map->line[line], &s)) return NOWHERE;
            done = s.done;
            w = vertex_at_stop(map, &s);
            if (w == NOWHERE) return NOWHERE;
            e = sunder_i_edge_make(map, v, w, lower, line, up, down);
            if (e == NOWHERE) return NOWHERE;
        }
        if (!done) map->vertex[w].below += down;
        if (record && !sunder_i_map_push(map, &map->ring, 2 * e + (up == 0))) return NOWHERE;
        sunder_i_arena_release(&map->scratch, mark);
        v = w;
    }
    return v;
}

sunder_status sunder_i_planar_map_insert_point(sunder_i_planar_map *map, sunder_i_rational_point at, uint32_t below,
                                               uint32_t *vertex, sunder_error *err)
{
    sunder_i_map_drop_faces(map);
    map->marked = false;
    const sunder_i_site given = sunder_i_site_of(map, at), site = sunder_i_site_copy(&given, &map->arena);
    const uint32_t v = sunder_i_map_vertex_at(map, &site);
    if (sunder_i_map_broken(map) || v == NOWHERE) return sunder_i_failure_cause(err);
    map->vertex[v].below += below;
    if (vertex) *vertex = v;
    return SUNDER_OK;
}

sunder_status sunder_i_planar_map_insert_segment(sunder_i_planar_map *map, sunder_i_rational_point a,
                                                 sunder_i_rational_point b, uint32_t left, uint32_t right,
                                                 uint32_t *first, uint32_t *last, sunder_error *err)
{
    sunder_i_map_drop_faces(map);
    map->marked = false;
    const sunder_i_site pa = sunder_i_site_of(map, a), p = sunder_i_site_copy(&pa, &map->arena);
    const sunder_i_site qb = sunder_i_site_of(map, b), q = sunder_i_site_copy(&qb, &map->arena);
    const bool forward = sunder_i_site_cmp(map, &p, &q) < 0;
    const sunder_i_site *from = forward ? &p : &q, *to = forward ? &q : &p;
    const sunder_i_map_line through = sunder_i_line_through(map, from, to, NULL, &map->arena);
    if (sunder_i_map_broken(map)) return sunder_i_failure_cause(err);
    const uint32_t line = sunder_i_map_new_line(map, &through);
    const uint32_t v = line == NOWHERE ? NOWHERE : sunder_i_map_vertex_at(map, from);
    const uint32_t w = v == NOWHERE
                           ? NOWHERE
                           : sunder_i_map_walk(map, v, to, line, forward ? left : right, forward ? right : left, false);
    if (sunder_i_map_broken(map) || w == NOWHERE) return sunder_i_failure_cause(err);
    if (first) *first = forward ? v : w;
    if (last) *last = forward ? w : v;
    return SUNDER_OK;
}
