/* format.h: facts about the formats that can be written. */
#ifndef GIS_FORMAT_H
#define GIS_FORMAT_H

#include <gdal.h>

#include "base/gis_error.h"

typedef struct gis_format {
    GDALDriverH driver;
    const char *name;      /* GDAL's short name */
    bool database;         /* the path is a connection, not a file */
    bool one_layer;        /* one layer a file: further layers become files of their own */
    bool keeps_fids;       /* any 64-bit FID comes back as it was */
    bool keeps_doubles;    /* coordinates are stored in binary as they are, and so are rings and members */
    bool keeps_values;     /* so are integers, reals and texts */
    bool keeps_vertices;   /* a vertex that reads back elsewhere is damage, not rounding */
    bool only_written;     /* GDAL cannot read it */
    bool keeps_order;      /* features come back in the order written */
    bool reprojects;       /* turns coordinates to WGS 84 */
    bool lines;            /* a text, and its last line is ended, too */
    const char *own_field; /* a name that the driver takes for a column of its own, or NULL */
    unsigned abilities;    /* all that is known of the driver (abilities.h); the above are some of it by another name */
    bool shapefile, geopackage;
    bool sqlite; /* a file that is a SQLite database, GeoPackages among them */
} gis_format;

/* Sets *out to the format called `name` or, if name is NULL, to the one that the extension or prefix of `path`
 * tells. */
bool gis_format_find(const char *path, const char *name, const char *const *layer_options, gis_format *out,
                     gis_error *error);

/* Does the driver know this layer creation option? */
bool gis_format_has_option(const gis_format *format, const char *option);

#endif
