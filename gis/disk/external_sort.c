/* external_sort.c: see external_sort.h. Records are collected until they fill the memory allowed; then they are sorted
 * and appended to a file as a run. At the end the runs are merged with a heap of their first records. */
#include "disk/external_sort.h"

#include "base/array.h"
#include "base/keyed_sort.h"

#include <stdlib.h>
#include <string.h>

/* A sorted run in the file, and its records that were read but not yet returned. */
typedef struct run {
    uint64_t from, end; /* the part of the file that was not read yet */
    unsigned char *at;  /* buffer; the records in it begin at `used` and end at `filled` */
    size_t used, filled, room;
} run;

struct gis_sorter {
    char *directory, *parts;
    size_t most; /* largest size of a run, in bytes */
    gis_disk_file runs;
    run *run;
    size_t n, capacity;
    unsigned char *part; /* records being collected, in the order in which they were added */
    size_t used, room;
    gis_keyed *place; /* offset of each record in `part`, and one of its keys */
    size_t places, place_room;
};

static int compare_heads(const gis_sort_head *p, const gis_sort_head *q)
{
    if (p->first != q->first) return p->first < q->first ? -1 : 1;
    return (p->second > q->second) - (p->second < q->second);
}

static gis_sort_head *head_of(unsigned char *record) { return (void *)record; }

static bool fail_content(const gis_disk_file *file, gis_error *error)
{
    return gis_fail(error, "%s: the file was damaged or changed", file->path);
}

/* ---- Runs -------------------------------------------------------------------------------------------------------- */

enum { LEAST_ROOM = 1 << 16 };

/* Makes room for `bytes` further bytes. The buffer never grows beyond `most` for several records; doubling alone would
 * exceed it. */
static bool reserve_part(gis_sorter *s, size_t bytes, gis_error *error)
{
    if (s->room - s->used >= bytes) return true;
    size_t room = 2 * s->room > LEAST_ROOM ? 2 * s->room : LEAST_ROOM;
    if (room > s->most) room = s->most;
    if (room < s->used + bytes) room = s->used + bytes;
    unsigned char *larger = realloc(s->part, room);
    if (!larger) return gis_no_memory(error);
    s->part = larger;
    s->room = room;
    return true;
}

/* Sorts by the first key, then by the second, then by order of addition. It sorts by the second key first, since
 * gis_keyed_sort() is stable. */
static bool sort_records(gis_sorter *s, gis_error *error)
{
    gis_keyed *place = s->place;
    for (size_t k = 0; k < s->places; k++) place[k].key = head_of(s->part + place[k].with)->second;
    if (!gis_keyed_sort(place, s->places)) return gis_no_memory(error);
    for (size_t k = 0; k < s->places; k++) place[k].key = head_of(s->part + place[k].with)->first;
    return gis_keyed_sort(place, s->places) || gis_no_memory(error);
}

static bool write_run(gis_sorter *s, gis_error *error)
{
    if (!sort_records(s, error)) return false;
    if (!s->runs.stream && !gis_disk_file_create(&s->runs, s->directory, s->parts, error)) return false;
    if (!gis_array_reserve(&s->run, &s->capacity, s->n + 1, sizeof *s->run)) return gis_no_memory(error);
    run *next = &s->run[s->n++];
    *next = (run){.from = s->runs.size};
    for (size_t k = 0; k < s->places; k++) {
        unsigned char *record = s->part + s->place[k].with;
        if (!gis_disk_file_write(&s->runs, record, head_of(record)->bytes, error)) return false;
    }
    next->end = s->runs.size;
    s->places = s->used = 0;
    return gis_go_on(error);
}

static bool take_records(gis_sorter *s, gis_sort_take *take, void *user, gis_error *error)
{
    if (!sort_records(s, error)) return false;
    for (size_t k = 0; k < s->places; k++)
        if (!take(user, s->part + s->place[k].with, error)) return false;
    return true;
}

/* ---- Merging ----------------------------------------------------------------------------------------------------- */

static gis_sort_head *first_of(const run *r) { return head_of(r->at + r->used); }

/* Makes sure that the first remaining record of a run is completely in memory, reading `share` bytes at a time. *any is
 * set to false if no record remains. */
static bool refill_run(gis_sorter *s, run *r, size_t share, bool *any, gis_error *error)
{
    const size_t have = r->filled - r->used;
    *any = have > 0 || r->from < r->end;
    if (!*any || (have >= sizeof(gis_sort_head) && have >= first_of(r)->bytes)) return true;
    /* Read a share, or the whole record if it is larger. */
    size_t wanted = share;
    if (have >= sizeof(gis_sort_head) && first_of(r)->bytes > wanted) wanted = first_of(r)->bytes;
    if (have) memmove(r->at, r->at + r->used, have);
    if (r->room < wanted) {
        unsigned char *larger = realloc(r->at, wanted);
        if (!larger) return gis_no_memory(error);
        r->at = larger;
        r->room = wanted;
    }
    const size_t more = r->end - r->from < wanted - have ? (size_t)(r->end - r->from) : wanted - have;
    if (more == 0) return fail_content(&s->runs, error);
    if (!gis_disk_file_read(&s->runs, r->from, r->at + have, more, error)) return false;
    r->from += more;
    r->used = 0;
    r->filled = have + more;
    return refill_run(s, r, share, any, error); /* again, if the record is larger than the share */
}

/* Does a's first record come before b's? Records with equal keys are in the order of their runs, which is the order of
 * addition. */
static bool run_is_before(const run *a, const run *b)
{
    const int by_keys = compare_heads(first_of(a), first_of(b));
    return by_keys ? by_keys < 0 : a < b;
}

/* Moves entry i of the heap down to its place. */
static void sift_down(run **heap, size_t n, size_t i)
{
    for (size_t child; (child = 2 * i + 1) < n; i = child) {
        if (child + 1 < n && run_is_before(heap[child + 1], heap[child])) child++;
        if (!run_is_before(heap[child], heap[i])) return;
        run *lower = heap[i];
        heap[i] = heap[child];
        heap[child] = lower;
    }
}

static bool merge_heap(gis_sorter *s, run **heap, size_t share, gis_sort_take *take, void *user, gis_error *error)
{
    size_t n = 0;
    for (size_t k = 0; k < s->n; k++) {
        bool any;
        if (!refill_run(s, &s->run[k], share, &any, error)) return false;
        if (any) heap[n++] = &s->run[k];
    }
    for (size_t i = n / 2; i-- > 0;) sift_down(heap, n, i);
    while (n > 0) {
        run *least = heap[0];
        bool any;
        if (!gis_go_on(error) || !take(user, least->at + least->used, error)) return false;
        least->used += first_of(least)->bytes;
        if (!refill_run(s, least, share, &any, error)) return false;
        if (!any) heap[0] = heap[--n];
        sift_down(heap, n, 0);
    }
    return true;
}

/* The smallest number of bytes read from a run at once; smaller reads would cost a seek for every few records. */
enum { LEAST_SHARE = 1 << 16 };

static bool merge_runs(gis_sorter *s, gis_sort_take *take, void *user, gis_error *error)
{
    free(s->part);
    free(s->place);
    s->part = NULL;
    s->place = NULL;
    run **heap = malloc((s->n + 1) * sizeof *heap);
    if (!heap) return gis_no_memory(error);
    size_t share = s->most / (s->n + 1);
    if (share < LEAST_SHARE) share = LEAST_SHARE;
    const bool done = gis_disk_file_flush(&s->runs, error) && merge_heap(s, heap, share, take, user, error);
    free(heap);
    return done;
}

/* ---- The sorter -------------------------------------------------------------------------------------------------- */

bool gis_sorter_new(const char *directory, const char *parts, size_t most, gis_sorter **out, gis_error *error)
{
    gis_sorter *s = calloc(1, sizeof *s);
    if (!s) return gis_no_memory(error);
    *s = (gis_sorter){.directory = strdup(directory), .parts = strdup(parts), .most = most};
    if (!s->directory || !s->parts) {
        gis_sorter_free(s);
        return gis_no_memory(error);
    }
    *out = s;
    return true;
}

bool gis_sorter_add(gis_sorter *sorter, const void *record, gis_error *error)
{
    const size_t bytes = (size_t)((const gis_sort_head *)record)->bytes;
    if (sorter->places && sorter->used + bytes > sorter->most && !write_run(sorter, error)) return false;
    if (!reserve_part(sorter, bytes, error)) return false;
    if (!gis_array_reserve(&sorter->place, &sorter->place_room, sorter->places + 1, sizeof *sorter->place))
        return gis_no_memory(error);
    memcpy(sorter->part + sorter->used, record, bytes);
    sorter->place[sorter->places++].with = sorter->used;
    sorter->used += bytes;
    return true;
}

bool gis_sorter_take(gis_sorter *sorter, gis_sort_take *take, void *user, gis_error *error)
{
    if (sorter->n == 0) return take_records(sorter, take, user, error);
    return write_run(sorter, error) && merge_runs(sorter, take, user, error);
}

void gis_sorter_free(gis_sorter *sorter)
{
    if (!sorter) return;
    for (size_t k = 0; k < sorter->n; k++) free(sorter->run[k].at);
    free(sorter->run);
    free(sorter->part);
    free(sorter->place);
    free(sorter->directory);
    free(sorter->parts);
    gis_disk_file_close(&sorter->runs);
    free(sorter);
}
