/* How much the search by squares tries before it does something else. None of this bounds an error, and none of it
 * decides an answer: it balances one way to the answer against another. Where nothing else is said a number was chosen
 * by trial, on coasts, stairs, stars and round outlines of 2,000 to 16,000 vertices (tests/bench/hard.sh). */
#ifndef SUNDER_I_SQUARES_TUNING_H
#define SUNDER_I_SQUARES_TUNING_H

/* ---- Is it worth while? ---- */

/* Below so many pairs of whole pieces nothing is cut up: to list all pairs costs nothing then. Of how many pairs of
 * parts it is worth while who asks says (penetration/search.c, gap/least_with_gap.c). */
#define SUNDER_I_SQUARES_WHOLE 64

/* ---- A square (squares.c) ---- */

/* A square that so few pairs of pieces come near is searched as it is: about what can be listed and asked at the cost
 * of cutting it up further. Past a depth of PATIENT halvings it is twice as many for each, for as many may truly meet
 * in one point, and then no cutting helps. */
#define FEW_PAIRS 32
#define PATIENT 8
/* So many sums are tried to cover a square; past COVER_PATIENT halvings twice as many for each, up to COVER_MOST
 * doublings, for there may be one that does among thousands that nearly do, as of two stars. */
#define COVER_TRIES 16
#define COVER_PATIENT 5
#define COVER_MOST 18
/* And to cover the origin, which is asked once and ends the search for two sets that are apart. */
#define ORIGIN_TRIES 1024
/* By then a square is far smaller than what floats tell apart (inner_convex.h); and the tries can still be numbered. */
#define DEEPEST_SQUARE 28
/* So many squares, so many for each piece, and one for so many pairs of pieces are looked at: each is worth some
 * microseconds, and what else could be done takes all pairs of pieces. */
#define MOST_SQUARES 20000
#define MOST_EACH 8
#define MOST_PAIRS 32

/* ---- What covers a square (covering.c) ---- */

/* Pairs of boxes that are looked at to cover one square; what so many do not cover is sooner covered in parts. */
#define MOST_BOX_PAIRS 1000
/* Nodes are taken by how deep the square is in the sum of their chiefs, and by this much of how deep it can be in any
 * by their extents. Those about the pair that covered nearly the square that this is a quarter of, so many levels up,
 * come along with the roots. By measurement on stars; nothing of it matters much. */
#define EXTENTS_COUNT 0.25f
#define LEVELS_UP 2

/* ---- Boxes inside an operand (quadtree.c, inner_convex.c) ---- */

/* The quadtree is no deeper than this, where a box has 2^-14 of the operand's width and holds little; */
#define DEEPEST_BOX 14
/* and not so deep that boundary passes through more boxes than so many for each edge: many edges that are long beside
 * the operand, as of a star, pass through nearly all. */
#define BOXES_EACH 16
/* Of the boxes inside so many are asked, the largest, and as many as a quarter of the pieces besides: small
 * boxes hold little beside the pieces about them. */
#define BOXES_LEAST 64
/* Where in a box it is asked whether an operand has it: off its middle and its diagonals, through which sides of pieces
 * often pass, at about sqrt(2) - 1 and 2 - sqrt(3) of its width and height. Any place would be right. */
#define ASK_X 0.4142
#define ASK_Y 0.2679

#endif
