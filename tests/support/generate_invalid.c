#include "generate.h"

#include <math.h>

#define VERTICES_MAX 256

const char *invalid_kind_string(invalid_kind kind)
{
    static const char *const name[] = {"scribble", "ragged",   "round", "house",   "track", "members",
                                       "scaled",   "touching", "holes", "doubled", "spikes"};
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

/* Coordinates with three decimals, as in maps. */
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

static void touching(polyset *set, rng *r, int n)
{
    double xy[2 * VERTICES_MAX], at[2] = {0, 0};
    int k = 0;
    for (; k < n - 2; k++) {
        xy[2 * k] = at[0];
        xy[2 * k + 1] = at[1];
        at[0] += (double)rng_int(r, -1, 1);
        at[1] += (double)rng_int(r, -1, 1);
    }
    xy[2 * k] = at[0]; /* the way back leads through another corner, so that there is some area */
    xy[2 * k++ + 1] = -2;
    polyset_polygon(set, xy, (size_t)k);
}

/* Triangles and quadrangles on a small grid, as rings of one polygon. */
static void holes(polyset *set, rng *r, int n)
{
    static const double shell[] = {0, 0, 9, 0, 9, 7, 0, 7};
    polyset_ring(set, shell, 4);
    for (int left = n - 4; left >= 3;) {
        const int k = left >= 4 && rng_once_in(r, 2) ? 4 : 3;
        double xy[8];
        for (int i = 0; i < 2 * k; i++) xy[i] = (double)rng_int(r, -1, 9);
        polyset_ring(set, xy, (size_t)k);
        left -= k;
    }
    polyset_end_polygon(set);
}

static void doubled(polyset *set, rng *r, int n)
{
    double xy[16], back[16];
    const int k = n < 5 ? 3 : 4;
    for (int i = 0; i < 2 * k; i++) xy[i] = (double)rng_int(r, 0, 7);
    for (int i = 0; i < k; i++) {
        back[2 * i] = xy[2 * (k - 1 - i)];
        back[2 * i + 1] = xy[2 * (k - 1 - i) + 1];
    }
    polyset_ring(set, xy, (size_t)k);
    if (rng_once_in(r, 2)) polyset_ring(set, back, (size_t)k);
    if (rng_once_in(r, 2)) polyset_ring(set, xy, (size_t)k - (k == 4)); /* a ring of its first three corners */
    if (rng_once_in(r, 2)) polyset_ring(set, xy, (size_t)k);
    polyset_end_polygon(set);
    if (rng_once_in(r, 3)) polyset_polygon(set, back, (size_t)k);
}

static void spikes(polyset *set, rng *r, int n)
{
    polyset body;
    polyset_init(&body);
    random_simple(&body, r, n < 6 ? 3 : 4, 8);
    for (size_t i = 0; i < body.vertices; i++) {
        const double *a = body.xy + 2 * i;
        polyset_vertex(set, a[0], a[1]);
        if (!rng_once_in(r, 2)) continue;
        const double x = (double)rng_int(r, -2, 10);
        polyset_vertex(set, x, (double)rng_int(r, -2, 10));
        polyset_vertex(set, a[0], a[1]);
    }
    polyset_end_ring(set);
    polyset_end_polygon(set);
    polyset_free(&body);
}

void random_invalid(polyset *set, rng *r, invalid_kind kind, int most)
{
    static const double scale[] = {0x1p-40, 1e-9, 1e9, 0x1p60};
    const int n = (int)rng_int(r, 4, most < VERTICES_MAX ? most : VERTICES_MAX);
    switch (kind) {
    case INVALID_SCRIBBLE:
    case INVALID_RAGGED: scribble(set, r, n, kind == INVALID_RAGGED, 1); return;
    case INVALID_ROUND: round_outline(set, r, n < 6 ? 6 : n); return;
    case INVALID_HOUSE: house(set, r); return;
    case INVALID_TRACK: track(set, r, n); return;
    case INVALID_MEMBERS:
        scribble(set, r, (n + 4) / 2, false, 1);
        scribble(set, r, (n + 4) / 2, false, 1);
        return;
    case INVALID_SCALED: scribble(set, r, n, rng_once_in(r, 2), scale[rng_int(r, 0, 3)]); return;
    case INVALID_TOUCHING: touching(set, r, n < 6 ? 6 : n); return;
    case INVALID_HOLES: holes(set, r, n < 7 ? 7 : n); return;
    case INVALID_DOUBLED: doubled(set, r, n); return;
    case INVALID_SPIKES: spikes(set, r, n); return;
    case INVALID_KINDS: return;
    }
}
