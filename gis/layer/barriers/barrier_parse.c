/* barrier_parse.c: parses the value of --barrier in place. Parts are separated by commas; a comma within a value is
 * written "\,", and any other backslash is itself, so that paths may contain some. Everything after where= is an
 * expression, in which commas have no special meaning. */
#include "layer/barriers/barrier.h"

#include "base/spelling.h"

#include <stdlib.h>
#include <string.h>

enum { KEY_LAYER, KEY_WIDTH, KEY_WIDTH_FIELD, KEY_GAP, KEY_LEAST, KEY_SIDE, KEY_AS, KEY_WHERE, N_KEYS };
static const char *const keys[N_KEYS] = {"layer", "width", "width-field", "gap", "least", "side", "as", "where"};

void gis_barrier_request_clear(gis_barrier_request *request)
{
    free(request->text);
    *request = (gis_barrier_request){0};
}

/* Ends the word at *rest at the next comma and moves *rest behind it; NULL if it was the last word. Replaces "\," in
 * the word. */
static char *next_word(char **rest)
{
    char *word = *rest, *to = word, *from = word;
    for (; *from && *from != ','; from++) {
        if (from[0] == '\\' && from[1] == ',') from++;
        *to++ = *from;
    }
    *rest = *from ? from + 1 : NULL;
    *to = '\0';
    return word;
}

static int find_key(const char *word, size_t n)
{
    int key = 0;
    while (key < N_KEYS && (strlen(keys[key]) != n || memcmp(keys[key], word, n) != 0)) key++;
    return key;
}

static bool unknown_key(const char *argument, const char *word, size_t n, gis_error *error)
{
    gis_spelling search = gis_spelling_of(word, n);
    for (int key = 0; key < N_KEYS; key++) gis_spelling_offer(&search, keys[key], strlen(keys[key]));
    if (search.best)
        return gis_fail_usage(error, "--barrier %s: %.*s is not known; did you mean %s=?", argument, (int)n, word,
                              search.best);
    return gis_fail_usage(error,
                          "--barrier %s: %.*s is none of layer=, width=, width-field=, gap=, least=, side=, as=, "
                          "where=; a comma in a name is written \\,",
                          argument, (int)n, word);
}

static bool take_length(const char *argument, const char *key, const char *value, gis_optional_length *out,
                        gis_error *error)
{
    const char *why;
    if (!gis_length_parse(value, strlen(value), &out->length, &why))
        return gis_fail_usage(error, "--barrier %s: %s=%s: %s", argument, key, value, why);
    out->text = value;
    return true;
}

/* Sets *out to whether the value is `yes`; fails if it is neither `yes` nor `no`. */
static bool take_choice(const char *argument, const char *key, const char *value, const char *yes, const char *no,
                        bool *out, gis_error *error)
{
    *out = strcmp(value, yes) == 0;
    return *out || strcmp(value, no) == 0 ||
           gis_fail_usage(error, "--barrier %s: %s=%s: must be %s or %s", argument, key, value, yes, no);
}

static bool take_value(const char *argument, int key, const char *value, gis_barrier_request *out, gis_error *error)
{
    bool area;
    switch (key) {
    case KEY_LAYER: out->layer = value; return true;
    case KEY_WIDTH_FIELD: out->width_field = value; return true;
    case KEY_WHERE: out->where = value; return true;
    case KEY_WIDTH: return take_length(argument, keys[key], value, &out->width, error);
    case KEY_GAP: return take_length(argument, keys[key], value, &out->gap, error);
    case KEY_LEAST: return take_length(argument, keys[key], value, &out->least, error);
    case KEY_SIDE: return take_choice(argument, keys[key], value, "yes", "no", &out->side, error);
    default:
        if (!take_choice(argument, keys[key], value, "area", "boundary", &area, error)) return false;
        out->as_boundary = !area;
        return true;
    }
}

static bool take_words(const char *argument, gis_barrier_request *out, gis_error *error)
{
    bool given[N_KEYS] = {false};
    char *rest = out->text;
    out->dataset = next_word(&rest);
    if (!*out->dataset) return gis_fail_usage(error, "--barrier %s: the name of the dataset is missing", argument);
    while (rest) {
        size_t n = strcspn(rest, "=,");
        if (rest[n] != '=') return unknown_key(argument, rest, n, error);
        int key = find_key(rest, n);
        if (key == N_KEYS) return unknown_key(argument, rest, n, error);
        if (given[key]) return gis_fail_usage(error, "--barrier %s: %s= is given twice", argument, keys[key]);
        given[key] = true;
        char *value = rest + n + 1;
        rest = value;
        if (key == KEY_WHERE)
            rest = NULL;
        else
            next_word(&rest);
        if (!*value) return gis_fail_usage(error, "--barrier %s: %s= is empty", argument, keys[key]);
        if (!take_value(argument, key, value, out, error)) return false;
    }
    if (given[KEY_WIDTH] && given[KEY_WIDTH_FIELD])
        return gis_fail_usage(
            error, "--barrier %s: width= gives one width for all, width-field= one for each: give one of them",
            argument);
    return true;
}

bool gis_barrier_parse(const char *text, gis_barrier_request *out, gis_error *error)
{
    gis_barrier_request parsed = {.text = malloc(strlen(text) + 1), .side = true};
    if (!parsed.text) return gis_no_memory(error);
    strcpy(parsed.text, text);
    if (!take_words(text, &parsed, error)) {
        gis_barrier_request_clear(&parsed);
        return false;
    }
    *out = parsed;
    return true;
}
