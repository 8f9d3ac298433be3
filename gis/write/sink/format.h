/* format.h: properties of an output format. */
#ifndef GIS_FORMAT_H
#define GIS_FORMAT_H

#include <gdal.h>

#include "base/gis_error.h"

typedef struct gis_format {
    GDALDriverH driver;
    const char *name;      /* GDAL's short name */
    bool database;         /* the path is a connection to a database, not a file */
    bool one_layer;        /* a file holds one layer; further layers go to files of their own */
    bool keeps_fids;       /* any 64-bit FID reads back unchanged */
    bool keeps_doubles;    /* coordinates are stored as binary doubles; rings and members stay as they are */
    bool keeps_values;     /* integers, reals and texts read back unchanged */
    bool keeps_vertices;   /* a vertex that reads back at another place is damaged, not rounded */
    bool only_written;     /* GDAL cannot read what it writes */
    bool keeps_order;      /* features read back in the order in which they were written */
    bool reprojects;       /* reprojects coordinates to WGS 84 */
    bool lines;            /* a text format whose last line must end with a line break */
    const char *own_field; /* a column name that the driver uses itself, or NULL */
    unsigned abilities;    /* all bits of abilities.h for the driver; the booleans above repeat some of them */
    bool shapefile, geopackage;
    bool sqlite; /* the file is a SQLite database, as a GeoPackage is */
} gis_format;

/* Sets *out to the format called `name` or, if name is NULL, to the format that the extension or prefix of `path`
 * determines. */
bool gis_format_find(const char *path, const char *name, const char *const *layer_options, gis_format *out,
                     gis_error *error);

/* Does the driver know the layer creation option `option`? */
bool gis_format_has_option(const gis_format *format, const char *option);

/* Adds a sentence to *out for each of the `options`, K=V, that the driver does not have. `kind` is the key of the
 * driver's list: GDAL_DMD_CREATIONOPTIONLIST or GDAL_DS_LAYER_CREATIONOPTIONLIST. Drivers without a list tell nothing.
 */
void gis_format_tell_unknown(const gis_format *format, const char *kind, const char *const *options,
                             gis_sentences *out);

#endif
