/* The numbers of a ring of few corners: see few_corners.h. */
#include "shape/few_corners.h"

/* Of each n: the last corner, all of them, the first one again. So from the first of these numbers on stands who comes
 * before each corner, from the second on the corners themselves, from the third on who comes after each. */
static const uint32_t round_about[] = {
    2,  0, 1, 2, 0,                                             /* 3 */
    3,  0, 1, 2, 3, 0,                                          /* 4 */
    4,  0, 1, 2, 3, 4, 0,                                       /* 5 */
    5,  0, 1, 2, 3, 4, 5, 0,                                    /* 6 */
    6,  0, 1, 2, 3, 4, 5, 6, 0,                                 /* 7 */
    7,  0, 1, 2, 3, 4, 5, 6, 7, 0,                              /* 8 */
    8,  0, 1, 2, 3, 4, 5, 6, 7, 8, 0,                           /* 9 */
    9,  0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0,                        /* 10 */
    10, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0,                    /* 11 */
    11, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0,                /* 12 */
    12, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0,            /* 13 */
    13, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 0,        /* 14 */
    14, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 0,    /* 15 */
    15, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0 /* 16 */
};

static const uint32_t count[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17};
static const size_t long_count[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17};
static const bool none[SUNDER_I_FEW_CORNERS];

sunder_i_few_corners sunder_i_few_corners_of(uint32_t n)
{
    /* The sum of k + 2 for k from 3 to n - 1. */
    const uint32_t *ring = round_about + (n * (n - 1) / 2 - 3) + 2 * (n - 3);
    return (sunder_i_few_corners){.prev = ring, .corner = ring + 1, .next = ring + 2, .unshared = none};
}

const uint32_t *sunder_i_few(uint32_t n) { return &count[n]; }

const size_t *sunder_i_few_long(size_t n) { return &long_count[n]; }
