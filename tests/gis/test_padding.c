/* Plans and shards are written as their structs are in memory, except for padding, whose bytes are zero. If the
 * compiler has a builtin that clears padding, it is compared with our list of padding. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "scratch.h"
#include "shards/parts/part_result.h"
#include "shards/plan/plan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __has_builtin
#if __has_builtin(__builtin_clear_padding)
#define CLEAR_PADDING(thing) __builtin_clear_padding(thing)
#endif
#endif

#ifdef CLEAR_PADDING

enum { FULL = 0xff };

/* Stores two values in a list with all bits set: the bytes after the counts of all lists have to be zero, as the
 * compiler's builtin makes them. */
#define ASSERT_STORED(type, array, count)                                                                              \
    do {                                                                                                               \
        type thing[2];                                                                                                 \
        memset(thing, FULL, sizeof thing);                                                                             \
        gis_part_result result = {.array = (void *)thing, .count = 2};                                                 \
        const size_t size = gis_part_result_size(&result);                                                             \
        unsigned char *bytes = malloc(size);                                                                           \
        assert_non_null(bytes);                                                                                        \
        gis_part_result_store(&result, bytes);                                                                         \
        CLEAR_PADDING(&thing[0]);                                                                                      \
        CLEAR_PADDING(&thing[1]);                                                                                      \
        assert_memory_equal(bytes + size - sizeof thing, thing, sizeof thing);                                         \
        free(bytes);                                                                                                   \
    } while (0)

static void results_have_none(void **state)
{
    ASSERT_STORED(gis_part_world, world, worlds);
    ASSERT_STORED(gis_part_row, row, rows);
    ASSERT_STORED(sunder_footprint, footprint, footprints);
    ASSERT_STORED(sunder_world_bound, bound, bounds);
    ASSERT_STORED(gis_part_conflict, conflict, conflicts);
    ASSERT_STORED(gis_part_push, push, pushes);
    ASSERT_STORED(gis_part_tree, tree, trees);
    ASSERT_STORED(sunder_hiding_component, component, components);
    ASSERT_STORED(sunder_hiding_class, class, classes);
    ASSERT_STORED(gis_part_hidden, hidden, hiddens);
    ASSERT_STORED(gis_part_name, name, names);
    ASSERT_STORED(gis_part_still, still, stills);
    ASSERT_STORED(gis_part_link, link, links);
}

static bool holds(const char *path, const void *bytes, size_t n)
{
    char content[4096];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(content, 1, sizeof content, file);
    fclose(file);
    for (size_t at = 0; at + n <= size; at++)
        if (memcmp(content + at, bytes, n) == 0) return true;
    return false;
}

static void a_plan_has_none(void **state)
{
    gis_error error;
    char name[] = "houses";
    gis_plan plan = {.shards = 3};
    memset(&plan.facts, FULL, sizeof plan.facts);
    plan.facts.name = name;
    assert_true(gis_plan_write(&plan, scratch_directory(), &error));
    plan.facts.name = NULL;
    CLEAR_PADDING(&plan.facts);
    assert_true(holds(scratch_path("plan"), &plan.facts, sizeof plan.facts));
}

#else

static void results_have_none(void **state) { skip(); }
static void a_plan_has_none(void **state) { skip(); }

#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results_have_none),
        cmocka_unit_test(a_plan_has_none),
    };
    return cmocka_run_group_tests(tests, scratch_set_up, scratch_tear_down);
}
