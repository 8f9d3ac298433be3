/* bench_sum FILE...: seconds of P + Q, from the operands as doubles in memory to the finished canonical sum with its
 * degenerate holes, median of several runs. One line a file: path, vertices of P and Q, vertices and holes of the sum,
 * degenerate segments and points, seconds. Public interface only. */
#include "sunder.h"
#include "wkt_input.h"

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
    if (!status) status = sunder_minkowski_sum(a, b, NULL, &sum, err);
    *seconds = bench_now() - start;
    if (!status) sunder_sum_get_size(sum, counts);
    sunder_sum_free(sum);
    sunder_shape_free(a);
    sunder_shape_free(b);
    return status;
}

int main(int argc, char **argv)
{
    int failed = 0;
    for (int i = 1; i < argc; i++) {
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
