/* sheet_barriers.c: layers that do not move, as values of --barrier. A layer whose widths or classes depend on a field
 * becomes one value for each, with a condition on the field. */
#include "sheet/sheet_inner.h"

#include "base/path.h"
#include "base/text.h"

#include <cpl_conv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const gis_sheet_barrier_keys[] = {"name",  "source", "layer", "where", "role",
                                              "class", "width",  "side",  "as",    NULL};

char *gis_sheet_dataset(const gis_sheet *sheet, const char *source)
{
    /* A connection string or a path of GDAL's virtual file systems is not relative to the sheet. */
    const bool relative = *source != '/' && !strchr(source, ':') && *source != '{' && *source != '<';
    return relative ? gis_path_join(sheet->directory, source) : gis_printed("%s", source);
}

/* A group of features with one width and one class. */
typedef struct group {
    const char *width, *width_is; /* the width, and the value of its field; NULL: any value without a width */
    const char *class_is;         /* the value of the field of classes; NULL: any that no rule has */
} group;

typedef struct maker {
    gis_sheet *sheet;
    struct json_object *layer, *widths; /* widths by value of a field; NULL: there are none */
    const char *place, *width_by, *width_field, *class_name, *class_field;
    gis_options *options;
} maker;

/* Adds text with a backslash before each comma. */
static void add_escaped(gis_text *to, const char *text)
{
    for (; *text; text++) {
        if (*text == ',') gis_text_add(to, "\\");
        gis_text_add_bytes(to, text, 1);
    }
}

/* Adds a text of SQL in these quotes. */
static void add_quoted(gis_text *to, const char *text, char quote)
{
    gis_text_add_bytes(to, &quote, 1);
    for (; *text; text++) {
        if (*text == quote) gis_text_add_bytes(to, &quote, 1);
        gis_text_add_bytes(to, text, 1);
    }
    gis_text_add_bytes(to, &quote, 1);
}

static void add_field(gis_text *to, const char *field)
{
    gis_text_add(to, "CAST(");
    add_quoted(to, field, '"');
    gis_text_add(to, " AS CHARACTER(255))");
}

static void add_and(gis_text *to, bool *any)
{
    gis_text_add(to, *any ? " AND (" : "(");
    *any = true;
}

/* Adds the condition that a field has this value, or none of the others if it is NULL. */
static void add_condition(gis_text *to, bool *any, const char *field, const char *value, const char *const *others,
                          size_t n)
{
    if (!field || (!value && n == 0)) return;
    add_and(to, any);
    if (!value) {
        add_quoted(to, field, '"');
        gis_text_add(to, " IS NULL OR ");
    }
    add_field(to, field);
    gis_text_add(to, value ? " = " : " NOT IN (");
    for (size_t k = 0; !value && k < n; k++) {
        if (k) gis_text_add(to, ", ");
        add_quoted(to, others[k], '\'');
    }
    if (value) add_quoted(to, value, '\'');
    gis_text_add(to, value ? ")" : "))");
}

/* Adds where= with the conditions of the layer and of the group. */
static bool add_where(const maker *m, const group *g, gis_text *to, gis_error *error)
{
    const char *where = NULL, **values = NULL;
    size_t n = 0;
    bool any = false;
    if (!gis_sheet_text(m->sheet, m->layer, m->place, "where", &where, error)) return false;
    gis_text condition = {0};
    if (where) {
        add_and(&condition, &any);
        gis_text_add(&condition, where);
        gis_text_add(&condition, ")");
    }
    if (m->widths) {
        values = calloc((size_t)json_object_object_length(m->widths) + 1, sizeof *values);
        if (!values) return gis_no_memory(error);
        json_object_object_foreach(m->widths, key, value)
        {
            (void)value;
            values[n++] = key;
        }
        add_condition(&condition, &any, m->width_by, g->width_is, values, n);
        free(values);
    }
    add_condition(&condition, &any, m->class_field, g->class_is, m->sheet->name + 1, m->sheet->gaps.classes - 1);
    if (any) gis_text_add(to, ",where=");
    if (any) gis_text_add(to, gis_text_get(&condition));
    gis_text_clear(&condition);
    return true;
}

static bool add_choice(const maker *m, const char *key, gis_text *to, gis_error *error)
{
    struct json_object *value = gis_sheet_member(m->layer, key);
    const char *role = json_object_get_string(gis_sheet_member(m->layer, "role"));
    char at[GIS_PLACE_SIZE];
    if (!value && strcmp(key, "side") == 0 && strcmp(role, "fixed") == 0) gis_text_add(to, ",side=no");
    if (!value) return true;
    snprintf(at, sizeof at, "%.90s.%.60s", m->place, key);
    if (strcmp(key, "side") == 0 && !json_object_is_type(value, json_type_boolean))
        return gis_sheet_fail(m->sheet, error, at, "must be true or false");
    const bool truth = json_object_is_type(value, json_type_boolean);
    const char *text = truth ? json_object_get_boolean(value) ? "yes" : "no" : gis_sheet_scalar(value);
    if (!text) return gis_sheet_fail(m->sheet, error, at, "must be a text");
    gis_text_print(to, ",%s=%s", key, text);
    return true;
}

/* Adds the value of --barrier for a group. */
static bool add_group(const maker *m, const group *g, gis_error *error)
{
    gis_sheet *sheet = m->sheet;
    const char *source = NULL, *layer = NULL;
    gis_text text = {0};
    gis_error why;
    if (!gis_sheet_text(sheet, m->layer, m->place, "source", &source, error) ||
        !gis_sheet_text(sheet, m->layer, m->place, "layer", &layer, error))
        return false;
    char *dataset = gis_sheet_dataset(sheet, source);
    add_escaped(&text, dataset);
    CPLFree(dataset);
    if (layer) gis_text_add(&text, ",layer=");
    if (layer) add_escaped(&text, layer);
    if (m->width_field) gis_text_add(&text, ",width-field=");
    if (m->width_field) add_escaped(&text, m->width_field);
    if (g->width) gis_text_print(&text, ",width=%s", g->width);
    uint32_t *more = realloc(sheet->of_barrier, (sheet->barriers + 1) * sizeof *more);
    if (more) sheet->of_barrier = more;
    bool ok = more || gis_no_memory(error);
    ok =
        ok && add_choice(m, "side", &text, error) && add_choice(m, "as", &text, error) && add_where(m, g, &text, error);
    if (ok && !gis_options_set(m->options, OPT_BARRIER, gis_text_get(&text), &why))
        ok = gis_sheet_fail(sheet, error, m->place, "%s", why.message);
    gis_text_clear(&text);
    const char *class_name = m->class_field ? g->class_is : m->class_name;
    if (ok) sheet->of_barrier[sheet->barriers++] = class_name ? gis_sheet_class(sheet, class_name) : 0;
    return ok;
}

/* Adds a group for each class of the features with one width. */
static bool add_classes(const maker *m, group g, gis_error *error)
{
    const gis_sheet *sheet = m->sheet;
    const bool same = m->class_field && m->width_by && strcmp(m->class_field, m->width_by) == 0;
    for (size_t k = 1; m->class_field && k < sheet->gaps.classes; k++) {
        g.class_is = sheet->name[k];
        /* With both in one field only one combination exists. */
        const bool has_width = same && gis_sheet_member(m->widths, g.class_is);
        if (same && (g.width_is ? strcmp(g.width_is, g.class_is) != 0 : has_width)) continue;
        if (!add_group(m, &g, error)) return false;
    }
    g.class_is = NULL;
    if (same && g.width_is && gis_sheet_class(sheet, g.width_is)) return true;
    return add_group(m, &g, error);
}

/* Reads "width": a length, {"field": NAME}, or {"by": NAME, "of": {VALUE: LENGTH}, "else": LENGTH}. */
static bool read_width(maker *m, group *rest, gis_error *error)
{
    static const char *const keys[] = {"field", "by", "of", "else", NULL};
    struct json_object *width = gis_sheet_member(m->layer, "width");
    char at[GIS_PLACE_SIZE];
    gis_optional_length length = {0};
    snprintf(at, sizeof at, "%.120s.width", m->place);
    if (!width) return true;
    if (!json_object_is_type(width, json_type_object)) {
        if (!gis_sheet_length(m->sheet, width, at, &length, error)) return false;
        rest->width = length.text;
        return true;
    }
    if (!gis_sheet_check_keys(m->sheet, width, at, keys, false, error) ||
        !gis_sheet_text(m->sheet, width, at, "field", &m->width_field, error) ||
        !gis_sheet_text(m->sheet, width, at, "by", &m->width_by, error))
        return false;
    m->widths = gis_sheet_member(width, "of");
    struct json_object *other = gis_sheet_member(width, "else");
    const bool by = m->width_by && json_object_is_type(m->widths, json_type_object);
    if (m->width_field ? m->width_by || m->widths || other : !by)
        return gis_sheet_fail(m->sheet, error, at,
                              "must be a length, {\"field\": NAME} or {\"by\": NAME, \"of\": {VALUE: LENGTH}, "
                              "\"else\": LENGTH}");
    if (other && !gis_sheet_length(m->sheet, other, at, &length, error)) return false;
    rest->width = length.text;
    return true;
}

bool gis_sheet_add_barriers(gis_sheet *sheet, struct json_object *layer, const char *place, gis_options *options,
                            gis_error *error)
{
    maker m = {.sheet = sheet, .layer = layer, .place = place, .options = options};
    group rest = {0};
    if (!gis_sheet_check_keys(sheet, layer, place, gis_sheet_barrier_keys, false, error) ||
        !gis_sheet_read_class(sheet, layer, place, &m.class_name, &m.class_field, error) ||
        !read_width(&m, &rest, error))
        return false;
    sheet->classes_by_field = sheet->classes_by_field || m.class_field;
    if (m.widths) {
        json_object_object_foreach(m.widths, key, value)
        {
            gis_optional_length length = {0};
            if (!gis_sheet_length(sheet, value, place, &length, error)) return false;
            if (!add_classes(&m, (group){.width = length.text, .width_is = key}, error)) return false;
        }
    }
    return add_classes(&m, rest, error);
}
