/* moves.h: check --before: what broke a rule on the way from an original to the layer that is checked. */
#ifndef GIS_LAYER_MOVES_H
#define GIS_LAYER_MOVES_H

#include "layer/output.h"

/* The two layers, feature matched with feature by the FIDs that they had, or by the user's own key. */
typedef struct gis_moves {
    gis_layer_input original;
    sunder_layer *before, *after; /* the matched features alone, in the same order */
    sunder_report *report;
    size_t *matched; /* [n] of the original */
    size_t *lost;    /* [n_lost] of the original: features that are not in the layer any more */
    size_t n, n_lost;
} gis_moves;

/* Reads the original, by `request`, matches, and has the core look. What was read can be released in any case. */
bool gis_moves_check(const gis_layer_input_request *request, const gis_layer_input *now, gis_progress *progress,
                     gis_moves *out, gis_error *error);
void gis_moves_clear(gis_moves *moves);

/* The word for a feature of the original that is not there any more, which the core knows nothing of. */
#define GIS_MOVES_LOST "lost"

/* How many are of this kind. */
size_t gis_moves_count(const gis_moves *moves, sunder_conflict_kind kind);
/* How many rows there are, and row k as that of a conflict of the original. A row of a feature that is lost has that
 * kind and nothing but the feature. */
size_t gis_moves_rows(const gis_moves *moves);
bool gis_moves_row(const gis_moves *moves, size_t k, gis_conflict_texts *scratch, gis_value values[N_CONFLICT_COLUMNS],
                   double from[2], double to[2], gis_error *error);

/* The rows, into a layer of conflicts. */
bool gis_write_moves(gis_sink_layer *layer, const gis_moves *moves, gis_error *error);

#endif
