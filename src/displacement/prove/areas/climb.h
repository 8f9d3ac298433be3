/* Prices of area from a coarse grid to finer ones: what the bound and the places of a crowd have in common. */
#ifndef SUNDER_I_AREAS_CLIMB_H
#define SUNDER_I_AREAS_CLIMB_H

#include "displacement/prove/areas/areas.h"

typedef struct sunder_i_climb {
    const sunder_i_model *model;
    const uint32_t *body; /* [n] */
    size_t n;
    sunder_i_outline *outline; /* [n] */
    sunder_i_payer *payer;     /* [payers] those that have any area, in their order */
    size_t payers;
    double box[4]; /* of all places that may have a price */
    double size;   /* of a body of mean area; 0: too few bodies have any */
    double side;   /* of the next grid */
    double patience;
    unsigned left, coarser; /* grids to come, the next one among them; it is one in 2^coarser of the finest */
    sunder_i_grid grid;     /* the last, and its prices */
    float *price;
} sunder_i_climb;

/* about: how far from where bodies stood and stand there may be a price, in sizes of bodies. Failure leaves what is
 * freed. */
sunder_status sunder_i_climb_init(sunder_i_climb *climb, const sunder_i_model *model, const uint32_t *body, size_t n,
                                  double about, sunder_error *err);
void sunder_i_climb_free(sunder_i_climb *climb);
/* Prices on the next grid, from those on the last; only while climb->left > 0. False if memory is out. */
bool sunder_i_climb_on(sunder_i_climb *climb);

#endif
