/* The price of the distance that a pair left in conflict still lacks; see prices.c. */
#ifndef SUNDER_I_PRICES_H
#define SUNDER_I_PRICES_H

#include "displacement/layer/model.h"

/* Lacking s >= 0 costs linear * s + square * s^2. */
typedef struct sunder_i_price {
    double linear, square;
} sunder_i_price;

/* The price of two bodies, one of which may move. A part of a barrier stands for the whole barrier. */
sunder_i_price sunder_i_price_of(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q);

static inline double sunder_i_price_at(const sunder_i_price *price, double missing)
{
    return missing * (price->linear + price->square * missing);
}

#endif
