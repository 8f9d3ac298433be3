/* approx_sum.h: tests of the sum of two convex pieces in doubles; the sides of the sum are enumerated, but the sum is
 * not stored. */
#ifndef SUNDER_I_APPROX_SUM_H
#define SUNDER_I_APPROX_SUM_H

#include "convex/piece_tree.h"

/* A box in the form that the tests below use. */
typedef struct sunder_i_cell_window {
    double low[SUNDER_I_WAYS], high[SUNDER_I_WAYS]; /* its extents in the directions of piece_tree.h, widened by the
                                                     * error */
    double cx, cy, hx, hy;                          /* the centre, and half of the width and the height */
    double error;
} sunder_i_cell_window;

/* Returns a bound on the error of coordinates and distances in the sums of pieces of two trees. */
double sunder_i_approx_sum_error(const sunder_i_piece_tree *p, const sunder_i_piece_tree *q);
/* Prepares the box xmin, ymin, xmax, ymax; `error` is the result of sunder_i_approx_sum_error(). */
sunder_i_cell_window sunder_i_cell_window_of(const double box[4], double error);

typedef enum sunder_i_window_place {
    SUNDER_I_BEYOND, /* certainly outside the sum */
    SUNDER_I_WITHIN, /* certainly inside the interior of the sum */
    SUNDER_I_ACROSS
} sunder_i_window_place;

/* Returns the position of the window relative to the sum of piece i of p and piece j of q. */
sunder_i_window_place sunder_i_approx_sum_sees(const sunder_i_piece_tree *p, uint32_t i, const sunder_i_piece_tree *q,
                                               uint32_t j, const sunder_i_cell_window *w);
/* Returns the approximate area of the sum of piece i of p and piece j of q. */
double sunder_i_approx_sum_area(const sunder_i_piece_tree *p, uint32_t i, const sunder_i_piece_tree *q, uint32_t j);

#endif
