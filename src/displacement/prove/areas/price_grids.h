/* Computes prices of area on a sequence of grids, from a coarse one to finer ones. Both the lower bound (areas.c) and
 * the starting positions (places.c) use it. */
#ifndef SUNDER_I_AREAS_PRICE_GRIDS_H
#define SUNDER_I_AREAS_PRICE_GRIDS_H

#include "displacement/prove/areas/areas.h"

typedef struct sunder_i_price_grids {
    const sunder_i_model *model;
    const uint32_t *body; /* [n] borrowed */
    size_t n;
    sunder_i_outline *outline; /* [n] owned */
    sunder_i_payer *payer;     /* [payers] owned; one for each body that has an area and does not span too many squares,
                                * in the order of body[] */
    size_t payers;
    double box[4]; /* the rectangle within which there may be prices */
    double size;   /* the side of a square of the bodies' mean area; 0 if too few bodies have an area */
    double side;   /* the side of a square of the next grid */
    double patience;
    unsigned left, coarser; /* `left`: the number of grids still to come; `coarser`: the number of grids before the
                             * finest, so that the first has squares 2^coarser times as large */
    sunder_i_grid grid;     /* the last grid, and the prices on it (owned) */
    float *price;
} sunder_i_price_grids;

/* Prepares the sequence of grids for the n bodies of body[], which is borrowed. `about` is the distance from the
 * bodies' original and present positions up to which there may be a price, in multiples of the size of a body. The
 * caller calls sunder_i_price_grids_free() even if this fails. */
sunder_status sunder_i_price_grids_init(sunder_i_price_grids *grids, const sunder_i_model *model, const uint32_t *body,
                                        size_t n, double about, sunder_error *err);
void sunder_i_price_grids_free(sunder_i_price_grids *grids);
/* Computes prices on the next grid, starting from those on the last. It may be called only while grids->left > 0.
 * Returns false if memory is out. */
bool sunder_i_price_grids_refine(sunder_i_price_grids *grids);

#endif
