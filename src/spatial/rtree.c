/* rtree.c: a packed R-tree: boxes sorted along a Hilbert curve, sixteen in a node, level by level [KF93]. Boxes are
 * closed, and a query misses nothing: the boxes of nodes are the exact hulls of those below, also when a box moves,
 * since they are then recomputed from the leaf to the root. Leaves stay in their nodes, so that nodes become larger as
 * their leaves move apart; when they have grown by half, the tree is worn, and a caller that moves boxes builds it
 * again. If the curve's grid is too coarse to distinguish centres, only speed is affected. */
#include "spatial/rtree.h"

#include "base/sort.h"

#include <string.h>

/* The number of children of a node: large, so that few levels must be updated when a box moves. */
#define FANOUT SUNDER_I_RTREE_RUN
/* The tree is worn when its nodes have grown by this factor since it was packed: queries then visit about that many
 * times the nodes, and building it again costs about as much as one query for each box. */
#define WORN 1.5

/* Returns the position of cell (x, y) of a 65536 x 65536 grid on the Hilbert curve, by halving the square. */
static uint32_t hilbert_index(uint32_t x, uint32_t y)
{
    uint32_t d = 0;
    for (uint32_t s = 1u << 15; s > 0; s >>= 1) {
        const uint32_t rx = (x & s) != 0, ry = (y & s) != 0;
        d += s * s * ((3 * rx) ^ ry);
        if (ry == 0) {
            if (rx == 1) {
                x = 65535 - x;
                y = 65535 - y;
            }
            const uint32_t swap = x;
            x = y;
            y = swap;
        }
    }
    return d;
}

/* Returns the column, one of 65536, that contains the middle of [low, high]; halves prevent overflow. */
static uint32_t cell_of(double low, double high, double all_low, double all_high)
{
    const double width = all_high / 2 - all_low / 2;
    if (!(width > 0)) return 0;
    const double v = ((low / 4 + high / 4) - all_low / 2) / width * 65535;
    return v <= 0 ? 0 : v >= 65535 ? 65535 : (uint32_t)v;
}

/* Makes the sort keys: the position along the curve in the upper half, the item's number in the lower. */
static sunder_status sort_places(const double *box, const bool *present, size_t n, uint64_t **out, size_t *leaves)
{
    uint64_t *places = sunder_i_alloc(n, sizeof *places);
    if (!places) return SUNDER_ENOMEM;
    double all[4];
    sunder_i_box_clear(all);
    for (size_t i = 0; i < n; i++)
        if (!present || present[i]) sunder_i_box_join(all, box + 4 * i);
    size_t k = 0;
    for (size_t i = 0; i < n; i++) {
        if (present && !present[i]) continue;
        const double *b = box + 4 * i;
        const uint32_t along = hilbert_index(cell_of(b[0], b[2], all[0], all[2]), cell_of(b[1], b[3], all[1], all[3]));
        places[k++] = (uint64_t)along << 32 | i;
    }
    if (!sunder_i_sort_keys(places, k)) {
        sunder_i_free(places);
        return SUNDER_ENOMEM;
    }
    *out = places;
    *leaves = k;
    return SUNDER_OK;
}

static void hull_of_children(const sunder_i_rtree *tree, unsigned level, size_t node, double box[4])
{
    size_t end;
    sunder_i_box_clear(box);
    for (size_t c = sunder_i_rtree_children(tree, level, node, &end); c < end; c++)
        sunder_i_box_join(box, tree->box + 4 * c);
}

static double size_of(const double box[4]) { return box[2] - box[0] + (box[3] - box[1]); }

sunder_status sunder_i_rtree_build(const double *box, const bool *present, size_t n, sunder_i_rtree *out,
                                   sunder_error *err)
{
    uint64_t *places = NULL;
    size_t leaves = 0;
    if (sort_places(box, present, n, &places, &leaves)) return sunder_i_failure_cause(err);
    sunder_i_rtree tree;
    memset(&tree, 0, sizeof tree);
    tree.leaves = leaves;
    size_t nodes = leaves, width = leaves;
    tree.level[1] = leaves;
    tree.levels = 1;
    while (width > 1) {
        width = (width + FANOUT - 1) / FANOUT;
        nodes += width;
        tree.level[++tree.levels] = nodes;
    }
    tree.box = sunder_i_alloc(4 * (nodes + 1), sizeof *tree.box);
    tree.item = sunder_i_alloc(leaves, sizeof *tree.item);
    tree.leaf = sunder_i_alloc(n, sizeof *tree.leaf);
    if (!tree.box || !tree.item || !tree.leaf) {
        sunder_i_free(places);
        sunder_i_rtree_free(&tree);
        return sunder_i_failure_cause(err);
    }
    memset(tree.box + 4 * nodes, 0, 4 * sizeof *tree.box);
    for (size_t i = 0; i < n && leaves < n; i++) tree.leaf[i] = (uint32_t)nodes;
    for (size_t i = 0; i < leaves; i++) {
        const uint32_t item = (uint32_t)places[i];
        tree.item[i] = item;
        tree.leaf[item] = (uint32_t)i;
        memcpy(tree.box + 4 * i, box + 4 * (size_t)item, 4 * sizeof(double));
    }
    sunder_i_free(places);
    for (unsigned l = 1; l < tree.levels; l++)
        for (size_t node = tree.level[l]; node < tree.level[l + 1]; node++) {
            hull_of_children(&tree, l, node, tree.box + 4 * node);
            tree.packed += size_of(tree.box + 4 * node);
        }
    tree.sprawl = tree.packed;
    *out = tree;
    return SUNDER_OK;
}

sunder_i_rtree sunder_i_rtree_lend(const sunder_i_rtree *tree)
{
    sunder_i_rtree lent = *tree;
    lent.borrows = lent.unmoved = true;
    return lent;
}

sunder_status sunder_i_rtree_own(sunder_i_rtree *tree, sunder_error *err)
{
    if (!tree->unmoved) return SUNDER_OK;
    const size_t n = 4 * ((tree->levels ? tree->level[tree->levels] : 0) + 1);
    double *box = sunder_i_alloc(n, sizeof *box);
    if (!box) return sunder_i_failure_cause(err);
    tree->box = memcpy(box, tree->box, n * sizeof *box);
    tree->unmoved = false;
    return SUNDER_OK;
}

void sunder_i_rtree_move(sunder_i_rtree *tree, uint32_t item, const double box[4])
{
    size_t node = tree->leaf[item];
    memcpy(tree->box + 4 * node, box, 4 * sizeof *box);
    for (unsigned l = 1; l < tree->levels; l++) {
        double hull[4];
        node = tree->level[l] + (node - tree->level[l - 1]) / FANOUT;
        hull_of_children(tree, l, node, hull);
        if (memcmp(hull, tree->box + 4 * node, sizeof hull) == 0) return;
        tree->sprawl += size_of(hull) - size_of(tree->box + 4 * node);
        memcpy(tree->box + 4 * node, hull, sizeof hull);
    }
}

double *sunder_i_rtree_boxes(const sunder_i_rtree *tree, size_t n)
{
    double *box = sunder_i_alloc(4 * n, sizeof *box);
    for (uint32_t i = 0; i < n && box; i++) memcpy(box + 4 * (size_t)i, sunder_i_rtree_box(tree, i), 4 * sizeof *box);
    return box;
}

bool sunder_i_rtree_is_worn(const sunder_i_rtree *tree) { return !(tree->sprawl <= WORN * tree->packed); }

void sunder_i_rtree_free(sunder_i_rtree *tree)
{
    if (!tree->unmoved) sunder_i_free(tree->box);
    if (!tree->borrows) {
        sunder_i_free_all(tree->item, tree->leaf);
    }
    memset(tree, 0, sizeof *tree);
}

/* Appends the leaves, or their items (`items`), of a lowest-level node that meet the box. Returns false if out of
 * memory. */
static inline bool take_leaves(const sunder_i_rtree *tree, size_t first, size_t end, const double box[4], bool items,
                               sunder_i_list *hits)
{
    if (hits->capacity - hits->n < end - first &&
        !sunder_i_reserve(&hits->item, &hits->capacity, hits->n + (end - first), sizeof *hits->item))
        return false;
    size_t n = hits->n;
    for (size_t c = first; c < end; c++) {
        hits->item[n] = items ? tree->item[c] : (uint32_t)c;
        n += sunder_i_box_meet_any(tree->box + 4 * c, box);
    }
    hits->n = n;
    return true;
}

/* Searches depth-first, children in their order. Returns false if out of memory. */
static inline bool query_box(const sunder_i_rtree *tree, const double box[4], bool items, sunder_i_list *hits)
{
    if (tree->leaves == 0) return true;
    if (tree->levels == 1) return take_leaves(tree, 0, 1, box, items, hits);
    /* The stack has at most 16 siblings on each of at most 16 levels; rejected children are written above the top. */
    struct {
        size_t node;
        unsigned level;
    } stack[16 * FANOUT + 1];
    size_t depth = 0, end;
    stack[depth].node = tree->level[tree->levels] - 1;
    stack[depth++].level = tree->levels - 1;
    while (depth) {
        const size_t node = stack[--depth].node;
        const unsigned l = stack[depth].level;
        const size_t first = sunder_i_rtree_children(tree, l, node, &end);
        if (l == 1) {
            if (!take_leaves(tree, first, end, box, items, hits)) return false;
            continue;
        }
        for (size_t c = end; c-- > first;) {
            stack[depth].node = c;
            stack[depth].level = l - 1;
            depth += sunder_i_box_meet_any(tree->box + 4 * c, box);
        }
    }
    return true;
}

bool sunder_i_rtree_query(const sunder_i_rtree *tree, const double box[4], sunder_i_list *hits)
{
    return query_box(tree, box, true, hits);
}

bool sunder_i_rtree_query_leaves(const sunder_i_rtree *tree, const double box[4], sunder_i_list *hits)
{
    return query_box(tree, box, false, hits);
}

/* A tree of one leaf has no other node. */
size_t sunder_i_rtree_runs(const sunder_i_rtree *tree)
{
    return tree->levels > 1 ? tree->level[2] - tree->level[1] : tree->leaves;
}

const double *sunder_i_rtree_run(const sunder_i_rtree *tree, size_t run, size_t *first, size_t *end)
{
    const size_t node = tree->levels > 1 ? tree->level[1] + run : 0;
    *first = 0;
    *end = 1;
    if (tree->levels > 1) *first = sunder_i_rtree_children(tree, 1, node, end);
    return tree->box + 4 * node;
}
