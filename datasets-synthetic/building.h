/* Buildings: rings of whole millimetres, drawn on a piece of ground.
 *
 * Walls that two houses share are shared exactly: corners are rounded to the millimetre first, and where a corner of
 * one house stands on the wall of its neighbour, the neighbour has a vertex there too. */
#ifndef TOWN_BUILDING_H
#define TOWN_BUILDING_H

#include <stddef.h>

#include "random.h"
#include "streets.h"

enum { TOWN_MAX_VERTICES = 48, TOWN_MAX_RINGS = 3 };

typedef struct town_building {
    int64_t xy[2 * TOWN_MAX_VERTICES]; /* millimetres from the market place */
    size_t ring_end[TOWN_MAX_RINGS]; /* index past the last vertex of each ring; outer ring first, counter-clockwise */
    size_t rings;
    const char *kind, *name; /* name: UTF-8, NULL for none */
    double height;           /* metres, in steps of 0.1 */
} town_building;

void town_building_begin(town_building *building, const char *kind, double height);
/* Appends the ground's point (s, b) to the last ring. */
void town_building_corner(town_building *building, const town_ground *ground, double s, double b);
/* Appends corners at the heights b of a wall along s that lie strictly between two others, from the first to the
 * second. */
void town_building_wall(town_building *building, const town_ground *ground, double s, double from, double to,
                        const double *heights, size_t n);
void town_building_next_ring(town_building *building);

typedef enum town_plan {
    TOWN_PLAN_RECTANGLE,
    TOWN_PLAN_L,
    TOWN_PLAN_T,
    TOWN_PLAN_U,
    TOWN_PLAN_BAY,
    TOWN_PLAN_COURTYARD,
    TOWN_PLAN_CROSS
} town_plan;

/* A free-standing house of a plan, width along s from s0 and depth along b from b0. heights: extra corners on the wall
 * at s0 + width, where something is built against it (of rectangles only). */
void town_building_draw(town_building *building, const town_ground *ground, town_plan plan, double s0, double b0,
                        double width, double depth, bool mirrored, const double *heights, size_t n);

#endif
