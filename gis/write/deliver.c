/* deliver.c: see deliver.h. Steps that can fail come first and steps that cannot be undone come last, so that after a
 * failure at any step all files are as they were before the run. */
#include "write/deliver.h"

#include "base/interrupt.h"
#include "base/message.h"
#include "base/path.h"
#include "base/trust.h"
#include "read/source_files.h"

#include <cpl_conv.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define N_OF(array) (sizeof(array) / sizeof *(array))

/* Does `operand` (an operand, or the value of an option) name `file`, or a file within it? "@FILE" names FILE, and the
 * path of an archive's member (/vsizip/...) counts as the archive. */
static bool operand_names(const char *operand, const char *file)
{
    return operand && gis_path_lies_in(operand + (operand[0] == '@'), file);
}

static bool text_operand_names(const char *operand, const char *file)
{
    return operand && operand[0] == '@' && operand_names(operand, file);
}

/* Refuses an output that is also a text file given as @FILE. Datasets that are inputs are compared with the output by
 * the sink. */
static bool check_texts(const gis_destinations *to, gis_error *error)
{
    bool read = false;
    for (size_t i = 0; to->output && i < N_OF(to->input); i++)
        read = read || text_operand_names(to->input[i], to->output);
    for (size_t i = 0; to->output && i < N_OF(to->shape); i++)
        read = read || text_operand_names(to->shape[i], to->output);
    read = read || (to->output && operand_names(to->sheet, to->output));
    return !read || gis_fail(error, "%s is an input; give another output", to->output);
}

/* Can the file `path` that `option` names be created or overwritten, and is it neither an input nor the output? */
static bool check_file(const gis_destinations *to, const char *option, const char *path, gis_error *error)
{
    struct stat info;
    for (size_t i = 0; i < N_OF(to->input); i++)
        if (operand_names(to->input[i], path))
            return gis_fail_usage(error, "%s %s: that is an input; give another file", option, path);
    for (size_t i = 0; i < N_OF(to->shape); i++)
        if (text_operand_names(to->shape[i], path))
            return gis_fail_usage(error, "%s %s: that is an input; give another file", option, path);
    if (operand_names(to->sheet, path))
        return gis_fail_usage(error, "%s %s: that is an input; give another file", option, path);
    if (operand_names(to->output, path))
        return gis_fail_usage(error, "%s %s: that is the output; give another file", option, path);
    if (!gis_link_may_be_followed(path, option, error)) return false;
    bool there = stat(path, &info) == 0;
    if (!there && lstat(path, &info) == 0) return gis_fail(error, "%s: %s is a broken link", option, path);
    if (there && S_ISDIR(info.st_mode)) return gis_fail(error, "%s: %s is a directory", option, path);
    if (there && access(path, W_OK) != 0)
        return gis_fail(error, "%s: cannot write %s: %s", option, path, strerror(errno));
    if (there && !S_ISREG(info.st_mode)) return true;
    char *directory = gis_path_directory(path);
    const char *of = *directory ? directory : ".";
    const bool may =
        access(of, W_OK) == 0 || gis_fail(error, "%s: cannot write to %s: %s", option, of, strerror(errno));
    CPLFree(directory);
    return may;
}

static bool is_stdout(const char *path) { return path && strcmp(path, "-") == 0; }

/* One file that is written beside the output. OF_REPORT ... OF_STATS are in the order in which the files are
 * written. */
typedef struct file_of {
    const char *option, *path; /* NULL: this file is not requested */
} file_of;

enum { OF_REPORT, OF_PROOF, OF_TRACE, OF_STATS, N_FILES };

static void list_files(const gis_destinations *to, file_of files[N_FILES])
{
    files[OF_REPORT] = (file_of){"--report", to->report};
    files[OF_PROOF] = (file_of){"--proof", to->proof};
    files[OF_TRACE] = (file_of){"--trace", to->trace};
    files[OF_STATS] = (file_of){"--stats", is_stdout(to->stats) ? NULL : to->stats};
}

static bool check_files(const gis_destinations *to, gis_error *error)
{
    file_of files[N_FILES];
    list_files(to, files);
    if (is_stdout(to->report))
        return gis_fail_usage(error, "--report -: the page goes to a file; give its name, as in --report out.html");
    if (is_stdout(to->proof))
        return gis_fail_usage(error, "--proof -: the proof goes to a file; give its name, as in --proof out.jsonl");
    if (is_stdout(to->trace))
        return gis_fail_usage(error, "--trace -: the trace goes to a file; give its name, as in --trace out.jsonl");
    for (size_t i = 0; i < N_FILES; i++)
        for (size_t k = i + 1; k < N_FILES; k++)
            if (files[i].path && files[k].path && gis_path_lies_in(files[i].path, files[k].path))
                return gis_fail_usage(error, "%s %s: that is the file of %s; give another", files[i].option,
                                      files[i].path, files[k].option);
    for (size_t i = N_FILES; i-- > 0;)
        if (files[i].path && !check_file(to, files[i].option, files[i].path, error)) return false;
    return true;
}

bool gis_destinations_check(const gis_destinations *to, bool *stdout_taken, gis_error *error)
{
    static const char layer[] = "/vsistdout";
    bool by_stats = is_stdout(to->stats);
    bool by_layer = to->output && strncmp(to->output, layer, sizeof layer - 1) == 0;
    if (by_stats && by_layer)
        return gis_fail_usage(error, "--stats - and the output /vsistdout/ cannot share standard output");
    *stdout_taken = by_stats || by_layer;
    return check_texts(to, error) && check_files(to, error);
}

bool gis_destinations_spare(const gis_destinations *to, const gis_source *source, gis_error *error)
{
    file_of files[N_FILES];
    list_files(to, files);
    for (size_t i = N_FILES; i-- > 0;)
        if (files[i].path && gis_source_lies_in(source, files[i].path))
            return gis_fail_usage(error, "%s %s: that is a part of the input; give another file", files[i].option,
                                  files[i].path);
    return true;
}

bool gis_print_json(const void *json, gis_error *error)
{
    const gis_text *text = &((const gis_json *)json)->text;
    return fwrite(gis_text_get(text), 1, text->length, stdout) == text->length ||
           gis_fail(error, "cannot write to standard output: %s", strerror(errno));
}

static bool flush_stdout(gis_error *error)
{
    if (fflush(stdout) == 0 && !ferror(stdout)) return true;
    return gis_fail(error, "cannot write to standard output: %s", strerror(errno));
}

static bool write_text(const void *of, FILE *to, gis_error *error)
{
    const gis_text *text = of;
    const char *bytes = gis_text_get(text);
    return bytes ? fwrite(bytes, 1, text->length, to) == text->length : gis_no_memory(error);
}

static bool write_files(const gis_delivery *delivery, const file_of files[N_FILES], gis_text_file written[N_FILES],
                        gis_error *error)
{
    const gis_text *texts[N_FILES] = {[OF_REPORT] = delivery->report,
                                      [OF_TRACE] = delivery->trace,
                                      [OF_STATS] = delivery->stats ? &delivery->stats->text : NULL};
    for (size_t i = 0; i < N_FILES; i++) {
        const bool runs = i == OF_PROOF;
        if (files[i].path && !gis_text_file_write(&written[i], files[i].path, runs ? delivery->proof : write_text,
                                                  runs ? delivery->run : texts[i], files[i].option, error))
            return false;
    }
    if (!is_stdout(delivery->to->stats)) return true;
    return gis_json_text(delivery->stats) ? gis_print_json(delivery->stats, error) : gis_no_memory(error);
}

bool gis_deliver(const gis_delivery *delivery, gis_error *error)
{
    gis_text_file written[N_FILES] = {0};
    file_of files[N_FILES];
    list_files(delivery->to, files);
    bool ok = gis_go_on(error) && write_files(delivery, files, written, error) &&
              (!delivery->print || delivery->print(delivery->run, error)) && flush_stdout(error);
    for (size_t i = N_FILES; ok && i-- > 0;) ok = gis_text_file_place(&written[i], files[i].option, error);
    ok = ok && (!delivery->sink || gis_sink_publish(delivery->sink, error));
    for (size_t i = N_FILES; i-- > 0;) gis_text_file_end(&written[i], ok);
    if (ok && delivery->sink) {
        gis_say_warnings(GIS_MESSAGE_OUTPUT, gis_sink_warnings(delivery->sink));
        gis_say_warnings(GIS_MESSAGE_LOSS, gis_sink_losses(delivery->sink));
    }
    return ok;
}
