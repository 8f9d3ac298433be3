/* Independent work on several threads. Which thread does what is left to chance; where the result goes is not. */
#include "base/parallel.h"

#include "base/watch.h"

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

typedef struct job {
    sunder_i_work work;
    void *context;
    sunder_i_watch *watch; /* of the thread whose work it is */
    size_t n, grain;
    atomic_size_t next; /* first item not handed out */
    atomic_bool failed;
    pthread_mutex_t lock; /* of what follows */
    size_t failed_at;     /* the least failing item so far */
    sunder_status status;
    sunder_error error;
} job;

static void fail(job *j, size_t begin, sunder_status status, const sunder_error *error)
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

static void *run(void *argument)
{
    job *j = argument;
    sunder_i_watch_join(j->watch);
    while (!atomic_load(&j->failed)) {
        const size_t begin = atomic_fetch_add(&j->next, j->grain);
        if (begin >= j->n) break;
        const size_t end = j->n - begin < j->grain ? j->n : begin + j->grain;
        sunder_error error;
        memset(&error, 0, sizeof error);
        const sunder_status status = j->work(j->context, begin, end, &error);
        if (status) fail(j, begin, status, &error);
    }
    return NULL;
}

sunder_status sunder_i_parallel(unsigned threads, size_t n, size_t grain, sunder_i_work work, void *context,
                                sunder_error *err)
{
    enum { MOST = 256 };
    if (n == 0) return SUNDER_OK;
    job j = {.work = work,
             .context = context,
             .watch = sunder_i_watch_here(),
             .n = n,
             .grain = grain ? grain : 1,
             .failed_at = SIZE_MAX};
    atomic_init(&j.next, 0);
    atomic_init(&j.failed, false);
    pthread_mutex_init(&j.lock, NULL);
    const size_t parts = (n - 1) / j.grain + 1;
    size_t helpers = threads > 1 ? threads - 1 : 0, started = 0;
    if (helpers > MOST) helpers = MOST;
    if (helpers > parts - 1) helpers = parts - 1;
    pthread_t helper[MOST];
    /* A thread that cannot be had is no error: those that run take its share. */
    while (started < helpers && pthread_create(&helper[started], NULL, run, &j) == 0) started++;
    run(&j);
    for (size_t i = 0; i < started; i++) pthread_join(helper[i], NULL);
    pthread_mutex_destroy(&j.lock);
    if (j.status && err) *err = j.error;
    return j.status;
}
