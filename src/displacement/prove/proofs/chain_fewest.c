/* The shortest chain through a pair if every pair has to keep its full distance, whether it is listed or not. It proves
 * that these few pairs cannot all be solved, whatever happens elsewhere.
 *
 * No positions are known here, and the sums are those at the start: along a row the d of each link, less L |n - n'| at
 * each body between two and L at the end (chain.c). The gain of a link may have either sign, so there are no
 * potentials. But chains are short, and are built one link at a time from either end of the pair: of the chains of k
 * links the best few are kept. The result is the shortest pair of ends whose sum with the pair is positive,
 *
 *       o <- o <- (i   j) -> o -> o -> o
 *      one end     pair     the other
 *
 * provided that no proper part of it, without one or both ends, has a positive sum: then every member is needed, as far
 * as chains can show. A positive part without the pair is a reason of its own, for other pairs. */
#include "displacement/prove/proofs/chain.h"
#include "displacement/prove/proofs/tuning.h"

#include <math.h>
#include <string.h>

typedef struct reached {
    uint32_t link;
    uint32_t from; /* the index of the previous link in the round before */
    double won;    /* the sum up to this link, from which the limit of the last body is not subtracted yet */
} reached;

/* The chains from one end of the pair, by rounds: those of k links are item[first[k]] to item[first[k + 1] - 1]. */
typedef struct reach {
    uint32_t body; /* the body at this end of the pair, which is pushed along n */
    double n[2];
    double least; /* a chain is continued only if its sum exceeds this by more than the limit of its last body */
    reached item[FEWEST_MOST * FEWEST_KEPT];
    size_t first[FEWEST_MOST + 2];
    size_t rounds;                /* the number of rounds */
    double won[FEWEST_MOST + 1];  /* the best sum of a chain of this many links, less the limit of its last body;
                                   * -INFINITY if there is none */
    size_t best[FEWEST_MOST + 1]; /* the index of its last link */
} reach;

static double limit_of(const sunder_i_chains *g, uint32_t body) { return sunder_i_limit_of(&g->of.model->body[body]); }

/* Returns what a body that is pushed along n and pushes along m takes from the sum of a chain: its limit times |n -
 * m|. */
static double turn_loss(const sunder_i_chains *g, uint32_t body, const double n[2], const double m[2])
{
    return limit_of(g, body) * hypot(n[0] - m[0], n[1] - m[1]);
}

/* Is `body` the one at which the chain of k links that ends with item `at` begins, or one that it pushes? */
static bool is_behind(const sunder_i_chains *g, const reach *r, size_t k, size_t at, uint32_t body)
{
    for (; k > 0; k--) {
        if (g->link[r->item[at].link].j == body) return true;
        at = r->first[k - 1] + r->item[at].from;
    }
    return r->body == body;
}

/* Adds a chain to round k, the chains of k links, if it is one of the FEWEST_KEPT with the greatest sums; these are
 * unordered. */
static void keep_chain(reach *r, size_t k, const reached *found)
{
    reached *item = r->item + r->first[k];
    size_t n = r->first[k + 1] - r->first[k], least = 0;
    if (n < FEWEST_KEPT) {
        item[n] = *found;
        r->first[k + 1]++;
        return;
    }
    for (size_t i = 1; i < n; i++)
        if (item[i].won < item[least].won) least = i;
    if (found->won > item[least].won) item[least] = *found;
}

/* Extends chain `at` of round k (for k = 0, the pair itself) by the bodies that its last body may push, except `other`.
 * Returns false if memory is out. */
static bool push_on(sunder_i_chains *g, reach *r, size_t k, size_t at, uint32_t other)
{
    const uint32_t body = k ? g->link[r->item[at].link].j : r->body;
    /* the array of links may be moved */
    const double *first = k ? g->link[r->item[at].link].n : r->n, n[2] = {first[0], first[1]};
    const double won = k ? r->item[at].won : 0;
    if (limit_of(g, body) == 0) return true;
    const sunder_i_chain_links *of = sunder_i_chains_find(g, body);
    if (!of) return false;
    g->work += of->n;
    for (size_t l = of->first; l < of->first + of->n; l++) {
        const sunder_i_chain_link *link = &g->link[l];
        const reached found = {(uint32_t)l, (uint32_t)(k ? at - r->first[k] : 0),
                               won - turn_loss(g, body, n, link->n) - link->spare};
        if (found.won + limit_of(g, link->j) <= r->least || link->j == other || is_behind(g, r, k, at, link->j))
            continue;
        keep_chain(r, k + 1, &found);
    }
    return true;
}

/* Records in r->won[k] the greatest sum of the chains of k links, less the limit of the last body, and in r->best[k]
 * the index of the last link of that chain. */
static void note_end(const sunder_i_chains *g, reach *r, size_t k)
{
    r->won[k] = k ? -INFINITY : -limit_of(g, r->body);
    for (size_t at = r->first[k]; k && at < r->first[k + 1]; at++) {
        const double won = r->item[at].won - limit_of(g, g->link[r->item[at].link].j);
        if (won <= r->won[k]) continue;
        r->won[k] = won;
        r->best[k] = at;
    }
}

/* Extends one end by a link. other: the body that it may not reach. Returns false if memory is out. */
static bool go_on(sunder_i_chains *g, reach *r, uint32_t other)
{
    const size_t k = r->rounds;
    r->first[k + 2] = r->first[k + 1];
    if (k == 0 && !push_on(g, r, 0, 0, other)) return false;
    for (size_t at = r->first[k]; k && at < r->first[k + 1]; at++)
        if (!push_on(g, r, k, at, other)) return false;
    note_end(g, r, ++r->rounds);
    return true;
}

/* Begins the chains from `body`, which the pair pushes along (nx, ny). least: a chain that cannot exceed it is not
 * continued. It follows from two facts: the part of a chain beyond a body adds at most the limit of that body, since
 * that part would prove something by itself otherwise, and the chain from the other end of the pair adds at most the
 * limit of the body there. */
static void begin_reach(const sunder_i_chains *g, reach *r, uint32_t body, double nx, double ny, double least)
{
    r->least = least;
    r->body = body;
    r->n[0] = nx;
    r->n[1] = ny;
    r->rounds = 0;
    r->first[0] = r->first[1] = 0;
    note_end(g, r, 0);
}

/* ---- Is a proper part of the chain positive? --------------------------------------------------------------------- */

/* A chain of bodies from one end to the other. d and n are the right side and the normal of each link; limit has the
 * limits of the bodies, one more than links. */
typedef struct row {
    double d[2 * FEWEST_MOST + 1], n[2 * FEWEST_MOST + 1][2], limit[2 * FEWEST_MOST + 2];
    size_t links;
} row;

/* Writes the k links of the best chain of one end, from the pair on, to `link`. */
static void list_links(const reach *r, size_t k, uint32_t *link)
{
    for (size_t at = r->best[k]; k > 0; k--) {
        link[k - 1] = r->item[at].link;
        at = r->first[k - 1] + r->item[at].from;
    }
}

static void make_row(const sunder_i_chains *g, const sunder_i_chain_link *pair, const sunder_i_half_plane *half_plane,
                     const sunder_i_pushing *chain, row *out)
{
    const size_t left = chain->n - chain->right;
    out->links = chain->n + 1;
    for (size_t k = 0; k < left; k++) {
        const sunder_i_chain_link *l = &g->link[chain->link[chain->n - 1 - k]];
        out->d[k] = -l->spare;
        out->n[k][0] = -l->n[0];
        out->n[k][1] = -l->n[1];
        out->limit[k] = limit_of(g, l->j);
    }
    out->d[left] = half_plane->d;
    memcpy(out->n[left], half_plane->n, sizeof half_plane->n);
    out->limit[left] = limit_of(g, pair->i);
    out->limit[left + 1] = limit_of(g, pair->j);
    for (size_t k = 0; k < chain->right; k++) {
        const sunder_i_chain_link *l = &g->link[chain->link[k]];
        out->d[left + 1 + k] = -l->spare;
        memcpy(out->n[left + 1 + k], l->n, sizeof l->n);
        out->limit[left + 2 + k] = limit_of(g, l->j);
    }
}

/* Does a proper part of the row have a positive sum? */
static bool has_less(const row *r)
{
    for (size_t from = 0; from < r->links; from++) {
        double won = -r->limit[from];
        for (size_t k = from; k < r->links; k++) {
            if (k > from) won -= r->limit[k] * hypot(r->n[k][0] - r->n[k - 1][0], r->n[k][1] - r->n[k - 1][1]);
            won += r->d[k];
            if (won - r->limit[k + 1] > 0 && k + 1 - from < r->links) return true;
        }
    }
    return false;
}

/* ---- The shortest chain ------------------------------------------------------------------------------------------ */

/* Combines the best chain of `right` links of one end with that of `left` links of the other. It is the result if the
 * sum is positive and no proper part is; *found. Returns false if memory is out. */
static bool try_chain(const sunder_i_chains *g, const sunder_i_chain_link *pair, const sunder_i_half_plane *half_plane,
                      const reach of[2], size_t right, size_t left, sunder_i_pushing *chain, bool *found)
{
    const double won = half_plane->d + of[0].won[right] + of[1].won[left];
    row r;
    if (!(won > CHAIN_MARGIN * (fabs(half_plane->d) + limit_of(g, pair->i) + limit_of(g, pair->j)))) return true;
    chain->link = sunder_i_alloc(right + left + 1, sizeof *chain->link);
    if (!chain->link) return false;
    chain->right = right;
    chain->n = right + left;
    list_links(&of[0], right, chain->link);
    list_links(&of[1], left, chain->link + right);
    make_row(g, pair, half_plane, chain, &r);
    *found = !has_less(&r);
    if (*found) return true;
    sunder_i_free(chain->link);
    chain->link = NULL;
    return true;
}

bool sunder_i_chain_fewest(sunder_i_chains *chains, const sunder_i_chain_link *pair,
                           const sunder_i_half_plane *half_plane, sunder_i_pushing *chain, bool *found)
{
    reach *of = sunder_i_alloc(2, sizeof *of);
    bool ok = of != NULL;
    *found = false;
    if (ok)
        begin_reach(chains, &of[0], pair->j, half_plane->n[0], half_plane->n[1],
                    -half_plane->d - limit_of(chains, pair->i));
    if (ok)
        begin_reach(chains, &of[1], pair->i, -half_plane->n[0], -half_plane->n[1],
                    -half_plane->d - limit_of(chains, pair->j));
    for (size_t n = 0; n <= FEWEST_MOST && ok && !*found; n++) {
        for (size_t right = 0; right <= n && ok && !*found; right++)
            ok = try_chain(chains, pair, half_plane, of, right, n - right, chain, found);
        if (n < FEWEST_MOST && ok && !*found) ok = go_on(chains, &of[0], pair->i) && go_on(chains, &of[1], pair->j);
    }
    sunder_i_free(of);
    return ok;
}
