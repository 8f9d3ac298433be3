/* remove_tree.c: see remove_tree.h. Everything is relative to open directories (unlinkat, openat without following
 * links): no path is built, which would need memory, and no other process can redirect the removal. */
#define _GNU_SOURCE
#include "base/remove_tree.h"

#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#ifdef SYS_getdents64

/* The layout of the kernel's struct linux_dirent64: inode and offset (8 bytes each), length of the entry (2), type (1),
 * name. */
enum { LENGTH_AT = 16, NAME_AT = 19, ROOM = 2048, DEEPEST = 16 };

static void empty_directory(int directory, int depth);

static void remove_entry(int directory, const char *name, int depth)
{
    if (strcmp(name, ".") == 0 || strcmp(name, "..") == 0 || unlinkat(directory, name, 0) == 0) return;
    int inside = openat(directory, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (inside >= 0) {
        empty_directory(inside, depth + 1);
        close(inside);
    }
    unlinkat(directory, name, AT_REMOVEDIR);
}

/* Removes everything in a directory. Listing it while entries are removed may miss some, so it is listed twice.
 * Datasets nest only a few levels deep. */
static void empty_directory(int directory, int depth)
{
    _Alignas(uint64_t) char entries[ROOM];
    if (depth > DEEPEST) return;
    for (int round = 0; round < 2; round++) {
        lseek(directory, 0, SEEK_SET);
        for (long got; (got = syscall(SYS_getdents64, directory, entries, sizeof entries)) > 0;)
            for (long at = 0; at < got;) {
                uint16_t length;
                memcpy(&length, entries + at + LENGTH_AT, sizeof length);
                remove_entry(directory, entries + at + NAME_AT, depth);
                at += length;
            }
    }
}

void gis_remove_tree_in(int directory, const char *name) { remove_entry(directory, name, 0); }

#else

void gis_remove_tree_in(int directory, const char *name)
{
    if (unlinkat(directory, name, 0) != 0) unlinkat(directory, name, AT_REMOVEDIR);
}

#endif

void gis_remove_tree(const char *path) { gis_remove_tree_in(AT_FDCWD, path); }
