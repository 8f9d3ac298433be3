/* arrangement.c: union by arrangement [AFH00, section 2].
 *
 * All subsums are inserted into one arrangement, whole polygons in random order. Its vertical decomposition is updated
 * at each insertion, so that the first corner of each subsum is found in expected logarithmic time and its sides are
 * followed from trapezoid to trapezoid. After the last insertion, one traversal from the outermost face marks every
 * cell with the number of subsums that cover it: it differs across an edge by the subsums bounded by it, a number
 * stored with the edge. The sum is the union of the covered cells; an edge or vertex that no subsum covers, between
 * covered faces, is a degenerate hole.
 *
 * Invariant: the map is the arrangement of the subsums inserted so far, and each half-edge counts those on its left
 * that it bounds, coincident sides with their multiplicity. So nothing is lost if sides overlap or many cross in one
 * point.
 *
 * Time: expected O(I + k log k) for k sides of subsums and I crossings, whatever the sum is: I may be of order k^2 for
 * a sum of a few vertices. The insertion order affects the search and the number of walls that are cut, never I. */
#include "base/random.h"
#include "unions/unions.h"

static sunder_status arrange_subsums(sunder_i_uniting *u, uint32_t *subsum, sunder_i_planar_map *map, sunder_error *err)
{
    for (uint32_t k = 0; k < u->subsums; k++) subsum[k] = k;
    if (!sunder_i_order_subsums(u, subsum, u->subsums)) return sunder_i_failure_cause(err);
    const sunder_status status = sunder_i_feed(u, subsum, u->subsums, sunder_i_planar_map_insert_polygon, map, err);
    return status == SUNDER_OK ? sunder_i_planar_map_mark(map, err) : status;
}

sunder_status sunder_i_unite_by_arrangement(sunder_i_uniting *u, sunder_i_planar_map **out, sunder_error *err)
{
    sunder_i_planar_map *map;
    sunder_status status = sunder_i_planar_map_new(u->lattice, sunder_i_draw(&u->random), &map, err);
    if (status != SUNDER_OK) return status;
    uint32_t *subsum = sunder_i_alloc(u->subsums, sizeof *subsum);
    status = subsum ? arrange_subsums(u, subsum, map, err) : sunder_i_failure_cause(err);
    sunder_i_free(subsum);
    if (status == SUNDER_OK)
        *out = map;
    else
        sunder_i_planar_map_free(map);
    return status;
}
