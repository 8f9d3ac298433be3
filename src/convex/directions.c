/* directions.c: ranks directions. The vectors are rotated into one half-plane, sorted there, by doubles where these are
 * certain and by cross products elsewhere, and numbered; a vector that was rotated has a rank half a turn higher. */
#include "convex/directions.h"

#include "base/sort.h"
#include "predicate/predicate.h"
#include "predicate/turn.h"

#include <string.h>

typedef struct keys {
    sunder_i_lattice *lattice;
    const sunder_i_point *key; /* the vectors, with angles in [0, pi) */
} keys;

static int compare_keys(void *context, uint32_t a, uint32_t b)
{
    const keys *k = context;
    return -sunder_i_cross_sign(k->lattice, k->key[a], k->key[b]); /* correct, since both are in one half-plane */
}

static int compare_numbers(void *context, uint32_t a, uint32_t b)
{
    (void)context;
    return (a > b) - (a < b);
}

/* The turns (turn.h) of integer vectors of a narrow lattice have an error of a few 2^-52. Two turns that differ by more
 * than this are in the right order. */
#define CERTAIN 0x1p-48

/* Sorts the keys of a narrow lattice. The order is that of compare_keys(), equal keys in the order of their indices.
 * Returns false if out of memory. */
static bool sort_narrow(keys *k, uint32_t *order, size_t n)
{
    sunder_i_valued *v = sunder_i_alloc(2 * n, sizeof *v);
    if (!v) return false;
    for (size_t i = 0; i < n; i++)
        v[i] = (sunder_i_valued){sunder_i_turn((double)k->key[i].x, (double)k->key[i].y), (uint32_t)i, 0};
    bool ok = sunder_i_sort_valued(v, n);
    for (size_t i = 0, j; ok && i < n; i = j) {
        order[i] = v[i].item;
        for (j = i + 1; j < n && v[j].value - v[j - 1].value <= CERTAIN; j++) order[j] = v[j].item;
        if (j - i > 1)
            ok = sunder_i_sort_indices(order + i, j - i, compare_numbers, NULL) &&
                 sunder_i_sort_indices(order + i, j - i, compare_keys, k);
    }
    sunder_i_free(v);
    return ok;
}

/* Numbers the classes in the order of their angles: stores a vector of each class in `out` and the class of each key in
 * `class`. */
static void number_classes(const keys *k, const uint32_t *order, size_t n, uint32_t *class, sunder_i_directions *out)
{
    uint32_t c = 0;
    for (size_t i = 0; i < n; i++) {
        const sunder_i_point key = k->key[order[i]];
        if (i == 0 || sunder_i_cross_sign(k->lattice, k->key[order[i - 1]], key) != 0)
            out->vector[c++] = key;
        else if (!sunder_i_point_is_plain(out->vector[c - 1]) && sunder_i_point_is_plain(key))
            out->vector[c - 1] = key; /* any vector of the class will do, and numbers stay short */
        class[order[i]] = c - 1;
    }
    out->classes = c;
}

static bool sort_directions(sunder_i_lattice *l, sunder_i_point *side, size_t n, uint32_t *order, bool *turned,
                            uint32_t *rank, sunder_i_directions *out)
{
    keys k = {l, side};
    for (size_t i = 0; i < n; i++) {
        order[i] = (uint32_t)i;
        turned[i] = sunder_i_direction_half(l, side[i]) == 1;
        if (turned[i]) side[i] = sunder_i_point_neg(l, side[i]);
    }
    if (!(l->narrow ? sort_narrow(&k, order, n) : sunder_i_sort_indices(order, n, compare_keys, &k))) return false;
    number_classes(&k, order, n, rank, out);
    for (size_t i = 0; i < n; i++)
        if (turned[i]) rank[i] += out->classes;
    return !l->arena.failed; /* on failure the ranks are not those of convex pieces */
}

bool sunder_i_directions_rank(sunder_i_lattice *lattice, sunder_i_point *side, size_t n, uint32_t *rank,
                              sunder_i_directions *out)
{
    uint32_t *order = sunder_i_alloc(n, sizeof *order);
    bool *turned = sunder_i_alloc(n, sizeof *turned);
    *out = (sunder_i_directions){0, sunder_i_alloc(n, sizeof *out->vector)};
    const bool ok = order && turned && out->vector && sort_directions(lattice, side, n, order, turned, rank, out);
    sunder_i_free_all(order, turned);
    if (!ok) sunder_i_directions_free(out);
    return ok;
}

void sunder_i_directions_free(sunder_i_directions *directions)
{
    sunder_i_free(directions->vector);
    memset(directions, 0, sizeof *directions);
}
