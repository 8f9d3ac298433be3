/* value.h: the value of an attribute field. */
#ifndef GIS_VALUE_H
#define GIS_VALUE_H

#include <cpl_port.h>

/* The value of a field that the program adds, or of a plain field of the source. */
typedef struct gis_value {
    enum { GIS_NULL, GIS_INTEGER, GIS_REAL, GIS_TEXT } kind;
    union {
        GIntBig integer;
        double real;
        const char *text; /* UTF-8, borrowed */
    } as;
} gis_value;

#endif
