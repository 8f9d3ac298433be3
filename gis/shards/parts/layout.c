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

static bool take_block(void *user, const gis_spool_feature *feature, gis_error *error)
{
    looking *l = user;
    gis_part_block own = {.block = feature->demands.block};
    sunder_shape_box(feature->demands.shape, own.box);
    sunder_shape_free((sunder_shape *)feature->demands.shape);
    if (own.block < 0) return true;
    if (!gis_array_reserve(&l->block, &l->capacity, l->n + 1, sizeof *l->block)) return gis_no_memory(error);
    l->block[l->n++] = own;
    return true;
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
    looking l = {0};
    bool done = true;
    *out = (gis_layout){.spool = spool, .halo = halo_of(spool, gap)};
    for (size_t k = 0; numbered && k < gis_spool_cells(spool) && done; k++) {
        done = gis_spool_read(spool, k, take_block, &l, error);
        l.n = unite_blocks(l.block, l.n);
    }
    out->block = l.block;
    out->blocks = l.n;
    return done;
}

const gis_part_block *gis_layout_block(const gis_layout *layout, int64_t number)
{
    size_t low = 0, high = layout->blocks;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (layout->block[middle].block < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low < layout->blocks && layout->block[low].block == number ? &layout->block[low] : NULL;
}

void gis_layout_clear(gis_layout *layout)
{
    free(layout->block);
    *layout = (gis_layout){0};
}
