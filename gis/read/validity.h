/* validity.h: what becomes of polygons that break the rules of validity. */
#ifndef GIS_VALIDITY_H
#define GIS_VALIDITY_H

#include "geometry/polygons.h"
#include "read/source.h"

/* --invalid: taken as what the rings enclose by the even-odd rule; left out; an error. */
typedef enum gis_invalid_policy { GIS_INVALID_REPAIR, GIS_INVALID_SKIP, GIS_INVALID_FAIL } gis_invalid_policy;
/* "repair", "skip", "fail"; "" for any other value. */
const char *gis_invalid_string(gis_invalid_policy policy);

/* No rule makes a set of coordinates that are no finite numbers: such a feature is an error unless invalid ones are
 * skipped, and then it is `skipped`. */
gis_not_finite gis_invalid_not_finite(gis_invalid_policy policy, gis_not_finite skipped);

/* A polygonal set from rings. Invalid rings are repaired if that is the policy (*invalid is set, *reason tells why),
 * else they are an error. `who` opens messages. */
bool gis_shape_of_polygons(const gis_polygons *set, gis_invalid_policy policy, const char *who, sunder_shape **out,
                           bool *invalid, gis_error *reason, gis_error *error);

/* The same for one feature: an invalid one gives a warning ("WHO: " and the addition `said`); if the policy is to skip
 * it, *out stays NULL without an error. */
bool gis_shape_of_feature(const gis_polygons *set, gis_invalid_policy policy, const char *who, const char *said,
                          sunder_shape **out, bool *invalid, gis_error *error);

#endif
