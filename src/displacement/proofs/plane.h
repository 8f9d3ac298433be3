/* The plane of one relative move: its regions, and what is forbidden in it; see plane.c. */
#ifndef SUNDER_I_PLANE_H
#define SUNDER_I_PLANE_H

#include "displacement/proofs/branching.h"
#include "displacement/proofs/tuning.h"

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
    double clearance;
    size_t way, ways, room;
} sunder_i_plane_obstacle;

/* Obstacles one after the other between the same two features or parts of barriers, which owe each other or of which f
 * may not pass g: all are forbidden, or none. */
typedef struct sunder_i_plane_run {
    uint32_t f, g;
    bool shadow, side;
    bool made; /* its ways are, for this clearance */
    double clearance;
    size_t first, end;
    uint64_t cost; /* of making them, in constraints looked at */
} sunder_i_plane_run;

/* What may be forbidden in the plane of one relative move, kept from question to question: ways are made for the first
 * that asks. */
struct sunder_i_plane_kept {
    uint32_t p, q; /* bodies; q: SUNDER_I_GROUND: all that stands */
    double reach, coarse;
    sunder_i_plane_obstacle *obstacle;
    double *box; /* [4 obstacles] of what limits leave of them; empty: nothing */
    size_t n, capacity, box_capacity;
    sunder_i_plane_run *run;
    size_t runs, run_capacity;
    sunder_i_way *way;
    size_t ways, way_capacity;
    uint64_t looked[3]; /* what finding pieces, anchors and sides costs who asks, be it done before */
};

typedef struct sunder_i_plane {
    sunder_i_branching *c;
    uint32_t p, q; /* bodies; q: SUNDER_I_GROUND: all that stands */
    uint32_t i, j; /* their places */
    double reach;
    sunder_i_plane_region disc; /* the polygon around that */
    struct sunder_i_plane_kept *kept;
    /* Its obstacles that may meet the region at hand, behind those above it: first all that are forbidden. */
    uint32_t *list;
    size_t obstacles, listed, list_capacity;
    uint32_t *place; /* those of the region above in whose boxes the place is that is looked at */
    size_t about_place, place_capacity;
    unsigned thin;  /* how often the region at hand was nothing but a sliver */
    double free[2]; /* where nothing is in the way, if that is the answer */
} sunder_i_plane;

/* ---- plane_region.c ---------------------------------------------------------------------------------------------- */

static inline double sunder_i_plane_at(const double n[2], const double *u) { return n[0] * u[0] + n[1] * u[1]; }

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

/* Lists what may forbid moves of p beside q, or beside all that stands within reach. False if memory is out. */
bool sunder_i_plane_find(const sunder_i_plane *plane, struct sunder_i_plane_kept *kept);
/* Lists what does so in the question at hand. False if memory is out. */
bool sunder_i_plane_list(sunder_i_plane *plane);

/* ---- chord.c ----------------------------------------------------------------------------------------------------- */

/* A chord across a corner that leaves that move out, which none of the obstacles does: its ways are in c->scratch then.
 * The obstacle of its first side; NULL: there is none. */
const sunder_i_plane_obstacle *sunder_i_plane_find_chord(sunder_i_plane *plane, const double u[2],
                                                         sunder_i_chord *chord, size_t *ways);

/* ---- plane_kept.c ------------------------------------------------------------------------------------------------ */

/* What was kept of that plane, or is from now on. NULL if memory is out. */
struct sunder_i_plane_kept *sunder_i_planes_take(sunder_i_planes *planes, const sunder_i_plane *plane);

#endif
