/* What is asked about two bodies before they count as neighbours in a row. */
#ifndef SUNDER_I_ROW_PAIRS_H
#define SUNDER_I_ROW_PAIRS_H

#include "displacement/rows/rows.h"

/* ---- row_walls.c ------------------------------------------------------------------------------------------------- */

/* The direction of walls: a vector at four times their angle, so that walls at right angles to each other have the same
 * one. Its length is at most that of the walls, and equal to it if all of them are parallel or at right angles. */
typedef struct sunder_i_walls {
    double direction[2], length;
} sunder_i_walls;

/* Adds the walls of a shape. */
void sunder_i_walls_add(const sunder_shape *shape, sunder_i_walls *walls);
/* Adds the walls of all features. walls: [features] Returns false if the work is to stop. */
bool sunder_i_rows_measure_walls(const sunder_i_model *model, sunder_i_walls *walls);
/* Sets `along` to a unit vector along the walls, at most 45 degrees from the x-axis; the others are at right angles to
 * it. `walls` must not have the length 0. */
void sunder_i_walls_axis(const sunder_i_walls *walls, double along[2]);
/* Sets *mean to the mean of two directions. Returns false if they differ by more than ROW_ANGLE, or if one of the two
 * has walls in all directions, such as a circle. */
bool sunder_i_walls_mean(const sunder_i_walls *a, const sunder_i_walls *b, sunder_i_walls *mean);

/* ---- row_pairs.c ------------------------------------------------------------------------------------------------- */

/* Two bodies within ROW_REACH gaps of each other. */
typedef struct sunder_i_row_pair {
    uint32_t i, j;         /* i < j */
    uint32_t f, g;         /* their members that are nearest to each other */
    double distance;       /* of f and g */
    double from[2], to[2]; /* a shortest link between f and g */
} sunder_i_row_pair;

typedef struct sunder_i_row_pairs {
    sunder_i_row_pair *pair; /* [n] sorted by (i, j) */
    size_t n;
} sunder_i_row_pairs;

/* Which pairs are looked for: those within reach or, if rows are given, those of them that are ends of two different
 * paths of one row (given_rows.c). */
typedef struct sunder_i_rows_wanted {
    double reach;
    int64_t *row;          /* [bodies] the row of each; -1: it is in none; NULL: no rows are given */
    uint32_t *path;        /* [bodies] the path that each is in */
    unsigned char *joined; /* [bodies] the number of its neighbours in the path */
} sunder_i_rows_wanted;

/* Finds these pairs of bodies. The caller frees pairs->pair, also after a failure. */
sunder_status sunder_i_row_pairs_find(const sunder_i_model *model, const sunder_i_rows_wanted *wanted,
                                      sunder_i_row_pairs *pairs, sunder_error *err);
/* Compares two pairs by distance, and those at one distance by their links, as qsort() does. */
int sunder_i_row_pair_compare(const sunder_i_row_pair *p, const sunder_i_row_pair *q);
/* Removes the pairs that are no neighbours in the relative neighbourhood graph: those with a third body that is nearer
 * to both than they are to each other. Returns false if memory is out or the work is to stop. */
bool sunder_i_row_pairs_thin_out(sunder_i_row_pairs *pairs, size_t bodies);

/* ---- side_by_side.c ---------------------------------------------------------------------------------------------- */

/* Returns whether the two stand side by side, as neighbours in a row do, and if so sets *edge, and link[] to the ends
 * of a segment from one to the other along the row. It depends on the two point sets alone, as their shortest link does
 * not if they have parallel walls. walls: [features] */
bool sunder_i_row_side_by_side(const sunder_i_model *model, const sunder_i_walls *walls, const sunder_i_row_pair *pair,
                               sunder_i_row_edge *edge, double link[2][2]);
/* Sets *edge and link[] likewise for two bodies that are in a row anyway. If their walls have no common direction, that
 * of their shortest link is taken. */
void sunder_i_row_join(const sunder_i_model *model, const sunder_i_walls *walls, const sunder_i_row_pair *pair,
                       sunder_i_row_edge *edge, double link[2][2]);

/* ---- row_links.c ------------------------------------------------------------------------------------------------- */

/* Sets *crossed to whether the link meets a line, or the boundary of an area, of a barrier. Returns false if memory is
 * out. */
bool sunder_i_row_link_is_crossed(const sunder_i_model *model, double link[2][2], sunder_i_list *near, bool *crossed);

#endif
