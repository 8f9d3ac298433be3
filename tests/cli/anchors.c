/* Prints anchors for rules.py and side_anchor_cases.py. For each input line "NAME SET" it prints "NAME x y", the anchor
 * of the set. For each line "NAME SET LINES { CORNERS { x y } } AREAS { SET }" it prints "NAME x y x y", the anchor and
 * the side anchor, with these lines and areas as barriers. A SET is "POLYGONS { RINGS { CORNERS { x y } } }", with
 * numbers in place of the words in capitals. rules.py tests only that an anchor is an interior point;
 * side_anchor_cases.py compares anchors with their exact rule. */
#include "displacement/layer/sides.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 1 << 18, MOST_BARRIERS = 64 };

typedef struct reader {
    char *at;
    double xy[2 * MOST];
    size_t ring_end[MOST], poly_end[MOST];
} reader;

static size_t read_count(reader *r) { return (size_t)strtoul(r->at, &r->at, 10); }

/* Returns false if the set is too large. */
static bool read_set(reader *r, size_t *polygons)
{
    size_t rings = 0, corners = 0;
    *polygons = read_count(r);
    for (size_t p = 0; p < *polygons; p++) {
        const size_t more = read_count(r);
        for (size_t k = 0; k < more; k++) {
            const size_t n = read_count(r);
            if (n + corners > MOST || rings == MOST || *polygons > MOST) return false;
            for (size_t c = 0; c < 2 * n; c++) r->xy[2 * corners + c] = strtod(r->at, &r->at);
            corners += n;
            r->ring_end[rings++] = corners;
        }
        r->poly_end[p] = rings;
    }
    return true;
}

static sunder_shape *read_shape(reader *r, const char *name)
{
    size_t polygons;
    sunder_shape *shape = NULL;
    sunder_error err;
    if (!read_set(r, &polygons)) {
        fprintf(stderr, "anchors: %s is too large\n", name);
        exit(2);
    }
    if (sunder_shape_from_rings(r->xy, r->ring_end, r->poly_end, polygons, SUNDER_VALIDITY_EVEN_ODD, &shape, &err)) {
        fprintf(stderr, "anchors: %s: %s\n", name, err.message);
        exit(2);
    }
    return shape;
}

typedef struct barriers {
    sunder_barrier item[MOST_BARRIERS];
    double *xy[MOST_BARRIERS];
    size_t line_end[MOST_BARRIERS], n;
    sunder_shape *shape[MOST_BARRIERS];
} barriers;

static void read_barriers(reader *r, const char *name, barriers *b)
{
    memset(b, 0, sizeof *b);
    const size_t lines = read_count(r);
    for (; b->n < lines && b->n < MOST_BARRIERS; b->n++) {
        const size_t corners = b->line_end[b->n] = read_count(r);
        double *xy = b->xy[b->n] = calloc(2 * corners, sizeof *xy);
        for (size_t c = 0; xy && c < 2 * corners; c++) xy[c] = strtod(r->at, &r->at);
        b->item[b->n] = (sunder_barrier){.geometry = {NULL, xy, &b->line_end[b->n], 1}, .side = true};
    }
    const size_t areas = read_count(r);
    for (size_t k = 0; k < areas && b->n < MOST_BARRIERS; k++, b->n++) {
        b->shape[b->n] = read_shape(r, name);
        b->item[b->n] = (sunder_barrier){.geometry = {.shape = b->shape[b->n]}, .side = true};
    }
}

static void free_barriers(barriers *b)
{
    for (size_t k = 0; k < b->n; k++) {
        free(b->xy[k]);
        sunder_shape_free(b->shape[k]);
    }
}

/* Finds the side anchor, in a layer of this one feature. */
static sunder_status find_side_anchor(const sunder_shape *shape, const barriers *b, double at[2], sunder_error *err)
{
    const sunder_feature feature = {.shape = shape, .weight = 1, .max_shift = 1, .block = -1};
    sunder_layer *layer = NULL, work = {0};
    sunder_i_barriers parts = {0};
    sunder_i_rules rules;
    sunder_i_model model = {0};
    const sunder_i_relations none = {0};
    sunder_layer_options options;
    sunder_layer_options_init(&options);
    sunder_shape_anchor(shape, at);
    sunder_status status = sunder_layer_new(&feature, 1, &layer, err);
    if (!status) status = sunder_layer_set_barriers(layer, b->item, b->n, err);
    if (!status) status = sunder_i_rules_of(&options, &rules, err);
    if (!status) status = sunder_i_barriers_make(layer, &(sunder_i_rules){0}, &parts, err);
    if (!status) status = sunder_i_order_layer(layer, &parts, true, &work, err);
    if (!status) status = sunder_i_model_init(&work, &parts, &rules, &model, err);
    if (!status) status = sunder_i_model_join(&model, &none, err);
    if (!status) status = sunder_i_model_cut(&model, err);
    if (!status) status = sunder_i_model_anchor(&model, err);
    if (!status && model.side_at) memcpy(at, model.side_at, 2 * sizeof *at);
    sunder_i_model_free(&model);
    sunder_i_barriers_free(&parts);
    sunder_i_ordered_clear(&work);
    sunder_layer_free(layer);
    return status;
}

static void answer(reader *r, const char *name)
{
    double anchor[2], side[2];
    sunder_error err;
    sunder_shape *shape = read_shape(r, name);
    sunder_shape_anchor(shape, anchor);
    printf("%s %a %a", name, anchor[0], anchor[1]);
    if (strspn(r->at, " \n") < strlen(r->at)) {
        static barriers b;
        read_barriers(r, name, &b);
        if (find_side_anchor(shape, &b, side, &err)) {
            fprintf(stderr, "anchors: %s: %s\n", name, err.message);
            exit(2);
        }
        printf(" %a %a", side[0], side[1]);
        free_barriers(&b);
    }
    putchar('\n');
    sunder_shape_free(shape);
}

int main(void)
{
    static reader r;
    char *line = NULL;
    size_t room = 0;
    while (getline(&line, &room, stdin) > 0) {
        char *name = strtok_r(line, " ", &r.at);
        if (name) answer(&r, name);
    }
    free(line);
    return 0;
}
