/* These constants decide how long it takes to find the outline, and never what the outline is. None of them is an error
 * bound. */
#ifndef SUNDER_I_OUTLINE_TUNING_H
#define SUNDER_I_OUTLINE_TUNING_H

/* SUNDER_I_OUTLINE_TUNING_VERSION is the version of the values below. It is raised with each change of a value, so that
 * a record can name the values by their version (tests/house/TUNING). */
#define SUNDER_I_OUTLINE_TUNING_VERSION 1

/* ---- Cells (culling.c) ------------------------------------------------------------------------------------------- */

/* A cell becomes a leaf if it has at most LEAF_PAIRS pairs of a side's line and a part to which the side does not
 * belong: looking at the pairs then costs less than splitting the cell. The value was measured on stars, combs, forks
 * and random polygons. LEAF_PAIRS_OF_TWO is the limit for a cell with only two parts, since the next split may isolate
 * each of the two with its sides. */
#define LEAF_PAIRS 96
#define LEAF_PAIRS_OF_TWO 6
/* Sides that nearly coincide pass through both halves of a cell as a bundle, and through both halves of each half:
 * every split then doubles the pairs and decides nothing. A cell is therefore not split if its pairs of a side and a
 * part have grown by more than the factor MOST_GROWTH since the ancestor with the fewest pairs, unless a trial shows
 * that splitting pays. A split at most doubles the pairs, so all leaves together have at most four times the pairs of
 * the root, whatever the input. A trial is made only in a cell with at least TRIAL_PAIRS pairs; with fewer pairs the
 * cost does not matter. */
#define MOST_GROWTH 2
#define TRIAL_PAIRS 4096
/* A split is stubborn if a half keeps nine tenths of the sides, as KEPT tests. A cell is not split further after
 * STUBBORN_SPLITS stubborn splits in a row, plus one for every STUBBORN_SHARE parts. The sides may be a cluster in a
 * corner of the cell, perhaps far smaller than the cell; finding it is worth more splits the more parts the cell has.
 * Or the sides may be truly concurrent, and then no split helps. */
#define STUBBORN_SPLITS 6
#define STUBBORN_SHARE 8
#define KEPT(sides, of) (10 * (sides) >= 9 * (of))
/* A half with more than MANY_SIDES sides, but less than nine tenths of its cell's sides, is halved as it is: shrinking
 * it to the box of its candidates would require looking at each of them. */
#define MANY_SIDES 250
/* Candidates count as equally long along both axes, in proportion to the cell, if the ratio of their extents is at most
 * AXES_EVEN (shrink_cell()). */
#define AXES_EVEN 1.3
/* find_two() tries all pairs among the first SINGLES parts with a single side in the cell; cells with more such parts
 * are rare. */
#define SINGLES 8 /* fixed: the size of an array */
/* The table of recently pushed pairs has 2^RECENT_BITS_LEAST to 2^RECENT_BITS_MOST entries. The largest takes 64 KB,
 * which fits the second-level cache; a larger one finds hardly more repeats. */
#define RECENT_BITS_MOST 13
#define RECENT_BITS_LEAST 6

/* ---- Runs of sides (culling_root.c) ------------------------------------------------------------------------------ */

/* A run has at most LONGEST_RUN sides: the longer a run, the less often its box is apart from a cell. The sides of a
 * part with fewer than FEW_SIDES sides are listed one by one. */
#define LONGEST_RUN 32
#define FEW_SIDES 16

/* ---- Pairs (culling_close.c) ------------------------------------------------------------------------------------- */

/* PAIR_COST is the cost of pushing a pair, sorting it, and reading it for its line, in units of one side in a split
 * (sunder_i_cells_end_trial()). */
#define PAIR_COST 4

/* ---- Contained sides and parts (contained_parts.c, contained_grid.c) --------------------------------------------- */

/* find_holder() tries at most LOOKS parts for one side; those at the front of a square's list contain most sides.
 * Dropping a side saves some thousand instructions, about the cost of LOOKS_SAVED looks, and earns that credit. */
#define LOOKS 1024
#define LOOKS_SAVED 64
/* The initial credit for dropping sides is SIDES_ON_TRUST sides at LOOKS looks each, plus LOOKS_ON_TRUST looks for each
 * part. */
#define SIDES_ON_TRUST 4
#define LOOKS_ON_TRUST 4
/* The initial credit for finding parts that contain another part is PART_LOOKS_ON_TRUST looks for each part, including
 * looks at the parts listed at its corners. A part that is dropped earns PART_LOOKS_SAVED looks for each of its
 * corners: half of what a corner costs in the cells. */
#define PART_LOOKS_ON_TRUST 16
#define PART_LOOKS_SAVED 256
/* The grid of squares (contained_grid.c) has at most MOST_SQUARES squares for each part. The grid is not made if the
 * lists of its squares would have more than MOST_ENTRIES entries for each part, since it would take too much memory. */
#define MOST_ENTRIES 64.0
#define MOST_SQUARES 4.0

/* ---- The table of vertices (vertex_table.c) ---------------------------------------------------------------------- */

/* A table is crowded if a search passes more than CROWD taken slots in a row. A run that long is not due to chance: in
 * a table of n slots, half full, the longest run is about 5 ln n slots long. */
#define CROWD 128

#endif
