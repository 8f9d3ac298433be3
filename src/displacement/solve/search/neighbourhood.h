/* A few bodies of a cluster that are searched by themselves; see neighbourhood.c. */
#ifndef SUNDER_I_NEIGHBOURHOOD_H
#define SUNDER_I_NEIGHBOURHOOD_H

#include "displacement/solve/search/cluster_search.h"

typedef struct sunder_i_neighbourhood {
    sunder_i_search *all;
    sunder_i_rtree tree; /* boxes of all bodies at the present moves, relative to the first body's origin */
    uint32_t *place;     /* [n] the bodies of the neighbourhood, as indices in `all`; `moving` of them may move */
    size_t n, moving;
    bool *moves; /* [all->n] does the body move? */
    bool wider;  /* movable bodies nearby were left out, since the greatest number was reached */
    uint32_t *body;
    double *t; /* [2 n] their moves before */
    sunder_i_list near;
} sunder_i_neighbourhood;

/* Prepares neighbourhoods in the search `all`, which has no clashes. False if memory is out; the caller calls
 * sunder_i_neighbourhood_free() in any case. */
bool sunder_i_neighbourhood_init(sunder_i_neighbourhood *neighbourhood, sunder_i_search *all);
void sunder_i_neighbourhood_free(sunder_i_neighbourhood *neighbourhood);
/* Looks for a layout without clashes in which only bodies i and j and bodies around them move, at most `most` bodies.
 * The search ignores bodies farther than `reach` from a moving one; a result that clashes with one of these is
 * rejected. Returns whether there is such a layout; the bodies are moved there then. */
bool sunder_i_neighbourhood_settle(sunder_i_neighbourhood *neighbourhood, uint32_t i, uint32_t j, size_t most,
                                   double reach);
/* As sunder_i_neighbourhood_settle(), for a layout that violates its constraints by no more than rounding causes: looks
 * for the nearest layout without violations, not for a cheaper one. */
bool sunder_i_neighbourhood_repair(sunder_i_neighbourhood *neighbourhood, uint32_t i, uint32_t j, size_t most,
                                   double reach);
/* Bodies i and j were moved away from the solution `best`: descends with them and the bodies around them, while all
 * others keep their places. A solution that is cheaper than `best` by more than `least` is kept, and the difference is
 * returned. Otherwise all bodies return to `best`, and 0 is returned. */
double sunder_i_neighbourhood_descend(sunder_i_neighbourhood *neighbourhood, uint32_t i, uint32_t j, size_t most,
                                      double reach, const double *best, double least);

#endif
