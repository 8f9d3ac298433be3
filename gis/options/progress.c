/* progress.c: see progress.h. */
#include "options/progress.h"

#include "base/interrupt.h"

#include <stdio.h>
#include <sys/resource.h>
#include <time.h>

gis_progress gis_progress_of(const gis_options *options)
{
    gis_progress progress = {GIS_PROGRESS_NONE, 0, 1, -1};
    if (options->given[OPT_PROGRESS] && !options->given[OPT_QUIET])
        progress.kind = options->text[OPT_PROGRESS] ? GIS_PROGRESS_PLAIN : GIS_PROGRESS_BAR;
    return progress;
}

void gis_progress_stage(gis_progress *progress, double from, double to)
{
    progress->from = from;
    progress->to = to;
    gis_progress_call(0, progress);
}

/* The bar is GDAL's: 0...10...20 ... 100 - done. It has a mark each 2.5 percent. */
static void print_bar(gis_progress *progress, double fraction)
{
    int marks = (int)(fraction * 40);
    for (int mark = progress->shown + 1; mark <= marks; mark++) {
        if (mark % 4 == 0)
            fprintf(stderr, "%d", mark / 4 * 10);
        else
            fputc('.', stderr);
        progress->shown = mark;
    }
}

bool gis_progress_call(double fraction, void *user)
{
    gis_progress *progress = user;
    if (progress->kind == GIS_PROGRESS_NONE)
        return !gis_interrupted();
    double inside = fraction < 0 ? 0 : fraction > 1 ? 1 : fraction;
    double whole = progress->from + inside * (progress->to - progress->from);
    if (progress->kind == GIS_PROGRESS_BAR) {
        print_bar(progress, whole);
    } else {
        while (progress->shown < (int)(whole * 100))
            fprintf(stderr, "%d\n", ++progress->shown);
    }
    return !gis_interrupted();
}

void gis_progress_done(gis_progress *progress)
{
    gis_progress_stage(progress, 1, 1);
    if (progress->kind == GIS_PROGRESS_BAR)
        fputs(" - done.\n", stderr);
}

double gis_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

uint64_t gis_peak_rss(void)
{
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0)
        return 0;
#ifdef __APPLE__
    return (uint64_t)usage.ru_maxrss;
#else
    return (uint64_t)usage.ru_maxrss * 1024; /* Linux and the BSDs count in KiB */
#endif
}
