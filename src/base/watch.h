/* watch.h: whether work may continue.
 *
 * Work is counted in steps: an allocation, a node of a search, a comparison of two sides; each takes a few microseconds
 * at most. Every SUNDER_I_STEPS steps a thread calls its watches: the progress functions of the public calls in which
 * it is, and its own (sunder_watch). When one of these returns false, the thread is refused memory, so that all work
 * ends in the same way as if out of memory; sunder_i_failure_cause() distinguishes the two causes. A loop that does not
 * allocate counts its steps and returns:
 *
 *     if (!sunder_i_step()) return sunder_i_failure_cause(err);
 *
 * If a function returns false for "out of memory", this includes all three causes: out of memory, stopped, and a count
 * that is too large (sunder_i_too_many).
 *
 * All of this is state of the thread: only the watches themselves are shared, since the threads of sunder_i_parallel()
 * inherit them from the thread that starts them. */
#ifndef SUNDER_I_WATCH_H
#define SUNDER_I_WATCH_H

#include "sunder_base.h"

#include <pthread.h>
#include <stdatomic.h>

/* The number of steps between two calls of the watches: a few microseconds each at most, so that a stop is noticed
 * within about a millisecond. */
#define SUNDER_I_STEPS 256

typedef struct sunder_i_watch {
    sunder_progress progress; /* called by one thread at a time, which has the lock ... */
    bool (*go_on)(void *);    /* ... or this one */
    void *user;
    pthread_mutex_t lock;
    double fraction; /* the last value reported */
    atomic_bool stopped;
    struct sunder_i_watch *outer;
} sunder_i_watch;

/* Adds *progress (NULL: nothing) to the watches of the thread, until sunder_i_watch_end(), which must be called in
 * every case. *progress is replaced by a function that reports to the watch and may be called by any thread, and *user
 * by its argument. */
void sunder_i_watch_begin(sunder_i_watch *watch, sunder_progress *progress, void **user);
void sunder_i_watch_end(sunder_i_watch *watch);

/* Return the watch of the calling thread, and set it for a thread that works for that one. */
sunder_i_watch *sunder_i_watch_here(void);
void sunder_i_watch_join(sunder_i_watch *watch);

typedef struct sunder_i_thread {
    int32_t left; /* the number of steps until the watches are called */
    bool too_many;
    sunder_i_watch *watch; /* the innermost watch; NULL: none */
    sunder_i_watch own;    /* the watch of sunder_watch(), the outermost */
} sunder_i_thread;

extern _Thread_local sunder_i_thread sunder_i_this_thread
    __attribute__((tls_model("initial-exec"), visibility("hidden")));

/* Calls the watches. Returns false if the work is to stop. */
bool sunder_i_look(void);
/* Returns true if a watch has stopped the work. The watches are not called again. */
bool sunder_i_stopped(void);

/* Counts one step. Returns false if the work is to stop. */
static inline bool sunder_i_step(void) { return --sunder_i_this_thread.left >= 0 || sunder_i_look(); }

/* Counts the steps of a loop of n items that cannot stop. Returns false if the work is to stop. */
static inline bool sunder_i_steps(size_t n)
{
    if (n >= (size_t)INT32_MAX / 2 || (sunder_i_this_thread.left -= (int32_t)n) < 0) return sunder_i_look();
    return true;
}

/* Records, for sunder_i_failure_cause(), that a count cannot be represented. Always returns false. */
bool sunder_i_too_many(void);
/* Returns whether this was recorded, and clears the record. */
bool sunder_i_was_too_many(void);

#endif
