/* Pairs of operands, by kind of degeneracy. They are small, since the oracle is slow. */
#include "generate.h"

#include <math.h>
#include <stdlib.h>

const char *pair_kind_string(pair_kind kind)
{
    static const char *const names[PAIR_KINDS] = {
        "squares", "steps", "triangles", "triangle steps", "peg",    "slide", "slanted", "simple", "members", "boards",
        "holes",   "rooms", "map",       "buildings",      "ragged", "self",  "huge"};
    return names[kind];
}

static void board(polyset *set, rng *r, int most, spacing kind, bool triangles, int percent)
{
    cells c;
    const int columns = (int)rng_int(r, 1, most), rows = (int)rng_int(r, 1, most);
    random_cells(&c, r, columns, rows, kind, triangles, percent);
    cells_outline(set, &c, rng_once_in(r, 4), !rng_once_in(r, 4));
}

static void fit(polyset *p, polyset *q, rng *r, int slide)
{
    cells peg, pocket;
    random_cells(&peg, r, (int)rng_int(r, 1, 3), (int)rng_int(r, 1, 2), SPACING_UNIT, rng_once_in(r, 2), 70);
    pocket_for(&pocket, r, &peg, slide);
    if (rng_once_in(r, 3)) { /* an entrance from the side, at a random height */
        const int row = (int)rng_int(r, 1, pocket.rows - 2);
        pocket.on[0][row][0] = pocket.on[0][row][1] = false;
    }
    cells_outline(p, &pocket, false, true);
    cells_outline(q, &peg, false, true);
    if (rng_once_in(r, 3)) {
        const double m = (double)rng_int(r, -2, 2);
        polyset_map(p, 1, m, 0, 1);
        polyset_map(q, 1, m, 0, 1);
    }
}

static void random_map(polyset *p, polyset *q, rng *r)
{
    double m[4];
    do {
        for (int i = 0; i < 4; i++) m[i] = (double)rng_int(r, -2, 2);
    } while (m[0] * m[3] == m[1] * m[2]);
    polyset_map(p, m[0], m[1], m[2], m[3]);
    if (rng_once_in(r, 4)) m[1] += m[0], m[3] += m[2];
    polyset_map(q, m[0], m[1], m[2], m[3]);
}

static void several(polyset *set, rng *r, bool boards)
{
    const int n = (int)rng_int(r, 1, 3);
    for (int i = 0; i < n; i++) {
        polyset one;
        polyset_init(&one);
        if (boards)
            board(&one, r, 2, SPACING_UNIT, true, 80);
        else
            random_simple(&one, r, (int)rng_int(r, 3, 5), 4);
        polyset_move(&one, (double)rng_int(r, -2, 2), (double)rng_int(r, -2, 2));
        polyset_append(set, &one);
        polyset_free(&one);
    }
}

void random_pair(polyset *p, polyset *q, rng *r, pair_kind kind)
{
    polyset_init(p);
    polyset_init(q);
    switch (kind) {
    case PAIR_SQUARES:
        board(p, r, 4, SPACING_UNIT, false, 65);
        board(q, r, 3, SPACING_UNIT, false, 65);
        break;
    case PAIR_STEPS:
        board(p, r, 4, SPACING_SMALL, false, 65);
        board(q, r, 2, SPACING_SMALL, false, 65);
        break;
    case PAIR_TRIANGLES:
        board(p, r, 3, SPACING_UNIT, true, 65);
        board(q, r, 2, SPACING_UNIT, true, 65);
        break;
    case PAIR_TRIANGLE_STEPS:
        board(p, r, 3, SPACING_SMALL, true, 65);
        board(q, r, 2, SPACING_SMALL, true, 65);
        break;
    case PAIR_PEG: fit(p, q, r, 0); break;
    case PAIR_SLIDE: fit(p, q, r, (int)rng_int(r, 1, 2)); break;
    case PAIR_SLANTED:
        board(p, r, 3, SPACING_UNIT, true, 65);
        board(q, r, 2, SPACING_UNIT, true, 65);
        random_map(p, q, r);
        break;
    case PAIR_SIMPLE:
        random_simple(p, r, (int)rng_int(r, 3, 7), (int)rng_int(r, 3, 9));
        random_simple(q, r, (int)rng_int(r, 3, 6), (int)rng_int(r, 3, 9));
        break;
    case PAIR_MEMBERS:
        several(p, r, false);
        several(q, r, false);
        break;
    case PAIR_BOARDS:
        several(p, r, true);
        several(q, r, true);
        break;
    case PAIR_HOLES:
        board(p, r, 5, SPACING_UNIT, rng_once_in(r, 2), 75);
        board(q, r, 3, SPACING_UNIT, false, 85);
        break;
    case PAIR_ROOMS:
        board(p, r, 6, SPACING_SMALL, rng_once_in(r, 2), 65);
        polyset_scale(p, 2, 2);
        board(q, r, 2, SPACING_UNIT, rng_once_in(r, 2), 65);
        if (rng_once_in(r, 2)) random_map(p, q, r);
        break;
    case PAIR_MAP:
        board(p, r, 3, SPACING_MAP, true, 65);
        board(q, r, 2, SPACING_MAP, true, 65);
        break;
    case PAIR_BUILDINGS:
        random_building(p, r);
        random_building(q, r);
        polyset_negate(q);
        break;
    case PAIR_RAGGED:
        board(p, r, 3, SPACING_RAGGED, true, 65);
        board(q, r, 2, SPACING_RAGGED, true, 65);
        break;
    case PAIR_SELF:
        board(p, r, 3, rng_once_in(r, 2) ? SPACING_UNIT : SPACING_RAGGED, true, 65);
        polyset_append(q, p);
        if (rng_once_in(r, 2)) polyset_negate(q);
        break;
    case PAIR_HUGE:
        board(p, r, 2, SPACING_HUGE, true, 70);
        board(q, r, 2, SPACING_HUGE, true, 70);
        break;
    case PAIR_KINDS: break;
    }
}

void bring_together(const polyset *p, polyset *q, rng *r)
{
    for (int k = 0; k < 2; k++) {
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
        for (size_t i = 0; i < p->vertices; i++) {
            low[0] = fmin(low[0], p->xy[2 * i + (size_t)k]);
            high[0] = fmax(high[0], p->xy[2 * i + (size_t)k]);
        }
        for (size_t i = 0; i < q->vertices; i++) {
            low[1] = fmin(low[1], q->xy[2 * i + (size_t)k]);
            high[1] = fmax(high[1], q->xy[2 * i + (size_t)k]);
        }
        const double d = floor((low[0] + high[0] - low[1] - high[1]) / 2) + (double)rng_int(r, -3, 3);
        polyset_move(q, k ? 0 : d, k ? d : 0);
    }
}

/* A point with small even coordinates, so that midpoints of two are integers. */
static bool small(const double *a)
{
    return fabs(a[0]) < 1e6 && fabs(a[1]) < 1e6 && a[0] == rint(a[0]) && a[1] == rint(a[1]);
}

static void dress_ring(polyset *out, rng *r, const double *xy, size_t n)
{
    const bool turn = rng_once_in(r, 2), repeat = rng_once_in(r, 3), halve = rng_once_in(r, 3);
    const size_t start = (size_t)rng_int(r, 0, (int64_t)n - 1);
    const double *first = NULL;
    for (size_t i = 0; i < n; i++) {
        const double *a = xy + 2 * ((turn ? 2 * n - start - i : start + i) % n);
        const double *b = xy + 2 * ((turn ? 2 * n - start - i - 1 : start + i + 1) % n);
        if (!first) first = a;
        polyset_vertex(out, a[0], a[1]);
        if (repeat && rng_once_in(r, 3)) polyset_vertex(out, a[0], a[1]);
        const double m[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
        if (halve && small(a) && small(b)) polyset_vertex(out, m[0], m[1]);
    }
    if (rng_once_in(r, 2)) polyset_vertex(out, first[0], first[1]);
    polyset_end_ring(out);
}

/* The numbers from `first` to `end` - 1, in random order. */
static size_t *shuffled(rng *r, size_t first, size_t end)
{
    const size_t n = end - first;
    size_t *number = test_alloc(n + 1, sizeof *number);
    for (size_t k = 0; k < n; k++) {
        const size_t at = (size_t)rng_int(r, 0, (int64_t)k);
        number[k] = number[at];
        number[at] = first + k;
    }
    return number;
}

void random_dress(polyset *set, rng *r)
{
    polyset out;
    polyset_init(&out);
    size_t *member = shuffled(r, 0, set->polygons);
    for (size_t k = 0; k < set->polygons; k++) {
        const size_t p = member[k], outer = p ? set->poly_end[p - 1] : 0, rings = set->poly_end[p] - outer;
        size_t *hole = shuffled(r, outer + 1, outer + rings);
        for (size_t i = 0; i < rings; i++) {
            const size_t ring = i ? hole[i - 1] : outer, from = ring ? set->ring_end[ring - 1] : 0;
            dress_ring(&out, r, set->xy + 2 * from, set->ring_end[ring] - from);
        }
        free(hole);
        polyset_end_polygon(&out);
    }
    free(member);
    polyset_free(set);
    *set = out;
}
