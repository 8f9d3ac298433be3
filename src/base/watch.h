/* Watching: may the work go on?
 *
 * Work is counted in steps: an allocation, a node of a search, a side against a side; none takes more than some
 * microseconds. Every SUNDER_I_STEPS of them the thread looks up and asks what watches it: the progress functions of
 * the public calls that it is in, and its own (sunder_watch). Once one of these says stop, no memory is handed out to
 * the thread any more, so that all work unwinds along the ways that it has for memory running out, and
 * sunder_i_no_memory() tells the one from the other. What loops without allocating counts its steps and leaves:
 *
 *     if (!sunder_i_step()) return sunder_i_no_memory(err);
 *
 * A bool that is false for "memory is out" stands for all three: out of memory, stopped, more than can be numbered
 * (sunder_i_too_many).
 *
 * All of it is state of the thread: nothing is shared but the watches themselves, which the threads of
 * sunder_i_parallel() have from the thread that starts them. */
#ifndef SUNDER_I_WATCH_H
#define SUNDER_I_WATCH_H

#include "sunder.h"

#include <pthread.h>
#include <stdatomic.h>

/* Steps from one asking to the next: some microseconds each, so that a stop is heard within a millisecond or so. */
#define SUNDER_I_STEPS 256

typedef struct sunder_i_watch {
    sunder_progress progress; /* called by one thread at a time, which has the lock ... */
    bool (*go_on)(void *);    /* ... or this one */
    void *user;
    pthread_mutex_t lock;
    double fraction; /* told last */
    atomic_bool stopped;
    struct sunder_i_watch *outer;
} sunder_i_watch;

/* From here to the end of the watch, which is to be reached by every way, the thread asks *progress too; NULL: nobody
 * more. What is called instead, by any thread, to tell how far things are is put in its place. */
void sunder_i_watch_begin(sunder_i_watch *watch, sunder_progress *progress, void **user);
void sunder_i_watch_end(sunder_i_watch *watch);

/* The watch of the calling thread, and its handing over to a thread that works for it. */
sunder_i_watch *sunder_i_watch_here(void);
void sunder_i_watch_join(sunder_i_watch *watch);

typedef struct sunder_i_thread {
    int32_t left; /* steps until it looks up */
    bool too_many;
    sunder_i_watch *watch; /* the innermost; NULL: nobody asks it to stop */
    sunder_i_watch own;    /* of sunder_watch(), the outermost */
} sunder_i_thread;

extern _Thread_local sunder_i_thread sunder_i_this_thread
    __attribute__((tls_model("initial-exec"), visibility("hidden")));

/* Asks; false if the work is to stop. */
bool sunder_i_look(void);
/* Was the thread told to stop? Nobody is asked. */
bool sunder_i_stopped(void);

/* One step more; false if the work is to stop. */
static inline bool sunder_i_step(void) { return --sunder_i_this_thread.left >= 0 || sunder_i_look(); }

/* As many steps as a loop of n that cannot stop is worth. */
static inline bool sunder_i_steps(size_t n)
{
    if (n >= (size_t)INT32_MAX / 2 || (sunder_i_this_thread.left -= (int32_t)n) < 0) return sunder_i_look();
    return true;
}

/* Notes, for sunder_i_no_memory(), that something is more than can be numbered. Always false. */
bool sunder_i_too_many(void);
/* Was that so? Forgets it. */
bool sunder_i_was_too_many(void);

#endif
