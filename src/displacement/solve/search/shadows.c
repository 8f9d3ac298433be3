/* The rule against jumps, the rule of sides and the rule of rows: shadows, which the search treats as further
 * obstacles.
 *
 * With a the anchor of a member of one body and B a piece of the other, at the start, the anchor passes B exactly when
 * the relative move lies in the shadow of the obstacle K = a + (-B), or B + (-a), from the origin (shadow.c). So a
 * shadow is made like an obstacle, with an anchor as a piece of one corner. The distance that it demands is the margin,
 * so that a rounded result stands clear of it; but never more than the start has. A feature that contains the anchor
 * casts no shadow from it. The same holds for a side anchor and the lines of a part of a barrier that it may not cross
 * (layer/sides.c).
 *
 * Most pairs never come near a shadow: relative moves are short, and K lies as far from the origin as the anchor does
 * from B. Boxes are tested first. */
#include "displacement/geometry/anchor_reach.h"
#include "displacement/layer/sides.h"
#include "displacement/solve/search/cluster_search.h"

#include "base/extremes.h"
#include "base/sort.h"
#include "base/watch.h"

#include <math.h>

/* ---- Of two bodies ----------------------------------------------------------------------------------------------- */

/* As sunder_i_shadow_may_reach(), for the boxes `p` and `other` of two bodies; swapped: `p` belongs to the second body
 * of the pair. */
static bool may_reach(const double p[4], const double other[4], const double offset[2], const double path[4],
                      bool swapped)
{
    return swapped ? sunder_i_shadow_may_reach(other, p, offset, path)
                   : sunder_i_shadow_may_reach(p, other, offset, path);
}

/* Visits the shadows that pieces of `other` cast from the anchors of `p`, for anchors with less clearance than `far`;
 * swapped: p is the second body of the pair. */
static void visit_from(sunder_i_search *s, const sunder_i_body *p, const sunder_i_body *other, const double path[4],
                       double far, sunder_i_piece_pair *pair, bool swapped, sunder_i_visit_piece_pair visit,
                       void *context)
{
    const sunder_i_model *model = s->model;
    const sunder_i_body_pieces *of = sunder_i_pieces_of(model, p), *pieces = sunder_i_pieces_of(model, other);
    if (!of || !pieces) {
        s->failed = true;
        return;
    }
    for (uint32_t m = 0; m < p->members; m++) {
        const uint32_t f = model->member[p->member + m];
        const sunder_i_body_piece *anchor = &of->anchor[m];
        if (!anchor->corners || model->clear[f] > far ||
            !may_reach(anchor->box, other->box, pair->offset, path, swapped))
            continue;
        for (uint32_t l = 0; l < other->pieces && !s->failed; l++) {
            const sunder_i_body_piece *piece = &pieces->piece[l];
            const sunder_i_body_piece *a = swapped ? piece : anchor, *b = swapped ? anchor : piece;
            if (!sunder_i_shadow_may_reach(a->box, b->box, pair->offset, path) ||
                sunder_i_may_pass(model, f, piece->feature))
                continue;
            pair->a = a;
            pair->b = b;
            pair->key = UINT64_C(1) << 61 | (uint64_t)f << 32 | (other->piece + l);
            visit(s, pair, context);
        }
        if (!sunder_i_steps(1 + other->pieces / 8)) s->failed = true;
    }
    if (!sunder_i_steps(1 + p->members / 8)) s->failed = true;
}

/* Visits the shadows that lines of `other`, a part of a barrier, cast from the side anchors of `p`. */
static void visit_sides(sunder_i_search *s, const sunder_i_body *p, const sunder_i_body *other, const double path[4],
                        sunder_i_piece_pair *pair, bool swapped, sunder_i_visit_piece_pair visit, void *context)
{
    const sunder_i_model *model = s->model;
    for (uint32_t m = 0; m < p->members; m++) {
        const uint32_t f = model->member[p->member + m];
        const sunder_i_body_piece *anchor = &model->side_anchor[f];
        if (!anchor->corners || !may_reach(anchor->box, other->box, pair->offset, path, swapped)) continue;
        for (uint32_t l = other->has->side; l < other->has->side + other->has->sides && !s->failed; l++) {
            const sunder_i_side *side = &model->side[l];
            pair->a = swapped ? &side->piece : anchor;
            pair->b = swapped ? anchor : &side->piece;
            if (!sunder_i_shadow_may_reach(pair->a->box, pair->b->box, pair->offset, path) ||
                !sunder_i_side_faces(model, side, f))
                continue;
            pair->key = UINT64_C(3) << 60 | (uint64_t)f << 30 | l;
            visit(s, pair, context);
        }
        if (!sunder_i_steps(1 + other->has->sides / 8)) s->failed = true;
    }
    if (!sunder_i_steps(1 + p->members / 8)) s->failed = true;
}

/* Has one of the two bodies lines that the other may not cross, within reach of the path? *swapped: p has the lines,
 * and q the side anchors. */
static bool may_cross(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q,
                      const double offset[2], const double path[4], bool *swapped)
{
    *swapped = p->has->sides > 0;
    if (p->has->sides) return sunder_i_shadow_may_reach(p->box, sunder_i_side_anchors(model, q), offset, path);
    return q->has->sides && sunder_i_shadow_may_reach(sunder_i_side_anchors(model, p), q->box, offset, path);
}

/* Is it forbidden that one of the two bodies jumps over the other? Parts of barriers have their own rule
 * (may_cross()). */
static bool may_jump(const sunder_i_model *model, const sunder_i_body *p, const sunder_i_body *q)
{
    return !model->rules.jumps && !sunder_i_is_barrier_body(model, p) && !sunder_i_is_barrier_body(model, q);
}

void sunder_i_search_visit_shadows(sunder_i_search *search, const sunder_i_body *p, const sunder_i_body *q,
                                   const double u[2], double reach, sunder_i_visit_piece_pair visit, void *context)
{
    const double offset[2] = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]};
    const double far = fabs(u[0]) + fabs(u[1]) + reach;
    double path[4];
    bool swapped;
    sunder_i_shadow_path_box(u, reach, path);
    const bool crosses = may_cross(search->model, p, q, offset, path, &swapped), jumps = may_jump(search->model, p, q),
               from_p =
                   jumps && p->clear <= far && sunder_i_anchors_may_reach(search->model, p, q, false, offset, path),
               from_q = jumps && q->clear <= far && sunder_i_anchors_may_reach(search->model, p, q, true, offset, path);
    if (!crosses && !from_p && !from_q) return;
    sunder_i_piece_pair pair = {.offset = {offset[0], offset[1]}, .inclusion = SUNDER_I_LAPSED, .shadow = true};
    if (crosses) visit_sides(search, swapped ? q : p, swapped ? p : q, path, &pair, swapped, visit, context);
    if (from_p) visit_from(search, p, q, path, far, &pair, false, visit, context);
    if (from_q) visit_from(search, q, p, path, far, &pair, true, visit, context);
}

/* ---- Of two neighbours in a row ---------------------------------------------------------------------------------- */

void sunder_i_search_visit_row(sunder_i_search *search, const sunder_i_body *p, const sunder_i_body *q, bool relaxed,
                               sunder_i_visit_piece_pair visit, void *context)
{
    const sunder_i_model *model = search->model;
    if (p->has->row_sides == 0 || q->has->row_sides == 0) return;
    const sunder_i_row_side *side = sunder_i_row_side_of(model, p, (uint32_t)(q - model->body));
    if (!side || side->least == -INFINITY) return;
    const sunder_i_piece_pair pair = {.key = UINT64_C(7) << 60 | (uint64_t)(side - model->row_side),
                                      .inclusion = SUNDER_I_LAPSED,
                                      .relaxed = relaxed,
                                      .shadow = true,
                                      .row = side};
    visit(search, &pair, context);
}

/* ---- Which bodies may have passed which -------------------------------------------------------------------------- */

/* Are the boxes of the two bodies at t within `reach` of each other? */
static bool are_near(const sunder_i_search *s, const double *t, uint32_t i, uint32_t j, double reach)
{
    const sunder_i_body *p = &s->model->body[s->body[i]], *q = &s->model->body[s->body[j]];
    double box[4];
    for (uint32_t c = 0; c < 4; c++)
        box[c] = p->box[c] + p->origin[c & 1] + t[2 * i + (c & 1)] - q->origin[c & 1] - t[2 * j + (c & 1)] +
                 (c < 2 ? -reach : reach);
    return sunder_i_box_meet(box, q->box);
}

bool sunder_i_search_may_pass(const sunder_i_search *search, const double *t, uint32_t i, uint32_t j, double reach)
{
    const sunder_i_body *p = &search->model->body[search->body[i]], *q = &search->model->body[search->body[j]];
    const double offset[2] = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]};
    const double u[2] = {t[2 * j] - t[2 * i], t[2 * j + 1] - t[2 * i + 1]};
    double path[4];
    bool swapped;
    if (p->has->row_sides && sunder_i_row_side_of(search->model, p, search->body[j])) return true;
    if (!sunder_i_forbids_paths(search->model)) return false;
    sunder_i_shadow_path_box(u, reach - search->model->rules.gap, path);
    if (may_cross(search->model, p, q, offset, path, &swapped)) return true;
    if (!may_jump(search->model, p, q)) return false;
    return sunder_i_anchors_may_reach(search->model, p, q, false, offset, path) ||
           sunder_i_anchors_may_reach(search->model, p, q, true, offset, path);
}

/* A body that passed another, and is farther from it than the gap, has moved farther than this plus the gap: to the
 * nearest feature that does not contain its anchor, or with its side anchor out of its own box. */
static double least_passing(const sunder_i_search *s)
{
    double least = INFINITY;
    for (size_t k = 0; k < s->n; k++) {
        const sunder_i_body *b = &s->model->body[s->body[k]];
        if (b->clear < least) least = b->clear;
        if (!s->model->sides || !b->pieces) continue;
        const double *anchors = sunder_i_side_anchors(s->model, b);
        for (int c = 0; c < 2; c++)
            least = sunder_i_min(least, sunder_i_min(anchors[c] - b->box[c], b->box[c + 2] - anchors[c + 2]));
    }
    return least;
}

static double length_of(const double *t, size_t k) { return sqrt(t[2 * k] * t[2 * k] + t[2 * k + 1] * t[2 * k + 1]); }

static double longest_move(const sunder_i_search *s, const double *t)
{
    double square = 0;
    for (size_t k = 0; k < s->n; k++) {
        const double of_k = t[2 * k] * t[2 * k] + t[2 * k + 1] * t[2 * k + 1];
        if (of_k > square) square = of_k;
    }
    return sqrt(square);
}

typedef struct swept {
    double box[4];
    uint32_t body;
} swept;

static int by_left(const void *a, const void *b)
{
    const swept *p = a, *q = b;
    if (p->box[0] != q->box[0]) return p->box[0] < q->box[0] ? -1 : 1;
    return p->body < q->body ? -1 : p->body > q->body;
}

/* Visits each two neighbours in a row that are farther apart than `reach`. */
static void visit_rows(sunder_i_search *s, const double *t, double reach, sunder_i_visit_pair visit, void *context)
{
    const sunder_i_model *model = s->model;
    for (uint32_t i = 0; i < s->n && !s->failed; i++) {
        const sunder_i_extras *has = model->body[s->body[i]].has;
        for (uint32_t k = has->row_side; k < has->row_side + has->row_sides && !s->failed; k++) {
            const uint32_t j = sunder_i_search_place_of(s, model->row_side[k].other);
            if (j != SUNDER_I_NOBODY && i < j && s->mass[i] + s->mass[j] > 0 && !are_near(s, t, i, j, reach))
                visit(s, i, j, context);
        }
    }
}

void sunder_i_search_visit_passing(sunder_i_search *search, const double *t, double reach, sunder_i_visit_pair visit,
                                   void *context)
{
    if (search->model->row_sides) visit_rows(search, t, reach, visit, context);
    if (!sunder_i_forbids_paths(search->model) || search->n < 2) return;
    /* The moves of two bodies that passed each other are together longer than `least`. */
    if (!search->least_passing_known) search->least_passing = least_passing(search);
    search->least_passing_known = true;
    const double least = search->least_passing + search->model->rules.gap, most = longest_move(search, t);
    if (2 * most < least) return;
    swept *list = sunder_i_alloc(search->n, sizeof *list);
    if (!list) {
        search->failed = true;
        return;
    }
    size_t n = 0;
    for (uint32_t k = 0; k < search->n; k++) {
        if (length_of(t, k) + most < least) continue;
        sunder_i_search_path_box(search, t, k, list[n].box);
        list[n++].body = k;
    }
    sunder_i_sort_few(list, n, sizeof *list, by_left);
    for (size_t x = 0; x < n && !search->failed; x++)
        for (size_t y = x + 1; y < n && list[y].box[0] <= list[x].box[2] && !search->failed; y++) {
            const uint32_t a = list[x].body, b = list[y].body, i = a < b ? a : b, j = a < b ? b : a;
            if (list[y].box[1] > list[x].box[3] || list[x].box[1] > list[y].box[3]) continue;
            if (!(search->mass[i] + search->mass[j] > 0) || are_near(search, t, i, j, reach)) continue;
            if (sunder_i_row_side_of(search->model, &search->model->body[search->body[i]], search->body[j])) continue;
            if (sunder_i_search_may_pass(search, t, i, j, reach)) visit(search, i, j, context);
        }
    sunder_i_free(list);
}
