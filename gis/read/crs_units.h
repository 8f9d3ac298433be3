/* crs_units.h: what a CRS says about lengths on its map. `crs` may be NULL everywhere. */
#ifndef GIS_CRS_UNITS_H
#define GIS_CRS_UNITS_H

#include <ogr_srs_api.h>

#include "base/length.h"

/* False also of the names that GeoPackage has for not knowing it. */
bool gis_crs_is_known(OGRSpatialReferenceH crs);
/* Are they the same, as far as both are known? */
bool gis_crs_may_be_same(OGRSpatialReferenceH p, OGRSpatialReferenceH q);
/* `scale` is N of 1:N, 0 if it was not given. */
gis_crs_units gis_crs_units_of(OGRSpatialReferenceH crs, double scale);
/* Warns of a Mercator projection, whose lengths are not lengths on the ground, and of degrees, with the name of the
 * layer; `box` (xmin ymin xmax ymax, may be NULL) tells where the local scale is measured. */
void gis_crs_units_warn(OGRSpatialReferenceH crs, const char *layer, const double *box);

#endif
