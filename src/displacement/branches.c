/* The branches of an inquiry: pairs that came into each other's way, and by which lines they pass. */
#include "displacement/inquiry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Only overlaps of at least this share of the deepest are weighed: shallow ones tell little. */
#define DEEP 0.5

sunder_status sunder_i_inquiry_add_pair(sunder_i_inquiry *c, uint32_t i, uint32_t j, sunder_error *err)
{
    if (!sunder_i_reserve(&c->pair, &c->pair_capacity, c->pairs + 1, sizeof *c->pair)) return sunder_i_no_memory(err);
    sunder_i_duo *d = &c->pair[c->pairs];
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

static size_t find_pair(const sunder_i_inquiry *c, uint32_t i, uint32_t j)
{
    size_t k = 0;
    while (k < c->pairs && !(c->pair[k].i == i && c->pair[k].j == j)) k++;
    return k;
}

/* Cuts the pair's region by the next edge that leaves it anything free; false where there is none. */
static bool pass_next_edge(const sunder_i_inquiry *c, sunder_i_branch *b, sunder_i_duo *d)
{
    const double slack = 1e-7 * d->obstruction.r;
    while (b->next < b->edges) {
        const sunder_i_passage *e = &c->edge[b->edge + b->next++];
        const double behind[2] = {-e->n[0], -e->n[1]};
        d->region = b->rest;
        sunder_i_region_cut(&d->region, e->n, e->h - slack);
        sunder_i_region_cut(&b->rest, behind, -e->h - slack);
        if (d->region.n && d->obstruction.segments) sunder_i_region_tighten(&d->region, &d->obstruction);
        if (d->region.n) return true;
    }
    return false;
}

static sunder_i_branch begin_branch(const sunder_i_inquiry *c, size_t pair, size_t edges)
{
    return (sunder_i_branch){
        .pair = pair, .whole = c->pair[pair].region, .rest = c->pair[pair].region, .edge = c->edges, .edges = edges};
}

/* How many ways are open to a pair that overlaps so. */
static size_t count_ways(sunder_i_inquiry *c, size_t pair, size_t edges)
{
    sunder_i_branch b = begin_branch(c, pair, edges);
    size_t n = 0;
    while (pass_next_edge(c, &b, &c->pair[pair])) n++;
    c->pair[pair].region = b.whole;
    return n;
}

sunder_status sunder_i_inquiry_open(sunder_i_inquiry *c, const sunder_i_meeting *deepest, size_t n, sunder_error *err)
{
    size_t best = n, fewest = SIZE_MAX;
    for (size_t k = 0; k < n && fewest && deepest[k].depth >= DEEP * deepest[0].depth; k++) {
        const size_t pair = find_pair(c, deepest[k].i, deepest[k].j);
        if (pair == c->pairs) {
            const sunder_status status = sunder_i_inquiry_add_pair(c, deepest[k].i, deepest[k].j, err);
            if (status) return status;
        }
        const size_t edges = sunder_i_inquiry_passages(c, &deepest[k]);
        if (edges == 0) return sunder_i_no_memory(err);
        const size_t ways = count_ways(c, pair, edges);
        if (ways >= fewest) continue;
        fewest = ways;
        best = k;
    }
    const size_t edges = sunder_i_inquiry_passages(c, &deepest[best]);
    if (edges == 0 || !sunder_i_reserve(&c->stack, &c->stack_capacity, c->depth + 1, sizeof *c->stack))
        return sunder_i_no_memory(err);
    c->stack[c->depth++] = begin_branch(c, find_pair(c, deepest[best].i, deepest[best].j), edges);
    c->edges += edges;
    return SUNDER_OK;
}

bool sunder_i_inquiry_next(sunder_i_inquiry *c)
{
    for (; c->depth; c->depth--) {
        sunder_i_branch *b = &c->stack[c->depth - 1];
        if (pass_next_edge(c, b, &c->pair[b->pair])) return true;
        c->edges = b->edge;
        c->pair[b->pair].region = b->whole;
    }
    return false;
}
