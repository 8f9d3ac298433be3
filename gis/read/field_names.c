/* field_names.c: see field_names.h. */
#include "read/field_names.h"

#include <stdio.h>
#include <string.h>

void gis_field_names(OGRLayerH layer, char *text, size_t size)
{
    static const char more[] = ", ...";
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer);
    int n = OGR_FD_GetFieldCount(definition);
    size_t length = (size_t)snprintf(text, size, n ? "its fields are " : "it has no fields");
    for (int i = 0; i < n; i++) {
        const char *name = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i));
        if (length + strlen(name) + 2 + sizeof more > size) {
            snprintf(text + length, size - length, "%s", i ? more : more + 2);
            return;
        }
        length += (size_t)snprintf(text + length, size - length, "%s%s", i ? ", " : "", name);
    }
}
