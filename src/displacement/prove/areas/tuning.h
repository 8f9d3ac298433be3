/* These constants decide how much is proved, and never whether a proof is right. The exceptions are MOST_SPAN and
 * CORNER_DOUBT, which are error bounds. */
#ifndef SUNDER_I_AREAS_TUNING_H
#define SUNDER_I_AREAS_TUNING_H

/* SUNDER_I_AREAS_TUNING_VERSION is the version of the values below. It is raised with each change of a value, so that a
 * record can name the values by their version (tests/house/TUNING). */
#define SUNDER_I_AREAS_TUNING_VERSION 1

/* ---- Error bounds (price_grids.c, masses.c) ---------------------------------------------------------------------- */

/* A body pays only if it spans fewer than MOST_SPAN - 2 squares along both axes. CORNER_DOUBT bounds the change of area
 * that rounding a corner of the clipped body causes in a square, in units of a mass: numbers below 2^12 are rounded by
 * 2^-41 of a square, and a mass is 2^-20. */
#define MOST_SPAN 4096       /* fixed: an error bound */
#define CORNER_DOUBT 0x1p-10 /* fixed: an error bound */

/* ---- What bodies occupy (occupied_outline.c) --------------------------------------------------------------------- */

/* Bodies are grown by the share HALF_GAP of half the gap, and not by all of it, so that a checker may use a polygon of
 * 32 corners in place of the disc. */
#define HALF_GAP (1 - 0x1p-7) /* fixed: part of the form of proofs */

/* ---- Ascent (ascent.c) ------------------------------------------------------------------------------------------- */

/* The first step changes the price of a square by FIRST_STEP times the gradient, which is 1 for a square that is
 * demanded twice. The length of a later step (next_length()) lies between STEP_LEAST and STEP_MOST; it is STEP_BLIND if
 * the gradient did not turn against the step before. */
#define FIRST_STEP 0.3
#define STEP_LEAST 1e-4
#define STEP_MOST 1e4
#define STEP_BLIND 10
/* take_step() tries at most SHORTENED lengths of one step, each shorter than the one before by the factor SHORTER. A
 * length is accepted if the value exceeds the least of the last REMEMBERED values by at least the share ENOUGH of the
 * gain that is predicted. */
#define SHORTENED 6
#define SHORTER 0.4
#define REMEMBERED 10 /* fixed: the size of an array */
#define ENOUGH 1e-4
/* Places that cost the payer more than the cheapest one by TOO_DEAR temperatures or more are ignored. */
#define TOO_DEAR 12
/* One place in GLANCES, along either axis, is sampled to estimate the cost of the cheapest one. */
#define GLANCES 4
/* Up to AT_ONCE payers are evaluated, by several threads, before their answers are added up. */
#define AT_ONCE 1024
/* Places that get at most the share LITTLE of the payer are left out of the demand. */
#define LITTLE 1e-5

/* ---- Grids (price_grids.c) --------------------------------------------------------------------------------------- */

/* No prices are made for fewer than FEWEST bodies with an area; a tree bounds the cost of these. */
#define FEWEST 4
/* On the finest grid a body of mean size is at least SQUARES_ACROSS / 2 and less than SQUARES_ACROSS squares wide.
 * There are up to LEVELS coarser grids, each with squares of twice the side. ROUNDS are the numbers of rounds of ascent
 * on each grid, from the coarsest to the finest. The finest grid has at most MOST_NODES nodes. */
#define SQUARES_ACROSS 12
#define LEVELS 4 /* fixed: the size of an array */
#define ROUNDS                                                                                                         \
    {                                                                                                                  \
        60, 60, 30, 10, 4                                                                                              \
    }
#define MOST_NODES 4e6
/* The temperature is the share PATIENCE of what a move by the size of a body costs: a place counts if it is dearer than
 * the cheapest one by not much more than that. */
#define PATIENCE 0.03

/* ---- Initial places (places.c) ----------------------------------------------------------------------------------- */

/* The grid for n bodies extends beyond them by ROOM_ABOUT sqrt(n) sizes of a body on every side: n bodies that stand in
 * one place need about half of sqrt(n) sizes. */
#define ROOM_ABOUT 0.5

#endif
