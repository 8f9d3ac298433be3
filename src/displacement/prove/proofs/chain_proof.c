/* Records a chain in the form of any other branch and bound: a node for each of its links. */
#include "displacement/prove/proofs/chain.h"

#include <string.h>

/* The state of building one branch of the tree. */
typedef struct builder {
    sunder_i_branching *c;
    sunder_i_claim *claim; /* the claims of the chain up to now */
    size_t claims, capacity;
    size_t root;
    size_t open; /* the half-plane below which the next node hangs; SIZE_MAX: it is the root */
} builder;

static void hang_node(builder *b, size_t node)
{
    if (b->open == SIZE_MAX)
        b->root = node;
    else
        b->c->half_plane[b->open].next = node;
}

/* Records that memory is out if `ok` is false. Returns ok. */
static bool note_failure(const builder *b, bool ok)
{
    b->c->failed = b->c->failed || !ok;
    return ok;
}

/* Adds a node for two pieces, with the half-planes in scratch. Returns false if memory is out. */
static bool add_node(builder *b, const sunder_i_chain_link *l, size_t half_planes, size_t *node)
{
    const sunder_i_violation o = {.p = l->i, .q = l->j, .a = l->a, .b = l->b, .clearance = l->clearance};
    if (!note_failure(b, sunder_i_branching_add_branch(b->c, &o, half_planes, node))) return false;
    hang_node(b, *node);
    return true;
}

/* Two places, and the node about them. */
typedef struct between {
    uint32_t i, j;
    size_t node;
} between;

/* Adds a leaf for the half-plane with index `half_plane` of a node: the half-plane contradicts the limits of its two
 * bodies, alone or together with one of the n half-planes before it that are excluded. Returns false if it does not,
 * because of rounding, or if memory is out. */
static bool add_dead_end(builder *b, const between *at, size_t half_plane, const size_t *behind, size_t n)
{
    sunder_i_branching *c = b->c;
    sunder_i_levels levels;
    size_t leaf = 0;
    c->claims = 0;
    for (size_t k = 0; k < n; k++)
        if (!note_failure(b, sunder_i_branching_push(c, at->i, at->j, at->node, behind[k], true, 0))) return false;
    if (!note_failure(b, sunder_i_branching_push(c, at->i, at->j, at->node, half_plane, false, 0))) return false;
    if (!sunder_i_branching_is_dead_end(c) || !note_failure(b, sunder_i_branching_add_leaf(c, &levels, &leaf)))
        return false;
    c->half_plane[half_plane].next = leaf;
    return true;
}

/* Adds the claim of the half-plane with index `half_plane` to the chain; the next node hangs below it. Returns false if
 * memory is out. */
static bool go_on(builder *b, const between *at, size_t half_plane)
{
    sunder_i_branching *c = b->c;
    c->claims = 0;
    if (!note_failure(b, sunder_i_branching_push(c, at->i, at->j, at->node, half_plane, false, 0)) ||
        !note_failure(b, sunder_i_reserve(&b->claim, &b->capacity, b->claims + 1, sizeof *b->claim)))
        return false;
    b->claim[b->claims++] = c->claim[0];
    b->open = half_plane;
    return true;
}

/* Adds the node of a link, in which only the first half-plane leads on. Returns false if that fails because of
 * rounding, or if memory is out. */
static bool add_link(builder *b, const sunder_i_chain_link *l)
{
    sunder_i_branching *c = b->c;
    const sunder_i_body *p = &c->model->body[l->i], *q = &c->model->body[l->j];
    const double reach = sunder_i_branching_limit(c, p) + sunder_i_branching_limit(c, q);
    size_t n = sunder_i_branching_fill_half_planes(c, p, l->a, q, l->b, l->clearance, false, NULL);
    if (!c->failed) n = sunder_i_chain_half_planes(c, n, reach);
    if (c->failed || n == 0) return false;
    between at = {sunder_i_branching_join(c, l->i), sunder_i_branching_join(c, l->j), 0};
    if (c->failed || !add_node(b, l, n, &at.node)) return false;
    const size_t first = c->node[at.node].half_plane;
    for (size_t k = 1; k < n; k++)
        if (!add_dead_end(b, &at, first + k, &first, 1)) return false;
    return go_on(b, &at, first);
}

/* Adds the last leaf, with a force of 1 on each claim of the chain, if these forces prove that the claims contradict
 * the limits. Returns false if they do not, because of rounding, or if memory is out. */
static bool add_end(builder *b)
{
    sunder_i_branching *c = b->c;
    sunder_i_levels levels;
    size_t leaf = 0;
    if (!note_failure(b, sunder_i_reserve(&c->claim, &c->claim_capacity, b->claims, sizeof *c->claim))) return false;
    memcpy(c->claim, b->claim, b->claims * sizeof *c->claim);
    c->claims = b->claims;
    for (size_t k = 0; k < c->claims; k++) c->claim[k].force = 1;
    if (!sunder_i_branching_is_contradiction(c) || !note_failure(b, sunder_i_branching_add_leaf(c, &levels, &leaf)))
        return false;
    hang_node(b, leaf);
    return true;
}

/* Builds the tree: the pair's node, and below each of its half-planes a chain or a dead end. */
static bool build_tree(builder *b, const sunder_i_chains *g, const sunder_i_chain_link *pair,
                       const sunder_i_half_plane *half_plane, size_t half_planes, const sunder_i_pushing *chain,
                       size_t *behind)
{
    sunder_i_branching *c = b->c;
    between at = {sunder_i_branching_join(c, pair->i), sunder_i_branching_join(c, pair->j), 0};
    size_t done = 0;
    if (c->failed ||
        !note_failure(b, sunder_i_reserve(&c->scratch, &c->scratch_capacity, half_planes, sizeof *c->scratch)))
        return false;
    memcpy(c->scratch, half_plane, half_planes * sizeof *half_plane);
    if (!add_node(b, pair, half_planes, &at.node)) return false;
    for (size_t k = 0; k < half_planes; k++) {
        const size_t number = c->node[at.node].half_plane + k;
        if (chain[done].half_plane != k) {
            if (!add_dead_end(b, &at, number, behind, done)) return false;
            continue;
        }
        b->claims = 0;
        if (!go_on(b, &at, number)) return false;
        for (size_t l = 0; l < chain[done].n; l++)
            if (!add_link(b, &g->link[chain[done].link[l]])) return false;
        if (!add_end(b)) return false;
        behind[done++] = number;
    }
    return true;
}

static void clear_branching(sunder_i_branching *c)
{
    sunder_i_free_all(c->body, c->t, c->limit, c->shift, c->net, c->weight, c->claim, c->node, c->half_plane, c->force,
                      c->scratch);
}

sunder_proof *sunder_i_chain_prove(sunder_i_chains *chains, const sunder_i_subproblem *subproblem,
                                   const sunder_i_chain_link *pair, const sunder_i_half_plane *half_plane,
                                   size_t half_planes, const sunder_i_pushing *chain, size_t n, bool *failed)
{
    sunder_i_subproblem of = *subproblem;
    sunder_i_branching c = {.subproblem = &of, .model = of.model};
    builder b = {.c = &c, .open = SIZE_MAX};
    of.coarse = chains->of.coarse;
    sunder_proof *proof = NULL;
    size_t *behind = sunder_i_alloc(n + 1, sizeof *behind);
    if (note_failure(&b, behind != NULL) && build_tree(&b, chains, pair, half_plane, half_planes, chain, behind)) {
        proof = sunder_i_proof_of(&c, b.root);
        note_failure(&b, proof != NULL);
    }
    sunder_i_free(behind);
    *failed = c.failed;
    chains->work += sunder_i_branching_work(&c);
    sunder_i_free(b.claim);
    clear_branching(&c);
    return proof;
}
