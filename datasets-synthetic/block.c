#include "block.h"

#include <math.h>

enum { PURPOSE_BLOCK = 8 };

/* Separating axes of two convex quadrangles: is there a side of a with all of b at least margin beyond it? */
static bool is_beyond(const town_point a[4], const town_point b[4], double margin)
{
    for (size_t i = 0; i < 4; ++i) {
        town_point p = a[i], q = a[(i + 1) % 4];
        double dx = q.x - p.x, dy = q.y - p.y, length = sqrt(dx * dx + dy * dy), least = INFINITY;
        for (size_t j = 0; j < 4; ++j) least = fmin(least, ((b[j].x - p.x) * dy - (b[j].y - p.y) * dx) / length);
        if (least >= margin) return true;
    }
    return false;
}

static void rectangle(const town_ground *ground, double s0, double b0, double width, double depth, town_point out[4])
{
    out[0] = town_ground_at(ground, s0, b0);
    out[1] = town_ground_at(ground, s0 + width, b0);
    out[2] = town_ground_at(ground, s0 + width, b0 + depth);
    out[3] = town_ground_at(ground, s0, b0 + depth);
}

/* How far a point lies to the left of a street, past its ends too. */
static double left_of(const town_ground *ground, town_point p)
{
    double x = p.x - ground->start.x, y = p.y - ground->start.y;
    double t = (x * ground->along.x + y * ground->along.y) / ground->length;
    double rise = t > 0 && t < 1 ? ground->bow * 4 * t * (1 - t) : 0;
    return x * ground->left.x + y * ground->left.y - rise;
}

bool town_block_is_free(const town_block *block, const town_ground *ground, double s0, double b0, double width,
                        double depth, double margin)
{
    town_point corners[4], lane[4];
    rectangle(ground, s0, b0, width, depth, corners);
    for (size_t k = 0; k < 4; ++k) {
        for (size_t i = 0; i < 4; ++i)
            if (left_of(&block->streets[k].ground, corners[i]) < block->streets[k].half_width + 1) return false;
    }
    for (size_t i = 0; i < block->n_lanes; ++i) {
        const town_street *street = &block->lanes[i];
        rectangle(&street->ground, 0, -street->half_width, street->ground.length + 3, 2 * street->half_width, lane);
        if (!is_beyond(corners, lane, 1) && !is_beyond(lane, corners, 1)) return false;
    }
    for (size_t i = 0; i < block->n; ++i)
        if (!is_beyond(corners, block->outline[i], margin) && !is_beyond(block->outline[i], corners, margin))
            return false;
    return true;
}

town_building *town_block_add(town_block *block, const town_ground *ground, double s0, double b0, double width,
                              double depth, const char *kind, double height)
{
    if (block->n == TOWN_MAX_BUILDINGS) return NULL;
    rectangle(ground, s0, b0, width, depth, block->outline[block->n]);
    town_building *building = &block->buildings[block->n++];
    town_building_begin(building, kind, height);
    return building;
}

typedef void (*quarter)(town_block *);

/* From the market place outward: old town, rows, then villas with flats, works and parks among them. */
static quarter choose_quarter(town_block *block, uint64_t seed)
{
    double size = 1, distance = town_centre_distance(seed, block->column, block->row, &size);
    double ragged = distance + town_random_between(&block->random, -0.25, 0.25) / size;
    double lot = town_random_between(&block->random, 0, 1);
    if (block->column == 0 && block->row == 0) return town_quarter_market;
    if (ragged < 1.2) return lot < 0.08 ? town_quarter_market : town_quarter_old;
    if (ragged < 2.1) return lot < 0.55 ? town_quarter_rows : lot < 0.65 ? town_quarter_park : town_quarter_villas;
    if (ragged > 9) return lot < 0.5 ? town_quarter_park : town_quarter_villas;
    return lot < 0.12   ? town_quarter_flats
           : lot < 0.22 ? town_quarter_works
           : lot < 0.32 ? town_quarter_park
           : lot < 0.45 ? town_quarter_rows
                        : town_quarter_villas;
}

void town_block_build(town_block *block, uint64_t seed, int64_t column, int64_t row, double trouble)
{
    block->column = column;
    block->row = row;
    block->random = town_random_at(seed, column, row, PURPOSE_BLOCK);
    block->trouble = trouble;
    block->n = block->n_lanes = 0;
    town_block_streets(seed, column, row, block->streets);
    choose_quarter(block, seed)(block);
}
