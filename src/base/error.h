/* error.h: functions that store an error in the caller's struct. */
#ifndef SUNDER_I_ERROR_H
#define SUNDER_I_ERROR_H

#include "sunder_base.h"

/* Stores the error in *err, if err is not NULL, and returns status, so that a function can end with `return
 * sunder_i_fail(...)`. */
sunder_status sunder_i_fail(sunder_error *err, sunder_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* The same, with the position of the error. */
sunder_status sunder_i_fail_at(sunder_error *err, sunder_status status, size_t polygon, size_t ring, size_t vertex,
                               const char *format, ...) __attribute__((format(printf, 6, 7)));
/* Stores and returns SUNDER_ECANCEL: a progress function asked to stop. */
sunder_status sunder_i_cancelled(sunder_error *err);
/* Stores and returns the error of work that was refused memory or cut short: SUNDER_ENOMEM or, if the watch (watch.h)
 * is the cause, SUNDER_ECANCEL or SUNDER_ESIZE. */
sunder_status sunder_i_failure_cause(sunder_error *err);

#endif
