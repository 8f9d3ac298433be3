/* Is a block between two lines unable to move? Proved by the lattice of moves for which all of its corners remain
 * doubles. */
#include "proof_checking.h"

#include <math.h>
#include <stdint.h>

/* The line of a way: the moving feature, and the normal in terms of its move. */
typedef struct line {
    size_t feature;
    vec n;
} line;

/* Is it the node's first way, which no slack is long enough to reach by itself? */
static bool is_far_line(const checking *c, const sunder_proof_node *node, size_t way)
{
    mpq_t least, h, square;
    vec n;
    bool meet;
    if (!node->held || way != node->way) return false;
    mpq_inits(least, h, square, NULL), vec_init(&n);
    hull k = hull_difference(c->proof->corner + 2 * node->part_a, node->corners_a, c->proof->corner + 2 * node->part_b,
                             node->corners_b);
    proof_farthest(h, &k, &c->proof->way[way]);
    vec_set_d(&n, c->proof->way[way].n);
    vec_dot(square, &n, &n);
    bool far = proof_find_standing(&c->feature[node->a], &c->feature[node->b], &meet, least) && meet && mpq_sgn(h) > 0;
    mpq_mul(square, square, least);
    mpq_mul(h, h, h);
    far = far && mpq_cmp(h, square) >= 0;
    hull_free(&k);
    mpq_clears(least, h, square, NULL), vec_clear(&n);
    return far;
}

static const char *take_line(const checking *c, const sunder_proof_node *leaf, size_t k, size_t depth, line *out)
{
    size_t level = 0;
    while (level < depth && c->path_node[level] != leaf->line_node[k]) level++;
    if (level == depth || c->path_way[level] != leaf->line_way[k]) return "a line is not on the path to the leaf";
    const sunder_proof_node *node = &c->proof->node[leaf->line_node[k]];
    const sunder_proof_way *way = &c->proof->way[leaf->line_way[k]];
    if (node->slack ? !is_far_line(c, node, leaf->line_way[k]) : way->d != 0)
        return "a line does not pass through the original places of the two";
    const bool a = node->a < c->n && proof_limit_of(c, node->a) > 0,
               b = node->b < c->n && proof_limit_of(c, node->b) > 0;
    if (a == b) return "a line between two movable or two fixed blocks";
    const double n[2] = {a ? -way->n[0] : way->n[0], a ? -way->n[1] : way->n[1]};
    out->feature = a ? node->a : node->b;
    vec_set_d(&out->n, n);
    return NULL;
}

/* The exponent of the unit of one coordinate of the block; false: the coordinate may get another binary exponent. */
static bool find_unit(const checking *c, size_t feature, size_t x, double limit, int *unit)
{
    bool any = false, same = true;
    for (size_t f = 0; f < c->n && same; f++)
        for (size_t k = 0; k < c->feature[f].corners && same && proof_same_block(c, f, feature); k++)
            for (int end = -1; end < 2 && same; end += 2) {
                const double at = c->feature[f].xy[2 * k + x], sum = at + end * limit;
                /* Rounding may carry it up to the power of two, and not beyond. */
                same = isfinite(sum) && sum != 0 && (sum > 0) == (at > 0) && (!any || ilogb(sum) == *unit) &&
                       fabs(sum) != ldexp(1, ilogb(sum));
                if (same) *unit = ilogb(sum);
                any = true;
            }
    *unit -= 52;
    return any && same;
}

/* Let t be i and j units with n.t = 0. Then i and j are multiples of q and -p divided by their greatest common divisor,
 * where p and q are the coordinates of n in units, as integers. Is the shortest such t longer than the limit? */
static bool is_far(const vec *n, const int unit[2], double limit)
{
    mpq_t p, q, whole, square;
    mpz_t share;
    mpq_inits(p, q, whole, square, NULL), mpz_init(share);
    mpq_set_d(p, ldexp(1, unit[0]));
    mpq_set_d(q, ldexp(1, unit[1]));
    mpq_mul(p, p, n->x);
    mpq_mul(q, q, n->y);
    mpz_mul(mpq_numref(whole), mpq_denref(p), mpq_denref(q));
    mpq_mul(p, p, whole);
    mpq_mul(q, q, whole);
    mpz_gcd(share, mpq_numref(p), mpq_numref(q));
    mpz_divexact(mpq_numref(p), mpq_numref(p), share);
    mpz_divexact(mpq_numref(q), mpq_numref(q), share);
    mpq_set_d(whole, ldexp(1, unit[1]));
    mpq_mul(p, p, whole);
    mpq_set_d(whole, ldexp(1, unit[0]));
    mpq_mul(q, q, whole);
    mpq_mul(p, p, p);
    mpq_mul(q, q, q);
    mpq_add(square, p, q);
    mpq_set_d(whole, limit);
    mpq_mul(whole, whole, whole);
    const bool far = mpq_cmp(square, whole) > 0;
    mpq_clears(p, q, whole, square, NULL), mpz_clear(share);
    return far;
}

const char *proof_check_still(const checking *c, const sunder_proof_node *leaf, size_t depth, size_t *first)
{
    line l[2];
    int unit[2];
    mpq_t cross, dot;
    vec_init(&l[0].n), vec_init(&l[1].n), mpq_inits(cross, dot, NULL);
    const char *wrong = take_line(c, leaf, 0, depth, &l[0]);
    if (!wrong) wrong = take_line(c, leaf, 1, depth, &l[1]);
    if (!wrong) {
        const double limit = proof_limit_of(c, l[0].feature);
        vec_cross(cross, &l[0].n, &l[1].n);
        vec_dot(dot, &l[0].n, &l[1].n);
        if (!proof_same_block(c, l[0].feature, l[1].feature) || mpq_sgn(cross) != 0 || mpq_sgn(dot) >= 0)
            wrong = "two lines are not opposite to each other, or of two blocks";
        else if (!find_unit(c, l[0].feature, 0, limit, &unit[0]) || !find_unit(c, l[0].feature, 1, limit, &unit[1]))
            wrong = "a coordinate may leave its binade";
        else if (mpq_sgn(l[0].n.x) == 0 || mpq_sgn(l[0].n.y) == 0 || !is_far(&l[0].n, unit, limit))
            wrong = "there is another place on the line";
        *first = l[0].feature;
    }
    vec_clear(&l[0].n), vec_clear(&l[1].n), mpq_clears(cross, dot, NULL);
    return wrong;
}
