/* Numbers of this room that are no error bounds: they decide how long the outline takes to find, never what it is. */
#ifndef SUNDER_I_OUTLINE_TUNING_H
#define SUNDER_I_OUTLINE_TUNING_H

/* ---- Cells (culling.c) ------------------------------------------------------------------------------------------- */

/* Up to so many pairs of a line and a part other than its own make a leaf: then looking at a pair costs less than
 * sorting it out. Measured on stars, combs, forks and random polygons. */
#define LEAF_PAIRS 96
#define LEAF_PAIRS_OF_TWO 6 /* the next split may leave each of two parts alone with its sides */
/* Sides that nearly coincide pass, as a bundle, through both halves of a cell, and through both halves of these: every
 * split doubles what there is to ask and none brings anything. So a cell is left as it is where the pairs of a side and
 * a part have grown by more than this since some ancestor had them, unless a trial shows that it pays to go on. As one
 * split at most doubles them, all leaves together have no more than four times the pairs of the root, whatever the
 * input. */
#define MOST_GROWTH 2
#define TRIAL_PAIRS 4096 /* what fewer cost is no matter */
/* Nor is it split on after so many splits in a row of which one half keeps nine tenths of the sides, and an eighth of
 * its parts more: that may be a cluster in a corner of the cell, which may be far below it in size and is worth the
 * way the more pairs it has; or sides that are truly concurrent. */
#define STUBBORN_SPLITS 6
#define STUBBORN_SHARE 8
#define KEPT(sides, of) (10 * (sides) >= 9 * (of))
/* A half with more sides than this, fewer than its cell had by a tenth, is halved as it is: to shrink it to what its
 * candidates need every one of them would have to be looked at. */
#define MANY_SIDES 250
/* Along both axes candidates are as long beside the cell where one is at most so many times the other. */
#define AXES_EVEN 1.3
/* So many parts with one side in the cell are tried in pairs; more are rare. */
#define SINGLES 8
/* The table of pairs pushed of late: 64 KB, which stay in the second-level cache; more hardly finds more. */
#define RECENT_BITS_MOST 13
#define RECENT_BITS_LEAST 6

/* ---- Runs of sides (culling_root.c) ------------------------------------------------------------------------------ */

#define LONGEST_RUN 32 /* the longer a run, the less often its box is apart from a cell */
#define FEW_SIDES 16   /* parts with fewer are listed side by side */

/* ---- Pairs (culling_close.c) ------------------------------------------------------------------------------------- */

/* What a pair costs that is pushed, and then sorted and read again for its line, in sides of a split. */
#define PAIR_COST 4

/* ---- Contained sides and parts ----------------------------------------------------------------------------------- */

/* Parts looked at for one side: those at the front of a square's list hold most. */
#define LOOKS 1024
/* A side that is dropped saves some thousand instructions, about what so many looks cost. */
#define LOOKS_SAVED 64
/* So much is looked for on trust, in sides that cost LOOKS, and in looks for each part. */
#define SIDES_ON_TRUST 4
#define LOOKS_ON_TRUST 4
/* So many looks for each part are taken on trust for one that it is inside of, those at its corners' squares among
 * them; and so many more for each corner of a part that is dropped: half of what a corner takes in the cells. */
#define PART_LOOKS_ON_TRUST 16
#define PART_LOOKS_SAVED 256
/* The lists of a square have so many entries for each part, or they are not worth their room. */
#define MOST_ENTRIES 64.0
/* And there are no more squares than this for each part. */
#define MOST_SQUARES 4.0

/* ---- The table of vertices --------------------------------------------------------------------------------------- */

/* So many taken slots in a row do not come about by chance: in a table of n places, half full, the longest row is about
 * 5 ln n long. */
#define CROWD 128

#endif
