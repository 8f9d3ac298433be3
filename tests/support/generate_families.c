/* Larger pairs of operands, similar to the families of the literature. */
#include "generate.h"

#include <math.h>

const char *family_kind_string(family_kind kind)
{
    static const char *const names[FAMILY_KINDS] = {
        "star + star",        "comb + convex", "slanted comb + star",      "fork + fork",
        "many convex + star", "rooms + star",  "rooms at map coordinates", "buildings",
        "cells + cells"};
    return names[kind];
}

static void many_convex(polyset *set, rng *r, int n, double spread)
{
    for (int i = 0; i < n; i++) {
        polyset m;
        polyset_init(&m);
        random_convex(&m, r, (int)rng_int(r, 4, 9), spread / 8);
        polyset_move(&m, rint(spread * rng_unit(r)), rint(spread * rng_unit(r)));
        polyset_append(set, &m);
        polyset_free(&m);
    }
}

static void rooms(polyset *set, rng *r, spacing kind, int size, int percent)
{
    cells c;
    random_cells(&c, r, size, size, kind, true, percent);
    cells_outline(set, &c, rng_once_in(r, 3), rng_once_in(r, 2));
}

void random_family(polyset *p, polyset *q, rng *r, family_kind kind, int low, int high)
{
    const int n = (int)rng_int(r, low, high), board = n >= 30 ? 7 : 5;
    polyset_init(p);
    polyset_init(q);
    switch (kind) {
    case FAMILY_STAR:
        random_star(p, r, n, 100000);
        random_star(q, r, n, 100000);
        break;
    case FAMILY_COMB:
        random_comb(p, r, n / 4, 100000, rng_once_in(r, 2));
        random_convex(q, r, n, 9000);
        break;
    case FAMILY_SLANTED:
        random_comb(p, r, n / 4, 100000, true);
        random_star(q, r, n / 2, 50000);
        break;
    case FAMILY_FORK:
        random_fork(p, r, n / 8 + 1, 100000, false);
        random_fork(q, r, n / 8 + 1, 100000, true);
        break;
    case FAMILY_ROBOT:
        many_convex(p, r, n / 3, 200000);
        random_star(q, r, n, 20000);
        break;
    case FAMILY_ROOMS:
        rooms(p, r, SPACING_SMALL, board, 65);
        polyset_scale(p, 7, 7);
        random_star(q, r, 12, 8);
        break;
    case FAMILY_MAP:
        rooms(p, r, SPACING_MAP, board, 65);
        random_star(q, r, 12, 9);
        break;
    case FAMILY_TOWN:
        for (int i = 0; i < n / 6; i++) random_building(p, r);
        random_building(q, r);
        polyset_negate(q);
        break;
    case FAMILY_CELLS:
        rooms(p, r, SPACING_UNIT, board, 70);
        rooms(q, r, SPACING_UNIT, board - 3, 60);
        break;
    case FAMILY_KINDS: break;
    }
}
