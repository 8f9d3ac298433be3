/* number.h: formats numbers for readers: few digits, groups of three, a decimal point in every locale, and units. */
#ifndef GIS_PAGE_NUMBER_H
#define GIS_PAGE_NUMBER_H

#include "base/text.h"

#include <stddef.h>

/* The unit of a layer's coordinates as it is written after numbers; "" if it is unknown. */
typedef struct gis_page_unit {
    const char *length, *area;
} gis_page_unit;

/* Returns the unit with the given name in the CRS ("metre"). */
gis_page_unit gis_page_unit_of(const char *name);

void gis_print_count(gis_text *to, size_t n);
/* Writes a number with at most `digits` significant digits, but with all digits before the decimal point; the sign of
 * infinity for an infinite value, and a dash for NaN (unknown). */
void gis_print_number(gis_text *to, double value, int digits);
/* Writes three digits and the unit. */
void gis_print_length(gis_text *to, double value, const gis_page_unit *unit);
/* Writes the length with as many digits as distinguish it from the length `other`, at least three, and the unit. */
void gis_print_length_beside(gis_text *to, double value, double other, const gis_page_unit *unit);
/* Write a bound: the written number is not less, or not greater, than the value. */
void gis_print_length_or_more(gis_text *to, double value, const gis_page_unit *unit);
void gis_print_length_or_less(gis_text *to, double value, const gis_page_unit *unit);
/* Write four digits and the square of the unit; the second function writes a number that is not greater than the
 * value. */
void gis_print_area(gis_text *to, double value, const gis_page_unit *unit);
void gis_print_area_or_less(gis_text *to, double value, const gis_page_unit *unit);
/* Writes a fraction as a percentage that is not less than the value. */
void gis_print_share_or_more(gis_text *to, double part);

#endif
