/* How much the search by squares tries before it does something else. None of this bounds an error, and none of it
 * decides an answer: it balances one way to the answer against another. Where nothing else is said a number was chosen
 * by trial, on coasts, stairs, stars and round outlines of 2,000 to 16,000 vertices (tests/bench/hard.sh). */
#ifndef SUNDER_I_SQUARES_TUNING_H
#define SUNDER_I_SQUARES_TUNING_H

/* The version of these values; raised with each change of one, so that a record can name it (tests/house/TUNING). */
#define SUNDER_I_SQUARES_TUNING_VERSION 1

/* ---- Is it worth while? ---- */

/* Below this many pairs of whole pieces nothing is cut up: listing all pairs is cheap then. The callers decide from how
 * many pairs of parts on squares pay (penetration/search.c, gap/least_with_gap.c). */
#define SUNDER_I_SQUARES_WHOLE 64

/* ---- A square (squares.c) ---- */

/* A square that at most FEW_PAIRS pairs of pieces come near is searched as it is: about what can be listed and tested
 * at the cost of halving it further. Past a depth of PATIENT halvings the limit doubles with each, since that many
 * pairs may truly meet in one point, where halving does not help. */
#define FEW_PAIRS 32
#define PATIENT 8
/* Sums tried to cover a square; past COVER_PATIENT halvings the number doubles with each, up to COVER_MOST doublings,
 * since one sum may cover the square among thousands that nearly do, as with two stars. */
#define COVER_TRIES 16
#define COVER_PATIENT 5
#define COVER_MOST 18
/* Sums tried to cover the origin, once; success ends the search for two sets that are apart. */
#define ORIGIN_TRIES 1024
/* At this depth a square is far smaller than the resolution of floats (inner_convex.h); and the number of tries still
 * fits its type. */
#define DEEPEST_SQUARE 28
/* At most this many squares are looked at: MOST_SQUARES, plus MOST_EACH for each piece, plus one for every MOST_PAIRS
 * pairs of pieces. Each takes some microseconds, and the alternative looks at all pairs of pieces. */
#define MOST_SQUARES 20000
#define MOST_EACH 8
#define MOST_PAIRS 32

/* ---- What covers a square (covering.c) ---- */

/* Pairs of boxes tried to cover one square; a square that these do not cover is better covered in quarters. */
#define MOST_BOX_PAIRS 1000
/* Nodes are ranked by how deep the square is in the sum of their chiefs, plus this share of how deep it can be in any
 * of their sums by their extents. The pair that nearly covered an ancestor of the square, LEVELS_UP levels up, is tried
 * along with the roots. Measured on stars; neither number matters much. */
#define EXTENTS_COUNT 0.25f
#define LEVELS_UP 2

/* ---- Boxes inside an operand (quadtree.c, inner_convex.c) ---- */

/* The quadtree is no deeper than this; a box there has 2^-14 of the operand's width and holds little. */
#define DEEPEST_BOX 14 /* fixed: the size of an array */
/* The quadtree is no deeper than the depth at which the boundary passes through more than this many boxes for each
 * edge: edges that are long in proportion to the operand, as of a star, pass through nearly all boxes. */
#define BOXES_EACH 16
/* The largest boxes inside are kept: this many, plus a quarter of the number of pieces. Small boxes hold little beside
 * the pieces around them. */
#define BOXES_LEAST 64
/* Where in a box the test "is it inside the operand?" is made: off its middle and its diagonals, through which sides of
 * pieces often pass, at about sqrt(2) - 1 and 2 - sqrt(3) of its width and height. Any place would be right. */
#define ASK_X 0.4142
#define ASK_Y 0.2679

#endif
