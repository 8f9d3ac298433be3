/* core_error.c: see core_error.h. The library stops only because the program asked it to, so the message is the
 * program's own and has no prefix. */
#include "base/core_error.h"

bool gis_core_failed(gis_error *error, const char *who, const sunder_error *why)
{
    if (why->status == SUNDER_ECANCEL) return gis_fail(error, GIS_INTERRUPTED);
    return gis_fail(error, "%s%s%s", who ? who : "", who ? ": " : "", why->message);
}
