/* Numbers of this room that are not error bounds: they decide how good a result is and how long it takes to find, never
 * whether statements about it are true. "On real layers" means the benchmark layers of the project
 * (tests/bench/layers.sh), on which they were tuned. Where nothing is said of a number, only what it balances is
 * known. */
#ifndef SUNDER_I_SEARCH_TUNING_H
#define SUNDER_I_SEARCH_TUNING_H

/* The version of these values; raised with each change of one, so that a record can name it (tests/house/TUNING). */
#define SUNDER_I_SEARCH_TUNING_VERSION 2

/* ---- One descent (descend.c) ------------------------------------------------------------------------------------- */

/* Total rounds: far more than a descent takes, which converges or gives up earlier. */
#define MOST_ROUNDS 40
/* Rounds with a clash before a descent gives up, and the number of them that fail to halve the violation:
 * contradictions are solved by jumps, and more rounds only move the bodies about. */
#define MOST_CLASHING 12
#define MOST_IDLE 3
/* The softness of a program with clashes, relative to masses: its first value, the divisor after each round that
 * clashes, and its last value. It falls, so that long chains of contacts are not mistaken for contradictions. */
#define SOFT 1e-3
#define HARDENING 5
#define HARDEST 1e-6
/* From a free position rounds gain less and less: a goal farther than this many times the last gain is out of reach. */
#define HOPEFUL 4
/* A free place keeps at most this share more than is owed (CORNER_TURN of geometry/), plus a hair. */
#define KEPT_TOO_MUCH 0.02
/* How often constraints are added to one program; less often to a soft one, whose solution is not final. */
#define MOST_ADDITIONS 24
#define MOST_SOFT_ADDITIONS 4
/* Two lines of one pair count as one if their normals differ by at most this: those of pieces cut from one wall differ
 * by rounding. If two truly differ, the constraint left out is found when the solution violates it. */
#define SAME_NORMAL 1e-7
/* A limit of moves counts as exceeded from this share of it on, at least. */
#define LIMIT_SLACK 1e-12
/* Two tangents whose normals have a greater cosine count as one: between them the limit is exceeded by at most that
 * share. */
#define SAME_TANGENT (1 - 0x1p-40)
/* Programs are solved to the tolerance / SOLVED_TO. Soft programs are solved to COMPROMISE_TO of the gap or of a
 * small part of a body (the greater): a compromise need not be exact. */
#define SOLVED_TO 8
#define COMPROMISE_TO 1e-4
/* A solved program with a few more constraints is repaired around these, if that raises the cost by at most this part
 * of what counts as settled. */
#define PART_OF_SETTLED 4
/* A small part of a body: its extent divided by this. Pieces within this distance are included beforehand. */
#define SMALL_PART 50
/* The violation that long chains leave of hard constraints is demanded in addition, multiplied by CORRECTION, up to
 * MOST_CORRECTIONS times. */
#define CORRECTION 1.5
#define MOST_CORRECTIONS 4
/* A hard program that violates more than this share of sizes has no solution. */
#define NO_SOLUTION 1e-3
/* A compromise that violates at most this share of the moves' length may have a full solution. */
#define NEARLY_SOLVED 0.03
/* If a path is free up to some point, it is followed for JUST_BEFORE of the way there. */
#define JUST_BEFORE 0.999
/* In a crowd with more movable bodies a small part is larger: programs with all constraints that bodies might meet
 * allow less, but need not be solved again for each violation. 1,750 of Italy's places, in the first descent: with 50,
 * 1.4e9 steps to 3.14e11 m2, with 10 0.8e9 to 3.06, with 4 0.5e9 to 3.03, with 1.5 0.3e9 to 3.10. */
#define LARGE_CROWD 500
#define PART_OF_CROWD 3
/* A larger crowd, without limits, looks farther still, since each further constraint costs another solution. It
 * descends coarsely first: violations below ROUGHLY of a body are ignored, and a round that gains less than
 * ROUGHLY_SETTLED is the last. It follows its path, except for NOT_LED rounds after a round where that failed. 4,400 of
 * Italy's places took 43 programs to reach 4.68e11 m2, and 94 in all to 4.61e11; like this, 67 in all to 4.50e11.
 * Within limits 5,041 squares took five times as long, and nearly all of them stayed in place. */
#define LARGE_CROWD_LED 1000
#define PART_OF_LARGE_CROWD 1.5
#define ROUGHLY 1e-3
#define ROUGHLY_SETTLED 4e-3
#define NOT_LED 2
/* The next round looks STEPS_AHEAD times as far as the longest step of this one, and at least the gap divided by
 * LEAST_REACH. */
#define STEPS_AHEAD 1.5
#define LEAST_REACH 8
/* A round that gains less than this share of the cost is the last; a search for better sides goes on for smaller gains,
 * and one for a proof of optimality for smaller ones still. */
#define SETTLED 1e-3
#define SETTLED_BETTER 1e-5
#define SETTLED_BEST 1e-9
/* A search for better sides ends when it comes back to within this share of a body from where it began. */
#define BACK 1e-8
/* How often the margin beyond the least translation of a pair is doubled (lone_pair.c). */
#define MOST_LENGTHENED 4
/* Descents after jumps, before pairs are given up. */
#define MOST_JUMPS 3 /* fixed: in a table */

/* Capacity for constraints on the stack (constrain.c). */
#define FEW_KNOWN 32 /* fixed: the size of an array */

/* ---- Neighbours (near.c) ----------------------------------------------------------------------------------------- */

/* Capacity for sorting bodies on the stack. */
#define FEW_BODIES 64 /* fixed: the size of an array */

/* ---- Pieces that face each other (piece_pairs.c) ----------------------------------------------------------------- */

/* Parts of one body examined in one pass, and the most pieces of the other listed beforehand: both are kept on the
 * stack. */
#define PARTS_AT_ONCE 32 /* fixed: the size of an array */
#define MOST_FACING 256  /* fixed: the size of an array */
/* Below this number listing beforehand gains nothing. */
#define FEW_PARTS 12

/* ---- What pairs miss (measures.c) -------------------------------------------------------------------------------- */

/* Slots of the cache: for each body, and the least and the greatest total; usually some dozen kilobytes. */
#define MEASURES_EACH 8
#define FEWEST_MEASURES 64
#define MOST_MEASURES 4096

/* ---- Pairs given up (give_up.c) ---------------------------------------------------------------------------------- */

/* In a connected set of clashes, those are given up first that miss at least FIRST_SHARE of what the worst misses; then
 * a share smaller by the factor MORE each time. */
#define FIRST_SHARE 0.5
#define MORE 1.5
/* Rounds with a clash before a later descent gives up, outside crowds: the compromise is near. Blocks of 32 houses take
 * a fifth less total time with 2 than with twelve, and leave 728 pairs of a town instead of 764. */
#define CLASHING_AGAIN 2
/* Giving up may take GIVE_UP_TIMES the previous work of the search, all but the first round up to GIVE_UP_MOST, plus
 * one descent. A crowd of 70 houses between two roads takes three descents as expensive as all before to find which 24
 * of its 150 conflicts to give up; if the last of them is cut short all are. So a crowd may take GIVE_UP_OF_CROWD,
 * whatever it took before: a hundred symbols, a tenth of them without room, take a dozen descents, most of which fail,
 * and those are the expensive ones. (Cut short, 700 pairs were given up there instead of 13, and asking for them again
 * took longer in the end.) */
#define GIVE_UP_TIMES 8
#define GIVE_UP_MOST 400000000u
#define GIVE_UP_OF_CROWD 1600000000u
/* A crowd starts from the solutions of its parts if at most one pair in this many clashes there. */
#define FEW_LEFT 3
/* From there the set that is given up grows by rings of neighbours around the clashes. */
#define MOST_RINGS 8
/* In a crowd of at least this many bodies a descent takes more than retries (retry_cluster.c) may; in smaller clusters
 * retries do better. What the descent gave up is asked for again with TAKE_BACK_EACH for each pair of bodies, and
 * TAKE_BACK_MOST in all. With less, or more, for each a crowd of 70 houses ends with up to half as many pairs again
 * given up. */
#define CROWD 48
#define TAKE_BACK_EACH 8000000u
#define TAKE_BACK_MOST 200000000u
/* Pairs are first asked for together with this many bodies around them, until TAKE_BACK_FEW_IN_VAIN in a row fail; then
 * with the whole cluster, until TAKE_BACK_IN_VAIN fail; the rest is left to retries. Of ten crowds in a town of
 * terraces the whole alone granted 85 of 263 for 1e9 steps, few alone 128 of 259 for 5e7. But of the crowds of Germany
 * within 12 km few alone leave 715 symbols, few and then the whole 20. (After 8 failures instead of 2: 22; and 656
 * pairs of the terraces instead of 665, in a third more total time.) */
#define TAKE_BACK_FEW 32
#define TAKE_BACK_FEW_IN_VAIN 32
#define TAKE_BACK_IN_VAIN 2
/* Lines between bodies are recomputed once the two have moved this far, as a share of the greatest violation; a body
 * beside the path by less than PUSHED_BESIDE is not pushed (pushed.c). */
#define PUSHED_STALE 0.125
#define PUSHED_BESIDE 1e-9
/* Obstacles in one direction are surveyed once failed questions have looked at this many times as many of them
 * (pushed_in_vain.c). For 5,041 squares pushing looks at 640 million lines without it, 520 with 1, 330 with 2, 250 with
 * 8. */
#define PUSHED_SURVEY 8
/* Violations of the pairs that are pushed: first up to the greatest divided by PUSHED_FIRST, then larger by the factor
 * PUSHED_LEVELS each time. */
#define PUSHED_FIRST 8
#define PUSHED_LEVELS 1.2
/* Work for pushing, and for each body: in a grid of 20,000 most pairs reach thousands of others without success. */
#define PUSHED_MOST 100000000u
#define PUSHED_EACH 40000u
/* A crowd that has more than this share given up after pushing has almost no room: grids of squares keep two in three,
 * symbols one in ten, and for the latter a compromise tells better what to give up. If nothing else was tried yet, the
 * share has to be greater: grids of thousands keep four in five. Pushing is repeated as long as it takes back more than
 * one in LEAST_PUSHED of the rest. */
#define LEFT_BY_PUSHING 0.5
#define LEFT_AT_HOME 0.75
#define LEAST_PUSHED 64
/* If a level takes back at most one in this many, all remaining pairs are asked for at once. A grid of 20,000 was asked
 * six times more for 35 of 60,000 pairs, in a sixth of the total time. */
#define LEAST_OF_LEVEL 1024
/* Moves up to this share of a body are residues of descents and count as none. */
#define NEARLY_HOME 1e-7

/* ---- Where there is room (free_positions.c) ---------------------------------------------------------------------- */

/* With more pairs of pieces than this, the exact search for two shapes is quicker than an obstacle for each pair. */
#define MANY_PAIRS 1500
/* With this many pieces around, times its own, a body looks for a place as its members' outlines. */
#define MANY_AROUND 5000
/* ... and considers shadows only of pairs of bodies with fewer pieces than this. */
#define MANY_SHADOWS 32
/* The cost of an obstacle, in constraints looked at. */
#define OBSTACLE_WORK 16
/* Two shapes that overlap by at most this part of the smaller one are separated by the exact search, whose cost grows
 * with the depth. */
#define SHALLOW 0.1
/* The first radius for obstacles around a place of a pair, as a part of the smaller body; then larger by the factor
 * PAIR_GROWTH each time. */
#define PAIR_REACH 0.05
#define PAIR_GROWTH 3
/* The same for a body among all. */
#define BODY_REACH 0.1
#define BODY_GROWTH 2
/* A distance beyond everything, as a multiple of the total size. */
#define BEYOND_ALL 4
/* Where jumps are not allowed, the visible part of the plane between a body's neighbours narrows with the distance:
 * places are searched up to this many times the body, or the mean body of the cluster, plus the gap. */
#define FARTHEST_LEAP 8

/* ---- Away from one another (spread.c) ---------------------------------------------------------------------------- */

/* The shares of the way from the centre that are tried, from LEAST_SPREAD to MOST_SPREAD, each twice the one before.
 * From ENOUGH_SPREAD on, bodies that still clash look for a place by themselves. */
#define LEAST_SPREAD 0x1p-5
#define MOST_SPREAD 8
#define ENOUGH_SPREAD 0.5

/* ---- A few bodies by themselves (neighbourhood.c), and the whole (retry_cluster.c) ------------------------------- */

/* The work of a descent, in constraints looked at (some hundred million a second), and for each body; smaller where it
 * only makes a solution cheaper. With the latter a crowd of 1,500 houses takes 9.4 s instead of 11.4, and ends no more
 * expensive. */
#define PATIENCE 200000u
#define PATIENCE_EACH 1500u
/* The work of searching for room: two blocks of hundreds of pieces, one in the other's yard, would search all their
 * surroundings without success. */
#define LEAP_PATIENCE 4000000u
#define SHORT_PATIENCE 20000u
#define SHORT_PATIENCE_EACH 600u

/* Two bodies whose moves agree to this part of the tolerance are not compared again. */
#define TOGETHER 64
/* Tiny violations are repaired in this many rounds (descend.c), which may take this many times the work. */
#define MOST_MENDING 4
#define MENDING_TIMES 16

/* ---- Pairs asked once more (retry_cluster.c) --------------------------------------------------------------------- */

/* How many bodies may move at each stage, before all may: fourfold, since one more stage then costs a quarter of the
 * next. A cluster of at most FEW is tried as a whole at once. */
#define RETRY_STAGES                                                                                                   \
    {                                                                                                                  \
        2, 8, 32, 128                                                                                                  \
    }
#define FEW 8
/* Effort, in constraints looked at: for a cluster, for each of its bodies, and for each pair asked for, up to
 * MOST_RETRIES pairs. (With 50 of these 1,200 houses in terraces end with 1,094 pairs left instead of 753.) */
#define RETRY_EFFORT 2000000u
#define RETRY_EFFORT_EACH 5000u
#define RETRY_EFFORT_PAIR 200000u
#define MOST_RETRIES 1000
/* After this many failures in a row, no further pair is tried with that number of movable bodies. In a layer of lanes
 * that are too narrow (bench_layer lanes 4000) 400 million steps went into such questions. */
#define RETRIES_IN_VAIN 32
/* If more than FEW_RETRIES are to be tried and none succeeded at the previous stage, one in SHARE_OF_RETRIES is. */
#define FEW_RETRIES 64
#define SHARE_OF_RETRIES 24
/* Nor is any pair tried at a stage after failed work of WORK_IN_VAIN or, if that is more, all effort divided by
 * SHARE_IN_VAIN. Of 54 crowds of terraces, with a hundred pairs each, almost none succeeded with dozens of movable
 * bodies. */
#define WORK_IN_VAIN 2000000u
#define SHARE_IN_VAIN 8
/* Overlaps are separated at the expense of other pairs in clusters with at most this many movable bodies. */
#define MOST_TRADING 64

/* ---- What fits exactly (fit_given_up.c) -------------------------------------------------------------------------- */

/* How many bodies may move at each stage: at most the number for which exact places are searched (TIGHT_MOST). */
#define FIT_STAGES                                                                                                     \
    {                                                                                                                  \
        2, 8, 16                                                                                                       \
    }

/* ---- A crowd with few clashes (mend_few.c) ----------------------------------------------------------------------- */

/* A large crowd with at most one clash for this many bodies; each clash is then settled with this many bodies around
 * it. */
#define FEW_CLASHES 64
/* A larger crowd is not solved as a whole again for a body that was sent back: for 20,000 squares each time took 150 s,
 * and there were several. For 5,041 it takes 4 s, and yielding at once leaves 13,872 pairs instead of 13,766. */
#define MOST_AGAIN 8192
/* Violations up to this many tolerances (four are the margin) are left. */
#define MARGIN_LEFT 3.5
#define MENDING_STAGES                                                                                                 \
    {                                                                                                                  \
        8, 32, 128                                                                                                     \
    }

/* ---- Better sides (improve.c) ------------------------------------------------------------------------------------ */

/* Effort, in constraints looked at, for each body of the cluster: some ten milliseconds. */
#define BETTER_EFFORT 1200000u
/* And for a whole crowd, the most expensive bodies first. 4,200 places of Italy with the full effort for each: 17 s for
 * 0.2 % of the cost. */
#define BETTER_MOST 600000000u
/* In a crowd within limits the search ends after this many failures in a row, and after this share of all
 * candidates. */
#define BETTER_IN_VAIN 24
#define BETTER_SHARE 64
/* Rounds of places and sides in turn; one that gains less than this share of the cost is the last. Without proofs there
 * are fewer rounds: more change nothing in a town of 100,000, and take 1 % of its time. */
#define BETTER_ROUNDS 4
#define BETTER_ROUNDS_SOON 2
#define ROUND_GAIN 1e-3
/* A solution counts as cheaper by this share: less is rounding, and would be found for ever. */
#define CHEAPER 1e-6
/* A move this many times as long as the worst conflict was deep may be longer than necessary. On real layers shorter
 * ones never gained anything. */
#define FAR 1.5
/* The work of a search with shorter limits, besides a quarter of the previous work: enough for a few bodies. */
#define NEAR_PATIENCE 10000
#define NEAR_SHARE 4
/* With more than MANY movable bodies, a change is tried with at most ABOUT of them, within the gap and a part of the
 * mean body of each other. */
#define MANY 64
#define ABOUT 32
#define ABOUT_REACH 4
/* A place is worth a descent if its distance from the origin is below this share of the present move. */
#define NEARER_PLACE 0.98
/* Another side of a pair differs from the present one by this share of the distance; at most MOST_SIDES are tried. */
#define OTHER_SIDE 0.3
#define MOST_SIDES 4 /* fixed: the size of an array */
/* Without proofs, in clusters with at most MOST_FORESEEN movable bodies: if, with the two at their nearest place, the
 * total cost is not below the solution's, that place is skipped; other places if it is not below CHEAP_OTHER times
 * that. Of 5,667 descents of a town of 100,000, those that start cheaper than the solution took half of the time, and
 * made one sixtieth of the gain. With any other place skipped from 1 on Paris at gap 0 is 6 % more expensive, without
 * the limit of movable bodies Europe's symbols 0.5 %. (The start of proofs stays as it was: by chance Paris at gap 3
 * ends 11 % more expensive otherwise, at gap 0 0.3 % cheaper.) */
#define CHEAP_OTHER 0.9
#define MOST_FORESEEN 12
/* A start that rounding moved by this many tolerances is repaired. */
#define MENDED 8

/* ---- The cheapest of all (cheapest.c) ---------------------------------------------------------------------------- */

/* A solution is the cheapest if no other is cheaper by this share: less is rounding, or would not be searched for. */
#define CHEAPEST 1e-7
/* The first descents usually end within this share: then a descent to the last digit is worthwhile. */
#define NEARLY_CHEAPEST (2 * SETTLED)
/* With more active constraints the test is skipped; discs shrink this many times. */
#define MOST_FORCED 48
#define FORCED_ROUNDS 30
/* A disc is tested again only if it has shrunk below this share. (With 0.85 fewer solutions of a town are known to be
 * the cheapest, and it takes 3 % more instructions.) */
#define SHRUNK 0.98
/* Sides of a polygon around half an arc; and halvings to find how near to an obstacle, beside the disc, a line may
 * lie. */
#define ARC_SIDES 3
#define LINE_HALVINGS 16
/* If pieces of two bodies together cover a part of the disc: the most pairs of them, in strips, and how often a strip
 * is halved. */
#define MOST_COVERING 24 /* fixed: the size of an array */
#define STRIP_HALVINGS 3

/* ---- Other orders of putting back (reinsert.c) ------------------------------------------------------------------- */

/* Sides are uncertain for bodies that overlapped by this part of the smaller body's extent ... */
#define DEEP 0.125
/* ... and for bodies that moved this many times as far as the worst conflict was deep. */
#define LONG 1.5
/* Orders tried: at most MOST_ORDERS, until MOST_USELESS in a row were useless, where one that leads to what was tried
 * before, or cannot be better, counts as ORDER_IN_VAIN; at most MOST_TIMES the previous work; and in clusters with at
 * most MOST_MOVING movable bodies. Without these limits real layers took up to two thirds longer (Saint-Jean at gap 3:
 * 729 million instructions instead of 443), and were no better. */
#define MOST_ORDERS 64 /* fixed: the size of an array */
#define MOST_USELESS 32
#define ORDER_IN_VAIN 4
#define MOST_TIMES 1
#define MOST_MOVING 32
/* If no body's side is uncertain, all bodies are put back, if at most SURE_MOVING can move. The limits are
 * SURE_USELESS and work / SURE_SHARE then. */
#define SURE_USELESS 3
#define SURE_SHARE 4
#define SURE_MOVING 16
/* From 2 to this many are taken out. */
#define MOST_OUT 6
/* Bodies in the way may share the cost of a place, so it may be this many times as far as the limit, or as a move that
 * costs as much as all moves now. */
#define BEYOND_LIMIT 2
#define BEYOND_COST 1.5
/* Starts whose costs differ by at most this share count as one: less is rounding. */
#define SAME_COST 1e-9

/* ---- Better layouts of a contact group (shake.c) ----------------------------------------------------------------- */

/* Perturbation takes this much work (constraints looked at) for each step that it is given, and SHAKE_AGAIN times that
 * if no descent ended. A descent takes at most SHAKE_PATIENCE plus a part for each body, and ends with a round that
 * gains less than SHAKE_SETTLED: kept results descend again to the end. SHAKEN bodies are released at most; one
 * perturbation for PAIRS_A_SHAKE ordered pairs of bodies, since a small group has few variants. Jakarta's group of 93
 * bodies costs 2,738 m2; begun without forces 2,811 with a work of 3, 2,738 with 4 and no less with 16. */
#define SHAKE_WORK 2
#define SHAKE_AGAIN 2
#define SHAKE_PATIENCE 200000u
#define SHAKE_PATIENCE_EACH 6000u
#define SHAKE_SETTLED 1e-5
#define SHAKEN 16
/* It ends when this share of the work was done since it last gained this share of the cost. */
#define SHAKE_VAIN 0.5
#define SHAKE_GAIN 3e-4
#define PAIRS_A_SHAKE 8
/* A larger group for which no descent ended is perturbed with patience, which grows by the factor MORE_PATIENCE after
 * HASTY descents without an end: until SHAKEN_IN_VAIN ended and gained less than SHAKEN_LITTLE, or SHAKE_WORK_MOST work
 * is done. One in ONE_TURN times moves are rotated. */
#define HEAP 16
#define MORE_PATIENCE 4
#define HASTY 2
#define SHAKEN_IN_VAIN 24
#define SHAKEN_LITTLE 1e-3
#define SHAKE_WORK_MOST 100
#define ONE_TURN 3

/* ---- Blocking neighbours (blocking_neighbours.c) ----------------------------------------------------------------- */

/* Only bodies with this share of the cluster's cost, and for places this much nearer: a neighbour that joins makes the
 * cluster more expensive to solve. */
#define COSTLY 0.1
#define NEARER 0.9

/* ---- Surroundings (surroundings.c) ------------------------------------------------------------------------------- */

/* A body looks this many times as far as it moved, or as the mean of its cluster did. */
#define MOVES_ABOUT 3

#endif
