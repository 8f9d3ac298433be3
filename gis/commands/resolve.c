/* resolve.c: see resolve.h. Only this file knows how an option is spelled, which value an option has that was not
 * given, and which options depend on each other. The commands decide the order in which requests are resolved and
 * executed; it is the order in which errors are found. */
#include "commands/resolve.h"

#include "read/source_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Words of enumerations --------------------------------------------------------------------------------------- */

/* *number becomes the index of the option's value in an enumeration. word(i) is the name of enumerator i; "" marks the
 * end. Fails if the enumeration has no such name, that is, if it and the table of options differ. */
static bool resolve_choice(const gis_options *options, gis_option_id id, const char *(*word)(unsigned),
                           unsigned *number, gis_error *error)
{
    const char *given = options->text[id];
    for (unsigned i = 0; word(i)[0]; i++)
        if (given && strcmp(word(i), given) == 0) {
            *number = i;
            return true;
        }
    gis_fail_usage(error, "%s: the library does not know the name %s", gis_option_table[id].names,
                   given ? given : "(none)");
    return false;
}

/* The functions that name the enumerators, converted to one type. */
static const char *algorithm_word(unsigned i) { return sunder_algorithm_string((sunder_algorithm)i); }
static const char *decomposition_word(unsigned i) { return sunder_decomposition_string((sunder_decomposition)i); }
static const char *order_word(unsigned i) { return sunder_order_string((sunder_order)i); }
static const char *operation_word(unsigned i) { return sunder_operation_string((sunder_operation)i); }
static const char *invalid_word(unsigned i) { return gis_invalid_string((gis_invalid_policy)i); }
static const char *weighting_word(unsigned i) { return gis_weighting_string((gis_weighting)i); }
static const char *containment_word(unsigned i) { return sunder_containment_string((sunder_containment)i); }

/* The words of sunder_crossed. */
static const char *crossed_word(unsigned i)
{
    static const char *const words[] = {
        [SUNDER_CROSSED_HIDE] = "hide", [SUNDER_CROSSED_TRIM] = "trim", [SUNDER_CROSSED_KEEP] = "keep"};
    return i < sizeof words / sizeof *words ? words[i] : "";
}

static bool resolve_invalid(const gis_options *options, gis_invalid_policy *out, gis_error *error)
{
    unsigned policy;
    if (!resolve_choice(options, OPT_INVALID, invalid_word, &policy, error)) return false;
    *out = (gis_invalid_policy)policy;
    return true;
}

/* ---- Parts that several requests have ---------------------------------------------------------------------------- */

/* The largest number of threads that is used. If an option asks for more, which is probably a typing error, this
 * many are used, without a message. */
static const double most_threads = 4096;

static uint64_t seed_of(const gis_options *options)
{
    return options->given[OPT_SEED] ? (uint64_t)options->number[OPT_SEED] : 0;
}

/* Returns the number of threads; 0: one for each processor. */
static unsigned thread_count(const gis_options *options)
{
    return options->given[OPT_THREADS] ? (unsigned)fmin(options->number[OPT_THREADS], most_threads) : 0;
}

gis_optional_length gis_resolve_length(const gis_options *options, gis_option_id id)
{
    return (gis_optional_length){options->text[id], options->length[id]};
}

/* Returns the operand OUTPUT, which is the last operand of every command; NULL if it was not given. */
static const char *output_of(const gis_options *options) { return options->operand[options->command->most - 1]; }

/* Returns the request for the operand that messages call INPUT or OBSTACLES. */
static gis_source_request resolve_source(const gis_options *options)
{
    return (gis_source_request){
        .path = options->operand[options->command->bit == GIS_FOLLOW ? 1 : 0],
        .drivers = options->list[OPT_IF],
        .open_options = options->list[OPT_OO],
        .layer = options->text[OPT_INPUT_LAYER],
        .sql = options->text[OPT_SQL],
        .dialect = options->text[OPT_DIALECT],
        .where = options->text[OPT_WHERE],
        .bbox = options->given[OPT_BBOX] ? options->box : NULL,
        .input_crs = options->text[OPT_INPUT_CRS],
    };
}

static gis_shape_request resolve_shape(const gis_options *options, gis_option_id id, gis_invalid_policy invalid)
{
    return (gis_shape_request){gis_option_table[id].names, options->text[id], invalid};
}

/* ---- The requests of the commands -------------------------------------------------------------------------------- */

/* Sets how contained features are treated. By default points are separated, since symbols that lie on each other are
 * the purpose of separating points; polygons have the default of --contained. */
static bool resolve_contained(const gis_options *options, sunder_containment *out, gis_error *error)
{
    bool points = options->given[OPT_SYMBOL] || options->given[OPT_SYMBOL_FIELD];
    unsigned contained = SUNDER_CONTAINMENT_SEPARATE;
    if (!(points && !options->given[OPT_CONTAINED]) &&
        !resolve_choice(options, OPT_CONTAINED, containment_word, &contained, error))
        return false;
    *out = (sunder_containment)contained;
    return true;
}

/* The field of --rows; NULL if it is auto or no. */
static const char *rows_field_of(const gis_options *options)
{
    const char *text = options->text[OPT_ROWS];
    return text && strcmp(text, "auto") != 0 && strcmp(text, "no") != 0 ? text : NULL;
}

/* Rows are of polygons: the layers of points are those with a symbol, and have none unless said. The command check
 * takes rows from the original layer alone (gis_resolve_original()). */
static bool resolve_rows(const gis_options *options, gis_layer_rules *out, gis_error *error)
{
    const bool points = options->given[OPT_SYMBOL] || options->given[OPT_SYMBOL_FIELD],
               moves = options->command->bit != GIS_CHECK || options->given[OPT_BEFORE];
    const char *usual = points || !moves ? "no" : "auto",
               *text = options->given[OPT_ROWS] ? options->text[OPT_ROWS] : usual, *field = rows_field_of(options);
    const bool wanted = strcmp(text, "no") != 0;
    out->core.rows = field ? SUNDER_ROWS_GIVEN : wanted ? SUNDER_ROWS_FOUND : SUNDER_ROWS_NONE;
    out->rows_field = options->command->bit == GIS_CHECK ? NULL : field;
    if (!wanted || !points) return true;
    return gis_fail_usage(error, "--rows: rows are found among polygons, and the symbols of points have none");
}

/* Reads K or K,K_ALONG; K alone keeps the default along rows. */
static bool resolve_stiffness(const gis_options *options, double stiffness[2], gis_error *error)
{
    const char *text = options->text[OPT_ROW_STIFFNESS];
    if (!text) return true;
    const size_t n = strcspn(text, ",");
    if (gis_length_parse_number(text, n, &stiffness[0]) && stiffness[0] > 0 &&
        (!text[n] || (gis_length_parse_number(text + n + 1, strlen(text + n + 1), &stiffness[1]) && stiffness[1] > 0)))
        return true;
    return gis_fail_usage(error, "--row-stiffness %s: not one or two numbers above 0, as in --row-stiffness 3,0.3",
                          text);
}

/* The price unless --ease gives one. */
static const double usual_ease = 30;

static bool resolve_ease(const gis_options *options, double *ease, gis_error *error)
{
    const char *text = options->text[OPT_EASE];
    if (!text && options->command->bit != GIS_CHECK) *ease = usual_ease;
    if (!text || strcmp(text, "no") == 0) return true;
    if (!gis_length_parse_number(text, strlen(text), ease) || !(*ease > 0))
        return gis_fail_usage(error, "--ease %s: neither a number above 0 nor \"no\"", text);
    return true;
}

/* The share that a trimmed feature keeps unless --trim-keep gives one. */
static const double usual_share_kept = 0.5;

/* Says what becomes of features that a barrier's line crosses, if features may be hidden or become smaller. */
static bool resolve_crossed(const gis_options *options, gis_layer_rules *out, gis_error *error)
{
    unsigned crossed = SUNDER_CROSSED_HIDE;
    if (!out->hide && !options->given[OPT_TRIM] && !options->given[OPT_INSET] && !options->given[OPT_SYMBOL_SIZE] &&
        !options->given[OPT_ENLARGE] && !out->hidden_field)
        return true;
    if (!resolve_choice(options, OPT_CROSSED, crossed_word, &crossed, error)) return false;
    out->crossed = (sunder_crossed)crossed;
    return true;
}

/* What features may become if they have no room. What does not work together with that is refused. */
static bool resolve_room(const gis_options *options, gis_layer_rules *out, gis_error *error)
{
    static const gis_option_id not_with[] = {OPT_MAX_MEMORY};
    unsigned weighting = GIS_WEIGHTING_SQRT_AREA;
    out->hide = options->given[OPT_HIDE];
    out->drop_hidden = options->given[OPT_DROP_HIDDEN];
    out->hierarchy_field = options->text[OPT_HIERARCHY_FIELD];
    out->hidden_field = options->text[OPT_HIDDEN_FIELD];
    out->trim = options->given[OPT_TRIM] && options->command->bit != GIS_CHECK; /* see gis_resolve_original() */
    out->trim_keep = options->given[OPT_TRIM_KEEP] ? options->number[OPT_TRIM_KEEP] : usual_share_kept;
    out->inset = options->command->bit != GIS_CHECK ? options->text[OPT_INSET] : NULL;
    out->min_size = gis_resolve_length(options, OPT_MIN_SIZE);
    out->enlarge = options->given[OPT_ENLARGE] && options->command->bit != GIS_CHECK;
    if (options->command->bit != GIS_CHECK) out->symbol_size = gis_resolve_length(options, OPT_SYMBOL_SIZE);
    out->rigid_where = options->text[OPT_RIGID_WHERE];
    const char *asked = out->trim               ? "--trim"
                        : out->inset            ? "--inset"
                        : out->symbol_size.text ? "--symbol-size"
                        : out->enlarge          ? "--enlarge"
                                                : NULL;
    for (size_t i = 0; asked && i < sizeof not_with / sizeof *not_with; i++)
        if (options->given[not_with[i]])
            return gis_fail_usage(error, "%s: not with %s", asked, gis_option_table[not_with[i]].names);
    if (out->hide && options->given[OPT_MAX_MEMORY] && options->given[OPT_PROOF])
        return gis_fail_usage(error, "--hide: not with --max-memory and --proof");
    if (options->given[OPT_ENLARGE] && (options->given[OPT_SYMBOL] || options->given[OPT_SYMBOL_FIELD]))
        return gis_fail_usage(error, "--enlarge: polygons are made larger, and symbols have their sizes");
    if (options->given[OPT_TRIM] && !options->given[OPT_BARRIER])
        return gis_fail_usage(error, "--trim: features are cut back at barriers; give --barrier");
    if (out->trim_keep > 1) return gis_fail_usage(error, "--trim-keep %g: a share is at most 1", out->trim_keep);
    if (options->given[OPT_HIDE_WEIGHT] && !resolve_choice(options, OPT_HIDE_WEIGHT, weighting_word, &weighting, error))
        return false;
    out->hide_weighting = (gis_weighting)weighting;
    return resolve_crossed(options, out, error);
}

/* Refuses what does not know preferred places. */
static bool check_preferred(const gis_options *options, gis_error *error)
{
    static const gis_option_id preferring[] = {OPT_PREFER_DX, OPT_PREVIOUS}, not_with[] = {OPT_PROOF, OPT_MAX_MEMORY};
    for (size_t i = 0; i < sizeof preferring / sizeof *preferring; i++)
        for (size_t k = 0; k < sizeof not_with / sizeof *not_with && options->given[preferring[i]]; k++)
            if (options->given[not_with[k]])
                return gis_fail_usage(error, "%s: not with %s", gis_option_table[preferring[i]].names,
                                      gis_option_table[not_with[k]].names);
    return true;
}

static bool resolve_rules(const gis_options *options, gis_layer_rules *out, gis_error *error)
{
    unsigned weighting;
    *out = (gis_layer_rules){
        .gap = gis_resolve_length(options, OPT_GAP),
        .least_gap = gis_resolve_length(options, OPT_LEAST_GAP),
        .max_shift = gis_resolve_length(options, OPT_MAX_SHIFT),
        .touch_tolerance = gis_resolve_length(options, OPT_TOUCH_TOLERANCE),
        .ignore_where = options->text[OPT_IGNORE_WHERE],
        .fixed_where = options->text[OPT_FIXED_WHERE],
        .block_field = options->text[OPT_BLOCK_FIELD],
        .weight_field = options->text[OPT_WEIGHT_FIELD],
        .max_shift_field = options->text[OPT_MAX_SHIFT_FIELD],
        .prefer_field = {options->text[OPT_PREFER_DX], options->text[OPT_PREFER_DY]},
    };
    sunder_layer_options_init(&out->core);
    out->core.no_blocks = options->given[OPT_NO_BLOCKS];
    out->core.list_inside = options->given[OPT_LIST_INSIDE];
    out->core.allow_jumps = options->given[OPT_ALLOW_JUMPS];
    if (options->given[OPT_EFFORT]) out->core.effort = options->number[OPT_EFFORT];
    out->core.seed = seed_of(options);
    out->core.keep_trees = options->given[OPT_PROOF];
    out->core.threads = thread_count(options);
    if (!resolve_choice(options, OPT_WEIGHT, weighting_word, &weighting, error)) return false;
    out->weighting = (gis_weighting)weighting;
    return check_preferred(options, error) && resolve_rows(options, out, error) && resolve_room(options, out, error) &&
           resolve_stiffness(options, out->core.row_stiffness, error) &&
           resolve_ease(options, &out->core.ease, error) && resolve_contained(options, &out->core.contained, error);
}

/* Refuses a file of --stats, --report, --proof or --trace that is a file of a barrier's dataset. The reading of
 * barriers checks OUTPUT itself. */
static bool spare_barrier(const gis_options *options, const char *dataset, gis_error *error)
{
    static const gis_option_id files[] = {OPT_STATS, OPT_REPORT, OPT_PROOF, OPT_TRACE};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        const char *path = options->text[files[i]];
        if (path && gis_path_lies_in(dataset, path))
            return gis_fail_usage(error, "%s %s: that is an input; give another file", gis_option_table[files[i]].names,
                                  path);
    }
    return true;
}

static bool resolve_barriers(const gis_options *options, gis_layer_input_request *out, gis_error *error)
{
    const char *const *list = options->list[OPT_BARRIER];
    size_t n = 0;
    while (list && list[n]) n++;
    if (n == 0) return true;
    out->barrier = calloc(n, sizeof *out->barrier);
    if (!out->barrier) return gis_no_memory(error);
    for (; out->barriers < n; out->barriers++)
        if (!gis_barrier_parse(list[out->barriers], &out->barrier[out->barriers], error)) return false;
    for (size_t k = 0; k < n; k++)
        if (!spare_barrier(options, out->barrier[k].dataset, error)) return false;
    return true;
}

/* Checks the least gaps, whose pairs have the price of --ease. */
static bool resolve_least_gaps(const gis_options *options, gis_layer_input_request *out, gis_error *error)
{
    gis_layer_rules *rules = &out->rules;
    rules->has_least_gap = options->given[OPT_LEAST_GAP];
    if (rules->has_least_gap && !options->given[OPT_GAP])
        return gis_fail_usage(error, "--least-gap %s: there is no --gap, which pairs keep if it pays",
                              options->text[OPT_LEAST_GAP]);
    for (size_t k = 0; k < out->barriers; k++) {
        const gis_barrier_request *barrier = &out->barrier[k];
        if (!barrier->least.text) continue;
        rules->has_least_gap = true;
        if (!barrier->gap.text && !options->given[OPT_GAP])
            return gis_fail_usage(error, "--barrier %s: least=%s: there is neither gap= nor --gap", barrier->dataset,
                                  barrier->least.text);
    }
    if (!rules->has_least_gap || options->command->bit == GIS_CHECK) return true;
    if (options->text[OPT_EASE] && !(rules->core.ease > 0))
        return gis_fail_usage(error, "--ease no: pairs between the least gap and the gap need a price");
    return true;
}

void gis_resolve_original(const gis_options *options, const gis_layer_input_request *now, const char *name,
                          gis_layer_input_request *out)
{
    *out = *now;
    out->source = (gis_source_request){.path = options->text[OPT_BEFORE],
                                       .where = now->source.where,
                                       .input_crs = now->source.input_crs,
                                       .layer_like = name};
    out->output = NULL;
    out->rules.block_field = NULL;
    out->rules.rows_field = rows_field_of(options);
    out->rules.hidden_field = out->rules.hierarchy_field = NULL;
    out->rules.trim = options->given[OPT_TRIM];
    out->rules.inset = options->text[OPT_INSET];
    out->rules.symbol_size = gis_resolve_length(options, OPT_SYMBOL_SIZE);
    out->rules.enlarge = options->given[OPT_ENLARGE];
    out->compared = true;
}

/* Checks the options of the command check that depend on --before: some apply to moves only, and some select features
 * in a way that cannot be repeated on the original layer. */
static bool check_before(const gis_options *options, gis_error *error)
{
    static const gis_option_id of_moves[] = {OPT_MAX_SHIFT,   OPT_MAX_SHIFT_FIELD,
                                             OPT_FIXED_WHERE, OPT_ALLOW_JUMPS,
                                             OPT_ROWS,        OPT_TRIM,
                                             OPT_INSET,       OPT_SYMBOL_SIZE,
                                             OPT_ENLARGE},
                               of_results[] = {OPT_SQL, OPT_BBOX};
    bool before = options->given[OPT_BEFORE];
    if (options->command->bit != GIS_CHECK) return true;
    for (size_t i = 0; !before && i < sizeof of_moves / sizeof *of_moves; i++)
        if (options->given[of_moves[i]])
            return gis_fail_usage(error, "%s is a rule for moves; check needs --before ORIGINAL with it",
                                  gis_option_table[of_moves[i]].names);
    for (size_t i = 0; before && i < sizeof of_results / sizeof *of_results; i++)
        if (options->given[of_results[i]])
            return gis_fail_usage(
                error, "--before cannot be given with %.*s: the same selection of the original is not known",
                (int)strcspn(gis_option_table[of_results[i]].names, " "), gis_option_table[of_results[i]].names);
    return true;
}

bool gis_resolve_layer(const gis_options *options, gis_layer_input_request *out, gis_error *error)
{
    *out = (gis_layer_input_request){
        .source = resolve_source(options),
        .output = output_of(options),
        .update = options->given[OPT_UPDATE],
        .scale = options->number[OPT_SCALE],
        .previous = options->text[OPT_PREVIOUS],
        .previous_stays = options->text[OPT_PREVIOUS_RELAX] && strcmp(options->text[OPT_PREVIOUS_RELAX], "no") == 0,
        .id_field = options->text[OPT_ID_FIELD],
        .symbol = options->text[OPT_SYMBOL],
        .symbol_field = options->text[OPT_SYMBOL_FIELD],
        .symbol_size_field = options->text[OPT_SYMBOL_SIZE_FIELD],
        .wound = options->given[OPT_BEFORE],
        .moves = options->command->bit == GIS_SEPARATE,
        .drawn = options->given[OPT_REPORT],
        .may_have_symbols = (gis_option_table[OPT_SYMBOL].commands & options->command->bit) != 0,
    };
    return resolve_invalid(options, &out->invalid, error) && resolve_rules(options, &out->rules, error) &&
           check_before(options, error) && resolve_barriers(options, out, error) &&
           resolve_least_gaps(options, out, error);
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
        .source = resolve_source(options),
        .scale = options->number[OPT_SCALE],
    };
    if (strcmp(options->operand[0], "@-") == 0 && strcmp(options->operand[1], "@-") == 0)
        return gis_fail_usage(error, "P and Q cannot both be read from standard input");
    return check_selection(options, error) && resolve_invalid(options, &out->invalid, error);
}

bool gis_resolve_road(const gis_options *options, sunder_sum_options *out, gis_error *error)
{
    unsigned algorithm, decomposition, order;
    if (!resolve_choice(options, OPT_ALGORITHM, algorithm_word, &algorithm, error) ||
        !resolve_choice(options, OPT_DECOMPOSITION, decomposition_word, &decomposition, error) ||
        !resolve_choice(options, OPT_ORDER, order_word, &order, error))
        return false;
    *out = (sunder_sum_options){
        .size = sizeof(sunder_sum_options),
        .algorithm = (sunder_algorithm)algorithm,
        .decomposition = (sunder_decomposition)decomposition,
        .order = (sunder_order)order,
        .seed = seed_of(options),
        .keep_map = options->given[OPT_PLANAR_MAP],
    };
    const char *output = output_of(options);
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
        .threads = thread_count(options),
    };
    if (!gis_resolve_layer(options, &out->layer, error) ||
        !resolve_choice(options, OPT_OPERATION, operation_word, &operation, error))
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
        .source = resolve_source(options),
        .gap = gis_resolve_length(options, OPT_GAP),
        .scale = options->number[OPT_SCALE],
        .free_space = options->given[OPT_FREE_SPACE],
    };
    if (out->free_space && !output_of(options))
        return gis_fail_usage(error, "--free-space needs OUTPUT: it writes layers");
    if (!resolve_coordinate(options, OPT_FROM, &out->from, error) ||
        !resolve_coordinate(options, OPT_TO, &out->to, error))
        return false;
    if (!options->text[OPT_ROBOT]) return gis_fail_usage(error, "--robot SHAPE is missing: the shape that moves");
    if (!resolve_invalid(options, &out->invalid, error)) return false;
    out->robot = resolve_shape(options, OPT_ROBOT, out->invalid);
    return true;
}

/* Parses the text of --by: a word, or a word, a colon and a value. */
static bool resolve_by(const gis_options *options, gis_follow_request *out, gis_error *error)
{
    static const char nearest[] = "nearest:", field[] = "field:";
    const char *text = options->given[OPT_BY] ? options->text[OPT_BY] : "inside", *why;
    if (strcmp(text, "inside") == 0) return true;
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
        .input = resolve_source(options),
        .id_field = options->text[OPT_ID_FIELD],
        .scale = options->number[OPT_SCALE],
    };
    if (!resolve_by(options, out, error)) return false;
    if (out->id_field && out->by != GIS_FOLLOW_FIELD)
        return gis_fail_usage(error, "--id-field: the field of MOVED that --by field:NAME names; give that, too");
    return resolve_invalid(options, &out->invalid, error);
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
        .threads = thread_count(options),
    };
}

gis_destinations gis_resolve_destinations(const gis_options *options)
{
    gis_destinations to = {.output = output_of(options),
                           .stats = options->text[OPT_STATS],
                           .report = options->text[OPT_REPORT],
                           .proof = options->text[OPT_PROOF],
                           .trace = options->text[OPT_TRACE]};
    for (size_t i = 0; i + 1 < options->command->most; i++) to.input[i] = options->operand[i];
    static const gis_option_id shapes[] = {OPT_SHAPE, OPT_ROBOT, OPT_SYMBOL};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) to.shape[i] = options->text[shapes[i]];
    return to;
}

gis_progress gis_resolve_progress(const gis_options *options)
{
    bool json = strcmp(options->text[OPT_MESSAGES], "json") == 0;
    bool layers = (options->command->bit & (GIS_LAYERS | GIS_BUFFER | GIS_MERGE | GIS_FOLLOW)) || output_of(options);
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
