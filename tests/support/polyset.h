/* Polygonal sets as plain arrays, for tests: the same arrays that sunder_shape_from_rings() takes.
 *
 * Helpers here end the process on a failed allocation or a wrong call. */
#ifndef SUNDER_TESTS_POLYSET_H
#define SUNDER_TESTS_POLYSET_H

#include "sunder.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct polyset {
    double *xy; /* 2 * vertices */
    size_t vertices, rings, polygons;
    size_t *ring_end, *poly_end;
} polyset;

void *test_alloc(size_t n, size_t size);
void *test_resize(void *old, size_t n, size_t size);
/* A text made from a format, in memory from malloc(). */
char *test_format(const char *format, ...) __attribute__((format(printf, 1, 2), nonnull(1)));

void polyset_init(polyset *set);
void polyset_free(polyset *set);
void polyset_copy(polyset *to, const polyset *from);
void polyset_vertex(polyset *set, double x, double y);
void polyset_end_ring(polyset *set);
void polyset_end_polygon(polyset *set);
/* One ring of n points x0 y0 x1 y1 ... */
void polyset_ring(polyset *set, const double *xy, size_t n);
/* A whole polygon without holes. */
void polyset_polygon(polyset *set, const double *xy, size_t n);
void polyset_rectangle(polyset *set, double x0, double y0, double x1, double y1);
/* All members of other, after those of set. */
void polyset_append(polyset *set, const polyset *other);
void polyset_move(polyset *set, double dx, double dy);
void polyset_scale(polyset *set, double sx, double sy);
/* -S, every coordinate negated. */
void polyset_negate(polyset *set);
/* Every ring reversed, and starting at another vertex. */
void polyset_turn_rings(polyset *set, size_t start);
/* Is (x, y) inside a member, by the even-odd rule? Computed in doubles, so only for points that are not near edges. */
bool polyset_holds(const polyset *set, double x, double y);

/* POLYGON or MULTIPOLYGON from WKT; false if the text is anything else. *end (if not NULL): past the last character
 * read. */
bool polyset_read_wkt(polyset *set, const char *text, const char **end);
/* As WKT with 17 digits, for messages. */
char *polyset_wkt(const polyset *set);

/* The shape of these rings (strict); or NULL, with the message and the WKT on stderr. */
sunder_shape *polyset_shape(const polyset *set);
/* The shape of a rectangle of w by h with a corner at (x, y), turned about it to the left by `angle`. */
sunder_shape *polyset_turned_rectangle(double x, double y, double w, double h, double angle);
/* The shape of a text; NULL if it is not WKT, or is refused. */
sunder_shape *polyset_shape_of_wkt(const char *wkt);

/* A whole file as text; NULL if it cannot be opened. */
char *test_read_file(const char *path);

#endif
