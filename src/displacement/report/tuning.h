/* Numbers of this room that are no error bounds: they decide how many proofs are found and how near the lower bound
 * comes, never whether these are right. */
#ifndef SUNDER_I_REPORT_TUNING_H
#define SUNDER_I_REPORT_TUNING_H

/* ---- Proofs that there is no room (no_room.c) -------------------------------------------------------------------- */

/* Effort, in constraints looked at (some hundred million a second). Searches that found no proof may take so much
 * together for all conflicts of a cluster, and so much for each of its bodies; what found one is not counted. */
#define EFFORT 20000000u
#define EFFORT_EACH 10000u
/* One conflict is allowed so much at first, if all that ends it is its effort eight times as much then, and so on, up
 * to the most. No more bodies than these take part in one: of all proofs found in the tests none had more
 * than 20. */
#define FIRST_EFFORT 10000u
#define GROWTH 8
#define MOST_EFFORT 8000000u
/* After so many of a cluster, one after the other, of which more than the first effort tells nothing, no more are asked
 * about; after half as many, where that is eight times as much again, and so on. Terraces of 32 houses that have no
 * room for 18 of their pairs, each pair asked to the end of all effort, took a second each. */
#define PROOFS_IN_VAIN 32
/* The same where the first effort told nothing of all, if they are so many. */
#define ALL_IN_VAIN 64
#define PROOFS_IN_VAIN_OF_CROWD 8
/* And after so many of which the first effort tells nothing: in a field of 5,000 squares that have nowhere to go the
 * first effort of all its 17,000 conflicts took a second and a half. */
#define PROOFS_IN_VAIN_AT_FIRST 1024
/* For each unit of --effort, up to so many, a cluster and one conflict are allowed so many times as much more. */
#define MORE_EFFORT 5
#define MORE_UP_TO 1000
#define MOST_BODIES 64
/* What lines may be short by at first, as a share of how far two features may go. Tried at this value only. */
#define COARSE 0x1p-8
/* Chains of up to so many links are made irreducible as other proofs are. */
#define REDUCED_LINKS 12
/* Making a proof irreducible takes no more than this many times what finding it was allowed, or a little. */
#define REDUCING 4
#define LITTLE_EFFORT 1000000u
/* Of all proofs together that pairs of a cluster are of a crowd (no_room.c) no more than this, and so much for each of
 * its bodies; of one question so much. */
#define CROWD_REDUCING 20000000u
#define CROWD_REDUCING_EACH 30000u
#define CROWD_EFFORT 30000u

/* ---- A pair by itself (pair_reasons.c) --------------------------------------------------------------------------- */

/* The effort for a proof that it has no solution without a jump, or on its sides: some ten milliseconds; and how many
 * bodies may take part, most of them parts of barriers. */
#define ALONE_MOST 64
#define ALONE_EFFORT 2000000u

/* ---- The lower bound (bound.c) ----------------------------------------------------------------------------------- */

/* Sweeps of coordinate ascent, and the share of the lengths that a sweep has to move the solution by to go on: the
 * bound holds wherever it ends. */
#define SWEEPS 400
#define STILL 1e-7

/* ---- What areas prove (area_bounds.c) ---------------------------------------------------------------------------- */

/* Parts of so many bodies at least are asked, of which less than this share of the cost is proved. */
#define AREAS_FEWEST 4
#define AREAS_ASKED 0.9

/* ---- Trees for the bound of pairs (pair_trees.c) ----------------------------------------------------------------- */

/* So much of the weights is left over, for rounding; steps for each pair. */
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

/* So many features move in a question at most, the two apart: it takes some milliseconds then. */
#define NEED_MOVING 8
/* Up to so many pairs that are left besides are first asked to be solved, too. */
#define NEED_ALL 1
/* Nothing is asked about larger blocks. */
#define NEED_MOST 24
/* They may go so many gaps and so many times what the pair lacks, and who stands within that takes part. */
#define NEED_GAPS 4
#define NEED_MISSING 4
/* For each unit of effort, up to so many, what lies between what does and what does not is halved once, and so many of
 * those in the way are let go by turns. */
#define NEED_EFFORT 16
#define NEED_GONE 2
/* A gap that would do is looked for to within this part of the gap asked for. Where neighbours are about, proofs narrow
 * it to that. Searches narrow it further only where a solution of reals was not confirmed, and then by no more halvings
 * than these for each unit of effort: with searches alone, to the same width, the 505 conflicts of Krems beside its
 * roads took 1.6 times as long as that layer did before. */
#define NEED_GAP_PARTS 100
#define NEED_GAP_HALVINGS 2
/* The next gap that is asked about lies at this share of the way from the least to the most that the largest gap may
 * be: the proof that a gap has no solution also excludes some smaller gaps. */
#define NEED_GAP_AT 0.6
/* A solution of reals keeps limits and lines up to a hair (../prove/proofs/participants.c). It is tried in doubles with
 * a gap that is smaller by the first share, and with moves that are shorter by the second. */
#define NEED_LESS 0x1p-16
#define NEED_SHORTER 0x1p-32
/* So many moves of two features by themselves are looked at for it. */
#define PAIR_GAP_ROUNDS 24
/* For each unit of effort so many features may take part in questions about a cluster that are in vain: seconds. */
#define NEED_IN_VAIN 200000u
/* So many pairs of a cluster are asked in vain what limit they need, or whose leaving, before fewer of them are; one
 * that has an answer makes good so many. On real layers with roads no more than 24 were asked in vain before one that
 * had an answer; of a town of terraces one in 16 pairs has one. */
#define NEED_PATIENCE 32
#define NEED_REGAINED 4
/* The same of a crowd of which a layout tells what limit it needs, where answers make good nothing. Of 6,900 pairs of
 * terraces all were asked before, in 23 s: 97 do with less than the crowd, 1,100 with a larger gap, and 600 if somebody
 * leaves. */
#define CROWD_PATIENCE 4

/* So many proofs that there is no solution are looked for in vain, of a cluster and one after the other, before fewer
 * are. Beside roads eleven of twelve questions without a solution have one, and it takes a hundredth of the search; of
 * a town of terraces three of 254, and to look for them took a third of all time that questions took. */
#define PROOF_PATIENCE 8

/* By so much more than has to be, as a share, a cluster is stretched (spread_out.c): what roundings take. */
#define SPREAD_MARGIN 0x1p-20
/* It takes so many times its bodies with it, and so many. */
#define SPREAD_TIMES 8
#define SPREAD_MOST 256

/* ---- What stands in the way (blockers.c) ------------------------------------------------------------------------- */

/* Two that are apart by the gap and this share of the gap or of a feature's size still rest against each other. */
#define RESTING 0x1p-20

#endif
