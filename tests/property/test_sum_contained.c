/* Layers of members that overlap and touch, dilated by a convex shape: subsums inside another one, and sides inside a
 * single one, are dropped before all further steps. Compared byte for byte with the oracle, and with the same sum on
 * big integers, where none is dropped. */
#include "convex/subsums.h"
#include "generate.h"
#include "minkowski/minkowski.h"
#include "oracle.h"
#include "outline/contained_parts.h"
#include "sum_text.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

__extension__ typedef __int128 int128;

static void random_member(polyset *p, rng *r, bool map)
{
    cells board;
    polyset one;
    polyset_init(&one);
    switch (rng_int(r, 0, map ? 1 : 4)) {
    case 0:
    case 1:
        if (map)
            random_building(&one, r);
        else
            polyset_rectangle(&one, 0, 0, (double)rng_int(r, 1, 9), (double)rng_int(r, 1, 9));
        break;
    case 2: random_simple(&one, r, (int)rng_int(r, 3, 7), 10); break;
    case 3: random_star(&one, r, (int)rng_int(r, 4, 8), 9); break;
    default:
        random_cells(&board, r, 3, 3, SPACING_SMALL, rng_once_in(r, 2), 70);
        cells_outline(&one, &board, false, true);
    }
    if (!map) polyset_move(&one, (double)rng_int(r, 0, 24), (double)rng_int(r, 0, 24));
    polyset_append(p, &one);
    polyset_free(&one);
}

static void random_layer(polyset *p, polyset *q, rng *r, bool map, int most)
{
    const int n = (int)rng_int(r, 2, most);
    polyset_init(p);
    polyset_init(q);
    for (int i = 0; i < n; i++) random_member(p, r, map);
    if (rng_once_in(r, 2))
        random_convex(q, r, (int)rng_int(r, 3, 10), rng_once_in(r, 2) ? 4 : 9);
    else
        polyset_rectangle(q, -2, -1, (double)rng_int(r, 1, 6), (double)rng_int(r, 1, 6));
}

static bool same_texts(const polyset *p, const polyset *q, bool with_oracle)
{
    char *ours = library_sum_text(p, q);
    char *other = with_oracle ? oracle_sum_text(p, q, false) : library_sum_text_wide(p, q);
    const bool same = ours && other && strcmp(ours, other) == 0;
    if (!same) {
        char *x = polyset_wkt(p), *y = polyset_wkt(q);
        print_message("%s\n%s\n  ours  %.2000s\n  other %.2000s\n", x, y, ours ? ours : "failed",
                      other ? other : "failed");
        free(x);
        free(y);
    }
    free(ours);
    free(other);
    return same;
}

static void test_layers(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(150);
    size_t bad = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < n && bad < 2; i++) {
        rng r = rng_start(seed * 31, i);
        polyset p, q;
        const bool small = i % 3 != 0;
        random_layer(&p, &q, &r, i % 4 == 1, small ? 4 : 30);
        if (!same_texts(&p, &q, small)) {
            print_message("SUNDER_SEED=%llu, case %zu\n", (unsigned long long)seed, i);
            bad++;
        }
        polyset_free(&p);
        polyset_free(&q);
    }
    assert_int_equal(bad, 0);
}

typedef struct parts {
    sunder_shape *a, *b;
    sunder_i_placed placed;
    sunder_i_convex_pieces list;
    sunder_i_directions directions;
} parts;

static void make_parts(parts *s, const polyset *p, const polyset *q)
{
    const sunder_i_place_options how = {0};
    s->a = polyset_shape(p);
    s->b = polyset_shape(q);
    assert_int_equal(sunder_i_place(s->a, s->b, &how, &s->placed, NULL), SUNDER_OK);
    assert_true(s->placed.lattice.narrow);
    assert_int_equal(sunder_i_subsums_build(&s->placed.lattice, s->a, s->placed.p, s->b, s->placed.q, &s->directions,
                                            &s->list, NULL),
                     SUNDER_OK);
}

static void free_parts(parts *s)
{
    sunder_i_convex_pieces_free(&s->list);
    sunder_i_directions_free(&s->directions);
    sunder_i_placed_free(&s->placed);
    sunder_shape_free(s->a);
    sunder_shape_free(s->b);
}

static size_t candidates(const sunder_i_convex_pieces *s)
{
    size_t n = 0;
    for (size_t k = 0; k < s->corners; k++) n += s->candidate[k];
    return n;
}

/* The numbers of candidate sides before and after. */
static void count_candidates(const polyset *p, const polyset *q, size_t count[2])
{
    parts s;
    make_parts(&s, p, q);
    count[0] = candidates(&s.list);
    assert_int_equal(sunder_i_drop_contained_sides(&s.list, NULL), SUNDER_OK);
    count[1] = candidates(&s.list);
    free_parts(&s);
}

/* Strictly inside, computed in integers. */
static bool is_inside(const sunder_i_convex_pieces *s, uint32_t i, uint32_t j)
{
    const uint32_t from = sunder_i_convex_pieces_first(s, j);
    if (s->end[j] - from < 3) return false;
    for (uint32_t k = sunder_i_convex_pieces_first(s, i); k < s->end[i]; k++)
        for (uint32_t m = from; m < s->end[j]; m++) {
            const sunder_i_point a = s->corner[m], b = s->corner[m + 1 < s->end[j] ? m + 1 : from], c = s->corner[k];
            if ((int128)(b.x - a.x) * (c.y - a.y) <= (int128)(b.y - a.y) * (c.x - a.x)) return false;
        }
    return true;
}

static bool is_same_part(const sunder_i_convex_pieces *s, uint32_t i, const sunder_i_convex_pieces *t, uint32_t j)
{
    const uint32_t a = sunder_i_convex_pieces_first(s, i), b = sunder_i_convex_pieces_first(t, j), n = s->end[i] - a;
    return n == t->end[j] - b && memcmp(s->corner + a, t->corner + b, n * sizeof *s->corner) == 0 &&
           memcmp(s->rank + a, t->rank + b, n * sizeof *s->rank) == 0;
}

/* The remaining subsums are those that are inside no other, in their old order, and no side became a candidate. */
static size_t check_parts(const parts *before, const parts *after)
{
    const sunder_i_convex_pieces *s = &before->list, *t = &after->list;
    uint32_t next = 0;
    for (uint32_t i = 0; i < s->n; i++) {
        bool inside = false;
        for (uint32_t j = 0; j < s->n && !inside; j++) inside = is_inside(s, i, j);
        if (inside) continue;
        assert_true(next < t->n && is_same_part(s, i, t, next));
        const uint32_t a = sunder_i_convex_pieces_first(s, i), b = sunder_i_convex_pieces_first(t, next);
        for (uint32_t k = 0; a + k < s->end[i]; k++) assert_true(s->candidate[a + k] || !t->candidate[b + k]);
        next++;
    }
    assert_int_equal(next, t->n);
    return s->n - t->n;
}

static void test_parts(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    const size_t n = test_count(60);
    size_t gone = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(seed * 37, i);
        polyset p, q;
        parts before, after;
        random_layer(&p, &q, &r, false, 20);
        make_parts(&before, &p, &q);
        make_parts(&after, &p, &q);
        assert_int_equal(sunder_i_drop_contained(&after.list, NULL), SUNDER_OK);
        gone += check_parts(&before, &after);
        free_parts(&before);
        free_parts(&after);
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("%zu parts inside another\n", gone);
    assert_true(2 * gone > n); /* about one per layer */
}

/* A row of squares: the sides towards neighbours are inside these, except for the first and the last; sides that only
 * touch a neighbour's are not. */
static void test_row(void **state)
{
    (void)state;
    for (int step = 2; step <= 6; step++) {
        polyset p, q;
        size_t count[2];
        polyset_init(&p);
        polyset_init(&q);
        for (int i = 0; i < 40; i++) polyset_rectangle(&p, step * i, 0.25 * (i % 2), step * i + 2, 0.25 * (i % 2) + 2);
        polyset_rectangle(&q, -2, -2, 2, 2); /* each subsum is 6 wide */
        count_candidates(&p, &q, count);
        assert_int_equal(count[0], 160);
        /* The vertical sides extend by a quarter beyond the neighbours, and end on the outline of the next but one. */
        assert_int_equal(count[1], 160);
        polyset_free(&p);
        polyset_init(&p);
        for (int i = 0; i < 40; i++) polyset_rectangle(&p, step * i, i % 2, step * i + 2, 4 - i % 2);
        count_candidates(&p, &q, count);
        assert_int_equal(count[0], 160);
        /* The vertical sides of the low ones lie in the high ones, if these overlap by more than a touch. */
        assert_int_equal(count[1], step < 6 ? 160 - 40 + 1 : 160);
        polyset_free(&p);
        polyset_free(&q);
    }
}

static void test_memory(void **state)
{
    (void)state;
    polyset operand[2];
    polyset_init(&operand[0]);
    polyset_init(&operand[1]);
    for (int i = 0; i < 6; i++) polyset_rectangle(&operand[0], 2 * i, i % 2, 2 * i + 2, 4 - i % 2);
    polyset_rectangle(&operand[1], -2, -2, 2, 2);
    assert_true(library_sum_survives(operand));
    polyset_free(&operand[0]);
    polyset_free(&operand[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_row), cmocka_unit_test(test_parts),
                                       cmocka_unit_test(test_layers), cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests_name("sides and parts inside one subsum", tests, NULL, NULL);
}
