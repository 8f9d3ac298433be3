/* A question about a remaining conflict is a small layer of its own, which is solved like any other. It contains the
 * surroundings of the conflict (small_layer.c), except for what the question changes.
 *
 * The answer is yes if no movable body of the small layer is left in conflict, except for pairs that are also in
 * conflict in the result and are no worse than at the start; if no body moved to a place where the whole layer might
 * have a feature that the small layer does not have; and if no feature jumps over another. So a reported need has a
 * solution: with all other features as in the result the pair is solved, and its neighbours keep the distances they
 * have to keep. A smaller change may also suffice. The number of neighbours is bounded, and so is the number of
 * questions; the cost grows with the number of conflicts, and the answers for a conflict depend on its surroundings
 * only. */
#include "displacement/report/question.h"
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/reads.h"
#include "displacement/layer/sides.h"
#include "displacement/report/tuning.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- One question ------------------------------------------------------------------------------------------------ */

/* Returns whether all movable features of the small layer ended where all features around them are known, and sets
 * *longest to the longest of their moves. */
static bool is_known(const sunder_i_surroundings *a, const sunder_i_solver *x, double gap, double *longest)
{
    const sunder_i_model *model = &x->model;
    *longest = 0;
    gap = sunder_i_max(gap, x->barriers.farthest);
    for (size_t k = 0; k < model->features; k++) {
        const double *t = model->move + 2 * (size_t)model->body_of[k],
                     *box = sunder_i_rtree_box(&x->placement.tree, (uint32_t)k);
        if (x->layer.number[k] >= a->moving || !model->present[k]) continue;
        *longest = sunder_i_max(*longest, hypot(t[0], t[1]));
        if (box[0] - gap < a->known[0] || box[1] - gap < a->known[1] || box[2] + gap > a->known[2] ||
            box[3] + gap > a->known[3])
            return false;
    }
    return true;
}

/* Sets *may to whether a pair in conflict in the small layer may remain so: it is among the listed pairs, is not the
 * pair that the question is about, and is no worse than at the start. */
static sunder_status may_stay(const sunder_i_questions *g, const sunder_i_surroundings *a, const sunder_conflict *c,
                              const sunder_i_solver *x, const sunder_i_relation *r, uint32_t gone, bool *may,
                              sunder_error *err)
{
    const sunder_i_model *model = &g->solver->model;
    const uint32_t f = sunder_i_surroundings_number(a, model, x, r->a, gone),
                   other = sunder_i_surroundings_number(a, model, x, r->b, gone), low = f < other ? f : other,
                   high = f < other ? other : f;
    const sunder_conflict key = {.a = low, .b = sunder_i_whole_of(model, high)};
    const sunder_conflict *listed =
        bsearch(&key, g->report->conflict, g->report->conflicts, sizeof key, sunder_i_by_things);
    const sunder_i_translate p = sunder_i_standing(&x->model, &x->placement, r->a),
                             q = sunder_i_standing(&x->model, &x->placement, r->b);
    bool worse;
    *may = false;
    if (!listed || listed->inside_block || sunder_i_by_things(listed, c) == 0) return SUNDER_OK;
    sunder_status status;
    if (sunder_i_is_barrier(model, high)) {
        const sunder_i_translate home = sunder_i_at_home(model, low);
        status = sunder_i_barrier_worsened(model, &home, &p, high, &worse, err);
    } else {
        const sunder_i_pair was = {sunder_i_thing_shape(model, f), sunder_i_thing_shape(model, other), NULL, NULL},
                            is = {p.shape, q.shape, p.t, q.t};
        status = sunder_i_pair_worsened(&was, &is, &worse, err);
    }
    *may = !status && !worse;
    return status;
}

/* Sets *yes to whether the small layer is a solution: the pair is solved, movable features keep what is required, and
 * the other listed pairs are no worse than at the start. *longest is the longest move. */
static sunder_status is_solved(const sunder_i_questions *g, const sunder_i_surroundings *a, const sunder_conflict *c,
                               const sunder_i_solver *x, const sunder_i_supposition *what, bool *yes, double *longest,
                               sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    *yes = !x->hopeless && is_known(a, x, what->gap, longest);
    for (size_t k = 0; k < x->now.n && *yes && !status; k++) {
        const sunder_i_relation *r = &x->now.pair[k];
        if (sunder_i_is_conflict_of_bodies(&x->model, r) &&
            (x->layer.number[r->a] < a->moving || x->layer.number[r->b] < a->moving))
            status = may_stay(g, a, c, x, r, what->gone, yes, err);
    }
    return status;
}

static bool stand_alike(const sunder_i_model *model, uint32_t f, const double t[2])
{
    const double *s = model->move + 2 * (size_t)model->body_of[f];
    return s[0] == t[0] && s[1] == t[1];
}

/* Sets *passes to whether feature f, moved by t, passes feature g, which has its move of the result, or g passes f. */
static sunder_status passes_either(const sunder_i_model *model, uint32_t f, const double t[2], uint32_t g, bool *passes,
                                   sunder_error *err)
{
    const double *s = model->move + 2 * (size_t)model->body_of[g];
    const double *a = model->anchor_at + 2 * (size_t)f, *b = model->anchor_at + 2 * (size_t)g;
    const sunder_i_passage there = {{a[0], a[1]}, {t[0], t[1]}, {s[0], s[1]}},
                           back = {{b[0], b[1]}, {s[0], s[1]}, {t[0], t[1]}};
    if (sunder_i_may_jump(model, f, g)) return SUNDER_OK;
    const sunder_status status = sunder_i_passes(&there, sunder_i_thing_shape(model, g), passes, err);
    return status || *passes ? status : sunder_i_passes(&back, sunder_i_thing_shape(model, f), passes, err);
}

/* Sets *crosses to whether feature f, moved by t, crosses a side of a barrier. The small layer itself knows only the
 * sides of lines. */
static sunder_status crosses_sides(const sunder_i_model *model, uint32_t f, const double t[2],
                                   const sunder_i_surroundings *a, uint32_t gone, bool *crosses, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < a->part.n && model->sides && !status && !*crosses; k++)
        if (sunder_i_whole_of(model, a->part.item[k]) != gone)
            status = sunder_i_crosses_side(model, f, t, a->part.item[k], crosses, err);
    return status;
}

/* Sets *jumps to whether a movable feature of the small layer jumps over a feature that is fixed in the small layer but
 * moved in the result, or crosses a side. The small layer cannot see this, because in it fixed features always stood
 * where they are. */
static sunder_status find_jump(const sunder_i_questions *g, const sunder_i_surroundings *a, const sunder_i_solver *x,
                               uint32_t gone, bool *jumps, sunder_error *err)
{
    const sunder_i_solver *s = g->solver;
    const double none[2] = {0, 0};
    sunder_i_list mover = {0};
    sunder_status status = SUNDER_OK;
    *jumps = false;
    if (sunder_i_jumps_begun(&s->jumps) && !sunder_i_path_tree_look_about(&s->jumps.paths, &s->model, a->known, &mover))
        status = sunder_i_failure_cause(err);
    for (size_t k = 0; k < x->model.features && !status && !*jumps; k++) {
        const size_t at = x->layer.number[k];
        if (at >= a->moving || !x->model.present[k]) continue;
        const double *t = x->model.move + 2 * (size_t)x->model.body_of[k];
        if (!status) status = crosses_sides(&s->model, a->feature.item[at], t, a, gone, jumps, err);
        for (size_t m = 0; m < mover.n && !status && !*jumps; m++) {
            bool moves = false; /* it is itself a movable feature of the small layer */
            for (size_t i = 0; i < a->moving && !moves; i++) moves = a->feature.item[i] == mover.item[m];
            if (moves || stand_alike(&s->model, mover.item[m], none) || stand_alike(&s->model, mover.item[m], t))
                continue;
            status = passes_either(&s->model, a->feature.item[at], t, mover.item[m], jumps, err);
        }
    }
    sunder_i_free(mover.item);
    return status;
}

/* Sets *clearance to how the features a < b of the whole layer stood at its start (layer/requirement.h). The value is
 * taken from the memo g->stood, or computed and added to it. */
static sunder_status find_how_stood(const sunder_i_questions *g, uint32_t a, uint32_t b, double *clearance,
                                    sunder_error *err)
{
    sunder_i_requirement_memo *memo = g->stood;
    sunder_i_requirement found = {.a = a, .b = b};
    const size_t at = sunder_i_lower_bound(&found, memo->item, memo->n, sizeof found, sunder_i_by_id_pair);
    if (at < memo->n && sunder_i_by_id_pair(&found, &memo->item[at]) == 0) {
        *clearance = memo->item[at].clearance;
        return SUNDER_OK;
    }
    const sunder_status status = sunder_i_requirement_find(&g->solver->model, &g->solver->start, a, b, &found, err);
    if (status) return status;
    if (!sunder_i_reserve(&memo->item, &memo->capacity, memo->n + 1, sizeof found)) return sunder_i_failure_cause(err);
    memmove(memo->item + at + 1, memo->item + at, (memo->n++ - at) * sizeof found);
    memo->item[at] = found;
    *clearance = found.clearance;
    return SUNDER_OK;
}

/* Sets *held, an array of n which the caller frees, to the clearance that proofs hold each spared pair to. If a feature
 * of the pair moved in the result, it stands elsewhere in the small layer than at the start of the whole one, and the
 * clearance is the one at the start of the whole layer. It is NAN for all other pairs and beside barriers: they may be
 * no worse than at the start of the small layer. */
static sunder_status find_held(const sunder_i_questions *g, const sunder_i_surroundings *a,
                               const sunder_i_id_pair *spared, size_t n, double **held, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    *held = sunder_i_alloc(n, sizeof **held);
    if (!*held) return sunder_i_failure_cause(err);
    for (size_t k = 0; k < n && !status; k++) {
        const uint32_t p = spared[k].a, q = spared[k].b;
        (*held)[k] = NAN;
        if (q >= a->feature.n || (!a->standing[p] && !a->standing[q])) continue;
        const uint32_t f = a->feature.item[p], other = a->feature.item[q];
        status = find_how_stood(g, f < other ? f : other, f < other ? other : f, &(*held)[k], err);
    }
    return status;
}

/* Lists the other listed pairs, which may remain in conflict, as sunder_i_surroundings_listed() does. */
static bool list_spared(const sunder_i_questions *g, const sunder_i_surroundings *a, const sunder_conflict *c,
                        uint32_t gone, sunder_i_id_pair **list, size_t *n)
{
    return sunder_i_surroundings_listed(a, &g->solver->model, g->report, c, gone, list, n);
}

/* Returns the options with which the small layer is solved. */
static sunder_layer_options options_for(const sunder_i_questions *g, double gap)
{
    sunder_layer_options options = *g->options;
    options.gap = gap;
    options.touch_tolerance = sunder_i_min(g->solver->model.rules.tolerance, gap / 2);
    options.no_blocks = true; /* blocks are given by numbers */
    options.threads = 1;
    options.effort = 0;
    options.ease = options.full_gap = 0;
    options.row_stiffness[0] = options.row_stiffness[1] = 0;
    options.progress = NULL;
    return options;
}

/* Copies the moves of all features to layout[], by their numbers in the small layer. */
static void take_layout(const sunder_i_solver *x, double *layout)
{
    for (size_t k = 0; k < x->model.features; k++)
        memcpy(layout + 2 * (size_t)x->layer.number[k], x->model.move + 2 * (size_t)x->model.body_of[k],
               2 * sizeof *layout);
}

/* Answers the question if the n pairs of spared[], sorted, may remain in conflict. */
static sunder_status ask_sparing(const sunder_i_questions *g, const sunder_i_surroundings *a, const sunder_conflict *c,
                                 const sunder_i_supposition *what, const sunder_i_id_pair *spared, size_t n,
                                 sunder_i_patience *proof, sunder_i_answer *answer, sunder_error *err)
{
    const bool wanted = proof && sunder_i_patience_asks(proof);
    sunder_i_proof_found found = wanted ? SUNDER_I_PROOF_WANTED : SUNDER_I_PROOF_UNASKED;
    const sunder_layer_options options = options_for(g, what->gap);
    sunder_i_solver x = {0};
    sunder_layer *layer = NULL;
    bool jumps = false;
    uint32_t *name = sunder_i_surroundings_names(a, &g->solver->model, what->gone);
    *answer = (sunder_i_answer){.refuted = what->gap, .layout = answer->layout};
    sunder_status status = name ? sunder_i_surroundings_layer(a, g->solver, what->limit, what->gone, &layer, err)
                                : sunder_i_failure_cause(err);
    sunder_i_row_demand *row = NULL;
    size_t rows = 0;
    if (!status) status = sunder_i_question_rows(g, a, what, &row, &rows, err);
    const sunder_i_spared list = {.pair = spared, .n = n, .memo = g->memo, .name = name, .row = row, .rows = rows};
    if (!status) {
        status = g->solve(layer, &options, &list, &found, &x, err);
        if (!status) status = is_solved(g, a, c, &x, what, &answer->yes, &answer->longest, err);
        if (!status && answer->yes) status = find_jump(g, a, &x, what->gone, &jumps, err);
        answer->yes = answer->yes && !jumps && !sunder_i_question_leaves_row(g, a, &x, what);
        if (answer->yes && answer->layout) take_layout(&x, answer->layout);
        if (x.hopeless) answer->refuted = x.refuted;
        sunder_i_solver_free(&x);
    }
    sunder_layer_free(layer);
    sunder_i_free_all(name, row);
    /* A question with a solution does not count as a failed attempt to prove that there is none. */
    if (found == SUNDER_I_PROOF_FOUND || (found == SUNDER_I_PROOF_IN_VAIN && !answer->yes))
        sunder_i_patience_note(proof, found == SUNDER_I_PROOF_FOUND);
    return status;
}

sunder_status sunder_i_few_are_listed(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                                      const sunder_conflict *conflict, bool *few, sunder_error *err)
{
    sunder_i_id_pair *spared = NULL;
    size_t n = 0;
    const bool ok = list_spared(questions, surroundings, conflict, SUNDER_I_NOBODY, &spared, &n);
    *few = n > 0 && n <= NEED_ALL;
    sunder_i_free(spared);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* Up to NEED_ALL other listed pairs have to be solved too. If that has no solution and what->all is not set, or if they
 * are more, as along roads, they may remain in conflict. */
sunder_status sunder_i_ask(const sunder_i_questions *questions, const sunder_i_surroundings *surroundings,
                           const sunder_conflict *conflict, const sunder_i_supposition *what, sunder_i_patience *proof,
                           sunder_i_answer *answer, sunder_error *err)
{
    sunder_i_id_pair *spared = NULL;
    size_t n = 0;
    *answer = (sunder_i_answer){.refuted = what->gap, .layout = answer->layout};
    sunder_status status = list_spared(questions, surroundings, conflict, what->gone, &spared, &n)
                               ? SUNDER_OK
                               : sunder_i_failure_cause(err);
    if (!status && n <= NEED_ALL)
        status = ask_sparing(questions, surroundings, conflict, what, NULL, 0, proof, answer, err);
    const bool spares = n > NEED_ALL || (n > 0 && !what->all && !answer->yes);
    if (!status && spares) status = ask_sparing(questions, surroundings, conflict, what, spared, n, proof, answer, err);
    sunder_i_free(spared);
    return status;
}

/* ---- Proofs about smaller gaps ----------------------------------------------------------------------------------- */

sunder_status sunder_i_foresight_init(sunder_i_foresight *foresight, const sunder_i_questions *questions,
                                      const sunder_i_surroundings *surroundings, const sunder_conflict *conflict,
                                      double limit, sunder_error *err)
{
    sunder_i_foresight *f = foresight;
    const sunder_i_supposition what = {.limit = limit, .gap = questions->options->gap, .gone = SUNDER_I_NOBODY};
    const sunder_layer_options options = options_for(questions, what.gap);
    sunder_i_proof_found later = SUNDER_I_PROOF_LATER;
    *f = (sunder_i_foresight){.questions = questions, .about = surroundings};
    if (!list_spared(questions, surroundings, conflict, SUNDER_I_NOBODY, &f->spared, &f->n))
        return sunder_i_failure_cause(err);
    f->name = sunder_i_surroundings_names(surroundings, &questions->solver->model, SUNDER_I_NOBODY);
    sunder_status status =
        f->name ? sunder_i_surroundings_layer(surroundings, questions->solver, limit, SUNDER_I_NOBODY, &f->layer, err)
                : sunder_i_failure_cause(err);
    if (!status) status = find_held(questions, surroundings, f->spared, f->n, &f->held, err);
    if (!status) status = sunder_i_question_rows(questions, surroundings, &what, &f->row, &f->rows, err);
    const sunder_i_spared spared = {f->spared, f->n, questions->memo, f->name, f->held, f->row, f->rows};
    if (!status) status = questions->solve(f->layer, &options, &spared, &later, &f->solver, err);
    if (status) return status;
    f->hopeless = sunder_i_solver_is_beyond_limits(&f->solver, &spared);
    f->move = sunder_i_calloc(2 * f->solver.model.bodies, sizeof *f->move);
    f->next = sunder_i_calloc(2 * f->solver.model.bodies, sizeof *f->next);
    f->best = sunder_i_calloc(2 * f->solver.model.bodies, sizeof *f->best);
    f->at = sunder_i_calloc(2 * surroundings->feature.n, sizeof *f->at);
    return f->move && f->next && f->best && f->at ? SUNDER_OK : sunder_i_failure_cause(err);
}

void sunder_i_foresight_clear(sunder_i_foresight *foresight)
{
    sunder_i_planes_clear(&foresight->planes);
    sunder_i_solver_free(&foresight->solver);
    sunder_layer_free(foresight->layer);
    sunder_i_free_all(foresight->spared, foresight->name, foresight->row, foresight->held, foresight->move,
                      foresight->next, foresight->best, foresight->at);
}

/* Sets the limits of the features that move, in a solver of the small layer. */
static void set_limits(const sunder_i_surroundings *a, sunder_i_solver *x, double limit)
{
    for (size_t k = 0; k < x->model.features; k++) {
        const size_t at = x->layer.number[k];
        if (at >= a->moving) continue;
        x->model.body[x->model.body_of[k]].limit = sunder_i_min(sunder_i_max(a->as[at].max_shift, limit), a->farthest);
    }
}

void sunder_i_foresight_limit(sunder_i_foresight *foresight, double limit)
{
    set_limits(foresight->about, &foresight->solver, limit);
}

/* Returns the pairs that may remain in conflict in an answer to `what`: all other listed pairs; none if what->all is
 * set and they are at most NEED_ALL, since they have to be solved then. search: the pairs are held to how they stood at
 * the start of the small layer, and not to f->held. */
static sunder_i_spared spared_for(const sunder_i_foresight *f, const sunder_i_supposition *what, bool search)
{
    const size_t n = what->all && f->n <= NEED_ALL ? 0 : f->n;
    return (sunder_i_spared){f->spared, n, f->questions->memo, f->name, search ? NULL : f->held, f->row, f->rows};
}

/* Lists in `heeded` all features and barriers of the small layer except `gone`. Returns false if memory is out. */
static bool list_others(const sunder_i_foresight *f, uint32_t gone, sunder_i_list *heeded)
{
    const sunder_i_model *there = &f->solver.model, *model = &f->questions->solver->model;
    for (uint32_t k = 0; k < there->things; k++)
        if (sunder_i_whole_of(model, sunder_i_surroundings_number(f->about, model, &f->solver, k, SUNDER_I_NOBODY)) !=
                gone &&
            !sunder_i_list_push(heeded, sunder_i_whole_of(there, k)))
            return false;
    heeded->n = sunder_i_set_make(heeded->item, heeded->n);
    return true;
}

sunder_status sunder_i_foresee(sunder_i_foresight *foresight, const sunder_i_supposition *what,
                               sunder_i_foresight_mode mode, sunder_i_verdict *verdict, double *refuted,
                               sunder_error *err)
{
    sunder_i_foresight *f = foresight;
    const sunder_i_spared spared = spared_for(f, what, mode == SUNDER_I_FORESEE_SEARCH),
                          relaxed = {.pair = f->spared, .n = f->n};
    const bool nobody = what->gone == SUNDER_I_NOBODY, room = mode == SUNDER_I_FORESEE_WITH_ROOM;
    sunder_i_list heeded = {0};
    *refuted = what->gap;
    sunder_status status = nobody || list_others(f, what->gone, &heeded) ? SUNDER_OK : sunder_i_failure_cause(err);
    memset(f->next, 0, 2 * f->solver.model.bodies * sizeof *f->next);
    const sunder_i_proving how = {.spared = &spared,
                                  .relaxed = &relaxed,
                                  .heeded = nobody ? NULL : &heeded,
                                  .planes = &f->planes,
                                  .precedents = &f->precedents,
                                  .in_plane = mode == SUNDER_I_FORESEE_IN_PLANE,
                                  .effort = NEED_PROOF_EFFORT * (f->patient ? NEED_PROOF_PATIENT : 1),
                                  .seeks = room,
                                  .near = room ? f->move : f->known ? f->best : NULL,
                                  .held_margin = room ? NEED_ROOM * f->questions->options->gap : 0,
                                  .move = f->next};
    if (!status) status = sunder_i_solver_prove(&f->solver, &how, verdict, refuted, err);
    if (*verdict == SUNDER_I_INFEASIBLE && room) *verdict = SUNDER_I_UNKNOWN;
    sunder_i_free(heeded.item);
    if (status || *verdict != SUNDER_I_FEASIBLE) return status;
    double *solution = f->next;
    f->next = f->move;
    f->move = solution;
    return SUNDER_OK;
}

void sunder_i_foresight_note(sunder_i_foresight *foresight, const double *move)
{
    const sunder_i_solver *s = &foresight->solver;
    for (size_t k = 0; k < s->model.features; k++)
        memcpy(foresight->best + 2 * (size_t)s->model.body_of[k], move + 2 * (size_t)s->layer.number[k],
               2 * sizeof *move);
    foresight->known = true;
}

/* Copies the moves of the last solution in real numbers to `move`, in the numbers of another solver `x` of the same
 * small layer. They are shortened by what rounding may add to a limit. */
static void carry_over(const sunder_i_foresight *f, const sunder_i_solver *x, double *move)
{
    const sunder_i_solver *s = &f->solver;
    double *of = f->at;
    for (size_t k = 0; k < s->model.features; k++)
        memcpy(of + 2 * (size_t)s->layer.number[k], f->move + 2 * (size_t)s->model.body_of[k], 2 * sizeof *of);
    for (size_t k = 0; k < x->model.features; k++)
        for (size_t e = 0; e < 2; e++)
            move[2 * (size_t)x->model.body_of[k] + e] = of[2 * (size_t)x->layer.number[k] + e] * (1 - NEED_SHORTER);
}

sunder_status sunder_i_foresight_holds(sunder_i_foresight *foresight, const sunder_conflict *conflict,
                                       const sunder_i_supposition *what, bool *yes, sunder_error *err)
{
    sunder_i_foresight *f = foresight;
    const sunder_i_questions *g = f->questions;
    const sunder_layer_options options = options_for(g, what->gap);
    const sunder_i_spared spared = spared_for(f, what, false);
    sunder_i_proof_found later = SUNDER_I_PROOF_LATER;
    sunder_i_solver x = {0};
    bool jumps = false;
    double longest;
    *yes = false;
    sunder_status status = g->solve(f->layer, &options, &spared, &later, &x, err);
    if (!status) set_limits(f->about, &x, 0);
    double *move = status ? NULL : sunder_i_calloc(2 * x.model.bodies, sizeof *move);
    if (!status && !move) status = sunder_i_failure_cause(err);
    if (!status) carry_over(f, &x, move);
    if (!status) status = sunder_i_solver_place_all(&x, move, yes, err);
    if (!status && *yes) status = is_solved(g, f->about, conflict, &x, what, yes, &longest, err);
    if (!status && *yes) status = find_jump(g, f->about, &x, SUNDER_I_NOBODY, &jumps, err);
    *yes = *yes && !jumps && !sunder_i_question_leaves_row(g, f->about, &x, what);
    if (*yes) memcpy(f->best, f->move, 2 * f->solver.model.bodies * sizeof *f->best);
    f->known = f->known || *yes;
    sunder_i_free(move);
    sunder_i_solver_free(&x);
    return status;
}
