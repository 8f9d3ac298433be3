/* The planar map: a subdivision of the plane by segments, kept exactly, with its vertical decomposition.
 *
 * Vertices, half-edges and faces; faces with outer and inner boundaries, isolated vertices, antennas. It is made by
 * inserting segments (sides of convex polygons) one at a time into the vertical decomposition, which is kept under
 * insertion and under removal together with its history, so that a place is found in expected logarithmic time where
 * the order of insertion is random [Mul90, Sei91]. README.md tells the idea, the invariants and the degenerate cases.
 *
 * Points are homogeneous: (x / w, y / w), w > 0, in units of the lattice. All order is lexicographic (x, then y), which
 * is the order by x after a shear by an infinitesimal: so a vertical edge goes from its lower end to its upper one, and
 * its left side is "above" it. An edge e has two half-edges: 2 e from the smaller end to the greater, 2 e + 1 back.
 * "Left" is left of the half-edge, so the side above e is the left of 2 e, and the side below it the left of 2 e + 1.
 *
 * Counting. Every region that goes into the map is open, and is said by its sides: a half-edge carries the number of
 * regions that have it on their boundary and lie on its left (`sides`). From these
 *   - covered(face), how many regions contain it: it differs across an edge by sides(h) - sides(twin(h)), 0 outermost;
 *   - covered(edge), how many contain its relative interior: covered(face left of h) - sides(h), for both h alike;
 *   - covered(vertex), how many contain the vertex: those that contain what is right below it, less those of them that
 *     have it on their boundary. The counts on the half-edges around the vertex do not tell that number (four squares
 *     around a vertex look like four half-planes), so it is kept (`below`).
 *
 * An edge or a vertex with covered = 0 between faces with covered > 0 is a degenerate hole.
 *
 * The covered counts are right after mark(), clean() and unite_polygon(); insert_*() and overlay() leave them stale.
 *
 * Ids are dense enough to index arrays with: vertices below vertex_end(), edges below edge_end(), faces below
 * face_end(). Those of removed vertices and edges are dead (alive says so) and may come back. Functions that change the
 * map may change any id, unless it says otherwise below.
 *
 * A function that fails (SUNDER_ENOMEM is all that can happen) leaves a map that can only be freed. A map is not shared
 * between threads; operations are counted on its lattice. Nothing here recurses. */
#ifndef SUNDER_I_PLANAR_MAP_H
#define SUNDER_I_PLANAR_MAP_H

#include "predicate/rational_point.h"

#define SUNDER_I_NOWHERE UINT32_MAX /* no vertex, no half-edge, no face */

typedef struct sunder_i_planar_map sunder_i_planar_map;

/* ---- Making and freeing ---- */

/* An empty map: one face. The lattice outlives the map; seed drives the random order of overlay() alone. */
sunder_status sunder_i_planar_map_new(sunder_i_lattice *lattice, uint64_t seed, sunder_i_planar_map **out,
                                      sunder_error *err);
void sunder_i_planar_map_free(sunder_i_planar_map *map);

/* ---- Arrangement: insertion ---- */

/* Adds a convex polygon, an open region with sides +1 on the left of its boundary.
 *
 * corner  n >= 3 of them, counter-clockwise, with area; collinear and repeated corners are allowed. Copied as needed.
 * along   NULL, or for each side (from corner i to i + 1) a lattice vector that is a positive multiple of it: saves
 *         work, and keeps the numbers small where corners are Steiner points (sunder_i_convex_sum.along).
 * The ids of older vertices stay; older edges may be split (the part with the smaller end keeps the id).
 * Cost    Expected logarithmic to find the first corner, then the trapezoids that the boundary runs through. */
sunder_status sunder_i_planar_map_insert_polygon(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                                                 const sunder_i_point *along, size_t n, sunder_error *err);

/* Adds the segment from a to b (a != b), with `left` and `right` regions on its two sides that have it on their
 * boundary. `below` of the vertices in its relative interior grows by the count on its lower side, that of its ends
 * does not. That is right for convex regions; where a corner of a region touches the inside of one of its own edges,
 * and the region is not below it, the covered count of that vertex is meaningless (those of edges and faces are right).
 * On success *first and *last (may be NULL) are the vertices at a and b. */
sunder_status sunder_i_planar_map_insert_segment(sunder_i_planar_map *map, sunder_i_rational_point a,
                                                 sunder_i_rational_point b, uint32_t left, uint32_t right,
                                                 uint32_t *first, uint32_t *last, sunder_error *err);
/* Adds a point as a vertex (isolated, or splitting the edge that it lies on), and adds `below` to the regions below it
 * that have it on their boundary. */
sunder_status sunder_i_planar_map_insert_point(sunder_i_planar_map *map, sunder_i_rational_point at, uint32_t below,
                                               uint32_t *vertex, sunder_error *err);

/* Adds all edges and isolated vertices of `other`, with their counts, in random order. Both maps stand on one
 * lattice. */
sunder_status sunder_i_planar_map_overlay(sunder_i_planar_map *map, const sunder_i_planar_map *other,
                                          sunder_error *err);

/* ---- Marking and cleaning ---- */

/* Computes covered for all of the map, by one traversal from the outermost face. Linear. */
sunder_status sunder_i_planar_map_mark(sunder_i_planar_map *map, sunder_error *err);

/* Makes the map that of the union of all its regions, degenerate holes kept. mark() must have been called since the
 * last insertion (unite_polygon() needs no such call). - Every edge and vertex with covered >= 1 is removed. So all
 * that remain have covered = 0. - Vertices that have become needless are merged: two edges on one line with equal
 * counts on each side. - The union counts as one region from then on: covered of faces is 0 or 1, sides and below
 * likewise. */
sunder_status sunder_i_planar_map_clean(sunder_i_planar_map *map, sunder_error *err);

/* insert_polygon(), then clean() where the polygon changed something: the step of the incremental union. The map must
 * be clean (empty, or only clean() and unite_polygon() since). What lies inside the polygon goes, and so do those parts
 * of its boundary that lie inside the union so far. Counts of faces are kept, so no mark() is needed before or after.
 * Cost    As insert_polygon(), and the trapezoids inside the polygon, which vanish. */
sunder_status sunder_i_planar_map_unite_polygon(sunder_i_planar_map *map, const sunder_i_rational_point *corner,
                                                const sunder_i_point *along, size_t n, sunder_error *err);

/* ---- Removal by hand ---- */

/* Removes an edge, given by one of its half-edges; its ends stay, isolated perhaps. Ids of other vertices and edges
 * stay. Covered counts are stale afterwards, and mark() makes sense only if the edge's two half-edges had
 * equal counts. */
sunder_status sunder_i_planar_map_remove_edge(sunder_i_planar_map *map, uint32_t h, sunder_error *err);
/* Removes an isolated vertex. */
sunder_status sunder_i_planar_map_remove_vertex(sunder_i_planar_map *map, uint32_t v, sunder_error *err);
/* Has v exactly two edges, on one line and with equal counts, so that it need not be there? */
bool sunder_i_planar_map_mergeable(sunder_i_planar_map *map, uint32_t v);
/* Removes such a vertex: its two edges become one, with the id of the edge at its smaller side. */
sunder_status sunder_i_planar_map_merge_vertex(sunder_i_planar_map *map, uint32_t v, sunder_error *err);

/* ---- Looking: vertices ---- */

uint32_t sunder_i_planar_map_vertex_end(const sunder_i_planar_map *map);
bool sunder_i_planar_map_vertex_alive(const sunder_i_planar_map *map, uint32_t v);
/* Lent; in lowest terms unless the point came in otherwise. */
const sunder_i_rational_point *sunder_i_planar_map_vertex_point(const sunder_i_planar_map *map, uint32_t v);
/* Lexicographic order of two vertices. */
int sunder_i_planar_map_vertex_cmp(sunder_i_planar_map *map, uint32_t v, uint32_t w);
/* A half-edge out of v: the first in counter-clockwise order from straight down; NOWHERE if v is isolated. */
uint32_t sunder_i_planar_map_vertex_out(const sunder_i_planar_map *map, uint32_t v);
uint32_t sunder_i_planar_map_vertex_covered(const sunder_i_planar_map *map, uint32_t v);
/* Regions with v on their boundary that contain what is right below it. */
uint32_t sunder_i_planar_map_vertex_below(const sunder_i_planar_map *map, uint32_t v);

/* ---- Looking: half-edges ---- */

uint32_t sunder_i_planar_map_edge_end(const sunder_i_planar_map *map);
bool sunder_i_planar_map_edge_alive(const sunder_i_planar_map *map, uint32_t e);
static inline uint32_t sunder_i_planar_map_twin(uint32_t h) { return h ^ 1; }
uint32_t sunder_i_planar_map_origin(const sunder_i_planar_map *map, uint32_t h);
/* Along the boundary of the face left of h: the sharpest left turn at the end of h. */
uint32_t sunder_i_planar_map_next(const sunder_i_planar_map *map, uint32_t h);
uint32_t sunder_i_planar_map_prev(const sunder_i_planar_map *map, uint32_t h);
/* The next half-edge out of the same origin, counter-clockwise. */
uint32_t sunder_i_planar_map_ccw(const sunder_i_planar_map *map, uint32_t h);
uint32_t sunder_i_planar_map_sides(const sunder_i_planar_map *map, uint32_t h);
uint32_t sunder_i_planar_map_edge_covered(const sunder_i_planar_map *map, uint32_t e);
/* covered of the face left of h; does not need faces(). */
uint32_t sunder_i_planar_map_left_covered(const sunder_i_planar_map *map, uint32_t h);

/* Is edge f steeper than edge e (+1), or less steep (-1), or parallel to it (0)? In the sheared order. */
int sunder_i_planar_map_turn(sunder_i_planar_map *map, uint32_t e, uint32_t f);
/* Has memory run out in a question about the map since? Answers are then worth nothing. */
bool sunder_i_planar_map_failed(sunder_i_planar_map *map);

/* ---- Looking: faces ---- */

/* Finds the faces; lasts until the map changes, and the functions below may be called only until then. Linear.
 * Face 0 is the outermost one. */
sunder_status sunder_i_planar_map_faces(sunder_i_planar_map *map, sunder_error *err);
uint32_t sunder_i_planar_map_face_end(const sunder_i_planar_map *map);
uint32_t sunder_i_planar_map_face_covered(const sunder_i_planar_map *map, uint32_t f);
/* A half-edge of the outer boundary (counter-clockwise along it); NOWHERE for face 0. */
uint32_t sunder_i_planar_map_face_outer(const sunder_i_planar_map *map, uint32_t f);
/* One half-edge for each inner boundary, *n of them. */
const uint32_t *sunder_i_planar_map_face_inner(const sunder_i_planar_map *map, uint32_t f, size_t *n);
/* Its isolated vertices. */
const uint32_t *sunder_i_planar_map_face_isolated(const sunder_i_planar_map *map, uint32_t f, size_t *n);
/* The face left of h, and the face around an isolated vertex. */
uint32_t sunder_i_planar_map_face(const sunder_i_planar_map *map, uint32_t h);
uint32_t sunder_i_planar_map_vertex_face(const sunder_i_planar_map *map, uint32_t v);

/* ---- Location ---- */

typedef enum sunder_i_map_place { SUNDER_I_IN_FACE, SUNDER_I_ON_EDGE, SUNDER_I_AT_VERTEX } sunder_i_map_place;

typedef struct sunder_i_location {
    sunder_i_map_place place;
    uint32_t id;      /* of the vertex or edge; NOWHERE in a face */
    uint32_t below;   /* a half-edge right below the point, with it on the left (of a point on an edge that edge); or
                         NOWHERE */
    uint32_t covered; /* of the place: face, edge or vertex */
    uint32_t face;    /* of a point in a face, if faces() is in force; else NOWHERE */
} sunder_i_location;

/* Where a point lies. Expected logarithmic. */
sunder_status sunder_i_planar_map_locate(sunder_i_planar_map *map, sunder_i_rational_point at, sunder_i_location *out,
                                         sunder_error *err);

/* ---- Size and soundness ---- */

typedef struct sunder_i_map_size {
    size_t vertices, edges, trapezoids, history; /* alive; nodes of the history */
    size_t bytes;                                /* of all memory held */
} sunder_i_map_size;

void sunder_i_planar_map_size(const sunder_i_planar_map *map, sunder_i_map_size *out);

/* Proves, exactly and in about n log n, every invariant of half-edges, counts, geometry, trapezoids and history
 * (README.md lists them). NULL if all hold, else a sentence on the first that does not. */
const char *sunder_i_planar_map_check(sunder_i_planar_map *map);
/* The same at the end of a stage, where NDEBUG is not set: nothing is counted, and where memory runs out nothing is
 * known and NULL is returned. */
const char *sunder_i_planar_map_sound(sunder_i_planar_map *map);

#endif
