/* Convex decompositions of random sets, verified in GMP rationals. Every piece is strictly convex and
 * counter-clockwise. No edge of its member meets its inside and its centroid lies in the member, so the piece lies in
 * the member. Pieces of one member are separated by a line, and their areas add up to the member's; together this
 * proves that they make up the member. Independently, at random rational points the number of pieces around the point
 * equals the number of input polygons by the even-odd rule. The numbers of pieces obey the bounds known from theory. */
#include "decomposition/maker.h"
#include "generate.h"
#include "gmp_numbers.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const sunder_decomposition kinds[] = {SUNDER_DECOMPOSITION_HERTEL_MEHLHORN, SUNDER_DECOMPOSITION_TRIANGULATION,
                                             SUNDER_DECOMPOSITION_ANGLE_BISECTOR,  SUNDER_DECOMPOSITION_VERTICAL,
                                             SUNDER_DECOMPOSITION_OPTIMAL,         SUNDER_DECOMPOSITION_MIXED};
#define KINDS 6

typedef struct qpoint {
    mpq_t x, y;
} qpoint;

/* A shape on a lattice, and one decomposition of it, in rationals, in lattice units. */
typedef struct subject {
    const polyset *raw;
    sunder_shape *shape;
    sunder_i_placed placed;
    qpoint *vertex; /* [vertices] */
    sunder_i_decomposition d;
    qpoint *corner;   /* [corners] */
    mpq_t a, b, c;    /* scratch */
    mpq_t side, e[4]; /* scratch of orient() */
} subject;

static void qpoint_init(qpoint *p)
{
    mpq_init(p->x);
    mpq_init(p->y);
}

static void qpoint_clear(qpoint *p)
{
    mpq_clear(p->x);
    mpq_clear(p->y);
}

static void set_ratio(mpq_t r, sunder_i_big num, sunder_i_big den)
{
    mpz_from_big(mpq_numref(r), num);
    mpz_from_big(mpq_denref(r), den);
    mpq_canonicalize(r);
}

/* Twice the area of abc in s->side; returns its sign. */
static int orient(subject *s, const qpoint *a, const qpoint *b, const qpoint *c)
{
    mpq_sub(s->e[0], b->x, a->x);
    mpq_sub(s->e[1], c->y, a->y);
    mpq_sub(s->e[2], b->y, a->y);
    mpq_sub(s->e[3], c->x, a->x);
    mpq_mul(s->e[0], s->e[0], s->e[1]);
    mpq_mul(s->e[2], s->e[2], s->e[3]);
    mpq_sub(s->side, s->e[0], s->e[2]);
    return mpq_sgn(s->side);
}

static const qpoint *corner_of(const subject *s, uint32_t piece, uint32_t k)
{
    const uint32_t first = sunder_i_piece_first(&s->d, piece), n = s->d.piece_end[piece] - first;
    return &s->corner[s->d.piece_corner[first + k % n]];
}

static uint32_t sides_of(const subject *s, uint32_t piece)
{
    return s->d.piece_end[piece] - sunder_i_piece_first(&s->d, piece);
}

/* +1 inside, 0 on the boundary, -1 outside of a convex piece. */
static int in_piece(subject *s, uint32_t piece, const qpoint *x)
{
    int where = 1;
    for (uint32_t k = 0; k < sides_of(s, piece); k++) {
        const int side = orient(s, corner_of(s, piece, k), corner_of(s, piece, k + 1), x);
        if (side < 0) return -1;
        if (side == 0) where = 0;
    }
    return where;
}

/* Adds to *crossings those of the ray from x to the right with edge ab; false if x lies on ab. */
static bool count_crossing(subject *s, const qpoint *a, const qpoint *b, const qpoint *x, unsigned *crossings)
{
    const bool up_a = mpq_cmp(a->y, x->y) > 0, up_b = mpq_cmp(b->y, x->y) > 0;
    const int side = orient(s, a, b, x);
    if (side == 0) {
        const bool between_x = (mpq_cmp(a->x, x->x) <= 0) != (mpq_cmp(b->x, x->x) < 0) || mpq_equal(a->x, x->x);
        const bool between_y = (mpq_cmp(a->y, x->y) <= 0) != (mpq_cmp(b->y, x->y) < 0) || mpq_equal(a->y, x->y);
        if (between_x && between_y) return false;
    }
    if (up_a != up_b && (up_b ? side > 0 : side < 0)) ++*crossings;
    return true;
}

/* +1 inside a member of the shape, 0 on its boundary, -1 outside. */
static int in_member(subject *s, uint32_t member, const qpoint *x)
{
    const sunder_shape *shape = s->shape;
    unsigned crossings = 0;
    const uint32_t ring_lo = member ? shape->form->cleaned.poly_end[member - 1] : 0,
                   ring_hi = shape->form->cleaned.poly_end[member];
    for (uint32_t v = ring_lo ? shape->form->cleaned.ring_end[ring_lo - 1] : 0;
         v < shape->form->cleaned.ring_end[ring_hi - 1]; v++)
        if (!count_crossing(s, &s->vertex[v], &s->vertex[shape->form->cleaned.next[v]], x, &crossings)) return 0;
    return crossings & 1 ? 1 : -1;
}

/* ---- The proof ---- */

/* Does the segment ab meet the inside of the piece? The segment is clipped by one side after the other. What stays
 * strictly left of all sides is a + t (b - a), lo <= t <= hi, with lo and hi in s->a and s->b. */
static bool enters(subject *s, const qpoint *a, const qpoint *b, uint32_t piece)
{
    mpq_set_ui(s->a, 0, 1);
    mpq_set_ui(s->b, 1, 1);
    for (uint32_t k = 0; k < sides_of(s, piece); k++) {
        const qpoint *u = corner_of(s, piece, k), *v = corner_of(s, piece, k + 1);
        const int at_b = orient(s, u, v, b);
        mpq_set(s->c, s->side);
        const int at_a = orient(s, u, v, a);
        if (at_a <= 0 && at_b <= 0) return false;
        if (at_a >= 0 && at_b >= 0) continue;
        /* t = side(a) / (side(a) - side(b)) */
        mpq_sub(s->c, s->side, s->c);
        mpq_div(s->c, s->side, s->c);
        if (at_a < 0 && mpq_cmp(s->c, s->a) > 0) mpq_set(s->a, s->c);
        if (at_b < 0 && mpq_cmp(s->c, s->b) < 0) mpq_set(s->b, s->c);
        if (mpq_cmp(s->a, s->b) >= 0) return false;
    }
    return true;
}

/* Is there a side of piece i such that all of piece j is on its right or on it? */
static bool keeps_off(subject *s, uint32_t i, uint32_t j)
{
    for (uint32_t k = 0; k < sides_of(s, i); k++) {
        bool off = true;
        for (uint32_t m = 0; m < sides_of(s, j) && off; m++)
            off = orient(s, corner_of(s, i, k), corner_of(s, i, k + 1), corner_of(s, j, m)) <= 0;
        if (off) return true;
    }
    return false;
}

static void centroid(subject *s, uint32_t piece, qpoint *out)
{
    const uint32_t n = sides_of(s, piece);
    mpq_set_ui(out->x, 0, 1);
    mpq_set_ui(out->y, 0, 1);
    for (uint32_t k = 0; k < n; k++) {
        mpq_add(out->x, out->x, corner_of(s, piece, k)->x);
        mpq_add(out->y, out->y, corner_of(s, piece, k)->y);
    }
    mpq_set_ui(s->c, n, 1);
    mpq_div(out->x, out->x, s->c);
    mpq_div(out->y, out->y, s->c);
}

static const char *prove_piece(subject *s, uint32_t i)
{
    const sunder_shape *shape = s->shape;
    const uint32_t n = sides_of(s, i), member = s->d.member[i];
    for (uint32_t k = 0; k < n; k++)
        if (orient(s, corner_of(s, i, k), corner_of(s, i, k + 1), corner_of(s, i, k + 2)) <= 0) return "not convex";
    qpoint middle;
    qpoint_init(&middle);
    centroid(s, i, &middle);
    const bool inside = in_piece(s, i, &middle) == 1 && in_member(s, member, &middle) == 1;
    qpoint_clear(&middle);
    if (!inside) return "its centroid lies outside";
    const uint32_t ring_lo = member ? shape->form->cleaned.poly_end[member - 1] : 0,
                   ring_hi = shape->form->cleaned.poly_end[member];
    for (uint32_t v = ring_lo ? shape->form->cleaned.ring_end[ring_lo - 1] : 0;
         v < shape->form->cleaned.ring_end[ring_hi - 1]; v++)
        if (enters(s, &s->vertex[v], &s->vertex[shape->form->cleaned.next[v]], i)) return "an edge runs through it";
    for (uint32_t j = 0; j < i; j++)
        if (s->d.member[j] == member && !keeps_off(s, i, j) && !keeps_off(s, j, i)) return "it overlaps another";
    return NULL;
}

/* Twice the areas of the pieces and of the members. */
static bool areas_agree(subject *s)
{
    mpq_t total;
    mpq_init(total);
    qpoint o;
    qpoint_init(&o);
    for (uint32_t i = 0; i < s->d.pieces; i++)
        for (uint32_t k = 0; k < sides_of(s, i); k++) {
            orient(s, &o, corner_of(s, i, k), corner_of(s, i, k + 1));
            mpq_add(total, total, s->side);
        }
    for (uint32_t v = 0; v < s->shape->vertices; v++) {
        orient(s, &o, &s->vertex[v], &s->vertex[s->shape->form->cleaned.next[v]]);
        mpq_sub(total, total, s->side);
    }
    const bool agree = mpq_sgn(total) == 0;
    qpoint_clear(&o);
    mpq_clear(total);
    return agree;
}

/* ---- Random points ---- */

/* A double of the input, in lattice units. */
static void to_units(const subject *s, double v, double origin, mpq_t out)
{
    mpq_t o;
    mpq_init(o);
    mpq_set_d(out, v);
    mpq_set_d(o, origin);
    mpq_sub(out, out, o);
    const long e = s->placed.lattice.exponent;
    if (e > 0) mpq_div_2exp(out, out, (mp_bitcnt_t)e);
    if (e < 0) mpq_mul_2exp(out, out, (mp_bitcnt_t)-e);
    mpq_clear(o);
}

/* The number of input polygons that contain x, by the even-odd rule; negative if x lies on a ring. */
static int raw_count(subject *s, const qpoint *raw, const qpoint *x)
{
    int count = 0;
    size_t ring = 0, v = 0;
    for (size_t p = 0; p < s->raw->polygons; p++) {
        unsigned crossings = 0;
        for (; ring < s->raw->poly_end[p]; ring++) {
            const size_t first = v, end = s->raw->ring_end[ring];
            for (; v < end; v++)
                if (!count_crossing(s, &raw[v], &raw[v + 1 < end ? v + 1 : first], x, &crossings)) return -1;
        }
        count += (int)(crossings & 1);
    }
    return count;
}

static bool points_agree(subject *s, rng *r, int points)
{
    qpoint *raw = test_alloc(s->raw->vertices, sizeof *raw), x;
    for (size_t v = 0; v < s->raw->vertices; v++) {
        qpoint_init(&raw[v]);
        to_units(s, s->raw->xy[2 * v], s->placed.origin_p[0], raw[v].x);
        to_units(s, s->raw->xy[2 * v + 1], s->placed.origin_p[1], raw[v].y);
    }
    qpoint_init(&x);
    bool ok = true;
    for (int i = 0; i < points && ok; i++) {
        /* On the line between two vertices, near its midpoint: many of these points are on diagonals and edges. */
        const qpoint *a = &raw[rng_next(r) % s->raw->vertices], *b = &raw[rng_next(r) % s->raw->vertices];
        const qpoint *c = &raw[rng_next(r) % s->raw->vertices];
        const long k = rng_int(r, 0, 8), m = rng_int(r, 0, 8 - k);
        mpq_set_si(s->a, k, 8);
        mpq_set_si(s->b, m, 8);
        mpq_canonicalize(s->a);
        mpq_canonicalize(s->b);
        for (int y = 0; y < 2; y++) {
            mpq_ptr to = y ? x.y : x.x;
            mpq_srcptr pa = y ? a->y : a->x, pb = y ? b->y : b->x, pc = y ? c->y : c->x;
            mpq_set(to, pa);
            mpq_sub(s->c, pb, pa);
            mpq_mul(s->c, s->c, s->a);
            mpq_add(to, to, s->c);
            mpq_sub(s->c, pc, pa);
            mpq_mul(s->c, s->c, s->b);
            mpq_add(to, to, s->c);
        }
        const int want = raw_count(s, raw, &x);
        if (want < 0) continue;
        int inside = 0, closed = 0;
        for (uint32_t p = 0; p < s->d.pieces; p++) {
            const int where = in_piece(s, p, &x);
            inside += where > 0;
            closed += where >= 0;
        }
        ok = inside <= want && closed >= want && (want > 0 || closed == 0);
    }
    qpoint_clear(&x);
    for (size_t v = 0; v < s->raw->vertices; v++) qpoint_clear(&raw[v]);
    free(raw);
    return ok;
}

/* ---- Counts ---- */

typedef struct tally {
    uint32_t reflex, holes, vertices, pieces;
} tally;

static void tally_member(subject *s, uint32_t member, tally *t)
{
    const sunder_shape *shape = s->shape;
    const uint32_t ring_lo = member ? shape->form->cleaned.poly_end[member - 1] : 0,
                   ring_hi = shape->form->cleaned.poly_end[member];
    memset(t, 0, sizeof *t);
    t->holes = ring_hi - ring_lo - 1;
    for (uint32_t v = ring_lo ? shape->form->cleaned.ring_end[ring_lo - 1] : 0;
         v < shape->form->cleaned.ring_end[ring_hi - 1]; v++) {
        t->vertices++;
        t->reflex += orient(s, &s->vertex[shape->form->cleaned.prev[v]], &s->vertex[v],
                            &s->vertex[shape->form->cleaned.next[v]]) < 0;
    }
    for (uint32_t i = 0; i < s->d.pieces; i++) t->pieces += s->d.member[i] == member;
}

static bool counts_hold(subject *s, sunder_decomposition kind, uint32_t *pieces_of_best)
{
    bool ok = true;
    for (uint32_t member = 0; member < s->shape->form->cleaned.polygons; member++) {
        tally t;
        tally_member(s, member, &t);
        uint32_t most = t.vertices - 2 + 2 * t.holes;
        if (kind == SUNDER_DECOMPOSITION_ANGLE_BISECTOR) most = t.reflex + 1 - t.holes;
        if (kind == SUNDER_DECOMPOSITION_VERTICAL) most = 2 * t.reflex + 1 - t.holes;
        if (kind == SUNDER_DECOMPOSITION_TRIANGULATION) ok &= t.pieces == most;
        ok &= t.pieces <= most && t.pieces >= 1 &&
              (kind == SUNDER_DECOMPOSITION_TRIANGULATION || (t.reflex > 0) == (t.pieces > 1));
        /* Each additional piece removes at most two reflex vertices, and a hole needs at least one more piece. */
        ok &= 2 * (t.pieces + t.holes) >= t.reflex + 2;
        const bool solved = kind == SUNDER_DECOMPOSITION_OPTIMAL && t.holes == 0 && t.vertices <= SUNDER_I_OPTIMAL_MOST;
        if (solved) pieces_of_best[member] = t.pieces;
        if (pieces_of_best[member] &&
            (kind == SUNDER_DECOMPOSITION_HERTEL_MEHLHORN || kind == SUNDER_DECOMPOSITION_TRIANGULATION))
            ok &= t.pieces >= pieces_of_best[member];
        if (pieces_of_best[member] && kind == SUNDER_DECOMPOSITION_HERTEL_MEHLHORN)
            ok &= t.pieces <= 4 * pieces_of_best[member];
        if (pieces_of_best[member] && kind == SUNDER_DECOMPOSITION_ANGLE_BISECTOR && s->d.corners == s->shape->vertices)
            ok &= t.pieces >= pieces_of_best[member];
    }
    return ok;
}

/* ---- One case ---- */

static void load_corners(subject *s)
{
    s->corner = test_alloc(s->d.corners, sizeof *s->corner);
    for (uint32_t i = 0; i < s->d.corners; i++) {
        qpoint_init(&s->corner[i]);
        set_ratio(s->corner[i].x, s->d.corner[i].at.x, s->d.corner[i].at.w);
        set_ratio(s->corner[i].y, s->d.corner[i].at.y, s->d.corner[i].at.w);
    }
}

static const char *examine(subject *s, sunder_decomposition kind, rng *r, bool prove, uint32_t *best)
{
    const char *wrong = sunder_i_decomposition_check(&s->placed.lattice, s->shape, s->placed.p, &s->d);
    load_corners(s);
    if (!wrong && prove)
        for (uint32_t i = 0; i < s->d.pieces && !wrong; i++) wrong = prove_piece(s, i);
    if (!wrong && !areas_agree(s)) wrong = "areas";
    if (!wrong && !points_agree(s, r, 12)) wrong = "points";
    if (!wrong && !counts_hold(s, kind, best)) wrong = "counts";
    for (uint32_t i = 0; i < s->d.corners; i++) qpoint_clear(&s->corner[i]);
    free(s->corner);
    return wrong;
}

static void subject_load(subject *s)
{
    mpq_inits(s->a, s->b, s->c, s->side, s->e[0], s->e[1], s->e[2], s->e[3], NULL);
    sunder_i_lattice *l = &s->placed.lattice;
    s->vertex = test_alloc(s->shape->vertices, sizeof *s->vertex);
    for (uint32_t v = 0; v < s->shape->vertices; v++) {
        qpoint_init(&s->vertex[v]);
        const sunder_i_ratio x = sunder_i_lattice_read(&l->arena, l, s->placed.p[v].x);
        const sunder_i_ratio y = sunder_i_lattice_read(&l->arena, l, s->placed.p[v].y);
        set_ratio(s->vertex[v].x, x.num, x.den);
        set_ratio(s->vertex[v].y, y.num, y.den);
    }
}

static void subject_free(subject *s)
{
    mpq_clears(s->a, s->b, s->c, s->side, s->e[0], s->e[1], s->e[2], s->e[3], NULL);
    for (uint32_t v = 0; v < s->shape->vertices; v++) qpoint_clear(&s->vertex[v]);
    free(s->vertex);
    sunder_i_placed_free(&s->placed);
    sunder_shape_free(s->shape);
}

/* Decomposes P in all ways, and Q with it by the mixed method. Frees the shape. Returns NULL, or the failure. */
static char *try_shape(const polyset *raw, sunder_shape *shape, rng *r, bool wide, bool prove)
{
    subject s = {.raw = raw, .shape = shape};
    const sunder_i_place_options options = {.force_wide = wide, .reflect_q = true};
    assert_int_equal(sunder_i_place(shape, shape, &options, &s.placed, NULL), SUNDER_OK);
    subject_load(&s);
    uint32_t *best = test_alloc(shape->form->cleaned.polygons + 1, sizeof *best);
    memset(best, 0, (shape->form->cleaned.polygons + 1) * sizeof *best);
    char *message = NULL;
    static const int order[KINDS] = {4, 0, 1, 2, 3, 5}; /* the optimal method first: others are compared with it */
    for (int i = 0; i < KINDS && !message; i++) {
        const sunder_decomposition kind = kinds[order[i]];
        sunder_i_decomposition other;
        assert_int_equal(
            sunder_i_decompose_pair(&s.placed.lattice, shape, s.placed.p, shape, s.placed.q, kind, &s.d, &other, NULL),
            SUNDER_OK);
        const char *wrong = examine(&s, kind, r, prove, best);
        if (!wrong && s.d.used != kind && !s.d.fallbacks)
            wrong = "another decomposition was used, and no fallback is counted";
        if (!wrong) wrong = sunder_i_decomposition_check(&s.placed.lattice, shape, s.placed.q, &other);
        if (wrong) message = test_format("%s%s: %s", sunder_decomposition_string(kind), wide ? ", wide" : "", wrong);
        sunder_i_decomposition_clear(&s.d);
        sunder_i_decomposition_clear(&other);
    }
    free(best);
    subject_free(&s);
    return message;
}

static size_t report(char *message, const polyset *set, const char *name, uint64_t seed, size_t i)
{
    if (!message) return 0;
    char *wkt = polyset_wkt(set);
    print_message("%s, SUNDER_SEED=%llu, case %zu: %s\n%s\n", name, (unsigned long long)seed, i, message, wkt);
    free(wkt);
    free(message);
    return 1;
}

static void test_pairs(void **state)
{
    const uint64_t seed = test_seed();
    size_t bad = 0;
    print_message("SUNDER_SEED=%llu\n", (unsigned long long)seed);
    for (int kind = 0; kind < PAIR_KINDS; kind++)
        for (size_t i = 0; i < test_count(40) && bad < 5; i++) {
            rng r = rng_start(seed * 37 + (uint64_t)kind, i);
            polyset p, q;
            random_pair(&p, &q, &r, (pair_kind)kind);
            sunder_shape *shape = polyset_shape(&p);
            assert_non_null(shape);
            bad += report(try_shape(&p, shape, &r, i % 4 == 1, true), &p, pair_kind_string((pair_kind)kind), seed, i);
            polyset_free(&p);
            polyset_free(&q);
        }
    assert_int_equal(bad, 0);
}

static void test_families(void **state)
{
    const uint64_t seed = test_seed();
    size_t bad = 0;
    for (int kind = 0; kind < FAMILY_KINDS; kind++)
        for (size_t i = 0; i < test_count(6) && bad < 5; i++) {
            rng r = rng_start(seed * 41 + (uint64_t)kind, i);
            polyset set[2];
            random_family(&set[0], &set[1], &r, (family_kind)kind, 10, 60);
            for (int k = 0; k < 2; k++) {
                sunder_shape *shape = polyset_shape(&set[k]);
                assert_non_null(shape);
                bad += report(try_shape(&set[k], shape, &r, i % 3 == 1, true), &set[k],
                              family_kind_string((family_kind)kind), seed, i);
                polyset_free(&set[k]);
            }
        }
    assert_int_equal(bad, 0);
}

/* Random rings that cross themselves, by the even-odd rule, which gives rational vertices. */
static void test_repaired(void **state)
{
    const uint64_t seed = test_seed();
    size_t bad = 0;
    for (size_t i = 0; i < test_count(60) && bad < 5; i++) {
        rng r = rng_start(seed * 43, i);
        polyset set;
        polyset_init(&set);
        const int n = (int)rng_int(&r, 4, 9), rings = (int)rng_int(&r, 1, 2);
        for (int k = 0; k < rings; k++) {
            for (int v = 0; v < n; v++) polyset_vertex(&set, (double)rng_int(&r, 0, 9), (double)rng_int(&r, 0, 9));
            polyset_end_ring(&set);
        }
        polyset_end_polygon(&set);
        sunder_shape *shape = NULL;
        assert_int_equal(sunder_shape_from_rings(set.xy, set.ring_end, set.poly_end, set.polygons,
                                                 SUNDER_VALIDITY_EVEN_ODD, &shape, NULL),
                         SUNDER_OK);
        if (sunder_shape_is_empty(shape))
            sunder_shape_free(shape);
        else
            bad += report(try_shape(&set, shape, &r, false, true), &set, "repaired", seed, i);
        polyset_free(&set);
    }
    assert_int_equal(bad, 0);
}

/* The families of the literature, if they are beside the repository. */
static void test_shared(void **state)
{
    static const char *const names[] = {"comb_10",    "comb_20",   "comb_50",     "fork_20",    "fork_50",
                                        "forkt_20",   "cfork_20",  "cfork_50",    "star_20",    "star_50",
                                        "random_10",  "random_20", "random_50",   "randmap_50", "robot_50",
                                        "fatgrid_50", "tight_20",  "coast32_100", "bldg32_100"};
    size_t bad = 0, found = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char *path = test_format("%s/../shared/families/%s.txt", SUNDER_SOURCE, names[i]);
        char *text = test_read_file(path);
        free(path);
        if (!text) continue;
        found++;
        const char *at = text;
        for (int k = 0; k < 2; k++) {
            polyset set;
            polyset_init(&set);
            assert_true(polyset_read_wkt(&set, at, &at));
            sunder_shape *shape = polyset_shape(&set);
            assert_non_null(shape);
            rng r = rng_start(1, i);
            bad += report(try_shape(&set, shape, &r, false, true), &set, names[i], 1, i);
            polyset_free(&set);
        }
        free(text);
    }
    if (!found) {
        print_message("../shared/families is not there: skipped\n");
        skip();
    }
    assert_int_equal(bad, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pairs),
        cmocka_unit_test(test_families),
        cmocka_unit_test(test_repaired),
        cmocka_unit_test(test_shared),
    };
    return cmocka_run_group_tests_name("convex decompositions", tests, NULL, NULL);
}
