/* scratch.c: see scratch.h. */
#define _XOPEN_SOURCE 700 /* for nftw() */
#include "scratch.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char directory[32];

int scratch_set_up(void **state)
{
    strcpy(directory, "/tmp/sunder-test.XXXXXX");
    return mkdtemp(directory) ? 0 : -1;
}

static int take_away(const char *path, const struct stat *is, int kind, struct FTW *where) { return remove(path); }

int scratch_tear_down(void **state) { return nftw(directory, take_away, 8, FTW_DEPTH | FTW_PHYS); }

const char *scratch_directory(void) { return directory; }

const char *scratch_path(const char *name)
{
    static char path[4][256];
    static unsigned next;
    char *to = path[next++ % 4];
    snprintf(to, sizeof path[0], "%s/%s", directory, name);
    return to;
}
