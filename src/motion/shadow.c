/* shadow.c: depths over directions. The rays at the two sides of a bin are tested; a part hides those points of a bin
 * that are farther away than the greater of the two depths at which the rays enter it (shadow.h). A ray is clipped by
 * the sides of the part, each moved inward by a margin, so that the result is inside for certain; the margins cover the
 * errors of the corners and of rounding. */
#include "motion/shadow.h"

#include "base/extremes.h"

#include <float.h>
#include <math.h>

/* Far more than the rounding error of turns and rays (a few 2^-52), far less than a bin. */
#define TURN_ROUNDING 0x1p-44
/* The number of bins for all directions, which is needed for one node of a thousand, so that a coarse map is
 * sufficient; and the least number of bins, which still separate nodes in the narrowest sector. */
#define BINS_ALL_ROUND 128
#define BINS_LEAST 16

static double wrap_turn(double turn) { return turn < 0 ? turn + 4 : turn >= 4 ? turn - 4 : turn; }

double sunder_i_turn_between(double a, double b) { return wrap_turn(wrap_turn(b) - wrap_turn(a)); }

static void ray_at(double turn, double out[2])
{
    const double p = wrap_turn(turn);
    out[0] = p < 2 ? 1 - p : p - 3;
    out[1] = p < 1 ? p : p < 3 ? 2 - p : p - 4;
}

bool sunder_i_sector_of(const double (*point)[2], int n, double error, bool at_eye, sunder_i_sector *out)
{
    double first = NAN, low = 0, high = 0, margin = TURN_ROUNDING;
    for (int i = 0; i < n; i++) {
        const double size = fabs(point[i][0]) + fabs(point[i][1]);
        if (!(size > 32 * error)) {
            if (at_eye) continue;
            return false;
        }
        const double t = sunder_i_turn(point[i][0], point[i][1]);
        /* dy has an error of `error`, the sum |dx| + |dy| one of twice that, and |dy| <= the sum. */
        if (4 * error > (margin - TURN_ROUNDING) * size) margin = TURN_ROUNDING + 4 * error / size;
        if (isnan(first)) first = t;
        const double d = sunder_i_turn_between(first, t), off = d > 2 ? d - 4 : d;
        low = off < low ? off : low;
        high = off > high ? off : high;
    }
    if (isnan(first)) return false;
    *out = (sunder_i_sector){wrap_turn(first + low - margin), high - low + 2 * margin};
    return out->width < 2;
}

void sunder_i_shadow_start(sunder_i_shadow *shadow, sunder_i_sector sector)
{
    shadow->bins = sector.width >= 4
                       ? BINS_ALL_ROUND
                       : (int)sunder_i_min(SUNDER_I_BINS, sunder_i_max(BINS_LEAST, sector.width * SUNDER_I_BINS));
    shadow->sector = (sunder_i_sector){wrap_turn(sector.low), sunder_i_min(sector.width, 4)};
    shadow->per_turn = shadow->bins / shadow->sector.width;
    for (int k = 0; k <= shadow->bins; k++) ray_at(shadow->sector.low + k / shadow->per_turn, shadow->ray[k]);
    for (int k = 0; k < shadow->bins; k++) shadow->depth[k] = INFINITY;
}

/* Intersects `sector` with the sector of the shadow. Stores the intervals, as bin positions from the beginning of the
 * shadow's sector, in `piece` and returns their number, 2 at most. */
static int pieces_of(const sunder_i_shadow *s, sunder_i_sector sector, double piece[2][2])
{
    const double at = sunder_i_turn_between(s->sector.low, sector.low);
    int n = 0;
    for (int k = 0; k < 2; k++) {
        const double low = sunder_i_max(at - 4 * k, 0), high = sunder_i_min(at - 4 * k + sector.width, s->sector.width);
        if (low > high) continue;
        piece[n][0] = low * s->per_turn;
        piece[n++][1] = high * s->per_turn;
    }
    return n;
}

/* ---- Casting ---- */

/* The lines of the sides of a part, relative to the eye: the point at parameter t of a ray u is clearly left of side i
 * if height[i] + t cross(side[i], u) > margin[i]. */
typedef struct caster {
    int n;
    double side[SUNDER_I_CAST_CORNERS][2], height[SUNDER_I_CAST_CORNERS], margin[SUNDER_I_CAST_CORNERS];
} caster;

/* Sets *c from the corners of a part. Returns false if products might leave the range of doubles. */
static bool prepare_caster(caster *c, const double (*corner)[2], int n, double error)
{
    double reach = 0;
    for (int i = 0; i < n; i++) reach = sunder_i_max(reach, fabs(corner[i][0]) + fabs(corner[i][1]));
    if (!(reach < 0x1p500)) return false;
    c->n = n;
    for (int i = 0; i < n; i++) {
        const double *a = corner[i], *b = corner[i + 1 < n ? i + 1 : 0];
        const double ex = b[0] - a[0], ey = b[1] - a[1];
        c->side[i][0] = ex;
        c->side[i][1] = ey;
        c->height[i] = ey * a[0] - ex * a[1];
        /* A side has an error of 2 `error`, its beginning one of `error`, and no ray is followed beyond `reach`. Errors
         * are at least a few units in the last place of the coordinates, so that this covers the rounding errors,
         * too. */
        c->margin[i] = 16 * (error + DBL_EPSILON * reach) * (fabs(ex) + fabs(ey) + reach) + DBL_MIN;
    }
    return true;
}

/* Returns the parameter of the first point of the ray that is clearly inside the part; infinity if there is none. */
static double entry_of_ray(const caster *c, const double ray[2])
{
    double low = 0, high = INFINITY;
    for (int i = 0; i < c->n; i++) {
        const double g = c->side[i][0] * ray[1] - c->side[i][1] * ray[0], rest = c->margin[i] - c->height[i];
        if (g > 0) {
            if (rest > low * g) low = rest / g;
        } else if (g < 0) {
            if (rest > high * g) high = rest / g;
        } else if (rest > 0) {
            return INFINITY;
        }
        if (high <= low) return INFINITY;
    }
    return low * (1 + 0x1p-40) < high ? low * (1 + 0x1p-40) : (double)INFINITY;
}

/* Returns a lower bound of the distance (in |dx| + |dy|) of the hull of the corners from the eye. */
static double least_distance(const double (*corner)[2], int n, double error)
{
    double gap = 0;
    for (int axis = 0; axis < 2; axis++) {
        double low = corner[0][axis], high = low;
        for (int i = 1; i < n; i++) {
            low = corner[i][axis] < low ? corner[i][axis] : low;
            high = corner[i][axis] > high ? corner[i][axis] : high;
        }
        const double off = (low > 0 ? low : high < 0 ? -high : 0) - error;
        if (off > 0) gap += off;
    }
    return gap;
}

void sunder_i_shadow_cast(sunder_i_shadow *shadow, const double (*corner)[2], int n, double error)
{
    caster c;
    sunder_i_sector sector;
    double piece[2][2];
    /* The rays to test; if the eye is a corner of the part, only the rays to the other corners. */
    if (!sunder_i_sector_of(corner, n, error, true, &sector)) sector = shadow->sector;
    if (!sunder_i_shadow_takes(shadow, sector) ||
        sunder_i_shadow_hides(shadow, sector, least_distance(corner, n, error)))
        return;
    if (!prepare_caster(&c, corner, n, error)) return;
    const int pieces = pieces_of(shadow, sector, piece);
    for (int i = 0; i < pieces; i++) {
        double before = INFINITY;
        const int first = (int)ceil(piece[i][0]), last = (int)sunder_i_min(floor(piece[i][1]), shadow->bins);
        for (int k = first; k <= last; k++) {
            const double at = entry_of_ray(&c, shadow->ray[k]);
            const double depth = at > before ? at : before;
            if (k > first && depth < shadow->depth[k - 1]) shadow->depth[k - 1] = depth;
            before = at;
        }
    }
}

bool sunder_i_shadow_takes(const sunder_i_shadow *shadow, sunder_i_sector sector)
{
    double piece[2][2];
    const int pieces = pieces_of(shadow, sector, piece);
    for (int i = 0; i < pieces; i++)
        if (floor(piece[i][1]) > ceil(piece[i][0])) return true;
    return false;
}

bool sunder_i_shadow_hides(const sunder_i_shadow *shadow, sunder_i_sector sector, double distance)
{
    double piece[2][2];
    const int pieces = pieces_of(shadow, sector, piece);
    const double near = distance * (1 - 0x1p-40);
    for (int i = 0; i < pieces; i++)
        for (int k = (int)piece[i][0]; k <= (int)piece[i][1] && k < shadow->bins; k++)
            if (!(shadow->depth[k] < near)) return false;
    return true;
}
