/* round.c: rounds an exact sum to valid polygons in doubles.
 *
 * Every vertex is rounded to its nearest double, so the boundary moves by less than an ulp. Rings that lose their area
 * are dropped (round_polygons.c), polygons that become invalid are mended (mend_polygon.c), and polygons that now
 * overlap are united (mend_multipolygon.c). The core's exact validation decides what is valid. */
#include "geometry/round/steps.h"

bool gis_round_sum(const sunder_sum *sum, gis_rounded *out, gis_error *error)
{
    gis_rounded rounded = {0};
    gis_suspects suspects = {0};
    bool ok = gis_round_polygons(sum, &rounded, &suspects, error) && gis_mend_multipolygon(&rounded, &suspects, error);
    gis_suspects_clear(&suspects);
    if (ok)
        *out = rounded;
    else
        gis_rounded_clear(&rounded);
    return ok;
}
