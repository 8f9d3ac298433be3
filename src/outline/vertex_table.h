/* vertex_table.h: one vertex for each point: points found on different lines are identified by the lines that meet
 * there, or by exact comparison. */
#ifndef SUNDER_I_VERTEX_TABLE_H
#define SUNDER_I_VERTEX_TABLE_H

#include "predicate/predicate.h"

/* Lines through a point, by number: `line`, and up to two that are not parallel to it. Two such lines meet in one point
 * only, so that points with a pair of lines in common are equal. */
typedef struct sunder_i_vertex_lines {
    uint32_t line, other[2];
    uint32_t others; /* the number of known ones */
} sunder_i_vertex_lines;

typedef struct sunder_i_vertex_slot {
    uint32_t number;      /* the number of the vertex + 1, or 0 */
    uint32_t hash;        /* of its square, or of its exact coordinates */
    uint32_t line, other; /* two lines that meet there, from the first time it was found; equal if not known */
} sunder_i_vertex_slot;

typedef struct sunder_i_vertex_table {
    sunder_i_lattice *lattice;
    sunder_i_hpoint *point; /* the vertices, in the order in which they were added */
    size_t n, capacity;
    size_t entered; /* the number of vertices in the table */
    sunder_i_vertex_slot *slot;
    size_t mask;
    bool exact;      /* hashes are of exact coordinates; else of grid squares */
    double per_step; /* the number of grid squares for each unit: below 2^40 in all */
    double error;    /* a bound of the error of an approximate coordinate */
} sunder_i_vertex_table;

#define SUNDER_I_NO_VERTEX UINT32_MAX

/* Starts an empty table. most: an upper bound of the absolute values of the approximate coordinates. expected,
 * appended: estimates of the numbers of vertices that sunder_i_vertex_table_add() and sunder_i_vertex_table_append()
 * will add. Returns false if out of memory. */
bool sunder_i_vertex_table_init(sunder_i_vertex_table *table, sunder_i_lattice *lattice, double most, size_t expected,
                                size_t appended);
/* Returns the vertex near (ax, ay), whose errors are less than three quarters of table->error, at which two of these
 * lines meet; SUNDER_I_NO_VERTEX if none is known. *is_new becomes true if no known vertex can be this one. */
uint32_t sunder_i_vertex_table_find(const sunder_i_vertex_table *table, double ax, double ay,
                                    const sunder_i_vertex_lines *lines, bool *is_new);
/* Returns the number of the vertex p on these lines (NULL: no lines are known), which is added if it is not known.
 * is_new: it is certainly not known. Returns SUNDER_I_NO_VERTEX if out of memory. */
uint32_t sunder_i_vertex_table_add(sunder_i_vertex_table *table, const sunder_i_hpoint *p,
                                   const sunder_i_vertex_lines *lines, bool is_new);
/* Adds a point that is certainly new and will not be searched again. */
uint32_t sunder_i_vertex_table_append(sunder_i_vertex_table *table, const sunder_i_hpoint *p);
void sunder_i_vertex_table_free(sunder_i_vertex_table *table);

#endif
