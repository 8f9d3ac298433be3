/* diagonals.c: finds the diagonals of a shape, and their quadrilaterals. A diagonal is a side of two pieces that is not
 * an edge of the shape. The sides are sorted by their two ends, so that the two sides of a diagonal are adjacent; the
 * vertex after each side shows on which side of the diagonal its piece is. The number of additional bits of the lattice
 * follows from the lengths: p = m + (w - m) / 2^j is near enough if |w - m| / 2^j <= |uv| / 4. */
#include "motion/diagonals.h"

#include "base/sort.h"
#include "predicate/predicate.h"
#include "predicate/rational_point.h"

#include <math.h>
#include <string.h>

/* ---- Diagonals ---- */

/* A side of a piece that is not an edge of the shape: it goes from u to v, and w is the next vertex of the piece. */
typedef struct side {
    uint32_t u, v, w;
} side;

static int compare_sides(void *context, uint32_t a, uint32_t b)
{
    const side *s = context;
    const uint32_t low_a = s[a].u < s[a].v ? s[a].u : s[a].v, low_b = s[b].u < s[b].v ? s[b].u : s[b].v;
    if (low_a != low_b) return low_a < low_b ? -1 : 1;
    const uint32_t high_a = s[a].u ^ s[a].v ^ low_a, high_b = s[b].u ^ s[b].v ^ low_b;
    if (high_a != high_b) return high_a < high_b ? -1 : 1;
    return s[a].u < s[a].v ? -1 : 1;
}

static size_t inner_sides(const sunder_shape *shape, side *out)
{
    size_t n = 0;
    for (uint32_t i = 0, first = 0; i < shape->pieces; first = shape->piece_end[i++]) {
        const uint32_t *corner = sunder_i_piece_vertices(shape) + first, m = shape->piece_end[i] - first;
        for (uint32_t k = 0; k < m; k++) {
            const uint32_t u = corner[k], v = corner[(k + 1) % m];
            if (!sunder_i_is_boundary(shape, u, v)) out[n++] = (side){u, v, corner[(k + 2) % m]};
        }
    }
    return n;
}

/* ---- Additional bits ---- */

/* Returns an exponent e with |b - a| < 2^e, and with |b - a| >= 2^(e - 1) up to rounding. The doubles may have any
 * size: intermediate results do not overflow. */
static int size_of(const double *a, const double *b)
{
    int e;
    const double d = hypot(b[0] / 4 - a[0] / 4, b[1] / 4 - a[1] / 4);
    frexp(d > 0 ? d : 0x1p-1074, &e);
    return e + 2;
}

/* The number of bits that suffice for both of the corners that the quadrilateral of the diagonal adds, since |w - m| <=
 * |w - u| + |uv|. */
static unsigned bits_of(const double *xy, const uint32_t corner[4])
{
    const double *u = xy + 2 * (size_t)corner[0], *v = xy + 2 * (size_t)corner[2];
    int most = size_of(u, v);
    const int least = most;
    for (int k = 1; k < 4; k += 2) {
        const int far = size_of(u, xy + 2 * (size_t)corner[k]);
        if (far > most) most = far;
    }
    return (unsigned)(most - least) + 6;
}

/* Returns true if one of the four vertices has an exact rational position that doubles cannot represent. */
static bool has_exact(const sunder_shape *shape, const uint32_t corner[4])
{
    bool any = false;
    for (int i = 0; i < 4 && shape->rational; i++) any = any || shape->form->numbers->exact[corner[i]].den.size;
    return any;
}

bool sunder_i_diagonals_find(const sunder_shape *shape, sunder_i_diagonals *out)
{
    memset(out, 0, sizeof *out);
    const size_t corners = shape->pieces ? shape->piece_end[shape->pieces - 1] : 0;
    side *sides = sunder_i_alloc(corners, sizeof *sides);
    uint32_t *order = sunder_i_alloc(corners, sizeof *order);
    out->corner = sunder_i_alloc(corners, sizeof *out->corner);
    bool ok = sides && order && out->corner;
    const size_t n = ok ? inner_sides(shape, sides) : 0;
    for (size_t i = 0; i < n; i++) order[i] = (uint32_t)i;
    ok = ok && sunder_i_sort_indices(order, n, compare_sides, sides);
    for (size_t i = 0; ok && i + 1 < n; i += 2) { /* each diagonal is a side of exactly two pieces */
        const side *left = &sides[order[i]], *right = &sides[order[i + 1]];
        const uint32_t corner[4] = {left->u, right->w, left->v, left->w};
        memcpy(out->corner[out->n++], corner, sizeof corner);
        const unsigned bits = has_exact(shape, corner) ? 0 : bits_of(shape->xy, corner);
        if (bits > out->bits) out->bits = bits;
    }
    sunder_i_free_all(sides, order);
    if (!ok) sunder_i_diagonals_free(out);
    return ok;
}

void sunder_i_diagonals_free(sunder_i_diagonals *diagonals)
{
    sunder_i_free(diagonals->corner);
    memset(diagonals, 0, sizeof *diagonals);
}

/* ---- The quadrilaterals ---- */

/* Returns u + uv / 2 + (w - m) / 2^j with w - m = (2 uw - uv) / 2, that is (u + v) / 2 + (2 w - u - v) / 2^(j + 1). The
 * point is on the lattice if the lattice's unit is fine enough. */
static sunder_i_point point_towards(sunder_i_lattice *l, sunder_i_point u, sunder_i_point v, sunder_i_point w,
                                    unsigned j)
{
    if (l->arena.failed) return u;
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_rational_point a = sunder_i_rational_get(m, l, u);
    const sunder_i_rational_point uv = sunder_i_rational_sub(m, sunder_i_rational_get(m, l, v), a);
    const sunder_i_rational_point uw = sunder_i_rational_sub(m, sunder_i_rational_get(m, l, w), a);
    /* The difference to u is (uv (2^j - 1) + 2 uw) / 2^(j + 1), over the product of the denominators of uv and uw. */
    const sunder_i_big part = sunder_i_big_sub(m, sunder_i_big_shl(m, uw.w, j), uw.w);
    const sunder_i_big twice = sunder_i_big_shl(m, uv.w, 1);
    const sunder_i_big x = sunder_i_big_add(m, sunder_i_big_mul(m, uv.x, part), sunder_i_big_mul(m, uw.x, twice));
    const sunder_i_big y = sunder_i_big_add(m, sunder_i_big_mul(m, uv.y, part), sunder_i_big_mul(m, uw.y, twice));
    const sunder_i_big den = sunder_i_big_shl(m, sunder_i_big_mul(m, uv.w, uw.w), j + 1);
    const sunder_i_rational_point from_u = {sunder_i_big_neg(x), sunder_i_big_neg(y), den};
    const sunder_i_point at = sunder_i_rational_put(l, sunder_i_rational_sub(m, a, from_u));
    sunder_i_lattice_end(l, mark);
    return at;
}

/* Returns true if the quadrilateral q is strictly convex at both ends of the diagonal. It always is at its other two
 * corners, which are on either side of the diagonal. */
static bool is_convex(sunder_i_lattice *l, const sunder_i_point q[4])
{
    return sunder_i_orient(l, q[3], q[0], q[1]) > 0 && sunder_i_orient(l, q[1], q[2], q[3]) > 0;
}

void sunder_i_diagonals_add(const sunder_i_diagonals *diagonals, sunder_i_lattice *lattice, const sunder_i_point *at,
                            sunder_i_convex_pieces *list)
{
    for (size_t i = 0; i < diagonals->n; i++) {
        const uint32_t *corner = diagonals->corner[i];
        const sunder_i_point u = at[corner[0]], v = at[corner[2]];
        sunder_i_point quad[4] = {u, u, v, u};
        /* The loop ends: near enough to the diagonal the quadrilateral is convex. */
        for (unsigned j = 1; !lattice->arena.failed; j++) {
            for (int k = 1; k < 4; k += 2) quad[k] = point_towards(lattice, u, v, at[corner[k]], j);
            if (is_convex(lattice, quad)) break;
        }
        for (int k = 0; k < 4; k++) sunder_i_convex_pieces_add_corner(list, quad[k], false);
        list->end[list->n++] = list->corners;
    }
}
