#include "building.h"

#include <math.h>

static int64_t millimetres(double metres) { return (int64_t)floor(metres * 1000 + 0.5); }

void town_building_begin(town_building *building, const char *kind, double height)
{
    *building = (town_building){.rings = 1, .kind = kind, .height = floor(height * 10 + 0.5) / 10};
}

void town_building_corner(town_building *building, const town_ground *ground, double s, double b)
{
    size_t *end = &building->ring_end[building->rings - 1];
    if (*end < TOWN_MAX_VERTICES) {
        town_point p = town_ground_at(ground, s, b);
        building->xy[2 * *end] = millimetres(p.x);
        building->xy[2 * *end + 1] = millimetres(p.y);
        ++*end;
    }
}

void town_building_wall(town_building *building, const town_ground *ground, double s, double from, double to,
                        const double *heights, size_t n)
{
    double at = from;
    for (size_t step = 0; step < n; ++step) { /* selection sort: n is 2 */
        double next = to;
        for (size_t i = 0; i < n; ++i)
            if (to > from ? heights[i] > at && heights[i] < next : heights[i] < at && heights[i] > next)
                next = heights[i];
        if (next == to) return;
        town_building_corner(building, ground, s, next);
        at = next;
    }
}

void town_building_next_ring(town_building *building)
{
    building->ring_end[building->rings] = building->ring_end[building->rings - 1];
    ++building->rings;
}

/* Corners given as fractions of width and depth, counter-clockwise. */
static void draw_corners(town_building *building, const town_ground *ground, const double (*corners)[2], size_t n,
                         double s0, double b0, double width, double depth, bool mirrored)
{
    for (size_t i = 0; i < n; ++i) {
        size_t k = mirrored ? n - 1 - i : i;
        double across = mirrored ? 1 - corners[k][0] : corners[k][0];
        town_building_corner(building, ground, s0 + across * width, b0 + corners[k][1] * depth);
    }
}

#define DRAW(corners)                                                                                                  \
    draw_corners(building, ground, corners, sizeof(corners) / sizeof((corners)[0]), s0, b0, width, depth, mirrored)

static void draw_courtyard(town_building *building, const town_ground *ground, double s0, double b0, double width,
                           double depth)
{
    static const double around[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    double wing = fmin(width, depth) * 0.28;
    draw_corners(building, ground, around, 4, s0, b0, width, depth, false);
    town_building_next_ring(building);
    draw_corners(building, ground, around, 4, s0 + wing, b0 + wing, width - 2 * wing, depth - 2 * wing, true);
}

void town_building_draw(town_building *building, const town_ground *ground, town_plan plan, double s0, double b0,
                        double width, double depth, bool mirrored, const double *heights, size_t n)
{
    static const double l[][2] = {{0, 0}, {1, 0}, {1, 1}, {0.55, 1}, {0.55, 0.6}, {0, 0.6}};
    static const double t[][2] = {{0, 0.4}, {0.3, 0.4}, {0.3, 0}, {0.72, 0}, {0.72, 0.4}, {1, 0.4}, {1, 1}, {0, 1}};
    static const double u[][2] = {{0, 0}, {1, 0}, {1, 1}, {0.7, 1}, {0.7, 0.45}, {0.3, 0.45}, {0.3, 1}, {0, 1}};
    static const double bay[][2] = {{0, 0.14},   {0.3, 0.14}, {0.38, 0}, {0.62, 0},
                                    {0.7, 0.14}, {1, 0.14},   {1, 1},    {0, 1}};
    /* Nave along b, transept, an apse of five corners at the far end. */
    static const double cross[][2] = {{0.3, 0},    {0.7, 0},   {0.7, 0.55}, {1, 0.55},  {1, 0.75},
                                      {0.7, 0.75}, {0.7, 0.9}, {0.6, 1},    {0.4, 1},   {0.3, 0.9},
                                      {0.3, 0.75}, {0, 0.75},  {0, 0.55},   {0.3, 0.55}};
    switch (plan) {
    case TOWN_PLAN_L: DRAW(l); break;
    case TOWN_PLAN_T: DRAW(t); break;
    case TOWN_PLAN_U: DRAW(u); break;
    case TOWN_PLAN_BAY: DRAW(bay); break;
    case TOWN_PLAN_CROSS: DRAW(cross); break;
    case TOWN_PLAN_COURTYARD: draw_courtyard(building, ground, s0, b0, width, depth); break;
    case TOWN_PLAN_RECTANGLE:
        town_building_corner(building, ground, s0, b0);
        town_building_corner(building, ground, s0 + width, b0);
        town_building_wall(building, ground, s0 + width, b0, b0 + depth, heights, n);
        town_building_corner(building, ground, s0 + width, b0 + depth);
        town_building_corner(building, ground, s0, b0 + depth);
        break;
    }
}
