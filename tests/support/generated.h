/* Operands from the generator sunder-families, run as a program. */
#ifndef SUNDER_TESTS_GENERATED_H
#define SUNDER_TESTS_GENERATED_H

#include "polyset.h"

/* Does the program exist? If not, prints a message on stdout. */
bool generated_available(void);
/* The output of the program for these arguments, as in a shell; *status (may be NULL) is its exit status, else any
 * status but 0 ends the test program. Freed by the caller. */
char *generated_text(const char *arguments, int *status);
/* The two operands that it prints. */
void generated_pair(polyset *p, polyset *q, const char *arguments);

#endif
