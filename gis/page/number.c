/* number.c: see number.h. Spaces within a number and before its unit are no-break spaces (U+202F, U+00A0). */
#include "page/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define THIN "\xE2\x80\xAF"
#define NO_BREAK "\xC2\xA0"
#define MINUS "\xE2\x88\x92"

/* Numbers below the first bound and from the second bound on are written with a power of ten. */
static const double least_plain = 1e-4, most_plain = 1e15;

/* Any two doubles differ in 17 digits. */
enum { LENGTH_DIGITS = 3, AREA_DIGITS = 4, DIGITS_ENOUGH = 17 };

gis_page_unit gis_page_unit_of(const char *name)
{
    static const struct {
        const char *name;
        gis_page_unit unit;
    } known[] = {
        {"metre", {"m", "m\xC2\xB2"}},
        {"meter", {"m", "m\xC2\xB2"}},
        {"kilometre", {"km", "km\xC2\xB2"}},
        {"foot", {"ft", "ft\xC2\xB2"}},
        {"US survey foot", {"us-ft", "us-ft\xC2\xB2"}},
        {"degree", {"\xC2\xB0", "\xC2\xB0\xC2\xB2"}},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i].name, name) == 0) return known[i].unit;
    return (gis_page_unit){"", ""};
}

/* Writes digits in groups of three from the right; a number of four digits is not divided. */
static void add_grouped(gis_text *to, const char *digits, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (i > 0 && n > 4 && (n - i) % 3 == 0) gis_text_add(to, THIN);
        gis_text_add_bytes(to, digits + i, 1);
    }
}

void gis_print_count(gis_text *to, size_t n)
{
    char digits[32];
    add_grouped(to, digits, (size_t)snprintf(digits, sizeof digits, "%zu", n));
}

static void add_plain(gis_text *to, double size, int digits)
{
    char text[64];
    int power = (int)floor(log10(size)); /* the exponent of the first digit */
    int behind = power < digits - 1 ? digits - 1 - power : 0;
    snprintf(text, sizeof text, "%.*f", behind, size);
    size_t whole = strcspn(text, "."), n = strlen(text);
    while (whole < n && text[n - 1] == '0') n--;
    if (n == whole + 1) n--;
    add_grouped(to, text, whole);
    gis_text_add_bytes(to, text + whole, n - whole);
}

/* Writes an exponent in superscript digits. */
static void add_raised(gis_text *to, int power)
{
    static const char *const digits[] = {"\xE2\x81\xB0", "\xC2\xB9",     "\xC2\xB2",     "\xC2\xB3",
                                         "\xE2\x81\xB4", "\xE2\x81\xB5", "\xE2\x81\xB6", "\xE2\x81\xB7",
                                         "\xE2\x81\xB8", "\xE2\x81\xB9"};
    char text[16];
    snprintf(text, sizeof text, "%d", power);
    for (const char *c = text; *c; c++) gis_text_add(to, *c == '-' ? "\xE2\x81\xBB" : digits[*c - '0']);
}

void gis_print_number(gis_text *to, double value, int digits)
{
    double size = fabs(value);
    if (isnan(value)) {
        gis_text_add(to, "\xE2\x80\x93");
        return;
    }
    if (value < 0) gis_text_add(to, MINUS);
    if (isinf(value)) {
        gis_text_add(to, "\xE2\x88\x9E");
    } else if (size == 0) {
        gis_text_add(to, "0");
    } else if (size >= least_plain && size < most_plain) {
        add_plain(to, size, digits);
    } else {
        char text[64];
        int n = snprintf(text, sizeof text, "%.*e", digits - 1, size);
        const char *power = memchr(text, 'e', (size_t)n);
        gis_text_print(to, "%.*s" NO_BREAK "\xC3\x97" NO_BREAK "10", (int)(power - text), text);
        add_raised(to, atoi(power + 1));
    }
}

static void add_unit(gis_text *to, double value, const char *unit)
{
    if (!*unit || isnan(value)) return;
    if (strncmp(unit, "\xC2\xB0", 2) != 0) gis_text_add(to, NO_BREAK);
    gis_text_add(to, unit);
}

void gis_print_length(gis_text *to, double value, const gis_page_unit *unit)
{
    gis_print_number(to, value, LENGTH_DIGITS);
    add_unit(to, value, unit->length);
}

void gis_print_length_beside(gis_text *to, double value, double other, const gis_page_unit *unit)
{
    int digits = LENGTH_DIGITS;
    char a[64], b[64];
    for (; digits < DIGITS_ENOUGH; digits++) {
        snprintf(a, sizeof a, "%.*e", digits - 1, value);
        snprintf(b, sizeof b, "%.*e", digits - 1, other);
        if (value == other || strcmp(a, b) != 0) break;
    }
    gis_print_number(to, value, digits);
    add_unit(to, value, unit->length);
}

void gis_print_area(gis_text *to, double value, const gis_page_unit *unit)
{
    gis_print_number(to, value, AREA_DIGITS);
    add_unit(to, value, unit->area);
}

/* Returns the number with at most `digits` digits that is nearest to the value from above (sign 1) or from below (sign
 * -1). If the nearest number is on the wrong side, it is moved by one unit in the last digit, which is enough. */
static double to_side(double value, int digits, int sign)
{
    char text[64];
    if (!isfinite(value) || value == 0) return value;
    double step = pow(10, floor(log10(fabs(value))) - digits + 1);
    snprintf(text, sizeof text, "%.*e", digits - 1, value);
    double said = strtod(text, NULL);
    return sign * (said - value) >= 0 ? said : said + sign * step;
}

void gis_print_length_or_more(gis_text *to, double value, const gis_page_unit *unit)
{
    gis_print_length(to, to_side(value, LENGTH_DIGITS, 1), unit);
}

void gis_print_length_or_less(gis_text *to, double value, const gis_page_unit *unit)
{
    gis_print_length(to, to_side(value, LENGTH_DIGITS, -1), unit);
}

void gis_print_area_or_less(gis_text *to, double value, const gis_page_unit *unit)
{
    gis_print_area(to, to_side(value, AREA_DIGITS, -1), unit);
}

void gis_print_share_or_more(gis_text *to, double part)
{
    double percent = part * 100;
    if (percent > 0 && percent < 0.1)
        gis_text_add(to, "&lt;" NO_BREAK "0.1");
    else
        gis_print_number(to, percent < 10 ? ceil(percent * 10) / 10 : ceil(percent), LENGTH_DIGITS);
    gis_text_add(to, NO_BREAK "%");
}
