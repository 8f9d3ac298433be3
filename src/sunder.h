/* sunder.h: exact Minkowski sums of polygonal sets, least separating translations, and the displacement of
 * whole map layers.
 *
 * Conventions. Every fallible function returns a sunder_status (SUNDER_OK is 0) and takes a caller-owned
 * sunder_error, which may be NULL. On failure every output is untouched. What arrives through **out is freed by
 * the caller with the _free function of its type; _free(NULL) is fine. Getters lend: what they return is valid
 * until the object is freed. Objects are immutable once built, so threads may share them; there is no global
 * state but the allocation hooks, which are set once, before anything else, and each thread's own watch.
 *
 * Lengths are in the units of the input. Every finite double is taken as the dyadic rational that it is; nothing
 * is rounded on the way in, and on the way out only where a function says so.
 *
 * Functions that are declared SUNDER_API are stable: a program that is compiled with this header runs with every later
 * library of the same soname. Those that are declared SUNDER_EXPERIMENTAL may change in any version. docs/api.md says
 * what that promises, and how structs of options grow.
 *
 * Proofs have a header of their own, sunder_proof.h, and so have parts of a layer, sunder_parts.h.
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
    SUNDER_EINVALID, /* geometry that breaks a rule: the error names polygon, ring and vertex */
    SUNDER_EARG,     /* an option or argument out of its range */
    SUNDER_ERANGE,   /* a result that doubles cannot hold */
    SUNDER_ENOMEM,   /* an allocation failed; everything made so far has been released */
    SUNDER_ECANCEL,  /* a progress callback, or the watch of the thread, asked to stop */
    SUNDER_ESIZE,    /* more parts than can be numbered: vertices, pairs of convex pieces, corners of a sum */
    SUNDER_EFAULT    /* a result failed the library's own exact check, and is withheld: a defect to be reported */
} sunder_status;

#define SUNDER_MESSAGE_MAX 256

typedef struct sunder_error {
    sunder_status status;
    size_t polygon, ring, vertex; /* where, zero-based; SIZE_MAX where it does not apply */
    char message[SUNDER_MESSAGE_MAX];
} sunder_error;

/* A fixed sentence for each code; never NULL. */
SUNDER_API const char *sunder_status_string(sunder_status status);

/* The library's version, as SUNDER_VERSION of the build. */
SUNDER_API const char *sunder_version(void);

/* The version of the GMP that the library runs with, which need not be the one that it was built with. */
SUNDER_API const char *sunder_gmp_version(void);

/* The allocation hooks; all memory goes through them. NULLs restore malloc, realloc and free. Call before any other
 * function and never while an object lives. */
SUNDER_API void sunder_set_allocator(void *(*allocate)(size_t), void *(*reallocate)(void *, size_t),
                                     void (*release)(void *));

/* Frees memory that the library handed out as plain text or arrays. */
SUNDER_API void sunder_free(void *memory);

/* What was done, in the units that the literature counts [AFH00, section 3]. */
typedef struct sunder_counts {
    uint64_t comparisons;           /* order of two points, or of two crossings along a line */
    uint64_t orientation_tests;     /* side of a point to a line */
    uint64_t segment_intersections; /* crossing points constructed */
    uint64_t exact_fallbacks;       /* questions that the floating-point filter left open */
} sunder_counts;

/* Called now and then with a fraction done in [0, 1], often the same one again; return false to stop with
 * SUNDER_ECANCEL. Calls do not overlap, but where work is shared by threads they may come from any of them. Between two
 * of them, and from the answer to the return, there is never more than some milliseconds' work (tests count it). */
typedef bool (*sunder_progress)(double fraction, void *user);

/* Watches the calling thread, for functions without a progress argument: every function of this library that the thread
 * calls polls go_on(user) as often as a progress function, and fails with SUNDER_ECANCEL once it returned false. So
 * does every later call, at once, until another watch is set, or none (NULL). Polls do not overlap, but may come from
 * threads that the library started on behalf of this one. */
SUNDER_API void sunder_watch(bool (*go_on)(void *user), void *user);

/* ---- Options ------------------------------------------------------------------------------------------------ */

/* A struct of options begins with its size, so that a later version can add members at its end. The library reads as
 * many bytes as `size` says. Members beyond them have their defaults; bytes that a newer caller has beyond the
 * library's own struct must be 0.
 *
 * The _init function of a struct sets `size` and the defaults. It is inline, so that it knows the caller's struct; the
 * _init_sized function below it is the library's, for other languages. Every function that takes options takes NULL for
 * the defaults.
 *
 * Fails  SUNDER_EARG  `size` is 0, no multiple of sizeof(size_t), or above SUNDER_OPTIONS_MAX; or a byte beyond the
 *                     library's own struct is not 0. */
#define SUNDER_OPTIONS_MAX 4096

/* ---- Shapes: polygonal sets ------------------------------------------------------------------------------- */

typedef struct sunder_shape sunder_shape;

typedef enum sunder_validity {
    SUNDER_VALIDITY_STRICT,  /* invalid rings are an error */
    SUNDER_VALIDITY_EVEN_ODD /* the set that each polygon's rings enclose by the even-odd rule, taken exactly */
} sunder_validity;

/* "strict", "even-odd"; never NULL, "" for a number that is none of the values (so for all enumerations below). */
SUNDER_API const char *sunder_validity_string(sunder_validity validity);

/* A polygonal set from plain arrays.
 *
 * xy         2 * n coordinates x0 y0 x1 y1 ... of all rings, one after the other. Finite; else SUNDER_EINVALID.
 * ring_end   ring_end[r] is the index past the last vertex (not coordinate) of ring r; rings in all: poly_end of
 *            the last polygon.
 * poly_end   poly_end[p] is the index past the last ring of polygon p. The first ring of a polygon is its outer one.
 * polygons   how many; 0 gives the empty set.
 * validity   SUNDER_VALIDITY_STRICT: rings may be closed or not, of either orientation, with repeated and collinear
 *            vertices; they may touch at points, never cross or share a piece of edge. Members may touch and overlap:
 *            their union is meant. A polygon whose interior falls apart where its rings touch counts as several.
 *            SUNDER_VALIDITY_EVEN_ODD: an invalid polygon is replaced by the closure of the set that its rings enclose
 *            by the even-odd rule, with exact rational vertices; sunder_shape_repaired() tells. A polygon that encloses
 *            nothing vanishes.
 * Fails      SUNDER_EARG      ends that do not ascend, or no such validity
 *            SUNDER_EINVALID  a coordinate is not finite; or (strict) a ring has under three distinct vertices, has no
 *            area, crosses itself or another ring, a hole lies outside its outer ring, a hole inside a hole.
 *            SUNDER_ESIZE     more than 2^27 vertices
 * Cost       O(n log n) where edges are short beside the whole, as on maps. */
SUNDER_API sunder_status sunder_shape_from_rings(const double *xy, const size_t *ring_end, const size_t *poly_end,
                                                 size_t polygons, sunder_validity validity, sunder_shape **out,
                                                 sunder_error *err);

/* A regular-like polygon with rational vertices around (inside = false: contains the closed disc) or within
 * (inside = true) the disc of that radius about the origin. segments >= 3, radius > 0 and finite; else SUNDER_EARG.
 * SUNDER_ERANGE if a vertex leaves the range of doubles. Those of an inside one on the axes are at the radius. */
SUNDER_API sunder_status sunder_shape_disc(double radius, unsigned segments, bool inside, sunder_shape **out,
                                           sunder_error *err);

/* The axis-parallel rectangle centred on the origin; both sides > 0 and finite, else SUNDER_EARG. */
SUNDER_API sunder_status sunder_shape_rectangle(double width, double height, sunder_shape **out, sunder_error *err);

/* The set -S. */
SUNDER_API sunder_status sunder_shape_reflect(const sunder_shape *shape, sunder_shape **out, sunder_error *err);

/* S + (dx, dy), exactly as doubles hold it: each coordinate is the nearest double to x + dx; *exact tells whether none
 * was rounded. If rounding breaks the shape it is taken by the even-odd rule. SUNDER_EARG for a move that is not
 * finite, SUNDER_ERANGE where a coordinate leaves the range of doubles. */
SUNDER_API sunder_status sunder_shape_translate(const sunder_shape *shape, double dx, double dy, sunder_shape **out,
                                                bool *exact, sunder_error *err);

SUNDER_API void sunder_shape_free(sunder_shape *shape);

SUNDER_API size_t sunder_shape_polygons(const sunder_shape *shape);
SUNDER_API size_t sunder_shape_vertices(const sunder_shape *shape); /* after cleaning: no repeated, no collinear ones */
SUNDER_API bool sunder_shape_is_empty(const sunder_shape *shape);
SUNDER_API bool sunder_shape_repaired(const sunder_shape *shape);
/* Did rings of one polygon meet somewhere, or a ring meet itself, as they were given? If not, the polygons of a strict
 * shape are valid in the sense of OGC simple features, which allows less than SUNDER_VALIDITY_STRICT does. A repaired
 * shape counts as one whose rings met. */
SUNDER_API bool sunder_shape_touches(const sunder_shape *shape);
/* Rings of one polygon of the cleaned form: 1 + its holes; ring 0 is the outer one. Each ring begins at its smallest
 * corner by x, then y, and holes and polygons ascend by their corners, however they were given; a reflected shape keeps
 * the order of the one that it was made of. */
SUNDER_API size_t sunder_shape_rings(const sunder_shape *shape, size_t polygon);
/* The corners x0 y0 x1 y1 ... of one ring, *n of them, outer rings counter-clockwise; of a repaired shape the nearest
 * doubles to them. */
SUNDER_API const double *sunder_shape_ring(const sunder_shape *shape, size_t polygon, size_t ring, size_t *n);
/* The rings as they were given, before cleaning, laid out as for sunder_shape_from_rings(), which makes the same shape
 * of them again (of a repaired one by the even-odd rule); how many polygons. Of a shape moved or reflected they are
 * moved or reflected. */
SUNDER_API size_t sunder_shape_given(const sunder_shape *shape, const double **xy, const size_t **ring_end,
                                     const size_t **poly_end);
/* xmin, ymin, xmax, ymax; of a repaired shape rounded outward. The empty set: all zero. */
SUNDER_API void sunder_shape_box(const sunder_shape *shape, double box[4]);
/* Area, the sum over members (overlaps count twice), to the nearest double. Neither this nor the anchor can fail: what
 * they need is on the stack, or was worked out when the shape was made. */
SUNDER_API double sunder_shape_area(const sunder_shape *shape);
/* An interior point by a fixed exact rule, as the nearest doubles to it; (0, 0) for the empty set. It depends on the
 * point set alone, not on how its rings are written. The rule: take the intervals of the interior of the union of all
 * members on the horizontal line at half its height; the point is the middle of the widest interval, the leftmost of
 * equal ones. If there are none on that line, the rule applies to the part of the interior below it. */
SUNDER_API void sunder_shape_anchor(const sunder_shape *shape, double xy[2]);

/* ---- Minkowski sums --------------------------------------------------------------------------------------- */

typedef struct sunder_sum sunder_sum;

/* Roads to the sum. All lead to the same result, whatever the decomposition, the order and the seed. */
typedef enum sunder_algorithm {
    SUNDER_ALGORITHM_AUTO,        /* the convolution; with keep_map the arrangement */
    SUNDER_ALGORITHM_CONVOLUTION, /* only sides that can bound the sum, settled line by line: by far the fastest */
    SUNDER_ALGORITHM_ARRANGEMENT, /* all subsums of convex pieces in one arrangement, its cells then marked [AFH00] */
    SUNDER_ALGORITHM_INCREMENTAL, /* one subsum after the other united with the union so far [AFH00] */
    SUNDER_ALGORITHM_DIVIDE       /* incremental for P + Q_j of each piece Q_j, then pairs of these unions [AFH00] */
} sunder_algorithm;

/* How the operands are cut into convex pieces; for all roads but the convolution. See src/decomposition/README. */
typedef enum sunder_decomposition {
    SUNDER_DECOMPOSITION_AUTO,           /* the angle bisector: fewest crossings on most families [AFH02] */
    SUNDER_DECOMPOSITION_ANGLE_BISECTOR, /* a cut from each reflex vertex, pairs of reflex vertices first */
    SUNDER_DECOMPOSITION_VERTICAL,       /* vertical cuts from the reflex vertices */
    SUNDER_DECOMPOSITION_TRIANGULATION,
    SUNDER_DECOMPOSITION_HERTEL_MEHLHORN, /* a triangulation without its needless diagonals */
    SUNDER_DECOMPOSITION_OPTIMAL,         /* fewest pieces without new vertices; members with holes, or over 500
                                     vertices, fall back to Hertel and Mehlhorn's */
    SUNDER_DECOMPOSITION_MIXED            /* both operands: least total length of the subsums' boundaries; same
                                * fallback */
} sunder_decomposition;

/* In what order subsums go in; for all roads but the convolution. */
typedef enum sunder_order {
    SUNDER_ORDER_RANDOM,
    SUNDER_ORDER_FAT,  /* descending fatness, see src/unions/README */
    SUNDER_ORDER_GIVEN /* in the order of the pieces */
} sunder_order;

/* "auto", "convolution", "arrangement", "incremental", "divide". */
SUNDER_API const char *sunder_algorithm_string(sunder_algorithm algorithm);
/* "auto", "angle-bisector", "vertical", "triangulation", "hertel-mehlhorn", "optimal", "mixed". */
SUNDER_API const char *sunder_decomposition_string(sunder_decomposition decomposition);
/* "random", "fat", "given". */
SUNDER_API const char *sunder_order_string(sunder_order order);

/* All zero but the size: the defaults. */
typedef struct sunder_sum_options {
    size_t size;              /* sizeof(sunder_sum_options) */
    sunder_progress progress; /* NULL: none */
    void *progress_user;
    sunder_algorithm algorithm;
    sunder_decomposition decomposition;
    sunder_order order;
    uint64_t seed;    /* seed of random orders */
    bool keep_map;    /* for sunder_sum_map(); SUNDER_EARG with the convolution, which makes none */
    unsigned threads; /* of sunder_morphology(), besides its dilations; 0 or 1: the caller's alone. Results are equal */
} sunder_sum_options;

SUNDER_API void sunder_sum_options_init_sized(sunder_sum_options *options, size_t size);
static inline void sunder_sum_options_init(sunder_sum_options *options)
{
    sunder_sum_options_init_sized(options, sizeof *options);
}

typedef struct sunder_sum_size {
    size_t polygons, holes, vertices, degenerate_segments, degenerate_points;
} sunder_sum_size;

/* Minkowski sum P + Q = { p + q : p in P, q in Q }, exact, of two polygonal sets.
 *
 * p, q     not modified; p == q is fine. An operand without area gives the empty sum.
 * options  NULL for defaults.
 * out      a new sum, in canonical form: equal point sets compare equal. One polygon for each connected component C of
 *          the interior of P + Q, one ring for each component of the plane minus the closure of C; collinear vertices
 *          merged; a ring starts at its lexicographically smallest vertex, which is not repeated; outer rings
 *          counter-clockwise, holes clockwise; holes and polygons sorted as vertex sequences.
 *
 * Degenerate holes (points of the interior of P + Q that are not in int P + int Q) are part of the result: as maximal
 * segments, and as points that lie on no segment.
 *
 * Fails   SUNDER_ENOMEM, SUNDER_ECANCEL; SUNDER_EARG for an option that is none of its values
 * Source  [GRS83] convolution; [BL11] reduced convolution; [AFH00] the unions of subsums; see src/minkowski/README and
 *         src/unions/README for the roads taken. */
SUNDER_API sunder_status sunder_minkowski_sum(const sunder_shape *p, const sunder_shape *q,
                                              const sunder_sum_options *options, sunder_sum **out, sunder_error *err);
SUNDER_API void sunder_sum_free(sunder_sum *sum);

SUNDER_API void sunder_sum_get_size(const sunder_sum *sum, sunder_sum_size *size);
SUNDER_EXPERIMENTAL void sunder_sum_get_counts(const sunder_sum *sum, sunder_counts *counts);
/* Seconds of wall time spent in decomposing, in forming subsums, and in uniting them. */
SUNDER_EXPERIMENTAL void sunder_sum_seconds(const sunder_sum *sum, double *decompose, double *subsums, double *unite);

/* What was done. decomposition is AUTO if nothing was decomposed (the convolution has its own pieces), else the one
 * used: Hertel and Mehlhorn's if the requested one had to fall back on it. */
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
/* Operations of one phase; false, and all zero, if the road has no such phases (the convolution). */
SUNDER_EXPERIMENTAL bool sunder_sum_phase(const sunder_sum *sum, sunder_phase phase, sunder_counts *counts);

/* Rings of polygon p: 1 + its holes; ring 0 is the outer one. */
SUNDER_API size_t sunder_sum_rings(const sunder_sum *sum, size_t polygon);
/* Vertex numbers of one ring, in order, *n of them. */
SUNDER_API const uint32_t *sunder_sum_ring(const sunder_sum *sum, size_t polygon, size_t ring, size_t *n);
/* The two ends of degenerate segment i (the smaller first), and the place of degenerate point i, as vertex numbers. */
SUNDER_API void sunder_sum_segment(const sunder_sum *sum, size_t i, uint32_t ends[2]);
SUNDER_API uint32_t sunder_sum_point(const sunder_sum *sum, size_t i);
/* The nearest doubles to n vertices at once, in xy[2 n]; *deviation is raised to a bound of how far any of them is from
 * its vertex (infinite where one leaves the range of doubles). */
SUNDER_API sunder_status sunder_sum_vertices(const sunder_sum *sum, const uint32_t *vertex, size_t n, double *xy,
                                             double *deviation, sunder_error *err);
/* The coordinates of a vertex: the nearest doubles (infinite where they leave the range) ... */
SUNDER_API void sunder_sum_vertex(const sunder_sum *sum, uint32_t vertex, double xy[2]);
/* ... and exactly, as text "num" or "num/den" in lowest terms; freed with sunder_free(). */
SUNDER_API sunder_status sunder_sum_vertex_text(const sunder_sum *sum, uint32_t vertex, char **x, char **y,
                                                sunder_error *err);
/* The area as "num/den", freed with sunder_free(). */
SUNDER_API sunder_status sunder_sum_area_text(const sunder_sum *sum, char **area, sunder_error *err);

/* ---- Growing and shrinking ---------------------------------------------------------------------------------- */

typedef enum sunder_operation {
    SUNDER_OPERATION_DILATE, /* P + B */
    SUNDER_OPERATION_ERODE,  /* { x : B + x in P } */
    SUNDER_OPERATION_OPEN,   /* the erosion dilated: the union of all B + x in P */
    SUNDER_OPERATION_CLOSE   /* the dilation eroded */
} sunder_operation;

/* "dilate", "erode", "open", "close". */
SUNDER_API const char *sunder_operation_string(sunder_operation operation);

/* Mathematical morphology [Ser82] of two polygonal sets, exact; P, B and every result are closed sets.
 *
 * p, b     not modified; members may overlap, b need be neither convex nor centred. SUNDER_EARG if b has no area.
 * options  progress (called by one thread at a time), seed and threads; the dilation takes the other ones. NULL: the
 *          defaults.
 * out      a new sum (sunder_sum_free), in canonical form. Its polygons are the closure of the result's interior.
 *          Segments and points are, of a dilation, its degenerate holes (which belong to it); of an erosion or a
 *          closing, its parts without area; an opening has none.
 *
 * Fails   SUNDER_ENOMEM, SUNDER_ECANCEL, SUNDER_EARG
 * Source  src/morphology/README */
SUNDER_API sunder_status sunder_morphology(const sunder_shape *p, const sunder_shape *b, sunder_operation operation,
                                           const sunder_sum_options *options, sunder_sum **out, sunder_error *err);

/* The union of a shape's members, exact, as a sum without degenerate parts. It is made of polygons that are valid in
 * the sense of OGC simple features, whatever touched, overlapped or fell apart. SUNDER_ENOMEM, SUNDER_ECANCEL. */
SUNDER_API sunder_status sunder_shape_union(const sunder_shape *shape, const sunder_sum_options *options,
                                            sunder_sum **out, sunder_error *err);

/* ---- The planar map beneath a sum --------------------------------------------------------------------------- */

/* The subdivision of the plane that a union of subsums was read from, if sunder_sum_options.keep_map asked for it: on
 * the arrangement road the whole arrangement of all subsums, else the map of the union. Each face, edge and vertex has
 * a count of the regions that cover it: open subsums, or, if the union is one region by then, 0 or 1. Edges and
 * vertices between covered faces that no region covers are the degenerate holes.
 *
 * Vertices, edges and faces are numbered from 0; face 0 is the outermost one. Edge e is two half-edges, 2 e from its
 * lexicographically smaller end to the greater and 2 e + 1 back; each has its face on the left. The map lives as long
 * as the sum. */
typedef struct sunder_map sunder_map;

#define SUNDER_NOWHERE UINT32_MAX

SUNDER_EXPERIMENTAL const sunder_map *sunder_sum_map(const sunder_sum *sum); /* NULL if it was not kept */
SUNDER_EXPERIMENTAL size_t sunder_map_vertices(const sunder_map *map);
SUNDER_EXPERIMENTAL size_t sunder_map_edges(const sunder_map *map);
SUNDER_EXPERIMENTAL size_t sunder_map_faces(const sunder_map *map);

/* The coordinates of a vertex, as of a sum's: nearest doubles, and exact texts. */
SUNDER_EXPERIMENTAL void sunder_map_vertex(const sunder_map *map, uint32_t vertex, double xy[2]);
SUNDER_EXPERIMENTAL sunder_status sunder_map_vertex_text(const sunder_map *map, uint32_t vertex, char **x, char **y,
                                                         sunder_error *err);
/* A half-edge out of a vertex; NOWHERE if it is isolated. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_out(const sunder_map *map, uint32_t vertex);
/* The face around a vertex, if it is isolated; else NOWHERE. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_around(const sunder_map *map, uint32_t vertex);

SUNDER_EXPERIMENTAL uint32_t sunder_map_origin(const sunder_map *map, uint32_t half);
SUNDER_EXPERIMENTAL uint32_t sunder_map_twin(uint32_t half);
/* The next one along the boundary of the face on its left. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_next(const sunder_map *map, uint32_t half);
/* The next one counter-clockwise around its origin. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_turn(const sunder_map *map, uint32_t half);
SUNDER_EXPERIMENTAL uint32_t sunder_map_face(const sunder_map *map, uint32_t half);

/* Boundaries of a face, by one half-edge each: the outer one (NOWHERE for face 0), and *n inner ones. */
SUNDER_EXPERIMENTAL uint32_t sunder_map_outer(const sunder_map *map, uint32_t face);
SUNDER_EXPERIMENTAL const uint32_t *sunder_map_inner(const sunder_map *map, uint32_t face, size_t *n);

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
    bool overlap;         /* at the start: the interiors meet (with a gap: or the sets are nearer than it) */
    bool attained;        /* the least is given, as near as is said below: always, as isolated optima are rational */
    bool rounded_is_free; /* (dx, dy) as doubles takes them apart as well, checked exactly */
    sunder_contact contact;
    double dx, dy, distance; /* nearest doubles of the exact values */
    double lower_bound;      /* a proved lower bound of the least distance, rounded down; equals distance up to 1e-9 */
    char *dx_text, *dy_text, *distance_squared_text; /* "num" or "num/den", owned by the struct */
    sunder_counts counts;
} sunder_separation;

/* The least translation of Q that takes its interior off P and, with gap > 0, leaves it at least gap (Euclidean) away.
 *
 * The global minimum over every free placement, degenerate ones (exact slides and fits) included; of several nearest
 * the lexicographically smallest, told apart exactly with a gap as well. With a gap the optimum may be irrational: then
 * the vector given is rational, provably keeps the gap, and is longer than the optimum by at most 1e-9 of it;
 * lower_bound is the optimum's length then. There always is an answer, but for a gap of over 2^700 times the shortest
 * side, where the search may lose its way in the range of doubles: then it is SUNDER_EFAULT, and nothing is claimed.
 * gap   >= 0 and finite, else SUNDER_EARG.
 * out   on success owns its texts: sunder_separation_clear(). An empty operand: zero translation.
 * Source  [LM95] for the role of the no-fit polygon; src/separation/README for the search. */
SUNDER_API sunder_status sunder_pair_separate(const sunder_shape *p, const sunder_shape *q, double gap,
                                              sunder_separation *out, sunder_error *err);
SUNDER_API void sunder_separation_clear(sunder_separation *separation);

/* Do the interiors of P and Q meet? Exact. */
SUNDER_API sunder_status sunder_pair_overlap(const sunder_shape *p, const sunder_shape *q, bool *overlap,
                                             sunder_error *err);
/* Is every point of P at least gap away from every point of Q, and the interiors disjoint? Exact. */
SUNDER_API sunder_status sunder_pair_apart(const sunder_shape *p, const sunder_shape *q, double gap, bool *apart,
                                           sunder_error *err);
/* The distance of P and Q to the nearest double (0 where they meet), and the ends of a shortest link, on P and on Q. */
SUNDER_API sunder_status sunder_pair_distance(const sunder_shape *p, const sunder_shape *q, double *distance,
                                              double on_p[2], double on_q[2], sunder_error *err);

/* ---- Obstacles -------------------------------------------------------------------------------------------- */

/* What the interior of something that moves may not meet, of routes and of layers: a polygonal set, or lines and
 * points, or both. */
typedef struct sunder_obstacle {
    const sunder_shape *shape; /* NULL: none. All is borrowed: for the call, or as long as what it is given to lives */
    const double *xy;          /* x0 y0 x1 y1 ... of all lines, one after the other; finite */
    const size_t *line_end;    /* [lines] index past the last point of each; a line of one point is a point */
    size_t lines;
} sunder_obstacle;

/* ---- A whole layer ---------------------------------------------------------------------------------------- */

typedef struct sunder_layer sunder_layer;

typedef enum sunder_containment {
    SUNDER_CONTAINMENT_BLOCK,   /* a feature that lies in another joins its block */
    SUNDER_CONTAINMENT_IGNORE,  /* it may overlap the one that it lies in */
    SUNDER_CONTAINMENT_SEPARATE /* it is separated like any other */
} sunder_containment;

/* "block", "ignore", "separate"; never NULL. */
SUNDER_API const char *sunder_containment_string(sunder_containment containment);

/* What one stage of sunder_layer_separate() did, for developers. Experimental: stages, steps and outcomes are words
 * that may change with any version (docs/trace.md). The strings and arrays last as long as the call. */
typedef struct sunder_trace_event {
    const char *pass;      /* the part of the whole work; NULL: before its first */
    const char *stage;     /* within the pass; NULL: the pass has one stage */
    int round;             /* of the stage, from 1 on; 0: it has none */
    const char *scope;     /* "layer", "cluster", "group", "pair": what it is about */
    const char *step;      /* within the stage; NULL: the stage as a whole */
    const char *outcome;   /* never NULL */
    const uint32_t *thing; /* [things] features, and behind the last of these barriers, ascending; of a pair two */
    size_t things;         /* 0: the layer */
    double cost_before, cost_after; /* sums of weight times move squared; NAN: not measured */
} sunder_trace_event;

/* Called by the thread that separates. Events and their order are the same for every number of threads. */
typedef void (*sunder_trace)(const sunder_trace_event *event, void *user);

typedef struct sunder_layer_options {
    size_t size;            /* sizeof(sunder_layer_options) */
    double gap;             /* >= 0 */
    double touch_tolerance; /* >= 0; negative (the default): a tenth of the gap */
    bool no_blocks;         /* nothing joins by touch or containment */
    bool no_touch;          /* nothing joins by touch */
    double thin;            /* where the tolerance is 0: count the overlaps that this one would join; 0: do not */
    bool list_inside;       /* list the pairs inside blocks too */
    sunder_containment contained;
    unsigned threads; /* 0: one for each processor; the result is the same for every number */
    sunder_progress progress;
    void *progress_user;
    bool allow_jumps; /* features may jump over others, or out of a yard: see sunder_layer_separate() */
    double effort;    /* >= 0: how hard to look for better sides, for proofs, and for what would free a
                       * conflict, in steps and not in time; 0: not at all */
    uint64_t seed;    /* of what search is random: the better layouts that effort looks for */
    bool keep_trees;  /* for sunder_report_bound_trees(); costs memory */
    bool keep_pushes; /* for sunder_report_pushes() */
    bool keep_worlds; /* for sunder_report_worlds() */
    bool drop_proofs; /* sunder_report_proof() has none: of each only its features are kept, for blocked_by */
    /* Barriers may have been left out if no feature comes too near to them, or crosses them, by a move no longer than
     * this; INFINITY (the default): none were. At least the longest max_shift; need_shift is at most this. Barriers
     * with sides may not be left out where they are within sunder_side_reach() of a feature's box. */
    double barrier_reach;
    sunder_trace trace; /* NULL: none */
    void *trace_user;
} sunder_layer_options;

/* How far about its box (xmin, ymin, xmax, ymax) barriers decide on which side of them a feature is: twice the width
 * and the height of the box together. */
SUNDER_EXPERIMENTAL double sunder_side_reach(const double box[4]);

/* Defaults: gap 0, tolerance a tenth of it, blocks on, one thread, no jumps, effort 1, seed 0. */
SUNDER_API void sunder_layer_options_init_sized(sunder_layer_options *options, size_t size);
static inline void sunder_layer_options_init(sunder_layer_options *options)
{
    sunder_layer_options_init_sized(options, sizeof *options);
}

/* Weights lie in this range, so that costs, forces and their squares are doubles. */
#define SUNDER_LEAST_WEIGHT 1e-100
#define SUNDER_GREATEST_WEIGHT 1e100

typedef struct sunder_feature {
    const sunder_shape *shape; /* borrowed; must outlive the layer. NULL or empty: conflicts with nothing */
    double weight;             /* from SUNDER_LEAST_WEIGHT to SUNDER_GREATEST_WEIGHT */
    double max_shift;          /* no longer move; INFINITY for none; 0 for fixed */
    int64_t block;             /* equal non-negative values move as one; -1: none */
    bool fixed;                /* never moves, is an obstacle */
    bool ignored;              /* conflicts with nothing, never moves */
} sunder_feature;

SUNDER_API sunder_status sunder_layer_new(const sunder_feature *features, size_t n, sunder_layer **out,
                                          sunder_error *err);
SUNDER_API void sunder_layer_free(sunder_layer *layer);

/* What never moves, and is kept at a distance of its own: features stay width / 2 + gap, exactly, from its geometry as
 * it is stored, which is what is drawn with that width, with round ends and joins. */
typedef struct sunder_barrier {
    sunder_obstacle geometry; /* borrowed; must outlive the layer. Empty: in the way of nothing */
    double width;             /* >= 0 and finite: the full drawn width; a polygon grows by half of it */
    double gap;               /* finite; from the drawn edge; negative: the layer's */
    bool side;                /* its lines and boundaries may not be crossed: see sunder_layer_separate() */
} sunder_barrier;

/* The barriers of a layer, in place of those that it had. A pair of a feature and a barrier is one, however many lines
 * and pieces of it are near; cost follows what is near. (One exception to what is exact: a feature whose members, or
 * whose own rings, cross in places that no doubles hold may have walls inside, and a line that lies wholly along one of
 * these is taken for one that does not meet it.)
 * Fails   SUNDER_EARG      a width or a gap out of its range, or ends of lines that do not ascend
 *         SUNDER_EINVALID  a coordinate is not finite */
SUNDER_API sunder_status sunder_layer_set_barriers(sunder_layer *layer, const sunder_barrier *barriers, size_t n,
                                                   sunder_error *err);

/* The side anchors of features that have one of their own, such as the points at which symbols are drawn; each is kept
 * as it is, on a line or off the feature, too: see sunder_layer_separate(). xy: two coordinates of each feature, which
 * are copied. Where they are not finite the rule gives that feature's side anchor; xy NULL: the rule gives all.
 * Fails   only for want of memory */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_set_side_anchors(sunder_layer *layer, const double *xy,
                                                                sunder_error *err);

typedef enum sunder_feature_status {
    SUNDER_FEATURE_UNMOVED,
    SUNDER_FEATURE_MOVED,
    SUNDER_FEATURE_FIXED,
    SUNDER_FEATURE_BLOCKED, /* still has a conflict */
    SUNDER_FEATURE_SKIPPED
} sunder_feature_status;

/* "unmoved", "moved", "fixed", "blocked", "skipped". */
SUNDER_API const char *sunder_feature_status_string(sunder_feature_status status);

typedef enum sunder_conflict_kind {
    SUNDER_CONFLICT_OVERLAP,
    SUNDER_CONFLICT_TOO_CLOSE,
    SUNDER_CONFLICT_BARRIER,       /* the interior of a feature meets a barrier's stored geometry */
    SUNDER_CONFLICT_BARRIER_DRAWN, /* it does not, but is nearer than half of the barrier's width */
    SUNDER_CONFLICT_BARRIER_NEAR,  /* it does neither, but is nearer than it should be */
    SUNDER_CONFLICT_CONTAINED,
    SUNDER_CONFLICT_DUPLICATE,
    /* Found by sunder_layer_check_moves() only; about one feature where b is SIZE_MAX: */
    SUNDER_CONFLICT_WORSE,          /* in conflict, and worse than it stood */
    SUNDER_CONFLICT_LIMIT,          /* a moved by `distance`, and at most `required` was allowed */
    SUNDER_CONFLICT_SIDE,           /* a crossed a side of barrier b, on the way `from` - `to` of its side anchor */
    SUNDER_CONFLICT_JUMP,           /* a jumped over b, on the way `from` - `to` as b sees it */
    SUNDER_CONFLICT_NOT_A_TRANSLATE /* no move of a makes its coordinates what they are now */
} sunder_conflict_kind;

/* "overlap", "too_close", "barrier", "barrier_drawn", "barrier_near", "contained", "duplicate", "worse", "limit",
 * "side", "jump", "not_a_translate". */
SUNDER_API const char *sunder_conflict_kind_string(sunder_conflict_kind kind);

typedef enum sunder_reason {
    SUNDER_REASON_NONE,       /* of a check: no solution was tried */
    SUNDER_REASON_MAX_SHIFT,  /* proved: the pair cannot be parted, or brought inside, within both limits together */
    SUNDER_REASON_FIXED,      /* neither may move */
    SUNDER_REASON_SIDE,       /* proved: no solution of the pair alone, each with its block, crosses no side */
    SUNDER_REASON_JUMP,       /* proved: no solution of the pair alone, each with its block, is without a jump */
    SUNDER_REASON_NO_ROOM,    /* proved: the pair and all pairs not listed have no solution in which other listed
                               * pairs are no worse than at the start */
    SUNDER_REASON_SAME_BLOCK, /* they move as one */
    SUNDER_REASON_KEPT,       /* allowed to overlap: contained, ignored */
    SUNDER_REASON_UNRESOLVED  /* neither a solution nor such a proof was found; it may be crowded, which is proved */
} sunder_reason;

/* "", "max_shift", "fixed", "side", "jump", "no_room", "same_block", "kept", "unresolved". */
SUNDER_API const char *sunder_reason_string(sunder_reason reason);

typedef struct sunder_conflict {
    size_t a, b; /* a < b: features, or for b of the barriers' two kinds the number of features + k for barrier k */
    sunder_conflict_kind kind;
    sunder_reason reason;
    double distance; /* now; 0 where they overlap */
    double before;   /* at the start */
    double depth;    /* length of the least translation that takes the interiors apart now; 0 where disjoint */
    double required; /* the gap asked for; for a barrier plus half its width */
    /* How much of `required` is missing: required - distance, and where interiors meet required + depth. NAN where
     * nothing is owed: inside a block, where the pair may overlap, and of kinds that ask for no distance. */
    double missing;
    double from[2], to[2];    /* the shortest link, or the least translation drawn from inside the overlap */
    const size_t *blocked_by; /* features, and barriers as for b, that stand in the way, n_blocked_by of them */
    size_t n_blocked_by;
    bool inside_block; /* counted in inside_blocks alone */
    /* A limit of moves, a gap with which a solution of the pair and its neighbours is known, NAN: none; a feature or
     * barrier without which it is, SIZE_MAX: none. Upper estimates: all others stand as in the result; a few questions
     * each, and none at effort 0. Of a cluster where these have no answer need_shift is the longest move of a layout of
     * all of it, if one is known. */
    double need_shift, need_gap;
    size_t need_gone;
    /* True only for a conflict with reason UNRESOLVED, and proved: a, b and the features in blocked_by cannot all
     * keep their distances from one another at once, even if every other pair is left in conflict. So at least one
     * pair among them stays in conflict, though not necessarily this one. */
    bool crowded;
    /* An upper bound, which is proved, of the gaps with such a solution: the gap asked for where nothing is proved, and
     * NAN where need_gap is. For most conflicts it exceeds need_gap by at most a hundredth of the gap asked for. */
    double need_gap_most;
} sunder_conflict;

typedef struct sunder_conflict_counts {
    size_t overlap, too_close, barrier, barrier_drawn, barrier_near, contained, duplicate, inside_blocks;
} sunder_conflict_counts;

typedef struct sunder_report sunder_report;

typedef struct sunder_layer_summary {
    size_t features, vertices, blocks, clusters, pairs_tested;
    size_t clusters_optimal;              /* contact groups whose cost is proved to be least */
    sunder_conflict_counts before, after; /* of a check: both the same */
    size_t thin;                          /* pairs between blocks that overlap by no more than options.thin, before */
    size_t inside_overlaps;               /* pairs inside blocks that are listed as overlaps, after */
    size_t moved, blocked, skipped;       /* number of features with that status */
    size_t blocked_moved;                 /* blocked ones that moved, because of other conflicts */
    size_t rounded;
    double total, mean, max; /* of the lengths of moves; mean over all that moved, blocked ones among them */
    size_t max_feature;      /* the first whose move is longest; SIZE_MAX if nothing moved */
    /* Sum of weight * length^2; no placement costs less that solves every pair not listed, leaves none that is listed
     * worse than it stood, and none in overlap that is listed as too close. */
    double cost, lower_bound;
    /* What bound pairs prove by their least translations alone, where none may come to lie in another. No part of
     * lower_bound, which is what trees prove: that is a little less of a pair, and nothing of two that may. */
    double pair_bound;
    /* Every pair but those listed and those in blocks was proved apart (or inside, where that may overlap), and none
     * listed stands worse. */
    bool verified;
    /* Seconds until the last move; for the statements about the result (the list of conflicts, reasons and needs,
     * bounds and pushes); and for the exact checks of all pairs after the last move. A check has the last one only. */
    double seconds_solve, seconds_explain, seconds_verify;
} sunder_layer_summary;

/* The exact list of conflicts of a layer as it stands.
 * Fails   SUNDER_EARG for a gap, tolerance or effort that is negative or not finite, or a tolerance not less than a
 *         non-zero gap. */
SUNDER_API sunder_status sunder_layer_check(const sunder_layer *layer, const sunder_layer_options *options,
                                            sunder_report **out, sunder_error *err);

/* Which rules were broken on the way from `before` to `after`, two layers of the same features in the same order,
 * whatever moved them: like the report's conflicts, of the five kinds from SUNDER_CONFLICT_WORSE on. Limits, blocks and
 * fixed or ignored features are those of `before`; options as for the run that moved it. Features of a block may have
 * moved separately: rigidity of blocks is not checked. The move of a repaired shape whose repaired form was written is
 * not known, and not checked either. summary.verified: nothing was found.
 * Fails   as sunder_layer_check(); SUNDER_EARG too for layers of different sizes. */
SUNDER_EXPERIMENTAL sunder_status sunder_layer_check_moves(const sunder_layer *before, const sunder_layer *after,
                                                           const sunder_layer_options *options, sunder_report **out,
                                                           sunder_error *err);

/* What sunder_layer_separate() does, by the fraction that it tells its progress: it solves up to the first, explains
 * from there to the second, and verifies from there on. */
#define SUNDER_PROGRESS_SOLVED 0.8
#define SUNDER_PROGRESS_EXPLAINED 0.98

/* Separates the features at little cost; src/displacement/README tells how.
 *
 * Every move is such that its feature's vertices plus the move are doubles again, exactly, if there is any such move
 * (else summary.rounded counts the feature, and the rounded vertices are verified). What remains in conflict is listed,
 * and stands no worse than at the start: no nearer, and no deeper in each other by the least translation that separates
 * the two. Other features do not move to ease it.
 *
 * Unless allow_jumps, no feature jumps over another: for every feature A with the anchor a (sunder_shape_anchor()) and
 * the move t, and every other B with the move s that is neither ignored nor of A's block and does not contain a, the
 * closed segment from a to a + t - s, not rounded, does not meet B's old outline. So a feature in a yard that has no
 * room for it keeps its conflict, whatever its limit.
 *
 * Nor does a feature cross a barrier that has sides: with c its side anchor, the closed segment from c to c + t meets
 * none of the barrier's lines except those that c lies on, and none of its areas' edges that have c strictly on the
 * outer side. So a feature inside an area may leave it, and not come in again. The side anchor is that of
 * sunder_layer_set_side_anchors(), e.g. the point that a symbol is drawn at; otherwise it is the anchor, if no such
 * line or edge meets its interior; otherwise an interior point of the largest part that all of them leave of the
 * feature, among parts that are equal within the tolerance the one with the most room:
 * src/displacement/layer/side_anchor.c has the rule. */
SUNDER_API sunder_status sunder_layer_separate(const sunder_layer *layer, const sunder_layer_options *options,
                                               sunder_report **out, sunder_error *err);
SUNDER_API void sunder_report_free(sunder_report *report);

/* The summary. A later version may add members at its end: what does not fit in the caller's `size` bytes is left out,
 * and bytes that the library does not know are set to 0. */
SUNDER_API void sunder_report_summary_sized(const sunder_report *report, sunder_layer_summary *summary, size_t size);
static inline void sunder_report_summary(const sunder_report *report, sunder_layer_summary *summary)
{
    sunder_report_summary_sized(report, summary, sizeof *summary);
}
/* The move of one feature; a coordinate as written is the double nearest to x + dx. */
SUNDER_API void sunder_report_move(const sunder_report *report, size_t feature, double *dx, double *dy);
SUNDER_API sunder_feature_status sunder_report_status(const sunder_report *report, size_t feature);
/* The number of the feature's block, which is that of its first member; -1 for a feature that stands alone. */
SUNDER_API int64_t sunder_report_block(const sunder_report *report, size_t feature);
/* The conflicts that remain, sorted by (a, b): those between blocks, the overlaps beyond the tolerance inside blocks
 * and, with list_inside, every pair inside blocks. */
SUNDER_API const sunder_conflict *sunder_report_conflicts(const sunder_report *report, size_t *n);
/* The force between two features in contact in the result, if keep_pushes was asked for: a multiplier of the program
 * whose optimum the result is. The sum of force * n over the pushes on a block is twice its weight times its move, at
 * an optimum and below its limit. In doubles, for display; sorted by (a, b). */
typedef struct sunder_push {
    size_t a, b; /* features, or for b the number of features + k for barrier k */
    double force;
    double n[2]; /* of length 1: b is pushed that way, and a the other */
} sunder_push;

SUNDER_EXPERIMENTAL const sunder_push *sunder_report_pushes(const sunder_report *report, size_t *n);

/* ---- Routes ----------------------------------------------------------------------------------------------- */

/* A place, exactly: "num" or "num/den" in decimal where text[k] is given, else the double. */
typedef struct sunder_place {
    double xy[2];
    const char *text[2];
} sunder_place;

/* All zero but the size: the defaults. */
typedef struct sunder_route_options {
    size_t size;              /* sizeof(sunder_route_options) */
    double gap;               /* >= 0 and finite; the robot is grown by a polygon of 64 sides around the disc */
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

/* A shortest path along which the robot can be moved, by translations, among the obstacles.
 *
 * Free space is the complement of the union of the open sets O_i + int(-robot) and so is closed: contact is allowed,
 * and passages that the robot fits exactly are passages. An exact fit in a keyhole is a place. The path is that of the
 * robot's own origin. Of several shortest paths it is the lexicographically smallest, as sequences of vertices; lengths
 * are compared up to 2^-256 of themselves. A separate test proves that each leg keeps the interior of the robot off
 * every obstacle all the way.
 *
 * robot      not empty, else SUNDER_EARG. Members may touch and overlap, holes are allowed. (One exception, for
 *            obstacles without area only: where members cross in places that are not doubles, walls that two share do
 *            not count as interior.)
 * out        on success, also if there is no route: see sunder_route_reason().
 * Fails      SUNDER_EARG for an argument out of its range, SUNDER_ENOMEM, SUNDER_ECANCEL; SUNDER_EINVALID for an
 *            obstacle with a coordinate that is not finite, SUNDER_ERANGE for a place too far away to be compared.
 * Source     [LW79] for the graph, [HNR68] for the search; see src/motion/README.
 * Cost       the outline of the union as for a sum; then A* over the corners, looking only at edges that may belong to
 *            a shortest path. */
SUNDER_API sunder_status sunder_route_find(const sunder_obstacle *obstacles, size_t n, const sunder_shape *robot,
                                           const sunder_place *from, const sunder_place *to,
                                           const sunder_route_options *options, sunder_route **out, sunder_error *err);
SUNDER_API void sunder_route_free(sunder_route *route);

/* Why there is none; *obstacle is the first one in the way, if there is one, else SIZE_MAX. */
SUNDER_API sunder_route_status sunder_route_reason(const sunder_route *route, size_t *obstacle);
/* Vertices of the path, start and goal included; one if they are the same; 0 if there is no route. */
SUNDER_API size_t sunder_route_vertices(const sunder_route *route);
/* A vertex: the nearest doubles, and texts as of a sum's, owned by the route. */
SUNDER_API void sunder_route_vertex(const sunder_route *route, size_t vertex, double xy[2]);
SUNDER_API void sunder_route_vertex_text(const sunder_route *route, size_t vertex, const char **x, const char **y);
/* To the nearest double; 0 if there is no route. */
SUNDER_API double sunder_route_length(const sunder_route *route);
/* Is the path with its vertices rounded to the nearest doubles free as well? Proved like the path. */
SUNDER_API bool sunder_route_rounded_is_free(const sunder_route *route);
/* The configuration-space obstacles, united: a sum like any other, with its degenerate holes. Lives as long as the
 * route. */
SUNDER_API const sunder_sum *sunder_route_obstacles(const sunder_route *route);

/* ---- Predicates on doubles -------------------------------------------------------------------------------- */

typedef struct sunder_point {
    double x, y;
} sunder_point;

/* Side of c relative to the directed line a->b: +1 left, -1 right, 0 on it. Always the true sign: nothing is allocated,
 * so nothing can fail. All coordinates finite. */
SUNDER_API int sunder_orient(const sunder_point *a, const sunder_point *b, const sunder_point *c);

#ifdef __cplusplus
}
#endif
#endif
