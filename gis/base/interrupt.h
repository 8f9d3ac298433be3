/* interrupt.h: handles SIGINT, SIGTERM, SIGHUP, and the limits of the process (SIGXFSZ, SIGXCPU).
 *
 * The first signal asks the run to end: all work polls for it, fails, and removes what it has begun. Work that does not
 * poll (a driver writing a file) gets a second; then the signal handler ends the process, with the same message, the
 * same exit status, and nothing left behind. A second signal does that at once, and ends the process as signals do; but
 * the signal of a limit is repeated, and counts once.
 *
 * For this the handler has a list of unfinished files (leftovers), which it removes or moves back. It runs on the main
 * thread only, and not between gis_hold() and gis_release(), so the list is always consistent; all functions that it
 * calls are allowed in a signal handler (POSIX.1-2017, System Interfaces, 2.4.3). Only the main thread may change
 * leftovers and hold signals; any thread may poll. */
#ifndef GIS_INTERRUPT_H
#define GIS_INTERRUPT_H

#include "base/gis_error.h"

/* Begins to catch signals; called by the main thread. */
void gis_catch_signals(void);
/* Has a signal arrived, and can the run still end as if nothing had been done? */
bool gis_interrupted(void);
/* The message about the signal: GIS_INTERRUPTED, followed by the limit if one was reached. */
const char *gis_interruption(void);
/* False, with the error GIS_INTERRUPTED, if a signal has arrived. */
bool gis_go_on(gis_error *error);
/* Makes the library's work in this thread poll for signals (for the main thread gis_catch_signals() does that). */
void gis_watch(void);

/* Delays signals until gis_release(). Calls nest. Nothing between the two may block. */
void gis_hold(void);
void gis_release(void);

/* GIS_OPEN: a signal leaves the old output. GIS_DECIDING: the new output is being put in place (such as a commit).
 * GIS_DECIDED: the new output is in place, and a signal no longer ends the run. */
typedef enum gis_outcome { GIS_OPEN, GIS_DECIDING, GIS_DECIDED } gis_outcome;
void gis_set_outcome(gis_outcome now);
/* To be called before the new output is put in place: false if a signal has arrived; otherwise the outcome becomes
 * GIS_DECIDING. */
bool gis_decide(gis_error *error);

/* An unfinished file that the signal handler knows. */
typedef struct gis_leftover gis_leftover;

/* Registers a temporary file, or a directory with its contents, for the handler to remove. */
gis_leftover *gis_leftover_temporary(const char *path);
/* Registers a file that the handler removes until outcome_then is reached: a new output until GIS_DECIDED, a journal
 * until GIS_DECIDING. */
gis_leftover *gis_leftover_until(gis_outcome outcome_then, const char *path);
/* Registers the old version of a file, which was renamed to `path`: the handler moves it back to `back_to` before
 * GIS_DECIDED, and removes it afterwards. */
gis_leftover *gis_leftover_former(const char *path, const char *back_to);
/* Unregisters a file, since it was removed or is in its final place. NULL is allowed. */
void gis_leftover_forget(gis_leftover *leftover);

/* The line that is printed if the handler ends the run: to stderr, and to an open log (-1: none). `words` is
 * borrowed. */
void gis_set_last_words(const char *words, int log);
/* An error was printed and determines the exit status; if the handler ends the run it prints nothing more. */
void gis_failure_told(int exit_status);

#endif
