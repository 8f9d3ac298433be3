/* Numbers of this room that are no error bounds: they decide how good a result is and how long it takes to find, never
 * whether what is said of it is true. */
#ifndef SUNDER_I_CLUSTERS_TUNING_H
#define SUNDER_I_CLUSTERS_TUNING_H

/* ---- Rounds (settle.c) ------------------------------------------------------------------------------------------- */

/* How often a cluster's margin, which grows fourfold each time, may grow: 28 bits, which leaves half of a double. */
#define MOST_MARGINS 14
/* A round is taken for so much of what is left of the progress: few layers need more than some rounds. */
#define SHARE_OF_ROUND 0.25
/* Room for clusters is made for the edges that there are and such a part of them, for a round adds few. */
#define SPARE_ROOM 8

/* ---- Coarse moves (coarse_bodies.c) ------------------------------------------------------------------------------ */

/* A body is held beside a neighbour whose last place is finer by so many bits, and whose size and gap are less than so
 * many of its own last places: a house of 10 m beside a vertex at 1e16, not at 1e15. */
#define COARSE_BITS 10
#define COARSE_PLACES 64

/* ---- Crowds (clusters.c) ----------------------------------------------------------------------------------------- */

/* So many bodies that may go anywhere begin from where prices of area put them. Of 7,650 symbols in Germany it makes
 * no difference whether a dozen do. */
#define CROWD 40
/* They begin so again whenever they have run into others; such as have no more of them than this at any growth, larger
 * ones twice as many. Of Germany's and Europe's symbols all that began anew twice as many cost 6 and 8 % more; Italy's
 * crowd of 4,370 costs no less where it begins anew at any growth, in half as much time again. */
#define LARGE_GROWN_CROWD 1000
/* How often such take in whom they will run into before they are solved; a body counts as larger by so much of its
 * size on every side there, since rough places are no nearer than that. Of Italy's symbols a crowd of 1,750 takes in
 * 1,400 so if a quarter is added, and 2,650 with half, of 2,900 that it runs into in the end. */
#define CROWDS_GROWN 8
#define CROWD_GROWN_BY 0.5

/* ---- Without limits (lifted_limits.c) ---------------------------------------------------------------------------- */

/* Clusters that cost more than within their limits become one as long as it has no more bodies than this. */
#define MOST_LIFTED 128

/* ---- Is there a solution after all? (reconsider.c) --------------------------------------------------------------- */

/* How long a solution is looked for, in constraints looked at: so many for each body. Among more than these bodies none
 * was ever found, and the pairs are asked about one by one. */
#define EFFORT 100000u
#define MOST_BODIES 64

/* How long for one pair, the others staying in conflict (one_by_one.c): some milliseconds; and for each unit of
 * --effort, up to so many, so many times as much more. Beside roads a block of dozens of houses has a solution of half
 * a million to ten: of the pairs of which nothing was known all 7 of Neuss are solved so, and 22 of 71 of Saint-Jean at
 * gap 5. */
#define EFFORT_ALONE 400000u
#define MORE_EFFORT_ALONE 15
#define MORE_ALONE_UP_TO 64
/* All questions of a cluster that no solution comes of may take so much together, and so much for each of its bodies. A
 * grid of 600 squares that have no room within their limits is left with 1,953 pairs to be asked about. */
#define POOL_ALONE 1000000000u
#define POOL_ALONE_EACH 10000u
/* The same where neither of the two has a limit: then it is the rule against jumps that stands in the way, and beside a
 * yard of dozens of houses all effort is in vain. Where so many of a cluster, one after the other, have ended for want
 * of effort, that of the next is halved, and so on, down to this: of 624 pairs of a town of terraces five had an
 * answer, and one of these was of use. Of 26 that had one on real layers with roads none came after more than 3 in
 * vain. */
#define EFFORT_BRIEFLY_ALONE 50000u
#define ALONE_IN_VAIN 2
/* A cluster of more such pairs is asked as if so many had: 54 crowds of terraces took 6 s until they had. */
#define MANY_ALONE 64
#define MANY_IN_VAIN 5
/* So many of a cluster may end for want of effort before fewer and fewer are asked; one that ends otherwise makes good
 * so many. */
#define ALONE_PATIENCE 8
#define ALONE_REGAINED 4
#define MARGINS 4

/* ---- Questions about one conflict (spared_pairs.c) --------------------------------------------------------------- */

/* How long proofs are looked for before a solution is, all together: about as long as one conflict of a small layer
 * takes that has one. Searches without a solution that might be spared take no longer. */
#define EFFORT_BRIEFLY 30000u

/* ---- Two bodies that are shut in (shut_in_conflicts.c) ----------------------------------------------------------- */

/* What lines may be short by, as a share of how far two features may go: proofs are smaller, and few are missed. */
#define COARSE_IN_PLANE 0x1p-8
/* Bodies of more pairs of pieces are not asked about; nor any more of two when so much was done in vain: a block in the
 * yard of another, 160,000 pairs in all, took 3 s for nothing. */
#define MOST_IN_PLANE 50000u
#define EFFORT_IN_VAIN 2000000u

/* ---- What fits exactly (exact_fits.c) ---------------------------------------------------------------------------- */

/* What the search may miss, as a share of the smaller body: far below the hair by which a place may be beside the
 * lattice (TIGHT_HAIR), far above what programs leave. Of a cluster so many are asked in vain, one after the other. */
#define FIT_ROOM 0x1p-32
#define FITS_IN_VAIN 8

/* ---- Proofs of optimality (optimise.c) --------------------------------------------------------------------------- */

/* Rounds of proofs, in which groups join. */
#define OPTIMISED 24
/* A group's margin is widened no further for what is only cheaper. */
#define MOST_MARGINS_AGAIN 6
/* Steps for each body of a group at effort 1; a group that is smaller than this is worth as many as one of so many; and
 * one whose bodies have spent theirs as members of others gets one in so many again. */
#define STEPS_EACH 2e6
#define SMALL_GROUP 24
#define LATE 4
/* A group is tired of being shaken with patience if those that were pay for more than this share of its cost. */
#define MOSTLY_SHAKEN 0.9

/* ---- Nothing worse (uphold.c) ------------------------------------------------------------------------------------ */

/* Moves are alike that differ by no more than so many units: what a row that was pushed along gathers by rounding. */
#define ALIKE 16
/* So many bodies of a cluster may be moved together in vain: rows of a few hundred, some dozens of them. */
#define IN_VAIN 20000
/* A margin is asked in vain of clusters of so many bodies together: of one of 5,000 a hundred times. */
#define EASED_IN_VAIN 500000
/* All pairs of a cluster wait until who was pinned has settled, if it has no more bodies than these. */
#define MOST_HELD 1024
/* The progress at which this comes (../../separate_layer.c). */
#define SOUGHT 0.8

#endif
