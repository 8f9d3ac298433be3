/* What the culling files share: the builder, and tests of boxes. Internal to culling*.c. */
#ifndef SUNDER_I_CULLING_INNER_H
#define SUNDER_I_CULLING_INNER_H

#include "outline/culling.h"

#include "base/extremes.h"
#include "number/trust.h"

#include <math.h>

/* A side as doubles, in the units of sunder_i_approx(): where it starts and its vector. */
typedef struct approx_side {
    double ax, ay, dx, dy;
} approx_side;

typedef struct box {
    double low[2], high[2];
} box;

typedef struct entry {
    uint32_t part, runs; /* how many entries of the run list belong to it */
} entry;

/* Consecutive sides of one part whose vectors lie in one quadrant: they climb or fall together, so the box of the run
 * is that of its ends. Where operands have many sides, as rounded ones do, one test mostly settles a whole run; a run
 * is split where a cell becomes as small as the run. */
typedef uint32_t run; /* its length less one above RUN_BITS, its first side below; a single side is its own number */

#define RUN_BITS 27 /* with more sides than these bits can number, every run is a single side */

typedef struct cell {
    box b;
    size_t entry_from, entry_to, run_from, run_to;
    size_t sides; /* of all its runs */
    uint32_t stubborn;
    int axis;      /* to split across */
    double share;  /* of the whole work, taking each half as half of its parent's */
    double growth; /* see growth_of() */
    double trial;  /* the pairs of a line and a part of one that is split on trial only; else 0 */
} cell;

/* A cell that is split although its pairs grow: nested features, or many that overlap deeply, separate only in cells as
 * small as their distances, and may multiply on the way there. If the trial takes more than the cell's own pairs,
 * everything is restored as if the cell had never been split. */
typedef struct trial {
    bool on;
    cell of;
    size_t stack_n; /* counts before the trial */
    sunder_i_pairs_mark pairs;
    double done, spent;
} trial;

/* A candidate, and the part of the current box that it may pass through. */
typedef struct crossing {
    uint32_t side, line;
    box clipped;
} crossing;

/* A part that is no more than a half-plane in half a cell: the widest so far in its direction. */
typedef struct half_plane {
    uint32_t stamp, side;
    double depth;        /* of the half's centre in it, in a measure that parallel sides have in common */
    uint32_t entry, run; /* where it stands in the half's lists */
} half_plane;

/* Marks of a candidate while the cells are made: it passes through a leaf of several parts; it passes through a leaf of
 * its own part alone; it does not, in some cell, tell everything about its line. */
enum { PASSES = 1, ALONE = 2, CONTESTED = 4 };

typedef struct builder {
    run single_most;    /* the greatest number of a single side */
    uint32_t run_shift; /* RUN_BITS, or past the number */
    const sunder_i_convex_pieces *parts;
    const sunder_i_lines *lines;
    const sunder_sum_options *options;
    sunder_i_culled *out;
    approx_side *side;
    uint32_t *before; /* [sides + 1] how many candidates there are before each side */
    box *reach;       /* [parts] bounding boxes, widened by the error */
    double error;     /* bound on the distance error of a start point, see filter_part() */
    entry *entries;   /* lists of all cells on the stack, one after the other */
    size_t entries_n, entries_capacity;
    run *runs;
    size_t runs_n, runs_capacity;
    crossing *crossing; /* of the box at hand */
    size_t crossing_n;
    cell *stack;
    size_t stack_n, stack_capacity;
    trial trial;
    uint32_t *stamp;    /* [lines] the last cell that counted the line */
    half_plane *widest; /* [2 * classes] by rank */
    uint64_t *recent;   /* [2^recent_bits] recently pushed pairs; UINT64_MAX: none */
    int recent_bits;
    bool *shared;   /* [lines] somewhere one part stands for several along the line */
    uint32_t cells; /* stamps given out */
    double done;    /* share of the work, for progress */
    bool no_memory;
} builder;

static inline uint32_t run_from(const builder *b, run r) { return r & b->single_most; }

static inline uint32_t run_end(const builder *b, run r)
{
    return (r & b->single_most) + (uint32_t)((uint64_t)r >> b->run_shift) + 1;
}

static const box nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

static inline void grow(box *all, const box *by)
{
    for (int k = 0; k < 2; k++) {
        all->low[k] = sunder_i_lesser(all->low[k], by->low[k]);
        all->high[k] = sunder_i_greater(all->high[k], by->high[k]);
    }
}

static inline void widen(box *b, double by)
{
    for (int k = 0; k < 2; k++) {
        b->low[k] -= by;
        b->high[k] += by;
    }
}

static inline bool apart(const box *a, const box *b)
{
    return a->low[0] > b->high[0] || a->high[0] < b->low[0] || a->low[1] > b->high[1] || a->high[1] < b->low[1];
}

static inline bool within(const box *a, const box *b)
{
    return a->low[0] >= b->low[0] && a->high[0] <= b->high[0] && a->low[1] >= b->low[1] && a->high[1] <= b->high[1];
}

/* What of a box the segment's own box covers; false if there is none. */
static inline bool clip(const builder *b, const approx_side *s, const box *c, box *clipped)
{
    const double x2 = s->ax + s->dx, y2 = s->ay + s->dy, e = b->error;
    clipped->low[0] = sunder_i_greater(c->low[0], sunder_i_lesser(s->ax, x2) - e);
    clipped->high[0] = sunder_i_lesser(c->high[0], sunder_i_greater(s->ax, x2) + e);
    clipped->low[1] = sunder_i_greater(c->low[1], sunder_i_lesser(s->ay, y2) - e);
    clipped->high[1] = sunder_i_lesser(c->high[1], sunder_i_greater(s->ay, y2) + e);
    return clipped->low[0] <= clipped->high[0] && clipped->low[1] <= clipped->high[1];
}

/* ---- culling_root.c ---- */

/* Doubles of all sides, and the root: every side of every part, the largest first. False if memory is out. */
bool sunder_i_cells_root(builder *b, cell *root);

/* ---- culling_close.c: what becomes of cells that are not split further ---- */

/* Empties the table of recently pushed pairs. */
void sunder_i_cells_forget_pairs(builder *b);
/* Lists the candidates of some runs that pass through a box: b->crossing. */
void sunder_i_cells_gather(builder *b, size_t from, size_t to, const box *c);
/* The part of a candidate side that lies in the current half is inside a part. */
void sunder_i_cells_cover(builder *b, uint32_t side, uint32_t part);
/* The box is inside `one`, or inside `one` and `other` together. */
void sunder_i_cells_close(builder *b, const cell *parent, const box *c, uint32_t one, uint32_t other);
/* Only one part reaches into the leaf. */
void sunder_i_cells_lone_leaf(builder *b, const cell *c);
/* Several parts reach into the leaf; its candidates are gathered. */
void sunder_i_cells_open_leaf(builder *b, const cell *c);
/* Ends the trial if it has taken too long: its cell is left as it was. */
void sunder_i_cells_end_trial(builder *b);
/* Last step: turns marks into verdicts. False if memory is out. */
bool sunder_i_cells_fates(builder *b);

#endif
