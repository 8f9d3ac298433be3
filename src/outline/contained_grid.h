/* contained_grid.h: a grid of squares, each with the parts whose boxes meet it, to find the parts that may contain a
 * given point. Used by contained*.c only. */
#ifndef SUNDER_I_CONTAINED_GRID_H
#define SUNDER_I_CONTAINED_GRID_H

#include "convex/pieces.h"

typedef struct sunder_i_part_box {
    int64_t low[2], high[2];
} sunder_i_part_box;

/* Squares of 2^shift units, each with the parts whose boxes meet it. The units are those of a narrow lattice; on a wide
 * lattice coordinates are rounded to 60 bits of the largest one, with an error of at most `error` units. */
typedef struct sunder_i_part_grid {
    const sunder_i_convex_pieces *parts;
    const sunder_i_point *corner;
    sunder_i_point *rounded; /* the rounded corners on a wide lattice, else NULL */
    int64_t error;
    sunder_i_part_box *reach; /* [parts] the boxes of the parts */
    uint32_t *order;          /* [parts] the parts, the largest first */
    sunder_i_part_box all;
    int shift;
    uint32_t size[2];
    uint32_t *end, *list; /* [squares] the end of each square's entries in `list` */
} sunder_i_part_grid;

/* Builds the grid. `list` is NULL if the lists would need too much memory, or if all coordinates are too small. Returns
 * false if out of memory; the caller frees the grid in any case. */
bool sunder_i_part_grid_build(sunder_i_part_grid *g, const sunder_i_convex_pieces *parts);
void sunder_i_part_grid_free(sunder_i_part_grid *g);

static inline uint32_t sunder_i_part_grid_column(const sunder_i_part_grid *grid, int axis, int64_t at)
{
    return (uint32_t)((at - grid->all.low[axis]) >> grid->shift);
}

/* Returns the number of parts listed in the square of this point, initially sorted by decreasing size; *from becomes
 * their position in `list`. */
static inline uint32_t sunder_i_part_grid_at(const sunder_i_part_grid *grid, sunder_i_point p, uint32_t *from)
{
    const uint32_t x = sunder_i_part_grid_column(grid, 0, p.x), y = sunder_i_part_grid_column(grid, 1, p.y);
    const size_t square = (size_t)y * grid->size[0] + x;
    *from = square ? grid->end[square - 1] : 0;
    return grid->end[square] - *from;
}

/* Returns whether p is certainly strictly inside the box of a part. */
static inline bool sunder_i_part_grid_reaches(const sunder_i_part_grid *grid, uint32_t part, sunder_i_point p)
{
    const sunder_i_part_box *b = &grid->reach[part];
    const int64_t e = 2 * grid->error; /* the errors of the point and of the box */
    return p.x > b->low[0] + e && p.x < b->high[0] - e && p.y > b->low[1] + e && p.y < b->high[1] - e;
}

/* Returns whether the box of `other` is certainly strictly inside that of `part`. */
static inline bool sunder_i_part_grid_encloses(const sunder_i_part_grid *grid, uint32_t part, uint32_t other)
{
    const sunder_i_part_box *a = &grid->reach[part], *b = &grid->reach[other];
    const int64_t e = 2 * grid->error;
    return b->low[0] > a->low[0] + e && b->high[0] < a->high[0] - e && b->low[1] > a->low[1] + e &&
           b->high[1] < a->high[1] - e;
}

#endif
