/* Determines which part of a payer's masses lies on the grid after a move by whole squares: which of its own nodes, and
 * the nodes of the grid under them. */
#ifndef SUNDER_I_AREAS_WINDOW_H
#define SUNDER_I_AREAS_WINDOW_H

#include "displacement/prove/areas/areas.h"

typedef struct sunder_i_grid_window {
    size_t column, columns, row, rows; /* the range of the payer's own nodes: `column` and `row` are the first,
                                        * `columns` and `rows` one past the last */
    int64_t x, y;                      /* the node of the grid under the payer's node (0, 0); it may lie outside the
                                        * grid */
} sunder_i_grid_window;

static inline sunder_i_grid_window sunder_i_grid_window_of(const sunder_i_grid *grid, const sunder_i_masses *m,
                                                           int64_t dx, int64_t dy)
{
    const int64_t x = m->x + dx, y = m->y + dy;
    const int64_t left = x < 0 ? -x : 0, low = y < 0 ? -y : 0;
    int64_t right = (int64_t)grid->columns - x, high = (int64_t)grid->rows - y;
    if (right > (int64_t)m->columns) right = (int64_t)m->columns;
    if (high > (int64_t)m->rows) high = (int64_t)m->rows;
    if (left >= right || low >= high) return (sunder_i_grid_window){0, 0, 0, 0, x, y};
    return (sunder_i_grid_window){(size_t)left, (size_t)right, (size_t)low, (size_t)high, x, y};
}

/* Returns the index of the grid's node under the first node of row j of the window `w`. */
static inline size_t sunder_i_grid_window_node(const sunder_i_grid *grid, const sunder_i_grid_window *w, size_t j)
{
    return (size_t)(w->y + (int64_t)j) * grid->columns + (size_t)(w->x + (int64_t)w->column);
}

/* Returns a number of squares such that a payer that moves by it along either axis lies outside the grid, where all
 * prices are 0. A payer's original position lies on the grid. */
static inline int64_t sunder_i_beyond_grid(const sunder_i_grid *grid, const sunder_i_masses *m)
{
    const size_t columns = grid->columns + m->columns, rows = grid->rows + m->rows;
    return (int64_t)(columns > rows ? columns : rows);
}

#endif
