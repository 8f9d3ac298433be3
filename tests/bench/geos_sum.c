/* geos_sum METHOD FILE: seconds of P + Q by GEOS, in doubles, not exact; median of several runs. Prints vertices and
 * holes of the result and the seconds. METHOD:
 *
 *   union    the unary union of all subsums of convex pieces (subsums.h); timed: only the union of existing geometries
 *   buffer   for a Q that is a regular polygon: the round buffer of P with as many segments; timed: only the buffer.
 *            Not the same sum, but what a user of GEOS would use. The members of P are taken as in the file. */
#include "geos_input.h"
#include "subsums.h"

typedef struct question {
    const GEOSGeometry *g;
    double radius; /* 0: a union */
    int quarter;   /* number of segments of a quarter circle */
} question;

static __attribute__((noinline)) GEOSGeometry *bench_once(const question *ask)
{
    return geos_must(ask->radius > 0 ? GEOSBuffer_r(geos, ask->g, ask->radius, ask->quarter)
                                     : GEOSUnaryUnion_r(geos, ask->g));
}

static size_t holes(const GEOSGeometry *g)
{
    size_t n = 0;
    for (int i = 0; i < GEOSGetNumGeometries_r(geos, g); i++) {
        const GEOSGeometry *p = GEOSGetGeometryN_r(geos, g, i);
        if (!GEOSisEmpty_r(geos, p)) n += (size_t)GEOSGetNumInteriorRings_r(geos, p);
    }
    return n;
}

static int measure(const question *ask)
{
    double t[100], spent = 0;
    size_t n = 0, vertices = 0, found = 0;
    while (bench_again(n, spent)) {
        const double start = bench_now();
        GEOSGeometry *sum = bench_once(ask);
        t[n] = bench_now() - start;
        spent += t[n++];
        vertices = geos_count(sum);
        found = holes(sum);
        GEOSGeom_destroy_r(geos, sum);
    }
    printf("%zu %zu %.9f\n", vertices, found, bench_median(t, n));
    return 0;
}

int main(int argc, char **argv)
{
    bench_set p, q, sums;
    question ask = {0};
    if (argc != 3 || (strcmp(argv[1], "union") && strcmp(argv[1], "buffer"))) {
        fprintf(stderr, "usage: geos_sum union|buffer FILE\n");
        return 2;
    }
    if (!bench_pair_read(argv[2], &p, &q)) {
        fprintf(stderr, "geos_sum: %s: cannot be read\n", argv[2]);
        return 1;
    }
    geos_begin();
    if (strcmp(argv[1], "buffer") == 0) {
        ask.radius = bench_radius(&q);
        ask.quarter = (int)q.vertices / 4;
        ask.g = geos_geometry(&p);
    } else {
        if (!bench_subsums(&p, &q, &sums)) return 1;
        ask.g = geos_geometry(&sums);
    }
    return measure(&ask);
}
