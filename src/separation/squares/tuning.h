/* These constants limit how much the search by squares tries before it does something else. None of them is an error
 * bound, and none decides an answer: each balances one way to the answer against another. Unless its comment says
 * otherwise, a value was chosen by trial on coasts, stairs, stars and round outlines of 2,000 to 16,000 vertices
 * (tests/bench/hard.sh). */
#ifndef SUNDER_I_SQUARES_TUNING_H
#define SUNDER_I_SQUARES_TUNING_H

/* SUNDER_I_SQUARES_TUNING_VERSION is the version of the values below. It is raised with each change of a value, so that
 * a record can name the values by their version (tests/house/TUNING). */
#define SUNDER_I_SQUARES_TUNING_VERSION 1

/* ---- When squares pay (squares.c) -------------------------------------------------------------------------------- */

/* Operands with fewer than SUNDER_I_SQUARES_WHOLE pairs of whole pieces are not cut up, since listing all pairs is
 * cheap then. The callers decide from how many pairs of parts on squares pay (penetration/penetration_search.c,
 * gap/least_with_gap.c). */
#define SUNDER_I_SQUARES_WHOLE 64

/* ---- A square (squares.c) ---------------------------------------------------------------------------------------- */

/* A square is searched as it is if at most FEW_PAIRS pairs of pieces come near it: listing and testing them costs about
 * as much as halving it further. Past a depth of PATIENT halvings the limit doubles with each halving, since all these
 * pairs may truly meet in one point, where halving does not help. */
#define FEW_PAIRS 32
#define PATIENT 8
/* At most COVER_TRIES sums are tried to cover a square. Past a depth of COVER_PATIENT halvings the limit doubles with
 * each halving, up to COVER_MOST doublings, since one sum may cover the square among thousands that nearly do, as with
 * two stars. */
#define COVER_TRIES 16
#define COVER_PATIENT 5
#define COVER_MOST 18
/* At most ORIGIN_TRIES sums are tried to cover the origin, once (sunder_i_squares_take_origin()). Success ends the
 * search for two sets that are apart. */
#define ORIGIN_TRIES 1024
/* The search gives up at a square deeper than DEEPEST_SQUARE halvings: such a square is far smaller than the resolution
 * of floats (inner_convex.h). At this depth the number of tries still fits its type. */
#define DEEPEST_SQUARE 28
/* The search looks at no more than MOST_SQUARES squares, plus MOST_EACH for each piece, plus one for every MOST_PAIRS
 * pairs of pieces. Each square takes some microseconds, and the alternative looks at all pairs of pieces. */
#define MOST_SQUARES 20000
#define MOST_EACH 8
#define MOST_PAIRS 32

/* ---- What covers a square (covering.c) --------------------------------------------------------------------------- */

/* At most MOST_BOX_PAIRS pairs of boxes are tried to cover one square; a square that these do not cover is better
 * covered in quarters. */
#define MOST_BOX_PAIRS 1000
/* A pair of nodes is ranked by how deep the square lies in the sum of their chiefs, plus the share EXTENTS_COUNT of how
 * deep it can lie in the sum of their extents. The function search_nodes() starts at the roots and at the pair of nodes
 * LEVELS_UP levels above the pair that nearly covered an enclosing square. Both were measured on stars; neither value
 * matters much. */
#define EXTENTS_COUNT 0.25f
#define LEVELS_UP 2

/* ---- Boxes inside an operand (quadtree.c, inner_convex.c) -------------------------------------------------------- */

/* The quadtree has at most DEEPEST_BOX levels; a box at the last has 2^-14 of the operand's width and contains
 * little. */
#define DEEPEST_BOX 14 /* fixed: the size of an array */
/* The quadtree ends at the depth at which the boundary passes through more than BOXES_EACH boxes for each edge: edges
 * that are long in proportion to the operand, such as those of a star, pass through nearly all boxes. */
#define BOXES_EACH 16
/* The largest boxes inside an operand are kept: BOXES_LEAST boxes, plus one for every four pieces. Small boxes contain
 * little beside the pieces around them. */
#define BOXES_LEAST 64
/* Whether a box is inside the operand is tested at a point in the box: the shares ASK_X of its width and ASK_Y of its
 * height from its lower left corner. These are about sqrt(2) - 1 and 2 - sqrt(3), so that the point lies off the middle
 * and the diagonals, through which sides of pieces often pass. Any point in the box would be correct. */
#define ASK_X 0.4142
#define ASK_Y 0.2679

#endif
