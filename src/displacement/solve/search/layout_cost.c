/* What a layout costs: moves, springs, and what pairs that are eased, and tight ones, lack. */
#include "displacement/solve/search/cluster_search.h"

double sunder_i_search_cost(sunder_i_search *search, const double *t)
{
    double cost = sunder_i_search_shortfall_price(search, t) + sunder_i_search_tight_price(search, t);
    for (size_t k = 0; k < search->n; k++)
        if (search->mass[k] > 0) cost += sunder_i_search_stray_square(search, k, t) / (2 * search->mass[k]);
    sunder_i_row_link link;
    for (sunder_i_row_walk walk = {0}; sunder_i_search_next_row(search, &walk, &link);)
        cost += sunder_i_spring_cost(search->model, link.side, t + 2 * link.i,
                                     link.j == SUNDER_I_GROUND ? link.still : t + 2 * link.j);
    return cost;
}
