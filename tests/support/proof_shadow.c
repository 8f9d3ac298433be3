/* What lies behind all the ways of a node about a shadow is an open convex set that may have no end. It is in the
 * shadow, which is closed and convex, exactly when the corners of the one are in the other, and the directions
 * along its lines in which it has no end lead from the origin through what casts the shadow. */
#include "passage_oracle.h"
#include "proof_checking.h"

/* Is x v in the polygon for some x >= 0, no more than 1 unless `far`? The origin is not in it. */
static bool is_shaded(const hull *k, const vec *v, bool far)
{
    mpq_t low, high, slope, level;
    vec e;
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

/* Never reaches a way, in that direction. */
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
            if (proof_crossing(&way[i], &way[j], &v) && proof_is_behind_all(way, node->ways, &v) &&
                !is_shaded(k, &v, false))
                wrong = "a move that jumps over nothing has no way";
    }
    vec_clear(&v);
    return wrong;
}

/* The anchor is what the library says it is; the other feature does not hold it. */
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
    if (at[0] != anchor[0] || at[1] != anchor[1]) return "an anchor is not its feature's";
    return held ? "an anchor is held by what it may not jump over" : NULL;
}

const char *proof_check_shadow(const checking *c, const sunder_proof_node *node)
{
    const double *a = c->proof->corner + 2 * node->part_a, *b = c->proof->corner + 2 * node->part_b;
    const bool of_a = node->corners_a == 1;
    if (of_a == (node->corners_b == 1)) return "a shadow without an anchor";
    const proof_feature *f = &c->feature[of_a ? node->a : node->b], *g = &c->feature[of_a ? node->b : node->a];
    const double *part = of_a ? b : a;
    const size_t n = of_a ? node->corners_b : node->corners_a;
    if (!is_convex_part(part, n) || !is_part_of(part, n, g)) return "what casts a shadow is not of its feature";
    const char *wrong = check_anchor(f, g, of_a ? a : b);
    if (wrong) return wrong;
    hull k = hull_difference(a, node->corners_a, b, node->corners_b);
    wrong = check_ways(c, node, &k);
    hull_free(&k);
    return wrong;
}
