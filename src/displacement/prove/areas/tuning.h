/* Numbers of this room: they decide how much is proved, never whether that is right; but for the first two, which are
 * error bounds. */
#ifndef SUNDER_I_AREAS_TUNING_H
#define SUNDER_I_AREAS_TUNING_H

/* ---- Error bounds (masses.c) ------------------------------------------------------------------------------------- */

/* A body spans no more squares than this, either way. What a corner of what is left of it in a square may change its
 * area by, in parts of a mass: rounding of numbers below 2^12 is 2^-41 of a square, and a mass 2^-20. */
#define MOST_SPAN 4096
#define CORNER_DOUBT 0x1p-10

/* ---- What bodies occupy (occupied_outline.c) --------------------------------------------------------------------- */

/* The share of half the gap that they are grown by: so who checks it may do with a polygon of 32 corners for the disc.
 */
#define HALF_GAP (1 - 0x1p-7)

/* ---- Ascent (ascent.c) ------------------------------------------------------------------------------------------- */

/* The first step, as a share of the price that a square has that is asked for twice; its changes, at most; how often it
 * is shortened, and by how much; over how many values none needs to be more than the least. */
#define FIRST_STEP 0.3
#define STEP_LEAST 1e-4
#define STEP_MOST 1e4
#define STEP_BLIND 10
#define SHORTENED 6
#define SHORTER 0.4
#define REMEMBERED 10
#define ENOUGH 1e-4
/* Places that count for nothing: so many temperatures above the least. */
#define TOO_DEAR 12
/* One place in so many, either way, is looked at to see what the least is about. */
#define GLANCES 4
/* Payers that are asked before what they answer is added up. */
#define AT_ONCE 1024
/* A share of the payer that counts for nothing. */
#define LITTLE 1e-5

/* ---- Lattices (areas.c) ------------------------------------------------------------------------------------------ */

/* Fewer bodies are a tree's. */
#define FEWEST 4
/* Squares across a body of mean size, on the finest grid, at least half as many; so many coarser ones, each of twice
 * the side, and the rounds of each, from the coarsest; nodes of the finest at most. */
#define SQUARES_ACROSS 12
#define LEVELS 4
#define ROUNDS                                                                                                         \
    {                                                                                                                  \
        60, 60, 30, 10, 4                                                                                              \
    }
#define MOST_NODES 4e6
/* A place counts that is dearer than the cheapest by so great a share of what a move by a body's size costs. */
#define PATIENCE 0.03

/* ---- Places to begin from (places.c) ----------------------------------------------------------------------------- */

/* The room about n bodies, in sizes of one, for each root of n: what stands in one place takes half of that. */
#define ROOM_ABOUT 0.5

#endif
