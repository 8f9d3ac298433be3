/* A layer beside a road: three houses are moved 2 m apart and 2 m off the road, none farther than 3 m. A fixed house
 * stands in the way of one of them, which is listed with the reason.
 *
 *     cc layer.c $(pkg-config --cflags --libs sunder) -lm && ./a.out
 *
 * Prints:
 *
 *     house 0: moved, (-2.00, 1.50)
 *     house 1: moved, (-1.00, 0.50)
 *     house 2: blocked, (0.00, 0.50)
 *     house 3: fixed, (0.00, 0.00)
 *     left: 2 and 3, overlap, because of max_shift
 *     verified: yes
 */
#include <stdio.h>
#include <sunder.h>

enum { HOUSES = 4 };

static void print_report(const sunder_report *report)
{
    sunder_layer_summary summary;
    size_t conflicts;
    const sunder_conflict *conflict = sunder_report_conflicts(report, &conflicts);
    for (size_t k = 0; k < HOUSES; k++) {
        double dx, dy;
        sunder_report_move(report, k, &dx, &dy);
        printf("house %zu: %s, (%.2f, %.2f)\n", k, sunder_feature_status_string(sunder_report_status(report, k)), dx,
               dy);
    }
    for (size_t k = 0; k < conflicts; k++)
        printf("left: %zu and %zu, %s, because of %s\n", conflict[k].a, conflict[k].b,
               sunder_conflict_kind_string(conflict[k].kind), sunder_reason_string(conflict[k].reason));
    sunder_report_summary(report, &summary);
    printf("verified: %s\n", summary.verified ? "yes" : "no");
}

int main(void)
{
    const double corner[HOUSES][2] = {{0, 2}, {9, 3}, {18, 3}, {20, 4}}; /* of squares of 8 m */
    const double road[] = {-10, 0, 40, 0};
    const size_t road_end = 2, four = 4, one = 1;
    const sunder_barrier barrier = {.geometry = {.xy = road, .line_end = &road_end, .lines = 1},
                                    .width = 3,
                                    .gap = -1,
                                    .side = true}; /* a negative gap is the layer's */
    sunder_shape *shape[HOUSES] = {NULL};
    sunder_feature feature[HOUSES];
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_layer_options options;
    sunder_error error;
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < HOUSES && !status; k++) {
        const double x = corner[k][0], y = corner[k][1], ring[] = {x, y, x + 8, y, x + 8, y + 8, x, y + 8};
        status = sunder_shape_from_rings(ring, &four, &one, 1, SUNDER_VALIDITY_STRICT, &shape[k], &error);
        feature[k] = (sunder_feature){.shape = shape[k], .weight = 1, .max_shift = 3, .block = -1, .fixed = k == 3};
    }
    sunder_layer_options_init(&options); /* the size of the struct, and the defaults */
    options.gap = 2;
    if (!status) status = sunder_layer_new(feature, HOUSES, &layer, &error);
    if (!status) status = sunder_layer_set_barriers(layer, &barrier, 1, &error);
    if (!status) status = sunder_layer_separate(layer, &options, &report, &error);
    if (status)
        fprintf(stderr, "%s\n", error.message);
    else
        print_report(report);
    sunder_report_free(report);
    sunder_layer_free(layer); /* before the shapes, which it borrows */
    for (size_t k = 0; k < HOUSES; k++) sunder_shape_free(shape[k]);
    return status ? 1 : 0;
}
