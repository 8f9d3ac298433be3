/* Random polygonal sets that are often degenerate. All are valid: rings touch at most in points; members of one set may
 * touch, share walls and overlap. */
#ifndef SUNDER_TESTS_GENERATE_H
#define SUNDER_TESTS_GENERATE_H

#include "polyset.h"
#include "random.h"

#define CELLS_MAX 8

/* A board of columns x rows rectangles, each cut in two triangles by one of its diagonals. */
typedef struct cells {
    int columns, rows;
    double x[CELLS_MAX + 1], y[CELLS_MAX + 1]; /* strictly increasing */
    bool falling[CELLS_MAX][CELLS_MAX];        /* the diagonal runs from top left to bottom right */
    bool on[CELLS_MAX][CELLS_MAX][2];          /* [column][row][lower, upper] triangle is part of the set */
} cells;

/* The outline of the triangles that are on: a member for each edge-connected part, with its holes. pinched: where a
 * part touches itself in a point, its rings run through that point (one closed walk for each side of the part);
 * otherwise different rings only meet there. bends_only: collinear vertices are left out. */
void cells_outline(polyset *set, const cells *c, bool pinched, bool bends_only);

/* The spacing of the lines of a board. */
typedef enum spacing {
    SPACING_UNIT,   /* 0, 1, 2, ... */
    SPACING_SMALL,  /* steps of 1 to 3 */
    SPACING_MAP,    /* eastings and northings with three decimals, as nearest doubles */
    SPACING_RAGGED, /* full 53-bit doubles */
    SPACING_HUGE    /* from 1e-300 to 1e300 */
} spacing;

/* A random board: squares only, or single triangles, too; `percent` of the area is on. */
void random_cells(cells *c, rng *r, int columns, int rows, spacing kind, bool triangles, int percent);

/* A board with a pocket into which -Q fits exactly, where Q is the outline of `peg`: the cells of the reflected peg are
 * off and, with slide > 0, those that it sweeps when it moves up by that many columns. The board has the same unit
 * steps as the peg. */
void pocket_for(cells *board, rng *r, const cells *peg, int slide);

/* A simple polygon of n <= 8 vertices with integer coordinates in 0..span, without vertices on other edges. */
void random_simple(polyset *set, rng *r, int n, int span);
/* A star-shaped polygon: n directions in order, random lengths up to size, integer vertices. */
void random_star(polyset *set, rng *r, int n, double size);
/* n teeth upwards with slanted sides on a base, randomly displaced; integer vertices. slant 0: the sides are
 * vertical. */
void random_comb(polyset *set, rng *r, int teeth, double size, bool slanted);
/* The comb turned on its side: for forks, with random_comb(..., false). */
void random_fork(polyset *set, rng *r, int teeth, double size, bool sideways);
/* A convex polygon: integer vertices near a circle. */
void random_convex(polyset *set, rng *r, int n, double size);
/* An L, U, T or rectangle, turned by a random angle, at map-like coordinates in doubles. */
void random_building(polyset *set, rng *r);

/* ---- Pairs of operands, by kind of degeneracy ---- */

typedef enum pair_kind {
    PAIR_SQUARES,   /* parts of a unit grid: every direction is repeated, exact fits occur by chance */
    PAIR_STEPS,     /* the same with steps of 1, 2 or 3 */
    PAIR_TRIANGLES, /* half squares: vertices on edges, rings that touch */
    PAIR_TRIANGLE_STEPS,
    PAIR_PEG,       /* an exact fit: P has a pocket of the shape of -Q */
    PAIR_SLIDE,     /* a pocket as high as the peg, and longer */
    PAIR_SLANTED,   /* boards under a linear map: repeated slanted directions */
    PAIR_SIMPLE,    /* small simple polygons */
    PAIR_MEMBERS,   /* several simple polygons that overlap and touch */
    PAIR_BOARDS,    /* several boards that overlap, touch and share walls */
    PAIR_HOLES,     /* holes on both sides, rings that touch themselves */
    PAIR_ROOMS,     /* P on a grid twice as wide as Q's: rooms, passages, corridors exactly as wide */
    PAIR_MAP,       /* boards at map coordinates with three decimals */
    PAIR_BUILDINGS, /* rotated buildings at map coordinates */
    PAIR_RAGGED,    /* boards with 53-bit spacing */
    PAIR_SELF,      /* Q is P, or -P */
    PAIR_HUGE,      /* coordinates from 1e-300 to 1e300 */
    PAIR_KINDS
} pair_kind;

const char *pair_kind_string(pair_kind kind);
void random_pair(polyset *p, polyset *q, rng *r, pair_kind kind);
/* Moves q onto p, up to a few units. */
void bring_together(const polyset *p, polyset *q, rng *r);

/* ---- Larger pairs, similar to the families of the literature ----- */

typedef enum family_kind {
    FAMILY_STAR,
    FAMILY_COMB,    /* comb + convex */
    FAMILY_SLANTED, /* slanted comb + star */
    FAMILY_FORK,    /* teeth upwards + teeth sideways */
    FAMILY_ROBOT,   /* many convex members + star */
    FAMILY_ROOMS,   /* a board with rooms + star */
    FAMILY_MAP,     /* the same at map coordinates */
    FAMILY_TOWN,    /* several buildings and the reflection of one */
    FAMILY_CELLS,   /* boards of half squares on one grid: coincident edges everywhere */
    FAMILY_KINDS
} family_kind;

const char *family_kind_string(family_kind kind);
/* Operands of about `low` to `high` vertices. */
void random_family(polyset *p, polyset *q, rng *r, family_kind kind, int low, int high);
/* ---- Invalid sets, which the even-odd rule defines -------------- */

typedef enum invalid_kind {
    INVALID_SCRIBBLE, /* a ring through random points of a small grid: it crosses itself, overlaps, touches */
    INVALID_RAGGED,   /* the same with coordinates of 53 bits */
    INVALID_ROUND,    /* a round outline at map coordinates with neighbouring vertices swapped: tiny crossings */
    INVALID_HOUSE,    /* a building with two corners swapped */
    INVALID_TRACK,    /* a path that returns to points where it was before */
    INVALID_MEMBERS,  /* two random rings of the first kind, each a member */
    INVALID_SCALED,   /* a random ring of the first kind, huge or tiny */
    INVALID_TOUCHING, /* a path of unit steps: it meets itself in vertices and runs along itself */
    INVALID_HOLES,    /* holes that cross the outer ring or each other, or are nested */
    INVALID_DOUBLED,  /* a ring that occurs two or three times, perhaps reversed or as a part of itself */
    INVALID_SPIKES,   /* a polygon with spikes on its sides */
    INVALID_KINDS
} invalid_kind;

const char *invalid_kind_string(invalid_kind kind);
/* `most` bounds the number of vertices, >= 8. */
void random_invalid(polyset *set, rng *r, invalid_kind kind, int most);

/* Writes the same set in another way: rings reversed, from another vertex, closed, with repeated vertices and vertices
 * in the middle of edges if these are exact; members and holes in another order. */
void random_dress(polyset *set, rng *r);

/* x' = a x + b y, y' = c x + d y; exact for small integers. */
void polyset_map(polyset *set, double a, double b, double c, double d);

#endif
