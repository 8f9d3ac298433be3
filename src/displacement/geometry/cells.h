/* The plane around a target, divided into cells; see cells.c. */
#ifndef SUNDER_I_CELLS_H
#define SUNDER_I_CELLS_H

#include "displacement/geometry/free_places.h"

#define SUNDER_I_NO_ENTRY UINT32_MAX

typedef struct sunder_i_cell {
    uint32_t first, n; /* its entries: the obstacles that may meet it */
    uint32_t holder;   /* an obstacle that contains the whole cell; SUNDER_I_NO_ENTRY: no single one does */
} sunder_i_cell;

/* An obstacle, with a copy of its box: the boxes of up to a thousand consecutive entries are tested, and exclude most
 * obstacles. */
typedef struct sunder_i_cell_entry {
    double box[4];
    uint32_t obstacle;
} sunder_i_cell_entry;

typedef struct sunder_i_cells {
    double low[2], side;
    uint32_t across[2]; /* the numbers of columns and rows; 0: no cells were made */
    sunder_i_cell *cell;
    sunder_i_cell_entry *entry; /* the entries of all cells, one cell after the other */
    /* While cells are made: pairs (cell, obstacle). */
    uint32_t (*entered)[2];
    size_t entries, capacity;
} sunder_i_cells;

/* Makes cells for the places within `limit` of the target. None are made if that would save little. Returns false if
 * memory is out; the caller frees *cells in any case. */
bool sunder_i_cells_make(const sunder_i_obstacles *obstacles, const double target[2], double limit,
                         sunder_i_cells *cells);
void sunder_i_cells_free(sunder_i_cells *cells);

/* Sets *cell to the cell that contains x. Returns false if there is none. */
static inline bool sunder_i_cells_find(const sunder_i_cells *cells, const double x[2], uint32_t *cell)
{
    if (cells->across[0] == 0) return false;
    const double i = (x[0] - cells->low[0]) / cells->side, j = (x[1] - cells->low[1]) / cells->side;
    if (!(i >= 0 && j >= 0 && i < cells->across[0] && j < cells->across[1])) return false;
    *cell = (uint32_t)j * cells->across[0] + (uint32_t)i;
    return true;
}

#endif
