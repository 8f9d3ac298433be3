/* subsum_order.c: the order in which subsums are inserted.
 *
 * The expected times of the vertical decomposition assume a random order. The order by fatness, the largest first, is
 * for unions that remove covered parts: a large subsum inserted early covers small ones before they cross each other,
 * so that the time depends on the result and not on the whole arrangement. The paper does not define "fat". Three
 * measures are reasonable:
 *
 *     area       the expected part that the subsum covers, if later ones are distributed evenly
 *     breadth    area divided by perimeter, which for a convex set is from a half to one times the radius of its
 *                largest disc: a long thin subsum covers little whatever its area
 *     round      area divided by the square of the perimeter, the fatness of the literature on fat objects, which does
 *                not depend on size
 *
 * README.md has the counts of each. The measure is computed in doubles: it determines the order only, and every order
 * gives the same union. */
#include "base/random.h"
#include "base/sort.h"
#include "unions/unions.h"

#include <math.h>

/* *xy becomes the corner's approximate offset from the first corner. */
static void corner_offset(sunder_i_uniting *u, const sunder_i_convex_sum *s, uint32_t k, double xy[2])
{
    const long shift = -(long)u->lattice->approx_shift;
    double first[2];
    sunder_i_rational_doubles(&u->arena, s->at[0], shift, &first[0], &first[1]);
    sunder_i_rational_doubles(&u->arena, s->at[k], shift, &xy[0], &xy[1]);
    for (int i = 0; i < 2; i++) xy[i] -= first[i];
}

static double fatness_of(sunder_i_uniting *u, uint32_t subsum)
{
    const sunder_i_mark mark = sunder_i_arena_mark(&u->arena);
    sunder_i_convex_sum s;
    double area = 0, perimeter = 0, from[2] = {0, 0};
    if (!sunder_i_make_subsum(u, subsum, &s)) return 0;
    for (uint32_t k = 1; k <= s.corners && !u->arena.failed; k++) {
        double to[2];
        corner_offset(u, &s, k < s.corners ? k : 0, to);
        area += from[0] * to[1] - from[1] * to[0];
        perimeter += hypot(to[0] - from[0], to[1] - from[1]);
        from[0] = to[0];
        from[1] = to[1];
    }
    if (u->arena.failed) return 0;
    sunder_i_arena_release(&u->arena, mark);
    switch (u->fatness) {
    case SUNDER_I_FAT_BREADTH: return area / perimeter;
    case SUNDER_I_FAT_ROUND: return area / perimeter / perimeter;
    case SUNDER_I_FAT_AREA: break;
    }
    return area;
}

/* Equal items, common among translates of pieces, remain in random order: the sort is stable. */
static bool sort_by_fatness(sunder_i_uniting *u, uint32_t *subsum, uint32_t n)
{
    const uint32_t first = n ? subsum[0] : 0;
    double *key = sunder_i_alloc(n, sizeof *key);
    if (!key) return false;
    for (uint32_t i = 0; i < n; i++) {
        key[i] = fatness_of(u, first + i);
        subsum[i] = i;
    }
    sunder_i_shuffle(subsum, n, sizeof *subsum, &u->random);
    const bool ok = sunder_i_sort_indices(subsum, n, sunder_i_descending, key);
    for (uint32_t i = 0; i < n; i++) subsum[i] += first;
    sunder_i_free(key);
    return ok && !u->arena.failed && !u->lattice->arena.failed;
}

bool sunder_i_order_subsums(sunder_i_uniting *u, uint32_t *subsum, uint32_t n)
{
    switch (u->options->order) {
    case SUNDER_ORDER_RANDOM: sunder_i_shuffle(subsum, n, sizeof *subsum, &u->random); break;
    case SUNDER_ORDER_FAT: return sort_by_fatness(u, subsum, n);
    case SUNDER_ORDER_GIVEN: break;
    }
    return true;
}
