/* squares_inner.h: declarations shared by the files of the search by squares. */
#ifndef SUNDER_I_SQUARES_INNER_H
#define SUNDER_I_SQUARES_INNER_H

#include "separation/obstacle/cones.h"
#include "separation/squares/inner_convex.h"
#include "separation/squares/squares.h"

typedef struct sunder_i_square {
    double box[4], distance; /* the distance of its nearest point from the origin */
    int depth;
    uint32_t place;   /* its number: 0 is the root; the quarters of a square have consecutive numbers */
    uint32_t best[2]; /* the nodes of the pair that came nearest to covering the parent square */
} sunder_i_square;

/* The pair that covered the previous square is stored for each field of a grid of this size: neighbouring squares are
 * often covered by the same two convex sets, and the grid fits the cache. */
#define SUNDER_I_SQUARES_MEMORY 64

/* A pair of nodes of the two trees of convex sets; `in` is the depth of the square in the sum of their chiefs. */
typedef struct sunder_i_node_pair {
    float key, in;
    uint32_t node[2];
} sunder_i_node_pair;

struct sunder_i_squares {
    sunder_i_operands *g;
    sunder_i_quadtree quadtree[2];
    sunder_i_inner_convex inner[2];
    uint32_t *first_piece[2]; /* [vertices] the first piece of each vertex */
    sunder_i_cone *corner[2]; /* [vertices] the cone, if state is CORNER */
    uint8_t *state[2];        /* [vertices] UNKNOWN, NO_CORNER or CORNER */
    sunder_i_square *heap;
    size_t n, capacity, seen, most;
    uint32_t cuts;
    double gap; /* subsums are grown by a disc of this radius; 0: without a gap */
    /* the members below refer to the current square */
    sunder_i_dop dop;
    sunder_i_square_query query;
    const double *at;     /* its box, shrunk by what every sum is grown by */
    uint32_t covering[2]; /* the two convex sets whose sum covers it, if `covered` */
    uint32_t (*pair)[2];  /* [pairs] the pieces of P and of Q whose subsums are near it */
    size_t pairs, pairs_capacity;
    uint32_t tries;   /* the number of sums that may still be tried to cover it */
    bool covered;     /* whether the sum of two sets was found to cover it */
    uint32_t best[2]; /* the nodes whose chiefs' sum, of those tried, came nearest to covering it */
    float best_depth;
    sunder_i_node_pair *node; /* a heap, the most promising pair of nodes on top */
    size_t nodes, nodes_capacity;
    /* for each field: the pair that covered the previous square */
    uint32_t memory[SUNDER_I_SQUARES_MEMORY * SUNDER_I_SQUARES_MEMORY][2];
    float reach; /* the extent of the grid of `memory` */
};

/* Returns the position of a square relative to a subsum: certainly outside of one of its sides, certainly inside of all
 * of them, or else ACROSS. */
typedef enum sunder_i_square_position {
    SUNDER_I_POSITION_OUTSIDE,
    SUNDER_I_POSITION_ACROSS,
    SUNDER_I_POSITION_WITHIN
} sunder_i_square_position;

sunder_i_square_position sunder_i_squares_position(const sunder_i_squares *squares, const double square[4], uint32_t i,
                                                   uint32_t j);

/* Makes `square` the current one: sets the query, and `at` to `less`, the square shrunk by what sums are grown by. */
void sunder_i_squares_query(sunder_i_squares *squares, const double square[4], double less[4]);

/* Returns whether the sum of a box inside P and one inside -Q covers the square. */
bool sunder_i_squares_boxes_cover(sunder_i_squares *squares, const double square[4]);

typedef enum sunder_i_covering {
    SUNDER_I_COVERING_FOUND,
    SUNDER_I_COVERING_NONE,
    SUNDER_I_COVERING_UNDECIDED,
    SUNDER_I_COVERING_NO_MEMORY /* memory is out */
} sunder_i_covering;

/* Tests whether the sum of two convex sets covers the square, those of the pair of nodes `first` first. UNDECIDED:
 * after `tries` tests many pairs are left. */
sunder_i_covering sunder_i_squares_one_covers(sunder_i_squares *squares, const double square[4],
                                              const uint32_t first[2], uint32_t tries);

/* Lists the pairs near the square. Returns false if there are more than `most`, if one of them covers it
 * (squares->covered), or if out of memory. */
bool sunder_i_squares_gather(sunder_i_squares *squares, const double square[4], size_t most);

typedef enum sunder_i_square_state {
    SUNDER_I_SQUARE_CLOSED, /* covered, or free: nothing is near it (no pairs, and not covered) */
    SUNDER_I_SQUARE_OPEN,
    SUNDER_I_SQUARE_IN_PARTS,
    SUNDER_I_SQUARE_NO_MEMORY
} sunder_i_square_state;

/* Decides how a square is processed; if it is open its pairs are listed. */
sunder_i_square_state sunder_i_squares_look(sunder_i_squares *squares, const sunder_i_square *square);
/* Removes and returns the nearest square; there must be one. */
sunder_i_square sunder_i_squares_first(sunder_i_squares *squares);
/* Adds the quarters of a square that was just examined. Returns false if out of memory. */
bool sunder_i_squares_cut(sunder_i_squares *squares, const sunder_i_square *square);
/* Returns whether there were too many squares, or too small ones, so that the search must end. */
bool sunder_i_squares_too_many(const sunder_i_squares *squares, const sunder_i_square *square);

/* The operands' subsums become the listed pairs. Returns false if out of memory. */
bool sunder_i_squares_take_subsums(sunder_i_squares *squares);
/* Finds the candidates of the listed pairs near the square. Returns false if out of memory. */
bool sunder_i_squares_take_candidates(sunder_i_squares *squares, const double square[4], double limit,
                                      sunder_i_candidates *out);

#endif
