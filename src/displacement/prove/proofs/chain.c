/* A proof by chains of pushes: finds the forces of long chains directly, which branching would find one link at a time.
 *
 * If limits leave two pieces only one way past each other, every solution satisfies one inequality n.(t_j - t_i) >= d,
 * a *link*. Along a chain of links, each with a force of 1, the sum of program.c is the sum of all d, less the limits'
 * share at each body: L |n - n'| between two links, L at an end, 0 at a fixed thing. Let t be the moves of the result,
 * which satisfy every pair except the one in question. Then the sum equals the violation of that pair's own d, less
 *
 *     the slack n.(t_j - t_i) - d of each link,
 *     L |n - n'| - t.(n - n') at each body between two, and L - t.n at the end,
 *
 * none of which is negative. So the best chain from either end of the pair is a shortest path [Dij59], with potentials
 * as in [Joh77], and the search stops where the cost reaches the pair's violation: in a row without slack it ends at
 * once, in a row in its original place it ends with the row.
 *
 * Every half-plane that limits leave the pair needs its own chain. The proof has a node for each link, whose other
 * half-planes contradict the limits of its two bodies, and a leaf with the forces of the chain, summed as in every
 * proof; so a near miss is never called proved. Only links between bodies of the cluster are used, since the final
 * places of others are not known.
 *
 * Links at the ends of a chain that are not needed are dropped; a chain cannot do without an inner link. */
#include "displacement/prove/proofs/chain.h"
#include "displacement/layer/reads.h"
#include "displacement/prove/proofs/tuning.h"

#include "base/extremes.h"
#include "base/heap.h"
#include "base/watch.h"

#include <math.h>
#include <string.h>

static double dot_product(const double n[2], const double *u) { return n[0] * u[0] + n[1] * u[1]; }

/* ---- The cheapest chain from a body ------------------------------------------------------------------------------ */

static bool comes_before(const void *a, const void *b)
{
    const sunder_i_chain_entry *p = a, *q = b;
    return p->cost != q->cost ? p->cost < q->cost : p->link < q->link;
}

/* Returns the cost at a body that is pushed along n and pushes along m; with m NULL, at the end of the chain. */
static double turn_cost(const sunder_i_chains *g, uint32_t body, const double n[2], const double m[2])
{
    const double limit = sunder_i_limit_of(&g->of.model->body[body]);
    const double net[2] = {n[0] - (m ? m[0] : 0), n[1] - (m ? m[1] : 0)};
    double t[2];
    if (limit == 0) return 0;
    sunder_i_chains_stand(g, body, t);
    return sunder_i_max(0, limit * sqrt(dot_product(net, net)) - dot_product(net, t));
}

static bool is_pair(const sunder_i_chains *g, const sunder_i_chain_link *k, const sunder_i_subproblem *q)
{
    const uint32_t a = sunder_i_whole_of(g->of.model, k->a->feature), b = sunder_i_whole_of(g->of.model, k->b->feature);
    return (a == q->a && b == q->b) || (a == q->b && b == q->a);
}

/* Continues from a body that is pushed along n, through link `from`, to all bodies that it may push. Returns false if
 * memory is out. */
static bool push_on(sunder_i_chains *g, const sunder_i_subproblem *q, uint32_t body, const double n[2], uint32_t from,
                    double cost, double most)
{
    const double along[2] = {n[0], n[1]}; /* the array of links may be moved */
    if (sunder_i_limit_of(&g->of.model->body[body]) == 0) return true;
    const sunder_i_chain_links *of = sunder_i_chains_find(g, body);
    if (!of) return false;
    g->work += of->n;
    for (size_t k = of->first; k < of->first + of->n; k++) {
        const sunder_i_chain_link *l = &g->link[k];
        sunder_i_chain_step *step = &g->step[k];
        if (cost + l->spare >= most) continue;
        const double all = cost + l->spare + turn_cost(g, body, along, l->n);
        if (all >= most || (step->search == g->search && step->cost <= all) || is_pair(g, l, q)) continue;
        *step = (sunder_i_chain_step){all, from, g->search};
        if (!sunder_i_reserve(&g->heap, &g->heap_capacity, g->heap_n + 1, sizeof *g->heap)) return false;
        sunder_i_heap_push(g->heap, &g->heap_n, sizeof *g->heap, &(sunder_i_chain_entry){all, (uint32_t)k},
                           comes_before);
    }
    return true;
}

/* Finds the cheapest end of a chain that begins at a body pushed along n. *found is set if it costs less than *most,
 * which then becomes its cost; *last is its last link, or SUNDER_I_NO_LINK. Returns false if memory is out. */
static bool find_end(sunder_i_chains *g, const sunder_i_subproblem *q, uint32_t body, const double n[2], uint32_t *last,
                     double *most, bool *found)
{
    const uint64_t until = g->work + CHAIN_EFFORT;
    const double here = turn_cost(g, body, n, NULL);
    *last = SUNDER_I_NO_LINK;
    *found = here < *most;
    if (*found) *most = here;
    g->search++;
    g->heap_n = 0;
    if (!push_on(g, q, body, n, SUNDER_I_NO_LINK, 0, *most)) return false;
    while (g->heap_n && g->work < until) {
        sunder_i_chain_entry e;
        sunder_i_heap_pop(g->heap, &g->heap_n, sizeof e, &e, comes_before);
        if (e.cost >= *most) break;
        if (e.cost > g->step[e.link].cost) continue;
        const sunder_i_chain_link l = g->link[e.link];
        const double all = e.cost + turn_cost(g, l.j, l.n, NULL);
        if (all < *most) {
            *found = true;
            *last = e.link;
            *most = all;
        }
        if (!push_on(g, q, l.j, l.n, e.link, e.cost, *most)) return false;
    }
    return true;
}

/* ---- Both ends of a pair ----------------------------------------------------------------------------------------- */

/* The links on one side of the pair, from the pair on. end[k] is the cost of the chain of the first k links, so
 * `end[0]` is the cost of an empty chain. */
typedef struct half {
    uint32_t *link;
    double *end; /* [n + 1] */
    size_t n, capacity, end_capacity;
} half;

/* Stores the links up to `last`. Returns false if memory is out. */
static bool take_half(const sunder_i_chains *g, uint32_t body, const double n[2], uint32_t last, half *out)
{
    out->n = 0;
    for (uint32_t k = last; k != SUNDER_I_NO_LINK; k = g->step[k].from) out->n++;
    if (!sunder_i_reserve(&out->link, &out->capacity, out->n, sizeof *out->link) ||
        !sunder_i_reserve(&out->end, &out->end_capacity, out->n + 1, sizeof *out->end))
        return false;
    size_t left = out->n;
    for (uint32_t k = last; k != SUNDER_I_NO_LINK; k = g->step[k].from) {
        const sunder_i_chain_link *l = &g->link[k];
        out->end[left] = g->step[k].cost + turn_cost(g, l->j, l->n, NULL);
        out->link[--left] = k;
    }
    out->end[0] = turn_cost(g, body, n, NULL);
    return true;
}

/* Finds the fewest links of both halves whose chain costs less than `most`. Returns false if there are none. */
static bool shorten_chain(const half of[2], double most, size_t keep[2])
{
    const size_t all = of[0].n + of[1].n;
    for (size_t n = 0; n <= all; n++)
        for (size_t k = n > of[1].n ? n - of[1].n : 0; k <= n && k <= of[0].n; k++)
            if (of[0].end[k] + of[1].end[n - k] < most) {
                keep[0] = k;
                keep[1] = n - k;
                return true;
            }
    return false;
}

static bool append_links(sunder_i_pushing *chain, const half of[2], const size_t keep[2])
{
    chain->link = sunder_i_alloc(keep[0] + keep[1] + 1, sizeof *chain->link);
    if (!chain->link) return false;
    chain->right = keep[0];
    chain->n = keep[0] + keep[1];
    for (size_t e = 0; e < 2; e++)
        if (keep[e]) memcpy(chain->link + (e ? keep[0] : 0), of[e].link, keep[e] * sizeof *chain->link);
    return true;
}

/* Finds a chain for a half-plane of the pair's pieces; *found. Returns false if memory is out. */
static bool find_chain(sunder_i_chains *g, const sunder_i_subproblem *q, const sunder_i_chain_link *pair,
                       const sunder_i_half_plane *half_plane, half of[2], sunder_i_pushing *chain, bool *found)
{
    double s[2], t[2];
    sunder_i_chains_stand(g, pair->i, s);
    sunder_i_chains_stand(g, pair->j, t);
    const double missed = half_plane->d - (dot_product(half_plane->n, t) - dot_product(half_plane->n, s)),
                 back[2] = {-half_plane->n[0], -half_plane->n[1]};
    const double most = missed * (1 - CHAIN_MARGIN);
    double left = most;
    uint32_t last;
    *found = most > 0;
    for (size_t e = 0; e < 2 && *found; e++) {
        const uint32_t body = e ? pair->i : pair->j;
        const double *n = e ? back : half_plane->n;
        double cost = left;
        if (!find_end(g, q, body, n, &last, &cost, found)) return false;
        if (!*found) return true;
        left -= cost;
        if (!take_half(g, body, n, last, &of[e])) return false;
    }
    size_t keep[2];
    *found = *found && shorten_chain(of, most, keep) && keep[0] + keep[1] <= CHAIN_MOST;
    return !*found || append_links(chain, of, keep);
}

/* ---- The question ------------------------------------------------------------------------------------------------ */

typedef struct finding {
    sunder_i_chains *g;
    const sunder_i_subproblem *q;
    sunder_i_decision *decision;
    size_t *links;
    half half[2];
    sunder_i_half_plane *half_plane;
    sunder_i_pushing *chain;
    size_t half_plane_capacity, chain_capacity;
} finding;

/* May a relative move no longer than `reach` be in half-plane k and behind the lines of all open half-planes before it?
 * Each of these lines is tested alone. open[]: the answers for the half-planes before it. */
static bool is_open(const sunder_i_half_plane *half_plane, size_t k, const bool *open, double reach)
{
    bool is = sunder_i_chain_is_open(&half_plane[k], reach);
    for (size_t l = 0; l < k && is; l++)
        if (open[l]) is = sunder_i_chain_is_open_behind(&half_plane[k], &half_plane[l], reach);
    return is;
}

/* Are all links of a chain nearly on the same line? */
static bool is_straight(const sunder_i_chains *g, const sunder_i_half_plane *half_plane, const sunder_i_pushing *chain)
{
    bool is = true;
    for (size_t k = 0; k < chain->n && is; k++) {
        const double along = dot_product(half_plane->n, g->link[chain->link[k]].n);
        is = (k < chain->right ? along : -along) > CHAIN_STRAIGHT;
    }
    return is;
}

/* Tries to prove by chains that the pieces pair->a and pair->b of the pair cannot be separated: a chain has to
 * refute each half-plane of their obstacle that moves within the limits can reach (is_open()). Sets
 * f->decision->proof if each is refuted. Returns false if memory is out. */
static bool ask_pieces(finding *f, const sunder_i_chain_link *pair)
{
    sunder_i_chains *g = f->g;
    const sunder_i_model *model = g->of.model;
    const sunder_i_body *p = &model->body[pair->i], *r = &model->body[pair->j];
    const double reach = sunder_i_limit_of(p) + sunder_i_limit_of(r);
    sunder_i_branching *c = &g->branching;
    const size_t n = sunder_i_branching_fill_half_planes(c, p, pair->a, r, pair->b, pair->clearance, false, NULL);
    if (c->failed || !sunder_i_reserve(&f->half_plane, &f->half_plane_capacity, n, sizeof *f->half_plane) ||
        !sunder_i_reserve(&f->chain, &f->chain_capacity, n + 1, sizeof *f->chain))
        return false;
    if (n) memcpy(f->half_plane, c->scratch, n * sizeof *f->half_plane);
    sunder_i_chain_only_half_plane(f->half_plane, n, reach);
    bool *open = sunder_i_calloc(n + 1, sizeof *open), ok = open != NULL, found = n > 0;
    size_t chains = 0;
    for (size_t k = 0; k < n && ok && found; k++) {
        open[k] = is_open(f->half_plane, k, open, reach);
        if (!open[k]) continue;
        f->chain[chains] = (sunder_i_pushing){.half_plane = k};
        ok = g->all ? sunder_i_chain_fewest(g, pair, &f->half_plane[k], &f->chain[chains], &found)
                    : find_chain(g, f->q, pair, &f->half_plane[k], f->half, &f->chain[chains], &found);
        if (ok && found) chains++;
    }
    bool failed = false;
    f->chain[chains] = (sunder_i_pushing){.half_plane = SIZE_MAX};
    if (ok && found)
        f->decision->proof = sunder_i_chain_prove(g, f->q, pair, f->half_plane, n, f->chain, chains, &failed);
    for (size_t k = 0; k < chains; k++) {
        if (f->decision->proof && f->chain[k].n > *f->links) *f->links = f->chain[k].n;
        if (f->decision->proof && chains == 1)
            f->decision->straight = is_straight(g, &f->half_plane[f->chain[0].half_plane], &f->chain[0]);
        sunder_i_free(f->chain[k].link);
    }
    sunder_i_free(open);
    return ok && !failed;
}

/* Tests all near pieces of things a and b until there is a proof. Returns false if memory is out. */
static bool ask_things(finding *f, uint32_t a, uint32_t b)
{
    const sunder_i_model *model = f->g->of.model;
    const uint32_t i = model->body_of[a], j = model->body_of[b];
    const sunder_i_body *p = &model->body[i], *r = &model->body[j];
    double clearance;
    f->g->of.a = f->q->a; /* the pair in question has to keep its full distance only here, not in links */
    f->g->of.b = f->q->b;
    const bool owe = sunder_i_branching_owe(&f->g->branching, a, b, &clearance);
    f->g->of.a = f->g->of.b = SUNDER_I_NOBODY;
    const sunder_i_body_pieces *of_p = sunder_i_pieces_of(model, p), *of_r = sunder_i_pieces_of(model, r);
    if (!of_p || !of_r) return false;
    for (uint32_t k = 0; k < p->pieces && owe; k++) {
        const sunder_i_body_piece *one = &of_p->piece[k];
        double box[4], s[2], t[2];
        sunder_i_chains_stand(f->g, i, s);
        sunder_i_chains_stand(f->g, j, t);
        for (uint32_t x = 0; x < 4; x++)
            box[x] = one->box[x] + (p->origin[x & 1] + s[x & 1] - r->origin[x & 1] - t[x & 1]) +
                     (x < 2 ? -model->rules.gap : model->rules.gap);
        for (uint32_t l = 0; l < r->pieces && one->feature == a && !f->decision->proof; l++) {
            const sunder_i_body_piece *other = &of_r->piece[l];
            f->g->work++;
            if (other->feature != b || !sunder_i_box_meet(box, other->box)) continue;
            const sunder_i_chain_link pair = {.i = i, .j = j, .a = one, .b = other, .clearance = clearance};
            if (!ask_pieces(f, &pair)) return false;
        }
    }
    return true;
}

/* Tests thing a with each part of the barrier that it can reach, by ask_things(), until there is a proof. Returns false
 * if memory is out. */
static bool ask_parts(finding *f, uint32_t a, uint32_t barrier)
{
    const sunder_i_model *model = f->g->of.model;
    sunder_i_list near = {0};
    double box[4];
    sunder_i_box_grow(sunder_i_home_box(model, a),
                      sunder_i_limit_of(&model->body[model->body_of[a]]) + model->rules.gap, box);
    bool ok = sunder_i_look_about(model, &model->tree, box, &near);
    near.n = sunder_i_set_make(near.item, near.n);
    for (size_t k = 0; k < near.n && ok && !f->decision->proof; k++)
        if (sunder_i_is_barrier(model, near.item[k]) && sunder_i_whole_of(model, near.item[k]) == barrier)
            ok = ask_things(f, a, near.item[k]);
    sunder_i_free(near.item);
    return ok;
}

sunder_status sunder_i_chains_decide(sunder_i_chains *chains, const sunder_i_subproblem *subproblem,
                                     sunder_i_decision *decision, size_t *links, sunder_error *err)
{
    const sunder_i_model *model = chains->of.model;
    finding f = {.g = chains, .q = subproblem, .decision = decision, .links = links};
    const uint64_t before = chains->work + sunder_i_branching_work(&chains->branching);
    *decision = (sunder_i_decision){.verdict = SUNDER_I_UNKNOWN};
    *links = 0;
    const bool stands = model->body[model->body_of[subproblem->a]].fixed;
    const bool ok = sunder_i_is_barrier(model, subproblem->b) ? ask_parts(&f, subproblem->a, subproblem->b)
                                                              : ask_things(&f, stands ? subproblem->b : subproblem->a,
                                                                           stands ? subproblem->a : subproblem->b);
    if (decision->proof) decision->verdict = SUNDER_I_INFEASIBLE;
    decision->work = chains->work + sunder_i_branching_work(&chains->branching) - before;
    for (size_t e = 0; e < 2; e++) {
        sunder_i_free_all(f.half[e].link, f.half[e].end);
    }
    sunder_i_free_all(f.half_plane, f.chain);
    return ok && sunder_i_look() ? SUNDER_OK : sunder_i_failure_cause(err);
}

/* ---- The chains of a cluster ------------------------------------------------------------------------------------- */

sunder_i_chains *sunder_i_chains_new(const sunder_i_subproblem *cluster, bool all)
{
    sunder_i_chains *g = sunder_i_calloc(1, sizeof *g);
    if (!g) return NULL;
    g->of = *cluster;
    g->of.a = g->of.b = SUNDER_I_NOBODY;
    g->of.coarse = CHAIN_COARSE;
    g->all = all;
    g->branching.subproblem = &g->of;
    g->branching.model = cluster->model;
    g->body = sunder_i_calloc(cluster->reserves, sizeof *g->body);
    if (g->body) return g;
    sunder_i_chains_free(g);
    return NULL;
}

void sunder_i_chains_free(sunder_i_chains *chains)
{
    if (!chains) return;
    sunder_i_free_all(chains->branching.scratch, chains->branching.near.item, chains->body, chains->link, chains->step,
                      chains->heap, chains);
}
