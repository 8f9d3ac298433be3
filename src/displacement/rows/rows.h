/* Rows: neighbours that stand side by side along a line, such as the houses of a street. They are found once, in the
 * layer as it is given, and say which bodies a reader of the map sees as aligned. See README.md. */
#ifndef SUNDER_I_ROWS_H
#define SUNDER_I_ROWS_H

#include "displacement/layer/model.h"

/* Two neighbours i and j in a row. */
typedef struct sunder_i_row_edge {
    uint32_t i, j;   /* bodies; in a row, j comes after i */
    uint32_t f, g;   /* the members of i and of j that are nearest to each other */
    double along[2]; /* a unit vector: the mean direction of the walls of f and g, towards j */
    double apart;    /* the separation of the two whole bodies along it; negative: they overlap there */
    double offset;   /* by how much g is to the left of f, seen along the row: at the front, the back or the middle,
                      * whichever is the least */
} sunder_i_row_edge;

/* The rows of a layer. The edges of a row are consecutive, and the j of one is the i of the next. A row of n bodies has
 * n - 1 edges, or n if it is a ring; a block that it passes twice counts twice here. */
typedef struct sunder_i_rows {
    sunder_i_row_edge *edge; /* [row_end[rows - 1]] */
    size_t *row_end;         /* [rows] the index past the last edge of each row */
    size_t rows;
} sunder_i_rows;

/* Finds the rows among the bodies of the model, at their original positions. The caller frees them with
 * sunder_i_rows_free(), also after a failure. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_rows_find(const sunder_i_model *model, sunder_i_rows *rows, sunder_error *err);
void sunder_i_rows_free(sunder_i_rows *rows);

/* ---- row_rule.c -------------------------------------------------------------------------------------------------- */

/* Makes the rule of rows (sunder_i_row_side) for each two neighbours that stand apart along the row and of which one
 * may move. start: the relations at the start, which tell the pairs in conflict. To be called once. Fails with
 * SUNDER_ENOMEM. */
sunder_status sunder_i_rows_make_rule(const sunder_i_rows *rows, const sunder_i_relations *start, sunder_i_model *model,
                                      sunder_error *err);

#endif
