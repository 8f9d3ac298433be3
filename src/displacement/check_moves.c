/* Checks which rules were broken between two versions of a layer, whatever program moved the features.
 *
 * Features are matched by their indices in the two layers. Each feature has to be a translate of what it was, up to the
 * rounding of its coordinates to doubles. Its move is checked against its limit, against the rule against jumps
 * together with the moves of all others, against the sides of barriers and, if rows are wanted, against the rule of
 * rows. No pair that is in conflict afterwards may be worse than before. Blocks, limits, rows and fixed features are
 * those of the layer before.
 *
 * A feature of the layer before may have smaller shapes (sunder_layer_set_levels()). If one of them, translated, is the
 * shape of the feature now, pairs are checked with that shape. A feature with none of its shapes is too small if it is
 * less than the least that a smaller shape keeps. Blocks, limits, anchors and rows are always those of the shape as
 * given.
 *
 * A feature that is ignored in the layer after alone is hidden: it owes nothing, and nothing is owed to it. It is
 * needless if it would be in no conflict where it stood, moved with its block. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/rounding.h"
#include "displacement/levels/levels.h"
#include "displacement/report/report.h"
#include "displacement/rows/rows.h"

#include "base/clock.h"
#include "base/sized_struct.h"
#include "base/watch.h"
#include "separation/separation.h"

#include <math.h>

typedef struct comparison {
    const sunder_layer *before, *after;
    sunder_i_barriers barriers;   /* those of `before` */
    sunder_layer layer;           /* the features of `before`, followed by the parts of its barriers; owned */
    sunder_i_model model;         /* made of `layer` */
    sunder_i_placement placement; /* first the positions in `before`, then those in `after` */
    sunder_i_relations start, now;
    sunder_i_jumps jumps;
    double *move;             /* [2 * features] the move of each feature between the two layers */
    bool *hidden, any_hidden; /* [features] the features that are left out afterwards; whether there are any */
    bool *translated;         /* [features] whether the feature is a translate */
    sunder_layer lowered;     /* the layer before, with the shapes that features have in the one after ... */
    const sunder_shape **was; /* [features] ... which are these */
    bool any_lowered;         /* a feature has a smaller shape */
    sunder_conflict *found;
    size_t n, capacity;
} comparison;

static void clear_comparison(comparison *c)
{
    sunder_i_jumps_free(&c->jumps);
    sunder_i_placement_free(&c->model, &c->placement);
    sunder_i_model_free(&c->model);
    sunder_i_barriers_free(&c->barriers);
    sunder_i_ordered_clear(&c->layer);
    sunder_i_free_all(c->start.pair, c->now.pair, c->move, c->translated, c->hidden, c->found, (void *)c->was);
}

static sunder_conflict *add_conflict(comparison *c, sunder_conflict_kind kind, size_t a, size_t b)
{
    if (!sunder_i_reserve(&c->found, &c->capacity, c->n + 1, sizeof *c->found)) return NULL;
    c->found[c->n] = (sunder_conflict){.a = a,
                                       .b = b,
                                       .kind = kind,
                                       .missing = NAN,
                                       .need_shift = NAN,
                                       .need_gap = NAN,
                                       .need_gone = SIZE_MAX,
                                       .need_gap_most = NAN};
    return &c->found[c->n++];
}

/* ---- Single features --------------------------------------------------------------------------------------------- */

/* Sets the link of conflict `out` to the path of feature a's anchor, as seen from something that moved by s. */
static void draw_link(const comparison *c, size_t a, const double s[2], sunder_conflict *out)
{
    sunder_shape_anchor(c->before->shape[a], out->from);
    for (int k = 0; k < 2; k++) out->to[k] = out->from[k] + (c->move[2 * a + (size_t)k] - s[k]);
}

/* Is the feature f a translate of this shape? A smaller or larger shape than the one that was read is compared as a
 * set, since its vertices were never given. */
static bool is_move(const comparison *c, size_t f, const sunder_shape *was, const sunder_shape *is, double t[2])
{
    const bool read = was == sunder_i_original_shape(c->before, f);
    return read ? sunder_i_move_between(was, is, t) : sunder_i_move_between_sets(was, is, t);
}

/* Sets *kind to the kind of conflict of feature f, whose shape is a translate of none that it may have. */
static sunder_status judge_shape(const comparison *c, size_t f, sunder_conflict_kind *kind, sunder_error *err)
{
    const sunder_shape *was = c->before->shape[f], *is = c->after->shape[f];
    const sunder_trimming *least = &c->before->least;
    sunder_shape *disc = NULL;
    bool fits = true;
    *kind = c->before->level_end ? SUNDER_CONFLICT_ALTERED : SUNDER_CONFLICT_NOT_A_TRANSLATE;
    if (!c->before->level_end || !is || sunder_shape_is_empty(is)) return SUNDER_OK;
    sunder_status status = SUNDER_OK;
    if (least->width > 0) status = sunder_shape_disc(least->width / 2, SUNDER_I_ROUND_CORNERS, false, &disc, err);
    if (!status && disc) status = sunder_i_disc_fits_polygons(is, disc, &fits, err);
    sunder_shape_free(disc);
    if (!fits || sunder_shape_area(is) < least->keep * sunder_shape_area(was)) *kind = SUNDER_CONFLICT_TOO_SMALL;
    return status;
}

static sunder_status check_feature(comparison *c, uint32_t f, sunder_error *err)
{
    const sunder_shape *was = c->was[f], *is = c->after->shape[f];
    const double none[2] = {0, 0}, *t = c->move + 2 * (size_t)f;
    const bool there = was && !sunder_shape_is_empty(was), still = is && !sunder_shape_is_empty(is);
    c->translated[f] = there == still && (!there || is_move(c, f, was, is, c->move + 2 * (size_t)f));
    /* If the geometry was repaired on input, the shape as given is not the one written; the move is then not known. */
    if (!c->translated[f] && there && still && sunder_shape_repaired(was)) return SUNDER_OK;
    if (!c->translated[f]) {
        sunder_conflict_kind kind;
        const sunder_status status = judge_shape(c, f, &kind, err);
        if (status) return status;
        return add_conflict(c, kind, f, SIZE_MAX) ? SUNDER_OK : sunder_i_failure_cause(err);
    }
    const sunder_i_body *body = &c->model.body[c->model.body_of[f]];
    const double limit = sunder_i_limit_of(body);
    if (sunder_i_is_within_limit(t, limit)) return SUNDER_OK;
    sunder_conflict *found = add_conflict(c, SUNDER_CONFLICT_LIMIT, f, SIZE_MAX);
    if (!found) return sunder_i_failure_cause(err);
    found->distance = hypot(t[0], t[1]);
    found->required = limit;
    draw_link(c, f, none, found);
    return SUNDER_OK;
}

/* ---- Pairs ------------------------------------------------------------------------------------------------------- */

/* Records that feature f crossed a side of a barrier part with its side anchor. For a feature and a barrier this is
 * recorded once. */
static sunder_status tell_side(comparison *c, uint32_t f, uint32_t part, sunder_error *err)
{
    const size_t barrier = c->layer.number[part];
    const sunder_conflict *last = c->n ? &c->found[c->n - 1] : NULL;
    if (!c->translated[f] || (last && last->kind == SUNDER_CONFLICT_SIDE && last->a == f && last->b == barrier))
        return SUNDER_OK;
    sunder_conflict *found = add_conflict(c, SUNDER_CONFLICT_SIDE, f, barrier);
    if (!found) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < 2; k++) {
        found->from[k] = c->model.side_at[2 * (size_t)f + k];
        found->to[k] = found->from[k] + c->move[2 * (size_t)f + k];
    }
    return SUNDER_OK;
}

static sunder_status tell_jump(comparison *c, uint32_t f, uint32_t g, sunder_error *err)
{
    bool jumps = false;
    if (!c->translated[f] || !c->translated[g]) return SUNDER_OK;
    const sunder_status status = sunder_i_jumps_over(&c->jumps, &c->model, f, g, &jumps, err);
    if (status || !jumps) return status;
    sunder_conflict *found = add_conflict(c, SUNDER_CONFLICT_JUMP, f, g);
    if (!found) return sunder_i_failure_cause(err);
    draw_link(c, f, c->move + 2 * (size_t)g, found);
    return SUNDER_OK;
}

/* Checks for crossed sides, and for jumps of one feature over another. */
static sunder_status check_paths(comparison *c, sunder_error *err)
{
    c->jumps.paths.own = c->move;
    sunder_status status = sunder_i_jumps_update(&c->jumps, &c->model, NULL, err);
    for (size_t k = 0; k < c->jumps.n && !status; k++) {
        const uint32_t a = c->jumps.pair[k].a, b = c->jumps.pair[k].b;
        if (sunder_i_is_barrier(&c->model, b)) {
            status = tell_side(c, a, b, err);
            continue;
        }
        status = tell_jump(c, a, b, err);
        if (!status) status = tell_jump(c, b, a, err);
    }
    return status;
}

/* Marks the features that are hidden: they are ignored in the layer after, and not in the one before. */
static sunder_status mark_hidden(comparison *c, sunder_error *err)
{
    c->hidden = sunder_i_calloc(c->before->n, sizeof *c->hidden);
    for (size_t f = 0; f < c->before->n && c->hidden; f++) {
        c->hidden[f] = sunder_i_demands(c->after, f)->ignored && c->model.present[f];
        c->any_hidden = c->any_hidden || c->hidden[f];
    }
    return c->hidden ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Finds out which features have a smaller shape now: those that are a translate of one, and not of the given one. */
static sunder_status find_levels(comparison *c, sunder_error *err)
{
    c->was = sunder_i_alloc(c->before->n, sizeof *c->was);
    if (!c->was) return sunder_i_failure_cause(err);
    for (size_t f = 0; f < c->before->n; f++) {
        const sunder_shape *given = c->before->shape[f], *is = c->after->shape[f];
        size_t n;
        const sunder_level *smaller = sunder_i_levels_of(c->before, f, &n);
        double t[2];
        c->was[f] = given;
        for (size_t k = 0; k < n && is && c->was[f] == given && !is_move(c, f, given, is, t); k++)
            if (is_move(c, f, smaller[k].shape, is, t)) c->was[f] = smaller[k].shape;
        c->any_lowered = c->any_lowered || c->was[f] != given;
    }
    c->lowered = *c->before;
    c->lowered.at_level = c->was;
    return SUNDER_OK;
}

/* Prepares the model for the features that are visible, with the shapes that they have now; but the rows are those of
 * the layer before, and so are the anchors. */
static sunder_status prepare_model(comparison *c, sunder_error *err)
{
    sunder_i_rows rows = {0};
    const bool wanted = c->model.rules.rows != SUNDER_ROWS_NONE;
    sunder_status status = wanted ? sunder_i_rows_find(&c->model, &rows, err) : SUNDER_OK;
    c->layer.lowered = c->any_lowered;
    if (!status && (c->any_hidden || c->any_lowered))
        status = sunder_i_placement_lower(&c->model, &c->placement, &c->start, c->hidden, err);
    if (!status) status = sunder_i_rows_forget_hidden(&rows, &c->model, err);
    if (!status) status = sunder_i_model_cut(&c->model, err);
    if (!status) status = sunder_i_model_anchor(&c->model, err);
    if (!status && wanted) status = sunder_i_rows_make_rule(&rows, &c->placement, &c->start, &c->model, err);
    sunder_i_rows_free(&rows);
    return status;
}

/* Is a pair of members of the two bodies in conflict now? It looks at all pairs: only suspected breaches are asked
 * about. */
static bool are_in_conflict(const comparison *c, uint32_t i, uint32_t j)
{
    for (size_t k = 0; k < c->now.n; k++) {
        const sunder_i_relation *r = &c->now.pair[k];
        const uint32_t p = c->model.body_of[r->a], q = c->model.body_of[r->b];
        if (((p == i && q == j) || (p == j && q == i)) && sunder_i_is_conflict_of_bodies(&c->model, r)) return true;
    }
    return false;
}

/* Records that the bodies of features f and g, neighbours in a row, broke its rule. */
static sunder_status tell_row(comparison *c, uint32_t f, uint32_t g, sunder_error *err)
{
    const uint32_t i = c->model.body_of[f], j = c->model.body_of[g];
    const sunder_i_row_side *side = sunder_i_row_side_of(&c->model, &c->model.body[i], j);
    const double *t = c->move + 2 * (size_t)f, *s = c->move + 2 * (size_t)g;
    if (!side || !c->translated[f] || !c->translated[g]) return SUNDER_OK;
    const double least = are_in_conflict(c, i, j) ? side->least_listed : side->least;
    if (sunder_i_keeps_row(side, t, s, least)) return SUNDER_OK;
    sunder_conflict *found = add_conflict(c, SUNDER_CONFLICT_ROW, f, g);
    if (!found) return sunder_i_failure_cause(err);
    found->distance = (s[0] - t[0]) * side->along[0] + (s[1] - t[1]) * side->along[1];
    found->required = least;
    draw_link(c, f, s, found);
    return SUNDER_OK;
}

/* Checks the pairs that left the row that they would have to keep without a conflict. c->now has to be known. */
static sunder_status check_rows(comparison *c, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < c->jumps.n && c->model.row_sides && !status; k++)
        if (!sunder_i_is_barrier(&c->model, c->jumps.pair[k].b))
            status = tell_row(c, c->jumps.pair[k].a, c->jumps.pair[k].b, err);
    return status;
}

/* Puts the features at their positions in `after`. */
static sunder_status place_after(comparison *c, sunder_error *err)
{
    sunder_i_placement *p = &c->placement;
    double *box = sunder_i_rtree_boxes(&p->tree, c->model.things);
    sunder_status status = box ? SUNDER_OK : sunder_i_failure_cause(err);
    for (uint32_t f = 0; f < c->model.features && !status; f++) {
        const sunder_shape *shape = c->after->shape[f];
        c->model.present[f] = c->model.present[f] && shape && !sunder_shape_is_empty(shape);
        if (!c->model.present[f]) continue;
        sunder_shape_box(shape, box + 4 * (size_t)f);
        if (!c->model.interior_cover) continue;
        status = sunder_i_interior_cover_make(shape, &p->interior_cover[f], err);
    }
    p->given = c->after;
    sunder_i_rtree_free(&p->tree);
    if (!status) status = sunder_i_rtree_build(box, c->model.present, c->model.things, &p->tree, err);
    sunder_i_free(box);
    return status;
}

/* Sets *worse to whether the pair of r is in conflict between different bodies and is worse than before. */
static sunder_status is_worse(const comparison *c, const sunder_i_relation *r, bool *worse, sunder_error *err)
{
    const sunder_i_relation *was = sunder_i_relations_find(&c->start, r->a, r->b);
    *worse = false;
    if (sunder_i_is_barrier(&c->model, r->b)) {
        const sunder_i_translate home = sunder_i_at_home(&c->model, r->a),
                                 now = sunder_i_standing(&c->model, &c->placement, r->a);
        return sunder_i_barrier_worsened(&c->model, &home, &now, r->b, worse, err);
    }
    if (!sunder_i_is_conflict_of_bodies(&c->model, r) || (was && was->contained && r->contained)) return SUNDER_OK;
    const sunder_i_pair before = {c->was[r->a], c->was[r->b], NULL, NULL},
                        after = {c->after->shape[r->a], c->after->shape[r->b], NULL, NULL};
    return sunder_i_pair_worsened(&before, &after, worse, err);
}

/* Keeps in c->now only the relations of pairs that are worse than before. */
static sunder_status find_worse(comparison *c, sunder_error *err)
{
    size_t out = 0;
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < c->now.n && !status; k++) {
        bool worse = false;
        status = is_worse(c, &c->now.pair[k], &worse, err);
        if (worse) c->now.pair[out++] = c->now.pair[k];
    }
    c->now.n = out;
    return status;
}

/* Sets t to the move of the body of hidden feature f, which is that of a visible member; zeros if there is none. */
static void move_of_body(const comparison *c, uint32_t f, double t[2])
{
    const sunder_i_body *body = &c->model.body[c->model.body_of[f]];
    t[0] = t[1] = 0;
    for (uint32_t m = 0; m < body->members; m++) {
        const uint32_t g = c->model.member[body->member + m];
        if (!c->model.present[g] || !c->translated[g]) continue;
        for (size_t k = 0; k < 2; k++) t[k] = c->move[2 * (size_t)g + k];
        return;
    }
}

/* Records the hidden features that would be in no conflict. */
static sunder_status check_hidden(comparison *c, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (uint32_t f = 0; f < c->model.features && c->any_hidden && !status; f++) {
        bool fits = false;
        double t[2];
        if (!c->hidden[f]) continue;
        move_of_body(c, f, t);
        status = sunder_i_placement_fits(&c->model, &c->placement, f, t, &fits, err);
        if (!status && fits && !add_conflict(c, SUNDER_CONFLICT_NEEDLESS, f, SIZE_MAX))
            status = sunder_i_failure_cause(err);
    }
    return status;
}

/* Records these pairs as the report describes conflicts, with their distances before. */
static sunder_status check_pairs(comparison *c, sunder_report *report, sunder_error *err)
{
    sunder_status status = place_after(c, err);
    if (!status) status = sunder_i_placement_relate(&c->model, &c->placement, NULL, &c->now, err);
    if (!status) report->summary.pairs_tested = c->now.tested;
    if (!status) status = check_hidden(c, err);
    if (!status) status = check_rows(c, err);
    if (!status) status = find_worse(c, err);
    if (!status) status = sunder_i_report_conflicts(report, &c->model, &c->placement, &c->now, false, err);
    for (size_t k = 0; k < report->conflicts && !status; k++) {
        const sunder_conflict *described = &report->conflict[k];
        double on_a[2], on_b[2];
        sunder_conflict *found = add_conflict(c, SUNDER_CONFLICT_WORSE, described->a, described->b);
        if (!found) return sunder_i_failure_cause(err);
        *found = *described;
        found->b = c->layer.number[described->b];
        found->kind = SUNDER_CONFLICT_WORSE;
        if (sunder_i_is_barrier(&c->model, (uint32_t)described->b)) {
            const sunder_i_translate home = sunder_i_at_home(&c->model, (uint32_t)described->a);
            sunder_i_barrier_stance stance;
            status = sunder_i_barrier_stand(&c->model, &home, (uint32_t)described->b, &stance, err);
            found->before = stance.distance;
            continue;
        }
        status = sunder_pair_distance(c->was[described->a], c->was[described->b], &found->before, on_a, on_b, err);
    }
    return status;
}

/* ---- The whole comparison ---------------------------------------------------------------------------------------- */

static sunder_status begin_comparison(comparison *c, const sunder_layer_options *options, sunder_error *err)
{
    sunder_i_rules rules;
    if (c->before->n != c->after->n)
        return sunder_i_fail(err, SUNDER_EARG, "the layers have %zu and %zu features", c->before->n, c->after->n);
    sunder_status status = sunder_i_rules_of(options, &rules, err);
    if (!status) status = sunder_i_barriers_make(c->before, &rules, &c->barriers, err);
    if (!status) status = find_levels(c, err);
    if (!status) status = sunder_i_order_layer(&c->lowered, &c->barriers, true, &c->layer, err);
    if (!status) status = sunder_i_model_init(&c->layer, &c->barriers, &rules, &c->model, err);
    if (!status) status = sunder_i_placement_init(&c->model, &c->placement, err);
    if (!status) status = sunder_i_placement_relate(&c->model, &c->placement, NULL, &c->start, err);
    if (!status) status = sunder_i_model_join(&c->model, &c->start, err);
    if (!status) status = sunder_i_model_note_crossed(&c->model, &c->start, err);
    if (!status) status = mark_hidden(c, err);
    if (!status) status = prepare_model(c, err);
    if (status) return status;
    c->move = sunder_i_calloc(2 * c->before->n, sizeof *c->move);
    c->translated = sunder_i_calloc(c->before->n, sizeof *c->translated);
    return c->move && c->translated ? SUNDER_OK : sunder_i_failure_cause(err);
}

static sunder_status compare_layers(comparison *c, const sunder_layer_options *options, sunder_report **report,
                                    sunder_error *err)
{
    const double began = sunder_i_now();
    sunder_status status = begin_comparison(c, options, err);
    if (!status) status = sunder_i_report_new(&c->model, report, err);
    if (!status) status = sunder_i_report_features(*report, &c->model, err);
    for (uint32_t f = 0; f < c->before->n && !status; f++) {
        if (sunder_i_demands(c->before, f)->ignored || c->hidden[f])
            c->translated[f] = true;
        else
            status = check_feature(c, f, err);
        if (!status && !sunder_i_look()) status = sunder_i_cancelled(err);
    }
    if (!status) status = check_paths(c, err);
    if (!status) status = check_pairs(c, *report, err);
    if (status) return status;
    sunder_i_free((*report)->conflict);
    (*report)->conflict = c->found;
    (*report)->conflicts = c->n;
    c->found = NULL;
    (*report)->summary.verified = c->n == 0;
    (*report)->summary.seconds_verify = sunder_i_now() - began;
    return SUNDER_OK;
}

sunder_status sunder_layer_check_moves(const sunder_layer *before, const sunder_layer *after,
                                       const sunder_layer_options *options, sunder_report **out, sunder_error *err)
{
    comparison c = {.before = before, .after = after};
    sunder_i_watch watch;
    sunder_report *report = NULL;
    sunder_layer_options o;
    sunder_layer_options_init(&o);
    sunder_status status = sunder_i_options_read(&o, sizeof o, options, err);
    if (status) return status;
    sunder_i_watch_begin(&watch, &o.progress, &o.progress_user);
    status = compare_layers(&c, &o, &report, err);
    sunder_i_watch_end(&watch);
    clear_comparison(&c);
    if (status)
        sunder_report_free(report);
    else
        *out = report;
    return status;
}
