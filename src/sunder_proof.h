/* sunder_proof.h: what a report proves: a lower bound of the cost of a layer's moves, and conflicts without a solution.
 *
 * Every number in a proof means itself, exactly, so that rational arithmetic can follow it without this library;
 * docs/PROOF.md says what a checker has to do. All of this header is experimental: see sunder.h and docs/api.md. */
#ifndef SUNDER_PROOF_H
#define SUNDER_PROOF_H

#include "sunder.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The bound of pairs ----------------------------------------------------------------------------------- */

/* The pairs that pair_bound stands on, so that it can be computed again: a feature of each of two blocks, or one
 * that stands alone, least separations rounded down, multipliers. */
typedef struct sunder_bound_pair {
    size_t a, b; /* features, one of each block */
    double least, multiplier;
} sunder_bound_pair;
SUNDER_EXPERIMENTAL const sunder_bound_pair *sunder_report_bound_pairs(const sunder_report *report, size_t *n);

/* ---- The bound of trees ----------------------------------------------------------------------------------- */

/* What lower_bound stands on, where keep_trees was asked for: trees of branch and bound, one for each contact group of
 * the result, or several that share its bodies. Every number in them means itself, exactly, and rational arithmetic can
 * follow: docs/PROOF.md says what each line of it claims, and why that follows.
 *
 * A tree is about the least of the sum, over its bodies, of weight |t - shift|^2, t their moves. Its cuts say
 * n.(t_j - t_i) >= d; its nodes add cuts to those of their parents, and have forces on some of them, which prove a
 * value by weak duality. */
typedef struct sunder_bound_body {
    size_t thing;    /* a member of a block, or a feature by itself; the number of features + k: barrier k */
    double weight;   /* at most its own; INFINITY: it does not move */
    double shift[2]; /* 0 for what does not move */
} sunder_bound_body;

/* What bodies i and j may not do: their convex parts may not come nearer than they owe, by u = t_j - t_i. */
typedef struct sunder_bound_piece {
    size_t i, j;
    size_t a, b;           /* the features, or barriers, that the parts are of */
    size_t part_a, part_b; /* their first corners, as they stood at the start */
    size_t corners_a, corners_b;
    bool shadow; /* one of the parts is an anchor, which may not jump over the other: see sunder_proof */
    /* NAN: the pair owes its full distance. Otherwise the pair is left in conflict, and held to this: to at most the
     * distance that it had; if its interiors met then, and by the kind of the conflict no longer do, to 0; if they
     * still do, to some translation that separates them, no longer than minus this, which is no less than the least at
     * the start. */
    double clearance;
} sunder_bound_piece;

typedef enum sunder_bound_cut_kind {
    SUNDER_BOUND_CUT_LIMIT, /* of body i, j = SIZE_MAX: no move is longer than allowed */
    SUNDER_BOUND_CUT_CONE,  /* of a branch: the cones of the children of a node cover the plane */
    SUNDER_BOUND_CUT_DISC,  /* beyond it all costs the tree's bound, by the forces `by` of its node */
    SUNDER_BOUND_CUT_HULL   /* what it takes away is covered by its pieces */
} sunder_bound_cut_kind;

typedef struct sunder_bound_cut {
    sunder_bound_cut_kind kind;
    size_t i, j; /* of the tree's bodies */
    double n[2], d;
    size_t named, names; /* in sunder_bound_tree.named: its pieces */
} sunder_bound_cut;

typedef struct sunder_bound_force {
    size_t cut; /* of all cuts; on the way from the root to the node */
    double force;
} sunder_bound_force;

typedef struct sunder_bound_node {
    size_t parent;        /* an earlier node; of node 0, the root, SIZE_MAX */
    size_t cut, cuts;     /* in the order in which they were made */
    size_t force, forces; /* what it proves */
    size_t by, bys;       /* forces on cuts of the nodes above, which its discs stand on */
    bool empty;           /* what the cuts leave to bodies i and j is covered by these pieces */
    size_t i, j, named, names;
} sunder_bound_node;

/* Prices of area, whole numbers of `unit` a unit of area at the nodes of a lattice, bilinear between them, 0 beyond:
 * node (i, j) is the place side * (x + i, y + j). No two of a tree's bodies share area, so that they cost at least what
 * each pays for moving, and for the area that it stands on, at the least; less the worth of all area. */
typedef struct sunder_bound_prices {
    double side, unit; /* powers of 2 */
    int64_t x, y;
    size_t columns, rows;
    const uint32_t *price; /* [columns * rows]; NULL: none */
} sunder_bound_prices;

typedef struct sunder_bound_tree {
    size_t group; /* trees of one group follow each other */
    double bound;
    const sunder_bound_body *body;
    const sunder_bound_piece *piece;
    const sunder_bound_cut *cut;
    const sunder_bound_force *force;
    const sunder_bound_node *node;
    const size_t *named;  /* pieces */
    const double *corner; /* [2 * corners] */
    size_t bodies, pieces, cuts, forces, nodes, names, corners;
    sunder_bound_prices prices; /* where it has such, they prove its bound, and it has no nodes */
} sunder_bound_tree;

/* They live as long as the report. */
SUNDER_EXPERIMENTAL const sunder_bound_tree *sunder_report_bound_trees(const sunder_report *report, size_t *n);

/* ---- Conflicts without a solution ------------------------------------------------------------------------- */

/* A proof that a conflict has no solution, which can be verified in rational arithmetic. Every number in it is exact.
 *
 * Let t be the moves of blocks (a feature that stands alone is one), no longer than the block's limit: the least
 * max_shift of its members, 0 if one is fixed or ignored. The proof is a tree, node 0 its root.
 *
 * An inner node (ways > 0) is about the pair of features a and b, of blocks A and B; let u = t_B - t_A. Its parts are
 * convex polygons within a and b, counter-clockwise, at their original places. Any u at which the second part, moved by
 * it, keeps the clearance from the first, has n.u >= d for at least one of the node's ways. (To keep a clearance c >=
 * 0: disjoint interiors, and a distance of at least c. A clearance c < 0: some translation no longer than -c makes
 * their interiors disjoint.) The clearance is at most what the pair owes: the gap, if it is the conflict itself, or is
 * not among the conflicts; otherwise its value at the start, the distance or minus the length of the least translation
 * that separates it. The way's `next` is the node for the case that it is the first of them with n.u >= d, so that n.u
 * < d for those before.
 *
 * With `shadow`, one of the two parts is a single corner, the anchor of its feature, which the other feature does not
 * contain; the other part is one of that feature. Or b is a barrier, the corner is the side anchor of its feature, and
 * the other part has two: a segment of the barrier's lines, or an edge of its areas, with the area on its left and the
 * anchor on its right. Any u at which the straight path of the anchor, relative to the other part, does not meet the
 * interior of that part, or that segment, has n.u >= d for at least one of the node's ways: there is no clearance.
 *
 * With `chord`, such a side of barrier b and one of barrier c (which may be b) have one end in common, and the other
 * ends on either side of the straight path from the anchor through it. The second part is a segment, one end of which
 * is strictly in the shadow of either side, and which the path crosses beyond that common end; so what it shadows is in
 * the shadows of the two sides together.
 *
 * With `slack`, the clearance is negative, and the pair not the conflict itself. All its parts have one translation v,
 * no longer than minus the clearance, that makes their interiors disjoint: it is the same at all such nodes of the
 * pair, and their ways are about u = t_B + v - t_A, which has to make the interiors of the parts disjoint.
 *
 * A leaf has forces, positive, each on a way of a node above it: on the one that leads to the leaf (then h = d, m = n),
 * or on one before that (behind; then h = -d, m = -n). So m.u >= h in this case, for all of them. But the sum of force
 * * h is greater than the sum, over blocks, of limit * |sum of force * m, with a minus where the block is A|, and over
 * pairs with slack, of minus the clearance * |sum of force * m|: no such moves are within the limits.
 *
 * With `held`, the pair is not the conflict itself, and is held to its distance at the start, or minus the length of
 * its least translation then, exactly: `clearance` is only near to that. This lets a line pass through the original
 * place of the two: d = 0. With both `slack` and `held`, the first way says more than its d: n.u >= h, h the greatest
 * of n.(p - q) over corners p of the first part and q of the second.
 *
 * If a leaf is `still`, two ways that lead to it, line_way of line_node, are about one block and a fixed thing, with d
 * = 0, and n opposite to each other (or one is a first way that is held with a slack, and h is no less than |n| times
 * the pair's least translation at the start, so that n.u >= 0 without it). So the block's move satisfies n.t = 0. After
 * a move all corners of the block are doubles. No coordinate of them can leave its binade within the limit; so t is a
 * multiple of the unit there in each coordinate, and the least of these with n.t = 0 that is not 0 is beyond the limit.
 * So t = 0, and the limit of the block counts as 0 in that leaf. */
typedef struct sunder_proof_way {
    double n[2], d;
    size_t next;
} sunder_proof_way;

typedef struct sunder_proof_force {
    size_t node, way; /* number of all ways */
    bool behind;
    double force;
} sunder_proof_force;

typedef struct sunder_proof_node {
    size_t a, b;           /* features */
    size_t part_a, part_b; /* the first corners of the parts, of all corners */
    size_t corners_a, corners_b;
    double clearance;
    bool shadow;      /* one of the parts is an anchor: see above */
    bool slack;       /* the second part is moved by the pair's slack, too: see above */
    bool held;        /* the clearance is exactly what the pair stood apart at the start: see above */
    size_t way, ways; /* its first way, and how many; none: a leaf */
    size_t force, forces;
    bool still; /* a leaf: a block that is between the lines of two ways stays where it is: see above */
    size_t line_node[2], line_way[2];
    bool
        chord; /* a shadow: the second part is a chord across a corner that a side of b and one of c share: see above */
    size_t c, sides; /* then: of these two sides the first corner of four, two of b's and two of c's */
} sunder_proof_node;

typedef struct sunder_proof {
    const sunder_proof_node *node;
    const sunder_proof_way *way;
    const sunder_proof_force *force;
    const double *corner; /* [2 * corners] */
    size_t nodes, ways, forces, corners;
    double within; /* the limit assumed for features without one; 0: there are none */
} sunder_proof;

/* The proof of conflict k of sunder_report_conflicts(), or NULL. It lives as long as the report. There is one for each
 * conflict with SUNDER_REASON_NO_ROOM, and for each that is crowded; the features of its nodes, except the two in
 * conflict, are the conflict's blocked_by: the proof needs all of them. Conflicts with SUNDER_REASON_SIDE, and most
 * with SUNDER_REASON_JUMP, have one, too: its nodes are about the pair, and about the shadows of the members of their
 * two blocks. For features without a limit, `within` is a distance at which the two are certainly apart: farther out
 * nothing but shadows forbids a move, and what is shaded there was shaded before. With SUNDER_REASON_NO_ROOM all nodes
 * are about members of the two blocks then. With SUNDER_REASON_MAX_SHIFT, if keep_trees was asked for and one was
 * found, they are about the pair. */
SUNDER_EXPERIMENTAL const sunder_proof *sunder_report_proof(const sunder_report *report, size_t k);

#ifdef __cplusplus
}
#endif
#endif
