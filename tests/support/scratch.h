/* A scratch directory of a test, which is removed with all its content. */
#ifndef SUNDER_TESTS_SCRATCH_H
#define SUNDER_TESTS_SCRATCH_H

/* To be called before all tests of a group, and after them. */
int scratch_set_up(void **state);
int scratch_tear_down(void **state);
/* Returns the path of the directory; valid between the two calls. */
const char *scratch_directory(void);
/* The path of a file in it, valid until the fourth call after this one. */
const char *scratch_path(const char *name);

#endif
