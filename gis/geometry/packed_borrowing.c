/* packed_borrowing.c: see packed_borrowing.h. If several threads are allowed, a second one does the second half. */
#include "geometry/packed_borrowing.h"

#include "base/side_thread.h"

/* With fewer features, starting a thread takes longer than the work. */
enum { MANY = 5000 };

/* The records begin ... end - 1. */
typedef struct stretch {
    gis_packed *lean;
    const unsigned char **record;
    size_t begin, end;
    bool done;
} stretch;

static void borrow_stretch(void *context)
{
    stretch *s = context;
    s->done = true;
    for (size_t i = s->begin; i < s->end && s->done; i++) {
        if (!s->record[i]) continue;
        s->record[i] = gis_packed_add_borrowing(s->lean, s->record[i], i);
        s->done = s->record[i] != NULL;
    }
}

bool gis_packed_borrow_all(gis_packed *lean, OGRLayerH layer, const unsigned char **record, size_t n, unsigned threads,
                           gis_error *error)
{
    const size_t half = threads > 1 && n >= MANY ? n / 2 : n;
    gis_packed other;
    if (!gis_packed_begin(&other, layer, error)) return false;
    other.shape = lean->shape;
    stretch first = {.lean = lean, .record = record, .end = half};
    stretch second = {.lean = &other, .record = record, .begin = half, .end = n};
    gis_side_thread *beside = half < n ? gis_side_thread_new() : NULL;
    gis_side_thread_do(beside, borrow_stretch, &second);
    borrow_stretch(&first);
    gis_side_thread_free(beside);
    const bool done = first.done && second.done && gis_packed_join(lean, &other);
    gis_packed_clear(&other);
    return done || gis_no_memory(error);
}
