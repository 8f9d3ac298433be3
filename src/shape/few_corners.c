/* The numbers of a ring of few corners: see few_corners.h. */
#include "shape/few_corners.h"

/* Of each n: the last corner, all of them, the first one again. So from the first of these numbers on stands who comes
 * before each corner, from the third on who comes after each. */
static const uint32_t round_about[] = {
    2, 0, 1, 2, 0,                                              /* 3 */
    3, 0, 1, 2, 3, 0,                                           /* 4 */
    4, 0, 1, 2, 3, 4, 0,                                        /* 5 */
    5, 0, 1, 2, 3, 4, 5, 0,                                     /* 6 */
    6, 0, 1, 2, 3, 4, 5, 6, 0,                                  /* 7 */
    7, 0, 1, 2, 3, 4, 5, 6, 7, 0,                               /* 8 */
    8, 0, 1, 2, 3, 4, 5, 6, 7, 8, 0,                            /* 9 */
    9, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0,                         /* 10 */
    10, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0,                    /* 11 */
    11, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0,                /* 12 */
    12, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0,            /* 13 */
    13, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 0,        /* 14 */
    14, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 0,    /* 15 */
    15, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0 /* 16 */
};

/* Of each n the number itself, and all corners. */
static const uint32_t whole[] = {
    3, 0, 1, 2,                                                 /* 3 */
    4, 0, 1, 2, 3,                                              /* 4 */
    5, 0, 1, 2, 3, 4,                                           /* 5 */
    6, 0, 1, 2, 3, 4, 5,                                        /* 6 */
    7, 0, 1, 2, 3, 4, 5, 6,                                     /* 7 */
    8, 0, 1, 2, 3, 4, 5, 6, 7,                                  /* 8 */
    9, 0, 1, 2, 3, 4, 5, 6, 7, 8,                               /* 9 */
    10, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9,                           /* 10 */
    11, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10,                       /* 11 */
    12, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11,                   /* 12 */
    13, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12,               /* 13 */
    14, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13,           /* 14 */
    15, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14,       /* 15 */
    16, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15    /* 16 */
};

static const uint32_t count[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
static const size_t long_count[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17};
static const bool none[SUNDER_I_FEW_CORNERS];

/* Where those of n begin: the sum of k + 2 for k from 3 to n - 1, and that of k + 1. */
#define ROUND(n) ((n) * ((n)-1) / 2 - 3 + 2 * ((n)-3))
#define WHOLE(n) ((n) * ((n) + 1) / 2 - 6)

#define CLEANED(n)                                                                                                     \
    [n] = {&count[n], &count[1], round_about + ROUND(n) + 2, round_about + ROUND(n), none, 1, 1}

static const sunder_i_cleaned cleaned[] = {
    CLEANED(3),  CLEANED(4),  CLEANED(5),  CLEANED(6),  CLEANED(7),  CLEANED(8),  CLEANED(9),
    CLEANED(10), CLEANED(11), CLEANED(12), CLEANED(13), CLEANED(14), CLEANED(15), CLEANED(16)};

#define GIVEN(n) [n] = {&long_count[n], &long_count[1], 1}

static const sunder_i_given given[] = {GIVEN(0),  GIVEN(1),  GIVEN(2),  GIVEN(3),  GIVEN(4),  GIVEN(5),
                                       GIVEN(6),  GIVEN(7),  GIVEN(8),  GIVEN(9),  GIVEN(10), GIVEN(11),
                                       GIVEN(12), GIVEN(13), GIVEN(14), GIVEN(15), GIVEN(16), GIVEN(17)};

const sunder_i_cleaned *sunder_i_few_cleaned(uint32_t n) { return &cleaned[n]; }

const uint32_t *sunder_i_few_whole(uint32_t n) { return whole + WHOLE(n); }

const sunder_i_given *sunder_i_few_given(size_t n) { return &given[n]; }
