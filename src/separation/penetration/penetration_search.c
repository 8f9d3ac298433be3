/* penetration_search.c: a best-first search. Each segment of the reduced convolution begins at its point nearest to the
 * origin; while a subsum covers the point, the search moves to where the line leaves that subsum, in both directions. A
 * point that remains uncovered is free. Segments come in the order of their distances, and the search ends when the
 * next one is farther than the best free point. */
#include "separation/penetration/penetration_search.h"
#include "base/extremes.h"
#include "base/invariant.h"
#include "separation/answer/answer.h"
#include "separation/obstacle/board.h"
#include "separation/obstacle/pair_convolution.h"
#include "separation/squares/squares.h"

#include <math.h>

typedef struct search {
    sunder_i_operands *g;
    sunder_i_free_point best;
    sunder_i_hpoint best_point;
    bool best_point_known;
    size_t found; /* the number of times a better point was found */
    double limit;
    size_t first; /* the subsum that covered the previous foot; often it covers the next one, too */
    sunder_i_fraction zero, one;
    const double *square; /* the square that is searched; NULL: the whole plane */
    double from, to;      /* the part of the current line in that square, as parameters */
} search;

/* Returns x^2 + y^2 of a short point, which is below 2^127. */
static sunder_i_i128 short_norm(const sunder_i_hpoint *p)
{
    const sunder_i_u128 x = p->x.limb[0], y = p->y.limb[0];
    return (sunder_i_i128)(x * x + y * y);
}

/* Compares the distances of two points from the origin. Degree 10 over 8. */
static int norm_cmp(sunder_i_lattice *l, const sunder_i_hpoint *a, const sunder_i_hpoint *b)
{
    l->counts.exact_fallbacks++;
    if (sunder_i_hpoint_is_short(a) && sunder_i_hpoint_is_short(b))
        return sunder_i_cmp_products(short_norm(a), b->w * b->w, short_norm(b), a->w * a->w);
    const sunder_i_mark mark = sunder_i_lattice_begin(l);
    sunder_i_arena *m = &l->scratch;
    const sunder_i_rational_point p = sunder_i_hpoint_read(m, l, a), q = sunder_i_hpoint_read(m, l, b);
    const int c = sunder_i_ratio_cmp(m, (sunder_i_ratio){sunder_i_rational_dot(m, p, p), sunder_i_big_mul(m, p.w, p.w)},
                                     (sunder_i_ratio){sunder_i_rational_dot(m, q, q), sunder_i_big_mul(m, q.w, q.w)});
    sunder_i_lattice_end(l, mark);
    return c;
}

/* Returns whether t is 0 or 1. end_at() returns the end of a line of native integers for such a t. */
static inline bool is_end(const sunder_i_fraction *t) { return t->num == 0 || t->num == t->den; }
static inline sunder_i_point end_at(const sunder_i_carrier *line, const sunder_i_fraction *t)
{
    return t->num == 0 ? line->a : line->b;
}

/* Returns whether a is nearer to the origin than b, or equally near and lexicographically smaller. Native integers
 * below 2^61. */
static bool end_is_better(sunder_i_point a, sunder_i_point b)
{
    const sunder_i_i128 p = sunder_i_narrow_dot(a, a), q = sunder_i_narrow_dot(b, b);
    return p < q || (p == q && (a.x < b.x || (a.x == b.x && a.y < b.y)));
}

static bool better_point(search *s, const sunder_i_carrier *line, const sunder_i_fraction *t, double distance,
                         sunder_i_hpoint *point, bool *known)
{
    *known = false;
    if (!s->best.found) return true;
    const double slack = 8 * s->g->error;
    if (distance > s->best.distance + slack) return false;
    if (distance < s->best.distance - slack) return true;
    sunder_i_lattice *l = &s->g->placed.lattice;
    /* often both are the same sum of vertices, at which two segments end */
    if (l->narrow && is_end(t) && is_end(&s->best.t)) {
        l->counts.comparisons++;
        return end_is_better(end_at(line, t), end_at(&s->best.line, &s->best.t));
    }
    *point = sunder_i_hpoint_at(l, line->a, line->b, t);
    *known = true;
    if (!s->best_point_known) s->best_point = sunder_i_hpoint_at(l, s->best.line.a, s->best.line.b, &s->best.t);
    s->best_point_known = true;
    const int order = sunder_i_hpoint_cmp(l, point, &s->best_point);
    if (order == 0) return false;
    const int c = norm_cmp(l, point, &s->best_point);
    return c < 0 || (c == 0 && order < 0);
}

static void offer_point(search *s, const sunder_i_carrier *line, const sunder_i_fraction *t, double x, double y,
                        double distance)
{
    sunder_i_hpoint point;
    bool known;
    if (!better_point(s, line, t, distance, &point, &known)) return;
    s->best = (sunder_i_free_point){true, false, *line, *t, x, y, distance};
    s->found++;
    s->best_point_known = known;
    if (known) s->best_point = point;
    if (distance + 8 * s->g->error < s->limit) s->limit = distance + 8 * s->g->error;
}

/* Returns whether the subsum certainly contains the end of the segment; since it is convex it then covers everything up
 * to there. */
static bool holds_end(const sunder_i_carrier *line, const sunder_i_subsum *subsum, bool forwards)
{
    const double x = forwards ? line->ax + line->dx : line->ax, y = forwards ? line->ay + line->dy : line->ay;
    uint32_t doubt;
    return subsum->sides <= SUNDER_I_SIDES_IN_A_WORD && sunder_i_subsum_may_hold(subsum, x, y, 1, &doubt) && doubt == 0;
}

/* Follows the line from a point that is in the interior of subsum `cover` to the first free point, and offers that
 * point unless it is beyond the limit. */
static void walk_line(search *s, const sunder_i_carrier *line, long cover, bool forwards)
{
    sunder_i_operands *g = s->g;
    for (;;) {
        if (holds_end(line, g->subsum + cover, forwards)) return;
        const sunder_i_fraction t = sunder_i_carrier_exit(g, line, g->subsum + cover, forwards);
        if (forwards ? sunder_i_carrier_cmp(g, &t, &s->one) > 0 : sunder_i_carrier_cmp(g, &t, &s->zero) < 0) return;
        if (s->square && (forwards ? t.value > s->to : t.value < s->from)) return;
        double x, y;
        sunder_i_carrier_at(line, &t, &x, &y);
        const double distance = sqrt(x * x + y * y);
        if (distance > s->limit) return;
        size_t first = (size_t)cover;
        cover = sunder_i_carrier_cover(g, line, &t, x, y, &first);
        if (g->placed.lattice.arena.failed) return;
        if (cover < 0) {
            offer_point(s, line, &t, x, y, distance);
            return;
        }
    }
}

/* Computes the part of the line in the square, enlarged by the error of points. Returns false if it is empty. */
static bool enter_square(search *s, const sunder_i_carrier *line)
{
    const double e = 32 * s->g->error, a[2] = {line->ax, line->ay}, d[2] = {line->dx, line->dy};
    s->from = 0;
    s->to = 1;
    for (int k = 0; k < 2; k++) {
        const double low = s->square[k] - e - a[k], high = s->square[k + 2] + e - a[k];
        if (d[k] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        s->from = sunder_i_max(s->from, (d[k] > 0 ? low : high) / d[k]);
        s->to = sunder_i_min(s->to, (d[k] > 0 ? high : low) / d[k]);
    }
    return s->from <= s->to;
}

/* Returns the point of the line's part in the square nearest to the foot. If the foot is outside the square, this point
 * is no end of any covered interval, and if it is free, then a nearer point in another square is free, too. */
static sunder_i_fraction foot_in_square(const search *s, sunder_i_fraction foot)
{
    if (!s->square || (foot.value >= s->from && foot.value <= s->to)) return foot;
    const double at = foot.value < s->from ? s->from : s->to;
    const int64_t n = (int64_t)(at * 0x1p50);
    return (sunder_i_fraction){n, (int64_t)1 << 50, (double)n * 0x1p-50};
}

static void try_candidate(search *s, const sunder_i_carrier *line)
{
    sunder_i_operands *g = s->g;
    if (s->square && !enter_square(s, line)) return;
    const sunder_i_fraction foot = foot_in_square(s, sunder_i_carrier_foot(g, line));
    double x, y;
    sunder_i_carrier_at(line, &foot, &x, &y);
    const double distance = sqrt(x * x + y * y);
    if (distance > s->limit) return;
    const long cover = sunder_i_carrier_cover(g, line, &foot, x, y, &s->first);
    if (g->placed.lattice.arena.failed) return;
    if (cover < 0) {
        offer_point(s, line, &foot, x, y, distance);
        return;
    }
    if (foot.value < 0.5 || sunder_i_carrier_cmp(g, &foot, &s->one) < 0) walk_line(s, line, cover, true);
    if (foot.value > 0.5 || sunder_i_carrier_cmp(g, &foot, &s->zero) > 0) walk_line(s, line, cover, false);
}

/* Returns whether a subsum covers the origin, that is, whether the operands overlap. */
static bool origin_covered(sunder_i_operands *g, const sunder_i_fraction *zero)
{
    const sunder_i_carrier axis = sunder_i_carrier_make(g, (sunder_i_point){0, 0}, (sunder_i_point){1, 0});
    return sunder_i_carrier_cover(g, &axis, zero, 0, 0, NULL) >= 0;
}

static void try_all(search *s, sunder_i_candidates *heap)
{
    sunder_i_operands *g = s->g;
    while (heap->n && !g->placed.lattice.arena.failed) {
        const sunder_i_candidate c = sunder_i_candidates_pop(heap);
        if (sqrt(c.square) - 4 * g->error > s->limit) break; /* all others are farther, too */
        SUNDER_I_ASSERT(heap->n == 0 || c.square <= heap->item[0].square);
        const sunder_i_carrier line = sunder_i_candidate_carrier(g, &c);
        try_candidate(s, &line);
    }
}

static bool search_all(search *s)
{
    sunder_i_candidates heap;
    if (!sunder_i_candidates_find(s->g, s->limit, &heap)) return false;
    try_all(s, &heap);
    return true;
}

/* Finds the nearest free point within s->limit, if there is one. Returns false if out of memory. */
static bool nearest_within(search *s)
{
    sunder_i_operands *g = s->g;
    if (!sunder_i_operands_reach(g, s->limit)) return false;
    if (!origin_covered(g, &s->zero)) {
        s->best.found = s->best.origin = true;
        return true;
    }
    if (g->subsums >= SUNDER_I_BOARD_FROM && !sunder_i_board_build(g, s->limit + 16 * g->error)) return false;
    const bool ok = search_all(s);
    sunder_i_board_free(g);
    return ok;
}

/* Tries the candidates of one square. Its subsums are released afterwards unless the best point was found in it. */
static void search_square(search *s, sunder_i_candidates *heap, sunder_i_mark mark, sunder_i_subsum **list, size_t *n)
{
    sunder_i_operands *g = s->g;
    const size_t before = s->found, pooled = g->placed.lattice.pool_n;
    s->first = 0;
    try_all(s, heap);
    if (s->found > before) {
        *list = g->subsum;
        *n = g->subsums;
    } else if (!g->placed.lattice.arena.failed) {
        sunder_i_arena_release(&g->placed.lattice.arena, mark);
        g->placed.lattice.pool_n = pooled;
        /* the best point may use numbers that were released */
        s->best_point_known = s->best_point_known && g->placed.lattice.narrow;
    }
}

static sunder_i_squares_next search_squares(search *s, sunder_i_squares *squares)
{
    sunder_i_operands *g = s->g;
    sunder_i_subsum *list = NULL;
    size_t n = 0;
    double box[4];
    sunder_i_mark mark;
    sunder_i_candidates heap;
    sunder_i_squares_next next;
    bool covered;
    if (!sunder_i_operands_turn(g) || !sunder_i_squares_take_origin(squares, &covered))
        return SUNDER_I_SQUARES_NO_MEMORY;
    if (!covered && !origin_covered(g, &s->zero)) {
        s->best.found = s->best.origin = true;
        return SUNDER_I_SQUARES_END;
    }
    s->square = box;
    while ((next = sunder_i_squares_pop(squares, s->limit, box, &mark, &heap)) == SUNDER_I_SQUARES_OPEN)
        search_square(s, &heap, mark, &list, &n);
    s->square = NULL;
    g->subsum = list; /* the subsums near the answer, which determine its kind of contact */
    g->subsums = n;
    return next;
}

/* *done becomes whether the search is complete; else another method must be used. Returns false if out of memory. */
static bool by_squares(search *s, bool *done)
{
    const double limit = s->limit;
    sunder_i_squares *squares = sunder_i_squares_new(s->g, limit, 0);
    if (!squares) return false;
    const sunder_i_squares_next end = search_squares(s, squares);
    sunder_i_squares_free(squares);
    *done = end == SUNDER_I_SQUARES_END;
    if (!*done) { /* the point found so far may not be the nearest */
        s->best = (sunder_i_free_point){.found = false};
        s->best_point_known = false;
        s->limit = limit;
    }
    return end != SUNDER_I_SQUARES_NO_MEMORY && !s->g->placed.lattice.arena.failed;
}

static search begin_search(sunder_i_operands *g, double limit)
{
    return (search){.g = g,
                    .limit = sunder_i_min(sunder_i_operands_way_out(g), limit) + 8 * g->error,
                    .zero = sunder_i_fraction_int(&g->placed.lattice, 0),
                    .one = sunder_i_fraction_int(&g->placed.lattice, 1)};
}

sunder_status sunder_i_nearest_by_squares(sunder_i_operands *operands, double limit, bool *done,
                                          sunder_i_free_point *out, sunder_error *err)
{
    search s = begin_search(operands, limit);
    *done = false;
    if (!by_squares(&s, done)) return sunder_i_failure_cause(err);
    *out = s.best;
    return SUNDER_OK;
}

/* Operands with about this number of pairs of pieces or more, after pieces with many vertices are divided, are searched
 * by squares (sunder_i_squares_worth()); for fewer, listing the pairs takes less time than building the trees for
 * squares. */
#define SQUARES_FROM 16384
/* If squares do not suit the operands, most pairs of pieces may still be far away, as with neighbouring countries, and
 * listing them would exhaust the memory. So the search begins in a small disc, and continues in one that is WIDEN_BY
 * times as wide if the disc contains no free point, up to WIDEN_TIMES times. Countries with a narrow overlap separate
 * in the first disc, at 8^-4 of the radius that certainly suffices. */
#define WIDEN_BY 8
#define WIDEN_TIMES 4

/* Searches by squares, with pieces of few vertices. If that does not suit the operands, *done is false and the pieces
 * are restored. */
static sunder_status by_parts(sunder_i_operands *g, double limit, bool *done, sunder_i_free_point *out,
                              sunder_error *err)
{
    const sunder_i_operands whole = *g;
    if (!sunder_i_operands_cut(g)) return sunder_i_failure_cause(err);
    const sunder_status status = sunder_i_nearest_by_squares(g, limit, done, out, err);
    if (status || *done) return status;
    sunder_i_operands_uncut(g, &whole);
    return SUNDER_OK;
}

sunder_status sunder_i_nearest_free_point(sunder_i_operands *operands, double limit, sunder_i_free_point *out,
                                          sunder_error *err)
{
    sunder_i_lattice *l = &operands->placed.lattice;
    const bool many = sunder_i_squares_worth(operands, SQUARES_FROM);
    if (many) {
        bool done = false;
        const sunder_status status = by_parts(operands, limit, &done, out, err);
        if (status || done) return status;
    }
    search s = begin_search(operands, limit);
    const double whole = s.limit;
    for (int times = many ? WIDEN_TIMES : 0; times >= 0 && !s.best.found; times--) {
        double disc = whole;
        for (int k = 0; k < times; k++) disc /= WIDEN_BY;
        s.limit = disc;
        s.first = 0;
        if (!nearest_within(&s) || l->arena.failed) return sunder_i_failure_cause(err);
        /* near the boundary of the disc a nearer point may have been taken to be outside */
        if (times && !s.best.origin && s.best.distance + 16 * operands->error > disc)
            s.best = (sunder_i_free_point){.found = false};
        s.best_point_known = s.best_point_known && s.best.found;
    }
    *out = s.best;
    return SUNDER_OK;
}
