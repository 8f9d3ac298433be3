/* The sum of two convex pieces in doubles, gone round side by side without making it. */
#ifndef SUNDER_I_APPROX_SUM_H
#define SUNDER_I_APPROX_SUM_H

#include "convex/piece_tree.h"

/* A box, seen by the questions that are asked about it. */
typedef struct sunder_i_cell_window {
    double low[SUNDER_I_WAYS], high[SUNDER_I_WAYS]; /* its extents, widened by the error */
    double cx, cy, hx, hy;                          /* centre, and half of what it measures */
    double error;
} sunder_i_cell_window;

/* What coordinates and distances in the sum of two trees' pieces are off by, at most. */
double sunder_i_approx_sum_error(const sunder_i_piece_tree *p, const sunder_i_piece_tree *q);
/* Of a box xmin, ymin, xmax, ymax. */
sunder_i_cell_window sunder_i_cell_window_of(const double box[4], double error);

typedef enum sunder_i_window_place {
    SUNDER_I_BEYOND, /* outside the sum, for certain */
    SUNDER_I_WITHIN, /* inside its interior, for certain */
    SUNDER_I_ACROSS
} sunder_i_window_place;

/* Where is the window, seen from piece i of p plus piece j of q? */
sunder_i_window_place sunder_i_approx_sum_sees(const sunder_i_piece_tree *p, uint32_t i, const sunder_i_piece_tree *q,
                                               uint32_t j, const sunder_i_cell_window *w);
/* The area of that sum, nearly. */
double sunder_i_approx_sum_area(const sunder_i_piece_tree *p, uint32_t i, const sunder_i_piece_tree *q, uint32_t j);

#endif
