/* pairs.h: the parts that matter to each line: pairs in the order in which the cells find them, with repetitions,
 * finally sorted by line.
 *
 * Most pairs come in rows, many lines with one part or many parts with one line, and are stored as rows, four bytes
 * each: pairs are among the largest arrays during the computation of a sum. */
#ifndef SUNDER_I_PAIRS_H
#define SUNDER_I_PAIRS_H

#include "base/memory.h"

#include <stddef.h>

/* A row begins with the member that its pairs have in common, marked if that is a line and not a part; the other
 * members follow, the last one marked. A row of one pair begins with its part. There are fewer than 2^31 lines and
 * parts. */
#define SUNDER_I_PAIRS_MARK 0x80000000u

typedef struct sunder_i_pairs {
    uint32_t *word;
    size_t n, capacity;
    size_t row;   /* the position of the last row, which may still grow; a position beyond the end if none may */
    size_t count; /* the number of pairs */
} sunder_i_pairs;

/* A position to which sunder_i_pairs_take_back() returns. */
typedef struct sunder_i_pairs_mark {
    size_t n, count;
} sunder_i_pairs_mark;

/* Adds a pair when the array is full, there is no row yet, or the pair does not continue the last row; called by
 * sunder_i_pairs_add(). Returns false if out of memory. */
bool sunder_i_pairs_begin(sunder_i_pairs *pairs, uint32_t line, uint32_t part);

/* Adds a pair. Returns false if out of memory. */
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

/* Returns the end of the list; the second function removes all pairs added since. */
sunder_i_pairs_mark sunder_i_pairs_mark_here(sunder_i_pairs *pairs);
void sunder_i_pairs_take_back(sunder_i_pairs *pairs, sunder_i_pairs_mark mark);
void sunder_i_pairs_free(sunder_i_pairs *pairs);

/* The parts of each line. */
typedef struct sunder_i_line_parts {
    size_t *end;    /* [lines] the end of the parts of each line */
    uint32_t *part; /* the parts of each line, ascending, with repetitions */
} sunder_i_line_parts;

/* Sorts the pairs of the wanted lines; the lists of other lines are empty. `lines` and `parts` are the numbers of lines
 * and parts. Returns false if out of memory; the caller frees *out in any case. */
bool sunder_i_pairs_by_line(const sunder_i_pairs *pairs, const bool *wanted, uint32_t lines, uint32_t parts,
                            sunder_i_line_parts *out);
void sunder_i_line_parts_free(sunder_i_line_parts *by_line);

#endif
