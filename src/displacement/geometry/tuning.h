/* Numbers of this room that are no error bounds: they decide how good a result is and how long it takes to find, never
 * whether what is said of it is true. */
#ifndef SUNDER_I_GEOMETRY_TUNING_H
#define SUNDER_I_GEOMETRY_TUNING_H

/* The version of these values; raised with each change of one, so that a record can name it (tests/house/TUNING). */
#define SUNDER_I_GEOMETRY_TUNING_VERSION 1

/* ---- Free places ------------------------------------------------------------------------------------------------- */

/* Round corners are cut by tangents so that normals turn by no more than this: the place proposed keeps at most 2 %
 * more than the gap. */
#define CORNER_TURN (PI / 8)
/* A gap below this share of the obstacle needs at most two tangents at a corner: a place then keeps half the gap too
 * much, which is invisible. */
#define NEXT_TO_NOTHING 1e-6
#define CORNER_TURN_AT_MOST (PI / 2 + FLAT)
/* A turn to the right by no more than this is none: rounding of normals, where two sides lie on one line. */
#define FLAT 1e-3
/* Initial capacity for walls: sufficient for most searches. */
#define FEWEST_WALLS 512
/* Crossings are looked for among at most this many sides, the nearest to the target: it bounds the work where a block
 * stands amid hundreds of neighbours. */
#define MOST_CROSSED 1500
/* Places are computed on sides: within this share of the obstacle's size of one counts as on it. Above the rounding of
 * a crossing of sides that do not nearly coincide, below any gap that is asked for. */
#define ON_A_SIDE 1e-12
/* With fewer obstacles cells do not pay. A cell is this part of the mean obstacle, and there are at most this many
 * cells for each obstacle. */
#define FEW_OBSTACLES 64
#define CELLS_ACROSS 2
#define CELLS_EACH 8
/* Walls are visited by distance, in this many shelves. */
#define SHELVES 256 /* fixed: the size of an array */
/* Cells are grown by this share, far above rounding, so that a point need not know in which of two it is. */
#define CELL_MARGIN 1e-6
/* The most places that are ever requested at once. */
#define MOST_PLACES 16 /* fixed: the size of an array */
/* Places that may be free are tested against obstacles, most of them briefly: a test counts as this part of a
 * constraint looked at, and as this part of a step of the watch. */
#define TESTS_A_STEP 2
#define TESTS_A_WATCH 16

/* ---- Support lines ----------------------------------------------------------------------------------------------- */

/* Nearer to a corner than this share of the perimeter the direction to it is noise. */
#define AT_A_CORNER 1e-9

/* ---- Those that are kept (grown_cache.c) ------------------------------------------------------------------------- */

/* Beyond this many walls the cache is emptied: a megabyte. */
#define MOST_GROWN 16384u
/* Room to begin with: copying what grows was a hundredth of a town's instructions, with an eighth of it for walls. */
#define FEWEST_GROWN 64u
#define FEWEST_GROWN_WALLS 2048u

/* ---- The cache --------------------------------------------------------------------------------------------------- */

/* Beyond this many edges the cache is emptied: some megabytes. */
#define MOST_EDGES 131072u
#define FEWEST_SLOTS 64u

#endif
