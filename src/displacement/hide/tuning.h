/* These constants decide how often a cheapest choice is found, and never whether a choice or a bound is right. */
#ifndef SUNDER_I_HIDE_TUNING_H
#define SUNDER_I_HIDE_TUNING_H

/* The version of the values below. It is raised with each change of a value (tests/house/TUNING). */
#define SUNDER_I_HIDE_TUNING_VERSION 1

/* The search for the best choice of a component ends after COVER_EFFORT nodes, and one for each of its features. */
#define COVER_EFFORT 100000u
/* The tree of a component's bound is divided BOUND_EFFORT times, and twice for each of its features. */
#define BOUND_EFFORT 1000u

/* A feature that was in more than MOST_CLAUSES clauses, not counting those of smallest shapes, has its smallest shape:
 * several features can share what is missing in many ways, which differ little. */
#define MOST_CLAUSES 8u

#endif
