/* planar_map.h: the planar map: a subdivision of the plane by segments, represented exactly, with its vertical
 * decomposition.
 *
 * It has vertices, half-edges and faces; faces with outer and inner boundaries, isolated vertices, antennas. It is
 * constructed by inserting segments (sides of convex polygons) one at a time into the vertical decomposition, which is
 * updated at insertions and removals together with its history, so that a point is located in expected logarithmic time
 * if the order of insertion is random [Mul90, Sei91]. README.md describes the idea, the invariants and the degenerate
 * cases.
 *
 * Points are homogeneous: (x / w, y / w), w > 0, in units of the lattice. The order is lexicographic (x, then y), which
 * is the order by x after a shear by an infinitesimal: so a vertical edge goes from its lower end to its upper one, and
 * its left side is "above" it. An edge e has two half-edges: 2 e from the smaller end to the greater, 2 e + 1 in the
 * opposite direction. "Left" means left of the half-edge, so that the side above e is the left of 2 e, and the side
 * below it the left of 2 e + 1.
 *
 * Counts. Every region of the map is open, and represented by its sides: a half-edge has the number of regions that
 * have it on their boundary and are on its left (`sides`). From these follow
 *   - covered(face), the number of regions that contain it: it differs across an edge by sides(h) - sides(twin(h)), and
 *     is 0 for the outermost face;
 *   - covered(edge), the number of regions that contain its relative interior: covered(face left of h) - sides(h),
 *     equal for both h;
 *   - covered(vertex), the number of regions that contain the vertex: those that contain the points directly below it,
 *     minus those of them that have it on their boundary. The counts on the half-edges around the vertex do not
 *     determine that number (four squares around a vertex have the same ones as four half-planes), so that it is stored
 *     (`below`).
 *
 * An edge or a vertex with covered = 0 between faces with covered > 0 is a degenerate hole.
 *
 * The covered counts are valid after mark(), clean() and unite_polygon(); insert_*() and overlay() invalidate them.
 *
 * Numbers of elements are dense enough to index arrays: vertices are below vertex_end(), edges below edge_end(), faces
 * below face_end(). Those of removed vertices and edges are not alive (alive() returns false) and may be used again.
 * Functions that change the map may change any number, unless stated otherwise below.
 *
 * After a function has failed (only SUNDER_ENOMEM is possible) the map can only be freed. A map must not be used by
 * several threads at once; its operations are counted in its lattice. No function here is recursive. */
#ifndef SUNDER_I_PLANAR_MAP_H
#define SUNDER_I_PLANAR_MAP_H

#include "predicate/rational_point.h"

#define SUNDER_I_NOWHERE UINT32_MAX /* no vertex, half-edge or face */

typedef struct sunder_i_planar_map sunder_i_planar_map;

/* ---- Construction and destruction ---- */

/* Makes an empty map with one face. The lattice must outlive the map; `seed` only determines the random order of
 * overlay(). */
sunder_status sunder_i_planar_map_new(sunder_i_lattice *lattice, uint64_t seed, sunder_i_planar_map **out,
                                      sunder_error *err);
void sunder_i_planar_map_free(sunder_i_planar_map *map);

/* ---- Arrangement: insertion ---- */

/* Adds a convex polygon, as an open region with sides +1 on the left of its boundary.
 *
 *   corner  n >= 3 corners, counterclockwise, with a positive area; collinear and repeated corners are allowed. Copied.
 *   along   NULL, or for each side (from corner i to i + 1) a lattice vector of which the side is a positive multiple:
 *           this saves time, and keeps the numbers small if corners are Steiner points (sunder_i_convex_sum.along).
 *
 * The numbers of existing vertices do not change; existing edges may be split (the part with the smaller end keeps its
 * number). The time is expected logarithmic for finding the first corner, plus the number of trapezoids along the
 * boundary. */
sunder_status sunder_i_planar_map_insert_polygon(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                                                 const sunder_i_point *along, size_t n, sunder_error *err);

/* Adds the segment from a to b (a != b), with `left` and `right` regions on its two sides that have it on their
 * boundary. `below` of the vertices in its relative interior increases by the count on its lower side, that of its ends
 * does not. This is correct for convex regions; if a corner of a region touches the interior of one of the region's own
 * edges, and the region is not below it, the covered count of that vertex is meaningless (those of edges and faces are
 * correct). On success *first and *last (which may be NULL) become the vertices at a and b. */
sunder_status sunder_i_planar_map_insert_segment(sunder_i_planar_map *map, sunder_i_rational_point a,
                                                 sunder_i_rational_point b, uint32_t left, uint32_t right,
                                                 uint32_t *first, uint32_t *last, sunder_error *err);
/* Adds a point as a vertex (isolated, or splitting the edge that contains it), and adds `below` to the number of
 * regions below it that have it on their boundary. vertex: NULL, or *vertex becomes the vertex. */
sunder_status sunder_i_planar_map_insert_point(sunder_i_planar_map *map, sunder_i_rational_point at, uint32_t below,
                                               uint32_t *vertex, sunder_error *err);

/* Adds all edges and isolated vertices of `other`, with their counts, in random order. Both maps must have the same
 * lattice. */
sunder_status sunder_i_planar_map_overlay(sunder_i_planar_map *map, const sunder_i_planar_map *other,
                                          sunder_error *err);

/* ---- Marking and cleaning ---- */

/* Computes the covered counts of the whole map, by one traversal from the outermost face, in linear time. */
sunder_status sunder_i_planar_map_mark(sunder_i_planar_map *map, sunder_error *err);

/* Converts the map to that of the union of all its regions, with degenerate holes. mark() must have been called since
 * the last insertion (after unite_polygon() this is not necessary).
 *   - Every edge and vertex with covered >= 1 is removed. So all that remain have covered = 0.
 *   - Vertices that have become unnecessary are merged: those of two edges on one line with equal counts on each side.
 *   - The union counts as one region afterwards: covered of faces is 0 or 1, sides and below likewise. */
sunder_status sunder_i_planar_map_clean(sunder_i_planar_map *map, sunder_error *err);

/* Does insert_polygon(), then clean() if the polygon changed anything: the step of the incremental union. The map must
 * be clean (empty, or since then only clean() and unite_polygon() were called). Elements inside the polygon are
 * removed, and so are those parts of its boundary that are inside the union so far. Counts of faces remain valid, so
 * that no mark() is needed before or after. The time is that of insert_polygon(), plus the number of trapezoids inside
 * the polygon, which are removed. */
sunder_status sunder_i_planar_map_unite_polygon(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                                                const sunder_i_point *along, size_t n, sunder_error *err);

/* ---- Removal of single elements ---- */

/* Removes an edge, given by one of its half-edges; its ends remain, possibly isolated. The numbers of other vertices
 * and edges do not change. Covered counts are invalid afterwards, and mark() gives correct results only if the edge's
 * two half-edges had equal counts. */
sunder_status sunder_i_planar_map_remove_edge(sunder_i_planar_map *map, uint32_t h, sunder_error *err);
/* Removes an isolated vertex. */
sunder_status sunder_i_planar_map_remove_vertex(sunder_i_planar_map *map, uint32_t v, sunder_error *err);
/* Returns true if v has exactly two edges, on one line and with equal counts, so that it is unnecessary. */
bool sunder_i_planar_map_mergeable(sunder_i_planar_map *map, uint32_t v);
/* Removes a mergeable vertex: its two edges become one, with the number of the edge on its smaller side. */
sunder_status sunder_i_planar_map_merge_vertex(sunder_i_planar_map *map, uint32_t v, sunder_error *err);

/* ---- Queries: vertices ---- */

uint32_t sunder_i_planar_map_vertex_end(const sunder_i_planar_map *map);
bool sunder_i_planar_map_vertex_alive(const sunder_i_planar_map *map, uint32_t v);
/* Returns the point of v (borrowed), in lowest terms unless it was inserted otherwise. */
const sunder_i_rational_point *sunder_i_planar_map_vertex_point(const sunder_i_planar_map *map, uint32_t v);
/* Compares two vertices lexicographically. */
int sunder_i_planar_map_vertex_cmp(sunder_i_planar_map *map, uint32_t v, uint32_t w);
/* Returns a half-edge out of v: the first in counterclockwise order from straight down; NOWHERE if v is isolated. */
uint32_t sunder_i_planar_map_vertex_out(const sunder_i_planar_map *map, uint32_t v);
uint32_t sunder_i_planar_map_vertex_covered(const sunder_i_planar_map *map, uint32_t v);
/* Returns the number of regions with v on their boundary that contain the points directly below v. */
uint32_t sunder_i_planar_map_vertex_below(const sunder_i_planar_map *map, uint32_t v);

/* ---- Queries: half-edges ---- */

uint32_t sunder_i_planar_map_edge_end(const sunder_i_planar_map *map);
bool sunder_i_planar_map_edge_alive(const sunder_i_planar_map *map, uint32_t e);
static inline uint32_t sunder_i_planar_map_twin(uint32_t h) { return h ^ 1; }
uint32_t sunder_i_planar_map_origin(const sunder_i_planar_map *map, uint32_t h);
/* Return the next and the previous half-edge along the boundary of the face left of h: the sharpest left turn at the
 * end of h. */
uint32_t sunder_i_planar_map_next(const sunder_i_planar_map *map, uint32_t h);
uint32_t sunder_i_planar_map_prev(const sunder_i_planar_map *map, uint32_t h);
/* Returns the next half-edge out of the same origin, counterclockwise. */
uint32_t sunder_i_planar_map_ccw(const sunder_i_planar_map *map, uint32_t h);
uint32_t sunder_i_planar_map_sides(const sunder_i_planar_map *map, uint32_t h);
uint32_t sunder_i_planar_map_edge_covered(const sunder_i_planar_map *map, uint32_t e);
/* Returns the covered count of the face left of h; does not need faces(). */
uint32_t sunder_i_planar_map_left_covered(const sunder_i_planar_map *map, uint32_t h);

/* Returns +1 if edge f is steeper than edge e, -1 if it is less steep, 0 if it is parallel to e, in the sheared
 * order. */
int sunder_i_planar_map_turn(sunder_i_planar_map *map, uint32_t e, uint32_t f);
/* Returns true if a query has run out of memory. Then the results of queries are not valid. */
bool sunder_i_planar_map_failed(sunder_i_planar_map *map);

/* ---- Queries: faces ---- */

/* Finds the faces, in linear time. They are valid until the map changes, and the functions below may be called only
 * until then. Face 0 is the outermost one. */
sunder_status sunder_i_planar_map_faces(sunder_i_planar_map *map, sunder_error *err);
uint32_t sunder_i_planar_map_face_end(const sunder_i_planar_map *map);
uint32_t sunder_i_planar_map_face_covered(const sunder_i_planar_map *map, uint32_t f);
/* Returns a half-edge of the outer boundary (counterclockwise along it); NOWHERE for face 0. */
uint32_t sunder_i_planar_map_face_outer(const sunder_i_planar_map *map, uint32_t f);
/* Returns one half-edge for each inner boundary, *n of them (borrowed). */
const uint32_t *sunder_i_planar_map_face_inner(const sunder_i_planar_map *map, uint32_t f, size_t *n);
/* Returns the isolated vertices of face f, *n of them (borrowed). */
const uint32_t *sunder_i_planar_map_face_isolated(const sunder_i_planar_map *map, uint32_t f, size_t *n);
/* Return the face left of h, and the face around an isolated vertex. */
uint32_t sunder_i_planar_map_face(const sunder_i_planar_map *map, uint32_t h);
uint32_t sunder_i_planar_map_vertex_face(const sunder_i_planar_map *map, uint32_t v);

/* ---- Location ---- */

typedef enum sunder_i_map_place { SUNDER_I_IN_FACE, SUNDER_I_ON_EDGE, SUNDER_I_AT_VERTEX } sunder_i_map_place;

typedef struct sunder_i_location {
    sunder_i_map_place place;
    uint32_t id;      /* the number of the vertex or edge; NOWHERE in a face */
    uint32_t below;   /* a half-edge directly below the point, with the point on its left (for a point on an edge that
                       * edge); or NOWHERE */
    uint32_t covered; /* the covered count of the face, edge or vertex */
    uint32_t face;    /* the face of a point in a face, if the faces are valid; else NOWHERE */
} sunder_i_location;

/* Locates a point, in expected logarithmic time. */
sunder_status sunder_i_planar_map_locate(sunder_i_planar_map *map, sunder_i_rational_point at, sunder_i_location *out,
                                         sunder_error *err);

/* ---- Size and invariants ---- */

typedef struct sunder_i_map_size {
    size_t vertices, edges, trapezoids, history; /* the live ones; for the history the nodes */
    size_t bytes;                                /* all memory of the map */
} sunder_i_map_size;

void sunder_i_planar_map_size(const sunder_i_planar_map *map, sunder_i_map_size *out);

/* Tests, exactly and in about n log n time, every invariant of half-edges, counts, geometry, trapezoids and history
 * (README.md lists them). Returns NULL if all hold, else a message about the first that does not. */
const char *sunder_i_planar_map_check(sunder_i_planar_map *map);
/* Does the same as sunder_i_planar_map_check(), for assertions at the end of a stage if NDEBUG is not defined:
 * operations are not counted, and the function returns NULL if out of memory. */
const char *sunder_i_planar_map_sound(sunder_i_planar_map *map);

#endif
