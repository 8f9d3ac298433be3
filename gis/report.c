/* report.c: see report.h. */
#include "report.h"

#include "message.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

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

static void count(gis_json *out, const char *key, uint64_t value)
{
    gis_json_key(out, key);
    gis_json_size(out, value);
}

void gis_json_seconds(gis_json *out, const char *key, double seconds)
{
    gis_json_key(out, key);
    gis_json_double(out, round(seconds * 1e9) / 1e9);
}

void gis_json_operations(gis_json *out, const sunder_operations *operations)
{
    count(out, "comparisons", operations->comparisons);
    count(out, "orientation_tests", operations->orientation_tests);
    count(out, "segment_intersections", operations->segment_intersections);
    count(out, "exact_fallbacks", operations->exact_fallbacks);
}

void gis_json_conflict_counts(gis_json *out, const sunder_conflict_counts *counts)
{
    gis_json_open(out, '{');
    count(out, "overlap", counts->overlap);
    count(out, "too_close", counts->too_close);
    count(out, "barrier", counts->barrier);
    count(out, "contained", counts->contained);
    count(out, "duplicate", counts->duplicate);
    count(out, "inside_blocks", counts->inside_blocks);
    gis_json_close(out, '}');
}

const char *gis_stats_path(const gis_options *options)
{
    return options->given[OPT_STATS] ? options->text[OPT_STATS] : NULL;
}

bool gis_stats_check(const gis_options *options, gis_error *error)
{
    const char *path = gis_stats_path(options);
    struct stat info;
    if (!path || strcmp(path, "-") == 0)
        return true;
    if (stat(path, &info) == 0 && S_ISDIR(info.st_mode))
        return gis_fail(error, "--stats: %s is a directory", path);
    char directory[4096];
    const char *slash = strrchr(path, '/');
    snprintf(directory, sizeof directory, "%.*s", slash ? (int)(slash - path + 1) : 1, slash ? path : ".");
    if (access(directory, W_OK) != 0)
        return gis_fail(error, "--stats: cannot write to %s: %s", directory, strerror(errno));
    return true;
}

bool gis_any_conflict(const sunder_conflict_counts *counts)
{
    return counts->overlap || counts->too_close || counts->barrier || counts->contained || counts->duplicate;
}

bool gis_stdout_taken(const gis_options *options, const char *output, bool *taken, gis_error *error)
{
    bool by_stats = options->given[OPT_STATS] && strcmp(options->text[OPT_STATS], "-") == 0;
    bool by_layer = output && strncmp(output, "/vsistdout", 10) == 0;
    if (by_stats && by_layer)
        return gis_fail_usage(error, "--stats - and the output /vsistdout/ cannot share standard output");
    *taken = by_stats || by_layer;
    return true;
}

/* The one variable of the program that is not handed from function to function: a signal has no other way in. */
static volatile sig_atomic_t interrupted;

static void note_signal(int number)
{
    (void)number;
    interrupted = 1;
}

void gis_catch_signals(void)
{
    struct sigaction action = {.sa_handler = note_signal, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

bool gis_interrupted(void)
{
    return interrupted != 0;
}

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

gis_sink_request gis_options_sink(const gis_options *options, const char *path, const char *main_layer)
{
    return (gis_sink_request){
        .path = path,
        .format = options->text[OPT_OF],
        .layer_options = options->list[OPT_LCO],
        .dataset_options = options->list[OPT_CO],
        .main_layer = options->given[OPT_OUTPUT_LAYER] ? options->text[OPT_OUTPUT_LAYER] : main_layer,
        .overwrite = options->given[OPT_OVERWRITE],
        .update = options->given[OPT_UPDATE],
        .overwrite_layer = options->given[OPT_OVERWRITE_LAYER],
        .strict = options->given[OPT_STRICT],
        .allow_inexact = options->given[OPT_ALLOW_INEXACT_OUTPUT],
        .no_styles = options->given[OPT_NO_STYLES],
    };
}

bool gis_output_finish(gis_sink *sink, gis_sink_result *result, gis_error *error)
{
    bool ok = gis_sink_commit(sink, result, error);
    if (ok) {
        gis_say_warnings(gis_sink_warnings(sink));
        gis_say_warnings(gis_sink_losses(sink));
    }
    return ok;
}
