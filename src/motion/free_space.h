/* free_space.h: the free space of a robot among obstacles.
 *
 * O = union of O_i + int(-R') over the obstacles O_i, R' the robot, grown by a polygon around a disc if there is a gap.
 * With convex pieces of all three, O is a union of open convex polygons, the *parts*: all questions about collisions
 * are decided by these alone. The outline of O is computed by the stages of outline/, which also compute the outline of
 * a sum; shortest paths can bend at its vertices and degenerate holes. */
#ifndef SUNDER_I_FREE_SPACE_H
#define SUNDER_I_FREE_SPACE_H

#include "convex/pieces.h"
#include "motion/filtered_point.h"
#include "outline/coverage.h"
#include "spatial/box_tree.h"

/* The number of parts in a leaf of their tree. With more the tree is smaller, but more parts are tested; a test of a
 * part takes longer than one of a node (visibility.c), so that this number is smaller than LEAF_NODES there. */
#define SUNDER_I_LEAF_PARTS 4

/* A tree of the boxes of parts, each widened by the filter's error, in the order of a space-filling curve. */
typedef struct sunder_i_part_tree {
    uint32_t *part; /* [parts] the numbers of the parts in the order of the tree */
    sunder_i_box_tree boxes;
} sunder_i_part_tree;

typedef struct sunder_i_free_space {
    sunder_sum *sum; /* the outline of O; it owns the lattice */
    sunder_i_filter filter;
    sunder_i_convex_pieces part;
    sunder_i_directions directions;    /* the directions of the sides of parts */
    double (*corner)[2];               /* [part.corners] approximate doubles of the corners of parts, within
                                        * filter.error */
    uint32_t robot_pieces;             /* the parts [i * robot_pieces, (i + 1) * robot_pieces) belong to obstacle piece
                                        * i */
    uint32_t *piece_obstacle;          /* [pieces] the number of the obstacle of each obstacle piece */
    sunder_i_outline_stretch *stretch; /* the sides of O and of its degenerate segments, cut at the ends of all
                                        * others */
    size_t stretches;
    sunder_i_part_tree tree;
} sunder_i_free_space;

sunder_status sunder_i_free_space_build(const sunder_obstacle *obstacles, size_t n, const sunder_shape *robot,
                                        double gap, const sunder_sum_options *options, sunder_i_free_space *out,
                                        sunder_error *err);
void sunder_i_free_space_free(sunder_i_free_space *space);

/* ---- leg.c ---- */

/* Builds space->tree from the parts. Returns false if out of memory. */
bool sunder_i_part_tree_build(sunder_i_free_space *space);
/* Returns true if the closed segment pq (p == q: the point) meets no open part; the test is exact. If part is not NULL,
 * *part becomes a part that the segment meets, the one with the least number if `least` is set; UINT32_MAX: none. */
bool sunder_i_leg_is_free(const sunder_i_free_space *space, const sunder_i_filtered_point *p,
                          const sunder_i_filtered_point *q, bool least, uint32_t *part);

/* ---- verify_leg.c ---- */

/* Returns true if the closed segment pq meets no open part, as sunder_i_leg_is_free() does, but by another method, for
 * proofs: the segment p + t (q - p) is clipped by the sides of every part, one after the other, in rational numbers.
 * Returns false also if out of memory. */
bool sunder_i_leg_verified(const sunder_i_free_space *space, const sunder_i_filtered_point *p,
                           const sunder_i_filtered_point *q);

#endif
