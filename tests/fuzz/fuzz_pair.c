/* The least separation of two hostile shapes does separate them, and is zero exactly if they are separate already. */
#include <math.h>
#include <string.h>

#include "bytes.h"

static void demand_separation(const sunder_shape *p, const sunder_shape *q, double gap, const sunder_separation *answer)
{
    bool apart = false, exact = false;
    sunder_shape *moved = NULL;
    if (sunder_pair_apart(p, q, gap, &apart, NULL) == SUNDER_OK) FUZZ_DEMAND(answer->overlap == !apart);
    FUZZ_DEMAND(answer->overlap || strcmp(answer->distance_squared_text, "0") == 0);
    FUZZ_DEMAND(answer->lower_bound <= answer->distance * (1 + 0x1p-50));
    if (sunder_shape_translate(q, answer->dx, answer->dy, &moved, &exact, NULL) == SUNDER_OK && exact) {
        if (sunder_pair_apart(p, moved, gap, &apart, NULL) == SUNDER_OK) FUZZ_DEMAND(apart == answer->rounded_is_free);
    }
    sunder_shape_free(moved);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes bytes = {data, size};
    unsigned fail = fuzz_byte(&bytes);
    fuzz_scale scale = fuzz_choose_scale(&bytes);
    fuzz_fail_allocations(0);
    fuzz_patience(FUZZ_LOOKS);
    sunder_shape *p = fuzz_shape(&bytes, scale, 20), *q = fuzz_shape(&bytes, scale, 16);
    double gap = fuzz_byte(&bytes) & 1 ? fuzz_coordinate(&bytes, scale == FUZZ_MAP ? FUZZ_GRID : scale) : 0;
    if (p && q) {
        sunder_separation answer;
        memset(&answer, 0, sizeof answer);
        fuzz_fail_allocations(fail < 128 ? fail * 4 : 0);
        sunder_status status = sunder_pair_separate(p, q, gap, &answer, NULL);
        fuzz_fail_allocations(0);
        FUZZ_DEMAND(status != SUNDER_ECANCEL || fuzz_is_out_of_patience());
        FUZZ_DEMAND(status == SUNDER_ECANCEL || (status == SUNDER_EARG) == !(gap >= 0 && isfinite(gap)));
        if (status == SUNDER_OK) {
            demand_separation(p, q, gap, &answer);
            sunder_separation_clear(&answer);
        }
    }
    sunder_shape_free(q);
    sunder_shape_free(p);
    return 0;
}
