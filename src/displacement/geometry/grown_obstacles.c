/* Makes a union of convex polygons, each grown by its gap: its walls, and the lines that decide whether a point is
 * inside. */
#include "displacement/geometry/free_places.h"
#include "displacement/geometry/tuning.h"

#include "base/list.h"
#include "spatial/box.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

void sunder_i_obstacles_free(sunder_i_obstacles *obstacles)
{
    sunder_i_free_all(obstacles->obstacle, obstacles->wall, obstacles->line);
    memset(obstacles, 0, sizeof *obstacles);
}

void sunder_i_obstacles_clear(sunder_i_obstacles *obstacles)
{
    obstacles->n = obstacles->walls = 0;
    obstacles->admits = NULL;
    obstacles->failed = false;
}

double sunder_i_obstacle_slack(const sunder_i_obstacle *obstacle)
{
    const double *b = obstacle->box;
    return ON_A_SIDE * (b[2] - b[0] + b[3] - b[1]);
}

/* Appends a wall with the normal n, at distance `gap` from corner c. Its `from` is set to that corner, until
 * close_walls() sets its true ends. The room must have been reserved. */
static inline void add_normal(sunder_i_obstacles *o, const double n[2], const double c[2], double gap)
{
    o->wall[o->walls++] = (sunder_i_obstacle_side){
        .n = {n[0], n[1]}, .h = n[0] * c[0] + n[1] * c[1] + gap, .from = {c[0], c[1]}, .obstacle = (uint32_t)o->n};
}

/* Reserves room for `more` further walls. Returns false, and sets o->failed, if memory is out. */
static bool reserve_walls(sunder_i_obstacles *o, size_t more)
{
    const size_t need = o->walls + more, first = need > FEWEST_WALLS ? need : FEWEST_WALLS;
    if (!sunder_i_reserve(&o->wall, &o->wall_capacity, o->wall ? need : first, sizeof *o->wall)) o->failed = true;
    return !o->failed;
}

/* How finely round corners are approximated: the largest angle between normals of consecutive walls, and its cosine.
 * corners: the number of corners of the polygon. */
typedef struct roundness {
    double turn, cosine;
    size_t corners;
} roundness;

/* The angle is larger if the gap is tiny compared with the polygon (the margin of a search whose gap is 0, and all
 * shadows): then the area added at a corner is tiny, too. */
static roundness find_roundness(const double *d, size_t n, double gap)
{
    double box[4];
    sunder_i_box_clear(box);
    for (size_t k = 0; k < n; k++) sunder_i_box_include(box, d + 2 * k);
    const bool next_to_nothing = gap < NEXT_TO_NOTHING * (box[2] - box[0] + box[3] - box[1]);
    const double turn = next_to_nothing ? CORNER_TURN_AT_MOST : CORNER_TURN;
    return (roundness){turn, cos(turn), n};
}

/* Adds the walls at a round corner c, with normals between those of the edges that meet there, n and m. */
static void add_round(sunder_i_obstacles *o, const double n[2], const double m[2], const double c[2], double gap,
                      const roundness *most)
{
    const double sine = n[0] * m[1] - n[1] * m[0], cosine = n[0] * m[0] + n[1] * m[1];
    if (sine >= 0 && cosine > most->cosine) return;
    const double turn = atan2(sine, cosine);
    const double angle = turn < -FLAT ? turn + 2 * PI : turn; /* a piece without area turns by half a circle */
    const int steps = (int)ceil(angle / most->turn);
    /* Room must be left for the walls of the remaining edges. */
    if (steps < 2 || !reserve_walls(o, (size_t)steps + most->corners)) return;
    const double turn_cos = cos(angle / steps), turn_sin = sin(angle / steps);
    double t[2] = {n[0], n[1]};
    for (int k = 1; k < steps; k++) {
        const double x = t[0];
        t[0] = turn_cos * x - turn_sin * t[1];
        t[1] = turn_sin * x + turn_cos * t[1];
        add_normal(o, t, c, gap);
    }
}

/* Completes the obstacle whose walls and box have been made: stores its lines. */
static void end_obstacle(sunder_i_obstacles *o)
{
    const sunder_i_obstacle *obstacle = &o->obstacle[o->n];
    const double slack = sunder_i_obstacle_slack(obstacle);
    for (size_t k = obstacle->wall; k < o->walls; k++)
        o->line[k] = (sunder_i_obstacle_line){{o->wall[k].n[0], o->wall[k].n[1]}, o->wall[k].h - slack};
    o->n++;
}

/* Sets the ends of the walls from index `first` on. Consecutive walls meet at the corner itself if there is no gap;
 * otherwise where their lines cross, which is the corner moved along the bisector of the normals. */
static void close_walls(sunder_i_obstacles *o, size_t first, double gap)
{
    const size_t n = o->walls - first;
    sunder_i_obstacle *obstacle = &o->obstacle[o->n];
    obstacle->wall = (uint32_t)first;
    obstacle->walls = (uint32_t)n;
    sunder_i_box_clear(obstacle->box);
    for (size_t k = 0; k < n; k++) {
        sunder_i_obstacle_side *w = &o->wall[first + k], *before = &o->wall[first + (k ? k - 1 : n - 1)];
        const double s = gap / (1 + w->n[0] * before->n[0] + w->n[1] * before->n[1]);
        const double c[2] = {w->from[0] + s * (w->n[0] + before->n[0]), w->from[1] + s * (w->n[1] + before->n[1])};
        for (int i = 0; i < 2; i++) w->from[i] = before->to[i] = c[i];
        sunder_i_box_include(obstacle->box, c);
    }
    end_obstacle(o);
}

void sunder_i_obstacles_add(sunder_i_obstacles *obstacles, const double *d, size_t n, double gap)
{
    const size_t first = obstacles->walls;
    if (obstacles->failed || !sunder_i_reserve(&obstacles->obstacle, &obstacles->obstacle_capacity, obstacles->n + 1,
                                               sizeof *obstacles->obstacle)) {
        obstacles->failed = true;
        return;
    }
    if (!reserve_walls(obstacles, n)) return;
    double before[2] = {0, 0}, first_normal[2] = {0, 0};
    const double *first_corner = d;
    const roundness most = find_roundness(d, n, gap);
    bool any = false;
    for (size_t k = 0; k < n && !obstacles->failed; k++) {
        const double *p = d + 2 * k, *q = d + 2 * (k + 1 < n ? k + 1 : 0);
        const double ex = q[0] - p[0], ey = q[1] - p[1], length = sqrt(ex * ex + ey * ey);
        if (!(length > 0)) continue;
        const double m[2] = {ey / length, -ex / length};
        if (any && gap > 0) add_round(obstacles, before, m, p, gap, &most);
        add_normal(obstacles, m, p, gap);
        if (!any) {
            memcpy(first_normal, m, sizeof m);
            first_corner = p;
        }
        memcpy(before, m, sizeof m);
        any = true;
    }
    if (any && gap > 0) add_round(obstacles, before, first_normal, first_corner, gap, &most);
    if (obstacles->failed) return;
    if (obstacles->walls - first < 3) {
        obstacles->walls = first; /* without area and gap there is no obstacle */
        return;
    }
    if (sunder_i_reserve(&obstacles->line, &obstacles->line_capacity, obstacles->wall_capacity,
                         sizeof *obstacles->line))
        close_walls(obstacles, first, gap);
    else
        obstacles->failed = true;
}

void sunder_i_obstacles_add_known(sunder_i_obstacles *obstacles, const sunder_i_obstacle_side *wall, uint32_t walls,
                                  const double box[4])
{
    if (!sunder_i_reserve(&obstacles->obstacle, &obstacles->obstacle_capacity, obstacles->n + 1,
                          sizeof *obstacles->obstacle))
        obstacles->failed = true;
    if (obstacles->failed || !reserve_walls(obstacles, walls)) return;
    if (!sunder_i_reserve(&obstacles->line, &obstacles->line_capacity, obstacles->wall_capacity,
                          sizeof *obstacles->line)) {
        obstacles->failed = true;
        return;
    }
    sunder_i_obstacle *obstacle = &obstacles->obstacle[obstacles->n];
    obstacle->wall = (uint32_t)obstacles->walls;
    obstacle->walls = walls;
    memcpy(obstacle->box, box, sizeof obstacle->box);
    memcpy(obstacles->wall + obstacles->walls, wall, walls * sizeof *wall);
    for (size_t k = obstacles->walls; k < obstacles->walls + walls; k++)
        obstacles->wall[k].obstacle = (uint32_t)obstacles->n;
    obstacles->walls += walls;
    end_obstacle(obstacles);
}
