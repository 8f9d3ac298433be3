/* hilbert.h: positions along a Hilbert curve: points that are close along the curve are close in the plane. */
#ifndef GIS_HILBERT_H
#define GIS_HILBERT_H

#include <math.h>
#include <stdint.h>

/* The position along the curve of a cell in a grid of 2^bits by 2^bits cells, bits <= 31. Each level contributes the
 * quadrant in which the cell lies, and that quadrant's transformation of the plane, which may exchange the axes and
 * flip both. Without branches, since quadrants are practically random. */
static inline uint64_t gis_curve_position(uint32_t x, uint32_t y, unsigned bits)
{
    uint64_t along = 0;
    uint32_t exchanged = 0, round = 0;
    for (unsigned level = bits; level-- > 0;) {
        const uint32_t own = (x >> level) & 1, other = (y >> level) & 1, turn = ((own ^ other) & exchanged) ^ round;
        const uint32_t right = own ^ turn, up = other ^ turn;
        along = along << 2 | ((3 * right) ^ up);
        round ^= right & ~up;
        exchanged ^= up ^ 1;
    }
    return along;
}

/* The number of the cell that contains `place`, along one axis of such a grid over [from, to]. */
static inline uint32_t gis_curve_cell(double place, double from, double to, unsigned bits)
{
    const double t = to > from ? (place - from) / (to - from) : 0;
    return (uint32_t)(fmin(fmax(t, 0), 1) * (double)((UINT32_C(1) << bits) - 1));
}

#endif
