/* Numbers of this room that are no error bounds: they decide how good a result is and how long it takes to find, never
 * whether what is said of it is true. */
#ifndef SUNDER_I_CLUSTERS_TUNING_H
#define SUNDER_I_CLUSTERS_TUNING_H

/* The version of these values; raised with each change of one, so that a record can name it (tests/house/TUNING). */
#define SUNDER_I_CLUSTERS_TUNING_VERSION 1

/* ---- Rounds (settle.c) ------------------------------------------------------------------------------------------- */

/* How often a cluster's margin, which grows fourfold each time, may grow: 28 bits, which leaves half of a double. */
#define MOST_MARGINS 14
/* A round counts as this share of the remaining progress: few layers need more than some rounds. */
#define SHARE_OF_ROUND 0.25
/* Room for clusters is made for the edges that there are and such a part of them, for a round adds few. */
#define SPARE_ROOM 8

/* ---- Coarse moves (coarse_bodies.c) ------------------------------------------------------------------------------ */

/* A body is held beside a neighbour whose last place is finer by this many bits, and whose size and gap are less than
 * this many of the body's own last places: a house of 10 m beside a vertex at 1e16, not at 1e15. */
#define COARSE_BITS 10
#define COARSE_PLACES 64
/* A body counts as thrown if it moves farther than beside a held neighbour, by this many times its size and the gap. */
#define THROWN 16

/* ---- Crowds (clusters.c) ----------------------------------------------------------------------------------------- */

/* From this many bodies on, a crowd that may go anywhere begins where prices of area put it. For 7,650 symbols in
 * Germany it makes no difference whether a dozen do. */
#define CROWD 40
/* They begin like this again when they have run into others; crowds of at most this many bodies at any growth, larger
 * ones when they have doubled. Of Germany's and Europe's symbols all that began again only when doubled cost 6 and 8 %
 * more; Italy's crowd of 4,370 costs no less if it begins again at any growth, in half as much time again. */
#define LARGE_GROWN_CROWD 1000
/* How often such crowds absorb the bodies that they will run into before they are solved; a body counts as larger by
 * this share of its size on every side there, since approximate places are no more accurate. Of Italy's symbols a crowd
 * of 1,750 absorbs 1,400 if a quarter is added, and 2,650 with half, of 2,900 that it runs into in the end. */
#define CROWDS_GROWN 8
#define CROWD_GROWN_BY 0.5

/* ---- Without limits (lifted_limits.c) ---------------------------------------------------------------------------- */

/* Clusters that cost more than within their limits become one as long as it has no more bodies than this. */
#define MOST_LIFTED 128

/* ---- Is there a solution after all? (reconsider.c) --------------------------------------------------------------- */

/* Effort for a solution, in constraints looked at, for each body. Among more bodies than this none was ever found, and
 * the pairs are examined one by one. */
#define EFFORT 100000u
#define MOST_BODIES 64

/* Effort for one pair, the others staying in conflict (one_by_one.c): some milliseconds; multiplied for each unit of
 * --effort, up to a limit. Beside roads a block of dozens of houses has a solution of half a million to ten million: of
 * the undecided pairs all 7 of Neuss are solved like this, and 22 of 71 of Saint-Jean at gap 5. */
#define EFFORT_ALONE 400000u
#define MORE_EFFORT_ALONE 15
#define MORE_ALONE_UP_TO 64
/* All questions of a cluster that lead to no solution may together take this effort, plus a part for each of its
 * bodies. A grid of 600 squares without room within their limits has 1,953 pairs to be examined. */
#define POOL_ALONE 1000000000u
#define POOL_ALONE_EACH 10000u
/* The same if neither of the two has a limit: then the rule against jumps is the obstacle, and beside a yard of dozens
 * of houses all effort fails. After this many questions of a cluster in a row that ran out of effort, the effort of the
 * next is halved, and so on, down to this: of 624 pairs of a town of terraces five had an answer, and one of these was
 * useful. Of 26 that had one on real layers with roads none came after more than 3 failures. */
#define EFFORT_BRIEFLY_ALONE 50000u
#define ALONE_IN_VAIN 2
/* A cluster with more such pairs starts as if that many questions had failed: 54 crowds of terraces took 6 s until they
 * had. */
#define MANY_ALONE 64
#define MANY_IN_VAIN 5
/* Questions of a cluster that may run out of effort before fewer are asked; one that ends otherwise earns this many
 * back. */
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
/* Bodies with more pairs of pieces are not examined; nor is another pair of two bodies after this much failed work: a
 * block in the yard of another, 160,000 pairs in all, took 3 s without a result. */
#define MOST_IN_PLANE 50000u
#define EFFORT_IN_VAIN 2000000u

/* ---- What fits exactly (exact_fits.c) ---------------------------------------------------------------------------- */

/* What the search may miss, as a share of the smaller body: far below the tolerance by which a place may be off the
 * lattice (TIGHT_HAIR), far above the error of programs. And the number of failures in a row for one cluster. */
#define FIT_ROOM 0x1p-32
#define FITS_IN_VAIN 8

/* ---- Proofs of optimality (optimise.c) --------------------------------------------------------------------------- */

/* Rounds of proofs, in which groups join. */
#define OPTIMISED 24
/* The margin for a layout that is only cheaper is widened at most this many times. */
#define MOST_MARGINS_AGAIN 6
/* Steps for each body of a group at effort 1; a smaller group gets as many as one of this size; and a group whose
 * bodies have spent theirs in other groups gets a part again. */
#define STEPS_EACH 2e6
#define SMALL_GROUP 24
#define LATE 4
/* A group is tired of being shaken with patience if those that were pay for more than this share of its cost. */
#define MOSTLY_SHAKEN 0.9

/* ---- Nothing worse (uphold.c) ------------------------------------------------------------------------------------ */

/* Two moves count as equal if they differ by at most ALIKE units. Rounding accumulates that much along a pushed row. */
#define ALIKE 16
/* Bodies of a cluster that may be moved together without success: rows of a few hundred, some dozens of them. */
#define IN_VAIN 20000
/* The total size of clusters for which a margin is demanded without success: for one of 5,000 bodies a hundred
 * times. */
#define EASED_IN_VAIN 500000
/* All pairs of a cluster wait until a pinned body has settled, if it has at most this many bodies. */
#define MOST_HELD 1024
/* The progress at which this comes (../../separate_layer.c). */
#define SOUGHT 0.8

#endif
