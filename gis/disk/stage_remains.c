/* stage_remains.c: finds the remains of a run that was killed between renames, and restores the old files.
 *
 * A stage that belongs to the effective user alone (base/trust.h) and whose lock is free was abandoned. Other entries
 * with such a name are not touched: where other users may write, they may contain a forged record. If the stage has a
 * record and a new file is still in it, the run did not finish: files that were moved aside are moved back, new files
 * that were put in place are removed (if they are exactly those of the record), and the output is as before. A file
 * that another run has put there since is not replaced. Each step may be repeated, so a run that is killed here leaves
 * a state that the next one can finish. If no new file is in the stage, all were put in place, and only the stage is
 * removed. An empty stage is removed as well. */
#define _GNU_SOURCE
#include "disk/stage_internal.h"

#include "base/path.h"
#include "base/remove_tree.h"
#include "base/trust.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct remains {
    const char *directory; /* of the output, for messages */
    const char *name;      /* name of the stage */
    int outer, inner;      /* descriptors of the output's directory and of the stage */
    char *main;            /* name of the main file of the run that made the stage; NULL: there is no record */
    char **old, **fresh;   /* names of replaced files; "MARK NAME" of new files */
} remains;

/* ---- The record -------------------------------------------------------------------------------------------------- */

static void forget_record(remains *found)
{
    CPLFree(found->main);
    CSLDestroy(found->old);
    CSLDestroy(found->fresh);
    found->main = NULL;
    found->old = found->fresh = NULL;
}

static const char *text_after(const char *line, const char *kind)
{
    return strncmp(line, kind, strlen(kind)) == 0 ? line + strlen(kind) : NULL;
}

static const char *fresh_name(const char *entry)
{
    const char *blank = strchr(entry, ' ');
    return blank ? blank + 1 : "";
}

/* Reads a line of the record; false if it names anything but an entry of the directory. */
static bool read_line(remains *found, const char *line)
{
    const char *rest;
    bool plain = true;
    char *name = CPLUnescapeString(line, NULL, CPLES_BackslashQuotable);
    if ((rest = text_after(name, GIS_RECORD_MAIN))) {
        plain = gis_is_plain_name(rest);
        CPLFree(found->main);
        found->main = CPLStrdup(rest);
    } else if ((rest = text_after(name, GIS_RECORD_OLD))) {
        plain = gis_is_plain_name(rest);
        found->old = CSLAddString(found->old, rest);
    } else if ((rest = text_after(name, GIS_RECORD_NEW))) {
        plain = gis_is_plain_name(fresh_name(rest));
        found->fresh = CSLAddString(found->fresh, rest);
    }
    CPLFree(name);
    return plain;
}

static FILE *open_record(const remains *found)
{
    const int opened = openat(found->inner, GIS_STAGE_RECORD, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    struct stat status;
    FILE *file = opened >= 0 && fstat(opened, &status) == 0 && S_ISREG(status.st_mode) && gis_is_own(opened)
                     ? fdopen(opened, "r")
                     : NULL;
    if (opened >= 0 && !file) close(opened);
    return file;
}

/* Reads the record. The renames of an incomplete record were not begun, so reading it does no harm. A record that names
 * anything but entries of the directory was not written by this program, and is ignored. */
static void read_record(remains *found)
{
    FILE *file = open_record(found);
    char *line = NULL;
    size_t size = 0;
    bool plain = true;
    for (ssize_t n; file && plain && (n = getline(&line, &size, file)) > 0;)
        if (line[n - 1] == '\n') {
            line[n - 1] = '\0';
            plain = read_line(found, line);
        }
    free(line);
    if (file) fclose(file);
    if (!plain) forget_record(found);
}

/* ---- Restoring --------------------------------------------------------------------------------------------------- */

static bool is_unfinished(const remains *found)
{
    for (char **entry = found->fresh; entry && *entry; entry++)
        if (gis_entry_is_there(found->inner, fresh_name(*entry))) return true;
    return false;
}

static bool move_back(const remains *found, int from, int to, const char *name, gis_error *error)
{
    if (gis_entry_move(from, to, name, false) == 0) return true;
    const char *why =
        errno == EEXIST ? "a file of that name has appeared there since; move one of the two away" : strerror(errno);
    return gis_fail(error, "%s/%s cannot be restored from %s/%s, where a killed run left it: %s", found->directory,
                    name, found->directory, found->name, why);
}

static bool take_away(const remains *found, const char *entry, gis_error *error)
{
    const char *name = fresh_name(entry);
    char mark[GIS_MARK_SIZE];
    const size_t n = (size_t)(name - entry);
    const bool ours = gis_entry_mark(found->outer, name, mark) && strlen(mark) + 1 == n &&
                      strncmp(mark, entry, n - 1) == 0 && !gis_entry_is_there(found->inner, name);
    return !ours || move_back(found, found->outer, found->inner, name, error);
}

static bool bring_back(const remains *found, gis_error *error)
{
    const int aside = openat(found->inner, GIS_STAGE_OLD, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    bool done = true;
    for (char **entry = found->fresh; done && entry && *entry; entry++) done = take_away(found, *entry, error);
    for (char **name = found->old; done && aside >= 0 && name && *name; name++)
        done = !gis_entry_is_there(aside, *name) || move_back(found, aside, found->outer, *name, error);
    if (aside >= 0) close(aside);
    return done;
}

/* Removes the stage, the record last: until then everything can be repeated. */
static void clear_away(const remains *found)
{
    char **names = gis_entry_names(found->inner);
    for (char **name = names; name && *name; name++)
        if (strcmp(*name, GIS_STAGE_RECORD) != 0) gis_remove_tree_in(found->inner, *name);
    CSLDestroy(names);
    gis_remove_tree_in(found->outer, found->name);
}

/* ---- What is found beside an output ------------------------------------------------------------------------------ */

static bool settle_stage(remains *found, const char *name, gis_sentences *said, gis_error *error)
{
    read_record(found);
    if (!found->main) {
        if (gis_entry_is_there(found->inner, name))
            gis_sentences_add(said, "%s/%s was left by a run that ended before it changed anything; it can be removed",
                              found->directory, found->name);
        else
            unlinkat(found->outer, found->name, AT_REMOVEDIR); /* succeeds only if it is empty */
        return true;
    }
    if (strcmp(found->main, name) != 0) return true;
    bool half = is_unfinished(found);
    if (half && !bring_back(found, error)) return false;
    clear_away(found);
    if (half)
        gis_sentences_add(
            said,
            "%s/%s: an earlier run was killed while it put its files in place; the former files have been restored",
            found->directory, name);
    return true;
}

static void tell_way_back(const remains *found, gis_sentences *said)
{
    gis_sentences_add(said,
                      "%s/%s is in use, or was left by a run that was killed while it put its files in place; the "
                      "former files are in %s/%s/" GIS_STAGE_OLD ": move them back",
                      found->directory, found->name, found->directory, found->name);
}

/* Handles a stage that belongs to the user. One in use is not touched. If locks do not work that is not known, and a
 * message says how to restore the files. */
static bool look_at(remains *found, const char *name, gis_sentences *said, gis_error *error)
{
    if (flock(found->inner, LOCK_EX | LOCK_NB) == 0) return settle_stage(found, name, said, error);
    if (errno == EWOULDBLOCK) return true;
    read_record(found);
    if (found->main && strcmp(found->main, name) == 0) tell_way_back(found, said);
    return true;
}

/* Handles a stage that belongs to the user but is open to others, as on file systems that give all directories one
 * mode. Its contents cannot be trusted, but may be the old files, so a message says where they are. */
static void look_from_outside(remains *found, const char *name, gis_sentences *said)
{
    const int opened = openat(found->outer, found->name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    const int aside = opened >= 0 && gis_is_own(opened)
                          ? openat(opened, GIS_STAGE_OLD, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)
                          : -1;
    if (aside >= 0 && gis_entry_is_there(aside, name)) tell_way_back(found, said);
    if (aside >= 0) close(aside);
    if (opened >= 0) close(opened);
}

/* Is it the name of a stage: the prefix, and six letters or digits? */
static bool is_called_so(const char *entry)
{
    const size_t n = sizeof GIS_STAGE_PREFIX - 1;
    if (strncmp(entry, GIS_STAGE_PREFIX, n) != 0 || strlen(entry) != n + 6) return false;
    for (const char *c = entry + n; *c; c++)
        if (!isalnum((unsigned char)*c)) return false;
    return true;
}

bool gis_stage_recover(const char *final_path, gis_sentences *said, gis_error *error)
{
    char *directory, *name;
    gis_stage_place_of(final_path, &directory, &name);
    const int outer = gis_open_directory(directory);
    char **entries = outer >= 0 ? gis_entry_names(outer) : NULL;
    bool done = true;
    for (char **entry = entries; done && entry && *entry; entry++) {
        if (!is_called_so(*entry)) continue;
        remains found = {directory, *entry, outer, gis_open_private_directory(outer, *entry), NULL, NULL, NULL};
        if (found.inner >= 0)
            done = look_at(&found, name, said, error);
        else
            look_from_outside(&found, name, said);
        if (found.inner >= 0) close(found.inner);
        forget_record(&found);
    }
    CSLDestroy(entries);
    if (outer >= 0) close(outer);
    CPLFree(directory);
    CPLFree(name);
    return done;
}
