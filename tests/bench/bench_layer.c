/* Layers for which the cost of separation should be proportional to their size.
 *
 *   bench_layer FAMILY N [THREADS]
 *
 *   pairs      N pairs of overlapping squares, far from each other
 *   far        ... and another pair, a mile away, that has to move 800 m
 *   outline    one fixed ring of walls, 4 N corners, and N houses that overlap it
 *   inside     one outline that contains N houses, some of them in conflict with each other (contained features are
 *              ignored)
 *   hub        one movable feature that N houses overlap
 *   chain      N squares, each of which overlaps the next
 *   lanes      N houses in lanes that are too narrow for them, and may move 1 m
 *   grid       N squares of 10 m in a grid, with 1 m between them where 3 m are required: one cluster of all
 *   rounds     N pairs, and a row of N / 100 houses, each of which runs into the next one when it is moved
 *
 * Prints one line: family, N, features, conflicts before and after, cost, bound, longest move, processor seconds of the
 * separation. */
#include "sunder.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct layout {
    sunder_feature *feature;
    size_t n, capacity;
    double gap;
    sunder_containment contained;
    uint64_t seed;
} layout;

/* SplitMix64, as a number in [0, 1) with 20 bits. */
static double random_unit(layout *l)
{
    uint64_t z = l->seed += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ z >> 31) >> 44) * 0x1p-20;
}

static void give_up(const char *why)
{
    fprintf(stderr, "bench_layer: %s\n", why);
    exit(1);
}

static sunder_feature *add_rings(layout *l, const double *xy, const size_t *ring_end, size_t rings)
{
    if (l->n == l->capacity) {
        l->capacity = 2 * l->capacity + 16;
        l->feature = realloc(l->feature, l->capacity * sizeof *l->feature);
        if (!l->feature) give_up("out of memory");
    }
    sunder_shape *shape;
    sunder_error err;
    if (sunder_shape_from_rings(xy, ring_end, &rings, 1, SUNDER_VALIDITY_STRICT, &shape, &err)) give_up(err.message);
    sunder_feature *f = &l->feature[l->n++];
    *f = (sunder_feature){.shape = shape, .weight = 1, .max_shift = INFINITY, .block = -1};
    return f;
}

static sunder_feature *add_box(layout *l, double x, double y, double w, double h)
{
    const double xy[8] = {x, y, x + w, y, x + w, y + h, x, y + h};
    const size_t end = 4;
    return add_rings(l, xy, &end, 1);
}

static void add_pairs(layout *l, size_t n)
{
    const size_t columns = (size_t)ceil(sqrt((double)n));
    for (size_t k = 0; k < n; k++) {
        const double x = 400000 + 100 * (double)(k % columns), y = 5000000 + 100 * (double)(k / columns);
        add_box(l, x, y, 10, 10);
        add_box(l, x + 4 + 5 * random_unit(l), y + 8 * random_unit(l) - 4, 10, 10);
    }
}

/* A regular ring of 4 n corners, as long as n houses side by side; half of its houses on each side. */
static void add_outline(layout *l, size_t n)
{
    const size_t corners = 2 * n < 8 ? 8 : 2 * n;
    const double r = 3 * (double)n, turn = 2 * 3.14159265358979323846 / (double)corners;
    double *xy = malloc(4 * corners * sizeof *xy);
    if (!xy) give_up("out of memory");
    for (size_t k = 0; k < corners; k++)
        for (size_t side = 0; side < 2; side++) {
            double *p = xy + 2 * (side ? corners + k : k);
            const double a = turn * (side ? -(double)k : (double)k), d = r + (side ? -1 : 1);
            p[0] = 400000 + floor(1024 * d * cos(a)) / 1024;
            p[1] = 5000000 + floor(1024 * d * sin(a)) / 1024;
        }
    const size_t ring_end[2] = {corners, 2 * corners};
    add_rings(l, xy, ring_end, 2)->fixed = true;
    free(xy);
    for (size_t k = 0; k < n; k++) {
        const double a = 2 * turn * (double)k, d = r + (k % 2 ? 3 : -3);
        add_box(l, 400000 + floor(d * cos(a)) - 3, 5000000 + floor(d * sin(a)) - 3, 6, 6);
    }
}

static void add_inside(layout *l, size_t n)
{
    const size_t columns = (size_t)ceil(sqrt((double)n));
    const double wide = 24 * (double)columns;
    l->contained = SUNDER_CONTAINMENT_IGNORE;
    add_box(l, 400000 - 24, 5000000 - 24, wide + 24, wide + 24);
    for (size_t k = 0; k < n; k++)
        add_box(l, 400000 + 24 * (double)(k % columns) + 16 * random_unit(l),
                5000000 + 24 * (double)(k / columns) + 16 * random_unit(l), 10, 10);
}

static void add_hub(layout *l, size_t n)
{
    add_box(l, 400000, 5000000, 15 * (double)(n / 2 + 1), 20)->weight = (double)n;
    for (size_t k = 0; k < n; k++)
        add_box(l, 400000 + 15 * (double)(k / 2) + 2, 5000000 + (k % 2 ? 18 : -8), 10, 10 + random_unit(l));
}

static void add_chain(layout *l, size_t n)
{
    for (size_t k = 0; k < n; k++) add_box(l, 400000 + 9.5 * (double)k, 5000000 + random_unit(l), 10, 10);
}

/* Lanes of width 9 m with houses of 10 m, in connected rows. */
static void add_lanes(layout *l, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        const double x = 400000 + 19.5 * (double)k;
        add_box(l, x, 5000000, 10, 10 + random_unit(l))->max_shift = 1;
        add_box(l, x + 9.5, 5000000 - 40, 10, 90)->fixed = true;
    }
    for (size_t k = 0; k + 1 < n; k++) add_box(l, 400000 + 19.5 * (double)k + 4, 5000000 + 9.5, 20, 6)->max_shift = 1;
}

/* Positions vary by a decimetre, so that all rows differ. */
static void add_grid(layout *l, size_t n)
{
    const size_t columns = (size_t)ceil(sqrt((double)n));
    l->gap = 3;
    for (size_t k = 0; k < n; k++)
        add_box(l, 400000 + 11 * (double)(k % columns) + random_unit(l) / 10,
                5000000 + 11 * (double)(k / columns) + random_unit(l) / 10, 10, 10);
}

static void add_rounds(layout *l, size_t n)
{
    add_pairs(l, n);
    const double y = 4990000;
    double x = 400000;
    add_box(l, x, y, 400, 400)->weight = 1e6;
    x += 390 - (double)(n / 100);
    add_box(l, x, y, 10, 400);
    for (size_t k = 0; k < n / 100; k++) add_box(l, x += 10.75, y, 10, 400);
}

/* Pairs, and far from them two features that overlap deeply. */
static void add_far(layout *l, size_t n)
{
    add_pairs(l, n);
    add_box(l, 380000, 5000000, 1600, 1600);
    add_box(l, 380000, 5000000.5, 1600, 1600);
}

static void make(layout *l, const char *name, size_t n)
{
    static const struct {
        const char *name;
        void (*add)(layout *l, size_t n);
    } family[] = {{"pairs", add_pairs}, {"outline", add_outline}, {"inside", add_inside},
                  {"hub", add_hub},     {"chain", add_chain},     {"lanes", add_lanes},
                  {"grid", add_grid},   {"rounds", add_rounds},   {"far", add_far}};
    for (size_t k = 0; k < sizeof family / sizeof *family; k++)
        if (!strcmp(name, family[k].name)) {
            family[k].add(l, n);
            return;
        }
    give_up("no such family");
}

int main(int argc, char **argv)
{
    if (argc < 3) give_up("usage: bench_layer FAMILY N [THREADS]");
    layout l = {.seed = 1};
    make(&l, argv[1], (size_t)strtoul(argv[2], NULL, 10));
    sunder_layer_options options;
    sunder_layer_options_init(&options);
    options.gap = l.gap;
    options.touch_tolerance = 0;
    options.contained = l.contained;
    options.threads = argc > 3 ? (unsigned)strtoul(argv[3], NULL, 10) : 1;
    sunder_layer *layer;
    sunder_report *report;
    sunder_error err;
    if (sunder_layer_new(l.feature, l.n, &layer, &err)) give_up(err.message);
    const clock_t began = clock();
    if (sunder_layer_separate(layer, &options, &report, &err)) give_up(err.message);
    const double seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
    sunder_layer_summary s;
    sunder_report_summary(report, &s);
    printf("%-8s %7s %8zu features  %7zu -> %5zu conflicts  cost %14.3f  bound %14.3f  max %9.3f  %8.2f s\n", argv[1],
           argv[2], l.n, s.before.overlap + s.before.too_close + s.before.contained,
           s.after.overlap + s.after.too_close + s.after.contained, s.cost, s.lower_bound, s.max, seconds);
    sunder_report_free(report);
    sunder_layer_free(layer);
    for (size_t k = 0; k < l.n; k++) sunder_shape_free((sunder_shape *)l.feature[k].shape);
    free(l.feature);
    return 0;
}
