/* read_shape.h: shapes of data sources, and of options, which may be either: a source or a text. */
#ifndef GIS_READ_SHAPE_H
#define GIS_READ_SHAPE_H

#include "read/shape_text.h"
#include "read/source.h"

/* All polygons of a layer as one polygonal set; the source stays open for its CRS. Warnings of its driver are printed;
 * `who` opens messages. Adds the time from coordinates in memory to the shape to *building, unless that is NULL; the
 * validation of single features, which names the one at fault, counts as reading. */
bool gis_shape_from_source(const gis_source_request *request, gis_invalid_policy policy, const char *who,
                           gis_source **source, sunder_shape **out, double *building, gis_error *error);

/* The SHAPE of an option. Strings are borrowed. */
typedef struct gis_shape_request {
    const char *option; /* as messages call it */
    const char *text;   /* NULL: not given */
    gis_invalid_policy invalid;
} gis_shape_request;

/* In any form; it must enclose something. A data source is read whole (--where and the like select from the operands),
 * is of the layer's CRS (borrowed; may be NULL) where both are known, and is handed to *source, else untouched. Lengths
 * inside a text are converted by `units`. */
bool gis_shape_read(const gis_shape_request *request, const gis_crs_units *units, OGRSpatialReferenceH crs,
                    gis_source **source, sunder_shape **out, gis_error *error);

#endif
