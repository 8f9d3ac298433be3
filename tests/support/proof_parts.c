/* Are the parts that a proof is about convex, and inside their features? */
#include "proof_checking.h"
#include "rational_plane.h"

bool is_convex_part(const double *xy, size_t n)
{
    vec p[3];
    bool convex = n > 2;
    for (int k = 0; k < 3; k++) vec_init(&p[k]);
    /* Every other corner is on the left of every side, so the ring winds once and not twice. */
    for (size_t k = 0; k < n && convex; k++)
        for (size_t m = 0; m < n && convex; m++) {
            const size_t next = (k + 1) % n;
            if (m == k || m == next) continue;
            vec_set_d(&p[0], xy + 2 * k);
            vec_set_d(&p[1], xy + 2 * next);
            vec_set_d(&p[2], xy + 2 * m);
            convex = vec_side(&p[0], &p[1], &p[2]) > 0;
        }
    for (int k = 0; k < 3; k++) vec_clear(&p[k]);
    return convex;
}

/* Does the segment run through the interior of the convex polygon? Clips it by all sides. */
static bool enters(const double *p, const double *q, const double *xy, size_t n)
{
    mpq_t low, high, sp, sq, cut;
    vec a, b, e, w;
    mpq_inits(low, high, sp, sq, cut, NULL);
    vec_init(&a), vec_init(&b), vec_init(&e), vec_init(&w);
    mpq_set_ui(high, 1, 1);
    bool in = true;
    for (size_t k = 0; k < n && in; k++) {
        vec_set_d(&a, xy + 2 * k);
        vec_set_d(&b, xy + 2 * ((k + 1) % n));
        vec_sub(&e, &b, &a);
        vec_set_d(&b, p);
        vec_sub(&w, &b, &a);
        vec_cross(sp, &e, &w);
        vec_set_d(&b, q);
        vec_sub(&w, &b, &a);
        vec_cross(sq, &e, &w);
        if (mpq_sgn(sp) <= 0 && mpq_sgn(sq) <= 0) in = false;
        if (!in || mpq_equal(sp, sq)) continue;
        mpq_sub(cut, sp, sq);
        mpq_div(cut, sp, cut); /* where it crosses the side's line */
        if (mpq_cmp(sp, sq) < 0 ? mpq_cmp(cut, low) > 0 : mpq_cmp(cut, high) < 0)
            mpq_set(mpq_cmp(sp, sq) < 0 ? low : high, cut);
    }
    in = in && mpq_cmp(low, high) < 0;
    mpq_clears(low, high, sp, sq, cut, NULL);
    vec_clear(&a), vec_clear(&b), vec_clear(&e), vec_clear(&w);
    return in;
}

/* Is the centroid of the part's first three corners in the polygon? By a ray to the right. */
static bool holds_middle(const proof_feature *f, const double *part)
{
    vec m, p, q;
    bool in = false;
    mpq_t third;
    vec_init(&m), vec_init(&p), vec_init(&q), mpq_init(third);
    for (int k = 0; k < 3; k++) {
        vec_set_d(&p, part + 2 * k);
        mpq_add(m.x, m.x, p.x);
        mpq_add(m.y, m.y, p.y);
    }
    mpq_set_ui(third, 1, 3);
    mpq_mul(m.x, m.x, third);
    mpq_mul(m.y, m.y, third);
    for (size_t k = 0; k < f->corners; k++) {
        vec_set_d(&p, f->xy + 2 * k);
        vec_set_d(&q, f->xy + 2 * ((k + 1) % f->corners));
        const bool up = mpq_cmp(p.y, m.y) > 0, uq = mpq_cmp(q.y, m.y) > 0;
        if (up != uq && vec_side(&p, &q, &m) * (uq ? 1 : -1) > 0) in = !in;
    }
    vec_clear(&m), vec_clear(&p), vec_clear(&q), mpq_clear(third);
    return in;
}

bool is_part_of(const double *part, size_t n, const proof_feature *f)
{
    for (size_t k = 0; k < f->corners; k++)
        if (enters(f->xy + 2 * k, f->xy + 2 * ((k + 1) % f->corners), part, n)) return false;
    return holds_middle(f, part);
}
