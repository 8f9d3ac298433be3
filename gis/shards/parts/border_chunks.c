/* border_chunks.c: see border_chunks.h. */
#include "shards/parts/border_chunks.h"

#include "shards/parts/box_pairs.h"

#include <stdlib.h>

static const gis_part_chunk *of_file(const gis_border_chunk *c) { return &c->file->chunk[c->chunk]; }

static bool list_chunks(gis_border_chunks *h, gis_error *error)
{
    size_t n = 0;
    for (size_t f = 0; f < h->files; f++) n += h->file[f].chunks;
    h->chunk = malloc((n + 1) * sizeof *h->chunk);
    if (!h->chunk) return gis_no_memory(error);
    for (size_t f = 0; f < h->files; f++)
        for (size_t k = 0; k < h->file[f].chunks; k++)
            h->chunk[h->chunks++] = (gis_border_chunk){.file = &h->file[f], .chunk = k};
    return true;
}

static bool load_wanted_chunks(gis_border_chunks *h, gis_part_result *held, gis_error *error)
{
    gis_part_result one = {0};
    bool done = true;
    for (size_t k = 0; k < h->chunks && done; k++) {
        gis_border_chunk *c = &h->chunk[k];
        if (c->held || !c->wanted) continue;
        c->held = true;
        done = gis_part_file_read(c->file, c->chunk, &one, error) && gis_part_copy_all(held, &one, error);
    }
    h->seen = held->worlds;
    gis_part_result_clear(&one);
    return done;
}

static gis_box_pairs_next want_both(void *user, const gis_paired_box *a, const gis_paired_box *b)
{
    gis_border_chunks *h = user;
    if (of_file(&h->chunk[a->of])->run != of_file(&h->chunk[b->of])->run)
        h->chunk[a->of].wanted = h->chunk[b->of].wanted = true;
    return GIS_BOX_PAIRS_BOTH;
}

bool gis_border_chunks_load(gis_border_chunks *chunks, gis_part_result *held, gis_error *error)
{
    gis_box_pairs pairs = {0};
    bool done = list_chunks(chunks, error);
    for (size_t k = 0; k < chunks->chunks && done; k++) {
        chunks->chunk[k].wanted = of_file(&chunks->chunk[k])->incomplete;
        done = gis_box_pairs_add(&pairs, of_file(&chunks->chunk[k])->box, k, 0, error);
    }
    if (done) gis_box_pairs_visit(&pairs, want_both, chunks);
    gis_box_pairs_clear(&pairs);
    return done && load_wanted_chunks(chunks, held, error);
}

enum { CHUNK, WORLD };

static gis_box_pairs_next want_chunk(void *user, const gis_paired_box *a, const gis_paired_box *b)
{
    gis_border_chunks *h = user;
    if (a->kind != b->kind) h->chunk[(a->kind == CHUNK ? a : b)->of].wanted = true;
    return GIS_BOX_PAIRS_BOTH;
}

bool gis_border_chunks_load_new(gis_border_chunks *chunks, gis_part_result *held, gis_error *error)
{
    gis_box_pairs pairs = {0};
    bool done = true;
    for (size_t k = 0; k < chunks->chunks && done; k++)
        if (!chunks->chunk[k].held) done = gis_box_pairs_add(&pairs, of_file(&chunks->chunk[k])->box, k, CHUNK, error);
    for (size_t w = chunks->seen; w < held->worlds && done; w++) {
        const gis_part_world *world = &held->world[w];
        for (size_t k = 0; k < world->footprints && done; k++) {
            const sunder_footprint *f = &held->footprint[world->footprint + k];
            done = gis_box_pairs_add(&pairs, f->read, w, WORLD, error) &&
                   gis_box_pairs_add(&pairs, f->wrote, w, WORLD, error);
        }
    }
    if (done) gis_box_pairs_visit(&pairs, want_chunk, chunks);
    gis_box_pairs_clear(&pairs);
    return done && load_wanted_chunks(chunks, held, error);
}

void gis_border_chunks_clear(gis_border_chunks *chunks)
{
    free(chunks->chunk);
    chunks->chunk = NULL;
    chunks->chunks = 0;
}
