/* anchor.c: the anchor of a shape, a point of its interior that depends on the point set only. The interior is that of
 * the union of all polygons, so that common walls of polygons are inside it. The rule:
 *
 *   take the open intervals of the interior on the horizontal line at half its height; the anchor is the midpoint of
 *   the widest one, the leftmost of equal ones, rounded to the nearest doubles;
 *   if there are none on that line (the interior is in several parts), apply the rule to the part of it below the line.
 *
 * sunder_shape_anchor() cannot fail, so it allocates nothing: for few vertices all numbers are on the stack, and the
 * range of doubles bounds their size; for many vertices, and for vertices that are not doubles, the anchor is computed
 * when the shape is made (measure_rational.c). */
#include "shape/shape.h"
#include "shape/widest_interval.h"

#include <string.h>

static void find_anchor(const sunder_shape *shape, int8_t *side, sunder_i_level_crossing *crossing,
                        sunder_i_arena *arena, double xy[2])
{
    const sunder_i_boundary b = {
        .n = shape->vertices, .next = shape->form->cleaned.next, .xy = shape->xy, .unit = shape->low_bit};
    sunder_i_widest_interval widest;
    sunder_i_widest_interval_find(&b, side, crossing, arena, &widest);
    sunder_i_widest_interval_doubles(&b, &widest, arena, xy);
}

bool sunder_i_shape_measure_anchor(sunder_shape *shape)
{
    sunder_i_arena arena;
    if (shape->vertices <= SUNDER_I_ANCHOR_CORNERS) return true;
    sunder_i_arena_init(&arena);
    int8_t *side = sunder_i_arena_alloc(&arena, shape->vertices, sizeof *side);
    sunder_i_level_crossing *crossing = sunder_i_arena_alloc(&arena, 2 * (size_t)shape->vertices, sizeof *crossing);
    if (!arena.failed) find_anchor(shape, side, crossing, &arena, shape->form->numbers->anchor);
    const bool good = !arena.failed;
    sunder_i_arena_free(&arena);
    return good;
}

void sunder_shape_anchor(const sunder_shape *shape, double xy[2])
{
    xy[0] = xy[1] = 0;
    if (shape->pieces == 0) return;
    if (shape->form->numbers) {
        memcpy(xy, shape->form->numbers->anchor, sizeof shape->form->numbers->anchor);
        return;
    }
    _Alignas(16) mp_limb_t memory[SUNDER_I_INTERVAL_LIMBS];
    int8_t side[SUNDER_I_ANCHOR_CORNERS];
    sunder_i_level_crossing crossing[2 * SUNDER_I_ANCHOR_CORNERS];
    sunder_i_arena arena;
    sunder_i_arena_init_on(&arena, memory, sizeof memory);
    find_anchor(shape, side, crossing, &arena, xy);
    sunder_i_arena_free(&arena);
}
