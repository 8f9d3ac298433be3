/* operand.c: the operands of sum and pair, shapes of options, and what the options ask of a source. */
#include "read/operand.h"

#include "base/interrupt.h"
#include "base/message.h"
#include "options/progress.h"
#include "read/source_files.h"

#include <cpl_conv.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

gis_invalid gis_options_invalid(const gis_options *options)
{
    switch (options->text[OPT_INVALID][0]) {
    case 's':
        return GIS_INVALID_SKIP;
    case 'f':
        return GIS_INVALID_FAIL;
    default:
        return GIS_INVALID_REPAIR;
    }
}

gis_source_request gis_options_source(const gis_options *options, const char *path, unsigned takes)
{
    return (gis_source_request){
        .path = path,
        .drivers = options->list[OPT_IF],
        .open_options = options->list[OPT_OO],
        .layer = options->text[OPT_INPUT_LAYER],
        .sql = options->text[OPT_SQL],
        .dialect = options->text[OPT_DIALECT],
        .where = options->text[OPT_WHERE],
        .bbox = options->given[OPT_BBOX] ? options->box : NULL,
        .input_crs = options->text[OPT_INPUT_CRS],
        .takes = takes,
    };
}

/* Appends the polygons of one feature, after the rule of --invalid: each feature is judged by itself, so that the one
 * at fault can be named. */
static bool append_feature(const gis_source *source, size_t i, const gis_rings *rings, gis_invalid policy,
                           gis_polygons *all, bool *any_invalid, gis_error *error)
{
    char who[512];
    snprintf(who, sizeof who, "layer %s, FID " CPL_FRMT_GIB, gis_source_name(source), gis_source_fid(source, i));
    if (rings->linearised > 0)
        gis_say_warning("%s: its arcs are taken as polylines that differ from them by up to %g", who,
                        rings->linearised);
    sunder_shape *alone = NULL;
    bool invalid;
    gis_error reason;
    bool ok = gis_shape_of_polygons(&rings->set, policy, who, &alone, &invalid, &reason, error);
    sunder_shape_free(alone);
    if (!ok && !(invalid && policy == GIS_INVALID_SKIP))
        return false;
    if (invalid)
        gis_say_warning("%s: %s; %s", who, reason.message,
                        ok ? "taken as what its rings enclose by the even-odd rule" : "skipped");
    if (!ok)
        return true;
    *any_invalid = *any_invalid || invalid;
    const gis_polygons *set = &rings->set;
    for (size_t p = 0; p < set->polygons; p++)
        if (!gis_polygons_append(all, set, p ? set->poly_end[p - 1] : 0, set->poly_end[p], error))
            return false;
    return true;
}

static bool shape_of_layer(const gis_source *source, gis_invalid policy, const char *who, sunder_shape **out,
                           double *building, gis_error *error)
{
    gis_polygons all = {0};
    gis_rings rings = {0};
    bool ok = true, any_invalid = false;
    for (size_t i = 0; ok && i < gis_source_count(source); i++)
        if (gis_source_content(source, i) == GIS_POLYGONS)
            ok = gis_go_on(error) && gis_geometry_rings(gis_source_geometry(source, i), &rings, error) &&
                 append_feature(source, i, &rings, policy, &all, &any_invalid, error);
    if (ok) {
        sunder_error why;
        double begin = gis_clock();
        ok = gis_polygons_shape(&all, any_invalid ? SUNDER_VALIDITY_EVEN_ODD : SUNDER_VALIDITY_STRICT, out, &why) == SUNDER_OK ||
             gis_fail(error, "%s: %s", who, why.message);
        if (building)
            *building += gis_clock() - begin;
    }
    gis_rings_clear(&rings);
    gis_polygons_clear(&all);
    return ok;
}

bool gis_shape_from_source(const gis_options *options, const char *path, const char *who, gis_source **source,
                           sunder_shape **out, double *building, gis_error *error)
{
    gis_source_request request = gis_options_source(options, path, GIS_TAKES_POLYGONS);
    gis_source *opened;
    const char *meant = gis_shape_prefix_meant(path);
    if (!gis_source_open(&request, &opened, error)) {
        if (meant && access(path, F_OK) != 0)
            gis_fail(error, "%s (%s): no such file, and no shape; did you mean %s?", who, path, meant);
        return false;
    }
    gis_say_warnings(gis_source_warnings(opened));
    if (!shape_of_layer(opened, gis_options_invalid(options), who, out, building, error)) {
        gis_source_close(opened);
        return false;
    }
    *source = opened;
    return true;
}

static bool may_be_same(OGRSpatialReferenceH p, OGRSpatialReferenceH q)
{
    return !gis_crs_is_known(p) || !gis_crs_is_known(q) || OSRIsSame(p, q);
}

static bool check_crs(const gis_operands *operands)
{
    OGRSpatialReferenceH p = operands->p_source ? gis_source_crs(operands->p_source) : NULL;
    OGRSpatialReferenceH q = operands->q_source ? gis_source_crs(operands->q_source) : NULL;
    return may_be_same(p, q);
}

/* ---- The shape of an option ----------------------------------------------------------------------------------- */

/* The options without those that select from the operands. */
static gis_options without_selection(const gis_options *options)
{
    static const gis_option_id selecting[] = {OPT_INPUT_LAYER, OPT_WHERE, OPT_SQL, OPT_DIALECT, OPT_BBOX,
                                              OPT_INPUT_CRS,   OPT_IF,    OPT_OO};
    gis_options plain = *options;
    for (size_t i = 0; i < sizeof selecting / sizeof *selecting; i++) {
        plain.given[selecting[i]] = false;
        plain.text[selecting[i]] = NULL;
        plain.list[selecting[i]] = NULL;
    }
    return plain;
}

bool gis_shape_of_option(const gis_options *options, gis_option_id id, const gis_ruler *rule, OGRSpatialReferenceH crs,
                         gis_source **source, sunder_shape **out, gis_error *error)
{
    const char *name = gis_option_table[id].names, *text = options->text[id];
    gis_source *opened = NULL;
    sunder_shape *shape = NULL;
    bool ok;
    if (gis_shape_is_text(text)) {
        ok = gis_shape_from_text(text, name, rule, gis_options_invalid(options), &shape, NULL, error);
    } else {
        gis_options plain = without_selection(options);
        ok = gis_shape_from_source(&plain, text, name, &opened, &shape, NULL, error) &&
             (may_be_same(crs, gis_source_crs(opened)) ||
              gis_fail(error, "%s %s has another CRS than the layer; reproject one of them first", name, text));
    }
    if (ok && sunder_shape_is_empty(shape))
        ok = gis_fail_usage(error, "%s %s: it encloses nothing", name, text);
    if (!ok) {
        sunder_shape_free(shape);
        gis_source_close(opened);
        return false;
    }
    *out = shape;
    if (opened)
        *source = opened;
    return true;
}

/* ---- P and Q -------------------------------------------------------------------------------------------------- */

/* Sources first: their CRS gives lengths in the other operand their meaning. */
bool gis_operands_read(const gis_options *options, gis_operands *out, gis_error *error)
{
    static const char *const names[2] = {"P", "Q"};
    gis_operands read = {0};
    sunder_shape **shape[2] = {&read.p, &read.q};
    gis_source **source[2] = {&read.p_source, &read.q_source};
    bool ok = true, any_source = false;
    if (strcmp(options->operand[0], "@-") == 0 && strcmp(options->operand[1], "@-") == 0)
        return gis_fail_usage(error, "P and Q cannot both be read from standard input");
    for (int i = 0; ok && i < 2; i++) {
        if (gis_shape_is_text(options->operand[i]))
            continue;
        any_source = true;
        ok = gis_shape_from_source(options, options->operand[i], names[i], source[i], shape[i], &read.building,
                                   error);
        if (ok && !gis_crs_is_known(read.crs))
            read.crs = gis_source_crs(*source[i]);
    }
    if (ok && !check_crs(&read))
        ok = gis_fail(error, "P and Q have different CRSs; reproject one of them first");
    static const gis_option_id of_sources[] = {OPT_INPUT_LAYER, OPT_WHERE, OPT_SQL, OPT_BBOX,
                                               OPT_INPUT_CRS,   OPT_IF,    OPT_OO};
    for (size_t i = 0; ok && !any_source && i < sizeof of_sources / sizeof *of_sources; i++)
        if (options->given[of_sources[i]])
            ok = gis_fail_usage(error, "%.*s selects from a data source, and neither P nor Q is one",
                                (int)strcspn(gis_option_table[of_sources[i]].names, " "),
                                gis_option_table[of_sources[i]].names);
    read.rule = gis_ruler_of(read.crs, options);
    for (int i = 0; ok && i < 2; i++)
        if (!*source[i])
            ok = gis_shape_from_text(options->operand[i], names[i], &read.rule, gis_options_invalid(options), shape[i],
                                     &read.building, error);
    if (ok)
        *out = read;
    else
        gis_operands_clear(&read);
    return ok;
}

const gis_source *gis_operands_source(const gis_operands *operands)
{
    return operands->p_source ? operands->p_source : operands->q_source;
}

bool gis_source_spare(const gis_source *source, const gis_options *options, const char *output, gis_error *error)
{
    if (!options->given[OPT_UPDATE] && gis_source_lies_in(source, output))
        return gis_fail(error, "%s is an input; give another output, or --update with new layer names", output);
    return true;
}

bool gis_operands_spare(const gis_operands *operands, const gis_options *options, const char *output, gis_error *error)
{
    return gis_source_spare(operands->p_source, options, output, error) &&
           gis_source_spare(operands->q_source, options, output, error);
}

void gis_operands_clear(gis_operands *operands)
{
    sunder_shape_free(operands->p);
    sunder_shape_free(operands->q);
    gis_source_close(operands->p_source);
    gis_source_close(operands->q_source);
    *operands = (gis_operands){0};
}
