/* One vertex for each place: points found on different lines are recognised as one by the lines that meet there, or by
 * exact comparison. */
#ifndef SUNDER_I_VERTEX_TABLE_H
#define SUNDER_I_VERTEX_TABLE_H

#include "predicate/predicate.h"

/* Lines through a point, by number: `line`, and up to two that are not parallel to it. Two such lines meet in one point
 * only, so that points with a pair of lines in common are one. */
typedef struct sunder_i_vertex_lines {
    uint32_t line, other[2];
    uint32_t others; /* how many are known */
} sunder_i_vertex_lines;

typedef struct sunder_i_vertex_slot {
    uint32_t number;      /* of the place + 1, or 0 */
    uint32_t hash;        /* of its square, or of its exact coordinates */
    uint32_t line, other; /* that meet there, as the place was found first; equal where not known */
} sunder_i_vertex_slot;

typedef struct sunder_i_vertex_table {
    sunder_i_lattice *lattice;
    sunder_i_hpoint *point; /* one of each place, in order of first appearance */
    size_t n, capacity;
    size_t entered; /* how many are in the table */
    sunder_i_vertex_slot *slot;
    size_t mask;
    bool exact;      /* hashes are of exact coordinates; else of squares of the grid */
    double per_step; /* squares of the grid for each unit: below 2^40 in all */
    double error;    /* of an approximate coordinate */
} sunder_i_vertex_table;

#define SUNDER_I_NO_VERTEX UINT32_MAX

/* most: a bound on the approximate coordinates; expected: an estimate of the number of places, and `appended` of those
 * that are appended. False if memory is out. */
bool sunder_i_vertex_table_init(sunder_i_vertex_table *table, sunder_i_lattice *lattice, double most, size_t expected,
                                size_t appended);
/* The place near (ax, ay), each off by less than three quarters of table->error, where two of these lines meet;
 * SUNDER_I_NO_VERTEX if none is known. *is_new: no known place can be this one. */
uint32_t sunder_i_vertex_table_find(const sunder_i_vertex_table *table, double ax, double ay,
                                    const sunder_i_vertex_lines *lines, bool *is_new);
/* The number of the place p on these lines (NULL: no lines are known); it is added if it is not known yet. `is_new`
 * tells that it cannot be known. SUNDER_I_NO_VERTEX if memory is out. */
uint32_t sunder_i_vertex_table_add(sunder_i_vertex_table *table, const sunder_i_hpoint *p,
                                   const sunder_i_vertex_lines *lines, bool is_new);
/* The same for a point that is certainly new and will not be looked up again. */
uint32_t sunder_i_vertex_table_append(sunder_i_vertex_table *table, const sunder_i_hpoint *p);
void sunder_i_vertex_table_free(sunder_i_vertex_table *table);

#endif
