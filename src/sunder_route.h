/* sunder_route.h: the shortest route of a polygonal robot among obstacles. Part of sunder.h, which states the
 * conventions. */
#ifndef SUNDER_ROUTE_H
#define SUNDER_ROUTE_H

#include "sunder_sum.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Routes ----------------------------------------------------------------------------------------------- */

/* An exact place. Coordinate k is the rational text[k], "num" or "num/den" in decimal, or xy[k] if text[k] is NULL. */
typedef struct sunder_place {
    double xy[2];
    const char *text[2];
} sunder_place;

/* Options of routes. The defaults are all zero, except for the size. */
typedef struct sunder_route_options {
    size_t size; /* sizeof(sunder_route_options) */
    double gap;  /* >= 0 and finite; the robot is grown by a polygon of 64 sides around the disc of radius gap */
    sunder_progress progress; /* NULL: none */
    void *progress_user;
} sunder_route_options;

SUNDER_API void sunder_route_options_init_sized(sunder_route_options *options, size_t size);
static inline void sunder_route_options_init(sunder_route_options *options)
{
    sunder_route_options_init_sized(options, sizeof *options);
}

typedef enum sunder_route_status {
    SUNDER_ROUTE_FOUND,
    SUNDER_ROUTE_START_COLLIDES, /* at the start the robot's interior meets an obstacle */
    SUNDER_ROUTE_GOAL_COLLIDES,
    SUNDER_ROUTE_DISCONNECTED /* start and goal lie in different components of free space */
} sunder_route_status;

/* "found", "start_in_collision", "goal_in_collision", "disconnected". */
SUNDER_API const char *sunder_route_status_string(sunder_route_status reason);

typedef struct sunder_route sunder_route;

/* Finds a shortest path along which the robot can be translated among the obstacles.
 *
 * Free space is the complement of the union of the open sets O_i + int(-robot), so it is closed. Contact is allowed:
 * the robot may go through a passage, or be at a place, that it fits exactly. The path is that of the robot's origin.
 * Of several shortest paths it is the lexicographically smallest sequence of vertices; lengths that differ by at most
 * 2^-256 of themselves count as equal. A separate test proves of each leg that the interior of the robot meets no
 * obstacle.
 *
 * obstacles  n obstacles, which have to be valid during the call only.
 * robot      It must not be empty. Members may touch and overlap, and holes are allowed. (There is one exception to
 *            exactness, for obstacles without area only: if members cross in places that are not doubles, a wall that
 *            two members share does not count as interior.)
 * from, to   The places of the robot's origin at the start and at the goal.
 * out        A new route, freed by the caller with sunder_route_free(). There is one on success even if no path exists:
 *            see sunder_route_reason().
 * Fails      SUNDER_EARG for an argument out of its range, SUNDER_ENOMEM, SUNDER_ECANCEL; SUNDER_EINVALID for an
 *            obstacle with a coordinate that is not finite, SUNDER_ERANGE for a place too far away to be compared.
 * Source     [LW79] for the graph, [HNR68] for the search; see src/motion/README.
 * Cost       That of a sum for the outline of the union; then that of A* over its corners, which examines only edges
 *            that may belong to a shortest path. */
SUNDER_API sunder_status sunder_route_find(const sunder_obstacle *obstacles, size_t n, const sunder_shape *robot,
                                           const sunder_place *from, const sunder_place *to,
                                           const sunder_route_options *options, sunder_route **out, sunder_error *err);
SUNDER_API void sunder_route_free(sunder_route *route);

/* Returns whether a path was found, or why there is none. If obstacle is not NULL, *obstacle is set to the first
 * obstacle that the robot meets at the start or goal, or to SIZE_MAX if there is none. */
SUNDER_API sunder_route_status sunder_route_reason(const sunder_route *route, size_t *obstacle);
/* Returns the number of vertices of the path, including start and goal; 1 if these are the same, 0 without a path. */
SUNDER_API size_t sunder_route_vertices(const sunder_route *route);
/* Set the coordinates of a vertex of the path: the nearest doubles, and exact texts "num" or "num/den", which the route
 * owns. */
SUNDER_API void sunder_route_vertex(const sunder_route *route, size_t vertex, double xy[2]);
SUNDER_API void sunder_route_vertex_text(const sunder_route *route, size_t vertex, const char **x, const char **y);
/* Returns the length of the path, rounded to the nearest double; 0 if there is no path. */
SUNDER_API double sunder_route_length(const sunder_route *route);
/* Returns whether the path is also free if its vertices are rounded to the nearest doubles; proved like the path. */
SUNDER_API bool sunder_route_rounded_is_free(const sunder_route *route);
/* Returns the union of the obstacles of configuration space, as a sum with its degenerate holes. The route owns it. */
SUNDER_API const sunder_sum *sunder_route_obstacles(const sunder_route *route);

#ifdef __cplusplus
}
#endif
#endif
