/* repair.c: replaces an invalid polygon by the even-odd set of its rings. A valid polygon whose rings touch is
 * replaced, too, which changes its rings but not the set: they are traced so that each vertex represents one sector of
 * the interior, and an edge that a vertex touches from inside is divided there. */
#include "shape/repair.h"

#include "shape/even_odd.h"
#include "shape/rational_corners.h"

#include <string.h>

/* Copies the raw rings of one polygon without repeated vertices; rings with one position are omitted. Returns false if
 * out of memory. */
static bool raw_rings(const sunder_i_input *in, const sunder_i_point *at, size_t p, sunder_i_rings *raw,
                      sunder_i_arena *arena)
{
    const size_t ring_lo = p ? in->poly_end[p - 1] : 0, ring_hi = in->poly_end[p];
    const size_t lo = ring_lo ? in->ring_end[ring_lo - 1] : 0;
    if (!sunder_i_rings_grow(raw, arena, in->ring_end[ring_hi - 1] - lo, ring_hi - ring_lo, 1)) return false;
    for (size_t ring = ring_lo; ring < ring_hi; ring++) {
        const uint32_t begin = raw->vertices;
        for (size_t i = ring ? in->ring_end[ring - 1] : 0; i < in->ring_end[ring]; i++) {
            const double *xy = in->xy + 2 * i;
            const uint32_t v = raw->vertices;
            if (v > begin && raw->xy[2 * (size_t)v - 2] == xy[0] && raw->xy[2 * (size_t)v - 1] == xy[1]) continue;
            raw->xy[2 * (size_t)v] = xy[0];
            raw->xy[2 * (size_t)v + 1] = xy[1];
            raw->at[v] = at[i];
            raw->source[v] = (uint32_t)i;
            raw->vertices++;
        }
        while (raw->vertices > begin + 1 && sunder_i_rings_cmp(raw, raw->vertices - 1, begin) == 0) raw->vertices--;
        if (raw->vertices < begin + 2) {
            raw->vertices = begin;
            continue;
        }
        for (uint32_t i = begin; i < raw->vertices; i++) {
            raw->next[i] = i + 1 < raw->vertices ? i + 1 : begin;
            raw->prev[i] = i > begin ? i - 1 : raw->vertices - 1;
        }
        raw->ring_end[raw->rings++] = raw->vertices;
    }
    if (raw->rings) raw->poly_end[raw->polygons++] = raw->rings;
    return true;
}

/* Adds a crossing of the arrangement as a made point and sets xy to its nearest doubles. Returns false if out of
 * memory. */
static bool make_point(sunder_i_lattice *l, const sunder_i_hpoint *h, const double origin[2],
                       sunder_i_made_points *made, double xy[2], sunder_i_arena *arena)
{
    if (!sunder_i_reserve(&made->point, &made->capacity, made->n + 1, sizeof *made->point)) return false;
    const sunder_i_exact m = sunder_i_exact_make(arena, sunder_i_hpoint_read(arena, l, h), l->exponent, origin);
    if (arena->failed) return false;
    for (int k = 0; k < 2; k++) xy[k] = sunder_i_big_ratio(arena, m.num[k], m.den, m.exponent);
    made->rational |= !sunder_i_exact_is_double(arena, &m);
    made->point[made->n++] = m;
    return !arena->failed;
}

bool sunder_i_repair_polygon(sunder_i_rings *r, const sunder_i_input *in, const sunder_i_point *at,
                             const double origin[2], size_t p, sunder_i_made_points *made, sunder_i_arena *arena)
{
    sunder_i_rings raw = {.lattice = r->lattice};
    sunder_i_even_odd set;
    if (!raw_rings(in, at, p, &raw, arena) || !sunder_i_even_odd_find(&raw, arena, &set)) return false;
    if (!sunder_i_rings_grow(r, arena, set.points, set.rings, set.polygons)) return false;
    /* the numbers of those made points that are corners; the rings pass straight through the others */
    uint32_t *number = sunder_i_arena_alloc(arena, set.makes, sizeof *number);
    if (!number) return false;
    memset(number, 0xff, set.makes * sizeof *number);
    const uint32_t first = r->vertices, rings = r->rings;
    for (uint32_t i = 0; i < set.points; i++) {
        const uint32_t v = first + i, point = set.point[i];
        double *xy = r->xy + 2 * (size_t)v;
        if (!(point & SUNDER_I_MADE)) {
            r->source[v] = raw.source[point];
            r->at[v] = raw.at[point];
            memcpy(xy, raw.xy + 2 * (size_t)point, 2 * sizeof *xy);
            continue;
        }
        const uint32_t k = point & ~SUNDER_I_MADE;
        if (number[k] == SUNDER_I_NONE) {
            number[k] = (uint32_t)made->n;
            if (!make_point(r->lattice, &set.made[k], origin, made, xy, arena)) return false;
        } else {
            const sunder_i_exact *m = &made->point[number[k]];
            for (int c = 0; c < 2; c++) xy[c] = sunder_i_big_ratio(arena, m->num[c], m->den, m->exponent);
        }
        r->source[v] = SUNDER_I_MADE | number[k];
        r->at[v] = (sunder_i_point){0, 0};
    }
    r->vertices += set.points;
    for (uint32_t i = 0, v = first; i < set.rings; i++) {
        const uint32_t begin = v, end = first + set.ring_end[i];
        for (; v < end; v++) {
            r->next[v] = v + 1 < end ? v + 1 : begin;
            r->prev[v] = v > begin ? v - 1 : end - 1;
        }
        r->ring_end[r->rings++] = end;
    }
    for (uint32_t i = 0; i < set.polygons; i++) r->poly_end[r->polygons++] = rings + set.poly_end[i];
    return !arena->failed;
}

bool sunder_i_repair_place(sunder_i_rings *r, const sunder_i_made_points *made, const double origin[2],
                           sunder_i_arena *arena)
{
    /* sectors at one position share its number */
    sunder_i_point *at = sunder_i_arena_alloc(arena, made->n, sizeof *at);
    if (!at) return false;
    sunder_i_lattice_admit_ratios(r->lattice);
    for (size_t i = 0; i < made->n; i++) at[i] = sunder_i_place_exact(r->lattice, &made->point[i], NULL, origin);
    for (uint32_t v = 0; v < r->vertices; v++)
        if (r->source[v] & SUNDER_I_MADE) r->at[v] = at[r->source[v] & ~SUNDER_I_MADE];
    r->rounded = made->rational;
    return !r->lattice->arena.failed;
}
