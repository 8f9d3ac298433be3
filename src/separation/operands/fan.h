/* fan.h: tests a point against a convex polygon with many sides by few of them.
 *
 * Vertex 0 and the others form a fan of triangles. Bisection finds the triangle that contains the point, or beyond
 * whose outer side the point lies; a point certainly in a triangle is inside, and a point certainly on the right of a
 * side is outside. All is in doubles; the caller decides what they leave open. */
#ifndef SUNDER_I_FAN_H
#define SUNDER_I_FAN_H

#include <stdbool.h>
#include <stdint.h>

/* Polygons with at least this number of sides are tested by bisection, others side by side; both take about the same
 * time here. */
#define SUNDER_I_SIDES_MANY 24

/* The triangle of the vertices 0, low and low + 1. */
typedef struct sunder_i_fan {
    uint32_t low;
    bool first, last; /* the diagonal to vertex low is side 0; the diagonal to low + 1 is the last side */
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

/* out[] is the signed distance of the point, positive outside, from side low, from the diagonal to vertex low and from
 * that to low + 1. The point is inside if all are below -deep, and outside if the distance from one that is a side
 * exceeds `far`. */
static inline sunder_i_fan_answer sunder_i_fan_says(const sunder_i_fan *fan, const double out[3], double deep,
                                                    double far)
{
    if (out[0] > far || (fan->first && out[1] > far) || (fan->last && out[2] > far)) return SUNDER_I_FAN_OUTSIDE;
    return out[0] < -deep && out[1] < -deep && out[2] < -deep ? SUNDER_I_FAN_INSIDE : SUNDER_I_FAN_DOUBT;
}

#endif
