/* trust.h: which entries of a directory may be trusted, if other users can write to it.
 *
 * A file that another user made may hold anything, and may have a name that one of our runs would choose. So entries
 * that a run finds beside its output (stages and records of a killed run, files it would remove) are used only if they
 * belong to the effective user and no other user may write to them. Each is opened first, without following a link;
 * owner and mode are those of the opened file. A name that is read from a file is used only if it is a plain name, not
 * a path. */
#ifndef GIS_TRUST_H
#define GIS_TRUST_H

#include "base/gis_error.h"

/* Is what is open a directory of the effective user, for that user alone? Mode 0700; the bit by which a directory hands
 * its group on may be set. */
bool gis_is_private_directory(int descriptor);
/* Opens a directory in an open one that is such; -1: it is not, or cannot be. */
int gis_open_private_directory(int directory, const char *name);
/* Does what is open, of any kind, belong to the effective user? */
bool gis_is_own(int descriptor);

/* The name of something in a directory: not empty, not ".", not "..", and without a slash. */
bool gis_is_plain_name(const char *name);

/* Does the last component of the path exist, in a directory where all users may write but only owners may rename
 * (/tmp), and does it belong neither to the effective user nor to root nor to the directory's owner? Any user may have
 * put it there: then a link is not followed, and a journal not applied. (Linux makes the same test before it follows a
 * link there, proc(5), protected_symlinks; but not for a link that is read, as realpath() does.) */
bool gis_may_be_planted(const char *path);
/* False where the path is a link that may be planted; `what` names it. */
bool gis_link_may_be_followed(const char *path, const char *what, gis_error *error);

/* Opens a directory, to work in it by names; -1: errno says why. */
int gis_open_directory(const char *path);

#endif
