/* sunder_shape.h: polygonal sets, and questions about one or two of them: sides, distances, and the least translation
 * that takes two apart. Part of sunder.h, which states the conventions. */
#ifndef SUNDER_SHAPE_H
#define SUNDER_SHAPE_H

#include "sunder_base.h"

#ifdef __cplusplus
extern "C" {
#endif

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

/* ---- Predicates on doubles -------------------------------------------------------------------------------- */

typedef struct sunder_point {
    double x, y;
} sunder_point;

/* Returns the side of the directed line from a to b on which c lies: +1 left, -1 right, 0 on the line. The result is
 * exact. The coordinates must be finite. Nothing is allocated, so the function cannot fail. */
SUNDER_API int sunder_orient(const sunder_point *a, const sunder_point *b, const sunder_point *c);

/* Returns where a point lies: +1 in the interior of a member of the shape, 0 on a ring of a member and in the interior
 * of none, -1 outside. The interior of a polygon is what its rings enclose by the even-odd rule, without the rings. The
 * result is exact for the rings that were given. The coordinates of `at` must be finite. Nothing is allocated, so the
 * function cannot fail. Cost: O(n) if the point lies in the box of the shape, else O(1). */
SUNDER_API int sunder_shape_locate(const sunder_shape *shape, const sunder_point *at);

#ifdef __cplusplus
}
#endif
#endif
