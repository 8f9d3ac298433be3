/* Which pairs to ask for once more: the relaxed pairs of bodies that might have a solution, by cluster. */
#include "displacement/layer/reads.h"
#include "displacement/solve/clusters/cluster_stages.h"

#include "base/extremes.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>

/* A relaxation of the model, with its cluster and its two bodies. */
typedef struct claim {
    uint32_t root;
    sunder_i_id_pair body;
    uint32_t relaxation;
} claim;

typedef struct retries {
    sunder_i_retry *retry; /* [n] cluster after cluster, in the order in which they are tried */
    size_t n;
    uint32_t *relaxation; /* indices into the model's relaxations, to which the requests refer */
} retries;

/* Orders requests of a cluster: overlaps first, then by the move that is needed. */
static int by_ease(const void *a, const void *b)
{
    const sunder_i_retry *p = a, *q = b;
    if (p->root != q->root) return p->root < q->root ? -1 : 1;
    if (p->overlap != q->overlap) return p->overlap ? -1 : 1;
    if (p->missing != q->missing) return p->missing < q->missing ? -1 : 1;
    const int order = sunder_i_by_id_pair(&p->body, &q->body);
    return order ? order : (p->single > q->single) - (p->single < q->single);
}

static size_t list_claims(const sunder_i_solver *s, claim *list)
{
    const sunder_i_model *model = &s->model;
    size_t n = 0;
    for (size_t k = 0; k < model->relaxations.n; k++) {
        const uint32_t i = model->body_of[model->relaxations.item[k].a],
                       j = model->body_of[model->relaxations.item[k].b];
        if (model->body[i].fixed && model->body[j].fixed) continue;
        const uint32_t root = sunder_i_union_find(s->parent, model->body[i].fixed ? j : i);
        if (!sunder_i_solver_has_member(s, root, i) || !sunder_i_solver_has_member(s, root, j)) continue;
        list[n++] = (claim){root, i < j ? (sunder_i_id_pair){i, j} : (sunder_i_id_pair){j, i}, (uint32_t)k};
    }
    if (n) qsort(list, n, sizeof *list, sunder_i_by_id_quadruple);
    return n;
}

/* Makes the request to end the n relaxations between two bodies. */
static sunder_i_retry retry_of(const sunder_i_model *model, const claim *c, const uint32_t *relaxation, size_t n)
{
    sunder_i_retry x = {.root = c->root, .body = c->body, .relaxation = relaxation, .relaxations = n};
    double deepest = 0;
    for (size_t k = 0; k < n; k++) {
        const sunder_i_relaxation *t = &model->relaxations.item[relaxation[k]];
        const double depth = hypot(t->shift[0], t->shift[1]);
        x.resolve = x.resolve || !t->infeasible;
        x.disjoint = x.disjoint || sunder_i_can_be_disjoint(model, t);
        deepest = sunder_i_max(deepest, depth);
        if (!(depth > 0)) x.missing = sunder_i_max(x.missing, sunder_i_owed_above(model, t->a, t->b) - t->gap);
    }
    x.overlap = deepest > 0;
    if (x.overlap) x.missing = deepest;
    return x;
}

static void add_retry(retries *out, const sunder_i_retry *x)
{
    if (x->resolve || x->disjoint) out->retry[out->n++] = *x;
}

/* Makes, for each two bodies, one request for all relaxations between them; and if there are several, one for each of
 * these, since they may not all have a solution together. False if memory is out. */
static bool list_retries(const sunder_i_solver *s, retries *out)
{
    const size_t most = s->model.relaxations.n;
    claim *list = sunder_i_alloc(most, sizeof *list);
    out->retry = sunder_i_alloc(2 * most, sizeof *out->retry);
    out->relaxation = sunder_i_alloc(most, sizeof *out->relaxation);
    const bool ok = list && out->retry && out->relaxation;
    const size_t n = ok ? list_claims(s, list) : 0;
    for (size_t k = 0; k < n; k++) out->relaxation[k] = list[k].relaxation;
    for (size_t first = 0, end; first < n; first = end) {
        const claim *c = &list[first];
        for (end = first; end < n && list[end].root == c->root && !sunder_i_by_id_pair(&list[end].body, &c->body);)
            end++;
        sunder_i_retry x = retry_of(&s->model, c, out->relaxation + first, end - first);
        add_retry(out, &x);
        for (size_t k = first; k < end && end - first > 1; k++) {
            x = retry_of(&s->model, c, out->relaxation + k, 1);
            x.single = k - first + 1;
            add_retry(out, &x);
        }
    }
    if (out->n) qsort(out->retry, out->n, sizeof *out->retry, by_ease);
    sunder_i_free(list);
    return ok;
}

/* ---- Asking ------------------------------------------------------------------------------------------------------ */

/* The index of the first request of the cluster with this root, or of the next cluster. */
static size_t first_of(const retries *all, uint32_t root)
{
    const sunder_i_retry key = {.root = root};
    return sunder_i_lower_bound(&key, all->retry, all->n, sizeof key, sunder_i_by_number);
}

static sunder_status note_retried(const sunder_i_solver *s, sunder_i_cluster *c, double before, const double *move,
                                  sunder_error *err)
{
    const char *outcome = c->restored_n ? "pairs solved that were given up" : "no pair solved that was given up";
    const sunder_i_trace_step step = {NULL, "ask again", outcome, before,
                                      sunder_i_trace_cost(&s->model, c->body, c->n, move)};
    return sunder_i_trace_note(&c->log, &step) ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* A cluster in which nothing was given up since the last time is skipped: the result would be the same. */
static sunder_status retry_cluster(const sunder_i_solver *s, sunder_i_cluster *c, double *move, void *context,
                                   sunder_error *err)
{
    const retries *all = context;
    const uint32_t root = sunder_i_reader_for(s, c);
    const size_t first = first_of(all, root), last = first_of(all, root + 1);
    const double before = sunder_i_is_traced(&s->model) ? sunder_i_trace_cost(&s->model, c->body, c->n, move) : 0;
    c->outcome = SUNDER_I_WORKED_ON;
    if (first == last || !sunder_i_solver_any_of(s, c->body, c->n, sunder_i_is_to_retry)) return SUNDER_OK;
    const sunder_status status = sunder_i_cluster_retry(&s->model, c, all->retry + first, last - first, move, err);
    return status || !sunder_i_is_traced(&s->model) ? status : note_retried(s, c, before, move, err);
}

/* Adds edges for relaxed pairs whose overlap may be ended, though they cannot be resolved. False if memory is out. */
static bool join_relaxed(sunder_i_solver *s, const bool *asked)
{
    const sunder_i_model *model = &s->model;
    for (size_t k = 0; k < model->relaxations.relaxed_n; k++) {
        const sunder_i_relaxed_bodies *t = &model->relaxations.relaxed[k];
        if (!asked[t->i] && !asked[t->j]) continue;
        if (t->reach > 0 && t->reach <= sunder_i_limit_of(&model->body[t->i]) + sunder_i_limit_of(&model->body[t->j]) &&
            !sunder_i_solver_add_edge(s, t->i, t->j))
            return false;
    }
    return true;
}

/* Joins to the cluster of body b the movable bodies within `far` of it, except those that are in a cluster already, so
 * that clusters do not merge. alone: [bodies] in no cluster. False if memory is out. */
static bool join_about(sunder_i_solver *s, bool *alone, uint32_t b, double far, sunder_i_list *near)
{
    const sunder_i_model *model = &s->model;
    const sunder_i_body *p = &model->body[b];
    const double *t = model->move + 2 * (size_t)b, reach = model->rules.gap + far;
    double box[4];
    if (!sunder_i_may_move(p) || p->pieces == 0) return true;
    sunder_i_body_box(p, t, reach, box);
    near->n = 0;
    sunder_i_reading reading;
    sunder_i_reads_begin(&reading, model, b);
    const bool ok = sunder_i_look_about(model, model->standing, box, near);
    sunder_i_reads_end(&reading);
    if (!ok) return false;
    for (size_t k = 0; k < near->n; k++) {
        const uint32_t other = model->body_of[near->item[k]];
        if (!alone[other] || other == b) continue;
        if (!sunder_i_solver_add_edge(s, b, other)) return false;
        alone[other] = false;
    }
    return true;
}

/* Joins the bodies around pairs whose relaxation might end, since they may have to make way. False if memory is out. */
static bool join_neighbours(sunder_i_solver *s, const bool *asked)
{
    const sunder_i_model *model = &s->model;
    sunder_i_list near = {0};
    bool *alone = sunder_i_alloc(model->bodies, sizeof *alone), ok = alone != NULL;
    for (size_t b = 0; b < model->bodies && ok; b++) alone[b] = sunder_i_may_move(&model->body[b]);
    for (size_t e = 0; e < s->edges && ok; e++) alone[s->edge[e].a] = alone[s->edge[e].b] = false;
    for (size_t k = 0; k < model->relaxations.n && ok; k++) {
        const sunder_i_relaxation *t = &model->relaxations.item[k];
        const double depth = hypot(t->shift[0], t->shift[1]);
        const double missing = depth > 0 ? depth : sunder_i_owed_above(model, t->a, t->b) - t->gap;
        const uint32_t i = model->body_of[t->a], j = model->body_of[t->b];
        if ((!asked[i] && !asked[j]) || (t->infeasible && !sunder_i_can_be_disjoint(model, t))) continue;
        ok = join_about(s, alone, i, sunder_i_min(missing, sunder_i_limit_of(&model->body[i])), &near) &&
             join_about(s, alone, j, sunder_i_min(missing, sunder_i_limit_of(&model->body[j])), &near);
    }
    sunder_i_free_all(near.item, alone);
    return ok;
}

static sunder_status join_all(sunder_i_solver *s, sunder_error *err)
{
    bool *asked = sunder_i_solver_connected_with(s, sunder_i_is_to_retry);
    const bool ok = asked && join_relaxed(s, asked) && join_neighbours(s, asked);
    sunder_i_free(asked);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

sunder_status sunder_i_solver_retry(sunder_i_solver *solver, sunder_error *err)
{
    retries all = {0};
    if (solver->model.relaxations.n == 0) return SUNDER_OK;
    sunder_status status = join_all(solver, err);
    if (!status) status = sunder_i_solver_gather(solver, err);
    if (!status) status = sunder_i_solver_unite_blocks(solver, err);
    if (!status && !list_retries(solver, &all)) status = sunder_i_failure_cause(err);
    if (!status) status = sunder_i_solver_for_clusters(solver, NULL, retry_cluster, &all, err);
    sunder_i_free_all(all.retry, all.relaxation);
    if (!status) status = sunder_i_solver_trace_clusters(solver, err);
    if (!status) status = sunder_i_solver_commit(solver, err);
    if (!status) status = sunder_i_solver_take_relaxations(solver, err);
    return status ? status : sunder_i_solver_relate(solver, err);
}
