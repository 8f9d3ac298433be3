/* culling_inner.h: the builder, and tests of boxes, shared by the files of the culling. Used by culling*.c only. */
#ifndef SUNDER_I_CULLING_INNER_H
#define SUNDER_I_CULLING_INNER_H

#include "outline/culling.h"

#include "base/extremes.h"
#include "number/trust.h"

#include <math.h>

/* A side in doubles, in the units of sunder_i_approx(): its start and its vector. */
typedef struct approx_side {
    double ax, ay, dx, dy;
} approx_side;

typedef struct box {
    double low[2], high[2];
} box;

typedef struct entry {
    uint32_t part, runs; /* the part's number of entries in the list of runs */
} entry;

/* A run: consecutive sides of one part whose vectors are in one quadrant, so that the box of the run is that of its two
 * ends. If operands have many sides, as rounded ones do, one test usually decides a whole run; a run is divided where a
 * cell becomes as small as the run. */
typedef uint32_t run; /* the bits above RUN_BITS are its length minus one, those below its first side; a single side is
                       * its own number */

#define RUN_BITS 27 /* with more sides than these bits can number, every run is a single side */

typedef struct cell {
    box b;
    size_t entry_from, entry_to, run_from, run_to;
    size_t sides; /* the number of sides of all its runs */
    uint32_t stubborn;
    int axis;      /* the axis across which it is divided */
    double share;  /* its fraction of the work, each half counting as half of its parent */
    double growth; /* see growth_of() */
    double trial;  /* for a cell that is divided on trial its number of pairs of a line and a part; else 0 */
} cell;

/* A cell that is divided although its pairs increase: nested features, or many that overlap deeply, separate only in
 * cells as small as their distances, and may multiply before. If the trial costs more than half of what
 * the cell's own pairs cost, everything is restored as if the cell had not been divided. */
typedef struct trial {
    bool on;
    cell of;
    size_t stack_n; /* the members below: the state before the trial */
    sunder_i_pairs_mark pairs;
    double done, spent;
} trial;

/* A candidate, and the part of the current box that it may pass through. */
typedef struct crossing {
    uint32_t side, line;
    box clipped;
} crossing;

/* A part that is only a half-plane in half a cell: the widest one so far in its direction. */
typedef struct half_plane {
    uint32_t stamp, side;
    double depth;        /* the depth of the half's centre in it, in a measure that parallel sides have in common */
    uint32_t entry, run; /* its positions in the half's lists */
} half_plane;

/* Marks of a candidate while the cells are processed. PASSES: it passes through a leaf of several parts. ALONE: it
 * passes through a leaf of its own part only. CONTESTED: in some cell another part covers it, or stands for it. */
enum { PASSES = 1, ALONE = 2, CONTESTED = 4 };

typedef struct builder {
    run single_most;    /* the largest number of a run that is a single side */
    uint32_t run_shift; /* RUN_BITS, or 32 if every run is a single side */
    const sunder_i_convex_pieces *parts;
    const sunder_i_lines *lines;
    const sunder_sum_options *options;
    sunder_i_culled *out;
    approx_side *side;
    uint32_t *before; /* [sides + 1] the number of candidates before each side */
    box *reach;       /* [parts] bounding boxes, enlarged by the error */
    double error;     /* a bound of the error of a distance from a start point, see filter_part() */
    entry *entries;   /* the lists of all cells on the stack, one after the other */
    size_t entries_n, entries_capacity;
    run *runs;
    size_t runs_n, runs_capacity;
    crossing *crossing; /* the candidates of the current box */
    size_t crossing_n;
    cell *stack;
    size_t stack_n, stack_capacity;
    trial trial;
    uint32_t *stamp;    /* [lines] the last cell that counted the line */
    half_plane *widest; /* [2 * classes] indexed by rank */
    uint64_t *recent;   /* [2^recent_bits] recently pushed pairs; UINT64_MAX: none */
    int recent_bits;
    bool *shared;   /* [lines] whether in some cell one part stands for several along the line */
    uint32_t cells; /* the number of stamps used */
    double done;    /* the fraction of the work that is done, for progress */
    bool no_memory;
} builder;

static inline uint32_t run_from(const builder *b, run r) { return r & b->single_most; }

static inline uint32_t run_end(const builder *b, run r)
{
    return (r & b->single_most) + (uint32_t)((uint64_t)r >> b->run_shift) + 1;
}

static const box nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

static inline void grow_box(box *all, const box *by)
{
    for (int k = 0; k < 2; k++) {
        all->low[k] = sunder_i_lesser(all->low[k], by->low[k]);
        all->high[k] = sunder_i_greater(all->high[k], by->high[k]);
    }
}

static inline void widen_box(box *b, double by)
{
    for (int k = 0; k < 2; k++) {
        b->low[k] -= by;
        b->high[k] += by;
    }
}

static inline bool boxes_apart(const box *a, const box *b)
{
    return a->low[0] > b->high[0] || a->high[0] < b->low[0] || a->low[1] > b->high[1] || a->high[1] < b->low[1];
}

static inline bool box_within(const box *a, const box *b)
{
    return a->low[0] >= b->low[0] && a->high[0] <= b->high[0] && a->low[1] >= b->low[1] && a->high[1] <= b->high[1];
}

/* Sets *clipped to the intersection of a box with the segment's box. Returns false if it is empty. */
static inline bool clip_by_side(const builder *b, const approx_side *s, const box *c, box *clipped)
{
    const double x2 = s->ax + s->dx, y2 = s->ay + s->dy, e = b->error;
    clipped->low[0] = sunder_i_greater(c->low[0], sunder_i_lesser(s->ax, x2) - e);
    clipped->high[0] = sunder_i_lesser(c->high[0], sunder_i_greater(s->ax, x2) + e);
    clipped->low[1] = sunder_i_greater(c->low[1], sunder_i_lesser(s->ay, y2) - e);
    clipped->high[1] = sunder_i_lesser(c->high[1], sunder_i_greater(s->ay, y2) + e);
    return clipped->low[0] <= clipped->high[0] && clipped->low[1] <= clipped->high[1];
}

/* ---- culling_root.c ---- */

/* Computes the doubles of all sides, and the root with every side of every part, the largest part first. Returns false
 * if out of memory. */
bool sunder_i_cells_root(builder *b, cell *root);

/* ---- culling_close.c: cells that are not divided further ---- */

/* Empties the table of recently pushed pairs. */
void sunder_i_cells_forget_pairs(builder *b);
/* Sets b->crossing to the candidates of some runs that pass through a box. */
void sunder_i_cells_gather(builder *b, size_t from, size_t to, const box *c);
/* Records that the part of a candidate side in the current half is inside a part. */
void sunder_i_cells_cover(builder *b, uint32_t side, uint32_t part);
/* Closes a box that is inside `one`, or inside `one` and `other` together. */
void sunder_i_cells_close(builder *b, const cell *parent, const box *c, uint32_t one, uint32_t other);
/* Records a leaf that only one part meets. */
void sunder_i_cells_lone_leaf(builder *b, const cell *c);
/* Records a leaf that several parts meet; its candidates have been gathered. */
void sunder_i_cells_open_leaf(builder *b, const cell *c);
/* If the trial costs more than half of what its cell's own pairs cost, ends it and makes the cell a leaf. */
void sunder_i_cells_end_trial(builder *b);
/* The last step: converts marks to results. Returns false if out of memory. */
bool sunder_i_cells_fates(builder *b);

#endif
