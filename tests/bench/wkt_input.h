/* Reads the benchmark inputs: POLYGON and MULTIPOLYGON texts into plain arrays. One header for the C programs and for
 * the C++ ones, so that both use the same numbers. */
#ifndef SUNDER_BENCH_WKT_INPUT_H
#define SUNDER_BENCH_WKT_INPUT_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct bench_set {
    double *xy;
    size_t *ring_end, *poly_end;
    size_t vertices, rings, polygons;
} bench_set;

static inline void *bench_alloc(size_t n)
{
    void *p = malloc(n ? n : 1);
    if (!p) abort();
    return p;
}

static inline void bench_set_free(bench_set *s)
{
    free(s->xy);
    free(s->ring_end);
    free(s->poly_end);
    memset(s, 0, sizeof *s);
}

/* Memory for all numbers of the text is allocated at once: counts are bounded by those of commas and brackets. */
static inline int bench_set_read(bench_set *s, const char *text)
{
    size_t commas = 2;
    int depth = 0, base = 1;
    for (const char *c = text; *c; c++) commas += *c == ',' || *c == '(';
    memset(s, 0, sizeof *s);
    s->xy = (double *)bench_alloc(2 * commas * sizeof(double));
    s->ring_end = (size_t *)bench_alloc(commas * sizeof(size_t));
    s->poly_end = (size_t *)bench_alloc(commas * sizeof(size_t));
    if (strncmp(text, "MULTIPOLYGON", 12) == 0)
        base = 2;
    else if (strncmp(text, "POLYGON", 7) != 0)
        return 0;
    const char *c = strchr(text, '(');
    size_t first = 0;
    while (c && *c && *c != '\n') {
        if (*c == '(') {
            depth++;
            if (depth == base + 1) first = s->vertices;
            c++;
        } else if (*c == ')') {
            const double *xy = s->xy;
            if (depth == base + 1) {
                const size_t n = s->vertices;
                if (n > first + 1 && xy[2 * first] == xy[2 * n - 2] && xy[2 * first + 1] == xy[2 * n - 1])
                    s->vertices--;
                s->ring_end[s->rings++] = s->vertices;
            } else if (depth == base) {
                s->poly_end[s->polygons++] = s->rings;
            }
            depth--;
            c++;
        } else if (*c == ',' || *c == ' ') {
            c++;
        } else {
            char *end;
            const double x = strtod(c, &end);
            if (end == c) return 0;
            c = end;
            const double y = strtod(c, &end);
            if (end == c) return 0;
            c = end;
            s->xy[2 * s->vertices] = x;
            s->xy[2 * s->vertices + 1] = y;
            s->vertices++;
        }
    }
    return depth == 0;
}

/* The next line of a file without its line end, NULL after the last; freed by the caller. */
static inline char *bench_line(FILE *f)
{
    size_t n = 0, room = 4096;
    char *line = (char *)bench_alloc(room);
    int c;
    while ((c = getc(f)) != EOF && c != '\n') {
        if (n + 1 == room) {
            line = (char *)realloc(line, room *= 2);
            if (!line) abort();
        }
        line[n++] = (char)c;
    }
    line[n] = '\0';
    if (n || c != EOF) return line;
    free(line);
    return NULL;
}

/* Reads two sets from the two lines of a file of a family. */
static inline int bench_pair_read(const char *path, bench_set *p, bench_set *q)
{
    FILE *f = fopen(path, "r");
    if (!f) return 0;
    char *a = bench_line(f), *b = a ? bench_line(f) : NULL;
    const int ok = a && b && bench_set_read(p, a) && bench_set_read(q, b);
    free(a);
    free(b);
    fclose(f);
    return ok;
}

/* CPU time of the thread: on a shared machine it varies less than wall-clock time. Not that of the process, which Linux
 * counts in ticks as soon as the process has a limit of CPU time. */
static inline double bench_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline int bench_order(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static inline double bench_median(double *t, size_t n)
{
    qsort(t, n, sizeof *t, bench_order);
    return n % 2 ? t[n / 2] : (t[n / 2 - 1] + t[n / 2]) / 2;
}

/* Returns the value of an environment variable, or the default. */
static inline double bench_setting(const char *name, double otherwise)
{
    const char *s = getenv(name);
    return s && *s ? atof(s) : otherwise;
}

/* Is another run needed for a median, after n runs that took `spent` seconds in all? A program that is already known to
 * be far slower than the best (SUNDER_BENCH_BEST, seconds) runs once. SUNDER_BENCH_RUNS sets the number of runs, for
 * counting. */
static inline int bench_again(size_t n, double spent)
{
    const double budget = bench_setting("SUNDER_BENCH_SECONDS", 1), best = bench_setting("SUNDER_BENCH_BEST", 0),
                 runs = bench_setting("SUNDER_BENCH_RUNS", 0);
    if (runs > 0) return (double)n < runs;
    if (n > 0 && best > 0 && spent > 3 * best * (double)n) return 0;
    return n < 3 ? n == 0 || spent < 10 * budget : n < 99 && spent < budget;
}

#endif
