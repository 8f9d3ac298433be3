/* displacement/prove/optimum/bundle: the maximum of a sum of blocks' minima is found, from cuts alone.
 *
 * Each block is a list of layouts, so that its value at any place is known without a tree; the oracle evaluates the
 * whole sum at random places. */
#include "random.h"

#include "displacement/prove/optimum/bundle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { BLOCKS = 4, EACH = 3, COPIES = BLOCKS * EACH, MEMBERS = 6, LAYOUTS = 12, NUMBERS = 2 * COPIES };

typedef struct problem {
    double at_rest[BLOCKS][LAYOUTS], t[BLOCKS][LAYOUTS][2 * EACH];
    size_t first[BLOCKS + 1];
    uint32_t member[COPIES];
    double others[COPIES];
    bool still; /* the last member does not move */
} problem;

/* Block k has members k, k + 1 and k + 2. Its layouts give their positions, and cost the squared distances from the
 * places of rest. */
static void make(rng *r, problem *p)
{
    size_t count[MEMBERS] = {0};
    p->still = rng_once_in(r, 3);
    for (size_t k = 0; k < COPIES; k++) count[p->member[k] = (uint32_t)(k / EACH + k % EACH)]++;
    for (size_t k = 0; k < COPIES; k++)
        p->others[k] = p->still && p->member[k] == MEMBERS - 1 ? 0 : 1 - 1.0 / (double)count[p->member[k]];
    for (size_t k = 0; k <= BLOCKS; k++) p->first[k] = k * EACH;
    for (size_t k = 0; k < BLOCKS; k++)
        for (size_t l = 0; l < LAYOUTS; l++) {
            p->at_rest[k][l] = 0;
            for (size_t m = 0; m < 2 * EACH; m++) {
                const double t = p->t[k][l][m] = (double)rng_int(r, -8, 8) / 4;
                p->at_rest[k][l] += t * t / 2;
            }
        }
}

/* Returns the cheapest layout of the block at x. */
static size_t least_of(const problem *p, size_t k, const double *x, double *value)
{
    size_t least = 0;
    for (size_t l = 0; l < LAYOUTS; l++) {
        double v = p->at_rest[k][l];
        for (size_t m = 0; m < 2 * EACH; m++) v -= 2 * x[2 * p->first[k] + m] * p->t[k][l][m];
        if (l && v >= *value) continue;
        *value = v;
        least = l;
    }
    return least;
}

static double value_at(const problem *p, const double *x)
{
    double sum = 0;
    for (size_t k = 0; k < BLOCKS; k++) {
        double value;
        least_of(p, k, x, &value);
        sum += value;
    }
    return sum;
}

static void add_cuts(sunder_i_bundle *b, const problem *p, const double *x)
{
    for (size_t k = 0; k < BLOCKS; k++) {
        double value;
        const size_t l = least_of(p, k, x, &value);
        assert_true(sunder_i_bundle_add(b, k, value, x + 2 * p->first[k], p->t[k][l]));
    }
}

/* The sum over the copies of a member is 0, and a fixed body has no copies. */
static void check_sums(const problem *p, const double *x)
{
    for (uint32_t member = 0; member < MEMBERS; member++)
        for (size_t c = 0; c < 2; c++) {
            double sum = 0;
            for (size_t k = 0; k < COPIES; k++)
                if (p->member[k] == member) sum += x[2 * k + c];
            assert_true(fabs(sum) < 1e-9);
        }
    for (size_t k = 0; k < COPIES; k++)
        if (p->others[k] == 0) assert_true(x[2 * k] == 0 && x[2 * k + 1] == 0);
}

static double distance(const double *a, const double *b)
{
    double square = 0;
    for (size_t k = 0; k < NUMBERS; k++) square += (a[k] - b[k]) * (a[k] - b[k]);
    return square;
}

/* A random place near another, with the same sums. */
static void draw_near(rng *r, const problem *p, const double *at, double far, double *x)
{
    memcpy(x, at, NUMBERS * sizeof *x);
    for (size_t k = 0; k < COPIES; k++)
        for (size_t l = 0; l < k; l++)
            if (p->member[k] == p->member[l] && p->others[k] > 0)
                for (size_t c = 0; c < 2; c++) {
                    const double way = far * (rng_unit(r) - 0.5);
                    x[2 * k + c] += way;
                    x[2 * l + c] -= way;
                }
}

static void check_case(rng *r)
{
    static problem p;
    make(r, &p);
    sunder_i_bundle b = {.blocks = BLOCKS,
                         .copies = COPIES,
                         .members = MEMBERS,
                         .first = p.first,
                         .member = p.member,
                         .others = p.others};
    double centre[NUMBERS] = {0}, x[NUMBERS], stride = 0.2, promise = INFINITY;
    assert_true(sunder_i_bundle_init(&b));
    add_cuts(&b, &p, centre);
    double now = value_at(&p, centre);
    for (int round = 0; round < 400; round++) {
        assert_true(sunder_i_bundle_propose(&b, centre, stride, x, &promise));
        check_sums(&p, x);
        const double value = value_at(&p, x);
        /* A cut is never less than the value, and the proposal is the maximum of the cuts' model: so the model there is
         * no less than the value at the centre, or at any other place. */
        assert_true(promise >= now - 1e-3);
        assert_true(promise + 1e-3 >= value - distance(x, centre) / (2 * stride));
        for (int k = 0; k < 8; k++) {
            double other[NUMBERS];
            draw_near(r, &p, x, stride, other);
            assert_true(promise + 1e-3 >= value_at(&p, other) - distance(other, centre) / (2 * stride));
        }
        if (promise - now <= 1e-3) break;
        add_cuts(&b, &p, x);
        if (value < now + 0.1 * (promise - now)) continue;
        now = value;
        memcpy(centre, x, sizeof centre);
    }
    assert_true(promise - now <= 1e-3);
    /* No place nearby has a greater value, up to the term of the squared distance. */
    for (int k = 0; k < 200; k++) {
        double other[NUMBERS];
        draw_near(r, &p, centre, 0.05, other);
        assert_true(value_at(&p, other) <= now + 3e-3 + distance(other, centre) / (2 * stride));
    }
    sunder_i_bundle_free(&b);
}

static void test_finds_the_most(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    print_message("seed %llu\n", (unsigned long long)seed);
    for (size_t k = 0; k < test_count(200); k++) {
        rng r = rng_start(seed, k);
        check_case(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_finds_the_most)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
