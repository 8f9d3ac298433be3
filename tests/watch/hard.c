#include "hard.h"

#include "generate.h"

#include <math.h>

#define PI 3.14159265358979323846

static double between(rng *r, double low, double high) { return low + (high - low) * rng_unit(r); }

/* A closed wave around a circle: a sum of this many harmonics. */
typedef struct wave {
    int n;
    double size[64], phase[64];
} wave;

static wave random_wave(rng *r, int n, double decay)
{
    wave w = {.n = n};
    for (int j = 1; j < n; j++) {
        w.size[j] = between(r, -1, 1) / pow(j, decay);
        w.phase[j] = between(r, 0, 2 * PI);
    }
    return w;
}

static double wave_at(const wave *w, double angle)
{
    double sum = 0;
    for (int j = 1; j < w->n; j++) sum += w->size[j] * sin(j * angle + w->phase[j]);
    return sum;
}

static void stairs(polyset *set, const wave *w, int n, double dx, double dy)
{
    const double cell = 0.5, radius = n / 12.0 * cell;
    double last[2] = {0, 0};
    for (int i = 0; i <= n / 2; i++) {
        const double a = 4 * PI * i / n, r = radius * (1 + 0.12 * wave_at(w, a));
        const double x = rint(r * cos(a) / cell) * cell + 654900 + dx,
                     y = rint(r * sin(a) / cell) * cell + 1794900 + dy;
        if (i && x != last[0] && y != last[1]) polyset_vertex(set, x, last[1]);
        if (i == 0 || x != last[0] || y != last[1]) polyset_vertex(set, x, y);
        last[0] = x;
        last[1] = y;
    }
    polyset_end_ring(set);
    polyset_end_polygon(set);
}

static void coast(polyset *set, rng *r, const wave *w, int n, double noise, double shift)
{
    for (int i = 0; i < n; i++) {
        const double a = 2 * PI * i / n, radius = 1000 * (1 + 0.15 * wave_at(w, a));
        if (noise > 0 && rng_once_in(r, 10)) continue;
        polyset_vertex(set, 451234.567 + radius * cos(a) + shift + between(r, -noise, noise),
                       5411234.567 + radius * sin(a) + shift / 2 + between(r, -noise, noise));
    }
    polyset_end_ring(set);
    polyset_end_polygon(set);
}

/* The outline xy turned by an angle, with each member or corner displaced by up to d. */
static void repeat(polyset *set, rng *r, const double (*xy)[2], int n, int times, double angle, double d, bool corners)
{
    for (int k = 0; k < times; k++) {
        double dx = between(r, 0, d), dy = between(r, 0, d);
        for (int i = 0; i < n; i++) {
            if (corners) dx = between(r, 0, d), dy = between(r, 0, d);
            polyset_vertex(set, 451234.567 + cos(angle) * xy[i][0] - sin(angle) * xy[i][1] + dx,
                           5411234.567 + sin(angle) * xy[i][0] + cos(angle) * xy[i][1] + dy);
        }
        polyset_end_ring(set);
        polyset_end_polygon(set);
    }
}

static void scribble(polyset *set, rng *r, int n)
{
    for (int i = 0; i < n; i++)
        polyset_vertex(set, 400000 + rint(between(r, 0, 1e6)) / 1000, 5400000 + rint(between(r, 0, 1e6)) / 1000);
    polyset_end_ring(set);
    polyset_end_polygon(set);
}

static void track(polyset *set, rng *r, int n)
{
    double x = 0, y = 0, a = 0;
    for (int i = 0; i < n; i++) {
        a += between(r, -1, 1);
        x += cos(a);
        y += sin(a);
        polyset_vertex(set, 400000 + rint(1000 * x) / 1000, 5400000 + rint(1000 * y) / 1000);
    }
    polyset_end_ring(set);
    polyset_end_polygon(set);
}

/* A finely flattened round outline in which neighbouring vertices are swapped at this many places. */
static void bows(polyset *set, int n, double cx, double cy, int swapped)
{
    for (int i = 0; i < n; i++) {
        int k = i;
        for (int j = 0; j < swapped; j++) {
            const int at = (2 * j + 1) * n / (2 * swapped);
            if (i == at) k = at + 1;
            if (i == at + 1) k = at;
        }
        const double a = 2 * PI * k / n;
        polyset_vertex(set, cx + 60 * cos(a) - (cos(a) < 0 ? 80 : 0), cy + 60 * sin(a));
    }
    polyset_end_ring(set);
    polyset_end_polygon(set);
}

static void sieve(polyset *set, int holes)
{
    const int side = (int)ceil(sqrt(holes));
    const double plate[] = {0, 0, 10.0 * side, 0, 10.0 * side, 10.0 * side, 0, 10.0 * side};
    polyset_ring(set, plate, 4);
    for (int k = 0; k < holes; k++) {
        const double x = 10 * (k % side) + 2, y = 10 * (k / side) + 2;
        const double hole[] = {x, y, x, y + 6, x + 6 + 0.01 * k / holes, y + 6, x + 6, y};
        polyset_ring(set, hole, 4);
    }
    polyset_end_polygon(set);
}

const char *hard_kind_string(hard_kind kind)
{
    static const char *const name[] = {"stairs", "coast", "versions", "slivers", "scribble",
                                       "track",  "bows",  "combs",    "scatter", "sieve"};
    return name[kind];
}

void random_hard(polyset *p, polyset *q, rng *r, hard_kind kind, int n)
{
    static const double house[][2] = {{0, 0}, {20, 0}, {20, 8}, {9, 8}, {9, 14}, {0, 14}};
    static const double strip[][2] = {{0, 0}, {1000, 0}, {1000, 1}, {0, 1}};
    static const double ell[] = {0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3};
    wave w;
    switch (kind) {
    case HARD_STAIRS:
        w = random_wave(r, 40, 1);
        stairs(p, &w, n, 0, 0);
        stairs(q, &w, n, 2, 1.5);
        break;
    case HARD_COAST:
        w = random_wave(r, 64, 1.2);
        coast(p, r, &w, n, 0, 0);
        coast(q, r, &w, n, 0.3, 1);
        break;
    case HARD_VERSIONS:
        repeat(p, r, house, 6, n / 6, 0.4, 1e-3, true);
        for (int i = 0; i < 32; i++) polyset_vertex(q, 5 * cos(i * PI / 16), 5 * sin(i * PI / 16));
        polyset_end_ring(q);
        polyset_end_polygon(q);
        break;
    case HARD_SLIVERS:
        repeat(p, r, strip, 4, n / 4, 0.3, 1e-6, false);
        polyset_polygon(q, ell, 6);
        break;
    case HARD_SCRIBBLE:
        scribble(p, r, n);
        polyset_rectangle(q, 0, 0, 1, 1);
        break;
    case HARD_TRACK:
        track(p, r, n);
        polyset_rectangle(q, 0, 0, 1, 1);
        break;
    case HARD_BOWS:
        bows(p, n, 655000, 1794870, 4);
        bows(q, n, 655010.5, 1794890.25, 4);
        break;
    case HARD_COMBS:
        random_fork(p, r, n / 4, 4.0 * n, false);
        random_fork(q, r, n / 4, 4.0 * n, true);
        break;
    case HARD_SCATTER:
        for (int k = 0; k < n / 4; k++) {
            const double x = rint(between(r, 0, 1e5)), y = rint(between(r, 0, 1e5));
            polyset_rectangle(p, x, y, x + between(r, 1, 40), y + between(r, 1, 40));
        }
        random_star(q, r, 40, 300);
        break;
    default:
        sieve(p, n / 4);
        polyset_rectangle(q, -4, -4, 4, 4);
        break;
    }
}
