/* round.c: a sum in doubles that is valid.
 *
 * Every vertex goes to its nearest double, so the boundary moves by less than an ulp. Rings that fall together so are
 * left out (round_polygons.c), polygons that rounding has broken are mended (mend_polygon.c), and those that it has
 * brought into each other are united (mend_multipolygon.c). The core's exact validation says what is well, before and
 * after. */
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
