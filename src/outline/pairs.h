/* Which part matters to which line: pairs as the cells find them, in no order and with repeats, read line by line in
 * the end.
 *
 * Most come in rows, many lines with one part or many parts with one line, and are kept so, in four bytes each: of all
 * that there is at once while a sum is made they are among what grows most. */
#ifndef SUNDER_I_PAIRS_H
#define SUNDER_I_PAIRS_H

#include "base/memory.h"

#include <stddef.h>

typedef struct sunder_i_pairs {
    uint32_t *word; /* rows: what is common to them, then the others */
    size_t n, capacity;
    size_t row;   /* the last one, which may still grow; past the end if none is */
    size_t count; /* of pairs */
} sunder_i_pairs;

/* Where to go back to. */
typedef struct sunder_i_pairs_mark {
    size_t n, count;
} sunder_i_pairs_mark;

/* False if memory is out. */
bool sunder_i_pairs_add(sunder_i_pairs *pairs, uint32_t line, uint32_t part);
/* What comes later can be taken back. */
sunder_i_pairs_mark sunder_i_pairs_mark_here(sunder_i_pairs *pairs);
void sunder_i_pairs_take_back(sunder_i_pairs *pairs, sunder_i_pairs_mark mark);
void sunder_i_pairs_free(sunder_i_pairs *pairs);

/* The same line by line. */
typedef struct sunder_i_line_parts {
    size_t *end;    /* [lines] past the last of its parts */
    uint32_t *part; /* of each line rising, with repeats */
} sunder_i_line_parts;

/* Of the lines that are wanted; of the others none is listed. So many lines and parts there are. False if memory is
 * out: *out is to be freed in any case. */
bool sunder_i_pairs_by_line(const sunder_i_pairs *pairs, const bool *wanted, uint32_t lines, uint32_t parts,
                            sunder_i_line_parts *out);
void sunder_i_line_parts_free(sunder_i_line_parts *by_line);

#endif
