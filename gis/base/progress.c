/* progress.c: see progress.h. Progress never goes back: a stage begins where the previous one ended, and no value is
 * printed twice. */
#include "base/progress.h"

#include "base/interrupt.h"

#include <stdio.h>

/* GDAL's bar, "0...10...20 ... 100 - done.": a mark for each 2.5 percent, every fourth a number. */
enum { BAR_MARKS = 40, MARKS_A_NUMBER = 4, PERCENT_A_NUMBER = 10 };

/* Does the current line of stderr contain an unfinished bar? */
static bool in_bar;

gis_progress gis_progress_new(gis_progress_kind kind) { return (gis_progress){.kind = kind, .to = 1, .shown = -1}; }

void gis_progress_names(gis_progress *progress, const gis_progress_name *name) { progress->name = name; }

void gis_progress_stage(gis_progress *progress, double from, double to)
{
    progress->from = from;
    progress->to = to;
    gis_progress_call(0, progress);
}

/* Prints the names of the stages that begin before this mark, as in "0...10 solve ...20". */
static void print_names(gis_progress *progress, int mark)
{
    for (; progress->name && progress->name->word && progress->name->from * BAR_MARKS <= mark; progress->name++)
        fprintf(stderr, "%s%s ", mark ? " " : "", progress->name->word);
}

static void print_bar(gis_progress *progress, double fraction)
{
    int marks = (int)(fraction * BAR_MARKS);
    for (int mark = progress->shown + 1; mark <= marks; mark++) {
        print_names(progress, mark);
        if (mark % MARKS_A_NUMBER == 0)
            fprintf(stderr, "%d", mark / MARKS_A_NUMBER * PERCENT_A_NUMBER);
        else
            fputc('.', stderr);
        progress->shown = mark;
        in_bar = true;
    }
}

void gis_progress_break(void)
{
    if (in_bar) fputc('\n', stderr);
    in_bar = false;
}

bool gis_progress_call(double fraction, void *user)
{
    gis_progress *progress = user;
    if (progress->kind == GIS_PROGRESS_NONE) return !gis_interrupted();
    double inside = fraction < 0 ? 0 : fraction > 1 ? 1 : fraction;
    double whole = progress->from + inside * (progress->to - progress->from);
    if (progress->kind == GIS_PROGRESS_BAR) {
        print_bar(progress, whole);
    } else {
        while (progress->shown < (int)(whole * 100)) fprintf(stderr, "%d\n", ++progress->shown);
    }
    return !gis_interrupted();
}

void gis_progress_done(gis_progress *progress)
{
    gis_progress_stage(progress, 1, 1);
    if (progress->kind == GIS_PROGRESS_BAR) fputs(" - done.\n", stderr);
    in_bar = false;
}
