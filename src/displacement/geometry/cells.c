/* Divides the plane around a target into square cells. Each cell lists the obstacles that may meet it, and names one
 * obstacle that contains it, if any.
 *
 * In a dense cluster most of the plane near the target is covered by many obstacles, so a cell somewhat smaller than an
 * obstacle is usually inside one: no place in it is free. Obstacles are convex: an obstacle misses a cell that lies
 * beyond one of its walls, and contains a cell that lies within all of them. Each wall decides this for a row of cells
 * at once. If neither is shown, the obstacle counts as meeting the cell. The cells are enlarged slightly for these
 * tests, so that the rounding of a point's position makes no difference. */
#include "displacement/geometry/cells.h"
#include "displacement/geometry/tuning.h"

#include "base/extremes.h"
#include "base/list.h"
#include "base/watch.h"
#include "spatial/box.h"

#include <math.h>
#include <string.h>

/* Sets box to the intersection of the square of half width `limit` around the target with the box of all obstacles.
 * Returns the mean size of an obstacle. */
static double find_extent(const sunder_i_obstacles *o, const double target[2], double limit, double box[4])
{
    double sum = 0;
    sunder_i_box_clear(box);
    for (size_t k = 0; k < o->n; k++) {
        const double *b = o->obstacle[k].box;
        sum += (b[2] - b[0] + b[3] - b[1]) / 2;
        sunder_i_box_join(box, b);
    }
    for (int c = 0; c < 2; c++) {
        box[c] = sunder_i_max(box[c], target[c] - limit);
        box[c + 2] = sunder_i_min(box[c + 2], target[c] + limit);
    }
    return sum / (double)o->n;
}

static bool enter_cell(sunder_i_cells *cells, uint32_t at, uint32_t obstacle, bool holds)
{
    sunder_i_cell *cell = &cells->cell[at];
    if (!sunder_i_reserve(&cells->entered, &cells->capacity, cells->entries + 1, sizeof *cells->entered)) return false;
    cells->entered[cells->entries][0] = at;
    cells->entered[cells->entries++][1] = obstacle;
    cell->n++;
    if (holds && cell->holder == SUNDER_I_NO_ENTRY) cell->holder = obstacle;
    return true;
}

/* Sorts the entries by cell. Returns false if memory is out. */
static bool sort_entries(const sunder_i_obstacles *o, sunder_i_cells *cells)
{
    const size_t n = (size_t)cells->across[0] * cells->across[1];
    cells->entry = sunder_i_alloc(cells->entries, sizeof *cells->entry);
    if (!cells->entry) return false;
    uint32_t first = 0;
    for (size_t k = 0; k < n; k++) {
        cells->cell[k].first = first;
        first += cells->cell[k].n;
        cells->cell[k].n = 0;
    }
    for (size_t k = 0; k < cells->entries; k++) {
        sunder_i_cell *cell = &cells->cell[cells->entered[k][0]];
        sunder_i_cell_entry *entry = &cells->entry[cell->first + cell->n++];
        entry->obstacle = cells->entered[k][1];
        memcpy(entry->box, o->obstacle[entry->obstacle].box, sizeof entry->box);
    }
    return true;
}

/* Returns the number of columns (c = 0) or rows (c = 1) of cells that the interval from a to b may meet; *first is the
 * first of them. */
static uint32_t range_of_cells(const sunder_i_cells *cells, int c, double a, double b, uint32_t *first)
{
    const double margin = CELL_MARGIN, most = cells->across[c];
    const double from = floor((a - cells->low[c]) / cells->side - margin),
                 to = floor((b - cells->low[c]) / cells->side + margin);
    if (!(to >= 0 && from < most)) return 0;
    *first = from > 0 ? (uint32_t)from : 0;
    return (to < most - 1 ? (uint32_t)to : cells->across[c] - 1) - *first + 1;
}

/* Tests a row of cells with the centre line y. Cells whose centres have an x within [meets[0], meets[1]] may meet the
 * obstacle, and those with an x strictly between holds[0] and holds[1] lie inside it. Returns false if no cell of the
 * row meets it. half: half the size of an enlarged cell. */
static bool cut_row(const sunder_i_obstacles *o, const sunder_i_obstacle *obstacle, double y, double half,
                    double meets[2], double holds[2])
{
    const double margin = 2 * sunder_i_obstacle_slack(obstacle);
    meets[0] = holds[0] = -INFINITY;
    meets[1] = holds[1] = INFINITY;
    for (uint32_t k = obstacle->wall; k < obstacle->wall + obstacle->walls; k++) {
        const double *n = o->wall[k].n, reach = half * (fabs(n[0]) + fabs(n[1])), left = o->wall[k].h - n[1] * y;
        if (n[0] == 0) {
            if (left + reach < 0) return false;
            if (!(left - reach > margin)) holds[1] = -INFINITY;
            continue;
        }
        const int c = n[0] > 0;
        const double each = 1 / n[0], far = (left + reach) * each, near = (left - reach - margin) * each;
        if (c ? far < meets[1] : far > meets[0]) meets[c] = far;
        if (c ? near < holds[1] : near > holds[0]) holds[c] = near;
    }
    return meets[0] <= meets[1];
}

static bool enter_obstacle(const sunder_i_obstacles *o, uint32_t k, sunder_i_cells *cells)
{
    const sunder_i_obstacle *obstacle = &o->obstacle[k];
    const double half = cells->side * (0.5 + CELL_MARGIN), *box = obstacle->box;
    uint32_t i, j;
    const uint32_t columns = range_of_cells(cells, 0, box[0], box[2], &i),
                   rows = range_of_cells(cells, 1, box[1], box[3], &j);
    for (uint32_t y = j; columns && y < j + rows; y++) {
        double meets[2], holds[2];
        uint32_t first;
        if (!cut_row(o, obstacle, cells->low[1] + (y + 0.5) * cells->side, half, meets, holds)) continue;
        /* The cells whose centres are in the interval `meets`, and no others. */
        const uint32_t n = range_of_cells(cells, 0, sunder_i_max(meets[0] - half, box[0]),
                                          sunder_i_min(meets[1] + half, box[2]), &first);
        for (uint32_t x = first; x < first + n; x++) {
            const double centre = cells->low[0] + (x + 0.5) * cells->side;
            if (centre < meets[0] || centre > meets[1]) continue;
            if (!enter_cell(cells, y * cells->across[0] + x, k, centre > holds[0] && centre < holds[1])) return false;
        }
    }
    return sunder_i_steps(1 + rows);
}

bool sunder_i_cells_make(const sunder_i_obstacles *obstacles, const double target[2], double limit,
                         sunder_i_cells *cells)
{
    double box[4];
    memset(cells, 0, sizeof *cells);
    if (obstacles->n < FEW_OBSTACLES) return true;
    const double mean = find_extent(obstacles, target, limit, box), size[2] = {box[2] - box[0], box[3] - box[1]};
    if (!(size[0] > 0 && size[1] > 0)) return true;
    double side = sunder_i_max(mean / CELLS_ACROSS, sqrt(size[0] * size[1] / (CELLS_EACH * (double)obstacles->n)));
    side = sunder_i_max(side, sunder_i_max(size[0], size[1]) / (CELLS_EACH * (double)obstacles->n));
    /* A cell must be far larger than the rounding errors of coordinates. */
    const double far = sunder_i_max(sunder_i_max(fabs(box[0]), fabs(box[2])), sunder_i_max(fabs(box[1]), fabs(box[3])));
    if (!(side > far * CELL_MARGIN) || !isfinite(side)) return true;
    cells->side = side;
    for (int c = 0; c < 2; c++) {
        cells->low[c] = box[c];
        cells->across[c] = 1 + (uint32_t)(size[c] / side);
    }
    const size_t n = (size_t)cells->across[0] * cells->across[1];
    cells->cell = sunder_i_alloc(n, sizeof *cells->cell);
    if (!cells->cell) return false;
    for (size_t k = 0; k < n; k++) cells->cell[k] = (sunder_i_cell){0, 0, SUNDER_I_NO_ENTRY};
    for (uint32_t k = 0; k < obstacles->n; k++)
        if (!enter_obstacle(obstacles, k, cells)) return false; /* stopped on request, or memory is out */
    return sort_entries(obstacles, cells);
}

void sunder_i_cells_free(sunder_i_cells *cells)
{
    sunder_i_free_all(cells->cell, cells->entry, cells->entered);
    memset(cells, 0, sizeof *cells);
}
