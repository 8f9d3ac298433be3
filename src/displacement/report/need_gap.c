/* Finds need_gap: the largest gap, up to that of the layer, with which a conflict and its neighbours have a solution.
 *
 * The largest gap is enclosed. The lower end is the gap of a layout of the small layer about the conflict that was
 * checked exactly (question.c). The upper end is proved: a branch and bound that finds no solution for a gap also
 * refutes some smaller gaps (prove/proofs/least_gap.c). Proofs take much less time than searches, so the interval is
 * first narrowed to 1 / NEED_GAP_PARTS of the layer's gap by proofs alone, and one layout confirms its lower end. If it
 * does not, other gaps are tried. Each solution that holds is the layout near which the next one is looked for: for a
 * slightly larger gap, the features mostly stand to the same sides of each other. */
#include "displacement/report/need_gap.h"
#include "displacement/layer/barrier_pairs.h"
#include "displacement/layer/resolution.h"
#include "displacement/report/tuning.h"

#include "base/extremes.h"

#include <math.h>

/* ---- A gap that there is in the result --------------------------------------------------------------------------- */

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
    if (c->kind == SUNDER_CONFLICT_TOO_CLOSE) {
        /* Neighbours in a row are moved apart along it unless they kept the gap at the start. */
        const sunder_i_body *body = &s->model.body[s->model.body_of[c->a]];
        const bool in_row = body->has->row_sides && sunder_i_row_side_of(&s->model, body, s->model.body_of[c->b]);
        return sunder_i_max(0, nextafter(in_row ? sunder_i_min(c->distance, c->before) : c->distance, -INFINITY));
    }
    if (c->kind != SUNDER_CONFLICT_BARRIER_NEAR) return -1;
    const double gap = sunder_i_gap_of(&s->model, (uint32_t)c->a, (uint32_t)c->b), width = c->required - gap;
    /* The last term covers three roundings, and those of c->distance and c->required. */
    return c->distance - width - 0x1p-50 * (c->distance + c->required + gap);
}

/* For each pair, takes the least gap that the pair and all remaining pairs of its two bodies keep in the result. With
 * that gap the result itself is a solution for the pair and its neighbours, so it becomes need_gap without a question,
 * if it is at least 0 and less than the requested gap. */
sunder_status sunder_i_keep_gaps_there_are(const sunder_i_questions *questions, sunder_error *err)
{
    const sunder_i_model *model = &questions->solver->model;
    sunder_report *report = questions->report;
    double *least = sunder_i_alloc(model->bodies, sizeof *least);
    if (!least) return sunder_i_failure_cause(err);
    for (size_t b = 0; b < model->bodies; b++) least[b] = INFINITY;
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < report->conflicts; k++) {
            sunder_conflict *c = &report->conflict[k];
            if (!sunder_i_is_asked_about(c)) continue;
            double gap = gap_of(questions->solver, c),
                   *of[2] = {&least[model->body_of[c->a]], &least[model->body_of[c->b]]};
            for (int e = 0; e < 2; e++) {
                if (model->body[model->body_of[e ? c->b : c->a]].fixed) continue;
                if (pass == 0)
                    *of[e] = sunder_i_min(*of[e], gap);
                else
                    gap = sunder_i_min(gap, *of[e]);
            }
            if (pass == 0 || !(gap >= 0 && gap < questions->options->gap)) continue;
            c->need_gap = gap;
            c->need_gap_most = questions->options->gap;
        }
    sunder_i_free(least);
    return SUNDER_OK;
}

/* ---- Two by themselves ------------------------------------------------------------------------------------------- */

/* Returns the sum of the limits of the conflict's two features, or the limit of its feature if the other is a
 * barrier. */
static double reach_of(const sunder_i_model *model, const sunder_conflict *c)
{
    const double limit = sunder_i_limit_of(&model->body[model->body_of[c->a]]);
    return c->b < model->features ? limit + sunder_i_limit_of(&model->body[model->body_of[c->b]]) : limit;
}

/* Computes the least relative move with which the pair keeps `gap`, or its own gap if that is less: *least is a proved
 * lower bound of its length, *length the length found. */
static sunder_status least_for_gap(const sunder_i_model *model, const sunder_conflict *c, double gap, double *least,
                                   double *length, sunder_error *err)
{
    const double own = sunder_i_gap_of(model, (uint32_t)c->a, (uint32_t)c->b);
    if (c->b < model->features) {
        sunder_i_resolution way;
        const sunder_status status =
            sunder_i_resolve(&model->rules, sunder_i_min(gap, own), sunder_i_thing_shape(model, c->a),
                             sunder_i_thing_shape(model, c->b), INFINITY, &way, err);
        *least = way.least;
        *length = hypot(way.away[0], way.away[1]);
        return status;
    }
    const uint32_t barrier = (uint32_t)c->b;
    const sunder_i_translate home = sunder_i_at_home(model, (uint32_t)c->a);
    const double owed = sunder_i_owed_below(model, (uint32_t)c->a, barrier);
    sunder_separation way = {0};
    bool beyond;
    const sunder_status status = sunder_i_barrier_least(
        model, &home, barrier, sunder_i_max(0, owed - own + sunder_i_min(gap, own)), INFINITY, &way, &beyond, err);
    *least = way.lower_bound;
    *length = way.distance;
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

/* Returns whether the small layer contains no feature or barrier other than the two of the conflict. */
static bool are_alone(const sunder_i_model *model, const sunder_i_surroundings *a, const sunder_conflict *c)
{
    bool alone = a->feature.n == (c->b < model->features ? 2 : 1);
    for (size_t k = 0; k < a->part.n && alone; k++) alone = sunder_i_whole_of(model, a->part.item[k]) == c->b;
    return alone;
}

/* ---- The interval ------------------------------------------------------------------------------------------------ */

/* The search for the largest gap of one conflict. The lower end of the interval is need_gap of the conflict (NAN: no
 * solution is known). */
typedef struct gap_search {
    sunder_i_inquiry *inquiry;
    sunder_conflict *conflict;
    double step;   /* the width of the interval that is aimed at */
    double high;   /* larger gaps are not examined any more */
    double proved; /* larger gaps are proved to have no solution; INFINITY if nothing is proved */
    bool all;      /* answers also have to solve the other listed pairs in the small layer, if these are few */
    bool tight;    /* a solution in real numbers did not hold in doubles */
    bool cramped;  /* no gap at all has a solution with room for rounding */
} gap_search;

static sunder_i_supposition suppose(const gap_search *g, double gap)
{
    return (sunder_i_supposition){.gap = gap, .gone = SUNDER_I_NOBODY, .all = g->all};
}

static void refute(gap_search *g, double from)
{
    g->proved = sunder_i_min(g->proved, from);
    g->high = sunder_i_min(g->high, from);
}

static bool is_narrow(const gap_search *g) { return g->high - g->conflict->need_gap <= g->step; }

/* Asks whether a search finds a solution with this gap, and stores the answer: need_gap if there is one, otherwise the
 * upper end `high`. With `proofs`, a proof that the search would fail is looked for first. */
static sunder_status try_gap(gap_search *g, double gap, bool proofs, bool *yes, sunder_error *err)
{
    const sunder_i_supposition what = suppose(g, gap);
    sunder_i_answer answer = {.layout = sunder_i_calloc(2 * g->inquiry->about->feature.n, sizeof *answer.layout)};
    sunder_status status = answer.layout ? SUNDER_OK : sunder_i_failure_cause(err);
    if (!status && proofs) status = sunder_i_inquiry_search(g->inquiry, &what, &answer, err);
    if (!status && !proofs) status = sunder_i_inquiry_ask(g->inquiry, &what, false, &answer, err);
    *yes = !status && answer.yes;
    if (*yes && g->inquiry->foresight) sunder_i_foresight_note(g->inquiry->foresight, answer.layout);
    sunder_i_free(answer.layout);
    if (status) return status;
    if (answer.yes)
        g->conflict->need_gap = gap;
    else
        g->high = sunder_i_min(g->high, answer.refuted);
    return SUNDER_OK;
}

/* Asks whether proofs refute this gap, or find a solution in real numbers. */
static sunder_status foresee(gap_search *g, double gap, sunder_i_foresight_mode mode, sunder_i_verdict *verdict,
                             sunder_error *err)
{
    const sunder_i_supposition what = suppose(g, gap);
    double refuted;
    const sunder_status status = sunder_i_foresee(g->inquiry->foresight, &what, mode, verdict, &refuted, err);
    if (!status && *verdict == SUNDER_I_INFEASIBLE) refute(g, refuted);
    if (mode == SUNDER_I_FORESEE_WITH_ROOM && refuted < gap * NEED_ROOM) g->cramped = true;
    return status;
}

/* Narrows the interval in which the largest gap lies to the step, by proofs. *low is raised to gaps for which there is
 * a solution in real numbers (with `in_plane`: to gaps that are not refuted). The upper end, which begins at `high`, is
 * lowered to gaps that are refuted, or of which nothing is known. */
static sunder_status narrow_gap(gap_search *g, bool in_plane, double *low, double high, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    while (!status && high > 0 && high - *low > g->step * NEED_GAP_AIM) {
        const double next = *low < 0 ? 0 : *low + NEED_GAP_AT * (high - *low);
        sunder_i_verdict verdict;
        status = foresee(g, next, in_plane ? SUNDER_I_FORESEE_IN_PLANE : SUNDER_I_FORESEE, &verdict, err);
        if (!status && verdict == SUNDER_I_FEASIBLE && g->tight)
            status = foresee(g, next, SUNDER_I_FORESEE_WITH_ROOM, &verdict, err);
        if (verdict == SUNDER_I_FEASIBLE || (in_plane && verdict == SUNDER_I_UNKNOWN))
            *low = next;
        else
            high = sunder_i_min(next, g->high);
    }
    return status;
}

/* Tests whether the solution in real numbers that was found for the gap `seen` is also one in doubles, with a gap that
 * is smaller by the share NEED_LESS. If so, sets *yes, and need_gap to that gap. */
static sunder_status try_foreseen(gap_search *g, double seen, bool *yes, sunder_error *err)
{
    const sunder_i_supposition what = suppose(g, seen * (1 - NEED_LESS));
    const sunder_status status = sunder_i_foresight_holds(g->inquiry->foresight, g->conflict, &what, yes, err);
    if (!status && *yes) g->conflict->need_gap = what.gap;
    return status;
}

/* Asks the proofs about this gap. If they find a solution in real numbers, tests whether it holds in doubles (*yes); if
 * it does not, asks for one that demands more, and tests that. */
static sunder_status confirm(gap_search *g, double gap, sunder_i_verdict *verdict, bool *yes, sunder_error *err)
{
    sunder_i_verdict closely = SUNDER_I_UNKNOWN;
    *yes = false;
    sunder_status status = foresee(g, gap, SUNDER_I_FORESEE, verdict, err);
    if (!status && *verdict == SUNDER_I_FEASIBLE) status = try_foreseen(g, gap, yes, err);
    g->tight = !status && *verdict == SUNDER_I_FEASIBLE && !*yes;
    if (g->tight) status = foresee(g, gap, SUNDER_I_FORESEE_WITH_ROOM, &closely, err);
    if (!status && closely == SUNDER_I_FEASIBLE) status = try_foreseen(g, gap, yes, err);
    return status;
}

/* Sets *yes to whether a solution is found with this gap, or with one smaller by the share NEED_LESS: by proofs,
 * which may take more effort the second time, or, if these have no answer, by a search. If a solution in real numbers
 * does not hold in doubles, a search is not made: one in 30 of such searches succeeded. With `careful`, if no solution
 * with any gap is known yet, a search for one without a gap comes first, and *yes is false if it fails; also if no gap
 * leaves room for rounding, when all such searches failed. */
static sunder_status settle_gap(gap_search *g, double gap, bool careful, bool *yes, sunder_error *err)
{
    sunder_i_foresight *f = g->inquiry->foresight;
    sunder_i_verdict verdict = SUNDER_I_UNKNOWN;
    *yes = false;
    sunder_status status = f ? confirm(g, gap, &verdict, yes, err) : SUNDER_OK;
    if (!status && f && verdict == SUNDER_I_UNKNOWN) {
        f->patient = true;
        status = confirm(g, gap, &verdict, yes, err);
        f->patient = false;
    }
    if (status || *yes || verdict == SUNDER_I_INFEASIBLE) return status;
    if (g->cramped && isnan(g->conflict->need_gap)) {
        g->high = 0;
        return SUNDER_OK;
    }
    if (careful && isnan(g->conflict->need_gap) && gap > 0) {
        bool any;
        status = try_gap(g, 0, true, &any, err);
        if (status || !any) return status;
    }
    if (verdict == SUNDER_I_UNKNOWN || (careful && gap == 0)) return try_gap(g, gap * (1 - NEED_LESS), !f, yes, err);
    g->high = sunder_i_min(g->high, gap);
    return SUNDER_OK;
}

/* ---- The search -------------------------------------------------------------------------------------------------- */

/* For a pair without neighbours: the largest gap that the two could keep within their limits is the answer, reduced by
 * the small margin that the search keeps to limits, or by half a step if that is still too large. */
static sunder_status try_gap_of_pair(gap_search *g, sunder_error *err)
{
    const sunder_i_solver *solver = g->inquiry->questions->solver;
    const sunder_conflict *c = g->conflict;
    double does, above;
    bool yes = false;
    if (reach_of(&solver->model, c) == INFINITY || !is_about_gap(solver, c)) return SUNDER_OK;
    sunder_status status = gap_of_pair(&solver->model, c, g->high, g->step / 2, &does, &above, err);
    if (status) return status;
    refute(g, sunder_i_max(above, 0));
    if (!(does > 0) || c->need_gap >= does) return SUNDER_OK;
    status = try_gap(g, does * (1 - 0x1p-20), true, &yes, err);
    if (!status && !yes && does > g->step / 2) status = try_gap(g, does - g->step / 2, true, &yes, err);
    return status;
}

/* If there are few other listed pairs, asks whether a solution without a gap solves them as well. If it does, larger
 * gaps have to do so too: g->all is set accordingly. */
static sunder_status try_no_gap_of_all(gap_search *g, sunder_error *err)
{
    const gap_search before = *g;
    const sunder_i_inquiry *q = g->inquiry;
    bool few, yes = false;
    sunder_status status = sunder_i_few_are_listed(q->questions, q->about, g->conflict, &few, err);
    if (!status && few) status = try_gap(g, 0, true, &yes, err);
    if (status || yes) return status;
    *g = before; /* the answer was about a solution of all */
    g->all = false;
    return status;
}

/* Narrows the interval by proofs and confirms its lower end by a layout. First only the plane of the pair's relative
 * moves is examined, as if nothing else could move, which is mostly right. */
static sunder_status enclose(gap_search *g, sunder_error *err)
{
    const double first = isnan(g->conflict->need_gap) ? -g->step : g->conflict->need_gap, proved = g->proved;
    sunder_i_patience *proof = &g->inquiry->left->proof;
    double low = first;
    bool yes = false;
    if (!sunder_i_patience_asks(proof)) return SUNDER_OK;
    sunder_status status = sunder_i_inquiry_look_ahead(g->inquiry, 0, err);
    if (!status) status = narrow_gap(g, true, &low, g->high, err);
    if (!status && low > first) status = settle_gap(g, low, true, &yes, err);
    if (!status && low > first && !yes && g->high > 0) {
        low = sunder_i_max(first, g->conflict->need_gap);
        const double known = low;
        status = narrow_gap(g, false, &low, g->high, err);
        if (!status && low > known) status = settle_gap(g, low, true, &yes, err);
    }
    sunder_i_patience_note(proof, yes || g->proved < proved);
    return status;
}

/* Tries the middle of the interval between need_gap and g->high, at most NEED_GAP_HALVINGS times for each unit of
 * effort, until the interval is narrow. Each trial raises one end or lowers the other, if it gives an answer. */
static sunder_status halve(gap_search *g, sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (int k = 0; !status && k < NEED_GAP_HALVINGS * g->inquiry->questions->halvings && !is_narrow(g); k++) {
        const double gap = g->conflict->need_gap + (g->high - g->conflict->need_gap) / 2;
        bool yes;
        status = settle_gap(g, gap, true, &yes, err);
    }
    return status;
}

/* Returns number k, from 1 on, of the shares 1/2, 3/4, 1/4, 7/8, 3/8, 5/8, 1/8, 15/16, ... */
static double share_of(unsigned k)
{
    double share = 1, half = 0.5;
    for (; k; k >>= 1, half /= 2) share -= (k & 1) * half;
    return share;
}

/* Tries gaps between need_gap (0 if no solution is known) and the least gap that is refuted, until the interval is
 * narrow, or NEED_GAP_IN_VAIN tries for each unit of effort gave no answer. A try that gives an answer raises one end
 * of the interval or lowers the other. A search that fails at one gap often succeeds at a larger one, so after a try
 * without an answer gaps above and below it follow. */
static sunder_status try_gaps_between(gap_search *g, sunder_error *err)
{
    const sunder_i_questions *q = g->inquiry->questions;
    sunder_status status = SUNDER_OK;
    for (unsigned share = 1, vain = 0; !status && vain < NEED_GAP_IN_VAIN * (unsigned)q->halvings;) {
        const double low = sunder_i_max(0, g->conflict->need_gap), proved = g->proved,
                     high = sunder_i_min(proved, q->options->gap), gap = low + share_of(share) * (high - low);
        bool yes;
        if (high - low <= g->step || (g->cramped && isnan(g->conflict->need_gap))) break;
        status = settle_gap(g, gap, false, &yes, err);
        const bool answered = yes || g->proved < proved;
        share = answered ? 1 : share + 1;
        vain += !answered;
    }
    return status;
}

/* The result is also stored for a pair whose interval stays wide: need_gap and need_gap_most are then farther apart. */
sunder_status sunder_i_find_need_gap(sunder_i_inquiry *inquiry, sunder_error *err)
{
    sunder_conflict *c = inquiry->conflict;
    const sunder_i_questions *q = inquiry->questions;
    const double before = c->need_gap;
    const bool known = !isnan(before);
    gap_search g = {inquiry, c, q->options->gap / NEED_GAP_PARTS, q->options->gap, INFINITY, true, false, false};
    bool yes;
    sunder_status status = SUNDER_OK;
    if (!(g.step > 0) || (known && !sunder_i_patience_asks(&inquiry->left->gap))) return SUNDER_OK;
    if (are_alone(&q->solver->model, inquiry->about, c)) status = try_gap_of_pair(&g, err);
    if (!status && isnan(c->need_gap)) status = try_no_gap_of_all(&g, err);
    if (!status) status = enclose(&g, err);
    if (!status && isnan(c->need_gap) && g.high > 0) status = try_gap(&g, 0, true, &yes, err);
    if (!status && isnan(c->need_gap)) sunder_i_inquiry_note_in_vain(inquiry);
    if (!status && !isnan(c->need_gap)) status = halve(&g, err);
    const bool asks = inquiry->foresight && (known || sunder_i_patience_asks(&inquiry->left->gap));
    if (!status && asks) status = try_gaps_between(&g, err);
    if (status || isnan(c->need_gap)) {
        if (asks) sunder_i_patience_note(&inquiry->left->gap, false);
        return status;
    }
    c->need_gap_most = sunder_i_max(c->need_gap, sunder_i_min(g.proved, q->options->gap));
    if (known || asks) sunder_i_patience_note(&inquiry->left->gap, !known || c->need_gap > before);
    return status;
}
