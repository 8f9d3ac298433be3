/* Coordinates sorted as keys, each found again by bisection. */
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

/* Keys are counted from here: so they are in the order of the coordinates, and as short as can be, whatever their
 * signs. */
static int64_t least_along(const sunder_i_rectangle_list *list, int axis)
{
    int64_t least = list->item[0].low[axis];
    for (size_t i = 1; i < list->n; i++)
        if (list->item[i].low[axis] < least) least = list->item[i].low[axis];
    return least;
}

static bool rank_axis(const sunder_i_rectangle_list *list, int axis, sunder_i_ranked_rectangles *out)
{
    uint64_t *key = sunder_i_alloc(2 * list->n, sizeof *key);
    if (!key) return false;
    const int64_t least = least_along(list, axis);
    for (size_t i = 0; i < list->n; i++) {
        key[2 * i] = (uint64_t)list->item[i].low[axis] - (uint64_t)least;
        key[2 * i + 1] = (uint64_t)list->item[i].high[axis] - (uint64_t)least;
    }
    if (!sunder_i_sort_keys(key, 2 * list->n)) {
        sunder_i_free(key);
        return false;
    }
    int64_t *at = out->at[axis] = (int64_t *)key;
    uint32_t n = 0;
    for (size_t i = 0; i < 2 * list->n; i++) {
        const int64_t v = (int64_t)(key[i] + (uint64_t)least);
        if (n == 0 || at[n - 1] != v) at[n++] = v;
    }
    out->places[axis] = n;
    for (size_t i = 0; i < list->n; i++) {
        out->item[i].low[axis] = rank_of(at, n, list->item[i].low[axis], &out->comparisons);
        out->item[i].high[axis] = rank_of(at, n, list->item[i].high[axis], &out->comparisons);
    }
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
