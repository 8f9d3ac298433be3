/* These constants decide how many proofs are found and how near the lower bound comes to the cost, and never whether
 * these are right. None of them is an error bound. Effort is counted in constraints looked at; a processor looks at
 * some hundred million a second. */
#ifndef SUNDER_I_REPORT_TUNING_H
#define SUNDER_I_REPORT_TUNING_H

/* SUNDER_I_REPORT_TUNING_VERSION is the version of the values below. It is raised with each change of a value, so that
 * a record can name the values by their version (tests/house/TUNING). */
#define SUNDER_I_REPORT_TUNING_VERSION 7

/* ---- Proofs that there is no room (no_room.c) -------------------------------------------------------------------- */

/* Searches without a result may together take the effort EFFORT for all conflicts of a cluster, plus EFFORT_EACH for
 * each of its bodies. Successful searches are not counted. */
#define EFFORT 20000000u
#define EFFORT_EACH 10000u
/* ask_cluster() examines each conflict with the effort FIRST_EFFORT at first, then those without an answer with GROWTH
 * times as much, and so on, up to MOST_EFFORT. Each of these efforts is a level. */
#define FIRST_EFFORT 10000u
#define GROWTH 8
#define MOST_EFFORT 8000000u
/* No further conflicts of a cluster are examined after PROOFS_IN_VAIN conflicts in a row without an answer at the
 * second level; at each later level the number is halved. Terraces of 32 houses without room for 18 of their pairs took
 * a second each when every pair was examined with the full effort. */
#define PROOFS_IN_VAIN 32
/* If the first level gave no answer at all for at least ALL_IN_VAIN conflicts, the number for the second level is
 * PROOFS_IN_VAIN_OF_CROWD instead of PROOFS_IN_VAIN. */
#define ALL_IN_VAIN 64
#define PROOFS_IN_VAIN_OF_CROWD 8
/* At the first level the number is PROOFS_IN_VAIN_AT_FIRST: in a field of 5,000 squares without room the first level of
 * all its 17,000 conflicts took a second and a half. */
#define PROOFS_IN_VAIN_AT_FIRST 1024
/* The efforts EFFORT and MOST_EFFORT are multiplied by 1 + MORE_EFFORT times the value of --effort, which counts as at
 * most MORE_UP_TO. */
#define MORE_EFFORT 5
#define MORE_UP_TO 1000
/* At most MOST_BODIES bodies take part in a proof: no proof found in the tests had more than 20. */
#define MOST_BODIES 64
/* In the first search, a line may be short of the exact one by the share COARSE of how far the two features may move.
 * No other value was tried. */
#define COARSE 0x1p-8
/* Chains of at most REDUCED_LINKS links are made irreducible like other proofs. */
#define REDUCED_LINKS 12
/* Making a proof irreducible may take REDUCING times the effort that finding it was allowed; keep_no_room() counts that
 * effort as at least LITTLE_EFFORT. */
#define REDUCING 4
#define LITTLE_EFFORT 1000000u
/* Making the proofs irreducible that pairs of a cluster are crowded (ask_crowded()) may take the effort CROWD_REDUCING
 * in all, plus CROWD_REDUCING_EACH for each body of the cluster. One question about a crowded pair may take
 * CROWD_EFFORT. */
#define CROWD_REDUCING 20000000u
#define CROWD_REDUCING_EACH 30000u
#define CROWD_EFFORT 30000u

/* ---- Bounds of eased groups (eased_groups.c) --------------------------------------------------------------------- */

/* A group of at most MOST_EASED movable bodies gets a tree with EASED_STEPS steps for each, at effort 1; one with fewer
 * than FEWEST_EASED counts as one with that many. A bound is near enough if only the share EASED_NEAR of the
 * cost is missing. */
#define MOST_EASED 24
#define EASED_STEPS 1e7
#define FEWEST_EASED 16.
#define EASED_NEAR 0x1p-21
/* If more than the share BODIES_NEAR of the cost is missing, each body has a tree with BODY_STEPS steps. */
#define BODIES_NEAR 0x1p-10
#define BODY_STEPS 1e6
/* Prices are reduced by the share PRICE_ROOM, more than the rounding errors of their computation. A pair may lack more
 * than at the start by the share MOST_ROOM: at a few places that fit without any room no program would have a
 * solution in doubles. */
#define PRICE_ROOM 0x1p-48
#define MOST_ROOM 0x1p-14

/* ---- A pair by itself (pair_reasons.c) --------------------------------------------------------------------------- */

/* A proof that a pair by itself has no solution without a jump, or on its present sides, may have ALONE_MOST bodies,
 * most of them parts of barriers. The search for it takes at most the effort ALONE_EFFORT: some ten milliseconds. */
#define ALONE_MOST 64
#define ALONE_EFFORT 2000000u

/* ---- The lower bound (bound.c) ----------------------------------------------------------------------------------- */

/* At most SWEEPS sweeps of coordinate ascent are made. They end when a sweep moves no pair by more than the share STILL
 * of the greatest length required. The bound holds wherever they end. */
#define SWEEPS 400
#define STILL 1e-7

/* ---- What areas prove (area_bounds.c) ---------------------------------------------------------------------------- */

/* Bounds by areas are computed for parts with at least AREAS_FEWEST bodies whose other bounds prove less than the share
 * AREAS_ASKED of their cost. */
#define AREAS_FEWEST 4
#define AREAS_ASKED 0.9

/* ---- Trees for the bound of pairs (pair_trees.c, independent_parts.c) -------------------------------------------- */

/* The share SHARED of each weight is reserved for rounding. The tree of one pair may take PAIR_STEPS steps at a
 * time. */
#define SHARED 0x1p-40
#define PAIR_STEPS 1000000u
/* Trees of pairs prove less than the pairs themselves by about the share 2^-31. No trees are made if the pairs prove
 * more than groups by no more than the share TREES_SHORT. */
#define TREES_SHORT 0x1p-28

/* ---- What holds the features where they are (contact_pushes.c) --------------------------------------------------- */

/* A body is at its limit if its move is shorter than the limit by at most the share AT_LIMIT. The program for the
 * forces is solved to the share PRESSED of the longest move. */
#define AT_LIMIT 0x1p-20
#define PRESSED 1e-9

/* ---- What would free a conflict (needs.c, question.c) ------------------------------------------------------------ */

/* Bodies join a question as long as they and the bodies in it have at most NEED_MOVING features together, including the
 * pair; two bodies may always join. A question then takes some milliseconds. */
#define NEED_MOVING 8
/* If at most NEED_ALL other listed pairs are near, they have to be solved together with the conflict, at first
 * (sunder_i_ask()). */
#define NEED_ALL 1
/* No question is asked about a conflict of two blocks with more than NEED_MOST moving features in all. */
#define NEED_MOST 24
/* In a question features may move by NEED_GAPS times the required distance plus NEED_MISSING times the pair's
 * violation, beyond the pair's present move. Features within that distance take part. */
#define NEED_GAPS 4
#define NEED_MISSING 4
/* The value of --effort counts as at most NEED_EFFORT. For each unit of it, the interval between a sufficient and an
 * insufficient value is halved once, and NEED_GONE of the features in the way are removed, one at a time. */
#define NEED_EFFORT 16
#define NEED_GONE 2
/* sunder_i_find_need_gap() (need_gap.c) looks for the largest gap with a solution to within the layer's gap divided by
 * NEED_GAP_PARTS. With neighbours, proofs narrow the interval to the share NEED_GAP_AIM of that width, which leaves
 * room for NEED_LESS. If a solution in real numbers is not confirmed, halve() follows with at most NEED_GAP_HALVINGS
 * halvings for each unit of effort, and then try_gaps_between(), in which at most NEED_GAP_IN_VAIN tries for each unit
 * of effort may give no answer: with 3 of these 325 of the 331 gaps of Krems beside its roads are proved. When searches
 * alone narrowed the interval to that width, the 505 conflicts of Krems beside its roads took 1.6 times the time that
 * the layer took before. */
#define NEED_GAP_PARTS 100
#define NEED_GAP_AIM (1 - 0x1p-8)
#define NEED_GAP_HALVINGS 2
#define NEED_GAP_IN_VAIN 3u
/* narrow_gap() tries the gap at the share NEED_GAP_AT of the interval, and not its middle, since the proof that a gap
 * has no solution also excludes some smaller gaps. */
#define NEED_GAP_AT 0.6
/* A solution in real numbers keeps limits and lines up to a hair (../prove/proofs/participants.c). It is tried in
 * doubles with a gap that is smaller by the share NEED_LESS, and with moves that are shorter by the share NEED_SHORTER.
 * If it does not hold in doubles, another solution is looked for, in which pairs that may remain in conflict, and
 * whose bodies do not move alike, stand better than at the start by the share NEED_ROOM of the layer's gap. */
#define NEED_LESS 0x1p-16
#define NEED_ROOM 0x1p-20
#define NEED_SHORTER 0x1p-32
/* NEED_PROOF_EFFORT is the effort for a proof, or for a solution in real numbers, of one question. With an eighth of
 * it, a search that found nothing followed more often and took ten times as long as the proof, and ten more of 323 gaps
 * of Krems beside its roads stayed unproved. Before a search is made, the proof is repeated with NEED_PROOF_PATIENT
 * times the effort: with 1, 6 of 331 gaps of Krems, 16 of 391 of Neuss and 32 of 306 of Liechtenstein beside their
 * roads stay unproved, and with 8, 4, 7 and 19 do, for a tenth of the time or less. If all proofs of an interval get
 * that effort, 4, 7 and 14 do, and Liechtenstein takes a fifth longer. */
#define NEED_PROOF_EFFORT 240000u
#define NEED_PROOF_PATIENT 8
/* gap_of_pair() tries at most PAIR_GAP_ROUNDS gaps of a pair without neighbours. */
#define PAIR_GAP_ROUNDS 24
/* For each unit of effort, up to NEED_IN_VAIN features may take part in failed questions about one cluster, each
 * counted in every such question. This takes some seconds. */
#define NEED_IN_VAIN 200000u
/* NEED_PATIENCE questions about limits, and as many about features to remove, may fail for a cluster before fewer are
 * asked; an answer regains NEED_REGAINED of them. On real layers with roads at most 24 questions failed before one that
 * had an answer; in a town of terraces one in 16 pairs has an answer. */
#define NEED_PATIENCE 32
#define NEED_REGAINED 4
/* In a crowd with a layout that gives the limit that it needs, CROWD_PATIENCE takes the place of NEED_PATIENCE, and an
 * answer regains none. Examining all of 6,900 pairs of terraces took 23 s: 97 need less than the crowd, 1,100 have a
 * larger gap, and 600 are solved if a feature is removed. */
#define CROWD_PATIENCE 4

/* PROOF_PATIENCE searches in a row for a proof that there is no solution may fail for a cluster before fewer are made.
 * Beside roads eleven of twelve questions without a solution have such a proof, which takes a hundredth of the time of
 * the search for a solution. In a town of terraces three of 254 have one, and the searches for proofs took a third of
 * the time of all questions. */
#define PROOF_PATIENCE 8

/* sunder_i_spread_out() stretches a cluster by the share SPREAD_MARGIN more than necessary, to cover rounding. */
#define SPREAD_MARGIN 0x1p-20
/* A cluster that is stretched takes in the bodies in its way. The stretching fails if it then has more than
 * SPREAD_TIMES times its own number of bodies plus SPREAD_MOST. */
#define SPREAD_TIMES 8
#define SPREAD_MOST 256

/* ---- What stands in the way (blockers.c) ------------------------------------------------------------------------- */

/* A feature still rests against another one if their distance exceeds the gap by at most the share RESTING of the gap
 * or of the feature's size, whichever is greater. */
#define RESTING 0x1p-20

#endif
