/* Numbers of this room that are not error bounds: they decide how long it takes to find the outline, never what it
 * is. */
#ifndef SUNDER_I_OUTLINE_TUNING_H
#define SUNDER_I_OUTLINE_TUNING_H

/* The version of these values; raised with each change of one, so that a record can name it (tests/house/TUNING). */
#define SUNDER_I_OUTLINE_TUNING_VERSION 1

/* ---- Cells (culling.c) ------------------------------------------------------------------------------------------- */

/* A cell with at most this many pairs of a line and a part other than its own becomes a leaf: looking at the pairs then
 * costs less than splitting. Measured on stars, combs, forks and random polygons. */
#define LEAF_PAIRS 96
#define LEAF_PAIRS_OF_TWO 6 /* the next split may isolate each of two parts with its sides */
/* Sides that nearly coincide pass, as a bundle, through both halves of a cell, and through both halves of these: every
 * split doubles the pairs and decides nothing. So a cell is left as it is where the pairs of a side and a part have
 * grown by more than this factor since the ancestor that had fewest, unless a trial shows that splitting pays. Since a
 * split at most doubles the pairs, all leaves together have at most four times the pairs of the root, whatever the
 * input. */
#define MOST_GROWTH 2
#define TRIAL_PAIRS 4096 /* below this number of pairs the cost does not matter */
/* A cell is not split on either after STUBBORN_SPLITS splits in a row in which one half keeps nine tenths of the sides,
 * plus one split for every STUBBORN_SHARE parts. Such sides may be a cluster in a corner of the cell, perhaps far
 * smaller than the cell, which is worth more splits the more parts it has; or they may be truly concurrent. */
#define STUBBORN_SPLITS 6
#define STUBBORN_SHARE 8
#define KEPT(sides, of) (10 * (sides) >= 9 * (of))
/* A half with more sides than this, but less than nine tenths of its cell's, is halved as it is: shrinking it to its
 * candidates would mean looking at each of them. */
#define MANY_SIDES 250
/* Candidates count as equally long along both axes, in proportion to the cell, where the ratio is at most this. */
#define AXES_EVEN 1.3
/* At most this many parts with one side in the cell are tried in pairs; more are rare. */
#define SINGLES 8 /* fixed: the size of an array */
/* The table of recently pushed pairs: 64 KB, which fits the second-level cache; a larger one finds hardly more
 * repeats. */
#define RECENT_BITS_MOST 13
#define RECENT_BITS_LEAST 6

/* ---- Runs of sides (culling_root.c) ------------------------------------------------------------------------------ */

#define LONGEST_RUN 32 /* the longer a run, the less often its box is apart from a cell */
#define FEW_SIDES 16   /* parts with fewer are listed side by side */

/* ---- Pairs (culling_close.c) ------------------------------------------------------------------------------------- */

/* Cost of pushing a pair, sorting it and reading it for its line, in units of one side in a split. */
#define PAIR_COST 4

/* ---- Contained sides and parts ----------------------------------------------------------------------------------- */

/* At most this many parts are tried for one side; those at the front of a square's list hold most sides. */
#define LOOKS 1024
/* A side that is dropped saves some thousand instructions, about the cost of this many looks. */
#define LOOKS_SAVED 64
/* Initial credit: SIDES_ON_TRUST sides at LOOKS looks each, and LOOKS_ON_TRUST looks for each part. */
#define SIDES_ON_TRUST 4
#define LOOKS_ON_TRUST 4
/* Initial credit of looks for each part, to find a part that holds it, including the parts listed at its corners. A
 * part that is dropped earns PART_LOOKS_SAVED looks for each of its corners: half of what a corner costs in the
 * cells. */
#define PART_LOOKS_ON_TRUST 16
#define PART_LOOKS_SAVED 256
/* The squares' lists may hold at most this many entries for each part; beyond that they take too much memory. */
#define MOST_ENTRIES 64.0
/* At most this many squares for each part. */
#define MOST_SQUARES 4.0

/* ---- The table of vertices --------------------------------------------------------------------------------------- */

/* A run of this many taken slots does not come about by chance: in a table of n places, half full, the longest run is
 * about 5 ln n long. */
#define CROWD 128

#endif
