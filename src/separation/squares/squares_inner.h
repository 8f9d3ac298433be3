/* What the parts of the search by squares share. */
#ifndef SUNDER_I_SQUARES_INNER_H
#define SUNDER_I_SQUARES_INNER_H

#include "separation/obstacle/cones.h"
#include "separation/squares/inner_convex.h"
#include "separation/squares/squares.h"

typedef struct sunder_i_square {
    double box[4], distance; /* of its nearest point from the origin */
    int depth;
    uint32_t place;   /* its number: 0 the whole, and four after each other the quarters of one */
    uint32_t best[2]; /* the nodes whose chiefs' sum was nearest to covering the square that this is a quarter of */
} sunder_i_square;

/* The pair that covered the last square is remembered for each field of a grid with this many fields a side: neighbours
 * are often covered by the same two convex sets, and the grid fits the cache. */
#define SUNDER_I_SQUARES_MEMORY 64

/* Nodes of the two trees of convex sets, and how deep the square is in the sum of their chiefs. */
typedef struct sunder_i_node_pair {
    float key, in;
    uint32_t node[2];
} sunder_i_node_pair;

struct sunder_i_squares {
    sunder_i_operands *g;
    sunder_i_quadtree quadtree[2];
    sunder_i_inner_convex inner[2];
    uint32_t *first_piece[2]; /* [vertices] the first piece that each is a corner of */
    sunder_i_cone *corner[2]; /* [vertices] once it is known */
    uint8_t *state[2];        /* [vertices] UNKNOWN, ... */
    sunder_i_square *heap;
    size_t n, capacity, seen, most;
    uint32_t cuts;
    double gap; /* subsums are grown by a disc of this radius; 0: they are not */
    /* of the square at hand */
    sunder_i_dop dop;
    sunder_i_square_query query;
    const double *at;     /* its box, less what any sum grows by */
    uint32_t covering[2]; /* the convex sets whose sum covers it, if it is covered by one */
    uint32_t (*pair)[2];  /* pieces of P and of Q whose subsums come near it */
    size_t pairs, pairs_capacity;
    uint32_t tries;   /* for the search for what may cover it */
    bool covered;     /* by the subsum that was looked at last */
    uint32_t best[2]; /* the nodes whose chiefs' sum is nearest to covering it, of those tried */
    float best_depth;
    sunder_i_node_pair *node; /* a heap, the most promising on top */
    size_t nodes, nodes_capacity;
    uint32_t memory[SUNDER_I_SQUARES_MEMORY * SUNDER_I_SQUARES_MEMORY][2]; /* by field: what covered the last one */
    float reach;                                                           /* of the memory */
};

/* A square and a subsum: one of its sides has it outside for certain, or all have it inside. */
typedef enum sunder_i_square_position {
    SUNDER_I_POSITION_OUTSIDE,
    SUNDER_I_POSITION_ACROSS,
    SUNDER_I_POSITION_WITHIN
} sunder_i_square_position;

sunder_i_square_position sunder_i_squares_position(const sunder_i_squares *squares, const double square[4], uint32_t i,
                                                   uint32_t j);

/* Takes a square for the one at hand: sets the query, and `at` to `less`, the square less what sums grow by. */
void sunder_i_squares_query(sunder_i_squares *squares, const double square[4], double less[4]);

/* Does the sum of a box inside P and one inside -Q cover the square? */
bool sunder_i_squares_boxes_cover(sunder_i_squares *squares, const double square[4]);

typedef enum sunder_i_covering {
    SUNDER_I_COVERING_FOUND,
    SUNDER_I_COVERING_NONE,
    SUNDER_I_COVERING_UNDECIDED,
    SUNDER_I_COVERING_NO_MEMORY /* memory is out */
} sunder_i_covering;

/* Does the sum of two convex sets? Those of the pair of nodes `first` are asked first. UNDECIDED: after as many tries,
 * as are given, many are left. */
sunder_i_covering sunder_i_squares_one_covers(sunder_i_squares *squares, const double square[4],
                                              const uint32_t first[2], uint32_t tries);

/* Lists the pairs near the square; false if there are more than `most`, or if one of them covers it (squares->covered),
 * or if memory is out. */
bool sunder_i_squares_gather(sunder_i_squares *squares, const double square[4], size_t most);

typedef enum sunder_i_square_state {
    SUNDER_I_SQUARE_CLOSED, /* covered, or free: nothing comes near it (no pairs, and it is not covered) */
    SUNDER_I_SQUARE_OPEN,
    SUNDER_I_SQUARE_IN_PARTS,
    SUNDER_I_SQUARE_NO_MEMORY
} sunder_i_square_state;

/* What is to be done with a square; if it is open its pairs are listed. */
sunder_i_square_state sunder_i_squares_look(sunder_i_squares *squares, const sunder_i_square *square);
/* The nearest square, taken out; there must be one. */
sunder_i_square sunder_i_squares_first(sunder_i_squares *squares);
/* Puts in the quarters of a square that was just looked at. False if memory is out. */
bool sunder_i_squares_cut(sunder_i_squares *squares, const sunder_i_square *square);
/* Too many squares, or too small ones: this leads nowhere. */
bool sunder_i_squares_too_many(const sunder_i_squares *squares, const sunder_i_square *square);

/* The operands' subsums become the pairs listed. False if memory is out. */
bool sunder_i_squares_take_subsums(sunder_i_squares *squares);
/* The candidates of the pairs listed that come near the square. */
bool sunder_i_squares_take_candidates(sunder_i_squares *squares, const double square[4], double limit,
                                      sunder_i_candidates *out);

#endif
