/* Features beside barriers: lines, points and areas with a width and a gap of their own.
 *
 * The report about a layer as given, and about a separated one, is compared with brute force in rationals that shares
 * no code with src/: does the feature's interior meet the barrier, and if not, is it nearer than half the width plus
 * the gap? Coordinates are small integers, so that lines run along walls, through corners, from hole to hole and along
 * the diagonals of decompositions; in some cases they are shifted far from the origin. */
#include "random.h"

#include "sunder.h"

#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { CORNERS = 40, MOST = 6, CUTS = 400 };

/* ---- Rationals --------------------------------------------------------------------------------------------------- */

typedef struct point {
    mpq_t x, y;
} point;

/* Temporary numbers, initialised once: the program has one thread. */
static point scratch[8];
static mpq_t number[8], cut[CUTS];

static void make_scratch(void)
{
    for (int k = 0; k < 8; k++) mpq_inits(scratch[k].x, scratch[k].y, number[k], NULL);
    for (int k = 0; k < CUTS; k++) mpq_init(cut[k]);
}

static void free_scratch(void)
{
    for (int k = 0; k < 8; k++) mpq_clears(scratch[k].x, scratch[k].y, number[k], NULL);
    for (int k = 0; k < CUTS; k++) mpq_clear(cut[k]);
}

static void subtract(point *r, const point *p, const point *q)
{
    mpq_sub(r->x, p->x, q->x);
    mpq_sub(r->y, p->y, q->y);
}

static void cross(mpq_t r, const point *p, const point *q)
{
    mpq_mul(number[6], p->x, q->y);
    mpq_mul(number[7], p->y, q->x);
    mpq_sub(r, number[6], number[7]);
}

static void dot(mpq_t r, const point *p, const point *q)
{
    mpq_mul(number[6], p->x, q->x);
    mpq_mul(number[7], p->y, q->y);
    mpq_add(r, number[6], number[7]);
}

/* The rings of a figure, translated. If `cells` is set, the figure is the union of squares of side 4 with these lower
 * left corners, else the even-odd set of the rings. */
typedef struct figure {
    point at[CORNERS];
    size_t n, ring_end[10], rings;
    bool cells;
} figure;

static void figure_init(figure *f)
{
    for (size_t k = 0; k < CORNERS; k++) mpq_inits(f->at[k].x, f->at[k].y, NULL);
}

static void figure_clear(figure *f)
{
    for (size_t k = 0; k < CORNERS; k++) mpq_clears(f->at[k].x, f->at[k].y, NULL);
}

/* Returns the corner after k in its ring. */
static size_t next_of(const figure *f, size_t k)
{
    size_t first = 0;
    for (size_t r = 0; r < f->rings; first = f->ring_end[r++])
        if (k < f->ring_end[r]) return k + 1 < f->ring_end[r] ? k + 1 : first;
    abort();
}

/* Is p on the closed segment ab? */
static bool is_on(const point *p, const point *a, const point *b)
{
    subtract(&scratch[0], b, a);
    subtract(&scratch[1], p, a);
    cross(number[0], &scratch[0], &scratch[1]);
    if (mpq_sgn(number[0])) return false;
    subtract(&scratch[2], p, b);
    dot(number[0], &scratch[1], &scratch[2]);
    return mpq_sgn(number[0]) <= 0;
}

/* Does a ray to the right from p cross ab? p is not on it. */
static bool ray_crosses(const point *p, const point *a, const point *b)
{
    const bool up = mpq_cmp(a->y, p->y) > 0, vp = mpq_cmp(b->y, p->y) > 0;
    if (up == vp) return false;
    subtract(&scratch[0], b, a);
    subtract(&scratch[1], p, a);
    cross(number[0], &scratch[0], &scratch[1]);
    return vp ? mpq_sgn(number[0]) > 0 : mpq_sgn(number[0]) < 0;
}

/* Is p inside a union of cells? It is if the four points slightly off p in the diagonal directions are all in a
 * cell. */
static bool is_inside_cells(const figure *f, const point *p)
{
    for (int k = 0; k < 4; k++) {
        bool covered = false;
        for (size_t c = 0; c < f->n && !covered; c += 4) {
            const point *low = &f->at[c], *high = &f->at[c + 2];
            covered = (k & 1 ? mpq_cmp(low->x, p->x) <= 0 && mpq_cmp(p->x, high->x) < 0
                             : mpq_cmp(low->x, p->x) < 0 && mpq_cmp(p->x, high->x) <= 0) &&
                      (k & 2 ? mpq_cmp(low->y, p->y) <= 0 && mpq_cmp(p->y, high->y) < 0
                             : mpq_cmp(low->y, p->y) < 0 && mpq_cmp(p->y, high->y) <= 0);
        }
        if (!covered) return false;
    }
    return true;
}

static bool is_inside(const figure *f, const point *p)
{
    if (f->cells) return is_inside_cells(f, p);
    bool in = false;
    for (size_t k = 0; k < f->n; k++) {
        const point *a = &f->at[k], *b = &f->at[next_of(f, k)];
        if (is_on(p, a, b)) return false;
        in ^= ray_crosses(p, a, b);
    }
    return in;
}

static int by_value(const void *a, const void *b) { return mpq_cmp(*(const mpq_t *)a, *(const mpq_t *)b); }

/* Does the interior meet the closed segment ab? The segment is cut wherever it meets the line of an edge or a corner. A
 * part between two cuts is entirely inside or entirely outside, and the interior is open. */
static bool meets_segment(const figure *f, const point *a, const point *b)
{
    size_t n = 2;
    if (mpq_equal(a->x, b->x) && mpq_equal(a->y, b->y)) return is_inside(f, a);
    point d, e, w;
    mpq_inits(d.x, d.y, e.x, e.y, w.x, w.y, NULL);
    subtract(&d, b, a);
    mpq_set_ui(cut[0], 0, 1);
    mpq_set_ui(cut[1], 1, 1);
    for (size_t k = 0; k < f->n; k++) {
        subtract(&e, &f->at[next_of(f, k)], &f->at[k]);
        subtract(&w, &f->at[k], a);
        cross(number[1], &d, &e);
        if (mpq_sgn(number[1])) {
            cross(number[2], &w, &e);
            mpq_div(cut[n], number[2], number[1]);
        } else {
            dot(number[1], &w, &d);
            dot(number[2], &d, &d);
            mpq_div(cut[n], number[1], number[2]);
        }
        if (mpq_sgn(cut[n]) > 0 && mpq_cmp(cut[n], cut[1]) < 0) n++;
    }
    qsort(cut, n, sizeof *cut, by_value);
    bool met = false;
    for (size_t k = 0; k + 1 < n && !met; k++) {
        if (mpq_equal(cut[k], cut[k + 1])) continue;
        mpq_add(number[1], cut[k], cut[k + 1]);
        mpq_div_2exp(number[1], number[1], 1);
        mpq_mul(e.x, d.x, number[1]);
        mpq_mul(e.y, d.y, number[1]);
        mpq_add(e.x, e.x, a->x);
        mpq_add(e.y, e.y, a->y);
        met = is_inside(f, &e);
    }
    mpq_set_ui(cut[0], 0, 1);
    mpq_clears(d.x, d.y, e.x, e.y, w.x, w.y, NULL);
    return met;
}

/* The squared distance of p from the closed segment ab. */
static void square_from(mpq_t out, const point *p, const point *a, const point *b)
{
    subtract(&scratch[3], b, a);
    subtract(&scratch[4], p, a);
    dot(number[3], &scratch[3], &scratch[4]);
    dot(number[4], &scratch[3], &scratch[3]);
    if (mpq_sgn(number[3]) > 0 && mpq_cmp(number[3], number[4]) < 0) {
        cross(number[3], &scratch[3], &scratch[4]);
        mpq_mul(number[3], number[3], number[3]);
        mpq_div(out, number[3], number[4]);
        return;
    }
    if (mpq_sgn(number[3]) > 0) subtract(&scratch[4], p, b);
    dot(out, &scratch[4], &scratch[4]);
}

static void least_square(mpq_t least, const figure *f, const point *a, const point *b, bool *any)
{
    for (size_t k = 0; k < f->n; k++) {
        const point *c = &f->at[k], *d = &f->at[next_of(f, k)];
        const point *end[4] = {a, b, c, d};
        for (int e = 0; e < 4; e++) {
            square_from(number[5], end[e], e < 2 ? c : a, e < 2 ? d : b);
            if (!*any || mpq_cmp(number[5], least) < 0) mpq_set(least, number[5]);
            *any = true;
        }
    }
}

/* ---- Cases ------------------------------------------------------------------------------------------------------- */

typedef struct barrier {
    double xy[2 * CORNERS];
    size_t end[4], lines;
    figure area; /* a convex polygon, where lines == 0 */
    sunder_shape *shape;
} barrier;

typedef struct scene {
    double at[2], unit; /* the place of integer (0, 0), and the length of 1 */
    double xy[2 * CORNERS];
    figure figure;
    sunder_feature feature;
    barrier made[MOST];
    sunder_barrier barrier[MOST];
    size_t barriers;
    sunder_layer_options options;
    sunder_layer *layer;
} scene;

static void put(const scene *s, double *xy, size_t k, double x, double y)
{
    xy[2 * k] = s->at[0] + s->unit * x;
    xy[2 * k + 1] = s->at[1] + s->unit * y;
}

static void place(figure *f, const double *xy, const double t[2])
{
    for (size_t k = 0; k < f->n; k++) {
        mpq_set_d(f->at[k].x, xy[2 * k]);
        mpq_set_d(f->at[k].y, xy[2 * k + 1]);
        mpq_set_d(number[0], t[0]);
        mpq_add(f->at[k].x, f->at[k].x, number[0]);
        mpq_set_d(number[0], t[1]);
        mpq_add(f->at[k].y, f->at[k].y, number[0]);
    }
}

static sunder_shape *shape_of(const figure *f, const double *xy)
{
    sunder_shape *shape = NULL;
    sunder_error err;
    size_t each[10];
    const size_t whole = f->rings;
    for (size_t k = 0; k < 10; k++) each[k] = k + 1;
    if (sunder_shape_from_rings(xy, f->ring_end, f->cells ? each : &whole, f->cells ? f->rings : 1,
                                SUNDER_VALIDITY_STRICT, &shape, &err))
        fail_msg("%s", err.message);
    return shape;
}

/* The corners of some simple outer rings, and of a hole in the last. */
static void draw_feature(scene *s, rng *r)
{
    static const int figures[5][25] = {{4, 0, 0, 8, 0, 8, 4, 0, 4},
                                       {6, 0, 0, 8, 0, 8, 4, 4, 4, 4, 8, 0, 8},
                                       {8, 0, 0, 12, 0, 12, 8, 8, 8, 8, 4, 4, 4, 4, 8, 0, 8},
                                       {4, 0, 4, 4, 0, 12, 6, 3, 10},
                                       {4, 0, 0, 12, 0, 12, 12, 0, 12}};
    const int kind = (int)rng_int(r, 0, 6);
    figure *f = &s->figure;
    f->n = f->rings = 0;
    f->cells = kind > 4;
    if (f->cells) {
        for (int c = 0; c < 9; c++) {
            if (!rng_once_in(r, 2) && c) continue;
            const double x = 4 * (c % 3), y = c / 3 * 4;
            put(s, s->xy, f->n, x, y), put(s, s->xy, f->n + 1, x + 4, y);
            put(s, s->xy, f->n + 2, x + 4, y + 4), put(s, s->xy, f->n + 3, x, y + 4);
            f->ring_end[f->rings++] = f->n += 4;
        }
    } else {
        const int *g = figures[kind];
        for (int k = 0; k < g[0]; k++) put(s, s->xy, f->n++, g[1 + 2 * k], g[2 + 2 * k]);
        f->ring_end[f->rings++] = f->n;
        if (kind == 4) {
            put(s, s->xy, f->n, 4, 4), put(s, s->xy, f->n + 1, 4, 8);
            put(s, s->xy, f->n + 2, 8, 8), put(s, s->xy, f->n + 3, 8, 4);
            f->ring_end[f->rings++] = f->n += 4;
        }
    }
    s->feature = (sunder_feature){.shape = shape_of(f, s->xy), .weight = 1, .max_shift = INFINITY, .block = -1};
}

static void draw_lines(const scene *s, rng *r, barrier *b)
{
    const int lines = (int)rng_int(r, 1, 3), step = rng_once_in(r, 2) ? 4 : 1;
    size_t n = 0;
    for (int k = 0; k < lines; k++) {
        const int corners = (int)rng_int(r, 1, 4);
        for (int i = 0; i < corners; i++, n++) {
            const int64_t y = step * rng_int(r, -8 / step, 20 / step), x = step * rng_int(r, -8 / step, 20 / step);
            put(s, b->xy, n, (double)x, (double)y);
            if (i && rng_once_in(r, 8)) memcpy(b->xy + 2 * n, b->xy + 2 * n - 2, 2 * sizeof *b->xy);
        }
        b->end[b->lines++] = n;
    }
}

static void draw_area(const scene *s, rng *r, barrier *b)
{
    const double x = (double)rng_int(r, -8, 14), y = (double)rng_int(r, -8, 14), w = (double)rng_int(r, 1, 8);
    put(s, b->xy, 0, x, y), put(s, b->xy, 1, x + w, y), put(s, b->xy, 2, x + w, y + w), put(s, b->xy, 3, x, y + w);
    b->area.n = b->area.ring_end[0] = 4;
    b->area.rings = 1;
    b->area.cells = false;
    place(&b->area, b->xy, (double[2]){0, 0});
    b->shape = shape_of(&b->area, b->xy);
}

static void draw(scene *s, rng *r)
{
    static const double places[4][2] = {{0, 0}, {451234.5, 5411234.25}, {-0x1p40, 0x1p30}, {0, 0}};
    static const double widths[5] = {0, 0, 1, 2, 0x1.8000000000001p0}, gaps[4] = {-1, 0, 1, 0x1p-52};
    const int place = (int)rng_int(r, 0, 3);
    memcpy(s->at, places[place], sizeof s->at);
    s->unit = place == 3 ? 0x1p-30 : 1;
    draw_feature(s, r);
    s->barriers = (size_t)rng_int(r, 1, MOST);
    for (size_t k = 0; k < s->barriers; k++) {
        barrier *b = &s->made[k];
        b->lines = 0;
        b->shape = NULL;
        if (rng_once_in(r, 4))
            draw_area(s, r, b);
        else
            draw_lines(s, r, b);
        const double w = s->unit * widths[rng_int(r, 0, 4)], g = gaps[rng_int(r, 0, 3)];
        s->barrier[k] = (sunder_barrier){
            {b->shape, b->lines ? b->xy : NULL, b->end, b->lines}, .width = w, .gap = g < 0 ? g : s->unit * g};
    }
    sunder_layer_options_init(&s->options);
    s->options.gap = rng_once_in(r, 2) ? 0 : s->unit;
    s->options.touch_tolerance = 0;
    sunder_error err;
    s->layer = NULL;
    if (sunder_layer_new(&s->feature, 1, &s->layer, &err) ||
        sunder_layer_set_barriers(s->layer, s->barrier, s->barriers, &err))
        fail_msg("%s", err.message);
}

/* Separates the same layer, with this limit for the feature. */
static sunder_layer *limit_to(scene *s, double limit)
{
    sunder_layer *layer = NULL;
    sunder_error err;
    sunder_layer_free(s->layer);
    s->feature.max_shift = limit;
    if (sunder_layer_new(&s->feature, 1, &layer, &err) ||
        sunder_layer_set_barriers(layer, s->barrier, s->barriers, &err))
        fail_msg("%s", err.message);
    return layer;
}

static void erase(scene *s)
{
    sunder_layer_free(s->layer);
    sunder_shape_free((sunder_shape *)s->feature.shape);
    for (size_t k = 0; k < s->barriers; k++) sunder_shape_free(s->made[k].shape);
}

/* ---- The oracle -------------------------------------------------------------------------------------------------- */

typedef enum stance { FREE, NEAR, DRAWN, MET } stance; /* DRAWN: nearer than half the width */

static bool meets_area(const scene *s, const barrier *b)
{
    for (size_t k = 0; k < 4; k++)
        if (meets_segment(&s->figure, &b->area.at[k], &b->area.at[(k + 1) % 4])) return true;
    for (size_t k = 0; k < s->figure.n; k++)
        if (meets_segment(&b->area, &s->figure.at[k], &s->figure.at[next_of(&s->figure, k)])) return true;
    mpq_add(scratch[5].x, b->area.at[0].x, b->area.at[2].x);
    mpq_add(scratch[5].y, b->area.at[0].y, b->area.at[2].y);
    mpq_div_2exp(scratch[5].x, scratch[5].x, 1);
    mpq_div_2exp(scratch[5].y, scratch[5].y, 1);
    return is_inside(&s->figure, &scratch[5]);
}

/* Relates the translated feature and barrier k; square: their squared distance if they do not meet. */
static stance stand(const scene *s, size_t k, mpq_t square)
{
    const barrier *b = &s->made[k];
    bool any = false, met = false;
    if (!b->lines) {
        met = meets_area(s, b);
        for (size_t i = 0; i < 4; i++) least_square(square, &s->figure, &b->area.at[i], &b->area.at[(i + 1) % 4], &any);
    }
    point p, q;
    mpq_inits(p.x, p.y, q.x, q.y, NULL);
    for (size_t i = 0, line = 0, from = 0; line < b->lines && !met; from = b->end[line++])
        for (i = from; i < b->end[line] && !met; i++) {
            const size_t j = i + 1 < b->end[line] ? i + 1 : i;
            mpq_set_d(p.x, b->xy[2 * i]), mpq_set_d(p.y, b->xy[2 * i + 1]);
            mpq_set_d(q.x, b->xy[2 * j]), mpq_set_d(q.y, b->xy[2 * j + 1]);
            met = meets_segment(&s->figure, &p, &q);
            least_square(square, &s->figure, &p, &q, &any);
        }
    const double gap = s->barrier[k].gap < 0 ? s->options.gap : s->barrier[k].gap;
    mpq_set_d(number[0], s->barrier[k].width / 2);
    mpq_set_d(number[1], gap);
    mpq_add(number[1], number[0], number[1]);
    mpq_mul(number[0], number[0], number[0]);
    mpq_mul(number[1], number[1], number[1]);
    mpq_clears(p.x, p.y, q.x, q.y, NULL);
    return met ? MET : mpq_cmp(square, number[0]) < 0 ? DRAWN : mpq_cmp(square, number[1]) < 0 ? NEAR : FREE;
}

static const sunder_conflict *find(const sunder_report *report, size_t b)
{
    size_t n;
    const sunder_conflict *c = sunder_report_conflicts(report, &n);
    for (size_t k = 0; k < n; k++)
        if (c[k].a == 0 && c[k].b == b) return &c[k];
    return NULL;
}

static uint64_t current; /* the number of the present case */

static size_t seen[MET + 1];

/* The report lists exactly the conflicts that exist when the feature is at its place. */
static void compare(const scene *s, const sunder_report *report)
{
    static const sunder_conflict_kind kind_of[] = {[NEAR] = SUNDER_CONFLICT_BARRIER_NEAR,
                                                   [DRAWN] = SUNDER_CONFLICT_BARRIER_DRAWN,
                                                   [MET] = SUNDER_CONFLICT_BARRIER};
    size_t n, listed = 0;
    mpq_t square;
    mpq_init(square);
    for (size_t k = 0; k < s->barriers; k++) {
        const stance now = stand(s, k, square);
        const sunder_conflict *c = find(report, 1 + k);
        const char *wrong = NULL;
        if (!c != (now == FREE)) wrong = c ? "listed, although not in conflict" : "not listed";
        if (c && !wrong && c->kind != kind_of[now]) wrong = "of the wrong kind";
        seen[now]++;
        if (c && !wrong && now != MET) {
            const double d = sqrt(mpq_get_d(square)); /* correct to a few ulps of the far coordinates, 2^-20 */
            if (!(fabs(c->distance - d) <= 1e-9 * (d + 1))) wrong = "the reported distance is wrong";
        }
        if (c && !wrong && c->missing != fmax(0, c->required - c->distance) + c->depth)
            wrong = "the reported missing length is wrong";
        if (c && !wrong && now == MET && !(c->depth > 0 && c->distance == 0))
            wrong = "the reported depth is not positive";
        if (wrong)
            fail_msg("SUNDER_SEED=%llu, case %llu: barrier %zu is %s", (unsigned long long)test_seed(),
                     (unsigned long long)current, k, wrong);
        listed += c != NULL;
    }
    sunder_report_conflicts(report, &n);
    assert_int_equal(n, listed);
    mpq_clear(square);
}

static void check_as_they_stand(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    scene s;
    figure_init(&s.figure);
    for (int k = 0; k < MOST; k++) figure_init(&s.made[k].area);
    for (uint64_t i = 0; i < test_count(600); i++) {
        rng r = rng_start(seed, i);
        sunder_report *report = NULL;
        sunder_error err;
        draw(&s, &r);
        place(&s.figure, s.xy, (double[2]){0, 0});
        current = i;
        if (sunder_layer_check(s.layer, &s.options, &report, &err)) fail_msg("%s", err.message);
        compare(&s, report);
        sunder_report_free(report);
        erase(&s);
    }
    for (stance k = FREE; k <= MET; k++) assert_true(seen[k] > 0);
    figure_clear(&s.figure);
    for (int k = 0; k < MOST; k++) figure_clear(&s.made[k].area);
}

/* After a separation the list contains exactly the conflicts of the written result. Without a limit there are none,
 * since the feature can always go around the barrier. */
static void check_separated(void **state)
{
    (void)state;
    const uint64_t seed = test_seed();
    scene s;
    figure_init(&s.figure);
    for (int k = 0; k < MOST; k++) figure_init(&s.made[k].area);
    for (uint64_t i = 0; i < test_count(200); i++) {
        rng r = rng_start(seed, i ^ UINT64_C(1) << 40);
        sunder_report *report = NULL;
        sunder_layer_summary summary;
        sunder_error err;
        double t[2];
        size_t left;
        current = i;
        draw(&s, &r);
        const bool limited = rng_once_in(&r, 2);
        if (limited) s.layer = limit_to(&s, s.unit * (double)rng_int(&r, 1, 8));
        s.options.effort = 0;
        if (sunder_layer_separate(s.layer, &s.options, &report, &err))
            fail_msg("case %llu: %s", (unsigned long long)i, err.message);
        sunder_report_summary(report, &summary);
        sunder_report_move(report, 0, &t[0], &t[1]);
        sunder_report_conflicts(report, &left);
        if (!summary.verified || summary.rounded) fail_msg("case %llu: not verified", (unsigned long long)i);
        if (!limited && left) fail_msg("case %llu: %zu conflicts left without a limit", (unsigned long long)i, left);
        place(&s.figure, s.xy, t);
        compare(&s, report);
        assert_true(left || summary.lower_bound <= summary.cost);
        sunder_report_free(report);
        erase(&s);
    }
    figure_clear(&s.figure);
    for (int k = 0; k < MOST; k++) figure_clear(&s.made[k].area);
}

int main(void)
{
    make_scratch();
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_as_they_stand), cmocka_unit_test(check_separated)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    free_scratch();
    return failed;
}
