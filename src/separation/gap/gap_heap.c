/* gap_heap.c: the priority queue of the search with a gap. Its items are parts of the boundary and points; the key is a
 * lower bound of their distance from the origin. */
#include "separation/gap/gap_search.h"

#include "base/heap.h"

/* Compares keys only; the heap itself orders equal keys (base/heap.h). */
static bool key_before(const void *a, const void *b)
{
    return ((const sunder_i_gap_item *)a)->key < ((const sunder_i_gap_item *)b)->key;
}

void sunder_i_gap_push_item(sunder_i_gap_state *s, sunder_i_gap_item item)
{
    if (item.key > s->best) return;
    if (!sunder_i_arena_reserve(&s->g->placed.lattice.arena, &s->heap, &s->heap_capacity, s->heap_n + 1, sizeof item))
        s->failed = true;
    else
        sunder_i_heap_push(s->heap, &s->heap_n, sizeof item, &item, key_before);
}

sunder_i_gap_item sunder_i_gap_pop_item(sunder_i_gap_state *s)
{
    sunder_i_gap_item top;
    sunder_i_heap_pop(s->heap, &s->heap_n, sizeof top, &top, key_before);
    return top;
}

void sunder_i_gap_push(sunder_i_gap_state *s, double key, const sunder_i_gap_point *p)
{
    if (key > s->best) return;
    if (!sunder_i_arena_reserve(&s->g->placed.lattice.arena, &s->points, &s->points_capacity, s->points_n + 1,
                                sizeof *p)) {
        s->failed = true;
        return;
    }
    s->points[s->points_n] = *p;
    sunder_i_gap_push_item(s, (sunder_i_gap_item){key > 0 ? key : 0, SUNDER_I_GAP_POINT, s->points_n++});
}
