/* bench_sum [ALGORITHM DECOMPOSITION ORDER] FILE...: seconds of P + Q by the default or by that algorithm (the words of
 * sunder_algorithm_string() and similar functions), from the operands as doubles in memory to the finished canonical
 * sum with its degenerate holes, median of several runs. One line per file: path, vertices of P and Q, vertices and
 * holes of the sum, degenerate segments and points, seconds. Public interface only. */
#include "sunder.h"
#include "wkt_input.h"

static sunder_sum_options how = {.size = sizeof how};

static __attribute__((noinline)) sunder_status bench_once(const bench_set *p, const bench_set *q, double *seconds,
                                                          sunder_sum_size *counts, sunder_error *err)
{
    sunder_shape *a = NULL, *b = NULL;
    sunder_sum *sum = NULL;
    const double start = bench_now();
    sunder_status status =
        sunder_shape_from_rings(p->xy, p->ring_end, p->poly_end, p->polygons, SUNDER_VALIDITY_STRICT, &a, err);
    if (!status)
        status = sunder_shape_from_rings(q->xy, q->ring_end, q->poly_end, q->polygons, SUNDER_VALIDITY_STRICT, &b, err);
    if (!status) status = sunder_minkowski_sum(a, b, &how, &sum, err);
    *seconds = bench_now() - start;
    if (!status) sunder_sum_get_size(sum, counts);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return status;
}

/* Are the three words the names of an algorithm, a decomposition and an order? */
static bool read_road(char **word)
{
    int a = SUNDER_ALGORITHM_AUTO, d = SUNDER_DECOMPOSITION_AUTO, o = SUNDER_ORDER_RANDOM;
    while (a <= SUNDER_ALGORITHM_DIVIDE && strcmp(word[0], sunder_algorithm_string((sunder_algorithm)a))) a++;
    while (d <= SUNDER_DECOMPOSITION_MIXED && strcmp(word[1], sunder_decomposition_string((sunder_decomposition)d)))
        d++;
    while (o <= SUNDER_ORDER_GIVEN && strcmp(word[2], sunder_order_string((sunder_order)o))) o++;
    if (a > SUNDER_ALGORITHM_DIVIDE || d > SUNDER_DECOMPOSITION_MIXED || o > SUNDER_ORDER_GIVEN) return false;
    how = (sunder_sum_options){.size = sizeof(sunder_sum_options),
                               .algorithm = (sunder_algorithm)a,
                               .decomposition = (sunder_decomposition)d,
                               .order = (sunder_order)o,
                               .seed = 1};
    return true;
}

int main(int argc, char **argv)
{
    int failed = 0;
    for (int i = argc > 4 && read_road(argv + 1) ? 4 : 1; i < argc; i++) {
        bench_set p, q;
        double t[100], spent = 0;
        size_t n = 0;
        sunder_sum_size c = {0};
        sunder_error err = {0};
        if (!bench_pair_read(argv[i], &p, &q)) {
            fprintf(stderr, "bench_sum: %s: cannot be read\n", argv[i]);
            failed = 1;
            continue;
        }
        while (!failed && bench_again(n, spent)) {
            if (bench_once(&p, &q, &t[n], &c, &err)) {
                fprintf(stderr, "bench_sum: %s: %s\n", argv[i], err.message);
                failed = 1;
                break;
            }
            spent += t[n++];
        }
        if (n)
            printf("%s %zu %zu %zu %zu %zu %zu %.9f\n", argv[i], p.vertices, q.vertices, c.vertices, c.holes,
                   c.degenerate_segments, c.degenerate_points, bench_median(t, n));
        fflush(stdout);
        bench_set_free(&p);
        bench_set_free(&q);
    }
    return failed;
}
