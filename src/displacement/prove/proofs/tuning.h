/* Numbers of this room that are no error bounds: they decide which proofs are found, and in which time, never
 * whether one is right. (Those are derived in half_planes.c and program.c.) */
#ifndef SUNDER_I_PROOFS_TUNING_H
#define SUNDER_I_PROOFS_TUNING_H

/* The version of these values; raised with each change of one, so that a record can name it (tests/house/TUNING). */
#define SUNDER_I_PROOFS_TUNING_VERSION 1

/* ---- A node's program (program.c) -------------------------------------------------------------------------------- */

/* The program is solved to this part of a hair, with at most this many rounds of tangents. */
#define SOLVED_TO 4
#define ROUNDS 48
/* Two tangents count as one up to this cosine: they differ by less than a hair. A body this close to its limit has a
 * tangent from the start. */
#define SAME_TANGENT (1 - 0x1p-40)
#define AT_LIMIT 0.999

/* ---- The branches (branches.c, violations.c) --------------------------------------------------------------------- */

/* Only violations of at least this share of the deepest are weighed: shallow ones tell little. */
#define DEEP 0.5
/* What a look at two bodies' pieces costs, in constraints looked at. */
#define LOOK_WORK 16
/* Sides of the polygon that approximates the disc of limits in measurements, and the most corners that cuts of it may
 * make; further cuts are skipped, which only makes an estimate worse. */
#define DISC_SIDES 16
#define MOST_CORNERS 96 /* fixed: the size of an array */

/* ---- Chains (chain.c, chain_links.c) ----------------------------------------------------------------------------- */

/* Lines may fall short by this share of how far two bodies may move, which is lost at each link; without it, walls that
 * are nearly straight would have a way for each part of them. */
#define CHAIN_COARSE 0x1p-14
/* Ways that miss by less than this share are open; and what a chain has to win, as a share of what its pair misses: far
 * more than is added for rounding to a sum of a thousand forces. */
#define CHAIN_HAIR 0x1p-36
#define CHAIN_MARGIN 0x1p-20
/* A common line lies this much, as a share of reach, inside the chord of all open ways; and half the arc, as an angle,
 * up to which a common line is used: for larger arcs it says little. */
#define CHAIN_CHORD 0x1p-30
#define CHAIN_WIDEST 2.1
/* What it costs to look about a body, in links looked at; the most for one conflict, and links of one chain. */
#define CHAIN_LOOK 16
#define CHAIN_EFFORT 400000u
#define CHAIN_MOST 1024

/* If every pair owes its full distance (chain_fewest.c): the most links besides the pair's, and for each length the
 * number of best chains that are extended. */
#define FEWEST_MOST 32 /* fixed: the size of an array */
#define FEWEST_KEPT 8 /* fixed: the size of an array */
/* Links of a straight chain follow the pair's line up to this cosine. */
#define CHAIN_STRAIGHT 0.9

/* ---- Ways that are kept (half_planes_kept.c) --------------------------------------------------------------------- */

/* Of two to the power of this many pairs of pieces: a question of a dozen houses between roads meets some hundred. */
#define WAYS_KEPT_BITS 10

/* ---- Corners that two sides share (corner_chord.c) --------------------------------------------------------------- */

/* A chord cuts off this share of the sides, and passes beyond the corner by this share of its distance: far more than
 * rounding and the gaps between the shadows, and too little to matter. */
#define CHORD 0x1p-16
#define BEYOND 0x1p-24
/* How far from the way through the corner, as a share of it, a move may be that a chord is looked for. */
#define BESIDE 0x1p-20
/* At most this many sides with an end there are examined. */
#define SPOKES 32 /* fixed: the size of an array */

/* ---- Between two lines (corridor.c) ------------------------------------------------------------------------------ */

/* Parts of more corners are passed by. */
#define WALL_CORNERS 64 /* fixed: the size of an array */
/* No other edge turns by less from one that is taken for a line. */
#define NEARLY_PARALLEL 0x1p-14

/* ---- One relative move (plane.c) --------------------------------------------------------------------------------- */

/* Sides of the polygon around the limits, and the most corners of a region. */
#define PLANE_SIDES 24
#define PLANE_CORNERS 48 /* fixed: the size of an array */
/* The search ends after this much work: some ten milliseconds. Finding what covers a place counts as this much, plus
 * this part of a constraint for each obstacle. */
#define PLANE_EFFORT 4000000u
#define PLACE_LOOK 64
#define BOXES_A_STEP 8
/* Earlier choices help if at most one in this many obstacles is newly forbidden. */
#define PLANE_FRESH 8
/* The tree of boxes over all obstacles: items in a leaf; the share, and the number, of unsorted ones before it is
 * rebuilt; a question that considers at most this many, or less than this share, tests each of them. */
#define PLANE_LEAF 4
#define PLANE_LATE 8
#define PLANE_FEW 512
#define PLANE_PART 4
/* Boxes about what is forbidden are wider by this share of the limits: far above rounding. */
#define BOX_MARGIN 0x1p-40
/* The assumed width of the seam between two claims, as a share of the limits, halved each time that a seam is found
 * inside another: wider than rounding, narrower than what covers it. And how often it is halved. */
#define SLIVER 0x1p-24
#define MOST_SLIVERS 4

#endif
