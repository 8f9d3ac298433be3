/* fields.h: attribute values as the program reads them. */
#ifndef GIS_FIELDS_H
#define GIS_FIELDS_H

#include "base/json.h"
#include "read/source.h"

/* Finds the field that an option names; *field = -1 if `name` is NULL. If there is no such field, the error suggests
 * the field that was probably meant, and lists all fields. */
bool gis_field_find(const gis_source *source, const char *option, const char *name, int *field, gis_error *error);

/* The same, but the field must be of a type that can hold numbers. */
bool gis_field_find_numbers(const gis_source *source, const char *option, const char *name, int *field,
                            gis_error *error);

/* Returns true if the value is null, or a text of blanks only. Formats without null have empty texts instead. */
bool gis_field_is_blank(OGRFeatureH feature, int field);

/* Returns a copy of a field's value as text, which the caller frees; NULL if out of memory. Equal values give equal
 * texts, and different values different texts. Not for lists, whose texts GDAL truncates. */
char *gis_field_key(OGRFeatureH feature, int field);

/* Returns true for the types of lists. gis_field_list() writes a list that is not null as a JSON array. */
bool gis_field_type_is_list(OGRFieldType type);
void gis_field_list(OGRFeatureH feature, int field, gis_json *out);

/* Returns the value as a number, also if it is in a text; NAN if it is not a number. */
double gis_field_number(OGRFeatureH feature, int field);

/* The size of a buffer for a value in messages; longer texts are truncated. */
enum { GIS_FIELD_TEXT_SIZE = 64 };
void gis_field_text(OGRFeatureH feature, int field, char text[GIS_FIELD_TEXT_SIZE]);

#endif
