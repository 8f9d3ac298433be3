/* A sum, whichever road made it. */
#ifndef SUNDER_I_SUM_VALUE_H
#define SUNDER_I_SUM_VALUE_H

#include "predicate/predicate.h"

struct sunder_sum {
    sunder_i_lattice lattice;
    double origin[2][2]; /* of each operand; their sum may not be a double */
    sunder_i_hpoint *vertex;
    uint32_t vertices;
    uint32_t *ring_vertex; /* of all rings, one after the other */
    size_t *ring_end;      /* [rings] */
    size_t *poly_end;      /* [polygons], in rings */
    size_t rings, polygons;
    uint32_t *segment; /* [2 * segments] */
    uint32_t *point;   /* [points] */
    size_t segments, points;
    sunder_sum_method method;
    double seconds[3]; /* by sunder_phase */
    sunder_counts phase[3];
    sunder_map *map; /* NULL: not kept; stands on the lattice */
};

/* A vertex in units of the lattice. */
static inline sunder_i_rational_point sunder_i_sum_point(sunder_i_arena *arena, const sunder_sum *sum, uint32_t vertex)
{
    return sunder_i_hpoint_read(arena, &sum->lattice, &sum->vertex[vertex]);
}

/* ---- vertex_texts.c ---- */

/* The coordinate n / d on the lattice, as *num / *den * 2^exponent with the origins added; returns the exponent. The
 * arena is the caller's and not the lattice's, so that a const sum stays so and threads may ask at once. */
long sunder_i_sum_coordinate(sunder_i_arena *arena, const sunder_sum *sum, int axis, sunder_i_big n, sunder_i_big d,
                             sunder_i_big *num, sunder_i_big *den);
/* A point's coordinates as the nearest doubles (NaN if memory is out), and as texts. */
void sunder_i_sum_doubles(sunder_i_arena *arena, const sunder_sum *sum, sunder_i_rational_point at, double xy[2]);
sunder_status sunder_i_sum_texts(sunder_i_arena *arena, const sunder_sum *sum, sunder_i_rational_point at, char **x,
                                 char **y, sunder_error *err);

#endif
