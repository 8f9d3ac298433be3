/* Conflicts that are said to have no room: each proof followed by code of its own (support/proof_check.c), in
 * rationals, and layers whose answer is known, at coordinates far larger than their limits.
 *
 * Planted: boxes that fit exactly, or but for a unit in the last place, and were carried off by as much as the limit:
 * no conflict may be said to have no room. Packed: a lane too narrow by little: all that remains has a proof. */
#include "proof_check.h"
#include "random.h"
#include "run_layer.h"

#include "sunder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 48, CORNERS = 8, BARRIERS = 6 };

typedef struct town {
    double xy[MOST][2 * CORNERS];
    proof_feature plain[MOST]; /* barriers behind the features */
    sunder_feature feature[MOST];
    size_t n;
    sunder_barrier barrier[BARRIERS];
    size_t corners[BARRIERS], barriers;
    double gap;
    bool blocks;
} town;

static sunder_feature *add(town *t, const double *xy, size_t corners, double limit)
{
    const size_t rings = 1;
    sunder_shape *shape = NULL;
    sunder_error err;
    double *own = t->xy[t->n];
    memcpy(own, xy, 2 * corners * sizeof *own);
    if (sunder_shape_from_rings(own, &corners, &rings, 1, SUNDER_VALIDITY_STRICT, &shape, &err))
        fail_msg("%s", err.message);
    t->plain[t->n] = (proof_feature){.xy = own, .corners = corners, .max_shift = limit, .fixed = limit == 0};
    t->feature[t->n] = (sunder_feature){.shape = shape, .weight = 1, .max_shift = limit, .block = -1};
    return &t->feature[t->n++];
}

static sunder_feature *add_box(town *t, double x, double y, double w, double h, double limit)
{
    const double xy[8] = {x, y, x + w, y, x + w, y + h, x, y + h};
    return add(t, xy, 4, limit);
}

/* A line, a point or (four corners) an area, behind all features. width: a dyadic, like the gap. */
static void add_barrier(town *t, const double *xy, size_t corners, double width, double gap, bool sides)
{
    const size_t rings = 1, k = t->barriers++;
    double *own = t->xy[t->n + k];
    sunder_shape *area = NULL;
    sunder_error err;
    memcpy(own, xy, 2 * corners * sizeof *own);
    t->corners[k] = corners;
    t->plain[t->n + k] = (proof_feature){own, corners, 0, true, corners < 4, width / 2 + gap, sides};
    t->barrier[k] = (sunder_barrier){.width = width, .gap = gap, .side = sides};
    if (corners < 4) {
        t->barrier[k].geometry = (sunder_obstacle){.xy = own, .line_end = &t->corners[k], .lines = 1};
        return;
    }
    if (sunder_shape_from_rings(own, &t->corners[k], &rings, 1, SUNDER_VALIDITY_STRICT, &area, &err))
        fail_msg("%s", err.message);
    t->barrier[k].geometry.shape = area;
}

static sunder_report *separate_beside(const town *t, const sunder_layer_options *options)
{
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    assert_int_equal(sunder_layer_new(t->feature, t->n, &layer, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_set_barriers(layer, t->barrier, t->barriers, NULL), SUNDER_OK);
    assert_int_equal(sunder_layer_separate(layer, options, &report, NULL), SUNDER_OK);
    sunder_layer_free(layer);
    return report;
}

static sunder_report *separate(const town *t)
{
    sunder_layer_options options;
    sunder_layer_options_init(&options);
    options.contained = SUNDER_CONTAINMENT_SEPARATE;
    options.no_blocks = !t->blocks;
    options.gap = t->gap;
    options.touch_tolerance = 0;
    options.allow_jumps = t->barriers > 0;
    if (t->barriers) return separate_beside(t, &options);
    return run_separate(t->feature, t->n, &options);
}

static void free_town(town *t)
{
    for (size_t k = 0; k < t->n; k++) sunder_shape_free((sunder_shape *)t->feature[k].shape);
    for (size_t k = 0; k < t->barriers; k++) sunder_shape_free((sunder_shape *)t->barrier[k].geometry.shape);
}

/* How many conflicts have no room, or none on their side, all of them proved; the others have no proof. */
static size_t check_proofs(const town *t, const sunder_report *report, size_t trial, size_t *open)
{
    size_t n, proved = 0;
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++) {
        *open += c[k].reason == SUNDER_REASON_UNRESOLVED;
        if (c[k].reason != SUNDER_REASON_NO_ROOM && c[k].reason != SUNDER_REASON_SIDE) {
            assert_null(sunder_report_proof(report, k));
            continue;
        }
        proved++;
        const char *wrong = proof_check(t->plain, t->n, t->n + t->barriers, t->gap, report, k);
        if (wrong) fail_msg("trial %zu: the proof for %zu and %zu: %s", trial, c[k].a, c[k].b, wrong);
    }
    return proved;
}

/* ---- Large coordinates, small limits ---------------------------------------------------------------------------- */

/* The unit in the last place of coordinates up to v. */
static double unit_of(double v)
{
    int e;
    frexp(v, &e);
    return ldexp(1, e - 53);
}

/* Coordinates of 10^5 to 10^12, a limit of 2^-10 to 8, each a multiple of the coordinates' unit. */
static void random_scale(rng *r, double *origin, double *unit, double *limit)
{
    *origin = pow(10, 5 + 7 * rng_unit(r));
    *unit = unit_of(2 * *origin);
    *limit = ldexp(1 + rng_unit(r), (int)rng_int(r, -10, 2));
    *limit = fmax(64, floor(*limit / *unit)) * *unit;
    *origin = floor(*origin / *unit) * *unit;
}

static double multiple(double v, double unit) { return floor(v / unit) * unit; }

/* Boxes in a row between two fixed ones, with `excess` more width than there is room; taller than they may move, so
 * that none can leave the row. All widths, places and the gap are multiples of the unit. */
static void pack(rng *r, town *t, double excess_units)
{
    double origin, unit, limit;
    random_scale(r, &origin, &unit, &limit);
    memset(t, 0, sizeof *t);
    t->gap = rng_once_in(r, 2) ? 0 : multiple(limit * rng_unit(r), unit);
    const int n = (int)rng_int(r, 1, 6);
    const double tall = 16 * limit + 4 * t->gap, excess = excess_units * unit;
    double x = origin, y = origin / 2;
    y = multiple(y, unit);
    add_box(t, x - tall, y - tall, tall, 3 * tall, 0);
    for (int k = 0; k < n; k++) {
        const double width = multiple(limit * (3 + 2 * rng_unit(r)), unit);
        /* Within half the limit of where it fits. */
        const double off = multiple(limit * (rng_unit(r) - 0.5), unit);
        add_box(t, x + t->gap + off, y + multiple(limit * rng_unit(r), unit), width, tall, limit);
        x += t->gap + width;
    }
    add_box(t, x + t->gap - excess, y - tall, tall, 3 * tall, 0);
}

static void check_packed(void **state)
{
    (void)state;
    size_t proved = 0, open = 0;
    const size_t trials = test_count(150);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        town t;
        pack(&r, &t, ldexp(1, (int)rng_int(&r, 3, 5)));
        sunder_report *report = separate(&t);
        proved += check_proofs(&t, report, trial, &open);
        sunder_layer_summary s;
        sunder_report_summary(report, &s);
        assert_true(s.blocked > 0);
        sunder_report_free(report);
        free_town(&t);
    }
    print_message("%zu with a proof, %zu without\n", proved, open);
    assert_true(open * 25 <= proved); /* some are soluble: the search left two for one, and some too near to tell */
}

static void check_exact_fits(void **state)
{
    (void)state;
    size_t left = 0;
    const size_t trials = test_count(500);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        town t;
        /* No room to spare, or a unit of it. */
        pack(&r, &t, rng_once_in(&r, 2) ? 0 : -1);
        sunder_report *report = separate(&t);
        size_t n;
        const sunder_conflict *c = sunder_report_conflicts(report, &n);
        for (size_t k = 0; k < n; k++)
            if (c[k].reason != SUNDER_REASON_UNRESOLVED)
                fail_msg("trial %zu: %zu and %zu are listed as %s, but all fits", trial, c[k].a, c[k].b,
                         sunder_reason_string(c[k].reason));
        left += n;
        sunder_report_free(report);
        free_town(&t);
    }
    print_message("%zu conflicts left in %zu lanes\n", left, trials);
}

/* ---- Random towns ----------------------------------------------------------------------------------------------- */

/* A box, a slanted quadrangle, a triangle or an L. */
static void add_house(rng *r, town *t, double x, double y, double limit)
{
    const double w = (double)rng_int(r, 3, 12), h = (double)rng_int(r, 3, 12), a = w / 3, b = h / 3;
    const double box[] = {x, y, x + w, y, x + w, y + h, x, y + h};
    const double quad[] = {x, y, x + w, y + b, x + w - a, y + b + h, x - a, y + h};
    const double three[] = {x, y, x + w, y + b, x + a, y + h};
    const double ell[] = {x, y, x + w, y, x + w, y + b, x + a, y + b, x + a, y + h, x, y + h};
    switch (rng_int(r, 0, 3)) {
    case 0: add(t, box, 4, limit); break;
    case 1: add(t, quad, 4, limit); break;
    case 2: add(t, three, 3, limit); break;
    default: add(t, ell, 6, limit); break;
    }
}

static void check_towns(void **state)
{
    (void)state;
    size_t proved = 0, open = 0, nodes = 0;
    const size_t trials = test_count(60);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        town t;
        memset(&t, 0, sizeof t);
        t.gap = (double)rng_int(&r, 0, 2) * rng_unit(&r);
        t.blocks = rng_once_in(&r, 2);
        const size_t n = (size_t)rng_int(&r, 3, 24);
        const double wide = sqrt((double)n) * (double)rng_int(&r, 6, 12), limit = (double)rng_int(&r, 1, 24) / 8;
        const double origin = pow(10, 7 * rng_unit(&r));
        while (t.n < n)
            add_house(&r, &t, origin + floor(rng_unit(&r) * wide * 4) / 4, origin + floor(rng_unit(&r) * wide * 4) / 4,
                      rng_once_in(&r, 4) ? 0 : limit);
        sunder_report *report = separate(&t);
        proved += check_proofs(&t, report, trial, &open);
        size_t c;
        sunder_report_conflicts(report, &c);
        for (size_t k = 0; k < c; k++)
            if (sunder_report_proof(report, k)) nodes += sunder_report_proof(report, k)->nodes;
        sunder_report_free(report);
        free_town(&t);
    }
    print_message("%zu with a proof, of %zu nodes, %zu without\n", proved, nodes, open);
    assert_true(proved > trials / 4);
}

/* ---- Beside barriers -------------------------------------------------------------------------------------------- */

static double quarters(rng *r, int64_t low, int64_t high) { return (double)rng_int(r, 4 * low, 4 * high) / 4; }

/* A box, a triangle or a slanted quadrangle: of what is convex it can be asked how deep a line lay in it. */
static void add_convex(rng *r, town *t, double x, double y, double limit)
{
    const double w = quarters(r, 2, 6), h = quarters(r, 2, 6), lean = quarters(r, 0, 1);
    const double box[] = {x, y, x + w, y, x + w, y + h, x, y + h};
    const double quad[] = {x, y, x + w, y + lean, x + w + lean, y + h + lean, x + lean, y + h};
    const double three[] = {x, y, x + w, y + lean, x + lean, y + h};
    switch (rng_int(r, 0, 2)) {
    case 0: add(t, box, 4, limit); break;
    case 1: add(t, quad, 4, limit); break;
    default: add(t, three, 3, limit); break;
    }
}

static void add_some_barrier(rng *r, town *t, double x, double y, double wide)
{
    const double p = x + quarters(r, 0, (int64_t)wide), q = y + quarters(r, 0, (int64_t)wide);
    const double u = quarters(r, -12, 12), v = quarters(r, -12, 12), width = quarters(r, 0, 2), gap = quarters(r, 0, 1);
    const double line[] = {p, q, p + u, q + v}, area[] = {p, q, p + 2, q, p + 2, q + 1.5, p, q + 1.5};
    const size_t corners = (size_t)rng_int(r, 1, 3);
    add_barrier(t, corners == 3 ? area : line,
                corners == 3       ? 4
                : u == 0 && v == 0 ? 1
                                   : corners,
                width, gap, rng_once_in(r, 2));
}

/* Houses among lines, points and areas that stand too near to them, or run through them; half of these have sides. */
static void check_beside_barriers(void **state)
{
    (void)state;
    size_t proved = 0, open = 0, of_barriers = 0, slack = 0, sides = 0;
    const size_t trials = test_count(100);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        town t;
        memset(&t, 0, sizeof t);
        t.gap = quarters(&r, 0, 1);
        t.blocks = rng_once_in(&r, 3);
        const size_t n = (size_t)rng_int(&r, 2, 8), barriers = (size_t)rng_int(&r, 1, 4);
        const double wide = 10, limit = (double)rng_int(&r, 1, 16) / 8, origin = floor(pow(10, 6 * rng_unit(&r)));
        while (t.n < n)
            add_convex(&r, &t, origin + quarters(&r, 0, (int64_t)wide), origin + quarters(&r, 0, (int64_t)wide),
                       rng_once_in(&r, 6) ? 0 : limit);
        for (size_t k = 0; k < barriers; k++) add_some_barrier(&r, &t, origin, origin, wide);
        sunder_report *report = separate(&t);
        proved += check_proofs(&t, report, trial, &open);
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
        free_town(&t);
    }
    print_message("%zu with a proof, %zu of them with barriers, %zu nodes with slack, %zu about sides, %zu without\n",
                  proved, of_barriers, slack, sides, open);
    assert_true(of_barriers > trials / 8 && sides > trials / 50);
}

/* The proof of conflict k with all that a side takes away a little greater: it has to be refused. */
static void check_refused(const town *t, const sunder_report *report, size_t trial, size_t k)
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
        if (!wrong) fail_msg("trial %zu: the proof of conflict %zu holds for more than the side takes away", trial, k);
        for (size_t w = 0; w < p->node[m].ways && w < 64; w++) way[w].d = was[w];
    }
}

/* A house with a line through it, near the edge that it could leave by but for its side; a fixed one, or another line
 * or area with sides, leaves it too little room on the other. */
static void check_beside_sides(void **state)
{
    (void)state;
    size_t proved = 0, open = 0, sides = 0, alone = 0;
    const size_t trials = test_count(60);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        town t;
        memset(&t, 0, sizeof t);
        t.gap = quarters(&r, 0, 1);
        const double x = floor(pow(10, 6 * rng_unit(&r))), lean = quarters(&r, 0, 4), off = quarters(&r, 0, 1);
        const double line[] = {x + 3.25 - lean, x - 30, x + 3.25 + lean, x + 34};
        const double other[] = {x - off, x - 30, x - off, x + 34};
        const double area[] = {x - off - 2, x - 30, x - off, x - 30, x - off, x + 34, x - off - 2, x + 34};
        const int beyond = (int)rng_int(&r, 0, 2);
        add_box(&t, x, x, 4, 4, quarters(&r, 4, 6));
        if (beyond == 0) add_box(&t, x - off - 8, x - 30, 8, 64, 0);
        add_barrier(&t, line, 2, 0, t.gap, true);
        if (beyond == 1) add_barrier(&t, other, 2, 0, t.gap, true);
        if (beyond == 2) add_barrier(&t, area, 4, 0, t.gap, true);
        sunder_report *report = separate(&t);
        proved += check_proofs(&t, report, trial, &open);
        size_t c;
        const sunder_conflict *listed = sunder_report_conflicts(report, &c);
        for (size_t k = 0; k < c; k++) {
            const sunder_proof *proof = sunder_report_proof(report, k);
            check_refused(&t, report, trial, k);
            alone += listed[k].reason == SUNDER_REASON_SIDE;
            for (size_t m = 0; proof && m < proof->nodes; m++) sides += proof->node[m].shadow;
        }
        sunder_report_free(report);
        free_town(&t);
    }
    print_message("%zu with a proof, %zu of them of the pair by itself, %zu nodes about sides, %zu without\n", proved,
                  alone, sides, open);
    assert_true(sides > trials / 4 && 10 * open <= proved);
}

/* ---- Held pairs ------------------------------------------------------------------------------------------------- */

/* A house that is too near to a slanted fixed wall, and may not go far enough to mend that; on its other side a fixed
 * one that it is too near to by less than it may move. So it has no room, since it may come no nearer to the wall: by
 * no more than their distance, which no double is. */
static void check_held(void **state)
{
    (void)state;
    size_t proved = 0, open = 0;
    const size_t trials = test_count(150);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        town t;
        memset(&t, 0, sizeof t);
        t.gap = 2 + rng_unit(&r);
        const double x = pow(10, 7 * rng_unit(&r)), y = x + 100 * rng_unit(&r), lean = 4 * rng_unit(&r);
        const double limit = 0.25 + rng_unit(&r) / 8, off = 0.5 + rng_unit(&r);
        const double low = x - off + lean, high = x - off - lean;
        const double wall[] = {x - 90, y - 60, low, y - 60, high, y + 60, x - 90, y + 60};
        add(&t, wall, 4, 0);
        /* Its lower left corner is what the wall is near to. */
        const double house[] = {x - lean / 60, y + 1, x + 9, y, x + 9, y + 12, x + 4, y + 12};
        add(&t, house, 4, limit);
        add_box(&t, x + 9 + t.gap - limit / 4, y - 40, 30, 90, 0);
        sunder_report *report = separate(&t);
        proved += check_proofs(&t, report, trial, &open);
        sunder_report_free(report);
        free_town(&t);
    }
    print_message("%zu with a proof, %zu without\n", proved, open);
    assert_true(proved * 2 > trials);
}

/* ---- Corridors -------------------------------------------------------------------------------------------------- */

/* Where a road goes from, and along; across is to its left. */
typedef struct street {
    double from[2], along[2];
} street;

/* A quadrangle beside it, from s to s + length along it, at least so far off; on its left, or its right. */
static void add_beside(rng *r, town *t, const street *at, double s, double length, double off, bool left, double limit)
{
    const double side = left ? 1 : -1, deep = fmax(4, 4 - 3 * off) + rng_unit(r), lean = rng_unit(r);
    const double of[4][2] = {{s, off}, {s + length, off + lean}, {s + length, off + deep}, {s, off + deep}};
    double xy[8];
    for (size_t k = 0; k < 4; k++) {
        const double *p = of[left ? k : 3 - k];
        xy[2 * k] = at->from[0] + p[0] * at->along[0] - side * p[1] * at->along[1];
        xy[2 * k + 1] = at->from[1] + p[0] * at->along[1] + side * p[1] * at->along[0];
    }
    add(t, xy, 4, limit);
}

/* A block on both sides of a straight road that it is too near to, and at one end a house that stands fast and is too
 * near to it: it could slide along the road, exactly, if the road's ends were multiples of some step apart; most often
 * they are not. A third of the roads are of round numbers, along which there is a step as a rule. */
static void check_corridors(void **state)
{
    (void)state;
    size_t proved = 0, open = 0, still = 0, deep = 0, odd = 0;
    const size_t trials = test_count(60);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        town t;
        memset(&t, 0, sizeof t);
        t.gap = 3;
        const bool round = rng_once_in(&r, 3);
        const double turn = 6.25 * rng_unit(&r), far = 40, limit = 2 + rng_unit(&r);
        street at = {{600000 + 4e5 * rng_unit(&r), 4600000 + 3e6 * rng_unit(&r)}, {cos(turn), sin(turn)}};
        double line[4];
        for (size_t x = 0; x < 2; x++) {
            line[x] = round ? floor(at.from[x]) : at.from[x];
            line[2 + x] = line[x] + (round ? floor(far * at.along[x]) : far * at.along[x]);
            at.from[x] = line[x];
            at.along[x] = line[2 + x] - line[x];
        }
        const double length = hypot(at.along[0], at.along[1]);
        for (size_t x = 0; x < 2; x++) at.along[x] /= length;
        odd += !round;
        /* Or the line runs through both. */
        const double in = rng_once_in(&r, 2) ? 3 : 0;
        add_beside(&r, &t, &at, 10, 6, 1 + rng_unit(&r) - in, true, limit);
        add_beside(&r, &t, &at, in > 0 ? 18 : 12, 8, 1 + rng_unit(&r) - in, false, limit);
        add_beside(&r, &t, &at, in > 0 ? 27 : 21, 5, 3, false, 0);
        t.feature[0].block = t.feature[1].block = 0;
        add_barrier(&t, line, 2, 5, 0, false);
        sunder_report *report = separate(&t);
        proved += check_proofs(&t, report, trial, &open);
        size_t c;
        sunder_report_conflicts(report, &c);
        for (size_t k = 0; k < c; k++) {
            const sunder_proof *proof = sunder_report_proof(report, k);
            for (size_t m = 0; proof && m < proof->nodes; m++)
                if (proof->node[m].still) {
                    still++;
                    deep += in > 0;
                    break;
                }
        }
        sunder_report_free(report);
        free_town(&t);
    }
    print_message("%zu with a proof, %zu by a lattice, %zu of these of a line through houses, %zu without\n", proved,
                  still, deep, open);
    assert_true(2 * still > odd && 8 * deep > odd);
}

/* ---- By name ---------------------------------------------------------------------------------------------------- */

static const sunder_conflict *find(const sunder_report *report, size_t a, size_t b, size_t *k)
{
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (*k = 0; *k < n; ++*k)
        if (c[*k].a == a && c[*k].b == b) return &c[*k];
    return NULL;
}

/* A square of 10 km at 5,000 km, one side of which overlaps a fixed one by 2^-20 more than it may move, and another
 * fixed one behind it: plain doubles and a slack of a ten-millionth cannot tell. */
static void check_huge_and_small(void **state)
{
    (void)state;
    town t;
    memset(&t, 0, sizeof t);
    const double limit = ldexp(1, -12), hair = ldexp(1, -20);
    add_box(&t, 4990000, 5000000, 10000, 10000, 0);
    add_box(&t, 5000000 - limit / 2, 5000000, 10000, 10000, limit);
    add_box(&t, 5010000 - hair, 5000000, 10000, 10000, 0);
    sunder_report *report = separate(&t);
    size_t open = 0, k;
    assert_true(check_proofs(&t, report, 0, &open) > 0);
    assert_int_equal(open, 0);
    const sunder_conflict *c = find(report, 0, 1, &k);
    assert_non_null(c);
    assert_int_equal(c->reason, SUNDER_REASON_NO_ROOM);
    assert_int_equal(c->n_blocked_by, 1);
    assert_int_equal(c->blocked_by[0], 2);
    sunder_report_free(report);
    free_town(&t);
    /* Without that hair there is room, exactly. */
    memset(&t, 0, sizeof t);
    add_box(&t, 4990000, 5000000, 10000, 10000, 0);
    add_box(&t, 5000000 - limit / 2, 5000000, 10000, 10000, limit);
    add_box(&t, 5010000, 5000000, 10000, 10000, 0);
    report = separate(&t);
    sunder_layer_summary s;
    sunder_report_summary(report, &s);
    assert_int_equal(s.blocked, 0);
    sunder_report_free(report);
    free_town(&t);
}

/* A house between two fixed blocks too near to each other, and, hanging together with it over a third, two that have
 * room: the one want of room explains the conflicts at the first house, and no others. */
static void check_explains_its_own(void **state)
{
    (void)state;
    town t;
    memset(&t, 0, sizeof t);
    add_box(&t, 0, 0, 10, 40, 0);
    add_box(&t, 9, 5, 12, 30, 2);
    add_box(&t, 20.5, 0, 10, 40, 0);
    /* Overlaps the house that has no room, and one that has all the room there is. */
    add_box(&t, 12, 34.5, 6, 6, 2);
    add_box(&t, 12, 40, 6, 6, 4);
    sunder_report *report = separate(&t);
    size_t open = 0, n;
    check_proofs(&t, report, 0, &open);
    assert_int_equal(open, 0);
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    assert_true(n > 0);
    for (size_t k = 0; k < n; k++) {
        assert_true(c[k].a < 3 && c[k].b < 3);
        assert_int_equal(c[k].reason, SUNDER_REASON_NO_ROOM);
        assert_int_equal(c[k].n_blocked_by, 1);
        assert_int_equal(c[k].blocked_by[0], 3 - c[k].a - c[k].b);
    }
    sunder_report_free(report);
    free_town(&t);
}

/* Two wants of room that hang together: each conflict is blocked by its own. */
static void check_two_lanes(void **state)
{
    (void)state;
    town t;
    memset(&t, 0, sizeof t);
    for (int lane = 0; lane < 2; lane++) {
        const double y = 100 * lane;
        add_box(&t, 0, y, 10, 60, 0);
        add_box(&t, 9.5, y + 10, 11, 45, 1);
        add_box(&t, 20, y, 10, 60, 0);
    }
    add_box(&t, 12, 54, 6, 56.5, 2);
    sunder_report *report = separate(&t);
    size_t open = 0, n;
    assert_true(check_proofs(&t, report, 0, &open) >= 4);
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++) {
        if (c[k].reason != SUNDER_REASON_NO_ROOM) continue;
        for (size_t b = 0; b < c[k].n_blocked_by && c[k].b < 6; b++) assert_true(c[k].blocked_by[b] / 3 == c[k].a / 3);
    }
    sunder_report_free(report);
    free_town(&t);
}

/* None of blocked_by can be left out: the pair and all of them but one have a solution. */
static void check_irreducible(void **state)
{
    (void)state;
    size_t tried = 0, solved = 0;
    const size_t trials = test_count(30);
    for (size_t trial = 0; trial < trials; trial++) {
        rng r = rng_start(test_seed(), trial);
        town t;
        /* A lane, and boxes about that have nothing to do with it or are in the way of those that do. */
        pack(&r, &t, 64);
        sunder_report *report = separate(&t);
        size_t n, open = 0;
        check_proofs(&t, report, trial, &open);
        const sunder_conflict *c = sunder_report_conflicts(report, &n);
        for (size_t k = 0; k < n && n == 1; k++) {
            if (c[k].reason != SUNDER_REASON_NO_ROOM) continue;
            for (size_t out = 0; out < c[k].n_blocked_by; out++) {
                town part;
                memset(&part, 0, sizeof part);
                part.gap = t.gap;
                for (size_t f = 0; f < t.n; f++) {
                    bool in = f == c[k].a || f == c[k].b;
                    for (size_t b = 0; b < c[k].n_blocked_by; b++) in = in || (b != out && c[k].blocked_by[b] == f);
                    if (in) add(&part, t.xy[f], t.plain[f].corners, t.plain[f].max_shift);
                }
                sunder_report *again = separate(&part);
                sunder_layer_summary s;
                sunder_report_summary(again, &s);
                tried++;
                solved += s.blocked == 0;
                size_t m;
                const sunder_conflict *d = sunder_report_conflicts(again, &m);
                for (size_t i = 0; i < m; i++) assert_true(d[i].reason != SUNDER_REASON_NO_ROOM);
                sunder_report_free(again);
                free_town(&part);
            }
        }
        sunder_report_free(report);
        free_town(&t);
    }
    print_message("%zu of %zu solved\n", solved, tried);
    assert_true(solved * 10 >= tried * 9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_huge_and_small), cmocka_unit_test(check_explains_its_own),
        cmocka_unit_test(check_two_lanes),      cmocka_unit_test(check_irreducible),
        cmocka_unit_test(check_packed),         cmocka_unit_test(check_exact_fits),
        cmocka_unit_test(check_held),           cmocka_unit_test(check_corridors),
        cmocka_unit_test(check_towns),          cmocka_unit_test(check_beside_barriers),
        cmocka_unit_test(check_beside_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
