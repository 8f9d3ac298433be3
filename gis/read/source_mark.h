/* source_mark.h: what source.c and source_mark.c share of sources that are read by batches. */
#ifndef GIS_SOURCE_MARK_H
#define GIS_SOURCE_MARK_H

#include "read/source.h"

/* The FIDs of all features that satisfy a condition. */
typedef struct gis_marked {
    char *where;
    GIntBig (*range)[2]; /* [n] first and last of FIDs without a gap; ascending */
    size_t n, capacity;
} gis_marked;

/* One for each condition that was queried. Zeroed: none. */
typedef struct gis_source_marks {
    gis_marked *marked;
    size_t n, capacity;
} gis_source_marks;

/* NULL: the source is not read by batches. */
gis_source_marks *gis_source_marks_of(gis_source *source);
/* Do FIDs tell features apart, as far as is known? */
bool gis_source_goes_by_fids(const gis_source *source);
/* Goes on behind the batch, after the layer was read for something else. */
bool gis_source_resume(gis_source *source, gis_error *error);

#endif
