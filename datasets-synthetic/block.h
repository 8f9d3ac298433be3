/* One block of the town, built up. */
#ifndef TOWN_BLOCK_H
#define TOWN_BLOCK_H

#include "building.h"
#include "streets.h"

enum { TOWN_MAX_BUILDINGS = 128 };

typedef struct town_block {
    /* the site */
    int64_t column, row;
    town_random random;
    town_street streets[4]; /* counter-clockwise, with the block on their left */
    double trouble;         /* how often something is wrong, 0 .. 1 */

    /* what stands on it */
    town_building buildings[TOWN_MAX_BUILDINGS];
    town_point outline[TOWN_MAX_BUILDINGS][4]; /* of each building, its rectangle: nothing is built over it */
    size_t n;
    town_street lanes[2]; /* dead ends inside the block */
    size_t n_lanes;
} town_block;

/* Draws the block at a place of the town of this seed. */
void town_block_build(town_block *block, uint64_t seed, int64_t column, int64_t row, double trouble);

/* ---- For the quarters ---- */

/* Is the rectangle of the ground within the block, off its streets and lanes, and at least margin from what
 * was built? */
bool town_block_is_free(const town_block *block, const town_ground *ground, double s0, double b0, double width,
                        double depth, double margin);
/* A new building with that rectangle; NULL when the block is full. */
town_building *town_block_add(town_block *block, const town_ground *ground, double s0, double b0, double width,
                              double depth, const char *kind, double height);

/* The quarters of the town: how each kind of block is built up. */
void town_quarter_market(town_block *block);
void town_quarter_old(town_block *block);
void town_quarter_rows(town_block *block);
void town_quarter_villas(town_block *block);
void town_quarter_flats(town_block *block);
void town_quarter_works(town_block *block);
void town_quarter_park(town_block *block);

/* A row of houses that share walls, along side k from s0 to s1, fronts b0 from the middle of the street. */
void town_terrace(town_block *block, size_t k, double s0, double s1, double b0, const double width[2],
                  const double depth[2], bool wings, const char *kind);
/* Free-standing houses along a ground from s0 to s1. */
void town_houses(town_block *block, const town_ground *ground, double s0, double s1, double b0);
/* A row of garages, n of them. */
void town_garages(town_block *block, const town_ground *ground, double s0, double b0, size_t n);

#endif
