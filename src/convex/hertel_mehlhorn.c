/* hertel_mehlhorn.c: the merging of Hertel and Mehlhorn [HM83]: diagonals are removed one after the other, each unless
 * the corner at one of its ends would become reflex. Each test takes O(1) with the adjacent half-edges, so that the
 * total time is linear. */
#include "convex/hertel_mehlhorn.h"

#include "predicate/predicate.h"

#include <string.h>

#define NONE UINT32_MAX

/* The half-edges of the pieces, in the order of the shape's corner list. */
typedef struct mesh {
    sunder_i_lattice *lattice;
    const sunder_i_point *at;
    uint32_t n;
    uint32_t *origin, *next, *prev;
    uint32_t *slot; /* a hash table of half-edges by (origin, end); NONE: free */
    uint32_t mask;
} mesh;

static uint32_t slot_of(const mesh *m, uint32_t u, uint32_t v)
{
    const uint64_t h = ((uint64_t)u << 32 | v) * 0x9e3779b97f4a7c15u;
    return (uint32_t)(h >> 32) & m->mask;
}

static uint32_t end_of(const mesh *m, uint32_t h) { return m->origin[m->next[h]]; }

static uint32_t find_half_edge(const mesh *m, uint32_t u, uint32_t v)
{
    for (uint32_t s = slot_of(m, u, v); m->slot[s] != NONE; s = (s + 1) & m->mask)
        if (m->origin[m->slot[s]] == u && end_of(m, m->slot[s]) == v) return m->slot[s];
    return NONE;
}

static bool mesh_init(mesh *m, const sunder_shape *shape)
{
    m->n = shape->piece_end[shape->pieces - 1];
    uint32_t slots = 16;
    while (slots < 2 * m->n) slots *= 2;
    m->mask = slots - 1;
    m->origin = sunder_i_alloc(m->n, sizeof *m->origin);
    m->next = sunder_i_alloc(m->n, sizeof *m->next);
    m->prev = sunder_i_alloc(m->n, sizeof *m->prev);
    m->slot = sunder_i_alloc(slots, sizeof *m->slot);
    if (!m->origin || !m->next || !m->prev || !m->slot) return false;
    memcpy(m->origin, sunder_i_piece_vertices(shape), m->n * sizeof *m->origin);
    memset(m->slot, 0xff, slots * sizeof *m->slot);
    for (uint32_t i = 0, first = 0; i < shape->pieces; first = shape->piece_end[i++])
        for (uint32_t h = first; h < shape->piece_end[i]; h++) {
            m->next[h] = h + 1 < shape->piece_end[i] ? h + 1 : first;
            m->prev[h] = h > first ? h - 1 : shape->piece_end[i] - 1;
        }
    for (uint32_t h = 0; h < m->n; h++) {
        const uint32_t u = m->origin[h], v = end_of(m, h);
        if (sunder_i_is_boundary(shape, u, v)) continue;
        uint32_t s = slot_of(m, u, v);
        while (m->slot[s] != NONE) s = (s + 1) & m->mask;
        m->slot[s] = h;
    }
    return true;
}

static void mesh_free(mesh *m) { sunder_i_free_all(m->origin, m->next, m->prev, m->slot); }

/* Returns true if the corner at the origin of half-edge h would be convex or straight without h and its twin g. */
static bool good_without(const mesh *m, uint32_t h, uint32_t g)
{
    const uint32_t before = m->origin[m->prev[h]], after = end_of(m, m->next[g]);
    return sunder_i_orient(m->lattice, m->at[before], m->at[m->origin[h]], m->at[after]) >= 0;
}

/* Removes the diagonal with the half-edges h and g; their origins become NONE, so that find_half_edge() does not find
 * them again. */
static void dissolve_diagonal(mesh *m, uint32_t h, uint32_t g)
{
    m->next[m->prev[h]] = m->next[g];
    m->prev[m->next[g]] = m->prev[h];
    m->next[m->prev[g]] = m->next[h];
    m->prev[m->next[h]] = m->prev[g];
    m->origin[h] = m->origin[g] = NONE;
}

static void collect_pieces(mesh *m, const sunder_shape *shape, sunder_i_convex_pieces *out)
{
    for (uint32_t h = 0; h < m->n; h++) {
        if (m->origin[h] == NONE) continue;
        const uint32_t first = out->corners;
        for (uint32_t g = h; m->origin[g] != NONE; g = m->next[g]) {
            out->vertex[out->corners++] = m->origin[g];
            m->origin[g] = NONE;
        }
        out->end[out->n++] = out->corners;
        for (uint32_t k = first; k < out->corners; k++) {
            const uint32_t u = out->vertex[k], v = out->vertex[k + 1 < out->corners ? k + 1 : first];
            out->corner[k] = m->at[u];
            out->candidate[k] = sunder_i_is_boundary(shape, u, v);
        }
    }
}

bool sunder_i_hertel_mehlhorn(sunder_i_lattice *lattice, const sunder_shape *shape, const sunder_i_point *at,
                              sunder_i_convex_pieces *out)
{
    const uint32_t corners = shape->pieces ? shape->piece_end[shape->pieces - 1] : 0;
    mesh m = {.lattice = lattice, .at = at};
    if (!sunder_i_convex_pieces_init(out, shape->pieces, corners)) return false;
    out->vertex = sunder_i_alloc(corners, sizeof *out->vertex);
    const bool ok = out->vertex && (corners == 0 || mesh_init(&m, shape));
    for (uint32_t h = 0; ok && h < m.n; h++) {
        if (m.origin[h] == NONE || sunder_i_is_boundary(shape, m.origin[h], end_of(&m, h))) continue;
        const uint32_t g = find_half_edge(&m, end_of(&m, h), m.origin[h]);
        /* A diagonal with the same piece on both sides must stay, since without it the boundary of the piece would have
         * two components; this is the case if its half-edges are adjacent. */
        if (g == NONE || m.next[h] == g || m.next[g] == h) continue;
        if (good_without(&m, h, g) && good_without(&m, g, h)) dissolve_diagonal(&m, h, g);
    }
    if (ok) collect_pieces(&m, shape, out);
    mesh_free(&m);
    if (!ok) sunder_i_convex_pieces_free(out);
    return ok;
}
