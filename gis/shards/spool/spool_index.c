/* spool_index.c: see spool_index.h. The file holds a mark, a head, the entries, and a checksum of head and entries. */
#include "shards/spool/spool_index.h"

#include "disk/checksum.h"

#include <stdlib.h>
#include <string.h>

enum { VERSION = 4, ORDER = 0x01020304 };

gis_spool_mark gis_spool_mark_of(const char what[8])
{
    gis_spool_mark mark = {.version = VERSION, .order = ORDER};
    memcpy(mark.what, what, sizeof mark.what);
    return mark;
}

bool gis_spool_mark_check(const gis_spool_mark *mark, const char what[8], const char *path, gis_error *error)
{
    const gis_spool_mark own = gis_spool_mark_of(what);
    if (memcmp(mark->what, what, sizeof mark->what) != 0)
        return gis_fail(error, "%s: it is not a file of a plan", path);
    if (mark->order != own.order)
        return gis_fail(error, "%s: it was written on a machine with another order of bytes", path);
    if (mark->version != own.version)
        return gis_fail(error, "%s: it is of version %u, this program reads %u", path, (unsigned)mark->version,
                        (unsigned)own.version);
    return true;
}

/* Assigns cells to parts: the total of vertices and features is divided into `parts` equal intervals along the curve,
 * and a cell belongs to the interval in which its middle lies. */
void gis_spool_index_deal(gis_spool_index *index, unsigned parts)
{
    double all = 0, before = 0;
    index->parts = parts;
    for (size_t k = 0; k < index->n; k++)
        all += (double)index->entry[k].cell.features + (double)index->entry[k].cell.vertices;
    for (size_t k = 0; k < index->n; k++) {
        gis_spool_cell *cell = &index->entry[k].cell;
        const double own = (double)cell->features + (double)cell->vertices;
        const unsigned part = (unsigned)((before + own / 2) / all * parts);
        cell->part = part < parts ? part : parts - 1;
        before += own;
    }
}

/* ---- The file ---------------------------------------------------------------------------------------------------- */

typedef struct stored_head {
    uint64_t cells, parts;
} stored_head;

typedef struct stored_entry {
    double box[4];
    uint64_t features, vertices, part, from, bytes, checksum;
} stored_entry;

static stored_entry entry_as_stored(const gis_spool_entry *entry)
{
    stored_entry to = {.features = entry->cell.features,
                       .vertices = entry->cell.vertices,
                       .part = entry->cell.part,
                       .from = entry->from,
                       .bytes = entry->bytes,
                       .checksum = entry->checksum};
    memcpy(to.box, entry->cell.box, sizeof to.box);
    return to;
}

static gis_spool_entry entry_as_read(const stored_entry *from)
{
    gis_spool_entry to = {
        .cell = {.features = (size_t)from->features, .vertices = (size_t)from->vertices, .part = (unsigned)from->part},
        .from = from->from,
        .bytes = from->bytes,
        .checksum = from->checksum};
    memcpy(to.cell.box, from->box, sizeof to.cell.box);
    return to;
}

static bool write_content(const gis_spool_index *index, gis_disk_file *file, gis_error *error)
{
    const gis_spool_mark mark = gis_spool_mark_of(GIS_SPOOL_CELLS);
    const stored_head head = {index->n, index->parts};
    uint64_t checksum = gis_checksum_of(0, &head, sizeof head);
    if (!gis_disk_file_write(file, &mark, sizeof mark, error) || !gis_disk_file_write(file, &head, sizeof head, error))
        return false;
    for (size_t k = 0; k < index->n; k++) {
        const stored_entry entry = entry_as_stored(&index->entry[k]);
        checksum = gis_checksum_of(checksum, &entry, sizeof entry);
        if (!gis_disk_file_write(file, &entry, sizeof entry, error)) return false;
    }
    return gis_disk_file_write(file, &checksum, sizeof checksum, error);
}

bool gis_spool_index_write(const gis_spool_index *index, const char *directory, gis_error *error)
{
    gis_disk_file file = {0};
    const bool done = gis_disk_file_create(&file, directory, "cells.part", error) &&
                      write_content(index, &file, error) && gis_disk_file_place(&file, directory, "cells", error);
    gis_disk_file_close(&file);
    return done;
}

static bool read_entries(gis_spool_index *index, gis_disk_file *file, size_t n, uint64_t from, uint64_t *checksum,
                         gis_error *error)
{
    index->entry = malloc((n + 1) * sizeof *index->entry);
    if (!index->entry) return gis_no_memory(error);
    for (; index->n < n; from += sizeof(stored_entry)) {
        stored_entry entry;
        if (!gis_disk_file_read(file, from, &entry, sizeof entry, error)) return false;
        *checksum = gis_checksum_of(*checksum, &entry, sizeof entry);
        index->entry[index->n++] = entry_as_read(&entry);
    }
    return true;
}

static bool read_content(gis_spool_index *index, gis_disk_file *file, gis_error *error)
{
    gis_spool_mark mark;
    stored_head head;
    const uint64_t entries = sizeof mark + sizeof head;
    if (!gis_disk_file_read(file, 0, &mark, sizeof mark, error) ||
        !gis_spool_mark_check(&mark, GIS_SPOOL_CELLS, file->path, error) ||
        !gis_disk_file_read(file, sizeof mark, &head, sizeof head, error))
        return false;
    uint64_t checksum = gis_checksum_of(0, &head, sizeof head);
    if (file->size < entries + sizeof checksum)
        return gis_fail(error, "%s: it ends too early: it was cut off", file->path);
    if (head.cells != (file->size - entries - sizeof checksum) / sizeof(stored_entry))
        return gis_fail(error, "%s: its number of cells is not the stated one: it was cut off, or changed", file->path);
    if (!read_entries(index, file, (size_t)head.cells, entries, &checksum, error) ||
        !gis_disk_file_read(file, entries + head.cells * sizeof(stored_entry), &index->checksum, sizeof checksum,
                            error))
        return false;
    index->parts = (unsigned)head.parts;
    return checksum == index->checksum ||
           gis_fail(error, "%s: checksum mismatch; the file was damaged or changed", file->path);
}

bool gis_spool_index_read(gis_spool_index *index, const char *directory, gis_error *error)
{
    gis_disk_file file = {0};
    *index = (gis_spool_index){0};
    const bool done = gis_disk_file_open(&file, directory, "cells", error) && read_content(index, &file, error);
    gis_disk_file_close(&file);
    return done;
}

void gis_spool_index_clear(gis_spool_index *index)
{
    free(index->entry);
    *index = (gis_spool_index){0};
}
