/* operand.h: shapes that a command line names: WKT, @FILE, disc:, square: ..., or a data source. */
#ifndef GIS_OPERAND_H
#define GIS_OPERAND_H

#include "options/options.h"
#include "read/source.h"
#include "read/wkt.h"

/* --invalid */
typedef enum gis_invalid { GIS_INVALID_REPAIR, GIS_INVALID_SKIP, GIS_INVALID_FAIL } gis_invalid;
gis_invalid gis_options_invalid(const gis_options *options);

/* The request that the options of "which features" make. */
gis_source_request gis_options_source(const gis_options *options, const char *path, unsigned takes);

/* What the CRS says of lengths; `crs` may be NULL, or one of the names that
 * GeoPackage has for not knowing it. A Mercator projection, whose lengths are not lengths on the ground, and
 * degrees are warned of, with the name of the layer; `box` (xmin ymin xmax ymax, may be NULL) tells where the local
 * scale is measured. */
bool gis_crs_is_known(OGRSpatialReferenceH crs);
gis_ruler gis_ruler_of(OGRSpatialReferenceH crs, const gis_options *options);
void gis_ruler_warn(OGRSpatialReferenceH crs, const char *layer, const double *box);

/* A polygonal set from rings. Invalid rings: repaired (the even-odd set; *invalid is set, and the reason stands in
 * reason), else an error. `who` opens messages. */
bool gis_shape_of_polygons(const gis_polygons *set, gis_invalid policy, const char *who, sunder_shape **out,
                           bool *invalid, gis_error *reason, gis_error *error);

/* Is it anything but a data source? */
bool gis_shape_is_text(const char *text);

/* A SHAPE that gis_shape_is_text(); lengths inside are converted by the ruler. `who` and the text open messages. A
 * repair is warned of. The time from numbers in memory to the shape is added to *building, unless that is NULL. */
bool gis_shape_from_text(const char *text, const char *who, const gis_ruler *rule, gis_invalid policy,
                         sunder_shape **out, double *building, gis_error *error);

/* The parts of that: all of a file, or of standard input with "-", to be freed; a WKT with polygons; and "P (disc:4)",
 * where long texts are cut at the end of a character. */
bool gis_shape_read_file(const char *name, const char *who, char **text, gis_error *error);
bool gis_shape_of_wkt(const char *text, const char *who, gis_invalid policy, sunder_shape **out, double *building,
                      gis_error *error);
void gis_shape_name(const char *who, const char *text, char *name, size_t size);

/* The standard shape ("disc:") that a text with a misspelt one was probably to be; NULL: none. */
const char *gis_shape_prefix_meant(const char *text);

/* All polygons of a layer as one polygonal set; the source stays open for its CRS. What its driver warned of is
 * printed. *building as above; that each feature is judged by itself, to name the one at fault, belongs to the reading. */
bool gis_shape_from_source(const gis_options *options, const char *path, const char *who, gis_source **source,
                           sunder_shape **out, double *building, gis_error *error);

/* The SHAPE of an option, in any form; it must enclose something. A data source is read whole (--where and the like
 * select from the operands), is of the layer's CRS (borrowed; may be NULL) where both are known, and is handed to
 * *source, else untouched. Lengths inside a text are converted by the ruler. */
bool gis_shape_of_option(const gis_options *options, gis_option_id id, const gis_ruler *rule, OGRSpatialReferenceH crs,
                         gis_source **source, sunder_shape **out, gis_error *error);
/* False, with an error, if writing the output would replace this source (NULL: there is none). */
bool gis_source_spare(const gis_source *source, const gis_options *options, const char *output, gis_error *error);

/* P and Q of sum and pair. */
typedef struct gis_operands {
    sunder_shape *p, *q;
    gis_source *p_source, *q_source; /* NULL where the operand is a text */
    gis_ruler rule;                  /* of the CRS of the operands, if any */
    OGRSpatialReferenceH crs;        /* borrowed from a source, or NULL */
    double building;                 /* seconds from doubles in memory to p and q */
} gis_operands;

bool gis_operands_read(const gis_options *options, gis_operands *out, gis_error *error);
/* The source that the output is compared with and takes its CRS from; NULL if both operands are texts. */
const gis_source *gis_operands_source(const gis_operands *operands);
/* False, with an error, if writing the output would replace one of the sources. */
bool gis_operands_spare(const gis_operands *operands, const gis_options *options, const char *output, gis_error *error);
void gis_operands_clear(gis_operands *operands);

#endif
