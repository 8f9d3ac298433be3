/* The quarters of the town, from the market place to the works. */
#include <math.h>

#include "block.h"
#include "names.h"

/* A house on a ground, drawn after a plan, if there is room for it. */
static town_building *place(town_block *block, const town_ground *ground, town_plan plan, double s0, double b0,
                            double width, double depth, double margin, const char *kind, double height)
{
    if (!town_block_is_free(block, ground, s0, b0, width, depth, margin)) return NULL;
    town_building *building = town_block_add(block, ground, s0, b0, width, depth, kind, height);
    if (building) town_building_draw(building, ground, plan, s0, b0, width, depth, false, NULL, 0);
    return building;
}

/* Does the same without a test for room: for a building in another building's yard, or within its walls. */
static void place_inside(town_block *block, const town_ground *ground, double s0, double b0, double width, double depth,
                         const char *kind, double height)
{
    town_building *building = town_block_add(block, ground, s0, b0, width, depth, kind, height);
    if (building) town_building_draw(building, ground, TOWN_PLAN_RECTANGLE, s0, b0, width, depth, false, NULL, 0);
}

static const town_street *before(const town_block *block, size_t side) { return &block->streets[(side + 3) % 4]; }

static const town_street *after(const town_block *block, size_t side) { return &block->streets[(side + 1) % 4]; }

/* A house around a yard; in the yard, now and then, a house for which it is too small: with a few metres' gap there is
 * no place for it inside. */
static town_building *place_yard(town_block *block, const town_ground *ground, double s0, double b0, double width,
                                 double depth, double margin, const char *kind)
{
    town_random *random = &block->random;
    town_building *around = place(block, ground, TOWN_PLAN_COURTYARD, s0, b0, width, depth, margin, kind,
                                  town_random_between(random, 9, 14));
    double wing = fmin(width, depth) * 0.28;
    if (around && town_random_chance(random, 0.6)) {
        double room = town_random_between(random, 1.1, 1.9);
        place_inside(block, ground, s0 + wing + room, b0 + wing + room, width - 2 * wing - 2 * room,
                     depth - 2 * wing - 2 * room, "yard_house", town_random_between(random, 3, 6));
    }
    return around;
}

/* Two monuments that no editor may move, and a stall between them with less room than one would like. */
static void place_monuments(town_block *block, const town_ground *ground, double s0, double b0)
{
    double room = town_random_between(&block->random, 1.2, 1.8), stall = 4;
    if (town_block_is_free(block, ground, s0, b0, 6 + 2 * room + stall, 3, 3)) {
        place_inside(block, ground, s0, b0, 3, 3, "monument", 5);
        place_inside(block, ground, s0 + 3 + room, b0, stall, 3, "stall", 2.5);
        place_inside(block, ground, s0 + 3 + 2 * room + stall, b0, 3, 3, "monument", 5);
    }
}

static void name_shops(town_block *block, size_t from, double share)
{
    for (size_t i = from; i < block->n; ++i) {
        if (town_random_chance(&block->random, share)) {
            block->buildings[i].kind = "shop";
            block->buildings[i].name = town_shop_name(&block->random);
        }
    }
}

/* Terraces along a side. At the corner where the side starts they reach the street; at its end they leave the depth of
 * the next side's row, and a way in. */
static void old_row(town_block *block, size_t side, double b0)
{
    static const double width[2] = {7, 12}, depth[2] = {9.5, 12.5};
    double s0 = before(block, side)->half_width + 1.75,
           s1 = block->streets[side].ground.length - after(block, side)->half_width;
    size_t from = block->n;
    town_terrace(block, side, s0, s1 - 1.75 - 12.5 - 4, block->streets[side].half_width + b0, width, depth, true,
                 "house");
    name_shops(block, from, 0.22);
}

void town_quarter_market(town_block *block)
{
    const town_ground *ground = &block->streets[0].ground;
    town_random *random = &block->random;
    double middle = ground->length / 2, height = block->streets[0].half_width;
    town_ground church = town_ground_within(ground, middle + 8, height + 14, town_random_between(random, -0.12, 0.12));
    town_building *built = place(block, &church, TOWN_PLAN_CROSS, -10, 0, 20, 38, 2, "church", 24);
    if (built) {
        built->name = town_church_name(random);
        place_inside(block, &church, -3, 0, 6, 6, "tower", 46);
    }
    built = place_yard(block, ground, height + 9, height + 14, 27, 23, 4, "town_hall");
    if (built) built->name = block->column == 0 && block->row == 0 ? "Rathaus" : "Bezirksamt";
    place_monuments(block, ground, middle + 24, height + 9);
    old_row(block, 1, 1.75);
    old_row(block, 2, 1.75);
    old_row(block, 3, 1.75);
}

void town_quarter_old(town_block *block)
{
    town_random *random = &block->random;
    for (size_t side = 0; side < 4; ++side) old_row(block, side, 1.75);
    const town_ground *ground = &block->streets[0].ground;
    if (town_random_chance(random, 0.4)) {
        double depth = town_random_between(random, 18, 22), width = town_random_between(random, 20, 26);
        place_yard(block, ground, ground->length / 2 - town_random_between(random, 8, 16), 34, width, depth, 3.2,
                   "convent");
    }
    for (int i = 0; i < 14; ++i) { /* workshops in the yards; one in a while is squeezed against a house */
        double width = town_random_between(random, 4, 10), depth = town_random_between(random, 4, 8);
        bool wrong = town_random_chance(random, 1.5 * block->trouble);
        double height = town_random_between(random, 3, 6), back = town_random_between(random, 20, 64);
        double along = town_random_between(random, 20, ground->length - 20);
        place(block, ground, town_random_chance(random, 0.3) ? TOWN_PLAN_L : TOWN_PLAN_RECTANGLE, along, back, width,
              depth, wrong ? -0.9 : 3.2, "workshop", height);
    }
}

void town_quarter_rows(town_block *block)
{
    static const double width[2] = {5.75, 7.25}, depth[2] = {9, 11};
    town_random *random = &block->random;
    for (size_t side = 0; side < 4; side += 2) {
        double s = before(block, side)->half_width + 5,
               end = block->streets[side].ground.length - after(block, side)->half_width - 5;
        double b0 = block->streets[side].half_width + town_random_between(random, 3, 5);
        while (s + 18 < end) {
            double length = fmin(town_random_between(random, 24, 46), end - s);
            town_terrace(block, side, s, s + length, b0, width, depth, false, "house");
            s += length + town_random_between(random, 5, 9);
        }
    }
    const town_ground *ground = &block->streets[0].ground;
    unsigned garages = 4 + town_random_below(random, 6);
    double back = town_random_between(random, 34, 40);
    town_garages(block, ground, ground->length / 2 - town_random_between(random, 6, 20), back, garages);
    for (size_t side = 1; side < 4; side += 2) {
        const town_street *street = &block->streets[side];
        town_houses(block, &street->ground, 24, street->ground.length - 20, street->half_width + 4);
    }
    for (int i = 0; i < 10; ++i) {
        bool wrong = town_random_chance(random, block->trouble);
        double away = town_random_between(random, 24, 56);
        place(block, ground, TOWN_PLAN_RECTANGLE, town_random_between(random, 12, ground->length - 12), away, 3, 2.5,
              wrong ? -1 : 3.2, "shed", 2.4);
    }
}

/* A dead end from the middle of the south side, with houses on both hands. */
static void add_lane(town_block *block)
{
    const town_street *street = &block->streets[0];
    town_street lane = {.kind = TOWN_LANE, .half_width = 2.25, .name = town_street_name(&block->random)};
    double turn = town_random_between(&block->random, -0.1, 0.1);
    double middle = street->ground.length * town_random_between(&block->random, 0.42, 0.58);
    town_ground across = town_ground_within(&street->ground, middle, 0, turn);
    lane.ground = (town_ground){
        across.start, across.left, {-across.along.x, -across.along.y}, town_random_between(&block->random, 48, 58), 0};
    block->lanes[block->n_lanes++] = lane;
}

void town_quarter_villas(town_block *block)
{
    town_random *random = &block->random;
    if (town_random_chance(random, 0.4)) add_lane(block);
    for (size_t side = 0; side < 4; ++side) {
        const town_street *street = &block->streets[side];
        town_houses(block, &street->ground, before(block, side)->half_width + 5, street->ground.length - 6,
                    street->half_width + town_random_between(random, 3.5, 6));
    }
    for (size_t i = 0; i < block->n_lanes; ++i) {
        town_ground back = block->lanes[i].ground; /* the lane seen from its end: the other hand */
        back.start = town_ground_at(&block->lanes[i].ground, back.length, 0);
        back.along = (town_point){-back.along.x, -back.along.y};
        back.left = (town_point){-back.left.x, -back.left.y};
        town_houses(block, &block->lanes[i].ground, 18, back.length + 4, block->lanes[i].half_width + 3);
        town_houses(block, &back, -4, back.length - 18, block->lanes[i].half_width + 3);
    }
}

void town_quarter_flats(town_block *block)
{
    town_random *random = &block->random;
    const town_ground *ground = &block->streets[0].ground;
    town_ground turned = town_ground_within(ground, 0, 0, town_random_between(random, -0.2, 0.2));
    double length = town_random_between(random, 32, 44);
    for (double s = 12; s < ground->length - 20; s += town_random_between(random, 24, 30)) {
        double height = town_random_between(random, 14, 32), back = town_random_between(random, 12, 26);
        town_building *built =
            place(block, &turned, town_random_chance(random, 0.2) ? TOWN_PLAN_L : TOWN_PLAN_RECTANGLE, s, back, 12,
                  length, 5, "flats", height);
        if (built &&
            town_random_chance(random, 0.5)) { /* a stair tower, drawn a little into the wall or a little off it */
            place(block, &turned, TOWN_PLAN_RECTANGLE, s + 12.5, 30, 2.5, 4,
                  town_random_chance(random, 0.5) ? 0.25 : -0.5, "stairs", 20);
        }
    }
    town_garages(block, ground, 14, 62, 6 + town_random_below(random, 5));
}

void town_quarter_works(town_block *block)
{
    town_random *random = &block->random;
    const town_ground *ground = &block->streets[0].ground;
    double high = town_random_between(random, 8, 12), deep = town_random_between(random, 30, 44);
    town_building *hall =
        place(block, ground, TOWN_PLAN_L, 14, 14, town_random_between(random, 34, 46), deep, 3, "works", high);
    if (hall) hall->name = town_random_chance(random, 0.5) ? "Sägewerk Öhler & Söhne" : "Usine Générale";
    place_yard(block, ground, 66, 16, 26, 24, 4, "brewery");
    for (int i = 0; i < 9; ++i) {
        bool wrong = town_random_chance(random, 2 * block->trouble);
        double height = town_random_between(random, 4, 8), depth = town_random_between(random, 6, 14);
        double width = town_random_between(random, 7, 16), back = town_random_between(random, 12, 66);
        double along = town_random_between(random, 12, 80);
        place(block, ground, town_random_chance(random, 0.3) ? TOWN_PLAN_U : TOWN_PLAN_RECTANGLE, along, back, width,
              depth, wrong ? -1.2 : 3.5, "works", height);
    }
}

void town_quarter_park(town_block *block)
{
    town_random *random = &block->random;
    const town_ground *ground = &block->streets[0].ground;
    if (town_random_chance(random, 0.45)) {
        double depth = town_random_between(random, 30, 38);
        town_building *school =
            place(block, ground, TOWN_PLAN_U, 22, 20, town_random_between(random, 46, 58), depth, 4, "school", 11);
        if (school) school->name = town_school_name(random);
    }
    double back = town_random_between(random, 62, 70);
    place_monuments(block, ground, town_random_between(random, 30, 60), back);
    for (int i = 0; i < 3; ++i) {
        double away = town_random_between(random, 14, 66);
        place(block, ground, TOWN_PLAN_RECTANGLE, town_random_between(random, 16, 86), away, 5, 4, 3.2, "pavilion",
              3.5);
    }
}
