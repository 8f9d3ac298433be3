/* deliver.c: see deliver.h. What can fail comes first and what cannot be undone last, so that a failure at any step
 * finds everything as it was. */
#include "write/deliver.h"

#include "base/interrupt.h"
#include "base/message.h"
#include "base/text_file.h"
#include "read/source_files.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define N_OF(array) (sizeof(array) / sizeof *(array))

/* A file that an operand or an option is read from, or that holds it: the file of @FILE, the archive of a member. */
static bool reads(const char *operand, const char *file)
{
    return operand && gis_path_lies_in(operand + (operand[0] == '@'), file);
}

static bool reads_text(const char *operand, const char *file)
{
    return operand && operand[0] == '@' && reads(operand, file);
}

/* Texts in files are no datasets, which the sink looks after. */
static bool check_texts(const gis_destinations *to, gis_error *error)
{
    bool read = false;
    for (size_t i = 0; to->output && i < N_OF(to->input); i++) read = read || reads_text(to->input[i], to->output);
    for (size_t i = 0; to->output && i < N_OF(to->shape); i++) read = read || reads_text(to->shape[i], to->output);
    return !read || gis_fail(error, "%s is an input; give another output", to->output);
}

static bool check_stats(const gis_destinations *to, gis_error *error)
{
    const char *path = to->stats;
    struct stat info;
    if (!path || strcmp(path, "-") == 0) return true;
    for (size_t i = 0; i < N_OF(to->input); i++)
        if (reads(to->input[i], path))
            return gis_fail_usage(error, "--stats %s: that is an input; give another file", path);
    if (reads(to->output, path))
        return gis_fail_usage(error, "--stats %s: that is the output; give another file", path);
    bool there = stat(path, &info) == 0;
    if (!there && lstat(path, &info) == 0) return gis_fail(error, "--stats: %s is a link that leads nowhere", path);
    if (there && S_ISDIR(info.st_mode)) return gis_fail(error, "--stats: %s is a directory", path);
    if (there && access(path, W_OK) != 0) return gis_fail(error, "--stats: cannot write %s: %s", path, strerror(errno));
    char directory[4096];
    const char *slash = strrchr(path, '/');
    snprintf(directory, sizeof directory, "%.*s", slash ? (int)(slash - path + 1) : 1, slash ? path : ".");
    if ((!there || S_ISREG(info.st_mode)) && access(directory, W_OK) != 0)
        return gis_fail(error, "--stats: cannot write to %s: %s", directory, strerror(errno));
    return true;
}

bool gis_destinations_check(const gis_destinations *to, bool *stdout_taken, gis_error *error)
{
    static const char layer[] = "/vsistdout";
    bool by_stats = to->stats && strcmp(to->stats, "-") == 0;
    bool by_layer = to->output && strncmp(to->output, layer, sizeof layer - 1) == 0;
    if (by_stats && by_layer)
        return gis_fail_usage(error, "--stats - and the output /vsistdout/ cannot share standard output");
    *stdout_taken = by_stats || by_layer;
    return check_texts(to, error) && check_stats(to, error);
}

bool gis_print_json(const void *json, gis_error *error)
{
    const gis_json *text = json;
    return fwrite(gis_json_text(text), 1, text->length, stdout) == text->length ||
           gis_fail(error, "cannot write to standard output: %s", strerror(errno));
}

static bool flush_stdout(gis_error *error)
{
    if (fflush(stdout) == 0 && !ferror(stdout)) return true;
    return gis_fail(error, "cannot write to standard output: %s", strerror(errno));
}

bool gis_deliver(const gis_delivery *delivery, gis_error *error)
{
    static const char *const what = "--stats";
    const char *path = delivery->stats_path;
    gis_text_file file = {0};
    bool ok = gis_go_on(error) && (!path || gis_json_text(delivery->stats) || gis_no_memory(error));
    if (ok && path && strcmp(path, "-") == 0)
        ok = gis_print_json(delivery->stats, error);
    else if (ok && path)
        ok = gis_text_file_write(&file, path, gis_json_text(delivery->stats), delivery->stats->length, what, error);
    ok = ok && (!delivery->print || delivery->print(delivery->run, error)) && flush_stdout(error) &&
         gis_text_file_place(&file, what, error) && (!delivery->sink || gis_sink_publish(delivery->sink, error));
    gis_text_file_end(&file, ok);
    if (ok && delivery->sink) {
        gis_say_warnings(gis_sink_warnings(delivery->sink));
        gis_say_warnings(gis_sink_losses(delivery->sink));
    }
    return ok;
}
