/* Numbers of this room that are no error bounds: they decide which proofs are found, and in which time, never
 * whether one is right. (Those are derived in ways.c and program.c.) */
#ifndef SUNDER_I_PROOFS_TUNING_H
#define SUNDER_I_PROOFS_TUNING_H

/* ---- A node's program (program.c) -------------------------------------------------------------------------------- */

/* Its softness, and how often it is solved again about its last solution. The pull to a place is weaker each time, so
 * both only tell how soon a contradiction of a small part of the lengths shows. */
#define SOFTNESS 1e-6
#define ROUNDS 24
/* What has not ended by then is made so many times harder each round, to the least: it ended one in twenty questions
 * about buildings between roads. */
#define SOFT_ROUNDS 4
#define HARDER 10
#define LEAST_SOFTNESS 1e-12
/* It is solved to this part of a hair. */
#define SOLVED_TO 4

/* ---- The branches (branches.c, violations.c) --------------------------------------------------------------------- */

/* Only violations of at least this share of the deepest are weighed: shallow ones tell little. */
#define DEEP 0.5
/* What a look at two bodies' pieces costs, in constraints looked at. */
#define LOOK_WORK 16
/* Sides of the polygon that stands for the disc of limits where what they leave is measured, and the most corners that
 * cuts of it may make: what would make more is left out, and only a guess is worse for it. */
#define DISC_SIDES 16
#define MOST_CORNERS 96

#endif
