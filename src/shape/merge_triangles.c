/* merge_triangles.c: the merging of Hertel and Mehlhorn [HM83]: a diagonal is removed if the union of the pieces on its
 * two sides is convex at both its ends. At most four times as many pieces remain as the best decomposition without
 * added vertices has; on buildings hardly more than the best. Pieces are strictly convex: a straight corner is not
 * accepted, since it may be needed as an end of edges. */
#include "shape/build.h"

/* Returns whether the vertex at the origin of h would be strictly convex without the edge h; g is its twin. */
static bool convex_without(const sunder_i_rings *r, const sunder_i_mesh *m, uint32_t h, uint32_t g)
{
    const uint32_t before = m->origin[m->prev[h]], after = m->origin[m->next[m->next[g]]];
    return sunder_i_rings_orient(r, before, m->origin[h], after) > 0;
}

bool sunder_i_mesh_removable(const sunder_i_rings *r, const sunder_i_mesh *mesh, uint32_t h, uint32_t g)
{
    return convex_without(r, mesh, h, g) && convex_without(r, mesh, g, h);
}

void sunder_i_mesh_remove(sunder_i_mesh *mesh, uint32_t h, uint32_t g)
{
    mesh->next[mesh->prev[h]] = mesh->next[g];
    mesh->prev[mesh->next[g]] = mesh->prev[h];
    mesh->next[mesh->prev[g]] = mesh->next[h];
    mesh->prev[mesh->next[h]] = mesh->prev[g];
    mesh->origin[h] = mesh->origin[g] = SUNDER_I_NONE; /* removed */
}

void sunder_i_mesh_merge(const sunder_i_rings *r, sunder_i_mesh *mesh)
{
    for (uint32_t h = 0; h < mesh->halves; h++) {
        const uint32_t g = mesh->twin[h];
        if (g == SUNDER_I_NONE || g < h) continue;
        if (sunder_i_mesh_removable(r, mesh, h, g)) sunder_i_mesh_remove(mesh, h, g);
    }
}
