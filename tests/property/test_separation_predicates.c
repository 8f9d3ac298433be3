/* Overlap, containment, the gap and the distance of random pairs, with and without translations, compared with slabs in
 * rationals and plain enumeration. */
#include "generate.h"
#include "separation/separation.h"
#include "slabs.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

static void complain(const char *what, const polyset *p, const polyset *q)
{
    char *a = polyset_wkt(p), *b = polyset_wkt(q);
    print_error("%s\n%s\n%s\n", what, a, b);
    free(a);
    free(b);
    fail();
}

static double point_side(const double *v, const double *a, const double *b)
{
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    double t = ((v[0] - a[0]) * dx + (v[1] - a[1]) * dy) / (dx * dx + dy * dy);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(v[0] - a[0] - t * dx, v[1] - a[1] - t * dy);
}

/* Least distance of a vertex of p from an edge of q: together with the reverse, the distance of sets whose interiors
 * are disjoint. */
static double vertices_to_edges(const polyset *p, const polyset *q)
{
    double least = INFINITY;
    for (size_t i = 0; i < p->vertices; i++)
        for (size_t r = 0, v = 0; r < q->rings; r++) {
            const size_t first = v, end = q->ring_end[r];
            for (; v < end; v++)
                least =
                    fmin(least, point_side(p->xy + 2 * i, q->xy + 2 * v, q->xy + 2 * (v + 1 < end ? v + 1 : first)));
        }
    return least;
}

static void check_distance(const polyset *p, const polyset *q, const sunder_shape *a, const sunder_shape *b, bool meet)
{
    double d, on_p[2], on_q[2];
    assert_int_equal(sunder_pair_distance(a, b, &d, on_p, on_q, NULL), SUNDER_OK);
    const double truth = meet ? 0 : fmin(vertices_to_edges(p, q), vertices_to_edges(q, p));
    const double size = 1e-12 * (1 + fabs(p->xy[0]) + fabs(p->xy[1]));
    if (fabs(d - truth) > size + 1e-14 * truth) complain("distance", p, q);
    if ((truth < size) != (d == 0)) complain("zero distance", p, q);
    if (fabs(hypot(on_p[0] - on_q[0], on_p[1] - on_q[1]) - d) > 4 * size) complain("link", p, q);
    if (d == 0) return;
    bool apart;
    assert_int_equal(sunder_pair_apart(a, b, d * (1 - 1e-9), &apart, NULL), SUNDER_OK);
    if (!apart) complain("apart by a little less", p, q);
    assert_int_equal(sunder_pair_apart(a, b, d * (1 + 1e-9), &apart, NULL), SUNDER_OK);
    if (apart) complain("not apart by a little more", p, q);
}

/* Combined questions give the same answers, and never report a touch by mistake. Only the difference of the
 * translations matters. */
static void check_meeting(const polyset *p, const polyset *q, const sunder_shape *a, const sunder_shape *b,
                          const double t[2], bool meet)
{
    double d, on_p[2], on_q[2];
    assert_int_equal(sunder_pair_distance(a, b, &d, on_p, on_q, NULL), SUNDER_OK);
    const double length[] = {0, d / 2, d, nextafter(d, INFINITY), 2 * d, 1, 3};
    for (size_t g = 0; g < sizeof length / sizeof *length; g++)
        for (size_t k = 0; k < sizeof length / sizeof *length; k++) {
            const double gap = length[g], tolerance = length[k];
            sunder_i_encounter m;
            bool apart;
            if (gap > 0 && tolerance >= gap) continue;
            assert_int_equal(sunder_i_meet(a, t, b, t, gap, tolerance, &m, NULL), SUNDER_OK);
            if (m.overlap != meet) complain("overlap, from the combined question", p, q);
            if (meet) continue;
            assert_int_equal(sunder_pair_apart(a, b, gap, &apart, NULL), SUNDER_OK);
            if (m.apart != apart) complain("apart, from the combined question", p, q);
            if (m.touch && d > tolerance) complain("no touch", p, q);
            if (gap > 0 && apart ? m.touch : !m.may_touch && d <= tolerance) complain("a touch", p, q);
            if (tolerance == 0 && m.may_touch != m.touch) complain("an exact touch is reported as uncertain", p, q);
        }
}

typedef struct tally {
    size_t meet, in;
} tally;

static void check_pair(const polyset *p, const polyset *q, rng *r, tally *t)
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    assert_non_null(a);
    assert_non_null(b);
    const bool meet = interiors_meet(p, q, NULL, NULL), in = !escapes(p, q);
    bool answer;
    assert_int_equal(sunder_pair_overlap(a, b, &answer, NULL), SUNDER_OK);
    if (answer != meet) complain("overlap", p, q);
    assert_int_equal(sunder_pair_overlap(b, a, &answer, NULL), SUNDER_OK);
    if (answer != meet) complain("overlap, exchanged", p, q);
    assert_int_equal(sunder_pair_apart(a, b, 0, &answer, NULL), SUNDER_OK);
    if (answer == meet) complain("sets that touch are reported as separate", p, q);
    assert_int_equal(sunder_i_contained(a, NULL, b, NULL, &answer, NULL), SUNDER_OK);
    if (answer != in) complain("contained", p, q);
    check_distance(p, q, a, b, meet);

    /* The same pair, with translations that have the same difference; one of them makes the lattice wide. */
    const double big = rng_once_in(r, 4) ? 0x1p90 : 0, x = (double)rng_int(r, -9, 9) / 8 + big,
                 y = (double)rng_int(r, -9, 9);
    const double t1[2] = {x, y};
    if (sunder_i_overlap(a, t1, b, t1, &answer, NULL) || answer != meet) complain("overlap, translated", p, q);
    if (sunder_i_contained(a, t1, b, t1, &answer, NULL) || answer != in) complain("contained, translated", p, q);
    if (sunder_i_apart(a, t1, b, t1, 0, &answer, NULL) || answer == meet) complain("apart, translated", p, q);
    check_meeting(p, q, a, b, (double[2]){0, 0}, meet);
    check_meeting(p, q, a, b, t1, meet);
    polyset moved;
    polyset_init(&moved);
    polyset_copy(&moved, q);
    const double t2[2] = {(double)rng_int(r, -3, 3), (double)rng_int(r, -3, 3)};
    polyset_move(&moved, t2[0], t2[1]);
    if (sunder_i_overlap(a, NULL, b, t2, &answer, NULL) || answer != interiors_meet(p, &moved, NULL, NULL))
        complain("overlap, moved", p, &moved);
    if (sunder_i_contained(a, NULL, b, t2, &answer, NULL) || answer == escapes(p, &moved))
        complain("contained, moved", p, &moved);
    polyset_free(&moved);
    t->meet += meet;
    t->in += in;
    sunder_shape_free(a);
    sunder_shape_free(b);
}

static const pair_kind KINDS[] = {PAIR_SQUARES, PAIR_STEPS,   PAIR_TRIANGLES, PAIR_TRIANGLE_STEPS, PAIR_PEG,
                                  PAIR_SLIDE,   PAIR_SLANTED, PAIR_SIMPLE,    PAIR_MEMBERS,        PAIR_BOARDS,
                                  PAIR_HOLES,   PAIR_ROOMS,   PAIR_SELF};

static bool small_integers(const polyset *s)
{
    for (size_t i = 0; i < 2 * s->vertices; i++)
        if (s->xy[i] != floor(s->xy[i]) || fabs(s->xy[i]) > 4096) return false;
    return s->polygons <= 64;
}

static void predicates_agree(void **state)
{
    const uint64_t seed = test_seed();
    const size_t rounds = test_count(1500);
    tally t = {0, 0};
    size_t done = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; i < rounds; i++) {
        rng r = rng_start(seed, i);
        polyset p, q;
        random_pair(&p, &q, &r, KINDS[i % (sizeof KINDS / sizeof *KINDS)]);
        polyset_negate(&q);
        bring_together(&p, &q, &r);
        if (rng_once_in(&r, 3)) polyset_append(&q, &p); /* then P certainly lies in Q */
        if (rng_once_in(&r, 9)) polyset_move(&q, (double)rng_int(&r, -1, 1), 0);
        if (small_integers(&p) && small_integers(&q)) {
            check_pair(&p, &q, &r, &t);
            done++;
        }
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("%zu pairs, %zu overlap, %zu contained\n", done, t.meet, t.in);
    assert_true(t.meet > 0 && t.meet < done && t.in > 0 && t.in < t.meet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(predicates_agree)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
