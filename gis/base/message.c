/* message.c: prints messages, one line each. Texts from elsewhere (a driver, a damaged file) may contain line breaks
 * and other control characters; these are replaced, so that a script that reads stderr by lines gets one message per
 * line, and a file cannot control the terminal. */
#include "base/message.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "base/json.h"
#include "base/progress.h"
#include "base/trust.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* At most this number of similar warnings is printed; the rest is counted. */
enum { SAID_OF_A_KIND = 10 };

enum { TEXT_SIZE = 2048 }; /* longer ones are cut */

#define PREFIX "sunder: "
#define INTERRUPTED_WORDS PREFIX "error: " GIS_INTERRUPTED "\n"
#define INTERRUPTED_JSON                                                                                               \
    "{\"level\": \"error\", \"kind\": \"interrupted\", \"layer\": null, \"fid\": null, \"id\": null, \"count\": 1, "   \
    "\"exit_status\": 1, \"message\": \"" GIS_INTERRUPTED "\"}\n"

static const char *const kind_words[GIS_MESSAGE_N] = {
    [GIS_MESSAGE_INVALID] = "invalid",     [GIS_MESSAGE_ARCS] = "arcs",       [GIS_MESSAGE_CRS] = "crs",
    [GIS_MESSAGE_PASSED_BY] = "passed_by", [GIS_MESSAGE_INPUT] = "input",     [GIS_MESSAGE_OUTPUT] = "output",
    [GIS_MESSAGE_LOSS] = "loss",           [GIS_MESSAGE_REMAINS] = "remains", [GIS_MESSAGE_MEMORY] = "memory",
    [GIS_MESSAGE_GDAL] = "gdal",
};

/* The warnings that are counted together: those of one kind about features of one layer, or those of one kind from a
 * list that differ only in numbers. */
typedef struct tally {
    gis_message_kind kind;
    char *alike; /* the layer as messages name it, or the text without its numbers; "": all warnings of the kind */
    char *first; /* text of the first warning that was not printed */
    size_t n;
} tally;

/* The state of all messages. `turn` protects it, since several threads print. */
static struct {
    pthread_mutex_t turn;
    gis_messages_request how;
    FILE *log;
    tally *tallies;
    size_t n_tallies, capacity;
} messages = {.turn = PTHREAD_MUTEX_INITIALIZER};

static _Thread_local struct {
    char name[GIS_WHO_SIZE], layer[GIS_WHO_SIZE], id[GIS_WHO_SIZE];
    bool has_fid, has_id;
    int64_t fid;
    size_t before; /* length of the part of the name up to the layer */
} last;

/* ---- Names of features ------------------------------------------------------------------------------------------- */

/* Copies a text, cut to the buffer. Fast, since names are made for millions of features, and few are printed. */
static void copy_name(char to[GIS_WHO_SIZE], const char *text)
{
    size_t n = strnlen(text, GIS_WHO_SIZE - 1);
    memcpy(to, text, n);
    to[n] = '\0';
}

void gis_name_subject(const gis_subject *subject, char *text, size_t size)
{
    const char *within = subject->within ? subject->within : "", *joint = subject->within ? ", " : "";
    last.before = strlen(within) + strlen(joint) + strlen("layer ") + strlen(subject->layer);
    int n = subject->has_fid
                ? snprintf(text, size, "%s%slayer %s, FID %" PRId64, within, joint, subject->layer, subject->fid)
                : snprintf(text, size, "%s%slayer %s, feature %zu", within, joint, subject->layer, subject->number + 1);
    if (subject->id && n >= 0 && (size_t)n < size) snprintf(text + n, size - (size_t)n, " (id %s)", subject->id);
    copy_name(last.name, text);
    copy_name(last.layer, subject->layer);
    copy_name(last.id, subject->id ? subject->id : "");
    last.has_fid = subject->has_fid;
    last.has_id = subject->id != NULL;
    last.fid = subject->fid;
}

/* Replaces control characters by blanks, in place. */
static void replace_controls(char *text)
{
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 0x7f) *c = ' ';
}

/* Does the text contain the name that gis_name_subject() made last, followed by no further digit or letter (so that FID
 * 12 is not taken for FID 1)? The text was cleansed already. */
static bool names_last(const char *text)
{
    char name[GIS_WHO_SIZE];
    copy_name(name, last.name);
    replace_controls(name);
    const char *at = name[0] ? strstr(text, name) : NULL;
    return at && !isalnum((unsigned char)at[strlen(name)]);
}

/* ---- A line ------------------------------------------------------------------------------------------------------ */

typedef struct line {
    const char *level, *kind, *text;
    size_t count;
    int exit_status; /* exit status of an error; -1: a warning */
} line;

static void print_words(FILE *to, const line *said) { fprintf(to, PREFIX "%s: %s\n", said->level, said->text); }

static void put_subject(gis_json *out, const char *text)
{
    bool named = names_last(text);
    gis_json_put_string(out, "layer", named ? last.layer : NULL);
    gis_json_key(out, "fid");
    if (named && last.has_fid)
        gis_json_signed(out, last.fid);
    else
        gis_json_null(out);
    gis_json_put_string(out, "id", named && last.has_id ? last.id : NULL);
}

/* Prints a line as JSON; as words if memory is out. */
static void print_json(FILE *to, const line *said)
{
    gis_json out = {0};
    gis_json_open(&out, '{');
    gis_json_put_string(&out, "level", said->level);
    gis_json_put_string(&out, "kind", said->kind);
    put_subject(&out, said->text);
    gis_json_put_size(&out, "count", said->count);
    if (said->exit_status >= 0) gis_json_put_size(&out, "exit_status", (uint64_t)said->exit_status);
    gis_json_put_string(&out, "message", said->text);
    gis_json_close(&out, '}');
    const char *json = gis_json_text(&out);
    if (json)
        fprintf(to, "%s\n", json);
    else
        print_words(to, said);
    gis_json_clear(&out);
}

static void print_line(FILE *to, const line *said)
{
    if (messages.how.json)
        print_json(to, said);
    else
        print_words(to, said);
}

static void print_to_stderr(const line *said)
{
    fflush(stdout); /* so that lines are in order if both go to one terminal */
    gis_progress_break();
    print_line(stderr, said);
}

/* ---- Kinds ------------------------------------------------------------------------------------------------------- */

/* Copies the text, with a '#' in place of each number. */
static void without_numbers(const char *text, char *out, size_t size)
{
    size_t n = 0;
    for (const char *c = text; *c && n + 1 < size;) {
        size_t digits = strspn(c, "0123456789");
        out[n++] = digits ? '#' : *c;
        c += digits ? digits : 1;
    }
    out[n] = '\0';
}

static tally *tally_of(gis_message_kind kind, const char *alike)
{
    for (size_t i = 0; i < messages.n_tallies; i++)
        if (messages.tallies[i].kind == kind && strcmp(messages.tallies[i].alike, alike) == 0)
            return &messages.tallies[i];
    if (!gis_array_reserve(&messages.tallies, &messages.capacity, messages.n_tallies + 1, sizeof(tally))) return NULL;
    tally *new = &messages.tallies[messages.n_tallies];
    *new = (tally){.kind = kind, .alike = strdup(alike)};
    if (!new->alike) return NULL;
    messages.n_tallies++;
    return new;
}

/* Prints or counts a warning. If counting fails for lack of memory, it is printed. */
static void say_warning(gis_message_kind kind, const char *alike, char *text)
{
    pthread_mutex_lock(&messages.turn);
    const line said = {"warning", kind_words[kind], text, 1, -1};
    if (messages.log) print_line(messages.log, &said);
    if (!messages.how.quiet) {
        tally *of_kind = tally_of(kind, alike);
        if (!of_kind || of_kind->n++ < SAID_OF_A_KIND)
            print_to_stderr(&said);
        else if (!of_kind->first)
            of_kind->first = strdup(text);
    }
    pthread_mutex_unlock(&messages.turn);
}

static void say_sum(const tally *of_kind)
{
    char text[TEXT_SIZE];
    size_t more = of_kind->n - SAID_OF_A_KIND;
    snprintf(text, sizeof text, "%zu more like these, the first of them: %s (%s)", more,
             of_kind->first ? of_kind->first : "", messages.log ? "all are in the log" : "--log FILE keeps all");
    last.name[0] = '\0';
    print_to_stderr(&(line){"warning", kind_words[of_kind->kind], text, more, -1});
}

static void say_sums(void)
{
    for (size_t i = 0; i < messages.n_tallies; i++) {
        tally *each = &messages.tallies[i];
        if (each->n > SAID_OF_A_KIND && !gis_interrupted()) say_sum(each);
        free(each->alike);
        free(each->first);
    }
    free(messages.tallies);
    messages.tallies = NULL;
    messages.n_tallies = messages.capacity = 0;
}

/* ---- Said by others ---------------------------------------------------------------------------------------------- */

/* If the text names the last subject, copies the subject's name up to its layer; else "". */
static void layer_of(const char *text, char layer[GIS_WHO_SIZE])
{
    layer[0] = '\0';
    if (!names_last(text)) return;
    copy_name(layer, last.name);
    if (last.before < GIS_WHO_SIZE) layer[last.before] = '\0';
}

void gis_say_warning(gis_message_kind kind, const char *format, ...)
{
    char text[TEXT_SIZE], alike[GIS_WHO_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    replace_controls(text);
    layer_of(text, alike);
    say_warning(kind, alike, text);
}

void gis_say_warnings(gis_message_kind kind, const gis_sentences *list)
{
    /* after a signal, errors are about interrupted calls */
    for (size_t i = 0; i < list->n && !gis_interrupted(); i++) {
        char text[TEXT_SIZE], alike[TEXT_SIZE];
        snprintf(text, sizeof text, "%s", list->items[i]);
        replace_controls(text);
        without_numbers(text, alike, sizeof alike);
        say_warning(kind, alike, text);
    }
}

static const char *failure_kind(const gis_error *error)
{
    if (gis_is_interruption(error)) return "interrupted";
    return error->no_memory ? "memory" : error->exit_status == GIS_USAGE ? "usage" : "failed";
}

int gis_say_failure(const gis_error *error)
{
    char text[sizeof error->message];
    gis_failure_told(error->exit_status);
    pthread_mutex_lock(&messages.turn);
    say_sums();
    snprintf(text, sizeof text, "%s", error->message);
    replace_controls(text);
    const line said = {"error", failure_kind(error), text, 1, error->exit_status};
    if (messages.log) print_line(messages.log, &said);
    print_to_stderr(&said);
    pthread_mutex_unlock(&messages.turn);
    return error->exit_status;
}

/* ---- The log ----------------------------------------------------------------------------------------------------- */

static bool begins(const char *text, const char *with) { return strncmp(text, with, strlen(with)) == 0; }

/* May the file be replaced by a log: is it an earlier log, empty, or not a plain file? Any other file may be the user's
 * only copy. */
static bool may_replace(const char *path)
{
    struct stat info;
    char begin[32] = "";
    if (stat(path, &info) != 0 || !S_ISREG(info.st_mode) || info.st_size == 0) return true;
    FILE *file = fopen(path, "r");
    if (!file) return true; /* opening it for writing decides below */
    size_t n = fread(begin, 1, sizeof begin - 1, file);
    begin[n] = '\0';
    fclose(file);
    return begins(begin, PREFIX "warning: ") || begins(begin, PREFIX "error: ") || begins(begin, "{\"level\": ");
}

bool gis_messages_begin(const gis_messages_request *request, gis_error *error)
{
    messages.how = *request;
    gis_set_last_words(request->json ? INTERRUPTED_JSON : INTERRUPTED_WORDS, -1);
    if (!request->log) return true;
    if (!gis_link_may_be_followed(request->log, "--log", error)) return false;
    if (!may_replace(request->log))
        return gis_fail_usage(error, "--log %s: that file exists and is not a log; give another one", request->log);
    messages.log = fopen(request->log, "w");
    if (!messages.log) return gis_fail(error, "--log: cannot write %s: %s", request->log, strerror(errno));
    setvbuf(messages.log, NULL, _IOLBF, 0); /* line by line, so that it can be followed, and is complete if the run is
                                             * killed */
    gis_set_last_words(request->json ? INTERRUPTED_JSON : INTERRUPTED_WORDS, fileno(messages.log));
    return true;
}

bool gis_messages_end(gis_error *error)
{
    pthread_mutex_lock(&messages.turn);
    say_sums();
    FILE *log = messages.log;
    messages.log = NULL;
    gis_set_last_words(messages.how.json ? INTERRUPTED_JSON : INTERRUPTED_WORDS, -1);
    pthread_mutex_unlock(&messages.turn);
    if (!log) return true;
    bool failed = ferror(log) != 0;
    return !((fclose(log) != 0) | failed) || gis_fail(error, "--log: cannot write %s", messages.how.log);
}
