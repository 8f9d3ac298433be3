/* fields.h: attributes of features, as the program reads them. */
#ifndef GIS_FIELDS_H
#define GIS_FIELDS_H

#include "base/json.h"
#include "read/source.h"

/* The field of a name that an option gives; *field is -1 where the name is NULL. A field that is not there is an error
 * that knows which one was probably meant, and which there are. */
bool gis_field_find(const gis_source *source, const char *option, const char *name, int *field, gis_error *error);

/* The same of a field that numbers can be read from. */
bool gis_field_find_numbers(const gis_source *source, const char *option, const char *name, int *field,
                            gis_error *error);

/* Null, or a text that says nothing: formats without nulls have empty texts in their place. */
bool gis_field_is_blank(OGRFeatureH feature, int field);

/* Returns a copy of a field's value as text, which the caller frees, or NULL if memory is out. Equal values give
 * equal texts, different values different ones. It is not for lists, since their texts are cut. */
char *gis_field_key(OGRFeatureH feature, int field);

/* Is it a list? And the list of a field that is not null as a JSON array. */
bool gis_field_type_is_list(OGRFieldType type);
void gis_field_list(OGRFeatureH feature, int field, gis_json *out);

/* A number, also one that a text holds; NAN for anything else. */
double gis_field_number(OGRFeatureH feature, int field);

/* What a field holds, for messages; long texts are cut. */
enum { GIS_FIELD_TEXT_SIZE = 64 };
void gis_field_text(OGRFeatureH feature, int field, char text[GIS_FIELD_TEXT_SIZE]);

#endif
