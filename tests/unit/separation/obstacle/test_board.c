/* The board of covered squares: its answers for points and segments equal those of a loop over all subsums. */
#include "failing.h"
#include "generate.h"
#include "separation/obstacle/board.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

/* Computed in doubles, with a margin: `held` promises more than being inside. */
static bool inside(const sunder_i_subsum *s, double x, double y)
{
    for (uint32_t k = 0; k < s->sides; k++)
        if (s->sx[k] * (y - s->cy[k]) - s->sy[k] * (x - s->cx[k]) <= s->bound[k]) return false;
    return s->sides > 0;
}

static bool box_has(const sunder_i_subsum *s, double x, double y)
{
    return x >= s->box[0] && x <= s->box[2] && y >= s->box[1] && y <= s->box[3];
}

/* A point of the board: a covered square lies inside its holder; in an open square every subsum whose box contains the
 * point is listed. */
static void check_point(const sunder_i_operands *g, double x, double y, size_t *held, size_t *open)
{
    const sunder_i_board *h = g->board;
    const uint32_t square = sunder_i_board_square(h, x, y);
    assert_true(square < h->n * h->n);
    if (h->holder[square]) {
        assert_true(inside(g->subsum + h->holder[square] - 1, x, y));
        ++*held;
        return;
    }
    ++*open;
    uint32_t i = square ? h->list_end[square - 1] : 0;
    for (size_t k = 0; k < g->subsums; k++) {
        if (!box_has(g->subsum + k, x, y)) continue;
        while (i < h->list_end[square] && h->list[i] != k) i++; /* lists are in order */
        assert_true(i < h->list_end[square]);
    }
}

/* No point of a covered segment is in an open square; a segment inside a covered square is covered. */
static void check_segment(const sunder_i_operands *g, rng *r, size_t *held, size_t *open)
{
    const sunder_i_board *h = g->board;
    const double reach = h->reach, length = reach * rng_unit(r) * (rng_once_in(r, 2) ? 0.05 : 0.5);
    const double ax = reach * (2 * rng_unit(r) - 1), ay = reach * (2 * rng_unit(r) - 1);
    const double dx = length * (2 * rng_unit(r) - 1), dy = length * (2 * rng_unit(r) - 1);
    const bool is = sunder_i_board_segment(h, g->error, ax, ay, dx, dy);
    ++*(is ? held : open);
    bool all = true, one = true; /* all: the squares of all points are covered; one: all points are in one square */
    const uint32_t first = sunder_i_board_square(h, ax, ay);
    for (int i = 0; i <= 64; i++) {
        const uint32_t square = sunder_i_board_square(h, ax + dx * i / 64, ay + dy * i / 64);
        all = all && (square == h->n * h->n || h->holder[square]); /* points out of reach count as covered */
        one = one && square == first;
    }
    assert_true(!is || all);
    const double step = 2 * reach / h->n, low = 1e-6; /* well inside a square, so that rounding does not matter */
    const double fx = fmod(ax + reach, step) / step, fy = fmod(ay + reach, step) / step;
    const double gx = fmod(ax + dx + reach, step) / step, gy = fmod(ay + dy + reach, step) / step;
    const bool clear = fmin(fmin(fx, fy), fmin(gx, gy)) > low && fmax(fmax(fx, fy), fmax(gx, gy)) < 1 - low;
    if (one && all && clear) assert_true(is);
}

static void test_board(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    size_t held[2] = {0, 0}, open[2] = {0, 0};
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < test_count(24); i++) {
        rng r = rng_start(seed, i);
        polyset p, q;
        sunder_i_operands g;
        random_family(&p, &q, &r, i % 2 ? FAMILY_STAR : FAMILY_ROBOT, 30, 120);
        sunder_shape *a = polyset_shape(&p), *b = polyset_shape(&q);
        const sunder_i_operands_options options = {.reflect_q = true, .force_wide = i % 4 == 0};
        assert_int_equal(sunder_i_operands_init(&g, a, b, &options, NULL), SUNDER_OK);
        double reach = 0;
        for (int k = 0; k < 4; k++) reach = fmax(reach, fabs(g.box[0][k] + g.box[1][k]));
        reach *= 0.25 + rng_unit(&r);
        assert_true(sunder_i_operands_reach(&g, 2 * reach));
        assert_true(sunder_i_board_build(&g, reach));
        for (int k = 0; k < 400; k++) {
            check_point(&g, reach * (2 * rng_unit(&r) - 1), reach * (2 * rng_unit(&r) - 1), &held[0], &open[0]);
            check_segment(&g, &r, &held[1], &open[1]);
        }
        sunder_i_board_free(&g);
        assert_null(g.board);
        sunder_i_operands_free(&g);
        sunder_shape_free(a);
        sunder_shape_free(b);
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("points: %zu held, %zu open; segments: %zu held, %zu open\n", held[0], open[0], held[1], open[1]);
    for (int k = 0; k < 2; k++) assert_true(held[k] > 0 && open[k] > 0);
}

static bool separate(void *context)
{
    sunder_shape **s = context;
    sunder_separation answer;
    if (sunder_pair_separate(s[0], s[1], 0, &answer, NULL) != SUNDER_OK) return false;
    sunder_separation_clear(&answer);
    return true;
}

/* Operands with enough subsums for a board: wherever memory runs out, there is a result, or an error and no leak. */
static void test_out_of_memory(void **state)
{
    (void)state;
    rng r = rng_start(1, 0);
    polyset p, q;
    polyset_init(&p);
    polyset_init(&q);
    random_star(&p, &r, 70, 1000);
    random_star(&q, &r, 70, 1000);
    failing_begin();
    sunder_shape *s[2] = {polyset_shape(&p), polyset_shape(&q)};
    sunder_i_operands g;
    const sunder_i_operands_options options = {.reflect_q = true};
    assert_int_equal(sunder_i_operands_init(&g, s[0], s[1], &options, NULL), SUNDER_OK);
    assert_true(sunder_i_operands_reach(&g, 2000) && g.subsums >= SUNDER_I_BOARD_FROM);
    sunder_i_operands_free(&g);
    assert_true(failing_loop(separate, s, false));
    sunder_shape_free(s[0]);
    sunder_shape_free(s[1]);
    assert_int_equal(failing_outstanding(), 0);
    failing_end();
    polyset_free(&p);
    polyset_free(&q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_board), cmocka_unit_test(test_out_of_memory)};
    return cmocka_run_group_tests_name("board of held squares", tests, NULL, NULL);
}
