/* gdal_reports.c: GDAL's errors and warnings, which are collected instead of printed. See gis_error.h. */
#include "base/gis_error.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <stdio.h>

/* A driver may repeat a warning for each feature; at most this number of different warnings is kept. */
enum { WARNINGS_KEPT = 100 };

static void CPL_STDCALL hear_message(CPLErr class, CPLErrorNum number, const char *text)
{
    (void)number;
    gis_listener *listener = CPLGetErrorHandlerUserData();
    if (class == CE_Warning) {
        if (listener->warnings.n < WARNINGS_KEPT) gis_sentences_add(&listener->warnings, "%s", text);
    } else if (class >= CE_Failure) {
        if (listener->failures++ == 0) {
            snprintf(listener->first, sizeof listener->first, "%s", text);
            gis_make_one_line(listener->first);
        }
    }
}

void gis_listen_begin(gis_listener *listener) { CPLPushErrorHandlerEx(hear_message, listener); }

void gis_listen_end(void) { CPLPopErrorHandler(); }

void gis_listener_clear(gis_listener *listener)
{
    gis_sentences_clear(&listener->warnings);
    *listener = (gis_listener){0};
}

const char *gis_listener_reason(const gis_listener *listener, const char *otherwise)
{
    return listener->first[0] ? listener->first : otherwise;
}
