/* Rows of pairs, and these sorted by lines and parts, by counting: twice, the least first. */
#include "outline/pairs.h"

#include <string.h>

/* A row begins with what its pairs have in common, marked if that is the line and not the part; then come the others,
 * of which the last is marked. A row of one has, as it begins, its part in front. There are fewer lines and parts than
 * 2^31. */
#define MARK 0x80000000u
#define NUMBER(word) ((word) & ~MARK)
#define LEAST_ROOM 256

/* Where two more words can be written to; NULL if memory is out. The room grows by an eighth: doubled, it would be the
 * largest array of all just after. */
static uint32_t *next_words(sunder_i_pairs *p)
{
    const size_t need = p->n + 2;
    if (need > p->capacity) {
        const size_t room = need + (need / 8 > LEAST_ROOM ? need / 8 : LEAST_ROOM);
        uint32_t *more = sunder_i_realloc(p->word, room, sizeof *more);
        if (!more) return NULL;
        p->word = more;
        p->capacity = room;
    }
    return p->word + p->n;
}

bool sunder_i_pairs_add(sunder_i_pairs *p, uint32_t line, uint32_t part)
{
    uint32_t *next = next_words(p);
    if (!next) return false;
    p->count++;
    if (p->row < p->n) {
        uint32_t *row = p->word + p->row, other = row[0] == part ? line : part;
        bool goes_on = row[0] == part || row[0] == (line | MARK);
        if (!goes_on && p->n - p->row == 2 && row[1] == (line | MARK)) {
            /* Of the first pair it was open what it would have in common with others. */
            row[1] = row[0] | MARK;
            row[0] = line | MARK;
            goes_on = true;
        }
        if (goes_on) {
            next[-1] = NUMBER(next[-1]);
            next[0] = other | MARK;
            p->n++;
            return true;
        }
    }
    p->row = p->n;
    next[0] = part;
    next[1] = line | MARK;
    p->n += 2;
    return true;
}

sunder_i_pairs_mark sunder_i_pairs_mark_here(sunder_i_pairs *p)
{
    p->row = SIZE_MAX; /* no row that is there grows */
    return (sunder_i_pairs_mark){p->n, p->count};
}

void sunder_i_pairs_take_back(sunder_i_pairs *p, sunder_i_pairs_mark mark)
{
    p->n = mark.n;
    p->count = mark.count;
    p->row = SIZE_MAX;
}

void sunder_i_pairs_free(sunder_i_pairs *p)
{
    sunder_i_free(p->word);
    memset(p, 0, sizeof *p);
}

/* ---- Line by line ---- */

/* Where the row that begins here ends. */
static const uint32_t *end_of(const uint32_t *row)
{
    const uint32_t *word = row + 1;
    while (!(*word & MARK)) word++;
    return word + 1;
}

/* Numbers in lists. */
typedef struct lists {
    size_t *end; /* [lists] past the last of each; while they are filled, where its next one goes */
    uint32_t *item;
} lists;

/* Of how many there are in each list, where it begins; their sum. */
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

/* Of the pairs of wanted lines: counts the lines of each part, or writes them there where there are items. */
static void list_lines(const sunder_i_pairs *p, const bool *wanted, lists *of_part)
{
    size_t *end = of_part->end;
    for (const uint32_t *row = p->word, *last = row + p->n, *next; row < last; row = next) {
        const uint32_t first = NUMBER(row[0]);
        const bool of_line = row[0] & MARK;
        next = end_of(row);
        if (of_line && !wanted[first]) continue;
        for (const uint32_t *word = row + 1; word < next; word++) {
            const uint32_t part = of_line ? NUMBER(*word) : first, line = of_line ? first : NUMBER(*word);
            if (!wanted[line]) continue;
            if (of_part->item) of_part->item[end[part]] = line;
            end[part]++;
        }
    }
}

/* Lists of parts, which come in order: so they are sorted in the lists of lines. */
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

bool sunder_i_pairs_by_line(const sunder_i_pairs *p, const bool *wanted, uint32_t lines, uint32_t parts,
                            sunder_i_line_parts *out)
{
    lists of_part = {sunder_i_calloc(parts, sizeof *of_part.end), NULL};
    memset(out, 0, sizeof *out);
    bool ok = of_part.end;
    if (ok && p->n > 0) {
        list_lines(p, wanted, &of_part);
        of_part.item = sunder_i_alloc(begin_lists(of_part.end, parts), sizeof *of_part.item);
        ok = of_part.item;
        if (ok) list_lines(p, wanted, &of_part);
    }
    ok = ok && turn_over(&of_part, parts, lines, out);
    sunder_i_free(of_part.end);
    sunder_i_free(of_part.item);
    return ok;
}

void sunder_i_line_parts_free(sunder_i_line_parts *by_line)
{
    sunder_i_free(by_line->end);
    sunder_i_free(by_line->part);
    memset(by_line, 0, sizeof *by_line);
}
