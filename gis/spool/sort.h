/* sort.h: records put in order along a curve, in bounded memory. */
#ifndef GIS_SPOOL_SORT_H
#define GIS_SPOOL_SORT_H

#include "spool/file.h"
#include "spool/record.h"

/* So many bytes of records are sorted at a time, and no more are held while parts are merged, but for one that is
 * larger. */
#define GIS_SPOOL_RUN ((size_t)64 << 20)

/* Takes each record in order; false ends it all. */
typedef bool gis_spool_take(void *user, const unsigned char *record, gis_error *error);

typedef struct gis_spool_sorting {
    gis_spool_file *from; /* records in the order in which they came */
    size_t features;
    double box[4];            /* of all of them: what the curve runs through */
    const char *directory;    /* for a file of parts */
    size_t run;               /* bytes; GIS_SPOOL_RUN, but in tests */
    gis_spool_settle *settle; /* NULL, or asked of each first */
    gis_spool_take *take;
    void *settle_user, *take_user;
} gis_spool_sorting;

bool gis_spool_sort(const gis_spool_sorting *sorting, gis_error *error);

#endif
