#include "generate_nearly.h"

#include <math.h>

/* The place, size and direction of an outline, and how much its versions differ. */
typedef struct stand {
    double x, y, size, c, s;
    double off; /* relative; 0: by units in the last place */
} stand;

typedef struct outline {
    int n;
    double xy[16];
} outline;

static const outline OUTLINES[] = {{3, {0, 0, 1, 0, 0.4, 0.8}},
                                   {4, {0, 0, 1, 0, 1, 0.6, 0, 0.6}},
                                   {6, {0, 0, 1, 0, 1, 0.5, 0.6, 0.5, 0.6, 0.9, 0, 0.9}},
                                   {8, {0, 0, 1, 0, 1, 0.8, 0.7, 0.8, 0.7, 0.3, 0.3, 0.3, 0.3, 0.8, 0, 0.8}}};

const char *nearly_kind_string(nearly_kind kind)
{
    static const char *const name[NEARLY_KINDS] = {"versions", "copies", "slivers",    "thin", "heap",
                                                   "far",      "edges",  "magnitudes", "fits"};
    return name[kind];
}

static stand random_stand(rng *r)
{
    static const double at[][3] = {
        {0, 0, 1}, {451234.567, 5411234.567, 18}, {0.1, 0.7, 0x1p-20}, {3e5, -2e5, 1e6}, {16, 16, 8}};
    static const double off[] = {0, 0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2};
    const double *a = at[rng_int(r, 0, 4)], turn = rng_once_in(r, 3) ? 0 : 6.283185307179586 * rng_unit(r);
    return (stand){a[0], a[1], a[2], cos(turn), sin(turn), off[rng_int(r, 0, 6)]};
}

/* Changes a number by some units in the last place; zero by units relative to the size. */
static double step(const stand *t, double v, int64_t units)
{
    if (v == 0) return (double)units * t->size * 0x1p-53;
    for (int64_t i = 0; i < units; i++) v = nextafter(v, INFINITY);
    for (int64_t i = 0; i > units; i--) v = nextafter(v, -INFINITY);
    return v;
}

/* A small random change: by up to `off` of the size, or by up to three units in the last place. */
static double nearly(rng *r, const stand *t, double v)
{
    return t->off > 0 ? v + t->off * t->size * (2 * rng_unit(r) - 1) : step(t, v, rng_int(r, -3, 3));
}

/* The outline, scaled by (w, h) and placed; each corner slightly changed unless r is NULL. */
static void put(polyset *set, rng *r, const stand *t, const outline *o, double w, double h)
{
    for (int i = 0; i < o->n; i++) {
        const double u = t->size * w * o->xy[2 * i], v = t->size * h * o->xy[2 * i + 1];
        const double x = t->x + t->c * u - t->s * v, y = t->y + t->s * u + t->c * v;
        const double moved = r ? nearly(r, t, x) : x;
        polyset_vertex(set, moved, r ? nearly(r, t, y) : y);
    }
    polyset_end_ring(set);
    polyset_end_polygon(set);
}

static const outline *any_outline(rng *r) { return &OUTLINES[rng_int(r, 0, 3)]; }

/* A long side, and a short one of some units in the last place: the first two corners differ in y alone, the third
 * differs in x, so the three are never collinear. */
static void thin(polyset *set, rng *r, const stand *t)
{
    const double y = step(t, t->y, rng_int(r, 1, 4));
    const double x = t->x + t->size * (rng_once_in(r, 2) ? t->c : 1) * (1 + t->off * rng_unit(r));
    const double xy[] = {t->x, t->y, x == t->x ? t->x + t->size : x, t->y + t->size * t->s, t->x, y};
    polyset_polygon(set, xy, 3);
}

static void heap(polyset *set, rng *r, stand t, int members)
{
    if (!(t.off > 0)) t.off = 1e-13;
    for (int i = 0; i < members; i++) {
        const double turn = t.off * rng_unit(r), c = t.c - t.s * turn, s = t.s + t.c * turn; /* nearly a unit vector */
        stand one = t;
        one.c = c;
        one.s = s;
        const double w = 1 + t.off * rng_unit(r), h = 1 + t.off * rng_unit(r);
        put(set, r, &one, &OUTLINES[rng_once_in(r, 4) ? 0 : 1], w, h);
    }
}

/* Rectangles along one line through the origin whose direction has small integer coordinates, so that their walls lie
 * on it exactly; or slightly changed. */
static void edges(polyset *set, rng *r, const stand *t, int members)
{
    static const double along[][2] = {{1, 0}, {2, 1}, {3, -1}, {1, 3}};
    const double *d = along[rng_int(r, 0, 3)], unit = t->size < 1 ? t->size : 1;
    for (int i = 0; i < members; i++) {
        const double from = (double)rng_int(r, 0, 6), to = from + (double)rng_int(r, 1, 6);
        const double side = (double)rng_int(r, 1, 3) * (rng_once_in(r, 2) ? 1 : -1);
        double xy[] = {from * d[0],
                       from * d[1],
                       to * d[0],
                       to * d[1],
                       to * d[0] - side * d[1],
                       to * d[1] + side * d[0],
                       from * d[0] - side * d[1],
                       from * d[1] + side * d[0]};
        stand one = *t;
        one.size = 1;
        for (int k = 0; k < 8; k++) xy[k] = rng_once_in(r, 8) ? unit * nearly(r, &one, xy[k]) : unit * xy[k];
        polyset_polygon(set, xy, 4);
    }
}

static void magnitudes(polyset *set, rng *r, int members)
{
    for (int i = 0; i < members; i++) {
        stand t = random_stand(r);
        put(set, r, &t, &OUTLINES[rng_int(r, 0, 2)], 1, 1);
        if (rng_once_in(r, 2)) put(set, r, &t, &OUTLINES[rng_int(r, 0, 1)], 1, 1);
    }
}

/* Makes Q for versions of an outline in one place: its directions are equal to directions of P, nearly so, or
 * different. */
static void robot(polyset *q, rng *r, const stand *t)
{
    stand own = *t;
    own.x = own.y = 0;
    own.size = t->size / 4;
    switch (rng_int(r, 0, 4)) {
    case 0: put(q, r, &own, &OUTLINES[1], 1, 1); break;
    case 1: put(q, r, &own, &OUTLINES[2], 1, 1); break;
    case 2: thin(q, r, &own); break;
    case 3: polyset_rectangle(q, 0, 0, own.size, own.size); break;
    case 4:
        put(q, r, &own, &OUTLINES[0], 1, 1);
        put(q, r, &own, &OUTLINES[0], 1, 1);
        break;
    }
}

/* A U, and a reflected shape that nearly fills its opening. */
static void fits(polyset *p, polyset *q, rng *r, const stand *t)
{
    stand at = *t;
    put(p, r, t, &OUTLINES[3], 1, 1);
    if (rng_once_in(r, 2)) put(p, r, t, &OUTLINES[3], 1, 1);
    at.x = at.y = 0;
    put(q, r, &at, &OUTLINES[1], 0.4, rng_once_in(r, 2) ? 0.5 / 0.6 : 0.3);
    polyset_negate(q);
}

void random_nearly(polyset *p, polyset *q, rng *r, nearly_kind kind, int members)
{
    const stand t = random_stand(r);
    const outline *o = any_outline(r);
    const int n = (int)rng_int(r, 2, members);
    polyset_init(p);
    polyset_init(q);
    switch (kind) {
    case NEARLY_VERSIONS:
        for (int i = 0; i < n; i++) put(p, r, &t, o, 1, 1);
        break;
    case NEARLY_COPIES:
        for (int i = 1; i < n; i++) put(p, NULL, &t, o, 1, 1);
        put(p, r, &t, o, 1, 1);
        break;
    case NEARLY_SLIVERS:
        for (int i = 0; i < n; i++) put(p, r, &t, &OUTLINES[1], 1, 0.002 * (t.off > 1e-3 ? 100 : 1));
        break;
    case NEARLY_THIN:
        for (int i = 0; i < n; i++) thin(p, r, &t);
        put(p, r, &t, &OUTLINES[0], 1, 1);
        break;
    case NEARLY_HEAP: heap(p, r, t, 2 * n); break;
    case NEARLY_FAR: {
        stand far = t;
        far.x += 1e5 * t.size;
        far.size *= 100;
        put(p, r, &t, o, 1, 1);
        put(p, r, &t, o, 1, 1);
        put(p, r, &far, &OUTLINES[1], 1, 1);
        break;
    }
    case NEARLY_EDGES: edges(p, r, &t, n); break;
    case NEARLY_MAGNITUDES: magnitudes(p, r, n); break;
    case NEARLY_FITS: fits(p, q, r, &t); break;
    case NEARLY_KINDS: break;
    }
    if (kind != NEARLY_FITS) robot(q, r, &t);
    if (rng_once_in(r, 4)) { /* the same rectangle once more */
        polyset again;
        polyset_copy(&again, q);
        polyset_append(q, &again);
        polyset_free(&again);
    }
}
