/* Watching: may the work go on?
 *
 * Work is counted in steps: an allocation, a node of a search, a side against a side; each takes at most some
 * microseconds. Every SUNDER_I_STEPS steps the thread asks its watches: the progress functions of the public calls that
 * it is in, and its own (sunder_watch). Once one of these says stop, the thread is refused memory, so that all work
 * unwinds along its out-of-memory paths; sunder_i_no_memory() tells the two causes apart. A loop that does not allocate
 * counts its steps and leaves:
 *
 *     if (!sunder_i_step()) return sunder_i_no_memory(err);
 *
 * A bool that is false for "memory is out" stands for all three causes: out of memory, stopped, too many to be numbered
 * (sunder_i_too_many).
 *
 * All of this is state of the thread: only the watches themselves are shared, since the threads of sunder_i_parallel()
 * inherit them from the thread that starts them. */
#ifndef SUNDER_I_WATCH_H
#define SUNDER_I_WATCH_H

#include "sunder.h"

#include <pthread.h>
#include <stdatomic.h>

/* Steps between two questions: some microseconds each, so that a stop is noticed within a millisecond or so. */
#define SUNDER_I_STEPS 256

typedef struct sunder_i_watch {
    sunder_progress progress; /* called by one thread at a time, which has the lock ... */
    bool (*go_on)(void *);    /* ... or this one */
    void *user;
    pthread_mutex_t lock;
    double fraction; /* the last value told */
    atomic_bool stopped;
    struct sunder_i_watch *outer;
} sunder_i_watch;

/* Adds *progress (NULL: nothing) to what the thread asks, until sunder_i_watch_end(), which every path must reach.
 * *progress is replaced by a function that reports to the watch and may be called by any thread. */
void sunder_i_watch_begin(sunder_i_watch *watch, sunder_progress *progress, void **user);
void sunder_i_watch_end(sunder_i_watch *watch);

/* The watch of the calling thread, and its handing over to a thread that works for it. */
sunder_i_watch *sunder_i_watch_here(void);
void sunder_i_watch_join(sunder_i_watch *watch);

typedef struct sunder_i_thread {
    int32_t left; /* steps until the next question */
    bool too_many;
    sunder_i_watch *watch; /* the innermost; NULL: no watch */
    sunder_i_watch own;    /* of sunder_watch(), the outermost */
} sunder_i_thread;

extern _Thread_local sunder_i_thread sunder_i_this_thread
    __attribute__((tls_model("initial-exec"), visibility("hidden")));

/* Asks; false if the work is to stop. */
bool sunder_i_look(void);
/* Was the thread told to stop? The watches are not asked again. */
bool sunder_i_stopped(void);

/* One step more; false if the work is to stop. */
static inline bool sunder_i_step(void) { return --sunder_i_this_thread.left >= 0 || sunder_i_look(); }

/* Counts the steps of a loop of n items that cannot stop. */
static inline bool sunder_i_steps(size_t n)
{
    if (n >= (size_t)INT32_MAX / 2 || (sunder_i_this_thread.left -= (int32_t)n) < 0) return sunder_i_look();
    return true;
}

/* Records, for sunder_i_no_memory(), that a count cannot be represented. Always false. */
bool sunder_i_too_many(void);
/* Was it recorded? Clears the record. */
bool sunder_i_was_too_many(void);

#endif
