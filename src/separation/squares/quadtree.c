/* quadtree.c: see quadtree.h. The operand's box is divided into quarters as long as boundary passes through them. A box
 * without boundary is inside if one of its points is, with a margin, since edges are enlarged by the error. Lists of
 * the edges and pieces near a box are passed on, so that a box tests only those of its parent. */
#include "separation/squares/quadtree.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "separation/squares/tuning.h"

#include <math.h>
#include <string.h>

typedef struct item {
    double box[4];
    int depth;
    uint32_t node;
    size_t edge_from, edge_to, piece_from, piece_to;
} item;

typedef struct builder {
    sunder_i_quadtree *out;
    const sunder_i_operands *g;
    int side, deepest;
    uint32_t *edges, *pieces; /* the lists of the boxes on the stack, one after the other */
    size_t edges_n, edges_capacity, pieces_n, pieces_capacity;
    item stack[3 * DEEPEST_BOX + 4];
    int stack_n;
} builder;

/* Returns whether the edge from vertex v may pass through the box, in doubles; false only if it is farther away than
 * the error. */
static bool edge_passes(const builder *b, uint32_t v, const double box[4])
{
    const double *xy = b->g->xy[b->side], *p = xy + 2 * (size_t)v,
                 *q = xy + 2 * (size_t)b->g->shape[b->side]->form->cleaned.next[v];
    const double e = 4 * b->g->error;
    for (int k = 0; k < 2; k++)
        if ((p[k] < box[k] - e && q[k] < box[k] - e) || (p[k] > box[k + 2] + e && q[k] > box[k + 2] + e)) return false;
    const double dx = q[0] - p[0], dy = q[1] - p[1];
    const double cx = box[0] / 2 + box[2] / 2, cy = box[1] / 2 + box[3] / 2;
    const double hx = box[2] / 2 - box[0] / 2 + e, hy = box[3] / 2 - box[1] / 2 + e;
    const double c = dx * (cy - p[1]) - dy * (cx - p[0]);
    return fabs(c) <= hx * fabs(dy) + hy * fabs(dx) + e * (fabs(dx) + fabs(dy)) + 8 * b->g->magnitude * b->g->coarse;
}

static bool meets_box(const builder *b, uint32_t piece, const double box[4])
{
    return sunder_i_box_meet(b->g->piece_box[b->side] + 4 * (size_t)piece, box);
}

/* Returns whether a fixed point of the box is certainly in the piece. */
static bool has_point(const builder *b, uint32_t piece, const double box[4])
{
    const sunder_i_operand_piece c = sunder_i_operands_piece(b->g, b->side, piece);
    const double *xy = b->g->xy[b->side], e = 4 * b->g->error, fixed = 8 * b->g->magnitude * b->g->coarse;
    const double x = box[0] + ASK_X * (box[2] - box[0]), y = box[1] + ASK_Y * (box[3] - box[1]);
    for (uint32_t k = 0; k < c.n; k++) {
        const double *p = xy + 2 * (size_t)c.corner[k], *q = xy + 2 * (size_t)sunder_i_piece_next(&c, k);
        const double dx = q[0] - p[0], dy = q[1] - p[1];
        if (!(dx * (y - p[1]) - dy * (x - p[0]) > e * (fabs(dx) + fabs(dy)) + fixed)) return false;
    }
    return true;
}

/* Computes the lists of a box from those of its parent, and its value; *quarter becomes whether it must be divided.
 * Returns false if out of memory. */
static bool look_at(builder *b, const item *parent, item *it, bool *quarter)
{
    if (!sunder_i_reserve(&b->edges, &b->edges_capacity, b->edges_n + (parent->edge_to - parent->edge_from),
                          sizeof *b->edges) ||
        !sunder_i_reserve(&b->pieces, &b->pieces_capacity, b->pieces_n + (parent->piece_to - parent->piece_from),
                          sizeof *b->pieces))
        return false;
    if (!sunder_i_steps(parent->edge_to - parent->edge_from + (parent->piece_to - parent->piece_from))) return false;
    it->edge_from = b->edges_n;
    for (size_t i = parent->edge_from; i < parent->edge_to; i++)
        if (edge_passes(b, b->edges[i], it->box)) b->edges[b->edges_n++] = b->edges[i];
    it->edge_to = b->edges_n;
    it->piece_from = b->pieces_n;
    for (size_t i = parent->piece_from; i < parent->piece_to; i++)
        if (meets_box(b, b->pieces[i], it->box)) b->pieces[b->pieces_n++] = b->pieces[i];
    it->piece_to = b->pieces_n;
    const bool crossed = it->edge_to > it->edge_from;
    *quarter = crossed && it->depth < b->deepest;
    int32_t what = SUNDER_I_QUADTREE_REST;
    for (size_t i = it->piece_from; !crossed && i < it->piece_to; i++)
        if (has_point(b, b->pieces[i], it->box)) {
            what = SUNDER_I_QUADTREE_FULL;
            break;
        }
    b->out->child[it->node] = what;
    return true;
}

static bool quarter_box(builder *b, const item *parent)
{
    sunder_i_quadtree *o = b->out;
    if (!sunder_i_reserve(&o->child, &o->nodes_capacity, o->nodes + 4, sizeof *o->child)) return false;
    const uint32_t first = (uint32_t)o->nodes;
    o->child[parent->node] = (int32_t)first;
    o->nodes += 4;
    for (int k = 0; k < 4; k++) {
        item it = {.depth = parent->depth + 1, .node = first + (uint32_t)k};
        bool more;
        sunder_i_quadtree_quarter(parent->box, k, it.box);
        if (!look_at(b, parent, &it, &more)) return false;
        if (more)
            b->stack[b->stack_n++] = it;
        else {
            b->edges_n = it.edge_from;
            b->pieces_n = it.piece_from;
        }
    }
    return true;
}

static bool quarter_all(builder *b)
{
    const sunder_shape *s = b->g->shape[b->side];
    sunder_i_quadtree *o = b->out;
    item root = {.edge_to = s->vertices, .piece_to = s->pieces};
    if (!sunder_i_reserve(&b->edges, &b->edges_capacity, s->vertices, sizeof *b->edges) ||
        !sunder_i_reserve(&b->pieces, &b->pieces_capacity, s->pieces, sizeof *b->pieces) ||
        !sunder_i_reserve(&o->child, &o->nodes_capacity, 1, sizeof *o->child))
        return false;
    for (uint32_t v = 0; v < s->vertices; v++) b->edges[v] = v;
    for (uint32_t i = 0; i < s->pieces; i++) b->pieces[i] = i;
    memcpy(root.box, b->g->box[b->side], sizeof root.box);
    memcpy(o->box, root.box, sizeof root.box);
    o->nodes = 1;
    b->stack[b->stack_n++] = root;
    while (b->stack_n) {
        const item it = b->stack[--b->stack_n];
        b->edges_n = it.edge_to; /* lists beyond these belong to boxes that are done */
        b->pieces_n = it.piece_to;
        if (!quarter_box(b, &it)) return false;
    }
    return true;
}

/* Marks nodes without a full node below them, so that queries do not enter them. The loop runs backwards because
 * children follow their parents. */
static void drop_rest(sunder_i_quadtree *o)
{
    for (size_t k = o->nodes; k-- > 0;) {
        const int32_t c = o->child[k];
        if (c < 0) continue;
        bool rest = true;
        for (int32_t i = c; i < c + 4; i++) rest = rest && o->child[i] == SUNDER_I_QUADTREE_REST;
        if (rest) o->child[k] = SUNDER_I_QUADTREE_REST;
    }
}

/* Returns the depth of the quadtree. A boundary of length l passes through about l / w boxes of width w. */
static int depth_for(const sunder_i_operands *g, int side)
{
    const sunder_shape *s = g->shape[side];
    const double *xy = g->xy[side], *all = g->box[side];
    double length = 0;
    for (uint32_t v = 0; v < s->vertices; v++) {
        const double *a = xy + 2 * (size_t)v, *b = xy + 2 * (size_t)s->form->cleaned.next[v];
        length += fabs(b[0] - a[0]) + fabs(b[1] - a[1]);
    }
    /* the number of boxes as large as the operand */
    const double boxes = length / sunder_i_max(all[2] - all[0], all[3] - all[1]);
    int depth = 3;
    while (depth < DEEPEST_BOX && ldexp(boxes, depth + 1) <= BOXES_EACH * (double)s->vertices) depth++;
    return depth;
}

bool sunder_i_quadtree_build(sunder_i_quadtree *quadtree, const sunder_i_operands *operands, int side)
{
    memset(quadtree, 0, sizeof *quadtree);
    builder b = {.out = quadtree, .g = operands, .side = side, .deepest = depth_for(operands, side)};
    const bool ok = quarter_all(&b);
    if (ok) drop_rest(quadtree);
    sunder_i_free_all(b.edges, b.pieces);
    return ok;
}

void sunder_i_quadtree_free(sunder_i_quadtree *quadtree)
{
    sunder_i_free(quadtree->child);
    memset(quadtree, 0, sizeof *quadtree);
}
