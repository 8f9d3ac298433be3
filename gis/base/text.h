/* text.h: a text that grows. An allocation that fails makes it stay failed, which is asked for once, at the end. */
#ifndef GIS_TEXT_H
#define GIS_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Start from a zeroed struct; gis_text_clear() frees it. */
typedef struct gis_text {
    char *at; /* NULL while nothing was added; ends with a NUL that length does not count */
    size_t length, capacity;
    bool failed;
} gis_text;

void gis_text_clear(gis_text *text);
/* "" again, with its room. */
void gis_text_empty(gis_text *text);
/* The text so far, "" if empty; NULL after a failed allocation. */
const char *gis_text_get(const gis_text *text);

void gis_text_add_bytes(gis_text *text, const char *bytes, size_t n);
void gis_text_add(gis_text *text, const char *string);
void gis_text_print(gis_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
