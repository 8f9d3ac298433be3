/* Rows: neighbours that stand side by side along a line, such as the houses of a street. They are found once, in the
 * layer as it is given, and say which bodies a reader of the map sees as aligned. See README.md. */
#ifndef SUNDER_I_ROWS_H
#define SUNDER_I_ROWS_H

#include "displacement/layer/model.h"
#include "displacement/layer/placement.h"

/* Two neighbours i and j in a row. */
typedef struct sunder_i_row_edge {
    uint32_t i, j;    /* bodies; i < j */
    uint32_t f, g;    /* the members of i and of j that are nearest to each other */
    uint32_t side[2]; /* the sides of i and of j at which the edge is; a row leaves a body at side `side ^ 2` */
    double along[2];  /* a unit vector: the mean direction of the walls of f and g, towards j */
    double apart;     /* the separation of the two whole bodies along it; negative: they overlap there */
    double offset;    /* by how much j is to the left of i, seen along the row: at the front, the back or the middle,
                       * whichever is the least */
    double middle[2]; /* from the middle of the extents of i to that of j, along the row and to its left */
} sunder_i_row_edge;

/* The rows of a layer, as the pairs of neighbours in them. At each side of a body there is at most one edge. */
typedef struct sunder_i_rows {
    sunder_i_row_edge *edge; /* [edges] sorted by (i, j); after these [hidden] those with a hidden end */
    size_t edges, hidden;
    /* [bodies] The edges of a body are decided by what meets this box, if blocks are known as a whole: by all that is
     * within ROW_REACH gaps of the body, of the neighbours that it has chosen on its sides, and of those that these
     * have chosen; of given rows, by the row. NULL unless the model records reads. */
    double (*reach)[4];
} sunder_i_rows;

/* Finds the rows among the bodies of the model, at their original positions, or takes those that the layer gives. The
 * caller frees them with sunder_i_rows_free(), also after a failure. Fails with SUNDER_ENOMEM, and as
 * sunder_i_rows_take_given() does. */
sunder_status sunder_i_rows_find(const sunder_i_model *model, sunder_i_rows *rows, sunder_error *err);
void sunder_i_rows_free(sunder_i_rows *rows);
/* Puts the edges at features that are not present any more after the others. To be called once. */
sunder_status sunder_i_rows_forget_hidden(sunder_i_rows *rows, const sunder_i_model *model, sunder_error *err);

/* ---- given_rows.c ------------------------------------------------------------------------------------------------ */

/* Orders the rows that sunder_layer_set_rows() gave. Fails with SUNDER_ENOMEM, and with SUNDER_EINVALID, and the
 * caller's number of the feature in err->polygon, if two features of one block are in different rows. */
sunder_status sunder_i_rows_take_given(const sunder_i_model *model, sunder_i_rows *rows, sunder_error *err);

/* ---- row_rule.c -------------------------------------------------------------------------------------------------- */

/* Makes the rule of rows (sunder_i_row_side) for each two neighbours that stand apart along the row and of which one
 * may move. home: the placement of the start, and `start` its relations. To be called once. Fails with
 * SUNDER_ENOMEM. */
sunder_status sunder_i_rows_make_rule(const sunder_i_rows *rows, const sunder_i_placement *home,
                                      const sunder_i_relations *start, sunder_i_model *model, sunder_error *err);

/* The rule of rows for two features a and b of different bodies, as sunder_i_row_side has it for their bodies. */
typedef struct sunder_i_row_demand {
    uint32_t a, b;
    double along[2], least, least_listed;
} sunder_i_row_demand;

/* Gives a layer without rows this rule, without springs. number[k] is the caller's number of feature k, by which a and
 * b are named. To be called once. Fails with SUNDER_ENOMEM. */
sunder_status sunder_i_rows_take_rule(const sunder_i_row_demand *demand, size_t n, const uint32_t *number,
                                      sunder_i_model *model, sunder_error *err);

#endif
