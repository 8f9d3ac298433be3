/* Convex pieces of polygons with holes, without added vertices: holes are joined to their outer ring by bridges (bridge.c),
 * ears are cut off until nothing is left, and diagonals are taken away again while the pieces stay strictly convex
 * (merge.c).
 *
 * What makes the ear test exact on rings that touch. Each vertex of the cleaned form stands for one sector of the
 * interior; several may stand at one place, their sectors disjoint. A vertex touches the inside of an edge only if it is
 * an end of it. Then a corner b between a and c is an ear exactly when a, b, c turn left and no corner that is not
 * strictly convex lies in the open triangle or inside the side ca:
 *   - a boundary edge that reaches into the open triangle has an end there, since it cannot cross ab or bc, and of the
 *     corners in the triangle the one farthest from the line ca has all its edges on the side of ca: it is not convex;
 *   - other corners at the places of a, b, c have sectors of their own, so an edge of theirs that enters the triangle is of
 *     that kind, and the corners themselves need no look;
 *   - a corner inside ca would touch the new edge from inside, so it forbids the cut; if its sector does not face the
 *     triangle, the triangle is not interior there and another corner forbids it;
 *   - corners on ab or bc touch from outside and do not matter.
 * Cutting keeps all this true of what remains, and a polygon with more than three corners has an ear [Mei75]. Corners may
 * become straight; they are no ears, but block others, until they become convex.
 *
 * Corners that are not convex never come back once they have become so, so they are kept in a list, or for many in a
 * grid that is built anew whenever half of them have gone. */
#include "shape/build.h"

#include <math.h>
#include <string.h>

/* A list up to here, a grid from here on; by measurement on random and coast-like rings. */
#define GRID_FROM 24

enum { CONVEX, BLUNT, CUT };

typedef struct cutter {
    const sunder_i_rings *r;
    sunder_i_walk walk;
    sunder_i_mesh mesh;
    uint32_t *bridge_half; /* [bridges] the half-edge that met the bridge first, or NONE */
    uint8_t *state;        /* [nodes] CONVEX, BLUNT or CUT */
    uint32_t *stamp;       /* [nodes] the round in which a neighbour was cut */
    uint32_t *turn[2];     /* convex nodes of this round and of the next */
    uint32_t turn_n, round;
    uint32_t *list;        /* the nodes that are or were blunt, by cell */
    uint32_t listed, live; /* in the list; of these still blunt */
    uint32_t *cell_end;    /* the grid: NULL for few */
    uint32_t columns, rows;
    double low[2], scale[2];
} cutter;

static const double *place(const cutter *c, uint32_t node) { return c->r->xy + 2 * (size_t)c->walk.vertex[node]; }

static int turn(const cutter *c, uint32_t a, uint32_t b, uint32_t d)
{
    return sunder_i_rings_orient(c->r, c->walk.vertex[a], c->walk.vertex[b], c->walk.vertex[d]);
}

static uint32_t grid_cell(double v, double low, double scale, uint32_t n)
{
    const double t = (v - low) * scale; /* monotone in v, so boxes of cells are safe */
    if (!(t > 0)) return 0;
    return t < n ? (uint32_t)t : n - 1;
}

/* Sorts the blunt nodes of the list into cells, about two to a cell. */
static void build_grid(cutter *c, uint32_t *spare)
{
    uint32_t n = 0;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < c->listed; i++) {
        if (c->state[c->list[i]] != BLUNT) continue;
        const double *p = place(c, c->list[i]);
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
        }
        spare[n++] = c->list[i];
    }
    c->live = c->listed = n;
    /* Cells as square as the spread of the points lets them. */
    const double w = high[0] - low[0], h = high[1] - low[1];
    double columns = w > 0 && h > 0 ? sqrt(n / 2.0 * (w / h)) : w > 0 ? n : 1;
    columns = fmax(1, fmin(columns, n));
    c->columns = (uint32_t)columns;
    c->rows = (uint32_t)fmax(1, fmin(n, n / 2.0 / columns));
    c->low[0] = low[0];
    c->low[1] = low[1];
    c->scale[0] = w > 0 && isfinite(c->columns / w) ? c->columns / w : 0;
    c->scale[1] = h > 0 && isfinite(c->rows / h) ? c->rows / h : 0;
    memset(c->cell_end, 0, ((size_t)c->columns * c->rows + 1) * sizeof *c->cell_end);
    for (int fill = 0; fill < 2; fill++) {
        for (uint32_t i = n; i-- > 0;) {
            const double *p = place(c, spare[i]);
            const uint32_t cell = grid_cell(p[1], c->low[1], c->scale[1], c->rows) * c->columns +
                                  grid_cell(p[0], c->low[0], c->scale[0], c->columns);
            if (fill)
                c->list[--c->cell_end[cell + 1]] = spare[i];
            else
                c->cell_end[cell + 1]++;
        }
        if (!fill)
            for (uint32_t i = 1; i <= c->columns * c->rows; i++) c->cell_end[i] += c->cell_end[i - 1];
    }
    /* cell_end[k + 1] has run down to the start of cell k; entry 0 is a copy of that for cell 0. */
}

typedef struct triangle {
    uint32_t a, b, c;
    double box[4];
} triangle;

/* Does this blunt node forbid the cut? */
static bool blocks(const cutter *c, const triangle *t, uint32_t node)
{
    if (node == t->a || node == t->b || node == t->c || c->state[node] != BLUNT) return false;
    const double *p = place(c, node);
    if (p[0] < t->box[0] || p[0] > t->box[2] || p[1] < t->box[1] || p[1] > t->box[3]) return false;
    if (turn(c, t->a, t->b, node) <= 0 || turn(c, t->b, t->c, node) <= 0) return false;
    return turn(c, t->c, t->a, node) >= 0;
}

static bool is_ear(const cutter *c, uint32_t b)
{
    triangle t = {c->walk.prev[b], b, c->walk.next[b], {0}};
    const double *p = place(c, t.a), *q = place(c, t.b), *s = place(c, t.c);
    for (int k = 0; k < 2; k++) {
        t.box[k] = fmin(fmin(p[k], q[k]), s[k]);
        t.box[k + 2] = fmax(fmax(p[k], q[k]), s[k]);
    }
    if (!c->cell_end) {
        for (uint32_t i = 0; i < c->listed; i++)
            if (blocks(c, &t, c->list[i])) return false;
        return true;
    }
    const uint32_t x0 = grid_cell(t.box[0], c->low[0], c->scale[0], c->columns);
    const uint32_t x1 = grid_cell(t.box[2], c->low[0], c->scale[0], c->columns);
    const uint32_t y0 = grid_cell(t.box[1], c->low[1], c->scale[1], c->rows);
    const uint32_t y1 = grid_cell(t.box[3], c->low[1], c->scale[1], c->rows);
    for (uint32_t y = y0; y <= y1; y++) {
        /* The cells of a row follow each other in the list. */
        const uint32_t first = y * c->columns + x0, last = y * c->columns + x1;
        const uint32_t end = last + 1 < c->columns * c->rows ? c->cell_end[last + 2] : c->listed;
        for (uint32_t i = c->cell_end[first + 1]; i < end; i++)
            if (blocks(c, &t, c->list[i])) return false;
    }
    return true;
}

/* Joins side h of a new triangle to what lies beyond the edge that starts at this node. */
static void link_side(cutter *c, uint32_t h, uint32_t node)
{
    uint32_t beyond = c->walk.beyond[node];
    c->mesh.twin[h] = SUNDER_I_NONE;
    if (beyond == SUNDER_I_NONE) return;
    if (beyond & SUNDER_I_BRIDGE) {
        uint32_t *met = &c->bridge_half[beyond & ~SUNDER_I_BRIDGE];
        if (*met == SUNDER_I_NONE) {
            *met = h;
            return;
        }
        beyond = *met;
    }
    c->mesh.twin[h] = beyond;
    c->mesh.twin[beyond] = h;
}

/* The triangle prev(b), b, next(b) into the mesh; returns its first half-edge. */
static uint32_t add_triangle(cutter *c, uint32_t b)
{
    const uint32_t a = c->walk.prev[b], d = c->walk.next[b], h = c->mesh.halves;
    const uint32_t corner[3] = {a, b, d};
    for (uint32_t k = 0; k < 3; k++) {
        c->mesh.origin[h + k] = c->walk.vertex[corner[k]];
        c->mesh.next[h + k] = h + (k + 1) % 3;
        c->mesh.prev[h + k] = h + (k + 2) % 3;
    }
    c->mesh.halves += 3;
    link_side(c, h, a);
    link_side(c, h + 1, b);
    return h;
}

/* A neighbour of a cut corner: it may have become convex, and is left alone for the rest of the round. */
static void refresh(cutter *c, uint32_t node)
{
    c->stamp[node] = c->round;
    if (c->state[node] != BLUNT || turn(c, c->walk.prev[node], node, c->walk.next[node]) <= 0) return;
    c->state[node] = CONVEX;
    c->live--;
    c->turn[1][c->turn_n++] = node;
}

static void cut(cutter *c, uint32_t b)
{
    const uint32_t a = c->walk.prev[b], d = c->walk.next[b], h = add_triangle(c, b);
    c->walk.beyond[a] = h + 2;
    c->mesh.twin[h + 2] = SUNDER_I_NONE;
    c->walk.next[a] = d;
    c->walk.prev[d] = a;
    c->state[b] = CUT;
    refresh(c, a);
    refresh(c, d);
}

/* All ears of the closed walk. Convex nodes take turns in rounds; in one round no two neighbours are cut, so that triangles do
 * not fan out from one vertex, and blunt nodes cost nothing. */
static void cut_ears(cutter *c, uint32_t *spare)
{
    uint32_t left = c->walk.nodes, last = 0;
    if (c->cell_end) build_grid(c, spare);
    while (left > 3) {
        const uint32_t n = c->turn_n, before = left;
        uint32_t *const now = c->turn[1];
        c->turn[1] = c->turn[0];
        c->turn[0] = now;
        c->turn_n = 0;
        c->round++;
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t node = now[i];
            if (left > 3 && c->stamp[node] != c->round && is_ear(c, node)) {
                last = c->walk.prev[node];
                cut(c, node);
                left--;
            } else {
                c->turn[1][c->turn_n++] = node;
            }
        }
        /* A round without an ear: memory has run out, and the predicates answer nothing. */
        if (left == before) return;
        if (c->cell_end && c->live < c->listed / 2) build_grid(c, spare);
    }
    /* The last triangle has three sides that are all known. */
    const uint32_t b = c->walk.next[last], h = add_triangle(c, b);
    link_side(c, h + 2, c->walk.next[b]);
}

static uint32_t ring_begin(const sunder_i_rings *r, uint32_t ring) { return ring ? r->ring_end[ring - 1] : 0; }

/* The vertices lo .. hi of a ring are a piece by themselves. */
static bool is_convex(const sunder_i_rings *r, uint32_t lo, uint32_t hi)
{
    /* All turns left, and just one turn in all: the y direction changes sign twice. */
    int falls = 0;
    for (uint32_t i = lo; i < hi; i++) {
        if (sunder_i_rings_orient(r, r->prev[i], i, r->next[i]) <= 0) return false;
        falls += sunder_i_rings_cmp(r, r->prev[i], i) < 0 && sunder_i_rings_cmp(r, i, r->next[i]) > 0;
    }
    return falls == 1;
}

/* The pieces of a mesh as vertex lists. */
static void collect(sunder_i_mesh *mesh, sunder_i_pieces *out)
{
    for (uint32_t h = 0; h < mesh->halves; h++) {
        if (mesh->origin[h] == SUNDER_I_NONE) continue;
        for (uint32_t g = h; mesh->origin[g] != SUNDER_I_NONE; g = mesh->next[g]) {
            out->piece_vertex[out->corners++] = mesh->origin[g];
            mesh->origin[g] = SUNDER_I_NONE;
        }
        out->piece_end[out->pieces++] = out->corners;
    }
}

/* One polygon: rings ring_lo .. ring_hi. */
static void decompose(const sunder_i_rings *r, uint32_t ring_lo, uint32_t ring_hi, sunder_i_arena *arena,
                      sunder_i_pieces *out)
{
    const uint32_t lo = ring_begin(r, ring_lo), n = r->ring_end[ring_hi - 1] - lo, holes = ring_hi - ring_lo - 1;
    if (holes == 0 && is_convex(r, lo, lo + n)) {
        for (uint32_t i = 0; i < n; i++) out->piece_vertex[out->corners++] = lo + i;
        out->piece_end[out->pieces++] = out->corners;
        return;
    }
    const size_t nodes = (size_t)n + 2 * (size_t)holes, halves = 3 * (nodes - 2);
    const sunder_i_mark mark = sunder_i_arena_mark(arena);
    uint32_t *block = sunder_i_arena_alloc(arena, 10 * nodes + 4 * halves + holes + 2, sizeof *block);
    uint8_t *state = sunder_i_arena_alloc(arena, nodes, sizeof *state);
    if (!block || !state) return;
    cutter c = {.r = r, .state = state};
    uint32_t **const array[] = {&c.walk.vertex, &c.walk.next, &c.walk.prev,  &c.walk.beyond,
                                &c.list,        &c.stamp,     &c.turn[0],    &c.turn[1]};
    for (size_t k = 0; k < 8; k++, block += nodes) *array[k] = block;
    uint32_t **const half[] = {&c.mesh.origin, &c.mesh.twin, &c.mesh.next, &c.mesh.prev};
    for (size_t k = 0; k < 4; k++, block += halves) *half[k] = block;
    c.bridge_half = block;
    block += holes;
    uint32_t *const spare = block;
    block += nodes;
    for (uint32_t i = 0; i < n; i++) {
        c.walk.vertex[i] = lo + i;
        c.walk.next[i] = r->next[lo + i] - lo;
        c.walk.prev[i] = r->prev[lo + i] - lo;
        c.walk.beyond[i] = SUNDER_I_NONE;
    }
    c.walk.nodes = n;
    if (holes) {
        for (uint32_t i = 0; i < holes; i++) c.bridge_half[i] = SUNDER_I_NONE;
        sunder_i_bridge_holes(r, ring_lo, ring_hi, &c.walk, arena);
    }
    for (uint32_t i = 0; i < c.walk.nodes; i++) {
        c.state[i] = turn(&c, c.walk.prev[i], i, c.walk.next[i]) > 0 ? CONVEX : BLUNT;
        c.stamp[i] = 0;
        if (c.state[i] == BLUNT)
            c.list[c.listed++] = i;
        else
            c.turn[1][c.turn_n++] = i;
    }
    c.live = c.listed;
    if (c.listed >= GRID_FROM) c.cell_end = block;
    if (!arena->failed && !r->lattice->arena.failed) {
        cut_ears(&c, spare);
        sunder_i_mesh_merge(r, &c.mesh);
        collect(&c.mesh, out);
    }
    if (!arena->failed) sunder_i_arena_release(arena, mark);
}

bool sunder_i_pieces_find(const sunder_i_rings *r, sunder_i_arena *arena, sunder_i_pieces *out)
{
    /* A polygon of n vertices and h holes has at most n + 2 h - 2 triangles. */
    const size_t most = r->vertices + 2 * (size_t)r->rings;
    out->pieces = out->corners = 0;
    out->piece_end = sunder_i_arena_alloc(arena, most, sizeof *out->piece_end);
    out->piece_vertex = sunder_i_arena_alloc(arena, 3 * most, sizeof *out->piece_vertex);
    if (arena->failed) return false;
    for (uint32_t p = 0; p < r->polygons; p++)
        decompose(r, p ? r->poly_end[p - 1] : 0, r->poly_end[p], arena, out);
    return !arena->failed && !r->lattice->arena.failed;
}
