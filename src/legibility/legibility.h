/* legibility.h: one part of a shape, and the files that measure it. */
#ifndef SUNDER_I_LEGIBILITY_H
#define SUNDER_I_LEGIBILITY_H

#include "predicate/predicate.h"
#include "shape/shape.h"
#include "spatial/rtree.h"
#include "sunder_legible.h"

/* A part: a polygon of the cleaned form. Its edges have the numbers of their first vertices, less `first`. */
typedef struct sunder_i_part_read {
    const sunder_shape *shape;
    sunder_i_placed placed; /* the shape on a lattice that admits ratios */
    size_t polygon;
    uint32_t first, n;   /* its vertices */
    double box[4];       /* in doubles, as the corners of the shape */
    sunder_i_rtree tree; /* of its edges; for links only */
} sunder_i_part_read;

static inline const double *sunder_i_part_xy(const sunder_i_part_read *part, uint32_t v)
{
    return part->shape->xy + 2 * (size_t)v;
}
static inline uint32_t sunder_i_part_next(const sunder_i_part_read *part, uint32_t v)
{
    return part->shape->form->cleaned.next[v];
}
static inline uint32_t sunder_i_part_prev(const sunder_i_part_read *part, uint32_t v)
{
    return part->shape->form->cleaned.prev[v];
}
static inline sunder_i_point sunder_i_part_at(const sunder_i_part_read *part, uint32_t v) { return part->placed.p[v]; }

/* ---- read_part.c ------------------------------------------------------------------------------------------------- */

/* Makes the part that polygon of its shape; the tree is that of another call, which the caller frees. */
void sunder_i_part_select(sunder_i_part_read *part, size_t polygon);
sunder_status sunder_i_part_build_tree(sunder_i_part_read *part, sunder_error *err);
/* Sets box to that of the edge that begins at vertex v, with corners rounded outwards. */
void sunder_i_part_edge_box(const sunder_i_part_read *part, uint32_t v, double box[4]);

/* Is sqrt(num / den), den > 0, in units of the lattice, less than the limit? Exact. */
bool sunder_i_distance_below(sunder_i_lattice *lattice, sunder_i_big num, sunder_i_big den, double limit);

/* ---- Measures ---------------------------------------------------------------------------------------------------- */

/* The functions below set *found to whether the part is below the limit > 0, and then *out to what it has and where. */

/* sizes.c; they fail with SUNDER_ENOMEM through the arena of the lattice. */
void sunder_i_part_area(sunder_i_part_read *part, double limit, bool *found, sunder_illegible *out);
void sunder_i_part_edges(sunder_i_part_read *part, double limit, bool *found, sunder_illegible *out);
/* narrow.c */
sunder_status sunder_i_part_width(const sunder_i_part_read *part, double limit, bool *found, sunder_illegible *out,
                                  sunder_error *err);
/* part_links.c; necks if `inside`, otherwise inner gaps. */
sunder_status sunder_i_part_links(sunder_i_part_read *part, bool inside, double limit, bool *found,
                                  sunder_illegible *out, sunder_error *err);

/* ---- link_sight.c: what lies between the ends of a link ---------------------------------------------------------- */

/* Does no edge meet the segment from vertex v to the point `end`, which is vertex w or, if `foot`, lies on the edge w?
 * Edges at its ends are not tested. Sets *clear; returns false if out of memory. */
bool sunder_i_link_clear(sunder_i_part_read *part, uint32_t v, uint32_t w, bool foot, sunder_i_point end,
                         sunder_i_list *near, bool *clear);
/* Two antiparallel edges e, f that face each other over a part of their length: is a link between them clear? low and
 * high: the ends of the part, vertices of either. *at becomes a clear place along e, from 0 to 1 over the edge. */
bool sunder_i_links_clear(sunder_i_part_read *part, uint32_t e, uint32_t f, uint32_t low, uint32_t high,
                          sunder_i_list *near, bool *clear, double *at);

#endif
