/* core_error.c: see core_error.h. The library is cancelled only when the program asks for it, so the message is the
 * program's own, without a prefix. */
#include "base/core_error.h"

bool gis_core_failed(gis_error *error, const char *who, const sunder_error *why)
{
    if (why->status == SUNDER_ECANCEL) return gis_fail(error, GIS_INTERRUPTED);
    return gis_fail(error, "%s%s%s", who ? who : "", who ? ": " : "", why->message);
}
