/* Quadratic programs with and without solutions: all results are finite numbers, and the returned violation is that of
 * the moves. A solution that was repaired near a few constraints is as accurate as one computed from scratch. For the
 * nearest feasible point the forces prove that it is the nearest, or that there is none. */
#include "displacement/quadratic/methods.h"
#include "displacement/quadratic/nearest.h"
#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { BODIES = 8, MOST = 40 };

typedef struct program {
    sunder_i_quadratic q;
    double mass[BODIES], t[2 * BODIES];
    sunder_i_constraint constraint[MOST];
} program;

static void demand(program *p, uint32_t i, uint32_t j, const double n[2], double d)
{
    if (i == j || p->q.n == MOST) return;
    p->constraint[p->q.n++] = (sunder_i_constraint){.i = i, .j = j, .n = {n[0], n[1]}, .d = d};
}

/* Draws random contacts. In half of the programs some bodies are pushed from both sides, in opposite or nearly opposite
 * directions: then constraints must be violated, and no force is enough. Sizes vary over many orders of magnitude. */
static bool draw(rng *r, program *p)
{
    memset(p, 0, sizeof *p);
    p->q = (sunder_i_quadratic){.bodies = BODIES, .mass = p->mass, .t = p->t, .constraint = p->constraint};
    for (size_t k = 0; k < BODIES; k++)
        p->mass[k] = rng_once_in(r, 6) ? 0 : rng_once_in(r, 2) ? 1 : pow(10, 8 * rng_unit(r) - 4);
    const double size = pow(10, 8 * rng_unit(r) - 3);
    const bool contradicts = rng_once_in(r, 2);
    const int n = (int)rng_int(r, 1, MOST / 2);
    for (int k = 0; k < n; k++) {
        const uint32_t i = rng_once_in(r, 4) ? SUNDER_I_GROUND : (uint32_t)rng_int(r, 0, BODIES - 1);
        const uint32_t j = (uint32_t)rng_int(r, 0, BODIES - 1);
        const double angle = rng_once_in(r, 3) ? 0 : 6.3 * rng_unit(r), d = size * rng_unit(r);
        const double u[2] = {cos(angle), sin(angle)};
        demand(p, i, j, u, d);
        if (!contradicts || rng_once_in(r, 2)) continue;
        const double off = angle + (rng_once_in(r, 2) ? 0 : pow(10, -16 * rng_unit(r)));
        const double back[2] = {-cos(off), -sin(off)};
        demand(p, i, j, back, size * rng_unit(r));
    }
    return contradicts;
}

static double missed(const program *p)
{
    double worst = 0;
    for (size_t k = 0; k < p->q.n; k++) {
        const sunder_i_constraint *c = &p->constraint[k];
        const double v = c->d - sunder_i_stretch(c, p->t);
        if (!(v <= worst)) worst = v;
    }
    return worst;
}

static void check_programs(void **state)
{
    (void)state;
    size_t solved = 0, beyond = 0;
    for (size_t trial = 0; trial < test_count(4000); trial++) {
        rng r = rng_start(test_seed(), trial);
        program p;
        draw(&r, &p);
        const double softness = rng_once_in(&r, 3) ? 0.1 * rng_unit(&r) : 0, tolerance = 1e-9;
        const double v = sunder_i_quadratic_solve(&p.q, softness, tolerance, 1000);
        for (size_t k = 0; k < 2 * BODIES; k++)
            if (!isfinite(p.t[k])) fail_msg("trial %zu: body %zu is moved by %g", trial, k / 2, p.t[k]);
        for (size_t k = 0; k < p.q.n; k++)
            if (!isfinite(p.constraint[k].force)) fail_msg("trial %zu: a force of %g", trial, p.constraint[k].force);
        if (!(v >= 0)) fail_msg("trial %zu: a violation of %g", trial, v);
        const double truly = missed(&p);
        if (v != INFINITY && !(fabs(truly - v) <= 1e-9 * (1 + v)))
            fail_msg("trial %zu: the violation is %.17g and not %.17g", trial, truly, v);
        solved += v <= tolerance;
        beyond += v > tolerance;
    }
    printf("%zu solved, %zu not\n", solved, beyond);
    assert_true(solved > 0 && beyond > 0);
}

/* Sums the forces on each body; returns the sum of force times demand. */
static double sum_forces(const program *p, double net[2 * BODIES])
{
    double won = 0;
    memset(net, 0, 2 * BODIES * sizeof *net);
    for (size_t k = 0; k < p->q.n; k++) {
        const sunder_i_constraint *c = &p->constraint[k];
        won += c->force * c->d;
        for (size_t x = 0; x < 2; x++) {
            if (c->j != SUNDER_I_GROUND) net[2 * c->j + x] += c->force * c->n[x];
            if (c->i != SUNDER_I_GROUND) net[2 * c->i + x] -= c->force * c->n[x];
        }
    }
    return won;
}

/* The optimality conditions: active constraints hold with equality, and the forces equal the moves times the masses. If
 * walls are nearly opposite, forces and rounding errors are many times the distance between them. */
static void check_found(const program *p, size_t trial, double size)
{
    double net[2 * BODIES], all = size, far = size;
    sum_forces(p, net);
    for (size_t k = 0; k < p->q.n; k++) all += p->constraint[k].force;
    for (size_t k = 0; k < 2 * BODIES; k++) far = fmax(far, fabs(p->t[k]));
    if (missed(p) > 1e-12 * size) fail_msg("trial %zu: a violation of %g", trial, missed(p));
    for (size_t k = 0; k < 2 * BODIES && far <= 100 * size; k++)
        if (!(fabs(net[k] - p->t[k]) <= 1e-10 * all))
            fail_msg("trial %zu: pushed by %g, moved by %g", trial, net[k], p->t[k]);
    for (size_t k = 0; k < p->q.n; k++) {
        const sunder_i_constraint *c = &p->constraint[k];
        if (c->force < 0) fail_msg("trial %zu: a force of %g", trial, c->force);
        if (c->force > 0 && !(fabs(c->d - sunder_i_stretch(c, p->t)) <= 1e-11 * far))
            fail_msg("trial %zu: an active constraint is satisfied with a slack of %g", trial,
                     sunder_i_stretch(c, p->t) - c->d);
    }
}

/* Demands that the forces prove infeasibility: they require more than bodies within these limits can give. */
static void check_none(const program *p, size_t trial, double limit)
{
    double net[2 * BODIES], lost = 0;
    const double won = sum_forces(p, net);
    for (size_t b = 0; b < BODIES; b++) lost += limit * hypot(net[2 * b], net[2 * b + 1]);
    if (!(won > lost * (1 - 1e-9)))
        fail_msg("trial %zu: the constraints require %g, and the limits allow %g", trial, won, lost);
}

static void check_nearest(void **state)
{
    (void)state;
    size_t outcomes[3] = {0};
    const double from[2 * BODIES] = {0};
    sunder_i_nearest nearest = {0};
    for (size_t trial = 0; trial < test_count(4000); trial++) {
        rng r = rng_start(test_seed(), trial);
        program p;
        draw(&r, &p);
        double size = 0, limit[BODIES];
        for (size_t k = 0; k < p.q.n; k++) size = fmax(size, p.constraint[k].d);
        for (size_t b = 0; b < BODIES; b++) limit[b] = 100 * size;
        assert_true(sunder_i_nearest_begin(&nearest, &p.q));
        const size_t all = p.q.n;
        p.q.n = (size_t)rng_int(&r, 0, (int)all); /* the others are added later */
        sunder_i_nearest_outcome outcome = sunder_i_nearest_go_on(&nearest, &p.q, from, limit, 1e-12 * size);
        if (outcome == SUNDER_I_NEAREST_FOUND) {
            check_found(&p, trial, size);
            p.q.n = all;
            outcome = sunder_i_nearest_go_on(&nearest, &p.q, from, limit, 1e-12 * size);
        }
        if (outcome == SUNDER_I_NEAREST_FOUND) check_found(&p, trial, size);
        if (outcome == SUNDER_I_NEAREST_NONE) check_none(&p, trial, limit[0]);
        outcomes[outcome]++;
    }
    sunder_i_nearest_free(&nearest);
    printf("%zu with a solution, %zu proved to have none, %zu undecided\n", outcomes[0], outcomes[1], outcomes[2]);
    assert_true(outcomes[0] > 0 && outcomes[1] > 0 && outcomes[2] <= test_count(4000) / 100);
}

/* A crowd in rows; each body has to keep a distance from its neighbours, in directions that deviate by up to a right
 * angle: chains of contacts push the outer ones by fifty times their size. */
enum { SIDE = 40, CROWD = SIDE * SIDE };

static size_t crowd(rng *r, sunder_i_constraint *constraint)
{
    size_t n = 0;
    for (int k = 0; k < CROWD; k++)
        for (int e = 0; e < 4; e++) {
            const int dx[] = {1, 0, 1, -1}, dy[] = {0, 1, 1, 1}, x = k % SIDE + dx[e], y = k / SIDE + dy[e];
            if (x < 0 || x >= SIDE || y >= SIDE) continue;
            const double angle = atan2(dy[e], dx[e]) + 3 * (rng_unit(r) - 0.5);
            constraint[n++] = (sunder_i_constraint){
                .i = (uint32_t)k, .j = (uint32_t)(y * SIDE + x), .n = {cos(angle), sin(angle)}, .d = e < 2 ? 1 : 0.5};
        }
    return n;
}

/* The interior point method, started near the solution, with slacks and forces as for small bodies, takes half as much
 * work again. */
static void check_crowd(void **state)
{
    (void)state;
    static sunder_i_constraint constraint[4 * CROWD];
    static double mass[CROWD], t[2 * CROWD];
    rng r = rng_start(1, 0);
    for (size_t k = 0; k < CROWD; k++) mass[k] = 0.5;
    sunder_i_quadratic q = {.bodies = CROWD, .mass = mass, .t = t, .constraint = constraint};
    q.n = crowd(&r, constraint);
    assert_true(sunder_i_quadratic_solve(&q, 0, 1e-9, 0.02) <= 1e-9);
    assert_true(q.work < 18000000);
}

static double cost_of(const sunder_i_quadratic *q)
{
    double cost = 0;
    for (size_t k = 0; k < 2 * q->bodies; k++) cost += q->t[k] * q->t[k] / (2 * q->mass[k / 2]);
    return cost;
}

/* A crowd that is solved, and another body without contacts. */
enum { MORE = 3, LONE = CROWD };

typedef struct solved_crowd {
    sunder_i_quadratic q;
    double mass[CROWD + 1], t[2 * CROWD + 2];
    sunder_i_constraint constraint[4 * CROWD + MORE];
} solved_crowd;

static void solve_crowd(rng *r, solved_crowd *c)
{
    for (size_t k = 0; k <= LONE; k++) c->mass[k] = 0.5;
    c->q = (sunder_i_quadratic){.bodies = CROWD + 1, .mass = c->mass, .t = c->t, .constraint = c->constraint};
    c->q.n = crowd(r, c->constraint);
    for (size_t k = 0; k < c->q.n; k++) c->constraint[k].d /= 40;
    assert_true(sunder_i_quadratic_solve(&c->q, 0, 1e-9, 0.02) <= 1e-9);
}

/* Reduces the required distances of three neighbouring bodies. */
static void demand_less(solved_crowd *c, uint32_t first)
{
    const uint32_t place[MORE] = {first, first + 1, first + SIDE};
    for (int k = 0; k < MORE; k++) {
        const double *t = c->t + 2 * place[k], far = hypot(t[0], t[1]);
        c->constraint[c->q.n++] = (sunder_i_constraint){
            .i = SUNDER_I_GROUND, .j = place[k], .n = {-t[0] / far, -t[1] / far}, .d = -0.999 * far};
    }
}

static void demand_both(solved_crowd *c, uint32_t of)
{
    for (int k = 0; k < 2; k++)
        c->constraint[c->q.n++] = (sunder_i_constraint){.i = SUNDER_I_GROUND, .j = of, .n = {k ? -1 : 1, 0}, .d = 10};
}

/* After a repair near a few further constraints, the solution satisfies all constraints, and costs at most the allowed
 * amount more than the exact solution. If that amount is zero, or constraints contradict each other, nothing is
 * changed. */
static void check_mended(void **state)
{
    (void)state;
    static solved_crowd c, before;
    size_t mended = 0, left = 0;
    for (size_t trial = 0; trial < test_count(20); trial++) {
        rng r = rng_start(test_seed(), trial);
        solve_crowd(&r, &c);
        const uint32_t first = (uint32_t)rng_int(&r, 0, CROWD - SIDE - 2);
        const bool contradicts = trial % 4 == 2;
        const double cost = cost_of(&c.q), more = trial % 4 == 3 ? 0 : 1e-3;
        if (contradicts)
            demand_both(&c, trial % 8 == 2 ? LONE : first);
        else
            demand_less(&c, first);
        before = c;
        const double v = sunder_i_quadratic_mend(&c.q, 1e-9, 0.02, more), now = cost_of(&c.q);
        if (v == INFINITY) {
            assert_memory_equal(before.constraint, c.constraint, c.q.n * sizeof *c.constraint);
            assert_memory_equal(before.t, c.t, sizeof c.t);
            left++;
            continue;
        }
        assert_true(v >= 0 && v <= 1e-9 && !contradicts && now <= cost * (1 + more));
        for (size_t k = 0; k < c.q.n; k++)
            assert_true(c.constraint[k].d - sunder_i_stretch(&c.constraint[k], c.t) <= 1e-9);
        assert_true(sunder_i_quadratic_solve(&c.q, 0, 1e-9, 0.02) <= 1e-9);
        const double all = cost_of(&c.q);
        if (!(all <= now * (1 + 1e-6) && now <= all * (1 + more)))
            fail_msg("trial %zu: %g mended, %g solved", trial, now, all);
        mended++;
    }
    printf("%zu mended, %zu not\n", mended, left);
    assert_true(mended > 0 && left > 0);
}

/* If a solution below the bound on the cost exists, the bound changes nothing. If there is no solution, the program
 * usually ends with a proof that any solution would cost more. */
static void check_dear(void **state)
{
    (void)state;
    size_t found = 0, dear = 0;
    for (size_t trial = 0; trial < test_count(4000); trial++) {
        rng r = rng_start(test_seed(), trial);
        program p, q;
        double cost = 0;
        draw(&r, &p);
        const bool solved = sunder_i_quadratic_solve(&p.q, 0, 1e-9, 1000) <= 1e-9;
        for (size_t b = 0; b < BODIES; b++)
            if (p.mass[b] > 0) cost += (p.t[2 * b] * p.t[2 * b] + p.t[2 * b + 1] * p.t[2 * b + 1]) / (2 * p.mass[b]);
        r = rng_start(test_seed(), trial);
        draw(&r, &q);
        q.q.most_cost = 1.01 * cost;
        const double v = sunder_i_quadratic_solve(&q.q, 0, 1e-9, 1000);
        if (solved && memcmp(p.t, q.t, sizeof p.t)) fail_msg("trial %zu: the solution differs", trial);
        if (!solved && v <= 1e-9) fail_msg("trial %zu: a violation of %g although there is no solution", trial, v);
        found += solved;
        dear += v == INFINITY;
    }
    printf("%zu found, %zu too expensive\n", found, dear);
    assert_true(found > 0 && dear > 0);
}

/* A row of bodies that have to be farther apart, some of which are pushed out of it, with springs across it. */
enum { ROW = 700 };

static size_t bend_row(rng *r, size_t bodies, sunder_i_constraint *c)
{
    size_t n = 0;
    for (uint32_t b = 0; b < bodies; b++) {
        if (rng_int(r, 0, 4) == 0)
            c[n++] = (sunder_i_constraint){.i = SUNDER_I_GROUND, .j = b, .n = {0.6, 0.8}, .d = 5 * rng_unit(r)};
        if (b + 1 == bodies) continue;
        c[n++] = (sunder_i_constraint){.i = b, .j = b + 1, .n = {1, 0}, .d = 2 * rng_unit(r) - 1};
        const double give = pow(10, 2 * rng_unit(r) - 1);
        for (int sign = -1; sign <= 1; sign += 2)
            c[n++] = (sunder_i_constraint){.i = b, .j = b + 1, .n = {0, sign}, .give = give};
    }
    for (size_t k = 0; k < n; k++) c[k].key = k;
    return n;
}

/* A program with soft constraints: the forces prove that no moves cost less than those found (weak duality). With few
 * and with many bodies, with and without a limit of the cost, so that each method is used. */
static void check_springs(void **state)
{
    (void)state;
    static sunder_i_constraint constraint[4 * ROW];
    static double mass[ROW], t[2 * ROW], net[2 * ROW];
    for (size_t trial = 0; trial < test_count(40); trial++) {
        static const size_t sizes[] = {2, 5, 12, 60, 200, ROW};
        rng r = rng_start(test_seed(), trial);
        const size_t bodies = sizes[trial % 6];
        sunder_i_quadratic q = {.bodies = bodies, .mass = mass, .t = t, .constraint = constraint};
        for (size_t b = 0; b < bodies; b++) mass[b] = 0.5 / (0.5 + rng_unit(&r));
        q.n = bend_row(&r, bodies, constraint);
        q.most_cost = trial % 2 ? 1e9 : 0;
        assert_true(sunder_i_quadratic_solve(&q, 0, 1e-9, 10) <= 1e-6);
        memset(net, 0, sizeof net);
        size_t stretched = 0;
        double cost = 0, least = 0;
        for (size_t k = 0; k < q.n; k++) {
            const sunder_i_constraint *c = &constraint[k];
            const double missing = fmax(0, c->d - sunder_i_stretch(c, t));
            if (c->give == 0 && missing > 1e-6)
                fail_msg("trial %zu: constraint %zu is violated by %g", trial, k, missing);
            if (c->give > 0) cost += missing * missing / (2 * c->give);
            least += c->force * (c->d - c->give * c->force / 2);
            stretched += c->give > 0 && c->force > 1e-5;
            for (size_t x = 0; x < 2; x++) {
                if (c->j != SUNDER_I_GROUND) net[2 * c->j + x] += mass[c->j] * c->force * c->n[x];
                if (c->i != SUNDER_I_GROUND) net[2 * c->i + x] -= mass[c->i] * c->force * c->n[x];
            }
        }
        for (size_t k = 0; k < 2 * bodies; k++) {
            cost += t[k] * t[k] / (2 * mass[k / 2]);
            least -= net[k] * net[k] / (2 * mass[k / 2]);
        }
        if (!(cost - least <= 1e-5 * cost)) fail_msg("trial %zu: cost %g, at least %g", trial, cost, least);
        if (bodies > 12) assert_true(stretched > 0);
    }
}

/* Programs some of whose constraints have a price. Conditions of optimality, which prove it as the cost is convex: the
 * forces equal the moves times the masses; a violated constraint pushes with its price and what its violation adds; one
 * that holds pushes with no more than its price, and only if it is just kept. */
static void check_prices(void **state)
{
    (void)state;
    size_t solved = 0, violated = 0, spare = 0;
    for (size_t trial = 0; trial < test_count(2000); trial++) {
        rng r = rng_start(test_seed(), trial);
        program p;
        double net[2 * BODIES];
        memset(&p, 0, sizeof p);
        p.q = (sunder_i_quadratic){.bodies = BODIES, .mass = p.mass, .t = p.t, .constraint = p.constraint};
        for (size_t k = 0; k < BODIES; k++) p.mass[k] = 0.5 / (0.2 + 3 * rng_unit(&r));
        const int n = (int)rng_int(&r, 1, MOST / 2);
        for (int k = 0; k < n; k++) {
            const uint32_t i = rng_once_in(&r, 3) ? SUNDER_I_GROUND : (uint32_t)rng_int(&r, 0, BODIES - 1);
            const double angle = 6.3 * rng_unit(&r), u[2] = {cos(angle), sin(angle)}, d = 10 * rng_unit(&r);
            const uint32_t j = (uint32_t)rng_int(&r, 0, BODIES - 1);
            demand(&p, i, j, u, d);
            if (k % 2 == 0) demand(&p, i, j, (double[2]){-u[0], -u[1]}, -d - 0.1 * rng_unit(&r)); /* little room */
        }
        for (size_t k = 0; k < p.q.n; k++) {
            p.constraint[k].give = 0.5 / (0.5 + 60 * rng_unit(&r));
            p.constraint[k].price = rng_once_in(&r, 4) ? 0 : 60 * rng_unit(&r);
        }
        assert_true(sunder_i_quadratic_solve(&p.q, 0, 1e-10, 10) <= 1e-8);
        sum_forces(&p, net);
        for (size_t k = 0; k < 2 * BODIES; k++)
            if (fabs(p.mass[k / 2] * net[k] - p.t[k]) > 1e-7) fail_msg("trial %zu: moved by %g", trial, p.t[k]);
        for (size_t k = 0; k < p.q.n; k++) {
            const sunder_i_constraint *c = &p.constraint[k];
            const double lacks = c->d - sunder_i_stretch(c, p.t), most = c->price + fmax(0, lacks) / c->give;
            if (!(c->force <= most + 1e-5) || (c->force < most - 1e-5 && lacks > 1e-7) ||
                (c->force > 1e-5 && lacks < -1e-7))
                fail_msg("trial %zu: lacks %g, pushes with %g of %g", trial, lacks, c->force, most);
            violated += lacks > 1e-5;
            solved += fabs(lacks) < 1e-7 && c->price > 0;
            spare += lacks < -1e-5;
        }
    }
    printf("%zu violated, %zu just kept, %zu kept with room\n", violated, solved, spare);
    assert_true(violated > 0 && solved > 0 && spare > 0);
}

/* Distances up to the greatest double, and light and heavy bodies: the forces overflow, and no multiplier is negative.
 * The active set is left as it is. */
static void check_forces_beyond_doubles(void **state)
{
    (void)state;
    for (size_t trial = 0; trial < test_count(200); trial++) {
        rng r = rng_start(test_seed(), trial);
        program p;
        draw(&r, &p);
        for (size_t k = 0; k < BODIES; k++) p.mass[k] = pow(10, -20 * rng_unit(&r));
        for (size_t k = 0; k < p.q.n; k++) {
            p.constraint[k].d = pow(10, 300 + 8 * rng_unit(&r));
            p.constraint[k].force = 1;
        }
        assert_true(sunder_i_quadratic_equations(&p.q, 0, 1e-9));
        for (size_t k = 0; k < p.q.n; k++)
            if (isnan(p.constraint[k].force)) fail_msg("trial %zu: a force is not a number", trial);
    }
}

int main(void)
{
    printf("seed %llu\n", (unsigned long long)test_seed());
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_programs), cmocka_unit_test(check_nearest),
                                       cmocka_unit_test(check_crowd),    cmocka_unit_test(check_mended),
                                       cmocka_unit_test(check_dear),     cmocka_unit_test(check_forces_beyond_doubles),
                                       cmocka_unit_test(check_springs),  cmocka_unit_test(check_prices)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
