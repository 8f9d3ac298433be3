/* remove_tree.h: a file, or a directory with all in it, removed from within a signal handler. */
#ifndef GIS_REMOVE_TREE_H
#define GIS_REMOVE_TREE_H

/* As far as it can be done; a link is removed, not what it leads to. Calls nothing but system calls. Where the system
 * has none that lists a directory (readdir() may not be called in a handler), a directory stays that is not empty. */
void gis_remove_tree(const char *path);
/* Removes an entry, by name, of an open directory. */
void gis_remove_tree_in(int directory, const char *name);

#endif
