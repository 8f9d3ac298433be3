/* Families whose cost depends on the order of insertion. */
#include "family.h"

static size_t at_least_one(size_t n) { return n ? n : 1; }

/* thin upright bars + thin lying bars: each sum of two is a stout rectangle, and they stand in a grid in which some
 * overlap their neighbours and some do not. Output of order m n; every order of insertion meets much the same map. */
void family_fat_grid(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    enum { PITCH = 2000 };
    const size_t columns = at_least_one(m / 4), rows = at_least_one(n / 4);
    for (size_t i = 0; i < columns; i++) {
        const int64_t x = (int64_t)i * PITCH + family_integer(&streams->p, -120, 120);
        const int64_t top = family_integer(&streams->p, 600, 1500), right = x + family_integer(&streams->p, 40, 120);
        family_rectangle(p, x, -family_integer(&streams->p, 600, 1500), right, top);
    }
    for (size_t i = 0; i < rows; i++) {
        const int64_t y = (int64_t)i * PITCH + family_integer(&streams->q, -120, 120);
        const int64_t top = y + family_integer(&streams->q, 40, 120), right = family_integer(&streams->q, 300, 900);
        family_rectangle(q, -family_integer(&streams->q, 300, 900), y, right, top);
    }
}

/* blocks and long bars + a ladder of plates: the sum of a block and a plate is stout, and overlaps its neighbours in
 * the row a little. The sum of a bar and a plate is long, thin by any measure of shape, and covers a row of blocks.
 * All rows together leave no gap, so the sum has order m + n vertices.
 *
 * Stoutest first arranges the m n / 32 blocks, each with its neighbours, before the first bar buries them. A random
 * order has a bar in each row after two insertions there, on average, and finds the rest covered. */
void family_fat_cover(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    enum { PITCH = 2000, BLOCK = 2600, PLATE = 1200, BAR = PITCH - PLATE + 100, EDGE = 300 };
    const size_t blocks = at_least_one(m / 8), bars = at_least_one(m / 4 - blocks), rows = at_least_one(n / 4);
    const int64_t length = (int64_t)(blocks + 1) * PITCH;
    for (size_t i = 0; i < blocks; i++) {
        const int64_t x = (int64_t)(i + 1) * PITCH - BLOCK / 2 + family_integer(&streams->p, -200, 200);
        const int64_t y = family_integer(&streams->p, 0, 400);
        family_rectangle(p, x, y, x + BLOCK, y + family_integer(&streams->p, 50, 400));
    }
    for (size_t i = 0; i < bars; i++) {
        const int64_t top = BAR + family_integer(&streams->p, 1, EDGE);
        const int64_t right = length + family_integer(&streams->p, 1, EDGE);
        const int64_t bottom = -family_integer(&streams->p, 1, EDGE);
        family_rectangle(p, -family_integer(&streams->p, 1, EDGE), bottom, right, top);
    }
    for (size_t i = 0; i < rows; i++) {
        const int64_t y = (int64_t)i * PITCH;
        const int64_t right = family_integer(&streams->q, 20, 50);
        family_rectangle(q, family_integer(&streams->q, -50, -20), y, right, y + PLATE);
    }
}
