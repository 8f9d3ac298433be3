/* standard.c: standard shapes: discs and rectangles about the origin.
 *
 * A disc's polygon is made from doubles near the ideal ones and then verified exactly, which needs no rational
 * directions: by integer arithmetic, the vertices of an inside disc must be in the disc, and the lines of all edges of
 * an outside one at least the radius away from the origin. If an outside disc fails it is enlarged by a growing number
 * of ulps; of an inside one each vertex that fails is moved inwards by itself, so that vertices on the axes are exactly
 * at the radius: a space exactly as wide as the disc admits the polygon, and no larger one. Vertices of discs with few
 * segments are multiples of a coarse unit, about 2^-26 of the radius: sums with map coordinates then fit the narrow
 * lattice, which is several times as fast, and the additional deviation is about 10^-8 of the radius. Vertices are
 * mirrored from as few computed ones as the number of segments allows, so that the polygon is exactly symmetric. */
#include "shape/shape.h"

#include "predicate/predicate.h"

#include <float.h>
#include <math.h>

#define PI 3.14159265358979323846

static sunder_status from_ring(const double *xy, size_t n, sunder_shape **out, sunder_error *err)
{
    const size_t ring_end[1] = {n}, poly_end[1] = {1};
    return sunder_shape_from_rings(xy, ring_end, poly_end, 1, SUNDER_VALIDITY_STRICT, out, err);
}

/* Computes vertex i of n on the unit circle, the first one on the x axis. The angle i / n of a turn is reduced to the
 * first octant in integers, so that mirror images have the same digits. */
static void unit_corner(unsigned i, unsigned n, double xy[2])
{
    const uint64_t turns = 8 * (uint64_t)i; /* in units of 1 / (8 n) of a turn; an octant has n of them */
    const unsigned octant = (unsigned)(turns / n);
    uint64_t rest = turns % n;
    if (octant & 1) rest = n - rest;
    const double angle = PI / 4 * (double)rest / (double)n;
    const double c = cos(angle), s = rest == n ? c : sin(angle);
    /* in the octants 0, 3, 4 and 7 the x coordinate is the larger one */
    const bool along_x = octant == 0 || octant == 3 || octant == 4 || octant == 7;
    xy[0] = along_x ? c : s;
    xy[1] = along_x ? s : c;
    if (octant >= 2 && octant < 6) xy[0] = -xy[0];
    if (octant >= 4) xy[1] = -xy[1];
}

typedef struct disc {
    double radius;
    unsigned n;
    bool inside;
    double *xy;
    bool *proved; /* [n] inside: the vertices that are verified and kept */
} disc;

/* With more segments than this the polygon is so close to the circle that the coarse unit would matter. */
static const unsigned coarse_segments = 256;
static const double coarse_give = 0x1p24; /* in ulps: fewer would not compensate for the rounding */

/* Returns the unit of which vertices are multiples; 0: any double, also near the ends of the range of doubles. */
static double unit_of(const disc *d)
{
    if (d->n > coarse_segments || d->radius < 0x1p-900 || d->radius > 0x1p900) return 0;
    int exponent;
    frexp(d->radius, &exponent);
    return ldexp(1, exponent - 26);
}

/* Computes vertex i at the distance radius * factor. */
static void make_corner(const disc *d, unsigned i, double factor, double unit, double p[2])
{
    unit_corner(i, d->n, p);
    const bool on_circle = d->inside && (p[0] == 0 || p[1] == 0);
    for (int k = 0; k < 2; k++) {
        p[k] = (on_circle ? d->radius : d->radius * factor) * p[k] + 0.0;
        /* round() is odd, so that mirror images remain so */
        if (unit > 0 && !on_circle) p[k] = round(p[k] / unit) * unit + 0.0;
    }
}

/* Computes the vertices that are not verified. Returns false if one exceeds the range of doubles. */
static bool make_corners(const disc *d, double factor)
{
    const double unit = unit_of(d);
    for (unsigned i = 0; i < d->n; i++) {
        double *p = d->xy + 2 * (size_t)i;
        if (d->proved[i]) continue;
        make_corner(d, i, factor, unit, p);
        if (!isfinite(p[0]) || !isfinite(p[1])) return false;
    }
    return true;
}

/* A vertex as integers. */
typedef struct lattice_corner {
    sunder_i_big x, y;
} lattice_corner;

static lattice_corner corner_at(const disc *d, sunder_i_lattice *l, unsigned i)
{
    const double *p = d->xy + 2 * (size_t)i;
    return (lattice_corner){sunder_i_lattice_get(l, sunder_i_lattice_int(l, p[0], 0)),
                            sunder_i_lattice_get(l, sunder_i_lattice_int(l, p[1], 0))};
}

/* Returns whether the edge pq of an outside disc keeps the radius: cross(p, q)^2 >= r^2 |q - p|^2 and cross > 0; rr is
 * r^2. */
static bool is_edge_outside(sunder_i_arena *a, lattice_corner p, lattice_corner q, sunder_i_big rr)
{
    const sunder_i_big cross = sunder_i_big_sub(a, sunder_i_big_mul(a, p.x, q.y), sunder_i_big_mul(a, p.y, q.x));
    const sunder_i_big dx = sunder_i_big_sub(a, q.x, p.x), dy = sunder_i_big_sub(a, q.y, p.y);
    const sunder_i_big length = sunder_i_big_norm(a, dx, dy);
    return sunder_i_big_sign(cross) > 0 &&
           sunder_i_big_cmp(sunder_i_big_mul(a, cross, cross), sunder_i_big_mul(a, rr, length)) >= 0;
}

/* Verifies the polygon. Inside: |a|^2 <= r^2 for each vertex, which is then marked; outside: all edges. */
static bool is_proved(const disc *d, sunder_i_arena *arena)
{
    sunder_i_extent extent = {0};
    sunder_i_extent_add(&extent, d->xy, d->n);
    const double radius[2] = {d->radius, d->radius};
    sunder_i_extent_add(&extent, radius, 1);
    double origin[1][2];
    sunder_i_lattice l;
    sunder_i_lattice_init(&l, &extent, 1, false, origin, true);
    const sunder_i_big r = sunder_i_lattice_get(&l, sunder_i_lattice_int(&l, d->radius, 0));
    const sunder_i_big rr = sunder_i_big_mul(arena, r, r);
    bool good = true;
    for (unsigned i = 0; i < d->n && (good || d->inside); i++) {
        if (d->proved[i]) continue;
        const sunder_i_mark mark = sunder_i_arena_mark(arena);
        const lattice_corner p = corner_at(d, &l, i);
        if (d->inside) {
            d->proved[i] = sunder_i_big_cmp(sunder_i_big_norm(arena, p.x, p.y), rr) <= 0;
            good &= d->proved[i];
        } else
            good = is_edge_outside(arena, p, corner_at(d, &l, (i + 1) % d->n), rr);
        sunder_i_arena_release(arena, mark);
    }
    if (l.arena.failed) arena->failed = true;
    sunder_i_lattice_free(&l);
    return good;
}

/* Computes vertices until they are verified: each attempt allows twice as many ulps as the previous one. */
static sunder_status prove_corners(const disc *d, sunder_i_arena *arena, sunder_error *err)
{
    const double ideal = d->inside ? 1 : 1 / cos(PI / d->n);
    const double first = unit_of(d) > 0 ? coarse_give : 1;
    for (double ulps = 0; ulps<0x1p40; ulps = ulps> 0 ? 2 * ulps : first) {
        const double give = ulps * DBL_EPSILON;
        if (!make_corners(d, d->inside ? ideal * (1 - give) : ideal * (1 + give)))
            return sunder_i_fail(err, SUNDER_ERANGE, "a disc of radius %.17g leaves the range of doubles", d->radius);
        const bool good = is_proved(d, arena);
        if (arena->failed) return sunder_i_failure_cause(err);
        if (good) return SUNDER_OK;
    }
    /* only if doubles are too coarse, at the lower end of their range */
    return sunder_i_fail(err, SUNDER_ERANGE, "a disc of radius %.17g with %u segments is too small for doubles",
                         d->radius, d->n);
}

sunder_status sunder_shape_disc(double radius, unsigned segments, bool inside, sunder_shape **out, sunder_error *err)
{
    if (!(radius > 0) || !isfinite(radius))
        return sunder_i_fail(err, SUNDER_EARG, "the radius of a disc must be positive and finite, not %.17g", radius);
    if (segments < 3) return sunder_i_fail(err, SUNDER_EARG, "a disc needs at least 3 segments, not %u", segments);
    if (segments > 1u << 24) return sunder_i_fail(err, SUNDER_EARG, "a disc of %u segments is too large", segments);
    disc d = {radius, segments, inside, sunder_i_alloc(2 * (size_t)segments, sizeof(double)),
              sunder_i_calloc(segments, sizeof(bool))};
    sunder_i_arena arena;
    sunder_i_arena_init(&arena);
    sunder_status status = d.xy && d.proved ? prove_corners(&d, &arena, err) : sunder_i_failure_cause(err);
    sunder_i_arena_free(&arena);
    if (!status) status = from_ring(d.xy, segments, out, err);
    sunder_i_free_all(d.xy, d.proved);
    /* doubles at the lower end of their range may coincide */
    if (status != SUNDER_EINVALID) return status;
    return sunder_i_fail(err, SUNDER_ERANGE, "a disc of radius %.17g with %u segments is too small for doubles", radius,
                         segments);
}

sunder_status sunder_shape_rectangle(double width, double height, sunder_shape **out, sunder_error *err)
{
    if (!(width > 0) || !isfinite(width) || !(height > 0) || !isfinite(height))
        return sunder_i_fail(err, SUNDER_EARG,
                             "the sides of a rectangle must be positive and finite, not %.17g x %.17g", width, height);
    const double x = width / 2, y = height / 2;
    /* halves of the least doubles are not doubles */
    if (x + x != width || y + y != height)
        return sunder_i_fail(err, SUNDER_ERANGE, "a rectangle of %.17g x %.17g is too small for doubles", width,
                             height);
    const double xy[8] = {-x, -y, x, -y, x, y, -x, y};
    return from_ring(xy, 4, out, err);
}
