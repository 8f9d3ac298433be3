/* Numbers of this room that are no error bounds: they decide how near a bound comes to the cost and how long it takes,
 * never whether it holds. */
#ifndef SUNDER_I_OPTIMUM_TUNING_H
#define SUNDER_I_OPTIMUM_TUNING_H

/* ---- Contacts (body_contact.c) ----------------------------------------------------------------------------------- */

/* Bodies are in contact that are farther apart than they owe each other by no more than this share of the gap; at gap 3
 * that is about what the interface says of clusters. */
#define CONTACT 0x1p-21

/* ---- Groups (optimum.c) ------------------------------------------------------------------------------------------ */

/* A group is optimal whose cost is no more than its bound and this share of it and this much; as the interface says. */
#define OPTIMAL_SHARE 1e-6
#define OPTIMAL_MORE 1e-7
/* A layout is cheaper by no less than this share. */
#define CHEAPER 0x1p-40
/* A length that does not count, as a share of the gap or, where that is 0, of so much of a body. */
#define SMALL_LENGTH 0x1p-17
#define SMALL_EXTENT 0x1p-4
/* Of groups with more that move blocks are asked, too, and the branching gets of the steps one in so many at first; one
 * in so many in all if it has proved this share of what is to be proved by then; and all of them, without blocks, from
 * this share on, where blocks were never found to prove more. With no more than so many the branching is left alone. */
#define BRANCHED 16
#define TREE_FIRST 16
#define TREE_SECOND 4
#define TREE_SECOND_SHARE 0.4
#define TREE_WHOLE_SHARE 0.7
/* Blocks are asked so often, about; where their pairs alone would take all steps, they are not. */
#define BLOCKS_ASKED 24
#define FEW 4
/* A group of which more move is taken in parts of so many bodies. */
#define MOST_TOGETHER 192
#define PART 96
/* A part is looked at with one in so many of its steps first; with all of them if that proves this share of what it
 * costs; a crowd if it does not. */
#define QUICK_LOOK 16
#define QUICK_SHARE 0.1
#define QUICK_AS_MUCH 0.75
/* A group that is nearly what it was when it was asked (by this share of its cost) keeps what was proved of it; it is
 * shaken with one in so many of the steps. */
#define ASKED_SHARE 0.9
#define AGAIN 4
/* Of a group that may go anywhere neither a tree nor blocks are asked if more of it move than this: of no such group of
 * Germany's or Italy's symbols did a tree prove 11 %, of all that are smaller the more the fewer they are; of the bound
 * of the layer, which prices make, they were one part in ten thousand, for a tenth of the time. (With 96 Europe's bound
 * is half a hundredth less.) */
#define LARGE_FREE_CROWD 128
/* A group too large for a tree is crowded that leaves a pair in conflict for every so many of its bodies: of the large
 * groups of real layers within limits none leaves one for ten. It gets one in so many of its steps, and those for
 * blocks alone. A town of terraces of 1,200 houses, of whose conflicts a quarter is left, has a bound of 27 % of its
 * cost then, in 2 s, for 37 % in 54 s; pairs alone prove 11 %. */
#define CROWDED 2
#define CROWD_LOOK 16
/* So many bodies that stand in the way may take part besides. */
#define MOST_GUESTS 24

/* ---- Places with no room to spare (tight_place.c) ---------------------------------------------------------------- */

/* Of so many bodies at most, and as many outside. No lattice is looked at whose step is less than this share of the
 * bodies' size. What lies on a lattice does so up to this share of the size, but no more than that of the step: so far
 * a tree is off that does not come nearer to a corner by dividing. */
#define MOST_TIGHT 24
#define TIGHT_STEP 0x1p-18
#define TIGHT_HAIR 0x1p-22
#define TIGHT_STEP_HAIR 0x1p-8
/* Where there is room, so many margins are left. */
#define TIGHT_MARGIN 4
/* Rows are drawn away from their contacts so often at most (where two meet at a narrow angle it takes many turns), and
 * brought back by a unit so often; not from a contact along which they hardly move. */
#define TIGHT_TURNS 1000
/* If the weighted moves of a row add up to at most TIGHT_OFF_CENTRE margins a body, nothing is taken to press on it. */
#define TIGHT_OFF_CENTRE 16
#define TIGHT_STEPS_BACK 16
#define TIGHT_PULL 0x1p-20
/* Where that does not do, so many units are left of limits, of which rounding takes one at most. */
#define TIGHT_ROOM 2

/* ---- Large groups (contact_forces.c, blocks.c) ------------------------------------------------------------------- */

/* A contact is missed by less than this share of the layout. */
#define CONTACT_MISSED 1e-10
/* Movers of a block, to begin with; with fixed ones no more than so many. How often all blocks may be asked at least.
 * In dense groups of 40 to 100 bodies blocks of 6, asked four times, prove two to five tenths more than such of 9 and
 * more, or than twice as many questions, since their trees come to an end. */
#define BLOCK 6
#define MOST_IN_BLOCK 64
#define ROUNDS 4
/* The share of each weight that pays for rounding. */
#define SPARED 0x1p-30
/* So small a share of the cost counts for nothing. */
#define BLOCKS_NEAR 1e-4
/* The first stride is so wide, as a share of the way on which all that is missing would be proved if it went on as it
 * begins; with it no more than a fraction is promised. */
#define FIRST_STRIDE 0.4
/* The centre moves where this share of what was promised is proved; else strides are shortened so. Where half of it is
 * they are made longer. */
#define SERIOUS 0.1
#define SHORTER 0.7
#define LONGER 2
/* Shares of what is missing: of a promise of less larger blocks will prove more, if there is time; none is looked into
 * that is less than this. */
#define PROMISED_LITTLE 0.02
#define PROMISED_NOTHING 0.001
/* So many looks that together prove less than this share of what is missing are the last. */
#define LOOKS 3
#define PROVED_LITTLE 0x1p-6

/* ---- What cuts promise (bundle.c) -------------------------------------------------------------------------------- */

/* Trades in each block, at most; until slopes differ by no more than this share of the whole. */
#define SWEEPS 200
#define SWEPT 1e-6

/* ---- Pairs (forbidden.c, tree_cuts.c) ---------------------------------------------------------------------------- */

/* Of a pair with more pieces within reach only nearer ones are heeded. */
#define MOST_PIECES 4096
/* With more there is a tree of boxes over them, of so many in a leaf, and what cuts need is looked for when it is
 * needed; so many places that are free may be met on the way to a cut. */
#define MANY_PIECES 96
#define PIECES_IN_LEAF 4
#define MOST_GAPS 24
/* The disc in a piece is smaller than it could be by this share, far more than rounding. */
#define WITHIN_HAIR 0x1p-20

/* ---- Shares of the size of a pair's forbidden set ---------------------------------------------------------------- */

/* What is this little within it counts as free where cuts are proposed. */
#define FREE_HAIR 0x1p-37
/* A cut leaves so much beyond the hull, so that it can be proved, and so much at the second attempt; at the third this
 * share of how far it is from the place that it cuts off. */
#define CUT_ROOM 0x1p-34
#define CUT_MORE_ROOM 0x1p-32
#define CUT_FAR_ROOM 0.04
/* Deeper in it than this, a pair is in conflict. */
#define IN_CONFLICT 0x1p-31

/* A cut holds that is missed by no more than this; a limit that is overstepped by no more than this share of it. */
#define HOLDS 0x1p-40
#define OVERSTEPPED 0x1p-36

/* ---- A node (tree_node.c, tree_cuts.c, tree.c) ------------------------------------------------------------------- */

/* Cuts that are brought into a program one after the other. */
#define MOST_ADDED 4000
/* Regions of open nodes that are kept together, in bytes: of blocks of six symbols all. */
#define MOST_KEPT_BYTES (1u << 22)
/* Rounds of cuts at one node; a cut by a disc that takes away less than this share of its radius is not made. */
#define MOST_REFINED 12
#define DISC_SHARE 0.05
/* A hull that is no farther from u than this, of the pair's size, has it. */
#define IN_HULL 0x1p-31

/* ---- Branches (tree_branch.c) ------------------------------------------------------------------------------------ */

/* Conflicts that are tried as branches. */
#define TRIED 6
/* The line on which the other two ways out are: so much nearer than the nearest, of the way. */
#define NEARER 0.2
/* What is no wider than this share of the way ahead is a slot, which rays leave so wide. */
#define IN_SLOT 0x1p-16
#define BESIDE_SLOT 0x1p-4
/* So many grains away is no other place. */
#define STUCK 16

/* ---- Proofs that a region is covered (covered_region.c) ---------------------------------------------------------- */

/* A piece is left on a line that is this share of the way to the middle within it. */
#define LEAVING_ROOM 0x1p-10
/* How often a region is divided; how many looks all that may take: a proof that is not found is asked for again and
 * again, and its branch never closes. */
#define COVER_DEPTH 60
#define COVER_STEPS 200000u

/* ---- Pairs that are shut in (shut_in.c) -------------------------------------------------------------------------- */

/* Directions that are looked along, each turned so far from the one before; pieces of a pair; and in how many parts
 * each way its square is proved. */
#define OUTLOOKS 16
#define TURN_COS 0.9238795325112867
#define TURN_SIN 0.3826834323650898
#define MOST_SHUT_IN 200000u
#define SQUARE_PARTS 4
/* What shadows alone do not cover is left in regions divided so often. */
#define LEFT_DEPTH 3

/* ---- Hulls (free_hull.c) ----------------------------------------------------------------------------------------- */

/* Places that are looked at, and pieces on one side of a region; with more it is a guess. */
#define MOST_EXTREME 512
#define MOST_SPANS 128
/* What is so near to a piece, as a share of the set's size, is on its boundary; legs of a way down to a reflex corner,
 * and the least share of a leg that has to lead down. */
#define WALL_HAIR 0x1p-34
#define MOST_LEGS 6
#define LEAST_SLOPE 0.02

#endif
