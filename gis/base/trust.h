/* trust.h: which entries of a directory may be trusted if other users can write to it.
 *
 * A file that another user made may contain anything, and may have a name that this program would choose. So entries
 * that a run finds beside its output (stages and records of a killed run, files to be removed) are used only if they
 * belong to the effective user and no other user may write to them. Each is opened first, without following a link, and
 * the owner and mode of the open file are tested. A name that is read from a file is used only if it is a plain name,
 * not a path. */
#ifndef GIS_TRUST_H
#define GIS_TRUST_H

#include "base/gis_error.h"

/* Returns true if the descriptor is of a directory of the effective user with mode 0700 (the setgid bit may be set). */
bool gis_is_private_directory(int descriptor);
/* Opens the directory `name` in an open directory if gis_is_private_directory(); -1 otherwise, or if it cannot be
 * opened. */
int gis_open_private_directory(int directory, const char *name);
/* Returns true if the open file, of any kind, belongs to the effective user. */
bool gis_is_own(int descriptor);

/* Returns true if `name` can be the name of a directory's entry: not empty, ".", or "..", and without a slash. */
bool gis_is_plain_name(const char *name);

/* May another user have put the file there? True if the last component of the path is in a directory where all users
 * may write but only owners may rename (/tmp), and belongs to neither the effective user, nor root, nor the directory's
 * owner. Such a link is not followed, and such a journal not applied. (Linux makes the same test before it follows a
 * link there (proc(5), protected_symlinks), but not when a link is read, as realpath() does.) */
bool gis_may_be_planted(const char *path);
/* Fails if the path is a link that another user may have put there; `what` names it in the message. */
bool gis_link_may_be_followed(const char *path, const char *what, gis_error *error);

/* Opens a directory for use with openat() and similar functions. Returns its descriptor; -1: failed, errno has the
 * reason. */
int gis_open_directory(const char *path);

#endif
