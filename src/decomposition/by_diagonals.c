/* by_diagonals.c: decompositions by diagonals only: every corner is a vertex of the shape. */
#include "base/sort.h"
#include "decomposition/maker.h"

#include <math.h>

void sunder_i_make_shape_pieces(sunder_i_maker *m)
{
    const sunder_shape *s = m->shape;
    uint32_t at = 0;
    for (uint32_t i = 0; i < s->pieces; i++) {
        /* The pieces are in the order of the polygons to which they belong. */
        while (s->form->cleaned.ring_end[s->form->cleaned.poly_end[m->polygon] - 1] <= sunder_i_piece_vertices(s)[at])
            m->polygon++;
        sunder_i_maker_add_vertices(m, sunder_i_piece_vertices(s) + at, s->piece_end[i] - at);
        at = s->piece_end[i];
    }
}

/* Adds the faces of the mesh as pieces. */
void sunder_i_maker_add_faces(sunder_i_maker *m, sunder_i_mesh *mesh)
{
    const sunder_i_rings *r = &m->rings;
    for (uint32_t h = 0; h < mesh->halves; h++) {
        if (mesh->origin[h] == SUNDER_I_NONE) continue;
        uint32_t g = h;
        do {
            const uint32_t next = mesh->next[g];
            const sunder_i_point u = r->at[mesh->origin[g]], v = r->at[mesh->origin[next]];
            sunder_i_maker_add_side(m, mesh->origin[g], sunder_i_point_sub(m->lattice, v, u));
            g = next;
        } while (g != h);
        while (mesh->origin[g] != SUNDER_I_NONE) {
            mesh->origin[g] = SUNDER_I_NONE;
            g = mesh->next[g];
        }
        sunder_i_maker_end_piece(m);
    }
}

void sunder_i_make_triangles(sunder_i_maker *m, const sunder_i_member *member)
{
    sunder_i_mesh mesh;
    if (!sunder_i_triangulate(&m->rings, member->ring_lo, member->ring_hi, &m->scratch, &mesh)) return;
    sunder_i_maker_add_faces(m, &mesh);
}

static int longer_first(void *context, uint32_t a, uint32_t b)
{
    const double *length = context;
    return length[a] == length[b] ? (a > b) - (a < b) : length[a] > length[b] ? -1 : 1;
}

void sunder_i_mesh_short(sunder_i_maker *m, const sunder_i_member *member, sunder_i_mesh *mesh, uint32_t *diagonals,
                         double *sum)
{
    const sunder_i_rings *r = &m->rings;
    if (!sunder_i_triangulate(r, member->ring_lo, member->ring_hi, &m->scratch, mesh)) return;
    double *length = sunder_i_arena_alloc(&m->scratch, mesh->halves, sizeof *length);
    uint32_t *order = sunder_i_arena_alloc(&m->scratch, mesh->halves, sizeof *order), n = 0;
    if (!length || !order) return;
    for (uint32_t h = 0; h < mesh->halves; h++) {
        const uint32_t g = mesh->twin[h];
        if (g == SUNDER_I_NONE || g < h) continue;
        const double *a = r->xy + 2 * (size_t)mesh->origin[h], *b = r->xy + 2 * (size_t)mesh->origin[g];
        length[h] = hypot(a[0] - b[0], a[1] - b[1]);
        order[n++] = h;
    }
    if (!sunder_i_sort_indices(order, n, longer_first, length)) {
        m->scratch.failed = true;
        return;
    }
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t h = order[i], g = mesh->twin[h];
        if (sunder_i_mesh_removable(r, mesh, h, g)) {
            sunder_i_mesh_remove(mesh, h, g);
        } else {
            ++*diagonals;
            *sum += length[h];
        }
    }
}
