/* Layers for the benchmark of buffers: a file of polygons, one WKT per line, and the shape by which they are dilated.
 * One header for the C programs and for CGAL's, so that all use the same numbers. */
#ifndef SUNDER_BENCH_BUFFER_INPUT_H
#define SUNDER_BENCH_BUFFER_INPUT_H

#include "wkt_input.h"

typedef struct bench_layer {
    bench_set *set; /* [n] a feature each */
    size_t n;
} bench_layer;

typedef struct bench_shape {
    double size;       /* the disc's radius, the square's side */
    unsigned segments; /* segments of a disc; 0: a square */
    int inside;
} bench_shape;

static inline int bench_shape_read(bench_shape *s, const char *text)
{
    memset(s, 0, sizeof *s);
    if (sscanf(text, "square:%lf", &s->size) == 1) return s->size > 0;
    s->inside = strncmp(text, "inside-", 7) == 0;
    return sscanf(text + (s->inside ? 7 : 0), "disc:%lf:%u", &s->size, &s->segments) == 2 && s->size > 0 &&
           s->segments >= 3;
}

static inline int bench_layer_read(bench_layer *layer, const char *path)
{
    size_t room = 1024;
    char *line;
    FILE *f = fopen(path, "r");
    layer->n = 0;
    layer->set = (bench_set *)bench_alloc(room * sizeof *layer->set);
    if (!f) return 0;
    while ((line = bench_line(f)) != NULL) {
        if (layer->n == room) {
            layer->set = (bench_set *)realloc(layer->set, (room *= 2) * sizeof *layer->set);
            if (!layer->set) abort();
        }
        const int ok = bench_set_read(&layer->set[layer->n], line);
        layer->n += ok != 0;
        free(line);
        if (!ok) break;
    }
    fclose(f);
    return line == NULL && layer->n > 0;
}

static inline void bench_layer_free(bench_layer *layer)
{
    for (size_t i = 0; i < layer->n; i++) bench_set_free(&layer->set[i]);
    free(layer->set);
}

static inline size_t bench_layer_vertices(const bench_layer *layer)
{
    size_t n = 0;
    for (size_t i = 0; i < layer->n; i++) n += layer->set[i].vertices;
    return n;
}

/* All features as one feature with all their polygons. */
static inline void bench_layer_join(bench_layer *layer)
{
    bench_set all;
    size_t rings = 0, polygons = 0;
    for (size_t i = 0; i < layer->n; i++) {
        rings += layer->set[i].rings;
        polygons += layer->set[i].polygons;
    }
    memset(&all, 0, sizeof all);
    all.xy = (double *)bench_alloc(2 * bench_layer_vertices(layer) * sizeof(double));
    all.ring_end = (size_t *)bench_alloc(rings * sizeof(size_t));
    all.poly_end = (size_t *)bench_alloc(polygons * sizeof(size_t));
    for (size_t i = 0; i < layer->n; i++) {
        const bench_set *s = &layer->set[i];
        memcpy(all.xy + 2 * all.vertices, s->xy, 2 * s->vertices * sizeof(double));
        for (size_t p = 0; p < s->polygons; p++) all.poly_end[all.polygons++] = all.rings + s->poly_end[p];
        for (size_t r = 0; r < s->rings; r++) all.ring_end[all.rings + r] = all.vertices + s->ring_end[r];
        all.rings += s->rings;
        all.vertices += s->vertices;
    }
    bench_layer_free(layer);
    layer->set = (bench_set *)bench_alloc(sizeof *layer->set);
    layer->set[0] = all;
    layer->n = 1;
}

/* Signed area, relative to the first vertex, so that large coordinates cost no digits. */
static inline double bench_ring_area(const double *xy, size_t n)
{
    double area = 0;
    for (size_t i = 1; i + 1 < n; i++)
        area += (xy[2 * i] - xy[0]) * (xy[2 * i + 3] - xy[1]) - (xy[2 * i + 1] - xy[1]) * (xy[2 * i + 2] - xy[0]);
    return area / 2;
}

static inline int bench_is_one_of(const char *word, const char *const *words, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (strcmp(word, words[i]) == 0) return 1;
    return 0;
}

/* Parses each|dissolve|close|open SHAPE FILE; ends the process if the arguments do not have this form. */
static inline void bench_buffer_arguments(int argc, char **argv, bench_layer *layer)
{
    static const char *const words[] = {"each", "dissolve", "close", "open"};
    if (argc < 4 || !bench_is_one_of(argv[1], words, 4)) {
        fprintf(stderr, "usage: %s each|dissolve|close|open SHAPE FILE\n", argv[0]);
        exit(2);
    }
    if (bench_layer_read(layer, argv[3])) return;
    fprintf(stderr, "%s: %s: cannot be read\n", argv[0], argv[3]);
    exit(1);
}

#endif
