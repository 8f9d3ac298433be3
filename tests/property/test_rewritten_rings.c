/* Operands whose rings are written in another way give the same sums, pairs, buffers and routes. A random set, valid or
 * not, is written a second time: rings reversed, starting at another vertex, closed twice, with repeated vertices and
 * vertices on straight edges; members and holes in another order. All results must be equal to the last character: the
 * cleaned rings, exact texts, doubles, the order of ties, and the number of operations. (The number is not compared for
 * repaired sets: their lattice contains all given vertices, so a vertex in the middle of an edge makes it finer.) */
#include "generate.h"
#include "roads.h"
#include "sum_text.h"

#include <inttypes.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SETS = PAIR_KINDS + INVALID_KINDS, CASES = 8 * SETS, ROUTES = 4 };

/* The results of a case as text. */
typedef struct answers {
    FILE *out;
    char *text;
    size_t size;
} answers;

static sunder_shape *shape_of(const polyset *set)
{
    sunder_shape *s = NULL;
    sunder_error err;
    if (sunder_shape_from_rings(set->xy, set->ring_end, set->poly_end, set->polygons, SUNDER_VALIDITY_EVEN_ODD, &s,
                                &err))
        fail_msg("SUNDER_SEED=%" PRIu64 ": %s", test_seed(), err.message);
    return s;
}

static void tell_shape(FILE *out, const sunder_shape *s)
{
    double box[4], anchor[2];
    sunder_shape_box(s, box);
    sunder_shape_anchor(s, anchor);
    fprintf(out, "repaired %d touches %d area %.17g box %.17g %.17g %.17g %.17g anchor %.17g %.17g\n",
            sunder_shape_repaired(s), sunder_shape_touches(s), sunder_shape_area(s), box[0], box[1], box[2], box[3],
            anchor[0], anchor[1]);
    for (size_t p = 0; p < sunder_shape_polygons(s); p++)
        for (size_t r = 0; r < sunder_shape_rings(s, p); r++) {
            size_t n;
            const double *xy = sunder_shape_ring(s, p, r, &n);
            fprintf(out, "ring %zu %zu", p, r);
            for (size_t i = 0; i < 2 * n; i++) fprintf(out, " %.17g", xy[i]);
            fputc('\n', out);
        }
}

static void tell_counts(FILE *out, const sunder_counts *n, bool repaired)
{
    if (!repaired)
        fprintf(out, "%" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIu64 "\n", n->comparisons, n->orientation_tests,
                n->segment_intersections, n->exact_fallbacks);
}

static void tell_sum(FILE *out, sunder_sum *sum, sunder_status status, bool repaired)
{
    if (status) {
        fprintf(out, "%s\n", sunder_status_string(status));
        return;
    }
    sunder_counts n;
    char *text = sum_text(sum);
    sunder_sum_get_counts(sum, &n);
    tell_counts(out, &n, repaired);
    fprintf(out, "%s\n", text);
    free(text);
    sunder_sum_free(sum);
}

static void tell_sums(FILE *out, const sunder_shape *p, const sunder_shape *q, uint64_t i)
{
    const sunder_sum_options road = road_options(i, i);
    const bool repaired = sunder_shape_repaired(p) || sunder_shape_repaired(q);
    sunder_sum *sum = NULL;
    sunder_status status = sunder_minkowski_sum(p, q, NULL, &sum, NULL);
    tell_sum(out, sum, status, repaired);
    status = sunder_minkowski_sum(p, q, &road, &sum, NULL);
    tell_sum(out, sum, status, repaired);
    for (int k = SUNDER_OPERATION_DILATE; k <= SUNDER_OPERATION_CLOSE; k++) {
        status = sunder_morphology(p, q, (sunder_operation)k, NULL, &sum, NULL);
        tell_sum(out, sum, status, repaired);
    }
}

static void tell_pair(FILE *out, const sunder_shape *p, const sunder_shape *q, double gap)
{
    sunder_separation s;
    double distance, on_p[2], on_q[2];
    sunder_status status = sunder_pair_separate(p, q, gap, &s, NULL);
    fprintf(out, "pair %g: %s\n", gap, sunder_status_string(status));
    if (status) return;
    fprintf(out, "%d %d %d %s %.17g %.17g %.17g %.17g %s %s %s\n", s.overlap, s.attained, s.rounded_is_free,
            sunder_contact_string(s.contact), s.dx, s.dy, s.distance, s.lower_bound, s.dx_text, s.dy_text,
            s.distance_squared_text);
    tell_counts(out, &s.counts, sunder_shape_repaired(p) || sunder_shape_repaired(q));
    sunder_separation_clear(&s);
    status = sunder_pair_distance(p, q, &distance, on_p, on_q, NULL);
    fprintf(out, "%s %.17g %.17g %.17g %.17g %.17g\n", sunder_status_string(status), distance, on_p[0], on_p[1],
            on_q[0], on_q[1]);
}

/* A route around P, between opposite corners of a box around it that leaves room for the robot. */
static void tell_route(FILE *out, const sunder_shape *p, const sunder_shape *robot)
{
    double a[4], b[4];
    sunder_shape_box(p, a);
    sunder_shape_box(robot, b);
    const sunder_obstacle obstacle = {.shape = p};
    const sunder_place from = {{a[0] - b[2] - 1, a[1] - b[3] - 1}, {NULL, NULL}},
                       to = {{a[2] - b[0] + 1, a[3] - b[1] + 1}, {NULL, NULL}};
    sunder_route *route = NULL;
    const sunder_status status = sunder_route_find(&obstacle, 1, robot, &from, &to, NULL, &route, NULL);
    fprintf(out, "route: %s\n", sunder_status_string(status));
    if (status) return;
    size_t blamed;
    fprintf(out, "%s %.17g %d\n", sunder_route_status_string(sunder_route_reason(route, &blamed)),
            sunder_route_length(route), sunder_route_rounded_is_free(route));
    for (size_t k = 0; k < sunder_route_vertices(route); k++) {
        const char *x, *y;
        sunder_route_vertex_text(route, k, &x, &y);
        fprintf(out, "%s %s\n", x, y);
    }
    sunder_route_free(route);
}

static char *tell(const polyset *p, const polyset *q, uint64_t i)
{
    answers a = {NULL, NULL, 0};
    sunder_shape *s = shape_of(p), *t = shape_of(q);
    a.out = open_memstream(&a.text, &a.size);
    assert_non_null(a.out);
    tell_shape(a.out, s);
    tell_shape(a.out, t);
    if (!sunder_shape_is_empty(s) && !sunder_shape_is_empty(t)) {
        tell_sums(a.out, s, t, i);
        tell_pair(a.out, s, t, 0);
        tell_pair(a.out, s, t, 0.75);
        if (i % ROUTES == 0) tell_route(a.out, s, t);
    }
    fclose(a.out);
    sunder_shape_free(s);
    sunder_shape_free(t);
    return a.text;
}

static const char *draw(polyset *p, polyset *q, rng *r, size_t kind)
{
    if (kind < PAIR_KINDS) {
        random_pair(p, q, r, (pair_kind)kind);
        return pair_kind_string((pair_kind)kind);
    }
    random_invalid(p, r, (invalid_kind)(kind - PAIR_KINDS), 16);
    random_invalid(q, r, (invalid_kind)rng_int(r, 0, INVALID_KINDS - 1), 10);
    return invalid_kind_string((invalid_kind)(kind - PAIR_KINDS));
}

static void show_difference(const char *kind, uint64_t i, const char *a, const char *b, const polyset *p,
                            const polyset *q)
{
    while (*a && *a == *b) a++, b++;
    char *first = polyset_wkt(p), *second = polyset_wkt(q);
    fail_msg("SUNDER_SEED=%" PRIu64 ", case %" PRIu64 " (%s): '%.60s' is not '%.60s'\n%s\n%s", test_seed(), i, kind, a,
             b, first, second);
}

static void test_the_same_answers(void **state)
{
    (void)state;
    const uint64_t n = test_count(CASES);
    for (uint64_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed(), i);
        polyset p, q;
        const char *kind = draw(&p, &q, &r, i % SETS);
        char *given = tell(&p, &q, i / SETS);
        random_dress(&p, &r);
        random_dress(&q, &r);
        char *anew = tell(&p, &q, i / SETS);
        if (strcmp(given, anew)) show_difference(kind, i, given, anew, &p, &q);
        free(given);
        free(anew);
        polyset_free(&p);
        polyset_free(&q);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_the_same_answers)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
