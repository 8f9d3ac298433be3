/* call.c: see call.h. */
#include "commands/call.h"

#include "base/array.h"
#include "base/json.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool append_option(gis_call *call, const gis_option *option, const char *value, gis_error *error)
{
    if (!gis_array_reserve(&call->option, &call->capacity, call->n + 1, sizeof *call->option))
        return gis_no_memory(error);
    gis_page_option *new = &call->option[call->n];
    *new = (gis_page_option){strndup(option->names, strcspn(option->names, " ")), strdup(value)};
    call->n++;
    return (new->name &&new->value) || gis_no_memory(error);
}

static bool add_numbers(gis_call *call, const gis_option *option, const double *numbers, size_t n, gis_error *error)
{
    char words[4 * GIS_NUMBER_MAX] = "";
    for (size_t k = 0; k < n; k++) {
        char number[GIS_NUMBER_MAX];
        gis_number_text(numbers[k], number);
        size_t length = strlen(words);
        snprintf(words + length, sizeof words - length, "%s%s", k ? "," : "", number);
    }
    return append_option(call, option, words, error);
}

static bool add_option(gis_call *call, const gis_options *options, const gis_option *option, gis_error *error)
{
    gis_option_id id = option->id;
    if (gis_option_is_list(option)) {
        for (const char **each = options->list[id]; each && *each; each++)
            if (!append_option(call, option, *each, error)) return false;
        return true;
    }
    switch (option->type) {
    case GIS_TYPE_COUNT:
    case GIS_TYPE_NUMBER:
    case GIS_TYPE_SCALE: return add_numbers(call, option, &options->number[id], 1, error);
    case GIS_TYPE_BOX: return add_numbers(call, option, options->box, 4, error);
    case GIS_TYPE_FLAG: return append_option(call, option, "", error);
    default: return append_option(call, option, options->text[id] ? options->text[id] : "", error);
    }
}

bool gis_call_list_of(const gis_options *options, bool (*wanted)(const gis_option *), gis_call *call, gis_error *error)
{
    for (int id = 0; id < OPT_N; id++) {
        const gis_option *option = &gis_option_table[id];
        if (options->given[id] && wanted(option) && !add_option(call, options, option, error)) return false;
    }
    return true;
}

static bool is_about_results(const gis_option *option) { return option->group != GIS_GROUP_RUNNING; }

bool gis_call_list(const gis_options *options, gis_call *call, gis_error *error)
{
    return gis_call_list_of(options, is_about_results, call, error);
}

void gis_call_clear(gis_call *call)
{
    for (size_t k = 0; k < call->n; k++) {
        free(call->option[k].name);
        free(call->option[k].value);
    }
    free(call->option);
    *call = (gis_call){0};
}
