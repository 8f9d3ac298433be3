/* The four operations on hostile shapes: an opening has no more area than the set, a closing no less; the random order
 * of computation and the number of threads change nothing. */
#include <stdlib.h>

#include "bytes.h"
#include "equal.h"

#include <gmp.h>

/* The exact area; false if memory is out. */
static bool area_of(const sunder_sum *sum, mpq_t area)
{
    char *text = NULL;
    if (sunder_sum_area_text(sum, &text, NULL) != SUNDER_OK) return false;
    FUZZ_DEMAND(mpq_set_str(area, text, 10) == 0);
    sunder_free(text);
    return true;
}

static void demand_less(const sunder_sum *less, const sunder_sum *more)
{
    mpq_t a, b;
    mpq_init(a);
    mpq_init(b);
    if (area_of(less, a) && area_of(more, b)) FUZZ_DEMAND(mpq_cmp(a, b) <= 0);
    mpq_clear(a);
    mpq_clear(b);
}

static bool is_done(sunder_status status)
{
    return status == SUNDER_OK || (status == SUNDER_ECANCEL && fuzz_is_out_of_patience());
}

/* The set contains its opening, and its closing contains the set. */
static void demand_between(const sunder_shape *p, const sunder_sum *result, sunder_operation op)
{
    const sunder_sum_options options = {.size = sizeof options};
    sunder_sum *whole = NULL;
    FUZZ_DEMAND(is_done(sunder_shape_union(p, &options, &whole, NULL)));
    if (whole && op == SUNDER_OPERATION_OPEN) demand_less(result, whole);
    if (whole && op == SUNDER_OPERATION_CLOSE) demand_less(whole, result);
    sunder_sum_free(whole);
}

/* One operation; for opening and closing also dilate and erode. Every fourth is repeated with two threads. */
static void ask(const sunder_shape *p, const sunder_shape *b, unsigned fail, unsigned seed)
{
    const sunder_operation op = (sunder_operation)(seed % 4);
    const sunder_sum_options options = {.size = sizeof options, .seed = seed},
                             other = {.size = sizeof other, .seed = seed + 1, .threads = seed / 4 % 4 == 3 ? 2 : 1};
    sunder_sum *result = NULL, *again = NULL;
    sunder_error error;
    fuzz_fail_allocations(fail < 128 ? fail * 8 : 0);
    const sunder_status status = sunder_morphology(p, b, op, &options, &result, &error);
    fuzz_fail_allocations(0);
    FUZZ_DEMAND((result != NULL) == (status == SUNDER_OK));
    FUZZ_DEMAND(is_done(status) || (status == SUNDER_ENOMEM && fail > 0 && fail < 128));
    FUZZ_DEMAND(is_done(sunder_morphology(p, b, op, &other, &again, &error)));
    if (result && again) fuzz_demand_equal(result, again);
    if (result && (op == SUNDER_OPERATION_OPEN || op == SUNDER_OPERATION_CLOSE)) demand_between(p, result, op);
    sunder_sum_free(again);
    sunder_sum_free(result);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes bytes = {data, size};
    const unsigned fail = fuzz_byte(&bytes), seed = fuzz_byte(&bytes);
    const fuzz_scale scale = fuzz_choose_scale(&bytes);
    fuzz_fail_allocations(0);
    fuzz_patience(FUZZ_LOOKS);
    sunder_shape *p = fuzz_shape(&bytes, scale, 14), *b = fuzz_shape(&bytes, scale, 8);
    if (p && b && !sunder_shape_is_empty(b)) ask(p, b, fail, seed);
    sunder_shape_free(b);
    sunder_shape_free(p);
    return 0;
}
