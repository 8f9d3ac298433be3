/* error.c: stores the error of a failed call, with a message for users, in the caller's struct. */
#include "base/error.h"

#include "base/watch.h"

#include <stdarg.h>
#include <stdio.h>

static void fill_error(sunder_error *err, sunder_status status, size_t polygon, size_t ring, size_t vertex,
                       const char *format, va_list args)
{
    err->status = status;
    err->polygon = polygon;
    err->ring = ring;
    err->vertex = vertex;
    vsnprintf(err->message, sizeof err->message, format, args);
}

sunder_status sunder_i_fail(sunder_error *err, sunder_status status, const char *format, ...)
{
    if (err) {
        va_list args;
        va_start(args, format);
        fill_error(err, status, SIZE_MAX, SIZE_MAX, SIZE_MAX, format, args);
        va_end(args);
    }
    return status;
}

sunder_status sunder_i_fail_at(sunder_error *err, sunder_status status, size_t polygon, size_t ring, size_t vertex,
                               const char *format, ...)
{
    if (err) {
        va_list args;
        va_start(args, format);
        fill_error(err, status, polygon, ring, vertex, format, args);
        va_end(args);
    }
    return status;
}

/* Stores an error whose message is the text of its status. Returns the status. */
static sunder_status fail_plainly(sunder_error *err, sunder_status status)
{
    return sunder_i_fail(err, status, "%s", sunder_status_string(status));
}

sunder_status sunder_i_cancelled(sunder_error *err) { return fail_plainly(err, SUNDER_ECANCEL); }

sunder_status sunder_i_failure_cause(sunder_error *err)
{
    const bool too_many = sunder_i_was_too_many();
    return fail_plainly(err, sunder_i_stopped() ? SUNDER_ECANCEL : too_many ? SUNDER_ESIZE : SUNDER_ENOMEM);
}
