/* Families drawn around a centre: convex polygons, stars, and a star among convex obstacles. */
#include "family.h"

static int64_t rounded(double v) { return (int64_t)(v < 0 ? v - 0.5 : v + 0.5); }

/* Twice the signed area of a, b, c; their differences are below 2^31. */
static int64_t turn_at(const int64_t *a, const int64_t *b, const int64_t *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool strictly_convex(const int64_t *xy, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (turn_at(xy + 2 * i, xy + 2 * ((i + 1) % n), xy + 2 * ((i + 2) % n)) <= 0) return false;
    return true;
}

void family_convex_member(family_set *set, town_random *random, size_t n, int64_t cx, int64_t cy, int64_t radius)
{
    const size_t start = set->vertices;
    const double first = town_random_between(random, 0, 1) / (double)n;
    /* Draws directions at least half a share of the turn apart. Then each vertex is farther from the chord of its
     * neighbours than radius (pi / n)^2 / 2, which exceeds rounding if the radius is large enough; otherwise the radius
     * is doubled. */
    const town_random directions = *random;
    for (;; radius *= 2) {
        *random = directions;
        set->vertices = start;
        for (size_t i = 0; i < n; i++) {
            double x, y, turn = first + ((double)i + town_random_between(random, 0, 0.5)) / (double)n;
            family_direction(turn < 1 ? turn : turn - 1, &x, &y);
            family_vertex(set, cx + rounded(x * (double)radius), cy + rounded(y * (double)radius));
        }
        if (strictly_convex(set->xy + 2 * start, n)) break;
    }
    family_end_member(set);
}

static bool goes_round(const int64_t *xy, size_t n)
{
    static const int64_t origin[2] = {0, 0};
    for (size_t i = 0; i < n; i++)
        if (turn_at(origin, xy + 2 * i, xy + 2 * ((i + 1) % n)) <= 0) return false;
    return true;
}

void family_star_member(family_set *set, town_random *random, size_t n, int64_t size)
{
    const size_t start = set->vertices;
    /* Rounding must not change the order of the directions: the shortest spike is several units for each share of the
     * turn. */
    if (size < 100 * (int64_t)n) size = 100 * (int64_t)n;
    do {
        set->vertices = start;
        for (size_t i = 0; i < n; i++) {
            double x, y, length = (double)size * town_random_between(random, 0.1, 1);
            family_direction(((double)i + town_random_between(random, 0, 0.8)) / (double)n, &x, &y);
            family_vertex(set, rounded(x * length), rounded(y * length));
        }
    } while (!goes_round(set->xy + 2 * start, n));
    family_end_member(set);
}

/* convex + convex: the sum is convex and has at most m + n vertices. */
void family_convex(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    family_convex_member(p, &streams->p, m, 0, 0, 1000);
    family_convex_member(q, &streams->q, n, 0, 0, 600);
}

/* star + star: ragged everywhere, and yet the sum is little more than what the longest spikes sweep. */
void family_star(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    family_star_member(p, &streams->p, m, 100000);
    family_star_member(q, &streams->q, n, 100000);
}

/* A star (the robot) + many small convex obstacles on a jittered grid: most sums of pieces meet few others. */
void family_robot(family_set *p, family_set *q, size_t m, size_t n, family_streams *streams)
{
    enum { CELL = 200000, RADIUS = 40000 };
    size_t obstacles = n / 6, columns = 1, left = n;
    if (obstacles == 0) obstacles = 1;
    while (columns * columns < obstacles) columns++;
    family_star_member(p, &streams->p, m, CELL / 4);
    for (size_t i = 0; i < obstacles; i++) {
        const size_t rest = obstacles - i - 1;
        size_t corners = rest ? (size_t)family_integer(&streams->q, 4, 8) : left;
        if (left - corners < 4 * rest) corners = left - 4 * rest; /* every obstacle has its four */
        if (left - corners > 8 * rest) corners = left - 8 * rest;
        left -= corners;
        const int64_t slack = CELL / 2 - RADIUS;
        const int64_t cx = (int64_t)(i % columns) * CELL + family_integer(&streams->q, -slack, slack);
        const int64_t cy = (int64_t)(i / columns) * CELL + family_integer(&streams->q, -slack, slack);
        family_convex_member(q, &streams->q, corners, cx, cy, family_integer(&streams->q, RADIUS / 4, RADIUS));
    }
}
