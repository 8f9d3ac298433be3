/* Declarations that the files of the brute force for gaps share. */
#ifndef SUNDER_TESTS_GAP_ORACLE_INNER_H
#define SUNDER_TESTS_GAP_ORACLE_INNER_H

#include "gap_oracle.h"

/* ---- Sides and corners (gap_oracle_figure.c) ---- */

typedef struct side {
    double ax, ay, bx, by;
} side;

typedef struct figure {
    const polyset *p, *q;
    side *a, *b;
    size_t n, m;
    double gap;
} figure;

void figure_open(figure *f, const polyset *p, const polyset *q, double gap);
void figure_close(figure *f);
/* For sets in which each corner is at least the gap away from all sides of the other: then the signs computed here are
 * certain. */
bool interiors_apart(const figure *f, double tx, double ty);

/* ---- Places, in long binary fractions (gap_oracle_places.c) ---- */

enum { SHORT, LONG }; /* number of bits; see precision() */

/* A line n . x = c with |n| = 1, or (n = 0) a circle about (x, y). */
typedef struct track {
    bool circle;
    double x, y, nx, ny, c;
    double corner[4], direction[4]; /* exact, as differences: ([0] - [2], [1] - [3]); for a side, its direction */
    double gap;
    bool ready[2];
    mpf_t hx[2], hy[2], hnx[2], hny[2], hc[2];
} track;

/* u is NULL for a foot; root: selects one of two crossings. */
typedef struct place {
    track *t, *u;
    int root;
    double x, y;
} place;

typedef struct numbers {
    mpf_t v[8];
} numbers;

void numbers_open(numbers *n, int level);
void numbers_close(numbers *n);
mp_bitcnt_t precision(int level);
/* a - b, exact if `out` has enough bits. */
void minus(mpf_t out, double a, double b);
/* out = a b + c d, or a b - c d */
void pair_sum(mpf_t out, const mpf_t a, const mpf_t b, const mpf_t c, const mpf_t d, mpf_t work, bool subtract);
/* Is it so small that at this level it counts as zero, or cannot be distinguished from zero? */
bool negligible(const mpf_t v, int level);

/* Makes all lines and circles of the figure, five for each pair of sides; returns their number. */
size_t add_tracks(const figure *f, track *t);
void release(track *t);
/* Drops those that are farther away than the limit everywhere; returns the number left. */
size_t drop_far_tracks(track *t, size_t n, double limit);
/* In doubles: false if the place is certainly farther than the limit, or certainly does not exist. *sure: x and y are
 * correct to 1e-9 of the figure. */
bool rough_place(place *p, double size, double limit, bool *sure);
/* Computes the place with the bits of that level; false if there is none. */
bool locate(mpf_t x, mpf_t y, const place *p, int level, numbers *w);

#endif
