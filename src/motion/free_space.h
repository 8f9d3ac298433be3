/* Obstacles and a robot made into free space.
 *
 * O = union of O_i + int(-R') over the obstacles O_i, R' the robot, grown by a polygon around a disc if there is a gap.
 * With convex pieces of all three, O is a union of open convex polygons, the *parts*: that alone is what every question
 * about collisions is asked of. The outline of O is found by the stages of outline/ that find a sum's; its corners
 * and degenerate holes are where shortest paths can bend. */
#ifndef SUNDER_I_FREE_SPACE_H
#define SUNDER_I_FREE_SPACE_H

#include "convex/pieces.h"
#include "motion/filtered_point.h"
#include "outline/coverage.h"
#include "spatial/box_tree.h"

/* Parts in a leaf of their tree. More make it smaller and have more parts asked; to ask a part takes longer than to
 * look at a node (visibility.c), so they are fewer. */
#define SUNDER_I_LEAF_PARTS 4

/* Boxes of parts, widened by the filter's error, along a space-filling curve. */
typedef struct sunder_i_part_tree {
    uint32_t *part; /* [parts] in tree order */
    sunder_i_box_tree boxes;
} sunder_i_part_tree;

typedef struct sunder_i_free_space {
    sunder_sum *sum; /* the outline of O; owns the lattice */
    sunder_i_filter filter;
    sunder_i_convex_pieces part;
    sunder_i_directions directions;    /* of the sides of parts */
    double (*corner)[2];               /* [part.corners] close to the corners of parts, as the filter says */
    uint32_t robot_pieces;             /* parts [i * robot_pieces, (i + 1) * robot_pieces) are of obstacle piece i */
    uint32_t *piece_obstacle;          /* [pieces] whose it is */
    sunder_i_outline_stretch *stretch; /* sides of O and of its degenerate segments, cut where anything ends */
    size_t stretches;
    sunder_i_part_tree tree;
} sunder_i_free_space;

sunder_status sunder_i_free_space_build(const sunder_obstacle *obstacles, size_t n, const sunder_shape *robot,
                                        double gap, const sunder_sum_options *options, sunder_i_free_space *out,
                                        sunder_error *err);
void sunder_i_free_space_free(sunder_i_free_space *space);

/* ---- leg.c ---- */

/* False if memory is out. */
bool sunder_i_part_tree_build(sunder_i_free_space *space);
/* Does the closed segment pq (p == q: the point) meet no open part? Exact. *part, if not NULL: one that it meets, the
 * least in number if `least` is asked for. */
bool sunder_i_leg_is_free(const sunder_i_free_space *space, const sunder_i_filtered_point *p,
                          const sunder_i_filtered_point *q, bool least, uint32_t *part);

/* ---- verify_leg.c ---- */

/* The same question answered along another road, for proofs: the segment as p + t (q - p) is clipped by the sides of
 * every part, one after the other, in rational numbers. */
bool sunder_i_leg_verified(const sunder_i_free_space *space, const sunder_i_filtered_point *p,
                           const sunder_i_filtered_point *q);

#endif
