/* spool_writer.c: writes a spool: sorts the features along the curve, and divides them into cells. */
#include "base/array.h"
#include "disk/checksum.h"
#include "disk/external_sort.h"
#include "geometry/gis_box.h"
#include "geometry/hilbert.h"
#include "shards/spool/spool_index.h"
#include "shards/spool/spool_record.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* A cell is read as a whole: it has at most this number of features, and of vertices unless a single feature has
 * more. */
enum { CELL_FEATURES = 1000, CELL_VERTICES = 20000 };

/* With this number of bits, a grid over a continent has cells of a tenth of a metre. */
enum { CURVE_BITS = 26 };

/* A frame is useless if more than one in MOST_STRAYS features lies outside of it, or if all features lie within 1 /
 * CORNER of its size. */
enum { MOST_STRAYS = 8, CORNER = 1024 };

struct gis_spool_writer {
    char *directory;
    gis_sorter *sorter;
    double frame[4];       /* of the curve: where features are expected; empty if nothing is known */
    double box[4];         /* box of all features added */
    size_t placed, strays; /* number of features with a box, and of those outside of the frame */
    gis_disk_file out;
    gis_spool_room record;
    gis_spool_index index;
    gis_spool_entry cell; /* the cell being filled, and its records */
    gis_spool_room records;
    gis_spool_settle *settle;
    void *settle_user;
    uint64_t refused; /* the first feature in input order that `settle` rejected, with its message; UINT64_MAX: none */
    gis_error why;
};

bool gis_spool_create(const char *directory, const double frame[4], gis_spool_writer **out, gis_error *error)
{
    gis_spool_writer *writer = calloc(1, sizeof *writer);
    if (!writer) return gis_no_memory(error);
    writer->refused = UINT64_MAX;
    gis_box_clear(writer->box);
    memcpy(writer->frame, frame ? frame : writer->box, sizeof writer->frame);
    writer->directory = strdup(directory);
    if (!writer->directory) gis_no_memory(error);
    if (!writer->directory || !gis_sorter_new(directory, "features.runs", GIS_SORT_BYTES, &writer->sorter, error)) {
        gis_spool_writer_free(writer);
        return false;
    }
    *out = writer;
    return true;
}

static bool is_beyond(const double frame[4], const double box[4])
{
    return !(box[0] >= frame[0] && box[1] >= frame[1] && box[2] <= frame[2] && box[3] <= frame[3]);
}

bool gis_spool_add(gis_spool_writer *writer, const gis_spool_feature *feature, gis_error *error)
{
    double box[4];
    if (!gis_spool_record_make(&writer->record, feature, error)) return false;
    gis_spool_record_box(writer->record.at, box);
    if (!gis_box_is_empty(box)) {
        gis_box_join(writer->box, box);
        writer->placed++;
        writer->strays += is_beyond(writer->frame, box);
    }
    gis_spool_record_head(writer->record.at)->along = gis_spool_along(writer->frame, box);
    return gis_sorter_add(writer->sorter, writer->record.at, error);
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

static void begin_cell(gis_spool_writer *writer)
{
    writer->cell = (gis_spool_entry){.from = writer->out.size};
    gis_box_clear(writer->cell.cell.box);
    writer->records.used = 0;
}

static bool end_cell(gis_spool_writer *writer, gis_error *error)
{
    gis_spool_index *index = &writer->index;
    if (writer->cell.cell.features == 0) return true;
    writer->cell.bytes = writer->records.used;
    writer->cell.checksum = gis_checksum_of(0, writer->records.at, writer->records.used);
    if (!gis_array_reserve(&index->entry, &index->capacity, index->n + 1, sizeof *index->entry))
        return gis_no_memory(error);
    index->entry[index->n++] = writer->cell;
    if (!gis_disk_file_write(&writer->out, writer->records.at, writer->records.used, error)) return false;
    begin_cell(writer);
    return true;
}

/* Sets the values that depend on all features. */
static bool settle_record(gis_spool_writer *writer, unsigned char *record, gis_error *error)
{
    gis_spool_feature feature;
    if (!writer->settle) return true;
    if (!gis_spool_record_feature(record, (size_t)gis_spool_record_head(record)->bytes, &feature))
        return gis_fail(error, "%s/features: the file was damaged or changed", writer->directory);
    gis_error why;
    if (writer->settle(writer->settle_user, &feature, &why)) {
        gis_spool_record_settle(record, &feature.demands);
    } else if (feature.index < writer->refused) {
        writer->refused = feature.index;
        writer->why = why;
    }
    return true;
}

static bool take_record(void *user, const unsigned char *record, gis_error *error)
{
    gis_spool_writer *writer = user;
    double box[4];
    const size_t bytes = (size_t)((const gis_sort_head *)(const void *)record)->bytes,
                 vertices = gis_spool_record_vertices(record);
    gis_spool_cell *cell = &writer->cell.cell;
    const bool full = cell->features == CELL_FEATURES || cell->vertices + vertices > CELL_VERTICES;
    if (full && !end_cell(writer, error)) return false;
    gis_spool_room *records = &writer->records;
    if (!gis_array_reserve(&records->at, &records->capacity, records->used + bytes, 1)) return gis_no_memory(error);
    unsigned char *own = records->at + records->used;
    memcpy(own, record, bytes);
    records->used += bytes;
    cell->features++;
    cell->vertices += vertices;
    gis_spool_record_box(own, box);
    gis_box_join(cell->box, box);
    return settle_record(writer, own, error);
}

/* ---- Order ------------------------------------------------------------------------------------------------------- */

uint64_t gis_spool_along(const double all[4], const double box[4])
{
    if (gis_box_is_empty(box) || gis_box_is_empty(all)) return 0;
    const uint32_t x = gis_curve_cell(box[0] / 2 + box[2] / 2, all[0], all[2], CURVE_BITS);
    const uint32_t y = gis_curve_cell(box[1] / 2 + box[3] / 2, all[1], all[3], CURVE_BITS);
    return gis_curve_position(x, y, CURVE_BITS);
}

_Static_assert(offsetof(gis_spool_head, along) == offsetof(gis_sort_head, first) &&
                   offsetof(gis_spool_head, index) == offsetof(gis_sort_head, second),
               "records are sorted by their place on the curve and, where that is one, by their place in the input");

/* Is the frame good enough for sorting? Not if many features lie outside of it, or all lie in a corner: the extent that
 * a format stores may be out of date. */
static bool is_framed(const gis_spool_writer *writer)
{
    const double *frame = writer->frame, *box = writer->box;
    return writer->strays <= writer->placed / MOST_STRAYS &&
           !(fmax(box[2] - box[0], box[3] - box[1]) < fmax(frame[2] - frame[0], frame[3] - frame[1]) / CORNER);
}

typedef struct reordering {
    gis_spool_writer *writer;
    gis_sorter *to;
} reordering;

static bool put_elsewhere(void *user, const unsigned char *record, gis_error *error)
{
    const reordering *r = user;
    const size_t bytes = (size_t)((const gis_sort_head *)(const void *)record)->bytes;
    gis_spool_room *own = &r->writer->record;
    double box[4];
    if (!gis_array_reserve(&own->at, &own->capacity, bytes, 1)) return gis_no_memory(error);
    memcpy(own->at, record, bytes);
    gis_spool_record_box(own->at, box);
    gis_spool_record_head(own->at)->along = gis_spool_along(r->writer->box, box);
    return gis_sorter_add(r->to, own->at, error);
}

/* Sorts the records again, along the curve through their actual box. */
static bool order_again(gis_spool_writer *writer, gis_error *error)
{
    reordering r = {.writer = writer};
    const bool done = gis_sorter_new(writer->directory, "features.again", GIS_SORT_BYTES, &r.to, error) &&
                      gis_sorter_take(writer->sorter, put_elsewhere, &r, error);
    gis_sorter_free(writer->sorter);
    writer->sorter = r.to;
    return done;
}

/* ---- Ending ------------------------------------------------------------------------------------------------------ */

static bool write_features(gis_spool_writer *writer, gis_error *error)
{
    const gis_spool_mark mark = gis_spool_mark_of(GIS_SPOOL_FEATURES);
    if (!gis_disk_file_create(&writer->out, writer->directory, "features.part", error) ||
        !gis_disk_file_write(&writer->out, &mark, sizeof mark, error))
        return false;
    begin_cell(writer);
    if (!is_framed(writer) && !order_again(writer, error)) return false;
    if (!gis_sorter_take(writer->sorter, take_record, writer, error) || !end_cell(writer, error)) return false;
    if (writer->refused == UINT64_MAX) return gis_disk_file_place(&writer->out, writer->directory, "features", error);
    *error = writer->why;
    return false;
}

bool gis_spool_finish(gis_spool_writer *writer, unsigned parts, gis_spool_settle *settle, void *user, gis_error *error)
{
    writer->settle = settle;
    writer->settle_user = user;
    if (!write_features(writer, error)) return false;
    gis_sorter_free(writer->sorter);
    writer->sorter = NULL;
    gis_spool_index_deal(&writer->index, parts);
    return gis_spool_index_write(&writer->index, writer->directory, error);
}

void gis_spool_writer_free(gis_spool_writer *writer)
{
    if (!writer) return;
    gis_sorter_free(writer->sorter);
    gis_disk_file_close(&writer->out);
    gis_spool_index_clear(&writer->index);
    free(writer->record.at);
    free(writer->records.at);
    free(writer->directory);
    free(writer);
}
