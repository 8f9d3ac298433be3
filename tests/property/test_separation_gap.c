/* Least translations with a gap: they keep the gap, in rationals; and no shorter one does, compared with an enumeration
 * in doubles of all crossings of two parts of the dilated boundary. Shares no code with the library.
 *
 * Inputs are small integers, so a distance that is not exactly the gap differs from it by far more than the 1e-9
 * allowed to doubles, except for near-coincidences of irrational numbers, which the tolerance of 1e-6 on lengths allows
 * for. */
#include "generate.h"
#include "separation/least_translation.h"
#include "separation/separation.h"
#include "slabs.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct side {
    double ax, ay, bx, by;
} side;

static size_t sides_of(const polyset *s, side *out)
{
    size_t n = 0;
    for (size_t r = 0, v = 0; r < s->rings; r++) {
        const size_t first = v, end = s->ring_end[r];
        for (; v < end; v++) {
            const size_t w = v + 1 < end ? v + 1 : first;
            out[n++] = (side){s->xy[2 * v], s->xy[2 * v + 1], s->xy[2 * w], s->xy[2 * w + 1]};
        }
    }
    return n;
}

static double point_side(double x, double y, const side *s)
{
    const double dx = s->bx - s->ax, dy = s->by - s->ay;
    double t = ((x - s->ax) * dx + (y - s->ay) * dy) / (dx * dx + dy * dy);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(x - s->ax - t * dx, y - s->ay - t * dy);
}

/* Distance of P and Q + (tx, ty), 0 if they meet. The distances of ends and the inside tests detect everything except
 * edges that cross properly; so crossings are tested, too. */
static double set_distance(const polyset *p, const polyset *q, const side *a, size_t n, const side *b, size_t m,
                           double tx, double ty, double enough)
{
    double least = INFINITY;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < m; j++) {
            const side s = {b[j].ax + tx, b[j].ay + ty, b[j].bx + tx, b[j].by + ty};
            const double d = fmin(fmin(point_side(a[i].ax, a[i].ay, &s), point_side(a[i].bx, a[i].by, &s)),
                                  fmin(point_side(s.ax, s.ay, a + i), point_side(s.bx, s.by, a + i)));
            least = fmin(least, d);
            if (least < enough) return least;
            const double ux = a[i].bx - a[i].ax, uy = a[i].by - a[i].ay, vx = s.bx - s.ax, vy = s.by - s.ay;
            const double c1 = ux * (s.ay - a[i].ay) - uy * (s.ax - a[i].ax),
                         c2 = ux * (s.by - a[i].ay) - uy * (s.bx - a[i].ax);
            const double c3 = vx * (a[i].ay - s.ay) - vy * (a[i].ax - s.ax),
                         c4 = vx * (a[i].by - s.ay) - vy * (a[i].bx - s.ax);
            if (c1 * c2 < 0 && c3 * c4 < 0) return 0;
        }
    /* The boundaries do not meet: if one of them is inside the other set, the interiors meet. */
    for (size_t r = 0, v = 0; r < q->rings; v = q->ring_end[r++])
        if (polyset_holds(p, q->xy[2 * v] + tx, q->xy[2 * v + 1] + ty)) return 0;
    for (size_t r = 0, v = 0; r < p->rings; v = p->ring_end[r++])
        if (polyset_holds(q, p->xy[2 * v] - tx, p->xy[2 * v + 1] - ty)) return 0;
    return least;
}

typedef struct spot {
    double x, y, length;
} spot;

static int by_length(const void *a, const void *b)
{
    const double s = ((const spot *)a)->length, t = ((const spot *)b)->length;
    return (s > t) - (s < t);
}

typedef struct spots {
    spot *at;
    size_t n, capacity;
    double limit;
} spots;

static void put(spots *s, double x, double y)
{
    const double length = hypot(x, y);
    if (!(length <= s->limit)) return;
    if (s->n == s->capacity) {
        s->capacity = s->capacity ? 2 * s->capacity : 1024;
        s->at = test_resize(s->at, s->capacity, sizeof *s->at);
    }
    s->at[s->n++] = (spot){x, y, length};
}

typedef struct track {
    double x, y, dx, dy; /* a line of unit direction, or a circle (dx = dy = 0) about (x, y) */
} track;

static bool same_track(const track *a, const track *b)
{
    return fabs(a->x - b->x) < 1e-9 && fabs(a->y - b->y) < 1e-9 && fabs(a->dx - b->dx) < 1e-9 &&
           fabs(a->dy - b->dy) < 1e-9;
}

static void add_track(track *t, size_t *n, track v)
{
    for (size_t i = 0; i < *n; i++)
        if (same_track(t + i, &v)) return;
    t[(*n)++] = v;
}

static size_t find_tracks(track *t, const polyset *p, const polyset *q, double gap)
{
    size_t n = 0;
    side *a = test_alloc(p->vertices, sizeof *a), *b = test_alloc(q->vertices, sizeof *b);
    const size_t an = sides_of(p, a), bn = sides_of(q, b);
    for (size_t i = 0; i < an; i++)
        for (size_t j = 0; j < bn; j++) {
            add_track(t, &n, (track){a[i].ax - b[j].ax, a[i].ay - b[j].ay, 0, 0});
            for (int k = 0; k < 2; k++) {
                double dx = k ? b[j].bx - b[j].ax : a[i].bx - a[i].ax, dy = k ? b[j].by - b[j].ay : a[i].by - a[i].ay;
                const double f = hypot(dx, dy), x = a[i].ax - b[j].ax, y = a[i].ay - b[j].ay;
                dx /= f;
                dy /= f;
                if (dx < 0 || (dx == 0 && dy < 0)) {
                    dx = -dx;
                    dy = -dy;
                }
                for (int sign = -1; sign <= 1; sign += 2) {
                    /* The line is given by its point nearest to the origin. */
                    const double h = dx * y - dy * x + sign * gap;
                    add_track(t, &n, (track){-dy * h, dx * h, dx, dy});
                }
            }
        }
    free(a);
    free(b);
    return n;
}

static void meet(spots *s, const track *t, const track *u, double gap)
{
    const bool tc = t->dx == 0 && t->dy == 0, uc = u->dx == 0 && u->dy == 0;
    if (!tc && !uc) {
        const double cross = t->dx * u->dy - t->dy * u->dx;
        if (fabs(cross) < 1e-9) return;
        const double k = ((u->x - t->x) * u->dy - (u->y - t->y) * u->dx) / cross;
        put(s, t->x + k * t->dx, t->y + k * t->dy);
    } else if (tc && uc) {
        const double vx = u->x - t->x, vy = u->y - t->y, f = hypot(vx, vy), h = gap * gap - f * f / 4;
        if (f < 1e-9 || h < -1e-9) return;
        const double half = sqrt(fmax(h, 0)) / f;
        put(s, (t->x + u->x) / 2 - vy * half, (t->y + u->y) / 2 + vx * half);
        put(s, (t->x + u->x) / 2 + vy * half, (t->y + u->y) / 2 - vx * half);
    } else {
        const track *l = tc ? u : t, *c = tc ? t : u;
        const double k = (c->x - l->x) * l->dx + (c->y - l->y) * l->dy;
        const double off = hypot(l->x + k * l->dx - c->x, l->y + k * l->dy - c->y), h = gap * gap - off * off;
        if (h < -1e-9) return;
        const double half = sqrt(fmax(h, 0));
        put(s, l->x + (k - half) * l->dx, l->y + (k - half) * l->dy);
        put(s, l->x + (k + half) * l->dx, l->y + (k + half) * l->dy);
    }
}

static double brute_force(const polyset *p, const polyset *q, double gap, double limit)
{
    side *a = test_alloc(p->vertices, sizeof *a), *b = test_alloc(q->vertices, sizeof *b);
    const size_t an = sides_of(p, a), bn = sides_of(q, b);
    track *t = test_alloc(5 * an * bn, sizeof *t);
    const size_t n = find_tracks(t, p, q, gap);
    spots s = {.limit = limit + 1e-3};
    for (size_t i = 0; i < n; i++) {
        if (t[i].dx == 0 && t[i].dy == 0) {
            const double f = hypot(t[i].x, t[i].y);
            if (f < 1e-12)
                put(&s, -gap, 0);
            else
                put(&s, t[i].x * (1 - gap / f), t[i].y * (1 - gap / f));
        } else
            put(&s, t[i].x, t[i].y);
        for (size_t j = 0; j < i; j++) meet(&s, t + i, t + j, gap);
    }
    if (s.n) qsort(s.at, s.n, sizeof *s.at, by_length);
    double found = INFINITY;
    for (size_t i = 0; i < s.n && found == INFINITY; i++)
        if (set_distance(p, q, a, an, b, bn, s.at[i].x, s.at[i].y, gap - 1e-9) >= gap - 1e-9) found = s.at[i].length;
    free(a);
    free(b);
    free(t);
    free(s.at);
    return found;
}

/* ---- The gap itself, in rationals ---- */

static void subtract(mpq_t out, double a, double b, const mpq_t t)
{
    mpq_t u;
    mpq_init(u);
    mpq_set_d(out, a);
    mpq_set_d(u, b);
    mpq_sub(out, out, u);
    mpq_add(out, out, t);
    mpq_clear(u);
}

/* Is the point at least the gap away from the side? The vector from a to the point is v, the one along the side is
 * d. */
static bool far_enough(const mpq_t vx, const mpq_t vy, double dx, double dy, double gap)
{
    mpq_t u, w, along, square, limit, x, y;
    mpq_inits(u, w, along, square, limit, x, y, NULL);
    mpq_set_d(u, dx);
    mpq_set_d(w, dy);
    mpq_mul(along, vx, u);
    mpq_mul(square, vy, w);
    mpq_add(along, along, square);
    mpq_mul(square, u, u);
    mpq_mul(limit, w, w);
    mpq_add(square, square, limit);
    mpq_div(along, along, square);
    if (mpq_sgn(along) < 0) mpq_set_ui(along, 0, 1);
    if (mpq_cmp_ui(along, 1, 1) > 0) mpq_set_ui(along, 1, 1);
    mpq_mul(x, along, u);
    mpq_mul(y, along, w);
    mpq_sub(x, vx, x);
    mpq_sub(y, vy, y);
    mpq_mul(x, x, x);
    mpq_mul(y, y, y);
    mpq_add(x, x, y);
    mpq_set_d(limit, gap);
    mpq_mul(limit, limit, limit);
    const bool ok = mpq_cmp(x, limit) >= 0;
    mpq_clears(u, w, along, square, limit, x, y, NULL);
    return ok;
}

static bool keeps_gap(const polyset *p, const polyset *q, double gap, const mpq_t tx, const mpq_t ty)
{
    if (interiors_meet(p, q, (const mpq_t *)tx, (const mpq_t *)ty)) return false;
    side *a = test_alloc(p->vertices, sizeof *a), *b = test_alloc(q->vertices, sizeof *b);
    const size_t an = sides_of(p, a), bn = sides_of(q, b);
    mpq_t x, y, mx, my;
    mpq_inits(x, y, mx, my, NULL);
    mpq_neg(mx, tx);
    mpq_neg(my, ty);
    bool ok = true;
    for (size_t i = 0; i < an && ok; i++)
        for (size_t j = 0; j < bn && ok; j++) {
            subtract(x, b[j].ax, a[i].ax, tx);
            subtract(y, b[j].ay, a[i].ay, ty);
            ok = far_enough(x, y, a[i].bx - a[i].ax, a[i].by - a[i].ay, gap);
            subtract(x, a[i].ax, b[j].ax, mx);
            subtract(y, a[i].ay, b[j].ay, my);
            ok = ok && far_enough(x, y, b[j].bx - b[j].ax, b[j].by - b[j].ay, gap);
        }
    mpq_clears(x, y, mx, my, NULL);
    free(a);
    free(b);
    return ok;
}

static void complain(const char *what, const polyset *p, const polyset *q, double gap, const sunder_separation *s,
                     double truth)
{
    char *a = polyset_wkt(p), *b = polyset_wkt(q);
    print_error("%s: gap %g, got (%s, %s), length %.17g, bound %.17g, %s, attained %d; brute force %.17g\n%s\n%s\n",
                what, gap, s->dx_text, s->dy_text, s->distance, s->lower_bound, sunder_contact_string(s->contact),
                s->attained, truth, a, b);
    free(a);
    free(b);
    fail();
}

typedef struct tally {
    size_t moved, exact, isolated, contact[6];
} tally;

static void check_pair(const polyset *p, const polyset *q, double gap, bool wide, tally *t)
{
    sunder_shape *a = polyset_shape(p), *b = polyset_shape(q);
    assert_non_null(a);
    assert_non_null(b);
    sunder_separation s;
    sunder_error err = {0};
    const sunder_i_least_options options = {.gap = gap, .upper = INFINITY, .texts = true, .force_wide = wide};
    if (sunder_i_least(a, b, &options, &s, NULL, &err)) fail_msg("%s", err.message);
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    assert_int_equal(mpq_set_str(x, s.dx_text, 10), 0);
    assert_int_equal(mpq_set_str(y, s.dy_text, 10), 0);
    const double truth = brute_force(p, q, gap, s.distance);
    if (!keeps_gap(p, q, gap, x, y)) complain("too near", p, q, gap, &s, truth);
    if (s.overlap) {
        if (s.lower_bound > s.distance) complain("the bound exceeds the length", p, q, gap, &s, truth);
        if (s.attained && s.distance > s.lower_bound * (1 + 1e-9)) complain("not within 1e-9", p, q, gap, &s, truth);
        if (s.lower_bound > truth + 1e-6) complain("the bound is wrong", p, q, gap, &s, truth);
        if (s.attained && s.distance > truth + 1e-6) complain("not the least", p, q, gap, &s, truth);
        t->moved++;
        t->isolated += !s.attained;
        t->contact[s.contact]++;
    } else if (s.distance != 0)
        complain("a translation although the gap is kept already", p, q, gap, &s, truth);
    bool apart;
    assert_int_equal(sunder_pair_apart(a, b, gap, &apart, NULL), SUNDER_OK);
    mpq_set_ui(x, 0, 1);
    mpq_set_ui(y, 0, 1);
    if (apart != !s.overlap || apart != keeps_gap(p, q, gap, x, y)) complain("apart or not", p, q, gap, &s, truth);
    mpq_clears(x, y, NULL);
    sunder_separation_clear(&s);
    sunder_shape_free(a);
    sunder_shape_free(b);
}

static const pair_kind KINDS[] = {PAIR_SQUARES, PAIR_STEPS, PAIR_TRIANGLES, PAIR_TRIANGLE_STEPS,
                                  PAIR_PEG,     PAIR_SLIDE, PAIR_SLANTED,   PAIR_SIMPLE,
                                  PAIR_MEMBERS, PAIR_HOLES, PAIR_ROOMS,     PAIR_SELF};

static bool integers_only(const polyset *s)
{
    for (size_t i = 0; i < 2 * s->vertices; i++)
        if (s->xy[i] != floor(s->xy[i]) || fabs(s->xy[i]) > 1000) return false;
    return true;
}

static void gaps_are_kept_at_least_cost(void **state)
{
    const uint64_t seed = test_seed();
    const size_t rounds = test_count(150);
    tally t = {0};
    size_t done = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (size_t i = 0; done < rounds && i < 20 * rounds; i++) {
        rng r = rng_start(seed, i);
        polyset p, q;
        random_pair(&p, &q, &r, KINDS[i % (sizeof KINDS / sizeof *KINDS)]);
        polyset_negate(&q);
        /* Twice or four times as large, so that gaps fit between the walls. */
        const double scale = (double)rng_int(&r, 1, 4);
        polyset_scale(&p, scale, scale);
        bring_together(&p, &q, &r);
        static const double GAPS[] = {0.5, 1, 0.1, 1.5, 2, 3, 0.3};
        const double gap = GAPS[rng_int(&r, 0, 6)];
        if (p.vertices * q.vertices <= 90 && p.polygons <= 64 && q.polygons <= 64 && integers_only(&p) &&
            integers_only(&q)) {
            check_pair(&p, &q, gap, rng_once_in(&r, 4), &t);
            done++;
        }
        polyset_free(&p);
        polyset_free(&q);
    }
    print_message("%zu pairs, %zu moved, %zu past an isolated point; contacts:", done, t.moved, t.isolated);
    for (int k = 1; k < 6; k++) print_message(" %s %zu", sunder_contact_string((sunder_contact)k), t.contact[k]);
    print_message("\n");
    assert_true(t.contact[SUNDER_CONTACT_ARC] > 0 && t.contact[SUNDER_CONTACT_EDGE] > 0 &&
                t.contact[SUNDER_CONTACT_VERTEX] > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(gaps_are_kept_at_least_cost)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
