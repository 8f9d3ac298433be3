/* feature_keys.h: the keys by which features of two layers are matched. */
#ifndef GIS_FEATURE_KEYS_H
#define GIS_FEATURE_KEYS_H

#include "layer/layer_input.h"

/* A feature and the key by which it is matched. */
typedef struct gis_feature_key {
    char *key; /* owned */
    size_t feature;
} gis_feature_key;

/* The key of feature i: the value of --id-field or of fid_field (sunder_fid, if the format keeps no FIDs); else its
 * FID. Freed with free(). NULL: memory is out. */
char *gis_feature_key_of(const gis_layer_input *input, size_t i, int fid_field);
/* The index of the field sunder_fid, if it counts: there is no --id-field; -1 otherwise. */
int gis_feature_key_field(const gis_layer_input *input);
/* Lists all features sorted by key, freed with gis_feature_keys_free(); fails if two have the same key. option: the
 * option that asks for it, for the message. */
bool gis_feature_keys_list(const gis_layer_input *input, int fid_field, const char *option, gis_feature_key **out,
                           gis_error *error);
/* The entry of a key in a list of n; NULL if there is none. */
const gis_feature_key *gis_feature_keys_find(const gis_feature_key *list, size_t n, const char *key);
void gis_feature_keys_free(gis_feature_key *list, size_t n);

#endif
