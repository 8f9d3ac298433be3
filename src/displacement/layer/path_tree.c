/* A tree over the paths of features that does not store the paths: each is computed from the feature's original box and
 * its move. Only the boxes of inner nodes ("hulls") are stored, a sixteenth of the memory of an R-tree. The order of
 * the leaves is that of the tree over the original boxes, which exists already. If paths are long compared with the
 * boxes, an order of their own is better and is computed. Parts of barriers have no paths and are left out. */
#include "displacement/layer/path_tree.h"

#include "displacement/layer/reads.h"

#include <string.h>

/* The tree is built in a new order when the total size of its hulls exceeds this multiple of the size when it was
 * packed, as in spatial/rtree.c. */
#define WORN 1.5

void sunder_i_path_tree_free(sunder_i_path_tree *tree)
{
    sunder_i_free(tree->hull);
    sunder_i_rtree_free(&tree->longer);
    tree->hull = NULL;
}

/* Are the leaves in the order of the model's tree? Then its leaves have the original boxes. */
static bool is_by_homes(const sunder_i_path_tree *tree) { return tree->longer.levels == 0; }

static const sunder_i_rtree *order_of(const sunder_i_path_tree *tree, const sunder_i_model *model)
{
    return is_by_homes(tree) ? &model->tree : &tree->longer;
}

static bool has_moved(const double t[2]) { return t[0] != 0 || t[1] != 0; }

/* Sets box to the box of the path from the box `home` by the move t. */
static void path_from(const double home[4], const double t[2], double box[4])
{
    memcpy(box, home, 4 * sizeof *box);
    if (!has_moved(t)) return;
    double there[4];
    for (size_t c = 0; c < 4; c++) there[c] = sunder_i_box_step(home[c] + t[c & 1], c >= 2);
    sunder_i_box_join(box, there);
}

void sunder_i_path_box(const sunder_i_path_tree *tree, const sunder_i_model *model, uint32_t f, double box[4])
{
    path_from(sunder_i_home_box(model, f), sunder_i_move_of(tree, model, f), box);
}

/* ---- Hulls ------------------------------------------------------------------------------------------------------- */

static double *hull_of(const sunder_i_path_tree *tree, const sunder_i_rtree *order, size_t node)
{
    return tree->hull + 4 * (node - order->leaves);
}

static double size_of(const double box[4]) { return box[2] - box[0] + (box[3] - box[1]); }

/* Returns the original box of the feature of a leaf. */
static const double *home_of(const sunder_i_path_tree *tree, const sunder_i_model *model, const sunder_i_rtree *order,
                             size_t leaf)
{
    return is_by_homes(tree) ? order->box + 4 * leaf : sunder_i_home_box(model, order->item[leaf]);
}

/* Computes the hull of a node from its children. */
static void make_hull(const sunder_i_path_tree *tree, const sunder_i_model *model, unsigned level, size_t node,
                      double hull[4])
{
    const sunder_i_rtree *order = order_of(tree, model);
    size_t end;
    sunder_i_box_clear(hull);
    for (size_t c = sunder_i_rtree_children(order, level, node, &end); c < end; c++) {
        double path[4];
        if (level > 1) {
            sunder_i_box_join(hull, hull_of(tree, order, c));
        } else if (!sunder_i_is_barrier(model, order->item[c])) {
            path_from(home_of(tree, model, order, c), sunder_i_move_of(tree, model, order->item[c]), path);
            sunder_i_box_join(hull, path);
        }
    }
}

/* Recomputes all hulls. */
static void make_hulls(sunder_i_path_tree *tree, const sunder_i_model *model)
{
    const sunder_i_rtree *order = order_of(tree, model);
    tree->sprawl = 0;
    for (unsigned l = 1; l < order->levels; l++)
        for (size_t node = order->level[l]; node < order->level[l + 1]; node++) {
            double *hull = hull_of(tree, order, node);
            make_hull(tree, model, l, node, hull);
            if (hull[0] <= hull[2]) tree->sprawl += size_of(hull); /* a node with parts of barriers alone is empty */
        }
}

static double *room_for_hulls(const sunder_i_path_tree *tree, const sunder_i_model *model)
{
    const sunder_i_rtree *order = order_of(tree, model);
    const size_t nodes = order->levels ? order->level[order->levels] - order->leaves : 0;
    return sunder_i_alloc(4 * nodes + 1, sizeof *tree->hull);
}

static bool is_worn(const sunder_i_path_tree *tree) { return !(tree->sprawl <= WORN * tree->packed); }

sunder_status sunder_i_path_tree_begin(sunder_i_path_tree *tree, const sunder_i_model *model, sunder_error *err)
{
    tree->packed = model->tree.packed;
    tree->hull = room_for_hulls(tree, model);
    if (!tree->hull) return sunder_i_failure_cause(err);
    make_hulls(tree, model);
    return SUNDER_OK;
}

/* ---- Moving ------------------------------------------------------------------------------------------------------ */

/* Extends the hulls above a leaf by the path of its feature. Hulls never shrink here; a query tests the paths
 * themselves, so too large a hull only costs time. */
static void widen_hulls(sunder_i_path_tree *tree, const sunder_i_model *model, size_t leaf)
{
    const sunder_i_rtree *order = order_of(tree, model);
    double path[4];
    path_from(home_of(tree, model, order, leaf), sunder_i_move_of(tree, model, order->item[leaf]), path);
    for (unsigned l = 1; l < order->levels; l++) {
        leaf /= SUNDER_I_RTREE_RUN;
        double *hull = hull_of(tree, order, order->level[l] + leaf), before[4];
        memcpy(before, hull, sizeof before);
        sunder_i_box_join(hull, path);
        if (memcmp(before, hull, sizeof before) == 0) return;
        tree->sprawl += size_of(hull) - size_of(before);
    }
}

static sunder_status reorder_leaves(sunder_i_path_tree *tree, const sunder_i_model *model, sunder_error *err)
{
    const size_t n = model->features;
    double *path = sunder_i_alloc(4 * n, sizeof *path);
    if (!path) return sunder_i_failure_cause(err);
    for (uint32_t f = 0; f < n; f++)
        if (model->present[f]) sunder_i_path_box(tree, model, f, path + 4 * (size_t)f);
    sunder_i_path_tree_free(tree);
    sunder_status status = sunder_i_rtree_build(path, model->present, n, &tree->longer, err);
    sunder_i_free(path);
    tree->hull = status ? NULL : room_for_hulls(tree, model);
    if (!status && !tree->hull) status = sunder_i_failure_cause(err);
    if (!status) make_hulls(tree, model);
    tree->packed = tree->sprawl;
    return status;
}

sunder_status sunder_i_path_tree_follow(sunder_i_path_tree *tree, const sunder_i_model *model, const uint32_t *moved,
                                        size_t n, sunder_error *err)
{
    const sunder_i_rtree *order = order_of(tree, model);
    for (size_t k = 0; k < n; k++) widen_hulls(tree, model, order->leaf[moved[k]]);
    if (is_worn(tree)) make_hulls(tree, model);
    return is_worn(tree) ? reorder_leaves(tree, model, err) : SUNDER_OK;
}

/* ---- Queries ----------------------------------------------------------------------------------------------------- */

static bool path_meets(const sunder_i_path_tree *tree, const sunder_i_model *model, const sunder_i_rtree *order,
                       size_t leaf, const double box[4])
{
    const uint32_t f = order->item[leaf];
    if (sunder_i_is_barrier(model, f)) return false;
    const double *home = home_of(tree, model, order, leaf), *t = sunder_i_move_of(tree, model, f);
    if (!has_moved(t)) return sunder_i_box_meet_any(home, box);
    double path[4];
    path_from(home, t, path);
    return sunder_i_box_meet_any(path, box);
}

static bool append_leaves(const sunder_i_path_tree *tree, const sunder_i_model *model, size_t first, size_t end,
                          const double box[4], sunder_i_list *hits)
{
    const sunder_i_rtree *order = order_of(tree, model);
    for (size_t c = first; c < end; c++)
        if (path_meets(tree, model, order, c, box) && !sunder_i_list_push(hits, order->item[c])) return false;
    return true;
}

/* Appends the features below a node whose paths meet the box, in the order in which the R-tree finds them. Returns
 * false if memory is out. */
static bool query_node(const sunder_i_path_tree *tree, const sunder_i_model *model, unsigned level, size_t node,
                       const double box[4], sunder_i_list *hits)
{
    const sunder_i_rtree *order = order_of(tree, model);
    size_t end;
    if (!sunder_i_box_meet_any(hull_of(tree, order, node), box)) return true;
    const size_t first = sunder_i_rtree_children(order, level, node, &end);
    if (level == 1) return append_leaves(tree, model, first, end, box, hits);
    for (size_t c = first; c < end; c++)
        if (!query_node(tree, model, level - 1, c, box, hits)) return false;
    return true;
}

bool sunder_i_path_tree_look_about(const sunder_i_path_tree *tree, const sunder_i_model *model, const double box[4],
                                   sunder_i_list *hits)
{
    const sunder_i_rtree *order = order_of(tree, model);
    const size_t before = hits->n;
    const bool ok = order->levels > 1
                        ? query_node(tree, model, order->levels - 1, order->level[order->levels] - 1, box, hits)
                        : append_leaves(tree, model, 0, order->leaves, box, hits);
    if (sunder_i_reads && ok) sunder_i_reads_note(model, box, hits, before);
    return ok;
}
