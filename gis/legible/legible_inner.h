/* legible_inner.h: what the files of this folder share. */
#ifndef GIS_LEGIBLE_INNER_H
#define GIS_LEGIBLE_INNER_H

#include "legible/legible.h"

/* The limits in units of a layer; 0 for what is not asked. */
bool gis_legible_limits(const gis_legible_rules *rules, const gis_crs_units *units, sunder_legible_limits *out,
                        gis_error *error);

#endif
