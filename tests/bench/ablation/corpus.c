/* Writes a corpus as text, and reads it. */
#include "corpus.h"

#include <stdlib.h>
#include <string.h>

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

static void write_points(FILE *to, const double *xy, size_t points)
{
    for (size_t k = 0; k < points; k++) fprintf(to, "%a %a%c", xy[2 * k], xy[2 * k + 1], k + 1 < points ? ' ' : '\n');
}

static void write_shape(FILE *to, const sunder_shape *shape)
{
    const double *xy;
    const size_t *ring_end, *poly_end;
    const size_t polygons = shape ? sunder_shape_given(shape, &xy, &ring_end, &poly_end) : 0;
    if (polygons == 0) {
        fprintf(to, "shape -\n");
        return;
    }
    const size_t rings = poly_end[polygons - 1], points = rings ? ring_end[rings - 1] : 0;
    fprintf(to, "shape %d %zu %zu %zu\n", sunder_shape_repaired(shape), polygons, rings, points);
    for (size_t k = 0; k < polygons; k++) fprintf(to, "%zu ", poly_end[k]);
    for (size_t k = 0; k < rings; k++) fprintf(to, "%zu ", ring_end[k]);
    fprintf(to, "\n");
    write_points(to, xy, points);
}

static void write_barrier(FILE *to, const sunder_barrier *barrier)
{
    const sunder_obstacle *g = &barrier->geometry;
    fprintf(to, "barrier %a %a %d\n", barrier->width, barrier->gap, barrier->side);
    write_shape(to, g->shape);
    fprintf(to, "lines %zu\n", g->lines);
    for (size_t k = 0; k < g->lines; k++) fprintf(to, "%zu ", g->line_end[k]);
    fprintf(to, "\n");
    if (g->lines) write_points(to, g->xy, g->line_end[g->lines - 1]);
}

void corpus_write(FILE *to, const corpus_item *item)
{
    const sunder_layer_options *o = &item->options;
    fprintf(to, "cluster %s\n", item->name);
    fprintf(to, "options %a %a %d %d %a %d %d %d %a %llu %a %d %a %a %a\n", o->gap, o->touch_tolerance, o->no_blocks,
            o->no_touch, o->thin, o->list_inside, (int)o->contained, o->allow_jumps, o->effort,
            (unsigned long long)o->seed, o->barrier_reach, (int)o->rows, o->row_stiffness[0], o->row_stiffness[1],
            o->ease);
    for (size_t k = 0; k < item->features; k++) {
        const sunder_feature *f = &item->feature[k];
        const double *at = item->side_anchor + 2 * k;
        fprintf(to, "feature %a %a %lld %d %d %a %a\n", f->weight, f->max_shift, (long long)f->block, f->fixed,
                f->ignored, at[0], at[1]);
        write_shape(to, f->shape);
    }
    for (size_t k = 0; k < item->barriers; k++) write_barrier(to, &item->barrier[k]);
    fprintf(to, "end\n");
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static void demand(bool holds, const char *what)
{
    if (holds) return;
    fprintf(stderr, "corpus: no %s where one is expected\n", what);
    exit(1);
}

static void *allocate(size_t n, size_t size)
{
    void *memory = calloc(n ? n : 1, size);
    demand(memory != NULL, "memory");
    return memory;
}

static void read_word(FILE *from, char word[64]) { demand(fscanf(from, "%63s", word) == 1, "word"); }

static double read_number(FILE *from)
{
    char word[64], *end;
    read_word(from, word);
    const double value = strtod(word, &end);
    demand(*end == 0, "number");
    return value;
}

static size_t read_count(FILE *from)
{
    size_t value;
    demand(fscanf(from, "%zu", &value) == 1, "count");
    return value;
}

static bool read_flag(FILE *from) { return read_count(from) != 0; }

static size_t *read_counts(FILE *from, size_t n)
{
    size_t *value = allocate(n, sizeof *value);
    for (size_t k = 0; k < n; k++) value[k] = read_count(from);
    return value;
}

static double *read_points(FILE *from, size_t n)
{
    double *xy = allocate(2 * n, sizeof *xy);
    for (size_t k = 0; k < 2 * n; k++) xy[k] = read_number(from);
    return xy;
}

static void expect(FILE *from, const char *expected)
{
    char word[64];
    read_word(from, word);
    demand(strcmp(word, expected) == 0, expected);
}

static sunder_shape *read_shape(FILE *from)
{
    char word[64];
    sunder_shape *shape = NULL;
    sunder_error err;
    expect(from, "shape");
    read_word(from, word);
    if (strcmp(word, "-") == 0) return NULL;
    const sunder_validity validity = strcmp(word, "1") == 0 ? SUNDER_VALIDITY_EVEN_ODD : SUNDER_VALIDITY_STRICT;
    const size_t polygons = read_count(from), rings = read_count(from), points = read_count(from);
    size_t *poly_end = read_counts(from, polygons), *ring_end = read_counts(from, rings);
    double *xy = read_points(from, points);
    demand(sunder_shape_from_rings(xy, ring_end, poly_end, polygons, validity, &shape, &err) == SUNDER_OK, "shape");
    free(xy);
    free(ring_end);
    free(poly_end);
    return shape;
}

static void read_options(FILE *from, sunder_layer_options *o)
{
    sunder_layer_options_init(o);
    expect(from, "options");
    o->gap = read_number(from);
    o->touch_tolerance = read_number(from);
    o->no_blocks = read_flag(from);
    o->no_touch = read_flag(from);
    o->thin = read_number(from);
    o->list_inside = read_flag(from);
    o->contained = (sunder_containment)read_count(from);
    o->allow_jumps = read_flag(from);
    o->effort = read_number(from);
    o->seed = read_count(from);
    o->barrier_reach = read_number(from);
    o->rows = (sunder_rows)read_count(from);
    o->row_stiffness[0] = read_number(from);
    o->row_stiffness[1] = read_number(from);
    o->ease = read_number(from);
}

static void read_feature(FILE *from, corpus_item *item)
{
    const size_t k = item->features++;
    item->feature = realloc(item->feature, item->features * sizeof *item->feature);
    item->side_anchor = realloc(item->side_anchor, 2 * item->features * sizeof *item->side_anchor);
    demand(item->feature && item->side_anchor, "memory");
    sunder_feature *f = &item->feature[k];
    *f = (sunder_feature){.weight = read_number(from)};
    f->max_shift = read_number(from);
    f->block = (int64_t)read_number(from);
    f->fixed = read_flag(from);
    f->ignored = read_flag(from);
    item->side_anchor[2 * k] = read_number(from);
    item->side_anchor[2 * k + 1] = read_number(from);
    f->shape = read_shape(from);
}

static void read_barrier(FILE *from, corpus_item *item)
{
    const size_t k = item->barriers++;
    item->barrier = realloc(item->barrier, item->barriers * sizeof *item->barrier);
    demand(item->barrier != NULL, "memory");
    sunder_barrier *b = &item->barrier[k];
    *b = (sunder_barrier){.width = read_number(from)};
    b->gap = read_number(from);
    b->side = read_flag(from);
    b->geometry.shape = read_shape(from);
    expect(from, "lines");
    b->geometry.lines = read_count(from);
    const size_t *end = b->geometry.line_end = read_counts(from, b->geometry.lines);
    b->geometry.xy = read_points(from, b->geometry.lines ? end[b->geometry.lines - 1] : 0);
}

bool corpus_read(FILE *from, corpus_item *item)
{
    char word[64];
    if (fscanf(from, "%63s", word) != 1) return false;
    demand(strcmp(word, "cluster") == 0, "cluster");
    *item = (corpus_item){0};
    read_word(from, item->name);
    read_options(from, &item->options);
    for (;;) {
        read_word(from, word);
        if (strcmp(word, "end") == 0) return true;
        const bool feature = strcmp(word, "feature") == 0;
        demand(feature || strcmp(word, "barrier") == 0, "feature or barrier");
        if (feature)
            read_feature(from, item);
        else
            read_barrier(from, item);
    }
}

void corpus_item_free(corpus_item *item)
{
    for (size_t k = 0; k < item->features; k++) sunder_shape_free((sunder_shape *)item->feature[k].shape);
    for (size_t k = 0; k < item->barriers; k++) {
        sunder_shape_free((sunder_shape *)item->barrier[k].geometry.shape);
        free((size_t *)item->barrier[k].geometry.line_end);
        free((double *)item->barrier[k].geometry.xy);
    }
    free(item->barrier);
    free(item->feature);
    free(item->side_anchor);
    *item = (corpus_item){0};
}
