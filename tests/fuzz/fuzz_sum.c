/* Sums of two hostile shapes: P + Q by any algorithm and Q + P by the default one are the same set, so their canonical
 * forms are equal. */
#include "bytes.h"
#include "equal.h"

/* Zero, the value of all bytes past the end of the input, selects the default algorithm. */
static sunder_sum_options choose_road(fuzz_bytes *bytes)
{
    unsigned road = fuzz_byte(bytes), order = fuzz_byte(bytes);
    return (sunder_sum_options){.size = sizeof(sunder_sum_options),
                                .algorithm = (sunder_algorithm)(road % 5),
                                .decomposition = (sunder_decomposition)(road / 5 % 7),
                                .order = (sunder_order)(order % 3),
                                .seed = order,
                                .keep_map = road % 5 != SUNDER_ALGORITHM_CONVOLUTION && order / 3 % 2};
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
    sunder_sum *sum = NULL, *turned = NULL;
    if (p && q) {
        sunder_error error;
        sunder_sum_options road = choose_road(&bytes);
        fuzz_fail_allocations(fail < 128 ? fail * 4 : 0);
        sunder_status status = sunder_minkowski_sum(p, q, &road, &sum, &error);
        FUZZ_DEMAND((sum != NULL) == (status == SUNDER_OK));
        FUZZ_DEMAND(status == SUNDER_OK || status == SUNDER_ENOMEM ||
                    (status == SUNDER_ECANCEL && fuzz_is_out_of_patience()));
        fuzz_fail_allocations(0);
        if (sum) {
            status = sunder_minkowski_sum(q, p, NULL, &turned, &error);
            FUZZ_DEMAND(status == SUNDER_OK || (status == SUNDER_ECANCEL && fuzz_is_out_of_patience()));
            if (turned) fuzz_demand_equal(sum, turned);
        }
    }
    sunder_sum_free(turned);
    sunder_sum_free(sum);
    sunder_shape_free(q);
    sunder_shape_free(p);
    return 0;
}
