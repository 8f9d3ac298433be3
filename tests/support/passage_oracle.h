/* Does the path of a point meet a set that does not contain its start? In rationals and by brute force; shares no code
 * with src/. */
#ifndef SUNDER_TESTS_PASSAGE_ORACLE_H
#define SUNDER_TESTS_PASSAGE_ORACLE_H

#include "even_odd.h"

#include <stdbool.h>

typedef struct oracle_edge {
    mpq_t a[2], b[2];
    size_t member;
} oracle_edge;

/* The boundary of a set, as edges in any order; each member by the even-odd rule. */
typedef struct oracle_boundary {
    oracle_edge *edge;
    size_t n, members;
} oracle_boundary;

/* The boundary of a valid set, as its rings describe it; or of the even-odd set of any rings. */
void oracle_boundary_open(oracle_boundary *boundary, const polyset *set);
void oracle_boundary_of_even_odd(oracle_boundary *boundary, const even_odd *set);
/* A line x0 y0 x1 y1 ..., which encloses nothing; n = 1: a point. */
void oracle_boundary_of_line(oracle_boundary *boundary, const double *xy, size_t n);
void oracle_boundary_close(oracle_boundary *boundary);

/* Is the point in the closed set, or on the line? */
bool oracle_holds(const oracle_boundary *boundary, const double point[2]);
/* Does the closed segment from a to a + t - s meet the boundary? */
bool oracle_way_meets(const oracle_boundary *boundary, const double a[2], const double t[2], const double s[2]);

#endif
