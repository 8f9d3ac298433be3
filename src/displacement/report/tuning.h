/* Numbers of this room that are no error bounds: they decide how many proofs are found and how near the lower bound
 * comes, never whether these are right. */
#ifndef SUNDER_I_REPORT_TUNING_H
#define SUNDER_I_REPORT_TUNING_H

/* The version of these values; raised with each change of one, so that a record can name it (tests/house/TUNING). */
#define SUNDER_I_REPORT_TUNING_VERSION 2

/* ---- Proofs that there is no room (no_room.c) -------------------------------------------------------------------- */

/* Effort, in constraints looked at (some hundred million a second). Searches without a result may together take EFFORT
 * for all conflicts of a cluster, plus EFFORT_EACH for each of its bodies; successful ones are not counted. */
#define EFFORT 20000000u
#define EFFORT_EACH 10000u
/* One conflict gets FIRST_EFFORT at first; if it runs out, GROWTH times as much, and so on, up to MOST_EFFORT. At most
 * MOST_BODIES bodies take part: no proof found in the tests had more than 20. */
#define FIRST_EFFORT 10000u
#define GROWTH 8
#define MOST_EFFORT 8000000u
/* After this many conflicts of a cluster in a row without an answer at the second level of effort, no more are
 * examined; after half as many at the third level, and so on. Terraces of 32 houses without room for 18 of their pairs,
 * each pair examined with the full effort, took a second each. */
#define PROOFS_IN_VAIN 32
/* The same if the first level gave no answer at all, for at least ALL_IN_VAIN conflicts. */
#define ALL_IN_VAIN 64
#define PROOFS_IN_VAIN_OF_CROWD 8
/* And after this many without an answer at the first level: in a field of 5,000 squares without room the first level of
 * all its 17,000 conflicts took a second and a half. */
#define PROOFS_IN_VAIN_AT_FIRST 1024
/* For each unit of --effort, up to MORE_UP_TO, the effort of a cluster and of one conflict grows by this factor. */
#define MORE_EFFORT 5
#define MORE_UP_TO 1000
#define MOST_BODIES 64
/* What lines may be short by at first, as a share of how far two features may go. Tried at this value only. */
#define COARSE 0x1p-8
/* Chains of up to this many links are made irreducible like other proofs. */
#define REDUCED_LINKS 12
/* Making a proof irreducible takes no more than this many times what finding it was allowed, or a little. */
#define REDUCING 4
#define LITTLE_EFFORT 1000000u
/* Effort for all proofs together that pairs of a cluster are crowded (no_room.c), for each of its bodies, and for one
 * question. */
#define CROWD_REDUCING 20000000u
#define CROWD_REDUCING_EACH 30000u
#define CROWD_EFFORT 30000u

/* ---- A pair by itself (pair_reasons.c) --------------------------------------------------------------------------- */

/* The effort for a proof that it has no solution without a jump, or on its sides: some ten milliseconds; and how many
 * bodies may take part, most of them parts of barriers. */
#define ALONE_MOST 64
#define ALONE_EFFORT 2000000u

/* ---- The lower bound (bound.c) ----------------------------------------------------------------------------------- */

/* At most SWEEPS sweeps of coordinate ascent are made. They end when a sweep moves no pair by more than STILL of the
 * greatest length required. The bound holds wherever they end. */
#define SWEEPS 400
#define STILL 1e-7

/* ---- What areas prove (area_bounds.c) ---------------------------------------------------------------------------- */

/* Parts with at least this many bodies, and less than this share of the cost proved, are examined. */
#define AREAS_FEWEST 4
#define AREAS_ASKED 0.9

/* ---- Trees for the bound of pairs (pair_trees.c) ----------------------------------------------------------------- */

/* The share of the weights left for rounding; and the steps for each pair. */
#define SHARED 0x1p-40
#define PAIR_STEPS 1000000u
/* Trees of pairs prove less than the pairs by some 2^-31 of it: where these prove more than groups by no more than this
 * share, none are made. */
#define TREES_SHORT 0x1p-28

/* ---- What holds the features where they are (contact_pushes.c) --------------------------------------------------- */

/* A limit is reached by a move that is this share shorter; and to what share of the moves their program is solved. */
#define AT_LIMIT 0x1p-20
#define PRESSED 1e-9

/* ---- What would free a conflict (needs.c) ------------------------------------------------------------------------ */

/* Features that move in a question, including the pair: it then takes some milliseconds. */
#define NEED_MOVING 8
/* Up to this many other remaining pairs are at first to be solved, too. */
#define NEED_ALL 1
/* No questions about larger blocks. */
#define NEED_MOST 24
/* They may move this many gaps plus this many times the pair's violation, and features within that distance take
 * part. */
#define NEED_GAPS 4
#define NEED_MISSING 4
/* For each unit of effort, up to NEED_EFFORT, the interval between a sufficient and an insufficient value is halved
 * once, and NEED_GONE of the features in the way are removed, one at a time. */
#define NEED_EFFORT 16
#define NEED_GONE 2
/* A gap that has a solution is looked for to within this part of the gap asked for. Where neighbours are about, proofs
 * narrow it to this share of that, which leaves room for NEED_LESS. Where a solution of reals is not confirmed,
 * halvings follow, no more than these for each unit of effort: with searches alone, to the same width, the 505
 * conflicts of Krems beside its roads took 1.6 times as long as that layer did before. */
#define NEED_GAP_PARTS 100
#define NEED_GAP_AIM (1 - 0x1p-8)
#define NEED_GAP_HALVINGS 2
/* The next gap that is asked about lies at this share of the way from the least to the most that the largest gap may
 * be: the proof that a gap has no solution also excludes some smaller gaps. */
#define NEED_GAP_AT 0.6
/* A solution of reals keeps limits and lines up to a hair (../prove/proofs/participants.c). It is tried in doubles with
 * a gap that is smaller by the first share, and with moves that are shorter by the second. */
#define NEED_LESS 0x1p-16
/* Pairs that may stay as they stood are held to this share of the gap more, if the solution of reals without it does
 * not hold in doubles. */
#define NEED_ROOM 0x1p-20
#define NEED_SHORTER 0x1p-32
/* Effort for a proof, or a solution of reals, for one question. With an eighth of it a search that found nothing
 * followed more often, which took ten times as long as the proof, and ten more of 323 gaps of Krems beside its roads
 * stayed unproved. */
#define NEED_PROOF_EFFORT 240000u
/* Moves of two features by themselves that are examined for it. */
#define PAIR_GAP_ROUNDS 24
/* For each unit of effort, the features that may take part in failed questions about a cluster: seconds. */
#define NEED_IN_VAIN 200000u
/* Failed questions about limits, or about features to remove, for a cluster before fewer are asked; one with an answer
 * earns NEED_REGAINED back. On real layers with roads at most 24 failed before one that had an answer; in a town of
 * terraces one in 16 pairs has one. */
#define NEED_PATIENCE 32
#define NEED_REGAINED 4
/* The same for a crowd whose layout gives the limit that it needs; answers earn nothing back there. Before, all of
 * 6,900 pairs of terraces were examined, in 23 s: 97 need less than the crowd, 1,100 have a larger gap, and 600 are
 * solved if a feature is removed. */
#define CROWD_PATIENCE 4

/* Failed searches, in a row for a cluster, for proofs that there is no solution, before fewer are made. Beside roads
 * eleven of twelve questions without a solution have such a proof, and it takes a hundredth of the search. In a town of
 * terraces three of 254 have, and the searches took a third of the time of all questions. */
#define PROOF_PATIENCE 8

/* A cluster is stretched by this share more than necessary (spread_out.c), to cover rounding. */
#define SPREAD_MARGIN 0x1p-20
/* It includes at most this many times its bodies, and this many. */
#define SPREAD_TIMES 8
#define SPREAD_MOST 256

/* ---- What stands in the way (blockers.c) ------------------------------------------------------------------------- */

/* Two features still rest against each other if their distance exceeds the gap by at most RESTING times the gap or a
 * feature's size (the greater). */
#define RESTING 0x1p-20

#endif
