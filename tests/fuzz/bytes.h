/* Converts a fuzzer's bytes to arguments. Most bytes give small shapes on a small grid, in which everything touches and
 * coincides. Some give map coordinates, some doubles of 16 binary orders of magnitude, and a few doubles of 64 orders
 * or arbitrary ones. These are rare, since products of thousands of bits would take most of the time. */
#ifndef SUNDER_TEST_FUZZ_BYTES_H
#define SUNDER_TEST_FUZZ_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "sunder.h"

typedef struct fuzz_bytes {
    const uint8_t *data;
    size_t left;
} fuzz_bytes;

typedef enum fuzz_scale { FUZZ_GRID, FUZZ_MAP, FUZZ_NEAR, FUZZ_FAR, FUZZ_ANY } fuzz_scale;

/* The next byte; 0 when there are no more. */
unsigned fuzz_byte(fuzz_bytes *bytes);
fuzz_scale fuzz_choose_scale(fuzz_bytes *bytes);
double fuzz_coordinate(fuzz_bytes *bytes, fuzz_scale scale);

/* From here on allocation number `after` and all later ones fail; 0: none fails. Installs the hooks once. */
void fuzz_fail_allocations(unsigned after);

/* From here on the library may poll this many times, which it does every millisecond or so; then it is told to stop:
 * the call ends with SUNDER_ECANCEL, and so do later calls. This keeps one input from taking hours. 0: no limit. */
enum { FUZZ_LOOKS = 400 };
void fuzz_patience(unsigned looks);
bool fuzz_is_out_of_patience(void);

/* Ends the process, so that the fuzzer keeps the input, if the statement is false. */
#define FUZZ_DEMAND(statement)                                                                                         \
    do {                                                                                                               \
        if (!(statement)) fuzz_complain(__FILE__, __LINE__, #statement);                                               \
    } while (0)
_Noreturn void fuzz_complain(const char *file, int line, const char *statement);

/* A shape of at most this many vertices; NULL if the library refuses it or has no memory for it. Checks that a refusal
 * has a reason and leaves the output untouched. */
sunder_shape *fuzz_shape(fuzz_bytes *bytes, fuzz_scale scale, size_t max_vertices);

#endif
