/* Which obstacles are near a place in the plane of one relative move?
 *
 * Between two blocks of dozens of houses there are tens of thousands of obstacles; a place is in some hundred of them,
 * and thousands of places are tested. So there is a tree of boxes over all obstacles, in the order of a space-filling
 * curve. Later obstacles are appended and tested one by one, until they are too many. Obstacles that a question ignores
 * are still in the tree: their runs are skipped. A question that has only a small part of the obstacles lists these,
 * and tests each. */
#include "displacement/prove/proofs/plane.h"

#include "spatial/curve.h"

#include <stddef.h>
#include <string.h>

bool sunder_i_plane_index_add(struct sunder_i_plane_kept *kept, uint32_t at)
{
    if (!sunder_i_reserve(&kept->item, &kept->item_capacity, kept->items + 1, sizeof *kept->item)) return false;
    sunder_i_plane_item *item = &kept->item[kept->items++];
    memcpy(item->box, kept->box + 4 * (size_t)at, sizeof item->box);
    item->at = at;
    item->run = kept->obstacle[at].run;
    return true;
}

static void add_box(const void *of, size_t k, double box[4])
{
    const struct sunder_i_plane_kept *kept = of;
    sunder_i_box_join(box, kept->item[k].box);
}

static bool build_index(struct sunder_i_plane_kept *kept)
{
    if (!sunder_i_curve_sort_records(kept->item, kept->items, sizeof *kept->item, offsetof(sunder_i_plane_item, box)))
        return false;
    sunder_i_free(kept->tree.box);
    kept->tree = sunder_i_box_tree_of(kept->items, PLANE_LEAF);
    kept->tree.box = sunder_i_alloc(2 * kept->tree.leaves, sizeof *kept->tree.box);
    if (!kept->tree.box) {
        kept->tree.n = 0;
        return false;
    }
    sunder_i_box_tree_fill(&kept->tree, add_box, kept);
    return true;
}

bool sunder_i_plane_index_list(const struct sunder_i_plane_kept *kept, const sunder_i_plane_run *run,
                               sunder_i_plane_item **list, size_t *n, size_t *capacity)
{
    if (!sunder_i_reserve(list, capacity, *n + run->reached, sizeof **list)) return false;
    for (size_t k = run->first; k < run->end; k++) {
        const double *box = kept->box + 4 * k;
        if (!(box[0] <= box[2])) continue;
        sunder_i_plane_item *item = &(*list)[(*n)++];
        memcpy(item->box, box, sizeof item->box);
        item->at = (uint32_t)k;
        item->run = kept->obstacle[k].run;
    }
    return true;
}

/* Lists all obstacles of the present question. Returns false if memory is out. */
static bool list_all(sunder_i_plane *g)
{
    size_t n = 0;
    for (size_t r = 0; r < g->runs; r++)
        if (!sunder_i_plane_index_list(g->kept, &g->kept->run[g->run[r]], &g->few, &n, &g->few_capacity)) return false;
    return true;
}

bool sunder_i_plane_index_begin(sunder_i_plane *plane)
{
    struct sunder_i_plane_kept *kept = plane->kept;
    plane->are_few = plane->obstacles <= PLANE_FEW || plane->obstacles < kept->items / PLANE_PART;
    if (plane->are_few) return list_all(plane);
    if (kept->items - kept->tree.n > PLANE_FEW + kept->tree.n / PLANE_LATE && !build_index(kept)) return false;
    return true;
}

/* Adds those items of [item, end) to plane->place that are forbidden and whose boxes contain the place u. */
static void take_items(sunder_i_plane *g, sunder_i_plane_item *item, const sunder_i_plane_item *end, const double u[2])
{
    const sunder_i_plane_run *run = g->kept->run;
    for (; item < end; item++)
        if (sunder_i_plane_is_in(item->box, u) && run[item->run].asked) g->place[g->about_place++] = item;
}

/* A short list is tested completely and without branches: the processor would mispredict half of them. */
static void take_few(sunder_i_plane *g, const double u[2])
{
    size_t n = 0;
    for (size_t k = 0; k < g->obstacles; k++) {
        g->place[n] = &g->few[k];
        n += (size_t)sunder_i_plane_is_in(g->few[k].box, u);
    }
    g->about_place = n;
}

static void walk_tree(sunder_i_plane *g, const double u[2])
{
    const struct sunder_i_plane_kept *kept = g->kept;
    const sunder_i_box_tree *tree = &kept->tree;
    sunder_i_box_walk walk;
    sunder_i_box_walk_start(&walk, tree);
    for (size_t node; sunder_i_box_walk_next(&walk, &node);) {
        if (!sunder_i_plane_is_in(tree->box[node], u)) continue;
        if (node < tree->leaves)
            sunder_i_box_walk_open(&walk, 2 * node + 1, 2 * node);
        else
            take_items(g, kept->item + sunder_i_box_tree_first(tree, node),
                       kept->item + sunder_i_box_tree_end(tree, node), u);
    }
    take_items(g, kept->item + tree->n, kept->item + kept->items, u);
}

bool sunder_i_plane_index_find(sunder_i_plane *plane, const double u[2])
{
    if (!sunder_i_reserve(&plane->place, &plane->place_capacity, plane->obstacles + 1, sizeof *plane->place))
        return false;
    plane->about_place = 0;
    if (plane->are_few)
        take_few(plane, u);
    else
        walk_tree(plane, u);
    return true;
}
