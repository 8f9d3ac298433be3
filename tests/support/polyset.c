#include "polyset.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

void *test_alloc(size_t n, size_t size) { return test_resize(NULL, n, size); }

void *test_resize(void *old, size_t n, size_t size)
{
    void *p = realloc(old, n && size ? n * size : 1);
    if (!p) {
        fputs("test: out of memory\n", stderr);
        abort();
    }
    return p;
}

char *test_format(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const int n = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char *text = test_alloc((size_t)n + 1, 1);
    va_start(args, format);
    vsnprintf(text, (size_t)n + 1, format, args);
    va_end(args);
    return text;
}

void polyset_init(polyset *set) { memset(set, 0, sizeof *set); }

void polyset_free(polyset *set)
{
    free(set->xy);
    free(set->ring_end);
    free(set->poly_end);
    polyset_init(set);
}

/* Arrays grow to the next power of two, so the capacity need not be stored. */
static void *room(void *array, size_t n, size_t size)
{
    return (n & (n - 1)) ? array : test_resize(array, n ? 2 * n : 1, size);
}

void polyset_vertex(polyset *set, double x, double y)
{
    set->xy = room(set->xy, set->vertices, 2 * sizeof *set->xy);
    set->xy[2 * set->vertices] = x;
    set->xy[2 * set->vertices + 1] = y;
    set->vertices++;
}

void polyset_end_ring(polyset *set)
{
    set->ring_end = room(set->ring_end, set->rings, sizeof *set->ring_end);
    set->ring_end[set->rings++] = set->vertices;
}

void polyset_end_polygon(polyset *set)
{
    set->poly_end = room(set->poly_end, set->polygons, sizeof *set->poly_end);
    set->poly_end[set->polygons++] = set->rings;
}

void polyset_ring(polyset *set, const double *xy, size_t n)
{
    for (size_t i = 0; i < n; i++) polyset_vertex(set, xy[2 * i], xy[2 * i + 1]);
    polyset_end_ring(set);
}

void polyset_polygon(polyset *set, const double *xy, size_t n)
{
    polyset_ring(set, xy, n);
    polyset_end_polygon(set);
}

void polyset_rectangle(polyset *set, double x0, double y0, double x1, double y1)
{
    const double xy[] = {x0, y0, x1, y0, x1, y1, x0, y1};
    polyset_polygon(set, xy, 4);
}

void polyset_append(polyset *set, const polyset *other)
{
    size_t v = 0, r = 0;
    for (size_t p = 0; p < other->polygons; p++) {
        for (; r < other->poly_end[p]; r++) {
            for (; v < other->ring_end[r]; v++) polyset_vertex(set, other->xy[2 * v], other->xy[2 * v + 1]);
            polyset_end_ring(set);
        }
        polyset_end_polygon(set);
    }
}

void polyset_copy(polyset *to, const polyset *from)
{
    polyset_init(to);
    polyset_append(to, from);
}

void polyset_move(polyset *set, double dx, double dy)
{
    for (size_t i = 0; i < set->vertices; i++) {
        set->xy[2 * i] += dx;
        set->xy[2 * i + 1] += dy;
    }
}

void polyset_scale(polyset *set, double sx, double sy)
{
    for (size_t i = 0; i < set->vertices; i++) {
        set->xy[2 * i] *= sx;
        set->xy[2 * i + 1] *= sy;
    }
}

void polyset_negate(polyset *set) { polyset_scale(set, -1, -1); }

void polyset_turn_rings(polyset *set, size_t start)
{
    size_t first = 0;
    for (size_t r = 0; r < set->rings; r++) {
        const size_t n = set->ring_end[r] - first;
        double *ring = set->xy + 2 * first, *old = test_alloc(2 * n, sizeof *old);
        memcpy(old, ring, 2 * n * sizeof *old);
        for (size_t i = 0; i < n; i++) memcpy(ring + 2 * i, old + 2 * ((start + n - i % n) % n), 2 * sizeof *old);
        free(old);
        first = set->ring_end[r];
    }
}

bool polyset_holds(const polyset *set, double x, double y)
{
    for (size_t p = 0, r = 0, v = 0; p < set->polygons; p++) {
        bool in = false;
        for (; r < set->poly_end[p]; r++) {
            const size_t first = v, end = set->ring_end[r];
            for (; v < end; v++) {
                const double *a = set->xy + 2 * v, *b = set->xy + 2 * (v + 1 < end ? v + 1 : first);
                if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) in = !in;
            }
        }
        if (in) return true;
    }
    return false;
}

static const char *skip(const char *s)
{
    while (isspace((unsigned char)*s)) s++;
    return s;
}

static bool take(const char **s, char c)
{
    *s = skip(*s);
    if (**s != c) return false;
    ++*s;
    return true;
}

static bool read_ring(polyset *set, const char **s)
{
    const size_t first = set->vertices;
    if (!take(s, '(')) return false;
    do {
        char *end;
        const double x = strtod(*s, &end);
        if (end == *s) return false;
        *s = end;
        const double y = strtod(*s, &end);
        if (end == *s) return false;
        *s = end;
        polyset_vertex(set, x, y);
    } while (take(s, ','));
    const double *xy = set->xy;
    const size_t last = set->vertices - 1;
    if (last > first && xy[2 * first] == xy[2 * last] && xy[2 * first + 1] == xy[2 * last + 1]) set->vertices = last;
    polyset_end_ring(set);
    return take(s, ')');
}

static bool read_polygon(polyset *set, const char **s)
{
    if (!take(s, '(')) return false;
    do {
        if (!read_ring(set, s)) return false;
    } while (take(s, ','));
    polyset_end_polygon(set);
    return take(s, ')');
}

bool polyset_read_wkt(polyset *set, const char *text, const char **end)
{
    const char *s = skip(text);
    bool ok;
    polyset_init(set);
    if (strncasecmp(s, "POLYGON", 7) == 0) {
        s += 7;
        ok = read_polygon(set, &s);
    } else if (strncasecmp(s, "MULTIPOLYGON", 12) == 0) {
        s += 12;
        ok = take(&s, '(');
        if (ok) do {
                ok = read_polygon(set, &s);
            } while (ok && take(&s, ','));
        ok = ok && take(&s, ')');
    } else {
        ok = false;
    }
    if (!ok) polyset_free(set);
    if (end) *end = s;
    return ok;
}

char *polyset_wkt(const polyset *set)
{
    char *text = NULL;
    size_t size, v = 0, r = 0;
    FILE *f = open_memstream(&text, &size);
    if (!f) abort();
    fputs("MULTIPOLYGON(", f);
    for (size_t p = 0; p < set->polygons; p++) {
        fputs(p ? ",(" : "(", f);
        for (size_t r0 = r; r < set->poly_end[p]; r++) {
            const size_t first = v;
            fputs(r > r0 ? ",(" : "(", f);
            for (; v < set->ring_end[r]; v++) fprintf(f, "%.17g %.17g,", set->xy[2 * v], set->xy[2 * v + 1]);
            fprintf(f, "%.17g %.17g)", set->xy[2 * first], set->xy[2 * first + 1]);
        }
        fputc(')', f);
    }
    fputc(')', f);
    fclose(f);
    return text;
}

sunder_shape *polyset_shape(const polyset *set)
{
    sunder_shape *shape = NULL;
    sunder_error err;
    if (sunder_shape_from_rings(set->xy, set->ring_end, set->poly_end, set->polygons, SUNDER_VALIDITY_STRICT, &shape,
                                &err) != SUNDER_OK) {
        char *wkt = polyset_wkt(set);
        fprintf(stderr, "no shape: %s\n  %s\n", err.message, wkt);
        free(wkt);
        return NULL;
    }
    return shape;
}

sunder_shape *polyset_turned_rectangle(double x, double y, double w, double h, double angle)
{
    const double e[2] = {cos(angle), sin(angle)};
    polyset set = {0};
    polyset_polygon(&set,
                    (double[]){x, y, x + w * e[0], y + w * e[1], x + w * e[0] - h * e[1], y + w * e[1] + h * e[0],
                               x - h * e[1], y + h * e[0]},
                    4);
    sunder_shape *shape = polyset_shape(&set);
    polyset_free(&set);
    return shape;
}

sunder_shape *polyset_shape_of_wkt(const char *wkt)
{
    polyset set;
    if (!polyset_read_wkt(&set, wkt, NULL)) return NULL;
    sunder_shape *shape = polyset_shape(&set);
    polyset_free(&set);
    return shape;
}

char *test_read_file(const char *path)
{
    FILE *f = fopen(path, "rb");
    if (!f) return NULL;
    char *text = NULL;
    size_t n = 0, got;
    do {
        text = test_resize(text, n + 65536 + 1, 1);
        got = fread(text + n, 1, 65536, f);
        n += got;
    } while (got);
    fclose(f);
    text[n] = '\0';
    return text;
}
