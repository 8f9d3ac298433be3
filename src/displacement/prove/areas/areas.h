/* Lower bounds on how far bodies have to move because their areas may not overlap. A bound is proved by prices of area;
 * README.md contains the proof. */
#ifndef SUNDER_I_AREAS_H
#define SUNDER_I_AREAS_H

#include "displacement/layer/model.h"

/* A grid of squares of the plane. Node (i, j) has the coordinates side * (x + i, y + j). A price is given at each node,
 * and prices are interpolated bilinearly between nodes; outside the grid the price is 0. */
typedef struct sunder_i_grid {
    double side; /* a power of 2 */
    int64_t x, y;
    size_t columns, rows;
} sunder_i_grid;

/* Prices are smoothed BLURRED times, and each time they spread by one node. No price is chosen for the nodes within
 * SUNDER_I_GRID_BORDER of the border, so that after smoothing the two outermost rows and columns still have the price
 * 0. */
#define BLURRED 2
#define SUNDER_I_GRID_BORDER (2 + BLURRED)

static inline size_t sunder_i_grid_nodes(const sunder_i_grid *grid) { return grid->columns * grid->rows; }

/* The area that a body occupies at its original position, or a subset of it: the body and all places nearer to it than
 * half the gap. Outer rings are counter-clockwise, holes clockwise. */
typedef struct sunder_i_outline {
    double *xy;       /* owned */
    size_t *ring_end; /* [rings] the index after the last corner of each ring; owned */
    size_t rings;
    double box[4], area;
} sunder_i_outline;

/* The mass of a full square in the whole numbers of sunder_i_masses, and the largest price in the whole numbers of
 * sunder_i_prices. */
#define SUNDER_I_MASS_OF_SQUARE (INT64_C(1) << 20)
#define SUNDER_I_MOST_PRICE (INT64_C(1) << 16)

/* The masses of a body: for each node the integral, over the body's area, of the hat function of that node (1 at the
 * node, 0 at all others), with a full square as SUNDER_I_MASS_OF_SQUARE. at[j * columns + i] is at most the integral
 * for node (x + i, y + j); these indices are relative to the grid's first node. */
typedef struct sunder_i_masses {
    int32_t *at; /* owned */
    int64_t x, y;
    size_t columns, rows;
    int64_t total, slack; /* the sum of at[], and an upper bound of the amount by which an entry of at[] is below its
                           * integral */
} sunder_i_masses;

/* A body as the bound uses it. For each of its moves, it pays the cost of the move plus the price of the area that it
 * occupies after it. */
typedef struct sunder_i_payer {
    double weight; /* a lower bound on the body's weight */
    double limit;  /* the longest move the body is allowed; may be infinite */
    sunder_i_masses masses;
} sunder_i_payer;

/* Prices of area, as whole numbers: price[k] * unit is the price of one unit of area at node k. */
typedef struct sunder_i_prices {
    sunder_i_grid grid;
    double unit;     /* a power of 2 */
    uint32_t *price; /* [nodes]; owned */
} sunder_i_prices;

/* ---- occupied_outline.c ------------------------------------------------------------------------------------------ */

/* Builds the occupied area of `body`. The members of the body have to be united into one shape before. *out has no
 * rings if the body has no area. */
sunder_status sunder_i_outline_make(const sunder_i_model *model, uint32_t body, sunder_i_outline *out,
                                    sunder_error *err);
void sunder_i_outline_free(sunder_i_outline *outline);

/* ---- masses.c ---------------------------------------------------------------------------------------------------- */

/* Distributes the area of the outline over the nodes of `grid`. Returns false if memory is out; the caller has to free
 * *masses in either case. */
bool sunder_i_masses_make(const sunder_i_outline *outline, const sunder_i_grid *grid, sunder_i_masses *masses);
void sunder_i_masses_free(sunder_i_masses *masses);

/* ---- ascent.c ---------------------------------------------------------------------------------------------------- */

/* Changes the prices in `price` ([nodes], per unit of area; read as the start) towards those that prove the largest
 * bound, in floating point. `rounds` is the largest number of steps, in each of which all payers are evaluated.
 * `patience` determines how much dearer than a payer's cheapest move another move may be and still get a share of the
 * payer; it is given relative to what a move by one side of a square costs. The result does not depend on `threads`.
 * Returns false if memory is out. */
bool sunder_i_prices_ascend(const sunder_i_grid *grid, const sunder_i_payer *payer, size_t n, double patience,
                            unsigned rounds, unsigned threads, float *price);

/* Writes to move[2 * k] and move[2 * k + 1] the mean of the moves that are nearly the cheapest for payer k at these
 * prices, weighted as in sunder_i_prices_ascend() with the same `patience`. Returns false if memory is out. */
bool sunder_i_prices_places(const sunder_i_grid *grid, const sunder_i_payer *payer, size_t n, double patience,
                            unsigned threads, const float *price, double *move);

/* ---- price_proof.c ----------------------------------------------------------------------------------------------- */

/* Sets *bound to the lower bound that the prices prove, rounded downwards: the sum over the payers of the least total
 * that each pays for a move and for the area that it then occupies, minus the price of all area. *bound is 0 if the
 * numbers would get too large or if a node in the two outermost rows or columns has a price. Returns false if memory is
 * out. */
bool sunder_i_prices_prove(const sunder_i_prices *prices, const sunder_i_payer *payer, size_t n, unsigned threads,
                           double *bound);

/* ---- areas.c ----------------------------------------------------------------------------------------------------- */

/* Computes a lower bound on the total cost of the n bodies of body[], all pairs of which must keep the gap. Sets *bound
 * to 0 if nothing is proved; otherwise *prices are the prices that prove the bound, and the caller frees prices->price.
 * The members of each body have to be united into one shape before. */
sunder_status sunder_i_areas_bound(const sunder_i_model *model, const uint32_t *body, size_t n, sunder_i_prices *prices,
                                   double *bound, sunder_error *err);

/* ---- places.c ---------------------------------------------------------------------------------------------------- */

/* Proposes starting positions for n bodies at the same place: move[2 * k] and move[2 * k + 1] become the move of
 * body[k]. Sets *found to false if it has no proposal; move[] is then unchanged. If the call fails, move[] has no
 * meaning. If `rough` is set, only the coarsest grid is used, which takes a tenth of the time. The members of each body
 * have to be united into one shape before. */
sunder_status sunder_i_areas_places(const sunder_i_model *model, const uint32_t *body, size_t n, bool rough,
                                    double *move, bool *found, sunder_error *err);

#endif
