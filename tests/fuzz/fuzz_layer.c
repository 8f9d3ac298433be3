/* A layer of hostile shapes beside hostile barriers: the conflicts that separate reports are those that check finds for
 * the moved features, and no listed pair is worse than at the start. */
#include <string.h>

#include "bytes.h"
#include "upheld.h"

enum { MOST = 6, BARRIERS = 3, POINTS = 6 };

typedef struct fuzz_barriers {
    sunder_barrier barrier[BARRIERS];
    sunder_shape *shape[BARRIERS];
    double xy[BARRIERS][2 * POINTS];
    size_t line_end[BARRIERS][2];
    size_t n;
} fuzz_barriers;

/* Takes areas, lines or points, with lengths from zero up to the scale's own; none if no bytes are left. */
static void take_barriers(fuzz_bytes *bytes, fuzz_scale scale, fuzz_barriers *out)
{
    *out = (fuzz_barriers){.n = 0};
    for (size_t wanted = fuzz_byte(bytes) % (BARRIERS + 1); out->n < wanted && bytes->left > 0; ++out->n) {
        const size_t k = out->n;
        const unsigned kind = fuzz_byte(bytes);
        if (kind & 1) out->shape[k] = fuzz_shape(bytes, scale, 8);
        const size_t points = kind & 2 ? 1 + kind / 4 % POINTS : 0;
        for (size_t i = 0; i < 2 * points; ++i) out->xy[k][i] = fuzz_coordinate(bytes, scale);
        out->line_end[k][0] = points / 2;
        out->line_end[k][1] = points;
        out->barrier[k] = (sunder_barrier){{out->shape[k], out->xy[k], out->line_end[k], points ? 2 : 0},
                                           (double)(fuzz_byte(bytes) % 16) / 4,
                                           kind & 64 ? -1 : (double)(fuzz_byte(bytes) % 16) / 4,
                                           (kind & 128) != 0};
    }
}

static size_t count_between_blocks(const sunder_report *report)
{
    sunder_layer_summary summary;
    sunder_report_summary(report, &summary);
    const sunder_conflict_counts *after = &summary.after;
    return after->overlap + after->too_close + after->barrier + after->barrier_drawn + after->barrier_near +
           after->contained + after->duplicate;
}

/* The features after their moves, in the blocks that the report gives them, and no others. */
static void demand_agreement(const sunder_feature *features, size_t n, const fuzz_barriers *barriers,
                             const sunder_layer_options *options, const sunder_report *report)
{
    sunder_feature moved[MOST];
    sunder_shape *shapes[MOST] = {0};
    sunder_layer *layer = NULL;
    sunder_report *again = NULL;
    sunder_layer_options checked = *options;
    bool complete = true;
    checked.no_blocks = true;
    for (size_t i = 0; i < n; ++i) {
        double dx, dy;
        bool exact;
        sunder_report_move(report, i, &dx, &dy);
        complete = complete && sunder_shape_translate(features[i].shape, dx, dy, &shapes[i], &exact, NULL) == SUNDER_OK;
        moved[i] = features[i];
        moved[i].shape = shapes[i];
        moved[i].block = sunder_report_block(report, i);
    }
    if (complete && sunder_layer_new(moved, n, &layer, NULL) == SUNDER_OK &&
        sunder_layer_set_barriers(layer, barriers->barrier, barriers->n, NULL) == SUNDER_OK &&
        sunder_layer_check(layer, &checked, &again, NULL) == SUNDER_OK)
        FUZZ_DEMAND(count_between_blocks(again) == count_between_blocks(report));
    sunder_report_free(again);
    sunder_layer_free(layer);
    for (size_t i = 0; i < n; ++i) sunder_shape_free(shapes[i]);
}

/* Zero, the value of all bytes past the end of the input, selects the defaults. */
static void choose_ways(fuzz_bytes *bytes, sunder_layer_options *options)
{
    const unsigned byte = fuzz_byte(bytes), ways = byte / 3;
    options->contained = (sunder_containment)(byte % 3);
    options->effort = ways & 1 ? 0 : 1;
    options->allow_jumps = ways & 2;
    options->keep_trees = options->keep_pushes = options->keep_worlds = ways & 4;
    options->list_inside = ways & 8;
    options->no_touch = ways & 16;
    options->drop_proofs = ways & 32;
    options->seed = ways;
    options->threads = ways / 8 == 7 ? 2 : 1;
}

static void demand_bounds(const sunder_report *report)
{
    sunder_layer_summary summary;
    sunder_report_summary(report, &summary);
    FUZZ_DEMAND(summary.pair_bound >= 0 && summary.lower_bound >= 0);
    FUZZ_DEMAND(summary.lower_bound <= summary.cost);
    FUZZ_DEMAND(summary.clusters_optimal <= summary.clusters);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes bytes = {data, size};
    unsigned fail = fuzz_byte(&bytes), choices = fuzz_byte(&bytes);
    fuzz_scale scale = choices & 1 ? FUZZ_MAP : FUZZ_GRID;
    sunder_feature features[MOST];
    sunder_layer_options options;
    size_t n = 0, wanted = 2 + choices / 2 % (MOST - 1);
    fuzz_fail_allocations(0);
    fuzz_patience(FUZZ_LOOKS);
    sunder_layer_options_init(&options);
    options.gap = choices & 64 ? (double)(fuzz_byte(&bytes) % 16) / 4 : 0;
    options.touch_tolerance = choices & 128 ? -1 : 0;
    choose_ways(&bytes, &options);
    while (n < wanted && bytes.left > 0) {
        sunder_shape *shape = fuzz_shape(&bytes, scale, 12);
        if (!shape) break;
        unsigned kind = fuzz_byte(&bytes);
        features[n++] = (sunder_feature){.shape = shape,
                                         .weight = 1 + (double)(kind & 3),
                                         .max_shift = kind & 4 ? (double)(fuzz_byte(&bytes) % 16) : 1e9,
                                         .block = kind & 8 ? (kind >> 4) & 1 : -1,
                                         .fixed = (kind & 0xe0) == 0x20};
    }
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    fuzz_barriers barriers;
    take_barriers(&bytes, scale, &barriers);
    if (n > 0 && sunder_layer_new(features, n, &layer, NULL) == SUNDER_OK &&
        sunder_layer_set_barriers(layer, barriers.barrier, barriers.n, NULL) == SUNDER_OK) {
        fuzz_fail_allocations(fail < 128 ? fail * 8 : 0);
        sunder_status status = sunder_layer_separate(layer, &options, &report, NULL);
        fuzz_fail_allocations(0);
        FUZZ_DEMAND((report != NULL) == (status == SUNDER_OK));
        fuzz_patience(0); /* a result is checked without a limit on polls */
        if (report) {
            demand_bounds(report);
            demand_agreement(features, n, &barriers, &options, report);
            FUZZ_DEMAND(!upheld_breach(features, n, &options, report));
        }
    }
    sunder_report_free(report);
    sunder_layer_free(layer);
    for (size_t i = 0; i < n; ++i) sunder_shape_free((sunder_shape *)(uintptr_t)features[i].shape);
    for (size_t k = 0; k < barriers.n; ++k) sunder_shape_free(barriers.shape[k]);
    return 0;
}
