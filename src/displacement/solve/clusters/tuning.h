/* These constants decide how good a result is and how long it takes to find, and never whether a statement about it is
 * true. None of them is an error bound. Effort is counted in constraints looked at; a processor looks at some hundred
 * million a second. */
#ifndef SUNDER_I_CLUSTERS_TUNING_H
#define SUNDER_I_CLUSTERS_TUNING_H

/* SUNDER_I_CLUSTERS_TUNING_VERSION is the version of the values below. It is raised with each change of a value, so
 * that a record can name the values by their version (tests/house/TUNING). */
#define SUNDER_I_CLUSTERS_TUNING_VERSION 11

/* ---- Rounds (settle.c, clusters.c) ------------------------------------------------------------------------------- */

/* A cluster's margin grows fourfold each time, at most MOST_MARGINS times: by 28 bits, which leaves half of the bits of
 * a double. */
#define MOST_MARGINS 14
/* After r rounds sunder_i_solver_settle() reports the progress 1 - 1 / (1 + SHARE_OF_ROUND r) of its part, since few
 * layers need more than some rounds. */
#define SHARE_OF_ROUND 0.25
/* reserve_clusters() allocates room for all edges and one in SPARE_ROOM more, since a round adds few edges. */
#define SPARE_ROOM 8

/* ---- Coarse moves (coarse_bodies.c, held_or_free.c) -------------------------------------------------------------- */

/* A body is held beside a neighbour if its last place is coarser than the neighbour's by at least COARSE_BITS bits and
 * COARSE_PLACES of its last places exceed the neighbour's size and gap, or by at least BEYOND_BITS bits and it has a
 * coordinate beyond 2^BEYOND_EXPONENT. Projected coordinates in metres are below 2^25, so a coordinate beyond 2^27 is
 * coarser by BEYOND_BITS or more. COARSE_PLACES last places are too many for a house of 10 m beside a vertex at 1e16,
 * and not at 1e15. In metres and feet no place on the Earth has a coordinate beyond 2^27. Without that rule, chains of
 * houses beside a vertex at 1e12 cost up to 360 times what they cost beside the same body declared fixed. */
#define COARSE_BITS 10
#define COARSE_PLACES 64
#define BEYOND_EXPONENT 27
#define BEYOND_BITS 3
/* A body counts as thrown if it moves farther than it does beside a held neighbour, by more than THROWN times its size
 * and the gap. */
#define THROWN 16

/* ---- Crowds (clusters.c, grow_crowds.c) -------------------------------------------------------------------------- */

/* A crowd of at least CROWD bodies without limits starts at the positions that prices of area give. For 7,650 symbols
 * in Germany it makes no difference if crowds of a dozen do so, too. */
#define CROWD 40
/* A crowd starts so again when it has run into other bodies: a crowd of at most LARGE_GROWN_CROWD bodies whenever it
 * has grown, a larger one when it has doubled. When every crowd started again only after doubling, Germany's symbols
 * cost 6 % more and Europe's 8 %. Italy's crowd of 4,370 bodies costs no less if it starts again whenever it has grown,
 * and takes half as much time again. */
#define LARGE_GROWN_CROWD 1000
/* Crowds of more than LARGE_GROWN_CROWD bodies absorb the bodies that they will run into, in at most CROWDS_GROWN
 * passes, before they are solved. A body counts as larger by the share CROWD_GROWN_BY of its size on every side there,
 * since approximate places are no more accurate. Among Italy's symbols, a crowd of 1,750 runs into 2,900 others in the
 * end; it absorbs 1,400 of them in advance with a share of a quarter, and 2,650 with a half. */
#define CROWDS_GROWN 8
#define CROWD_GROWN_BY 0.5

/* ---- Without limits (lifted_limits.c) ---------------------------------------------------------------------------- */

/* Clusters that cost more than within their limits become one cluster as long as it has at most MOST_LIFTED bodies. */
#define MOST_LIFTED 128

/* ---- Is there a solution after all? (reconsider.c, one_by_one.c) ------------------------------------------------- */

/* The search for a solution of n bodies takes at most the effort EFFORT for each. No solution was ever found among more
 * than MOST_BODIES bodies; such pairs are examined one by one. */
#define EFFORT 100000u
#define MOST_BODIES 64

/* One question about one pair, while the others stay in conflict (one_by_one.c), takes at most the effort EFFORT_ALONE:
 * some milliseconds. It is multiplied by 1 + MORE_EFFORT_ALONE times the value of --effort, which counts as at most
 * MORE_ALONE_UP_TO. A block of dozens of houses beside roads takes half a million to ten million for a solution. All 7
 * undecided pairs of Neuss are solved like this, and 22 of 71 of Saint-Jean at gap 5. */
#define EFFORT_ALONE 400000u
#define MORE_EFFORT_ALONE 15
#define MORE_ALONE_UP_TO 64
/* All questions of a cluster that lead to no solution may together take the effort POOL_ALONE, plus POOL_ALONE_EACH for
 * each of its bodies. A grid of 600 squares without room within their limits has 1,953 pairs to examine. */
#define POOL_ALONE 1000000000u
#define POOL_ALONE_EACH 10000u
/* A question about two bodies without limits takes at most EFFORT_BRIEFLY_ALONE: the rule against jumps is the obstacle
 * then, and beside a yard of dozens of houses all effort fails. After ALONE_IN_VAIN questions of a cluster in a row
 * that ran out of effort, the effort of each further one is halved, down to EFFORT_BRIEFLY_ALONE. Five of 624 pairs of
 * a town of terraces had an answer, and one of these was useful. Of 26 pairs that had one on real layers with roads,
 * none came after more than 3 failures. */
#define EFFORT_BRIEFLY_ALONE 50000u
#define ALONE_IN_VAIN 2
/* A cluster with more than MANY_ALONE such questions starts as if MANY_IN_VAIN of them had run out of effort. Before,
 * 54 crowds of terraces took 6 s until that many had. */
#define MANY_ALONE 64
#define MANY_IN_VAIN 5
/* ALONE_PATIENCE questions of a cluster may run out of effort before fewer are asked. A question that ends otherwise
 * regains ALONE_REGAINED of them. */
#define ALONE_PATIENCE 8
#define ALONE_REGAINED 4
/* A pair that is solved by itself keeps MARGINS times the margin of its cluster. */
#define MARGINS 4

/* ---- Bodies that a margin alone has moved (in_contact.c) --------------------------------------------------------- */

/* A move of at most HARDLY margins may be due to margins: those of a chain of neighbours add up. */
#define HARDLY 64

/* ---- Lone bodies (lone_bodies.c) --------------------------------------------------------------------------------- */

/* A question about a conflict of a lone body takes at most the effort LONE_EFFORT. In 12,500 drawn worlds of up to four
 * barriers none took more than 200,000. Barriers no farther from the body than its size take part at first; this
 * length is multiplied by LONE_GROWTH, and there are at most LONE_REACHES questions. */
#define LONE_EFFORT 4000000u
#define LONE_GROWTH 8
#define LONE_REACHES 4
/* A lone body that is in no conflict tries at most NEARER_PLACES places that are free without a margin and nearer by a
 * share of NEARER or more. A smaller share is the margin itself. */
#define NEARER_PLACES 8 /* fixed: the size of an array */
#define NEARER 0x1p-20

/* ---- Questions about one conflict (spared_pairs.c) --------------------------------------------------------------- */

/* sunder_i_solver_prove() looks for proofs before a solution is looked for, with the effort EFFORT_BRIEFLY in all,
 * unless its caller gives another effort. This is about what one conflict of a small layer takes that has a solution.
 * Searches without a solution that might be spared take no longer. */
#define EFFORT_BRIEFLY 30000u

/* ---- Two bodies that are shut in (shut_in_conflicts.c) ----------------------------------------------------------- */

/* Each half-plane that the relative move of the two bodies must satisfy may demand less than the exact one, by the
 * share COARSE_IN_PLANE of the limits of the two: one line can then replace several, so proofs are smaller, and few
 * are missed. */
#define COARSE_IN_PLANE 0x1p-8
/* Two bodies with more than MOST_IN_PLANE pairs of pieces are not examined. Nor is another pair of the same two bodies
 * examined after failed work of EFFORT_IN_VAIN: a block in the yard of another, 160,000 pairs in all, took 3 s without
 * a result. */
#define MOST_IN_PLANE 50000u
#define EFFORT_IN_VAIN 2000000u

/* ---- What fits exactly (exact_fits.c) ---------------------------------------------------------------------------- */

/* The search for an exact fit may miss the required distance by the share FIT_ROOM of the smaller body. This is far
 * below the tolerance by which a place may be off the lattice (TIGHT_HAIR of prove/optimum), and far above the error of
 * programs. After FITS_IN_VAIN failures in a row no more pairs of a cluster are tried. */
#define FIT_ROOM 0x1p-32
#define FITS_IN_VAIN 8

/* ---- Proofs of optimality (optimise.c, contact_groups.c) --------------------------------------------------------- */

/* At most OPTIMISED rounds of proofs are made. Groups may join between rounds. */
#define OPTIMISED 24
/* The margin for a layout that is cheaper, but fails because of rounding, is widened at most MOST_MARGINS_AGAIN
 * times. */
#define MOST_MARGINS_AGAIN 6
/* A group gets STEPS_EACH steps for each of its movable bodies at effort 1. A group with fewer than SMALL_GROUP of
 * these gets as many steps as one of SMALL_GROUP bodies. Steps that bodies have spent in other groups are subtracted,
 * but each body gets at least one in LATE of its steps (steps_allowed()). */
#define STEPS_EACH 2e6
#define SMALL_GROUP 24
#define LATE 4
/* A group is not perturbed with patience again if the bodies that already were have more than the share MOSTLY_SHAKEN
 * of its cost. */
#define MOSTLY_SHAKEN 0.9

/* ---- Nothing worse (uphold.c) ------------------------------------------------------------------------------------ */

/* Two moves count as equal if they differ by at most ALIKE units: rounding accumulates that much along a pushed row. */
#define ALIKE 16
/* In attempts without success, up to IN_VAIN bodies of a cluster may be moved together: some dozens of rows of a few
 * hundred bodies. */
#define IN_VAIN 20000
/* A margin is demanded without success for clusters of at most EASED_IN_VAIN bodies in total: a hundred times for a
 * cluster of 5,000 bodies. */
#define EASED_IN_VAIN 500000
/* All pairs of a cluster wait until a pinned body has settled, if the cluster has at most MOST_HELD bodies. */
#define MOST_HELD 1024
/* SOUGHT is the progress that is reported while this stage runs (../../separate_layer.c). */
#define SOUGHT 0.8

/* ---- Springs of rows (contact_flood.c) --------------------------------------------------------------------------- */

/* A spring whose ends moved by vectors that differ by at most this share of the gap connects no contact groups; the
 * cost of such springs is not part of a bound. */
#define SLACK_SPRING 2e-4

/* ---- Easing (ease.c) --------------------------------------------------------------------------------------------- */

/* A cluster that the exact check refuses is eased at most MOST_PINNINGS times more, each time with one pair more left
 * as it is. */
#define MOST_PINNINGS 8
/* Bodies in the way join clusters in at most MOST_JOININGS - 1 rounds; with a full gap, where every pair may be short,
 * in at most MOST_JOININGS_OF_TIGHT - 1. Clusters that nothing has joined are not eased again. */
#define MOST_JOININGS 6
#define MOST_JOININGS_OF_TIGHT 24
/* A cluster of at most MOST_STARTED movable bodies is eased from at most MOST_STARTS other starts, which its tree finds
 * in STARTED_STEPS steps for each body, at effort 1 (eased_starts.c). The tree looks for layouts that are cheaper by
 * the share START_NEAR. */
#define MOST_STARTED 24
#define MOST_STARTS 8
#define STARTED_STEPS 1.5e6
#define START_NEAR 0x1p-12

#endif
