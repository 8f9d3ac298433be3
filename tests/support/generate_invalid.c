#include "generate.h"

#include <math.h>

#define VERTICES_MAX 256

const char *invalid_kind_string(invalid_kind kind)
{
    static const char *const name[] = {"scribble", "ragged", "round", "house", "track", "members", "scaled"};
    return name[kind];
}

static void swap(double *xy, int i, int j)
{
    for (int k = 0; k < 2; k++) {
        const double t = xy[2 * i + k];
        xy[2 * i + k] = xy[2 * j + k];
        xy[2 * j + k] = t;
    }
}

static void scribble(polyset *set, rng *r, int n, bool ragged, double scale)
{
    double xy[2 * VERTICES_MAX];
    for (int i = 0; i < 2 * n; i++) xy[i] = (ragged ? 10 * rng_unit(r) : (double)rng_int(r, 0, 8)) * scale;
    polyset_polygon(set, xy, (size_t)n);
}

/* Thousandths, as maps have them. */
static double on_map(double v) { return round(v * 1000) / 1000; }

static void round_outline(polyset *set, rng *r, int n)
{
    double xy[2 * VERTICES_MAX];
    const double cx = 455000.5 + (double)rng_int(r, 0, 9), cy = 5411000.25;
    for (int i = 0; i < n; i++) {
        const double a = 6.283185307179586 * i / n;
        xy[2 * i] = on_map(cx + 20 * cos(a));
        xy[2 * i + 1] = on_map(cy + 20 * sin(a));
    }
    for (int k = (int)rng_int(r, 1, 2); k > 0; k--) {
        const int i = (int)rng_int(r, 0, n - 2);
        swap(xy, i, i + 1);
    }
    polyset_polygon(set, xy, (size_t)n);
}

static void house(polyset *set, rng *r)
{
    static const double corner[12] = {0, 0, 8, 0, 8, 5, 5, 5, 5, 8, 0, 8};
    const double a = rng_unit(r) * 1.5, c = cos(a), s = sin(a);
    double xy[12];
    for (int i = 0; i < 6; i++) {
        xy[2 * i] = on_map(1000 + corner[2 * i] * c - corner[2 * i + 1] * s);
        xy[2 * i + 1] = on_map(2000 + corner[2 * i] * s + corner[2 * i + 1] * c);
    }
    const int i = (int)rng_int(r, 0, 4);
    swap(xy, i, i + 1);
    polyset_polygon(set, xy, 6);
}

static void track(polyset *set, rng *r, int n)
{
    double xy[2 * VERTICES_MAX], at[2] = {0, 0}, heading = 0;
    for (int i = 0; i < n; i++) {
        xy[2 * i] = on_map(at[0]);
        xy[2 * i + 1] = on_map(at[1]);
        heading += 2 * rng_unit(r) - 0.7;
        at[0] += 3 * cos(heading);
        at[1] += 3 * sin(heading);
    }
    polyset_polygon(set, xy, (size_t)n);
}

void random_invalid(polyset *set, rng *r, invalid_kind kind, int most)
{
    static const double scale[] = {0x1p-40, 1e-9, 1e9, 0x1p60};
    const int n = (int)rng_int(r, 4, most < VERTICES_MAX ? most : VERTICES_MAX);
    switch (kind) {
    case INVALID_SCRIBBLE:
    case INVALID_RAGGED:
        scribble(set, r, n, kind == INVALID_RAGGED, 1);
        return;
    case INVALID_ROUND:
        round_outline(set, r, n < 6 ? 6 : n);
        return;
    case INVALID_HOUSE:
        house(set, r);
        return;
    case INVALID_TRACK:
        track(set, r, n);
        return;
    case INVALID_MEMBERS:
        scribble(set, r, (n + 4) / 2, false, 1);
        scribble(set, r, (n + 4) / 2, false, 1);
        return;
    case INVALID_SCALED:
        scribble(set, r, n, rng_once_in(r, 2), scale[rng_int(r, 0, 3)]);
        return;
    case INVALID_KINDS:
        return;
    }
}
