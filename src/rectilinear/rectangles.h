/* rectangles.h: open rectangles with sides parallel to the axes: the distinct coordinates, sorted, and each rectangle
 * by its ranks among them. Internal to this folder. */
#ifndef SUNDER_I_RECTANGLES_H
#define SUNDER_I_RECTANGLES_H

#include "shape/shape.h"

/* From low to high along each axis (0: x, 1: y), low < high: coordinates, or their ranks. */
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
    int64_t *at[2];     /* the distinct coordinates along each axis, ascending */
    uint32_t places[2]; /* the numbers of these */
    uint64_t comparisons;
} sunder_i_ranked_rectangles;

/* ---- cut.c ---- */

/* Returns true if all edges are parallel to an axis. */
bool sunder_i_is_rectilinear(const sunder_shape *shape, const sunder_i_point *at);
/* *out becomes a list of rectangles with disjoint interiors whose closures form each polygon of such a shape; an empty
 * list if there would be too many. Returns false if out of memory. */
bool sunder_i_rectangles_cut(const sunder_shape *shape, const sunder_i_point *at, sunder_i_rectangle_list *out);

/* ---- rank.c ---- */

/* Sorts the coordinates and sets the ranks of all rectangles. Returns false if out of memory. */
bool sunder_i_rectangles_rank(const sunder_i_rectangle_list *list, sunder_i_ranked_rectangles *out);
void sunder_i_ranked_rectangles_free(sunder_i_ranked_rectangles *ranked);

#endif
