/* sunder_sum.h: exact Minkowski sums of polygonal sets, dilation, erosion, opening and closing, and the planar map
 * beneath a sum. Part of sunder.h, which states the conventions. */
#ifndef SUNDER_SUM_H
#define SUNDER_SUM_H

#include "sunder_shape.h"

#ifdef __cplusplus
extern "C" {
#endif

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

/* ---- Many no-fit polygons ----------------------------------------------------------------------------------- */

/* A rotation about the origin: (x, y) becomes ((cosine * x - sine * y) / scale, (sine * x + cosine * y) / scale).
 *
 * It is rational if the three are integers with cosine^2 + sine^2 = scale^2, such as 3, 4, 5 or 0, 1, 1; then the
 * rotated copy of a part is exact, unless the products are too long for doubles. All other values are taken as they
 * are: coordinates of the copy are computed in doubles, and this copy is what is fitted, exactly. */
typedef struct sunder_rotation {
    double cosine, sine; /* finite */
    double scale;        /* finite and above 0 */
} sunder_rotation;

/* The question for one no-fit polygon: parts and rotations by their numbers. */
typedef struct sunder_nofit {
    uint32_t fixed, moving;
    uint32_t fixed_rotation, moving_rotation;
} sunder_nofit;

typedef struct sunder_nofits sunder_nofits;

/* Computes the no-fit polygons P + (-Q) of many pairs of rotated parts, exactly, with their degenerate holes: the
 * translations of the moving part with which its interior meets that of the fixed one. Pairs with the same parts and
 * rotations share a result, also if two parts have the same rings, and two rotations the same numbers.
 *
 * part      [parts] they have to be valid during the call only
 * rotation  [rotations]
 * pair      [pairs]
 * options   threads is the number of threads (0 or 1: the calling one), and progress is used; NULL: the defaults
 * out       freed by the caller with sunder_nofits_free()
 * Fails     SUNDER_EARG for a number or a rotation out of its range; as sunder_minkowski_sum() */
SUNDER_EXPERIMENTAL sunder_status sunder_nofit_batch(const sunder_shape *const *part, size_t parts,
                                                     const sunder_rotation *rotation, size_t rotations,
                                                     const sunder_nofit *pair, size_t pairs,
                                                     const sunder_sum_options *options, sunder_nofits **out,
                                                     sunder_error *err);
SUNDER_EXPERIMENTAL void sunder_nofits_free(sunder_nofits *nofits);
/* Returns the number of different results. */
SUNDER_EXPERIMENTAL size_t sunder_nofits_distinct(const sunder_nofits *nofits);
/* Returns the number of the result of a pair, less than sunder_nofits_distinct(). */
SUNDER_EXPERIMENTAL size_t sunder_nofits_result(const sunder_nofits *nofits, size_t pair);
/* Returns a result. Its coordinates are those of the no-fit polygon times *scale, a whole number: 1 without rational
 * rotations. *exact is set to whether no coordinate of the rotated parts was rounded. */
SUNDER_EXPERIMENTAL const sunder_sum *sunder_nofits_sum(const sunder_nofits *nofits, size_t result, double *scale,
                                                        bool *exact);

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

#ifdef __cplusplus
}
#endif
#endif
