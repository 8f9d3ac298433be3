/* build.h: a shape under construction: what the stages of sunder_shape_from_rings() pass to each other.
 *
 *   rings.c            memory for rings
 *   clean_ring.c       the vertices of a raw ring that are corners
 *   edge_tree.c        candidate pairs of edges, and edges above a point, without testing all of them
 *   intersections.c    where rings cross (an error) or touch
 *   simple.c           a sweep that proves that no edges meet, if boxes do not separate them
 *   nesting.c          orientation; holes inside outer rings, and not inside each other
 *   canonical_rings.c  a canonical order of rings, holes and polygons
 *   repair.c           replaces a polygon by its even-odd set, from the arrangement of arcs.c and even_odd.c
 *   shape_pieces.c     holes are bridged (bridge.c), ears cut off (ears.c), triangles merged (merge_triangles.c)
 *   finish.c           copies everything to one block of memory
 *   small_polygon.c    does all of this for one small valid polygon; small_pieces.c makes its pieces
 *   few_corners.c      constants that all rings with few vertices share */
#ifndef SUNDER_I_BUILD_H
#define SUNDER_I_BUILD_H

#include "predicate/narrow.h"
#include "shape/shape.h"
#include "spatial/box_tree.h"

#define SUNDER_I_NONE UINT32_MAX

/* Rings on a lattice. Vertices are numbered along the rings, one ring after the other.
 *
 * xy holds the coordinates as doubles: exact ones, or, if `rounded`, the nearest doubles of rational numbers. Rounding
 * is monotone, so that xy[i] < xy[j] always decides the order; equality decides it only if nothing was rounded. */
typedef struct sunder_i_rings {
    sunder_i_lattice *lattice;
    uint32_t vertices, rings, polygons;
    sunder_i_point *at;
    double *xy;
    bool rounded;
    uint32_t *source; /* the raw vertex number of each vertex, or SUNDER_I_MADE + the number of a point made by
                       * repair.c */
    uint32_t *ring_end, *poly_end, *next, *prev;
    size_t room[3]; /* the capacity for vertices, rings, polygons */
} sunder_i_rings;

#define SUNDER_I_MADE 0x80000000u

/* Makes room for more vertices, rings or polygons; the contents are kept (rings.c). Returns false if out of memory. */
bool sunder_i_rings_grow(sunder_i_rings *r, sunder_i_arena *arena, size_t vertices, size_t rings, size_t polygons);

/* Compare vertices by x, by y, and lexicographically (x first). */
static inline int sunder_i_rings_cmp_x(const sunder_i_rings *r, uint32_t i, uint32_t j)
{
    const double a = r->xy[2 * (size_t)i], b = r->xy[2 * (size_t)j];
    if (a != b) return a < b ? -1 : 1;
    return r->rounded ? sunder_i_int_cmp(r->lattice, r->at[i].x, r->at[j].x) : 0;
}

static inline int sunder_i_rings_cmp_y(const sunder_i_rings *r, uint32_t i, uint32_t j)
{
    const double a = r->xy[2 * (size_t)i + 1], b = r->xy[2 * (size_t)j + 1];
    if (a != b) return a < b ? -1 : 1;
    return r->rounded ? sunder_i_int_cmp(r->lattice, r->at[i].y, r->at[j].y) : 0;
}

static inline int sunder_i_rings_cmp(const sunder_i_rings *r, uint32_t i, uint32_t j)
{
    const int c = sunder_i_rings_cmp_x(r, i, j);
    return c ? c : sunder_i_rings_cmp_y(r, i, j);
}

static inline int sunder_i_rings_orient(const sunder_i_rings *r, uint32_t a, uint32_t b, uint32_t c)
{
    return sunder_i_orient_inline(r->lattice, r->at[a], r->at[b], r->at[c]);
}

/* Returns whether the direction from p to d is inside the open wedge that extends counterclockwise from p->u to p->w.
 * Directions equal to u or w are not inside. If u and w are equal the wedge is the rest of the circle. */
bool sunder_i_in_wedge(const sunder_i_rings *r, uint32_t p, uint32_t u, uint32_t w, uint32_t d);

/* ---- clean_ring.c ---- */

typedef enum sunder_i_fault {
    SUNDER_I_SOUND,
    SUNDER_I_EMPTY,    /* a ring without vertices; `vertex` is then the number of the raw ring */
    SUNDER_I_FEW,      /* fewer than three distinct vertices */
    SUNDER_I_FLAT,     /* no area */
    SUNDER_I_SPIKE,    /* an edge runs back along the previous one */
    SUNDER_I_CROSSES,  /* two edges cross, or a ring passes through itself at a vertex */
    SUNDER_I_OVERLAPS, /* two edges share a segment */
    SUNDER_I_OUTSIDE,  /* a hole outside its outer ring */
    SUNDER_I_NESTED    /* a hole in a hole */
} sunder_i_fault;

/* What is wrong, and where: vertices are raw numbers; `other` is a vertex of the second edge or ring, or NONE. */
typedef struct sunder_i_problem {
    sunder_i_fault fault;
    uint32_t vertex, other;
} sunder_i_problem;

/* Writes the corners of the raw ring lo .. hi to `keep` (room for hi - lo): vertices that are neither repeated nor
 * collinear with their neighbours. Returns their number, or 0 and a *problem if there are fewer than three, or a
 * spike. */
uint32_t sunder_i_clean_ring(sunder_i_lattice *lattice, const double *xy, const sunder_i_point *at, uint32_t lo,
                             uint32_t hi, uint32_t *keep, sunder_i_problem *problem);

/* ---- edge_tree.c ---- */

/* A tree of boxes over edges in the order of the rings; many rings are first sorted along a space-filling curve. Edges
 * near each other along a ring are near each other in the plane, so that edges are not sorted. */
typedef struct sunder_i_edge_tree {
    sunder_i_box_tree boxes;
    uint32_t *edge; /* the first vertices of the edges, in the order of the tree; NULL: edge first + i itself */
    uint32_t first;
} sunder_i_edge_tree;

/* Builds the tree of the edges of the rings ring_lo .. ring_hi, in the arena; arena->failed is set if out of memory. */
void sunder_i_edge_tree_build(sunder_i_edge_tree *tree, const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi,
                              sunder_i_arena *arena);

/* Calls visit once for each pair of edges whose boxes meet, until it returns false; returns false then. */
typedef bool (*sunder_i_pair_visitor)(void *user, uint32_t e, uint32_t f);
bool sunder_i_edge_tree_pairs(const sunder_i_edge_tree *tree, const sunder_i_rings *r, sunder_i_pair_visitor visit,
                              void *user);

/* Calls visit for all edges whose boxes meet a closed box (x0 y0 x1 y1), and for some others. visit may shrink the box;
 * edges that no longer meet it are then skipped. */
typedef void (*sunder_i_edge_visitor)(void *user, uint32_t e);
void sunder_i_edge_tree_query(const sunder_i_edge_tree *tree, const double box[4], sunder_i_edge_visitor visit,
                              void *user);

/* From this number of edges on a tree is used; fewer are tested one by one. */
#define SUNDER_I_TREE_FROM 40

/* ---- intersections.c, simple.c, nesting.c ---- */

/* Finds out whether the rings ring_lo .. ring_hi (one polygon) cross or share a segment; then *problem is set. *touches
 * becomes whether some meet in points, so that the arrangement may be needed to separate them. `tree` may be NULL for
 * few edges. */
void sunder_i_intersections_find(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi,
                                 const sunder_i_edge_tree *tree, sunder_i_arena *arena, sunder_i_problem *problem,
                                 bool *touches);
/* Returns whether the edges certainly meet nowhere except at the common ends of consecutive edges (exact for cleaned
 * rings). The arena is for temporary memory; false also if it failed. */
bool sunder_i_rings_simple(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_arena *arena);

/* Orients the outer ring counterclockwise and holes clockwise. */
void sunder_i_orient_rings(sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi);
/* Checks that the holes are in the outer ring and not in each other; else sets *problem. The rings neither cross nor
 * overlap. */
void sunder_i_nesting_check(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, const sunder_i_edge_tree *tree,
                            sunder_i_problem *problem);

/* ---- canonical_rings.c ---- */

/* Sorts rings, holes and polygons canonically. The arena is for temporary memory. Returns false if out of memory. */
bool sunder_i_rings_canonical(sunder_i_rings *r, sunder_i_arena *arena);

/* ---- shape_pieces.c, bridge.c, merge_triangles.c ---- */

/* A triangulation: triangle t has the half-edges 3 t .. 3 t + 2; merging changes next and prev. */
typedef struct sunder_i_mesh {
    uint32_t halves;
    uint32_t *origin, *twin, *next, *prev;
} sunder_i_mesh;

typedef struct sunder_i_pieces {
    uint32_t pieces, corners;
    uint32_t *piece_end, *piece_vertex;
} sunder_i_pieces;

/* Finds the convex pieces of all polygons of r, in the arena. The rings are in the cleaned form of shape.h, so that
 * each vertex represents one sector of the interior. Returns false if out of memory. */
bool sunder_i_pieces_find(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_pieces *out);

/* A polygon with holes as one closed walk. Its nodes are vertices; the end of a bridge has several nodes. */
typedef struct sunder_i_walk {
    uint32_t nodes;
    uint32_t *vertex, *next, *prev;
    uint32_t *beyond; /* what is on the right of the edge node -> next: NONE, a half-edge, or SUNDER_I_BRIDGE + the
                       * number of a bridge */
} sunder_i_walk;

#define SUNDER_I_BRIDGE 0x80000000u

/* Joins the holes ring_lo + 1 .. ring_hi of one polygon to its outer ring by bridges; all rings are linked cycles of
 * the walk. */
void sunder_i_bridge_holes(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_walk *walk,
                           sunder_i_arena *arena);
/* Triangulates one polygon, the rings ring_lo .. ring_hi, in the arena; the twin of a half-edge on a ring is NONE.
 * Returns false if out of memory. */
bool sunder_i_triangulate(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_arena *arena,
                          sunder_i_mesh *mesh);
/* Returns whether the diagonal h with the twin g can be removed: the union of the pieces on its two sides is strictly
 * convex at both its ends. */
bool sunder_i_mesh_removable(const sunder_i_rings *r, const sunder_i_mesh *mesh, uint32_t h, uint32_t g);
void sunder_i_mesh_remove(sunder_i_mesh *mesh, uint32_t h, uint32_t g);
/* Removes diagonals as long as the pieces remain strictly convex. */
void sunder_i_mesh_merge(const sunder_i_rings *r, sunder_i_mesh *mesh);

/* ---- finish.c ---- */

/* Allocates one block for the shape and its arrays and copies the raw input, the cleaned form and the pieces to it.
 * NULL: out of memory. */
sunder_shape *sunder_i_shape_assemble(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                                      const sunder_i_rings *r, const sunder_i_pieces *pieces);
/* The position of a canonical ring in a valid raw ring: its first vertex is raw vertex `start`, and its direction is
 * reversed if `turned`. */
typedef struct sunder_i_small_ring {
    uint32_t start;
    bool turned;
} sunder_i_small_ring;

/* Returns the raw vertex that is vertex i of the canonical ring with n vertices. */
static inline uint32_t sunder_i_small_ring_corner(sunder_i_small_ring ring, uint32_t n, uint32_t i)
{
    const uint32_t k = ring.turned ? ring.start + n - i : ring.start + i;
    return k < n ? k : k - n;
}

/* Does the same for one such ring of n vertices, at most SUNDER_I_FEW_CORNERS: all `raw` vertices except perhaps the
 * closing one are corners. */
sunder_shape *sunder_i_shape_assemble_small(const double *xy, size_t raw, uint32_t n, sunder_i_small_ring ring,
                                            const sunder_i_pieces *pieces);
/* Sets box and lowest bit from the coordinates, or from `known` unless that is NULL (not for rational shapes). */
void sunder_i_shape_measure(sunder_shape *shape, const sunder_i_extent *known);
/* Copies the marks of vertices with a common position from a shape with the same coincidences. */
void sunder_i_shape_copy_shared(sunder_shape *shape, const bool *shared);
/* Marks that no two vertices have a common position. */
void sunder_i_shape_mark_none_shared(sunder_shape *shape);
/* Sets shared[] by comparing positions. The arena is for temporary memory. Returns false if out of memory. */
bool sunder_i_shape_mark_shared(sunder_shape *shape, sunder_i_arena *arena);

#endif
