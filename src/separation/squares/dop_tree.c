/* dop_tree.c: see dop_tree.h. A node is divided at the median of that one of the sixteen bounds in which its pieces
 * differ most. This separates long pieces from short ones, and pieces of different directions. */
#include "separation/squares/dop_tree.h"

#include "base/invariant.h"
#include "base/random.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

static const double WAY[SUNDER_I_DOP_WAYS][2] = {{1, 0},
                                                 {0x1.d906bcf328d46p-1, 0x1.87de2a6aea963p-2},
                                                 {0x1.6a09e667f3bcdp-1, 0x1.6a09e667f3bcdp-1},
                                                 {0x1.87de2a6aea963p-2, 0x1.d906bcf328d46p-1},
                                                 {0, 1},
                                                 {-0x1.87de2a6aea963p-2, 0x1.d906bcf328d46p-1},
                                                 {-0x1.6a09e667f3bcdp-1, 0x1.6a09e667f3bcdp-1},
                                                 {-0x1.d906bcf328d46p-1, 0x1.87de2a6aea963p-2}};

double sunder_i_float_scale(const sunder_i_operands *operands) { return ldexp(1, -ilogb(operands->magnitude)); }

/* With coordinates up to M, which are floats, a bound of a set is below 1.42 M and has an error of 2^-24 of 2.9 M, and
 * so has the bound of the other set; their sum adds 2^-24 of 2.9 M. Squares extend to 2 M, so that their bounds are
 * below 2.9 M, with the same error; the errors of doubles and of the directions are negligible. The sum is less than
 * 2^-24 * 12 M. */
#define FLOAT_ERROR 0x1p-20

sunder_i_dop sunder_i_dop_query(const sunder_i_operands *operands, const double square[4], double by)
{
    const double x = square[0] / 2 + square[2] / 2, y = square[1] / 2 + square[3] / 2;
    const double hx = square[2] / 2 - square[0] / 2, hy = square[3] / 2 - square[1] / 2,
                 scale = sunder_i_float_scale(operands);
    sunder_i_dop out;
    for (int k = 0; k < SUNDER_I_DOP_WAYS; k++) {
        const double middle = x * WAY[k][0] + y * WAY[k][1];
        const double reach = hx * fabs(WAY[k][0]) + hy * fabs(WAY[k][1]) + FLOAT_ERROR * operands->magnitude + by;
        out.low[k] = (float)(scale * (middle - reach));
        out.high[k] = (float)(scale * (middle + reach));
    }
    return out;
}

static const sunder_i_dop NOWHERE = {
    {INFINITY, INFINITY, INFINITY, INFINITY, INFINITY, INFINITY, INFINITY, INFINITY},
    {-INFINITY, -INFINITY, -INFINITY, -INFINITY, -INFINITY, -INFINITY, -INFINITY, -INFINITY}};

static void include_extent(sunder_i_dop *all, const sunder_i_dop *one)
{
    for (int k = 0; k < SUNDER_I_DOP_WAYS; k++) {
        all->low[k] = one->low[k] < all->low[k] ? one->low[k] : all->low[k];
        all->high[k] = one->high[k] > all->high[k] ? one->high[k] : all->high[k];
    }
}

sunder_i_dop sunder_i_dop_nowhere(void) { return NOWHERE; }

void sunder_i_dop_add(sunder_i_dop *extents, float x, float y)
{
    sunder_i_dop at;
    for (int k = 0; k < SUNDER_I_DOP_WAYS; k++) at.low[k] = at.high[k] = (float)(x * WAY[k][0] + y * WAY[k][1]);
    include_extent(extents, &at);
}

typedef struct planter {
    sunder_i_dop_tree *tree;
    const sunder_i_dop *extent; /* the extents of each piece */
    uint32_t *list;
    uint64_t *key;
} planter;

static float bound_of(const sunder_i_dop *e, int k)
{
    return k < SUNDER_I_DOP_WAYS ? e->low[k] : e->high[k - SUNDER_I_DOP_WAYS];
}

/* Returns the bound in which the n pieces from list[from] on differ most. */
static int widest_bound(const planter *p, size_t from, size_t n)
{
    sunder_i_dop least = p->extent[p->list[from]], most = least;
    for (size_t i = from + 1; i < from + n; i++) {
        const sunder_i_dop *e = p->extent + p->list[i];
        for (int k = 0; k < SUNDER_I_DOP_WAYS; k++) {
            least.low[k] = e->low[k] < least.low[k] ? e->low[k] : least.low[k];
            least.high[k] = e->high[k] < least.high[k] ? e->high[k] : least.high[k];
            most.low[k] = e->low[k] > most.low[k] ? e->low[k] : most.low[k];
            most.high[k] = e->high[k] > most.high[k] ? e->high[k] : most.high[k];
        }
    }
    int best = 0;
    for (int k = 1; k < 2 * SUNDER_I_DOP_WAYS; k++)
        if (bound_of(&most, k) - bound_of(&least, k) > bound_of(&most, best) - bound_of(&least, best)) best = k;
    return best;
}

/* Converts a float to an integer with the same order. */
static uint32_t ordered_bits(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

/* Moves the m least of n keys, no two of which are equal, to the front. Expected linear time [Hoa61]. */
static void select_least(uint64_t *key, size_t n, size_t m)
{
    uint64_t seed = n;
    size_t low = 0, high = n; /* keys before `low` are among the least, keys from `high` on are not */
    while (high - low > 1) {
        const uint64_t pivot = key[low + sunder_i_draw(&seed) % (high - low)];
        size_t i = low, j = high;
        for (;;) {
            while (key[i] < pivot) i++;
            while (key[--j] > pivot) {
            }
            if (i >= j) break;
            const uint64_t swap = key[i];
            key[i++] = key[j];
            key[j] = swap;
        }
        if (i == low) i++; /* the pivot is the least of the keys */
        if (m < i)
            high = i;
        else
            low = i;
        if (m == low || m == high) return;
    }
}

/* Divides the n pieces from list[from] on by the median of a bound, the lesser half first. */
static void halve_by(planter *p, size_t from, size_t n, int bound)
{
    for (size_t i = 0; i < n; i++) {
        const uint32_t piece = p->list[from + i];
        p->key[i] = (uint64_t)ordered_bits(bound_of(p->extent + piece, bound)) << 32 | piece;
    }
    select_least(p->key, n, n - n / 2);
    for (size_t i = 0; i < n; i++) p->list[from + i] = (uint32_t)p->key[i];
}

/* Builds the subtree of `node` for the n pieces from list[from] on; the left half has as many as the right one, or one
 * more. Returns false if the computation must stop. */
static bool plant_node(planter *p, uint32_t node, size_t from, size_t n)
{
    sunder_i_dop_tree *t = p->tree;
    if (node >= t->leaves) {
        t->piece[node - t->leaves] = n ? p->list[from] : UINT32_MAX;
        t->extent[node] = n ? p->extent[p->list[from]] : NOWHERE;
        return true;
    }
    if (!sunder_i_steps(n)) return false;
    if (n > 1) halve_by(p, from, n, widest_bound(p, from, n));
    if (!plant_node(p, 2 * node, from, n - n / 2) || !plant_node(p, 2 * node + 1, from + n - n / 2, n / 2))
        return false;
    t->extent[node] = t->extent[2 * node];
    include_extent(&t->extent[node], &t->extent[2 * node + 1]);
    return true;
}

#ifndef NDEBUG
static bool has_extent(const sunder_i_dop *all, const sunder_i_dop *one)
{
    for (int k = 0; k < SUNDER_I_DOP_WAYS; k++)
        if (one->low[k] < all->low[k] || one->high[k] > all->high[k]) return false;
    return true;
}

/* Returns NULL, or what is wrong. */
static const char *check_tree(const sunder_i_dop_tree *t, const sunder_i_dop *extent, uint32_t n)
{
    uint32_t pieces = 0;
    for (uint32_t k = 1; k < t->leaves; k++)
        if (!has_extent(&t->extent[k], &t->extent[2 * k]) || !has_extent(&t->extent[k], &t->extent[2 * k + 1]))
            return "a node does not hold its children";
    for (uint32_t i = 0; i < t->leaves; i++) {
        if (t->piece[i] == UINT32_MAX) continue;
        if (!has_extent(&t->extent[t->leaves + i], &extent[t->piece[i]])) return "a leaf does not hold its piece";
        pieces++;
    }
    return pieces == n ? NULL : "pieces are missing";
}
#endif

bool sunder_i_dop_tree_build(sunder_i_dop_tree *tree, const sunder_i_dop *extent, uint32_t n)
{
    *tree = (sunder_i_dop_tree){.leaves = 1};
    while (tree->leaves < n) tree->leaves *= 2;
    tree->piece = sunder_i_alloc(tree->leaves, sizeof *tree->piece);
    tree->extent = sunder_i_alloc(2 * (size_t)tree->leaves, sizeof *tree->extent);
    planter p = {tree, extent, sunder_i_alloc(n, sizeof *p.list), sunder_i_alloc(n, sizeof *p.key)};
    bool ok = tree->piece && tree->extent && p.list && p.key;
    for (uint32_t i = 0; ok && i < n; i++) p.list[i] = i;
    ok = ok && plant_node(&p, 1, 0, n);
    SUNDER_I_CHECK(ok ? check_tree(tree, extent, n) : NULL, n);
    sunder_i_free_all(p.list, p.key);
    return ok;
}

void sunder_i_dop_tree_free(sunder_i_dop_tree *tree)
{
    sunder_i_free_all(tree->piece, tree->extent);
    *tree = (sunder_i_dop_tree){0};
}
