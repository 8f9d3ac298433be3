/* resolve_layer.c: the request of a layer that is separated, checked or dilated, with its rules and barriers. */
#include "commands/resolve_common.h"

#include "layer/gap_rules.h"
#include "read/source_files.h"

#include <stdlib.h>
#include <string.h>

static const char *weighting_word(unsigned i) { return gis_weighting_string((gis_weighting)i); }
static const char *containment_word(unsigned i) { return sunder_containment_string((sunder_containment)i); }

/* The words of sunder_crossed. */
static const char *crossed_word(unsigned i)
{
    static const char *const words[] = {
        [SUNDER_CROSSED_HIDE] = "hide", [SUNDER_CROSSED_TRIM] = "trim", [SUNDER_CROSSED_KEEP] = "keep"};
    return i < sizeof words / sizeof *words ? words[i] : "";
}

/* Sets how contained features are treated. By default points are separated, since symbols that lie on each other are
 * the purpose of separating points; polygons have the default of --contained. */
static bool resolve_contained(const gis_options *options, sunder_containment *out, gis_error *error)
{
    bool points = options->given[OPT_SYMBOL] || options->given[OPT_SYMBOL_FIELD];
    unsigned contained = SUNDER_CONTAINMENT_SEPARATE;
    if (!(points && !options->given[OPT_CONTAINED]) &&
        !gis_resolve_choice(options, OPT_CONTAINED, containment_word, &contained, error))
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
    if (!gis_resolve_choice(options, OPT_CROSSED, crossed_word, &crossed, error)) return false;
    out->crossed = (sunder_crossed)crossed;
    return true;
}

/* What features may become if they have no room. What does not work together with that is refused. */
static bool resolve_room(const gis_options *options, gis_layer_rules *out, gis_error *error)
{
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
    if (options->given[OPT_ENLARGE] && (options->given[OPT_SYMBOL] || options->given[OPT_SYMBOL_FIELD]))
        return gis_fail_usage(error, "--enlarge: polygons are made larger, and symbols have their sizes");
    if (options->given[OPT_TRIM] && !options->given[OPT_BARRIER])
        return gis_fail_usage(error, "--trim: features are cut back at barriers; give --barrier");
    if (out->trim_keep > 1) return gis_fail_usage(error, "--trim-keep %g: a share is at most 1", out->trim_keep);
    if (options->given[OPT_HIDE_WEIGHT] &&
        !gis_resolve_choice(options, OPT_HIDE_WEIGHT, weighting_word, &weighting, error))
        return false;
    out->hide_weighting = (gis_weighting)weighting;
    return resolve_crossed(options, out, error);
}

/* Refuses what does not know preferred places. */
static bool check_preferred(const gis_options *options, gis_error *error)
{
    static const gis_option_id preferring[] = {OPT_PREFER_DX, OPT_PREVIOUS, OPT_LINKS},
                               not_with[] = {OPT_PROOF, OPT_MAX_MEMORY};
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
        .classes = options->gap_classes,
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
    out->core.seed = gis_resolve_seed(options);
    out->core.keep_trees = options->given[OPT_PROOF];
    out->core.threads = gis_resolve_threads(options);
    if (!gis_resolve_choice(options, OPT_WEIGHT, weighting_word, &weighting, error)) return false;
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
    if (rules->has_least_gap && !options->given[OPT_GAP] && !rules->classes)
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
    for (size_t k = 0; rules->classes && k < rules->classes->rules; k++)
        rules->has_least_gap = rules->has_least_gap || rules->classes->rule[k].least.text;
    if (!rules->has_least_gap || options->command->bit == GIS_CHECK) return true;
    if (options->text[OPT_EASE] && !(rules->core.ease > 0))
        return gis_fail_usage(error, "--ease no: pairs between the least gap and the gap need a price");
    return true;
}

/* Where the original of a layer is: with the file of --spec as ORIGINAL, where that says. */
static const char *original_path(const gis_options *options)
{
    const char *path = options->text[OPT_BEFORE], *sheet = options->text[OPT_SPEC];
    return sheet && options->original_source && strcmp(path, sheet) == 0 ? options->original_source : path;
}

static void resolve_original_of(const gis_options *options, const gis_layer_input_request *now, const char *name,
                                gis_layer_input_request *out)
{
    *out = *now;
    out->with = out->alone = NULL;
    out->more = 0;
    out->source = (gis_source_request){.path = original_path(options),
                                       .where = now->source.where,
                                       .input_crs = now->source.input_crs,
                                       .layer = options->original_layer,
                                       .layer_like = options->original_layer ? NULL : name};
    out->output = NULL;
    out->rules.block_field = NULL;
    out->rules.rows_field = rows_field_of(options);
    out->rules.hidden_field = out->rules.hierarchy_field = NULL;
    out->rules.trim = options->given[OPT_TRIM];
    out->rules.inset = options->text[OPT_INSET];
    out->rules.symbol_size = gis_resolve_length(options, OPT_SYMBOL_SIZE);
    out->rules.enlarge = options->given[OPT_ENLARGE];
    out->compared = out->moves = true; /* hence the same barriers count as when the features were moved */
}

bool gis_resolve_original(const gis_options *options, const gis_layer_input_request *now, const char *name,
                          gis_layer_input_request *out, gis_error *error)
{
    resolve_original_of(options, now, now->more ? now->name : name, out);
    if (now->more == 0) return true;
    out->alone = malloc(sizeof *out->alone);
    out->with = calloc(now->more, sizeof *out->with);
    if (!out->alone || !out->with) return gis_no_memory(error);
    resolve_original_of(options, now->alone, now->name, out->alone);
    for (; out->more < now->more; out->more++)
        resolve_original_of(&options->more[out->more], &now->with[out->more], now->with[out->more].name,
                            &out->with[out->more]);
    return true;
}

/* Checks the options of the command check that depend on --before: some apply to moves only, and some select features
 * in a way that cannot be repeated on the original layer. */
static bool check_before(const gis_options *options, gis_error *error)
{
    static const gis_option_id of_results[] = {OPT_SQL, OPT_BBOX};
    bool before = options->given[OPT_BEFORE];
    if (options->command->bit != GIS_CHECK) return true;
    for (int id = 0; !before && id < OPT_N; id++)
        if (options->given[id] && gis_option_is_of_moves((gis_option_id)id))
            return gis_fail_usage(error, "%s is a rule for moves; check needs --before ORIGINAL with it",
                                  gis_option_table[id].names);
    for (size_t i = 0; before && i < sizeof of_results / sizeof *of_results; i++)
        if (options->given[of_results[i]])
            return gis_fail_usage(
                error, "--before cannot be given with %.*s: the same selection of the original is not known",
                (int)strcspn(gis_option_table[of_results[i]].names, " "), gis_option_table[of_results[i]].names);
    return true;
}

/* The request for one layer, without those that move with it. */
static bool resolve_one(const gis_options *options, gis_layer_input_request *out, gis_error *error)
{
    *out = (gis_layer_input_request){
        .source = gis_resolve_source(options),
        .output = gis_resolve_output(options),
        .update = options->given[OPT_UPDATE],
        .scale = options->number[OPT_SCALE],
        .previous = options->text[OPT_PREVIOUS],
        .previous_stays = options->text[OPT_PREVIOUS_RELAX] && strcmp(options->text[OPT_PREVIOUS_RELAX], "no") == 0,
        .links = {.radius = gis_resolve_length(options, OPT_LINKS_RADIUS)},
        .written = options->text[OPT_OUTPUT_LAYER],
        .name = options->layer_name,
        .sheet = options->sheet,
        .id_field = options->text[OPT_ID_FIELD],
        .symbol = options->text[OPT_SYMBOL],
        .symbol_field = options->text[OPT_SYMBOL_FIELD],
        .symbol_size_field = options->text[OPT_SYMBOL_SIZE_FIELD],
        .wound = options->given[OPT_BEFORE],
        .moves = options->command->bit == GIS_SEPARATE,
        .drawn = options->given[OPT_REPORT] && options->command->bit != GIS_CHECK,
        .may_have_symbols = (gis_option_table[OPT_SYMBOL].commands & options->command->bit) != 0,
    };
    if (options->given[OPT_LINKS] && !gis_links_parse(options->text[OPT_LINKS], &out->links, error)) return false;
    return gis_resolve_invalid(options, &out->invalid, error) && resolve_rules(options, &out->rules, error) &&
           check_before(options, error) && resolve_barriers(options, out, error) &&
           resolve_least_gaps(options, out, error);
}

/* ---- Layers that move together ----------------------------------------------------------------------------------- */

/* Refuses what is of one layer alone. */
static bool check_together(const gis_options *options, gis_error *error)
{
    static const gis_option_id not_with[] = {OPT_PROOF, OPT_MAX_MEMORY, OPT_ENLARGE, OPT_HIDDEN_FIELD},
                               not_checked[] = {OPT_TRIM, OPT_INSET, OPT_SYMBOL_SIZE};
    for (size_t k = 0; k < sizeof not_with / sizeof *not_with; k++)
        if (options->given[not_with[k]])
            return gis_fail_usage(error, "--spec: not with several layers that move: %s",
                                  gis_option_table[not_with[k]].names);
    for (size_t k = 0; k < sizeof not_checked / sizeof *not_checked && options->command->bit == GIS_CHECK; k++)
        if (options->given[not_checked[k]])
            return gis_fail_usage(error, "--spec: --before: not with several layers that move: %s",
                                  gis_option_table[not_checked[k]].names);
    if (rows_field_of(options))
        return gis_fail_usage(error, "--spec: with several layers that move rows are auto or no");
    return options->command->bit != GIS_PLAN ||
           gis_fail_usage(error, "--spec: not in a plan: several layers that move");
}

static bool has_symbols(const gis_layer_input_request *request) { return request->symbol || request->symbol_field; }

/* What the core's options say of one layer becomes a rule for its features. */
static void set_traits(gis_layer_rules *rules, bool points)
{
    rules->joins_none = rules->core.no_blocks || (points && !rules->touch_tolerance.text);
    rules->may_jump = rules->core.allow_jumps || points;
    rules->in_no_row = !rules->core.rows;
    rules->never_hidden = !rules->hide;
}

/* Adds the other shapes that one of the layers may have. */
static void unite_shapes(const gis_layer_rules *with, gis_layer_rules *rules)
{
    rules->trim = rules->trim || with->trim;
    if (!rules->inset) rules->inset = with->inset;
    if (!rules->symbol_size.text) rules->symbol_size = with->symbol_size;
}

/* Sets what the core's options are for all layers together; `out` is the request for the first one. Rows are found if
 * one layer has rows, and so on. */
static bool unite_rules(gis_layer_input_request *out, gis_error *error)
{
    gis_layer_rules *rules = &out->rules;
    const gis_layer_input_request *polygons = has_symbols(out) ? NULL : out;
    set_traits(rules, has_symbols(out));
    out->alone = malloc(sizeof *out->alone);
    if (!out->alone) return gis_no_memory(error);
    *out->alone = *out;
    for (size_t k = 0; k < out->more; k++) {
        gis_layer_input_request *with = &out->with[k];
        set_traits(&with->rules, has_symbols(with));
        if (!polygons && !has_symbols(with)) polygons = with;
        if (with->rules.core.rows) rules->core.rows = SUNDER_ROWS_FOUND;
        if (!rules->hide && !gis_levels_asked(rules)) rules->crossed = with->rules.crossed;
        rules->hide = rules->hide || with->rules.hide;
        unite_shapes(&with->rules, rules);
    }
    rules->core.no_blocks = rules->core.allow_jumps = false;
    if (polygons) rules->core.contained = polygons->rules.core.contained;
    return true;
}

bool gis_resolve_layer(const gis_options *options, gis_layer_input_request *out, gis_error *error)
{
    if (!resolve_one(options, out, error)) return false;
    if (options->n_more == 0) return true;
    out->with = calloc(options->n_more, sizeof *out->with);
    if (!out->with) return gis_no_memory(error);
    if (!check_together(options, error)) return false;
    for (size_t k = 0; k < options->n_more; k++) {
        out->more = k + 1;
        if (!check_together(&options->more[k], error) || !resolve_one(&options->more[k], &out->with[k], error))
            return false;
    }
    out->title = options->sheet_name;
    return unite_rules(out, error);
}
