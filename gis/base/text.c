/* text.c: see text.h. */
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void gis_text_clear(gis_text *text)
{
    free(text->at);
    *text = (gis_text){0};
}

void gis_text_empty(gis_text *text)
{
    if (text->at) text->at[0] = '\0';
    text->length = 0;
}

const char *gis_text_get(const gis_text *text) { return text->failed ? NULL : text->at ? text->at : ""; }

/* Makes room for n more bytes and the NUL. */
static bool reserve_bytes(gis_text *text, size_t n)
{
    if (text->failed) return false;
    if (text->capacity - text->length > n) return true;
    size_t capacity = text->capacity * 2 + n + 256;
    char *at = realloc(text->at, capacity);
    text->failed = !at;
    if (!at) return false;
    text->at = at;
    text->capacity = capacity;
    return true;
}

void gis_text_add_bytes(gis_text *text, const char *bytes, size_t n)
{
    if (!reserve_bytes(text, n)) return;
    memcpy(text->at + text->length, bytes, n);
    text->length += n;
    text->at[text->length] = '\0';
}

void gis_text_add(gis_text *text, const char *string) { gis_text_add_bytes(text, string, strlen(string)); }

/* Prints into the available room, and again after growing if that was too small. */
void gis_text_print(gis_text *text, const char *format, ...)
{
    va_list arguments, again;
    if (!reserve_bytes(text, 64)) return;
    va_start(arguments, format);
    va_copy(again, arguments);
    size_t room = text->capacity - text->length;
    int n = vsnprintf(text->at + text->length, room, format, arguments);
    if (n >= 0 && (size_t)n >= room) {
        text->at[text->length] = '\0';
        if (reserve_bytes(text, (size_t)n)) vsnprintf(text->at + text->length, (size_t)n + 1, format, again);
    }
    if (n >= 0 && !text->failed) text->length += (size_t)n;
    va_end(again);
    va_end(arguments);
}
