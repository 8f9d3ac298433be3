/* layout.c: what all parts of a layer have in common: the distance around a part that is read with it, and where
 * numbered blocks are. */
#include "shards/parts/part.h"

#include "base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The halo: this number of gaps, plus this multiple of the mean size of features. */
static const double gaps_about = 6, features_about = 2;

static double halo_of(const gis_spool *spool, double gap)
{
    double size = 0;
    size_t n = 0;
    for (size_t k = 0; k < gis_spool_cells(spool); k++) {
        const gis_spool_cell *c = gis_spool_cell_at(spool, k);
        if (c->features == 0 || c->box[0] > c->box[2]) continue;
        size += (double)c->features * sqrt((c->box[2] - c->box[0]) * (c->box[3] - c->box[1]) / (double)c->features);
        n += c->features;
    }
    return gaps_about * gap + (n ? features_about * size / (double)n : 0);
}

typedef struct looking {
    gis_part_block *block;
    size_t n, capacity;
} looking;

static bool add_block(looking *to, int64_t number, const double box[4], gis_error *error)
{
    if (!gis_array_reserve(&to->block, &to->capacity, to->n + 1, sizeof *to->block)) return gis_no_memory(error);
    to->block[to->n++] = (gis_part_block){number, {box[0], box[1], box[2], box[3]}};
    return true;
}

/* Notes the block and the row of a feature; user: the looking of blocks, and that of rows. */
static bool take_feature(void *user, const gis_spool_feature *feature, gis_error *error)
{
    looking *l = user;
    const int64_t block = feature->demands.block;
    double box[4];
    gis_spool_feature_box(feature, box);
    sunder_shape_free((sunder_shape *)feature->demands.shape);
    return (block < 0 || add_block(&l[0], block, box, error)) &&
           (feature->row == 0 || add_block(&l[1], feature->row, box, error));
}

static int by_block(const void *a, const void *b)
{
    const gis_part_block *p = a, *q = b;
    return (p->block > q->block) - (p->block < q->block);
}

/* Merges the entries of each block to one with the box of all its features; sorts by block. Returns their number. */
static size_t unite_blocks(gis_part_block *block, size_t n)
{
    size_t out = 0;
    if (n) qsort(block, n, sizeof *block, by_block);
    for (size_t k = 0; k < n; k++) {
        if (out == 0 || block[out - 1].block != block[k].block) {
            block[out++] = block[k];
            continue;
        }
        double *box = block[out - 1].box;
        for (int c = 0; c < 4; c++) box[c] = c < 2 ? fmin(box[c], block[k].box[c]) : fmax(box[c], block[k].box[c]);
    }
    return out;
}

bool gis_layout_make(gis_spool *spool, double gap, bool numbered, gis_layout *out, gis_error *error)
{
    looking l[2] = {{0}};
    bool done = true;
    *out = (gis_layout){.spool = spool, .halo = halo_of(spool, gap)};
    for (size_t k = 0; numbered && k < gis_spool_cells(spool) && done; k++) {
        done = gis_spool_read(spool, k, take_feature, l, error);
        for (int c = 0; c < 2; c++) l[c].n = unite_blocks(l[c].block, l[c].n);
    }
    out->block = l[0].block;
    out->blocks = l[0].n;
    out->row = l[1].block;
    out->rows = l[1].n;
    return done;
}

static const gis_part_block *find_number(const gis_part_block *list, size_t n, int64_t number)
{
    size_t low = 0, high = n;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (list[middle].block < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low < n && list[low].block == number ? &list[low] : NULL;
}

const gis_part_block *gis_layout_block(const gis_layout *layout, int64_t number)
{
    return find_number(layout->block, layout->blocks, number);
}

const gis_part_block *gis_layout_row(const gis_layout *layout, int64_t number)
{
    return find_number(layout->row, layout->rows, number);
}

void gis_layout_clear(gis_layout *layout)
{
    free(layout->block);
    free(layout->row);
    *layout = (gis_layout){0};
}
