/* A tree of ways that keeps no way: each is known from where the feature was at home and how far it moved. So only the
 * hulls above the leaves are kept, a sixteenth of what a tree takes, in the order of the tree of the homes, which there
 * is already. Ways that are long beside their homes lie in other places than these: then they get an order of their
 * own. Parts of barriers have no ways, and count for nothing. */
#include "displacement/layer/way_tree.h"

#include "displacement/layer/reads.h"

#include <math.h>
#include <string.h>

/* Another order is worth it as with any tree (spatial/rtree.c). */
#define WORN 1.5

void sunder_i_way_tree_free(sunder_i_way_tree *ways)
{
    sunder_i_free(ways->hull);
    sunder_i_rtree_free(&ways->longer);
    ways->hull = NULL;
}

static const sunder_i_rtree *order_of(const sunder_i_way_tree *ways, const sunder_i_model *model)
{
    return ways->longer.levels ? &ways->longer : &model->tree;
}

void sunder_i_way_box(const sunder_i_way_tree *ways, const sunder_i_model *model, uint32_t f, double box[4])
{
    const double *home = sunder_i_home_box(model, f), *t = sunder_i_move_of(ways, model, f);
    memcpy(box, home, 4 * sizeof *box);
    if (t[0] == 0 && t[1] == 0) return;
    for (int c = 0; c < 4; c++) {
        const double there = nextafter(home[c] + t[c & 1], c < 2 ? -INFINITY : INFINITY);
        box[c] = c < 2 ? fmin(home[c], there) : fmax(home[c], there);
    }
}

/* ---- Hulls ------------------------------------------------------------------------------------------------------- */

static double *hull_of(const sunder_i_way_tree *ways, const sunder_i_rtree *order, size_t node)
{
    return ways->hull + 4 * (node - order->leaves);
}

static double size_of(const double box[4]) { return box[2] - box[0] + (box[3] - box[1]); }

/* Of what is in the node, as it is now. */
static void make_hull(const sunder_i_way_tree *ways, const sunder_i_model *model, unsigned level, size_t node,
                      double hull[4])
{
    const sunder_i_rtree *order = order_of(ways, model);
    size_t end;
    sunder_i_box_clear(hull);
    for (size_t c = sunder_i_rtree_children(order, level, node, &end); c < end; c++) {
        double way[4];
        if (level > 1) {
            sunder_i_box_join(hull, hull_of(ways, order, c));
        } else if (!sunder_i_is_barrier(model, order->item[c])) {
            sunder_i_way_box(ways, model, order->item[c], way);
            sunder_i_box_join(hull, way);
        }
    }
}

/* What a node adds to the sum; of barriers alone it is nothing. */
static double spread_of(const double hull[4]) { return hull[0] <= hull[2] ? size_of(hull) : 0; }

static bool make_hulls(sunder_i_way_tree *ways, const sunder_i_model *model)
{
    const sunder_i_rtree *order = order_of(ways, model);
    const size_t nodes = order->levels ? order->level[order->levels] - order->leaves : 0;
    ways->hull = sunder_i_alloc(4 * nodes + 1, sizeof *ways->hull);
    if (!ways->hull) return false;
    ways->sprawl = 0;
    for (unsigned l = 1; l < order->levels; l++)
        for (size_t node = order->level[l]; node < order->level[l + 1]; node++) {
            double *hull = hull_of(ways, order, node);
            make_hull(ways, model, l, node, hull);
            ways->sprawl += spread_of(hull);
        }
    return true;
}

sunder_status sunder_i_way_tree_begin(sunder_i_way_tree *ways, const sunder_i_model *model, sunder_error *err)
{
    ways->packed = model->tree.packed;
    return make_hulls(ways, model) ? SUNDER_OK : sunder_i_no_memory(err);
}

/* ---- Moving ------------------------------------------------------------------------------------------------------ */

/* What is above these leaves. */
static void mend(sunder_i_way_tree *ways, const sunder_i_model *model, size_t run)
{
    const sunder_i_rtree *order = order_of(ways, model);
    for (unsigned l = 1; l < order->levels; l++, run /= SUNDER_I_RTREE_RUN) {
        double hull[4], *was = hull_of(ways, order, order->level[l] + run);
        make_hull(ways, model, l, order->level[l] + run, hull);
        if (memcmp(hull, was, sizeof hull) == 0) return;
        ways->sprawl += spread_of(hull) - spread_of(was);
        memcpy(was, hull, sizeof hull);
    }
}

static sunder_status reorder(sunder_i_way_tree *ways, const sunder_i_model *model, sunder_error *err)
{
    const size_t n = model->features;
    double *way = sunder_i_alloc(4 * n, sizeof *way);
    if (!way) return sunder_i_no_memory(err);
    for (uint32_t f = 0; f < n; f++)
        if (model->present[f]) sunder_i_way_box(ways, model, f, way + 4 * (size_t)f);
    sunder_i_way_tree_free(ways);
    sunder_status status = sunder_i_rtree_build(way, model->present, n, &ways->longer, err);
    sunder_i_free(way);
    if (!status && !make_hulls(ways, model)) status = sunder_i_no_memory(err);
    ways->packed = ways->sprawl;
    return status;
}

sunder_status sunder_i_way_tree_follow(sunder_i_way_tree *ways, const sunder_i_model *model, const uint32_t *moved,
                                       size_t n, sunder_error *err)
{
    const sunder_i_rtree *order = order_of(ways, model);
    size_t last = SIZE_MAX;
    for (size_t k = 0; k < n; k++) {
        /* Who come one after the other are mostly neighbours in the tree, too. */
        const size_t run = order->leaf[moved[k]] / SUNDER_I_RTREE_RUN;
        if (run != last) mend(ways, model, run);
        last = run;
    }
    return ways->sprawl <= WORN * ways->packed ? SUNDER_OK : reorder(ways, model, err);
}

/* ---- Asking ------------------------------------------------------------------------------------------------------ */

static bool takes_way(const sunder_i_way_tree *ways, const sunder_i_model *model, uint32_t f, const double *home,
                      const double box[4])
{
    if (sunder_i_is_barrier(model, f)) return false;
    if (ways->longer.levels == 0 && sunder_i_box_meet(home, box)) return true;
    double way[4];
    sunder_i_way_box(ways, model, f, way);
    return sunder_i_box_meet(way, box);
}

static bool take_leaves(const sunder_i_way_tree *ways, const sunder_i_model *model, size_t first, size_t end,
                        const double box[4], sunder_i_list *hits)
{
    const sunder_i_rtree *order = order_of(ways, model);
    for (size_t c = first; c < end; c++)
        if (takes_way(ways, model, order->item[c], order->box + 4 * c, box) &&
            !sunder_i_list_push(hits, order->item[c]))
            return false;
    return true;
}

/* What the node has, as the tree itself finds it. */
static bool query(const sunder_i_way_tree *ways, const sunder_i_model *model, unsigned level, size_t node,
                  const double box[4], sunder_i_list *hits)
{
    const sunder_i_rtree *order = order_of(ways, model);
    size_t end;
    if (!sunder_i_box_meet_any(hull_of(ways, order, node), box)) return true;
    const size_t first = sunder_i_rtree_children(order, level, node, &end);
    if (level == 1) return take_leaves(ways, model, first, end, box, hits);
    for (size_t c = first; c < end; c++)
        if (!query(ways, model, level - 1, c, box, hits)) return false;
    return true;
}

bool sunder_i_way_tree_look_about(const sunder_i_way_tree *ways, const sunder_i_model *model, const double box[4],
                                  sunder_i_list *hits)
{
    const sunder_i_rtree *order = order_of(ways, model);
    const size_t before = hits->n;
    const bool ok = order->levels > 1
                        ? query(ways, model, order->levels - 1, order->level[order->levels] - 1, box, hits)
                        : take_leaves(ways, model, 0, order->leaves, box, hits);
    if (sunder_i_reads && ok) sunder_i_reads_note(model, box, hits->item + before, hits->n - before);
    return ok;
}
