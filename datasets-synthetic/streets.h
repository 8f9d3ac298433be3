/* The street plan: a lattice of crossings, pulled about, joined by bent streets.
 *
 * Blocks are numbered along a square spiral from the market place, so a town of any size is a beginning of the same
 * endless list and has no need to be held in memory. Lengths are metres from the market place; nothing but + - * / and
 * sqrt is done to doubles, so every machine draws the same town. */
#ifndef TOWN_STREETS_H
#define TOWN_STREETS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct town_point {
    double x, y;
} town_point;

/* One side of a block, or any other ground to build on: s runs along it, b is the distance to its left. A street with
 * bow bends like a flat arch, which is bow high in the middle, to its left. */
typedef struct town_ground {
    town_point start, along, left; /* unit vectors */
    double length, bow;
} town_ground;

/* The point at s along the ground and b to its left, measured across the bend. */
town_point town_ground_at(const town_ground *ground, double s, double b);
/* A straight ground that starts at (s, b) of another and is turned against it by the slope of a small angle. */
town_ground town_ground_within(const town_ground *ground, double s, double b, double slope);

typedef enum town_street_kind { TOWN_MAIN_STREET, TOWN_STREET, TOWN_LANE } town_street_kind;

typedef struct town_street {
    town_ground ground;
    town_street_kind kind;
    double half_width;
    const char *name; /* UTF-8 */
} town_street;

const char *town_street_kind_string(town_street_kind kind);

/* Column and row of the block with this number, and the number of the block there. */
void town_block_place(uint64_t number, int64_t *column, int64_t *row);
uint64_t town_block_number(int64_t column, int64_t row);

/* The four streets around a block, counter-clockwise (south, east, north, west), each with the block on its left. */
void town_block_streets(uint64_t seed, int64_t column, int64_t row, town_street streets[4]);

/* Distance, in blocks, from the nearest of the town's centres, and how large that centre is: 1 for the first. */
double town_centre_distance(uint64_t seed, int64_t column, int64_t row, double *size);

#endif
