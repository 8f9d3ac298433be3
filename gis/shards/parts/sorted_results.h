/* sorted_results.h: items of results in sorted order on disk. They are added in any order, sorted by two numbers, and
 * then read from first to last, as often as needed, one at a time. */
#ifndef GIS_SORTED_RESULTS_H
#define GIS_SORTED_RESULTS_H

#include "disk/external_sort.h"
#include "shards/parts/part_result.h"

/* A sorted list. A zeroed struct is empty. */
typedef struct gis_sorted_results {
    const char *directory, *name; /* borrowed */
    gis_sorter *sorter;           /* until the items are sorted; then NULL */
    gis_disk_file file;           /* all items in order, once they are sorted */
    size_t n;
    unsigned char *record; /* buffer for a record being written */
    size_t room;
    unsigned char *buffer; /* bytes of the file that were read but not yet used */
    size_t used, filled, buffer_room;
    uint64_t from;
    gis_sort_head head;  /* keys of the item that was read last */
    gis_part_result one; /* the item itself */
} gis_sorted_results;

bool gis_sorted_results_begin(gis_sorted_results *sorted, const char *directory, const char *name, gis_error *error);
/* Adds a result that holds a single item, with its two keys. */
bool gis_sorted_results_add(gis_sorted_results *sorted, uint64_t first, uint64_t second, const gis_part_result *one,
                            gis_error *error);

/* Called for each item in sorted order; sets *keep to whether the item is kept. */
typedef bool gis_sorted_results_keep(void *user, const gis_sort_head *head, const gis_part_result *one, bool *keep,
                                     gis_error *error);
/* Sorts the items that were added, and drops those that `keep` rejects; nothing may be added afterwards. */
bool gis_sorted_results_sort(gis_sorted_results *sorted, gis_sorted_results_keep *keep, void *user, gis_error *error);

/* Makes the next read return the first item. */
void gis_sorted_results_rewind(gis_sorted_results *sorted);
/* Reads the next item into head and one; *any is set to false if there is none. */
bool gis_sorted_results_next(gis_sorted_results *sorted, bool *any, gis_error *error);
/* The place of the item that was read last by gis_sorted_results_next(); and reads the item at a place into head and
 * one, without a change to what comes next. */
uint64_t gis_sorted_results_place(const gis_sorted_results *sorted);
bool gis_sorted_results_read_at(gis_sorted_results *sorted, uint64_t place, gis_error *error);
void gis_sorted_results_clear(gis_sorted_results *sorted);

#endif
