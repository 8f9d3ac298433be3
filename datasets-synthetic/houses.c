/* What quarters are made of: terraces, free-standing houses with their sheds, rows of garages. Here too the trouble is
 * made that a map shows after generalisation and careless editing: houses pushed into their neighbours, sheds drawn
 * over a wall, sheds too near. */
#include <math.h>

#include "block.h"

enum { TERRACE_MAX = 24 };

/* Lengths along walls come in steps of 0.25 m, so that corners on a shared wall coincide or lie well apart. */
static double quarter_metres(double length) { return floor(length * 4 + 0.5) / 4; }

typedef struct terrace_house {
    bool stands;
    double front, depth;          /* b of the front and the back */
    double wing_left, wing_right; /* b of the end of a wing behind that side; equals depth if there is none */
    double wing_width;
} terrace_house;

static void draw_terrace_house(town_building *building, const town_ground *ground, const terrace_house *house,
                               double left, double right, const double left_heights[2], const double right_heights[2])
{
    town_building_corner(building, ground, left, house->front);
    town_building_corner(building, ground, right, house->front);
    town_building_wall(building, ground, right, house->front, house->wing_right, right_heights, 2);
    town_building_corner(building, ground, right, house->wing_right);
    if (house->wing_right > house->depth) {
        town_building_corner(building, ground, right - house->wing_width, house->wing_right);
        town_building_corner(building, ground, right - house->wing_width, house->depth);
    }
    if (house->wing_left > house->depth) {
        town_building_corner(building, ground, left + house->wing_width, house->depth);
        town_building_corner(building, ground, left + house->wing_width, house->wing_left);
    }
    town_building_corner(building, ground, left, house->wing_left);
    town_building_wall(building, ground, left, house->wing_left, house->front, left_heights, 2);
}

static terrace_house plan_terrace_house(town_random *random, double b0, const double depth[2], double width, bool wings)
{
    terrace_house house = {.stands = true, .front = b0};
    if (town_random_chance(random, 0.2)) house.front = quarter_metres(b0 + town_random_between(random, 0.3, 1.2));
    house.depth = quarter_metres(b0 + town_random_between(random, depth[0], depth[1]));
    house.wing_left = house.wing_right = house.depth;
    house.wing_width = quarter_metres(width * 0.36);
    if (wings && town_random_chance(random, 0.45)) {
        double end = quarter_metres(house.depth + town_random_between(random, 3, 7));
        unsigned kind = town_random_below(random, 5); /* both sides: a U around a yard */
        house.wing_left = kind < 2 || kind == 4 ? end : house.depth;
        house.wing_right = kind >= 2 ? end : house.depth;
    }
    return house;
}

void town_terrace(town_block *block, size_t k, double s0, double s1, double b0, const double width[2],
                  const double depth[2], bool wings, const char *kind)
{
    const town_ground *ground = &block->streets[k].ground;
    town_random *random = &block->random;
    double walls[TERRACE_MAX + 1] = {0}, total = 0;
    terrace_house houses[TERRACE_MAX];
    double count = floor((s1 - s0) / ((width[0] + width[1]) / 2) + 0.5);
    size_t n = count < 1 ? 0 : count > TERRACE_MAX ? TERRACE_MAX : (size_t)count, before = block->n;
    if (n == 0 || (s1 - s0) / (double)n < 0.7 * width[0]) return;
    for (size_t i = 0; i < n; ++i) total += walls[i + 1] = town_random_between(random, width[0], width[1]);
    walls[0] = s0;
    for (size_t i = 0; i < n; ++i) walls[i + 1] = walls[i] + walls[i + 1] * (s1 - s0) / total;
    for (size_t i = 0; i < n; ++i) {
        double right = walls[i + 1] - walls[i];
        houses[i] = plan_terrace_house(random, quarter_metres(b0), depth, right, wings);
        double back = fmax(houses[i].wing_left, houses[i].wing_right) - houses[i].front;
        size_t now = block->n; /* the row itself is not in the way */
        block->n = before;
        houses[i].stands = town_block_is_free(block, ground, walls[i], houses[i].front, right, back, 1.5);
        block->n = now;
    }
    for (size_t i = 0; i < n; ++i) {
        const terrace_house *house = &houses[i], *to_left = i > 0 && houses[i - 1].stands ? &houses[i - 1] : house;
        const terrace_house *to_right = i + 1 < n && houses[i + 1].stands ? &houses[i + 1] : house;
        double back = fmax(house->wing_left, house->wing_right) - house->front;
        town_building *building = !house->stands
                                      ? NULL
                                      : town_block_add(block, ground, walls[i], house->front, walls[i + 1] - walls[i],
                                                       back, kind, town_random_between(random, 7, 14));
        if (building) {
            draw_terrace_house(building, ground, house, walls[i], walls[i + 1],
                               (const double[]){to_left->front, to_left->wing_right},
                               (const double[]){to_right->front, to_right->wing_left});
        }
    }
}

/* A garage or shed against the right wall of a house, 2.75 to 3.5 m wide; the house has its corners on the wall. */
static void add_annex(town_block *block, const town_ground *ground, double s, double b0, double width, double b1)
{
    town_building *annex =
        town_block_add(block, ground, s, b0, width, b1 - b0, "garage", town_random_between(&block->random, 2.4, 3.2));
    if (annex) town_building_draw(annex, ground, TOWN_PLAN_RECTANGLE, s, b0, width, b1 - b0, false, NULL, 0);
}

static void add_shed(town_block *block, const town_ground *ground, double s, double b, double width, double depth,
                     double margin)
{
    if (!town_block_is_free(block, ground, s, b, width, depth, margin)) return;
    town_building *shed =
        town_block_add(block, ground, s, b, width, depth, "shed", town_random_between(&block->random, 2.2, 3.2));
    if (shed) town_building_draw(shed, ground, TOWN_PLAN_RECTANGLE, s, b, width, depth, false, NULL, 0);
}

static town_plan choose_house_plan(town_random *random)
{
    unsigned lot = town_random_below(random, 20);
    return lot < 9    ? TOWN_PLAN_RECTANGLE
           : lot < 14 ? TOWN_PLAN_L
           : lot < 16 ? TOWN_PLAN_T
           : lot < 18 ? TOWN_PLAN_BAY
                      : TOWN_PLAN_U;
}

/* Adds one house with its additions, with its left wall at s. squeeze: the distance to its neighbours; negative if it
 * overlaps them. Returns the width that it takes, 0 if there is no room. */
static double add_house(town_block *block, const town_ground *street, double s, double b0, double squeeze)
{
    town_random *random = &block->random;
    double width = quarter_metres(town_random_between(random, 8.5, 13)),
           depth = quarter_metres(town_random_between(random, 8.5, 12.5));
    double slope = town_random_chance(random, 0.3) ? town_random_between(random, -0.06, 0.06) : 0;
    town_ground ground = town_ground_within(street, s + width / 2, b0 + town_random_between(random, 0, 2.5), slope);
    town_plan plan = choose_house_plan(random);
    double s0 = -width / 2, heights[2] = {0, 0};
    if (!town_block_is_free(block, &ground, s0, 0, width, depth, squeeze)) return 0;
    bool annex = plan == TOWN_PLAN_RECTANGLE && town_random_chance(random, 0.45);
    double annex_width = quarter_metres(town_random_between(random, 2.75, 3.5));
    if (annex) {
        heights[0] = quarter_metres(town_random_between(random, 0.5, 2.5));
        heights[1] = heights[0] + 5.5;
        annex = town_block_is_free(block, &ground, width / 2, heights[0], annex_width, 5.5, fmin(squeeze, 1));
    }
    town_building *house =
        town_block_add(block, &ground, s0, 0, width, depth, "house", town_random_between(random, 5, 10));
    if (!house) return 0;
    town_building_draw(house, &ground, plan, s0, 0, width, depth, town_random_chance(random, 0.5), heights,
                       annex ? 2 : 0);
    if (annex) {
        add_annex(block, &ground, width / 2, heights[0], annex_width, heights[1]);
        width += annex_width;
    }
    if (town_random_chance(random,
                           0.5)) { /* a shed behind the house, too near it now and then, or drawn over its wall */
        bool wrong = town_random_chance(random, block->trouble);
        double away = wrong ? town_random_between(random, -1, 1) : town_random_between(random, 3.5, 9);
        double shed_width = quarter_metres(town_random_between(random, 2.5, 4.5));
        double shed_depth = quarter_metres(town_random_between(random, 2, 3.5));
        add_shed(block, &ground, town_random_between(random, s0, -s0 - shed_width), depth + away, shed_width,
                 shed_depth, wrong ? -2 : 3.5);
    }
    return width;
}

void town_houses(town_block *block, const town_ground *ground, double s0, double s1, double b0)
{
    town_random *random = &block->random;
    double s = s0;
    while (s + 8 < s1) {
        bool wrong = s > s0 && town_random_chance(random, block->trouble);
        double from = wrong ? s - town_random_between(random, 4.5, 7) : s;
        double width = add_house(block, ground, from, b0, wrong ? -1.5 : 3.2);
        s = width > 0 ? from + width + town_random_between(random, 4, 8) : s + 2;
    }
}

void town_garages(town_block *block, const town_ground *ground, double s0, double b0, size_t n)
{
    static const double width = 3, depth = 6;
    if (!town_block_is_free(block, ground, s0, b0, width * (double)n, depth, 3.2)) return;
    double height = town_random_between(&block->random, 2.3, 2.8);
    for (size_t i = 0; i < n; ++i) {
        double s = s0 + width * (double)i;
        town_building *garage = town_block_add(block, ground, s, b0, width, depth, "garage", height);
        if (garage) town_building_draw(garage, ground, TOWN_PLAN_RECTANGLE, s, b0, width, depth, false, NULL, 0);
    }
}
