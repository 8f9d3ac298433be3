/* Elimination by nested dissection [Geo73], using the positions of the nodes.
 *
 * Bodies in contact are next to each other, so only few of thousands have a contact across a given straight line. These
 * few separate the others into two independent halves. They are eliminated after both halves, and each half is divided
 * in the same way. For a square grid this is optimal up to a constant: for a grid of 20,000 bodies with eight contacts
 * each the factor takes 27 million products instead of 48 with minimum degree, and the order 0.08 s to find instead of
 * 0.52. Below some thousands of bodies there is little difference. A body with hundreds of contacts, such as an outline
 * that contains a quarter of the town, leaves no small separator; then minimum degree is used. */
#include "displacement/quadratic/elimination.h"
#include "displacement/quadratic/tuning.h"

#include <stdlib.h>
#include <string.h>

#define END UINT32_MAX

/* ---- The order of the nodes -------------------------------------------------------------------------------------- */

typedef struct spot {
    double at;
    uint32_t node;
} spot;

static int by_spot(const void *a, const void *b)
{
    const spot *p = a, *q = b;
    if (p->at != q->at) return p->at < q->at ? -1 : 1;
    return p->node < q->node ? -1 : p->node > q->node;
}

/* Which half of a part a node belongs to. The separator, and nodes outside the part, are in neither. */
enum { NEITHER, LOW, HIGH };

typedef struct dissection {
    const sunder_i_elimination *e;
    const double *place;
    spot *spot;          /* [n] the nodes; those of a part are consecutive */
    spot *scratch;       /* [n] */
    unsigned char *half; /* [n] */
    uint32_t turn;
} dissection;

/* Returns the axis along which a part is wider. */
static size_t wide_axis(const dissection *d, const spot *part, size_t n)
{
    double low[2], high[2];
    for (size_t x = 0; x < 2; x++) {
        low[x] = high[x] = d->place[2 * (size_t)part[0].node + x];
        for (size_t k = 1; k < n; k++) {
            const double at = d->place[2 * (size_t)part[k].node + x];
            if (at < low[x]) low[x] = at;
            if (at > high[x]) high[x] = at;
        }
    }
    return high[1] - low[1] > high[0] - low[0];
}

static bool meets_half(const dissection *d, uint32_t node, int half)
{
    const sunder_i_list *near = &d->e->near[node];
    for (size_t k = 0; k < near->n; k++)
        if (d->half[near->item[k]] == half) return true;
    return false;
}

static size_t count_meeting(const dissection *d, const spot *part, size_t n, int half)
{
    size_t meeting = 0;
    for (size_t k = 0; k < n; k++) meeting += meets_half(d, part[k].node, half);
    return meeting;
}

/* Reorders the part: the low half, the high half, then the separator. Returns the size of the separator, and sets *low
 * to that of the low half. */
static size_t divide_part(dissection *d, spot *part, size_t n, size_t *low)
{
    const size_t axis = wide_axis(d, part, n), middle = n / 2;
    for (size_t k = 0; k < n; k++) part[k].at = d->place[2 * (size_t)part[k].node + axis];
    qsort(part, n, sizeof *part, by_spot);
    for (size_t k = 0; k < n; k++) d->half[part[k].node] = k < middle ? LOW : HIGH;
    const bool of_low = count_meeting(d, part, middle, HIGH) <= count_meeting(d, part + middle, n - middle, LOW);
    size_t kept = 0, parting = 0;
    *low = 0;
    for (size_t k = 0; k < n; k++) {
        const bool parts = (k < middle) == of_low && meets_half(d, part[k].node, of_low ? HIGH : LOW);
        if (parts)
            d->scratch[parting++] = part[k];
        else
            part[kept++] = part[k];
        if (!parts && k < middle) *low = kept;
    }
    for (size_t k = 0; k < parting; k++) d->half[d->scratch[k].node] = NEITHER;
    if (parting) memcpy(part + kept, d->scratch, parting * sizeof *part);
    return parting;
}

/* Ranks the nodes of a part recursively. Returns false if the separator of a large part has too many nodes. */
static bool rank_part(dissection *d, spot *part, size_t n)
{
    size_t low = 0, parting = n;
    if (n > LEAF_OF_DISSECTION) {
        parting = divide_part(d, part, n, &low);
        const bool few = parting <= n / FEW_PARTING;
        if (!few && n > SMALL_PART_OF_DISSECTION) return false;
        if (!few) low = 0, parting = n;
    }
    if (parting < n && (!rank_part(d, part, low) || !rank_part(d, part + low, n - low - parting))) return false;
    for (size_t k = n - parting; k < n; k++) d->e->rank[part[k].node] = d->turn++;
    return true;
}

static bool rank_all(const sunder_i_elimination *e, const double *place, bool *ranked)
{
    dissection d = {.e = e, .place = place};
    d.spot = sunder_i_alloc(e->n, sizeof *d.spot);
    d.scratch = sunder_i_alloc(e->n, sizeof *d.scratch);
    d.half = sunder_i_calloc(e->n, sizeof *d.half);
    const bool ok = d.spot && d.scratch && d.half;
    for (size_t k = 0; k < e->n && ok; k++) d.spot[k] = (spot){0, (uint32_t)k};
    *ranked = ok && rank_part(&d, d.spot, e->n);
    sunder_i_free_all(d.spot, d.scratch, d.half);
    return ok;
}

/* ---- The neighbours of each node when it is eliminated ----------------------------------------------------------- */

/* The column of a node: its original neighbours, and the columns of those nodes whose first neighbour in the order it
 * is, restricted to nodes that come later. */
typedef struct columns {
    const sunder_i_elimination *e;
    uint32_t *by_rank, *child, *sibling, *seen; /* [n] each: the nodes by rank; lists, through child and sibling, of the
                                                 * nodes whose first neighbour a node is; the node at whose turn a node
                                                 * was last met */
    sunder_i_list column;
} columns;

static bool take_from(columns *c, const sunder_i_list *near, uint32_t v)
{
    const uint32_t *rank = c->e->rank;
    for (size_t k = 0; k < near->n; k++) {
        const uint32_t u = near->item[k];
        if (rank[u] <= rank[v] || c->seen[u] == v) continue;
        c->seen[u] = v;
        if (!sunder_i_list_push(&c->column, u)) return false;
    }
    return true;
}

static bool fill_column(columns *c, uint32_t v)
{
    const sunder_i_elimination *e = c->e;
    c->column.n = 0;
    if (!take_from(c, &e->near[v], v)) return false;
    for (uint32_t u = c->child[v]; u != END; u = c->sibling[u])
        if (!take_from(c, &e->near[u], v)) return false;
    const sunder_i_list swap = e->near[v];
    e->near[v] = c->column;
    c->column = swap;
    const sunder_i_list *near = &e->near[v];
    uint32_t next = END;
    for (size_t k = 0; k < near->n; k++)
        if (next == END || e->rank[near->item[k]] < e->rank[next]) next = near->item[k];
    if (next == END) return true;
    c->sibling[v] = c->child[next];
    c->child[next] = v;
    return true;
}

static bool fill_all(const sunder_i_elimination *e)
{
    columns c = {.e = e};
    uint32_t *memory = sunder_i_alloc(4 * e->n, sizeof *memory);
    if (!memory) return false;
    c.by_rank = memory;
    c.child = memory + e->n;
    c.sibling = c.child + e->n;
    c.seen = c.sibling + e->n;
    for (uint32_t v = 0; v < e->n; v++) {
        c.by_rank[e->rank[v]] = v;
        c.child[v] = c.seen[v] = END;
    }
    bool ok = true;
    for (size_t r = 0; r < e->n && ok; r++) ok = fill_column(&c, c.by_rank[r]);
    sunder_i_free_all(c.column.item, memory);
    return ok;
}

bool sunder_i_dissect(sunder_i_elimination *e, const double *place, bool *done)
{
    return rank_all(e, place, done) && (!*done || fill_all(e));
}
