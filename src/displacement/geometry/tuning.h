/* These constants decide how good a result is and how long it takes to find, and never whether a statement about it is
 * true. None of them is an error bound. */
#ifndef SUNDER_I_GEOMETRY_TUNING_H
#define SUNDER_I_GEOMETRY_TUNING_H

/* SUNDER_I_GEOMETRY_TUNING_VERSION is the version of the values below. It is raised with each change of a value, so
 * that a record can name the values by their version (tests/house/TUNING). */
#define SUNDER_I_GEOMETRY_TUNING_VERSION 2

/* ---- Free places (grown_obstacles.c, free_places.c, cells.c) ----------------------------------------------------- */

/* A round corner of a grown obstacle is approximated by tangents whose normals turn by at most CORNER_TURN (radians)
 * from one to the next: a proposed place then keeps at most 2 % more than the gap. */
#define CORNER_TURN (PI / 8)
/* A gap below the share NEXT_TO_NOTHING of the obstacle's width plus height is tiny: the turn between tangents may then
 * be as large as CORNER_TURN_AT_MOST, which needs at most two tangents at a corner. A place then keeps up to half the
 * gap too much, which is invisible. */
#define NEXT_TO_NOTHING 1e-6
#define CORNER_TURN_AT_MOST (PI / 2 + FLAT)
/* A turn to the right by at most FLAT (radians) counts as no turn: where two sides lie on one line, it is the rounding
 * of their normals. */
#define FLAT 1e-3
/* FEWEST_WALLS is the initial capacity, in walls, of the array that reserve_walls() allocates. It is sufficient for
 * most searches. */
#define FEWEST_WALLS 512
/* search_places() looks for crossings among at most MOST_CROSSED sides, those nearest to the target. This bounds the
 * work where a block stands amid hundreds of neighbours. */
#define MOST_CROSSED 1500
/* Places are computed on the sides of obstacles: a place counts as on a side if its distance from it is at most the
 * share ON_A_SIDE of the obstacle's width plus height. This is above the rounding of a crossing of sides that do not
 * nearly coincide, and below any gap that is asked for. */
#define ON_A_SIDE 1e-12
/* sunder_i_cells_make() makes no cells for fewer than FEW_OBSTACLES obstacles, since cells do not pay then. The side of
 * a cell is the mean size of an obstacle divided by CELLS_ACROSS, or greater if there would be more than about
 * CELLS_EACH cells for each obstacle. */
#define FEW_OBSTACLES 64
#define CELLS_ACROSS 2
#define CELLS_EACH 8
/* Walls are visited by distance, in SHELVES intervals of equal length (free_places.c). */
#define SHELVES 256 /* fixed: the size of an array */
/* Cells are grown by the share CELL_MARGIN of their side, far above rounding, so that a point near a common boundary of
 * two cells need not be assigned to one of them. */
#define CELL_MARGIN 1e-6
/* At most MOST_PLACES places are found in one search; no caller asks for more. */
#define MOST_PLACES 16 /* fixed: the size of an array */
/* Places that may be free are tested against obstacles, and most tests are brief. TESTS_A_STEP tests count as one step
 * of work (a constraint looked at), and TESTS_A_WATCH tests as one step of the watch (sunder_i_steps()). */
#define TESTS_A_STEP 2
#define TESTS_A_WATCH 16

/* ---- Support lines (obstacle.c) ---------------------------------------------------------------------------------- */

/* If a point is nearer to a corner than the share AT_A_CORNER of the perimeter, the direction from the corner to it is
 * dominated by rounding, and the normal of an edge is used in its place. */
#define AT_A_CORNER 1e-9

/* ---- The cache of grown obstacles (grown_cache.c) ---------------------------------------------------------------- */

/* The cache is emptied when it would have more than MOST_GROWN walls, which take about a megabyte. */
#define MOST_GROWN 16384u
/* FEWEST_GROWN is the initial number of slots of the cache, and FEWEST_GROWN_WALLS its initial capacity in walls. With
 * an eighth of FEWEST_GROWN_WALLS, copying the walls to larger arrays took a hundredth of the instructions for a
 * town. */
#define FEWEST_GROWN 64u
#define FEWEST_GROWN_WALLS 2048u

/* ---- The cache of obstacles (obstacle_cache.c) ------------------------------------------------------------------- */

/* The cache is emptied when it would have more than MOST_EDGES edges, which take some megabytes. FEWEST_SLOTS is its
 * initial number of slots. */
#define MOST_EDGES 131072u
#define FEWEST_SLOTS 64u

/* ---- Corners that two sides share (side_chord.c) ----------------------------------------------------------------- */

/* A chord cuts off the share CHORD of the two sides, or a larger one, and passes beyond the corner by the share BEYOND
 * of the corner's distance. Both are far more than rounding and the gaps between the shadows, and too small to
 * matter. */
#define CHORD 0x1p-16
#define BEYOND 0x1p-24
/* A chord is looked for if the anchor's path passes the corner at no more than the share BESIDE of the path's length to
 * it. */
#define BESIDE 0x1p-20

#endif
