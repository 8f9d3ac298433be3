/* Numbers of this room that are not error bounds: they decide how near a bound comes to the cost and how long it takes,
 * never whether it holds. */
#ifndef SUNDER_I_OPTIMUM_TUNING_H
#define SUNDER_I_OPTIMUM_TUNING_H

/* The version of these values; raised with each change of one, so that a record can name it (tests/house/TUNING). */
#define SUNDER_I_OPTIMUM_TUNING_VERSION 1

/* ---- Contacts (body_contact.c) ----------------------------------------------------------------------------------- */

/* Bodies are in contact if their distance exceeds the distance owed by at most this share of the gap; at gap 3 that is
 * about what the interface says of clusters. */
#define CONTACT 0x1p-21

/* ---- Groups (optimum.c) ------------------------------------------------------------------------------------------ */

/* A group is optimal if its cost exceeds its bound by at most this share of it plus this amount; as the interface
 * says. */
#define OPTIMAL_SHARE 1e-6
#define OPTIMAL_MORE 1e-7
/* A layout counts as cheaper by at least this share. */
#define CHEAPER 0x1p-40
/* A negligible length, as a share of the gap or, if that is 0, of this share of a body's extent. */
#define SMALL_LENGTH 0x1p-17
#define SMALL_EXTENT 0x1p-4
/* With more movable bodies than BRANCHED a group is bounded by blocks, too. Branching then gets one in TREE_FIRST of
 * the steps at first; one in TREE_SECOND in all if it has proved TREE_SECOND_SHARE of the goal by then; and all steps,
 * without blocks, from TREE_WHOLE_SHARE on, where blocks never proved more. With at most BRANCHED bodies only branching
 * is used. */
#define BRANCHED 16
#define TREE_FIRST 16
#define TREE_SECOND 4
#define TREE_SECOND_SHARE 0.4
#define TREE_WHOLE_SHARE 0.7
/* The approximate number of times that blocks are evaluated; they are not used where making their pairs would take all
 * steps. */
#define BLOCKS_ASKED 24
#define FEW 4
/* A group with more movable bodies is divided into parts of this size. */
#define MOST_TOGETHER 192
#define PART 96
/* A part first gets one in QUICK_LOOK of its steps; all of them if that proves QUICK_SHARE of its cost. A crowd gets
 * them if it does not. */
#define QUICK_LOOK 16
#define QUICK_SHARE 0.1
#define QUICK_AS_MUCH 0.75
/* A group whose cost is at least this share of what it was when examined keeps its bound; it is perturbed with one in
 * AGAIN of the steps. */
#define ASKED_SHARE 0.9
#define AGAIN 4
/* A group without limits gets neither a tree nor blocks if more of its bodies move than this: for no such group of
 * Germany's or Italy's symbols did a tree prove 11 %, for smaller groups the more the smaller. They made one part in
 * ten thousand of the layer's bound, which prices make, for a tenth of the time. (With 96 Europe's bound is 0.5 %
 * less.) */
#define LARGE_FREE_CROWD 128
/* A group too large for a tree is crowded if it leaves a pair in conflict for every CROWDED of its bodies: no large
 * group of real layers within limits leaves one for ten. It gets one in CROWD_LOOK of its steps, for blocks only. A
 * town of terraces of 1,200 houses, with a quarter of the conflicts left, then has a bound of 27 % of its cost, in 2 s,
 * instead of 37 % in 54 s; pairs alone prove 11 %. */
#define CROWDED 2
#define CROWD_LOOK 16
/* At most this many bodies in the way may join. */
#define MOST_GUESTS 24

/* ---- Places with no room to spare (tight_place.c) ---------------------------------------------------------------- */

/* The most bodies, and as many outside. A lattice is ignored if its step is less than this share of the bodies' size.
 * Coordinates count as multiples of the step up to TIGHT_HAIR of that size, and at most TIGHT_STEP_HAIR of the step:
 * the error of a tree that does not get nearer to a corner by dividing. */
#define MOST_TIGHT 24
#define TIGHT_STEP 0x1p-18
#define TIGHT_HAIR 0x1p-22
#define TIGHT_STEP_HAIR 0x1p-8
/* Margins that are left where there is room. */
#define TIGHT_MARGIN 4
/* Rows are moved away from their contacts at most TIGHT_TURNS times (where two meet at a narrow angle it takes many
 * turns), and moved back by a unit at most TIGHT_STEPS_BACK times; not from a contact along which they hardly move. */
#define TIGHT_TURNS 1000
/* If the weighted moves of a row add up to at most TIGHT_OFF_CENTRE margins a body, nothing is taken to press on it. */
#define TIGHT_OFF_CENTRE 16
#define TIGHT_STEPS_BACK 16
#define TIGHT_PULL 0x1p-20
/* If that fails, limits are reduced by this many units, one of which covers rounding. */
#define TIGHT_ROOM 2

/* ---- Large groups (contact_forces.c, blocks.c) ------------------------------------------------------------------- */

/* A contact is violated by less than this share of the layout. */
#define CONTACT_MISSED 1e-10
/* Initial number of movable bodies in a block; its largest number with fixed ones; and how often all blocks are
 * evaluated at least. In dense groups of 40 to 100 bodies blocks of 6, evaluated four times, prove 20 to 50 % more than
 * blocks of 9 and more, or than twice as many evaluations, since their trees complete. */
#define BLOCK 6
#define MOST_IN_BLOCK 64 /* fixed: the size of an array */
#define ROUNDS 4
/* The share of each weight reserved for rounding. */
#define SPARED 0x1p-30
/* A negligible share of the cost. */
#define BLOCKS_NEAR 1e-4
/* The first stride, as a share of the way on which everything missing would be proved if the bound kept growing at its
 * initial rate; that promises only a fraction of it. */
#define FIRST_STRIDE 0.4
/* The centre moves if this share of the promise was proved; otherwise strides are multiplied by SHORTER. If half of it
 * was proved they are multiplied by LONGER. */
#define SERIOUS 0.1
#define SHORTER 0.7
#define LONGER 2
/* Shares of the missing bound: below the first, larger blocks will prove more, if there is time; a promise below the
 * second is not pursued. */
#define PROMISED_LITTLE 0.02
#define PROMISED_NOTHING 0.001
/* If this many evaluations together prove less than this share of the missing bound, they are the last. */
#define LOOKS 3
#define PROVED_LITTLE 0x1p-6

/* ---- What cuts promise (bundle.c) -------------------------------------------------------------------------------- */

/* The most transfers in each block; they end when slopes differ by at most this share of the whole. */
#define SWEEPS 200
#define SWEPT 1e-6

/* ---- Pairs (forbidden.c, tree_cuts.c) ---------------------------------------------------------------------------- */

/* For a pair with more pieces within reach only the nearest count. */
#define MOST_PIECES 4096
/* With more pieces there is a tree of boxes over them, with PIECES_IN_LEAF in a leaf, and the data for cuts are
 * computed on demand. At most MOST_GAPS free places may be met on the way to a cut. */
#define MANY_PIECES 96
#define PIECES_IN_LEAF 4
#define MOST_GAPS 24
/* The disc in a piece is made smaller by this share, far more than rounding. */
#define WITHIN_HAIR 0x1p-20

/* ---- Shares of the size of a pair's forbidden set ---------------------------------------------------------------- */

/* A place this little inside counts as free where cuts are proposed. */
#define FREE_HAIR 0x1p-37
/* A cut leaves CUT_ROOM beyond the hull, so that it can be proved, and CUT_MORE_ROOM at the second attempt; at the
 * third CUT_FAR_ROOM of its distance from the place that it cuts off. */
#define CUT_ROOM 0x1p-34
#define CUT_MORE_ROOM 0x1p-32
#define CUT_FAR_ROOM 0.04
/* A pair deeper inside than this is in conflict. */
#define IN_CONFLICT 0x1p-31

/* A cut holds if it is violated by at most this; a limit if it is exceeded by at most this share of it. */
#define HOLDS 0x1p-40
#define OVERSTEPPED 0x1p-36

/* ---- A node (tree_node.c, tree_cuts.c, tree.c) ------------------------------------------------------------------- */

/* The most cuts added to a program, one after the other. */
#define MOST_ADDED 4000
/* Bytes for the cached regions of open nodes: enough for all those of blocks of six symbols. */
#define MOST_KEPT_BYTES (1u << 22)
/* Rounds of cuts at one node; a cut by a disc that removes less than this share of its radius is not made. */
#define MOST_REFINED 12
#define DISC_SHARE 0.05
/* A hull within this distance of u, as a share of the pair's size, contains it. */
#define IN_HULL 0x1p-31

/* ---- Branches (tree_branch.c) ------------------------------------------------------------------------------------ */

/* Conflicts that are tried as branches. */
#define TRIED 6
/* The line with the other two ways out is nearer than the nearest by this share of its distance. */
#define NEARER 0.2
/* A free strip narrower than this share of the way ahead is a slot; rays leave a slot at this angle. */
#define IN_SLOT 0x1p-16
#define BESIDE_SLOT 0x1p-4
/* Places within this many grains of each other count as one. */
#define STUCK 16

/* ---- Proofs that a region is covered (covered_region.c) ---------------------------------------------------------- */

/* A piece is left along a line inside it by this share of the way to the middle. */
#define LEAVING_ROOM 0x1p-10
/* How often a region is divided, and the most looks that takes. The limit matters, since a proof that is not found is
 * sought again and again, and its branch never closes. */
#define COVER_DEPTH 60
#define COVER_STEPS 200000u

/* ---- Pairs that are shut in (shut_in.c) -------------------------------------------------------------------------- */

/* Number of directions tried, each turned by this angle from the one before; the most pieces of a pair; and the number
 * of parts along each axis in which its square is proved. */
#define OUTLOOKS 16
#define TURN_COS 0.9238795325112867
#define TURN_SIN 0.3826834323650898
#define MOST_SHUT_IN 200000u
#define SQUARE_PARTS 4
/* The part not covered by shadows alone is kept in regions divided this many times. */
#define LEFT_DEPTH 3

/* ---- Hulls (free_hull.c) ----------------------------------------------------------------------------------------- */

/* The most places looked at, and pieces on one side of a region; with more the result is an estimate. */
#define MOST_EXTREME 512 /* fixed: the size of an array */
#define MOST_SPANS 128 /* fixed: the size of an array */
/* The descent to a reflex corner (free_hull.c). A point is on the boundary of a piece if its distance from it is
 * less than WALL_HAIR times the size of the set. A descent has at most MOST_LEGS legs. It ends where the wall
 * descends by less than LEAST_SLOPE, the sine of the angle between the wall and the contour line. */
#define WALL_HAIR 0x1p-34
#define MOST_LEGS 6
#define LEAST_SLOPE 0.02

#endif
