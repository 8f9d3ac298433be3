/* sets.c: groups features into sets: each feature by itself, all features, or those with equal values of a field. Sets
 * are sorted by their first features, and the features of a set by their numbers. */
#include "buffer/buffer.h"

#include "read/fields.h"

#include <stdlib.h>
#include <string.h>

typedef struct dissolve_key {
    char *key; /* the value of the field as text; NULL for a null value */
    size_t feature, set;
} dissolve_key;

/* Sorts by value and then by feature. Null values come first; no two of them are in one set. */
static int by_key(const void *a, const void *b)
{
    const dissolve_key *ka = a, *kb = b;
    int order = !ka->key || !kb->key ? (ka->key != NULL) - (kb->key != NULL) : strcmp(ka->key, kb->key);
    return order ? order : (ka->feature > kb->feature) - (ka->feature < kb->feature);
}

static int by_first(const void *a, const void *b)
{
    const dissolve_key *ka = a, *kb = b;
    int order = (ka->set > kb->set) - (ka->set < kb->set);
    return order ? order : (ka->feature > kb->feature) - (ka->feature < kb->feature);
}

static bool same_set(const dissolve_key *a, const dissolve_key *b)
{
    return a->key && b->key && strcmp(a->key, b->key) == 0;
}

static bool read_keys(const gis_buffer *buffer, dissolve_key *keys, gis_error *error)
{
    for (size_t i = 0; i < buffer->input.n; i++) {
        OGRFeatureH feature = gis_source_feature(buffer->input.source, i);
        keys[i].feature = i;
        if (!OGR_F_IsFieldSetAndNotNull(feature, buffer->field)) continue;
        keys[i].key = gis_field_key(feature, buffer->field);
        if (!keys[i].key) return gis_no_memory(error);
    }
    return true;
}

/* Sets the number of each set to its first feature, then sorts the features by set. */
static void sort_keys(dissolve_key *keys, size_t n)
{
    qsort(keys, n, sizeof *keys, by_key);
    for (size_t i = 0; i < n; i++)
        keys[i].set = i > 0 && same_set(&keys[i], &keys[i - 1]) ? keys[i - 1].set : keys[i].feature;
    qsort(keys, n, sizeof *keys, by_first);
}

/* Fails if the field is a list or binary: such values have no text by which they could be compared. */
static bool has_single_values(const gis_buffer *buffer, gis_error *error)
{
    OGRFeatureDefnH layer = OGR_L_GetLayerDefn(gis_source_layer(buffer->input.source));
    OGRFieldDefnH field = OGR_FD_GetFieldDefn(layer, buffer->field);
    switch (OGR_Fld_GetType(field)) {
    case OFTInteger:
    case OFTInteger64:
    case OFTReal:
    case OFTString:
    case OFTDate:
    case OFTTime:
    case OFTDateTime: return true;
    default:
        return gis_fail(error,
                        "--dissolve-field: field %s is of type %s; use a field of numbers, texts, dates or times",
                        OGR_Fld_GetNameRef(field), OGR_GetFieldTypeName(OGR_Fld_GetType(field)));
    }
}

static bool gather_by_field(gis_buffer *buffer, gis_error *error)
{
    if (!has_single_values(buffer, error)) return false;
    size_t n = buffer->input.n;
    dissolve_key *keys = calloc(n + 1, sizeof *keys);
    if (!keys) return gis_no_memory(error);
    bool ok = read_keys(buffer, keys, error);
    if (ok) sort_keys(keys, n);
    for (size_t i = 0; ok && i < n; i++) {
        if (i == 0 || keys[i].set != keys[i - 1].set) buffer->set[buffer->sets++].member = buffer->member + i;
        buffer->set[buffer->sets - 1].members++;
        buffer->member[i] = keys[i].feature;
    }
    for (size_t i = 0; i < n; i++) free(keys[i].key);
    free(keys);
    return ok;
}

bool gis_buffer_gather(gis_buffer *buffer, gis_error *error)
{
    size_t n = buffer->input.n;
    buffer->set = calloc(n + 1, sizeof *buffer->set);
    buffer->member = calloc(n + 1, sizeof *buffer->member);
    if (!buffer->set || !buffer->member) return gis_no_memory(error);
    if (buffer->field >= 0) return gather_by_field(buffer, error);
    buffer->sets = buffer->request->dissolve ? 1 : n;
    for (size_t i = 0; i < n; i++) buffer->member[i] = i;
    for (size_t k = 0; k < buffer->sets; k++) {
        buffer->set[k].member = buffer->member + k;
        buffer->set[k].members = buffer->request->dissolve ? n : 1;
    }
    return true;
}
