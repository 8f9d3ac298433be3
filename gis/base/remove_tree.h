/* remove_tree.h: removes a file, or a directory with its contents; usable in a signal handler. */
#ifndef GIS_REMOVE_TREE_H
#define GIS_REMOVE_TREE_H

/* Removes as much as possible; of a link, the link itself. Makes system calls only. On systems without a system call
 * that lists directories (readdir() is not allowed in a handler), only empty directories are removed. */
void gis_remove_tree(const char *path);
/* Removes the entry `name` of an open directory. */
void gis_remove_tree_in(int directory, const char *name);

#endif
