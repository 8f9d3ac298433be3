/* The search with a gap in 113 bits, for what long double leaves open. */
#include "separation/gap.h"

#include <float.h>
#include <math.h>

#if defined(__SIZEOF_FLOAT128__) && LDBL_MANT_DIG < 113
__extension__ typedef __float128 quad;
#define REAL_EPSILON ((quad)0x1p-112)

/* Newton's method doubles the digits: two steps from the double root. */
static quad quad_sqrt(quad v)
{
    if (!(v > 0)) return 0;
    double scale = 1;
    while (v > (quad)0x1p900) {
        v *= (quad)0x1p-200;
        scale *= 0x1p100;
    }
    while (v < (quad)0x1p-900) {
        v *= (quad)0x1p200;
        scale *= 0x1p-100;
    }
    quad r = sqrt((double)v);
    for (int i = 0; i < 2; i++) r = (r + v / r) / 2;
    return r * scale;
}
#else
typedef long double quad;
#define REAL_EPSILON LDBL_EPSILON
#define quad_sqrt sqrtl
#endif

#define REAL quad
#define REAL_SQRT quad_sqrt
#define SEARCH sunder_i_gap_search_quad

#include "separation/gap_search.inc"
