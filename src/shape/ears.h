/* Triangulating a closed walk by cutting off ears. */
#ifndef SUNDER_I_EARS_H
#define SUNDER_I_EARS_H

#include "shape/build.h"

/* Cuts the walk down to nothing; its triangles are added to the mesh, which has room for them. bridge_half: for each of
 * the bridges NONE at first. Where memory is out (the arena's or the lattice's) the mesh is unfinished. */
void sunder_i_ears_cut(const sunder_i_rings *r, sunder_i_walk *walk, uint32_t *bridge_half, uint32_t bridges,
                       sunder_i_mesh *mesh, sunder_i_arena *arena);

#endif
