/* names.c: targets that a field of the layer names: by their FIDs, or by the values of a field of theirs. */
#include "follow/follow_inner.h"

#include "base/array.h"
#include "read/fields.h"

#include <cpl_conv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *fid_key(GIntBig fid)
{
    char text[32];
    snprintf(text, sizeof text, CPL_FRMT_GIB, fid);
    char *copy = malloc(strlen(text) + 1);
    return copy ? strcpy(copy, text) : NULL;
}

bool gis_follow_add_key(gis_follow *follow, OGRFeatureH feature, int field, GIntBig fid, gis_error *error)
{
    if (follow->request->by != GIS_FOLLOW_FIELD) return true;
    if (!gis_array_reserve(&follow->key, &follow->key_capacity, follow->keys + 1, sizeof *follow->key))
        return gis_no_memory(error);
    char **key = &follow->key[follow->keys++];
    *key = NULL;
    if (field >= 0 && gis_field_is_blank(feature, field)) return true;
    *key = field >= 0 ? gis_field_key(feature, field) : fid_key(fid);
    return *key || gis_no_memory(error);
}

static int by_key(const void *a, const void *b)
{
    return strcmp(((const gis_named *)a)->key, ((const gis_named *)b)->key);
}

static bool two_have(const gis_follow *f, const char *key, gis_error *error)
{
    if (f->moved)
        return gis_fail(error, "MOVED: two features have the key %s; give an --id-field with unique values", key);
    return gis_fail(error,
                    "--spec: layer %s: two features that move have the key %s; give an id_field with unique values",
                    gis_follow_name(f), key);
}

bool gis_follow_find_names(const gis_follow *follow, gis_names *out, gis_error *error)
{
    *out = (gis_names){.field = -1};
    if (follow->request->by != GIS_FOLLOW_FIELD) return true;
    if (!gis_field_find(follow->input, "--by field", follow->request->field, &out->field, error)) return false;
    out->list = calloc(follow->keys + 1, sizeof *out->list);
    if (!out->list) return gis_no_memory(error);
    for (size_t i = 0; i < follow->keys; i++)
        if (follow->key[i] && gis_follow_takes(follow, i)) out->list[out->n++] = (gis_named){follow->key[i], i};
    qsort(out->list, out->n, sizeof *out->list, by_key);
    for (size_t k = 1; k < out->n; k++)
        if (by_key(&out->list[k - 1], &out->list[k]) == 0) return two_have(follow, out->list[k].key, error);
    return true;
}

bool gis_follow_attach_named(const gis_follow *follow, const gis_names *names, size_t i, gis_follow_place *out,
                             gis_error *error)
{
    OGRFeatureH feature = gis_source_feature(follow->input, i);
    if (gis_field_is_blank(feature, names->field)) return true;
    char *key = gis_field_key(feature, names->field);
    if (!key) return gis_no_memory(error);
    const gis_named wanted = {key, 0}, *found = NULL;
    if (names->n) found = bsearch(&wanted, names->list, names->n, sizeof *names->list, by_key);
    if (found) *out = (gis_follow_place){GIS_FOLLOW_MOVED, found->target};
    free(key);
    return true;
}
