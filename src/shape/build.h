/* A shape in the making: what the stages of sunder_shape_from_rings() hand each other.
 *
 * rings.c          room for them
 * clean_ring.c          one raw ring -> its corners
 * edge_tree.c      candidate pairs of edges, and edges above a point, without looking at all of them
 * intersections.c  where rings cross (an error) or touch
 * simple.c         that nothing meets, by a sweep, where boxes do not tell edges apart
 * nesting.c        orientation; holes inside outer rings, and not inside each other
 * canonical_rings.c      rings, holes and polygons in an order of the set's own
 * repair.c         the even-odd set of a polygon in its place, by the arrangement of arcs.c and even_odd.c
 * shape_pieces.c         holes bridged (bridge.c), ears cut off (ears.c), triangles merged (merge_triangles.c)
 * finish.c         everything into one block of memory
 * small_polygon.c  all of that for one small polygon that is sound as it is; its pieces are of small_pieces.c
 * few_corners.c    what is the same for all rings of few corners */
#ifndef SUNDER_I_BUILD_H
#define SUNDER_I_BUILD_H

#include "predicate/narrow.h"
#include "shape/shape.h"
#include "spatial/box_tree.h"

#define SUNDER_I_NONE UINT32_MAX

/* Rings on a lattice. Vertex numbers run along the rings in order.
 *
 * xy holds the coordinates as doubles: exact ones, or (rounded) the nearest doubles of rationals. Rounding is monotone,
 * so xy[i] < xy[j] always decides the order; equality decides it only where nothing was rounded. */
typedef struct sunder_i_rings {
    sunder_i_lattice *lattice;
    uint32_t vertices, rings, polygons;
    sunder_i_point *at;
    double *xy;
    bool rounded;
    uint32_t *source; /* raw vertex number of each vertex, or SUNDER_I_MADE + number of a point made by repair.c */
    uint32_t *ring_end, *poly_end, *next, *prev;
    size_t room[3]; /* for vertices, rings, polygons */
} sunder_i_rings;

#define SUNDER_I_MADE 0x80000000u

/* Reserves room for more vertices, rings or polygons (rings.c); contents stay. False if memory is out. */
bool sunder_i_rings_grow(sunder_i_rings *r, sunder_i_arena *arena, size_t vertices, size_t rings, size_t polygons);

/* Order by x, by y, and lexicographic (x first). */
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

/* Does the direction from p to d point into the open wedge that opens counter-clockwise from p->u to p->w? Directions
 * that agree with u or w are not inside. u and w may agree: the wedge is then all the rest of the circle. */
bool sunder_i_in_wedge(const sunder_i_rings *r, uint32_t p, uint32_t u, uint32_t w, uint32_t d);

/* ---- clean_ring.c ---- */

typedef enum sunder_i_fault {
    SUNDER_I_SOUND,
    SUNDER_I_EMPTY,    /* a ring without vertices; vertex is then the number of the raw ring */
    SUNDER_I_FEW,      /* under three distinct vertices */
    SUNDER_I_FLAT,     /* no area */
    SUNDER_I_SPIKE,    /* an edge that runs back along the one before */
    SUNDER_I_CROSSES,  /* two edges cross, or a ring passes through itself at a vertex */
    SUNDER_I_OVERLAPS, /* two edges share a piece */
    SUNDER_I_OUTSIDE,  /* a hole outside its outer ring */
    SUNDER_I_NESTED    /* a hole in a hole */
} sunder_i_fault;

/* What is wrong, and where: vertices are raw numbers; other is the second edge or ring's vertex, or NONE. */
typedef struct sunder_i_problem {
    sunder_i_fault fault;
    uint32_t vertex, other;
} sunder_i_problem;

/* Corners of the raw ring lo..hi into keep (room for hi - lo): neither repeated nor collinear vertices. Returns how
 * many; fewer than three or a spike is reported in problem. */
uint32_t sunder_i_clean_ring(sunder_i_lattice *lattice, const double *xy, const sunder_i_point *at, uint32_t lo,
                             uint32_t hi, uint32_t *keep, sunder_i_problem *problem);

/* ---- edge_tree.c ---- */

/* A tree of boxes over edges in the order of the rings; rings that are many are first put in order along a
 * space-filling curve. Edges near each other along a ring are near each other in the plane, so nothing is sorted. */
typedef struct sunder_i_edge_tree {
    sunder_i_box_tree boxes;
    uint32_t *edge; /* tails, in tree order; NULL: the edge first + i itself */
    uint32_t first;
} sunder_i_edge_tree;

/* Of the rings ring_lo .. ring_hi; memory in the arena, which says if that failed. */
void sunder_i_edge_tree_build(sunder_i_edge_tree *tree, const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi,
                              sunder_i_arena *arena);

/* Calls visit for each pair of edges whose boxes meet, until it returns false. Each pair once. */
typedef bool (*sunder_i_pair_visitor)(void *user, uint32_t e, uint32_t f);
bool sunder_i_edge_tree_pairs(const sunder_i_edge_tree *tree, const sunder_i_rings *r, sunder_i_pair_visitor visit,
                              void *user);

/* Calls visit for the edges whose boxes may meet a closed box (x0 y0 x1 y1), and some others. The visitor may shrink
 * the box on the way: what no longer meets it is left out. */
typedef void (*sunder_i_edge_visitor)(void *user, uint32_t e);
void sunder_i_edge_tree_query(const sunder_i_edge_tree *tree, const double box[4], sunder_i_edge_visitor visit,
                              void *user);

/* Fewer edges than this are looked at one by one; from here on a tree pays. */
#define SUNDER_I_TREE_FROM 40

/* ---- intersections.c, simple.c, nesting.c ---- */

/* Do the rings ring_lo .. ring_hi (one polygon) cross or share a piece of edge? *touches: some meet in points, and so
 * may need the arrangement to be told apart. tree may be NULL for few edges. */
void sunder_i_intersections_find(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi,
                                 const sunder_i_edge_tree *tree, sunder_i_arena *arena, sunder_i_problem *problem,
                                 bool *touches);
/* Is it certain that they meet nowhere but in the corners of consecutive edges? (On cleaned rings: exactly if so.) The
 * arena is for scratch; false too if it failed. */
bool sunder_i_rings_simple(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_arena *arena);

/* Turns the outer ring counter-clockwise and holes clockwise. */
void sunder_i_orient_rings(sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi);
/* Checks that the holes lie in the outer ring and not in each other. The rings neither cross nor overlap. */
void sunder_i_nesting_check(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, const sunder_i_edge_tree *tree,
                            sunder_i_problem *problem);

/* ---- canonical_rings.c ---- */

/* Puts rings, holes and polygons in their canonical order. The arena is for scratch; false if memory is out. */
bool sunder_i_rings_canonical(sunder_i_rings *r, sunder_i_arena *arena);

/* ---- shape_pieces.c, bridge.c, merge_triangles.c ---- */

/* A triangulation by half-edges 3t .. 3t + 2 of triangle t; merging relinks next and prev. */
typedef struct sunder_i_mesh {
    uint32_t halves;
    uint32_t *origin, *twin, *next, *prev;
} sunder_i_mesh;

typedef struct sunder_i_pieces {
    uint32_t pieces, corners;
    uint32_t *piece_end, *piece_vertex;
} sunder_i_pieces;

/* Convex pieces of all polygons of r, in the arena. The rings are those of the cleaned form in shape.h, so each vertex
 * stands for one sector of the interior. False if memory is out. */
bool sunder_i_pieces_find(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_pieces *out);

/* A polygon with holes as one closed walk: nodes are corners, several of one vertex where a bridge ends. */
typedef struct sunder_i_walk {
    uint32_t nodes;
    uint32_t *vertex, *next, *prev;
    uint32_t *beyond; /* what lies right of the edge node -> next: NONE, a half-edge, or BRIDGE + number */
} sunder_i_walk;

#define SUNDER_I_BRIDGE 0x80000000u

/* Joins the holes ring_lo + 1 .. ring_hi of one polygon, already linked cycles in walk, to its outer ring by
 * bridges. */
void sunder_i_bridge_holes(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_walk *walk,
                           sunder_i_arena *arena);
/* The triangles of one polygon, rings ring_lo .. ring_hi, on arena memory; half-edges on its rings have the twin
 * NONE. False if memory is out. */
bool sunder_i_triangulate(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_arena *arena,
                          sunder_i_mesh *mesh);
/* May the diagonal h, whose twin is g, be removed: is the union of the pieces on its two sides strictly convex at both
 * its ends? */
bool sunder_i_mesh_removable(const sunder_i_rings *r, const sunder_i_mesh *mesh, uint32_t h, uint32_t g);
void sunder_i_mesh_remove(sunder_i_mesh *mesh, uint32_t h, uint32_t g);
/* Removes diagonals while the pieces stay strictly convex. */
void sunder_i_mesh_merge(const sunder_i_rings *r, sunder_i_mesh *mesh);

/* ---- finish.c ---- */

/* One block for the shape and its arrays; the raw input is copied in, the cleaned form and the pieces too. */
sunder_shape *sunder_i_shape_assemble(const double *xy, const size_t *ring_end, const size_t *poly_end, size_t polygons,
                                      const sunder_i_rings *r, const sunder_i_pieces *pieces);
/* How the corners of a ring that is sound as it was given stand in it: from this one on, and the other way if
 * turned. */
typedef struct sunder_i_small_ring {
    uint32_t start;
    bool turned;
} sunder_i_small_ring;

/* Which of the n corners as given is corner i of the canonical ring. */
static inline uint32_t sunder_i_small_ring_corner(sunder_i_small_ring ring, uint32_t n, uint32_t i)
{
    const uint32_t k = ring.turned ? ring.start + n - i : ring.start + i;
    return k < n ? k : k - n;
}

/* The same of one such ring of n corners, at most SUNDER_I_FEW_CORNERS: all `raw` vertices but perhaps the closing one
 * are corners. */
sunder_shape *sunder_i_shape_assemble_small(const double *xy, size_t raw, uint32_t n, sunder_i_small_ring ring,
                                            const sunder_i_pieces *pieces);
/* Box and extent from the coordinates (not for rational shapes). */
void sunder_i_shape_measure(sunder_shape *shape, const sunder_i_extent *known);
/* Of another shape whose places are as much alike. */
void sunder_i_shape_copy_shared(sunder_shape *shape, const bool *shared);
/* Where no two places are known to coincide. */
void sunder_i_shape_mark_none_shared(sunder_shape *shape);
/* Fills shared[] by comparing places. The arena is for scratch; false if memory is out. */
bool sunder_i_shape_mark_shared(sunder_shape *shape, sunder_i_arena *arena);

#endif
