/* These constants decide which proofs are found and how long that takes, and never whether a proof is right. None of
 * them is an error bound; error bounds are derived in half_planes.c and program.c. */
#ifndef SUNDER_I_PROOFS_TUNING_H
#define SUNDER_I_PROOFS_TUNING_H

/* SUNDER_I_PROOFS_TUNING_VERSION is the version of the values below. It is raised with each change of a value, so that
 * a record can name the values by their version (tests/house/TUNING). */
#define SUNDER_I_PROOFS_TUNING_VERSION 4

/* ---- A node's program (program.c) -------------------------------------------------------------------------------- */

/* The program of a node is solved to the tolerance hair / SOLVED_TO, with at most ROUNDS rounds of added tangents
 * (solve_program()). */
#define SOLVED_TO 4
#define ROUNDS 48
/* Two tangents of a body count as one if the cosine of the angle between them is greater than SAME_TANGENT: they differ
 * by less than a hair. A body that has moved more than the share AT_LIMIT of its limit has a tangent from the start. */
#define SAME_TANGENT (1 - 0x1p-40)
#define AT_LIMIT 0.999

/* ---- Branches (branches.c, violations.c) ------------------------------------------------------------------------- */

/* choose_violation() considers only violations of at least the share DEEP of the deepest one: shallow violations tell
 * little. */
#define DEEP 0.5
/* LOOK_WORK is the cost of looking at the pieces of two bodies, in constraints looked at. */
#define LOOK_WORK 16
/* room_of() approximates the disc of the moves that the limits allow by a polygon of DISC_SIDES sides. Cuts of the
 * polygon may give it at most MOST_CORNERS corners; further cuts are skipped, which only makes an estimate worse. */
#define DISC_SIDES 16
#define MOST_CORNERS 96 /* fixed: the size of an array */

/* ---- Chains (chain.c, chain_links.c) ----------------------------------------------------------------------------- */

/* In chains a line may be short of the exact one by the share CHAIN_COARSE of how far the two bodies may move, and each
 * link loses that much. Without this tolerance, walls that are nearly straight would have one half-plane for each of
 * their parts. */
#define CHAIN_COARSE 0x1p-14
/* A half-plane counts as open if it is out of reach by at most the share CHAIN_HAIR. A chain has to gain more than the
 * share CHAIN_MARGIN of what its pair misses; this is far more than rounding can add to a sum of a thousand forces. */
#define CHAIN_HAIR 0x1p-36
#define CHAIN_MARGIN 0x1p-20
/* make_chord() replaces the open half-planes by one whose line lies the share CHAIN_CHORD of the reach inside the chord
 * of all their arcs. It does so if half the arc is at most CHAIN_WIDEST (radians), since for a larger arc the common
 * half-plane says little. */
#define CHAIN_CHORD 0x1p-30
#define CHAIN_WIDEST 2.1
/* CHAIN_LOOK is the cost of looking at the surroundings of a body, in links looked at. The search for one end of a
 * chain takes at most CHAIN_EFFORT links looked at, and a chain has at most CHAIN_MOST links. */
#define CHAIN_LOOK 16
#define CHAIN_EFFORT 400000u
#define CHAIN_MOST 1024

/* In the search for a shortest chain, in which every pair has to keep its full distance, listed or not
 * (chain_fewest.c), a chain has at most FEWEST_MOST links besides that of the pair. For each end of the pair and
 * each number of links, the FEWEST_KEPT best chains are extended. */
#define FEWEST_MOST 32 /* fixed: the size of an array */
#define FEWEST_KEPT 8  /* fixed: the size of an array */
/* A chain is straight if the cosine of the angle between each link's normal and the pair's exceeds CHAIN_STRAIGHT
 * (is_straight()). */
#define CHAIN_STRAIGHT 0.9

/* ---- Cached half-planes (half_planes_kept.c) --------------------------------------------------------------------- */

/* The cache begins with 2^WAYS_KEPT_BITS slots, each for the half-planes of one pair of pieces, and doubles up to
 * 2^WAYS_MOST_BITS: a question about a dozen houses between roads meets some hundred pairs, the questions about one
 * conflict in a large city ten thousand. */
#define WAYS_KEPT_BITS 8
#define WAYS_MOST_BITS 15

/* ---- Corners that two sides share (corner_chord.c) --------------------------------------------------------------- */

/* For one move of an anchor, at most SPOKES sides of barriers with an end near its path (BESIDE) are compared to
 * find a corner that two of them share. */
#define SPOKES 32 /* fixed: the size of an array */

/* ---- Between two lines (corridor.c) ------------------------------------------------------------------------------ */

/* Parts with more than WALL_CORNERS corners are skipped. */
#define WALL_CORNERS 64 /* fixed: the size of an array */
/* An edge is taken for a line only if the sine of the angle between it and each edge that is not exactly parallel is at
 * least NEARLY_PARALLEL. */
#define NEARLY_PARALLEL 0x1p-14

/* ---- One relative move (plane.c, plane_region.c, plane_choose.c, plane_choices.c, plane_index.c) ----------------- */

/* The polygon around the disc of limits has PLANE_SIDES sides, and a region has at most PLANE_CORNERS corners. */
#define PLANE_SIDES 24
#define PLANE_CORNERS 48 /* fixed: the size of an array */
/* The search ends after PLANE_EFFORT constraints looked at, which takes some ten milliseconds. Finding the obstacles
 * that cover a place counts as PLACE_LOOK of these, plus one for every BOXES_A_STEP obstacles. */
#define PLANE_EFFORT 4000000u
#define PLACE_LOOK 64
#define BOXES_A_STEP 8
/* The choices of an earlier proof are used if at most one in PLANE_FRESH obstacles was not known then. */
#define PLANE_FRESH 8
/* The tree of boxes over all obstacles has PLANE_LEAF items in a leaf. It is rebuilt if more than PLANE_FEW items, plus
 * one for every PLANE_LATE in the tree, were added since it was built. A question with at most PLANE_FEW obstacles, or
 * with fewer than one in PLANE_PART of all, tests each obstacle and does not use the tree. */
#define PLANE_LEAF 4
#define PLANE_LATE 8
#define PLANE_FEW 512
#define PLANE_PART 4
/* The box of what an obstacle forbids is enlarged by the share BOX_MARGIN of the limits, far above rounding. */
#define BOX_MARGIN 0x1p-40
/* keep_side() assumes that the seam between two claims is wide by the share SLIVER of the limits, which is more than
 * rounding and less than the size of the piece that covers the seam. The width is halved each time a seam is found
 * inside another, and at most MOST_SLIVERS seams are widened. */
#define SLIVER 0x1p-24
#define MOST_SLIVERS 4
/* With exact lines a shadow counts as larger by the share SHADOW_BORDER of the limits, so that its border covers a seam
 * that is widened to either side. */
#define SHADOW_BORDER (2 * SLIVER)

#endif
