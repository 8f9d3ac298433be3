/* far_moves.c: moves that are longer than the layer is wide, where coordinates of it are corrupt.
 *
 * A feature is *sound* if its largest coordinate is at most a million times the median of all features' largest
 * coordinates. If all are sound there is no warning: two features in one place may have to move farther than a small
 * layer is wide. */
#include "base/message.h"
#include "layer/input.h"

#include <math.h>
#include <stdlib.h>

/* Many times what is between the corners of any map, far below what doubles cannot hold to a metre. */
static const double sound_share = 1e6;

static double largest_coordinate(const sunder_shape *shape)
{
    double box[4];
    sunder_shape_box(shape, box);
    return fmax(fmax(fabs(box[0]), fabs(box[1])), fmax(fabs(box[2]), fabs(box[3])));
}

static bool counts(const gis_layer_input *input, size_t i)
{
    return input->shape[i] && !sunder_shape_is_empty(input->shape[i]);
}

/* The diagonal of the box of all sound features; INFINITY where all are sound. largest: [n] scratch. */
static double sound_extent(const gis_layer_input *input, double *largest)
{
    double all[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    size_t n = 0, sound = 0;
    for (size_t i = 0; i < input->n; i++)
        if (counts(input, i)) largest[n++] = largest_coordinate(input->shape[i]);
    const double most = sound_share * gis_layer_median(largest, n);
    for (size_t i = 0; i < input->n; i++) {
        double box[4];
        if (!counts(input, i) || largest_coordinate(input->shape[i]) > most) continue;
        sunder_shape_box(input->shape[i], box);
        for (int c = 0; c < 4; c++) all[c] = c < 2 ? fmin(all[c], box[c]) : fmax(all[c], box[c]);
        sound++;
    }
    return sound == n ? INFINITY : hypot(all[2] - all[0], all[3] - all[1]);
}

bool gis_layer_warn_of_far_moves(const gis_layer_input *input, const sunder_report *report, gis_error *error)
{
    double *largest = malloc((input->n + 1) * sizeof *largest);
    if (!largest) return gis_no_memory(error);
    const double extent = sound_extent(input, largest);
    free(largest);
    for (size_t i = 0; i < input->n && extent < INFINITY; i++) {
        double dx, dy;
        char who[GIS_WHO_SIZE];
        sunder_report_move(report, i, &dx, &dy);
        if (!(hypot(dx, dy) > extent)) continue;
        gis_feature_name(input, i, who, sizeof who);
        gis_say_warning(GIS_MESSAGE_INVALID,
                        "%s: it moves by %g, farther than the features with sound coordinates reach (%g): are its own "
                        "coordinates corrupt?",
                        who, hypot(dx, dy), extent);
    }
    return true;
}
