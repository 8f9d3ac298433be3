/* Levels of all kinds when memory runs out: two houses with a common wall and one alone, beside a road. */
#include "failing.h"
#include "sunder_hiding.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { HOUSES = 3, RUNGS = 3 };

/* Makes all levels, and frees them. */
static sunder_status make_levels(sunder_shape *const *house, sunder_shape **out)
{
    static const double road[] = {-50, -1, 80, -1.2}, lengths[] = {1, 2}, factors[] = {0.8, 0.6};
    static const size_t line_end[] = {2};
    const sunder_barrier barrier = {{.xy = road, .line_end = line_end, .lines = 1}, 0.5, 1, true, 0};
    sunder_feature feature[HOUSES];
    int64_t block[HOUSES];
    sunder_layer *layer = NULL;
    sunder_layer_options options;
    sunder_layer_options_init(&options);
    options.gap = 1;
    for (size_t k = 0; k < HOUSES; k++)
        feature[k] = (sunder_feature){.shape = house[k], .weight = 1, .max_shift = INFINITY, .block = -1};
    sunder_status status = sunder_layer_new(feature, HOUSES, &layer, NULL);
    if (!status) status = sunder_layer_set_barriers(layer, &barrier, 1, NULL);
    for (int kind = 0; kind < 4 && !status; kind++) {
        if (kind == 0)
            status = sunder_layer_trim(layer, &options, &(sunder_trimming){0.5, 2}, out, NULL);
        else if (kind == 1)
            status = sunder_layer_inset(layer, &options, &(sunder_inset){lengths, 2, 2}, NULL, out, NULL);
        else if (kind == 2)
            status = sunder_layer_enlarge(layer, &options, &(sunder_enlarging){12, NULL}, out, block, NULL);
        else
            status = sunder_layer_scale(layer, &options, &(sunder_scaling){factors, 2, 3, 2}, NULL, out, NULL);
        for (size_t k = 0; k < HOUSES * RUNGS; k++) {
            const bool made = k < HOUSES * (kind == 1 ? 2 : kind == 3 ? 3 : 1);
            if (kind < 3 && made) assert_int_equal(out[k] != NULL, !status);
            if (made) sunder_shape_free(out[k]);
            out[k] = NULL;
        }
    }
    sunder_layer_free(layer);
    return status;
}

static bool attempt(void *context)
{
    static const double at[HOUSES] = {0, 10, 30};
    const size_t ring_end = 4, poly_end = 1;
    sunder_shape *house[HOUSES] = {NULL}, *out[HOUSES * RUNGS] = {NULL};
    sunder_status status = SUNDER_OK;
    (void)context;
    for (size_t k = 0; k < HOUSES && !status; k++) {
        const double x = at[k], xy[8] = {x, 0, x + 10, 0, x + 10, 10, x, 10};
        status = sunder_shape_from_rings(xy, &ring_end, &poly_end, 1, SUNDER_VALIDITY_STRICT, &house[k], NULL);
    }
    if (!status) status = make_levels(house, out);
    assert_true(status == SUNDER_OK || status == SUNDER_ENOMEM);
    for (size_t k = 0; k < HOUSES; k++) sunder_shape_free(house[k]);
    return status == SUNDER_OK;
}

static void check_without_memory(void **state)
{
    (void)state;
    failing_begin();
    const bool sound = failing_loop(attempt, NULL, true);
    failing_end();
    assert_true(sound);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_without_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
