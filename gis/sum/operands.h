/* operands.h: the operands P and Q of the commands sum and pair. */
#ifndef GIS_OPERANDS_H
#define GIS_OPERANDS_H

#include "read/read_shape.h"

/* The request of the operands. Strings and lists are borrowed during the call. */
typedef struct gis_operands_request {
    const char *text[2];       /* P and Q: each a SHAPE in any form, or a data source */
    gis_source_request source; /* the selection from an operand that is a data source; the member path is set when it is
                                * read */
    gis_invalid_policy invalid;
    double scale; /* N of the scale 1:N; 0: not given */
} gis_operands_request;

typedef struct gis_operands {
    sunder_shape *p, *q;
    gis_source *p_source, *q_source; /* NULL if the operand is a text */
    gis_crs_units units;             /* the units of the operands' CRS, if there is one */
    OGRSpatialReferenceH crs;        /* borrowed from a source, or NULL */
    double building;                 /* seconds for building p and q from coordinates in memory */
} gis_operands;

/* Reads the operands; on failure *out is not changed and nothing must be cleared. */
bool gis_operands_read(const gis_operands_request *request, gis_operands *out, gis_error *error);
/* Returns the source that the output is compared with and whose CRS it gets; NULL if both operands are texts. */
const gis_source *gis_operands_source(const gis_operands *operands);
/* Fails if writing the output would replace one of the sources. */
bool gis_operands_spare(const gis_operands *operands, const char *output, bool update, gis_error *error);
void gis_operands_clear(gis_operands *operands);

#endif
