/* shapes.c: from features to shapes. Polygons are taken as they are, arcs as polylines grown by what they may be
 * off, points as the symbol drawn at them. What cannot conflict (null, empty, of another kind, invalid with --invalid
 * skip) has no shape and passes through as skipped. */
#include "layer/input.h"

#include "base/interrupt.h"
#include "base/message.h"
#include "round/round.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const unsigned growth_segments = 16;

#define SYMBOL_FORMS "WKT, @FILE, disc:R[:N], inside-disc:R[:N], square:SIDE or rectangle:WxH"

void gis_feature_name(const gis_layer_input *input, size_t i, char *text, size_t size)
{
    GIntBig fid = gis_source_fid(input->source, i);
    int n = snprintf(text, size, "layer %s, ", gis_source_name(input->source));
    if (n < 0 || (size_t)n >= size)
        return;
    if (fid == OGRNullFID)
        n += snprintf(text + n, size - (size_t)n, "feature %zu", i + 1);
    else
        n += snprintf(text + n, size - (size_t)n, "FID " CPL_FRMT_GIB, fid);
    OGRFeatureH feature = gis_source_feature(input->source, i);
    if (input->id_field >= 0 && (size_t)n < size && OGR_F_IsFieldSetAndNotNull(feature, input->id_field))
        snprintf(text + n, size - (size_t)n, " (id %s)", OGR_F_GetFieldAsString(feature, input->id_field));
}

/* The core's status of a call about one feature. */
static bool core_failed(const char *who, const sunder_error *why, gis_error *error)
{
    return gis_fail(error, "%s: %s", who, why->message);
}

/* S grown by a disc that contains the disc of `radius`, as a shape of doubles. Rounding the sum to doubles takes it in
 * by less than four units in the last place: the radius is increased by eight. */
static bool grow(const sunder_shape *shape, double radius, const char *who, sunder_shape **out, gis_error *error)
{
    double box[4], most = 0;
    sunder_shape_box(shape, box);
    for (int i = 0; i < 4; i++)
        most = fmax(most, fabs(box[i]));
    radius = radius * (1 + 1e-9) + 8 * (nextafter(most, INFINITY) - most);
    sunder_shape *disc = NULL, *grown = NULL;
    sunder_sum *sum = NULL;
    gis_rounded rounded = {0};
    sunder_error why;
    bool ok = sunder_shape_disc(radius, growth_segments, false, &disc, &why) == SUNDER_OK &&
              sunder_minkowski_sum(shape, disc, NULL, &sum, &why) == SUNDER_OK;
    if (!ok)
        core_failed(who, &why, error);
    ok = ok && gis_round_sum(sum, &rounded, error);
    if (ok && gis_polygons_shape(&rounded.set, SUNDER_VALIDITY_STRICT, &grown, &why) != SUNDER_OK)
        ok = core_failed(who, &why, error);
    gis_rounded_clear(&rounded);
    sunder_sum_free(sum);
    sunder_shape_free(disc);
    if (ok)
        *out = grown;
    return ok;
}

static bool polygon_shape(gis_layer_input *input, size_t i, gis_rings *rings, gis_error *error)
{
    char who[512];
    gis_invalid policy = gis_options_invalid(input->options);
    sunder_shape *shape = NULL, *grown;
    bool invalid;
    gis_error reason;
    if (!gis_geometry_rings(gis_source_geometry(input->source, i), rings, error))
        return false;
    gis_feature_name(input, i, who, sizeof who);
    bool ok = gis_shape_of_polygons(&rings->set, policy, who, &shape, &invalid, &reason, error);
    if (!ok && !(invalid && policy == GIS_INVALID_SKIP))
        return false;
    if (invalid) {
        input->invalid++;
        gis_say_warning("%s: invalid: %s; %s", who, reason.message,
                        ok ? "taken as what its rings enclose by the even-odd rule" : "skipped");
    }
    if (rings->linearised > 0 && input->as_chords)
        gis_say_warning("%s: its arcs are taken as polylines that differ from them by up to %g", who,
                        rings->linearised);
    else if (rings->linearised > 0 && shape && !sunder_shape_is_empty(shape)) {
        if (!grow(shape, rings->linearised, who, &grown, error)) {
            sunder_shape_free(shape);
            return false;
        }
        sunder_shape_free(shape);
        shape = grown;
    }
    input->shape[i] = shape;
    return true;
}

static bool append_translate(const sunder_shape *symbol, const double at[2], gis_polygons *all, const char *who,
                             gis_error *error)
{
    sunder_shape *moved;
    sunder_error why;
    bool exact;
    if (sunder_shape_translate(symbol, at[0], at[1], &moved, &exact, &why) != SUNDER_OK)
        return core_failed(who, &why, error);
    bool ok = gis_polygons_append_shape(all, moved, 0, 0, error);
    sunder_shape_free(moved);
    return ok;
}

/* The symbol at every point of the feature; of several their union. */
static bool place_symbol(gis_layer_input *input, size_t i, const sunder_shape *symbol, const char *who,
                         gis_error *error)
{
    double *at;
    size_t n;
    gis_polygons all = {0};
    if (!gis_geometry_points(gis_source_geometry(input->source, i), &at, &n, error))
        return false;
    bool ok = true;
    for (size_t k = 0; ok && k < n; k++)
        ok = append_translate(symbol, at + 2 * k, &all, who, error);
    CPLFree(at);
    sunder_error why;
    /* A symbol that rounding to the point's place has broken is taken by the even-odd rule. */
    if (ok && gis_polygons_shape(&all, SUNDER_VALIDITY_STRICT, &input->shape[i], &why) != SUNDER_OK &&
        gis_polygons_shape(&all, SUNDER_VALIDITY_EVEN_ODD, &input->shape[i], &why) != SUNDER_OK)
        ok = core_failed(who, &why, error);
    gis_polygons_clear(&all);
    return ok;
}

static bool read_symbol(const gis_layer_input *input, const char *text, const char *who, sunder_shape **out,
                        gis_error *error)
{
    sunder_shape *symbol;
    if (!gis_shape_from_text(text, who, &input->rule, gis_options_invalid(input->options), &symbol, NULL, error))
        return false;
    if (sunder_shape_is_empty(symbol)) {
        sunder_shape_free(symbol);
        return gis_fail_usage(error, "%s (%s): the symbol is empty; it must enclose something", who, text);
    }
    *out = symbol;
    return true;
}

/* The feature's own symbol, from --symbol-field, else the common one. */
static bool point_shape(gis_layer_input *input, size_t i, int field, const sunder_shape *common, gis_error *error)
{
    OGRFeatureH feature = gis_source_feature(input->source, i);
    char who[512];
    gis_feature_name(input, i, who, sizeof who);
    if (field < 0 || gis_field_is_blank(feature, field)) {
        if (common)
            return place_symbol(input, i, common, who, error);
        return gis_fail(error, "%s: %s is null, and there is no --symbol to take instead", who,
                        input->options->text[OPT_SYMBOL_FIELD]);
    }
    sunder_shape *own = NULL;
    const char *text = OGR_F_GetFieldAsString(feature, field);
    if (!gis_shape_is_text(text))
        return gis_fail(error, "%s: %s in %s is no symbol; expected " SYMBOL_FORMS, who, text,
                        input->options->text[OPT_SYMBOL_FIELD]);
    if (!read_symbol(input, text, who, &own, error)) {
        error->exit_status = GIS_FAILED; /* it is the data that is wrong, not the call */
        return false;
    }
    bool ok = place_symbol(input, i, own, who, error);
    sunder_shape_free(own);
    return ok;
}

/* What makes the shapes: rings is room for one feature's; the symbols are of points. */
typedef struct shaping {
    gis_rings rings;
    sunder_shape *symbol; /* NULL: every point has its own */
    int symbol_field;     /* -1: none has */
} shaping;

/* --symbol and --symbol-field. */
static bool read_symbols(const gis_layer_input *input, shaping *how, gis_error *error)
{
    const gis_options *options = input->options;
    const char *symbol = options->text[OPT_SYMBOL];
    if (!gis_layer_field(input, OPT_SYMBOL_FIELD, &how->symbol_field, error))
        return false;
    if (!options->given[OPT_SYMBOL])
        return true;
    if (!gis_shape_is_text(symbol))
        return gis_fail_usage(error, "--symbol %s: expected " SYMBOL_FORMS, symbol);
    return read_symbol(input, symbol, "--symbol", &how->symbol, error);
}

static bool make_shapes(gis_layer_input *input, gis_error *error)
{
    shaping how = {.symbol_field = -1};
    gis_content wanted = input->points ? GIS_POINTS : GIS_POLYGONS;
    bool ok = !input->points || read_symbols(input, &how, error);
    for (size_t i = 0; ok && i < input->n; i++) {
        gis_content content = gis_source_content(input->source, i);
        input->null += content == GIS_NOTHING;
        input->other += content != GIS_NOTHING && content != wanted;
        ok = gis_go_on(error);
        if (ok && content == wanted)
            ok = input->points ? point_shape(input, i, how.symbol_field, how.symbol, error)
                               : polygon_shape(input, i, &how.rings, error);
    }
    sunder_shape_free(how.symbol);
    gis_rings_clear(&how.rings);
    return ok;
}

/* Who writes OUTPUT INPUT, as with ogr2ogr, is told so. */
static bool hint_at_order(const gis_options *options, gis_error *error)
{
    const char *input = options->operand[0], *output = options->operand[1];
    if (output && strstr(error->message, "no such file") && access(input, F_OK) != 0 && access(output, F_OK) == 0)
        return gis_fail(error, "%s: no such file, but %s exists: the order is INPUT OUTPUT", input, output);
    return false;
}

/* Points are taken where a symbol is given, which is easily forgotten. */
static bool hint_at_symbol(const gis_layer_input *input, gis_error *error)
{
    bool known = gis_option_table[OPT_SYMBOL].commands & input->options->command->bit;
    if (input->points || !known || !strstr(error->message, "Point"))
        return false;
    size_t n = strlen(error->message);
    snprintf(error->message + n, sizeof error->message - n, "; for points give their --symbol, as in --symbol disc:4");
    return false;
}

static bool open_source(gis_layer_input *input, gis_error *error)
{
    const gis_options *options = input->options;
    input->points = options->given[OPT_SYMBOL] || options->given[OPT_SYMBOL_FIELD];
    gis_source_request request =
        gis_options_source(options, options->operand[0], input->points ? GIS_TAKES_POINTS : GIS_TAKES_POLYGONS);
    if (!gis_source_open(&request, &input->source, error))
        return hint_at_order(options, error) || hint_at_symbol(input, error);
    gis_say_warnings(gis_source_warnings(input->source));
    input->n = gis_source_count(input->source);
    return gis_layer_field(input, OPT_ID_FIELD, &input->id_field, error);
}

void gis_layer_warn_of_crs(const gis_layer_input *input)
{
    double box[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < input->n; i++) {
        double one[4];
        if (!input->shape[i] || sunder_shape_is_empty(input->shape[i]))
            continue;
        sunder_shape_box(input->shape[i], one);
        for (int k = 0; k < 2; k++) {
            box[k] = fmin(box[k], one[k]);
            box[k + 2] = fmax(box[k + 2], one[k + 2]);
        }
    }
    gis_ruler_warn(gis_source_crs(input->source), gis_source_name(input->source), box[0] <= box[2] ? box : NULL);
}

static bool make_layer(gis_layer_input *input, gis_error *error)
{
    sunder_error why;
    for (size_t i = 0; i < input->n; i++)
        input->feature[i].shape = input->shape[i];
    if (sunder_layer_new(input->feature, input->n, &input->layer, &why) != SUNDER_OK)
        return core_failed(gis_source_name(input->source), &why, error);
    return true;
}

static bool start_reading(const gis_options *options, gis_layer_input *out, gis_error *error)
{
    *out = (gis_layer_input){.options = options, .id_field = -1, .max_shift = INFINITY, .tolerance = -1};
    if (!open_source(out, error))
        return false;
    out->rule = gis_ruler_of(gis_source_crs(out->source), options);
    out->shape = calloc(out->n + 1, sizeof *out->shape);
    return out->shape || gis_no_memory(error);
}

bool gis_layer_shapes_read(const gis_options *options, gis_layer_input *out, gis_error *error)
{
    if (!start_reading(options, out, error))
        return false;
    out->as_chords = true;
    return make_shapes(out, error);
}

/* A layer of any type may hold what the command passes by. */
static void warn_of_others(const gis_layer_input *input)
{
    bool any_points = false;
    for (size_t i = 0; i < input->n && !input->points && !any_points; i++)
        any_points = gis_source_content(input->source, i) == GIS_POINTS;
    if (input->other > 0)
        gis_say_warning("%s: %zu features are no %s; they stay as they are and conflict with nothing%s",
                        gis_source_name(input->source), input->other, input->points ? "points" : "polygons",
                        any_points ? " (for points give their --symbol, as in --symbol disc:4)" : "");
}

bool gis_layer_input_read(const gis_options *options, gis_layer_input *out, gis_error *error)
{
    if (!start_reading(options, out, error))
        return false;
    out->feature = calloc(out->n + 1, sizeof *out->feature);
    if (!out->feature)
        return gis_no_memory(error);
    if (!gis_layer_lengths(out, error) || !make_shapes(out, error))
        return false;
    for (size_t i = 0; i < out->n; i++) {
        bool there = out->shape[i] && !sunder_shape_is_empty(out->shape[i]);
        out->feature[i] = (sunder_feature){.weight = 1, .max_shift = out->max_shift, .block = -1, .ignored = !there};
    }
    gis_layer_warn_of_crs(out);
    warn_of_others(out);
    return gis_layer_marks(out, error) && gis_layer_blocks(out, error) && gis_layer_weights(out, error) &&
           make_layer(out, error);
}

void gis_layer_input_clear(gis_layer_input *input)
{
    sunder_layer_free(input->layer);
    for (size_t i = 0; input->shape && i < input->n; i++)
        sunder_shape_free(input->shape[i]);
    free(input->shape);
    free(input->feature);
    gis_source_close(input->source);
    *input = (gis_layer_input){0};
}
