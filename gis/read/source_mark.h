/* source_mark.h: what source.c and source_mark.c share for sources that are read in batches. */
#ifndef GIS_SOURCE_MARK_H
#define GIS_SOURCE_MARK_H

#include "read/source.h"

/* The FIDs of all features that satisfy a condition. */
typedef struct gis_marked {
    char *where;
    GIntBig (*range)[2]; /* [n] first and last FID of each range of consecutive FIDs; ascending */
    size_t n, capacity;
} gis_marked;

/* The conditions that were queried. A zeroed struct is empty. */
typedef struct gis_source_marks {
    gis_marked *marked;
    size_t n, capacity;
} gis_source_marks;

/* The marks of a source; NULL if it is not read in batches. */
gis_source_marks *gis_source_marks_of(gis_source *source);
/* Do FIDs identify features, as far as is known? */
bool gis_source_goes_by_fids(const gis_source *source);
/* Continues reading behind the current batch, after the layer was read for another purpose. */
bool gis_source_resume(gis_source *source, gis_error *error);

#endif
