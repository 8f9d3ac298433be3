/* parallel.c: independent work on several threads. The assignment of work to threads is arbitrary; the place of each
 * result is not.
 *
 * Work may itself call sunder_i_parallel(): then it gets idle threads of the run to which it belongs. So a large item
 * at the end does not occupy one thread while the others wait, and no more threads run than the caller asked for. */
#include "base/parallel.h"

#include "base/memory.h"
#include "base/sort.h"
#include "base/watch.h"

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

typedef struct job {
    sunder_i_work work;
    void *context;
    sunder_i_watch *watch; /* the watch of the thread that started the job */
    size_t n, grain;
    const uint64_t *order; /* [n] the items, in the lower halves; NULL: in the order of their numbers */
    atomic_size_t next;    /* the first item that is not assigned to a thread yet */
    atomic_bool failed;
    atomic_size_t idle;   /* the number of idle threads that nested work may use */
    pthread_mutex_t lock; /* protects the following fields */
    size_t failed_at;     /* the least failing item so far */
    sunder_status status;
    sunder_error error;
} job;

/* The job that the calling thread belongs to; NULL: none. */
static _Thread_local job *here;

static void fail_job(job *j, size_t begin, sunder_status status, const sunder_error *error)
{
    atomic_store(&j->failed, true);
    pthread_mutex_lock(&j->lock);
    if (begin < j->failed_at) {
        j->failed_at = begin;
        j->status = status;
        j->error = *error;
    }
    pthread_mutex_unlock(&j->lock);
}

/* Takes up to `most` of the idle threads; returns their number. */
static size_t take_idle(job *j, size_t most)
{
    size_t idle = atomic_load(&j->idle), taken;
    do {
        taken = idle < most ? idle : most;
    } while (!atomic_compare_exchange_weak(&j->idle, &idle, idle - taken));
    return taken;
}

static void *run_job(void *argument)
{
    job *j = argument, *outer = here;
    sunder_i_watch_join(j->watch);
    here = j;
    while (!atomic_load(&j->failed)) {
        const size_t at = atomic_fetch_add(&j->next, j->grain);
        if (at >= j->n) break;
        const size_t begin = j->order ? (size_t)(uint32_t)j->order[at] : at;
        const size_t end = j->n - at < j->grain ? j->n : begin + j->grain;
        sunder_error error;
        memset(&error, 0, sizeof error);
        const sunder_status status = j->work(j->context, begin, end, &error);
        if (status) fail_job(j, begin, status, &error);
    }
    here = outer;
    atomic_fetch_add(&j->idle, 1);
    return NULL;
}

/* Runs the job; work, context, n, grain and order must be set. */
static sunder_status run_on(unsigned threads, job *j, sunder_error *err)
{
    enum { MOST = 256 };
    j->watch = sunder_i_watch_here();
    j->failed_at = SIZE_MAX;
    atomic_init(&j->next, 0);
    atomic_init(&j->failed, false);
    pthread_mutex_init(&j->lock, NULL);
    job *outer = here;
    const size_t parts = (j->n - 1) / j->grain + 1;
    size_t most = threads > 1 ? threads - 1 : 0, started = 0;
    if (most > MOST) most = MOST;
    if (outer) most = take_idle(outer, most);
    const size_t helpers = most < parts - 1 ? most : parts - 1;
    atomic_init(&j->idle, most - helpers);
    pthread_t helper[MOST];
    /* If a thread cannot be started, this is no error: the others do its share. */
    while (started < helpers && pthread_create(&helper[started], NULL, run_job, j) == 0) started++;
    run_job(j);
    for (size_t i = 0; i < started; i++) pthread_join(helper[i], NULL);
    if (outer) atomic_fetch_add(&outer->idle, most);
    pthread_mutex_destroy(&j->lock);
    if (j->status && err) *err = j->error;
    return j->status;
}

sunder_status sunder_i_parallel(unsigned threads, size_t n, size_t grain, sunder_i_work work, void *context,
                                sunder_error *err)
{
    job j = {.work = work, .context = context, .n = n, .grain = grain ? grain : 1};
    return n ? run_on(threads, &j, err) : SUNDER_OK;
}

sunder_status sunder_i_parallel_largest_first(unsigned threads, const size_t *size, size_t n, sunder_i_work work,
                                              void *context, sunder_error *err)
{
    if (threads <= 1) return sunder_i_parallel(threads, n, 1, work, context, err);
    uint64_t *order = sunder_i_alloc(n, sizeof *order);
    for (size_t k = 0; k < n && order; k++)
        order[k] = (uint64_t)(UINT32_MAX - (size[k] < UINT32_MAX ? size[k] : UINT32_MAX)) << 32 | k;
    job j = {.work = work, .context = context, .n = n, .grain = 1, .order = order};
    const bool ok = order && sunder_i_sort_keys(order, n);
    const sunder_status status = !ok ? sunder_i_failure_cause(err) : n ? run_on(threads, &j, err) : SUNDER_OK;
    sunder_i_free(order);
    return status;
}
