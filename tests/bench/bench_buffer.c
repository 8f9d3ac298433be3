/* bench_buffer each|dissolve|close|open SHAPE FILE: seconds to dilate the polygons of a file, one per line, by
 * disc:RADIUS:SEGMENTS, inside-disc:RADIUS:SEGMENTS or square:SIDE, from doubles in memory to the vertices of the exact
 * results as nearest doubles; median of several runs. `each` dilates line by line, `dissolve` all polygons as one set;
 * `close` and `open` are these operations on all polygons as one set. Prints features, vertices of input and output,
 * the area of the written rings, seconds. Public interface only. */
#include "buffer_input.h"
#include "sunder.h"

typedef struct output {
    double *xy, area;
    size_t room, vertices;
} output;

static sunder_status make_shape(const char *text, sunder_shape **out, sunder_error *err)
{
    bench_shape s;
    if (!bench_shape_read(&s, text)) {
        fprintf(stderr, "bench_buffer: no shape %s\n", text);
        exit(2);
    }
    if (s.segments == 0) return sunder_shape_rectangle(s.size, s.size, out, err);
    return sunder_shape_disc(s.size, s.segments, s.inside, out, err);
}

/* The rings of a sum in the form that a writer needs. */
static sunder_status take_rings(const sunder_sum *sum, output *o, sunder_error *err)
{
    sunder_sum_size size;
    sunder_sum_get_size(sum, &size);
    for (size_t p = 0; p < size.polygons; p++)
        for (size_t r = 0; r < sunder_sum_rings(sum, p); r++) {
            size_t n;
            double deviation = 0;
            const uint32_t *vertex = sunder_sum_ring(sum, p, r, &n);
            if (n > o->room) {
                free(o->xy);
                o->xy = bench_alloc(2 * n * sizeof(double));
                o->room = n;
            }
            sunder_status status = sunder_sum_vertices(sum, vertex, n, o->xy, &deviation, err);
            if (status) return status;
            o->vertices += n;
            o->area += bench_ring_area(o->xy, n);
        }
    return SUNDER_OK;
}

static sunder_status grow(const bench_set *set, const sunder_shape *by, sunder_operation operation, output *o,
                          sunder_error *err)
{
    sunder_shape *shape = NULL;
    sunder_sum *sum = NULL;
    sunder_status status = sunder_shape_from_rings(set->xy, set->ring_end, set->poly_end, set->polygons,
                                                   SUNDER_VALIDITY_STRICT, &shape, err);
    if (!status) status = sunder_morphology(shape, by, operation, NULL, &sum, err);
    if (!status) status = take_rings(sum, o, err);
    sunder_sum_free(sum);
    sunder_shape_free(shape);
    return status;
}

static double once(const bench_layer *layer, const char *shape, sunder_operation operation, output *o)
{
    sunder_error err = {0};
    sunder_shape *by = NULL;
    o->vertices = 0;
    o->area = 0;
    const double start = bench_now();
    sunder_status status = make_shape(shape, &by, &err);
    for (size_t i = 0; i < layer->n && !status; i++) status = grow(&layer->set[i], by, operation, o, &err);
    sunder_shape_free(by);
    if (!status) return bench_now() - start;
    fprintf(stderr, "bench_buffer: %s\n", err.message);
    exit(1);
}

int main(int argc, char **argv)
{
    bench_layer layer;
    bench_buffer_arguments(argc, argv, &layer);
    const size_t features = layer.n, vertices = bench_layer_vertices(&layer);
    const sunder_operation operation = strcmp(argv[1], "close") == 0  ? SUNDER_OPERATION_CLOSE
                                       : strcmp(argv[1], "open") == 0 ? SUNDER_OPERATION_OPEN
                                                                      : SUNDER_OPERATION_DILATE;
    if (strcmp(argv[1], "each") != 0) bench_layer_join(&layer);
    output o = {0};
    double t[100], spent = 0;
    size_t n = 0;
    for (; bench_again(n, spent); n++) spent += t[n] = once(&layer, argv[2], operation, &o);
    printf("%zu %zu %zu %.12g %.6f\n", features, vertices, o.vertices, o.area, bench_median(t, n));
    free(o.xy);
    bench_layer_free(&layer);
    return 0;
}
