/* Places outside a union of convex obstacles; see free_places.c. */
#ifndef SUNDER_I_FREE_PLACES_H
#define SUNDER_I_FREE_PLACES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sunder_i_obstacle_side {
    double n[2], h; /* the obstacle lies in the half-plane n.x <= h */
    double from[2], to[2];
    double distance; /* of the wall from the target */
    uint32_t obstacle;
} sunder_i_obstacle_side;

typedef struct sunder_i_obstacle {
    uint32_t wall, walls;
    double box[4];
} sunder_i_obstacle;

/* A compact copy of a wall's line, for the test whether a point lies inside, strictly: n.x < h. Here h is the wall's
 * own h less sunder_i_obstacle_slack(), so that a point on the wall does not count as inside. */
typedef struct sunder_i_obstacle_line {
    double n[2], h;
} sunder_i_obstacle_line;

/* A union of open convex polygons ("obstacles"), stored with their sides ("walls"). */
typedef struct sunder_i_obstacles {
    sunder_i_obstacle *obstacle;
    size_t n, obstacle_capacity;
    sunder_i_obstacle_side *wall;
    size_t walls, wall_capacity;
    sunder_i_obstacle_line *line; /* [walls] the line of each wall */
    size_t line_capacity;
    bool (*admits)(void *user, const double place[2]); /* NULL, or asked of each place outside the union, besides */
    void *user;
    bool failed;
} sunder_i_obstacles;

/* Returns the distance from a wall of the obstacle below which a point counts as on the wall. */
double sunder_i_obstacle_slack(const sunder_i_obstacle *obstacle);

void sunder_i_obstacles_free(sunder_i_obstacles *obstacles);
/* Removes all obstacles, and what else is asked of a place; keeps the memory. */
void sunder_i_obstacles_clear(sunder_i_obstacles *obstacles);
/* Adds the convex polygon d of n corners, grown by `gap`. Its round corners are replaced by tangents, so that the grown
 * polygon is contained. A segment or a point without a gap has no interior, and is left out. */
void sunder_i_obstacles_add(sunder_i_obstacles *obstacles, const double *d, size_t n, double gap);
/* Adds an obstacle whose walls and box were computed before. */
void sunder_i_obstacles_add_known(sunder_i_obstacles *obstacles, const sunder_i_obstacle_side *wall, uint32_t walls,
                                  const double box[4]);
/* Finds places outside all obstacles, nearest to `target` first: at most `most` (and MOST_PLACES), none farther than
 * `limit`, no two within `spread` of each other. If the target itself is free it is the only one; otherwise they are
 * local minima of the distance on the boundary of the free space. Returns their number. *steps grows by the work done,
 * in constraints processed. *failed is set if memory is out or the run was stopped. */
size_t sunder_i_free_places(const sunder_i_obstacles *obstacles, const double target[2], double limit, double spread,
                            size_t most, double (*places)[2], uint64_t *steps, bool *failed);

#endif
