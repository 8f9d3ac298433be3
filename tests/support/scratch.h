/* A directory of a test's own, taken away with all that is in it. */
#ifndef SUNDER_TESTS_SCRATCH_H
#define SUNDER_TESTS_SCRATCH_H

/* Before all tests of a group, and after them. */
int scratch_set_up(void **state);
int scratch_tear_down(void **state);
/* Returns its path; valid between the two calls. */
const char *scratch_directory(void);
/* The path of a file in it, valid until the fourth call after. */
const char *scratch_path(const char *name);

#endif
