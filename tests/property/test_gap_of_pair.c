/* The value of need_gap for a conflict of two features without neighbours: with that gap their limits are long enough,
 * and with a gap that is larger by a hundredth of the layer's gap they are not. */
#include "generate.h"
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static double least_move(const polyset set[2], double gap)
{
    sunder_shape *p = polyset_shape(&set[0]), *q = polyset_shape(&set[1]);
    sunder_separation least;
    assert_int_equal(sunder_pair_separate(p, q, gap, &least, NULL), SUNDER_OK);
    const double distance = least.distance;
    sunder_separation_clear(&least);
    sunder_shape_free(p);
    sunder_shape_free(q);
    return distance;
}

static void add(scene *s, const polyset *set, double limit)
{
    char *wkt = polyset_wkt(set);
    sunder_feature *f = scene_add(s, wkt);
    f->max_shift = limit;
    f->fixed = limit == 0;
    free(wkt);
}

/* Two features that overlap, one of them fixed in half of the cases, with limits that are long enough to separate them,
 * and too short for the gap. */
static bool is_right(uint64_t i, size_t *asked)
{
    rng r = rng_start(test_seed() + 90, i);
    polyset set[2];
    scene s;
    size_t n;
    for (int k = 0; k < 2; k++) {
        polyset_init(&set[k]);
        if (rng_once_in(&r, 2))
            random_convex(&set[k], &r, (int)rng_int(&r, 3, 8), 10);
        else
            random_star(&set[k], &r, (int)rng_int(&r, 4, 9), 10);
    }
    bring_together(&set[0], &set[1], &r);
    const double gap = 1 + 9 * rng_unit(&r), apart = least_move(set, 0), all = least_move(set, gap);
    const double reach = apart + (all - apart) * (0.05 + 0.9 * rng_unit(&r));
    const double first = rng_once_in(&r, 2) ? 0 : reach * rng_unit(&r);
    scene_begin(&s, gap);
    s.options.no_blocks = s.options.allow_jumps = true;
    s.options.contained = SUNDER_CONTAINMENT_SEPARATE;
    add(&s, &set[0], first);
    add(&s, &set[1], reach - first);
    scene_separate(&s);
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    bool right = n <= 1;
    if (n == 1 && reach - first > 0) {
        ++*asked;
        right = c->need_gap >= 0 && c->need_gap < gap && least_move(set, c->need_gap) <= reach * (1 + 1e-9) &&
                least_move(set, c->need_gap + gap / 100) > reach * (1 - 1e-9);
        if (!right)
            print_message("case %llu: gap %.17g, reach %.17g, need_gap %.17g, its move %.17g\n", (unsigned long long)i,
                          gap, reach, c->need_gap, least_move(set, c->need_gap));
    }
    scene_end(&s);
    for (int k = 0; k < 2; k++) polyset_free(&set[k]);
    return right;
}

static void test_gap_of_a_pair_alone_is_the_largest(void **state)
{
    const size_t n = test_count(150);
    size_t asked = 0, wrong = 0;
    for (size_t i = 0; i < n; i++) wrong += !is_right(i, &asked);
    print_message("%zu pairs, %zu left in conflict\n", n, asked);
    assert_int_equal(wrong, 0);
    assert_true(asked > n / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_gap_of_a_pair_alone_is_the_largest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
