#include "hamlet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Features and barriers ---- */

static void add_box(house *h, double x, double y, double w, double d)
{
    const double xy[8] = {x, y, x + w, y, x + w, y + d, x, y + d};
    house_part *p = &h->part[h->parts++];
    memcpy(p->xy, xy, sizeof xy);
    p->corners = 4;
}

static void set_outline(house *h, const double *xy, size_t outer, size_t inner)
{
    memcpy(h->xy, xy, 2 * (outer + inner) * sizeof *xy);
    h->ring_end[0] = outer;
    h->ring_end[1] = outer + inner;
    h->rings = inner ? 2 : 1;
}

/* In units of the grid: a box, a triangle, a slanted quadrangle, an L, a U, a frame around a courtyard. Parts overlap:
 * their interiors have to cover the feature's interior, so that a line cannot lie between two of them. */
static void build(rng *r, house *h, double x, double y, double unit)
{
    const double w = unit * (double)rng_int(r, 3, 8), d = unit * (double)rng_int(r, 3, 8), a = unit, b = unit;
    *h = (house){.weight = 1, .limit = INFINITY, .block = -1};
    const double lean = unit * (double)rng_int(r, 0, 2);
    const double triangle[] = {x, y, x + w, y + lean, x + lean, y + d};
    const double slanted[] = {x, y, x + w, y + lean, x + w + lean, y + lean + d, x + lean, y + d};
    const double box[] = {x, y, x + w, y, x + w, y + d, x, y + d};
    const double l[] = {x, y, x + w, y, x + w, y + b, x + a, y + b, x + a, y + d, x, y + d};
    const double u[] = {x,         y,     x + w, y,     x + w, y + d, x + w - a, y + d,
                        x + w - a, y + b, x + a, y + b, x + a, y + d, x,         y + d};
    const double frame[] = {x,     y,     x + w, y,         x + w,     y + d,     x,         y + d,
                            x + a, y + b, x + a, y + d - b, x + w - a, y + d - b, x + w - a, y + b};
    switch (rng_int(r, 0, 6)) {
    case 0:
        set_outline(h, triangle, 3, 0);
        h->part[h->parts].corners = 3;
        memcpy(h->part[h->parts++].xy, triangle, sizeof triangle);
        break;
    case 1:
        set_outline(h, slanted, 4, 0);
        h->part[h->parts].corners = 4;
        memcpy(h->part[h->parts++].xy, slanted, sizeof slanted);
        break;
    case 2:
        set_outline(h, l, 6, 0);
        add_box(h, x, y, w, b);
        add_box(h, x, y, a, d);
        break;
    case 3:
        set_outline(h, u, 8, 0);
        add_box(h, x, y, w, b);
        add_box(h, x, y, a, d);
        add_box(h, x + w - a, y, a, d);
        break;
    case 4:
        set_outline(h, frame, 4, 4);
        add_box(h, x, y, w, b);
        add_box(h, x, y + d - b, w, b);
        add_box(h, x, y, a, d);
        add_box(h, x + w - a, y, a, d);
        break;
    default: set_outline(h, box, 4, 0); add_box(h, x, y, w, d);
    }
}

static void found_barrier(rng *r, hamlet_barrier *b, double x, double y, double unit)
{
    const size_t points[] = {1, 2, 3, 4};
    *b = (hamlet_barrier){.points = points[rng_int(r, 0, 3)], .gap = -1};
    b->area = b->points == 4;
    const double left = x + unit * (double)rng_int(r, -2, 12), low = y + unit * (double)rng_int(r, -2, 12);
    const double w = unit * (double)rng_int(r, 1, 4), d = unit * (double)rng_int(r, 1, 4);
    const double box[] = {left, low, left + w, low, left + w, low + d, left, low + d};
    for (size_t k = 0; k < b->points; k++) {
        b->xy[2 * k] = b->area ? box[2 * k] : x + unit * (double)rng_int(r, -2, 14);
        b->xy[2 * k + 1] = b->area ? box[2 * k + 1] : y + unit * (double)rng_int(r, -2, 14);
    }
    if (rng_once_in(r, 2)) b->width = unit * 0.25 * (double)rng_int(r, 1, 6);
    if (rng_once_in(r, 2)) b->gap = unit * 0.25 * (double)rng_int(r, 0, 4);
}

/* A convex part: a polygon, or a segment of a line, or a point. */
static size_t barrier_parts(const hamlet_barrier *b) { return b->area || b->points == 1 ? 1 : b->points - 1; }
static size_t part_corners(const hamlet_barrier *b) { return b->area || b->points == 1 ? b->points : 2; }

/* Is there an edge of the first part such that the second is strictly beyond its line? A segment has two edges. */
static bool edge_parts(const double *p, size_t np, const double *q, size_t nq)
{
    for (size_t k = 0; k < np; k++) {
        const double *a = p + 2 * k, *b = p + 2 * ((k + 1) % np);
        bool beyond = np > 1;
        for (size_t i = 0; i < nq; i++)
            beyond = beyond && (b[0] - a[0]) * (q[2 * i + 1] - a[1]) - (b[1] - a[1]) * (q[2 * i] - a[0]) < 0;
        if (beyond) return true;
    }
    return false;
}

/* Does it meet a feature? Then the position of the side anchor is unknown. A segment that is collinear with another
 * counts as meeting it. */
static bool may_cut(const hamlet *t, const hamlet_barrier *b)
{
    for (size_t k = 0; k < t->n; k++)
        for (size_t i = 0; i < t->house[k].parts; i++)
            for (size_t j = 0; j < barrier_parts(b); j++) {
                const house_part *h = &t->house[k].part[i];
                const double *q = b->xy + 2 * j;
                if (!edge_parts(h->xy, h->corners, q, part_corners(b)) &&
                    !edge_parts(q, part_corners(b), h->xy, h->corners))
                    return true;
            }
    return false;
}

/* Moves on a grid, and any others; some features prefer to stay, or to go along with the one before. */
static void choose_preferred(rng *r, hamlet *t, double unit)
{
    t->preferred = true;
    for (size_t k = 0; k < t->n; k++) {
        house *h = &t->house[k];
        const int64_t kind = rng_int(r, 0, 5);
        if (kind == 0) continue;
        for (int c = 0; c < 2; c++) {
            const double far = kind == 1 ? 0.3 : 1, steps = (double)rng_int(r, -24, 24);
            h->preferred[c] = kind == 2 && k ? t->house[k - 1].preferred[c] : unit * far * steps / 4;
        }
    }
}

/* Gaps on a grid. Some are equal, and some are 0. */
static void choose_classes(rng *r, hamlet *t, double unit)
{
    t->classes = true;
    if (t->gap == 0) t->gap = unit;
    for (size_t i = 0; i < HAMLET_CLASSES; i++)
        for (size_t j = 0; j <= i; j++)
            t->class_gap[HAMLET_CLASSES * i + j] = t->class_gap[HAMLET_CLASSES * j + i] =
                t->gap * (double)rng_int(r, 0, 4) / 4;
    for (size_t k = 0; k < t->n; k++) t->house[k].of = (uint32_t)rng_int(r, 0, HAMLET_CLASSES - 1);
    for (size_t k = 0; k < t->barriers; k++) t->barrier[k].of = (uint32_t)rng_int(r, 0, HAMLET_CLASSES - 1);
}

static double gap_of(const hamlet *t, uint32_t a, uint32_t b)
{
    return t->classes ? t->class_gap[HAMLET_CLASSES * a + b] : t->gap;
}

static void found_barriers(rng *r, hamlet *t, double x, double y, double unit, int kinds)
{
    t->barriers = (size_t)rng_int(r, 1, HAMLET_BARRIERS);
    for (size_t k = 0; k < t->barriers; k++) {
        hamlet_barrier *b = &t->barrier[k];
        found_barrier(r, b, x, y, unit);
        b->side = kinds & HAMLET_SIDES && !may_cut(t, b);
    }
}

void hamlet_found(rng *r, hamlet *t, size_t n, int kinds)
{
    const double unit = rng_once_in(r, 2) ? 1 : 0.125 * (double)rng_int(r, 1, 12);
    const double x = rng_once_in(r, 3) ? 400000 : 0, y = x * 13;
    const bool weights = rng_once_in(r, 3), limits = rng_once_in(r, 3), fixed = rng_once_in(r, 4);
    *t = (hamlet){.n = n, .jumps = !(kinds & HAMLET_NO_JUMPS)};
    t->gap = rng_once_in(r, 2) ? 0 : unit * 0.25 * (double)rng_int(r, 1, 8);
    for (size_t k = 0; k < n; k++) {
        house *h = &t->house[k];
        const double up = unit * (double)rng_int(r, 0, 9), right = unit * (double)rng_int(r, 0, 9);
        build(r, h, x + right, y + up, unit);
        if (weights) h->weight = (double)rng_int(r, 1, 32) / 8;
        if (limits && rng_once_in(r, 2)) h->limit = unit * (double)rng_int(r, 0, 24) / 4;
        h->fixed = fixed && rng_once_in(r, 3);
    }
    if (n > 2 && rng_once_in(r, 4)) t->house[0].block = t->house[n - 1].block = 7;
    if (kinds & HAMLET_PREFERRED) choose_preferred(r, t, unit);
    if (kinds & (HAMLET_BARRIERS_TOO | HAMLET_SIDES)) found_barriers(r, t, x, y, unit, kinds);
    if (kinds & HAMLET_CLASSED) choose_classes(r, t, unit);
    for (size_t k = 0; k < n && kinds & HAMLET_SYMBOLS; k++) t->house[k].may_jump = rng_once_in(r, 2);
}

/* ---- Conversion to layers ---- */

static sunder_shape *shape_of(const double *xy, const size_t *ring_end, size_t rings)
{
    sunder_shape *shape = NULL;
    sunder_error err;
    if (sunder_shape_from_rings(xy, ring_end, &rings, 1, SUNDER_VALIDITY_STRICT, &shape, &err)) {
        fprintf(stderr, "hamlet: %s\n", err.message);
        abort();
    }
    return shape;
}

static sunder_status set_gaps(const hamlet *t, sunder_layer *layer, sunder_error *err)
{
    uint32_t of[HAMLET_HOUSES], of_barrier[HAMLET_BARRIERS];
    for (size_t k = 0; k < t->n; k++) of[k] = t->house[k].of;
    for (size_t k = 0; k < t->barriers; k++) of_barrier[k] = t->barrier[k].of;
    const sunder_gaps gaps = {.classes = HAMLET_CLASSES, .gap = t->class_gap, .feature = of, .barrier = of_barrier};
    return sunder_layer_set_gaps(layer, t->classes ? &gaps : NULL, err);
}

sunder_report *hamlet_separate(const hamlet *t, double effort)
{
    sunder_shape *shape[HAMLET_HOUSES + HAMLET_BARRIERS] = {NULL};
    sunder_feature feature[HAMLET_HOUSES];
    sunder_barrier barrier[HAMLET_BARRIERS];
    double preferred[2 * HAMLET_HOUSES];
    sunder_layer_options options;
    sunder_layer *layer = NULL;
    sunder_report *report = NULL;
    sunder_error err;
    sunder_layer_options_init(&options);
    options.gap = t->gap;
    options.touch_tolerance = 0;
    options.no_blocks = true;
    options.contained = SUNDER_CONTAINMENT_SEPARATE;
    options.allow_jumps = t->jumps;
    options.effort = effort;
    for (size_t k = 0; k < t->n; k++) {
        const house *h = &t->house[k];
        memcpy(preferred + 2 * k, h->preferred, sizeof h->preferred);
        shape[k] = shape_of(h->xy, h->ring_end, h->rings);
        feature[k] = (sunder_feature){
            .shape = shape[k], .weight = h->weight, .max_shift = h->limit, .block = h->block, .fixed = h->fixed};
        feature[k].may_jump = h->may_jump;
    }
    for (size_t k = 0; k < t->barriers; k++) {
        const hamlet_barrier *b = &t->barrier[k];
        if (b->area) shape[t->n + k] = shape_of(b->xy, &b->points, 1);
        barrier[k] = (sunder_barrier){.geometry = {.shape = shape[t->n + k]}, .width = b->width, .gap = b->gap};
        barrier[k].side = b->side;
        if (b->area) continue;
        barrier[k].geometry.xy = b->xy;
        barrier[k].geometry.line_end = &b->points;
        barrier[k].geometry.lines = 1;
    }
    if (sunder_layer_new(feature, t->n, &layer, &err) || sunder_layer_set_barriers(layer, barrier, t->barriers, &err) ||
        sunder_layer_set_preferred(layer, t->preferred ? preferred : NULL, &err) || set_gaps(t, layer, &err) ||
        sunder_layer_separate(layer, &options, &report, &err)) {
        fprintf(stderr, "hamlet: %s\n", err.message);
        abort();
    }
    sunder_layer_free(layer);
    for (size_t k = 0; k < t->n + t->barriers; k++) sunder_shape_free(shape[k]);
    return report;
}

/* ---- Conversion to problems ---- */

typedef struct posing {
    const hamlet *t;
    optimum_problem *m;
    size_t body_of[HAMLET_HOUSES];
    size_t barriers; /* the body that contains all barriers */
    double anchor[HAMLET_HOUSES][2];
} posing;

/* Features of one block are one body. Anchors are those of the library, rounded to doubles. */
static void start(posing *p, const hamlet *t, optimum_problem *m)
{
    *p = (posing){.t = t, .m = m};
    *m = (optimum_problem){.bodies = 0};
    for (size_t k = 0; k < t->n; k++) {
        const house *h = &t->house[k];
        p->body_of[k] = m->bodies;
        for (size_t j = 0; j < k; j++)
            if (h->block >= 0 && t->house[j].block == h->block) p->body_of[k] = p->body_of[j];
        if (p->body_of[k] == m->bodies) m->body[m->bodies++] = (optimum_body){0, INFINITY};
        optimum_body *body = &m->body[p->body_of[k]];
        body->weight += h->weight;
        body->limit = h->fixed ? 0 : fmin(body->limit, h->limit);
        sunder_shape *shape = shape_of(h->xy, h->ring_end, h->rings);
        sunder_shape_anchor(shape, p->anchor[k]);
        sunder_shape_free(shape);
    }
    for (size_t k = 0; k < t->n; k++) {
        const optimum_body *body = &m->body[p->body_of[k]];
        for (size_t c = 0; c < 2 && body->limit > 0; c++)
            m->preferred[2 * p->body_of[k] + c] += t->house[k].weight / body->weight * t->house[k].preferred[c];
    }
    p->barriers = m->bodies;
    m->body[m->bodies++] = (optimum_body){1, 0};
}

/* Is all of q on the outer side of an edge of p, or on it? p is counter-clockwise; a segment has two outer sides. */
static bool is_beside(const double *p, size_t n, const double *q, size_t m)
{
    for (size_t k = 0; k < n && n > 1; k++) {
        const double *a = p + 2 * k, *b = p + 2 * ((k + 1) % n);
        bool beside = a[0] != b[0] || a[1] != b[1];
        for (size_t l = 0; l < m; l++)
            beside = beside && (b[0] - a[0]) * (q[2 * l + 1] - a[1]) - (b[1] - a[1]) * (q[2 * l] - a[0]) <= 0;
        if (beside) return true;
    }
    return false;
}

/* The least distance of a corner of p from a side of q. */
static double corners_distance(const double *p, size_t n, const double *q, size_t m)
{
    double least = INFINITY;
    for (size_t k = 0; k < n; k++)
        for (size_t l = 0; l < m; l++) {
            const double *a = q + 2 * l, *b = q + 2 * ((l + 1) % m);
            const double dx = b[0] - a[0], dy = b[1] - a[1], wx = p[2 * k] - a[0], wy = p[2 * k + 1] - a[1];
            const double square = dx * dx + dy * dy, s = square > 0 ? (wx * dx + wy * dy) / square : 0;
            const double at = fmin(1, fmax(0, s));
            least = fmin(least, hypot(wx - at * dx, wy - at * dy));
        }
    return least;
}

/* A lower bound, exact up to rounding, of the distance of two convex parts; negative if the interior of one meets the
 * other. */
static double part_distance(const double *p, size_t n, const double *q, size_t m)
{
    if (!is_beside(p, n, q, m) && !is_beside(q, m, p, n)) return -1;
    return fmin(corners_distance(p, n, q, m), corners_distance(q, m, p, n)) * (1 - 1e-12);
}

/* Convex parts of a house, or of a barrier. */
typedef struct part_list {
    const double *xy[HOUSE_PARTS];
    size_t corners[HOUSE_PARTS], n;
} part_list;

static part_list parts_of_house(const house *h)
{
    part_list list = {.n = h->parts};
    for (size_t k = 0; k < h->parts; k++) {
        list.xy[k] = h->part[k].xy;
        list.corners[k] = h->part[k].corners;
    }
    return list;
}

static part_list parts_of_barrier(const hamlet_barrier *b)
{
    part_list list = {.n = barrier_parts(b)};
    for (size_t k = 0; k < list.n; k++) {
        list.xy[k] = b->xy + 2 * k;
        list.corners[k] = part_corners(b);
    }
    return list;
}

/* The part of the convex polygon on one side of the line from a to b; returns its number of corners. */
static size_t clip(const double *xy, size_t n, const double *a, const double *b, double sign, double *out)
{
    size_t kept = 0;
    for (size_t k = 0; k < n; k++) {
        const double *p = xy + 2 * k, *q = xy + 2 * ((k + 1) % n);
        const double s = sign * ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]));
        const double t = sign * ((b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]));
        if (s >= 0) memcpy(out + 2 * kept++, p, 2 * sizeof *p);
        if ((s >= 0) == (t >= 0)) continue;
        for (size_t c = 0; c < 2; c++) out[2 * kept + c] = p[c] + s / (s - t) * (q[c] - p[c]);
        kept++;
    }
    return kept;
}

enum { CLIPPED = 32 };

/* The area of the part of a convex polygon that is in none of the parts from the k-th on. It is divided: beyond the
 * first side of part k, or before that and beyond the second, and so on. */
static double area_outside(const double *xy, size_t n, const part_list *of, size_t k)
{
    double area = 0, rest[2 * CLIPPED], before[2 * CLIPPED];
    if (k == of->n) {
        for (size_t c = 2; c < n; c++)
            area += (xy[2 * c - 2] - xy[0]) * (xy[2 * c + 1] - xy[1]) - (xy[2 * c - 1] - xy[1]) * (xy[2 * c] - xy[0]);
        return area / 2;
    }
    if (of->corners[k] < 3) return area_outside(xy, n, of, k + 1);
    if (n + HOUSE_CORNERS > CLIPPED) abort();
    memcpy(before, xy, 2 * n * sizeof *xy);
    for (size_t c = 0; c < of->corners[k] && n > 2; c++) {
        const double *a = of->xy[k] + 2 * c, *b = of->xy[k] + 2 * ((c + 1) % of->corners[k]);
        const size_t m = clip(before, n, a, b, -1, rest);
        if (m > 2) area += area_outside(rest, m, of, k + 1);
        n = clip(before, n, a, b, 1, rest);
        memcpy(before, rest, 2 * n * sizeof *rest);
    }
    return area;
}

/* Is p a subset of q? Everything is on a grid, so any area outside q is larger than rounding. */
static bool lies_in(const part_list *p, const part_list *q)
{
    double area = 0, size = 0;
    for (size_t k = 0; k < p->n; k++) {
        if (p->corners[k] < 3) return false;
        area += area_outside(p->xy[k], p->corners[k], q, 0);
        for (size_t c = 0; c < p->corners[k]; c++) size = fmax(size, fabs(p->xy[k][2 * c] - p->xy[0][0]));
    }
    return area < 1e-7 * size * size;
}

static void keep_parts_apart(optimum_problem *m, size_t a, size_t b, const part_list *p, const part_list *q,
                             double radius)
{
    for (size_t i = 0; i < p->n; i++)
        for (size_t j = 0; j < q->n; j++)
            optimum_keep_apart(m, a, b, p->xy[i], p->corners[i], q->xy[j], q->corners[j], radius);
}

/* An upper bound, exact up to rounding, of the length of the least translation that separates them. */
static double depth_of(const part_list *p, const part_list *q)
{
    optimum_problem m = {.bodies = 2, .body = {{1, INFINITY}, {1, 0}}};
    keep_parts_apart(&m, 0, 1, p, q, 0);
    const optimum_answer answer = optimum_find(&m, 1e12, 1e-11, 100000);
    optimum_free(&m);
    if (answer.open) abort();
    return sqrt(answer.high) * (1 + 1e-11) + 1e-9;
}

static bool says_parted(const sunder_conflict *c)
{
    return c->kind == SUNDER_CONFLICT_TOO_CLOSE || c->kind == SUNDER_CONFLICT_BARRIER_DRAWN ||
           c->kind == SUNDER_CONFLICT_BARRIER_NEAR;
}

/* A listed pair, which need not keep the required distance. Its requirement is that of a bound, or, if not `kept`, that
 * of a verdict: there is none if the two overlapped. */
static void keep_listed_apart(posing *p, size_t a, size_t b, const part_list *g, const part_list *h, double owed,
                              const sunder_conflict *listed, bool kept)
{
    double radius = owed;
    for (size_t i = 0; i < g->n; i++)
        for (size_t j = 0; j < h->n; j++)
            radius = fmin(radius, part_distance(g->xy[i], g->corners[i], h->xy[j], h->corners[j]));
    if (radius < 0) {
        if (!kept) return;
        radius = 0;
        if (!says_parted(listed) && (lies_in(g, h) || (b != p->barriers && lies_in(h, g)))) return;
        if (!says_parted(listed)) radius = -depth_of(g, h);
    }
    keep_parts_apart(p->m, a, b, g, h, radius);
}

/* listed: the conflict of the pair, or NULL if it is not listed. */
static void keep_houses_apart(posing *p, size_t a, size_t b, const sunder_conflict *listed, bool kept)
{
    const part_list g = parts_of_house(&p->t->house[a]), h = parts_of_house(&p->t->house[b]);
    const double gap = gap_of(p->t, p->t->house[a].of, p->t->house[b].of);
    if (listed)
        keep_listed_apart(p, p->body_of[a], p->body_of[b], &g, &h, gap, listed, kept);
    else
        keep_parts_apart(p->m, p->body_of[a], p->body_of[b], &g, &h, gap);
}

static void keep_off_barrier(posing *p, size_t a, size_t k, const sunder_conflict *listed, bool kept)
{
    const hamlet_barrier *b = &p->t->barrier[k];
    const part_list g = parts_of_house(&p->t->house[a]), h = parts_of_barrier(b);
    const double owed = b->width / 2 + (b->gap < 0 ? gap_of(p->t, p->t->house[a].of, b->of) : b->gap);
    if (listed)
        keep_listed_apart(p, p->body_of[a], p->barriers, &g, &h, owed, listed, kept);
    else
        keep_parts_apart(p->m, p->body_of[a], p->barriers, &g, &h, owed);
}

static bool in_convex(const double *xy, size_t n, const double at[2])
{
    for (size_t k = 0; k < n; k++) {
        const double *p = xy + 2 * k, *q = xy + 2 * ((k + 1) % n);
        if ((q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]) < 0) return false;
    }
    return true;
}

/* Neither feature jumps over the other. */
static void keep_from_jumps(posing *p, size_t a, size_t b)
{
    for (int turn = 0; turn < 2; turn++) {
        const size_t jumper = turn ? b : a, over = turn ? a : b;
        const house *h = &p->t->house[over];
        bool holds = h->may_jump || p->t->house[jumper].may_jump;
        for (size_t i = 0; i < h->parts; i++)
            holds = holds || in_convex(h->part[i].xy, h->part[i].corners, p->anchor[jumper]);
        for (size_t i = 0; i < h->parts && !holds; i++)
            optimum_keep_off(p->m, p->body_of[over], p->body_of[jumper], h->part[i].xy, h->part[i].corners,
                             p->anchor[jumper]);
    }
}

/* Barriers with sides meet no feature, so the side anchor is the plain anchor, and a path leaves a convex polygon only
 * once, which is allowed. */
static void keep_side(posing *p, size_t a, size_t k)
{
    const hamlet_barrier *b = &p->t->barrier[k];
    if (!b->side || (b->area && in_convex(b->xy, b->points, p->anchor[a]))) return;
    for (size_t j = 0; j < barrier_parts(b); j++)
        optimum_keep_off(p->m, p->barriers, p->body_of[a], b->xy + 2 * j, part_corners(b), p->anchor[a]);
}

static const sunder_conflict *find_listed(const sunder_conflict *listed, size_t n, const sunder_conflict *besides,
                                          size_t a, size_t b)
{
    for (size_t k = 0; k < n; k++)
        if (listed[k].a == a && listed[k].b == b) return &listed[k] != besides ? &listed[k] : NULL;
    return NULL;
}

void hamlet_pose(const hamlet *t, const sunder_conflict *listed, size_t n, const sunder_conflict *besides,
                 optimum_problem *m)
{
    posing p;
    start(&p, t, m);
    for (size_t b = 0; b < t->n; b++) {
        for (size_t a = 0; a < b; a++) {
            if (p.body_of[a] == p.body_of[b]) continue;
            keep_houses_apart(&p, a, b, find_listed(listed, n, besides, a, b), !besides);
            if (!t->jumps) keep_from_jumps(&p, a, b);
        }
        for (size_t k = 0; k < t->barriers; k++) {
            keep_off_barrier(&p, b, k, find_listed(listed, n, besides, b, t->n + k), !besides);
            keep_side(&p, b, k);
        }
    }
}

void hamlet_pose_pair(const hamlet *t, const sunder_conflict *pair, int rules, optimum_problem *m)
{
    posing p;
    start(&p, t, m);
    if (pair->b < t->n)
        keep_houses_apart(&p, pair->a, pair->b, NULL, false);
    else
        keep_off_barrier(&p, pair->a, pair->b - t->n, NULL, false);
    const size_t of_a = p.body_of[pair->a], of_b = pair->b < t->n ? p.body_of[pair->b] : SIZE_MAX;
    for (size_t x = 0; x < t->n; x++) {
        const bool with_a = p.body_of[x] == of_a, with_b = p.body_of[x] == of_b;
        for (size_t k = 0; k < t->barriers && rules & HAMLET_KEEP_SIDES; k++)
            if (with_a || with_b) keep_side(&p, x, k);
        for (size_t y = 0; y < x && rules & HAMLET_KEEP_FROM_JUMPS; y++)
            if ((with_a && p.body_of[y] == of_b) || (with_b && p.body_of[y] == of_a)) keep_from_jumps(&p, y, x);
    }
}
