#include "roads.h"

#include "minkowski/minkowski.h"
#include "sum_text.h"

#include <stdlib.h>
#include <string.h>

sunder_sum_options road_options(size_t i, uint64_t seed)
{
    const size_t a = i % ROAD_ALGORITHMS, d = i / ROAD_ALGORITHMS % ROAD_DECOMPOSITIONS;
    const size_t o = i / (ROAD_ALGORITHMS * ROAD_DECOMPOSITIONS) % ROAD_ORDERS;
    return (sunder_sum_options){.size = sizeof(sunder_sum_options),
                                .algorithm = (sunder_algorithm)(SUNDER_ALGORITHM_ARRANGEMENT + a),
                                .decomposition = (sunder_decomposition)(SUNDER_DECOMPOSITION_ANGLE_BISECTOR + d),
                                .order = (sunder_order)(SUNDER_ORDER_RANDOM + o),
                                .seed = seed};
}

static bool same_operations(const sunder_counts *a, const sunder_counts *b)
{
    return a->comparisons == b->comparisons && a->orientation_tests == b->orientation_tests &&
           a->segment_intersections == b->segment_intersections && a->exact_fallbacks == b->exact_fallbacks;
}

/* The algorithm is the requested one, and the decomposition is the requested one or the one to which it falls back;
 * phases add up to all operations (except those of placing the operands, which counts none). */
static bool honest(const sunder_sum *sum, const sunder_sum_options *how)
{
    sunder_sum_method method;
    sunder_counts all, phase, total = {0, 0, 0, 0};
    sunder_sum_get_method(sum, &method);
    sunder_sum_get_counts(sum, &all);
    for (int i = SUNDER_PHASE_DECOMPOSE; i <= SUNDER_PHASE_UNION; i++) {
        if (!sunder_sum_phase(sum, (sunder_phase)i, &phase)) return false;
        total.comparisons += phase.comparisons;
        total.orientation_tests += phase.orientation_tests;
        total.segment_intersections += phase.segment_intersections;
        total.exact_fallbacks += phase.exact_fallbacks;
    }
    const bool may_fall =
        how->decomposition == SUNDER_DECOMPOSITION_OPTIMAL || how->decomposition == SUNDER_DECOMPOSITION_MIXED;
    const bool fell = may_fall && method.decomposition == SUNDER_DECOMPOSITION_HERTEL_MEHLHORN;
    return method.algorithm == how->algorithm && method.order == how->order &&
           (fell || method.decomposition == how->decomposition) && same_operations(&all, &total);
}

char *road_text(const sunder_shape *p, const sunder_shape *q, const sunder_sum_options *how, bool force_wide)
{
    sunder_sum *sum = NULL;
    char *text = NULL;
    if (sunder_i_minkowski_sum(p, q, force_wide, how, &sum, NULL) == SUNDER_OK && honest(sum, how))
        text = sum_text(sum);
    sunder_sum_free(sum);
    return text;
}

bool road_agrees(const polyset *p, const polyset *q, const sunder_sum_options *how, bool force_wide, const char *want,
                 bool shown)
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    char *got = a && b ? road_text(a, b, how, force_wide) : NULL;
    const bool same = got && strcmp(got, want) == 0;
    if (!same && shown) {
        char *pw = polyset_wkt(p), *qw = polyset_wkt(q);
        printf("%s, %s, %s, seed %llu%s\n%s\n%s\n  says %s\n  not  %s\n", sunder_algorithm_string(how->algorithm),
               sunder_decomposition_string(how->decomposition), sunder_order_string(how->order),
               (unsigned long long)how->seed, force_wide ? ", big integers" : "", pw, qw, got ? got : "nothing", want);
        free(pw);
        free(qw);
    }
    free(got);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return same;
}
