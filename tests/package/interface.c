/* A user of all three headers, in the common subset of C and C++: options with their sizes, the summary, a proof,
 * cutting a layer into parts. Built as C and as C++ by test_package.sh. Prints what the test expects, or a sentence and
 * status 1. */
#include <sunder.h>
#include <sunder_parts.h>
#include <sunder_hiding.h>
#include <sunder_legible.h>
#include <sunder_proof.h>

#include <math.h>
#include <stdio.h>

/* Two squares of side 2 whose centres are 1 apart; they are moved until the centres are 2 + gap apart. */
static int separate(double gap)
{
    sunder_layer_options options;
    sunder_layer_summary summary;
    sunder_feature features[2];
    sunder_shape *shape, *beside;
    sunder_layer *layer;
    sunder_report *report;
    size_t worlds, trees;
    bool exact;
    if (sunder_shape_rectangle(2, 2, &shape, NULL) || sunder_shape_translate(shape, 1, 0, &beside, &exact, NULL))
        return 1;
    for (int k = 0; k < 2; k++) {
        features[k].shape = k == 0 ? shape : beside;
        features[k].weight = 1;
        features[k].max_shift = INFINITY;
        features[k].block = -1;
        features[k].fixed = k == 0;
        features[k].ignored = false;
    }
    sunder_layer_options_init(&options);
    options.gap = gap;
    options.no_blocks = true;
    options.keep_trees = true;
    options.keep_worlds = true;
    if (sunder_layer_new(features, 2, &layer, NULL) || sunder_layer_separate(layer, &options, &report, NULL)) return 1;
    sunder_report_summary(report, &summary);
    sunder_report_worlds(report, &worlds);
    sunder_report_bound_trees(report, &trees);
    printf("moved %d by %.3f, verified: %d, worlds: %d, trees: %d\n", (int)summary.moved, summary.max,
           (int)summary.verified, (int)worlds, (int)trees);
    sunder_report_free(report);
    sunder_layer_free(layer);
    sunder_shape_free(beside);
    sunder_shape_free(shape);
    return 0;
}

/* A caller that was compiled with a header whose structures have fewer members. */
typedef struct old_sum_options {
    size_t size;
    sunder_progress progress;
    void *progress_user;
} old_sum_options;

static int sum(size_t size)
{
    old_sum_options old;
    const void *options = &old;
    sunder_shape *shape;
    sunder_sum *result = NULL;
    sunder_error error;
    char *area = NULL;
    old.size = size;
    old.progress = NULL;
    old.progress_user = NULL;
    if (sunder_shape_rectangle(2, 2, &shape, NULL)) return 1;
    if (sunder_minkowski_sum(shape, shape, (const sunder_sum_options *)options, &result, &error))
        printf("refused: %s\n", error.message);
    else if (sunder_sum_area_text(result, &area, &error) == SUNDER_OK)
        printf("area %s\n", area);
    sunder_free(area);
    sunder_sum_free(result);
    sunder_shape_free(shape);
    return 0;
}

int main(void)
{
    sunder_sum_options how;
    sunder_route_options route;
    sunder_total total = {{0}, 0};
    sunder_sum_options_init(&how);
    sunder_route_options_init(&route);
    sunder_total_add(&total, 0.25);
    printf("sizes: %d %d, total %g\n", how.size == sizeof how, route.size == sizeof route,
           sunder_total_nearest(&total));
    return separate(1) || sum(sizeof(old_sum_options)) || sum(12345);
}
