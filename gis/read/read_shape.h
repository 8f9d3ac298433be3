/* read_shape.h: reads shapes from data sources, and from options whose value is a data source or a text. */
#ifndef GIS_READ_SHAPE_H
#define GIS_READ_SHAPE_H

#include "read/shape_text.h"
#include "read/source.h"

/* Joins all polygons of a layer to one shape; the source stays open for its CRS. Warnings of its driver are printed;
 * `who` begins messages. Adds the time for making the shape from coordinates in memory to *building, unless that is
 * NULL; validating single features counts as reading. */
bool gis_shape_from_source(const gis_source_request *request, gis_invalid_policy policy, const char *who,
                           gis_source **source, sunder_shape **out, double *building, gis_error *error);

/* The SHAPE given by an option. Strings are borrowed. */
typedef struct gis_shape_request {
    const char *option; /* name of the option, for messages */
    const char *text;   /* NULL: not given */
    gis_invalid_policy invalid;
} gis_shape_request;

/* Reads a shape in any form; an empty one is an error. A data source is read whole (--where and similar options select
 * from the operands only), and handed over in *source (otherwise unchanged); if its CRS and `crs` (borrowed; may be
 * NULL) are both known they must be the same. Lengths within a text are converted by `units`. */
bool gis_shape_read(const gis_shape_request *request, const gis_crs_units *units, OGRSpatialReferenceH crs,
                    gis_source **source, sunder_shape **out, gis_error *error);

#endif
