/* The plane of one relative move: its regions, and what is forbidden in it; see plane.c. */
#ifndef SUNDER_I_PLANE_H
#define SUNDER_I_PLANE_H

#include "displacement/prove/proofs/branching.h"
#include "displacement/prove/proofs/tuning.h"
#include "spatial/box_tree.h"

#include <string.h>

#define SUNDER_I_NO_CLAIM UINT32_MAX

/* A convex polygon of relative moves, counter-clockwise, with the claim that made the side from each corner. */
typedef struct sunder_i_plane_region {
    uint32_t n;
    double xy[2 * PLANE_CORNERS];
    uint32_t claim[PLANE_CORNERS];
} sunder_i_plane_region;

/* A convex set that is forbidden: what is behind all its ways. */
typedef struct sunder_i_plane_obstacle {
    const sunder_i_body_piece *a, *b;
    uint32_t q;  /* the body of b */
    bool shadow; /* of an anchor, of a side anchor */
    bool made;   /* its ways are; none: limits leave nothing of it */
    double clearance;
    size_t way, ways;
    uint32_t run, rank; /* rank: its place among those found, the same for all clearances */
} sunder_i_plane_obstacle;

/* Consecutive obstacles between the same two features or parts of barriers, which owe each other a distance or where f
 * may not pass g: all are forbidden, or none. The full distance and a reduced requirement have a run each, so that
 * neither has to be made again. */
typedef struct sunder_i_plane_run {
    uint32_t f, g;
    bool shadow, side;
    bool made;  /* it is listed what limits may leave of it, for this clearance */
    bool asked; /* they are forbidden in the question at hand */
    double clearance;
    size_t first, end;
    size_t reached; /* that limits may leave anything of */
    uint32_t next;  /* the same for another clearance; 0: there is none */
    uint64_t cost;  /* of making them, in constraints looked at */
} sunder_i_plane_run;

/* An obstacle that limits may leave something of, its box, and its run. */
typedef struct sunder_i_plane_item {
    double box[4];
    uint32_t at, run;
} sunder_i_plane_item;

/* What was chosen to divide a region by, and how much of it that takes; SUNDER_I_NO_CHOICE: nothing held its middle. */
#define SUNDER_I_NO_CHOICE UINT32_MAX
typedef struct sunder_i_plane_choice {
    double share;
    uint32_t obstacle, below; /* below: where the regions that its ways leave begin among `region` */
} sunder_i_plane_choice;

/* The choices of one question, from all of the plane down. */
typedef struct sunder_i_plane_choices {
    sunder_i_plane_choice *choice;
    uint32_t *region; /* the choice for each; SUNDER_I_NO_CHOICE: none was made. The first is all of the plane */
    bool *asked;      /* [runs] */
    size_t n, capacity, regions, region_capacity, runs, run_capacity;
} sunder_i_plane_choices;

/* What may be forbidden in the plane of one relative move, kept from question to question: ways are made for the first
 * that asks. */
struct sunder_i_plane_kept {
    uint32_t p, q; /* bodies; q: SUNDER_I_GROUND: all that stands */
    double reach, coarse;
    sunder_i_plane_obstacle *obstacle;
    double *box; /* [4 obstacles] about what limits leave of them, close where ways are made; empty: nothing */
    size_t n, capacity, box_capacity;
    sunder_i_plane_run *run; /* first those that were found */
    size_t found, runs, run_capacity;
    /* All that were made: by a tree of boxes along a curve, and behind them, in no order, those made since. */
    sunder_i_plane_item *item;
    size_t items, item_capacity;
    sunder_i_box_tree tree;
    size_t most_asked;                /* obstacles that were forbidden in one question */
    sunder_i_plane_choices proofs[2]; /* of the last question that was proved, of many of them and of few */
    sunder_i_half_plane *way;
    size_t ways, way_capacity;
    uint64_t looked[3]; /* the counted cost of finding pieces, anchors and sides, even if cached */
};

typedef struct sunder_i_plane {
    sunder_i_branching *c;
    uint32_t p, q; /* bodies; q: SUNDER_I_GROUND: all that stands */
    uint32_t i, j; /* their places */
    double reach;
    sunder_i_plane_region disc; /* the polygon around that */
    struct sunder_i_plane_kept *kept;
    uint32_t *run; /* the forbidden pieces, in order of discovery */
    size_t runs, run_capacity;
    size_t obstacles; /* of these, in reach */
    bool are_few;
    sunder_i_plane_item *few; /* then: all of them */
    size_t few_capacity;
    sunder_i_plane_item **place; /* those in whose boxes the place is that is looked at */
    size_t about_place, place_capacity;
    const sunder_i_plane_choices *known; /* NULL, or of a question about nearly the same */
    sunder_i_plane_item *fresh;          /* pieces forbidden now that were not forbidden then */
    size_t freshes, fresh_capacity;
    sunder_i_plane_choices made; /* in the question at hand */
    unsigned thin;               /* how often the region at hand was nothing but a sliver */
    double free[2];              /* where nothing is in the way, if that is the answer */
} sunder_i_plane;

/* ---- plane_region.c ---------------------------------------------------------------------------------------------- */

static inline double sunder_i_plane_at(const double n[2], const double *u) { return n[0] * u[0] + n[1] * u[1]; }

/* The same without claims. */
typedef struct sunder_i_plane_polygon {
    uint32_t n;
    double xy[2 * PLANE_CORNERS];
} sunder_i_plane_polygon;

static inline void sunder_i_plane_take_corners(sunder_i_plane_polygon *polygon, const sunder_i_plane_region *region)
{
    polygon->n = region->n;
    memcpy(polygon->xy, region->xy, 2 * region->n * sizeof *region->xy);
}

/* Keeps what is behind a way, n.u <= d. False: that is nothing. */
bool sunder_i_plane_clip_behind(sunder_i_plane_polygon *polygon, const sunder_i_half_plane *way);
double sunder_i_plane_area_of(const sunder_i_plane_polygon *polygon);
/* The polygon around the disc of that radius. */
void sunder_i_plane_disc(sunder_i_plane_region *region, double radius);
/* Keeps what has n.u >= d, by that claim. False: that is nothing, and the region stays as it is; by: the sides next to
 * its nearest corner. */
bool sunder_i_plane_clip(sunder_i_plane_region *region, const double n[2], double d, uint32_t claim, uint32_t by[2]);
/* How far it is from no move at all, the place, and the sides that are there. */
double sunder_i_plane_distance(const sunder_i_plane_region *region, double place[2], uint32_t by[2]);
double sunder_i_plane_area(const sunder_i_plane_region *region);
/* A place well within what the region and the limits leave; nearest: its place nearest to no move. */
void sunder_i_plane_middle(const sunder_i_plane_region *region, const double nearest[2], double reach, double out[2]);

/* ---- plane_obstacles.c ------------------------------------------------------------------------------------------- */

/* Lists the pieces that may forbid moves of p relative to q, or to everything within reach. False if memory is out. */
bool sunder_i_plane_find(const sunder_i_plane *plane, struct sunder_i_plane_kept *kept);
/* A box about what limits may leave of an obstacle, empty if nothing. */
void sunder_i_plane_bound(const sunder_i_plane *plane, const sunder_i_plane_obstacle *obstacle, double clearance,
                          double box[4]);
/* Makes the ways of an obstacle that is listed. False if memory is out. */
bool sunder_i_plane_make_ways(sunder_i_plane *plane, size_t at);
/* Says what does so in the question at hand. False if memory is out. */
bool sunder_i_plane_list(sunder_i_plane *plane);

/* Is the place in the box? */
static inline bool sunder_i_plane_is_in(const double box[4], const double u[2])
{
    return (box[0] <= u[0]) & (box[2] >= u[0]) & (box[1] <= u[1]) & (box[3] >= u[1]);
}

/* ---- plane_index.c ----------------------------------------------------------------------------------------------- */

/* One more was made. False if memory is out. */
bool sunder_i_plane_index_add(struct sunder_i_plane_kept *kept, uint32_t at);
/* What is forbidden in the question at hand is known. False if memory is out. */
bool sunder_i_plane_index_begin(sunder_i_plane *plane);
/* Those that are forbidden, and in whose boxes the place is: into plane->place. False if memory is out. */
bool sunder_i_plane_index_find(sunder_i_plane *plane, const double u[2]);

/* All of a run that limits leave anything of, behind the first n of a list. False if memory is out. */
bool sunder_i_plane_index_list(const struct sunder_i_plane_kept *kept, const sunder_i_plane_run *run,
                               sunder_i_plane_item **list, size_t *n, size_t *capacity);

/* ---- plane_choices.c --------------------------------------------------------------------------------------------- */

/* Looks for a question that was proved about nearly the same. False if memory is out. */
bool sunder_i_plane_choices_begin(sunder_i_plane *plane);
/* The choice made earlier for a region, if it is still the best of the pieces forbidden then; NULL: not known. */
const sunder_i_plane_choice *sunder_i_plane_choices_known(const sunder_i_plane *plane, uint32_t region);
/* Returns the first subregion left by the choice that the known question made for `region`, if that choice is
 * `obstacle`; else SUNDER_I_NO_CHOICE. */
uint32_t sunder_i_plane_choices_below(const sunder_i_plane *plane, uint32_t region, uint32_t obstacle);
/* Notes a choice for a region of the question at hand; *below: the first of those that its ways leave. False if memory
 * is out. */
bool sunder_i_plane_choices_add(sunder_i_plane *plane, uint32_t region, uint32_t obstacle, size_t ways, double share,
                                uint32_t *below);
/* They are kept if the question was proved. False if memory is out. */
bool sunder_i_plane_choices_end(sunder_i_plane *plane, bool proved);
void sunder_i_plane_choices_free(sunder_i_plane_choices *choices);

/* ---- plane_choose.c ---------------------------------------------------------------------------------------------- */

/* Of the pieces that cover the place, the one that covers most of the region, the first found of equal ones; its ways
 * are in c->scratch then. NULL: none does. known: the choice for that region among all that are not fresh, or NULL. */
const sunder_i_plane_obstacle *sunder_i_plane_choose(sunder_i_plane *plane, const sunder_i_plane_region *region,
                                                     const double u[2], const sunder_i_plane_choice *known,
                                                     double *share);
/* The first of all that holds the place by lines that are made for that; its ways are in c->scratch then. */
const sunder_i_plane_obstacle *sunder_i_plane_choose_closely(sunder_i_plane *plane, const double u[2], size_t *ways);
/* Is nothing in the way there? */
bool sunder_i_plane_is_free(sunder_i_plane *plane, const double u[2]);

/* ---- corner_chord.c ---------------------------------------------------------------------------------------------- */

/* A chord across a corner that leaves that move out, which none of the obstacles does: its ways are in c->scratch then.
 * The obstacle of its first side; NULL: there is none. */
const sunder_i_plane_obstacle *sunder_i_plane_find_chord(sunder_i_plane *plane, const double u[2],
                                                         sunder_i_chord *chord, size_t *ways);

/* ---- plane_kept.c ------------------------------------------------------------------------------------------------ */

/* The cached data of that plane, created if needed. NULL if memory is out. */
struct sunder_i_plane_kept *sunder_i_planes_take(sunder_i_planes *planes, const sunder_i_plane *plane);

#endif
