/* Finds places outside a union of open convex polygons, nearest to a target first.
 *
 * On the boundary of the union the distance from the target has local minima only at feet of perpendiculars on walls,
 * and where walls of two different obstacles cross. (At a corner of one obstacle the distance decreases along one of
 * its two walls.) So these are the candidates. They are visited by distance, and each is tested against all obstacles.
 * Walls are sorted by distance, and a crossing is no nearer than the farther of its walls, so the search stops as soon
 * as the remaining walls are farther than the places found. With many obstacles the plane around the target is divided
 * into cells (cells.c): a point is tested only against obstacles that meet its cell, and walls in cells inside an
 * obstacle are skipped at once. Work is counted as if there were no cells, so that they change no result.
 *
 * All of this is in doubles. A place found is a proposal; whether it is free is decided exactly elsewhere. */
#include "displacement/geometry/free_places.h"
#include "displacement/geometry/cells.h"
#include "displacement/geometry/tuning.h"

#include "base/invariant.h"
#include "base/memory.h"
#include "base/watch.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A wall, and its distance from the target. */
typedef struct near_wall {
    double distance;
    const sunder_i_obstacle_side *wall;
} near_wall;

/* Is a nearer than b? Equal distances are ordered by the number of the obstacle, then by the normal, then by position
 * in memory. */
static bool comes_before(const void *a, const void *b)
{
    const near_wall *p = a, *q = b;
    if (p->distance != q->distance) return p->distance < q->distance;
    const sunder_i_obstacle_side *v = p->wall, *w = q->wall;
    if (v->obstacle != w->obstacle) return v->obstacle < w->obstacle;
    if (v->n[0] != w->n[0]) return v->n[0] < w->n[0];
    return v->n[1] != w->n[1] ? v->n[1] < w->n[1] : v < w;
}

/* Sets out to the point of the wall nearest to x. */
static void nearest_on(const sunder_i_obstacle_side *w, const double x[2], double out[2])
{
    const double ex = w->to[0] - w->from[0], ey = w->to[1] - w->from[1], square = ex * ex + ey * ey;
    double s = square > 0 ? ((x[0] - w->from[0]) * ex + (x[1] - w->from[1]) * ey) / square : 0;
    s = s < 0 ? 0 : s > 1 ? 1 : s;
    out[0] = w->from[0] + s * ex;
    out[1] = w->from[1] + s * ey;
}

typedef struct place_search {
    const sunder_i_obstacles *obstacles;
    const double *target;
    double limit, spread;
    size_t most, n;
    uint32_t *order; /* the obstacles in the order in which they are tested: those that often contain a point move to
                      * the front */
    sunder_i_cells cells;
    double (*place)[2];
    double *distance;
    uint64_t work; /* done up to now, in constraints processed */
} place_search;

/* A segment or a point, with its box. */
typedef struct span {
    double end[2][2], box[4];
} span;

static inline span span_of(const double a[2], const double b[2])
{
    return (span){
        {{a[0], a[1]}, {b[0], b[1]}},
        {a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1], a[0] < b[0] ? b[0] : a[0], a[1] < b[1] ? b[1] : a[1]}};
}

/* Does the span `of` lie strictly within the box? The next function tests the lines of one obstacle. */
static inline bool is_in_box(const double box[4], const span *of)
{
    return (of->box[0] > box[0]) & (of->box[2] < box[2]) & (of->box[1] > box[1]) & (of->box[3] < box[3]);
}

static inline bool is_in_lines(const place_search *h, uint32_t obstacle, const span *of)
{
    const sunder_i_obstacle *it = &h->obstacles->obstacle[obstacle];
    const sunder_i_obstacle_line *line = h->obstacles->line + it->wall, *end = line + it->walls;
    for (; line < end; line++)
        if (line->n[0] * of->end[0][0] + line->n[1] * of->end[0][1] >= line->h ||
            line->n[0] * of->end[1][0] + line->n[1] * of->end[1][1] >= line->h)
            return false;
    return true;
}

/* Does an obstacle that meets the cell, other than `own`, contain the whole span? Obstacles that contained an earlier
 * span are tested first. */
static bool is_held_about(place_search *h, const sunder_i_cell *c, const span *of, uint32_t own)
{
    sunder_i_cell_entry *first = h->cells.entry + c->first, *end = first + c->n;
    for (sunder_i_cell_entry *e = first; e < end; e++) {
        if (!is_in_box(e->box, of) || e->obstacle == own || !is_in_lines(h, e->obstacle, of)) continue;
        const sunder_i_cell_entry hit = *e;
        sunder_i_cell_entry *ahead = first + (e - first) / 2;
        *e = *ahead;
        *ahead = hit;
        return true;
    }
    return false;
}

/* Does one obstacle, other than `own`, contain the whole span? x is a point of it. Such an obstacle meets the cell of
 * every point of the span, so the entries of only one cell are tested: that of x or of an end, whichever has the
 * fewest. */
static bool is_held(place_search *h, const span *of, const double x[2], uint32_t own)
{
    const double *place[3] = {x, of->end[0], of->end[1]};
    sunder_i_cell *fewest = NULL;
    for (size_t k = 0; k < 3; k++) {
        uint32_t cell;
        if (sunder_i_cells_find(&h->cells, place[k], &cell) && (!fewest || h->cells.cell[cell].n < fewest->n))
            fewest = &h->cells.cell[cell];
    }
    if (fewest) return is_held_about(h, fewest, of, own);
    const sunder_i_obstacles *o = h->obstacles;
    for (size_t k = 0; k < o->n; k++) {
        const uint32_t hit = h->order[k];
        if (hit == own || !is_in_box(o->obstacle[hit].box, of) || !is_in_lines(h, hit, of)) continue;
        h->order[k] = h->order[k / 2];
        h->order[k / 2] = hit;
        return true;
    }
    return false;
}

/* Returns the work of testing n obstacles or walls, most of which are excluded quickly. */
static uint64_t work_of(size_t n) { return 1 + n / TESTS_A_STEP; }

static bool count_work(place_search *h, size_t n)
{
    h->work += work_of(n);
    return sunder_i_steps(1 + n / TESTS_A_WATCH);
}

/* Adds x to the places if it is free and near enough. Places remain sorted by distance; of two places nearer than
 * `spread` to each other the one nearer to the target is kept. */
static void offer_place(place_search *h, const double x[2])
{
    const double d = hypot(x[0] - h->target[0], x[1] - h->target[1]);
    if (!(d <= h->limit) || (h->n == h->most && d >= h->distance[h->n - 1])) return;
    if (!count_work(h, h->obstacles->n)) return;
    for (size_t k = 0; k < h->n && h->distance[k] <= d; k++)
        if (hypot(x[0] - h->place[k][0], x[1] - h->place[k][1]) <= h->spread) return;
    const span point = span_of(x, x);
    if (is_held(h, &point, x, SUNDER_I_NO_ENTRY)) return;
    if (h->obstacles->admits && !h->obstacles->admits(h->obstacles->user, x)) return;
    size_t k = 0;
    while (k < h->n && h->distance[k] <= d) k++;
    /* Farther places that are too near to the new one are removed. */
    size_t out = k;
    for (size_t i = k; i < h->n; i++)
        if (hypot(x[0] - h->place[i][0], x[1] - h->place[i][1]) > h->spread) {
            memmove(h->place[out], h->place[i], sizeof h->place[i]);
            h->distance[out++] = h->distance[i];
        }
    h->n = out;
    if (h->n == h->most) h->n--;
    for (size_t i = h->n; i > k; i--) {
        memcpy(h->place[i], h->place[i - 1], sizeof h->place[i]);
        h->distance[i] = h->distance[i - 1];
    }
    h->place[k][0] = x[0];
    h->place[k][1] = x[1];
    h->distance[k] = d;
    h->n++;
}

static double reach_of(const place_search *h) { return h->n == h->most ? h->distance[h->n - 1] : h->limit; }

/* Offers the crossings of wall w with every wall before it. */
static void offer_crossings(place_search *h, const sunder_i_obstacle_side *wall, size_t w)
{
    const sunder_i_obstacle_side *a = &wall[w];
    h->work += w;
    for (size_t v = 0; v < w; v++) {
        const sunder_i_obstacle_side *b = &wall[v];
        if (a->obstacle == b->obstacle) continue;
        const double d1 = b->n[0] * a->from[0] + b->n[1] * a->from[1] - b->h,
                     d2 = b->n[0] * a->to[0] + b->n[1] * a->to[1] - b->h;
        if ((d1 > 0) == (d2 > 0)) continue;
        const double e1 = a->n[0] * b->from[0] + a->n[1] * b->from[1] - a->h,
                     e2 = a->n[0] * b->to[0] + a->n[1] * b->to[1] - a->h;
        if ((e1 > 0) == (e2 > 0)) continue;
        const double s = d1 / (d1 - d2),
                     x[2] = {a->from[0] + s * (a->to[0] - a->from[0]), a->from[1] + s * (a->to[1] - a->from[1])};
        offer_place(h, x);
    }
}

/* Does one obstacle other than its own contain the whole wall? Most walls lie deep inside the union. */
static bool is_covered(place_search *h, const sunder_i_obstacle_side *w, const double foot[2])
{
    const span all = span_of(w->from, w->to);
    return is_held(h, &all, foot, w->obstacle);
}

/* A quick test whether one obstacle other than its own contains the whole wall: returns true if one obstacle contains
 * the cells of both ends, and so all between them, or contains the cell of one end and the wall. False decides
 * nothing. */
static bool is_covered_by_cells(const place_search *h, const sunder_i_obstacle_side *w)
{
    uint32_t from, to;
    if (!sunder_i_cells_find(&h->cells, w->from, &from) || !sunder_i_cells_find(&h->cells, w->to, &to)) return false;
    const uint32_t holder[2] = {h->cells.cell[from].holder, h->cells.cell[to].holder};
    if (holder[0] != SUNDER_I_NO_ENTRY && holder[0] == holder[1]) return true;
    const span all = span_of(w->from, w->to);
    for (size_t k = 0; k < 2; k++)
        if (holder[k] != SUNDER_I_NO_ENTRY && holder[k] != w->obstacle &&
            is_in_box(h->obstacles->obstacle[holder[k]].box, &all) && is_in_lines(h, holder[k], &all))
            return true;
    return false;
}

static int by_distance(const void *a, const void *b) { return comes_before(b, a) - comes_before(a, b); }

/* The walls within the limit of the target, except those that are known to lie inside one obstacle. They are sorted
 * roughly by distance into SHELVES intervals ("shelves"). */
typedef struct wall_lists {
    near_wall *near; /* the walls of all shelves, one shelf after the other, unsorted within each */
    size_t first[SHELVES + 1];
    sunder_i_obstacle_side *bare; /* the walls outside all other obstacles found up to now, the nearest first */
    size_t bares;
    double *covered; /* the distances of the walls inside other obstacles */
    size_t left_out;
} wall_lists;

/* Offers the candidates of one shelf: feet on walls that no obstacle covers. Coverage is tested before sorting, since
 * most feet are covered. Returns false if stopped on request. */
static bool search_shelf(place_search *h, wall_lists *all, size_t shelf)
{
    near_wall *near = all->near + all->first[shelf];
    size_t n = 0;
    for (size_t k = 0; k < all->first[shelf + 1] - all->first[shelf]; k++) {
        double x[2];
        nearest_on(near[k].wall, h->target, x);
        if (is_covered(h, near[k].wall, x)) {
            all->covered[all->left_out++] = near[k].distance;
        } else {
            near[n] = near[k];
            near[n++].distance = hypot(x[0] - h->target[0], x[1] - h->target[1]);
        }
        if (!sunder_i_steps(1 + h->obstacles->n / TESTS_A_WATCH)) return false;
    }
    if (n) qsort(near, n, sizeof *near, by_distance);
    for (size_t k = 0; k < n && near[k].distance <= h->limit && near[k].distance <= reach_of(h); k++) {
        double x[2];
        if (!count_work(h, h->obstacles->n)) return false;
        nearest_on(near[k].wall, h->target, x);
        offer_place(h, x);
        all->bare[all->bares] = *near[k].wall;
        all->bare[all->bares++].distance = near[k].distance;
    }
    return true;
}

/* Returns a lower bound of the distance of the walls on a shelf. */
static double distance_of(const place_search *h, size_t shelf)
{
    return shelf ? h->limit * (1 - 0x1p-40) * ((double)shelf / SHELVES) : 0;
}

/* Offers feet on the walls, then crossings of walls. */
static void search_places(place_search *h, wall_lists *all)
{
    for (size_t k = 0; k < SHELVES; k++) {
        if (all->first[k] == all->first[k + 1]) continue;
        if (!(distance_of(h, k) <= reach_of(h))) break;
        if (!search_shelf(h, all, k)) return;
    }
    for (size_t k = 0; k < all->left_out; k++)
        if (all->covered[k] <= reach_of(h)) h->work += work_of(h->obstacles->n);
    for (size_t k = 0; k < all->bares && k < MOST_CROSSED && all->bare[k].distance <= reach_of(h); k++)
        offer_crossings(h, all->bare, k);
}

#ifndef NDEBUG
static const char *check_places(const place_search *h)
{
    for (size_t k = 0; k < h->n; k++)
        if (!(h->distance[k] <= h->limit) || (k && h->distance[k - 1] > h->distance[k])) return "places are not sorted";
    return NULL;
}
#endif

/* Is the squared distance of the obstacle's box from the target greater than `square`? */
static bool is_beyond(const sunder_i_obstacle *obstacle, const double target[2], double square)
{
    double sum = 0;
    for (int c = 0; c < 2; c++) {
        const double low = obstacle->box[c] - target[c], high = target[c] - obstacle->box[c + 2];
        sum += low > 0 ? low * low : high > 0 ? high * high : 0;
    }
    return sum > square;
}

/* Is the line of the wall certainly farther from the target than `limit`, whatever the rounding errors? */
static bool is_line_beyond(const sunder_i_obstacle_side *wall, const double target[2], double limit)
{
    const double x = wall->n[0] * target[0], y = wall->n[1] * target[1];
    const double size =
        fabs(x) + fabs(y) + fabs(wall->from[0]) + fabs(wall->from[1]) + fabs(wall->to[0]) + fabs(wall->to[1]);
    return fabs(x + y - wall->h) > limit * (1 + 0x1p-20) + 0x1p-40 * size;
}

/* Lists the walls within the limit, with approximate distances, and returns their number. Most walls are farther, which
 * their squared distances prove with rounding errors allowed for. Walls covered by cells go to all->covered. */
static size_t gather_walls(const place_search *h, near_wall *list, wall_lists *all)
{
    const sunder_i_obstacles *o = h->obstacles;
    const double beyond = h->limit * h->limit * (1 + 0x1p-40) + DBL_MIN;
    size_t n = 0;
    for (size_t i = 0; i < o->n; i++) {
        const sunder_i_obstacle *obstacle = &o->obstacle[i];
        if (is_beyond(obstacle, h->target, beyond)) continue;
        for (size_t k = obstacle->wall; k < obstacle->wall + obstacle->walls; k++) {
            const sunder_i_obstacle_side *w = &o->wall[k];
            double x[2];
            if (is_line_beyond(w, h->target, h->limit)) continue;
            nearest_on(w, h->target, x);
            const double dx = x[0] - h->target[0], dy = x[1] - h->target[1];
            if (dx * dx + dy * dy > beyond) continue;
            const double distance = sqrt(dx * dx + dy * dy);
            if (is_covered_by_cells(h, w))
                all->covered[all->left_out++] = distance;
            else
                list[n++] = (near_wall){distance, w};
        }
    }
    return n;
}

static size_t shelf_of(const place_search *h, double distance)
{
    const double share = distance / h->limit * SHELVES;
    return share < SHELVES - 1 ? (size_t)share : SHELVES - 1;
}

/* Sorts the n walls into shelves by distance. */
static void sort_into_shelves(const place_search *h, const near_wall *list, size_t n, wall_lists *all)
{
    size_t *end = all->first;
    memset(end, 0, sizeof all->first);
    for (size_t k = 0; k < n; k++) end[shelf_of(h, list[k].distance) + 1]++;
    for (size_t k = 0; k < SHELVES; k++) end[k + 1] += end[k];
    for (size_t k = n; k-- > 0;) all->near[--end[shelf_of(h, list[k].distance) + 1]] = list[k];
    /* The loop above moved the end of each shelf down to its beginning. */
    memmove(all->first, all->first + 1, SHELVES * sizeof *all->first);
    all->first[SHELVES] = n;
}

size_t sunder_i_free_places(const sunder_i_obstacles *obstacles, const double target[2], double limit, double spread,
                            size_t most, double (*places)[2], uint64_t *steps, bool *failed)
{
    double distance[MOST_PLACES];
    place_search h = {.obstacles = obstacles, .target = target, .limit = limit, .spread = spread, .place = places};
    h.distance = distance;
    h.most = most < MOST_PLACES ? most : MOST_PLACES;
    const size_t each = 2 * sizeof(near_wall) + sizeof(sunder_i_obstacle_side) + sizeof(double);
    char *memory = sunder_i_alloc(obstacles->walls * each + obstacles->n * sizeof *h.order, 1);
    if (!memory || obstacles->failed) {
        *failed = true;
    } else if (h.most) {
        wall_lists all = {.near = (near_wall *)(void *)memory};
        near_wall *list = all.near + obstacles->walls;
        all.bare = (sunder_i_obstacle_side *)(void *)(list + obstacles->walls);
        all.covered = (double *)(void *)(all.bare + obstacles->walls);
        h.order = (uint32_t *)(void *)(all.covered + obstacles->walls);
        for (size_t k = 0; k < obstacles->n; k++) h.order[k] = (uint32_t)k;
        offer_place(&h, target);
        if (h.n == 0 && !sunder_i_cells_make(obstacles, target, limit, &h.cells)) *failed = true;
        if (h.n == 0 && !*failed) {
            sort_into_shelves(&h, list, gather_walls(&h, list, &all), &all);
            search_places(&h, &all);
        }
        *failed = *failed || sunder_i_stopped();
    }
    SUNDER_I_CHECK(check_places(&h), h.n);
    *steps += h.work + 2 * obstacles->walls;
    sunder_i_cells_free(&h.cells);
    sunder_i_free(memory);
    return h.n;
}
