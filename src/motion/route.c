/* route.c: the public functions of routes: they check the arguments, make free space, search, prove the result and
 * return its values. */
#include "motion/path_length.h"
#include "motion/shortest_path.h"

#include "base/extremes.h"
#include "base/sized_struct.h"
#include "base/watch.h"
#include "sunder_route.h"

#include <math.h>
#include <string.h>

typedef struct stop {
    double xy[2];
    char *text[2];
} stop;

struct sunder_route {
    sunder_i_free_space space;
    sunder_route_status reason;
    size_t obstacle;
    stop *stop; /* [n] the vertices of the path */
    size_t n;
    double length;
    bool rounded_is_free;
};

/* ---- Arguments ---- */

/* Converts a point of the caller to a point of the lattice, and raises the error bound of the filter to that of the
 * point's doubles. `which` names the point in messages. */
static sunder_status read_place(sunder_i_free_space *space, const sunder_place *place, const char *which,
                                sunder_i_filtered_point *out, sunder_error *err)
{
    sunder_i_lattice *l = space->filter.lattice;
    sunder_i_ratio at[2];
    for (int k = 0; k < 2; k++) {
        if (place->text[k]) {
            if (!sunder_i_ratio_parse(&l->arena, place->text[k], &at[k]))
                return sunder_i_fail(err, SUNDER_EARG, "%s: %.60s is neither a whole number nor a fraction of two",
                                     which, place->text[k]);
            continue;
        }
        if (!isfinite(place->xy[k])) return sunder_i_fail(err, SUNDER_EARG, "%s is not finite", which);
        at[k] = sunder_i_ratio_double(&l->arena, place->xy[k]);
    }
    if (l->arena.failed) return sunder_i_failure_cause(err);
    *out = sunder_i_filtered_of_rational(space->sum, l, at[0], at[1]);
    if (l->arena.failed) return sunder_i_failure_cause(err);
    const double size = sunder_i_max(fabs(out->ax), fabs(out->ay));
    if (!(size < 0x1p900)) return sunder_i_fail(err, SUNDER_ERANGE, "%s is too far away", which);
    space->filter.error = sunder_i_max(space->filter.error, 0x1p-48 * size);
    return SUNDER_OK;
}

static sunder_status check_obstacles(const sunder_obstacle *obstacles, size_t n, sunder_error *err)
{
    for (size_t i = 0; i < n; i++) {
        const sunder_obstacle *o = &obstacles[i];
        for (size_t k = 1; k < o->lines; k++)
            if (o->line_end[k] < o->line_end[k - 1])
                return sunder_i_fail(err, SUNDER_EARG, "obstacle %zu: line %zu ends before the one that it follows", i,
                                     k);
        const size_t points = o->lines ? o->line_end[o->lines - 1] : 0;
        for (size_t k = 0; k < 2 * points; k++)
            if (!isfinite(o->xy[k]))
                return sunder_i_fail(err, SUNDER_EINVALID, "obstacle %zu: point %zu is not finite", i, k / 2);
    }
    return SUNDER_OK;
}

/* ---- The result ---- */

/* Returns true if the robot at the point `at` collides with an obstacle; then `reason` and the number of the obstacle
 * are stored in r. */
static bool robot_collides(sunder_route *r, const sunder_i_filtered_point *at, sunder_route_status reason)
{
    uint32_t part;
    if (sunder_i_leg_is_free(&r->space, at, at, true, &part)) return false;
    r->reason = reason;
    r->obstacle = r->space.piece_obstacle[part / r->space.robot_pieces];
    return true;
}

static sunder_status take_stop(sunder_route *r, const sunder_i_filtered_point *at, sunder_error *err)
{
    sunder_i_arena arena = {0};
    stop *s = &r->stop[r->n];
    sunder_status status = sunder_i_sum_texts(&arena, r->space.sum, at->at, &s->text[0], &s->text[1], err);
    if (status == SUNDER_OK) {
        r->n++;
        sunder_i_sum_doubles(&arena, r->space.sum, at->at, s->xy);
        if (arena.failed) status = sunder_i_failure_cause(err);
    }
    sunder_i_arena_free(&arena);
    return status;
}

/* Proves that every leg of the path is free, and tests whether the legs are free, too, if the vertices are rounded to
 * doubles. Fails with SUNDER_EFAULT if a leg is not free. */
static sunder_status prove_path(sunder_route *r, const sunder_i_filtered_point *place, const uint32_t *path,
                                sunder_error *err)
{
    sunder_i_lattice *l = r->space.filter.lattice;
    r->rounded_is_free = true;
    for (size_t i = 0; i < r->n; i++)
        if (!isfinite(r->stop[i].xy[0]) || !isfinite(r->stop[i].xy[1])) r->rounded_is_free = false;
    for (size_t i = 0; i == 0 || i + 1 < r->n; i++) {
        const size_t j = r->n > 1 ? i + 1 : i;
        const bool is_free = sunder_i_leg_verified(&r->space, &place[path[i]], &place[path[j]]);
        if (l->arena.failed) return sunder_i_failure_cause(err);
        if (!is_free) return sunder_i_fail(err, SUNDER_EFAULT, "leg %zu of the path fails its proof", i + 1);
        if (!r->rounded_is_free) continue;
        const sunder_i_filtered_point a = sunder_i_filtered_of_double(r->space.sum, l, r->stop[i].xy);
        const sunder_i_filtered_point b = sunder_i_filtered_of_double(r->space.sum, l, r->stop[j].xy);
        r->rounded_is_free = sunder_i_leg_verified(&r->space, &a, &b);
    }
    return l->arena.failed ? sunder_i_failure_cause(err) : SUNDER_OK;
}

static sunder_status keep_path(sunder_route *r, const sunder_i_filtered_point *place, const uint32_t *path, size_t n,
                               sunder_error *err)
{
    r->stop = sunder_i_calloc(n, sizeof *r->stop);
    sunder_status status = r->stop ? SUNDER_OK : sunder_i_failure_cause(err);
    for (size_t i = 0; status == SUNDER_OK && i < n; i++) status = take_stop(r, &place[path[i]], err);
    if (status == SUNDER_OK) status = prove_path(r, place, path, err);
    if (status != SUNDER_OK) return status;
    const sunder_i_path of_places = {place, NULL, path, n};
    r->length = sunder_i_path_length(&r->space.filter, &of_places);
    return isnan(r->length) ? sunder_i_failure_cause(err) : SUNDER_OK;
}

static sunder_status find_path(sunder_route *r, sunder_i_corners *corners, const sunder_sum_options *how,
                               sunder_error *err)
{
    const uint32_t start = corners->vertices, goal = start + 1;
    if (!sunder_i_corners_connected(corners, start, goal)) {
        r->reason = SUNDER_ROUTE_DISCONNECTED;
        return SUNDER_OK;
    }
    uint32_t *path;
    size_t n;
    sunder_status status = sunder_i_shortest_path(&r->space, corners, how, &path, &n, err);
    if (status != SUNDER_OK) return status;
    status = keep_path(r, corners->place, path, n, err);
    sunder_i_free(path);
    return status;
}

static sunder_status find_route(sunder_route *r, const sunder_place *from, const sunder_place *to,
                                const sunder_sum_options *how, sunder_error *err)
{
    sunder_i_filtered_point end[2];
    sunder_status status = read_place(&r->space, from, "the start", &end[0], err);
    if (status == SUNDER_OK) status = read_place(&r->space, to, "the goal", &end[1], err);
    if (status != SUNDER_OK) return status;
    if (robot_collides(r, &end[0], SUNDER_ROUTE_START_COLLIDES) ||
        robot_collides(r, &end[1], SUNDER_ROUTE_GOAL_COLLIDES))
        return SUNDER_OK;
    if (sunder_i_filtered_cmp(&r->space.filter, &end[0], &end[1]) == 0)
        return keep_path(r, end, (uint32_t[]){0}, 1, err);
    sunder_i_corners corners;
    status = sunder_i_corners_find(&r->space, &end[0], &end[1], &corners, err);
    if (status != SUNDER_OK) return status;
    status = find_path(r, &corners, how, err);
    sunder_i_corners_free(&corners);
    return status;
}

void sunder_route_options_init_sized(sunder_route_options *options, size_t size)
{
    static const sunder_route_options defaults;
    sunder_i_options_write(options, size, &defaults, sizeof defaults);
}

sunder_status sunder_route_find(const sunder_obstacle *obstacles, size_t n, const sunder_shape *robot,
                                const sunder_place *from, const sunder_place *to, const sunder_route_options *options,
                                sunder_route **out, sunder_error *err)
{
    sunder_route_options o = {.size = sizeof o};
    sunder_status status = sunder_i_options_read(&o, sizeof o, options, err);
    if (status != SUNDER_OK) return status;
    if (!(o.gap >= 0) || !isfinite(o.gap))
        return sunder_i_fail(err, SUNDER_EARG, "the gap must be finite and not negative, not %.17g", o.gap);
    if (sunder_shape_is_empty(robot)) return sunder_i_fail(err, SUNDER_EARG, "the robot has no area");
    status = check_obstacles(obstacles, n, err);
    if (status != SUNDER_OK) return status;
    sunder_sum_options how = {.size = sizeof how, .progress = o.progress, .progress_user = o.progress_user};
    sunder_route *r = sunder_i_calloc(1, sizeof *r);
    if (!r) return sunder_i_failure_cause(err);
    r->obstacle = SIZE_MAX;
    sunder_i_watch watch;
    sunder_i_watch_begin(&watch, &how.progress, &how.progress_user);
    status = sunder_i_free_space_build(obstacles, n, robot, o.gap, &how, &r->space, err);
    if (status == SUNDER_OK) status = find_route(r, from, to, &how, err);
    if (status == SUNDER_OK && r->space.filter.lattice->arena.failed) status = sunder_i_failure_cause(err);
    sunder_i_watch_end(&watch);
    if (status == SUNDER_OK)
        *out = r;
    else
        sunder_route_free(r);
    return status;
}

void sunder_route_free(sunder_route *route)
{
    if (!route) return;
    for (size_t i = 0; i < route->n; i++) {
        sunder_i_free_all(route->stop[i].text[0], route->stop[i].text[1]);
    }
    sunder_i_free(route->stop);
    sunder_i_free_space_free(&route->space);
    sunder_i_free(route);
}

sunder_route_status sunder_route_reason(const sunder_route *route, size_t *obstacle)
{
    if (obstacle) *obstacle = route->obstacle;
    return route->reason;
}

size_t sunder_route_vertices(const sunder_route *route) { return route->n; }

void sunder_route_vertex(const sunder_route *route, size_t vertex, double xy[2])
{
    memcpy(xy, route->stop[vertex].xy, sizeof route->stop[vertex].xy);
}

void sunder_route_vertex_text(const sunder_route *route, size_t vertex, const char **x, const char **y)
{
    *x = route->stop[vertex].text[0];
    *y = route->stop[vertex].text[1];
}

double sunder_route_length(const sunder_route *route) { return route->length; }

bool sunder_route_rounded_is_free(const sunder_route *route) { return route->rounded_is_free; }

const sunder_sum *sunder_route_obstacles(const sunder_route *route) { return route->space.sum; }
