/* Erosions, openings and closings against brute force, and the laws that they obey.
 *
 * The oracle (support/oracle.h, no code of src/) tells of a point whether it lies in int X + int Y. So B + x is within
 * a closed regular set D exactly when x is not in the sum of the complement of D, cut off by a frame, and -B. Erosions
 * and closings are asked that at all places where they could go wrong: their own corners, what lies between two of
 * them, all differences of corners of D and B (ends of degenerate parts are among them), what lies between two of
 * those, and others drawn at random. Everything is scaled so that all of these are integers.
 *
 * An opening is held against the closing of the complement, which leaves it but for what fits exactly. */
#include "generate.h"
#include "oracle.h"
#include "sum_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gmp.h>

#define FRAME 64   /* beyond all that the boards here reach */
#define FINEST (1L << 20) /* the finest scale that a case may need, so that products of two integers are exact doubles */

/* ---- The library's answer as integers ---- */

static sunder_sum *answer(const polyset *p, const polyset *b, sunder_operation operation)
{
    static const sunder_sum_options how = {.threads = 2};
    sunder_shape *sp = polyset_shape(p), *sb = polyset_shape(b);
    sunder_sum *sum = NULL;
    sunder_error err = {0};
    if (!sp || !sb || sunder_morphology(sp, sb, operation, &how, &sum, &err) != SUNDER_OK)
        print_message("%s: %s\n", sunder_operation_string(operation), err.message);
    sunder_shape_free(sp);
    sunder_shape_free(sb);
    return sum;
}

static void vertex_of(const sunder_sum *sum, uint32_t v, mpq_t xy[2])
{
    char *x, *y;
    assert_int_equal(sunder_sum_vertex_text(sum, v, &x, &y, NULL), SUNDER_OK);
    mpq_set_str(xy[0], x, 10);
    mpq_set_str(xy[1], y, 10);
    sunder_free(x);
    sunder_free(y);
}

/* All vertices that the sum names: of rings, segments, points. */
static uint32_t *named(const sunder_sum *sum, size_t *n)
{
    sunder_sum_counts c;
    sunder_sum_count(sum, &c);
    uint32_t *all = test_alloc(c.vertices + 2 * c.degenerate_segments + c.degenerate_points + 1, sizeof *all);
    *n = 0;
    for (size_t p = 0; p < c.polygons; p++)
        for (size_t r = 0; r < sunder_sum_rings(sum, p); r++) {
            size_t m;
            const uint32_t *ring = sunder_sum_ring(sum, p, r, &m);
            memcpy(all + *n, ring, m * sizeof *ring);
            *n += m;
        }
    for (size_t i = 0; i < c.degenerate_segments; i++, *n += 2) sunder_sum_segment(sum, i, all + *n);
    for (size_t i = 0; i < c.degenerate_points; i++) all[(*n)++] = sunder_sum_point(sum, i);
    return all;
}

/* The least k that makes all of them integers; 0 if it is too large. */
static long scale_of(const sunder_sum *sum)
{
    size_t n;
    uint32_t *all = named(sum, &n);
    mpz_t k;
    mpq_t xy[2];
    mpz_init_set_ui(k, 1);
    mpq_inits(xy[0], xy[1], NULL);
    for (size_t i = 0; i < n; i++) {
        vertex_of(sum, all[i], xy);
        mpz_lcm(k, k, mpq_denref(xy[0]));
        mpz_lcm(k, k, mpq_denref(xy[1]));
    }
    const long scale = mpz_cmp_ui(k, FINEST) <= 0 ? mpz_get_si(k) : 0;
    mpz_clear(k);
    mpq_clears(xy[0], xy[1], NULL);
    free(all);
    return scale;
}

static void scaled(const sunder_sum *sum, uint32_t v, long k, double xy[2])
{
    mpq_t q[2], factor;
    mpq_inits(q[0], q[1], factor, NULL);
    mpq_set_si(factor, k, 1);
    vertex_of(sum, v, q);
    for (int i = 0; i < 2; i++) {
        mpq_mul(q[i], q[i], factor);
        assert_int_equal(mpz_cmp_ui(mpq_denref(q[i]), 1), 0);
        xy[i] = mpq_get_d(q[i]);
    }
    mpq_clears(q[0], q[1], factor, NULL);
}

/* Its polygons times k, and (may be NULL) segments and points as pairs and singles of coordinates. */
static void scaled_set(const sunder_sum *sum, long k, polyset *set, double **segments, double **points)
{
    sunder_sum_counts c;
    sunder_sum_count(sum, &c);
    polyset_init(set);
    for (size_t p = 0; p < c.polygons; p++) {
        for (size_t r = 0; r < sunder_sum_rings(sum, p); r++) {
            size_t n;
            const uint32_t *ring = sunder_sum_ring(sum, p, r, &n);
            for (size_t i = 0; i < n; i++) {
                double xy[2];
                scaled(sum, ring[i], k, xy);
                polyset_vertex(set, xy[0], xy[1]);
            }
            polyset_end_ring(set);
        }
        polyset_end_polygon(set);
    }
    if (!segments) return;
    *segments = test_alloc(4 * c.degenerate_segments + 1, sizeof **segments);
    *points = test_alloc(2 * c.degenerate_points + 1, sizeof **points);
    for (size_t i = 0; i < c.degenerate_segments; i++) {
        uint32_t ends[2];
        sunder_sum_segment(sum, i, ends);
        scaled(sum, ends[0], k, *segments + 4 * i);
        scaled(sum, ends[1], k, *segments + 4 * i + 2);
    }
    for (size_t i = 0; i < c.degenerate_points; i++) scaled(sum, sunder_sum_point(sum, i), k, *points + 2 * i);
}

/* ---- Is a point in a closed set of integers? Products of integers below 2^26 are exact in doubles. ---- */

static double side(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool between(double a, double b, double c) { return (a <= c && c <= b) || (b <= c && c <= a); }

static bool on_segment(const double *a, const double *b, const double *c)
{
    return side(a, b, c) == 0 && between(a[0], b[0], c[0]) && between(a[1], b[1], c[1]);
}

/* Members of a sum are disjoint: so even and odd count. */
static bool in_polygons(const polyset *set, const double *at)
{
    bool in = false;
    for (size_t r = 0; r < set->rings; r++) {
        const size_t first = r ? set->ring_end[r - 1] : 0, end = set->ring_end[r];
        for (size_t i = first; i < end; i++) {
            const double *a = set->xy + 2 * i, *b = set->xy + 2 * (i + 1 < end ? i + 1 : first);
            if (on_segment(a, b, at)) return true;
            if ((a[1] > at[1]) != (b[1] > at[1]) && (side(a, b, at) > 0) == (b[1] > a[1])) in = !in;
        }
    }
    return in;
}

typedef struct integer_set {
    polyset polygons;
    double *segments, *points;
    sunder_sum_counts counts;
} integer_set;

static bool contains(const integer_set *s, const double *at)
{
    if (in_polygons(&s->polygons, at)) return true;
    for (size_t i = 0; i < s->counts.degenerate_segments; i++)
        if (on_segment(s->segments + 4 * i, s->segments + 4 * i + 2, at)) return true;
    for (size_t i = 0; i < s->counts.degenerate_points; i++)
        if (s->points[2 * i] == at[0] && s->points[2 * i + 1] == at[1]) return true;
    return false;
}

/* ---- Asking the oracle ---- */

typedef struct probing {
    const integer_set *set;
    const oracle *outside; /* of the complement and -B */
    double *at;            /* places to ask */
    size_t n, wrong, inside, slim; /* slim: inside, but not in the polygons */
} probing;

static void ask(probing *p, double x, double y)
{
    const double at[2] = {x, y};
    char tx[32], ty[32];
    snprintf(tx, sizeof tx, "%.0f", x);
    snprintf(ty, sizeof ty, "%.0f", y);
    const bool ours = contains(p->set, at), theirs = !oracle_covers(p->outside, tx, ty);
    p->inside += theirs;
    p->slim += ours && !in_polygons(&p->set->polygons, at);
    if (ours == theirs) return;
    p->wrong++;
    if (p->wrong < 4) print_message("at (%s %s): the library says %d, the oracle %d\n", tx, ty, ours, theirs);
}

/* All corners, all differences of corners, then middles of pairs, and others. All are even: so middles are integers. */
static void ask_all(probing *p, const polyset *d, const polyset *b, rng *r, double reach)
{
    const integer_set *s = p->set;
    const size_t own = s->polygons.vertices + 2 * s->counts.degenerate_segments + s->counts.degenerate_points;
    p->at = test_alloc(2 * (own + d->vertices * b->vertices), sizeof *p->at);
    if (s->polygons.vertices) memcpy(p->at, s->polygons.xy, 2 * s->polygons.vertices * sizeof *p->at);
    p->n = s->polygons.vertices;
    memcpy(p->at + 2 * p->n, s->segments, 4 * s->counts.degenerate_segments * sizeof *p->at);
    p->n += 2 * s->counts.degenerate_segments;
    memcpy(p->at + 2 * p->n, s->points, 2 * s->counts.degenerate_points * sizeof *p->at);
    p->n += s->counts.degenerate_points;
    for (size_t i = 0; i < d->vertices; i++)
        for (size_t j = 0; j < b->vertices; j++, p->n++)
            for (int k = 0; k < 2; k++) p->at[2 * p->n + (size_t)k] = d->xy[2 * i + (size_t)k] - b->xy[2 * j + (size_t)k];
    for (size_t i = 0; i < p->n; i++) ask(p, p->at[2 * i], p->at[2 * i + 1]);
    for (size_t i = 0; i < 200 && p->n; i++) {
        const double *a = p->at + 2 * (size_t)rng_int(r, 0, (int64_t)p->n - 1);
        const double *c = i < own ? p->at + 2 * i : p->at + 2 * (size_t)rng_int(r, 0, (int64_t)p->n - 1);
        ask(p, (a[0] + c[0]) / 2, (a[1] + c[1]) / 2);
    }
    for (int i = 0; i < 50; i++)
        ask(p, (double)rng_int(r, (int64_t)-reach, (int64_t)reach), (double)rng_int(r, (int64_t)-reach, (int64_t)reach));
    free(p->at);
}

/* Is the ring o of a set within its ring h, which it may touch at points only? */
static bool ring_within(const polyset *set, size_t o, size_t h)
{
    polyset ring;
    polyset_init(&ring);
    const size_t from = h ? set->ring_end[h - 1] : 0;
    polyset_ring(&ring, set->xy + 2 * from, set->ring_end[h] - from);
    bool found = false, in = false;
    const size_t first = o ? set->ring_end[o - 1] : 0, end = set->ring_end[o];
    for (size_t i = first; i < end && !found; i++) {
        const double *a = set->xy + 2 * i, *b = set->xy + 2 * (i + 1 < end ? i + 1 : first);
        const double middle[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
        bool on = false;
        for (size_t k = 0; k < ring.vertices && !on; k++)
            on = on_segment(ring.xy + 2 * k, ring.xy + 2 * ((k + 1) % ring.vertices), middle);
        found = !on;
        in = found && in_polygons(&ring, middle);
    }
    polyset_free(&ring);
    return in;
}

static double ring_area(const polyset *set, size_t r)
{
    const size_t first = r ? set->ring_end[r - 1] : 0, end = set->ring_end[r];
    double area = 0;
    for (size_t i = first + 1; i + 1 < end; i++)
        area += side(set->xy + 2 * first, set->xy + 2 * i, set->xy + 2 * (i + 1));
    return area < 0 ? -area : area;
}

/* The hole that a member lies in, the smallest if several; SIZE_MAX: none. */
static size_t hole_around(const polyset *set, const bool *hole, size_t outer)
{
    size_t host = SIZE_MAX;
    for (size_t h = 0; h < set->rings; h++)
        if (hole[h] && ring_within(set, outer, h) && (host == SIZE_MAX || ring_area(set, h) < ring_area(set, host)))
            host = h;
    return host;
}

static void add_ring(polyset *out, const polyset *d, size_t r)
{
    const size_t from = r ? d->ring_end[r - 1] : 0;
    polyset_ring(out, d->xy + 2 * from, d->ring_end[r] - from);
}

/* The complement of a regular set without overlaps, within a frame: the frame and the holes become members, and the
 * outer rings holes of those around them. */
static void complement_of(polyset *out, const polyset *d, double frame)
{
    polyset_init(out);
    bool *hole = test_alloc(d->rings + 1, sizeof *hole);
    size_t *host = test_alloc(d->rings + 1, sizeof *host);
    for (size_t p = 0, r = 0; p < d->polygons; p++)
        for (const size_t outer = r; r < d->poly_end[p]; r++) hole[r] = r != outer;
    for (size_t r = 0; r < d->rings; r++) host[r] = hole[r] ? r : hole_around(d, hole, r);
    const double corners[8] = {-frame, -frame, frame, -frame, frame, frame, -frame, frame};
    polyset_ring(out, corners, 4);
    for (size_t r = 0; r < d->rings; r++)
        if (!hole[r] && host[r] == SIZE_MAX) add_ring(out, d, r);
    polyset_end_polygon(out);
    for (size_t h = 0; h < d->rings; h++) {
        if (!hole[h]) continue;
        add_ring(out, d, h);
        for (size_t r = 0; r < d->rings; r++)
            if (!hole[r] && host[r] == h) add_ring(out, d, r);
        polyset_end_polygon(out);
    }
    free(hole);
    free(host);
}

/* Is `sum`, from operands that are the integers given, the erosion of the regular set d by b? */
static bool is_erosion(const sunder_sum *sum, const polyset *d, const polyset *b, rng *r, size_t *slim)
{
    const long k = scale_of(sum);
    if (!k) return true; /* counted by the caller */
    integer_set s;
    polyset big_d, big_b, outside;
    sunder_sum_count(sum, &s.counts);
    scaled_set(sum, 2 * k, &s.polygons, &s.segments, &s.points);
    polyset_copy(&big_d, d);
    polyset_copy(&big_b, b);
    polyset_scale(&big_d, 2.0 * (double)k, 2.0 * (double)k);
    polyset_scale(&big_b, 2.0 * (double)k, 2.0 * (double)k);
    double reach = 0;
    for (size_t i = 0; i < 2 * big_d.vertices; i++) reach = reach < big_d.xy[i] ? big_d.xy[i] : reach;
    complement_of(&outside, &big_d, 4 * reach + 200 * (double)k * FRAME);
    polyset_negate(&big_b);
    oracle *o = oracle_new(&outside, &big_b);
    polyset_negate(&big_b);
    probing p = {.set = &s, .outside = o};
    ask_all(&p, &big_d, &big_b, r, reach);
    *slim += p.slim > 0;
    oracle_free(o);
    polyset_free(&big_d);
    polyset_free(&big_b);
    polyset_free(&outside);
    polyset_free(&s.polygons);
    free(s.segments);
    free(s.points);
    return p.wrong == 0;
}

/* ---- Cases ---- */

/* Two simple polygons; or a board, its parts disjoint members; and what to grow and shrink by: a smaller board, a
 * simple or a convex polygon, or one that comes off the board's own grid, so that fits are exact. */
static void random_case(polyset *p, polyset *b, rng *r)
{
    cells board, small;
    polyset_init(p);
    polyset_init(b);
    const spacing kind = rng_once_in(r, 2) ? SPACING_UNIT : SPACING_SMALL;
    if (rng_once_in(r, 4)) {
        random_simple(p, r, (int)rng_int(r, 4, 8), 9);
        random_simple(b, r, (int)rng_int(r, 3, 4), 3);
    }
    while (!p->polygons) {
        random_cells(&board, r, (int)rng_int(r, 3, 7), (int)rng_int(r, 3, 7), kind, rng_once_in(r, 3), (int)rng_int(r, 60, 95));
        cells_outline(p, &board, rng_once_in(r, 2), true);
    }
    while (!b->polygons) switch (rng_int(r, 0, 3)) {
        case 0: {
            const double w = (double)rng_int(r, 1, 3), h = (double)rng_int(r, 1, 3);
            polyset_rectangle(b, 0, 0, w, h);
            break;
        }
        case 1:
            random_simple(b, r, (int)rng_int(r, 3, 5), 3);
            break;
        default:
            random_cells(&small, r, (int)rng_int(r, 1, 3), (int)rng_int(r, 1, 3), kind, rng_once_in(r, 4), 70);
            cells_outline(b, &small, true, true);
        }
    polyset_move(b, (double)rng_int(r, -2, 2), (double)rng_int(r, -2, 2));
}

static void show(const char *what, size_t i, const polyset *p, const polyset *b)
{
    char *tp = polyset_wkt(p), *tb = polyset_wkt(b);
    print_message("%s, SUNDER_SEED=%llu, case %zu\n%s\n%s\n", what, (unsigned long long)test_seed(), i, tp, tb);
    free(tp);
    free(tb);
}

static void test_erosions(void **state)
{
    const size_t n = test_count(300);
    size_t bad = 0, slim = 0, too_fine = 0;
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() + 77, i);
        polyset p, b;
        random_case(&p, &b, &r);
        sunder_sum *e = answer(&p, &b, SUNDER_ERODE);
        assert_non_null(e);
        too_fine += !scale_of(e);
        if (!is_erosion(e, &p, &b, &r, &slim) && bad++ < 3) show("erode", i, &p, &b);
        sunder_sum_free(e);
        polyset_free(&p);
        polyset_free(&b);
    }
    print_message("%zu erosions, %zu with parts without area, %zu too fine to ask\n", n, slim, too_fine);
    assert_int_equal(bad, 0);
    assert_true(slim > n / 20);
    assert_true(too_fine < n / 4);
}

static void test_closings(void **state)
{
    const size_t n = test_count(150);
    size_t bad = 0, slim = 0, asked = 0;
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() + 78, i);
        polyset p, b, d;
        random_case(&p, &b, &r);
        sunder_sum *dilated = answer(&p, &b, SUNDER_DILATE);
        assert_non_null(dilated);
        const long k = scale_of(dilated);
        if (k && k <= 1000) {
            scaled_set(dilated, k, &d, NULL, NULL);
            polyset_scale(&p, (double)k, (double)k);
            polyset_scale(&b, (double)k, (double)k);
            sunder_sum *closed = answer(&p, &b, SUNDER_CLOSE);
            assert_non_null(closed);
            asked += scale_of(closed) != 0;
            if (!is_erosion(closed, &d, &b, &r, &slim) && bad++ < 3) show("close", i, &p, &b);
            sunder_sum_free(closed);
            polyset_free(&d);
        }
        sunder_sum_free(dilated);
        polyset_free(&p);
        polyset_free(&b);
    }
    print_message("%zu closings, %zu asked, %zu with parts without area\n", n, asked, slim);
    assert_int_equal(bad, 0);
    assert_true(asked > n / 2);
}

/* ---- Laws ---- */

/* Canonical text of the union of two sets' polygons, which are integers. */
static char *union_text(const polyset *a, const polyset *b)
{
    polyset both;
    polyset_copy(&both, a);
    polyset_append(&both, b);
    sunder_shape *shape = polyset_shape(&both);
    sunder_sum *sum = NULL;
    assert_non_null(shape);
    assert_int_equal(sunder_shape_union(shape, NULL, &sum, NULL), SUNDER_OK);
    char *text = sum_text(sum);
    sunder_sum_free(sum);
    sunder_shape_free(shape);
    polyset_free(&both);
    return text;
}

/* Does a regular set lie within another? */
static bool within(const polyset *a, const polyset *b)
{
    polyset none;
    polyset_init(&none);
    char *both = union_text(b, a), *alone = union_text(b, &none);
    const bool same = strcmp(both, alone) == 0;
    free(both);
    free(alone);
    return same;
}

/* Segments and points of an erosion, each plus B: members of a set. */
static void add_slim_parts(polyset *out, const polyset *b, const double *segments, size_t n, const double *points,
                           size_t m)
{
    size_t triangles;
    double *t = oracle_triangles(b, &triangles);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < triangles; k++) {
            polyset two, hull;
            polyset_init(&two);
            for (size_t v = 0; v < 6; v++) {
                const double *end = segments + 4 * i + 2 * (v / 3), *c = t + 6 * k + 2 * (v % 3);
                polyset_vertex(&two, end[0] + c[0], end[1] + c[1]);
            }
            polyset_end_ring(&two);
            polyset_end_polygon(&two);
            polyset_hull(&hull, &two);
            polyset_append(out, &hull);
            polyset_free(&two);
            polyset_free(&hull);
        }
    for (size_t i = 0; i < m; i++) {
        polyset here;
        polyset_copy(&here, b);
        polyset_move(&here, points[2 * i], points[2 * i + 1]);
        polyset_append(out, &here);
        polyset_free(&here);
    }
    free(t);
}

/* What the closing of the complement by -B leaves of the frame is what B reaches from the inside of the erosion; with
 * what it reaches from the erosion's parts without area, exact fits, that makes the opening. */
static bool opening_is_what_closing_leaves(const polyset *p, const polyset *b, const sunder_sum *opened)
{
    polyset c, turned;
    complement_of(&c, p, FRAME);
    polyset_copy(&turned, b);
    polyset_negate(&turned);
    sunder_sum *closed = answer(&c, &turned, SUNDER_CLOSE), *eroded = answer(p, b, SUNDER_ERODE);
    const long ko = scale_of(opened), kc = scale_of(closed), ke = scale_of(eroded), k = ko * kc * ke;
    bool ok = true;
    if (k && k <= FINEST) {
        polyset left, closed_set, large, none, opened_set;
        double *segments, *points;
        sunder_sum_counts counts;
        scaled_set(eroded, k, &large, &segments, &points);
        polyset_free(&large);
        sunder_sum_count(eroded, &counts);
        scaled_set(closed, k, &closed_set, NULL, NULL);
        scaled_set(opened, k, &opened_set, NULL, NULL);
        complement_of(&left, &closed_set, 2.0 * FRAME * (double)k);
        polyset_copy(&large, b);
        polyset_scale(&large, (double)k, (double)k);
        add_slim_parts(&left, &large, segments, counts.degenerate_segments, points, counts.degenerate_points);
        /* All else than the closed set was left, beyond the frame, too: that goes to the other side. */
        polyset ring;
        polyset_init(&ring);
        const double f = FRAME * (double)k, corners[8] = {-f, -f, f, -f, f, f, -f, f};
        const double outer[8] = {-2 * f, -2 * f, 2 * f, -2 * f, 2 * f, 2 * f, -2 * f, 2 * f};
        polyset_ring(&ring, outer, 4);
        polyset_ring(&ring, corners, 4);
        polyset_end_polygon(&ring);
        polyset_append(&opened_set, &ring);
        polyset_init(&none);
        char *x = union_text(&left, &none), *y = union_text(&opened_set, &none);
        ok = strcmp(x, y) == 0;
        free(x);
        free(y);
        free(segments);
        free(points);
        polyset_free(&left);
        polyset_free(&ring);
        polyset_free(&large);
        polyset_free(&closed_set);
        polyset_free(&opened_set);
    }
    sunder_sum_free(closed);
    sunder_sum_free(eroded);
    polyset_free(&c);
    polyset_free(&turned);
    return ok;
}

static char *text_of(const polyset *p, const polyset *b, sunder_operation operation)
{
    sunder_sum *sum = answer(p, b, operation);
    char *text = sum ? sum_text(sum) : NULL;
    sunder_sum_free(sum);
    return text;
}

/* Applied to its own result it changes nothing (but that parts without area are gone). */
static bool is_idempotent(const sunder_sum *once, const polyset *b, sunder_operation operation)
{
    const long k = scale_of(once);
    if (!k) return true;
    polyset set, large, none;
    scaled_set(once, k, &set, NULL, NULL);
    polyset_copy(&large, b);
    polyset_scale(&large, (double)k, (double)k);
    sunder_sum *twice = answer(&set, &large, operation);
    polyset again;
    const long m = scale_of(twice);
    bool ok = m == 1 || m == 0;
    if (ok && m) {
        scaled_set(twice, 1, &again, NULL, NULL);
        polyset_init(&none);
        char *x = union_text(&set, &none), *y = union_text(&again, &none);
        ok = strcmp(x, y) == 0;
        free(x);
        free(y);
        polyset_free(&again);
    }
    sunder_sum_free(twice);
    polyset_free(&set);
    polyset_free(&large);
    return ok;
}

static bool is_blind_to_shifts(const polyset *p, const polyset *b, sunder_operation operation)
{
    polyset moved;
    polyset_copy(&moved, b);
    polyset_move(&moved, 17, -5);
    char *here = text_of(p, b, operation), *there = text_of(p, &moved, operation);
    if (operation == SUNDER_ERODE) {
        char *back = sum_text_moved(there, 0, 17, -5);
        free(there);
        there = back;
    }
    const bool same = here && there && strcmp(here, there) == 0;
    free(here);
    free(there);
    polyset_free(&moved);
    return same;
}

/* dilate(X) in Y exactly when X in erode(Y). */
static bool is_adjoint(const polyset *y, const polyset *b, rng *r, size_t *fits)
{
    polyset x;
    polyset_init(&x);
    const double at[2] = {(double)rng_int(r, 0, 5), (double)rng_int(r, 0, 5)};
    polyset_rectangle(&x, at[0], at[1], at[0] + (double)rng_int(r, 1, 2), at[1] + (double)rng_int(r, 1, 2));
    sunder_sum *dilated = answer(&x, b, SUNDER_DILATE), *eroded = answer(y, b, SUNDER_ERODE);
    const long k = scale_of(dilated), m = scale_of(eroded);
    bool ok = true;
    if (k && m) {
        polyset sd, se, sx, sy;
        scaled_set(dilated, k, &sd, NULL, NULL);
        scaled_set(eroded, m, &se, NULL, NULL);
        polyset_copy(&sx, &x);
        polyset_copy(&sy, y);
        polyset_scale(&sx, (double)m, (double)m);
        polyset_scale(&sy, (double)k, (double)k);
        const bool one = within(&sd, &sy), other = within(&sx, &se);
        ok = one == other;
        *fits += one;
        polyset_free(&sd);
        polyset_free(&se);
        polyset_free(&sx);
        polyset_free(&sy);
    }
    sunder_sum_free(dilated);
    sunder_sum_free(eroded);
    polyset_free(&x);
    return ok;
}

static void test_laws(void **state)
{
    const size_t n = test_count(150);
    size_t bad = 0, fits = 0;
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() + 79, i);
        polyset p, b;
        random_case(&p, &b, &r);
        sunder_sum *opened = answer(&p, &b, SUNDER_OPEN), *closed = answer(&p, &b, SUNDER_CLOSE);
        assert_non_null(opened);
        assert_non_null(closed);
        const long k = scale_of(opened), m = scale_of(closed);
        const char *broken = NULL;
        if (!opening_is_what_closing_leaves(&p, &b, opened)) broken = "an opening and the closing of the complement";
        if (!is_idempotent(opened, &b, SUNDER_OPEN)) broken = "open twice";
        if (!is_idempotent(closed, &b, SUNDER_CLOSE)) broken = "close twice";
        if (!is_blind_to_shifts(&p, &b, SUNDER_OPEN)) broken = "open by a shape moved";
        if (!is_blind_to_shifts(&p, &b, SUNDER_CLOSE)) broken = "close by a shape moved";
        if (!is_blind_to_shifts(&p, &b, SUNDER_ERODE)) broken = "erode by a shape moved";
        if (!is_adjoint(&p, &b, &r, &fits)) broken = "dilate and erode";
        if (k && m) {
            polyset so, sc, sp;
            scaled_set(opened, k, &so, NULL, NULL);
            scaled_set(closed, m, &sc, NULL, NULL);
            polyset_copy(&sp, &p);
            polyset_scale(&sp, (double)k, (double)k);
            if (!within(&so, &sp)) broken = "an opening that sticks out";
            polyset_free(&sp);
            polyset_copy(&sp, &p);
            polyset_scale(&sp, (double)m, (double)m);
            if (!within(&sp, &sc)) broken = "a closing that leaves something out";
            polyset_free(&so);
            polyset_free(&sc);
            polyset_free(&sp);
        }
        if (broken && bad++ < 3) show(broken, i, &p, &b);
        sunder_sum_free(opened);
        sunder_sum_free(closed);
        polyset_free(&p);
        polyset_free(&b);
    }
    print_message("%zu cases; X + B in Y in %zu of them\n", n, fits);
    assert_int_equal(bad, 0);
    assert_true(fits > n / 20 && fits < n);
}

/* Members that overlap count as their union. */
static void test_overlaps(void **state)
{
    const size_t n = test_count(80);
    for (size_t i = 0; i < n; i++) {
        rng r = rng_start(test_seed() + 80, i);
        polyset p, b, other, whole;
        random_case(&p, &b, &r);
        random_case(&other, &whole, &r);
        polyset_free(&whole);
        polyset_move(&other, (double)rng_int(&r, 0, 3), (double)rng_int(&r, 0, 3));
        polyset_append(&p, &other);
        sunder_shape *shape = polyset_shape(&p);
        sunder_sum *sum;
        assert_int_equal(sunder_shape_union(shape, NULL, &sum, NULL), SUNDER_OK);
        const long k = scale_of(sum);
        if (k) {
            scaled_set(sum, k, &whole, NULL, NULL);
            polyset_scale(&p, (double)k, (double)k);
            polyset_scale(&b, (double)k, (double)k);
            for (int op = SUNDER_DILATE; op <= SUNDER_CLOSE; op++) {
                char *one = text_of(&p, &b, (sunder_operation)op), *two = text_of(&whole, &b, (sunder_operation)op);
                if (strcmp(one, two) != 0) show(sunder_operation_string((sunder_operation)op), i, &p, &b);
                assert_string_equal(one, two);
                free(one);
                free(two);
            }
            polyset_free(&whole);
        }
        sunder_sum_free(sum);
        sunder_shape_free(shape);
        polyset_free(&p);
        polyset_free(&b);
        polyset_free(&other);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_erosions),
        cmocka_unit_test(test_closings),
        cmocka_unit_test(test_laws),
        cmocka_unit_test(test_overlaps),
    };
    return cmocka_run_group_tests_name("morphology", tests, NULL, NULL);
}
