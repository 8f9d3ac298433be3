/* Finds what would solve a remaining conflict: a longer limit, a smaller gap, or the removal of one feature. Each
 * question is answered by a small layer around the conflict (question.c).
 *
 * In a dense layer hardly any of these small layers has a solution, and there are thousands of conflicts. The pairs of
 * a cluster are therefore examined in turn until the cluster's budget for failed questions is spent, and a kind of
 * question that mostly fails is asked less and less often. (A gap that the pair already keeps in the result needs no
 * question.) What is reported of a pair thus depends on its cluster only, not on the rest of the layer. */
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/reads.h"
#include "displacement/layer/resolution.h"
#include "displacement/report/question.h"
#include "displacement/report/tuning.h"

#include "base/extremes.h"
#include "base/parallel.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>

/* ---- Failed questions -------------------------------------------------------------------------------------------- */

/* The remaining budget of a cluster. `left` is the number of features that may still take part in failed questions. The
 * patience counters decide for each kind of question whether it is asked again; `proof` is that of attempts to prove
 * that a question has no solution, which only save the search for one. */
typedef struct budget {
    uint64_t left;
    sunder_i_patience shift, gap, gone, proof;
} budget;

/* ---- Gaps that the result already keeps -------------------------------------------------------------------------- */

/* Returns whether needs are to be found for this conflict. */
static bool is_asked_about(const sunder_conflict *c) { return !c->inside_block && c->reason != SUNDER_REASON_KEPT; }

/* Returns whether the conflict is about the layer's gap, and not about a gap that belongs to the barrier. */
static bool is_about_gap(const sunder_i_solver *s, const sunder_conflict *c)
{
    return c->b < s->model.features || s->layer.barrier[sunder_i_barrier_of(&s->model, (uint32_t)c->b)].gap < 0;
}

/* Returns the gap that the pair of the conflict keeps in the result: the distance of two features that are nearer than
 * the layer's gap, or the part of a feature's distance from a barrier that exceeds the drawn width. Returns -1 if there
 * is none. */
static double gap_of(const sunder_i_solver *s, const sunder_conflict *c)
{
    if (c->depth > 0 || !is_about_gap(s, c)) return -1;
    if (c->kind == SUNDER_CONFLICT_TOO_CLOSE) return sunder_i_max(0, nextafter(c->distance, -INFINITY));
    if (c->kind != SUNDER_CONFLICT_BARRIER_NEAR) return -1;
    const double gap = s->model.rules.gap, width = c->required - gap;
    /* The last term covers three roundings, and those of c->distance and c->required. */
    return c->distance - width - 0x1p-50 * (c->distance + c->required + gap);
}

/* For each pair, takes the least gap that the pair and all remaining pairs of its two bodies keep in the result. With
 * that gap the result itself is a solution for the pair and its neighbours, so it becomes need_gap without a question,
 * if it is at least 0 and less than the requested gap. */
static sunder_status keep_what_there_is(const sunder_i_questions *g, sunder_error *err)
{
    const sunder_i_model *model = &g->solver->model;
    sunder_report *report = g->report;
    double *least = sunder_i_alloc(model->bodies, sizeof *least);
    if (!least) return sunder_i_failure_cause(err);
    for (size_t b = 0; b < model->bodies; b++) least[b] = INFINITY;
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < report->conflicts; k++) {
            sunder_conflict *c = &report->conflict[k];
            if (!is_asked_about(c)) continue;
            double gap = gap_of(g->solver, c), *of[2] = {&least[model->body_of[c->a]], &least[model->body_of[c->b]]};
            for (int e = 0; e < 2; e++) {
                if (model->body[model->body_of[e ? c->b : c->a]].fixed) continue;
                if (pass == 0)
                    *of[e] = sunder_i_min(*of[e], gap);
                else
                    gap = sunder_i_min(gap, *of[e]);
            }
            if (pass == 1 && gap >= 0 && gap < g->options->gap) c->need_gap = gap;
        }
    sunder_i_free(least);
    return SUNDER_OK;
}

/* ---- The three needs --------------------------------------------------------------------------------------------- */

/* Reduces the budget by the number of features and barrier parts that took part in a failed question. */
static void note_in_vain(const sunder_i_surroundings *a, budget *left)
{
    const uint64_t took = a->feature.n + a->part.n;
    left->left -= took < left->left ? took : left->left;
}

/* Asks a question. If the answer is no, the budget is reduced. */
static sunder_status ask_question(const sunder_i_questions *g, const sunder_i_surroundings *a, const sunder_conflict *c,
                                  const sunder_i_supposition *what, budget *left, sunder_i_answer *answer,
                                  sunder_error *err)
{
    const sunder_status status = sunder_i_ask(g, a, c, what, &left->proof, answer, err);
    if (!status && !answer->yes) note_in_vain(a, left);
    return status;
}

/* Finds a sufficient limit. The first question allows the longest moves of which all neighbours are known, or the limit
 * that solves the whole cluster if that is known (cluster_needs.c). If it has a solution, the interval below is halved
 * up to g->halvings times. */
static sunder_status need_shift(const sunder_i_questions *g, const sunder_i_surroundings *a, sunder_conflict *c,
                                budget *left, sunder_error *err)
{
    sunder_i_supposition what = {
        .limit = sunder_i_min(a->farthest, c->need_shift), .gap = g->options->gap, .gone = SUNDER_I_NOBODY};
    double low = INFINITY;
    sunder_i_answer answer;
    for (size_t k = 0; k < a->moving; k++) low = sunder_i_min(low, a->as[k].max_shift);
    if (!(low < what.limit) || !sunder_i_patience_asks(&left->shift)) return SUNDER_OK;
    for (int k = 0; k <= g->halvings; k++) {
        const sunder_status status = ask_question(g, a, c, &what, left, &answer, err);
        if (status) return status;
        if (k == 0) sunder_i_patience_note(&left->shift, answer.yes);
        /* The length was rounded once, so the next larger double is an upper bound. */
        if (answer.yes)
            c->need_shift = sunder_i_min(c->need_shift, nextafter(answer.longest, INFINITY));
        else if (k == 0)
            return SUNDER_OK;
        else
            low = what.limit;
        what.limit = low + (c->need_shift - low) / 2;
        if (!(low < what.limit && what.limit < c->need_shift)) return SUNDER_OK;
    }
    return SUNDER_OK;
}

/* ---- The gap ----------------------------------------------------------------------------------------------------- */

/* Returns the sum of the limits of the conflict's two features, or the limit of its feature if the other is a
 * barrier. */
static double reach_of(const sunder_i_model *model, const sunder_conflict *c)
{
    const double limit = sunder_i_limit_of(&model->body[model->body_of[c->a]]);
    return c->b < model->features ? limit + sunder_i_limit_of(&model->body[model->body_of[c->b]]) : limit;
}

/* Computes the least relative move with which the pair keeps `gap`: *least is a proved lower bound of its length,
 * *length the length found. */
static sunder_status least_for_gap(const sunder_i_model *model, const sunder_conflict *c, double gap, double *least,
                                   double *length, sunder_error *err)
{
    if (c->b < model->features) {
        sunder_i_rules rules = model->rules;
        sunder_i_resolution move;
        rules.gap = gap;
        const sunder_status status = sunder_i_resolve(&rules, sunder_i_thing_shape(model, c->a),
                                                      sunder_i_thing_shape(model, c->b), INFINITY, &move, err);
        *least = move.least;
        *length = hypot(move.away[0], move.away[1]);
        return status;
    }
    const uint32_t barrier = (uint32_t)c->b;
    const sunder_i_translate home = sunder_i_at_home(model, (uint32_t)c->a);
    const double owed = sunder_i_required_below(model->barriers, sunder_i_barrier_of(model, barrier));
    sunder_separation move = {0};
    bool beyond;
    const sunder_status status = sunder_i_barrier_least(
        model, &home, barrier, sunder_i_max(0, owed - model->rules.gap + gap), INFINITY, &move, &beyond, err);
    *least = move.lower_bound;
    *length = move.distance;
    return status;
}

/* Finds the largest gap up to `most` that the pair could keep by itself within its limits. It can keep the gap *does
 * (negative if none), and no gap larger than *above; the two differ by at most `step` if PAIR_GAP_ROUNDS rounds
 * suffice. The least relative move for a gap g is usually longer than the one for gap 0 by g. The next gap tried is
 * therefore the last one plus what the limits leave after its move; the second try is usually right. */
static sunder_status gap_of_pair(const sunder_i_model *model, const sunder_conflict *c, double most, double step,
                                 double *does, double *above, sunder_error *err)
{
    const double reach = reach_of(model, c);
    double low = -1, high = most, gap = 0;
    for (int k = 0; k < PAIR_GAP_ROUNDS && high - low > step; k++) {
        double least, length;
        const sunder_status status = least_for_gap(model, c, gap, &least, &length, err);
        if (status) return status;
        double next = gap + (reach - length);
        if (least <= reach) {
            low = gap;
            next = sunder_i_max(next, low + step);
        } else
            high = gap;
        if (low < 0) break;
        gap = next > low && next < high ? next : low + (high - low) / 2;
    }
    *does = low;
    *above = high;
    return SUNDER_OK;
}

/* Returns whether the question's layer contains no feature or barrier other than the two of the conflict. */
static bool are_alone(const sunder_i_model *model, const sunder_i_surroundings *a, const sunder_conflict *c)
{
    bool alone = a->feature.n == (c->b < model->features ? 2 : 1);
    for (size_t k = 0; k < a->part.n && alone; k++) alone = sunder_i_whole_of(model, a->part.item[k]) == c->b;
    return alone;
}

/* The questions about the gap of one conflict. `high` is the largest gap that may still have a solution. `all` means
 * that answers also have to solve the other listed pairs in the small layer, if these are few. */
typedef struct asked {
    const sunder_i_questions *questions;
    const sunder_i_surroundings *about;
    sunder_conflict *conflict;
    budget *left;
    double high;
    bool all;
    sunder_i_foresight *foresight; /* NULL if it was not made yet, or is not needed */
    bool foresight_of_all;
} asked;

/* Asks whether there is a solution with this gap, and stores the answer: need_gap if there is one, otherwise the upper
 * end `high`. */
static sunder_status try_gap(asked *g, double gap, bool *yes, sunder_error *err)
{
    const sunder_i_supposition what = {.gap = gap, .gone = SUNDER_I_NOBODY, .all = g->all};
    sunder_i_answer answer;
    const sunder_status status = ask_question(g->questions, g->about, g->conflict, &what, g->left, &answer, err);
    *yes = answer.yes;
    if (answer.yes)
        g->conflict->need_gap = gap;
    else
        g->high = answer.refuted;
    return status;
}

static void look_ahead_no_more(asked *g)
{
    if (g->foresight) sunder_i_foresight_clear(g->foresight);
    sunder_i_free(g->foresight);
    g->foresight = NULL;
}

/* Makes the small layer that is used for proofs, unless it was already made for the same value of `all`. */
static sunder_status look_ahead(asked *g, bool all, sunder_error *err)
{
    if (g->foresight && g->foresight_of_all == all) return SUNDER_OK;
    look_ahead_no_more(g);
    g->foresight = sunder_i_alloc(1, sizeof *g->foresight);
    if (!g->foresight) return sunder_i_failure_cause(err);
    g->foresight_of_all = all;
    return sunder_i_foresight_init(g->foresight, g->questions, g->about, g->conflict, all, err);
}

/* Narrows the interval in which the largest gap lies to the width `step`, by proofs. *low is raised to gaps for which
 * there is a solution (with `in_plane`: to gaps that are not refuted). The upper end is lowered to gaps that are
 * refuted, or of which nothing is known. g->high is lowered only by refuted gaps. */
static sunder_status narrow_gap(asked *g, bool in_plane, double step, double *low, double high, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    while (!status && high - *low > step) {
        const double next = *low < 0 ? 0 : *low + NEED_GAP_AT * (high - *low);
        sunder_i_verdict verdict;
        double refuted;
        status = sunder_i_foresee(g->foresight, next, SUNDER_I_NOBODY, in_plane, &verdict, &refuted, err);
        if (!status && verdict == SUNDER_I_INFEASIBLE) g->high = refuted;
        if (verdict == SUNDER_I_FEASIBLE || (in_plane && verdict == SUNDER_I_UNKNOWN))
            *low = next;
        else
            high = sunder_i_min(next, g->high);
    }
    return status;
}

/* Sets *gap to about the largest gap with which the small layer has a solution in real numbers, to within `step`, or to
 * -1 if none is found. First only the plane of the pair's relative moves is examined, as if nothing else could move;
 * that is mostly right, and one further question confirms it. */
static sunder_status foresee_gap(asked *g, double step, double *gap, sunder_error *err)
{
    const double first = isnan(g->conflict->need_gap) ? -step : g->conflict->need_gap;
    const double high = g->high;
    double low = first, refuted;
    sunder_i_verdict verdict = SUNDER_I_UNKNOWN;
    *gap = -1;
    if (!sunder_i_patience_asks(&g->left->proof)) return SUNDER_OK;
    sunder_status status = look_ahead(g, g->all, err);
    if (!status) status = narrow_gap(g, true, step, &low, high, err);
    if (!status && low == first) sunder_i_patience_note(&g->left->proof, g->high < high);
    if (status || low == first) return status;
    status = sunder_i_foresee(g->foresight, low, SUNDER_I_NOBODY, false, &verdict, &refuted, err);
    if (!status && verdict == SUNDER_I_INFEASIBLE) g->high = refuted;
    const double most = sunder_i_min(low, g->high);
    if (verdict != SUNDER_I_FEASIBLE) low = first;
    if (!status && verdict != SUNDER_I_FEASIBLE) status = narrow_gap(g, false, step, &low, most, err);
    if (low > first) *gap = low;
    sunder_i_patience_note(&g->left->proof, low > first || g->high < high);
    return status;
}

/* Tests whether the solution in real numbers that was found for the gap `seen` is also one in doubles, with a gap that
 * is smaller by the share NEED_LESS. If so, sets *yes, and need_gap to that gap. */
static sunder_status try_foreseen(asked *g, double seen, bool *yes, sunder_error *err)
{
    const double gap = seen * (1 - NEED_LESS);
    const sunder_status status = sunder_i_foresight_holds(g->foresight, g->conflict, gap, yes, err);
    if (!status && *yes) g->conflict->need_gap = gap;
    return status;
}

/* For a pair without neighbours: the largest gap that the two could keep within their limits is the answer, reduced by
 * the small margin that the search keeps to limits, or by half a step if that is still too large. */
static sunder_status try_gap_of_pair(asked *g, double step, sunder_error *err)
{
    const sunder_i_model *model = &g->questions->solver->model;
    const sunder_conflict *c = g->conflict;
    double does, above;
    bool yes = false;
    if (reach_of(model, c) == INFINITY || !is_about_gap(g->questions->solver, c)) return SUNDER_OK;
    sunder_status status = gap_of_pair(model, c, g->high, step / 2, &does, &above, err);
    if (status) return status;
    g->high = sunder_i_max(above, 0);
    if (!(does > 0) || c->need_gap >= does) return SUNDER_OK;
    status = try_gap(g, does * (1 - 0x1p-20), &yes, err);
    if (!status && !yes && does > step / 2) status = try_gap(g, does - step / 2, &yes, err);
    return status;
}

/* If there are few other listed pairs, asks whether a solution without a gap solves them as well. If it does, larger
 * gaps have to do so too: g->all is set accordingly. */
static sunder_status try_no_gap_of_all(asked *g, sunder_error *err)
{
    const double high = g->high;
    sunder_status status = sunder_i_few_are_listed(g->questions, g->about, g->conflict, &g->all, err);
    if (!status && g->all) status = try_gap(g, 0, &g->all, err);
    g->high = high;
    return status;
}

static sunder_status try_no_gap(asked *g, sunder_error *err)
{
    const double high = g->high;
    bool yes;
    const sunder_status status = try_gap(g, 0, &yes, err);
    g->high = high;
    return status;
}

/* Finds the largest gap with which there is a solution, to within 1 / NEED_GAP_PARTS of the layer's gap. For a pair
 * without neighbours it is the pair's own largest gap. Otherwise proofs alone find roughly how large it is, in a small
 * part of the time that searches take, and one search confirms it. If the result is not confirmed, the interval is
 * halved by searches a few times. */
static sunder_status need_gap(asked *g, sunder_error *err)
{
    sunder_conflict *c = g->conflict;
    const bool known = !isnan(c->need_gap);
    const double step = g->questions->options->gap / NEED_GAP_PARTS, before = c->need_gap;
    double seen = -1;
    bool yes = false;
    if (!(step > 0) || (known && !sunder_i_patience_asks(&g->left->gap))) return SUNDER_OK;
    sunder_status status = SUNDER_OK;
    if (are_alone(&g->questions->solver->model, g->about, c)) status = try_gap_of_pair(g, step, err);
    if (!status && isnan(c->need_gap)) status = try_no_gap_of_all(g, err);
    if (!status) status = foresee_gap(g, step, &seen, err);
    if (!status && seen > 0) status = try_foreseen(g, seen, &yes, err);
    if (seen > 0 && !yes) g->high = seen;
    if (!status && isnan(c->need_gap) && g->high > 0) status = try_no_gap(g, err);
    if (!status && isnan(c->need_gap) && !(g->high > 0)) note_in_vain(g->about, g->left);
    if (status || isnan(c->need_gap)) return status;
    for (int k = 0; !status && k < NEED_GAP_HALVINGS * g->questions->halvings && g->high - c->need_gap > step; k++)
        status = try_gap(g, c->need_gap + (g->high - c->need_gap) / 2, &yes, err);
    if (known) sunder_i_patience_note(&g->left->gap, c->need_gap > before);
    return status;
}

/* ---- Removing one feature ---------------------------------------------------------------------------------------- */

/* Sets *yes to whether the conflict has a solution without the feature or barrier `gone`. No search is made if it is
 * proved that there is none. */
static sunder_status try_gone(asked *g, uint32_t gone, bool *yes, sunder_error *err)
{
    const double gap = g->questions->options->gap;
    sunder_i_answer answer = {.yes = false};
    sunder_i_verdict verdict = SUNDER_I_UNKNOWN;
    double refuted;
    const bool looks = g->foresight || sunder_i_patience_asks(&g->left->proof);
    sunder_status status = looks ? look_ahead(g, false, err) : SUNDER_OK;
    if (!status && looks) status = sunder_i_foresee(g->foresight, gap, gone, false, &verdict, &refuted, err);
    const sunder_i_supposition what = {.gap = gap, .gone = gone};
    if (!status && verdict == SUNDER_I_INFEASIBLE) note_in_vain(g->about, g->left);
    if (!status && verdict != SUNDER_I_INFEASIBLE)
        status = ask_question(g->questions, g->about, g->conflict, &what, g->left, &answer, err);
    *yes = answer.yes;
    return status;
}

/* Sets need_gone to the first of the features and barriers that block the conflict without which it has a solution. At
 * most g->questions->leaves of them are tried. */
static sunder_status need_gone(asked *g, sunder_error *err)
{
    sunder_conflict *c = g->conflict;
    bool yes = false;
    if (c->n_blocked_by == 0 || !sunder_i_patience_asks(&g->left->gone)) return SUNDER_OK;
    for (size_t k = 0; k < c->n_blocked_by && k < g->questions->leaves && !yes; k++) {
        const sunder_status status = try_gone(g, (uint32_t)c->blocked_by[k], &yes, err);
        if (status) return status;
        if (yes) c->need_gone = c->blocked_by[k];
    }
    sunder_i_patience_note(&g->left->gone, yes);
    return SUNDER_OK;
}

static size_t members_that_move(const sunder_i_model *model, size_t feature)
{
    const sunder_i_body *body = &model->body[model->body_of[feature]];
    return body->fixed ? 0 : body->members;
}

static sunder_status find_needs(const sunder_i_questions *g, sunder_conflict *c, budget *left, sunder_error *err)
{
    const sunder_i_model *model = &g->solver->model;
    sunder_i_surroundings a = {0};
    if (members_that_move(model, c->a) + members_that_move(model, c->b) > NEED_MOST) return SUNDER_OK;
    sunder_status status = sunder_i_surround(g->solver, c, &a, err);
    a.farthest =
        sunder_i_min(a.farthest, g->options->barrier_reach); /* barriers farther away were not read from the input */
    if (!status) status = need_shift(g, &a, c, left, err);
    asked one = {.questions = g, .about = &a, .conflict = c, .left = left, .high = g->options->gap, .all = true};
    if (!status) status = need_gap(&one, err);
    if (!status) status = need_gone(&one, err);
    look_ahead_no_more(&one);
    sunder_i_surroundings_clear(&a);
    return status;
}

/* ---- The conflicts of a cluster ---------------------------------------------------------------------------------- */

/* A conflict, as an index in the report, and the root of the cluster that it belongs to. */
typedef struct matter {
    uint32_t root, conflict;
} matter;

typedef struct asking {
    const sunder_i_questions *questions;
    const matter *matter;
    const size_t *first; /* [clusters + 1] the index of the first matter of each cluster, and the end */
    uint64_t most;       /* the number of features that may take part in failed questions about one cluster */
} asking;

/* Returns how many failed questions of a kind are allowed for a cluster. If a limit is already known that solves the
 * cluster as a whole, few of its pairs are examined by themselves. The other needs are then found for some of them
 * only, but most of them have neither a feature to remove nor a shorter limit. */
static sunder_i_patience patience_for(const asking *g, size_t cluster)
{
    bool known = false;
    for (size_t m = g->first[cluster]; m < g->first[cluster + 1] && !known; m++)
        known = !isnan(g->questions->report->conflict[g->matter[m].conflict].need_shift);
    return known ? sunder_i_patience_of(CROWD_PATIENCE, 0) : sunder_i_patience_of(NEED_PATIENCE, NEED_REGAINED);
}

static sunder_status ask_clusters(void *context, size_t begin, size_t end, sunder_error *err)
{
    const asking *g = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        const sunder_i_patience fresh = patience_for(g, k);
        budget left = {g->most, fresh, fresh, fresh, sunder_i_patience_of(PROOF_PATIENCE, NEED_REGAINED)};
        sunder_i_reading reading;
        sunder_i_reads_begin(&reading, &g->questions->solver->model, g->matter[g->first[k]].root);
        for (size_t m = g->first[k]; m < g->first[k + 1] && left.left && !status; m++)
            status = find_needs(g->questions, &g->questions->report->conflict[g->matter[m].conflict], &left, err);
        sunder_i_reads_end(&reading);
    }
    return status;
}

static int by_matter(const void *a, const void *b)
{
    const matter *p = a, *q = b;
    if (p->root != q->root) return p->root < q->root ? -1 : 1;
    return (p->conflict > q->conflict) - (p->conflict < q->conflict);
}

/* Lists the conflicts to examine in list[], grouped by cluster, and sets first[] to the index of the first conflict of
 * each cluster, followed by the end. Returns the number of clusters. */
static size_t group_by_cluster(const sunder_i_solver *s, const sunder_report *report, matter *list, size_t *first)
{
    const sunder_i_model *model = &s->model;
    size_t n = 0, groups = 0;
    for (size_t k = 0; k < report->conflicts; k++) {
        const sunder_conflict *c = &report->conflict[k];
        if (!is_asked_about(c)) continue;
        const uint32_t i = model->body_of[c->a], j = model->body_of[c->b];
        list[n++] = (matter){sunder_i_union_find(s->parent, model->body[i].fixed ? j : i), (uint32_t)k};
    }
    if (n) qsort(list, n, sizeof *list, by_matter);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || list[k].root != list[k - 1].root) first[groups++] = k;
    first[groups] = n;
    return groups;
}

sunder_status sunder_i_report_needs(sunder_report *report, const sunder_i_solver *solver,
                                    const sunder_layer_options *options, sunder_i_solve_layer solve, sunder_error *err)
{
    const double effort = sunder_i_min(ceil(options->effort), NEED_EFFORT);
    const sunder_i_questions g = {solver, report, options, solve, (int)effort, NEED_GONE * (size_t)effort};
    if (!(effort > 0)) return SUNDER_OK;
    matter *list = sunder_i_alloc(report->conflicts, sizeof *list);
    size_t *first = sunder_i_alloc(report->conflicts + 1, sizeof *first);
    sunder_status status = list && first ? keep_what_there_is(&g, err) : sunder_i_failure_cause(err);
    if (!status) {
        const size_t groups = group_by_cluster(solver, report, list, first);
        asking h = {&g, list, first, NEED_IN_VAIN * (uint64_t)effort};
        status = sunder_i_parallel(solver->model.rules.threads, groups, SUNDER_I_GRAIN_WHOLE, ask_clusters, &h, err);
    }
    sunder_i_free(list);
    sunder_i_free(first);
    return status;
}
