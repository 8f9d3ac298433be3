/* A few bodies of a cluster, searched by themselves; see neighbourhood.c. */
#ifndef SUNDER_I_NEIGHBOURHOOD_H
#define SUNDER_I_NEIGHBOURHOOD_H

#include "displacement/solve/search/cluster_search.h"

typedef struct sunder_i_neighbourhood {
    sunder_i_search *all;
    sunder_i_rtree tree; /* the boxes of all as they stand, from the first body's origin */
    uint32_t *place;     /* [n] its members, as indices in `all`; `moving` of them move */
    size_t n, moving;
    bool *moves; /* [all->n] */
    bool wider;  /* there would have been more that could move */
    uint32_t *body;
    double *t; /* where they stood */
    sunder_i_list near;
} sunder_i_neighbourhood;

/* For a search without clashes. False if memory is out; the caller frees it in any case. */
bool sunder_i_neighbourhood_init(sunder_i_neighbourhood *neighbourhood, sunder_i_search *all);
void sunder_i_neighbourhood_free(sunder_i_neighbourhood *neighbourhood);
/* Looks for a layout without clashes of bodies i and j and those around them, at most `most` bodies, while all
 * others stay where they are. If there is one, the bodies are moved there. reach: of the bodies farther than this
 * from a moved one none takes part, either as moved or as an obstacle. */
bool sunder_i_neighbourhood_settle(sunder_i_neighbourhood *neighbourhood, uint32_t i, uint32_t j, size_t most,
                                   double reach);
/* The same from a layout whose constraints are violated by rounding only; the solution is looked for near it. */
bool sunder_i_neighbourhood_repair(sunder_i_neighbourhood *neighbourhood, uint32_t i, uint32_t j, size_t most,
                                   double reach);
/* Starts from the solution `best`, with i and j at other places, and descends with i, j and the bodies around them,
 * while all others stay. A solution that is cheaper than `best` by more than `least` is kept, and the difference is
 * returned; otherwise all bodies are put back to `best`, and 0 is returned. */
double sunder_i_neighbourhood_descend(sunder_i_neighbourhood *neighbourhood, uint32_t i, uint32_t j, size_t most,
                                      double reach, const double *best, double least);
/* Puts the n bodies of `place` at their given places, if no body around them is in the way. After that they are in no
 * neighbourhood. */
bool sunder_i_neighbourhood_put(sunder_i_neighbourhood *neighbourhood, const double *to);
/* The bodies within reach of body i, in order of number: into `near`. False if memory is out. */
bool sunder_i_neighbourhood_look_about(sunder_i_neighbourhood *neighbourhood, uint32_t i, double reach);

#endif
