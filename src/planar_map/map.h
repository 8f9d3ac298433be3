/* map.h: the internal declarations of a planar map, shared by its files.
 *
 *   sites.c           sites, lines, and the three tests of them
 *   map.c             construction, destruction, memory, queries
 *   history.c         finds the trapezoid of a point
 *   trapezoids.c      the vertical decomposition: inserts the walls of a vertex, draws a segment
 *   merging.c         the opposite: removes a segment, removes walls
 *   edges.c           half-edges around a vertex; splits, joins, makes and removes edges, with the trapezoids
 *   insert_segment.c  inserts a segment into the map
 *   polygon.c         a convex polygon, as two chains of segments
 *   overlay.c         inserts a map into another; makes a map anew
 *   mark.c            covered counts
 *   clean_map.c       removes covered elements; unite.c: the same after the insertion of a polygon, the step of the
 *                     incremental union
 *   faces.c, locate.c, map_invariants.c
 *
 * Trapezoids. A wall extends up and down from each vertex to the next edge. No two vertices have the same x in the
 * sheared order, so that each trapezoid has one vertex on its left wall and one on its right wall, and at most two
 * neighbours at each:
 *
 *        ____top____        lu  shares the part of the left wall above `left`, and so the same top
 *    lu |           | ru    ll  shares the part below it, and the same bottom
 *   left*           |
 *    ll |           *right  If `left` has no edge to its left, lu and ll are one trapezoid. A part of a wall without
 *       |__bottom___| rl    length (the top or bottom starts in `left`) has no neighbour: NOWHERE, as at infinity.
 *
 * t.lu = n exactly if n.ru = t, and t.ll = n exactly if n.rl = t.
 *
 * Each edge stores its leftmost trapezoids above (`up`) and below (`down`), for which left == end[0]; the others follow
 * by rl, and by ru. A vertex without an edge to the right stores the one trapezoid right of its wall (`right`), and
 * `left` likewise; with such an edge these fields have no meaning. There are 1 + vertices + edges trapezoids. */
#ifndef SUNDER_I_MAP_H
#define SUNDER_I_MAP_H

#include "base/invariant.h"
#include "base/list.h"
#include "planar_map/planar_map.h"

#include <string.h>

#define NOWHERE SUNDER_I_NOWHERE

/* A point, with the doubles nearest to its coordinates divided by 2^approx_shift of the lattice. */
typedef struct sunder_i_site {
    double ax, ay;
    sunder_i_rational_point at;
} sunder_i_site;

/* The line A x + B y + C w, which is 0 on the line and positive above it (left of it in the direction of
 * lexicographically greater points): B > 0, or B = 0 and A < 0. a, b are A and B, each with an error of at most half an
 * ulp, times one common positive factor, |a|, |b| <= 1; rx, ry are the doubles of a site on the line. */
typedef struct sunder_i_map_line {
    sunder_i_big abc[3];
    double a, b, rx, ry;
} sunder_i_map_line;

typedef struct sunder_i_map_vertex {
    sunder_i_site site;
    uint32_t out;         /* the first half-edge, counterclockwise from straight down; NOWHERE: the vertex is
                           * isolated */
    uint32_t left, right; /* trapezoids, see above */
    uint32_t below;
    uint32_t stamp;
    bool alive; /* a vertex that is not alive may still be used in the history */
} sunder_i_map_vertex;

typedef struct sunder_i_map_edge {
    uint32_t end[2]; /* the smaller and the greater end; end[0] == NOWHERE: the edge is free, and end[1] is the next
                      * free one */
    uint32_t line;
    uint32_t sides[2], ccw[2], cw[2]; /* of the half-edges 2 e and 2 e + 1 */
    uint32_t up, down;                /* the leftmost trapezoids above and below */
    uint32_t stamp;
} sunder_i_map_edge;

typedef struct sunder_i_trapezoid {
    uint32_t top, bottom; /* edges; NOWHERE: at infinity */
    uint32_t left, right; /* vertices; NOWHERE: at infinity */
    uint32_t lu, ll, ru, rl;
    uint32_t node; /* the trapezoid's leaf; NOWHERE: the trapezoid is free, and `top` is the next free one */
    uint32_t covered;
    uint32_t stamp;
} sunder_i_trapezoid;

/* A node of the history. LEAF: a is the trapezoid. ALIAS: the search continues at node a. AT: it continues at a for
 * points smaller (lexicographically) than vertex `of`, else at b. BY: it continues at a for points below line `of`,
 * else at b. */
enum { SUNDER_I_LEAF, SUNDER_I_ALIAS, SUNDER_I_AT, SUNDER_I_BY };

typedef struct sunder_i_history_node {
    uint32_t kind : 2, of : 30;
    uint32_t a, b;
} sunder_i_history_node;

struct sunder_i_planar_map {
    sunder_i_lattice *lattice;
    sunder_i_arena arena, scratch; /* memory for permanent numbers, and for intermediate ones */
    uint64_t random;
    bool failed; /* out of memory; see sunder_i_map_broken() */
    bool marked; /* whether the covered counts are valid */
    uint32_t stamp;

    sunder_i_map_vertex *vertex;
    sunder_i_map_edge *edge;
    sunder_i_map_line *line;
    sunder_i_trapezoid *trapezoid;
    sunder_i_history_node *node;
    uint32_t vertices, edges, lines, trapezoids, nodes; /* the number of elements in the arrays, including free ones */
    size_t vertex_capacity, edge_capacity, line_capacity, trapezoid_capacity, node_capacity;
    uint32_t dead_vertices, dead_edges, dead_trapezoids;
    uint32_t free_edge, free_trapezoid;
    size_t number_bytes; /* the size of the limbs of vertices and lines */

    sunder_i_list crossed;              /* the trapezoids through which the current piece of a segment passes */
    sunder_i_list ring;                 /* the half-edges of the polygon inserted last, with the polygon on their
                                         * left */
    sunder_i_list above, beneath, made; /* used by merging.c */
    sunder_i_list stack, inside, edges_inside, vertices_inside; /* used in floods and in cleaning */

    bool faces_valid;
    uint32_t faces;
    uint32_t *face_of_trapezoid, *face_outer, *face_covered;
    uint32_t *inner, *isolated;
    size_t *inner_end, *isolated_end; /* by face */
};

/* ---- sites.c ---- */

int sunder_i_site_cmp_exact(sunder_i_planar_map *map, const sunder_i_site *p, const sunder_i_site *q);
/* Compares two sites lexicographically. Rounding to nearest is monotone, so that unequal doubles decide; equal ones
 * decide nothing. */
static inline int sunder_i_site_cmp(sunder_i_planar_map *map, const sunder_i_site *p, const sunder_i_site *q)
{
    map->lattice->counts.comparisons++;
    if (p->ax != q->ax) return p->ax < q->ax ? -1 : 1;
    return sunder_i_site_cmp_exact(map, p, q);
}
/* Returns +1 if p is above the line, -1 if below, 0 if on it. */
int sunder_i_site_side(sunder_i_planar_map *map, const sunder_i_map_line *line, const sunder_i_site *p);
/* Returns +1 if g turns left of f (is steeper in the sheared order), -1 if right, 0 if they are parallel. */
int sunder_i_line_turn(sunder_i_planar_map *map, const sunder_i_map_line *f, const sunder_i_map_line *g);
/* Returns the intersection of two lines that are not parallel; its numbers are allocated in `arena`. */
sunder_i_site sunder_i_line_crossing(sunder_i_planar_map *map, const sunder_i_map_line *f, const sunder_i_map_line *g,
                                     sunder_i_arena *arena);
/* Returns the site of a point; its numbers are borrowed. */
sunder_i_site sunder_i_site_of(sunder_i_planar_map *map, sunder_i_rational_point at);
/* Returns the line through p and q, p < q, with numbers allocated in `arena`. If `along` is not NULL, the line has the
 * direction of that lattice vector or the opposite one. */
sunder_i_map_line sunder_i_line_through(sunder_i_planar_map *map, const sunder_i_site *p, const sunder_i_site *q,
                                        const sunder_i_point *along, sunder_i_arena *arena);
/* Return a copy whose numbers are allocated in `arena`. */
sunder_i_site sunder_i_site_copy(const sunder_i_site *from, sunder_i_arena *arena);
sunder_i_map_line sunder_i_line_copy(const sunder_i_map_line *from, sunder_i_arena *arena);

/* ---- map.c ---- */

/* Returns true if out of memory, in the map or in an arena that it uses. */
static inline bool sunder_i_map_broken(sunder_i_planar_map *map)
{
    map->failed = map->failed || map->arena.failed || map->scratch.failed || map->lattice->arena.failed;
    return map->failed;
}
/* Returns SUNDER_OK, or for a broken map SUNDER_ENOMEM. */
sunder_status sunder_i_map_status(sunder_i_planar_map *map, sunder_error *err);
/* Reserves memory for the given numbers of further elements; invalidates pointers into the arrays. Returns false if out
 * of memory. */
bool sunder_i_map_room(sunder_i_planar_map *map, size_t vertices, size_t edges, size_t trapezoids, size_t nodes);
bool sunder_i_map_push(sunder_i_planar_map *map, sunder_i_list *list, uint32_t item);
/* Return a new element; the memory must have been reserved. */
uint32_t sunder_i_map_new_vertex(sunder_i_planar_map *map, const sunder_i_site *site);
uint32_t sunder_i_map_new_edge(sunder_i_planar_map *map);
uint32_t sunder_i_map_new_trapezoid(sunder_i_planar_map *map);
void sunder_i_map_free_edge(sunder_i_planar_map *map, uint32_t e);
void sunder_i_map_free_trapezoid(sunder_i_planar_map *map, uint32_t t);
/* Returns the new line's number; NOWHERE if out of memory. */
uint32_t sunder_i_map_new_line(sunder_i_planar_map *map, const sunder_i_map_line *line);
/* Returns the trapezoid directly below v, on the right of its wall. */
uint32_t sunder_i_map_below_vertex(const sunder_i_planar_map *map, uint32_t v);
/* Returns the trapezoid at the smaller end of h, on its left. */
static inline uint32_t sunder_i_map_left_of(const sunder_i_planar_map *map, uint32_t h)
{
    return h & 1 ? map->edge[h >> 1].down : map->edge[h >> 1].up;
}
void sunder_i_map_drop_faces(sunder_i_planar_map *map);

/* ---- history.c ---- */

/* Makes a new leaf for the trapezoid, and stores it there. The memory must have been reserved. */
uint32_t sunder_i_history_leaf(sunder_i_planar_map *map, uint32_t trapezoid);
void sunder_i_history_at(sunder_i_planar_map *map, uint32_t node, uint32_t vertex, uint32_t smaller, uint32_t greater);
void sunder_i_history_by(sunder_i_planar_map *map, uint32_t node, uint32_t line, uint32_t below, uint32_t above);
void sunder_i_history_alias(sunder_i_planar_map *map, uint32_t node, uint32_t to);
/* Converts `node` to a balanced tree over the trapezoids t[0 .. n - 1], which are sorted from left to right. Memory for
 * n nodes must have been reserved. */
void sunder_i_history_row(sunder_i_planar_map *map, uint32_t node, const uint32_t *t, size_t n);
/* Returns the trapezoid that contains a point; for a point on a wall or an edge the one right of and above it: so a
 * vertex at the point is its `left`, and an edge through the point its `bottom`. */
uint32_t sunder_i_history_find(sunder_i_planar_map *map, const sunder_i_site *p);

/* ---- trapezoids.c ---- */

typedef enum sunder_i_wall { SUNDER_I_WALL_INSIDE, SUNDER_I_WALL_ON_BOTTOM, SUNDER_I_WALL_ON_TOP } sunder_i_wall;

/* Makes a and b, left and right of a wall, neighbours at its upper (else lower) part; one of them may be NOWHERE. */
void sunder_i_trapezoid_link(sunder_i_planar_map *map, uint32_t a, uint32_t b, bool upper);
/* Replaces, at the upper (else lower) part of a wall, which does not change, `before` by a on its left and trapezoid
 * `after`, whose old contents are *old_after, by b on its right. `before` and `after` may have been each other's
 * neighbours, or have had others. */
void sunder_i_trapezoid_pass(sunder_i_planar_map *map, const sunder_i_trapezoid *before, uint32_t after,
                             const sunder_i_trapezoid *old_after, uint32_t a, uint32_t b, bool upper);
/* Updates the references of the trapezoid's vertices and edges to it. */
void sunder_i_trapezoid_install(sunder_i_planar_map *map, uint32_t t);
/* Inserts the wall of vertex v in t, which keeps its left part; returns the right part. Memory for 1 trapezoid and 2
 * nodes must have been reserved. */
uint32_t sunder_i_trapezoid_split(sunder_i_planar_map *map, uint32_t t, uint32_t v, sunder_i_wall wall);
/* Draws edge e (whose end, line and sides are set) through the trapezoids of map->crossed, from the one right of end[0]
 * to the one left of end[1]. Memory for 1 trapezoid and crossed.n + 1 nodes must have been reserved. */
void sunder_i_trapezoid_draw(sunder_i_planar_map *map, uint32_t e);

/* ---- merging.c ---- */

/* Removes edge e. Returns false if out of memory. */
bool sunder_i_trapezoid_erase(sunder_i_planar_map *map, uint32_t e);
/* Removes the wall between t and r, its neighbour on the right with the same top and bottom; t becomes their union. */
void sunder_i_trapezoid_join(sunder_i_planar_map *map, uint32_t t, uint32_t r);

/* ---- edges.c ---- */

/* Returns the first trapezoid right of v for a segment to the right on the given line. *lower becomes the half-edge
 * directly below the segment there, or NOWHERE; *same the half-edge on the line itself: then the function returns
 * NOWHERE. */
uint32_t sunder_i_edge_wedge(sunder_i_planar_map *map, uint32_t v, uint32_t line, uint32_t *lower, uint32_t *same);
/* Makes a vertex inside trapezoid t. Returns it, or NOWHERE if out of memory. */
uint32_t sunder_i_edge_isolated(sunder_i_planar_map *map, uint32_t t, const sunder_i_site *site);
/* Makes a vertex on edge e, which keeps its smaller part. hint: a trapezoid along e with the site on its top or bottom,
 * or NOWHERE. Returns the vertex, or NOWHERE if out of memory. */
uint32_t sunder_i_edge_split(sunder_i_planar_map *map, uint32_t e, const sunder_i_site *site, uint32_t hint);
/* Makes the edge from v to w through map->crossed; lower: as from sunder_i_edge_wedge(). Returns it, or NOWHERE if out
 * of memory. */
uint32_t sunder_i_edge_make(sunder_i_planar_map *map, uint32_t v, uint32_t w, uint32_t lower, uint32_t line,
                            uint32_t up, uint32_t down);
bool sunder_i_edge_remove(sunder_i_planar_map *map, uint32_t e);
void sunder_i_edge_drop_vertex(sunder_i_planar_map *map, uint32_t v); /* v is isolated */
void sunder_i_edge_merge(sunder_i_planar_map *map, uint32_t v);       /* v is mergeable */

/* ---- insert_segment.c ---- */

/* Returns the vertex at a site (with numbers in map->arena), which is made if there is none. NOWHERE if out of
 * memory. */
uint32_t sunder_i_map_vertex_at(sunder_i_planar_map *map, const sunder_i_site *site);
/* Does the same as sunder_i_map_vertex_at() for a site that sunder_i_history_find() finds in trapezoid t. */
uint32_t sunder_i_map_vertex_in(sunder_i_planar_map *map, uint32_t t, const sunder_i_site *site);
/* Follows the segment from a point inside trapezoid *t, or at its left wall, to a site farther right, without drawing
 * it. For each trapezoid entered, twice its number is appended to the list, plus 1 if it is entered below the wall's
 * vertex; *t becomes the last one. Returns false at the first vertex or edge that the segment meets, or if out of
 * memory. */
bool sunder_i_map_glide(sunder_i_planar_map *map, uint32_t *t, const sunder_i_site *target,
                        const sunder_i_map_line *line, sunder_i_list *list);
/* Draws the edges of the segment from vertex v to a site to the right of it (with numbers in map->arena), along the
 * given line through both. Returns the vertex at the site, or NOWHERE if out of memory. up, down: the number of regions
 * that have the segment on their boundary and are above, below it. record: the half-edges with the region on their left
 * are appended to map->ring. */
uint32_t sunder_i_map_walk(sunder_i_planar_map *map, uint32_t v, const sunder_i_site *target, uint32_t line,
                           uint32_t up, uint32_t down, bool record);

/* ---- clean_map.c ---- */

/* Set the counts of an edge and of a vertex that remain, for the union as one region. */
void sunder_i_map_settle_edge(sunder_i_planar_map *map, uint32_t e);
void sunder_i_map_settle_vertex(sunder_i_planar_map *map, uint32_t v);
/* Removes the edges of edges_inside and then the vertices of vertices_inside, all of which are covered; the counts of
 * all faces around them must be 1 already. Returns false if out of memory. */
bool sunder_i_map_remove_covered(sunder_i_planar_map *map);

/* ---- polygon.c, mark.c ---- */

/* Inserts a polygon, as insert_polygon(). With `unite`, for unite_polygon(), the map must be clean and its counts
 * valid: then a polygon that a covered face contains is not inserted, and map->ring is empty; else map->ring is the
 * polygon's boundary. */
sunder_status sunder_i_map_polygon(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                                   const sunder_i_point *along, size_t n, bool unite, sunder_error *err);
/* Lists the neighbours of t across walls, and across edges if t is the leftmost trapezoid along them. Returns their
 * number n <= 6. step[i] is covered(to[i]) - covered(t) according to the sides. If stop != 0, edges with that stamp are
 * not crossed. */
size_t sunder_i_map_around(const sunder_i_planar_map *map, uint32_t t, uint32_t stop, uint32_t to[6], int64_t step[6]);

/* ---- overlay.c ---- */

/* Make the map anew from its live elements; compact() only if its history is large in comparison. Return false if out
 * of memory. */
bool sunder_i_map_renew(sunder_i_planar_map *map);
bool sunder_i_map_compact(sunder_i_planar_map *map);

#endif
