/* Numbers of this room that are no error bounds: they decide how good a result is and how long it takes to find, never
 * whether what is said of it is true. Where no trial is named, what a number balances is all that is known. */
#ifndef SUNDER_I_PROGRAMS_TUNING_H
#define SUNDER_I_PROGRAMS_TUNING_H

/* ---- Which method (quadratic.c) ---------------------------------------------------------------------------------- */

/* Programs with more constraints go to the interior point method at once: the dual methods are quick for the dozens of
 * contacts of almost every cluster, and had not ended after minutes for one of 300 blocks of a dense old town. */
#define MOST_QUICK 1500
/* What a small program takes is kept on the stack, up to so many bytes: most have a dozen constraints. */
#define ON_THE_STACK 4096
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
/* The running gradient gathers rounding; so often it is computed anew. */
#define REFRESH 64

/* ---- Active set -------------------------------------------------------------------------------------------------- */

/* Up to this many acting constraints are solved as dense equations: cubic, some milliseconds. */
#define MOST_ACTIVE 300
/* Constraints that may come in besides those that act when it begins. */
#define MORE_ACTIVE 64
/* Factorisations before the set is left as it is; rounds of adding what is violated. */
#define MOST_FACTORS 60
#define MOST_ADDING 40
/* So often all forces that pull are dropped at once, which mostly is right and saves a hundred factorisations; then one
 * by one, which always ends. */
#define HASTY 12
/* The diagonal is raised by this part of itself: constraints that say the same twice are common (a long wall cut into
 * pieces), and any split of their force will do. Far above rounding, far below what the tolerance shows. */
#define RAISED 1e-11

/* ---- A few more constraints (mend.c) ----------------------------------------------------------------------------- */

/* So many contacts from what is missed take part at first, twice as many each time that this does not do, and no more
 * than this share of the bodies: then all are asked. */
#define FIRST_RINGS 4
#define MOST_MENDING_SHARE 8

/* ---- Nearest place (nearest.c) ----------------------------------------------------------------------------------- */

/* Steps, which are some for each constraint that acts in the end. */
#define MOST_NEAREST 1000

/* ---- Order of elimination (sparse.c, dissection.c) --------------------------------------------------------------- */

/* More bodies than these are dissected: of fewer the factor takes as long as with minimum degree, or two thirds. */
#define FEWEST_DISSECTED 8192
/* A part of no more than these is not divided; nor one of which more than such a share would part two halves, if it is
 * small: of a larger one that says that this is no graph to be dissected. */
#define LEAF_OF_DISSECTION 8
#define FEW_PARTING 4
#define SMALL_PART_OF_DISSECTION 256

/* ---- Newton steps ------------------------------------------------------------------------------------------------ */

/* Programs with more constraints than these, and no more than MOST_QUICK, begin with them: below, the dual methods are
 * as quick. Of the programs of terraces of 11,700 houses soft ones took a fifth of the time of what was done before,
 * hard ones two fifths. */
#define FEWEST_NEWTON 40
/* ... where all that moves has a limit: without one Italy's 10,000 places take 82 s for 64, at 1 % less of the cost.
 * Nor of more bodies than these: in a row of 250 slabs, each on the next and on a hut, the sequence of soft programs
 * was cut short, and three stayed on their huts. */
#define MOST_BODIES_NEWTON 400
/* Of no more bodies than the first a step counts so many times as much work: what may be done to give up pairs, and to
 * ask for them again, is reckoned from that. With 1 terraces of 11,700 houses take a tenth longer, for 6 of 6,960
 * pairs; with 3 in crowds, too, Germany within 6 km is left with 447 pairs for 398. */
#define FEW_BODIES 40
#define WORK_OF_FEW 3
/* Steps for one soft program, of which some to two dozen are the rule. */
#define MOST_NEWTON 50
/* A place is near enough if a step is shorter than the tolerance by so many times. */
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
/* Forces change as much as they did if by this share. A hair is so many times the tolerance, which is less than what
 * rounding leaves of a move at the ends of a layer. */
#define STANDS 0.5
#define HAIR 64

/* ---- Interior point ---------------------------------------------------------------------------------------------- */

/* Steps, of which a dozen or two are the rule; one that is shorter than the least leads nowhere. */
#define MOST_STEPS 60
#define LEAST_STEP 1e-8
/* The products of slacks and forces that are left, as a share of the cost: then the method has converged. */
#define GAP_LEFT 1e-8
/* A step goes this share of the way to where a slack or force would be zero [Meh92]. */
#define SHARE_OF_STEP 0.99
/* Slacks begin no less than this share of a length such as bodies move by, forces so that the products are alike. */
#define FIRST_SLACK 0.1
/* Of so many bodies a program begins where its forces have sent them. Begun far, like larger ones, 388 blocks of a
 * dense old town at gap 3 end 4 % dearer: more of the programs with sides that contradict each other have a solution
 * then, and it is taken. */
#define MOST_NEAR 500
/* Forces that fade below this share of the mean are of constraints that do not act. */
#define FADED 1e-9

#endif
