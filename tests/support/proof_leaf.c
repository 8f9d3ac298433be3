/* Does a leaf contradict the limits? */
#include "proof_checking.h"
#include "rational_plane.h"

#include <stdint.h>
#include <stdlib.h>

bool proof_same_block(const checking *c, size_t a, size_t b)
{
    if (a >= c->n || b >= c->n) return a == b;
    return a == b || (sunder_report_block(c->report, a) >= 0 &&
                      sunder_report_block(c->report, a) == sunder_report_block(c->report, b));
}

double proof_limit_of(const checking *c, size_t f)
{
    double limit = 1e308;
    for (size_t g = 0; g < c->n; g++) {
        if (!proof_same_block(c, f, g)) continue;
        const double own = c->feature[g].fixed ? 0 : c->feature[g].max_shift;
        if (own < limit) limit = own;
    }
    return limit == 1e308 && c->proof->within > 0 ? c->proof->within : limit;
}

/* r is an upper bound of the square root of s >= 0, exact to a share of 2^-200 plus 2^-600. */
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

/* The sum of the leaf's forces, each with its sign for block b; or of the forces on the slack of that node's pair. */
static void sum_net(const checking *c, const sunder_proof_node *leaf, size_t b, const sunder_proof_node *slack,
                    vec *net)
{
    vec n;
    mpq_t f;
    vec_init(&n), mpq_init(f);
    mpq_set_ui(net->x, 0, 1);
    mpq_set_ui(net->y, 0, 1);
    for (size_t k = 0; k < leaf->forces; k++) {
        const sunder_proof_force *force = &c->proof->force[leaf->force + k];
        const sunder_proof_node *node = &c->proof->node[force->node];
        int sign = slack ? node->slack && node->a == slack->a && node->b == slack->b
                         : proof_same_block(c, b, node->b) - proof_same_block(c, b, node->a);
        if (force->behind) sign = -sign;
        if (sign == 0) continue;
        vec_set_d(&n, c->proof->way[force->way].n);
        mpq_set_d(f, sign * force->force);
        mpq_mul(n.x, n.x, f);
        mpq_mul(n.y, n.y, f);
        mpq_add(net->x, net->x, n.x);
        mpq_add(net->y, net->y, n.y);
    }
    vec_clear(&n), mpq_clear(f);
}

static void add_lost(mpq_t lost, const vec *net, double limit)
{
    mpq_t f, most;
    mpq_inits(f, most, NULL);
    vec_dot(f, net, net);
    if (mpq_sgn(f) != 0) {
        root_above(f, f);
        mpq_set_d(most, limit);
        mpq_mul(f, f, most);
        mpq_add(lost, lost, f);
    }
    mpq_clears(f, most, NULL);
}

/* Lists the pairs with slack. A leaf loses most with the longest slack that a node gives for a pair. */
void proof_list_slacks(checking *c)
{
    const sunder_proof *p = c->proof;
    c->slack = calloc(p->nodes, sizeof *c->slack);
    for (size_t k = 0; k < p->nodes; k++) {
        const sunder_proof_node *node = &p->node[k];
        size_t m = 0;
        if (!node->slack) continue;
        while (m < c->slacks && (p->node[c->slack[m].node].a != node->a || p->node[c->slack[m].node].b != node->b)) m++;
        if (m == c->slacks) c->slack[c->slacks++] = (proof_slack){k, 0};
        if (-node->clearance > c->slack[m].longest) c->slack[m].longest = -node->clearance;
    }
}

/* The amount that a leaf loses by the limits: the sum over blocks, each represented by its first member, except the
 * block that cannot move; and over slacks. */
static void sum_lost(const checking *c, const sunder_proof_node *leaf, size_t still, mpq_t lost)
{
    vec net;
    vec_init(&net);
    mpq_set_ui(lost, 0, 1);
    for (size_t b = 0; b < c->n; b++) {
        bool first = true;
        for (size_t g = 0; g < b && first; g++) first = !proof_same_block(c, b, g);
        if (!first || (still != SIZE_MAX && proof_same_block(c, b, still))) continue;
        sum_net(c, leaf, b, NULL, &net);
        add_lost(lost, &net, proof_limit_of(c, b));
    }
    for (size_t k = 0; k < c->slacks; k++) {
        sum_net(c, leaf, 0, &c->proof->node[c->slack[k].node], &net);
        add_lost(lost, &net, c->slack[k].longest);
    }
    vec_clear(&net);
}

/* Does m.u > h follow from the force, not only m.u >= h? Sides of barriers are closed: what is not in their shadow is
 * strictly beyond a line. What is behind a line of anything else is not on it. */
static bool is_strict(const checking *c, const sunder_proof_force *force)
{
    const sunder_proof_node *node = &c->proof->node[force->node];
    const bool closed = node->shadow && node->b >= c->n;
    return force->behind != closed;
}

const char *proof_check_leaf(const checking *c, const sunder_proof_node *leaf, size_t depth)
{
    mpq_t won, lost, f, d;
    mpq_inits(won, lost, f, d, NULL);
    size_t still = SIZE_MAX;
    bool strict = false;
    const char *wrong = leaf->still ? proof_check_still(c, leaf, depth, &still) : NULL;
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
        strict = strict || is_strict(c, force);
    }
    sum_lost(c, leaf, still, lost);
    const int more = mpq_cmp(won, lost);
    if (!wrong && (more < 0 || (more == 0 && !strict))) wrong = "a leaf is no contradiction";
    mpq_clears(won, lost, f, d, NULL);
    return wrong;
}
