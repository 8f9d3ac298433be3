/* watched_call.h: runs work of the core without the interpreter's lock, while Ctrl-C and a progress callback keep
 * working.
 *
 * The core asks its watch every few milliseconds whether to go on. At most every 50 ms signals are handled, as the
 * interpreter does it, and the callback is called. If either raises, the core stops, and the exception stays set. */
#ifndef GIS_PYTHON_WATCHED_CALL_H
#define GIS_PYTHON_WATCHED_CALL_H

#include "python/extension.h"

/* The work: calls the core, and no function of Python. A progress callback that it gives to the core is
 * gis_py_progress, with `watch` as its user. */
typedef struct gis_py_watch gis_py_watch;
typedef void gis_py_work(void *of, gis_py_watch *watch);

/* Runs work(of). progress is None or a callable that gets a float from 0 to 1. `beside`: a thread of its own does the
 * work, since the core will use threads, whose calls the interpreter does not know; it takes some 50 us. False: an
 * exception is set; the work has ended all the same. */
bool gis_py_run(gis_py_work *work, void *of, PyObject *progress, bool beside);

/* A sunder_progress whose user is the watch. */
bool gis_py_progress(double fraction, void *watch);

#endif
