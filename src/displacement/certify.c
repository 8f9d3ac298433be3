/* A few bodies, their limits, and those about them: is there no solution, or does this one do?
 *
 * For each pair the region (region.h) holds every relative move u that any solution could have. Regions are convex, so
 * "every pair in its region, every move t within its limit" is a convex program, and forces f on the regions' edges
 * n.(t_j - t_i) >= h, of any size, prove that it has no solution if
 *
 *     sum of f h  >  sum over the bodies of L |sum of f n, signed by the side of the pair|,
 *
 * for any solution would make the left side at most the sum of f n.(t_j - t_i), which is at most the right
 * [Farkas; Boyd and Vandenberghe, Convex Optimization, section 5.8]. The program's own forces are tried.
 *
 * If they prove nothing, the program's solution is a candidate. Where two bodies overlap in it, in two convex pieces,
 * each solution has u outside one of the edges of the pieces' difference: the pair's region is cut by one edge after
 * another, and each branch shown to be void in its turn, depth first. A candidate in which nothing overlaps ends the
 * search. Pairs are looked at when a candidate makes them overlap.
 *
 * The gap has round corners, for which an inscribed polygon stands; a solution may miss the difference. Pairs that may
 * overlap, for one lies in the other, are left out altogether: what moves inside something is for the search to care.
 * The sums are in doubles, and what is asked of a proof beyond equality is far more than their rounding can be. */
#include "displacement/certify.h"

#include "displacement/region.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Effort: constraints that the programs looked at, bodies, pairs. */
#define MOST_WORK 40000000
/* Overlaps of a candidate that are weighed against each other; of at least this share of the deepest, since shallow
 * ones tell little. */
#define CHOICES 8
#define DEEP 0.5
#define MOST_BODIES 250
#define MOST_PAIRS 150
/* Overlaps and oversteps of no more than this share of the longest limit are left to the search; programs ask for as
 * much beyond the regions, so that their softness does not show in a candidate. */
#define TOLERANCE 1e-5

typedef struct duo {
    uint32_t i, j; /* places in certify.body */
    sunder_i_obstruction obstruction;
    sunder_i_region region;
} duo;

typedef struct edge {
    double n[2], h; /* free places on this side have n.u >= h */
    double at;      /* n.u - h of the candidate */
} edge;

/* One choice: which edge of an obstacle a pair passes. */
typedef struct branch {
    size_t pair;
    sunder_i_region whole; /* the pair's region before */
    sunder_i_region rest;  /* ... less what earlier edges let pass */
    size_t edge, edges, next;
} branch;

typedef struct certify {
    const sunder_i_town *town;
    uint32_t *body;
    size_t bodies;
    double *limit, *mass, *net; /* [bodies], [bodies], [2 * bodies] */
    double longest;             /* limit */
    duo *pair;
    size_t pairs, pair_capacity;
    branch *stack;
    size_t depth, stack_capacity;
    edge *edge;
    size_t edges, edge_capacity;
    sunder_i_quadratic program;
    sunder_i_scratch scratch;
    size_t programs;
} certify;

/* ---- The program of one node ----------------------------------------------------------------------------------------
 * Its constraints are gathered as candidates miss them, and those that act serve the next node too: in any direction n,
 * a pair's u has n.u no less than its region has. */

/* The key of a constraint that is a tangent of a limit; any other's is its pair. */
#define TANGENT UINT64_MAX

static double least_of(const sunder_i_region *region, const double n[2])
{
    double least = INFINITY;
    for (size_t k = 0; k < region->n; k++) least = fmin(least, n[0] * region->xy[2 * k] + n[1] * region->xy[2 * k + 1]);
    return least;
}

/* Drops what does not act, and asks of the rest what the regions ask now. */
static void refresh(certify *c)
{
    sunder_i_quadratic *p = &c->program;
    size_t out = 0;
    for (size_t k = 0; k < p->n; k++) {
        sunder_i_constraint *e = &p->constraint[k];
        if (!(e->force > 0)) continue;
        if (e->key != TANGENT) e->d = least_of(&c->pair[e->key].region, e->n) + TOLERANCE * c->longest;
        p->constraint[out++] = *e;
    }
    p->n = out;
}

/* Adds n.(t_j - t_i) >= d unless it is there. */
static bool add(certify *c, uint32_t i, uint32_t j, uint64_t key, const double n[2], double d, size_t *added)
{
    sunder_i_quadratic *p = &c->program;
    for (size_t k = 0; k < p->n; k++) {
        const sunder_i_constraint *e = &p->constraint[k];
        if (e->key == key && e->j == j && n[0] * e->n[0] + n[1] * e->n[1] > 1 - 1e-12) return true;
    }
    if (!sunder_i_reserve(&p->constraint, &p->capacity, p->n + 1, sizeof *p->constraint)) return false;
    p->constraint[p->n++] = (sunder_i_constraint){.i = i, .j = j, .n = {n[0], n[1]}, .d = d, .key = key};
    ++*added;
    return true;
}

/* Adds what the program's solution misses: of each pair the edge of its region that it misses most, and the tangents of
 * limits that it oversteps. Returns how many. */
static size_t add_missed(certify *c, bool *ok)
{
    const double *t = c->program.t, margin = TOLERANCE * c->longest;
    size_t added = 0;
    for (size_t k = 0; k < c->pairs && *ok; k++) {
        const duo *d = &c->pair[k];
        const double u[2] = {t[2 * d->j] - t[2 * d->i], t[2 * d->j + 1] - t[2 * d->i + 1]};
        double worst = 0, n[2] = {0, 0};
        for (size_t e = 0; e < d->region.n; e++) {
            const double *a = d->region.xy + 2 * e, *b = d->region.xy + 2 * (e + 1 < d->region.n ? e + 1 : 0);
            const double x = b[0] - a[0], y = b[1] - a[1], length = hypot(x, y);
            if (!(length > 1e-9 * d->obstruction.r)) continue;
            const double missed = (y * (u[0] - a[0]) - x * (u[1] - a[1])) / length;
            if (missed <= worst) continue;
            worst = missed;
            n[0] = -y / length;
            n[1] = x / length;
        }
        if (worst > 0) *ok = add(c, d->i, d->j, k, n, least_of(&d->region, n) + margin, &added);
    }
    for (uint32_t b = 0; b < c->bodies && *ok; b++) {
        const double length = hypot(t[2 * b], t[2 * b + 1]);
        if (!(c->limit[b] > 0) || length <= c->limit[b] + margin) continue;
        const double n[2] = {-t[2 * b] / length, -t[2 * b + 1] / length};
        *ok = add(c, SUNDER_I_NOBODY, b, TANGENT, n, -c->limit[b], &added);
    }
    return added;
}

/* Do the forces prove that there is no solution? */
static bool is_proved(const certify *c)
{
    const sunder_i_quadratic *p = &c->program;
    double won = 0, lost = 0, all = 0;
    memset(c->net, 0, 2 * c->bodies * sizeof *c->net);
    for (size_t k = 0; k < p->n; k++) {
        const sunder_i_constraint *e = &p->constraint[k];
        if (e->key == TANGENT) continue;
        const double h = e->d - TOLERANCE * c->longest;
        won += e->force * h;
        all += e->force * fabs(h);
        for (size_t x = 0; x < 2; x++) {
            c->net[2 * e->j + x] += e->force * e->n[x];
            c->net[2 * e->i + x] -= e->force * e->n[x];
        }
    }
    for (size_t b = 0; b < c->bodies; b++)
        if (c->limit[b] > 0) lost += c->limit[b] * hypot(c->net[2 * b], c->net[2 * b + 1]);
    return won > lost + 1e-9 * (all + lost);
}

/* ---- The candidate ----------------------------------------------------------------------------------------------- */

/* The difference of two convex pieces that the candidate has deepest in each other. */
typedef struct overlap {
    uint32_t i, j;
    double depth;
    const sunder_i_piece *a, *b;
} overlap;

static size_t difference(certify *c, const sunder_i_piece *a, const sunder_i_piece *b, uint32_t i, uint32_t j)
{
    const sunder_i_body *p = &c->town->body[c->body[i]], *q = &c->town->body[c->body[j]];
    const double offset[2] = {q->origin[0] - p->origin[0], q->origin[1] - p->origin[1]};
    return sunder_i_difference(c->town->corner + 2 * (size_t)a->corner, a->corners,
                               c->town->corner + 2 * (size_t)b->corner, b->corners, offset, &c->scratch);
}

/* Do members of the two have leave to overlap? */
static bool may_overlap(const certify *c, uint32_t i, uint32_t j)
{
    const sunder_i_town *town = c->town;
    const sunder_i_body *p = &town->body[c->body[i]], *q = &town->body[c->body[j]];
    for (uint32_t k = 0; town->kept_n && k < p->members; k++)
        for (uint32_t l = 0; l < q->members; l++)
            if (sunder_i_kept_at(town, town->member[p->member + k], town->member[q->member + l]) < town->kept_n)
                return true;
    return false;
}

/* An obstacle K grown by the gap has round corners. Where K turns by more than this, lines between its edges' are taken
 * too, so that the next is never more than half of it away: a place at distance g is g cos(CORNER / 2) beyond one of
 * the lines, or more. */
#define CORNER 0.78539816339744831

static void add_edge(const certify *c, const double at[2], const double n[2], const double u[2], edge *e)
{
    *e = (edge){.n = {n[0], n[1]}};
    e->h = n[0] * at[0] + n[1] * at[1] + c->town->rules.gap * cos(CORNER / 2);
    e->at = n[0] * u[0] + n[1] * u[1] - e->h;
}

/* Lines such that what keeps the gap from the obstacle in scratch (n corners) is beyond one of them: into c->edge, from
 * c->edges on. Returns how many, 0 if memory is out; *depth: how far u, if it is behind all of them, is from the next.
 */
static size_t fill_edges(certify *c, size_t n, const double u[2], double *depth)
{
    const double *d = c->scratch.xy;
    const size_t most = 2 * n + (size_t)(7 / CORNER);
    size_t out = 0;
    if (!sunder_i_reserve(&c->edge, &c->edge_capacity, c->edges + most, sizeof *c->edge)) return 0;
    edge *list = c->edge + c->edges;
    for (size_t k = 0; k < n; k++) {
        const double *p = d + 2 * k, *q = d + 2 * (k + 1 < n ? k + 1 : 0), *r = NULL;
        const double x = q[0] - p[0], y = q[1] - p[1], length = hypot(x, y);
        if (!(length > 0)) continue;
        const double normal[2] = {y / length, -x / length};
        add_edge(c, p, normal, u, &list[out++]);
        for (size_t l = 2; l <= n && c->town->rules.gap > 0 && !r; l++) {
            r = d + 2 * ((k + l) % n);
            if (r[0] == q[0] && r[1] == q[1]) r = NULL;
        }
        if (!r) continue;
        const double turn = atan2(x * (r[1] - q[1]) - y * (r[0] - q[0]), x * (r[0] - q[0]) + y * (r[1] - q[1]));
        for (double a = CORNER; a < fabs(turn); a += CORNER)
            add_edge(c, q,
                     (double[2]){normal[0] * cos(a) - normal[1] * sin(a), normal[0] * sin(a) + normal[1] * cos(a)}, u,
                     &list[out++]);
    }
    double at = -INFINITY;
    for (size_t k = 0; k < out; k++) at = fmax(at, list[k].at);
    *depth = -at;
    return out;
}

static void look_at(certify *c, uint32_t i, uint32_t j, overlap *worst)
{
    const sunder_i_body *p = &c->town->body[c->body[i]], *q = &c->town->body[c->body[j]];
    const double *t = c->program.t;
    if (p->pieces == 0 || q->pieces == 0 || !(c->limit[i] + c->limit[j] > 0)) return;
    double box[4], shift[4];
    for (uint32_t x = 0; x < 4; x++) {
        shift[x] = p->origin[x & 1] + t[2 * i + (x & 1)] - q->origin[x & 1] - t[2 * j + (x & 1)];
        shift[x] += x < 2 ? -c->town->rules.gap : c->town->rules.gap;
        box[x] = p->box[x] + shift[x];
    }
    if (!sunder_i_box_meet(box, q->box) || may_overlap(c, i, j)) return;
    const double u[2] = {t[2 * j] - t[2 * i], t[2 * j + 1] - t[2 * i + 1]};
    for (uint32_t k = p->piece; k < p->piece + p->pieces; k++) {
        const sunder_i_piece *a = &c->town->piece[k];
        for (uint32_t x = 0; x < 4; x++) box[x] = a->box[x] + shift[x];
        if (!sunder_i_box_meet(box, q->box)) continue;
        for (uint32_t l = q->piece; l < q->piece + q->pieces; l++) {
            const sunder_i_piece *b = &c->town->piece[l];
            if (!sunder_i_box_meet(box, b->box)) continue;
            const size_t n = difference(c, a, b, i, j);
            double depth;
            if (n == 0 || !fill_edges(c, n, u, &depth)) {
                c->scratch.failed = true;
                return;
            }
            if (depth > worst->depth) *worst = (overlap){i, j, depth, a, b};
        }
    }
}

/* The deepest overlaps of the candidate, one of each pair, deepest first; returns how many. */
static size_t deepest_overlaps(certify *c, overlap deepest[CHOICES])
{
    size_t n = 0;
    for (uint32_t i = 0; i < c->bodies; i++)
        for (uint32_t j = i + 1; j < c->bodies; j++) {
            overlap o = {.depth = TOLERANCE * c->longest};
            look_at(c, i, j, &o);
            if (!o.a || (n == CHOICES && o.depth <= deepest[n - 1].depth)) continue;
            size_t k = n < CHOICES ? n++ : n - 1;
            for (; k > 0 && deepest[k - 1].depth < o.depth; k--) deepest[k] = deepest[k - 1];
            deepest[k] = o;
        }
    return n;
}

/* ---- Branches -----------------------------------------------------------------------------------------------------
 */

static sunder_status add_pair(certify *c, uint32_t i, uint32_t j, sunder_error *err)
{
    if (!sunder_i_reserve(&c->pair, &c->pair_capacity, c->pairs + 1, sizeof *c->pair)) return sunder_i_no_memory(err);
    duo *d = &c->pair[c->pairs];
    memset(d, 0, sizeof *d);
    d->i = i;
    d->j = j;
    const sunder_shape *p = sunder_i_town_shape(c->town, c->body[i]), *q = sunder_i_town_shape(c->town, c->body[j]);
    const double r = c->limit[i] + c->limit[j];
    sunder_i_region_disc(r, &d->region);
    d->obstruction.r = r;
    /* A block that was not united is known by its pieces alone. */
    if (p && q) {
        const sunder_status status = sunder_i_obstruction_of(p, q, r, &d->obstruction, err);
        if (status) return status;
        sunder_i_region_tighten(&d->region, &d->obstruction);
    }
    c->pairs++;
    return SUNDER_OK;
}

static size_t find_pair(const certify *c, uint32_t i, uint32_t j)
{
    size_t k = 0;
    while (k < c->pairs && !(c->pair[k].i == i && c->pair[k].j == j)) k++;
    return k;
}

static int by_nearness(const void *a, const void *b)
{
    const edge *p = a, *q = b;
    return (p->at < q->at) - (p->at > q->at);
}

/* The lines that the overlap's difference can be passed by, the one nearest to the candidate first. */
static size_t list_edges(certify *c, const overlap *o)
{
    const double *t = c->program.t;
    const double u[2] = {t[2 * o->j] - t[2 * o->i], t[2 * o->j + 1] - t[2 * o->i + 1]};
    double depth;
    const size_t n = difference(c, o->a, o->b, o->i, o->j), edges = n ? fill_edges(c, n, u, &depth) : 0;
    if (edges) qsort(c->edge + c->edges, edges, sizeof *c->edge, by_nearness);
    return edges;
}

/* Cuts the pair's region by the next edge that leaves it anything free; false where there is none. */
static bool pass_next_edge(const certify *c, branch *b, duo *d)
{
    const double slack = 1e-7 * d->obstruction.r;
    while (b->next < b->edges) {
        const edge *e = &c->edge[b->edge + b->next++];
        const double behind[2] = {-e->n[0], -e->n[1]};
        d->region = b->rest;
        sunder_i_region_cut(&d->region, e->n, e->h - slack);
        sunder_i_region_cut(&b->rest, behind, -e->h - slack);
        if (d->region.n && d->obstruction.segments) sunder_i_region_tighten(&d->region, &d->obstruction);
        if (d->region.n) return true;
    }
    return false;
}

static branch begin_branch(const certify *c, size_t pair, size_t edges)
{
    return (branch){
        .pair = pair, .whole = c->pair[pair].region, .rest = c->pair[pair].region, .edge = c->edges, .edges = edges};
}

/* How many ways are open to a pair that overlaps so. */
static size_t count_ways(certify *c, size_t pair, size_t edges)
{
    branch b = begin_branch(c, pair, edges);
    size_t n = 0;
    while (pass_next_edge(c, &b, &c->pair[pair])) n++;
    c->pair[pair].region = b.whole;
    return n;
}

/* Opens a choice between the edges of one of the overlaps: the one that has the fewest ways out. */
static sunder_status open_branch(certify *c, const overlap *deepest, size_t n, sunder_error *err)
{
    size_t best = n, fewest = SIZE_MAX;
    for (size_t k = 0; k < n && fewest && deepest[k].depth >= DEEP * deepest[0].depth; k++) {
        const size_t pair = find_pair(c, deepest[k].i, deepest[k].j);
        if (pair == c->pairs) {
            const sunder_status status = add_pair(c, deepest[k].i, deepest[k].j, err);
            if (status) return status;
        }
        const size_t edges = list_edges(c, &deepest[k]);
        if (edges == 0) return sunder_i_no_memory(err);
        const size_t ways = count_ways(c, pair, edges);
        if (ways >= fewest) continue;
        fewest = ways;
        best = k;
    }
    const size_t edges = list_edges(c, &deepest[best]);
    if (edges == 0 || !sunder_i_reserve(&c->stack, &c->stack_capacity, c->depth + 1, sizeof *c->stack))
        return sunder_i_no_memory(err);
    c->stack[c->depth++] = begin_branch(c, find_pair(c, deepest[best].i, deepest[best].j), edges);
    c->edges += edges;
    return SUNDER_OK;
}

/* Goes on to the next way that is open; false where all are done. */
static bool next_branch(certify *c)
{
    for (; c->depth; c->depth--) {
        branch *b = &c->stack[c->depth - 1];
        if (pass_next_edge(c, b, &c->pair[b->pair])) return true;
        c->edges = b->edge;
        c->pair[b->pair].region = b->whole;
    }
    return false;
}

/* ---- The search ----------------------------------------------------------------------------------------------------
 */

/* Solves the program of this node. *shown: it is void; else the program's solution is a candidate. */
static sunder_status solve(certify *c, bool *shown, sunder_error *err)
{
    bool ok = true;
    refresh(c);
    do {
        *shown = false;
        c->programs++;
        if (c->program.work > MOST_WORK) return SUNDER_OK;
        /* Hard enough that the masses hardly count. */
        if (sunder_i_quadratic_solve(&c->program, 1e-6, 1e-6 * c->longest, c->longest) < 0)
            return sunder_i_no_memory(err);
        if (sunder_i_is_stopped(&c->town->rules)) return sunder_i_broken_off(&c->town->rules, err);
        *shown = is_proved(c);
    } while (!*shown && add_missed(c, &ok));
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}

static sunder_status search(certify *c, sunder_i_verdict *verdict, sunder_error *err)
{
    for (;;) {
        bool shown;
        sunder_status status = solve(c, &shown, err);
        if (status || c->program.work > MOST_WORK || c->pairs > MOST_PAIRS) return status;
        if (!shown) {
            overlap deepest[CHOICES];
            const size_t n = deepest_overlaps(c, deepest);
            if (c->scratch.failed) return sunder_i_no_memory(err);
            if (n == 0) {
                *verdict = SUNDER_I_SOLVED;
                return SUNDER_OK;
            }
            status = open_branch(c, deepest, n, err);
            if (status) return status;
        }
        if (!next_branch(c)) {
            *verdict = SUNDER_I_INSOLUBLE;
            return SUNDER_OK;
        }
    }
}

/* ---- Who takes part -------------------------------------------------------------------------------------------------
 */

static int by_number(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    return *p < *q ? -1 : *p > *q;
}

/* The bodies and all that could get in their way, ascending; the bodies alone if those are too many. */
static sunder_status gather(certify *c, const uint32_t *body, size_t n, sunder_error *err)
{
    const sunder_i_town *town = c->town;
    sunder_i_list near = {0};
    for (size_t k = 0; k < n; k++)
        c->longest = fmax(c->longest, town->body[body[k]].fixed ? 0 : town->body[body[k]].limit);
    bool ok = true;
    for (size_t k = 0; k < n && ok && isfinite(c->longest); k++) {
        const sunder_i_body *b = &town->body[body[k]];
        for (uint32_t m = 0; m < b->members && ok; m++) {
            double box[4];
            sunder_i_box_grow(town->box + 4 * (size_t)town->member[b->member + m], 2 * c->longest, box);
            if (b->pieces) ok = sunder_i_index_query(&town->tree, box, &near);
        }
    }
    for (size_t k = 0; k < near.n; k++) near.item[k] = town->body_of[near.item[k]];
    if (near.n) qsort(near.item, near.n, sizeof *near.item, by_number);
    size_t unique = 0;
    for (size_t k = 0; k < near.n; k++)
        if (k == 0 || near.item[k] != near.item[unique - 1]) near.item[unique++] = near.item[k];
    if (unique > MOST_BODIES) unique = 0;
    c->body = sunder_i_alloc(unique + n, sizeof *c->body);
    ok = ok && c->body;
    if (ok && unique) memcpy(c->body, near.item, unique * sizeof *c->body);
    for (size_t k = 0; ok && k < n; k++)
        if (!unique || !bsearch(&body[k], near.item, unique, sizeof *body, by_number))
            c->body[unique + c->bodies++] = body[k];
    c->bodies += unique;
    if (ok) qsort(c->body, c->bodies, sizeof *c->body, by_number);
    sunder_i_free(near.item);
    return ok ? SUNDER_OK : sunder_i_no_memory(err);
}

static sunder_status prepare(certify *c, double *t, sunder_error *err)
{
    c->limit = sunder_i_alloc(c->bodies, sizeof *c->limit);
    c->mass = sunder_i_alloc(c->bodies, sizeof *c->mass);
    c->net = sunder_i_alloc(2 * c->bodies, sizeof *c->net);
    if (!c->limit || !c->mass || !c->net) return sunder_i_no_memory(err);
    c->program = (sunder_i_quadratic){.bodies = c->bodies, .mass = c->mass, .t = t};
    for (uint32_t b = 0; b < c->bodies; b++) {
        const sunder_i_body *body = &c->town->body[c->body[b]];
        c->limit[b] = body->fixed ? 0 : body->limit;
        c->mass[b] = c->limit[b] > 0 ? 1 : 0;
        c->longest = fmax(c->longest, c->limit[b]);
    }
    return SUNDER_OK;
}

static void clear(certify *c)
{
    for (size_t k = 0; k < c->pairs; k++) sunder_i_obstruction_free(&c->pair[k].obstruction);
    sunder_i_free(c->limit);
    sunder_i_free(c->mass);
    sunder_i_free(c->net);
    sunder_i_free(c->pair);
    sunder_i_free(c->stack);
    sunder_i_free(c->edge);
    sunder_i_free(c->program.constraint);
    sunder_i_free(c->scratch.xy);
}

/* The pairs that are known to be in each other's way, before any candidate says so. */
static sunder_status add_pairs(certify *c, const sunder_i_couple *pair, size_t pairs, sunder_i_verdict *verdict,
                               sunder_error *err)
{
    sunder_status status = SUNDER_OK;
    for (size_t k = 0; k < pairs && !status && *verdict == SUNDER_I_UNKNOWN; k++) {
        const uint32_t *a = bsearch(&pair[k].a, c->body, c->bodies, sizeof *a, by_number);
        const uint32_t *b = bsearch(&pair[k].b, c->body, c->bodies, sizeof *b, by_number);
        const uint32_t i = (uint32_t)(a - c->body), j = (uint32_t)(b - c->body);
        if (may_overlap(c, i, j)) continue;
        status = add_pair(c, i, j, err);
        if (!status && c->pair[c->pairs - 1].region.n == 0) *verdict = SUNDER_I_INSOLUBLE;
    }
    return status;
}

sunder_status sunder_i_certify(const sunder_i_town *town, const uint32_t *body, size_t bodies,
                               const sunder_i_couple *pair, size_t pairs, sunder_i_verdict *verdict,
                               sunder_i_solution *solution, sunder_error *err)
{
    *verdict = SUNDER_I_UNKNOWN;
    memset(solution, 0, sizeof *solution);
    if (pairs > MOST_PAIRS) return SUNDER_OK;
    certify c = {.town = town};
    sunder_status status = gather(&c, body, bodies, err);
    double *t = status ? NULL : sunder_i_calloc(2 * c.bodies, sizeof *t);
    if (!status && !t) status = sunder_i_no_memory(err);
    if (!status) status = prepare(&c, t, err);
    if (!status && isfinite(c.longest)) {
        status = add_pairs(&c, pair, pairs, verdict, err);
        if (!status && *verdict == SUNDER_I_UNKNOWN) status = search(&c, verdict, err);
    }
    clear(&c);
    *solution = (sunder_i_solution){c.body, t, c.bodies};
    if (status || *verdict != SUNDER_I_SOLVED) sunder_i_solution_clear(solution);
    return status;
}

void sunder_i_solution_clear(sunder_i_solution *solution)
{
    sunder_i_free(solution->body);
    sunder_i_free(solution->move);
    memset(solution, 0, sizeof *solution);
}
