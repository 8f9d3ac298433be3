/* The usual building: one ring of few corners that is sound as it was given. What the other files of this folder do in
 * general is done here on arrays of fixed size, with numbers of corners in bytes and sets of corners in the bits of a
 * word: cleaned (clean.c), looked over for crossings (intersections.c), turned (nesting.c), cut into ears (ears.c) that
 * are merged again (merge_triangles.c). The pieces are the same in the same order, since the same is asked in the same
 * order; only, nothing is repaired or explained here. A ring in which a corner repeats or is straight, or two edges
 * meet, or whose coordinates are too long for native integers, goes the general way.
 *
 * A turn that is not zero at every corner tells that nothing is to be cleaned. Of a ring whose edges meet nowhere else
 * the turn at its lowest corner tells its orientation, and it is convex if all turns are to the left. */
#include "shape/small_ring.h"

#include "shape/few_corners.h"

#include <string.h>

#define MOST SUNDER_I_FEW_CORNERS
#define HALVES (3 * (MOST - 2)) /* half-edges of a triangulation */
#define NONE 0xff

typedef struct ring {
    uint32_t n;
    bool brief;              /* no two coordinates are 2^31 apart: a turn fits 64 bits */
    sunder_i_point at[MOST]; /* in units of the lowest bit */
    int8_t turn[MOST];       /* the side that the ring turns to at each corner */
} ring;

typedef struct mesh {
    uint32_t halves;
    uint8_t origin[HALVES], twin[HALVES], next[HALVES], prev[HALVES]; /* as in sunder_i_mesh */
} mesh;

static inline int turn_of(const ring *r, sunder_i_point u, sunder_i_point v)
{
    if (!r->brief) return sunder_i_det_sign(sunder_i_narrow_cross(u, v));
    const int64_t cross = u.x * v.y - u.y * v.x;
    return (cross > 0) - (cross < 0);
}

static inline int orient(const ring *r, uint32_t a, uint32_t b, uint32_t c)
{
    return turn_of(r, sunder_i_narrow_sub(r->at[b], r->at[a]), sunder_i_narrow_sub(r->at[c], r->at[a]));
}

/* ---- Is it sound? ---- */

/* The corners as integers: below 2^60, so that a turn is a matter of native integers. */
static bool place(ring *r, const double *xy, const sunder_i_extent *extent)
{
    const int bit = extent->low_bit;
    if (bit < -900 || bit > 900) return false;
    const double limit = sunder_i_power_of_two(bit + SUNDER_I_NARROW_BITS), scale = sunder_i_power_of_two(-bit);
    for (int k = 0; k < 2; k++)
        if (!(extent->low[k] > -limit && extent->high[k] < limit)) return false;
    const double apart = sunder_i_power_of_two(bit + 31);
    r->brief = extent->high[0] - extent->low[0] < apart && extent->high[1] - extent->low[1] < apart;
    for (uint32_t i = 0; i < r->n; i++)
        r->at[i] = (sunder_i_point){(int64_t)(xy[2 * i] * scale), (int64_t)(xy[2 * i + 1] * scale)};
    return true;
}

static bool turns_everywhere(ring *r)
{
    sunder_i_point before = sunder_i_narrow_sub(r->at[0], r->at[r->n - 1]);
    for (uint32_t i = 0; i < r->n; i++) {
        const sunder_i_point after = sunder_i_narrow_sub(r->at[i + 1 < r->n ? i + 1 : 0], r->at[i]);
        r->turn[i] = (int8_t)turn_of(r, before, after);
        if (r->turn[i] == 0) return false;
        before = after;
    }
    return true;
}

/* Do edges e and f, which do not follow each other, certainly have nothing in common? Edges on one line count as
 * meeting, too: if they are apart their boxes are, and they are not asked for. */
static bool apart(const ring *r, uint32_t e, uint32_t f)
{
    const uint32_t b = e + 1, h = f + 1 < r->n ? f + 1 : 0;
    return orient(r, e, b, f) * orient(r, e, b, h) > 0 || orient(r, f, h, e) * orient(r, f, h, b) > 0;
}

static bool is_simple(const ring *r)
{
    int64_t low_x[MOST], low_y[MOST], high_x[MOST], high_y[MOST];
    for (uint32_t e = 0; e < r->n; e++) {
        const sunder_i_point a = r->at[e], b = r->at[e + 1 < r->n ? e + 1 : 0];
        low_x[e] = a.x < b.x ? a.x : b.x;
        high_x[e] = a.x < b.x ? b.x : a.x;
        low_y[e] = a.y < b.y ? a.y : b.y;
        high_y[e] = a.y < b.y ? b.y : a.y;
    }
    for (uint32_t e = 0; e + 2 < r->n; e++) {
        const int64_t x0 = low_x[e], x1 = high_x[e], y0 = low_y[e], y1 = high_y[e];
        uint32_t near = 0; /* whose boxes meet: without branches */
        for (uint32_t f = e + 2; f < r->n - (e == 0); f++)
            near |= (uint32_t)((low_x[f] <= x1) & (high_x[f] >= x0) & (low_y[f] <= y1) & (high_y[f] >= y0)) << f;
        for (; near; near &= near - 1)
            if (!apart(r, e, (uint32_t)__builtin_ctz(near))) return false;
    }
    return true;
}

static bool is_clockwise(const ring *r)
{
    uint32_t lowest = 0;
    for (uint32_t i = 1; i < r->n; i++)
        if (r->at[i].y < r->at[lowest].y) lowest = i;
    /* Of several any: all of these are on the hull. */
    return r->turn[lowest] < 0;
}

static void reverse(ring *r)
{
    for (uint32_t i = 0, j = r->n - 1; i < j; i++, j--) {
        const sunder_i_point at = r->at[i];
        r->at[i] = r->at[j];
        r->at[j] = at;
        const int8_t turn = r->turn[i];
        r->turn[i] = r->turn[j];
        r->turn[j] = turn;
    }
    for (uint32_t i = 0; i < r->n; i++) r->turn[i] = (int8_t)-r->turn[i];
}

/* ---- Ears, as in ears.c ---- */

typedef struct cutter {
    const ring *r;
    mesh *m;
    uint8_t next[MOST], prev[MOST], beyond[MOST];
    uint32_t blunt,
        stamped; /* sets of corners: those that are not convex; those whose neighbour was cut in this round */
    uint8_t turn[2][2 * MOST];
    uint32_t turn_n;
    uint8_t *now, *later;
} cutter;

/* Does no blunt corner lie in the open triangle, or inside its side ca? */
static bool is_ear(const cutter *c, uint32_t b)
{
    const uint32_t a = c->prev[b], d = c->next[b];
    for (uint32_t left = c->blunt & ~(1u << a | 1u << d); left; left &= left - 1) {
        const uint32_t v = (uint32_t)__builtin_ctz(left);
        if (orient(c->r, d, a, v) >= 0 && orient(c->r, a, b, v) > 0 && orient(c->r, b, d, v) > 0) return false;
    }
    return true;
}

static void link_side(cutter *c, uint32_t h, uint32_t node)
{
    const uint8_t beyond = c->beyond[node];
    c->m->twin[h] = beyond;
    if (beyond != NONE) c->m->twin[beyond] = (uint8_t)h;
}

static uint32_t add_triangle(cutter *c, uint32_t b)
{
    mesh *m = c->m;
    const uint32_t h = m->halves;
    m->origin[h] = c->prev[b];
    m->origin[h + 1] = (uint8_t)b;
    m->origin[h + 2] = c->next[b];
    m->next[h] = m->prev[h + 2] = (uint8_t)(h + 1);
    m->next[h + 1] = m->prev[h] = (uint8_t)(h + 2);
    m->next[h + 2] = m->prev[h + 1] = (uint8_t)h;
    m->halves += 3;
    link_side(c, h, c->prev[b]);
    link_side(c, h + 1, b);
    return h;
}

static void refresh(cutter *c, uint32_t node)
{
    c->stamped |= 1u << node;
    if (!(c->blunt >> node & 1) || orient(c->r, c->prev[node], node, c->next[node]) <= 0) return;
    c->blunt &= ~(1u << node);
    c->later[c->turn_n++] = (uint8_t)node;
}

static void cut(cutter *c, uint32_t b)
{
    const uint8_t a = c->prev[b], d = c->next[b];
    const uint32_t h = add_triangle(c, b);
    c->beyond[a] = (uint8_t)(h + 2);
    c->m->twin[h + 2] = NONE;
    c->next[a] = d;
    c->prev[d] = a;
    refresh(c, a);
    refresh(c, d);
}

static void cut_all(cutter *c)
{
    uint32_t left = c->r->n, last = 0;
    while (left > 3) {
        const uint32_t n = c->turn_n;
        uint8_t *const now = c->later;
        c->later = c->now;
        c->now = now;
        c->turn_n = c->stamped = 0;
        for (uint32_t i = 0; i < n; i++) {
            const uint8_t node = now[i];
            if (left > 3 && !(c->stamped >> node & 1) && is_ear(c, node)) {
                last = c->prev[node];
                cut(c, node);
                left--;
            } else {
                c->later[c->turn_n++] = node;
            }
        }
    }
    const uint32_t b = c->next[last], h = add_triangle(c, b);
    link_side(c, h + 2, c->next[b]);
}

static void triangulate(const ring *r, mesh *m)
{
    cutter c = {.r = r, .m = m};
    c.now = c.turn[0];
    c.later = c.turn[1];
    for (uint32_t i = 0; i < r->n; i++) {
        c.next[i] = (uint8_t)(i + 1 < r->n ? i + 1 : 0);
        c.prev[i] = (uint8_t)(i ? i - 1 : r->n - 1);
        c.beyond[i] = NONE;
        if (r->turn[i] > 0)
            c.later[c.turn_n++] = (uint8_t)i;
        else
            c.blunt |= 1u << i;
    }
    cut_all(&c);
}

/* ---- Triangles merged, as in merge_triangles.c, and collected, as in pieces.c ---- */

static bool convex_without(const ring *r, const mesh *m, uint32_t h, uint32_t g)
{
    return orient(r, m->origin[m->prev[h]], m->origin[h], m->origin[m->next[m->next[g]]]) > 0;
}

static void merge(const ring *r, mesh *m)
{
    for (uint32_t h = 0; h < m->halves; h++) {
        const uint8_t g = m->twin[h];
        if (g == NONE || g < h || !convex_without(r, m, h, g) || !convex_without(r, m, g, h)) continue;
        m->next[m->prev[h]] = m->next[g];
        m->prev[m->next[g]] = m->prev[h];
        m->next[m->prev[g]] = m->next[h];
        m->prev[m->next[h]] = m->prev[g];
        m->origin[h] = m->origin[g] = NONE;
    }
}

static void collect(mesh *m, sunder_i_pieces *out)
{
    for (uint32_t h = 0; h < m->halves; h++) {
        if (m->origin[h] == NONE) continue;
        for (uint32_t g = h; m->origin[g] != NONE; g = m->next[g]) {
            out->piece_vertex[out->corners++] = m->origin[g];
            m->origin[g] = NONE;
        }
        out->piece_end[out->pieces++] = out->corners;
    }
}

static void find_pieces(const ring *r, sunder_i_pieces *out)
{
    bool convex = true;
    for (uint32_t i = 0; i < r->n; i++) convex &= r->turn[i] > 0;
    if (convex) {
        for (uint32_t i = 0; i < r->n; i++) out->piece_vertex[out->corners++] = i;
        out->piece_end[out->pieces++] = r->n;
        return;
    }
    mesh m;
    m.halves = 0;
    triangulate(r, &m);
    merge(r, &m);
    collect(&m, out);
}

/* ---- All of it ---- */

bool sunder_i_small_ring(const double *xy, size_t raw, sunder_shape **out)
{
    ring r;
    sunder_i_extent extent = {0};
    *out = NULL;
    if (raw < 3 || raw > MOST + 1) return false;
    const bool closed = xy[0] == xy[2 * raw - 2] && xy[1] == xy[2 * raw - 1];
    r.n = (uint32_t)raw - closed;
    if (r.n < 3 || r.n > MOST) return false;
    sunder_i_extent_add(&extent, xy, raw);
    if (!place(&r, xy, &extent) || !turns_everywhere(&r) || !is_simple(&r)) return false;
    const bool turned = is_clockwise(&r);
    if (turned) reverse(&r);
    uint32_t piece_end[MOST - 2], piece_vertex[HALVES];
    sunder_i_pieces pieces = {.piece_end = piece_end, .piece_vertex = piece_vertex};
    find_pieces(&r, &pieces);
    *out = sunder_i_shape_assemble_small(xy, raw, r.n, turned, &pieces);
    if (*out) sunder_i_shape_measure(*out, &extent);
    return true;
}
