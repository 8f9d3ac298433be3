/* Pairs of polygonal sets whose Minkowski sums are known to be hard, each for its own reason.
 *
 * The families are those of the experiments of Agarwal, Flato and Halperin (comb, fork, star, robot, random, tight
 * passage, and the two that distinguish orders of insertion). The constructions here are our own, and are explained in
 * the files that contain them. Coordinates are integers, so degeneracies are exact. */
#ifndef FAMILY_H
#define FAMILY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "random.h"

/* A polygonal set whose members have no holes: the vertices of member i end before vertex end[i]. */
typedef struct family_set {
    int64_t *xy;
    size_t *end;
    size_t vertices, members, vertex_room, member_room;
} family_set;

/* Running out of memory ends the program: a generator has nothing better to do. */
void *family_room(void *old, size_t n, size_t size);
void family_vertex(family_set *set, int64_t x, int64_t y);
void family_end_member(family_set *set);
void family_rectangle(family_set *set, int64_t x0, int64_t y0, int64_t x1, int64_t y1);
void family_set_free(family_set *set);

/* How an integer becomes a coordinate: x / units_in_one, in decimals, after adding an origin in the same units. */
typedef struct family_place {
    int64_t units, x, y;
} family_place;

/* One line of WKT. The decimals are exact. */
bool family_print(const family_set *set, const family_place *place, FILE *out);

/* A direction: the point of the unit circle near that part of a whole turn, 0 <= turn < 1. Strictly increasing, from +
 * - * / alone. */
void family_direction(double turn, double *x, double *y);
/* Uniform in low..high, both included. */
int64_t family_integer(town_random *random, int64_t low, int64_t high);

/* Appends a strictly convex polygon of n >= 3 vertices near the circle, of that radius or as much larger as n needs. */
void family_convex_member(family_set *set, town_random *random, size_t n, int64_t cx, int64_t cy, int64_t radius);
/* Appends a polygon of n >= 3 vertices, star-shaped about the origin, spikes up to that size. */
void family_star_member(family_set *set, town_random *random, size_t n, int64_t size);

/* A family draws P with about m and Q with about n vertices, both at least FAMILY_LEAST, with a stream for each. */
enum { FAMILY_LEAST = 8 };

typedef struct family_streams {
    town_random p, q;
} family_streams;

typedef void family_draw(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams);

family_draw family_convex, family_comb, family_fork, family_slanted_fork, family_covered_fork, family_star,
    family_random, family_robot, family_fat_grid, family_fat_cover, family_tight, family_buildings, family_coast,
    family_overlap;

#endif
