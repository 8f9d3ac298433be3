/* feature_keys.c: see feature_keys.h. */
#include "layer/feature_keys.h"

#include "read/fields.h"

#include <cpl_conv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int by_key(const void *a, const void *b)
{
    const gis_feature_key *p = a, *q = b;
    return strcmp(p->key, q->key);
}

void gis_feature_keys_free(gis_feature_key *list, size_t n)
{
    for (size_t i = 0; list && i < n; i++) free(list[i].key);
    free(list);
}

int gis_feature_key_field(const gis_layer_input *input)
{
    return input->id_field >= 0 ? -1 : gis_source_field(input->source, "sunder_fid");
}

char *gis_feature_key_of(const gis_layer_input *input, size_t i, int fid_field)
{
    const int field = input->id_field >= 0 ? input->id_field : fid_field;
    if (field >= 0) return gis_field_key(gis_source_attributes(input->source, i), field);
    char text[32];
    snprintf(text, sizeof text, CPL_FRMT_GIB, gis_source_fid(input->source, i));
    char *copy = malloc(strlen(text) + 1);
    return copy ? strcpy(copy, text) : NULL;
}

bool gis_feature_keys_list(const gis_layer_input *input, int fid_field, const char *option, gis_feature_key **out,
                           gis_error *error)
{
    const size_t n = gis_source_count(input->source);
    gis_feature_key *list = calloc(n + 1, sizeof *list);
    bool ok = list != NULL || gis_no_memory(error);
    for (size_t i = 0; ok && i < n; i++) {
        list[i] = (gis_feature_key){gis_feature_key_of(input, i, fid_field), i};
        ok = list[i].key || gis_no_memory(error);
    }
    if (ok) qsort(list, n, sizeof *list, by_key);
    for (size_t i = 1; ok && i < n; i++)
        if (strcmp(list[i - 1].key, list[i].key) == 0) {
            char who[GIS_WHO_SIZE];
            gis_feature_name(input, list[i].feature, who, sizeof who);
            ok = gis_fail(error,
                          "%s: %s: another feature of %s has the key %s too; give an --id-field with unique values",
                          option, who, gis_source_path(input->source), list[i].key);
        }
    if (ok)
        *out = list;
    else
        gis_feature_keys_free(list, n);
    return ok;
}

const gis_feature_key *gis_feature_keys_find(const gis_feature_key *list, size_t n, const char *key)
{
    const gis_feature_key wanted = {(char *)key, 0};
    return n ? bsearch(&wanted, list, n, sizeof *list, by_key) : NULL;
}
