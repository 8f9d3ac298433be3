/* escape.c: see escape.h.
 *
 * Both functions begin by reading the bytes as UTF-8 [RFC 3629]. Invalid sequences (stray and missing continuations,
 * overlong forms, surrogates, numbers past U+10FFFF), and characters that no page may hold (control characters,
 * noncharacters), become U+FFFD: a reader sees that something was there. So do marks that change the direction of all
 * following text (U+202A to U+202E, U+2066 to U+2069): a name could reverse the words after it; right-to-left names do
 * not need them, since the page isolates names (bdi).
 *
 * A script element ends at "</script" and changes its rules at "<!--": without a "<" neither can occur. U+2028 and
 * U+2029 end lines in old JavaScript. */
#include "page/escape.h"

#include <stdint.h>
#include <string.h>

enum { REPLACEMENT = 0xFFFD };

/* Returns the next character of a UTF-8 string, and its number of bytes; REPLACEMENT and 1 byte for an invalid
 * sequence. */
static uint32_t next_character(const char *words, size_t *taken)
{
    const unsigned char *at = (const unsigned char *)words;
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    size_t n = at[0] < 0x80 ? 1 : at[0] >= 0xC2 && at[0] < 0xE0 ? 2 : at[0] < 0xE0 ? 0 : at[0] < 0xF0 ? 3 : 4;
    *taken = 1;
    if (n == 1) return at[0];
    if (n == 0 || at[0] > 0xF4) return REPLACEMENT;
    uint32_t code = at[0] & (0x7FU >> n);
    for (size_t i = 1; i < n; i++) {
        if ((at[i] & 0xC0U) != 0x80) return REPLACEMENT; /* the NUL at the end is no continuation byte */
        code = code << 6 | (at[i] & 0x3FU);
    }
    if (code < least[n] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return REPLACEMENT;
    *taken = n;
    return code;
}

static bool is_shown(uint32_t code)
{
    bool control = (code < 0x20 && code != '\t' && code != '\n') || (code >= 0x7F && code < 0xA0);
    bool noncharacter = (code & 0xFFFE) == 0xFFFE || (code >= 0xFDD0 && code < 0xFDF0);
    bool turns = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
    return !control && !noncharacter && !turns;
}

static void add_character(gis_text *to, const char *bytes, size_t n, uint32_t code)
{
    if (code != REPLACEMENT && is_shown(code))
        gis_text_add_bytes(to, bytes, n);
    else
        gis_text_add(to, "\xEF\xBF\xBD");
}

void gis_escape_markup(gis_text *to, const char *words)
{
    for (size_t n; *words; words += n) {
        uint32_t code = next_character(words, &n);
        switch (code) {
        case '&': gis_text_add(to, "&amp;"); break;
        case '<': gis_text_add(to, "&lt;"); break;
        case '>': gis_text_add(to, "&gt;"); break;
        case '"': gis_text_add(to, "&quot;"); break;
        case '\'': gis_text_add(to, "&#39;"); break;
        default: add_character(to, words, n, code);
        }
    }
}

void gis_escape_script(gis_text *to, const char *words)
{
    gis_text_add(to, "\"");
    for (size_t n; *words; words += n) {
        uint32_t code = next_character(words, &n);
        bool special = code == '"' || code == '\\' || code == '<' || code == '>' || code == '&' || code == '\'' ||
                       code == '\t' || code == '\n' || code == 0x2028 || code == 0x2029;
        if (special)
            gis_text_print(to, "\\u%04x", (unsigned)code);
        else
            add_character(to, words, n, code);
    }
    gis_text_add(to, "\"");
}
