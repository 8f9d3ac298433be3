/* shapes.c: makes shapes of features: polygons as they are, arcs as polylines enlarged to contain the arc, points as
 * the symbol drawn at them. Features that cannot conflict (null, empty, of another kind, or invalid with --invalid
 * skip) have no shape and are output as skipped. */
#include "layer/layer_input.h"
#include "layer/shapes_ahead.h"

#include "base/core_error.h"
#include "base/interrupt.h"
#include "base/message.h"
#include "geometry/round/round.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Number of vertices of the polygon by which a shape with arcs is enlarged. With 16 it reaches a fiftieth farther than
 * the disc that it contains; the radius of this disc is less than a thousandth of the arc's (GDAL's chords span four
 * degrees). */
static const unsigned growth_segments = 16;

#define SYMBOL_FORMS "WKT, @FILE, disc:R[:N], inside-disc:R[:N], square:SIDE or rectangle:WxH"

/* Additions to the radius. Rounding the sum to doubles may move vertices inward by less than four units in the last
 * place of the largest coordinate; twice that is added. The radius itself has a relative error of about 1e-16; a
 * billionth is added, which is invisible. */
static const double grown_ulps = 8, grown_part = 1e-9;

/* Enlarges a shape by a polygon that contains the disc of this radius, and rounds the result to doubles. */
static bool grow_shape(const sunder_shape *shape, double radius, const char *who, sunder_shape **out, gis_error *error)
{
    double box[4], most = 0;
    sunder_shape_box(shape, box);
    for (int i = 0; i < 4; i++) most = fmax(most, fabs(box[i]));
    radius = radius * (1 + grown_part) + grown_ulps * (nextafter(most, INFINITY) - most);
    sunder_shape *disc = NULL, *grown = NULL;
    sunder_sum *sum = NULL;
    gis_rounded rounded = {0};
    sunder_error why;
    bool ok = sunder_shape_disc(radius, growth_segments, false, &disc, &why) == SUNDER_OK &&
              sunder_minkowski_sum(shape, disc, NULL, &sum, &why) == SUNDER_OK;
    if (!ok) gis_core_failed(error, who, &why);
    ok = ok && gis_round_sum(sum, &rounded, error);
    if (ok && gis_polygons_shape(&rounded.set, SUNDER_VALIDITY_STRICT, &grown, &why) != SUNDER_OK)
        ok = gis_core_failed(error, who, &why);
    gis_rounded_clear(&rounded);
    sunder_sum_free(sum);
    sunder_shape_free(disc);
    if (ok) *out = grown;
    return ok;
}

static bool polygon_shape(gis_layer_input *input, size_t i, gis_polygonal_part *part, gis_error *error)
{
    char who[GIS_WHO_SIZE];
    sunder_shape *shape = NULL, *grown;
    bool invalid;
    if (!gis_source_polygons(input->source, i, part, error)) return false;
    if (input->request->wound) gis_polygons_wind(&part->set);
    /* Almost all polygons are valid and without arcs; no name is needed for them. */
    if (gis_layer_plain_shape(input, part, i)) return true;
    gis_feature_name(input, i, who, sizeof who);
    if (!gis_shape_of_feature(&part->set, input->request->invalid, who, "invalid: ", &shape, &invalid, error))
        return false;
    input->invalid += invalid;
    if (part->linearised > 0 && input->as_chords)
        gis_say_warning(GIS_MESSAGE_ARCS, "%s: its arcs are taken as polylines that differ from them by up to %g", who,
                        part->linearised);
    else if (part->linearised > 0 && shape && !sunder_shape_is_empty(shape)) {
        if (!grow_shape(shape, part->linearised, who, &grown, error)) {
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
        return gis_core_failed(error, who, &why);
    bool ok = gis_polygons_append_shape(all, moved, 0, 0, error);
    sunder_shape_free(moved);
    return ok;
}

/* Makes the shape of feature i: the symbol at each of its points; for several points their union. */
static bool place_symbol(gis_layer_input *input, size_t i, const sunder_shape *symbol, const char *who,
                         gis_error *error)
{
    double *at;
    size_t n;
    gis_polygons all = {0};
    if (!gis_geometry_points(gis_source_geometry(input->source, i), &at, &n, error)) return false;
    bool ok = true;
    for (size_t k = 0; ok && k < n; k++) ok = append_translate(symbol, at + 2 * k, &all, who, error);
    CPLFree(at);
    sunder_error why;
    /* A symbol that becomes invalid by rounding at its place is read by the even-odd rule. */
    if (ok && gis_polygons_shape(&all, SUNDER_VALIDITY_STRICT, &input->shape[i], &why) != SUNDER_OK &&
        gis_polygons_shape(&all, SUNDER_VALIDITY_EVEN_ODD, &input->shape[i], &why) != SUNDER_OK)
        ok = gis_core_failed(error, who, &why);
    gis_polygons_clear(&all);
    return ok;
}

static bool read_symbol(const gis_layer_input *input, const char *text, const char *who, sunder_shape **out,
                        gis_error *error)
{
    sunder_shape *symbol;
    if (!gis_shape_from_text(text, who, &input->units, input->request->invalid, &symbol, NULL, error)) return false;
    if (sunder_shape_is_empty(symbol)) {
        sunder_shape_free(symbol);
        return gis_fail_usage(error, "%s (%s): the symbol is empty; it must have an area", who, text);
    }
    *out = symbol;
    return true;
}

/* State for making shapes: `part` is a buffer for the polygons of a feature; the other members are for points. */
struct gis_layer_shaping {
    gis_polygonal_part part;
    sunder_shape *symbol; /* the common symbol; NULL: each point has its own */
    int symbol_field;     /* -1: not given */
    int size_field;       /* -1: symbols are not scaled */
};

/* Reads --symbol, --symbol-field and --symbol-size-field. */
static bool read_symbols(const gis_layer_input *input, gis_layer_shaping *how, gis_error *error)
{
    const gis_layer_input_request *request = input->request;
    const char *symbol = request->symbol;
    if (!gis_field_find(input->source, "--symbol-field", request->symbol_field, &how->symbol_field, error) ||
        !gis_field_find_numbers(input->source, "--symbol-size-field", request->symbol_size_field, &how->size_field,
                                error))
        return false;
    if (!symbol) return true;
    if (!gis_shape_is_text(symbol)) return gis_fail_usage(error, "--symbol %s: expected " SYMBOL_FORMS, symbol);
    return read_symbol(input, symbol, "--symbol", &how->symbol, error);
}

/* Reads the feature's own symbol from --symbol-field; *own stays NULL if it is blank and the common one is used. */
static bool own_symbol(const gis_layer_input *input, size_t i, const gis_layer_shaping *how, const char *who,
                       sunder_shape **own, gis_error *error)
{
    OGRFeatureH feature = gis_source_feature(input->source, i);
    if (how->symbol_field < 0 || gis_field_is_blank(feature, how->symbol_field))
        return how->symbol || gis_fail(error, "%s: %s is null, and there is no --symbol to use instead", who,
                                       input->request->symbol_field);
    const char *text = OGR_F_GetFieldAsString(feature, how->symbol_field);
    if (!gis_shape_is_text(text))
        return gis_fail(error, "%s: %s in %s is not a symbol; expected " SYMBOL_FORMS, who, text,
                        input->request->symbol_field);
    if (read_symbol(input, text, who, own, error)) return true;
    error->exit_status = GIS_FAILED; /* the data are wrong, not the command line */
    return false;
}

/* Scales a shape by a factor; vertices are rounded, and if that makes it invalid, it is read by the even-odd rule. */
static bool scale_shape(const sunder_shape *shape, double factor, const char *who, sunder_shape **out, gis_error *error)
{
    gis_polygons all = {0};
    sunder_error why;
    bool ok = gis_polygons_append_shape(&all, shape, 0, 0, error);
    for (size_t k = 0; ok && k < 2 * all.vertices; k++) all.xy[k] *= factor;
    if (ok && gis_polygons_shape(&all, SUNDER_VALIDITY_STRICT, out, &why) != SUNDER_OK &&
        gis_polygons_shape(&all, SUNDER_VALIDITY_EVEN_ODD, out, &why) != SUNDER_OK)
        ok = gis_core_failed(error, who, &why);
    gis_polygons_clear(&all);
    return ok;
}

static bool place_enlarged(gis_layer_input *input, size_t i, int size_field, const sunder_shape *symbol,
                           const char *who, gis_error *error)
{
    OGRFeatureH feature = gis_source_feature(input->source, i);
    if (size_field < 0 || gis_field_is_blank(feature, size_field)) return place_symbol(input, i, symbol, who, error);
    sunder_shape *larger = NULL;
    double factor = gis_field_number(feature, size_field);
    if (!(factor > 0) || !isfinite(factor))
        return gis_layer_wrong_number(input, i, size_field, "size of the symbol", "a finite number greater than 0",
                                      error);
    if (!scale_shape(symbol, factor, who, &larger, error)) return false;
    bool ok = sunder_shape_is_empty(larger)
                  ? gis_fail(error, "%s: its symbol times %g is too small to have an area in doubles", who, factor)
                  : place_symbol(input, i, larger, who, error);
    sunder_shape_free(larger);
    return ok;
}

static bool point_shape(gis_layer_input *input, size_t i, const gis_layer_shaping *how, gis_error *error)
{
    char who[GIS_WHO_SIZE];
    sunder_shape *own = NULL;
    gis_feature_name(input, i, who, sizeof who);
    bool ok = own_symbol(input, i, how, who, &own, error) &&
              place_enlarged(input, i, how->size_field, own ? own : how->symbol, who, error);
    sunder_shape_free(own);
    return ok;
}

/* Warns of a feature with a coordinate that is not finite, which --invalid skip lets through. */
static void skip_broken(gis_layer_input *input, size_t i)
{
    char who[GIS_WHO_SIZE];
    gis_feature_name(input, i, who, sizeof who);
    gis_say_warning(GIS_MESSAGE_INVALID, "%s: invalid: a coordinate is not a finite number; skipped", who);
    input->invalid++;
}

void gis_layer_shaping_free(gis_layer_shaping *shaping)
{
    if (!shaping) return;
    sunder_shape_free(shaping->symbol);
    gis_polygonal_part_clear(&shaping->part);
    free(shaping);
}

/* Reads the symbols that options give; only once, not for each batch. */
static bool begin_shaping(gis_layer_input *input, gis_error *error)
{
    if (input->shaping) return true;
    input->shaping = calloc(1, sizeof *input->shaping);
    if (!input->shaping) return gis_no_memory(error);
    input->shaping->symbol_field = input->shaping->size_field = -1;
    return !input->points || read_symbols(input, input->shaping, error);
}

bool gis_layer_shapes(gis_layer_input *input, gis_error *error)
{
    gis_content wanted = input->points ? GIS_POINTS : GIS_POLYGONS;
    bool ok = begin_shaping(input, error);
    if (ok) gis_layer_shapes_ahead(input);
    for (size_t i = 0; ok && i < input->n; i++) {
        gis_content content = gis_source_content(input->source, i);
        input->null += content == GIS_NOTHING;
        input->other += content != GIS_NOTHING && content != GIS_BROKEN && content != wanted;
        if (content == GIS_BROKEN) skip_broken(input, i);
        ok = gis_go_on(error);
        if (ok && content == wanted && !input->shape[i])
            ok = input->points ? point_shape(input, i, input->shaping, error)
                               : polygon_shape(input, i, &input->shaping->part, error);
    }
    return ok;
}
