/* sunder_i_patience: the number of failed attempts that are made, and the number of attempts skipped before another one
 * is made. */
#include "base/patience.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Returns how many of n attempts are made if all fail. */
static size_t asked_in_vain(sunder_i_patience *p, size_t n)
{
    size_t asked = 0;
    for (size_t k = 0; k < n; k++) {
        if (!sunder_i_patience_asks(p)) continue;
        sunder_i_patience_note(p, false);
        asked++;
    }
    return asked;
}

static void ever_fewer(void **state)
{
    (void)state;
    sunder_i_patience p = sunder_i_patience_of(4, 2);
    assert_int_equal(asked_in_vain(&p, 4), 4);
    /* Further attempts are then made at growing distances: the next one, the second after it, the fourth after that,
     * and so on. */
    assert_int_equal(asked_in_vain(&p, 1), 1);
    assert_int_equal(asked_in_vain(&p, 2), 1);
    assert_int_equal(asked_in_vain(&p, 4), 1);
    assert_int_equal(asked_in_vain(&p, 1000), 6);
}

static void an_answer_makes_good(void **state)
{
    (void)state;
    sunder_i_patience p = sunder_i_patience_of(4, 2);
    asked_in_vain(&p, 100);
    sunder_i_patience_note(&p, true);
    assert_int_equal(asked_in_vain(&p, 2), 2);
    /* A long series of successes does not raise the number of failed attempts above the first value. */
    for (int k = 0; k < 10; k++) sunder_i_patience_note(&p, true);
    assert_int_equal(asked_in_vain(&p, 5), 5);
    assert_false(sunder_i_patience_asks(&p));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ever_fewer), cmocka_unit_test(an_answer_makes_good)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
