/* Conflicts beside barriers with the reasons no_room and side: independent code (support/proof_check.c) verifies each
 * proof in rationals, and refuses false statements about shadows and chords. */
#include "proof_town.h"
#include "random.h"
#include "sunder_proof.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* ---- Beside barriers -------------------------------------------------------------------------------------------- */

static double quarters(rng *r, int64_t low, int64_t high) { return (double)rng_int(r, 4 * low, 4 * high) / 4; }

/* A box, a triangle or a slanted quadrangle. They are convex, for which the depth of a line inside is defined. */
static void add_convex(rng *r, proof_town *t, double x, double y, double limit)
{
    const double w = quarters(r, 2, 6), h = quarters(r, 2, 6), lean = quarters(r, 0, 1);
    const double box[] = {x, y, x + w, y, x + w, y + h, x, y + h};
    const double quad[] = {x, y, x + w, y + lean, x + w + lean, y + h + lean, x + lean, y + h};
    const double three[] = {x, y, x + w, y + lean, x + lean, y + h};
    switch (rng_int(r, 0, 2)) {
    case 0: proof_town_add(t, box, 4, limit); break;
    case 1: proof_town_add(t, quad, 4, limit); break;
    default: proof_town_add(t, three, 3, limit); break;
    }
}

static void add_some_barrier(rng *r, proof_town *t, double x, double y, double wide)
{
    const double p = x + quarters(r, 0, (int64_t)wide), q = y + quarters(r, 0, (int64_t)wide);
    const double u = quarters(r, -12, 12), v = quarters(r, -12, 12), width = quarters(r, 0, 2), gap = quarters(r, 0, 1);
    const double line[] = {p, q, p + u, q + v}, area[] = {p, q, p + 2, q, p + 2, q + 1.5, p, q + 1.5};
    const size_t corners = (size_t)rng_int(r, 1, 3);
    proof_town_add_barrier(t, corners == 3 ? area : line,
                           corners == 3       ? 4
                           : u == 0 && v == 0 ? 1
                                              : corners,
                           width, gap, rng_once_in(r, 2));
}

/* Houses among lines, points and areas that are too near to them, or cut them; half of the barriers have sides. */
static void check_beside_barriers(void **state)
{
    (void)state;
    size_t proved = 0, open = 0, of_barriers = 0, slack = 0, sides = 0;
    const size_t trials = test_count(100);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        proof_town t;
        memset(&t, 0, sizeof t);
        t.gap = quarters(&r, 0, 1);
        t.blocks = rng_once_in(&r, 3);
        const size_t n = (size_t)rng_int(&r, 2, 8), barriers = (size_t)rng_int(&r, 1, 4);
        const double wide = 10, limit = (double)rng_int(&r, 1, 16) / 8, origin = floor(pow(10, 6 * rng_unit(&r)));
        while (t.n < n)
            add_convex(&r, &t, origin + quarters(&r, 0, (int64_t)wide), origin + quarters(&r, 0, (int64_t)wide),
                       rng_once_in(&r, 6) ? 0 : limit);
        for (size_t k = 0; k < barriers; k++) add_some_barrier(&r, &t, origin, origin, wide);
        sunder_report *report = proof_town_separate(&t);
        proved += proof_town_check(&t, report, trial, &open);
        size_t c;
        const sunder_conflict *listed = sunder_report_conflicts(report, &c);
        for (size_t k = 0; k < c; k++) {
            const sunder_proof *proof = sunder_report_proof(report, k);
            of_barriers += proof && listed[k].b >= t.n;
            for (size_t m = 0; proof && m < proof->nodes; m++) {
                slack += proof->node[m].slack;
                sides += proof->node[m].shadow;
            }
        }
        sunder_report_free(report);
        proof_town_free(&t);
    }
    print_message("%zu with a proof, %zu of them with barriers, %zu nodes with slack, %zu about sides, %zu without\n",
                  proved, of_barriers, slack, sides, open);
    assert_true(of_barriers > trials / 8 && sides > trials / 50);
}

/* Enlarges, in the proof of conflict k, each region that a side is said to exclude: the proof has to be refused. */
static void check_refused(const proof_town *t, const sunder_report *report, size_t trial, size_t k)
{
    const sunder_proof *p = sunder_report_proof(report, k);
    for (size_t m = 0; p && m < p->nodes; m++) {
        if (!p->node[m].shadow) continue;
        sunder_proof_way *way = (sunder_proof_way *)p->way + p->node[m].way;
        double was[64];
        for (size_t w = 0; w < p->node[m].ways && w < 64; w++) {
            was[w] = way[w].d;
            way[w].d += ldexp(1, -10);
        }
        const char *wrong = proof_check(t->plain, t->n, t->n + t->barriers, t->gap, report, k);
        if (!wrong)
            fail_msg("trial %zu: the proof of conflict %zu is accepted although its regions were enlarged", trial, k);
        for (size_t w = 0; w < p->node[m].ways && w < 64; w++) way[w].d = was[w];
    }
}

/* A house with a line through it, near the edge at which it could leave if the line had no sides. A fixed house, or
 * another line or area with sides, leaves it too little room on the other side. */
static void check_beside_sides(void **state)
{
    (void)state;
    size_t proved = 0, open = 0, sides = 0, alone = 0;
    const size_t trials = test_count(60);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        proof_town t;
        memset(&t, 0, sizeof t);
        t.gap = quarters(&r, 0, 1);
        const double x = floor(pow(10, 6 * rng_unit(&r))), lean = quarters(&r, 0, 4), off = quarters(&r, 0, 1);
        const double line[] = {x + 3.25 - lean, x - 30, x + 3.25 + lean, x + 34};
        const double other[] = {x - off, x - 30, x - off, x + 34};
        const double area[] = {x - off - 2, x - 30, x - off, x - 30, x - off, x + 34, x - off - 2, x + 34};
        const int beyond = (int)rng_int(&r, 0, 2);
        proof_town_add_box(&t, x, x, 4, 4, quarters(&r, 4, 6));
        if (beyond == 0) proof_town_add_box(&t, x - off - 8, x - 30, 8, 64, 0);
        proof_town_add_barrier(&t, line, 2, 0, t.gap, true);
        if (beyond == 1) proof_town_add_barrier(&t, other, 2, 0, t.gap, true);
        if (beyond == 2) proof_town_add_barrier(&t, area, 4, 0, t.gap, true);
        sunder_report *report = proof_town_separate(&t);
        proved += proof_town_check(&t, report, trial, &open);
        size_t c;
        const sunder_conflict *listed = sunder_report_conflicts(report, &c);
        for (size_t k = 0; k < c; k++) {
            const sunder_proof *proof = sunder_report_proof(report, k);
            check_refused(&t, report, trial, k);
            alone += listed[k].reason == SUNDER_REASON_SIDE;
            for (size_t m = 0; proof && m < proof->nodes; m++) sides += proof->node[m].shadow;
        }
        sunder_report_free(report);
        proof_town_free(&t);
    }
    print_message("%zu with a proof, %zu of them of the pair by itself, %zu nodes about sides, %zu without\n", proved,
                  alone, sides, open);
    assert_true(sides > trials / 4 && 10 * open <= proved);
}

/* False chords: nearer to the anchor than the corner, with one side given twice, or with both ends in one shadow. Each
 * has to be refused. */
static void check_chord_refused(const proof_town *t, const sunder_report *report, size_t trial, size_t k)
{
    const sunder_proof *p = sunder_report_proof(report, k);
    double *corner = (double *)p->corner; /* the report's own copy, which may be changed */
    for (size_t m = 0; m < p->nodes; m++) {
        const sunder_proof_node *node = &p->node[m];
        if (!node->chord) continue;
        double *anchor = corner + 2 * node->part_a, *chord = corner + 2 * node->part_b,
               *side = corner + 2 * node->sides, was[12];
        for (int untruth = 0; untruth < 3; untruth++) {
            memcpy(was, chord, 4 * sizeof *was);
            memcpy(was + 4, side, 8 * sizeof *was);
            for (size_t c = 0; c < 4 && untruth == 0; c++) chord[c] += (anchor[c & 1] - chord[c]) / 16;
            if (untruth == 1) memcpy(side + 4, side, 4 * sizeof *side);
            if (untruth == 2) memcpy(chord + 2, chord, 2 * sizeof *chord);
            if (!proof_check(t->plain, t->n, t->n + t->barriers, t->gap, report, k))
                fail_msg("trial %zu: false statement %d about a chord of conflict %zu is accepted", trial, untruth, k);
            memcpy(chord, was, 4 * sizeof *was);
            memcpy(side, was + 4, 8 * sizeof *was);
        }
    }
}

/* A house between two walls that require more distance than there is, each made of two lines that meet where the house
 * would have to pass, or of one line with a bend there. */
static void check_corners_of_sides(void **state)
{
    (void)state;
    size_t proved = 0, open = 0, chords = 0;
    const size_t trials = test_count(40);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        proof_town t;
        memset(&t, 0, sizeof t);
        t.gap = quarters(&r, 8, 12);
        const double x = floor(pow(10, 6 * rng_unit(&r)));
        proof_town_add_box(&t, x, x, 2, quarters(&r, 7, 9), quarters(&r, 36, 44));
        for (int k = -1; k < 2; k += 2) {
            const double bend[2] = {x + 1 + quarters(&r, -6, 6) + ldexp(1, -5), x + 1 + 3.5 * k + quarters(&r, -1, 1)};
            const double wall[6] = {x - 60, bend[1] + quarters(&r, -4, 4), bend[0], bend[1],
                                    x + 62, bend[1] + quarters(&r, -4, 4)};
            if (trial % 2) {
                proof_town_add_barrier(&t, wall, 2, 0, t.gap, true);
                proof_town_add_barrier(&t, wall + 2, 2, 0, t.gap, true);
            } else {
                proof_town_add_barrier(&t, wall, 3, 0, t.gap, true);
            }
        }
        sunder_report *report = proof_town_separate(&t);
        proved += proof_town_check(&t, report, trial, &open);
        size_t c;
        sunder_report_conflicts(report, &c);
        for (size_t k = 0; k < c; k++) {
            const sunder_proof *proof = sunder_report_proof(report, k);
            for (size_t m = 0; proof && m < proof->nodes; m++) chords += proof->node[m].chord;
            if (proof) check_chord_refused(&t, report, trial, k);
        }
        sunder_report_free(report);
        proof_town_free(&t);
    }
    print_message("%zu with a proof, %zu nodes about chords, %zu without\n", proved, chords, open);
    assert_true(chords > trials && 10 * open <= proved);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_beside_barriers), cmocka_unit_test(check_beside_sides),
                                       cmocka_unit_test(check_corners_of_sides)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
