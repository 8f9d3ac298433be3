/* layer_input.c: reads a layer: opens its source, makes shapes of its features, applies the rules to each, and passes
 * everything to the core. Hints about a misunderstood command line are added here, where it is known that opening
 * failed. */
#include "layer/enlarging.h"
#include "layer/gap_rules.h"
#include "layer/levels.h"

#include "base/core_error.h"
#include "base/message.h"
#include "read/crs_units.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Gives a hint if the operands are in the order OUTPUT INPUT, as for ogr2ogr. */
static bool hint_at_order(const gis_layer_input_request *request, gis_error *error)
{
    const char *input = request->source.path, *output = request->output;
    if (output && strstr(error->message, "no such file") && access(input, F_OK) != 0 && access(output, F_OK) == 0)
        return gis_fail(error, "%s: no such file, but %s exists: the order is INPUT OUTPUT", input, output);
    return false;
}

/* Adds a hint if the source has points and no symbol was given. */
static bool hint_at_symbol(const gis_layer_input *input, gis_error *error)
{
    if (input->points || !input->request->may_have_symbols || !strstr(error->message, "Point")) return false;
    size_t n = strlen(error->message);
    snprintf(error->message + n, sizeof error->message - n, "; for points give their --symbol, as in --symbol disc:4");
    return false;
}

static bool open_source(gis_layer_input *input, bool packed, gis_error *error)
{
    gis_source_request request = input->request->source;
    request.packed = packed;
    request.threads = input->request->rules.core.threads;
    request.not_finite = gis_invalid_not_finite(input->request->invalid, GIS_NOT_FINITE_KEPT);
    input->points = input->request->symbol || input->request->symbol_field;
    request.takes = input->points ? GIS_TAKES_POINTS : GIS_TAKES_POLYGONS;
    if (!gis_source_open(&request, &input->source, error))
        return hint_at_order(input->request, error) || hint_at_symbol(input, error);
    if (!request.batch) gis_say_warnings(GIS_MESSAGE_INPUT, gis_source_warnings(input->source));
    input->n = gis_source_count(input->source);
    return gis_layer_fields(input, error);
}

/* The box of a feature's shape. False if it has none, or is ignored. */
static bool feature_box(const gis_layer_input *input, size_t i, double box[4])
{
    if (!input->shape[i] || sunder_shape_is_empty(input->shape[i])) return false;
    if (input->feature && input->feature[i].ignored) return false;
    sunder_shape_box(input->shape[i], box);
    return true;
}

void gis_layer_box(const gis_layer_input *input, double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (size_t i = 0; i < input->n; i++) {
        double one[4];
        if (!feature_box(input, i, one)) continue;
        for (int k = 0; k < 2; k++) {
            box[k] = fmin(box[k], one[k]);
            box[k + 2] = fmax(box[k + 2], one[k + 2]);
        }
    }
}

void gis_layer_warn_of_crs(const gis_layer_input *input)
{
    double box[4];
    gis_layer_box(input, box);
    gis_crs_units_warn(gis_source_crs(input->source), gis_source_name(input->source), box[0] <= box[2] ? box : NULL);
}

bool gis_layer_point(const gis_layer_input *input, size_t i, double xy[2], bool *any, gis_error *error)
{
    double *at;
    size_t n;
    if (!gis_geometry_points(gis_source_geometry(input->source, i), &at, &n, error)) return false;
    *any = n > 0;
    for (size_t k = 0; k < n; k++)
        if (k == 0 || at[2 * k] < xy[0] || (at[2 * k] == xy[0] && at[2 * k + 1] < xy[1]))
            memcpy(xy, at + 2 * k, 2 * sizeof *xy);
    CPLFree(at);
    return true;
}

/* Sets the side anchors of points: the point itself, whatever its symbol is. */
static bool set_sides(gis_layer_input *input, gis_error *error)
{
    sunder_error why;
    bool any_points = input->points;
    for (size_t k = 0; k < input->parts; k++) any_points = any_points || input->part[k].points;
    if (!any_points || input->barriers.n == 0) return true;
    double *xy = malloc((2 * input->n + 1) * sizeof *xy);
    bool ok = xy != NULL || gis_no_memory(error);
    for (size_t i = 0; ok && i < input->n; i++) {
        size_t k = i;
        const gis_layer_input *own = gis_layer_own(input, &k);
        bool any = false;
        xy[2 * i] = xy[2 * i + 1] = NAN;
        ok = !own->points || !input->shape[i] || gis_layer_point(own, k, xy + 2 * i, &any, error);
    }
    if (ok && sunder_layer_set_side_anchors(input->layer, xy, &why) != SUNDER_OK)
        ok = gis_core_failed(error, gis_source_name(input->source), &why);
    free(xy);
    return ok;
}

/* Makes the smaller shapes. The command check makes them for the layers that it compares (moves.c). */
static bool make_levels(gis_layer_input *input, gis_error *error)
{
    if (!input->request->moves || input->request->compared) return true;
    return gis_levels_make(input, input->layer, &input->levels, error) &&
           gis_levels_set(input, &input->levels, NULL, input->n, input->layer, error);
}

/* Makes features larger. Those of a layer that is compared grow with the blocks of the other one (moves.c). */
static bool enlarge(gis_layer_input *input, gis_error *error)
{
    for (size_t i = 0; i < input->n; i++) input->feature[i].shape = input->shape[i];
    return input->request->compared || gis_enlarge(input, input->feature, error);
}

static bool make_layer(gis_layer_input *input, gis_error *error)
{
    sunder_error why;
    if (sunder_layer_new(input->feature, input->n, &input->layer, &why) != SUNDER_OK)
        return gis_core_failed(error, gis_source_name(input->source), &why);
    if (sunder_layer_set_barriers(input->layer, input->barriers.barrier, input->barriers.n, &why) != SUNDER_OK)
        return gis_core_failed(error, "--barrier", &why);
    if (!gis_class_gaps_set(input, NULL, input->n, input->layer, error)) return false;
    if (sunder_layer_set_rows(input->layer, input->row, &why) != SUNDER_OK)
        return gis_core_failed(error, "--rows", &why);
    sunder_layer_set_crossed(input->layer, input->request->rules.crossed);
    if (!gis_enlarge_tell(input, NULL, input->n, input->layer, error)) return false;
    return gis_layer_set_hiding(input, error) && make_levels(input, error) && set_sides(input, error);
}

/* Barriers are read within this multiple of the longest limit, since the report also says which longer limit would
 * solve a conflict. */
static const double limits_known = 4;

/* Neighbours in a row are at most this many gaps apart, and a barrier between them ends the row. */
static const double gaps_of_rows = 4;

double gis_layer_barrier_reach(const gis_layer_input *input, double longest_limit)
{
    return fmax(limits_known * longest_limit,
                input->request->rules.core.rows ? gaps_of_rows * gis_class_gaps_most(input) : 0);
}

/* The longest move that any feature may make. */
static double longest_limit(const gis_layer_input *input)
{
    double longest = 0;
    for (size_t i = 0; input->request->moves && i < input->n; i++)
        if (!input->feature[i].ignored && !input->feature[i].fixed)
            longest = fmax(longest, input->feature[i].max_shift);
    return longest;
}

/* The box of a feature's shape, of the one that it had before it became larger, and of its point, which makes the same
 * move: the symbol may be drawn beside the point. */
static bool box_of_ways(const gis_layer_input *input, size_t i, double box[4])
{
    double at[2];
    bool any = false;
    gis_error none;
    if (!feature_box(input, i, box)) return false;
    if (input->given && input->given[i]) {
        double given[4];
        sunder_shape_box(input->given[i], given);
        for (int k = 0; k < 4; k++) box[k] = k < 2 ? fmin(box[k], given[k]) : fmax(box[k], given[k]);
    }
    const gis_layer_input *own = gis_layer_own(input, &i);
    if (!own->points || !gis_layer_point(own, i, at, &any, &none) || !any) return true;
    for (int k = 0; k < 4; k++) box[k] = k < 2 ? fmin(box[k], at[k]) : fmax(box[k], at[k - 2]);
    return true;
}

/* The distance within which barriers decide on which side a feature stands; 0 for a point, which has the side where it
 * stands. */
static double side_reach(const gis_layer_input *input, size_t i)
{
    double box[4];
    size_t k = i;
    return !gis_layer_own(input, &k)->points && feature_box(input, i, box) ? sunder_side_reach(box) : 0;
}

/* The boxes near which barriers matter: that of each feature or, for a check with --before, one box around all old and
 * new positions. */
static gis_barrier_targets *find_targets(const gis_layer_input *input)
{
    const double *also = input->request->also;
    double(*box)[4] = calloc(input->n + 1, sizeof *box), all[4], farthest = 0;
    size_t n = 0;
    if (!box) return NULL;
    gis_layer_box(input, all);
    if (also) {
        for (int k = 0; k < 4; k++) box[0][k] = k < 2 ? fmin(all[k], also[k]) : fmax(all[k], also[k]);
        for (size_t i = 0; i < input->n; i++) farthest = fmax(farthest, side_reach(input, i));
        gis_barrier_target_grow(box[0], farthest, input->barrier_reach);
        n = box[0][0] <= box[0][2];
    }
    for (size_t i = 0; !also && i < input->n; i++) {
        if (!box_of_ways(input, i, box[n])) continue;
        gis_barrier_target_grow(box[n++], side_reach(input, i), input->barrier_reach);
    }
    gis_barrier_targets *targets = gis_barrier_targets_new((const double(*)[4])box, n);
    free(box);
    return targets;
}

static bool read_barriers(gis_layer_input *input, gis_error *error)
{
    const gis_layer_input_request *request = input->request;
    if (request->barriers == 0) return true;
    input->barrier_reach = gis_layer_barrier_reach(input, longest_limit(input));
    gis_barrier_targets *targets = find_targets(input);
    if (!targets) return gis_no_memory(error);
    const gis_barrier_surroundings around = {
        .crs = gis_source_crs(input->source),
        .units = &input->units,
        .targets = targets,
        .reach = input->barrier_reach,
        .gap = gis_class_gaps_most(input),
        .least_gap = request->rules.least_gap.text ? input->least_gap : -1,
        .invalid = request->invalid,
        .output = request->output,
        .update = request->update,
    };
    const bool ok = gis_barriers_read(request->barrier, request->barriers, &around, &input->barriers, error);
    gis_barrier_targets_free(targets);
    return ok;
}

bool gis_layer_begin(const gis_layer_input_request *request, bool packed, gis_layer_input *out, gis_error *error)
{
    *out = (gis_layer_input){.request = request,
                             .class_field = -1,
                             .prefer_field = {-1, -1},
                             .id_field = -1,
                             .block_field = -1,
                             .rows_field = -1,
                             .limit_field = -1,
                             .weight_field = -1,
                             .hierarchy_field = -1,
                             .hidden_field = -1,
                             .max_shift = INFINITY,
                             .tolerance = -1,
                             .barrier_reach = INFINITY};
    if (!open_source(out, packed, error)) return false;
    out->units = gis_crs_units_of(gis_source_crs(out->source), request->scale);
    return true;
}

bool gis_layer_make_room(gis_layer_input *input, bool demands, gis_error *error)
{
    gis_layer_drop_features(input);
    input->n = gis_source_count(input->source);
    input->shape = calloc(input->n + 1, sizeof *input->shape);
    if (demands) input->feature = calloc(input->n + 1, sizeof *input->feature);
    return (input->shape && (!demands || input->feature)) || gis_no_memory(error);
}

static void clear_previous(gis_previous *previous)
{
    free(previous->move);
    free(previous->of);
    free(previous->edited);
    free(previous->relaxed);
    *previous = (gis_previous){0};
}

void gis_layer_drop_features(gis_layer_input *input)
{
    for (size_t i = 0; input->shape && i < input->n && !input->parts; i++) sunder_shape_free(input->shape[i]);
    for (size_t i = 0; input->given && i < input->n; i++) sunder_shape_free(input->given[i]);
    free(input->shape);
    free(input->given);
    free(input->read);
    input->given = input->read = NULL;
    gis_levels_clear(&input->levels);
    clear_previous(&input->previous);
    free(input->feature);
    free(input->row);
    free(input->gap_class);
    input->row = NULL;
    input->gap_class = NULL;
    input->shape = NULL;
    input->feature = NULL;
    input->n = 0;
}

bool gis_layer_shapes_read(const gis_layer_input_request *request, gis_layer_input *out, gis_error *error)
{
    if (!gis_layer_begin(request, false, out, error) || !gis_layer_make_room(out, false, error)) return false;
    out->as_chords = true;
    return gis_layer_shapes(out, error);
}

void gis_layer_warn_of_others(const gis_layer_input *input, bool any_points)
{
    if (input->other > 0)
        gis_say_warning(GIS_MESSAGE_PASSED_BY,
                        "%s: %zu features are not %s; they stay as they are and conflict with nothing%s",
                        gis_source_name(input->source), input->other, input->points ? "points" : "polygons",
                        any_points && !input->points ? " (for points give their --symbol, as in --symbol disc:4)" : "");
}

void gis_layer_default_demands(gis_layer_input *input)
{
    const gis_layer_rules *rules = &input->request->rules;
    for (size_t i = 0; i < input->n; i++) {
        const bool there = input->shape[i] && !sunder_shape_is_empty(input->shape[i]);
        input->feature[i] = (sunder_feature){.weight = 1,
                                             .max_shift = input->max_shift,
                                             .block = -1,
                                             .ignored = !there,
                                             .joins_none = rules->joins_none,
                                             .may_jump = rules->may_jump,
                                             .in_no_row = rules->in_no_row};
    }
}

/* Lets the source take vertices from the shapes as read, which stay so if features become larger. */
static bool lend_shapes(gis_layer_input *input, gis_error *error)
{
    const gis_layer_rules *rules = &input->request->rules;
    if (rules->enlarge && !(input->read = malloc((input->n + 1) * sizeof *input->read))) return gis_no_memory(error);
    for (size_t i = 0; input->read && i < input->n; i++) input->read[i] = input->shape[i];
    return gis_source_borrow(input->source, input->read ? input->read : input->shape, rules->core.threads, error);
}

bool gis_layer_read_features(const gis_layer_input_request *request, gis_layer_input *out, gis_error *error)
{
    if (!gis_layer_begin(request, true, out, error) || !gis_layer_make_room(out, true, error)) return false;
    if (!gis_layer_lengths(out, error) || !gis_layer_shapes(out, error) || !lend_shapes(out, error)) return false;
    gis_layer_default_demands(out);
    gis_layer_warn_of_crs(out);
    gis_layer_warn_of_others(out, gis_source_content_count(out->source, GIS_POINTS) > 0);
    return gis_layer_marks(out, error) && gis_layer_mark_hidden(out, error) && gis_layer_blocks(out, error) &&
           gis_layer_weights(out, error) && gis_layer_limits(out, error) && gis_layer_rows(out, error) &&
           gis_class_gaps_read(out, error);
}

bool gis_layer_complete(gis_layer_input *input, gis_error *error)
{
    return enlarge(input, error) && read_barriers(input, error) && make_layer(input, error);
}

void gis_layer_forget_demands(gis_layer_input *input)
{
    free(input->feature);
    input->feature = NULL;
    for (size_t k = 0; k < input->parts; k++) gis_layer_forget_demands(&input->part[k]);
}

void gis_layer_input_clear(gis_layer_input *input)
{
    sunder_layer_free(input->layer);
    gis_layer_drop_features(input);
    gis_rung_lengths_clear(&input->lengths);
    gis_layer_shaping_free(input->shaping);
    gis_class_gaps_clear(&input->class_tables);
    gis_barriers_clear(&input->barriers);
    if (!input->parts) gis_source_close(input->source);
    for (size_t k = 0; k < input->parts; k++) gis_layer_input_clear(&input->part[k]);
    free(input->part);
    *input = (gis_layer_input){0};
}

void gis_layer_input_request_clear(gis_layer_input_request *request)
{
    for (size_t k = 0; k < request->barriers; k++) gis_barrier_request_clear(&request->barrier[k]);
    free(request->barrier);
    gis_links_request_clear(&request->links);
    for (size_t k = 0; k < request->more; k++) gis_layer_input_request_clear(&request->with[k]);
    free(request->with);
    free(request->alone);
    request->with = request->alone = NULL;
    request->more = 0;
    request->barrier = NULL;
    request->barriers = 0;
}
