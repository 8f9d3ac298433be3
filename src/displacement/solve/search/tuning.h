/* These constants decide how good a result is and how long it takes to find, and never whether a statement about it is
 * true. None of them is an error bound. "On real layers" means the benchmark layers of the project
 * (tests/bench/layers.sh), on which the values were tuned. Where a comment names no trial, only what a value balances
 * is known. Effort and work are counted in constraints looked at; a processor looks at some hundred million a
 * second. */
#ifndef SUNDER_I_SEARCH_TUNING_H
#define SUNDER_I_SEARCH_TUNING_H

/* SUNDER_I_SEARCH_TUNING_VERSION is the version of the values below. It is raised with each change of a value, so that
 * a record can name the values by their version (tests/house/TUNING). */
#define SUNDER_I_SEARCH_TUNING_VERSION 10

/* ---- One descent (descend.c, constrain.c, limits.c) -------------------------------------------------------------- */

/* A descent makes at most MOST_ROUNDS rounds. This is far more than it takes, since it converges or gives up
 * earlier. */
#define MOST_ROUNDS 40
/* A descent gives up after MOST_CLASHING rounds with a clash, or after MOST_IDLE of these in a row that fail to halve
 * the violation: contradictions are solved by jumps, and more rounds only move the bodies about. */
#define MOST_CLASHING 12
#define MOST_IDLE 3
/* The softness of a program with clashes, relative to masses, is SOFT at first. It is divided by HARDENING after each
 * round with a clash, and is at least HARDEST. It falls so that long chains of contacts are not mistaken for
 * contradictions. */
#define SOFT 1e-3
#define HARDENING 5
#define HARDEST 1e-6
/* From a free position rounds gain less and less. A descent gives up if its cost, less HOPEFUL times the last gain,
 * still exceeds the cost that is hoped for. */
#define HOPEFUL 4
/* A body in a free place keeps at most the share KEPT_TOO_MUCH more than the required distance (CORNER_TURN of
 * geometry/), plus a hair. */
#define KEPT_TOO_MUCH 0.02
/* solve_lazily() adds constraints to a hard program at most MOST_ADDITIONS times, and to a soft program at most
 * MOST_SOFT_ADDITIONS times, since its solution is not final. */
#define MOST_ADDITIONS 24
#define MOST_SOFT_ADDITIONS 4
/* Two lines of one pair count as one if both components of their normals differ by at most SAME_NORMAL: the normals of
 * pieces cut from one wall differ by rounding. If two lines truly differ, the constraint left out is found when the
 * solution violates it. */
#define SAME_NORMAL 1e-7
/* A limit counts as exceeded if a move exceeds it by more than the share LIMIT_SLACK of the limit or half the
 * tolerance, whichever is greater (slack_of_limit()). */
#define LIMIT_SLACK 1e-12
/* Two tangents of one limit count as one if the cosine of the angle between their normals exceeds SAME_TANGENT. Between
 * them the limit is exceeded by at most the share 1 - SAME_TANGENT. */
#define SAME_TANGENT (1 - 0x1p-40)
/* Programs are solved to the tolerance divided by SOLVED_TO. Soft programs are solved to COMPROMISE_TO of the gap or of
 * a small part of a body (the greater): a compromise need not be exact. */
#define SOLVED_TO 8
#define COMPROMISE_TO 1e-4
/* A solved program with a few more constraints is repaired around these if that raises the cost by at most the share
 * that counts as settled divided by PART_OF_SETTLED (solve_further()). */
#define PART_OF_SETTLED 4
/* A small part of a body is its extent divided by SMALL_PART. Pieces within this distance are included beforehand. */
#define SMALL_PART 50
/* solve_program() demands the violation that long chains leave of hard constraints in addition, multiplied by
 * CORRECTION, at most MOST_CORRECTIONS times. */
#define CORRECTION 1.5
#define MOST_CORRECTIONS 4
/* A hard program has no solution if it is violated by more than the share NO_SOLUTION of a body's extent plus the
 * gap. */
#define NO_SOLUTION 1e-3
/* A compromise is solved as a hard program, too, if it is violated by at most the share NEARLY_SOLVED of the longest
 * move plus the gap: it may have a full solution. */
#define NEARLY_SOLVED 0.03
/* If a path is free up to some point, bodies follow it for the share JUST_BEFORE of the way to that point
 * (stop_short()). */
#define JUST_BEFORE 0.999
/* In a crowd with more than LARGE_CROWD movable bodies a small part is the extent divided by PART_OF_CROWD. Programs
 * with all constraints that bodies might meet allow less, but need not be solved again for each violation. The first
 * descent of 1,750 of Italy's places takes 1.4e9 steps to 3.14e11 m2 with a divisor of 50. With 10 it takes 0.8e9 steps
 * to 3.06e11, with 4 0.5e9 to 3.03e11, and with 1.5 0.3e9 to 3.10e11. */
#define LARGE_CROWD 500
#define PART_OF_CROWD 3
/* A crowd with more than LARGE_CROWD_LED movable bodies and without limits looks farther still, to the extent divided
 * by PART_OF_LARGE_CROWD, since each further constraint costs another solution. It descends coarsely first: violations
 * below the share ROUGHLY of a body are ignored, and a round that gains less than the share ROUGHLY_SETTLED is the
 * last. It takes the sides of the next round ahead on its path (lead_on()), except for at least NOT_LED rounds after a
 * round in which that failed. 4,400 of Italy's places took 43 programs to reach 4.68e11 m2, and 94 in all to 4.61e11;
 * like this they take 67 in all to 4.50e11. Within limits 5,041 squares took five times as long, and nearly all of them
 * stayed in place. */
#define LARGE_CROWD_LED 1000
#define PART_OF_LARGE_CROWD 1.5
#define ROUGHLY 1e-3
#define ROUGHLY_SETTLED 4e-3
#define NOT_LED 2
/* The next round looks STEPS_AHEAD times as far as the longest step of this one, and at least as far as the gap divided
 * by LEAST_REACH. */
#define STEPS_AHEAD 1.5
#define LEAST_REACH 8
/* A round that gains less than the share SETTLED of the cost is the last. A search for better sides goes on until a
 * round gains less than SETTLED_BETTER, and a search for a proof of optimality until it gains less than
 * SETTLED_BEST. */
#define SETTLED 1e-3
#define SETTLED_BETTER 1e-5
#define SETTLED_BEST 1e-9
/* The same for pairs that are eased: what the worst of them cost is far more than a round may gain for another. */
#define EASED 1e-7
/* Neighbours in a row whose moves differ by more than the share ACTING_SPRING of the full gap are eased together, and
 * so are those of a body that easing has moved by more than this share of the gap. */
#define ACTING_SPRING 1e-2
/* A step of a descent that eases pairs is halved at most MOST_HALVINGS times. */
#define MOST_HALVINGS 6
/* A descent that tries other sides is given up when all bodies return to within the share BACK of a body's extent from
 * the best layout. */
#define BACK 1e-8
/* Beyond the least translation of a pair at most MOST_LENGTHENED margins are tried, each twice the one before
 * (stand_apart() of lone_pair.c). */
#define MOST_LENGTHENED 4
/* At most MOST_JUMPS descents follow jumps before pairs are given up (solve_cluster.c). */
#define MOST_JUMPS 3 /* fixed: in a table */

/* Up to FEW_KNOWN constraints are kept on the stack (constrain.c). */
#define FEW_KNOWN 32 /* fixed: the size of an array */

/* ---- Neighbours (near.c) ----------------------------------------------------------------------------------------- */

/* Up to FEW_BODIES bodies are sorted on the stack. */
#define FEW_BODIES 64 /* fixed: the size of an array */

/* ---- Pieces that face each other (piece_pairs.c) ----------------------------------------------------------------- */

/* One pass examines up to PARTS_AT_ONCE pieces of one body, with up to MOST_FACING pieces of the other listed
 * beforehand. Both are kept on the stack. */
#define PARTS_AT_ONCE 32 /* fixed: the size of an array */
#define MOST_FACING 256  /* fixed: the size of an array */
/* If neither body has more than FEW_PARTS pieces, all pairs are visited, since listing beforehand gains nothing. */
#define FEW_PARTS 12

/* ---- What pairs miss (measures.c) -------------------------------------------------------------------------------- */

/* The cache has MEASURES_EACH slots for each body, but no fewer than FEWEST_MEASURES and no more than MOST_MEASURES. It
 * usually takes some dozen kilobytes. */
#define MEASURES_EACH 8
#define FEWEST_MEASURES 64
#define MOST_MEASURES 4096

/* ---- Pairs given up (elastic.c) ---------------------------------------------------------------------------------- */

/* A pair that lacks s pays w (DEAR R s + DEAR_SQUARE s^2): R is the lesser limit, w the lesser weight of its bodies. A
 * move of length r <= R costs w r^2, so it pays to push some sixteen bodies as far as their limits. With 8 or 64 in
 * place of 32 the corpus of the ablation keeps as many conflicts. */
#define DEAR 32
#define DEAR_SQUARE 3.2
/* A pair that lacks the share MUCH_MISSING of what the worst lacks has half the price in the next descent. At
 * most MOST_DISCOUNTS such descents follow the first. In a grid of 400 squares with the limit 5 m, 522 pairs are left
 * with no discount, 438 with two and 435 with four; with MUCH_MISSING 0.02, 471 are left. */
#define MUCH_MISSING 0.3
#define MOST_DISCOUNTS 3
/* A descent at prices ends with a round that gains less than the share SETTLED_AT_PRICES. With 1e-4 a grid of 1,600
 * squares takes a third longer and keeps as many pairs. */
#define SETTLED_AT_PRICES 1e-2

/* ---- Where there is room (free_positions.c) ---------------------------------------------------------------------- */

/* For two bodies with more than MANY_PAIRS pairs of pieces the exact search for two shapes is quicker than an obstacle
 * for each pair. */
#define MANY_PAIRS 1500
/* A body looks for a place as the outlines of its members if its number of pieces times the number of pieces around it
 * exceeds MANY_AROUND. It then considers only shadows of pairs of bodies that have at most MANY_SHADOWS. */
#define MANY_AROUND 5000
#define MANY_SHADOWS 32
/* An obstacle costs OBSTACLE_WORK, in constraints looked at. */
#define OBSTACLE_WORK 16
/* The exact search separates two shapes that overlap by at most the share SHALLOW of the smaller one, or by twice the
 * gap. Its cost grows with the depth. */
#define SHALLOW 0.1
/* The first radius for obstacles around a place of a pair is the share PAIR_REACH of the smaller body, or twice the
 * gap; it is multiplied by PAIR_GROWTH each time. */
#define PAIR_REACH 0.05
#define PAIR_GROWTH 3
/* For a body among all others the first radius is the share BODY_REACH of the body, or its present move, beyond twice
 * the gap. It is multiplied by BODY_GROWTH each time. */
#define BODY_REACH 0.1
#define BODY_GROWTH 2
/* A distance beyond everything is BEYOND_ALL times the total size. */
#define BEYOND_ALL 4
/* Where jumps are not allowed, the visible part of the plane between a body's neighbours narrows with the distance.
 * Places are looked for beyond the present move by at most FARTHEST_LEAP times the sum of the gap and the size of the
 * body (or the typical size in the cluster, if that is smaller). */
#define FARTHEST_LEAP 8
/* A lone body leaves a solution for a free place that is nearer to its start by the share NO_NEARER or more. */
#define NO_NEARER 0x1p-30
/* Two directions count as one if their angles differ by at most SAME_DIRECTION, which covers rounding (enclosed.c). */
#define SAME_DIRECTION 0x1p-40
/* It descends from at most LONE_PLACES free positions, which are at least the share ROUND_SHARE of the gap apart: about
 * as much as the polygons of round corners are beyond these. */
#define LONE_PLACES 8 /* fixed: the size of an array */
#define ROUND_SHARE 0x1p-4

/* ---- Away from one another (spread.c) ---------------------------------------------------------------------------- */

/* Bodies are moved away from their centre by shares of their distance from it, from LEAST_SPREAD to MOST_SPREAD, each
 * twice the one before. From ENOUGH_SPREAD on, bodies that still clash look for a place by themselves. */
#define LEAST_SPREAD 0x1p-5
#define MOST_SPREAD 8
#define ENOUGH_SPREAD 0.5

/* ---- A few bodies by themselves (neighbourhood.c), and the whole (retry_cluster.c) ------------------------------- */

/* A descent takes at most the work PATIENCE, plus PATIENCE_EACH for each body. */
#define PATIENCE 200000u
#define PATIENCE_EACH 1500u
/* A search for room takes at most the work LEAP_PATIENCE (jump.c): two blocks of hundreds of pieces, one in the other's
 * yard, would search all their surroundings without success. */
#define LEAP_PATIENCE 4000000u
/* A descent that only makes a solution cheaper takes at most the work SHORT_PATIENCE, plus SHORT_PATIENCE_EACH for each
 * body. With this limit a crowd of 1,500 houses takes 9.4 s instead of 11.4 s, and ends no more expensive. */
#define SHORT_PATIENCE 20000u
#define SHORT_PATIENCE_EACH 600u

/* Tiny violations are repaired in at most MOST_MENDING rounds (descend.c), which may take MENDING_TIMES the work of a
 * descent. */
#define MOST_MENDING 4
#define MENDING_TIMES 16

/* ---- Pairs asked once more (retry_cluster.c, pair_margin.c) ------------------------------------------------------ */

/* RETRY_STAGES are the numbers of bodies that may move at each stage, before all may. Each is four times the one
 * before, so that one more stage costs a quarter of the next. A cluster of at most FEW movable bodies is tried as a
 * whole at once. */
#define RETRY_STAGES                                                                                                   \
    {                                                                                                                  \
        2, 8, 32, 128                                                                                                  \
    }
#define FEW 8
/* Retries may take the effort RETRY_EFFORT for a cluster, plus RETRY_EFFORT_EACH for each of its bodies and
 * RETRY_EFFORT_PAIR for each pair asked for, up to MOST_RETRIES pairs. With a MOST_RETRIES of 50, 1,200 houses in
 * terraces end with 1,094 pairs left instead of 753. */
#define RETRY_EFFORT 2000000u
#define RETRY_EFFORT_EACH 5000u
#define RETRY_EFFORT_PAIR 200000u
#define MOST_RETRIES 1000
/* After RETRIES_IN_VAIN failures in a row, no further pair is tried with that number of movable bodies. In a layer of
 * lanes that are too narrow (bench_layer lanes 4000) such questions took 400 million steps. */
#define RETRIES_IN_VAIN 32
/* If there are more than FEW_RETRIES pairs to try and none succeeded at the previous stage, the limit on failures is
 * one in SHARE_OF_RETRIES of them, if that is less. */
#define FEW_RETRIES 64
#define SHARE_OF_RETRIES 24
/* No further pair is tried at a stage after failed work of WORK_IN_VAIN or of all effort divided by SHARE_IN_VAIN,
 * whichever is more. In 54 crowds of terraces, with a hundred pairs each, almost none succeeded with dozens of movable
 * bodies. */
#define WORK_IN_VAIN 2000000u
#define SHARE_IN_VAIN 8
/* In clusters with at most MOST_TRADING movable bodies overlaps are separated at the expense of other pairs. */
#define MOST_TRADING 64

/* ---- What fits exactly (fit_given_up.c) -------------------------------------------------------------------------- */

/* FIT_STAGES are the numbers of bodies that may move at each stage. They do not exceed the number for which exact
 * places are searched (MOST_TIGHT of prove/optimum). */
#define FIT_STAGES                                                                                                     \
    {                                                                                                                  \
        2, 8, 16                                                                                                       \
    }

/* ---- A crowd with few clashes (mend_few.c) ----------------------------------------------------------------------- */

/* A large crowd has few clashes if it has at most one for every FEW_CLASHES bodies. Each clash is then settled with the
 * bodies around it (MENDING_STAGES). */
#define FEW_CLASHES 64
/* A crowd with more than MOST_AGAIN movable bodies is not solved as a whole again for a body that was sent back: for
 * 20,000 squares each solution took 150 s, and there were several. For 5,041 squares it takes 4 s, and yielding at once
 * leaves 13,872 pairs instead of 13,766. */
#define MOST_AGAIN 8192
/* Violations up to MARGIN_LEFT times the tolerance are left; the margin is four tolerances. */
#define MARGIN_LEFT 3.5
/* MENDING_STAGES are the numbers of bodies around a clash that may move at each stage. */
#define MENDING_STAGES                                                                                                 \
    {                                                                                                                  \
        8, 32, 128                                                                                                     \
    }

/* ---- Better sides (improve.c) ------------------------------------------------------------------------------------ */

/* A search for better sides may take the effort BETTER_EFFORT for each body of the cluster: some ten milliseconds. */
#define BETTER_EFFORT 1200000u
/* A whole cluster may take BETTER_MOST, the most expensive bodies first. With the full effort for each, 4,200 places of
 * Italy took 17 s for 0.2 % of the cost. */
#define BETTER_MOST 600000000u
/* In a crowd within limits the search ends after BETTER_IN_VAIN failures in a row, plus one for every BETTER_SHARE
 * bodies. */
#define BETTER_IN_VAIN 24
#define BETTER_SHARE 64
/* Places and sides are tried in turn in at most BETTER_ROUNDS rounds; a round that gains less than the share ROUND_GAIN
 * of the cost is the last. Without proofs there are at most BETTER_ROUNDS_SOON rounds: more change nothing in a town of
 * 100,000, and take 1 % of its time. */
#define BETTER_ROUNDS 4
#define BETTER_ROUNDS_SOON 2
#define ROUND_GAIN 1e-3
/* A solution counts as cheaper if its cost is less by more than the share CHEAPER: a smaller difference is rounding,
 * and would be found for ever. */
#define CHEAPER 1e-6
/* A move more than FAR times as long as the depth of the worst conflict may be longer than necessary. On real layers
 * shorter moves never gained anything. */
#define FAR 1.5
/* A search with shorter limits takes at most the work NEAR_PATIENCE, plus the previous work divided by NEAR_SHARE:
 * enough for a few bodies. */
#define NEAR_PATIENCE 10000
#define NEAR_SHARE 4
/* With more than MANY movable bodies, a change is tried with at most ABOUT of them, within the gap plus the extent of a
 * body divided by ABOUT_REACH. */
#define MANY 64
#define ABOUT 32
#define ABOUT_REACH 4
/* A place is worth a descent if its distance from the origin is below the share NEARER_PLACE of the present move. */
#define NEARER_PLACE 0.98
/* Another side of a pair differs from the present one by at least the share OTHER_SIDE of the pair's relative move. At
 * most MOST_SIDES are tried. */
#define OTHER_SIDE 0.3
#define MOST_SIDES 4 /* fixed: the size of an array */
/* Without proofs, is_too_cheap() skips places of two bodies in clusters with at most MOST_FORESEEN movable bodies. The
 * nearest place is skipped if the total cost with it is below that of the solution, other places if it is below
 * CHEAP_OTHER times that. In a town of 100,000, the descents that start cheaper than the solution took half of the time
 * of all 5,667, and made one sixtieth of the gain. If other places are skipped from 1 on, too, Paris at gap 0 is 6 %
 * more expensive; without MOST_FORESEEN Europe's symbols are 0.5 % more expensive. The start of proofs is unchanged:
 * otherwise Paris at gap 3 ends, by chance, 11 % more expensive, and at gap 0 0.3 % cheaper. */
#define CHEAP_OTHER 0.9
#define MOST_FORESEEN 12
/* A start with violations of at most MENDED tolerances, which rounding causes, is repaired. */
#define MENDED 8

/* ---- The cheapest of all (cheapest.c) ---------------------------------------------------------------------------- */

/* A solution is the cheapest if no other is cheaper by more than the share CHEAPEST: a smaller difference is rounding,
 * or would not be searched for. */
#define CHEAPEST 1e-7
/* The first descents usually end within the share NEARLY_CHEAPEST of the cheapest; if so, a descent to the last digit
 * is worthwhile. */
#define NEARLY_CHEAPEST (2 * SETTLED)
/* With more than MOST_FORCED active constraints the test is skipped. Discs shrink in at most FORCED_ROUNDS rounds. */
#define MOST_FORCED 48
#define FORCED_ROUNDS 30
/* A disc is tested again only if its radius has shrunk below the share SHRUNK. With 0.85 fewer solutions of a town are
 * known to be the cheapest, and it takes 3 % more instructions. */
#define SHRUNK 0.98
/* is_covered_by_one() uses a polygon with ARC_SIDES sides around half an arc. The function find_line() finds how near
 * to an obstacle, beside the disc, a line may lie: at 2^-k of the way, with k less than LINE_HALVINGS. */
#define ARC_SIDES 3
#define LINE_HALVINGS 16
/* Pieces of two bodies may cover a part of the disc together. At most MOST_COVERING pairs of them are considered, in
 * strips that are halved at most STRIP_HALVINGS times. */
#define MOST_COVERING 24 /* fixed: the size of an array */
#define STRIP_HALVINGS 3

/* ---- Other orders of putting back (reinsert.c) ------------------------------------------------------------------- */

/* The side of a body is uncertain if it overlapped another one at the start by more than the share DEEP of the smaller
 * body's extent. It is also uncertain if the body moved more than LONG times the depth of the worst conflict. */
#define DEEP 0.125
#define LONG 1.5
/* At most MOST_ORDERS orders are tried, until MOST_USELESS in a row were useless. An order that leads to a start that
 * was tried before, or that cannot be better, counts as ORDER_IN_VAIN useless ones. The orders take at most MOST_TIMES
 * the previous work, and are tried in clusters with at most MOST_MOVING movable bodies. Without these limits real
 * layers took up to two thirds longer and were no better: Saint-Jean at gap 3 took 729 million instructions instead of
 * 443. */
#define MOST_ORDERS 64 /* fixed: the size of an array */
#define MOST_USELESS 32
#define ORDER_IN_VAIN 4
#define MOST_TIMES 1
#define MOST_MOVING 32
/* If no body's side is uncertain, all bodies are put back if at most SURE_MOVING can move. The search then ends after
 * SURE_USELESS useless orders in a row, or after further work of the previous work divided by SURE_SHARE. */
#define SURE_USELESS 3
#define SURE_SHARE 4
#define SURE_MOVING 16
/* From 2 to MOST_OUT bodies are taken out at a time. */
#define MOST_OUT 6
/* A place may be BEYOND_LIMIT times as far as the limit, since bodies in the way may share its cost. It may be
 * BEYOND_COST times as far as a move that costs as much as all moves now. */
#define BEYOND_LIMIT 2
#define BEYOND_COST 1.5
/* Starts whose costs differ by at most the share SAME_COST count as one: the difference is rounding. */
#define SAME_COST 1e-9

/* ---- Better layouts of a contact group (shake.c) ----------------------------------------------------------------- */

/* Perturbation takes SHAKE_WORK work for each step that it is given, and SHAKE_AGAIN times that if no descent ended. A
 * descent takes at most SHAKE_PATIENCE plus SHAKE_PATIENCE_EACH for each body. It ends with a round that gains less
 * than the share SHAKE_SETTLED; results that are kept descend again to the end. At most SHAKEN bodies are released at a
 * time. Jakarta's group of 93 bodies costs 2,738 m2; if descents begin without forces it costs 2,811 with a SHAKE_WORK
 * of 3, 2,738 with 4, and no less with 16. */
#define SHAKE_WORK 2
#define SHAKE_AGAIN 2
#define SHAKE_PATIENCE 200000u
#define SHAKE_PATIENCE_EACH 6000u
#define SHAKE_SETTLED 1e-5
#define SHAKEN 16
/* Perturbation ends when the share SHAKE_VAIN of its work was done since the cost last fell by the share SHAKE_GAIN. It
 * also ends after one perturbation for every PAIRS_A_SHAKE ordered pairs of bodies, since a small group has few
 * variants. */
#define SHAKE_VAIN 0.5
#define SHAKE_GAIN 3e-4
#define PAIRS_A_SHAKE 8
/* If no descent of a group of more than HEAP bodies ended within its work, the group is perturbed again. The work
 * that one descent may take is multiplied by MORE_PATIENCE after every HASTY descents in a row that did not end.
 * This stops once SHAKEN_IN_VAIN descents in a row ended and each gained less than the share SHAKEN_LITTLE, or once
 * the work reaches SHAKE_WORK_MOST times the steps granted to the group. On average one perturbation in ONE_TURN
 * turns the moves of neighbouring bodies by one random angle. */
#define HEAP 16
#define MORE_PATIENCE 4
#define HASTY 2
#define SHAKEN_IN_VAIN 24
#define SHAKEN_LITTLE 1e-3
#define SHAKE_WORK_MOST 100
#define ONE_TURN 3

/* ---- Blocking neighbours (blocking_neighbours.c) ----------------------------------------------------------------- */

/* Neighbours join only for bodies with more than the share COSTLY of the cluster's cost, and for places at less than
 * the share NEARER of the present move: a neighbour that joins makes the cluster more expensive to solve. */
#define COSTLY 0.1
#define NEARER 0.9

/* ---- Surroundings (surroundings.c) ------------------------------------------------------------------------------- */

/* A body looks MOVES_ABOUT times as far as it moved, or as the mean of its cluster did if that is more. */
#define MOVES_ABOUT 3

#endif
