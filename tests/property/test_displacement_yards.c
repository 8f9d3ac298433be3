/* Huts in courtyards, with known results: a courtyard is closed, or has a gate, and is wide enough for its hut or not.
 *
 * The courtyard is a rectangle, within one wall with a hole or within several walls that touch: side by side, mitred,
 * cut in two. The hut is a rectangle, too, so it fits in the courtyard exactly if both dimensions leave twice the gap.
 * It may leave through the gate exactly if some ray from its anchor passes without touching the gate's corners, and no
 * anchor of a wall would cross the hut, relative to the hut. In that case no conflict may be proved to need a jump.
 * Otherwise each remaining conflict with a wall that surrounds the hut has to be proved to; with one of several walls
 * it need not be, since beside that wall alone the hut may have room. All lengths are eighths. */
#include "random.h"
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#define PI 3.14159265358979323846
#define MOST_TOLD 256

typedef struct yard {
    double x, y, w, h, wall; /* the free rectangle inside, and the thickness of its walls */
    double gate[2];          /* the interval of the gate in the right wall; both NAN: there is none */
    double hut[4];           /* its box */
    bool turned;             /* x and y are swapped */
} yard;

static double eighths(rng *r, int low, int high) { return (double)rng_int(r, low, high) / 8; }

/* A quadrangle, counter-clockwise unless the yard is mirrored. */
static sunder_feature *add(scene *s, const yard *y, const double xy[8])
{
    char wkt[400];
    int n = snprintf(wkt, sizeof wkt, "POLYGON ((");
    for (int k = 0; k < 5; k++) {
        const double *p = xy + 2 * (k % 4);
        n += snprintf(wkt + n, sizeof wkt - (size_t)n, "%s%.4f %.4f", k ? ", " : "", p[y->turned], p[!y->turned]);
    }
    snprintf(wkt + n, sizeof wkt - (size_t)n, "))");
    return scene_add(s, wkt);
}

static sunder_feature *add_box(scene *s, const yard *y, double left, double low, double right, double high)
{
    return add(s, y, (double[]){left, low, right, low, right, high, left, high});
}

static void add_frame(scene *s, const yard *y)
{
    char wkt[600];
    const double a[4] = {y->x - y->wall, y->y - y->wall, y->x + y->w + y->wall, y->y + y->h + y->wall};
    const double b[4] = {y->x, y->y, y->x + y->w, y->y + y->h};
    int n = snprintf(wkt, sizeof wkt, "POLYGON (");
    for (int ring = 0; ring < 2; ring++) {
        const double *c = ring ? b : a;
        for (int k = 0; k < 5; k++) {
            const double p[2] = {c[k == 1 || k == 2 ? 2 : 0], c[k == 2 || k == 3 ? 3 : 1]};
            n += snprintf(wkt + n, sizeof wkt - (size_t)n, "%s%.4f %.4f",
                          k      ? ", "
                          : ring ? "), ("
                                 : "(",
                          p[y->turned], p[!y->turned]);
        }
    }
    snprintf(wkt + n, sizeof wkt - (size_t)n, "))");
    scene_add(s, wkt);
}

static void add_mitred(scene *s, const yard *y)
{
    const double l = y->x, b = y->y, r = l + y->w, t = b + y->h, k = y->wall;
    add(s, y, (double[]){l - k, b - k, r + k, b - k, r, b, l, b});
    add(s, y, (double[]){r, b, r + k, b - k, r + k, t + k, r, t});
    add(s, y, (double[]){l, t, r, t, r + k, t + k, l - k, t + k});
    add(s, y, (double[]){l - k, b - k, l, b, l, t, l - k, t + k});
}

/* The walls below and above extend over the corners; each is of one part or of two. The right one may have a gate. */
static void add_walls(scene *s, const yard *y, rng *r)
{
    const double left = y->x - y->wall, right = y->x + y->w + y->wall, top = y->y + y->h;
    for (int k = 0; k < 2; k++) {
        const double low = k ? top : y->y - y->wall, at = y->x + floor(8 * y->w * rng_unit(r)) / 8;
        const bool whole = rng_once_in(r, 2) || at <= left || at >= right;
        add_box(s, y, left, low, whole ? right : at, low + y->wall);
        if (!whole) add_box(s, y, at, low, right, low + y->wall);
    }
    add_box(s, y, left, y->y, y->x, top);
    const bool gate = y->gate[0] < y->gate[1];
    const double at = gate ? y->gate[0] : y->y + y->h / 2;
    add_box(s, y, y->x + y->w, y->y, right, at);
    add_box(s, y, y->x + y->w, gate ? y->gate[1] : at, right, top);
}

/* The interval of angles at which the box is seen from p, less than half a turn. */
static void angles_of(const double box[4], const double p[2], double out[2])
{
    const double mid = atan2((box[1] + box[3]) / 2 - p[1], (box[0] + box[2]) / 2 - p[0]);
    out[0] = INFINITY;
    out[1] = -INFINITY;
    for (int k = 0; k < 4; k++) {
        const double x = box[k & 1 ? 2 : 0] - p[0], y = box[k & 2 ? 3 : 1] - p[1];
        const double angle = mid + atan2(cos(mid) * y - sin(mid) * x, cos(mid) * x + sin(mid) * y);
        out[0] = fmin(out[0], angle);
        out[1] = fmax(out[1], angle);
    }
}

/* Removes the directions from..to from a list of intervals; returns their new number. */
static size_t take_out(double (*free)[2], size_t n, double from, double to)
{
    for (size_t k = 0, before = n; k < before; k++) {
        const double end = free[k][1];
        if (to <= free[k][0] || from >= end) continue;
        free[k][1] = fmax(free[k][0], from);
        if (to < end) {
            free[n][0] = to;
            free[n++][1] = end;
        }
    }
    return n;
}

/* May the hut leave through the gate in a straight line, so that its anchor meets no wall and the hut meets no anchor
 * of the walls? NAN: too close to decide. */
static double may_leave(const yard *y, const scene *s, size_t walls)
{
    const double *b = y->hut, at[2] = {(b[0] + b[2]) / 2, (b[1] + b[3]) / 2};
    const double near = y->x + y->w - at[0], far = near + y->wall, low = y->gate[0] - at[1], high = y->gate[1] - at[1];
    double free[2 * SCENE_MOST][2] = {
        {fmax(atan2(low, near), atan2(low, far)), fmin(atan2(high, near), atan2(high, far))}};
    size_t n = 1;
    double widest = -INFINITY;
    if (!(y->gate[0] < y->gate[1])) return false;
    for (size_t k = 0; k < walls; k++) {
        double p[2], angle[2];
        sunder_shape_anchor(s->feature[k].shape, p);
        const double in_yard[2] = {p[y->turned], p[!y->turned]};
        angles_of(b, in_yard, angle);
        /* Relative to the hut, a wall moves in the opposite direction. */
        for (int turn = -3; turn <= 3; turn += 2) n = take_out(free, n, angle[0] + turn * PI, angle[1] + turn * PI);
    }
    for (size_t k = 0; k < n; k++) widest = fmax(widest, free[k][1] - free[k][0]);
    return fabs(widest) < 1e-9 ? (double)NAN : (double)(widest > 0);
}

static void make(rng *r, yard *y, double gap)
{
    const double w = eighths(r, 8, 60), h = eighths(r, 8, 60);
    y->w = w + eighths(r, 1, (int)(24 * gap));
    y->h = h + eighths(r, 1, (int)(24 * gap));
    y->x = eighths(r, -80000, 80000);
    y->y = eighths(r, -80000, 80000);
    y->wall = eighths(r, 4, 80);
    y->turned = rng_once_in(r, 2);
    const bool centred = rng_once_in(r, 3);
    y->hut[0] = y->x + (centred ? (y->w - w) / 2 : floor(8 * (y->w - w) * rng_unit(r)) / 8);
    y->hut[1] = y->y + (centred ? (y->h - h) / 2 : floor(8 * (y->h - h) * rng_unit(r)) / 8);
    y->hut[2] = y->hut[0] + w;
    y->hut[3] = y->hut[1] + h;
    /* Too narrow for the hut, which therefore overlaps the walls at the start. */
    y->gate[0] = y->y + eighths(r, 1, (int)(8 * h) - 2);
    y->gate[1] = y->gate[0] + eighths(r, 1, (int)(8 * (y->y + h - y->gate[0])));
}

/* The distance of the hut from the nearest wall. */
static double clearance(const yard *y)
{
    const double *b = y->hut;
    return fmin(fmin(b[0] - y->x, y->x + y->w - b[2]), fmin(b[1] - y->y, y->y + y->h - b[3]));
}

/* The report on the remaining conflicts, each followed by a 0 and the features it names. */
static size_t tell(const scene *s, size_t *out)
{
    size_t n = 0, told = 0;
    const sunder_conflict *c = sunder_report_conflicts(s->report, &n);
    for (size_t k = 0; k < n; k++) {
        assert_true(told + 4 + c[k].n_blocked_by <= MOST_TOLD);
        out[told++] = c[k].a;
        out[told++] = c[k].b;
        out[told++] = c[k].reason;
        for (size_t b = 0; b < c[k].n_blocked_by; b++) out[told++] = 1 + c[k].blocked_by[b];
        out[told++] = 0;
    }
    return told;
}

/* The report is the same if proofs are not requested. */
static void check_without_proofs(scene *s)
{
    size_t with[MOST_TOLD], without[MOST_TOLD];
    const size_t n = tell(s, with);
    s->options.drop_proofs = true;
    scene_separate(s);
    assert_int_equal(tell(s, without), n);
    assert_memory_equal(with, without, n * sizeof *with);
}

static void check_case(rng *r, size_t counts[3])
{
    yard y;
    scene s;
    const double gap = (double[]){0.5, 1, 2, 3}[rng_int(r, 0, 3)];
    const int kind = (int)rng_int(r, 0, 3);
    make(r, &y, gap);
    if (kind < 3) y.gate[0] = y.gate[1] = NAN;
    scene_begin(&s, gap);
    s.options.effort = 0;
    s.options.touch_tolerance = 0;
    if (kind == 0) add_frame(&s, &y);
    if (kind == 1) add_mitred(&s, &y);
    if (kind > 1) add_walls(&s, &y, r);
    for (size_t k = 0; k < s.n; k++) s.feature[k].fixed = rng_once_in(r, 8);
    const size_t hut = s.n;
    add_box(&s, &y, y.hut[0], y.hut[1], y.hut[2], y.hut[3]);
    const double spare = fmin(y.w - (y.hut[2] - y.hut[0]), y.h - (y.hut[3] - y.hut[1]));
    const bool fits = spare >= 2 * gap;
    const double leaves = may_leave(&y, &s, hut);
    if (isnan(leaves) || clearance(&y) >= gap || !(clearance(&y) > 0)) {
        scene_end(&s);
        return;
    }
    scene_separate(&s);
    size_t n = 0, left = 0;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    for (size_t k = 0; k < n; k++) {
        if (c[k].inside_block) continue;
        left++;
        assert_true(c[k].a == hut || c[k].b == hut);
        const bool jump = c[k].reason == SUNDER_REASON_JUMP, shut = !fits && !(leaves > 0);
        assert_true(kind == 0 ? jump == shut : jump <= shut);
    }
    assert_true(s.summary.verified);
    /* If the courtyard is exactly as wide as the hut needs, the search has no margin and may fail. */
    if (spare > 2 * gap) assert_int_equal(left, 0);
    if (spare < 2 * gap && !(leaves > 0)) assert_true(left > 0);
    counts[fits ? 0 : leaves > 0 ? 1 : 2]++;
    check_without_proofs(&s);
    scene_end(&s);
}

static void check_yards(void **state)
{
    const uint64_t seed = test_seed();
    const size_t n = test_count(1500);
    size_t counts[3] = {0};
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(seed, i);
        check_case(&r, counts);
    }
    printf("seed %llu: %zu have room, %zu a gate to leave by, %zu neither\n", (unsigned long long)seed, counts[0],
           counts[1], counts[2]);
    assert_true(counts[0] && counts[1] && counts[2]);
}

/* A box and a quadrangle in one block lie across a frame, and neither may jump over it. The box's conflict has no
 * solution; the quadrangle's has one by itself, and it is used. */
static void check_one_of_two(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, 0);
    scene_add_box(&s, 9, 2, 4, 8)->block = 7;
    scene_add(&s, "POLYGON((8 4,15 4,15 10,8 10,8 4),(9 5,9 9,14 9,14 5,9 5))");
    scene_add(&s, "POLYGON((2 7,9 8,10 13,3 12,2 7))")->block = 7;
    scene_separate(&s);
    size_t n = 0;
    const sunder_conflict *c = sunder_report_conflicts(s.report, &n);
    for (size_t k = 0; k < n; k++)
        assert_true(c[k].inside_block || (c[k].a == 0 && c[k].b == 1 && c[k].reason == SUNDER_REASON_JUMP));
    assert_true(s.summary.cost > 0);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_yards), cmocka_unit_test(check_one_of_two)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
