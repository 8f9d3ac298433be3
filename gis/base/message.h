/* message.h: what the program says on stderr, one line each, and the exit statuses. */
#ifndef GIS_MESSAGE_H
#define GIS_MESSAGE_H

#include "base/error.h"

/* Exit statuses; scripts rely on them. Failures carry GIS_FAILED or GIS_USAGE in their gis_error. */
enum {
    GIS_DONE = 0,
    GIS_CONFLICTS = 3 /* done, but conflicts remain or were found */
};

/* "sunder: warning: ...", exactly one line: line breaks inside become spaces. */
void gis_say_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* "sunder: error: ..." in one line; returns the exit status. */
int gis_say_failure(const gis_error *error);

/* Each sentence of the list as a warning. */
void gis_say_warnings(const gis_list *list);

#endif
