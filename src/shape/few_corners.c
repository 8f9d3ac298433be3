/* few_corners.c: see few_corners.h. */
#include "shape/few_corners.h"

/* For each n: the last vertex, all vertices, the first vertex again. So row n, read from its first number on, is the
 * predecessor of each vertex; read from its third number on, the successor. */
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

/* For each n: the number n, and all vertices. */
static const uint32_t whole[] = {
    3,  0, 1, 2,                                             /* 3 */
    4,  0, 1, 2, 3,                                          /* 4 */
    5,  0, 1, 2, 3, 4,                                       /* 5 */
    6,  0, 1, 2, 3, 4, 5,                                    /* 6 */
    7,  0, 1, 2, 3, 4, 5, 6,                                 /* 7 */
    8,  0, 1, 2, 3, 4, 5, 6, 7,                              /* 8 */
    9,  0, 1, 2, 3, 4, 5, 6, 7, 8,                           /* 9 */
    10, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9,                        /* 10 */
    11, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10,                    /* 11 */
    12, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11,                /* 12 */
    13, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12,            /* 13 */
    14, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13,        /* 14 */
    15, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14,    /* 15 */
    16, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 /* 16 */
};

static const uint32_t count[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
static const size_t long_count[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17};
static const bool none[SUNDER_I_FEW_CORNERS];

/* The beginnings of row n in the two tables: the sum of k + 2 for k from 3 to n - 1, and that of k + 1. */
#define ROUND(n) ((n) * ((n)-1) / 2 - 3 + 2 * ((n)-3))
#define WHOLE(n) ((n) * ((n) + 1) / 2 - 6)

#define CLEANED(n)                                                                                                     \
    {                                                                                                                  \
        &count[n], &count[1], round_about + ROUND(n) + 2, round_about + ROUND(n), none, 1, 1                           \
    }
#define GIVEN(n)                                                                                                       \
    {                                                                                                                  \
        &long_count[n], &long_count[1], 1                                                                              \
    }
#define FORM(n, given_n) [given_n] = {GIVEN(given_n), CLEANED(n), NULL}

/* The forms of n vertices, for any number of raw vertices. */
#define FORMS(n)                                                                                                       \
    [n] = {FORM(n, 3),  FORM(n, 4),  FORM(n, 5),  FORM(n, 6),  FORM(n, 7),  FORM(n, 8),  FORM(n, 9), FORM(n, 10),      \
           FORM(n, 11), FORM(n, 12), FORM(n, 13), FORM(n, 14), FORM(n, 15), FORM(n, 16), FORM(n, 17)}

static const sunder_i_form form[][SUNDER_I_FEW_CORNERS + 2] = {FORMS(3),  FORMS(4),  FORMS(5),  FORMS(6),  FORMS(7),
                                                               FORMS(8),  FORMS(9),  FORMS(10), FORMS(11), FORMS(12),
                                                               FORMS(13), FORMS(14), FORMS(15), FORMS(16)};

const sunder_i_form *sunder_i_few_form(uint32_t n, size_t given) { return &form[n][given]; }

bool sunder_i_is_few_form(const sunder_i_form *of) { return of->cleaned.shared == none; }

const uint32_t *sunder_i_few_whole(uint32_t n) { return whole + WHOLE(n); }
