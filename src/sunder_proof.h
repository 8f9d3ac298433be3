/* sunder_proof.h: the proofs in a report: of the lower bound of the cost of a layer's moves, and of conflicts that have
 * no solution.
 *
 * Every double in a proof stands for its exact value, so that a proof can be checked in rational arithmetic without
 * this library; docs/PROOF.md says what a checker has to do. The whole header is experimental: see sunder.h and
 * docs/api.md. The report owns all that the functions below return; it is valid until the report is freed. */
#ifndef SUNDER_PROOF_H
#define SUNDER_PROOF_H

#include "sunder.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The bound of pairs ----------------------------------------------------------------------------------- */

/* A pair from which sunder_layer_summary.pair_bound was computed: two features of different blocks (a feature in no
 * block counts as a block of its own), or a feature and a barrier. The pairs suffice to compute the bound again.
 * `least` is the length of the least relative move that separates the pair, rounded down. `multiplier` is the
 * multiplier of the pair's condition |t_a| + |t_b| >= least, by which weak duality proves the bound. */
typedef struct sunder_bound_pair {
    size_t a, b; /* a is a feature; b is a feature, or the number of features + k for barrier k */
    double least, multiplier;
} sunder_bound_pair;
/* Returns the pairs of pair_bound, and sets *n to their number. */
SUNDER_EXPERIMENTAL const sunder_bound_pair *sunder_report_bound_pairs(const sunder_report *report, size_t *n);

/* ---- The bound of trees ----------------------------------------------------------------------------------- */

/* The trees of branch and bound that prove sunder_layer_summary.lower_bound. They are kept if
 * sunder_layer_options.keep_trees is set. Each contact group of the result has one tree, or several trees that share
 * its bodies and their weights. If pairs prove more of a part of the layer than its contact groups do, the part has
 * trees of two bodies instead, one for each pair. docs/PROOF.md, sections 3 and 5, says what each part of a tree
 * claims, and why the bound follows.
 *
 * A body is a block, a feature in no block, or a barrier; t_i is the move of body i. A tree proves a lower bound of the
 * sum, over its bodies, of weight |t - shift|^2, plus what its springs cost (SUNDER_BOUND_CUT_SPRING), plus the prices
 * of what its eased pairs lack. A cut is a condition n.(t_j - t_i) + share s >= d, where s is what the pair lacks; the
 * share is 0 for most cuts. A node has the cuts of its parent and cuts of its own. Its forces are multipliers of some
 * of these cuts, or of springs, which prove a value by weak duality. */
typedef struct sunder_bound_body {
    size_t thing;    /* a member of the block, or the feature; or the number of features + k for barrier k */
    double weight;   /* the part of the body's weight that this tree uses; INFINITY if the body does not move */
    double shift[2]; /* the move from which the cost is measured; (0, 0) for a body that does not move */
} sunder_bound_body;

/* A condition on the relative move u = t_j - t_i of bodies i and j: a convex part of j, moved by u, may not come nearer
 * to a convex part of i than `clearance`. With `row` it is the rule of rows for these two bodies instead
 * (sunder_row_pair in sunder_parts.h); then a and b are any features of the two, and there are no parts. */
typedef struct sunder_bound_piece {
    size_t i, j;                 /* indices in sunder_bound_tree.body */
    size_t a, b;                 /* the features, or barriers, that contain the two parts */
    size_t part_a, part_b;       /* the first corner of each part in sunder_bound_tree.corner, at its original place */
    size_t corners_a, corners_b; /* the number of corners of each part */
    bool shadow;                 /* one part is an anchor, which may not jump over the other part: see sunder_proof */
    bool row;
    bool priced; /* it forbids nothing: the pair lacks at least its full distance, less the distance of u from the
                  * polygon of all moves at which the two parts overlap, plus its depth in that polygon; with `row` at
                  * least what u lacks of the rule of rows with the full gap (sunder_layer_options.full_gap) */
    /* If it is joined, `part_a` is a polygon instead, in the plane of u, and there is no second part. It lies in the
     * union of the polygons of the pieces that it names (as a cut does), all of the same a and b. It is priced. */
    bool joined;
    size_t named, names;
    /* NAN for a pair that has to keep its distance. The other pairs are in conflict in the result. If the
     * interiors of such a pair did not meet at the start, the clearance is at most its distance then. If they met, and
     * by the kind of the conflict no longer meet, the clearance is 0. If they still meet, the clearance is -D: some
     * translation no longer than D must separate the pair, and the least such translation at the start was no longer
     * than D. */
    double clearance;
} sunder_bound_piece;

typedef enum sunder_bound_cut_kind {
    SUNDER_BOUND_CUT_LIMIT, /* the limit of body i, with j = SIZE_MAX: every move within the limit satisfies the cut */
    SUNDER_BOUND_CUT_CONE,  /* a branch: the cones of a node's three children cover the plane */
    SUNDER_BOUND_CUT_DISC,  /* moves that violate the cut cost at least the tree's bound, by the forces `by` of the node
                             * or, if it has none, by the forces of its parent */
    SUNDER_BOUND_CUT_HULL,  /* moves that violate the cut are forbidden by the pieces that it names, or cost at least
                             * the tree's bound */
    SUNDER_BOUND_CUT_SPRING, /* one sign of a spring of a row: moves that violate the cut by v cost stiff * v^2 */
    SUNDER_BOUND_CUT_PRICE   /* moves that violate the cut are forbidden by the pieces that it names, or lack more by
                             * them, or cost at least the tree's bound */
} sunder_bound_cut_kind;

typedef struct sunder_bound_cut {
    sunder_bound_cut_kind kind;
    size_t i, j;         /* indices in sunder_bound_tree.body */
    double n[2], d;      /* the cut is n.(t_j - t_i) + share s >= d; a limit is -n.t_i >= d */
    double stiff;        /* only of a spring, for which d = 0 */
    double share;        /* above 0 only for SUNDER_BOUND_CUT_PRICE: bodies i and j are an eased pair then */
    size_t named, names; /* the first entry in sunder_bound_tree.named, and the number of pieces that the cut names */
} sunder_bound_cut;

typedef struct sunder_bound_force {
    size_t cut;   /* index in sunder_bound_tree.cut of a cut on the path from the root to the node */
    double force; /* the multiplier of the cut, >= 0 */
} sunder_bound_force;

typedef struct sunder_bound_node {
    size_t parent;        /* index of an earlier node; SIZE_MAX for node 0, the root */
    size_t cut, cuts;     /* the node's own cuts in sunder_bound_tree.cut: the first, and their number, in the order in
                           * which they were made */
    size_t force, forces; /* the node's forces in sunder_bound_tree.force: the first, and their number */
    size_t by, bys;       /* forces in sunder_bound_tree.force, on cuts of the nodes above, that prove the node's cuts
                           * of kind SUNDER_BOUND_CUT_DISC */
    /* True if the pieces that the node names forbid all relative moves of bodies i and j that the cuts allow and that
     * cost less than the tree's bound. The four members below are used only then; they are as in sunder_bound_cut. */
    bool empty;
    size_t i, j, named, names;
} sunder_bound_node;

/* Prices of area, which prove a bound without nodes: docs/PROOF.md, section 5. Node (i, j) of a grid of squares is at
 * side * (x + i, y + j). The price of a unit of area there is unit * price; it is bilinear in each square, and 0
 * outside the grid. No two bodies may occupy the same area. So the cost of all bodies is at least the sum, over the
 * bodies, of the least that a body's move and the area that it occupies cost together, minus the price of the whole
 * plane. */
typedef struct sunder_bound_prices {
    double side, unit;     /* the side of a square, and the value of a price of 1; powers of 2 */
    int64_t x, y;          /* the first node, in squares */
    size_t columns, rows;  /* the number of nodes in a row, and of rows */
    const uint32_t *price; /* [columns * rows]; NULL for a tree without prices */
} sunder_bound_prices;

/* Two bodies i < j, of which one may move, and some features of which are in conflict in the result. What they lack is
 * the most that such a pair of features lacks. With a full gap any two bodies, and the most that any pair lacks. */
typedef struct sunder_bound_eased {
    size_t i, j; /* indices in sunder_bound_tree.body */
} sunder_bound_eased;

typedef struct sunder_bound_tree {
    size_t group; /* the number of the contact group; trees of one group follow each other */
    double bound; /* the lower bound that the tree proves */
    const sunder_bound_body *body;
    const sunder_bound_piece *piece;
    const sunder_bound_cut *cut;
    const sunder_bound_force *force;
    const sunder_bound_node *node;
    const sunder_bound_eased *eased; /* the pairs whose prices are part of the bound; no other tree has them */
    const size_t *named;             /* indices in `piece` */
    const double *corner;            /* [2 * corners] x and y of the corners of all parts */
    size_t bodies, pieces, cuts, forces, nodes, eased_pairs, names, corners;
    size_t springs;             /* the first cuts are springs, which belong to no node; the others follow */
    sunder_bound_prices prices; /* if the tree has prices, these prove its bound, and it has no nodes */
} sunder_bound_tree;

/* Returns the trees, and sets *n to their number; there are none unless keep_trees was set. */
SUNDER_EXPERIMENTAL const sunder_bound_tree *sunder_report_bound_trees(const sunder_report *report, size_t *n);

/* ---- Conflicts without a solution ------------------------------------------------------------------------- */

/* A proof that a conflict has no solution. It can be checked in rational arithmetic: docs/PROOF.md, section 4.
 *
 * A block moves by a translation t with |t| <= limit; a feature in no block counts as a block of its own. The limit of
 * a block is the least max_shift of its members, or 0 if one of them is fixed or ignored. A barrier has the limit 0.
 * The proof is a tree; node 0 is its root.
 *
 * An inner node (ways > 0) is about the features a and b of blocks A and B. Let u = t_B - t_A. The node has two parts,
 * which are convex polygons within a and b, counter-clockwise, at their original places. The claim of the node: any u
 * at which the second part, moved by u, keeps the clearance from the first part has n.u >= d for at least one of the
 * node's ways. (To keep a clearance c >= 0 means that the interiors of the parts are disjoint, and that their distance
 * is at least c. To keep a clearance c < 0 means that some translation no longer than -c makes the interiors disjoint.)
 * If the pair is the conflict itself, or is not among the conflicts, the clearance is at most the distance that the
 * pair has to keep. For any other conflict it is at most the value at the start: the distance, or minus the length of
 * the least translation that separates the pair. `next` of a way is the node for the case that this way is the first of
 * the node's ways with n.u >= d; then n.u < d for all ways before it.
 *
 * If `shadow` is set, one of the two parts is a single corner. Either the corner is the anchor of its feature, the
 * other feature does not contain the anchor, and the other part is a polygon within that other feature. Or b is a
 * barrier, the corner is the side anchor of feature a, and the other part has two corners: it is a segment of one of
 * the barrier's lines, or an edge of one of its areas, with the area on the left and the side anchor on the right. The
 * claim of the node is then: any u at which the straight path of the corner, relative to the other part, does not meet
 * the interior of that polygon, or that segment, has n.u >= d for at least one of the node's ways. The clearance is not
 * used.
 *
 * If `chord` is set, `shadow` is set too, and the node is about two sides: such a segment or edge of barrier b, and one
 * of barrier c, which may be b itself. The two sides have one end x in common. Their other ends lie on opposite sides
 * of the ray from the side anchor through x. The second part is the chord, a segment that this ray crosses at x or
 * beyond x. One end of the chord is strictly inside the shadow of one side, and the other end strictly inside the
 * shadow of the other side. So the shadow of the chord lies in the union of the shadows of the two sides.
 *
 * If `slack` is set, the clearance is negative, and the pair is not the conflict itself. Then some translation v, no
 * longer than minus the clearance, makes the interiors of all parts of the pair disjoint. The same v is used at all
 * nodes of the pair with `slack`. The ways of these nodes are about u = t_B + v - t_A, and any u at which the interiors
 * of the two parts are disjoint has n.u >= d for at least one way.
 *
 * If `row` is set, the node is about the rule of rows for blocks A and B (sunder_row_pair in sunder_parts.h), of
 * which a and b are any members. There are no parts, and one way: any u that keeps the rule has n.u >= d. It is the
 * weaker rule if a pair of members of the two blocks is listed, besides the conflict itself.
 *
 * A leaf (ways == 0) has positive forces. Each is on a way of a node above the leaf: on the way that leads to the leaf
 * (let m = n and h = d), or, with `behind`, on a way before that one (let m = -n and h = -d). In the case of the leaf
 * m.u >= h for each force. But the sum of force * h is greater than two sums together: the sum over blocks of limit *
 * |sum of force * m|, where m counts with a minus sign if the block is A of its node; and the sum over pairs with slack
 * of minus the clearance * |sum of force * m|. So no moves within the limits satisfy the case of the leaf. The two may
 * be equal if m.u > h for some force. That holds with `behind`, unless the node has `shadow` and b is a barrier. For
 * such a node it holds without `behind`: a side is closed, so a path that does not meet it has n.u > d for some way.
 * The case of a way is then that it is the first with n.u > d.
 *
 * If `held` is set, the pair is not the conflict itself. It has to keep exactly its distance at the start or, if its
 * interiors met, minus the length of the least translation that separated it then; `clearance` is only near to that
 * value. So a way may have d = 0: its line passes through the place where the two features stood relative to each
 * other. With both `slack` and `held` the first way of the node says more than n.u >= d: it says n.u >= h, where h is
 * the greatest of n.(p - q) over corners p of the first part and q of the second.
 *
 * If a leaf is `still`, it names two ways that lead to it, line_way[k] of node line_node[k]. Both are about the same
 * block and something that does not move, both have d = 0, and their n are opposite to each other. (One of the two may
 * instead be the first way of a node with `held` and `slack`, if h is at least |n| times the length of the least
 * translation that separated the pair at the start: then n.u >= 0 also without the slack v.) So the move t of the block
 * satisfies n.t = 0. A move is valid only if all corners of the block are doubles before and after it. So each
 * coordinate of t is a multiple of a unit, the spacing of doubles at the coordinate of least size that a corner can
 * have within the limit. The shortest such t with n.t = 0, other than 0, is longer than the limit. Hence t = 0, and the
 * limit of the block counts as 0 in that leaf. */
typedef struct sunder_proof_way {
    double n[2], d; /* the condition n.u >= d */
    size_t next;    /* index in sunder_proof.node */
} sunder_proof_way;

typedef struct sunder_proof_force {
    size_t node, way; /* a node above the leaf, and one of its ways, as an index in sunder_proof.way */
    bool behind;      /* the way is one before the way that leads to the leaf */
    double force;     /* the multiplier, > 0 */
} sunder_proof_force;

typedef struct sunder_proof_node {
    size_t a, b;                 /* features; b may be the number of features + k, for barrier k */
    size_t part_a, part_b;       /* the first corner of each part, as an index of corners in sunder_proof.corner */
    size_t corners_a, corners_b; /* the number of corners of each part */
    double clearance;
    bool shadow;                      /* one of the parts is an anchor: see above */
    bool slack;                       /* the second part is also moved by the slack v of the pair: see above */
    bool held;                        /* the pair has to keep exactly its value at the start: see above */
    size_t way, ways;                 /* the first way in sunder_proof.way, and the number of ways; 0 ways: a leaf */
    size_t force, forces;             /* of a leaf: the first force in sunder_proof.force, and their number */
    bool still;                       /* of a leaf: a block between the lines of two ways cannot move: see above */
    size_t line_node[2], line_way[2]; /* if `still`: two nodes, and one way of each, as an index in sunder_proof.way */
    bool row;                         /* the node is about the rule of rows: see above */
    bool chord;                       /* the second part is a chord across the common end of two sides: see above */
    /* If `chord`: c is the barrier that has the second side, numbered as b. sides is the index of the first of four
     * corners in sunder_proof.corner, the two ends of the side of b and the two ends of the side of c. */
    size_t c, sides;
} sunder_proof_node;

typedef struct sunder_proof {
    const sunder_proof_node *node;
    const sunder_proof_way *way;
    const sunder_proof_force *force;
    const double *corner; /* [2 * corners] x and y of the corners of all parts */
    size_t nodes, ways, forces, corners;
    double within; /* the limit that the proof assumes for blocks without a limit; 0 if there are none */
} sunder_proof;

/* Returns the proof of conflict k of sunder_report_conflicts(), or NULL if it has none. No conflict has a proof if
 * sunder_layer_options.drop_proofs was set. Otherwise these have one:
 *
 * SUNDER_REASON_NO_ROOM, and every conflict that is `crowded`
 *     The features and barriers of the nodes, except the two in conflict, are the conflict's blocked_by.
 * SUNDER_REASON_SIDE, and most conflicts with SUNDER_REASON_JUMP
 *     The nodes are about the pair, and about shadows of members of its two blocks.
 * SUNDER_REASON_ROW
 *     The same, and nodes about the rule of rows for the two blocks.
 * SUNDER_REASON_MAX_SHIFT, if keep_trees was set and a proof was found
 *     The nodes are about the pair only.
 *
 * If one of the two blocks has no limit, the proof assumes `within` as its limit: a length such that the two are
 * certainly far enough apart after any longer relative move. Only shadows forbid such a longer move, and a shadow that
 * contains a move contains all longer moves in the same direction, so the assumption excludes no solution. With
 * SUNDER_REASON_NO_ROOM, and for a `crowded` conflict, all nodes of such a proof are about members of the two blocks,
 * or about a member of the feature's block and a barrier. */
SUNDER_EXPERIMENTAL const sunder_proof *sunder_report_proof(const sunder_report *report, size_t k);

#ifdef __cplusplus
}
#endif
#endif
