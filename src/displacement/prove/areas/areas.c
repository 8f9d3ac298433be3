/* Computes a lower bound on the joint cost of bodies from prices of area, over a sequence of ever finer grids. */
#include "displacement/prove/areas/price_grids.h"

#include "base/extremes.h"

#include <math.h>

/* Rounds the prices of `price` ([nodes of out->grid]) to whole numbers of out->unit and stores them in out->price,
 * which the caller frees. Returns false if memory is out. */
static bool round_prices(const float *price, sunder_i_prices *out)
{
    const size_t nodes = sunder_i_grid_nodes(&out->grid);
    double most = 0;
    for (size_t k = 0; k < nodes; k++) most = sunder_i_max(most, price[k]);
    int exponent;
    frexp(most / (double)SUNDER_I_MOST_PRICE, &exponent);
    out->unit = ldexp(1, exponent);
    out->price = sunder_i_alloc(nodes, sizeof *out->price);
    for (size_t k = 0; out->price && k < nodes; k++) out->price[k] = (uint32_t)((double)price[k] / out->unit + 0.5);
    return out->price;
}

/* Computes the bound that the prices of the present grid prove. If it exceeds *bound, these prices replace *best, and
 * *bound is set to it; otherwise both remain. Returns false if memory is out. */
static bool prove_prices(const sunder_i_price_grids *l, sunder_i_prices *best, double *bound)
{
    sunder_i_prices own = {.grid = l->grid};
    double proved = 0;
    const bool ok = round_prices(l->price, &own) &&
                    sunder_i_prices_prove(&own, l->payer, l->payers, l->model->rules.threads, &proved);
    if (ok && proved > *bound) {
        sunder_i_free(best->price);
        *best = own;
        *bound = proved;
    } else {
        sunder_i_free(own.price);
    }
    return ok;
}

sunder_status sunder_i_areas_bound(const sunder_i_model *model, const uint32_t *body, size_t n, sunder_i_prices *prices,
                                   double *bound, sunder_error *err)
{
    sunder_i_price_grids l;
    *prices = (sunder_i_prices){0};
    *bound = 0;
    sunder_status status = sunder_i_price_grids_init(&l, model, body, n, 0, err);
    while (!status && l.left > 0)
        if (!sunder_i_price_grids_refine(&l) || !prove_prices(&l, prices, bound)) status = sunder_i_failure_cause(err);
    sunder_i_price_grids_free(&l);
    if (status) {
        sunder_i_free(prices->price);
        *prices = (sunder_i_prices){0};
    }
    return status;
}
