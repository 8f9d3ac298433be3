/* sum_value.h: a sum, whatever method computed it. */
#ifndef SUNDER_I_SUM_VALUE_H
#define SUNDER_I_SUM_VALUE_H

#include "predicate/predicate.h"
#include "sunder_sum.h"

struct sunder_sum {
    sunder_i_lattice lattice;
    double origin[2][2]; /* the origin of each operand; their sum may not be a double */
    sunder_i_hpoint *vertex;
    uint32_t vertices;
    uint32_t *ring_vertex; /* the vertices of all rings, ring by ring */
    size_t *ring_end;      /* [rings] the index after the last vertex of each ring */
    size_t *poly_end;      /* [polygons] the index after the last ring of each polygon */
    size_t rings, polygons;
    uint32_t *segment; /* [2 * segments] the ends of the degenerate segments */
    uint32_t *point;   /* [points] the degenerate points */
    size_t segments, points;
    sunder_sum_method method;
    double seconds[3]; /* by sunder_phase */
    sunder_counts phase[3];
    sunder_map *map; /* the planar map, whose points are on the lattice; NULL: not kept */
};

/* Returns a vertex in units of the lattice. */
static inline sunder_i_rational_point sunder_i_sum_point(sunder_i_arena *arena, const sunder_sum *sum, uint32_t vertex)
{
    return sunder_i_hpoint_read(arena, &sum->lattice, &sum->vertex[vertex]);
}

/* ---- vertex_texts.c ---- */

/* Returns the exponent of the coordinate n / d on the lattice, as *num / *den * 2^exponent with the origins added. The
 * arena is the caller's and not the lattice's, so that the sum does not change and several threads may call this at
 * once. */
long sunder_i_sum_coordinate(sunder_i_arena *arena, const sunder_sum *sum, int axis, sunder_i_big n, sunder_i_big d,
                             sunder_i_big *num, sunder_i_big *den);
/* Store a point's coordinates as the nearest doubles (NaN if out of memory), and as texts, which the caller frees; the
 * latter fails with SUNDER_ENOMEM. */
void sunder_i_sum_doubles(sunder_i_arena *arena, const sunder_sum *sum, sunder_i_rational_point at, double xy[2]);
sunder_status sunder_i_sum_texts(sunder_i_arena *arena, const sunder_sum *sum, sunder_i_rational_point at, char **x,
                                 char **y, sunder_error *err);

#endif
