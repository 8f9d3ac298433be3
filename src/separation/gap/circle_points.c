/* circle_points.c: in the search with a gap, the points of circles nearest to the origin, and the crossings of two
 * circles. */
#include "separation/gap/gap_search.h"

#include "base/extremes.h"

#include <math.h>

/* Returns whether each of the two crossings of the circles about a and b is certainly too far or covered, or there is
 * none, in doubles. The margins are far larger than the errors, since the sine and the cosine of half the angle at the
 * centres are greater than 1e-3. */
static bool arcs_idle(sunder_i_gap_state *s, const double a[2], const double b[2])
{
    const double vx = b[0] - a[0], vy = b[1] - a[1], gap = s->gap, best = s->best, e = 8 * s->g->error;
    const double square = vx * vx + vy * vy;
    if (s->g->coarse > 0)
        return false; /* else the differences are exact, and their products have a relative error
                                         * below 2^-50 */
    if (square > 4 * gap * gap * (1 + 1e-9) + e * (gap + e)) return true;
    if (!(square > 1e-6 * gap * gap)) return false;
    const double product = gap * gap / square - 0.25; /* (half chord / length)^2 */
    if (product < 1e-6) return false;
    const double f = sqrt(product), spare = 1e-9 * (gap + s->g->magnitude);
    for (int sign = -1; sign <= 1; sign += 2) {
        const double x = (a[0] + b[0]) / 2 - sign * f * vy, y = (a[1] + b[1]) / 2 + sign * f * vx;
        if (x * x + y * y > (best + spare) * (best + spare)) continue;
        if (sunder_i_gap_cover(s, x, y, spare) < 0) return false;
    }
    return true;
}

/* Finds the crossings of two circles. The difference v of the centres is computed on the lattice without cancellation,
 * with an error of 4 u |v|. With c = |v| / 2 and h^2 = g^2 - c^2, an error of 16 u g^2 in h^2 causes one of 8 u g^2 / h
 * in h; the direction of the chord has an error of 4 u. */
static void cross_arcs(sunder_i_gap_state *s, size_t i, size_t j)
{
    const sunder_i_point a = s->p->center[i], b = s->p->center[j];
    const sunder_i_lattice *l = &s->g->placed.lattice;
    const double at[2] = {sunder_i_approx(l, a.x), sunder_i_approx(l, a.y)};
    const double to[2] = {sunder_i_approx(l, b.x), sunder_i_approx(l, b.y)};
    if (arcs_idle(s, at, to)) return;
    const sunder_i_point v = sunder_i_operands_diff(s->g, b, a);
    const double vx = sunder_i_approx(l, v.x), vy = sunder_i_approx(l, v.y), length = sunder_i_gap_length(vx, vy);
    if (!(length > 0) || length > 2 * s->gap + s->error) return;
    const double product = (2 * s->gap - length) * (2 * s->gap + length) / 4, half = sqrt(sunder_i_max(product, 0));
    const double x = (at[0] + to[0]) / 2, y = (at[1] + to[1]) / 2;
    for (int sign = -1; sign <= 1; sign += 2) {
        sunder_i_gap_point p = {.x = x - sign * half * (vy / length),
                                .y = y + sign * half * (vx / length),
                                .error = s->error * (half > 0 ? 1 + s->gap / half : INFINITY),
                                .c = {true, a, a},
                                .d = {true, b, b},
                                .crossing = true,
                                .sign = sign,
                                .cover = -1};
        /* If the circles are nearly tangent, h is at most the root of the error of h^2, 4 sqrt(u) g. */
        const double most = 0x1p-20 * s->gap, doubt = p.error < most ? p.error : half + most + s->error;
        const double key = sunder_i_gap_length(p.x, p.y) - doubt;
        if (key > s->best) continue;
        if (sunder_i_gap_cover(s, p.x, p.y, doubt) < 0) sunder_i_gap_push(s, key, &p);
    }
}

void sunder_i_gap_take_arc(sunder_i_gap_state *s, size_t arc)
{
    const sunder_i_point a = s->p->center[arc];
    const sunder_i_lattice *l = &s->g->placed.lattice;
    const double x = sunder_i_approx(l, a.x), y = sunder_i_approx(l, a.y), length = sunder_i_gap_length(x, y);
    if (sunder_i_gap_deep_inside(s, x, y)) return;
    sunder_i_gap_point p = {.error = 2 * s->error, .c = {true, a, a}, .cover = -1};
    /* all points of a circle about the origin are equally near; the leftmost one is taken */
    p.x = length > 0 ? x - s->gap * (x / length) : -s->gap;
    p.y = length > 0 ? y - s->gap * (y / length) : 0;
    if (sunder_i_gap_cover(s, p.x, p.y, p.error) < 0) sunder_i_gap_push(s, sunder_i_gap_length(p.x, p.y) - p.error, &p);
    for (size_t k = 0; k < s->arcs_n && !s->failed; k++) {
        s->failed = !sunder_i_step();
        cross_arcs(s, s->arcs[k], arc);
    }
    s->arcs[s->arcs_n++] = arc;
}
