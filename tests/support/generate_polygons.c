/* Random polygons with slanted sides: small ones by trial and error, large ones of the kinds in benchmarks of the
 * literature. */
#include "generate.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

static double cross(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]); /* exact for small integers */
}

static int sign(double v) { return (v > 0) - (v < 0); }

static bool within(const double *a, const double *b, const double *p)
{
    return cross(a, b, p) == 0 && fmin(a[0], b[0]) <= p[0] && p[0] <= fmax(a[0], b[0]) && fmin(a[1], b[1]) <= p[1] &&
           p[1] <= fmax(a[1], b[1]);
}

static bool touch(const double *a, const double *b, const double *c, const double *d)
{
    return (sign(cross(a, b, c)) * sign(cross(a, b, d)) < 0 && sign(cross(c, d, a)) * sign(cross(c, d, b)) < 0) ||
           within(a, b, c) || within(a, b, d) || within(c, d, a) || within(c, d, b);
}

static bool is_simple(const double *xy, int n)
{
    for (int i = 0; i < n; i++) {
        const double *a = xy + 2 * i, *b = xy + 2 * ((i + 1) % n), *c = xy + 2 * ((i + 2) % n);
        if (within(a, b, c) || within(b, c, a)) return false;
        for (int j = i + 2; j < n; j++)
            if ((j + 1) % n != i && touch(a, b, xy + 2 * j, xy + 2 * ((j + 1) % n))) return false;
    }
    return true;
}

void random_simple(polyset *set, rng *r, int n, int span)
{
    double xy[16];
    for (int tries = 0;; tries++) {
        const int k = tries > 2000 ? 3 : n; /* on a grid with too few free points a triangle is made */
        for (int i = 0; i < 2 * k; i++) xy[i] = (double)rng_int(r, 0, span);
        if (!is_simple(xy, k)) continue;
        polyset_polygon(set, xy, (size_t)k);
        return;
    }
}

void random_star(polyset *set, rng *r, int n, double size)
{
    double last[2] = {NAN, NAN};
    for (int i = 0; i < n; i++) {
        const double angle = 2 * PI * (i + 0.6 * rng_unit(r)) / n, length = size * (0.15 + 0.85 * rng_unit(r));
        const double xy[2] = {rint(length * cos(angle)), rint(length * sin(angle))};
        if (xy[0] != last[0] || xy[1] != last[1]) polyset_vertex(set, xy[0], xy[1]);
        last[0] = xy[0];
        last[1] = xy[1];
    }
    polyset_end_ring(set);
    polyset_end_polygon(set);
}

void random_comb(polyset *set, rng *r, int teeth, double size, bool slanted)
{
    const double step = size / teeth;
    polyset_vertex(set, size, -size / 8);
    for (int i = teeth - 1; i >= 0; i--) {
        const double x = i * step, jitter = rint(step / 8 * rng_unit(r));
        const double top = rint(size * (0.8 + 0.2 * rng_unit(r)));
        polyset_vertex(set, rint(x + step * (slanted ? 0.9 : 0.7)), rint(size / 100 * rng_unit(r)));
        polyset_vertex(set, rint(x + step * (slanted ? 0.55 : 0.7)) + (slanted ? jitter : 0), top);
        polyset_vertex(set, rint(x + step * (slanted ? 0.45 : 0.3)) - (slanted ? jitter : 0),
                       top + (slanted ? jitter : 0));
        polyset_vertex(set, rint(x + step * (slanted ? 0.1 : 0.3)), rint(size / 100 * rng_unit(r)));
    }
    polyset_vertex(set, 0, -size / 8);
    polyset_end_ring(set);
    polyset_end_polygon(set);
}

void random_fork(polyset *set, rng *r, int teeth, double size, bool sideways)
{
    polyset fork;
    polyset_init(&fork);
    random_comb(&fork, r, teeth, size, false);
    if (sideways) polyset_map(&fork, 0, 1, -1, 0);
    polyset_append(set, &fork);
    polyset_free(&fork);
}

void random_convex(polyset *set, rng *r, int n, double size)
{
    polyset all, hull;
    polyset_init(&all);
    for (int i = 0; i < n; i++) {
        const double angle = 2 * PI * (i + 0.4 * rng_unit(r)) / n;
        polyset_vertex(&all, rint(size * cos(angle)), rint(size * sin(angle)));
    }
    polyset_end_ring(&all);
    polyset_end_polygon(&all);
    /* Rounding may make it slightly concave. */
    int kept = 0;
    polyset_init(&hull);
    for (size_t i = 0; i < all.vertices; i++) {
        while (kept >= 2 && cross(hull.xy + 2 * (kept - 2), hull.xy + 2 * (kept - 1), all.xy + 2 * i) <= 0)
            kept--, hull.vertices--;
        polyset_vertex(&hull, all.xy[2 * i], all.xy[2 * i + 1]);
        kept++;
    }
    polyset_polygon(set, hull.xy, hull.vertices);
    polyset_free(&hull);
    polyset_free(&all);
}

void random_building(polyset *set, rng *r)
{
    static const double shapes[4][16] = {{0, 0, 1, 0, 1, 1, 0, 1},
                                         {0, 0, 1, 0, 1, .4, .5, .4, .5, 1, 0, 1},
                                         {0, 0, 1, 0, 1, 1, .7, 1, .7, .5, .3, .5, .3, 1, 0, 1},
                                         {.3, 0, .7, 0, .7, .6, 1, .6, 1, 1, 0, 1, 0, .6, .3, .6}};
    static const int corners[4] = {4, 6, 8, 8};
    const int kind = (int)rng_int(r, 0, 3);
    const double angle = rng_once_in(r, 3) ? 0 : 2 * PI * rng_unit(r), w = 5 + 20 * rng_unit(r),
                 h = 5 + 15 * rng_unit(r);
    const double x0 = 451234.567 + 30 * rng_unit(r), y0 = 5411234.567 + 30 * rng_unit(r);
    for (int i = 0; i < corners[kind]; i++) {
        const double u = w * shapes[kind][2 * i], v = h * shapes[kind][2 * i + 1];
        const double x = x0 + cos(angle) * u - sin(angle) * v, y = y0 + sin(angle) * u + cos(angle) * v;
        polyset_vertex(set, rng_once_in(r, 8) ? x : rint(x * 1000) / 1000, rint(y * 1000) / 1000);
    }
    polyset_end_ring(set);
    polyset_end_polygon(set);
}
