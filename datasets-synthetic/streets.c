#include "streets.h"

#include <math.h>

#include "names.h"
#include "random.h"

enum { PURPOSE_CROSSING = 1, PURPOSE_BOW, PURPOSE_DRIFT, PURPOSE_NAME, PURPOSE_CENTRE };

/* A block of the lattice, in metres: about what the blocks of a small town in Central Europe measure. */
static const double BLOCK_WIDTH = 112, BLOCK_HEIGHT = 88;
/* Blocks between two centres: a walk of a quarter of an hour. */
static const int64_t CENTRE_SPACING = 14;

town_point town_ground_at(const town_ground *ground, double s, double b)
{
    double t = s / ground->length;
    double rise = ground->bow * 4 * t * (1 - t), slope = ground->bow * 4 * (1 - 2 * t) / ground->length;
    double stretch = sqrt(1 + slope * slope);
    double along = s - slope / stretch * b, across = rise + b / stretch;
    return (town_point){ground->start.x + ground->along.x * along + ground->left.x * across,
                        ground->start.y + ground->along.y * along + ground->left.y * across};
}

town_ground town_ground_within(const town_ground *ground, double s, double b, double slope)
{
    town_point start = town_ground_at(ground, s, b), on = town_ground_at(ground, s, b + 1);
    town_point left = {on.x - start.x, on.y - start.y};
    town_point turned = {left.x + slope * left.y, left.y - slope * left.x};
    double length = sqrt(turned.x * turned.x + turned.y * turned.y);
    left = (town_point){turned.x / length, turned.y / length};
    return (town_ground){start, {left.y, -left.x}, left, 1, 0};
}

const char *town_street_kind_string(town_street_kind kind)
{
    static const char *const names[] = {"main_street", "street", "lane"};
    return names[kind];
}

/* Ring r of the spiral holds (2r+1)^2 - (2r-1)^2 blocks: it starts south of its east corner and runs north, west,
 * south, east. */
void town_block_place(uint64_t number, int64_t *column, int64_t *row)
{
    int64_t r = 0;
    while ((uint64_t)(2 * r + 1) * (uint64_t)(2 * r + 1) <= number) ++r;
    if (r == 0) {
        *column = *row = 0;
        return;
    }
    int64_t k = (int64_t)number - (2 * r - 1) * (2 * r - 1), side = k / (2 * r), at = k % (2 * r);
    *column = side == 0 ? r : side == 1 ? r - 1 - at : side == 2 ? -r : at - r + 1;
    *row = side == 0 ? at - r + 1 : side == 1 ? r : side == 2 ? r - 1 - at : -r;
}

uint64_t town_block_number(int64_t column, int64_t row)
{
    int64_t a = column < 0 ? -column : column, b = row < 0 ? -row : row, r = a > b ? a : b;
    if (r == 0) return 0;
    int64_t first = (2 * r - 1) * (2 * r - 1);
    int64_t k = column == r && row > -r ? row + r - 1
                : row == r              ? 2 * r + (r - 1 - column)
                : column == -r          ? 4 * r + (r - 1 - row)
                                        : 6 * r + (column + r - 1);
    return (uint64_t)(first + k);
}

/* Smooth noise in [-1, 1]: random values on every fourth crossing, blended between. */
static double drift(uint64_t seed, int64_t column, int64_t row, uint64_t axis)
{
    enum { STEP = 4 };
    int64_t c = column >= 0 ? column / STEP : -((STEP - 1 - column) / STEP);
    int64_t d = row >= 0 ? row / STEP : -((STEP - 1 - row) / STEP);
    double x = (double)(column - c * STEP) / STEP, y = (double)(row - d * STEP) / STEP, value = 0;
    x = x * x * (3 - 2 * x);
    y = y * y * (3 - 2 * y);
    for (int i = 0; i < 4; ++i) {
        town_random random = town_random_at(seed, c + (i & 1), d + (i >> 1), PURPOSE_DRIFT + 16 * axis);
        value += ((i & 1) ? x : 1 - x) * ((i >> 1) ? y : 1 - y) * town_random_between(&random, -1, 1);
    }
    return value;
}

/* Returns the crossing south-west of a block. */
static town_point crossing(uint64_t seed, int64_t column, int64_t row)
{
    town_random random = town_random_at(seed, column, row, PURPOSE_CROSSING);
    double x = ((double)column - 0.5) * BLOCK_WIDTH + 45 * drift(seed, column, row, 0);
    double y = ((double)row - 0.5) * BLOCK_HEIGHT + 38 * drift(seed, column, row, 1);
    x += town_random_between(&random, -11, 11);
    y += town_random_between(&random, -9, 9);
    return (town_point){x, y};
}

/* Every seventh line of the lattice is a main street; the two that meet at the market place are among them. */
static bool is_main(int64_t line) { return line % 7 == 0; }

/* The street north or east of a crossing (upward: east of it is on the right hand). */
static town_street street(uint64_t seed, int64_t column, int64_t row, bool upward)
{
    town_point from = crossing(seed, column, row);
    town_point to = crossing(seed, upward ? column : column + 1, upward ? row + 1 : row);
    double dx = to.x - from.x, dy = to.y - from.y, length = sqrt(dx * dx + dy * dy);
    town_random random = town_random_at(seed, column, row, PURPOSE_BOW + 16 * (uint64_t)upward);
    int64_t line = upward ? column : row;
    town_street s;
    s.ground = (town_ground){from, {dx / length, dy / length}, {-dy / length, dx / length}, length, 0};
    s.ground.bow = town_random_between(&random, -5, 5);
    s.kind = is_main(line) ? TOWN_MAIN_STREET : TOWN_STREET;
    s.half_width = is_main(line) ? 4.5 : 3.25;
    town_random name = town_random_at(seed, line, upward, PURPOSE_NAME);
    s.name = is_main(line) && line == 0 ? (upward ? "Brückenstraße" : "Hauptstraße") : town_street_name(&name);
    return s;
}

static town_street reversed(town_street s)
{
    town_ground *g = &s.ground;
    g->start = (town_point){g->start.x + g->along.x * g->length, g->start.y + g->along.y * g->length};
    g->along = (town_point){-g->along.x, -g->along.y};
    g->left = (town_point){-g->left.x, -g->left.y};
    g->bow = -g->bow;
    return s;
}

void town_block_streets(uint64_t seed, int64_t column, int64_t row, town_street streets[4])
{
    streets[0] = street(seed, column, row, false);
    streets[1] = street(seed, column + 1, row, true);
    streets[2] = reversed(street(seed, column, row + 1, false));
    streets[3] = reversed(street(seed, column, row, true));
}

double town_centre_distance(uint64_t seed, int64_t column, int64_t row, double *size)
{
    int64_t half = CENTRE_SPACING / 2;
    int64_t c = column + half >= 0 ? (column + half) / CENTRE_SPACING
                                   : -((CENTRE_SPACING - 1 - column - half) / CENTRE_SPACING);
    int64_t d = row + half >= 0 ? (row + half) / CENTRE_SPACING : -((CENTRE_SPACING - 1 - row - half) / CENTRE_SPACING);
    double best = INFINITY;
    for (int64_t i = c - 1; i <= c + 1; ++i) {
        for (int64_t j = d - 1; j <= d + 1; ++j) {
            town_random random = town_random_at(seed, i, j, PURPOSE_CENTRE);
            bool first = i == 0 && j == 0;
            double x = (double)(i * CENTRE_SPACING) + (first ? 0 : town_random_between(&random, -4, 4));
            double y = (double)(j * CENTRE_SPACING) + (first ? 0 : town_random_between(&random, -4, 4));
            double reach = first ? 1 : town_random_between(&random, 0.6, 2);
            double dx = (double)column - x, dy = (double)row - y, distance = sqrt(dx * dx + dy * dy);
            if (distance / reach < best) {
                best = distance / reach;
                *size = reach;
            }
        }
    }
    return best;
}
