/* divide.c: union by divide and conquer [AFH00, section 2].
 *
 * First P + Q_j is computed incrementally for each of the t pieces Q_j: the subsums are neighbouring pieces of P, each
 * enlarged by the same Q_j, so that the unions have about the size of P. Then pairs of these maps are united, and pairs
 * of the results, in log t rounds: one map is inserted into the other, edge by edge in random order, as subsums are in
 * arrangement.c; cells are marked; covered elements are removed.
 *
 * Invariant: after each round the maps are those of the unions of equally long sequences of subsums, including
 * degenerate holes. A map counts as one open region with its boundary, so that the rules for subsums in an arrangement
 * hold for maps: an edge or vertex between covered faces that neither map covers remains.
 *
 * Time: the sum, over the rounds, of the sizes of the maps and of the crossings within pairs. If Q has one piece, this
 * is the incremental union; if P has one, P + Q_j is a single subsum and there are only the rounds. */
#include "unions/unions.h"

static size_t edges_of(const sunder_i_planar_map *map)
{
    sunder_i_map_size size;
    sunder_i_planar_map_size(map, &size);
    return size.edges;
}

/* *a becomes the union of both, the smaller one inserted into the larger; b is freed in any case. */
static sunder_status unite_pair(sunder_i_planar_map **a, sunder_i_planar_map *b, sunder_error *err)
{
    if (edges_of(*a) < edges_of(b)) {
        sunder_i_planar_map *const t = *a;
        *a = b;
        b = t;
    }
    sunder_status status = sunder_i_planar_map_overlay(*a, b, err);
    sunder_i_planar_map_free(b);
    if (status == SUNDER_OK) status = sunder_i_planar_map_mark(*a, err);
    return status == SUNDER_OK ? sunder_i_planar_map_clean(*a, err) : status;
}

/* Map i becomes the union of maps 2 i and 2 i + 1, *n of them in the end; the last of an odd number remains as it
 * is. */
static sunder_status halve_maps(sunder_i_planar_map **map, uint32_t *n, sunder_error *err)
{
    const uint32_t before = *n;
    sunder_status status = SUNDER_OK;
    *n = before / 2 + before % 2;
    for (uint32_t i = 0; i < *n; i++) {
        sunder_i_planar_map *const a = map[2 * i], *const b = 2 * i + 1 < before ? map[2 * i + 1] : NULL;
        if (i) map[2 * i] = NULL;
        if (b) map[2 * i + 1] = NULL;
        map[i] = a;
        if (b && status == SUNDER_OK)
            status = unite_pair(&map[i], b, err);
        else
            sunder_i_planar_map_free(b);
    }
    return status;
}

sunder_status sunder_i_unite_by_halves(sunder_i_uniting *u, sunder_i_planar_map **out, sunder_error *err)
{
    uint32_t n = u->q.pieces;
    sunder_i_planar_map **map = sunder_i_calloc(n, sizeof(sunder_i_planar_map *));
    if (!map) return sunder_i_failure_cause(err);
    sunder_status status = SUNDER_OK;
    for (uint32_t j = 0; j < n && status == SUNDER_OK; j++)
        status = sunder_i_unite_some(u, j * u->p.pieces, u->p.pieces, &map[j], err);
    while (n > 1 && status == SUNDER_OK) status = halve_maps(map, &n, err);
    if (status == SUNDER_OK)
        *out = map[0];
    else
        for (uint32_t j = 0; j < u->q.pieces; j++) sunder_i_planar_map_free(map[j]);
    sunder_i_free(map);
    return status;
}
