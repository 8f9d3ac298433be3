/* options_json.c: --options-json, the table of options for other programs: a dialogue, a completion, a test. For each
 * command its operands and options in the order of --help:
 *
 *   name, aliases   the long name, and other spellings
 *   kind            the kind of a value, a word of kinds[] below; "flag": it takes none
 *   values          the words that a value may be, or null: any of its kind. With "enums" several, with commas
 *   metavar         the word that stands for a value in --help, or null
 *   repeatable      may the option be repeated, with one more value each time?
 *   needed          is the option mandatory?
 *   needs           the option is refused unless one of the options in this list is given; []: it is not
 *   default         text that has the effect of leaving the option out; null: there is none
 *   default_text    the same in the words of --help
 *   group           command, identity, features, room, output, trouble, running; hidden: not listed in --help
 *
 * These keys are stable; more may be added. */
#include "base/json.h"
#include "options/options.h"
#include "sunder.h"

#include <stdio.h>
#include <string.h>

static const char *const kinds[] = {
    [GIS_TYPE_FLAG] = "flag",        [GIS_TYPE_TEXT] = "text",      [GIS_TYPE_LAYER] = "layer",
    [GIS_TYPE_FIELD] = "field",      [GIS_TYPE_SQL] = "sql",        [GIS_TYPE_STATEMENT] = "statement",
    [GIS_TYPE_SHAPE] = "shape",      [GIS_TYPE_POINT] = "point",    [GIS_TYPE_DATASET] = "dataset",
    [GIS_TYPE_OUTPUT] = "output",    [GIS_TYPE_FILE] = "file",      [GIS_TYPE_FORMAT] = "format",
    [GIS_TYPE_CRS] = "crs",          [GIS_TYPE_CHOICE] = "enum",    [GIS_TYPE_CHOICES] = "enums",
    [GIS_TYPE_LENGTH] = "length",    [GIS_TYPE_COUNT] = "integer",  [GIS_TYPE_NUMBER] = "number",
    [GIS_TYPE_SCALE] = "scale",      [GIS_TYPE_BOX] = "box",        [GIS_TYPE_OPTIONAL] = "flag_or_enum",
    [GIS_TYPE_BARRIERS] = "barrier", [GIS_TYPE_FORMATS] = "format", [GIS_TYPE_SETTINGS] = "setting",
    [GIS_TYPE_PAIRS] = "setting",
};

static const char *const groups[GIS_N_GROUPS] = {
    [GIS_GROUP_OWN] = "command",     [GIS_GROUP_IDENTITY] = "identity", [GIS_GROUP_PLACES] = "places",
    [GIS_GROUP_ROOM] = "room",       [GIS_GROUP_INPUT] = "features",    [GIS_GROUP_OUTPUT] = "output",
    [GIS_GROUP_TROUBLE] = "trouble", [GIS_GROUP_RUNNING] = "running",   [GIS_GROUP_HIDDEN] = "hidden",
};

static void put_piece(gis_json *out, const char *piece, size_t n)
{
    char text[64];
    snprintf(text, sizeof text, "%.*s", (int)n, piece);
    gis_json_string(out, text);
}

/* Writes the substrings of `text` between separators as an array, without the first `skipped` ones. */
static void put_pieces(gis_json *out, const char *text, char separator, size_t skipped)
{
    const char stops[] = {separator, '\0'};
    gis_json_open(out, '[');
    for (size_t k = 0; *text; k++) {
        size_t n = strcspn(text, stops);
        if (k >= skipped) put_piece(out, text, n);
        text += n + (text[n] == separator);
    }
    gis_json_close(out, ']');
}

static void put_values(gis_json *out, const gis_option *option)
{
    gis_json_key(out, "values");
    switch (option->type) {
    case GIS_TYPE_CHOICE: put_pieces(out, option->metavar, '|', 0); break;
    case GIS_TYPE_CHOICES: put_pieces(out, option->metavar, ',', 0); break;
    case GIS_TYPE_OPTIONAL: put_pieces(out, option->metavar, '|', 0); break;
    default: gis_json_null(out);
    }
}

/* Is the default a value that could be typed, unlike a description such as "gap / 10" or "all processors"? */
static bool is_typed(const gis_option *option)
{
    const char *text = option->fallback;
    double number;
    return text && (option->type == GIS_TYPE_CHOICE || gis_length_parse_number(text, strlen(text), &number));
}

static void put_needs(gis_json *out, const gis_command *command, const gis_option *option)
{
    const gis_need *need = gis_option_need(option->id);
    gis_json_key(out, "needs");
    gis_json_open(out, '[');
    for (size_t k = 0; need && k < need->n; k++) {
        const gis_option *other = &gis_option_table[need->one_of[k]];
        if (other->commands & command->bit) put_piece(out, other->names, strcspn(other->names, " "));
    }
    gis_json_close(out, ']');
}

static void put_option(gis_json *out, const gis_command *command, const gis_option *option)
{
    gis_json_open(out, '{');
    gis_json_key(out, "name");
    put_piece(out, option->names, strcspn(option->names, " "));
    gis_json_key(out, "aliases");
    put_pieces(out, option->names, ' ', 1);
    gis_json_put_string(out, "kind", kinds[option->type]);
    put_values(out, option);
    gis_json_put_string(out, "metavar", option->metavar);
    gis_json_put_bool(out, "repeatable", gis_option_is_list(option));
    gis_json_put_bool(out, "needed", gis_option_is_needed(option));
    put_needs(out, command, option);
    gis_json_put_string(out, "default", is_typed(option) ? option->fallback : NULL);
    gis_json_put_string(out, "default_text", option->fallback);
    gis_json_put_string(out, "group", groups[option->group]);
    gis_json_put_string(out, "help", option->help);
    gis_json_close(out, '}');
}

/* Writes the operands of the usage line as an array; optional ones are in brackets there. */
static void put_operands(gis_json *out, const gis_command *command)
{
    gis_json_open(out, '[');
    for (const char *word = command->operands; *word; word += strspn(word, " ")) {
        size_t n = strcspn(word, " "), bracket = word[0] == '[';
        char name[32];
        snprintf(name, sizeof name, "%.*s", (int)(n - 2 * bracket), word + bracket);
        const char *kind = strcmp(name, "OUTPUT") == 0 ? "output" : strcmp(name, "INPUT") == 0 ? "dataset" : "operand";
        gis_json_open(out, '{');
        gis_json_put_string(out, "name", name);
        gis_json_put_string(out, "kind", kind); /* "operand": a data source or a SHAPE */
        gis_json_put_bool(out, "needed", !bracket);
        gis_json_close(out, '}');
        word += n;
    }
    gis_json_close(out, ']');
}

static void put_command(gis_json *out, const gis_command *command)
{
    gis_json_open(out, '{');
    gis_json_put_string(out, "name", command->name);
    gis_json_put_string(out, "summary", command->summary);
    gis_json_put_string(out, "example", command->example);
    gis_json_key(out, "operands");
    put_operands(out, command);
    gis_json_key(out, "options");
    gis_json_open(out, '[');
    for (int i = 0; i < OPT_N; i++) {
        if (!(gis_option_table[i].commands & command->bit)) continue;
        gis_json_line(out);
        put_option(out, command, &gis_option_table[i]);
    }
    gis_json_close(out, ']');
    gis_json_close(out, '}');
}

bool gis_options_json(gis_error *error)
{
    gis_json out = {0};
    gis_json_open(&out, '{');
    gis_json_put_string(&out, "program", "sunder");
    gis_json_put_string(&out, "version", sunder_version());
    gis_json_key(&out, "commands");
    gis_json_open(&out, '[');
    for (size_t i = 0; i < gis_n_commands; i++) {
        gis_json_line(&out);
        put_command(&out, &gis_commands[i]);
    }
    gis_json_close(&out, ']');
    gis_json_close(&out, '}');
    gis_json_raw(&out, "\n");
    const char *text = gis_json_text(&out);
    if (text) fputs(text, stdout); /* an error of stdio is found when stdout is closed */
    bool ok = text || gis_no_memory(error);
    gis_json_clear(&out);
    return ok;
}
