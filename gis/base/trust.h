/* trust.h: what in a directory may be believed, where others can write in it, too.
 *
 * A file that another user made may hold anything, and may have a name that a run of ours would give. So what a run
 * finds beside its output (stages and records of a killed run, what it would clear away) is used only if it belongs to
 * the effective user and no other user may write in it. It is opened first, without following a link; owner and mode
 * are those of what was opened. A name that is read from a file is used only if it is a plain name, not a path. */
#ifndef GIS_TRUST_H
#define GIS_TRUST_H

#include "base/error.h"

/* Is what is open a directory of the effective user, for that user alone? Mode 0700; the bit by which a directory hands
 * its group on may be set. */
bool gis_is_private_directory(int descriptor);
/* Opens a directory in an open one that is such; -1: it is not, or cannot be. */
int gis_open_private_directory(int directory, const char *name);
/* Does what is open, of any kind, belong to the effective user? */
bool gis_is_own(int descriptor);

/* The name of something in a directory: not empty, not ".", not "..", and without a slash. */
bool gis_is_plain_name(const char *name);

/* Is the last component of the path there, in a directory in which all may write but only owners may rename (/tmp), and
 * does it belong neither to the effective user nor to root nor to the directory's owner? Anybody may have put it there:
 * a link that is not followed, a journal that is not applied. (Linux asks the same before it follows a link there,
 * proc(5), protected_symlinks; but not of one that is read, as realpath() does.) */
bool gis_may_be_planted(const char *path);
/* False where the path is a link that may be planted; `what` names it. */
bool gis_link_may_be_followed(const char *path, const char *what, gis_error *error);

/* Opens a directory, to work in it by names; -1: errno says why. */
int gis_open_directory(const char *path);

#endif
