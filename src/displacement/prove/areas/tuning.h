/* Numbers of this room: they decide how much is proved, never whether that is right; but for the first two, which are
 * error bounds. */
#ifndef SUNDER_I_AREAS_TUNING_H
#define SUNDER_I_AREAS_TUNING_H

/* The version of these values; raised with each change of one, so that a record can name it (tests/house/TUNING). */
#define SUNDER_I_AREAS_TUNING_VERSION 1

/* ---- Error bounds (masses.c) ------------------------------------------------------------------------------------- */

/* A body spans at most this many squares along either axis. Bound on the change of area by rounding a corner of the
 * clipped body in a square, in parts of a mass: rounding of numbers below 2^12 is 2^-41 of a square, and a mass
 * 2^-20. */
#define MOST_SPAN 4096 /* fixed: an error bound */
#define CORNER_DOUBT 0x1p-10 /* fixed: an error bound */

/* ---- What bodies occupy (occupied_outline.c) --------------------------------------------------------------------- */

/* The share of half the gap by which they are grown: so a checker may use a polygon of 32 corners for the disc. */
#define HALF_GAP (1 - 0x1p-7) /* fixed: part of the form of proofs */

/* ---- Ascent (ascent.c) ------------------------------------------------------------------------------------------- */

/* The first step, as a share of the price of a square that is demanded twice; the most steps; how often a step is
 * shortened, and by which factor; over how many values the least must not be exceeded. */
#define FIRST_STEP 0.3
#define STEP_LEAST 1e-4
#define STEP_MOST 1e4
#define STEP_BLIND 10
#define SHORTENED 6
#define SHORTER 0.4
#define REMEMBERED 10 /* fixed: the size of an array */
#define ENOUGH 1e-4
/* Places this many temperatures above the least are ignored. */
#define TOO_DEAR 12
/* One place in this many, along either axis, is sampled to estimate the least. */
#define GLANCES 4
/* Payers evaluated before their answers are added up. */
#define AT_ONCE 1024
/* A share of the payer that counts for nothing. */
#define LITTLE 1e-5

/* ---- Lattices (areas.c) ------------------------------------------------------------------------------------------ */

/* Fewer bodies are a tree's. */
#define FEWEST 4
/* Squares across a body of mean size on the finest grid, at least half as many; number of coarser grids, each with
 * squares of twice the side, and the rounds of each, from the coarsest; the most nodes of the finest. */
#define SQUARES_ACROSS 12
#define LEVELS 4 /* fixed: the size of an array */
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
