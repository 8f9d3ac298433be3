/* Newton steps on quadratic programs: results satisfy the optimality conditions, for soft and for hard constraints. If
 * constraints contradict each other, the forces prove that every solution costs too much. A program that is not solved
 * is left unchanged. A compromise for a terrace takes a fraction of the work of the dual methods. */
#include "displacement/quadratic/methods.h"
#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { BODIES = 60, MOST = 6 * BODIES };

typedef struct program {
    sunder_i_quadratic q;
    double mass[BODIES], t[2 * BODIES];
    sunder_i_constraint constraint[MOST];
} program;

static void demand(program *p, uint32_t i, uint32_t j, double angle, double d)
{
    p->constraint[p->q.n++] =
        (sunder_i_constraint){.i = i, .j = j, .n = {cos(angle), sin(angle)}, .d = d, .key = p->q.n};
}

static void begin(program *p)
{
    memset(p, 0, sizeof *p);
    p->q = (sunder_i_quadratic){.bodies = BODIES, .mass = p->mass, .t = p->t, .constraint = p->constraint};
    for (size_t k = 0; k < BODIES; k++) p->mass[k] = 0.5;
}

/* Random contacts of bodies with their neighbours in a list, some with the ground, and some bodies fixed; all distances
 * grow along one direction, so there is a solution: all move along it. */
static void draw(rng *r, program *p)
{
    begin(p);
    for (size_t k = 0; k < BODIES; k++) p->mass[k] = rng_once_in(r, 9) ? 0 : pow(10, 2 * rng_unit(r) - 1);
    const size_t n = (size_t)rng_int(r, 3 * BODIES, 5 * BODIES);
    while (p->q.n < n) {
        const uint32_t j = (uint32_t)rng_int(r, 1, BODIES - 1), i = j - (uint32_t)rng_int(r, 1, j < 4 ? j : 4);
        if (!(p->mass[j] > 0)) continue;
        demand(p, rng_once_in(r, 8) ? SUNDER_I_GROUND : i, j, 2.4 * rng_unit(r) - 1.2, rng_unit(r));
    }
}

static double mass_of(const program *p, const sunder_i_constraint *c)
{
    return sunder_i_mass(&p->q, c->i) + sunder_i_mass(&p->q, c->j);
}

/* Moves follow from the forces; an active constraint is violated by its softness times its force, and no constraint by
 * more. */
static void check_optimal(const program *p, size_t trial, double softness, double tolerance)
{
    double pushed[2 * BODIES] = {0}, far = 1;
    for (size_t k = 0; k < p->q.n; k++) sunder_i_push(&p->q, &p->constraint[k], p->constraint[k].force, pushed);
    for (size_t k = 0; k < 2 * BODIES; k++) far = fmax(far, fabs(p->t[k]));
    for (size_t k = 0; k < 2 * BODIES; k++)
        if (!(fabs(pushed[k] - p->t[k]) <= 1e-6 * far))
            fail_msg("trial %zu: pushed by %g, moved by %g", trial, pushed[k], p->t[k]);
    for (size_t k = 0; k < p->q.n; k++) {
        const sunder_i_constraint *c = &p->constraint[k];
        const double left = c->d - sunder_i_stretch(c, p->t) - softness * mass_of(p, c) * c->force;
        if (!(c->force >= 0)) fail_msg("trial %zu: a force of %g", trial, c->force);
        if (!(left <= tolerance)) fail_msg("trial %zu: a violation of %g", trial, left);
        if (c->force > 0 && !(left >= -tolerance))
            fail_msg("trial %zu: an active constraint is satisfied with a slack of %g", trial, -left);
    }
}

static void check_solutions(void **state)
{
    (void)state;
    size_t solved = 0, trials = test_count(400);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        static program p;
        bool done;
        draw(&r, &p);
        const double softness = rng_once_in(&r, 2) ? pow(10, -1 - 5 * rng_unit(&r)) : 0, tolerance = 1e-8;
        assert_true(sunder_i_quadratic_newton(&p.q, softness, tolerance, &done));
        if (done) check_optimal(&p, trial, softness, tolerance);
        /* Started from its own forces it finishes at once. */
        const uint64_t work = p.q.work;
        if (done) assert_true(sunder_i_quadratic_newton(&p.q, softness, tolerance, &done) && done);
        if (done && p.q.work - work > work) fail_msg("trial %zu: started from its own forces it takes longer", trial);
        solved += done;
    }
    printf("%zu of %zu solved\n", solved, trials);
    assert_true(10 * solved >= 9 * trials);
}

/* A row between two walls, without enough room. */
static void row(program *p, double limit)
{
    begin(p);
    for (uint32_t k = 0; k < BODIES; k++) {
        if (k) demand(p, k - 1, k, 0, 1);
        for (int e = 0; e < 4; e++) demand(p, SUNDER_I_GROUND, k, 1.5707963267948966 * e, -limit);
    }
}

/* With a bound on the cost, the method detects that no solution is below it; without one, the forces stay unchanged. */
static void check_contradiction(void **state)
{
    (void)state;
    static program p;
    bool done;
    row(&p, 10);
    p.q.most_cost = BODIES * 100.0;
    assert_true(sunder_i_quadratic_newton(&p.q, 0, 1e-9, &done) && done);
    assert_true(sunder_i_quadratic_is_beyond(&p.q, 0));
    row(&p, 10);
    p.constraint[3].force = 0.25;
    assert_true(sunder_i_quadratic_newton(&p.q, 0, 1e-9, &done) && !done);
    for (size_t k = 0; k < p.q.n; k++) assert_true(p.constraint[k].force == (k == 3 ? 0.25 : 0));
    /* For a long row the solver as a whole gives the same result. */
    row(&p, 10);
    p.q.most_cost = BODIES * 100.0;
    assert_true(sunder_i_quadratic_solve(&p.q, 0, 1e-9, 1) == INFINITY);
}

/* The same with a tiny violation, so that forces grow slowly. */
static void check_slight_contradiction(void **state)
{
    (void)state;
    static program p;
    for (double missed = 1e-2; missed > 5e-6; missed /= 10) {
        bool done;
        row(&p, (BODIES - 1) / 2.0 - missed);
        p.q.most_cost = BODIES * 1000.0;
        assert_true(sunder_i_quadratic_newton(&p.q, 0, 1e-9, &done));
        if (!done) fail_msg("with %g missed it is not known", missed);
        assert_true(sunder_i_quadratic_is_beyond(&p.q, 0));
        for (size_t k = 0; k < p.q.n; k++) assert_true(p.constraint[k].force >= 0 && p.constraint[k].force < INFINITY);
    }
    /* With that much more room there is a solution. */
    bool done;
    row(&p, (BODIES - 1) / 2.0 + 1e-6);
    p.q.most_cost = BODIES * 1000.0;
    assert_true(sunder_i_quadratic_newton(&p.q, 0, 1e-9, &done) && done);
    check_optimal(&p, 0, 0, 1e-8);
}

static void check_work(void **state)
{
    (void)state;
    static program p, q;
    bool done;
    row(&p, 10);
    row(&q, 10);
    assert_true(sunder_i_quadratic_newton(&p.q, 1e-5, 1e-4, &done) && done);
    check_optimal(&p, 0, 1e-5, 1e-4);
    assert_true(sunder_i_quadratic_gradient(&q.q, 1e-5, 1e-4, 400));
    printf("%llu, and by the dual %llu\n", (unsigned long long)p.q.work, (unsigned long long)q.q.work);
    assert_true(8 * p.q.work < q.q.work);
}

int main(void)
{
    printf("seed %llu\n", (unsigned long long)test_seed());
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_solutions), cmocka_unit_test(check_contradiction),
                                       cmocka_unit_test(check_slight_contradiction), cmocka_unit_test(check_work)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
