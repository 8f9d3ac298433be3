/* validity.h: how invalid polygons are treated. */
#ifndef GIS_VALIDITY_H
#define GIS_VALIDITY_H

#include "geometry/polygons.h"
#include "read/source.h"

/* --invalid: read by the even-odd rule, skip, or fail. */
typedef enum gis_invalid_policy { GIS_INVALID_REPAIR, GIS_INVALID_SKIP, GIS_INVALID_FAIL } gis_invalid_policy;
/* "repair", "skip", "fail"; "" for any other value. */
const char *gis_invalid_string(gis_invalid_policy policy);

/* How features with coordinates that are not finite are treated: they cannot be repaired, so they are an error, unless
 * invalid features are skipped; then `skipped` is returned. */
gis_not_finite gis_invalid_not_finite(gis_invalid_policy policy, gis_not_finite skipped);

/* Makes a shape of rings. Invalid rings are repaired if the policy says so (*invalid is set, *reason says why);
 * otherwise they are an error. `who` begins messages. */
bool gis_shape_of_polygons(const gis_polygons *set, gis_invalid_policy policy, const char *who, sunder_shape **out,
                           bool *invalid, gis_error *reason, gis_error *error);

/* The same for a feature: if it is invalid, a warning is printed ("WHO: ", followed by `said` and the reason); if the
 * policy is to skip it, *out stays NULL without an error. */
bool gis_shape_of_feature(const gis_polygons *set, gis_invalid_policy policy, const char *who, const char *said,
                          sunder_shape **out, bool *invalid, gis_error *error);

#endif
