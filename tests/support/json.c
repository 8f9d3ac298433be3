#include "json.h"

#include "polyset.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#define DEEPEST 64

typedef struct reader {
    const char *s;
    int depth;
} reader;

static bool read_value(reader *r, json *out);

static void space(reader *r)
{
    while (isspace((unsigned char)*r->s)) r->s++;
}

static char *keep(const char *s, size_t n)
{
    char *text = test_alloc(n + 1, 1);
    memcpy(text, s, n);
    text[n] = '\0';
    return text;
}

/* A string; escapes other than \u are resolved, \u is kept as it is. */
static char *read_string(reader *r)
{
    if (*r->s != '"') return NULL;
    const char *start = ++r->s;
    char *text = test_alloc(strlen(start) + 1, 1);
    size_t n = 0;
    while (*r->s && *r->s != '"') {
        char c = *r->s++;
        if (c == '\\' && *r->s) {
            c = *r->s++;
            if (c == 'n')
                c = '\n';
            else if (c == 't')
                c = '\t';
            else if (c == 'u')
                text[n++] = '\\';
        }
        text[n++] = c;
    }
    text[n] = '\0';
    if (*r->s++ == '"') return text;
    free(text);
    return NULL;
}

static bool read_items(reader *r, json *out, char close)
{
    r->s++;
    if (++r->depth > DEEPEST) return false;
    for (space(r); *r->s != close; space(r)) {
        if (out->n && *r->s++ != ',') return false;
        space(r);
        if ((out->n & (out->n - 1)) == 0)
            out->item = test_resize(out->item, out->n ? 2 * out->n : 1, sizeof *out->item);
        json *item = &out->item[out->n++];
        memset(item, 0, sizeof *item);
        char *name = NULL;
        if (close == '}') {
            name = read_string(r);
            space(r);
            if (!name || *r->s++ != ':') {
                free(name);
                return false;
            }
        }
        const bool ok = read_value(r, item);
        item->name = name;
        if (!ok) return false;
    }
    r->s++;
    r->depth--;
    return true;
}

static bool read_value(reader *r, json *out)
{
    static const struct {
        const char *word;
        json_kind kind;
        bool truth;
    } words[] = {{"null", JSON_NULL, false}, {"true", JSON_BOOL, true}, {"false", JSON_BOOL, false}};
    memset(out, 0, sizeof *out);
    space(r);
    if (*r->s == '"') {
        out->kind = JSON_STRING;
        return (out->text = read_string(r)) != NULL;
    }
    if (*r->s == '[' || *r->s == '{') {
        out->kind = *r->s == '[' ? JSON_ARRAY : JSON_OBJECT;
        return read_items(r, out, *r->s == '[' ? ']' : '}');
    }
    for (size_t i = 0; i < 3; i++)
        if (strncmp(r->s, words[i].word, strlen(words[i].word)) == 0) {
            r->s += strlen(words[i].word);
            out->kind = words[i].kind;
            out->truth = words[i].truth;
            return true;
        }
    const size_t n = strspn(r->s, "+-.0123456789eE");
    if (!n) return false;
    out->kind = JSON_NUMBER;
    out->text = keep(r->s, n);
    r->s += n;
    return true;
}

static void clear(json *value)
{
    for (size_t i = 0; i < value->n; i++) clear(&value->item[i]);
    free(value->item);
    free(value->text);
    free(value->name);
}

json *json_read(const char *text)
{
    reader r = {text, 0};
    json *value = test_alloc(1, sizeof *value);
    bool ok = read_value(&r, value);
    space(&r);
    ok = ok && *r.s == '\0';
    if (ok) return value;
    json_free(value);
    return NULL;
}

void json_free(json *value)
{
    if (!value) return;
    clear(value);
    free(value);
}

const json *json_get(const json *value, const char *name)
{
    for (size_t i = 0; value && value->kind == JSON_OBJECT && i < value->n; i++)
        if (strcmp(value->item[i].name, name) == 0) return &value->item[i];
    return NULL;
}

size_t json_count(const json *value) { return value ? value->n : 0; }

const char *json_text(const json *value) { return value && value->text ? value->text : ""; }
