/* pairs.c: see pairs.h. Rows of pairs, and their sorting by lines and parts: counting sort twice, the least significant
 * key first. */
#include "outline/pairs.h"

#include <string.h>

#define MARK SUNDER_I_PAIRS_MARK
#define NUMBER(word) ((word) & ~MARK)
#define LEAST_ROOM 256

/* Makes room for two more words. The capacity grows by an eighth: doubled, it would soon be the largest array of all.
 * Returns false if out of memory. */
static bool reserve_pair(sunder_i_pairs *p)
{
    const size_t need = p->n + 2;
    if (need <= p->capacity) return true;
    const size_t room = need + (need / 8 > LEAST_ROOM ? need / 8 : LEAST_ROOM);
    uint32_t *more = sunder_i_realloc(p->word, room, sizeof *more);
    if (!more) return false;
    p->word = more;
    p->capacity = room;
    return true;
}

/* Returns whether the pair continues the last row. While a row has one pair, its common member is undecided: if it
 * turns out to be the line, the row is reversed. */
static bool goes_on(sunder_i_pairs *p, uint32_t line, uint32_t part)
{
    if (p->row >= p->n) return false;
    uint32_t *row = p->word + p->row;
    if (row[0] == part || row[0] == (line | MARK)) return true;
    if (p->n - p->row != 2 || row[0] & MARK || row[1] != (line | MARK)) return false;
    row[1] = row[0] | MARK;
    row[0] = line | MARK;
    return true;
}

bool sunder_i_pairs_begin(sunder_i_pairs *pairs, uint32_t line, uint32_t part)
{
    if (!reserve_pair(pairs)) return false;
    if (goes_on(pairs, line, part)) return sunder_i_pairs_add(pairs, line, part);
    pairs->row = pairs->n;
    pairs->word[pairs->n++] = part;
    pairs->word[pairs->n++] = line | MARK;
    pairs->count++;
    return true;
}

sunder_i_pairs_mark sunder_i_pairs_mark_here(sunder_i_pairs *pairs)
{
    pairs->row = SIZE_MAX; /* no existing row is continued */
    return (sunder_i_pairs_mark){pairs->n, pairs->count};
}

void sunder_i_pairs_take_back(sunder_i_pairs *pairs, sunder_i_pairs_mark mark)
{
    pairs->n = mark.n;
    pairs->count = mark.count;
    pairs->row = SIZE_MAX;
}

void sunder_i_pairs_free(sunder_i_pairs *pairs)
{
    sunder_i_free(pairs->word);
    memset(pairs, 0, sizeof *pairs);
}

/* ---- Pairs sorted by line ---- */

/* Lists of numbers. */
typedef struct lists {
    size_t *end; /* [lists] the end of each list; while they are filled, the position of its next element */
    uint32_t *item;
} lists;

/* Converts the lengths of lists to their beginnings; returns the sum of the lengths. */
static size_t begin_lists(size_t *of, uint32_t n)
{
    size_t sum = 0;
    for (uint32_t i = 0; i < n; i++) {
        const size_t count = of[i];
        of[i] = sum;
        sum += count;
    }
    return sum;
}

/* Counts the lines of each part over the pairs of wanted lines, or writes them to of_part->item unless that is NULL. */
static void list_lines(const sunder_i_pairs *p, const bool *wanted, lists *of_part)
{
    size_t *end = of_part->end;
    uint32_t *item = of_part->item;
    for (const uint32_t *word = p->word, *last = word + p->n; word < last; word++) {
        const uint32_t first = NUMBER(word[0]);
        const bool of_line = word[0] & MARK, none = of_line && !wanted[first];
        do {
            word++;
            const uint32_t line = of_line ? first : NUMBER(*word), part = of_line ? NUMBER(*word) : first;
            if (none || !wanted[line]) continue;
            if (item) item[end[part]] = line;
            end[part]++;
        } while (!(*word & MARK));
    }
}

/* Converts lists by part to lists by line; the parts are read in order, so that each line's list is sorted. Returns
 * false if out of memory. */
static bool turn_over(const lists *of_part, uint32_t parts, uint32_t lines, sunder_i_line_parts *out)
{
    const size_t n = parts ? of_part->end[parts - 1] : 0;
    out->end = sunder_i_calloc(lines, sizeof *out->end);
    out->part = sunder_i_alloc(n, sizeof *out->part);
    if (!out->end || !out->part) return false;
    for (size_t i = 0; i < n; i++) out->end[of_part->item[i]]++;
    begin_lists(out->end, lines);
    size_t i = 0;
    for (uint32_t part = 0; part < parts; part++)
        for (; i < of_part->end[part]; i++) out->part[out->end[of_part->item[i]]++] = part;
    return true;
}

bool sunder_i_pairs_by_line(const sunder_i_pairs *pairs, const bool *wanted, uint32_t lines, uint32_t parts,
                            sunder_i_line_parts *out)
{
    lists of_part = {sunder_i_calloc(parts, sizeof *of_part.end), NULL};
    memset(out, 0, sizeof *out);
    bool ok = of_part.end;
    if (ok && pairs->n > 0) {
        list_lines(pairs, wanted, &of_part);
        of_part.item = sunder_i_alloc(begin_lists(of_part.end, parts), sizeof *of_part.item);
        ok = of_part.item;
        if (ok) list_lines(pairs, wanted, &of_part);
    }
    ok = ok && turn_over(&of_part, parts, lines, out);
    sunder_i_free_all(of_part.end, of_part.item);
    return ok;
}

void sunder_i_line_parts_free(sunder_i_line_parts *by_line)
{
    sunder_i_free_all(by_line->end, by_line->part);
    memset(by_line, 0, sizeof *by_line);
}
