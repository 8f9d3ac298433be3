/* Is there no solution, or was none found? Pairs that were given up are looked at again, component by component of the
 * layer's conflicts (certify.c): either it is proved that limits and fixed features leave no room for all of them, or
 * there is a solution to go on from, or the question stays open. What is said of those that remain is for
 * verdicts.c. */
#include "displacement/clusters/settle.h"
#include "displacement/clusters/stages.h"
#include "displacement/layer/rounding.h"
#include "displacement/proofs/feasibility.h"

#include "base/parallel.h"
#include "base/union_find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How long a solution is looked for, in constraints looked at: so many for each body. Among more than these bodies none
 * was ever found, and the pairs are asked about one by one. */
#define EFFORT 100000u
#define MOST_BODIES 64

/* Conflicting pairs of bodies that hang together, and the bodies, ascending. */
typedef struct component {
    uint32_t root;
    const sunder_i_couple *pair;
    size_t pairs;
    const uint32_t *body;
    size_t bodies;
} component;

/* The layer's conflicts at the start, by components; a fixed body joins none. */
typedef struct components {
    uint32_t *parent; /* [bodies] */
    component *component;
    size_t n;
    sunder_i_couple *pair;
    uint32_t *body;
} components;

typedef struct rooted {
    uint32_t root;
    sunder_i_couple pair;
} rooted;

static int by_root(const void *a, const void *b)
{
    const rooted *p = a, *q = b;
    if (p->root != q->root) return p->root < q->root ? -1 : 1;
    if (p->pair.a != q->pair.a) return p->pair.a < q->pair.a ? -1 : 1;
    return p->pair.b < q->pair.b ? -1 : p->pair.b > q->pair.b;
}

static size_t list_pairs(const sunder_i_job *w, uint32_t *parent, rooted *list)
{
    const sunder_i_town *town = &w->town;
    size_t n = 0;
    sunder_i_union_init(parent, town->bodies);
    for (size_t k = 0; k < w->start.n; k++) {
        const sunder_i_relation *r = &w->start.pair[k];
        if (!sunder_i_job_is_conflict(town, r)) continue;
        const uint32_t i = town->body_of[r->a], j = town->body_of[r->b];
        if (town->body[i].fixed && town->body[j].fixed) continue;
        list[n++].pair = i < j ? (sunder_i_couple){i, j} : (sunder_i_couple){j, i};
        if (town->body[i].fixed || town->body[j].fixed) continue;
        sunder_i_union_join(parent, i, j);
    }
    for (size_t k = 0; k < n; k++) {
        const sunder_i_couple c = list[k].pair;
        list[k].root = sunder_i_union_find(parent, town->body[c.a].fixed ? c.b : c.a);
    }
    if (n) qsort(list, n, sizeof *list, by_root);
    size_t out = 0;
    for (size_t k = 0; k < n; k++)
        if (k == 0 || by_root(&list[out - 1], &list[k])) list[out++] = list[k];
    return out;
}

static void free_components(components *c)
{
    sunder_i_free(c->parent);
    sunder_i_free(c->component);
    sunder_i_free(c->pair);
    sunder_i_free(c->body);
}

static sunder_status find_components(const sunder_i_job *w, components *out, sunder_error *err)
{
    const size_t most = w->start.n;
    *out = (components){.parent = sunder_i_alloc(w->town.bodies, sizeof *out->parent),
                        .component = sunder_i_alloc(most, sizeof *out->component),
                        .pair = sunder_i_alloc(most, sizeof *out->pair),
                        .body = sunder_i_alloc(2 * most, sizeof *out->body)};
    rooted *list = sunder_i_alloc(most, sizeof *list);
    if (!out->parent || !out->component || !out->pair || !out->body || !list) {
        sunder_i_free(list);
        return sunder_i_no_memory(err);
    }
    const size_t n = list_pairs(w, out->parent, list);
    for (size_t first = 0, end; first < n; first = end) {
        uint32_t *body = out->body + 2 * first;
        for (end = first; end < n && list[end].root == list[first].root; end++) {
            out->pair[end] = list[end].pair;
            memcpy(body + 2 * (end - first), &list[end].pair, 2 * sizeof *body);
        }
        const size_t bodies = sunder_i_set_make(body, 2 * (end - first));
        out->component[out->n++] = (component){list[first].root, out->pair + first, end - first, body, bodies};
    }
    sunder_i_free(list);
    return SUNDER_OK;
}

/* ---- Looking again ----------------------------------------------------------------------------------------------- */

typedef struct asking {
    const sunder_i_job *job;
    const component *component;
    const bool *asked; /* [components] */
    const sunder_i_held *held;
    size_t held_n;
    sunder_i_answer *answer;
} asking;

/* The component's bodies and those that the search found it to hang together with, ascending. */
static sunder_status gather_bodies(const sunder_i_job *w, const component *c, uint32_t **body, size_t *n,
                                   sunder_error *err)
{
    size_t more;
    const uint32_t *member = sunder_i_job_members(w, sunder_i_union_find(w->parent, c->root), &more);
    *body = sunder_i_alloc(c->bodies + more, sizeof **body);
    if (!*body) return sunder_i_no_memory(err);
    memcpy(*body, c->body, c->bodies * sizeof **body);
    if (more) memcpy(*body + c->bodies, member, more * sizeof **body);
    *n = sunder_i_set_make(*body, c->bodies + more);
    return SUNDER_OK;
}

static sunder_status certify_some(void *context, size_t begin, size_t end, sunder_error *err)
{
    const asking *g = context;
    sunder_status status = SUNDER_OK;
    for (size_t k = begin; k < end && !status; k++) {
        const component *c = &g->component[k];
        uint32_t *body = NULL;
        size_t n = 0;
        if (!g->asked[k]) continue;
        status = gather_bodies(g->job, c, &body, &n, err);
        const sunder_i_question question = {.town = &g->job->town,
                                            .body = body,
                                            .bodies = n,
                                            .a = SUNDER_I_NOBODY,
                                            .b = SUNDER_I_NOBODY,
                                            .held = g->held,
                                            .held_n = g->held_n,
                                            .effort = EFFORT * (uint64_t)n,
                                            .most = MOST_BODIES};
        if (!status) status = sunder_i_certify(&question, &g->answer[k], err);
        sunder_i_free(body);
    }
    return status;
}

static void mark(const components *all, const sunder_i_town *town, uint32_t body, bool *by_root_of)
{
    if (!town->body[body].fixed) by_root_of[sunder_i_union_find(all->parent, body)] = true;
}

/* What is hopeless is held to the clearance of its truce; ascending, as truces are. */
static size_t list_held(const sunder_i_town *town, sunder_i_held *held)
{
    size_t n = 0;
    for (size_t k = 0; k < town->truces.n; k++) {
        const sunder_i_truce *t = &town->truces.item[k];
        const double shift = hypot(t->shift[0], t->shift[1]);
        if (!t->hopeless) continue;
        held[n++] = (sunder_i_held){t->a, t->b, t->inside ? -INFINITY : shift > 0 ? -shift : t->gap};
    }
    return n;
}

/* Components in which a pair was given up. */
static sunder_status ask(const sunder_i_job *w, const components *all, bool *asked, sunder_error *err)
{
    const sunder_i_town *town = &w->town;
    bool *root = sunder_i_calloc(town->bodies, sizeof *root);
    if (!root) return sunder_i_no_memory(err);
    for (size_t k = 0; k < town->given_n; k++) {
        mark(all, town, town->given[k].a, root);
        mark(all, town, town->given[k].b, root);
    }
    for (size_t k = 0; k < all->n; k++)
        asked[k] = root[all->component[k].root] && w->standing[all->component[k].root] == SUNDER_I_UNASKED;
    sunder_i_free(root);
    return SUNDER_OK;
}

/* Lets no pair of these bodies be given up any longer. */
static bool take_back(sunder_i_town *town, const sunder_i_solution *s)
{
    size_t out = 0;
    for (size_t k = 0; k < town->given_n; k++)
        if (!sunder_i_set_has(s->body, s->bodies, town->given[k].a) &&
            !sunder_i_set_has(s->body, s->bodies, town->given[k].b))
            town->given[out++] = town->given[k];
    town->given_n = out;
    out = 0;
    for (size_t k = 0; k < town->truces.n; k++) {
        const sunder_i_truce *t = &town->truces.item[k];
        if (t->hopeless || (!sunder_i_set_has(s->body, s->bodies, town->body_of[t->a]) &&
                            !sunder_i_set_has(s->body, s->bodies, town->body_of[t->b])))
            town->truces.item[out++] = *t;
    }
    town->truces.n = out;
    return sunder_i_truces_index(&town->truces, town);
}

/* Puts the bodies where the solution has them; what it moved becomes one cluster. */
static bool go_on_from(sunder_i_job *w, const component *c, const sunder_i_solution *s)
{
    bool ok = take_back(&w->town, s);
    for (size_t k = 0; k < s->bodies; k++) {
        const uint32_t b = s->body[k];
        double move[2];
        if (w->town.body[b].fixed) continue;
        sunder_i_round_move(&w->town, b, s->move + 2 * k, move, NULL);
        sunder_i_job_place(w, b, move);
        if ((move[0] != 0 || move[1] != 0) && b != c->root) ok = ok && sunder_i_job_add_edge(w, c->root, b);
    }
    return ok;
}

sunder_status sunder_i_job_reconsider(sunder_i_job *w, bool *changed, sunder_error *err)
{
    *changed = false;
    if (w->town.given_n == 0) return SUNDER_OK;
    components all;
    sunder_status status = find_components(w, &all, err);
    if (!status) status = sunder_i_job_gather(w, err);
    bool *asked = sunder_i_calloc(all.n, sizeof *asked);
    sunder_i_answer *answer = sunder_i_calloc(all.n, sizeof *answer);
    sunder_i_held *held = sunder_i_alloc(w->town.truces.n, sizeof *held);
    if (!status && (!asked || !answer || !held)) status = sunder_i_no_memory(err);
    if (!status) status = ask(w, &all, asked, err);
    if (!status) {
        asking g = {w, all.component, asked, held, list_held(&w->town, held), answer};
        status = sunder_i_parallel(w->town.rules.threads, all.n, 1, certify_some, &g, err);
    }
    if (!status) memset(w->changed, 0, w->town.features * sizeof *w->changed);
    for (size_t k = 0; k < all.n && !status; k++) {
        unsigned char *standing = &w->standing[all.component[k].root];
        if (asked[k] && answer[k].verdict != SUNDER_I_SOLVED) *standing = SUNDER_I_LEFT;
        if (answer[k].verdict != SUNDER_I_SOLVED) continue;
        *changed = true;
        if (!go_on_from(w, &all.component[k], &answer[k].solution)) status = sunder_i_no_memory(err);
    }
    for (size_t k = 0; k < all.n && answer; k++) sunder_i_answer_clear(&answer[k]);
    sunder_i_free(asked);
    sunder_i_free(answer);
    sunder_i_free(held);
    free_components(&all);
    return !status && *changed ? sunder_i_job_check(w, err) : status;
}
