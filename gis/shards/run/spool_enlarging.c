/* spool_enlarging.c: see spool_enlarging.h. */
#include "shards/run/spool_enlarging.h"

#include "layer/gap_rules.h"

#include "shards/parts/part.h"

#include <stdlib.h>

/* Neighbouring parts with up to this number of features become larger at once. */
enum { AT_ONCE = 8192 };

static bool enlarge_parts(const gis_layout *layout, gis_spool_writer *to, size_t *larger, gis_error *error)
{
    const unsigned parts = gis_spool_parts(layout->spool);
    size_t *features = calloc(parts + 1, sizeof *features);
    bool done = features || gis_no_memory(error);
    for (size_t k = 0; k < gis_spool_cells(layout->spool) && done; k++) {
        const gis_spool_cell *cell = gis_spool_cell_at(layout->spool, k);
        features[cell->part] += cell->features;
    }
    for (unsigned first = 0, end; first < parts && done; first = end) {
        size_t n = features[first];
        for (end = first + 1; end < parts && n + features[end] <= AT_ONCE; end++) n += features[end];
        done = gis_parts_enlarge(layout, first, end, to, larger, error);
    }
    free(features);
    return done;
}

/* Makes the spool from a layout of the one that there is. */
static bool make_spool(const gis_layer_input *input, const gis_layout *layout, const char *directory, size_t *larger,
                       gis_error *error)
{
    gis_spool_writer *writer = NULL;
    const bool done = gis_spool_create(directory, gis_source_extent(input->source), &writer, error) &&
                      enlarge_parts(layout, writer, larger, error) &&
                      gis_spool_finish(writer, gis_spool_parts(layout->spool), NULL, NULL, error);
    gis_spool_writer_free(writer);
    return done;
}

bool gis_spool_enlarge(const gis_layer_input *input, const char *from, const char *directory, size_t *larger,
                       gis_error *error)
{
    const gis_layer_rules *rules = &input->request->rules;
    gis_spool *spool = NULL;
    gis_layout layout = {0};
    *larger = 0;
    bool done =
        gis_spool_open(from, &spool, error) &&
        gis_layout_make(spool, gis_class_gaps_most(input), rules->block_field || rules->rows_field, &layout, error);
    layout.how = gis_layer_core_options(input);
    layout.rules = rules;
    layout.lengths = &input->lengths;
    layout.name = gis_source_name(input->source);
    done = done && make_spool(input, &layout, directory, larger, error);
    gis_layout_clear(&layout);
    gis_spool_close(spool);
    return done;
}
