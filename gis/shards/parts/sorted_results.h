/* sorted_results.h: things of results in order on disk, one at a time: put in as they come, sorted by two numbers, then
 * read from the first to the last, as often as is wanted. */
#ifndef GIS_SORTED_RESULTS_H
#define GIS_SORTED_RESULTS_H

#include "disk/external_sort.h"
#include "shards/parts/part_result.h"

/* Zeroed: none. */
typedef struct gis_sorted_results {
    const char *directory, *name; /* borrowed */
    gis_sorter *sorter;           /* until it is sorted; and then: */
    gis_disk_file file;           /* all of them in order */
    size_t n;
    unsigned char *record; /* one that is written */
    size_t room;
    unsigned char *buffer; /* bytes of the file that were read and not yet taken */
    size_t used, filled, buffer_room;
    uint64_t from;
    gis_sort_head head;  /* the record just read: its keys, and */
    gis_part_result one; /* the thing */
} gis_sorted_results;

bool gis_sorted_results_begin(gis_sorted_results *sorted, const char *directory, const char *name, gis_error *error);
/* A result with one thing. */
bool gis_sorted_results_add(gis_sorted_results *sorted, uint64_t first, uint64_t second, const gis_part_result *one,
                            gis_error *error);

/* For items in order: is this one kept? */
typedef bool gis_sorted_results_keep(void *user, const gis_sort_head *head, const gis_part_result *one, bool *keep,
                                     gis_error *error);
/* Sorts what was added, as far as it is kept; nothing is added from then on. */
bool gis_sorted_results_sort(gis_sorted_results *sorted, gis_sorted_results_keep *keep, void *user, gis_error *error);

/* Reading begins with the first, again. */
void gis_sorted_results_rewind(gis_sorted_results *sorted);
/* The next into head and one; *any = false: there is none. */
bool gis_sorted_results_next(gis_sorted_results *sorted, bool *any, gis_error *error);
void gis_sorted_results_clear(gis_sorted_results *sorted);

#endif
