/* digest_list.c: see digest_list.h. */
#include "write/sink/digest_list.h"

#include "base/array.h"

#include <stdlib.h>

bool gis_digest_list_add(gis_digest_list *list, gis_digest one, gis_error *error)
{
    if (list->scratch) {
        if (!(list->file.stream || gis_disk_file_create(&list->file, list->scratch, "digests.XXXXXX", error)) ||
            !gis_disk_file_write(&list->file, &one, sizeof one, error))
            return false;
        list->n++;
        return true;
    }
    if (!gis_array_reserve(&list->at, &list->capacity, list->n + 1, sizeof *list->at)) return gis_no_memory(error);
    list->at[list->n++] = one;
    list->held = list->n;
    return true;
}

/* Loads the hashes with numbers from ... from + n - 1 into memory, in place of those loaded before. */
static bool load_digests(gis_digest_list *list, size_t from, size_t n, gis_error *error)
{
    if (!gis_array_reserve(&list->at, &list->capacity, n, sizeof *list->at)) return gis_no_memory(error);
    list->from = from;
    list->held = from + n;
    return gis_disk_file_flush(&list->file, error) &&
           gis_disk_file_read(&list->file, from * sizeof *list->at, list->at, n * sizeof *list->at, error);
}

bool gis_digest_list_get(gis_digest_list *list, size_t k, gis_digest *out, gis_error *error)
{
    enum { STRETCH = 4096 };
    if ((k < list->from || k >= list->held) &&
        !load_digests(list, k, list->n - k < STRETCH ? list->n - k : STRETCH, error))
        return false;
    *out = list->at[k - list->from];
    return true;
}

bool gis_digest_list_hold(gis_digest_list *list, size_t n, gis_error *error)
{
    return n == 0 || (list->from == 0 && list->held >= n) || load_digests(list, 0, n, error);
}

void gis_digest_list_clear(gis_digest_list *list)
{
    free(list->at);
    gis_disk_file_close(&list->file);
    *list = (gis_digest_list){.scratch = list->scratch};
}
