/* Half-planes such that every relative move u that separates A from B + u lies in one of them, proved in doubles.
 *
 * Let K = A + (-B). Without a clearance the two are apart exactly if u is not in the interior of K; with a clearance g,
 * exactly if u is not in the interior O of K grown by the disc of radius g. Take any half-planes n.u >= d such that
 * each point of the boundary of O lies in one, and let T be the set of points in none of them. T is convex, so
 * connected, and misses that boundary. So if one point of T is in O, all of T is, and every u outside O is in one of
 * the half-planes. So nothing needs to be known exactly: n may be any vector near the normal of an edge PQ, as long as
 * d is at most n.P and n.Q. Even the order in which edges of A and B are merged may be wrong where they are parallel up
 * to rounding: the boundary is then another closed curve in K around the same point.
 *
 *              n2    n'
 *              |   /         An edge's line is offset by g. Round the corner Q, between the directions n1, n2 of two
 *      ________Q____ n1      edges, each w of length 1 has n'.w >= c for c the less of n'.n1 and n'.n2, so the arc
 *              |             Q + g w is beyond n'.u = n'.Q + c g. Two such lines at a right angle make c 0.92.
 *              |
 *
 * So at a corner up to a thirteenth of the clearance is lost. If a given place satisfies all of these lines but not the
 * clearance, a line made for that place covers so small an angle that the place is behind it.
 *
 * Edges that turn little, or not at all (two walls that face each other make one each), share one line, that of their
 * chord. Otherwise two lines that differ only by rounding would each be a case, and the number of cases of a row of
 * houses would double with each.
 *
 * A negative clearance -s: some v with |v| <= s takes u + v out of the interior of K. If T, made without a clearance,
 * contains all such u + v, there is no such v; so the half-planes move inward by s.
 *
 * Rounding, with e = 2^-53 and S the sum over both coordinates of the greatest |a| + |b| + |offset|: corners less their
 * origin have an error of e of themselves, and P = (a - b) - offset takes two more roundings: 3 e S in all, for both
 * coordinates. n.P adds 3 e |P|, and the last sum one more. So 8 e S = 2^-50 S suffices. The direction of an edge of
 * length l has an error, its tilt, of at most 2^-50 S / l: the point Q + g n1 for the true n1 is within the line's
 * offset up to a share of the square of the tilt, an arc's up to the tilt itself. */
#include "displacement/prove/proofs/half_planes.h"
#include "displacement/geometry/obstacle.h"
#include "displacement/prove/proofs/exact_line.h"

#include "convex/merge.h"

#include "base/extremes.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define UNIT 0x1p-50

/* Corners with a turn whose cosine exceeds this are within the rounding errors of their edges. */
#define STRAIGHT (1 - 0x1p-51)
/* The number of lines round a corner depends on the cosine of its turn: one above SLIGHT, two above SQUARE, else
 * four. */
#define SLIGHT 0.92
#define SQUARE -0.01
/* Half the greatest angle that a line made for one place covers. */
#define WIDEST 0.3
/* The greatest number of edges that share one line. */
#define MOST_IN_RUN 16

typedef struct side {
    double n[2], tilt;
} side;

typedef struct walk {
    const sunder_i_parting *parting;
    sunder_i_half_plane *half_plane;
    size_t n;
    double slack, size;
    double inner[2]; /* a point in the interior of K */
    bool holds;      /* it is in T, as far as lines have been made */
} walk;

static double dot_product(const double p[2], const double q[2]) { return p[0] * q[0] + p[1] * q[1]; }

static void add_line(walk *w, const sunder_i_half_plane *line)
{
    if (!(dot_product(line->n, w->inner) < line->base - w->slack)) w->holds = false;
    w->half_plane[w->n++] = *line;
}

/* Adds the half-plane n.u >= base - slack + by * clearance. */
static void add_half_plane(walk *w, const double n[2], double base, double by)
{
    const double d = base - w->slack;
    add_line(w, &(sunder_i_half_plane){.n = {n[0], n[1]}, .d = d + by * w->parting->clearance, .base = d, .by = by});
}

/* A run: consecutive edges of K that share one line, that of their chord. */
typedef struct run {
    double corner[2 * (MOST_IN_RUN + 1)];
    size_t edges;
    side first, last;
    bool exact; /* its corners have no rounding error */
} run;

static void begin_run(run *r, const double from[2], const double to[2], const side *s)
{
    memcpy(r->corner, from, 2 * sizeof *from);
    memcpy(r->corner + 2, to, 2 * sizeof *to);
    r->edges = 1;
    r->first = r->last = *s;
}

/* Can two runs, the second of which continues the first, share one line? Between edges that turn by t, a chord of
 * length l is at most l tan(t / 2) / 2 from any corner, or about l t / 4 if t is small; the test uses l sin(t) / 2. */
static bool can_join(const walk *w, const run *r, const run *next)
{
    const double sine = r->first.n[0] * next->last.n[1] - r->first.n[1] * next->last.n[0];
    const double *p = r->corner, *q = next->corner + 2 * next->edges;
    return r->edges + next->edges <= MOST_IN_RUN && dot_product(r->first.n, next->last.n) > SLIGHT &&
           fabs(sine) * hypot(q[0] - p[0], q[1] - p[1]) / 2 <= sunder_i_max(w->parting->coarse, w->slack);
}

static void join_runs(run *r, const run *next)
{
    memcpy(r->corner + 2 * (r->edges + 1), next->corner + 2, 2 * next->edges * sizeof *r->corner);
    r->edges += next->edges;
    r->last = next->last;
    r->exact = r->exact && next->exact;
}

/* Sets *line to the line through the ends of a run, without a rounding error. Returns false unless doubles hold it, and
 * every corner of the run is on it or beyond it, exactly. */
static bool find_exact_line(const walk *w, const run *r, sunder_i_half_plane *line)
{
    double at;
    bool exact = r->exact && sunder_i_exact_line(r->corner, r->corner + 2 * r->edges, w->parting->clearance, line);
    for (size_t k = 1; k < r->edges && exact; k++)
        exact = sunder_i_dot_exactly(line->n, r->corner + 2 * k, &at) && at >= line->base;
    return exact;
}

/* Adds the line of a run. Every corner of the run is beyond it, and so is everything at the gap's distance from it
 * along any normal of the run. These normals agree with the line's up to a share of the square of their turn. */
static void add_run(walk *w, const run *r)
{
    const double *p = r->corner, *q = r->corner + 2 * r->edges;
    const double length = hypot(q[0] - p[0], q[1] - p[1]);
    side s = r->first;
    sunder_i_half_plane line;
    if (find_exact_line(w, r, &line)) {
        add_line(w, &line);
        return;
    }
    if (r->edges > 1) {
        s.n[0] = (q[1] - p[1]) / length;
        s.n[1] = (p[0] - q[0]) / length;
        s.tilt = fabs(r->first.n[0] * r->last.n[1] - r->first.n[1] * r->last.n[0]) + r->first.tilt + r->last.tilt;
    }
    double base = INFINITY;
    for (size_t k = 0; k <= r->edges; k++) base = sunder_i_min(base, dot_product(s.n, r->corner + 2 * k));
    const bool outside = w->parting->clearance >= 0;
    add_half_plane(w, s.n, base, outside ? sunder_i_max(0, 1 - 2 * UNIT - s.tilt * s.tilt) : 1 + 2 * UNIT);
}

static void bisect_normals(const double n1[2], const double n2[2], double out[2])
{
    const bool acute = dot_product(n1, n2) > 0;
    out[0] = acute ? n1[0] + n2[0] : n2[1] - n1[1];
    out[1] = acute ? n1[1] + n2[1] : n1[0] - n2[0];
    const double length = sqrt(dot_product(out, out));
    out[0] /= length;
    out[1] /= length;
}

/* Adds 2^halvings lines round corner q, which cover equal parts of the turn from n1 to n2. */
static void add_arc(walk *w, const double q[2], const double n1[2], const double n2[2], double tilt, int halvings)
{
    double n[2];
    bisect_normals(n1, n2, n);
    if (halvings) {
        add_arc(w, q, n1, n, tilt, halvings - 1);
        add_arc(w, q, n, n2, tilt, halvings - 1);
        return;
    }
    const double c = sunder_i_min(dot_product(n, n1), dot_product(n, n2)) - 2 * UNIT - tilt;
    add_half_plane(w, n, dot_product(n, q), sunder_i_max(0, c));
}

static double cross_product(const double p[2], const double q[2]) { return p[0] * q[1] - p[1] * q[0]; }

/* Adds the number of lines that the turn from n1 to n2 takes; none if there is no turn. */
static void add_arcs(walk *w, const double q[2], const double n1[2], const double n2[2], double tilt)
{
    const double cosine = dot_product(n1, n2);
    if (cross_product(n1, n2) > 0 && cosine < STRAIGHT)
        add_arc(w, q, n1, n2, tilt, cosine > SLIGHT ? 0 : cosine > SQUARE ? 1 : 2);
}

/* Sets out to the direction n turned by `angle`, but no farther than to `end`. */
static void turn_to(const double n[2], double angle, const double end[2], double out[2])
{
    const double c = cos(angle), s = sin(angle), v[2] = {c * n[0] - s * n[1], s * n[0] + c * n[1]};
    const bool beyond = angle > 0 ? cross_product(v, end) <= 0 : cross_product(v, end) >= 0;
    const double length = sqrt(dot_product(v, v));
    out[0] = beyond ? end[0] : v[0] / length;
    out[1] = beyond ? end[1] : v[1] / length;
}

/* If the given place is nearer to corner q than the clearance, in a direction between the two edges' normals, adds
 * lines round q, one of which is made for the place: it covers a small angle around it, so that it passes between the
 * place and the arc. Returns false otherwise. */
static bool turn_at(walk *w, const double q[2], const side *from, const side *to)
{
    const double *at = w->parting->at, g = w->parting->clearance, tilt = from->tilt + to->tilt;
    if (!at) return false;
    const double v[2] = {at[0] - q[0], at[1] - q[1]}, r = sqrt(dot_product(v, v)), n[2] = {v[0] / r, v[1] / r};
    if (!(r > 0) || !(r < g) || !(cross_product(from->n, n) > 0) || !(cross_product(n, to->n) > 0)) return false;
    const double angle = sunder_i_min(WIDEST, sqrt((g - r) / g));
    double low[2], high[2];
    turn_to(n, -angle, from->n, low);
    turn_to(n, angle, to->n, high);
    add_arcs(w, q, from->n, low, tilt);
    add_arc(w, q, low, high, tilt, 0);
    add_arcs(w, q, high, to->n, tilt);
    return true;
}

static void turn_corner(walk *w, const double q[2], const side *from, const side *to)
{
    if (!(w->parting->clearance > 0) || cross_product(from->n, to->n) <= 0 || dot_product(from->n, to->n) >= STRAIGHT)
        return;
    if (!turn_at(w, q, from, to)) add_arcs(w, q, from->n, to->n, from->tilt + to->tilt);
}

/* Adds the next edge of K: it joins the last run, or begins a new one. The first run is kept until the end, since the
 * last run may join it. */
static void take_run(walk *w, run *first, run *last, const run *now)
{
    if (last->edges && can_join(w, last, now)) {
        join_runs(last, now);
        return;
    }
    if (last->edges) turn_corner(w, last->corner + 2 * last->edges, &last->last, &now->first);
    if (last->edges && first->edges)
        add_run(w, last);
    else if (last->edges)
        *first = *last;
    *last = *now;
}

static void end_runs(walk *w, const run *first, run *last)
{
    if (first->edges == 0) {
        add_run(w, last);
    } else if (can_join(w, last, first)) {
        join_runs(last, first);
        add_run(w, last);
    } else {
        turn_corner(w, first->corner, &last->last, &first->first);
        add_run(w, first);
        add_run(w, last);
    }
}

static void measure_sizes(walk *w)
{
    const sunder_i_parting *p = w->parting;
    w->size = p->vague;
    for (size_t c = 0; c < 2; c++) {
        double a = 0, b = 0, mean_a = 0, mean_b = 0;
        for (size_t k = 0; k < p->na; k++) a = sunder_i_max(a, fabs(p->a[2 * k + c])), mean_a += p->a[2 * k + c];
        for (size_t k = 0; k < p->nb; k++) b = sunder_i_max(b, fabs(p->b[2 * k + c])), mean_b += p->b[2 * k + c];
        w->size += a + b + fabs(p->offset[c]);
        w->inner[c] = mean_a / (double)p->na - mean_b / (double)p->nb - p->offset[c];
    }
    w->slack = UNIT * w->size;
}

/* Sets out to a corner of K. Returns whether it has no error. */
static bool corner_of_sum(const sunder_i_parting *p, size_t a, size_t b, double out[2])
{
    bool exact = p->exact;
    for (size_t c = 0; c < 2; c++) {
        double d;
        exact = sunder_i_subtract_exactly(p->a[2 * a + c], p->b[2 * b + c], &d) && exact;
        exact = sunder_i_subtract_exactly(d, p->offset[c], &out[c]) && exact;
    }
    return exact;
}

size_t sunder_i_half_planes_between(const sunder_i_parting *parting, sunder_i_half_plane *out)
{
    walk w = {.parting = parting, .half_plane = out, .holds = true};
    measure_sizes(&w);
    /* From the lowest corner of A less the highest of B, the directions of both sequences of edges increase from 0 to 2
     * pi. */
    const size_t a0 = sunder_i_extreme_corner(parting->a, parting->na, 1),
                 b0 = sunder_i_extreme_corner(parting->b, parting->nb, -1);
    sunder_i_merge m = sunder_i_merge_of((uint32_t)parting->na, (uint32_t)parting->nb);
    run first = {.edges = 0}, last = first;
    double from[2], to[2];
    bool from_exact = corner_of_sum(parting, a0, b0, from), to_exact;
    for (;; from[0] = to[0], from[1] = to[1], from_exact = to_exact) {
        const size_t a = (a0 + m.next_a) % parting->na, a1 = (a + 1) % parting->na, b = (b0 + m.next_b) % parting->nb,
                     b1 = (b + 1) % parting->nb;
        const double u[2] = {parting->a[2 * a1] - parting->a[2 * a], parting->a[2 * a1 + 1] - parting->a[2 * a + 1]};
        const double v[2] = {parting->b[2 * b] - parting->b[2 * b1], parting->b[2 * b + 1] - parting->b[2 * b1 + 1]};
        if (!SUNDER_I_MERGE_NEXT(&m, sunder_i_turns_first(u, v) ? -1 : 1)) break;
        const double *e = m.of_a ? u : v, length = sqrt(dot_product(e, e));
        to_exact = corner_of_sum(parting, (a0 + m.next_a) % parting->na, (b0 + m.next_b) % parting->nb, to);
        if (!(length > 0)) continue;
        run now;
        begin_run(&now, from, to, &(side){{e[1] / length, -e[0] / length}, w.slack / length});
        now.exact = from_exact && to_exact;
        take_run(&w, &first, &last, &now);
    }
    if (last.edges) end_runs(&w, &first, &last);
    return w.holds ? w.n : 0;
}
