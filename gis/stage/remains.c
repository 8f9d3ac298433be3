/* remains.c: what a run left that was killed among its renames, and the way back.
 *
 * A stage whose lock can be had belongs to nobody that lives. If it has a record and a new file is still in it, the run
 * did not finish: what stepped aside goes back, what came to a place that was empty is taken away (if it is the very
 * file of the record), and the output is as it was. Each step may be repeated: a run that is killed at this leaves what
 * the next one can finish. If no new file is in it, all were put in place, and only the stage remained. */
#define _GNU_SOURCE
#include "stage/internal.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

typedef struct remains {
    const char *directory; /* of the output */
    char *inside;          /* the stage */
    char *main;            /* the main file of the run that made it; NULL: there is no record */
    char **old, **fresh;   /* names of superseded files; "MARK NAME" of new ones */
} remains;

static void forget(remains *found)
{
    CPLFree(found->inside);
    CPLFree(found->main);
    CSLDestroy(found->old);
    CSLDestroy(found->fresh);
}

static const char *after(const char *line, const char *kind)
{
    return strncmp(line, kind, strlen(kind)) == 0 ? line + strlen(kind) : NULL;
}

static void read_line(remains *found, const char *line)
{
    const char *rest;
    char *name = CPLUnescapeString(line, NULL, CPLES_BackslashQuotable);
    if ((rest = after(name, GIS_RECORD_MAIN))) {
        CPLFree(found->main);
        found->main = CPLStrdup(rest);
    } else if ((rest = after(name, GIS_RECORD_OLD))) {
        found->old = CSLAddString(found->old, rest);
    } else if ((rest = after(name, GIS_RECORD_NEW))) {
        found->fresh = CSLAddString(found->fresh, rest);
    }
    CPLFree(name);
}

/* A record that was not written to its end was not acted upon, and does as little harm. */
static void read_record(remains *found)
{
    char *path = gis_join(found->inside, GIS_STAGE_RECORD), *line = NULL;
    FILE *file = fopen(path, "r");
    size_t size = 0;
    for (ssize_t n; file && (n = getline(&line, &size, file)) > 0;)
        if (line[n - 1] == '\n') {
            line[n - 1] = '\0';
            read_line(found, line);
        }
    free(line);
    if (file) fclose(file);
    CPLFree(path);
}

static bool is_in(const char *directory, const char *name)
{
    char *path = gis_join(directory, name);
    bool there = gis_there(path);
    CPLFree(path);
    return there;
}

static const char *fresh_name(const char *entry)
{
    const char *blank = strchr(entry, ' ');
    return blank ? blank + 1 : entry;
}

static bool unfinished(const remains *found)
{
    for (char **entry = found->fresh; entry && *entry; entry++)
        if (is_in(found->inside, fresh_name(*entry))) return true;
    return false;
}

static bool move(const char *from_directory, const char *to_directory, const char *name, gis_error *error)
{
    char *from = gis_join(from_directory, name), *to = gis_join(to_directory, name);
    bool done = rename(from, to) == 0 ||
                gis_fail(error, "%s cannot be brought back from %s, where a run left it that was killed: %s", to, from,
                         strerror(errno));
    CPLFree(from);
    CPLFree(to);
    return done;
}

static bool take_away(const remains *found, const char *entry, gis_error *error)
{
    const char *name = fresh_name(entry);
    char *path = gis_join(found->directory, name), mark[GIS_MARK_SIZE];
    size_t n = (size_t)(name - entry);
    bool ours = gis_stage_mark(path, mark) && strlen(mark) + 1 == n && strncmp(mark, entry, n - 1) == 0 &&
                !is_in(found->inside, name);
    CPLFree(path);
    return !ours || move(found->directory, found->inside, name, error);
}

static bool bring_back(const remains *found, gis_error *error)
{
    char *aside = gis_join(found->inside, GIS_STAGE_OLD);
    bool done = true;
    for (char **entry = found->fresh; done && entry && *entry; entry++) done = take_away(found, *entry, error);
    for (char **name = found->old; done && name && *name; name++)
        done = !is_in(aside, *name) || move(aside, found->directory, *name, error);
    CPLFree(aside);
    return done;
}

/* The record goes last: until then all of this can be done again. */
static void clear_away(const remains *found)
{
    char **names = VSIReadDir(found->inside);
    for (char **name = names; name && *name; name++) {
        if (strcmp(*name, ".") == 0 || strcmp(*name, "..") == 0 || strcmp(*name, GIS_STAGE_RECORD) == 0) continue;
        char *path = gis_join(found->inside, *name);
        if (unlink(path) != 0) VSIRmdirRecursive(path);
        CPLFree(path);
    }
    CSLDestroy(names);
    VSIRmdirRecursive(found->inside);
}

static bool settle(remains *found, const char *name, gis_sentences *said, gis_error *error)
{
    read_record(found);
    if (!found->main) {
        if (is_in(found->inside, name))
            gis_sentences_add(said, "%s is left of a run that was ended before it changed anything; it can be removed",
                              found->inside);
        return true;
    }
    if (strcmp(found->main, name) != 0) return true;
    bool half = unfinished(found);
    if (half && !bring_back(found, error)) return false;
    clear_away(found);
    if (half)
        gis_sentences_add(said,
                          "%s/%s: an earlier run was killed while it put its files in place; the former ones have "
                          "been brought back",
                          found->directory, name);
    return true;
}

/* A stage in use stays. Where nothing can be locked nobody knows: then the way back is said. */
static bool look_at(remains *found, const char *name, gis_sentences *said, gis_error *error)
{
    int lock = open(found->inside, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    bool done = true;
    if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) == 0) {
        done = settle(found, name, said, error);
    } else if (lock >= 0 && errno != EWOULDBLOCK) {
        read_record(found);
        if (found->main && strcmp(found->main, name) == 0)
            gis_sentences_add(said,
                              "%s is in use, or left of a run that was killed while it put its files in place; the "
                              "former ones are in %s/%s: move them back",
                              found->inside, found->inside, GIS_STAGE_OLD);
    }
    if (lock >= 0) close(lock);
    return done;
}

bool gis_stage_recover(const char *final_path, gis_sentences *said, gis_error *error)
{
    char *directory, *name;
    gis_stage_place_of(final_path, &directory, &name);
    char **entries = VSIReadDir(directory);
    bool done = true;
    for (char **entry = entries; done && entry && *entry; entry++) {
        if (strncmp(*entry, GIS_STAGE_PREFIX, strlen(GIS_STAGE_PREFIX)) != 0) continue;
        remains found = {.directory = directory, .inside = gis_join(directory, *entry)};
        done = look_at(&found, name, said, error);
        forget(&found);
    }
    CSLDestroy(entries);
    CPLFree(directory);
    CPLFree(name);
    return done;
}
