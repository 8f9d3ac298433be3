/* resolve.c: see resolve.h. Only this file, resolve_layer.c and resolve_common.c know how an option is spelled, which
 * value an option has that was not given, and which options depend on each other. The commands decide the order in
 * which requests are resolved and executed; it is the order in which errors are found. */
#include "commands/resolve_common.h"

#include "read/source_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The functions that name the enumerators, converted to one type. */
static const char *algorithm_word(unsigned i) { return sunder_algorithm_string((sunder_algorithm)i); }
static const char *decomposition_word(unsigned i) { return sunder_decomposition_string((sunder_decomposition)i); }
static const char *order_word(unsigned i) { return sunder_order_string((sunder_order)i); }
static const char *operation_word(unsigned i) { return sunder_operation_string((sunder_operation)i); }

static gis_shape_request resolve_shape(const gis_options *options, gis_option_id id, gis_invalid_policy invalid)
{
    return (gis_shape_request){gis_option_table[id].names, options->text[id], invalid};
}

bool gis_resolve_memory(const gis_options *options, double *bytes, gis_error *error)
{
    static const char units[] = "KMGT";
    const char *text = options->text[OPT_MAX_MEMORY];
    *bytes = 0;
    if (!text) return true;
    const size_t digits = strspn(text, "0123456789.");
    const char *unit = text[digits] ? strchr(units, text[digits]) : NULL;
    double size;
    if (!gis_length_parse_number(text, digits, &size) || !(size > 0) || (text[digits] && !unit) ||
        (unit && text[digits + 1]))
        return gis_fail_usage(error,
                              "--max-memory %s: not a size; expected bytes, or a number with K, M, G or T, as in "
                              "--max-memory 2G",
                              text);
    *bytes = size * (unit ? pow(1000, (double)(unit - units) + 1) : 1);
    return true;
}

/* Refuses options that select from a data source if both operands are texts. */
static bool check_selection(const gis_options *options, gis_error *error)
{
    static const gis_option_id of_sources[] = {OPT_INPUT_LAYER, OPT_WHERE, OPT_SQL, OPT_BBOX,
                                               OPT_INPUT_CRS,   OPT_IF,    OPT_OO};
    if (!gis_shape_is_text(options->operand[0]) || !gis_shape_is_text(options->operand[1])) return true;
    for (size_t i = 0; i < sizeof of_sources / sizeof *of_sources; i++)
        if (options->given[of_sources[i]])
            return gis_fail_usage(error, "%.*s selects from a data source, and neither P nor Q is one",
                                  (int)strcspn(gis_option_table[of_sources[i]].names, " "),
                                  gis_option_table[of_sources[i]].names);
    return true;
}

bool gis_resolve_operands(const gis_options *options, gis_operands_request *out, gis_error *error)
{
    *out = (gis_operands_request){
        .text = {options->operand[0], options->operand[1]},
        .source = gis_resolve_source(options),
        .scale = options->number[OPT_SCALE],
    };
    if (strcmp(options->operand[0], "@-") == 0 && strcmp(options->operand[1], "@-") == 0)
        return gis_fail_usage(error, "P and Q cannot both be read from standard input");
    return check_selection(options, error) && gis_resolve_invalid(options, &out->invalid, error);
}

bool gis_resolve_road(const gis_options *options, sunder_sum_options *out, gis_error *error)
{
    unsigned algorithm, decomposition, order;
    if (!gis_resolve_choice(options, OPT_ALGORITHM, algorithm_word, &algorithm, error) ||
        !gis_resolve_choice(options, OPT_DECOMPOSITION, decomposition_word, &decomposition, error) ||
        !gis_resolve_choice(options, OPT_ORDER, order_word, &order, error))
        return false;
    *out = (sunder_sum_options){
        .size = sizeof(sunder_sum_options),
        .algorithm = (sunder_algorithm)algorithm,
        .decomposition = (sunder_decomposition)decomposition,
        .order = (sunder_order)order,
        .seed = gis_resolve_seed(options),
        .keep_map = options->given[OPT_PLANAR_MAP],
    };
    const char *output = gis_resolve_output(options);
    if (!out->keep_map) return true;
    if (out->algorithm == SUNDER_ALGORITHM_CONVOLUTION)
        return gis_fail_usage(error, "--planar-map: the convolution makes no planar map; use --algorithm arrangement");
    if (!output || strcmp(output, "/vsistdout/") == 0)
        return gis_fail_usage(error, "--planar-map needs OUTPUT, in a format that holds several layers");
    return true;
}

bool gis_resolve_buffer(const gis_options *options, gis_buffer_request *out, gis_error *error)
{
    const char *shape = options->text[OPT_SHAPE];
    unsigned operation;
    if (!shape)
        return gis_fail_usage(error, "--shape is missing: the shape to grow or shrink by, as in --shape square:6");
    const char *meant = gis_shape_is_text(shape) || access(shape, F_OK) == 0 ? NULL : gis_shape_prefix_meant(shape);
    if (meant) return gis_fail_usage(error, "--shape %s: neither a file nor a shape; did you mean %s?", shape, meant);
    if (options->given[OPT_DISSOLVE] && options->given[OPT_DISSOLVE_FIELD])
        return gis_fail_usage(error, "--dissolve makes one set of all features, --dissolve-field one of each value: "
                                     "give one of them");
    *out = (gis_buffer_request){
        .dissolve = options->given[OPT_DISSOLVE] || options->given[OPT_DISSOLVE_FIELD],
        .dissolve_field = options->text[OPT_DISSOLVE_FIELD],
        .explode = options->given[OPT_EXPLODE],
        .align = options->given[OPT_ALIGN],
        .degenerate = options->given[OPT_DEGENERATE],
        .threads = gis_resolve_threads(options),
    };
    if (!gis_resolve_layer(options, &out->layer, error) ||
        !gis_resolve_choice(options, OPT_OPERATION, operation_word, &operation, error))
        return false;
    out->operation = (sunder_operation)operation;
    out->shape = resolve_shape(options, OPT_SHAPE, out->layer.invalid);
    return true;
}

static bool resolve_coordinate(const gis_options *options, gis_option_id id, gis_coordinate *out, gis_error *error)
{
    const char *name = gis_option_table[id].names, *text = options->text[id];
    if (!text) return gis_fail_usage(error, "%s X,Y is missing", name);
    return gis_coordinate_parse(text, out) ||
           gis_fail_usage(error, "%s %s: expected X,Y, each a decimal or num/den", name, text);
}

bool gis_resolve_route(const gis_options *options, gis_route_request *out, gis_error *error)
{
    *out = (gis_route_request){
        .obstacles = options->operand[0],
        .source = gis_resolve_source(options),
        .gap = gis_resolve_length(options, OPT_GAP),
        .scale = options->number[OPT_SCALE],
        .free_space = options->given[OPT_FREE_SPACE],
    };
    if (out->free_space && !gis_resolve_output(options))
        return gis_fail_usage(error, "--free-space needs OUTPUT: it writes layers");
    if (!resolve_coordinate(options, OPT_FROM, &out->from, error) ||
        !resolve_coordinate(options, OPT_TO, &out->to, error))
        return false;
    if (!options->text[OPT_ROBOT]) return gis_fail_usage(error, "--robot SHAPE is missing: the shape that moves");
    if (!gis_resolve_invalid(options, &out->invalid, error)) return false;
    out->robot = resolve_shape(options, OPT_ROBOT, out->invalid);
    return true;
}

/* Parses the text of --by: a word, or a word, a colon and a value. */
static bool resolve_by(const char *text, gis_follow_request *out, gis_error *error)
{
    static const char nearest[] = "nearest:", field[] = "field:";
    const char *why;
    if (!text || strcmp(text, "inside") == 0) return true;
    if (strncmp(text, nearest, strlen(nearest)) == 0) {
        out->by = GIS_FOLLOW_NEAREST;
        out->within.text = text + strlen(nearest);
        return gis_length_parse(out->within.text, strlen(out->within.text), &out->within.length, &why) ||
               gis_fail_usage(error, "--by %s: %s", text, why);
    }
    if (strncmp(text, field, strlen(field)) == 0 && text[strlen(field)]) {
        out->by = GIS_FOLLOW_FIELD;
        out->field = text + strlen(field);
        return true;
    }
    return gis_fail_usage(error, "--by %s: expected inside, nearest:LENGTH or field:NAME", text);
}

bool gis_resolve_follow(const gis_options *options, gis_follow_request *out, gis_error *error)
{
    *out = (gis_follow_request){
        .moved = {.path = options->operand[0]},
        .input = gis_resolve_source(options),
        .id_field = options->text[OPT_ID_FIELD],
        .scale = options->number[OPT_SCALE],
    };
    if (!resolve_by(options->text[OPT_BY], out, error)) return false;
    if (out->id_field && out->by != GIS_FOLLOW_FIELD)
        return gis_fail_usage(error, "--id-field: the field of MOVED that --by field:NAME names; give that, too");
    return gis_resolve_invalid(options, &out->invalid, error);
}

bool gis_resolve_along(const gis_options *options, const gis_along *along, gis_follow_request *out, gis_error *error)
{
    const char *name = along->name ? along->name : along->source;
    gis_error why;
    *out = (gis_follow_request){
        .input = {.path = along->source, .layer = along->layer, .where = along->where, .input_crs = along->crs},
        .name = along->name,
        .of = along->of,
        .id_field = along->id_field,
        .scale = options->number[OPT_SCALE],
    };
    if (!resolve_by(along->by, out, &why)) return gis_fail_usage(error, "--spec: layer %s: %s", name, why.message);
    if (out->id_field && out->by != GIS_FOLLOW_FIELD)
        return gis_fail_usage(error, "--spec: layer %s: id_field without \"by\": \"field:NAME\"", name);
    return gis_resolve_invalid(options, &out->invalid, error);
}

/* ---- Destinations of results ------------------------------------------------------------------------------------- */

gis_sink_request gis_resolve_sink(const gis_options *options, const char *path, const char *main_layer)
{
    return (gis_sink_request){
        .path = path,
        .format = options->text[OPT_OF],
        .layer_options = options->list[OPT_LCO],
        .dataset_options = options->list[OPT_CO],
        .main_layer = options->given[OPT_OUTPUT_LAYER] ? options->text[OPT_OUTPUT_LAYER] : main_layer,
        .overwrite = options->given[OPT_OVERWRITE],
        .update = options->given[OPT_UPDATE],
        .overwrite_layer = options->given[OPT_OVERWRITE_LAYER],
        .strict = options->given[OPT_STRICT],
        .allow_inexact = options->given[OPT_ALLOW_INEXACT_OUTPUT],
        .no_styles = options->given[OPT_NO_STYLES],
        .promote = options->given[OPT_NLT],
        .threads = gis_resolve_threads(options),
    };
}

gis_destinations gis_resolve_destinations(const gis_options *options)
{
    gis_destinations to = {.output = gis_resolve_output(options),
                           .stats = options->text[OPT_STATS],
                           .report = options->text[OPT_REPORT],
                           .proof = options->text[OPT_PROOF],
                           .trace = options->text[OPT_TRACE],
                           .sheet = options->text[OPT_SPEC]};
    for (size_t i = 0; i + 1 < options->command->most; i++) to.input[i] = options->operand[i];
    static const gis_option_id shapes[] = {OPT_SHAPE, OPT_ROBOT, OPT_SYMBOL};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) to.shape[i] = options->text[shapes[i]];
    return to;
}

gis_progress gis_resolve_progress(const gis_options *options)
{
    bool json = strcmp(options->text[OPT_MESSAGES], "json") == 0;
    bool layers =
        (options->command->bit & (GIS_LAYERS | GIS_BUFFER | GIS_MERGE | GIS_FOLLOW)) || gis_resolve_output(options);
    gis_progress_kind kind = layers && !json && isatty(STDERR_FILENO) ? GIS_PROGRESS_BAR : GIS_PROGRESS_NONE;
    if (options->given[OPT_PROGRESS]) kind = options->text[OPT_PROGRESS] ? GIS_PROGRESS_PLAIN : GIS_PROGRESS_BAR;
    return gis_progress_new(options->given[OPT_QUIET] ? GIS_PROGRESS_NONE : kind);
}

/* Refuses a log whose path is also an operand, the value of another option, or the dataset of a barrier. This is
 * checked here since the log is opened before anything else. */
static bool spare_named(const gis_options *options, const char *log, gis_error *error)
{
    bool named = false;
    for (size_t i = 0; i < options->n_operands; i++) {
        const char *operand = options->operand[i];
        named = named || gis_path_lies_in(operand + (*operand == '@'), log);
    }
    for (int id = 0; id < OPT_N; id++) {
        const char *text = id == OPT_LOG ? NULL : options->text[id];
        named = named || (text && gis_path_lies_in(text + (*text == '@'), log));
    }
    for (const char *const *each = options->list[OPT_BARRIER]; !named && each && *each; each++) {
        gis_barrier_request barrier = {0};
        gis_error ignored; /* an invalid barrier is reported when barriers are read */
        named = gis_barrier_parse(*each, &barrier, &ignored) && gis_path_lies_in(barrier.dataset, log);
        gis_barrier_request_clear(&barrier);
    }
    return !named || gis_fail_usage(error, "--log %s: that file has another use in this run; give another one", log);
}

bool gis_resolve_messages(const gis_options *options, gis_messages_request *out, gis_error *error)
{
    const char *log = options->text[OPT_LOG];
    *out = (gis_messages_request){strcmp(options->text[OPT_MESSAGES], "json") == 0, options->given[OPT_QUIET], log};
    return !log || spare_named(options, log, error);
}
