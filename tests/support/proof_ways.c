/* Do the ways of a node cover every place that keeps the clearance? */
#include "proof_checking.h"

/* Is there a direction in which no way is ever reached? If so, there is one along the line of a way. */
static bool is_open(const sunder_proof_way *way, size_t n)
{
    vec w, m;
    mpq_t d;
    bool open = false;
    vec_init(&w), vec_init(&m), mpq_init(d);
    for (size_t k = 0; k < n && !open; k++)
        for (int turn = -1; turn < 2 && !open; turn += 2) {
            const double along[2] = {-turn * way[k].n[1], turn * way[k].n[0]};
            vec_set_d(&w, along);
            open = true;
            for (size_t m_at = 0; m_at < n && open; m_at++) {
                vec_set_d(&m, way[m_at].n);
                vec_dot(d, &m, &w);
                open = mpq_sgn(d) <= 0;
            }
        }
    vec_clear(&w), vec_clear(&m), mpq_clear(d);
    return open;
}

static void level_of(mpq_t d, const sunder_proof_way *way, const mpq_t *exact)
{
    if (exact)
        mpq_set(d, *exact);
    else
        mpq_set_d(d, way->d);
}

void proof_farthest(mpq_t d, const hull *k, const sunder_proof_way *way)
{
    vec n;
    mpq_t own;
    vec_init(&n), mpq_init(own);
    vec_set_d(&n, way->n);
    for (size_t m = 0; m < k->n; m++) {
        vec_dot(own, &n, &k->v[m]);
        if (m == 0 || mpq_cmp(own, d) > 0) mpq_set(d, own);
    }
    vec_clear(&n), mpq_clear(own);
}

bool proof_crossing(const sunder_proof_way *a, const mpq_t *exact, const sunder_proof_way *b, vec *v)
{
    vec m, n;
    mpq_t det, d, e, f;
    vec_init(&m), vec_init(&n), mpq_inits(det, d, e, f, NULL);
    vec_set_d(&m, a->n);
    vec_set_d(&n, b->n);
    vec_cross(det, &m, &n);
    const bool any = mpq_sgn(det) != 0;
    if (any) {
        level_of(d, a, exact);
        mpq_set_d(e, b->d);
        mpq_mul(v->x, d, n.y);
        mpq_mul(f, e, m.y);
        mpq_sub(v->x, v->x, f);
        mpq_div(v->x, v->x, det);
        mpq_mul(v->y, e, m.x);
        mpq_mul(f, d, n.x);
        mpq_sub(v->y, v->y, f);
        mpq_div(v->y, v->y, det);
    }
    vec_clear(&m), vec_clear(&n), mpq_clears(det, d, e, f, NULL);
    return any;
}

bool proof_is_behind_all(const sunder_proof_way *way, const mpq_t *first, size_t n, const vec *v)
{
    vec m;
    mpq_t s, d;
    bool behind = true;
    vec_init(&m), mpq_inits(s, d, NULL);
    for (size_t k = 0; k < n && behind; k++) {
        vec_set_d(&m, way[k].n);
        level_of(d, &way[k], k == 0 ? first : NULL);
        vec_dot(s, &m, v);
        behind = mpq_cmp(s, d) <= 0;
    }
    vec_clear(&m), mpq_clears(s, d, NULL);
    return behind;
}

/* The set behind all ways, an open convex polygon, has to be in conflict: its corners are within the clearance of the
 * parts' difference or, inside, deeper in it than that. */
const char *proof_check_ways(const checking *c, const sunder_proof_node *node, bool inside, const mpq_t most)
{
    const sunder_proof *p = c->proof;
    const sunder_proof_way *way = p->way + node->way;
    if (is_open(way, node->ways)) return "the ways do not cover all directions";
    const double *a = p->corner + 2 * node->part_a, *b = p->corner + 2 * node->part_b;
    hull k = hull_difference(a, node->corners_a, b, node->corners_b);
    const char *wrong = NULL;
    vec v;
    mpq_t d, h;
    vec_init(&v), mpq_inits(d, h, NULL);
    const mpq_t *first = node->slack && node->held ? (const mpq_t *)&h : NULL;
    proof_farthest(h, &k, &way[0]);
    mpq_set_d(d, way[0].d);
    if (first && mpq_cmp(d, h) > 0) wrong = "a line beyond where the parts let go of each other";
    for (size_t i = 0; i < node->ways && !wrong; i++)
        for (size_t j = i + 1; j < node->ways && !wrong; j++) {
            if (!proof_crossing(&way[i], i == 0 ? first : NULL, &way[j], &v) ||
                !proof_is_behind_all(way, first, node->ways, &v))
                continue;
            if (inside) {
                if (!hull_holds_disc(&k, &v, most)) wrong = "no way leads to a move that makes the pair no worse";
                continue;
            }
            hull_square_from(d, &k, &v);
            if (mpq_cmp(d, most) > 0) wrong = "no way leads to a move that keeps the clearance";
        }
    vec_clear(&v), mpq_clears(d, h, NULL);
    hull_free(&k);
    return wrong;
}
