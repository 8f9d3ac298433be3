/* Reads JSON as far as the program's output and the recorded results need it: a tree, with numbers kept as text. */
#ifndef SUNDER_TESTS_JSON_H
#define SUNDER_TESTS_JSON_H

#include <stdbool.h>
#include <stddef.h>

typedef enum json_kind { JSON_NULL, JSON_BOOL, JSON_NUMBER, JSON_STRING, JSON_ARRAY, JSON_OBJECT } json_kind;

typedef struct json {
    json_kind kind;
    bool truth;
    char *text;        /* of a string or number */
    char *name;        /* name of a member of an object */
    struct json *item; /* the n elements of an array or object */
    size_t n;
} json;

/* NULL if the text is not exactly one JSON value. */
json *json_read(const char *text);
void json_free(json *value);
/* Returns a member, or NULL if there is none (or value is NULL). */
const json *json_get(const json *value, const char *name);
/* Number of items, 0 for NULL. */
size_t json_count(const json *value);
/* The text of a string or number, "" for anything else. */
const char *json_text(const json *value);

#endif
