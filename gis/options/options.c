/* options.c: the parser. An option's value follows it or is joined by '=' (`--gap 3`, `--gap=3`); `--` ends the
 * options; operands and options may mix. Single-dash spellings are those of ogr2ogr. A word that starts with '-' and is
 * no option is an error, never an operand, so that a misspelt option cannot become a file name. */
#include "options/options.h"

#include "base/spelling.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct arguments {
    int next, count;
    char **word;
} arguments;

void gis_options_clear(gis_options *options)
{
    for (int i = 0; i < OPT_N; i++) free(options->list[i]);
    for (size_t i = 0; i < options->n_owned; i++) free(options->owned[i]);
    free(options->owned);
    for (size_t k = 0; k < options->n_more; k++) gis_options_clear(&options->more[k]);
    free(options->more);
    *options = (gis_options){0};
}

/* Is word[0..n) one of the choices, which are separated by '|' ("a|b|c")? */
static bool is_choice(const char *choices, const char *word, size_t n)
{
    for (const char *c = choices; *c;) {
        size_t length = strcspn(c, "|");
        if (n == length && memcmp(c, word, n) == 0) return true;
        c += length + (c[length] == '|');
    }
    return false;
}

/* Is word[0..n) one of the spellings, which are separated by blanks? */
static bool is_named(const char *names, const char *word, size_t n)
{
    for (const char *c = names; *c;) {
        size_t length = strcspn(c, " ");
        if (n == length && memcmp(c, word, n) == 0) return true;
        c += length + (c[length] == ' ');
    }
    return false;
}

static const gis_option *find_option(unsigned command, const char *word, size_t n)
{
    for (int i = 0; i < OPT_N; i++)
        if ((gis_option_table[i].commands & command) && is_named(gis_option_table[i].names, word, n))
            return &gis_option_table[i];
    return NULL;
}

/* The length of the first spelling, which is the name of the option in messages. */
static int name_length(const gis_option *option) { return (int)strcspn(option->names, " "); }

static bool push_value(gis_options *out, gis_option_id id, const char *value, gis_error *error)
{
    size_t n = 0;
    while (out->list[id] && out->list[id][n]) n++;
    const char **list = realloc(out->list[id], (n + 2) * sizeof *list);
    if (!list) return gis_no_memory(error);
    list[n] = value;
    list[n + 1] = NULL;
    out->list[id] = list;
    return true;
}

/* Allocates a text of n bytes that lives as long as the options; NULL if memory is out. */
static char *new_text(gis_options *out, size_t n)
{
    char **owned = realloc(out->owned, (out->n_owned + 1) * sizeof *owned);
    if (!owned) return NULL;
    out->owned = owned;
    char *text = malloc(n);
    if (text) out->owned[out->n_owned++] = text;
    return text;
}

static bool join_pair(gis_options *out, const char *key, const char *value, const char **joined, gis_error *error)
{
    size_t k = strlen(key), v = strlen(value);
    char *text = new_text(out, k + v + 2);
    if (!text) return gis_no_memory(error);
    memcpy(text, key, k);
    text[k] = '=';
    memcpy(text + k + 1, value, v + 1);
    *joined = text;
    return true;
}

bool gis_options_own(gis_options *options, const char *text, const char **copy, gis_error *error)
{
    char *own = new_text(options, strlen(text) + 1);
    if (!own) return gis_no_memory(error);
    *copy = strcpy(own, text);
    return true;
}

/* Reads XMIN,YMIN,XMAX,YMAX from one argument, or the four numbers from four arguments, of which `value` is the
 * first. */
static bool read_box(arguments *in, const char *value, double box[4], gis_error *error)
{
    double read[4];
    bool joined = strchr(value, ',') != NULL;
    for (int i = 0; i < 4; i++) {
        size_t n = strcspn(value, ",");
        if (!gis_length_parse_number(value, n, &read[i]) || (joined && i < 3 && value[n] != ',') ||
            (joined && i == 3 && value[n] == ',') || (!joined && i < 3 && in->next >= in->count))
            return gis_fail_usage(error, "--bbox: expected four finite numbers, XMIN,YMIN,XMAX,YMAX");
        if (joined)
            value += n + 1;
        else if (i < 3)
            value = in->word[in->next++];
    }
    if (read[0] > read[2] || read[1] > read[3])
        return gis_fail_usage(error, "--bbox: XMIN or YMIN is greater than its maximum");
    memcpy(box, read, sizeof read);
    return true;
}

/* The most digits of an integer that is surely exact as a double. */
enum { COUNT_DIGITS = DBL_DIG };

static bool read_count(const gis_option *option, const char *value, double *number, gis_error *error)
{
    size_t n = strlen(value);
    if (n == 0 || strspn(value, "0123456789") != n || n > COUNT_DIGITS)
        return gis_fail_usage(error, "%s %s: not a whole number", option->names, value);
    *number = strtod(value, NULL);
    return true;
}

static bool read_number(const gis_option *option, const char *value, double *number, gis_error *error)
{
    double read;
    if (!gis_length_parse_number(value, strlen(value), &read) || read < 0)
        return gis_fail_usage(error, "%s %s: not a number of 0 or more", option->names, value);
    *number = read;
    return true;
}

static bool read_scale(const char *value, double *number, gis_error *error)
{
    const char *text = strncmp(value, "1:", 2) == 0 ? value + 2 : value;
    double read;
    if (!gis_length_parse_number(text, strlen(text), &read) || read <= 0)
        return gis_fail_usage(error, "--scale %s: not a scale; expected N > 0 of a map 1:N, as in --scale 25000",
                              value);
    *number = read;
    return true;
}

bool gis_option_is_list(const gis_option *option) { return option->type >= GIS_TYPE_BARRIERS; }

bool gis_option_is_needed(const gis_option *option)
{
    gis_option_id id = option->id;
    return id == OPT_SHAPE || id == OPT_ROBOT || id == OPT_FROM || id == OPT_TO || id == OPT_SHARDS;
}

/* Stores one value of the option; `value` is NULL for a flag. */
static bool set_value(const gis_option *option, arguments *in, const char *value, gis_options *out, gis_error *error)
{
    int n = name_length(option);
    gis_option_id id = option->id;
    switch (option->type) {
    case GIS_TYPE_FLAG: return true;
    case GIS_TYPE_BARRIERS:
    case GIS_TYPE_FORMATS: return push_value(out, id, value, error);
    case GIS_TYPE_SETTINGS:
        if (!strchr(value, '=')) return gis_fail_usage(error, "%.*s %s: expected K=V", n, option->names, value);
        return push_value(out, id, value, error);
    case GIS_TYPE_PAIRS:
        if (!strchr(value, '=')) {
            if (in->next >= in->count) return gis_fail_usage(error, "%.*s %s: expected K=V", n, option->names, value);
            if (!join_pair(out, value, in->word[in->next++], &value, error)) return false;
        }
        return push_value(out, id, value, error);
    case GIS_TYPE_BOX: return read_box(in, value, out->box, error);
    case GIS_TYPE_COUNT: return read_count(option, value, &out->number[id], error);
    case GIS_TYPE_NUMBER: return read_number(option, value, &out->number[id], error);
    case GIS_TYPE_SCALE: return read_scale(value, &out->number[id], error);
    case GIS_TYPE_LENGTH: {
        const char *why;
        if (!gis_length_parse(value, strlen(value), &out->length[id], &why))
            return gis_fail_usage(error, "%.*s %s: %s", n, option->names, value, why);
        break;
    }
    case GIS_TYPE_CHOICE:
        if (!is_choice(option->metavar, value, strlen(value)))
            return gis_fail_usage(error, "%.*s %s: must be one of %s", n, option->names, value, option->metavar);
        break;
    case GIS_TYPE_OPTIONAL:
        if (value && strcmp(value, option->metavar) != 0)
            return gis_fail_usage(error, "%.*s=%s: expected %.*s or %.*s=%s", n, option->names, value, n, option->names,
                                  n, option->names, option->metavar);
        break;
    default:
        if (!*value) return gis_fail_usage(error, "%.*s: its value is empty", n, option->names);
        break;
    }
    out->text[id] = value;
    return true;
}

static size_t count_dashes(const char *word, size_t n)
{
    size_t count = strspn(word, "-");
    return count < n ? count : n;
}

/* Fails with a message that suggests the most similar spelling, if one is similar, or says that the option belongs to
 * other commands. */
static bool unknown_option(const gis_command *command, const char *word, size_t n, gis_error *error)
{
    const gis_option *elsewhere = find_option(GIS_EVERY, word, n);
    gis_spelling search = gis_spelling_of(word + count_dashes(word, n), n - count_dashes(word, n));
    const char *spelling = NULL;
    for (int i = 0; i < OPT_N; i++) {
        const gis_option *option = &gis_option_table[i];
        if (!(option->commands & command->bit)) continue;
        for (const char *c = option->names; *c; c += strspn(c, " ")) {
            size_t length = strcspn(c, " "), skip = count_dashes(c, length);
            const char *before = search.best;
            gis_spelling_offer(&search, c + skip, length - skip);
            if (search.best != before) spelling = c;
            c += length;
        }
    }
    if (elsewhere)
        return gis_fail_usage(error,
                              "unknown option %.*s: it belongs to other commands than %s; `sunder %s --help` "
                              "lists them",
                              (int)n, word, command->name, command->name);
    if (spelling)
        return gis_fail_usage(error, "unknown option %.*s; did you mean %.*s? `sunder %s --help` lists them", (int)n,
                              word, (int)strcspn(spelling, " "), spelling, command->name);
    return gis_fail_usage(error, "unknown option %.*s; `sunder %s --help` lists them", (int)n, word, command->name);
}

static bool parse_option(const char *word, arguments *in, gis_options *out, gis_error *error)
{
    const char *equals = strchr(word, '=');
    size_t n = equals ? (size_t)(equals - word) : strlen(word);
    const gis_option *option = find_option(out->command->bit, word, n);
    if (!option) return unknown_option(out->command, word, n, error);
    if (out->given[option->id] && !gis_option_is_list(option) && option->type != GIS_TYPE_FLAG)
        return gis_fail_usage(error, "%.*s is given twice", name_length(option), option->names);
    out->given[option->id] = true;
    const char *value = equals ? equals + 1 : NULL;
    if (option->type == GIS_TYPE_FLAG && value) return gis_fail_usage(error, "%.*s takes no value", (int)n, word);
    if (!value && option->type != GIS_TYPE_FLAG && option->type != GIS_TYPE_OPTIONAL) {
        if (in->next >= in->count)
            return gis_fail_usage(error, "%.*s needs a value (%s)", (int)n, word, option->metavar);
        value = in->word[in->next++];
    }
    return set_value(option, in, value, out, error);
}

/* With --shard all other options must be those of the plan, except options that the command merge has, too. Fails if
 * another one is given. */
static bool check_shard(const gis_options *out, gis_error *error)
{
    for (int i = 0; i < OPT_N; i++) {
        const gis_option *option = &gis_option_table[i];
        if (out->given[i] && i != OPT_SHARD && !(option->commands & GIS_MERGE))
            return gis_fail_usage(
                error, "%.*s cannot be given with --shard, since it is part of the plan; give it to sunder plan",
                name_length(option), option->names);
    }
    return out->n_operands == 1 ||
           gis_fail_usage(error, "sunder separate --shard K takes one operand, PLAN; `sunder plan` makes one");
}

/* Refuses an option that is given without any of the options that give it a meaning. The message names those that the
 * command has. */
static bool refuse_alone(const gis_options *out, const gis_option *option, const gis_need *need, gis_error *error)
{
    char names[256];
    size_t length = 0, left = 0;
    for (size_t k = 0; k < need->n; k++) left += (gis_option_table[need->one_of[k]].commands & out->command->bit) != 0;
    for (size_t k = 0; k < need->n; k++) {
        const gis_option *other = &gis_option_table[need->one_of[k]];
        if (!(other->commands & out->command->bit)) continue;
        const char *separator = --left == 0 ? "" : left == 1 ? " or " : ", ";
        const int written =
            snprintf(names + length, sizeof names - length, "%.*s%s", name_length(other), other->names, separator);
        length += (size_t)written;
    }
    return gis_fail_usage(error, "%.*s needs %s", name_length(option), option->names, names);
}

/* Refuses an option that says how others work, if none of them is given. */
static bool check_needs(const gis_options *out, gis_error *error)
{
    for (int i = 0; i < OPT_N; i++) {
        const gis_need *need = out->given[i] ? gis_option_need((gis_option_id)i) : NULL;
        bool met = !need;
        for (size_t k = 0; need && k < need->n; k++) met = met || out->given[need->one_of[k]];
        if (!met) return refuse_alone(out, &gis_option_table[i], need, error);
    }
    return true;
}

bool gis_options_set(gis_options *options, gis_option_id id, const char *value, gis_error *error)
{
    arguments none = {0, 0, NULL};
    const char *own = NULL;
    if (value && !gis_options_own(options, value, &own, error)) return false;
    options->given[id] = true;
    return set_value(&gis_option_table[id], &none, own, options, error);
}

bool gis_options_copy(const gis_options *options, gis_options *copy, gis_error *error)
{
    bool ok = true;
    *copy = *options;
    copy->owned = NULL;
    copy->more = NULL;
    copy->n_owned = copy->n_more = 0;
    for (int id = 0; id < OPT_N; id++) {
        size_t n = 0;
        copy->list[id] = NULL;
        if (!options->list[id]) continue;
        while (options->list[id][n]) n++;
        copy->list[id] = malloc((n + 1) * sizeof *copy->list[id]);
        if (copy->list[id]) memcpy(copy->list[id], options->list[id], (n + 1) * sizeof *copy->list[id]);
        ok = ok && copy->list[id];
    }
    return ok || gis_no_memory(error);
}

/* Sets the defaults of choices. */
static void set_choices(gis_options *out)
{
    for (int i = 0; i < OPT_N; i++) {
        const gis_option *option = &gis_option_table[i];
        if (option->type == GIS_TYPE_CHOICE && !out->given[option->id]) out->text[option->id] = option->fallback;
    }
}

bool gis_options_finish(gis_options *options, gis_error *error)
{
    gis_options *out = options;
    const gis_command *command = out->command;
    set_choices(out);
    if (out->given[OPT_OUTPUT]) {
        if (out->n_operands >= command->most)
            return gis_fail_usage(error, "OUTPUT is given twice, as an operand and by --output");
        if (out->n_operands + 1 == command->most) out->operand[out->n_operands++] = out->text[OPT_OUTPUT];
    }
    if (out->given[OPT_SHARD]) return check_shard(out, error);
    if (out->n_operands < command->least)
        return gis_fail_usage(error, "sunder %s needs %s; see `sunder %s --help`", command->name, command->operands,
                              command->name);
    if (out->given[OPT_OGR_OVERWRITE]) out->given[OPT_UPDATE] = out->given[OPT_OVERWRITE_LAYER] = true;
    if (out->given[OPT_OVERWRITE] && out->given[OPT_UPDATE])
        return gis_fail_usage(error, "--overwrite replaces the whole dataset, --update adds to it: give one of them "
                                     "(--update --overwrite-layer replaces layers)");
    if (out->given[OPT_INPUT_LAYER] && out->given[OPT_SQL])
        return gis_fail_usage(error, "--input-layer and --sql cannot be given together");
    return check_needs(out, error);
}

bool gis_options_parse(const gis_command *command, int argc, char **argv, gis_options *out, gis_error *error)
{
    *out = (gis_options){.command = command};
    arguments in = {0, argc, argv};
    bool operands_only = false;
    for (int i = 0; i < argc && strcmp(argv[i], "--") != 0; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            out->given[OPT_HELP] = true;
            return true;
        }
    }
    while (in.next < in.count) {
        const char *word = in.word[in.next++];
        if (!operands_only && strcmp(word, "--") == 0) {
            operands_only = true;
        } else if (!operands_only && word[0] == '-' && word[1] != '\0') {
            if (!parse_option(word, &in, out, error)) return false;
        } else if (out->n_operands == command->most) {
            return gis_fail_usage(error, "one operand too many: %s (sunder %s takes %s)", word, command->name,
                                  command->operands);
        } else if (!*word) {
            return gis_fail_usage(error, "an operand is empty (sunder %s takes %s)", command->name, command->operands);
        } else {
            out->operand[out->n_operands++] = word;
        }
    }
    set_choices(out);
    return out->given[OPT_SPEC] ? check_needs(out, error) : gis_options_finish(out, error);
}
