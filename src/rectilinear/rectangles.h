/* Open rectangles with sides along the axes: the distinct coordinates, sorted, and each rectangle by its ranks among
 * them. Internal to this folder. */
#ifndef SUNDER_I_RECTANGLES_H
#define SUNDER_I_RECTANGLES_H

#include "shape/shape.h"

/* From low to high along each axis (0: x, 1: y), low < high: coordinates, or ranks of them. */
typedef struct sunder_i_rectangle {
    int64_t low[2], high[2];
} sunder_i_rectangle;

typedef struct sunder_i_rectangle_list {
    sunder_i_rectangle *item;
    size_t n, capacity;
} sunder_i_rectangle_list;

typedef struct sunder_i_ranked_rectangle {
    uint32_t low[2], high[2];
} sunder_i_ranked_rectangle;

typedef struct sunder_i_ranked_rectangles {
    sunder_i_ranked_rectangle *item;
    uint32_t n;
    int64_t *at[2];     /* coordinates along each axis, ascending, each once */
    uint32_t places[2]; /* how many */
    uint64_t comparisons;
} sunder_i_ranked_rectangles;

/* ---- cut.c ---- */

/* Do all edges run along an axis? */
bool sunder_i_is_rectilinear(const sunder_shape *shape, const sunder_i_point *at);
/* Rectangles with disjoint interiors whose closures make up each polygon of such a shape; an empty list if there would
 * be too many. False if memory is out. */
bool sunder_i_rectangles_cut(const sunder_shape *shape, const sunder_i_point *at, sunder_i_rectangle_list *out);

/* ---- rank.c ---- */

/* False if memory is out. */
bool sunder_i_rectangles_rank(const sunder_i_rectangle_list *list, sunder_i_ranked_rectangles *out);
void sunder_i_ranked_rectangles_free(sunder_i_ranked_rectangles *ranked);

#endif
