/* One vertex for each place: points found on different lines are compared exactly. */
#ifndef SUNDER_I_VERTEX_TABLE_H
#define SUNDER_I_VERTEX_TABLE_H

#include "predicate/predicate.h"

typedef struct sunder_i_vertex_table {
    sunder_i_lattice *lattice;
    sunder_i_hpoint *point; /* one of each place, in order of first appearance */
    size_t n, capacity;
    size_t entered; /* how many are in the table, at least */
    uint32_t *slot; /* hash table: number of a place + 1, or 0 */
    size_t mask;
    bool exact;      /* hashes are of exact coordinates; else of squares of the grid */
    double per_step; /* squares of the grid for each unit: below 2^40 in all */
    double error;    /* of an approximate coordinate */
} sunder_i_vertex_table;

#define SUNDER_I_NO_VERTEX UINT32_MAX

/* most: a bound on the approximate coordinates; expected: a guess at how many places; appended: and how many of
 * those that are appended. False if memory is out. */
bool sunder_i_vertex_table_init(sunder_i_vertex_table *table, sunder_i_lattice *lattice, double most, size_t expected,
                                size_t appended);
/* The number of the place of p, made if it is new; SUNDER_I_NO_VERTEX if memory is out. */
uint32_t sunder_i_vertex_table_add(sunder_i_vertex_table *table, const sunder_i_hpoint *p);
/* The same for a point that is known to be new and never to be asked for again. */
uint32_t sunder_i_vertex_table_append(sunder_i_vertex_table *table, const sunder_i_hpoint *p);
void sunder_i_vertex_table_free(sunder_i_vertex_table *table);

#endif
