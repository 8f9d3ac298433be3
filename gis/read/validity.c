/* validity.c: see validity.h. The core reads a set strictly first, so a valid set is taken as it is, and for an invalid
 * one the place of the defect is known; only then is the even-odd set computed. A failed allocation is an error under
 * every policy. */
#include "read/validity.h"

#include "base/message.h"

const char *gis_invalid_string(gis_invalid_policy policy)
{
    static const char *const word[] = {"repair", "skip", "fail"};
    return (unsigned)policy <= GIS_INVALID_FAIL ? word[policy] : "";
}

gis_not_finite gis_invalid_not_finite(gis_invalid_policy policy, gis_not_finite skipped)
{
    return policy == GIS_INVALID_SKIP ? skipped : GIS_NOT_FINITE_REFUSED;
}

static bool shape_failed(const char *who, sunder_status status, const sunder_error *why, gis_error *error)
{
    gis_fail(error, "%s: %s", who, why->message);
    error->no_memory = status == SUNDER_ENOMEM;
    return false;
}

bool gis_shape_of_polygons(const gis_polygons *set, gis_invalid_policy policy, const char *who, sunder_shape **out,
                           bool *invalid, gis_error *reason, gis_error *error)
{
    sunder_error why;
    *invalid = false;
    sunder_status status = gis_polygons_shape(set, SUNDER_VALIDITY_STRICT, out, &why);
    if (status == SUNDER_OK) return true;
    if (status != SUNDER_EINVALID) return shape_failed(who, status, &why, error);
    *invalid = true;
    gis_fail(reason, "%s", why.message);
    if (policy == GIS_INVALID_REPAIR) {
        status = gis_polygons_shape(set, SUNDER_VALIDITY_EVEN_ODD, out, &why);
        if (status == SUNDER_OK) return true;
    }
    return shape_failed(who, status, &why, error);
}

bool gis_shape_of_feature(const gis_polygons *set, gis_invalid_policy policy, const char *who, const char *said,
                          sunder_shape **out, bool *invalid, gis_error *error)
{
    gis_error reason;
    bool ok = gis_shape_of_polygons(set, policy, who, out, invalid, &reason, error);
    if (!ok && !(*invalid && policy == GIS_INVALID_SKIP)) return false;
    if (*invalid)
        gis_say_warning(GIS_MESSAGE_INVALID, "%s: %s%s; %s", who, said, reason.message,
                        !ok ? "skipped"
                        : sunder_shape_is_empty(*out)
                            ? "its rings enclose no area by the even-odd rule: skipped"
                            : "read as the region that its rings enclose by the even-odd rule");
    return true;
}
