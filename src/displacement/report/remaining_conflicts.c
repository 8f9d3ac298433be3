/* Lists the remaining conflicts: which pairs, of what kind, and how severe. (Why they remain is determined in
 * pair_reasons.c.) */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/report/report.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/watch.h"
#include "separation/separation.h"

#include <math.h>
#include <string.h>

/* ---- Which pairs, and of what kind ------------------------------------------------------------------------------- */

static bool is_inside(const sunder_i_model *model, const sunder_i_relation *r)
{
    return model->body_of[r->a] == model->body_of[r->b];
}

static sunder_conflict_kind kind_of(const sunder_i_model *model, const sunder_i_relation *r)
{
    if (sunder_i_is_barrier(model, r->b))
        return r->overlap ? SUNDER_CONFLICT_BARRIER
               : r->drawn ? SUNDER_CONFLICT_BARRIER_DRAWN
                          : SUNDER_CONFLICT_BARRIER_NEAR;
    if (!r->overlap) return SUNDER_CONFLICT_TOO_CLOSE;
    /* Members of a block that overlap by more than the tolerance count as overlaps, even if they are also duplicates or
     * contained. */
    if (is_inside(model, r)) return SUNDER_CONFLICT_OVERLAP;
    return r->duplicate   ? SUNDER_CONFLICT_DUPLICATE
           : r->contained ? SUNDER_CONFLICT_CONTAINED
                          : SUNDER_CONFLICT_OVERLAP;
}

/* Writes relation k to *out. If it is one of a feature and a part of a barrier, all relations of that feature to parts
 * of the same barrier are combined, with the first part of the barrier as the partner. Returns the index of the next
 * relation. */
static size_t take_pair(const sunder_i_model *model, const sunder_i_relations *relations, size_t k,
                        sunder_i_relation *out)
{
    *out = relations->pair[k++];
    if (!sunder_i_is_barrier(model, out->b)) return k;
    out->b = sunder_i_whole_of(model, out->b);
    for (; k < relations->n; k++) {
        const sunder_i_relation *r = &relations->pair[k];
        if (r->a != out->a || sunder_i_whole_of(model, r->b) != out->b) break;
        out->near = out->near || r->near;
        out->overlap = out->overlap || r->overlap;
        out->drawn = out->drawn || r->drawn;
    }
    return k;
}

/* Returns whether the relation is listed as a conflict. Inside a block only overlaps beyond the tolerance are, unless
 * the rules ask for all. */
static bool is_listed(const sunder_i_model *model, const sunder_i_relation *r)
{
    return sunder_i_is_conflict(r) && (!is_inside(model, r) || model->rules.list_inside || (r->overlap && !r->touch));
}

bool sunder_i_next_conflict(const sunder_i_model *model, const sunder_i_relations *relations, size_t *k, uint32_t *a,
                            uint32_t *b, sunder_conflict *conflict)
{
    sunder_i_relation r;
    *k = take_pair(model, relations, *k, &r);
    *a = r.a;
    *b = r.b;
    if (!sunder_i_is_conflict(&r)) return false;
    *conflict = (sunder_conflict){.kind = kind_of(model, &r), .inside_block = is_inside(model, &r)};
    return true;
}

void sunder_i_count_relations(const sunder_i_model *model, const sunder_i_relations *relations,
                              sunder_conflict_counts *counts)
{
    sunder_conflict c;
    uint32_t a, b;
    memset(counts, 0, sizeof *counts);
    for (size_t k = 0; k < relations->n;)
        if (sunder_i_next_conflict(model, relations, &k, &a, &b, &c)) sunder_i_count(counts, &c);
}

/* ---- How severe -------------------------------------------------------------------------------------------------- */

/* Makes a shape whose coordinates are those of the feature at its present position. */
static sunder_status placed_shape(const sunder_i_translate *stand, sunder_shape **out, sunder_error *err)
{
    bool exact;
    return sunder_shape_translate(stand->shape, stand->t[0], stand->t[1], out, &exact, err);
}

/* Clips the convex polygon p (n corners) to the left side of the line from a to b. The result, of at most n + 1
 * corners, is written to `out`. Returns its number of corners. */
static size_t clip_polygon(const double *p, size_t n, const double *a, const double *b, double *out)
{
    size_t m = 0;
    const double ex = b[0] - a[0], ey = b[1] - a[1];
    for (size_t k = 0; k < n; k++) {
        const double *u = p + 2 * k, *v = p + 2 * (k + 1 < n ? k + 1 : 0);
        const double su = ex * (u[1] - a[1]) - ey * (u[0] - a[0]), sv = ex * (v[1] - a[1]) - ey * (v[0] - a[0]);
        if (su >= 0) {
            out[2 * m] = u[0];
            out[2 * m++ + 1] = u[1];
        }
        if ((su > 0 && sv < 0) || (su < 0 && sv > 0)) {
            const double s = su / (su - sv);
            out[2 * m] = u[0] + s * (v[0] - u[0]);
            out[2 * m++ + 1] = u[1] + s * (v[1] - u[1]);
        }
    }
    return m;
}

/* Writes the corners of one convex piece, relative to `origin`, to `out`, and returns their number. */
static size_t corners_of(const sunder_shape *shape, uint32_t piece, const double origin[2], double *out)
{
    const uint32_t from = piece ? shape->piece_end[piece - 1] : 0;
    size_t n = 0;
    for (uint32_t k = from; k < shape->piece_end[piece]; k++, n++)
        for (uint32_t c = 0; c < 2; c++)
            out[2 * n + c] = shape->xy[2 * sunder_i_piece_vertices(shape)[k] + c] - origin[c];
    return n;
}

static size_t most_corners(const sunder_shape *shape)
{
    size_t most = 0;
    uint32_t from = 0;
    for (uint32_t p = 0; p < shape->pieces; from = shape->piece_end[p++])
        if (shape->piece_end[p] - from > most) most = shape->piece_end[p] - from;
    return most;
}

static double area_of(const double *p, size_t n)
{
    double area = 0;
    for (size_t k = 1; k + 1 < n; k++)
        area += (p[2 * k] - p[0]) * (p[2 * k + 3] - p[1]) - (p[2 * k + 1] - p[1]) * (p[2 * k + 2] - p[0]);
    return area / 2;
}

/* Sets `point` to a point inside the overlap of a and b from which a link can be drawn: the mean of the corners of the
 * largest common part of a piece of a and a piece of b. If no common part has an area, it is an anchor of b. */
static sunder_status inside_overlap(const sunder_shape *a, const sunder_shape *b, double point[2], sunder_error *err)
{
    const size_t na = most_corners(a), nb = most_corners(b), room = na + 2 * nb + 2;
    double *p = sunder_i_alloc(2 * room, sizeof *p), *q = sunder_i_alloc(2 * room, sizeof *q),
           *c = sunder_i_alloc(2 * nb, sizeof *c);
    double box[4], best = -1;
    sunder_shape_box(a, box);
    const double origin[2] = {box[0], box[1]};
    sunder_shape_anchor(b, point);
    if (!p || !q || !c) {
        sunder_i_free_all(p, q, c);
        return sunder_i_failure_cause(err);
    }
    for (uint32_t j = 0; j < b->pieces; j++) {
        const size_t sides = corners_of(b, j, origin, c);
        for (uint32_t i = 0; i < a->pieces && sunder_i_steps(4); i++) {
            size_t n = corners_of(a, i, origin, p);
            for (size_t k = 0; k < sides && n; k++) {
                n = clip_polygon(p, n, c + 2 * k, c + 2 * (k + 1 < sides ? k + 1 : 0), q);
                double *swap = p;
                p = q;
                q = swap;
            }
            const double area = n > 2 ? area_of(p, n) : 0;
            if (!(area > 0) || area <= best) continue;
            best = area;
            double x = 0, y = 0;
            for (size_t k = 0; k < n; k++) {
                x += p[2 * k];
                y += p[2 * k + 1];
            }
            point[0] = origin[0] + x / (double)n;
            point[1] = origin[1] + y / (double)n;
        }
    }
    sunder_i_free_all(p, q, c);
    return sunder_i_stopped() ? sunder_i_failure_cause(err) : SUNDER_OK;
}

static sunder_status measure_pair(const sunder_shape *a, const sunder_shape *b, bool overlap, sunder_conflict *c,
                                  sunder_error *err)
{
    if (!overlap) return sunder_pair_distance(a, b, &c->distance, c->from, c->to, err);
    sunder_separation least;
    bool beyond;
    const double none[2] = {0, 0};
    sunder_status status = sunder_i_separate(a, none, b, none, 0, INFINITY, &least, &beyond, err);
    if (status) return status;
    c->depth = least.distance;
    const double d[2] = {least.dx, least.dy};
    sunder_separation_clear(&least);
    status = inside_overlap(a, b, c->from, err);
    c->to[0] = c->from[0] + d[0];
    c->to[1] = c->from[1] + d[1];
    return status;
}

/* ---- The list ---------------------------------------------------------------------------------------------------- */

typedef struct describing {
    const sunder_i_model *model;
    const sunder_i_placement *placement;
    sunder_conflict *conflict;
    bool reasons; /* the reasons are wanted */
    const bool *overlap;
} describing;

/* Measures a feature and a barrier, at the feature's present and original positions. The link starts at the feature. If
 * the feature overlaps the barrier, the link shows the least translation as if the barrier moved, as for two
 * features. */
static sunder_status describe_barrier(const describing *d, sunder_conflict *c, sunder_error *err)
{
    const sunder_i_model *model = d->model;
    const sunder_i_translate at = sunder_i_standing(model, d->placement, (uint32_t)c->a);
    sunder_i_barrier_stance now, home;
    sunder_status status = sunder_i_barrier_stand(model, &at, (uint32_t)c->b, &now, err);
    if (status) return status;
    c->distance = c->before = now.distance;
    c->depth = now.least.distance;
    for (int k = 0; k < 2; k++) {
        c->from[k] = now.on[0][k];
        c->to[k] = now.on[1][k];
    }
    if (now.overlap) {
        sunder_shape_anchor(at.shape, c->from);
        const double t[2] = {now.least.dx, now.least.dy};
        for (int k = 0; k < 2; k++) {
            c->from[k] += at.t[k];
            c->to[k] = c->from[k] - t[k];
        }
    }
    if (!d->reasons) return SUNDER_OK;
    if (sunder_i_is_crossed(model, (uint32_t)c->a, (uint32_t)c->b)) c->reason = SUNDER_REASON_KEPT;
    const sunder_i_translate was = sunder_i_at_home(model, (uint32_t)c->a);
    status = sunder_i_barrier_stand(model, &was, (uint32_t)c->b, &home, err);
    c->before = home.distance;
    return status;
}

static sunder_status describe_conflicts(void *context, size_t begin, size_t end, sunder_error *err)
{
    const describing *d = context;
    const sunder_i_model *model = d->model;
    for (size_t k = begin; k < end; k++) {
        sunder_conflict *c = &d->conflict[k];
        if (sunder_i_is_barrier(model, (uint32_t)c->b)) {
            const sunder_status status = describe_barrier(d, c, err);
            if (status) return status;
            continue;
        }
        sunder_shape *a = NULL, *b = NULL;
        const sunder_i_translate at = sunder_i_standing(model, d->placement, (uint32_t)c->a),
                                 other = sunder_i_standing(model, d->placement, (uint32_t)c->b);
        sunder_status status = placed_shape(&at, &a, err);
        if (!status) status = placed_shape(&other, &b, err);
        if (!status) status = measure_pair(a, b, d->overlap && d->overlap[k], c, err);
        sunder_shape_free(a);
        sunder_shape_free(b);
        if (status) return status;
        c->before = c->distance;
        if (c->inside_block) {
            c->reason = SUNDER_REASON_SAME_BLOCK;
        } else if (d->reasons) {
            if (sunder_i_is_included(model, (uint32_t)c->a, (uint32_t)c->b)) c->reason = SUNDER_REASON_KEPT;
            double on_a[2], on_b[2];
            status = sunder_pair_distance(sunder_i_thing_shape(model, c->a), sunder_i_thing_shape(model, c->b),
                                          &c->before, on_a, on_b, err);
            if (status) return status;
        }
    }
    return SUNDER_OK;
}

/* Returns the missing distance plus the depth of the overlap. Returns NAN inside a block, and for a pair that may
 * overlap. */
static double missing_of(const sunder_conflict *c)
{
    if (c->inside_block || c->reason == SUNDER_REASON_KEPT) return NAN;
    return sunder_i_max(0, c->required - c->distance) + c->depth;
}

sunder_status sunder_i_report_measure(const sunder_i_model *model, const sunder_i_placement *placement,
                                      sunder_conflict *conflict, size_t n, const bool *overlap, bool reasons,
                                      sunder_error *err)
{
    describing d = {model, placement, conflict, reasons, overlap};
    const sunder_status status =
        sunder_i_parallel(model->rules.threads, n, SUNDER_I_GRAIN_PAIRS, describe_conflicts, &d, err);
    for (size_t k = 0; k < n && !status; k++) conflict[k].missing = missing_of(&conflict[k]);
    return status;
}

sunder_status sunder_i_report_conflicts(sunder_report *report, const sunder_i_model *model,
                                        const sunder_i_placement *placement, const sunder_i_relations *relations,
                                        bool reasons, sunder_error *err)
{
    size_t n = 0, k = 0;
    sunder_i_relation r;
    for (size_t i = 0; i < relations->n; n += is_listed(model, &r)) i = take_pair(model, relations, i, &r);
    report->conflict = sunder_i_calloc(n, sizeof *report->conflict);
    if (reasons) report->proof = sunder_i_calloc(n, sizeof *report->proof);
    bool *overlap = sunder_i_alloc(n, sizeof *overlap);
    if (!report->conflict || !overlap || (reasons && !report->proof)) {
        sunder_i_free(overlap);
        return sunder_i_failure_cause(err);
    }
    for (size_t i = 0; i < relations->n;) {
        i = take_pair(model, relations, i, &r);
        if (!is_listed(model, &r)) continue;
        overlap[k] = r.overlap;
        report->conflict[k].a = r.a;
        report->conflict[k].b = r.b;
        report->conflict[k].kind = kind_of(model, &r);
        report->conflict[k].required = sunder_i_owed_above(model, r.a, r.b);
        report->conflict[k].missing = report->conflict[k].need_shift = report->conflict[k].need_gap = NAN;
        report->conflict[k].need_gone = SIZE_MAX;
        report->conflict[k].need_gap_most = NAN;
        report->conflict[k].inside_block = is_inside(model, &r);
        report->summary.inside_overlaps += is_inside(model, &r) && r.overlap;
        k++;
    }
    report->conflicts = n;
    sunder_status status = sunder_i_report_measure(model, placement, report->conflict, n, overlap, reasons, err);
    sunder_i_free(overlap);
    return status || !reasons ? status : sunder_i_report_reasons(report, model, err);
}
