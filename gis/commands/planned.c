/* planned.c: see planned.h. */
#include "commands/planned.h"

#include "base/path.h"
#include "commands/call.h"
#include "commands/config.h"
#include "commands/resolve.h"
#include "commands/separate_run.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <stdlib.h>
#include <string.h>

/* ---- The arguments stored in a plan ------------------------------------------------------------------------------ */

/* Is the option stored among the arguments of a plan? Options that only report on the run of `plan` are not. */
static bool is_planned(const gis_option *option)
{
    switch (option->id) {
    case OPT_SHARDS:
    case OPT_MAX_MEMORY: /* the plan stores these two as numbers */
    case OPT_PROGRESS:
    case OPT_QUIET:
    case OPT_LOG:
    case OPT_MESSAGES: return false;
    default: return true;
    }
}

static const gis_option *option_of(const char *name)
{
    for (int id = 0; id < OPT_N; id++)
        if (strncmp(gis_option_table[id].names, name, strlen(name)) == 0 &&
            strchr(" ", gis_option_table[id].names[strlen(name)]))
            return &gis_option_table[id];
    return NULL;
}

/* Returns the value of the option with relative paths made absolute; NULL if out of memory. The caller frees it with
 * CPLFree(). */
static char *absolute_value(const gis_option *option, const char *value)
{
    switch (option ? option->type : GIS_TYPE_TEXT) {
    case GIS_TYPE_BARRIERS: return gis_plan_absolute_barrier(value);
    case GIS_TYPE_SHAPE: return gis_plan_absolute_shape(value);
    case GIS_TYPE_FILE: return gis_plan_absolute_output(value);
    default: return CPLStrdup(value);
    }
}

static bool store_sheet(const gis_options *options, gis_plan *plan, gis_error *error)
{
    const char *const *barrier = options->list[OPT_BARRIER];
    size_t barriers = 0;
    gis_json json = {0};
    if (options->sheet && !(plan->sheet = CPLStrdup(options->sheet))) return gis_no_memory(error);
    if (!options->gap_classes) return true;
    while (barrier && barrier[barriers]) barriers++;
    gis_sheet_put_gaps(&json, options->gap_classes, barriers);
    const char *text = gis_json_text(&json);
    if (text) plan->gaps = CPLStrdup(text);
    gis_json_clear(&json);
    return plan->gaps || gis_no_memory(error);
}

bool gis_planned_arguments(const gis_options *options, gis_plan *plan, gis_error *error)
{
    gis_call call = {0};
    bool done = gis_call_list_of(options, is_planned, &call, error);
    for (size_t k = 0; k < call.n && done; k++) {
        char *value = absolute_value(option_of(call.option[k].name), call.option[k].value);
        done = gis_plan_add_argument(plan, call.option[k].name, *value ? value : NULL, error);
        CPLFree(value);
    }
    gis_call_clear(&call);
    char *input = gis_plan_absolute_source(options->operand[0]);
    done = done && gis_plan_add_argument(plan, "--", NULL, error) && gis_plan_add_argument(plan, input, NULL, error);
    CPLFree(input);
    return done && store_sheet(options, plan, error);
}

/* ---- Parsing the stored arguments -------------------------------------------------------------------------------- */

static const gis_command *find_separate(void)
{
    for (size_t k = 0; k < gis_n_commands; k++)
        if (gis_commands[k].bit == GIS_SEPARATE) return &gis_commands[k];
    return NULL;
}

static bool add_word(gis_planned *planned, const char *text, gis_error *error)
{
    char **more = realloc(planned->word, (planned->words + 1) * sizeof *more);
    if (!more) return gis_no_memory(error);
    planned->word = more;
    planned->word[planned->words] = strdup(text);
    return planned->word[planned->words++] || gis_no_memory(error);
}

static bool is_watching(const gis_option *option) { return (option->commands & GIS_MERGE) != 0; }

static bool add_now(gis_planned *planned, const gis_options *now, gis_error *error)
{
    gis_call call = {0};
    bool done = gis_call_list_of(now, is_watching, &call, error);
    for (size_t k = 0; k < call.n && done; k++) {
        const char *value = call.option[k].value;
        char *word = gis_printed("%s%s%s", call.option[k].name, *value ? "=" : "", value);
        done = add_word(planned, word, error);
        CPLFree(word);
    }
    gis_call_clear(&call);
    return done;
}

/* Returns whether an option of the plan is also given in this call, so that its stored value is ignored. */
static bool is_overridden(const gis_options *now, const char *argument)
{
    for (int id = 0; id < OPT_N; id++) {
        const size_t n = strcspn(gis_option_table[id].names, " ");
        if (now->given[id] && is_watching(&gis_option_table[id]) &&
            strncmp(gis_option_table[id].names, argument, n) == 0 && (argument[n] == '\0' || argument[n] == '='))
            return true;
    }
    return false;
}

bool gis_planned_parse(gis_planned *planned, const gis_options *now, const char *output, gis_error *error)
{
    bool done = add_now(planned, now, error);
    for (size_t k = 0; k < planned->plan.arguments && done; k++)
        if (!is_overridden(now, planned->plan.argument[k])) done = add_word(planned, planned->plan.argument[k], error);
    if (!done || !add_word(planned, output, error) ||
        !gis_options_parse(find_separate(), (int)planned->words, planned->word, &planned->options, error))
        return false;
    gis_configure(&planned->options);
    if (planned->plan.sheet && *planned->plan.sheet) planned->options.sheet = planned->plan.sheet;
    const char *gaps = planned->plan.gaps;
    return !gaps || !*gaps || gis_sheet_take_gaps(gaps, &planned->options, &planned->sheet, error);
}

bool gis_planned_open(const char *directory, const gis_options *now, const char *output, gis_planned *planned,
                      gis_error *error)
{
    *planned = (gis_planned){0};
    return gis_plan_read(directory, &planned->plan, error) && gis_planned_parse(planned, now, output, error);
}

void gis_planned_clear(gis_planned *planned)
{
    gis_options_clear(&planned->options);
    gis_sheet_clear(&planned->sheet);
    gis_plan_clear(&planned->plan);
    for (size_t k = 0; k < planned->words; k++) free(planned->word[k]);
    free(planned->word);
    *planned = (gis_planned){0};
}

bool gis_planned_rules(const gis_options *options, gis_layer_rules *rules, gis_error *error)
{
    unsigned chosen;
    const bool points = options->given[OPT_SYMBOL] || options->given[OPT_SYMBOL_FIELD];
    if (!gis_separate_choose_layers(options->text[OPT_LAYERS], rules, points, &chosen, error)) return false;
    rules->core.keep_pushes = (chosen & GIS_SEPARATE_PUSHES) != 0;
    rules->count_thin = true; /* needed if a summary is printed, which is not known before the end */
    return true;
}
