/* segments.c: in the search with a gap, the walk along offset sides past the subsums that cover them. First it takes
 * certain steps, from a point that a grown subsum covers to another one that it covers, which is valid since the subsum
 * is convex. The walk ends at the exact point where the line leaves the last subsum, which points.c tests. If that
 * point is covered after all, by less than the margin, the walk continues exactly from there, one subsum after the
 * other, until certain steps are possible again. */
#include "separation/gap/gap_search.h"

#include "separation/operands/fan.h"

#include "base/extremes.h"

#include <math.h>

typedef struct moved {
    sunder_i_carrier line;                 /* the side without offset, on the lattice */
    double ax, ay, dx, dy, square, length; /* the first end of the offset side; its direction d; length = |d| */
} moved;

static moved moved_side(sunder_i_gap_state *s, size_t segment)
{
    moved m;
    m.line = sunder_i_candidate_carrier(s->g, s->p->segment + segment);
    m.dx = m.line.dx;
    m.dy = m.line.dy;
    m.square = m.dx * m.dx + m.dy * m.dy;
    m.length = sqrt(m.square);
    m.ax = m.line.ax + s->gap * (m.dy / m.length);
    m.ay = m.line.ay - s->gap * (m.dx / m.length);
    return m;
}

static sunder_i_gap_curve curve_of(const moved *m) { return (sunder_i_gap_curve){false, m->line.a, m->line.d}; }

/* ---- The point where a line leaves a grown subsum ---- */

/* The exit at the parameter t through a curve of the subsum: the arc about vertex `at`, or the offset of side `at`.
 * `loss` is the error of t as a multiple of the usual one. */
typedef struct way_out {
    bool any;
    double t, loss;
    bool arc;
    uint32_t at;
} way_out;

/* Offers the exit from the disc about vertex i; `middle` is the parameter of the foot of its centre on the line. Half
 * the chord is computed from the distance of the line. */
static void leave_corner(const sunder_i_gap_state *s, const moved *m, const sunder_i_gap_subsum *r, uint32_t i,
                         double middle, bool forwards, way_out *w)
{
    const double vx = m->ax - r->cx[i], vy = m->ay - r->cy[i];
    const double off = fabs(m->dx * vy - m->dy * vx) / m->length, in = s->gap - off;
    if (in < 0) return;
    const double half = sqrt(in * (s->gap + off)), t = middle + (forwards ? half : -half) / m->length;
    /* An error e of `in` changes half the chord by at most e * gap / half, to first order. */
    if (!w->any || (forwards ? t > w->t : t < w->t))
        *w = (way_out){true, t, half > 0 ? 1 + 4 * s->gap / half : INFINITY, true, i};
}

/* Offers the exit through the offset of side i, n (x - corner) = gap with n = (sy, -sx) / length. */
static void leave_side(const sunder_i_gap_state *s, const moved *m, const sunder_i_gap_subsum *r, uint32_t i,
                       bool forwards, way_out *w)
{
    const double slope = r->sy[i] * m->dx - r->sx[i] * m->dy;
    if (forwards ? slope <= 0 : slope >= 0) return;
    const double vx = m->ax - r->cx[i], vy = m->ay - r->cy[i];
    const double t = (s->gap * r->length[i] - (r->sy[i] * vx - r->sx[i] * vy)) / slope;
    const double along = r->sx[i] * (vx + t * m->dx) + r->sy[i] * (vy + t * m->dy);
    if (!(along >= 0 && along <= r->length[i] * r->length[i])) return;
    /* the errors of heights are divided by the sine of the angle between the lines */
    if (!w->any || (forwards ? t > w->t : t < w->t))
        *w = (way_out){true, t, 1 + 2 * r->length[i] * m->length / fabs(slope), false, i};
}

/* Returns the signed distance from the line, times |d|, of the point where the disc about vertex i touches the offset
 * of side k, of which i is an end; positive on the left. */
static double lean_of_disc(const sunder_i_gap_state *s, const moved *m, const sunder_i_gap_subsum *r, uint32_t i,
                           uint32_t k)
{
    const double x = r->cx[i] + s->gap * r->sy[k] * r->inverse[k], y = r->cy[i] - s->gap * r->sx[k] * r->inverse[k];
    return m->dx * (y - m->ay) - m->dy * (x - m->ax);
}

/* Finds the exit by bisection. Counterclockwise, the boundary of the grown subsum runs on the right of the line, then
 * on its left, and the line leaves it in between: between the vertices farthest on either side, the first offset side
 * that ends on the left is found. The exit is through that side, or through the arc before it. Backwards, left and
 * right are exchanged. */
static way_out leave_by_halving(sunder_i_gap_state *s, const moved *m, const sunder_i_gap_subsum *r, size_t k,
                                bool forwards)
{
    const sunder_i_subsum *sum = s->g->subsum + k;
    const double turn = forwards ? 1 : -1;
    const uint32_t n = r->n, first = sunder_i_subsum_lowest(sum, turn * m->dx, turn * m->dy);
    const uint32_t last = sunder_i_subsum_lowest(sum, -turn * m->dx, -turn * m->dy);
    uint32_t low = first, high = last > first ? last : last + n;
    while (low < high) {
        const uint32_t i = low + (high - low) / 2;
        if (turn * lean_of_disc(s, m, r, (i + 1) % n, i % n) >= 0)
            high = i;
        else
            low = i + 1;
    }
    way_out w = {.any = false};
    for (uint32_t i = low + n - 1; i <= low + n; i++) { /* the previous one, too: doubles may err where the two meet */
        const uint32_t at = i % n;
        const double middle = ((r->cx[at] - m->ax) * m->dx + (r->cy[at] - m->ay) * m->dy) / m->square;
        leave_corner(s, m, r, at, middle, forwards, &w);
        leave_side(s, m, r, at, forwards, &w);
    }
    return w;
}

/* Returns an estimate of where the offset line leaves the grown subsum k; the caller verifies it. A disc is not left
 * beyond its end in the direction of the line, and a side not later than the discs at its ends; this excludes most of
 * them. */
static way_out leave_subsum(sunder_i_gap_state *s, const moved *m, size_t k, bool forwards)
{
    way_out w = {.any = false};
    const sunder_i_gap_subsum *r = sunder_i_gap_load(s, k);
    if (!r) return w;
    if (r->n >= SUNDER_I_SIDES_MANY && !r->vague) w = leave_by_halving(s, m, r, k, forwards);
    if (w.any) return w;
    const double reach = (forwards ? s->gap : -s->gap) / m->length;
    double before = ((r->cx[r->n - 1] - m->ax) * m->dx + (r->cy[r->n - 1] - m->ay) * m->dy) / m->square;
    for (uint32_t i = 0; i < r->n; i++) {
        const double middle = ((r->cx[i] - m->ax) * m->dx + (r->cy[i] - m->ay) * m->dy) / m->square;
        const bool late = !w.any || (forwards ? middle + reach >= w.t : middle + reach <= w.t);
        if (late || (forwards ? before + reach >= w.t : before + reach <= w.t))
            leave_side(s, m, r, i ? i - 1 : r->n - 1, forwards, &w);
        if (late) leave_corner(s, m, r, i, middle, forwards, &w);
        before = middle;
    }
    return w;
}

static sunder_i_gap_curve curve_over(const sunder_i_gap_state *s, size_t k, bool arc, uint32_t i)
{
    const sunder_i_subsum *sum = s->g->subsum + k;
    return (sunder_i_gap_curve){arc, sum->corner[i], arc ? sum->corner[i] : sum->side[i]};
}

/* Returns the crossing of the segment's line with a curve; of a circle the crossing where the line leaves it. */
static sunder_i_gap_point point_over(const moved *m, size_t segment, sunder_i_gap_curve over, bool forwards)
{
    return (sunder_i_gap_point){.c = curve_of(m),
                                .d = over,
                                .crossing = true,
                                .sign = forwards ? 1 : -1,
                                .forwards = forwards,
                                .backwards = !forwards,
                                .segment = segment,
                                .cover = -1};
}

/* Returns whether the line, which meets the grown subsum k, leaves it at the point p. Exact: the line leaves the disc
 * or half-plane that the curve p->d bounds, and the distance of the point from the subsum is exactly the gap. */
static bool leaves_over(sunder_i_gap_state *s, sunder_i_gap_point *p, size_t k)
{
    if (!p->d.arc) {
        /* the line leaves the half-plane to the right of the side */
        const int turn = sunder_i_operands_cross(s->g, p->c.d, p->d.d);
        if (p->forwards ? turn <= 0 : turn >= 0) return false;
    }
    const sunder_i_surd_point *exact = sunder_i_gap_solve(s, p);
    uint32_t side;
    bool flat;
    return exact && sunder_i_gap_cmp(s->p, s->g->subsum + k, exact, &side, &flat) == 0;
}

void sunder_i_gap_pass(sunder_i_gap_state *s, const sunder_i_gap_point *from, size_t k, bool forwards)
{
    const moved m = moved_side(s, from->segment);
    const sunder_i_gap_subsum *r = sunder_i_gap_load(s, k);
    if (!r) return;
    const way_out guess = leave_subsum(s, &m, k, forwards);
    sunder_i_gap_point p = {.crossing = false};
    bool known = false;
    if (guess.any) {
        p = point_over(&m, from->segment, curve_over(s, k, guess.arc, guess.at), forwards);
        known = leaves_over(s, &p, k);
    }
    for (uint32_t i = 0; i < 2 * r->n && !known && !s->failed; i++) {
        p = point_over(&m, from->segment, curve_over(s, k, i & 1, i / 2), forwards);
        known = leaves_over(s, &p, k);
    }
    if (!known) return; /* out of memory: a line that meets a convex set leaves it somewhere */
    sunder_i_gap_doubles(s, p.exact, &p.x, &p.y);
    p.error = s->error;
    const double along = ((p.x - m.ax) * m.dx + (p.y - m.ay) * m.dy) / m.length, spare = 4 * s->error;
    /* the point is certainly beyond the end of the segment */
    if (forwards ? along > m.length + spare : along < -spare) return;
    sunder_i_gap_push(s, sunder_i_gap_length(p.x, p.y) - s->error, &p);
}

/* ---- Certain steps ---- */

/* Moves *t, a parameter of the line, to the farthest tested parameter before `leave_at`, at most the end of the
 * segment, at which the grown subsum k certainly covers the line. Returns false if none is found beyond *t. */
static bool covered_until(sunder_i_gap_state *s, const moved *m, size_t k, bool forwards, double leave_at, double *t)
{
    const double end = forwards ? 1 : 0;
    double step = 4 * s->margin / m->length;
    for (int i = 0; i < 24; i++, step *= 4) {
        double u = forwards ? leave_at - step : leave_at + step;
        if (forwards ? u > end : u < end) u = end;
        if (forwards ? u <= *t : u >= *t) return false;
        if (sunder_i_gap_covers(s, k, m->ax + u * m->dx, m->ay + u * m->dy, 0)) {
            *t = u;
            return true;
        }
    }
    return false;
}

/* Among the subsums that certainly cover the point at t, returns the one whose exit is farthest; -1 if there is
 * none. */
static long farthest_cover(sunder_i_gap_state *s, const moved *m, double t, bool forwards, way_out *out)
{
    const double x = m->ax + t * m->dx, y = m->ay + t * m->dy;
    long best = -1;
    size_t n;
    const uint32_t *near = sunder_i_gap_near(s, x, y, &n);
    s->failed = s->failed || !sunder_i_steps(n / 4);
    for (size_t i = 0; i < n && !s->failed; i++) {
        const size_t k = near ? near[i] : i;
        if (!sunder_i_gap_covers(s, k, x, y, 0)) continue;
        const way_out w = leave_subsum(s, m, k, forwards);
        if (!w.any || (best >= 0 && (forwards ? w.t <= out->t : w.t >= out->t))) continue;
        best = (long)k;
        *out = w;
    }
    return best;
}

/* Walks from t, where subsum `cover` certainly covers the line, to a point that no subsum is known to cover; pushes
 * that point. */
static void walk_line(sunder_i_gap_state *s, size_t segment, const moved *m, double t, bool forwards)
{
    way_out out = {.any = false};
    long cover = -1;
    for (size_t steps = 0; steps <= 2 * s->g->subsums && !s->failed; steps++) {
        /* any covering subsum is used if it leads farther; else the one whose exit is farthest */
        long k = sunder_i_gap_other_cover(s, m->ax + t * m->dx, m->ay + t * m->dy, cover);
        if (k < 0) break;
        way_out w = leave_subsum(s, m, (size_t)k, forwards);
        bool further = w.any && covered_until(s, m, (size_t)k, forwards, w.t, &t);
        if (!further) {
            k = farthest_cover(s, m, t, forwards, &w);
            if (k < 0) break;
            further = covered_until(s, m, (size_t)k, forwards, w.t, &t);
        }
        cover = k;
        out = w;
        if (!further) break;
        if (forwards ? t >= 1 : t <= 0) return;
        if (sunder_i_gap_length(m->ax + t * m->dx, m->ay + t * m->dy) - s->error > s->best) return;
    }
    if (cover < 0 || !out.any) return;
    sunder_i_gap_point p = point_over(m, segment, curve_over(s, (size_t)cover, out.arc, out.at), forwards);
    p.x = m->ax + out.t * m->dx;
    p.y = m->ay + out.t * m->dy;
    p.error = s->error * out.loss;
    p.cover = cover;
    sunder_i_gap_push(s, sunder_i_gap_length(m->ax + t * m->dx, m->ay + t * m->dy) - s->error, &p);
}

/* Processes an offset side: its point nearest to the origin is the foot of the perpendicular, or an end. Which of them
 * it is is decided exactly, since the foot has the same parameter on the offset side as on the side itself. */
void sunder_i_gap_take_segment(sunder_i_gap_state *s, size_t segment)
{
    const moved m = moved_side(s, segment);
    const bool before = sunder_i_operands_dot(s->g, m.line.a, m.line.d) >= 0;
    const bool past = !before && sunder_i_operands_dot(s->g, m.line.b, m.line.d) <= 0;
    const double t = before ? 0 : past ? 1 : sunder_i_min(1, sunder_i_max(0, -(m.ax * m.dx + m.ay * m.dy) / m.square));
    const double x = m.ax + t * m.dx, y = m.ay + t * m.dy;
    const bool tiny = !(m.length > SUNDER_I_SHORTEST); /* t is unknown then */
    const double key = tiny ? 0 : sunder_i_gap_length(x, y) - s->error;
    if (key > s->best) return;
    if (!tiny && sunder_i_gap_cover(s, x, y, 0) >= 0) {
        if (!past) walk_line(s, segment, &m, t, true);
        if (!before) walk_line(s, segment, &m, t, false);
        return;
    }
    /* an end of the offset side is the point where its line touches the circle about the vertex */
    const sunder_i_gap_point p = {.x = x,
                                  .y = y,
                                  .error = tiny ? INFINITY : s->error,
                                  .c = curve_of(&m),
                                  .d = {true, past ? m.line.b : m.line.a, m.line.d},
                                  .crossing = before || past,
                                  .sign = 1,
                                  .forwards = !past,
                                  .backwards = !before,
                                  .segment = segment,
                                  .cover = -1};
    sunder_i_gap_push(s, key, &p);
}
