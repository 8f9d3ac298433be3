/* displacement/prove/optimum: forbidden sets of few and of many pieces, their coverage and their free places, compared
 * with a loop over all pieces. Pieces are dilated rectangles, so the oracle only needs distances. */
#include "random.h"

#include "displacement/prove/optimum/region.h"
#include "displacement/prove/optimum/tuning.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 400 };

typedef struct set {
    sunder_i_forbidden forbidden;
    sunder_i_forbidden_piece piece[MOST];
    sunder_i_obstacle_edge edge[4 * MOST];
    double box[MOST][4], radius[MOST]; /* the pieces as the oracle uses them: rectangle and radius */
    size_t n;
} set;

static void add(set *s, const double box[4], double radius)
{
    sunder_i_forbidden *f = &s->forbidden;
    const double corner[8] = {box[0], box[1], box[2], box[1], box[2], box[3], box[0], box[3]};
    sunder_i_forbidden_piece *p = &s->piece[f->pieces++];
    *p = (sunder_i_forbidden_piece){.edge = (uint32_t)f->edges, .radius = radius};
    p->edges = (uint32_t)sunder_i_obstacle_edges(corner, 4, s->edge + f->edges);
    f->edges += p->edges;
    sunder_i_box_grow(box, radius, p->box);
    for (int c = 0; c < 2; c++) p->middle[c] = (box[c] + box[c + 2]) / 2;
    p->within = (fmin(box[2] - box[0], box[3] - box[1]) / 2 + radius) * (1 - WITHIN_HAIR);
    memcpy(s->box[s->n], box, sizeof s->box[0]);
    s->radius[s->n++] = radius;
    for (int c = 0; c < 4; c++) f->size = fmax(f->size, fabs(p->box[c]));
    f->grain = 0x1p-46 * f->size;
}

/* Makes n rectangles around the centre, enough to overlap; some are not dilated. */
static void make(rng *r, size_t n, set *s)
{
    memset(s, 0, sizeof *s);
    s->forbidden = (sunder_i_forbidden){.piece = s->piece, .edge = s->edge, .size = 128};
    for (size_t k = 0; k < n; k++) {
        double box[4];
        for (int c = 0; c < 2; c++) {
            box[c] = (double)rng_int(r, -200, 160) / 4;
            box[c + 2] = box[c] + (double)rng_int(r, 1, 60) / 4;
        }
        add(s, box, rng_once_in(r, 4) ? 0 : 1.5);
    }
}

/* The depth of a place in the deepest piece that contains it, by the oracle; 0 outside. */
static double depth_of(const set *s, double x, double y)
{
    double depth = 0;
    for (size_t k = 0; k < s->n; k++) {
        const double *b = s->box[k];
        const double dx = fmax(b[0] - x, x - b[2]), dy = fmax(b[1] - y, y - b[3]);
        const double distance = dx > 0 && dy > 0 ? hypot(dx, dy) : fmax(dx, dy);
        depth = fmax(depth, s->radius[k] - distance);
    }
    return depth;
}

/* Tolerance of the oracle: coordinates are below 2^7, and no test needs finer results. */
static const double hair = 0x1p-26;

static void check_places(rng *r, const set *s)
{
    for (int k = 0; k < 60; k++) {
        const double u[2] = {(double)rng_int(r, -240, 240) / 4, (double)rng_int(r, -240, 240) / 4};
        const double angle = (double)rng_int(r, 0, 62) / 10 + 0.05, dir[2] = {cos(angle), sin(angle)};
        const double depth = sunder_i_forbidden_depth(&s->forbidden, u), oracle = depth_of(s, u[0], u[1]);
        assert_true(fabs(depth - oracle) <= hair);
        for (size_t g = 0; g <= s->forbidden.pieces; g++) { /* for any first guess of the piece, also beyond the last */
            const double asked[] = {0x1p-40 * s->forbidden.size, depth * 0.75, depth, depth + 1};
            size_t guess = g;
            for (int e = 0; e < 4; e++)
                assert_true(!(asked[e] > 0) ||
                            sunder_i_forbidden_is_deeper(&s->forbidden, u, asked[e], &guess) == (depth > asked[e]));
        }
        const double way = sunder_i_forbidden_exit(&s->forbidden, u, dir, INFINITY);
        assert_true(depth_of(s, u[0] + way * dir[0], u[1] + way * dir[1]) <= hair);
        const double half = sunder_i_forbidden_exit(&s->forbidden, u, dir, way / 2);
        assert_true(way == 0 || (half >= way / 2 && half <= way));
        /* A search that is limited to a distance returns at least that distance, or the point where the set ends. */
        for (int e = 1; e < 16; e++) {
            const double most = way * e / 12, some = sunder_i_forbidden_exit(&s->forbidden, u, dir, most);
            assert_true(most > way ? some == way : some >= most && some <= way);
        }
        for (int e = 1; e < 8 && way > 1; e++) {
            /* All places up to the exit are forbidden, except on the common border of pieces that touch. */
            const double on = way * e / 8, off = on + 0x1p-10;
            assert_true(depth_of(s, u[0] + on * dir[0], u[1] + on * dir[1]) > 0 ||
                        depth_of(s, u[0] + off * dir[0], u[1] + off * dir[1]) > 0);
        }
        if (oracle > 0) continue;
        uint64_t steps = 0;
        const double entry = sunder_i_forbidden_entry(&s->forbidden, u, dir, 100, &steps);
        assert_true(entry >= 0 && entry <= 100 && steps > 0);
        for (int e = 0; e < 8; e++)
            assert_true(depth_of(s, u[0] + entry * e / 8 * dir[0], u[1] + entry * e / 8 * dir[1]) <= hair);
        const double past = entry + 0x1p-20;
        if (entry < 100) assert_true(depth_of(s, u[0] + past * dir[0], u[1] + past * dir[1]) >= -hair);
    }
}

/* A place that is reported as covered is covered; if a region is not covered because of an opening, the reported place
 * lies in the opening. */
static size_t check_cover(rng *r, const set *s, sunder_i_reflex *reflex)
{
    size_t covered = 0;
    for (int k = 0; k < 40; k++) {
        const double centre[2] = {(double)rng_int(r, -160, 160) / 4, (double)rng_int(r, -160, 160) / 4};
        sunder_i_region region;
        double gap[2];
        uint64_t steps = 0;
        sunder_i_region_init(&region, centre, (double)rng_int(r, 1, 80) / 8);
        const double turn[2] = {0.6, 0.8};
        sunder_i_region_clip(&region, turn, 0.6 * centre[0] + 0.8 * centre[1] - 0.5, 0, s->forbidden.grain);
        if (sunder_i_region_is_covered(&region, &s->forbidden, NULL, gap, &steps)) {
            covered++;
            assert_true(isnan(gap[0]));
            for (uint32_t c = 0; c < region.n; c++) {
                const double *p = region.xy + 2 * (size_t)c, *q = region.xy + 2 * (size_t)((c + 1) % region.n);
                assert_true(depth_of(s, p[0], p[1]) > 0);
                assert_true(depth_of(s, (p[0] + q[0]) / 2, (p[1] + q[1]) / 2) > 0);
            }
        } else if (isfinite(gap[0]) && depth_of(s, gap[0], gap[1]) == 0) {
            const double down[2] = {1, 0};
            const size_t known = reflex->n;
            double least = gap[0];
            assert_true(sunder_i_reflex_seek(reflex, &s->forbidden, &region, gap, down, &steps));
            for (size_t m = known; m < reflex->n; m++) {
                const double *p = reflex->place[m];
                assert_true(depth_of(s, p[0], p[1]) <= 64 * WALL_HAIR * s->forbidden.size);
                least = fmax(least, p[0]);
            }
            assert_true(reflex->n > known && least >= gap[0]);
        }
    }
    return covered;
}

/* The sides of the region computed from `known` equal those computed from scratch, in coordinates and in steps. */
static void check_known(const set *s, const sunder_i_free_sides *known, const sunder_i_region *region)
{
    sunder_i_free_sides fresh = {0}, told = {0};
    uint64_t steps = 0, told_steps = 0;
    assert_true(sunder_i_free_sides_find(&fresh, &fresh, region, &s->forbidden, &steps));
    assert_true(sunder_i_free_sides_find(&told, known, region, &s->forbidden, &told_steps));
    assert_int_equal(told.n, fresh.n);
    assert_true(told_steps == steps);
    if (told.n) assert_memory_equal(told.place, fresh.place, told.n * sizeof *told.place);
    assert_memory_equal(told.first, fresh.first, (region->n + 1) * sizeof *told.first);
    sunder_i_free(fresh.place);
    sunder_i_free(told.place);
}

/* Cached sides of a region equal those that are computed from scratch. Getting them again costs no steps, and all
 * memory is freed. For a region that was cut, the remaining sides are returned. */
static void check_sides(rng *r, const set *s)
{
    sunder_i_free_sides kept = {0};
    for (int k = 0; k < 20; k++) {
        const double centre[2] = {(double)rng_int(r, -160, 160) / 4, (double)rng_int(r, -160, 160) / 4};
        sunder_i_region region;
        uint64_t steps = 0;
        sunder_i_region_init(&region, centre, (double)rng_int(r, 1, 80) / 4);
        check_known(s, &kept, &region);
        assert_true(sunder_i_free_sides_find(&kept, &kept, &region, &s->forbidden, &steps) && steps > 0);
        steps = 0;
        assert_true(sunder_i_free_sides_find(&kept, &kept, &region, &s->forbidden, &steps) && steps == 0);
        check_known(s, &kept, &region);
        for (size_t m = 0; m < kept.n; m++) assert_true(depth_of(s, kept.place[m][0], kept.place[m][1]) <= hair);
        for (int cut = 0; cut < 4; cut++) {
            const double angle = (double)rng_int(r, 0, 62) / 10, n[2] = {cos(angle), sin(angle)};
            const double d = n[0] * centre[0] + n[1] * centre[1] - (double)rng_int(r, 0, 80) / 8;
            sunder_i_region_clip(&region, n, d, 0, s->forbidden.grain);
            check_known(s, &kept, &region);
            if (cut % 2) assert_true(sunder_i_free_sides_find(&kept, &kept, &region, &s->forbidden, &steps));
        }
    }
    sunder_i_free(kept.place);
}

static void check(size_t n, size_t i)
{
    static set s;
    rng r = rng_start(test_seed(), i);
    sunder_i_reflex reflex = {0};
    make(&r, n, &s);
    /* The index is sorted in the set's own memory. */
    assert_true(sunder_i_forbidden_index(&s.forbidden));
    assert_true(sunder_i_forbidden_is_many(&s.forbidden) == (n > MANY_PIECES));
    check_places(&r, &s);
    const size_t covered = check_cover(&r, &s, &reflex);
    check_sides(&r, &s);
    if (n == MOST) assert_true(covered > 0);
    sunder_i_free(reflex.place);
    sunder_i_free(s.forbidden.tree.box);
}

static void test_few_and_many(void **state)
{
    static const size_t sizes[] = {1, 7, 30, MANY_PIECES, MANY_PIECES + 1, 200, MOST};
    (void)state;
    for (size_t i = 0; i < test_count(12); i++)
        for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) check(sizes[k], 16 * i + k);
}

/* A wall with a notch: the way down leads to the bottom of the notch, wherever it begins. */
static void test_down_into_a_notch(void **state)
{
    (void)state;
    static set s;
    sunder_i_reflex reflex = {0};
    memset(&s, 0, sizeof s);
    s.forbidden = (sunder_i_forbidden){.piece = s.piece, .edge = s.edge};
    for (int k = 0; k < 110; k++) {
        /* A sawtooth shape: all of x < 0 except a notch with its bottom at (-8, 0) between slopes made of steps. */
        const double y = k < 55 ? -8 - k / 8.0 : 8 + (k - 55) / 8.0;
        add(&s, (double[4]){-40, y - 1, 0, y + 1}, 0);
    }
    add(&s, (double[4]){-40, -9, -8, 9}, 0);
    assert_true(sunder_i_forbidden_index(&s.forbidden));
    assert_true(sunder_i_forbidden_is_many(&s.forbidden));
    const double home[2] = {0, 0}, from[2] = {4, 3}, down[2] = {-0.8, 0.6};
    sunder_i_region region;
    uint64_t steps = 0;
    sunder_i_region_init(&region, home, 12);
    assert_true(sunder_i_reflex_seek(&reflex, &s.forbidden, &region, from, down, &steps));
    double least = INFINITY, place[2] = {0, 0};
    for (size_t k = 0; k < reflex.n; k++) {
        const double d = -(down[0] * reflex.place[k][0] + down[1] * reflex.place[k][1]);
        if (d >= least) continue;
        least = d;
        memcpy(place, reflex.place[k], sizeof place);
    }
    assert_true(fabs(place[0] + 8) <= 0x1p-20 && fabs(place[1] - 7) <= 0x1p-20);
    sunder_i_free(reflex.place);
    sunder_i_free(s.forbidden.tree.box);
}

/* A region across some pieces of a small set, which overlap only a little: proving that they cover it takes long, and
 * succeeds. Without one of them there is a hole, and it is found. */
static void test_across_narrow_overlaps(void **state)
{
    (void)state;
    static set s;
    const int strips = 8;
    const double home[2] = {0, 0};
    for (int gone = -1; gone < strips; gone += strips / 2) {
        memset(&s, 0, sizeof s);
        s.forbidden = (sunder_i_forbidden){.piece = s.piece, .edge = s.edge};
        for (int k = 0; k < strips; k++)
            if (k != gone) add(&s, (double[4]){k - strips / 2 - 0x1p-4, -40, k - strips / 2 + 1, 40}, 0);
        assert_true(sunder_i_forbidden_index(&s.forbidden) && !sunder_i_forbidden_is_many(&s.forbidden));
        sunder_i_region region;
        double gap[2];
        uint64_t steps = 0;
        sunder_i_region_init(&region, home, strips / 2 - 0.25);
        assert_true(sunder_i_region_is_covered(&region, &s.forbidden, NULL, gap, &steps) == (gone < 0));
        if (gone >= 0) assert_true(depth_of(&s, gap[0], gap[1]) == 0);
    }
}

/* Two pieces that overlap only in a strip, ever narrower, and a region across it none of whose sides is parallel to
 * it. */
static void test_cover_by_a_strip(void **state)
{
    (void)state;
    static set s;
    const double home[2] = {0, 0}, turn[2] = {0.6, 0.8}, back[2] = {-0.6, -0.8};
    for (int bits = 2; bits <= 24; bits++)
        for (int grown = 0; grown < 2; grown++) {
            const double half = ldexp(1, -bits), radius = grown ? 1.5 : 0;
            memset(&s, 0, sizeof s);
            s.forbidden = (sunder_i_forbidden){.piece = s.piece, .edge = s.edge};
            add(&s, (double[4]){-40, -40, half - radius, 40}, radius);
            add(&s, (double[4]){-half, -40, 40, 40}, 0);
            assert_true(sunder_i_forbidden_index(&s.forbidden));
            sunder_i_region region;
            double gap[2];
            uint64_t steps = 0;
            sunder_i_region_init(&region, home, 20);
            sunder_i_region_clip(&region, turn, -9, 0, s.forbidden.grain);
            sunder_i_region_clip(&region, back, -7, 0, s.forbidden.grain);
            assert_true(sunder_i_region_is_covered(&region, &s.forbidden, NULL, gap, &steps));
            sunder_i_free(s.forbidden.tree.box);
        }
}

/* Round pieces at random, and a region each place of which is deep in one of them: that is proved, although the
 * boundary of a piece with arcs is followed by many lines. */
static void test_cover_by_round_pieces(void **state)
{
    (void)state;
    enum { SETS = 400, GRID = 24 };
    size_t deep = 0;
    for (size_t i = 0; i < SETS; i++) {
        static set s;
        rng r = rng_start(test_seed(), 3000 + i);
        memset(&s, 0, sizeof s);
        s.forbidden = (sunder_i_forbidden){.piece = s.piece, .edge = s.edge};
        for (int k = 0; k < 60; k++) {
            const double x = (double)rng_int(&r, -160, 128) / 16, y = (double)rng_int(&r, -160, 128) / 16;
            add(&s, (double[4]){x, y, x + (double)rng_int(&r, 1, 32) / 16, y + (double)rng_int(&r, 1, 32) / 16}, 2.5);
        }
        assert_true(sunder_i_forbidden_index(&s.forbidden));
        const double home[2] = {0, 0}, half = (double)rng_int(&r, 4, 10), step = 2 * half / GRID;
        double least = INFINITY, gap[2];
        for (int k = 0; k < (GRID + 1) * (GRID + 1); k++)
            least = fmin(least, depth_of(&s, step * (k % (GRID + 1)) - half, step * (k / (GRID + 1)) - half));
        uint64_t steps = 0;
        sunder_i_region region;
        sunder_i_region_init(&region, home, half);
        if (least > step) {
            deep++;
            assert_true(sunder_i_region_is_covered(&region, &s.forbidden, NULL, gap, &steps));
        }
        sunder_i_free(s.forbidden.tree.box);
    }
    assert_in_range(deep, SETS / 8, SETS);
}

/* Pieces that are added after the tree was built are found, too. */
static void test_behind_the_tree(void **state)
{
    (void)state;
    for (size_t i = 0; i < test_count(12); i++) {
        static set s;
        rng r = rng_start(test_seed(), 1000 + i);
        make(&r, MOST / 2, &s);
        assert_true(sunder_i_forbidden_index(&s.forbidden) && sunder_i_forbidden_is_many(&s.forbidden));
        for (int k = 0; k < 20; k++) {
            const double x = (double)rng_int(&r, -200, 160) / 4, y = (double)rng_int(&r, -200, 160) / 4;
            add(&s, (double[4]){x, y, x + 12, y + 9}, 0);
        }
        check_places(&r, &s);
        sunder_i_free(s.forbidden.tree.box);
    }
}

/* Is the place in the convex region, or within its tolerance of it? */
static bool is_in(const sunder_i_region *region, const double u[2])
{
    for (uint32_t k = 0; k < region->n; k++) {
        const double *p = region->xy + 2 * (size_t)k, *q = region->xy + 2 * (size_t)((k + 1) % region->n);
        const double x = q[0] - p[0], y = q[1] - p[1], side = x * (u[1] - p[1]) - y * (u[0] - p[0]);
        if (side < -(region->blur + hair) * hypot(x, y)) return false;
    }
    return region->n > 0;
}

/* Places outside the remaining region are forbidden, and nothing remains of a covered region. */
static void test_cover_what_can_be(void **state)
{
    (void)state;
    size_t places = 0, lefts = 0;
    for (size_t i = 0; i < test_count(40); i++) {
        static set s;
        rng r = rng_start(test_seed(), 2000 + i);
        sunder_i_regions left = {0};
        uint64_t steps = 0;
        make(&r, i % 2 ? MOST : 60, &s);
        assert_true(sunder_i_forbidden_index(&s.forbidden));
        const double centre[2] = {(double)rng_int(&r, -80, 80) / 4, (double)rng_int(&r, -80, 80) / 4}, reach = 9;
        sunder_i_region region;
        sunder_i_region_init(&region, centre, reach);
        assert_true(sunder_i_region_cover(&region, &s.forbidden, &left, &steps));
        if (sunder_i_region_is_covered(&region, &s.forbidden, NULL, NULL, &steps)) assert_true(left.n == 0);
        for (int k = 0; k < 400; k++) {
            const double u[2] = {centre[0] + reach * (double)rng_int(&r, -999, 999) / 1000,
                                 centre[1] + reach * (double)rng_int(&r, -999, 999) / 1000};
            bool is_left = false;
            for (size_t m = 0; m < left.n && !is_left; m++) is_left = is_in(&left.item[m], u);
            if (!is_left) assert_true(depth_of(&s, u[0], u[1]) > 0);
            places += !is_left;
        }
        lefts += left.n;
        sunder_i_free(left.item);
        sunder_i_free(s.forbidden.tree.box);
    }
    assert_true(places > 1000 && lefts > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_few_and_many),           cmocka_unit_test(test_down_into_a_notch),
        cmocka_unit_test(test_across_narrow_overlaps), cmocka_unit_test(test_cover_by_a_strip),
        cmocka_unit_test(test_cover_by_round_pieces),
        cmocka_unit_test(test_behind_the_tree),        cmocka_unit_test(test_cover_what_can_be)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
