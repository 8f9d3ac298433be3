/* displacement/prove/optimum: the convex program of a node, with cuts that nearly depend on each other. */
#include "random.h"

#include "displacement/prove/optimum/dual_program.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { WORLDS = 2000, BODIES = 3, CUTS = 24 };

/* Cuts of bodies with the ground and with each other, many of them copies of others that are turned by a hair. */
static void make_cuts(rng *r, sunder_i_move_cut *cut)
{
    for (uint32_t k = 0; k < CUTS; k++) {
        const uint32_t j = (uint32_t)rng_int(r, 0, BODIES - 1), i = (uint32_t)rng_int(r, 0, BODIES);
        const double angle = (double)rng_int(r, 0, 6283) / 1000, hair = ldexp((double)rng_int(r, -8, 8), -26);
        cut[k] = (sunder_i_move_cut){.i = i == j || i == BODIES ? SUNDER_I_GROUND : i,
                                     .j = j,
                                     .n = {cos(angle), sin(angle)},
                                     .d = (double)rng_int(r, -20, 20) / 4};
        if (k && rng_int(r, 0, 1)) {
            cut[k] = cut[rng_int(r, 0, k - 1)];
            cut[k].n[0] += hair;
            cut[k].d += hair * (double)rng_int(r, 0, 64);
        }
    }
}

/* Adds the cut that is violated most, until all hold or contradict each other. Unless they do, the minimiser is one for
 * the active cuts: these hold with equality, or nearly. */
static void test_minimiser_under_nearly_dependent_cuts(void **state)
{
    (void)state;
    static const double weight[BODIES] = {1, 2, 0.5}, mass[BODIES] = {0.5, 0.25, 1}, anchor[2 * BODIES] = {0};
    size_t solved = 0;
    for (size_t i = 0; i < WORLDS; i++) {
        rng r = rng_start(test_seed(), i);
        sunder_i_move_cut cut[CUTS];
        sunder_i_dual_program p;
        sunder_i_dual_outcome outcome = SUNDER_I_DUAL_SOLVED;
        make_cuts(&r, cut);
        assert_true(sunder_i_dual_init(&p, BODIES, 0));
        p.weight = weight;
        p.mass = mass;
        p.anchor = anchor;
        p.cut = cut;
        assert_true(sunder_i_dual_load(&p, NULL, 0));
        for (int round = 0; round < 200 && outcome == SUNDER_I_DUAL_SOLVED; round++) {
            uint32_t worst = 0;
            bool failed = false;
            for (uint32_t k = 1; k < CUTS; k++)
                if (sunder_i_dual_missing(&p, &cut[k]) > sunder_i_dual_missing(&p, &cut[worst])) worst = k;
            if (!(sunder_i_dual_missing(&p, &cut[worst]) > 1e-9)) break;
            outcome = sunder_i_dual_add(&p, worst, 1e9, &failed);
            assert_false(failed);
        }
        solved += outcome != SUNDER_I_DUAL_CLOSED;
        for (size_t k = 0; k < p.acting_n && outcome != SUNDER_I_DUAL_CLOSED; k++)
            assert_true(fabs(sunder_i_dual_missing(&p, &cut[p.acting[k].cut])) < 1e-3);
        sunder_i_dual_free(&p);
    }
    assert_in_range(solved, WORLDS / 10, WORLDS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_minimiser_under_nearly_dependent_cuts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
