/* crs_units.c: see crs_units.h. Only the CRS itself matters; coordinates are used in one place, to compute the local
 * scale of a Mercator map for a warning. */
#include "read/crs_units.h"

#include "base/message.h"

#include <math.h>
#include <string.h>

/* A GeoPackage layer without a CRS is stored with one called "undefined" (srs_id 0 or -1); GDAL calls the first of
 * these geographic, but that says nothing about the coordinates. */
bool gis_crs_is_known(OGRSpatialReferenceH crs)
{
    const char *name = crs ? OSRGetName(crs) : NULL;
    return crs && !(name && EQUALN(name, "undefined", 9));
}

bool gis_crs_may_be_same(OGRSpatialReferenceH p, OGRSpatialReferenceH q)
{
    return !gis_crs_is_known(p) || !gis_crs_is_known(q) || OSRIsSame(p, q);
}

gis_crs_units gis_crs_units_of(OGRSpatialReferenceH crs, double scale)
{
    if (!gis_crs_is_known(crs)) crs = NULL;
    gis_crs_units units = {.has_crs = crs != NULL, .unit_metres = 1, .scale = scale};
    if (crs) {
        units.geographic = OSRIsGeographic(crs) != 0;
        if (!units.geographic) units.unit_metres = OSRGetLinearUnits(crs, NULL);
    }
    return units;
}

/* The latitude, in degrees, of the middle of the box; NaN if PROJ cannot compute it. */
static double middle_latitude(OGRSpatialReferenceH crs, const double *box)
{
    double x = (box[0] + box[2]) / 2, y = (box[1] + box[3]) / 2, latitude = NAN;
    OGRSpatialReferenceH geographic = OSRCloneGeogCS(crs);
    OGRSpatialReferenceH projected = OSRClone(crs);
    if (geographic && projected) {
        OSRSetAxisMappingStrategy(geographic, OAMS_TRADITIONAL_GIS_ORDER);
        OSRSetAxisMappingStrategy(projected, OAMS_TRADITIONAL_GIS_ORDER);
        OGRCoordinateTransformationH inverse = OCTNewCoordinateTransformation(projected, geographic);
        if (inverse && OCTTransform(inverse, 1, &x, &y, NULL)) latitude = y;
        OCTDestroyCoordinateTransformation(inverse);
    }
    OSRRelease(geographic);
    OSRRelease(projected);
    return latitude;
}

/* Warns of a Mercator projection. A length on the map is that on the ground times cos(standard parallel) /
 * cos(latitude); the ellipsoid changes this factor by less than a hundredth, which does not matter for a warning. */
static void warn_mercator(OGRSpatialReferenceH crs, const char *layer, const double *box)
{
    const char *projection = OSRGetAttrValue(crs, "PROJECTION", 0);
    if (!projection || strncmp(projection, "Mercator", 8) != 0) return;
    double degree = acos(-1.0) / 180;
    double parallel = OSRGetProjParm(crs, "standard_parallel_1", 0, NULL);
    double latitude = box ? middle_latitude(crs, box) : NAN;
    double factor = cos(parallel * degree) / cos(latitude * degree);
    if (isfinite(factor) && factor > 0)
        gis_say_warning(GIS_MESSAGE_CRS,
                        "%s: on this Mercator projection lengths are about %.4g times those on the ground (at latitude "
                        "%.2f); reproject for lengths in true units",
                        layer, factor, latitude);
    else
        gis_say_warning(GIS_MESSAGE_CRS,
                        "%s: on a Mercator projection lengths are not those on the ground; reproject for true units",
                        layer);
}

void gis_crs_units_warn(OGRSpatialReferenceH crs, const char *layer, const double *box)
{
    if (!gis_crs_is_known(crs)) return;
    if (OSRIsGeographic(crs))
        gis_say_warning(GIS_MESSAGE_CRS,
                        "%s: the coordinates are degrees; distances and moves are measured in degrees, not in lengths "
                        "on the ground",
                        layer);
    else
        warn_mercator(crs, layer, box);
}
