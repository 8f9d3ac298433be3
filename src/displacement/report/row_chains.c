/* Joins pairs of neighbours to rows. A row leaves a block on the side that is opposite to the one that it arrives at.
 * From an end, where there is no pair on the opposite side, each row is followed from pair to pair; the pairs that are
 * left then form rings. The pairs may be those of a layer, or those found in its parts. */
#include "displacement/report/row_chains.h"

#include <stdlib.h>

/* One of the two blocks of a pair. */
typedef struct pair_end {
    size_t block, side, pair;
    bool second;
} pair_end;

typedef struct following {
    const sunder_row_pair *pair;
    size_t n;
    pair_end *end; /* [2 * n] sorted by block and side */
    bool *taken;   /* [n] */
    sunder_i_row_chains *out;
} following;

static int by_block_and_side(const void *x, const void *y)
{
    const pair_end *p = x, *q = y;
    if (p->block != q->block) return p->block < q->block ? -1 : 1;
    return p->side < q->side ? -1 : p->side > q->side;
}

/* Returns the pair on that side of the block; NULL if there is none. */
static const pair_end *end_at(const following *f, size_t block, size_t side)
{
    const pair_end key = {.block = block, .side = side};
    return bsearch(&key, f->end, 2 * f->n, sizeof key, by_block_and_side);
}

/* Lists the ends of the pairs, sorted, and numbers their blocks without gaps. */
static void list_ends(following *f)
{
    for (size_t k = 0; k < 2 * f->n; k++) {
        const sunder_row_pair *pair = &f->pair[k / 2];
        f->end[k] = (pair_end){pair->block[k % 2], pair->side[k % 2], k / 2, k % 2};
    }
    if (f->n) qsort(f->end, 2 * f->n, sizeof *f->end, by_block_and_side);
    for (size_t k = 0; k < 2 * f->n; k++) {
        if (k == 0 || f->end[k].block != f->end[k - 1].block) f->out->blocks++;
        f->out->block[2 * f->end[k].pair + f->end[k].second] = f->out->blocks - 1;
    }
}

/* Appends the row that begins with this end of a pair, unless it was appended already. */
static void append_row(following *f, const pair_end *from)
{
    sunder_i_row_chains *out = f->out;
    size_t n = out->rows ? out->row_end[out->rows - 1] : 0;
    if (f->taken[from->pair]) return;
    for (const pair_end *at = from; at && !f->taken[at->pair];) {
        const sunder_row_pair *pair = &f->pair[at->pair];
        f->taken[at->pair] = true;
        out->link[n++] = (sunder_i_chained_pair){at->pair, at->second};
        at = end_at(f, pair->block[!at->second], pair->side[!at->second] ^ 2);
    }
    out->row_end[out->rows++] = n;
}

sunder_status sunder_i_row_chains_make(const sunder_row_pair *pair, size_t n, sunder_i_row_chains *out,
                                       sunder_error *err)
{
    following f = {pair, n, sunder_i_alloc(2 * n, sizeof *f.end), sunder_i_calloc(n, sizeof *f.taken), out};
    *out = (sunder_i_row_chains){.link = sunder_i_alloc(n, sizeof *out->link),
                                 .row_end = sunder_i_alloc(n, sizeof *out->row_end),
                                 .block = sunder_i_alloc(2 * n, sizeof *out->block)};
    const bool ok = f.end && f.taken && out->link && out->row_end && out->block;
    if (ok) list_ends(&f);
    for (size_t k = 0; k < 2 * n && ok; k++)
        if (!end_at(&f, f.end[k].block, f.end[k].side ^ 2)) append_row(&f, &f.end[k]);
    for (size_t k = 0; k < 2 * n && ok; k++) append_row(&f, &f.end[k]);
    sunder_i_free_all(f.end, f.taken);
    return ok ? SUNDER_OK : sunder_i_failure_cause(err);
}

void sunder_i_row_chains_free(sunder_i_row_chains *chains)
{
    sunder_i_free_all(chains->link, chains->row_end, chains->block);
    *chains = (sunder_i_row_chains){0};
}
