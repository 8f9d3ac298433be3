/* maker.c: functions of all decompositions: the rings of a shape on its lattice, the vertices of one polygon, and lists
 * of pieces, their corners and Steiner points, which grow as pieces are found and are copied without spare memory at
 * the end. */
#include "decomposition/maker.h"

#include "base/invariant.h"

#include <string.h>

/* Returns a coordinate as a double, by a monotone conversion: the order of doubles is that of the exact numbers. The
 * functions below need no more of rounded coordinates. */
static double monotone_double(sunder_i_lattice *l, int64_t n, bool *rounded)
{
    if (!sunder_i_is_plain(n) || n > (int64_t)1 << 53 || n < -((int64_t)1 << 53) || l->approx_shift) *rounded = true;
    return sunder_i_approx(l, n);
}

bool sunder_i_maker_init(sunder_i_maker *m, sunder_i_lattice *lattice, const sunder_shape *shape,
                         const sunder_i_point *at)
{
    memset(m, 0, sizeof *m);
    m->lattice = lattice;
    m->shape = shape;
    sunder_i_rings *r = &m->rings;
    r->lattice = lattice;
    r->vertices = shape->vertices;
    r->rings = shape->form->cleaned.rings;
    r->polygons = shape->form->cleaned.polygons;
    /* Borrowed from the shape, and not modified. */
    r->ring_end = (uint32_t *)shape->form->cleaned.ring_end;
    r->poly_end = (uint32_t *)shape->form->cleaned.poly_end;
    r->next = (uint32_t *)shape->form->cleaned.next;
    r->prev = (uint32_t *)shape->form->cleaned.prev;
    r->at = sunder_i_alloc(shape->vertices, sizeof *r->at);
    r->xy = sunder_i_alloc(2 * (size_t)shape->vertices, sizeof *r->xy);
    if (!r->at || !r->xy) return false;
    for (uint32_t i = 0; i < shape->vertices; i++) {
        r->at[i] = at[i];
        r->xy[2 * (size_t)i] = monotone_double(lattice, at[i].x, &r->rounded);
        r->xy[2 * (size_t)i + 1] = monotone_double(lattice, at[i].y, &r->rounded);
    }
    return !lattice->arena.failed;
}

void sunder_i_maker_free(sunder_i_maker *m)
{
    sunder_i_free_all(m->rings.at, m->rings.xy, m->piece_end, m->piece_corner, m->member, m->along, m->steiner);
    sunder_i_arena_free(&m->scratch);
    memset(m, 0, sizeof *m);
}

bool sunder_i_maker_failed(const sunder_i_maker *m) { return m->scratch.failed || m->lattice->arena.failed; }

sunder_i_member sunder_i_maker_member(const sunder_i_maker *m, uint32_t polygon)
{
    const sunder_i_rings *r = &m->rings;
    sunder_i_member part = {.ring_lo = polygon ? r->poly_end[polygon - 1] : 0, .ring_hi = r->poly_end[polygon]};
    part.first = part.ring_lo ? r->ring_end[part.ring_lo - 1] : 0;
    part.n = r->ring_end[part.ring_hi - 1] - part.first;
    for (uint32_t v = part.first; v < part.first + part.n; v++) part.reflex += sunder_i_is_reflex(r, v);
    return part;
}

void sunder_i_maker_add_side(sunder_i_maker *m, uint32_t corner, sunder_i_point along)
{
    if (!sunder_i_reserve(&m->piece_corner, &m->corner_room, (size_t)m->sides + 1, sizeof *m->piece_corner) ||
        !sunder_i_reserve(&m->along, &m->along_room, (size_t)m->sides + 1, sizeof *m->along)) {
        m->scratch.failed = true;
        return;
    }
    m->piece_corner[m->sides] = corner;
    m->along[m->sides++] = along;
}

static void reverse_sides(uint32_t *corner, sunder_i_point *along, uint32_t lo, uint32_t hi)
{
    while (lo + 1 < hi) {
        const uint32_t c = corner[lo];
        const sunder_i_point a = along[lo];
        corner[lo] = corner[--hi];
        along[lo] = along[hi];
        corner[hi] = c;
        along[hi] = a;
        lo++;
    }
}

void sunder_i_maker_end_piece(sunder_i_maker *m)
{
    if (sunder_i_maker_failed(m)) return;
    const uint32_t first = m->pieces ? m->piece_end[m->pieces - 1] : 0, n = m->sides - first;
    uint32_t *corner = m->piece_corner + first, kept = 0;
    sunder_i_point *along = m->along + first, before = along[n - 1];
    for (uint32_t k = 0; k < n; k++) {
        const sunder_i_point now = along[k];
        if (sunder_i_cross_sign(m->lattice, before, now) == 0) continue;
        corner[kept] = corner[k];
        along[kept++] = before = now;
    }
    uint32_t least = 0;
    for (uint32_t k = 1; k < kept; k++)
        if (sunder_i_angle_cmp(m->lattice, along[k], along[least]) < 0) least = k;
    if (least) { /* rotated by three reversals */
        reverse_sides(corner, along, 0, least);
        reverse_sides(corner, along, least, kept);
        reverse_sides(corner, along, 0, kept);
    }
    m->sides = first + kept;
    if (!sunder_i_reserve(&m->piece_end, &m->pieces_room, (size_t)m->pieces + 1, sizeof *m->piece_end) ||
        !sunder_i_reserve(&m->member, &m->member_room, (size_t)m->pieces + 1, sizeof *m->member)) {
        m->scratch.failed = true;
        return;
    }
    m->member[m->pieces] = m->polygon;
    m->piece_end[m->pieces++] = m->sides;
}

void sunder_i_maker_add_vertices(sunder_i_maker *m, const uint32_t *vertex, uint32_t n)
{
    const sunder_i_rings *r = &m->rings;
    for (uint32_t k = 0; k < n; k++)
        sunder_i_maker_add_side(m, vertex[k],
                                sunder_i_point_sub(m->lattice, r->at[vertex[k + 1 < n ? k + 1 : 0]], r->at[vertex[k]]));
    sunder_i_maker_end_piece(m);
}

void sunder_i_maker_add_whole(sunder_i_maker *m, const sunder_i_member *member)
{
    const sunder_i_rings *r = &m->rings;
    for (uint32_t v = member->first; v < member->first + member->n; v++)
        sunder_i_maker_add_side(m, v, sunder_i_point_sub(m->lattice, r->at[r->next[v]], r->at[v]));
    sunder_i_maker_end_piece(m);
}

uint32_t sunder_i_maker_add_steiner(sunder_i_maker *m, sunder_i_point a, sunder_i_point b, const sunder_i_fraction *t)
{
    if (!sunder_i_reserve(&m->steiner, &m->steiner_room, (size_t)m->steiner_n + 1, sizeof *m->steiner)) {
        m->scratch.failed = true;
        return 0;
    }
    const sunder_i_hpoint p = sunder_i_hpoint_at(m->lattice, a, b, t);
    m->steiner[m->steiner_n] = sunder_i_hpoint_read(&m->lattice->arena, m->lattice, &p);
    return m->shape->vertices + m->steiner_n++;
}

/* Returns a copy of n elements, allocated in the arena of the result. NULL if out of memory. */
static void *keep_copy(sunder_i_arena *arena, const void *from, size_t n, size_t size)
{
    void *to = sunder_i_arena_alloc(arena, n, size);
    if (to && n) memcpy(to, from, n * size);
    return to;
}

/* Returns the corner of a Steiner point, or of a vertex that is a crossing, in lowest terms. */
static sunder_i_corner reduced_corner(sunder_i_arena *arena, sunder_i_arena *scratch, sunder_i_rational_point at)
{
    const sunder_i_mark mark = sunder_i_arena_mark(scratch);
    const sunder_i_corner c = {sunder_i_rational_copy(arena, sunder_i_rational_reduced(scratch, at)), UINT32_MAX};
    if (!scratch->failed) sunder_i_arena_release(scratch, mark);
    return c;
}

void sunder_i_decomposition_clear(sunder_i_decomposition *decomposition)
{
    sunder_i_arena_free(&decomposition->arena);
    memset(decomposition, 0, sizeof *decomposition);
}

bool sunder_i_maker_finish(sunder_i_maker *m, sunder_i_decomposition *out)
{
    static const mp_limb_t one = 1;
    const uint32_t n = m->shape->vertices;
    memset(out, 0, sizeof *out);
    sunder_i_arena *arena = &out->arena;
    out->fallbacks = m->fallbacks;
    out->corners = n + m->steiner_n;
    out->corner = sunder_i_arena_alloc(arena, out->corners, sizeof *out->corner);
    out->pieces = m->pieces;
    out->piece_end = keep_copy(arena, m->piece_end, m->pieces, sizeof *m->piece_end);
    out->member = keep_copy(arena, m->member, m->pieces, sizeof *m->member);
    out->piece_corner = keep_copy(arena, m->piece_corner, m->sides, sizeof *m->piece_corner);
    out->along = keep_copy(arena, m->along, m->sides, sizeof *m->along);
    for (uint32_t i = 0; i < n && !arena->failed; i++) {
        sunder_i_corner *c = &out->corner[i];
        const sunder_i_point at = m->rings.at[i];
        if (sunder_i_point_is_plain(at)) {
            *c = (sunder_i_corner){{sunder_i_big_i64(arena, at.x), sunder_i_big_i64(arena, at.y), {&one, 1}}, i};
            continue;
        }
        *c = reduced_corner(arena, &m->scratch, sunder_i_rational_get(&m->scratch, m->lattice, at));
        c->vertex = i;
    }
    for (uint32_t i = 0; i < m->steiner_n && !arena->failed; i++)
        out->corner[n + i] = reduced_corner(arena, &m->scratch, m->steiner[i]);
    if (!arena->failed && !sunder_i_maker_failed(m))
        SUNDER_I_CHECK(sunder_i_decomposition_check(m->lattice, m->shape, m->rings.at, out), out->corners);
    if (!arena->failed && !sunder_i_maker_failed(m)) return true; /* the tests may have run out of memory, too */
    sunder_i_decomposition_clear(out);
    return false;
}
