/* displacement/layer/stage_table: stages whose preconditions are true run in the order of the table, until one of them
 * ends the sequence; those that changed a figure appear in the trace. */
#include "displacement/layer/stage_table.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

typedef struct counting {
    sunder_i_stage_run run;
    char order[16]; /* a letter for each stage that ran */
    size_t n;
    double cost;
    bool failed;
} counting;

static void note(counting *x, char stage) { x->order[x->n++] = stage; }

static void lower_cost(void *state)
{
    counting *x = state;
    note(x, 'l');
    x->cost -= (double)x->run.budget;
}

static void do_nothing(void *state) { note(state, 'n'); }

static void end(void *state)
{
    counting *x = state;
    note(x, 'e');
    x->run.over = true;
}

static void run_out(void *state)
{
    counting *x = state;
    note(x, 'f');
    x->failed = true;
}

static void return_error(void *state)
{
    counting *x = state;
    note(x, 'r');
    x->run.status = SUNDER_ECANCEL;
}

static bool never(const void *state)
{
    (void)state;
    return false;
}

static bool is_cheap(const void *state) { return ((const counting *)state)->cost < 10; }

static const char *look(const void *state, const double before[2], double now[2])
{
    const counting *x = state;
    now[0] = x->cost;
    return now[0] < before[0] ? "cheaper" : "as it was";
}

static sunder_status run(counting *x, const sunder_i_stage *stage, size_t n)
{
    const sunder_i_stage_table table = {"test", stage, n, look};
    x->cost = 10;
    return sunder_i_stages_run(&table, x);
}

#define RUN(x, stages) run(x, stages, sizeof(stages) / sizeof *(stages))

static void stages_run_in_the_order_of_the_table(void **state)
{
    (void)state;
    const sunder_i_stage stages[] = {{"a", is_cheap, do_nothing, 0},
                                     {"b", NULL, lower_cost, 3},
                                     {"c", never, run_out, 0},
                                     {"d", is_cheap, do_nothing, 0}};
    counting x = {.n = 0};
    assert_int_equal(RUN(&x, stages), SUNDER_OK);
    assert_string_equal(x.order, "ln");
    assert_true(x.cost == 7);
}

static void a_stage_ends_the_sequence(void **state)
{
    (void)state;
    const sunder_i_stage ends[] = {{"a", NULL, end, 0}, {"b", NULL, do_nothing, 0}},
                         fails[] = {{"a", NULL, run_out, 0}, {"b", NULL, do_nothing, 0}},
                         errors[] = {{"a", NULL, return_error, 0}, {"b", NULL, do_nothing, 0}};
    counting over = {.n = 0}, failed = {.n = 0}, error = {.n = 0};
    failed.run.failed = &failed.failed;
    assert_int_equal(RUN(&over, ends), SUNDER_OK);
    assert_string_equal(over.order, "e");
    assert_int_equal(RUN(&failed, fails), SUNDER_OK);
    assert_string_equal(failed.order, "f");
    assert_int_equal(RUN(&error, errors), SUNDER_ECANCEL);
    assert_string_equal(error.order, "r");
}

static void the_trace_has_the_stages_that_changed_something(void **state)
{
    (void)state;
    const sunder_i_stage stages[] = {
        {"a", NULL, do_nothing, 0}, {"b", NULL, lower_cost, 4}, {"c", NULL, lower_cost, 0}, {"d", NULL, lower_cost, 1}};
    sunder_i_trace_log log = {0};
    counting x = {.run = {.log = &log}};
    assert_int_equal(RUN(&x, stages), SUNDER_OK);
    assert_int_equal(log.n, 2);
    assert_string_equal(log.step[0].table, "test");
    assert_string_equal(log.step[0].step, "b");
    assert_string_equal(log.step[0].outcome, "cheaper");
    assert_true(log.step[0].before == 10 && log.step[0].after == 6);
    assert_string_equal(log.step[1].step, "d");
    assert_true(log.step[1].before == 6 && log.step[1].after == 5);
    sunder_i_trace_log_free(&log);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(stages_run_in_the_order_of_the_table),
                                       cmocka_unit_test(a_stage_ends_the_sequence),
                                       cmocka_unit_test(the_trace_has_the_stages_that_changed_something)};
    return cmocka_run_group_tests_name("stages in the order of a table", tests, NULL, NULL);
}
