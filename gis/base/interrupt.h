/* interrupt.h: SIGINT, SIGTERM, SIGHUP, and the limits of the process: SIGXFSZ and SIGXCPU.
 *
 * The first one asks the run to end: all work looks whether one has come, fails, and clears away what it has begun.
 * What does not look (a driver in the midst of a file) is given a second; then the process ends from within a signal
 * handler, with the same message, the same exit status, and nothing left behind. A second signal does that at once, and
 * ends the process as signals do; but a limit is met again and again, and ends the run once.
 *
 * For this the handler knows what lies about half done (leftovers): it takes it away, or puts it back. It runs on the
 * main thread alone, and not in the midst of a step (gis_hold), so that it always finds things in order; all that it
 * calls may be called in a signal handler (POSIX.1-2017, System Interfaces, 2.4.3). Leftovers and steps are the main
 * thread's business; the questions are anybody's. */
#ifndef GIS_INTERRUPT_H
#define GIS_INTERRUPT_H

#include "base/gis_error.h"

/* Signals are caught from here on, by the thread that calls this: the main thread. */
void gis_catch_signals(void);
/* Has a signal come, and can the run still end as if nothing had been done? */
bool gis_interrupted(void);
/* The sentence about it: GIS_INTERRUPTED, and which limit was met, if it was one. */
const char *gis_interruption(void);
/* The other way round: false, and the error says GIS_INTERRUPTED, if a signal has come. */
bool gis_go_on(gis_error *error);
/* The library's work in this thread heeds the signals, too (the thread that catches them does already). */
void gis_watch(void);

/* Signals wait from here to gis_release(). These nest. What is between them must not wait for anything. */
void gis_hold(void);
void gis_release(void);

/* Whether the output will be the new one is being decided (a commit is under way, which a second signal may meet), or
 * is decided: from here on a first signal ends nothing any more. */
typedef enum gis_outcome { GIS_OPEN, GIS_DECIDING, GIS_DECIDED } gis_outcome;
void gis_set_outcome(gis_outcome now);
/* The last look: false if a signal has come; else the outcome is being decided. */
bool gis_decide(gis_error *error);

/* A file that lies about half done, as the handler knows it. */
typedef struct gis_leftover gis_leftover;

/* Registers a file, or a directory with its contents, for the handler to remove. */
gis_leftover *gis_leftover_temporary(const char *path);
/* A file that the handler removes before outcome_then: a new output until the outcome is decided, a journal until it is
 * being decided. */
gis_leftover *gis_leftover_until(gis_outcome outcome_then, const char *path);
/* A former file, kept until the outcome is decided. An interruption before that moves it back to `back_to`;
 * afterwards it is removed. */
gis_leftover *gis_leftover_former(const char *path, const char *back_to);
/* The file is gone, or in its place: the handler leaves it alone. NULL is fine. */
void gis_leftover_forget(gis_leftover *leftover);

/* The line that is said where the run is ended by force: on stderr, and in a log that is open (-1: none). The text is
 * kept by the caller. */
void gis_set_last_words(const char *words, int log);
/* A failure has been told, and is the run's exit status: ending it by force says nothing more. */
void gis_failure_told(int exit_status);

#endif
