/* moves.h: check --before: finds the rules that were broken between an original layer and the layer that is checked. */
#ifndef GIS_LAYER_MOVES_H
#define GIS_LAYER_MOVES_H

#include "layer/output.h"

/* The two layers, with features matched by their original FIDs or by --id-field. */
typedef struct gis_moves {
    gis_layer_input original;
    sunder_layer *before, *after; /* only the matched features, in the same order */
    gis_levels levels;            /* the smaller shapes that the features of `before` may have */
    sunder_report *report;
    bool hidden;     /* the result has hidden features */
    size_t *matched; /* [n] numbers of the features in the original */
    size_t *lost;    /* [n_lost] numbers in the original of features that are missing in the checked layer */
    size_t n, n_lost;
    sunder_shape **with_arcs; /* [n_with_arcs] moved features with arcs, which `after` has */
    size_t n_with_arcs;
} gis_moves;

/* Reads the original as `request` says, matches features, and has the core check. Call gis_moves_clear() in any
 * case. */
bool gis_moves_check(const gis_layer_input_request *request, const gis_layer_input *now, gis_progress *progress,
                     gis_moves *out, gis_error *error);
void gis_moves_clear(gis_moves *moves);

/* The kind of a row about a feature of the original that is missing; the core does not know this kind. */
#define GIS_MOVES_LOST "lost"

/* The number of conflicts of this kind. */
size_t gis_moves_count(const gis_moves *moves, sunder_conflict_kind kind);
/* The number of rows, and row k with the columns of a conflict of the original. A row about a lost feature has only the
 * feature and the kind. */
size_t gis_moves_rows(const gis_moves *moves);
/* Row k as a conflict of the original. *lost: it is about a lost feature, and has no kind; without *drawn it has no
 * line and no distances, and its ends are the anchor of the feature. */
sunder_conflict gis_moves_finding(const gis_moves *moves, size_t k, bool *lost, bool *drawn);
bool gis_moves_row(const gis_moves *moves, size_t k, gis_conflict_texts *scratch, gis_value values[N_CONFLICT_COLUMNS],
                   double from[2], double to[2], gis_error *error);

/* Writes all rows into a layer of conflicts. */
bool gis_write_moves(gis_sink_layer *layer, const gis_moves *moves, gis_error *error);

#endif
