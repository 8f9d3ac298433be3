/* spool_reader.c: reads a spool, cell by cell. */
#include "base/array.h"
#include "base/core_error.h"
#include "disk/checksum.h"
#include "shards/spool/spool_index.h"
#include "shards/spool/spool_record.h"

#include <stdlib.h>
#include <string.h>

struct gis_spool {
    gis_spool_index index;
    gis_disk_file file;
    size_t features, vertices;
    gis_spool_room records;
    gis_polygons rings, given;
    size_t *line_end, line_room;
};

/* Is the entry possible: does the cell begin at `from`, behind the one before it, and can its bytes hold its number of
 * features and vertices? */
static bool is_possible(const gis_spool *spool, const gis_spool_entry *entry, uint64_t from)
{
    const uint64_t size = spool->file.size;
    return entry->from == from && from <= size && entry->bytes <= size - from &&
           entry->cell.features <= entry->bytes / sizeof(gis_spool_head) &&
           entry->cell.vertices <= entry->bytes / (2 * sizeof(double)) && entry->cell.part < spool->index.parts;
}

static bool open_features(gis_spool *spool, const char *directory, gis_error *error)
{
    gis_disk_file *file = &spool->file;
    gis_spool_mark mark;
    uint64_t end = sizeof mark;
    if (!gis_disk_file_open(file, directory, "features", error) ||
        !gis_disk_file_read(file, 0, &mark, sizeof mark, error) ||
        !gis_spool_mark_check(&mark, GIS_SPOOL_FEATURES, file->path, error))
        return false;
    for (size_t k = 0; k < spool->index.n; k++) {
        const gis_spool_entry *entry = &spool->index.entry[k];
        if (!is_possible(spool, entry, end))
            return gis_fail(error, "%s: cell %zu was damaged or changed", file->path, k);
        spool->features += entry->cell.features;
        spool->vertices += entry->cell.vertices;
        end += entry->bytes;
    }
    if (file->size == end) return true;
    return gis_fail(error, "%s: it has %llu bytes, and should have %llu: it was cut off, or belongs to another plan",
                    file->path, (unsigned long long)file->size, (unsigned long long)end);
}

bool gis_spool_open(const char *directory, gis_spool **out, gis_error *error)
{
    gis_spool *spool = calloc(1, sizeof *spool);
    if (!spool) return gis_no_memory(error);
    if (!gis_spool_index_read(&spool->index, directory, error) || !open_features(spool, directory, error)) {
        gis_spool_close(spool);
        return false;
    }
    *out = spool;
    return true;
}

void gis_spool_close(gis_spool *spool)
{
    if (!spool) return;
    gis_spool_index_clear(&spool->index);
    gis_disk_file_close(&spool->file);
    gis_polygons_clear(&spool->rings);
    gis_polygons_clear(&spool->given);
    free(spool->line_end);
    free(spool->records.at);
    free(spool);
}

size_t gis_spool_features(const gis_spool *spool) { return spool->features; }
size_t gis_spool_vertices(const gis_spool *spool) { return spool->vertices; }
unsigned gis_spool_parts(const gis_spool *spool) { return spool->index.parts; }
uint64_t gis_spool_checksum(const gis_spool *spool) { return spool->index.checksum; }
size_t gis_spool_cells(const gis_spool *spool) { return spool->index.n; }
const gis_spool_cell *gis_spool_cell_at(const gis_spool *spool, size_t cell) { return &spool->index.entry[cell].cell; }

static bool load_cell(gis_spool *spool, size_t cell, gis_error *error)
{
    const gis_spool_entry *entry = &spool->index.entry[cell];
    gis_spool_room *records = &spool->records;
    if (!gis_array_reserve(&records->at, &records->capacity, entry->bytes, 1)) return gis_no_memory(error);
    if (!gis_disk_file_read(&spool->file, entry->from, records->at, entry->bytes, error)) return false;
    records->used = entry->bytes;
    return gis_checksum_of(0, records->at, records->used) == entry->checksum ||
           gis_fail(error, "%s: checksum mismatch in cell %zu; the file was damaged or changed", spool->file.path,
                    cell);
}

/* Visits the record at offset `at` of the loaded bytes, which begin at `from` in the file. */
static bool visit_record(gis_spool *spool, uint64_t from, size_t at, gis_spool_visit *visit, void *user,
                         gis_error *error)
{
    unsigned char *record = spool->records.at + at;
    gis_spool_feature feature;
    sunder_shape *shape;
    sunder_error why;
    if (!gis_go_on(error)) return false;
    if (!gis_spool_record_feature(record, spool->records.used - at, &feature))
        return gis_fail(error, "%s: damaged or changed at byte %llu", spool->file.path,
                        (unsigned long long)(from + at));
    if (!gis_spool_record_shape(record, &spool->rings, &shape, &why))
        return gis_core_failed(error, spool->file.path, &why);
    feature.demands.shape = shape;
    feature.place = from + at;
    if (!gis_spool_record_lines(record, &spool->line_end, &spool->line_room, &feature.lines, error) ||
        !gis_spool_record_given(record, &spool->given, &feature.given, error)) {
        sunder_shape_free(shape);
        return false;
    }
    return visit(user, &feature, error);
}

bool gis_spool_read(gis_spool *spool, size_t cell, gis_spool_visit *visit, void *user, gis_error *error)
{
    if (!load_cell(spool, cell, error)) return false;
    for (size_t at = 0; at < spool->records.used; at += gis_spool_record_head(spool->records.at + at)->bytes)
        if (!visit_record(spool, spool->index.entry[cell].from, at, visit, user, error)) return false;
    return true;
}

bool gis_spool_read_one(gis_spool *spool, uint64_t place, gis_spool_visit *visit, void *user, gis_error *error)
{
    gis_spool_room *records = &spool->records;
    gis_spool_head head;
    if (!gis_disk_file_read(&spool->file, place, &head, sizeof head, error)) return false;
    if (head.bytes > spool->file.size - place)
        return gis_fail(error, "%s: damaged or changed at byte %llu", spool->file.path, (unsigned long long)place);
    if (!gis_array_reserve(&records->at, &records->capacity, (size_t)head.bytes, 1)) return gis_no_memory(error);
    records->used = (size_t)head.bytes;
    return gis_disk_file_read(&spool->file, place, records->at, records->used, error) &&
           visit_record(spool, place, 0, visit, user, error);
}

bool gis_spool_skim(gis_spool *spool, size_t cell, gis_spool_glance *glance, void *user, gis_error *error)
{
    const uint64_t from = spool->index.entry[cell].from;
    if (!gis_go_on(error) || !load_cell(spool, cell, error)) return false;
    for (size_t at = 0; at < spool->records.used;) {
        unsigned char *record = spool->records.at + at;
        gis_spool_feature feature;
        double box[4];
        if (!gis_spool_record_feature(record, spool->records.used - at, &feature))
            return gis_fail(error, "%s: cell %zu was damaged or changed", spool->file.path, cell);
        feature.place = from + at;
        gis_spool_record_box(record, box);
        const gis_spool_head *head = gis_spool_record_head(record);
        if (!glance(user, &feature, box, head->vertices, error)) return false;
        at += head->bytes;
    }
    return true;
}

typedef struct listing {
    double (*box)[4];
    size_t n;
} listing;

static bool list_box(void *user, const gis_spool_feature *feature, const double box[4], size_t vertices,
                     gis_error *error)
{
    listing *to = user;
    (void)feature;
    (void)vertices;
    (void)error;
    if (box[0] <= box[2]) memcpy(to->box[to->n++], box, 4 * sizeof *box);
    return true;
}

bool gis_spool_boxes(gis_spool *spool, size_t cell, double (*box)[4], size_t *n, gis_error *error)
{
    listing to = {box, 0};
    const bool done = gis_spool_skim(spool, cell, list_box, &to, error);
    *n = to.n;
    return done;
}
