/* The set behind all ways of a node about a shadow is open and convex, and may be unbounded. The shadow is closed and
 * convex. The set lies in it exactly if the set's corners do, and if the directions of its lines in which it is
 * unbounded lead from the origin through the part that casts the shadow. */
#include "passage_oracle.h"
#include "proof_checking.h"

#include <math.h>

/* Is x v on the segment for some x > 0, with x <= 1 unless `far`? For a segment on a line through the origin the answer
 * is no. */
static bool is_behind_segment(const hull *k, const vec *v, bool far)
{
    mpq_t x, slope, along, whole;
    vec e, at;
    mpq_inits(x, slope, along, whole, NULL);
    vec_init(&e), vec_init(&at);
    vec_sub(&e, &k->v[1], &k->v[0]);
    vec_cross(slope, &e, v);
    vec_cross(x, &e, &k->v[0]);
    bool on = mpq_sgn(slope) != 0;
    if (on) {
        mpq_div(x, x, slope);
        on = mpq_sgn(x) > 0 && (far || mpq_cmp_ui(x, 1, 1) <= 0);
        mpq_mul(at.x, x, v->x);
        mpq_mul(at.y, x, v->y);
        vec_sub(&at, &at, &k->v[0]);
        vec_dot(along, &at, &e);
        vec_dot(whole, &e, &e);
        on = on && mpq_sgn(along) >= 0 && mpq_cmp(along, whole) <= 0;
    }
    mpq_clears(x, slope, along, whole, NULL);
    vec_clear(&e), vec_clear(&at);
    return on;
}

/* Is x v in the polygon for some x >= 0, with x <= 1 unless `far`? The origin is not in the polygon. */
static bool is_shaded(const hull *k, const vec *v, bool far)
{
    mpq_t low, high, slope, level;
    vec e;
    if (k->n == 2) return is_behind_segment(k, v, far);
    mpq_inits(low, high, slope, level, NULL);
    vec_init(&e);
    mpq_set_ui(high, 1, 1);
    bool in = k->n > 2, bounded = !far;
    for (size_t i = 0; i < k->n && in; i++) {
        const vec *p = &k->v[i];
        vec_sub(&e, &k->v[(i + 1) % k->n], p);
        /* On the left of the side: e x (x v) >= e x p. */
        vec_cross(slope, &e, v);
        vec_cross(level, &e, p);
        if (mpq_sgn(slope) == 0) {
            in = mpq_sgn(level) <= 0;
            continue;
        }
        const bool least = mpq_sgn(slope) > 0;
        mpq_div(level, level, slope);
        if (least && mpq_cmp(level, low) > 0) mpq_set(low, level);
        if (!least && (!bounded || mpq_cmp(level, high) < 0)) {
            mpq_set(high, level);
            bounded = true;
        }
    }
    in = in && (!bounded || mpq_cmp(low, high) <= 0);
    mpq_clears(low, high, slope, level, NULL);
    vec_clear(&e);
    return in;
}

/* Is the set unbounded in that direction, that is, does the direction lead to no way? */
static bool is_endless(const sunder_proof_way *way, size_t n, const vec *w)
{
    vec m;
    mpq_t d;
    bool endless = true;
    vec_init(&m), mpq_init(d);
    for (size_t k = 0; k < n && endless; k++) {
        vec_set_d(&m, way[k].n);
        vec_dot(d, &m, w);
        endless = mpq_sgn(d) <= 0;
    }
    vec_clear(&m), mpq_clear(d);
    return endless;
}

static const char *check_ways(const checking *c, const sunder_proof_node *node, const hull *k)
{
    const sunder_proof_way *way = c->proof->way + node->way;
    const char *wrong = NULL;
    vec v;
    vec_init(&v);
    for (size_t i = 0; i < node->ways && !wrong; i++) {
        for (int turn = -1; turn < 2 && !wrong; turn += 2) {
            const double along[2] = {-turn * way[i].n[1], turn * way[i].n[0]};
            vec_set_d(&v, along);
            if (is_endless(way, node->ways, &v) && !is_shaded(k, &v, true)) wrong = "the ways leave a direction out";
        }
        for (size_t j = i + 1; j < node->ways && !wrong; j++)
            if (proof_crossing(&way[i], NULL, &way[j], &v) && proof_is_behind_all(way, NULL, node->ways, &v) &&
                !is_shaded(k, &v, false))
                wrong = "no way leads to a move without a jump";
    }
    vec_clear(&v);
    return wrong;
}

/* The anchor is the one that the library computes, and it is not inside the other feature. */
static const char *check_anchor(const proof_feature *of, const proof_feature *other, const double anchor[2])
{
    polyset p, q;
    double at[2];
    oracle_boundary b;
    polyset_init(&p), polyset_init(&q);
    polyset_polygon(&p, of->xy, of->corners);
    polyset_polygon(&q, other->xy, other->corners);
    sunder_shape *shape = polyset_shape(&p);
    sunder_shape_anchor(shape, at);
    oracle_boundary_open(&b, &q);
    const bool held = oracle_holds(&b, anchor);
    oracle_boundary_close(&b);
    sunder_shape_free(shape);
    polyset_free(&p), polyset_free(&q);
    if (at[0] != anchor[0] || at[1] != anchor[1]) return "an anchor differs from that of its feature";
    return held ? "an anchor is inside the feature that it may not jump over" : NULL;
}

/* A side anchor: the checker accepts any point in the feature's box, but only one for each feature. */
static const char *check_side_anchor(const checking *c, size_t f, const double anchor[2])
{
    const proof_feature *of = &c->feature[f];
    double box[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t k = 0; k < 2 * of->corners; k++) {
        box[k & 1] = fmin(box[k & 1], of->xy[k]);
        box[2 + (k & 1)] = fmax(box[2 + (k & 1)], of->xy[k]);
    }
    for (size_t k = 0; k < 2; k++)
        if (anchor[k] < box[k] || anchor[k] > box[2 + k]) return "a side anchor outside of its feature";
    for (size_t k = 0; k < c->proof->nodes; k++) {
        const sunder_proof_node *other = &c->proof->node[k];
        const double *at = c->proof->corner + 2 * other->part_a;
        if (other->ways && other->shadow && other->a == f && other->b >= c->n &&
            (at[0] != anchor[0] || at[1] != anchor[1]))
            return "two side anchors of one feature";
    }
    return NULL;
}

/* Is it on an edge of the barrier's area that has the anchor strictly on its right? */
static bool is_outer_side(const proof_feature *area, const double side[4], const double anchor[2])
{
    vec p, q, at;
    vec_init(&p), vec_init(&q), vec_init(&at);
    vec_set_d(&p, side), vec_set_d(&q, side + 2), vec_set_d(&at, anchor);
    bool outer = false;
    for (size_t k = 0; k < area->corners && !outer; k++) {
        const double *from = area->xy + 2 * k, *to = area->xy + 2 * ((k + 1) % area->corners);
        const double edge[4] = {from[0], from[1], to[0], to[1]};
        outer = is_part_of_line(side, 2, &(proof_feature){.xy = edge, .corners = 2, .line = true}) &&
                (to[0] - from[0]) * (side[2] - side[0]) + (to[1] - from[1]) * (side[3] - side[1]) > 0;
    }
    outer = outer && vec_side(&p, &q, &at) < 0;
    vec_clear(&p), vec_clear(&q), vec_clear(&at);
    return outer;
}

static const char *check_side_of(const checking *c, const sunder_proof_node *node, size_t of, const double side[4])
{
    const double *anchor = c->proof->corner + 2 * node->part_a;
    const proof_feature *barrier = &c->feature[of];
    if (of < c->n || !barrier->sides) return "a barrier without sides";
    if (node->corners_a != 1 || node->corners_b != 2) return "a side is a segment, and has an anchor";
    if (barrier->line ? !is_part_of_line(side, 2, barrier) : !is_outer_side(barrier, side, anchor))
        return "a side is not of its barrier, or faces away";
    if (barrier->line && is_part_of_line(anchor, 1, barrier)) return "a side anchor lies on its barrier";
    return check_side_anchor(c, node->a, anchor);
}

/* Is the end of a chord in the shadow of the side from `corner` to `other`, and not on the line from the anchor through
 * the corner? */
static bool is_shaded_end(const vec *anchor, const vec *corner, const vec *other, const vec *end)
{
    const int turn = vec_side(anchor, corner, other), far = vec_side(corner, other, anchor);
    return turn != 0 && vec_side(anchor, corner, end) == turn && vec_side(anchor, other, end) != turn && far != 0 &&
           vec_side(corner, other, end) != far;
}

/* Does the ray from the anchor through the corner meet the line of the chord, not before the corner? */
static bool is_passed_beyond(const vec chord[2], const vec *anchor, const vec *corner)
{
    vec e, to;
    mpq_t of_anchor, of_corner;
    vec_init(&e), vec_init(&to);
    mpq_inits(of_anchor, of_corner, NULL);
    vec_sub(&e, &chord[1], &chord[0]);
    vec_sub(&to, anchor, &chord[0]);
    vec_cross(of_anchor, &e, &to);
    vec_sub(&to, corner, &chord[0]);
    vec_cross(of_corner, &e, &to);
    bool beyond = mpq_sgn(of_anchor) != 0;
    if (beyond) {
        mpq_div(of_corner, of_corner, of_anchor);
        beyond = mpq_sgn(of_corner) >= 0 && mpq_cmp_ui(of_corner, 1, 1) < 0;
    }
    vec_clear(&e), vec_clear(&to);
    mpq_clears(of_anchor, of_corner, NULL);
    return beyond;
}

/* Are the two ends on one ray from the anchor? */
static bool are_on_one_ray(const vec *anchor, const vec *p, const vec *q)
{
    mpq_t along;
    vec to_p, to_q;
    mpq_init(along);
    vec_init(&to_p), vec_init(&to_q);
    vec_sub(&to_p, p, anchor);
    vec_sub(&to_q, q, anchor);
    vec_dot(along, &to_p, &to_q);
    const bool so = mpq_sgn(along) > 0 && vec_side(anchor, p, q) == 0;
    vec_clear(&to_p), vec_clear(&to_q);
    mpq_clear(along);
    return so;
}

/* What is wrong with a chord past the ends end[k][0] of two sides, which are on one ray from the anchor? Their other
 * ends are end[k][1]. */
static const char *find_chord_fault(const vec *anchor, const vec *const end[2][2], const vec chord[2])
{
    if (vec_side(anchor, end[0][0], end[0][1]) != -vec_side(anchor, end[1][0], end[1][1]))
        return "two sides on the same side of the ray through their corner";
    for (size_t k = 0; k < 2; k++)
        if (!is_shaded_end(anchor, end[k][0], end[k][1], &chord[k])) return "an end of a chord is in no side's shadow";
    for (size_t k = 0; k < 2; k++)
        if (!is_passed_beyond(chord, anchor, end[k][0])) return "a chord before the corner";
    return NULL;
}

/* A side of each of two barriers, each with an end on one ray from the anchor, and a chord from the shadow of one to
 * that of the other. */
static const char *check_chord(const checking *c, const sunder_proof_node *node)
{
    const double *side = c->proof->corner + 2 * node->sides;
    const char *wrong = check_side_of(c, node, node->b, side);
    if (!wrong) wrong = check_side_of(c, node, node->c, side + 4);
    if (wrong) return wrong;
    vec anchor, at[4], chord[2];
    vec_init(&anchor);
    vec_set_d(&anchor, c->proof->corner + 2 * node->part_a);
    for (size_t k = 0; k < 4; k++) vec_init(&at[k]), vec_set_d(&at[k], side + 2 * k);
    for (size_t k = 0; k < 2; k++) vec_init(&chord[k]), vec_set_d(&chord[k], c->proof->corner + 2 * (node->part_b + k));
    wrong = "sides that share no corner, nor a ray from the anchor";
    for (size_t k = 0; k < 4 && wrong; k++) {
        const size_t i = k / 2, j = k % 2;
        const vec *const end[2][2] = {{&at[i], &at[1 - i]}, {&at[2 + j], &at[3 - j]}};
        if (are_on_one_ray(&anchor, end[0][0], end[1][0])) wrong = find_chord_fault(&anchor, end, chord);
    }
    vec_clear(&anchor);
    for (size_t k = 0; k < 4; k++) vec_clear(&at[k]);
    for (size_t k = 0; k < 2; k++) vec_clear(&chord[k]);
    return wrong;
}

static const char *check_side(const checking *c, const sunder_proof_node *node)
{
    if (node->chord) return check_chord(c, node);
    return check_side_of(c, node, node->b, c->proof->corner + 2 * node->part_b);
}

/* A part of a feature, and the anchor of another one. */
static const char *check_jump(const checking *c, const sunder_proof_node *node)
{
    const double *a = c->proof->corner + 2 * node->part_a, *b = c->proof->corner + 2 * node->part_b;
    const bool of_a = node->corners_a == 1;
    if (of_a == (node->corners_b == 1)) return "a shadow without an anchor";
    const proof_feature *f = &c->feature[of_a ? node->a : node->b], *g = &c->feature[of_a ? node->b : node->a];
    const double *part = of_a ? b : a;
    const size_t n = of_a ? node->corners_b : node->corners_a;
    if (!is_convex_part(part, n) || !is_part_of(part, n, g))
        return "the part that casts a shadow is not inside its feature";
    return check_anchor(f, g, of_a ? a : b);
}

const char *proof_check_shadow(const checking *c, const sunder_proof_node *node)
{
    const char *wrong = node->b >= c->n ? check_side(c, node) : check_jump(c, node);
    if (wrong) return wrong;
    hull k = hull_difference(c->proof->corner + 2 * node->part_a, node->corners_a, c->proof->corner + 2 * node->part_b,
                             node->corners_b);
    wrong = check_ways(c, node, &k);
    hull_free(&k);
    return wrong;
}
