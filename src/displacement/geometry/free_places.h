/* Places outside a union of convex obstacles; see free_places.c. */
#ifndef SUNDER_I_FREE_PLACES_H
#define SUNDER_I_FREE_PLACES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sunder_i_obstacle_side {
    double n[2], h; /* the obstacle lies in n.x <= h */
    double from[2], to[2];
    double distance; /* from the target */
    uint32_t obstacle;
} sunder_i_obstacle_side;

typedef struct sunder_i_obstacle {
    uint32_t wall, walls;
    double box[4];
} sunder_i_obstacle;

/* What of a wall tells whether a point lies within it, and not on it: n.x < h. */
typedef struct sunder_i_obstacle_line {
    double n[2], h;
} sunder_i_obstacle_line;

/* A union of open convex polygons. */
typedef struct sunder_i_obstacles {
    sunder_i_obstacle *obstacle;
    size_t n, obstacle_capacity;
    sunder_i_obstacle_side *wall;
    size_t walls, wall_capacity;
    sunder_i_obstacle_line *line; /* of each wall */
    size_t line_capacity;
    bool failed;
} sunder_i_obstacles;

/* Nearer to a wall than this counts as on it. */
double sunder_i_obstacle_slack(const sunder_i_obstacle *obstacle);

void sunder_i_obstacles_free(sunder_i_obstacles *obstacles);
/* There are none any more; the memory stays. */
void sunder_i_obstacles_clear(sunder_i_obstacles *obstacles);
/* Adds the convex polygon d grown by gap; its round corners are replaced by tangents that contain them. */
void sunder_i_obstacles_add(sunder_i_obstacles *obstacles, const double *d, size_t n, double gap);
/* Adds again the walls and the box of an obstacle that was added before. */
void sunder_i_obstacles_add_known(sunder_i_obstacles *obstacles, const sunder_i_obstacle_side *wall, uint32_t walls,
                                  const double box[4]);
/* Local minima of the distance from target on the boundary of the free space, nearest first, at most `most` of them,
 * none beyond limit, no two nearer than `spread`. Returns how many; *steps grows by the work done, in constraints
 * looked at; *failed is set if memory is out. */
size_t sunder_i_free_places(const sunder_i_obstacles *obstacles, const double target[2], double limit, double spread,
                            size_t most, double (*places)[2], uint64_t *steps, bool *failed);

#endif
