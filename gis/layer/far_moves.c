/* far_moves.c: see far_moves.h. */
#include "layer/far_moves.h"

#include "base/message.h"

#include <math.h>

/* 2^43: adjacent doubles beyond it differ by more than a thousandth. */
static const double sound_limit = 0x1p43;

static bool is_sound(const double box[4])
{
    return fmax(fmax(fabs(box[0]), fabs(box[1])), fmax(fabs(box[2]), fabs(box[3]))) <= sound_limit;
}

bool gis_far_moves_may_warn(const double box[4]) { return box[0] <= box[2] && !is_sound(box); }

void gis_far_moves_add(gis_far_moves *of, const double box[4])
{
    if (!(box[0] <= box[2])) return;
    if (!is_sound(box)) {
        of->any_corrupt = true;
        return;
    }
    for (int c = 0; c < 4; c++)
        of->sound[c] = !of->any_sound ? box[c] : c < 2 ? fmin(of->sound[c], box[c]) : fmax(of->sound[c], box[c]);
    of->any_sound = true;
}

void gis_far_moves_warn(const gis_far_moves *of, const gis_layer_input *input, size_t i, const double move[2])
{
    char who[GIS_WHO_SIZE];
    if (!of->any_corrupt || !of->any_sound) return;
    const double extent = hypot(of->sound[2] - of->sound[0], of->sound[3] - of->sound[1]);
    if (!(hypot(move[0], move[1]) > extent)) return;
    gis_feature_name(input, i, who, sizeof who);
    gis_say_warning(GIS_MESSAGE_INVALID,
                    "%s: it moves by %g, which is more than the extent of the features with plausible coordinates "
                    "(%g): are its own coordinates corrupt?",
                    who, hypot(move[0], move[1]), extent);
}

void gis_far_moves_warn_all(const gis_layer_input *input, const sunder_report *report)
{
    gis_far_moves of = {0};
    for (size_t i = 0; i < input->n; i++) {
        double box[4];
        if (!input->shape[i] || sunder_shape_is_empty(input->shape[i])) continue;
        sunder_shape_box(input->shape[i], box);
        gis_far_moves_add(&of, box);
    }
    for (size_t i = 0; i < input->n && of.any_corrupt; i++) {
        double move[2];
        sunder_report_move(report, i, &move[0], &move[1]);
        gis_far_moves_warn(&of, input, i, move);
    }
}
