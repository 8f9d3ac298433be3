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
    uint32_t q; /* the body of b */
    double clearance;
    bool shadow;
    size_t way, ways;
    double box[4]; /* of what limits leave of it */
} sunder_i_plane_obstacle;

typedef struct sunder_i_plane {
    sunder_i_branching *c;
    uint32_t p, q; /* bodies; q: SUNDER_I_GROUND: all that stands */
    uint32_t i, j; /* their places */
    double reach;
    sunder_i_plane_region disc; /* the polygon around that */
    sunder_i_plane_obstacle *obstacle;
    size_t obstacles, obstacle_capacity;
    sunder_i_way *way;
    size_t ways, way_capacity;
    uint32_t *list; /* of obstacles that meet the region at hand, and those above it */
    size_t listed, list_capacity;
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

/* What forbids moves of g->p beside that body; and beside all that stands within reach. False if memory is out. */
bool sunder_i_plane_add_body(sunder_i_plane *plane, uint32_t q);
bool sunder_i_plane_add_ground(sunder_i_plane *plane);

#endif
