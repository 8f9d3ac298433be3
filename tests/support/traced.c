/* traced.c: see traced.h. */
#include "traced.h"

#include "sum/canonical_sum.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Makes an empty sum with its origins, to which the placed operands are added. */
static sunder_sum *blank_sum(const sunder_shape *a, const sunder_shape *b, sunder_i_placed *placed)
{
    sunder_sum *sum = NULL, *blank = calloc(1, sizeof *blank);
    assert_non_null(blank);
    assert_int_equal(sunder_minkowski_sum(a, b, NULL, &sum, NULL), SUNDER_OK);
    blank->lattice = placed->lattice;
    memset(&placed->lattice, 0, sizeof placed->lattice);
    memcpy(blank->origin, sum->origin, sizeof blank->origin);
    sunder_sum_free(sum);
    return blank;
}

char *traced_text(tracing *trace, const polyset *p, const polyset *q, size_t *holes)
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    sunder_i_placed placed;
    const sunder_i_place_options how = {0};
    bool done = false;
    char *text = NULL;
    assert_non_null(a);
    assert_non_null(b);
    assert_int_equal(sunder_i_place(a, b, &how, &placed, NULL), SUNDER_OK);
    sunder_sum *traced = blank_sum(a, b, &placed);
    assert_int_equal(trace(traced, a, placed.p, b, placed.q, &done, NULL), SUNDER_OK);
    if (done) {
        text = sum_text(traced);
        if (holes) *holes += traced->rings - traced->polygons;
    } else {
        assert_null(traced->vertex);
        assert_int_equal(traced->polygons, 0);
    }
    sunder_i_placed_free(&placed);
    sunder_sum_free(traced);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return text;
}
