/* ears.c: cuts ears off a closed walk until nothing is left.
 *
 * The test of an ear is exact for rings that touch, for the following reasons. Each vertex of the cleaned form
 * represents one sector of the interior; several may have one position, and their sectors are disjoint. A vertex
 * touches the inner side of an edge only if it is an end of it. Then a vertex b between a and c is an ear exactly if a,
 * b, c turn left and no vertex that is not strictly convex is in the open triangle or inside the side ca:
 *   - a boundary edge that enters the open triangle has an end there, since it cannot cross ab or bc, and of the
 *     vertices in the triangle the one farthest from the line ca has all its edges on the side of ca: it is not convex;
 *   - other vertices at the positions of a, b, c have sectors of their own, so that an edge of theirs that enters the
 *     triangle is an edge as in the first case, and these vertices need no test;
 *   - a vertex inside ca would touch the new edge from inside, so that the cut is not allowed; if its sector does not
 *     face the triangle, the triangle is not interior there and another vertex excludes the cut;
 *   - vertices on ab or bc touch from outside and do not matter.
 * Cutting keeps all this true of the rest, and a polygon with more than three vertices has an ear [Mei75]. Vertices may
 * become straight; these are no ears, but exclude others, until they become convex.
 *
 * Convex vertices are processed in rounds; in one round no two neighbours are cut, so that triangles do not form fans
 * about one vertex. Vertices that are not convex cost nothing until they become convex, and then stay convex. Until
 * then they are in a list or, if there are many, in a tree of boxes, which is rebuilt whenever half of them are gone. A
 * triangle is compared with boxes by its own box and by the lines of its sides, so that long thin triangles have few
 * candidates, too. */
#include "shape/ears.h"

#include "base/watch.h"
#include "spatial/curve.h"

#include <float.h>
#include <math.h>

/* The number of non-convex vertices from which a tree is used instead of a list; measured on random and coast-like
 * rings. */
#define TREE_FROM 24
/* The number of vertices in a leaf of the tree: testing a vertex takes longer than testing a box. */
#define LEAF 4
/* With up to this number of bridges the vertices are approximately in the order of one ring. */
#define FEW_BRIDGES 8

enum { CONVEX, BLUNT, CUT };

typedef struct cutter {
    const sunder_i_rings *r;
    sunder_i_walk *walk;
    sunder_i_mesh *mesh;
    uint32_t *bridge_half; /* [bridges] the half-edge that reached the bridge first, or NONE */
    uint8_t *state;        /* [nodes] CONVEX, BLUNT or CUT */
    uint32_t *stamp;       /* [nodes] the round in which a neighbour was cut */
    uint32_t *turn[2];     /* the convex nodes of this round and of the next one */
    uint32_t turn_n, round;
    uint32_t *list;         /* the nodes that are or were blunt (not convex), in order */
    uint32_t listed, live;  /* the length of the list; the number of nodes in it that are still blunt */
    sunder_i_box_tree tree; /* the tree over the list; tree.box is NULL if there is none */
} cutter;

static const double *place_of(const cutter *c, uint32_t node) { return c->r->xy + 2 * (size_t)c->walk->vertex[node]; }

static int node_turn(const cutter *c, uint32_t a, uint32_t b, uint32_t d)
{
    return sunder_i_rings_orient(c->r, c->walk->vertex[a], c->walk->vertex[b], c->walk->vertex[d]);
}

static void add_node(const void *of, size_t i, double box[4])
{
    const cutter *c = of;
    sunder_i_box_include(box, place_of(c, c->list[i]));
}

/* Removes the nodes that are no longer blunt from the list and builds a tree of the rest, LEAF nodes in a leaf. */
static void build_tree(cutter *c)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < c->listed; i++)
        if (c->state[c->list[i]] == BLUNT) c->list[n++] = c->list[i];
    c->live = c->listed = n;
    double(*box)[4] = c->tree.box;
    c->tree = sunder_i_box_tree_of(n, LEAF);
    c->tree.box = box;
    sunder_i_box_tree_fill(&c->tree, add_node, c);
}

/* A side of a triangle; at_x and at_y are the indices in a box of the corner that is farthest on the left of the
 * side. */
typedef struct side {
    double x, y, dx, dy;
    int at_x, at_y;
} side;

typedef struct triangle {
    uint32_t a, b, c;
    bool sided; /* whether `side` is computed; this is postponed, since it is not needed if nothing is near */
    side side[3];
    double box[4];
} triangle;

/* Returns whether a box is certainly on the right of the side. The determinant of doubles has an error of at most (3 +
 * 16 e) e times its two products, e = 2^-53 [She96]; DBL_MIN allows for underflow. */
static inline bool right_of(const double box[4], const side *s)
{
    const double l = s->dx * (box[s->at_y] - s->y), r = s->dy * (box[s->at_x] - s->x);
    return l - r < -(0x1p-50 * (fabs(l) + fabs(r)) + DBL_MIN);
}

static void find_sides(const cutter *c, triangle *t)
{
    const double *corner[3] = {place_of(c, t->a), place_of(c, t->b), place_of(c, t->c)};
    for (int k = 0; k < 3; k++) {
        const double *p = corner[k], *q = corner[(k + 1) % 3], dx = q[0] - p[0], dy = q[1] - p[1];
        t->side[k] = (side){p[0], p[1], dx, dy, dy > 0 ? 0 : 2, dx > 0 ? 3 : 1};
    }
    t->sided = true;
}

/* Returns whether the box is certainly outside one of the triangle's sides; false for rounded vertices, whose lines
 * prove nothing. */
static inline bool is_beside(const cutter *c, triangle *t, const double box[4])
{
    if (c->r->rounded) return false;
    if (!t->sided) find_sides(c, t);
    for (int k = 0; k < 3; k++)
        if (right_of(box, &t->side[k])) return true;
    return false;
}

static bool misses_box(const cutter *c, triangle *t, const double box[4])
{
    return !sunder_i_box_meet(box, t->box) || is_beside(c, t, box);
}

/* Returns whether this node, if blunt, excludes the cut. */
static bool blocks_ear(const cutter *c, triangle *t, uint32_t node)
{
    if (node == t->a || node == t->b || node == t->c || c->state[node] != BLUNT) return false;
    const double *p = place_of(c, node);
    if (p[0] < t->box[0] || p[0] > t->box[2] || p[1] < t->box[1] || p[1] > t->box[3]) return false;
    /* with native integers the exact tests are as fast as those in doubles */
    if (!c->r->lattice->narrow && is_beside(c, t, (const double[4]){p[0], p[1], p[0], p[1]})) return false;
    if (node_turn(c, t->a, t->b, node) <= 0 || node_turn(c, t->b, t->c, node) <= 0) return false;
    return node_turn(c, t->c, t->a, node) >= 0;
}

static bool is_free(const cutter *c, triangle *t)
{
    sunder_i_box_walk walk;
    sunder_i_box_walk_start(&walk, &c->tree);
    for (size_t b; sunder_i_box_walk_next(&walk, &b);) {
        if (misses_box(c, t, c->tree.box[b])) continue;
        if (b < c->tree.leaves) {
            sunder_i_box_walk_open(&walk, 2 * b + 1, 2 * b);
            continue;
        }
        const size_t end = sunder_i_box_tree_end(&c->tree, b);
        for (size_t i = sunder_i_box_tree_first(&c->tree, b); i < end; i++)
            if (blocks_ear(c, t, c->list[i])) return false;
    }
    return true;
}

static bool is_ear(const cutter *c, uint32_t b)
{
    triangle t;
    t.a = c->walk->prev[b];
    t.b = b;
    t.c = c->walk->next[b];
    t.sided = false;
    sunder_i_box_clear(t.box);
    sunder_i_box_include(t.box, place_of(c, t.a));
    sunder_i_box_include(t.box, place_of(c, t.b));
    sunder_i_box_include(t.box, place_of(c, t.c));
    if (c->tree.box) return is_free(c, &t);
    for (uint32_t i = 0; i < c->listed; i++)
        if (blocks_ear(c, &t, c->list[i])) return false;
    return true;
}

/* Links side h of a new triangle to what is beyond the edge that begins at the node. */
static void link_side(cutter *c, uint32_t h, uint32_t node)
{
    uint32_t beyond = c->walk->beyond[node];
    c->mesh->twin[h] = SUNDER_I_NONE;
    if (beyond == SUNDER_I_NONE) return;
    if (beyond & SUNDER_I_BRIDGE) {
        uint32_t *met = &c->bridge_half[beyond & ~SUNDER_I_BRIDGE];
        if (*met == SUNDER_I_NONE) {
            *met = h;
            return;
        }
        beyond = *met;
    }
    c->mesh->twin[h] = beyond;
    c->mesh->twin[beyond] = h;
}

/* Adds the triangle prev(b), b, next(b) to the mesh; returns its first half-edge. */
static uint32_t add_triangle(cutter *c, uint32_t b)
{
    const uint32_t a = c->walk->prev[b], d = c->walk->next[b], h = c->mesh->halves;
    const uint32_t corner[3] = {a, b, d};
    for (uint32_t k = 0; k < 3; k++) {
        c->mesh->origin[h + k] = c->walk->vertex[corner[k]];
        c->mesh->next[h + k] = h + (k + 1) % 3;
        c->mesh->prev[h + k] = h + (k + 2) % 3;
    }
    c->mesh->halves += 3;
    link_side(c, h, a);
    link_side(c, h + 1, b);
    return h;
}

/* Updates a neighbour of a cut vertex: it may have become convex, and is not cut in this round. */
static void refresh_neighbour(cutter *c, uint32_t node)
{
    c->stamp[node] = c->round;
    if (c->state[node] != BLUNT || node_turn(c, c->walk->prev[node], node, c->walk->next[node]) <= 0) return;
    c->state[node] = CONVEX;
    c->live--;
    c->turn[1][c->turn_n++] = node;
}

static void cut_ear(cutter *c, uint32_t b)
{
    const uint32_t a = c->walk->prev[b], d = c->walk->next[b], h = add_triangle(c, b);
    c->walk->beyond[a] = h + 2;
    c->mesh->twin[h + 2] = SUNDER_I_NONE;
    c->walk->next[a] = d;
    c->walk->prev[d] = a;
    c->state[b] = CUT;
    refresh_neighbour(c, a);
    refresh_neighbour(c, d);
}

static void cut_all(cutter *c)
{
    uint32_t left = c->walk->nodes, last = 0;
    if (c->tree.box) build_tree(c);
    while (left > 3) {
        const uint32_t n = c->turn_n, before = left;
        uint32_t *const now = c->turn[1];
        c->turn[1] = c->turn[0];
        c->turn[0] = now;
        c->turn_n = 0;
        c->round++;
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t node = now[i];
            if (!sunder_i_steps(4)) {
                c->r->lattice->arena.failed = true;
                return;
            }
            if (left > 3 && c->stamp[node] != c->round && is_ear(c, node)) {
                last = c->walk->prev[node];
                cut_ear(c, node);
                left--;
            } else {
                c->turn[1][c->turn_n++] = node;
            }
        }
        /* a round without an ear: out of memory, so that the predicates are invalid */
        if (left == before) return;
        if (c->tree.box && c->live < c->listed / 2) build_tree(c);
    }
    /* the last triangle; all its three sides have neighbours */
    const uint32_t b = c->walk->next[last], h = add_triangle(c, b);
    link_side(c, h + 2, c->walk->next[b]);
}

/* Returns whether the vertices are in a bad order for a tree. One ring usually runs through the plane in a good order;
 * many holes may come in any order, and the vertices of spikes alternate between near and far. The test compares the
 * boxes of the leaves with those of points along a space-filling curve, which are as wide as the cells of a grid with
 * the same number of cells; more than twice that is bad. */
static bool order_strays(const cutter *c)
{
    double all[4], sum = 0;
    sunder_i_box_clear(all);
    for (uint32_t lo = 0; lo < c->listed; lo += LEAF) {
        double box[4];
        sunder_i_box_clear(box);
        for (uint32_t i = lo; i < c->listed && i < lo + LEAF; i++) add_node(c, i, box);
        sunder_i_box_join(all, box);
        sum += box[2] - box[0] + (box[3] - box[1]);
    }
    return sum > 2 * sqrt((double)c->tree.leaves) * (all[2] - all[0] + (all[3] - all[1]));
}

void sunder_i_ears_cut(const sunder_i_rings *r, sunder_i_walk *walk, uint32_t *bridge_half, uint32_t bridges,
                       sunder_i_mesh *mesh, sunder_i_arena *arena)
{
    const size_t n = walk->nodes;
    cutter c = {.r = r, .walk = walk, .mesh = mesh, .bridge_half = bridge_half};
    uint32_t *block = sunder_i_arena_alloc(arena, 4 * n, sizeof *block);
    c.state = sunder_i_arena_alloc(arena, n, sizeof *c.state);
    if (arena->failed) return;
    c.list = block;
    c.stamp = block + n;
    c.turn[0] = block + 2 * n;
    c.turn[1] = block + 3 * n;
    for (uint32_t i = 0; i < n; i++) {
        c.state[i] = node_turn(&c, walk->prev[i], i, walk->next[i]) > 0 ? CONVEX : BLUNT;
        c.stamp[i] = 0;
        if (c.state[i] == BLUNT)
            c.list[c.listed++] = i;
        else
            c.turn[1][c.turn_n++] = i;
    }
    c.live = c.listed;
    if (c.listed >= TREE_FROM) {
        c.tree = sunder_i_box_tree_of(c.listed, LEAF);
        c.tree.box = sunder_i_arena_alloc(arena, 2 * c.tree.leaves, sizeof *c.tree.box);
        if (!c.tree.box) return;
        if (bridges > FEW_BRIDGES || order_strays(&c))
            sunder_i_curve_sort(r->xy, walk->vertex, c.list, c.listed, arena);
        if (arena->failed) return;
    }
    cut_all(&c);
}
