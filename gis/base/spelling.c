/* spelling.c: see spelling.h. The edit distance is the restricted one of Damerau and Levenshtein (optimal string
 * alignment): insertions, deletions, substitutions, and swaps of neighbouring letters. A word that is the beginning or
 * the end of another is near as well. */
#include "base/spelling.h"

#include <ctype.h>
#include <stdbool.h>
#include <strings.h>

enum { LONGEST = 40 }; /* longer words are not compared */

static int folded_letter(char c) { return tolower((unsigned char)c); }

static size_t smaller_of(size_t a, size_t b) { return a < b ? a : b; }

static size_t edit_distance(const char *a, size_t n, const char *b, size_t m)
{
    size_t row[LONGEST + 1], last[LONGEST + 1], before[LONGEST + 1] = {0};
    for (size_t k = 0; k <= m; k++) last[k] = k;
    for (size_t i = 1; i <= n; i++) {
        row[0] = i;
        for (size_t k = 1; k <= m; k++) {
            int p = folded_letter(a[i - 1]), q = folded_letter(b[k - 1]);
            row[k] = smaller_of(smaller_of(last[k], row[k - 1]) + 1, last[k - 1] + (p != q));
            if (i > 1 && k > 1 && p == folded_letter(b[k - 2]) && folded_letter(a[i - 2]) == q)
                row[k] = smaller_of(row[k], before[k - 2] + 1);
        }
        for (size_t k = 0; k <= m; k++) {
            before[k] = last[k];
            last[k] = row[k];
        }
    }
    return last[m];
}

/* Does the word begin or end with `part`? Shorter parts than SHORTEST_PART occur in too many words. */
enum { SHORTEST_PART = 4 };

static bool begins_or_ends(const char *word, size_t n, const char *part, size_t m)
{
    return m >= SHORTEST_PART && m < n && (strncasecmp(word, part, m) == 0 || strncasecmp(word + n - m, part, m) == 0);
}

gis_spelling gis_spelling_of(const char *word, size_t n) { return (gis_spelling){.word = word, .n = n}; }

void gis_spelling_offer(gis_spelling *search, const char *word, size_t n)
{
    if (search->n == 0 || search->n > LONGEST || n == 0 || n > LONGEST) return;
    /* One error in a word of four letters, two in one of eight, else three; with more, all short options would be near
     * each other. */
    size_t tolerated = search->n <= 4 ? 1 : search->n <= 8 ? 2 : 3;
    size_t found = edit_distance(search->word, search->n, word, n);
    if (found > tolerated && begins_or_ends(word, n, search->word, search->n)) found = tolerated;
    if (found > tolerated || found >= n || (search->best && found >= search->distance)) return;
    search->best = word;
    search->best_n = n;
    search->distance = found;
}
