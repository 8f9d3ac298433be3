/* The inside of a planar map: what its files hand each other.
 *
 * sites.c           sites, lines, and the three questions about them
 * map.c             making, freeing, growing, looking
 * history.c         from a point to its trapezoid
 * trapezoids.c      the vertical decomposition: walls put up at a vertex, a segment drawn in
 * merging.c         the reverse: a segment taken out, walls taken down
 * edges.c           half-edges around a vertex; an edge split, joined, made, removed, with the trapezoids
 * insert_segment.c  the walk of a segment through the map
 * polygon.c         a convex polygon, as two chains of segments
 * overlay.c         a map into another; a map made anew
 * mark.c            covered counts
 * clean_map.c       what is covered goes; unite.c: the same where a polygon was added, the step of the incremental
 *                   union
 * faces.c, locate.c, map_invariants.c
 *
 * Trapezoids. A wall goes up and down from each vertex to the next edge. No two vertices are above each other in the
 * sheared order, so each trapezoid has one vertex on its left wall and one on its right wall, and at most two
 * neighbours across each:
 *
 *        ____top____        lu  shares the part of the left wall above `left`, and so the same top
 *    lu |           | ru    ll  shares the part below it, and the same bottom
 *   left*           |
 *    ll |           *right  Where `left` has no edge to its left, lu and ll are one trapezoid. A part of a wall without
 *       |__bottom___| rl    length (the top or bottom starts in `left`) has none: NOWHERE, as at infinity.
 *
 * t.lu = n exactly if n.ru = t, and t.ll = n exactly if n.rl = t.
 *
 * Edges keep their leftmost trapezoids above (`up`) and below (`down`), which have left == end[0]; the others follow by
 * rl, and by ru. A vertex without an edge to the right keeps the one trapezoid right of its wall (`right`), and `left`
 * likewise; with such an edge these fields mean nothing. There are 1 + vertices + edges trapezoids. */
#ifndef SUNDER_I_MAP_H
#define SUNDER_I_MAP_H

#include "base/invariant.h"
#include "base/list.h"
#include "planar_map/planar_map.h"

#include <string.h>

#define NOWHERE SUNDER_I_NOWHERE

/* A point with the nearest doubles to its coordinates (divided by 2^approx_shift of the lattice). */
typedef struct sunder_i_site {
    double ax, ay;
    sunder_i_rational_point at;
} sunder_i_site;

/* A x + B y + C w, 0 on the line and positive above it (left of it as it goes to the lexicographically greater): B > 0,
 * or B = 0 and A < 0. a, b are A and B to within half an ulp each but for one common positive factor, |a|, |b| <= 1;
 * rx, ry the doubles of a site on it. */
typedef struct sunder_i_map_line {
    sunder_i_big abc[3];
    double a, b, rx, ry;
} sunder_i_map_line;

typedef struct sunder_i_map_vertex {
    sunder_i_site site;
    uint32_t out;         /* first half-edge counter-clockwise from straight down; NOWHERE: isolated */
    uint32_t left, right; /* trapezoids, see above */
    uint32_t below;
    uint32_t stamp;
    bool alive; /* the site of a dead one may still part trapezoids in the history */
} sunder_i_map_vertex;

typedef struct sunder_i_map_edge {
    uint32_t end[2]; /* the smaller and the greater end; end[0] NOWHERE: dead, then end[1] is the next dead one */
    uint32_t line;
    uint32_t sides[2], ccw[2], cw[2]; /* of the half-edges 2 e and 2 e + 1 */
    uint32_t up, down;                /* the leftmost trapezoids above and below */
    uint32_t stamp;
} sunder_i_map_edge;

typedef struct sunder_i_trapezoid {
    uint32_t top, bottom; /* edges; NOWHERE at infinity */
    uint32_t left, right; /* vertices; NOWHERE at infinity */
    uint32_t lu, ll, ru, rl;
    uint32_t node; /* its leaf; NOWHERE: dead, then top is the next dead one */
    uint32_t covered;
    uint32_t stamp;
} sunder_i_trapezoid;

/* A node of the history. LEAF: a the trapezoid. ALIAS: go on at a. AT: smaller than vertex `of` (lexicographically) a,
 * else b. BY: below line `of` a, else b. */
enum { SUNDER_I_LEAF, SUNDER_I_ALIAS, SUNDER_I_AT, SUNDER_I_BY };

typedef struct sunder_i_history_node {
    uint32_t kind : 2, of : 30;
    uint32_t a, b;
} sunder_i_history_node;

struct sunder_i_planar_map {
    sunder_i_lattice *lattice;
    sunder_i_arena arena, scratch; /* numbers that stay, and intermediates */
    uint64_t random;
    bool failed; /* memory is out; see sunder_i_map_broken() */
    bool marked; /* covered counts are right */
    uint32_t stamp;

    sunder_i_map_vertex *vertex;
    sunder_i_map_edge *edge;
    sunder_i_map_line *line;
    sunder_i_trapezoid *trapezoid;
    sunder_i_history_node *node;
    uint32_t vertices, edges, lines, trapezoids, nodes; /* slots in use */
    size_t vertex_capacity, edge_capacity, line_capacity, trapezoid_capacity, node_capacity;
    uint32_t dead_vertices, dead_edges, dead_trapezoids;
    uint32_t free_edge, free_trapezoid;
    size_t number_bytes; /* of the limbs of vertices and lines */

    sunder_i_list crossed;              /* of the walk: trapezoids that the piece at hand runs through */
    sunder_i_list ring;                 /* half-edges of the polygon inserted last, the polygon on their left */
    sunder_i_list above, beneath, made; /* of merging.c */
    sunder_i_list stack, inside, edges_inside, vertices_inside; /* of floods and cleaning */

    bool faces_valid;
    uint32_t faces;
    uint32_t *face_of_trapezoid, *face_outer, *face_covered;
    uint32_t *inner, *isolated;
    size_t *inner_end, *isolated_end; /* by face */
};

/* ---- sites.c ---- */

int sunder_i_site_cmp_exact(sunder_i_planar_map *map, const sunder_i_site *p, const sunder_i_site *q);
/* Lexicographic order. Rounding to nearest is monotone, so unequal doubles decide; equal ones decide nothing. */
static inline int sunder_i_site_cmp(sunder_i_planar_map *map, const sunder_i_site *p, const sunder_i_site *q)
{
    map->lattice->counts.comparisons++;
    if (p->ax != q->ax) return p->ax < q->ax ? -1 : 1;
    return sunder_i_site_cmp_exact(map, p, q);
}
/* +1 above the line, -1 below, 0 on it. */
int sunder_i_site_side(sunder_i_planar_map *map, const sunder_i_map_line *line, const sunder_i_site *p);
/* +1 if g turns left of f (is steeper in the sheared order), 0 if they are parallel. */
int sunder_i_line_turn(sunder_i_planar_map *map, const sunder_i_map_line *f, const sunder_i_map_line *g);
/* Where two lines that are not parallel cross; in the arena given. */
sunder_i_site sunder_i_line_crossing(sunder_i_planar_map *map, const sunder_i_map_line *f, const sunder_i_map_line *g,
                                     sunder_i_arena *arena);
/* The site of a point; its numbers stay where they are. */
sunder_i_site sunder_i_site_of(sunder_i_planar_map *map, sunder_i_rational_point at);
/* The line through p and q, p < q, its numbers in the arena given; with along != NULL its direction is that of the
 * lattice vector or its reverse. */
sunder_i_map_line sunder_i_line_through(sunder_i_planar_map *map, const sunder_i_site *p, const sunder_i_site *q,
                                        const sunder_i_point *along, sunder_i_arena *arena);
/* The same with numbers of its own. */
sunder_i_site sunder_i_site_copy(const sunder_i_site *from, sunder_i_arena *arena);
sunder_i_map_line sunder_i_line_copy(const sunder_i_map_line *from, sunder_i_arena *arena);

/* ---- map.c ---- */

/* Has memory run out, here or on an arena in use? */
static inline bool sunder_i_map_broken(sunder_i_planar_map *map)
{
    map->failed = map->failed || map->arena.failed || map->scratch.failed || map->lattice->arena.failed;
    return map->failed;
}
/* SUNDER_OK, or the failure of a broken map. */
sunder_status sunder_i_map_status(sunder_i_planar_map *map, sunder_error *err);
/* Reserves room for more elements; pointers into the arrays are stale afterwards. */
bool sunder_i_map_room(sunder_i_planar_map *map, size_t vertices, size_t edges, size_t trapezoids, size_t nodes);
bool sunder_i_map_push(sunder_i_planar_map *map, sunder_i_list *list, uint32_t item);
/* New ones, within the room made. */
uint32_t sunder_i_map_new_vertex(sunder_i_planar_map *map, const sunder_i_site *site);
uint32_t sunder_i_map_new_edge(sunder_i_planar_map *map);
uint32_t sunder_i_map_new_trapezoid(sunder_i_planar_map *map);
void sunder_i_map_free_edge(sunder_i_planar_map *map, uint32_t e);
void sunder_i_map_free_trapezoid(sunder_i_planar_map *map, uint32_t t);
/* NOWHERE if memory is out. */
uint32_t sunder_i_map_new_line(sunder_i_planar_map *map, const sunder_i_map_line *line);
/* The trapezoid right below v, on the right of its wall. */
uint32_t sunder_i_map_below_vertex(const sunder_i_planar_map *map, uint32_t v);
/* The trapezoid at the smaller end of h, on its left. */
static inline uint32_t sunder_i_map_left_of(const sunder_i_planar_map *map, uint32_t h)
{
    return h & 1 ? map->edge[h >> 1].down : map->edge[h >> 1].up;
}
void sunder_i_map_drop_faces(sunder_i_planar_map *map);

/* ---- history.c ---- */

/* A new leaf for the trapezoid (which learns it). Within the room made. */
uint32_t sunder_i_history_leaf(sunder_i_planar_map *map, uint32_t trapezoid);
void sunder_i_history_at(sunder_i_planar_map *map, uint32_t node, uint32_t vertex, uint32_t smaller, uint32_t greater);
void sunder_i_history_by(sunder_i_planar_map *map, uint32_t node, uint32_t line, uint32_t below, uint32_t above);
void sunder_i_history_alias(sunder_i_planar_map *map, uint32_t node, uint32_t to);
/* Turns `node` into a balanced tree over the trapezoids t[0 .. n - 1], which stand from left to right. Needs n nodes of
 * room. */
void sunder_i_history_row(sunder_i_planar_map *map, uint32_t node, const uint32_t *t, size_t n);
/* The trapezoid that contains a point; for a point on a wall or an edge the one right of and above it: so a vertex at
 * the point is its `left`, and an edge through it its `bottom`. */
uint32_t sunder_i_history_find(sunder_i_planar_map *map, const sunder_i_site *p);

/* ---- trapezoids.c ---- */

typedef enum sunder_i_wall { SUNDER_I_WALL_INSIDE, SUNDER_I_WALL_ON_BOTTOM, SUNDER_I_WALL_ON_TOP } sunder_i_wall;

/* a and b, left and right of a wall, are neighbours across its upper (lower) part; one of them may be NOWHERE. */
void sunder_i_trapezoid_link(sunder_i_planar_map *map, uint32_t a, uint32_t b, bool upper);
/* The upper (lower) part of a wall stays as it was, but on its left a takes the place of `before`, and on its right b
 * that of trapezoid `after`, which was *old_after. They may have been neighbours there, or each another's. */
void sunder_i_trapezoid_pass(sunder_i_planar_map *map, const sunder_i_trapezoid *before, uint32_t after,
                             const sunder_i_trapezoid *old_after, uint32_t a, uint32_t b, bool upper);
/* Tells the trapezoid's vertices and edges that it is there. */
void sunder_i_trapezoid_install(sunder_i_planar_map *map, uint32_t t);
/* Puts up the wall of vertex v in t, which keeps its left part; returns the right part. Room: 1 trapezoid, 2 nodes. */
uint32_t sunder_i_trapezoid_split(sunder_i_planar_map *map, uint32_t t, uint32_t v, sunder_i_wall wall);
/* Draws edge e (its end, line and sides are set) through the trapezoids of map->crossed, from the one right of end[0]
 * to the one left of end[1]. Room: 1 trapezoid, crossed.n + 1 nodes. */
void sunder_i_trapezoid_draw(sunder_i_planar_map *map, uint32_t e);

/* ---- merging.c ---- */

/* Takes edge e out. Makes its own room. */
bool sunder_i_trapezoid_erase(sunder_i_planar_map *map, uint32_t e);
/* Takes down the wall between t and r, its neighbour on the right that shares top and bottom; t becomes both. */
void sunder_i_trapezoid_join(sunder_i_planar_map *map, uint32_t t, uint32_t r);

/* ---- edges.c ---- */

/* The first trapezoid right of v for a segment on that line to the right. *lower is the half-edge right below it there,
 * or NOWHERE; *same the one on the line itself: then there is no such trapezoid. */
uint32_t sunder_i_edge_wedge(sunder_i_planar_map *map, uint32_t v, uint32_t line, uint32_t *lower, uint32_t *same);
/* A vertex inside trapezoid t. */
uint32_t sunder_i_edge_isolated(sunder_i_planar_map *map, uint32_t t, const sunder_i_site *site);
/* A vertex on edge e, which keeps its smaller part. hint: a trapezoid along e with the site at its top or bottom. */
uint32_t sunder_i_edge_split(sunder_i_planar_map *map, uint32_t e, const sunder_i_site *site, uint32_t hint);
/* The edge from v to w through map->crossed; lower as from sunder_i_edge_wedge(). */
uint32_t sunder_i_edge_make(sunder_i_planar_map *map, uint32_t v, uint32_t w, uint32_t lower, uint32_t line,
                            uint32_t up, uint32_t down);
bool sunder_i_edge_remove(sunder_i_planar_map *map, uint32_t e);
void sunder_i_edge_drop_vertex(sunder_i_planar_map *map, uint32_t v); /* isolated */
void sunder_i_edge_merge(sunder_i_planar_map *map, uint32_t v);       /* mergeable */

/* ---- insert_segment.c ---- */

/* The vertex at a site (numbers in map->arena), made where there is none. NOWHERE if memory is out. */
uint32_t sunder_i_map_vertex_at(sunder_i_planar_map *map, const sunder_i_site *site);
/* The same in the trapezoid that the history leads to. */
uint32_t sunder_i_map_vertex_in(sunder_i_planar_map *map, uint32_t t, const sunder_i_site *site);
/* Follows the segment from a point inside trapezoid *t, or at its left wall, to a site further right, drawing nothing.
 * For each trapezoid entered 2 * its id + (is it below the wall's vertex that it is entered?) goes to the list, and *t
 * is the last one. False at the first vertex or edge in the way. */
bool sunder_i_map_glide(sunder_i_planar_map *map, uint32_t *t, const sunder_i_site *target,
                        const sunder_i_map_line *line, sunder_i_list *list);
/* Walks from vertex v to a site to the right of it (whose numbers are in map->arena), along the line through both, and
 * draws the edges. Returns the vertex there. up, down: regions that end here from above and from below. record: edges
 * go to map->ring, as the half-edges with the region on their left. */
uint32_t sunder_i_map_walk(sunder_i_planar_map *map, uint32_t v, const sunder_i_site *target, uint32_t line,
                           uint32_t up, uint32_t down, bool record);

/* ---- clean_map.c ---- */

/* Counts of an edge and of a vertex that stay, for the union as one region. */
void sunder_i_map_settle_edge(sunder_i_planar_map *map, uint32_t e);
void sunder_i_map_settle_vertex(sunder_i_planar_map *map, uint32_t v);
/* Removes the edges of edges_inside and then the vertices of vertices_inside, all covered; all faces around count 1
 * already. */
bool sunder_i_map_remove_covered(sunder_i_planar_map *map);

/* ---- polygon.c, mark.c ---- */

/* insert_polygon(), for unite_polygon(): the map is clean and counts are right. Then a polygon that a covered face
 * contains is left out, and map->ring is empty; else it holds the polygon's boundary. */
sunder_status sunder_i_map_polygon(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                                   const sunder_i_point *along, size_t n, bool unite, sunder_error *err);
/* What lies across walls from t, and across edges where t is the leftmost one along them: n of at most 6. step[i] is
 * covered(to[i]) - covered(t) as the sides say. With stop != 0, edges of that stamp are not crossed. */
size_t sunder_i_map_around(const sunder_i_planar_map *map, uint32_t t, uint32_t stop, uint32_t to[6], int64_t step[6]);

/* ---- overlay.c ---- */

/* Begins the map anew: with what is alive; and where its past outweighs it. False if memory is out. */
bool sunder_i_map_renew(sunder_i_planar_map *map);
bool sunder_i_map_compact(sunder_i_planar_map *map);

#endif
