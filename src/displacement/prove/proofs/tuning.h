/* Numbers of this room that are no error bounds: they decide which proofs are found, and in which time, never
 * whether one is right. (Those are derived in half_planes.c and program.c.) */
#ifndef SUNDER_I_PROOFS_TUNING_H
#define SUNDER_I_PROOFS_TUNING_H

/* ---- A node's program (program.c) -------------------------------------------------------------------------------- */

/* It is solved to this part of a hair, with tangents so often. */
#define SOLVED_TO 4
#define ROUNDS 48
/* A tangent is the same as another up to this cosine: there is less than a hair between them. Who is so far on the way
 * to the limit has one from the start. */
#define SAME_TANGENT (1 - 0x1p-40)
#define AT_LIMIT 0.999

/* ---- The branches (branches.c, violations.c) --------------------------------------------------------------------- */

/* Only violations of at least this share of the deepest are weighed: shallow ones tell little. */
#define DEEP 0.5
/* What a look at two bodies' pieces costs, in constraints looked at. */
#define LOOK_WORK 16
/* Sides of the polygon that stands for the disc of limits where what they leave is measured, and the most corners that
 * cuts of it may make: what would make more is left out, and only a guess is worse for it. */
#define DISC_SIDES 16
#define MOST_CORNERS 96

/* ---- Chains (chain.c, chain_links.c) ----------------------------------------------------------------------------- */

/* Lines may be short by so much of how far two may go, which is lost at each link; else walls that are straight but for
 * little had a way for each part of them. */
#define CHAIN_COARSE 0x1p-14
/* Ways that miss by less than this share are open; and what a chain has to win, as a share of what its pair misses: far
 * more than is added for rounding to a sum of a thousand forces. */
#define CHAIN_HAIR 0x1p-36
#define CHAIN_MARGIN 0x1p-20
/* So much less than the chord of all that is open is told, as a share of reach; and half the arc, as an angle, of which
 * one is: that of more tells little. */
#define CHAIN_CHORD 0x1p-30
#define CHAIN_WIDEST 2.1
/* What it costs to look about a body, in links looked at; the most for one conflict, and links of one chain. */
#define CHAIN_LOOK 16
#define CHAIN_EFFORT 400000u
#define CHAIN_MOST 1024

/* Where all is owed (chain_fewest.c): the most links besides the pair's, and of so many links the best few that are
 * gone on with. */
#define FEWEST_MOST 32
#define FEWEST_KEPT 8
/* Links of a straight chain are along the pair's line up to this cosine: who does not follow on one is beside
 * nobody. */
#define CHAIN_STRAIGHT 0.9

/* ---- Ways that are kept (half_planes_kept.c) --------------------------------------------------------------------- */

/* Of two to the power of this many pairs of pieces: a question of a dozen houses between roads meets some hundred. */
#define WAYS_KEPT_BITS 10

/* ---- Corners that two sides share (corner_chord.c) --------------------------------------------------------------- */

/* A chord cuts off so much of the sides, and passes beyond the corner by so much of the way to it: far more than the
 * cracks between their shadows are wide, and rounding, and less than anything that matters. */
#define CHORD 0x1p-16
#define BEYOND 0x1p-24
/* How far from the way through the corner, as a share of it, a move may be that a chord is looked for. */
#define BESIDE 0x1p-20
/* So many sides with an end there are looked at. */
#define SPOKES 32

/* ---- Between two lines (corridor.c) ------------------------------------------------------------------------------ */

/* Parts of more corners are passed by. */
#define WALL_CORNERS 64
/* No other edge turns by less from one that is taken for a line. */
#define NEARLY_PARALLEL 0x1p-14

/* ---- One relative move (plane.c) --------------------------------------------------------------------------------- */

/* Sides of the polygon around the limits, and the most corners of a region. */
#define PLANE_SIDES 24
#define PLANE_CORNERS 48
/* It ends after so much: some ten milliseconds. Finding what holds a place counts as so much, and as this part of a
 * constraint for each obstacle. */
#define PLANE_EFFORT 4000000u
#define PLACE_LOOK 64
#define BOXES_A_STEP 8
/* What was chosen before helps where no more than one in so many is forbidden that was not. */
#define PLANE_FRESH 8
/* Of the tree of boxes over all that is forbidden: how many stand in a leaf; and one in so many, and so many, may stand
 * in no order, before it is made again. A question that heeds so few, or less than one in so many, looks at each of
 * them. */
#define PLANE_LEAF 4
#define PLANE_LATE 8
#define PLANE_FEW 512
#define PLANE_PART 4
/* Boxes about what is forbidden are wider by this share of the limits: far above rounding. */
#define BOX_MARGIN 0x1p-40
/* How wide the seam between two claims is taken to be, as a share of the limits, and half of that each time that one is
 * found in another: wider than rounding, narrower than what covers it. So often. */
#define SLIVER 0x1p-24
#define MOST_SLIVERS 4

#endif
