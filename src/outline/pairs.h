/* Which part matters to which line: pairs in the order in which the cells find them, with repeats, read line by line in
 * the end.
 *
 * Most come in rows, many lines with one part or many parts with one line, and are stored as rows, four bytes each:
 * pairs are among the largest arrays that exist while a sum is made. */
#ifndef SUNDER_I_PAIRS_H
#define SUNDER_I_PAIRS_H

#include "base/memory.h"

#include <stddef.h>

/* A row begins with the member that its pairs share, marked if that is a line and not a part; the other members follow,
 * the last of them marked. A row of one pair begins with its part. There are fewer than 2^31 lines and parts. */
#define SUNDER_I_PAIRS_MARK 0x80000000u

typedef struct sunder_i_pairs {
    uint32_t *word;
    size_t n, capacity;
    size_t row;   /* the last one, which may still grow; past the end if none is */
    size_t count; /* of pairs */
} sunder_i_pairs;

/* Where to go back to. */
typedef struct sunder_i_pairs_mark {
    size_t n, count;
} sunder_i_pairs_mark;

/* For sunder_i_pairs_add(): the pair does not continue the last row. */
bool sunder_i_pairs_begin(sunder_i_pairs *pairs, uint32_t line, uint32_t part);

/* False if memory is out. */
static inline bool sunder_i_pairs_add(sunder_i_pairs *pairs, uint32_t line, uint32_t part)
{
    const size_t n = pairs->n;
    uint32_t *word = pairs->word;
    if (n == pairs->capacity || pairs->row >= n) return sunder_i_pairs_begin(pairs, line, part);
    const uint32_t common = word[pairs->row];
    if (common != part && common != (line | SUNDER_I_PAIRS_MARK)) return sunder_i_pairs_begin(pairs, line, part);
    word[n - 1] &= ~SUNDER_I_PAIRS_MARK;
    word[n] = (common == part ? line : part) | SUNDER_I_PAIRS_MARK;
    pairs->n++;
    pairs->count++;
    return true;
}

/* Remembers the end of the list, so that pairs added later can be taken back. */
sunder_i_pairs_mark sunder_i_pairs_mark_here(sunder_i_pairs *pairs);
void sunder_i_pairs_take_back(sunder_i_pairs *pairs, sunder_i_pairs_mark mark);
void sunder_i_pairs_free(sunder_i_pairs *pairs);

/* The same line by line. */
typedef struct sunder_i_line_parts {
    size_t *end;    /* [lines] past the last of its parts */
    uint32_t *part; /* of each line rising, with repeats */
} sunder_i_line_parts;

/* Sorts the pairs of the wanted lines; the lists of other lines are empty. `lines` and `parts` are the numbers of lines
 * and parts. False if memory is out; the caller frees *out in any case. */
bool sunder_i_pairs_by_line(const sunder_i_pairs *pairs, const bool *wanted, uint32_t lines, uint32_t parts,
                            sunder_i_line_parts *out);
void sunder_i_line_parts_free(sunder_i_line_parts *by_line);

#endif
