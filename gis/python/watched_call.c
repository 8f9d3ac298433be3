/* watched_call.c: see watched_call.h. */
#define _GNU_SOURCE
#include "python/watched_call.h"

#include "base/interrupt.h"

#include <errno.h>
#include <pthread.h>
#include <time.h>

/* The time between two looks at signals; a person does not notice it. */
static const long long pause_ns = 50 * 1000 * 1000;

struct gis_py_watch {
    pthread_mutex_t mutex; /* guards the next four */
    pthread_cond_t ended;
    double fraction;
    bool stop, done;
    PyObject *progress; /* NULL: none */
    double told;        /* the fraction that the callback got last */
    /* Of work in the calling thread: */
    bool here;
    pthread_t owner;
    PyThreadState *held; /* the state of the interpreter while the lock is released */
    long long next;      /* when to look next */
    gis_py_work *work;
    void *of;
};

static long long now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000000000LL + now.tv_nsec;
}

/* Handles signals and calls the callback; the caller has the lock. False: an exception is set. */
static bool look(gis_py_watch *watch, double fraction)
{
    if (PyErr_CheckSignals() < 0) return false;
    if (!watch->progress || fraction <= watch->told) return true;
    watch->told = fraction;
    PyObject *result = PyObject_CallFunction(watch->progress, "d", fraction);
    Py_XDECREF(result);
    return result != NULL;
}

static void stop(gis_py_watch *watch)
{
    pthread_mutex_lock(&watch->mutex);
    watch->stop = true;
    pthread_mutex_unlock(&watch->mutex);
}

/* Called by the core in any of its threads. */
static bool go_on(gis_py_watch *watch, double fraction)
{
    pthread_mutex_lock(&watch->mutex);
    if (fraction > watch->fraction) watch->fraction = fraction;
    const double furthest = watch->fraction;
    const bool stopped = watch->stop;
    pthread_mutex_unlock(&watch->mutex);
    if (stopped) return false;
    if (!watch->here || !pthread_equal(pthread_self(), watch->owner) || now_ns() < watch->next) return true;
    PyEval_RestoreThread(watch->held);
    const bool sound = look(watch, furthest);
    watch->held = PyEval_SaveThread();
    watch->next = now_ns() + pause_ns;
    if (!sound) stop(watch);
    return sound;
}

bool gis_py_progress(double fraction, void *watch) { return go_on(watch, fraction); }

static bool watch_core(void *watch) { return go_on(watch, 0); }

static void run_here(gis_py_watch *watch)
{
    watch->here = true;
    watch->owner = pthread_self();
    watch->next = now_ns() + pause_ns;
    watch->held = PyEval_SaveThread();
    sunder_watch(watch_core, watch);
    watch->work(watch->of, watch);
    sunder_watch(NULL, NULL);
    PyEval_RestoreThread(watch->held);
}

static void *worker(void *of)
{
    gis_py_watch *watch = of;
    sunder_watch(watch_core, watch);
    watch->work(watch->of, watch);
    sunder_watch(NULL, NULL);
    pthread_mutex_lock(&watch->mutex);
    watch->done = true;
    pthread_cond_signal(&watch->ended);
    pthread_mutex_unlock(&watch->mutex);
    return NULL;
}

/* Waits for the end of the work, without the lock, for at most the pause. */
static bool wait_a_while(gis_py_watch *watch, double *fraction)
{
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += (long)pause_ns;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    PyThreadState *held = PyEval_SaveThread();
    pthread_mutex_lock(&watch->mutex);
    int result = 0;
    while (!watch->done && result != ETIMEDOUT) result = pthread_cond_timedwait(&watch->ended, &watch->mutex, &until);
    const bool done = watch->done;
    *fraction = watch->fraction;
    pthread_mutex_unlock(&watch->mutex);
    PyEval_RestoreThread(held);
    return done;
}

static bool run_beside(gis_py_watch *watch)
{
    pthread_t thread;
    double fraction;
    if (pthread_create(&thread, NULL, worker, watch) != 0) return false;
    bool sound = true;
    while (!wait_a_while(watch, &fraction)) {
        if (!sound || look(watch, fraction)) continue;
        sound = false;
        stop(watch);
    }
    Py_BEGIN_ALLOW_THREADS pthread_join(thread, NULL);
    Py_END_ALLOW_THREADS return true;
}

bool gis_py_run(gis_py_work *work, void *of, PyObject *progress, bool beside)
{
    gis_py_watch watch = {.progress = progress == Py_None ? NULL : progress, .told = -1, .work = work, .of = of};
    if (watch.progress && !PyCallable_Check(watch.progress)) return gis_py_wrong("progress", "not callable");
    if (PyErr_CheckSignals() < 0) return false;
    pthread_mutex_init(&watch.mutex, NULL);
    pthread_cond_init(&watch.ended, NULL);
    /* Without a thread the work is done here; then Ctrl-C works between the threads of the core. */
    if (!beside || !run_beside(&watch)) run_here(&watch);
    pthread_cond_destroy(&watch.ended);
    pthread_mutex_destroy(&watch.mutex);
    return !PyErr_Occurred();
}

/* ---- What files of gis/ ask that also serve the program ---------------------------------------------------------- */

/* Signals are the interpreter's here; code that rounds or copies ends within milliseconds, and is not stopped. */
bool gis_interrupted(void) { return false; }
const char *gis_interruption(void) { return GIS_INTERRUPTED; }
bool gis_go_on(gis_error *error)
{
    (void)error;
    return true;
}
