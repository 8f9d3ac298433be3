/* crs_units.h: is a CRS known, and what does it say about lengths? `crs` may be NULL in all functions. */
#ifndef GIS_CRS_UNITS_H
#define GIS_CRS_UNITS_H

#include <ogr_srs_api.h>

#include "base/length.h"

/* False for NULL, and for the CRS called "undefined" that a GeoPackage gives to layers without one. */
bool gis_crs_is_known(OGRSpatialReferenceH crs);
/* Are the two the same, or is one of them unknown? */
bool gis_crs_may_be_same(OGRSpatialReferenceH p, OGRSpatialReferenceH q);
/* The units of lengths in this CRS, on a map of the scale 1:`scale` (0: not given). */
gis_crs_units gis_crs_units_of(OGRSpatialReferenceH crs, double scale);
/* Warns of degrees, and of a Mercator projection, whose lengths are not lengths on the ground; `layer` names the layer.
 * box: xmin ymin xmax ymax, where the local scale is computed; may be NULL. */
void gis_crs_units_warn(OGRSpatialReferenceH crs, const char *layer, const double *box);

#endif
