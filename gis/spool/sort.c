/* sort.c: see sort.h. Records are read in parts that fit into memory; each part is sorted and written behind the last
 * one, into one file; then the parts are merged by a heap of their first records. */
#include "spool/sort.h"

#include "base/array.h"

#include <stdlib.h>
#include <string.h>

/* A sorted part, and what of it was read but not yet taken. */
typedef struct run {
    uint64_t from, end; /* in the file: what was not yet read */
    unsigned char *at;  /* room of its own; the records in it begin at `used` and end at `filled` */
    size_t used, filled, room;
} run;

/* Where a record of the part in memory is. */
typedef struct place {
    uint64_t first, second;
    size_t offset;
} place;

typedef struct sorter {
    const gis_spool_sorting *how;
    gis_spool_file runs;
    run *run;
    size_t n, capacity;
    unsigned char *part; /* records of one part, in the order in which they came */
    size_t room;
    place *place;
    size_t places;
} sorter;

static int compare(uint64_t first_a, uint64_t second_a, uint64_t first_b, uint64_t second_b)
{
    if (first_a != first_b) return first_a < first_b ? -1 : 1;
    return (second_a > second_b) - (second_a < second_b);
}

static int compare_places(const void *a, const void *b)
{
    const place *p = a, *q = b;
    const int by_keys = compare(p->first, p->second, q->first, q->second);
    return by_keys ? by_keys : (p->offset > q->offset) - (p->offset < q->offset);
}

static gis_sort_head *head_of(unsigned char *record) { return (void *)record; }

/* ---- Parts ------------------------------------------------------------------------------------------------------- */

static bool fail_content(const gis_spool_file *file, gis_error *error)
{
    return gis_fail(error, "%s: it is not what was written", file->path);
}

/* Reads as many bytes of the next part. No more room than is needed: one that doubles would be twice the bound. */
static bool read_bytes(sorter *s, uint64_t from, size_t size, gis_error *error)
{
    if (s->room < size) {
        unsigned char *larger = realloc(s->part, size);
        if (!larger) return gis_no_memory(error);
        s->part = larger;
        s->room = size;
    }
    return gis_spool_file_read(s->how->from, from, s->part, size, error);
}

/* Reads the records that fit into a part, at least one; *n of them, as they came. */
static bool read_part(sorter *s, uint64_t *from, size_t *n, gis_error *error)
{
    gis_spool_file *file = s->how->from;
    const uint64_t left = file->size - *from;
    size_t size = left < s->how->run ? (size_t)left : s->how->run, used = 0;
    gis_sort_head head;
    if (left < sizeof head || !gis_spool_file_read(file, *from, &head, sizeof head, error) || head.bytes > left)
        return fail_content(file, error);
    if (size < head.bytes) size = head.bytes;
    if (!read_bytes(s, *from, size, error)) return false;
    for (*n = 0; size - used >= sizeof head; used += head_of(s->part + used)->bytes) {
        const gis_sort_head *next = head_of(s->part + used);
        if (next->bytes < sizeof head || next->bytes % 8) return fail_content(file, error);
        if (next->bytes > size - used) break;
        if (!gis_go_on(error) || (s->how->prepare && !s->how->prepare(s->how->user, s->part + used, error)))
            return false;
        if (!gis_array_reserve(&s->place, &s->places, *n + 1, sizeof *s->place)) return gis_no_memory(error);
        s->place[(*n)++] = (place){next->first, next->second, used};
    }
    *from += used;
    qsort(s->place, *n, sizeof *s->place, compare_places);
    return true;
}

static bool write_part(sorter *s, size_t n, gis_error *error)
{
    if (!gis_array_reserve(&s->run, &s->capacity, s->n + 1, sizeof *s->run)) return gis_no_memory(error);
    run *next = &s->run[s->n++];
    *next = (run){.from = s->runs.size};
    for (size_t k = 0; k < n; k++) {
        unsigned char *record = s->part + s->place[k].offset;
        if (!gis_spool_file_write(&s->runs, record, head_of(record)->bytes, error)) return false;
    }
    next->end = s->runs.size;
    return gis_go_on(error);
}

static bool take_part(sorter *s, size_t n, gis_error *error)
{
    for (size_t k = 0; k < n; k++)
        if (!s->how->take(s->how->user, s->part + s->place[k].offset, error)) return false;
    return true;
}

/* ---- Merging ----------------------------------------------------------------------------------------------------- */

static gis_sort_head *first_of(const run *r) { return head_of(r->at + r->used); }

/* Has the first record of what is left whole in memory; *any = false: nothing is left. */
static bool refill(sorter *s, run *r, size_t share, bool *any, gis_error *error)
{
    const size_t have = r->filled - r->used;
    *any = have > 0 || r->from < r->end;
    if (!*any || (have >= sizeof(gis_sort_head) && have >= first_of(r)->bytes)) return true;
    /* The share, or what the record needs that is there in part. */
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
    if (!gis_spool_file_read(&s->runs, r->from, r->at + have, more, error)) return false;
    r->from += more;
    r->used = 0;
    r->filled = have + more;
    return refill(s, r, share, any, error); /* once more where the record is larger than its share */
}

/* Runs lie in the order in which their records came. */
static bool before(const run *a, const run *b)
{
    const gis_sort_head *p = first_of(a), *q = first_of(b);
    const int by_keys = compare(p->first, p->second, q->first, q->second);
    return by_keys ? by_keys < 0 : a < b;
}

/* The heap's entry i sinks to where it belongs. */
static void sink(run **heap, size_t n, size_t i)
{
    for (size_t child; (child = 2 * i + 1) < n; i = child) {
        if (child + 1 < n && before(heap[child + 1], heap[child])) child++;
        if (!before(heap[child], heap[i])) return;
        run *lower = heap[i];
        heap[i] = heap[child];
        heap[child] = lower;
    }
}

static bool merge_heap(sorter *s, run **heap, size_t share, gis_error *error)
{
    size_t n = 0;
    for (size_t k = 0; k < s->n; k++) {
        bool any;
        if (!refill(s, &s->run[k], share, &any, error)) return false;
        if (any) heap[n++] = &s->run[k];
    }
    for (size_t i = n / 2; i-- > 0;) sink(heap, n, i);
    while (n > 0) {
        run *least = heap[0];
        bool any;
        if (!gis_go_on(error) || !s->how->take(s->how->user, least->at + least->used, error)) return false;
        least->used += first_of(least)->bytes;
        if (!refill(s, least, share, &any, error)) return false;
        if (!any) heap[0] = heap[--n];
        sink(heap, n, 0);
    }
    return true;
}

/* Reading less at once would cost a seek for every few records. */
enum { LEAST_SHARE = 1 << 16 };

static bool merge(sorter *s, gis_error *error)
{
    free(s->part);
    free(s->place);
    s->part = NULL;
    s->place = NULL;
    run **heap = malloc((s->n + 1) * sizeof *heap);
    if (!heap) return gis_no_memory(error);
    size_t share = s->how->run / (s->n + 1);
    if (share < LEAST_SHARE) share = LEAST_SHARE;
    const bool done = gis_spool_file_flush(&s->runs, error) && merge_heap(s, heap, share, error);
    free(heap);
    return done;
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

static bool sort(sorter *s, gis_error *error)
{
    size_t n;
    uint64_t from = 0;
    if (s->how->from->size == 0) return true;
    if (!read_part(s, &from, &n, error)) return false;
    if (from == s->how->from->size) return take_part(s, n, error);
    if (!gis_spool_file_create(&s->runs, s->how->directory, s->how->parts, error)) return false;
    while (write_part(s, n, error)) {
        if (from == s->how->from->size) return merge(s, error);
        if (!read_part(s, &from, &n, error)) return false;
    }
    return false;
}

bool gis_spool_sort(const gis_spool_sorting *sorting, gis_error *error)
{
    sorter s = {.how = sorting};
    const bool done = sort(&s, error);
    for (size_t k = 0; k < s.n; k++) free(s.run[k].at);
    free(s.run);
    free(s.part);
    free(s.place);
    gis_spool_file_close(&s.runs);
    return done;
}
