/* These constants decide how good a result is and how long it takes to find, and never whether a statement about it is
 * true. None of them is an error bound. Where a comment names no trial, only what a value balances is known. */
#ifndef SUNDER_I_QUADRATIC_TUNING_H
#define SUNDER_I_QUADRATIC_TUNING_H

/* SUNDER_I_QUADRATIC_TUNING_VERSION is the version of the values below. It is raised with each change of a value, so
 * that a record can name the values by their version (tests/house/TUNING). */
#define SUNDER_I_QUADRATIC_TUNING_VERSION 2

/* ---- Which method (quadratic.c) ---------------------------------------------------------------------------------- */

/* A program with more than MOST_QUICK constraints goes to the interior point method at once. The dual methods are quick
 * for the dozens of contacts of almost every cluster, but did not end within minutes for a cluster of 300 blocks in a
 * dense old town. */
#define MOST_QUICK 1500
/* The arrays of a small program take up to ON_THE_STACK bytes on the stack (sweep_constraints(),
 * conjugate_gradients.c): most programs have a dozen constraints. */
#define ON_THE_STACK 4096 /* fixed: the size of an array */
/* Hildreth's method makes SWEEPS sweeps. Every FULL_SWEEP-th is over all constraints, the others over the active ones.
 * This is enough to tell which constraints are active; the methods that follow find the forces. */
#define SWEEPS 40
#define FULL_SWEEP 4
/* The method of conjugate gradients makes at most QUICK_STEPS steps: chains of some hundred contacts take that many. */
#define QUICK_STEPS 400

/* A program is given up if its forces prove that its cost exceeds most_cost by more than the share BEYOND
 * (sunder_i_quadratic_is_beyond()). */
#define BEYOND 1e-6

/* ---- Prices (priced.c) ------------------------------------------------------------------------------------------- */

/* A program with prices is solved at most MOST_STATES times more; two or three suffice for most. A force within the
 * share PRICE_HAIR of the price changes no state. */
#define MOST_STATES 12
#define PRICE_HAIR 1e-9

/* ---- Conjugate gradients (conjugate_gradients.c) ----------------------------------------------------------------- */

/* largest_eigenvalue() makes POWERS rounds of the power method, and multiplies the value found by ABOVE_FOUND, since it
 * may be too small. */
#define POWERS 12
#define ABOVE_FOUND 1.2
/* The length of a projected gradient step is GRADIENT_STEP divided by the largest eigenvalue. GRADIENT_STEP has to be
 * less than 2 [Dostal]. */
#define GRADIENT_STEP 1.9
/* The running gradient accumulates rounding errors, and is recomputed after every REFRESH steps. */
#define REFRESH 64

/* ---- Active set (active_set.c) ----------------------------------------------------------------------------------- */

/* Up to MOST_ACTIVE active constraints are solved as dense equations. The time grows with the cube of their number, and
 * is some milliseconds at the limit. */
#define MOST_ACTIVE 300
/* The arrays have room for MORE_ACTIVE constraints besides those that are active at the start. */
#define MORE_ACTIVE 64
/* The set is left as it is after MOST_FACTORS factorisations, and violated constraints are added in at most MOST_ADDING
 * rounds. */
#define MOST_FACTORS 60
#define MOST_ADDING 40
/* In the first HASTY rounds find_forces() drops all constraints with negative forces at once, which is usually right
 * and saves a hundred factorisations. After that it drops one at a time, which always ends. */
#define HASTY 12
/* The diagonal is increased by the share RAISED of itself: equivalent constraints are common (a long wall cut into
 * pieces), and any split of their force will do. The value is far above rounding and far below what the tolerance
 * shows. */
#define RAISED 1e-11

/* ---- A few more constraints (mend.c) ----------------------------------------------------------------------------- */

/* At first the bodies take part that are at most FIRST_RINGS contacts away from a violated constraint; after each
 * failure the number of contacts doubles. If more than one body in MOST_MENDING_SHARE takes part, the whole program is
 * solved instead. */
#define FIRST_RINGS 4
#define MOST_MENDING_SHARE 8

/* ---- Nearest place (nearest.c) ----------------------------------------------------------------------------------- */

/* The nearest place is found in at most MOST_NEAREST steps; a search takes some steps for each constraint that is
 * active in the end. */
#define MOST_NEAREST 1000

/* ---- Order of elimination (elimination.c, dissection.c) ---------------------------------------------------------- */

/* Graphs with more than FEWEST_DISSECTED nodes (bodies) are ordered by dissection: with fewer, the factorisation takes
 * from two thirds of the time to the same time as with minimum degree. */
#define FEWEST_DISSECTED 8192
/* A part of at most LEAF_OF_DISSECTION nodes is not divided. A separator has too many nodes if it has more than one in
 * FEW_PARTING of its part. A part of at most SMALL_PART_OF_DISSECTION nodes is then not divided; for a larger part it
 * means that the graph is unsuited to dissection. */
#define LEAF_OF_DISSECTION 8
#define FEW_PARTING 4
#define SMALL_PART_OF_DISSECTION 256

/* ---- Newton steps (quadratic.c, newton.c) ------------------------------------------------------------------------ */

/* Programs with more than FEWEST_NEWTON and at most MOST_QUICK constraints begin with Newton's method; with fewer
 * constraints the dual methods are as quick. In terraces of 11,700 houses soft programs took a fifth of the previous
 * time, and hard programs two fifths. */
#define FEWEST_NEWTON 40
/* Newton's method is used only for programs with at most MOST_BODIES_NEWTON bodies and a greatest cost, that is, if all
 * that moves has a limit. Without a limit Italy's 10,000 places take 82 s instead of 64 s, for 1 % less cost. With more
 * bodies, the sequence of soft programs was cut short in a row of 250 slabs, each on the next and on a hut, and three
 * stayed on their huts. */
#define MOST_BODIES_NEWTON 400
/* In a program with at most FEW_BODIES bodies a step counts as WORK_OF_FEW times its work. The budgets for giving pairs
 * up, and for asking for them again, derive from the work. With WORK_OF_FEW = 1 terraces of 11,700 houses take a tenth
 * longer, for 6 of 6,960 pairs. With 3 for crowds, too, Germany within 6 km keeps 447 pairs instead of 398. */
#define FEW_BODIES 40
#define WORK_OF_FEW 3
/* minimise_sum() makes at most MOST_NEWTON steps for one soft program; a few to two dozen are usual. */
#define MOST_NEWTON 50
/* A place is accurate enough if the next step is shorter than the tolerance divided by CLOSE. */
#define CLOSE 16
/* find_share() evaluates at most MOST_SHARES places along a step. It ends when the slope is at most the share FLAT of
 * the first slope, or when the place changes by less than the share FLAT. */
#define MOST_SHARES 30
#define FLAT 1e-3
/* solve_hard() solves a sequence of soft programs that ends in a hard one. The softness is FIRST_GIVE at first, is
 * divided by LESS_GIVE each time, and is at least LEAST_GIVE, where rounding is still far below it. There are at most
 * MOST_FORCES programs. With 1e-2 to 1e-8 for FIRST_GIVE, and with 1e-10 for LEAST_GIVE, it takes as long. */
#define FIRST_GIVE 1e-3
#define LESS_GIVE 30
#define LEAST_GIVE 1e-8
#define MOST_FORCES 32
/* With at most FEW_TO_LEAP constraints there are at most MOST_FORCES_OF_FEW programs, since the dual methods solve such
 * a program as quickly. */
#define FEW_TO_LEAP 64
#define MOST_FORCES_OF_FEW 8
/* The forces change as much as before if the change exceeds the share STANDS of the last one. They are then accepted if
 * the change is at most HAIR times the tolerance, which is less than the rounding of a move at the ends of a layer. */
#define STANDS 0.5
#define HAIR 64

/* ---- Interior point (interior_point.c) --------------------------------------------------------------------------- */

/* The method makes at most MOST_STEPS steps; a dozen or two are usual. It ends at a step with a share below LEAST_STEP,
 * which makes no progress. */
#define MOST_STEPS 60
#define LEAST_STEP 1e-8
/* The method has converged if the products of slacks and forces add up to at most the share GAP_LEFT of the cost. */
#define GAP_LEFT 1e-8
/* A step goes the share SHARE_OF_STEP of the way to where a slack or a force would be zero [Meh92]. */
#define SHARE_OF_STEP 0.99
/* Slacks begin at no less than the share FIRST_SLACK of a typical length of moves, and forces begin so that all
 * products of a slack and a force are alike. */
#define FIRST_SLACK 0.1
/* A program with at most MOST_NEAR bodies starts where its forces have moved the bodies (begin_near()). When it started
 * far away, as larger programs do, 388 blocks of a dense old town at gap 3 ended 4 % more expensive: more of the
 * programs with contradicting sides then have a solution, and the search takes it. */
#define MOST_NEAR 500
/* Constraints with a force below the share FADED of a typical one (the mean stiffness of a body times a typical length)
 * are not active. */
#define FADED 1e-9

#endif
