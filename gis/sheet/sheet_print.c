/* sheet_print.c: the effective sheet (--print-spec), and the JSON Schema of sheets. */
#include "sheet/sheet_inner.h"

#include "base/json.h"

#include <stdio.h>
#include <string.h>

/* ---- The effective sheet ----------------------------------------------------------------------------------------- */

/* The value of an option as the command line gave it. */
static struct json_object *value_of(const gis_options *options, const gis_option *option)
{
    char number[GIS_NUMBER_MAX];
    if (option->type == GIS_TYPE_FLAG) return json_object_new_boolean(true);
    if (gis_option_is_list(option)) {
        struct json_object *list = json_object_new_array();
        for (const char *const *each = options->list[option->id]; each && *each; each++)
            json_object_array_add(list, json_object_new_string(*each));
        return list;
    }
    if (options->text[option->id]) return json_object_new_string(options->text[option->id]);
    gis_number_text(options->number[option->id], number);
    return json_object_new_double_s(options->number[option->id], number);
}

/* Puts a gap of the command line into the rules for all classes, which come first. */
static void put_gap_value(struct json_object *root, const char *key, struct json_object *value)
{
    struct json_object *old = gis_sheet_member(root, "gaps"), *gaps = json_object_new_array();
    const size_t n = old ? json_object_array_length(old) : 0;
    if (n == 0 || !gis_sheet_is_for_all(json_object_array_get_idx(old, 0))) {
        struct json_object *rule = json_object_new_object(), *between = json_object_new_array();
        for (int k = 0; k < 2; k++) json_object_array_add(between, json_object_new_string("*"));
        json_object_object_add(rule, "between", between);
        json_object_array_add(gaps, rule);
    }
    for (size_t k = 0; k < n; k++) json_object_array_add(gaps, json_object_get(json_object_array_get_idx(old, k)));
    json_object_object_add(root, "gaps", gaps);
    for (size_t k = 0; k < json_object_array_length(gaps); k++) {
        struct json_object *rule = json_object_array_get_idx(gaps, k);
        if (!gis_sheet_is_for_all(rule)) break;
        json_object_object_add(rule, key, json_object_get(value));
    }
    json_object_put(value);
}

/* Puts the value of an option of the command line where it has the same effect. */
static void put_value(struct json_object *root, const char *key, const gis_options *options, const gis_option *option)
{
    struct json_object *layers = gis_sheet_member(root, "layers"), *defaults = gis_sheet_member(root, "defaults");
    const bool gap = option->id == OPT_GAP || option->id == OPT_LEAST_GAP;
    if (gap && (gis_sheet_member(root, "gaps") || options->n_more)) {
        put_gap_value(root, option->id == OPT_GAP ? "gap" : "least", value_of(options, option));
        return;
    }
    if (options->n_more && gis_sheet_is_common(option->id)) {
        if (!defaults) json_object_object_add(root, "defaults", defaults = json_object_new_object());
        json_object_object_add(defaults, key, value_of(options, option));
        return;
    }
    for (size_t k = 0; k < json_object_array_length(layers); k++) {
        struct json_object *layer = json_object_array_get_idx(layers, k);
        if (gis_sheet_is_moving(layer)) json_object_object_add(layer, key, value_of(options, option));
    }
}

bool gis_sheet_make_effective(gis_sheet *sheet, const gis_options *options, gis_error *error)
{
    if (json_object_deep_copy(sheet->root, &sheet->effective, NULL) != 0) return gis_no_memory(error);
    for (int id = 0; id < OPT_N; id++) {
        const gis_option *option = &gis_option_table[id];
        char key[64];
        if (!sheet->said[id]) continue;
        if (id == OPT_SCALE) json_object_object_add(sheet->effective, "scale", value_of(options, option));
        if (gis_rule_key(option, key, sizeof key)) put_value(sheet->effective, key, options, option);
    }
    return true;
}

void gis_sheet_print(const gis_sheet *sheet)
{
    const int how = JSON_C_TO_STRING_PRETTY | JSON_C_TO_STRING_SPACED | JSON_C_TO_STRING_NOSLASHESCAPE;
    puts(json_object_to_json_string_ext(sheet->effective, how));
}

/* ---- The schema -------------------------------------------------------------------------------------------------- */

static void put_type(gis_json *out, const char *key, const char *type, const char *about)
{
    gis_json_line(out);
    gis_json_key(out, key);
    gis_json_open(out, '{');
    if (strchr(type, '|')) {
        gis_json_key(out, "type");
        gis_json_open(out, '[');
        for (const char *c = type; *c; c += strcspn(c, "|") + (c[strcspn(c, "|")] == '|')) {
            char word[16];
            snprintf(word, sizeof word, "%.*s", (int)strcspn(c, "|"), c);
            gis_json_string(out, word);
        }
        gis_json_close(out, ']');
    } else {
        gis_json_put_string(out, "type", type);
    }
    if (about) gis_json_put_string(out, "description", about);
    gis_json_close(out, '}');
}

static void put_rules(gis_json *out)
{
    for (int id = 0; id < OPT_N; id++) {
        const gis_option *option = &gis_option_table[id];
        char key[64];
        if (!gis_rule_key(option, key, sizeof key)) continue;
        const char *type = option->type == GIS_TYPE_FLAG ? "boolean"
                           : gis_option_is_list(option)  ? "array|string"
                                                         : "string|number|array";
        put_type(out, key, type, option->help);
    }
}

static void put_required(gis_json *out, const char *const *keys)
{
    gis_json_key(out, "required");
    gis_json_open(out, '[');
    for (; *keys; keys++) gis_json_string(out, *keys);
    gis_json_close(out, ']');
}

/* Opens an object of the schema, whose properties follow. */
static void open_object(gis_json *out, const char *key)
{
    gis_json_line(out);
    if (key) gis_json_key(out, key);
    gis_json_open(out, '{');
    gis_json_put_string(out, "type", "object");
    gis_json_put_bool(out, "additionalProperties", false);
    gis_json_key(out, "properties");
    gis_json_open(out, '{');
    put_type(out, "comment", "string", "ignored");
}

static void put_legible(gis_json *out)
{
    open_object(out, "legible");
    for (int kind = 0; kind < SUNDER_ILLEGIBLE_KINDS; kind++)
        put_type(out, gis_legible_key((sunder_illegible_kind)kind), "string|number", gis_sheet_legible_about[kind]);
    gis_json_close(out, '}');
    gis_json_close(out, '}');
}

static void put_layer(gis_json *out)
{
    open_object(out, NULL);
    put_type(out, "name", "string", "name of the layer in the output, and its class unless \"class\" says another");
    put_type(out, "source", "string", "dataset; a relative path is relative to the sheet");
    put_type(out, "layer", "string", "layer of the dataset");
    put_type(out, "crs", "string", "CRS of the source, in place of its own");
    put_type(out, "role", "string",
             "move; fixed: never moves; barrier: never moves, and is not crossed; "
             "follow: goes along with what moves");
    put_type(out, "by", "string", "follow: what a feature goes along with: inside, nearest:LENGTH or field:NAME");
    put_type(out, "of", "string", "follow: the layer that moves which it goes along with; unless given, all of them");
    put_type(out, "class", "string|object", "class for gaps: a name, or {\"field\": NAME}");
    put_type(out, "width", "string|number|object",
             "barriers: drawn width; {\"field\": NAME}, or {\"by\": NAME, \"of\": {VALUE: LENGTH}, \"else\": LENGTH}");
    put_type(out, "side", "boolean", "barriers: features stay on their side");
    put_type(out, "as", "string", "barriers: area, or boundary: the rings of polygons as lines");
    put_rules(out);
    put_legible(out);
    gis_json_close(out, '}');
    put_required(out, (const char *const[]){"source", "role", NULL});
    gis_json_close(out, '}');
}

static void put_gap(gis_json *out)
{
    open_object(out, NULL);
    put_type(out, "between", "array", "two classes, in either order; \"*\" is every class");
    put_type(out, "gap", "string|number", "the distance that they keep; for barriers from the drawn edge");
    put_type(out, "least", "string|number", "they may stand between this and the gap, at a price");
    gis_json_close(out, '}');
    put_required(out, (const char *const[]){"between", NULL});
    gis_json_close(out, '}');
}

static void open_array(gis_json *out, const char *key, const char *about)
{
    gis_json_line(out);
    gis_json_key(out, key);
    gis_json_open(out, '{');
    gis_json_put_string(out, "type", "array");
    gis_json_put_string(out, "description", about);
    gis_json_key(out, "items");
}

bool gis_sheet_print_schema(gis_error *error)
{
    gis_json out = {0};
    gis_json_open(&out, '{');
    gis_json_put_string(&out, "$schema", "https://json-schema.org/draft/2020-12/schema");
    gis_json_put_string(&out, "title", "A map sheet for sunder --spec");
    gis_json_put_string(&out, "type", "object");
    gis_json_put_bool(&out, "additionalProperties", false);
    gis_json_key(&out, "properties");
    gis_json_open(&out, '{');
    put_type(&out, "title", "string", "ignored");
    put_type(&out, "comment", "string", "ignored");
    put_type(&out, "scale", "string|number", gis_option_table[OPT_SCALE].help);
    open_object(&out, "defaults");
    put_rules(&out);
    gis_json_close(&out, '}');
    gis_json_close(&out, '}');
    put_legible(&out);
    open_array(&out, "layers", "layers that move, and layers that do not");
    put_layer(&out);
    gis_json_close(&out, '}');
    open_array(&out, "gaps", "the last one that matches two classes counts");
    put_gap(&out);
    gis_json_close(&out, '}');
    gis_json_close(&out, '}');
    put_required(&out, (const char *const[]){"layers", NULL});
    gis_json_close(&out, '}');
    const char *text = gis_json_text(&out);
    if (text) puts(text);
    const bool ok = text || gis_no_memory(error);
    gis_json_clear(&out);
    return ok;
}
