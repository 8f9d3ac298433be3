/* abilities.h: what each GDAL driver can hold, in one table. It is consulted before the work, so that an output that
 * the driver would reject is refused at once, or written in another way, with a message. tests/cli/test_drivers.sh
 * compares the table with the installed drivers. */
#ifndef GIS_ABILITIES_H
#define GIS_ABILITIES_H

#include <stdbool.h>

/* Abilities and limits of a driver; a driver that is not in the table has none of these bits. */
enum {
    /* What the driver keeps. */
    GIS_KEEPS_FIDS = 1 << 0,    /* any 64-bit FID reads back unchanged */
    GIS_KEEPS_DOUBLES = 1 << 1, /* coordinates are stored as binary doubles; rings and members stay as they are */
    GIS_KEEPS_VALUES = 1 << 2,  /* integers, reals and texts read back unchanged */
    GIS_KEEPS_ORDER = 1 << 3,   /* features read back in the order in which they were written */
    GIS_KEEPS_CASE = 1 << 4,    /* two field names may differ only in case */
    /* Limits of the driver. */
    GIS_REPROJECTS = 1 << 5,           /* reprojects coordinates to WGS 84 */
    GIS_NEEDS_WGS84 = 1 << 6,          /* refuses any CRS but WGS 84 */
    GIS_ONE_LAYER = 1 << 7,            /* a file holds one layer; further layers go to files of their own */
    GIS_TAKES_DIRECTORY = 1 << 8,      /* OUTPUT may be a directory with a file for each layer */
    GIS_HAS_NO_NULL = 1 << 9,          /* null reads back as 0 or as an empty text */
    GIS_NEEDS_TYPE = 1 << 10,          /* a layer has one geometry type, and wkbUnknown is refused */
    GIS_NEEDS_GEOMETRY = 1 << 11,      /* drops features whose geometry is null or empty */
    GIS_DROPS_EMPTY = 1 << 12,         /* a layer without features is missing when the file is read */
    GIS_HAS_NO_POLYGONS = 1 << 13,     /* holds only points or lines */
    GIS_IS_NOT_READ = 1 << 14,         /* GDAL cannot read what it writes, or not under the same path */
    GIS_NEEDS_POSITIVE_FIDS = 1 << 15, /* a negative FID reads back as another number */
};

typedef struct gis_abilities {
    const char *driver;
    unsigned has;
    const char *refused;   /* why the program does not write this format; NULL: it does */
    const char *own_field; /* a column name that the format uses itself, so that no field may have it; NULL: none */
    const char *endings;   /* the endings that a file name may have, separated by blanks; NULL: any */
} gis_abilities;

/* The table's entry for the driver with this short name of GDAL's; all members but `driver` are 0 if it is not
 * listed. */
gis_abilities gis_abilities_of(const char *driver);

#endif
