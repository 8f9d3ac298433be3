/* Numbers of this room that are no error bounds: they decide how good a result is and how long it takes to find,
 * never whether what is said of it is true. "On real layers" means the benchmark layers of the project
 * (tests/bench/layers.sh), where they were tried; of a number of which nothing else is said, what it balances is all
 * that is known. */
#ifndef SUNDER_I_SEARCH_TUNING_H
#define SUNDER_I_SEARCH_TUNING_H

/* ---- One descent (descend.c) ------------------------------------------------------------------------------------- */

/* Rounds in all: far above what a descent takes, which converges or gives up before. */
#define MOST_ROUNDS 40
/* Rounds that end in a clash before it gives up, and those of them that do not halve what is missed: contradictions are
 * solved by jumps, and more rounds only move the bodies about. */
#define MOST_CLASHING 12
#define MOST_IDLE 3
/* The softness of a program with clashes, relative to masses: at first, what it is divided by after each round that
 * clashes, and at last. It falls, so that long chains of contacts are not taken for contradictions. */
#define SOFT 1e-3
#define HARDENING 5
#define HARDEST 1e-6
/* From a free position rounds gain less and less: what so many times the last gain does not reach is out of reach. */
#define HOPEFUL 4
/* A free place keeps at most this share more than is owed (CORNER_TURN of geometry/), and a hair. */
#define KEPT_TOO_MUCH 0.02
/* Times that constraints are added to one program; to a soft one, of which the solution is no place to stay, fewer. */
#define MOST_ADDITIONS 24
#define MOST_SOFT_ADDITIONS 4
/* Two lines of one pair are the same if their normals differ by no more: those of pieces cut from one wall differ by
 * rounding. Of two that differ truly, what the one left out would have said is found when the solution misses it. */
#define SAME_NORMAL 1e-7
/* A limit of moves is overstepped from this share of it on, at least. */
#define LIMIT_SLACK 1e-12
/* Two tangents whose normals have a greater cosine are the same: between them no more than that share is overstepped.
 * */
#define SAME_TANGENT (1 - 0x1p-40)
/* Programs are solved to this part of the tolerance; soft ones to this part of the gap, or of a small part of a body:
 * a compromise need not be found to the last digit. */
#define SOLVED_TO 8
#define COMPROMISE_TO 1e-4
/* A solved program that has a few more constraints is mended about these, if that costs more by no larger a part than
 * this of what counts as settled. */
#define PART_OF_SETTLED 4
/* A small part of a body: its extent divided by so much. Pieces no farther off than that are looked at beforehand. */
#define SMALL_PART 50
/* What long chains leave of hard constraints is asked for in addition, so many times as much, so often. */
#define CORRECTION 1.5
#define MOST_CORRECTIONS 4
/* A hard program that misses more than this share of sizes has no solution. */
#define NO_SOLUTION 1e-3
/* A compromise that misses no more than this share of how far things go may have a solution in full. */
#define NEARLY_SOLVED 0.03
/* A way that is free up to some point is gone to just before it. */
#define JUST_BEFORE 0.999
/* In a crowd of more that move a small part is a greater one: programs with all that bodies might run into allow less,
 * but need not be solved again and again with what they did. 1,750 of Italy's places, in the first descent: with 50,
 * 1.4 thousand million steps to 3.14e11 m2, with 10 0.8 to 3.06, with 4 0.5 to 3.03, with 1.5 0.3 to 3.10. */
#define LARGE_CROWD 500
#define PART_OF_CROWD 3
/* A crowd of more, without limits, looks farther yet: what its program runs into in the end takes as long again. It
 * goes down roughly first: violations of so large a part of a body are none, and a round that gains less than this
 * share is the last. It is led, but for so many rounds after one that was led in vain. 4,400 of Italy's places took 43
 * programs to come to 4.68e11 m2, and 94 in all to 4.61e11; so, 67 in all to 4.50e11. Within limits 5,041 squares took
 * five times as long, and next to all of them stayed at home. */
#define LARGE_CROWD_LED 1000
#define PART_OF_LARGE_CROWD 1.5
#define ROUGHLY 1e-3
#define ROUGHLY_SETTLED 4e-3
#define NOT_LED 2
/* The next round looks so many times as far as the longest step of this one, and this part of the gap at least. */
#define STEPS_AHEAD 1.5
#define LEAST_REACH 8
/* A round that gains less than this share of the cost is the last; in search of better sides less will do, and less yet
 * where it is to be proved that nothing is cheaper. */
#define SETTLED 1e-3
#define SETTLED_BETTER 1e-5
#define SETTLED_BEST 1e-9
/* A search for better sides that comes back to this share of a body from where it began ends. */
#define BACK 1e-8
/* The margin beyond the least translation of a pair, at first, and so many times doubled (lone_pair.c). */
#define MOST_LENGTHENED 4
/* Descents after jumps, before pairs are given up. */
#define MOST_JUMPS 3

/* No more than so many constraints are remembered on the stack (constrain.c). */
#define FEW_KNOWN 32

/* ---- Who stands near whom (near.c) ------------------------------------------------------------------------------- */

/* No more than so many bodies are sorted on the stack. */
#define FEW_BODIES 64

/* ---- Pieces that face each other (piece_pairs.c) ----------------------------------------------------------------- */

/* So many parts of the one body are looked at in one go, with no more than so many pieces of the other beforehand: both
 * are kept on the stack. */
#define PARTS_AT_ONCE 32
#define MOST_FACING 256
/* Where each has no more than this there is nothing to be gained by looking beforehand. */
#define FEW_PARTS 12

/* ---- What pairs miss (measures.c) -------------------------------------------------------------------------------- */

/* Slots for what is kept: so many for each body, no fewer and no more than that in all; some dozen kilobytes mostly. */
#define MEASURES_EACH 8
#define FEWEST_MEASURES 64
#define MOST_MEASURES 4096

/* ---- Pairs given up (give_up.c) ---------------------------------------------------------------------------------- */

/* Of clashes that hang together those are given up at first that miss at least this share of what the worst does; then
 * a share so many times smaller each time. */
#define FIRST_SHARE 0.5
#define MORE 1.5
/* Rounds that end in a clash before a descent that follows gives up, but in a crowd: the compromise is near. Blocks of
 * 32 houses take a fifth less of all time with 2 than with twelve, and leave 728 pairs of a town for 764. */
#define CLASHING_AGAIN 2
/* It may take so many times what the search took before, of which all but the first up to the most, and what a descent
 * may. A crowd of 70 houses between two roads takes three descents as dear as all before to know which 24 of its 150
 * conflicts to give up; where the last of them is cut short all are. So a crowd may take more, whatever it took before:
 * a hundred symbols of which a tenth have no room take a dozen descents, most of which fail, and those are the dear
 * ones. (Cut short, 700 pairs were given up there where 13 do, and it took longer in the end to ask for them again.) */
#define GIVE_UP_TIMES 8
#define GIVE_UP_MOST 400000000u
#define GIVE_UP_OF_CROWD 1600000000u
/* A crowd of which no more than one pair in so many clashes where its parts were solved begins there. */
#define FEW_LEFT 3
/* From there what is given up grows by rings of neighbours about what still clashes. */
#define MOST_RINGS 8
/* Of a crowd of so many bodies a descent takes more than retries (retry_cluster.c) are allowed; in smaller clusters
 * these do better. What it gave up is asked for again with so much for each pair of bodies, and for all. With less, or
 * more, for each a crowd of 70 houses ends with up to half as many again that are given up. */
#define CROWD 48
#define TAKE_BACK_EACH 8000000u
#define TAKE_BACK_MOST 200000000u
/* With so many about them they are asked first, until so many, one after the other, were in vain, and the whole until
 * so many were; the rest is left to retries. Of ten crowds in a town of terraces the whole alone granted 85 of 263 for
 * a thousand million steps, few alone 128 of 259 for 50. But of the crowds of Germany within 12 km few alone leave 715
 * symbols, few and then the whole 20. (After 8 in vain instead of 2: 22; and 656 pairs of the terraces for 665, in a
 * third more of all time.) */
#define TAKE_BACK_FEW 32
#define TAKE_BACK_FEW_IN_VAIN 32
#define TAKE_BACK_IN_VAIN 2
/* Lines between bodies are taken anew when the two went so far from where they were taken, as a share of what is
 * missed at most; who stands beside the way, but for so little, is not pushed (pushed.c). */
#define PUSHED_STALE 0.125
#define PUSHED_BESIDE 1e-9
/* What stops bodies in one direction is looked for when questions in vain have looked at so many times as many of them
 * there (pushed_in_vain.c). Of 5,041 squares pushing looks at 640 million lines without it, 520 with 1, 330 with 2, 250
 * with 8. */
#define PUSHED_SURVEY 8
/* What pairs miss that are asked so: at first this part of the most, then so many times as much each time. */
#define PUSHED_FIRST 8
#define PUSHED_LEVELS 1.2
/* It may take so much, and so much for each body: of a grid of 20,000 most pairs reach thousands in vain. */
#define PUSHED_MOST 100000000u
#define PUSHED_EACH 40000u
/* A crowd of which pushing leaves more than this share given up has next to no room: of grids of squares two in three
 * are left, of symbols one in ten, of which a compromise tells better what to give up. Where nothing else was tried yet
 * it is believed from a greater share on: of grids of thousands four in five are left. It is pushed again as long as
 * that takes back more than one in so many of what was left. */
#define LEFT_BY_PUSHING 0.5
#define LEFT_AT_HOME 0.75
#define LEAST_PUSHED 64
/* Where a level takes back no larger a share than that all that are left are asked at once. A grid of 20,000 was asked
 * six times more for 35 of 60,000 pairs, in a sixth of the time of all. */
#define LEAST_OF_LEVEL 1024
/* Moves no longer than this share of a body are what descents leave of none. */
#define NEARLY_HOME 1e-7

/* ---- Where there is room (free_positions.c) ---------------------------------------------------------------------- */

/* More pairs of pieces than this are too many to make an obstacle of each: the exact search for two shapes is
 * quicker. */
#define MANY_PAIRS 1500
/* A body that looks for a place among so many pieces, times its own, does so as its members' outlines. */
#define MANY_AROUND 5000
/* ... and heeds of two bodies' shadows only those of fewer than so many. */
#define MANY_SHADOWS 32
/* What an obstacle costs, in constraints looked at. */
#define OBSTACLE_WORK 16
/* Two shapes that overlap by no more than this part of the smaller one are parted by the exact search, whose cost grows
 * with the depth. */
#define SHALLOW 0.1
/* Obstacles are first looked for within this part of the smaller body about a place of a pair, then so many times as
 * far. */
#define PAIR_REACH 0.05
#define PAIR_GROWTH 3
/* The same for a body among all. */
#define BODY_REACH 0.1
#define BODY_GROWTH 2
/* Nothing is farther off than so many times the sizes of all there is. */
#define BEYOND_ALL 4
/* So many places are tried for one that is alone among what stands still. */
#define MOST_PLACES 16
/* Where nobody may jump, what is in sight of a body between its neighbours narrows with the distance: a place is looked
 * for no farther off than so many times the body, or the mean one of the cluster, and the gap. */
#define FARTHEST_LEAP 8

/* ---- Away from one another (spread.c) ---------------------------------------------------------------------------- */

/* The shares of the way from the centre that are tried, doubled each time; from some share on those that still clash
 * look for a place by themselves. */
#define LEAST_SPREAD 0x1p-5
#define MOST_SPREAD 8
#define ENOUGH_SPREAD 0.5

/* ---- A few bodies by themselves (neighbourhood.c), and the whole (retry_cluster.c) ------------------------------- */

/* What a descent may take, in constraints looked at (some hundred million a second): so much, and so much for each
 * body; and where it is only to make a solution cheaper. With the latter a crowd of 1,500 houses takes 9.4 s for
 * 11.4, and ends no dearer. */
#define PATIENCE 200000u
#define PATIENCE_EACH 1500u
/* And what looking for room may take: two blocks of hundreds of pieces, one in the other's yard, go about their whole
 * surroundings in vain. */
#define LEAP_PATIENCE 4000000u
#define SHORT_PATIENCE 20000u
#define SHORT_PATIENCE_EACH 600u

/* Two that went the same way to this part of the tolerance are not looked at again. */
#define TOGETHER 64
/* What was missed by a hair is made good in so many rounds (descend.c), and that may take so many times as much. */
#define MOST_MENDING 4
#define MENDING_TIMES 16

/* ---- Pairs asked once more (retry_cluster.c) --------------------------------------------------------------------- */

/* How many may move at each stage, before all may: fourfold, since what one more stage costs is then a quarter of the
 * next. A cluster of no more than FEW is asked as a whole at once. */
#define RETRY_STAGES                                                                                                   \
    {                                                                                                                  \
        2, 8, 32, 128                                                                                                  \
    }
#define FEW 8
/* Effort, in constraints looked at: for a cluster, for each of its bodies, and for each pair that is asked, of no more
 * than so many. (With 50 of these 1,200 houses in terraces end with 1,094 pairs left for 753.) */
#define RETRY_EFFORT 2000000u
#define RETRY_EFFORT_EACH 5000u
#define RETRY_EFFORT_PAIR 200000u
#define MOST_RETRIES 1000
/* So many in vain, one after the other, and with so many who move none of the others is asked. Of a layer of lanes
 * that are too narrow (bench_layer lanes 4000) 400 million steps went into such questions. */
#define RETRIES_IN_VAIN 32
/* And, where more than the first are to be asked and none was granted at the stage before, one in so many. */
#define FEW_RETRIES 64
#define SHARE_OF_RETRIES 24
/* Nor is any when that took so much, or this share of all effort if that is more. Of 54 crowds of terraces, of which
 * each is asked for a hundred pairs, next to none was granted with dozens who move. */
#define WORK_IN_VAIN 2000000u
#define SHARE_IN_VAIN 8
/* Overlaps are parted at the cost of other pairs in clusters of which no more than so many may move. */
#define MOST_TRADING 64

/* ---- What fits exactly (fit_given_up.c) -------------------------------------------------------------------------- */

/* How many may move at each stage: no more than there is a search for exact places among (TIGHT_MOST). */
#define FIT_STAGES                                                                                                     \
    {                                                                                                                  \
        2, 8, 16                                                                                                       \
    }

/* ---- A crowd of which few clash (mend_few.c) --------------------------------------------------------------------- */

/* Of a large crowd no more than one pair for so many bodies clashes; with so many about them they are settled. */
#define FEW_CLASHES 64
/* A crowd of more is not asked as a whole again for somebody who was sent home: of 20,000 squares each time took 150 s,
 * and there were several. Of 5,041 it takes 4 s, and to yield at once leaves 13,872 pairs for 13,766. */
#define MOST_AGAIN 8192
/* What misses no more than so many tolerances (four are the margin) is left as it stands. */
#define MARGIN_LEFT 3.5
#define MENDING_STAGES                                                                                                 \
    {                                                                                                                  \
        8, 32, 128                                                                                                     \
    }

/* ---- Better sides (improve.c) ------------------------------------------------------------------------------------ */

/* How much it may cost, in constraints looked at, for each body of the cluster: some ten milliseconds. */
#define BETTER_EFFORT 1200000u
/* And for all of a crowd, of which the costliest come first. 4,200 places of Italy with all of theirs: 17 s for 0.2 %
 * of the cost. */
#define BETTER_MOST 600000000u
/* In a crowd within limits so many in vain, one after the other, and this share of all, and no more are tried. */
#define BETTER_IN_VAIN 24
#define BETTER_SHARE 64
/* Rounds of places and sides in turn; one that gains less than this share of the cost is the last. Where no proofs are
 * asked for they are fewer: more change nothing in a town of 100,000, and take a hundredth of its time. */
#define BETTER_ROUNDS 4
#define BETTER_ROUNDS_SOON 2
#define ROUND_GAIN 1e-3
/* A solution is cheaper if it is so by this share: less is rounding, and would be found for ever. */
#define CHEAPER 1e-6
/* A move this many times as long as the worst conflict was deep may have been sent farther than need be. On real layers
 * nothing was ever gained below. */
#define FAR 1.5
/* What a search that keeps them near may take besides a quarter of what was done before: enough for a few bodies. */
#define NEAR_PATIENCE 10000
#define NEAR_SHARE 4
/* Where more bodies than MANY may move, a change is tried with no more than ABOUT of them, who stand within the gap and
 * a part of the mean body of each other. */
#define MANY 64
#define ABOUT 32
#define ABOUT_REACH 4
/* A place for a body is worth a descent if it is nearer to where it came from by more than what is left of this. */
#define NEARER_PLACE 0.98
/* Another side of a pair is one that differs from the present by this share of the distance; so many are tried. */
#define OTHER_SIDE 0.3
#define MOST_SIDES 4
/* Where no proofs are asked for, and in clusters in which no more than so many may move: with the two at their
 * nearest place all together cost no less than in the solution, or it is not gone down from there; at another, no
 * less than so many times as much. Of 5,667 descents of a town of 100,000 those that begin cheaper than the solution
 * took half of the time, and gained a sixtieth of what all gained. With any other place left out from 1 on Paris at
 * gap 0 is 6 % dearer, without the limit of movers Europe's symbols half a hundredth. (What proofs begin from stays
 * what it was: by chance of the way Paris at gap 3 ends 11 % dearer otherwise, at gap 0 0.3 % cheaper.) */
#define CHEAP_OTHER 0.9
#define MOST_FORESEEN 12
/* A start that rounding took this many tolerances from is mended. */
#define MENDED 8

/* ---- The cheapest of all (cheapest.c) ---------------------------------------------------------------------------- */

/* A solution is the cheapest if none is cheaper by this share: less is rounding, or would not be looked for. */
#define CHEAPEST 1e-7
/* What the first descents leave is mostly less than this share: then it is worth going down to the last. */
#define NEARLY_CHEAPEST (2 * SETTLED)
/* Of more constraints that act it is not asked; discs shrink so often. */
#define MOST_FORCED 48
#define FORCED_ROUNDS 30
/* A disc that is no smaller than this share of what it was is not asked about again. (With 0.85 fewer solutions of a
 * town are known to be the cheapest, and it takes 3 % more instructions.) */
#define SHRUNK 0.98
/* Sides of a polygon about half an arc; how near to an obstacle, beside the disc, a line is told. */
#define ARC_SIDES 3
#define LINE_HALVINGS 16
/* Where pieces of two bodies cover a part of the disc together: so many pairs of them, in strips, halved so often. */
#define MOST_COVERING 24
#define STRIP_HALVINGS 3

/* ---- Other orders of putting back (reinsert.c) ------------------------------------------------------------------- */

/* Sides are in doubt of what overlapped by this part of the smaller body's extent ... */
#define DEEP 0.125
/* ... and of what moved so many times as far as the worst conflict was deep. */
#define LONG 1.5
/* So many orders are tried, until so many one after the other were of no use, of which one that leads to what was
 * tried before, or to what can be no better, counts as so many; for no more than so many times the work that was
 * done before; and of clusters in which no more than so many may move.
 * Without these ends real layers were dearer by up to two thirds (Saint-Jean at gap 3: 729 million instructions for
 * 443), and not better. */
#define MOST_ORDERS 64
#define MOST_USELESS 32
#define ORDER_IN_VAIN 4
#define MOST_TIMES 1
#define MOST_MOVING 32
/* The same where nobody's sides are in doubt: all of them are put back then, if they are no more than so many. */
#define SURE_USELESS 3
#define SURE_SHARE 4
#define SURE_MOVING 16
/* From 2 to so many are taken out. */
#define MOST_OUT 6
/* Those who stand in the way may share what the place costs, so it may be so many times as far as the limit, or as a
 * move that costs as much as all do now. */
#define BEYOND_LIMIT 2
#define BEYOND_COST 1.5
/* Starts whose costs differ by no more than this share are the same: less is rounding. */
#define SAME_COST 1e-9

/* ---- Better layouts of a contact group (shake.c) ----------------------------------------------------------------- */

/* Shaking takes so much work (constraints looked at) for each step that it is given, and so many times that where no
 * descent came to an end; a descent no more than so much and so much for each body, and it ends with a round that gains
 * less than this share: what is kept goes down again to the end. How many bodies are let go at most; and of how many
 * ordered pairs of bodies one time is worth: in a small group there are only so many ways. Jakarta's group of 93 bodies
 * costs 2,738 m2; begun without forces 2,811 with a work of 3, 2,738 with 4 and no less with 16. */
#define SHAKE_WORK 2
#define SHAKE_AGAIN 2
#define SHAKE_PATIENCE 200000u
#define SHAKE_PATIENCE_EACH 6000u
#define SHAKE_SETTLED 1e-5
#define SHAKEN 16
/* It ends where so great a share of the work was done since it last gained this share of the cost. */
#define SHAKE_VAIN 0.5
#define SHAKE_GAIN 3e-4
#define PAIRS_A_SHAKE 8
/* A group of more bodies that no descent came to an end for is shaken with patience, which grows so many times after so
 * many descents without an end: until so many came to one and gained less than this share, or so much work is done. One
 * in so many times moves are turned. */
#define HEAP 16
#define MORE_PATIENCE 4
#define HASTY 2
#define SHAKEN_IN_VAIN 24
#define SHAKEN_LITTLE 1e-3
#define SHAKE_WORK_MOST 100
#define ONE_TURN 3

/* ---- Who is in the way (blocking_neighbours.c) ------------------------------------------------------------------- */

/* Only bodies that have this part of the cluster's cost, and for places this much nearer: a neighbour who joins makes
 * the cluster dearer to solve. */
#define COSTLY 0.1
#define NEARER 0.9

/* ---- Who stands about (surroundings.c) --------------------------------------------------------------------------- */

/* A body looks about itself so many times as far as it moved, or as the mean of its cluster did. */
#define MOVES_ABOUT 3

#endif
