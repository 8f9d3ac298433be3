/* displacement/prove/optimum/tree_regions: the cached regions of an open node equal those computed from its cuts, to
 * the last bit, also if other cuts were tried in between. */
#include "scene_model.h"

#include "displacement/prove/optimum/tree.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 3, BODIES = SIDE * SIDE };

typedef struct crowd {
    scene scene;
    scene_model of;
    sunder_i_tree tree;
    uint32_t body[BODIES];
} crowd;

/* Boxes of side 10 at a spacing of 8, so that they overlap, and their tree after a number of steps. */
static void begin(crowd *c, uint64_t steps)
{
    const sunder_i_waived none = {0};
    scene_begin(&c->scene, 1);
    for (int k = 0; k < BODIES; k++) scene_add_box(&c->scene, 8 * (k % SIDE), 8 * (k / SIDE) + k % 2, 10, 10);
    scene_model_begin(&c->of, &c->scene);
    for (uint32_t k = 0; k < BODIES; k++) c->body[k] = k;
    const sunder_i_task task = {.model = &c->of.model, .waived = &none, .body = c->body, .n = BODIES, .goal = 1000};
    assert_true(sunder_i_tree_init(&c->tree, &task));
    sunder_i_tree_run(&c->tree, steps);
    assert_false(c->tree.failed);
}

static void end(crowd *c)
{
    sunder_i_tree_free(&c->tree);
    scene_model_end(&c->of);
    scene_end(&c->scene);
}

static void test_as_made_again(void **state)
{
    (void)state;
    crowd c;
    size_t compared = 0;
    begin(&c, 2000000);
    sunder_i_tree *t = &c.tree;
    assert_true(t->opens > 20);
    for (size_t k = 0; k < t->opens; k++) {
        const uint32_t node = t->open[k].node;
        assert_non_null(t->node[node].regions);
        sunder_i_tree_load(t, node);
        assert_null(t->node[node].regions);
        const size_t n = t->touched.n;
        uint32_t *pair = calloc(n, sizeof *pair);
        sunder_i_region *kept = calloc(n, sizeof *kept);
        assert_true(n && pair && kept);
        for (size_t m = 0; m < n; m++) kept[m] = t->pair[pair[m] = t->touched.item[m]].region;
        sunder_i_tree_load(t, node);
        assert_int_equal(t->touched.n, n);
        for (size_t m = 0; m < n; m++) {
            const sunder_i_region *made = &t->pair[pair[m]].region;
            assert_int_equal(t->touched.item[m], pair[m]);
            assert_int_equal(made->n, kept[m].n);
            assert_memory_equal(made->xy, kept[m].xy, 2 * made->n * sizeof *made->xy);
            assert_memory_equal(made->cut, kept[m].cut, made->n * sizeof *made->cut);
            assert_memory_equal(&made->blur, &kept[m].blur, sizeof made->blur);
            compared += made->n;
        }
        free(pair);
        free(kept);
    }
    assert_true(compared > 100);
    assert_int_equal(t->kept_bytes, 0);
    end(&c);
}

/* Freeing a tree with open nodes frees all memory, and regions beyond the maximum number are not cached. */
static void test_no_more_than_the_most(void **state)
{
    (void)state;
    crowd c;
    begin(&c, 200000);
    sunder_i_tree *t = &c.tree;
    assert_true(t->opens > 0);
    const uint32_t node = t->open[0].node;
    sunder_i_tree_load(t, node);
    t->kept_bytes += SIZE_MAX / 4;
    sunder_i_tree_keep_regions(t, node);
    assert_null(t->node[node].regions);
    t->kept_bytes -= SIZE_MAX / 4;
    sunder_i_tree_keep_regions(t, node);
    assert_non_null(t->node[node].regions);
    end(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_as_made_again),
                                       cmocka_unit_test(test_no_more_than_the_most)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
