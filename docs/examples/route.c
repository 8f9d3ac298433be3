/* A robot that fits a gate exactly: the shortest path of a square of side 2 through a gate of width 2, and a function
 * that is told the progress and may stop the search.
 *
 *     cc route.c $(pkg-config --cflags --libs sunder) -lm && ./a.out
 *
 * Prints:
 *
 *     (-5, -4)
 *     (-1, 0)
 *     (2, 0)
 *     (13/2, 4)
 *     length 14.6777
 */
#include <stdio.h>
#include <sunder.h>

/* Returns false to stop; here it never does. */
static bool go_on(double fraction, void *user)
{
    *(double *)user = fraction;
    return true;
}

int main(void)
{
    const double walls[] = {0, -9, 1, -9, 1, -1, 0, -1, 0, 1, 1, 1, 1, 9, 0, 9}; /* two walls, 2 apart */
    const size_t ring_end[] = {4, 8}, poly_end[] = {1, 2};
    const sunder_place from = {.xy = {-5, -4}}, to = {.text = {"13/2", "4"}}; /* doubles, or exact texts */
    sunder_shape *wall = NULL, *robot = NULL;
    sunder_route *route = NULL;
    sunder_error error;
    double fraction = 0;
    sunder_route_options options;
    sunder_route_options_init(&options);
    options.progress = go_on;
    options.progress_user = &fraction;
    sunder_status status = sunder_shape_from_rings(walls, ring_end, poly_end, 2, SUNDER_VALIDITY_STRICT, &wall, &error);
    if (!status) status = sunder_shape_rectangle(2, 2, &robot, &error);
    const sunder_obstacle obstacle = {.shape = wall};
    if (!status) status = sunder_route_find(&obstacle, 1, robot, &from, &to, &options, &route, &error);
    if (status) fprintf(stderr, "%s\n", error.message);
    for (size_t k = 0; k < (route ? sunder_route_vertices(route) : 0); k++) {
        const char *x, *y;
        sunder_route_vertex_text(route, k, &x, &y);
        printf("(%s, %s)\n", x, y);
    }
    if (route) printf("length %.4f\n", sunder_route_length(route));
    sunder_route_free(route);
    sunder_shape_free(robot);
    sunder_shape_free(wall);
    return status ? 1 : 0;
}
