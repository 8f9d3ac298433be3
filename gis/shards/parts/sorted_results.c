/* sorted_results.c: see sorted_results.h. */
#include "shards/parts/sorted_results.h"

#include "base/array.h"

#include <stdlib.h>
#include <string.h>

/* Size of the read buffer. */
enum { BUFFER = 1 << 18 };

/* Memory of a sorter; several are open at once. */
static const size_t RUN = GIS_SORT_BYTES / 4;

enum { NAME = 64 };

static void name_of(const gis_sorted_results *s, const char *suffix, char name[NAME])
{
    snprintf(name, NAME, "%s.%s", s->name, suffix);
}

bool gis_sorted_results_begin(gis_sorted_results *sorted, const char *directory, const char *name, gis_error *error)
{
    char parts[NAME];
    *sorted = (gis_sorted_results){.directory = directory, .name = name};
    name_of(sorted, "runs", parts);
    return gis_sorter_new(directory, parts, RUN, &sorted->sorter, error);
}

bool gis_sorted_results_add(gis_sorted_results *sorted, uint64_t first, uint64_t second, const gis_part_result *one,
                            gis_error *error)
{
    const gis_sort_head head = {sizeof head + gis_part_result_size(one), first, second};
    if (!gis_array_reserve(&sorted->record, &sorted->room, head.bytes, 1)) return gis_no_memory(error);
    memcpy(sorted->record, &head, sizeof head);
    gis_part_result_store(one, sorted->record + sizeof head);
    return gis_sorter_add(sorted->sorter, sorted->record, error);
}

/* ---- Sorting ----------------------------------------------------------------------------------------------------- */

typedef struct sorting {
    gis_sorted_results *sorted;
    gis_disk_file out;
    gis_sorted_results_keep *keep;
    void *user;
} sorting;

static bool load_record(gis_sorted_results *s, const unsigned char *record, gis_error *error)
{
    bool sound;
    memcpy(&s->head, record, sizeof s->head);
    return gis_part_result_load(&s->one, record + sizeof s->head, (size_t)s->head.bytes - sizeof s->head, &sound,
                                error) &&
           (sound || gis_fail(error, "%s/%s: the file was damaged or changed", s->directory, s->name));
}

static bool take_record(void *user, const unsigned char *record, gis_error *error)
{
    sorting *own = user;
    gis_sorted_results *s = own->sorted;
    bool keep = false;
    if (!load_record(s, record, error) || !own->keep(own->user, &s->head, &s->one, &keep, error)) return false;
    s->n += keep;
    return !keep || gis_disk_file_write(&own->out, record, (size_t)s->head.bytes, error);
}

bool gis_sorted_results_sort(gis_sorted_results *sorted, gis_sorted_results_keep *keep, void *user, gis_error *error)
{
    char name[NAME];
    sorting own = {.sorted = sorted, .keep = keep, .user = user};
    name_of(sorted, "sorted", name);
    const bool done = gis_disk_file_create(&own.out, sorted->directory, name, error) &&
                      gis_sorter_take(sorted->sorter, take_record, &own, error) && gis_disk_file_flush(&own.out, error);
    gis_sorter_free(sorted->sorter);
    sorted->sorter = NULL;
    sorted->file = own.out;
    gis_sorted_results_rewind(sorted);
    return done;
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

void gis_sorted_results_rewind(gis_sorted_results *sorted)
{
    sorted->used = sorted->filled = 0;
    sorted->from = 0;
}

/* Makes sure that at least `needed` bytes are in the buffer. */
static bool fill_buffer(gis_sorted_results *s, size_t needed, gis_error *error)
{
    const size_t have = s->filled - s->used;
    if (have >= needed) return true;
    const size_t wanted = needed < BUFFER ? BUFFER : needed;
    if (!gis_array_reserve(&s->buffer, &s->buffer_room, wanted, 1)) return gis_no_memory(error);
    memmove(s->buffer, s->buffer + s->used, have);
    const uint64_t left = s->file.size - s->from;
    const size_t more = left < wanted - have ? (size_t)left : wanted - have;
    if (have + more < needed) return gis_fail(error, "%s: the file was damaged or changed", s->file.path);
    if (!gis_disk_file_read(&s->file, s->from, s->buffer + have, more, error)) return false;
    s->from += more;
    s->used = 0;
    s->filled = have + more;
    return true;
}

bool gis_sorted_results_next(gis_sorted_results *sorted, bool *any, gis_error *error)
{
    gis_sort_head head;
    *any = sorted->used < sorted->filled || sorted->from < sorted->file.size;
    if (!*any) return true;
    if (!fill_buffer(sorted, sizeof head, error)) return false;
    memcpy(&head, sorted->buffer + sorted->used, sizeof head);
    if (!fill_buffer(sorted, (size_t)head.bytes, error) || !load_record(sorted, sorted->buffer + sorted->used, error))
        return false;
    sorted->used += (size_t)head.bytes;
    return true;
}

uint64_t gis_sorted_results_place(const gis_sorted_results *sorted)
{
    return sorted->from - (sorted->filled - sorted->used) - sorted->head.bytes;
}

bool gis_sorted_results_read_at(gis_sorted_results *sorted, uint64_t place, gis_error *error)
{
    gis_sort_head head;
    return gis_disk_file_read(&sorted->file, place, &head, sizeof head, error) &&
           (gis_array_reserve(&sorted->record, &sorted->room, head.bytes, 1) || gis_no_memory(error)) &&
           gis_disk_file_read(&sorted->file, place, sorted->record, head.bytes, error) &&
           load_record(sorted, sorted->record, error);
}

void gis_sorted_results_clear(gis_sorted_results *sorted)
{
    gis_sorter_free(sorted->sorter);
    gis_disk_file_close(&sorted->file);
    gis_part_result_clear(&sorted->one);
    free(sorted->record);
    free(sorted->buffer);
    *sorted = (gis_sorted_results){0};
}
