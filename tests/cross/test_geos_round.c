/* Compares disc:R:N and inside-disc:R:N with the true round buffer, feature by feature, by areas and without a
 * tolerance.
 *
 * Let A(r) be the area of the true buffer of a polygon by r, D and I ours by the N-gon around and inside the disc, and
 * G(r) that of GEOS's buffer with q segments a quadrant. GEOS replaces each arc by chords of 90/q degrees: its polygon
 * is inside the true buffer, and the middle of a chord has the distance r cos(45/q) from the centre: so
 *
 *     G(r)  <=  A(r)  <=  G(r / c),  c = cos(45 degrees / q).
 *
 * The N-gon around the disc is within the disc of radius R / cos(180 degrees / N), up to the rounding of its corners,
 * below a millionth of R. The one inside contains the disc of radius R cos(180 degrees / N), up to the same rounding.
 * So
 *
 *     G(R (1 - m) k)  <=  A(R (1 - m) k)  <=  I  <=  A(R)  <=  G(R / c)           k = cos(180 degrees / N), m = 1e-6
 *     G(R)  <=  A(R)  <=  D  <=  A(R (1 + m) / k)  <=  G(R (1 + m) / (k c)),
 *
 * and the test compares the two outer terms of each line with I or D. For growing N they converge to A(R) from both
 * sides. */
#include "layers.h"

static const int quadrant = 64;
static const double pi = 3.14159265358979323846, slack = 1e-6;

static void put_ring(polyset *set, const GEOSGeometry *ring)
{
    const GEOSCoordSequence *s = GEOSGeom_getCoordSeq_r(geos, ring);
    unsigned n = 0;
    GEOSCoordSeq_getSize_r(geos, s, &n);
    for (unsigned i = 0; i + 1 < n; i++) {
        double x, y;
        GEOSCoordSeq_getXY_r(geos, s, i, &x, &y);
        polyset_vertex(set, x, y);
    }
    polyset_end_ring(set);
}

static sunder_shape *shape_of(const GEOSGeometry *feature)
{
    polyset set;
    polyset_init(&set);
    for (int i = 0; i < GEOSGetNumGeometries_r(geos, feature); i++) {
        const GEOSGeometry *p = GEOSGetGeometryN_r(geos, feature, i);
        put_ring(&set, GEOSGetExteriorRing_r(geos, p));
        for (int h = 0; h < GEOSGetNumInteriorRings_r(geos, p); h++) put_ring(&set, GEOSGetInteriorRingN_r(geos, p, h));
        polyset_end_polygon(&set);
    }
    sunder_shape *shape = polyset_shape(&set);
    polyset_free(&set);
    return shape;
}

/* Computed from the exact vertices, rounded to doubles, relative to the first vertex: the error is about 1e-15 of the
 * area, plus that of rounding the vertices. */
static double our_area(const sunder_shape *feature, double radius, unsigned segments, bool inside)
{
    sunder_shape *disc = NULL;
    sunder_sum *sum = NULL;
    sunder_sum_size size;
    long double twice = 0;
    assert_int_equal(sunder_shape_disc(radius, segments, inside, &disc, NULL), SUNDER_OK);
    assert_int_equal(sunder_morphology(feature, disc, SUNDER_OPERATION_DILATE, NULL, &sum, NULL), SUNDER_OK);
    sunder_sum_get_size(sum, &size);
    double *xy = test_alloc(2 * size.vertices, sizeof *xy), off = 0;
    for (size_t p = 0; p < size.polygons; p++)
        for (size_t r = 0; r < sunder_sum_rings(sum, p); r++) {
            size_t n;
            const uint32_t *vertex = sunder_sum_ring(sum, p, r, &n);
            assert_int_equal(sunder_sum_vertices(sum, vertex, n, xy, &off, NULL), SUNDER_OK);
            for (size_t i = 1; i + 1 < n; i++)
                twice += ((long double)xy[2 * i] - xy[0]) * ((long double)xy[2 * i + 3] - xy[1]) -
                         ((long double)xy[2 * i + 1] - xy[1]) * ((long double)xy[2 * i + 2] - xy[0]);
        }
    free(xy);
    sunder_sum_free(sum);
    sunder_shape_free(disc);
    return (double)(twice / 2);
}

static double geos_area(const GEOSGeometry *feature, double radius)
{
    double area = NAN;
    GEOSGeometry *g = GEOSBuffer_r(geos, feature, radius, quadrant);
    if (g) GEOSArea_r(geos, g, &area);
    GEOSGeom_destroy_r(geos, g);
    return area;
}

typedef struct tally {
    size_t features, bad;
    double inside, around, below, above; /* sums, to be printed */
} tally;

static void bracket(const GEOSGeometry *feature, double radius, unsigned segments, tally *t)
{
    const double c = cos(pi / 4 / quadrant), k = cos(pi / segments);
    sunder_shape *shape = shape_of(feature);
    assert_non_null(shape);
    const double inside = our_area(shape, radius, segments, true), around = our_area(shape, radius, segments, false);
    const double low = geos_area(feature, radius * (1 - slack) * k),
                 high = geos_area(feature, radius * (1 + slack) / (k * c));
    const double below = geos_area(feature, radius), above = geos_area(feature, radius / c);
    sunder_shape_free(shape);
    t->features++;
    t->inside += inside;
    t->around += around;
    t->below += below;
    t->above += above;
    if (low <= inside && inside <= above && below <= around && around <= high) return;
    t->bad++;
    print_message(
        "by %g, %u segments: GEOS %.12g <= inside %.12g <= GEOS %.12g; GEOS %.12g <= around %.12g <= GEOS %.12g\n",
        radius, segments, low, inside, above, below, around, high);
}

static layers_answer bracket_layer(const char *file, const char *condition, double radius)
{
    char *path = layers_path(file);
    geometries features = {0};
    const bool there = path && layers_read(path, "buildings", condition, &features);
    layers_answer answer = !path ? LAYERS_MISSING : there ? LAYERS_RIGHT : LAYERS_UNREADABLE;
    static const unsigned segments[] = {8, 32, 128};
    for (size_t k = 0; there && k < sizeof segments / sizeof *segments; k++) {
        tally t = {0};
        for (size_t i = 0; i < features.n; i++) bracket(features.at[i], radius, segments[k], &t);
        print_message("%s by %g, %zu features, %u segments: %.8g inside, %.8g to %.8g the true one, %.8g around\n",
                      file, radius, t.features, segments[k], t.inside, t.below, t.above, t.around);
        if (t.bad) answer = LAYERS_WRONG;
    }
    geometries_free(&features);
    free(path);
    return answer;
}

static void test_brackets(void **state)
{
    (void)state;
    layers_tally t = {0};
    layers_count(&t, bracket_layer("krems_2013.gpkg", "ST_IsValid(geom)", 5));
    layers_count(&t, bracket_layer("krems_2013.gpkg", "ST_IsValid(geom)", 0.75));
    layers_count(&t, bracket_layer("paris_cite_2014.gpkg", "ST_IsValid(geom) AND NumInteriorRings(geom) > 0", 3));
    layers_conclude(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_brackets)};
    return cmocka_run_group_tests_name("round buffers between ours", tests, layers_open, layers_close);
}
