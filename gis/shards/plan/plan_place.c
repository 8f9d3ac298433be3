/* plan_place.c: see plan.h. */
#define _GNU_SOURCE /* for unlinkat() */
#include "shards/plan/plan.h"

#include "base/path.h"
#include "base/remove_tree.h"
#include "disk/temporary.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Gives the directory the mode of any new directory, except that not all users may write into it (gis_plan_read()).
 * Until then only its owner has access. */
static void open_to_others(int directory)
{
    const mode_t mask = umask(0);
    umask(mask);
    (void)fchmod(directory, 0777 & ~mask & ~(mode_t)S_IWOTH);
}

/* For DIR/NAME: "DIR/.NAME" with unique letters appended. *beside is the length of "DIR/". */
static char *hidden_beside(const char *directory, size_t *beside)
{
    size_t n = strlen(directory);
    while (n > 1 && directory[n - 1] == '/') n--;
    *beside = n;
    while (*beside > 0 && directory[*beside - 1] != '/') --*beside;
    return gis_printed("%.*s.%.*s" GIS_OWN_LETTERS, (int)*beside, directory, (int)(n - *beside), directory + *beside);
}

static void remove_abandoned(const char *hidden, size_t beside)
{
    char *directory = beside ? gis_printed("%.*s", (int)beside, hidden) : CPLStrdup(".");
    char *prefix = CPLStrdup(hidden + beside);
    prefix[strlen(prefix) - strlen(GIS_OWN_LETTERS)] = '\0';
    gis_remove_abandoned(directory, prefix);
    CPLFree(directory);
    CPLFree(prefix);
}

bool gis_plan_place_begin(const char *directory, gis_plan_place *place, gis_error *error)
{
    size_t beside;
    char *hidden = hidden_beside(directory, &beside);
    remove_abandoned(hidden, beside);
    place->path = CPLStrdup(hidden);
    gis_hold();
    place->lock = gis_make_directory(place->path);
    const int why = errno;
    if (place->lock >= 0) place->leftover = gis_leftover_temporary(place->path);
    gis_release();
    CPLFree(hidden);
    if (place->lock >= 0) return true;
    gis_fail(error, "%s: a directory cannot be made there: %s", directory, strerror(why));
    CPLFree(place->path);
    place->path = NULL;
    return false;
}

/* Syncs the parent directory: only then is the new name of a directory on the disk. */
static void sync_parent(const char *directory)
{
    char *parent = gis_path_join(directory, "..");
    const int opened = open(parent, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    CPLFree(parent);
    if (opened < 0) return;
    (void)fsync(opened);
    close(opened);
}

static void forget_place(gis_plan_place *place)
{
    gis_leftover_forget(place->leftover);
    CPLFree(place->path);
    close(place->lock);
    *place = (gis_plan_place){0};
}

bool gis_plan_place_end(gis_plan_place *place, const char *directory, bool *taken, gis_error *error)
{
    gis_hold();
    unlinkat(place->lock, GIS_BEING_MADE, 0);
    open_to_others(place->lock);
    const bool done = rename(place->path, directory) == 0;
    const int why = errno;
    if (done) forget_place(place);
    gis_release();
    *taken = !done && (why == ENOTEMPTY || why == EEXIST || why == ENOTDIR);
    if (done) sync_parent(directory);
    return done || *taken || gis_fail(error, "%s: the plan cannot be put there: %s", directory, strerror(why));
}

void gis_plan_place_clear(gis_plan_place *place)
{
    if (!place->path) return;
    gis_remove_tree(place->path);
    forget_place(place);
}
