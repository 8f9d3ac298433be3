/* fields.c: see fields.h. Formats store values in different ways (a text for a number, an empty text for a null); these
 * functions return the same for all. */
#include "read/fields.h"

#include "base/length.h"
#include "base/spelling.h"
#include "read/field_names.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool gis_field_find(const gis_source *source, const char *option, const char *name, int *field, gis_error *error)
{
    *field = name ? gis_source_field(source, name) : -1;
    if (!name || *field >= 0) return true;
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(gis_source_layer(source));
    gis_spelling search = gis_spelling_of(name, strlen(name));
    for (int i = 0; i < OGR_FD_GetFieldCount(definition); i++) {
        const char *other = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i));
        gis_spelling_offer(&search, other, strlen(other));
    }
    char fields[GIS_FIELD_NAMES_SIZE];
    gis_field_names(gis_source_layer(source), fields, sizeof fields);
    return gis_fail(error, "%s: layer %s has no field %s%s%s%s %s", option, gis_source_name(source), name,
                    search.best ? "; did you mean " : ";", search.best ? search.best : "", search.best ? "?" : "",
                    fields);
}

bool gis_field_find_numbers(const gis_source *source, const char *option, const char *name, int *field,
                            gis_error *error)
{
    if (!gis_field_find(source, option, name, field, error)) return false;
    if (*field < 0) return true;
    OGRFieldDefnH definition = OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(gis_source_layer(source)), *field);
    OGRFieldType type = OGR_Fld_GetType(definition);
    if (type == OFTInteger || type == OFTInteger64 || type == OFTReal || type == OFTString) return true;
    return gis_fail(error, "%s: field %s of layer %s is of type %s; numbers are needed", option,
                    OGR_Fld_GetNameRef(definition), gis_source_name(source), OGR_GetFieldTypeName(type));
}

bool gis_field_is_blank(OGRFeatureH feature, int field)
{
    if (!OGR_F_IsFieldSetAndNotNull(feature, field)) return true;
    if (OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field)) != OFTString) return false;
    const char *text = OGR_F_GetFieldAsString(feature, field);
    return text[strspn(text, " ")] == '\0';
}

/* Doubles are written with 17 digits, so that different ones stay different; 0 and -0 give the same text. */
char *gis_field_key(OGRFeatureH feature, int field)
{
    OGRFieldType type = OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field));
    char number[64];
    const char *text = number;
    if (type == OFTReal)
        snprintf(number, sizeof number, "%.17g", OGR_F_GetFieldAsDouble(feature, field) + 0.0);
    else
        text = OGR_F_GetFieldAsString(feature, field);
    char *copy = malloc(strlen(text) + 1);
    return copy ? strcpy(copy, text) : NULL;
}

bool gis_field_type_is_list(OGRFieldType type)
{
    return type == OFTIntegerList || type == OFTInteger64List || type == OFTRealList || type == OFTStringList;
}

void gis_field_list(OGRFeatureH feature, int field, gis_json *out)
{
    int n = 0;
    gis_json_open(out, '[');
    switch (OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field))) {
    case OFTIntegerList: {
        const int *each = OGR_F_GetFieldAsIntegerList(feature, field, &n);
        for (int i = 0; i < n; i++) gis_json_signed(out, each[i]);
        break;
    }
    case OFTInteger64List: {
        const GIntBig *each = OGR_F_GetFieldAsInteger64List(feature, field, &n);
        for (int i = 0; i < n; i++) gis_json_signed(out, each[i]);
        break;
    }
    case OFTRealList: {
        const double *each = OGR_F_GetFieldAsDoubleList(feature, field, &n);
        for (int i = 0; i < n; i++) gis_json_double(out, each[i]);
        break;
    }
    default:
        for (char **each = OGR_F_GetFieldAsStringList(feature, field); each && *each; each++)
            gis_json_string(out, *each);
    }
    gis_json_close(out, ']');
}

double gis_field_number(OGRFeatureH feature, int field)
{
    double value;
    if (OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field)) != OFTString)
        return OGR_F_GetFieldAsDouble(feature, field);
    const char *text = OGR_F_GetFieldAsString(feature, field);
    text += strspn(text, " ");
    size_t n = strlen(text);
    while (n && text[n - 1] == ' ') n--;
    return gis_length_parse_number(text, n, &value) ? value : NAN;
}

void gis_field_text(OGRFeatureH feature, int field, char text[GIS_FIELD_TEXT_SIZE])
{
    if (OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field)) == OFTReal)
        snprintf(text, GIS_FIELD_TEXT_SIZE, "%g", OGR_F_GetFieldAsDouble(feature, field));
    else
        snprintf(text, GIS_FIELD_TEXT_SIZE, "%s", OGR_F_GetFieldAsString(feature, field));
}
