/* The sum of two convex pieces in doubles, walked side by side without making it. */
#ifndef SUNDER_I_APPROX_SUM_H
#define SUNDER_I_APPROX_SUM_H

#include "convex/piece_tree.h"

/* A box, prepared for the tests below. */
typedef struct sunder_i_cell_window {
    double low[SUNDER_I_WAYS], high[SUNDER_I_WAYS]; /* its extents, widened by the error */
    double cx, cy, hx, hy;                          /* centre, and half of what it measures */
    double error;
} sunder_i_cell_window;

/* A bound on the error of coordinates and distances in the sum of two trees' pieces. */
double sunder_i_approx_sum_error(const sunder_i_piece_tree *p, const sunder_i_piece_tree *q);
/* Of a box xmin, ymin, xmax, ymax. */
sunder_i_cell_window sunder_i_cell_window_of(const double box[4], double error);

typedef enum sunder_i_window_place {
    SUNDER_I_BEYOND, /* outside the sum, for certain */
    SUNDER_I_WITHIN, /* inside its interior, for certain */
    SUNDER_I_ACROSS
} sunder_i_window_place;

/* Where does the window lie, relative to piece i of p plus piece j of q? */
sunder_i_window_place sunder_i_approx_sum_sees(const sunder_i_piece_tree *p, uint32_t i, const sunder_i_piece_tree *q,
                                               uint32_t j, const sunder_i_cell_window *w);
/* The approximate area of that sum. */
double sunder_i_approx_sum_area(const sunder_i_piece_tree *p, uint32_t i, const sunder_i_piece_tree *q, uint32_t j);

#endif
