/* erode_outline.c: an erosion by the stages of ../outline/, if all vertices are integers that fit a narrow lattice.
 *
 * Let P be the figure, and C the convex piece that is added to its complement (-B, if P is eroded by B). The bands
 * (dilate_erode.c) are the sums of P's sides and C: convex parts, whose outline is computed line by line. Among their
 * sides the candidates are those of the reduced convolution of P's complement and C: each side of P translated by the
 * vertex of C that is extreme towards P, and at each reflex vertex v of P those sides of v + C whose directions are
 * within the complement's angle (closed intervals, as in ../convex/subsums.c).
 *
 * Let x be a point of a candidate that no band covers. x - int C is connected and meets no side of P, so that it is
 * either inside P, and x in the erosion, or outside. This does not change from x to the next such point, so that one
 * test suffices for all stretches that are connected. Usually it is inside, since near a point of P that x - C touches,
 * it is on P's side. But the end of a translated side may touch a vertex of P from outside, and more points may if a
 * vertex is on a side. The erosion is on that side of each stretch that no band covers.
 *
 * Nothing is missed: a point on the boundary of the complement's sum is on a candidate, by the definition of the
 * reduced convolution, and no band covers it. (If two chains of P have a vertex in common, the complement's angles are
 * not those of one chain: such figures are left to the map.) */
#include "morphology/morphology.h"

#include "base/extremes.h"
#include "base/union_find.h"
#include "base/watch.h"
#include "convex/merge.h"
#include "convex/pieces.h"
#include "outline/contained_parts.h"
#include "outline/outline.h"
#include "predicate/rational_point.h"
#include "spatial/strips.h"

#include <math.h>

/* Sums of two coordinates with at most this number of bits fit a narrow lattice. */
enum { MOST_BITS = SUNDER_I_NARROW_BITS - 2 };

typedef struct eroder {
    const sunder_i_figure *figure;
    const sunder_i_structuring_element *element;
    sunder_i_convex_pieces side, piece; /* the sides of the figure, each as a segment; the only piece of the element */
    uint32_t *before;                   /* [sides] the side that ends where each side begins */
} eroder;

static bool as_integers(sunder_i_rational_point u, sunder_i_point *out)
{
    return sunder_i_big_is_one(u.w) && sunder_i_big_bits(u.x) <= MOST_BITS && sunder_i_big_bits(u.y) <= MOST_BITS &&
           sunder_i_big_fits_i64(u.x, &out->x) && sunder_i_big_fits_i64(u.y, &out->y);
}

/* Lists the sides of the figure. Returns false if a vertex has no such integer coordinates. */
static bool list_sides(eroder *e)
{
    const sunder_i_figure *f = e->figure;
    for (size_t r = 0, i = 0; r < f->rings; r++)
        for (const size_t first = i; i < f->ring_end[r]; i++) {
            const bool last = i + 1 == f->ring_end[r];
            sunder_i_point a, b;
            if (!as_integers(f->at[f->ring[i]], &a) || !as_integers(f->at[f->ring[last ? first : i + 1]], &b))
                return false;
            e->before[last ? first : i + 1] = (uint32_t)i;
            sunder_i_convex_pieces_add_corner(&e->side, a, true);
            sunder_i_convex_pieces_add_corner(&e->side, b, true);
            e->side.end[e->side.n++] = e->side.corners;
        }
    return true;
}

static bool list_piece(eroder *e)
{
    for (size_t k = 0; k < e->element->end[0]; k++) {
        sunder_i_point at;
        if (!as_integers(e->element->corner[k], &at)) return false;
        sunder_i_convex_pieces_add_corner(&e->piece, at, true);
    }
    e->piece.end[e->piece.n++] = e->piece.corners;
    return true;
}

/* ---- Bands ---- */

/* Returns the rank of a side of the figure in the direction of its ring: a ranked segment begins with its lesser rank,
 * and its corners are reversed accordingly. */
static uint32_t rank_along(const eroder *e, const uint32_t *start, uint32_t i)
{
    return e->side.rank[2 * i + start[i]];
}

static uint32_t opposite_rank(uint32_t rank, uint32_t classes)
{
    return rank < classes ? rank + classes : rank - classes;
}

/* Returns whether the complement's exterior angle, at the end of side `in` and the beginning of side `out`, contains
 * the rank r. The complement's own sides have the opposite direction. */
static bool angle_holds(uint32_t in, uint32_t out, uint32_t r, uint32_t classes)
{
    const uint32_t full = 2 * classes, from = opposite_rank(out, classes), to = opposite_rank(in, classes);
    const uint32_t turn = to >= from ? to - from : to + full - from;
    const uint32_t step = r >= from ? r - from : r + full - from;
    return turn < classes && step <= turn;
}

/* Sets start[] to which of the two corners of each listed segment is the beginning of its side, since ranking may have
 * reversed it. */
static bool find_starts(const eroder *e, const sunder_i_point *begin, uint32_t *start)
{
    for (uint32_t i = 0; i < e->side.n; i++) {
        const sunder_i_point at = e->side.corner[2 * i];
        start[i] = at.x != begin[i].x || at.y != begin[i].y;
    }
    return sunder_i_steps(e->side.n);
}

static void add_band(const eroder *e, const uint32_t *start, const uint32_t *after, uint32_t i,
                     sunder_i_convex_pieces *out)
{
    const sunder_i_convex_pieces *a = &e->side, *b = &e->piece;
    const uint32_t along = rank_along(e, start, i), back = opposite_rank(along, out->classes);
    const uint32_t in = rank_along(e, start, e->before[i]), next = rank_along(e, start, after[i]);
    sunder_i_merge m = sunder_i_merge_of(2, b->corners);
    while (SUNDER_I_MERGE_NEXT(&m, sunder_i_rank_cmp(a->rank[2 * i + m.next_a], b->rank[m.next_b]))) {
        const sunder_i_point u = a->corner[2 * i + m.a], v = b->corner[m.b];
        const uint32_t rank = m.of_a ? a->rank[2 * i + m.a] : b->rank[m.b];
        const bool candidate = m.of_a            ? rank == back
                               : m.a == start[i] ? angle_holds(in, along, rank, out->classes)
                                                 : angle_holds(along, next, rank, out->classes);
        out->rank[out->corners] = rank;
        sunder_i_convex_pieces_add_corner(out, (sunder_i_point){u.x + v.x, u.y + v.y}, candidate);
    }
    out->end[out->n++] = out->corners;
}

static bool add_bands(const eroder *e, const sunder_i_point *begin, sunder_i_convex_pieces *out)
{
    const uint32_t n = e->side.n;
    uint32_t *start = sunder_i_alloc(n, sizeof *start), *after = sunder_i_alloc(n, sizeof *after);
    bool ok =
        start && after && sunder_i_convex_pieces_init_sum(&e->side, &e->piece, out) && find_starts(e, begin, start);
    for (uint32_t i = 0; ok && i < n; i++) after[e->before[i]] = i;
    for (uint32_t i = 0; ok && i < n; i++) add_band(e, start, after, i, out);
    sunder_i_free_all(start, after);
    return ok;
}

/* ---- Inside or outside ---- */

/* The sides of the figure by height, for point location. */
typedef struct locator {
    const eroder *e;
    sunder_i_lattice *lattice;
    sunder_i_strips strips;
} locator;

/* Returns a bound of the error of heights; those of points that are not integers have an error of some ulps. */
static double margin(double y) { return fabs(y) * 0x1p-47 + 1; }

static bool locator_init(locator *l, const eroder *e, sunder_i_lattice *lattice)
{
    *l = (locator){.e = e, .lattice = lattice};
    double(*span)[2] = sunder_i_alloc(e->side.n, sizeof *span);
    for (uint32_t i = 0; span && i < e->side.n; i++) {
        const double y[2] = {(double)e->side.corner[2 * i].y, (double)e->side.corner[2 * i + 1].y};
        span[i][0] = sunder_i_min(y[0], y[1]) - margin(sunder_i_max(fabs(y[0]), fabs(y[1])));
        span[i][1] = sunder_i_max(y[0], y[1]) + margin(sunder_i_max(fabs(y[0]), fabs(y[1])));
    }
    const bool ok = span && sunder_i_strips_build(&l->strips, (const double(*)[2])span, e->side.n, e->side.n);
    sunder_i_free(span);
    return ok;
}

/* Returns whether the point p, which is on no side, is inside the figure. A ray to the left crosses the sides on its
 * left that have exactly one end above it. */
static bool is_inside(locator *l, const sunder_i_hpoint *p)
{
    bool odd = false;
    size_t from, to;
    sunder_i_strips_at(&l->strips, p->ay, &from, &to);
    for (; from < to; from++) {
        const sunder_i_point *at = l->e->side.corner + 2 * (size_t)l->strips.item[from];
        const sunder_i_hpoint a = sunder_i_hpoint_of(l->lattice, at[0]), b = sunder_i_hpoint_of(l->lattice, at[1]);
        const bool up = sunder_i_hpoint_cmp_y(l->lattice, &b, p) > 0;
        if (up == (sunder_i_hpoint_cmp_y(l->lattice, &a, p) > 0)) continue;
        const int side = sunder_i_orient_hpoint(l->lattice, at[0], at[1], p);
        if (up ? side < 0 : side > 0) odd = !odd;
    }
    return odd;
}

/* Returns whether the element, rotated by half a turn and translated by x, is inside the figure; its interior meets no
 * side. */
static bool fits_at(locator *l, const sunder_i_hpoint *x)
{
    const sunder_i_mark mark = sunder_i_lattice_begin(l->lattice);
    sunder_i_arena *scratch = &l->lattice->scratch;
    const sunder_i_rational_point at =
        sunder_i_rational_sub(scratch, sunder_i_hpoint_read(scratch, l->lattice, x), l->e->element->inner[0]);
    const sunder_i_hpoint p = sunder_i_hpoint_make(l->lattice, at);
    sunder_i_lattice_end(l->lattice, mark);
    return !l->lattice->arena.failed && is_inside(l, &p); /* if out of memory the point is invalid */
}

/* Returns a union-find structure of the vertices, joined by stretches; NULL if out of memory. */
static uint32_t *join_stretches(const sunder_i_coverage *c)
{
    uint32_t *parent = sunder_i_alloc(c->vertices.n, sizeof *parent);
    if (!parent) return NULL;
    sunder_i_union_init(parent, c->vertices.n);
    for (size_t i = 0; i < c->stretches; i++) sunder_i_union_join(parent, c->stretch[i].from, c->stretch[i].to);
    return parent;
}

/* Keeps the uncovered vertices and stretches that are inside; number[v] becomes 0 for a vertex that is not kept, else
 * one more than its new number. */
static void keep_inside(sunder_i_coverage *c, uint32_t *parent, const uint8_t *inside, uint32_t *number)
{
    uint32_t n = 0;
    size_t stretches = 0;
    for (uint32_t v = 0; v < c->vertices.n; v++) {
        if (!inside[sunder_i_union_find(parent, v)]) continue;
        c->vertices.point[n] = c->vertices.point[v];
        number[v] = ++n;
    }
    for (size_t i = 0; i < c->stretches; i++) {
        sunder_i_outline_stretch s = c->stretch[i];
        if (!number[s.from]) continue;
        s.from = number[s.from] - 1;
        s.to = number[s.to] - 1;
        c->stretch[stretches++] = s;
    }
    c->stretches = stretches;
    c->vertices.n = n;
}

/* Removes everything outside: one point is tested for each connected group of stretches. Returns false if out of
 * memory. */
static bool drop_outside(const eroder *e, sunder_i_coverage *c)
{
    locator l;
    uint32_t *parent = join_stretches(c), *number = sunder_i_calloc(c->vertices.n, sizeof *number);
    uint8_t *inside = sunder_i_calloc(c->vertices.n, sizeof *inside);
    bool ok = locator_init(&l, e, c->vertices.lattice) && parent && number && inside;
    for (uint32_t v = 0; ok && v < c->vertices.n; v++) {
        if (sunder_i_union_find(parent, v) != v) continue;
        inside[v] = fits_at(&l, &c->vertices.point[v]);
        ok = sunder_i_step();
    }
    if (ok) keep_inside(c, parent, inside, number);
    sunder_i_strips_free(&l.strips);
    sunder_i_free_all(parent, number, inside);
    return ok && !l.lattice->arena.failed;
}

/* ---- The outline ---- */

/* Exchanges the covered side of each stretch, from that of the bands to that of the erosion, and removes what is
 * outside the figure. */
static sunder_status turn_over(sunder_i_coverage *coverage, void *user, sunder_error *err)
{
    const uint8_t both = SUNDER_I_BANK_LEFT | SUNDER_I_BANK_RIGHT;
    for (size_t i = 0; i < coverage->stretches; i++)
        if (coverage->stretch[i].banks != both) coverage->stretch[i].banks ^= both;
    return drop_outside(user, coverage) ? SUNDER_OK : sunder_i_failure_cause(err);
}

static sunder_status find_outline(eroder *e, const sunder_sum_options *options, sunder_sum *sum, sunder_error *err)
{
    sunder_i_convex_pieces *const list[] = {&e->side, &e->piece}, bands = {0};
    sunder_i_directions directions = {0};
    sunder_i_point *begin = sunder_i_alloc(e->side.n, sizeof *begin);
    for (uint32_t i = 0; begin && i < e->side.n; i++) begin[i] = e->side.corner[2 * i];
    sunder_status status = SUNDER_OK;
    if (begin && sunder_i_convex_pieces_rank(&sum->lattice, list, 2, &directions) && add_bands(e, begin, &bands))
        status = sunder_i_drop_contained(&bands, err);
    else
        status = sunder_i_failure_cause(err);
    if (status == SUNDER_OK) status = sunder_i_outline_find(&bands, options, turn_over, e, sum, err);
    sunder_i_free(begin);
    sunder_i_directions_free(&directions);
    sunder_i_convex_pieces_free(&bands);
    return status;
}

sunder_status sunder_i_erode_by_outline(const sunder_i_figure *figure, const sunder_i_structuring_element *element,
                                        const sunder_sum_options *options, sunder_sum *sum, bool *done,
                                        sunder_error *err)
{
    *done = false;
    if (element->pieces != 1 || figure->touches || figure->segments || figure->points || figure->sides == 0 ||
        figure->sides > UINT32_MAX / 4)
        return SUNDER_OK;
    eroder e = {.figure = figure, .element = element};
    sunder_status status = SUNDER_OK;
    e.before = sunder_i_alloc(figure->sides, sizeof *e.before);
    if (!e.before || !sunder_i_convex_pieces_init(&e.side, figure->sides, 2 * figure->sides) ||
        !sunder_i_convex_pieces_init(&e.piece, 1, element->end[0]))
        status = sunder_i_failure_cause(err);
    if (status == SUNDER_OK && list_sides(&e) && list_piece(&e)) {
        *done = true;
        sum->lattice.narrow = sum->lattice.small = true;
        sum->lattice.approx_shift = 0;
        status = find_outline(&e, options, sum, err);
    }
    sunder_i_free(e.before);
    sunder_i_convex_pieces_free(&e.side);
    sunder_i_convex_pieces_free(&e.piece);
    return status;
}
