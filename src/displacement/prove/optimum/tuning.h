/* These constants decide how near a bound comes to the cost and how long that takes, and never whether the bound holds.
 * None of them is an error bound. */
#ifndef SUNDER_I_OPTIMUM_TUNING_H
#define SUNDER_I_OPTIMUM_TUNING_H

/* SUNDER_I_OPTIMUM_TUNING_VERSION is the version of the values below. It is raised with each change of a value, so that
 * a record can name the values by their version (tests/house/TUNING). */
#define SUNDER_I_OPTIMUM_TUNING_VERSION 7

/* ---- Contacts (body_contact.c) ----------------------------------------------------------------------------------- */

/* Bodies are in contact if their distance exceeds the required distance by at most the share CONTACT of the gap or, if
 * that is 0, of the smaller body's width plus height. At gap 3 this is about what the interface says of clusters. */
#define CONTACT 0x1p-21

/* ---- Groups (optimum.c, conflicted_group.c) ---------------------------------------------------------------------- */

/* A group is optimal if its cost exceeds its bound by at most the share OPTIMAL_SHARE of the cost plus the amount
 * OPTIMAL_MORE, as the interface says. */
#define OPTIMAL_SHARE 1e-6
#define OPTIMAL_MORE 1e-7
/* A layout replaces the group's layout if it is cheaper by at least the share CHEAPER. */
#define CHEAPER 0x1p-40
/* goal_of() neglects moves of the share SMALL_LENGTH of a length. The length is the gap or, if that is 0, the share
 * SMALL_EXTENT of the smallest movable body's extent. */
#define SMALL_LENGTH 0x1p-17
#define SMALL_EXTENT 0x1p-4
/* A group with more than BRANCHED movable bodies is bounded by blocks, too; for a smaller group only branching is used
 * at first. The tree of the larger group gets one in TREE_FIRST of the steps at first (steps_of_large()). It gets one
 * in TREE_SECOND in all if it has proved the share TREE_SECOND_SHARE of its goal by then. From the share
 * TREE_WHOLE_SHARE on it gets all steps, without blocks, which never proved more there. */
#define BRANCHED 16
#define TREE_FIRST 16
#define TREE_SECOND 4
#define TREE_SECOND_SHARE 0.4
#define TREE_WHOLE_SHARE 0.7
/* Blocks are evaluated about BLOCKS_ASKED times. They are not used where making their pairs that many times would take
 * all steps (blocks_are_dear()). Nor are they used for a group with at most FEW movable bodies. */
#define BLOCKS_ASKED 24
#define FEW 4
/* A group with more than MOST_TOGETHER movable bodies is divided into parts of PART bodies each. */
#define MOST_TOGETHER 192
#define PART 96
/* The blocks of a part first get one in QUICK_LOOK of its steps, and all of them if that proves at least the share
 * QUICK_SHARE of its cost. Those of a crowd get all steps if the first trial proves less than QUICK_SHARE, since it was
 * too short then. After a tree or prices of area, look_at_blocks() makes such a trial, too; it has to prove
 * QUICK_AS_MUCH of what these proved. */
#define QUICK_LOOK 16
#define QUICK_SHARE 0.1
#define QUICK_AS_MUCH 0.75
/* A group that costs at least the share ASKED_SHARE of what it cost when it was last examined keeps its bound. It is
 * perturbed again with one in AGAIN of the steps. */
#define ASKED_SHARE 0.9
#define AGAIN 4
/* A group without limits gets neither a tree nor blocks if more than LARGE_FREE_CROWD of its bodies can move. For no
 * such group of Germany's or Italy's symbols did a tree prove 11 %; for smaller groups it proves the more, the smaller
 * they are. Trees of larger groups made one part in ten thousand of the layer's bound, which prices make, and took a
 * tenth of the time. With 96 Europe's bound is 0.5 % less. */
#define LARGE_FREE_CROWD 128
/* A group that is too large for a tree is crowded if it leaves at least one pair in conflict for every CROWDED of its
 * bodies; no large group of real layers within limits leaves one for ten. A crowded group gets one in CROWD_LOOK of its
 * steps, for blocks only. A town of terraces of 1,200 houses, with a quarter of the conflicts left, then has a bound of
 * 27 % of its cost in 2 s, instead of 37 % in 54 s; pairs alone prove 11 %. */
#define CROWDED 2
#define CROWD_LOOK 16
/* The branch and bound of a group (tree.c) takes in at most MOST_GUESTS guests: bodies that belong to no group, but
 * that a body of the group runs into at the minimiser of a node. */
#define MOST_GUESTS 24

/* ---- Places with no room to spare (tight_place.c, tight_step.c, tight_rows.c) ------------------------------------ */

/* A group of more than MOST_TIGHT bodies is not aligned; as many bodies outside it may take part. The lattice of the
 * coordinates is ignored if its step is less than the share TIGHT_STEP of the bodies' size. A coordinate counts as a
 * multiple of the step if it differs by at most the share TIGHT_HAIR of that size and the share TIGHT_STEP_HAIR of the
 * step. This is the error of a tree that does not come nearer to a corner by dividing. */
#define MOST_TIGHT 24
#define TIGHT_STEP 0x1p-18
#define TIGHT_HAIR 0x1p-22
#define TIGHT_STEP_HAIR 0x1p-8
/* For one body alone that has no limit the step is halved TIGHT_FINER times. */
#define TIGHT_FINER 4
/* Where there is room, TIGHT_MARGIN margins of the group are kept. */
#define TIGHT_MARGIN 4
/* Rows are moved away from their contacts in at most TIGHT_TURNS rounds; it takes many rounds where two contacts meet
 * at a narrow angle. */
#define TIGHT_TURNS 1000
/* A row on which no contact presses is centred if its weighted moves add up to at most TIGHT_OFF_CENTRE margins for
 * each body (centre_rows()). Rounded rows are moved back by one unit at a time, at most TIGHT_STEPS_BACK times. A
 * contact does not move its rows if the squared lengths by which they move along it add up to at most TIGHT_PULL; a
 * normal counts as along an axis if its component exceeds 1 - TIGHT_PULL. */
#define TIGHT_OFF_CENTRE 16
#define TIGHT_STEPS_BACK 16
#define TIGHT_PULL 0x1p-20
/* If moving rows back fails, limits are reduced by TIGHT_ROOM units, one of which covers rounding. */
#define TIGHT_ROOM 2

/* ---- Large groups (contact_forces.c, blocks.c) ------------------------------------------------------------------- */

/* A contact is violated if it misses more than the share CONTACT_MISSED of the root of the group's cost. */
#define CONTACT_MISSED 1e-10
/* A block has BLOCK movable bodies at first, and at most MOST_IN_BLOCK bodies with the fixed ones. The steps for one
 * evaluation are chosen so that all blocks are evaluated at least ROUNDS times. In dense groups of 40 to 100 bodies,
 * blocks of 6 that are evaluated four times prove 20 to 50 % more than blocks of 9 and more, or than twice as many
 * evaluations, since their trees complete. */
#define BLOCK 6
#define MOST_IN_BLOCK 64 /* fixed: the size of an array */
#define MOST_SPRINGS 256 /* fixed: the size of an array; further springs of a block do not count */
#define ROUNDS 4
/* The share SPARED of each weight is reserved for rounding. */
#define SPARED 0x1p-30
/* The improvement ends when the bound is within the share BLOCKS_NEAR of the cost. */
#define BLOCKS_NEAR 1e-4
/* first_stride() is the share FIRST_STRIDE of the way on which everything that is missing would be proved if the bound
 * kept growing at its initial rate. The initial rate promises more than comes true. */
#define FIRST_STRIDE 0.4
/* The centre moves if at least the share SERIOUS of the promise was proved; otherwise strides are multiplied by
 * SHORTER. If at least half of the promise was proved they are multiplied by LONGER. */
#define SERIOUS 0.1
#define SHORTER 0.7
#define LONGER 2
/* If the promise is at most the share PROMISED_LITTLE of the missing bound, larger blocks will prove more if there is
 * time. A promise of at most the share PROMISED_NOTHING is not pursued. */
#define PROMISED_LITTLE 0.02
#define PROMISED_NOTHING 0.001
/* If LOOKS evaluations together prove less than the share PROVED_LITTLE of the missing bound, they are the last. */
#define LOOKS 3
#define PROVED_LITTLE 0x1p-6

/* ---- What cuts promise (bundle.c) -------------------------------------------------------------------------------- */

/* settle_shares() makes at most SWEEPS sweeps, with one transfer in each block. They end when slopes differ by at most
 * the share SWEPT of the whole. */
#define SWEEPS 200
#define SWEPT 1e-6

/* ---- Pairs (forbidden.c, forbidden_places.c, tree_cuts.c) -------------------------------------------------------- */

/* For a pair with more than MOST_PIECES pieces within reach only the nearest MOST_PIECES count. */
#define MOST_PIECES 4096
/* A pair with more than MANY_PIECES pieces has a tree of boxes over them, with PIECES_IN_LEAF in a leaf, and the data
 * for cuts are computed on demand. At most MOST_GAPS free places may be met in the search for one cut. */
#define MANY_PIECES 96
#define PIECES_IN_LEAF 4
#define MOST_GAPS 24
/* The disc in a piece is made smaller by the share WITHIN_HAIR, which is far more than rounding. */
#define WITHIN_HAIR 0x1p-20

/* ---- Shares of the size of a pair's forbidden set (free_hull.c, tree_cuts.c, tree_pairs.c, tree_node.c) ---------- */

/* A place that is at most FREE_HAIR inside the forbidden set counts as free where cuts are proposed. */
#define FREE_HAIR 0x1p-37
/* A cut leaves the distance CUT_ROOM beyond the hull, so that it can be proved, and CUT_MORE_ROOM at the second
 * attempt. At the third attempt it leaves the share CUT_FAR_ROOM of its distance from the place that it cuts off. */
#define CUT_ROOM 0x1p-34
#define CUT_MORE_ROOM 0x1p-32
#define CUT_FAR_ROOM 0.04
/* A pair deeper than IN_CONFLICT inside its forbidden set is in conflict. */
#define IN_CONFLICT 0x1p-31

/* A cut holds if it is violated by at most HOLDS. A limit is not exceeded if the move exceeds it by at most the share
 * OVERSTEPPED of the limit. */
#define HOLDS 0x1p-40
#define OVERSTEPPED 0x1p-36

/* ---- Eased pairs (tree_eased.c) ---------------------------------------------------------------------------------- */

/* At most MOST_POINTS points are gathered for a lower hull, whose facet is found by at most MOST_EXCHANGED exchanges;
 * it may be above points by the share HULL_HAIR of the pair's size. Places count as one if they differ by the share
 * SAME_PLACE. Corners of the facet that are no points are as high as FAR_HEIGHT times the size at first. A slope that
 * falls by less than LEVEL is not used to clip. A cut is proposed at most MOST_LOWER times, each time with one more
 * point. */
#define MOST_POINTS 768 /* fixed: the size of an array */
#define MOST_EXCHANGED 400
#define HULL_HAIR 0x1p-44
#define SAME_PLACE 0x1p-36
#define FAR_HEIGHT 0x1p20
#define LEVEL 0x1p-20
#define MOST_LOWER 12

/* ---- Joined pieces (joined_piece.c, tree_eased.c) ---------------------------------------------------------------- */

/* A polygon is clipped in at most JOINED_ROUNDS rounds, each time in a direction that differs by at most JOINED_TURN
 * from that of the place to be left out, at the share JOINED_ROOM before the way out ends. A polygon is made if it
 * shows a depth that is greater by the share DEEPER of the pair's size. A polygon around the disc has AROUND_DISC
 * sides. */
#define JOINED_ROUNDS 40
#define AROUND_DISC 16
#define JOINED_TURN 0.4
#define JOINED_ROOM 0x1p-13
#define DEEPER 0x1p-13

/* ---- A node (tree_node.c, tree_regions.c, tree_cuts.c, tree.c) --------------------------------------------------- */

/* At most MOST_ADDED cuts are added to the program of a node, one after the other. */
#define MOST_ADDED 4000
/* The cached regions of open nodes take at most MOST_KEPT_BYTES bytes, enough for all nodes of blocks of six
 * symbols. */
#define MOST_KEPT_BYTES (1u << 22)
/* At most MOST_REFINED rounds of cuts are made at one node. A cut by a disc is not made if it removes less than the
 * share DISC_SHARE of the disc's radius. */
#define MOST_REFINED 12
#define DISC_SHARE 0.05
/* A hull contains u if its distance from u is at most the share IN_HULL of the pair's size. */
#define IN_HULL 0x1p-31

/* ---- Branches (tree_branch.c) ------------------------------------------------------------------------------------ */

/* At most TRIED conflicts are tried as branches of a node. */
#define TRIED 6
/* The two other ways out are looked for on a line across the shortest way out, nearer than its end by the share NEARER
 * of its length. */
#define NEARER 0.2
/* A free strip narrower than the share IN_SLOT of the way ahead is a slot. Rays leave a slot at an angle with the
 * tangent BESIDE_SLOT. */
#define IN_SLOT 0x1p-16
#define BESIDE_SLOT 0x1p-4
/* A conflict is stuck if its place differs from the one before by at most STUCK grains in x and y together
 * (is_stuck()). */
#define STUCK 16

/* ---- Proofs that a region is covered (covered_region.c) ---------------------------------------------------------- */

/* A region that lies partly in a piece is divided along a line inside that piece, at the share LEAVING_ROOM of the way
 * from the piece's edge to the middle of the region. */
#define LEAVING_ROOM 0x1p-10
/* After ACROSS_FROM cuts every second one is across the region's longest extent. */
#define ACROSS_FROM 12
/* A region is divided at most COVER_DEPTH times, with at most COVER_STEPS steps. The limit matters, since a proof that
 * is not found is sought again and again, and its branch never closes. */
#define COVER_DEPTH 60
#define COVER_STEPS 200000u

/* ---- Pairs that are shut in (shut_in.c, covered_region.c) -------------------------------------------------------- */

/* any_is_open() tries OUTLOOKS directions, each turned from the one before by the angle with the cosine TURN_COS and
 * the sine TURN_SIN. A pair with more than MOST_SHUT_IN pieces is not examined. The square around a pair is proved in
 * SQUARE_PARTS parts along each axis. */
#define OUTLOOKS 16
#define TURN_COS 0.9238795325112867
#define TURN_SIN 0.3826834323650898
#define MOST_SHUT_IN 200000u
#define SQUARE_PARTS 4
/* What shadows alone do not cover is kept in regions that are divided LEFT_DEPTH times. */
#define LEFT_DEPTH 3

/* ---- Hulls (free_hull.c) ----------------------------------------------------------------------------------------- */

/* At most MOST_EXTREME places are gathered for a hull, and at most MOST_SPANS pieces on one side of a region. With
 * more, the result is an estimate. */
#define MOST_EXTREME 512 /* fixed: the size of an array */
#define MOST_SPANS 128   /* fixed: the size of an array */
/* sunder_i_reflex_seek() descends to a reflex corner in at most MOST_LEGS legs. A point is on the boundary of a piece
 * if its distance from it is less than the share WALL_HAIR of the size of the set. The descent ends where the wall
 * descends by less than LEAST_SLOPE, the sine of the angle between the wall and the contour line. */
#define WALL_HAIR 0x1p-34
#define MOST_LEGS 6
#define LEAST_SLOPE 0.02

/* ---- Trees with prices (priced_tree.c) --------------------------------------------------------------------------- */

/* Such a tree is begun again with further polygons at most MOST_JOINED times. */
#define MOST_JOINED 32

/* ---- Chords across ends of sides (tree_chords.c) ----------------------------------------------------------------- */

/* At most TREE_SPOKES sides of one part of a barrier, with ends that an anchor passes, are compared. */
#define TREE_SPOKES 8 /* fixed: the size of an array */
/* Two chords are added across a corner. One cuts off the share WIDE_CHORD of the sides: a tree divides better by a wide
 * shadow. The other passes just behind the corner (CHORD). */
#define WIDE_CHORD 0x1p-3

#endif
