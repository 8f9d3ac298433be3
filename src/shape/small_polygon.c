/* small_polygon.c: the path for the usual building: one polygon with few vertices, valid as given. What the other files
 * of this folder do in general is done here on arrays of fixed size: cleaning (clean_ring.c), testing for crossings
 * (intersections.c), orienting and nesting (nesting.c), joining holes (bridge.c) and decomposing (small_pieces.c). The
 * resulting shape is the same, but nothing is repaired or explained here. A polygon with a repeated or straight vertex,
 * or with two edges that meet, or with a hole in an invalid position or not in order, or whose coordinates are too long
 * for native integers, takes the general path.
 *
 * If no vertex has a turn of zero, nothing needs cleaning. If the edges of a ring meet nowhere else, the turn at its
 * smallest vertex is its orientation, and the ring is convex if all turns are to the left. So each ring is read from
 * that vertex on (canonical_rings.c), in the direction that the turn requires; its validity is tested afterwards. */
#include "shape/small_polygon.h"

#include "shape/few_corners.h"
#include "shape/small_walk.h"
#include "spatial/lanes.h"

#include <string.h>

#define MOST SUNDER_I_SMALL_NODES
#define MOST_RINGS (SUNDER_I_SMALL_BRIDGES + 1)

typedef struct polygon {
    const sunder_i_input *in;
    sunder_i_extent extent; /* of the raw vertices */
    double scale;           /* the unit is the lowest bit of the coordinates */
    uint32_t rings;
    uint32_t ring_end[MOST_RINGS];
    sunder_i_small_ring ring[MOST_RINGS]; /* the position of each canonical ring among the given vertices */
    sunder_i_small_walk w;                /* its nodes are the vertices; with holes, the second ends of bridges
                                           * follow */
} polygon;

/* Returns the number of corners of the raw ring lo .. hi if all its vertices are corners except a closing one. */
static size_t corners_of(const double *xy, size_t lo, size_t hi)
{
    const double *first = xy + 2 * lo, *last = xy + 2 * (hi - 1);
    return hi - lo - (first[0] == last[0] && first[1] == last[1]);
}

/* ---- Reading ---- */

/* Returns whether there are few enough vertices, all of them integers below 2^60 in one unit, so that turns are
 * computed in native integers. Each hole needs two more nodes. */
static bool measure_input(polygon *p)
{
    const sunder_i_input *in = p->in;
    if (in->polygons != 1 || in->rings < 1 || in->rings > MOST_RINGS || in->vertices > MOST + MOST_RINGS) return false;
    size_t n = 2 * (in->rings - 1);
    for (size_t ring = 0, lo = 0; ring < in->rings; lo = in->ring_end[ring++]) {
        if (in->ring_end[ring] < lo + 3) return false;
        const size_t corners = corners_of(in->xy, lo, in->ring_end[ring]);
        if (corners < 3) return false;
        n += corners;
    }
    if (n > MOST) return false;
    p->extent = (sunder_i_extent){0};
    sunder_i_extent_add(&p->extent, in->xy, in->vertices);
    const int bit = p->extent.low_bit;
    if (bit < -900 || bit > 900) return false;
    const double *low = p->extent.low, *high = p->extent.high;
    const double limit = sunder_i_power_of_two(bit + SUNDER_I_NARROW_BITS), apart = sunder_i_power_of_two(bit + 31);
    p->scale = sunder_i_power_of_two(-bit);
    p->w.brief = high[0] - low[0] < apart && high[1] - low[1] < apart;
    return low[0] > -limit && low[1] > -limit && high[0] < limit && high[1] < limit;
}

static inline sunder_i_point point_at(const polygon *p, size_t raw)
{
    const double *xy = p->in->xy + 2 * raw;
    return (sunder_i_point){(int64_t)(xy[0] * p->scale), (int64_t)(xy[1] * p->scale)};
}

/* Adds the left turns of the nodes first .. end of a ring to w->convex. Returns false if a node is straight. */
static bool find_turns(sunder_i_small_walk *w, uint32_t first, uint32_t end)
{
    sunder_i_point before = sunder_i_narrow_sub(w->at[first], w->at[end - 1]);
    uint32_t left = 0, right = 0;
    for (uint32_t i = first; i < end; i++) {
        const sunder_i_point after = sunder_i_narrow_sub(w->at[i + 1 < end ? i + 1 : first], w->at[i]);
        left |= (uint32_t)sunder_i_small_left(w->brief, before, after) << i;
        right |= (uint32_t)!sunder_i_small_not_right(w->brief, before, after) << i;
        before = after;
    }
    w->convex |= left;
    return (left | right) == (uint32_t)(((uint64_t)1 << end) - ((uint64_t)1 << first));
}

/* For any node the next and the previous one along a ring, except at the ring's ends; and the node itself. */
static const uint8_t after[MOST] = {1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 16,
                                    17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32};
static const uint8_t before[MOST] = {0,  0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14,
                                     15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30};
static const uint8_t itself[MOST] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,
                                     16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31};

/* Reads the ring of n vertices from raw vertex lo on into the nodes from `first` on: the outer one counterclockwise,
 * holes clockwise, each from its smallest vertex. Returns false if a vertex is straight. */
static bool read_ring(polygon *p, size_t ring, size_t lo, uint32_t first, uint32_t n)
{
    sunder_i_small_walk *w = &p->w;
    sunder_i_point *at = w->at + first;
    uint32_t least = 0; /* any of several at one position: such a ring is not valid */
    for (uint32_t i = 0; i < n; i++) {
        at[i] = point_at(p, lo + i);
        least = at[i].x < at[least].x || (at[i].x == at[least].x && at[i].y < at[least].y) ? i : least;
    }
    const sunder_i_point b = at[least], a = at[least ? least - 1 : n - 1], c = at[least + 1 < n ? least + 1 : 0];
    const bool left = sunder_i_small_left(w->brief, sunder_i_narrow_sub(b, a), sunder_i_narrow_sub(c, b));
    const sunder_i_small_ring as = p->ring[ring] = (sunder_i_small_ring){least, left == (ring > 0)};
    if (as.turned || as.start)
        for (uint32_t i = 0; i < n; i++) at[i] = point_at(p, lo + sunder_i_small_ring_corner(as, n, i));
    w->next[first + n - 1] = (uint8_t)first;
    w->prev[first] = (uint8_t)(first + n - 1);
    return find_turns(w, first, first + n);
}

/* Returns whether the holes are sorted by their first vertices. */
static bool holes_ascend(const polygon *p)
{
    for (uint32_t hole = 2; hole < p->rings; hole++) {
        const sunder_i_point a = p->w.at[p->ring_end[hole - 2]], b = p->w.at[p->ring_end[hole - 1]];
        if (a.x > b.x || (a.x == b.x && a.y >= b.y)) return false;
    }
    return true;
}

static bool read_rings(polygon *p)
{
    const sunder_i_input *in = p->in;
    sunder_i_small_walk *w = &p->w;
    memcpy(w->next, after, sizeof after);
    memcpy(w->prev, before, sizeof before);
    memset(w->beyond, SUNDER_I_SMALL_NONE, sizeof w->beyond);
    w->vertex = itself;
    w->nodes = w->bridges = w->convex = 0;
    p->rings = (uint32_t)in->rings;
    for (size_t ring = 0, lo = 0; ring < in->rings; lo = in->ring_end[ring++]) {
        const uint32_t n = (uint32_t)corners_of(in->xy, lo, in->ring_end[ring]);
        if (!read_ring(p, ring, lo, w->nodes, n)) return false;
        p->ring_end[ring] = w->nodes += n;
    }
    return holes_ascend(p);
}

/* ---- Validity ---- */

/* Returns whether all nodes turn left. */
static bool turns_left(const sunder_i_small_walk *w) { return w->convex == (uint32_t)(((uint64_t)1 << w->nodes) - 1); }

/* Returns whether both ends of an edge, which are at u and v from the ends of edge e, are strictly on one side of e. */
static inline bool on_one_side(bool brief, sunder_i_point e, sunder_i_point u, sunder_i_point v)
{
    if (brief) {
        const int64_t s = sunder_i_brief_cross(e, u), t = sunder_i_brief_cross(e, v);
        return ((s > 0) & (t > 0)) | ((s < 0) & (t < 0));
    }
    const sunder_i_i128 s = sunder_i_narrow_cross(e, u), t = sunder_i_narrow_cross(e, v);
    return ((s > 0) & (t > 0)) | ((s < 0) & (t < 0));
}

/* Returns whether the edges e and f, which are not consecutive, certainly have no common point. Collinear edges count
 * as meeting: if they are disjoint their boxes are, too, and they are not tested. */
static bool edges_apart(const sunder_i_small_walk *w, uint32_t e, uint32_t f)
{
    const sunder_i_point a = w->at[e], b = w->at[w->next[e]], g = w->at[f], h = w->at[w->next[f]];
    const sunder_i_point ab = sunder_i_narrow_sub(b, a), gh = sunder_i_narrow_sub(h, g);
    const sunder_i_point ag = sunder_i_narrow_sub(g, a), ah = sunder_i_narrow_sub(h, a);
    const sunder_i_point ga = sunder_i_narrow_sub(a, g), gb = sunder_i_narrow_sub(b, g);
    return on_one_side(w->brief, ab, ag, ah) || on_one_side(w->brief, gh, ga, gb);
}

/* The boxes of edges, in 31 bits relative to the lowest corner: longer numbers are truncated, which keeps their order
 * but may make them equal. The boxes after the last edge meet none. */
typedef struct boxes {
    int32_t low_x[MOST + SUNDER_I_LANES], low_y[MOST + SUNDER_I_LANES], high_x[MOST + SUNDER_I_LANES],
        high_y[MOST + SUNDER_I_LANES];
} boxes;

static inline void add_box(boxes *b, uint32_t e, int32_t x, int32_t y, int32_t u, int32_t v)
{
    b->low_x[e] = x < u ? x : u;
    b->high_x[e] = x < u ? u : x;
    b->low_y[e] = y < v ? y : v;
    b->high_y[e] = y < v ? v : y;
}

static void find_boxes(const polygon *p, boxes *b)
{
    const sunder_i_small_walk *w = &p->w;
    const double *low = p->extent.low, *high = p->extent.high;
    const int64_t x0 = (int64_t)(low[0] * p->scale), y0 = (int64_t)(low[1] * p->scale);
    int cut = 0;
    if (!w->brief) {
        const uint64_t wide = (uint64_t)((int64_t)(high[0] * p->scale) - x0),
                       tall = (uint64_t)((int64_t)(high[1] * p->scale) - y0);
        while ((wide | tall) >> cut > INT32_MAX) cut++;
    }
    for (uint32_t ring = 0, e = 0; ring < p->rings; ring++) {
        const uint32_t last = p->ring_end[ring] - 1;
        int32_t x = (int32_t)((w->at[last].x - x0) >> cut), y = (int32_t)((w->at[last].y - y0) >> cut);
        add_box(b, last, x, y, (int32_t)((w->at[e].x - x0) >> cut), (int32_t)((w->at[e].y - y0) >> cut));
        x = (int32_t)((w->at[e].x - x0) >> cut), y = (int32_t)((w->at[e].y - y0) >> cut);
        for (; e < last; e++) {
            const int32_t u = (int32_t)((w->at[e + 1].x - x0) >> cut), v = (int32_t)((w->at[e + 1].y - y0) >> cut);
            add_box(b, e, x, y, u, v);
            x = u, y = v;
        }
        e++;
    }
    for (uint32_t e = w->nodes; e < w->nodes + SUNDER_I_LANES; e++) {
        b->low_x[e] = b->low_y[e] = INT32_MAX;
        b->high_x[e] = b->high_y[e] = INT32_MIN;
    }
}

/* Returns the set of edges f > e, f < n, whose boxes meet that of e. */
static inline uint32_t near_edges(const boxes *b, uint32_t e, uint32_t n)
{
    const int32_t x0 = b->low_x[e], y0 = b->low_y[e], x1 = b->high_x[e], y1 = b->high_y[e];
    uint32_t near = 0;
    for (uint32_t f = e + 1; f < n; f += SUNDER_I_LANES) {
        const sunder_i_signed_lanes meet =
            (sunder_i_signed_lanes_at(b->low_x + f) <= x1) & (sunder_i_signed_lanes_at(b->high_x + f) >= x0) &
            (sunder_i_signed_lanes_at(b->low_y + f) <= y1) & (sunder_i_signed_lanes_at(b->high_y + f) >= y0);
        near |= sunder_i_lanes_set(meet) << f;
    }
    return near;
}

static bool is_simple(const polygon *p)
{
    const sunder_i_small_walk *w = &p->w;
    /* three or four left turns, each of less than half a turn, are one full turn: a convex ring */
    if (w->nodes <= 4 && turns_left(w)) return true;
    boxes b;
    find_boxes(p, &b);
    for (uint32_t e = 0; e + 1 < w->nodes; e++) {
        uint32_t near = near_edges(&b, e, w->nodes) & ~(1u << w->next[e] | 1u << w->prev[e]);
        for (; near; near &= near - 1)
            if (!edges_apart(w, e, (uint32_t)__builtin_ctz(near))) return false;
    }
    return true;
}

/* Returns whether the node, which is on no edge of the ring lo .. hi, is inside it, by a ray to the right at a height
 * just above the node. */
static bool is_inside(const sunder_i_small_walk *w, uint32_t lo, uint32_t hi, uint32_t node)
{
    const int64_t y = w->at[node].y;
    bool inside = false;
    for (uint32_t e = lo; e < hi; e++) {
        const uint32_t f = w->next[e];
        const bool below = w->at[e].y <= y;
        if (below == (w->at[f].y <= y)) continue;
        inside ^= sunder_i_small_turns_left(w, e, f, node) ? below : !below;
    }
    return inside;
}

/* Returns whether the holes are in the outer ring and not in each other. No edges meet, so that one vertex decides for
 * a ring. */
static bool is_nested(const polygon *p)
{
    for (uint32_t hole = 1; hole < p->rings; hole++)
        for (uint32_t ring = 0; ring < p->rings; ring++) {
            const uint32_t lo = ring ? p->ring_end[ring - 1] : 0;
            if (ring != hole && is_inside(&p->w, lo, p->ring_end[ring], p->ring_end[hole - 1]) != (ring == 0))
                return false;
        }
    return true;
}

/* ---- Pieces ---- */

/* The rings in the form of build.h, which other stages need if there are holes, or too many vertices for a shared
 * form. */
typedef struct made_rings {
    sunder_i_rings r;
    sunder_i_lattice lattice;
    sunder_i_point at[MOST];
    double xy[2 * MOST];
    uint32_t next[MOST], prev[MOST], poly_end[1];
    uint8_t vertex[MOST]; /* of the nodes, if there are holes */
} made_rings;

static void make_rings(polygon *p, made_rings *m)
{
    const sunder_i_small_walk *w = &p->w;
    memset(&m->lattice, 0, sizeof m->lattice);
    m->lattice.narrow = m->lattice.small = true;
    m->poly_end[0] = p->rings;
    m->r = (sunder_i_rings){.lattice = &m->lattice,
                            .vertices = p->ring_end[p->rings - 1],
                            .rings = p->rings,
                            .polygons = 1,
                            .at = m->at,
                            .xy = m->xy,
                            .ring_end = p->ring_end,
                            .poly_end = m->poly_end,
                            .next = m->next,
                            .prev = m->prev};
    for (uint32_t ring = 0, v = 0; ring < p->rings; ring++) {
        const size_t lo = ring ? p->in->ring_end[ring - 1] : 0;
        const uint32_t first = v, end = p->ring_end[ring];
        for (; v < end; v++) {
            const size_t raw = lo + sunder_i_small_ring_corner(p->ring[ring], end - first, v - first);
            m->at[v] = w->at[v];
            memcpy(m->xy + 2 * v, p->in->xy + 2 * raw, 2 * sizeof *m->xy);
            m->next[v] = w->next[v];
            m->prev[v] = w->prev[v];
        }
    }
}

/* Joins the holes to the outer ring. Returns false if that failed, which does not happen for valid rings. */
static bool bridge_holes(polygon *p, made_rings *m)
{
    sunder_i_small_walk *w = &p->w;
    uint32_t vertex[MOST], next[MOST], prev[MOST], beyond[MOST];
    sunder_i_walk walk = {w->nodes, vertex, next, prev, beyond};
    sunder_i_arena none = {NULL, false}; /* so few vertices need no memory */
    for (uint32_t i = 0; i < w->nodes; i++) {
        vertex[i] = i;
        next[i] = w->next[i];
        prev[i] = w->prev[i];
        beyond[i] = SUNDER_I_NONE;
    }
    sunder_i_bridge_holes(&m->r, 0, p->rings, &walk, &none);
    if (none.failed) return false;
    w->nodes = walk.nodes;
    w->bridges = p->rings - 1;
    w->vertex = m->vertex;
    w->convex = 0;
    for (uint32_t i = 0; i < w->nodes; i++) {
        m->vertex[i] = (uint8_t)vertex[i];
        w->at[i] = w->at[vertex[i]];
        w->next[i] = (uint8_t)next[i];
        w->prev[i] = (uint8_t)prev[i];
        w->beyond[i] = beyond[i] == SUNDER_I_NONE ? SUNDER_I_SMALL_NONE
                                                  : (uint8_t)(SUNDER_I_SMALL_BRIDGE | (beyond[i] & ~SUNDER_I_BRIDGE));
    }
    for (uint32_t i = 0; i < w->nodes; i++)
        w->convex |= (uint32_t)sunder_i_small_turns_left(w, w->prev[i], i, w->next[i]) << i;
    return true;
}

static void find_pieces(sunder_i_small_walk *w, sunder_i_pieces *out)
{
    if (!turns_left(w)) {
        sunder_i_small_pieces(w, out);
        return;
    }
    for (uint32_t i = 0; i < w->nodes; i++) out->piece_vertex[i] = i;
    out->corners = out->piece_end[0] = w->nodes;
    out->pieces = 1;
}

/* ---- All steps ---- */

static sunder_shape *assemble_shape(polygon *p, made_rings *m)
{
    uint32_t piece_end[MOST - 2], piece_vertex[SUNDER_I_SMALL_HALVES];
    sunder_i_pieces pieces = {.piece_end = piece_end, .piece_vertex = piece_vertex};
    find_pieces(&p->w, &pieces);
    const sunder_i_input *in = p->in;
    sunder_shape *s = m ? sunder_i_shape_assemble(in->xy, in->ring_end, in->poly_end, 1, &m->r, &pieces)
                        : sunder_i_shape_assemble_small(in->xy, in->vertices, p->ring_end[0], p->ring[0], &pieces);
    if (!s) return NULL;
    sunder_i_shape_measure(s, &p->extent);
    if (m) sunder_i_shape_mark_none_shared(s);
    return s;
}

bool sunder_i_small_polygon(const sunder_i_input *in, sunder_shape **out)
{
    polygon p;
    p.in = in;
    if (!measure_input(&p) || !read_rings(&p) || !is_simple(&p)) return false;
    if (p.rings == 1 && p.w.nodes <= SUNDER_I_FEW_CORNERS) {
        *out = assemble_shape(&p, NULL);
        return true;
    }
    made_rings m;
    make_rings(&p, &m);
    if (p.rings > 1 && (!is_nested(&p) || !bridge_holes(&p, &m))) return false;
    *out = assemble_shape(&p, &m);
    return true;
}
