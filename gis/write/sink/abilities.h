/* abilities.h: what each of GDAL's drivers can hold, in one table. It is consulted before the work, so that an output
 * that the driver would reject is refused at once, or written in another way, with a message. Tests/cli/test_drivers.sh
 * compares the table with the drivers that GDAL has. */
#ifndef GIS_ABILITIES_H
#define GIS_ABILITIES_H

#include <stdbool.h>

/* A driver that is not listed has none of these. */
enum {
    /* What it keeps. */
    GIS_KEEPS_FIDS = 1 << 0,    /* any 64-bit FID comes back as it was */
    GIS_KEEPS_DOUBLES = 1 << 1, /* coordinates are stored in binary as they are, and so are rings and members */
    GIS_KEEPS_VALUES = 1 << 2,  /* so are integers, reals and texts */
    GIS_KEEPS_ORDER = 1 << 3,   /* features come back in the order written */
    GIS_KEEPS_CASE = 1 << 4,    /* two fields may have names that differ in case only */
    /* What it lacks. */
    GIS_REPROJECTS = 1 << 5,           /* turns coordinates to WGS 84 */
    GIS_NEEDS_WGS84 = 1 << 6,          /* refuses any other CRS */
    GIS_ONE_LAYER = 1 << 7,            /* one layer a file: further layers become files of their own */
    GIS_TAKES_DIRECTORY = 1 << 8,      /* ... or a directory that holds a file for each */
    GIS_HAS_NO_NULL = 1 << 9,          /* a null comes back as 0, or as an empty text */
    GIS_NEEDS_TYPE = 1 << 10,          /* a layer has one kind of geometry, and is not of type Unknown */
    GIS_NEEDS_GEOMETRY = 1 << 11,      /* drops features whose geometry is null or empty */
    GIS_DROPS_EMPTY = 1 << 12,         /* a layer without features is not there when it is read */
    GIS_HAS_NO_POLYGONS = 1 << 13,     /* points or lines alone */
    GIS_IS_NOT_READ = 1 << 14,         /* what GDAL writes it does not read, or not from that path */
    GIS_NEEDS_POSITIVE_FIDS = 1 << 15, /* a negative FID is read as another one */
};

typedef struct gis_abilities {
    const char *driver;
    unsigned has;
    const char *refused;   /* why nothing is written with it; NULL: something is */
    const char *own_field; /* the name of a column of the format itself, which no field may have; NULL: none */
    const char *endings;   /* the file's name has to end in one of these; NULL: in anything */
} gis_abilities;

/* Of the driver with GDAL's short name; of one that is not listed all members are 0. */
gis_abilities gis_abilities_of(const char *driver);

#endif
