/* visibility.c: which nodes may be visible from a node. The parts around the node hide directions (shadow.h), near
 * parts first; then the nodes are tested, and those that are certainly hidden, or farther than the maximal length that
 * is left, are skipped. Parts and nodes are in trees of boxes along a space-filling curve, so that whole boxes that are
 * hidden or too far are skipped at once.
 *
 * A shortest path that reaches a corner along a leg continues between the direction of that leg and the side of the
 * obstacle around which it bends; in any other direction a shorter path would exist. So only a sector of directions,
 * usually a small one, is tested. If doubles do not decide which sector, all directions are tested. */
#include "motion/visibility.h"

#include "base/extremes.h"
#include "base/invariant.h"
#include "spatial/curve.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The number of nodes in a leaf of their tree: with more the tree is smaller, but more nodes are tested one by one. */
#define LEAF_NODES 8
/* The largest relative error of a coordinate relative to the start: half a unit in the last place, and a division. */
#define OFF 0x1p-51

/* ---- Coordinates relative to the start ---- */

/* Returns (x / w - origin) / 2^shift as a double, where shift is the lattice's approx_shift. */
static double from_origin(sunder_i_lattice *l, sunder_i_big x, sunder_i_big w, sunder_i_big origin)
{
    sunder_i_arena *m = &l->arena;
    const sunder_i_mark mark = sunder_i_arena_mark(m);
    const double d = sunder_i_big_ratio(m, sunder_i_big_sub(m, x, sunder_i_big_mul(m, origin, w)), w, -l->approx_shift);
    if (!m->failed) sunder_i_arena_release(m, mark);
    return d;
}

static void take_places(sunder_i_visibility *view, const sunder_i_big origin[2])
{
    const sunder_i_corners *c = view->corners;
    sunder_i_lattice *l = view->space->filter.lattice;
    for (uint32_t v = 0; v < c->vertices + 2; v++) {
        view->at[v][0] = from_origin(l, c->place[v].at.x, c->place[v].at.w, origin[0]);
        view->at[v][1] = from_origin(l, c->place[v].at.y, c->place[v].at.w, origin[1]);
    }
}

static void take_corners(sunder_i_visibility *view, const sunder_i_big origin[2])
{
    const sunder_i_convex_pieces *part = &view->space->part;
    sunder_i_lattice *l = view->space->filter.lattice;
    int64_t o[2];
    /* Native integers are used if they cannot overflow: plain coordinates are below 2^61. */
    const bool native = l->approx_shift == 0 && sunder_i_big_fits_i64(origin[0], &o[0]) &&
                        sunder_i_big_fits_i64(origin[1], &o[1]) && sunder_i_big_bits(origin[0]) < 62 &&
                        sunder_i_big_bits(origin[1]) < 62;
    for (uint32_t i = 0; i < part->corners; i++) {
        const int64_t at[2] = {part->corner[i].x, part->corner[i].y};
        for (int k = 0; k < 2; k++) {
            if (native && sunder_i_is_plain(at[k])) {
                view->corner[i][k] = (double)(at[k] - o[k]);
                continue;
            }
            const sunder_i_mark mark = sunder_i_lattice_begin(l);
            const sunder_i_ratio n = sunder_i_lattice_read(&l->scratch, l, at[k]);
            view->corner[i][k] = from_origin(l, n.num, n.den, origin[k]);
            sunder_i_lattice_end(l, mark);
        }
    }
}

/* ---- The tree of nodes ---- */

static void add_node(const void *of, size_t i, double box[4])
{
    const sunder_i_visibility *view = of;
    sunder_i_box_include(box, view->at[view->corners->node[view->order[i]]]);
}

static bool build_tree(sunder_i_visibility *view)
{
    sunder_i_arena arena = {0};
    for (uint32_t i = 0; i < view->nodes; i++) view->order[i] = i;
    sunder_i_curve_sort(view->at[0], view->corners->node, view->order, view->nodes, &arena);
    const bool ok = !arena.failed;
    sunder_i_arena_free(&arena);
    if (ok) sunder_i_box_tree_fill(&view->tree, add_node, view);
    return ok;
}

bool sunder_i_visibility_init(sunder_i_visibility *view, const sunder_i_free_space *space,
                              const sunder_i_corners *corners)
{
    memset(view, 0, sizeof *view);
    view->space = space;
    view->corners = corners;
    view->nodes = corners->nodes;
    view->tree = sunder_i_box_tree_of(view->nodes, LEAF_NODES);
    view->at = sunder_i_alloc((size_t)corners->vertices + 2, sizeof *view->at);
    view->corner = sunder_i_alloc(space->part.corners, sizeof *view->corner);
    view->order = sunder_i_alloc(view->nodes, sizeof *view->order);
    view->seen = sunder_i_alloc(view->nodes, sizeof *view->seen);
    view->tree.box = sunder_i_alloc(2 * view->tree.leaves, sizeof *view->tree.box);
    if (!view->at || !view->corner || !view->order || !view->seen || !view->tree.box) return false;
    sunder_i_lattice *l = space->filter.lattice;
    sunder_i_arena *m = &l->arena;
    const sunder_i_filtered_point *start = &corners->place[corners->vertices];
    const sunder_i_big one = sunder_i_big_i64(m, 1);
    const sunder_i_big origin[2] = {sunder_i_big_div_floor(m, start->at.x, start->at.w),
                                    sunder_i_big_div_floor(m, start->at.y, start->at.w)};
    for (int k = 0; k < 2; k++) view->from[k] = sunder_i_big_ratio(m, origin[k], one, -l->approx_shift);
    if (m->failed) return false;
    take_places(view, origin);
    take_corners(view, origin);
    return !m->failed && build_tree(view);
}

void sunder_i_visibility_free(sunder_i_visibility *view)
{
    sunder_i_free_all(view->at, view->corner, view->order, view->seen, view->tree.box);
    memset(view, 0, sizeof *view);
}

static const double *node_at(const sunder_i_visibility *view, uint32_t node)
{
    return view->at[view->corners->node[node]];
}

double sunder_i_visibility_distance(const sunder_i_visibility *view, uint32_t a, uint32_t b)
{
    const double *p = node_at(view, a), *q = node_at(view, b);
    return hypot(p[0] - q[0], p[1] - q[1]);
}

/* ---- Directions to test ---- */

static double size_of(const double p[2]) { return fabs(p[0]) + fabs(p[1]); }

/* Returns a bound of the error of the coordinates of a position of this size, including rounded differences and numbers
 * below the normal range. */
static double off_of(double size) { return 2 * OFF * size + DBL_MIN; }

/* Returns the side of c with respect to the line ab if doubles decide it, else 0. The error bound is derived as in
 * filtered_point.c. */
static int clear_side(const double a[2], const double b[2], const double c[2])
{
    const double px = b[0] - a[0], py = b[1] - a[1], qx = c[0] - a[0], qy = c[1] - a[1];
    const double size = fabs(px) + fabs(py) + fabs(qx) + fabs(qy);
    const double f = 2 * OFF * (size_of(a) + size_of(b) + size_of(c)) + DBL_EPSILON * size;
    const double det = px * qy - py * qx;
    const double bound = 2 * f * (size + f) + 4 * DBL_EPSILON * (fabs(px * qy) + fabs(py * qx)) + DBL_MIN;
    return det > bound ? 1 : det < -bound ? -1 : 0;
}

/* *out becomes a sector that certainly contains the direction of the leg pq. Returns false if there is no certain
 * one. */
static bool leg_span(const double p[2], const double q[2], sunder_i_sector *out)
{
    const double d[1][2] = {{q[0] - p[0], q[1] - p[1]}};
    return sunder_i_sector_of(d, 1, off_of(size_of(p)) + off_of(size_of(q)), false, out);
}

/* Returns the directions in which a shortest path that reaches v from `before` can continue. At a plain corner a path
 * bends only around O: with O on its left it continues between the direction of the last leg and the side of O that
 * leaves v, and with O on its right likewise. Returns all directions if doubles do not decide. */
static sunder_i_sector directions_from(const sunder_i_visibility *view, uint32_t v, uint32_t before)
{
    const sunder_i_sector all = {0, 4};
    const uint32_t place = view->corners->node[v], *beside = view->corners->beside[place];
    if (before == SUNDER_I_NO_NODE || beside[0] == SUNDER_I_NO_PLACE) return all;
    const double *u = node_at(view, before), *at = view->at[place];
    const int a = clear_side(u, at, view->at[beside[0]]), b = clear_side(u, at, view->at[beside[1]]);
    sunder_i_sector on, along;
    if (a + b == 0 || !leg_span(u, at, &on)) return all;
    const bool left = a + b > 0;
    if (!leg_span(at, view->at[beside[left ? 1 : 0]], &along)) return all;
    const sunder_i_sector *low = left ? &on : &along, *high = left ? &along : &on;
    double width = sunder_i_turn_between(low->low, high->low + high->width);
    /* The sector is at most half of all directions, so that a value above 3 (of 4) is a negative one near 0: the two
     * directions are equal up to errors. */
    if (width > 3) width = low->width + high->width;
    return width < 2.5 ? (sunder_i_sector){low->low, width} : all;
}

/* ---- Search ---- */

typedef struct look {
    sunder_i_visibility *view;
    const double *eye, *goal;
    double error; /* the error of the eye's coordinates */
    double room;  /* the largest length of a path from the eye to the goal, rounded up */
} look;

/* Returns a lower bound of the distance |dx| + |dy| of a box from the eye; the box is relative to the eye. */
static double gap_of(const double box[4])
{
    return sunder_i_max(0, sunder_i_max(box[0], -box[2])) + sunder_i_max(0, sunder_i_max(box[1], -box[3]));
}

static double box_distance(const double box[4], const double p[2])
{
    return hypot(sunder_i_max(0, sunder_i_max(box[0] - p[0], p[0] - box[2])),
                 sunder_i_max(0, sunder_i_max(box[1] - p[1], p[1] - box[3])));
}

/* *out becomes the box, which is relative to the start, relative to the eye, and widened by the error of the eye. */
static void near_box(const look *k, const double box[4], double out[4])
{
    for (int axis = 0; axis < 2; axis++) {
        out[axis] = box[axis] - k->eye[axis] - k->error;
        out[axis + 2] = box[axis + 2] - k->eye[axis] + k->error;
    }
}

/* Returns true if the content of a box need not be tested: it is empty, too far for a path of length `room`, hidden, or
 * (`casts`: for parts that hide others) too narrow to hide anything. */
static bool is_out(const look *k, const double box[4], bool casts)
{
    if (!(box[0] <= box[2])) return true; /* the box is empty */
    if (isfinite(k->room) && box_distance(box, k->eye) + box_distance(box, k->goal) > k->room) return true;
    double near[4];
    near_box(k, box, near);
    const double gap = gap_of(near);
    const double corner[4][2] = {{near[0], near[1]}, {near[2], near[1]}, {near[2], near[3]}, {near[0], near[3]}};
    sunder_i_sector sector;
    if (gap <= 0 || !sunder_i_sector_of(corner, 4, OFF * gap, false, &sector)) return false;
    return (casts && !sunder_i_shadow_takes(&k->view->shadow, sector)) ||
           sunder_i_shadow_hides(&k->view->shadow, sector, gap);
}

static void cast_part(look *k, uint32_t part)
{
    const sunder_i_convex_pieces *c = &k->view->space->part;
    const uint32_t first = sunder_i_convex_pieces_first(c, part), n = c->end[part] - first;
    double corner[SUNDER_I_CAST_CORNERS][2], size = 0;
    const uint32_t m = n < SUNDER_I_CAST_CORNERS ? n : SUNDER_I_CAST_CORNERS;
    for (uint32_t i = 0; i < m; i++) {
        const double *at = k->view->corner[first + (uint32_t)((uint64_t)i * n / m)];
        size = sunder_i_max(size, size_of(at));
        for (int axis = 0; axis < 2; axis++) corner[i][axis] = at[axis] - k->eye[axis];
    }
    if (m >= 3) sunder_i_shadow_cast(&k->view->shadow, (const double(*)[2])corner, (int)m, off_of(size) + k->error);
}

/* *out becomes box i of the tree of parts relative to the start, widened by the error of its doubles. */
static void part_box(const look *k, size_t i, double out[4])
{
    const sunder_i_free_space *s = k->view->space;
    for (int axis = 0; axis < 2; axis++) {
        const double from = k->view->from[axis], off = 4 * s->filter.error;
        out[axis] = s->tree.boxes.box[i][axis] - from - off;
        out[axis + 2] = s->tree.boxes.box[i][axis + 2] - from + off;
    }
}

/* Returns a lower bound of the distance of box i of the tree of parts from the eye. */
static double part_gap(const look *k, size_t i)
{
    double box[4], near[4];
    part_box(k, i, box);
    near_box(k, box, near);
    return gap_of(near);
}

/* Adds the shadows of all parts, near ones first as far as the tree allows: then most far parts are hidden when they
 * are tested. */
static void cast_shadows(look *k)
{
    const sunder_i_part_tree *parts = &k->view->space->tree;
    const sunder_i_box_tree *t = &parts->boxes;
    sunder_i_box_walk walk;
    sunder_i_box_walk_start(&walk, t);
    for (size_t i; sunder_i_box_walk_next(&walk, &i);) {
        double box[4];
        part_box(k, i, box);
        if (is_out(k, box, true)) continue;
        if (i < t->leaves) {
            const bool left_first = part_gap(k, 2 * i) <= part_gap(k, 2 * i + 1);
            sunder_i_box_walk_open(&walk, 2 * i + !left_first, 2 * i + left_first);
            continue;
        }
        const size_t end = sunder_i_box_tree_end(t, i);
        for (size_t p = sunder_i_box_tree_first(t, i); p < end; p++) cast_part(k, parts->part[p]);
    }
}

static void see_node(look *k, uint32_t v, uint32_t w)
{
    sunder_i_visibility *view = k->view;
    const double *at = node_at(view, w), d[1][2] = {{at[0] - k->eye[0], at[1] - k->eye[1]}};
    const double error = off_of(size_of(at)) + k->error;
    sunder_i_sector sector;
    if (w == v || w == view->nodes - 2) return; /* v itself, and the start */
    if (sunder_i_sector_of(d, 1, error, false, &sector) &&
        sunder_i_shadow_hides(&view->shadow, sector, size_of(d[0]) - 2 * error))
        return;
    SUNDER_I_ASSERT(view->seen_n < view->nodes);
    view->seen[view->seen_n++] = w;
}

static void see_nodes(look *k, uint32_t v)
{
    const sunder_i_visibility *view = k->view;
    const sunder_i_box_tree *t = &view->tree;
    sunder_i_box_walk walk;
    sunder_i_box_walk_start(&walk, t);
    for (size_t i; sunder_i_box_walk_next(&walk, &i);) {
        if (is_out(k, t->box[i], false)) continue;
        if (i < t->leaves) {
            sunder_i_box_walk_open(&walk, 2 * i, 2 * i + 1);
            continue;
        }
        const size_t end = sunder_i_box_tree_end(t, i);
        for (size_t p = sunder_i_box_tree_first(t, i); p < end; p++) see_node(k, v, view->order[p]);
    }
}

/* Returns true if a path along vw could be shortened at the plain corner w whatever its next leg is: the line vw
 * separates the two neighbours of w. */
static bool bends_in_vain(const sunder_i_visibility *view, uint32_t v, uint32_t w)
{
    const uint32_t place = view->corners->node[w], *beside = view->corners->beside[place];
    if (beside[0] == SUNDER_I_NO_PLACE) return false;
    const double *a = node_at(view, v), *b = view->at[place];
    return clear_side(a, b, view->at[beside[0]]) * clear_side(a, b, view->at[beside[1]]) < 0;
}

void sunder_i_visibility_look(sunder_i_visibility *view, uint32_t v, uint32_t before, double room)
{
    const double *eye = node_at(view, v);
    look k = {view, eye, node_at(view, (uint32_t)view->nodes - 1), off_of(size_of(eye)), room};
    /* Distances have an error of about 2^-49 of their sum, which is at most `room`, and of the eye's coordinates. */
    k.room += 0x1p-46 * (room + size_of(eye) + size_of(k.goal));
    view->seen_n = 0;
    sunder_i_shadow_start(&view->shadow, directions_from(view, v, before));
    cast_shadows(&k);
    see_nodes(&k, v);
    size_t n = 0;
    for (size_t i = 0; i < view->seen_n; i++)
        if (!bends_in_vain(view, v, view->seen[i])) view->seen[n++] = view->seen[i];
    view->seen_n = n;
}
