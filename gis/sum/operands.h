/* operands.h: P and Q of sum and pair. */
#ifndef GIS_OPERANDS_H
#define GIS_OPERANDS_H

#include "read/read_shape.h"

/* Strings and lists are borrowed for the call. */
typedef struct gis_operands_request {
    const char *text[2];       /* P and Q, each a SHAPE in any form */
    gis_source_request source; /* what is selected from an operand that is a data source; path is filled in */
    gis_invalid_policy invalid;
    double scale; /* N of 1:N; 0: not given */
} gis_operands_request;

typedef struct gis_operands {
    sunder_shape *p, *q;
    gis_source *p_source, *q_source; /* NULL where the operand is a text */
    gis_crs_units units;             /* of the CRS of the operands, if any */
    OGRSpatialReferenceH crs;        /* borrowed from a source, or NULL */
    double building;                 /* seconds from doubles in memory to p and q */
} gis_operands;

/* On failure there is nothing to be released. */
bool gis_operands_read(const gis_operands_request *request, gis_operands *out, gis_error *error);
/* The source that the output is compared with and takes its CRS from; NULL if both operands are texts. */
const gis_source *gis_operands_source(const gis_operands *operands);
/* False, with an error, if writing the output would replace one of the sources. */
bool gis_operands_spare(const gis_operands *operands, const char *output, bool update, gis_error *error);
void gis_operands_clear(gis_operands *operands);

#endif
