/* The plane of one relative move: its regions, and the obstacles in it; see plane.c. */
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

/* An obstacle: a convex set that is forbidden, the set behind all of its half-planes. */
typedef struct sunder_i_plane_obstacle {
    const sunder_i_body_piece *a, *b;
    uint32_t q;  /* the body of b */
    bool shadow; /* it is the shadow from an anchor or a side anchor */
    bool made;   /* its half-planes have been made; none if limits leave nothing of the obstacle */
    double clearance;
    size_t half_plane, half_planes;
    uint32_t run, rank; /* rank: its place among the obstacles found, the same for all clearances */
} sunder_i_plane_obstacle;

/* Consecutive obstacles between the same two things f and g (features or parts of barriers), which have to keep from
 * each other a distance, or where f may not pass g: all are forbidden, or none. The full distance and a reduced
 * requirement have a run each, so that neither has to be made again. */
typedef struct sunder_i_plane_run {
    uint32_t f, g;
    bool shadow, side;
    bool made;  /* the obstacles of which limits may leave something are listed, for this clearance */
    bool asked; /* its obstacles are forbidden in the present question */
    double clearance;
    size_t first, end;
    size_t reached; /* the number of obstacles of which limits may leave something */
    uint32_t next;  /* the run of the same obstacles for another clearance; 0: none */
    uint64_t cost;  /* the cost of making them, in constraints examined */
} sunder_i_plane_run;

/* An obstacle of which limits may leave something: its box, number and run. */
typedef struct sunder_i_plane_item {
    double box[4];
    uint32_t at, run;
} sunder_i_plane_item;

/* The obstacle chosen to divide a region, and the area of the region that it covers; SUNDER_I_NO_CHOICE: none contains
 * the middle. */
#define SUNDER_I_NO_CHOICE UINT32_MAX
typedef struct sunder_i_plane_choice {
    double share;
    uint32_t obstacle, below; /* below: the index, in `region`, of the first region that its half-planes leave */
} sunder_i_plane_choice;

/* The obstacles by which one question divided its regions, from the whole plane down. */
typedef struct sunder_i_plane_choices {
    sunder_i_plane_choice *choice;
    uint32_t *region; /* the choice for each region; SUNDER_I_NO_CHOICE: none was made. The first region is the whole
                       * plane */
    bool *asked;      /* [runs] forbidden in that question */
    size_t n, capacity, regions, region_capacity, runs, run_capacity;
} sunder_i_plane_choices;

/* The obstacles in the plane of one relative move, kept from question to question: half-planes are made when first
 * needed. */
struct sunder_i_plane_kept {
    uint32_t p, q; /* bodies; q is SUNDER_I_GROUND for all fixed things */
    double reach, coarse;
    sunder_i_plane_obstacle *obstacle;
    double *box; /* [4 * obstacles] the box of what limits leave of each, tight once half-planes are made; empty if
                  * nothing */
    size_t n, capacity, box_capacity;
    sunder_i_plane_run *run; /* the runs that were found come first */
    size_t found, runs, run_capacity;
    /* All obstacles that were listed: first those in the tree of boxes, in the order of a space-filling curve, then
     * later ones, unordered. */
    sunder_i_plane_item *item;
    size_t items, item_capacity;
    sunder_i_box_tree tree;
    size_t most_asked;                /* the greatest number of obstacles forbidden in one question */
    sunder_i_plane_choices proofs[2]; /* the last proved questions: one with many obstacles and one with few */
    sunder_i_half_plane *half_plane;
    size_t half_planes, half_plane_capacity;
    uint64_t looked[3]; /* [PIECES, JUMPS, SIDES] the cost of finding the obstacles that are pieces, shadows from
                         * anchors, and shadows at sides of barriers; each question is charged for it, also if they are
                         * known already */
};

typedef struct sunder_i_plane {
    sunder_i_branching *c;
    uint32_t p, q; /* bodies; q is SUNDER_I_GROUND for all fixed things */
    uint32_t i, j; /* their places */
    double reach;
    sunder_i_plane_region disc; /* the polygon around the disc of radius `reach` */
    struct sunder_i_plane_kept *kept;
    uint32_t *run; /* the forbidden runs, in order of discovery */
    size_t runs, run_capacity;
    size_t obstacles; /* the number of their obstacles in reach */
    bool are_few;
    sunder_i_plane_item *few; /* if there are few: all of these obstacles */
    size_t few_capacity;
    sunder_i_plane_item **place; /* the obstacles whose boxes contain the place that is tested */
    size_t about_place, place_capacity;
    const sunder_i_plane_choices *known; /* NULL, or the choices of a cached question that is nearly the same */
    sunder_i_plane_item *fresh;          /* obstacles that are forbidden now but were not in that question */
    size_t freshes, fresh_capacity;
    sunder_i_plane_choices made; /* the choices of the present question */
    bool seam;                   /* two claims left a line or a point of a region */
    unsigned thin;               /* the number of times that the present region was only a sliver */
    double free[2];              /* a free place, if that is the answer */
} sunder_i_plane;

/* ---- plane_region.c ---------------------------------------------------------------------------------------------- */

static inline double sunder_i_plane_at(const double n[2], const double *u) { return n[0] * u[0] + n[1] * u[1]; }

/* A polygon without claims. */
typedef struct sunder_i_plane_polygon {
    uint32_t n;
    double xy[2 * PLANE_CORNERS];
} sunder_i_plane_polygon;

static inline void sunder_i_plane_take_corners(sunder_i_plane_polygon *polygon, const sunder_i_plane_region *region)
{
    polygon->n = region->n;
    memcpy(polygon->xy, region->xy, 2 * region->n * sizeof *region->xy);
}

/* Clips the polygon to the part behind a half-plane, n.u <= d. Returns false if nothing is left. */
bool sunder_i_plane_clip_behind(sunder_i_plane_polygon *polygon, const sunder_i_half_plane *half_plane);
double sunder_i_plane_area_of(const sunder_i_plane_polygon *polygon);
/* Sets *region to a polygon around the disc of this radius. */
void sunder_i_plane_disc(sunder_i_plane_region *region, double radius);
/* Clips the region to n.u >= d, and marks the new side with `claim`. Returns false if nothing is left; then the region
 * is unchanged. If anything is cut off, `by` has the claims of the two sides at the corner with the greatest n.u. */
bool sunder_i_plane_clip(sunder_i_plane_region *region, const double n[2], double d, uint32_t claim, uint32_t by[2]);
/* Returns the distance of the region from 0, with the nearest place and the claims of the sides there. */
double sunder_i_plane_distance(const sunder_i_plane_region *region, double place[2], uint32_t by[2]);
double sunder_i_plane_area(const sunder_i_plane_region *region);
/* Sets out to a place well inside the region and the limits. nearest: the region's place nearest to 0. */
void sunder_i_plane_middle(const sunder_i_plane_region *region, const double nearest[2], double reach, double out[2]);

/* ---- plane_obstacles.c ------------------------------------------------------------------------------------------- */

/* Lists the obstacles that may forbid moves of p relative to q, or to all fixed things within reach. Returns false if
 * memory is out. */
bool sunder_i_plane_find(const sunder_i_plane *plane, struct sunder_i_plane_kept *kept);
/* Sets box to a box of what limits may leave of an obstacle, empty if nothing. */
void sunder_i_plane_bound(const sunder_i_plane *plane, const sunder_i_plane_obstacle *obstacle, double clearance,
                          double box[4]);
/* Makes the half-planes of a listed obstacle. Returns false if memory is out. */
bool sunder_i_plane_make_half_planes(sunder_i_plane *plane, size_t at);
/* Marks the obstacles that are forbidden in the present question. Returns false if memory is out. */
bool sunder_i_plane_list(sunder_i_plane *plane);

/* Is the place in the box? */
static inline bool sunder_i_plane_is_in(const double box[4], const double u[2])
{
    return (box[0] <= u[0]) & (box[2] >= u[0]) & (box[1] <= u[1]) & (box[3] >= u[1]);
}

/* ---- plane_index.c ----------------------------------------------------------------------------------------------- */

/* Adds an obstacle to the index. Returns false if memory is out. */
bool sunder_i_plane_index_add(struct sunder_i_plane_kept *kept, uint32_t at);
/* Prepares the index for the present question, after its obstacles have been marked. Returns false if memory is out. */
bool sunder_i_plane_index_begin(sunder_i_plane *plane);
/* Sets plane->place to the forbidden obstacles whose boxes contain the place u. Returns false if memory is out. */
bool sunder_i_plane_index_find(sunder_i_plane *plane, const double u[2]);

/* Appends the obstacles of a run of which limits leave something to a list of *n. Returns false if memory is out. */
bool sunder_i_plane_index_list(const struct sunder_i_plane_kept *kept, const sunder_i_plane_run *run,
                               sunder_i_plane_item **list, size_t *n, size_t *capacity);

/* ---- plane_choices.c --------------------------------------------------------------------------------------------- */

/* Sets plane->known to the choices of a proved question in which at most one in PLANE_FRESH of the present obstacles
 * was not forbidden, if there is one, and lists those obstacles in plane->fresh. Returns false if memory is out. */
bool sunder_i_plane_choices_begin(sunder_i_plane *plane);
/* Returns the choice of the cached question for its region number `region`, if the obstacle chosen then is still
 * forbidden, or if none was found: it is then the best of all obstacles except the fresh ones. Returns NULL if there is
 * no such choice. */
const sunder_i_plane_choice *sunder_i_plane_choices_known(const sunder_i_plane *plane, uint32_t region);
/* Returns the first subregion left by the choice that the cached question made for `region`, if that choice is
 * `obstacle`; else SUNDER_I_NO_CHOICE. */
uint32_t sunder_i_plane_choices_below(const sunder_i_plane *plane, uint32_t region, uint32_t obstacle);
/* Records the choice for a region of the present question. *below is the first of the regions that its half-planes
 * leave. Returns false if memory is out. */
bool sunder_i_plane_choices_add(sunder_i_plane *plane, uint32_t region, uint32_t obstacle, size_t half_planes,
                                double share, uint32_t *below);
/* If `proved`, moves plane->made, the obstacles chosen to divide the regions of this question, to the cache for
 * later questions. Returns false if memory is out. */
bool sunder_i_plane_choices_end(sunder_i_plane *plane, bool proved);
void sunder_i_plane_choices_free(sunder_i_plane_choices *choices);

/* ---- plane_choose.c ---------------------------------------------------------------------------------------------- */

/* Returns, of the obstacles that cover the place u, the one that covers most of the region, the first found of equal
 * ones; its half-planes are then in c->scratch. Returns NULL if none covers it. known: the choice for that region among
 * all obstacles that are not fresh, or NULL. */
const sunder_i_plane_obstacle *sunder_i_plane_choose(sunder_i_plane *plane, const sunder_i_plane_region *region,
                                                     const double u[2], const sunder_i_plane_choice *known,
                                                     double *share);
/* Returns the first obstacle that contains the place u by half-planes made for u; these are then in c->scratch. */
const sunder_i_plane_obstacle *sunder_i_plane_choose_closely(sunder_i_plane *plane, const double u[2],
                                                             size_t *half_planes);
/* Is the place u within two hairs of something closed, or in it? */
bool sunder_i_plane_is_at_border(sunder_i_plane *plane, const double u[2]);
/* Is the place u in no obstacle? */
bool sunder_i_plane_is_free(sunder_i_plane *plane, const double u[2]);

/* ---- corner_chord.c ---------------------------------------------------------------------------------------------- */

/* Looks for a chord across a corner that excludes the move u, which no obstacle excludes; its half-planes are then in
 * c->scratch. Returns the obstacle of its first side; NULL if there is none. */
const sunder_i_plane_obstacle *sunder_i_plane_find_chord(sunder_i_plane *plane, const double u[2],
                                                         sunder_i_chord *chord, size_t *half_planes);

/* ---- plane_kept.c ------------------------------------------------------------------------------------------------ */

/* Returns the cached data of a plane, which is created if needed. Returns NULL if memory is out. */
struct sunder_i_plane_kept *sunder_i_planes_take(sunder_i_planes *planes, const sunder_i_plane *plane);

#endif
