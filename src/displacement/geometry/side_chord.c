/* Chords across corners that two sides of barriers share, and across ends of two sides on one ray from the anchor.
 *
 * Each side casts its shadow from the anchor a (geometry/obstacle_shadow.h). If sides pb and bq meet in b, on opposite
 * sides of the ray from a through b, the two shadows share the ray beyond b as their boundary. All of it is forbidden,
 * but the lines of either shadow leave a gap around it, as narrow as rounding, that no line closes.
 *
 * Let p' be in the shadow of pb, q' in that of bq, and let the chord p'q' cross the ray at c, beyond b. The shadow of
 * pb is convex, contains p' and c, and contains everything behind any of its points; so it contains everything behind
 * p'c. The same holds for q'. So everything behind the chord is in the union of the two shadows, exactly and whatever
 * p' and q' are. The half-planes past the chord are used like those of any piece, and its lines pass the gap at some
 * distance on the left and right.
 *
 * The chord cuts off a share of the two sides at the corner, and is moved away from the anchor until it passes
 * beyond b, and a little more (BEYOND), so that rounding to doubles does no harm. Predicates test the required
 * properties on the doubles. The sliver between b and the chord is not covered.
 *
 * Two sides pb and b'q, whose ends b and b' lie on one ray from the anchor, do the same beyond the farther of the two
 * ends: both shadows have the rest of the ray as a boundary. So the chord passes beyond both. */
#include "displacement/geometry/side_chord.h"
#include "displacement/geometry/tuning.h"

#include "base/extremes.h"
#include "sunder_shape.h"

#include <math.h>

static double cross_product(const double u[2], const double v[2]) { return u[0] * v[1] - u[1] * v[0]; }
static double dot_product(const double u[2], const double v[2]) { return u[0] * v[0] + u[1] * v[1]; }

static int side_of(const double p[2], const double q[2], const double u[2])
{
    return sunder_orient(&(sunder_point){p[0], p[1]}, &(sunder_point){q[0], q[1]}, &(sunder_point){u[0], u[1]});
}

/* Is `place` in the shadow of the segment from b to p, seen from a? */
static bool is_shaded(const double a[2], const double b[2], const double p[2], const double place[2])
{
    const int turn = side_of(a, b, p);
    return turn != 0 && side_of(a, b, place) == turn && side_of(a, p, place) != turn && side_of(b, p, place) != 0 &&
           side_of(b, p, place) == -side_of(b, p, a);
}

/* Do the ends of the two sides lie on one ray from a? The sign of a difference of doubles is exact. */
static bool are_on_one_ray(const double a[2], const double *const end[2])
{
    for (int c = 0; c < 2; c++) {
        const double to[2] = {end[0][c] - a[c], end[1][c] - a[c]};
        if ((to[0] > 0) != (to[1] > 0) || (to[0] < 0) != (to[1] < 0)) return false;
    }
    return side_of(a, end[0], end[1]) == 0;
}

/* Does the shadow of the chord lie in the shadows of the two sides? The chord is in front of the anchor everywhere, so
 * it crosses the ray beyond an end if that end is on the anchor's side of it. far: the farther end, from a. */
static bool is_behind(const double a[2], const double *const end[2], const double *const other[2], const double far[2],
                      const double chord[4])
{
    if (!is_shaded(a, end[0], other[0], chord) || !is_shaded(a, end[1], other[1], chord + 2)) return false;
    for (int k = 0; k < 4; k += 2) {
        const double at[2] = {chord[k] - a[0], chord[k + 1] - a[1]};
        if (!(dot_product(at, far) > 0.5 * dot_product(far, far))) return false;
    }
    const int anchor = side_of(chord, chord + 2, a);
    return side_of(a, end[0], other[0]) == -side_of(a, end[1], other[1]) && anchor != 0 &&
           side_of(chord, chord + 2, end[0]) == anchor && side_of(chord, chord + 2, end[1]) == anchor;
}

bool sunder_i_side_chord(const double a[2], const double *const end[2], const double *const other[2], double share,
                         double chord[4])
{
    if (!are_on_one_ray(a, end)) return false;
    const double to[2][2] = {{end[0][0] - a[0], end[0][1] - a[1]}, {end[1][0] - a[0], end[1][1] - a[1]}};
    const double *path = dot_product(to[1], to[1]) > dot_product(to[0], to[0]) ? to[1] : to[0];
    const double size = dot_product(path, path);
    double at[2][2];
    if (!(size > 0)) return false;
    /* A point of each side near its end, moved outwards as far as the end would have to be moved to the farther one. */
    for (int k = 0; k < 2; k++) {
        const double outwards = size / dot_product(to[k], path);
        for (int c = 0; c < 2; c++) at[k][c] = outwards * (to[k][c] + share * (other[k][c] - end[k][c]));
    }
    /* Where the segment between these points crosses the ray, as a multiple of the distance of the farther end. */
    const double left = cross_product(path, at[0]), right = cross_product(path, at[1]);
    if (!(left * right < 0)) return false;
    const double at_ray = left / (left - right),
                 passes = ((1 - at_ray) * dot_product(at[0], path) + at_ray * dot_product(at[1], path)) / size;
    if (!(passes > 0.5)) return false;
    const double times = (1 + BEYOND) * sunder_i_max(1, 1 / passes);
    for (int c = 0; c < 2; c++) {
        chord[c] = a[c] + times * at[0][c];
        chord[2 + c] = a[c] + times * at[1][c];
    }
    return is_behind(a, end, other, path, chord);
}

bool sunder_i_passes_end(const double a[2], const double end[2], const double u[2])
{
    const double to[2] = {end[0] - a[0], end[1] - a[1]}, along = -dot_product(to, u);
    return along > 0 && fabs(cross_product(to, u)) <= BESIDE * along;
}
