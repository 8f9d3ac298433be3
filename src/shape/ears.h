/* ears.h: triangulates a closed walk by cutting off ears. */
#ifndef SUNDER_I_EARS_H
#define SUNDER_I_EARS_H

#include "shape/build.h"

/* Triangulates the walk, which is consumed, and adds the triangles to the mesh, which has room for them. bridge_half[]
 * is initially NONE for each bridge. If out of memory (arena->failed or the lattice's) the mesh is incomplete. */
void sunder_i_ears_cut(const sunder_i_rings *r, sunder_i_walk *walk, uint32_t *bridge_half, uint32_t bridges,
                       sunder_i_mesh *mesh, sunder_i_arena *arena);

#endif
