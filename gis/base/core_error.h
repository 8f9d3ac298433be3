/* core_error.h: what the library says when it fails, as an error of the program. */
#ifndef GIS_CORE_ERROR_H
#define GIS_CORE_ERROR_H

#include "base/gis_error.h"
#include "sunder.h"

/* Sets the error to the library's sentence, after "WHO: " unless who is NULL, and returns false. For work that was
 * stopped the error is GIS_INTERRUPTED alone. */
bool gis_core_failed(gis_error *error, const char *who, const sunder_error *why);

#endif
