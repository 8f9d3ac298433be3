/* message.h: what the program says on stderr: warnings, and the one error that a run ends with. One line each. */
#ifndef GIS_MESSAGE_H
#define GIS_MESSAGE_H

#include "base/error.h"

/* "sunder: warning: ...", exactly one line: line breaks and other control characters inside become spaces. */
void gis_say_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* "sunder: error: ...", likewise; returns the exit status of the error, which is the run's. */
int gis_say_failure(const gis_error *error);

/* Each sentence of the list as a warning; none once a signal has come. */
void gis_say_warnings(const gis_sentences *list);

#endif
