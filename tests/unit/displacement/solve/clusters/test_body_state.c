/* The states of a body: each aspect behaves like the independent facts that its states combine, impossible events are
 * refused, and the checker finds a solver whose states contradict its bodies. */
#include "displacement/solve/clusters/solver.h"

#include "random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { BODIES = 3, EVENTS_DRAWN = 20000 };

/* The same states, as independent facts. */
typedef struct facts {
    bool due, improved, cheapest; /* the search */
    bool wanted, doubtful, asked; /* the pass, and questions */
    bool to_retry, lifted, aside;
    bool held, coarse, let_go;
    bool no_slack, shaken, diagonals;
} facts;

/* Can the event happen? */
static bool facts_may(const facts *f, sunder_i_body_event_kind event)
{
    switch (event) {
    case SUNDER_I_IS_IMPROVED:
    case SUNDER_I_GOES_HOME: return !f->due;
    case SUNDER_I_LIMIT_IS_LIFTED: return !f->lifted;
    case SUNDER_I_IS_SET_ASIDE:
    case SUNDER_I_LIMIT_IS_RESTORED: return f->lifted;
    case SUNDER_I_IS_HELD: return !f->held && !f->let_go;
    case SUNDER_I_IS_HELD_AS_COARSE: return f->held;
    case SUNDER_I_IS_LET_GO:
    case SUNDER_I_IS_HELD_AGAIN: return f->held || f->let_go;
    default: return true;
    }
}

static void facts_of_search(facts *f, sunder_i_body_event_kind event)
{
    if (event == SUNDER_I_MEETS_CONFLICT) f->due = true;
    if (event == SUNDER_I_MEETS_CONFLICT || event == SUNDER_I_IS_SOLVED || event == SUNDER_I_IS_SOLVED_CHEAPEST) {
        f->improved = false;
        f->cheapest = event == SUNDER_I_IS_SOLVED_CHEAPEST;
    }
    if (event == SUNDER_I_IS_SOLVED || event == SUNDER_I_IS_SOLVED_CHEAPEST) f->due = false;
    if (event == SUNDER_I_MOVES) f->cheapest = false;
    if (event == SUNDER_I_IS_IMPROVED) f->improved = true;
    if (event == SUNDER_I_GOES_HOME) f->improved = false;
}

static void facts_of_pass(facts *f, sunder_i_body_event_kind event)
{
    if (event == SUNDER_I_IS_WANTED || event == SUNDER_I_BEGINS_AGAIN_FREED || event == SUNDER_I_BEGINS_AGAIN_LIMITED)
        f->wanted = true;
    if (event == SUNDER_I_IS_LEFT) f->wanted = false;
    if (event == SUNDER_I_IS_DOUBTED || event == SUNDER_I_BEGINS_AGAIN_LIMITED) f->doubtful = true;
    if (event == SUNDER_I_IS_CERTAIN) f->doubtful = false;
    if (event == SUNDER_I_IS_ASKED_IN_VAIN) f->asked = true;
    if (event == SUNDER_I_IS_DOUBTED || event == SUNDER_I_BEGINS_AGAIN_FREED) f->asked = false;
    if (event == SUNDER_I_GIVES_UP) f->to_retry = true;
    if (event == SUNDER_I_IS_RETRIED) f->to_retry = false;
}

static void facts_of_rest(facts *f, sunder_i_body_event_kind event)
{
    if (event == SUNDER_I_LIMIT_IS_LIFTED) f->lifted = true;
    if (event == SUNDER_I_LIMIT_IS_RESTORED) f->lifted = f->aside = false;
    if (event == SUNDER_I_IS_SET_ASIDE) f->aside = true;
    if (event == SUNDER_I_IS_HELD) f->held = true;
    if (event == SUNDER_I_IS_HELD_AS_COARSE) f->coarse = true;
    if (event == SUNDER_I_IS_LET_GO) {
        f->held = f->coarse = false;
        f->let_go = true;
    }
    if (event == SUNDER_I_IS_HELD_AGAIN) {
        f->held = true;
        f->let_go = false;
    }
    if (event == SUNDER_I_LACKS_SLACK) f->no_slack = true;
    if (event == SUNDER_I_IS_SHAKEN) f->shaken = true;
    if (event == SUNDER_I_JUMPS_IN_PROOF) f->diagonals = true;
}

static void expect_states(const sunder_i_solver *s, uint32_t b, const facts *f)
{
    assert_int_equal(sunder_i_is_due(s, b), f->due);
    assert_int_equal(sunder_i_is_improved(s, b), f->improved);
    assert_int_equal(sunder_i_is_cheapest(s, b), f->cheapest);
    assert_int_equal(sunder_i_is_wanted(s, b), f->wanted);
    assert_int_equal(sunder_i_is_doubtful(s, b), f->doubtful);
    assert_int_equal(sunder_i_is_in(s, SUNDER_I_QUESTION, b, SUNDER_I_DOUBTFUL_ASKED) ||
                         sunder_i_is_in(s, SUNDER_I_QUESTION, b, SUNDER_I_CERTAIN_ASKED),
                     f->asked);
    assert_int_equal(sunder_i_is_to_retry(s, b), f->to_retry);
    assert_int_equal(sunder_i_is_in(s, SUNDER_I_LIMITS, b, SUNDER_I_IN_FORCE), !f->lifted);
    assert_int_equal(sunder_i_is_aside(s, b), f->aside);
    assert_int_equal(sunder_i_is_in(s, SUNDER_I_HOLDING, b, SUNDER_I_HELD), f->held && !f->coarse);
    assert_int_equal(sunder_i_is_in(s, SUNDER_I_HOLDING, b, SUNDER_I_HELD_AS_COARSE), f->held && f->coarse);
    assert_int_equal(sunder_i_is_in(s, SUNDER_I_HOLDING, b, SUNDER_I_LET_GO), f->let_go);
    assert_int_equal(sunder_i_is_in(s, SUNDER_I_SLACK, b, SUNDER_I_WITH_SLACK), f->no_slack);
    assert_int_equal(sunder_i_is_in(s, SUNDER_I_SHAKING, b, SUNDER_I_SHAKEN), f->shaken);
    assert_int_equal(sunder_i_is_in(s, SUNDER_I_DIAGONALS, b, SUNDER_I_WITH_DIAGONALS), f->diagonals);
}

/* Random events: the states correspond to the facts, and an event is possible if the facts allow it. */
static void check_events(void **state)
{
    (void)state;
    rng r = rng_start(test_seed(), 0);
    sunder_i_solver s = {0};
    facts f[BODIES] = {{0}};
    printf("seed %llu\n", (unsigned long long)test_seed());
    assert_true(sunder_i_body_states_init(&s.states, BODIES));
    for (uint32_t b = 0; b < BODIES; b++) f[b].wanted = f[b].doubtful = true;
    size_t refused = 0;
    for (int k = 0; k < EVENTS_DRAWN; k++) {
        const uint32_t b = (uint32_t)rng_int(&r, 0, BODIES - 1);
        const sunder_i_body_event_kind event = (sunder_i_body_event_kind)rng_int(&r, 0, SUNDER_I_EVENTS - 1);
        const bool may = facts_may(&f[b], event);
        assert_int_equal(sunder_i_body_may(&s.states, b, event), may);
        refused += !may;
        if (!may) continue;
        sunder_i_body_event(&s.states, b, event);
        facts_of_search(&f[b], event);
        facts_of_pass(&f[b], event);
        facts_of_rest(&f[b], event);
        for (uint32_t other = 0; other < BODIES; other++) expect_states(&s, other, &f[other]);
    }
    assert_true(refused > 100);
    sunder_i_body_states_free(&s.states);
}

/* A solver with bodies without limits, one of them fixed. */
static void begin(sunder_i_solver *s, sunder_i_body *body)
{
    memset(s, 0, sizeof *s);
    memset(body, 0, BODIES * sizeof *body);
    for (size_t b = 0; b < BODIES; b++) body[b].limit = INFINITY;
    body[0].fixed = true;
    s->model.body = body;
    s->model.bodies = BODIES;
    assert_true(sunder_i_body_states_init(&s->states, BODIES));
    assert_null(sunder_i_solver_check_states(s));
}

/* The checker accepts valid states, and reports faults. */
static void check_checker(void **state)
{
    (void)state;
    sunder_i_solver s;
    sunder_i_body body[BODIES];
    double limit[BODIES];
    begin(&s, body);

    sunder_i_body_event(&s.states, 1, SUNDER_I_MEETS_CONFLICT);
    assert_non_null(sunder_i_solver_check_states(&s));
    sunder_i_body_event(&s.states, 1, SUNDER_I_IS_SOLVED);
    assert_null(sunder_i_solver_check_states(&s));

    sunder_i_body_event(&s.states, 2, SUNDER_I_IS_HELD);
    assert_non_null(sunder_i_solver_check_states(&s));
    body[2].held = true;
    assert_non_null(sunder_i_solver_check_states(&s)); /* the body is not fixed */
    body[2].fixed = true;
    assert_null(sunder_i_solver_check_states(&s));
    sunder_i_body_event(&s.states, 2, SUNDER_I_IS_LET_GO);
    assert_non_null(sunder_i_solver_check_states(&s));
    body[2].held = body[2].fixed = false;

    s.limit = limit;
    assert_non_null(sunder_i_solver_check_states(&s)); /* limits are lifted, but not for these bodies */
    for (uint32_t b = 0; b < BODIES; b++) sunder_i_body_event(&s.states, b, SUNDER_I_LIMIT_IS_LIFTED);
    sunder_i_body_event(&s.states, 1, SUNDER_I_IS_SET_ASIDE);
    assert_null(sunder_i_solver_check_states(&s));
    body[1].limit = 5;
    assert_non_null(sunder_i_solver_check_states(&s));
    for (uint32_t b = 0; b < BODIES; b++) sunder_i_body_event(&s.states, b, SUNDER_I_LIMIT_IS_RESTORED);
    s.limit = NULL;
    assert_null(sunder_i_solver_check_states(&s));

    s.states.of[SUNDER_I_SCOPE][1] = SUNDER_I_LEFT + 1;
    assert_non_null(sunder_i_solver_check_states(&s));
    s.states.of[SUNDER_I_SCOPE][1] = SUNDER_I_LEFT;
    s.states.n = BODIES - 1;
    assert_non_null(sunder_i_solver_check_states(&s));
    sunder_i_body_states_free(&s.states);
}

/* States are not initialised again: bodies are held before and after the solver's other arrays are made. */
static void check_second_init(void **state)
{
    (void)state;
    sunder_i_body_states states = {0};
    assert_true(sunder_i_body_states_init(&states, BODIES));
    sunder_i_body_event(&states, 1, SUNDER_I_IS_HELD);
    assert_true(sunder_i_body_states_init(&states, BODIES));
    assert_int_equal(states.of[SUNDER_I_HOLDING][1], SUNDER_I_HELD);
    sunder_i_body_states_free(&states);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_events), cmocka_unit_test(check_checker),
                                       cmocka_unit_test(check_second_init)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
