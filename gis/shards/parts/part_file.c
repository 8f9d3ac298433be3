/* part_file.c: see part_file.h. The file holds a mark; the stamp, with a number for the layout of chunks
 * (gis_part_result_form()); the chunks; the list of chunks; and the number of chunks, the offset of the list, and a
 * checksum of stamp and list. */
#include "shards/parts/part_file.h"

#include "base/array.h"
#include "disk/checksum.h"
#include "disk/temporary.h"
#include "geometry/gis_box.h"
#include "shards/parts/part_result_check.h"
#include "shards/spool/spool_index.h"
#include "shards/spool/spool_record.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WHAT "SUNDPART"

enum { CHUNK_WORLDS = 64 };

typedef struct stored_stamp {
    gis_part_stamp is;
    uint64_t form;
} stored_stamp;

typedef struct stored_end {
    uint64_t chunks, from, checksum;
} stored_end;

void gis_part_file_name(uint32_t shard, char name[GIS_PART_FILE_NAME])
{
    snprintf(name, GIS_PART_FILE_NAME, "shard-%" PRIu32, shard);
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

/* Creates a file under a temporary name of its own, since a scheduler may run a shard twice at once, on two machines
 * that share the directory. */
bool gis_part_file_create(gis_part_file *file, const char *directory, const gis_part_stamp *stamp, gis_error *error)
{
    const gis_spool_mark mark = gis_spool_mark_of(WHAT);
    const stored_stamp head = {*stamp, gis_part_result_form()};
    char name[GIS_PART_FILE_NAME + sizeof GIS_OWN_LETTERS];
    *file = (gis_part_file){.stamp = *stamp};
    gis_part_file_name(stamp->shard, name);
    gis_remove_abandoned(directory, name);
    strcat(name, GIS_OWN_LETTERS); /* several processes may write the same shard */
    return gis_disk_file_create(&file->file, directory, name, error) &&
           gis_disk_file_write(&file->file, &mark, sizeof mark, error) &&
           gis_disk_file_write(&file->file, &head, sizeof head, error);
}

static bool room_for(gis_part_file *file, size_t bytes, gis_error *error)
{
    return gis_array_reserve(&file->bytes, &file->size, bytes, 1) || gis_no_memory(error);
}

static void lies_in(gis_part_line *line, const gis_part_file *file, uint64_t from)
{
    if (line->bytes) *line = (gis_part_line){from + line->from, line->bytes, file->stamp.shard};
}

/* Writes the lines of the proof before their chunk, and makes the chunk's items refer to their place in the file. */
static bool write_lines(gis_part_file *file, gis_part_result *r, gis_part_chunk *chunk, gis_error *error)
{
    const uint64_t from = file->file.size;
    chunk->lines = r->lines;
    chunk->lines_checksum = gis_checksum_of(0, r->line, r->lines);
    for (size_t k = 0; k < r->conflicts; k++) lies_in(&r->conflict[k].line, file, from);
    for (size_t k = 0; k < r->trees; k++) lies_in(&r->tree[k].line, file, from);
    for (size_t k = 0; k < r->tolds; k++) lies_in(&r->told[k].line, file, from);
    r->lines = 0;
    return gis_disk_file_write(&file->file, r->line, (size_t)chunk->lines, error);
}

static bool write_chunk(gis_part_file *file, gis_part_result *r, gis_error *error)
{
    gis_part_chunk chunk = {.lines = 0};
    if (r->lines && !write_lines(file, r, &chunk, error)) return false;
    chunk.from = file->file.size;
    chunk.bytes = gis_part_result_size(r);
    gis_box_clear(chunk.box);
    for (size_t k = 0; k < r->footprints; k++) {
        gis_box_join(chunk.box, r->footprint[k].read);
        gis_box_join(chunk.box, r->footprint[k].wrote);
    }
    for (size_t k = 0; k < r->worlds; k++) {
        chunk.run = r->world[k].run;
        chunk.incomplete = chunk.incomplete || !r->world[k].complete;
    }
    if (!room_for(file, (size_t)chunk.bytes, error) ||
        !gis_array_reserve(&file->chunk, &file->room, file->chunks + 1, sizeof *file->chunk))
        return gis_no_memory(error);
    gis_part_result_store(r, file->bytes);
    chunk.checksum = gis_checksum_of(0, file->bytes, (size_t)chunk.bytes);
    file->chunk[file->chunks++] = chunk;
    return gis_disk_file_write(&file->file, file->bytes, (size_t)chunk.bytes, error);
}

/* A world, and the position of its first footprint on a curve through all worlds. */
typedef struct lying {
    uint64_t along;
    size_t world;
} lying;

static int by_place(const void *a, const void *b)
{
    const lying *p = a, *q = b;
    if (p->along != q->along) return p->along < q->along ? -1 : 1;
    return (p->world > q->world) - (p->world < q->world);
}

static lying *lay_out(const gis_part_result *r)
{
    lying *list = malloc((r->worlds + 1) * sizeof *list);
    double all[4];
    gis_box_clear(all);
    for (size_t k = 0; k < r->footprints; k++) gis_box_join(all, r->footprint[k].read);
    for (size_t w = 0; list && w < r->worlds; w++) {
        const gis_part_world *world = &r->world[w];
        list[w] = (lying){world->footprints ? gis_spool_along(all, r->footprint[world->footprint].read) : 0, w};
    }
    if (list && r->worlds) qsort(list, r->worlds, sizeof *list, by_place);
    return list;
}

static bool write_worlds(gis_part_file *file, const gis_part_result *r, gis_error *error)
{
    gis_part_result chunk = {0};
    lying *list = lay_out(r);
    bool done = list || gis_no_memory(error);
    for (size_t k = 0; k < r->worlds && done; k++) {
        done = gis_part_copy_world(&chunk, r, list[k].world, error);
        if (!done || (chunk.worlds < CHUNK_WORLDS && k + 1 < r->worlds)) continue;
        done = write_chunk(file, &chunk, error);
        gis_part_result_empty(&chunk);
    }
    free(list);
    gis_part_result_clear(&chunk);
    return done;
}

bool gis_part_file_add(gis_part_file *file, const gis_part_result *result, gis_error *error)
{
    gis_part_result others = {.unverified = result->unverified};
    bool done = write_worlds(file, result, error);
    for (size_t k = 0; k < result->stills && done; k++) done = gis_part_copy_still(&others, result, k, error);
    for (size_t k = 0; k < result->links && done; k++) done = gis_part_copy_link(&others, result, k, error);
    for (size_t k = 0; k < result->neighbours && done; k++) done = gis_part_copy_neighbours(&others, result, k, error);
    if (done && (others.stills || others.links || others.neighbours || others.unverified))
        done = write_chunk(file, &others, error);
    gis_part_result_clear(&others);
    return done;
}

static uint64_t checksum_of(const gis_part_file *file, const stored_stamp *head)
{
    const uint64_t stamp = gis_checksum_of(0, head, sizeof *head);
    return gis_checksum_of(stamp, file->chunk, file->chunks * sizeof *file->chunk);
}

bool gis_part_file_place(gis_part_file *file, const char *directory, gis_error *error)
{
    const stored_stamp head = {file->stamp, gis_part_result_form()};
    const stored_end end = {file->chunks, file->file.size, checksum_of(file, &head)};
    char name[GIS_PART_FILE_NAME];
    gis_part_file_name(file->stamp.shard, name);
    const bool done = gis_disk_file_write(&file->file, file->chunk, file->chunks * sizeof *file->chunk, error) &&
                      gis_disk_file_write(&file->file, &end, sizeof end, error) &&
                      gis_disk_file_place(&file->file, directory, name, error);
    gis_part_file_close(file);
    return done;
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

/* Fails if the file was made by another version, or for another plan, other options or another shard. */
static bool is_ours(const gis_part_file *file, const stored_stamp *head, gis_error *error)
{
    const gis_part_stamp *own = &file->stamp, *is = &head->is;
    const char *path = file->file.path;
    if (strncmp(own->version, is->version, sizeof own->version) != 0 || head->form != gis_part_result_form())
        return gis_fail(error, "%s: it was made by version %.*s of the program, this is %.*s", path,
                        (int)sizeof is->version, is->version, (int)sizeof own->version, own->version);
    if (own->spool != is->spool) return gis_fail(error, "%s: it was made of another plan", path);
    if (own->options != is->options) return gis_fail(error, "%s: it was made with other options", path);
    return (own->shard == is->shard && own->shards == is->shards) ||
           gis_fail(error, "%s: it is shard %" PRIu32 " of %" PRIu32 ", and should be %" PRIu32 " of %" PRIu32, path,
                    is->shard, is->shards, own->shard, own->shards);
}

static bool fail_cut_off(const gis_part_file *file, gis_error *error)
{
    return gis_fail(error, "%s: it ends too early: it was cut off", file->file.path);
}

static bool read_list(gis_part_file *file, const stored_stamp *head, gis_error *error)
{
    stored_end end;
    gis_disk_file *f = &file->file;
    const uint64_t least = sizeof(gis_spool_mark) + sizeof *head;
    if (f->size < least + sizeof end) return fail_cut_off(file, error);
    if (!gis_disk_file_read(f, f->size - sizeof end, &end, sizeof end, error)) return false;
    if (end.from < least || end.from > f->size - sizeof end ||
        end.chunks != (f->size - sizeof end - end.from) / sizeof *file->chunk)
        return fail_cut_off(file, error);
    if (!gis_array_reserve(&file->chunk, &file->room, (size_t)end.chunks + 1, sizeof *file->chunk))
        return gis_no_memory(error);
    file->chunks = (size_t)end.chunks;
    if (!gis_disk_file_read(f, end.from, file->chunk, file->chunks * sizeof *file->chunk, error)) return false;
    return checksum_of(file, head) == end.checksum ||
           gis_fail(error, "%s: checksum mismatch; the file was damaged or changed", f->path);
}

bool gis_part_file_open(gis_part_file *file, const char *directory, const gis_part_stamp *stamp, gis_error *error)
{
    gis_spool_mark mark;
    stored_stamp head;
    char name[GIS_PART_FILE_NAME];
    *file = (gis_part_file){.stamp = *stamp};
    gis_part_file_name(stamp->shard, name);
    return gis_disk_file_open(&file->file, directory, name, error) &&
           gis_disk_file_read(&file->file, 0, &mark, sizeof mark, error) &&
           gis_spool_mark_check(&mark, WHAT, file->file.path, error) &&
           gis_disk_file_read(&file->file, sizeof mark, &head, sizeof head, error) && is_ours(file, &head, error) &&
           read_list(file, &head, error);
}

static bool fail_altered(const gis_part_file *file, gis_error *error)
{
    return gis_fail(error, "%s: checksum mismatch; the file was damaged or changed", file->file.path);
}

bool gis_part_file_read(gis_part_file *file, size_t k, gis_part_result *to, gis_error *error)
{
    const gis_part_chunk *chunk = &file->chunk[k];
    bool sound = false;
    const uint64_t size = file->file.size;
    if (chunk->bytes > size || chunk->from > size - chunk->bytes) return fail_cut_off(file, error);
    if (!room_for(file, (size_t)chunk->bytes, error) ||
        !gis_disk_file_read(&file->file, chunk->from, file->bytes, (size_t)chunk->bytes, error))
        return false;
    if (gis_checksum_of(0, file->bytes, (size_t)chunk->bytes) == chunk->checksum &&
        !gis_part_result_load(to, file->bytes, (size_t)chunk->bytes, &sound, error))
        return false;
    return (sound && gis_part_result_is_sound(to, file->places)) || fail_altered(file, error);
}

static bool check_lines(gis_part_file *file, const gis_part_chunk *chunk, gis_error *error)
{
    if (chunk->lines > chunk->from) return fail_altered(file, error);
    if (!room_for(file, (size_t)chunk->lines, error)) return false;
    if (!gis_disk_file_read(&file->file, chunk->from - chunk->lines, file->bytes, (size_t)chunk->lines, error))
        return false;
    return gis_checksum_of(0, file->bytes, (size_t)chunk->lines) == chunk->lines_checksum || fail_altered(file, error);
}

bool gis_part_file_check(gis_part_file *file, size_t chunk, gis_part_result *scratch, gis_error *error)
{
    return gis_part_file_read(file, chunk, scratch, error) &&
           (file->chunk[chunk].lines == 0 || check_lines(file, &file->chunk[chunk], error));
}

bool gis_part_file_fetch(gis_part_file *file, size_t n, gis_part_result *to, gis_part_line *line, gis_error *error)
{
    if (line->file == 0 || line->bytes == 0) return true;
    if (line->file > n)
        return gis_fail(error, "a line of the proof is of shard %" PRIu64 ", which is none", line->file);
    const uint64_t size = file[line->file - 1].file.size;
    if (line->bytes > size || line->from > size - line->bytes) return fail_altered(&file[line->file - 1], error);
    const size_t bytes = (size_t)line->bytes;
    if (!GIS_PART_MORE(to, line, lines, bytes, error) ||
        !gis_disk_file_read(&file[line->file - 1].file, line->from, (unsigned char *)to->line + to->lines, bytes,
                            error))
        return false;
    *line = (gis_part_line){to->lines, bytes, 0};
    to->lines += bytes;
    return true;
}

void gis_part_file_close(gis_part_file *file)
{
    gis_disk_file_close(&file->file);
    free(file->chunk);
    free(file->bytes);
    *file = (gis_part_file){0};
}
