/* Families that look like maps: the outlines of many buildings and a coast, each to be grown by a round brush, and two
 * buildings in each other's way. */
#include "family.h"

#include <stdlib.h>

static int64_t rounded(double v) { return (int64_t)(v < 0 ? v - 0.5 : v + 0.5); }

/* Plans of houses, counter-clockwise, in quarters of the half width and half depth: rectangle, L, T, U, cross. */
enum { PLANS = 5, CORNERS = 12 };

typedef struct house_plan {
    size_t corners;
    int8_t at[2 * CORNERS];
} house_plan;

static const house_plan plans[PLANS] = {
    {4, {-4, -4, 4, -4, 4, 4, -4, 4}},
    {6, {-4, -4, 4, -4, 4, 1, 0, 1, 0, 4, -4, 4}},
    {8, {-4, -4, 4, -4, 4, 0, 1, 0, 1, 4, -1, 4, -1, 0, -4, 0}},
    {8, {-4, -4, 4, -4, 4, 4, 2, 4, 2, -1, -2, -1, -2, 4, -4, 4}},
    {12, {-1, -4, 1, -4, 1, -1, 4, -1, 4, 2, 1, 2, 1, 4, -1, 4, -1, 2, -4, 2, -4, -1, -1, -1}}};

/* A house of at most that many corners, turned anyhow about its middle. No plan has a wall shorter than a quarter of
 * its half width, so that rounding turns walls by little and never makes them cross. */
static void house(family_set *set, town_random *random, size_t most, int64_t cx, int64_t cy, int64_t low, int64_t high)
{
    size_t known = PLANS;
    while (known > 1 && plans[known - 1].corners > most) known--;
    const house_plan *plan = &plans[town_random_below(random, (unsigned)known)];
    const double width = (double)family_integer(random, low, high), depth = (double)family_integer(random, low, high);
    double c, s;
    family_direction(town_random_between(random, 0, 1), &c, &s);
    for (size_t i = 0; i < plan->corners; i++) {
        const double x = width * plan->at[2 * i] / 4, y = depth * plan->at[2 * i + 1] / 4;
        family_vertex(set, cx + rounded(c * x - s * y), cy + rounded(s * x + c * y));
    }
    family_end_member(set);
}

/* Makes a regular polygon with corners near the circle. The radius is enlarged if rounding would make corners equal. */
static void brush(family_set *set, size_t n, int64_t radius)
{
    if (radius < (int64_t)(n * n)) radius = (int64_t)(n * n);
    for (size_t i = 0; i < n; i++) {
        double x, y;
        family_direction((double)i / (double)n, &x, &y);
        family_vertex(set, rounded(x * (double)radius), rounded(y * (double)radius));
    }
    family_end_member(set);
}

/* buildings + brush: houses on a jittered grid, a little apart, so that grown ones meet here and there. */
void family_buildings(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    enum { CELL = 4000, LOW = 500, HIGH = 1300, JITTER = 150, BRUSH = 500 };
    size_t columns = 1;
    while (7 * columns * columns < m) columns++;
    for (size_t i = 0; p->vertices + 4 <= m; i++) {
        const int64_t cx = (int64_t)(i % columns) * CELL + family_integer(&streams->p, -JITTER, JITTER);
        const int64_t cy = (int64_t)(i / columns) * CELL + family_integer(&streams->p, -JITTER, JITTER);
        house(p, &streams->p, m - p->vertices, cx, cy, LOW, HIGH);
    }
    brush(q, n, BRUSH);
}

/* coast + brush: an island whose shore is drawn by halving: between two places another, off by a chance that shrinks a
 * little slower than the way between them. The brush covers several vertices where there are many. */
void family_coast(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    enum { SHRINK = 11, OF = 20 };
    size_t places = 1;
    while (places < m) places *= 2;
    double *height = family_room(NULL, places, sizeof *height), off = 0.6;
    height[0] = 0;
    for (size_t step = places / 2; step > 0; step /= 2, off = off * SHRINK / OF)
        for (size_t i = step; i < places; i += 2 * step)
            height[i] =
                (height[i - step] + height[(i + step) % places]) / 2 + town_random_between(&streams->p, -off, off);
    /* Directions ascend by a fifth of a share at least: many units, so that the shore does not cross itself. */
    const double radius = m < 100000 ? 6400000 : 64 * (double)m;
    for (size_t i = 0; i < m; i++) {
        double x, y, h = 1 + height[i * places / m];
        if (h < 0.3) h = 0.3;
        family_direction(((double)i + town_random_between(&streams->p, 0, 0.8)) / (double)m, &x, &y);
        family_vertex(p, rounded(x * radius * h), rounded(y * radius * h));
    }
    family_end_member(p);
    free(height);
    brush(q, n, (int64_t)(radius / 256));
}

/* Two houses that overlap, millimetres of a map from the origin: at most 12 corners each, whatever the sizes. */
void family_overlap(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    enum { LOW = 500, HIGH = 1300, EAST = 451234567, NORTH = 541123456, AREA = 1000000 };
    const int64_t cx = EAST + family_integer(&streams->p, 0, AREA), cy = NORTH + family_integer(&streams->p, 0, AREA);
    house(p, &streams->p, m, cx, cy, LOW, HIGH);
    const int64_t dx = family_integer(&streams->q, -LOW, LOW), dy = family_integer(&streams->q, -LOW, LOW);
    house(q, &streams->q, n, cx + dx, cy + dy, LOW, HIGH);
}
