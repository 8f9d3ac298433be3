/* follow_inner.h: what the files of this folder share. */
#ifndef GIS_FOLLOW_INNER_H
#define GIS_FOLLOW_INNER_H

#include "follow/follow.h"

/* May features go along with this target? Not if it is of another layer than the one that the request names. */
bool gis_follow_takes(const gis_follow *follow, size_t target);

/* A target, by what a field calls it. */
typedef struct gis_named {
    const char *key;
    size_t target;
} gis_named;

typedef struct gis_names {
    int field;       /* of the layer */
    gis_named *list; /* [n] owned, sorted by key */
    size_t n;
} gis_names;

/* names.c: finds what a field may call each target, if that is how targets are found. The caller frees out->list, on
 * failure, too. */
bool gis_follow_find_names(const gis_follow *follow, gis_names *out, gis_error *error);
/* Sets the place of feature i to the target that its field names; leaves it if the field names none. */
bool gis_follow_attach_named(const gis_follow *follow, const gis_names *names, size_t i, gis_follow_place *out,
                             gis_error *error);

#endif
