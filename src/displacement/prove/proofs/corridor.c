/* A body that can only slide along a line, and for which doubles have no other place on that line.
 *
 * A block between the two sides of a straight road, in conflict with both, may come no nearer to either: it can only
 * slide along the road. Over the reals that is a solution. But after a move all corners must be doubles, so moves are
 * multiples of the unit in the last place of the coordinates. On the line of a segment whose ends are doubles, the next
 * such place is as far away as the segment is long, divided by the common divisor of its two coordinates. Usually that
 * is beyond any limit.
 *
 * So if branching has found a solution over the reals, this file tests whether one of its bodies is held between two
 * such lines. The lines must be known without any rounding. The pair of a line is listed, and may be no worse than at
 * the start:
 *
 *       A - B grown by the distance at the start         N = a normal of A - B, a vector of doubles: its edge has
 *      ___________________________                           corners of doubles, and their difference is one
 *                 u = 0           \                      the line N.u = 0 passes the original place, at exactly the
 *      _____P___________Q______                              distance of the whole pair at the start
 *              A - B           \
 *
 * N.u >= 0 then replaces the corresponding half-plane of the pair of parts, as half_planes.c finds it: that line only
 * has to cover its own part of the forbidden boundary, as long as no other edge is nearly parallel to it. That the pair
 * of parts had the distance of the whole pair is tested exactly (layer/barrier_pairs.h).
 *
 * For an overlap with a barrier, no single pair of parts may be as deep as the whole: a feature across a road of
 * several pieces leaves it by the last of them. There the line is the one at which this last piece leaves the road, so
 * that the slack v (feasibility.h) has to take the feature there, n.(u + v) >= h. If the overlap was at most h / |n|
 * deep, no v contributes more than h along n, and n.u >= 0 again. The depth is tested against the hull of the feature,
 * exactly.
 *
 * Two opposite lines of one body make the first two branches; between them the limit of the body is 0 (branches.c). */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/reads.h"
#include "displacement/prove/proofs/branching.h"
#include "displacement/prove/proofs/exact_line.h"
#include "displacement/prove/proofs/tuning.h"

#include "shape/shape.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Exact arithmetic ------------------------------------------------------------------------------------------ */

static bool are_parallel(const double m[2], const double n[2])
{
    return sunder_i_are_equal_products(m[0], n[1], m[1], n[0]);
}

static double dot_product(const double p[2], const double q[2]) { return p[0] * q[0] + p[1] * q[1]; }

/* Scales the normal n to a length of about 1, by a factor for which both products are exact, so that its direction
 * does not change. If there is no such factor, it is scaled by a power of two, to a length from 1 to 2. */
static void scale_normal(double n[2])
{
    const int e = ilogb(hypot(n[0], n[1]));
    for (int x = 0; x < 2; x++) n[x] = ldexp(n[x], -e);
    for (int bits = 10; bits > 0; bits--) {
        const double times = rint(ldexp(1, bits) / hypot(n[0], n[1])), m[2] = {times * n[0], times * n[1]};
        if (fma(times, n[0], -m[0]) != 0 || fma(times, n[1], -m[1]) != 0) continue;
        for (int x = 0; x < 2; x++) n[x] = ldexp(m[x], -bits);
        return;
    }
}

/* ---- The places that doubles have -------------------------------------------------------------------------------- */

/* Finds the exponent of the unit of coordinate c. Returns false unless all corners stay between two consecutive powers
 * of two, wherever the body may go. */
static bool find_unit(const sunder_i_model *model, const sunder_i_body *body, size_t c, int *unit)
{
    double low = INFINITY, high = -INFINITY;
    for (uint32_t k = 0; k < body->members; k++) {
        const sunder_shape *shape = sunder_i_thing_shape(model, model->member[body->member + k]);
        for (size_t v = 0; shape && v < sunder_i_shape_raw_vertices(shape); v++) {
            low = sunder_i_min(low, shape->raw_xy[2 * v + c]);
            high = sunder_i_max(high, shape->raw_xy[2 * v + c]);
        }
    }
    low = nextafter(low - body->limit, -INFINITY);
    high = nextafter(high + body->limit, INFINITY);
    if (!isfinite(high - low) || !(low > 0 || high < 0) || ilogb(low) != ilogb(high)) return false;
    *unit = ilogb(low) - 52;
    return *unit >= -1022;
}

/* Writes v = odd * 2^exponent, and returns the odd number. */
static uint64_t odd_part(double v, int *exponent)
{
    uint64_t m = (uint64_t)ldexp(frexp(fabs(v), exponent), 53);
    *exponent -= 53;
    for (; (m & 1) == 0; m >>= 1) ++*exponent;
    return m;
}

static uint64_t common_divisor(uint64_t p, uint64_t q)
{
    while (q) {
        const uint64_t rest = p % q;
        p = q;
        q = rest;
    }
    return p;
}

/* Are all other places of the line n.t = 0 beyond the body's limit? A place has i and j units. With n0 = p / unit 0 and
 * n1 = q / unit 1 it satisfies p i + q j = 0, and the nearest is (q, -p), divided by the common divisor. */
static bool is_alone(const sunder_i_model *model, const sunder_i_body *body, const double n[2])
{
    int unit[2], e[2];
    if (n[0] == 0 || n[1] == 0 || !find_unit(model, body, 0, &unit[0]) || !find_unit(model, body, 1, &unit[1]))
        return false;
    const uint64_t p = odd_part(n[0], &e[0]), q = odd_part(n[1], &e[1]), odd = common_divisor(p, q);
    for (int x = 0; x < 2; x++) e[x] += unit[x];
    const int common = e[0] < e[1] ? e[0] : e[1];
    const double i = ldexp((double)(q / odd), e[1] - common + unit[0]),
                 j = ldexp((double)(p / odd), e[0] - common + unit[1]);
    return hypot(i, j) > body->limit * (1 + 0x1p-40);
}

/* ---- The line of one pair of parts ------------------------------------------------------------------------------- */

/* Two parts of a pair, and the line of relative moves that passes the original place. */
typedef struct facing {
    sunder_i_corridor_wall wall;
    double a[2 * WALL_CORNERS], b[2 * WALL_CORNERS]; /* the corners of the parts as given */
} facing;

/* Computes in `n` the unscaled normal of edge k of A - B: the edges of A come first, then those of B. Returns false if
 * doubles cannot hold it exactly. */
static bool normal_of(const facing *f, size_t k, double n[2])
{
    const size_t na = f->wall.a->corners, nb = f->wall.b->corners;
    const bool of_a = k < na;
    const double *xy = of_a ? f->a : f->b, *p = xy + 2 * (of_a ? k : k - na),
                 *q = xy + 2 * (of_a ? (k + 1) % na : (k - na + 1) % nb);
    double x, y;
    const bool exact_x = sunder_i_subtract_exactly(q[0], p[0], &x), exact_y = sunder_i_subtract_exactly(q[1], p[1], &y);
    n[0] = of_a ? y : -y;
    n[1] = of_a ? -x : x;
    return exact_x && exact_y;
}

/* Returns the corner that is farthest along sign * n. */
static const double *farthest_corner(const double *xy, size_t corners, const double n[2], double sign)
{
    const double *best = xy;
    for (size_t k = 1; k < corners; k++) {
        const double d[2] = {xy[2 * k] - best[0], xy[2 * k + 1] - best[1]};
        if (sign * dot_product(n, d) > 0) best = xy + 2 * k;
    }
    return best;
}

/* Returns the distance of u = 0 beyond the line of an edge of A - B with normal n, negative inside. */
static double beyond_line(const facing *f, const double n[2])
{
    const double *p = farthest_corner(f->a, f->wall.a->corners, n, 1),
                 *q = farthest_corner(f->b, f->wall.b->corners, n, -1), d[2] = {p[0] - q[0], p[1] - q[1]};
    return -dot_product(n, d) / hypot(n[0], n[1]);
}

/* Is the foot of the perpendicular from u = 0 to edge k on that edge, at least a hair from its ends? */
static bool has_foot(const facing *f, size_t k, const double n[2], double hair)
{
    const size_t na = f->wall.a->corners, nb = f->wall.b->corners;
    const bool of_a = k < na;
    const double *other = of_a ? farthest_corner(f->b, nb, n, -1) : farthest_corner(f->a, na, n, 1),
                 *p = of_a ? f->a + 2 * k : f->b + 2 * (k - na),
                 *q = of_a ? f->a + 2 * ((k + 1) % na) : f->b + 2 * ((k - na + 1) % nb),
                 to_p[2] = {p[0] - other[0], p[1] - other[1]}, to_q[2] = {q[0] - other[0], q[1] - other[1]},
                 e[2] = {q[0] - p[0], q[1] - p[1]}, room = hair * hypot(e[0], e[1]);
    return dot_product(to_p, e) < -room && dot_product(to_q, e) > room;
}

/* Are the two normals nearly parallel, but not exactly? */
static bool are_nearly_parallel(const double n[2], const double other[2])
{
    const double size = hypot(other[0], other[1]) * hypot(n[0], n[1]);
    return dot_product(n, other) > 0 && !are_parallel(n, other) &&
           fabs(n[0] * other[1] - n[1] * other[0]) < NEARLY_PARALLEL * size;
}

/* Is edge k unambiguous? No other edge is nearly parallel to it, except exactly; and if the parts overlap, all others
 * are deeper. */
static bool stands_out(const facing *f, size_t k, const double n[2], double hair)
{
    const double depth = beyond_line(f, n);
    for (size_t m = 0; m < f->wall.a->corners + f->wall.b->corners; m++) {
        double other[2];
        if (m == k) continue;
        if (!normal_of(f, m, other) || are_nearly_parallel(n, other)) return false;
        if (dot_product(n, other) > 0 && are_parallel(n, other)) continue;
        if (depth < 0 && !(beyond_line(f, other) < depth - hair)) return false;
    }
    return true;
}

/* Does edge k of A - B lie on a line that passes the original place u = 0 at the distance `clearance`, unambiguously?
 * If so, stores its normal. */
static bool is_line(const sunder_i_branching *c, facing *f, size_t k, double clearance)
{
    double *n = f->wall.n;
    /* The edge must be so long that any edge not parallel to it has a direction of its own (half_planes.c: less than a
     * hair). */
    if (!normal_of(f, k, n) || !(NEARLY_PARALLEL * hypot(n[0], n[1]) > 8 * c->hair)) return false;
    if (!(fabs(beyond_line(f, n) - clearance) <= c->hair)) return false;
    if (!(clearance >= 0 ? has_foot(f, k, n, c->hair) : beyond_line(f, n) < -c->hair)) return false;
    if (!stands_out(f, k, n, c->hair)) return false;
    scale_normal(n);
    return true;
}

/* ---- A line that the translation out of an overlap has to reach -------------------------------------------------- */

/* Is no corner farther along n than corner `at`, exactly? */
static bool is_extreme(const double *xy, size_t corners, const double n[2], const double at[2])
{
    for (size_t k = 0; k < corners; k++) {
        double d[2];
        if (!sunder_i_subtract_exactly(xy[2 * k], at[0], &d[0]) ||
            !sunder_i_subtract_exactly(xy[2 * k + 1], at[1], &d[1]))
            return false;
        const double size = fabs(n[0] * d[0]) + fabs(n[1] * d[1]);
        if (dot_product(n, d) < -0x1p-50 * size || sunder_i_are_equal_products(n[0], d[0], -n[1], d[1])) continue;
        return false;
    }
    return true;
}

/* Is edge k of A - B such that moving the whole feature beyond it, along n, takes exactly the depth of the pair's
 * overlap at the start? hull: the extreme corners of the feature that A belongs to. */
static bool is_far_line(const sunder_i_branching *c, facing *f, size_t k, const double *hull, size_t corners)
{
    double *n = f->wall.n, d[2];
    if (!normal_of(f, k, n) || !(NEARLY_PARALLEL * hypot(n[0], n[1]) > 8 * c->hair)) return false;
    if (!(fabs(beyond_line(f, n) - f->wall.clearance) <= c->hair)) return false;
    for (size_t m = 0; m < f->wall.a->corners + f->wall.b->corners; m++) {
        double other[2];
        if (m == k) continue;
        if (!normal_of(f, m, other) || are_nearly_parallel(n, other)) return false;
    }
    const double *p = farthest_corner(f->a, f->wall.a->corners, n, 1),
                 *q = farthest_corner(f->b, f->wall.b->corners, n, -1);
    scale_normal(n);
    if (!is_extreme(hull, corners, n, p) || !sunder_i_subtract_exactly(p[0], q[0], &d[0]) ||
        !sunder_i_subtract_exactly(p[1], q[1], &d[1]))
        return false;
    f->wall.d = dot_product(n, d) - 0x1p-48 * (fabs(n[0] * d[0]) + fabs(n[1] * d[1]));
    return true;
}

/* ---- All lines of a body ----------------------------------------------------------------------------------------- */

typedef struct looking {
    sunder_i_branching *branching;
    uint32_t mover;
    sunder_i_corridor_wall *line;
    size_t n, capacity;
    sunder_status status;
    sunder_error *err;
} looking;

/* Are the corners of feature f known only as rounded doubles, or moved because they are far? */
static bool is_vague(const sunder_i_model *model, uint32_t f)
{
    return sunder_i_thing_shape(model, f)->rational || model->body[model->body_of[f]].far;
}

/* Adds the line if the whole pair had the same distance as these two parts. part: the corners of the part of the
 * feature. */
static void take_line(looking *g, const facing *f, const double *part, size_t corners)
{
    const sunder_i_corridor_wall *w = &f->wall;
    bool same;
    g->status = sunder_i_parts_stand_so(g->branching->model, w->a->feature, w->b->feature,
                                        &(sunder_i_piece_of){.n = (uint32_t)corners, .xy = part},
                                        &(sunder_i_piece_of){.n = w->b->corners, .xy = f->b}, &same, g->err);
    if (g->status || !same) return;
    if (!sunder_i_reserve(&g->line, &g->capacity, g->n + 1, sizeof *g->line))
        g->status = sunder_i_failure_cause(g->err);
    else
        g->line[g->n++] = *w;
}

static void look_at(looking *g, const sunder_i_body_piece *a, const sunder_i_body_piece *b, double clearance)
{
    const sunder_i_model *model = g->branching->model;
    facing f = {.wall = {.a = a, .b = b, .clearance = clearance}};
    g->branching->looked += a->corners * b->corners;
    if (a->corners > WALL_CORNERS || b->corners > WALL_CORNERS) return;
    sunder_i_piece_as_given(model, a, f.a);
    sunder_i_piece_as_given(model, b, f.b);
    for (size_t k = 0; k < a->corners + b->corners && !g->status; k++)
        if (is_line(g->branching, &f, k, clearance)) take_line(g, &f, f.a, a->corners);
}

static void look_at_depth(looking *g, const sunder_i_body_piece *a, const sunder_i_body_piece *b,
                          const sunder_i_requirement *r, const double *hull, size_t corners)
{
    const sunder_i_model *model = g->branching->model;
    facing f = {.wall = {.a = a, .b = b, .clearance = r->clearance, .slack = r}};
    g->branching->looked += a->corners * b->corners;
    if (a->corners > WALL_CORNERS || b->corners > WALL_CORNERS) return;
    sunder_i_piece_as_given(model, a, f.a);
    sunder_i_piece_as_given(model, b, f.b);
    for (size_t k = 0; k < a->corners + b->corners && !g->status; k++)
        if (is_far_line(g->branching, &f, k, hull, corners)) take_line(g, &f, hull, corners);
}

/* Finds the convex hull of a feature, with corners as given, counter-clockwise. Returns false if it is not strictly
 * convex. */
static bool find_hull(const sunder_i_model *model, uint32_t f, double **hull, size_t *corners)
{
    const sunder_shape *shape = sunder_i_thing_shape(model, f);
    const size_t n = shape->vertices;
    double *xy = sunder_i_alloc(2 * n, sizeof *xy);
    *hull = sunder_i_alloc(2 * (n + 1), sizeof **hull);
    *corners = 0;
    if (xy && *hull) {
        memcpy(xy, shape->xy, 2 * n * sizeof *xy);
        *corners = sunder_i_convex_hull(xy, n, *hull);
    }
    for (size_t k = 0; k < *corners; k++) {
        const double *p = *hull + 2 * k, *q = *hull + 2 * ((k + 1) % *corners), *r = *hull + 2 * ((k + 2) % *corners);
        if (sunder_orient(&(sunder_point){p[0], p[1]}, &(sunder_point){q[0], q[1]}, &(sunder_point){r[0], r[1]}) <= 0)
            *corners = 0;
    }
    sunder_i_free(xy);
    return *corners > 2;
}

/* Tests all pieces of feature f with the pieces of the barrier that its hull meets. */
static void look_at_overlap(looking *g, uint32_t f, const sunder_i_requirement *r)
{
    sunder_i_branching *c = g->branching;
    const sunder_i_model *model = c->model;
    const sunder_i_body *p = &model->body[g->mover];
    double *hull = NULL;
    size_t corners;
    if (find_hull(model, f, &hull, &corners))
        for (size_t n = 0; n < c->near.n && !g->status; n++) {
            const sunder_i_body *q = &model->body[model->body_of[c->near.item[n]]];
            const sunder_i_body_pieces *of_p = sunder_i_pieces_of(model, p), *of_q = sunder_i_pieces_of(model, q);
            sunder_i_branching_join(c, model->body_of[c->near.item[n]]);
            if (!of_p || !of_q) g->status = sunder_i_failure_cause(g->err);
            for (uint32_t k = 0; k < p->pieces && !g->status; k++)
                for (uint32_t l = 0; l < q->pieces && !g->status; l++)
                    if (of_p->piece[k].feature == f)
                        look_at_depth(g, &of_p->piece[k], &of_q->piece[l], r, hull, corners);
        }
    sunder_i_free(hull);
}

/* Tests feature f of the body with a fixed thing `standing`: a feature, or a part of a barrier. */
static void look_at_pair(looking *g, uint32_t f, uint32_t standing, double clearance)
{
    const sunder_i_model *model = g->branching->model;
    const sunder_i_body *p = &model->body[g->mover], *q = &model->body[model->body_of[standing]];
    const double reach = fabs(clearance) + g->branching->hair;
    const sunder_i_body_pieces *of_p = sunder_i_pieces_of(model, p), *of_q = sunder_i_pieces_of(model, q);
    sunder_i_branching_join(g->branching, model->body_of[standing]); /* this determines the size of a hair */
    if (!of_p || !of_q) g->status = sunder_i_failure_cause(g->err);
    for (uint32_t k = 0; k < p->pieces && !g->status; k++) {
        const sunder_i_body_piece *a = &of_p->piece[k];
        double box[4];
        if (a->feature != f) continue;
        for (uint32_t x = 0; x < 4; x++)
            box[x] = a->box[x] + (p->origin[x & 1] - q->origin[x & 1]) + (x < 2 ? -reach : reach);
        for (uint32_t l = 0; l < q->pieces && !g->status; l++)
            if (of_q->piece[l].feature == standing && sunder_i_box_meet(box, of_q->piece[l].box))
                look_at(g, a, &of_q->piece[l], clearance);
    }
}

static void look_at_requirement(looking *g, const sunder_i_requirement *r)
{
    sunder_i_branching *c = g->branching;
    const sunder_i_model *model = c->model;
    const uint32_t f = model->body_of[r->a] == g->mover ? r->a : r->b, other = f == r->a ? r->b : r->a;
    double clearance, box[4];
    if (sunder_i_limit_of(&model->body[model->body_of[other]]) > 0 || is_vague(model, f)) return;
    if ((r->a == c->subproblem->a && r->b == c->subproblem->b) || !sunder_i_branching_owe(c, f, other, &clearance))
        return;
    if (!sunder_i_is_barrier(model, other)) {
        if (!is_vague(model, other)) look_at_pair(g, f, other, clearance);
        return;
    }
    const uint32_t end = (uint32_t)model->features + model->barriers->part_end[sunder_i_barrier_of(model, other)];
    sunder_i_box_grow(sunder_i_home_box(model, f), fabs(clearance) + c->hair, box);
    c->near.n = 0;
    if (!sunder_i_look_about(model, &model->tree, box, &c->near)) g->status = sunder_i_failure_cause(g->err);
    if (c->near.n) qsort(c->near.item, c->near.n, sizeof *c->near.item, sunder_i_by_number);
    size_t out = 0;
    for (size_t k = 0; k < c->near.n; k++)
        if (c->near.item[k] >= other && c->near.item[k] < end && !is_vague(model, c->near.item[k]))
            c->near.item[out++] = c->near.item[k];
    c->near.n = out;
    for (size_t k = 0; k < c->near.n && !g->status; k++) look_at_pair(g, f, c->near.item[k], clearance);
    if (clearance < 0 && !g->status) look_at_overlap(g, f, r);
}

static bool is_of(const sunder_i_model *model, uint32_t thing, uint32_t body) { return model->body_of[thing] == body; }

/* Chooses two opposite lines that leave the body only one place. slack: lines that a slack has to reach may be used,
 * too. */
static bool choose_walls(const looking *g, bool slack, sunder_i_corridor_wall out[2])
{
    const sunder_i_model *model = g->branching->model;
    for (size_t k = 0; k < g->n; k++)
        for (size_t l = k + 1; l < g->n; l++) {
            const double *m = g->line[k].n, *n = g->line[l].n;
            if (!slack && (g->line[k].slack || g->line[l].slack)) continue;
            if (!(dot_product(m, n) < 0) || !are_parallel(m, n) || !is_alone(model, &model->body[g->mover], n))
                continue;
            out[0] = g->line[k];
            out[1] = g->line[l];
            return true;
        }
    return false;
}

sunder_status sunder_i_branching_find_corridor(sunder_i_branching *branching, uint32_t body, sunder_error *err)
{
    const sunder_i_model *model = branching->model;
    const sunder_i_subproblem *q = branching->subproblem;
    looking g = {.branching = branching, .mover = body, .err = err};
    for (size_t k = 0; k < q->required_n && !g.status; k++)
        if (is_of(model, q->required[k].a, body) || is_of(model, q->required[k].b, body))
            look_at_requirement(&g, &q->required[k]);
    if (!g.status && (choose_walls(&g, false, branching->wall) || choose_walls(&g, true, branching->wall))) {
        branching->walls = 2;
        branching->between = body;
    }
    sunder_i_free(g.line);
    return g.status;
}

size_t sunder_i_branching_wall_half_planes(sunder_i_branching *branching, const sunder_i_corridor_wall *wall)
{
    const sunder_i_body *p = &branching->model->body[branching->between],
                        *q = &branching->model->body[branching->model->body_of[wall->b->feature]];
    const size_t n = sunder_i_branching_fill_half_planes(branching, p, wall->a, q, wall->b,
                                                         wall->slack ? 0 : wall->clearance, false, NULL);
    const double length = hypot(wall->n[0], wall->n[1]);
    size_t at = n;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_half_plane *w = &branching->scratch[k];
        const double sine = (w->n[0] * wall->n[1] - w->n[1] * wall->n[0]) / length;
        if (dot_product(w->n, wall->n) > 0 && fabs(sine) < 0x1p-40 &&
            fabs(w->d - wall->d / length) <= 4 * branching->hair) {
            if (at < n) return 0;
            at = k;
        }
    }
    if (at == n) return 0;
    branching->scratch[at] = branching->scratch[0];
    branching->scratch[0] = (sunder_i_half_plane){.n = {wall->n[0], wall->n[1]}, .d = wall->d};
    return n;
}
