/* The convex hull of the part of a region outside a forbidden set: it shows where a cut may go.
 *
 * Arcs of the pieces bulge into the free side, so the extreme points of that hull are among finitely many: corners of
 * the region outside the pieces, places where its sides enter or leave pieces, and reflex corners, where the boundaries
 * of two pieces cross outside of all others. All of this is in doubles, and pieces are taken slightly smaller than they
 * are. The result only proposes a cut, which is made if covered_region.c proves it. */
#include "displacement/prove/optimum/region.h"
#include "displacement/prove/optimum/tuning.h"

#include "base/extremes.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

/* ---- Reflex corners ---------------------------------------------------------------------------------------------- */

static bool is_free(const sunder_i_forbidden *f, const double u[2], size_t *guess, uint64_t *steps)
{
    *steps += 1 + (sunder_i_forbidden_is_many(f) ? sunder_i_forbidden_look(f) : f->pieces / 4);
    return !sunder_i_forbidden_is_deeper(f, u, FREE_HAIR * f->size, guess);
}

/* Appends the place (x, y) to *out if it is in no piece. Returns false if memory is out or stopped on request. */
static bool note_corner(sunder_i_reflex *out, const sunder_i_forbidden *f, double x, double y, uint64_t *steps)
{
    const double u[2] = {x, y};
    /* The steps allow for thousands of tests between two checks for a stop, as for two outlines with long arcs. */
    if (!sunder_i_steps(1 + (f->pieces + f->edges) / 4)) return false;
    if (!is_free(f, u, &out->cover, steps)) return true;
    if (!sunder_i_reserve(&out->place, &out->capacity, out->n + 1, sizeof *out->place)) return false;
    out->place[out->n][0] = x;
    out->place[out->n++][1] = y;
    return true;
}

/* Finds where edges of p, moved out by its radius, cross the boundary of q. */
static bool cross_edges(sunder_i_reflex *out, const sunder_i_forbidden *f, const sunder_i_forbidden_piece *p,
                        const sunder_i_forbidden_piece *q, uint64_t *steps)
{
    for (uint32_t k = 0; k < p->edges; k++) {
        const sunder_i_obstacle_edge *e = &f->edge[p->edge + k];
        const double from[2] = {e->from[0] + p->radius * e->n[0], e->from[1] + p->radius * e->n[1]};
        const double dir[2] = {-e->n[1], e->n[0]}, to[2] = {from[0] + e->length * dir[0], from[1] + e->length * dir[1]};
        double box[4], span[2];
        sunder_i_box_of_segment(from, to, box);
        *steps += 1;
        if (!sunder_i_box_meet(box, q->box)) continue;
        *steps += q->edges;
        if (!sunder_i_steps(1 + q->edges / 4)) return false;
        if (!sunder_i_forbidden_span(f, q, from, dir, span)) continue;
        for (int s = 0; s < 2; s++)
            if (span[s] >= 0 && span[s] <= e->length &&
                !note_corner(out, f, from[0] + span[s] * dir[0], from[1] + span[s] * dir[1], steps))
                return false;
    }
    return true;
}

/* Finds where the discs around corners of the two pieces cross. Crossings inside of either piece are not free, and are
 * dropped. */
static bool cross_arcs(sunder_i_reflex *out, const sunder_i_forbidden *f, const sunder_i_forbidden_piece *p,
                       const sunder_i_forbidden_piece *q, uint64_t *steps)
{
    const double r = p->radius, s = q->radius;
    if (!(r > 0) || !(s > 0)) return true;
    *steps += (uint64_t)p->edges * q->edges / 4;
    for (uint32_t k = 0; k < p->edges; k++) {
        if (!sunder_i_steps(1 + q->edges / 4)) return false;
        for (uint32_t l = 0; l < q->edges; l++) {
            const double *a = f->edge[p->edge + k].from, *b = f->edge[q->edge + l].from;
            const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
            if (!(square > 0) || square > (r + s) * (r + s)) continue;
            const double x = (square + r * r - s * s) / (2 * square), h = r * r / square - x * x;
            if (!(h >= 0)) continue;
            const double y = sqrt(h);
            if (!note_corner(out, f, a[0] + x * dx - y * dy, a[1] + x * dy + y * dx, steps) ||
                !note_corner(out, f, a[0] + x * dx + y * dy, a[1] + x * dy - y * dx, steps))
                return false;
        }
    }
    return true;
}

bool sunder_i_reflex_find(sunder_i_reflex *reflex, const sunder_i_forbidden *forbidden, uint64_t *steps)
{
    for (size_t k = 0; k < forbidden->pieces; k++)
        for (size_t l = k + 1; l < forbidden->pieces; l++) {
            const uint64_t before = *steps;
            const sunder_i_forbidden_piece *p = &forbidden->piece[k], *q = &forbidden->piece[l];
            *steps += 1;
            if (!sunder_i_box_meet(p->box, q->box)) continue;
            if (!cross_edges(reflex, forbidden, p, q, steps) || !cross_edges(reflex, forbidden, q, p, steps) ||
                !cross_arcs(reflex, forbidden, p, q, steps) || !sunder_i_steps(1 + (size_t)(*steps - before) / 64))
                return false;
        }
    return true;
}

/* Returns the distance from p along `dir` to the boundary of the region. */
static double distance_to_end(const sunder_i_region *r, const double p[2], const double dir[2])
{
    double far = INFINITY;
    for (uint32_t k = 0; k < r->n; k++) {
        const double *a = r->xy + 2 * k, *b = r->xy + 2 * (k + 1 < r->n ? k + 1 : 0);
        const double nx = b[1] - a[1], ny = a[0] - b[0], speed = nx * dir[0] + ny * dir[1];
        if (speed > 0) far = sunder_i_min(far, sunder_i_max(0, (nx * (a[0] - p[0]) + ny * (a[1] - p[1])) / speed));
    }
    return far < INFINITY ? far : 0;
}

/* Sets n to the normal of the piece that has p on its boundary. Returns false if there is none. */
static bool find_wall(const sunder_i_forbidden *f, const double p[2], double n[2], uint64_t *steps)
{
    double nearest = WALL_HAIR * f->size;
    const double at[4] = {p[0] - nearest, p[1] - nearest, p[0] + nearest, p[1] + nearest};
    bool any = false;
    sunder_i_forbidden_walk walk;
    sunder_i_forbidden_start(&walk, f);
    for (const sunder_i_forbidden_piece *piece; (piece = sunder_i_forbidden_next(&walk, f, at));) {
        double normal[2];
        *steps += piece->edges;
        const double off = fabs(sunder_i_forbidden_normal(f, piece, p, normal) - piece->radius);
        if (off >= nearest) continue;
        nearest = off;
        n[0] = normal[0];
        n[1] = normal[1];
        any = true;
    }
    *steps += walk.looks;
    return any;
}

bool sunder_i_reflex_seek(sunder_i_reflex *reflex, const sunder_i_forbidden *forbidden, const sunder_i_region *region,
                          const double from[2], const double down[2], uint64_t *steps)
{
    double p[2] = {from[0], from[1]}, dir[2] = {down[0], down[1]}, n[2];
    /* Go straight down to a wall, then along walls as long as they lead down. */
    for (int leg = 0; leg < MOST_LEGS; leg++) {
        const double far = sunder_i_forbidden_entry(forbidden, p, dir, distance_to_end(region, p, dir), steps);
        for (int c = 0; c < 2; c++) p[c] += far * dir[c];
        if (!find_wall(forbidden, p, n, steps)) break;
        const double along = -n[1] * down[0] + n[0] * down[1], side = along > 0 ? 1 : -1;
        if (!(fabs(along) > LEAST_SLOPE)) break;
        dir[0] = -side * n[1];
        dir[1] = side * n[0];
        /* A tiny distance off the wall; otherwise the ray would enter it at once. */
        for (int c = 0; c < 2; c++) p[c] += WALL_HAIR * forbidden->size * n[c];
    }
    return note_corner(reflex, forbidden, p[0], p[1], steps) && note_corner(reflex, forbidden, from[0], from[1], steps);
}

/* ---- The hull ---------------------------------------------------------------------------------------------------- */

typedef struct gathering {
    double (*at)[2];
    size_t n;
} gathering;

static void gather_place(gathering *g, double x, double y)
{
    if (g->n == MOST_EXTREME) return;
    g->at[g->n][0] = x;
    g->at[g->n++][1] = y;
}

/* Adds the places where side k of the region enters and leaves the union. */
static void gather_side(gathering *g, const sunder_i_region *r, uint32_t k, const sunder_i_forbidden *f,
                        uint64_t *steps)
{
    const double *p = r->xy + 2 * k, *q = r->xy + 2 * (k + 1 < r->n ? k + 1 : 0);
    double dir[2] = {q[0] - p[0], q[1] - p[1]}, box[4];
    const double length = sqrt(dir[0] * dir[0] + dir[1] * dir[1]);
    double span[MOST_SPANS][2];
    size_t spans = 0;
    if (!(length > 0)) return;
    dir[0] /= length;
    dir[1] /= length;
    sunder_i_box_of_segment(p, q, box);
    for (size_t m = 0; m < f->pieces; m++) {
        const sunder_i_forbidden_piece *piece = &f->piece[m];
        *steps += 1;
        if (!sunder_i_box_meet(box, piece->box)) continue;
        *steps += piece->edges;
        double in[2];
        if (!sunder_i_forbidden_span(f, piece, p, dir, in) || in[1] <= 0 || in[0] >= length) continue;
        if (spans == MOST_SPANS) {
            /* Too many pieces: the side counts as free. */
            gather_place(g, p[0], p[1]);
            gather_place(g, q[0], q[1]);
            return;
        }
        /* Spans are sorted by where they begin. */
        size_t at = spans++;
        for (; at > 0 && span[at - 1][0] > in[0]; at--) {
            span[at][0] = span[at - 1][0];
            span[at][1] = span[at - 1][1];
        }
        span[at][0] = in[0];
        span[at][1] = in[1];
    }
    const double hair = FREE_HAIR * f->size;
    double free_from = 0;
    for (size_t m = 0; m <= spans; m++) {
        const double begin = m < spans ? span[m][0] : length;
        if (begin >= free_from - (m < spans ? 0 : hair) && free_from <= length) {
            const double to = sunder_i_min(begin, length);
            gather_place(g, p[0] + free_from * dir[0], p[1] + free_from * dir[1]);
            gather_place(g, p[0] + to * dir[0], p[1] + to * dir[1]);
        }
        if (m < spans) free_from = sunder_i_max(free_from, span[m][1]);
    }
}

/* For many pieces: adds only the ends of the free part of side k. */
static void gather_ends(gathering *g, const sunder_i_region *r, uint32_t k, const sunder_i_forbidden *f,
                        uint64_t *steps)
{
    const double *p = r->xy + 2 * k, *q = r->xy + 2 * (k + 1 < r->n ? k + 1 : 0);
    double dir[2] = {q[0] - p[0], q[1] - p[1]};
    const double length = sqrt(dir[0] * dir[0] + dir[1] * dir[1]);
    if (!(length > 0)) return;
    for (int c = 0; c < 2; c++) dir[c] /= length;
    const double back[2] = {-dir[0], -dir[1]}, first = sunder_i_forbidden_exit(f, p, dir, INFINITY),
                 last = sunder_i_forbidden_exit(f, q, back, INFINITY);
    *steps += 2 * sunder_i_forbidden_look(f);
    if (first > length || last > length) return;
    gather_place(g, p[0] + first * dir[0], p[1] + first * dir[1]);
    gather_place(g, q[0] + last * back[0], q[1] + last * back[1]);
}

static bool holds_place(const sunder_i_region *r, const double u[2], double hair)
{
    for (uint32_t k = 0; k < r->n; k++) {
        const double *p = r->xy + 2 * k, *q = r->xy + 2 * (k + 1 < r->n ? k + 1 : 0);
        const double ex = q[0] - p[0], ey = q[1] - p[1];
        if ((u[0] - p[0]) * ey - (u[1] - p[1]) * ex > hair * (fabs(ex) + fabs(ey))) return false;
    }
    return true;
}

/* Sets out to the point of the segment ab nearest to 0, and returns its fraction along ab. */
static double nearest_of(const double a[2], const double b[2], double out[2])
{
    const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    double share = square > 0 ? -(a[0] * dx + a[1] * dy) / square : 0;
    share = sunder_i_min(1, sunder_i_max(0, share));
    out[0] = a[0] + share * dx;
    out[1] = a[1] + share * dy;
    return share;
}

static double square_of(double x, double y) { return x * x + y * y; }

/* Sets out to the point of the hull of g's points nearest to u. In each round the point that is farthest in the
 * direction towards u, as seen from the present nearest point, is added, and of the two segments that it makes with the
 * last one the nearer is kept. It ends when no point is nearer. */
static void nearest_of_hull(const gathering *g, const double u[2], double out[2])
{
    double a[2], b[2], at[2];
    size_t first = 0;
    for (size_t k = 1; k < g->n; k++)
        if (square_of(g->at[k][0] - u[0], g->at[k][1] - u[1]) <
            square_of(g->at[first][0] - u[0], g->at[first][1] - u[1]))
            first = k;
    for (int c = 0; c < 2; c++) a[c] = b[c] = at[c] = g->at[first][c] - u[c];
    for (size_t round = 0; round < g->n + 8; round++) {
        const double square = at[0] * at[0] + at[1] * at[1];
        double least = square * (1 - 1e-12), p[2] = {0, 0}, to_a[2], to_b[2];
        bool any = false;
        for (size_t k = 0; k < g->n; k++) {
            const double x = g->at[k][0] - u[0], y = g->at[k][1] - u[1], v = x * at[0] + y * at[1];
            if (v >= least) continue;
            least = v;
            p[0] = x;
            p[1] = y;
            any = true;
        }
        if (!any) break;
        /* u is inside the triangle, so the distance is 0. */
        const double s1 = a[0] * b[1] - a[1] * b[0], s2 = b[0] * p[1] - b[1] * p[0], s3 = p[0] * a[1] - p[1] * a[0];
        if ((s1 > 0 && s2 > 0 && s3 > 0) || (s1 < 0 && s2 < 0 && s3 < 0)) {
            at[0] = at[1] = 0;
            break;
        }
        nearest_of(a, p, to_a);
        nearest_of(b, p, to_b);
        const bool by_a = square_of(to_a[0], to_a[1]) <= square_of(to_b[0], to_b[1]);
        const double *nearer = by_a ? to_a : to_b;
        if (!(square_of(nearer[0], nearer[1]) < square)) break;
        for (int c = 0; c < 2; c++) {
            at[c] = nearer[c];
            if (!by_a) a[c] = b[c];
            b[c] = p[c];
        }
    }
    for (int c = 0; c < 2; c++) out[c] = u[c] + at[c];
}

/* Were the sides found for a region with the same corners? */
static bool is_known(const sunder_i_free_sides *s, const sunder_i_region *r)
{
    return s->any && s->region.n == r->n && memcmp(s->region.xy, r->xy, 2 * r->n * sizeof *r->xy) == 0;
}

/* Finds side k of the region among the sides whose free parts are known: a cut leaves most sides as they were. Both are
 * in cyclic order, so the search starts at `from`. Returns UINT32_MAX if it is not known. */
static uint32_t find_side(const sunder_i_free_sides *known, const sunder_i_region *r, uint32_t k, uint32_t from)
{
    const uint32_t n = known->any && known->n < MOST_EXTREME ? known->region.n : 0;
    const double *p = r->xy + 2 * k, *q = r->xy + 2 * (k + 1 < r->n ? k + 1 : 0), *xy = known->region.xy;
    for (uint32_t tried = 0, m = from < n ? from : 0; tried < n; tried++) {
        const uint32_t next = m + 1 < n ? m + 1 : 0;
        if (xy[2 * m] == p[0] && xy[2 * m + 1] == p[1] && xy[2 * next] == q[0] && xy[2 * next + 1] == q[1]) return m;
        m = next;
    }
    return UINT32_MAX;
}

static void gather_known(gathering *g, const sunder_i_free_sides *known, uint32_t side, uint64_t *steps)
{
    for (uint32_t m = known->first[side]; m < known->first[side + 1]; m++)
        gather_place(g, known->place[m][0], known->place[m][1]);
    *steps += known->steps[side];
}

bool sunder_i_free_sides_find(sunder_i_free_sides *sides, const sunder_i_free_sides *known,
                              const sunder_i_region *region, const sunder_i_forbidden *forbidden, uint64_t *steps)
{
    double at[MOST_EXTREME][2];
    uint32_t first[SUNDER_I_REGION_CORNERS + 1] = {0};
    uint64_t took[SUNDER_I_REGION_CORNERS] = {0};
    gathering g = {at, 0};
    if (is_known(sides, region)) return true;
    for (uint32_t k = 0, from = 0; k < region->n; k++) {
        const uint32_t side = find_side(known, region, k, from);
        if (side != UINT32_MAX) {
            gather_known(&g, known, side, &took[k]);
            from = side + 1;
        } else if (sunder_i_forbidden_is_many(forbidden)) {
            gather_ends(&g, region, k, forbidden, &took[k]);
        } else {
            gather_side(&g, region, k, forbidden, &took[k]);
        }
        *steps += took[k];
        first[k + 1] = (uint32_t)g.n;
    }
    if (!sunder_i_reserve(&sides->place, &sides->capacity, g.n, sizeof *sides->place)) return false;
    if (g.n) memcpy(sides->place, at, g.n * sizeof *at);
    sides->n = g.n;
    sides->region = *region;
    memcpy(sides->first, first, sizeof first);
    memcpy(sides->steps, took, sizeof took);
    sides->any = true;
    return true;
}

bool sunder_i_free_hull_nearest(const sunder_i_free_sides *sides, const sunder_i_forbidden *forbidden,
                                const sunder_i_reflex *reflex, const double u[2], double place[2], uint64_t *steps)
{
    double at[MOST_EXTREME][2];
    gathering g = {at, sides->n};
    if (sides->n) memcpy(at, sides->place, sides->n * sizeof *at);
    *steps += sides->n + reflex->n;
    for (size_t k = 0; k < reflex->n; k++)
        if (holds_place(&sides->region, reflex->place[k], FREE_HAIR * forbidden->size))
            gather_place(&g, reflex->place[k][0], reflex->place[k][1]);
    if (g.n == 0) return false;
    nearest_of_hull(&g, u, place);
    return true;
}
