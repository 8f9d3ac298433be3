/* map_invariants.c: tests every invariant exactly; README.md lists them.
 *
 * The geometry is proved by the trapezoids: each is bounded by a bottom strictly below its top over its whole width,
 * has its vertices on its walls, and refers to the neighbour at each part of a wall that has length, which refers back.
 * The trapezoids along each side of each edge follow each other from end to end. Their number is correct. So they tile
 * the plane, and no edge meets another except at a common end. */
#include "planar_map/map.h"

#define REQUIRE(condition, sentence)                                                                                   \
    do {                                                                                                               \
        if (!(condition)) return sentence;                                                                             \
    } while (0)

static int cmp_vertices(sunder_i_planar_map *map, uint32_t v, uint32_t w)
{
    return sunder_i_planar_map_vertex_cmp(map, v, w);
}

static int side_of(sunder_i_planar_map *map, uint32_t e, uint32_t v)
{
    return sunder_i_site_side(map, &map->line[map->edge[e].line], &map->vertex[v].site);
}

static int turn_of(sunder_i_planar_map *map, uint32_t e, uint32_t f)
{
    return sunder_i_line_turn(map, &map->line[map->edge[e].line], &map->line[map->edge[f].line]);
}

static const char *check_edge(sunder_i_planar_map *map, uint32_t e)
{
    const sunder_i_map_edge *edge = &map->edge[e];
    REQUIRE(edge->end[1] < map->vertices && map->vertex[edge->end[0]].alive && map->vertex[edge->end[1]].alive,
            "an edge ends in a vertex that is not there");
    REQUIRE(cmp_vertices(map, edge->end[0], edge->end[1]) < 0,
            "an edge does not go from its smaller end to its greater");
    REQUIRE(side_of(map, e, edge->end[0]) == 0 && side_of(map, e, edge->end[1]) == 0,
            "an end is not on its edge's line");
    for (uint32_t i = 0; i < 2; i++) {
        const uint32_t h = 2 * e + i, next = sunder_i_planar_map_next(map, h);
        REQUIRE(edge->ccw[i] >> 1 < map->edges && edge->cw[i] >> 1 < map->edges,
                "a half-edge's neighbour is not there");
        REQUIRE(map->edge[edge->ccw[i] >> 1].cw[edge->ccw[i] & 1] == h,
                "half-edges around a vertex do not follow each other");
        REQUIRE(sunder_i_planar_map_origin(map, edge->ccw[i]) == edge->end[i], "a half-edge is at another's vertex");
        REQUIRE(sunder_i_planar_map_origin(map, next) == edge->end[!i] && sunder_i_planar_map_prev(map, next) == h,
                "next and prev disagree");
    }
    const sunder_i_map_line *l = &map->line[edge->line];
    const int b = sunder_i_big_sign(l->abc[1]);
    REQUIRE(b > 0 || (b == 0 && sunder_i_big_sign(l->abc[0]) < 0), "a line points to the smaller end");
    return NULL;
}

/* Adds the number of half-edges around v to *n. */
static const char *check_vertex(sunder_i_planar_map *map, uint32_t v, size_t *n)
{
    const sunder_i_map_vertex *vertex = &map->vertex[v];
    REQUIRE(sunder_i_big_sign(vertex->site.at.w) > 0, "a vertex at infinity");
    const uint32_t first = vertex->out;
    size_t to_right = 0, to_left = 0;
    if (first != NOWHERE) {
        uint32_t h = first, before = NOWHERE;
        do {
            REQUIRE(sunder_i_planar_map_edge_alive(map, h >> 1) && sunder_i_planar_map_origin(map, h) == v,
                    "a vertex has a half-edge that is not its own");
            REQUIRE(!to_left || (h & 1), "half-edges around a vertex are out of order");
            if (before != NOWHERE && (before & 1) == (h & 1))
                REQUIRE(turn_of(map, before >> 1, h >> 1) > 0,
                        "half-edges around a vertex are not in order of their slopes");
            (*(h & 1 ? &to_left : &to_right))++;
            before = h;
            h = sunder_i_planar_map_ccw(map, h);
        } while (h != first && to_left + to_right <= 2 * (size_t)map->edges);
        *n += to_left + to_right;
    }
    if (!to_right)
        REQUIRE(vertex->right < map->trapezoids && map->trapezoid[vertex->right].node != NOWHERE &&
                    map->trapezoid[vertex->right].left == v,
                "a vertex does not know the trapezoid right of it");
    if (!to_left)
        REQUIRE(vertex->left < map->trapezoids && map->trapezoid[vertex->left].node != NOWHERE &&
                    map->trapezoid[vertex->left].right == v,
                "a vertex does not know the trapezoid left of it");
    if (map->marked)
        REQUIRE(vertex->below <= map->trapezoid[sunder_i_map_below_vertex(map, v)].covered,
                "a vertex bounds more regions below it than there are");
    return NULL;
}

/* Tests n, one of the four neighbours of t: that at the part of the wall of vertex v next to edge e (the top if
 * `upper`, else the bottom). ends: whether e starts (ends) at v, so that this part has no length. */
static const char *check_neighbour(sunder_i_planar_map *map, uint32_t t, uint32_t n, uint32_t v, bool ends, bool left,
                                   bool upper)
{
    REQUIRE((n != NOWHERE) == (v != NOWHERE && !ends), "a neighbour is missing, or one is too many");
    if (n == NOWHERE) return NULL;
    REQUIRE(n < map->trapezoids && map->trapezoid[n].node != NOWHERE, "a neighbour is gone");
    const sunder_i_trapezoid *z = &map->trapezoid[t], *y = &map->trapezoid[n];
    REQUIRE((left ? y->right : y->left) == v, "a neighbour is at another vertex");
    if (left)
        REQUIRE((upper ? y->ru : y->rl) == t, "a neighbour on the left does not know its neighbour");
    else
        REQUIRE((upper ? y->lu : y->ll) == t, "a neighbour on the right does not know its neighbour");
    const uint32_t e = upper ? z->top : z->bottom, f = upper ? y->top : y->bottom;
    REQUIRE(e == f, "neighbours do not share their edge");
    if (map->marked) REQUIRE(y->covered == z->covered, "covered differs across a wall");
    return NULL;
}

/* Tests the left or right wall of t, with the vertex v: v is on the wall, and not on the top or bottom unless these end
 * there. */
static const char *check_wall(sunder_i_planar_map *map, uint32_t t, bool left)
{
    const sunder_i_trapezoid *z = &map->trapezoid[t];
    const uint32_t v = left ? z->left : z->right, at = left ? 0 : 1;
    if (v == NOWHERE) {
        REQUIRE(z->top == NOWHERE && z->bottom == NOWHERE, "an edge goes to infinity");
    } else
        REQUIRE(v < map->vertices && map->vertex[v].alive, "a wall at a vertex that is not there");
    const bool top_ends = v != NOWHERE && z->top != NOWHERE && map->edge[z->top].end[at] == v;
    const bool bottom_ends = v != NOWHERE && z->bottom != NOWHERE && map->edge[z->bottom].end[at] == v;
    if (v != NOWHERE && z->top != NOWHERE && !top_ends) {
        REQUIRE(side_of(map, z->top, v) < 0, "a wall's vertex is not below the top");
        REQUIRE(cmp_vertices(map, map->edge[z->top].end[0], v) < 0 &&
                    cmp_vertices(map, v, map->edge[z->top].end[1]) < 0,
                "a top does not reach as far as its trapezoid");
    }
    if (v != NOWHERE && z->bottom != NOWHERE && !bottom_ends) {
        REQUIRE(side_of(map, z->bottom, v) > 0, "a wall's vertex is not above the bottom");
        REQUIRE(cmp_vertices(map, map->edge[z->bottom].end[0], v) < 0 &&
                    cmp_vertices(map, v, map->edge[z->bottom].end[1]) < 0,
                "a bottom does not reach as far as its trapezoid");
    }
    if (top_ends && bottom_ends)
        REQUIRE(turn_of(map, z->bottom, z->top) == (left ? 1 : -1), "a trapezoid's bottom is above its top");
    const char *wrong = check_neighbour(map, t, left ? z->lu : z->ru, v, top_ends, left, true);
    if (!wrong) wrong = check_neighbour(map, t, left ? z->ll : z->rl, v, bottom_ends, left, false);
    if (wrong || v == NOWHERE || top_ends || bottom_ends) return wrong;
    /* Both parts have length: there is one neighbour exactly if the vertex has no edge on that side. */
    const uint32_t upper = left ? z->lu : z->ru, lower = left ? z->ll : z->rl;
    bool edges = false;
    uint32_t h = map->vertex[v].out;
    if (h != NOWHERE) {
        do {
            edges = edges || ((h & 1) == left);
            h = sunder_i_planar_map_ccw(map, h);
        } while (h != map->vertex[v].out);
    }
    REQUIRE((upper == lower) == !edges, "a wall has one neighbour and its vertex an edge there, or two and none");
    return NULL;
}

/* Tests that the history finds t for a point of t: the midpoint of its two vertices, or a point beside its only vertex.
 * A point on the bottom counts as above it, one on the top does not belong to t. */
static const char *check_history(sunder_i_planar_map *map, uint32_t t)
{
    const sunder_i_trapezoid *z = &map->trapezoid[t];
    sunder_i_arena *s = &map->scratch;
    const sunder_i_mark mark = sunder_i_arena_mark(s);
    const sunder_i_big one = sunder_i_big_i64(s, 1), none = sunder_i_big_i64(s, 0);
    sunder_i_rational_point p = {none, none, one};
    if (z->left != NOWHERE && z->right != NOWHERE) {
        p = sunder_i_rational_add(s, map->vertex[z->left].site.at, map->vertex[z->right].site.at);
        p.w = sunder_i_big_shl(s, p.w, 1);
    } else if (z->left != NOWHERE || z->right != NOWHERE) {
        p = map->vertex[z->left != NOWHERE ? z->left : z->right].site.at;
        p.x = z->left != NOWHERE ? sunder_i_big_add(s, p.x, p.w) : sunder_i_big_sub(s, p.x, p.w);
    }
    const sunder_i_site site = sunder_i_site_of(map, p);
    const char *wrong = NULL;
    if (z->bottom != NOWHERE && sunder_i_site_side(map, &map->line[map->edge[z->bottom].line], &site) < 0)
        wrong = "a point between the walls of a trapezoid is below its bottom";
    const int top = z->top == NOWHERE ? -1 : sunder_i_site_side(map, &map->line[map->edge[z->top].line], &site);
    if (top > 0) wrong = "a point between the walls of a trapezoid is above its top";
    if (!wrong && top < 0 && sunder_i_history_find(map, &site) != t)
        wrong = "the history leads a point of a trapezoid to another";
    sunder_i_arena_release(s, mark);
    return wrong;
}

/* Tests the trapezoids along one side of edge e, from end to end; adds their number to *n. */
static const char *check_row(sunder_i_planar_map *map, uint32_t e, bool above, size_t *n)
{
    const sunder_i_map_edge *edge = &map->edge[e];
    uint32_t t = above ? edge->up : edge->down, at = edge->end[0];
    const uint32_t covered = t < map->trapezoids ? map->trapezoid[t].covered : 0;
    for (;;) {
        REQUIRE(t < map->trapezoids && map->trapezoid[t].node != NOWHERE,
                "an edge has a trapezoid along it that is gone");
        const sunder_i_trapezoid *z = &map->trapezoid[t];
        REQUIRE((above ? z->bottom : z->top) == e, "a trapezoid along an edge has another edge");
        REQUIRE(z->left == at, "trapezoids along an edge do not follow each other");
        REQUIRE(!map->marked || z->covered == covered, "covered differs along an edge");
        at = z->right;
        (*n)++;
        if (at == edge->end[1]) return NULL;
        t = above ? z->rl : z->ru;
    }
}

static const char *check_counts(sunder_i_planar_map *map, uint32_t e)
{
    const sunder_i_map_edge *edge = &map->edge[e];
    const uint32_t up = map->trapezoid[edge->up].covered, down = map->trapezoid[edge->down].covered;
    REQUIRE(edge->sides[0] <= up && edge->sides[1] <= down && up - edge->sides[0] == down - edge->sides[1],
            "covered does not differ across an edge by what ends there");
    return NULL;
}

static const char *check_faces(sunder_i_planar_map *map)
{
    REQUIRE(map->face_outer[0] == NOWHERE, "the outermost face has an outer boundary");
    for (uint32_t f = 1; f < map->faces; f++) REQUIRE(map->face_outer[f] != NOWHERE, "a face has no outer boundary");
    /* There are as many cycles as boundaries: one outer one for each face. Euler's formula is V - E + F = 1 +
     * components; each component has one inner boundary or is one isolated vertex. */
    const size_t inner = map->inner_end[map->faces - 1], isolated = map->isolated_end[map->faces - 1];
    const size_t vertices = map->vertices - map->dead_vertices, edges = map->edges - map->dead_edges;
    REQUIRE(vertices + map->faces == edges + 1 + inner + isolated, "faces, edges and vertices do not agree with Euler");
    return NULL;
}

const char *sunder_i_planar_map_check(sunder_i_planar_map *map)
{
    if (sunder_i_map_broken(map)) return "memory ran out";
    const char *wrong = NULL;
    size_t ring = 0, rows[2] = {0, 0}, tops = 0, bottoms = 0, trapezoids = 0, edges = 0, vertices = 0;
    for (uint32_t e = 0; e < map->edges && !wrong; e++) {
        if (map->edge[e].end[0] == NOWHERE) continue;
        edges++;
        wrong = check_edge(map, e);
    }
    for (uint32_t v = 0; v < map->vertices && !wrong; v++) {
        if (!map->vertex[v].alive) continue;
        vertices++;
        wrong = check_vertex(map, v, &ring);
    }
    for (uint32_t t = 0; t < map->trapezoids && !wrong; t++) {
        const sunder_i_trapezoid *z = &map->trapezoid[t];
        if (z->node == NOWHERE) continue;
        trapezoids++;
        tops += z->top != NOWHERE;
        bottoms += z->bottom != NOWHERE;
        if ((z->top != NOWHERE && !sunder_i_planar_map_edge_alive(map, z->top)) ||
            (z->bottom != NOWHERE && !sunder_i_planar_map_edge_alive(map, z->bottom)))
            return "a trapezoid has an edge that is gone";
        if (z->left != NOWHERE && z->right != NOWHERE && cmp_vertices(map, z->left, z->right) >= 0)
            return "a trapezoid has its right wall left of its left one";
        if (map->node[z->node].kind != SUNDER_I_LEAF || map->node[z->node].a != t)
            return "a trapezoid's leaf is not its own";
        wrong = check_wall(map, t, true);
        if (!wrong) wrong = check_wall(map, t, false);
        if (!wrong) wrong = check_history(map, t);
    }
    for (uint32_t e = 0; e < map->edges && !wrong; e++) {
        if (map->edge[e].end[0] == NOWHERE) continue;
        wrong = check_row(map, e, true, &rows[0]);
        if (!wrong) wrong = check_row(map, e, false, &rows[1]);
        if (!wrong && map->marked) wrong = check_counts(map, e);
    }
    if (wrong) return wrong;
    REQUIRE(edges == map->edges - map->dead_edges && vertices == map->vertices - map->dead_vertices &&
                trapezoids == map->trapezoids - map->dead_trapezoids,
            "dead ones are counted wrongly");
    REQUIRE(ring == 2 * edges, "a half-edge is not at its vertex");
    REQUIRE(rows[0] == bottoms && rows[1] == tops, "a trapezoid is not along its edge");
    REQUIRE(trapezoids == 1 + vertices + edges, "there are too many trapezoids, or too few");
    if (map->faces_valid) wrong = check_faces(map);
    return sunder_i_map_broken(map) ? "memory ran out" : wrong;
}

const char *sunder_i_planar_map_sound(sunder_i_planar_map *map)
{
    if (sunder_i_map_broken(map)) return NULL;
    const sunder_counts counts = map->lattice->counts;
    const char *wrong = sunder_i_planar_map_check(map);
    map->lattice->counts = counts;
    return sunder_i_map_broken(map) ? NULL : wrong;
}
