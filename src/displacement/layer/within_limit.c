/* Is a move no longer than its limit: |t|^2 <= limit^2? It is decided in doubles if their rounding cannot matter, and
 * else in big integers. All code that gives a body a move calls this function or sunder_i_round_move(), which calls it;
 * so no move exceeds its limit. */
#include "displacement/layer/model.h"

#include "number/big.h"

#include <math.h>

bool sunder_i_is_within_limit(const double t[2], double limit)
{
    /* a limit is never negative; this path needs no memory */
    if (limit == INFINITY || (t[0] == 0 && t[1] == 0)) return true;
    /* In doubles t^2 and limit^2 have relative errors of at most 2^-52, and their sum of 2^-51, without overflow and
     * underflow. */
    const double a = t[0] * t[0] + t[1] * t[1], b = limit * limit;
    if (a > 0x1p-900 && a < 0x1p900 && b > 0x1p-900 && b < 0x1p900) {
        if (a < b * (1 - 0x1p-48)) return true;
        if (a > b * (1 + 0x1p-48)) return false;
    }
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    int e[3], least = INT32_MAX;
    sunder_i_big m[3];
    const double value[3] = {t[0], t[1], limit};
    for (int k = 0; k < 3; k++) {
        m[k] = sunder_i_big_double(&arena, value[k], &e[k]);
        if (sunder_i_big_sign(m[k]) && e[k] < least) least = e[k];
    }
    for (int k = 0; k < 3; k++) {
        if (sunder_i_big_sign(m[k])) m[k] = sunder_i_big_shl(&arena, m[k], (unsigned long)(e[k] - least));
        m[k] = sunder_i_big_mul(&arena, m[k], m[k]);
    }
    const bool within = sunder_i_big_cmp(sunder_i_big_add(&arena, m[0], m[1]), m[2]) <= 0;
    const bool failed = arena.failed;
    sunder_i_arena_free(&arena);
    return within && !failed; /* if memory is out the move is refused */
}
