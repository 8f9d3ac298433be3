/* A feature, cut by lines into parts, exactly; see side_cut.c. */
#ifndef SUNDER_I_SIDE_CUT_H
#define SUNDER_I_SIDE_CUT_H

#include "displacement/layer/sides.h"

#include "number/ratio.h"
#include "planar_map/planar_map.h"

/* A part: a face of a member's map that lies inside the member. */
typedef struct sunder_i_cut_part {
    sunder_i_planar_map *map;
    uint32_t face;
    double area, off; /* twice its area in squared units of the lattice, and a bound of the error of that */
} sunder_i_cut_part;

typedef struct sunder_i_side_cut {
    const sunder_shape *shape;
    const sunder_i_side *const *side;
    size_t sides;
    sunder_i_lattice lattice;
    double origin[2];
    sunder_i_arena arena;      /* holds points and numbers */
    sunder_i_planar_map **map; /* [polygons of the shape] the map of each member */
    sunder_i_cut_part *part;
    size_t parts, part_capacity;
    bool any; /* some line meets a member's interior */
} sunder_i_side_cut;

/* Computes all parts, in the order of the members. `out` borrows `shape` and the lines, and must be freed by
 * sunder_i_side_cut_free() even after failure. */
sunder_status sunder_i_side_cut_make(const sunder_shape *shape, const sunder_i_side *const *side, size_t n,
                                     sunder_i_side_cut *out, sunder_error *err);
void sunder_i_side_cut_free(sunder_i_side_cut *cut);
/* Keeps only the parts whose area is at most `slack` (in squared units of the layer) less than the largest area. */
void sunder_i_side_cut_keep_largest(sunder_i_side_cut *cut, double slack);

/* Called with the two ends of each half-edge that has the part on its left. A line that ends inside the part has two
 * such half-edges. */
typedef void (*sunder_i_visit_side_cut)(sunder_i_side_cut *cut, const sunder_i_rational_point *from,
                                        const sunder_i_rational_point *to, void *context);

/* Calls `visit` for all half-edges of the boundary of the part. */
void sunder_i_side_cut_boundary(sunder_i_side_cut *cut, const sunder_i_cut_part *part, sunder_i_visit_side_cut visit,
                                void *context);
/* Sets *holds if the part contains the point, off all lines. */
sunder_status sunder_i_side_cut_holds(const sunder_i_cut_part *part, sunder_i_rational_point at, bool *holds,
                                      sunder_error *err);
/* ---- side_room.c: the room that the feature has beyond a point of it, as a square in units of the lattice ---- */

/* Returns the square of the distance, in units of the lattice, from `point` of a part to the nearest of the n lines
 * beyond it, at most the square of `reach`; see side_room.c. The lines are those within sunder_side_reach() of the
 * shape's box. */
sunder_i_ratio sunder_i_side_room(sunder_i_side_cut *cut, sunder_i_rational_point point,
                                  const sunder_i_side *const *line, size_t n, double reach);

/* Converts a length of the layer, or with power 2 an area, into units of the lattice. */
sunder_i_ratio sunder_i_side_cut_in_units(sunder_i_side_cut *cut, double size, int power);
/* Converts doubles to a point of the cut's plane, and such a point to the nearest doubles. */
sunder_i_rational_point sunder_i_side_cut_point(sunder_i_side_cut *cut, const double xy[2]);
void sunder_i_side_cut_doubles(sunder_i_side_cut *cut, const sunder_i_rational_point *at, double xy[2]);

#endif
