/* covered_point.c: in the search with a gap, conversions to doubles, and the test whether a grown subsum covers a
 * point. */
#include "separation/gap/gap_search.h"

#include "base/extremes.h"
#include "base/watch.h"
#include "separation/operands/fan.h"

#include <math.h>

/* ---- Numbers ---- */

/* Converts the four highest limbs. The power of two is applied as two factors, since the smallest sides of a wide
 * lattice lie below the range of doubles. */
double sunder_i_gap_big(sunder_i_big v, long exponent)
{
    const long top = v.size < 0 ? -v.size : v.size;
    double r = 0;
    for (long i = top - 1; i >= 0 && i >= top - 4; i--) {
        const int e = (int)(64 * i + exponent);
        r += (double)v.limb[i] * ldexp(1, e / 2) * ldexp(1, e - e / 2);
    }
    return v.size < 0 ? -r : r;
}

double sunder_i_gap_length(double x, double y) { return sqrt(x * x + y * y); }

/* The coordinates are truncated at 2^-60 of the magnitude. */
void sunder_i_gap_doubles(sunder_i_gap_state *s, const sunder_i_surd_point *exact, double *x, double *y)
{
    const sunder_i_lattice *l = &s->g->placed.lattice;
    const long size = ilogb(s->g->magnitude) + l->approx_shift;
    const unsigned long bits = size < 60 ? (unsigned long)(60 - size) : 0;
    sunder_i_big xy[2];
    sunder_i_surd_point_scaled(s->g, exact, bits, xy);
    *x = sunder_i_gap_big(xy[0], -(long)bits - l->approx_shift);
    *y = sunder_i_gap_big(xy[1], -(long)bits - l->approx_shift);
}

/* ---- Subsums ---- */

const sunder_i_gap_subsum *sunder_i_gap_load(sunder_i_gap_state *s, size_t k)
{
    sunder_i_gap_subsum *r = s->pieces + k;
    if (r->n) return r;
    sunder_i_subsum *m = s->g->subsum + k;
    if (!m->sides && !sunder_i_subsum_make(s->g, m)) {
        s->failed = true;
        return NULL;
    }
    const size_t n = m->sides;
    double *block = sunder_i_arena_alloc(&s->g->placed.lattice.arena, 2 * n, sizeof *block);
    if (!block) {
        s->failed = true;
        return NULL;
    }
    *r = (sunder_i_gap_subsum){m->sides, false, m->cx, m->cy, m->sx, m->sy, block, block + n};
    for (size_t i = 0; i < n; i++) {
        r->length[i] = sunder_i_gap_length(r->sx[i], r->sy[i]);
        r->inverse[i] = 1 / r->length[i];
        r->vague = r->vague || !(r->length[i] > SUNDER_I_SHORTEST);
    }
    return r;
}

bool sunder_i_gap_near_box(const sunder_i_gap_state *s, size_t k, double x, double y, double reach)
{
    return sunder_i_box_near_point(s->g->subsum[k].box, x, y, reach + s->g->error);
}

/* Only a side that faces the point can be the nearest: its height over the side's line is positive, or zero to within
 * the error of a height. (Its sign alone does not suffice: outside a sharp corner a point is far away but hardly above
 * either side.) A point that is inside and this close to the line of a side is equally close to the foot on that side,
 * which is found. */
double sunder_i_gap_distance(const sunder_i_gap_state *s, const sunder_i_gap_subsum *piece, double x, double y)
{
    double least = -1;
    for (uint32_t i = 0; i < piece->n; i++) {
        double vx = x - piece->cx[i], vy = y - piece->cy[i];
        const double length = piece->length[i], turn = piece->sx[i] * vy - piece->sy[i] * vx;
        if (turn > s->error * length) continue;
        const double along = piece->sx[i] * vx + piece->sy[i] * vy;
        double square;
        if (along <= 0)
            square = vx * vx + vy * vy;
        else if (along >= length * length) {
            vx -= piece->sx[i];
            vy -= piece->sy[i];
            square = vx * vx + vy * vy;
        } else {
            const double height = turn / length;
            square = height * height;
        }
        if (least < 0 || square < least) least = square;
    }
    return least < 0 ? 0 : sqrt(least);
}

/* Returns the signed distance of the point from the line of side i, positive outside. */
static double height_over(const sunder_i_gap_subsum *r, uint32_t i, double x, double y)
{
    return (r->sy[i] * (x - r->cx[i]) - r->sx[i] * (y - r->cy[i])) * r->inverse[i];
}

/* Returns the largest signed distance of the point from the lines of all sides, with an error of at most s->error. The
 * distance from the piece is not less; if the result is negative the point is inside. */
static double out_by(const sunder_i_gap_subsum *r, double x, double y)
{
    double most = -INFINITY;
    for (uint32_t i = 0; i < r->n; i++) {
        const double h = height_over(r, i, x, y);
        if (h > most) most = h;
    }
    return most;
}

/* ---- Pieces with many sides ---- */

/* Returns a lower bound, less the error, of the signed distance of the point from the diagonal from vertex 0 to vertex
 * i, positive on its left (turn 1) or right (turn -1). A diagonal is a difference of rounded vertices with an error of
 * 2 * 8 u M in each coordinate, 23 u M in all, which causes an error of the height of 23 u M |v| / |d|; `error` allows
 * for 128 u S. */
static double beside_diagonal(const sunder_i_gap_state *s, const sunder_i_gap_subsum *r, uint32_t i, double x, double y,
                              int turn)
{
    const double dx = r->cx[i] - r->cx[0], dy = r->cy[i] - r->cy[0], vx = x - r->cx[0], vy = y - r->cy[0];
    return (turn * (dx * vy - dy * vx) - s->error * (fabs(vx) + fabs(vy))) / sunder_i_gap_length(dx, dy);
}

/* Tests the point with one triangle of the fan about vertex 0: a point deep inside the triangle is as deep inside the
 * piece, and a point far outside over one side is as far from the piece. *side becomes the side of that triangle. */
static sunder_i_fan_answer by_triangle(const sunder_i_gap_state *s, const sunder_i_gap_subsum *r, double x, double y,
                                       double deep, double far, uint32_t *side)
{
    const sunder_i_fan fan = sunder_i_fan_at(r->n, r->cx, r->cy, x, y);
    const uint32_t low = *side = fan.low, high = low + 1;
    const double left = fan.first ? height_over(r, 0, x, y) : -beside_diagonal(s, r, low, x, y, 1);
    const double right = fan.last ? height_over(r, high, x, y) : -beside_diagonal(s, r, high, x, y, -1);
    return sunder_i_fan_says(&fan, (double[3]){height_over(r, low, x, y), left, right}, deep, far);
}

/* Returns whether side i, with its ends, is certainly closer to the point than `least`; then the piece is, too. */
static bool side_is_near(const sunder_i_gap_subsum *r, uint32_t i, double x, double y, double least)
{
    const double vx = x - r->cx[i], vy = y - r->cy[i], along = (r->sx[i] * vx + r->sy[i] * vy) * r->inverse[i];
    const double height = height_over(r, i, x, y), past = sunder_i_max(0, sunder_i_max(-along, along - r->length[i]));
    return least > 0 && height * height + past * past < least * least;
}

bool sunder_i_gap_covers(sunder_i_gap_state *s, size_t k, double x, double y, double slack)
{
    if (!sunder_i_gap_near_box(s, k, x, y, s->gap)) return false;
    const sunder_i_gap_subsum *r = sunder_i_gap_load(s, k);
    if (!r || r->vague) return false;
    const double doubt = s->margin + slack;
    if (r->n >= SUNDER_I_SIDES_MANY) {
        uint32_t side;
        const sunder_i_fan_answer where = by_triangle(s, r, x, y, doubt, s->gap + doubt, &side);
        if (where != SUNDER_I_FAN_DOUBT) return where == SUNDER_I_FAN_INSIDE;
        if (side_is_near(r, side, x, y, s->gap - doubt)) return true;
    }
    const double out = out_by(r, x, y);
    if (out > s->gap + doubt) return false;
    if (out < -doubt) return true;
    return sunder_i_gap_distance(s, r, x, y) < s->gap - s->margin - slack;
}

const uint32_t *sunder_i_gap_near(const sunder_i_gap_state *s, double x, double y, size_t *n)
{
    *n = s->g->subsums;
    return s->p->quadtree ? sunder_i_gap_quadtree_near(s->p->quadtree, x, y, n) : NULL;
}

long sunder_i_gap_other_cover(sunder_i_gap_state *s, double x, double y, long but)
{
    size_t n;
    const uint32_t *near = sunder_i_gap_near(s, x, y, &n);
    s->failed = s->failed || !sunder_i_steps(n);
    for (size_t i = 0; i < n; i++) {
        const size_t k = sunder_i_gap_nth(s, near, i);
        if ((long)k == but || !sunder_i_gap_covers(s, k, x, y, 0)) continue;
        s->hint = k;
        return (long)k;
    }
    return -1;
}

long sunder_i_gap_cover(sunder_i_gap_state *s, double x, double y, double slack)
{
    size_t n;
    const uint32_t *near = sunder_i_gap_near(s, x, y, &n);
    s->failed = s->failed || !sunder_i_steps(n);
    if (near && s->g->subsums && sunder_i_gap_covers(s, s->hint, x, y, slack)) return (long)s->hint;
    for (size_t i = 0; i < n; i++) {
        const size_t k = sunder_i_gap_nth(s, near, i);
        if (!sunder_i_gap_covers(s, k, x, y, slack)) continue;
        s->hint = k;
        return (long)k;
    }
    return -1;
}

static bool is_deep(const sunder_i_gap_state *s, const sunder_i_gap_subsum *r, double x, double y, double deep)
{
    uint32_t side;
    const sunder_i_fan_answer where =
        r->n >= SUNDER_I_SIDES_MANY ? by_triangle(s, r, x, y, deep, deep, &side) : SUNDER_I_FAN_DOUBT;
    return where == SUNDER_I_FAN_DOUBT ? out_by(r, x, y) < -deep : where == SUNDER_I_FAN_INSIDE;
}

bool sunder_i_gap_deep_inside(sunder_i_gap_state *s, double x, double y)
{
    size_t n;
    const uint32_t *near = sunder_i_gap_near(s, x, y, &n);
    s->failed = s->failed || !sunder_i_steps(n / 4);
    for (size_t i = 0; i < n; i++) {
        const size_t k = sunder_i_gap_nth(s, near, i);
        if (!sunder_i_gap_near_box(s, k, x, y, 0)) continue;
        const sunder_i_gap_subsum *r = sunder_i_gap_load(s, k);
        if (!r) return false;
        if (r->vague || !is_deep(s, r, x, y, s->margin)) continue;
        s->hint = k;
        return true;
    }
    return false;
}
