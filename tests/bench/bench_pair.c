/* bench_pair FILE [COUNT [reflect]]: microseconds per pair for the least translation of Q off P, from doubles in
 * memory, for the first COUNT pairs of a file with P and Q on alternating lines (0: all), or with P and -Q (reflect).
 * Prints pairs, microseconds (median of three passes), and the sum of the lengths, by which two programs can be
 * compared. */
#include "sunder.h"
#include "wkt_input.h"

static __attribute__((noinline)) sunder_status bench_once(const bench_set *set, size_t pairs, double *total,
                                                          sunder_error *err)
{
    *total = 0;
    for (size_t i = 0; i < pairs; i++) {
        const bench_set *p = &set[2 * i], *q = p + 1;
        sunder_shape *a = NULL, *b = NULL;
        sunder_separation s;
        sunder_status status =
            sunder_shape_from_rings(p->xy, p->ring_end, p->poly_end, p->polygons, SUNDER_VALIDITY_STRICT, &a, err);
        if (!status)
            status =
                sunder_shape_from_rings(q->xy, q->ring_end, q->poly_end, q->polygons, SUNDER_VALIDITY_STRICT, &b, err);
        if (!status) status = sunder_pair_separate(a, b, 0, &s, err);
        if (!status) {
            *total += s.distance;
            sunder_separation_clear(&s);
        }
        sunder_shape_free(a);
        sunder_shape_free(b);
        if (status) return status;
    }
    return SUNDER_OK;
}

int main(int argc, char **argv)
{
    FILE *f = argc > 1 ? fopen(argv[1], "r") : NULL;
    const size_t most = argc > 2 ? strtoul(argv[2], NULL, 10) : 0;
    const int reflect = argc > 3 && strcmp(argv[3], "reflect") == 0;
    bench_set *set = NULL;
    size_t n = 0;
    double t[3], total = 0;
    sunder_error err = {0};
    if (!f) {
        fprintf(stderr, "usage: bench_pair FILE [COUNT [reflect]]\n");
        return 2;
    }
    for (char *line; (!most || n < 2 * most) && (line = bench_line(f)); free(line)) {
        if ((n & (n - 1)) == 0) set = realloc(set, (n ? 2 * n : 1) * sizeof *set);
        if (!set || !bench_set_read(&set[n++], line)) {
            fprintf(stderr, "bench_pair: line %zu cannot be read\n", n);
            return 1;
        }
        if (reflect && n % 2 == 0)
            for (size_t i = 0; i < 2 * set[n - 1].vertices; i++) set[n - 1].xy[i] = -set[n - 1].xy[i];
    }
    fclose(f);
    const size_t passes = bench_setting("SUNDER_BENCH_RUNS", 0) > 0 ? 1 : 3;
    for (size_t k = 0; k < passes; k++) {
        const double start = bench_now();
        if (bench_once(set, n / 2, &total, &err)) {
            fprintf(stderr, "bench_pair: %s\n", err.message);
            return 1;
        }
        t[k] = bench_now() - start;
    }
    printf("%zu %.3f %.9g\n", n / 2, 1e6 * bench_median(t, passes) / (double)(n / 2), total);
    for (size_t i = 0; i < n; i++) bench_set_free(&set[i]);
    free(set);
    return 0;
}
