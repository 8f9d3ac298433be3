/* Does a leaf contradict the limits? */
#include "proof_checking.h"
#include "rational_plane.h"

bool proof_same_block(const checking *c, size_t a, size_t b)
{
    return a == b || (sunder_report_block(c->report, a) >= 0 &&
                      sunder_report_block(c->report, a) == sunder_report_block(c->report, b));
}

static double limit_of(const checking *c, size_t f)
{
    double limit = 1e308;
    for (size_t g = 0; g < c->n; g++) {
        if (!proof_same_block(c, f, g)) continue;
        const double own = c->feature[g].fixed ? 0 : c->feature[g].max_shift;
        if (own < limit) limit = own;
    }
    return limit == 1e308 && c->proof->within > 0 ? c->proof->within : limit;
}

/* r = at least the square root of s >= 0, by a share of 2^-200 at most and 2^-600. */
static void root_above(mpq_t r, const mpq_t s)
{
    mpz_t n;
    mpz_init(n);
    mpz_mul_2exp(n, mpq_numref(s), 1200);
    mpz_cdiv_q(n, n, mpq_denref(s));
    mpz_sqrt(n, n);
    mpz_add_ui(n, n, 1);
    mpq_set_z(r, n);
    mpq_div_2exp(r, r, 600);
    mpz_clear(n);
}

/* What the limits lose of a leaf: the sum over blocks, each by its first member. */
static void sum_lost(const checking *c, const sunder_proof_node *leaf, mpq_t lost)
{
    vec net, n;
    mpq_t f, limit;
    vec_init(&net), vec_init(&n), mpq_inits(f, limit, NULL);
    mpq_set_ui(lost, 0, 1);
    for (size_t b = 0; b < c->n; b++) {
        bool first = true;
        for (size_t g = 0; g < b && first; g++) first = !proof_same_block(c, b, g);
        if (!first) continue;
        mpq_set_ui(net.x, 0, 1);
        mpq_set_ui(net.y, 0, 1);
        for (size_t k = 0; k < leaf->forces; k++) {
            const sunder_proof_force *force = &c->proof->force[leaf->force + k];
            const sunder_proof_node *node = &c->proof->node[force->node];
            const int sign =
                (proof_same_block(c, b, node->b) - proof_same_block(c, b, node->a)) * (force->behind ? -1 : 1);
            if (sign == 0) continue;
            vec_set_d(&n, c->proof->way[force->way].n);
            mpq_set_d(f, sign * force->force);
            mpq_mul(n.x, n.x, f);
            mpq_mul(n.y, n.y, f);
            mpq_add(net.x, net.x, n.x);
            mpq_add(net.y, net.y, n.y);
        }
        vec_dot(f, &net, &net);
        if (mpq_sgn(f) == 0) continue;
        root_above(f, f);
        mpq_set_d(limit, limit_of(c, b));
        mpq_mul(f, f, limit);
        mpq_add(lost, lost, f);
    }
    vec_clear(&net), vec_clear(&n), mpq_clears(f, limit, NULL);
}

const char *proof_check_leaf(const checking *c, const sunder_proof_node *leaf, size_t depth)
{
    mpq_t won, lost, f, d;
    mpq_inits(won, lost, f, d, NULL);
    const char *wrong = NULL;
    for (size_t k = 0; k < leaf->forces && !wrong; k++) {
        const sunder_proof_force *force = &c->proof->force[leaf->force + k];
        size_t level = 0;
        while (level < depth && c->path_node[level] != force->node) level++;
        if (level == depth || !(force->force > 0)) {
            wrong = "a force is not on the way, or none";
            break;
        }
        const size_t taken = c->path_way[level], first = c->proof->node[force->node].way;
        if (force->behind ? force->way < first || force->way >= taken : force->way != taken)
            wrong = "a force is on another case";
        mpq_set_d(f, force->force);
        mpq_set_d(d, force->behind ? -c->proof->way[force->way].d : c->proof->way[force->way].d);
        mpq_mul(f, f, d);
        mpq_add(won, won, f);
    }
    sum_lost(c, leaf, lost);
    if (!wrong && mpq_cmp(won, lost) <= 0) wrong = "a leaf is no contradiction";
    mpq_clears(won, lost, f, d, NULL);
    return wrong;
}
