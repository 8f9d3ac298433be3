/* A convex polygon of many sides, tested by a few of them.
 *
 * Corner 0 and the others make a fan of triangles. Bisection finds the triangle that holds the point, or over whose
 * outer side the point stands; a point certainly in a triangle is inside, and a point certainly on the right of a side
 * is outside. All in doubles; the caller decides what they leave in doubt. */
#ifndef SUNDER_I_FAN_H
#define SUNDER_I_FAN_H

#include <stdbool.h>
#include <stdint.h>

/* Polygons with more sides than this are tested by bisection, others side by side: about where both are equally
 * fast. */
#define SUNDER_I_SIDES_MANY 24

/* The triangle of corners 0, low and low + 1. */
typedef struct sunder_i_fan {
    uint32_t low;
    bool first, last; /* the diagonal to corner low is side 0; that to low + 1 is the last side */
} sunder_i_fan;

static inline sunder_i_fan sunder_i_fan_at(uint32_t sides, const double *cx, const double *cy, double x, double y)
{
    uint32_t low = 1, high = sides - 1;
    while (high - low > 1) {
        const uint32_t k = low + (high - low) / 2;
        if ((cx[k] - cx[0]) * (y - cy[0]) - (cy[k] - cy[0]) * (x - cx[0]) >= 0)
            low = k;
        else
            high = k;
    }
    return (sunder_i_fan){low, low == 1, low + 2 == sides};
}

typedef enum sunder_i_fan_answer { SUNDER_I_FAN_INSIDE, SUNDER_I_FAN_OUTSIDE, SUNDER_I_FAN_DOUBT } sunder_i_fan_answer;

/* out: how far the point stands out over side low, over the diagonal to corner low and over that to low + 1, which
 * count as sides where they are. Inside: by more than `deep` behind all three; outside: by more than `far` over a
 * side. */
static inline sunder_i_fan_answer sunder_i_fan_says(const sunder_i_fan *fan, const double out[3], double deep,
                                                    double far)
{
    if (out[0] > far || (fan->first && out[1] > far) || (fan->last && out[2] > far)) return SUNDER_I_FAN_OUTSIDE;
    return out[0] < -deep && out[1] < -deep && out[2] < -deep ? SUNDER_I_FAN_INSIDE : SUNDER_I_FAN_DOUBT;
}

#endif
