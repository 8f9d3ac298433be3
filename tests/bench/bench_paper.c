/* bench_paper FILE pieces: the convex decompositions of P and Q. One CSV line per decomposition: its name, the one
 * used, pieces of P and of Q, subsums, sides of all subsums, seconds to decompose and to form the subsums.
 *
 * bench_paper FILE orders: the incremental union in random order, in the given order, and by each measure of fatness.
 * One CSV line per order: its name, subsums, edges of the union, comparisons, orientation tests, crossings, seconds.
 *
 * Seconds are medians for pieces, of one run for orders. Uses the library's internal headers, since pieces and measures
 * are not part of the public interface. */
#include "convex/convex_sum.h"
#include "unions/unions.h"
#include "wkt_input.h"

typedef struct pieces {
    uint32_t p, q;
    size_t sides;
    sunder_decomposition used;
    double decompose, subsums;
} pieces;

static sunder_status add_pieces(sunder_i_lattice *lattice, const sunder_i_decomposition *p,
                                const sunder_i_decomposition *q, pieces *out)
{
    sunder_i_arena arena;
    bool ok = true;
    sunder_i_arena_init(&arena);
    out->sides = 0;
    for (uint32_t i = 0; ok && i < p->pieces; i++)
        for (uint32_t j = 0; ok && j < q->pieces; j++) {
            sunder_i_convex_sum sum;
            ok = sunder_i_convex_sum_of(lattice, p, i, q, j, &arena, &sum);
            if (ok) out->sides += sum.corners;
        }
    sunder_i_arena_free(&arena);
    return ok ? SUNDER_OK : SUNDER_ENOMEM;
}

static sunder_status once(const sunder_shape *p, const sunder_shape *q, sunder_decomposition kind, pieces *out)
{
    sunder_i_placed placed;
    sunder_i_decomposition a, b;
    const sunder_i_place_options options = {0};
    sunder_status status = sunder_i_place(p, q, &options, &placed, NULL);
    if (status) return status;
    double start = bench_now();
    status = sunder_i_decompose_pair(&placed.lattice, p, placed.p, q, placed.q, kind, &a, &b, NULL);
    out->decompose = bench_now() - start;
    if (!status) {
        start = bench_now();
        status = add_pieces(&placed.lattice, &a, &b, out);
        out->subsums = bench_now() - start;
        out->p = a.pieces;
        out->q = b.pieces;
        out->used = a.used != kind ? a.used : b.used;
        sunder_i_decomposition_clear(&a);
        sunder_i_decomposition_clear(&b);
    }
    sunder_i_placed_free(&placed);
    return status;
}

static sunder_status measure(const sunder_shape *p, const sunder_shape *q, sunder_decomposition kind)
{
    double decompose[100], subsums[100], spent = 0;
    size_t n = 0;
    pieces found = {0};
    while (bench_again(n, spent)) {
        const sunder_status status = once(p, q, kind, &found);
        if (status) return status;
        decompose[n] = found.decompose;
        subsums[n] = found.subsums;
        spent += decompose[n] + subsums[n];
        n++;
    }
    printf("%s,%s,%u,%u,%zu,%zu,%.9f,%.9f\n", sunder_decomposition_string(kind),
           sunder_decomposition_string(found.used), (unsigned)found.p, (unsigned)found.q, (size_t)found.p * found.q,
           found.sides, bench_median(decompose, n), bench_median(subsums, n));
    fflush(stdout);
    return SUNDER_OK;
}

typedef struct order {
    const char *name;
    sunder_order order;
    sunder_i_fatness fatness;
} order;

static sunder_status unite(sunder_i_placed *placed, sunder_i_uniting *u, size_t *edges, sunder_counts *done)
{
    sunder_i_planar_map *map;
    sunder_i_map_size size;
    const sunder_counts before = placed->lattice.counts;
    const sunder_status status = sunder_i_unite_by_increments(u, &map, NULL);
    if (status) return status;
    const sunder_counts *after = &placed->lattice.counts;
    sunder_i_planar_map_size(map, &size);
    sunder_i_planar_map_free(map);
    *edges = size.edges;
    done->comparisons = after->comparisons - before.comparisons - u->counts.comparisons;
    done->orientation_tests = after->orientation_tests - before.orientation_tests - u->counts.orientation_tests;
    done->segment_intersections = after->segment_intersections - before.segment_intersections;
    return SUNDER_OK;
}

static sunder_status in_order(const sunder_shape *p, const sunder_shape *q, const order *by)
{
    const sunder_sum_options options = {
        .size = sizeof options, .algorithm = SUNDER_ALGORITHM_INCREMENTAL, .order = by->order, .seed = 1};
    const sunder_i_place_options how = {0};
    sunder_i_placed placed;
    sunder_status status = sunder_i_place(p, q, &how, &placed, NULL);
    if (status) return status;
    sunder_i_uniting u = {.lattice = &placed.lattice, .options = &options, .fatness = by->fatness, .random = 1};
    status = sunder_i_decompose_pair(&placed.lattice, p, placed.p, q, placed.q, SUNDER_DECOMPOSITION_ANGLE_BISECTOR,
                                     &u.p, &u.q, NULL);
    if (!status) {
        size_t edges = 0;
        sunder_counts done = {0};
        const double start = bench_now();
        u.subsums = u.p.pieces * u.q.pieces;
        status = unite(&placed, &u, &edges, &done);
        if (!status)
            printf("%s,%u,%zu,%llu,%llu,%llu,%.9f\n", by->name, (unsigned)u.subsums, edges,
                   (unsigned long long)done.comparisons, (unsigned long long)done.orientation_tests,
                   (unsigned long long)done.segment_intersections, bench_now() - start);
        fflush(stdout);
        sunder_i_decomposition_clear(&u.p);
        sunder_i_decomposition_clear(&u.q);
        sunder_i_arena_free(&u.arena);
    }
    sunder_i_placed_free(&placed);
    return status;
}

static sunder_status all_pieces(const sunder_shape *p, const sunder_shape *q)
{
    sunder_status status = SUNDER_OK;
    for (int kind = SUNDER_DECOMPOSITION_ANGLE_BISECTOR; !status && kind <= SUNDER_DECOMPOSITION_MIXED; kind++)
        status = measure(p, q, (sunder_decomposition)kind);
    return status;
}

static sunder_status all_orders(const sunder_shape *p, const sunder_shape *q)
{
    static const order orders[] = {{"random", SUNDER_ORDER_RANDOM, SUNDER_I_FAT_AREA},
                                   {"given", SUNDER_ORDER_GIVEN, SUNDER_I_FAT_AREA},
                                   {"area", SUNDER_ORDER_FAT, SUNDER_I_FAT_AREA},
                                   {"breadth", SUNDER_ORDER_FAT, SUNDER_I_FAT_BREADTH},
                                   {"round", SUNDER_ORDER_FAT, SUNDER_I_FAT_ROUND}};
    sunder_status status = SUNDER_OK;
    for (size_t i = 0; !status && i < sizeof orders / sizeof *orders; i++) status = in_order(p, q, &orders[i]);
    return status;
}

int main(int argc, char **argv)
{
    bench_set p, q;
    sunder_shape *a = NULL, *b = NULL;
    sunder_error err = {0};
    const bool orders = argc == 3 && strcmp(argv[2], "orders") == 0;
    if (argc != 3 || (!orders && strcmp(argv[2], "pieces") != 0) || !bench_pair_read(argv[1], &p, &q)) {
        fprintf(stderr, "usage: bench_paper FILE pieces|orders\n");
        return 2;
    }
    sunder_status status =
        sunder_shape_from_rings(p.xy, p.ring_end, p.poly_end, p.polygons, SUNDER_VALIDITY_STRICT, &a, &err);
    if (!status)
        status = sunder_shape_from_rings(q.xy, q.ring_end, q.poly_end, q.polygons, SUNDER_VALIDITY_STRICT, &b, &err);
    if (!status) status = orders ? all_orders(a, b) : all_pieces(a, b);
    if (status) fprintf(stderr, "bench_paper: %s %s\n", sunder_status_string(status), err.message);
    sunder_shape_free(a);
    sunder_shape_free(b);
    bench_set_free(&p);
    bench_set_free(&q);
    return status != SUNDER_OK;
}
