/* rank.c: sorts coordinates as keys. The function below returns the index of a coordinate by binary search, and counts
 * comparisons. */
#include "base/sort.h"
#include "base/watch.h"
#include "rectilinear/rectangles.h"

static uint32_t rank_of(const int64_t *at, uint32_t n, int64_t what, uint64_t *comparisons)
{
    const int64_t *low = at;
    while (n > 1) {
        const uint32_t half = n / 2;
        low += low[half] <= what ? half : 0;
        n -= half;
        ++*comparisons;
    }
    return (uint32_t)(low - at);
}

/* Keys are coordinates minus the least one: they have the same order, and are as short as possible, whatever the signs.
 * The number of the coordinate is appended to each key if there is room: then ranks follow directly. */
typedef struct keys {
    uint64_t *key; /* [n] */
    size_t n;
    int64_t least;
    int tag; /* the bits of the numbers, or 0 if there is no room */
} keys;

static int64_t coordinate_of(const sunder_i_rectangle_list *list, size_t i, int axis)
{
    const sunder_i_rectangle *r = &list->item[i / 2];
    return i % 2 ? r->high[axis] : r->low[axis];
}

static uint32_t *rank_slot(const sunder_i_ranked_rectangles *ranked, size_t i, int axis)
{
    sunder_i_ranked_rectangle *r = &ranked->item[i / 2];
    return i % 2 ? &r->high[axis] : &r->low[axis];
}

static bool make_keys(const sunder_i_rectangle_list *list, int axis, keys *k)
{
    int64_t most = list->item[0].high[axis];
    k->least = list->item[0].low[axis];
    for (size_t i = 1; i < list->n; i++) {
        const sunder_i_rectangle *r = &list->item[i];
        if (r->low[axis] < k->least) k->least = r->low[axis];
        if (r->high[axis] > most) most = r->high[axis];
    }
    k->n = 2 * list->n;
    k->key = sunder_i_alloc(k->n, sizeof *k->key);
    if (!k->key) return false;
    const int bits = 64 - __builtin_clzll(k->n - 1); /* n is at least two */
    k->tag = ((uint64_t)most - (uint64_t)k->least) >> (64 - bits) ? 0 : bits;
    for (size_t i = 0; i < k->n; i++) {
        const uint64_t key = (uint64_t)coordinate_of(list, i, axis) - (uint64_t)k->least;
        k->key[i] = k->tag ? key << k->tag | i : key;
    }
    return sunder_i_sort_keys(k->key, k->n);
}

static bool rank_axis(const sunder_i_rectangle_list *list, int axis, sunder_i_ranked_rectangles *out)
{
    keys k;
    const bool ok = make_keys(list, axis, &k);
    int64_t *at = out->at[axis] = (int64_t *)k.key; /* there are at most as many coordinates as keys */
    if (!ok) return false;
    uint32_t n = 0;
    for (size_t i = 0; i < k.n; i++) {
        const uint64_t key = k.key[i];
        const int64_t v = (int64_t)((key >> k.tag) + (uint64_t)k.least);
        if (n == 0 || at[n - 1] != v) at[n++] = v;
        if (k.tag) *rank_slot(out, key & (((uint64_t)1 << k.tag) - 1), axis) = n - 1;
    }
    out->places[axis] = n;
    for (size_t i = 0; k.tag == 0 && i < k.n; i++)
        *rank_slot(out, i, axis) = rank_of(at, n, coordinate_of(list, i, axis), &out->comparisons);
    return sunder_i_steps(list->n / 8 + 1);
}

bool sunder_i_rectangles_rank(const sunder_i_rectangle_list *list, sunder_i_ranked_rectangles *out)
{
    memset(out, 0, sizeof *out);
    out->n = (uint32_t)list->n;
    out->item = sunder_i_alloc(list->n, sizeof *out->item);
    if (out->item && rank_axis(list, 0, out) && rank_axis(list, 1, out)) return true;
    sunder_i_ranked_rectangles_free(out);
    return false;
}

void sunder_i_ranked_rectangles_free(sunder_i_ranked_rectangles *ranked)
{
    sunder_i_free(ranked->item);
    for (int axis = 0; axis < 2; axis++) sunder_i_free(ranked->at[axis]);
    memset(ranked, 0, sizeof *ranked);
}
