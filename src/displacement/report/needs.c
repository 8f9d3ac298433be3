/* What would free a conflict that was left: a longer limit, a smaller gap, one feature less. Each is a layer of its
 * own, solved like any other:
 *
 *     the two bodies, and those about them, where they came from    as given, but for what is asked
 *     whoever stands about these                                    where they stand in the result, and stays there
 *
 * and the answer is yes if nothing that moves there is left in conflict, none came to where somebody might be whom that
 * layer does not know, and none jumps over anybody as all of them moved. So what is said has a solution: with all
 * others as in the result, the pair and its neighbours are solved. That a smaller change would not do is not said.
 * Neighbours are few, and so are the questions; what it costs grows with the number of conflicts, and a conflict's
 * answers depend on what stands about it alone. */
#include "displacement/layer/sides.h"
#include "displacement/report/report.h"
#include "displacement/report/tuning.h"

#include "base/parallel.h"
#include "separation/separation.h"
#include "shape/shape.h"

#include <math.h>
#include <string.h>

/* A small layer about one conflict. The first `moving` features move, the others stand. */
typedef struct surroundings {
    sunder_i_list feature; /* in the numbers of the whole layer */
    sunder_i_list part;    /* of barriers, likewise */
    size_t moving;
    sunder_feature *as;      /* [feature.n] how each takes part */
    sunder_shape **standing; /* [feature.n] owned shapes, of those that moved; else NULL */
    double known[4];         /* whoever reaches into this box is among them */
    double farthest;         /* nobody may go farther than this */
} surroundings;

typedef struct needing {
    const sunder_i_solver *solver;
    sunder_report *report;
    const sunder_layer_options *options;
    sunder_i_solve_layer solve;
    int halvings;  /* between what does and what does not */
    size_t leaves; /* of those in the way, by turns */
} needing;

/* What is asked: a limit for all that move, the gap, and who is gone. */
typedef struct supposition {
    double limit, gap;
    uint32_t gone; /* SUNDER_I_NOBODY: nobody */
} supposition;

/* ---- Who takes part ---------------------------------------------------------------------------------------------- */

static void clear(surroundings *a)
{
    for (size_t k = 0; a->standing && k < a->feature.n; k++) sunder_shape_free(a->standing[k]);
    sunder_i_free(a->standing);
    sunder_i_free(a->as);
    sunder_i_free(a->feature.item);
    sunder_i_free(a->part.item);
}

/* What the conflict lacks: how far its features have to part. */
static double missing(const sunder_conflict *c) { return c->depth + c->required - c->distance; }

static bool append_members(const sunder_i_model *model, uint32_t body, sunder_i_list *feature)
{
    const sunder_i_body *b = &model->body[body];
    for (uint32_t k = 0; k < b->members; k++)
        if (model->present[model->member[b->member + k]] && !sunder_i_list_push(feature, model->member[b->member + k]))
            return false;
    return true;
}

/* Appends to `body` those that reach into a feature's box grown by reach, at home or as they stand. */
static bool look_about(const sunder_i_solver *s, uint32_t feature, double reach, sunder_i_list *near,
                       sunder_i_list *body)
{
    double box[4];
    sunder_i_box_grow(s->model.box + 4 * (size_t)feature, reach, box);
    near->n = 0;
    if (!sunder_i_rtree_query(&s->placement.tree, box, near) || !sunder_i_rtree_query(&s->model.tree, box, near))
        return false;
    for (size_t k = 0; k < near->n; k++)
        if (!sunder_i_list_push(body, s->model.body_of[near->item[k]])) return false;
    return true;
}

/* Unless there are enough: two, and so many features. */
static bool take_in(const sunder_i_model *model, uint32_t body, sunder_i_list *moving)
{
    size_t features = model->body[body].members;
    for (size_t k = 0; k < moving->n; k++) {
        if (moving->item[k] == body) return true;
        features += model->body[moving->item[k]].members;
    }
    const bool enough = moving->n >= 2 && features > NEED_MOVING;
    return model->body[body].fixed || enough || sunder_i_list_push(moving, body);
}

/* Those of the two that may move, then of those about them, in order of number. */
static bool choose_moving(const sunder_i_solver *s, const sunder_conflict *c, double reach, sunder_i_list *moving)
{
    const sunder_i_model *model = &s->model;
    sunder_i_list near = {0}, body = {0};
    bool ok = take_in(model, model->body_of[c->a], moving) && take_in(model, model->body_of[c->b], moving);
    for (size_t k = 0, n = moving->n; k < n && ok; k++) {
        const sunder_i_body *b = &model->body[moving->item[k]];
        for (uint32_t m = 0; m < b->members && ok; m++)
            if (model->present[model->member[b->member + m]])
                ok = look_about(s, model->member[b->member + m], reach, &near, &body);
    }
    body.n = sunder_i_set_make(body.item, body.n);
    for (size_t k = 0; k < body.n && ok; k++) ok = take_in(model, body.item[k], moving);
    sunder_i_free(near.item);
    sunder_i_free(body.item);
    return ok;
}

/* What moves takes part as it was given, with its block; whatever stands does so where it is in the result. */
static sunder_status take_part(const sunder_i_solver *s, surroundings *a, size_t k, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    const uint32_t f = a->feature.item[k], b = model->body_of[f];
    const sunder_i_translate *at = &s->placement.translate[f];
    a->as[k] = model->layer->feature[f];
    a->as[k].block = b;
    if (k < a->moving) {
        a->as[k].max_shift = model->body[b].limit;
        return SUNDER_OK;
    }
    a->as[k].fixed = true;
    a->as[k].shape = at->shape;
    if (at->t[0] == 0 && at->t[1] == 0) return SUNDER_OK;
    bool exact;
    const sunder_status status = sunder_shape_translate(at->shape, at->t[0], at->t[1], &a->standing[k], &exact, err);
    a->as[k].shape = a->standing[k];
    return status;
}

static sunder_status surround(const sunder_i_solver *s, const sunder_conflict *c, surroundings *a, sunder_error *err)
{
    const sunder_i_model *model = &s->model;
    const double reach = c->required + missing(c);
    sunder_i_list moving = {0}, near = {0};
    bool ok = choose_moving(s, c, reach, &moving);
    sunder_i_box_clear(a->known);
    for (size_t k = 0; k < moving.n && ok; k++) ok = append_members(model, moving.item[k], &a->feature);
    a->moving = a->feature.n;
    for (size_t k = 0; k < a->moving; k++) sunder_i_box_join(a->known, model->box + 4 * (size_t)a->feature.item[k]);
    a->farthest = NEED_GAPS * c->required + NEED_MISSING * missing(c);
    sunder_i_box_grow(a->known, a->farthest + reach, a->known);
    ok = ok && sunder_i_rtree_query(&s->placement.tree, a->known, &near);
    moving.n = sunder_i_set_make(moving.item, moving.n);
    near.n = sunder_i_set_make(near.item, near.n);
    for (size_t k = 0; k < near.n && ok; k++)
        if (!sunder_i_set_has(moving.item, moving.n, model->body_of[near.item[k]]))
            ok = sunder_i_list_push(sunder_i_is_barrier(model, near.item[k]) ? &a->part : &a->feature, near.item[k]);
    sunder_i_free(moving.item);
    sunder_i_free(near.item);
    a->as = sunder_i_alloc(a->feature.n, sizeof *a->as);
    a->standing = sunder_i_calloc(a->feature.n, sizeof *a->standing);
    sunder_status status = ok && a->as && a->standing ? SUNDER_OK : sunder_i_no_memory(err);
    for (size_t k = 0; k < a->feature.n && !status; k++) status = take_part(s, a, k, err);
    return status;
}

/* ---- One question ------------------------------------------------------------------------------------------------ */

/* Is nothing that moves in conflict, and all of it where everybody is known? *longest: of the moves. */
static bool is_solved(const surroundings *a, const sunder_i_solver *x, double gap, double *longest)
{
    const sunder_i_model *model = &x->model;
    *longest = 0;
    if (x->hopeless) return false;
    gap = fmax(gap, x->barriers.farthest);
    for (size_t k = 0; k < model->features; k++) {
        const double *t = model->move + 2 * (size_t)model->body_of[k], *box = x->placement.box + 4 * k;
        if (x->number[k] >= a->moving || !model->present[k]) continue;
        *longest = fmax(*longest, hypot(t[0], t[1]));
        if (box[0] - gap < a->known[0] || box[1] - gap < a->known[1] || box[2] + gap > a->known[2] ||
            box[3] + gap > a->known[3])
            return false;
    }
    for (size_t k = 0; k < x->now.n; k++) {
        const sunder_i_relation *r = &x->now.pair[k];
        if (sunder_i_is_conflict_of_bodies(model, r) && (x->number[r->a] < a->moving || x->number[r->b] < a->moving))
            return false;
    }
    return true;
}

static bool stand_alike(const sunder_i_model *model, uint32_t f, const double t[2])
{
    const double *s = model->move + 2 * (size_t)model->body_of[f];
    return s[0] == t[0] && s[1] == t[1];
}

/* Does f, going by t, pass g, which moved as in the result? Or g f? */
static sunder_status pass(const sunder_i_model *model, uint32_t f, const double t[2], uint32_t g, bool *passes,
                          sunder_error *err)
{
    const double *s = model->move + 2 * (size_t)model->body_of[g];
    const double *a = model->anchor_at + 2 * (size_t)f, *b = model->anchor_at + 2 * (size_t)g;
    const sunder_i_passage there = {{a[0], a[1]}, {t[0], t[1]}, {s[0], s[1]}},
                           back = {{b[0], b[1]}, {s[0], s[1]}, {t[0], t[1]}};
    const sunder_status status = sunder_i_passes(&there, model->layer->feature[g].shape, passes, err);
    return status || *passes ? status : sunder_i_passes(&back, model->layer->feature[f].shape, passes, err);
}

/* Does f, going by t, cross a side? That layer knows those of lines alone. */
static sunder_status cross(const sunder_i_model *model, uint32_t f, const double t[2], const surroundings *a,
                           uint32_t gone, bool *crosses, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < a->part.n && model->sides && !status && !*crosses; k++)
        if (sunder_i_whole_of(model, a->part.item[k]) != gone)
            status = sunder_i_crosses_side(model, f, t, a->part.item[k], crosses, err);
    return status;
}

/* In that layer all who stand do so from the beginning. As they moved, is there a jump, or is a side crossed? */
static sunder_status find_jump(const needing *g, const surroundings *a, const sunder_i_solver *x, uint32_t gone,
                               bool *jumps, sunder_error *err)
{
    const sunder_i_solver *s = g->solver;
    const double none[2] = {0, 0};
    sunder_i_list mover = {0};
    sunder_status status = SUNDER_OK;
    *jumps = false;
    if (s->jumps.way && !sunder_i_rtree_query(&s->jumps.tree, a->known, &mover)) status = sunder_i_no_memory(err);
    for (size_t k = 0; k < x->model.features && !status && !*jumps; k++) {
        const size_t at = x->number[k];
        if (at >= a->moving || !x->model.present[k]) continue;
        const double *t = x->model.move + 2 * (size_t)x->model.body_of[k];
        if (!status) status = cross(&s->model, a->feature.item[at], t, a, gone, jumps, err);
        for (size_t m = 0; m < mover.n && !status && !*jumps; m++) {
            bool moves = false; /* itself, in that layer */
            for (size_t i = 0; i < a->moving && !moves; i++) moves = a->feature.item[i] == mover.item[m];
            if (moves || stand_alike(&s->model, mover.item[m], none) || stand_alike(&s->model, mover.item[m], t))
                continue;
            status = pass(&s->model, a->feature.item[at], t, mover.item[m], jumps, err);
        }
    }
    sunder_i_free(mover.item);
    return status;
}

/* Parts of barriers as barriers of their own: of areas without sides, since some edges of pieces are none. */
static sunder_status set_barriers(const sunder_i_solver *s, const surroundings *a, uint32_t gone, sunder_layer *layer,
                                  sunder_error *err)
{
    sunder_barrier *barrier = sunder_i_alloc(a->part.n, sizeof *barrier);
    size_t n = 0;
    if (!barrier) return sunder_i_no_memory(err);
    for (size_t k = 0; k < a->part.n; k++) {
        const uint32_t part = a->part.item[k];
        if (sunder_i_whole_of(&s->model, part) == gone) continue;
        barrier[n] = s->layer.barrier[sunder_i_barrier_of(&s->model, part)];
        barrier[n].side = barrier[n].side && s->model.layer->feature[part].shape->flat;
        barrier[n++].geometry = (sunder_obstacle){.shape = s->model.layer->feature[part].shape};
    }
    const sunder_status status = sunder_layer_set_barriers(layer, barrier, n, err);
    sunder_i_free(barrier);
    return status;
}

static sunder_status ask(const needing *g, const surroundings *a, const supposition *what, bool *yes, double *longest,
                         sunder_error *err)
{
    sunder_layer_options options = *g->options;
    sunder_i_solver x = {0};
    sunder_layer *layer = NULL;
    sunder_status status = sunder_layer_new(a->as, a->feature.n, &layer, err);
    *yes = false;
    if (!status) status = set_barriers(g->solver, a, what->gone, layer, err);
    if (status) {
        sunder_layer_free(layer);
        return status;
    }
    for (size_t k = 0; k < a->feature.n; k++) {
        sunder_feature *f = &layer->feature[k];
        if (k < a->moving) f->max_shift = fmin(fmax(f->max_shift, what->limit), a->farthest);
        f->ignored = f->ignored || a->feature.item[k] == what->gone;
    }
    options.gap = what->gap;
    options.touch_tolerance = fmin(g->solver->model.rules.tolerance, what->gap / 2);
    options.no_blocks = true; /* they have numbers */
    options.threads = 1;
    options.effort = 0;
    options.progress = NULL;
    status = g->solve(layer, &options, &x, err);
    if (!status) *yes = is_solved(a, &x, what->gap, longest);
    bool jumps = false;
    if (!status && *yes) status = find_jump(g, a, &x, what->gone, &jumps, err);
    *yes = *yes && !jumps;
    sunder_i_solver_free(&x);
    sunder_layer_free(layer);
    return status;
}

/* ---- The three needs --------------------------------------------------------------------------------------------- */

/* A limit of moves: what they need where they may go as far as is known, and then less, by halves. */
static sunder_status need_shift(const needing *g, const surroundings *a, sunder_conflict *c, sunder_error *err)
{
    supposition what = {a->farthest, c->required, SUNDER_I_NOBODY};
    double longest, low = INFINITY;
    bool yes;
    what.gap = g->options->gap;
    for (size_t k = 0; k < a->moving; k++) low = fmin(low, a->as[k].max_shift);
    if (!(low < what.limit)) return SUNDER_OK;
    for (int k = 0; k <= g->halvings; k++) {
        const sunder_status status = ask(g, a, &what, &yes, &longest, err);
        if (status) return status;
        /* One unit above what is rounded once holds the move. */
        if (yes)
            c->need_shift = nextafter(longest, INFINITY);
        else if (k == 0)
            return SUNDER_OK;
        else
            low = what.limit;
        what.limit = low + (c->need_shift - low) / 2;
        if (!(low < what.limit && what.limit < c->need_shift)) return SUNDER_OK;
    }
    return SUNDER_OK;
}

static sunder_status need_gap(const needing *g, const surroundings *a, sunder_conflict *c, sunder_error *err)
{
    supposition what = {0, 0, SUNDER_I_NOBODY};
    double high = g->options->gap, longest;
    bool yes;
    for (int k = 0; k <= g->halvings && high > 0; k++) {
        const sunder_status status = ask(g, a, &what, &yes, &longest, err);
        if (status) return status;
        if (yes)
            c->need_gap = what.gap;
        else if (k == 0)
            return SUNDER_OK;
        else
            high = what.gap;
        what.gap = c->need_gap + (high - c->need_gap) / 2;
    }
    return SUNDER_OK;
}

/* The first of those in the way, without which all others are solved. */
static sunder_status need_gone(const needing *g, const surroundings *a, sunder_conflict *c, sunder_error *err)
{
    const supposition none = {0, g->options->gap, SUNDER_I_NOBODY};
    double longest;
    bool yes = false;
    for (size_t k = 0; k < c->n_blocked_by && k < g->leaves && !yes; k++) {
        supposition what = none;
        what.gone = (uint32_t)c->blocked_by[k];
        const sunder_status status = ask(g, a, &what, &yes, &longest, err);
        if (status) return status;
        if (yes) c->need_gone = c->blocked_by[k];
    }
    return SUNDER_OK;
}

static size_t members_that_move(const sunder_i_model *model, size_t feature)
{
    const sunder_i_body *body = &model->body[model->body_of[feature]];
    return body->fixed ? 0 : body->members;
}

static sunder_status find_needs(const needing *g, sunder_conflict *c, sunder_error *err)
{
    const sunder_i_model *model = &g->solver->model;
    surroundings a = {0};
    if (members_that_move(model, c->a) + members_that_move(model, c->b) > NEED_MOST) return SUNDER_OK;
    sunder_status status = surround(g->solver, c, &a, err);
    if (!status) status = need_shift(g, &a, c, err);
    if (!status) status = need_gap(g, &a, c, err);
    if (!status) status = need_gone(g, &a, c, err);
    clear(&a);
    return status;
}

static sunder_status find_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const needing *g = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        sunder_conflict *c = &g->report->conflict[k];
        if (!c->inside_block && c->reason != SUNDER_REASON_KEPT) status = find_needs(g, c, err);
    }
    return status;
}

sunder_status sunder_i_report_needs(sunder_report *report, const sunder_i_solver *solver,
                                    const sunder_layer_options *options, sunder_i_solve_layer solve, sunder_error *err)
{
    const double effort = fmin(ceil(options->effort), NEED_EFFORT);
    const needing g = {solver, report, options, solve, (int)effort, NEED_GONE * (size_t)effort};
    if (!(effort > 0)) return SUNDER_OK;
    return sunder_i_parallel(solver->model.rules.threads, report->conflicts, SUNDER_I_GRAIN_WHOLE, find_some,
                             (void *)&g, err);
}
