/* crs_units.h: whether a CRS is known, and what it says about lengths. `crs` may be NULL everywhere. */
#ifndef GIS_CRS_UNITS_H
#define GIS_CRS_UNITS_H

#include <ogr_srs_api.h>

#include "base/length.h"

/* False also of the CRS called undefined that a GeoPackage gives to layers without one. */
bool gis_crs_is_known(OGRSpatialReferenceH crs);
/* Are they the same, as far as both are known? */
bool gis_crs_may_be_same(OGRSpatialReferenceH p, OGRSpatialReferenceH q);
/* The units of lengths in this CRS, on a map of scale 1:`scale`; 0: it was not given. */
gis_crs_units gis_crs_units_of(OGRSpatialReferenceH crs, double scale);
/* Warns of a Mercator projection, whose lengths are not lengths on the ground, and of degrees, with the name of the
 * layer; `box` (xmin ymin xmax ymax, may be NULL) tells where the local scale is measured. */
void gis_crs_units_warn(OGRSpatialReferenceH crs, const char *layer, const double *box);

#endif
