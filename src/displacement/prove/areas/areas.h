/* How much do bodies have to move because they share no area? A bound by prices; README.md has the proof. */
#ifndef SUNDER_I_AREAS_H
#define SUNDER_I_AREAS_H

#include "displacement/layer/model.h"

/* Squares of the plane: node (i, j) is the place side * (x + i, y + j). Prices are at nodes and bilinear between them;
 * elsewhere they are 0. */
typedef struct sunder_i_grid {
    double side; /* a power of 2 */
    int64_t x, y;
    size_t columns, rows;
} sunder_i_grid;

/* How often prices are blurred to be smooth, which spreads them by as many nodes; those within so many of the border
 * are not asked for, so that at the border two rows and columns have none. */
#define BLURRED 2
#define SUNDER_I_GRID_BORDER (2 + BLURRED)

static inline size_t sunder_i_grid_nodes(const sunder_i_grid *grid) { return grid->columns * grid->rows; }

/* What a body occupies with half of the gap about it, as it stood at the start, or less: rings, outer ones
 * counter-clockwise, holes clockwise. */
typedef struct sunder_i_outline {
    double *xy;       /* owned */
    size_t *ring_end; /* [rings] index past the last corner of each; owned */
    size_t rings;
    double box[4], area;
} sunder_i_outline;

/* A mass of one square, in the whole numbers of sunder_i_masses; and of a price, the most that is used. */
#define SUNDER_I_MASS_OF_SQUARE (INT64_C(1) << 20)
#define SUNDER_I_MOST_PRICE (INT64_C(1) << 16)

/* The integral over a body of the hat of each node (1 there, 0 at all others), in squares: at[j * columns + i] is no
 * more than that of node (x + i, y + j), whose numbers are relative to the lattice. */
typedef struct sunder_i_masses {
    int32_t *at; /* owned */
    int64_t x, y;
    size_t columns, rows;
    int64_t total, slack; /* of all; how much less than the integral one may be, at most */
} sunder_i_masses;

/* A body whose area is paid for. */
typedef struct sunder_i_payer {
    double weight; /* a lower bound */
    double limit;  /* of its moves; may be infinite */
    sunder_i_masses masses;
} sunder_i_payer;

/* Prices, as whole numbers of `unit` a unit of area. */
typedef struct sunder_i_prices {
    sunder_i_grid grid;
    double unit;     /* a power of 2 */
    uint32_t *price; /* [nodes]; owned */
} sunder_i_prices;

/* ---- occupied_outline.c ------------------------------------------------------------------------------------------ */

/* The body's members are to be united. *out has no rings if it has no area. */
sunder_status sunder_i_outline_make(const sunder_i_model *model, uint32_t body, sunder_i_outline *out,
                                    sunder_error *err);
void sunder_i_outline_free(sunder_i_outline *outline);

/* ---- masses.c ---------------------------------------------------------------------------------------------------- */

/* False if memory is out; the caller frees it in any case. */
bool sunder_i_masses_make(const sunder_i_outline *outline, const sunder_i_grid *grid, sunder_i_masses *masses);
void sunder_i_masses_free(sunder_i_masses *masses);

/* ---- ascent.c ---------------------------------------------------------------------------------------------------- */

/* Raises prices (of a unit of area, [nodes]) towards those that prove most, in doubles. rounds: how often all payers
 * are asked at most. patience: how far from a payer's cheapest place others count, as a share of a square moved by its
 * side. The number of threads changes nothing but the time. False if memory is out. */
bool sunder_i_prices_ascend(const sunder_i_grid *grid, const sunder_i_payer *payer, size_t n, double patience,
                            unsigned rounds, unsigned threads, float *price);

/* Where each payer is in the mean, as softly: [2 * n] moves. False if memory is out. */
bool sunder_i_prices_places(const sunder_i_grid *grid, const sunder_i_payer *payer, size_t n, double patience,
                            unsigned threads, const float *price, double *move);

/* ---- price_proof.c ----------------------------------------------------------------------------------------------- */

/* What the prices prove: the sum over payers of the least that each pays, moving and standing, less the worth of all
 * area; rounded downwards. 0 where the numbers get too large, or where the two outermost rows or columns have a price.
 * False if memory is out. */
bool sunder_i_prices_prove(const sunder_i_prices *prices, const sunder_i_payer *payer, size_t n, unsigned threads,
                           double *bound);

/* ---- areas.c ----------------------------------------------------------------------------------------------------- */

/* A lower bound on the total cost of bodies that all owe each other the gap. *bound: 0 where nothing is proved; else
 * *prices proves it, and the caller frees its numbers. Members are united. */
sunder_status sunder_i_areas_bound(const sunder_i_model *model, const uint32_t *body, size_t n, sunder_i_prices *prices,
                                   double *bound, sunder_error *err);

/* ---- places.c ---------------------------------------------------------------------------------------------------- */

/* Where bodies may begin to be taken apart: [2 * n] moves; *found: false where there are none, and they are as they
 * were, or have no meaning if it fails; rough: of the coarsest grid alone, a tenth of the work. Members are to be
 * united. */
sunder_status sunder_i_areas_places(const sunder_i_model *model, const uint32_t *body, size_t n, bool rough,
                                    double *move, bool *found, sunder_error *err);

#endif
