/* Gaps of pairs by the classes of the two; see sunder_layer_set_gaps(). */
#ifndef SUNDER_I_CLASS_GAPS_H
#define SUNDER_I_CLASS_GAPS_H

#include "sunder_layer.h"
#include <stdint.h>

typedef struct sunder_i_class_gaps {
    size_t n;        /* the number of classes */
    uint32_t *of;    /* [features + barriers] the class of each, features first */
    double *gap;     /* [n * n] the gap of each two classes */
    double *full;    /* [n * n] the full gap of each two, not less */
    double *part;    /* [n] the least gap of each class to a class that features have */
    double among[2]; /* the greatest gap, and full gap, of two classes that features have */
} sunder_i_class_gaps;

/* Returns the entry of a table, which is `gap` or `full`, for the feature or barrier x and the feature y, but at most
 * `most`. */
static inline double sunder_i_class_gap(const sunder_i_class_gaps *gaps, const double *table, double most, uint32_t x,
                                        uint32_t y)
{
    const double entry = table[gaps->of[x] * gaps->n + gaps->of[y]];
    return entry < most ? entry : most;
}

void sunder_i_class_gaps_free(sunder_i_class_gaps *gaps);

#endif
