/* gis_error.c: errors as sentences that functions return to their callers; lists of sentences. */
#include "base/gis_error.h"

#include "base/array.h"
#include "base/interrupt.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void gis_make_one_line(char *text)
{
    size_t end = 0;
    for (size_t i = 0; text[i]; i++) {
        if (text[i] == '\n' || text[i] == '\r' || text[i] == '\t') text[i] = ' ';
        if (text[i] != ' ') end = i + 1;
    }
    text[end] = '\0';
}

static bool fail_with(gis_error *error, int exit_status, const char *format, va_list arguments)
{
    if (error) {
        bool interrupted = gis_interrupted();
        error->exit_status = interrupted ? GIS_FAILED : exit_status;
        error->no_memory = error->in_a_box = false;
        if (interrupted)
            snprintf(error->message, sizeof error->message, "%s", gis_interruption());
        else
            vsnprintf(error->message, sizeof error->message, format, arguments);
        gis_make_one_line(error->message);
    }
    return false;
}

bool gis_fail(gis_error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fail_with(error, GIS_FAILED, format, arguments);
    va_end(arguments);
    return false;
}

bool gis_fail_usage(gis_error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fail_with(error, GIS_USAGE, format, arguments);
    va_end(arguments);
    return false;
}

bool gis_is_interruption(const gis_error *error)
{
    return strncmp(error->message, GIS_INTERRUPTED, strlen(GIS_INTERRUPTED)) == 0;
}

bool gis_no_memory(gis_error *error)
{
    gis_fail(error, "out of memory");
    if (error) error->no_memory = !gis_interrupted();
    return false;
}

static bool add_text(gis_sentences *list, const char *text)
{
    for (size_t i = 0; i < list->n; i++)
        if (strcmp(list->items[i], text) == 0) return true;
    if (!gis_array_reserve(&list->items, &list->capacity, list->n + 1, sizeof *list->items)) return false;
    char *copy = strdup(text);
    if (!copy) return false;
    list->items[list->n++] = copy;
    return true;
}

bool gis_sentences_add(gis_sentences *list, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    gis_make_one_line(text);
    return add_text(list, text);
}

void gis_sentences_clear(gis_sentences *list)
{
    for (size_t i = 0; i < list->n; i++) free(list->items[i]);
    free(list->items);
    *list = (gis_sentences){0};
}
