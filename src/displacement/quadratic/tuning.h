/* Numbers of this room that are no error bounds: they decide how good a result is and how long it takes to find, never
 * whether what is said of it is true. Where no trial is named, what a number balances is all that is known. */
#ifndef SUNDER_I_QUADRATIC_TUNING_H
#define SUNDER_I_QUADRATIC_TUNING_H

/* The version of these values; raised with each change of one, so that a record can name it (tests/house/TUNING). */
#define SUNDER_I_QUADRATIC_TUNING_VERSION 1

/* ---- Which method (quadratic.c) ---------------------------------------------------------------------------------- */

/* Programs with more constraints go to the interior point method at once: the dual methods are quick for the dozens of
 * contacts of almost every cluster, but did not end within minutes for one of 300 blocks of a dense old town. */
#define MOST_QUICK 1500
/* Bytes on the stack for a small program: most have a dozen constraints. */
#define ON_THE_STACK 4096 /* fixed: the size of an array */
/* Passes of Hildreth's method, every fourth over all constraints, the others over those that act: enough to tell which
 * act, the forces are left to what follows. */
#define SWEEPS 40
#define FULL_SWEEP 4
/* Steps of conjugate gradients: chains of some hundred contacts take as many. */
#define QUICK_STEPS 400

/* A program is left for its cost when the forces prove that it is dearer by this share. */
#define BEYOND 1e-6

/* ---- Conjugate gradients ----------------------------------------------------------------------------------------- */

/* Powers to find the largest eigenvalue by, and what covers that the value found is too small. */
#define POWERS 12
#define ABOVE_FOUND 1.2
/* Length of a projected gradient step over the reciprocal of that eigenvalue: it has to be less than 2 [Dostal]. */
#define GRADIENT_STEP 1.9
/* The running gradient accumulates rounding; it is recomputed after this many steps. */
#define REFRESH 64

/* ---- Active set -------------------------------------------------------------------------------------------------- */

/* Up to this many acting constraints are solved as dense equations: cubic, some milliseconds. */
#define MOST_ACTIVE 300
/* Constraints that may come in besides those that act when it begins. */
#define MORE_ACTIVE 64
/* Factorisations before the set is left as it is; rounds of adding what is violated. */
#define MOST_FACTORS 60
#define MOST_ADDING 40
/* This many times all negative forces are dropped at once, which is usually right and saves a hundred factorisations;
 * after that one at a time, which always ends. */
#define HASTY 12
/* The diagonal is raised by this part of itself: constraints that say the same twice are common (a long wall cut into
 * pieces), and any split of their force will do. Far above rounding, far below what the tolerance shows. */
#define RAISED 1e-11

/* ---- A few more constraints (mend.c) ----------------------------------------------------------------------------- */

/* Bodies up to this many contacts from a violated constraint take part at first, twice as many contacts after each
 * failure, and at most this share of the bodies: then the whole program is solved. */
#define FIRST_RINGS 4
#define MOST_MENDING_SHARE 8

/* ---- Nearest place (nearest.c) ----------------------------------------------------------------------------------- */

/* Steps, which are some for each constraint that acts in the end. */
#define MOST_NEAREST 1000

/* ---- Order of elimination (sparse.c, dissection.c) --------------------------------------------------------------- */

/* More bodies than these are dissected: of fewer the factor takes as long as with minimum degree, or two thirds. */
#define FEWEST_DISSECTED 8192
/* A part of at most this many nodes is not divided. A small part is not divided either if its separator would exceed
 * this share; for a larger part such a separator means that the graph is unsuited to dissection. */
#define LEAF_OF_DISSECTION 8
#define FEW_PARTING 4
#define SMALL_PART_OF_DISSECTION 256

/* ---- Newton steps ------------------------------------------------------------------------------------------------ */

/* Programs with more constraints than this, and at most MOST_QUICK, begin with Newton's method: below it the dual
 * methods are as quick. In terraces of 11,700 houses soft programs took a fifth of the previous time, hard ones two
 * fifths. */
#define FEWEST_NEWTON 40
/* ... where all that moves has a limit: without one Italy's 10,000 places take 82 s for 64, at 1 % less of the cost.
 * Nor of more bodies than these: in a row of 250 slabs, each on the next and on a hut, the sequence of soft programs
 * was cut short, and three stayed on their huts. */
#define MOST_BODIES_NEWTON 400
/* With at most this many bodies a step counts as that many times the work: the budgets for giving pairs up, and for
 * asking for them again, derive from the work. With 1 terraces of 11,700 houses take a tenth longer, for 6 of 6,960
 * pairs; with 3 also in crowds, Germany within 6 km keeps 447 pairs instead of 398. */
#define FEW_BODIES 40
#define WORK_OF_FEW 3
/* Steps for one soft program; a few to two dozen are usual. */
#define MOST_NEWTON 50
/* A place is accurate enough if the step is shorter than the tolerance divided by this. */
#define CLOSE 16
/* Along a step: places looked at, and the share of the slope, or of the way, that is as good as none. */
#define MOST_SHARES 30
#define FLAT 1e-3
/* Softness in the sequence that ends in a hard program: at first, what it is divided by each time, and the least, where
 * rounding is still far; and how often. With 1e-2 to 1e-8 at first, and 1e-10 in the end, it takes as long. */
#define FIRST_GIVE 1e-3
#define LESS_GIVE 30
#define LEAST_GIVE 1e-8
#define MOST_FORCES 32
/* The same of few constraints, which the dual methods solve as quickly. */
#define FEW_TO_LEAP 64
#define MOST_FORCES_OF_FEW 8
/* Forces change "as much as before" if within this share. A hair is this many times the tolerance, which is less than
 * the rounding of a move at the ends of a layer. */
#define STANDS 0.5
#define HAIR 64

/* ---- Interior point ---------------------------------------------------------------------------------------------- */

/* Steps; a dozen or two are usual. A step shorter than the least makes no progress. */
#define MOST_STEPS 60
#define LEAST_STEP 1e-8
/* The products of slacks and forces that are left, as a share of the cost: then the method has converged. */
#define GAP_LEFT 1e-8
/* A step goes this share of the way to where a slack or force would be zero [Meh92]. */
#define SHARE_OF_STEP 0.99
/* Slacks begin no less than this share of a length such as bodies move by, forces so that the products are alike. */
#define FIRST_SLACK 0.1
/* Up to this many bodies a program starts where its forces have moved them. Started far, like larger ones, 388 blocks
 * of a dense old town at gap 3 end up 4 % more expensive: more of the programs with contradicting sides then have a
 * solution, and it is taken. */
#define MOST_NEAR 500
/* Forces that fade below this share of the mean are of constraints that do not act. */
#define FADED 1e-9

#endif
