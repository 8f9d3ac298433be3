/* make.c: computes all sets on several threads (make_set.c computes one). Which thread computes a set is arbitrary, but
 * the result is not: a set depends on the input only, and if several sets fail, the error of the first one is
 * returned. */
#include "buffer/buffer.h"

#include "base/interrupt.h"
#include "base/resources.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

typedef struct making {
    gis_buffer *buffer;
    gis_progress *progress; /* called by the thread that has locked `lock`, or by the only one that computes */
    unsigned threads;       /* the number of threads inside the computation of a single set */
    atomic_size_t next;
    atomic_bool stop;
    pthread_mutex_t lock; /* protects the members below */
    size_t done, failed;  /* the least number of a set that failed; the number of sets if none did */
    gis_error error;
} making;

/* The progress callback of the core within a set. A single set reports its progress; one of several only checks whether
 * it must stop. */
static bool tell_inside(double fraction, void *user)
{
    making *m = user;
    if (m->buffer->sets == 1) return gis_progress_call(fraction, m->progress);
    return !gis_interrupted() && !atomic_load(&m->stop);
}

static void note_done(making *m)
{
    pthread_mutex_lock(&m->lock);
    m->done++;
    if (m->buffer->sets > 1 && !gis_progress_call((double)m->done / (double)m->buffer->sets, m->progress) &&
        !atomic_exchange(&m->stop, true))
        gis_fail(&m->error, GIS_INTERRUPTED);
    pthread_mutex_unlock(&m->lock);
}

static void note_failure(making *m, size_t set, const gis_error *error)
{
    char who[GIS_WHO_SIZE] = "";
    const gis_buffer *buffer = m->buffer;
    if (!buffer->request->dissolve) gis_feature_name(&buffer->input, buffer->set[set].member[0], who, sizeof who);
    bool stopped = gis_is_interruption(error);
    pthread_mutex_lock(&m->lock);
    /* a set that was stopped since another one failed is not the cause of the failure */
    if (set < m->failed && !(stopped && atomic_load(&m->stop))) {
        m->failed = set;
        m->error = *error;
        if (*who && !stopped) gis_fail(&m->error, "%s: %s", who, error->message);
    }
    atomic_store(&m->stop, true);
    pthread_mutex_unlock(&m->lock);
}

static void *make_sets(void *argument)
{
    making *m = argument;
    gis_error error;
    gis_watch();
    const sunder_sum_options how = {.size = sizeof how,
                                    .progress = tell_inside,
                                    .progress_user = m,
                                    .threads = m->buffer->sets == 1 ? m->threads : 1};
    while (!atomic_load(&m->stop)) {
        size_t k = atomic_fetch_add(&m->next, 1);
        if (k >= m->buffer->sets) break;
        bool blocks = m->buffer->request->dissolve && m->buffer->request->align;
        if (!(blocks ? gis_buffer_make_blocks : gis_buffer_make_set)(m->buffer, &m->buffer->set[k], &how, &error))
            note_failure(m, k, &error);
        note_done(m);
    }
    return NULL;
}

static void add_up(gis_buffer *buffer)
{
    for (size_t k = 0; k < buffer->sets; k++) {
        const gis_buffer_set *set = &buffer->set[k];
        buffer->empty += !set->none && set->result.set.polygons == 0;
        buffer->vertices += set->result.set.vertices;
        buffer->rounded_again += set->result.repaired;
        buffer->area += set->area;
        buffer->deviation = fmax(buffer->deviation, set->result.deviation);
    }
}

/* The calling thread computes sets, too; if no other thread can be started it computes all of them. */
bool gis_buffer_make(gis_buffer *buffer, gis_progress *progress, gis_error *error)
{
    size_t asked = gis_threads(buffer->request->threads), threads = asked < buffer->sets ? asked : buffer->sets,
           started = 0;
    making m = {.buffer = buffer, .progress = progress, .failed = buffer->sets, .threads = (unsigned)asked};
    pthread_t *thread = calloc(threads + 1, sizeof *thread);
    if (!thread) return gis_no_memory(error);
    pthread_mutex_init(&m.lock, NULL);
    while (started + 1 < threads && pthread_create(&thread[started], NULL, make_sets, &m) == 0) started++;
    make_sets(&m);
    for (size_t i = 0; i < started; i++) pthread_join(thread[i], NULL);
    pthread_mutex_destroy(&m.lock);
    free(thread);
    if (atomic_load(&m.stop)) {
        *error = m.error;
        return false;
    }
    add_up(buffer);
    return true;
}
