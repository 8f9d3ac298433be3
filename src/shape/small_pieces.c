/* small_pieces.c: triangulates a small walk by ears, as ears.c does, and merges the triangles, as merge_triangles.c
 * does. Pieces and their order are the same, since the same tests are made in the same order. */
#include "shape/small_walk.h"

#define NONE SUNDER_I_SMALL_NONE
#define BRIDGE SUNDER_I_SMALL_BRIDGE

typedef struct mesh {
    uint32_t halves;
    /* as in sunder_i_mesh; `origin` are nodes */
    uint8_t origin[SUNDER_I_SMALL_HALVES], next[SUNDER_I_SMALL_HALVES], prev[SUNDER_I_SMALL_HALVES];
    uint8_t twin[NONE + 1]; /* twin[NONE] may be written */
} mesh;

typedef struct cutter {
    sunder_i_small_walk *w;
    mesh *m;
    uint32_t blunt, stamped; /* sets of nodes: those that are not convex; those whose neighbour was cut in this round */
    uint8_t turn[2][2 * SUNDER_I_SMALL_NODES];
    uint32_t turn_n;
    uint8_t *now, *later;
    uint8_t bridge_half[SUNDER_I_SMALL_BRIDGES]; /* the half-edge that reached the bridge first, or NONE */
} cutter;

/* Returns whether no blunt node is in the open triangle of b and its neighbours, or inside its third side. */
static bool is_ear(const cutter *c, uint32_t b)
{
    const sunder_i_small_walk *w = c->w;
    const uint32_t a = w->prev[b], d = w->next[b];
    uint32_t left = c->blunt & ~(1u << a | 1u << d);
    if (!left) return true;
    const sunder_i_point p = w->at[a], r = w->at[d], da = sunder_i_narrow_sub(p, r);
    for (; left; left &= left - 1) {
        const sunder_i_point v = w->at[__builtin_ctz(left)];
        if (!sunder_i_small_not_right(w->brief, da, sunder_i_narrow_sub(v, r))) continue;
        const sunder_i_point q = w->at[b], qv = sunder_i_narrow_sub(v, q);
        if (sunder_i_small_left(w->brief, sunder_i_narrow_sub(q, p), qv) &&
            sunder_i_small_left(w->brief, sunder_i_narrow_sub(r, q), qv))
            return false;
    }
    return true;
}

/* Links side h of a new triangle to what is beyond the edge that begins at the node. */
static inline void link_side(cutter *c, uint32_t h, uint32_t node)
{
    uint8_t beyond = c->w->beyond[node];
    if (beyond & BRIDGE && beyond != NONE) {
        uint8_t *met = &c->bridge_half[beyond & ~BRIDGE];
        beyond = *met;
        *met = (uint8_t)h;
    }
    c->m->twin[h] = beyond;
    c->m->twin[beyond] = (uint8_t)h;
}

static inline uint32_t add_triangle(cutter *c, uint32_t b)
{
    mesh *m = c->m;
    const uint32_t h = m->halves;
    const uint8_t a = c->w->prev[b];
    m->origin[h] = a;
    m->origin[h + 1] = (uint8_t)b;
    m->origin[h + 2] = c->w->next[b];
    m->next[h] = m->prev[h + 2] = (uint8_t)(h + 1);
    m->next[h + 1] = m->prev[h] = (uint8_t)(h + 2);
    m->next[h + 2] = m->prev[h + 1] = (uint8_t)h;
    m->halves += 3;
    link_side(c, h, a);
    link_side(c, h + 1, b);
    return h;
}

/* Updates a neighbour of a cut vertex: it may have become convex, and is not cut in this round. */
static inline void refresh_neighbour(cutter *c, uint32_t node)
{
    c->stamped |= 1u << node;
    if (!(c->blunt >> node & 1) || !sunder_i_small_turns_left(c->w, c->w->prev[node], node, c->w->next[node])) return;
    c->blunt &= ~(1u << node);
    c->later[c->turn_n++] = (uint8_t)node;
}

static void cut_ear(cutter *c, uint32_t b)
{
    const uint8_t a = c->w->prev[b], d = c->w->next[b];
    const uint32_t h = add_triangle(c, b);
    c->w->beyond[a] = (uint8_t)(h + 2);
    c->m->twin[h + 2] = NONE;
    c->w->next[a] = d;
    c->w->prev[d] = a;
    refresh_neighbour(c, a);
    refresh_neighbour(c, d);
}

static void cut_all(cutter *c)
{
    uint32_t left = c->w->nodes, last = 0;
    while (left > 3) {
        const uint32_t n = c->turn_n;
        uint8_t *const now = c->later;
        c->later = c->now;
        c->now = now;
        c->turn_n = c->stamped = 0;
        for (uint32_t i = 0; i < n; i++) {
            const uint8_t node = now[i];
            if (left > 3 && !(c->stamped >> node & 1) && is_ear(c, node)) {
                last = c->w->prev[node];
                cut_ear(c, node);
                left--;
            } else {
                c->later[c->turn_n++] = node;
            }
        }
    }
    /* the last triangle; all its three sides have neighbours */
    const uint32_t b = c->w->next[last], h = add_triangle(c, b);
    link_side(c, h + 2, c->w->next[b]);
}

static void triangulate_walk(sunder_i_small_walk *w, mesh *m)
{
    cutter c;
    c.w = w;
    c.m = m;
    c.blunt = (uint32_t)(((uint64_t)1 << w->nodes) - 1) & ~w->convex;
    c.turn_n = 0;
    c.now = c.turn[0];
    c.later = c.turn[1];
    m->halves = 0;
    memset(c.bridge_half, NONE, sizeof c.bridge_half);
    for (uint32_t left = w->convex; left; left &= left - 1) c.later[c.turn_n++] = (uint8_t)__builtin_ctz(left);
    cut_all(&c);
}

/* Returns whether the vertex at the origin of h would be strictly convex without the edge h; g is its twin. */
static inline bool convex_without(const sunder_i_small_walk *w, const mesh *m, uint32_t h, uint32_t g)
{
    return sunder_i_small_turns_left(w, m->origin[m->prev[h]], m->origin[h], m->origin[m->next[m->next[g]]]);
}

/* Removes diagonals. Each is tested at the half-edge made first; a diagonal is the third side of a triangle. */
static void merge_triangles(const sunder_i_small_walk *w, mesh *m)
{
    const uint32_t first = w->bridges ? 0 : 2, step = w->bridges ? 1 : 3;
    for (uint32_t h = first; h < m->halves; h += step) {
        const uint8_t g = m->twin[h];
        if (g == NONE || g < h) continue;
        const bool here = convex_without(w, m, h, g), there = convex_without(w, m, g, h);
        if (!(here & there)) continue;
        m->next[m->prev[h]] = m->next[g];
        m->prev[m->next[g]] = m->prev[h];
        m->next[m->prev[g]] = m->next[h];
        m->prev[m->next[h]] = m->prev[g];
        m->origin[h] = m->origin[g] = NONE;
    }
}

static void collect_pieces(const sunder_i_small_walk *w, mesh *m, sunder_i_pieces *out)
{
    uint32_t corners = 0, pieces = 0;
    for (uint32_t h = 0; h < m->halves; h++) {
        if (m->origin[h] == NONE) continue;
        for (uint32_t g = h; m->origin[g] != NONE; g = m->next[g]) {
            out->piece_vertex[corners++] = w->vertex[m->origin[g]];
            m->origin[g] = NONE;
        }
        out->piece_end[pieces++] = corners;
    }
    out->corners = corners;
    out->pieces = pieces;
}

void sunder_i_small_pieces(sunder_i_small_walk *walk, sunder_i_pieces *out)
{
    mesh m;
    triangulate_walk(walk, &m);
    merge_triangles(walk, &m);
    collect_pieces(walk, &m, out);
}
