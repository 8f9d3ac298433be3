/* Operands from the generator sunder-families, run as a program. */
#ifndef SUNDER_TESTS_GENERATED_H
#define SUNDER_TESTS_GENERATED_H

#include "polyset.h"

/* Is the program there? If not, says so on stdout. */
bool generated_available(void);
/* What it prints with these arguments of a shell; *status (may be NULL) is its exit status, else anything but 0 ends
 * the test program. Freed by the caller. */
char *generated_text(const char *arguments, int *status);
/* The two operands that it prints. */
void generated_pair(polyset *p, polyset *q, const char *arguments);

#endif
