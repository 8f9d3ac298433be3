/* Proposes starting positions for many bodies at the same place: each body gets the mean of the moves that are nearly
 * the cheapest for it at prices of area. Bodies that coincide are spread in all directions, and bodies in a row do not
 * pass each other, as in optimal transport. So most pairs are already on the right sides of each other when the search
 * begins, and few corrections remain. */
#include "displacement/prove/areas/price_grids.h"
#include "displacement/prove/areas/tuning.h"

#include <math.h>

sunder_status sunder_i_areas_places(const sunder_i_model *model, const uint32_t *body, size_t n, bool rough,
                                    double *move, bool *found, sunder_error *err)
{
    sunder_i_price_grids l;
    *found = false;
    sunder_status status = sunder_i_price_grids_init(&l, model, body, n, ROOM_ABOUT * sqrt((double)n), err);
    /* The finest grid increases what is proved but does not improve the positions; it is left out. */
    const unsigned last = rough && l.left > 1 ? l.left - 1 : 1;
    while (!status && l.left > last)
        if (!sunder_i_price_grids_refine(&l)) status = sunder_i_failure_cause(err);
    if (!status && l.price && l.payers == n) {
        *found = sunder_i_prices_places(&l.grid, l.payer, n, l.patience, model->rules.threads, l.price, move);
        if (!*found) status = sunder_i_failure_cause(err);
    }
    sunder_i_price_grids_free(&l);
    return status;
}
