/* number/watch: on hard inputs every function polls often enough whether it may continue, and returns soon after it was
 * told to stop.
 *
 * The library is compiled a second time for this program, so that every basic block counts a step (gcc's and clang's
 * -fsanitize-coverage=trace-pc). This measure is independent of the steps that the library counts itself, and it is the
 * same on every machine. Some hundred million steps take a second. */
#include "hard.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    MOST = 30000000,      /* largest number of steps between two polls, or from the answer "stop" to the return */
    ENOUGH = 40 * 1000000 /* after this many steps a call is told to stop */
};

static uint64_t steps, last, longest;
static uint64_t looks, stop_at;
static bool told;

void __sanitizer_cov_trace_pc(void);

static void note_pause(void)
{
    if (steps - last > longest) longest = steps - last;
    last = steps;
}

static bool go_on(void *user)
{
    (void)user;
    note_pause();
    told = told || ++looks == stop_at || steps > ENOUGH;
    return !told;
}

void __sanitizer_cov_trace_pc(void) { steps++; }

/* ---- The calls with a pair of operands ------- */

typedef struct operands {
    polyset p, q;
    sunder_shape *shape[2];
} operands;

static sunder_status shape_of(const polyset *set, sunder_shape **out)
{
    return sunder_shape_from_rings(set->xy, set->ring_end, set->poly_end, set->polygons, SUNDER_VALIDITY_EVEN_ODD, out,
                                   NULL);
}

static sunder_status make(operands *o, int how)
{
    (void)how;
    sunder_shape *s;
    sunder_status status = shape_of(&o->p, &s);
    if (status == SUNDER_OK) sunder_shape_free(s);
    return status;
}

static sunder_status copy(operands *o, int how)
{
    (void)how;
    sunder_shape *s;
    bool exact;
    sunder_status status = sunder_shape_reflect(o->shape[0], &s, NULL);
    if (status == SUNDER_OK) sunder_shape_free(s);
    if (status == SUNDER_OK) status = sunder_shape_translate(o->shape[0], 0.1, 0.3, &s, &exact, NULL);
    if (status == SUNDER_OK) sunder_shape_free(s);
    return status;
}

static sunder_status read_sum(sunder_sum *sum)
{
    char *text = NULL, *x, *y;
    sunder_sum_size size;
    sunder_sum_get_size(sum, &size);
    sunder_status status = sunder_sum_area_text(sum, &text, NULL);
    if (status == SUNDER_OK) sunder_free(text);
    for (size_t p = 0; p < size.polygons && status == SUNDER_OK; p++) {
        size_t n;
        double deviation = 0;
        const uint32_t *ring = sunder_sum_ring(sum, p, 0, &n);
        double *xy = test_alloc(2 * n, sizeof *xy);
        status = sunder_sum_vertices(sum, ring, n, xy, &deviation, NULL);
        free(xy);
        if (status == SUNDER_OK) status = sunder_sum_vertex_text(sum, ring[0], &x, &y, NULL);
        if (status == SUNDER_OK) {
            sunder_free(x);
            sunder_free(y);
        }
    }
    sunder_sum_free(sum);
    return status;
}

static sunder_status add(operands *o, int how)
{
    const sunder_sum_options options = {.size = sizeof options,
                                        .algorithm = (sunder_algorithm)(how % 10),
                                        .decomposition = (sunder_decomposition)(how / 10),
                                        .keep_map = how % 10 == SUNDER_ALGORITHM_ARRANGEMENT};
    sunder_sum *sum;
    const sunder_status status = sunder_minkowski_sum(o->shape[0], o->shape[1], &options, &sum, NULL);
    return status == SUNDER_OK ? read_sum(sum) : status;
}

static sunder_status grow(operands *o, int how)
{
    static const sunder_sum_options options = {.size = sizeof options, .threads = 1};
    sunder_shape *disc = NULL;
    sunder_sum *sum;
    sunder_status status = sunder_shape_disc(3, 16, false, &disc, NULL);
    if (status == SUNDER_OK) status = sunder_morphology(o->shape[0], disc, (sunder_operation)how, &options, &sum, NULL);
    sunder_shape_free(disc);
    return status == SUNDER_OK ? read_sum(sum) : status;
}

static sunder_status unite(operands *o, int how)
{
    (void)how;
    sunder_sum *sum;
    const sunder_status status = sunder_shape_union(o->shape[0], NULL, &sum, NULL);
    return status == SUNDER_OK ? read_sum(sum) : status;
}

static sunder_status part(operands *o, int how)
{
    sunder_separation s;
    const sunder_status status = sunder_pair_separate(o->shape[0], o->shape[1], how, &s, NULL);
    if (status == SUNDER_OK) sunder_separation_clear(&s);
    return status;
}

static sunder_status relate(operands *o, int how)
{
    bool yes;
    double d, a[2], b[2];
    if (how == 0) return sunder_pair_overlap(o->shape[0], o->shape[1], &yes, NULL);
    if (how == 1) return sunder_pair_apart(o->shape[0], o->shape[1], 5, &yes, NULL);
    return sunder_pair_distance(o->shape[0], o->shape[1], &d, a, b, NULL);
}

/* P and Q as features of a layer. */
static sunder_status layer(operands *o, int how)
{
    sunder_layer_options options;
    sunder_layer_options_init(&options);
    options.gap = how / 2;
    options.threads = 1;
    sunder_feature feature[2] = {
        {.shape = o->shape[0], .weight = 1, .max_shift = how % 4 < 2 ? INFINITY : 4, .block = -1},
        {.shape = o->shape[1], .weight = 1, .max_shift = INFINITY, .block = -1}};
    sunder_layer *l = NULL;
    sunder_report *report;
    sunder_status status = sunder_layer_new(feature, 2, &l, NULL);
    if (status == SUNDER_OK)
        status = how % 2 ? sunder_layer_separate(l, &options, &report, NULL)
                         : sunder_layer_check(l, &options, &report, NULL);
    if (status == SUNDER_OK) sunder_report_free(report);
    sunder_layer_free(l);
    return status;
}

static sunder_status route(operands *o, int how)
{
    const sunder_obstacle obstacle = {.shape = o->shape[0]};
    const sunder_route_options options = {.size = sizeof options, .gap = how};
    sunder_shape *robot = NULL;
    sunder_route *r;
    double box[4];
    sunder_shape_box(o->shape[0], box);
    const sunder_place from = {{box[0] - 20, box[1] - 20}, {NULL, NULL}},
                       to = {{box[2] + 20, box[3] + 20}, {NULL, NULL}};
    sunder_status status = sunder_shape_disc(1, 8, false, &robot, NULL);
    if (status == SUNDER_OK) status = sunder_route_find(&obstacle, 1, robot, &from, &to, &options, &r, NULL);
    if (status == SUNDER_OK) sunder_route_free(r);
    sunder_shape_free(robot);
    return status;
}

typedef struct work {
    const char *name;
    sunder_status (*run)(operands *o, int how);
    int how;
} work;

static const work works[] = {
    {"from_rings", make, 0},
    {"reflect, translate", copy, 0},
    {"sum, convolution", add, SUNDER_ALGORITHM_CONVOLUTION},
    {"sum, arrangement", add, SUNDER_ALGORITHM_ARRANGEMENT},
    {"sum, incremental", add, SUNDER_ALGORITHM_INCREMENTAL},
    {"sum, divide", add, SUNDER_ALGORITHM_DIVIDE},
    {"sum, vertical pieces", add, 10 * SUNDER_DECOMPOSITION_VERTICAL + SUNDER_ALGORITHM_DIVIDE},
    {"sum, triangles", add, 10 * SUNDER_DECOMPOSITION_TRIANGULATION + SUNDER_ALGORITHM_DIVIDE},
    {"sum, optimal pieces", add, 10 * SUNDER_DECOMPOSITION_OPTIMAL + SUNDER_ALGORITHM_DIVIDE},
    {"sum, mixed pieces", add, 10 * SUNDER_DECOMPOSITION_MIXED + SUNDER_ALGORITHM_DIVIDE},
    {"erode", grow, SUNDER_OPERATION_ERODE},
    {"open", grow, SUNDER_OPERATION_OPEN},
    {"close", grow, SUNDER_OPERATION_CLOSE},
    {"union", unite, 0},
    {"pair", part, 0},
    {"pair, gap 3", part, 3},
    {"overlap", relate, 0},
    {"apart", relate, 1},
    {"distance", relate, 2},
    {"check", layer, 0},
    {"check, gap 3", layer, 6},
    {"separate", layer, 1},
    {"separate, gap 3", layer, 7},
    {"route", route, 0},
    {"route, gap", route, 1}};

/* One call, told to stop at poll number `at` (0: only after ENOUGH steps). */
static sunder_status watched(const work *w, operands *o, uint64_t at)
{
    steps = last = longest = looks = 0;
    stop_at = at;
    told = false;
    sunder_watch(go_on, NULL);
    const sunder_status status = w->run(o, w->how);
    note_pause();
    sunder_watch(NULL, NULL);
    return status;
}

/* Tests the longest pause of all calls with these operands; if there are too many calls, of every `stride`-th. */
static void try_all(const char *name, operands *o, rng *r, size_t stride)
{
    uint64_t worst = 0;
    const char *where = "";
    sunder_watch(NULL, NULL);
    steps = last = 0;
    if (shape_of(&o->p, &o->shape[0]) || shape_of(&o->q, &o->shape[1])) fail_msg("%s: cannot make the shapes", name);
    for (size_t i = (size_t)rng_int(r, 0, (int64_t)stride - 1); i < sizeof works / sizeof *works; i += stride) {
        sunder_status status = watched(&works[i], o, 0);
        uint64_t whole = longest;
        const uint64_t all = looks;
        if (status != SUNDER_OK && !(told && status == SUNDER_ECANCEL))
            fail_msg("%s, %s: %s", name, works[i].name, sunder_status_string(status));
        if (all > 1) {
            status = watched(&works[i], o, (uint64_t)rng_int(r, 1, (int64_t)all));
            if (status != SUNDER_ECANCEL && status != SUNDER_OK)
                fail_msg("%s, %s, stopped: %s", name, works[i].name, sunder_status_string(status));
            if (longest > whole) whole = longest;
        }
        if (whole > worst) worst = whole, where = works[i].name;
        if (whole > MOST)
            print_message("%s, %s: %.1f million steps without a poll\n", name, works[i].name, 1e-6 * (double)whole);
    }
    print_message("%-16s longest pause %8.3f million steps, in %s\n", name, 1e-6 * (double)worst, where);
    sunder_shape_free(o->shape[0]);
    sunder_shape_free(o->shape[1]);
    assert_true(worst <= MOST);
}

static void test_generated(void **state)
{
    (void)state;
    static const int size[HARD_KINDS] = {3000, 3000, 120, 48, 30, 300, 200, 120, 3000, 3000};
    rng r = rng_start(test_seed(), 81);
    for (int kind = 0; kind < HARD_KINDS; kind++) {
        operands o;
        polyset_init(&o.p);
        polyset_init(&o.q);
        random_hard(&o.p, &o.q, &r, (hard_kind)kind, size[kind]);
        try_all(hard_kind_string((hard_kind)kind), &o, &r, test_count(2) > 2 ? 1 : 2);
        polyset_free(&o.p);
        polyset_free(&o.q);
    }
}

/* Inputs that were slow in earlier versions, one line each for P and Q, if the files exist. */
static void test_files(void **state)
{
    (void)state;
    const char *source = getenv("SUNDER_SOURCE");
    char *folder = test_format("%s/../shared/hard", source ? source : SUNDER_SOURCE);
    DIR *d = opendir(folder);
    rng r = rng_start(test_seed(), 82);
    size_t n = 0;
    for (struct dirent *f; d && (f = readdir(d));) {
        if (!strstr(f->d_name, ".wkt")) continue;
        char *path = test_format("%s/%s", folder, f->d_name), *text = test_read_file(path);
        operands o;
        const char *end;
        polyset_init(&o.p);
        polyset_init(&o.q);
        if (text && polyset_read_wkt(&o.p, text, &end) && polyset_read_wkt(&o.q, end, NULL)) {
            try_all(f->d_name, &o, &r, test_count(12) > 12 ? 1 : 12);
            n++;
        }
        polyset_free(&o.p);
        polyset_free(&o.q);
        free(text);
        free(path);
    }
    if (d) closedir(d);
    free(folder);
    if (n == 0) {
        print_message("there are no files of hard inputs\n");
        skip();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_generated), cmocka_unit_test(test_files)};
    return cmocka_run_group_tests_name("watch", tests, NULL, NULL);
}
