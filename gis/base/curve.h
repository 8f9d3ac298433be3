/* curve.h: places along a Hilbert curve: neighbours along it are neighbours in the plane. */
#ifndef GIS_CURVE_H
#define GIS_CURVE_H

#include <math.h>
#include <stdint.h>

/* Position of a cell of a grid of 2^bits by 2^bits along the curve, bits <= 31: at each level the quadrant in which it
 * lies, then the quadrant's own turn of the plane. */
static inline uint64_t gis_curve_position(uint32_t x, uint32_t y, unsigned bits)
{
    const uint32_t last = (UINT32_C(1) << bits) - 1;
    uint64_t along = 0;
    for (uint32_t s = UINT32_C(1) << (bits - 1); s; s >>= 1) {
        const uint32_t right = (x & s) != 0, up = (y & s) != 0;
        along += (uint64_t)s * s * ((3 * right) ^ up);
        if (!up) {
            if (right) {
                x = last - x;
                y = last - y;
            }
            const uint32_t swap = x;
            x = y;
            y = swap;
        }
    }
    return along;
}

/* The cell, along one axis of such a grid over [from, to], of a place. */
static inline uint32_t gis_curve_cell(double place, double from, double to, unsigned bits)
{
    const double t = to > from ? (place - from) / (to - from) : 0;
    return (uint32_t)(fmin(fmax(t, 0), 1) * (double)((UINT32_C(1) << bits) - 1));
}

#endif
