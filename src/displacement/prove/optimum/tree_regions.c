/* Saved regions of open nodes.
 *
 * The state of a node can be recomputed from the cuts on its path, one clip after the other; a copy saved when the node
 * was opened is equal to it. A tree saves regions up to a total size; beyond that they are recomputed. */
#include "displacement/prove/optimum/tree.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/stage_switch.h"

#include <string.h>

/* The header of one pair's saved region; its corners follow, then the cuts of its sides. */
typedef struct kept_region {
    uint32_t pair, n;
    double blur;
} kept_region;

static size_t size_of(uint32_t corners)
{
    const size_t cuts = corners * sizeof(uint32_t), odd = cuts % sizeof(double);
    return sizeof(kept_region) + 2 * corners * sizeof(double) + cuts + (odd ? sizeof(double) - odd : 0);
}

void sunder_i_tree_keep_regions(sunder_i_tree *tree, uint32_t node)
{
    size_t size = 0;
    for (size_t k = 0; k < tree->touched.n; k++) size += size_of(tree->pair[tree->touched.item[k]].region.n);
    if (size == 0 || tree->kept_bytes + size > MOST_KEPT_BYTES || !sunder_i_stage_is_on("memo", "regions")) return;
    char *at = sunder_i_alloc(size, 1);
    if (!at) {
        tree->failed = true;
        return;
    }
    tree->node[node].regions = at;
    tree->node[node].regions_size = size;
    tree->kept_bytes += size;
    for (size_t k = 0; k < tree->touched.n; k++) {
        const uint32_t pair = tree->touched.item[k];
        const sunder_i_region *r = &tree->pair[pair].region;
        const kept_region head = {pair, r->n, r->blur};
        memcpy(at, &head, sizeof head);
        memcpy(at + sizeof head, r->xy, 2 * r->n * sizeof *r->xy);
        memcpy(at + sizeof head + 2 * r->n * sizeof *r->xy, r->cut, r->n * sizeof *r->cut);
        at += size_of(r->n);
    }
}

static void drop_regions(sunder_i_tree *tree, uint32_t node)
{
    sunder_i_free(tree->node[node].regions);
    tree->kept_bytes -= tree->node[node].regions_size;
    tree->node[node].regions = NULL;
    tree->node[node].regions_size = 0;
}

void sunder_i_tree_take_regions(sunder_i_tree *tree, uint32_t node)
{
    const char *at = tree->node[node].regions, *end = at + tree->node[node].regions_size;
    while (at < end) {
        kept_region head;
        memcpy(&head, at, sizeof head);
        sunder_i_region *r = &tree->pair[head.pair].region;
        /* Pairs that only a trial had cut keep their initial region. */
        if (tree->pair[head.pair].touched) {
            r->n = head.n;
            r->blur = head.blur;
            memcpy(r->xy, at + sizeof head, 2 * head.n * sizeof *r->xy);
            memcpy(r->cut, at + sizeof head + 2 * head.n * sizeof *r->xy, head.n * sizeof *r->cut);
        }
        at += size_of(head.n);
    }
    drop_regions(tree, node);
}

