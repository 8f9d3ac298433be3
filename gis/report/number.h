/* number.h: numbers for people: few digits, thousands set apart, a point, whatever the locale; with units. */
#ifndef GIS_REPORT_NUMBER_H
#define GIS_REPORT_NUMBER_H

#include "base/text.h"

#include <stddef.h>

/* The unit of a layer's coordinates, as it is written behind numbers; "" where it is unknown. */
typedef struct gis_report_unit {
    const char *length, *area;
} gis_report_unit;

/* From its name in the CRS ("metre"). */
gis_report_unit gis_report_unit_of(const char *name);

void gis_report_count(gis_text *to, size_t n);
/* At most `digits` digits, but all before the point; for values that are not finite: infinity's sign, or a dash for
 * unknown (NAN). */
void gis_report_number(gis_text *to, double value, int digits);
/* Three digits, and the unit. */
void gis_report_length(gis_text *to, double value, const gis_report_unit *unit);
/* As many digits as it takes to tell it from another length, three at least. */
void gis_report_length_beside(gis_text *to, double value, double other, const gis_report_unit *unit);
/* For a bound: the text is not less, or not more, than the value. */
void gis_report_length_or_more(gis_text *to, double value, const gis_report_unit *unit);
void gis_report_length_or_less(gis_text *to, double value, const gis_report_unit *unit);
/* Four digits, and the unit squared; of a lower bound no more than the value. */
void gis_report_area(gis_text *to, double value, const gis_report_unit *unit);
void gis_report_area_or_less(gis_text *to, double value, const gis_report_unit *unit);
/* A part of a whole as a percentage that is no less than it. */
void gis_report_share_or_more(gis_text *to, double part);

#endif
