/* text.h: a growing text. After a failed allocation it stays failed, which is tested once, at the end. */
#ifndef GIS_TEXT_H
#define GIS_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* A text; start from a zeroed struct. */
typedef struct gis_text {
    char *at; /* ends with a NUL that `length` does not count; NULL: nothing was added yet */
    size_t length, capacity;
    bool failed;
} gis_text;

void gis_text_clear(gis_text *text);
/* Makes the text empty, but keeps its memory. */
void gis_text_empty(gis_text *text);
/* The text, "" if it is empty; NULL after a failed allocation. */
const char *gis_text_get(const gis_text *text);

void gis_text_add_bytes(gis_text *text, const char *bytes, size_t n);
void gis_text_add(gis_text *text, const char *string);
void gis_text_print(gis_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
