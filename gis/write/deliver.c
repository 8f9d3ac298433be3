/* deliver.c: see deliver.h. */
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

const char *gis_stats_path(const gis_options *options)
{
    return options->given[OPT_STATS] ? options->text[OPT_STATS] : NULL;
}

/* A file that an operand or an option is read from, or that holds it: the file of @FILE, the archive of a member. */
static bool reads(const char *operand, const char *file)
{
    return operand && gis_path_lies_in(operand + (operand[0] == '@'), file);
}

/* Texts in files are no datasets, which the sink looks after. */
static bool check_texts(const gis_options *options, gis_error *error)
{
    static const gis_option_id shapes[] = {OPT_SHAPE, OPT_ROBOT, OPT_SYMBOL};
    size_t output = options->command->most - 1;
    const char *path = options->n_operands > output ? options->operand[output] : NULL;
    bool read = false;
    for (size_t i = 0; path && i < output; i++)
        read = read || (options->operand[i][0] == '@' && reads(options->operand[i], path));
    for (size_t i = 0; path && i < sizeof shapes / sizeof *shapes; i++)
        read = read || (options->given[shapes[i]] && options->text[shapes[i]][0] == '@' &&
                        reads(options->text[shapes[i]], path));
    return !read || gis_fail(error, "%s is an input; give another output", path);
}

bool gis_stats_check(const gis_options *options, gis_error *error)
{
    const char *path = gis_stats_path(options);
    struct stat info;
    if (!check_texts(options, error))
        return false;
    if (!path || strcmp(path, "-") == 0)
        return true;
    for (size_t i = 0; i < options->n_operands; i++)
        if (reads(options->operand[i], path))
            return gis_fail_usage(error, "--stats %s: that is %s; give another file", path,
                                  i + 1 == options->command->most ? "the output" : "an input");
    bool there = stat(path, &info) == 0;
    if (!there && lstat(path, &info) == 0)
        return gis_fail(error, "--stats: %s is a link that leads nowhere", path);
    if (there && S_ISDIR(info.st_mode))
        return gis_fail(error, "--stats: %s is a directory", path);
    if (there && access(path, W_OK) != 0)
        return gis_fail(error, "--stats: cannot write %s: %s", path, strerror(errno));
    char directory[4096];
    const char *slash = strrchr(path, '/');
    snprintf(directory, sizeof directory, "%.*s", slash ? (int)(slash - path + 1) : 1, slash ? path : ".");
    if ((!there || S_ISREG(info.st_mode)) && access(directory, W_OK) != 0)
        return gis_fail(error, "--stats: cannot write to %s: %s", directory, strerror(errno));
    return true;
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

bool gis_print_json(const void *json, gis_error *error)
{
    const gis_json *text = json;
    return fwrite(gis_json_text(text), 1, text->length, stdout) == text->length ||
           gis_fail(error, "cannot write to standard output: %s", strerror(errno));
}

static bool flush_stdout(gis_error *error)
{
    if (fflush(stdout) == 0 && !ferror(stdout))
        return true;
    return gis_fail(error, "cannot write to standard output: %s", strerror(errno));
}

bool gis_deliver(const gis_delivery *delivery, gis_error *error)
{
    static const char *const what = "--stats";
    const char *path = gis_stats_path(delivery->options);
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
