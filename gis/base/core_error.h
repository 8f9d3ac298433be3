/* core_error.h: turns an error of the library into an error of the program. */
#ifndef GIS_CORE_ERROR_H
#define GIS_CORE_ERROR_H

#include "base/gis_error.h"
#include "sunder.h"

/* Sets *error to the library's message, preceded by "WHO: " unless who is NULL, and returns false. If the work was
 * cancelled the message is GIS_INTERRUPTED alone. */
bool gis_core_failed(gis_error *error, const char *who, const sunder_error *why);

#endif
