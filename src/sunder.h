/* sunder.h: exact Minkowski sums of polygonal sets, least separating translations, and the displacement of
 * whole map layers.
 *
 * Conventions. Every function that can fail returns a sunder_status (SUNDER_OK is 0) and takes a caller-owned
 * sunder_error, which may be NULL. Unless a function says otherwise, all outputs are untouched on failure. The caller
 * frees what it receives through **out with the _free function of its type; _free(NULL) is fine. The object owns what
 * its getters return by pointer; it is valid until the object is freed. Objects do not change once they are built, so
 * threads may share them (a layer is built until its barriers and side anchors are set). The only global state is the
 * allocation hooks, which are set once, before any other call; each thread also has a watch of its own.
 *
 * Lengths are in the units of the input. Every finite double is taken as the dyadic rational that it is. Inputs are
 * never rounded; results are rounded only where a function says so.
 *
 * Functions that are declared SUNDER_API are stable: a program that is compiled with this header runs with every later
 * library of the same soname. Those that are declared SUNDER_EXPERIMENTAL may change in any version that is not a mere
 * correction. docs/api.md says what is promised in detail, and how structs of options grow.
 *
 * Two more headers belong to the interface: sunder_proof.h for proofs, and sunder_parts.h for layers that are separated
 * in parts.
 *
 * Keys such as [GRS83] resolve in REFERENCES.md. It is installed with the documentation (share/doc/sunder), and so is
 * api.md; paths that begin with src/ are those of the source code. */
#ifndef SUNDER_H
#define SUNDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SUNDER_VERSION "0.1.0"

#if defined(_WIN32) || !defined(__GNUC__)
#define SUNDER_API
#else
#define SUNDER_API __attribute__((visibility("default")))
#endif
#define SUNDER_EXPERIMENTAL SUNDER_API

/* ---- Status and errors ------------------------------------------------------------------------------------ */

typedef enum sunder_status {
    SUNDER_OK = 0,
    SUNDER_EINVALID, /* a geometry breaks a rule; the error names the polygon, ring and vertex */
    SUNDER_EARG,     /* an option or argument is out of its range */
    SUNDER_ERANGE,   /* doubles cannot hold the result */
    SUNDER_ENOMEM,   /* an allocation failed; everything made so far has been released */
    SUNDER_ECANCEL,  /* a progress callback, or the watch of the thread, asked to stop */
    SUNDER_ESIZE,    /* there are more vertices, pairs of convex pieces, or corners of a sum than can be numbered */
    SUNDER_EFAULT    /* the result failed the library's own exact check, and is withheld; this is a defect to report */
} sunder_status;

#define SUNDER_MESSAGE_MAX 256

typedef struct sunder_error {
    sunder_status status;
    size_t polygon, ring, vertex; /* the place of the error, counted from 0; SIZE_MAX for what does not apply */
    char message[SUNDER_MESSAGE_MAX];
} sunder_error;

/* Returns a fixed sentence for each code; never NULL. */
SUNDER_API const char *sunder_status_string(sunder_status status);

/* Returns the version of the library: the SUNDER_VERSION that it was built with. */
SUNDER_API const char *sunder_version(void);

/* Returns the version of the GMP that the library runs with. It need not be the version that it was built with. */
SUNDER_API const char *sunder_gmp_version(void);

/* Sets the three functions through which the library allocates and frees all memory. NULL for all three restores
 * malloc, realloc and free. Call it before any other function, and never while an object of the library exists. */
SUNDER_API void sunder_set_allocator(void *(*allocate)(size_t), void *(*reallocate)(void *, size_t),
                                     void (*release)(void *));

/* Frees a text or an array that a function of the library allocated for the caller. */
SUNDER_API void sunder_free(void *memory);

/* The numbers of elementary operations that were done, of the kinds that the literature counts [AFH00, section 3]. */
typedef struct sunder_counts {
    uint64_t comparisons;           /* comparisons of two points, or of two crossings along a line */
    uint64_t orientation_tests;     /* decisions about the side of a line on which a point lies */
    uint64_t segment_intersections; /* crossing points that were constructed */
    uint64_t exact_fallbacks;       /* decisions that the floating-point filter left to exact arithmetic */
} sunder_counts;

/* A progress callback. It is called with the fraction of the work that is done, in [0, 1], often with the same fraction
 * again. If it returns false, the function that called it fails with SUNDER_ECANCEL. Calls do not overlap, but if
 * threads share the work they may come from any of these threads. At most some milliseconds of work lie between two
 * calls, and between a false result and the return of the function (tests count it). */
typedef bool (*sunder_progress)(double fraction, void *user);

/* Sets the watch of the calling thread, which can also stop functions that take no progress callback; NULL removes it.
 * Every function of this library that the thread calls then calls go_on(user) as often as a progress callback. Once
 * go_on has returned false, that function fails with SUNDER_ECANCEL, and so does every later function that can be
 * stopped, at once, until the thread sets another watch or removes it. Calls of go_on do not overlap, but they may come
 * from threads that the library started on behalf of the calling thread. */
SUNDER_API void sunder_watch(bool (*go_on)(void *user), void *user);

/* ---- Options ------------------------------------------------------------------------------------------------ */

/* A struct of options begins with its size, so that a later version can add members at its end. The library reads as
 * many bytes as `size` says. Members of the library's struct beyond these bytes have their defaults. If the caller's
 * struct is longer than the library's, the bytes beyond the library's struct must be 0.
 *
 * The _init function of a struct sets `size` and the defaults. It is inline, so it uses the size that the struct has in
 * the caller's header. Other languages call the _init_sized function, which the library exports. NULL in place of
 * options means the defaults.
 *
 * Fails  SUNDER_EARG  `size` is 0, no multiple of sizeof(size_t), or above SUNDER_OPTIONS_MAX; or a byte beyond the
 *                     library's own struct is not 0. */
#define SUNDER_OPTIONS_MAX 4096

/* ---- Shapes: polygonal sets ------------------------------------------------------------------------------- */

typedef struct sunder_shape sunder_shape;

typedef enum sunder_validity {
    SUNDER_VALIDITY_STRICT,  /* invalid rings are an error */
    SUNDER_VALIDITY_EVEN_ODD /* an invalid polygon is the set that its rings enclose by the even-odd rule, exactly */
} sunder_validity;

/* Returns "strict" or "even-odd". All functions whose names end in _string return "" for a number that is no value of
 * the enumeration, and never NULL. */
SUNDER_API const char *sunder_validity_string(sunder_validity validity);

/* Makes a polygonal set, the union of polygons that are called its members, from plain arrays.
 *
 * xy         The 2 * n coordinates x0 y0 x1 y1 ... of the vertices of all rings, ring after ring. All must be finite.
 * ring_end   ring_end[r] is the index past the last vertex (not coordinate) of ring r. The number of rings is
 *            poly_end[polygons - 1].
 * poly_end   poly_end[p] is the index past the last ring of polygon p. The first ring of a polygon is its outer one.
 * polygons   The number of polygons; 0 gives the empty set.
 * validity   SUNDER_VALIDITY_STRICT: rings may be closed or not, of either orientation, with repeated and collinear
 *            vertices; they may touch at points, but may not cross or share a piece of an edge. Members may touch and
 *            overlap. A polygon whose interior is divided where its rings touch counts as several members.
 *            SUNDER_VALIDITY_EVEN_ODD: an invalid polygon is replaced by the closure of the set that its rings enclose
 *            by the even-odd rule, with exact rational vertices; sunder_shape_repaired() is true then. A polygon that
 *            encloses nothing is left out.
 * out        A new shape, freed by the caller with sunder_shape_free(). The arrays are copied.
 * Fails      SUNDER_EARG      ends do not ascend, or `validity` is none of its values
 *            SUNDER_EINVALID  a coordinate is not finite; or, with SUNDER_VALIDITY_STRICT, a ring has fewer than three
 *                             distinct vertices, has no area, or crosses itself or another ring, or a hole lies outside
 *                             its outer ring or inside another hole
 *            SUNDER_ESIZE     there are more than 2^27 vertices
 * Cost       O(n log n) if edges are short compared with the extent of the set, as on maps. */
SUNDER_API sunder_status sunder_shape_from_rings(const double *xy, const size_t *ring_end, const size_t *poly_end,
                                                 size_t polygons, sunder_validity validity, sunder_shape **out,
                                                 sunder_error *err);

/* Makes a nearly regular polygon about the origin, whose vertices are doubles. inside = false: it contains the closed
 * disc of the radius. inside = true: it lies in that disc, and its vertices on the axes are at exactly the radius.
 *
 * Fails      SUNDER_EARG      the radius is not positive and finite, or segments is less than 3 or more than 2^24
 *            SUNDER_ERANGE    a vertex leaves the range of doubles, or the disc is too small for them */
SUNDER_API sunder_status sunder_shape_disc(double radius, unsigned segments, bool inside, sunder_shape **out,
                                           sunder_error *err);

/* Makes the axis-parallel rectangle with this width and height that is centred on the origin. SUNDER_EARG if one of
 * them is not positive and finite, SUNDER_ERANGE if half of one is not a double. */
SUNDER_API sunder_status sunder_shape_rectangle(double width, double height, sunder_shape **out, sunder_error *err);

/* Makes the set -S, the reflection of the shape S in the origin. */
SUNDER_API sunder_status sunder_shape_reflect(const sunder_shape *shape, sunder_shape **out, sunder_error *err);

/* Makes S + (dx, dy), the shape S moved. Each coordinate is the double nearest to x + dx or y + dy; *exact is set to
 * whether none was rounded. If rounding makes a polygon invalid, it is taken by the even-odd rule. SUNDER_EARG if dx or
 * dy is not finite, SUNDER_ERANGE if a coordinate leaves the range of doubles. */
SUNDER_API sunder_status sunder_shape_translate(const sunder_shape *shape, double dx, double dy, sunder_shape **out,
                                                bool *exact, sunder_error *err);

SUNDER_API void sunder_shape_free(sunder_shape *shape);

/* Return the number of polygons, and the number of vertices, of the cleaned form of the shape, which has no repeated
 * and no collinear vertices. */
SUNDER_API size_t sunder_shape_polygons(const sunder_shape *shape);
SUNDER_API size_t sunder_shape_vertices(const sunder_shape *shape);
SUNDER_API bool sunder_shape_is_empty(const sunder_shape *shape);
/* Returns whether a polygon was invalid and has been replaced by the even-odd rule. */
SUNDER_API bool sunder_shape_repaired(const sunder_shape *shape);
/* Returns whether two rings of one polygon met, or a ring met itself, in the rings that were given. If not, the
 * polygons of a strict shape are valid in the sense of OGC simple features, which allow less than
 * SUNDER_VALIDITY_STRICT does. For a repaired shape the result is true. */
SUNDER_API bool sunder_shape_touches(const sunder_shape *shape);
/* Returns the number of rings of one polygon of the cleaned form: 1 + the number of its holes; ring 0 is the outer one.
 * Each ring begins at its smallest corner by x, then y. Holes and polygons are sorted by their corners, whatever the
 * order in which they were given; a reflected shape keeps the order of the shape from which it was made. */
SUNDER_API size_t sunder_shape_rings(const sunder_shape *shape, size_t polygon);
/* Returns the corners x0 y0 x1 y1 ... of one ring of the cleaned form, and sets *n to their number. Outer rings are
 * counter-clockwise, holes clockwise. The corners of a repaired shape are rounded to the nearest doubles. */
SUNDER_API const double *sunder_shape_ring(const sunder_shape *shape, size_t polygon, size_t ring, size_t *n);
/* Sets *xy, *ring_end and *poly_end to the rings that were given, before cleaning, and returns the number of polygons.
 * The arrays are those of sunder_shape_from_rings(), which makes the same shape from them (for a repaired shape, with
 * SUNDER_VALIDITY_EVEN_ODD). In a moved or reflected shape these rings are moved or reflected as well. */
SUNDER_API size_t sunder_shape_given(const sunder_shape *shape, const double **xy, const size_t **ring_end,
                                     const size_t **poly_end);
/* Sets box to xmin, ymin, xmax, ymax. They are rounded outwards for a repaired shape, and 0 for the empty set. */
SUNDER_API void sunder_shape_box(const sunder_shape *shape, double box[4]);
/* Returns the sum of the areas of the members (an overlap of two members counts twice), rounded to the nearest double.
 * Neither this function nor sunder_shape_anchor() can fail, as they allocate nothing. */
SUNDER_API double sunder_shape_area(const sunder_shape *shape);
/* Sets xy to the anchor of the shape, rounded to the nearest doubles; (0, 0) for the empty set. The anchor is an
 * interior point that depends on the point set alone, not on how its rings are written. Let U be the interior of the
 * union of all members. The horizontal line at half the height of U meets U in intervals, and the anchor is the middle
 * of the widest interval, of equal ones the leftmost. If the line does not meet U, the rule is applied to the part of U
 * below the line. */
SUNDER_API void sunder_shape_anchor(const sunder_shape *shape, double xy[2]);

/* ---- Minkowski sums --------------------------------------------------------------------------------------- */

typedef struct sunder_sum sunder_sum;

/* The algorithms that compute a sum. The result is the same for every algorithm, decomposition, order and seed. */
typedef enum sunder_algorithm {
    SUNDER_ALGORITHM_AUTO,        /* the convolution; with keep_map the arrangement */
    SUNDER_ALGORITHM_CONVOLUTION, /* uses only sides that can bound the sum, line by line: by far the fastest */
    SUNDER_ALGORITHM_ARRANGEMENT, /* makes one arrangement of all subsums of convex pieces, marks its cells [AFH00] */
    SUNDER_ALGORITHM_INCREMENTAL, /* unites one subsum after the other with the union so far [AFH00] */
    SUNDER_ALGORITHM_DIVIDE       /* makes P + Q_j incrementally for each piece Q_j, then unites pairs [AFH00] */
} sunder_algorithm;

/* How the operands are cut into convex pieces. The convolution does not use it. See src/decomposition/README. */
typedef enum sunder_decomposition {
    SUNDER_DECOMPOSITION_AUTO,           /* the angle bisector: fewest crossings on most families [AFH02] */
    SUNDER_DECOMPOSITION_ANGLE_BISECTOR, /* a cut from each reflex vertex, pairs of reflex vertices first */
    SUNDER_DECOMPOSITION_VERTICAL,       /* vertical cuts from the reflex vertices */
    SUNDER_DECOMPOSITION_TRIANGULATION,
    SUNDER_DECOMPOSITION_HERTEL_MEHLHORN, /* a triangulation without its needless diagonals */
    SUNDER_DECOMPOSITION_OPTIMAL,         /* the fewest pieces without new vertices; HERTEL_MEHLHORN for members with
                                           * holes or more than 500 vertices */
    SUNDER_DECOMPOSITION_MIXED            /* the pieces of both operands with the least total length of the subsums'
                                           * boundaries; HERTEL_MEHLHORN for the same members as OPTIMAL */
} sunder_decomposition;

/* The order in which subsums are united. The convolution does not use it. */
typedef enum sunder_order {
    SUNDER_ORDER_RANDOM,
    SUNDER_ORDER_FAT,  /* the fattest first, see src/unions/README */
    SUNDER_ORDER_GIVEN /* in the order of the pieces */
} sunder_order;

/* "auto", "convolution", "arrangement", "incremental", "divide". */
SUNDER_API const char *sunder_algorithm_string(sunder_algorithm algorithm);
/* "auto", "angle-bisector", "vertical", "triangulation", "hertel-mehlhorn", "optimal", "mixed". */
SUNDER_API const char *sunder_decomposition_string(sunder_decomposition decomposition);
/* "random", "fat", "given". */
SUNDER_API const char *sunder_order_string(sunder_order order);

/* Options of sums and of morphology. The defaults are all zero, except for the size. */
typedef struct sunder_sum_options {
    size_t size;              /* sizeof(sunder_sum_options) */
    sunder_progress progress; /* NULL: none */
    void *progress_user;
    sunder_algorithm algorithm;
    sunder_decomposition decomposition;
    sunder_order order;
    uint64_t seed; /* seed of random orders */
    bool keep_map; /* keeps the map for sunder_sum_map(); SUNDER_EARG with the convolution, which makes none */
    /* The number of threads of sunder_morphology(), except for a dilation; 0 or 1: the calling thread only. The result
     * is the same for every number. */
    unsigned threads;
} sunder_sum_options;

SUNDER_API void sunder_sum_options_init_sized(sunder_sum_options *options, size_t size);
static inline void sunder_sum_options_init(sunder_sum_options *options)
{
    sunder_sum_options_init_sized(options, sizeof *options);
}

/* The numbers of polygons, of holes of polygons, and of vertices of a sum, and of its two kinds of degenerate holes. */
typedef struct sunder_sum_size {
    size_t polygons, holes, vertices, degenerate_segments, degenerate_points;
} sunder_sum_size;

/* Computes the Minkowski sum P + Q = { p + q : p in P, q in Q } of two polygonal sets, exactly.
 *
 * p, q     The operands, which are not modified; they may be the same. An operand without area gives the empty sum.
 * options  NULL for the defaults.
 * out      A new sum, freed by the caller with sunder_sum_free(). It is in canonical form, so equal point sets compare
 *          equal. It has one polygon for each connected component C of the interior of P + Q, and this polygon has one
 *          ring for each component of the plane minus the closure of C. No vertex is collinear with its neighbours. A
 *          ring starts at its lexicographically smallest vertex, which is not repeated at the end. Outer rings are
 *          counter-clockwise, holes clockwise. Holes and polygons are sorted as sequences of vertices.
 *
 * Degenerate holes are the points of the interior of P + Q that are not in int P + int Q. They are part of the result:
 * as maximal segments, and as points that lie on no such segment.
 *
 * Fails   SUNDER_EARG for an option that is none of its values; SUNDER_ESIZE, SUNDER_ENOMEM, SUNDER_ECANCEL
 * Source  [GRS83] convolution; [BL11] reduced convolution; [AFH00] unions of subsums; src/minkowski/README and
 *         src/unions/README describe the algorithms. */
SUNDER_API sunder_status sunder_minkowski_sum(const sunder_shape *p, const sunder_shape *q,
                                              const sunder_sum_options *options, sunder_sum **out, sunder_error *err);
SUNDER_API void sunder_sum_free(sunder_sum *sum);

SUNDER_API void sunder_sum_get_size(const sunder_sum *sum, sunder_sum_size *size);
SUNDER_EXPERIMENTAL void sunder_sum_get_counts(const sunder_sum *sum, sunder_counts *counts);
/* Sets the seconds of wall time that were spent in decomposing, in making subsums, and in uniting them. */
SUNDER_EXPERIMENTAL void sunder_sum_seconds(const sunder_sum *sum, double *decompose, double *subsums, double *unite);

/* The method that was used. decomposition is AUTO if nothing was decomposed (as by the convolution). If HERTEL_MEHLHORN
 * had to replace the requested decomposition, it is HERTEL_MEHLHORN. */
typedef struct sunder_sum_method {
    sunder_algorithm algorithm; /* never AUTO */
    sunder_decomposition decomposition;
    sunder_order order;
    size_t pieces_p, pieces_q; /* convex pieces; 0 with the convolution */
} sunder_sum_method;

typedef enum sunder_phase { SUNDER_PHASE_DECOMPOSE, SUNDER_PHASE_SUBSUMS, SUNDER_PHASE_UNION } sunder_phase;
/* "decompose", "subsums", "union"; never NULL. */
SUNDER_EXPERIMENTAL const char *sunder_phase_string(sunder_phase phase);

SUNDER_EXPERIMENTAL void sunder_sum_get_method(const sunder_sum *sum, sunder_sum_method *method);
/* Sets *counts to the operations of one phase. For the convolution, which has no phases, returns false and sets 0. */
SUNDER_EXPERIMENTAL bool sunder_sum_phase(const sunder_sum *sum, sunder_phase phase, sunder_counts *counts);

/* Returns the number of rings of a polygon: 1 + the number of its holes; ring 0 is the outer one. */
SUNDER_API size_t sunder_sum_rings(const sunder_sum *sum, size_t polygon);
/* Returns the numbers of the vertices of one ring, in order, and sets *n to how many there are. */
SUNDER_API const uint32_t *sunder_sum_ring(const sunder_sum *sum, size_t polygon, size_t ring, size_t *n);
/* Sets ends to the vertex numbers of the two ends of degenerate segment i, the lexicographically smaller end first. */
SUNDER_API void sunder_sum_segment(const sunder_sum *sum, size_t i, uint32_t ends[2]);
/* Returns the vertex number of degenerate point i. */
SUNDER_API uint32_t sunder_sum_point(const sunder_sum *sum, size_t i);
/* Sets xy[2 n] to the doubles nearest to the coordinates of n vertices. Raises *deviation, if it is less, to a bound of
 * the distance between a vertex and its doubles (infinite if a vertex is beyond the range of doubles). SUNDER_ENOMEM:
 * *deviation is untouched then, but xy may have been written. */
SUNDER_API sunder_status sunder_sum_vertices(const sunder_sum *sum, const uint32_t *vertex, size_t n, double *xy,
                                             double *deviation, sunder_error *err);
/* Sets xy to the doubles nearest to the coordinates of a vertex; infinite if they are beyond the range of doubles. */
SUNDER_API void sunder_sum_vertex(const sunder_sum *sum, uint32_t vertex, double xy[2]);
/* Sets *x and *y to the exact coordinates of a vertex, as texts "num" or "num/den" in lowest terms. The caller frees
 * both with sunder_free(). */
SUNDER_API sunder_status sunder_sum_vertex_text(const sunder_sum *sum, uint32_t vertex, char **x, char **y,
                                                sunder_error *err);
/* Sets *area to the exact area, as a text "num" or "num/den", which the caller frees with sunder_free(). */
SUNDER_API sunder_status sunder_sum_area_text(const sunder_sum *sum, char **area, sunder_error *err);

/* ---- Growing and shrinking ---------------------------------------------------------------------------------- */

typedef enum sunder_operation {
    SUNDER_OPERATION_DILATE, /* P + B */
    SUNDER_OPERATION_ERODE,  /* { x : B + x in P } */
    SUNDER_OPERATION_OPEN,   /* the dilation of the erosion: the union of all B + x in P */
    SUNDER_OPERATION_CLOSE   /* the erosion of the dilation */
} sunder_operation;

/* "dilate", "erode", "open", "close". */
SUNDER_API const char *sunder_operation_string(sunder_operation operation);

/* Performs an operation of mathematical morphology [Ser82] on the polygonal set P with the set B, exactly. P, B and the
 * result are closed sets.
 *
 * p, b     The operands, which are not modified. Members may overlap; b need not be convex, nor contain the origin.
 * options  progress, seed and threads are used by all operations, the other options by the dilation only. NULL for the
 *          defaults.
 * out      A new sum, freed by the caller with sunder_sum_free(), in canonical form. Its polygons are the closure of
 *          the interior of the result. The segments and points of a dilation are its degenerate holes, which belong to
 *          it. Those of an erosion or a closing are the parts of the result that have no area. An opening has none.
 *
 * Fails   SUNDER_EARG for a set B without area, or no such operation; SUNDER_ESIZE, SUNDER_ENOMEM, SUNDER_ECANCEL
 * Source  src/morphology/README */
SUNDER_API sunder_status sunder_morphology(const sunder_shape *p, const sunder_shape *b, sunder_operation operation,
                                           const sunder_sum_options *options, sunder_sum **out, sunder_error *err);

/* Makes the exact union of the members of a shape, as a new sum without segments and points, which the caller frees
 * with sunder_sum_free(). Its polygons are valid in the sense of OGC simple features, also if members of the shape
 * touched or overlapped. Fails with SUNDER_ENOMEM or SUNDER_ECANCEL. */
SUNDER_API sunder_status sunder_shape_union(const sunder_shape *shape, const sunder_sum_options *options,
                                            sunder_sum **out, sunder_error *err);

/* ---- The planar map beneath a sum --------------------------------------------------------------------------- */

/* The subdivision of the plane from which a sum was read. It is kept if sunder_sum_options.keep_map is set. With
 * SUNDER_ALGORITHM_ARRANGEMENT it is the arrangement of all subsums, otherwise the map of their union. Each face, edge
 * and vertex has a count of the regions that cover it. The regions are the open subsums; the union, if it is computed
 * otherwise, is a single region, and the count is 0 or 1. The degenerate holes are the edges and vertices that no
 * region covers, and around which all faces are covered.
 *
 * Vertices, edges and faces are numbered from 0; face 0 is the unbounded one. Edge e consists of two half-edges: 2 e
 * leads from its lexicographically smaller end to the greater one, and 2 e + 1 leads back. The face of a half-edge is
 * on its left. The sum owns the map. */
typedef struct sunder_map sunder_map;

#define SUNDER_NOWHERE UINT32_MAX

/* Returns the map of a sum, or NULL if it was not kept. */
SUNDER_EXPERIMENTAL const sunder_map *sunder_sum_map(const sunder_sum *sum);
SUNDER_EXPERIMENTAL size_t sunder_map_vertices(const sunder_map *map);
SUNDER_EXPERIMENTAL size_t sunder_map_edges(const sunder_map *map);
SUNDER_EXPERIMENTAL size_t sunder_map_faces(const sunder_map *map);

/* Set the coordinates of a vertex, as nearest doubles and as exact texts, like the functions for vertices of a sum. */
SUNDER_EXPERIMENTAL void sunder_map_vertex(const sunder_map *map, uint32_t vertex, double xy[2]);
SUNDER_EXPERIMENTAL sunder_status sunder_map_vertex_text(const sunder_map *map, uint32_t vertex, char **x, char **y,
                                                         sunder_error *err);
/* Returns one of the half-edges that begin at a vertex, or SUNDER_NOWHERE if the vertex is isolated. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_out(const sunder_map *map, uint32_t vertex);
/* Returns the face that contains an isolated vertex, or SUNDER_NOWHERE if the vertex is not isolated. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_around(const sunder_map *map, uint32_t vertex);

/* Return the vertex at which a half-edge begins, and the opposite half-edge. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_origin(const sunder_map *map, uint32_t half);
SUNDER_EXPERIMENTAL uint32_t sunder_map_twin(uint32_t half);
/* Returns the next half-edge along the boundary of the face on the left. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_next(const sunder_map *map, uint32_t half);
/* Returns the next half-edge, counter-clockwise, that begins at the same vertex. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_turn(const sunder_map *map, uint32_t half);
/* Returns the face on the left of a half-edge. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_face(const sunder_map *map, uint32_t half);

/* Returns a half-edge of the outer boundary of a face, or SUNDER_NOWHERE for face 0, which has none. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_outer(const sunder_map *map, uint32_t face);
/* Returns one half-edge of each inner boundary of a face, and sets *n to their number. */
SUNDER_EXPERIMENTAL const uint32_t *sunder_map_inner(const sunder_map *map, uint32_t face, size_t *n);

/* Return the number of regions that cover a vertex, an edge, a face. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_vertex_covered(const sunder_map *map, uint32_t vertex);
SUNDER_EXPERIMENTAL uint32_t sunder_map_edge_covered(const sunder_map *map, uint32_t edge);
SUNDER_EXPERIMENTAL uint32_t sunder_map_face_covered(const sunder_map *map, uint32_t face);

/* ---- Two features ----------------------------------------------------------------------------------------- */

typedef enum sunder_contact {
    SUNDER_CONTACT_NONE, /* already apart */
    SUNDER_CONTACT_EDGE,
    SUNDER_CONTACT_VERTEX,
    SUNDER_CONTACT_ARC,
    SUNDER_CONTACT_DEGENERATE_SEGMENT,
    SUNDER_CONTACT_DEGENERATE_POINT
} sunder_contact;

/* "none", "edge", "vertex", "arc", "degenerate_segment", "degenerate_point". */
SUNDER_API const char *sunder_contact_string(sunder_contact contact);

typedef struct sunder_separation {
    bool overlap;            /* the interiors meet at the start, or the sets are nearer than the gap */
    bool attained;           /* the translation below is the least one, or with a gap near to it: always true */
    bool rounded_is_free;    /* the doubles (dx, dy) separate the two sets as well; this was checked exactly */
    sunder_contact contact;  /* what the translated Q touches */
    double dx, dy, distance; /* the least translation and its length, rounded to the nearest doubles */
    double lower_bound;      /* a proved lower bound of the least length, less than distance by at most 1e-9 of it */
    char *dx_text, *dy_text, *distance_squared_text; /* exact values, "num" or "num/den"; owned by the struct */
    sunder_counts counts;
} sunder_separation;

/* Finds the least translation of Q after which the interiors of P and Q are disjoint and, with gap > 0, the Euclidean
 * distance of P and Q is at least the gap.
 *
 * It is the global minimum over all free placements, including degenerate ones (exact slides and fits). If several
 * translations are shortest, it is the lexicographically smallest of them; the comparison is exact, also with a gap.
 * With a gap the optimum may be irrational. Then the translation is rational, provably keeps the gap, and is longer
 * than the optimum by at most 1e-9 of its length; lower_bound is then a lower bound of the length of the optimum.
 *
 * gap     Finite and >= 0.
 * out     On success its texts belong to the caller, who frees them with sunder_separation_clear(). If P or Q is empty,
 *         the translation is zero.
 * Fails   SUNDER_EARG for a gap out of its range. SUNDER_EFAULT if the search left the range of doubles, which can
 *         happen only with a gap of more than 2^700 times the shortest side. SUNDER_ENOMEM, SUNDER_ECANCEL.
 * Source  [LM95] for the role of the no-fit polygon; src/separation/README for the search. */
SUNDER_API sunder_status sunder_pair_separate(const sunder_shape *p, const sunder_shape *q, double gap,
                                              sunder_separation *out, sunder_error *err);
SUNDER_API void sunder_separation_clear(sunder_separation *separation);

/* Sets *overlap to whether the interiors of P and Q meet, exactly. */
SUNDER_API sunder_status sunder_pair_overlap(const sunder_shape *p, const sunder_shape *q, bool *overlap,
                                             sunder_error *err);
/* Sets *apart to whether the interiors of P and Q are disjoint and no point of P is nearer than the gap to a point of
 * Q, exactly. */
SUNDER_API sunder_status sunder_pair_apart(const sunder_shape *p, const sunder_shape *q, double gap, bool *apart,
                                           sunder_error *err);
/* Sets *distance to the distance of P and Q, rounded to the nearest double (0 if they meet), and on_p and on_q to the
 * ends of a shortest link between them. */
SUNDER_API sunder_status sunder_pair_distance(const sunder_shape *p, const sunder_shape *q, double *distance,
                                              double on_p[2], double on_q[2], sunder_error *err);

/* ---- Obstacles -------------------------------------------------------------------------------------------- */

/* An obstacle of a route or of a layer, which the interior of what moves may not meet: a polygonal set, lines and
 * points, or both. Shape and arrays remain the caller's. They must be valid during the call, or for as long as the
 * layer to which they are given exists. */
typedef struct sunder_obstacle {
    const sunder_shape *shape; /* NULL for none */
    const double *xy;          /* x0 y0 x1 y1 ... of the points of all lines, line after line; finite */
    const size_t *line_end;    /* [lines] the index past the last point of each line; a line of one point is a point */
    size_t lines;
} sunder_obstacle;

/* ---- A whole layer ---------------------------------------------------------------------------------------- */

typedef struct sunder_layer sunder_layer;

typedef enum sunder_containment {
    SUNDER_CONTAINMENT_BLOCK,   /* a feature that lies in another feature joins its block */
    SUNDER_CONTAINMENT_IGNORE,  /* a feature that lies in another feature may overlap it */
    SUNDER_CONTAINMENT_SEPARATE /* a feature that lies in another feature is separated like any other */
} sunder_containment;

/* "block", "ignore", "separate"; never NULL. */
SUNDER_API const char *sunder_containment_string(sunder_containment containment);

/* Which features count as rows: neighbours that stand side by side along a line, such as the houses of a street. */
typedef enum sunder_rows {
    SUNDER_ROWS_NONE,  /* no rows are looked for */
    SUNDER_ROWS_FOUND, /* rows are found in the layer as it is given; src/displacement/rows/README has the rules */
    SUNDER_ROWS_GIVEN  /* rows are those that sunder_layer_set_rows() has set */
} sunder_rows;

/* What one stage of sunder_layer_separate() did, for developers. Experimental: the words for passes, stages, steps and
 * outcomes may change with any version (docs/trace.md). Strings and arrays are valid during the call only. */
typedef struct sunder_trace_event {
    const char *pass;               /* the part of the whole work; NULL before the first part */
    const char *stage;              /* the stage of the pass; NULL if the pass has only one */
    int round;                      /* the round of the stage, from 1 on; 0 if the stage has no rounds */
    const char *scope;              /* what the event is about: "layer", "cluster", "group" or "pair" */
    const char *step;               /* the step of the stage; NULL for the stage as a whole */
    const char *outcome;            /* never NULL */
    const uint32_t *thing;          /* [things] features, and from the number of features on barriers; ascending */
    size_t things;                  /* 0 for the scope "layer", 2 for "pair" */
    double cost_before, cost_after; /* sums of weight times squared length of the moves; NAN if not measured */
    const char *table;              /* the table that has the stage or step (docs/trace.md); NULL if none has */
} sunder_trace_event;

/* A trace callback. It is called by the thread that called sunder_layer_separate(). The events and their order are the
 * same for every number of threads. */
typedef void (*sunder_trace)(const sunder_trace_event *event, void *user);

typedef struct sunder_layer_options {
    size_t size;            /* sizeof(sunder_layer_options) */
    double gap;             /* >= 0 */
    double touch_tolerance; /* a distance or thin overlap up to this is a touch; negative (the default): gap / 10 */
    bool no_blocks;         /* features do not join blocks by touch or containment */
    bool no_touch;          /* features do not join blocks by touch */
    double thin;            /* if the tolerance is 0: count the overlaps that this tolerance would join; 0: no count */
    bool list_inside;       /* list the pairs inside blocks too */
    sunder_containment contained;
    unsigned threads;         /* 0: one for each processor; the result is the same for every number */
    sunder_progress progress; /* NULL for none */
    void *progress_user;
    bool allow_jumps; /* features may jump over others, or out of a yard: see sunder_layer_separate() */
    double effort;    /* >= 0: a factor of the number of steps, not of the time, that the search for better layouts,
                       * for proofs, and for changes that would solve a conflict may take; 0: no search */
    uint64_t seed;    /* the seed of the random search for better layouts */
    bool keep_trees;  /* keep the trees for sunder_report_bound_trees(), which takes memory */
    bool keep_pushes; /* keep the forces for sunder_report_pushes() */
    bool keep_worlds; /* keep the worlds for sunder_report_worlds() */
    bool drop_proofs; /* sunder_report_proof() returns NULL; only the features of each proof are kept, as blocked_by */
    /* The caller may leave out a barrier if no feature comes too near to it, or crosses it, by a move no longer than
     * barrier_reach. A barrier with sides may be left out only if it is also farther than sunder_side_reach() from the
     * box of every feature. INFINITY (the default): no barrier was left out. barrier_reach must be at least the longest
     * max_shift, and with rows four gaps; need_shift of a conflict is at most barrier_reach. */
    double barrier_reach;
    sunder_trace trace; /* NULL for none */
    void *trace_user;
    sunder_rows rows; /* neighbours in a row keep their order */
    double kink;      /* a kink greater than this counts in summary.kink_share; negative (the default): gap / 10 */
    /* With rows: the stiffness K of springs between neighbours in a row, across it and along it. With u the move of one
     * relative to the other, and w the lesser of their weights, a spring costs w K (u.n)^2. The default: 3 and 0.3. */
    double row_stiffness[2];
    /* 0 (the default), or pairs that remain in conflict are eased: what a pair lacks of its distance, s, costs
     * w (4 R s + ease s^2), and the cost is least with that. w is the lesser weight of the bodies of the pair that may
     * move, R the lesser max_shift above 0 of the two, or the distance that the pair has to keep. No pair is given up,
     * and no other one made worse, for it. */
    double ease;
    /* 0 (the default), or a distance greater than the gap that features are to keep if it pays: any pair may stand
     * between the two, and is then tight. What it lacks of the full gap has the price of `ease`. The tolerance, kinks
     * and rows are measured by the full gap. */
    double full_gap;
} sunder_layer_options;

/* Returns the distance from the box (xmin, ymin, xmax, ymax) of a feature within which barriers can decide on which
 * side of them the feature is: twice the sum of the width and the height of the box. */
SUNDER_EXPERIMENTAL double sunder_side_reach(const double box[4]);

/* Sets the defaults: gap 0, tolerance gap / 10, blocks, one thread, no jumps, effort 1, seed 0. */
SUNDER_API void sunder_layer_options_init_sized(sunder_layer_options *options, size_t size);
static inline void sunder_layer_options_init(sunder_layer_options *options)
{
    sunder_layer_options_init_sized(options, sizeof *options);
}

/* The range of weights. In this range costs, forces and their squares do not leave the range of doubles. */
#define SUNDER_LEAST_WEIGHT 1e-100
#define SUNDER_GREATEST_WEIGHT 1e100

typedef struct sunder_feature {
    const sunder_shape *shape; /* remains the caller's, and must outlive the layer. NULL or empty: no conflicts */
    double weight;             /* from SUNDER_LEAST_WEIGHT to SUNDER_GREATEST_WEIGHT */
    double max_shift;          /* the limit: the greatest length of its move; INFINITY: no limit; 0: it is fixed */
    int64_t block;             /* features with equal non-negative values move as one; -1: none */
    bool fixed;                /* the feature never moves, and the others keep their distance from it */
    bool ignored;              /* the feature never moves, and is in conflict with nothing */
} sunder_feature;

/* Makes a layer of n features, freed by the caller with sunder_layer_free(). The array is copied, the shapes are not.
 *
 * Fails   SUNDER_EARG  a weight is out of its range, a max_shift is negative or not a number, or there are more
 *                      features than can be numbered */
SUNDER_API sunder_status sunder_layer_new(const sunder_feature *features, size_t n, sunder_layer **out,
                                          sunder_error *err);
SUNDER_API void sunder_layer_free(sunder_layer *layer);

/* A barrier: a geometry that never moves. It is drawn with the width, with round ends and joins. Features stay at least
 * width / 2 + gap away from the geometry, exactly. */
typedef struct sunder_barrier {
    sunder_obstacle geometry; /* shape and arrays remain the caller's, and must outlive the layer; it may be empty */
    double width;             /* >= 0 and finite: the full drawn width; a polygon is drawn larger by half the width */
    double gap;               /* finite: the distance from the drawn edge; negative: the gap of the layer's options */
    bool side;                /* features may not cross its lines and boundaries: see sunder_layer_separate() */
    double full_gap; /* >= 0 and finite: options.full_gap for this barrier; 0: with a negative gap that of the options,
                      * else none */
} sunder_barrier;

/* Sets the barriers of a layer, and removes those that it had. A feature and a barrier are one pair, whatever the
 * number of the barrier's lines and pieces near the feature; the cost depends on what is near. (There is one exception
 * to exactness. If members or rings of a feature cross in places that are not doubles, the feature may have walls
 * inside, and a line that lies wholly along such a wall is treated as not meeting the feature's interior.)
 *
 * Fails   SUNDER_EARG      a width or a gap is out of its range, ends of lines do not ascend, or there are more
 *                          barriers than can be numbered
 *         SUNDER_EINVALID  a coordinate is not finite */
SUNDER_API sunder_status sunder_layer_set_barriers(sunder_layer *layer, const sunder_barrier *barriers, size_t n,
                                                   sunder_error *err);

/* Sets the side anchors of features, such as the points at which symbols are drawn: see sunder_layer_separate(). A side
 * anchor that is set is used as it is, even if it is on a line of a barrier or outside the feature.
 * xy      Two coordinates for each feature, which are copied. If they are not finite, the side anchor of that feature
 *         follows from the rule of sunder_layer_separate(). NULL: all side anchors follow from the rule.
 * Fails   SUNDER_ENOMEM */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_side_anchors(sunder_layer *layer, const double *xy,
                                                                sunder_error *err);

/* Gives the layer rows, for options.rows == SUNDER_ROWS_GIVEN: features with equal non-negative values are one row, in
 * the order of a path that joins the nearest ones first. A block counts once.
 * row     A value for each feature, -1 for none; copied. NULL: there are no rows.
 *
 * If features of one block have different rows, functions that use them fail with SUNDER_EINVALID, and err->polygon is
 * the number of one of these features. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_rows(sunder_layer *layer, const int64_t *row, sunder_error *err);

typedef enum sunder_feature_status {
    SUNDER_FEATURE_UNMOVED,
    SUNDER_FEATURE_MOVED,
    SUNDER_FEATURE_FIXED,
    SUNDER_FEATURE_BLOCKED, /* it could move, and still has a conflict */
    SUNDER_FEATURE_SKIPPED, /* it is ignored */
    SUNDER_FEATURE_HIDDEN   /* it is left out: sunder_layer_set_hiding() in sunder_hiding.h */
} sunder_feature_status;

/* "unmoved", "moved", "fixed", "blocked", "skipped". */
SUNDER_API const char *sunder_feature_status_string(sunder_feature_status status);

typedef enum sunder_conflict_kind {
    SUNDER_CONFLICT_OVERLAP,
    SUNDER_CONFLICT_TOO_CLOSE,
    SUNDER_CONFLICT_BARRIER,       /* the interior of a feature meets a barrier's stored geometry */
    SUNDER_CONFLICT_BARRIER_DRAWN, /* it does not meet it, but is nearer to it than half of the barrier's width */
    SUNDER_CONFLICT_BARRIER_NEAR,  /* it is neither, but is nearer than half of the width plus the gap */
    SUNDER_CONFLICT_CONTAINED,
    SUNDER_CONFLICT_DUPLICATE,
    /* Only sunder_layer_check_moves() finds the following kinds. If b is SIZE_MAX, the conflict is about feature a. */
    SUNDER_CONFLICT_WORSE,           /* the pair is in conflict, and worse than before the moves */
    SUNDER_CONFLICT_LIMIT,           /* a moved by `distance`, and at most `required` was allowed */
    SUNDER_CONFLICT_SIDE,            /* the side anchor of a crossed a side of barrier b on its way, `from` - `to` */
    SUNDER_CONFLICT_JUMP,            /* a jumped over b; `from` - `to` is the way of its anchor, relative to b */
    SUNDER_CONFLICT_NOT_A_TRANSLATE, /* no move of a makes its coordinates what they are now */
    SUNDER_CONFLICT_ROW,             /* a and b do not keep their order in their row: b moved, relative to a and along
                                      * the row, by `distance`, and at least `required` was allowed */
    SUNDER_CONFLICT_NEEDLESS,        /* a is hidden, but would be in no conflict where it stood or where its block is */
    SUNDER_CONFLICT_ALTERED,         /* a is neither a translate of what it was nor of one of its smaller shapes */
    /* The pair is no conflict: it keeps the gap, but not the full gap. It has no reason, and blocks no feature. */
    SUNDER_CONFLICT_TIGHT
} sunder_conflict_kind;

/* "overlap", "too_close", "barrier", "barrier_drawn", "barrier_near", "contained", "duplicate", "worse", "limit",
 * "side", "jump", "not_a_translate", "row", "tight". */
SUNDER_API const char *sunder_conflict_kind_string(sunder_conflict_kind kind);

typedef enum sunder_reason {
    SUNDER_REASON_NONE,       /* the report is of a check, which tries no solution */
    SUNDER_REASON_MAX_SHIFT,  /* proved: no moves within the limits of the two solve the pair, even by itself */
    SUNDER_REASON_FIXED,      /* neither of the two may move */
    SUNDER_REASON_SIDE,       /* proved: every solution of the pair and its two blocks alone crosses a side */
    SUNDER_REASON_JUMP,       /* proved: every solution of the pair and its two blocks alone crosses a side or jumps */
    SUNDER_REASON_NO_ROOM,    /* proved: no moves solve the pair and all pairs that are not listed, and leave all other
                               * listed pairs no worse than at the start */
    SUNDER_REASON_SAME_BLOCK, /* the two are in one block, and move as one */
    SUNDER_REASON_KEPT,       /* the two may overlap, since one lies in the other: SUNDER_CONTAINMENT_IGNORE */
    SUNDER_REASON_UNRESOLVED, /* neither a solution nor one of these proofs was found; see also `crowded` */
    SUNDER_REASON_ROW         /* proved: every solution of the pair and its two blocks alone crosses a side, jumps, or
                               * breaks the rule of rows for the two */
} sunder_reason;

/* "", "max_shift", "fixed", "side", "jump", "no_room", "same_block", "kept", "unresolved", "row". */
SUNDER_API const char *sunder_reason_string(sunder_reason reason);

/* A pair in conflict: in the result of a run, or in the layer as it stands in a check. */
typedef struct sunder_conflict {
    size_t a, b; /* a < b: a is a feature; b is a feature, or the number of features + k for barrier k */
    sunder_conflict_kind kind;
    sunder_reason reason;
    double distance; /* the distance in the result; 0 if the two overlap */
    double before;   /* the distance at the start */
    double depth;    /* the length of the least translation that makes the interiors disjoint in the result; 0 if they
                      * are disjoint */
    double required; /* the gap, or the full gap; for a barrier this plus half of its width */
    /* The length that is missing: required - distance, or required + depth if the interiors meet. NAN if the pair has
     * to keep no distance: inside a block, if the two may overlap, and for kinds that are not about a distance. */
    double missing;
    double from[2], to[2];    /* the shortest link, or the least translation drawn from inside the overlap */
    const size_t *blocked_by; /* [n_blocked_by] features and barriers, as b, that are in the way; owned by the report */
    size_t n_blocked_by;
    bool inside_block; /* both are in one block; the conflict is counted in inside_blocks only */
    /* Changes that would solve the pair, one at a time, with its neighbours keeping their distances and all other
     * features as in the result: a longer limit of moves (NAN if none is known), a smaller gap (NAN likewise), or the
     * removal of one feature or barrier (SIZE_MAX if none is known). A smaller change may suffice. The search takes a
     * few steps for each conflict; with effort 0 there is none. In a cluster in which no limit was found for single
     * pairs, need_shift is the longest move of a layout that solves the whole cluster, if one is known. */
    double need_shift, need_gap;
    size_t need_gone;
    /* A proved upper bound of the gaps with which the pair and its neighbours have a solution: the requested gap if
     * nothing less is proved, and NAN if need_gap is NAN. For most conflicts it exceeds need_gap by at most a hundredth
     * of the requested gap. */
    double need_gap_most;
    /* True only with SUNDER_REASON_UNRESOLVED. It is then proved that a, b and the features and barriers in blocked_by
     * cannot all keep their distances from one another, even if every other pair is left in conflict. So at least one
     * pair among them stays in conflict, though not necessarily this one. */
    bool crowded;
    bool by_row; /* true only with SUNDER_REASON_NO_ROOM: the proof uses the rule of rows, and none was found without */
} sunder_conflict;

/* The number of conflicts of each kind between blocks, and the number of all conflicts inside blocks. */
typedef struct sunder_conflict_counts {
    size_t overlap, too_close, barrier, barrier_drawn, barrier_near, contained, duplicate, inside_blocks;
} sunder_conflict_counts;

typedef struct sunder_report sunder_report;

typedef struct sunder_layer_summary {
    size_t features, vertices, blocks, clusters, pairs_tested;
    size_t clusters_optimal;              /* contact groups whose cost is proved to be least */
    sunder_conflict_counts before, after; /* at the start and in the result; equal in a check */
    size_t thin;                    /* pairs between blocks that overlapped by at most options.thin at the start */
    size_t inside_overlaps;         /* pairs inside blocks that are listed as overlaps in the result */
    size_t moved, blocked, skipped; /* the numbers of features with these statuses */
    size_t blocked_moved;           /* blocked features that moved, because of other conflicts */
    size_t rounded;                 /* moved features with a coordinate that had to be rounded to a double */
    double total, mean, max;        /* lengths of moves; the mean is over all features that moved, blocked or not */
    size_t max_feature;             /* the first feature with the longest move; SIZE_MAX if nothing moved */
    /* cost is the sum of weight * length^2 over the moves, and of the springs of rows. lower_bound is proved: no
     * placement costs less that solves every pair that is not listed, leaves no listed pair worse than at the start,
     * and leaves no pair in overlap that is listed as too close. */
    double cost, lower_bound;
    /* The bound that the pairs of sunder_report_bound_pairs() prove by their least translations alone. It holds if no
     * feature of these pairs comes to lie in the other. It is not part of lower_bound, which trees prove: they prove a
     * little less for a pair, and nothing for two features of which one may come to lie in the other. */
    double pair_bound;
    /* True if every pair that is neither listed nor inside a block was proved to keep its distance (or to lie inside,
     * if it may overlap then), and no listed pair is worse than at the start. */
    bool verified;
    /* Seconds until the last move; seconds for the statements about the result (the list of conflicts, reasons and
     * needs, bounds and pushes); and seconds for the exact checks of all pairs after the last move. A check has only
     * seconds_verify. */
    double seconds_solve, seconds_explain, seconds_verify;
    /* Rows, blocks and single features in them, and the pairs of neighbours in them. The kink of a pair is the length
     * of its relative move at right angles to the row: its mean, the value that 95 % do not exceed, and the share of
     * pairs with a kink above options.kink. */
    size_t rows, row_features, row_pairs;
    double kink_mean, kink_p95, kink_share;
    double cost_moves, cost_rows; /* the parts of cost: moves, and springs of rows ... */
    double cost_shortfall; /* ... and the prices of pairs that remain in conflict */
    double cost_alone;     /* the part of these that each pair has to pay wherever the others go; part of lower_bound */
    /* With options.ease: the pairs of bodies, or of a body and a barrier, that remain in conflict though one of the two
     * may move; and the sum of what they lack, the most of the conflicts of each. */
    size_t short_pairs;
    double shortfall;
    /* Neighbours in rows: the length of their relative move along the row, the change of their spacing; and the angle,
     * in degrees, by which the line from one to the other turns. Of each the mean, and the value that 95 % of the pairs
     * do not exceed. */
    double spacing_mean, spacing_p95, turn_mean, turn_p95;
    size_t tight; /* the pairs that are tight in the result: see options.full_gap. They are in no other count. With
                   * options.ease short_pairs and shortfall include them. */
} sunder_layer_summary;

/* Lists the conflicts of a layer as it stands, exactly. The caller frees the report with sunder_report_free().
 *
 * Fails   SUNDER_EARG for an option out of its range, such as a gap that is negative or not finite, or a tolerance that
 *         is not less than a gap above 0; SUNDER_ENOMEM, SUNDER_ECANCEL */
SUNDER_API sunder_status sunder_layer_check(const sunder_layer *layer, const sunder_layer_options *options,
                                            sunder_report **out, sunder_error *err);

/* Lists the rules that the moves from `before` to `after` broke, whatever program made them. The two layers have the
 * same features in the same order. Each broken rule is a conflict of the report, of one of the kinds from
 * SUNDER_CONFLICT_WORSE to SUNDER_CONFLICT_ALTERED; summary.verified is true if there is none. Limits, blocks, and
 * fixed and ignored features are those of `before`. What is ignored in `after` alone is hidden: it owes nothing, and
 * nothing is owed to it. The options should be those of the run that made the moves. Two things are not checked:
 * whether the features of a block moved together, and the move of a repaired shape that was written in its repaired
 * form, which is not known.
 *
 * Fails   as sunder_layer_check(), and with SUNDER_EARG for layers of different sizes */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_check_moves(const sunder_layer *before, const sunder_layer *after,
                                                           const sunder_layer_options *options, sunder_report **out,
                                                           sunder_error *err);

/* The stages of sunder_layer_separate(), by the fraction that its progress callback receives: it solves until
 * SUNDER_PROGRESS_SOLVED, explains the result until SUNDER_PROGRESS_EXPLAINED, and verifies from then on. */
#define SUNDER_PROGRESS_SOLVED 0.8
#define SUNDER_PROGRESS_EXPLAINED 0.98

/* Separates the features of a layer at low cost; src/displacement/README describes the method. The caller frees the
 * report with sunder_report_free(). It fails like sunder_layer_check().
 *
 * Every move is such that the moved vertices of its feature are doubles exactly, if there is such a move. Otherwise
 * summary.rounded counts the feature, and the rounded vertices are verified. Pairs that remain in conflict are listed,
 * and are no worse than at the start: they are no nearer, and the least translation that separates them is no longer.
 * No other feature moves only to make a remaining conflict smaller.
 *
 * Unless allow_jumps is set, no feature jumps over another. Let A be a feature with the anchor a
 * (sunder_shape_anchor()) and the move t. Let B be another feature with the move s that is not ignored, is not in the
 * block of A, and does not contain a. Then the closed segment from a to a + t - s, not rounded, does not meet B at its
 * original place. So a feature in a yard that has no room for it keeps its conflict, whatever its limit.
 *
 * No feature crosses a barrier that has sides. Let c be the side anchor of the feature, and t its move. Then the closed
 * segment from c to c + t meets no line of the barrier, except lines on which c lies, and no edge of its areas that has
 * c strictly on the outer side. So a feature inside an area may leave it, but not enter it again.
 *
 * The side anchor of a feature is the one that sunder_layer_set_side_anchors() has set, for example the point at which
 * a symbol is drawn. Otherwise it is the anchor, if no such line or edge meets the interior of the feature. Otherwise
 * it is an interior point of the largest part into which these lines and edges divide the feature; if several parts are
 * equal within the tolerance, of the one with the most room. src/displacement/layer/side_anchor.c has the rule. */
SUNDER_API sunder_status sunder_layer_separate(const sunder_layer *layer, const sunder_layer_options *options,
                                               sunder_report **out, sunder_error *err);
SUNDER_API void sunder_report_free(sunder_report *report);

/* Copies the summary to `summary`. A later version may add members at its end: members that do not fit in the caller's
 * `size` bytes are left out, and bytes beyond the members that the library knows are set to 0. */
SUNDER_API void sunder_report_summary_sized(const sunder_report *report, sunder_layer_summary *summary, size_t size);
static inline void sunder_report_summary(const sunder_report *report, sunder_layer_summary *summary)
{
    sunder_report_summary_sized(report, summary, sizeof *summary);
}
/* Sets *dx and *dy to the move of a feature. A moved coordinate is the double nearest to x + dx, or y + dy. */
SUNDER_API void sunder_report_move(const sunder_report *report, size_t feature, double *dx, double *dy);
/* Returns the status of a feature. */
SUNDER_API sunder_feature_status sunder_report_status(const sunder_report *report, size_t feature);
/* Returns the number of the block of a feature, which is the number of its first member; -1 if it is in none. */
SUNDER_API int64_t sunder_report_block(const sunder_report *report, size_t feature);
/* Returns the conflicts that remain, sorted by (a, b), and sets *n to their number. They are the conflicts between
 * blocks, the overlaps inside blocks that exceed the tolerance and, with list_inside, all conflicts inside blocks. */
SUNDER_API const sunder_conflict *sunder_report_conflicts(const sunder_report *report, size_t *n);
/* A force between two features that are in contact in the result: a multiplier of the quadratic program whose optimum
 * the result is. The sum of force * n over the pushes on a block, with a minus where the block is that of a, is twice
 * its weight times its move, if the result is an optimum and the move is shorter than the limit. Forces are computed in
 * doubles, for display. */
typedef struct sunder_push {
    size_t a, b; /* a is a feature; b is a feature, or the number of features + k for barrier k */
    double force;
    double n[2]; /* the direction, of length 1, in which b is pushed; a is pushed in the opposite direction */
} sunder_push;

/* Returns the pushes, sorted by (a, b), and sets *n to their number; there are none unless keep_pushes was set. */
SUNDER_EXPERIMENTAL const sunder_push *sunder_report_pushes(const sunder_report *report, size_t *n);

/* A row of neighbours. */
typedef struct sunder_row {
    /* The features of the row in order, from the end with the smaller number on; a row in the form of a ring begins at
     * its smallest number. A block appears with the member nearest to the block before it and the one nearest to the
     * block after it, once if these are the same. Owned by the report. */
    const size_t *feature; /* [features] */
    size_t features;
    size_t bodies; /* the number of blocks and single features */
    bool ring;     /* the last one is a neighbour of the first one */
    /* The greatest offset of two neighbours, at the start and in the result. An offset is that of their fronts, backs
     * or middle lines, whichever is the least at the start. */
    double kink_before, kink_after;
} sunder_row;

/* Returns the rows, in the order of their features, and sets *n to their number; there are none unless options.rows was
 * set. */
SUNDER_EXPERIMENTAL const sunder_row *sunder_report_rows(const sunder_report *report, size_t *n);

/* ---- Routes ----------------------------------------------------------------------------------------------- */

/* An exact place. Coordinate k is the rational text[k], "num" or "num/den" in decimal, or xy[k] if text[k] is NULL. */
typedef struct sunder_place {
    double xy[2];
    const char *text[2];
} sunder_place;

/* Options of routes. The defaults are all zero, except for the size. */
typedef struct sunder_route_options {
    size_t size; /* sizeof(sunder_route_options) */
    double gap;  /* >= 0 and finite; the robot is grown by a polygon of 64 sides around the disc of radius gap */
    sunder_progress progress; /* NULL: none */
    void *progress_user;
} sunder_route_options;

SUNDER_API void sunder_route_options_init_sized(sunder_route_options *options, size_t size);
static inline void sunder_route_options_init(sunder_route_options *options)
{
    sunder_route_options_init_sized(options, sizeof *options);
}

typedef enum sunder_route_status {
    SUNDER_ROUTE_FOUND,
    SUNDER_ROUTE_START_COLLIDES, /* at the start the robot's interior meets an obstacle */
    SUNDER_ROUTE_GOAL_COLLIDES,
    SUNDER_ROUTE_DISCONNECTED /* start and goal lie in different components of free space */
} sunder_route_status;

/* "found", "start_in_collision", "goal_in_collision", "disconnected". */
SUNDER_API const char *sunder_route_status_string(sunder_route_status reason);

typedef struct sunder_route sunder_route;

/* Finds a shortest path along which the robot can be translated among the obstacles.
 *
 * Free space is the complement of the union of the open sets O_i + int(-robot), so it is closed. Contact is allowed:
 * the robot may go through a passage, or be at a place, that it fits exactly. The path is that of the robot's origin.
 * Of several shortest paths it is the lexicographically smallest sequence of vertices; lengths that differ by at most
 * 2^-256 of themselves count as equal. A separate test proves of each leg that the interior of the robot meets no
 * obstacle.
 *
 * obstacles  n obstacles, which have to be valid during the call only.
 * robot      It must not be empty. Members may touch and overlap, and holes are allowed. (There is one exception to
 *            exactness, for obstacles without area only: if members cross in places that are not doubles, a wall that
 *            two members share does not count as interior.)
 * from, to   The places of the robot's origin at the start and at the goal.
 * out        A new route, freed by the caller with sunder_route_free(). There is one on success even if no path exists:
 *            see sunder_route_reason().
 * Fails      SUNDER_EARG for an argument out of its range, SUNDER_ENOMEM, SUNDER_ECANCEL; SUNDER_EINVALID for an
 *            obstacle with a coordinate that is not finite, SUNDER_ERANGE for a place too far away to be compared.
 * Source     [LW79] for the graph, [HNR68] for the search; see src/motion/README.
 * Cost       That of a sum for the outline of the union; then that of A* over its corners, which examines only edges
 *            that may belong to a shortest path. */
SUNDER_API sunder_status sunder_route_find(const sunder_obstacle *obstacles, size_t n, const sunder_shape *robot,
                                           const sunder_place *from, const sunder_place *to,
                                           const sunder_route_options *options, sunder_route **out, sunder_error *err);
SUNDER_API void sunder_route_free(sunder_route *route);

/* Returns whether a path was found, or why there is none. If obstacle is not NULL, *obstacle is set to the first
 * obstacle that the robot meets at the start or goal, or to SIZE_MAX if there is none. */
SUNDER_API sunder_route_status sunder_route_reason(const sunder_route *route, size_t *obstacle);
/* Returns the number of vertices of the path, including start and goal; 1 if these are the same, 0 without a path. */
SUNDER_API size_t sunder_route_vertices(const sunder_route *route);
/* Set the coordinates of a vertex of the path: the nearest doubles, and exact texts "num" or "num/den", which the route
 * owns. */
SUNDER_API void sunder_route_vertex(const sunder_route *route, size_t vertex, double xy[2]);
SUNDER_API void sunder_route_vertex_text(const sunder_route *route, size_t vertex, const char **x, const char **y);
/* Returns the length of the path, rounded to the nearest double; 0 if there is no path. */
SUNDER_API double sunder_route_length(const sunder_route *route);
/* Returns whether the path is also free if its vertices are rounded to the nearest doubles; proved like the path. */
SUNDER_API bool sunder_route_rounded_is_free(const sunder_route *route);
/* Returns the union of the obstacles of configuration space, as a sum with its degenerate holes. The route owns it. */
SUNDER_API const sunder_sum *sunder_route_obstacles(const sunder_route *route);

/* ---- Predicates on doubles -------------------------------------------------------------------------------- */

typedef struct sunder_point {
    double x, y;
} sunder_point;

/* Returns the side of the directed line from a to b on which c lies: +1 left, -1 right, 0 on the line. The result is
 * exact. The coordinates must be finite. Nothing is allocated, so the function cannot fail. */
SUNDER_API int sunder_orient(const sunder_point *a, const sunder_point *b, const sunder_point *c);

#ifdef __cplusplus
}
#endif
#endif
