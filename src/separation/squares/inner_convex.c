/* inner_convex.c: convex sets inside an operand, in floats, which need half the memory traffic of doubles: millions of
 * queries are made. If a set is found to cover a square, this is certain. */
#include "separation/squares/inner_convex.h"

#include "base/watch.h"
#include "separation/squares/tuning.h"

#include <math.h>
#include <string.h>

/* ---- Vertices ---- */

static double length_of(double x, double y) { return sqrt(x * x + y * y); }

static float length_f(float x, float y) { return sqrtf(x * x + y * y); }

/* Adds a convex set with n vertices, from xy in order or as listed in `vertex`. If differences of coordinates are
 * rounded, the directions of short sides have a larger error than that of floats (vague). */
static void add_set(sunder_i_inner_convex *b, const sunder_i_operands *g, const double *xy, const uint32_t *vertex,
                    uint32_t n)
{
    const uint32_t first = b->n ? b->end[b->n - 1] : 0, blocks = (n + 3) / 4;
    const double scale = sunder_i_float_scale(g);
    double shortest = INFINITY;
    for (uint32_t k = 0; k < 4 * blocks; k++) {
        sunder_i_inner_convex_block *to = b->block + first + k / 4;
        const uint32_t i = k < n ? k : 0, j = i + 1 < n ? i + 1 : 0, m = k % 4;
        const double *c = xy + 2 * (size_t)(vertex ? vertex[i] : i), *d = xy + 2 * (size_t)(vertex ? vertex[j] : j);
        const double dx = d[0] - c[0], dy = d[1] - c[1], length = length_of(dx, dy);
        shortest = length < shortest ? length : shortest;
        to->x[m] = (float)(scale * c[0]);
        to->y[m] = (float)(scale * c[1]);
        to->nx[m] = (float)(dy / length);
        to->ny[m] = (float)(-dx / length);
        to->support[m] = (float)(scale * (dy / length * c[0] - dx / length * c[1]));
    }
    const double vague = shortest > SUNDER_I_SHORTEST ? 32 * g->coarse / shortest : INFINITY;
    b->vague[b->n] = (float)vague;
    for (uint32_t k = first; vague > 0 && k < first + blocks; k++)
        for (int m = 0; m < 4; m++) b->block[k].support[m] -= b->vague[b->n];
    b->end[b->n++] = first + blocks;
}

static void add_pieces(sunder_i_inner_convex *b, const sunder_i_operands *g, int side)
{
    const sunder_shape *s = g->shape[side];
    for (uint32_t i = 0, k = 0; i < s->pieces; k = s->piece_end[i++])
        add_set(b, g, g->xy[side], sunder_i_piece_vertices(s) + k, s->piece_end[i] - k);
}

/* Adds a box. On a narrow lattice its corners are rounded inwards to lattice points. Returns false if nothing is
 * left. */
static bool add_box(sunder_i_inner_convex *b, const sunder_i_operands *g, const double box[4])
{
    double at[4] = {box[0], box[1], box[2], box[3]};
    for (int k = 0; k < 4 && g->placed.lattice.narrow; k++) at[k] = k < 2 ? ceil(box[k]) : floor(box[k]);
    if (at[0] >= at[2] || at[1] >= at[3]) return false;
    const double xy[8] = {at[0], at[1], at[2], at[1], at[2], at[3], at[0], at[3]};
    memcpy(b->box + 4 * (size_t)b->boxes++, at, sizeof at);
    add_set(b, g, xy, NULL, 4);
    return true;
}

/* A node of the quadtree and its box. */
typedef struct place {
    int32_t node;
    double box[4];
} place;

/* Adds up to `most` full boxes, level by level, so that the largest come first. Returns false if out of memory. */
static bool add_boxes(sunder_i_inner_convex *b, const sunder_i_operands *g, const sunder_i_quadtree *quadtree,
                      uint32_t most)
{
    place *queue = sunder_i_alloc(quadtree->nodes, sizeof *queue);
    size_t n = 1;
    if (!queue) return false;
    queue[0] = (place){.node = 0};
    memcpy(queue[0].box, quadtree->box, sizeof queue[0].box);
    for (size_t i = 0; i < n && most > 0 && sunder_i_step(); i++) {
        const place at = queue[i];
        const int32_t child = quadtree->child[at.node];
        if (child == SUNDER_I_QUADTREE_FULL && add_box(b, g, at.box)) most--;
        for (int k = 0; child >= 0 && k < 4; k++, n++) {
            queue[n].node = child + k;
            sunder_i_quadtree_quarter(at.box, k, queue[n].box);
        }
    }
    sunder_i_free(queue);
    return true;
}

/* ---- Chiefs ---- */

/* Returns the distance of a point that is outside of side m of a block; the side ends at (ex, ey). */
static float distance_from_side(const sunder_i_inner_convex_block *c, int m, float ex, float ey, float x, float y)
{
    const float tx = -c->ny[m], ty = c->nx[m], along = tx * (x - c->x[m]) + ty * (y - c->y[m]);
    if (along <= 0) return length_f(x - c->x[m], y - c->y[m]);
    if (along >= tx * (ex - c->x[m]) + ty * (ey - c->y[m])) return length_f(x - ex, y - ey);
    return c->nx[m] * x + c->ny[m] * y - c->support[m];
}

static float distance_from_set(const sunder_i_inner_convex *b, uint32_t set, float x, float y)
{
    const uint32_t first = set ? b->end[set - 1] : 0, end = b->end[set];
    float least = INFINITY;
    bool inside = true;
    for (uint32_t k = first; k < end; k++)
        for (int m = 0; m < 4; m++) {
            const sunder_i_inner_convex_block *c = b->block + k,
                                              *d = m < 3 ? c : b->block + (k + 1 < end ? k + 1 : first);
            if (c->nx[m] * x + c->ny[m] * y <= c->support[m]) continue;
            const float v = distance_from_side(c, m, d->x[(m + 1) % 4], d->y[(m + 1) % 4], x, y);
            least = v < least ? v : least;
            inside = false;
        }
    return inside ? 0 : least;
}

/* Returns a bound of how much deeper set i can cover a square than set k is found to cover it. */
static float stands_out(const sunder_i_inner_convex *b, uint32_t i, uint32_t k)
{
    float most = 0;
    for (uint32_t c = i ? b->end[i - 1] : 0; c < b->end[i]; c++)
        for (int m = 0; m < 4; m++) {
            const float v = distance_from_set(b, k, b->block[c].x[m], b->block[c].y[m]);
            if (!(v <= most)) most = v;
        }
    return most + SUNDER_I_INNER_CONVEX_ERROR + 2 * b->vague[k];
}

/* Returns the sum of the extents in all directions. */
static float size_of(const sunder_i_dop *extent)
{
    float size = 0;
    for (int k = 0; k < SUNDER_I_DOP_WAYS; k++) size += extent->high[k] - extent->low[k];
    return size;
}

/* Chooses the chief of each node, the largest of its convex sets, from its children. Returns false if out of memory. */
static bool name_chiefs(sunder_i_inner_convex *b, const sunder_i_dop *extent)
{
    const uint32_t leaves = b->all.leaves;
    b->node = sunder_i_alloc(2 * (size_t)leaves, sizeof *b->node);
    if (!b->node) return false;
    for (uint32_t k = 2 * leaves; --k > 0;) {
        if (k >= leaves) {
            const uint32_t set = b->all.piece[k - leaves];
            b->node[k].chief = set;
            b->node[k].reach = set == UINT32_MAX ? 0 : SUNDER_I_INNER_CONVEX_ERROR + 2 * b->vague[set];
            continue;
        }
        const sunder_i_inner_convex_node u = b->node[2 * k], v = b->node[2 * k + 1];
        const bool first =
            v.chief == UINT32_MAX || (u.chief != UINT32_MAX && size_of(extent + u.chief) >= size_of(extent + v.chief));
        const sunder_i_inner_convex_node other = first ? v : u;
        b->node[k] = first ? u : v;
        if (!sunder_i_step()) return false;
        if (other.chief == UINT32_MAX) continue;
        const float reach = other.reach + stands_out(b, other.chief, b->node[k].chief);
        if (!(reach <= b->node[k].reach)) b->node[k].reach = reach;
    }
    return true;
}

/* ---- Building and queries ---- */

static bool plant_trees(sunder_i_inner_convex *b, uint32_t pieces)
{
    sunder_i_dop *extent = sunder_i_alloc(b->n, sizeof *extent);
    if (!extent) return false;
    for (uint32_t k = 0, i = 0; k < b->n; k++) {
        extent[k] = sunder_i_dop_nowhere();
        for (; i < b->end[k]; i++)
            for (int m = 0; m < 4; m++) sunder_i_dop_add(&extent[k], b->block[i].x[m], b->block[i].y[m]);
    }
    const bool ok = sunder_i_dop_tree_build(&b->pieces, extent, pieces) &&
                    sunder_i_dop_tree_build(&b->all, extent, b->n) && name_chiefs(b, extent);
    sunder_i_free(extent);
    return ok;
}

bool sunder_i_inner_convex_build(sunder_i_inner_convex *inner, const sunder_i_operands *operands, int side,
                                 const sunder_i_quadtree *quadtree)
{
    const sunder_shape *s = operands->shape[side];
    const uint32_t boxes = s->pieces / 4 + BOXES_LEAST;
    const size_t n = (size_t)s->pieces + boxes, blocks = s->piece_end[s->pieces - 1] / 4 + n;
    *inner = (sunder_i_inner_convex){.end = sunder_i_alloc(n, sizeof *inner->end),
                                     .block = sunder_i_alloc(blocks, sizeof *inner->block),
                                     .vague = sunder_i_alloc(n, sizeof *inner->vague),
                                     .box = sunder_i_alloc(boxes, 4 * sizeof *inner->box)};
    if (!inner->end || !inner->block || !inner->vague || !inner->box) return false;
    add_pieces(inner, operands, side);
    return add_boxes(inner, operands, quadtree, boxes) && plant_trees(inner, s->pieces);
}

void sunder_i_inner_convex_free(sunder_i_inner_convex *inner)
{
    sunder_i_free_all(inner->end, inner->block, inner->vague, inner->box);
    sunder_i_dop_tree_free(&inner->pieces);
    sunder_i_dop_tree_free(&inner->all);
    sunder_i_free(inner->node);
    memset(inner, 0, sizeof *inner);
}

/* ---- Depths ---- */

sunder_i_square_query sunder_i_inner_convex_query(const sunder_i_operands *operands, const double square[4])
{
    const double scale = sunder_i_float_scale(operands);
    return (sunder_i_square_query){
        (float)(scale * (square[0] / 2 + square[2] / 2)), (float)(scale * (square[1] / 2 + square[3] / 2)),
        (float)(scale * (square[2] / 2 - square[0] / 2)), (float)(scale * (square[3] / 2 - square[1] / 2))};
}

/* Tests the square against the sides of one set, each translated by the farthest vertex of the other set in its
 * direction. Four at a time, without branches. */
static inline void below_sides(const sunder_i_inner_convex *b, uint32_t i, const sunder_i_inner_convex *o, uint32_t j,
                               const sunder_i_square_query *query, sunder_i_floats *in, sunder_i_floats *touch)
{
    const sunder_i_inner_convex_block *from = o->block + (j ? o->end[j - 1] : 0), *to = o->block + o->end[j];
    for (uint32_t k = i ? b->end[i - 1] : 0; k < b->end[i]; k++) {
        const sunder_i_inner_convex_block *s = b->block + k;
        const sunder_i_floats nx = sunder_i_floats_at(s->nx), ny = sunder_i_floats_at(s->ny);
        sunder_i_floats most = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
        for (const sunder_i_inner_convex_block *c = from; c < to; c++)
            for (int m = 0; m < 4; m++) most = sunder_i_floats_max(most, nx * c->x[m] + ny * c->y[m]);
        const sunder_i_floats depth = sunder_i_floats_at(s->support) + most - (nx * query->x + ny * query->y);
        const sunder_i_floats half =
            query->hx * sunder_i_floats_max(nx, -nx) + query->hy * sunder_i_floats_max(ny, -ny);
        *in = sunder_i_floats_min(*in, depth - half);
        *touch = sunder_i_floats_min(*touch, depth + half);
    }
}

/* Returns how far a convex set extends to the right, up, left and down. */
static sunder_i_floats reach_of(const sunder_i_inner_convex *b, uint32_t i)
{
    sunder_i_floats r = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (uint32_t k = i ? b->end[i - 1] : 0; k < b->end[i]; k++)
        for (int m = 0; m < 4; m++) {
            const float x = b->block[k].x[m], y = b->block[k].y[m];
            r = sunder_i_floats_max(r, (sunder_i_floats){x, y, -x, -y});
        }
    return r;
}

sunder_i_square_depth sunder_i_inner_convex_depth(const sunder_i_inner_convex inner[2], uint32_t i, uint32_t j,
                                                  const sunder_i_square_query *query)
{
    sunder_i_floats in = {INFINITY, INFINITY, INFINITY, INFINITY}, touch = in;
    below_sides(inner, i, inner + 1, j, query, &in, &touch);
    below_sides(inner + 1, j, inner, i, query, &in, &touch);
    if (query->hx < 0) { /* the sides of the square are also sides of the sum */
        const sunder_i_floats at = {query->x + query->hx, query->y + query->hy, query->hx - query->x,
                                    query->hy - query->y};
        in = sunder_i_floats_min(in, reach_of(inner, i) + reach_of(inner + 1, j) - at);
    }
    return (sunder_i_square_depth){sunder_i_floats_least(in), sunder_i_floats_least(touch)};
}
