/* main.c: finds the command, parses its options, and runs it. */
#include "base/interrupt.h"
#include "base/message.h"
#include "base/resources.h"
#include "base/spelling.h"
#include "commands/commands.h"
#include "commands/config.h"
#include "commands/resolve.h"
#include "sheet/sheet.h"
#include "sunder.h"

#include <cpl_error.h>
#include <errno.h>
#include <fcntl.h>
#include <gdal.h>
#include <ogr_api.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

const gis_command gis_commands[] = {
    {GIS_SEPARATE, "separate", "INPUT OUTPUT", 2, 2, "Moves features apart by the least amount",
     "--gap 3m --max-shift 10m houses.gpkg separated.gpkg", gis_command_separate},
    {GIS_CHECK, "check", "INPUT [OUTPUT]", 1, 2, "Lists overlaps and gap violations, exactly", "--gap 3m houses.gpkg",
     gis_command_check},
    {GIS_SUM, "sum", "P Q [OUTPUT]", 2, 3, "Minkowski sum P + Q, exactly", "\"POLYGON ((0 0, 4 0, 0 3))\" disc:1",
     gis_command_sum},
    {GIS_PAIR, "pair", "P Q [OUTPUT]", 2, 3, "Least translation of Q that separates its interior from P",
     "square:4 \"POLYGON ((1 1, 5 1, 5 2))\" --gap 0.5", gis_command_pair},
    {GIS_BUFFER, "buffer", "INPUT OUTPUT", 2, 2, "Grows, shrinks, opens or closes features by a shape, exactly",
     "--operation close --shape square:6m --dissolve houses.gpkg blocks.gpkg", gis_command_buffer},
    {GIS_ROUTE, "route", "OBSTACLES [OUTPUT]", 1, 2, "Shortest path of a robot among obstacles; contact is allowed",
     "\"POLYGON ((2 -9, 4 -9, 4 3, 2 3))\" --robot square:2 --from 0,0 --to 6,0", gis_command_route},
    {GIS_PLAN, "plan", "INPUT PLAN", 2, 2, "Cuts a layer into N shards, for many machines; --shards N is required",
     "--gap 3m --shards 16 houses.gpkg houses.plan", gis_command_plan},
    {GIS_MERGE, "merge", "PLAN OUTPUT", 2, 2, "Joins the shards of a plan, and writes what separate writes",
     "houses.plan separated.gpkg", gis_command_merge},
    {GIS_FOLLOW, "follow", "MOVED INPUT OUTPUT", 3, 3, "Takes another layer along with what separate moved",
     "separated.gpkg addresses.gpkg addresses_moved.gpkg", gis_command_follow},
};
const size_t gis_n_commands = sizeof gis_commands / sizeof gis_commands[0];

/* The handler of GDAL's messages, except in functions that install their own. It prints warnings in the form of this
 * program; failures are return values, which the caller reports once. */
static void hear_gdal(CPLErr class, CPLErrorNum number, const char *words)
{
    (void)number;
    if (class == CE_Warning && !gis_interrupted()) gis_say_warning(GIS_MESSAGE_GDAL, "%s", words);
}

static const gis_command *find_command(const char *name)
{
    for (size_t i = 0; i < gis_n_commands; i++)
        if (strcmp(gis_commands[i].name, name) == 0) return &gis_commands[i];
    return NULL;
}

/* Returns whether --messages=json is among the arguments. Errors found before the arguments are completely parsed are
 * then reported as JSON, too. */
static bool wants_json(int argc, char **argv)
{
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++)
        if (strcmp(argv[i], "--messages=json") == 0 ||
            (strcmp(argv[i], "--messages") == 0 && i + 1 < argc && strcmp(argv[i + 1], "json") == 0))
            return true;
    return false;
}

static bool begin_messages(const gis_options *options, gis_error *error)
{
    gis_messages_request request;
    return gis_resolve_messages(options, &request, error) && gis_messages_begin(&request, error);
}

static int run_command(const gis_command *command, int argc, char **argv)
{
    gis_options options;
    gis_sheet sheet = {0};
    gis_error error;
    int status;
    if (!gis_options_parse(command, argc, argv, &options, &error)) {
        status = gis_say_failure(&error);
    } else if (options.given[OPT_HELP]) {
        gis_help_command(command);
        status = GIS_DONE;
    } else if (!gis_sheet_apply(&options, &sheet, &error)) {
        status = gis_say_failure(&error);
    } else if (options.given[OPT_PRINT_SPEC]) {
        gis_sheet_print(&sheet);
        status = GIS_DONE;
    } else if (!begin_messages(&options, &error)) {
        status = gis_say_failure(&error);
    } else {
        gis_configure(&options);
        GDALAllRegister();
        gis_catch_signals();
        status = command->run(&options);
        GDALDestroy();
    }
    gis_options_clear(&options);
    gis_sheet_clear(&sheet);
    return status;
}

/* Closes stdout and returns the exit status; a write error, such as a full disk, may be found only when the last bytes
 * are written. */
static int close_stdout(int status)
{
    bool failed = ferror(stdout) != 0;
    if ((fclose(stdout) != 0 || failed) && (status == GIS_DONE || status == GIS_UNRESOLVED)) {
        gis_error error;
        gis_fail(&error, "cannot write to standard output: %s", strerror(errno));
        return gis_say_failure(&error);
    }
    return status;
}

static int close_log(int status)
{
    gis_error error;
    return gis_messages_end(&error) ? status : gis_say_failure(&error);
}

static int unknown_command(const char *word)
{
    gis_error error;
    gis_spelling search = gis_spelling_of(word, strlen(word));
    for (size_t i = 0; i < gis_n_commands; i++)
        gis_spelling_offer(&search, gis_commands[i].name, strlen(gis_commands[i].name));
    if (search.best)
        gis_fail_usage(&error, "unknown command %s; did you mean %s? `sunder --help` lists the commands", word,
                       search.best);
    else
        gis_fail_usage(&error, "unknown %s %s; `sunder --help` lists the commands", *word == '-' ? "option" : "command",
                       word);
    return gis_say_failure(&error);
}

static int no_command(void)
{
    char names[256] = "";
    size_t n = 0;
    for (size_t i = 0; i < gis_n_commands; i++) {
        const char *joint = i == 0 ? "" : i + 1 < gis_n_commands ? ", " : " or ";
        n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", joint, gis_commands[i].name);
    }
    gis_error error;
    gis_fail_usage(&error, "a command is missing: %s; `sunder --help` describes them", names);
    return gis_say_failure(&error);
}

/* Opens /dev/null for each closed standard stream, in a mode in which its use fails. Else the next file to be opened,
 * such as a log or an output, would get the number of the stream, and messages would be written to that file. */
static void hold_standard_streams(void)
{
    for (int number = STDIN_FILENO; number <= STDERR_FILENO; number++)
        if (fcntl(number, F_GETFD) < 0) (void)!open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

int main(int argc, char **argv)
{
    gis_memory_begin();
    hold_standard_streams();
    gis_error none;
    CPLSetErrorHandler(hear_gdal);
    gis_messages_begin(&(gis_messages_request){.json = wants_json(argc, argv)}, &none);
    int status = GIS_DONE;
    const char *first = argc > 1 ? argv[1] : NULL;
    const gis_command *command = first ? find_command(first) : NULL;
    if (command) {
        status = run_command(command, argc - 2, argv + 2);
    } else if (!first) {
        status = no_command();
    } else if (strcmp(first, "--version") == 0) {
        printf("sunder %s\nGDAL %s\nGMP %s\n", sunder_version(), GDALVersionInfo("RELEASE_NAME"), sunder_gmp_version());
    } else if (strcmp(first, "--options-json") == 0) {
        gis_error error;
        status = gis_options_json(&error) ? GIS_DONE : gis_say_failure(&error);
    } else if (strcmp(first, "--spec-schema") == 0) {
        gis_error error;
        status = gis_sheet_print_schema(&error) ? GIS_DONE : gis_say_failure(&error);
    } else if (strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0) {
        gis_help_program();
    } else {
        status = unknown_command(first);
    }
    return close_log(close_stdout(status));
}
