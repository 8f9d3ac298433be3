/* sheet_moving.c: the layers of a sheet that move. The first becomes INPUT and its rules options of the command. For
 * each other one there is a copy of the options, which has the rules of that layer instead. */
#include "sheet/sheet_inner.h"

#include "base/path.h"

#include <cpl_conv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const gis_sheet_moving_keys[] = {"name", "source", "layer", "role", "class", "crs", "legible", NULL};

bool gis_sheet_is_moving(struct json_object *layer)
{
    const char *role = json_object_get_string(gis_sheet_member(layer, "role"));
    return role && strcmp(role, "move") == 0;
}

static bool set_text(const gis_sheet *sheet, const char *text, const char *place, gis_option_id id,
                     gis_options *options, gis_error *error)
{
    gis_error why;
    if (!text || options->given[id] || !(gis_option_table[id].commands & options->command->bit)) return true;
    return gis_options_set(options, id, text, &why) || gis_sheet_fail(sheet, error, place, "%s", why.message);
}

/* ---- What is read ------------------------------------------------------------------------------------------------ */

/* Makes the source the first operand. */
static bool set_operands(gis_options *options, gis_error *error)
{
    if (options->n_operands >= options->command->most)
        return gis_fail_usage(error, "--spec names the layer that moves; leave out INPUT");
    for (size_t k = options->n_operands; k > 0; k--) options->operand[k] = options->operand[k - 1];
    options->operand[0] = options->original_source;
    options->n_operands++;
    return true;
}

/* A result that check was given as INPUT has layers with the names of the sheet, if there are several. */
static bool set_source(const gis_sheet *sheet, struct json_object *layer, const char *place, gis_options *options,
                       gis_error *error)
{
    const bool result = options->command->bit == GIS_CHECK && options->n_operands > 0;
    const char *source, *crs;
    if (!gis_sheet_text(sheet, layer, place, "source", &source, error) ||
        !gis_sheet_text(sheet, layer, place, "layer", &options->original_layer, error) ||
        !gis_sheet_text(sheet, layer, place, "crs", &crs, error))
        return false;
    char *path = gis_sheet_dataset(sheet, source);
    const bool kept = gis_options_own(options, path, &options->original_source, error);
    CPLFree(path);
    if (!kept || (!result && !set_operands(options, error))) return false;
    const char *name = !result ? options->original_layer : sheet->moving > 1 ? options->layer_name : NULL;
    return set_text(sheet, name, place, OPT_INPUT_LAYER, options, error) &&
           set_text(sheet, crs, place, OPT_INPUT_CRS, options, error);
}

/* ---- Names and rules --------------------------------------------------------------------------------------------- */

/* The name of one layer is --output-layer, unless the command line gave that. The names of several are their own;
 * --output-layer is what the names of the other results begin with. */
static bool set_name(const gis_sheet *sheet, struct json_object *layer, const char *place, gis_options *options,
                     gis_error *error)
{
    const char *name;
    if (!gis_sheet_text(sheet, layer, place, "name", &name, error)) return false;
    if (sheet->moving > 1) {
        options->layer_name = name;
        options->sheet_name = options->given[OPT_OUTPUT_LAYER] ? options->text[OPT_OUTPUT_LAYER] : sheet->stem;
        return name || gis_sheet_fail(sheet, error, place, "\"name\" is missing: several layers move");
    }
    return options->command->bit == GIS_CHECK || set_text(sheet, name, place, OPT_OUTPUT_LAYER, options, error);
}

bool gis_sheet_is_common(gis_option_id id)
{
    static const gis_option_id common[] = {OPT_GAP,     OPT_LEAST_GAP, OPT_TOUCH_TOLERANCE, OPT_CONTAINED,
                                           OPT_EASE,    OPT_EFFORT,    OPT_ROW_STIFFNESS,   OPT_SEED,
                                           OPT_CROSSED, OPT_TRIM_KEEP, OPT_LIST_INSIDE};
    for (size_t k = 0; k < sizeof common / sizeof *common; k++)
        if (common[k] == id) return true;
    return false;
}

/* If several layers move, refuses a rule of one layer that holds for all of them. */
static bool check_common(const gis_sheet *sheet, struct json_object *layer, const char *place, gis_error *error)
{
    for (int id = 0; id < OPT_N && sheet->moving > 1; id++) {
        char key[64];
        if (gis_sheet_is_common((gis_option_id)id) && gis_rule_key(&gis_option_table[id], key, sizeof key) &&
            gis_sheet_member(layer, key))
            return gis_sheet_fail(sheet, error, place, "%s holds for all layers that move: put it into \"defaults\"%s",
                                  key, id == OPT_GAP || id == OPT_LEAST_GAP ? " or \"gaps\"" : "");
    }
    return true;
}

static bool apply_moving(gis_sheet *sheet, size_t k, struct json_object *layer, const char *place, gis_options *options,
                         gis_error *error)
{
    struct json_object *defaults = gis_sheet_member(sheet->root, "defaults");
    const char *class;
    gis_gap_classes *gaps = &sheet->of_layer[k].gaps;
    gis_legible_rules *legible = &sheet->of_layer[k].legible;
    if (!gis_sheet_check_keys(sheet, layer, place, gis_sheet_moving_keys, true, error) ||
        !check_common(sheet, layer, place, error) ||
        !gis_sheet_read_class(sheet, layer, place, &class, &gaps->field, error))
        return false;
    gaps->of_features = class ? gis_sheet_class(sheet, class) : 0;
    sheet->classes_by_field = sheet->classes_by_field || gaps->field;
    return set_name(sheet, layer, place, options, error) && set_source(sheet, layer, place, options, error) &&
           gis_sheet_read_legible(sheet, layer, place, legible, error) &&
           gis_sheet_read_legible(sheet, sheet->root, "", legible, error) &&
           gis_rules_set(sheet, layer, place, options, error) &&
           gis_rules_set(sheet, defaults, "defaults", options, error);
}

/* ---- All of them ------------------------------------------------------------------------------------------------- */

/* Makes the copies of the options before the first layer changes them. */
static bool copy_options(gis_sheet *sheet, gis_options *options, gis_error *error)
{
    gis_options *more = calloc(sheet->moving, sizeof *more);
    bool ok = more || gis_no_memory(error);
    for (size_t k = 0; ok && k + 1 < sheet->moving; k++) ok = gis_options_copy(options, &more[k], error);
    options->more = more;
    options->n_more = more ? sheet->moving - 1 : 0;
    return ok;
}

bool gis_sheet_apply_moving(gis_sheet *sheet, size_t n, gis_options *options, gis_error *error)
{
    struct json_object *layers = gis_sheet_member(sheet->root, "layers");
    sheet->moving = n;
    sheet->stem = gis_path_stem(sheet->path);
    sheet->of_layer = calloc(n, sizeof *sheet->of_layer);
    if (!sheet->of_layer) return gis_no_memory(error);
    if (n > 1 && !copy_options(sheet, options, error)) return false;
    for (size_t i = 0, k = 0; k < n; i++) {
        struct json_object *layer = json_object_array_get_idx(layers, i);
        char place[GIS_PLACE_SIZE];
        if (!gis_sheet_is_moving(layer)) continue;
        snprintf(place, sizeof place, "layers[%zu]", i);
        if (!apply_moving(sheet, k, layer, place, k ? &options->more[k - 1] : options, error)) return false;
        k++;
    }
    return true;
}

void gis_sheet_lend_rules(gis_sheet *sheet, gis_options *options)
{
    gis_sheet_lend_gaps(sheet, options);
    for (size_t k = 0; k < sheet->moving; k++) {
        gis_options *own = k ? &options->more[k - 1] : options;
        gis_sheet_moving *of = &sheet->of_layer[k];
        const gis_gap_classes class = of->gaps;
        of->gaps = sheet->gaps;
        of->gaps.field = class.field;
        of->gaps.of_features = class.of_features;
        if (sheet->gaps.rules) own->gap_classes = &of->gaps;
        if (gis_legible_any_rule(&of->legible)) own->legible = &of->legible;
    }
}
