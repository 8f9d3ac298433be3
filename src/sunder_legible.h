/* sunder_legible.h: is a shape large enough to be read on a map? Least widths, areas, necks, inner gaps and edges, as
 * the minimum dimensions of map specifications ask for them.
 *
 * The whole header is experimental: see sunder.h and docs/api.md. */
#ifndef SUNDER_LEGIBLE_H
#define SUNDER_LEGIBLE_H

#include "sunder_shape.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What each part of a shape has to have, in units of the shape; 0: not asked. A part is a polygon of the cleaned form.
 *
 * A link of a part is a segment between two points of its boundary that is locally shortest: it makes an acute angle
 * with none of the edges at its ends. Links are the local minima of the distance of two boundary points [DEW20]. Two
 * parallel sides that face each other have links of one length; a tip that tapers has none, nor has a triangle. */
typedef struct sunder_legible_limits {
    double width;     /* the diameter of the largest disc in the part */
    double area;      /* of the part */
    double neck;      /* the length of links whose inner points are interior points of the part */
    double inner_gap; /* the length of links whose inner points are outside of the part: across bays and courtyards */
    double edge;      /* the length of edges; those that collinear vertices divide are one */
} sunder_legible_limits;

typedef enum sunder_illegible_kind {
    SUNDER_ILLEGIBLE_NARROW,    /* its width is below the limit */
    SUNDER_ILLEGIBLE_SMALL,     /* its area is */
    SUNDER_ILLEGIBLE_NECK,      /* a neck is */
    SUNDER_ILLEGIBLE_INNER_GAP, /* an inner gap is */
    SUNDER_ILLEGIBLE_SHORT_EDGE /* an edge is */
} sunder_illegible_kind;
#define SUNDER_ILLEGIBLE_KINDS 5

/* "narrow", "small", "neck", "inner_gap", "short_edge". */
SUNDER_EXPERIMENTAL const char *sunder_illegible_kind_string(sunder_illegible_kind kind);

/* A part that is below a limit. */
typedef struct sunder_illegible {
    sunder_illegible_kind kind;
    size_t polygon;       /* of the cleaned form */
    double has, required; /* `has`: the nearest double; of a width one that is too small by up to a millionth */
    double from[2]; /* where: a diameter of the largest disc, the diagonal of the part's box if it is small, ... */
    double to[2];   /* ... the shortest link, the shortest edge */
} sunder_illegible;

/* Finds the parts of a shape that are below a limit, each once for a kind, with what is least.
 *
 * A part whose size equals the limit passes, and one that is smaller by any amount does not: this is decided exactly,
 * from the coordinates as they are. In a point where the boundary of a part touches itself, the part has a neck and an
 * inner gap of length 0. Parts are examined alone: they may touch and overlap each other.
 *
 * limits  finite and >= 0
 * found   *n findings, sorted by polygon and kind, freed by the caller with sunder_free(); NULL if there are none
 * Fails   SUNDER_EARG for a limit out of its range; SUNDER_ERANGE if a frame around a part, ten times as large,
 *         leaves the range of doubles; SUNDER_ENOMEM, SUNDER_ECANCEL
 * Cost    O(n k log n), k being the number of edges within the limit of an edge, and a search for the largest disc.
 *
 * If corners of a repaired shape are no doubles, widths are those with corners rounded to the nearest ones; all else is
 * exact there, too. */
SUNDER_EXPERIMENTAL sunder_status sunder_shape_illegible(const sunder_shape *shape, const sunder_legible_limits *limits,
                                                         sunder_illegible **found, size_t *n, sunder_error *err);

#ifdef __cplusplus
}
#endif
#endif
