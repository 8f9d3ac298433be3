/* least_length.c: tests whether two lengths suffice to separate a pair, by the squared length of the least translation,
 * which is rational, as the lengths are. Rounded numbers would leave cases open that differ by one bit. */
#include "separation/separation.h"

#include "number/ratio.h"
#include "separation/least_translation.h"

#include <math.h>

sunder_status sunder_i_parts_within(const sunder_shape *p, const sunder_shape *q, const double length[2], bool *within,
                                    sunder_error *err)
{
    const sunder_i_least_options o = {.upper = INFINITY, .texts = true};
    sunder_separation least;
    const sunder_status status = sunder_i_least(p, q, &o, &least, NULL, err);
    if (status) return status;
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    sunder_i_ratio square;
    const bool read = sunder_i_ratio_parse(&arena, least.distance_squared_text, &square);
    const sunder_i_ratio sum =
        sunder_i_ratio_add(&arena, sunder_i_ratio_double(&arena, length[0]), sunder_i_ratio_double(&arena, length[1]));
    const sunder_i_ratio most = {sunder_i_big_mul(&arena, sum.num, sum.num),
                                 sunder_i_big_mul(&arena, sum.den, sum.den)};
    *within = read && sunder_i_ratio_cmp(&arena, square, most) <= 0;
    const bool failed = arena.failed || !read;
    sunder_i_arena_free(&arena);
    sunder_separation_clear(&least);
    return failed ? sunder_i_failure_cause(err) : SUNDER_OK;
}
