/* moves.c: see moves.h. Blocks are those of the result, since the block field may exist only there (sunder_blk); limits
 * and everything else are those of the original. */
#include "layer/moves.h"

#include "layer/gap_rules.h"
#include "layer/enlarging.h"
#include "layer/feature_keys.h"
#include "layer/levels.h"
#include "layer/levels_again.h"

#include "base/core_error.h"
#include "base/message.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Matching ---------------------------------------------------------------------------------------------------- */

typedef struct pairing {
    sunder_feature *before, *after; /* [n] */
    gis_moves *moves;
    const gis_layer_input *now;
} pairing;

/* Does t take each vertex and control point to its new place, as far as both geometries have them? If not, t is changed
 * so that it does so for the first at which it does not. */
static bool is_move(OGRGeometryH before, OGRGeometryH after, double t[2])
{
    const int members = OGR_G_GetGeometryCount(before), points = members ? 0 : OGR_G_GetPointCount(before);
    for (int i = 0; i < members && i < OGR_G_GetGeometryCount(after); i++)
        if (!is_move(OGR_G_GetGeometryRef(before, i), OGR_G_GetGeometryRef(after, i), t)) return false;
    for (int i = 0; i < points && i < OGR_G_GetPointCount(after); i++) {
        const double from[2] = {OGR_G_GetX(before, i), OGR_G_GetY(before, i)},
                     to[2] = {OGR_G_GetX(after, i), OGR_G_GetY(after, i)};
        for (int c = 0; c < 2; c++) {
            if (from[c] + t[c] == to[c]) continue;
            t[c] = to[c] - from[c];
            return false;
        }
    }
    return true;
}

/* Where a coordinate is rounded the difference is not the move. That of another vertex is it then, of the first few. */
enum { MOVES_TRIED = 16 };

/* Finds the move t that took one geometry with arcs to another. The control points of arcs are moved, and the corners
 * of the polylines that stand for them then differ from those before by other amounts in the last place. */
static bool find_move_of_arcs(OGRGeometryH before, OGRGeometryH after, double t[2])
{
    if (!before || !after || !OGR_G_HasCurveGeometry(before, TRUE) || !OGR_G_HasCurveGeometry(after, TRUE))
        return false;
    int tried = 0;
    t[0] = t[1] = 0;
    while (!is_move(before, after, t))
        if (tried++ == MOVES_TRIED) return false;
    OGRGeometryH moved = OGR_G_Clone(before);
    const bool found = moved && gis_geometry_translate(moved, t[0], t[1], NULL) && OGR_G_Equals(moved, after);
    OGR_G_DestroyGeometry(moved);
    return found;
}

static OGRGeometryH geometry_of(const gis_layer_input *input, size_t i)
{
    const gis_layer_input *own = gis_layer_own(input, &i);
    return gis_source_geometry(own->source, i);
}

/* If the features of pair k have arcs, and one is a translate of the other, the feature after is that before, moved. */
static bool move_arcs(pairing *p, size_t k, size_t is, gis_error *error)
{
    gis_moves *m = p->moves;
    double t[2];
    bool exact;
    sunder_error why;
    if (!p->before[k].shape || !p->after[k].shape ||
        !find_move_of_arcs(geometry_of(&m->original, m->matched[k]), geometry_of(p->now, is), t))
        return true;
    sunder_shape **moved = &m->with_arcs[m->n_with_arcs];
    if (sunder_shape_translate(p->before[k].shape, t[0], t[1], moved, &exact, &why) != SUNDER_OK)
        return gis_core_failed(error, "--before", &why);
    p->after[k].shape = *moved;
    m->n_with_arcs++;
    return true;
}

static bool take_pair(pairing *p, size_t was, size_t is, gis_error *error)
{
    gis_moves *m = p->moves;
    m->original.feature[was].block = p->now->feature[is].block;
    p->before[m->n] = m->original.feature[was];
    p->after[m->n] = p->now->feature[is];
    m->matched[m->n++] = was;
    return move_arcs(p, m->n - 1, is, error);
}

/* Matches features of one layer, in the order of the original. Features that are only in the original are listed as
 * lost. */
static bool match_layer(pairing *p, const gis_layer_input *original, const gis_layer_input *now, gis_error *error)
{
    gis_moves *m = p->moves;
    gis_feature_key *keys = NULL, *own = NULL;
    bool ok = gis_feature_keys_list(now, gis_feature_key_field(now), "--before", &keys, error) &&
              gis_feature_keys_list(original, -1, "--before", &own, error);
    size_t found = 0;
    for (size_t i = 0; ok && i < original->n; i++) {
        char *key = gis_feature_key_of(original, i, -1);
        ok = key || gis_no_memory(error);
        const gis_feature_key *other = ok ? gis_feature_keys_find(keys, now->n, key) : NULL;
        free(key);
        if (other) {
            found++;
            ok = take_pair(p, original->first + i, now->first + other->feature, error);
        } else if (ok)
            m->lost[m->n_lost++] = original->first + i;
    }
    if (ok && found < now->n)
        gis_say_warning(GIS_MESSAGE_PASSED_BY, "--before: %zu features of %s are not in %s; they are not compared",
                        now->n - found, gis_source_name(now->source), gis_source_path(original->source));
    gis_feature_keys_free(keys, keys ? now->n : 0);
    gis_feature_keys_free(own, own ? original->n : 0);
    return ok;
}

static bool is_same(const char *a, const char *b) { return a && b ? strcmp(a, b) == 0 : a == b; }

/* Fails if two layers of a sheet have one original, since the dataset holds a single layer. */
static bool check_original(const gis_layer_input *original, size_t k, gis_error *error)
{
    const gis_source_request *own = &original->part[k].request->source;
    for (size_t i = 0; i < k && !own->layer; i++) {
        const gis_source_request *other = &original->part[i].request->source;
        const char *name = gis_source_name(original->part[k].source);
        if (!other->layer && is_same(own->where, other->where) && strcmp(own->path, other->path) == 0 &&
            strcmp(name, gis_source_name(original->part[i].source)) == 0)
            return gis_fail(error,
                            "--before %s: its layer %s would be the original of both layers %s and %s of the sheet; "
                            "with the file of --spec as ORIGINAL each layer is compared with its source",
                            own->path, name, gis_layer_name(&original->part[i]), gis_layer_name(&original->part[k]));
    }
    return true;
}

/* Matches features of each layer, by its own keys. */
static bool match_features(pairing *p, gis_error *error)
{
    const gis_layer_input *original = &p->moves->original;
    if (!original->parts) return match_layer(p, original, p->now, error);
    for (size_t k = 0; k < original->parts; k++)
        if (!check_original(original, k, error) || !match_layer(p, &original->part[k], &p->now->part[k], error))
            return false;
    return true;
}

/* Sets the side anchors of points to where they stood in the original. */
static bool set_sides(gis_moves *m, gis_error *error)
{
    sunder_error why;
    bool any_points = m->original.points;
    for (size_t k = 0; k < m->original.parts; k++) any_points = any_points || m->original.part[k].points;
    if (!any_points) return true;
    double *xy = malloc((2 * m->n + 1) * sizeof *xy);
    bool ok = xy != NULL || gis_no_memory(error);
    for (size_t k = 0; ok && k < m->n; k++) {
        bool any = false;
        size_t i = m->matched[k];
        const gis_layer_input *own = gis_layer_own(&m->original, &i);
        xy[2 * k] = xy[2 * k + 1] = NAN;
        ok = !own->points || gis_layer_point(own, i, xy + 2 * k, &any, error);
    }
    if (ok && sunder_layer_set_side_anchors(m->before, xy, &why) != SUNDER_OK)
        ok = gis_core_failed(error, "--before", &why);
    free(xy);
    return ok;
}

/* Gives the layer before the rows of the original, if --rows names a field. */
static bool set_rows(gis_moves *m, gis_error *error)
{
    sunder_error why;
    if (!m->original.row) return true;
    int64_t *row = malloc((m->n + 1) * sizeof *row);
    for (size_t k = 0; row && k < m->n; k++) row[k] = m->original.row[m->matched[k]];
    const bool ok = row && sunder_layer_set_rows(m->before, row, &why) == SUNDER_OK;
    free(row);
    return ok || gis_no_memory(error);
}

static bool make_layers(pairing *p, gis_error *error)
{
    gis_moves *m = p->moves;
    if (!gis_levels_again(&m->original, m->lost, m->n_lost, &m->levels, error)) return false;
    for (size_t k = 0; k < m->n; k++) p->before[k] = m->original.feature[m->matched[k]];
    const gis_barriers *barriers = &m->original.barriers;
    sunder_error why;
    if (sunder_layer_new(p->before, m->n, &m->before, &why) != SUNDER_OK ||
        sunder_layer_new(p->after, m->n, &m->after, &why) != SUNDER_OK ||
        sunder_layer_set_barriers(m->before, barriers->barrier, barriers->n, &why) != SUNDER_OK ||
        sunder_layer_set_barriers(m->after, barriers->barrier, barriers->n, &why) != SUNDER_OK)
        return gis_core_failed(error, "--before", &why);
    if (!gis_class_gaps_set(&m->original, m->matched, m->n, m->before, error) ||
        !gis_class_gaps_set(&m->original, m->matched, m->n, m->after, error))
        return false;
    sunder_layer_set_crossed(m->before, m->original.request->rules.crossed);
    return gis_enlarge_tell(&m->original, m->matched, m->n, m->before, error) && set_rows(m, error) &&
           set_sides(m, error) && gis_levels_set(&m->original, &m->levels, m->matched, m->n, m->before, error);
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

bool gis_moves_check(const gis_layer_input_request *request, const gis_layer_input *now, gis_progress *progress,
                     gis_moves *out, gis_error *error)
{
    pairing p = {.moves = out, .now = now};
    *out = (gis_moves){.hidden = now->hidden_field >= 0};
    if (!gis_layer_input_read(request, &out->original, error)) return false;
    size_t room = out->original.n + 1;
    out->matched = calloc(room, sizeof *out->matched);
    out->lost = calloc(room, sizeof *out->lost);
    out->with_arcs = calloc(room, sizeof *out->with_arcs);
    p.before = calloc(room, sizeof *p.before);
    p.after = calloc(room, sizeof *p.after);
    bool ok = (out->matched && out->lost && out->with_arcs && p.before && p.after) || gis_no_memory(error);
    ok = ok && match_features(&p, error) && make_layers(&p, error) &&
         gis_layer_run_moves(&out->original, out->before, out->after, out->matched, progress, &out->report, error);
    free(p.before);
    free(p.after);
    return ok;
}

void gis_moves_clear(gis_moves *moves)
{
    sunder_report_free(moves->report);
    sunder_layer_free(moves->before);
    sunder_layer_free(moves->after);
    gis_levels_clear(&moves->levels);
    for (size_t k = 0; k < moves->n_with_arcs; k++) sunder_shape_free(moves->with_arcs[k]);
    free(moves->with_arcs);
    free(moves->matched);
    free(moves->lost);
    gis_layer_input_clear(&moves->original);
    *moves = (gis_moves){0};
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

size_t gis_moves_rows(const gis_moves *moves)
{
    size_t n = 0;
    if (moves->report) sunder_report_conflicts(moves->report, &n);
    return n + moves->n_lost;
}

size_t gis_moves_count(const gis_moves *moves, sunder_conflict_kind kind)
{
    size_t n, found = 0;
    const sunder_conflict *conflicts = sunder_report_conflicts(moves->report, &n);
    for (size_t k = 0; k < n; k++) found += conflicts[k].kind == kind;
    return found;
}

/* Converts the number of a thing in the matched layers to one in the original. */
static size_t thing_of(const gis_moves *moves, size_t thing)
{
    if (thing == SIZE_MAX) return thing;
    return thing < moves->n ? moves->matched[thing] : moves->original.n + (thing - moves->n);
}

static void anchor_of(const gis_moves *moves, size_t feature, double at[2])
{
    const sunder_shape *shape = moves->original.shape[feature];
    at[0] = at[1] = 0;
    if (shape && !sunder_shape_is_empty(shape)) sunder_shape_anchor(shape, at);
}

sunder_conflict gis_moves_finding(const gis_moves *moves, size_t k, bool *lost, bool *drawn)
{
    size_t n;
    const sunder_conflict *conflicts = sunder_report_conflicts(moves->report, &n);
    sunder_conflict row = {
        .b = SIZE_MAX, .missing = NAN, .need_shift = NAN, .need_gap = NAN, .need_gone = SIZE_MAX, .need_gap_most = NAN};
    *lost = k >= n;
    if (*lost)
        row.a = moves->lost[k - n];
    else {
        row = conflicts[k];
        row.a = thing_of(moves, row.a);
        row.b = thing_of(moves, row.b);
    }
    *drawn = !*lost && row.kind != SUNDER_CONFLICT_NOT_A_TRANSLATE && row.kind != SUNDER_CONFLICT_ALTERED &&
             row.kind != SUNDER_CONFLICT_TOO_SMALL;
    if (*drawn) return row;
    anchor_of(moves, row.a, row.from);
    memcpy(row.to, row.from, sizeof row.to);
    return row;
}

bool gis_moves_row(const gis_moves *moves, size_t k, gis_conflict_texts *scratch, gis_value values[N_CONFLICT_COLUMNS],
                   double from[2], double to[2], gis_error *error)
{
    bool lost, drawn;
    const sunder_conflict row = gis_moves_finding(moves, k, &lost, &drawn);
    if (!gis_conflict_values(&moves->original, &row, scratch, values, error)) return false;
    memcpy(from, row.from, sizeof row.from);
    memcpy(to, row.to, sizeof row.to);
    if (drawn) return true;
    for (int column = COLUMN_DISTANCE; column <= COLUMN_REQUIRED; column++)
        values[column] = (gis_value){.kind = GIS_NULL};
    if (lost) values[COLUMN_KIND] = (gis_value){GIS_TEXT, {.text = GIS_MOVES_LOST}};
    return true;
}

bool gis_write_moves(gis_sink_layer *layer, const gis_moves *moves, gis_error *error)
{
    gis_conflict_texts scratch = {0};
    bool ok = true;
    for (size_t k = 0; ok && k < gis_moves_rows(moves); k++) {
        gis_value values[N_CONFLICT_COLUMNS];
        double from[2], to[2];
        ok = gis_moves_row(moves, k, &scratch, values, from, to, error) && gis_line_row(layer, values, from, to, error);
    }
    gis_conflict_texts_clear(&scratch);
    return ok;
}
